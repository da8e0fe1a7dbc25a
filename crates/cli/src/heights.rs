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

/// The same for points of which nobody knows yet which are equal. O(n log n).
pub(crate) fn settle_equal(points: &[[f64; 2]], heights: &mut [f64], rule: DuplicatesName) {
    // Minus zero is zero.
    let key = |i: usize| points[i].map(|x| x + 0.0);
    let compare = |i: usize, j: usize| {
        let ([x, y], [u, v]) = (key(i), key(j));
        x.total_cmp(&u).then(y.total_cmp(&v))
    };
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_unstable_by(|&i, &j| compare(i, j).then(i.cmp(&j)));
    let runs = order.chunk_by(|&i, &j| compare(i, j).is_eq());
    let mut pairs: Vec<(usize, usize)> =
        runs.flat_map(|run| run[1..].iter().map(|&point| (point, run[0]))).collect();
    pairs.sort_unstable();
    settle(heights, pairs, rule);
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

    #[test]
    fn equal_points_are_found() {
        let points = [[1.0, 0.0], [0.0, 2.0], [1.0, -0.0], [1.0, 1.0], [0.0, 2.0]];
        let mut heights = [3.0, 5.0, 1.0, 8.0, 4.0];
        settle_equal(&points, &mut heights, DuplicatesName::Lowest);
        assert_eq!(heights, [1.0, 4.0, 1.0, 8.0, 4.0]);
    }
}
