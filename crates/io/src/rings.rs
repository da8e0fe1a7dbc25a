//! Holes find the polygons that they are in, where rings are one after another.
//!
//! Decisions are exact. Cost: O(log n) for n outer rings, and the corners of those whose box is around the hole.

use std::ops::Range;

use delone_predicates::{Sign, orient2d};

/// A ring without the position at its end, with its box.
pub(crate) struct Ring {
    points: Vec<[f64; 2]>,
    low: [f64; 2],
    high: [f64; 2],
}

/// The rings of each polygon, the outer one first: a hole is of the innermost ring around it. Those around which there is none are polygons.
pub(crate) fn polygons(rings: &[Ring], is_hole: impl Fn(usize) -> bool) -> Vec<Vec<usize>> {
    let (outer, holes): (Vec<usize>, Vec<usize>) = (0..rings.len()).partition(|&i| !is_hole(i));
    let mut polygons: Vec<Vec<usize>> = outer.into_iter().map(|ring| vec![ring]).collect();
    let boxes = Boxes::of(polygons.iter().map(|polygon| &rings[polygon[0]]).collect());
    for hole in holes {
        let mut around = boxes.around(&rings[hole]);
        // In the order of the file, whatever that of the tree.
        around.sort_unstable();
        let around = around.into_iter().filter(|&i| rings[polygons[i][0]].is_around(&rings[hole]));
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
    pub(crate) fn of(mut points: Vec<[f64; 2]>) -> Self {
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
    pub(crate) fn is_counter_clockwise(&self) -> bool {
        let n = self.points.len();
        if !self.points.as_flattened().iter().all(|x| x.is_finite()) {
            return false;
        }
        let least = (0..n).min_by(|&i, &j| self.points[i].partial_cmp(&self.points[j]).unwrap_or(i.cmp(&j)));
        let turn =
            |i: usize| orient2d(self.points[(i + n - 1) % n], self.points[i], self.points[(i + 1) % n]);
        least.is_some_and(|i| turn(i) == Sign::Positive)
    }

    /// Whether its box is around that of another ring.
    fn fits_around(&self, other: &Self) -> bool {
        (0..2).all(|k| self.low[k] <= other.low[k] && other.high[k] <= self.high[k])
    }

    /// Whether another ring is inside: by the first of its corners that is not on this one.
    fn is_around(&self, other: &Self) -> bool {
        self.fits_around(other) && other.points.iter().find_map(|&p| self.contains(p)).unwrap_or(false)
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

/// A tree of the boxes of rings, halved by their middles in turn along x and y.
struct Boxes<'a> {
    rings: Vec<&'a Ring>,
    /// The rings of each half are a half of these.
    order: Vec<usize>,
    /// The box around each part, whose halves are at twice its place plus one and two.
    bounds: Vec<[[f64; 2]; 2]>,
}

impl<'a> Boxes<'a> {
    /// Rings of a part that is not halved: as many boxes as fit into a few cache lines.
    const LEAF_BOXES: usize = 8;

    fn of(rings: Vec<&'a Ring>) -> Self {
        let order = (0..rings.len()).collect();
        let mut tree = Self { bounds: Vec::new(), order, rings };
        tree.halve(0, 0..tree.order.len(), 0);
        tree
    }

    fn halve(&mut self, part: usize, range: Range<usize>, axis: usize) {
        if self.bounds.len() <= part {
            self.bounds.resize(part + 1, [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]]);
        }
        let rings = &self.rings;
        for &i in &self.order[range.clone()] {
            let [low, high] = &mut self.bounds[part];
            *low = [0, 1].map(|k| low[k].min(rings[i].low[k]));
            *high = [0, 1].map(|k| high[k].max(rings[i].high[k]));
        }
        if range.len() > Self::LEAF_BOXES {
            let middle = |i: &usize| rings[*i].low[axis] / 2.0 + rings[*i].high[axis] / 2.0;
            let half = range.len() / 2;
            self.order[range.clone()].select_nth_unstable_by(half, |i, j| middle(i).total_cmp(&middle(j)));
            let cut = range.start + half;
            self.halve(2 * part + 1, range.start..cut, 1 - axis);
            self.halve(2 * part + 2, cut..range.end, 1 - axis);
        }
    }

    /// The rings whose box is around that of another ring.
    fn around(&self, ring: &Ring) -> Vec<usize> {
        let mut found = Vec::new();
        let mut pending = vec![(0, 0..self.order.len())];
        while let Some((part, range)) = pending.pop() {
            let [low, high] = self.bounds[part];
            if ring.points.is_empty() || !(0..2).all(|k| low[k] <= ring.low[k] && ring.high[k] <= high[k]) {
                continue;
            }
            if range.len() <= Self::LEAF_BOXES {
                found.extend(self.order[range].iter().filter(|&&i| self.rings[i].fits_around(ring)));
            } else {
                let cut = range.start + range.len() / 2;
                pending.extend([(2 * part + 1, range.start..cut), (2 * part + 2, cut..range.end)]);
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::{Boxes, Ring, polygons};

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

    /// Squares in squares, in many places: the tree finds the rings that a look at all of them finds.
    #[test]
    fn the_tree_finds_what_a_look_at_all_finds() {
        let squares: Vec<_> =
            (0..400).map(|i| square(f64::from(i * 37 % 90), f64::from(i % 13 + 1))).collect();
        let rings: Vec<Ring> = squares.iter().map(|ring| Ring::of(ring.to_vec())).collect();
        let boxes = Boxes::of(rings.iter().collect());
        for ring in &rings {
            let mut found = boxes.around(ring);
            found.sort_unstable();
            let all: Vec<usize> = (0..rings.len()).filter(|&i| rings[i].fits_around(ring)).collect();
            assert_eq!(found, all);
        }
        assert!(Boxes::of(Vec::new()).around(&rings[0]).is_empty());
        assert!(boxes.around(&Ring::of(Vec::new())).is_empty());
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
