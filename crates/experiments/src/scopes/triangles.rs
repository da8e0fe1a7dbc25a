//! Triangles by their scope: Lemmas 2.1 and 2.2, Theorem 2.3.

use std::collections::BTreeMap;

use delone::Delaunay2;
use delone_generators::Kind;
use delone_predicates::{in_circle, orient2d};

use super::super::appear;
use super::super::plot::Plot;
use super::super::table::{Table, short};
use super::super::{Error, Findings, Options};
use super::{ORDERS, first, in_orders, sets};

/// Points of the set that is simulated, and of the one whose scopes are only counted.
const SIMULATED: usize = 24;
const COUNTED: usize = 90;
/// Points of the sets on curves, where nearly all circles are decided by exact arithmetic.
const ON_CURVES: usize = 45;
/// How many triangles of Figure 2, of 14 points, have each scope.
const FOURTEEN: [usize; 12] = [17, 32, 42, 44, 47, 44, 40, 33, 28, 18, 12, 7];

pub(super) fn run(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    simulate(options, findings)?;
    findings.tables.extend([growth(options), fourteen(options)]);
    Ok(())
}

/// The scope of each triangle: how many points are inside of its circle.
fn scopes(points: &[[f64; 2]]) -> BTreeMap<[usize; 3], usize> {
    let n = points.len();
    let mut scopes = BTreeMap::new();
    for a in 0..n {
        for b in a + 1..n {
            for c in b + 1..n {
                let turn = orient2d(points[a], points[b], points[c]);
                let is_inside = |&q: &usize| {
                    ![a, b, c].contains(&q)
                        && (in_circle(points[a], points[b], points[c], points[q]) * turn).is_positive()
                };
                scopes.insert([a, b, c], (0..n).filter(is_inside).count());
            }
        }
    }
    scopes
}

/// How many have each scope.
fn count(scopes: &BTreeMap<[usize; 3], usize>, points: usize) -> Vec<usize> {
    let mut count = vec![0; points - 2];
    scopes.values().for_each(|&k| count[k] += 1);
    count
}

/// How often triangles of each scope appear, and how many triangles and edges in all.
fn simulate(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let points = Kind::Uniform.points(SIMULATED, options.seed);
    let scope_of = scopes(&points);
    let count = count(&scope_of, SIMULATED);
    let mut appeared = [0_u64; SIMULATED - 2];
    let mut edges = 0_u64;
    in_orders(SIMULATED, options.seed, |order| {
        appear::simplices::<Delaunay2>(&points, order, |corners, order| {
            appeared[scope_of[&appear::sorted(corners, order)]] += 1;
        })?;
        appear::edges(&points, order, |_| edges += 1)
    })?;
    let mut table = options.table(
        "scopes-triangles",
        &format!(
            "How often a triangle of scope k appears ({SIMULATED} points, {ORDERS} random orders; Lemma 2.1)"
        ),
        &["k", "triangles", "appeared", "6/((k+1)(k+2)(k+3))"],
    );
    let mut plot = Plot::new(
        "scopes-triangles",
        "The probability that a triangle of scope k appears",
        ["k + 1", "probability"],
    );
    let (mut measured, mut expected) = (Vec::new(), Vec::new());
    for (k, &triangles) in count.iter().enumerate().filter(|(_, triangles)| **triangles > 0) {
        let share = appeared[k] as f64 / (triangles * ORDERS) as f64;
        table.row([k.to_string(), triangles.to_string(), short(share), short(first(3, k))]);
        measured.push((k as f64 + 1.0, share));
        expected.push((k as f64 + 1.0, first(3, k)));
    }
    plot.curve("simulated", measured);
    plot.curve("6 / ((k+1)(k+2)(k+3))", expected);
    let mut totals = options.table(
        "scopes-means",
        "What ever appears: simulated, computed from the scopes, and the bound of the analysis a point (Theorem 2.3)",
        &["", "simulated", "computed", "computed a point", "bound a point"],
    );
    let mean = |total: u64| total as f64 / ORDERS as f64;
    let rows = [("triangles", appeared.iter().sum(), 22.0), ("edges", edges, 65.0)];
    for ((what, simulated, bound), computed) in rows.into_iter().zip(means(&count)) {
        let numbers = [mean(simulated), computed, computed / SIMULATED as f64, bound].map(short);
        totals.row([vec![what.to_owned()], numbers.to_vec()].concat());
    }
    findings.tables.extend([table, totals]);
    findings.plots.push(plot);
    Ok(())
}

/// How many triangles have a scope of at most k, in units of n (k + 1)^2.
fn growth(options: &Options<'_>) -> Table {
    let mut table = options.table(
        "scopes-lemma-2-2",
        "Triangles of scope at most k; the analysis allows about 3.6 n (k+1)^2 (Lemma 2.2)",
        &["set", "points", "k", "triangles", "in units of n (k+1)^2", "bound"],
    );
    for (kind, n) in sets(COUNTED, ON_CURVES) {
        let count = count(&scopes(&kind.points(n, options.seed)), n);
        let mut total = 0;
        for (k, triangles) in count.into_iter().enumerate() {
            total += triangles;
            if [0, 1, 2, 4, 8, 16, 32, 64].contains(&k) {
                let units = total as f64 / n as f64 / ((k + 1) * (k + 1)) as f64;
                let names = [kind.name().to_owned(), n.to_string(), k.to_string(), total.to_string()];
                table.row(names.into_iter().chain([short(units), short(3.6)]));
            }
        }
    }
    table
}

/// The two means of Figure 2, by the numbers of triangles of each scope that the paper gives.
fn fourteen(options: &Options<'_>) -> Table {
    let mut table = options.table(
        "scopes-figure-2",
        "What ever appears of the 14 points of Figure 2, computed from the paper's scopes (§2.2)",
        &["", "computed", "paper"],
    );
    for ((what, paper), mean) in
        [("triangles", "34.592"), ("edges", "44.559")].into_iter().zip(means(&FOURTEEN))
    {
        table.row([what.to_owned(), format!("{mean:.3}"), paper.to_owned()]);
    }
    table
}

/// The expected numbers of triangles and of edges that ever appear, from the number of triangles of each scope.
///
/// The r-th point is a random one of the first r; it brings the edges at it, on average 2 / r times those of the
/// triangulation of r random points, which has as many edges as triangles and r - 1 more.
fn means(count: &[usize]) -> [f64; 2] {
    let n = count.len() + 2;
    let triangles = count.iter().enumerate().map(|(k, &c)| c as f64 * first(3, k)).sum();
    let mut edges = 0.0;
    for r in 2..=n {
        let of_sample: f64 = count.iter().enumerate().map(|(k, &c)| c as f64 * chosen(n, k, r)).sum();
        edges += 2.0 / r as f64 * (of_sample + (r - 1) as f64);
    }
    [triangles, edges]
}

/// The probability that of n points r random ones hold three given ones and none of k others.
fn chosen(n: usize, k: usize, r: usize) -> f64 {
    if r < 3 || n - k < r {
        return 0.0;
    }
    // binomial(n - k - 3, r - 3) / binomial(n, r)
    let corners: f64 = (0..3).map(|i| (r - i) as f64 / (n - i) as f64).product();
    let others: f64 = (0..k).map(|i| (n - r - i) as f64 / (n - 3 - i) as f64).product();
    corners * others
}

#[cfg(test)]
mod tests {
    use super::{FOURTEEN, chosen, means};

    #[test]
    fn means_of_a_triangle() {
        // Three points: one triangle of scope 0, three edges, each certain.
        let [triangles, edges] = means(&[1]);
        assert!((triangles - 1.0).abs() < 1e-12);
        assert!((edges - 3.0).abs() < 1e-12);
        assert!((chosen(5, 0, 5) - 1.0).abs() < 1e-12);
        assert!(chosen(5, 1, 5).abs() < 1e-12);
    }

    /// The paper's example of 14 points (§2.2): its numbers of triangles of each scope give its two means.
    #[test]
    fn knuths_fourteen_points() {
        let [triangles, edges] = means(&FOURTEEN);
        assert_eq!(format!("{triangles:.3} {edges:.3}"), "34.592 44.559");
    }
}
