//! Sites that are not vertices: hidden by others, or equal to a vertex.
//!
//! Each keeps its place, and from the first change on the simplex above which it lies, so that what a change may let
//! surface is found where it happens.
//!
//! Cost: O(log h) for each of h sites that is moved.

use std::collections::{BTreeMap, BTreeSet};

use crate::ids::{Duplicate, Place, VertexId};
use crate::sorting;

/// A site that is no vertex.
#[derive(Clone, Copy, Debug)]
struct Hidden<C> {
    place: Place,
    /// The vertex that it equals, if that is what keeps it from being one.
    equal: Option<VertexId>,
    /// The simplex below the lifted site, once it is known.
    cell: Option<C>,
}

/// See the module. A simplex is a `C`.
#[derive(Clone, Debug)]
pub(crate) struct HiddenSites<C> {
    sites: BTreeMap<VertexId, Hidden<C>>,
    /// The sites whose simplex is known, by simplex.
    cells: BTreeSet<(C, VertexId)>,
    /// The sites that equal a vertex, by vertex.
    equals: BTreeSet<(VertexId, VertexId)>,
    /// Whether those of all are known.
    pub(crate) are_known: bool,
}

impl<C> Default for HiddenSites<C> {
    fn default() -> Self {
        Self { sites: BTreeMap::new(), cells: BTreeSet::new(), equals: BTreeSet::new(), are_known: false }
    }
}

impl<C: Copy + Ord> HiddenSites<C> {
    /// Some sites, whose simplices are not known.
    pub(crate) fn new(mut sites: Vec<(VertexId, Place)>) -> Self {
        sites.sort_unstable();
        let entry = |(id, place)| (id, Hidden { place, equal: None, cell: None });
        Self { sites: sites.into_iter().map(entry).collect(), ..Self::default() }
    }

    pub(crate) fn place(&self, id: VertexId) -> Option<Place> {
        self.sites.get(&id).map(|site| site.place)
    }

    /// All, by id, with their places.
    pub(crate) fn all(&self) -> impl Iterator<Item = (VertexId, Place)> + '_ {
        self.sites.iter().map(|(&id, site)| (id, site.place))
    }

    /// All with their places and the simplices below them, by simplex as far as these are known: neighbors after neighbors.
    pub(crate) fn all_above(&self) -> impl Iterator<Item = (VertexId, Place, Option<C>)> + '_ {
        let unknown = self.sites.iter().filter(|(_, site)| site.cell.is_none());
        let unknown = unknown.map(|(&id, site)| (id, site.place, None));
        let known = self.cells.iter().filter_map(|&(t, id)| Some((id, self.place(id)?, Some(t))));
        known.chain(unknown)
    }

    /// The hidden sites.
    pub(crate) fn hidden(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.sites.iter().filter(|(_, site)| site.equal.is_none()).map(|(&id, _)| id)
    }

    /// The sites that equal a vertex.
    pub(crate) fn duplicates(&self) -> impl Iterator<Item = Duplicate> + '_ {
        self.sites
            .iter()
            .filter_map(|(id, site)| site.equal.map(|vertex| Duplicate { point: id.index(), vertex }))
    }

    /// Whether one is hidden.
    pub(crate) fn is_hidden(&self, id: VertexId) -> bool {
        self.sites.get(&id).is_some_and(|site| site.equal.is_none())
    }

    /// The k-th name becomes the k-th of these. No simplex may be known.
    pub(crate) fn rename(&mut self, names: &[VertexId]) {
        let renamed = |(id, mut site): (VertexId, Hidden<C>)| {
            site.equal = site.equal.map(|v| names[v.index()]);
            (names[id.index()], site)
        };
        self.sites = std::mem::take(&mut self.sites).into_iter().map(renamed).collect();
        self.equals = self.duplicates_by_vertex().collect();
    }

    /// Makes all duplicates of one vertex duplicates of another.
    pub(crate) fn equal_instead(&mut self, old: VertexId, new: VertexId) {
        let all = (old, VertexId::new(0))..=(old, VertexId::GHOST);
        let ids: Vec<VertexId> = self.equals.range(all).map(|&(_, id)| id).collect();
        ids.into_iter().for_each(|id| self.set_equal(id, Some(new)));
    }

    pub(crate) fn set_equal(&mut self, id: VertexId, vertex: Option<VertexId>) {
        if let Some(site) = self.sites.get_mut(&id) {
            if let Some(old) = std::mem::replace(&mut site.equal, vertex) {
                self.equals.remove(&(old, id));
            }
            self.equals.extend(vertex.map(|vertex| (vertex, id)));
        }
    }

    fn duplicates_by_vertex(&self) -> impl Iterator<Item = (VertexId, VertexId)> + '_ {
        self.sites.iter().filter_map(|(&id, site)| Some((site.equal?, id)))
    }

    /// Another one, or one above another simplex.
    pub(crate) fn put(&mut self, id: VertexId, place: Place, equal: Option<VertexId>, cell: Option<C>) {
        self.take(id);
        self.sites.insert(id, Hidden { place, equal, cell });
        self.cells.extend(cell.map(|t| (t, id)));
        self.equals.extend(equal.map(|vertex| (vertex, id)));
    }

    /// Takes one away.
    pub(crate) fn take(&mut self, id: VertexId) -> Option<Place> {
        let site = self.sites.remove(&id)?;
        if let Some(t) = site.cell {
            self.cells.remove(&(t, id));
        }
        if let Some(vertex) = site.equal {
            self.equals.remove(&(vertex, id));
        }
        Some(site.place)
    }

    /// Takes those away that were above a simplex, which may be gone.
    pub(crate) fn take_from(&mut self, t: C, taken: &mut Vec<(VertexId, Place)>) {
        let above = (t, VertexId::new(0))..=(t, VertexId::GHOST);
        let ids: Vec<VertexId> = self.cells.range(above).map(|&(_, id)| id).collect();
        taken.extend(ids.into_iter().filter_map(|id| Some((id, self.take(id)?))));
    }

    /// Takes all away.
    pub(crate) fn take_all(&mut self, taken: &mut Vec<(VertexId, Place)>) {
        self.cells.clear();
        self.equals.clear();
        taken.extend(std::mem::take(&mut self.sites).into_iter().map(|(id, site)| (id, site.place)));
    }
}

/// Puts sites into an order in which few that become vertices are hidden by a later one.
pub(crate) fn heaviest_first<S>(sites: &mut [S], weights: &[f64], site: impl Fn(&S) -> (VertexId, Place)) {
    sorting::by(sites, |a, b| {
        let [(id, place), (other, there)] = [a, b].map(&site);
        weights[there.index()].total_cmp(&weights[place.index()]).then(id.cmp(&other))
    });
}
