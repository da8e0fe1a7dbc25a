//! Removal of a vertex: its star becomes a hole, and the hole gets the triangles that the other vertices have.
//!
//! Source: Devillers, "On deletion in Delaunay triangulations", IJCGA 2002 (SoCG 1999); "Vertex removal in two
//! dimensional Delaunay triangulation: speed-up by low degrees optimization", CGTA 2011. Only the vertices on the
//! border of the hole matter, because whatever was empty of them stays empty of the others.
//!
//! Cost, for degree d: up to [`SCANNED_DEGREE`], a search for the apex of each side among the rest of the border, at
//! most d^2 / 2 tests and hardly more than d for the usual six, in buffers that are kept; above that, O(d log d) by
//! dividing and conquering the border. The ghost vertex is a vertex of the border like others, so the hull is no
//! special case.
//!
//! Where no site hides another the border of the hole has all sites that its triangles can have. Under a kernel that hides sites
//! this gives the triangulation of those that were vertices, and those that the removed one hid are inserted by the owner.

use delone_predicates::{Filter, orient2d};

use super::Layer;
use super::kernel::{Kernel, Site, Sites};
use crate::ids::{EdgeId, Place, TriangleId};
use crate::mesh::Mesh2;
use crate::mesh::triangles::surgery::{BorderEdge, Part};
use crate::plane::construct;
use crate::points::Bounds;
use crate::prefetch::prefetch;
use crate::tally::Tally;

/// The largest degree of a removed vertex at which all candidates for an apex are scanned; a larger star is triangulated.
const SCANNED_DEGREE: usize = 24;

/// A hole is filled by so many triangles less than the star had; these, the first ones, are given back.
const LESS: usize = 2;

/// The border of the hole, counter-clockwise, and the triangles to fill it with. Kept between removals.
#[derive(Clone, Debug, Default)]
pub(in crate::plane) struct Hole<K: Kernel> {
    /// Where each edge of the border starts, and its twin outside.
    pub(in crate::plane) border: Vec<BorderEdge>,
    /// The sites where they start; that of the ghost means nothing.
    sites: Vec<Site<K>>,
    /// Of these the last ones fill it, two less than there are edges.
    pub(in crate::plane) triangles: Vec<TriangleId>,
    spokes: Vec<EdgeId>,
    /// Parts of the hole still to be filled.
    pending: Vec<Part<()>>,
}

impl<K: Kernel> Layer<K> {
    /// Removes the vertex at a place and gives the place back.
    pub(in crate::plane) fn remove<T: Tally>(&mut self, v: Place, tally: &mut T) {
        if self.mesh.lone == Some(v) {
            self.mesh.lone = None;
            self.line.take();
            self.mesh.vertex_count = 0;
        } else if self.spanned {
            self.remove_from_plane(v, tally);
        } else {
            self.leave_line(v);
        }
        self.free_place(v);
    }

    fn remove_from_plane<T: Tally>(&mut self, v: Place, tally: &mut T) {
        self.prefetch_window::<6, 2>(v.index());
        let mut hole = std::mem::take(&mut self.hole);
        hole.dig(&self.mesh, &self.points, v);
        let degree = hole.border.len();
        tally.destroyed(degree);
        if let Some(chain) = self.line_without(&hole) {
            tally.created(2 * chain.len() - 2);
            hole.triangles.clear();
            self.mesh.clear_triangles();
            self.mesh.build_line(chain);
            self.spanned = false;
        } else {
            tally.created(degree - 2);
            let sites = Sites { points: &self.points, weights: &self.weights };
            hole.fill(&mut self.mesh, &sites, tally);
            hole.triangles[..LESS].iter().for_each(|&t| self.mesh.free_triangle(t));
            self.mesh.vertex_count -= 1;
        }
        self.hole = hole;
    }

    /// The other vertices from end to end, if they are all on one line: they are all on the border then. Each with whether its
    /// segment with the one before is fixed.
    fn line_without(&self, hole: &Hole<K>) -> Option<Vec<(Place, bool)>> {
        let border = &hole.border;
        let ghost = border.iter().position(|(v, _)| v.is_ghost())?;
        if border.len() != self.mesh.vertex_count {
            return None; // the others, and the ghost instead of the vertex itself
        }
        let along = |i: usize| border[(ghost + i) % border.len()];
        let fixed = |i: usize| i > 1 && self.mesh.is_fixed(along(i - 1).1);
        let chain: Vec<_> = (1..border.len()).map(|i| (along(i).0, fixed(i))).collect();
        let point = |i: usize| self.points[chain[i].0.index()];
        (2..chain.len()).all(|i| orient2d(point(0), point(1), point(i)).is_zero()).then_some(chain)
    }
}

impl<K: Kernel> Hole<K> {
    /// The result of the last removal from the plane: the triangles that fill the hole, and for each edge of its border where it
    /// starts, and its twin outside.
    pub(in crate::plane) fn last(&self) -> (&[TriangleId], &[BorderEdge]) {
        (self.triangles.get(LESS..).unwrap_or_default(), &self.border)
    }

    /// Collects the star of a vertex, in both directions at once: the next triangle on one side is fetched from
    /// memory while that on the other is waited for, and so is what filling the hole reads of its border.
    fn dig(&mut self, mesh: &Mesh2, points: &[[f64; 2]], v: Place) {
        let ask = |outside: EdgeId, p: Place| {
            prefetch(&mesh.edges, outside.index());
            prefetch(points, p.index());
            prefetch(&mesh.incident, p.index());
        };
        self.spokes.clear();
        self.border.clear();
        self.triangles.clear();
        let mut left = mesh.incident[v.index()];
        let mut right = mesh.twin(left).next();
        self.spokes.push(left);
        ask(mesh.twin(left.next()), mesh.head(left));
        while left != right {
            left = mesh.spin(left);
            self.spokes.push(left);
            ask(mesh.twin(left.next()), mesh.head(left));
            if left == right {
                break;
            }
            self.triangles.push(right.triangle());
            let (p, outside) = (mesh.tail(right.next()), mesh.twin(right.next()));
            ask(outside, p);
            self.border.push((p, outside));
            right = mesh.twin(right).next();
        }
        // So far clockwise, from the right of the first spoke on: turned, it goes before the rest.
        self.border.reverse();
        for &spoke in &self.spokes {
            let side = spoke.next();
            self.border.push((mesh.tail(side), mesh.twin(side)));
            self.triangles.push(spoke.triangle());
        }
    }

    /// Fills the hole with the triangles of its border.
    pub(in crate::plane) fn fill<T: Tally>(&mut self, mesh: &mut Mesh2, sites: &Sites<K>, tally: &mut T) {
        if self.border.len() <= SCANNED_DEGREE || K::HIDES {
            let site = |&(v, _): &BorderEdge| if v.is_ghost() { Site::<K>::default() } else { sites.at(v) };
            self.sites.clear();
            self.sites.extend(self.border.iter().map(site));
            self.fill_small(mesh, tally);
        } else {
            self.fill_large(mesh, sites.points);
        }
    }

    /// Fills the hole side by side. The apex of a side is the vertex whose circle with it contains no other: a
    /// linear search, because the circles through two points are ordered.
    fn fill_small<T: Tally>(&mut self, mesh: &mut Mesh2, tally: &mut T) {
        let Self { border, sites, triangles, pending, .. } = self;
        // Without the ghost it is filled with finite triangles, which its own small box tells apart.
        let filter = border.iter().all(|(v, _)| !v.is_ghost()).then(|| {
            let [width, height] = Bounds::of(sites.iter().map(|site| site.0)).extent();
            Filter::for_box(width, height, None)
        });
        mesh.fill_hole(border, triangles, pending, (), |first, last, ()| {
            let (side, between) = ([sites[last], sites[first]], &sites[first + 1..last]);
            // The only one needs no test.
            let filter = filter.as_ref().filter(|_| between.len() > 1);
            let plain = filter.and_then(|filter| K::apex(side, between, filter));
            let Some((k, above)) = plain else {
                return (apex::<K, T>(border, sites, first, last, tally), (), ());
            };
            between.iter().for_each(|_| tally.orientation());
            (1..above).for_each(|_| tally.in_circle());
            (first + 1 + k, (), ())
        });
    }

    /// Fills the hole with those triangles of its border's own triangulation that are inside: of a side the apex is the one
    /// there.
    fn fill_large(&mut self, mesh: &mut Mesh2, points: &[[f64; 2]]) {
        let Self { border, triangles, .. } = self;
        let finite: Vec<usize> = (0..border.len()).filter(|&i| !border[i].0.is_ghost()).collect();
        let local: Vec<[f64; 2]> = finite.iter().map(|&i| points[border[i].0.index()]).collect();
        let construct::InOrder { mesh: patch, indices, .. } = construct::in_order(&local);
        let ghost = border.iter().position(|(v, _)| v.is_ghost());
        // Which vertex of the border is at a place of the patch, and where the last and the first are.
        let on_border = |p: Place| match (p, ghost) {
            (Place::GHOST, Some(i)) => i,
            (p, _) => finite[indices[p.index()] as usize],
        };
        let place = |i: usize| indices.iter().position(|&k| finite[k as usize] == i).map(Place::new);
        let (from, to) = (place(border.len() - 1), place(0));
        let side = match (from, to) {
            (Some(from), to) => patch.spokes(from).find(|&e| patch.head(e) == to.unwrap_or(Place::GHOST)),
            (None, Some(to)) => patch.spokes(to).map(|e| patch.twin(e)).find(|&e| patch.tail(e).is_ghost()),
            (None, None) => None,
        };
        let side = side.expect("the border of a hole is Delaunay");
        // Each side is known by the edge of the patch that is it, seen from inside.
        mesh.fill_hole(border, triangles, &mut Vec::new(), side, |_, _, e| {
            (on_border(patch.tip(e)), patch.twin(e.next()), patch.twin(e.previous()))
        });
    }
}

/// The apex of the side from `last` to `first` among the vertices between them.
#[inline]
fn apex<K: Kernel, T: Tally>(
    border: &[BorderEdge],
    sites: &[Site<K>],
    first: usize,
    last: usize,
    tally: &mut T,
) -> usize {
    if last == first + 2 {
        return first + 1;
    }
    let (a, b) = (border[last].0, border[first].0);
    let is_finite = !a.is_ghost() && !b.is_ghost();
    let mut best = None;
    let mut ghost = first + 1;
    for k in first + 1..last {
        if border[k].0.is_ghost() {
            ghost = k; // where nothing finite is in front of the side
            continue;
        }
        let q = sites[k];
        if is_finite {
            tally.orientation();
            if !orient2d(sites[last].0, sites[first].0, q.0).is_positive() {
                continue;
            }
        }
        let better = best.is_none_or(|apex: usize| {
            tally.in_circle();
            let at = [last, first, apex];
            K::conflicts([a, b, border[apex].0], |i| sites[at[i]], q)
        });
        if better {
            best = Some(k);
        }
    }
    best.unwrap_or(ghost)
}
