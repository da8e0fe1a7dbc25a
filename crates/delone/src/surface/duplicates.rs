//! One height for each set of equal points. Only the rule `First` depends on their order.

/// Which height a place has at which there are several points.
///
/// ```
/// use delone::surface::Duplicates;
///
/// let points = [[0.0, 0.0], [1.0, 2.0], [0.0, 0.0]];
/// let mut heights = [5.0, 7.0, 3.0];
/// Duplicates::Lowest.settle_equal(&points, &mut heights);
/// assert_eq!(heights[..2], [3.0, 7.0]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Duplicates {
    /// The lowest.
    #[default]
    Lowest,
    /// That of the first point.
    First,
    /// The highest.
    Highest,
    /// The mean of all.
    Mean,
}

/// The height of one place by a rule, of which `First` alone depends on the order of its heights.
#[derive(Clone, Debug)]
pub struct Several {
    rule: Duplicates,
    height: f64,
    /// Of means.
    sum: Sum,
    count: u64,
}

impl Several {
    /// One height.
    pub fn new(rule: Duplicates, first: f64) -> Self {
        let mut sum = Sum::default();
        sum.add(first);
        Self { rule, height: first, sum, count: 1 }
    }

    /// Another height.
    pub fn add(&mut self, other: f64) {
        match self.rule {
            Duplicates::First => {}
            Duplicates::Mean => {
                self.sum.add(other);
                self.count += 1;
            }
            // Zero has two signs, and which one is left must not depend on the order.
            Duplicates::Lowest => self.height = lower(self.height, other),
            Duplicates::Highest => self.height = higher(self.height, other),
        }
    }

    /// The height by the rule.
    pub fn height(self) -> f64 {
        if self.rule == Duplicates::Mean { self.sum.rounded() / self.count as f64 } else { self.height }
    }
}

fn lower(a: f64, b: f64) -> f64 {
    if b.total_cmp(&a).is_lt() { b } else { a }
}

fn higher(a: f64, b: f64) -> f64 {
    if b.total_cmp(&a).is_gt() { b } else { a }
}

/// A sum that is rounded once, in the end, so that the order does not show: parts of increasing size that do not overlap
/// (Shewchuk, "Adaptive precision floating-point arithmetic", 1997).
#[derive(Clone, Debug, Default)]
struct Sum(Vec<f64>);

impl Sum {
    fn add(&mut self, mut x: f64) {
        let mut kept = 0;
        for k in 0..self.0.len() {
            let (sum, rest) = two_sum(x, self.0[k]);
            if rest != 0.0 {
                self.0[kept] = rest;
                kept += 1;
            }
            x = sum;
        }
        self.0.truncate(kept);
        self.0.push(x);
    }

    fn rounded(mut self) -> f64 {
        let mut high = self.0.pop().unwrap_or_default();
        while let Some(part) = self.0.pop() {
            let (sum, rest) = two_sum(high, part);
            high = sum;
            if rest != 0.0 {
                // Half of the last place was rounded to even: what is left below it decides.
                let below = self.0.last().copied().unwrap_or_default();
                let (up, more) = two_sum(high, 2.0 * rest);
                return if rest * below > 0.0 && more == 0.0 { up } else { high };
            }
        }
        high
    }
}

/// A rounded sum, and what it lacks.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

impl Duplicates {
    /// Gives each place its height. `pairs` are the points that equal an earlier one, with that one, by increasing index. O(pairs).
    pub fn settle(self, heights: &mut [f64], pairs: impl IntoIterator<Item = (usize, usize)>) {
        // Of means: the places that have several points.
        let mut means = std::collections::BTreeMap::new();
        for (point, place) in pairs {
            let (here, other) = (heights[place], heights[point]);
            match self {
                Self::First => {}
                Self::Lowest => heights[place] = lower(here, other),
                Self::Highest => heights[place] = higher(here, other),
                Self::Mean => means.entry(place).or_insert_with(|| Several::new(self, here)).add(other),
            }
        }
        means.into_iter().for_each(|(place, several)| heights[place] = several.height());
    }

    /// Settles points before equal ones are known; the first point of a place gets its height. O(n log n).
    pub fn settle_equal(self, points: &[[f64; 2]], heights: &mut [f64]) {
        self.settle(heights, equal(points));
    }

    /// Settles points where not the first of equal points is the vertex, as with weights: all `vertices` get the heights of their
    /// places. O(n log n).
    pub fn settle_at(
        self,
        points: &[[f64; 2]],
        vertices: impl IntoIterator<Item = usize>,
        heights: &mut [f64],
    ) {
        let pairs = equal(points);
        if pairs.is_empty() {
            return;
        }
        let mut settled = heights.to_vec();
        self.settle(&mut settled, pairs.iter().copied());
        for vertex in vertices {
            let pair = pairs.binary_search_by_key(&vertex, |pair| pair.0);
            heights[vertex] = settled[pair.map_or(vertex, |k| pairs[k].1)];
        }
    }
}

/// The points that equal an earlier one, with the first of these, by increasing index.
fn equal(points: &[[f64; 2]]) -> Vec<(usize, usize)> {
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
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules() {
        let pairs = [(2, 0), (3, 0), (4, 1)];
        for (rule, expected) in [
            (Duplicates::First, [3.0, 5.0]),
            (Duplicates::Lowest, [1.0, 4.0]),
            (Duplicates::Highest, [8.0, 5.0]),
            (Duplicates::Mean, [4.0, 4.5]),
        ] {
            let mut heights = [3.0, 5.0, 1.0, 8.0, 4.0];
            rule.settle(&mut heights, pairs);
            assert_eq!(heights[..2], expected, "{rule:?}");
        }
    }

    #[test]
    fn no_order_shows() {
        for (rule, expected) in [(Duplicates::Lowest, -0.0_f64), (Duplicates::Highest, 0.0)] {
            for mut heights in [[0.0, -0.0], [-0.0, 0.0]] {
                rule.settle(&mut heights, [(1, 0)]);
                assert_eq!(heights[0].to_bits(), expected.to_bits(), "{rule:?}");
            }
        }
        for mut heights in [[0.1, 1e16, 0.3, -1e16], [1e16, 0.3, -1e16, 0.1], [-1e16, 0.1, 0.3, 1e16]] {
            Duplicates::Mean.settle(&mut heights, [(1, 0), (2, 0), (3, 0)]);
            assert_eq!(heights[0], 0.1);
        }
        // A tie of the two largest parts, which a third one decides.
        let two = 2f64.powi(53);
        for mut heights in [[two, 1.0, 2f64.powi(-60)], [2f64.powi(-60), 1.0, two]] {
            Duplicates::Mean.settle(&mut heights, [(1, 0), (2, 0)]);
            assert_eq!(heights[0], (two + 2.0) / 3.0);
        }
    }

    #[test]
    fn equal_points_are_found() {
        let points = [[1.0, 0.0], [0.0, 2.0], [1.0, -0.0], [1.0, 1.0], [0.0, 2.0]];
        let mut heights = [3.0, 5.0, 1.0, 8.0, 4.0];
        Duplicates::Lowest.settle_equal(&points, &mut heights);
        assert_eq!(heights, [1.0, 4.0, 1.0, 8.0, 4.0]);
        let mut heights = [3.0, 5.0, 1.0, 8.0, 4.0];
        Duplicates::Highest.settle_at(&points, [2, 3, 4], &mut heights);
        assert_eq!(heights, [3.0, 5.0, 3.0, 8.0, 5.0]);
        Duplicates::First.settle_at(&points, [2, 1], &mut heights);
        assert_eq!(heights, [3.0, 5.0, 3.0, 8.0, 5.0]);
    }
}
