//! Imprecise points in space: preprocess their approximate positions once, triangulate many instances fast.
//!
//! As in the plane (`plane/imprecise.rs`): each center's hint is the nearest one inserted before it, and each point of an
//! instance is located by a walk from the instance of its hint.
//!
//! Source: Devillers, "Delaunay triangulation of imprecise points: preprocess and actually get a fast query time",
//! JoCG 2011, §3 and the experiments in space of §5.
//!
//! Cost: O(n log n) expected to preprocess evenly spread points; O(n) expected for an instance of disjoint unit balls. Where
//! hints mislead, walks are given up after O(n) steps, and the instance is built in spatial order. Nothing but a few words
//! is allocated for an instance after the first, unless walks were given up.

use super::Delaunay3;
use super::layer::Layer;
use crate::error::Error;
use crate::ids::{Inserted, Place, TetrahedronId};
use crate::locate::nearest::Near;
use crate::mesh::Names;
use crate::order::random::SplitMix;
use crate::order::{self, HintOrder};
use crate::points::{Position3, check_in_space};
use crate::tally::Tally;

/// Steps a point that walks may take in all, and some more for small sets.
const STEPS: usize = 40;
const SOME: usize = 10_000;

/// Counts visits for itself, and all for another.
struct Steps<'a, T> {
    visited: usize,
    tally: &'a mut T,
}

impl<T: Tally> Tally for Steps<'_, T> {
    fn visited(&mut self) {
        self.visited += 1;
        self.tally.visited();
    }

    fn orientation(&mut self) {
        self.tally.orientation();
    }
}

/// Imprecise points in space, preprocessed for their instances.
///
/// ```
/// use delone::{HintOrder, Hints3};
///
/// let centers = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
/// let mut hints = Hints3::from_points(&centers, HintOrder::default())?;
/// let noisy = centers.map(|p| p.map(|x| x + 0.25));
/// assert_eq!(hints.triangulate(&noisy)?.tetrahedra().count(), 1);
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Hints3 {
    /// Point `along[k]` is kept at place k.
    along: Vec<u32>,
    /// The places in the order of insertion.
    order: Vec<u32>,
    /// For each of them the place of its hint.
    hints: Vec<u32>,
    /// The names when all points are distinct.
    names: Names,
    /// The last instance.
    pub(super) current: Delaunay3,
    gave_up: bool,
}

impl Hints3 {
    /// Finds an order and the hints for points near these centers.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate; [`Error::TooManyPoints`].
    pub fn from_points<P: Position3>(centers: &[P], order: HintOrder) -> Result<Self, Error> {
        check_in_space(centers)?;
        let count = centers.len();
        let is_spatial = matches!(order, HintOrder::Spatial { .. });
        let (along, order) = match order {
            HintOrder::Spatial { seed } => (
                order::space::hilbert(count, &|i| centers[i as usize].xyz()),
                order::space::rounds(count, seed),
            ),
            HintOrder::Random { seed } => {
                let mut along: Vec<u32> = (0..count as u32).collect();
                SplitMix(seed).shuffle(&mut along);
                (along, (0..count as u32).collect())
            }
        };
        let names = Names::along(&along);
        // Neighbors in spatial order are near each other, and the walks from the one before find the nearest.
        let before = std::iter::once(&0).chain(&order).take(count).copied().collect();
        let mut all = Self { along, order, hints: before, names, current: Delaunay3::new(), gave_up: false };
        if is_spatial {
            all.follow(centers)?;
        }
        if !is_spatial || all.gave_up {
            all.hints = all.locate_hints(centers)?;
        }
        (all.current, all.gave_up) = (Delaunay3::new(), false);
        Ok(all)
    }

    /// The hints of centers that are located one by one.
    fn locate_hints<P: Position3>(&self, centers: &[P]) -> Result<Vec<u32>, Error> {
        let mut d = Delaunay3::new();
        // For each vertex the place that it stands for: equal centers are one vertex, with the first one's place.
        let mut places: Vec<u32> = Vec::with_capacity(centers.len());
        let hint = |&place: &u32| {
            let q = centers[self.along[place as usize] as usize].xyz();
            Ok(match d.insert(q)? {
                Inserted::Existing(v) => places[v.index()],
                Inserted::New(v) => {
                    places.push(place);
                    d.nearest_neighbor(v).map_or(place, |w| places[w.index()])
                }
            })
        };
        self.order.iter().map(hint).collect()
    }

    /// Triangulates an instance: point i is near center i, or anywhere.
    ///
    /// # Errors
    /// [`Error::Length`] if there are more or fewer points than centers; [`Error::NotFinite`] names the first NaN or
    /// infinite coordinate. The last instance is still there then. [`Error::TooManyTetrahedra`] leaves none.
    pub fn triangulate<P: Position3>(&mut self, instance: &[P]) -> Result<&Delaunay3, Error> {
        self.insert(instance, &mut ())
    }

    /// Triangulates an instance, and tells each step.
    pub(super) fn insert<P: Position3, T: Tally>(
        &mut self,
        instance: &[P],
        tally: &mut T,
    ) -> Result<&Delaunay3, Error> {
        self.restart(instance)?;
        let arrived = self.insert_all::<T, false>(tally);
        self.settle(arrived, instance)
    }

    /// Triangulates an instance of points that move from one to the next: the nearest neighbors of this one are the hints
    /// for the next.
    ///
    /// # Errors
    /// As [`Self::triangulate`].
    pub fn follow<P: Position3>(&mut self, instance: &[P]) -> Result<&Delaunay3, Error> {
        self.follow_observed(instance, &mut ())
    }

    /// Follows points that move, as [`Self::follow`], and tells each step.
    ///
    /// # Errors
    /// As [`Self::triangulate`].
    pub fn follow_observed<P: Position3, T: Tally>(
        &mut self,
        instance: &[P],
        tally: &mut T,
    ) -> Result<&Delaunay3, Error> {
        self.restart(instance)?;
        let arrived = self.insert_all::<T, true>(tally);
        self.settle(arrived, instance)
    }

    /// The last instance; no points before the first.
    pub fn current(&self) -> &Delaunay3 {
        &self.current
    }

    /// Whether the walks of the last instance were given up, so that it was built without hints.
    pub fn gave_up(&self) -> bool {
        self.gave_up
    }

    /// The order of insertion.
    pub fn order(&self) -> impl ExactSizeIterator<Item = usize> + '_ {
        self.order.iter().map(|&place| self.along[place as usize] as usize)
    }

    /// For each point that is inserted, in the order of insertion, the point that is its hint. The first is its own.
    pub fn hints(&self) -> impl ExactSizeIterator<Item = usize> + '_ {
        self.hints.iter().map(|&place| self.along[place as usize] as usize)
    }

    /// Builds without hints what did not arrive by them.
    fn settle<P: Position3>(&mut self, arrived: bool, instance: &[P]) -> Result<&Delaunay3, Error> {
        self.gave_up = !arrived;
        if !arrived {
            self.current = Delaunay3::new();
            self.current = Delaunay3::from_points(instance)?;
        }
        Ok(&self.current)
    }

    /// Puts an instance at its places, none a vertex yet.
    fn restart<P: Position3>(&mut self, instance: &[P]) -> Result<(), Error> {
        if instance.len() != self.along.len() {
            return Err(Error::Length { expected: self.along.len(), found: instance.len() });
        }
        check_in_space(instance)?;
        let d = &mut self.current;
        d.base.restart(self.along.iter().map(|&i| (instance[i as usize].xyz(), ())));
        d.base.mesh.names.clone_from(&self.names);
        d.duplicates.clear();
        d.locator.take();
        d.hinted = instance.len();
        Ok(())
    }

    /// Makes all points vertices, each located from its hint; and takes the nearest of those before it for a new hint,
    /// if wanted. False if walks were given up.
    fn insert_all<T: Tally, const RENEW: bool>(&mut self, tally: &mut T) -> bool {
        let most = STEPS * self.order.len() + SOME;
        let mut steps = Steps { visited: 0, tally };
        let Delaunay3 { base: layer, duplicates, .. } = &mut self.current;
        let Some(first) = layer.begin(&self.order) else { return false };
        let Some(&a) = first.first() else { return true };
        let mut last = layer.mesh.incident[a.index()];
        for (&place, hint) in self.order.iter().zip(&mut self.hints) {
            let v = Place::new(place as usize);
            if first.contains(&v) {
                continue;
            }
            let q = layer.points[v.index()];
            // The hint may be no vertex: because it equals another, or has not been inserted where the first ones
            // do not span space.
            let near = layer.mesh.incident[*hint as usize];
            let from = if near == TetrahedronId::NONE { last } else { near };
            last = layer.walk(from, q, &mut steps);
            if steps.visited > most {
                return false;
            }
            if let Some(w) = layer.vertex_at(last, q) {
                let name = layer.mesh.names.of(v);
                duplicates.push(layer.mesh.names.coincide(name, w));
                if RENEW {
                    *hint = w.index() as u32;
                }
                continue;
            }
            if layer.insert(v, last, steps.tally).is_none() {
                return false;
            }
            last = layer.mesh.incident[v.index()];
            if RENEW {
                *hint = nearest(layer, v).map_or(*hint, |w| w.index() as u32);
            }
        }
        duplicates.settle();
        true
    }
}

/// The nearest neighbor of a vertex that was inserted last.
fn nearest(layer: &Layer, v: Place) -> Option<Place> {
    let q = layer.points[v.index()];
    let joined = layer.cavity.joined().filter(|&p| !layer.is_scaffold(p));
    joined.reduce(|a, b| if layer.nearer(q, b, a).is_lt() { b } else { a })
}
