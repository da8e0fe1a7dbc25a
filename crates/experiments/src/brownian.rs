//! Points that move: the Brownian motion of Devillers 2011, §5, and the automatic mover by displacement.

use std::hint::black_box;

use delone::{Algorithm2, Delaunay2, Delaunay3, HintOrder, Hints2, Moving2, Moving3, Step2, Step3, Work};
use delone_generators::{Kind, Kind3, Random, moved};

use super::plot::Plot;
use super::table::short;
use super::trials::Trials;
use super::{Error, Findings, Options, decades, timed};

/// Steps of a motion: as many as in the paper, but few of many points.
const STEPS: usize = 100;
const FEW_STEPS: usize = 10;
const SHORT_RUN_POINTS: usize = 1_000_000;
/// The paper's figures: points, nanoseconds a point and step and triangles visited by spatial sort, and by hints.
const PUBLISHED: [(usize, [f64; 4]); 5] = [
    (1_000, [780.0, 3.81, 730.0, 2.77]),
    (10_000, [780.0, 3.68, 690.0, 2.77]),
    (100_000, [880.0, 3.77, 790.0, 2.77]),
    (1_000_000, [960.0, 3.72, 810.0, 2.77]),
    (10_000_000, [1120.0, 3.62, 830.0, 2.77]),
];
/// Mean displacements in mean spacings.
const SHARES: [f64; 8] = [0.0001, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0];
/// The mean distance of a point in the unit disk, and in the unit ball, from the center.
const MEAN_IN_DISK: f64 = 2.0 / 3.0;
const MEAN_IN_BALL: f64 = 3.0 / 4.0;

/// `delone-lab experiment brownian`: points that move by up to one unit a step, four units apart; and what the automatic
/// mover needs, by displacement.
pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let mut findings = Findings::default();
    brownian(options, &mut findings)?;
    by_displacement(options, &mut findings)?;
    Ok(findings)
}

fn brownian(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let seed = options.seed;
    let mut table = options.table(
        "brownian",
        "Brownian motion: nanoseconds a point and step, and triangles visited",
        &[
            "points",
            "spatial sort: ns",
            "spatial sort: visited",
            "hints of the last step: ns",
            "hints of the last step: visited",
            "automatic: ns",
            "rebuilt",
        ],
    );
    let mut curves: [Vec<(f64, f64)>; 3] = Default::default();
    for n in decades(1000, options.largest) {
        let side = 4.0 * (n as f64).sqrt();
        let mut random = Random::new(seed);
        let mut points: Vec<[f64; 2]> =
            Kind::Uniform.points(n, seed).into_iter().map(|p| p.map(|x| x * side)).collect();
        let mut hints = Hints2::from_points(&points, HintOrder::Spatial { seed })?;
        let mut moving = Moving2::from_points(&points)?;
        let steps = if n < SHORT_RUN_POINTS { STEPS } else { FEW_STEPS };
        let [mut sort, mut by_sort, mut follow, mut by_hint, mut automatic] = <[Trials; 5]>::default();
        let mut rebuilt = 0;
        let each = |total: f64| total / n as f64;
        for _ in 0..steps {
            points = moved(&points, 1.0, &mut random);
            let (d, time) = timed(|| Delaunay2::with_algorithm(&points, Algorithm2::Incremental { seed }));
            sort.add(each(time) * 1e9);
            by_sort.extend(d?.counters().work().map(|work| each(work.visited as f64)));
            let mut work = Work::default();
            let to_follow = || hints.follow_observed(&points, &mut work).map(|d| black_box(d.vertex_count()));
            let (done, time) = timed(to_follow);
            done?;
            follow.add(each(time) * 1e9);
            by_hint.add(each(work.visited as f64));
            let (step, time) = timed(|| moving.step(&points));
            rebuilt += usize::from(step? == Step2::Rebuilt);
            automatic.add(each(time) * 1e9);
        }
        let cells = [&sort, &by_sort, &follow, &by_hint, &automatic].map(|trials| trials.to_string());
        table.row([vec![n.to_string()], cells.to_vec(), vec![format!("{rebuilt} of {steps}")]].concat());
        if let Some((_, published)) = PUBLISHED.iter().find(|row| row.0 == n) {
            let none = || "-".to_owned();
            let cells = published.map(short);
            table.row([vec![format!("{n} in 2011")], cells.to_vec(), vec![none(), none()]].concat());
        }
        for (curve, ns) in curves.iter_mut().zip([sort, follow, automatic]) {
            curve.push((n as f64, ns.mean()));
        }
    }
    let mut plot = Plot::new("brownian", "Brownian motion", ["points n", "nanoseconds a point and step"]);
    for (name, curve) in ["spatial sort", "hints of the last step", "automatic"].into_iter().zip(curves) {
        plot.curve(name, curve);
    }
    findings.tables.push(table);
    findings.plots.push(plot);
    Ok(())
}

/// The time of the automatic mover in the plane and in space, beside a construction from nothing.
fn by_displacement(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let seed = options.seed;
    let heads = ["points", "displacement", "ns", "from nothing: ns", "ratio of ns", "how"];
    let title = |what: &str| format!("Points in {what} that move by a mean share of their spacing");
    let mut plane = options.table("moving", &title("a square"), &heads);
    let mut space = options.table("moving-space", &title("a cube"), &heads);
    let mut curves: [Vec<(f64, f64)>; 2] = Default::default();
    for (n, share) in options.ends(1_000, 1_000_000).flat_map(|n| SHARES.map(|share| (n, share))) {
        let m = n / 5;
        if share == SHARES[0] {
            curves = Default::default();
        }
        let mut random = Random::new(seed);
        let mut points = Kind::Uniform.points(n, seed);
        let mut moving = Moving2::from_points(&points)?;
        let radius = share / MEAN_IN_DISK / (n as f64).sqrt();
        let motion = time_steps(n, || {
            points = moved(&points, radius, &mut random);
            let (step, time) = timed(|| moving.step(&points));
            let (d, whole) = timed(|| Delaunay2::from_points(&points));
            black_box(d?.vertex_count());
            Ok((plane_step(step?, n), time, whole))
        })?;
        plane.row(motion.cells(n, share));
        curves[0].push((share, motion.ratio()));
        let mut points = Kind3::Cube.points(m, seed);
        let mut moving = Moving3::from_points(&points)?;
        let radius = share / MEAN_IN_BALL / (m as f64).cbrt();
        let motion = time_steps(m, || {
            points = moved(&points, radius, &mut random);
            let (step, time) = timed(|| moving.step(&points));
            let (d, whole) = timed(|| Delaunay3::from_points(&points));
            black_box(d?.vertex_count());
            Ok((space_step(step?, m), time, whole))
        })?;
        space.row(motion.cells(m, share));
        curves[1].push((share, motion.ratio()));
    }
    let axes = ["mean displacement in spacings", "times as fast as from nothing"];
    let mut plot = Plot::new("moving", "Automatic repair of moving points", axes);
    for (name, curve) in ["plane", "space"].into_iter().zip(curves) {
        plot.curve(name, curve);
    }
    findings.tables.extend([plane, space]);
    findings.plots.push(plot);
    Ok(())
}

/// The best of some steps.
struct Motion {
    ns: f64,
    from_nothing: f64,
    /// How the last step was made.
    how: String,
}

impl Motion {
    fn ratio(&self) -> f64 {
        self.from_nothing / self.ns
    }

    fn cells(&self, n: usize, share: f64) -> [String; 6] {
        let how = self.how.clone();
        [n.to_string(), short(share), short(self.ns), short(self.from_nothing), short(self.ratio()), how]
    }
}

/// Makes some steps; each gives how it was made, its seconds and those of a construction from nothing.
fn time_steps(
    n: usize,
    mut step: impl FnMut() -> Result<(String, f64, f64), Error>,
) -> Result<Motion, Error> {
    let mut motion = Motion { ns: f64::INFINITY, from_nothing: f64::INFINITY, how: String::new() };
    for _ in 0..FEW_STEPS / 2 {
        let (how, time, whole) = step()?;
        let each = |seconds: f64| seconds * 1e9 / n as f64;
        motion.ns = motion.ns.min(each(time));
        motion.from_nothing = motion.from_nothing.min(each(whole));
        motion.how = how;
    }
    Ok(motion)
}

fn plane_step(step: Step2, n: usize) -> String {
    match step {
        Step2::Repaired { flips, reinserted } => {
            let [flips, reinserted] = [flips, reinserted].map(|count| short(count as f64 / n as f64));
            format!("repaired: {flips} flips and {reinserted} reinsertions a point")
        }
        _ => "rebuilt".to_owned(),
    }
}

fn space_step(step: Step3, n: usize) -> String {
    match step {
        Step3::Repaired { holes, reinserted } => {
            let [holes, reinserted] = [holes, reinserted].map(|count| short(count as f64 / n as f64));
            format!("repaired: {holes} holes and {reinserted} reinsertions a point")
        }
        Step3::Hinted => "by hints".to_owned(),
        _ => "rebuilt".to_owned(),
    }
}
