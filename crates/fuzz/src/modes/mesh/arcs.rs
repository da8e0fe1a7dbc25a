//! Segments that are chords of random arcs, many of which cross: it ends, with a triangulation whose elements of second order are not inverted.

use std::collections::BTreeMap;

use delone::{Arc2, Constrained2, Error, Fill, Refined2, SegmentId, Triangulation, VertexId};
use delone_generators::Random;
use delone_oracle::exact::orient2d;
use num_bigint::BigInt;

use super::change;
use super::wish::Wish;
use crate::attack::Judgement;
use crate::nasty::once_in;
use crate::oracle::exact::{Vector, integers};

type Point = [f64; 2];

/// Arcs over some of the segments, by which new vertices on them are judged too.
fn arcs(c: &Constrained2, random: &mut Random) -> Vec<(SegmentId, Point)> {
    let mut arcs = Vec::new();
    for (s, ends) in c.segments() {
        if once_in(random, 3) {
            continue;
        }
        let [p, q] = ends.map(|v| c.point(v));
        let rise = random.between(-1.5, 1.5) * 8f64.powi(random.below(6) as i32);
        let center = [p[0].midpoint(q[0]) - rise * (q[1] - p[1]), p[1].midpoint(q[1]) + rise * (q[0] - p[0])];
        if Arc2::new([p, q], center).is_ok() {
            arcs.push((s, center));
        }
    }
    arcs
}

/// Six nodes of a triangle: the corners, and the middles of the sides from each to the next.
fn nodes(c: &Constrained2, corners: [VertexId; 3], middles: &BTreeMap<[VertexId; 2], Point>) -> [Point; 6] {
    let p = corners.map(|v| c.point(v));
    let middle = |i: usize, j: usize| {
        let ends = [corners[i].min(corners[j]), corners[i].max(corners[j])];
        middles.get(&ends).copied().unwrap_or([0, 1].map(|k| p[i][k].midpoint(p[j][k])))
    };
    [p[0], p[1], p[2], middle(0, 1), middle(1, 2), middle(2, 0)]
}

/// Whether the Jacobian is positive at the corners and the middles of the sides, by the shape functions, times 4 and without a fraction.
fn is_positive(nodes: &[Point; 6]) -> bool {
    let n: Vec<Vector> = integers(nodes);
    let at = |[l, m]: [i32; 2]| {
        let k = 2 - l - m;
        let along_l = [2 - 4 * k, 4 * l - 2, 0, 4 * (k - l), 4 * m, -4 * m];
        let along_m = [2 - 4 * k, 0, 4 * m - 2, -4 * l, 4 * l, 4 * (k - m)];
        let sum = |w: &[i32; 6], axis: usize| w.iter().zip(&n).map(|(w, p)| &p[axis] * *w).sum::<BigInt>();
        sum(&along_l, 0) * sum(&along_m, 1) - sum(&along_l, 1) * sum(&along_m, 0)
    };
    [[0, 0], [2, 0], [0, 2], [1, 0], [1, 1], [0, 1]].into_iter().all(|place| at(place) > BigInt::ZERO)
}

fn judge(c: &Constrained2, refined: &Refined2, arcs: &[(SegmentId, Point)]) -> Judgement {
    c.check().map_err(|flaw| flaw.to_string())?;
    let middles = refined.arc_middles(c, arcs).map_err(|error| error.to_string())?;
    let middles: BTreeMap<_, _> = middles.into_iter().collect();
    for t in c.triangle_ids().filter(|&t| refined.domains.is_inside(t)) {
        let corners = c.corners(t);
        let nodes = nodes(c, corners, &middles);
        if orient2d(nodes[0], nodes[1], nodes[2]) <= 0 {
            return Err(format!("{corners:?} is not counter-clockwise"));
        }
        let is_curved = (0..3).any(|k| {
            let [v, w] = [corners[k], corners[(k + 1) % 3]];
            middles.contains_key(&[v.min(w), v.max(w)])
        });
        if is_curved && !is_positive(&nodes) {
            return Err(format!("{nodes:?} is inverted"));
        }
    }
    Ok(())
}

/// Refines along arcs, twice.
pub(super) fn attack(before: &Constrained2, wish: &Wish, again: &Wish, random: &mut Random) -> Judgement {
    let arcs = arcs(before, random);
    let mut c = before.clone();
    let first = wish.clone().along(arcs.clone());
    let Some(refined) = refine(&mut c, &first, first.fill(), &arcs)? else { return Ok(()) };
    let more = again.clone().along(arcs.clone());
    refine(&mut c, &more, Fill::Parts(&refined.domains), &arcs)?;
    change(&mut c, before.points().len(), random)
}

fn refine(
    c: &mut Constrained2,
    wish: &Wish,
    fill: Fill,
    arcs: &[(SegmentId, Point)],
) -> Result<Option<Refined2>, String> {
    let count = c.vertex_count();
    match wish.run(c, fill) {
        Ok(refined) => judge(c, &refined, arcs).map(|()| Some(refined)),
        Err(Error::Arc { segment, problem }) if c.vertex_count() != count => {
            Err(format!("segment {segment}: {problem}, after vertices came"))
        }
        Err(_) => c.check().map(|()| None).map_err(|flaw| flaw.to_string()),
    }
}
