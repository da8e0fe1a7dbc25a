//! Ridges and regions in space, from tetrahedra and their neighbors.

use std::convert::Infallible;
use std::ops::Range;

use super::{Ragged, Ridges};
use crate::pool::{SERIAL_ITEMS, shared};

/// The ridges across edges: around each edge the vertices in turn, equal ones once, and -1 where the ring is open. Those of fewer than
/// three are left out. On all threads that there are, in parts that are joined in their order.
pub fn ridges(corners: &[[i32; 4]], across: &[[i32; 4]], which: &[i32]) -> Ridges {
    let mesh = Rows { corners, across };
    let parts: Vec<Range<usize>> = (0..corners.len())
        .step_by(SERIAL_ITEMS)
        .map(|start| start..corners.len().min(start + SERIAL_ITEMS))
        .collect();
    let Ok(parts) = shared(&parts, 1, |part| Ok::<_, Infallible>(ridges_from(&mesh, part.clone(), which)));
    let mut all = Ridges { pairs: Vec::new(), vertices: Ragged::new() };
    for part in parts {
        all.pairs.extend(part.pairs);
        all.vertices.extend(&part.vertices);
    }
    all
}

/// Ridges across the edges whose first tetrahedron is in a range.
fn ridges_from(mesh: &Rows, tetrahedra: Range<usize>, which: &[i32]) -> Ridges {
    let (mut pairs, mut vertices) = (Vec::new(), Ragged::new());
    let mut ring = Vec::new();
    for t in tetrahedra {
        let corners = mesh.corners[t];
        for (i, j) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
            let Some(is_open) = mesh.turn(t, [corners[i], corners[j]], &mut ring) else { continue };
            for vertex in ring.iter().map(|&t| which[t]).chain(is_open.then_some(-1)) {
                vertices.push_new(i64::from(vertex));
            }
            vertices.close();
            let count = vertices.row().len();
            if count < 3 {
                vertices.items.truncate(vertices.items.len() - count);
            } else {
                pairs.push([corners[i].min(corners[j]), corners[i].max(corners[j])]);
                vertices.end_row();
            }
        }
    }
    Ridges { pairs, vertices }
}

/// The vertices of the ridges of each of so many points, increasing; infinity, -1, first.
pub fn regions(points: usize, pairs: &[[i32; 2]], starts: &[i64], vertices: &[i64], regions: &mut Ragged) {
    // The ridges of each point, one point after the other.
    let mut ends = vec![0; points + 1];
    for &point in pairs.as_flattened() {
        ends[point as usize + 1] += 1;
    }
    for point in 0..points {
        ends[point + 1] += ends[point];
    }
    let mut ridges = vec![0; 2 * pairs.len()];
    // Filled from the start of each, which becomes its end.
    for (ridge, pair) in pairs.iter().enumerate() {
        for &point in pair {
            let place = &mut ends[point as usize];
            ridges[*place] = ridge;
            *place += 1;
        }
    }
    // For each vertex the last point that has met it.
    let most = vertices.iter().copied().max().unwrap_or(-1);
    let mut met_by = vec![usize::MAX; (most + 2) as usize];
    regions.starts.reserve(points);
    let mut start = 0;
    for (point, &end) in ends[..points].iter().enumerate() {
        let first = regions.items.len();
        for &ridge in &ridges[start..end] {
            for &vertex in &vertices[starts[ridge] as usize..starts[ridge + 1] as usize] {
                let met = &mut met_by[(vertex + 1) as usize];
                if *met != point {
                    *met = point;
                    regions.items.push(vertex);
                }
            }
        }
        start = end;
        regions.items[first..].sort_unstable();
        regions.end_row();
    }
}

/// Tetrahedra by rows.
struct Rows<'a> {
    corners: &'a [[i32; 4]],
    across: &'a [[i32; 4]],
}

impl Rows<'_> {
    /// The tetrahedra around an edge in turn, and whether both ends are on the hull. `None` unless the first given is the
    /// smallest of them, so that each edge is met once.
    fn turn(&self, first: usize, edge: [i32; 2], ring: &mut Vec<usize>) -> Option<bool> {
        ring.clear();
        ring.push(first);
        let mut others = (0..4).filter(|&k| !edge.contains(&self.corners[first][k]));
        let (a, b) = (others.next()?, others.next()?);
        if [a, b].iter().any(|&k| (0..first as i32).contains(&self.across[first][k])) {
            return None;
        }
        let is_open = self.go(first, a, edge, ring)?;
        if is_open {
            // The other way round from the first.
            ring.reverse();
            self.go(first, b, edge, ring)?;
        }
        Some(is_open)
    }

    /// Goes on around an edge across from corner `k` of a tetrahedron, to its beginning or to the hull; says which.
    fn go(&self, first: usize, mut k: usize, edge: [i32; 2], ring: &mut Vec<usize>) -> Option<bool> {
        let mut t = first;
        loop {
            let next = self.across[t][k];
            let Ok(next) = usize::try_from(next) else { return Some(true) };
            if next == first {
                return Some(false);
            }
            if next < first {
                return None;
            }
            // It is entered across from its one corner that is new; it is left across from the other of the facet.
            let shared = (0..4).find(|&i| {
                let corner = self.corners[next][i];
                !edge.contains(&corner) && self.corners[t].contains(&corner)
            })?;
            (t, k) = (next, shared);
            ring.push(t);
            // Neighbors that somebody has written may go around something else for ever.
            if ring.len() > self.corners.len() {
                return None;
            }
        }
    }
}
