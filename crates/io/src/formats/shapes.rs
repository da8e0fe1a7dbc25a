//! Shapes: the common result of formats of geometries: features with attributes, their positions, and lines and rings through them.

use std::ops::Range;

use delone::{Arc2, arcs_over_shared_chords};

use crate::{Cloud, Crs, Error, Features, Graph, GraphRing, Rings, Table, Value};

/// The purpose that geometries are read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    Points,
    Lines,
    Polygons,
}

/// The geometries of a file, in its order. The last position of a ring, which is the first again, is left out.
#[derive(Debug, Default)]
pub(crate) struct Shapes {
    xy: Vec<[f64; 2]>,
    /// The height of each, if it has one.
    z: Vec<Option<f64>>,
    parts: Vec<Part>,
    /// The centers of the arcs that segments are chords of, by the first position of these.
    centers: Vec<(usize, [f64; 2])>,
    polygons: usize,
    lines: usize,
    /// The attributes of features.
    table: Table,
    /// The row of each position, where there are rows.
    rows: Vec<u32>,
    /// Where the positions of the last feature begin, and how many features before it have none.
    begin: Option<usize>,
    empty: usize,
    /// Attributes are kept, not their names alone.
    keeps_attributes: bool,
    /// The system of coordinates, where the file tells.
    pub(super) crs: Option<Crs>,
    /// Remarks on how the file was read.
    pub(super) remarks: Vec<String>,
    pub(super) losses: Vec<String>,
}

/// The heights of positions.
#[derive(Debug, PartialEq)]
pub(super) enum Heights {
    None,
    OfSome,
    OfAll(Vec<f64>),
}

#[derive(Debug)]
struct Part {
    positions: Range<usize>,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    Line,
    /// A ring of a polygon, from 0; where it ends if that is not where it begins.
    Ring {
        polygon: usize,
        ring: usize,
        open: Option<[f64; 2]>,
    },
}

/// The loss of features that are nowhere, if there are any.
pub(super) fn without_geometry(count: usize) -> Option<String> {
    (count > 0).then(|| format!("{count} features without geometry are left out"))
}

impl Shapes {
    /// None yet, of features whose attributes are kept or are not.
    pub(super) fn new(keeps_attributes: bool) -> Self {
        Self { keeps_attributes, ..Self::default() }
    }

    /// Begins a feature, whose attributes and geometries follow.
    pub(super) fn feature(&mut self) {
        self.end_feature();
        self.begin = Some(self.xy.len());
        if self.keeps_attributes {
            self.table.begin();
        }
    }

    fn end_feature(&mut self) {
        self.empty += usize::from(self.begin == Some(self.xy.len()));
        self.begin = None;
    }

    /// Contents of the file that these shapes lack.
    fn losses(&mut self) -> Vec<String> {
        self.end_feature();
        self.losses.extend(without_geometry(self.empty));
        std::mem::take(&mut self.losses)
    }

    /// Gives the feature an attribute.
    pub(super) fn attribute(&mut self, name: &str, value: Value) {
        let column = self.table.column(name);
        if self.keeps_attributes {
            self.table.put(column, value);
        }
    }

    /// How many positions there are.
    pub(super) fn len(&self) -> usize {
        self.xy.len()
    }

    /// How many lines and polygons there are.
    pub(super) fn parts(&self) -> usize {
        self.lines + self.polygons
    }

    /// Takes a position: x, y, and perhaps a height. False if there are fewer than two numbers.
    pub(super) fn position(&mut self, numbers: &[f64]) -> bool {
        let &[x, y, ..] = numbers else { return false };
        self.xy.push([x, y]);
        self.z.push(numbers.get(2).copied());
        if let Some(row) = self.table.len().checked_sub(1) {
            self.rows.push(row as u32);
        }
        true
    }

    /// Says that a segment is a chord, by the number of its first position from here on.
    pub(super) fn center(&mut self, segment: usize, center: [f64; 2]) {
        self.centers.push((self.xy.len() + segment, center));
    }

    /// Makes a line of the positions since `start`.
    pub(super) fn line(&mut self, start: usize) {
        self.lines += 1;
        self.parts.push(Part { positions: start..self.xy.len(), kind: Kind::Line });
    }

    /// Begins a polygon, whose rings follow.
    pub(super) fn polygon(&mut self) {
        self.polygons += 1;
    }

    /// Makes the positions since `start` the next ring of the polygon. Whether one that does not end where it begins is
    /// closed all the same is for the format to say.
    pub(super) fn ring(&mut self, start: usize, closes_itself: bool) {
        let ends = (self.xy.get(start).copied(), self.xy.last().copied());
        let mut open = None;
        if let (Some(first), Some(last)) = ends
            && self.xy.len() > start + 1
        {
            if first == last {
                self.xy.pop();
                self.z.pop();
                self.rows.pop();
            } else if !closes_itself {
                open = Some(last);
            }
        }
        let polygon = self.polygons.saturating_sub(1);
        let ring = match self.parts.last().map(|part| &part.kind) {
            Some(Kind::Ring { polygon: before, ring, .. }) if *before == polygon => ring + 1,
            _ => 0,
        };
        let kind = Kind::Ring { polygon, ring, open };
        self.parts.push(Part { positions: start..self.xy.len(), kind });
    }

    /// The positions, and what heights they have.
    pub(super) fn positions(&mut self) -> (Vec<[f64; 2]>, Heights) {
        let count = self.z.iter().filter(|z| z.is_some()).count();
        let heights = match count {
            0 => Heights::None,
            _ if count < self.z.len() => Heights::OfSome,
            _ => Heights::OfAll(std::mem::take(&mut self.z).into_iter().flatten().collect()),
        };
        (std::mem::take(&mut self.xy), heights)
    }

    /// The rings of all polygons.
    pub(crate) fn rings(mut self) -> Rings {
        let losses = self.losses();
        let rings = self.parts.iter().filter(|part| matches!(part.kind, Kind::Ring { .. }));
        let rings = rings.map(|part| self.xy[part.positions.clone()].to_vec()).collect();
        Rings { rings, crs: self.crs, losses }
    }

    /// All positions as points.
    pub(crate) fn cloud(self) -> Cloud {
        let shapes = self.parts();
        let mut cloud = self.points();
        if shapes > 0 {
            cloud.remarks.push(format!("the corners of {shapes} lines and polygons were taken as points"));
        }
        cloud
    }

    fn points(mut self) -> Cloud {
        let losses = self.losses();
        let (xy, heights) = self.positions();
        let features = Features::new(self.table, self.rows);
        let (crs, remarks) = (self.crs, self.remarks);
        let mut cloud = Cloud { xy, crs, features, remarks, losses, ..Cloud::default() };
        match heights {
            Heights::None => {}
            Heights::OfAll(heights) => cloud.z = Some(heights),
            Heights::OfSome => {
                cloud.losses.push("heights are left out: not all positions have them".to_owned());
            }
        }
        cloud
    }

    /// Divides arcs in the middle whose chord is also another segment.
    fn divide_shared_arcs(&mut self) {
        if self.centers.is_empty() {
            return;
        }
        let mut segments = Vec::new();
        for part in &self.parts {
            let Range { start, end } = part.positions;
            segments.extend((start..end).zip(start + 1..end).map(|(i, j)| [i, j]));
            if matches!(part.kind, Kind::Ring { .. }) && end > start + 1 {
                segments.push([end - 1, start]);
            }
        }
        let of = |first: usize| segments.binary_search_by_key(&first, |ends| ends[0]).ok();
        let arcs: Vec<_> =
            self.centers.iter().filter_map(|&(first, center)| Some((of(first)?, center))).collect();
        let shared = arcs_over_shared_chords(&self.xy, &segments, &arcs);
        let middle = |k: usize| {
            let (ends, center) = (segments[arcs[k].0], arcs[k].1);
            let arc = Arc2::new(ends.map(|i| self.xy[i]), center).ok()?;
            let z = self.z[ends[0]].zip(self.z[ends[1]]).map(|(z, w)| z.midpoint(w));
            Some((ends[0], arc.middle(), z, center))
        };
        let middles: Vec<_> = shared.into_iter().filter_map(middle).collect();
        let before = |i: usize| middles.partition_point(|middle| middle.0 < i);
        let mut pending = middles.iter().peekable();
        let (mut xy, mut z, mut rows) = (Vec::new(), Vec::new(), Vec::new());
        for i in 0..self.xy.len() {
            xy.push(self.xy[i]);
            z.push(self.z[i]);
            rows.extend(self.rows.get(i));
            if let Some(&(first, place, height, center)) = pending.next_if(|middle| middle.0 == i) {
                xy.push(place);
                z.push(height);
                rows.extend(self.rows.get(i));
                self.centers.push((first, center));
            }
        }
        for part in &mut self.parts {
            let Range { start, end } = part.positions;
            part.positions = start + before(start)..end + before(end);
        }
        // Of the two halves of an arc the first is known by its position, the second follows.
        let count = self.centers.len() - middles.len();
        for (k, known) in self.centers.iter_mut().enumerate() {
            known.0 += before(known.0) + usize::from(k >= count);
        }
        self.centers.sort_unstable_by_key(|known| known.0);
        (self.xy, self.z, self.rows) = (xy, z, rows);
    }

    /// The positions with the segments between them: those of rings are borders.
    pub(crate) fn graph(mut self) -> Result<Graph, Error> {
        self.divide_shared_arcs();
        let mut graph = Graph::default();
        let mut centers = std::mem::take(&mut self.centers).into_iter().peekable();
        for part in std::mem::take(&mut self.parts) {
            let Range { start, end } = part.positions;
            let chain = (start..end).zip(start + 1..end).map(|(i, j)| [i, j]);
            let before = graph.segments.len();
            graph.segments.extend(chain);
            if let Kind::Ring { polygon, ring, open } = part.kind {
                if let Some(last) = open {
                    return Err(Error::OpenRing { polygon, ring, first: self.xy[start], last });
                }
                if end > start + 1 {
                    graph.segments.push([end - 1, start]);
                }
                let segments = before..graph.segments.len();
                graph.rings.push(GraphRing { polygon, ring, segments });
                graph.is_border.resize(graph.segments.len(), true);
            }
            graph.is_border.resize(graph.segments.len(), false);
            while let Some((first, center)) = centers.next_if(|&(first, _)| first < end) {
                if first >= start && before + (first - start) < graph.segments.len() {
                    graph.arcs.push((before + (first - start), center));
                }
            }
        }
        graph.cloud = self.points();
        Ok(graph)
    }
}
