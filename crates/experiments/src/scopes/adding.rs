//! Edges that appear when points are added to a set that is there: Lemmas 2.7, 2.8 and 2.9 (Guibas, Knuth & Sharir 1992, §2.3).
//!
//! The set Q is there, and the points of P come in random order. Circles with points of Q inside will never be empty. So the
//! scope of an edge is the least k for which a circle through its ends has no point of Q and at most k points of P on each side.
//! The proof of Lemma 2.7 leaves out the event in which the first point met on the left is one of Q. It is counted here, as the
//! simulation shows that it must be, and the bound holds with it.

use delone_generators::{Kind, Random};

use super::super::appear;
use super::super::table::{Table, short};
use super::super::{Error, Findings, Options};
use super::edges::{a, b, swept};
use super::{ORDERS, in_orders};

/// Points of Q and of P: of the sets that are simulated, and of those whose scopes are only counted.
const SIMULATED: [usize; 2] = [6, 18];
const COUNTED: [usize; 2] = [20, 60];
/// The largest scope that is shown.
const SHOWN: usize = 6;
/// The lemmas give orders of growth. Constants by their proofs, in which a sample of r of the n points of P has 3 (m + r) edges
/// with Q at most, and r = n / (2k + 1): 12 e and 6 e.
const BOUNDS: [f64; 2] = [33.0, 16.0];

/// First the points of Q, then those of P.
fn sets([old, new]: [usize; 2], seed: u64) -> [(&'static str, Vec<[f64; 2]>); 4] {
    let of = |kind: Kind| {
        let mut points = kind.points(old + new, seed);
        Random::new(seed).shuffle(&mut points);
        points
    };
    // The rows for which Theorem 2.6 is tight, a hundredth off their lines, so that no three points are on one.
    let mut random = Random::new(seed);
    let mut off = |i: usize| 0.01 * random.unit() + if i < old { 0.0 } else { 1.0 };
    let along = |i: usize| if i < old { -1.0 - i as f64 } else { (i - old) as f64 + 1.0 };
    let rows = (0..old + new).map(|i| [along(i), off(i)]).collect();
    [
        ("uniform", of(Kind::Uniform)),
        ("ellipse", of(Kind::Ellipse)),
        ("parabola", of(Kind::Parabola)),
        ("two rows", rows),
    ]
}

/// An edge with a finite scope, and the probability that it appears.
struct Added {
    ends: [usize; 2],
    scope: usize,
    kind: Ends,
    probability: f64,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Ends {
    /// Both in P.
    New,
    /// One in P, one in Q.
    Mixed,
}

/// The scope of an edge, if it has one, and its probability by the events of the lemmas' proofs: when the last end comes, one
/// point on the left is there, and none that a circle between them would hold. A point of Q is there for certain.
fn scope_and_probability(swept: &[(usize, bool)], q: usize, kind: Ends) -> Option<(usize, f64)> {
    let is_old = |&(i, _): &(usize, bool)| i < q;
    let first = swept.iter().rposition(|p| p.1 && is_old(p)).map_or(0, |i| i + 1);
    let last = swept.iter().position(|p| !p.1 && is_old(p)).unwrap_or(swept.len());
    if first > last {
        return None;
    }
    // With so many others after the last end: a point of P on the left is before it, or none.
    let one = |others: usize| match kind {
        Ends::New => b(others),
        Ends::Mixed => a(others) / 2.0,
    };
    let none = |others: usize| match kind {
        Ends::New => a(others),
        Ends::Mixed => 1.0 / (others + 1) as f64,
    };
    let count = |range: &[(usize, bool)], left: bool| range.iter().filter(|p| p.1 == left).count();
    let inside = |at: usize| (count(&swept[at..], true), count(&swept[..at], false));
    let scope = (first..=last).map(inside).map(|(left, right)| left.max(right)).min()?;
    let mut probability = 0.0;
    for at in (first..last).filter(|&at| swept[at].1) {
        let (left, right) = inside(at);
        probability += one(left - 1 + right);
    }
    // All points of P on the left come later, or those beyond the last point of Q there.
    let (left, right) = inside(first);
    probability += none(left + right);
    Some((scope, probability))
}

fn all(points: &[[f64; 2]], q: usize) -> Vec<Added> {
    let n = points.len();
    let pairs = (0..n).flat_map(|x| (x.max(q - 1) + 1..n).map(move |y| [x, y]));
    let added = |ends: [usize; 2]| {
        let kind = if ends[0] < q { Ends::Mixed } else { Ends::New };
        let (scope, probability) = scope_and_probability(&swept(points, ends[0], ends[1]), q, kind)?;
        Some(Added { ends, scope, kind, probability })
    };
    pairs.filter_map(added).collect()
}

pub(super) fn run(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let title = format!(
        "Edges that appear when {} points P are added to {} points Q, by scope k ({ORDERS} random orders; Lemmas 2.7 and \
         2.8)",
        SIMULATED[1], SIMULATED[0]
    );
    let heads = [
        "set",
        "k",
        "P-P edges",
        "P-P: appeared",
        "P-P: computed",
        "4/((k+1)(k+2))",
        "P-Q edges",
        "P-Q: appeared",
        "P-Q: computed",
        "2/(k+1)",
    ];
    let mut table = options.table("scopes-adding", &title, &heads);
    for (set, points) in sets(SIMULATED, options.seed) {
        let [old, new] = SIMULATED;
        let edges = all(&points, old);
        let mut seen = vec![vec![0_u64; old + new]; old + new];
        let mut whole: Vec<usize> = (0..old + new).collect();
        in_orders(new, options.seed, |order| {
            whole[old..].iter_mut().zip(order).for_each(|(place, i)| *place = old + i);
            appear::edges(&points, &whole, |[x, y]| seen[x.min(y)][x.max(y)] += 1)
        })?;
        for k in 0..=SHOWN {
            let mut cells = vec![set.to_owned(), k.to_string()];
            for (kind, bound) in
                [(Ends::New, 4.0 / ((k + 1) * (k + 2)) as f64), (Ends::Mixed, 2.0 / (k + 1) as f64)]
            {
                let of: Vec<&Added> = edges.iter().filter(|e| e.kind == kind && e.scope == k).collect();
                let total = of.len() as f64;
                let appeared: u64 = of.iter().map(|e| seen[e.ends[0]][e.ends[1]]).sum();
                let computed: f64 = of.iter().map(|e| e.probability).sum();
                let numbers = [appeared as f64 / ORDERS as f64 / total, computed / total, bound].map(short);
                cells.extend([vec![of.len().to_string()], numbers.to_vec()].concat());
            }
            table.row(cells);
        }
    }
    findings.tables.extend([table, growth(options)]);
    Ok(())
}

/// How many edges have a scope of at most k.
fn growth(options: &Options<'_>) -> Table {
    let title = format!(
        "Edges of scope at most k when n = {} points P are added to m = {} points Q; constants by the proof of Lemma 2.9",
        COUNTED[1], COUNTED[0]
    );
    let heads = [
        "set",
        "k",
        "P-P edges",
        "in m (k+1)^2 + n (k+1)",
        "P-P: by the proof",
        "P-Q edges",
        "in m (k+1) + n",
        "P-Q: by the proof",
    ];
    let mut table = options.table("scopes-lemma-2-9", &title, &heads);
    for (set, points) in sets(COUNTED, options.seed) {
        let [m, n] = COUNTED;
        let edges = all(&points, m);
        for k in [0, 1, 2, 4, 8, 16] {
            let mut cells = vec![set.to_owned(), k.to_string()];
            let units = [m * (k + 1) * (k + 1) + n * (k + 1), m * (k + 1) + n];
            for ((kind, unit), bound) in [Ends::New, Ends::Mixed].into_iter().zip(units).zip(BOUNDS) {
                let total = edges.iter().filter(|e| e.kind == kind && e.scope <= k).count();
                cells.extend([total.to_string(), short(total as f64 / unit as f64), short(bound)]);
            }
            table.row(cells);
        }
    }
    table
}

#[cfg(test)]
mod tests {
    use super::{Ends, scope_and_probability};

    /// Points of Q have numbers below 2, those of P from 2 on; true is on the left.
    #[test]
    fn scopes_and_probabilities() {
        let of = |swept: &[(usize, bool)], kind| scope_and_probability(swept, 2, kind);
        // Nothing around: an edge of two new points is certain.
        assert_eq!(of(&[], Ends::New), Some((0, 1.0)));
        // A point of Q on the right enters before one on the left leaves.
        assert_eq!(of(&[(0, false), (1, true)], Ends::New), None);
        // They do not meet: a Delaunay edge. It is certain too.
        assert_eq!(of(&[(0, true), (1, false)], Ends::Mixed), Some((0, 1.0)));
        // One point of P on the right enters before one of Q leaves: both ends come before it, one of three orders of three.
        let (scope, probability) = of(&[(2, false), (0, true)], Ends::New).expect("finite");
        assert_eq!(scope, 1);
        assert!((probability - 1.0 / 3.0).abs() < 1e-12);
        // Of two the new end comes first in half of all orders.
        assert_eq!(of(&[(2, false), (0, true)], Ends::Mixed), Some((1, 0.5)));
        // Two of P, of symmetric scope 1: the probability of §2.2.
        let (_, probability) = of(&[(2, false), (3, true)], Ends::New).expect("finite");
        assert!((probability - super::b(1) - super::a(1)).abs() < 1e-12);
    }
}
