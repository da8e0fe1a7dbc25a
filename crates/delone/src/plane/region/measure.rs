//! Areas and centers of mass of rings of corners.
//!
//! Cost: O(k) for k corners.

/// A power of two that takes every coordinate to where products of two neither overflow nor, if it matters, vanish.
const DOWN: f64 = f64::from_bits((1023 - 600) << 52);
const UP: f64 = f64::from_bits((1023 + 600) << 52);

/// The area inside of rings, positive if they are counter-clockwise. Beyond the range of `f64` it is infinite,
/// and never NaN.
pub(in crate::plane) fn area<R: Iterator<Item = [f64; 2]> + Clone>(
    rings: impl Iterator<Item = R> + Clone,
) -> f64 {
    // Not `sum`, which is -0.0 of nothing.
    let add = |sum: f64, area: f64| sum + area;
    let twice = |scale: f64| rings.clone().map(|ring| twice_area(from_least(ring), scale)).fold(0.0, add);
    let plain = twice(1.0) / 2.0;
    // An overflow on the way is infinite or NaN at the end.
    if plain.is_finite() { plain } else { twice(DOWN) * UP * (UP / 2.0) }
}

/// The corners of a ring from the lexicographically least on, so that sums have the same bits wherever a ring begins.
fn from_least<R: Iterator<Item = [f64; 2]> + Clone>(ring: R) -> impl Iterator<Item = [f64; 2]> + Clone {
    let mut least = (0, [f64::INFINITY; 2]);
    for (k, p) in ring.clone().enumerate() {
        if p < least.1 {
            least = (k, p);
        }
    }
    ring.clone().skip(least.0).chain(ring.take(least.0))
}

/// Twice the area, in units of scaled coordinates. Taken from the first corner, so that far from the origin nothing is
/// lost.
fn twice_area(mut ring: impl Iterator<Item = [f64; 2]>, scale: f64) -> f64 {
    let Some([x, y]) = ring.next().map(|p| p.map(|x| x * scale)) else { return 0.0 };
    let mut last = [0.0, 0.0];
    let mut sum = 0.0;
    for p in ring {
        let p = [p[0] * scale - x, p[1] * scale - y];
        sum += last[0] * p[1] - last[1] * p[0];
        last = p;
    }
    sum
}

/// The center of mass. `None` if there is no area.
pub(in crate::plane) fn centroid<R: Iterator<Item = [f64; 2]> + Clone>(
    rings: impl Iterator<Item = R> + Clone,
) -> Option<[f64; 2]> {
    let rings = rings.map(from_least);
    let corners = || rings.clone().flatten();
    let [x, y] = corners().next()?;
    let moments = |[along, up]: [f64; 2]| {
        let (mut area, mut sum) = (0.0, [0.0, 0.0]);
        for ring in rings.clone() {
            let (mut first, mut last) = (None, [0.0; 2]);
            let mut add = |p: [f64; 2], q: [f64; 2]| {
                let cross = p[0] * q[1] - p[1] * q[0];
                area += cross;
                sum = [sum[0] + cross * (p[0] + q[0]), sum[1] + cross * (p[1] + q[1])];
            };
            for p in ring {
                let p = [p[0] * along - x * along, p[1] * up - y * up];
                match first {
                    None => first = Some(p),
                    Some(_) => add(last, p),
                }
                last = p;
            }
            if let Some(first) = first {
                add(last, first);
            }
        }
        (area, sum)
    };
    // Products of three may leave the range of f64: in units of about the extent they do not.
    let scale = [0, 1].map(|axis| {
        let extent = corners().fold(0.0_f64, |max, p| max.max((p[axis] - [x, y][axis]).abs()));
        let exponent = ((extent.to_bits() >> 52) as i32 - 1023).clamp(-1000, 1000);
        f64::from_bits(((1023 - exponent) as u64) << 52)
    });
    let (area, sum) = moments(scale);
    if area.is_nan() || area <= 0.0 {
        return None;
    }
    // A sliver has an area of roundings: its center is among its corners all the same.
    let centroid = [x + sum[0] / (3.0 * area) / scale[0], y + sum[1] / (3.0 * area) / scale[1]];
    let [low, high] = corners().fold([[x, y]; 2], |[low, high], p| {
        [[low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])]]
    });
    Some([0, 1].map(|axis| centroid[axis].clamp(low[axis], high[axis])))
}

/// The integral of the squared distance from a point. Infinite or NaN beyond the range of `f64`.
pub(in crate::plane) fn second_moment<R: Iterator<Item = [f64; 2]>>(
    rings: impl Iterator<Item = R>,
    about: [f64; 2],
) -> f64 {
    let mut sum = 0.0;
    for mut ring in rings {
        let from = |p: [f64; 2]| [p[0] - about[0], p[1] - about[1]];
        let Some(first) = ring.next().map(from) else { continue };
        let mut add = |p: [f64; 2], q: [f64; 2]| {
            let square = |k: usize| p[k] * p[k] + p[k] * q[k] + q[k] * q[k];
            sum += (p[0] * q[1] - p[1] * q[0]) * (square(0) + square(1));
        };
        let mut last = first;
        for p in ring.map(from) {
            add(last, p);
            last = p;
        }
        add(last, first);
    }
    sum / 12.0
}

#[cfg(test)]
mod tests {
    use super::centroid;

    /// Of a triangle the mean of its corners, whatever the units of the two axes and whichever corner is first.
    #[test]
    fn centers_do_not_depend_on_the_units() {
        let corners = [[0.0, 0.0], [3.0, 0.0], [-1.5, 6.0]];
        for (i, j) in [-1000, -600, -300, 0, 300, 600, 1000]
            .into_iter()
            .flat_map(|i| [-1000, -500, -100, 0, 200, 700, 1000].map(|j| (i, j)))
        {
            let unit = [2f64.powi(i), 2f64.powi(j)];
            for (first, at) in (0..9).map(|k| (k % 3, [[0.0, 0.0], [-3.0, 0.0], [1.0, -5.0]][k / 3])) {
                let mut moved = corners.map(|p| [0, 1].map(|k| (p[k] + at[k]) * unit[k]));
                moved.rotate_left(first);
                let found = centroid(std::iter::once(moved.iter().copied())).expect("an area");
                for k in [0, 1] {
                    let error = found[k] / unit[k] - ([0.5, 2.0][k] + at[k]);
                    assert!(error.abs() < 1e-14, "2^{i} 2^{j} {first} {at:?}: {found:?}");
                }
            }
        }
    }

    #[test]
    fn what_has_no_area_has_no_center() {
        let flat: [&[[f64; 2]]; 5] = [
            &[],
            &[[1.0, 2.0]],
            &[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]],
            &[[1.0, 0.0], [1.0, 1e300], [1.0, -1e300]],
            &[[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]], // clockwise
        ];
        for ring in flat {
            assert_eq!(centroid(std::iter::once(ring.iter().copied())), None, "{ring:?}");
        }
    }
}
