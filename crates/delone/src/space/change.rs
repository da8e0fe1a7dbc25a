//! Insertion, removal and motion of vertices, with their names.
//!
//! A vertex keeps its [`VertexId`] while others come and go; ids count up and are never used again, until
//! [`Delaunay3::compact`] gives new ones. When vertices span more or less than before, all are triangulated anew.

use super::Delaunay3;
use super::layer::Refusal;
use super::locator::Locator;
use crate::error::Error;
use crate::ids::{Inserted, MAX_POINTS_IN_SPACE, Place, VertexId};
use crate::locate::{Locate, Start, Strategy};
use crate::order;
use crate::order::random::SplitMix;
use crate::points;
use crate::points::{Position3, finite};
use crate::tally::Tally;

/// Vertices, up to which hints are not made anew: any hint is near.
const UNHINTED_VERTICES: usize = 32;

impl Delaunay3 {
    /// Inserts a point. Its id is the number of ids given before.
    ///
    /// Cost: location (see [`Locate`]) and O(1) expected changes for evenly spread points, 28 new tetrahedra; O(n log n)
    /// where it leaves the line or plane of all others.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities; [`Error::TooManyPoints`] after [`MAX_POINTS_IN_SPACE`] ids;
    /// [`Error::TooManyTetrahedra`] beyond 2^30 of these. Nothing has changed then.
    ///
    /// ```
    /// use delone::{Delaunay3, Inserted};
    ///
    /// let mut d = Delaunay3::new();
    /// let a = d.insert([0.0, 0.0, 0.0])?.vertex();
    /// assert_eq!(d.insert([0.0, 0.0, 0.0])?, Inserted::Existing(a));
    /// for p in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
    ///     d.insert(p)?;
    /// }
    /// assert_eq!(d.tetrahedra().count(), 1);
    /// d.remove(a)?;
    /// assert_eq!((d.tetrahedra().count(), d.hull_facets().count()), (0, 1)); // a triangle
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn insert<P: Position3>(&mut self, point: P) -> Result<Inserted, Error> {
        self.insert_finite(finite(point.xyz())?, &mut ())
    }

    /// Inserts a point that is finite, and tells each step.
    pub(super) fn insert_finite<T: Tally>(&mut self, q: [f64; 3], tally: &mut T) -> Result<Inserted, Error> {
        let name = self.base.mesh.names.given();
        if name >= MAX_POINTS_IN_SPACE {
            return Err(Error::TooManyPoints { count: name + 1, most: MAX_POINTS_IN_SPACE });
        }
        match self.insert_unnamed(q, tally) {
            Err(Refusal::Full) => Err(self.full()),
            Err(Refusal::Vertex(there)) => Ok(Inserted::Existing(self.base.mesh.name(there))),
            Ok(place) => {
                let v = VertexId::new(name);
                self.base.mesh.names.reserve(1);
                self.base.mesh.names.bind(v, place);
                Ok(Inserted::New(v))
            }
        }
    }

    /// Removes a vertex. Points that were reported as its duplicates go with it.
    ///
    /// Its id is remembered, 4 bytes: where vertices come and go for ever, call [`Self::compact`] now and then.
    ///
    /// Cost for a star of d tetrahedra, 27 on average: O(d log d) expected; O(n log n) where the others span less.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`] if it is no vertex (any more); [`Error::TooManyTetrahedra`] if what takes the place of its star
    /// does not fit. Nothing has changed then.
    ///
    /// ```
    /// use delone::Delaunay3;
    ///
    /// let cube: Vec<[i32; 3]> = (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2]).collect();
    /// let mut d = Delaunay3::from_points(&cube)?;
    /// let before = d.tetrahedron_count();
    /// let middle = d.insert([0.5, 0.5, 0.5])?.vertex();
    /// d.remove(middle)?;
    /// assert_eq!(d.tetrahedron_count(), before);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn remove(&mut self, v: VertexId) -> Result<(), Error> {
        self.remove_vertex(v, &mut ())
    }

    /// Removes a vertex, and tells each step.
    pub(super) fn remove_vertex<T: Tally>(&mut self, v: VertexId, tally: &mut T) -> Result<(), Error> {
        let place = self.base.mesh.place(v).ok_or(Error::NoSuchVertex { vertex: v })?;
        self.displace(place, tally)?;
        self.base.mesh.names.release(v);
        Ok(())
    }

    /// Moves a vertex, which keeps its id. Points that were reported as its duplicates go, as by [`Self::remove`].
    ///
    /// Cost: one insertion and one removal.
    ///
    /// # Errors
    /// [`Error::Occupied`] if another vertex is there; otherwise those of [`Self::insert`] and [`Self::remove`].
    /// Nothing has changed then.
    ///
    /// ```
    /// use delone::Delaunay3;
    ///
    /// let cube: Vec<[i32; 3]> = (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2]).collect();
    /// let mut d = Delaunay3::from_points(&cube)?;
    /// let inside = d.insert([0.5, 0.5, 0.5])?.vertex();
    /// d.move_to(inside, [0.25, 0.5, 0.5])?;
    /// assert_eq!(d.point(inside), [0.25, 0.5, 0.5]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn move_to<P: Position3>(&mut self, v: VertexId, point: P) -> Result<(), Error> {
        let q = finite(point.xyz())?;
        let old = self.base.mesh.place(v).ok_or(Error::NoSuchVertex { vertex: v })?;
        match self.insert_unnamed(q, &mut ()) {
            Err(Refusal::Full) => Err(self.full()),
            Err(Refusal::Vertex(there)) if there == old => Ok(()),
            Err(Refusal::Vertex(there)) => Err(Error::Occupied { vertex: self.base.mesh.name(there) }),
            Ok(new) => {
                if let Err(full) = self.displace(old, &mut ()) {
                    // Without what came last there is room as before.
                    self.displace(new, &mut ())?;
                    return Err(full);
                }
                self.base.mesh.names.release(v);
                self.base.mesh.names.bind(v, new);
                self.duplicates.vertex_moves(v, self.base.mesh.names.given());
                Ok(())
            }
        }
    }

    /// Forgets the ids of all points that are no vertices: those removed, and duplicates. The vertices get new ids, from 0 on
    /// in the order of the old ones. Returns the new id for each old one, `None` for what is no vertex. Tetrahedra have new
    /// ids too.
    ///
    /// Cost: that of a construction. Called when half of all ids are gone it is a small part of what removing them took.
    ///
    /// # Errors
    /// [`Error::TooManyTetrahedra`] if there would be too many on the way, in an order that is not the one in which the points
    /// came. Nothing has changed then.
    ///
    /// ```
    /// use delone::{Delaunay3, VertexId};
    ///
    /// let mut d = Delaunay3::from_points(&[[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4], [1, 1, 1]])?;
    /// d.remove(VertexId::new(0))?;
    /// let ids = d.compact()?;
    /// assert_eq!((ids[0], ids[4].map(|v| d.point(v))), (None, Some([1.0, 1.0, 1.0])));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn compact(&mut self) -> Result<Vec<Option<VertexId>>, Error> {
        let mut ids = vec![None; self.base.mesh.names.given()];
        let kept: Vec<[f64; 3]> = self.vertices().map(|v| self.point(v)).collect();
        self.vertices().enumerate().for_each(|(k, v)| ids[v.index()] = Some(VertexId::new(k)));
        // It is a function of its points.
        let compacted = Self::from_vec(kept)?;
        *self = Self { locate: self.locate, work: self.work, ..compacted };
        Ok(ids)
    }

    /// Inserts many points, in biased random rounds along a curve that the seed decides. Point i gets the id that the i-th
    /// of single insertions would if all were new; those that equal others are reported by [`Self::duplicates`]. Returns the
    /// ids as a range of indices.
    ///
    /// Cost: that of as many insertions.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first bad coordinate, [`Error::TooManyPoints`] is as for [`Self::insert`]. Nothing
    /// has changed then. [`Error::TooManyTetrahedra`] leaves a part of the points as vertices, the others as ids of none.
    ///
    /// ```
    /// use delone::Delaunay3;
    ///
    /// let mut d = Delaunay3::from_points(&[[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]])?;
    /// assert_eq!(d.extend(&[[1, 1, 1], [4, 0, 0]], 0)?, 4..6);
    /// assert_eq!((d.vertex_count(), d.duplicates().count()), (5, 1));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn extend<P: Position3>(&mut self, points: &[P], seed: u64) -> Result<std::ops::Range<usize>, Error> {
        let first = self.base.mesh.names.given();
        points::check_count(first + points.len(), MAX_POINTS_IN_SPACE)?;
        points::check_finite(points.iter().map(Position3::xyz))?;
        let along = order::space::hilbert(points.len(), &|i| points[i as usize].xyz());
        let order = order::space::rounds(points.len(), seed).into_iter().map(|k| along[k as usize]);
        self.extend_in_order(points, order, &mut ())?;
        Ok(first..first + points.len())
    }

    /// Inserts points in random order.
    pub(super) fn extend_shuffled<P: Position3, T: Tally>(
        &mut self,
        points: &[P],
        seed: u64,
        tally: &mut T,
    ) -> Result<(), Error> {
        let mut order: Vec<u32> = (0..points.len() as u32).collect();
        SplitMix(seed).shuffle(&mut order);
        self.extend_in_order(points, order.into_iter(), tally)
    }

    fn extend_in_order<P: Position3, T: Tally>(
        &mut self,
        points: &[P],
        order: impl Iterator<Item = u32>,
        tally: &mut T,
    ) -> Result<(), Error> {
        let first = self.base.mesh.names.given();
        self.base.mesh.names.reserve(points.len());
        let mut result = Ok(());
        for i in order {
            let v = VertexId::new(first + i as usize);
            match self.insert_unnamed(points[i as usize].xyz(), tally) {
                Ok(place) => self.base.mesh.names.bind(v, place),
                Err(Refusal::Vertex(place)) => {
                    self.duplicates.push(self.base.mesh.names.coincide(v, place));
                }
                Err(Refusal::Full) => {
                    result = Err(self.full());
                    break;
                }
            }
        }
        self.duplicates.settle();
        result
    }

    /// That there is no room for what was asked.
    fn full(&self) -> Error {
        Error::TooManyTetrahedra { most: self.base.mesh.most.0 }
    }

    /// Makes a point a vertex without a name; or says why not.
    fn insert_unnamed<T: Tally>(&mut self, q: [f64; 3], tally: &mut T) -> Result<Place, Refusal> {
        let in_span = self.base.is_in_span(q);
        let start = match self.locator.get_mut() {
            _ if !in_span => Start::Anywhere,
            Some(locator) => locator.start_to_insert(&self.base, q, tally),
            None => self.locator().start(&self.base, q, tally),
        };
        let from = self.base.start_cell(start);
        let place = self.base.add_point(from, q, tally)?;
        if in_span {
            if let Some(locator) = self.locator.get_mut() {
                locator.inserted(&self.base, place, start, tally);
            }
        } else {
            // Everything was made anew.
            self.locator.take();
        }
        self.renew_hints();
        Ok(place)
    }

    /// Removes what is at a place, if there is room for what takes its place.
    fn displace<T: Tally>(&mut self, place: Place, tally: &mut T) -> Result<(), Error> {
        let before = self.dimension();
        if let Some(locator) = self.locator.get_mut() {
            locator.removing(&self.base, place, tally);
        }
        let removed = self.base.remove(place, tally);
        if self.dimension() != before || removed.is_none() {
            self.locator.take();
        }
        removed.ok_or_else(|| self.full())
    }

    /// New hints, if there are twice as many vertices as when they were made.
    fn renew_hints(&mut self) {
        let count = self.vertex_count();
        if self.locate == Locate::Tree && count > 2 * self.hinted.max(UNHINTED_VERTICES) {
            self.locator.take();
            self.hinted = count;
        }
    }

    /// The structure of the strategy, made at the first need.
    #[inline]
    pub(super) fn locator(&self) -> &Locator {
        self.locator.get_or_init(|| Locator::build(self.locate, &self.base))
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::Random;

    use crate::error::Error;
    use crate::ids::{Inserted, VertexId};
    use crate::locate::{Hierarchy, Locate};
    use crate::mesh::tetrahedra::Most;
    use crate::space::Delaunay3;

    /// Two lines across each other, n^2 / 4 tetrahedra: what does not fit is refused, and nothing has changed then.
    #[test]
    fn what_has_no_room_changes_nothing() {
        let full = Error::TooManyTetrahedra { most: 300 };
        for seed in 0..20 {
            let mut random = Random::new(seed);
            let mut d = Delaunay3::new();
            if seed % 2 == 0 {
                let levels = Hierarchy { ratio: 2.0, smallest_level: 2, ..Hierarchy::default() };
                d.set_strategy(Locate::Hierarchy(levels)).expect("valid");
            }
            d.base.mesh.most = Most(300);
            let (mut refused, mut alive) = (0, Vec::new());
            for _ in 0..400 {
                let before = (d.vertex_count(), d.mesh().cells().count(), d.base.mesh.names.given());
                let x = random.between(-1.0, 1.0);
                let p = if random.below(2) == 0 { [x, 0.0, 1.0] } else { [0.0, x, -1.0] };
                let moves = random.below(4) == 0 && !alive.is_empty();
                let goes = random.below(4) == 0 && !alive.is_empty();
                let result = if moves {
                    let v: VertexId = alive[random.below(alive.len())];
                    d.move_to(v, p)
                } else if goes {
                    let k = random.below(alive.len());
                    let result = d.remove(alive[k]);
                    result.map(|()| _ = alive.swap_remove(k))
                } else {
                    d.insert(p).map(|inserted| {
                        if let Inserted::New(v) = inserted {
                            alive.push(v);
                        }
                    })
                };
                if let Err(error) = result {
                    assert_eq!(error, full);
                    refused += 1;
                    let after = (d.vertex_count(), d.mesh().cells().count(), d.base.mesh.names.given());
                    assert_eq!(before, after, "seed {seed}");
                }
                assert_eq!(d.vertex_count(), alive.len());
                assert!(d.base.mesh.cells.len() <= 300);
                d.check().unwrap_or_else(|flaw| panic!("seed {seed}: {flaw}"));
            }
            assert!(refused > 10, "seed {seed}: {refused}");
            let ids = d.compact().expect("room");
            assert_eq!(ids.iter().flatten().count(), d.vertex_count());
            d.check().expect("canonical");
        }
    }
}
