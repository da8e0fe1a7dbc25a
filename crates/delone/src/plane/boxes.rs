//! Boxes in a tree, to find those that meet a box.
//!
//! Cost: O(n log n) to build, O(log n) for each box that is asked for and each that is found, if few overlap.

use delone_predicates::hypotenuse;

/// The least and greatest coordinates.
pub(in crate::plane) type Span = [[f64; 2]; 2];

/// Boxes of a leaf.
const LEAF_BOXES: usize = 4;

/// See the module.
#[derive(Debug, Default)]
pub(in crate::plane) struct Boxes {
    spans: Vec<Span>,
    /// Indices of boxes: halves of halves are near in the plane.
    order: Vec<u32>,
    /// The nodes as a heap: the box around each range of the order.
    around: Vec<Span>,
}

/// The box of some points.
pub(in crate::plane) fn span(points: &[[f64; 2]]) -> Span {
    let of =
        |start: f64, pick: fn(f64, f64) -> f64| [0, 1].map(|k| points.iter().map(|p| p[k]).fold(start, pick));
    [of(f64::INFINITY, f64::min), of(f64::NEG_INFINITY, f64::max)]
}

/// The box around two.
fn around(one: &Span, other: &Span) -> Span {
    let of = |end: usize, pick: fn(f64, f64) -> f64| [0, 1].map(|k| pick(one[end][k], other[end][k]));
    [of(0, f64::min), of(1, f64::max)]
}

fn meet(one: &Span, other: &Span) -> bool {
    (0..2).all(|k| one[0][k] <= other[1][k] && other[0][k] <= one[1][k])
}

impl Boxes {
    pub(in crate::plane) fn new(spans: Vec<Span>) -> Self {
        let order = (0..spans.len() as u32).collect();
        let mut boxes = Self { spans, order, around: Vec::new() };
        boxes.part(0, 0, boxes.spans.len());
        boxes
    }

    /// Orders a range of boxes by halves. Gives the box around it.
    fn part(&mut self, node: usize, low: usize, high: usize) {
        let range = &mut self.order[low..high];
        let own = range.iter().fold(span(&[]), |all, &k| around(&all, &self.spans[k as usize]));
        if self.around.len() <= node {
            self.around.resize(node + 1, span(&[]));
        }
        self.around[node] = own;
        if high - low <= LEAF_BOXES {
            return;
        }
        let axis = usize::from(own[1][1] - own[0][1] > own[1][0] - own[0][0]);
        let half = (high - low) / 2;
        let spans = &self.spans;
        let middle = |k: &u32| 0.5 * spans[*k as usize][0][axis] + 0.5 * spans[*k as usize][1][axis];
        range.select_nth_unstable_by(half, |p, q| middle(p).total_cmp(&middle(q)));
        self.part(2 * node + 1, low, low + half);
        self.part(2 * node + 2, low + half, high);
    }

    /// Tells the boxes that meet a box, by index.
    pub(in crate::plane) fn each(&self, asked: &Span, mut each: impl FnMut(usize)) {
        self.each_of(&|span| meet(span, asked), (0, 0, self.spans.len()), &mut each);
    }

    /// Tells the boxes that are within a distance of a place, up to rounding, by index.
    pub(in crate::plane) fn each_within(&self, at: [f64; 2], radius: f64, mut each: impl FnMut(usize)) {
        let is_within = |span: &Span| {
            let [x, y] = [0, 1].map(|k| (span[0][k] - at[k]).max(at[k] - span[1][k]).max(0.0));
            x <= radius && y <= radius && (x + y <= radius || hypotenuse(x, y) <= radius)
        };
        self.each_of(&is_within, (0, 0, self.spans.len()), &mut each);
    }

    /// The boxes of a range that pass a test, which boxes around them pass, too.
    fn each_of(
        &self,
        is_met: &impl Fn(&Span) -> bool,
        (node, low, high): (usize, usize, usize),
        each: &mut impl FnMut(usize),
    ) {
        if !is_met(&self.around[node]) {
            return;
        }
        if high - low <= LEAF_BOXES {
            let found = self.order[low..high].iter().map(|&k| k as usize);
            found.filter(|&k| is_met(&self.spans[k])).for_each(each);
            return;
        }
        let half = low + (high - low) / 2;
        self.each_of(is_met, (2 * node + 2, half, high), each);
        self.each_of(is_met, (2 * node + 1, low, half), each);
    }
}

#[cfg(test)]
mod tests {
    use super::{Boxes, meet};

    #[test]
    fn all_boxes_that_meet_are_found() {
        let at = |k: usize, of: usize| ((k * of) % 97) as f64;
        let spans: Vec<_> = (0..60)
            .map(|k| {
                let low = [at(k, 31), at(k, 53)];
                [low, [low[0] + at(k, 7) / 9.0, low[1] + at(k, 11) / 9.0]]
            })
            .collect();
        for count in [0, 1, 4, 5, 60] {
            let boxes = Boxes::new(spans[..count].to_vec());
            for asked in &spans {
                let mut found = Vec::new();
                boxes.each(asked, |k| found.push(k));
                found.sort_unstable();
                let expected: Vec<_> = (0..count).filter(|&k| meet(&spans[k], asked)).collect();
                assert_eq!(found, expected);
            }
        }
    }
}
