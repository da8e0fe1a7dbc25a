//! `delone-lab experiment deletion`: what removing random vertices costs, with and without a hierarchy.
//!
//! Source: Devillers 1998, §5.1: the deletion of a random point takes expected constant time, since its degree and the number
//! of its levels are constant.

use delone::{Ask, Change, Delaunay2, Hierarchy, Locate, Walk, Work};
use delone_generators::{Kind, Random};

use super::trials::Trials;
use super::{Error, Findings, Options, decades, timed};

/// Vertices that are removed, unless half of the set is fewer.
const REMOVED: usize = 20_000;

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let mut table = options.table(
        "deletion",
        "A random vertex of a random set is removed (Devillers 1998, 5.1): in-circle tests, triangles, nanoseconds",
        &[
            "points",
            "in-circle tests",
            "new triangles",
            "ns",
            "ratio 30: in-circle tests",
            "ratio 30: ns",
            "ratio 4: in-circle tests",
            "ratio 4: ns",
        ],
    );
    for n in decades(1_000, options.largest) {
        let mut trials: [Trials; 7] = Default::default();
        for seed in options.seeds() {
            let hierarchy = |ratio| Locate::Hierarchy(Hierarchy::default().ratio(ratio).seed(seed));
            let (plain, ns) = remove(n, Locate::Walk(Walk::Visibility), seed)?;
            let (low, low_ns) = remove(n, hierarchy(30.0), seed)?;
            let (steep, steep_ns) = remove(n, hierarchy(4.0), seed)?;
            let each = |count: u64| count as f64 / REMOVED.min(n / 2) as f64;
            let values = [
                each(plain.in_circles),
                each(plain.created),
                ns,
                each(low.in_circles),
                low_ns,
                each(steep.in_circles),
                steep_ns,
            ];
            trials.iter_mut().zip(values).for_each(|(trial, value)| trial.add(value));
        }
        table.row([n.to_string()].into_iter().chain(trials.map(|trial| trial.to_string())));
    }
    Ok(Findings { tables: vec![table], plots: Vec::new() })
}

/// Removes vertices in random order: the work of all, and the nanoseconds of one.
fn remove(n: usize, locate: Locate, seed: u64) -> Result<(Work, f64), Error> {
    let points = Kind::Uniform.points(n, seed);
    let mut d = Delaunay2::from_points(&points)?;
    d.set_strategy(locate)?;
    d.find(points[0])?; // makes the levels
    let mut vertices: Vec<_> = d.vertices().collect();
    Random::new(seed).shuffle(&mut vertices);
    vertices.truncate(REMOVED.min(n / 2));
    let mut copy = d.clone();
    let (outcome, seconds) = timed(|| vertices.iter().try_for_each(|&v| copy.remove(v)));
    outcome?;
    let mut work = Work::default();
    vertices.iter().try_for_each(|&v| d.remove_observed(v, &mut work))?;
    Ok((work, seconds * 1e9 / vertices.len() as f64))
}
