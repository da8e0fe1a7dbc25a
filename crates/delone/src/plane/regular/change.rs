//! Sites that come, go, and change their weights.
//!
//! Vertices that a new one hides keep their places among the hidden sites. When a vertex goes, its star is filled with
//! the triangles of the vertices around it, and then those that were above its triangles come again, one by one: no other
//! can surface.
//!
//! Cost: the walk and the cavity or the star, and O(log h) for each site that was above a triangle that is gone; while all
//! sites are on one line, for all of them.

use std::ops::Range;

use super::Regular2;
use super::build::divide_and_conquer;
use super::settle::Settled;
use crate::error::Error;
use crate::hidden::heaviest_first;
use crate::ids::{Inserted, MAX_POINTS, Place, VertexId};
use crate::locate::{Start, Strategy, Walk};
use crate::mesh::Names;
use crate::order;
use crate::plane::layer::insert::Spot;
use crate::points::{Position2, check_count, check_finite, check_weights, finite};
use crate::regular::compacted;

/// Vertices, up to which hints are not made anew: any hint is near.
const UNHINTED_VERTICES: usize = 32;

impl Regular2 {
    /// Adds a site. It has an id of its own, hidden or not ([`Self::is_hidden`]), unless it equals a vertex. O(log n) on average, and O(log n)
    /// for each site that was above a triangle that goes.
    ///
    /// # Errors
    /// [`Error::Coordinate`], [`Error::Weight`] if a number is not finite, [`Error::TooManyPoints`]; then nothing changes.
    ///
    /// ```
    /// use delone::Regular2;
    ///
    /// let mut r = Regular2::from_sites(&[([0, 0], 0.0), ([4, 0], 0.0), ([4, 4], 0.0), ([0, 4], 0.0), ([2, 2], 0.0)])?;
    /// let v = r.insert([2, 1], 8.0)?.vertex(); // so heavy that it hides the one beside it
    /// assert!(!r.is_hidden(v) && r.is_hidden(delone::VertexId::new(4)));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn insert<P: Position2>(&mut self, point: P, weight: f64) -> Result<Inserted, Error> {
        let q = finite(point.xy())?;
        check_weights(&[weight])?;
        let given = self.ids_given();
        if given >= MAX_POINTS {
            return Err(Error::TooManyPoints { count: given + 1, most: MAX_POINTS });
        }
        let (spot, _) = self.spot(q);
        if let Spot::Vertex(w) = spot
            && self.base.weights[w.index()] == weight
        {
            return Ok(Inserted::Existing(self.mesh().name(w)));
        }
        let v = VertexId::new(given);
        self.base.mesh.names.get_or_insert_with(Names::default).reserve(1);
        let place = self.base.place_for(spot, q);
        self.base.weights[place.index()] = weight;
        self.locate_hidden();
        self.settle(v, place, spot);
        Ok(Inserted::New(v))
    }

    /// Adds many sites, in an order along a curve that the seed decides and that does not show in the triangles. Site i gets the i-th id
    /// after those given before: also one that equals another, which is reported by [`Self::duplicates`]. Returns the ids as a range of
    /// indices.
    ///
    /// Cost: that of as many insertions. Where many are added to few, [`Self::from_sites`] of all is faster.
    ///
    /// # Errors
    /// [`Error::NotFinite`] and [`Error::Weight`] name the first bad number, [`Error::TooManyPoints`] is as for [`Self::insert`]. Nothing has
    /// changed then.
    ///
    /// ```
    /// use delone::Regular2;
    ///
    /// let mut r = Regular2::from_sites(&[([0, 0], 0.0), ([4, 0], 0.0), ([0, 4], 0.0)])?;
    /// assert_eq!(r.extend(&[([1, 1], -9.0), ([4, 0], 0.0), ([4, 4], 1.0)], 0)?, 3..6);
    /// assert_eq!((r.vertex_count(), r.hidden().count(), r.duplicates().count()), (4, 1, 1));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn extend<P: Position2>(&mut self, sites: &[(P, f64)], seed: u64) -> Result<Range<usize>, Error> {
        let (points, weights): (Vec<[f64; 2]>, Vec<f64>) = sites.iter().map(|(p, w)| (p.xy(), *w)).unzip();
        check_finite(points.iter().copied())?;
        check_weights(&weights)?;
        let first = self.ids_given();
        check_count(first + sites.len(), MAX_POINTS)?;
        self.base.mesh.names.get_or_insert_with(Names::default).reserve(sites.len());
        self.locate_hidden();
        for i in order::plane::insertion_order(&points, seed).into_iter().map(|i| i as usize) {
            let (spot, _) = self.spot(points[i]);
            let place = self.base.place_for(spot, points[i]);
            self.base.weights[place.index()] = weights[i];
            self.settle(VertexId::new(first + i), place, spot);
        }
        Ok(first..first + sites.len())
    }

    /// Forgets the ids of all sites that were removed, and the duplicates. The others, hidden ones too, get new ids, from 0 on in the order
    /// of the old ones. Returns the new id for each old one, `None` for what is gone. Triangles have new ids too.
    ///
    /// Cost: that of a construction.
    ///
    /// ```
    /// use delone::{Regular2, VertexId};
    ///
    /// let mut r = Regular2::from_sites(&[([0, 0], 0.0), ([4, 0], 0.0), ([0, 4], 0.0), ([1, 1], -9.0)])?;
    /// r.remove(VertexId::new(0))?;
    /// let ids = r.compact();
    /// assert_eq!((ids[0], ids[3].and_then(|v| r.site(v))), (None, Some(([1.0, 1.0], -9.0))));
    /// assert_eq!(r.ids_given(), 3);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn compact(&mut self) -> Vec<Option<VertexId>> {
        let sites = (0..self.ids_given()).map(|i| self.site(VertexId::new(i)));
        let (ids, points, weights) = compacted(sites, self.duplicates());
        // It is a function of its sites.
        *self = divide_and_conquer(&points, &weights);
        ids
    }

    /// Takes a site away, hidden or not. Those that only it hid are vertices then. O(log n) on average.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`]; then nothing changes.
    pub fn remove(&mut self, v: VertexId) -> Result<(), Error> {
        let place = self.lift(v)?;
        self.base.free_place(place);
        Ok(())
    }

    /// Gives a site another weight. The cost of a removal and of an insertion.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`], [`Error::Weight`]; then nothing changes.
    ///
    /// ```
    /// use delone::{Regular2, VertexId};
    ///
    /// let mut r = Regular2::from_sites(&[([0, 0], 9.0), ([4, 0], 9.0), ([0, 4], 9.0), ([1, 1], 0.0)])?;
    /// r.set_weight(VertexId::new(3), 9.0)?;
    /// assert_eq!(r.hidden().count(), 0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn set_weight(&mut self, v: VertexId, weight: f64) -> Result<(), Error> {
        check_weights(&[weight])?;
        let place = self.lift(v)?;
        self.base.weights[place.index()] = weight;
        self.settle_again(v, place);
        Ok(())
    }

    /// Takes a site out of the triangulation, and lets those surface that only it hid. It keeps its place.
    fn lift(&mut self, v: VertexId) -> Result<Place, Error> {
        self.locate_hidden();
        if let Some(place) = self.hidden_sites.take(v) {
            return Ok(place);
        }
        let place = self.mesh().place(v).ok_or(Error::NoSuchVertex { vertex: v })?;
        let mut freed = Vec::new();
        let before = self.dimension();
        if self.base.spanned {
            let star: Vec<_> = self.base.mesh.spokes(place).map(|e| e.triangle()).collect();
            star.into_iter().for_each(|t| self.hidden_sites.take_from(t, &mut freed));
        }
        self.base.mesh.names().release(v);
        let site = self.base.site(place);
        self.base.remove(place, &mut ());
        // The place stays with its site.
        let kept = self.base.new_place(place.index(), site.0);
        self.base.weights[kept.index()] = site.1;
        if self.dimension() != before || !self.base.spanned {
            self.hidden_sites.take_all(&mut freed);
            self.hints.take();
        }
        heaviest_first(&mut freed, &self.base.weights, |&site| site);
        freed.into_iter().for_each(|(id, place)| self.settle_again(id, place));
        Ok(kept)
    }

    /// Finds where a site falls, and settles it there.
    fn settle_again(&mut self, v: VertexId, place: Place) {
        let (spot, _) = self.spot(self.base.points[place.index()]);
        self.settle(v, place, spot);
    }

    /// Makes a site a vertex or hides it, and hides with it the sites whose triangles are gone.
    pub(super) fn settle(&mut self, v: VertexId, place: Place, spot: Spot) {
        let was_spanned = self.base.spanned;
        let mut hidden = Vec::new();
        match self.base.settle(place, spot, &mut hidden, &mut ()) {
            Settled::Hidden => return self.put_under(v, place, spot),
            Settled::Equal(w) => {
                // The first given of equal ones is the vertex.
                let there = self.mesh().name(w);
                let names = self.base.mesh.names();
                if v < there {
                    names.release(there);
                    names.bind(v, w);
                    self.hidden_sites.equal_instead(there, v);
                }
                return self.put_under(v.max(there), place, spot);
            }
            Settled::Vertex => {}
        }
        let mut moved: Vec<(VertexId, Place)> = Vec::new();
        if was_spanned {
            let (star, _) = self.base.cavity.last();
            let (_, spare) = self.base.cavity.swallowed();
            star.iter().chain(spare).for_each(|&t| self.hidden_sites.take_from(t, &mut moved));
        } else {
            self.hidden_sites.take_all(&mut moved);
            self.hints.take();
        }
        let names = self.base.mesh.names();
        for p in hidden {
            let id = names.of(p);
            names.release(id);
            moved.push((id, p));
        }
        names.bind(v, place);
        let near = self.base.mesh.incident[place.index()];
        for (id, p) in moved {
            let start = if self.base.spanned { Start::At(near, Walk::Visibility) } else { Start::Anywhere };
            let (spot, _) = self.base.spot(start, self.base.points[p.index()], &mut ());
            self.put_under(id, p, spot);
        }
        let start = Start::Anywhere;
        if let Some(hints) = self.hints.get_mut() {
            hints.inserted(&self.base, place, start, &mut ());
        }
        self.renew_hints();
    }

    /// Notes a site that is no vertex where it falls.
    fn put_under(&mut self, v: VertexId, place: Place, spot: Spot) {
        let mesh = &self.base.mesh;
        let finite = |t: &_| !mesh.is_ghost(*t);
        let (equal, cell) = match spot {
            Spot::Vertex(w) => {
                let cell =
                    self.base.spanned.then(|| mesh.spokes(w).map(|e| e.triangle()).find(finite)).flatten();
                (Some(w).filter(|w| self.base.weights[w.index()] == self.base.weights[place.index()]), cell)
            }
            Spot::Triangle(t) => (None, Some(t)),
            _ => (None, None),
        };
        self.hidden_sites.put(v, place, equal.map(|w| mesh.name(w)), cell);
    }

    /// Finds the triangles of the hidden sites, at the first change after a construction.
    pub(super) fn locate_hidden(&mut self) {
        if self.hidden_sites.are_known {
            return;
        }
        self.hidden_sites.are_known = true;
        let sites: Vec<_> = self.hidden_sites.all().collect();
        for (id, place) in sites {
            let (spot, _) = self.spot(self.base.points[place.index()]);
            self.put_under(id, place, spot);
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
