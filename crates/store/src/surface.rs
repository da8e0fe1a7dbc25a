//! A folder of tiles as a surface: its triangles with heights, as far as they meet some rows of a raster.
//!
//! Memory: one tile at a time, and the triangles of all seams.

use delone::tiles::Node;
use delone::{Bounds, Hull2};

use crate::error::Error;
use crate::places::place;
use crate::shards;
use crate::store::{Corner, Store};
use crate::watch::{Phase, Watch};

/// The triangles of a folder with their heights.
#[derive(Debug)]
pub struct Surface {
    store: Store,
    /// Each tile that has points, with the box around them and their number.
    tiles: Vec<(Node, Bounds<2>, usize)>,
    seams: Vec<[Corner; 3]>,
    bounds: Bounds<2>,
    hull: Vec<Corner>,
}

impl Store {
    /// Reads where tiles are and all seams, for [`Surface::each`].
    ///
    /// # Errors
    /// [`Error::Changed`] if a file is not there or wrong; [`Error::Stopped`].
    pub fn surface(self, watch: &dyn Watch) -> Result<Surface, Error> {
        let (tiles, seams): (Vec<Node>, Vec<Node>) =
            self.nodes().map(|done| done.node).partition(|&node| self.plan.cuts.is_tile(node));
        let mut held = Surface {
            store: self,
            tiles: Vec::new(),
            seams: Vec::new(),
            bounds: Bounds::default(),
            hull: Vec::new(),
        };
        let phase = Phase::count(watch, "reading tiles", tiles.len() as u64);
        for node in tiles {
            let points = held.store.points(node)?;
            let bounds = Bounds::of(points.iter().map(|corner| corner.0));
            let hull = Hull2::from_points(&points.iter().map(|corner| corner.0).collect::<Vec<_>>());
            let hull = hull.map_err(|error| Error::points(&held.store.folder, error))?;
            held.hull.extend(hull.corners().iter().map(|&v| points[v]));
            if !points.is_empty() {
                held.bounds.include(bounds.low);
                held.bounds.include(bounds.high);
                held.tiles.push((node, bounds, points.len()));
            }
            phase.advance()?;
        }
        let of_all = Hull2::from_points(&held.hull.iter().map(|corner| corner.0).collect::<Vec<_>>());
        let of_all = of_all.map_err(|error| Error::points(&held.store.folder, error))?;
        held.hull = of_all.corners().iter().map(|&v| held.hull[v]).collect();
        let mut names = Vec::new();
        for node in seams {
            names.extend(shards::triangles(&place(&held.store.folder, "seam", node, "npy"))?);
        }
        let known = shards::corners(&held.store.folder, &held.store.plan.cuts, &names, |node| {
            held.store.points(node)
        })?;
        held.seams = names.into_iter().map(|t| t.map(|name| known[&name])).collect();
        Ok(held)
    }
}

impl Surface {
    /// The folder.
    pub fn store(&self) -> &Store {
        &self.store
    }

    /// The box around all points.
    pub fn bounds(&self) -> &Bounds<2> {
        &self.bounds
    }

    /// The corners of the convex hull.
    pub fn hull(&self) -> &[Corner] {
        &self.hull
    }

    /// About how many points there are between two heights along y, if they are evenly spread in each tile.
    pub fn count_between(&self, [low, high]: [f64; 2]) -> f64 {
        let part = |&(_, bounds, count): &(Node, Bounds<2>, usize)| {
            let size = bounds.high[1] - bounds.low[1];
            let shared = bounds.high[1].min(high) - bounds.low[1].max(low);
            let share = if size > 0.0 { shared / size } else { 1.0 };
            if shared < 0.0 { 0.0 } else { count as f64 * share }
        };
        self.tiles.iter().map(part).sum()
    }

    /// All triangles whose box meets some range along y.
    ///
    /// # Errors
    /// [`Error::Changed`] if a file is not there or wrong.
    pub fn each(&self, range: [f64; 2], mut take: impl FnMut([Corner; 3])) -> Result<(), Error> {
        let meets = |t: &[Corner; 3]| {
            t.iter().any(|corner| corner.0[1] <= range[1]) && t.iter().any(|corner| corner.0[1] >= range[0])
        };
        for &(node, bounds, _) in &self.tiles {
            if bounds.low[1] > range[1] || bounds.high[1] < range[0] {
                continue;
            }
            let points = self.store.points(node)?;
            let path = place(&self.store.folder, "triangles", node, "npy");
            for t in shards::triangles(&path)? {
                let [a, b, c] = t.map(|v| points.get(v as usize).copied());
                let (Some(a), Some(b), Some(c)) = (a, b, c) else {
                    return Err(Error::changed(&path, "a triangle has a corner that is no point"));
                };
                if meets(&[a, b, c]) {
                    take([a, b, c]);
                }
            }
        }
        self.seams.iter().filter(|t| meets(t)).for_each(|t| take(*t));
        Ok(())
    }
}
