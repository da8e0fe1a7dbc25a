//! A vertex leaves the Delaunay tree: what is left is the tree of the others in the order in which they came.
//!
//! Source: after Devillers, Meiser & Teillaud, "Fully dynamic Delaunay triangulation in logarithmic expected time per
//! operation", CGTA 1992: the later sites whose nodes hang on those of the vertex are inserted again, there alone.
//!
//! The nodes with the vertex p as a corner, its *star* in the course of time, go. In their place comes the *fill*: at each
//! time the triangulation of the inside of the star's border without p. At first it is what p killed. A later site x changes
//! it only if x killed or made a node of the star, or made a node on its border. The fill's nodes in conflict with x die.
//! Across a facet of the border there are a node of the fill, one of the star, and one outside: what of them x killed, and
//! what not, says whether x has made a node there that only loses a parent, or makes one that was not there because of p.
//!
//! Cost: for each such x the size of the fill then: O(1) expected for a random vertex of a random order in the plane, where a
//! vertex has 18 nodes in the course of time on average. A vertex of the first simplex, one of three among all, costs a new
//! tree: O(n log n), O(log n) expected if what is removed does not hang on the random order.

use std::collections::{BTreeMap, BTreeSet};

use super::{DelaunayTree, Facet, NONE, Simplices};

/// A facet of a node: the node, and the corner across.
type Side = (u32, usize);

/// What the time of the vertex is lived again with.
struct Fill<const N: usize> {
    /// All nodes of the star, ever.
    star: BTreeSet<u32>,
    /// The present ones by their facet of the border.
    border: BTreeMap<Facet<N>, u32>,
    /// Those of the fill.
    nodes: Vec<u32>,
}

impl<P: Copy + PartialEq, const N: usize> DelaunayTree<P, N> {
    /// Removes a site that is not one of the first.
    pub(super) fn remove<G: Simplices<N, Point = P>>(&mut self, p: u32) {
        let star = self.star(p);
        let mut fill = Fill { star, border: BTreeMap::new(), nodes: self.killed_by(p) };
        for &t in &fill.nodes {
            self.nodes[t as usize].killer = NONE;
        }
        self.turn(p, p, &mut fill);
        let children = fill.star.iter().flat_map(|&t| &self.nodes[t as usize].children);
        let makers = fill.star.iter().chain(children).map(|&t| self.nodes[t as usize].maker);
        let changes: BTreeMap<u64, u32> =
            makers.filter(|&x| x != p).map(|x| (self.sites[x as usize].time, x)).collect();
        for x in changes.into_values() {
            self.replay::<G>(p, x, &mut fill);
        }
        self.close(p, &fill);
        self.forget(p, &fill);
    }

    /// All nodes that ever had a site as a corner: those that it made, and what hangs on them.
    fn star(&self, p: u32) -> BTreeSet<u32> {
        let mut star = BTreeSet::new();
        let mut pending = self.sites[p as usize].made.clone();
        while let Some(t) = pending.pop() {
            if star.insert(t) {
                let children = self.nodes[t as usize].children.iter().copied();
                pending.extend(children.filter(|&c| self.nodes[c as usize].corner(p).is_some()));
            }
        }
        star
    }

    /// The nodes that a site killed, which are connected.
    fn killed_by(&self, p: u32) -> Vec<u32> {
        let mut killed = BTreeSet::new();
        let fathers = self.sites[p as usize].made.iter().map(|&t| self.nodes[t as usize].parents[0]);
        let mut pending: Vec<u32> = fathers.collect();
        while let Some(t) = pending.pop() {
            if killed.insert(t) {
                let around = self.nodes[t as usize].neighbors.into_iter();
                pending.extend(around.filter(|&u| self.nodes[u as usize].killer == p));
            }
        }
        killed.into_iter().collect()
    }

    /// The star of p as the site x leaves it.
    fn turn(&self, p: u32, x: u32, fill: &mut Fill<N>) {
        fill.border.retain(|_, t| self.nodes[*t as usize].killer != x);
        for &t in &self.sites[x as usize].made {
            if let Some(k) = self.nodes[t as usize].corner(p) {
                fill.border.insert(self.facet(t, k), t);
            }
        }
    }

    /// The facets of the fill, each with one side on its border, or two.
    fn facets(&self, fill: &Fill<N>) -> BTreeMap<Facet<N>, Vec<Side>> {
        let mut facets: BTreeMap<Facet<N>, Vec<Side>> = BTreeMap::new();
        for &t in &fill.nodes {
            for k in 0..N {
                facets.entry(self.facet(t, k)).or_default().push((t, k));
            }
        }
        facets
    }

    /// What is across a facet of the border outside, when the site x comes: the node of the star, the node outside.
    fn outside(&self, p: u32, x: Option<u32>, facet: &Facet<N>, fill: &Fill<N>) -> Option<(u32, Side)> {
        let s = *fill.border.get(facet)?;
        let k = self.nodes[s as usize].corner(p)?;
        let mut o = self.nodes[s as usize].neighbors[k];
        // It may have got its place from others since, each from its father.
        let is_later = |t: u32| {
            let maker = self.nodes[t as usize].maker;
            let time = |s: u32| self.sites[s as usize].time;
            maker != NONE && x.is_some_and(|x| time(maker) >= time(x))
        };
        while is_later(o) {
            o = self.nodes[o as usize].parents[0];
        }
        let j = (0..N).find(|&j| self.facet(o, j) == *facet)?;
        Some((s, (o, j)))
    }

    /// Inserts the site x again, in the fill.
    fn replay<G: Simplices<N, Point = P>>(&mut self, p: u32, x: u32, fill: &mut Fill<N>) {
        let q = self.sites[x as usize].point;
        for &t in &fill.nodes {
            if self.is_hit::<G>(t, q) {
                self.nodes[t as usize].killer = x;
            }
        }
        let mut new = Vec::new();
        for (facet, sides) in self.facets(fill) {
            let inner @ (d, k) = sides[0];
            let is_dead = |tree: &Self, t: u32| tree.nodes[t as usize].killer == x;
            if let Some(&other) = sides.get(1) {
                self.meet(inner, other);
                match (is_dead(self, d), is_dead(self, other.0)) {
                    (true, false) => new.push(self.bear(x, d, k, other.0)),
                    (false, true) => new.push(self.bear(x, other.0, other.1, d)),
                    _ => {}
                }
                continue;
            }
            let Some((s, outer @ (o, j))) = self.outside(p, Some(x), &facet, fill) else {
                debug_assert!(false, "the fill and the star have one border");
                continue;
            };
            if is_dead(self, d) {
                self.nodes[d as usize].neighbors[k] = o;
            }
            if is_dead(self, o) {
                self.nodes[o as usize].neighbors[j] = d;
            }
            let (father, step) = match (is_dead(self, d), is_dead(self, o)) {
                (true, false) => (inner, outer),
                (false, true) => (outer, inner),
                _ => continue,
            };
            // On this facet x has made a node, if one of the two nodes at it with p lived, and the other died.
            if is_dead(self, s) == is_dead(self, d) {
                let made = self.nodes[s as usize].children.iter().copied().find(|&c| {
                    self.nodes[c as usize].maker == x && (0..N).any(|i| self.facet(c, i) == facet)
                });
                let Some(made) = made else {
                    debug_assert!(false, "a node of the border between dead and living");
                    continue;
                };
                self.nodes[made as usize].parents[usize::from(step == inner)] = d;
                self.nodes[d as usize].children.push(made);
            } else {
                new.push(self.bear(x, father.0, father.1, step.0));
            }
        }
        fill.nodes.retain(|&t| self.nodes[t as usize].killer != x);
        fill.nodes.append(&mut new);
        self.turn(p, x, fill);
    }

    /// Makes two sides of a facet neighbours.
    fn meet(&mut self, (t, k): Side, (u, j): Side) {
        self.nodes[t as usize].neighbors[k] = u;
        self.nodes[u as usize].neighbors[j] = t;
    }

    /// Glues the fill of today to what is around.
    fn close(&mut self, p: u32, fill: &Fill<N>) {
        for (facet, sides) in self.facets(fill) {
            let across = sides.get(1).copied();
            let across = across.or_else(|| Some(self.outside(p, None, &facet, fill)?.1));
            if let Some(across) = across {
                self.meet(sides[0], across);
            }
        }
    }

    /// Gives back the star and the site.
    fn forget(&mut self, p: u32, fill: &Fill<N>) {
        for &t in &fill.star {
            let node = &mut self.nodes[t as usize];
            let (parents, maker) = (node.parents, node.maker);
            (node.children, node.corners) = (Vec::new(), [NONE; N]);
            if maker != p {
                self.sites[maker as usize].made.retain(|&other| other != t);
            }
            for parent in parents.into_iter().filter(|parent| !fill.star.contains(parent)) {
                self.nodes[parent as usize].children.retain(|&child| child != t);
            }
        }
        self.free_nodes.extend(&fill.star);
        let site = &mut self.sites[p as usize];
        self.site_at[site.place.index()] = NONE;
        site.made = Vec::new();
        self.free_sites.push(p);
    }
}
