//! All cells of a diagram, clipped to a region.
//!
//! Most cells lie inside of the region, and their corners are centers of spheres, each computed once. They are read off (`read.rs`). The
//! others are cut out of the region by the half-spaces of all neighbors, corner by corner (`region/solid.rs`): that needs no rays and no
//! corners far away. A corner of four sites is the center of their tetrahedron there too, so cells that are cut share their corners with those
//! that are not.
//!
//! Cost: O(n) for the cells inside, O(d k) for a cell with d neighbors, walls counted, and k corners. On all threads: each makes the
//! cells of some places, and what it makes does not depend on who else works.

use super::Voronoi3;
use super::build::{Part, joined};
use super::cells::{Across3, Cell3, Cells3};
use super::centers::{Cellular, Centers};
use super::read::Reader;
use crate::ids::{Place, TetrahedronId, VertexId};
use crate::parallel;
use crate::space::layer::Layer;
use crate::space::region::Region3;
use crate::space::region::solid::Solid;

impl Voronoi3<'_> {
    /// Clips all cells to a region. Sites may be outside of it. The clipped cells tile the region. On all threads of rayon's pool
    /// where that pays; the result is the same to the bit.
    #[doc(alias("compute_voronoi", "container"))]
    pub fn clip(self, region: &Region3) -> Cells3 {
        let triangulation = self.triangulation();
        of(&triangulation.base, triangulation.base.mesh.names.given(), region)
    }

    /// The cells of all vertices that are not on the hull, as they are: others have no faces, and neither have cells with a corner that is too
    /// far away for `f64`. On all threads, as [`Self::clip`].
    ///
    /// ```
    /// use delone::{Delaunay3, VertexId};
    ///
    /// let grid: Vec<_> = (0..27).map(|i| [i % 3, i / 3 % 3, i / 9]).collect();
    /// let cells = Delaunay3::from_points(&grid)?.voronoi().bounded();
    /// assert_eq!(cells.volume(VertexId::new(13)), 1.0);
    /// assert_eq!(cells.faces(VertexId::new(0)).len(), 0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn bounded(self) -> Cells3 {
        self.cells_of(None, |_| true)
    }

    /// The cells of some of the vertices, clipped; without a region those that are bounded.
    pub(crate) fn cells_of(
        self,
        region: Option<&Region3>,
        is_wanted: impl Fn(VertexId) -> bool + Send + Sync,
    ) -> Cells3 {
        let layer = &self.triangulation().base;
        of_wanted(layer, layer.mesh.names.given(), region, is_wanted)
    }

    /// Clips all cells to a region, and hands out one after the other. They come in the order of space, not of the ids, and nothing is
    /// kept of them: beside the centers of the tetrahedra this takes no memory.
    ///
    /// ```
    /// use delone::{Delaunay3, Region3};
    ///
    /// let d = Delaunay3::from_points(&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]])?;
    /// let mut volume = 0.0;
    /// let region = Region3::cuboid([0.0, 0.0, 0.0], [4.0, 2.0, 1.0])?;
    /// d.voronoi().clip_each(&region, |_, cell| volume += cell.volume());
    /// assert_eq!(volume, 8.0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn clip_each(self, region: &Region3, each: impl FnMut(VertexId, Cell3<'_>)) {
        self::each(&self.triangulation().base, region, each);
    }
}

/// The cells of all vertices of a layer, clipped; `ids` were given.
pub(in crate::space) fn of<W: Cellular>(layer: &Layer<W>, ids: usize, region: &Region3) -> Cells3 {
    let centers = Centers::of(layer, |_| true, |p| region.surely_holds(p));
    all(layer, ids, centers, Some(region), |_| true)
}

/// The cells of all vertices of a layer, clipped, one after the other.
pub(in crate::space) fn each<W: Cellular>(
    layer: &Layer<W>,
    region: &Region3,
    mut each: impl FnMut(VertexId, Cell3<'_>),
) {
    let centers = Centers::of(layer, |_| true, |p| region.surely_holds(p));
    let mut part = Part::new(centers.points.len(), 1);
    Worker::new(layer, &centers, Some(region)).run(in_order(layer), &mut part, |part, site| {
        each(site, part.last(&centers.points));
        part.forget();
    });
}

/// The cells of wanted vertices, clipped; without a region the whole ones that are bounded. Those of others have no faces.
pub(in crate::space) fn of_wanted<W: Cellular>(
    layer: &Layer<W>,
    ids: usize,
    region: Option<&Region3>,
    is_wanted: impl Fn(VertexId) -> bool + Send + Sync,
) -> Cells3 {
    let is_wanted = |p: Place| is_wanted(layer.mesh.name(p));
    let is_inside = |p: [f64; 3]| region.is_none_or(|region| region.surely_holds(p));
    let centers = Centers::of(layer, |corners| corners.into_iter().any(is_wanted), is_inside);
    all(layer, ids, centers, region, is_wanted)
}

/// The cells of wanted places.
fn all<W: Cellular>(
    layer: &Layer<W>,
    ids: usize,
    centers: Centers,
    region: Option<&Region3>,
    is_wanted: impl Fn(Place) -> bool + Send + Sync,
) -> Cells3 {
    let places: Vec<Place> = in_order(layer).filter(|&p| is_wanted(p)).collect();
    let parts = parallel::map(parallel::ranges(places.len()), |range| {
        let mut part = Part::new(centers.points.len(), range.len());
        Worker::new(layer, &centers, region).run(places[range].iter().copied(), &mut part, |_, _| {});
        part
    });
    joined(centers, ids, parts)
}

/// The places of all vertices. After construction they follow a curve: neighbors in space are neighbors in memory.
fn in_order<W: Cellular>(layer: &Layer<W>) -> impl Iterator<Item = Place> {
    layer.mesh.inhabited().filter(|&p| !layer.is_scaffold(p))
}

/// The code of a wall.
fn wall(number: u32) -> u32 {
    Across3::Wall(number as usize).code()
}

/// A maker of cells, one after the other.
struct Worker<'a, W: Cellular> {
    layer: &'a Layer<W>,
    centers: &'a Centers,
    region: Option<&'a Region3>,
    reader: Reader<'a>,
    solid: Solid,
    star: Vec<TetrahedronId>,
    /// The tetrahedra at a site by the names of their other corners, sorted.
    by_corners: Vec<([u32; 3], TetrahedronId)>,
}

impl<'a, W: Cellular> Worker<'a, W> {
    fn new(layer: &'a Layer<W>, centers: &'a Centers, region: Option<&'a Region3>) -> Self {
        Self {
            layer,
            centers,
            region,
            reader: Reader::new(&layer.mesh, centers),
            solid: Solid::default(),
            star: Vec::new(),
            by_corners: Vec::new(),
        }
    }

    /// Makes the cells of some places.
    fn run(
        &mut self,
        places: impl Iterator<Item = Place>,
        part: &mut Part,
        mut each: impl FnMut(&mut Part, VertexId),
    ) {
        for place in places {
            let site = self.layer.mesh.name(place);
            part.begin(site);
            let is_whole = self.reader.push(place, &mut part.faces);
            if let Some(region) = self.region.filter(|_| !is_whole) {
                self.cut(place, region, part);
            }
            part.end(&self.centers.points);
            each(part, site);
        }
    }

    /// Adds a cell cut out of the region.
    fn cut(&mut self, place: Place, region: &Region3, part: &mut Part) {
        let others = self.layer.joined_to(place, &mut self.star);
        // Points of less than space have no centers.
        let has_center =
            |t: &TetrahedronId| self.centers.points.get(t.index()).is_some_and(|p| p[0].is_finite());
        if self.star.iter().all(has_center) {
            self.cut_by_walls(place, &others, region);
        } else {
            self.cut_by_all(place, others, region);
        }
        for (side, number) in &region.slanted {
            self.solid.cut(*side, wall(*number));
        }
        if self.solid.is_empty() {
            return;
        }
        let Self { layer, solid, star, by_corners, .. } = self;
        by_corners.clear();
        if layer.scaffold.is_empty() {
            by_corners.extend(star.iter().filter(|&&t| !layer.mesh.is_ghost(t)).map(|&t| {
                let corners = layer.mesh.cells[t.index()].corners;
                let mut others =
                    corners.into_iter().filter(|&p| p != place).map(|p| layer.mesh.name(p).bits());
                let mut key = [(); 3].map(|()| others.next().unwrap_or_default());
                key.sort_unstable();
                (key, t)
            }));
            by_corners.sort_unstable();
        }
        let tetrahedron = |beyond: [Option<u32>; 3]| {
            let mut key = [beyond[0]?, beyond[1]?, beyond[2]?];
            key.sort_unstable();
            let found = by_corners.binary_search_by_key(&key, |entry| entry.0).ok()?;
            Some(by_corners[found].1)
        };
        part.push_cut(solid, self.centers, tetrahedron);
    }

    /// Begins with the whole cell, which has a corner for each tetrahedron, and cuts it by the sides of the box around the region.
    fn cut_by_walls(&mut self, place: Place, others: &[Place], region: &Region3) {
        let Self { layer, centers, solid, star, .. } = self;
        let site = layer.site(place);
        solid.restart(site.0);
        for &other in others {
            let beyond = Across3::Site(layer.mesh.name(other)).code();
            solid.push_plane(W::half_space(site, layer.site(other)), Some(beyond));
        }
        for t in star.iter() {
            let mut planes = [0; 3];
            let corners = layer.mesh.cells[t.index()].corners.into_iter().filter(|&p| p != place);
            for (plane, other) in planes.iter_mut().zip(corners) {
                *plane = others.binary_search(&other).unwrap_or_default();
            }
            solid.push_corner(planes);
        }
        for (side, number) in region.frame {
            let Some(number) = number else { continue };
            if !star.iter().all(|t| side.surely_holds(centers.points[t.index()])) {
                solid.cut(side, wall(number));
            }
        }
    }

    /// Begins with the box around the region, and cuts it by the half-spaces of all neighbors: for cells that are not bounded.
    fn cut_by_all(&mut self, place: Place, mut others: Vec<Place>, region: &Region3) {
        let Self { layer, solid, .. } = self;
        let site = layer.site(place);
        solid.restart_with_box(site.0, region.frame.iter().map(|(side, number)| (*side, number.map(wall))));
        // The nearest first: then few corners are made that others cut off.
        others.sort_by_cached_key(|p| {
            let square: f64 = (0..3).map(|k| (layer.points[p.index()][k] - site.0[k]).powi(2)).sum();
            square.to_bits()
        });
        for other in others {
            let half_space = W::half_space(site, layer.site(other));
            solid.cut(half_space, Across3::Site(layer.mesh.name(other)).code());
            if solid.is_empty() {
                return;
            }
        }
    }
}
