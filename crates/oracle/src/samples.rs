//! Small hostile inputs for the tests of this crate, which has no other to take them from.

use crate::exact::{Point2, orient2d};

/// Random numbers that need not be good ones.
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    /// A number below n.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % n
    }
}

/// Up to 16 points of a small lattice, and segments between them that do not cross.
pub(crate) fn on_lattice(side: usize, numbers: &mut Numbers) -> (Vec<Point2>, Vec<[usize; 2]>) {
    let count = 3 + numbers.below(14);
    let points: Vec<Point2> =
        (0..count).map(|_| [numbers.below(side) as f64, numbers.below(side) as f64]).collect();
    let mut segments: Vec<[usize; 2]> = Vec::new();
    for _ in 0..numbers.below(12) {
        let new = [numbers.below(count), numbers.below(count)];
        let [a, b] = new.map(|i| points[i]);
        let meets = |&[c, d]: &[usize; 2]| {
            let (c, d) = (points[c], points[d]);
            orient2d(a, b, c) * orient2d(a, b, d) < 0 && orient2d(c, d, a) * orient2d(c, d, b) < 0
        };
        if !segments.iter().any(meets) {
            segments.push(new);
        }
    }
    (points, segments)
}
