//! Imprecise points: the tables of Devillers 2011, §5, for disjoint unit disks and balls, and for a scanned model.

use std::hint::black_box;

use delone::{
    Algorithm2, Algorithm3, Delaunay2, Delaunay3, Hierarchy, HintOrder, Hints2, Hints3, Imprecise, Locate,
    Work,
};
use delone_generators::{Kind, Kind3, Random, moved};

use super::plot::Plot;
use super::table::{Table, short};
use super::trials::Trials;
use super::{Error, Findings, Options, decades, timed};

const METHODS: [&str; 5] =
    ["hints, random order", "hints, spatial order", "spatial sort", "hierarchy", "divide and conquer"];

/// How many of them walk.
const WALKING: usize = 4;

/// What the paper found for so many points: nanoseconds a point by the methods above (the last is Triangle), triangles
/// visited, nanoseconds to preprocess, and instances that amortise it.
struct Published {
    points: usize,
    ns: &'static [f64],
    visited: &'static [f64],
    preprocessing: f64,
    instances: f64,
}

const fn published(points: usize, ns: &'static [f64], visited: &'static [f64], more: [f64; 2]) -> Published {
    Published { points, ns, visited, preprocessing: more[0], instances: more[1] }
}

const UNKNOWN: [f64; 2] = [f64::NAN; 2];
const PLANE: [Published; 6] = [
    published(1_000, &[900.0, 1000.0, 1100.0, 1800.0, 960.0], &[2.83, 2.82, 3.74, 24.0], [2000.0, f64::NAN]),
    published(10_000, &[880.0, 790.0, 850.0, 1600.0, 1120.0], &[2.8, 2.8, 3.63, 28.0], [1400.0, f64::NAN]),
    published(100_000, &[1200.0, 590.0, 830.0, 2800.0, 1050.0], &[2.77, 2.77, 3.71, 29.0], [1700.0, 15.0]),
    published(1_000_000, &[2900.0, 610.0, 900.0, 5780.0, 1610.0], &[2.75, 2.76, 3.67, 38.0], [2000.0, 7.0]),
    published(10_000_000, &[3800.0, 610.0, 1000.0, 9000.0, 2400.0], &[2.75, 2.75, 3.55, 45.0], [2300.0, 6.0]),
    published(100_000_000, &[5400.0, 620.0, 1130.0, 13_000.0], &[2.74, 2.75, 3.71, 47.0], [2700.0, 6.0]),
];
const SPACE: [Published; 3] = [
    published(100_000, &[14_200.0, 7800.0, 8000.0, 18_000.0], &[5.3, 4.5, 6.6, 34.0], UNKNOWN),
    published(1_000_000, &[19_000.0, 7900.0, 8200.0, 25_000.0], &[5.2, 4.5, 6.6, 42.0], UNKNOWN),
    published(10_000_000, &[23_000.0, 8000.0, 8400.0, 33_000.0], &[5.2, 4.4, 6.6, 50.0], UNKNOWN),
];
/// Its scanned models, Hand, Galaad and Neptune, have visits from 5.3 to 6.4 by hints in spatial order, and from 7.0 to 7.9
/// by spatial sort.
const SCAN: [Published; 0] = [];

/// What a method needs for one point: nanoseconds, and triangles visited if it walks.
#[derive(Clone, Default)]
struct Cost {
    ns: Trials,
    visited: Trials,
}

impl Cost {
    fn add(&mut self, n: usize, seconds: f64, visited: Option<u64>) {
        self.ns.add(seconds * 1e9 / n as f64);
        self.visited.extend(visited.map(|count| count as f64 / n as f64));
    }
}

/// What the methods cost, in their order, and nanoseconds a point to preprocess in spatial order.
#[derive(Default)]
struct Row {
    costs: [Cost; METHODS.len()],
    preprocessing: Trials,
}

/// The largest set that is triangulated several times.
const REPEATED: usize = 1_000_000;

/// The trials of a set of so many points, by number.
fn trials(options: &Options<'_>, n: usize) -> std::ops::Range<u64> {
    0..if n <= REPEATED { options.trials as u64 } else { 1 }
}

/// `delone experiment imprecise`.
pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let mut findings = Findings::default();
    let mut plane = Report::new("imprecise", "Disjoint unit disks", &METHODS, &PLANE);
    for n in decades(1000, options.largest) {
        let mut row = Row::default();
        for trial in trials(options, n) {
            let seed = options.seed + trial;
            let centres = Kind::Disks.points(n, seed);
            let instance = moved(&centres, 1.0, &mut Random::new(seed + 1));
            in_plane(&centres, &instance, seed, &mut row)?;
        }
        plane.row(n, row);
    }
    plane.finish(&mut findings);
    let title = "Disjoint unit balls in space";
    let mut space = Report::new("imprecise-space", title, &METHODS[..4], &SPACE);
    for n in decades(1000, options.largest / 10) {
        let mut row = Row::default();
        for trial in trials(options, n) {
            let seed = options.seed + trial;
            let centres = Kind3::Balls.points(n, seed);
            let instance = moved(&centres, 1.0, &mut Random::new(seed + 1));
            in_space(&centres, &instance, seed, &mut row)?;
        }
        space.row(n, row);
    }
    space.finish(&mut findings);
    Ok(findings)
}

/// `delone experiment scan`: noise around the points of a scanned model, as strong as points are from their hints.
pub(crate) fn scan(options: &Options<'_>) -> Result<Findings, Error> {
    let (largest, seed) = (options.largest, options.seed);
    let mut model = options.model.to_vec();
    if model.len() < 100 {
        return Err(Error::SmallModel(model.len()));
    }
    // Named by their place in the model, which is shuffled below.
    for (index, p) in model.iter().enumerate() {
        if let Some(axis) = p.iter().position(|x| !x.is_finite()) {
            return Err(delone::Error::NotFinite { index, axis, value: p[axis] }.into());
        }
    }
    let mut findings = Findings::default();
    let mut report = Report::new("scan", "Noisy samples of a scanned model", &METHODS[..4], &SCAN);
    let mut random = Random::new(seed);
    let most = model.len().min(largest);
    for n in decades(1000, most).take_while(|&n| n < most).chain([most]) {
        let mut row = Row::default();
        for _ in trials(options, n) {
            random.shuffle(&mut model);
            let centres = &model[..n];
            let hints = Hints3::from_points(centres, HintOrder::Spatial { seed })?;
            let far = hints.order().zip(hints.hints()).skip(1).map(|(i, j)| {
                let square: f64 = (0..3).map(|k| (centres[i][k] - centres[j][k]).powi(2)).sum();
                square.sqrt()
            });
            let radius = far.sum::<f64>() / n as f64;
            let instance = moved(centres, radius, &mut random);
            if instance.iter().flatten().any(|x| !x.is_finite()) {
                return Err(Error::WideModel);
            }
            in_space(centres, &instance, seed, &mut row)?;
        }
        report.row(n, row);
    }
    report.finish(&mut findings);
    Ok(findings)
}

/// The tables and the plot of a series of sets.
struct Report<'a> {
    title: String,
    name: &'a str,
    methods: &'a [&'a str],
    published: &'a [Published],
    times: Table,
    visits: Table,
    curves: Vec<Vec<(f64, f64)>>,
}

impl<'a> Report<'a> {
    fn new(name: &'a str, title: &str, methods: &'a [&'a str], published: &'a [Published]) -> Self {
        let heads = [&["points"], methods, &["preprocessing", "instances to amortise"]].concat();
        let times = format!("{title}: nanoseconds a point");
        let visits = format!("{title}: visited a point");
        Self {
            title: title.to_owned(),
            name,
            methods,
            published,
            times: Table::new(&format!("{name}-times"), &times, &heads),
            visits: Table::new(
                &format!("{name}-visited"),
                &visits,
                &[&["points"], &methods[..WALKING]].concat(),
            ),
            curves: vec![Vec::new(); methods.len()],
        }
    }

    fn row(&mut self, n: usize, Row { costs, preprocessing }: Row) {
        let costs = &costs[..self.methods.len()];
        let saved = costs[2].ns.mean() - costs[1].ns.mean();
        let instances = if saved > 0.0 { (preprocessing.mean() / saved).ceil() } else { f64::NAN };
        let times = costs.iter().map(|cost| cost.ns.to_string());
        let last = [preprocessing.to_string(), short(instances)];
        self.times.row(std::iter::once(n.to_string()).chain(times).chain(last));
        let visits = costs.iter().take(WALKING);
        self.visits.row(std::iter::once(n.to_string()).chain(visits.map(|cost| cost.visited.to_string())));
        if let Some(found) = self.published.iter().find(|found| found.points == n) {
            let name = format!("{n} in 2011");
            let missing = vec![f64::NAN; self.methods.len() - found.ns.len()];
            let ns = [found.ns, &missing, &[found.preprocessing, found.instances]].concat();
            self.times.row(std::iter::once(name.clone()).chain(ns.into_iter().map(short)));
            self.visits.row(std::iter::once(name).chain(found.visited.iter().copied().map(short)));
        }
        for (curve, cost) in self.curves.iter_mut().zip(costs) {
            curve.push((n as f64, cost.ns.mean()));
        }
    }

    fn finish(self, findings: &mut Findings) {
        let name = format!("{}-times", self.name);
        let mut plot = Plot::new(&name, &self.title, ["points n", "nanoseconds a point"]);
        for (method, curve) in self.methods.iter().zip(self.curves) {
            plot.curve(method, curve);
        }
        findings.tables.extend([self.times, self.visits]);
        findings.plots.push(plot);
    }
}

/// What an instance costs by hints, once there is memory from a first one, in which visits are counted.
fn by_hints<H>(
    n: usize,
    hints: &mut H,
    cost: &mut Cost,
    triangulate: impl Fn(&mut H, &mut Work) -> Result<(), delone::Error>,
) -> Result<(), Error> {
    let mut work = Work::default();
    triangulate(hints, &mut work)?;
    let (done, seconds) = timed(|| triangulate(hints, &mut Work::default()));
    done?;
    cost.add(n, seconds, Some(work.visited));
    Ok(())
}

fn hierarchy(seed: u64) -> Locate {
    Locate::Hierarchy(Hierarchy { seed, ..Hierarchy::default() })
}

fn in_plane(centres: &[[f64; 2]], instance: &[[f64; 2]], seed: u64, row: &mut Row) -> Result<(), Error> {
    let n = centres.len();
    let [random, spatial, direct @ ..] = &mut row.costs;
    for (order, cost) in [(HintOrder::Random { seed }, random), (HintOrder::Spatial { seed }, spatial)] {
        let (hints, seconds) = timed(|| Hints2::from_points(centres, order));
        if matches!(order, HintOrder::Spatial { .. }) {
            row.preprocessing.add(seconds * 1e9 / n as f64);
        }
        by_hints(n, &mut hints?, cost, |hints, work| {
            hints.triangulate_observed(instance, work).map(|d| _ = black_box(d.vertex_count()))
        })?;
    }
    let located = Algorithm2::Located { locate: hierarchy(seed), seed };
    for (algorithm, cost) in
        [Algorithm2::Incremental { seed }, located, Algorithm2::DivideAndConquer].into_iter().zip(direct)
    {
        let (d, seconds) = timed(|| Delaunay2::with_algorithm(instance, algorithm));
        cost.add(n, seconds, d?.counters().work().map(|work| work.visited));
    }
    Ok(())
}

fn in_space(centres: &[[f64; 3]], instance: &[[f64; 3]], seed: u64, row: &mut Row) -> Result<(), Error> {
    let n = centres.len();
    let [random, spatial, direct @ ..] = &mut row.costs;
    for (order, cost) in [(HintOrder::Random { seed }, random), (HintOrder::Spatial { seed }, spatial)] {
        let (hints, seconds) = timed(|| Hints3::from_points(centres, order));
        if matches!(order, HintOrder::Spatial { .. }) {
            row.preprocessing.add(seconds * 1e9 / n as f64);
        }
        by_hints(n, &mut hints?, cost, |hints, work| {
            hints.triangulate_observed(instance, work).map(|d| _ = black_box(d.vertex_count()))
        })?;
    }
    let located = Algorithm3::Located { locate: hierarchy(seed), seed };
    for (algorithm, cost) in [Algorithm3::Incremental { seed }, located].into_iter().zip(direct) {
        let (d, seconds) = timed(|| Delaunay3::with_algorithm(instance, algorithm));
        cost.add(n, seconds, d?.counters().work().map(|work| work.visited));
    }
    Ok(())
}
