//! The merge step: two triangulations, separated by a cut, become one.
//!
//! A bubble rises through the gap between them (Guibas & Stolfi 1985, figure 17). Its bottom is the base
//! l -> r, at first the lower common tangent. Each side offers the next vertex along its hull, after removing
//! the edges that the other side's base vertex destroys; the candidate whose circle through the base is empty
//! becomes connected, and the new edge is the next base. All tests of a step are members of the pencil of
//! circles through the base.
//!
//! ```text
//!        l1              r1          left   ghost of l -> l1, the next hull edge after the base's, r -> l
//!          \   (bubble)  /           right  ghost of r1 -> r, the hull edge before the base's
//!     left  \           /  right     under  the edge l -> r of the triangle below the base
//!            l ------- r             bottom ghost below the first base, of l -> r
//!               base                 top    ghost above the last base
//! ```
//!
//! With weights sites are hidden on the way, and three things are different. The first base, where hull vertices are on its
//! line, is an edge of their one-dimensional triangulation. Edges that lead from a corner of a new triangle into it are
//! removed. And an edge with ghosts on both sides may be removed, with all that hangs on it: around a visible vertex the final
//! triangles leave no room for others, so what is hidden comes loose, and its triangles are left unused.
//!
//! A cut by y is a cut by x in coordinates turned by a quarter: (y, -x). The lower part is then on the left,
//! orientations stay as they are, and only the choice of the first l and r differs.

use delone_predicates::{Filter, Member, Pencil, Sign, in_power_circle, orient2d, strictly_between};

use super::builder::Builder;
use crate::ids::{EdgeId, Place, TriangleId};
use crate::mesh::triangles::HalfEdge;
use crate::plane::layer::kernel::{Kernel, NearestSites, Power, Site};

/// A kernel whose triangulations can be merged.
pub(super) trait Merging: Kernel {
    /// Whether q is in the circle of a base and p, which is above it; each a member of the pencil of circles through the base.
    fn in_circle(
        pencil: &Pencil,
        base: [Site<Self>; 2],
        p: (&Member, Site<Self>),
        q: (&Member, Site<Self>),
        filter: &Filter,
    ) -> Sign;
}

impl Merging for NearestSites {
    #[inline]
    fn in_circle(
        pencil: &Pencil,
        _: [Site<Self>; 2],
        p: (&Member, Site<Self>),
        q: (&Member, Site<Self>),
        filter: &Filter,
    ) -> Sign {
        pencil.in_circle(p.0, q.0, filter)
    }
}

impl Merging for Power {
    #[inline]
    fn in_circle(
        _: &Pencil,
        [l, r]: [Site<Self>; 2],
        p: (&Member, Site<Self>),
        q: (&Member, Site<Self>),
        _: &Filter,
    ) -> Sign {
        in_power_circle(l, r, p.1, q.1)
    }
}

/// A triangulated run of positions, with the strict corners of its hull from which merges start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) start: usize,
    pub(super) end: usize,
    /// Lexicographic minimum by (x, y).
    pub(super) west: Place,
    /// Lexicographic maximum by (x, y).
    pub(super) east: Place,
    /// Lexicographic minimum by (y, -x).
    pub(super) south: Place,
    /// Lexicographic maximum by (y, -x).
    pub(super) north: Place,
}

impl Part {
    fn is_single(&self) -> bool {
        self.end - self.start == 1
    }
}

/// The bubble as it rises. The ghost above its base is written when it has risen, so the ghosts beside it do not know yet what
/// they are next to.
struct Bubble {
    l: Place,
    r: Place,
    /// The edge l -> r, which is below the base.
    under: EdgeId,
    /// The ghost of the hull edge that leaves l; `bottom` for a single point.
    left: TriangleId,
    /// The ghost of the hull edge that enters r; `bottom` for a single point.
    right: TriangleId,
    /// The ghost below the first base.
    bottom: TriangleId,
}

impl Bubble {
    /// The ghost beside the base, on the left or on the right.
    #[inline]
    fn beside<const LEFT: bool>(&self) -> TriangleId {
        if LEFT { self.left } else { self.right }
    }

    #[inline]
    fn beside_mut<const LEFT: bool>(&mut self) -> &mut TriangleId {
        if LEFT { &mut self.left } else { &mut self.right }
    }
}

/// The first base, and the ghosts beside it.
struct Base {
    l: Place,
    r: Place,
    /// The ghost of the hull edge that enters l; meaningless for a single point.
    entering_l: TriangleId,
    /// The ghost of the hull edge that leaves r; meaningless for a single point.
    leaving_r: TriangleId,
}

impl<K: Merging> Builder<'_, K> {
    /// Merges the parts on both sides of a cut: `a` to the left (or below), `b` to the right (or above). The
    /// filter holds for both.
    pub(super) fn merge(&mut self, a: &Part, b: &Part, by_x: bool, filter: &Filter) -> Part {
        self.counters.merges += 1;
        let (l, r) = if by_x { (a.east, b.west) } else { (a.north, b.south) };
        let base = self.lower_tangent(l, r, a.is_single(), b.is_single(), filter);
        let bottom = TriangleId::new(2 * b.start - 2);
        let top = TriangleId::new(2 * b.start - 1);
        let bubble = self.open(&base, bottom, top, a.is_single(), b.is_single());
        self.rise(bubble, top, filter);
        Part::union(self.points, a, b, by_x)
    }

    /// The common tangent below both parts, closest to the gap: from the facing corners downwards, each side
    /// in turn as long as its next vertex is strictly below.
    fn lower_tangent(&self, l: Place, r: Place, l_single: bool, r_single: bool, filter: &Filter) -> Base {
        let entering_l = if l_single { TriangleId::new(0) } else { self.previous_ghost(self.leaving(l)) };
        let mut base = Base { l, r, entering_l, leaving_r: self.leaving(r) };
        loop {
            let pencil = Pencil::new(self.point(base.l), self.point(base.r));
            let below = |v: Place| pencil.side(&pencil.member(self.point(v)), filter).is_negative();
            if !l_single {
                let previous = self.tail(base.entering_l.edge(1));
                if below(previous) {
                    base.l = previous;
                    base.entering_l = self.previous_ghost(base.entering_l);
                    continue;
                }
            }
            if !r_single {
                let next = self.tail(base.leaving_r.edge(0));
                if below(next) {
                    base.r = next;
                    base.leaving_r = self.next_ghost(base.leaving_r);
                    continue;
                }
            }
            if K::HIDES && self.steps_back(&mut base, &pencil, l_single, r_single, filter) {
                continue;
            }
            return base;
        }
    }

    /// Where hull vertices are on the line of the base it is an edge of their regular triangulation there: an end that the other one
    /// and the vertex behind it hide gives way to that one.
    fn steps_back(
        &self,
        base: &mut Base,
        pencil: &Pencil,
        l_single: bool,
        r_single: bool,
        filter: &Filter,
    ) -> bool {
        let is_on_line = |v: Place| pencil.side(&pencil.member(self.point(v)), filter).is_zero();
        let is_hidden = |end: Place, behind: Place, other: Place| {
            behind != other
                && is_on_line(behind)
                && !K::contains_on_line(self.site(behind), self.site(other), self.site(end))
        };
        if !l_single {
            let before = self.tail(base.entering_l.edge(1));
            if is_hidden(base.l, before, base.r) {
                base.l = before;
                base.entering_l = self.previous_ghost(base.entering_l);
                return true;
            }
        }
        if !r_single {
            let after = self.tail(base.leaving_r.edge(0));
            if is_hidden(base.r, after, base.l) {
                base.r = after;
                base.leaving_r = self.next_ghost(base.leaving_r);
                return true;
            }
        }
        false
    }

    /// Joins the hulls below by the first base.
    fn open(
        &mut self,
        base: &Base,
        bottom: TriangleId,
        top: TriangleId,
        l_single: bool,
        r_single: bool,
    ) -> Bubble {
        let &Base { l, r, entering_l, leaving_r } = base;
        // Read before linking: what follows on the upper side.
        let left = if l_single { bottom } else { self.next_ghost(entering_l) };
        let right = if r_single { bottom } else { self.previous_ghost(leaving_r) };
        self.set_ghost_corners(bottom, l, r);
        self.link(bottom.edge(1), if l_single { top.edge(2) } else { entering_l.edge(2) });
        self.link(bottom.edge(2), if r_single { top.edge(1) } else { leaving_r.edge(1) });
        self.set_leaving(l, bottom);
        Bubble { l, r, under: bottom.edge(0), left, right, bottom }
    }

    /// Lets the bubble rise until no vertex is above the base, and closes it by the ghost above that.
    fn rise(&mut self, mut bubble: Bubble, top: TriangleId, filter: &Filter) {
        let mut base = [self.site(bubble.l), self.site(bubble.r)];
        let mut swept = [None; 2];
        loop {
            let pencil = Pencil::new(base[0].0, base[1].0);
            let left = self.candidate::<true>(&pencil, base, &mut bubble, swept[0], filter);
            let right = self.candidate::<false>(&pencil, base, &mut bubble, swept[1], filter);
            let connect_right = match (&left, &right) {
                (None, None) => break,
                (Some(_), None) => false,
                (None, Some(_)) => true,
                (Some((left, p)), Some((right, q))) => {
                    K::in_circle(&pencil, base, (left, *p), (right, *q), filter).is_positive()
                }
            };
            self.counters.connected += 1;
            let [l, r] = base.map(|site| site.0);
            if connect_right {
                self.connect_right(&mut bubble);
                base[1] = self.site(bubble.r);
                swept = [Some([l, r]), Some([r, base[1].0])];
            } else {
                self.connect_left(&mut bubble);
                base[0] = self.site(bubble.l);
                swept = [Some([base[0].0, l]), Some([l, r])];
            }
        }
        let Bubble { l, r, under, left, right, .. } = bubble;
        self.set_ghost_corners(top, r, l);
        self.link(top.edge(0), under);
        self.link(top.edge(1), right.edge(2));
        self.link(top.edge(2), left.edge(1));
        // Vertices passed on the way may be on the outer hull too; only the last two surely left by here.
        self.set_leaving(l, left);
        self.set_leaving(r, top);
    }

    /// The vertex that the left or the right part offers, after removing the edges at its end of the base whose
    /// circle with the base contains the vertex behind them.
    ///
    /// Where sites hide others, edges are removed too that lead into the triangle below the base, on the left of the line
    /// `swept`, or onto the base: what they lead to is hidden.
    #[inline]
    fn candidate<const LEFT: bool>(
        &mut self,
        pencil: &Pencil,
        base: [Site<K>; 2],
        bubble: &mut Bubble,
        swept: Option<[[f64; 2]; 2]>,
        filter: &Filter,
    ) -> Option<(Member, Site<K>)> {
        let (mut candidate, mut site) = loop {
            let ghost = bubble.beside::<LEFT>();
            if ghost == bubble.bottom {
                return None; // a single point
            }
            let far = self.tail(ghost.edge(usize::from(!LEFT)));
            let site = self.site(far);
            let candidate = pencil.member(site.0);
            let side = pencil.side(&candidate, filter);
            if side.is_positive() {
                break (candidate, site);
            }
            let is_swept = |[a, b]: [[f64; 2]; 2]| orient2d(a, b, site.0).is_positive();
            let is_hidden = K::HIDES
                && if side.is_zero() {
                    strictly_between(base[0].0, base[1].0, site.0)
                } else {
                    swept.is_some_and(is_swept)
                };
            if !is_hidden {
                return None;
            }
            self.cut::<LEFT>(bubble);
        };
        loop {
            let ghost = bubble.beside::<LEFT>();
            let mut apex = self.tail(self.twin(ghost.edge(0)).previous());
            if apex.is_ghost() {
                // Nothing is behind this edge; beyond it there may be something.
                if !K::HIDES {
                    return Some((candidate, site));
                }
                let beyond = self.beyond::<LEFT>(ghost);
                if beyond == bubble.bottom {
                    return Some((candidate, site));
                }
                apex = self.tail(beyond.edge(usize::from(!LEFT)));
            }
            let behind = self.site(apex);
            let member = pencil.member(behind.0);
            let is_above = !K::HIDES || pencil.side(&member, filter).is_positive();
            if !is_above
                || !K::in_circle(pencil, base, (&candidate, site), (&member, behind), filter).is_positive()
            {
                return Some((candidate, site));
            }
            self.cut::<LEFT>(bubble);
            (candidate, site) = (member, behind);
        }
    }

    /// Removes the first edge at an end of the base.
    #[inline]
    fn cut<const LEFT: bool>(&mut self, bubble: &mut Bubble) {
        let ghost = bubble.beside::<LEFT>();
        let apex = self.tail(self.twin(ghost.edge(0)).previous());
        if K::HIDES && apex.is_ghost() {
            self.remove_bridge::<LEFT>(bubble);
        } else if LEFT {
            self.remove_left(bubble, apex);
        } else {
            self.remove_right(bubble, apex);
        }
    }

    /// The ghost of the next edge at an end of the base after one that has ghosts on both sides, of which this is the first.
    fn beyond<const LEFT: bool>(&self, ghost: TriangleId) -> TriangleId {
        let other = self.twin(ghost.edge(0)).triangle();
        if LEFT { self.next_ghost(other) } else { self.previous_ghost(other) }
    }

    /// Removes an edge that has ghosts on both sides, and what hangs on it: hidden sites.
    #[cold]
    fn remove_bridge<const LEFT: bool>(&mut self, bubble: &mut Bubble) {
        self.counters.removed += 1;
        let ghost = bubble.beside::<LEFT>();
        let other = self.twin(ghost.edge(0)).triangle();
        // At its end at the base what comes beyond the edge is beside the base now. Around its other end what came before one
        // side is followed by what came after the other.
        let beyond = self.beyond::<LEFT>(ghost);
        let (before, after) = if LEFT {
            (self.previous_ghost(other), self.next_ghost(ghost))
        } else {
            (self.previous_ghost(ghost), self.next_ghost(other))
        };
        *bubble.beside_mut::<LEFT>() = beyond;
        if before != ghost && before != other {
            self.link(before.edge(2), after.edge(1));
        }
        for t in [ghost, other] {
            self.records(t, 1).fill(HalfEdge::UNUSED);
        }
        let mut pending = vec![after];
        while let Some(t) = pending.pop() {
            if self.twin(t.edge(0)) == EdgeId::NONE {
                continue;
            }
            pending.extend([0, 1, 2].map(|k| self.twin(t.edge(k)).triangle()));
            self.records(t, 1).fill(HalfEdge::UNUSED);
        }
    }

    /// Removes the hull edge l -> l1: the triangle (l, l1, x) behind it becomes the ghost of l -> x, its ghost that of
    /// x -> l1.
    #[inline]
    fn remove_left(&mut self, bubble: &mut Bubble, x: Place) {
        self.counters.removed += 1;
        let ghost = bubble.left;
        let e = self.twin(ghost.edge(0)); // l -> l1
        let (l1_x, x_l) = (self.twin(e.next()), self.twin(e.previous()));
        let freed = e.triangle();
        self.set_ghost_corners(freed, bubble.l, x);
        self.link(freed.edge(0), x_l);
        self.link(freed.edge(2), ghost.edge(1));
        self.set_tail(ghost.edge(1), x);
        self.link(ghost.edge(0), l1_x);
        bubble.left = freed;
    }

    /// Removes the hull edge r1 -> r: the triangle (r1, r, y) behind it becomes the ghost of y -> r, its ghost that of
    /// r1 -> y.
    #[inline]
    fn remove_right(&mut self, bubble: &mut Bubble, y: Place) {
        self.counters.removed += 1;
        let ghost = bubble.right;
        let e = self.twin(ghost.edge(0)); // r1 -> r
        let (r_y, y_r1) = (self.twin(e.next()), self.twin(e.previous()));
        let freed = e.triangle();
        self.set_ghost_corners(freed, y, bubble.r);
        self.link(freed.edge(0), r_y);
        self.link(freed.edge(1), ghost.edge(2));
        self.set_tail(ghost.edge(0), y);
        self.link(ghost.edge(0), y_r1);
        bubble.right = freed;
    }

    /// Connects l1 to r: the ghost of l -> l1 becomes the triangle (l1, l, r).
    #[inline]
    fn connect_left(&mut self, bubble: &mut Bubble) {
        let t = bubble.left;
        let (next, l1) = (self.next_ghost(t), self.tail(t.edge(0)));
        self.set_tail(t.edge(2), bubble.r);
        self.link(t.edge(1), bubble.under);
        (bubble.l, bubble.left, bubble.under) = (l1, next, t.edge(2));
    }

    /// Connects l to r1: the ghost of r1 -> r becomes the triangle (r, r1, l).
    #[inline]
    fn connect_right(&mut self, bubble: &mut Bubble) {
        let t = bubble.right;
        let (previous, r1) = (self.previous_ghost(t), self.tail(t.edge(1)));
        self.set_tail(t.edge(2), bubble.l);
        self.link(t.edge(2), bubble.under);
        (bubble.r, bubble.right, bubble.under) = (r1, previous, t.edge(1));
    }
}
