//! Areas and centres of mass of rings of corners.
//!
//! Cost: O(k) for k corners.

/// A power of two that takes every coordinate to where products of two neither overflow nor, if it matters, vanish.
const DOWN: f64 = f64::from_bits((1023 - 600) << 52);
const UP: f64 = f64::from_bits((1023 + 600) << 52);

/// The area inside of rings, positive if they are counter-clockwise. Beyond the range of `f64` it is infinite,
/// and never NaN.
pub(super) fn area<R: Iterator<Item = [f64; 2]>>(rings: impl Iterator<Item = R> + Clone) -> f64 {
    let twice = |scale: f64| rings.clone().map(|ring| twice_area(ring, scale)).sum::<f64>();
    let plain = twice(1.0) / 2.0;
    // An overflow on the way is infinite or NaN at the end.
    if plain.is_finite() { plain } else { twice(DOWN) * UP * (UP / 2.0) }
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

/// The centre of mass. `None` if there is no area.
pub(super) fn centroid<R: Iterator<Item = [f64; 2]>>(
    rings: impl Iterator<Item = R> + Clone,
) -> Option<[f64; 2]> {
    let corners = || rings.clone().flatten();
    let [x, y] = corners().next()?;
    let moments = |scale: f64| {
        let (mut area, mut sum) = (0.0, [0.0, 0.0]);
        for ring in rings.clone() {
            let (mut first, mut last) = (None, [0.0; 2]);
            let mut add = |p: [f64; 2], q: [f64; 2]| {
                let cross = p[0] * q[1] - p[1] * q[0];
                area += cross;
                sum = [sum[0] + cross * (p[0] + q[0]), sum[1] + cross * (p[1] + q[1])];
            };
            for p in ring {
                let p = [p[0] * scale - x * scale, p[1] * scale - y * scale];
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
    let (mut scale, (mut area, mut sum)) = (1.0, moments(1.0));
    if !(1e-100..1e100).contains(&area) {
        // Products of three may leave the range of f64: in units of about the extent they do not.
        let extent = corners()
            .fold(0.0_f64, |max, p| max.max((p[0] / 2.0 - x / 2.0).abs()).max((p[1] / 2.0 - y / 2.0).abs()));
        let exponent = ((extent.to_bits() >> 52) as i32 - 1023).clamp(-1000, 1000);
        scale = f64::from_bits(((1023 - exponent) as u64) << 52);
        (area, sum) = moments(scale);
    }
    if area.is_nan() || area <= 0.0 {
        return None;
    }
    // A sliver has an area of roundings: its centre is among its corners all the same.
    let centroid = [x + sum[0] / (3.0 * area) / scale, y + sum[1] / (3.0 * area) / scale];
    let [low, high] = corners().fold([[x, y]; 2], |[low, high], p| {
        [[low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])]]
    });
    Some([0, 1].map(|axis| centroid[axis].clamp(low[axis], high[axis])))
}
