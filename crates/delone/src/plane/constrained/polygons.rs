//! Polygons with holes to triangles: what is inside of rings, and nothing else.
//!
//! The rings are constraints, and the triangles inside are those of the constrained Delaunay triangulation: of all
//! triangulations the one with the largest smallest angle, and the same for a polygon alone as for one in a country.
//!
//! Cost: O(n log n) for n corners.

use super::build::constrain;
use super::{Constrained2, ConstraintReport2, Crossings, Domains2, Fill};
use crate::error::Error;
use crate::ids::{MAX_POINTS, Place, TriangleId, VertexId};
use crate::mesh::Mesh2;
use crate::parallel;
use crate::plane::construct;
use crate::plane::layer::Layer;
use crate::points::{check_count, check_finite};
use crate::prefetch::prefetch;

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
    /// The rule for what is inside.
    pub fill: RingFill,
    /// The treatment of sides that cross.
    pub crossings: Crossings,
}

/// The rule for what is inside of the rings of a polygon. To wind is to go around counter-clockwise, less clockwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RingFill {
    /// Inside is what an odd number of rings is around.
    #[default]
    EvenOdd,
    /// Inside is what the rings wind around in sum, in either direction.
    NonZero,
    /// Inside is what they wind around counter-clockwise in sum.
    Positive,
    /// Inside is what they wind around clockwise in sum.
    Negative,
    /// Inside is what the first ring is around and none of the others, whatever their directions: areas in two holes are left out.
    ShellMinusHoles,
}

/// The triangles inside of a polygon.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
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
        let areas = self.triangles.iter().map(|t| twice(t.map(|i| self.points[i as usize])) / 2.0);
        areas.fold(0.0, |sum, area| sum + area)
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
    pub fn with_fill(self, fill: RingFill) -> Self {
        Self { fill, ..self }
    }

    /// Triangulates a polygon, or several as one, given by their rings in any order and direction. The last corner of a ring
    /// may repeat the first one; rings may touch, and share sides.
    ///
    /// # Errors
    /// [`Error::SegmentsCross`] if sides cross, where that is refused: sides are counted as corners are, each by the one it
    /// leaves. [`Error::NotFinite`] and [`Error::TooManyPoints`] as of all corners in a row.
    pub fn triangulate<R: AsRef<[[f64; 2]]>>(&self, rings: &[R]) -> Result<PolygonTriangles2, Error> {
        self.of_shells(rings, |_| 0)
    }

    /// Triangulates several polygons as one, each a shell and its holes: [`RingFill::ShellMinusHoles`] takes each hole from its own shell.
    /// With other rules as [`Self::triangulate`] of all rings.
    ///
    /// # Errors
    /// Those of [`Self::triangulate`].
    ///
    /// ```
    /// use delone::{Polygons2, RingFill};
    ///
    /// let square = |x: f64, size: f64| vec![[x, 0.0], [x + size, 0.0], [x + size, size], [x, size]];
    /// // The second polygon is in the hole of the first one.
    /// let parts = [vec![square(0.0, 8.0), square(1.0, 4.0)], vec![square(2.0, 1.0)]];
    /// let inside = Polygons2::default().with_fill(RingFill::ShellMinusHoles).triangulate_parts(&parts)?;
    /// assert_eq!(inside.area(), 64.0 - 16.0 + 1.0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn triangulate_parts<P: AsRef<[R]>, R: AsRef<[[f64; 2]]>>(
        &self,
        parts: &[P],
    ) -> Result<PolygonTriangles2, Error> {
        let rings: Vec<&R> = parts.iter().flat_map(AsRef::as_ref).collect();
        let mut shells: Vec<usize> = Vec::with_capacity(rings.len());
        parts.iter().for_each(|part| shells.resize(shells.len() + part.as_ref().len(), shells.len()));
        self.of_shells(&rings, |ring| shells[ring])
    }

    /// The same, with the shell of each ring: of a shell, itself.
    fn of_shells<R: AsRef<[[f64; 2]]>>(
        self,
        rings: &[R],
        shell: impl Fn(usize) -> usize,
    ) -> Result<PolygonTriangles2, Error> {
        let count = rings.iter().map(|ring| ring.as_ref().len()).sum();
        check_count(count, MAX_POINTS)?;
        if self.fill == RingFill::EvenOdd {
            let points = corners(rings);
            check_finite(points.iter().copied())?;
            if let Some(triangles) = odd_depth(&points, rings) {
                return Ok(PolygonTriangles2 { points, triangles });
            }
        }
        let (points, sides, of) = sides(rings);
        let c = Constrained2::assemble(points, &sides, self.crossings)?;
        let domains = self.domains(&c, &of, &(0..rings.len()).map(shell).collect::<Vec<_>>())?;
        let inside = c.triangle_ids().filter(|&t| domains.is_inside(t));
        let triangles = inside.map(|t| c.mesh().corners(t).map(VertexId::bits)).collect();
        Ok(PolygonTriangles2 { points: c.into_points(), triangles })
    }

    /// The holes of each polygon that the rule fills at least in part, by the numbers of their rings, on all threads: the first ring is
    /// the shell. Nothing of polygons that are refused.
    pub fn filled_holes_of_all<P: AsRef<[R]> + Sync, R: AsRef<[[f64; 2]]>>(
        &self,
        polygons: &[P],
    ) -> Vec<Vec<usize>> {
        each_on_all_threads(polygons, |rings| self.filled_holes(rings))
    }

    fn filled_holes<R: AsRef<[[f64; 2]]>>(self, rings: &[R]) -> Vec<usize> {
        let of_one = || {
            let (points, sides, of) = sides(rings);
            let c = Constrained2::assemble(points, &sides, self.crossings).ok()?;
            let domains = self.domains(&c, &of, &vec![0; rings.len()]).ok()?;
            Some(c.filled_holes(&domains, |s| of.get(s.index()).copied(), &vec![0; rings.len()]))
        };
        if rings.len() < 2 || self.fill == RingFill::ShellMinusHoles {
            return Vec::new();
        }
        of_one().unwrap_or_default()
    }

    /// Triangulates many polygons, each alone, on all threads.
    ///
    /// # Errors
    /// Those of [`Self::triangulate`], for each polygon its own.
    pub fn triangulate_all<P: AsRef<[R]> + Sync, R: AsRef<[[f64; 2]]>>(
        &self,
        polygons: &[P],
    ) -> Vec<Result<PolygonTriangles2, Error>> {
        each_on_all_threads(polygons, |rings| self.triangulate(rings))
    }

    /// Triangulates many polygons of several parts, each alone, on all threads.
    ///
    /// # Errors
    /// Those of [`Self::triangulate_parts`], for each polygon its own.
    pub fn triangulate_all_parts<G: AsRef<[P]> + Sync, P: AsRef<[R]>, R: AsRef<[[f64; 2]]>>(
        &self,
        polygons: &[G],
    ) -> Vec<Result<PolygonTriangles2, Error>> {
        each_on_all_threads(polygons, |parts| self.triangulate_parts(parts))
    }

    /// The parts inside, by the ring of each side and the shell of each ring.
    fn domains(self, c: &Constrained2, of: &[usize], shells: &[usize]) -> Result<Domains2, Error> {
        match self.fill {
            RingFill::EvenOdd => c.domains(&Fill::EvenOdd),
            RingFill::NonZero => c.domains(&Fill::NonZero),
            RingFill::Positive => c.domains(&Fill::Positive),
            RingFill::Negative => c.domains(&Fill::Negative),
            RingFill::ShellMinusHoles => Ok(c.shells_minus_holes(|s| of.get(s.index()).copied(), shells)),
        }
    }
}

/// A result for each polygon, on all threads.
fn each_on_all_threads<P: AsRef<[R]> + Sync, R, T: Send>(
    polygons: &[P],
    each: impl Fn(&[R]) -> T + Sync,
) -> Vec<T> {
    let ends = parallel::even_ends(polygons.len(), (8 * parallel::threads()).min(polygons.len()).max(1));
    let starts = std::iter::once(0).chain(ends.iter().copied());
    let runs = starts.zip(ends.iter().copied()).map(|(start, end)| &polygons[start..end]).collect();
    let results =
        parallel::map(runs, |run: &[P]| run.iter().map(|polygon| each(polygon.as_ref())).collect::<Vec<_>>());
    results.into_iter().flatten().collect()
}

/// The corners of all rings.
fn corners<R: AsRef<[[f64; 2]]>>(rings: &[R]) -> Vec<[f64; 2]> {
    let mut points = Vec::with_capacity(rings.iter().map(|ring| ring.as_ref().len()).sum());
    rings.iter().for_each(|ring| points.extend(ring.as_ref()));
    points
}

/// The corners of all rings, the sides between them, and the ring of each side.
fn sides<R: AsRef<[[f64; 2]]>>(rings: &[R]) -> (Vec<[f64; 2]>, Vec<[usize; 2]>, Vec<usize>) {
    let points = corners(rings);
    let mut sides: Vec<[usize; 2]> = Vec::with_capacity(points.len());
    let mut of: Vec<usize> = Vec::with_capacity(points.len());
    for (number, ring) in rings.iter().enumerate() {
        let first = sides.len();
        let end = first + ring.as_ref().len();
        sides.extend((first..end).map(|i| [i, if i + 1 == end { first } else { i + 1 }]));
        of.resize(end, number);
    }
    (points, sides, of)
}

/// The triangles with an odd number of sides between them and infinity, by one flood, if no side crosses another or has a part
/// in common with one. Vertices stay at their positions in Morton order, and nothing is remembered of the sides.
fn odd_depth<R: AsRef<[[f64; 2]]>>(points: &[[f64; 2]], rings: &[R]) -> Option<Vec<[u32; 3]>> {
    let mut ordered = construct::in_order(points);
    let positions = ordered.positions(points.len());
    let mut sides: Vec<[Place; 2]> = Vec::with_capacity(points.len());
    let mut rest = &positions[..];
    for ring in rings {
        let (ring, others) = rest.split_at(ring.as_ref().len());
        sides.extend(ring.windows(2).map(|pair| [pair[0], pair[1]]));
        sides.extend(ring.last().map(|&last| [last, ring[0]]));
        rest = others;
    }
    let mesh = std::mem::replace(&mut ordered.mesh, Mesh2::empty(0));
    let mut layer = Layer::new(mesh, std::mem::take(&mut ordered.points));
    let mut report = ConstraintReport2::default();
    let refused = constrain(&mut layer, &sides, &mut report);
    if !refused.is_empty() || report.repeated > 0 || report.overlapping > 0 {
        return None;
    }
    let mesh = &layer.mesh;
    let mut triangles = Vec::new();
    if !layer.spanned {
        return Some(triangles);
    }
    triangles.reserve(points.len());
    let mut seen = vec![false; mesh.slot_count()];
    // First in, first out: while others are looked at, what a triangle is comes from memory.
    let mut reached: Vec<(TriangleId, bool)> = Vec::with_capacity(mesh.slot_count());
    reached.push((mesh.ghost_edge.triangle(), false));
    seen[mesh.ghost_edge.triangle().index()] = true;
    let mut at = 0;
    while let Some(&(t, is_odd)) = reached.get(at) {
        at += 1;
        let edges = [0, 1, 2].map(|k| t.edge(k));
        if is_odd {
            triangles.push(edges.map(|e| ordered.indices[mesh.tail(e).index()]));
        }
        for e in edges {
            let next = mesh.twin(e).triangle();
            if !std::mem::replace(&mut seen[next.index()], true) {
                prefetch(&mesh.edges, next.edge(0).index());
                reached.push((next, is_odd ^ mesh.is_fixed(e)));
            }
        }
    }
    Some(triangles)
}

#[cfg(feature = "geo-types")]
impl Polygons2 {
    /// Triangulates the polygons of a [`geo_types::MultiPolygon`] as one, each with holes of its own.
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
        self.triangulate_parts(&polygons.iter().map(of_one).collect::<Vec<_>>())
    }
}
