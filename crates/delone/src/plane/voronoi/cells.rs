//! All cells of a diagram, clipped to a region.
//!
//! Most cells lie inside of the region or outside, and their corners are circumcentres, each computed once. The others are
//! cut out of the region: from the box around it by the bisectors with all neighbours, which needs no rays and no
//! corners far away; then, if the region is no box, from the part of it that is near.
//!
//! Cost: O(n) for the cells inside, O(d (d + s)) for a cell with d neighbours where s sides of the region are near.

use super::Voronoi2;
use crate::plane::region::clip::{self, clip};
use crate::plane::region::tree::Relation;
use crate::plane::region::{Region2, enlarged, measure};
use delone_predicates::{Line, circumcentre, power_centre};

use crate::ids::{EdgeId, Place, TriangleId, VertexId};
use crate::locate::Ground;
use crate::mesh::triangles::HalfEdge;
use crate::plane::layer::Layer;
use crate::plane::layer::kernel::{Kernel, NearestSites, Power, Site};
use crate::points::Bounds;
use crate::prefetch::prefetch;

/// How many triangles ahead memory is asked.
const AHEAD: usize = 16;

/// Clipped cells, by site: polygons of one ring or, where the region is not convex, of several. Neighbouring cells
/// share the vertices between them.
#[derive(Clone, Debug, Default)]
pub struct Cells2 {
    /// For each site the first of its rings, and how many there are.
    sites: Vec<(u32, u32)>,
    /// Where each ring starts among the corners; and the end of the last.
    starts: Vec<u32>,
    /// Indices of vertices, ring by ring.
    corners: Vec<u32>,
    /// First the circumcentres by triangle, then what clipping has made.
    vertices: Vec<[f64; 2]>,
}

/// A closed line of the border of a cell, the cell on its left: an outer ring is counter-clockwise, a hole clockwise.
#[derive(Clone, Copy, Debug)]
pub struct Ring<'a> {
    corners: &'a [u32],
    vertices: &'a [[f64; 2]],
}

impl Voronoi2<'_> {
    /// Clips all cells to a region. Sites may be outside of it. The clipped cells tile the region.
    pub fn clip(self, region: &Region2) -> Cells2 {
        self.clip_with(region, |_| {})
    }

    /// Clips all cells to a region, and tells now and then how many are done.
    pub fn clip_with(self, region: &Region2, progress: impl FnMut(usize)) -> Cells2 {
        let triangulation = self.triangulation;
        Cells2::of(&triangulation.base, triangulation.points().len(), region, progress)
    }

    /// The cell of one vertex, clipped to a region, as rings. Empty for an id that is no vertex.
    pub fn cell(self, site: VertexId, region: &Region2) -> Vec<Vec<[f64; 2]>> {
        let Some(place) = self.triangulation.mesh().place(site) else { return Vec::new() };
        rounded(&cut_out(&self.triangulation.base, region, place), region).collect()
    }
}

/// A kernel whose triangulations are dual to cells.
pub(in crate::plane) trait Cellular: Kernel {
    /// The border of the first site's cell towards the second: positive in the cell.
    fn border(a: Site<Self>, b: Site<Self>) -> Line;

    /// The corner of the cells of three sites.
    fn centre(a: Site<Self>, b: Site<Self>, c: Site<Self>) -> Option<[f64; 2]>;
}

impl Cellular for NearestSites {
    #[inline]
    fn border(a: Site<Self>, b: Site<Self>) -> Line {
        Line::Bisector(a.0, b.0)
    }

    #[inline]
    fn centre(a: Site<Self>, b: Site<Self>, c: Site<Self>) -> Option<[f64; 2]> {
        circumcentre(a.0, b.0, c.0)
    }
}

impl Cellular for Power {
    fn border(a: Site<Self>, b: Site<Self>) -> Line {
        Line::Radical(a, b)
    }

    fn centre(a: Site<Self>, b: Site<Self>, c: Site<Self>) -> Option<[f64; 2]> {
        power_centre(a, b, c)
    }
}

impl Cells2 {
    /// The cells of all vertices of a layer, clipped; `ids` were given.
    pub(in crate::plane) fn of<K: Cellular>(
        layer: &Layer<K>,
        ids: usize,
        region: &Region2,
        mut progress: impl FnMut(usize),
    ) -> Self {
        let mesh = &layer.mesh;
        let mut cells = Self::empty(ids, mesh.vertex_count(), centres(layer));
        let mut done = 0;
        let mut add = |cells: &mut Cells2, place: Place, e: EdgeId| {
            let corners = mesh.star_from(e).map(|e| e.triangle().index());
            // With weights neither the site nor what it has corners with need be near its cell.
            let around = || mesh.star_from(e).map(|e| mesh.head(e)).filter(|w| !w.is_ghost()).chain([place]);
            let reach = K::HIDES.then(|| Bounds::of(around().map(|p| layer.point(p))));
            cells.add(mesh.name(place).index(), corners, reach, region, || borders(layer, place));
            done += 1;
            if done % 65_536 == 0 {
                progress(done);
            }
        };
        if let Some(place) = mesh.lone {
            add(&mut cells, place, EdgeId::NONE);
            return cells;
        }
        // In the order of triangles, which lie in memory as in the plane: each vertex with the first of its edges.
        let mut seen = vec![0_u64; layer.points.len().div_ceil(64)];
        for t in (0..mesh.slot_count()).map(TriangleId::new) {
            // Stars reach across to triangles that lie elsewhere, and to the next ones beyond.
            for record in mesh.edges.get(4 * (t.index() + 2 * AHEAD)..).into_iter().flatten().take(3) {
                prefetch(&mesh.edges, record.twin.index());
            }
            let next = mesh.edges.get(4 * (t.index() + AHEAD)..).into_iter().flatten().take(3);
            for record in next.filter(|record| !K::HIDES || record.twin != EdgeId::NONE) {
                prefetch(&cells.vertices, record.twin.triangle().index());
                for beyond in [record.twin.next(), record.twin.previous()] {
                    if let Some(record) = mesh.edges.get(beyond.index()) {
                        prefetch(&mesh.edges, record.twin.index());
                        prefetch(&cells.vertices, record.twin.triangle().index());
                    }
                }
            }
            for e in [0, 1, 2].map(|k| t.edge(k)) {
                let place = mesh.tail(e);
                let (word, bit) = (place.index() / 64, 1 << (place.index() % 64));
                if seen.get(word).is_some_and(|&word| word & bit == 0) {
                    seen[word] |= bit;
                    add(&mut cells, place, e);
                }
            }
        }
        cells
    }
}

/// The centres of all triangles, by index; infinite where there is none.
pub(in crate::plane) fn centres<K: Cellular>(layer: &Layer<K>) -> Vec<[f64; 2]> {
    let triangles = layer.mesh.edges.chunks_exact(4);
    let ahead = layer.mesh.edges.chunks_exact(4).skip(AHEAD).map(Some).chain(std::iter::repeat(None));
    let centre = |(corners, ahead): (&[HalfEdge], Option<&[HalfEdge]>)| {
        // Corners lie wherever they lay in the input.
        for corner in ahead.into_iter().flatten() {
            prefetch(&layer.points, corner.origin.index());
        }
        let site = |p: Place| (p.index() < layer.points.len()).then(|| layer.site(p));
        let [a, b, c] = [0, 1, 2].map(|k| site(corners[k].origin));
        a.zip(b).zip(c).and_then(|((a, b), c)| K::centre(a, b, c)).unwrap_or([f64::INFINITY; 2])
    };
    triangles.zip(ahead).map(centre).collect()
}

/// A cell cut out of the region by its borders.
pub(in crate::plane) fn cut_out<K: Cellular>(
    layer: &Layer<K>,
    region: &Region2,
    place: Place,
) -> Vec<clip::Ring> {
    cut_by(region, borders(layer, place))
}

/// The borders of a cell, on all sides.
fn borders<K: Cellular>(layer: &Layer<K>, place: Place) -> impl Iterator<Item = Line> + Clone {
    let (mesh, site) = (&layer.mesh, layer.site(place));
    let others = mesh.spokes(place).map(|e| mesh.head(e)).filter(|w| !w.is_ghost());
    others.map(move |w| K::border(site, layer.site(w)))
}

/// What lines leave of a region.
fn cut_by(region: &Region2, lines: impl Iterator<Item = Line> + Clone) -> Vec<clip::Ring> {
    let cut = |mut rings: Vec<clip::Ring>| {
        for line in lines.clone() {
            if rings.is_empty() {
                break;
            }
            rings = clip(rings, line);
        }
        rings
    };
    let framed = cut(vec![region.frame()]);
    if framed.is_empty() {
        return framed;
    }
    match region.around(&framed) {
        None => framed,
        Some(part) => cut(part),
    }
}

/// Rings in coordinate units, without those of which nothing is left.
fn rounded<'a>(rings: &'a [clip::Ring], region: &'a Region2) -> impl Iterator<Item = Vec<[f64; 2]>> + 'a {
    let round = |ring: &'a clip::Ring| {
        let mut corners: Vec<[f64; 2]> =
            ring.iter().filter_map(|corner| region.round(&corner.spot)).collect();
        corners.dedup();
        if corners.first() == corners.last() {
            corners.pop();
        }
        corners
    };
    rings.iter().map(round).filter(|corners| corners.len() > 2)
}

impl Cells2 {
    /// None yet, with the corners that there are, room for some cells, and as many ids.
    pub(in crate::plane) fn empty(ids: usize, room: usize, vertices: Vec<[f64; 2]>) -> Self {
        let mut starts = Vec::with_capacity(room + 1);
        starts.push(0);
        Self { sites: vec![(0, 0); ids], starts, corners: Vec::with_capacity(6 * room), vertices }
    }

    /// Adds a cell: as it is by the indices of its corners, or cut out of the region by its borders. Each corner is the centre
    /// of a circle through a site in the cell, or in what is said to be in reach.
    #[inline]
    pub(in crate::plane) fn add<L: Iterator<Item = Line> + Clone>(
        &mut self,
        id: usize,
        corners: impl Iterator<Item = usize>,
        reach: Option<Bounds<2>>,
        region: &Region2,
        borders: impl FnOnce() -> L,
    ) {
        let first = self.starts.len() - 1;
        if !self.push_whole(corners, reach, region) {
            for ring in rounded(&cut_by(region, borders()), region) {
                self.push(&ring);
            }
        }
        let count = self.starts.len() - 1 - first;
        self.sites[id] = (first as u32, count as u32);
    }

    /// Adds a cell that is surely inside of the region. Says whether that is all: nothing is added of a cell surely outside.
    #[inline]
    fn push_whole(
        &mut self,
        corners: impl Iterator<Item = usize>,
        reach: Option<Bounds<2>>,
        region: &Region2,
    ) -> bool {
        let start = self.corners.len();
        let mut bounds = Bounds::default();
        let mut last = [f64::NAN; 2];
        for i in corners {
            let corner = self.vertices[i];
            bounds.include(corner);
            if corner != last {
                self.corners.push(i as u32);
            }
            last = corner;
        }
        // The corners are rounded: what is asked about is a box that the exact ones are surely in. The site is in the cell, or
        // in what is said to be in reach, so no corner is further from it than both extents together.
        let Bounds { low, high } = bounds;
        if let Some(reach) = reach {
            bounds.include(reach.low);
            bounds.include(reach.high);
        }
        let extents = bounds.extent().iter().sum::<f64>();
        let relation = enlarged(low, high, extents).map(|[low, high]| region.relation(low, high));
        if relation.is_none_or(|relation| relation != Relation::Inside) {
            self.corners.truncate(start);
            return relation == Some(Relation::Outside);
        }
        if self.vertices[self.corners[start] as usize] == last {
            self.corners.pop();
        }
        // Of a cell of two roundings nothing is left.
        if self.corners.len() > start + 2 {
            self.starts.push(self.corners.len() as u32);
        } else {
            self.corners.truncate(start);
        }
        true
    }

    fn push(&mut self, ring: &[[f64; 2]]) {
        for &corner in ring {
            self.corners.push(self.vertices.len() as u32);
            self.vertices.push(corner);
        }
        self.starts.push(self.corners.len() as u32);
    }

    /// The rings of a cell: none for an id that is no vertex, and for a cell outside of the region.
    pub fn rings(&self, site: VertexId) -> impl Iterator<Item = Ring<'_>> + Clone {
        let (first, count) = self.sites.get(site.index()).copied().unwrap_or_default();
        let ends = &self.starts[first as usize..][..count as usize + usize::from(count > 0)];
        let corners = ends.windows(2).map(|ends| &self.corners[ends[0] as usize..ends[1] as usize]);
        corners.map(|corners| Ring { corners, vertices: &self.vertices })
    }

    /// The vertices of all cells. Those that no ring uses may be infinite.
    pub fn vertices(&self) -> &[[f64; 2]] {
        &self.vertices
    }

    /// The area of a cell, in coordinate units squared. Never negative: less than nothing is rounding. Infinite if it is beyond
    /// the range of `f64`. O(k) for k corners.
    pub fn area(&self, site: VertexId) -> f64 {
        measure::area(self.rings(site).map(Ring::points)).max(0.0)
    }

    /// The length of the border of a cell, holes included, in coordinate units.
    pub fn perimeter(&self, site: VertexId) -> f64 {
        self.rings(site).flat_map(Ring::sides).map(|[p, q]| (q[0] - p[0]).hypot(q[1] - p[1])).sum()
    }

    /// The integral over a cell of the squared distance from a point: with the site, what it costs to carry the cell there. O(k)
    /// for k corners. Not finite beyond the range of `f64`.
    pub fn second_moment(&self, site: VertexId, about: [f64; 2]) -> f64 {
        measure::second_moment(self.rings(site).map(Ring::points), about)
    }

    /// The centre of mass of a cell. `None` if it is empty, or so small that its rounded corners have no area.
    pub fn centroid(&self, site: VertexId) -> Option<[f64; 2]> {
        measure::centroid(self.rings(site).map(Ring::points))
    }
}

impl<'a> Ring<'a> {
    /// Its corners, in order.
    pub fn points(self) -> impl ExactSizeIterator<Item = [f64; 2]> + Clone + 'a {
        self.corners.iter().map(move |&i| self.vertices[i as usize])
    }

    /// Its corners as indices into [`Cells2::vertices`].
    pub fn indices(self) -> &'a [u32] {
        self.corners
    }

    /// Its sides, from corner to corner, the last one back to the first.
    pub fn sides(self) -> impl Iterator<Item = [[f64; 2]; 2]> + 'a {
        let next = self.points().cycle().skip(1);
        self.points().zip(next).map(|(p, q)| [p, q])
    }

    /// The area inside, in coordinate units squared; negative for a hole. Infinite beyond the range of `f64`.
    pub fn area(self) -> f64 {
        measure::area(std::iter::once(self.points()))
    }
}
