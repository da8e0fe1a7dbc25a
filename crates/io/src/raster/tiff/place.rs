//! Where the cells of a GeoTIFF are: a corner with the size of a cell, or a matrix.

use delone::surface::Grid;

use super::tag;
use crate::Error;
use crate::raster::{Raster, placed};

/// The tags that say where a grid is. Rows to the north are told by a matrix, which is what readers expect there.
pub(super) fn tags(grid: &Grid) -> Vec<(u16, Vec<f64>)> {
    let ([x, y], [dx, dy]) = (grid.corner(), grid.step());
    if dx > 0.0 && dy < 0.0 {
        return vec![(tag::SCALE, vec![dx, -dy, 0.0]), (tag::TIE, vec![0.0, 0.0, 0.0, x, y, 0.0])];
    }
    let mut matrix = vec![0.0; 16];
    (matrix[0], matrix[3], matrix[5], matrix[7], matrix[15]) = (dx, x, dy, y, 1.0);
    vec![(tag::TRANSFORM, matrix)]
}

/// The grid that tags tell: the scale and a tie, or a matrix. `is_point` says that cells are meant by their centers.
pub(super) fn grid(
    scale: &[f64],
    tie: &[f64],
    matrix: &[f64],
    is_point: bool,
    [columns, rows]: [usize; 2],
) -> Result<Grid, Error> {
    let (corner, step) =
        if let (Some(&[dx, dy]), Some(&[i, j, _, x, y])) = (scale.first_chunk(), tie.first_chunk()) {
            ([x - i * dx, y + j * dy], [dx, -dy])
        } else if let Ok(matrix) = <&[f64; 16]>::try_from(matrix) {
            if matrix[1] != 0.0 || matrix[4] != 0.0 {
                return Err(Error::content("the raster is rotated, which is not read here"));
            }
            ([matrix[3], matrix[7]], [matrix[0], matrix[5]])
        } else {
            return Raster::nowhere(columns, rows);
        };
    let shift = if is_point { 0.5 } else { 0.0 };
    placed([0, 1].map(|k| corner[k] - shift * step[k]), step, columns, rows)
}

#[cfg(test)]
mod tests {
    use super::{grid, tags};
    use crate::raster::placed;

    #[test]
    fn places_come_back() {
        for step in [[2.0, -2.0], [0.5, 3.0], [-1.0, -1.0]] {
            let made = placed([10.0, 20.0], step, 3, 4).expect("a raster");
            let tags = tags(&made);
            let find = |number| tags.iter().find(|tag| tag.0 == number).map_or(&[][..], |tag| &tag.1[..]);
            let read = grid(find(33_550), find(33_922), find(34_264), false, [3, 4]).expect("a raster");
            assert_eq!((read.corner(), read.step()), (made.corner(), step));
        }
        let centers = grid(&[2.0, 2.0, 0.0], &[1.0, 1.0, 0.0, 11.0, 19.0, 0.0], &[], true, [3, 4]);
        assert_eq!(centers.expect("a raster").corner(), [8.0, 22.0]);
        let mut matrix = [0.0; 16];
        matrix[..8].copy_from_slice(&[1.0, 0.5, 0.0, 0.0, 0.5, -1.0, 0.0, 0.0]);
        assert!(grid(&[], &[], &matrix, false, [3, 4]).is_err(), "rotated");
        assert!(grid(&[0.0, 1.0, 0.0], &[0.0; 6], &[], false, [3, 4]).is_err(), "no step");
    }
}
