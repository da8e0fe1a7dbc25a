//! Heights of points that others are at too.

use crate::args::DuplicatesName;

/// Gives each place the height that a rule says. `pairs` are the points that equal an earlier one, with that one, by increasing index.
pub(crate) fn settle(
    heights: &mut [f64],
    pairs: impl IntoIterator<Item = (usize, usize)>,
    rule: DuplicatesName,
) {
    // Of means: the places that have several points, with their sums and counts.
    let mut sums = std::collections::BTreeMap::new();
    for (point, place) in pairs {
        let other = heights[point];
        match rule {
            DuplicatesName::First => {}
            DuplicatesName::Lowest => heights[place] = heights[place].min(other),
            DuplicatesName::Highest => heights[place] = heights[place].max(other),
            DuplicatesName::Mean => {
                let entry = sums.entry(place).or_insert((heights[place], 1_u32));
                *entry = (entry.0 + other, entry.1 + 1);
            }
        }
    }
    sums.into_iter().for_each(|(place, (sum, count))| heights[place] = sum / f64::from(count));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules() {
        let pairs = [(2, 0), (3, 0), (4, 1)];
        for (rule, expected) in [
            (DuplicatesName::First, [3.0, 5.0]),
            (DuplicatesName::Lowest, [1.0, 4.0]),
            (DuplicatesName::Highest, [8.0, 5.0]),
            (DuplicatesName::Mean, [4.0, 4.5]),
        ] {
            let mut heights = [3.0, 5.0, 1.0, 8.0, 4.0];
            settle(&mut heights, pairs, rule);
            assert_eq!(heights[..2], expected, "{rule:?}");
        }
    }
}
