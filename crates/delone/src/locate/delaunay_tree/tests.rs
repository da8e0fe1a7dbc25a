//! A tree after removals against the one that grows without what was removed.

use std::collections::BTreeSet;

use super::{DelaunayTree, GHOST, NONE, Simplices};
use crate::ids::Place;
use crate::order::random::SplitMix;

/// A node by places: its corners; who made and who killed it; its parents, and what is across from its corners.
type Known = (Vec<usize>, [usize; 2], [Vec<usize>; 2], BTreeSet<Vec<usize>>);

impl<P: Copy + PartialEq, const N: usize> DelaunayTree<P, N> {
    fn known(&self) -> BTreeSet<Known> {
        let place = |s: u32| if s == GHOST { usize::MAX } else { self.sites[s as usize].place.index() };
        let corners = |t: u32| {
            let mut corners: Vec<usize> = match self.nodes.get(t as usize) {
                Some(node) => node.corners.map(place).to_vec(),
                None => Vec::new(),
            };
            corners.sort_unstable();
            corners
        };
        let used = (0..self.nodes.len() as u32).filter(|t| !self.free_nodes.contains(t));
        used.map(|t| {
            let node = &self.nodes[t as usize];
            for &c in &node.children {
                assert!(self.nodes[c as usize].parents.contains(&t), "a child knows its parents");
            }
            for parent in node.parents.into_iter().filter(|&parent| parent != NONE) {
                let times = self.nodes[parent as usize].children.iter().filter(|c| **c == t).count();
                assert_eq!(times, 1, "a parent knows its child, once");
            }
            let across = node.neighbors.iter().map(|&u| corners(u)).collect();
            (corners(t), [node.maker, node.killer].map(place), node.parents.map(corners), across)
        })
        .collect()
    }
}

/// Removes vertices in random order until the first simplex is left, compares each time, and searches.
pub(crate) fn forgets<G: Simplices<N>, const N: usize>(ground: &G, queries: &[G::Point], what: &str) {
    let mut random = SplitMix(queries.len() as u64);
    let mut order: Vec<Place> = ground.inhabited().collect();
    random.shuffle(&mut order);
    let mut tree = DelaunayTree::<G::Point, N>::build(ground);
    tree.grow(ground, &order);
    for _ in 0..order.len() {
        let Some(root) = tree.root else { return };
        let root = root.map(|s| tree.sites[s as usize].place);
        let others: Vec<Place> = order.iter().copied().filter(|v| !root.contains(v)).collect();
        if others.is_empty() {
            return;
        }
        let v = others[random.below(others.len())];
        order.retain(|w| *w != v);
        tree.remove::<G>(tree.site_at[v.index()]);
        let mut without = DelaunayTree::<G::Point, N>::build(ground);
        without.grow(ground, &order);
        assert!(tree.known() == without.known(), "{what}, {} left", order.len());
        assert_eq!(tree.count(), without.count());
        for &q in queries {
            let found = tree.search::<G, _>(q, &mut ()).expect("whatever is asked, there is a conflict");
            let is_present = tree.nodes[found as usize].killer == NONE && tree.is_hit::<G>(found, q);
            assert!(is_present || tree.corner_at(found, q).is_some(), "{what}");
        }
    }
}
