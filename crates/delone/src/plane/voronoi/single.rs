//! One cell, with the corners that it has among all.
//!
//! Where rounding turned a ring over, corners move that cells share (`contract.rs`): along sides of some units in the last place, so no
//! further than a chain of these leads. If no ring at the end of such a chain is bad, the cell is as it was cut.
//!
//! Cost: O(d^2) for a vertex with d neighbors that have as many; of all cells where one of those rings is bad.

use super::Voronoi2;
use super::build::Builder;
use super::clip::cut_out;
use super::contract::longest_side;
use crate::ids::{Place, VertexId};
use crate::plane::region::Region2;

type Point = [f64; 2];

impl Voronoi2<'_> {
    /// The cell of one vertex, clipped to a region, as rings: with the corners that [`Self::clip`] gives it. Empty for an id that is
    /// no vertex.
    ///
    /// O(d^2) for a vertex with d neighbors that have as many. All cells are clipped where rounding has turned a ring near by over,
    /// because then corners are moved that cells share.
    ///
    /// ```
    /// use delone::{Delaunay2, Region2, VertexId};
    ///
    /// let d = Delaunay2::from_points(&[[1, 1], [3, 1]])?;
    /// let rings = d.voronoi().cell(VertexId::new(1), &Region2::rectangle([0, 0], [4, 3])?);
    /// assert_eq!((rings.len(), rings[0].len()), (1, 4));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("voronoi_face", "region"))]
    pub fn cell(self, site: VertexId, region: &Region2) -> Vec<Vec<[f64; 2]>> {
        let Some(place) = self.triangulation.mesh().place(site) else { return Vec::new() };
        let base = &self.triangulation.base;
        let cut = |place: Place| {
            let mut builder = Builder::new(region, 1, 1, Vec::new());
            builder.push_rings(&cut_out(base, region, place));
            builder
        };
        let near = |place: Place| {
            let heads = base.mesh.spokes(place).map(|e| base.mesh.head(e));
            heads.filter(|w| !w.is_ghost()).collect::<Vec<_>>()
        };
        let own = cut(place);
        if has_only_good(place, own.cells().vertices(), cut, near) {
            own.cells().all().rings().map(|ring| ring.points().collect()).collect()
        } else {
            self.clip(region).cell(site).rings().map(|ring| ring.points().collect()).collect()
        }
    }
}

/// Whether the rings of a cell are good, those of its neighbors and of theirs, and of all around corners which short sides lead to.
fn has_only_good<'a>(
    place: Place,
    corners: &[Point],
    cut: impl Fn(Place) -> Builder<'a>,
    near: impl Fn(Place) -> Vec<Place>,
) -> bool {
    let first = near(place);
    let mut cells: Vec<Place> =
        first.iter().flat_map(|&w| near(w)).chain(first.iter().copied()).chain([place]).collect();
    cells.sort_unstable();
    cells.dedup();
    // Distinct places, of which there are few: they are apart by units in the last place.
    let mut reached = corners.to_vec();
    let mut waiting: Vec<(Place, Vec<Point>)> = Vec::new();
    let mut seen = cells.clone();
    while !cells.is_empty() {
        for w in cells.drain(..) {
            let builder = cut(w);
            if !builder.is_good() {
                return false;
            }
            waiting.push((w, builder.cells().vertices().to_vec()));
        }
        let mut count = 0;
        while count < reached.len() {
            count = reached.len();
            waiting.retain(|(w, corners)| {
                // Twice, for the chain may be of a cell with larger corners.
                let longest = 2.0 * longest_side(corners);
                let is_near = |p: &Point| {
                    reached.iter().any(|q| (p[0] - q[0]).abs() <= longest && (p[1] - q[1]).abs() <= longest)
                };
                let new: Vec<Point> = corners.iter().copied().filter(is_near).collect();
                if new.is_empty() {
                    return true;
                }
                new.into_iter().for_each(|p| {
                    if !reached.contains(&p) {
                        reached.push(p);
                    }
                });
                for around in near(*w) {
                    if let Err(i) = seen.binary_search(&around) {
                        seen.insert(i, around);
                        cells.push(around);
                    }
                }
                // Its other corners may be reached later, by way of others that have them.
                false
            });
        }
    }
    true
}
