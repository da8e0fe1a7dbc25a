//! Which triangle of a folder a place is in.
//!
//! A final triangle of a tile is in its region, so a place is in a triangle of its own tile or of a seam. Both are found in the
//! triangulation of their corners, which has all of them, because what is empty of all points is empty of some.
//!
//! Cost: a tile at a time is read and triangulated, and all seams if a place is in none of its tile.

use std::collections::BTreeMap;

use delone::tiles::Node;
use delone::{Delaunay2, Location2, TriangleId, Triangulation as _};

use crate::error::Error;
use crate::places::place;
use crate::shards;
use crate::store::Store;
use crate::watch::{Phase, Watch};

/// Triangles of some points, by the names of their corners.
struct Known {
    d: Delaunay2,
    /// The name of each point.
    names: Vec<u64>,
    /// The sorted corners of each triangle that counts, ascending.
    triangles: Vec<[u64; 3]>,
}

impl Store {
    /// The corners of the triangle that each place is in, counter-clockwise, by their names: the number of the tile times 2^32, and the
    /// index there. Nothing outside of the hull. On a common border a triangle of the tile comes before one of a seam, and of several the
    /// one with the least names.
    ///
    /// # Errors
    /// [`Error::Points`] for a place that is not finite; [`Error::Changed`] if a file is not there or wrong; [`Error::Stopped`].
    ///
    /// ```no_run
    /// use delone_store::Store;
    ///
    /// let found = Store::open("tiles")?.locate(&[[637_010.5, 851_020.0]], &())?;
    /// if let Some([a, ..]) = found[0] {
    ///     println!("its first corner is point {} of tile {}", a & 0xffff_ffff, a >> 32);
    /// }
    /// # Ok::<(), delone_store::Error>(())
    /// ```
    pub fn locate(&self, places: &[[f64; 2]], watch: &dyn Watch) -> Result<Vec<Option<[u64; 3]>>, Error> {
        let mut of_tiles: BTreeMap<Node, Vec<usize>> = BTreeMap::new();
        for (index, p) in places.iter().enumerate() {
            if let Some(axis) = p.iter().position(|x| !x.is_finite()) {
                let error = delone::Error::NotFinite { index, axis, value: p[axis] };
                return Err(Error::points(&self.folder, error));
            }
            of_tiles.entry(self.plan.cuts.tile_of(*p)).or_default().push(index);
        }
        let mut found = vec![None; places.len()];
        let mut open = Vec::new();
        let phase = Phase::count(watch, "locating", of_tiles.len() as u64);
        for (tile, indices) in of_tiles {
            let known = self.known_of_tile(tile)?;
            for index in indices {
                found[index] =
                    known.find(places[index]).map_err(|error| Error::points(&self.folder, error))?;
                open.extend(found[index].is_none().then_some(index));
            }
            phase.advance()?;
        }
        if !open.is_empty() {
            let known = self.known_of_seams()?;
            for index in open {
                found[index] =
                    known.find(places[index]).map_err(|error| Error::points(&self.folder, error))?;
            }
        }
        Ok(found)
    }

    fn known_of_tile(&self, tile: Node) -> Result<Known, Error> {
        let points: Vec<[f64; 2]> = self.points(tile)?.into_iter().map(|corner| corner.0).collect();
        let triangles = self.triangles(tile)?.into_iter().map(|t| t.map(|v| tile.id(v as u32)));
        let names = (0..points.len()).map(|v| tile.id(v as u32)).collect();
        self.known(&points, names, triangles.collect())
    }

    fn known_of_seams(&self) -> Result<Known, Error> {
        let mut triangles = Vec::new();
        for node in self.nodes().map(|done| done.node).filter(|&node| !self.plan.cuts.is_tile(node)) {
            triangles.extend(shards::triangles(&place(&self.folder, "seam", node, "npy"))?);
        }
        let of_tile = |node| Ok(self.points(node)?.into_iter().map(|corner| corner.0).collect());
        let corners = shards::corners(&self.folder, &self.plan.cuts, &triangles, of_tile)?;
        let points: Vec<[f64; 2]> = corners.values().copied().collect();
        self.known(&points, corners.into_keys().collect(), triangles)
    }

    fn known(
        &self,
        points: &[[f64; 2]],
        names: Vec<u64>,
        mut triangles: Vec<[u64; 3]>,
    ) -> Result<Known, Error> {
        let d = Delaunay2::from_points(points).map_err(|error| Error::points(&self.folder, error))?;
        triangles.iter_mut().for_each(|t| t.sort_unstable());
        triangles.sort_unstable();
        Ok(Known { d, names, triangles })
    }
}

impl Known {
    /// The triangle that counts and that a place is in or on.
    fn find(&self, p: [f64; 2]) -> Result<Option<[u64; 3]>, delone::Error> {
        let mesh = self.d.mesh();
        let around: Vec<TriangleId> = match self.d.locate(p)? {
            Location2::Triangle(t) => vec![t],
            Location2::Edge(e) => vec![e.triangle(), mesh.twin(e).triangle()],
            Location2::Vertex(v) => mesh.star(v).map(|e| e.triangle()).collect(),
            _ => Vec::new(),
        };
        let corners = |t: TriangleId| self.d.corners(t).map(|v| self.names[v.index()]);
        let sorted = |t: TriangleId| {
            let mut names = corners(t);
            names.sort_unstable();
            names
        };
        let counts = |t: &TriangleId| self.triangles.binary_search(&sorted(*t)).is_ok();
        let finite = around.into_iter().filter(|&t| !mesh.is_ghost(t));
        Ok(finite.filter(counts).min_by_key(|&t| sorted(t)).map(corners))
    }
}
