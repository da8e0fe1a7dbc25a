//! Imprecise points: the tables of Devillers 2011, §5, for disjoint unit disks and balls, and for a scanned model.

use std::hint::black_box;

use delone::{
    Algorithm2, Algorithm3, Change, Delaunay2, Delaunay3, Hierarchy, HintOrder, Hints2, Hints3, Imprecise,
    Locate, Walk, Work,
};
use delone_generators::{Kind, Kind3, Random, moved};

use super::plot::Plot;
use super::table::{Table, short};
use super::trials::Trials;
use super::{Error, Findings, Options, decades, timed};

/// The paper's hierarchy is the one of CGAL, which does not sample its highest level.
const METHODS: [&str; 6] = [
    "hints, random order",
    "hints, spatial order",
    "spatial sort",
    "hierarchy",
    "hierarchy and sample",
    "divide and conquer",
];

/// How many of them walk.
const WALKING: usize = 5;

/// The paper's spatial sort inserts along one curve and walks straight; ours deals points into rounds first, and crosses any edge
/// that has the goal beyond it. What is in between shows which of both saves triangles.
const STRAIGHT: [&str; 2] = ["one Hilbert curve, straight", "spatial sort, straight"];

/// The paper's figures for a number of points: nanoseconds a point by the methods above without our sample (the last is Triangle),
/// triangles visited, nanoseconds to preprocess, and instances that amortize it.
struct Published {
    points: usize,
    ns: &'static [f64],
    visited: &'static [f64],
    preprocessing: f64,
    instances: f64,
}

impl Published {
    /// The numbers of the methods above, of which there are so many.
    fn by_methods(numbers: &[f64], methods: usize) -> impl Iterator<Item = f64> {
        let of = |k: usize| match k {
            0..4 => numbers.get(k),
            4 => None,
            _ => numbers.get(k - 1),
        };
        (0..methods).map(move |k| of(k).copied().unwrap_or(f64::NAN))
    }
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

/// The cost of a method for one point: nanoseconds, and triangles visited if it walks.
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

/// The costs of the methods, in their order, and nanoseconds a point to preprocess in spatial order.
#[derive(Default)]
struct Row {
    costs: [Cost; METHODS.len()],
    /// Triangles visited in other orders, in the plane.
    straight: [Trials; STRAIGHT.len()],
    preprocessing: Trials,
}

/// The largest set that is triangulated several times.
const REPEATED: usize = 1_000_000;

/// The trials of a set of so many points, by number.
fn trials(options: &Options<'_>, n: usize) -> std::ops::Range<u64> {
    0..if n <= REPEATED { options.trials as u64 } else { 1 }
}

/// `delone-lab experiment imprecise`.
pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let mut findings = Findings::default();
    let mut plane = Report::new(options, "imprecise", "Disjoint unit disks", &METHODS, &PLANE);
    for n in decades(1000, options.largest) {
        let mut row = Row::default();
        for trial in trials(options, n) {
            let seed = options.seed + trial;
            let centers = Kind::Disks.points(n, seed);
            let instance = moved(&centers, 1.0, &mut Random::new(seed + 1));
            in_plane(&centers, &instance, seed, &mut row)?;
        }
        plane.row(n, row);
    }
    plane.finish(&mut findings);
    let title = "Disjoint unit balls in space";
    let mut space = Report::new(options, "imprecise-space", title, &METHODS[..WALKING], &SPACE);
    for n in decades(1000, options.largest / 10) {
        let mut row = Row::default();
        for trial in trials(options, n) {
            let seed = options.seed + trial;
            let centers = Kind3::Balls.points(n, seed);
            let instance = moved(&centers, 1.0, &mut Random::new(seed + 1));
            in_space(&centers, &instance, seed, &mut row)?;
        }
        space.row(n, row);
    }
    space.finish(&mut findings);
    Ok(findings)
}

/// `delone-lab experiment scan`: noise around the points of a scanned model, as strong as points are from their hints.
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
    let mut report =
        Report::new(options, "scan", "Noisy samples of a scanned model", &METHODS[..WALKING], &SCAN);
    let mut random = Random::new(seed);
    let most = model.len().min(largest);
    for n in decades(1000, most).take_while(|&n| n < most).chain([most]) {
        let mut row = Row::default();
        for _ in trials(options, n) {
            random.shuffle(&mut model);
            let centers = &model[..n];
            let hints = Hints3::from_points(centers, HintOrder::Spatial { seed })?;
            let far = hints.order().zip(hints.hints()).skip(1).map(|(i, j)| {
                let square: f64 = (0..3).map(|k| (centers[i][k] - centers[j][k]).powi(2)).sum();
                square.sqrt()
            });
            let radius = far.sum::<f64>() / n as f64;
            let instance = moved(centers, radius, &mut random);
            if instance.iter().flatten().any(|x| !x.is_finite()) {
                return Err(Error::WideModel);
            }
            in_space(centers, &instance, seed, &mut row)?;
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
    fn new(
        options: &Options<'_>,
        name: &'a str,
        title: &str,
        methods: &'a [&'a str],
        published: &'a [Published],
    ) -> Self {
        let heads = [&["points"], methods, &["preprocessing", "instances to amortize"]].concat();
        let times = format!("{title}: nanoseconds a point");
        let visits = format!("{title}: visited a point");
        let in_plane = methods.len() > WALKING;
        let straight: &[&str] = if in_plane { &STRAIGHT } else { &[] };
        let walking = [&["points"], &methods[..WALKING], straight].concat();
        Self {
            title: title.to_owned(),
            name,
            methods,
            published,
            times: options.table(&format!("{name}-times"), &times, &heads),
            visits: options.table(&format!("{name}-visited"), &visits, &walking),
            curves: vec![Vec::new(); methods.len()],
        }
    }

    fn row(&mut self, n: usize, Row { costs, straight, preprocessing }: Row) {
        let costs = &costs[..self.methods.len()];
        let in_plane = self.methods.len() > WALKING;
        let saved = costs[2].ns.mean() - costs[1].ns.mean();
        let instances = if saved > 0.0 { (preprocessing.mean() / saved).ceil() } else { f64::NAN };
        let times = costs.iter().map(|cost| cost.ns.to_string());
        let last = [preprocessing.to_string(), short(instances)];
        self.times.row(std::iter::once(n.to_string()).chain(times).chain(last));
        let visits =
            costs.iter().take(WALKING).map(|cost| &cost.visited).chain(straight.iter().filter(|_| in_plane));
        self.visits.row(std::iter::once(n.to_string()).chain(visits.map(ToString::to_string)));
        if let Some(found) = self.published.iter().find(|found| found.points == n) {
            let name = format!("{n} in 2011");
            let ns = Published::by_methods(found.ns, self.methods.len());
            let ns = ns.chain([found.preprocessing, found.instances]);
            self.times.row(std::iter::once(name.clone()).chain(ns.map(short)));
            let visits = Published::by_methods(found.visited, WALKING);
            let visits = visits.chain(in_plane.then_some([found.visited[2], f64::NAN]).into_iter().flatten());
            self.visits.row(std::iter::once(name).chain(visits.map(short)));
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

/// The cost of a first instance by hints, in new memory as by the other methods; visits are counted in a second one.
fn by_hints<H>(
    n: usize,
    hints: &mut H,
    cost: &mut Cost,
    triangulate: impl Fn(&mut H, &mut Work) -> Result<(), delone::Error>,
) -> Result<(), Error> {
    let (done, seconds) = timed(|| triangulate(hints, &mut Work::default()));
    done?;
    let mut work = Work::default();
    triangulate(hints, &mut work)?;
    cost.add(n, seconds, Some(work.visited));
    Ok(())
}

/// The hierarchy without a sample on top and with one.
fn hierarchies(seed: u64) -> [Locate; 2] {
    [Hierarchy::only_levels(), Hierarchy::default()].map(|hierarchy| Locate::Hierarchy(hierarchy.seed(seed)))
}

/// Triangles visited a point, each walk straight from the point before.
fn straight(points: impl ExactSizeIterator<Item = [f64; 2]>) -> Result<f64, Error> {
    let mut d = Delaunay2::with_strategy(Locate::Walk(Walk::Straight))?;
    let n = points.len() as f64;
    let mut work = Work::default();
    points.into_iter().try_for_each(|p| d.insert_observed(p, &mut work).map(drop))?;
    Ok(work.visited as f64 / n)
}

/// Points in the order of a Hilbert curve over their square.
fn hilbert(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    const BITS: u32 = 16;
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for &x in points.iter().flatten() {
        (least, most) = (least.min(x), most.max(x));
    }
    let scale = f64::from((1_u32 << BITS) - 1) / (most - least);
    let key = |p: &[f64; 2]| {
        let [mut x, mut y] = p.map(|x| ((x - least) * scale) as u32);
        let mut key = 0_u64;
        for bit in (0..BITS).rev() {
            let (right, up) = (x >> bit & 1, y >> bit & 1);
            key = key << 2 | u64::from((3 * right) ^ up);
            // The quarters at both ends of the curve are turned.
            if up == 0 {
                if right == 1 {
                    (x, y) = (!x, !y);
                }
                std::mem::swap(&mut x, &mut y);
            }
        }
        key
    };
    let mut sorted = points.to_vec();
    sorted.sort_by_cached_key(key);
    sorted
}

fn in_plane(centers: &[[f64; 2]], instance: &[[f64; 2]], seed: u64, row: &mut Row) -> Result<(), Error> {
    let n = centers.len();
    let [random, spatial, direct @ ..] = &mut row.costs;
    for (order, cost) in [(HintOrder::Random { seed }, random), (HintOrder::Spatial { seed }, spatial)] {
        let (hints, seconds) = timed(|| Hints2::from_points(centers, order));
        if matches!(order, HintOrder::Spatial { .. }) {
            row.preprocessing.add(seconds * 1e9 / n as f64);
        }
        by_hints(n, &mut hints?, cost, |hints, work| {
            hints.triangulate_observed(instance, work).map(|d| _ = black_box(d.vertex_count()))
        })?;
    }
    let [levels, both] = hierarchies(seed).map(|locate| Algorithm2::Located { locate, seed });
    for (algorithm, cost) in
        [Algorithm2::Incremental { seed }, levels, both, Algorithm2::DivideAndConquer].into_iter().zip(direct)
    {
        let (d, seconds) = timed(|| Delaunay2::with_algorithm(instance, algorithm));
        cost.add(n, seconds, d?.counters().work().map(|work| work.visited));
    }
    let spatial: Vec<usize> = Hints2::from_points(instance, HintOrder::Spatial { seed })?.order().collect();
    row.straight[0].add(straight(hilbert(instance).into_iter())?);
    row.straight[1].add(straight(spatial.iter().map(|&i| instance[i]))?);
    Ok(())
}

fn in_space(centers: &[[f64; 3]], instance: &[[f64; 3]], seed: u64, row: &mut Row) -> Result<(), Error> {
    let n = centers.len();
    let [random, spatial, direct @ ..] = &mut row.costs;
    for (order, cost) in [(HintOrder::Random { seed }, random), (HintOrder::Spatial { seed }, spatial)] {
        let (hints, seconds) = timed(|| Hints3::from_points(centers, order));
        if matches!(order, HintOrder::Spatial { .. }) {
            row.preprocessing.add(seconds * 1e9 / n as f64);
        }
        by_hints(n, &mut hints?, cost, |hints, work| {
            hints.triangulate_observed(instance, work).map(|d| _ = black_box(d.vertex_count()))
        })?;
    }
    let [levels, both] = hierarchies(seed).map(|locate| Algorithm3::Located { locate, seed });
    for (algorithm, cost) in [Algorithm3::Incremental { seed }, levels, both].into_iter().zip(direct) {
        let (d, seconds) = timed(|| Delaunay3::with_algorithm(instance, algorithm));
        cost.add(n, seconds, d?.counters().work().map(|work| work.visited));
    }
    Ok(())
}
