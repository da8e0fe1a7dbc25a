//! Triangles to cells: linear surfaces as rasters.
//!
//! A cell has a value if its center is in a triangle that is painted, in its inside or on its border, which the predicates decide. Along each
//! row the surface is linear between the two edges that the row meets, and along an edge it is linear between its ends, taken in
//! lexicographic order: so both triangles at an edge give the same bits for a center on it, a center on a vertex has its value, and no
//! value leaves the range of the corners, however flat a triangle is. What a cell has depends on its triangle alone: tiles, windows,
//! orders and threads do not show.
//!
//! Cost: O(1) for each triangle, each row that meets it and each cell in it: a few nanoseconds. Where a row meets an edge is computed with a
//! bound of its error; predicates are asked where a center is nearer than that.

use std::sync::atomic::{AtomicU64, Ordering};

use delone_predicates::orient2d;

use super::grid::Grid;
use super::interpolator::check_values;
use crate::error::Error;
use crate::ids::VertexId;
use crate::parallel;
use crate::triangulation::{Ask, Triangulation};

/// A raster that triangles are painted on, by several threads at once if need be.
///
/// ```
/// use delone::surface::{Grid, Raster};
///
/// let raster = Raster::new(Grid::new([0.0, 4.0], [1.0, -1.0], 4, 4)?);
/// raster.paint([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]], [0.0, 4.0, 0.0]);
/// let values = raster.into_values();
/// assert_eq!(values[4 * 3..], [0.5, 1.5, 2.5, 3.5]); // the southern row
/// assert!(values[1].is_nan()); // beyond the triangle
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Debug)]
pub struct Raster {
    grid: Grid,
    xs: Axis,
    ys: Axis,
    /// The bits of the values.
    cells: Vec<AtomicU64>,
}

/// No data.
const NOTHING: u64 = f64::NAN.to_bits();

impl Raster {
    /// A raster without data.
    pub fn new(grid: Grid) -> Self {
        let count = grid.columns() * grid.rows();
        Self {
            xs: Axis::new((0..grid.columns()).map(|k| grid.x(k)).collect()),
            ys: Axis::new((0..grid.rows()).map(|k| grid.y(k)).collect()),
            cells: parallel::collect(count, |_| AtomicU64::new(NOTHING)),
            grid,
        }
    }

    /// Where its cells are.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Paints a triangle, counter-clockwise, with a value at each corner: all cells whose centers are in it or on its border.
    #[inline]
    pub fn paint(&self, corners: [[f64; 2]; 3], values: [f64; 3]) {
        let [a, b, c] = corners;
        let (low, high) = (a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1]));
        let first = self.ys.first_from(low);
        if self.ys.is_beyond(first, high) {
            return;
        }
        let (west, east) = (a[0].min(b[0]).min(c[0]), a[0].max(b[0]).max(c[0]));
        if self.xs.is_beyond(self.xs.first_from(west), east) {
            return;
        }
        self.scan(first, corners, values);
    }

    /// The values, row by row, as the grid has them; NaN where there are none.
    pub fn into_values(self) -> Vec<f64> {
        // In the memory that they are in.
        self.cells.into_iter().map(|cell| f64::from_bits(cell.into_inner())).collect()
    }

    /// The ranks of vertices, by id.
    fn ranks<T: Triangulation<Point = [f64; 2]>>(&self, d: &T) -> Vec<Rank> {
        let rank = |axis: &Axis, x: f64| {
            let before = axis.first_from(x);
            [before as u32, before as u32 + u32::from(axis.places.get(before) == Some(&x))]
        };
        parallel::collect(d.ids_given(), |v| {
            let [x, y] = d.position(VertexId::new(v)).unwrap_or_default();
            let ([x, upto_x], [y, upto_y]) = (rank(&self.xs, x), rank(&self.ys, y));
            [[x, y], [upto_x, upto_y]]
        })
    }

    /// The rows up to the middle corner, then those above it.
    fn scan(&self, first: usize, corners: [[f64; 2]; 3], values: [f64; 3]) {
        let (low, middle, high, is_middle_left) = sorted(corners, values);
        let long = Side::between(low, high);
        let mut row = first;
        // A level side has no one place in its row: of the other one there is the end where they meet.
        if low.0[1] < middle.0[1] {
            row = self.scan_until(row, middle.0[1], &long, &Side::between(low, middle), is_middle_left);
        }
        if middle.0[1] < high.0[1] && !self.ys.is_beyond(row, high.0[1]) {
            self.scan_until(row, high.0[1], &long, &Side::between(middle, high), is_middle_left);
        }
    }

    /// The rows between two sides up to a height; says which comes next.
    fn scan_until(&self, from: usize, high: f64, long: &Side, short: &Side, is_short_left: bool) -> usize {
        let (left, right) = if is_short_left { (short, long) } else { (long, short) };
        let mut row = from;
        while let Some(&y) = self.ys.places.get(row).filter(|y| **y <= high) {
            self.fill(row, left.at(y), right.at(y), y);
            row += 1;
        }
        row
    }

    #[inline]
    fn fill(&self, row: usize, left: Meeting<'_>, right: Meeting<'_>, y: f64) {
        let start = left.first_inside(&self.xs, y);
        let end = right.first_beyond(&self.xs, y);
        if start.column >= end.column {
            return;
        }
        let width = self.xs.places.len();
        let row = if self.ys.is_turned { self.ys.places.len() - 1 - row } else { row };
        let cells = &self.cells[row * width..(row + 1) * width];
        let put = |column: usize, value: f64| {
            let column = if self.xs.is_turned { width - 1 - column } else { column };
            cells[column].store(value.to_bits(), Ordering::Relaxed);
        };
        let slope = (right.value - left.value) / (right.x - left.x);
        let is_plain = slope.is_finite() && is_told(slope, left.value, right.value);
        let (least, most) = (left.value.min(right.value), left.value.max(right.value));
        let inside = &self.xs.places[start.column..end.column];
        for (column, &x) in inside.iter().enumerate() {
            let value = if is_plain { left.value + (x - left.x) * slope } else { left.mean(&right, x) };
            put(start.column + column, value.max(least).min(most));
        }
        // Columns nearer to each other than numbers are at one place.
        if start.is_on_edge {
            let same = inside.iter().take_while(|&&x| x == inside[0]).count();
            (start.column..start.column + same).for_each(|column| put(column, left.value));
        }
        if end.is_on_edge {
            let same = inside.iter().rev().take_while(|&&x| x == inside[inside.len() - 1]).count();
            (end.column - same..end.column).for_each(|column| put(column, right.value));
        }
    }
}

/// How many columns and rows are before a point, and how many before or at it.
type Rank = [[u32; 2]; 2];

/// Whether the box of a triangle holds a center.
#[inline]
fn may_hold([a, b, c]: [Rank; 3]) -> bool {
    let [columns, rows] =
        [0, 1].map(|k| a[0][k].min(b[0][k]).min(c[0][k]) < a[1][k].max(b[1][k]).max(c[1][k]));
    // Without a branch: each alone is hard to foretell.
    columns & rows
}

/// Where columns or rows are.
#[derive(Debug)]
struct Axis {
    /// Increasing.
    places: Vec<f64>,
    /// Whether that is the other way round than the raster has them.
    is_turned: bool,
    /// One over the distance between two.
    frequency: f64,
}

impl Axis {
    fn new(mut places: Vec<f64>) -> Self {
        let is_turned = places.first() > places.last();
        if is_turned {
            places.reverse();
        }
        let [first, last] = [places.first(), places.last()].map(|end| end.copied().unwrap_or_default());
        let frequency = (places.len().max(2) - 1) as f64 / (last - first);
        Self { places, is_turned, frequency }
    }

    /// The first place that is not below a number.
    #[inline]
    fn first_from(&self, x: f64) -> usize {
        let places = &self.places[..];
        let Some(&first) = places.first() else { return 0 };
        // A guess, since places are evenly spread, in range whatever it is made of; it is put right.
        let mut k = (((x - first) * self.frequency) as usize).min(places.len() - 1);
        while k > 0 && places[k - 1] >= x {
            k -= 1;
        }
        while k < places.len() && places[k] < x {
            k += 1;
        }
        k
    }

    /// Whether there is no such place up to a number.
    #[inline]
    fn is_beyond(&self, k: usize, most: f64) -> bool {
        self.places.get(k).is_none_or(|&x| x > most)
    }
}

/// A corner with its value.
type Corner = ([f64; 2], f64);

/// The corners of a triangle from below, of equally low ones from the left; and whether the one in the middle is on the left of the
/// side between the others.
#[inline]
fn sorted(corners: [[f64; 2]; 3], values: [f64; 3]) -> (Corner, Corner, Corner, bool) {
    let [a, b, c] = [0, 1, 2].map(|k| (corners[k], values[k]));
    let is_below = |p: &Corner, q: &Corner| (p.0[1], p.0[0]) < (q.0[1], q.0[0]);
    // Turned, so that the lowest comes first, they are still counter-clockwise.
    let (low, next, last) = if is_below(&a, &b) && is_below(&a, &c) {
        (a, b, c)
    } else if is_below(&b, &c) {
        (b, c, a)
    } else {
        (c, a, b)
    };
    if is_below(&last, &next) { (low, last, next, true) } else { (low, next, last, false) }
}

/// A side from its lower end to its upper one, which is above it.
struct Side {
    low: [f64; 2],
    high: [f64; 2],
    values: [f64; 2],
    /// How far it goes to the right for each unit upwards; and how far the value rises.
    slope: f64,
    rise: f64,
    /// Whether neither of these has lost more than roundings.
    is_told: bool,
    /// A bound of the error of where it meets a row.
    doubt: f64,
}

/// Whether a slope between two numbers is none that underflow has made of a difference.
#[inline]
fn is_told(slope: f64, from: f64, to: f64) -> bool {
    const LEAST: f64 = f64::from_bits((1023 - 960) << 52);
    slope.abs() >= LEAST || from == to
}

impl Side {
    #[inline]
    fn between((low, first): Corner, (high, second): Corner) -> Self {
        let over = 1.0 / (high[1] - low[1]);
        let (slope, rise) = ((high[0] - low[0]) * over, (second - first) * over);
        // Seven roundings, none of more than half of the last place of twice the larger end; where slopes are rounded to
        // nothing or are not finite, everything is doubted.
        let size = low[0].abs().max(high[0].abs());
        let is_plain = low[0] == high[0] || (slope.abs() > 2f64.powi(-500) && slope.abs() < 2f64.powi(500));
        let is_known = is_plain && size > 2f64.powi(-500) && size < 2f64.powi(1000) && over < 2f64.powi(1000);
        let doubt = if is_known { size * (16.0 * f64::EPSILON) } else { f64::INFINITY };
        let is_told = is_told(slope, low[0], high[0]) && is_told(rise, first, second);
        Self { low, high, values: [first, second], slope, rise, is_told, doubt }
    }

    #[inline]
    fn at(&self, y: f64) -> Meeting<'_> {
        let [first, second] = self.values;
        if y <= self.low[1] {
            return Meeting { side: self, x: self.low[0], value: first };
        }
        if y >= self.high[1] {
            return Meeting { side: self, x: self.high[0], value: second };
        }
        let up = y - self.low[1];
        let x = self.low[0] + up * self.slope;
        let value = (first + up * self.rise).max(first.min(second)).min(first.max(second));
        if self.is_told && x.is_finite() && (first + up * self.rise).is_finite() {
            return Meeting { side: self, x, value };
        }
        self.mean(y)
    }

    /// Computes it where ends are too far apart, or too near to each other, for plain differences and quotients.
    #[cold]
    fn mean(&self, y: f64) -> Meeting<'_> {
        let [first, second] = self.values;
        let scale = if (self.high[1] - self.low[1]).is_finite() { 1.0 } else { 0.25 };
        let share = (y * scale - self.low[1] * scale) / (self.high[1] * scale - self.low[1] * scale);
        let share = if share.is_nan() { 0.5 } else { share };
        let mean = |a: f64, b: f64| a * (1.0 - share) + b * share;
        let value = mean(first, second).max(first.min(second)).min(first.max(second));
        Meeting { side: self, x: mean(self.low[0], self.high[0]), value }
    }
}

/// Where a row meets a side.
struct Meeting<'a> {
    side: &'a Side,
    x: f64,
    value: f64,
}

/// A column where something begins.
struct Begin {
    column: usize,
    /// Whether the center there, or the last one before the end, is on the side itself.
    is_on_edge: bool,
}

impl Meeting<'_> {
    /// The value between this and another one, where differences, or what they are divided by, are beyond the range of numbers.
    #[cold]
    fn mean(&self, other: &Meeting<'_>, x: f64) -> f64 {
        let scale = if (other.x - self.x).is_finite() { 1.0 } else { 0.25 };
        let share = (x * scale - self.x * scale) / (other.x * scale - self.x * scale);
        if share.is_nan() { self.value } else { self.value * (1.0 - share) + other.value * share }
    }

    /// The first column that is not on the left of the side.
    #[inline]
    fn first_inside(&self, xs: &Axis, y: f64) -> Begin {
        let guess = xs.first_from(self.x);
        if self.is_clear(&xs.places, guess) {
            return Begin { column: guess, is_on_edge: false };
        }
        self.exactly(&xs.places, guess, y, |side| side >= 0, 0)
    }

    /// The first column that is on the right of the side.
    #[inline]
    fn first_beyond(&self, xs: &Axis, y: f64) -> Begin {
        let guess = xs.first_from(self.x);
        if self.is_clear(&xs.places, guess) {
            return Begin { column: guess, is_on_edge: false };
        }
        self.exactly(&xs.places, guess, y, |side| side > 0, 1)
    }

    /// The first column of a kind, as the predicates say; the one that may be on the side is so many before it.
    #[cold]
    fn exactly(&self, xs: &[f64], guess: usize, y: f64, is_kind: fn(i8) -> bool, before: usize) -> Begin {
        let side = |k: usize| self.side_of([xs[k], y]);
        let mut column = guess;
        while column > 0 && is_kind(side(column - 1)) {
            column -= 1;
        }
        while column < xs.len() && !is_kind(side(column)) {
            column += 1;
        }
        let on = column.checked_sub(before).filter(|&k| k < xs.len());
        Begin { column, is_on_edge: on.is_some_and(|k| side(k) == 0) }
    }

    /// Whether the columns on both sides of where it is are surely that.
    #[inline]
    fn is_clear(&self, xs: &[f64], next: usize) -> bool {
        let doubt = self.side.doubt;
        xs.get(next).is_none_or(|&x| x - self.x > doubt) && (next == 0 || self.x - xs[next - 1] > doubt)
    }

    /// Where a point of the row is: negative on the left of the side.
    fn side_of(&self, p: [f64; 2]) -> i8 {
        let side = orient2d(self.side.low, self.side.high, p);
        if side.is_positive() { -1 } else { i8::from(side.is_negative()) }
    }
}

/// The linear surface of a triangulation as a raster: a value for each cell, row by row, NaN where there is no triangle. `heights` has a
/// value for each id of a vertex; triangles that `keep` refuses are left out. See [`Raster`].
///
/// # Errors
/// [`Error::Values`] if there are not as many values as ids of vertices.
///
/// ```
/// use delone::{Bounds, Delaunay2, surface::{Grid, rasterize}};
///
/// let points = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
/// let grid = Grid::aligned(&Bounds::of(points), 1.0)?;
/// let d = Delaunay2::from_points(&points)?;
/// let values = rasterize(&d, &[0.0, 4.0, 8.0, 4.0], &grid, |_| true)?; // x + y
/// assert_eq!(values[..4], [4.0, 5.0, 6.0, 7.0]);
/// # Ok::<(), delone::Error>(())
/// ```
pub fn rasterize<T: Ask<Point = [f64; 2]>>(
    d: &T,
    heights: &[f64],
    grid: &Grid,
    keep: impl Fn(T::Simplex) -> bool + Sync,
) -> Result<Vec<f64>, Error> {
    check_values(d, heights.len(), 1)?;
    let raster = Raster::new(*grid);
    paint(d, heights, &raster, keep);
    Ok(raster.into_values())
}

fn paint<T: Triangulation<Point = [f64; 2]>>(
    d: &T,
    heights: &[f64],
    raster: &Raster,
    keep: impl Fn(T::Simplex) -> bool + Sync,
) {
    // Where most triangles hold no center, most of the time would go into finding that out from coordinates.
    let ranks = if raster.grid.cells() < d.vertex_count() as f64 { raster.ranks(d) } else { Vec::new() };
    let one = |s: T::Simplex| {
        let corners = d.corners(s);
        let [a, b, c] = *corners.as_ref() else { return };
        if (ranks.is_empty() || may_hold([a, b, c].map(|v| ranks[v.index()]))) && keep(s) {
            let points = [a, b, c].map(|v| d.position(v).unwrap_or_default());
            raster.paint(points, [a, b, c].map(|v| heights[v.index()]));
        }
    };
    if parallel::threads() == 1 {
        return d.simplices().for_each(one);
    }
    let all: Vec<T::Simplex> = d.simplices().collect();
    parallel::map(parallel::ranges(all.len()), |range| all[range].iter().for_each(|&s| one(s)));
}
