//! Delta debugging: a small part of a list that still fails.
//!
//! Source: Zeller & Hildebrandt, "Simplifying and isolating failure-inducing input", TSE 2002, §3, by complements alone:
//! runs of items are left out, long ones first.

/// Indices of a part of a list of `count` items that still fails, from which no single item can be left out, unless it
/// was `late` before that. The whole list is taken to fail.
pub(crate) fn smallest(
    count: usize,
    late: impl Fn() -> bool,
    mut fails: impl FnMut(&[usize]) -> bool,
) -> Vec<usize> {
    let mut keep: Vec<usize> = (0..count).collect();
    let mut run = count.div_ceil(2).max(1);
    loop {
        let before = keep.len();
        let mut start = 0;
        while start < keep.len() && !late() {
            let end = (start + run).min(keep.len());
            let rest = [&keep[..start], &keep[end..]].concat();
            if fails(&rest) {
                keep = rest;
            } else {
                start = end;
            }
        }
        if late() || run == 1 && keep.len() == before {
            return keep;
        }
        run = run.div_ceil(2).min(keep.len().max(1));
    }
}

#[cfg(test)]
mod tests {
    use super::smallest;

    #[test]
    fn it_finds_the_items_that_matter() {
        let needed = [3, 50, 51, 97];
        let mut asked = 0;
        let found = smallest(
            100,
            || false,
            |keep| {
                asked += 1;
                needed.iter().all(|i| keep.contains(i))
            },
        );
        assert_eq!(found, needed);
        assert!(asked < 150, "{asked} questions");
    }

    #[test]
    fn no_item_can_be_left_out() {
        // Any three fail: the result has three.
        assert_eq!(smallest(64, || false, |keep| keep.len() >= 3).len(), 3);
        assert!(smallest(64, || false, |_| true).is_empty());
        assert!(smallest(0, || false, |_| true).is_empty());
    }

    #[test]
    fn time_is_bounded() {
        assert_eq!(smallest(64, || true, |_| true).len(), 64);
    }
}
