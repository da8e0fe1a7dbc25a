//! The values of all faces, from above: simplices, their sides, and so on.
//!
//! A side is *attached* if the far corner of a face that it is a side of is strictly inside of its own smallest orthosphere; then its value is
//! the least of theirs. Who is on the sphere does not matter: that face has the same sphere. Otherwise the value is the squared
//! radius of its own, for two faces at a time. All questions and radii are those of `predicates/src/orthosphere.rs`.
//!
//! The work is shared among threads by ranges of faces; what comes out does not depend on it.

use std::ops::Range;

use delone_predicates::{
    RadiusScale, Site, edge_is_attached, triangle_is_attached, vertex_is_attached,
};

use super::buckets::Buckets;
use super::{Alpha, Faces};
use crate::ids::VertexId;
use crate::mesh::Dimension;
use crate::parallel;
use crate::triangulation::{Coordinates, Triangulation};

/// The sites by id, and the scale of their radii.
struct Sites<const D: usize> {
    sites: Vec<Site<D>>,
    scale: RadiusScale,
}

/// Faces in any order; some still lack their value, which is their own radius.
struct Found<const N: usize> {
    corners: Vec<[VertexId; N]>,
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
    fn push(&mut self, corners: [VertexId; N], attached: Option<f64>) {
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

    /// In the order of the filtration.
    fn sorted(self) -> Faces<N> {
        let order = |i: usize| {
            // As integers floating-point numbers have their own order, negative ones the opposite.
            let bits = self.values[i].to_bits();
            let key = if bits >> 63 == 1 { !bits } else { bits | 1 << 63 };
            (key, self.corners[i])
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
    #[inline]
    fn of(&self, v: VertexId) -> Site<D> {
        self.sites[v.index()]
    }

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
    fn own<const N: usize>(&self, faces: &[[VertexId; N]]) -> Found<N> {
        self.find(faces.len(), |range, found| {
            faces[range].iter().for_each(|&corners| found.push(corners, None));
        })
    }

    /// The sides of tetrahedra with these values by index.
    fn triangles<T: Triangulation>(&self, t: &T, tetrahedra: &[T::Simplex], values: &[f64]) -> Found<3> {
        self.find(tetrahedra.len(), |range, found| {
            for &s in &tetrahedra[range] {
                let corners = t.corners(s);
                let corners = corners.as_ref();
                for k in 0..4 {
                    let beyond = t.across(s, k);
                    if beyond.is_some_and(|n| n < s) {
                        continue;
                    }
                    let side = sorted(std::array::from_fn(|i| corners[(k + 1 + i) % 4]));
                    let far = beyond.map(|n| t.corners(n));
                    let far = far.iter().flat_map(|far| far.as_ref().iter().copied());
                    let mut apexes = std::iter::once(corners[k]).chain(far.filter(|v| !side.contains(v)));
                    let is_attached = apexes.any(|q| self.is_triangle_attached(side, q));
                    let least = beyond.map_or(f64::INFINITY, |n| values[t.index(n)]).min(values[t.index(s)]);
                    found.push(side, is_attached.then_some(least));
                }
            }
        })
    }

    fn is_triangle_attached(&self, side: [VertexId; 3], q: VertexId) -> bool {
        // Of space alone.
        let site = |v: VertexId| -> Site<3> {
            let (p, w) = self.of(v);
            (std::array::from_fn(|axis| p[axis]), w)
        };
        let [a, b, c] = side.map(site);
        triangle_is_attached(a, b, c, site(q))
    }

    /// The sides of triangles: those of one vertex lie in its bucket, each by its other end with all that is across.
    fn edges(&self, triangles: &Found<3>) -> Found<2> {
        let buckets = Buckets::new(self.sites.len(), triangles.corners.len(), |i| {
            let [a, b, c] = triangles.corners[i];
            let i = i as u32;
            [(a, (Some(b), Some(c), i)), (a, (Some(c), Some(b), i)), (b, (Some(c), Some(a), i))]
        });
        let parts = buckets.in_parts(|v, bucket, found: &mut Found<2>| {
            for same in bucket.chunk_by(|x, y| x.0 == y.0) {
                let Some(w) = same[0].0 else { continue };
                let (a, b) = (self.of(v), self.of(w));
                let is_inside = |q: &Option<VertexId>| q.is_some_and(|q| edge_is_attached(a, b, self.of(q)));
                let least = |least: f64, i: u32| least.min(triangles.values[i as usize]);
                let attached = same.iter().any(|(_, q, _)| is_inside(q));
                let value = attached.then(|| same.iter().fold(f64::INFINITY, |x, &(.., i)| least(x, i)));
                found.push([v, w], value);
            }
        });
        let parts = parallel::map(parts, |mut found| {
            found.complete(self);
            found
        });
        Found::joined(parts)
    }

    /// The ends of edges, and vertices without any.
    fn vertices(&self, vertices: impl Iterator<Item = VertexId>, edges: &Found<2>) -> Found<1> {
        let mut attached = vec![f64::INFINITY; self.sites.len()];
        let mut least = attached.clone();
        for (&[v, w], &value) in edges.corners.iter().zip(&edges.values) {
            for [v, w] in [[v, w], [w, v]] {
                least[v.index()] = least[v.index()].min(value);
                if vertex_is_attached(self.of(v), self.of(w)) {
                    attached[v.index()] = 0.0;
                }
            }
        }
        let mut found = Found::default();
        for v in vertices {
            let is_attached = attached[v.index()] == 0.0;
            found.push([v], is_attached.then_some(least[v.index()]));
        }
        found.complete(self);
        found
    }
}

fn sorted<const N: usize>(mut corners: [VertexId; N]) -> [VertexId; N] {
    corners.sort_unstable();
    corners
}

/// The corners of a simplex or a facet, by increasing id.
fn array<const N: usize>(corners: &[VertexId]) -> [VertexId; N] {
    sorted(std::array::from_fn(|k| corners[k]))
}

/// The alpha complexes of a triangulation whose vertices have weights.
pub(crate) fn build<const D: usize, T>(t: &T, weight: impl Fn(VertexId) -> f64) -> Alpha<D>
where
    T: Triangulation<Point = [f64; D]>,
    [f64; D]: Coordinates,
{
    let mut sites = vec![([0.0; D], 0.0); t.ids_given()];
    t.vertices().for_each(|v| sites[v.index()] = (t.position(v).unwrap_or([0.0; D]), weight(v)));
    let side = longest_side(t.vertices().map(|v| sites[v.index()].0));
    let sites = Sites { sites, scale: RadiusScale::for_box(side) };
    let simplices: Vec<T::Simplex> = t.simplices().collect();
    let corners = |i: usize| t.corners(simplices[i]);
    let (triangles, tetrahedra) = if D == 2 {
        let corners = parallel::collect(simplices.len(), |i| array(corners(i).as_ref()));
        (sites.own(&corners), Found::default())
    } else if t.dimension() == Dimension::Space {
        let corners = parallel::collect(simplices.len(), |i| array(corners(i).as_ref()));
        let tetrahedra: Found<4> = sites.own(&corners);
        let mut values = vec![0.0; t.slot_count()];
        simplices.iter().zip(&tetrahedra.values).for_each(|(&s, &value)| values[t.index(s)] = value);
        (sites.triangles(t, &simplices, &values), tetrahedra)
    } else {
        // Of coplanar points these are the triangles.
        let corners: Vec<[VertexId; 3]> = t.hull_facets().map(|facet| array(facet.as_ref())).collect();
        (sites.own(&corners), Found::default())
    };
    let edges = if triangles.corners.is_empty() {
        let edges: Vec<[VertexId; 2]> = t.edges().map(|edge| sorted(edge)).collect();
        sites.own(&edges)
    } else {
        sites.edges(&triangles)
    };
    let vertices = sites.vertices(t.vertices(), &edges);
    Alpha {
        vertices: vertices.sorted(),
        edges: edges.sorted(),
        triangles: triangles.sorted(),
        tetrahedra: tetrahedra.sorted(),
        points: sites.sites.into_iter().map(|site| site.0).collect(),
    }
}

fn longest_side<const D: usize>(points: impl Iterator<Item = [f64; D]>) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    for p in points {
        for axis in 0..D {
            low[axis] = low[axis].min(p[axis]);
            high[axis] = high[axis].max(p[axis]);
        }
    }
    (0..D).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max)
}
