//! The values of all faces, from above: simplices, their sides, and so on.
//!
//! A side is *attached* if the far corner of a face that it is a side of is strictly inside of its own smallest orthosphere; then its value is
//! the least of theirs. Who is on the sphere does not matter: that face has the same sphere. Otherwise the value is the squared
//! radius of its own, for two faces at a time. All questions and radii are those of `predicates/src/orthosphere.rs`.
//!
//! The work is shared among threads by ranges of faces; what comes out does not depend on it. Vertices have places here in the order
//! in which simplices name them, which are near to each other in memory where they are in space.

use std::ops::Range;

use delone_predicates::{Site, edge_is_attached, triangle_is_attached, vertex_is_attached};

use super::buckets::Buckets;
use super::sites::{Places, Sites, sorted};
use super::{Alpha, Faces};
use crate::ids::{Place, VertexId};
use crate::mesh::Dimension;
use crate::parallel;
use crate::triangulation::{Coordinates, Triangulation};

/// Faces in any order; some still lack their value, which is their own radius.
struct Found<const N: usize> {
    corners: Vec<[Place; N]>,
    values: Vec<f64>,
    open: Vec<usize>,
}

impl<const N: usize> Default for Found<N> {
    fn default() -> Self {
        Self { corners: Vec::new(), values: Vec::new(), open: Vec::new() }
    }
}

impl<const N: usize> Found<N> {
    /// Adds a face, with its value if it is attached.
    fn push(&mut self, corners: [Place; N], attached: Option<f64>) {
        if attached.is_none() {
            self.open.push(self.corners.len());
        }
        self.corners.push(corners);
        self.values.push(attached.unwrap_or_default());
    }

    /// Adds the radii that are missing.
    fn complete<const D: usize>(&mut self, sites: &Sites<D>) {
        for pair in self.open.chunks(2) {
            let both = [pair[0], pair[pair.len() - 1]];
            let radii = sites.scale.radii(both.map(|i| self.corners[i].map(|v| sites.of(v))));
            both.iter().zip(radii).for_each(|(&i, radius)| self.values[i] = radius);
        }
        self.open.clear();
    }

    /// The faces of all parts.
    fn joined(parts: Vec<Self>) -> Self {
        let mut parts = parts.into_iter();
        let mut all = parts.next().unwrap_or_default();
        for part in parts {
            all.corners.extend(part.corners);
            all.values.extend(part.values);
        }
        all
    }

    /// In the order of the filtration, with vertices for places.
    fn sorted<const D: usize>(self, sites: &Sites<D>) -> Faces<N> {
        let order = |i: usize| {
            // As integers floating-point numbers have their own order, negative ones the opposite.
            let bits = self.values[i].to_bits();
            let key = if bits >> 63 == 1 { !bits } else { bits | 1 << 63 };
            (key, sorted(self.corners[i].map(|p| sites.vertex(p))))
        };
        let mut faces = parallel::collect(self.corners.len(), order);
        parallel::sort(&mut faces);
        let value = |key: u64| f64::from_bits(if key >> 63 == 1 { key & !(1 << 63) } else { !key });
        Faces {
            corners: parallel::collect(faces.len(), |i| faces[i].1),
            values: parallel::collect(faces.len(), |i| value(faces[i].0)),
        }
    }
}

impl<const D: usize> Sites<D> {
    /// Shares work on so many things among threads, and completes what is found.
    fn find<const N: usize>(
        &self,
        count: usize,
        work: impl Fn(Range<usize>, &mut Found<N>) + Send + Sync,
    ) -> Found<N> {
        let ends = parallel::even_ends(count, parallel::parts(count));
        let ranges = ends.iter().scan(0, |start, &end| Some(std::mem::replace(start, end)..end));
        let parts = parallel::map(ranges.collect(), |range| {
            let mut found = Found::default();
            work(range, &mut found);
            found.complete(self);
            found
        });
        Found::joined(parts)
    }

    /// Faces that nothing can attach.
    fn own<const N: usize>(&self, faces: &[[Place; N]]) -> Found<N> {
        self.find(faces.len(), |range, found| {
            faces[range].iter().for_each(|&corners| found.push(corners, None));
        })
    }

    /// The sides of tetrahedra, with what is across the side opposite to each corner.
    fn triangles(
        &self,
        tetrahedra: &Found<4>,
        across: impl Fn(usize, usize) -> Option<usize> + Send + Sync,
    ) -> Found<3> {
        let (corners, values) = (&tetrahedra.corners, &tetrahedra.values);
        self.find(corners.len(), |range, found| {
            for i in range {
                for k in 0..4 {
                    let beyond = across(i, k);
                    if beyond.is_some_and(|j| j < i) {
                        continue;
                    }
                    let side = sorted(std::array::from_fn(|m| corners[i][(k + 1 + m) % 4]));
                    let far = beyond.and_then(|j| corners[j].into_iter().find(|p| !side.contains(p)));
                    let is_inside = |q| self.is_triangle_attached(side, q);
                    let is_attached = is_inside(corners[i][k]) || far.is_some_and(is_inside);
                    let least = beyond.map_or(values[i], |j| values[i].min(values[j]));
                    found.push(side, is_attached.then_some(least));
                }
            }
        })
    }

    fn is_triangle_attached(&self, side: [Place; 3], q: Place) -> bool {
        // Of space alone.
        let site = |p: Place| -> Site<3> {
            let (p, w) = self.of(p);
            (std::array::from_fn(|axis| p[axis]), w)
        };
        let [a, b, c] = side.map(site);
        triangle_is_attached(a, b, c, site(q))
    }

    /// The sides of triangles: those of one vertex lie in its bucket, each by its other end with the triangle.
    fn edges(&self, triangles: &Found<3>) -> Found<2> {
        let buckets = Buckets::new(self.count(), triangles.corners.len(), |i| {
            let [a, b, c] = triangles.corners[i];
            let entry = |end: Place| (end.index() as u64) << 32 | i as u64;
            [(a, entry(b)), (a, entry(c)), (b, entry(c))]
        });
        let parts = buckets.in_parts(|p, bucket, found: &mut Found<2>| {
            for same in bucket.chunk_by(|x, y| x >> 32 == y >> 32) {
                let edge = [p, Place::new((same[0] >> 32) as usize)];
                let [a, b] = edge.map(|p| self.of(p));
                let triangles_here = || same.iter().map(|entry| (entry & 0xffff_ffff) as usize);
                let apex = |i: usize| triangles.corners[i].into_iter().find(|q| !edge.contains(q));
                let is_inside = |i| apex(i).is_some_and(|q| edge_is_attached(a, b, self.of(q)));
                let value = triangles_here()
                    .any(is_inside)
                    .then(|| triangles_here().map(|i| triangles.values[i]).fold(f64::INFINITY, f64::min));
                found.push(edge, value);
            }
            // While the sites are at hand.
            found.complete(self);
        });
        Found::joined(parts)
    }

    /// The ends of edges, and vertices without any.
    fn vertices(&self, edges: &Found<2>) -> Found<1> {
        let mut ends = vec![(false, f64::INFINITY); self.count()];
        for (&[p, q], &value) in edges.corners.iter().zip(&edges.values) {
            for [p, q] in [[p, q], [q, p]] {
                let (is_attached, least) = &mut ends[p.index()];
                *is_attached |= vertex_is_attached(self.of(p), self.of(q));
                *least = least.min(value);
            }
        }
        let mut found = Found::default();
        for (i, (is_attached, least)) in ends.into_iter().enumerate() {
            found.push([Place::new(i)], is_attached.then_some(least));
        }
        found.complete(self);
        found
    }
}

/// The alpha complexes of a triangulation whose vertices have weights.
pub(crate) fn build<const D: usize, T>(t: &T, weight: impl Fn(VertexId) -> f64) -> Alpha<D>
where
    T: Triangulation<Point = [f64; D]>,
    [f64; D]: Coordinates,
{
    let mut places = Places::new(t.ids_given());
    let names: Vec<T::Simplex> = t.simplices().collect();
    let (mut triangles, mut tetrahedra) = (Vec::new(), Vec::new());
    if D == 2 {
        triangles.extend(names.iter().map(|&s| sorted(places.all::<3>(t.corners(s).as_ref()))));
    } else if t.dimension() == Dimension::Space {
        tetrahedra.extend(names.iter().map(|&s| places.all::<4>(t.corners(s).as_ref())));
    } else {
        // Of coplanar points these are the triangles.
        triangles.extend(t.hull_facets().map(|facet| sorted(places.all::<3>(facet.as_ref()))));
    }
    let is_flat = triangles.is_empty() && tetrahedra.is_empty();
    let lines: Vec<[Place; 2]> =
        if is_flat { t.edges().map(|edge| places.all(&edge)).collect() } else { Vec::new() };
    t.vertices().take(1).for_each(|v| _ = places.of(v));
    let sites = Sites::new(places.vertices, |v| (t.position(v).unwrap_or([0.0; D]), weight(v)));

    let tetrahedra = sites.own(&tetrahedra);
    let triangles = if tetrahedra.corners.is_empty() {
        sites.own(&triangles)
    } else {
        let mut numbers = vec![0_u32; t.slot_count()];
        names.iter().enumerate().for_each(|(i, &s)| numbers[t.index(s)] = i as u32);
        sites.triangles(&tetrahedra, |i, k| t.across(names[i], k).map(|s| numbers[t.index(s)] as usize))
    };
    let edges = if is_flat { sites.own(&lines) } else { sites.edges(&triangles) };
    let vertices = sites.vertices(&edges);
    Alpha {
        points: (0..t.ids_given()).map(|i| t.position(VertexId::new(i)).unwrap_or([0.0; D])).collect(),
        vertices: vertices.sorted(&sites),
        edges: edges.sorted(&sites),
        triangles: triangles.sorted(&sites),
        tetrahedra: tetrahedra.sorted(&sites),
    }
}
