//! Tetrahedra by their scope: Lemmas 4.4 and 4.5, Theorems 4.6 and 4.7, the point that undoes a large triangulation, and
//! the triple that all spheres fear (Guibas, Knuth & Sharir 1992, §4.3).

use std::collections::BTreeMap;
use std::f64::consts::E;

use delone::{Change, Delaunay3, Triangulation};
use delone_generators::{Kind3, Random};
use delone_predicates::{Sign, in_sphere, orient3d};

use super::super::appear;
use super::super::plot::Plot;
use super::super::table::{Table, short};
use super::super::trials::Trials;
use super::super::{Error, Findings, Options};
use super::{ORDERS, first, in_orders};

/// Points of the set that is simulated.
const SIMULATED: usize = 12;
/// Points of the sets whose scopes are only counted. A sample of r = n / (k + 1) of them has r^2 / 2 tetrahedra at most, which
/// makes e / 2 of n^2 (k + 1)^2 by the argument of Lemma 2.5.
const COUNTED: [usize; 2] = [16, 32];
/// Points of which samples are triangulated for Theorem 4.7, at most.
const SAMPLED: usize = 400;
/// Orders in which they come, at least: when zeta comes decides almost all.
const SAMPLED_ORDERS: usize = 30;

pub(super) fn run(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    simulate(options, findings)?;
    findings.tables.push(growth(options));
    samples(options, findings)?;
    findings.tables.push(triples(options));
    Ok(())
}

/// The scope of each tetrahedron that is not flat: how many points are inside of its sphere.
fn scopes(points: &[[f64; 3]]) -> BTreeMap<[usize; 4], usize> {
    let n = points.len();
    let mut scopes = BTreeMap::new();
    for a in 0..n {
        for b in a + 1..n {
            for c in b + 1..n {
                for d in c + 1..n {
                    let [p, q, r, s] = [a, b, c, d].map(|i| points[i]);
                    let turn = orient3d(p, q, r, s);
                    if turn == Sign::Zero {
                        continue;
                    }
                    let is_inside = |&i: &usize| {
                        ![a, b, c, d].contains(&i) && (in_sphere(p, q, r, s, points[i]) * turn).is_positive()
                    };
                    scopes.insert([a, b, c, d], (0..n).filter(is_inside).count());
                }
            }
        }
    }
    scopes
}

/// How many tetrahedra have a scope of at most k, in units of n^2 (k + 1)^2: Lemma 4.5.
fn growth(options: &Options<'_>) -> Table {
    let title =
        "Tetrahedra of scope at most k, O(n^2 (k+1)^2) (Lemma 4.5); the constant is that of its proof";
    let heads = ["set", "points", "k", "tetrahedra", "in n^2 (k+1)^2", "by the proof"];
    let mut table = options.table("scopes-lemma-4-5", title, &heads);
    for n in COUNTED {
        for (set, points) in [("cube", Kind3::Cube.points(n, options.seed)), ("skew lines", skew_lines(n))] {
            let scopes = scopes(&points);
            for k in [0, 1, 2, 4, 8] {
                let total = scopes.values().filter(|&&scope| scope <= k).count();
                let units = total as f64 / (n * (k + 1)).pow(2) as f64;
                let names = [set.to_owned(), n.to_string(), k.to_string(), total.to_string()];
                table.row(names.into_iter().chain([short(units), short(E / 2.0)]));
            }
        }
    }
    table
}

/// How often tetrahedra of each scope appear.
fn simulate(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let points = Kind3::Cube.points(SIMULATED, options.seed);
    let scope_of = scopes(&points);
    let mut count = [0_usize; SIMULATED];
    scope_of.values().for_each(|&scope| count[scope] += 1);
    let mut appeared = [0_u64; SIMULATED];
    in_orders(SIMULATED, options.seed, |order| {
        appear::simplices::<Delaunay3>(&points, order, |corners, order| {
            appeared[scope_of[&appear::sorted(corners, order)]] += 1;
        })?;
        Ok(())
    })?;
    let title = format!(
        "How often a tetrahedron of scope k appears ({SIMULATED} points, {ORDERS} random orders; Lemma 4.4)"
    );
    let heads = ["k", "tetrahedra", "appeared", "24/((k+1)(k+2)(k+3)(k+4))"];
    let mut table = options.table("scopes-tetrahedra", &title, &heads);
    let mut plot = Plot::new(
        "scopes-tetrahedra",
        "The probability that a tetrahedron of scope k appears",
        ["k + 1", "probability"],
    );
    let (mut measured, mut expected) = (Vec::new(), Vec::new());
    for (k, &tetrahedra) in count.iter().enumerate().filter(|(_, tetrahedra)| **tetrahedra > 0) {
        let share = appeared[k] as f64 / (tetrahedra * ORDERS) as f64;
        table.row([k.to_string(), tetrahedra.to_string(), short(share), short(first(4, k))]);
        measured.push((k as f64 + 1.0, share));
        expected.push((k as f64 + 1.0, first(4, k)));
    }
    plot.curve("simulated", measured);
    plot.curve("24 / ((k+1)(k+2)(k+3)(k+4))", expected);
    findings.tables.push(table);
    findings.plots.push(plot);
    Ok(())
}

/// Half of so many points on each of two skew lines, less than half as far from the axis between them as that is long: all
/// spheres through neighbors on both lines hold its middle.
fn skew_lines(n: usize) -> Vec<[f64; 3]> {
    let half = n / 2;
    let at = |i: usize| 0.8 * ((i as f64 + 0.5) / half as f64 - 0.5);
    (0..n).map(|i| if i < half { [at(i), 0.0, 0.0] } else { [0.0, at(i - half), 1.0] }).collect()
}

/// The number that appears in all, beside the final size and the sum of Theorem 4.7 over the sizes of samples.
fn samples(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let mut table = options.table(
        "scopes-samples",
        "Tetrahedra that ever appear, beside the final size and the sum of F(n/k)/k (Theorems 4.6 and 4.7)",
        &["set", "points", "in the end", "appeared", "appeared / end", "sum of F(n/k)/k", "appeared / sum"],
    );
    let mut random = Random::new(options.seed);
    for n in [50, 100, 200, SAMPLED] {
        let zeta = skew_lines(n).into_iter().chain([[0.0, 0.0, 0.5]]).collect();
        let sets = [
            ("cube", Kind3::Cube.points(n, options.seed)),
            ("skew lines", skew_lines(n)),
            ("and zeta", zeta),
        ];
        for (name, points) in sets {
            let mut order: Vec<usize> = (0..points.len()).collect();
            let mut appeared = Trials::default();
            let mut end = 0;
            for _ in 0..SAMPLED_ORDERS.max(options.trials) {
                random.shuffle(&mut order);
                let mut count = 0_u64;
                end = appear::simplices::<Delaunay3>(&points, &order, |_, _| count += 1)?;
                appeared.add(count as f64);
            }
            let mut sum = 0.0;
            for k in 1..=points.len() / 4 {
                random.shuffle(&mut order);
                let sample = order[..points.len() / k].iter().map(|&i| points[i]).collect();
                sum += <Delaunay3 as Change>::from_vec(sample)?.simplex_count() as f64 / k as f64;
            }
            table.row([
                name.to_owned(),
                points.len().to_string(),
                end.to_string(),
                appeared.to_string(),
                short(appeared.mean() / end as f64),
                short(sum),
                short(appeared.mean() / sum),
            ]);
        }
    }
    findings.tables.push(table);
    Ok(())
}

/// The fewest points in any sphere through three, for the three for which these are the most.
fn triples(options: &Options<'_>) -> Table {
    let mut table = options.table(
        "scopes-triple",
        "Some triple has a share of all points in every sphere through it (§4.3)",
        &["points", "cube", "share"],
    );
    for n in [10, 20, 30] {
        let points = Kind3::Cube.points(n, options.seed);
        let mut most = 0;
        for a in 0..n {
            for b in a + 1..n {
                for c in b + 1..n {
                    most = most.max(fewest_in_spheres(&points, [a, b, c]));
                }
            }
        }
        table.row([n.to_string(), most.to_string(), short(most as f64 / n as f64)]);
    }
    table
}

/// The fewest points strictly inside of a sphere through three points: between two points that the spheres meet in their
/// sweep the number is constant, and each of those spheres has as many inside as one beside it.
fn fewest_in_spheres(points: &[[f64; 3]], [a, b, c]: [usize; 3]) -> usize {
    let (p, q, r) = (points[a], points[b], points[c]);
    let others: Vec<usize> = (0..points.len()).filter(|i| ![a, b, c].contains(i)).collect();
    let on_side = others.iter().filter(|&&i| orient3d(p, q, r, points[i]).is_positive()).count();
    let ends = on_side.min(others.len() - on_side);
    let inside = |&d: &usize| {
        let turn = orient3d(p, q, r, points[d]);
        let holds = |&i: &usize| i != d && (in_sphere(p, q, r, points[d], points[i]) * turn).is_positive();
        others.iter().filter(|i| holds(i)).count()
    };
    others.iter().map(inside).min().map_or(ends, |fewest| fewest.min(ends))
}
