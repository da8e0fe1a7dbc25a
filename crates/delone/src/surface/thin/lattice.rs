//! The cells of a raster, measured against planes over triangles: row by row, and over large triangles block by block, of which most
//! are surely not worse than the worst so far.
//!
//! Cells and corners are numbers of columns and rows here, so that where a side is in a row is the same for both of its triangles, and
//! no cell falls between them. Cost: O(cells) once; for a triangle as many cells as it has, for a large one a part of them.

use std::cmp::Ordering;

use super::plane::{Plane, Worst};
use super::{Samples, Triple};
use crate::surface::Grid;

/// Blocks have so many columns and rows.
const SIDE: usize = 8;

/// Differences of larger heights may be beyond all numbers.
pub(super) const HIGHEST: f64 = 1e300;

/// From so many columns and rows on a triangle is looked at in blocks.
const LARGE: i32 = 16;

/// See the module.
#[derive(Debug)]
pub(super) struct Lattice<'a> {
    grid: &'a Grid,
    columns: usize,
    /// Row by row, NaN for no data, with room between rows: those of a power of two would share places in caches.
    values: Vec<f64>,
    stride: usize,
    /// The least and the largest value of each block.
    ranges: Vec<[f64; 2]>,
}

impl<'a> Lattice<'a> {
    pub(super) fn new(grid: &'a Grid, values: &[f64]) -> Self {
        let (columns, rows) = (grid.columns(), grid.rows());
        let across = columns.div_ceil(SIDE);
        let stride = columns.next_multiple_of(8) + 8;
        let mut ranges = vec![[f64::INFINITY, f64::NEG_INFINITY]; across * rows.div_ceil(SIDE)];
        let mut padded = vec![f64::NAN; stride * rows];
        let all = values.chunks_exact(columns).zip(padded.chunks_exact_mut(stride));
        for (r, (row, to)) in all.enumerate() {
            to[..columns].copy_from_slice(row);
            for (range, part) in ranges[r / SIDE * across..].iter_mut().zip(row.chunks(SIDE)) {
                for &z in part {
                    range[0] = if z < range[0] { z } else { range[0] };
                    range[1] = if z > range[1] { z } else { range[1] };
                }
            }
        }
        Self { grid, columns, values: padded, stride, ranges }
    }

    fn cell(&self, sample: u32) -> [i32; 2] {
        let columns = self.columns as u32;
        [(sample % columns) as i32, (sample / columns) as i32]
    }

    fn sample([column, row]: [i32; 2], columns: usize) -> u32 {
        row as u32 * columns as u32 + column as u32
    }

    /// The order of centres, x first.
    fn order(&self, a: [i32; 2], b: [i32; 2]) -> Ordering {
        let forwards = self.grid.step().map(|step| step > 0.0);
        let along = |k: usize| if forwards[k] { a[k].cmp(&b[k]) } else { b[k].cmp(&a[k]) };
        along(0).then_with(|| along(1))
    }

    /// The plane over a triangle and its sides; `None` where it has no area here.
    fn triangle(&self, corners: Triple) -> Option<(Plane, Sides)> {
        let mut cells = corners.map(|s| self.cell(s));
        let plane = Plane::new(cells.map(|c| c.map(f64::from)), corners.map(|s| self.height(s)), 0.0)?;
        cells.sort_unstable_by_key(|cell| cell[1]);
        Some((plane, Sides::of(cells)))
    }

    /// The values of some columns of a row.
    #[inline]
    fn part(&self, row: i32, [a, b]: [i32; 2]) -> &[f64] {
        let start = row as usize * self.stride;
        if a > b { &[] } else { self.values.get(start + a as usize..=start + b as usize).unwrap_or_default() }
    }

    /// Measures a part of a row: first how bad it is, without a branch, then where.
    #[inline]
    fn measure(&self, plane: &Plane, row: i32, [a, b]: [i32; 2], worst: &mut Worst<[i32; 2]>) {
        let values = self.part(row, [a, b]);
        let base = plane.row(f64::from(row));
        let error = |z: f64, x: f64| (z - (base + plane.along(x))).abs();
        let (mut x, mut most) = (f64::from(a), -1.0);
        for &z in values {
            let error = error(z, x);
            x += 1.0;
            most = if error > most { error } else { most };
        }
        if most < worst.error {
            return;
        }
        for (column, &z) in (a..).zip(values) {
            let error = error(z, f64::from(column));
            if error == most {
                worst.offer(error, [column, row], |a, b| self.order(a, b));
            }
        }
    }

    fn by_blocks(&self, plane: &Plane, sides: &Sides, worst: &mut Worst<[i32; 2]>) {
        let side = SIDE as i32;
        let across = self.columns.div_ceil(SIDE);
        let half = [(SIDE as f64 - 1.0) / 2.0; 2];
        let [top, bottom] = sides.rows;
        let mut spans = [[0, -1]; SIDE];
        for block_row in top / side..=bottom / side {
            let rows = (block_row * side).max(top)..=(block_row * side + side - 1).min(bottom);
            let (mut low, mut high) = (i32::MAX, i32::MIN);
            for row in rows.clone() {
                let span @ [a, b] = sides.span(row);
                spans[(row % side) as usize] = span;
                if a <= b {
                    (low, high) = (low.min(a), high.max(b));
                }
            }
            if low > high {
                continue;
            }
            for block in low / side..=high / side {
                let range = self.ranges[block_row as usize * across + block as usize];
                let middle = [f64::from(block * side) + half[0], f64::from(block_row * side) + half[1]];
                if plane.most(middle, half, range) < worst.error {
                    continue;
                }
                for row in rows.clone() {
                    let [a, b] = spans[(row % side) as usize];
                    let part = [a.max(block * side), b.min(block * side + side - 1)];
                    self.measure(plane, row, part, worst);
                }
            }
        }
    }
}

impl Samples for Lattice<'_> {
    fn count(&self) -> usize {
        self.columns * self.grid.rows()
    }

    fn is_there(&self, sample: u32) -> bool {
        !self.height(sample).is_nan()
    }

    fn point(&self, sample: u32) -> [f64; 2] {
        let [column, row] = self.cell(sample);
        self.grid.centre(column as usize, row as usize)
    }

    fn height(&self, sample: u32) -> f64 {
        let [column, row] = self.cell(sample);
        self.values[row as usize * self.stride + column as usize]
    }

    fn worst(&self, corners: Triple, floor: f64) -> Option<(f64, u32)> {
        let (plane, sides) = self.triangle(corners)?;
        let mut worst = Worst::above(floor);
        let [top, bottom] = sides.rows;
        let columns = corners.map(|s| self.cell(s)[0]);
        let width = columns.iter().max().zip(columns.iter().min()).map_or(0, |(b, a)| b - a);
        if bottom - top >= LARGE && width >= LARGE {
            self.by_blocks(&plane, &sides, &mut worst);
        } else {
            (top..=bottom).for_each(|row| self.measure(&plane, row, sides.span(row), &mut worst));
        }
        worst.sample.map(|cell| (worst.error, Self::sample(cell, self.columns)))
    }

    fn all(&self, corners: Triple, each: &mut dyn FnMut(u32, f64)) {
        let Some((plane, sides)) = self.triangle(corners) else { return };
        for row in sides.rows[0]..=sides.rows[1] {
            let span = sides.span(row);
            let base = plane.row(f64::from(row));
            for (column, z) in (span[0]..).zip(self.part(row, span)) {
                if !z.is_nan() {
                    let error = (z - (base + plane.along(f64::from(column)))).abs();
                    each(Self::sample([column, row], self.columns), error);
                }
            }
        }
    }

    fn error(&self, corners: Triple, sample: u32) -> f64 {
        let place = self.cell(sample).map(f64::from);
        self.triangle(corners).map_or(0.0, |(plane, _)| (self.height(sample) - plane.at(place)).abs())
    }
}

/// The sides of a triangle by rows.
struct Sides {
    rows: [i32; 2],
    /// The long side, and the short ones above and below the row of the corner between.
    long: Side,
    short: [Side; 2],
    middle: i32,
    is_long_left: bool,
}

/// A side: a row, the column there, and columns a row.
#[derive(Clone, Copy)]
struct Side([f64; 3]);

impl Side {
    /// From the upper corner to the lower one.
    fn new(a: [i32; 2], b: [i32; 2]) -> Self {
        let rows = b[1] - a[1];
        let step = if rows == 0 { 0.0 } else { f64::from(b[0] - a[0]) / f64::from(rows) };
        Self([f64::from(a[1]), f64::from(a[0]), step])
    }

    #[inline]
    fn at(&self, row: f64) -> f64 {
        let Self([first, column, step]) = self;
        column + (row - first) * step
    }
}

impl Sides {
    /// Of corners by row.
    fn of([top, middle, bottom]: [[i32; 2]; 3]) -> Self {
        let long = Side::new(top, bottom);
        let is_flat = top[1] == middle[1];
        let is_long_left =
            if is_flat { top[0] < middle[0] } else { long.at(f64::from(middle[1])) < f64::from(middle[0]) };
        let short = [Side::new(top, middle), Side::new(middle, bottom)];
        // A side along a row is no border of any: the one below begins there.
        let middle = if is_flat { middle[1] - 1 } else { middle[1] };
        Self { rows: [top[1], bottom[1]], long, short, middle, is_long_left }
    }

    /// The first and the last column of a row.
    #[inline]
    fn span(&self, row: i32) -> [i32; 2] {
        let y = f64::from(row);
        let (long, short) = (self.long.at(y), self.short[usize::from(row > self.middle)].at(y));
        let (low, high) = if self.is_long_left { (long, short) } else { (short, long) };
        let floor = low as i32;
        [floor + i32::from(f64::from(floor) < low), high as i32]
    }
}
