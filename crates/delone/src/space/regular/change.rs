//! Sites that come, go, and change their weights.
//!
//! Vertices that a new one hides keep their places among the hidden sites. When a vertex goes, its star is filled with
//! the tetrahedra of the vertices around it, and then those that were above its tetrahedra come again, one by one: no other
//! can surface. When vertices span more or less than before, all are triangulated anew.
//!
//! Cost: the walk and the cavity or the star, and O(log h) for each site that was above a tetrahedron that is gone.

use std::ops::Range;

use super::Regular3;
use crate::error::Error;
use crate::hidden::heaviest_first;
use crate::ids::{Inserted, MAX_POINTS_IN_SPACE, Place, TetrahedronId, VertexId};
use crate::locate::{Start, Strategy};
use crate::order;
use crate::points::{Position3, check_count, check_finite, check_weights, finite};
use crate::regular::{Reweighed, compacted};
use delone_predicates::Site;

/// The inverse of the share of sites whose weights may change before building anew is faster.
const REWEIGHED_SHARE: usize = 16;
/// Vertices, up to which hints are not made anew: any hint is near.
const UNHINTED_VERTICES: usize = 32;

impl Regular3 {
    /// Adds a site. It has an id of its own, hidden or not ([`Self::is_hidden`]), unless it equals a vertex. O(log n) on average on
    /// evenly spread sites, and O(log n) for each site that was above a tetrahedron that goes.
    ///
    /// # Errors
    /// [`Error::Coordinate`], [`Error::Weight`] if a number is not finite, [`Error::TooManyPoints`], [`Error::TooManyTetrahedra`];
    /// then nothing changes.
    pub fn insert<P: Position3>(&mut self, point: P, weight: f64) -> Result<Inserted, Error> {
        let q = finite(point.xyz())?;
        check_weights(&[weight])?;
        let given = self.ids_given();
        if given >= MAX_POINTS_IN_SPACE {
            return Err(Error::TooManyPoints { count: given + 1, most: MAX_POINTS_IN_SPACE });
        }
        if self.base.is_in_span(q)
            && let Some(w) = self.base.vertex_at(self.cell_at(q), q)
            && self.base.weights[w.index()] == weight
        {
            return Ok(Inserted::Existing(self.mesh().name(w)));
        }
        self.locate_hidden();
        let place = self.base.keep((q, weight));
        let v = VertexId::new(given);
        self.base.mesh.names.reserve(1);
        match self.settle(v, place) {
            Ok(()) => Ok(Inserted::New(v)),
            Err(full) => {
                self.base.free_place(place);
                Err(full)
            }
        }
    }

    /// Adds many sites, in an order along a curve that the seed decides and that does not show in the tetrahedra. Site i gets the i-th id
    /// after those given before: also one that equals another, which is reported by [`Self::duplicates`]. Returns the ids as a range of
    /// indices.
    ///
    /// Cost: that of as many insertions. Where many are added to few, [`Self::from_sites`] of all is faster.
    ///
    /// # Errors
    /// [`Error::NotFinite`] and [`Error::Weight`] name the first bad number, [`Error::TooManyPoints`] is as for [`Self::insert`]. Nothing has
    /// changed then. [`Error::TooManyTetrahedra`] leaves a part of the sites, the others as ids of none.
    ///
    /// ```
    /// use delone::Regular3;
    ///
    /// let mut r = Regular3::from_sites(&[([0, 0, 0], 0.0), ([4, 0, 0], 0.0), ([0, 4, 0], 0.0), ([0, 0, 4], 0.0)])?;
    /// assert_eq!(r.extend(&[([1, 1, 1], -9.0), ([4, 0, 0], 0.0), ([4, 4, 4], 1.0)], 0)?, 4..7);
    /// assert_eq!((r.vertex_count(), r.hidden().count(), r.duplicates().count()), (5, 1, 1));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn extend<P: Position3>(&mut self, sites: &[(P, f64)], seed: u64) -> Result<Range<usize>, Error> {
        let (points, weights): (Vec<[f64; 3]>, Vec<f64>) = sites.iter().map(|(p, w)| (p.xyz(), *w)).unzip();
        check_finite(points.iter().copied())?;
        check_weights(&weights)?;
        let first = self.ids_given();
        check_count(first + sites.len(), MAX_POINTS_IN_SPACE)?;
        self.base.mesh.names.reserve(sites.len());
        self.locate_hidden();
        let along = order::space::hilbert(points.len(), &|i| points[i as usize]);
        for k in order::space::rounds(points.len(), seed) {
            let i = along[k as usize] as usize;
            let place = self.base.keep((points[i], weights[i]));
            if let Err(full) = self.settle(VertexId::new(first + i), place) {
                self.base.free_place(place);
                return Err(full);
            }
        }
        Ok(first..first + sites.len())
    }

    /// Forgets the ids of all sites that were removed, and the duplicates. The others, hidden ones too, get new ids, from 0 on in the order
    /// of the old ones. Returns the new id for each old one, `None` for what is gone. Tetrahedra have new ids too.
    ///
    /// Cost: that of a construction.
    ///
    /// # Errors
    /// [`Error::TooManyTetrahedra`] if there would be too many on the way. Nothing has changed then.
    ///
    /// ```
    /// use delone::{Regular3, VertexId};
    ///
    /// let corners = [[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]].map(|p| (p, 0.0));
    /// let mut r = Regular3::from_sites(&[&corners[..], &[([1, 1, 1], -9.0)]].concat())?;
    /// r.remove(VertexId::new(0))?;
    /// let ids = r.compact()?;
    /// assert_eq!((ids[0], ids[4].and_then(|v| r.site(v))), (None, Some(([1.0; 3], -9.0))));
    /// assert_eq!(r.ids_given(), 4);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn compact(&mut self) -> Result<Vec<Option<VertexId>>, Error> {
        let sites = (0..self.ids_given()).map(|i| self.site(VertexId::new(i)));
        let (ids, points, weights) = compacted(sites, self.duplicates());
        // It is a function of its sites.
        *self = Self::from_parts(&points, &weights)?;
        Ok(ids)
    }

    /// Takes a site away, hidden or not. Those that only it hid are vertices then. O(log n) on average on evenly spread sites.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`]; then nothing changes. [`Error::TooManyTetrahedra`] where there is no room for what takes its place.
    pub fn remove(&mut self, v: VertexId) -> Result<(), Error> {
        let place = self.lift(v)?;
        self.base.free_place(place);
        Ok(())
    }

    /// Gives a site another weight. The cost of a removal and of an insertion.
    ///
    /// # Errors
    /// As [`Self::remove`], and [`Error::Weight`].
    pub fn set_weight(&mut self, v: VertexId, weight: f64) -> Result<(), Error> {
        check_weights(&[weight])?;
        let place = self.lift(v)?;
        let point = self.base.points[place.index()];
        self.base.free_place(place);
        let place = self.base.keep((point, weight));
        self.settle(v, place)
    }

    /// Gives all sites other weights, by id; those of sites that were removed mean nothing. Each that differs costs a removal and
    /// an insertion; where many do, all is built anew.
    ///
    /// # Errors
    /// [`Error::Length`] unless there is a weight for each id given, [`Error::Weight`] for one that is not finite, by index: then
    /// nothing changes. As [`Self::set_weight`].
    pub fn set_weights(&mut self, weights: &[f64]) -> Result<Reweighed, Error> {
        if weights.len() != self.ids_given() {
            return Err(Error::Length { expected: self.ids_given(), found: weights.len() });
        }
        check_weights(weights)?;
        let alive = (0..weights.len()).map(VertexId::new).filter_map(|v| Some((v, self.site(v)?)));
        let alive: Vec<(VertexId, Site<3>)> = alive.collect();
        let differs = |&&(v, (_, weight)): &&(VertexId, Site<3>)| weight != weights[v.index()];
        let settled = alive.iter().filter(differs).count();
        if settled <= alive.len() / REWEIGHED_SHARE {
            for &(v, _) in alive.iter().filter(differs) {
                self.set_weight(v, weights[v.index()])?;
            }
            return Ok(Reweighed::Repaired { flips: 0, settled });
        }
        let points: Vec<[f64; 3]> = alive.iter().map(|(_, site)| site.0).collect();
        let others: Vec<f64> = alive.iter().map(|(v, _)| weights[v.index()]).collect();
        let mut anew = Self::from_parts(&points, &others)?;
        if alive.len() < weights.len() {
            let ids: Vec<VertexId> = alive.into_iter().map(|(v, _)| v).collect();
            anew.base.mesh.names.rename(&ids, weights.len());
            anew.hidden_sites.rename(&ids);
        }
        *self = anew;
        Ok(Reweighed::Rebuilt)
    }

    /// Takes a site out of the triangulation, and lets those surface that only it hid. It keeps its place.
    fn lift(&mut self, v: VertexId) -> Result<Place, Error> {
        self.locate_hidden();
        if let Some(place) = self.hidden_sites.take(v) {
            return Ok(place);
        }
        let place = self.mesh().place(v).ok_or(Error::NoSuchVertex { vertex: v })?;
        let before = self.dimension();
        let mut star = Vec::new();
        self.base.mesh.star(place, &mut star);
        let site = self.base.site(place);
        self.base.mesh.names.release(v);
        if self.base.remove(place, &mut ()).is_none() {
            self.base.mesh.names.bind(v, place);
            return Err(self.full());
        }
        let kept = self.base.keep(site);
        let mut freed = Vec::new();
        star.into_iter().for_each(|t| self.hidden_sites.take_from(t, &mut freed));
        if self.dimension() != before {
            self.hidden_sites.take_all(&mut freed);
            self.hints.take();
        }
        heaviest_first(&mut freed, &self.base.weights, |&site| site);
        for (id, place) in freed {
            self.settle(id, place)?;
        }
        Ok(kept)
    }

    fn full(&self) -> Error {
        Error::TooManyTetrahedra { most: self.base.mesh.most.0 }
    }

    /// Makes a site a vertex or hides it, and hides with it the sites whose tetrahedra are gone.
    fn settle(&mut self, v: VertexId, place: Place) -> Result<(), Error> {
        let site = self.base.site(place);
        let mut moved: Vec<(VertexId, Place)> = Vec::new();
        if self.base.is_in_span(site.0) {
            let t = self.cell_at(site.0);
            match self.base.vertex_at(t, site.0) {
                Some(w) if self.base.weights[w.index()] == site.1 => {
                    self.put_equal(v, place, w, t);
                    return Ok(());
                }
                _ if !self.base.conflicts(t, site) => {
                    self.hidden_sites.put(v, place, None, Some(t));
                    return Ok(());
                }
                _ => {}
            }
            self.base.insert(place, t, &mut ()).ok_or_else(|| self.full())?;
            self.base.cavity.last().for_each(|t| self.hidden_sites.take_from(t, &mut moved));
            let names = &mut self.base.mesh.names;
            for &p in self.base.cavity.hidden() {
                let id = names.of(p);
                names.release(id);
                moved.push((id, p));
            }
        } else {
            self.base.rebuild(Some(place)).ok_or_else(|| self.full())?;
            self.hidden_sites.take_all(&mut moved);
            self.hints.take();
        }
        self.base.mesh.names.bind(v, place);
        let near = self.base.mesh.incident[place.index()];
        for (id, p) in moved {
            let q = self.base.points[p.index()];
            let t = self.base.walk(near, q, &mut ());
            self.put_at(id, p, t);
        }
        if let Some(hints) = self.hints.get_mut() {
            hints.inserted(&self.base, place, Start::Anywhere, &mut ());
        }
        self.renew_hints();
        Ok(())
    }

    /// Notes a site that is no vertex above a tetrahedron.
    fn put_at(&mut self, id: VertexId, p: Place, t: TetrahedronId) {
        let (q, weight) = self.base.site(p);
        let equal = self.base.vertex_at(t, q).filter(|w| self.base.weights[w.index()] == weight);
        self.hidden_sites.put(id, p, equal.map(|w| self.mesh().name(w)), Some(t));
    }

    /// The first given of equal sites is the vertex.
    fn put_equal(&mut self, v: VertexId, place: Place, w: Place, t: TetrahedronId) {
        let there = self.mesh().name(w);
        if v < there {
            let names = &mut self.base.mesh.names;
            names.release(there);
            names.bind(v, w);
            self.hidden_sites.equal_instead(there, v);
        }
        self.hidden_sites.put(v.max(there), place, Some(v.min(there)), Some(t));
    }

    /// Finds the tetrahedra of the hidden sites, at the first change after a construction.
    fn locate_hidden(&mut self) {
        if self.hidden_sites.are_known {
            return;
        }
        self.hidden_sites.are_known = true;
        let sites: Vec<_> = self.hidden_sites.all().collect();
        for (id, place) in sites {
            let t = self.cell_at(self.base.points[place.index()]);
            self.put_at(id, place, t);
        }
    }

    fn renew_hints(&mut self) {
        let count = self.vertex_count();
        if count > 2 * self.hinted.max(UNHINTED_VERTICES) {
            self.hints.take();
            self.hinted = count;
        }
    }
}
