//! The counterexample of the appendix (Figure 6): points for which phase 3 leads to a hub of linear degree.
//!
//! The set is `hub`. A query is the second point of a pair, left out of the set. If the first point of its pair is in the
//! sample, the nearest corner of the triangle around the query is the hub, or what is nearest to the hub in the sample; then the
//! search below turns through the hub's spokes or walks across them. The exact search by angles crosses them too, in
//! phase 3: from one triangle at the hub to the next, none of which has a corner in the disk of the proof of Lemma 5. The
//! triangles whose circles contain the query are few.

use delone::{Delaunay2, Hierarchy, Locate, Nearest, VertexId};
use delone_generators::Kind;

use super::count;
use crate::plot::Plot;
use crate::trials::Trials;
use crate::{Error, Findings, Options};

/// Of so many pairs one is asked for.
const ASKED: usize = 10;
/// Seeds of levels a trial.
const SEEDS: u64 = 4;

pub(super) fn run(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let title = "Triangles visited a query among points on a spiral into a hub, by phase 3 (Devillers 1998, appendix); mean \
                 and standard error over random samples";
    let heads = [
        "ratio",
        "points",
        "degree of the hub",
        "corner",
        "exact",
        "in-circle",
        "corner: lowest level",
        "exact: phase 3",
        "in-circle: phase 3",
    ];
    let mut table = options.table("tuning-counterexample", title, &heads);
    let mut plot =
        Plot::new("tuning-counterexample", "A hub misleads phase 3", ["points", "triangles visited"]);
    let variants = [
        ("nearest corner", Nearest::Corner),
        ("by angles", Nearest::Exact),
        ("by circles", Nearest::InCircle),
    ];
    for ratio in [2.0, 4.0] {
        let mut curves: [Vec<(f64, f64)>; 3] = Default::default();
        // Beyond 1,600 the range of numbers has no room for more pairs.
        for n in [100, 200, 400, 800, 1600].into_iter().filter(|&n| n <= options.largest) {
            let all = Kind::Hub.points(n, options.seed);
            // The second point of a pair has an even number.
            let is_asked = |i: &usize| *i > 0 && i % (2 * ASKED) == ASKED;
            let queries: Vec<[f64; 2]> = (0..n).filter(is_asked).map(|i| all[i]).collect();
            let points: Vec<[f64; 2]> = (0..n).filter(|i| !is_asked(i)).map(|i| all[i]).collect();
            let mut d = Delaunay2::from_points(&points)?;
            let degree = d.neighbors(VertexId::new(0)).count();
            let mut visited: [Trials; 3] = Default::default();
            let mut part: [Trials; 3] = Default::default();
            for seed in 0..options.trials as u64 * SEEDS {
                for (k, (_, nearest)) in variants.into_iter().enumerate() {
                    let seed = options.seed + seed;
                    let hierarchy = Hierarchy::only_levels().ratio(ratio).nearest(nearest).seed(seed);
                    d.set_strategy(Locate::Hierarchy(hierarchy))?;
                    let phases = count(&d, &queries)?;
                    let each = |total: u64| total as f64 / queries.len() as f64;
                    visited[k].add(each(phases.total().visited));
                    part[k].add(each(match nearest {
                        Nearest::Corner => phases.on(0).iter().map(|work| work.visited).sum(),
                        _ => (0..phases.levels()).map(|level| phases.on(level)[3].visited).sum(),
                    }));
                }
            }
            for (curve, trials) in curves.iter_mut().zip(&visited) {
                curve.push((n as f64, trials.mean()));
            }
            let counts = [ratio.to_string(), n.to_string(), degree.to_string()].into_iter();
            table.row(counts.chain(visited.iter().chain(&part).map(|trials| trials.to_string())));
        }
        for ((name, _), curve) in variants.into_iter().zip(curves) {
            plot.curve(&format!("ratio {ratio}: {name}"), curve);
        }
    }
    findings.tables.push(table);
    findings.plots.push(plot);
    Ok(())
}
