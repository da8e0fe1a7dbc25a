//! Holes find the polygons that they are in, in formats whose rings are one after another.
//!
//! Decisions are exact. Cost: a hole is looked for in the outer rings whose box it is in.

use delone_predicates::{Sign, orient2d};

/// A ring without the position at its end, with its box.
pub(super) struct Ring {
    points: Vec<[f64; 2]>,
    low: [f64; 2],
    high: [f64; 2],
}

/// The rings of each polygon, the outer one first: a hole is of the innermost ring around it. Those around which there is none are polygons.
pub(super) fn polygons(rings: &[Ring], is_hole: impl Fn(usize) -> bool) -> Vec<Vec<usize>> {
    let (outer, holes): (Vec<usize>, Vec<usize>) = (0..rings.len()).partition(|&i| !is_hole(i));
    let mut polygons: Vec<Vec<usize>> = outer.into_iter().map(|ring| vec![ring]).collect();
    let count = polygons.len();
    for hole in holes {
        let around = (0..count).filter(|&i| rings[polygons[i][0]].is_around(&rings[hole]));
        // Of several, one in the others is the innermost.
        let innermost = around.reduce(|known, next| {
            let [a, b] = [known, next].map(|i| &rings[polygons[i][0]]);
            if a.is_around(b) { next } else { known }
        });
        match innermost {
            Some(polygon) => polygons[polygon].push(hole),
            None => polygons.push(vec![hole]),
        }
    }
    polygons
}

impl Ring {
    pub(super) fn of(mut points: Vec<[f64; 2]>) -> Self {
        if points.first() == points.last() {
            points.pop();
        }
        points.dedup();
        let bound = |choose: fn(f64, f64) -> f64, start| {
            points.iter().fold([start; 2], |known, p| [0, 1].map(|k| choose(known[k], p[k])))
        };
        let (low, high) = (bound(f64::min, f64::INFINITY), bound(f64::max, f64::NEG_INFINITY));
        Self { points, low, high }
    }

    /// Whether it is counter-clockwise, by its least corner.
    pub(super) fn is_counter_clockwise(&self) -> bool {
        let n = self.points.len();
        if !self.points.as_flattened().iter().all(|x| x.is_finite()) {
            return false;
        }
        let least = (0..n).min_by(|&i, &j| self.points[i].partial_cmp(&self.points[j]).unwrap_or(i.cmp(&j)));
        let turn =
            |i: usize| orient2d(self.points[(i + n - 1) % n], self.points[i], self.points[(i + 1) % n]);
        least.is_some_and(|i| turn(i) == Sign::Positive)
    }

    /// Whether another ring is inside: by the first of its corners that is not on this one.
    fn is_around(&self, other: &Self) -> bool {
        let fits = (0..2).all(|k| self.low[k] <= other.low[k] && other.high[k] <= self.high[k]);
        fits && other.points.iter().find_map(|&p| self.contains(p)).unwrap_or(false)
    }

    /// Whether a point is inside; nothing if it is on the ring. Sides that cross the line to the right of it are counted.
    fn contains(&self, p: [f64; 2]) -> Option<bool> {
        let mut is_inside = false;
        let n = self.points.len();
        for i in 0..n {
            let [a, b] = [self.points[i], self.points[(i + 1) % n]];
            let (low, high) = if a[1] <= b[1] { (a, b) } else { (b, a) };
            if p[1] < low[1] || p[1] > high[1] {
                continue;
            }
            let side = orient2d(low, high, p);
            let is_between = p[0] >= a[0].min(b[0]) && p[0] <= a[0].max(b[0]);
            if side == Sign::Zero && is_between {
                return None;
            }
            // A side has its lower end and not its upper one.
            is_inside ^= side == Sign::Positive && p[1] < high[1];
        }
        Some(is_inside)
    }
}

#[cfg(test)]
mod tests {
    use super::{Ring, polygons};

    /// Rings of corners, of which those that are counter-clockwise are holes.
    fn grouped(rings: &[&[[f64; 2]]]) -> Vec<Vec<usize>> {
        let rings: Vec<Ring> = rings.iter().map(|ring| Ring::of(ring.to_vec())).collect();
        polygons(&rings, |i| rings[i].is_counter_clockwise())
    }

    fn square(x: f64, side: f64) -> [[f64; 2]; 4] {
        [[x, x], [x, x + side], [x + side, x + side], [x + side, x]]
    }

    fn hole(x: f64, side: f64) -> [[f64; 2]; 4] {
        let [a, b, c, d] = square(x, side);
        [a, d, c, b]
    }

    #[test]
    fn holes_find_their_rings() {
        let far = square(100.0, 5.0);
        let (outer, lake, island, pond) =
            (square(0.0, 50.0), hole(1.0, 40.0), square(2.0, 30.0), hole(3.0, 9.0));
        assert_eq!(grouped(&[&outer, &lake, &island, &pond, &far]), [vec![0, 1], vec![2, 3], vec![4]]);
        assert_eq!(grouped(&[&pond, &island, &far, &lake, &outer]), [vec![1, 0], vec![2], vec![4, 3]]);
        // Corners of a hole may be on the ring around it.
        assert_eq!(grouped(&[&far, &outer, &hole(0.0, 9.0)]), [vec![0], vec![1, 2]]);
        // Rings that all go one way are polygons each, those without an area and those of no number too.
        assert_eq!(grouped(&[&hole(0.0, 9.0), &hole(50.0, 9.0)]), [vec![0], vec![1]]);
        assert_eq!(
            grouped(&[&[[0.0, 0.0], [1.0, 1.0]], &[], &[[f64::NAN, 0.0]]]),
            [vec![0], vec![1], vec![2]]
        );
    }
}
