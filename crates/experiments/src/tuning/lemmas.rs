//! The quantities that Lemmas 1, 3 and 5 bound for any set, measured beside the bounds.

use delone::{Delaunay2, Hierarchy, Locate, Nearest};
use delone_generators::{Kind, Random};

use super::{QUERIES, SETS, count};
use crate::trials::Trials;
use crate::{Error, Findings, Options};

/// Points in clusters, besides the five sets.
const CLUSTERS: (Kind, &str) = (Kind::Clusters, "clusters");

/// Two levels; queries are random points of the set, left out of it.
pub(super) fn run(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let title = "The lowest level of a hierarchy over points of any kind, and the bounds of the analysis (Devillers 1998, 3)";
    let heads = [
        "points",
        "set",
        "ratio",
        "degree of nearest",
        "Lemma 1",
        "edges crossed",
        "Lemma 3",
        "triangles of phase 3",
        "Lemma 5",
    ];
    let mut table = options.table("tuning-lemmas", title, &heads);
    let sets = || SETS.into_iter().chain([CLUSTERS]);
    for (n, (kind, name)) in options.ends(1_000, 30_000).flat_map(|n| sets().map(move |set| (n, set))) {
        for ratio in [4.0, 30.0] {
            let mut trials: [Trials; 3] = Default::default();
            for seed in options.seeds() {
                measure(kind, n, ratio, seed)?.into_iter().zip(&mut trials).for_each(|(x, t)| t.add(x));
            }
            let [degree, crossed, searched] = trials.map(|t| t.to_string());
            let bounds = [36.0, 24.0 * ratio + 3.0, 36.0 * ratio].map(|bound| bound.to_string());
            let [first, third, fifth] = bounds;
            table.row([
                n.to_string(),
                name.to_owned(),
                ratio.to_string(),
                degree,
                first,
                crossed,
                third,
                searched,
                fifth,
            ]);
        }
    }
    findings.tables.push(table);
    Ok(())
}

fn measure(kind: Kind, n: usize, ratio: f64, seed: u64) -> Result<[f64; 3], Error> {
    let asked = QUERIES.min(n / 2);
    let mut random = Random::new(seed);
    let mut points = kind.points(n + asked, seed);
    random.shuffle(&mut points);
    let queries = points.split_off(n);
    let d = Delaunay2::from_points(&points)?;
    // The sample beside the set, for the degree, which is no step of a search.
    let is_drawn = |_: &usize| random.unit() * ratio < 1.0;
    let sample: Vec<usize> = (0..n).filter(is_drawn).collect();
    let places: Vec<[f64; 2]> = sample.iter().map(|&i| points[i]).collect();
    let above = Delaunay2::from_points(&places)?;
    let mut degrees = 0;
    for &q in &queries {
        let nearest = above.nearest(q)?.map(|v| points[sample[v.index()]]);
        // Of equal points the first is the vertex.
        let below = nearest.map(|p| d.nearest(p)).transpose()?.flatten();
        degrees += below.map_or(0, |v| d.neighbors(v).count());
    }
    // Three levels, so that the middle one has phase 3.
    let hierarchy =
        Hierarchy::only_levels().ratio(ratio).levels(3).smallest_level(1).nearest(Nearest::Exact).seed(seed);
    let mut d = d;
    d.set_strategy(Locate::Hierarchy(hierarchy))?;
    let phases = count(&d, &queries)?;
    let each = |total: u64| total as f64 / queries.len() as f64;
    let crossed = (each(phases.on(0)[2].orientations) - 1.0) / 2.0;
    Ok([each(degrees as u64), crossed, each(phases.on(1)[3].visited)])
}
