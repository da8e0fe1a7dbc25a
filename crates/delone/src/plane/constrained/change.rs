//! Points and segments come and go. After every step the triangulation is the canonical one of what is left.
//!
//! A new point on a constraint splits it. A vertex goes as from a Delaunay triangulation: its star is that of its neighbors'
//! Delaunay triangulation with it, whatever constraints there are around, because it sees all of them. Where a segment goes
//! its edges are flipped, unless another segment covers them.

use super::segments::{Ends, SegmentId};
use super::{Constrained2, crossings};
use crate::error::Error;
use crate::ids::{EdgeId, Inserted, Place, VertexId};
use crate::locate::Locate;
use crate::mesh::Mesh2;
use crate::plane::layer::insert::Spot;
use crate::points::{Position2, finite};

/// The treatment of segments that end at a removed vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SegmentEnds {
    /// It is an error, and nothing changes.
    #[default]
    Refuse,
    /// Where two segments end, and nothing else, they become one between their other ends, under the lesser of both ids and in
    /// its direction.
    Join,
    /// They are removed.
    Drop,
}

impl Constrained2 {
    /// Inserts a point, which splits the constraint that it is on. Its id is the number of ids given before.
    ///
    /// Cost: as [`crate::Delaunay2::insert`].
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities; [`Error::TooManyPoints`] after [`crate::MAX_POINTS`] ids. Nothing has
    /// changed then.
    ///
    /// ```
    /// use delone::Constrained2;
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [4, 0], [0, 4]], &[[0, 1]])?;
    /// c.insert([2, 0])?; // on the segment, which is two constraints then
    /// assert_eq!((c.constraints().count(), c.segments().count()), (2, 1));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn insert<P: Position2>(&mut self, point: P) -> Result<Inserted, Error> {
        let q = finite(point.xy())?;
        let found = self.graph.spot_to_insert(q, &mut ());
        if let Spot::Vertex(place) = found.spot {
            return Ok(Inserted::Existing(self.mesh().name(place)));
        }
        let constraint = self.constraint_at(found.spot, q);
        let ends = constraint.map(|e| [self.mesh().origin(e), self.mesh().destination(e)]);
        let v = self.graph.new_names([q].into_iter())?;
        if let Some(e) = constraint {
            // On a line the halves are fixed as the whole was.
            self.graph.base.mesh.set_fixed(e, !self.graph.base.spanned);
        }
        self.graph.insert_named(v, found, q, &mut ());
        if let Some([a, b]) = ends {
            self.has_chains = true;
            self.fix([[a, v], [v, b]]);
            if let Some(cover) = self.cover.get_mut() {
                cover.replace(&[[a, b]], &[[a, v], [v, b]]);
            }
        }
        Ok(Inserted::New(v))
    }

    /// The constraint that a point is strictly inside of.
    fn constraint_at(&self, spot: Spot, q: [f64; 2]) -> Option<EdgeId> {
        match spot {
            Spot::Segment(e) => Some(e).filter(|&e| self.is_constraint(e)),
            Spot::Triangle(t) if !self.mesh().is_ghost(t) => {
                let edges = [0, 1, 2].map(|k| t.edge(k));
                let is_on = |e: &EdgeId| self.is_constraint(*e) && self.graph.base.is_on(*e, q);
                edges.into_iter().find(is_on)
            }
            _ => None,
        }
    }

    /// Makes edges constraints.
    fn fix(&mut self, edges: impl IntoIterator<Item = Ends>) {
        let mesh = &mut self.graph.base.mesh;
        for ends in edges {
            let [a, b] = ends.map(|v| mesh.place(v).expect("a vertex"));
            let e = mesh.edge_between(a, b).expect("an edge");
            mesh.set_fixed(e, true);
        }
    }

    /// Removes a vertex at which no segment ends. One that passes through it straight stays.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`] if it is no vertex (any more), [`Error::ConstraintsEnd`] if segments end or bend there, or several
    /// cross there. Nothing has changed then.
    pub fn remove(&mut self, v: VertexId) -> Result<(), Error> {
        self.remove_with(v, SegmentEnds::Refuse)
    }

    /// Removes a vertex, with a choice of what becomes of segments that end there.
    ///
    /// # Errors
    /// As [`Self::remove`]; and [`Error::SegmentsCross`] where a joined segment would cross a constraint. Nothing has changed
    /// then.
    pub fn remove_with(&mut self, v: VertexId, ends: SegmentEnds) -> Result<(), Error> {
        let place = self.mesh().place(v).ok_or(Error::NoSuchVertex { vertex: v })?;
        if !self.has_constraint(place) {
            return self.graph.remove(v);
        }
        let turning = self.segments_turning_at(v);
        match (ends, &turning[..]) {
            (_, []) => self.straighten(v),
            (SegmentEnds::Drop, turning) => {
                let cover = self.cover();
                let stays = |w: &VertexId| cover.of([v, *w]).iter().any(|c| !turning.contains(&c.segment));
                let staying = self.constraints_at(v).into_iter().filter(stays).count();
                if staying > 2 {
                    return Err(Error::ConstraintsEnd { vertex: v, count: turning.len() + staying / 2 });
                }
                for &s in turning {
                    self.remove_segment(s)?;
                }
                self.remove_with(v, SegmentEnds::Refuse)
            }
            (SegmentEnds::Join, &[first, second]) => self.join(v, [first, second]),
            (_, turning) => Err(Error::ConstraintsEnd { vertex: v, count: turning.len() }),
        }
    }

    fn has_constraint(&self, place: Place) -> bool {
        let mesh = self.mesh();
        mesh.is_tagged && mesh.spokes(place).any(|e| mesh.is_fixed(e))
    }

    /// The constraint edges at a vertex, by their other ends.
    fn constraints_at(&self, v: VertexId) -> Vec<VertexId> {
        let mesh = self.mesh();
        mesh.star(v).filter(|&e| mesh.is_fixed(e)).map(|e| mesh.destination(e)).collect()
    }

    /// The segments that end or bend at a vertex, by increasing id.
    fn segments_turning_at(&self, v: VertexId) -> Vec<SegmentId> {
        let cover = self.cover();
        let covering = self.constraints_at(v).into_iter().flat_map(|w| cover.of([v, w]));
        let mut turning: Vec<_> =
            covering.map(|c| c.segment).filter(|&s| self.segments.turns_at(s, v)).collect();
        turning.sort_unstable();
        turning.dedup();
        turning
    }

    /// Removes a vertex through which segments pass straight.
    fn straighten(&mut self, v: VertexId) -> Result<(), Error> {
        let &[u, w] = &self.constraints_at(v)[..] else {
            let cover = self.cover();
            let mut passing: Vec<_> = self
                .constraints_at(v)
                .into_iter()
                .flat_map(|w| cover.of([v, w]))
                .map(|c| c.segment)
                .collect();
            passing.sort_unstable();
            passing.dedup();
            return Err(Error::ConstraintsEnd { vertex: v, count: passing.len() });
        };
        // Removal fills a star that is Delaunay, but for constraints around it.
        let pending = self.free([[u, v], [v, w]]);
        self.graph.base.legalize(pending);
        self.graph.remove(v)?;
        let ends = [u, w].map(|v| self.mesh().place(v).expect("a vertex"));
        let forced = self.graph.base.force(ends, &mut self.channel, |_, _| {});
        debug_assert!(forced.is_ok(), "it was free of others before");
        if let Some(cover) = self.cover.get_mut() {
            cover.replace(&[[u, v], [v, w]], &[[u, w]]);
        }
        Ok(())
    }

    /// Makes one segment of two that end at a vertex, and removes it.
    fn join(&mut self, v: VertexId, [first, second]: [SegmentId; 2]) -> Result<(), Error> {
        let refused = Err(Error::ConstraintsEnd { vertex: v, count: 2 });
        let (Some(p), Some(q)) = (self.segments.ends(first), self.segments.ends(second)) else {
            return refused;
        };
        let is_end = |s: SegmentId, ends: Ends| ends.contains(&v) && !self.segments.is_bent(s);
        if self.constraints_at(v).len() != 2 || !is_end(first, p) || !is_end(second, q) {
            return refused;
        }
        let other = q[usize::from(q[0] == v)];
        let joined = if p[0] == v { [other, p[1]] } else { [p[0], other] };
        if joined[0] == joined[1] {
            return refused;
        }
        self.remove_segment(first)?;
        self.remove_segment(second)?;
        if let Err(error) = self.cover_with(first, joined) {
            self.cover_with(first, p).and_then(|()| self.cover_with(second, q)).expect("they were there");
            return Err(error);
        }
        self.remove(v)
    }

    /// Inserts a segment between two vertices, in the direction from the first to the second. Its id is the number of segment
    /// ids given before.
    ///
    /// Cost: the smaller degree of both ends, and as for k edges crossed (see [`Self::from_parts`]).
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`]; [`Error::NoLength`] for twice the same; [`Error::SegmentsCross`] if it crosses a constraint,
    /// with the least segment that does. Nothing has changed then.
    ///
    /// ```
    /// use delone::Constrained2;
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [2, 0], [2, 1], [0, 1]], &[])?;
    /// let corners: Vec<_> = c.vertices().collect();
    /// let diagonal = c.insert_segment(corners[0], corners[2])?;
    /// assert!(c.insert_segment(corners[1], corners[3]).is_err());
    /// c.remove_segment(diagonal)?;
    /// assert!(c.insert_segment(corners[1], corners[3]).is_ok());
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("insert_constraint", "add_constraint"))]
    pub fn insert_segment(&mut self, a: VertexId, b: VertexId) -> Result<SegmentId, Error> {
        let s = self.segments.next();
        self.cover_with(s, [a, b])?;
        Ok(s)
    }

    /// Makes a segment that is not there a constraint.
    fn cover_with(&mut self, s: SegmentId, ends: Ends) -> Result<(), Error> {
        let place = |v: VertexId| self.mesh().place(v).ok_or(Error::NoSuchVertex { vertex: v });
        let places = [place(ends[0])?, place(ends[1])?];
        if ends[0] == ends[1] {
            return Err(Error::NoLength { vertex: ends[0] });
        }
        let obstacles = self.graph.base.obstacles(places);
        if !obstacles.is_empty() {
            return Err(self.crossed(s, ends, &obstacles));
        }
        let mut edges = Vec::new();
        let each = |mesh: &Mesh2, e: EdgeId| edges.push([mesh.origin(e), mesh.destination(e)]);
        let forced = self.graph.base.force(places, &mut self.channel, each);
        debug_assert!(forced.is_ok(), "nothing is crossed");
        self.has_chains |= edges.len() > 1;
        if let Some(cover) = self.cover.get_mut() {
            edges.into_iter().for_each(|edge| cover.add(s, edge));
        }
        self.segments.set(s, ends);
        Ok(())
    }

    /// The error that a segment crosses constraints.
    fn crossed(&self, s: SegmentId, ends: Ends, obstacles: &[EdgeId]) -> Error {
        let mut crossed: Vec<(SegmentId, EdgeId)> = obstacles
            .iter()
            .flat_map(|&e| self.covering(e).into_iter().map(move |c| (c.segment, e)))
            .collect();
        crossed.sort_unstable();
        crossed.dedup_by_key(|(segment, _)| *segment);
        let (first, e) = crossed[0];
        let edge = [self.mesh().origin(e), self.mesh().destination(e)];
        let point = |v: VertexId| self.graph.point(v);
        let near = crossings::place(ends.map(point), edge.map(point));
        Error::SegmentsCross { first: first.index(), second: s.index(), near, count: crossed.len() }
    }

    /// Removes a segment. Its ends, and the vertices on it, stay.
    ///
    /// Cost: O(1) for each flip, see `flips`; the first call makes the table of [`Self::covering`].
    ///
    /// # Errors
    /// [`Error::NoSuchSegment`] if it is not there (any more), or has no length.
    ///
    /// ```
    /// use delone::{Constrained2, VertexId};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [8, 0], [4, 1], [4, -1]], &[])?;
    /// let [a, b] = [0, 1].map(VertexId::new);
    /// let wall = c.insert_segment(a, b)?;
    /// assert!(c.constraints().any(|edge| edge == [a, b] || edge == [b, a]));
    /// c.remove_segment(wall)?;
    /// assert_eq!(c.constraints().count(), 0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("remove_constraint", "remove_constraint_edge"))]
    pub fn remove_segment(&mut self, s: SegmentId) -> Result<(), Error> {
        if self.segments.ends(s).is_none() {
            return Err(Error::NoSuchSegment { segment: s.index() });
        }
        self.cover();
        let mut edges: Vec<Ends> = Vec::new();
        let mesh = self.mesh();
        self.edges_of(s, |_, e| edges.push([mesh.origin(e), mesh.destination(e)]));
        self.segments.remove(s);
        let cover = self.cover.get_mut().expect("just made");
        edges.retain(|&edge| cover.take(s, edge));
        let pending = self.free(edges);
        self.graph.base.legalize(pending);
        Ok(())
    }

    /// Makes edges free, and returns them.
    pub(super) fn free(&mut self, edges: impl IntoIterator<Item = Ends>) -> Vec<EdgeId> {
        let mesh = &mut self.graph.base.mesh;
        let mut freed = Vec::new();
        for ends in edges {
            let [a, b] = ends.map(|v| mesh.place(v).expect("a vertex"));
            let e = mesh.edge_between(a, b).expect("a constraint is an edge");
            mesh.set_fixed(e, false);
            freed.push(e);
        }
        freed
    }

    /// Chooses the strategy of location. Histories and the Delaunay tree are for Delaunay triangulations alone.
    ///
    /// # Errors
    /// [`Error::OnlyDelaunay`] for these, [`Error::Parameter`] for parameters out of range.
    pub fn set_strategy(&mut self, locate: Locate) -> Result<(), Error> {
        match locate {
            Locate::History | Locate::Stars | Locate::DelaunayTree => Err(Error::OnlyDelaunay),
            _ => self.graph.set_strategy(locate),
        }
    }
}
