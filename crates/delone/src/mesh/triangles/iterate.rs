//! Walks over all of a mesh, and around its vertices and its hull.

use super::{Dimension, Mesh2};
use crate::ids::{EdgeId, Place, TriangleId, VertexId};

impl Mesh2 {
    /// The finite vertices, by increasing index.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + Clone + '_ {
        let named = self.names.iter().flat_map(|names| names.vertices());
        let indexed = self.names.is_none().then(|| self.inhabited().map(Place::same));
        named.chain(indexed.into_iter().flatten())
    }

    /// The finite triangles.
    pub fn triangles(&self) -> impl Iterator<Item = TriangleId> + Clone + '_ {
        (0..self.slot_count()).map(TriangleId::new).filter(|&t| !self.is_ghost(t))
    }

    /// The finite edges, each in one of its two directions. Hull edges are included.
    pub fn undirected_edges(&self) -> impl Iterator<Item = EdgeId> + Clone + '_ {
        let finite = |e: &EdgeId| !self.tail(*e).is_ghost() && !self.head(*e).is_ghost();
        self.directed_edges().filter(move |e| *e < self.twin(*e) && finite(e))
    }

    /// All edges, in both directions, those of ghost triangles included.
    pub(super) fn directed_edges(&self) -> impl Iterator<Item = EdgeId> + Clone + '_ {
        let triangles = (0..self.slot_count()).map(TriangleId::new).filter(|&t| self.is_triangle(t));
        triangles.flat_map(|t| [0, 1, 2].map(|k| t.edge(k)))
    }

    /// The edges that leave a vertex, counter-clockwise, those to the ghost vertex included. Empty for an
    /// index that is no vertex, and for a lone one.
    ///
    /// ```
    /// use delone::{Delaunay2, VertexId};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4], [2, 1]])?;
    /// let star = d.mesh().star(VertexId::new(4)); // edges that leave it, counter-clockwise
    /// assert_eq!(star.map(|e| d.mesh().destination(e).index()).count(), 4);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("circulator", "incident_faces", "incident_edges", "out_edges"))]
    pub fn star(&self, v: VertexId) -> Star<'_> {
        self.place(v).map_or(Star { mesh: self, first: EdgeId::NONE, next: EdgeId::NONE }, |p| self.spokes(p))
    }

    /// The star of the vertex at a place.
    pub(crate) fn spokes(&self, place: Place) -> Star<'_> {
        let first = self.incident[place.index()];
        Star { mesh: self, first, next: first }
    }

    /// The edge from one place to another, if there is one: both stars are looked through at once, so that the smaller one
    /// decides what it costs.
    pub(crate) fn edge_between(&self, a: Place, b: Place) -> Option<EdgeId> {
        let e = self.edge_around([a, b], || {})?;
        Some(if self.tail(e) == a { e } else { self.twin(e) })
    }

    /// An edge from one of some places to the next one, or from the last to the first, for places that are all joined so: the stars of
    /// all are looked through at once. `step` hears of each triangle.
    pub(crate) fn edge_around<const N: usize>(
        &self,
        corners: [Place; N],
        mut step: impl FnMut(),
    ) -> Option<EdgeId> {
        let mut stars = corners.map(|v| self.spokes(v));
        loop {
            for (k, star) in stars.iter_mut().enumerate() {
                step();
                let e = star.next()?;
                if self.head(e) == corners[(k + 1) % N] {
                    return Some(e);
                }
            }
        }
    }

    /// The edges with the same origin as one, counter-clockwise from there.
    pub fn star_from(&self, e: EdgeId) -> Star<'_> {
        Star { mesh: self, first: e, next: e }
    }

    /// The vertices joined to `v` by an edge, counter-clockwise.
    #[doc(alias("neighbours", "incident_vertices"))]
    pub fn neighbors(&self, v: VertexId) -> impl Iterator<Item = VertexId> + '_ {
        self.star(v).map(|e| self.destination(e)).filter(|w| !w.is_ghost())
    }

    /// The edge itself, or for an edge of a ghost triangle the hull edge, from inside.
    #[inline]
    pub(crate) fn finite_side(&self, e: EdgeId) -> EdgeId {
        let t = e.triangle();
        match self.places(t).iter().position(|v| v.is_ghost()) {
            Some(k) => self.twin(t.edge(k).next()),
            None => e,
        }
    }

    /// The finite triangles at a vertex, counter-clockwise.
    pub(crate) fn finite_star(&self, v: VertexId) -> Vec<TriangleId> {
        self.star(v).map(EdgeId::triangle).filter(|&t| !self.is_ghost(t)).collect()
    }

    /// The finite triangle across the edge that is opposite to corner k.
    pub(crate) fn across(&self, t: TriangleId, k: usize) -> Option<TriangleId> {
        // Edge k leaves corner k, so that corner is opposite to the edge after it.
        let next = self.twin(t.edge(k).next()).triangle();
        Some(next).filter(|&t| !self.is_ghost(t))
    }

    /// The edges of the convex hull, counter-clockwise. None below the plane.
    pub(crate) fn hull_facets(&self) -> impl Iterator<Item = [VertexId; 2]> + Send + '_ {
        let is_spanned = self.dimension() == Dimension::Plane;
        let closing = self.hull().take(1);
        let ends = self.hull().skip(1).chain(closing);
        self.hull().zip(ends).filter(move |_| is_spanned).map(|(v, w)| [v, w])
    }

    /// The vertices on the border of the convex hull, counter-clockwise, those inside a hull edge included;
    /// the vertices from end to end of a line; or the only vertex.
    #[doc(alias = "convex_hull")]
    pub fn hull(&self) -> Hull<'_> {
        Hull(self.border())
    }

    /// The places of [`Self::hull`].
    pub(crate) fn border(&self) -> Border<'_> {
        let next = match self.dimension() {
            Dimension::Empty | Dimension::Point => EdgeId::NONE,
            // An end of the line has one neighbor: the two ghosts of its segment are all of its star.
            Dimension::Line => {
                Border { mesh: self, first: self.ghost_edge, next: self.ghost_edge, line: false, lone: None }
                    .map(|v| self.incident[v.index()])
                    .find(|&e| self.spin(self.spin(e)) == e)
                    .map_or(EdgeId::NONE, |e| {
                        let outward = if self.head(e).is_ghost() { e } else { self.spin(e) };
                        self.twin(outward)
                    })
            }
            Dimension::Plane | Dimension::Space => self.ghost_edge,
        };
        let line = self.dimension() == Dimension::Line;
        Border { mesh: self, first: next, next, line, lone: self.lone }
    }
}

/// See [`Mesh2::star`].
#[derive(Clone, Debug)]
pub struct Star<'a> {
    mesh: &'a Mesh2,
    first: EdgeId,
    next: EdgeId,
}

impl Iterator for Star<'_> {
    type Item = EdgeId;

    fn next(&mut self) -> Option<EdgeId> {
        if self.next == EdgeId::NONE {
            return None;
        }
        let e = self.next;
        let following = self.mesh.spin(e);
        self.next = if following == self.first { EdgeId::NONE } else { following };
        Some(e)
    }
}

/// See [`Mesh2::hull`].
#[derive(Clone, Debug)]
pub struct Hull<'a>(Border<'a>);

impl Iterator for Hull<'_> {
    type Item = VertexId;

    fn next(&mut self) -> Option<VertexId> {
        self.0.next().map(|p| self.0.mesh.name(p))
    }
}

/// See [`Mesh2::border`].
#[derive(Clone, Debug)]
pub(crate) struct Border<'a> {
    mesh: &'a Mesh2,
    /// Edges that leave the ghost vertex; turning clockwise around it is counter-clockwise on the hull.
    first: EdgeId,
    next: EdgeId,
    /// Stop at the far end of a line instead of coming back on its other side.
    line: bool,
    lone: Option<Place>,
}

impl Iterator for Border<'_> {
    type Item = Place;

    fn next(&mut self) -> Option<Place> {
        if self.next == EdgeId::NONE {
            return self.lone.take();
        }
        let e = self.next;
        let v = self.mesh.head(e);
        let following = self.mesh.twin(e).next();
        // At the far end of a line the next hull vertex is the previous one again.
        let turned = self.line && e != self.first && self.mesh.head(following) == self.mesh.tip(e);
        self.next = if following == self.first || turned { EdgeId::NONE } else { following };
        Some(v)
    }
}
