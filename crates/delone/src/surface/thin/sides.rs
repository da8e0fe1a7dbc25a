//! Which cells of a lattice are in a triangle whose corners are cells: row by row, in integers, so that this is exact.
//!
//! Source: Bresenham, "Algorithm for computer control of a digital plotter", 1965. Cost: O(1) for each row.

/// A row, and its first and its last column in a triangle; there are none if the first is beyond the last.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) row: i32,
    pub(super) columns: [i32; 2],
}

/// A side, at one row after the other: the column there, rounded down, and what is left, in parts of the number of rows.
#[derive(Clone, Copy, Debug)]
struct Side {
    column: i32,
    rest: i32,
    rows: i32,
    /// The increment of both for a row.
    step: [i32; 2],
}

impl Side {
    /// From the upper corner to the lower one. If both are in one row it stays at the first.
    #[inline]
    fn new(a: [i32; 2], b: [i32; 2]) -> Self {
        let (across, rows) = (b[0] - a[0], (b[1] - a[1]).max(1));
        Self { column: a[0], rest: 0, rows, step: [across.div_euclid(rows), across.rem_euclid(rows)] }
    }

    /// The first column that is not on the left of the side.
    #[inline]
    fn rounded_up(&self) -> i32 {
        self.column + i32::from(self.rest > 0)
    }

    /// Goes to the next row.
    #[inline]
    fn advance(&mut self) {
        let rest = self.rest + self.step[1];
        let is_over = rest >= self.rows;
        self.rest = if is_over { rest - self.rows } else { rest };
        self.column += self.step[0] + i32::from(is_over);
    }
}

/// The sides of a triangle.
#[derive(Debug)]
pub(super) struct Sides {
    /// By rows.
    corners: [[i32; 2]; 3],
}

impl Sides {
    /// Of corners by row, those of one row by column.
    #[inline]
    pub(super) fn of(corners: [[i32; 2]; 3]) -> Self {
        Self { corners }
    }

    /// The last row.
    #[inline]
    pub(super) fn bottom(&self) -> i32 {
        self.corners[2][1]
    }

    /// From the first column to the last one, and from the first row to the last one.
    #[inline]
    pub(super) fn size(&self) -> [i32; 2] {
        let [a, b, c] = self.corners;
        [a[0].max(b[0]).max(c[0]) - a[0].min(b[0]).min(c[0]), c[1] - a[1]]
    }

    /// Tells all rows, from the top.
    #[inline]
    pub(super) fn each(&self, mut take: impl FnMut(Part)) {
        let [top, middle, bottom] = self.corners;
        let to = |p: [i32; 2]| [p[0] - top[0], p[1] - top[1]].map(i64::from);
        let ([mx, my], [bx, by]) = (to(middle), to(bottom));
        let is_long_left = bx * my < mx * by;
        let [long, upper, lower] =
            [(top, bottom), (top, middle), (middle, bottom)].map(|(a, b)| Side::new(a, b));
        let (mut left, mut right) = if is_long_left { (long, upper) } else { (upper, long) };
        for (short, rows) in [(upper, top[1]..middle[1]), (lower, middle[1]..bottom[1] + 1)] {
            *(if is_long_left { &mut right } else { &mut left }) = short;
            for row in rows {
                take(Part { row, columns: [left.rounded_up(), right.column] });
                left.advance();
                right.advance();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Part, Sides};
    use delone_generators::Random;

    /// On which side of the line through two cells a third one is.
    fn side(a: [i32; 2], b: [i32; 2], c: [i32; 2]) -> i32 {
        ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).signum()
    }

    #[test]
    fn cells_are_those_that_are_inside_by_definition() {
        let mut random = Random::new(7);
        for round in 0..3000 {
            let most = [3, 12, 40][round % 3];
            let mut corners = [[0; 2]; 3].map(|corner| corner.map(|_: i32| random.below(most) as i32));
            corners.sort_unstable_by_key(|&[column, row]| [row, column]);
            let [a, b, c] = corners;
            if side(a, b, c) == 0 {
                continue;
            }
            let sides = Sides::of(corners);
            let mut found = Vec::new();
            sides.each(|Part { row, columns: [first, last] }| {
                found.extend((first..=last).map(|column| [column, row]));
            });
            let is_inside = |&q: &[i32; 2]| {
                let sides = [side(a, b, q), side(b, c, q), side(c, a, q)];
                !(sides.contains(&1) && sides.contains(&-1))
            };
            let most = most as i32;
            let all = (0..most).flat_map(|row| (0..most).map(move |column| [column, row]));
            assert_eq!(found, all.filter(is_inside).collect::<Vec<_>>(), "{corners:?}");
            assert_eq!(sides.bottom(), found[found.len() - 1][1]);
            let (low, high) = (found.iter().map(|q| q[0]).min(), found.iter().map(|q| q[0]).max());
            assert_eq!(sides.size(), [high.unwrap_or(0) - low.unwrap_or(0), c[1] - a[1]]);
        }
    }
}
