//! Kernels: the test whether a triangle is in conflict with a point. It is the only difference between triangulations of the plane that
//! are made of cavities.
//!
//! The contract: for points in general position, which the perturbation makes of all, the triangles in conflict with a new
//! point are connected, and star-shaped around it. Where no site hides another ([`Kernel::HIDES`]) no vertex is inside of
//! the cavity: n edges of its border stand where n - 2 triangles were. Under a kernel that hides sites (circles with weights)
//! a vertex inside of a cavity is one that the new site hides, a new site without a cavity is hidden itself, and what a removal
//! sets free has to be looked for among the hidden: `cavity`, `remove` and `check` say where they count on that.

use std::fmt::Debug;

use delone_predicates::{
    Filter, Pencil, Sign, in_circle, in_power_circle, in_power_interval, orient2d, strictly_between,
};

use crate::ids::Place;
use crate::weight::Weight;

/// A test for conflicts.
pub(in crate::plane) trait Kernel: Copy + Debug + Default + Send + Sync + 'static {
    /// The data of a site beside its point: nothing, or a weight.
    type Weight: Weight;

    /// Whether a site may hide another one, so that this is no vertex.
    const HIDES: bool = false;

    /// Whether the circle of a finite triangle contains a site, in the sense of the kernel.
    fn contains(a: Site<Self>, b: Site<Self>, c: Site<Self>, q: Site<Self>) -> bool;

    /// Decides for three sites on a line whether a vertex at q destroys the segment from u to v.
    #[inline]
    fn contains_on_line(u: Site<Self>, v: Site<Self>, q: Site<Self>) -> bool {
        strictly_between(u.0, v.0, q.0)
    }

    /// Whether the circle of a ghost contains a site: the open half-plane on the left of the hull edge from u to v, seen from
    /// outside, and the open edge itself.
    #[inline]
    fn contains_beyond(u: Site<Self>, v: Site<Self>, q: Site<Self>) -> bool {
        match orient2d(u.0, v.0, q.0) {
            Sign::Positive => true,
            Sign::Zero => Self::contains_on_line(u, v, q),
            Sign::Negative => false,
        }
    }

    /// Which of some candidates is on the left of a side and in conflict with none of the others there: the apex of a hole's side; and how
    /// many are there. `None` where that is not plain, or not known without asking one by one. The filter holds for all.
    #[inline]
    fn apex(_side: [Site<Self>; 2], _candidates: &[Site<Self>], _filter: &Filter) -> Option<(usize, usize)> {
        None
    }

    /// Whether a triangle is in conflict with a site. `site` gives the site of each corner that is not the ghost.
    #[inline]
    fn conflicts(corners: [Place; 3], site: impl Fn(usize) -> Site<Self>, q: Site<Self>) -> bool {
        if corners[0].is_ghost() {
            Self::contains_beyond(site(1), site(2), q)
        } else if corners[1].is_ghost() {
            Self::contains_beyond(site(2), site(0), q)
        } else if corners[2].is_ghost() {
            Self::contains_beyond(site(0), site(1), q)
        } else {
            Self::contains(site(0), site(1), site(2), q)
        }
    }
}

/// A point with what its kernel gives it besides.
pub(in crate::plane) type Site<K> = ([f64; 2], <K as Kernel>::Weight);

/// All sites, by place.
pub(in crate::plane) struct Sites<'a, K: Kernel> {
    pub(in crate::plane) points: &'a [[f64; 2]],
    /// For kernels without weights it takes no memory.
    pub(in crate::plane) weights: &'a [K::Weight],
}

impl<K: Kernel> Sites<'_, K> {
    /// The site at a place.
    #[inline]
    pub(in crate::plane) fn at(&self, p: Place) -> Site<K> {
        (self.points[p.index()], K::Weight::at(self.weights, p))
    }
}

/// Delaunay triangles: no site is inside of a circle.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::plane) struct NearestSites;

impl Kernel for NearestSites {
    type Weight = ();

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "calls are 6 % of all instructions of an insertion")]
    fn contains(a: Site<Self>, b: Site<Self>, c: Site<Self>, q: Site<Self>) -> bool {
        in_circle(a.0, b.0, c.0, q.0).is_positive()
    }

    #[inline]
    fn apex([a, b]: [Site<Self>; 2], candidates: &[Site<Self>], filter: &Filter) -> Option<(usize, usize)> {
        Pencil::new(a.0, b.0).apex(candidates.iter().map(|site| site.0), filter)
    }
}

/// Triangles of furthest sites: all sites are inside of each circle.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::plane) struct Furthest;

impl Kernel for Furthest {
    type Weight = ();

    #[inline]
    fn contains(a: Site<Self>, b: Site<Self>, c: Site<Self>, q: Site<Self>) -> bool {
        !in_circle(a.0, b.0, c.0, q.0).is_positive()
    }
}

/// Regular triangles: no site is nearer to the power circle than its corners are.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::plane) struct Power;

impl Kernel for Power {
    type Weight = f64;

    const HIDES: bool = true;

    #[inline]
    fn contains(a: Site<Self>, b: Site<Self>, c: Site<Self>, q: Site<Self>) -> bool {
        in_power_circle(a, b, c, q).is_positive()
    }

    fn contains_on_line(u: Site<Self>, v: Site<Self>, q: Site<Self>) -> bool {
        in_power_interval(u, v, q).is_positive()
    }
}
