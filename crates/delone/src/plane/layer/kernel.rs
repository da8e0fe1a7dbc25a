//! What decides whether a triangle is in conflict with a point: the one thing in which triangulations of the plane differ that
//! are made of cavities.
//!
//! The contract: for points in general position, which the perturbation makes of all, the triangles in conflict with a new
//! point are connected, and star-shaped around it. Where no site hides another ([`Kernel::HIDES`]) no vertex is inside of
//! the cavity: n edges of its border stand where n - 2 triangles were. Under a kernel that hides sites (circles with weights)
//! a vertex inside of a cavity is one that the new site hides, a new site without a cavity is hidden itself, and what a removal
//! sets free has to be looked for among the hidden: `cavity`, `remove` and `check` say where they count on that.

use std::fmt::Debug;

use delone_predicates::{Sign, in_circle, orient2d, strictly_between};

use crate::ids::Place;

/// What decides.
pub(in crate::plane) trait Kernel: Copy + Debug + Default + Send + Sync + 'static {
    /// Whether a site may hide another one, so that this is no vertex.
    const HIDES: bool = false;

    /// Whether the circle of a finite triangle contains a point, in the sense of the kernel.
    fn contains(a: [f64; 2], b: [f64; 2], c: [f64; 2], q: [f64; 2]) -> bool;

    /// The same for the half-plane on the left of a hull edge seen from outside, with the inside of the edge: the circle of a
    /// ghost.
    #[inline]
    fn contains_beyond(u: [f64; 2], v: [f64; 2], q: [f64; 2]) -> bool {
        match orient2d(u, v, q) {
            Sign::Positive => true,
            Sign::Zero => strictly_between(u, v, q),
            Sign::Negative => false,
        }
    }

    /// Whether a triangle is in conflict with a point. `point` gives the point of each corner that is not the ghost.
    #[inline]
    fn conflicts(corners: [Place; 3], point: impl Fn(usize) -> [f64; 2], q: [f64; 2]) -> bool {
        if corners[0].is_ghost() {
            Self::contains_beyond(point(1), point(2), q)
        } else if corners[1].is_ghost() {
            Self::contains_beyond(point(2), point(0), q)
        } else if corners[2].is_ghost() {
            Self::contains_beyond(point(0), point(1), q)
        } else {
            Self::contains(point(0), point(1), point(2), q)
        }
    }
}

/// Delaunay triangles: no site is inside of a circle.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::plane) struct NearestSites;

impl Kernel for NearestSites {
    #[inline]
    fn contains(a: [f64; 2], b: [f64; 2], c: [f64; 2], q: [f64; 2]) -> bool {
        in_circle(a, b, c, q).is_positive()
    }
}

/// Triangles of furthest sites: all sites are inside of each circle.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::plane) struct Furthest;

impl Kernel for Furthest {
    #[inline]
    fn contains(a: [f64; 2], b: [f64; 2], c: [f64; 2], q: [f64; 2]) -> bool {
        !in_circle(a, b, c, q).is_positive()
    }
}
