//! How much of what could be judged is judged: every case before a release, a part of them at each change.

use std::sync::OnceLock;

/// One case in so many at each change. Fewer cases find less, more take longer than a change can wait: thirteen faults, put into thirteen
/// modules on purpose, were each found by an eighth (November 2026).
const AT_EACH_CHANGE: usize = 8;

/// One case in so many is judged: `DELONE_PART`, which is 1 in `.ci/run --long`.
fn one_in() -> usize {
    static ONE_IN: OnceLock<usize> = OnceLock::new();
    *ONE_IN.get_or_init(|| {
        std::env::var("DELONE_PART").map_or(AT_EACH_CHANGE, |x| x.parse::<usize>().expect("a number").max(1))
    })
}

/// How many of so many cases to judge: at least one.
pub fn share(cases: usize) -> usize {
    cases.div_ceil(one_in())
}

/// Whether all cases are judged, large and slow ones too.
pub fn all_cases() -> bool {
    one_in() == 1
}

/// Whether a case is judged, by its number.
pub fn is_due(number: usize) -> bool {
    number.is_multiple_of(one_in())
}

/// Every case whose turn it is.
pub fn some_of<T>(cases: impl IntoIterator<Item = T>) -> impl Iterator<Item = T> {
    cases.into_iter().step_by(one_in())
}
