//! Kernels: the test whether a tetrahedron is in conflict with a site, by spheres of points, or power spheres of points with weights.
//!
//! Without weights no site hides another, and a cavity has no vertex inside. With weights ([`Lift::HIDES`]) a vertex inside of a
//! cavity is one that the new site hides, and a site without a cavity is hidden itself.

use delone_predicates::{
    Filter3, Grid, Sign, in_power_sphere, in_sphere, keeps_clear, keeps_clear_of_sites, orient3d,
};

use crate::points::Bounds;
use crate::weight::Weight;

/// A site whose point is not copied: copies are read in other pieces than they are written, and that waits.
pub(in crate::space) type SiteRef<'a, W> = (&'a [f64; 3], W);

/// The data of a site besides its point, and the tests that depend on it.
pub(in crate::space) trait Lift: Weight {
    /// Whether a site may hide another one, so that this is no vertex.
    const HIDES: bool;

    /// The weight as a number.
    fn value(self) -> f64;

    /// A filter for sites in a box whose weights differ by at most `spread`.
    fn filter(extent: [f64; 3], spread: f64, grid: Option<Grid>) -> Filter3;

    /// The in-sphere test.
    fn in_sphere(filter: &Filter3, corners: [SiteRef<'_, Self>; 4], q: SiteRef<'_, Self>) -> Sign;

    /// Tests sites that no filter covers.
    fn is_in_sphere(corners: [([f64; 3], Self); 4], q: ([f64; 3], Self)) -> bool;

    /// Two at once.
    fn in_spheres(filter: &Filter3, corners: [[SiteRef<'_, Self>; 4]; 2], q: SiteRef<'_, Self>) -> [Sign; 2];

    /// Whether the sphere certainly has no site inside of it or on it that may be in a region.
    fn keeps_clear(corners: [SiteRef<'_, Self>; 4], region: &Region<Self>) -> bool;

    /// The largest of some weights.
    fn most(weights: impl Iterator<Item = Self>) -> Self;
}

/// A box around sites, and the largest of their weights.
#[derive(Clone, Copy, Debug)]
pub(in crate::space) struct Region<W> {
    pub(in crate::space) bounds: Bounds<3>,
    pub(in crate::space) most: W,
}

impl Lift for () {
    const HIDES: bool = false;

    fn value(self) -> f64 {
        0.0
    }

    fn filter(extent: [f64; 3], _: f64, grid: Option<Grid>) -> Filter3 {
        Filter3::for_box(extent, grid)
    }

    #[inline]
    fn in_sphere(filter: &Filter3, [a, b, c, d]: [SiteRef<'_, Self>; 4], q: SiteRef<'_, Self>) -> Sign {
        filter.in_sphere(*a.0, *b.0, *c.0, *d.0, *q.0)
    }

    fn is_in_sphere([a, b, c, d]: [([f64; 3], Self); 4], q: ([f64; 3], Self)) -> bool {
        in_sphere(a.0, b.0, c.0, d.0, q.0).is_positive()
    }

    #[inline]
    fn in_spheres(filter: &Filter3, corners: [[SiteRef<'_, Self>; 4]; 2], q: SiteRef<'_, Self>) -> [Sign; 2] {
        filter.in_spheres(corners.map(|corners| corners.map(|site| site.0)), q.0)
    }

    fn keeps_clear(corners: [SiteRef<'_, Self>; 4], region: &Region<Self>) -> bool {
        keeps_clear(corners.map(|site| *site.0), region.bounds.low, region.bounds.high)
    }

    fn most(_: impl Iterator<Item = Self>) -> Self {}
}

impl Lift for f64 {
    const HIDES: bool = true;

    fn value(self) -> f64 {
        self
    }

    fn filter(extent: [f64; 3], spread: f64, grid: Option<Grid>) -> Filter3 {
        Filter3::for_sites(extent, spread, grid)
    }

    #[inline]
    fn in_sphere(filter: &Filter3, corners: [SiteRef<'_, Self>; 4], q: SiteRef<'_, Self>) -> Sign {
        filter.in_power_sphere(corners, q)
    }

    fn is_in_sphere([a, b, c, d]: [([f64; 3], Self); 4], q: ([f64; 3], Self)) -> bool {
        in_power_sphere(a, b, c, d, q).is_positive()
    }

    #[inline]
    fn in_spheres(filter: &Filter3, corners: [[SiteRef<'_, Self>; 4]; 2], q: SiteRef<'_, Self>) -> [Sign; 2] {
        filter.in_power_spheres(corners, q)
    }

    fn keeps_clear(corners: [SiteRef<'_, Self>; 4], region: &Region<Self>) -> bool {
        let corners = corners.map(|(point, weight)| (*point, weight));
        keeps_clear_of_sites(corners, region.bounds.low, region.bounds.high, region.most)
    }

    fn most(weights: impl Iterator<Item = Self>) -> Self {
        weights.fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Whether a site is in the sphere of corners in positive order, one of which may be at infinity. All of `root` is in the hull.
pub(in crate::space) fn is_in_sphere<W: Lift>(
    mut corners: [Option<([f64; 3], W)>; 4],
    root: &[[f64; 3]; 4],
    q: ([f64; 3], W),
) -> bool {
    if let Some(k) = corners.iter().position(Option::is_none).filter(|&k| k < 3) {
        // Two exchanges leave the order positive.
        corners.swap(k, 3);
        corners.swap((k + 1) % 3, (k + 2) % 3);
    }
    let [Some(a), Some(b), Some(c), last] = corners else { return false };
    if let Some(d) = last {
        return W::is_in_sphere([a, b, c, d], q);
    }
    match orient3d(a.0, b.0, c.0, q.0) {
        Sign::Positive => true,
        Sign::Negative => false,
        // In the plane of a hull facet the sphere through any point inside cuts out its circle, whatever that weighs.
        Sign::Zero => {
            let inside = root.iter().find(|&&d| !orient3d(a.0, b.0, c.0, d).is_zero());
            inside.is_some_and(|&d| W::is_in_sphere([b, a, c, (d, W::default())], q))
        }
    }
}
