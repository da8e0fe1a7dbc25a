//! Proximity graphs by definition, of up to some dozens of points, in any dimension.
//!
//! Among the first of equal points: an edge is a pair of indices, the smaller first. Every pair is tried against all other
//! points, and lengths are integers.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use num_bigint::BigInt;

use crate::exact::integers;

/// Pairs of indices of points, each from the smaller to the larger.
pub type Pairs = BTreeSet<[usize; 2]>;

/// Points as integers on a common scale, those that equal an earlier one left out.
struct Sites<const D: usize> {
    indices: Vec<usize>,
    at: Vec<[BigInt; D]>,
}

impl<const D: usize> Sites<D> {
    fn of(points: &[[f64; D]]) -> Self {
        let at = integers(points);
        let indices = (0..at.len()).filter(|&i| !at[..i].contains(&at[i])).collect();
        Self { indices, at }
    }

    fn squared(&self, i: usize, j: usize) -> BigInt {
        (0..D).map(|k| (&self.at[i][k] - &self.at[j][k]).pow(2)).sum()
    }

    fn pairs(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let after = |&i: &usize| self.indices.iter().filter(move |&&j| j > i).map(move |&j| [i, j]);
        self.indices.iter().flat_map(after)
    }

    /// The pairs in whose way no third point is.
    fn unless(&self, is_in_the_way: impl Fn(usize, usize, usize) -> bool) -> Pairs {
        let is_clear =
            |&[i, j]: &[usize; 2]| !self.indices.iter().any(|&k| k != i && k != j && is_in_the_way(i, j, k));
        self.pairs().filter(is_clear).collect()
    }

    fn ends(&self, [i, j]: [usize; 2]) -> [&[BigInt; D]; 2] {
        let (p, q) = (&self.at[i], &self.at[j]);
        if p < q { [p, q] } else { [q, p] }
    }
}

/// Pairs whose closed ball with both ends on a diameter holds no other point: those further from its middle.
pub fn gabriel<const D: usize>(points: &[[f64; D]]) -> Pairs {
    let sites = Sites::of(points);
    sites.unless(|i, j, k| {
        // Twice the way from the middle.
        let way = |m: usize| (&sites.at[k][m] * 2_u8 - &sites.at[i][m] - &sites.at[j][m]).pow(2);
        (0..D).map(way).sum::<BigInt>() <= sites.squared(i, j)
    })
}

/// Pairs to which no other point is nearer, from both, than they are to each other.
pub fn relative_neighbors<const D: usize>(points: &[[f64; D]]) -> Pairs {
    let sites = Sites::of(points);
    sites.unless(|i, j, k| sites.squared(i, k).max(sites.squared(j, k)) < sites.squared(i, j))
}

/// Pairs whose open lune holds no other point: the meeting of two balls of radius beta |ij| / 2, with centers
/// (1 - beta/2) i + (beta/2) j and the same with i and j exchanged. For beta = 1 it is [`gabriel`].
pub fn beta_skeleton<const D: usize>(points: &[[f64; D]], beta: f64) -> Pairs {
    if beta == 1.0 {
        return gabriel(points);
    }
    // beta and one on one scale.
    let [[beta], [one]] = &integers(&[[beta], [1.0]])[..] else { unreachable!("two numbers") };
    let sites = Sites::of(points);
    let is_in_ball = |i: usize, j: usize, k: usize| {
        // 2 one (k - i) - beta (j - i), against beta (j - i).
        let way = |m: usize| {
            let at = |i: usize| &sites.at[i][m];
            ((at(k) - at(i)) * one * 2_u8 - (at(j) - at(i)) * beta).pow(2)
        };
        (0..D).map(way).sum::<BigInt>() < beta * beta * sites.squared(i, j)
    };
    sites.unless(|i, j, k| is_in_ball(i, j, k) && is_in_ball(j, i, k))
}

/// The spanning tree that is shortest edge by edge; of edges of one length that with the lexicographically smaller ends comes
/// first. By Prim: from the points reached so far always the first edge to another one.
pub fn spanning_tree<const D: usize>(points: &[[f64; D]]) -> Pairs {
    let sites = Sites::of(points);
    let order = |&p: &[usize; 2], &q: &[usize; 2]| -> Ordering {
        let by_length = sites.squared(p[0], p[1]).cmp(&sites.squared(q[0], q[1]));
        by_length.then_with(|| sites.ends(p).cmp(&sites.ends(q)))
    };
    let mut tree = Pairs::new();
    let mut reached: BTreeSet<usize> = sites.indices.iter().take(1).copied().collect();
    while let Some([i, j]) =
        sites.pairs().filter(|[i, j]| reached.contains(i) != reached.contains(j)).min_by(order)
    {
        reached.extend([i, j]);
        tree.insert([i, j]);
    }
    tree
}

/// Pairs of which one is among the k nearest of the other; equally near ones are taken in lexicographic order.
pub fn nearest<const D: usize>(points: &[[f64; D]], k: usize) -> Pairs {
    let sites = Sites::of(points);
    let mut pairs = Pairs::new();
    for &i in &sites.indices {
        let mut others: Vec<usize> = sites.indices.iter().copied().filter(|&j| j != i).collect();
        others.sort_by_cached_key(|&j| (sites.squared(i, j), sites.at[j].clone()));
        pairs.extend(others.into_iter().take(k).map(|j| [i.min(j), i.max(j)]));
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::{Pairs, beta_skeleton, gabriel, nearest, relative_neighbors, spanning_tree};

    #[test]
    fn a_square_and_its_middle() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let sides = Pairs::from([[0, 1], [1, 2], [2, 3], [0, 3]]);
        assert_eq!(gabriel(&square), sides);
        assert_eq!(relative_neighbors(&square), sides);
        // The last side in the order of ends closes the ring.
        assert_eq!(spanning_tree(&square), Pairs::from([[0, 1], [0, 3], [2, 3]]));
        assert_eq!(nearest(&square, 1), Pairs::from([[0, 3], [0, 1], [2, 3]]));
        let with_middle = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0], [1.0, 1.0]];
        let spokes = Pairs::from([[0, 4], [1, 4], [2, 4], [3, 4]]);
        assert_eq!(gabriel(&with_middle), spokes);
        assert_eq!(beta_skeleton(&with_middle, 1.5), spokes);
    }

    /// Two balls of a segment of length 2 meet at height sqrt(2 beta - 1).
    #[test]
    fn lunes_grow() {
        for (height, beta) in [(1.5, 1.625), (2.0, 2.5), (3.0, 5.0)] {
            let points = [[-1.0, 0.0], [1.0, 0.0], [0.0, height]];
            assert!(beta_skeleton(&points, beta).contains(&[0, 1]), "the border is outside");
            assert!(!beta_skeleton(&points, beta * (1.0 + f64::EPSILON)).contains(&[0, 1]));
        }
        let equilateral = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert_eq!(beta_skeleton(&equilateral, 2.0), relative_neighbors(&equilateral));
        assert_eq!(relative_neighbors(&equilateral).len(), 3);
    }
}
