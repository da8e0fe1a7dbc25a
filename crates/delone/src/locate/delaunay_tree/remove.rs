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
//! Cost: O(k log k) for k nodes of the star in the course of time, their children, and what x kills and makes in the fill: O(1)
//! expected for a random vertex of a random order in the plane, where k is 18 on average. A vertex of the first simplex, one of
//! three among all, costs a new tree: O(n log n), O(log n) expected if what is removed does not hang on the random order.

use std::collections::{BTreeMap, BTreeSet};

use super::{DelaunayTree, Facet, NONE, Simplices};

/// A facet of a node: the node, and the corner across.
type Side = (u32, usize);

/// The state of a removal, in which the time since the vertex came is replayed.
struct Fill<const N: usize> {
    /// All nodes of the star, ever.
    star: BTreeSet<u32>,
    /// The present ones by their facet of the border.
    border: BTreeMap<Facet<N>, u32>,
    /// The facets of the nodes of the fill, each with one side on its border, or two.
    facets: BTreeMap<Facet<N>, Vec<Side>>,
}

impl<P: Copy + PartialEq, const N: usize> DelaunayTree<P, N> {
    /// Removes a site that is not one of the first.
    pub(super) fn remove<G: Simplices<N, Point = P>>(&mut self, p: u32) {
        let mut fill = Fill { star: self.star(p), border: BTreeMap::new(), facets: BTreeMap::new() };
        for t in self.killed_by(p) {
            self.nodes[t as usize].killer = NONE;
            self.enter(t, &mut fill);
        }
        // For each later site what it had to do with the star: by time, the site, and the nodes that it killed or made others on.
        let mut changes: BTreeMap<u64, (u32, Vec<u32>)> = BTreeMap::new();
        for &t in &fill.star {
            let node = &self.nodes[t as usize];
            let makers = node.children.iter().map(|&child| self.nodes[child as usize].maker);
            for x in makers.chain([node.killer]).filter(|&x| x != NONE) {
                let touched = &mut changes.entry(self.sites[x as usize].time).or_insert((x, Vec::new())).1;
                if touched.last() != Some(&t) {
                    touched.push(t);
                }
            }
        }
        self.turn(p, p, &[], &mut fill);
        for (x, touched) in changes.into_values() {
            self.replay::<G>(p, x, &touched, &mut fill);
        }
        self.close(p, &fill);
        self.forget(p, &fill);
    }

    /// A node of the fill comes.
    fn enter(&self, t: u32, fill: &mut Fill<N>) {
        for k in 0..N {
            fill.facets.entry(self.facet(t, k)).or_default().push((t, k));
        }
    }

    /// A node of the fill goes.
    fn leave(&self, t: u32, fill: &mut Fill<N>) {
        for k in 0..N {
            let facet = self.facet(t, k);
            if let Some(sides) = fill.facets.get_mut(&facet) {
                sides.retain(|side| side.0 != t);
                if sides.is_empty() {
                    fill.facets.remove(&facet);
                }
            }
        }
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

    /// The border of the star of p as the site x leaves it, which killed some of these nodes of the star.
    fn turn(&self, p: u32, x: u32, touched: &[u32], fill: &mut Fill<N>) {
        for &t in touched.iter().filter(|t| self.nodes[**t as usize].killer == x) {
            if let Some(k) = self.nodes[t as usize].corner(p) {
                fill.border.remove(&self.facet(t, k));
            }
        }
        for &t in &self.sites[x as usize].made {
            if let Some(k) = self.nodes[t as usize].corner(p) {
                fill.border.insert(self.facet(t, k), t);
            }
        }
    }

    /// The node outside across a facet of the border, at the time of site x: `p` is the node of the star.
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

    /// The nodes of the fill in conflict with the site x die: all are found from where x killed the star. Returns them, and the
    /// facets at which something may have changed.
    fn kill<G: Simplices<N, Point = P>>(
        &mut self,
        p: u32,
        x: u32,
        touched: &[u32],
        fill: &Fill<N>,
    ) -> (Vec<u32>, BTreeSet<Facet<N>>) {
        let q = self.sites[x as usize].point;
        let corner = |t: u32| self.nodes[t as usize].corner(p).map(|k| self.facet(t, k));
        let mut facets: BTreeSet<Facet<N>> = touched.iter().filter_map(|&t| corner(t)).collect();
        let mut pending: Vec<Facet<N>> = facets.iter().copied().collect();
        let mut dead = Vec::new();
        while let Some(facet) = pending.pop() {
            for &(t, _) in fill.facets.get(&facet).into_iter().flatten() {
                if self.nodes[t as usize].killer != x && self.is_hit::<G>(t, q) {
                    self.nodes[t as usize].killer = x;
                    dead.push(t);
                    let around = (0..N).map(|k| self.facet(t, k));
                    pending.extend(around.filter(|&facet| facets.insert(facet)));
                }
            }
        }
        (dead, facets)
    }

    /// Inserts the site x again, in the fill.
    fn replay<G: Simplices<N, Point = P>>(&mut self, p: u32, x: u32, touched: &[u32], fill: &mut Fill<N>) {
        let (dead, facets) = self.kill::<G>(p, x, touched, fill);
        let mut new = Vec::new();
        for facet in facets {
            let Some(sides) = fill.facets.get(&facet) else {
                debug_assert!(false, "what the star has on its border, the fill has");
                continue;
            };
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
        dead.into_iter().for_each(|t| self.leave(t, fill));
        new.into_iter().for_each(|t| self.enter(t, fill));
        self.turn(p, x, touched, fill);
    }

    /// Makes two sides of a facet neighbors.
    fn meet(&mut self, (t, k): Side, (u, j): Side) {
        self.nodes[t as usize].neighbors[k] = u;
        self.nodes[u as usize].neighbors[j] = t;
    }

    /// Glues the fill of today to what is around.
    fn close(&mut self, p: u32, fill: &Fill<N>) {
        for (facet, sides) in &fill.facets {
            let across = sides.get(1).copied();
            let across = across.or_else(|| Some(self.outside(p, None, facet, fill)?.1));
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
