//! The regions of a diagram, and the circles that are their corners.

use delone_predicates::circumcenter;

use super::OrderK2;
use super::grow::NO_REGION;
use crate::ids::VertexId;

/// A circle through three sites, as an order sees it; a half-plane if one of them is the ghost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Circle {
    /// Counter-clockwise, the smallest first.
    pub(super) on: [VertexId; 3],
    /// For each of them a region: with it, of a new circle; without it, of an old one.
    pub(super) regions: [u32; 3],
    /// Whether one site more is inside in the order before.
    pub(super) is_old: bool,
}

/// A region of a diagram of some order: where some sites are the nearest ones.
#[derive(Clone, Copy, Debug)]
pub struct OrderRegion2<'a> {
    pub(super) diagram: &'a OrderK2<'a>,
    pub(super) index: usize,
}

/// A circle through three sites whose center is a corner of three regions.
#[derive(Clone, Copy, Debug)]
pub struct OrderCircle2<'a> {
    pub(super) diagram: &'a OrderK2<'a>,
    pub(super) index: usize,
}

/// A side of a region, beyond which one site is exchanged for another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Exchange {
    /// The site that is nearest no longer.
    pub lost: VertexId,
    /// The site that is instead of it.
    pub gained: VertexId,
}

impl<'a> OrderRegion2<'a> {
    /// Its index among the regions of the diagram.
    pub fn index(self) -> usize {
        self.index
    }

    /// Its sites, by increasing index.
    pub fn sites(self) -> &'a [VertexId] {
        self.diagram.sites_of(self.index)
    }

    /// Its corners, counter-clockwise: the circles whose centers they are.
    pub fn circles(self) -> impl Iterator<Item = OrderCircle2<'a>> + Clone {
        let circle = move |&corner: &u32| OrderCircle2 { diagram: self.diagram, index: corner as usize / 3 };
        self.corners().iter().map(circle).filter(|circle| circle.is_finite())
    }

    /// Whether it is bounded. The sites of an unbounded one are a *k-set*: on one side of some line they are alone, up to
    /// sites on the line.
    pub fn is_bounded(self) -> bool {
        let is_finite = |&corner: &u32| !self.diagram.circles[corner as usize / 3].is_ghost();
        !self.corners().is_empty() && self.corners().iter().all(is_finite)
    }

    /// Its sides, counter-clockwise, each with the region beyond it. Each side lies on the bisector of the two sites.
    pub fn sides(self) -> impl Iterator<Item = (Exchange, OrderRegion2<'a>)> + Clone {
        let side = move |&corner: &u32| {
            let circle = &self.diagram.circles[corner as usize / 3];
            let i = corner as usize % 3;
            let (own, last) = (circle.on[i], circle.on[(i + 2) % 3]);
            let (lost, gained) = if circle.is_old { (last, own) } else { (own, last) };
            let beyond = circle.regions[(i + 2) % 3];
            let region = OrderRegion2 { diagram: self.diagram, index: beyond as usize };
            (beyond != NO_REGION && !gained.is_ghost()).then_some((Exchange { lost, gained }, region))
        };
        self.corners().iter().filter_map(side)
    }

    /// Its corners as the diagram has them, those at infinity included.
    pub(super) fn corners(self) -> &'a [u32] {
        let ends = &self.diagram.starts[self.index..self.index + 2];
        &self.diagram.corners[ends[0] as usize..ends[1] as usize]
    }
}

impl<'a> OrderCircle2<'a> {
    /// The three sites on it, counter-clockwise, the smallest first.
    pub fn on(self) -> [VertexId; 3] {
        self.circle().on
    }

    /// The sites inside, by increasing index: k - 1 or k - 2.
    pub fn inside(self) -> impl Iterator<Item = VertexId> + Clone + 'a {
        let Circle { on, regions, .. } = *self.circle();
        let region = regions.into_iter().find(|&region| region != NO_REGION);
        let sites = region.map_or(&[][..], |region| self.diagram.sites_of(region as usize));
        sites.iter().copied().filter(move |v| !on.contains(v))
    }

    /// The three regions around its center.
    pub fn regions(self) -> [OrderRegion2<'a>; 3] {
        self.circle().regions.map(|region| OrderRegion2 { diagram: self.diagram, index: region as usize })
    }

    /// Its center, rounded (see [`delone_predicates::circumcenter`]); `None` where it is too far away for `f64`.
    pub fn center(self) -> Option<[f64; 2]> {
        let [a, b, c] = self.on().map(|v| self.diagram.triangulation.point(v));
        circumcenter(a, b, c)
    }

    pub(super) fn is_finite(self) -> bool {
        !self.circle().is_ghost()
    }

    fn circle(self) -> &'a Circle {
        &self.diagram.circles[self.index]
    }
}

impl Circle {
    pub(super) fn is_ghost(&self) -> bool {
        self.on.iter().any(|v| v.is_ghost())
    }
}
