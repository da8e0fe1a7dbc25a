//! Planar straight line graphs as they come from files: points, and segments between them.

use std::ops::Range;

use delone::RegionSeed2;

use crate::{Cloud, Crs, Error, Names};

/// Points with segments, and what a file says of them: the input of constrained triangulations.
///
/// Indices are those of the points, from 0, whatever the file counts from, and in range. Segments may cross, overlap, repeat
/// or join a point to itself: that is judged by the triangulation, and so are coordinates.
///
/// Fields may be added: a literal ends with `..` and a value to take the rest from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Graph {
    /// The points, with heights and system where the file has them, and remarks on how it was read.
    pub cloud: Cloud,
    /// The segments, as indices of points.
    pub segments: Vec<[usize; 2]>,
    /// For each segment, whether it bounds an area: rings of polygons and the segments of `.poly` files do, lines do not.
    pub is_border: Vec<bool>,
    /// Which points had no segment before welding, if there was any: points that became another one have none after it.
    pub lone: Option<Vec<bool>>,
    /// The row of each segment's attributes ([`Cloud::features`]), where it is not that of the point that the segment starts at.
    pub rows: Option<Vec<Option<usize>>>,
    /// The segments that are chords of arcs, by increasing index, with the centers of their circles.
    pub arcs: Vec<(usize, [f64; 2])>,
    /// A number for each segment, where the file has them.
    pub markers: Option<Vec<i64>>,
    /// A number for each point, where the file has them.
    pub point_markers: Option<Vec<i64>>,
    /// Values of the points, where the file has them (`.node`, `.poly`). The first is the height too.
    pub attributes: Attributes,
    /// Points in areas that are left out.
    pub holes: Vec<[f64; 2]>,
    /// Points in areas that have an attribute and perhaps a largest area of their triangles.
    pub regions: Vec<RegionSeed2>,
    /// Names of regions and boundaries, where the file has them.
    pub names: Names,
    /// Which ring of which polygon segments are, where the file has polygons.
    pub rings: Vec<GraphRing>,
}

/// A ring of a polygon, closed. One that has fewer than two distinct positions one after the other may have no segments.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GraphRing {
    /// The polygon, from 0 in the file.
    pub polygon: usize,
    /// The ring of that polygon: 0 is the outer one, the others are holes.
    pub ring: usize,
    /// Its segments.
    pub segments: Range<usize>,
}

/// The rings of polygons, without the last position of each, which is the first again.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rings {
    /// The rings of all polygons, one after another.
    pub rings: Vec<Vec<[f64; 2]>>,
    /// The system of coordinates, where the file tells.
    pub crs: Option<Crs>,
    /// Contents of the file that these rings lack.
    pub losses: Vec<String>,
}

/// Rows of values, each of the same width.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attributes {
    /// How many values a row has.
    pub width: usize,
    /// The rows, one after another.
    pub values: Vec<f64>,
}

impl Attributes {
    /// The values of row `i`; nothing if there is no such row.
    pub fn row(&self, i: usize) -> &[f64] {
        self.values.get(i * self.width..(i + 1) * self.width).unwrap_or_default()
    }
}

impl Graph {
    /// Points without segments.
    pub fn of_points(cloud: Cloud) -> Self {
        Self { cloud, ..Self::default() }
    }

    /// For each point whether no segment ends at it; of a welded graph whether none did before.
    pub fn lone_points(&self) -> Vec<bool> {
        if let Some(lone) = &self.lone {
            return lone.clone();
        }
        let mut lone = vec![true; self.cloud.xy.len()];
        self.segments.as_flattened().iter().for_each(|&end| lone[end] = false);
        lone
    }

    /// The row of a ring's attributes ([`Cloud::features`]), if it has any.
    pub fn row_of(&self, ring: &GraphRing) -> Option<usize> {
        self.row_of_segment(ring.segments.start).filter(|_| !ring.segments.is_empty())
    }

    /// The row of a segment's attributes, if it has any.
    pub fn row_of_segment(&self, segment: usize) -> Option<usize> {
        match &self.rows {
            Some(rows) => rows.get(segment).copied().flatten(),
            None => self.cloud.features.row(self.segments.get(segment)?[0]),
        }
    }

    /// Makes one graph of two files: points, segments, rings and seeds of the other follow ours. Markers that a file does
    /// not have are 0, names must not contradict; attributes stay if both have as many. Points that are in both files are not joined here: the
    /// triangulation finds equal points.
    pub fn join(&mut self, mut other: Self) -> Result<(), Error> {
        let (points, segments) = (self.cloud.xy.len(), self.segments.len());
        let (more_points, more_segments) = (other.cloud.xy.len(), other.segments.len());
        let polygons = self.rings.iter().map(|ring| ring.polygon + 1).max().unwrap_or(0);
        self.names.join(&other.names)?;
        self.cloud.join(other.cloud)?;
        self.segments.extend(other.segments.iter().map(|ends| ends.map(|i| i + points)));
        self.is_border.append(&mut other.is_border);
        self.arcs.extend(other.arcs.iter().map(|&(segment, center)| (segment + segments, center)));
        join_markers(&mut self.markers, segments, other.markers, more_segments);
        join_markers(&mut self.point_markers, points, other.point_markers, more_points);
        if self.attributes.width == other.attributes.width || points == 0 {
            self.attributes.width = other.attributes.width;
            self.attributes.values.append(&mut other.attributes.values);
        } else if more_points > 0 {
            self.attributes = Attributes::default();
            self.cloud.losses.push("attributes are left out: not all files have as many".to_owned());
        }
        self.holes.append(&mut other.holes);
        self.regions.append(&mut other.regions);
        self.rings.extend(other.rings.into_iter().map(|ring| GraphRing {
            polygon: polygons + ring.polygon,
            ring: ring.ring,
            segments: segments + ring.segments.start..segments + ring.segments.end,
        }));
        Ok(())
    }
}

/// Appends the markers of `more` to those of `count`; those that are not there are 0.
fn join_markers(ours: &mut Option<Vec<i64>>, count: usize, theirs: Option<Vec<i64>>, more: usize) {
    if ours.is_none() && theirs.is_none() {
        return;
    }
    let markers = ours.get_or_insert_with(|| vec![0; count]);
    markers.extend(theirs.unwrap_or_else(|| vec![0; more]));
}

#[cfg(test)]
mod tests {
    use super::{Attributes, Graph, GraphRing};
    use crate::Cloud;

    fn square(markers: Option<Vec<i64>>, width: usize) -> Graph {
        Graph {
            cloud: Cloud { xy: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], ..Cloud::default() },
            segments: vec![[0, 1], [1, 2], [2, 3], [3, 0]],
            is_border: vec![true; 4],
            markers,
            attributes: Attributes { width, values: vec![7.0; 4 * width] },
            rings: vec![GraphRing { polygon: 0, ring: 0, segments: 0..4 }],
            ..Graph::default()
        }
    }

    #[test]
    fn files_join() {
        let mut both = square(None, 2);
        both.join(square(Some(vec![5; 4]), 2)).expect("no systems");
        both.join(Graph::of_points(Cloud { xy: vec![[9.0, 9.0]], ..Cloud::default() })).expect("no systems");
        assert_eq!((both.cloud.xy.len(), both.segments.len(), both.is_border.len()), (9, 8, 8));
        assert_eq!(both.segments[4..], [[4, 5], [5, 6], [6, 7], [7, 4]]);
        assert_eq!(both.markers, Some(vec![0, 0, 0, 0, 5, 5, 5, 5]));
        assert_eq!(both.rings[1], GraphRing { polygon: 1, ring: 0, segments: 4..8 });
        // The last file has no attributes.
        assert_eq!((both.attributes.width, both.cloud.losses.len()), (0, 1));
        assert!(both.attributes.row(3).is_empty());
        let mut first = Graph::default();
        first.join(square(None, 1)).expect("no systems");
        assert_eq!((first.attributes.row(3), first.point_markers), (&[7.0][..], None));
    }
}
