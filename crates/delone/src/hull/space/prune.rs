//! Pruning: points that are surely inside are left out before they cost anything.
//!
//! Source: Akl & Toussaint, "A fast convex hull algorithm", IPL 1978: what is inside of the hull of a few points is no corner.
//! Here these are the corners of the hull of a sample, and what is tested are columns inside of that hull (`columns.rs`), which takes
//! two comparisons a point. The hull of the sample is found in the same way, and the columns decide exactly, so nothing is lost.
//!
//! Cost: O(n), one pass, and a hull of O(n^(2/3)) points; the columns are looked for with O(n) decisions, or not at all.

use super::columns::Columns;
use super::quickhull::Quickhull;
use super::shell::Shell;
use super::start::Start;

/// Points, from which on interior points are pruned; with fewer of them pruning gains nothing.
const PRUNED_POINTS: usize = 4000;
/// Points of the sample that tells whether most points are corners.
const TASTE: usize = 256;
/// More columns would not be in the cache.
const MOST_CELLS: usize = 128;

/// The indices of points that may be corners of the hull, in order; none if they may be all.
pub(super) fn candidates(points: &[[f64; 3]]) -> Option<Vec<u32>> {
    if points.len() < PRUNED_POINTS || facets(&hull(every(points, points.len() / TASTE))?) > TASTE {
        return None;
    }
    // Of a ball, a sample of m leaves 3 n / sqrt(m) points, and k cells along an axis leave 6 n / k.
    let root = libm::cbrt(points.len() as f64);
    let cells = ((2.0 * root) as usize).min(MOST_CELLS);
    let most_looks = points.len() + 8 * cells * cells;
    let columns = Columns::inside(&hull(every(points, (root / 2.0) as usize))?, cells, most_looks)?;
    let mut kept = vec![0; points.len()];
    let mut count = 0;
    for (p, i) in points.iter().zip(0..) {
        kept[count] = i;
        count += usize::from(!columns.hold(*p));
    }
    kept.truncate(count);
    Some(kept)
}

/// One of so many points.
fn every(points: &[[f64; 3]], step: usize) -> Vec<[f64; 3]> {
    points.iter().step_by(step).copied().collect()
}

/// The hull of points that span space, found as that of all.
fn hull(mut points: Vec<[f64; 3]>) -> Option<Shell> {
    if let Some(kept) = candidates(&points) {
        points = kept.iter().map(|&i| points[i as usize]).collect();
    }
    let Start::Tetrahedron(corners) = Start::of(&points) else { return None };
    Some(Quickhull::new(points, corners).finish())
}

/// How many facets a hull has: two for each corner, less four.
fn facets(hull: &Shell) -> usize {
    hull.facets.iter().filter(|facet| facet.alive).count()
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
