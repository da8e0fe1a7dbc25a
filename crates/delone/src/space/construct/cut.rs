//! Where to cut a set of sites of space into parts that are triangulated apart.
//!
//! Near a cut points are triangulated twice, once in their part and once with those of the other side. How many, samples
//! foretell: of points that fill space they are few, and the fewer the more there are; of points on a surface, whose
//! tetrahedra reach far, they may be all. Sites that others hide cost little and are not counted. What is decided depends on
//! the sites alone.
//!
//! Cost: O(n log n).

use super::super::layer::kernel::{Lift, Region};
use super::part::Part;
use crate::ids::{Place, TetrahedronId};
use crate::mesh::tetrahedra::Tetrahedron;
use crate::order;
use crate::order::random::SplitMix;
use crate::parallel;
use crate::points::Bounds;
use crate::points::Position3;
use crate::sorting;

/// Sites, from which on the set is cut into parts for threads; cutting fewer costs more than it gains.
const CUT_SITES: usize = 1 << 14;
/// The sizes of the thin samples.
const THIN: [usize; 2] = [512, 4096];
/// The number of dense samples.
const DENSE: usize = 3;
/// Where a larger share of a dense sample is at the border, the border may be wider than the sample can show.
const WIDE: f64 = 0.7;
/// The share of points that may be triangulated twice for two parts, and for more.
const TWICE_FOR_TWO: f64 = 0.1;
const TWICE: f64 = 0.05;
/// The largest number of cuts, one after another: more would make more parts than there are threads.
const MAX_CUTS: u32 = 8;

/// Points, and a weight for each if there are weights.
pub(super) struct Sites<'a, P, W> {
    pub(super) points: &'a [P],
    pub(super) weights: &'a [W],
}

impl<P, W> Clone for Sites<'_, P, W> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P, W> Copy for Sites<'_, P, W> {}

impl<P: Position3, W: Lift> Sites<'_, P, W> {
    fn len(&self) -> usize {
        self.points.len()
    }

    fn point(&self, i: u32) -> [f64; 3] {
        self.points[i as usize].xyz()
    }

    fn weight(&self, i: u32) -> W {
        W::at(self.weights, Place::new(i as usize))
    }

    fn region(&self, indices: &[u32]) -> Region<W> {
        Region {
            bounds: Bounds::of(indices.iter().map(|&i| self.point(i))),
            most: W::most(indices.iter().map(|&i| self.weight(i))),
        }
    }
}

/// Sites to be triangulated apart.
pub(super) struct Run<W> {
    /// Their indices, along a Hilbert curve.
    pub(super) order: Vec<u32>,
    /// Regions of all others.
    pub(super) others: Vec<Region<W>>,
}

/// Cuts sites into runs; into one if more would not pay.
pub(super) fn cut<P: Position3, W: Lift>(sites: Sites<'_, P, W>) -> Vec<Run<W>> {
    let share = if sites.len() < CUT_SITES { 1.0 } else { share_at_cut(sites) };
    let cuts = if share > TWICE_FOR_TWO { 0 } else { ((TWICE / share) as u32).clamp(1, MAX_CUTS) };
    divide(sites, (0..sites.len() as u32).collect(), cuts, Vec::new())
}

/// All sites as one run.
pub(super) fn uncut<P: Position3, W: Lift>(sites: Sites<'_, P, W>) -> Vec<Run<W>> {
    divide(sites, (0..sites.len() as u32).collect(), 0, Vec::new())
}

/// A cut between two halves, and the heaviest site of each.
struct Cut<W> {
    axis: usize,
    at: f64,
    most: [W; 2],
}

/// The share of points that are expected at the border of two halves: the larger of what thin samples of the whole and dense
/// ones of places near the cut let expect.
fn share_at_cut<P: Position3, W: Lift>(sites: Sites<'_, P, W>) -> f64 {
    let mut random = SplitMix(0);
    let all: Vec<u32> = (0..sites.len() as u32).collect();
    let Some((axis, at)) = choose(sites.points, &all) else { return 1.0 };
    let most = [true, false].map(|below| {
        let of_half = all.iter().filter(|&&i| (sites.point(i)[axis] < at) == below);
        W::most(of_half.map(|&i| sites.weight(i)))
    });
    let cut = &Cut { axis, at, most };
    let thin = thin_share(sites, cut, &mut random);
    if thin > TWICE_FOR_TWO { thin } else { thin.max(dense_share(sites, cut, &mut random)) }
}

/// The share that samples of two sizes predict: the change from one to the other is extrapolated.
fn thin_share<P: Position3, W: Lift>(sites: Sites<'_, P, W>, cut: &Cut<W>, random: &mut SplitMix) -> f64 {
    let [few, many] = THIN.map(|count| {
        let sample = (0..count).map(|_| random.below(sites.len()) as u32).collect();
        at_border(sites, sample, cut).unwrap_or(1.0)
    });
    if many == 0.0 {
        return 0.0;
    }
    let steps = libm::log(sites.len() as f64 / THIN[1] as f64) / libm::log(THIN[1] as f64 / THIN[0] as f64);
    many * libm::pow((many / few).min(1.0), steps)
}

/// The share that all points of some boxes on the cut predict. A box is put at a random point near the cut; so each point is in as
/// many of them as there are points in its column. All, if no box can tell.
fn dense_share<P: Position3, W: Lift>(sites: Sites<'_, P, W>, cut: &Cut<W>, random: &mut SplitMix) -> f64 {
    let &Cut { axis, at, .. } = cut;
    let points = sites.points;
    let extent = Bounds::of(points.iter().map(Position3::xyz)).extent();
    let is_near =
        |p: &[f64; 3], q: &[f64; 3], part: f64, k: usize| (p[k] - q[k]).abs() <= extent[k] * part / 2.0;
    let (mut shares, mut boxes) = (0.0, 0);
    for _ in 0..DENSE {
        // As wide as it takes for so many points if they were spread evenly; wider until some are on either side.
        let mut part = libm::cbrt(THIN[0] as f64 / points.len() as f64);
        while part < 1.0 {
            let near: Vec<u32> = (0..points.len() as u32)
                .filter(|&i| is_near(&sites.point(i), &[at; 3], part, axis))
                .collect();
            if near.is_empty() {
                break;
            }
            let middle = sites.point(near[random.below(near.len())]);
            let in_column = |p: &[f64; 3]| (0..3).all(|k| k == axis || is_near(p, &middle, part, k));
            let sample: Vec<u32> = near.iter().copied().filter(|&i| in_column(&sites.point(i))).collect();
            if sample.len() > 16 * THIN[0] {
                break;
            }
            let Some(share) = at_border(sites, sample, cut) else {
                part *= 2.0;
                continue;
            };
            if share > WIDE {
                return 1.0;
            }
            shares += share * near.len() as f64 / points.len() as f64;
            boxes += 1;
            break;
        }
    }
    if boxes == 0 { 1.0 } else { shares / f64::from(boxes) }
}

/// The share of the vertices of a sample that are at the border of its halves. `None` if these cannot be triangulated apart.
fn at_border<P: Position3, W: Lift>(
    sites: Sites<'_, P, W>,
    mut sample: Vec<u32>,
    &Cut { axis, at, most }: &Cut<W>,
) -> Option<f64> {
    sorting::by(&mut sample, |&i, &j| sites.point(i)[axis].total_cmp(&sites.point(j)[axis]));
    let (low, high) = sample.split_at(sample.partition_point(|&i| sites.point(i)[axis] < at));
    let of_half = |half: &[u32], other: &[u32], most: W| {
        let order = order::space::hilbert(half.len(), &|i| sites.point(half[i as usize]));
        let along = || order.iter().map(|&i| half[i as usize]);
        let points: Vec<[f64; 3]> = along().map(|i| sites.point(i)).collect();
        let weights: Vec<W> = along().map(|i| sites.weight(i)).collect();
        let mut cells = vec![Tetrahedron::FREE; 2 * super::room(points.len())];
        let (mut marks, mut incident) = (vec![0; cells.len()], vec![TetrahedronId::NONE; points.len()]);
        let mut part = Part::new((&points, &weights), &mut cells, &mut marks, &mut incident);
        part.build(0, &mut ())?;
        let border = part.find_border(&[Region { most, ..sites.region(other) }]);
        Some((part.vertices_of(&border).len(), half.len() - part.hidden()))
    };
    let (low, high) = (of_half(low, high, most[1])?, of_half(high, low, most[0])?);
    Some((low.0 + high.0) as f64 / (low.1 + high.1) as f64)
}

/// Cuts sites in halves so many times.
pub(super) fn divide<P: Position3, W: Lift>(
    sites: Sites<'_, P, W>,
    indices: Vec<u32>,
    cuts: u32,
    others: Vec<Region<W>>,
) -> Vec<Run<W>> {
    let Some((axis, at)) = (cuts > 0).then(|| choose(sites.points, &indices)).flatten() else {
        let order = order::space::hilbert(indices.len(), &|k| sites.point(indices[k as usize]));
        return vec![Run { order: order.into_iter().map(|k| indices[k as usize]).collect(), others }];
    };
    let halves: (Vec<u32>, Vec<u32>) = indices.into_iter().partition(|&i| sites.point(i)[axis] < at);
    let halves = [halves.0, halves.1];
    let regions = [0, 1].map(|k| sites.region(&halves[k]));
    let tasks = halves.into_iter().zip([regions[1], regions[0]]).collect();
    let runs = parallel::map(tasks, |(half, other): (Vec<u32>, Region<W>)| {
        divide(sites, half, cuts - 1, others.iter().copied().chain([other]).collect())
    });
    runs.into_iter().flatten().collect()
}

/// The axis and the coordinate that cut points best; none if one side would have nearly all of them, whatever the axis.
fn choose<P: Position3>(points: &[P], indices: &[u32]) -> Option<(usize, f64)> {
    const TRIED: usize = 1024;
    let extent = Bounds::of(indices.iter().map(|&i| points[i as usize].xyz())).extent();
    let mut axes = [0, 1, 2];
    sorting::by(&mut axes, |&i, &j| extent[j].total_cmp(&extent[i]));
    let mut random = SplitMix(1);
    let tried: Vec<[f64; 3]> =
        (0..TRIED).map(|_| points[indices[random.below(indices.len())] as usize].xyz()).collect();
    axes.into_iter().find_map(|axis| {
        let mut along: Vec<f64> = tried.iter().map(|p| p[axis]).collect();
        along.sort_by(f64::total_cmp);
        let at = along[TRIED / 2];
        let below = along.iter().filter(|&&x| x < at).count();
        (TRIED / 4..=3 * TRIED / 4).contains(&below).then_some((axis, at))
    })
}
