//! Sites in the order in which simplices name them, near to each other in memory where they are in space.

use delone_predicates::{RadiusScale, Site};

use crate::ids::{Place, VertexId};

/// Gives places to vertices as they are named.
pub(super) struct Places {
    of: Vec<Option<Place>>,
    pub(super) vertices: Vec<VertexId>,
}

impl Places {
    /// For vertices with ids below `ids`.
    pub(super) fn new(ids: usize) -> Self {
        Self { of: vec![None; ids], vertices: Vec::with_capacity(ids) }
    }

    #[inline]
    pub(super) fn of(&mut self, v: VertexId) -> Place {
        *self.of[v.index()].get_or_insert_with(|| {
            self.vertices.push(v);
            Place::new(self.vertices.len() - 1)
        })
    }

    /// The places of corners, in their order.
    pub(super) fn all<const N: usize>(&mut self, corners: &[VertexId]) -> [Place; N] {
        std::array::from_fn(|k| self.of(corners[k]))
    }
}

pub(super) fn sorted<const N: usize, T: Ord>(mut corners: [T; N]) -> [T; N] {
    corners.sort_unstable();
    corners
}

/// The sites by place, the vertex at each, and the scale of their radii.
pub(super) struct Sites<const D: usize> {
    all: Vec<Site<D>>,
    vertices: Vec<VertexId>,
    pub(super) scale: RadiusScale,
}

impl<const D: usize> Sites<D> {
    pub(super) fn new(vertices: Vec<VertexId>, site: impl Fn(VertexId) -> Site<D>) -> Self {
        let sites: Vec<Site<D>> = vertices.iter().map(|&v| site(v)).collect();
        let side = |axis: usize| {
            let all = sites.iter().map(|site| site.0[axis]);
            all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
        };
        let scale = RadiusScale::for_box((0..D).map(side).fold(0.0, f64::max));
        Self { all: sites, vertices, scale }
    }

    pub(super) fn count(&self) -> usize {
        self.all.len()
    }

    #[inline]
    pub(super) fn of(&self, p: Place) -> Site<D> {
        self.all[p.index()]
    }

    #[inline]
    pub(super) fn vertex(&self, p: Place) -> VertexId {
        self.vertices[p.index()]
    }
}
