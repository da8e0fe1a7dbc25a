//! Edges by their symmetric scope: zig-zag paths, Lemmas 2.4 and 2.5, and the pair of §4.2.
//!
//! The circles through the ends of an edge sweep over all other points: those on the left leave one by one, those on the
//! right enter. The path of the numbers inside, right and left, decides how likely the edge is to appear.

use std::cmp::Ordering;

use delone_generators::Kind;
use delone_predicates::{in_circle, orient2d};

use super::super::appear;
use super::super::plot::Plot;
use super::super::table::{Table, short};
use super::super::{Error, Findings, Options};
use super::{ORDERS, in_orders, sets};

/// Points of the set that is simulated, and of the one whose scopes are only counted.
const SIMULATED: usize = 28;
const COUNTED: usize = 120;
/// Points of the sets on curves, where nearly all circles are decided by exact arithmetic.
const ON_CURVES: usize = 60;

/// The probability that one of two given points comes last of the two and before k others: a_k of the paper.
pub(super) fn a(k: usize) -> f64 {
    2.0 / ((k + 1) * (k + 2)) as f64
}

/// The probability with a third point before: b_k.
pub(super) fn b(k: usize) -> f64 {
    a(k) - a(k + 1)
}

/// The weight of a square of the grid of zig-zag paths, by the sum k of its coordinates.
fn c(k: usize) -> f64 {
    b(k) - b(k + 1)
}

/// The other points in the order in which the circles through x and y meet them, with their sides: true for a point on the
/// left, which leaves; false for one on the right, which enters.
pub(super) fn swept(points: &[[f64; 2]], x: usize, y: usize) -> Vec<(usize, bool)> {
    let (px, py) = (points[x], points[y]);
    let is_left = |&q: &usize| orient2d(px, py, points[q]).is_positive();
    let mut others: Vec<usize> = (0..points.len()).filter(|q| ![x, y].contains(q)).collect();
    others.sort_unstable_by(|p, q| {
        if p == q {
            return Ordering::Equal;
        }
        // Whether q is inside of the circle through x, y and p; if so it has entered, or is still to leave.
        let (u, v) = if is_left(p) { (px, py) } else { (py, px) };
        let is_inside = in_circle(u, v, points[*p], points[*q]).is_positive();
        if is_inside == is_left(q) { Ordering::Less } else { Ordering::Greater }
    });
    others.into_iter().map(|q| (q, is_left(&q))).collect()
}

/// The sides alone.
fn sweep(points: &[[f64; 2]], x: usize, y: usize) -> Vec<bool> {
    swept(points, x, y).into_iter().map(|(_, is_left)| is_left).collect()
}

/// The symmetric scope of an edge, and the probability that it appears, from its sweep (equation (4) of §2.2).
fn scope_and_probability(sweep: &[bool]) -> (usize, f64) {
    let mut left = sweep.iter().filter(|is_left| **is_left).count();
    let (mut right, mut scope) = (0, usize::MAX);
    // How far to the right each step down is, the last one first in the end.
    let mut steps = Vec::new();
    if left == right {
        scope = left;
    }
    for &is_left in sweep {
        if is_left {
            left -= 1;
            steps.push(right);
        } else {
            right += 1;
        }
        if left == right {
            scope = left;
        }
    }
    let probability = a(steps.len()) + steps.iter().rev().enumerate().map(|(k, x)| b(x + k)).sum::<f64>();
    (scope, probability)
}

/// The probability by the remark after formula (4): a(l) + a(r) - a(l + r), and the weights of all squares above the path.
fn by_squares(sweep: &[bool]) -> f64 {
    let left = sweep.iter().filter(|is_left| **is_left).count();
    let right = sweep.len() - left;
    // The row of the last step down is the lowest.
    let (mut entered, mut row, mut above) = (0, left, 0.0);
    for &is_left in sweep {
        if is_left {
            row -= 1;
            above += (entered..right).map(|column| c(column + row)).sum::<f64>();
        } else {
            entered += 1;
        }
    }
    a(left) + a(right) - a(left + right) + above
}

/// Scope and probability of all edges.
fn all(points: &[[f64; 2]]) -> Vec<([usize; 2], usize, f64)> {
    let n = points.len();
    let pairs = (0..n).flat_map(|x| (x + 1..n).map(move |y| [x, y]));
    pairs
        .map(|[x, y]| {
            let (scope, probability) = scope_and_probability(&sweep(points, x, y));
            ([x, y], scope, probability)
        })
        .collect()
}

pub(super) fn run(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let points = Kind::Uniform.points(SIMULATED, options.seed);
    let edges = all(&points);
    let mut scope_of = vec![vec![0; SIMULATED]; SIMULATED];
    for &([x, y], scope, _) in &edges {
        (scope_of[x][y], scope_of[y][x]) = (scope, scope);
    }
    let mut appeared = [0_u64; SIMULATED];
    in_orders(SIMULATED, options.seed, |order| {
        appear::edges(&points, order, |[x, y]| appeared[scope_of[x][y]] += 1)
    })?;
    let mut table = options.table(
        "scopes-edges",
        &format!(
            "How often an edge of symmetric scope w appears ({SIMULATED} points, {ORDERS} random orders; Lemma 2.4)"
        ),
        &[
            "w",
            "edges",
            "appeared",
            "by zig-zag paths",
            "by squares above them",
            "at most 2 a(w) - a(2w)",
            "at least a(2w)",
        ],
    );
    let mut plot = Plot::new(
        "scopes-edges",
        "The probability that an edge of symmetric scope w appears",
        ["w + 1", "probability"],
    );
    let mut curves: [Vec<(f64, f64)>; 4] = Default::default();
    let mut sums = [0.0; 3];
    for (w, &appeared) in appeared.iter().enumerate() {
        let of_scope: Vec<_> = edges.iter().filter(|(_, scope, _)| *scope == w).collect();
        if of_scope.is_empty() {
            continue;
        }
        let total = of_scope.len() as f64;
        let simulated = appeared as f64 / ORDERS as f64;
        let computed: f64 = of_scope.iter().map(|(.., probability)| probability).sum();
        let by_squares: f64 = of_scope.iter().map(|([x, y], ..)| by_squares(&sweep(&points, *x, *y))).sum();
        sums = [sums[0] + simulated, sums[1] + computed, sums[2] + by_squares];
        let bounds = [2.0 * a(w) - a(2 * w), a(2 * w)];
        let row = [simulated, computed, by_squares].map(|sum| short(sum / total));
        let cells =
            [vec![w.to_string(), of_scope.len().to_string()], row.to_vec(), bounds.map(short).to_vec()];
        table.row(cells.concat());
        let shown = [simulated / total, computed / total, bounds[0], bounds[1]];
        for (curve, value) in curves.iter_mut().zip(shown) {
            curve.push((w as f64 + 1.0, value));
        }
    }
    let [simulated, computed, by_squares] = sums.map(short);
    let sums = ["all", &edges.len().to_string(), &simulated, &computed, &by_squares, "-", "-"];
    table.row(sums.map(str::to_owned));
    for (name, curve) in
        ["simulated", "by zig-zag paths", "upper bound", "lower bound"].into_iter().zip(curves)
    {
        plot.curve(name, curve);
    }
    findings.tables.extend([table, growth(options), pairs(options)]);
    findings.plots.push(plot);
    Ok(())
}

/// How many edges have a scope of at most k, in units of n (k + 1).
fn growth(options: &Options<'_>) -> Table {
    let mut table = options.table(
        "scopes-lemma-2-5",
        "Edges of symmetric scope at most k; the analysis allows about 16 n (k+1) (Lemma 2.5)",
        &["set", "points", "k", "edges", "in units of n (k+1)", "bound"],
    );
    for (kind, n) in sets(COUNTED, ON_CURVES) {
        let edges = all(&kind.points(n, options.seed));
        for k in [0, 1, 2, 4, 8, 16, 32, 59].into_iter().filter(|&k| k < n / 2) {
            let total = edges.iter().filter(|(_, scope, _)| *scope <= k).count();
            let units = total as f64 / n as f64 / (k + 1) as f64;
            let names = [kind.name().to_owned(), n.to_string(), k.to_string(), total.to_string()];
            table.row(names.into_iter().chain([short(units), short(16.0)]));
        }
    }
    table
}

/// The fewest points in any circle through a pair, for the pair for which these are the most (§4.2).
fn pairs(options: &Options<'_>) -> Table {
    let mut table = options.table(
        "scopes-pair",
        "Some pair has a share of all points in every circle through it (§4.2)",
        &["points", "uniform", "uniform: share", "log-normal", "log-normal: share"],
    );
    for n in [15, 30, 60, COUNTED] {
        let mut cells = vec![n.to_string()];
        for kind in [Kind::Uniform, Kind::LogNormal] {
            let points = kind.points(n, options.seed);
            let pairs = (0..n).flat_map(|x| (x + 1..n).map(move |y| (x, y)));
            let fewest = |(x, y): (usize, usize)| {
                let sweep = sweep(&points, x, y);
                let mut inside = sweep.iter().filter(|is_left| **is_left).count();
                let mut fewest = inside;
                for is_left in sweep {
                    inside = if is_left { inside - 1 } else { inside + 1 };
                    fewest = fewest.min(inside);
                }
                fewest
            };
            let most = pairs.map(fewest).max().unwrap_or(0);
            cells.extend([most.to_string(), short(most as f64 / n as f64)]);
        }
        table.row(cells);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::{by_squares, scope_and_probability, sweep};

    /// The paper's order of the points around its edge N-B: L G A C E H J D M I K F, with A E J K F on the left.
    #[test]
    fn the_papers_edge() {
        let sweep: Vec<bool> = "LGACEHJDMIKF".chars().map(|c| "AEJKF".contains(c)).collect();
        let (scope, probability) = scope_and_probability(&sweep);
        assert_eq!(scope, 3);
        let b = |k: usize| 4.0 / ((k + 1) * (k + 2) * (k + 3)) as f64;
        let expected = b(7) + b(8) + b(6) + b(6) + b(6) + 2.0 / 42.0;
        assert!((probability - expected).abs() < 1e-12, "{probability} {expected}");
        assert!((by_squares(&sweep) - expected).abs() < 1e-12, "{expected}");
    }

    #[test]
    fn circles_through_an_edge() {
        // Left of the edge from (0, 0) to (0, 2) is x < 0. A far point leaves early, a near one late.
        let points = [[0.0, 0.0], [0.0, 2.0], [-9.0, 1.0], [-0.1, 1.0], [5.0, 1.0], [0.5, 1.1]];
        assert_eq!(sweep(&points, 0, 1), [true, false, false, true]);
        let delaunay = [[0.0, 0.0], [0.0, 2.0], [-3.0, 1.0], [3.0, 1.0]];
        assert_eq!(scope_and_probability(&sweep(&delaunay, 0, 1)).0, 0);
    }
}
