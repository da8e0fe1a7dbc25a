//! Corners of a hull in the plane that are within a length of the hull of the others are left out.
//!
//! In rounds each corner is measured against the segment between its neighbours, and of those within the length the nearest go first, no
//! two neighbours in one round. A point that was left out belongs to the side that took its place, and must stay within the length of each
//! side that follows. In space `space/merge.rs` does the same.
//!
//! Cost: O(n log n) for n corners in each of a few rounds.

use delone_predicates::lexicographic;

use crate::foot::distance;
use crate::powers::power_below;

/// Points and a length divided by a power of two, so that coordinates are below two and no product leaves the range.
pub(super) fn near_one<const D: usize>(points: Vec<[f64; D]>, length: f64) -> (Vec<[f64; D]>, f64) {
    let power = power_below(points.iter().flatten().fold(0.0, |most, x| x.abs().max(most)));
    (points.into_iter().map(|p| p.map(|x| x / power)).collect(), length / power)
}

/// A corner, and the points that were left out between it and the next one.
struct Corner {
    index: usize,
    out: Vec<usize>,
}

/// The corners that are left, from the lexicographically smallest; none if all are within the length of one line.
pub(super) fn left(points: &[[f64; 2]], corners: &[usize], length: f64) -> Option<Vec<usize>> {
    let (points, length) = near_one(corners.iter().map(|&i| points[i]).collect(), length);
    let mut ring: Vec<Corner> = (0..points.len()).map(|index| Corner { index, out: Vec::new() }).collect();
    loop {
        let count = ring.len();
        let ends = |k: usize| [(k + count - 1) % count, (k + 1) % count];
        let away = |k: usize, p: usize| part(&points, ends(k).map(|k| ring[k].index), p, length);
        let height = |k: usize| {
            let before = &ring[ends(k)[0]];
            let is_near = before.out.iter().chain(&ring[k].out).all(|&p| away(k, p).is_some());
            away(k, ring[k].index).filter(|_| is_near)
        };
        let mut candidates: Vec<(f64, usize)> = (0..count).filter_map(|k| Some((height(k)?, k))).collect();
        if candidates.is_empty() {
            break;
        }
        if count <= 3 {
            return None;
        }
        let at = |k: usize| points[ring[k].index];
        candidates
            .sort_unstable_by(|(p, j), (q, k)| p.total_cmp(q).then_with(|| lexicographic(at(*j), at(*k))));
        // With fewer than three corners there is nothing inside.
        let (mut goes, mut stays, mut most) = (vec![false; count], vec![false; count], count - 3);
        for (_, k) in candidates {
            if !stays[k] && most > 0 {
                goes[k] = true;
                ends(k).into_iter().for_each(|k| stays[k] = true);
                most -= 1;
            }
        }
        for k in (0..count).filter(|&k| goes[k]) {
            let mut out = std::mem::take(&mut ring[k].out);
            out.push(ring[k].index);
            ring[(k + count - 1) % count].out.extend(out);
        }
        let mut goes = goes.into_iter();
        ring.retain(|_| !goes.next().unwrap_or(false));
    }
    let mut left: Vec<usize> = ring.iter().map(|corner| corners[corner.index]).collect();
    let at = |k: usize| points[ring[k].index];
    let least = (0..left.len()).min_by(|&j, &k| lexicographic(at(j), at(k)));
    left.rotate_left(least.unwrap_or(0));
    Some(left)
}

/// The distance of a point from the segment between two others, as a part of the length; none beyond that.
fn part(points: &[[f64; 2]], mut ends: [usize; 2], p: usize, length: f64) -> Option<f64> {
    // Sorted, so that the order of the points does not show.
    ends.sort_unstable_by(|&i, &j| lexicographic(points[i], points[j]));
    let [a, b, q] = [ends[0], ends[1], p].map(|i| [points[i][0], points[i][1], 0.0]);
    let part = distance(q, [a, b]) / length;
    (part <= 1.0).then_some(part)
}
