//! Welding: vertices and segments nearer to each other than a tolerance become one.
//!
//! *Vertices.* In lexicographic order a point stays if none that stays is within the tolerance of it. The others become the nearest one
//! that stays. So points that stay are farther apart than the tolerance, and no point moves farther than it.
//!
//! *Segments.* A vertex within the tolerance of a segment becomes part of it: the segment becomes two, and so on for both. Vertices do not
//! move for that, the segment bends. Only where the segment is the longest side of the triangle with the vertex, so both new segments are
//! shorter than the old one; where it is not, the vertex is farther away than the tolerance times sqrt(1/2). Segments that run beside each
//! other have each other's ends on them, and then the same edges.
//!
//! *It ends*: vertices are a finite set, so lengths are from a finite set, and the multiset of them goes down with each vertex (Dershowitz
//! & Manna, "Proving termination with multiset orderings", CACM 1979). *It is canonical*: a function of the set of points and of each
//! segment. *Welding once more changes nothing*: no two vertices and no vertex and segment are left that would be joined.
//!
//! Segments that cross without a vertex near the crossing still cross: what becomes of these is said by [`Crossings`](crate::Crossings).
//!
//! Cost: a triangulation, which tells the points that have neighbors within the tolerance, and O(n log n + k) typical for n points and k pairs of a vertex and a box around a segment.

use delone_predicates::{
    compare_distances, compare_lengths, compare_segment_with_radius, hypotenuse, lexicographic,
};

use super::boxes::{Boxes, span};
use crate::error::Error;
use crate::ids::{MAX_POINTS, VertexId};
use crate::neighbors::Neighbors2;
use crate::plane::delaunay::Delaunay2;
use crate::points::{Position2, check_count, check_finite};
use crate::sorting;

/// Points and segments after welding.
///
/// ```
/// use delone::Weld2;
///
/// // Two squares beside each other, with a gap of 1e-7, and the corner of one in the middle of a side of the other.
/// let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0], [1.0000001, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0000001, 1.0]];
/// let segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]];
/// let welded = Weld2::new(&points, &segments, 1e-6)?;
/// assert_eq!(welded.stays[4], 1);
/// assert_eq!(welded.segments[1..3], [[1, 7], [7, 2]]); // the corner is on that side now
/// assert_eq!(welded.segments[8], [7, 1]);
/// assert_eq!(welded.origins[..4], [0, 1, 1, 2]);
/// assert_eq!((welded.moved, welded.bends), (1, 1));
/// # Ok::<(), delone::Error>(())
/// ```
#[doc(alias("snap", "snapping", "tolerance", "merge", "clean"))]
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Weld2 {
    /// For each point the one that it became, by index: itself, if it stays. Of equal points the first one.
    pub stays: Vec<usize>,
    /// The pieces of all segments between points that stay, in the order of the segments, each from its first end to its second. Those that
    /// became a point have none.
    pub segments: Vec<[usize; 2]>,
    /// The segment that each piece is of.
    pub origins: Vec<usize>,
    /// Points that became another one at another place.
    pub moved: usize,
    /// The longest way of such a point, rounded. In coordinate units.
    pub largest_move: f64,
    /// Vertices that became part of a segment, once for each segment.
    pub bends: usize,
    /// Segments that became a point, and were none before.
    pub collapsed: usize,
}

impl Weld2 {
    /// Welds points, and segments between them by the indices of their ends. The tolerance is a distance in coordinate units; with 0, only
    /// vertices on segments, and equal points, are joined.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a tolerance that is negative or not finite, [`Error::NotFinite`], [`Error::TooManyPoints`] and
    /// [`Error::NoSuchPoint`] as [`Constrained2::from_parts`](crate::Constrained2::from_parts).
    pub fn new<P: Position2>(points: &[P], segments: &[[usize; 2]], tolerance: f64) -> Result<Self, Error> {
        check_count(points.len(), MAX_POINTS)?;
        check_count(segments.len(), MAX_POINTS)?;
        if !(tolerance >= 0.0 && tolerance.is_finite()) {
            return Err(Error::Parameter {
                name: "tolerance",
                value: tolerance,
                range: "at least 0 and finite",
            });
        }
        let points: Vec<[f64; 2]> = points.iter().map(Position2::xy).collect();
        check_finite(points.iter().copied())?;
        let count = points.len();
        for (segment, ends) in segments.iter().enumerate() {
            if let Some(&index) = ends.iter().find(|&&index| index >= count) {
                return Err(Error::NoSuchPoint { segment, index, count });
            }
        }
        let stays = stays(&points, tolerance)?;
        let mut made = Self::default();
        for (i, &to) in stays.iter().enumerate().filter(|&(i, &to)| points[i] != points[to]) {
            let [x, y] = [0, 1].map(|k| points[to][k] - points[i][k]);
            made.moved += 1;
            made.largest_move = made.largest_move.max(hypotenuse(x, y));
        }
        if segments.is_empty() {
            made.stays = stays;
            return Ok(made);
        }
        let mut vertices: Vec<usize> = (0..count).filter(|&i| stays[i] == i).collect();
        sorting::by(&mut vertices, |&i, &j| lexicographic(points[i], points[j]));
        let boxes = Boxes::new(vertices.iter().map(|&i| [points[i]; 2]).collect());
        let near = Near { points: &points, vertices: &vertices, boxes: &boxes, tolerance };
        for (segment, ends) in segments.iter().enumerate() {
            let given = ends.map(|i| stays[i]);
            if given[0] == given[1] {
                made.collapsed += usize::from(points[ends[0]] != points[ends[1]]);
                continue;
            }
            let chain = near.chain(given);
            made.bends += chain.len() - 2;
            made.segments.extend(chain.windows(2).map(|link| [link[0], link[1]]));
            made.origins.resize(made.segments.len(), segment);
        }
        made.stays = stays;
        Ok(made)
    }
}

/// For each point the one that it becomes.
fn stays(points: &[[f64; 2]], tolerance: f64) -> Result<Vec<usize>, Error> {
    let mut all: Vec<usize> = (0..points.len()).collect();
    let close = with_neighbors(points, tolerance)?;
    let near: Vec<[f64; 2]> = close.iter().map(|&i| points[i]).collect();
    for (&i, to) in close.iter().zip(stays_of_close(&near, tolerance)?) {
        all[i] = close[to];
    }
    Ok(all)
}

/// The points that may have another one within the tolerance, by increasing index: the nearest one is across a Delaunay edge.
fn with_neighbors(points: &[[f64; 2]], tolerance: f64) -> Result<Vec<usize>, Error> {
    /// Rounding of a length, and more; the least normal number covers that of subnormal ones.
    const ROOM: f64 = 1.0 + 1e-12;
    let d = Delaunay2::from_points(points)?;
    let mesh = d.mesh();
    let mut is_close = vec![false; points.len()];
    for e in mesh.undirected_edges() {
        let ends = [mesh.origin(e), mesh.destination(e)].map(VertexId::index);
        let [a, b] = ends.map(|i| points[i]);
        if hypotenuse(b[0] - a[0], b[1] - a[1]) <= tolerance * ROOM + f64::MIN_POSITIVE {
            ends.into_iter().for_each(|i| is_close[i] = true);
        }
    }
    for duplicate in d.duplicates() {
        is_close[duplicate.point] = true;
        is_close[duplicate.vertex.index()] = true;
    }
    Ok((0..points.len()).filter(|&i| is_close[i]).collect())
}

/// For each point the one that it becomes, by index among these.
fn stays_of_close(points: &[[f64; 2]], tolerance: f64) -> Result<Vec<usize>, Error> {
    let tree = Neighbors2::from_points(points)?;
    let mut order: Vec<usize> = (0..points.len()).collect();
    sorting::by(&mut order, |&i, &j| lexicographic(points[i], points[j]).then(i.cmp(&j)));
    let mut nearest: Vec<Option<usize>> = vec![None; points.len()];
    for first in order {
        if nearest[first].is_some() {
            continue;
        }
        // Around each point there are few that stay, since they are apart; so a point is looked at a few times.
        for i in tree.within(points[first], tolerance)? {
            let is_nearer = |known: usize| {
                let order = compare_distances(points[i], points[first], points[known]);
                order.then_with(|| lexicographic(points[first], points[known])).is_lt()
            };
            if nearest[i].is_none_or(is_nearer) {
                nearest[i] = Some(first);
            }
        }
    }
    Ok(nearest.into_iter().zip(0..).map(|(to, i)| to.unwrap_or(i)).collect())
}

/// The vertices, to be found near segments.
struct Near<'a> {
    points: &'a [[f64; 2]],
    /// In lexicographic order.
    vertices: &'a [usize],
    boxes: &'a Boxes,
    tolerance: f64,
}

impl Near<'_> {
    /// The vertices along a segment.
    fn chain(&self, [first, last]: [usize; 2]) -> Vec<usize> {
        let mut chain = vec![first];
        let mut rest = vec![[first, last]];
        while let Some([a, b]) = rest.pop() {
            match self.part(a, b) {
                Some(v) => rest.extend([[v, b], [a, v]]),
                None => chain.push(b),
            }
        }
        chain
    }

    /// A vertex that becomes part of a segment, if there is any: the middle one in lexicographic order, for the sake of speed.
    fn part(&self, a: usize, b: usize) -> Option<usize> {
        let ends = [self.points[a], self.points[b]];
        let [low, high] = span(&ends);
        // Rounded outwards.
        let asked =
            [low.map(|x| (x - self.tolerance).next_down()), high.map(|x| (x + self.tolerance).next_up())];
        let mut found: Vec<usize> = Vec::new();
        self.boxes.each(&asked, |k| {
            let v = self.vertices[k];
            if v != a && v != b && self.is_part(self.points[v], ends) {
                found.push(k);
            }
        });
        found.sort_unstable();
        found.get(found.len() / 2).map(|&k| self.vertices[k])
    }

    /// Whether a vertex is near a segment, which is the longest side of the triangle with it.
    fn is_part(&self, v: [f64; 2], ends: [[f64; 2]; 2]) -> bool {
        compare_segment_with_radius(v, ends, self.tolerance).is_le()
            && ends.iter().all(|&end| compare_lengths([v, end], ends).is_lt())
    }
}
