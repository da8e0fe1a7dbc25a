//! Sorts whose inner loops are compiled once.
//!
//! The standard library compiles a sort anew for each type and each comparison, some forty functions a time: a hundred of them
//! were an eighth of the library's code. Where a sort is most of the work, it is worth that; the others come here.

use std::cmp::Ordering;

/// Up to so many items are sorted in place, by insertion: the bound of the standard library's sort for what it sorts so.
const INSERTION_MOST: usize = 20;

/// Sorts by a comparison; equal items keep their order. Cost: n log n comparisons, each a call that is not inlined, and 8 n bytes for
/// a moment; of up to 20 items n^2 / 4 comparisons on average, and no memory.
pub(crate) fn by<T>(items: &mut [T], compare: impl Fn(&T, &T) -> Ordering) {
    if items.len() <= INSERTION_MOST {
        for end in 1..items.len() {
            let mut at = end;
            while at > 0 && compare(&items[at], &items[at - 1]) == Ordering::Less {
                items.swap(at, at - 1);
                at -= 1;
            }
        }
        return;
    }
    let mut order: Vec<usize> = (0..items.len()).collect();
    sort_indices(&mut order, &|i, j| compare(&items[i], &items[j]));
    put_in_order(&mut order, &mut |i, j| items.swap(i, j));
}

/// Sorts by a key.
pub(crate) fn by_key<T, K: Ord>(items: &mut [T], key: impl Fn(&T) -> K) {
    by(items, |p, q| key(p).cmp(&key(q)));
}

fn sort_indices(order: &mut [usize], compare: &dyn Fn(usize, usize) -> Ordering) {
    order.sort_by(|&i, &j| compare(i, j));
}

/// Moves to each place the item whose index is there, cycle by cycle.
fn put_in_order(order: &mut [usize], swap: &mut dyn FnMut(usize, usize)) {
    for start in 0..order.len() {
        let mut at = start;
        while order[at] != start {
            let from = order[at];
            swap(at, from);
            order[at] = at;
            at = from;
        }
        order[at] = at;
    }
}

#[cfg(test)]
mod tests {
    use super::{INSERTION_MOST, by, by_key};

    #[test]
    fn sorted_as_the_standard_library_sorts() {
        for count in (0..=2 * INSERTION_MOST).chain([1000]) {
            for distinct in [1, 3, 1000] {
                let mut state = count as u64;
                let mut next = || {
                    state =
                        state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    state >> 33
                };
                let items: Vec<(u64, usize)> = (0..count).map(|i| (next() % distinct, i)).collect();
                let mut expected = items.clone();
                expected.sort_by_key(|item| std::cmp::Reverse(item.0));
                let mut found = items.clone();
                by(&mut found, |p, q| q.0.cmp(&p.0));
                assert_eq!(found, expected, "equal keys keep their order");
                let mut found = items;
                by_key(&mut found, |item| item.0);
                assert!(found.is_sorted(), "of {count} items with {distinct} keys");
            }
        }
    }
}
