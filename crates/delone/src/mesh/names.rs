//! Which vertex is kept where.
//!
//! A vertex keeps its name, the [`VertexId`], for life; a name is never given twice. Its place moves with the
//! memory and is used again. As long as a mesh was only built in bulk the two are equal, and there is no table.

use crate::ids::{Duplicate, Place, VertexId};
use crate::parallel::filled;

/// Both ways: 4 bytes a name ever given, 4 bytes a place.
#[derive(Debug, Default)]
pub(crate) struct Names {
    /// For each place its vertex; [`VertexId::GHOST`] for a free one.
    of: Vec<VertexId>,
    /// For each name its place; [`Place::GHOST`] for a vertex that is gone, and for the name of a duplicate.
    places: Vec<Place>,
}

impl Clone for Names {
    fn clone(&self) -> Self {
        Self { of: self.of.clone(), places: self.places.clone() }
    }

    /// In the memory that there is.
    fn clone_from(&mut self, source: &Self) {
        self.of.clone_from(&source.of);
        self.places.clone_from(&source.places);
    }
}

impl Names {
    /// As if every name had been its own place; `vertex` tells which are vertices.
    pub(crate) fn identical(count: usize, vertex: impl Fn(Place) -> bool) -> Self {
        let place = |i| Some(Place::new(i)).filter(|&p| vertex(p));
        Self {
            of: (0..count).map(|i| place(i).map_or(VertexId::GHOST, Place::same)).collect(),
            places: (0..count).map(|i| place(i).unwrap_or(Place::GHOST)).collect(),
        }
    }

    /// Vertex `order[k]` at place k.
    pub(crate) fn along(order: &[u32]) -> Self {
        let mut places = vec![Place::GHOST; order.len()];
        for (place, &i) in order.iter().enumerate() {
            places[i as usize] = Place::new(place);
        }
        Self { of: order.iter().map(|&i| VertexId::new(i as usize)).collect(), places }
    }

    /// Lets there be another place, without a vertex.
    pub(crate) fn add_place(&mut self) {
        self.of.push(VertexId::GHOST);
    }

    /// The number of names ever given.
    pub(crate) fn given(&self) -> usize {
        self.places.len()
    }

    /// Memory of both tables, in bytes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.of) + size_of_val(&*self.places)
    }

    /// The vertex at a place.
    #[inline]
    pub(crate) fn of(&self, place: Place) -> VertexId {
        self.of[place.index()]
    }

    /// Where a vertex is, if it is one.
    #[inline]
    pub(crate) fn place(&self, v: VertexId) -> Option<Place> {
        self.places.get(v.index()).copied().filter(|p| !p.is_ghost())
    }

    /// Sets names aside, each for a point that is no vertex yet.
    pub(crate) fn reserve(&mut self, count: usize) {
        self.places.resize(self.places.len() + count, Place::GHOST);
    }

    /// The k-th name becomes the k-th of these, of so many that were given.
    pub(crate) fn rename(&mut self, names: &[VertexId], given: usize) {
        for v in self.of.iter_mut().filter(|v| !v.is_ghost()) {
            *v = names[v.index()];
        }
        let mut places = filled(Place::GHOST, given);
        for (v, &place) in names.iter().zip(&self.places) {
            places[v.index()] = place;
        }
        self.places = places;
    }

    /// A vertex appears at a place.
    pub(crate) fn bind(&mut self, v: VertexId, place: Place) {
        if self.of.len() <= place.index() {
            self.of.resize(place.index() + 1, VertexId::GHOST);
        }
        self.of[place.index()] = v;
        self.places[v.index()] = place;
    }

    /// A vertex goes from its place.
    pub(crate) fn release(&mut self, v: VertexId) {
        if let Some(place) = self.place(v) {
            self.of[place.index()] = VertexId::GHOST;
            self.places[v.index()] = Place::GHOST;
        }
    }

    /// The point named `v` equals the vertex at a place: of the two the one given first is the vertex.
    pub(crate) fn coincide(&mut self, v: VertexId, place: Place) -> Duplicate {
        self.release(v);
        let there = self.of(place);
        if v < there {
            self.release(there);
            self.bind(v, place);
        }
        Duplicate { point: v.max(there).index(), vertex: v.min(there) }
    }

    /// No names, in the memory that there is.
    pub(crate) fn clear(&mut self) {
        self.of.clear();
        self.places.clear();
    }

    /// Every vertex moves to the place that `moved` gives for its old one.
    pub(crate) fn rearrange(&mut self, capacity: usize, moved: &[Place]) {
        let mut of = filled(VertexId::GHOST, capacity);
        for (old, &name) in self.of.iter().enumerate() {
            if !name.is_ghost() {
                of[moved[old].index()] = name;
                self.places[name.index()] = moved[old];
            }
        }
        self.of = of;
    }

    /// All vertices, by increasing name.
    pub(super) fn vertices(&self) -> impl Iterator<Item = VertexId> + Clone + '_ {
        let here = |(name, place): (usize, &Place)| (!place.is_ghost()).then(|| VertexId::new(name));
        self.places.iter().enumerate().filter_map(here)
    }
}
