//! Corners of a hull in the plane that are within a length of the hull of the others are left out.
//!
//! In rounds each corner is measured against the segment between its neighbors, and of those within the length the nearest go first, no
//! two neighbors in one round. A point that was left out belongs to the side that took its place, and must stay within the length of each
//! side that follows. In space `space/merge.rs` does the same.
//!
//! After the first round only the neighbors of corners that went are measured again.
//!
//! Cost: O(n log n) for n corners, and O(m) for each corner that is measured with m points left out beside it.

use delone_predicates::lexicographic;

use crate::closest::distance_bound;
use crate::powers::power_below;
use crate::tally::Tally;

/// Points and a length divided by a power of two, so that coordinates are below two and no product leaves the range.
pub(super) fn near_one<const D: usize>(points: Vec<[f64; D]>, length: f64) -> (Vec<[f64; D]>, f64) {
    let power = power_below(points.iter().flatten().fold(0.0, |most, x| x.abs().max(most)));
    (points.into_iter().map(|p| p.map(|x| x / power)).collect(), length / power)
}

/// A ring of corners, each with the points that were left out between it and the next one.
struct Ring<'a> {
    points: &'a [[f64; 2]],
    length: f64,
    /// The corner before each, and the next one.
    ends: Vec<[usize; 2]>,
    out: Vec<Vec<usize>>,
}

impl Ring<'_> {
    /// The distance of a corner from the segment between its neighbors, as a part of the length; none if it, or a point that was left out
    /// beside it, is further away than the length.
    fn height(&self, k: usize) -> Option<f64> {
        let away = |p: usize| part(self.points, self.ends[k], p, self.length);
        let height = away(k)?;
        let beside = self.out[self.ends[k][0]].iter().chain(&self.out[k]);
        beside.copied().all(|p| away(p).is_some()).then_some(height)
    }

    fn leave(&mut self, k: usize) {
        let [before, next] = self.ends[k];
        (self.ends[before][1], self.ends[next][0]) = (next, before);
        let out = std::mem::take(&mut self.out[k]);
        self.out[before].extend(out.into_iter().chain([k]));
    }
}

/// The corners that are left, from the lexicographically smallest; none if all are within the length of one line.
pub(super) fn left(
    points: &[[f64; 2]],
    corners: &[usize],
    length: f64,
    tally: &mut impl Tally,
) -> Option<Vec<usize>> {
    let (points, length) = near_one(corners.iter().map(|&i| points[i]).collect(), length);
    let all = points.len();
    let ends = (0..all).map(|k| [(k + all - 1) % all, (k + 1) % all]).collect();
    let mut ring = Ring { points: &points, length, ends, out: vec![Vec::new(); all] };
    let mut left: Vec<usize> = (0..all).collect();
    // A corner that did not go, and whose neighbors are the same still, does not go now.
    let mut changed = left.clone();
    let (mut stays, mut goes) = (vec![0; all], vec![false; all]);
    for round in 1.. {
        let mut candidates: Vec<(f64, usize)> = Vec::new();
        for &k in &changed {
            tally.compared();
            candidates.extend(ring.height(k).map(|height| (height, k)));
        }
        if candidates.is_empty() {
            break;
        }
        if left.len() <= 3 {
            return None;
        }
        candidates.sort_unstable_by(|(p, j), (q, k)| {
            p.total_cmp(q).then_with(|| lexicographic(points[*j], points[*k]))
        });
        // With fewer than three corners there is nothing inside.
        let mut most = left.len() - 3;
        changed.clear();
        for (_, k) in candidates {
            if stays[k] != round && most > 0 {
                goes[k] = true;
                ring.ends[k].into_iter().for_each(|k| stays[k] = round);
                changed.extend(ring.ends[k]);
                ring.leave(k);
                most -= 1;
            }
        }
        left.retain(|&k| !goes[k]);
        if left.len() == 3 {
            // More would have gone.
            changed.clone_from(&left);
        }
        changed.sort_unstable();
        changed.dedup();
    }
    let least = (0..left.len()).min_by(|&j, &k| lexicographic(points[left[j]], points[left[k]]));
    left.rotate_left(least.unwrap_or(0));
    Some(left.into_iter().map(|k| corners[k]).collect())
}

/// The distance of a point from the segment between two others, as a part of the length; none beyond that.
fn part(points: &[[f64; 2]], mut ends: [usize; 2], p: usize, length: f64) -> Option<f64> {
    // Sorted, so that the order of the points does not show.
    ends.sort_unstable_by(|&i, &j| lexicographic(points[i], points[j]));
    let [a, b, q] = [ends[0], ends[1], p].map(|i| [points[i][0], points[i][1], 0.0]);
    let part = distance_bound(q, [a, b]) / length;
    (part <= 1.0).then_some(part)
}

#[cfg(test)]
mod tests {
    use super::left;
    use crate::tally::Work;

    #[test]
    fn corners_are_measured_again_only_beside_those_that_went() {
        let at = |k: usize| (std::f64::consts::TAU * k as f64 / 3000.0).sin_cos();
        let points: Vec<[f64; 2]> = (0..3000).map(|k| [at(k).1, at(k).0]).collect();
        let corners: Vec<usize> = (0..points.len()).collect();
        for length in [1e-12, 1e-5, 1e-3] {
            let mut work = Work::default();
            let left = left(&points, &corners, length, &mut work).expect("an area");
            let gone = points.len() - left.len();
            assert_eq!(gone == 0, length == 1e-12);
            let most = points.len() + 2 * gone;
            assert!(work.compared as usize <= most, "{length}: {gone} {}", work.compared);
        }
    }
}
