//! Judging tetrahedra from elsewhere: are they a Delaunay triangulation of these points, and are they *the* canonical
//! one?
//!
//! Nothing is believed. Tetrahedra that are in positive order, glued in pairs across facets, with a connected border
//! that is convex at every edge and goes around every vertex once, cover the hull everywhere equally often (their boundary is that of the hull); so it is enough
//! that one point is covered once, and that they add up to a ball. Then empty spheres across facets make all spheres empty. All is proved with exact
//! predicates. Cost: O(n log n).

mod weights;

use delone_predicates::{
    Sign, are_collinear3, in_sphere, in_sphere_with_ties, lexicographic3, orient2d, orient3d,
};

use crate::error::Error;
use crate::mesh::tetrahedra::FACETS;
use crate::points::check_in_space;
use crate::sorting;
use crate::space::check::goes_once;
use crate::verdict::Verdict;
pub use weights::verify_weighted3;

/// Why tetrahedra are not a Delaunay triangulation of the points. Tetrahedra and points are named by their index.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Objection3 {
    /// The points themselves are not valid.
    #[error(transparent)]
    Points(#[from] Error),
    /// A corner that no point has.
    #[error("tetrahedron {tetrahedron} has the corner {corner}, but there are {points} points")]
    Index {
        /// The tetrahedron.
        tetrahedron: usize,
        /// Its corner.
        corner: u64,
        /// The number of points.
        points: usize,
    },
    /// Four coplanar corners.
    #[error("tetrahedron {0} is flat: its corners are coplanar")]
    Flat(usize),
    /// Two tetrahedra on the same side of a facet, or more than two at one.
    #[error("tetrahedra {0} and {1} overlap: they lie on the same side of a common facet")]
    Overlap(usize, usize),
    /// The facet rule fails.
    #[error(
        "tetrahedron {tetrahedron} is not Delaunay: its sphere contains point {point}, a corner of tetrahedron {neighbor}"
    )]
    Sphere {
        /// The tetrahedron.
        tetrahedron: usize,
        /// The tetrahedron across its facet.
        neighbor: usize,
        /// The corner of that tetrahedron inside the sphere.
        point: usize,
    },
    /// A tetrahedron with weights: the power of a site is less than that of the corners.
    #[error(
        "tetrahedron {tetrahedron} is not regular: point {point}, a corner of tetrahedron {neighbor}, is nearer to its power sphere \
         than its corners are"
    )]
    Power {
        /// The tetrahedron.
        tetrahedron: usize,
        /// The tetrahedron across its facet.
        neighbor: usize,
        /// The corner of that tetrahedron.
        point: usize,
    },
    /// With weights, a site left out that none of the others hides.
    #[error("point {0} is not a corner of any tetrahedron, and the others do not hide it")]
    Surfaces(usize),
    /// A border that is not the convex hull.
    #[error("the border is not the convex hull: it turns inwards at the edge of points {0} and {1}")]
    Dent(usize, usize),
    /// A border that is no closed surface, or more than one.
    #[error(
        "the tetrahedra have a hole or fall apart: their border is not one closed surface (at point {0})"
    )]
    Border(usize),
    /// Tetrahedra that lie over each other, or are glued into something that is no ball.
    #[error("the tetrahedra cover some place {0} times, or are glued into something that is no ball")]
    Cover(usize),
    /// A point left out.
    #[error("point {0} is not a corner of any tetrahedron")]
    Missing(usize),
}

/// A facet of a tetrahedron: its corners in increasing order, whether that is an even permutation of what is seen from
/// inside, the tetrahedron and the corner across.
type Side = ([usize; 3], bool, usize, usize);

/// Judges `tetrahedra`, corners as indices of `points`, in either order.
pub fn verify3(points: &[[f64; 3]], tetrahedra: &[[u64; 4]]) -> Result<Verdict, Objection3> {
    check_in_space(points)?;
    let (tetrahedra, negative) = oriented(points, tetrahedra)?;
    let duplicates = check_coverage(points, &tetrahedra)?;
    if tetrahedra.is_empty() {
        return Ok(Verdict { other_ties: 0, negative, duplicates, hull: 0 });
    }
    let sides = sides(&tetrahedra)?;
    let other_ties = check_pairs(&tetrahedra, &sides, |[a, b, c, d], e| {
        let [a, b, c, d, e] = [a, b, c, d, e].map(|corner| points[corner]);
        (in_sphere_with_ties(a, b, c, d, e), move || in_sphere(a, b, c, d, e))
    });
    let sphere =
        |[tetrahedron, neighbor, point]: [usize; 3]| Objection3::Sphere { tetrahedron, neighbor, point };
    let other_ties = other_ties.map_err(sphere)?;
    let hull = check_once(points, &tetrahedra, &sides)?;
    Ok(Verdict { other_ties, negative, duplicates, hull })
}

/// The tetrahedra are a ball whose border is the hull. Returns the number of its facets.
fn check_once(points: &[[f64; 3]], tetrahedra: &[[usize; 4]], sides: &[Side]) -> Result<usize, Objection3> {
    let hull = check_border(points, sides)?;
    match cover(points, tetrahedra) {
        Some(1) | None if is_ball(tetrahedra, hull) => Ok(hull),
        times => Err(Objection3::Cover(times.unwrap_or(0))),
    }
}

/// The tetrahedra in positive order, and how many were not.
fn oriented(points: &[[f64; 3]], tetrahedra: &[[u64; 4]]) -> Result<(Vec<[usize; 4]>, usize), Objection3> {
    let mut negative = 0;
    let mut result = Vec::with_capacity(tetrahedra.len());
    for (tetrahedron, corners) in tetrahedra.iter().enumerate() {
        if let Some(&corner) = corners.iter().find(|&&corner| corner >= points.len() as u64) {
            return Err(Objection3::Index { tetrahedron, corner, points: points.len() });
        }
        let [a, b, c, d] = corners.map(|corner| corner as usize);
        result.push(match orient3d(points[a], points[b], points[c], points[d]) {
            Sign::Positive => [a, b, c, d],
            Sign::Zero => return Err(Objection3::Flat(tetrahedron)),
            Sign::Negative => {
                negative += 1;
                [b, a, c, d]
            }
        });
    }
    Ok((result, negative))
}

/// Every point is a corner or equals one; without tetrahedra all points must be coplanar. Returns the number of points
/// that are no corner.
fn check_coverage(points: &[[f64; 3]], tetrahedra: &[[usize; 4]]) -> Result<usize, Objection3> {
    if tetrahedra.is_empty() {
        let Some(&a) = points.first() else { return Ok(0) };
        let Some(&b) = points.iter().find(|&&p| p != a) else { return Ok(points.len() - 1) };
        let Some(&c) = points.iter().find(|&&p| !are_collinear3(a, b, p)) else { return Ok(0) };
        let off = points.iter().position(|&d| !orient3d(a, b, c, d).is_zero());
        return off.map_or(Ok(0), |off| Err(Objection3::Missing(off)));
    }
    let mut used = vec![false; points.len()];
    tetrahedra.as_flattened().iter().for_each(|&corner| used[corner] = true);
    let mut order: Vec<usize> = (0..points.len()).collect();
    sorting::by(&mut order, |&i, &j| lexicographic3(points[i], points[j]).then(used[j].cmp(&used[i])));
    let mut duplicates = 0;
    let mut corner = None;
    for i in order {
        if used[i] {
            corner = Some(points[i]);
        } else if corner == Some(points[i]) {
            duplicates += 1;
        } else {
            return Err(Objection3::Missing(i));
        }
    }
    Ok(duplicates)
}

fn side(corners: [usize; 4], t: usize, k: usize) -> Side {
    let seen = FACETS[k].map(|i| corners[i]);
    let mut sorted = seen;
    sorted.sort_unstable();
    let [a, b, c] = sorted;
    let even = [[a, b, c], [b, c, a], [c, a, b]].contains(&seen);
    (sorted, even, t, k)
}

/// All sides, those on one facet together: of one tetrahedron on each side at most.
fn sides(tetrahedra: &[[usize; 4]]) -> Result<Vec<Side>, Objection3> {
    let mut sides: Vec<Side> =
        (0..tetrahedra.len()).flat_map(|t| [0, 1, 2, 3].map(|k| side(tetrahedra[t], t, k))).collect();
    sides.sort_unstable();
    let same_side = |pair: &&[Side]| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1);
    match sides.windows(2).find(same_side) {
        Some(pair) => Err(Objection3::Overlap(pair[0].2, pair[1].2)),
        None => Ok(sides),
    }
}

/// Neither tetrahedron at a facet is in conflict with the other's apex: as a sign, zero for ties, and as one without ties. Returns the
/// number of ties that were broken in another way, or two tetrahedra and the apex of the second.
fn check_pairs<W: FnOnce() -> Sign>(
    tetrahedra: &[[usize; 4]],
    sides: &[Side],
    conflict: impl Fn([usize; 4], usize) -> (Sign, W),
) -> Result<usize, [usize; 3]> {
    let mut other_ties = 0;
    for facet in sides.chunk_by(|s, t| s.0 == t.0) {
        let &[(_, _, tetrahedron, _), (_, _, neighbor, k)] = facet else { continue };
        let point = tetrahedra[neighbor][k];
        match conflict(tetrahedra[tetrahedron], point) {
            (Sign::Negative, _) => {}
            (Sign::Positive, _) => return Err([tetrahedron, neighbor, point]),
            (Sign::Zero, without_ties) => other_ties += usize::from(without_ties().is_positive()),
        }
    }
    Ok(other_ties)
}

/// The facets with one tetrahedron are one closed surface that turns inwards nowhere. Returns their number.
fn check_border(points: &[[f64; 3]], sides: &[Side]) -> Result<usize, Objection3> {
    let lone = sides.chunk_by(|s, t| s.0 == t.0).filter(|facet| facet.len() == 1).map(|facet| facet[0]);
    // Counter-clockwise seen from outside.
    let facets: Vec<[usize; 3]> =
        lone.map(|([a, b, c], even, ..)| if even { [a, c, b] } else { [a, b, c] }).collect();
    let mut edges: Vec<(usize, usize, usize)> = Vec::with_capacity(3 * facets.len());
    for (f, &[a, b, c]) in facets.iter().enumerate() {
        edges.extend([(a, b, f), (b, c, f), (c, a, f)]);
    }
    edges.sort_unstable();
    if let Some(pair) = edges.windows(2).find(|pair| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1)) {
        return Err(Objection3::Border(pair[0].0));
    }
    let across = |a: usize, b: usize| {
        let found = edges.binary_search_by_key(&(b, a), |edge| (edge.0, edge.1));
        found.map(|i| edges[i].2).map_err(|_| Objection3::Border(a))
    };
    let mut met = vec![false; facets.len()];
    let mut pending = vec![0];
    met[0] = true;
    while let Some(f) = pending.pop() {
        let [a, b, c] = facets[f];
        for (u, v, w) in [(a, b, c), (b, c, a), (c, a, b)] {
            let g = across(u, v)?;
            let tip = facets[g].into_iter().find(|w| ![u, v].contains(w)).unwrap_or(u);
            let side = orient3d(points[a], points[b], points[c], points[tip]);
            if side.is_positive() || (side.is_zero() && is_folded([u, v, w, tip].map(|i| points[i]))) {
                return Err(Objection3::Dent(u, v));
            }
            if !std::mem::replace(&mut met[g], true) {
                pending.push(g);
            }
        }
    }
    if let Some(f) = met.iter().position(|met| !met) {
        return Err(Objection3::Border(facets[f][0]));
    }
    // Convex at edges it may still wind around a vertex more than once.
    let mut fans: Vec<(usize, usize)> =
        facets.iter().enumerate().flat_map(|(f, facet)| facet.map(|v| (v, f))).collect();
    fans.sort_unstable();
    let mut link = Vec::new();
    for fan in fans.chunk_by(|one, other| one.0 == other.0) {
        let (v, first) = fan[0];
        let mut f = first;
        link.clear();
        loop {
            let i = facets[f].iter().position(|&w| w == v).unwrap_or_default();
            link.push(points[facets[f][(i + 1) % 3]]);
            f = across(facets[f][(i + 2) % 3], v)?;
            if f == first || link.len() > fan.len() {
                break;
            }
        }
        if link.len() != fan.len() {
            return Err(Objection3::Border(v));
        }
        if !goes_once(points[v], &link) {
            return Err(Objection3::Cover(2));
        }
    }
    Ok(facets.len())
}

/// Whether coplanar triangles at an edge, with the corners w and x across it, lie over each other: on the same side of the edge, as
/// seen along an axis along which the plane is not seen from the side.
fn is_folded([u, v, w, x]: [[f64; 3]; 4]) -> bool {
    let seen = |axis: usize| {
        let [u, v, w, x] = [u, v, w, x].map(|p| [p[(axis + 1) % 3], p[(axis + 2) % 3]]);
        Some((orient2d(u, v, w), orient2d(u, v, x))).filter(|(w, _)| !w.is_zero())
    };
    (0..3).find_map(seen).is_none_or(|(w, x)| w * x != Sign::Negative)
}

/// Whether corners, edges, facets and tetrahedra add up as those of a ball do.
fn is_ball(tetrahedra: &[[usize; 4]], hull: usize) -> bool {
    let distinct = |mut of: Vec<[usize; 2]>| {
        of.sort_unstable();
        of.dedup();
        of.len() as i64
    };
    let pairs = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    let edge = |t: &[usize; 4], [i, j]: [usize; 2]| [t[i].min(t[j]), t[i].max(t[j])];
    let edges = distinct(tetrahedra.iter().flat_map(|t| pairs.map(|pair| edge(t, pair))).collect());
    let corners = distinct(tetrahedra.iter().flatten().map(|&corner| [corner; 2]).collect());
    // V - E + F - T = 1, where 2 F = 4 T + h.
    2 * (corners - edges) + 2 * tetrahedra.len() as i64 + hull as i64 == 2
}

/// How many tetrahedra cover a point that is on the border of none; `None` where no such point was found, as when the
/// first tetrahedron is too thin for any `f64` inside of it.
fn cover(points: &[[f64; 3]], tetrahedra: &[[usize; 4]]) -> Option<usize> {
    let corners = tetrahedra[0].map(|corner| points[corner]);
    (0..16).find_map(|step| {
        // Near the middle of it.
        let aside = f64::from(step) / 128.0;
        let shares = [0.25 + aside, 0.25 - aside / 2.0, 0.25 - aside / 3.0, 0.25 - aside / 6.0];
        let q = [0, 1, 2].map(|axis| (0..4).map(|k| corners[k][axis] * shares[k]).sum::<f64>());
        let mut count = 0;
        for t in tetrahedra {
            let signs = FACETS.map(|facet| {
                let [a, b, c] = facet.map(|i| points[t[i]]);
                orient3d(a, b, c, q)
            });
            if signs.iter().all(|sign| !sign.is_negative()) {
                if signs.iter().any(|sign| sign.is_zero()) {
                    return None;
                }
                count += 1;
            }
        }
        (count > 0).then_some(count)
    })
}
