//! The proof that triangles, from wherever they come, are the canonical constrained triangulation of points and segments:
//! O(n log n), for millions of points.
//!
//! 1. Triangles are counter-clockwise and no directed edge occurs twice. Those without their reverse are a convex polygon
//!    that goes around once: then every place inside of it is in as many triangles as the polygon goes around it, one.
//! 2. Every point is a corner, and of equal points the first: so the polygon is the hull, and no vertex is inside of an edge.
//! 3. Every segment is a chain of edges: these are the constraints.
//! 4. The far corner across any other edge is outside of the circle.
//!
//! Only one triangulation has these properties (Lee & Lin, "Generalized Delaunay triangulation for planar graphs", DCG 1,
//! 1986, in general position, which the canonical rule gives).

use std::cmp::Ordering;

use crate::exact::Point2;
use crate::quick::{in_circle, orient2d};

/// Why triangles are not the canonical constrained triangulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flaw {
    /// This triangle is not counter-clockwise.
    NotPositive(usize),
    /// A directed edge is in two triangles.
    EdgeTwice([usize; 2]),
    /// The border is not a convex polygon that goes around once; it is not near this point.
    Border(usize),
    /// A point is not a corner, though no earlier one equals it.
    NoCorner(usize),
    /// A corner equals an earlier point.
    Duplicate(usize),
    /// There are no triangles, and not all points are on a line.
    NoTriangle,
    /// A segment does not follow edges from here on.
    NotFollowed {
        /// The segment.
        segment: usize,
        /// The vertex on it where no edge goes on.
        from: usize,
    },
    /// An edge that is no constraint, and the corner on its right inside of the circle of the triangle on its left.
    InCircle {
        /// The edge.
        edge: [usize; 2],
        /// The corners on its left and on its right.
        corners: [usize; 2],
    },
}

/// The constraints that segments make, each edge once with its lesser index first, sorted; or why these triangles are not the
/// canonical triangulation with them.
///
/// # Panics
/// If an index is out of range, or a coordinate not finite.
pub fn certify(
    points: &[Point2],
    segments: &[[usize; 2]],
    triangles: &[[usize; 3]],
) -> Result<Vec<[usize; 2]>, Flaw> {
    let first = first_of_equal(points);
    for (i, &[a, b, c]) in triangles.iter().enumerate() {
        if let Some(&v) = [a, b, c].iter().find(|v| first[**v] != **v) {
            return Err(Flaw::Duplicate(v));
        }
        if orient2d(points[a], points[b], points[c]) <= 0 {
            return Err(Flaw::NotPositive(i));
        }
    }
    let stars = Stars::new(points, triangles)?;
    if triangles.is_empty() {
        let order = on_a_line(points, &first)?;
        return Ok(constraints_on_a_line(&order, &first, segments));
    }
    stars.check_border()?;
    if let Some(v) = (0..points.len()).find(|&v| first[v] == v && stars.of(v).is_empty()) {
        return Err(Flaw::NoCorner(v));
    }
    let constraints = stars.constraints(&first, segments)?;
    stars.check_circles(&constraints)?;
    Ok(constraints)
}

fn order(p: Point2, q: Point2) -> Ordering {
    p.partial_cmp(&q).expect("finite")
}

/// For each point the first that equals it.
fn first_of_equal(points: &[Point2]) -> Vec<usize> {
    let mut sorted: Vec<usize> = (0..points.len()).collect();
    sorted.sort_by(|&i, &j| order(points[i], points[j]));
    let mut first = vec![0; points.len()];
    for equal in sorted.chunk_by(|&i, &j| points[i] == points[j]) {
        // The sort is stable.
        equal.iter().for_each(|&i| first[i] = equal[0]);
    }
    first
}

/// The vertices along the line that all are on.
fn on_a_line(points: &[Point2], first: &[usize]) -> Result<Vec<usize>, Flaw> {
    let mut vertices: Vec<usize> = (0..points.len()).filter(|&v| first[v] == v).collect();
    vertices.sort_by(|&i, &j| order(points[i], points[j]));
    if let [from, .., to] = vertices[..]
        && vertices.iter().any(|&v| orient2d(points[from], points[to], points[v]) != 0)
    {
        return Err(Flaw::NoTriangle);
    }
    Ok(vertices)
}

fn constraints_on_a_line(order: &[usize], first: &[usize], segments: &[[usize; 2]]) -> Vec<[usize; 2]> {
    let mut place = vec![0; first.len()];
    order.iter().enumerate().for_each(|(at, &v)| place[v] = at);
    // How many segments begin less how many end here.
    let mut change = vec![0_isize; order.len() + 1];
    for ends in segments {
        let [a, b] = ends.map(|v| place[first[v]]);
        change[a.min(b)] += 1;
        change[a.max(b)] -= 1;
    }
    let mut open = 0;
    let mut constraints = Vec::new();
    for (link, change) in order.windows(2).zip(change) {
        open += change;
        if open > 0 {
            constraints.push([link[0].min(link[1]), link[0].max(link[1])]);
        }
    }
    constraints.sort_unstable();
    constraints
}

/// An edge as one of its ends has it.
#[derive(Clone, Copy)]
struct Edge {
    to: usize,
    /// The corner on the left; none beyond the hull.
    left: Option<usize>,
}

/// The edges around each vertex, counter-clockwise, in both directions.
struct Stars<'a> {
    points: &'a [Point2],
    starts: Vec<usize>,
    edges: Vec<Edge>,
}

impl<'a> Stars<'a> {
    fn new(points: &'a [Point2], triangles: &[[usize; 3]]) -> Result<Self, Flaw> {
        let sides = |&[a, b, c]: &[usize; 3]| [([a, b], c), ([b, c], a), ([c, a], b)];
        let mut all: Vec<([usize; 2], Option<usize>)> =
            triangles.iter().flat_map(sides).map(|(edge, left)| (edge, Some(left))).collect();
        all.sort_unstable();
        if let Some(pair) = all.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            return Err(Flaw::EdgeTwice(pair[0].0));
        }
        let has = |edge: [usize; 2]| all.binary_search_by_key(&edge, |(edge, _)| *edge).is_ok();
        let border: Vec<_> =
            all.iter().map(|&([a, b], _)| ([b, a], None)).filter(|&(edge, _)| !has(edge)).collect();
        all.extend(border);
        // Counter-clockwise from straight down, which is excluded: first all that is lexicographically larger.
        let around = |v: usize, p: usize, q: usize| {
            let half = |p: usize| order(points[v], points[p]);
            half(p).cmp(&half(q)).then_with(|| orient2d(points[v], points[q], points[p]).cmp(&0))
        };
        all.sort_unstable_by(|&([v, p], _), &([w, q], _)| v.cmp(&w).then_with(|| around(v, p, q)));
        let mut starts = vec![0; points.len() + 1];
        all.iter().for_each(|([v, _], _)| starts[v + 1] += 1);
        (0..points.len()).for_each(|v| starts[v + 1] += starts[v]);
        let edges = all.into_iter().map(|([_, to], left)| Edge { to, left }).collect();
        Ok(Self { points, starts, edges })
    }

    fn of(&self, v: usize) -> &[Edge] {
        &self.edges[self.starts[v]..self.starts[v + 1]]
    }

    /// The edge from a vertex in the direction of another one.
    fn towards(&self, v: usize, target: usize) -> Option<&Edge> {
        let p = self.points;
        let half = |q: usize| order(p[v], p[q]);
        let compare = |edge: &Edge| {
            half(edge.to).cmp(&half(target)).then_with(|| orient2d(p[v], p[target], p[edge.to]).cmp(&0))
        };
        self.of(v).binary_search_by(compare).ok().map(|at| &self.of(v)[at])
    }

    /// The directed edges with nothing on their left go around the hull clockwise, once.
    fn check_border(&self) -> Result<(), Flaw> {
        let p = self.points;
        let beyond = |v: usize| self.of(v).iter().filter(|edge| edge.left.is_none());
        let on_border: Vec<usize> = (0..p.len()).filter(|&v| beyond(v).next().is_some()).collect();
        let Some(&start) = on_border.first() else { return Err(Flaw::Border(0)) };
        let (mut at, mut steps, mut returns) = (start, 0, 0);
        loop {
            let mut next = beyond(at).map(|edge| edge.to);
            let (Some(middle), None) = (next.next(), next.next()) else { return Err(Flaw::Border(at)) };
            let Some(end) = beyond(middle).map(|edge| edge.to).next() else {
                return Err(Flaw::Border(middle));
            };
            let directions = [order(p[at], p[middle]), order(p[middle], p[end])];
            let turn = orient2d(p[at], p[middle], p[end]);
            if turn > 0 || turn == 0 && directions[0] != directions[1] {
                return Err(Flaw::Border(middle));
            }
            returns += usize::from(directions == [Ordering::Greater, Ordering::Less]);
            steps += 1;
            at = middle;
            if at == start {
                break;
            }
            if steps > on_border.len() {
                return Err(Flaw::Border(at));
            }
        }
        if steps != on_border.len() || returns != 1 {
            return Err(Flaw::Border(start));
        }
        Ok(())
    }

    fn constraints(&self, first: &[usize], segments: &[[usize; 2]]) -> Result<Vec<[usize; 2]>, Flaw> {
        let mut constraints = Vec::with_capacity(segments.len());
        for (segment, ends) in segments.iter().enumerate() {
            let [mut from, to] = ends.map(|v| first[v]);
            let ahead = order(self.points[from], self.points[to]);
            while from != to {
                let found = self.towards(from, to);
                // An edge that leads beyond the end has it inside.
                let next = found
                    .filter(|edge| edge.to == to || order(self.points[edge.to], self.points[to]) == ahead);
                let Some(edge) = next else { return Err(Flaw::NotFollowed { segment, from }) };
                constraints.push([from.min(edge.to), from.max(edge.to)]);
                from = edge.to;
            }
        }
        constraints.sort_unstable();
        constraints.dedup();
        Ok(constraints)
    }

    fn check_circles(&self, constraints: &[[usize; 2]]) -> Result<(), Flaw> {
        let p = self.points;
        for a in 0..p.len() {
            for (edge, b) in self.of(a).iter().map(|edge| (edge, edge.to)).filter(|&(_, b)| a < b) {
                let reverse = self.towards(b, a).and_then(|edge| edge.left);
                let (Some(c), Some(d)) = (edge.left, reverse) else { continue };
                if in_circle(p[a], p[b], p[c], p[d]) > 0 && constraints.binary_search(&[a, b]).is_err() {
                    return Err(Flaw::InCircle { edge: [a, b], corners: [c, d] });
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{Flaw, certify};
    use crate::constrained::{constraints, triangulation};
    use crate::exact::Point2;
    use crate::samples::{Numbers, on_lattice};

    type Graph = (Vec<Point2>, Vec<[usize; 2]>, Vec<[usize; 3]>);

    /// Points, segments, and the triangles by definition.
    fn defined(points: Vec<Point2>, segments: Vec<[usize; 2]>) -> Graph {
        let index = |p: Point2| points.iter().position(|q| *q == p).expect("a point");
        let triangles = triangulation(&points, &segments).into_iter().map(|t| t.map(index)).collect();
        (points, segments, triangles)
    }

    #[test]
    fn what_the_definition_gives_is_right_and_all_else_is_wrong() {
        let mut numbers = Numbers(5);
        for round in 0..300 {
            let (points, segments) = on_lattice(2 + round % 6, &mut numbers);
            let (points, segments, triangles) = defined(points, segments);
            let edges = certify(&points, &segments, &triangles).expect("by definition");
            let mut pieces: Vec<[Point2; 2]> = edges.iter().map(|edge| edge.map(|v| points[v])).collect();
            pieces.iter_mut().for_each(|piece| piece.sort_by(|p, q| p.partial_cmp(q).expect("finite")));
            pieces.sort_by(|p, q| p.partial_cmp(q).expect("finite"));
            assert_eq!(pieces, constraints(&points, &segments));
            if triangles.is_empty() {
                continue;
            }
            let (at, k) = (numbers.below(triangles.len()), numbers.below(3));
            let mut fewer = triangles.clone();
            fewer.remove(at);
            assert!(certify(&points, &segments, &fewer).is_err());
            let mut more = triangles.clone();
            more.push(triangles[at]);
            assert!(matches!(certify(&points, &segments, &more), Err(Flaw::EdgeTwice(_))));
            let mut turned = triangles.clone();
            turned[at].reverse();
            assert_eq!(certify(&points, &segments, &turned), Err(Flaw::NotPositive(at)));
            let mut other = triangles.clone();
            other[at][k] = numbers.below(points.len());
            let kept = other[at][k] == triangles[at][k];
            assert_eq!(certify(&points, &segments, &other).is_ok(), kept);
            // An edge flipped, if it can be.
            let [a, b, c] = triangles[at];
            let twin = triangles.iter().position(|&[d, e, f]| [[d, e], [e, f], [f, d]].contains(&[b, a]));
            if let Some(twin) = twin {
                let d = triangles[twin].into_iter().find(|v| ![a, b].contains(v)).expect("a corner");
                let mut flipped = triangles.clone();
                (flipped[at], flipped[twin]) = ([a, d, c], [d, b, c]);
                assert!(certify(&points, &segments, &flipped).is_err());
            }
        }
    }

    #[test]
    fn a_flipped_square_needs_its_diagonal() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let flipped = [[0, 1, 2], [0, 2, 3]];
        assert_eq!(certify(&square, &[[2, 0]], &flipped), Ok(vec![[0, 2]]));
        let wrong = Flaw::InCircle { edge: [0, 2], corners: [3, 1] };
        assert_eq!(certify(&square, &[], &flipped), Err(wrong));
        let missing = Flaw::NotFollowed { segment: 0, from: 0 };
        assert_eq!(certify(&square, &[[0, 2]], &[[0, 1, 3], [1, 2, 3]]), Err(missing));
    }

    #[test]
    fn twice_around_is_no_hull() {
        // Two squares in one another, each of two triangles: each is a border of its own.
        let points = [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0], [2.0, 1.0], [5.0, 2.0], [4.0, 5.0]];
        let triangles = [[0, 1, 3], [1, 2, 3], [4, 5, 6]];
        assert!(matches!(certify(&points, &[], &triangles), Err(Flaw::Border(_))));
        assert_eq!(certify(&points, &[], &triangles[..2]), Err(Flaw::NoCorner(4)));
        let pentagram = [[10.0, 0.0], [3.0, 9.0], [-8.0, 6.0], [-8.0, -6.0], [3.0, -9.0], [0.0, 0.0]];
        let star = [[0, 2, 5], [2, 4, 5], [4, 1, 5], [1, 3, 5], [3, 0, 5]];
        assert!(matches!(certify(&pentagram, &[], &star), Err(Flaw::Border(_))));
    }

    #[test]
    fn points_on_a_line_have_constraints() {
        let points = [[3.0, 3.0], [0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [1.0, 1.0]];
        assert_eq!(certify(&points, &[[4, 0], [3, 0], [1, 1]], &[]), Ok(vec![[0, 3], [2, 3]]));
        assert_eq!(certify(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], &[], &[]), Err(Flaw::NoTriangle));
        assert_eq!(certify(&[], &[], &[]), Ok(vec![]));
    }
}
