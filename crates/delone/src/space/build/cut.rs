//! Where to cut a set of points of space into parts that are triangulated apart.
//!
//! Near a cut points are triangulated twice, once in their part and once with those of the other side. How many, a sample
//! tells: of points that fill space they are few, and the fewer the more there are; of points on a surface whose
//! tetrahedra reach far they may be all. What is decided depends on the points alone.
//!
//! Cost: O(n log n).

use super::super::Position3;
use super::super::layer::Limits;
use super::part::Part;
use crate::ids::TetrahedronId;
use crate::mesh::tetrahedra::Tetrahedron;
use crate::order::curve;
use crate::order::random::SplitMix;
use crate::parallel;

/// Fewer points are not worth it.
const MANY: usize = 1 << 14;
/// The sizes of the samples.
const SAMPLES: [usize; 2] = [512, 4096];
/// The share of points that may be triangulated twice.
const TWICE: f64 = 0.05;
/// More cuts, one after the other, make more parts than there are threads.
const MOST: u32 = 8;

/// Points to be triangulated apart.
pub(super) struct Run {
    /// Their indices, along a Hilbert curve.
    pub(super) order: Vec<u32>,
    /// Boxes around all other points.
    pub(super) others: Vec<Limits>,
}

/// Cuts points into runs; `None` if that would not pay.
pub(super) fn cut<P: Position3>(points: &[P]) -> Option<Vec<Run>> {
    if points.len() < MANY {
        return None;
    }
    let cuts = (TWICE / share_at_cut(points)) as u32;
    let all = (0..points.len() as u32).collect();
    (cuts > 0).then(|| divide(points, all, cuts.min(MOST), Vec::new()))
}

/// The share of points, expected, that are at the border of two halves.
fn share_at_cut<P: Position3>(points: &[P]) -> f64 {
    let mut random = SplitMix(0);
    let [few, many] = SAMPLES.map(|count| {
        let mut sample = |_| random.below(points.len()) as u32;
        sample_share(points, (0..count).map(&mut sample).collect())
    });
    if many == 0.0 {
        return 0.0;
    }
    // As it changed between the samples it goes on.
    let steps = (points.len() as f64 / SAMPLES[1] as f64).ln() / (SAMPLES[1] as f64 / SAMPLES[0] as f64).ln();
    many * (many / few).min(1.0).powf(steps)
}

/// The share of a sample that is at the border of its halves; all if it has none that can be triangulated apart.
fn sample_share<P: Position3>(points: &[P], sample: Vec<u32>) -> f64 {
    let count = sample.len();
    let runs = divide(points, sample, 1, Vec::new());
    let at_border = |run: &Run| {
        let points: Vec<[f64; 3]> = run.order.iter().map(|&i| points[i as usize].xyz()).collect();
        let mut cells = vec![Tetrahedron::FREE; 2 * super::ROOM * points.len()];
        let (mut marks, mut incident) = (vec![0; cells.len()], vec![TetrahedronId::NONE; points.len()]);
        let mut part = Part::new(&points, &mut cells, &mut marks, &mut incident);
        part.build(0, &mut ()).map(|()| {
            let border = part.find_border(&run.others);
            part.vertices_of(&border).len()
        })
    };
    let at_borders: Option<usize> = runs.iter().map(at_border).sum();
    match at_borders {
        Some(at_borders) if runs.len() > 1 => at_borders as f64 / count as f64,
        _ => 1.0,
    }
}

/// Cuts points in halves so many times.
pub(super) fn divide<P: Position3>(points: &[P], indices: Vec<u32>, cuts: u32, others: Vec<Limits>) -> Vec<Run> {
    let Some((axis, at)) = (cuts > 0).then(|| choose(points, &indices)).flatten() else {
        let order = curve::hilbert(indices.len(), &|k| points[indices[k as usize] as usize].xyz());
        return vec![Run { order: order.into_iter().map(|k| indices[k as usize]).collect(), others }];
    };
    let halves: (Vec<u32>, Vec<u32>) = indices.into_iter().partition(|&i| points[i as usize].xyz()[axis] < at);
    let halves = [halves.0, halves.1];
    let boxes = [0, 1].map(|k| Limits::around(halves[k].iter().map(|&i| points[i as usize].xyz())));
    let tasks = halves.into_iter().zip([boxes[1], boxes[0]]).collect();
    let runs = parallel::map(tasks, |(half, other): (Vec<u32>, Limits)| {
        divide(points, half, cuts - 1, others.iter().copied().chain([other]).collect())
    });
    runs.into_iter().flatten().collect()
}

/// The axis and the coordinate that cut points best; none if one side would have nearly all of them, whatever the axis.
fn choose<P: Position3>(points: &[P], indices: &[u32]) -> Option<(usize, f64)> {
    const TRIED: usize = 1024;
    let extent = Limits::around(indices.iter().map(|&i| points[i as usize].xyz())).extent();
    let mut axes = [0, 1, 2];
    axes.sort_by(|&i, &j| extent[j].total_cmp(&extent[i]));
    let mut random = SplitMix(1);
    let tried: Vec<[f64; 3]> = (0..TRIED)
        .map(|_| points[indices[random.below(indices.len())] as usize].xyz())
        .collect();
    axes.into_iter().find_map(|axis| {
        let mut along: Vec<f64> = tried.iter().map(|p| p[axis]).collect();
        along.sort_by(f64::total_cmp);
        let at = along[TRIED / 2];
        let below = along.iter().filter(|&&x| x < at).count();
        (TRIED / 4..=3 * TRIED / 4).contains(&below).then_some((axis, at))
    })
}
