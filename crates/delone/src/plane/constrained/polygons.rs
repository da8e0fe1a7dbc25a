//! Polygons with holes to triangles: what is inside of rings, and nothing else.
//!
//! The rings are constraints, and the triangles inside are those of the constrained Delaunay triangulation: of all
//! triangulations the one with the largest smallest angle, and the same for a polygon alone as for one in a country.
//!
//! Cost: O(n log n) for n corners.

use super::{Constrained2, Crossings, Fill};
use crate::error::Error;
use crate::ids::{TriangleId, VertexId};
use crate::parallel;

/// How polygons are triangulated.
///
/// ```
/// use delone::Polygons2;
///
/// let square = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
/// let hole = vec![[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]];
/// let inside = Polygons2::default().triangulate(&[square, hole])?;
/// assert_eq!(inside.triangles.len(), 8);
/// assert_eq!(inside.area(), 12.0);
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Polygons2 {
    /// Whether what rings wind around in sum is inside, counter-clockwise less clockwise, rather than what an odd number of
    /// rings is around.
    pub nonzero: bool,
    /// What happens where sides cross.
    pub crossings: Crossings,
}

/// The triangles inside of a polygon.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonTriangles2 {
    /// The corners of all rings, one ring after another, and then the points where sides were split.
    pub points: Vec<[f64; 2]>,
    /// Triangles by the indices of their corners, counter-clockwise; of equal points the first one is meant.
    pub triangles: Vec<[u32; 3]>,
}

impl PolygonTriangles2 {
    /// The sum of the areas, rounded. In coordinate units squared.
    pub fn area(&self) -> f64 {
        let twice = |[a, b, c]: [[f64; 2]; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        self.triangles.iter().map(|t| twice(t.map(|i| self.points[i as usize])) / 2.0).sum()
    }
}

impl Polygons2 {
    /// With sides that cross split where they do.
    #[must_use]
    pub fn with_crossings(self, crossings: Crossings) -> Self {
        Self { crossings, ..self }
    }

    /// With another rule of what is inside.
    #[must_use]
    pub fn with_nonzero(self, nonzero: bool) -> Self {
        Self { nonzero, ..self }
    }

    /// Triangulates a polygon, or several as one, given by their rings in any order and direction. The last corner of a ring
    /// may repeat the first one; rings may touch, and share sides.
    ///
    /// # Errors
    /// [`Error::SegmentsCross`] if sides cross, where that is refused: sides are counted as corners are, each by the one it
    /// leaves. [`Error::NotFinite`] and [`Error::TooManyPoints`] as of all corners in a row.
    pub fn triangulate<R: AsRef<[[f64; 2]]>>(&self, rings: &[R]) -> Result<PolygonTriangles2, Error> {
        let count = rings.iter().map(|ring| ring.as_ref().len()).sum();
        let mut points: Vec<[f64; 2]> = Vec::with_capacity(count);
        let mut sides: Vec<[usize; 2]> = Vec::with_capacity(count);
        for ring in rings {
            let (first, ring) = (points.len(), ring.as_ref());
            points.extend(ring);
            sides.extend(
                (first..points.len()).map(|i| [i, if i + 1 == points.len() { first } else { i + 1 }]),
            );
        }
        let c = Constrained2::assemble(points, &sides, self.crossings)?;
        let report = c.report();
        let triangles = if !self.nonzero && report.repeated == 0 && report.overlapping == 0 {
            c.triangles_of_odd_depth()
        } else {
            let domains = c.domains(&if self.nonzero { Fill::NonZero } else { Fill::EvenOdd })?;
            let inside = c.triangle_ids().filter(|&t| domains.is_inside(t));
            inside.map(|t| c.mesh().corners(t).map(VertexId::bits)).collect()
        };
        Ok(PolygonTriangles2 { points: c.into_points(), triangles })
    }

    /// Triangulates many polygons, each alone, on all threads.
    ///
    /// # Errors
    /// Those of [`Self::triangulate`], for each polygon its own.
    pub fn triangulate_all<P: AsRef<[R]> + Sync, R: AsRef<[[f64; 2]]>>(
        &self,
        polygons: &[P],
    ) -> Vec<Result<PolygonTriangles2, Error>> {
        let ends = parallel::even_ends(polygons.len(), (8 * parallel::threads()).min(polygons.len()).max(1));
        let starts = std::iter::once(0).chain(ends.iter().copied());
        let runs = starts.zip(ends.iter().copied()).map(|(start, end)| &polygons[start..end]).collect();
        let results = parallel::map(runs, |run: &[P]| {
            run.iter().map(|polygon| self.triangulate(polygon.as_ref())).collect::<Vec<_>>()
        });
        results.into_iter().flatten().collect()
    }
}

impl Constrained2 {
    /// The triangles with an odd number of constraints between them and infinity, if every edge is of one segment at most: by
    /// one flood.
    fn triangles_of_odd_depth(&self) -> Vec<[u32; 3]> {
        let mesh = self.mesh();
        let mut triangles = Vec::new();
        if !self.graph.base.spanned {
            return triangles;
        }
        let mut seen = vec![false; mesh.slot_count()];
        let mut pending: Vec<(TriangleId, bool)> = vec![(mesh.ghost_edge.triangle(), false)];
        seen[mesh.ghost_edge.triangle().index()] = true;
        while let Some((t, is_odd)) = pending.pop() {
            if is_odd {
                triangles.push(mesh.corners(t).map(VertexId::bits));
            }
            for e in [0, 1, 2].map(|k| t.edge(k)) {
                let next = mesh.twin(e).triangle();
                if !std::mem::replace(&mut seen[next.index()], true) {
                    pending.push((next, is_odd ^ mesh.is_fixed(e)));
                }
            }
        }
        triangles
    }
}

#[cfg(feature = "geo-types")]
impl Polygons2 {
    /// Triangulates the polygons of a [`geo_types::MultiPolygon`] as one.
    ///
    /// # Errors
    /// Those of [`Self::triangulate`].
    pub fn triangulate_geo<T: geo_types::CoordNum + Into<f64>>(
        &self,
        polygons: &geo_types::MultiPolygon<T>,
    ) -> Result<PolygonTriangles2, Error> {
        let ring = |line: &geo_types::LineString<T>| -> Vec<[f64; 2]> {
            line.0.iter().map(|c| [c.x.into(), c.y.into()]).collect()
        };
        let of_one = |p: &geo_types::Polygon<T>| -> Vec<Vec<[f64; 2]>> {
            std::iter::once(p.exterior()).chain(p.interiors()).map(ring).collect()
        };
        self.triangulate(&polygons.iter().flat_map(of_one).collect::<Vec<_>>())
    }
}
