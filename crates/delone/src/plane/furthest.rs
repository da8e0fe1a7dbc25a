//! Furthest sites: their triangulation and Voronoi diagram, queries, the smallest enclosing circle.
//!
//! The furthest-site triangulation joins the corners of the convex hull so that the circle of each triangle contains
//! all sites: the upper hull of the lifted points, where the Delaunay triangulation is the lower one. Ties
//! are broken by the same perturbation, so it is canonical too.
//!
//! Source: Chew, "Building Voronoi diagrams for convex polygons in linear expected time", TR PCS-TR90-147, 1990:
//! corners are taken away in random order and put back, each beyond the edge that it left. Queries climb from
//! neighbor to neighbor through random samples of the corners, from coarse to fine, as in the Delaunay hierarchy:
//! a vertex of a convex polytope that no neighbor excels is the best.
//!
//! A neighbor that is further away is found by binary search. With r = q - v a neighbor v + a is as far from q as v is, or nearer,
//! if 2 r.a / |a|^2 is 1 or more. Inverted at v, as a / |a|^2, the neighbors in their order are a convex chain that faces v. Along it
//! the product with r falls to the least and rises from there; or, if q is on the other side of v, it is negative throughout.
//!
//! Cost: O(h) expected after the hull of h corners is known. A query O(log h) steps expected, each of them O(log d) comparisons at a
//! corner with d neighbors, so O(log^2 h): each level is a random eighth of the one below, where seven corners on average are
//! further away than the furthest of the sample, and each step goes to one of them.

use std::ops::Range;

use delone_predicates::{
    Sign, angle, center_side, circumcenter, compare_distances, hypotenuse, lexicographic,
};

use super::layer::Layer;
use super::layer::insert::Spot;
use super::layer::kernel::Furthest;
use super::{Delaunay2, VoronoiEdge2};
use crate::error::Error;
use crate::hull::plane;
use crate::ids::{EdgeId, Place, VertexId};
use crate::locate::Start;
use crate::mesh::Mesh2;
use crate::order::random::SplitMix;
use crate::points::{Position2, finite};
use crate::tally::Tally;

/// Corners of a level for each one of the next coarser.
const RATIO: usize = 8;
/// The coarsest level has fewer than this many times the ratio.
const SMALLEST: usize = 4;

/// The furthest-site diagram of a set of points.
///
/// ```
/// use delone::Delaunay2;
///
/// let d = Delaunay2::from_points(&[[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [2.0, 1.0]])?;
/// let furthest = d.furthest();
/// assert_eq!(furthest.furthest([4.0, 3.0])?.map(|v| v.index()), Some(0));
/// let circle = furthest.enclosing_circle().unwrap();
/// assert_eq!((circle.center, circle.radius), ([2.0, 1.5], 2.5));
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Furthest2 {
    /// The corners of the hull, counter-clockwise.
    corners: Vec<VertexId>,
    /// From fine to coarse.
    levels: Vec<Level>,
}

/// The triangulation of a sample of the corners.
#[derive(Clone, Debug)]
struct Level {
    points: Vec<[f64; 2]>,
    /// Over the indices of the points; fewer than three have no triangles.
    mesh: Mesh2,
    /// For each point where its neighbors begin, and at last their number.
    starts: Vec<u32>,
    /// Counter-clockwise around each point those it is joined to, from the next one along the hull to the one before.
    around: Vec<u32>,
    /// For each point its index in the next finer level.
    finer: Vec<u32>,
}

/// The smallest circle that no point is outside of.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct EnclosingCircle {
    /// Its center, rounded.
    pub center: [f64; 2],
    /// Its radius, rounded, in coordinate units.
    pub radius: f64,
    /// The points that determine it: the only one, two at the ends of a diameter, or three around it.
    pub support: Vec<VertexId>,
}

impl Delaunay2 {
    /// The furthest-site diagram of the vertices as they are now.
    ///
    /// O(h log h) for h vertices on the hull.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [0, 3]])?;
    /// let circle = d.furthest().enclosing_circle().expect("of three points");
    /// assert_eq!((circle.center, circle.radius), ([2.0, 1.5], 2.5));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn furthest(&self) -> Furthest2 {
        let hull: Vec<VertexId> = self.hull_vertices().collect();
        let points: Vec<[f64; 2]> = hull.iter().map(|&v| self.point(v)).collect();
        let corners: Vec<VertexId> = plane::corners(&points).into_iter().map(|i| hull[i]).collect();
        let points: Vec<[f64; 2]> = corners.iter().map(|&v| self.point(v)).collect();
        let mut levels = vec![Level::new(points, Vec::new())];
        let mut random = SplitMix(0);
        while let Some(finer) = levels.last().filter(|level| level.points.len() >= SMALLEST * RATIO) {
            let count = finer.points.len() as u32;
            let sample: Vec<u32> = (0..count).filter(|_| random.below(RATIO) == 0).collect();
            if sample.is_empty() {
                break;
            }
            levels.push(Level::new(sample.iter().map(|&i| finer.points[i as usize]).collect(), sample));
        }
        Furthest2 { corners, levels }
    }
}

impl Level {
    /// Triangulates the corners of a convex polygon, counter-clockwise and none on the line of its neighbors.
    fn new(points: Vec<[f64; 2]>, finer: Vec<u32>) -> Self {
        let n = points.len();
        if n < 3 {
            // Of two corners each is the other's only neighbor.
            let (starts, around) =
                if n == 2 { (vec![0, 1, 2], vec![1, 0]) } else { (vec![0; n + 1], vec![]) };
            return Self { points, mesh: Mesh2::empty(n), starts, around, finer };
        }
        let mut order: Vec<usize> = (0..n).collect();
        SplitMix(n as u64).shuffle(&mut order);
        // The neighbors of each corner when it is taken away.
        let mut previous: Vec<usize> = (0..n).map(|i| (i + n - 1) % n).collect();
        let mut next: Vec<usize> = (0..n).map(|i| (i + 1) % n).collect();
        for &i in order[3..].iter().rev() {
            next[previous[i]] = next[i];
            previous[next[i]] = previous[i];
        }
        let mut layer: Layer<Furthest> = Layer::new(Mesh2::empty(n), points);
        for &i in &order[..3] {
            let (spot, _) = layer.spot(Start::Anywhere, layer.points[i], &mut ());
            debug_assert!(!matches!(spot, Spot::Vertex(_)), "corners are distinct");
            layer.insert_at(Place::new(i), spot, &mut ());
        }
        for &i in &order[3..] {
            let (a, b) = (Place::new(previous[i]), Place::new(next[i]));
            let mesh = &layer.mesh;
            let hull_edge = |e: &EdgeId| mesh.head(*e) == b && mesh.tip(mesh.twin(*e)).is_ghost();
            if let Some(e) = mesh.spokes(a).find(hull_edge) {
                let beyond = mesh.twin(e).triangle();
                layer.insert_at(Place::new(i), Spot::Triangle(beyond), &mut ());
            }
        }
        let (points, mesh) = (layer.points, layer.mesh);
        let (mut starts, mut around) = (vec![0], Vec::with_capacity(4 * n));
        for v in (0..n).map(Place::new) {
            let to_ghost = mesh.spokes(v).find(|&e| mesh.head(e).is_ghost());
            let joined = to_ghost.into_iter().flat_map(|e| mesh.star_from(e).skip(1));
            around.extend(joined.map(|e| mesh.head(e).index() as u32));
            starts.push(around.len() as u32);
        }
        Self { points, mesh, starts, around, finer }
    }

    fn neighbors(&self, at: usize) -> &[u32] {
        &self.around[self.starts[at] as usize..self.starts[at + 1] as usize]
    }

    /// Where among the neighbors of a corner the first of those is that excel it most, seen from `q`.
    fn best<T: Tally>(&self, at: usize, q: [f64; 2], tally: &mut T) -> usize {
        let joined = self.neighbors(at);
        first(0..joined.len().saturating_sub(1), |k| {
            !self.rises(at, [joined[k], joined[k + 1]], q, tally).is_negative()
        })
    }

    /// Whether the second of two neighbors in a row excels a corner less than the first.
    fn rises<T: Tally>(&self, at: usize, pair: [u32; 2], q: [f64; 2], tally: &mut T) -> Sign {
        tally.compared();
        let [a, b] = pair.map(|w| self.points[w as usize]);
        center_side(self.points[at], a, b, q)
    }

    /// Climbs from a corner to one that no neighbor is further away than.
    fn climb<T: Tally>(&self, start: usize, q: [f64; 2], tally: &mut T) -> usize {
        let mut at = start;
        while let Some(&w) = self.neighbors(at).get(self.best(at, q, tally)) {
            tally.compared();
            if !compare_distances(q, self.points[w as usize], self.points[at]).is_gt() {
                break;
            }
            at = w as usize;
        }
        at
    }

    /// The neighbors that are as far away as a corner which none is further away than: they are in a row.
    fn ties<T: Tally>(&self, at: usize, q: [f64; 2], tally: &mut T) -> &[u32] {
        let joined = self.neighbors(at);
        let begin = self.best(at, q, tally);
        tally.compared();
        let is_tie = |&w: &u32| compare_distances(q, self.points[w as usize], self.points[at]).is_eq();
        if !joined.get(begin).is_some_and(is_tie) {
            return &[];
        }
        let end = first(begin..joined.len() - 1, |k| {
            !self.rises(at, [joined[k], joined[k + 1]], q, tally).is_zero()
        });
        &joined[begin..=end]
    }

    /// The lexicographically smallest of the corners that are as far away as one which none is further away than. They are on one
    /// circle around the query, and the largest of them, which the perturbation puts outside of the circles of the others, is a corner
    /// of all triangles between them: it is joined to all, and each of the others to three of them at most.
    fn least<T: Tally>(&self, at: usize, q: [f64; 2], tally: &mut T) -> usize {
        let order = |i: usize, j: usize| lexicographic(self.points[i], self.points[j]);
        let mut ties = self.ties(at, q, tally);
        let mut largest = at;
        if ties.len() <= 3 {
            largest =
                ties.iter().map(|&w| w as usize).fold(at, |i, j| if order(i, j).is_lt() { j } else { i });
            ties = self.ties(largest, q, tally);
        }
        // From the largest around the hull they fall to the smallest, and rise.
        let rises = |k: usize| order(ties[k] as usize, ties[k + 1] as usize).is_lt();
        let least = first(0..ties.len().saturating_sub(1), rises);
        ties.get(least).map_or(largest, |&w| w as usize)
    }
}

/// The first index for which it is true, of those in a range for which it is false and then true; or else the end.
fn first(mut range: Range<usize>, mut is_true: impl FnMut(usize) -> bool) -> usize {
    while !range.is_empty() {
        let middle = range.start.midpoint(range.end);
        range = if is_true(middle) { range.start..middle } else { middle + 1..range.end };
    }
    range.start
}

impl Furthest2 {
    /// The corners of the convex hull, counter-clockwise: the sites that are furthest from somewhere.
    pub fn corners(&self) -> &[VertexId] {
        &self.corners
    }

    /// The triangles, counter-clockwise: no site is outside of the circle of any.
    pub fn triangles(&self) -> impl Iterator<Item = [VertexId; 3]> + '_ {
        let mesh = &self.levels[0].mesh;
        mesh.triangles().map(|t| mesh.places(t).map(|p| self.corners[p.index()]))
    }

    /// The edges of the furthest-site Voronoi diagram, with the two sites that are furthest from each.
    pub fn edges(&self) -> impl Iterator<Item = ([VertexId; 2], VoronoiEdge2)> + '_ {
        let Level { mesh, points, .. } = &self.levels[0];
        let center = |e: EdgeId| {
            let corners = mesh.places(e.triangle());
            let [a, b, c] = corners.map(|p| points.get(p.index()).copied().unwrap_or_default());
            if corners.iter().any(|p| p.is_ghost()) { None } else { circumcenter(a, b, c) }
        };
        let dual = move |e: EdgeId| {
            let ends = [mesh.tail(e), mesh.head(e)].map(Place::index);
            let edge = bisector(ends.map(|i| points[i]), center(e), center(mesh.twin(e)));
            (ends.map(|i| self.corners[i]), edge)
        };
        let two = match (&self.corners[..], &points[..]) {
            (&[v, w], &[p, q]) => Some(([v, w], bisector([p, q], None, None))),
            _ => None,
        };
        mesh.undirected_edges().map(dual).chain(two)
    }

    /// The vertex furthest from a point; of several at the same distance the lexicographically smallest. `None` if
    /// there is none. Exact.
    ///
    /// O(log^2 h) expected, whatever the points and the query.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    pub fn furthest<P: Position2>(&self, q: P) -> Result<Option<VertexId>, Error> {
        self.furthest_observed(q, &mut ())
    }

    /// The same; `tally` hears of each comparison.
    ///
    /// # Errors
    /// As [`Self::furthest`].
    pub fn furthest_observed<P: Position2, T: Tally>(
        &self,
        q: P,
        tally: &mut T,
    ) -> Result<Option<VertexId>, Error> {
        let q = finite(q.xy())?;
        if self.corners.is_empty() {
            return Ok(None);
        }
        let mut at = 0;
        for level in self.levels.iter().rev() {
            at = level.climb(at, q, tally);
            at = level.finer.get(at).map_or(at, |&i| i as usize);
        }
        Ok(Some(self.corners[self.levels[0].least(at, q, tally)]))
    }

    /// The smallest circle that contains all points. `None` if there is none. Which points determine it is decided
    /// exactly.
    ///
    /// O(h).
    pub fn enclosing_circle(&self) -> Option<EnclosingCircle> {
        let Level { mesh, points, .. } = &self.levels[0];
        let diameter = |i: usize, j: usize| {
            let (p, q) = (points[i], points[j]);
            let half = [0, 1].map(|axis| q[axis] / 2.0 - p[axis] / 2.0);
            let center = [0, 1].map(|axis| p[axis] / 2.0 + q[axis] / 2.0);
            let support = vec![self.corners[i], self.corners[j]];
            EnclosingCircle { center, radius: hypotenuse(half[0], half[1]), support }
        };
        match points.len() {
            0 => return None,
            1 => {
                return Some(EnclosingCircle {
                    center: points[0],
                    radius: 0.0,
                    support: self.corners.clone(),
                });
            }
            2 => return Some(diameter(0, 1)),
            _ => {}
        }
        // The center is as far from two sites as possible on their Voronoi edge, or at a Voronoi vertex.
        let sees_right_angle = |e: EdgeId| {
            let [a, b, tip] = [mesh.tail(e), mesh.head(e), mesh.tip(e)];
            tip.is_ghost() || {
                let [a, b, tip] = [a, b, tip].map(|p| points[p.index()]);
                !angle(tip, a, b).is_positive()
            }
        };
        if let Some(e) =
            mesh.undirected_edges().find(|&e| sees_right_angle(e) && sees_right_angle(mesh.twin(e)))
        {
            // A hull edge has nothing beyond it, so its triangle alone must see it so.
            return Some(diameter(mesh.tail(e).index(), mesh.head(e).index()));
        }
        let is_acute = |t: &crate::ids::TriangleId| {
            let [a, b, c] = mesh.places(*t).map(|p| points[p.index()]);
            [(a, b, c), (b, c, a), (c, a, b)].into_iter().all(|(o, p, q)| angle(o, p, q).is_positive())
        };
        let t = mesh.triangles().find(is_acute)?;
        let places = mesh.places(t).map(Place::index);
        let [a, b, c] = places.map(|i| points[i]);
        let center = circumcenter(a, b, c)?;
        let radius = hypotenuse(a[0] - center[0], a[1] - center[1]);
        Some(EnclosingCircle { center, radius, support: places.map(|i| self.corners[i]).to_vec() })
    }
}

/// The furthest-site Voronoi edge between two sites: rays go away from the hull edge, across the hull.
fn bisector([a, b]: [[f64; 2]; 2], left: Option<[f64; 2]>, right: Option<[f64; 2]>) -> VoronoiEdge2 {
    let to_left = [a[1] / 2.0 - b[1] / 2.0, b[0] / 2.0 - a[0] / 2.0];
    match (left, right) {
        (Some(from), Some(to)) => VoronoiEdge2::Segment([from, to]),
        (Some(from), None) => VoronoiEdge2::Ray { from, direction: to_left },
        (None, Some(from)) => VoronoiEdge2::Ray { from, direction: to_left.map(|x| 0.0 - x) },
        (None, None) => {
            let through = [0, 1].map(|axis| a[axis] / 2.0 + b[axis] / 2.0);
            VoronoiEdge2::Line { through, direction: to_left }
        }
    }
}
