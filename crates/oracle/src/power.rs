//! Regular triangulations by definition: sites lifted to |p|^2 - w, and every simplex of them tried against every other site.
//!
//! Sites that span less than their space are judged in what they span. Ties are broken by raising sites, infinitesimally and
//! infinitely more the larger their points are.

use std::cmp::Ordering;

use num_bigint::BigInt;

use crate::exact::{common_exponent, integers, sign};

/// A point with a weight.
pub type Site<const D: usize> = ([f64; D], f64);

/// Lifted sites.
pub struct Lifted {
    /// For each site its coordinates, those that are needed to tell the points apart affinely, and its height.
    rows: Vec<Vec<BigInt>>,
    /// For each its number in the lexicographic order of the points.
    ranks: Vec<usize>,
}

pub(crate) fn determinant(rows: &[Vec<BigInt>]) -> BigInt {
    match rows {
        [] => BigInt::from(1),
        [row] => row[0].clone(),
        [first, ..] => {
            let mut sum = BigInt::ZERO;
            for (column, x) in first.iter().enumerate() {
                let rest: Vec<Vec<BigInt>> = rows[1..]
                    .iter()
                    .map(|row| {
                        row.iter().enumerate().filter(|(k, _)| *k != column).map(|(_, x)| x.clone()).collect()
                    })
                    .collect();
                let term = x * determinant(&rest);
                sum = if column % 2 == 0 { sum + term } else { sum - term };
            }
            sum
        }
    }
}

/// Points on one scale, weights on its square, and the binary exponent of the scale.
pub(crate) fn on_one_scale<const D: usize>(sites: &[Site<D>]) -> (Vec<[BigInt; D]>, Vec<BigInt>, i64) {
    let points: Vec<[f64; D]> = sites.iter().map(|site| site.0).collect();
    let weights: Vec<[f64; 1]> = sites.iter().map(|site| [site.1]).collect();
    // Exponents of what is one, for both.
    let (of_points, of_weights) = (common_exponent(&points) - 1075, common_exponent(&weights) - 1075);
    let finer = (of_points - of_weights.div_euclid(2)).max(0);
    let coarser = of_weights - 2 * (of_points - finer);
    let points = integers(&points).into_iter().map(|p| p.map(|x| x << finer)).collect();
    let weights = integers(&weights).into_iter().map(|[w]| w << coarser).collect();
    (points, weights, of_points - finer)
}

/// Whether each coordinate of a point is the nearest `f64` of the point with the same power to sites, one more than there are dimensions; of
/// two at one distance the even one. False for sites in a line, or a plane.
pub fn has_nearest_center<const D: usize>(sites: &[Site<D>], place: [f64; D]) -> bool {
    // What is beyond the largest number is as far away as another step.
    let [low, high] = [place.map(|x| x.next_down().max(f64::MIN)), place.map(|x| x.next_up().min(f64::MAX))];
    let (p, w, _) = on_one_scale(&[sites, &[(low, 0.0), (place, 0.0), (high, 0.0)]].concat());
    let [low, at, high] = [0, 1, 2].map(|k| &p[sites.len() + k]);
    // Twice the scalar product with the difference of two points is that of their lifts: by Cramer's rule.
    let lift = |k: usize| p[k].iter().map(|x| x * x).sum::<BigInt>() - &w[k];
    let rows: Vec<Vec<BigInt>> =
        (1..=D).map(|k| (0..D).map(|axis| (&p[k][axis] - &p[0][axis]) * 2).collect()).collect();
    let below = determinant(&rows);
    let (sign, is_flat) = (if below < BigInt::ZERO { -1 } else { 1 }, below == BigInt::ZERO);
    let below = below * sign;
    !is_flat
        && (0..D).all(|axis| {
            let mut replaced = rows.clone();
            replaced.iter_mut().enumerate().for_each(|(k, row)| row[axis] = lift(k + 1) - lift(0));
            let twice: BigInt = determinant(&replaced) * sign * 2;
            let is_even = place[axis].to_bits() & 1 == 0;
            let [least, most] = [low, high].map(|end| (&at[axis] + &end[axis]) * &below);
            let is_beyond = |end: &[BigInt; D]| end[axis] == at[axis];
            (twice > least || (is_even && twice == least) || is_beyond(low))
                && (twice < most || (is_even && twice == most) || is_beyond(high))
        })
}

/// The order of |q - p|^2 - w for two sites.
pub fn compare<const D: usize>(q: [f64; D], a: Site<D>, b: Site<D>) -> Ordering {
    let (points, weights, _) = on_one_scale(&[(q, 0.0), a, b]);
    let power = |k: usize| {
        let squares = (0..D).map(|axis| (&points[k][axis] - &points[0][axis]).pow(2));
        squares.sum::<BigInt>() - &weights[k]
    };
    power(1).cmp(&power(2))
}

impl Lifted {
    /// Lifts sites.
    pub fn new<const D: usize>(sites: &[Site<D>]) -> Self {
        let (points, weights, _) = on_one_scale(sites);
        let mut order: Vec<usize> = (0..sites.len()).collect();
        order.sort_by(|&i, &j| points[i].cmp(&points[j]));
        let mut ranks = vec![0; sites.len()];
        order.iter().enumerate().for_each(|(rank, &i)| ranks[i] = rank);
        let axes = faithful_axes(&points);
        let lift = |(p, w): (&[BigInt; D], BigInt)| {
            let square: BigInt = p.iter().map(|x| x * x).sum();
            axes.iter().map(|&axis| p[axis].clone()).chain([square - w]).collect()
        };
        Self { rows: points.iter().zip(weights).map(lift).collect(), ranks }
    }

    /// The dimension of the span of the points.
    pub fn dimension(&self) -> usize {
        self.rows.first().map_or(0, |row| row.len() - 1)
    }

    /// The orientation of as many sites as make a simplex.
    fn orientation(&self, simplex: &[usize]) -> i8 {
        sign(&determinant(&simplex.iter().map(|&i| self.row(i, false)).collect::<Vec<_>>()))
    }

    fn row(&self, i: usize, with_height: bool) -> Vec<BigInt> {
        let count = self.rows[i].len() - usize::from(!with_height);
        self.rows[i][..count].iter().cloned().chain([BigInt::from(1)]).collect()
    }

    /// Whether a site is below the plane through some others, as many as make a simplex: 1 if it is, -1 if it is above; 0 only
    /// where they are degenerate even when raised.
    pub fn is_below(&self, simplex: &[usize], q: usize, perturbed: bool) -> i8 {
        let all: Vec<usize> = simplex.iter().copied().chain([q]).collect();
        let constant = sign(&determinant(&all.iter().map(|&i| self.row(i, true)).collect::<Vec<_>>()));
        // Of a simplex of positive orientation, a site far above has the sign of its own term.
        let above = self.cofactor(&all, all.len() - 1);
        if constant != 0 || !perturbed {
            return -constant * above;
        }
        let mut descending: Vec<usize> = (0..all.len()).collect();
        descending.sort_by_key(|&k| std::cmp::Reverse(self.ranks[all[k]]));
        let first = descending.into_iter().map(|k| self.cofactor(&all, k)).find(|&cofactor| cofactor != 0);
        -first.unwrap_or(0) * above
    }

    /// The sign of the coefficient of the height of one site in the determinant of all.
    fn cofactor(&self, all: &[usize], k: usize) -> i8 {
        let others: Vec<usize> = all.iter().copied().filter(|&i| i != all[k]).collect();
        // The place of the height is the last but one of its row.
        let place = if (k + all.len()).is_multiple_of(2) { 1 } else { -1 };
        self.orientation(&others) * place
    }

    /// The simplices of the regular triangulation, as sorted lists of sorted indices; sites must differ.
    pub fn regular(&self) -> Vec<Vec<usize>> {
        let mut simplices = Vec::new();
        self.extend(&mut Vec::new(), &mut simplices);
        simplices
    }

    fn extend(&self, chosen: &mut Vec<usize>, simplices: &mut Vec<Vec<usize>>) {
        if chosen.len() == self.dimension() + 1 {
            let others = || (0..self.rows.len()).filter(|q| !chosen.contains(q));
            if self.orientation(chosen) != 0 && others().all(|q| self.is_below(chosen, q, true) < 0) {
                simplices.push(chosen.clone());
            }
            return;
        }
        for i in chosen.last().map_or(0, |last| last + 1)..self.rows.len() {
            chosen.push(i);
            self.extend(chosen, simplices);
            chosen.pop();
        }
    }
}

/// Axes onto which the points are projected without losing what they span.
fn faithful_axes<const D: usize>(points: &[[BigInt; D]]) -> Vec<usize> {
    let mut axes: Vec<usize> = Vec::new();
    for axis in 0..D {
        let wider: Vec<usize> = axes.iter().copied().chain([axis]).collect();
        if spans(points, &wider, &mut Vec::new()) {
            axes = wider;
        }
    }
    axes
}

/// Whether some points make a simplex as seen along some axes.
fn spans<const D: usize>(points: &[[BigInt; D]], axes: &[usize], chosen: &mut Vec<usize>) -> bool {
    let Some(origin) = points.first() else { return false };
    let differences =
        |i: usize| -> Vec<BigInt> { axes.iter().map(|&axis| &points[i][axis] - &origin[axis]).collect() };
    if chosen.len() == axes.len() {
        let rows: Vec<Vec<BigInt>> = chosen.iter().map(|&i| differences(i)).collect();
        return determinant(&rows) != BigInt::ZERO;
    }
    for i in chosen.last().map_or(1, |last| last + 1)..points.len() {
        chosen.push(i);
        let found = spans(points, axes, chosen);
        chosen.pop();
        if found {
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::Lifted;
    use crate::exact;

    #[test]
    fn it_is_the_definition_without_weights() {
        let square = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
        let lifted = Lifted::new(&square.map(|p| (p, 0.5)));
        for [a, b, c, d] in [[0, 1, 2, 3], [0, 1, 3, 2], [1, 3, 2, 0]] {
            let expected = exact::in_circle(square[a], square[b], square[c], square[d]);
            assert_eq!(lifted.is_below(&[a, b, c], d, true), expected, "{a} {b} {c} {d}");
            assert_eq!(lifted.is_below(&[a, b, c], d, false), 0);
        }
        // (1, 1) is raised out of the circle of the others.
        assert_eq!(lifted.regular(), [[0, 1, 2], [1, 2, 3]]);
    }

    #[test]
    fn flat_sets_are_judged_in_what_they_span() {
        let line = [0.0, 1.0, 2.0, 4.0].map(|x| ([x, 2.0 * x, 1.0], 0.0));
        let lifted = Lifted::new(&line);
        assert_eq!((lifted.dimension(), lifted.regular().len()), (1, 3));
        let mut heavy = line;
        heavy[1].1 = 30.0;
        // The first is in its disk, but at an end; the third is between.
        assert_eq!(Lifted::new(&heavy).regular(), [[0, 1], [1, 3]]);
    }
}
