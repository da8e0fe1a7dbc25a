//! All cells of a diagram, clipped to a region.
//!
//! Most cells lie inside of the region or outside, and their corners are circumcenters, each computed once. The others are
//! cut out of the region: from the box around it by the bisectors with all neighbors, which needs no rays and no
//! corners far away; then, if the region is no box, from the part of it that is near.
//!
//! Cost: O(n) for the cells inside, O(d (d + s)) for a cell with d neighbors where s sides of the region are near.

use super::Voronoi2;
use super::build::Builder;
use super::cells::{Cell2, Cells2};
use super::centers::Centers;
use crate::plane::region::Region2;
use std::cmp::Ordering::{Greater, Less};

use crate::plane::region::clip::{self, Corner, clip};
use delone_predicates::{Line, Sign, Spot, circumcenter, power_center};

use crate::ids::{EdgeId, Place, TriangleId, VertexId};
use crate::plane::layer::Layer;
use crate::plane::layer::kernel::{Kernel, NearestSites, Power, Site};
use crate::prefetch::{self, prefetch};

/// Triangles between the one in work and the one that is prefetched.
pub(super) const PREFETCH_DISTANCE: usize = 16;

impl Voronoi2<'_> {
    /// Clips all cells to a region. Sites may be outside of it. The clipped cells tile the region.
    ///
    /// ```
    /// use delone::{Delaunay2, Region2, VertexId};
    ///
    /// let d = Delaunay2::from_points(&[[1, 1], [3, 1]])?;
    /// let cells = d.voronoi().clip(&Region2::rectangle([0, 0], [4, 3])?);
    /// assert_eq!(d.vertices().map(|v| cells.area(v)).collect::<Vec<_>>(), [6.0, 6.0]);
    /// assert_eq!(cells.rings(VertexId::new(0)).next().map(|ring| ring.points().count()), Some(4));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "voronoi_finite_polygons")]
    pub fn clip(self, region: &Region2) -> Cells2 {
        self.clip_with(region, |_| {})
    }

    /// Clips all cells to a region, and tells now and then how many are done.
    pub fn clip_with(self, region: &Region2, progress: impl FnMut(usize)) -> Cells2 {
        let triangulation = self.triangulation;
        Cells2::of(&triangulation.base, triangulation.points().len(), region, progress)
    }

    /// Clips all cells to a region, and hands out one after the other. They come in the order of the plane, not of the ids, and nothing is
    /// kept of them: beside the circumcenters this takes no memory.
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
}

/// A kernel whose triangulations are dual to cells.
pub(in crate::plane) trait Cellular: Kernel {
    /// The border of the first site's cell towards the second: positive in the cell.
    fn border(a: Site<Self>, b: Site<Self>) -> Line;

    /// The corner of the cells of three sites.
    fn center(a: Site<Self>, b: Site<Self>, c: Site<Self>) -> Option<[f64; 2]>;
}

impl Cellular for NearestSites {
    #[inline]
    fn border(a: Site<Self>, b: Site<Self>) -> Line {
        Line::Bisector(a.0, b.0)
    }

    #[inline]
    fn center(a: Site<Self>, b: Site<Self>, c: Site<Self>) -> Option<[f64; 2]> {
        circumcenter(a.0, b.0, c.0)
    }
}

impl Cellular for Power {
    fn border(a: Site<Self>, b: Site<Self>) -> Line {
        Line::Radical(a, b)
    }

    fn center(a: Site<Self>, b: Site<Self>, c: Site<Self>) -> Option<[f64; 2]> {
        power_center(a, b, c)
    }
}

/// Clips the cells of all vertices of a layer, one after the other, and tells of each which of the rings is its first.
fn clip_all<K: Cellular>(
    layer: &Layer<K>,
    inside: &[bool],
    builder: &mut Builder<'_>,
    take: &mut dyn FnMut(&mut Builder<'_>, VertexId, usize),
) {
    let mesh = &layer.mesh;
    let mut add = |builder: &mut Builder<'_>, place: Place, e: EdgeId| {
        let corners = || mesh.star_from(e).map(|e| e.triangle().index());
        let first = builder.cells().starts.len() - 1;
        if !builder.push_inside(corners(), inside) {
            builder.push_cut(corners(), || borders(layer, place));
        }
        take(builder, mesh.name(place), first);
    };
    if let Some(place) = mesh.lone {
        add(builder, place, EdgeId::NONE);
        return;
    }
    // In the order of triangles, which lie in memory as in the plane: each vertex with the first of its edges.
    let mut seen = vec![0_u64; layer.points.len().div_ceil(64)];
    for t in (0..mesh.slot_count()).map(TriangleId::new) {
        if prefetch::HELPS {
            ask_ahead(layer, &builder.cells().vertices, t);
        }
        for e in [0, 1, 2].map(|k| t.edge(k)) {
            let place = mesh.tail(e);
            let (word, bit) = (place.index() / 64, 1 << (place.index() % 64));
            if seen.get(word).is_some_and(|&word| word & bit == 0) {
                seen[word] |= bit;
                add(builder, place, e);
            }
        }
    }
}

/// Asks memory for what the stars of the triangles to come are made of.
#[inline]
fn ask_ahead<K: Cellular>(layer: &Layer<K>, centers: &[[f64; 2]], t: TriangleId) {
    let mesh = &layer.mesh;
    // Stars reach across to triangles that lie elsewhere, and to the next ones beyond.
    for record in mesh.edges.get(4 * (t.index() + 2 * PREFETCH_DISTANCE)..).into_iter().flatten().take(3) {
        prefetch(&mesh.edges, record.twin.index());
    }
    let next = mesh.edges.get(4 * (t.index() + PREFETCH_DISTANCE)..).into_iter().flatten().take(3);
    for record in next.filter(|record| record.twin != EdgeId::NONE) {
        prefetch(centers, record.twin.triangle().index());
        for beyond in [record.twin.next(), record.twin.previous()] {
            if let Some(record) = mesh.edges.get(beyond.index()) {
                prefetch(&mesh.edges, record.twin.index());
                prefetch(centers, record.twin.triangle().index());
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
        let Centers { points, inside } = Centers::of(layer, region.as_box());
        let mut builder = Builder::new(region, ids, layer.mesh.vertex_count(), points);
        let mut done = 0;
        clip_all(layer, &inside, &mut builder, &mut |builder, site, first| {
            builder.assign(site.index(), first);
            done += 1;
            if done % 65_536 == 0 {
                progress(done);
            }
        });
        builder.finish()
    }

    /// The cells of all vertices of a layer, clipped, one after the other. Each is looked at before the first is handed out; if a ring is
    /// to be mended all are kept.
    pub(in crate::plane) fn each<K: Cellular>(
        layer: &Layer<K>,
        region: &Region2,
        mut each: impl FnMut(VertexId, Cell2<'_>),
    ) {
        let Centers { points, inside } = Centers::of(layer, region.as_box());
        let mut builder = Builder::new(region, 0, 0, points);
        clip_all(layer, &inside, &mut builder, &mut |builder, _, _| builder.forget());
        if builder.is_good() {
            clip_all(layer, &inside, &mut builder, &mut |builder, site, _| {
                each(site, builder.cells().all());
                builder.forget();
            });
            return;
        }
        let count = layer.mesh.vertex_count();
        let mut builder = Builder::new(region, count, count, builder.into_centers());
        let mut sites = Vec::with_capacity(count);
        clip_all(layer, &inside, &mut builder, &mut |builder, site, first| {
            builder.assign(sites.len(), first);
            sites.push(site);
        });
        let cells = builder.finish();
        for (k, site) in sites.into_iter().enumerate() {
            each(site, cells.cell(VertexId::new(k)));
        }
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

/// The rest of a region after cuts by lines.
pub(super) fn cut_by(region: &Region2, lines: impl Iterator<Item = Line> + Clone) -> Vec<clip::Ring> {
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
        Some(part) => {
            let spots = part.iter().flatten().map(|corner| corner.spot);
            let corners: Vec<Spot> = spots.filter(|spot| matches!(spot, Spot::Point(_))).collect();
            let mut rings = cut(part);
            corners.iter().for_each(|corner| touch(&mut rings, corner, lines.clone()));
            rings
        }
    }
}

/// Makes a corner of the region that is on a border of a cell, from whichever side it touches it, a corner there: the cell beyond has it
/// too.
fn touch(rings: &mut [clip::Ring], corner: &Spot, lines: impl Iterator<Item = Line> + Clone) {
    let mut on = false;
    for line in lines.clone() {
        match line.side(corner) {
            Sign::Negative => return,
            Sign::Zero => on = true,
            Sign::Positive => (),
        }
    }
    for line in lines.filter(|line| on && line.side(corner).is_zero()) {
        for ring in &mut *rings {
            for i in (0..ring.len()).rev() {
                let next = &ring[(i + 1) % ring.len()].spot;
                let is_between = [(&ring[i].spot, corner), (corner, next)].map(|(p, q)| line.compare(p, q));
                if ring[i].side.is_none()
                    && ring[i].line == line
                    && matches!(is_between, [Less, Less] | [Greater, Greater])
                {
                    ring.insert(i + 1, Corner { spot: *corner, ..ring[i] });
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use crate::plane::{Delaunay2, Region2};

    type Ring = Vec<[f64; 2]>;

    fn rectangle([x, y]: [f64; 2], [w, h]: [f64; 2]) -> Ring {
        vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]]
    }

    /// All cells together and one by one; each side is that of another cell too, or the border of the region.
    fn cells(sites: &[[f64; 2]], rings: &[Ring]) -> Vec<Vec<Ring>> {
        let region = Region2::polygon(rings).expect("a region");
        let d = Delaunay2::from_points(sites).expect("sites");
        let together = d.voronoi().clip(&region);
        let of = |v| together.rings(v).map(|ring| ring.points().collect()).collect::<Vec<Ring>>();
        let all: Vec<Vec<Ring>> = d.vertices().map(of).collect();
        let bits = |p: [f64; 2]| p.map(|x| (x + 0.0).to_bits());
        let sides = |rings: &[Ring]| -> Vec<[[f64; 2]; 2]> {
            rings
                .iter()
                .flat_map(|ring| (0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()]]))
                .collect()
        };
        let every: BTreeSet<[[u64; 2]; 2]> =
            all.iter().flat_map(|cell| sides(cell)).map(|side| side.map(bits)).collect();
        for (v, cell) in d.vertices().zip(&all) {
            assert_eq!(d.voronoi().cell(v, &region).concat().len(), cell.concat().len(), "{v:?} alone");
            for [p, q] in sides(cell) {
                let is_border = region.rings().any(|ring| {
                    sides(&[ring.to_vec()]).iter().any(|[a, b]| {
                        [p, q].iter().all(|p| delone_predicates::orient2d(*a, *b, *p).is_zero())
                    })
                });
                assert!(is_border || every.contains(&[bits(q), bits(p)]), "{p:?} {q:?}: {all:?}");
            }
        }
        for corner in region.rings().flatten() {
            assert!(all.iter().flatten().flatten().any(|p| p == corner), "{corner:?} is missing: {all:?}");
        }
        all
    }

    /// A hole with a side or a corner on the border of two cells, from either side, and one that rounding makes touch it.
    #[test]
    fn holes_on_the_border_of_cells_have_corners_in_both() {
        let frame = rectangle([-8.0; 2], [16.0; 2]);
        for sites in [[[-2.0, 2.0], [2.0, 2.0]], [[2.0, 2.0], [-2.0, 2.0]]] {
            for x in [-2.0, 0.0] {
                let found = cells(&sites, &[frame.clone(), rectangle([x, -2.0], [2.0; 2])]);
                assert_eq!(
                    found.iter().flatten().flatten().filter(|p| p[0] == 0.0 && p[1] == -2.0).count(),
                    2
                );
            }
        }
        // Touched in a corner, aslant.
        cells(&[[-1.0, -1.0], [1.0, 1.0]], &[frame.clone(), rectangle([1.0, -1.0], [2.0; 2])]);
        // Beside other holes the region is known by parts, which are divided where one has its side.
        let more = [
            rectangle([-4.0; 2], [2.0; 2]),
            rectangle([-2.0; 2], [2.0; 2]),
            rectangle([1.0, -5.0], [2.0; 2]),
        ];
        cells(&[[2.0, 2.0], [-2.0, 2.0]], &[&[frame.clone()][..], &more].concat());
        // Beside the hole by less than can be told.
        let near = [[-4.3e-78, -4.1e-115], [0.0, 7e-133]];
        cells(&near, &[frame.clone(), rectangle([0.0; 2], [2.0; 2])]);
        cells(&[[-f64::from_bits(1), 1.0], [0.0, 1.0]], &[frame, rectangle([0.0; 2], [2.0; 2])]);
    }

    /// Teeth end so near to the border of cells that what is beyond has no room.
    #[test]
    fn corners_of_the_region_stay() {
        let comb: Ring =
            [[0.0, -1.0], [4.0, -1.0], [4.0, 5.0], [3.0, 0.0], [2.0, 5.0], [1.0, 0.0], [0.0, 5.0]].into();
        cells(&[[1.0, -1.0], [1.0, 1.0 + f64::EPSILON]], std::slice::from_ref(&comb));
        cells(&[[1.0, -1.0], [1.0, 1.0 - f64::EPSILON]], &[comb]);
        // The tip of a region beyond the border of cells.
        cells(&[[3.0, 1.0], [1.0, 3.0 - 4.0 * f64::EPSILON]], &[vec![[0.0, 0.0], [8.0, 0.0], [4.0, 4.0]]]);
    }
}
