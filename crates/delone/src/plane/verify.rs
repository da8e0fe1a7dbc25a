//! Judging triangles from elsewhere: are they a Delaunay triangulation of these points, and are they *the*
//! canonical one?
//!
//! Nothing is believed: indices, orientation, edges, hull and circles are proved with exact predicates, as in
//! `check`, but from bare triples and with sentences that name the culprit. Cost: O(n log n).

mod segments;
mod weights;

use delone_predicates::{Sign, in_circle, in_circle_with_ties, lexicographic, orient2d, strictly_between};

use crate::error::Error;
use crate::points::check_finite;
use crate::sorting;
use crate::verdict::Verdict;
pub use weights::verify_weighted2;

/// Why triangles are not a Delaunay triangulation of the points. Triangles and points are named by their index.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Objection2 {
    /// The points themselves are not valid.
    #[error(transparent)]
    Points(#[from] Error),
    /// A corner that no point has.
    #[error("triangle {triangle} has the corner {corner}, but there are {points} points")]
    Index {
        /// The triangle.
        triangle: usize,
        /// Its corner.
        corner: u64,
        /// The number of points.
        points: usize,
    },
    /// Three collinear corners.
    #[error("triangle {0} is flat: its corners are collinear")]
    Flat(usize),
    /// Two triangles on the same side of an edge.
    #[error("triangles {0} and {1} overlap: they lie on the same side of a common edge")]
    Overlap(usize, usize),
    /// The edge rule fails.
    #[error(
        "triangle {triangle} is not Delaunay: its circle contains point {point}, a corner of triangle {neighbor}"
    )]
    Circle {
        /// The triangle.
        triangle: usize,
        /// The triangle across its edge.
        neighbor: usize,
        /// The corner of that triangle inside the circle.
        point: usize,
    },
    /// A triangle with weights: the power of a site is less than that of the corners.
    #[error(
        "triangle {triangle} is not regular: point {point}, a corner of triangle {neighbor}, is nearer to its power circle than its \
         corners are"
    )]
    Power {
        /// The triangle.
        triangle: usize,
        /// The triangle across its edge.
        neighbor: usize,
        /// The corner of that triangle.
        point: usize,
    },
    /// With weights, a site left out that none of the others hides.
    #[error("point {0} is not a corner of any triangle, and the others do not hide it")]
    Surfaces(usize),
    /// A segment that is not there, or only in part.
    #[error("segment {segment} is missing: from point {point} on no edge runs along it")]
    Segment {
        /// The segment.
        segment: usize,
        /// The corner up to which it is there.
        point: usize,
    },
    /// A border that is not the convex hull.
    #[error("the border is not the convex hull: it turns inwards at point {0}")]
    Dent(usize),
    /// A border of more than one loop, or one that touches itself.
    #[error("the triangles have a hole or fall apart: their border is not one loop (at point {0})")]
    Border(usize),
    /// Triangles that wind around more than once, or are of several pieces.
    #[error("the triangles cover some place more than once or fall apart")]
    Cover,
    /// A point left out.
    #[error("point {0} is not a corner of any triangle")]
    Missing(usize),
}

/// Judges `triangles`, corners as indices of `points`, in either orientation.
pub fn verify2(points: &[[f64; 2]], triangles: &[[u64; 3]]) -> Result<Verdict, Objection2> {
    verify_constrained2(points, &[], triangles)
}

/// Judges whether `triangles`, all of the hull, are a constrained Delaunay triangulation of points and segments, which are given
/// by the indices of their ends. A segment may run along several edges; of equal points any may be named.
///
/// Segments that cross at no vertex are objected to: one of them is missing.
///
/// Cost: O(n log n), and O(log n) for each edge that a segment runs along.
///
/// ```
/// use delone::Constrained2;
/// use delone::verify::verify_constrained2;
///
/// let points = [[0.0, 0.0], [8.0, 0.0], [4.0, 1.0], [4.0, -1.0]];
/// let verdict = verify_constrained2(&points, &[[0, 1]], &[[0, 1, 2], [0, 3, 1]])?;
/// assert!(verdict.is_canonical());
/// let objection = verify_constrained2(&points, &[[0, 1]], &[[0, 3, 2], [3, 1, 2]]).unwrap_err();
/// assert_eq!(objection.to_string(), "segment 0 is missing: from point 0 on no edge runs along it");
/// # Ok::<(), delone::verify::Objection2>(())
/// ```
pub fn verify_constrained2(
    points: &[[f64; 2]],
    segments: &[[usize; 2]],
    triangles: &[[u64; 3]],
) -> Result<Verdict, Objection2> {
    check_finite(points.iter().copied())?;
    let count = points.len();
    for (segment, ends) in segments.iter().enumerate() {
        if let Some(&index) = ends.iter().find(|&&index| index >= count) {
            return Err(Error::NoSuchPoint { segment, index, count }.into());
        }
    }
    let (triangles, clockwise) = oriented(points, triangles)?;
    let (duplicates, corner) = check_coverage(points, &triangles)?;
    if triangles.is_empty() {
        return Ok(Verdict { other_ties: 0, negative: 0, duplicates, hull: 0 });
    }
    let sides = sides(&triangles);
    check_overlap(&sides)?;
    let fixed = segments::fixed_edges(points, segments, &corner, &sides)?;
    let other_ties = check_pairs(&triangles, &sides, &fixed, |[a, b, c], d| {
        let [a, b, c, d] = [a, b, c, d].map(|corner| points[corner]);
        (in_circle_with_ties(a, b, c, d), move || in_circle(a, b, c, d))
    });
    let other_ties =
        other_ties.map_err(|[triangle, neighbor, point]| Objection2::Circle { triangle, neighbor, point })?;
    let hull = check_disk(points, &triangles, &sides)?;
    Ok(Verdict { other_ties, negative: clockwise, duplicates, hull })
}

/// The triangles counter-clockwise, and how many were not.
fn oriented(points: &[[f64; 2]], triangles: &[[u64; 3]]) -> Result<(Vec<[usize; 3]>, usize), Objection2> {
    let mut clockwise = 0;
    let mut result = Vec::with_capacity(triangles.len());
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&corner) = corners.iter().find(|&&corner| corner >= points.len() as u64) {
            return Err(Objection2::Index { triangle, corner, points: points.len() });
        }
        let [a, b, c] = corners.map(|corner| corner as usize);
        result.push(match orient2d(points[a], points[b], points[c]) {
            Sign::Positive => [a, b, c],
            Sign::Zero => return Err(Objection2::Flat(triangle)),
            Sign::Negative => {
                clockwise += 1;
                [a, c, b]
            }
        });
    }
    Ok((result, clockwise))
}

/// Every point is a corner or equals one; without triangles all points must be collinear. Returns the number of
/// points that are no corner, and for each point the corner that is there.
fn check_coverage(points: &[[f64; 2]], triangles: &[[usize; 3]]) -> Result<(usize, Vec<usize>), Objection2> {
    if triangles.is_empty() {
        let mut distinct = points.iter().copied();
        let Some(a) = distinct.next() else { return Ok((0, Vec::new())) };
        let Some(b) = distinct.find(|&p| p != a) else { return Ok((points.len() - 1, Vec::new())) };
        return match points.iter().position(|&c| !orient2d(a, b, c).is_zero()) {
            Some(off) => Err(Objection2::Missing(off)),
            None => Ok((0, Vec::new())),
        };
    }
    let mut used = vec![false; points.len()];
    triangles.as_flattened().iter().for_each(|&corner| used[corner] = true);
    let mut order: Vec<usize> = (0..points.len()).collect();
    sorting::by(&mut order, |&i, &j| lexicographic(points[i], points[j]).then(used[j].cmp(&used[i])));
    let mut duplicates = 0;
    let mut corner: Vec<usize> = (0..points.len()).collect();
    let mut last = None;
    for i in order {
        if used[i] {
            last = Some(i);
        } else if let Some(here) = last.filter(|&last| points[last] == points[i]) {
            corner[i] = here;
            duplicates += 1;
        } else {
            return Err(Objection2::Missing(i));
        }
    }
    Ok((duplicates, corner))
}

/// A side of a triangle: its ends, the smaller index first, whether it runs from the smaller to the larger, and
/// the triangle and corner that it leaves.
type Side = (usize, usize, bool, usize, usize);

/// All sides, those on one edge together.
fn sides(triangles: &[[usize; 3]]) -> Vec<Side> {
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for (t, corners) in triangles.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            sides.push((a.min(b), a.max(b), a < b, t, k));
        }
    }
    sides.sort_unstable();
    sides
}

/// The sides of each edge.
fn edges(sides: &[Side]) -> impl Iterator<Item = &[Side]> {
    sides.chunk_by(|s, t| (s.0, s.1) == (t.0, t.1))
}

/// Each edge has one triangle on each side at most.
fn check_overlap(sides: &[Side]) -> Result<(), Objection2> {
    let same_side = |edge: &[Side]| {
        edge.windows(2).find(|pair| pair[0].2 == pair[1].2).map(|pair| [pair[0].3, pair[1].3])
    };
    match edges(sides).find_map(same_side) {
        Some([first, second]) => Err(Objection2::Overlap(first, second)),
        None => Ok(()),
    }
}

/// Neither triangle at an edge is in conflict with the other's apex, but where the edge is fixed: as a sign, zero for ties, and as one
/// without ties. Returns the number of ties that were broken in another way, or two triangles and the apex of the second.
fn check_pairs<W: FnOnce() -> Sign>(
    triangles: &[[usize; 3]],
    sides: &[Side],
    fixed: &[[usize; 2]],
    conflict: impl Fn([usize; 3], usize) -> (Sign, W),
) -> Result<usize, [usize; 3]> {
    let mut other_ties = 0;
    for edge in edges(sides) {
        let &[(v, w, _, triangle, _), (.., neighbor, k)] = edge else { continue };
        if fixed.binary_search(&[v, w]).is_ok() {
            continue;
        }
        let point = triangles[neighbor][(k + 2) % 3];
        match conflict(triangles[triangle], point) {
            (Sign::Negative, _) => {}
            (Sign::Positive, _) => return Err([triangle, neighbor, point]),
            (Sign::Zero, without_ties) => other_ties += usize::from(without_ties().is_positive()),
        }
    }
    Ok(other_ties)
}

/// The triangles are a disk whose border is the hull. Returns the number of its edges.
fn check_disk(points: &[[f64; 2]], triangles: &[[usize; 3]], sides: &[Side]) -> Result<usize, Objection2> {
    let hull = check_border(points, triangles, sides)?;
    let mut corners: Vec<usize> = triangles.as_flattened().to_vec();
    corners.sort_unstable();
    corners.dedup();
    // V - E + F = 1, where 2 E = 3 F + h.
    if 2 * corners.len() == triangles.len() + hull + 2 { Ok(hull) } else { Err(Objection2::Cover) }
}

/// The edges with one triangle are one convex loop, once around. Returns their number.
fn check_border(points: &[[f64; 2]], triangles: &[[usize; 3]], sides: &[Side]) -> Result<usize, Objection2> {
    let mut next: Vec<(usize, usize)> = Vec::new();
    for edge in edges(sides) {
        if let &[(.., t, k)] = edge {
            next.push((triangles[t][k], triangles[t][(k + 1) % 3]));
        }
    }
    next.sort_unstable();
    if let Some(pair) = next.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        return Err(Objection2::Border(pair[0].0));
    }
    let follow = |v: usize| next.binary_search_by_key(&v, |edge| edge.0).ok().map(|i| next[i].1);
    let Some(&(start, _)) = next.first() else { return Err(Objection2::Cover) };
    let (mut at, mut minima, mut passed) = (start, 0, Vec::new());
    loop {
        let (Some(b), true) = (follow(at), passed.len() <= next.len()) else {
            return Err(Objection2::Border(at));
        };
        let Some(c) = follow(b) else { return Err(Objection2::Border(b)) };
        let [pa, pb, pc] = [at, b, c].map(|v| points[v]);
        let turn = orient2d(pa, pb, pc);
        if turn.is_negative() || (turn.is_zero() && !strictly_between(pa, pc, pb)) {
            return Err(Objection2::Dent(b));
        }
        minima += usize::from(lexicographic(pb, pa).is_lt() && lexicographic(pb, pc).is_lt());
        passed.push(at);
        at = b;
        if at == start {
            break;
        }
    }
    passed.sort_unstable();
    if let Some(&(left_out, _)) = next.iter().find(|edge| passed.binary_search(&edge.0).is_err()) {
        return Err(Objection2::Border(left_out));
    }
    if minima == 1 { Ok(passed.len()) } else { Err(Objection2::Cover) }
}
