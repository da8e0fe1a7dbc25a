//! Which cells of a raster are inside of polygons.
//!
//! A center is inside of a polygon if an odd number of its sides is on its left, along its row, where a side has its lower end and not its
//! upper one. The predicates say which side of a side it is on, so polygons that share a border share no cell, and leave none out. Where
//! polygons overlap a cell is inside all the same.
//!
//! Cost: O(sides + columns) for each row, and a few times the logarithm of columns for each side that meets it.

use delone::surface::Grid;
use delone_io::{Crs, Graph};
use delone_predicates::orient2d;

use crate::error::Error;

/// The rings of a polygon.
type Rings = Vec<Vec<[f64; 2]>>;

/// Polygons to clip to.
///
/// ```
/// use delone::surface::Grid;
/// use delone_terrain::Clip;
///
/// let triangle = vec![vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]]];
/// let grid = Grid::new([0.0, 2.0], [1.0, -1.0], 2, 2)?;
/// let mut values = vec![5.0; 4];
/// Clip::new(vec![triangle]).apply(&grid, &mut values);
/// assert_eq!(values.iter().filter(|value| value.is_nan()).count(), 1);
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Clip {
    polygons: Vec<Rings>,
    crs: Option<Crs>,
}

impl Clip {
    /// Polygons of rings, which need not repeat their first point.
    pub fn new(polygons: Vec<Vec<Vec<[f64; 2]>>>) -> Self {
        Self { polygons, crs: None }
    }

    /// The polygons of a file; if it has none, its points are one ring.
    ///
    /// # Errors
    /// [`Error::NoPolygon`] for lines that are no rings.
    pub fn of(graph: &Graph) -> Result<Self, Error> {
        let crs = graph.cloud.crs.clone();
        if graph.rings.is_empty() {
            // Segments that all bound an area are those of a graph of Triangle, whose points are a ring.
            if graph.is_border.iter().any(|is_border| !is_border) {
                return Err(Error::NoPolygon);
            }
            return Ok(Self { polygons: vec![vec![graph.cloud.xy.clone()]], crs });
        }
        let ring = |sides: &[[usize; 2]]| sides.iter().map(|side| graph.cloud.xy[side[0]]).collect();
        let polygons = graph
            .rings
            .chunk_by(|a, b| a.polygon == b.polygon)
            .map(|rings| rings.iter().map(|r| ring(&graph.segments[r.segments.clone()])).collect())
            .collect();
        Ok(Self { polygons, crs })
    }

    /// These polygons and others.
    ///
    /// # Errors
    /// [`Error::Systems`] if the coordinates of these are of another system.
    pub fn with(mut self, other: Self) -> Result<Self, Error> {
        match (&self.crs, other.crs) {
            (Some(ours), Some(theirs)) if !ours.agrees(&theirs) => {
                return Err(Error::Systems { ours: Box::new(ours.clone()), theirs: Box::new(theirs) });
            }
            (None, theirs) => self.crs = theirs,
            _ => {}
        }
        self.polygons.extend(other.polygons);
        Ok(self)
    }

    /// The system of the polygons' coordinates, where it is known.
    pub fn crs(&self) -> Option<&Crs> {
        self.crs.as_ref()
    }

    /// Replaces the values of cells outside of all polygons by NaN.
    pub fn apply(&self, grid: &Grid, values: &mut [f64]) {
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
            Clip::new(polygons).apply(&grid, &mut values);
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
