//! Delaunay tree: all triangles that ever were, found by their circles.
//!
//! Source: Boissonnat & Teillaud, "A hierarchical representation of objects: the Delaunay tree", SoCG 1986, which Guibas, Knuth
//! & Sharir (Algorithmica 1992, §3) name as the first history. A new site kills the triangles in conflict with it; each new
//! triangle, on an edge of the border of that cavity, hangs on two: the dead one on the inner side of the edge, its *father*,
//! and the one outside, its *stepfather*. Its circle is covered by theirs, so whoever is in conflict with a triangle is with
//! one of its parents, and all triangles in conflict with a point are found from the first ones. A search follows them to the
//! first present one. Removal (in [`remove`]) leaves the tree that would be there had the vertex never come.
//!
//! One code serves the plane and space: facets are edges or triangles. Orders are random where the tree is built; later sites
//! follow as they come. As long as the sites do not span the space there is no tree, and walks start at the last vertex.
//!
//! Cost in the plane, expected over random orders: O(n) memory, about 86 bytes a triangle, and O(log n) conflict tests a
//! search. Then the triangle is looked up around all of its corners at once, and a walk goes through triangles in conflict with the
//! query, which are as many at most as its neighbors would be. In space as many tetrahedra as ever were.

mod remove;

use std::collections::BTreeMap;

use super::from_last::FromLast;
use super::{Ground, Start, Strategy};
use crate::ids::Place;
use crate::order::random::SplitMix;
use crate::tally::Tally;

/// The geometry as the tree sees it: `N` corners make a triangle or a tetrahedron.
pub(crate) trait Simplices<const N: usize>: Ground {
    /// Whether a point is in the circle of corners in positive order, one of which may be at infinity. All of `root` is in
    /// the hull.
    fn is_in_circle(corners: [Option<Self::Point>; N], root: &[Self::Point; N], q: Self::Point) -> bool;

    /// The first two points, and further ones that span the space with them, in positive order.
    fn first(points: &[Self::Point]) -> Option<[usize; N]>;

    /// A hint in the triangle, or tetrahedron, of some vertices, or on their hull edge; in space at one of them.
    fn hint_at<T: Tally>(&self, corners: &[Place], _tally: &mut T) -> Self::Hint {
        corners.first().map_or(Self::NOWHERE, |&v| self.hint(v))
    }
}

/// The site at infinity; no node.
const GHOST: u32 = u32::MAX;
const NONE: u32 = u32::MAX;

/// A facet: the sites of its corners in order, and one that is none.
type Facet<const N: usize> = [u32; N];

#[derive(Clone, Debug)]
struct Node<const N: usize> {
    corners: [u32; N],
    /// Across from each corner, now or when it was killed.
    neighbors: [u32; N],
    /// Father and stepfather; none of the first nodes.
    parents: [u32; 2],
    children: Vec<u32>,
    /// The site that made it; none of the first nodes.
    maker: u32,
    /// The site that killed it, if it is dead.
    killer: u32,
}

#[derive(Clone, Debug)]
struct Site<P> {
    point: P,
    place: Place,
    /// Later sites have greater times.
    time: u64,
    /// The nodes that it made.
    made: Vec<u32>,
}

/// See the module.
#[derive(Clone, Debug)]
pub(crate) struct DelaunayTree<P, const N: usize> {
    nodes: Vec<Node<N>>,
    free_nodes: Vec<u32>,
    sites: Vec<Site<P>>,
    free_sites: Vec<u32>,
    /// For each place its site.
    site_at: Vec<u32>,
    /// The sites of the first simplex, if there is a tree; its nodes are the first `N + 1`.
    root: Option<[u32; N]>,
    clock: u64,
    /// For sites that do not span the space.
    below: FromLast,
}

impl<P: Copy + PartialEq, const N: usize> DelaunayTree<P, N> {
    /// The tree of the vertices that there are.
    pub(crate) fn build<G: Simplices<N, Point = P>>(ground: &G) -> Self {
        let mut tree = Self {
            nodes: Vec::new(),
            free_nodes: Vec::new(),
            sites: Vec::new(),
            free_sites: Vec::new(),
            site_at: Vec::new(),
            root: None,
            clock: 0,
            below: FromLast::default(),
        };
        if ground.is_spanned() {
            tree.plant(ground, |_| true);
        }
        tree
    }

    /// Makes the tree of some vertices anew, in another random order each time: whoever removes vertices does not know which
    /// are the first.
    fn plant<G: Simplices<N, Point = P>>(&mut self, ground: &G, is_site: impl Fn(Place) -> bool) {
        let mut order: Vec<Place> = ground.inhabited().filter(|&v| is_site(v)).collect();
        SplitMix(self.clock).shuffle(&mut order);
        self.grow(ground, &order);
    }

    /// Makes the tree of vertices in their order, but for the first simplex.
    fn grow<G: Simplices<N, Point = P>>(&mut self, ground: &G, order: &[Place]) {
        self.nodes.clear();
        self.free_nodes.clear();
        self.sites.clear();
        self.free_sites.clear();
        self.root = None;
        let points: Vec<P> = order.iter().map(|&v| ground.point(v)).collect();
        let Some(first) = G::first(&points) else { return };
        let root = first.map(|i| self.new_site(order[i], points[i]));
        self.root = Some(root);
        self.nodes.push(Node::new(root, [NONE; 2], NONE));
        for k in 0..N {
            let mut corners = root;
            corners[k] = GHOST;
            corners.swap((k + 1) % N, (k + 2) % N);
            self.nodes.push(Node::new(corners, [NONE; 2], NONE));
        }
        let mut facets = BTreeMap::new();
        (0..=N as u32).for_each(|t| (0..N).for_each(|k| self.glue(t, k, &mut facets)));
        for (i, &v) in order.iter().enumerate().filter(|(i, _)| !first.contains(i)) {
            if let Some(t) = self.search::<G, _>(points[i], &mut ()) {
                self.add::<G>(v, points[i], t);
            }
        }
    }

    fn new_site(&mut self, place: Place, point: P) -> u32 {
        self.clock += 1;
        let site = Site { point, place, time: self.clock, made: Vec::new() };
        let s = put(&mut self.sites, &mut self.free_sites, site);
        if self.site_at.len() <= place.index() {
            self.site_at.resize(place.index() + 1, NONE);
        }
        self.site_at[place.index()] = s;
        s
    }

    /// The facet of a node across from a corner.
    fn facet(&self, t: u32, k: usize) -> Facet<N> {
        let mut facet = self.nodes[t as usize].corners;
        facet[k] = NONE - 1;
        facet.sort_unstable();
        facet
    }

    /// Makes a facet and the one that equals it neighbors, as soon as both have come.
    fn glue(&mut self, t: u32, k: usize, open: &mut BTreeMap<Facet<N>, (u32, usize)>) {
        let facet = self.facet(t, k);
        match open.remove(&facet) {
            Some((u, j)) => {
                self.nodes[t as usize].neighbors[k] = u;
                self.nodes[u as usize].neighbors[j] = t;
            }
            None => _ = open.insert(facet, (t, k)),
        }
    }

    fn is_hit<G: Simplices<N, Point = P>>(&self, t: u32, q: P) -> bool {
        let point = |s: u32| (s != GHOST).then(|| self.sites[s as usize].point);
        let root = self.root.unwrap_or([0; N]).map(|s| self.sites[s as usize].point);
        G::is_in_circle(self.nodes[t as usize].corners.map(point), &root, q)
    }

    /// A present node in conflict with a point, or some node with a corner at it, if there is a tree.
    fn search<G: Simplices<N, Point = P>, T: Tally>(&self, q: P, tally: &mut T) -> Option<u32> {
        self.root?;
        let is_hit = |t: u32, tally: &mut T| {
            tally.in_circle();
            self.is_hit::<G>(t, q)
        };
        let first = 0..=N as u32;
        let found = first.clone().find(|&t| self.corner_at(t, q).is_some());
        if found.is_some() {
            return found;
        }
        let mut pending: Vec<u32> = first.filter(|&t| is_hit(t, tally)).collect();
        while let Some(t) = pending.pop() {
            tally.visited();
            let node = &self.nodes[t as usize];
            if node.killer == NONE {
                return Some(t);
            }
            for &child in &node.children {
                if self.corner_at(child, q).is_some() {
                    return Some(child);
                }
                // From its father, unless that is not in conflict: no node is come to twice.
                let father = self.nodes[child as usize].parents[0];
                if is_hit(child, tally) && (t == father || !is_hit(father, tally)) {
                    pending.push(child);
                }
            }
        }
        debug_assert!(false, "who is in conflict with no present triangle is a vertex");
        None
    }

    /// The corner of a node that is at a point.
    fn corner_at(&self, t: u32, q: P) -> Option<u32> {
        let mut corners = self.nodes[t as usize].corners.into_iter();
        corners.find(|&s| s != GHOST && self.sites[s as usize].point == q)
    }

    /// A new site, in conflict with a present node.
    fn add<G: Simplices<N, Point = P>>(&mut self, place: Place, q: P, from: u32) {
        let site = self.new_site(place, q);
        self.nodes[from as usize].killer = site;
        let mut cavity = vec![from];
        let mut border = Vec::new();
        let mut next = 0;
        while let Some(&t) = cavity.get(next) {
            next += 1;
            for k in 0..N {
                let u = self.nodes[t as usize].neighbors[k];
                if self.nodes[u as usize].killer == site {
                    continue;
                }
                if self.is_hit::<G>(u, q) {
                    self.nodes[u as usize].killer = site;
                    cavity.push(u);
                } else {
                    border.push((t, k, u));
                }
            }
        }
        let mut open = BTreeMap::new();
        for (father, k, step) in border {
            let t = self.bear(site, father, k, step);
            let facet = self.facet(t, k);
            let j = (0..N).find(|&j| self.facet(step, j) == facet).unwrap_or(0);
            self.nodes[t as usize].neighbors[k] = step;
            self.nodes[step as usize].neighbors[j] = t;
            (0..N).filter(|&j| j != k).for_each(|j| self.glue(t, j, &mut open));
        }
    }

    /// The node that a site makes of a father, in place of a corner.
    fn bear(&mut self, site: u32, father: u32, k: usize, step: u32) -> u32 {
        let mut corners = self.nodes[father as usize].corners;
        corners[k] = site;
        let node = Node::new(corners, [father, step], site);
        let t = put(&mut self.nodes, &mut self.free_nodes, node);
        self.sites[site as usize].made.push(t);
        self.nodes[father as usize].children.push(t);
        self.nodes[step as usize].children.push(t);
        t
    }

    /// The number of triangles, or tetrahedra, that ever were.
    pub(crate) fn count(&self) -> usize {
        self.nodes.len() - self.free_nodes.len()
    }

    pub(crate) fn bytes(&self) -> usize {
        let links = |links: &Vec<u32>| size_of_val(&**links);
        size_of_val(&*self.nodes)
            + size_of_val(&*self.sites)
            + links(&self.site_at)
            + self.nodes.iter().map(|node| links(&node.children)).sum::<usize>()
            + self.sites.iter().map(|site| links(&site.made)).sum::<usize>()
    }
}

/// Puts an item into a free slot, or at the end.
fn put<T>(items: &mut Vec<T>, free: &mut Vec<u32>, item: T) -> u32 {
    if let Some(slot) = free.pop() {
        items[slot as usize] = item;
        return slot;
    }
    items.push(item);
    items.len() as u32 - 1
}

impl<const N: usize> Node<N> {
    fn new(corners: [u32; N], parents: [u32; 2], maker: u32) -> Self {
        Self { corners, neighbors: [NONE; N], parents, children: Vec::new(), maker, killer: NONE }
    }

    fn corner(&self, site: u32) -> Option<usize> {
        self.corners.iter().position(|&s| s == site)
    }
}

impl<G: Simplices<N>, const N: usize> Strategy<G> for DelaunayTree<G::Point, N> {
    /// The walk starts in the triangle of the node found, in space at a corner of it; the number is that node's.
    fn start<T: Tally>(&self, ground: &G, q: G::Point, tally: &mut T) -> Start<G::Hint> {
        let Some(t) = self.search::<G, T>(q, tally) else { return self.below.start(ground, q, tally) };
        let place = |s: u32| self.sites[s as usize].place;
        let finite = self.nodes[t as usize].corners.into_iter().filter(|&s| s != GHOST);
        let corners: Vec<Place> =
            self.corner_at(t, q).map_or_else(|| finite.map(place).collect(), |s| vec![place(s)]);
        let hint = ground.hint_at(&corners, tally);
        Start::Hint(hint, t)
    }

    fn inserted<T: Tally>(&mut self, ground: &G, v: Place, start: Start<G::Hint>, _: &mut T) {
        self.below.inserted(ground, v, start, &mut ());
        let q = ground.point(v);
        if self.root.is_none() {
            // As long as the sites do not span the space each comes without a look at the others.
            if ground.is_spanned() {
                self.plant(ground, |_| true);
            }
            return;
        }
        let from = match start {
            Start::Hint(_, t) => Some(t),
            _ => self.search::<G, _>(q, &mut ()),
        };
        if let Some(from) = from {
            self.add::<G>(v, q, from);
        }
    }

    fn removing<T: Tally>(&mut self, ground: &G, v: Place, _: &mut T) {
        self.below.removing(ground, v, &mut ());
        let Some(root) = self.root else { return };
        let site = self.site_at[v.index()];
        if root.contains(&site) {
            self.plant(ground, |w| w != v);
        } else {
            self.remove::<G>(site);
        }
    }

    fn rearranged(&mut self, ground: &G, moved: &[Place]) {
        self.below.rearranged(ground, moved);
        self.site_at.fill(NONE);
        let mut is_free = vec![false; self.sites.len()];
        self.free_sites.iter().for_each(|&s| is_free[s as usize] = true);
        for (s, site) in self.sites.iter_mut().enumerate().filter(|(s, _)| !is_free[*s]) {
            site.place = moved[site.place.index()];
            let at = site.place.index();
            if self.site_at.len() <= at {
                self.site_at.resize(at + 1, NONE);
            }
            self.site_at[at] = s as u32;
        }
    }
}

#[cfg(test)]
pub(crate) mod tests;
