//! The cells of a raster, measured against planes over triangles: row by row, and over large triangles block by block, of which most
//! are surely not worse than the worst so far. Blocks are tilted, so that this is a matter of how rough they are, not of how steep.
//!
//! Cells and corners are numbers of columns and rows here, so that where a side is in a row is the same for both of its triangles, and
//! no cell falls between them. Cost: O(cells) once; for a triangle as many cells as it has, for a large one a part of them.

use std::cmp::Ordering;
use std::ops::Range;

use super::plane::{Plane, Worst};
use super::{Samples, Triple, Verdict};
use crate::surface::Grid;

/// Blocks have so many columns and rows.
const SIDE: usize = 8;

/// Differences of larger heights may be beyond all numbers.
pub(super) const HIGHEST: f64 = 1e300;

/// Roundings of a bound, and of what it bounds, in parts of its terms: 2^-48.
const ROUNDING: f64 = f64::from_bits((1023 - 48) << 52);

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
    blocks: Vec<Block>,
    /// One over the number of columns.
    over: f64,
}

/// The values of a block: so far from a plane that is tilted as they are, which is much less than they differ.
#[derive(Clone, Copy, Debug)]
struct Block {
    slope: [f64; 2],
    /// The least and the largest height in the middle of parallel planes through the cells.
    range: [f64; 2],
}

/// From the middle of a block to its outermost cells.
const HALF: f64 = (SIDE as f64 - 1.0) / 2.0;

impl Block {
    /// From its rows, each of so many values, and the columns from its first one on.
    fn new(rows: &[f64], stride: usize, columns: Range<usize>) -> Self {
        let [right, low] = [columns.len().min(SIDE) - 1, rows.len() / stride - 1];
        let at = |column: usize, row: usize| rows[row * stride + columns.start + column];
        let [a, b, c, d] = [at(0, 0), at(right, 0), at(0, low), at(right, low)];
        // Any slope is right, but some have smaller ranges.
        let slope = [((b - a) + (d - c)) / (2 * right) as f64, ((c - a) + (d - b)) / (2 * low) as f64];
        let slope = slope.map(|s| if s.is_finite() { s } else { 0.0 });
        let across: [f64; SIDE] = std::array::from_fn(|k| slope[0] * (k as f64 - HALF));
        let (mut least, mut most) = ([f64::INFINITY; SIDE], [f64::NEG_INFINITY; SIDE]);
        for (k, row) in rows.chunks_exact(stride).enumerate() {
            let down = slope[1] * (k as f64 - HALF);
            let row = row[columns.start..].iter().zip(&across);
            for ((least, most), (&z, across)) in least.iter_mut().zip(&mut most).zip(row) {
                let z = z - (across + down);
                *least = if z < *least { z } else { *least };
                *most = if z > *most { z } else { *most };
            }
        }
        let range = [least.into_iter().fold(least[0], f64::min), most.into_iter().fold(most[0], f64::max)];
        Self { slope, range }
    }

    /// A bound of its errors from a plane, with what is rounded in it.
    #[inline]
    fn most(&self, plane: &Plane, middle: [f64; 2]) -> f64 {
        let (z, [low, high]) = (plane.at(middle), self.range);
        let [[a, b], [c, d]] = [self.slope, plane.slope];
        let span = HALF * ((a - c).abs() + (b - d).abs());
        let size =
            plane.size(middle) + low.abs() + high.abs() + HALF * (a.abs() + b.abs() + c.abs() + d.abs());
        (high - z).max(z - low) + span + size * ROUNDING
    }
}

impl<'a> Lattice<'a> {
    pub(super) fn new(grid: &'a Grid, values: &[f64]) -> Self {
        let (columns, rows) = (grid.columns(), grid.rows());
        let stride = columns.next_multiple_of(8) + 8;
        let mut padded = vec![f64::NAN; stride * rows];
        for (row, to) in values.chunks_exact(columns).zip(padded.chunks_exact_mut(stride)) {
            to[..columns].copy_from_slice(row);
        }
        let blocks = padded
            .chunks(stride * SIDE)
            .flat_map(|rows| (0..columns).step_by(SIDE).map(move |k| Block::new(rows, stride, k..columns)))
            .collect();
        Self { grid, columns, values: padded, stride, blocks, over: 1.0 / columns as f64 }
    }

    /// The column and the row of a sample.
    #[inline]
    fn cell(&self, sample: u32) -> [i32; 2] {
        // Half a cell away from where the next row begins, which is more than what is rounded.
        let row = ((f64::from(sample) + 0.5) * self.over) as i32;
        [(sample as i32).wrapping_sub(row.wrapping_mul(self.columns as i32)), row]
    }

    #[inline]
    fn at(&self, [column, row]: [i32; 2]) -> f64 {
        self.values[row as usize * self.stride + column as usize]
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
        let plane = Plane::new(cells.map(|c| c.map(f64::from)), cells.map(|c| self.at(c)), 0.0)?;
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
        let most = largest(values, a, error);
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
                let cells = &self.blocks[block_row as usize * across + block as usize];
                let middle = [f64::from(block * side) + HALF, f64::from(block_row * side) + HALF];
                if cells.most(plane, middle) < worst.error {
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
    type Entry = u128;

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
        self.at(self.cell(sample))
    }

    fn entry(&self, error: f64, sample: u32, triangle: u32) -> u128 {
        let [column, row] = self.cell(sample);
        let [columns, rows] = [self.columns as u32, self.grid.rows() as u32];
        let [forwards, upwards] = self.grid.step().map(|step| step > 0.0);
        let column = if forwards { column as u32 } else { columns - 1 - column as u32 };
        let row = if upwards { row as u32 } else { rows - 1 - row as u32 };
        // Errors are positive, so their bits have their order.
        u128::from(error.to_bits()) << 64 | u128::from(!(column * rows + row)) << 32 | u128::from(triangle)
    }

    fn triangle_of(entry: &u128) -> u32 {
        *entry as u32
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

    fn judge(&self, corners: Triple, t: u32, verdict: &mut Verdict) {
        let Some((plane, sides)) = self.triangle(corners) else { return };
        for row in sides.rows[0]..=sides.rows[1] {
            let span = sides.span(row);
            let values = self.part(row, span);
            let first = Self::sample([span[0], row], self.columns) as usize;
            if values.is_empty() {
                continue;
            }
            let base = plane.row(f64::from(row));
            let error = |z: f64, x: f64| (z - (base + plane.along(x))).abs();
            verdict.seen[first..first + values.len()].fill(true);
            let most = largest(values, span[0], error);
            verdict.largest = verdict.largest.max(most);
            if most > verdict.allowed {
                for ((column, sample), &z) in (span[0]..).zip(first as u32..).zip(values) {
                    if error(z, f64::from(column)) > verdict.allowed {
                        verdict.missed.push((t, sample));
                    }
                }
            }
        }
    }

    fn error(&self, corners: Triple, sample: u32) -> f64 {
        let place = self.cell(sample).map(f64::from);
        self.triangle(corners).map_or(0.0, |(plane, _)| (self.height(sample) - plane.at(place)).abs())
    }
}

/// The largest error of the values of a row, from a column on; several at once. -1 if there are none.
#[inline]
fn largest(values: &[f64], first: i32, error: impl Fn(f64, f64) -> f64) -> f64 {
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let mut x = [0.0, 1.0, 2.0, 3.0].map(|k| f64::from(first) + k);
    let mut most = [-1.0; 4];
    let chunks = values.chunks_exact(4);
    let rest = chunks.remainder();
    for chunk in chunks {
        for k in 0..4 {
            most[k] = larger(error(chunk[k], x[k]), most[k]);
            x[k] += 4.0;
        }
    }
    let most = larger(larger(most[0], most[1]), larger(most[2], most[3]));
    rest.iter().zip(x).fold(most, |most, (&z, x)| larger(error(z, x), most))
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
