//! The cells of a raster, measured against planes over triangles: row by row, and over large triangles block by block, of which most
//! are surely not worse than the worst so far. Blocks are tilted, so that this is a matter of how rough they are, not of how steep.
//!
//! Cells and corners are numbers of columns and rows here, so that which cells are in a triangle is exact. Where centers were rounded, what
//! is on a line by these numbers may be the corners of a triangle, and what is in it their centers tell. Cost: O(cells) once; for a triangle as many cells as it has, for a large one a part of them.

use std::cmp::Ordering;
use std::ops::Range;
use std::sync::atomic::Ordering::Relaxed;

use delone_predicates::{lexicographic, orient2d};

use super::plane::{Plane, Worst, mean};
use super::sides::{Part, Sides};
use super::{Found, Samples, Triple, Verdict};
use crate::parallel;
use crate::surface::Grid;

/// Blocks have so many columns and rows.
const SIDE: usize = 8;

/// Differences of larger heights may be beyond all numbers.
pub(super) const HIGHEST: f64 = 1e300;

/// Roundings of a bound, and of what it bounds, in parts of its terms: 2^-48.
const ROUNDING: f64 = f64::from_bits((1023 - 48) << 52);

/// Cells that are measured at once.
const LANES: usize = 4;

/// Columns and rows of a triangle, from which on it is scanned by blocks.
const BLOCKED_SIZE: i32 = 16;

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
        let blocks = |rows: &[f64]| -> Vec<Block> {
            (0..columns).step_by(SIDE).map(|k| Block::new(rows, stride, k..columns)).collect()
        };
        let bands = padded.chunks(stride * SIDE).collect();
        let blocks = parallel::share(values.len(), bands, blocks).concat();
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

    /// Columns from the least x, rows from the least y on; and back.
    fn turned(&self, [column, row]: [u32; 2]) -> [u32; 2] {
        let [forwards, upwards] = self.grid.step().map(|step| step > 0.0);
        let [columns, rows] = [self.columns, self.grid.rows()].map(|n| n as u32);
        [if forwards { column } else { columns - 1 - column }, if upwards { row } else { rows - 1 - row }]
    }

    fn sample([column, row]: [i32; 2], columns: usize) -> u32 {
        row as u32 * columns as u32 + column as u32
    }

    /// The order of centers, x first.
    fn order(&self, a: [i32; 2], b: [i32; 2]) -> Ordering {
        let forwards = self.grid.step().map(|step| step > 0.0);
        let along = |k: usize| if forwards[k] { a[k].cmp(&b[k]) } else { b[k].cmp(&a[k]) };
        along(0).then_with(|| along(1))
    }

    /// Tells the cells in a triangle whose corners are on a line by their numbers, but for these, and how far each is off. They are on that
    /// line; whether they are in this triangle or in one beside it their centers tell.
    #[cold]
    fn along(&self, corners: Triple, mut take: impl FnMut([i32; 2], f64)) {
        let cells = corners.map(|s| self.cell(s));
        let by_row = |&[column, row]: &[i32; 2]| (row, column);
        let mut sorted = cells;
        sorted.sort_unstable_by_key(by_row);
        let [a, _, b] = sorted;
        let across = [b[0] - a[0], b[1] - a[1]];
        let steps = divisor(across[0].unsigned_abs(), across[1].unsigned_abs()) as i32;
        // In lexicographic order, so that what is rounded does not depend on theirs.
        let mut places = corners.map(|s| (self.point(s), self.height(s)));
        let [p, q, r] = places.map(|place| place.0);
        places.sort_unstable_by(|u, v| lexicographic(u.0, v.0));
        for k in 1..steps {
            let cell = [0, 1].map(|axis| a[axis] + across[axis] / steps * k);
            let (sample, z) = (Self::sample(cell, self.columns), self.at(cell));
            let center = self.point(sample);
            let is_in =
                || [[p, q], [q, r], [r, p]].iter().all(|&[u, v]| !orient2d(u, v, center).is_negative());
            if !z.is_nan() && !cells.contains(&cell) && is_in() {
                take(
                    cell,
                    (z - mean(places.map(|place| place.0), places.map(|place| place.1), center)).abs(),
                );
            }
        }
    }

    /// The worst of these.
    fn worst_along(&self, corners: Triple, floor: f64) -> Option<(f64, u32)> {
        let mut worst = Worst::above(floor);
        self.along(corners, |cell, error| {
            if error >= worst.error {
                worst.offer(error, cell, |a, b| self.order(a, b));
            }
        });
        worst.sample.map(|cell| (worst.error, Self::sample(cell, self.columns)))
    }

    /// The plane over a triangle and its sides; `None` where it has no area here.
    fn triangle(&self, [a, b, c]: Triple) -> Option<(Plane, Sides)> {
        // Cells are numbered row by row.
        let [a, b] = [a.min(b), a.max(b)];
        let cells = [a.min(c), b.min(c).max(a), b.max(c)].map(|s| self.cell(s));
        let plane = Plane::of_sorted(cells.map(|c| c.map(f64::from)), cells.map(|c| self.at(c)), 0.0)?;
        Some((plane, Sides::of(cells)))
    }

    /// The largest error of the cells of a part, zero if it has none: several at once, the last ones with those behind the part, which do
    /// not count.
    #[inline]
    fn largest(&self, plane: &Plane, Part { row, columns: [a, b] }: Part) -> f64 {
        if a > b {
            return 0.0;
        }
        // There is room behind each row.
        let start = row as usize * self.stride + a as usize;
        let count = (b - a) as usize / LANES + 1;
        let values = self.values.get(start..start + count * LANES).unwrap_or_default();
        let (base, last) = (plane.row(f64::from(row)), f64::from(b));
        let mut x: [f64; LANES] = std::array::from_fn(|k| f64::from(a) + k as f64);
        let mut most = [0.0; LANES];
        for chunk in values.as_chunks::<LANES>().0 {
            for k in 0..LANES {
                let error = (chunk[k] - (base + plane.along(x[k]))).abs();
                let error = if x[k] <= last { error } else { 0.0 };
                most[k] = if error > most[k] { error } else { most[k] };
                x[k] += LANES as f64;
            }
        }
        let larger = |a: f64, b: f64| if a > b { a } else { b };
        let [a, b, c, d] = most;
        larger(larger(a, c), larger(b, d))
    }

    /// The error of a cell.
    #[inline]
    fn off(&self, plane: &Plane, cell @ [column, row]: [i32; 2]) -> f64 {
        (self.at(cell) - (plane.row(f64::from(row)) + plane.along(f64::from(column)))).abs()
    }

    /// The first cell of a part with an error that some of its cells have.
    fn place(&self, plane: &Plane, Part { row, columns: [a, b] }: Part, error: f64) -> [i32; 2] {
        let mut cells = (a..=b).map(|column| [column, row]);
        let is_it = |cell: &[i32; 2]| self.off(plane, *cell) == error;
        let found = if self.grid.step()[0] > 0.0 { cells.find(is_it) } else { cells.rfind(is_it) };
        found.unwrap_or([a, row])
    }

    /// Measures a part of a row: how bad it is, not yet where.
    #[inline]
    fn measure(&self, plane: &Plane, part: Part, worst: &mut Worst<Part>) {
        let most = self.largest(plane, part);
        if most >= worst.error {
            let place = |part| self.place(plane, part, most);
            worst.offer(most, part, |a, b| self.order(place(a), place(b)));
        }
    }

    fn by_blocks(&self, plane: &Plane, sides: &Sides, worst: &mut Worst<Part>) {
        let side = SIDE as i32;
        let across = self.columns.div_ceil(SIDE);
        let mut parts = [Part { row: 0, columns: [0, -1] }; SIDE];
        let (mut count, mut low, mut high) = (0, i32::MAX, i32::MIN);
        sides.each(|part| {
            if let Part { columns: [a, b], .. } = part
                && a <= b
            {
                (low, high) = (low.min(a), high.max(b));
                parts[count] = part;
                count += 1;
            }
            if part.row % side < side - 1 && part.row < sides.bottom() {
                return;
            }
            let block_row = part.row / side;
            for block in low / side..=high.div_euclid(side) {
                let cells = &self.blocks[block_row as usize * across + block as usize];
                let middle = [f64::from(block * side) + HALF, f64::from(block_row * side) + HALF];
                if cells.most(plane, middle) < worst.error {
                    continue;
                }
                for &Part { row, columns: [a, b] } in &parts[..count] {
                    let columns = [a.max(block * side), b.min(block * side + side - 1)];
                    self.measure(plane, Part { row, columns }, worst);
                }
            }
            (count, low, high) = (0, i32::MAX, i32::MIN);
        });
    }
}

/// The greatest common divisor.
fn divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { divisor(b, a % b) }
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
        self.grid.center(column as usize, row as usize)
    }

    fn height(&self, sample: u32) -> f64 {
        self.at(self.cell(sample))
    }

    fn entry(&self, error: f64, sample: u32, triangle: u32) -> u128 {
        let [column, row] = self.turned(self.cell(sample).map(|k| k as u32));
        let rows = self.grid.rows() as u32;
        // Errors are positive, so their bits have their order.
        u128::from(error.to_bits()) << 64 | u128::from(!(column * rows + row)) << 32 | u128::from(triangle)
    }

    fn found(&self, &entry: &u128) -> Found {
        let (place, rows) = (!((entry >> 32) as u32), self.grid.rows() as u32);
        let [column, row] = self.turned([place / rows, place % rows]);
        let error = f64::from_bits((entry >> 64) as u64);
        Found { error, sample: row * self.columns as u32 + column, triangle: entry as u32 }
    }

    fn worst(&self, corners: Triple, floor: f64) -> Option<(f64, u32)> {
        let Some((plane, sides)) = self.triangle(corners) else { return self.worst_along(corners, floor) };
        let mut worst = Worst::above(floor);
        if sides.size().iter().all(|&size| size >= BLOCKED_SIZE) {
            self.by_blocks(&plane, &sides, &mut worst);
        } else {
            sides.each(|part| self.measure(&plane, part, &mut worst));
        }
        let cell = worst.sample.map(|part| self.place(&plane, part, worst.error));
        cell.map(|cell| (worst.error, Self::sample(cell, self.columns)))
    }

    fn judge(&self, corners: Triple, t: u32, verdict: &mut Verdict<'_>) {
        let Some((plane, sides)) = self.triangle(corners) else {
            return self
                .along(corners, |cell, error| verdict.take(t, Self::sample(cell, self.columns), error));
        };
        sides.each(|part| {
            let Part { row, columns: [a, b] } = part;
            if a > b {
                return;
            }
            let samples = Self::sample([a, row], self.columns)..=Self::sample([b, row], self.columns);
            let seen = &verdict.seen[*samples.start() as usize..=*samples.end() as usize];
            seen.iter().for_each(|seen| seen.store(true, Relaxed));
            let most = self.largest(&plane, part);
            verdict.largest = verdict.largest.max(most);
            if most > verdict.allowed {
                let errors = (a..=b).map(|column| self.off(&plane, [column, row]));
                let missed = samples.zip(errors).filter(|&(_, error)| error > verdict.allowed);
                verdict.missed.extend(missed.map(|(sample, _)| (t, sample)));
            }
        });
    }

    fn error(&self, corners: Triple, sample: u32) -> f64 {
        if let Some((plane, _)) = self.triangle(corners) {
            return (self.height(sample) - plane.at(self.cell(sample).map(f64::from))).abs();
        }
        let (mut found, here) = (0.0, self.cell(sample));
        self.along(corners, |cell, error| found = if cell == here { error } else { found });
        found
    }
}
