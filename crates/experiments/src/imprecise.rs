//! Imprecise points: the tables of Devillers 2011, §5, for disjoint unit disks and balls, and for a scanned model.

use std::hint::black_box;

use delone::{
    Algorithm2, Algorithm3, Counters, Delaunay2, Delaunay3, Hierarchy, HintOrder, Hints2, Hints3, Imprecise,
    Locate, Work,
};
use delone_generators::{Kind, Kind3, Random};

use super::plot::Plot;
use super::table::{Table, short};
use super::{Error, Findings, Options, timed};

const METHODS: [&str; 5] =
    ["hints, random order", "hints, spatial order", "spatial sort", "hierarchy", "divide and conquer"];

/// What the paper found: nanoseconds a point by the methods above (the last is Triangle), to preprocess, and instances
/// that amortise it.
type Published = (usize, &'static [f64], Option<f64>, Option<u32>);
const PLANE: [Published; 5] = [
    (1_000, &[900.0, 1000.0, 1100.0, 1800.0, 960.0], Some(2000.0), None),
    (10_000, &[880.0, 790.0, 850.0, 1600.0, 1120.0], Some(1400.0), None),
    (100_000, &[1200.0, 590.0, 830.0, 2800.0, 1050.0], Some(1700.0), Some(15)),
    (1_000_000, &[2900.0, 610.0, 900.0, 5780.0, 1610.0], Some(2000.0), Some(7)),
    (10_000_000, &[3800.0, 610.0, 1000.0, 9000.0, 2400.0], Some(2300.0), Some(6)),
];
const SPACE: [Published; 2] = [
    (100_000, &[14_200.0, 7800.0, 8000.0, 18_000.0], None, None),
    (1_000_000, &[19_000.0, 7900.0, 8200.0, 25_000.0], None, None),
];
/// Visited a point by the first three methods, for any number of points.
const PLANE_VISITED: [f64; 3] = [2.8, 2.8, 3.7];
const SPACE_VISITED: [f64; 3] = [5.25, 4.5, 6.6];
/// The smallest of the scanned models, 53 thousand points.
const SCAN: [Published; 0] = [];
const SCAN_VISITED: [f64; 3] = [f64::NAN, 6.1, 7.6];

/// A random point of the unit ball of D dimensions.
fn in_ball<const D: usize>(random: &mut Random) -> [f64; D] {
    loop {
        let mut u = [0.0; D];
        u.iter_mut().for_each(|x| *x = random.between(-1.0, 1.0));
        if u.iter().map(|x| x * x).sum::<f64>() <= 1.0 {
            return u;
        }
    }
}

/// Each point moved randomly inside of a ball around it.
pub(crate) fn moved<const D: usize>(points: &[[f64; D]], radius: f64, random: &mut Random) -> Vec<[f64; D]> {
    let shift = |p: &[f64; D]| {
        let (mut q, u) = (*p, in_ball::<D>(random));
        q.iter_mut().zip(u).for_each(|(x, u)| *x += radius * u);
        q
    };
    points.iter().map(shift).collect()
}

/// What a method needs for one point: nanoseconds, and triangles visited if it walks.
#[derive(Clone, Copy)]
struct Cost {
    ns: f64,
    visited: Option<f64>,
}

impl Cost {
    fn of(n: usize, seconds: f64, visited: Option<u64>) -> Self {
        Self { ns: seconds * 1e9 / n as f64, visited: visited.map(|count| count as f64 / n as f64) }
    }
}

/// What the methods cost, and nanoseconds a point to preprocess in spatial order.
type Row = (Vec<Cost>, f64);

/// `delone experiment imprecise`.
pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let (largest, seed) = (options.largest, options.seed);
    let mut findings = Findings::default();
    let sizes = |most: usize| (3..).map(|k| 10_usize.pow(k)).take_while(move |&n| n <= most);
    let mut plane = Report::new("imprecise", "Disjoint unit disks", &METHODS, &PLANE, &PLANE_VISITED);
    for n in sizes(largest) {
        let centres = Kind::Disks.points(n, seed);
        let instance = moved(&centres, 1.0, &mut Random::new(seed + 1));
        plane.row(n, &in_plane(&centres, &instance, seed)?);
    }
    plane.finish(&mut findings);
    let title = "Disjoint unit balls in space";
    let mut space = Report::new("imprecise-space", title, &METHODS[..4], &SPACE, &SPACE_VISITED);
    for n in sizes(largest / 10) {
        let centres = Kind3::Balls.points(n, seed);
        let instance = moved(&centres, 1.0, &mut Random::new(seed + 1));
        space.row(n, &in_space(&centres, &instance, seed)?);
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
    let mut findings = Findings::default();
    let mut report =
        Report::new("scan", "Noisy samples of a scanned model", &METHODS[..4], &SCAN, &SCAN_VISITED);
    let mut random = Random::new(seed);
    random.shuffle(&mut model);
    let most = model.len().min(largest);
    let sizes = (3..).map(|k| 10_usize.pow(k)).take_while(|&n| n < most).chain([most]);
    for n in sizes {
        let centres = &model[..n];
        let hints = Hints3::from_points(centres, HintOrder::Spatial { seed })?;
        let far = hints.order().zip(hints.hints()).skip(1).map(|(i, j)| {
            let square: f64 = (0..3).map(|k| (centres[i][k] - centres[j][k]).powi(2)).sum();
            square.sqrt()
        });
        let radius = far.sum::<f64>() / n as f64;
        let instance = moved(centres, radius, &mut random);
        report.row(n, &in_space(centres, &instance, seed)?);
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
    published_visits: &'a [f64],
    times: Table,
    visits: Table,
    curves: Vec<Vec<(f64, f64)>>,
}

/// A number, if there is one.
fn known(value: f64) -> String {
    if value.is_nan() { "-".to_owned() } else { short(value) }
}

impl<'a> Report<'a> {
    fn new(
        name: &'a str,
        title: &str,
        methods: &'a [&'a str],
        published: &'a [Published],
        published_visits: &'a [f64],
    ) -> Self {
        let heads = [&["points"], methods, &["preprocessing", "instances to amortise"]].concat();
        let times = format!("{title}: nanoseconds a point");
        let visits = format!("{title}: visited a point");
        Self {
            title: title.to_owned(),
            name,
            methods,
            published,
            published_visits,
            times: Table::new(&format!("{name}-times"), &times, &heads),
            visits: Table::new(
                &format!("{name}-visited"),
                &visits,
                &[&["points"], &methods[..published_visits.len()]].concat(),
            ),
            curves: vec![Vec::new(); methods.len()],
        }
    }

    fn row(&mut self, n: usize, (costs, preprocessing): &Row) {
        let saved = costs[2].ns - costs[1].ns;
        let instances = if saved > 0.0 { (preprocessing / saved).ceil() } else { f64::NAN };
        let times = costs.iter().map(|cost| cost.ns).chain([*preprocessing, instances]);
        self.times.row(std::iter::once(n.to_string()).chain(times.map(known)));
        if let Some((_, ns, preprocessing, instances)) = self.published.iter().find(|row| row.0 == n) {
            let more = [*preprocessing, instances.map(f64::from)].map(|value| value.unwrap_or(f64::NAN));
            let cells = ns.iter().copied().chain(more).map(known);
            self.times.row(std::iter::once(format!("{n} in 2011")).chain(cells));
        }
        let visits = costs.iter().take(self.published_visits.len());
        let visits = visits.map(|cost| known(cost.visited.unwrap_or(f64::NAN)));
        self.visits.row(std::iter::once(n.to_string()).chain(visits));
        for (curve, cost) in self.curves.iter_mut().zip(costs) {
            curve.push((n as f64, cost.ns));
        }
    }

    fn finish(mut self, findings: &mut Findings) {
        let visits = self.published_visits.iter().copied().map(known);
        self.visits.row(std::iter::once("in 2011".to_owned()).chain(visits));
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
    triangulate: impl Fn(&mut H, &mut Work) -> Result<(), delone::Error>,
) -> Result<Cost, Error> {
    let mut work = Work::default();
    triangulate(hints, &mut work)?;
    let (done, seconds) = timed(|| triangulate(hints, &mut Work::default()));
    done?;
    Ok(Cost::of(n, seconds, Some(work.visited)))
}

fn hierarchy(seed: u64) -> Locate {
    Locate::Hierarchy(Hierarchy { seed, ..Hierarchy::default() })
}

fn in_plane(centres: &[[f64; 2]], instance: &[[f64; 2]], seed: u64) -> Result<Row, Error> {
    let n = centres.len();
    let mut costs = Vec::new();
    let mut preprocessing = 0.0;
    for order in [HintOrder::Random { seed }, HintOrder::Spatial { seed }] {
        let (hints, seconds) = timed(|| Hints2::from_points(centres, order));
        preprocessing = seconds * 1e9 / n as f64;
        costs.push(by_hints(n, &mut hints?, |hints, work| {
            hints.triangulate_observed(instance, work).map(|d| _ = black_box(d.vertex_count()))
        })?);
    }
    let located = Algorithm2::Located { locate: hierarchy(seed), seed };
    for algorithm in [Algorithm2::Incremental { seed }, located, Algorithm2::DivideAndConquer] {
        let (d, seconds) = timed(|| Delaunay2::with_algorithm(instance, algorithm));
        let visited = match d?.counters() {
            Counters::Incremental(work) => Some(work.visited),
            _ => None,
        };
        costs.push(Cost::of(n, seconds, visited));
    }
    Ok((costs, preprocessing))
}

fn in_space(centres: &[[f64; 3]], instance: &[[f64; 3]], seed: u64) -> Result<Row, Error> {
    let n = centres.len();
    let mut costs = Vec::new();
    let mut preprocessing = 0.0;
    for order in [HintOrder::Random { seed }, HintOrder::Spatial { seed }] {
        let (hints, seconds) = timed(|| Hints3::from_points(centres, order));
        preprocessing = seconds * 1e9 / n as f64;
        costs.push(by_hints(n, &mut hints?, |hints, work| {
            hints.triangulate_observed(instance, work).map(|d| _ = black_box(d.vertex_count()))
        })?);
    }
    for algorithm in [Algorithm3::Incremental { seed }, Algorithm3::Located { locate: hierarchy(seed), seed }]
    {
        let (d, seconds) = timed(|| Delaunay3::with_algorithm(instance, algorithm));
        costs.push(Cost::of(n, seconds, d?.counters().work().map(|work| work.visited)));
    }
    Ok((costs, preprocessing))
}
