//! The centers of the spheres of all tetrahedra, each computed once: the corners of cells that no region cuts.
//!
//! Tetrahedra on one sphere have one center, and the corner of their cells is one too: the first of them stands for all. Centers that are
//! the same after rounding are joined as well. Such tetrahedra are found beside each other, facet by facet.
//!
//! Cost: O(n), and sorting of those that have a center near that of a neighbor.

use delone_predicates::Sign;
use delone_predicates::{
    HalfSpace, circumcenter3, in_power_sphere_with_ties, in_sphere_with_ties, power_center3,
};

use crate::ids::{Place, TetrahedronId};
use crate::parallel;
use crate::space::layer::Layer;
use crate::space::layer::kernel::Lift;

type Site<W> = ([f64; 3], W);

/// A kernel whose triangulations are dual to cells.
pub(in crate::space) trait Cellular: Lift + Sync {
    /// The places that belong to the first site rather than to the second.
    fn half_space(a: Site<Self>, b: Site<Self>) -> HalfSpace;

    /// The corner of the cells of four sites.
    fn center(corners: [Site<Self>; 4]) -> Option<[f64; 3]>;

    /// The test for conflicts, zero for ties.
    fn in_sphere_with_ties(corners: [Site<Self>; 4], q: Site<Self>) -> Sign;
}

impl Cellular for () {
    fn half_space(a: Site<Self>, b: Site<Self>) -> HalfSpace {
        HalfSpace::Bisector(a.0, b.0)
    }

    fn center([a, b, c, d]: [Site<Self>; 4]) -> Option<[f64; 3]> {
        circumcenter3(a.0, b.0, c.0, d.0)
    }

    fn in_sphere_with_ties([a, b, c, d]: [Site<Self>; 4], q: Site<Self>) -> Sign {
        in_sphere_with_ties(a.0, b.0, c.0, d.0, q.0)
    }
}

impl Cellular for f64 {
    fn half_space(a: Site<Self>, b: Site<Self>) -> HalfSpace {
        HalfSpace::Radical(a, b)
    }

    fn center([a, b, c, d]: [Site<Self>; 4]) -> Option<[f64; 3]> {
        power_center3(a, b, c, d)
    }

    fn in_sphere_with_ties([a, b, c, d]: [Site<Self>; 4], q: Site<Self>) -> Sign {
        in_power_sphere_with_ties(a, b, c, d, q)
    }
}

/// By the index of the tetrahedron.
pub(in crate::space) struct Centers {
    /// Infinite where there is none.
    pub(in crate::space) points: Vec<[f64; 3]>,
    /// Whether the exact center is surely inside of the region.
    pub(in crate::space) inside: Vec<bool>,
    /// The tetrahedron that stands for all with the same center; nothing if each stands for itself.
    same: Vec<u32>,
}

impl Centers {
    /// Of the tetrahedra of a layer that are wanted.
    pub(in crate::space) fn of<W: Cellular>(
        layer: &Layer<W>,
        is_wanted: impl Fn([Place; 4]) -> bool + Send + Sync,
        holds: impl Fn([f64; 3]) -> bool + Send + Sync,
    ) -> Self {
        let slots = if layer.scaffold.is_empty() { layer.mesh.cells.len() } else { 0 };
        let center = |i: usize| {
            let corners = layer.mesh.cells[i].corners;
            let is_finite = !corners[0].is_ghost() && !corners[3].is_ghost();
            let center = (is_finite && is_wanted(corners)).then(|| W::center(corners.map(|p| layer.site(p))));
            center.flatten().unwrap_or([f64::INFINITY; 3])
        };
        let points = parallel::collect(slots, center);
        let inside = parallel::collect(slots, |i| points[i][0].is_finite() && holds(points[i]));
        let same = same(layer, &points);
        Self { points, inside, same }
    }

    /// The index of the corner that the center of a tetrahedron is.
    #[inline]
    pub(in crate::space) fn corner(&self, t: TetrahedronId) -> u32 {
        self.same.get(t.index()).copied().unwrap_or(t.index() as u32)
    }
}

/// Whether two centers are the same but for roundings.
#[inline]
fn are_near(p: [f64; 3], q: [f64; 3]) -> bool {
    const RELATIVE_ROUNDING: f64 = 1.0 / (1_u64 << 40) as f64;
    let size = p.into_iter().chain(q).fold(0.0_f64, |most, x| most.max(x.abs()));
    (0..3).all(|k| (p[k] - q[k]).abs() <= RELATIVE_ROUNDING * size)
}

fn same<W: Lift>(layer: &Layer<W>, points: &[[f64; 3]]) -> Vec<u32> {
    let has_near = |i: usize| {
        let across = layer.mesh.cells[i].across;
        points[i][0].is_finite()
            && across.into_iter().any(|f| {
                let next = points[f.tetrahedron().index()];
                next[0].is_finite() && are_near(points[i], next)
            })
    };
    let parts = parallel::map(parallel::ranges(points.len()), |range| {
        range.filter(|&i| has_near(i)).map(|i| (bits(points[i]), i as u32)).collect::<Vec<_>>()
    });
    let mut near: Vec<([u64; 3], u32)> = parts.concat();
    if near.is_empty() {
        return Vec::new();
    }
    parallel::sort(&mut near);
    let mut same: Vec<u32> = (0..points.len() as u32).collect();
    for equal in near.chunk_by(|p, q| p.0 == q.0) {
        for (_, i) in equal {
            same[*i as usize] = equal[0].1;
        }
    }
    same
}

/// A key of a place without negative zeros.
pub(super) fn bits(p: [f64; 3]) -> [u64; 3] {
    p.map(f64::to_bits)
}
