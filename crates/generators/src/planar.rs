//! Random short segments between given points that do not cross.

use crate::{Point2, Random};

/// Segments are looked for among so many cells of points in each direction.
const REACH: usize = 6;

/// Cells of a square grid, with what is in them.
struct Cells {
    side: f64,
    columns: usize,
    lists: Vec<Vec<u32>>,
}

impl Cells {
    fn new(extent: f64, columns: usize) -> Self {
        let columns = columns.max(1);
        Self { side: extent / columns as f64, columns, lists: vec![Vec::new(); columns * columns] }
    }

    /// Column and row, moved into the grid.
    fn place(&self, p: Point2) -> [usize; 2] {
        p.map(|x| ((x / self.side) as usize).min(self.columns - 1))
    }

    fn list(&mut self, [column, row]: [usize; 2]) -> &mut Vec<u32> {
        &mut self.lists[row * self.columns + column]
    }
}

/// Coordinates as integers, which are exact for 53 bits below the extent.
fn whole(p: Point2, scale: f64) -> [i128; 2] {
    p.map(|x| (x * scale) as i128)
}

fn side([ax, ay]: [i128; 2], [bx, by]: [i128; 2], [cx, cy]: [i128; 2]) -> i128 {
    ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)).signum()
}

/// `count` segments between points in the square from the origin to `extent`, a power of two of whose 2^-53 all
/// coordinates are multiples. They are several mean distances of points long, and none crosses another; they may meet in
/// points and lie on one another. Fewer, if there is no room.
pub(crate) fn short_segments(
    points: &[Point2],
    extent: f64,
    count: usize,
    random: &mut Random,
) -> Vec<[usize; 2]> {
    let scale = (1_u64 << 53) as f64 / extent;
    let columns = (points.len() as f64 / 2.0).sqrt() as usize;
    let mut near = Cells::new(extent, columns);
    for (i, &p) in points.iter().enumerate() {
        let cell = near.place(p);
        near.list(cell).push(i as u32);
    }
    let mut taken = Cells::new(extent, columns / REACH);
    let mut segments: Vec<[usize; 2]> = Vec::with_capacity(count);
    for _ in 0..20 * count {
        if segments.len() == count {
            break;
        }
        let first = random.below(points.len());
        let shift = |at: usize, by: usize| (at + by).saturating_sub(REACH).min(near.columns - 1);
        let cell = near.place(points[first]).map(|at| shift(at, random.below(2 * REACH + 1)));
        let list = near.list(cell);
        if list.is_empty() {
            continue;
        }
        let second = list[random.below(list.len())] as usize;
        let [a, b] = [first, second].map(|v| whole(points[v], scale));
        let crosses = |&other: &u32| {
            let [c, d] = segments[other as usize].map(|v| whole(points[v], scale));
            side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0
        };
        let [from, to] = [first, second].map(|v| taken.place(points[v]));
        let span = |k: usize| from[k].min(to[k])..=from[k].max(to[k]);
        let boxes: Vec<[usize; 2]> =
            span(1).flat_map(|row| span(0).map(move |column| [column, row])).collect();
        if a == b || boxes.iter().any(|&cell| taken.list(cell).iter().any(crosses)) {
            continue;
        }
        boxes.iter().for_each(|&cell| taken.list(cell).push(segments.len() as u32));
        segments.push([first, second]);
    }
    segments
}
