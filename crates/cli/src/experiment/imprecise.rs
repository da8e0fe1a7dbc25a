//! Imprecise and moving points: the tables of Devillers 2011, §5.

use std::hint::black_box;

use delone::{
    Algorithm, Algorithm3, Counters, Delaunay2, Delaunay3, Error, Hierarchy, HintOrder, Hints2, Hints3,
    Locate, Work,
};
use delone_oracle::generate::{Kind, Kind3, Random};

use super::plot::Plot;
use super::table::{Table, short};
use super::{Findings, timed};

/// Steps of the Brownian motion.
const STEPS: usize = 10;
/// The paper's visited triangles a point, for any number of them: hints in random and in spatial order, spatial sort.
const PAPER: [f64; 3] = [2.8, 2.8, 3.7];
const PAPER_IN_SPACE: [f64; 3] = [5.25, 4.5, 6.6];

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

/// Each point moved randomly inside of its unit ball.
fn moved<const D: usize>(points: &[[f64; D]], random: &mut Random) -> Vec<[f64; D]> {
    let shift = |p: &[f64; D]| {
        let (mut q, u) = (*p, in_ball::<D>(random));
        q.iter_mut().zip(u).for_each(|(x, u)| *x += u);
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

/// `delone experiment imprecise`.
pub(super) fn run(largest: usize, seed: u64) -> Result<Findings, Error> {
    let mut findings = Findings::default();
    let methods =
        ["hints, random order", "hints, spatial order", "spatial sort", "hierarchy", "divide and conquer"];
    collect(&mut findings, "imprecise", "Disjoint unit disks", &methods, &PAPER, largest, |n| {
        plane(n, seed)
    })?;
    let methods = ["hints, random order", "hints, spatial order", "spatial sort", "hierarchy"];
    let most = largest.min(100_000);
    let title = "Disjoint unit balls in space";
    collect(&mut findings, "imprecise-space", title, &methods, &PAPER_IN_SPACE, most, |n| space(n, seed))?;
    Ok(findings)
}

/// What each method costs, and nanoseconds a point to preprocess in spatial order.
type Row = (Vec<Cost>, f64);

/// Makes the table and the plot of one dimension.
fn collect(
    findings: &mut Findings,
    name: &str,
    title: &str,
    methods: &[&str],
    paper: &[f64],
    largest: usize,
    measure: impl Fn(usize) -> Result<Row, Error>,
) -> Result<(), Error> {
    let mut times = Table::new(
        &format!("{name}-times"),
        &format!("{title}: nanoseconds a point"),
        &[&["points"], methods, &["preprocessing", "instances to amortise"]].concat(),
    );
    let walkers: Vec<&str> = methods.iter().take(paper.len()).copied().collect();
    let mut visits = Table::new(
        &format!("{name}-visited"),
        &format!("{title}: triangles visited a point"),
        &[&["points"], walkers.as_slice()].concat(),
    );
    let mut curves: Vec<Vec<(f64, f64)>> = vec![Vec::new(); methods.len()];
    let mut n = 1_000;
    while n <= largest {
        let (costs, preprocessing) = measure(n)?;
        let saved = costs[2].ns - costs[1].ns;
        let instances = if saved > 0.0 { short(preprocessing / saved) } else { "-".to_owned() };
        let cells: Vec<String> = costs.iter().map(|cost| short(cost.ns)).collect();
        times.row([vec![n.to_string()], cells, vec![short(preprocessing), instances]].concat());
        let visited = costs.iter().take(paper.len()).map(|cost| cost.visited.map_or("-".to_owned(), short));
        visits.row([vec![n.to_string()], visited.collect()].concat());
        for (curve, cost) in curves.iter_mut().zip(&costs) {
            curve.push((n as f64, cost.ns));
        }
        n *= 10;
    }
    visits.row([vec!["the paper".to_owned()], paper.iter().copied().map(short).collect()].concat());
    let mut plot = Plot::new(&format!("{name}-times"), title, ["points n", "nanoseconds a point"]);
    for (method, curve) in methods.iter().zip(curves) {
        plot.curve(method, curve);
    }
    findings.tables.extend([times, visits]);
    findings.plots.push(plot);
    Ok(())
}

fn plane(n: usize, seed: u64) -> Result<Row, Error> {
    let centres = Kind::Disks.points(n, seed);
    let instance = moved(&centres, &mut Random::new(seed + 1));
    let mut costs = Vec::new();
    let mut preprocessing = 0.0;
    for order in [HintOrder::Random { seed }, HintOrder::Spatial { seed }] {
        let (hints, seconds) = timed(|| Hints2::preprocess(&centres, order));
        let mut hints = hints?;
        preprocessing = seconds * 1e9 / n as f64;
        let mut work = Work::default();
        // The first instance makes the memory, and is counted; the second is timed.
        hints.triangulate_counted(&instance, &mut work)?;
        let (done, seconds) = timed(|| hints.triangulate(&instance).map(|d| black_box(d.vertex_count())));
        done?;
        costs.push(Cost::of(n, seconds, Some(work.visited)));
    }
    let hierarchy = Locate::Hierarchy(Hierarchy { seed, ..Hierarchy::default() });
    for algorithm in [
        Algorithm::Incremental { seed },
        Algorithm::Located { locate: hierarchy, seed },
        Algorithm::DivideAndConquer,
    ] {
        let (d, seconds) = timed(|| Delaunay2::with_algorithm(&instance, algorithm));
        let visited = match d?.counters() {
            Counters::Incremental(work) => Some(work.visited),
            _ => None,
        };
        costs.push(Cost::of(n, seconds, visited));
    }
    Ok((costs, preprocessing))
}

fn space(n: usize, seed: u64) -> Result<Row, Error> {
    let centres = Kind3::Balls.points(n, seed);
    let instance = moved(&centres, &mut Random::new(seed + 1));
    let mut costs = Vec::new();
    let mut preprocessing = 0.0;
    for order in [HintOrder::Random { seed }, HintOrder::Spatial { seed }] {
        let (hints, seconds) = timed(|| Hints3::preprocess(&centres, order));
        let mut hints = hints?;
        preprocessing = seconds * 1e9 / n as f64;
        let mut work = Work::default();
        hints.triangulate_counted(&instance, &mut work)?;
        let (done, seconds) = timed(|| hints.triangulate(&instance).map(|d| black_box(d.vertex_count())));
        done?;
        costs.push(Cost::of(n, seconds, Some(work.visited)));
    }
    let hierarchy = Locate::Hierarchy(Hierarchy { seed, ..Hierarchy::default() });
    for algorithm in [Algorithm3::Spatial { seed }, Algorithm3::Located { locate: hierarchy, seed }] {
        let (d, seconds) = timed(|| Delaunay3::with_algorithm(&instance, algorithm));
        costs.push(Cost::of(n, seconds, Some(d?.work().visited)));
    }
    Ok((costs, preprocessing))
}

/// `delone experiment brownian`: points that move by up to one unit a step, four units apart.
pub(super) fn brownian(largest: usize, seed: u64) -> Result<Findings, Error> {
    let mut table = Table::new(
        "brownian",
        "Brownian motion: nanoseconds a point and step, and triangles visited",
        &["points", "spatial sort", "visited", "hints of the last step", "visited", "divide and conquer"],
    );
    let mut curves: [Vec<(f64, f64)>; 3] = Default::default();
    let mut n = 1_000;
    while n <= largest {
        let side = 4.0 * (n as f64).sqrt();
        let mut random = Random::new(seed);
        let mut points: Vec<[f64; 2]> =
            Kind::Uniform.points(n, seed).into_iter().map(|p| p.map(|x| x * side)).collect();
        let mut hints = Hints2::preprocess(&points, HintOrder::Spatial { seed })?;
        let (mut seconds, mut visited) = ([0.0; 3], [0, 0]);
        for _ in 0..STEPS {
            points = moved(&points, &mut random);
            let mut work = Work::default();
            let (done, time) =
                timed(|| hints.follow_counted(&points, &mut work).map(|d| black_box(d.vertex_count())));
            done?;
            seconds[1] += time;
            visited[1] += work.visited;
            let (d, time) = timed(|| Delaunay2::with_algorithm(&points, Algorithm::Incremental { seed }));
            seconds[0] += time;
            if let Counters::Incremental(work) = d?.counters() {
                visited[0] += work.visited;
            }
            let (d, time) = timed(|| Delaunay2::from_points(&points));
            black_box(d?.vertex_count());
            seconds[2] += time;
        }
        let each = |total: f64| total / (n * STEPS) as f64;
        let [sort, follow, divide] = seconds.map(|total| each(total) * 1e9);
        let [by_sort, by_hint] = visited.map(|count| each(count as f64));
        table.row(
            [vec![n.to_string()], [sort, by_sort, follow, by_hint, divide].map(short).to_vec()].concat(),
        );
        for (curve, ns) in curves.iter_mut().zip([sort, follow, divide]) {
            curve.push((n as f64, ns));
        }
        n *= 10;
    }
    let mut plot = Plot::new("brownian", "Brownian motion", ["points n", "nanoseconds a point and step"]);
    for (name, curve) in
        ["spatial sort", "hints of the last step", "divide and conquer"].into_iter().zip(curves)
    {
        plot.curve(name, curve);
    }
    Ok(Findings { tables: vec![table], plots: vec![plot] })
}
