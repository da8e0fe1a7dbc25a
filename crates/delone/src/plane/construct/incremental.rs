//! Incremental construction in spatial order: walk from the previous point, refill its cavity.
//!
//! Independent of divide and conquer in everything but the predicates, so each judges the other. Source:
//! Amenta, Choi & Rote, "Incremental constructions con BRIO", SoCG 2003. Cost: O(n log n) expected for any
//! input, by the randomness of the order; on evenly spread points O(n) after sorting.

use crate::duplicates::settle;
use crate::ids::{Duplicate, Place};
use crate::locate::{Start, Walk};
use crate::mesh::Mesh2;
use crate::order;
use crate::tally::Tally;

use crate::plane::layer::Layer;
use crate::plane::layer::insert::Spot;

/// Triangulates points, all finite and at most [`crate::MAX_POINTS`], and gives them back.
pub(super) fn triangulate<T: Tally>(
    points: Vec<[f64; 2]>,
    seed: u64,
    tally: &mut T,
) -> (Vec<[f64; 2]>, Mesh2, Vec<Duplicate>) {
    let order = order::plane::insertion_order(&points, seed);
    let mut layer: Layer = Layer::new(Mesh2::empty(points.len()), points);
    layer.mesh.edges.reserve_exact(8 * layer.points.len().saturating_sub(1));
    let mut duplicates = Vec::new();
    let mut start = Start::Anywhere;
    for index in order {
        let v = Place::new(index as usize);
        let at = match layer.spot(start, layer.points[v.index()], tally).0 {
            Spot::Vertex(w) => {
                // The first of equal points given is their vertex.
                let (first, later) = (v.min(w), v.max(w));
                if later == w {
                    layer.rename(w, v);
                }
                duplicates.push(Duplicate { point: later.index(), vertex: first.same() });
                first
            }
            spot => {
                layer.insert_at(v, spot, tally);
                v
            }
        };
        if layer.mesh.lone.is_none() {
            start = Start::At(layer.mesh.incident[at.index()], Walk::Visibility);
        }
    }
    settle(&mut duplicates);
    (layer.points, layer.mesh, duplicates)
}

#[cfg(test)]
mod tests {
    use crate::{Algorithm2, Delaunay2};

    /// Whatever the order in which they come.
    #[test]
    fn the_first_of_equal_points_is_their_vertex() {
        let (a, b, c, d) = ([0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [1.0, 1.0]);
        let sets: [(&[[f64; 2]], &[usize]); 4] = [
            (&[a, a, a], &[0]),
            (&[a, b, b, a], &[0, 1]),
            (&[a, d, d, [2.0, 2.0], a], &[0, 1, 3]),
            (&[a, b, a, c, b, d, d, c, a], &[0, 1, 3, 5]),
        ];
        for (points, vertices) in sets {
            for seed in 0..30 {
                let d = Delaunay2::with_algorithm(points, Algorithm2::Incremental { seed }).expect("finite");
                let found: Vec<usize> = d.vertices().map(|v| v.index()).collect();
                assert_eq!(found, vertices, "{points:?}, seed {seed}");
                assert_eq!(d.check(), Ok(()), "{points:?}, seed {seed}");
                let equals = d.duplicates().map(|equal| (equal.point, equal.vertex.index()));
                let first = |i: usize| (i, points.iter().position(|p| *p == points[i]).expect("itself"));
                let expected = (0..points.len()).filter(|i| !vertices.contains(i)).map(first);
                assert!(equals.eq(expected), "{points:?}, seed {seed}");
            }
        }
    }
}
