//! Meshes for the table: refined, from given triangles, made coarser, along arcs.

use std::collections::BTreeSet;

use delone::{
    AllQuads2, Constrained2, Crossings, Delaunay2, Error, Fill, Quads2, Refinement, SegmentId, VertexId,
};

use super::{Outcome, Set, order};

/// Segments between points that are neighbors in their order along a line: some cross.
pub(super) fn segments(set: &Set<2>) -> Vec<[usize; 2]> {
    let mut by_sum: Vec<usize> = (0..set.points.len()).collect();
    by_sum.sort_by(|&i, &j| {
        let [p, q] = [i, j].map(|i| set.points[i]);
        (p[0] + p[1] / 4.0).total_cmp(&(q[0] + q[1] / 4.0)).then(order(&[p], &[q]))
    });
    by_sum.dedup_by_key(|i| set.points[*i].map(f64::to_bits));
    by_sum
        .chunks_exact(5)
        .map(|five| [five[0], five[3]])
        .filter(|[i, j]| set.points[*i] != set.points[*j])
        .collect()
}

pub(super) fn refined(set: &Set<2>, how: Refinement<'_>) -> Outcome<2> {
    let mut c =
        Constrained2::with_crossings(&set.points, &segments(set), Crossings::Split).expect("segments");
    let refined = how.fill(Fill::All).max_vertices(3000).run(&mut c).expect("a mesh");
    let mut outcome = Outcome::default();
    for t in c.triangle_ids() {
        outcome.set(c.mesh().corners(t).map(|v| c.point(v)).to_vec());
    }
    outcome.measure(&[], refined.report.smallest_angle, 0);
    outcome.measure(&[], refined.report.left.len() as f64, 0);
    outcome
}

/// A mesh along arcs over the segments, each on the side away from a query. Many arcs cross.
pub(super) fn curved(set: &Set<2>, how: Refinement<'_>) -> Outcome<2> {
    let ends = segments(set);
    let mut c = Constrained2::with_crossings(&set.points, &ends, Crossings::Split).expect("segments");
    let center = |[i, j]: [usize; 2]| {
        let (p, q) = (set.points[i], set.points[j]);
        let (d, away) = ([0, 1].map(|k| q[k] - p[k]), [0, 1].map(|k| set.queries[0][k] - p[k]));
        let side = if d[0] * away[1] - d[1] * away[0] > 0.0 { 1.0 } else { -1.0 };
        [p[0].midpoint(q[0]) - side * d[1], p[1].midpoint(q[1]) + side * d[0]]
    };
    let mut arcs: Vec<(SegmentId, [f64; 2])> = Vec::new();
    let mut seen = BTreeSet::new();
    for (s, &ends) in ends.iter().enumerate() {
        let is_new = seen.insert(ends.map(|i| set.points[i].map(f64::to_bits)));
        arcs.extend(is_new.then(|| (SegmentId::new(s), center(ends))));
    }
    let how = how.fill(Fill::All).max_vertices(3000).arcs(&arcs);
    let mut outcome = Outcome::default();
    match how.run(&mut c) {
        Ok(refined) => {
            c.check().expect("a triangulation");
            c.triangles().for_each(|t| outcome.set(t.map(|v| c.point(v)).to_vec()));
            for (ends, middle) in refined.arc_middles(&c, &arcs).expect("arcs") {
                outcome.set(vec![c.point(ends[0]), c.point(ends[1]), middle]);
            }
        }
        Err(error) => assert!(matches!(error, Error::Arc { .. }), "{error}"),
    }
    outcome
}

/// Triangles that are Delaunay where everything leans, and so are not Delaunay here.
fn leaning(set: &Set<2>) -> Vec<[VertexId; 3]> {
    let leaning: Vec<[f64; 2]> = set.points.iter().map(|[x, y]| [x + 2.0 * y, *y]).collect();
    Delaunay2::from_points(&leaning).expect("finite").triangles().collect()
}

/// A mesh of triangles that are given. Coordinates that lean are rounded, so that it may be refused.
pub(super) fn kept(set: &Set<2>, how: Refinement<'_>) -> Outcome<2> {
    let mut c = Constrained2::from_parts(&set.points, &[]).expect("finite");
    let mut outcome = Outcome::default();
    match how.max_vertices(3000).triangles(&leaning(set)).run(&mut c) {
        Ok(_) => c.triangles().for_each(|t| outcome.set(t.map(|v| c.point(v)).to_vec())),
        Err(error) => assert!(matches!(error, Error::KeptTriangle { .. }), "{error}"),
    }
    outcome
}

/// A mesh, made coarser, in quadrilaterals and the triangles that are left, and in quadrilaterals alone.
pub(super) fn coarse(set: &Set<2>) -> Outcome<2> {
    let mut c = Constrained2::from_parts(&set.points, &[]).expect("finite");
    let fine = Refinement::new().max_area(set.unit * set.unit / 512.0).max_vertices(3000);
    let refined = fine.run(&mut c).expect("a mesh");
    let coarse = refined.coarsen(&mut c, &|_| true, 20.0).expect("as it was");
    let (quads, mut outcome) = (Quads2::of(&c, &coarse), Outcome::default());
    quads.corners.iter().for_each(|corners| outcome.set(corners.map(|v| c.point(v)).to_vec()));
    let corners = quads.triangles.iter().map(|&t| c.mesh().corners(t));
    corners.for_each(|corners| outcome.set(corners.map(|v| c.point(v)).to_vec()));
    let mut all = AllQuads2::of(&c, &quads);
    (0..all.corners.len()).for_each(|row| outcome.set(all.places(row).to_vec()));
    all.smooth(&c, &coarse, 2);
    outcome.measure(&[], all.angles().map_or(0.0, |angles| angles[0].round()), 0);
    outcome
}
