//! Which vertex of a level of the hierarchy is which vertex of the level below, both ways.
//!
//! Source: Devillers, "Improved incremental randomized Delaunay triangulation", SoCG 1998, §2.1, where a vertex knows a
//! triangle on each of its levels. Here most vertices are on one level and know nothing of others: downwards there is an array, upwards a table of
//! places in an array, hashed by linear probing (Knuth, TAOCP 3, §6.4, algorithms L and R), which knows its keys from the
//! array downwards.
//!
//! Cost: O(1) expected; four bytes a vertex downwards, and 5.3 to 10.7 upwards.

use crate::ids::Place;

/// The smallest table.
const SMALLEST: usize = 8;

/// See the module.
#[derive(Clone, Debug, Default)]
pub(crate) struct Links {
    /// For each place of the level its place in the level below; the ghost where there is no vertex.
    down: Vec<Place>,
    /// Places of the level, each at or after the slot that the place below hashes to; ghosts are empty slots. The number of
    /// slots is a power of two, or zero.
    up: Vec<Place>,
    count: usize,
}

impl Links {
    /// The place below that of a vertex of the level.
    #[inline]
    pub(crate) fn below(&self, here: Place) -> Place {
        self.down[here.index()]
    }

    /// Links a place of the level with one below, neither linked yet.
    pub(crate) fn join(&mut self, here: Place, below: Place) {
        if self.down.len() <= here.index() {
            self.down.resize(here.index() + 1, Place::GHOST);
        }
        self.down[here.index()] = below;
        self.count += 1;
        // Three quarters full at most.
        if 4 * self.count > 3 * self.up.len() {
            self.hash((2 * self.up.len()).max(SMALLEST));
        } else {
            self.put(here);
        }
    }

    /// Cuts the link of a place below; returns the place of the level that it was linked with.
    pub(crate) fn cut(&mut self, below: Place) -> Option<Place> {
        let mut hole = self.slot_of(below)?;
        let here = self.up[hole];
        let mask = self.up.len() - 1;
        // What comes after moves into the hole, unless that is before the slot that it hashes to.
        let mut slot = hole;
        loop {
            slot = (slot + 1) & mask;
            let place = self.up[slot];
            if place.is_ghost() {
                break;
            }
            let home = self.home(self.below(place));
            if slot.wrapping_sub(home) & mask >= slot.wrapping_sub(hole) & mask {
                self.up[hole] = place;
                hole = slot;
            }
        }
        self.up[hole] = Place::GHOST;
        self.down[here.index()] = Place::GHOST;
        self.count -= 1;
        Some(here)
    }

    /// The level below was laid out anew: `moved` gives for each old place the new one.
    pub(crate) fn rearranged(&mut self, moved: &[Place]) {
        for below in self.down.iter_mut().filter(|below| !below.is_ghost()) {
            *below = moved[below.index()];
        }
        self.hash(self.up.len());
    }

    /// Memory in bytes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.down) + size_of_val(&*self.up)
    }

    /// The slot that a place below hashes to.
    fn home(&self, below: Place) -> usize {
        let bits = self.up.len().trailing_zeros();
        let hash = (below.index() as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        (hash >> (64 - bits)) as usize
    }

    /// The slot of the place that is linked with one below.
    fn slot_of(&self, below: Place) -> Option<usize> {
        if self.up.is_empty() {
            return None;
        }
        let mut slot = self.home(below);
        while !self.up[slot].is_ghost() {
            if self.below(self.up[slot]) == below {
                return Some(slot);
            }
            slot = (slot + 1) & (self.up.len() - 1);
        }
        None
    }

    fn put(&mut self, here: Place) {
        let mut slot = self.home(self.below(here));
        while !self.up[slot].is_ghost() {
            slot = (slot + 1) & (self.up.len() - 1);
        }
        self.up[slot] = here;
    }

    /// Makes the table upwards anew, with so many slots.
    fn hash(&mut self, slots: usize) {
        self.up = vec![Place::GHOST; slots];
        for here in (0..self.down.len()).map(Place::new) {
            if !self.below(here).is_ghost() {
                self.put(here);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::Links;
    use crate::ids::Place;
    use crate::order::random::SplitMix;

    /// As a map does it, over joins, cuts and new layouts at random; tables are small, so that they wrap around.
    #[test]
    fn links_are_a_map() {
        for seed in 0..200 {
            let mut random = SplitMix(seed);
            let mut links = Links::default();
            let mut up: BTreeMap<usize, usize> = BTreeMap::new();
            let most = 4 + random.below(60);
            for _ in 0..400 {
                let below = random.below(most);
                match up.get(&below).copied() {
                    None if up.len() < most => {
                        let here =
                            (0..=up.len()).find(|here| up.values().all(|other| other != here)).expect("free");
                        links.join(Place::new(here), Place::new(below));
                        up.insert(below, here);
                    }
                    here => {
                        let cut = links.cut(Place::new(below));
                        assert_eq!(cut.map(Place::index), here);
                        up.remove(&below);
                    }
                }
                if random.below(50) == 0 {
                    let mut moved: Vec<usize> = (0..most).collect();
                    random.shuffle(&mut moved);
                    links.rearranged(&moved.iter().map(|&p| Place::new(p)).collect::<Vec<_>>());
                    up = up.into_iter().map(|(below, here)| (moved[below], here)).collect();
                }
                assert!(up.iter().all(|(&below, &here)| links.below(Place::new(here)).index() == below));
                let other = Place::new(random.below(most));
                let there = links.slot_of(other).map(|slot| links.up[slot].index());
                assert_eq!(there, up.get(&other.index()).copied());
            }
        }
    }

    #[test]
    fn links_take_ten_to_fifteen_bytes() {
        let mut links = Links::default();
        for k in 0..10_000 {
            links.join(Place::new(k), Place::new(3 * k));
            let each = links.bytes() as f64 / (k + 1) as f64;
            assert!(k < 8 || (9.3..14.8).contains(&each), "{each} bytes for each of {k}");
        }
    }
}
