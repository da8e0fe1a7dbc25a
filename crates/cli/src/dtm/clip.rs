//! Which cells of a raster are inside of polygons.
//!
//! A centre is inside if an odd number of sides is on its left, along its row, where a side has its lower end and not its upper one. The
//! predicates say which side of a side it is on, so polygons that share a border share no cell, and leave none out.
//!
//! Cost: O(sides) for each row.

use delone::surface::Grid;
use delone_predicates::orient2d;

/// Takes the values of cells outside of all rings.
pub(super) fn clip(rings: &[Vec<[f64; 2]>], grid: &Grid, values: &mut [f64]) {
    let columns = grid.columns();
    let mut turns = vec![0_u32; columns + 1];
    for (row, cells) in values.chunks_exact_mut(columns.max(1)).enumerate() {
        let y = grid.y(row);
        turns.fill(0);
        for ring in rings {
            for (k, &a) in ring.iter().enumerate() {
                let b = ring[(k + 1) % ring.len()];
                let (low, high) = if a[1] <= b[1] { (a, b) } else { (b, a) };
                if low[1] <= y && y < high[1] {
                    turns[first_right(grid, low, high, y)] += 1;
                }
            }
        }
        let mut crossed = 0;
        for (cell, turns) in cells.iter_mut().zip(&turns) {
            crossed += turns;
            if crossed % 2 == 0 {
                *cell = f64::NAN;
            }
        }
    }
}

/// The first column whose centre in a row is not on the left of a side; columns go east.
fn first_right(grid: &Grid, low: [f64; 2], high: [f64; 2], y: f64) -> usize {
    let (mut from, mut to) = (0, grid.columns());
    while from < to {
        let middle = usize::midpoint(from, to);
        if orient2d(low, high, [grid.x(middle), y]).is_positive() {
            from = middle + 1;
        } else {
            to = middle;
        }
    }
    from
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_of_a_square_share_no_cell() {
        let grid = Grid::new([0.0, 8.0], [1.0, -1.0], 8, 8).expect("a raster");
        let lower = vec![vec![[0.0, 0.0], [8.0, 0.0], [8.0, 8.0]]];
        let upper = vec![vec![[0.0, 0.0], [8.0, 8.0], [0.0, 8.0]]];
        let hole = vec![lower[0].clone(), vec![[5.0, 1.0], [7.0, 1.0], [7.0, 3.0]]];
        let count = |rings: &[Vec<[f64; 2]>]| {
            let mut values = vec![1.0; 64];
            clip(rings, &grid, &mut values);
            (values.iter().filter(|value| !value.is_nan()).count(), values)
        };
        let ((a, first), (b, second)) = (count(&lower), count(&upper));
        assert_eq!(a + b, 64);
        assert!(first.iter().zip(&second).all(|(x, y)| x.is_nan() != y.is_nan()));
        assert!(count(&hole).0 < a);
    }
}
