//! Sides of faces by the corner that they leave.
//!
//! Cost: O(n) for n sides, and O(k log k) for each corner that k sides leave.

/// For each corner its sides.
pub(super) struct Sides {
    starts: Vec<usize>,
    sides: Vec<(usize, usize)>,
}

impl Sides {
    /// Of sides, each given as the corner that it leaves, the corner that it leads to and a value; the corners are below a number.
    pub(super) fn of(corners: usize, all: impl Iterator<Item = (usize, (usize, usize))> + Clone) -> Self {
        // Each place is the end of a corner's sides at first, and their start when all are in their places.
        let mut starts = vec![0; corners + 1];
        all.clone().for_each(|(v, _)| starts[v] += 1);
        (0..corners).for_each(|v| starts[v + 1] += starts[v]);
        let mut sides = vec![(0, 0); starts[corners]];
        for (v, side) in all {
            starts[v] -= 1;
            sides[starts[v]] = side;
        }
        for ends in starts.windows(2) {
            sides[ends[0]..ends[1]].sort_unstable();
        }
        Self { starts, sides }
    }

    /// The sides that leave a corner, by the corner that they lead to.
    pub(super) fn leaving(&self, v: usize) -> &[(usize, usize)] {
        &self.sides[self.starts[v]..self.starts[v + 1]]
    }
}

/// The value of the side that leads to a corner.
pub(super) fn value(leaving: &[(usize, usize)], to: usize) -> Option<usize> {
    leaving.binary_search_by_key(&to, |side| side.0).ok().map(|k| leaving[k].1)
}
