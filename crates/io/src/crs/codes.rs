//! Kinds of systems by their numbers in the EPSG registry: GeoTIFF has a key for each kind. Cost: O(log n) each.

use super::registry::{COMPOUND, FEET, GEOGRAPHIC};

fn is_among(runs: &[(u16, u16)], code: u32) -> bool {
    let after = runs.partition_point(|run| u32::from(run.0) <= code);
    after.checked_sub(1).is_some_and(|at| code <= u32::from(runs[at].1))
}

/// Whether it is a system of longitude and latitude.
pub(super) fn is_geographic(code: u32) -> bool {
    is_among(GEOGRAPHIC, code)
}

/// Whether it is two systems in one number.
pub(super) fn is_compound(code: u32) -> bool {
    is_among(COMPOUND, code)
}

/// Whether a projected system or one of heights counts in feet.
pub(super) fn is_in_feet(code: u32) -> bool {
    is_among(FEET, code)
}

#[cfg(test)]
mod tests {
    use super::{COMPOUND, FEET, GEOGRAPHIC, is_compound, is_geographic, is_in_feet};

    #[test]
    fn runs_are_in_order_and_known_numbers_are_where_they_belong() {
        for runs in [GEOGRAPHIC, COMPOUND, FEET] {
            assert!(runs.iter().all(|run| run.0 <= run.1));
            assert!(runs.windows(2).all(|pair| pair[0].1 < pair[1].0));
        }
        assert!([4326, 4258, 4269, 4979, 6318, 7844, 4283].into_iter().all(is_geographic));
        assert!(
            [25_832, 3857, 2992, 32_633, 27_700, 2056, 4087].into_iter().all(|code| !is_geographic(code))
        );
        assert!([7405, 5555, 7415, 9518].into_iter().all(is_compound));
        assert!([4326, 25_832, 0, 70_000].into_iter().all(|code| !is_compound(code)));
        assert!([2992, 2263, 6360, 5702, 8228].into_iter().all(is_in_feet));
        assert!([25_832, 3857, 5703, 2056].into_iter().all(|code| !is_in_feet(code)));
    }
}
