//! Insertion, removal and motion of vertices, with their names.
//!
//! A vertex keeps its [`VertexId`] while others come and go; ids count up and are never used again, until
//! [`Delaunay2::compact`] gives new ones. What is inserted is laid out near its neighbors in memory; when the number of vertices has doubled, or hints have
//! grown old, everything is laid out in memory as in the plane again, which costs O(log n) amortized.

use super::Delaunay2;
use super::layer::insert::Spot;
use super::locate::Found;
use super::locator::Locator;
use crate::error::Error;
use crate::ids::{Inserted, MAX_POINTS, Place, VertexId};
use crate::locate::{Locate, Start, Strategy, Walk};
use crate::mesh::Names;
use crate::mesh::triangles::Room;
use crate::order;
use crate::points::check_finite;
use crate::points::{Position2, finite};
use crate::tally::Tally;

/// Room of this many places a vertex, beyond which memory is given back.
const SLACK: usize = 8;
/// Up to this number of vertices everything stays in the cache, wherever it is.
const IN_CACHE: usize = 32_768;
/// A new layout is made when there are this many times the vertices of the last one.
const GROWTH: usize = 2;
/// No layout with room is made above this: its indices would not fit.
const LARGEST_SPREAD: usize = MAX_POINTS / 4;

impl Delaunay2 {
    /// Inserts a point. Its id is the number of ids given before.
    ///
    /// Cost: location (see [`Locate`]) and O(1) expected changes for random points; O(log n) amortized for keeping
    /// memory in spatial order.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities; [`Error::TooManyPoints`] after [`MAX_POINTS`] ids. Nothing has
    /// changed then.
    ///
    /// ```
    /// use delone::{Delaunay2, Inserted};
    ///
    /// let mut d = Delaunay2::new();
    /// let a = d.insert([0.0, 0.0])?.vertex();
    /// assert_eq!(d.insert([0.0, 0.0])?, Inserted::Existing(a));
    /// let b = d.insert([1.0, 0.0])?.vertex();
    /// d.insert([0.0, 1.0])?;
    /// d.remove(a)?;
    /// assert!(d.remove(a).is_err()); // gone, and its id never comes back
    /// assert_eq!(d.hull_vertices().next().map(|v| v == b), Some(true));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn insert<P: Position2>(&mut self, point: P) -> Result<Inserted, Error> {
        self.insert_unobserved(point.xy())
    }

    /// Compiled once, whatever is taken for a point.
    fn insert_unobserved(&mut self, point: [f64; 2]) -> Result<Inserted, Error> {
        self.insert_finite(finite(point)?, &mut ())
    }

    /// Inserts a point that is finite, and tells each step.
    pub(super) fn insert_finite<T: Tally>(&mut self, q: [f64; 2], tally: &mut T) -> Result<Inserted, Error> {
        let found = self.spot_to_insert(q, tally);
        if let Spot::Vertex(place) = found.spot {
            return Ok(Inserted::Existing(self.base.mesh.name(place)));
        }
        let v = self.new_names([q].into_iter())?;
        self.insert_named(v, found, q, tally);
        Ok(Inserted::New(v))
    }

    /// Removes a vertex. Points that were reported as its duplicates go with it.
    ///
    /// Its id and its coordinates are remembered, 20 bytes: where vertices come and go for ever, as in a sliding window, call
    /// [`Self::compact`] now and then.
    ///
    /// Cost for degree d: O(d^2) tests up to degree 24, O(d log d) above; the average degree is six. Removing down to
    /// a line or to nothing is fine.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`] if it is no vertex (any more); [`Error::InsertOnly`] with [`Locate::History`] and
    /// [`Locate::Stars`].
    ///
    /// ```
    /// use delone::{Delaunay2, VertexId};
    ///
    /// let mut d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]])?;
    /// d.remove(VertexId::new(4))?;
    /// assert_eq!((d.vertex_count(), d.triangle_count()), (4, 2));
    /// assert!(d.remove(VertexId::new(4)).is_err()); // it is gone
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn remove(&mut self, v: VertexId) -> Result<(), Error> {
        self.remove_vertex(v, &mut ())
    }

    /// Removes a vertex, and tells each step.
    pub(super) fn remove_vertex<T: Tally>(&mut self, v: VertexId, tally: &mut T) -> Result<(), Error> {
        let place = self.removable(v)?;
        self.names().release(v);
        self.displace(place, tally);
        if self.base.points.len() > SLACK * self.vertex_count() + 1024 {
            self.rearrange();
        }
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
    /// use delone::{Delaunay2, VertexId};
    ///
    /// let mut d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]])?;
    /// let v = VertexId::new(4);
    /// d.move_to(v, [3, 1])?;
    /// assert_eq!(d.point(v), [3.0, 1.0]);
    /// assert!(d.move_to(v, [4, 4]).is_err()); // another vertex is there
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "move_if_no_collision")]
    pub fn move_to<P: Position2>(&mut self, v: VertexId, point: P) -> Result<(), Error> {
        self.move_unobserved(v, point.xy())
    }

    /// Compiled once, whatever is taken for a point.
    fn move_unobserved(&mut self, v: VertexId, point: [f64; 2]) -> Result<(), Error> {
        let q = finite(point)?;
        let old = self.removable(v)?;
        let Found { spot, steps, start } = self.spot_to_insert(q, &mut ());
        match spot {
            Spot::Vertex(place) if place == old => {}
            Spot::Vertex(place) => return Err(Error::Occupied { vertex: self.base.mesh.name(place) }),
            spot => {
                self.names().release(v);
                if let Some(named) = &mut self.named {
                    named[v.index()] = q;
                }
                let new = self.base.insert(spot, q, &mut ()).unwrap_or(old);
                self.base.mesh.names().bind(v, new);
                if let Some(locator) = self.locator.get_mut() {
                    locator.inserted(&self.base, new, start, &mut ());
                }
                self.displace(old, &mut ());
                self.duplicates.vertex_moves(v, self.points().len());
                self.note_walk(steps);
            }
        }
        Ok(())
    }

    /// Forgets the ids and the coordinates of all points that are no vertices: those removed, and duplicates. The vertices get
    /// new ids, from 0 on in the order of the old ones. Returns the new id for each old one, `None` for what is no vertex.
    /// Triangles have new ids too.
    ///
    /// Cost: that of a construction. Called when half of all ids are gone it is a small part of what removing them took.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let mut d = Delaunay2::from_points(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]])?;
    /// let [a, b] = [0, 1].map(delone::VertexId::new);
    /// d.remove(a)?;
    /// let ids = d.compact();
    /// assert_eq!((ids[a.index()], d.points().len()), (None, 3));
    /// assert_eq!(ids[b.index()].map(|v| d.point(v)), Some([1.0, 0.0]));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn compact(&mut self) -> Vec<Option<VertexId>> {
        let mut ids = vec![None; self.points().len()];
        let kept: Vec<[f64; 2]> = self.vertices().map(|v| self.point(v)).collect();
        self.vertices().enumerate().for_each(|(k, v)| ids[v.index()] = Some(VertexId::new(k)));
        // It is a function of its points.
        self.rebuild(kept);
        ids
    }

    /// Inserts many points, in a biased randomized order along a curve that the seed decides, each located from
    /// the one before. Point i gets the id that the i-th of single insertions would, duplicates included: these
    /// are reported by [`Self::duplicates`]. Returns the ids as a range of indices.
    ///
    /// Source: Guibas, Knuth & Sharir, Algorithmica 1992, §2.3: n points in random order added to a triangulation of
    /// m change O(m log n + n) edges in expectation. Cost: O((m + n) log (m + n)) expected.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first bad coordinate, [`Error::TooManyPoints`] is as for [`Self::insert`]. Nothing
    /// has changed then.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let mut d = Delaunay2::from_points(&[[0, 0], [4, 0]])?;
    /// assert_eq!(d.extend(&[[0, 4], [4, 4], [1, 1]], 7)?, 2..5);
    /// assert_eq!(d.vertex_count(), 5);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "add_points")]
    pub fn extend<P: Position2>(&mut self, points: &[P], seed: u64) -> Result<std::ops::Range<usize>, Error> {
        let points: Vec<[f64; 2]> = points.iter().map(Position2::xy).collect();
        check_finite(points.iter().copied())?;
        let order = order::plane::insertion_order(&points, seed);
        self.extend_in_order(&points, &order, false, &mut ())
    }

    /// Inserts points in a given order, located by the strategy or each from the one before.
    pub(super) fn extend_in_order<T: Tally>(
        &mut self,
        points: &[[f64; 2]],
        order: &[u32],
        by_strategy: bool,
        tally: &mut T,
    ) -> Result<std::ops::Range<usize>, Error> {
        let first = self.new_names(points.iter().copied())?.index();
        let mut last: Option<VertexId> = None;
        for &i in order {
            let (q, v) = (points[i as usize], VertexId::new(first + i as usize));
            let found = match last.and_then(|v| self.base.mesh.place(v)) {
                Some(place) if !by_strategy && self.base.spanned => {
                    let start = Start::At(self.base.mesh.incident[place.index()], Walk::Visibility);
                    let (spot, steps) = self.base.spot(start, q, tally);
                    Found { spot, steps, start }
                }
                _ => self.spot_to_insert(q, tally),
            };
            if let Spot::Vertex(place) = found.spot {
                let duplicate = self.names().coincide(v, place);
                self.duplicates.push(duplicate);
                last = Some(duplicate.vertex);
            } else {
                self.insert_named(v, found, q, tally);
                last = Some(v);
            }
        }
        self.duplicates.settle();
        Ok(first..first + points.len())
    }

    /// The names, and the coordinates by name, made explicit at the first change.
    fn names(&mut self) -> &mut Names {
        if self.named.is_none() {
            self.named = Some(self.base.points.clone());
            // Places of duplicates are free from now on.
            for duplicate in self.duplicates.iter(|_| true) {
                self.base.free.give(duplicate.point);
            }
        }
        self.base.mesh.names()
    }

    /// New names for points that are to be inserted; returns the first.
    pub(super) fn new_names(
        &mut self,
        points: impl ExactSizeIterator<Item = [f64; 2]>,
    ) -> Result<VertexId, Error> {
        let given = self.points().len();
        let count = given + points.len();
        if count > MAX_POINTS {
            return Err(Error::TooManyPoints { count, most: MAX_POINTS });
        }
        self.names().reserve(points.len());
        if let Some(named) = &mut self.named {
            named.extend(points);
        }
        Ok(VertexId::new(given))
    }

    /// Makes a named point a vertex. Where it falls there is none.
    #[inline]
    pub(super) fn insert_named<T: Tally>(&mut self, v: VertexId, found: Found, q: [f64; 2], tally: &mut T) {
        let place = self.base.place_for(found.spot, q);
        // First the name: memory takes it while the cavity is dug.
        self.base.mesh.names().bind(v, place);
        self.base.insert_at(place, found.spot, tally);
        if let Some(locator) = self.locator.get_mut() {
            locator.inserted(&self.base, place, found.start, tally);
        }
        self.note_walk(found.steps);
    }

    /// Lets places be changed without names for a while: what does not stay in the cache is laid out as in the plane, with room
    /// between.
    pub(super) fn begin_bulk(&mut self) {
        self.locator.take();
        if (IN_CACHE..=LARGEST_SPREAD).contains(&self.vertex_count()) {
            self.rearrange_now(Room::Some);
        } else {
            self.names();
        }
    }

    /// Names what is new at these places, in their order; nothing else has changed.
    pub(super) fn end_bulk(&mut self, new: &[Place]) -> Result<(), Error> {
        let points: Vec<[f64; 2]> = new.iter().map(|p| self.base.points[p.index()]).collect();
        self.named.iter_mut().for_each(|named| named.reserve_exact(points.len()));
        let first = self.new_names(points.into_iter())?.index();
        let names = self.base.mesh.names();
        new.iter().enumerate().for_each(|(k, &p)| names.bind(VertexId::new(first + k), p));
        self.upkeep.renew(self.base.mesh.vertex_count());
        Ok(())
    }

    /// The place of a vertex, if it can be removed.
    fn removable(&self, v: VertexId) -> Result<Place, Error> {
        let place = self.base.mesh.place(v).ok_or(Error::NoSuchVertex { vertex: v })?;
        match self.locate {
            Locate::History | Locate::Stars => Err(Error::InsertOnly),
            _ => Ok(place),
        }
    }

    /// Removes what is at a place.
    fn displace<T: Tally>(&mut self, place: Place, tally: &mut T) {
        if let Some(locator) = self.locator.get_mut() {
            locator.removing(&self.base, place, tally);
        }
        self.base.remove(place, tally);
    }

    /// Keeps account of walks, and lays everything out anew when that has paid.
    #[inline]
    fn note_walk(&mut self, steps: usize) {
        self.upkeep.walked(steps);
        if self.upkeep.is_old(self.base.mesh.vertex_count()) {
            self.rearrange();
        }
    }

    /// A new layout, with hints for it.
    pub(super) fn rearrange_now(&mut self, room: Room) {
        self.names();
        let moved = self.base.lay_out(room);
        if let Some(locator) = self.locator.get_mut() {
            locator.rearranged(&self.base, &moved);
        }
    }

    /// New hints; and a new layout, if there are many more vertices than at the last one, or much room.
    #[cold]
    fn rearrange(&mut self) {
        let count = self.vertex_count();
        let sparse = self.base.points.len() > SLACK * count;
        let grown = count > IN_CACHE && count > GROWTH * self.upkeep.laid_out;
        self.upkeep.renew(count);
        if (sparse || grown) && count <= LARGEST_SPREAD {
            self.upkeep.laid_out = count;
            self.rearrange_now(Room::Much);
        } else if let Some(Locator::Tree(hints)) = self.locator.get_mut() {
            hints.renew(&self.base);
        }
    }
}

/// Keeps account of what has happened since hints were last made.
#[derive(Clone, Debug, Default)]
pub(super) struct Upkeep {
    /// The number of vertices then.
    then: usize,
    /// Steps of walks beyond the usual number, and one for each insertion.
    debt: usize,
    /// The number of vertices when memory was last laid out as in the plane.
    laid_out: usize,
}

impl Upkeep {
    /// Steps of a walk that are considered normal. Only further steps count towards laying out memory anew.
    const NORMAL_WALK_STEPS: usize = 12;
    /// Vertices, up to which memory is never laid out anew: all of it is in the cache.
    const CACHED_VERTICES: usize = 32;

    pub(super) fn renew(&mut self, vertices: usize) {
        *self = Self { then: vertices, debt: 0, ..*self };
    }

    #[inline]
    fn walked(&mut self, steps: usize) {
        self.debt += 1 + steps.saturating_sub(Self::NORMAL_WALK_STEPS);
    }

    /// Whether there are twice as many vertices, or walks have cost as much as a new layout would. Data that
    /// come in cluster by cluster are served too.
    #[inline]
    fn is_old(&self, vertices: usize) -> bool {
        let then = self.then.max(Self::CACHED_VERTICES);
        vertices > 2 * then || (self.debt > 8 * then && vertices > Self::CACHED_VERTICES)
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::Kind;

    use super::{IN_CACHE, Room, SLACK, Upkeep};
    use crate::Delaunay2;

    #[test]
    fn hints_are_old_when_vertices_have_doubled_or_walks_are_long() {
        let mut upkeep = Upkeep { laid_out: 7, ..Upkeep::default() };
        upkeep.renew(100);
        assert_eq!((upkeep.then, upkeep.debt, upkeep.laid_out), (100, 0, 7));
        assert!(!upkeep.is_old(200) && upkeep.is_old(201));
        // A walk of usual length costs one step, any other what it takes longer.
        upkeep.walked(Upkeep::NORMAL_WALK_STEPS);
        upkeep.walked(0);
        assert_eq!(upkeep.debt, 2);
        upkeep.walked(Upkeep::NORMAL_WALK_STEPS + 797);
        assert_eq!(upkeep.debt, 800);
        assert!(!upkeep.is_old(100));
        upkeep.walked(1);
        assert!(upkeep.is_old(100) && !upkeep.is_old(Upkeep::CACHED_VERTICES));
        upkeep.renew(0);
        assert!(
            !upkeep.is_old(2 * Upkeep::CACHED_VERTICES) && upkeep.is_old(2 * Upkeep::CACHED_VERTICES + 1)
        );
    }

    /// Hints each time that vertices have doubled; layouts too, but none for what stays in the cache.
    #[test]
    fn hints_and_layouts_are_renewed_as_vertices_come() {
        let mut d = Delaunay2::new();
        d.extend(&Kind::Uniform.points(IN_CACHE / 2, 1), 1).expect("finite");
        let upkeep = &d.upkeep;
        assert!(2 * upkeep.then >= IN_CACHE / 2 && upkeep.laid_out == 0, "{upkeep:?}");
        d.extend(&Kind::Uniform.points(IN_CACHE, 2), 1).expect("finite");
        let laid_out = d.upkeep.laid_out;
        assert!(2 * laid_out >= d.vertex_count() && laid_out > IN_CACHE, "{:?}", d.upkeep);
        // Hints that are old for another reason need no layout.
        d.upkeep.debt = usize::MAX / 2;
        d.insert([0.5, 0.25]).expect("finite");
        assert_eq!((d.upkeep.laid_out, d.upkeep.then, d.upkeep.debt), (laid_out, d.vertex_count(), 0));
        d.check().expect("canonical");
    }

    /// Of many vertices that go, nearly all memory is given back, in a few steps.
    #[test]
    fn memory_of_what_was_removed_is_given_back() {
        let mut d = Delaunay2::from_points(&Kind::Uniform.points(20_001, 1)).expect("finite");
        let (mut renewed, mut then) = (0, d.upkeep.then);
        let ids: Vec<_> = d.vertices().collect();
        for v in &ids[100..] {
            d.remove(*v).expect("a vertex");
            renewed += usize::from(d.upkeep.then != then);
            then = d.upkeep.then;
            let places = d.base.points.len();
            assert!(places <= SLACK * d.vertex_count() + 1024, "{places} places");
        }
        assert!((1..8).contains(&renewed), "{renewed} layouts");
        d.check().expect("canonical");
    }

    #[test]
    fn a_vertex_may_move_to_where_it_is() {
        let mut d = Delaunay2::from_points(&Kind::Uniform.points(10, 1)).expect("finite");
        let [v, w] = [3, 4].map(crate::VertexId::new);
        assert_eq!(d.move_to(v, d.point(v)), Ok(()));
        assert_eq!(d.move_to(v, d.point(w)), Err(crate::Error::Occupied { vertex: w }));
        d.check().expect("canonical");
    }

    #[test]
    fn a_layout_changes_nothing_that_can_be_seen() {
        for kind in Kind::ALL {
            for (n, room) in
                [0, 1, 2, 3, 4, 10, 100, 1000].into_iter().flat_map(|n| [(n, Room::Much), (n, Room::Some)])
            {
                let points = kind.points(n, 1);
                let mut d = Delaunay2::from_points(&points).expect("finite");
                let mut kept: Vec<_> = d.mesh().vertices().collect();
                kept.retain(|v| v.index() % 3 > 0 || d.remove(*v).is_err());
                let before: Vec<_> =
                    kept.iter().map(|&v| d.mesh().neighbors(v).collect::<Vec<_>>()).collect();
                d.rearrange_now(room);
                d.check().expect("canonical");
                for (&v, before) in kept.iter().zip(before) {
                    let mut now: Vec<_> = d.mesh().neighbors(v).collect();
                    let first = now.iter().position(|w| Some(w) == before.first()).unwrap_or(0);
                    now.rotate_left(first);
                    assert_eq!(now, before, "{kind:?} {n} {v:?}");
                }
                let [x, y] = points.first().copied().unwrap_or([0.5, 0.5]);
                d.insert([x + 0.125, y]).expect("finite");
                d.check().expect("canonical after an insertion");
            }
        }
    }
}
