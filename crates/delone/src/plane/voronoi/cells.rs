//! All cells of a diagram, clipped to a region.
//!
//! Most cells lie inside of the region or outside, and their corners are circumcentres, each computed once. The others are
//! cut out of the region: from the box around it by the bisectors with all neighbours, which needs no rays and no
//! corners far away; then, if the region is no box, from the part of it that is near.
//!
//! Cost: O(n) for the cells inside, O(d (d + s)) for a cell with d neighbours where s sides of the region are near.

use super::Voronoi2;
use super::centres::Centres;
use crate::plane::region::clip::{self, clip};
use crate::plane::region::tree::Relation;
use crate::plane::region::{Region2, enlarged, measure};
use delone_predicates::{Line, circumcentre, power_centre};

use crate::ids::{EdgeId, Place, TriangleId, VertexId};
use crate::locate::Ground;
use crate::plane::layer::Layer;
use crate::plane::layer::kernel::{Kernel, NearestSites, Power, Site};
use crate::points::Bounds;
use crate::prefetch::{self, prefetch};

/// How many triangles ahead memory is asked.
pub(super) const AHEAD: usize = 16;

/// Clipped cells, by site: polygons of one ring or, where the region is not convex, of several. Neighbouring cells
/// share the vertices between them.
#[derive(Clone, Debug, Default)]
pub struct Cells2 {
    /// For each site the first of its rings, and how many there are.
    sites: Vec<[u32; 2]>,
    /// Where each ring starts among the corners; and the end of the last.
    starts: Vec<u32>,
    /// Indices of vertices, ring by ring.
    corners: Vec<u32>,
    /// First the circumcentres by triangle, then what clipping has made.
    vertices: Vec<[f64; 2]>,
}

/// A clipped cell: no ring if nothing of it is left.
#[derive(Clone, Copy, Debug)]
pub struct Cell2<'a> {
    /// Where rings start among the corners, and the end of the last; one number, or none, if there is no ring.
    ends: &'a [u32],
    corners: &'a [u32],
    vertices: &'a [[f64; 2]],
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

    /// Clips all cells to a region, and hands out one after the other. They come in the order of the plane, not of the ids, and nothing is
    /// kept of them: beside the circumcentres this takes no memory.
    ///
    /// ```
    /// use delone::{Delaunay2, Region2};
    ///
    /// let d = Delaunay2::from_points(&[[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]])?;
    /// let mut area = 0.0;
    /// d.voronoi().clip_each(&Region2::rectangle([0.0, 0.0], [4.0, 2.0])?, |_, cell| area += cell.area());
    /// assert_eq!(area, 8.0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn clip_each(self, region: &Region2, each: impl FnMut(VertexId, Cell2<'_>)) {
        Cells2::each(&self.triangulation.base, region, each);
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

/// Clips the cells of all vertices of a layer, one after the other, and hands each to `take` in the room that it is made in.
fn clip_all<K: Cellular>(
    layer: &Layer<K>,
    region: &Region2,
    room: impl FnOnce(Vec<[f64; 2]>) -> Cells2,
    mut take: impl FnMut(&mut Cells2, VertexId, usize),
) -> Cells2 {
    let mesh = &layer.mesh;
    let Centres { points, inside } = Centres::of(layer, region.as_box());
    let mut cells = room(points);
    let mut add = |cells: &mut Cells2, place: Place, e: EdgeId| {
        let corners = || mesh.star_from(e).map(|e| e.triangle().index());
        let first = cells.starts.len() - 1;
        if !cells.push_inside(corners(), &inside) {
            // With weights neither the site nor what it has corners with need be near its cell.
            let around = || mesh.star_from(e).map(|e| mesh.head(e)).filter(|w| !w.is_ghost()).chain([place]);
            let reach = K::HIDES.then(|| Bounds::of(around().map(|p| layer.point(p))));
            cells.push_cut(corners(), reach, region, || borders(layer, place));
        }
        take(cells, mesh.name(place), first);
    };
    if let Some(place) = mesh.lone {
        add(&mut cells, place, EdgeId::NONE);
        return cells;
    }
    // In the order of triangles, which lie in memory as in the plane: each vertex with the first of its edges.
    let mut seen = vec![0_u64; layer.points.len().div_ceil(64)];
    for t in (0..mesh.slot_count()).map(TriangleId::new) {
        if prefetch::HELPS {
            ask_ahead(layer, &cells.vertices, t);
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

/// Asks memory for what the stars of the triangles to come are made of.
#[inline]
fn ask_ahead<K: Cellular>(layer: &Layer<K>, centres: &[[f64; 2]], t: TriangleId) {
    let mesh = &layer.mesh;
    // Stars reach across to triangles that lie elsewhere, and to the next ones beyond.
    for record in mesh.edges.get(4 * (t.index() + 2 * AHEAD)..).into_iter().flatten().take(3) {
        prefetch(&mesh.edges, record.twin.index());
    }
    let next = mesh.edges.get(4 * (t.index() + AHEAD)..).into_iter().flatten().take(3);
    for record in next.filter(|record| !K::HIDES || record.twin != EdgeId::NONE) {
        prefetch(centres, record.twin.triangle().index());
        for beyond in [record.twin.next(), record.twin.previous()] {
            if let Some(record) = mesh.edges.get(beyond.index()) {
                prefetch(&mesh.edges, record.twin.index());
                prefetch(centres, record.twin.triangle().index());
            }
        }
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
        let mut done = 0;
        let room = |centres| Self::empty(ids, layer.mesh.vertex_count(), centres);
        clip_all(layer, region, room, |cells, site, first| {
            cells.assign(site.index(), first);
            done += 1;
            if done % 65_536 == 0 {
                progress(done);
            }
        })
    }

    /// The cells of all vertices of a layer, clipped, one after the other.
    pub(in crate::plane) fn each<K: Cellular>(
        layer: &Layer<K>,
        region: &Region2,
        mut each: impl FnMut(VertexId, Cell2<'_>),
    ) {
        let centres = layer.mesh.slot_count();
        let room = |centres| Self::empty(0, 0, centres);
        clip_all(layer, region, room, |cells, site, _| {
            each(site, Cell2 { ends: &cells.starts, corners: &cells.corners, vertices: &cells.vertices });
            cells.starts.truncate(1);
            cells.corners.clear();
            cells.vertices.truncate(centres);
        });
    }
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
        Self { sites: vec![[0, 0]; ids], starts, corners: Vec::with_capacity(6 * room), vertices }
    }

    /// Adds a cell: as it is by the indices of its corners, or cut out of the region by its borders. Each corner is the centre
    /// of a circle through a site in the cell, or in what is said to be in reach.
    pub(in crate::plane) fn add<L: Iterator<Item = Line> + Clone>(
        &mut self,
        id: usize,
        corners: impl Iterator<Item = usize>,
        reach: Option<Bounds<2>>,
        region: &Region2,
        borders: impl FnOnce() -> L,
    ) {
        let first = self.starts.len() - 1;
        self.push_cut(corners, reach, region, borders);
        self.assign(id, first);
    }

    /// Says whose the rings are from one on.
    #[inline]
    fn assign(&mut self, id: usize, first: usize) {
        self.sites[id] = [first, self.starts.len() - 1 - first].map(|n| n as u32);
    }

    /// The rings of a cell, whole or cut.
    fn push_cut<L: Iterator<Item = Line> + Clone>(
        &mut self,
        corners: impl Iterator<Item = usize>,
        reach: Option<Bounds<2>>,
        region: &Region2,
        borders: impl FnOnce() -> L,
    ) {
        if !self.push_whole(corners, reach, region) {
            for ring in rounded(&cut_by(region, borders()), region) {
                self.push(&ring);
            }
        }
    }

    /// The ring of a cell all of whose corners are known to be inside of a region without dents. Says whether it is one: else nothing
    /// is added.
    #[inline]
    fn push_inside(&mut self, corners: impl Iterator<Item = usize>, inside: &[bool]) -> bool {
        let start = self.corners.len();
        let mut last = [f64::NAN; 2];
        for i in corners {
            if !inside.get(i).is_some_and(|&inside| inside) {
                self.corners.truncate(start);
                return false;
            }
            let corner = self.vertices[i];
            if corner != last {
                self.corners.push(i as u32);
            }
            last = corner;
        }
        // The cell of a lone site has no corners, and is the plane.
        if self.corners.len() == start {
            return false;
        }
        self.close(start, last);
        true
    }

    /// Ends a ring of centres, the last of which is given. Of a cell of two roundings nothing is left.
    #[inline]
    fn close(&mut self, start: usize, last: [f64; 2]) {
        if self.corners.get(start).is_some_and(|&first| self.vertices[first as usize] == last) {
            self.corners.pop();
        }
        if self.corners.len() > start + 2 {
            self.starts.push(self.corners.len() as u32);
        } else {
            self.corners.truncate(start);
        }
    }

    /// The ring of a cell that is surely inside of the region. Says whether that is all: nothing is added of a cell surely outside.
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
        self.close(start, last);
        true
    }

    fn push(&mut self, ring: &[[f64; 2]]) {
        for &corner in ring {
            self.corners.push(self.vertices.len() as u32);
            self.vertices.push(corner);
        }
        self.starts.push(self.corners.len() as u32);
    }

    /// The cell of a site: without rings for an id that is no vertex, and for a cell outside of the region.
    pub fn cell(&self, site: VertexId) -> Cell2<'_> {
        let [first, count] = self.sites.get(site.index()).copied().unwrap_or_default();
        let ends = &self.starts[first as usize..][..count as usize + usize::from(count > 0)];
        Cell2 { ends, corners: &self.corners, vertices: &self.vertices }
    }

    /// The rings of a cell: none for an id that is no vertex, and for a cell outside of the region.
    pub fn rings(&self, site: VertexId) -> impl Iterator<Item = Ring<'_>> + Clone {
        self.cell(site).rings()
    }

    /// The vertices of all cells. Those that no ring uses may be infinite.
    pub fn vertices(&self) -> &[[f64; 2]] {
        &self.vertices
    }

    /// See [`Cell2::area`].
    pub fn area(&self, site: VertexId) -> f64 {
        self.cell(site).area()
    }

    /// See [`Cell2::perimeter`].
    pub fn perimeter(&self, site: VertexId) -> f64 {
        self.cell(site).perimeter()
    }

    /// See [`Cell2::second_moment`].
    pub fn second_moment(&self, site: VertexId, about: [f64; 2]) -> f64 {
        self.cell(site).second_moment(about)
    }

    /// See [`Cell2::centroid`].
    pub fn centroid(&self, site: VertexId) -> Option<[f64; 2]> {
        self.cell(site).centroid()
    }
}

impl<'a> Cell2<'a> {
    /// Its rings.
    pub fn rings(self) -> impl Iterator<Item = Ring<'a>> + Clone {
        let corners = self.ends.windows(2).map(move |ends| &self.corners[ends[0] as usize..ends[1] as usize]);
        corners.map(move |corners| Ring { corners, vertices: self.vertices })
    }

    /// The area, in coordinate units squared. Never negative: less than nothing is rounding. Infinite if it is beyond
    /// the range of `f64`. O(k) for k corners.
    pub fn area(self) -> f64 {
        measure::area(self.rings().map(Ring::points)).max(0.0)
    }

    /// The length of the border, holes included, in coordinate units.
    pub fn perimeter(self) -> f64 {
        self.rings().flat_map(Ring::sides).map(|[p, q]| (q[0] - p[0]).hypot(q[1] - p[1])).sum()
    }

    /// The integral over the cell of the squared distance from a point: with the site, what it costs to carry the cell there. O(k)
    /// for k corners. Not finite beyond the range of `f64`.
    pub fn second_moment(self, about: [f64; 2]) -> f64 {
        measure::second_moment(self.rings().map(Ring::points), about)
    }

    /// The centre of mass. `None` if the cell is empty, or so small that its rounded corners have no area.
    pub fn centroid(self) -> Option<[f64; 2]> {
        measure::centroid(self.rings().map(Ring::points))
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
