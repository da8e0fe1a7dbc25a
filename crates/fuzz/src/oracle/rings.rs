//! Rings and what they tile, decided over integers by all pairs of sides.
//!
//! Cost: O(k^2) for rings of k sides, of which those with boxes apart cost nothing.

use std::collections::BTreeSet;

use num_bigint::BigInt;

use super::exact::{Vector, dot, integer, integers, minus, orientation, scale, sign};
use crate::attack::Judgement;

/// The corners of a closed line.
pub(crate) type Ring = Vec<[f64; 2]>;

/// A directed side.
pub(crate) type Side = [[f64; 2]; 2];

/// How far a corner on a slanted side of a region is from it at most, in units in the last place of the region's largest coordinate: each
/// coordinate is rounded once, and one corner may stand for another beside it.
const FURTHEST_FROM_BORDER: i64 = 2;

/// A region is narrow where a corner is nearer to a side, in the same units.
const NARROW: f64 = 64.0;

/// And where the sine of the angle at a corner is less.
const LEAST_SINE: f64 = 1e-4;

/// The share of a side along an axis that is nothing beside it: 2^-900.
const LEAST_SHARE: f64 = f64::from_bits(123 << 52);

/// The sides of rings, ring by ring.
fn sides(rings: &[Ring]) -> impl Iterator<Item = Side> + '_ {
    rings.iter().flat_map(|ring| (0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()]]))
}

/// Whether rings surely are a region: all corners are different, and no side meets another one beside its corners.
pub(crate) fn is_proper(rings: &[Vec<[f64; 2]>]) -> bool {
    let mut corners = rings.concat();
    corners.sort_by(|p, q| p.partial_cmp(q).unwrap_or(std::cmp::Ordering::Equal));
    !rings.is_empty()
        && rings.iter().all(|ring| ring.len() > 2)
        && corners.iter().flatten().all(|x| x.is_finite())
        && corners.windows(2).all(|pair| pair[0] != pair[1])
        && crossing(rings).is_ok()
}

/// No two sides have more than corners in common.
pub(crate) fn crossing(rings: &[Ring]) -> Judgement {
    are_apart(&sides(rings).collect::<Vec<_>>())
}

/// The sides of neighbors, which have them both, once.
pub(crate) fn are_neighbors(polygons: &[Vec<Ring>]) -> Judgement {
    for rings in polygons {
        border(rings).map_err(|wrong| format!("{wrong}: {rings:?}"))?;
    }
    let once = |[p, q]: Side| if p < q { [p, q] } else { [q, p] };
    let mut all: Vec<Side> = polygons.iter().flat_map(|rings| sides(rings)).collect();
    all.sort_by(|s, t| s.partial_cmp(t).unwrap_or(std::cmp::Ordering::Equal));
    if let Some([side, ..]) = all.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(format!("two polygons have the side {side:?}"));
    }
    let mut all: Vec<Side> = all.into_iter().map(once).collect();
    all.sort_by(|s, t| s.partial_cmp(t).unwrap_or(std::cmp::Ordering::Equal));
    all.dedup();
    are_apart(&all)
}

/// No two of different sides have more than ends in common.
pub(crate) fn are_apart(ends: &[Side]) -> Judgement {
    let exact: Vec<Vec<Vector>> = integers(ends.as_flattened()).chunks(2).map(<[Vector]>::to_vec).collect();
    let is_beside = |s: Side, t: Side| {
        (0..2).any(|k| {
            s[0][k].max(s[1][k]) < t[0][k].min(t[1][k]) || t[0][k].max(t[1][k]) < s[0][k].min(s[1][k])
        })
    };
    for (i, s) in exact.iter().enumerate() {
        for (j, t) in exact[..i].iter().enumerate().filter(|(j, _)| !is_beside(ends[i], ends[*j])) {
            let side = |s: &[Vector], p: &Vector| {
                let [a, b] = [&s[0], &s[1]];
                let left = (&b[0] - &a[0]) * (&p[1] - &a[1]) - (&b[1] - &a[1]) * (&p[0] - &a[0]);
                sign(&left)
            };
            let [of_s, of_t] = [(s, t), (t, s)].map(|(s, t)| [side(s, &t[0]), side(s, &t[1])]);
            let cross = of_s[0] * of_s[1] < 0 && of_t[0] * of_t[1] < 0;
            let is_between = |p: &Vector, s: &[Vector]| (&s[0] < p && p < &s[1]) || (&s[1] < p && p < &s[0]);
            let touch = (0..2)
                .any(|k| (of_s[k] == 0 && is_between(&t[k], s)) || (of_t[k] == 0 && is_between(&s[k], t)));
            let same = s == t || (s[0] == t[1] && s[1] == t[0]);
            if cross || touch || same {
                return Err(format!("there are the sides {:?} and {:?}", ends[i], ends[j]));
            }
        }
    }
    Ok(())
}

/// The area, exact until it is rounded at the end.
pub(crate) fn exact_area(rings: &[Vec<[f64; 2]>]) -> f64 {
    let scale = scale(rings.iter().flatten().flatten());
    let twice: BigInt = rings
        .iter()
        .map(|ring| {
            let exact = integers_at(ring, scale);
            (0..exact.len())
                .map(|i| {
                    let (p, q) = (&exact[i], &exact[(i + 1) % exact.len()]);
                    &p[0] * &q[1] - &p[1] * &q[0]
                })
                .sum::<BigInt>()
        })
        .sum();
    // 62 bits are enough, and scaled in two steps nothing leaves the range on the way.
    let spare = twice.bits().saturating_sub(62) as i32;
    let digits = i64::try_from(twice >> spare.max(0)).unwrap_or(i64::MAX) as f64;
    let exponent = 2 * scale + spare - 1;
    let half = exponent / 2;
    digits * 2_f64.powi(half) * 2_f64.powi(exponent - half)
}

fn integers_at(points: &[[f64; 2]], scale: i32) -> Vec<Vector> {
    points.iter().map(|p| p.iter().map(|&x| integer(x, scale)).collect()).collect()
}

/// Whether a ray to the right meets the rings an odd number of times, decided exactly.
pub(crate) fn even_odd(rings: &[Vec<[f64; 2]>], q: [f64; 2]) -> bool {
    let mut odd = false;
    for ring in rings {
        for (i, &a) in ring.iter().enumerate() {
            let b = ring[(i + 1) % ring.len()];
            if (a[1] <= q[1]) != (b[1] <= q[1]) {
                let exact = integers(&[a, b, q]);
                let left = orientation(&[&exact[0], &exact[1], &exact[2]]);
                odd ^= (left > 0) == (b[1] > a[1]);
            }
        }
    }
    odd
}

/// Rings that are the border of something on their left: each simple, outer ones counter-clockwise, holes clockwise.
fn border(rings: &[Ring]) -> Judgement {
    for (i, ring) in rings.iter().enumerate() {
        let mut corners = ring.iter().map(|p| p.map(|x| (x + 0.0).to_bits())).collect::<Vec<_>>();
        corners.sort_unstable();
        corners.dedup();
        if ring.len() < 3 || corners.len() < ring.len() || !ring.iter().flatten().all(|x| x.is_finite()) {
            return Err(format!("a ring has the corners {ring:?}"));
        }
        let others: Vec<Ring> = (0..rings.len()).filter(|&j| j != i).map(|j| rings[j].clone()).collect();
        // Rings may have corners in common.
        let Some(&alone) = ring.iter().find(|p| !others.iter().any(|other| other.contains(p))) else {
            continue;
        };
        let exact = integers(ring);
        let next = exact.iter().cycle().skip(1);
        let twice: BigInt = exact.iter().zip(next).map(|(p, q)| &p[0] * &q[1] - &p[1] * &q[0]).sum();
        let expected = if even_odd(&others, alone) { -1 } else { 1 };
        if sign(&twice) != expected {
            return Err(format!("a ring has the area of sign {} and not {expected}: {ring:?}", sign(&twice)));
        }
    }
    crossing(rings)
}

/// Cells that tile a region: each ring is a border, each side of a cell is that of one other, backwards, or on the border of the region, and
/// the corners of a region that is nowhere narrow are corners of cells.
pub(crate) fn tile(cells: &[Vec<Ring>], region: &[Ring]) -> Judgement {
    // Where a region itself is as narrow as roundings there is no room to mend.
    if !is_wide(region) {
        return Ok(());
    }
    for (i, rings) in cells.iter().enumerate() {
        border(rings).map_err(|wrong| format!("cell {i}: {wrong}: {rings:?}"))?;
    }
    // Zeros have one sign.
    let bits = |p: [f64; 2]| p.map(|x| (x + 0.0).to_bits());
    let mut all: BTreeSet<[[u64; 2]; 2]> = BTreeSet::new();
    for side in cells.iter().flat_map(|rings| sides(rings)) {
        if !all.insert(side.map(bits)) {
            return Err(format!("two cells have the side {side:?}"));
        }
    }
    // Cells of some roundings may be lost.
    let is_whole = cells.iter().all(|rings| !rings.is_empty());
    for (i, rings) in cells.iter().enumerate().filter(|_| is_whole) {
        for [p, q] in sides(rings).filter(|[p, q]| !all.contains(&[bits(*q), bits(*p)])) {
            if !sides(region).any(|side| is_along(side, [p, q])) {
                return Err(format!("cell {i} has the side {p:?} to {q:?} alone: {cells:?}"));
            }
        }
    }
    if !is_whole {
        let [found, wanted] = [cells.concat(), region.to_vec()].map(|rings| exact_area(&rings));
        let largest = region.iter().flatten().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
        let around: f64 = sides(region).map(|[p, q]| (q[0] - p[0]).hypot(q[1] - p[1])).sum();
        let room = NARROW * (largest.next_up() - largest) * around;
        let is_near = (found - wanted).abs() <= room || !wanted.is_finite();
        return is_near
            .then_some(())
            .ok_or_else(|| format!("the area of the cells is {found}, not {wanted}: {cells:?}"));
    }
    let corners: BTreeSet<[u64; 2]> = cells.iter().flatten().flatten().map(|p| bits(*p)).collect();
    match region.iter().flatten().find(|p| !corners.contains(&bits(**p))) {
        Some(corner) => Err(format!("the corner {corner:?} of the region is in no cell: {cells:?}")),
        None => Ok(()),
    }
}

/// Whether no corner of a region is so near to a side of others that rounding leaves nothing between them.
fn is_wide(region: &[Ring]) -> bool {
    let largest = region.iter().flatten().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    let least = NARROW * (largest - largest.next_down());
    // The sides of a corner part after a while.
    let is_apart = |[p, q]: Side| {
        let all = sides(region).filter(move |side| side[0] == q);
        all.into_iter().all(|[_, r]| {
            let (u, w) = ([p[0] - q[0], p[1] - q[1]], [r[0] - q[0], r[1] - q[1]]);
            let sine = (u[0] * w[1] - u[1] * w[0]).abs() / (u[0].hypot(u[1]) * w[0].hypot(w[1]));
            sine > LEAST_SINE || u[0] * w[0] + u[1] * w[1] < 0.0
        })
    };
    let is_far = |p: &[f64; 2], [a, b]: Side| *p == a || *p == b || from_side(a, b, *p) >= least;
    sides(region).all(is_apart) && region.iter().flatten().all(|p| sides(region).all(|side| is_far(p, side)))
}

/// The distance of a point from a side, rounded.
pub(crate) fn from_side(a: [f64; 2], b: [f64; 2], q: [f64; 2]) -> f64 {
    let (u, w) = ([b[0] - a[0], b[1] - a[1]], [q[0] - a[0], q[1] - a[1]]);
    let uu = u[0] * u[0] + u[1] * u[1];
    let t = if uu > 0.0 { ((u[0] * w[0] + u[1] * w[1]) / uu).clamp(0.0, 1.0) } else { 0.0 };
    (w[0] - t * u[0]).hypot(w[1] - t * u[1])
}

/// Whether both ends of a side are on a side of a region: exactly, if that is along an axis, else but for rounding. Of a region with the
/// size of one a corner at the least numbers is on an axis.
fn is_along([a, b]: Side, ends: Side) -> bool {
    if let Some(k) = (0..2).find(|&k| a[k] == b[k]) {
        let [low, high] = [a[1 - k].min(b[1 - k]), a[1 - k].max(b[1 - k])];
        let is_on = |x: f64| x == a[k] || (x - a[k]).abs() < LEAST_SHARE * (high - low);
        return ends.iter().all(|p| is_on(p[k]) && low <= p[1 - k] && p[1 - k] <= high);
    }
    let largest = [a, b].iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    let step = [largest - largest.next_down(), 0.0];
    let exact = integers(&[a, b, ends[0], ends[1], step]);
    let furthest = &exact[4][0] * FURTHEST_FROM_BORDER;
    let along = minus(&exact[1], &exact[0]);
    let squared = dot(&along, &along);
    exact[2..4].iter().all(|p| {
        let off = minus(p, &exact[0]);
        let cross = &along[0] * &off[1] - &along[1] * &off[0];
        let is_between = (0..2).all(|k| {
            let [low, high] = [(&exact[0][k]).min(&exact[1][k]), (&exact[0][k]).max(&exact[1][k])];
            low - &furthest <= p[k] && p[k] <= high + &furthest
        });
        is_between && &cross * &cross <= &furthest * &furthest * &squared
    })
}

#[cfg(test)]
mod tests {
    use super::{Ring, crossing, even_odd, exact_area, is_proper, tile};

    #[test]
    fn areas_and_insides_of_rings() {
        let outer = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        let hole = vec![[1.0, 1.0], [1.0, 2.0], [2.0, 1.0]];
        let rings = [outer.clone(), hole];
        assert_eq!(exact_area(&rings), 15.5);
        assert_eq!([[0.5, 0.5], [1.25, 1.25], [5.0, 0.5]].map(|q| even_odd(&rings, q)), [true, false, false]);
        let large = outer.iter().map(|p| p.map(|x| x * 1e150)).collect();
        assert!((exact_area(&[large]) / 1.6e301 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn sides_that_cross_or_touch_are_seen() {
        let square = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        let corner_to_corner = vec![[4.0, 4.0], [5.0, 4.0], [5.0, 5.0]];
        let touching = vec![[4.0, 2.0], [5.0, 1.0], [5.0, 3.0]];
        let bow_tie = vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert!(crossing(&[square.clone(), corner_to_corner]).is_ok());
        assert!(is_proper(std::slice::from_ref(&square)));
        assert!(crossing(&[square, touching]).is_err());
        assert!(crossing(std::slice::from_ref(&bow_tie)).is_err());
        assert!(!is_proper(&[bow_tie]) && !is_proper(&[]));
    }

    fn rectangle([x, y]: [f64; 2], [w, h]: [f64; 2]) -> Ring {
        vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]]
    }

    #[test]
    fn cells_that_do_not_tile_are_seen() {
        let region = [rectangle([0.0, 0.0], [4.0, 2.0])];
        let cells = [vec![rectangle([0.0, 0.0], [1.0, 2.0])], vec![rectangle([1.0, 0.0], [3.0, 2.0])]];
        assert_eq!(tile(&cells, &region), Ok(()));
        let with = |cell: Vec<Ring>| tile(&[cells[0].clone(), cell], &region).expect_err("no tiling");
        assert!(with(vec![]).contains("the area"));
        assert!(with(vec![cells[1][0].iter().rev().copied().collect()]).contains("sign -1"));
        assert!(
            with(vec![vec![[1.0, 0.0], [4.0, 0.0], [1.0, 0.5], [4.0, 2.0], [1.0, 1.0], [3.5, 0.0]]])
                .contains("there are the sides")
        );
        assert!(with(vec![rectangle([1.0, 0.0], [2.0, 2.0])]).contains("alone"));
        assert!(with(cells[0].clone()).contains("two cells have the side"));
        // A corner on the side of the other cell.
        let mut split = cells[1].clone();
        split[0].push([1.0, 1.0]);
        assert!(with(split).contains("alone"));
        // Beside a side along an axis nothing is rounded.
        let mut off = cells[1].clone();
        off[0][1][0] = 4.0_f64.next_down();
        assert!(with(off).contains("alone"));
    }

    #[test]
    fn corners_on_slanted_sides_are_rounded() {
        let region = [vec![[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]]];
        let cells = |y: f64| {
            let at = [2.0, y];
            [vec![vec![[0.0, 0.0], at, [0.0, 3.0]]], vec![vec![[0.0, 0.0], [4.0, 0.0], at]]]
        };
        assert_eq!(tile(&cells(1.5), &region), Ok(()));
        assert_eq!(tile(&cells(1.5_f64.next_up().next_up()), &region), Ok(()));
        assert!(tile(&cells(1.5 + 1e-14), &region).is_err());
    }
}
