//! The small angles of the input: where two segments meet at less than 60 degrees no refinement can do better near the corner.
//!
//! A triangle is excused if its shortest edge joins the two segments of such a corner (Miller, Pav & Walkington, 2003). Steiner
//! points are rounded, so whether one is on a segment is asked with a tolerance: this is a remark, not a verdict.

use super::input::Input;

/// A corner, and where the segments go.
struct Wedge {
    corner: [f64; 2],
    ends: [[f64; 2]; 2],
}

/// All of them, by the cells of a grid that their boxes meet.
pub struct Wedges {
    wedges: Vec<Wedge>,
    side: usize,
    low: [f64; 2],
    cell: f64,
    cells: Vec<Vec<u32>>,
}

/// Of the length of a segment.
const TOLERANCE: f64 = 1e-9;

impl Wedges {
    /// The small angles between neighboring segments of each point.
    pub fn new(input: &Input) -> Self {
        let mut around: Vec<Vec<usize>> = vec![Vec::new(); input.points.len()];
        for &[a, b] in &input.segments {
            around[a].push(b);
            around[b].push(a);
        }
        let mut wedges = Vec::new();
        for (ends, &corner) in around.iter_mut().zip(&input.points) {
            let direction = |p: [f64; 2]| (p[1] - corner[1]).atan2(p[0] - corner[0]);
            ends.sort_by(|&a, &b| direction(input.points[a]).total_cmp(&direction(input.points[b])));
            for (k, &a) in ends.iter().enumerate() {
                let b = ends[(k + 1) % ends.len()];
                let ends = [input.points[a], input.points[b]];
                let turn = (direction(ends[1]) - direction(ends[0])).rem_euclid(std::f64::consts::TAU);
                if a != b && turn < std::f64::consts::FRAC_PI_3 {
                    wedges.push(Wedge { corner, ends });
                }
            }
        }
        Self::in_grid(wedges, &input.points)
    }

    fn in_grid(wedges: Vec<Wedge>, points: &[[f64; 2]]) -> Self {
        let [low, high] = boxed(points);
        let side = (wedges.len() as f64).sqrt().ceil().max(1.0) as usize;
        let cell = (high[0] - low[0]).max(high[1] - low[1]) / side as f64;
        let mut grid = Self { wedges, side, low, cell, cells: vec![Vec::new(); side * side] };
        for k in 0..grid.wedges.len() {
            let Wedge { corner, ends: [a, b] } = grid.wedges[k];
            let [first, last] = boxed(&[corner, a, b]).map(|p| grid.column_and_row(p));
            for row in first[1]..=last[1] {
                for column in first[0]..=last[0] {
                    grid.cells[row * side + column].push(k as u32);
                }
            }
        }
        grid
    }

    fn column_and_row(&self, p: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|k| (((p[k] - self.low[k]) / self.cell) as usize).min(self.side - 1))
    }

    /// Whether an edge goes from one segment of some corner to the other.
    pub fn join(&self, [p, q]: [[f64; 2]; 2]) -> bool {
        let [column, row] = self.column_and_row(p);
        self.cells[row * self.side + column].iter().any(|&k| {
            let Wedge { corner, ends: [a, b] } = self.wedges[k as usize];
            p != corner
                && q != corner
                && (is_on(p, corner, a) && is_on(q, corner, b) || is_on(p, corner, b) && is_on(q, corner, a))
        })
    }
}

/// The least and the largest coordinates.
fn boxed(points: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let bound =
        |start: f64, pick: fn(f64, f64) -> f64| [0, 1].map(|k| points.iter().map(|p| p[k]).fold(start, pick));
    [bound(f64::INFINITY, f64::min), bound(f64::NEG_INFINITY, f64::max)]
}

/// About: within the tolerance.
pub fn is_on(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> bool {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length = u[0] * u[0] + u[1] * u[1];
    let (along, across) = (u[0] * v[0] + u[1] * v[1], u[0] * v[1] - u[1] * v[0]);
    across.abs() <= TOLERANCE * length && (-TOLERANCE * length..=(1.0 + TOLERANCE) * length).contains(&along)
}
