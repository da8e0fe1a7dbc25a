//! Free slots among used ones, found near where they are wanted: neighbours in the plane stay neighbours in
//! memory.
//!
//! Cost: O(1); one bit a slot.

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
    /// Slot i of `count` becomes slot 2i, and those between are free.
    pub(crate) fn spread(&mut self, count: usize) {
        self.words.resize(count.div_ceil(64), 0);
        self.words =
            self.words.iter().flat_map(|&w| [odd_bits(w as u32), odd_bits((w >> 32) as u32)]).collect();
        self.words.truncate((2 * count).div_ceil(64));
        if !(2 * count).is_multiple_of(64)
            && let Some(last) = self.words.last_mut()
        {
            *last &= (1 << (2 * count % 64)) - 1;
        }
        self.free += count;
        self.cursor = 0;
    }

    /// The number of free slots.
    pub(crate) fn free(&self) -> usize {
        self.free
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

/// A word whose even bits are those of half a word, and whose odd bits are set.
fn odd_bits(half: u32) -> u64 {
    let mut w = u64::from(half);
    w = (w | w << 16) & 0x0000_ffff_0000_ffff;
    w = (w | w << 8) & 0x00ff_00ff_00ff_00ff;
    w = (w | w << 4) & 0x0f0f_0f0f_0f0f_0f0f;
    w = (w | w << 2) & 0x3333_3333_3333_3333;
    w = (w | w << 1) & 0x5555_5555_5555_5555;
    w | 0xaaaa_aaaa_aaaa_aaaa
}

#[cfg(test)]
mod tests {
    use super::Slots;

    #[test]
    fn slots_are_given_out_once_and_near() {
        let mut slots = Slots::default();
        slots.spread(500);
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
