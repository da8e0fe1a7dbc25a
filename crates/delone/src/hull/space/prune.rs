//! What is surely inside, left out before it costs anything.
//!
//! Source: Akl & Toussaint, "A fast convex hull algorithm", IPL 1978: what is inside of the hull of a few extreme points is
//! no corner. Here these are the extremes of a sample along the axes and the diagonals of its box, and what is tested is a box
//! inside of their hull, which takes six comparisons a point. The hull and the box decide exactly, so nothing is lost.
//!
//! Cost: O(n), one pass.

use super::quickhull::Quickhull;
use super::shell::Shell;
use super::start::Start;

/// With fewer points nothing is gained.
const FEW: usize = 2000;
/// How many points are asked for extremes.
const SAMPLE: usize = 1 << 15;
/// The axes, and the diagonals of a cube.
const WAYS: [[f64; 3]; 7] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [1.0, 1.0, -1.0],
    [1.0, -1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

/// The indices of points that may be corners of the hull, in order; none if they may be all.
pub(super) fn candidates(points: &[[f64; 3]]) -> Option<Vec<u32>> {
    let inner = if points.len() < FEW { None } else { inner_box(points) }?;
    let mut kept = vec![0; points.len()];
    let mut count = 0;
    let [low, high] = [inner.map(|ends| ends.0), inner.map(|ends| ends.1)];
    for (p, i) in points.iter().zip(0..) {
        // What is on the box may be one of the extremes. All comparisons at once: branches could not be foretold.
        let is_inside =
            (0..3).map(|k| u8::from(low[k] < p[k]) & u8::from(p[k] < high[k])).fold(1, |a, b| a & b);
        kept[count] = i;
        count += usize::from(1 - is_inside);
    }
    kept.truncate(count);
    Some(kept)
}

/// A box inside of the hull: its ends, axis by axis.
fn inner_box(points: &[[f64; 3]]) -> Option<[(f64, f64); 3]> {
    let sample = || points.iter().step_by(points.len().div_ceil(SAMPLE));
    let range = [0, 1, 2].map(|k| {
        let of = sample().map(|p| p[k]);
        (of.clone().fold(f64::MAX, f64::min), of.fold(f64::MIN, f64::max))
    });
    // From -1 to 1, about, and in range.
    let scaled = |p: &[f64; 3]| {
        [0, 1, 2].map(|k| {
            let (low, high) = range[k];
            (p[k] / 2.0 - low / 2.0) / (high / 4.0 - low / 4.0) - 1.0
        })
    };
    let mut furthest = [(f64::MIN, points[0]); 14];
    for p in sample() {
        let q = scaled(p);
        for (way, ends) in WAYS.iter().zip(furthest.as_chunks_mut::<2>().0) {
            let along = (0..3).map(|k| way[k] * q[k]).sum::<f64>();
            for (end, along) in ends.iter_mut().zip([along, -along]) {
                if along > end.0 {
                    *end = (along, *p);
                }
            }
        }
    }
    let extremes = furthest.map(|(_, p)| p);
    let Start::Tetrahedron(corners) = Start::of(&extremes) else { return None };
    let hull = Quickhull::new(extremes.to_vec(), corners).finish();
    // Among the ends of diagonals each corner of the box has its own.
    let centre = range.map(|(low, high)| low / 2.0 + high / 2.0);
    let mut ends = range;
    for p in &extremes[6..] {
        for k in 0..3 {
            if p[k] > centre[k] {
                ends[k].1 = ends[k].1.min(p[k]);
            } else {
                ends[k].0 = ends[k].0.max(p[k]);
            }
        }
    }
    (0..8).map(|shrinking| 0.875_f64.powi(shrinking)).find_map(|share| {
        let ends = [0, 1, 2].map(|k| {
            let towards = |x: f64| centre[k] * (1.0 - share) + x * share;
            (towards(ends[k].0), towards(ends[k].1))
        });
        is_in_hull(&hull, ends).then_some(ends)
    })
}

/// Whether no facet sees a corner of a box.
fn is_in_hull(hull: &Shell, ends: [(f64, f64); 3]) -> bool {
    let corners =
        (0..8).map(|bits| [0, 1, 2].map(|k| if bits >> k & 1 == 0 { ends[k].0 } else { ends[k].1 }));
    let facets = || (0..hull.facets.len() as u32).filter(|&f| hull.facets[f as usize].alive);
    ends.iter().all(|(low, high)| low < high)
        && corners.into_iter().all(|q| hull.is_in_box(q) && !facets().any(|f| hull.sees(q, f)))
}

#[cfg(test)]
mod tests {
    use delone_generators::Random;

    use super::*;

    fn points_in(random: &mut Random, is_in: impl Fn([f64; 3]) -> bool) -> Vec<[f64; 3]> {
        std::iter::repeat_with(|| [0, 1, 2].map(|_| random.between(-1.0, 1.0)))
            .filter(|&p| is_in(p))
            .take(5000)
            .collect()
    }

    #[test]
    fn most_inner_points_are_left_out() {
        let mut random = Random::new(1);
        let cube = points_in(&mut random, |_| true);
        let left = candidates(&cube).expect("a box").len();
        assert!(left < cube.len() / 3, "{left} of a cube");
        let ball = points_in(&mut random, |p| p.iter().map(|x| x * x).sum::<f64>() < 1.0);
        let left = candidates(&ball).expect("a box").len();
        assert!(left < cube.len() * 3 / 4, "{left} of a ball");
        let wide: Vec<_> = cube.iter().map(|&[x, y, z]| [1e300 * x, y, 1e-300 * z]).collect();
        let left = candidates(&wide).expect("a box").len();
        assert!(left < cube.len() / 3, "{left} of a flat box");
    }

    #[test]
    fn corners_are_kept() {
        let mut random = Random::new(2);
        for scale in [1.0, 1e-310, 1e307] {
            let points: Vec<_> =
                points_in(&mut random, |_| true).into_iter().map(|p| p.map(|x| x * scale)).collect();
            let Start::Tetrahedron(corners) = Start::of(&points) else { panic!("they span space") };
            let hull = Quickhull::new(points.clone(), corners).finish();
            let kept = candidates(&points).unwrap_or_else(|| (0..points.len() as u32).collect());
            for facet in hull.facets.iter().filter(|facet| facet.alive) {
                assert!(facet.corners.iter().all(|i| kept.binary_search(i).is_ok()));
            }
        }
    }

    #[test]
    fn flat_sets_are_kept() {
        let mut random = Random::new(3);
        let flat: Vec<_> = points_in(&mut random, |_| true).iter().map(|&[x, y, _]| [x, y, 0.5]).collect();
        assert!(candidates(&flat).is_none_or(|kept| kept.len() == flat.len()));
        assert!(candidates(&vec![[1.0; 3]; 5000]).is_none());
    }
}
