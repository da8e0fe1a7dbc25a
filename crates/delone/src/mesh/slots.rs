//! Free slots among used ones, found near where they are wanted: neighbors in the plane stay neighbors in
//! memory.
//!
//! Cost: O(1); one bit a slot.

use crate::prefetch::prefetch;

/// How many words of 64 slots to look at on either side.
const REACH: usize = 4;

/// Which slots are free. Slots never mentioned are in use.
#[derive(Clone, Debug, Default)]
pub(crate) struct Slots {
    /// One bit a slot, set if it is free.
    words: Vec<u64>,
    free: usize,
    /// Where the search for any free slot goes on.
    cursor: usize,
}

impl Slots {
    /// Slots below `count`, of which some are free.
    pub(crate) fn where_free(count: usize, is_free: impl Fn(usize) -> bool) -> Self {
        let word = |first: usize| {
            let bits = (first..count.min(first + 64)).map(|slot| u64::from(is_free(slot)) << (slot % 64));
            bits.fold(0, |word, bit| word | bit)
        };
        let words: Vec<u64> = (0..count).step_by(64).map(word).collect();
        let free = words.iter().map(|word| word.count_ones() as usize).sum();
        Self { words, free, cursor: 0 }
    }

    /// The number of free slots.
    pub(crate) fn free(&self) -> usize {
        self.free
    }

    /// Asks memory for what [`Self::take_near`] reads first.
    #[inline]
    pub(crate) fn prefetch(&self, at: usize) {
        prefetch(&self.words, at / 64);
    }

    /// Takes a free slot near `at`; or, when one in eight is free, any. `None`: make a new one.
    #[inline]
    pub(crate) fn take_near(&mut self, at: usize) -> Option<usize> {
        if self.free == 0 {
            return None;
        }
        let (word, bit) = (at / 64, at % 64);
        match self.words.get(word) {
            Some(&bits) if bits != 0 => {
                // The nearest set bit on either side.
                let (above, below) =
                    ((bits >> bit).trailing_zeros() as usize, (bits << (63 - bit)).leading_zeros() as usize);
                Some(self.take(word, if above <= below { bit + above } else { bit - below }))
            }
            _ => self.take_beside(word),
        }
    }

    /// Takes a free slot from words near one that has none.
    fn take_beside(&mut self, word: usize) -> Option<usize> {
        let count = self.words.len();
        let free = |w: &usize| self.words.get(*w).is_some_and(|&bits| bits != 0);
        let near = (1..=REACH).flat_map(|d| [word.wrapping_sub(d), word + d]).find(free);
        if near.is_none() && self.free * 8 >= count * 64 {
            self.cursor = (self.cursor..count).chain(0..count).find(free)?;
        } else {
            near?;
        }
        let word = near.unwrap_or(self.cursor);
        Some(self.take(word, self.words[word].trailing_zeros() as usize))
    }

    fn take(&mut self, word: usize, bit: usize) -> usize {
        self.words[word] &= !(1 << bit);
        self.free -= 1;
        word * 64 + bit
    }

    /// Gives a used slot back.
    pub(crate) fn give(&mut self, slot: usize) {
        let word = slot / 64;
        if self.words.len() <= word {
            self.words.resize(word + 1, 0);
        }
        debug_assert!(self.words[word] >> (slot % 64) & 1 == 0, "slot {slot} is given back twice");
        self.words[word] |= 1 << (slot % 64);
        self.free += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::Slots;

    #[test]
    fn slots_are_given_out_once_and_near() {
        let mut slots = Slots::where_free(1000, |slot| slot % 2 == 1);
        assert_eq!(slots.free(), 500);
        let mut taken: Vec<_> = std::iter::from_fn(|| slots.take_near(500)).collect();
        assert_eq!(taken[0] / 64, 500 / 64);
        assert!(taken.iter().all(|slot| slot % 2 == 1));
        // Far ones are given out only while one in eight is free.
        assert!(slots.free() > 0 && slots.free() * 8 < 1024);
        let near = taken.len();
        taken.extend(std::iter::from_fn(|| slots.take_near(900)));
        assert!(taken.len() > near);
        taken.sort_unstable();
        taken.dedup();
        assert_eq!(taken.len() + slots.free(), 500);
    }

    #[test]
    fn what_was_given_back_is_taken_again() {
        let mut slots = Slots::default();
        assert_eq!(slots.take_near(7), None);
        slots.give(130);
        assert_eq!(slots.take_near(140), Some(130));
        assert_eq!(slots.take_near(140), None);
    }
}
