//! Point sets that have made trouble for somebody: lattices, ties, tiny beside huge.

use std::f64::consts::TAU;

use delone_generators::Random;

/// How much work exact arithmetic has with a set.
const EXTREME: usize = 2;

/// The least positive number.
const TINIEST: f64 = 5e-324;

/// One of a few.
pub(crate) fn pick<T: Copy>(random: &mut Random, from: &[T]) -> T {
    from[random.below(from.len())]
}

/// Whether something happens that does once in n times.
pub(crate) fn once_in(random: &mut Random, n: usize) -> bool {
    random.below(n) == 0
}

fn signed(random: &mut Random, x: f64) -> f64 {
    if once_in(random, 2) { -x } else { x }
}

/// An integer from -range to range.
pub(crate) fn integer(random: &mut Random, range: usize) -> f64 {
    random.below(2 * range + 1) as f64 - range as f64
}

/// A power of two, in `f64`'s range.
pub(crate) fn power(random: &mut Random, low: i32, high: i32) -> f64 {
    2_f64.powi(low + random.below((high - low + 1) as usize) as i32)
}

/// Any finite number.
pub(crate) fn any_bits(random: &mut Random) -> f64 {
    loop {
        let x = f64::from_bits(random.bits());
        if x.is_finite() {
            return x;
        }
    }
}

/// A number moved by a few units in the last place.
pub(crate) fn nudged(random: &mut Random, x: f64) -> f64 {
    let mut x = x;
    for _ in 0..random.below(3) {
        x = if once_in(random, 2) { x.next_up() } else { x.next_down() };
    }
    if x.is_finite() { x } else { 0.0 }
}

/// A family of points of which each is made alone; its parameters are fixed when it is made.
type Family<const D: usize> = Box<dyn FnMut(&mut Random) -> [f64; D]>;

/// A random family; those that exact arithmetic is slow with are the first [`EXTREME`].
fn family<const D: usize>(random: &mut Random, which: usize) -> Family<D> {
    let range = 1 + random.below(6);
    let step = power(random, -3, 3);
    match which {
        // Huge beside tiny.
        0 => Box::new(|r| {
            [(); D].map(|()| {
                let size = pick(r, &[1e-300, 1e300, 1e150, 1e-150, 1.0, 0.0, 1e308, 1e-308]);
                let factor = pick(r, &[1.0, 1.0, 1.5, 0.7]);
                signed(r, size * factor)
            })
        }),
        // Powers of two over the whole range.
        1 => Box::new(|r| {
            [(); D].map(|()| {
                let x = power(r, -1074, 1023);
                signed(r, x)
            })
        }),
        // An integer lattice with the least numbers mixed in.
        2 => {
            let scale = pick(random, &[1.0, 2.0, 4.0, 1024.0, 1e100]);
            let (range, rare) = (1 + random.below(3), 3 + random.below(20));
            Box::new(move |r| {
                [(); D].map(|()| {
                    if once_in(r, rare) {
                        let tiny = pick(r, &[TINIEST, TINIEST, 1e-320, 1e-310, 2.3e-308, 1e-200]);
                        signed(r, tiny)
                    } else {
                        integer(r, range) * scale
                    }
                })
            })
        }
        // A lattice, at any scale where nothing is lost.
        3 => {
            let scale = if once_in(random, 2) { 1.0 } else { power(random, -300, 300) };
            Box::new(move |r| [(); D].map(|()| integer(r, range) * scale))
        }
        4 => Box::new(move |r| [(); D].map(|()| integer(r, 3 * range) * 0.1)),
        // Rounded sums of tenths, far from the origin.
        5 => {
            let far = pick(random, &[1e3, 1e6, 1e9, 1e15]);
            Box::new(move |r| [(); D].map(|()| far + integer(r, range) * 0.1))
        }
        6 => Box::new(move |r| [(); D].map(|()| integer(r, range * range * range) * TINIEST)),
        7 => Box::new(move |r| {
            [(); D].map(|()| {
                let x = power(r, -12, 12) * step;
                signed(r, x)
            })
        }),
        _ => shaped(random, which, range, step),
    }
}

/// The families with a shape.
fn shaped<const D: usize>(random: &mut Random, which: usize, range: usize, step: f64) -> Family<D> {
    match which {
        // Regular polygons; in space on parallel circles.
        8 => {
            let (corners, turn) = (3 + random.below(12), random.unit());
            Box::new(move |r| {
                let angle = (r.below(corners) as f64 + turn) * TAU / corners as f64;
                let height = integer(r, 1);
                let mut p = [height; D];
                (p[0], p[1]) = (angle.cos() * step, angle.sin() * step);
                p
            })
        }
        // Lattice points at one distance: permutations with signs.
        9 => {
            let mut numbers =
                [integer(random, 3 * range), integer(random, 3 * range), integer(random, range)];
            let center = integer(random, range);
            Box::new(move |r| {
                r.shuffle(&mut numbers);
                let mut p = [center; D];
                for (x, y) in p.iter_mut().zip(numbers) {
                    let y = signed(r, y);
                    *x += y * step;
                }
                if once_in(r, 12) { [center; D] } else { p }
            })
        }
        // On a line, exactly or nearly.
        10 => {
            let (start, along) = ([(); D].map(|()| integer(random, 4)), [(); D].map(|()| integer(random, 3)));
            let factor = pick(random, &[1.0, 1.0, 0.1, 1.0 / 3.0]);
            Box::new(move |r| {
                let t = integer(r, 8) * factor;
                std::array::from_fn(|k| start[k] + t * along[k])
            })
        }
        // On a plane or a line of it, exactly or nearly.
        11 => {
            let [u, v] = [(); 2].map(|()| [(); D].map(|()| integer(random, 2)));
            let factor = pick(random, &[1.0, 1.0, 0.1]);
            Box::new(move |r| {
                let (s, t) = (integer(r, 3) * factor, integer(r, 3) * factor);
                std::array::from_fn(|k| s * u[k] + t * v[k])
            })
        }
        // Integers that just fit.
        12 => Box::new(|r| {
            [(); D].map(|()| {
                if once_in(r, 2) { 9_007_199_254_740_992.0 - r.below(4) as f64 } else { integer(r, 3) }
            })
        }),
        13 => Box::new(move |r| {
            let p = [(); D].map(|()| integer(r, range) * step);
            p.map(|x| nudged(r, x))
        }),
        // On the unit sphere, rounded.
        14 => Box::new(move |r| {
            let v = [(); D].map(|()| r.normal());
            let size = v.iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-9);
            v.map(|x| x / size * step)
        }),
        // Two clusters far from each other.
        15 => {
            let far = power(random, 10, 60);
            Box::new(move |r| {
                let from = if once_in(r, 2) { far } else { 0.0 };
                [(); D].map(|()| from + integer(r, 2))
            })
        }
        _ => Box::new(|r| [(); D].map(|()| r.unit())),
    }
}

const FAMILIES: usize = 17;

/// The family that static filters on lattices have most to fear from.
const TINY_BESIDE_LATTICE: usize = 2;

/// A small set for the oracle: up to `most` points, fewer where arithmetic is slow.
pub(crate) fn points<const D: usize>(random: &mut Random, most: usize) -> Vec<[f64; D]> {
    let which = if once_in(random, 6) { TINY_BESIDE_LATTICE } else { random.below(FAMILIES) };
    let slow = if which < EXTREME { most / 3 } else { most };
    // Small sets most of the time: they are quick, and all the shapes are there.
    let most = if once_in(random, 3) { slow } else { slow.min(10) };
    let count = random.below(most + 1);
    let mut first = family::<D>(random, which);
    let mut second = if once_in(random, 4) {
        let other =
            if which < EXTREME { random.below(FAMILIES) } else { EXTREME + random.below(FAMILIES - EXTREME) };
        Some(family::<D>(random, other))
    } else {
        None
    };
    let mut points: Vec<[f64; D]> = Vec::with_capacity(count);
    for i in 0..count {
        let p = match &mut second {
            Some(second) if once_in(random, 3) => second(random),
            _ => first(random),
        };
        points.push(if i > 0 && once_in(random, 15) { points[random.below(i)] } else { p });
    }
    flattened(random, &mut points);
    points
}

/// Up to so many points as they are measured and drawn: lattices of steps that are no binary numbers, rounded decimals, regular polygons, circles, turned
/// lattices, points some units in the last place apart; about the origin or far from it.
pub(crate) fn everyday(random: &mut Random, most: usize) -> Vec<[f64; 2]> {
    let about =
        pick(random, &[[0.0, 0.0], [500_000.0, 4_500_000.0], [100.3, 250.7], [7.4, 46.9], [-0.3, 0.1]]);
    let step = pick(random, &[0.1, 0.3, 1.0 / 3.0, 0.05, 1.0, 1e-6, 2.5]);
    let turn = pick(random, &[0.0, 0.0, 0.3, TAU / 8.0, TAU / 6.0]);
    let turned = |[x, y]: [f64; 2]| [x * turn.cos() - y * turn.sin(), x * turn.sin() + y * turn.cos()];
    let (kind, corners) = (random.below(7), 3 + random.below(30));
    let count = 4 + random.below(most - 3);
    let one = |i: usize, random: &mut Random| match kind {
        0 => turned([step * (i % 6) as f64, step * (i / 6) as f64]),
        1 => turned([integer(random, 4) * step, integer(random, 4) * step]),
        2 => turned([
            step * ((i % 6) as f64 + 0.5 * (i / 6 % 2) as f64),
            step * (i / 6) as f64 * 0.75_f64.sqrt(),
        ]),
        3 => [(); 2].map(|()| (random.between(0.0, 50.0) / step).round() * step),
        // Polygons, each around the same middle.
        4 => {
            let (angle, radius) = (TAU * i as f64 / corners as f64 + turn, step * (1 + i / corners) as f64);
            [radius * angle.cos(), radius * angle.sin()]
        }
        // One circle, anywhere on it.
        5 => {
            let angle = random.between(0.0, TAU);
            [step * angle.cos(), step * angle.sin()]
        }
        _ => [integer(random, 2) * step; 2],
    };
    let mut points: Vec<[f64; 2]> = (0..count).map(|i| one(i, random)).collect();
    for p in &mut points {
        *p = [p[0] + about[0], p[1] + about[1]];
        if kind == 6 || once_in(random, 20) {
            *p = p.map(|x| nudged(random, x));
        }
    }
    points
}

/// Now and then some coordinates are made alike, or zero of either sign.
fn flattened<const D: usize>(random: &mut Random, points: &mut [[f64; D]]) {
    if once_in(random, 10) {
        let axis = random.below(D);
        let value = pick(random, &[0.0, -0.0, 1.0, 0.1, TINIEST]);
        let all = once_in(random, 2);
        for p in points {
            if all || once_in(random, 2) {
                p[axis] = value;
            }
        }
    }
}

/// A point to ask about: one of them, between them, or anything.
pub(crate) fn query<const D: usize>(random: &mut Random, points: &[[f64; D]]) -> [f64; D] {
    let any = |random: &mut Random| {
        let which = random.below(FAMILIES);
        family::<D>(random, which)(random)
    };
    if points.is_empty() {
        return any(random);
    }
    let [p, q] = [(); 2].map(|()| points[random.below(points.len())]);
    match random.below(6) {
        0 => p,
        1 => std::array::from_fn(|k| p[k] / 2.0 + q[k] / 2.0),
        2 => p.map(|x| nudged(random, x)),
        3 => std::array::from_fn(|k| if once_in(random, 2) { p[k] } else { q[k] }),
        4 => {
            let t = integer(random, 4) / 4.0;
            let at: [f64; D] = std::array::from_fn(|k| p[k] + (q[k] - p[k]) * t);
            if at.iter().all(|x| x.is_finite()) { at } else { p }
        }
        _ => any(random),
    }
}

/// Hostile points with equal, hostile, or tying weights.
pub(crate) fn weighted<const D: usize>(random: &mut Random, points: Vec<[f64; D]>) -> Vec<([f64; D], f64)> {
    let kind = random.below(4);
    let largest = points.iter().flatten().fold(0.0, |largest, x| f64::max(largest, x.abs()));
    let weight = |p: [f64; D]| match kind {
        0 => 0.0,
        1 => integer(random, 2),
        2 => p.iter().map(|x| x * x).sum(),
        _ if once_in(random, 3) => any_bits(random),
        _ => (random.unit() - 0.5) * largest * largest,
    };
    let finite = |w: f64| if w.is_finite() { w } else { 0.0 };
    let weights: Vec<f64> = points.iter().copied().map(weight).map(finite).collect();
    points.into_iter().zip(weights).collect()
}

#[cfg(test)]
mod tests {
    use super::{FAMILIES, family, points, query};
    use delone_generators::Random;

    #[test]
    fn all_families_give_finite_points_in_both_dimensions() {
        for which in 0..FAMILIES {
            let mut random = Random::new(which as u64);
            let (mut flat, mut solid) = (family::<2>(&mut random, which), family::<3>(&mut random, which));
            for _ in 0..200 {
                let coordinates = [&flat(&mut random)[..], &solid(&mut random)[..]].concat();
                assert!(coordinates.iter().all(|x| x.is_finite()), "{which}: {coordinates:?}");
            }
        }
    }

    #[test]
    fn sets_have_the_size_asked_for_and_queries_are_finite() {
        let mut random = Random::new(5);
        let mut largest = 0;
        for _ in 0..500 {
            let set = points::<3>(&mut random, 18);
            largest = largest.max(set.len());
            assert!(query(&mut random, &set).iter().all(|x| x.is_finite()));
        }
        assert_eq!(largest, 18);
    }
}
