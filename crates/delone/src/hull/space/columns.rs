//! A part of a convex body that is quick to look into: upright columns over a lattice, each between two heights.
//!
//! Where an upright line is inside of the body the facets above and below tell, by exact decisions. A column is in the body where its four
//! edges are: between the highest of their lower ends and the lowest of their upper ones. Which column a point is over is computed with
//! roundings, but neither differences nor products fall as a coordinate grows: there is a least coordinate that is not before a cell, and
//! the lattice has its lines there. So no point inside of a column is outside of the body, nor a corner of it.
//!
//! Cost: O(1) for each facet and each line of the lattice in its box, up to a bound; two reads for a point.

use delone_predicates::{orient2d, orient3d};

use super::shell::Shell;

/// How far ends of lines are moved inwards, in parts of the height of the body: mostly by more than roundings are wrong.
const MARGIN: f64 = 1.0 / 1_099_511_627_776.0;

/// The heights that something is strictly between: none.
const NOWHERE: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

/// Columns inside of a body.
pub(super) struct Columns {
    x: Axis,
    y: Axis,
    /// For each cell, row by row, what heights its column is between.
    ends: Vec<(f64, f64)>,
}

impl Columns {
    /// The columns in a hull, over `cells` cells along each axis; nothing where cells could not be told apart, or where the facets have more
    /// lines in their boxes than may be looked at.
    pub(super) fn inside(hull: &Shell, cells: usize, most_looks: usize) -> Option<Self> {
        let [x, y, z] = hull.limits;
        let (x, y) = (Axis::new(x, cells)?, Axis::new(y, cells)?);
        let lines = Lines { x: x.lines(), y: y.lines(), margin: (z.1 - z.0) * MARGIN };
        let inside = lines.inside(hull, &x, &y, most_looks)?;
        let mut ends = vec![NOWHERE; cells * cells];
        // The first and the last cells have no ends.
        for row in 1..cells - 1 {
            for column in 1..cells - 1 {
                let edges = [row - 1, row].map(|line| &inside[line * (cells - 1) + column - 1..][..2]);
                let all = edges.into_iter().flatten();
                ends[row * cells + column] = all.fold((f64::NEG_INFINITY, f64::INFINITY), |own, edge| {
                    (own.0.max(edge.0), own.1.min(edge.1))
                });
            }
        }
        Some(Self { x, y, ends })
    }

    /// Whether a point is strictly between the ends of a column: in the body, and no corner of it. No promise if not.
    #[inline]
    pub(super) fn hold(&self, [x, y, z]: [f64; 3]) -> bool {
        let (low, high) = self.ends[self.y.cell(y) * self.x.cells + self.x.cell(x)];
        // Both at once: a branch could not be foretold.
        u8::from(low < z) & u8::from(z < high) != 0
    }
}

/// The cells along an axis.
struct Axis {
    low: f64,
    /// Cells for each unit.
    frequency: f64,
    cells: usize,
}

impl Axis {
    fn new((low, high): (f64, f64), cells: usize) -> Option<Self> {
        let frequency = cells as f64 / (high - low);
        frequency.is_normal().then_some(Self { low, frequency, cells })
    }

    /// The cell of a coordinate; never an earlier one for a larger coordinate.
    #[inline]
    fn cell(&self, x: f64) -> usize {
        (((x - self.low) * self.frequency) as usize).min(self.cells - 1)
    }

    /// The least coordinate of each cell but the first.
    fn lines(&self) -> Vec<f64> {
        (1..self.cells).map(|cell| self.start(cell)).collect()
    }

    fn start(&self, cell: usize) -> f64 {
        // Integers in the order of the floats.
        let turned = |bits: i64| bits ^ (bits >> 63 & i64::MAX);
        let [mut before, mut from] = [f64::MIN, f64::MAX].map(|x| turned(x.to_bits() as i64));
        while before + 1 < from {
            let middle = i64::midpoint(before, from);
            if self.cell(f64::from_bits(turned(middle) as u64)) < cell {
                before = middle;
            } else {
                from = middle;
            }
        }
        f64::from_bits(turned(from) as u64)
    }
}

/// The upright lines at the crossings of a lattice.
struct Lines {
    x: Vec<f64>,
    y: Vec<f64>,
    margin: f64,
}

impl Lines {
    /// For each line, row by row, heights between which it is strictly inside of a hull. Long thin facets at a slant have most lines of the
    /// lattice in their boxes, and there may be thousands of them.
    fn inside(&self, hull: &Shell, x: &Axis, y: &Axis, most_looks: usize) -> Option<Vec<(f64, f64)>> {
        let mut ends = vec![NOWHERE; self.x.len() * self.y.len()];
        let mut left = most_looks;
        for facet in hull.facets.iter().filter(|facet| facet.alive) {
            let corners @ [a, b, c] = facet.corners.map(|i| hull.points[i as usize]);
            let flat = corners.map(|p| [p[0], p[1]]);
            let turn = orient2d(flat[0], flat[1], flat[2]);
            if turn.is_zero() {
                continue;
            }
            let is_upper = turn.is_positive();
            let inwards = if is_upper { -self.margin } else { self.margin };
            // Line k is where cell k + 1 begins.
            let range = |axis: &Axis, k: usize| {
                let of = flat.map(|p| axis.cell(p[k]));
                let [first, last] = [of.iter().min(), of.iter().max()].map(|cell| cell.copied().unwrap_or(0));
                first.max(1) - 1..last
            };
            let (rows, columns) = (range(y, 1), range(x, 0));
            left = left.checked_sub(rows.len() * columns.len())?;
            for row in rows {
                for column in columns.clone() {
                    let q = [self.x[column], self.y[row]];
                    let is_beside = |i: usize| {
                        let side = orient2d(flat[i], flat[(i + 1) % 3], q);
                        if is_upper { side.is_negative() } else { side.is_positive() }
                    };
                    if (0..3).any(is_beside) {
                        continue;
                    }
                    let height = height(corners, q, [x.frequency, y.frequency]) + inwards;
                    if height.is_finite() && orient3d(a, b, c, [q[0], q[1], height]).is_negative() {
                        let ends = &mut ends[row * self.x.len() + column];
                        *(if is_upper { &mut ends.1 } else { &mut ends.0 }) = height;
                    }
                }
            }
        }
        Some(ends)
    }
}

/// The height of a triangle over a place, about, given what to multiply differences with so that they are neither large nor small.
fn height(corners: [[f64; 3]; 3], q: [f64; 2], scales: [f64; 2]) -> f64 {
    let from = corners.map(|p| [0, 1].map(|k| (p[k] - q[k]) * scales[k]));
    let [a, b, c] = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| from[i][0] * from[j][1] - from[i][1] * from[j][0]);
    let [at_a, at_b, at_c] = corners.map(|p| p[2]);
    at_a + (b * (at_b - at_a) + c * (at_c - at_a)) / (a + b + c)
}

#[cfg(test)]
mod tests {
    use delone_generators::Random;
    use delone_oracle::exact;

    use super::super::quickhull::Quickhull;
    use super::super::start::Start;
    use super::*;

    /// The extremes of columns, and what is beside them.
    #[test]
    fn columns_are_inside() {
        let mut random = Random::new(4);
        let places: [fn([f64; 3]) -> [f64; 3]; 6] = [
            |p| p,
            |p| p.map(|x| (x * 4.0).round()),
            |p| p.map(|x| 1e9 + x * 1e-6),
            |p| p.map(|x| x * 1e-310),
            |[x, y, z]| [1e300 * x, y, 1e-300 * z],
            |[x, y, z]| [x, y, 0.3 * x + 0.7 * y + 1e-15 * z],
        ];
        for (place, is_plain) in places.into_iter().zip([true, true, false, false, true, false]) {
            let points: Vec<_> = std::iter::repeat_with(|| [0, 1, 2].map(|_| random.between(-1.0, 1.0)))
                .filter(|p| p.iter().map(|x| x * x).sum::<f64>() < 1.0)
                .take(300)
                .map(place)
                .collect();
            let Start::Tetrahedron(corners) = Start::of(&points) else { panic!("they span space") };
            let hull = Quickhull::new(points.clone(), corners).finish();
            let Some(columns) = Columns::inside(&hull, 12, usize::MAX) else {
                assert!(!is_plain);
                continue;
            };
            let (mut held, [xs, ys]) = (0, [&columns.x, &columns.y].map(Axis::lines));
            let beside = |x: f64| [x.next_down(), x, x.next_up()];
            for x in xs.into_iter().flat_map(beside) {
                for &y in &ys {
                    let own = columns.ends[columns.y.cell(y) * 12 + columns.x.cell(x)];
                    for z in [own.0, own.1].into_iter().filter(|z| z.is_finite()).flat_map(beside) {
                        if !columns.hold([x, y, z]) {
                            continue;
                        }
                        held += 1;
                        assert!(!points.contains(&[x, y, z]));
                        for facet in hull.facets.iter().filter(|facet| facet.alive) {
                            let [a, b, c] = facet.corners.map(|i| hull.points[i as usize]);
                            assert!(exact::orient3d(a, b, c, [x, y, z]) <= 0, "{x:e} {y:e} {z:e}");
                        }
                    }
                }
            }
            assert!(held > 100 || !is_plain, "{held}");
        }
    }

    #[test]
    fn slanted_facets_are_too_many_looks() {
        let arc = (-200..200).map(|i| f64::from(i) / 200.0).map(|x| [x, x, 1.0 - x * x]);
        let points: Vec<_> = arc.chain([[1.0, -1.0, 0.0], [-1.0, 1.0, 0.0]]).collect();
        let Start::Tetrahedron(corners) = Start::of(&points) else { panic!("they span space") };
        let hull = Quickhull::new(points, corners).finish();
        assert!(Columns::inside(&hull, 100, 1_000_000).is_none());
        assert!(Columns::inside(&hull, 100, 10_000_000).is_some());
    }

    #[test]
    fn cells_begin_at_their_lines() {
        for ends in [(-1.0, 1.0), (0.1, 0.3), (1e9, 1e9 + 1e-5), (-1e-305, 1e-304), (-3e307, 5e307)] {
            let axis = Axis::new(ends, 50).expect("plain");
            let lines = axis.lines();
            assert_eq!(lines.len(), 49);
            for (x, cell) in lines.into_iter().zip(1..) {
                assert!(axis.cell(x) >= cell && axis.cell(x.next_down()) < cell, "{x:e} {cell}");
            }
        }
    }
}
