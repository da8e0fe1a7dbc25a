//! Imprecise points: preprocess their approximate positions once, triangulate many instances fast.
//!
//! The centers are inserted one by one; for each the nearest one inserted before it is its *hint*. An instance is inserted
//! in the same order, each point located by a straight walk from the instance of its hint. For disjoint unit disks that
//! takes O(1) expected steps a point, whatever the instance.
//!
//! Source: Devillers, "Delaunay triangulation of imprecise points: preprocess and actually get a fast query time",
//! JoCG 2011, §3; the order is random as in the analysis, or spatial as in §5, which is as good and knows the cache.
//!
//! Cost: O(n log n) expected to preprocess; O(n) expected for an instance of disjoint unit disks. Where hints mislead, as
//! for an instance that has nothing to do with the centers (or disks that overlap as in §6.2), walks are given up after
//! O(n) steps, and the instance is built by divide and conquer: O(n log n) at worst. Nothing is allocated for an instance
//! after the first, unless walks were given up.
//!
//! Each walk needs what the one before has made, so hints are for one thread. Where there are more, a large instance is
//! built by divide and conquer, in new memory, which makes the same of it and is as fast as hints on one thread already.

use std::collections::BTreeMap;

use super::Delaunay2;
use super::layer::Layer;
use super::layer::insert::Spot;
use crate::duplicates::Duplicates;
use crate::error::Error;
use crate::ids::{EdgeId, Inserted, MAX_POINTS, Place};
use crate::locate::nearest::Near;
use crate::locate::{Start, Walk};
use crate::mesh::Names;
use crate::order;
use crate::order::HintOrder;
use crate::order::random::SplitMix;
use crate::parallel;
use crate::points::{Position2, check_count, check_finite};
use crate::tally::Tally;

/// Steps a point that walks may take in all, and some more for small sets.
const STEPS: usize = 40;
const SOME: usize = 10_000;

/// Imprecise points, preprocessed for their instances.
///
/// ```
/// use delone::{HintOrder, Hints2};
///
/// let centers = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [4.0, 5.0]];
/// let mut hints = Hints2::from_points(&centers, HintOrder::default())?;
/// let noisy = centers.map(|[x, y]| [x + 0.5, y - 0.25]);
/// let triangulation = hints.triangulate(&noisy)?;
/// assert_eq!(triangulation.triangles().count(), 2);
/// assert!(triangulation.check().is_ok());
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Hints2 {
    /// Point `order[k]` is inserted as the k-th, at place k.
    order: Vec<u32>,
    /// The hint of the k-th: an earlier place.
    hints: Vec<u32>,
    /// The names when all points are distinct.
    names: Names,
    /// The last instance.
    current: Delaunay2,
    gave_up: bool,
}

impl Hints2 {
    /// Finds an order and the hints for points near these centers.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate; [`Error::TooManyPoints`].
    pub fn from_points<P: Position2>(centers: &[P], order: HintOrder) -> Result<Self, Error> {
        check_count(centers.len(), MAX_POINTS)?;
        let points: Vec<[f64; 2]> = centers.iter().map(Position2::xy).collect();
        check_finite(points.iter().copied())?;
        let is_spatial = matches!(order, HintOrder::Spatial { .. });
        let order = match order {
            HintOrder::Spatial { seed } => order::plane::insertion_order(&points, seed),
            HintOrder::Random { seed } => {
                let mut order: Vec<u32> = (0..points.len() as u32).collect();
                SplitMix(seed).shuffle(&mut order);
                order
            }
        };
        let names = Names::along(&order);
        // Neighbors in spatial order are near each other, and the walks from the one before find the nearest.
        let before = (0..points.len() as u32).map(|k| k.saturating_sub(1)).collect();
        let mut all = Self { order, hints: before, names, current: Delaunay2::new(), gave_up: false };
        if is_spatial {
            all.follow(&points)?;
        }
        if !is_spatial || all.gave_up {
            all.hints = all.locate_hints(&points)?;
        }
        (all.current, all.gave_up) = (Delaunay2::new(), false);
        Ok(all)
    }

    /// The hints of centers that are located one by one.
    fn locate_hints(&self, centers: &[[f64; 2]]) -> Result<Vec<u32>, Error> {
        let mut d = Delaunay2::new();
        // For each vertex the place that it stands for: equal centers are one vertex, with the first one's place.
        let mut places: Vec<u32> = Vec::with_capacity(centers.len());
        let hint = |(k, &i): (usize, &u32)| {
            Ok(match d.insert(centers[i as usize])? {
                Inserted::Existing(v) => places[v.index()],
                Inserted::New(v) => {
                    places.push(k as u32);
                    d.nearest_neighbor(v).map_or(0, |w| places[w.index()])
                }
            })
        };
        self.order.iter().enumerate().map(hint).collect()
    }

    /// Triangulates an instance: point i is near center i, or anywhere. By hints on one thread; on several, if the points are many, by
    /// divide and conquer on all of them.
    ///
    /// # Errors
    /// [`Error::Length`] if there are more or fewer points than centers; [`Error::NotFinite`] names the first NaN or
    /// infinite coordinate. The last instance is still there then.
    pub fn triangulate<P: Position2>(&mut self, instance: &[P]) -> Result<&Delaunay2, Error> {
        if parallel::parts(instance.len()) == 1 {
            return self.insert::<_, _, false>(instance, &mut ());
        }
        self.check(instance)?;
        self.gave_up = false;
        let mut positions = self.current.named.take().unwrap_or_default();
        positions.clear();
        positions.extend(instance.iter().map(Position2::xy));
        self.current.rebuild(positions);
        Ok(&self.current)
    }

    /// Triangulates an instance of points that move from one to the next: the nearest neighbors of this one are the hints for the
    /// next.
    ///
    /// # Errors
    /// As [`Self::triangulate`].
    pub fn follow<P: Position2>(&mut self, instance: &[P]) -> Result<&Delaunay2, Error> {
        self.follow_observed(instance, &mut ())
    }

    /// Follows points that move, as [`Self::follow`], and tells each step.
    ///
    /// # Errors
    /// As [`Self::triangulate`].
    pub fn follow_observed<P: Position2, T: Tally>(
        &mut self,
        instance: &[P],
        tally: &mut T,
    ) -> Result<&Delaunay2, Error> {
        self.insert::<_, _, true>(instance, tally)
    }

    /// Whether the walks of the last instance were given up, so that it was built without hints.
    pub fn gave_up(&self) -> bool {
        self.gave_up
    }

    /// Triangulates an instance, and renews the hints if wanted; without hints where walks are given up.
    pub(super) fn insert<P: Position2, T: Tally, const RENEW: bool>(
        &mut self,
        instance: &[P],
        tally: &mut T,
    ) -> Result<&Delaunay2, Error> {
        self.restart(instance)?;
        let Delaunay2 { base, duplicates, .. } = &mut self.current;
        self.gave_up = !insert_all::<_, RENEW>(base, &mut self.hints, duplicates, tally);
        if self.gave_up {
            let positions = self.current.named.take().unwrap_or_default();
            self.current.rebuild(positions);
        }
        Ok(&self.current)
    }

    fn check<P: Position2>(&self, instance: &[P]) -> Result<(), Error> {
        if instance.len() != self.order.len() {
            return Err(Error::Length { expected: self.order.len(), found: instance.len() });
        }
        check_finite(instance.iter().map(Position2::xy))
    }

    /// Puts an instance at its places, none a vertex yet.
    fn restart<P: Position2>(&mut self, instance: &[P]) -> Result<(), Error> {
        self.check(instance)?;
        let d = &mut self.current;
        let named = d.named.get_or_insert_default();
        named.clear();
        named.extend(instance.iter().map(Position2::xy));
        d.base.restart(self.order.iter().map(|&i| named[i as usize]));
        d.base.mesh.names.get_or_insert_default().clone_from(&self.names);
        d.duplicates.clear();
        d.locator.take();
        d.upkeep.renew(self.order.len());
        Ok(())
    }

    /// The last instance; no points before the first.
    pub fn current(&self) -> &Delaunay2 {
        &self.current
    }

    /// The order of insertion.
    pub fn order(&self) -> impl ExactSizeIterator<Item = usize> + '_ {
        self.order.iter().map(|&i| i as usize)
    }

    /// For each point that is inserted, in the order of insertion, the point that is its hint. The first is its own.
    pub fn hints(&self) -> impl ExactSizeIterator<Item = usize> + '_ {
        self.hints.iter().map(|&k| self.order[k as usize] as usize)
    }
}

/// Makes the points at all places vertices, in their order, each located from its hint; and takes the nearest of those
/// before it for a new hint, if wanted. False if walks were given up.
fn insert_all<T: Tally, const RENEW: bool>(
    layer: &mut Layer,
    hints: &mut [u32],
    duplicates: &mut Duplicates,
    tally: &mut T,
) -> bool {
    let mut left = STEPS * hints.len() + SOME;
    // Where the vertex is that stands for a place whose point equals another one.
    let mut stands: BTreeMap<Place, Place> = BTreeMap::new();
    for (k, hint) in hints.iter_mut().enumerate() {
        let (v, near) = (Place::new(k), Place::new(*hint as usize));
        let q = layer.points[k];
        let near = if stands.is_empty() { near } else { stands.get(&near).copied().unwrap_or(near) };
        let start = if layer.spanned {
            Start::Vertex(near)
        } else {
            match layer.mesh.incident[near.index()] {
                EdgeId::NONE => Start::Anywhere,
                e => Start::At(e, Walk::Visibility),
            }
        };
        let (spot, steps) = layer.spot(start, q, tally);
        if steps > left {
            return false;
        }
        left -= steps;
        match spot {
            Spot::Vertex(w) => {
                stands.insert(v, w);
                let names = layer.mesh.names();
                let name = names.of(v);
                duplicates.push(names.coincide(name, w));
                if RENEW {
                    *hint = w.index() as u32;
                }
                layer.free.give(k);
            }
            spot => {
                layer.insert_at(v, spot, tally);
                if RENEW {
                    let joined = layer.mesh.spokes(v).map(|e| layer.mesh.head(e)).filter(|w| !w.is_ghost());
                    let nearest = joined.reduce(|a, b| if layer.nearer(q, b, a).is_lt() { b } else { a });
                    *hint = nearest.map_or(*hint, |w| w.index() as u32);
                }
            }
        }
    }
    duplicates.settle();
    true
}
