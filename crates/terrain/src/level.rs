//! Level polygons: which triangles are in which of them, and at what height.
//!
//! One search from the outside over the parts that lines cut the plane into: across a border one enters or leaves the polygons whose it is.
//! So polygons may overlap, touch, and be given twice; where several are, the lowest counts.
//!
//! Cost: O(n) for n triangles, and for each edge of a border how many polygons there are at once.

use delone::{Constrained2, Fill, SegmentId, TriangleId, VertexId};

/// A triangle and its height.
pub(crate) type Level = ([VertexId; 3], f64);

/// The triangles in level polygons. `bounds` has for each segment the polygon that it bounds, `levels` the height of each polygon.
pub(crate) fn level_triangles(
    c: &Constrained2,
    bounds: &[Option<u32>],
    levels: &[f64],
) -> Result<Vec<Level>, delone::Error> {
    let parts = c.domains(&Fill::All)?;
    let outside = parts.parts().len();
    let part = |t: TriangleId| parts.part(t).unwrap_or(outside);
    let mut ways: Vec<Vec<(usize, Vec<u32>)>> = vec![Vec::new(); outside + 1];
    for t in c.triangle_ids() {
        for e in [0, 1, 2].map(|k| t.edge(k)) {
            let [from, to] = [t, c.mesh().twin(e).triangle()].map(part);
            // The outside is the last: each border is met once.
            if from < to {
                let of_segment = |s: SegmentId| bounds.get(s.index()).copied().flatten();
                let polygons: Vec<u32> =
                    c.covering(e).iter().filter_map(|over| of_segment(over.segment)).collect();
                ways[from].push((to, polygons.clone()));
                ways[to].push((from, polygons));
            }
        }
    }
    let mut within: Vec<Option<Vec<u32>>> = vec![None; outside + 1];
    within[outside] = Some(Vec::new());
    let mut pending = vec![outside];
    while let Some(from) = pending.pop() {
        for (to, polygons) in &ways[from] {
            if within[*to].is_none() {
                let mut around = within[from].clone().unwrap_or_default();
                polygons.iter().for_each(|&polygon| toggle(&mut around, polygon));
                within[*to] = Some(around);
                pending.push(*to);
            }
        }
    }
    let lowest = |around: &Option<Vec<u32>>| {
        around.iter().flatten().map(|&polygon| levels[polygon as usize]).min_by(f64::total_cmp)
    };
    let of_part: Vec<Option<f64>> = within.iter().map(lowest).collect();
    let level = |t: TriangleId| of_part[part(t)].map(|height| (c.mesh().corners(t), height));
    Ok(c.triangle_ids().filter_map(level).collect())
}

fn toggle(around: &mut Vec<u32>, polygon: u32) {
    match around.iter().position(|&other| other == polygon) {
        Some(k) => _ = around.swap_remove(k),
        None => around.push(polygon),
    }
}
