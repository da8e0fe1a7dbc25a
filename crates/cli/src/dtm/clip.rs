//! Which cells of a raster are inside of polygons.
//!
//! A center is inside of a polygon if an odd number of its sides is on its left, along its row, where a side has its lower end and not its
//! upper one. The predicates say which side of a side it is on, so polygons that share a border share no cell, and leave none out. Where
//! polygons overlap a cell is inside all the same.
//!
//! Cost: O(sides + columns) for each row, and a few times the logarithm of columns for each side that meets it.

use std::path::Path;

use delone::surface::Grid;
use delone_io::{Contents, Format};
use delone_predicates::orient2d;

use super::lines;
use crate::files;
use crate::message::Failure;

/// The rings of a polygon.
type Rings = Vec<Vec<[f64; 2]>>;

/// Polygons to clip to.
pub(super) struct Clip {
    polygons: Vec<Rings>,
}

impl Clip {
    /// Reads them; the points of a file without polygons are one ring.
    pub(super) fn read(path: &Path, quiet: bool) -> Result<Self, Failure> {
        let format = files::format_beside(path)?;
        let graph = files::graph_beside(path, quiet)?;
        // Points of Triangle's graphs are a ring, whatever segments there are.
        if graph.rings.is_empty() && format != Format::Poly && files::holds_lines(path, format) {
            return Err(lines::no_polygon(path, &lines::give("polygons", Contents::Polygons)));
        }
        if graph.rings.is_empty() {
            return Ok(Self { polygons: vec![vec![graph.cloud.xy]] });
        }
        let ring = |sides: &[[usize; 2]]| sides.iter().map(|side| graph.cloud.xy[side[0]]).collect();
        let polygons = graph
            .rings
            .chunk_by(|a, b| a.polygon == b.polygon)
            .map(|rings| rings.iter().map(|r| ring(&graph.segments[r.segments.clone()])).collect())
            .collect();
        Ok(Self { polygons })
    }

    /// Takes the values of cells outside of all polygons.
    pub(super) fn apply(&self, grid: &Grid, values: &mut [f64]) {
        let columns = grid.columns();
        // How many polygons begin at a column, less those that end there.
        let mut begins = vec![0_i64; columns + 1];
        let mut crossed = Vec::new();
        for (row, cells) in values.chunks_exact_mut(columns.max(1)).enumerate() {
            let y = grid.y(row);
            begins.fill(0);
            for rings in &self.polygons {
                crossed.clear();
                rings.iter().for_each(|ring| cross(ring, grid, y, &mut crossed));
                crossed.sort_unstable();
                for pair in crossed.chunks_exact(2) {
                    begins[pair[0]] += 1;
                    begins[pair[1]] -= 1;
                }
            }
            let mut count = 0;
            for (cell, begins) in cells.iter_mut().zip(&begins) {
                count += begins;
                if count == 0 {
                    *cell = f64::NAN;
                }
            }
        }
    }
}

/// Tells the columns at which the sides of a ring are crossed along a row.
fn cross(ring: &[[f64; 2]], grid: &Grid, y: f64, crossed: &mut Vec<usize>) {
    for (k, &a) in ring.iter().enumerate() {
        let b = ring[(k + 1) % ring.len()];
        let (low, high) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        if low[1] <= y && y < high[1] {
            crossed.push(first_right(grid, low, high, y));
        }
    }
}

/// The first column whose center in a row is not on the left of a side; columns go east.
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
        let lower = vec![[0.0, 0.0], [8.0, 0.0], [8.0, 8.0]];
        let upper = vec![[0.0, 0.0], [8.0, 8.0], [0.0, 8.0]];
        let hole = vec![[5.0, 1.0], [7.0, 1.0], [7.0, 3.0]];
        let count = |polygons: &[&[&Vec<[f64; 2]>]]| {
            let polygons =
                polygons.iter().map(|rings| rings.iter().map(|&ring| ring.clone()).collect()).collect();
            let mut values = vec![1.0; 64];
            Clip { polygons }.apply(&grid, &mut values);
            (values.iter().filter(|value| !value.is_nan()).count(), values)
        };
        let ((a, first), (b, second)) = (count(&[&[&lower]]), count(&[&[&upper]]));
        assert_eq!(a + b, 64);
        assert!(first.iter().zip(&second).all(|(x, y)| x.is_nan() != y.is_nan()));
        assert!(count(&[&[&lower, &hole]]).0 < a);
        // Polygons that overlap hide nothing of each other.
        assert_eq!(count(&[&[&lower], &[&hole]]).0, a);
        assert_eq!(count(&[&[&lower], &[&lower], &[&upper]]).0, 64);
    }
}
