//! The Gabriel graph among neighbors, in any dimension.
//!
//! If a vertex is in the closed ball with diameter ab, so is one that forms a triangle with the edge ab: the ball's
//! center is in the face of the Voronoi diagram that parts a and b unless one that cuts this face out is as near, and under the
//! canonical rule those that do are joined with both. So the neighbors of one end are enough.
//!
//! Cost: the sum of squared degrees at worst, and few tests an edge where it is none of the graph.

use std::ops::Range;

use delone_predicates::in_diametral_ball;

use super::net::Net;
use crate::ids::Place;

pub(super) fn edges<const D: usize>(net: &Net<D>) -> Vec<[Place; 2]> {
    net.gather(|ranks: Range<u32>| {
        let mut edges = Vec::new();
        for v in ranks {
            let (a, around) = (net.point(v), net.neighbors(v));
            for &w in around.iter().filter(|&&w| w > v) {
                let b = net.point(w);
                if !around.iter().any(|&c| c != w && in_diametral_ball(*a, *b, *net.point(c))) {
                    edges.push([v, w]);
                }
            }
        }
        edges
    })
}
