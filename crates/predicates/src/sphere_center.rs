//! The center of the sphere through four points: floating point with a correction, balls, exact. A construction, so it is rounded, and
//! correctly; nothing is decided by it.
//!
//! Seen from one corner, with sides u, v, w, the center is at (|u|^2 v x w + |v|^2 w x u + |w|^2 u x v) / (2 u . v x w).

mod corrected;

use crate::ball::{Ball, Number};
use crate::exact::big;
use crate::exact::power::{self, Rows};
use crate::line::middle;
use crate::orthosphere::fraction::{length, normal};
use crate::{Point3, Sign, Site};

/// The center of the sphere through four points that are not in a plane. In coordinate units, correctly rounded: each coordinate is
/// the nearest `f64` of the exact one, so the same bits for every order of the points, and for five points on one sphere whichever
/// four are asked.
///
/// `None` if it is too far away for an `f64`, and for points in a plane. O(1): some 150 nanoseconds, and ten microseconds for a center
/// half way between two numbers or of corners that are flat but for rounding.
///
/// ```
/// use delone_predicates::circumcenter3;
/// let [a, b, c] = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
/// assert_eq!(circumcenter3([0.0; 3], a, b, c), Some([1.0; 3]));
/// assert_eq!(circumcenter3([0.0; 3], a, b, [1.0, 1.0, 0.0]), None);
/// ```
pub fn circumcenter3(a: Point3, b: Point3, c: Point3, d: Point3) -> Option<Point3> {
    let corners = [a, b, c, d];
    let found = by_correction(&corners.map(|p| (p, 0.0))).or_else(|| in_balls(corners));
    found.or_else(|| exactly(corners)).filter(|center| center.iter().all(|x| x.is_finite()))
}

/// The point that has the same power to four sites whose points are not in a plane: the Voronoi vertex of power diagrams of space. In
/// coordinate units, correctly rounded, so the same bits for every order of the sites.
///
/// `None` if it is too far away for an `f64`, and for points in a plane. O(1), as [`circumcenter3`].
///
/// ```
/// use delone_predicates::power_center3;
/// let [a, b, c, d] = [[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]].map(|p| (p, 0.0));
/// assert_eq!(power_center3(a, b, c, d), Some([1.0; 3]));
/// assert_eq!(power_center3(a, (b.0, 2.0), c, d), Some([0.5, 1.0, 1.0])); // further from the heavy one
/// ```
pub fn power_center3(a: Site<3>, b: Site<3>, c: Site<3>, d: Site<3>) -> Option<Point3> {
    let sites = [a, b, c, d];
    if sites.iter().all(|site| site.1 == a.1) {
        return circumcenter3(a.0, b.0, c.0, d.0);
    }
    by_correction(&sites)
        .or_else(|| exactly_by_powers(sites))
        .filter(|center| center.iter().all(|x| x.is_finite()))
}

/// A numerator for each axis, and the denominator.
fn fraction<T: Number>(sides: [[T; 3]; 3]) -> ([T; 3], T) {
    let lengths = sides.each_ref().map(|side| length(side));
    lifted_fraction(sides, lengths)
}

/// Numerators and denominator where corners have other lifts than the squares of their sides.
fn lifted_fraction<T: Number>([u, v, w]: [[T; 3]; 3], [uu, vv, ww]: [T; 3]) -> ([T; 3], T) {
    let (vw, wu, uv) = (normal(&v, &w), normal(&w, &u), normal(&u, &v));
    let offset = |axis: usize| uu.times(&vw[axis]).plus(&vv.times(&wu[axis])).plus(&ww.times(&uv[axis]));
    let volume = u[0].times(&vw[0]).plus(&u[1].times(&vw[1])).plus(&u[2].times(&vw[2]));
    ([0, 1, 2].map(offset), volume.plus(&volume))
}

#[inline]
fn by_correction(sites: &[Site<3>; 4]) -> Option<Point3> {
    let [x, y, z] = corrected::center(sites)?;
    let corners = sites.map(|site| site.0);
    let or_known = |axis: usize, found: Option<f64>| {
        found.or_else(|| known(corners, axis).filter(|_| sites.iter().all(|site| site.1 == sites[0].1)))
    };
    Some([or_known(0, x)?, or_known(1, y)?, or_known(2, z)?])
}

#[inline(never)]
fn in_balls(corners: [Point3; 4]) -> Option<Point3> {
    let [a, ..] = corners;
    let side = |i: usize| [0, 1, 2].map(|axis| Ball::difference(corners[i][axis], a[axis]));
    let (offset, volume) = fraction([side(1), side(2), side(3)]);
    // A quotient is by a number that is not negative.
    let is_negative = volume.high < 0.0;
    let less = |x: Ball<f64>| if is_negative { Ball::exactly(0.0).minus(&x) } else { x };
    let volume = less(volume);
    if volume.bounds()[0] <= 0.0 {
        return None;
    }
    let mut center = [0.0; 3];
    for axis in 0..3 {
        let sum = || Ball::exactly(a[axis]).plus(&less(offset[axis]).over(&volume)).nearest();
        center[axis] = sum().or_else(|| known(corners, axis))?;
    }
    Some(center)
}

/// Between corners that differ along an axis alone the center is above their middle, which is often half way between two numbers.
fn known(corners: [Point3; 4], axis: usize) -> Option<f64> {
    let pairs = (0..4).flat_map(|i| (0..i).map(move |j| (corners[i], corners[j])));
    let along = |p: Point3, q: Point3| (0..3).all(|k| (p[k] == q[k]) == (k != axis));
    pairs.into_iter().find(|(p, q)| along(*p, *q)).and_then(|(p, q)| middle(p[axis], q[axis]))
}

#[cold]
#[inline(never)]
fn exactly(corners: [Point3; 4]) -> Option<Point3> {
    let (p, scale) = big::integers(corners.as_flattened());
    let side = |i: usize| [0, 1, 2].map(|axis| &p[3 * i + axis] - &p[axis]);
    let (offset, volume) = fraction([side(1), side(2), side(3)]);
    (volume.sign() != Sign::Zero)
        .then(|| [0, 1, 2].map(|axis| big::quotient(&(&p[axis] * &volume + &offset[axis]), &volume, scale)))
}

#[cold]
#[inline(never)]
fn exactly_by_powers(sites: [Site<3>; 4]) -> Option<Point3> {
    let (Rows { differences, lifts, scale, .. }, last) = power::big_rows_and_last(&sites);
    let side = |i: usize| [0, 1, 2].map(|axis| differences[i][axis].clone());
    let lifts = [0, 1, 2].map(|i| lifts[i].clone());
    let (offset, volume) = lifted_fraction([side(0), side(1), side(2)], lifts);
    (volume.sign() != Sign::Zero).then(|| {
        [0, 1, 2].map(|axis| big::quotient(&(&last[axis] * &volume + &offset[axis]), &volume, scale))
    })
}

#[cfg(test)]
mod tests {
    use super::{by_correction, circumcenter3, exactly, exactly_by_powers, in_balls};
    use delone_generators::{Kind3, Random};
    use delone_oracle::share;

    #[test]
    fn every_way_gives_the_exact_center_rounded() {
        let (mut all, mut by_balls, mut corrected) = (0, 0, 0);
        for &kind in Kind3::ALL {
            for p in kind.points(share(4000), 1).chunks_exact(4) {
                let exact = exactly([p[0], p[1], p[2], p[3]]).filter(|c| c.iter().all(|x| x.is_finite()));
                let found = circumcenter3(p[0], p[1], p[2], p[3]);
                assert_eq!(found, exact, "{kind:?} {p:?}");
                let other = circumcenter3(p[2], p[0], p[3], p[1]);
                assert_eq!(other.map(|c| c.map(f64::to_bits)), found.map(|c| c.map(f64::to_bits)));
                if let Some(found) = in_balls([p[0], p[1], p[2], p[3]]) {
                    assert_eq!(Some(found), exact, "{kind:?} {p:?}");
                    by_balls += 1;
                }
                if let Some(found) = by_correction(&[p[0], p[1], p[2], p[3]].map(|p| (p, 0.0))) {
                    assert_eq!(Some(found), exact, "{kind:?} {p:?}");
                    corrected += 1;
                }
                let weighted = [0, 1, 2, 3].map(|i| (p[i], 0.25 * (p[i][0] - p[0][1])));
                if let Some(found) = by_correction(&weighted) {
                    assert_eq!(Some(found), exactly_by_powers(weighted), "{kind:?} {p:?}");
                }
                all += 1;
            }
        }
        assert!(2 * by_balls > all && 2 * corrected > all, "{by_balls} and {corrected} of {all}");
    }

    /// The nearest point to the exact center, by its distances from the corners in integers: no step along an axis makes them more equal.
    #[test]
    fn centers_are_where_distances_are_equal() {
        let mut random = Random::new(3);
        for _ in 0..share(4000) {
            // The center is a point, in small integers: every corner is at one distance.
            let center = [(); 3].map(|()| random.below(64) as f64 * 0.5);
            let offsets =
                [[1.0, 4.0, 8.0], [-4.0, 4.0, 7.0], [8.0, -1.0, -4.0], [4.0, 8.0, 1.0], [0.0, 0.0, 9.0]];
            let k = random.below(5);
            let p = [0, 1, 2, 3].map(|i| {
                let offset = offsets[(i + k) % 5];
                [0, 1, 2].map(|axis| center[axis] + offset[axis])
            });
            let found = circumcenter3(p[0], p[1], p[2], p[3]);
            assert!(found == Some(center) || found.is_none(), "{p:?} {found:?}");
        }
    }

    /// A coordinate 150 orders of magnitude below the others.
    #[test]
    fn flat_boxes_keep_every_coordinate() {
        let at =
            |x: f64, y: f64, z: f64| [x * 1.916_151_690_796_238_2e-28, y * 1.142_448_899_994_924e-178, z];
        let p = [
            at(3.0, -3.0, -1.5),
            at(2.0, -3.0, -3.0),
            at(1.0, -1.0, 1.5),
            at(3.0, 1.0, -1.5),
            at(-1.0, -2.0, -4.5),
        ];
        for order in 0..120 {
            let [a, b, c, d] = [order % 5, order / 5 % 5, (order + 1) % 5, (order + 3) % 5].map(|i| p[i]);
            let exact = exactly([a, b, c, d]).filter(|center| center.iter().all(|x| x.is_finite()));
            assert_eq!(circumcenter3(a, b, c, d), exact, "{order}");
        }
    }

    #[test]
    fn boxes_have_one_center() {
        // Of a box at a tenth each four corners that are not in a plane have the same.
        let at = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 0 { 0.1 } else { 0.3 });
        let mut centers = Vec::new();
        for i in 0..8 {
            for j in 0..i {
                for k in 0..j {
                    for l in 0..k {
                        centers.extend(circumcenter3(at(i), at(j), at(k), at(l)));
                    }
                }
            }
        }
        assert_eq!(centers.len(), 58);
        assert!(centers.iter().all(|center| *center == centers[0]));
    }
}
