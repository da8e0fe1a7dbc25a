//! Disjoint sets that are joined, each named by its least item.
//!
//! Source: Galler & Fischer, "An improved equivalence algorithm", CACM 1964, with paths halved as they are walked. Cost: O(log n) a step
//! on average.

/// Items from 0 on, in sets.
pub(crate) struct Sets(Vec<u32>);

impl Sets {
    /// Each item alone.
    pub(crate) fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The least item of the set of an item.
    pub(crate) fn find(&mut self, mut i: u32) -> u32 {
        while self.0[i as usize] != i {
            let above = self.0[self.0[i as usize] as usize];
            self.0[i as usize] = above;
            i = above;
        }
        i
    }

    /// Joins two sets; false if they are one.
    pub(crate) fn join(&mut self, i: u32, j: u32) -> bool {
        let (i, j) = (self.find(i), self.find(j));
        self.0[i.max(j) as usize] = i.min(j);
        i != j
    }
}

#[cfg(test)]
mod tests {
    use super::Sets;

    #[test]
    fn sets_are_named_by_their_least_items() {
        let mut sets = Sets::new(6);
        assert!(sets.join(5, 3) && sets.join(3, 4) && sets.join(2, 1));
        assert!(!sets.join(4, 5));
        assert_eq!([0, 1, 2, 3, 4, 5].map(|i| sets.find(i)), [0, 1, 1, 3, 3, 3]);
    }
}
