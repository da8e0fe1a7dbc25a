//! The Euclidean minimum spanning tree, in any dimension.
//!
//! Source: Borůvka 1926. In each round every part of the forest takes the first edge that leaves it, in one strict order of all
//! edges: so no rings close, and the tree is the only one. Edges inside of a part are left out of the next round. The parts are
//! numbered in the order in which the edges, which lie along a curve, come to them: so a round reads memory nearly in order.
//!
//! Cost: O(log n) rounds at most, as each halves the number of parts; on evenly spread points rounds get shorter so fast that
//! all together are O(n).

use delone_predicates::{Length, compare_lengths};

use crate::ids::Place;
use crate::parallel;
use crate::sets::Sets;

/// No edge, and no part.
const NONE: u32 = u32::MAX;

/// An edge between two parts of the forest.
#[derive(Clone, Copy)]
struct Link {
    parts: [u32; 2],
    length: Length,
    /// Its index among all edges.
    edge: u32,
}

/// The edges of the tree of a connected graph, in no special order.
pub(super) fn edges<const D: usize>(points: &[[f64; D]], graph: Vec<[Place; 2]>) -> Vec<[Place; 2]> {
    let ends = |edge: u32| graph[edge as usize].map(|v| points[v.index()]);
    let exact_order = |one: &Link, other: &Link| {
        let [one, other] = [one, other].map(|link| ends(link.edge));
        compare_lengths(one, other).then_with(|| in_order(one).partial_cmp(&in_order(other)).expect("finite"))
    };
    let mut numbers = Numbers::of(points.len());
    let mut links: Vec<Link> = parallel::collect(graph.len(), |i| {
        let [a, b] = graph[i].map(|v| v.index());
        Link { parts: [a as u32, b as u32], length: Length::between(&points[a], &points[b]), edge: i as u32 }
    });
    links.iter_mut().for_each(|link| link.parts = link.parts.map(|place| numbers.of_next(place)));
    let mut tree = Vec::new();
    while !links.is_empty() {
        let parts = numbers.count as usize;
        // Lengths beside, because that of the first edge so far is asked for again and again.
        let mut first = vec![(NONE, Length::default()); parts];
        for (i, link) in links.iter().enumerate() {
            for part in link.parts {
                let (best, length) = &mut first[part as usize];
                let is_before = |best: u32| match link.length.compare(*length) {
                    Some(order) => order.is_lt(),
                    None => exact_order(link, &links[best as usize]).is_lt(),
                };
                if *best == NONE || is_before(*best) {
                    (*best, *length) = (i as u32, link.length);
                }
            }
        }
        let mut sets = Sets::new(parts);
        for &(i, _) in first.iter().filter(|&&(i, _)| i != NONE) {
            let link = links[i as usize];
            if sets.join(link.parts[0], link.parts[1]) {
                tree.push(graph[link.edge as usize]);
            }
        }
        numbers = Numbers::of(parts);
        links.retain_mut(|link| {
            let roots = link.parts.map(|part| sets.find(part));
            if roots[0] != roots[1] {
                link.parts = roots.map(|root| numbers.of_next(root));
            }
            roots[0] != roots[1]
        });
    }
    tree
}

/// New numbers of parts, from 0 in the order in which they are asked for.
struct Numbers {
    new: Vec<u32>,
    count: u32,
}

impl Numbers {
    fn of(parts: usize) -> Self {
        Self { new: vec![NONE; parts], count: 0 }
    }

    fn of_next(&mut self, part: u32) -> u32 {
        let number = &mut self.new[part as usize];
        if *number == NONE {
            *number = self.count;
            self.count += 1;
        }
        *number
    }
}

/// The ends of an edge, the lexicographically smaller first.
fn in_order<const D: usize>([a, b]: [[f64; D]; 2]) -> [[f64; D]; 2] {
    if a <= b { [a, b] } else { [b, a] }
}
