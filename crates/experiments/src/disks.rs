//! `delone-lab experiment disks`: what the analysis of hints counts, and disks beyond its assumptions.
//!
//! Source: Devillers 2011: Lemmas 1 and 2 and the claims of Theorem 3 (§4), disks that overlap (§6.1), disks of different radii
//! (§6.2), balls in space (§6.3); what is the same in all instances, the strong and the weak problem (§1).

use std::collections::BTreeMap;

use delone::{Delaunay2, Error as Refusal, HintOrder, Hints2, Hints3, Imprecise, VertexId, Work};
use delone_generators::{Kind, Kind3, Random, in_ball, moved};
use delone_predicates::{Sign, orient2d};

use super::plot::Plot;
use super::table::{Table, short};
use super::trials::Trials;
use super::{Error, Findings, Options, decades};

/// The largest set of which neighborhoods are counted.
const COUNTED: usize = 100_000;
/// Disks of which instances are compared, and how many of them.
const COMPARED: usize = 1000;
const INSTANCES: usize = 100;
/// Radii of disks whose centers are at least two apart.
const RADII: [f64; 6] = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0];

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let mut findings = Findings::default();
    findings.tables.extend([claims(options)?, crossed(options)?]);
    overlaps(options, &mut findings)?;
    findings.tables.push(radii(options)?);
    findings.tables.push(misled(options)?);
    findings.tables.push(edges(options)?);
    Ok(findings)
}

/// Measures the bounds in the proof of Theorem 3: all constants of the linear expected cost.
fn claims(options: &Options<'_>) -> Result<Table, Error> {
    let mut table = options.table(
        "disks-claims",
        "Disjoint unit disks: disks whose D(p) holds an instance, degree of a hint, sum of degrees in D(p) (bounds 22, 36, 132)",
        &["points", "most in W(q)", "mean in W(q)", "degree of a hint", "sum of degrees"],
    );
    for n in decades(1000, options.largest.min(COUNTED)) {
        let [mut most, mut mean, mut degree, mut sum] = <[Trials; 4]>::default();
        for seed in options.seeds() {
            let centers = Kind::Disks.points(n, seed);
            let instance = moved(&centers, 1.0, &mut Random::new(seed + 1000));
            let of_centers = Delaunay2::from_points(&centers)?;
            let d = Delaunay2::from_points(&instance)?;
            let degree_of = |v: VertexId| d.mesh().star(v).count() as f64;
            let mut held = vec![0_u32; n];
            let (mut hints, mut sums) = (0.0, 0.0);
            for (i, &p) in centers.iter().enumerate() {
                let nearest = of_centers.k_nearest(p, 2)?[1];
                let q = of_centers.point(nearest);
                hints += degree_of(nearest);
                for v in d.within(p, (p[0] - q[0]).hypot(p[1] - q[1]) + 1.0)? {
                    sums += degree_of(v);
                    held[v.index()] += u32::from(v.index() != i);
                }
            }
            most.add(f64::from(held.iter().copied().max().unwrap_or(0)));
            mean.add(f64::from(held.iter().sum::<u32>()) / n as f64);
            degree.add(hints / n as f64);
            sum.add(sums / n as f64);
        }
        table.row([n.to_string()].into_iter().chain([most, mean, degree, sum].map(|t| t.to_string())));
    }
    Ok(table)
}

/// Lemma 2: with a point in the triangulation, an edge across the segment to its hint has an end in D(p), which encloses both
/// disks.
/// Unit disks that are disjoint hardly ever leave such an edge; the proof asks for no more than D(p), so the others overlap.
fn crossed(options: &Options<'_>) -> Result<Table, Error> {
    let mut table = options.table(
        "disks-crossed",
        "Disks, centers at least two apart: edges between a point and its hint before it comes and after, a point, and those after \
         it without an end in D(p), in all (Lemma 2: none)",
        &["points", "radius", "crossed before", "crossed after", "without an end in D(p)"],
    );
    for (n, reach) in [300, COMPARED].into_iter().flat_map(|n| [1.0, 4.0, 16.0].map(|reach| (n, reach))) {
        let mut counts: [Trials; 2] = Default::default();
        let mut without = 0_u64;
        for seed in options.seeds() {
            let centers = Kind::Disks.points(n, seed);
            let instance = moved(&centers, reach, &mut Random::new(seed + 1000));
            let hints = Hints2::from_points(&centers, HintOrder::Random { seed })?;
            let mut d = Delaunay2::new();
            let mut totals = [0_u32; 2];
            for (i, j) in hints.order().zip(hints.hints()) {
                let (p, x) = (instance[i], instance[j]);
                totals[0] += across(&d, p, x).count() as u32;
                d.insert(p)?;
                let [center, other] = [centers[i], centers[j]];
                let radius = (center[0] - other[0]).hypot(center[1] - other[1]) + reach;
                let is_in = |q: [f64; 2]| (q[0] - center[0]).hypot(q[1] - center[1]) <= radius;
                for [a, b] in across(&d, p, x) {
                    totals[1] += 1;
                    without += u64::from(!is_in(a) && !is_in(b));
                }
            }
            counts.iter_mut().zip(totals).for_each(|(count, total)| count.add(f64::from(total) / n as f64));
        }
        let [before, after] = counts.map(|count| count.to_string());
        table.row([n.to_string(), short(reach), before, after, without.to_string()]);
    }
    Ok(table)
}

/// The edges that cross a segment.
fn across(d: &Delaunay2, p: [f64; 2], q: [f64; 2]) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
    let parts = |u, v, [a, b]: [[f64; 2]; 2]| orient2d(u, v, a) * orient2d(u, v, b) == Sign::Negative;
    let edges = d.edges().map(|edge| edge.map(|v| d.point(v)));
    edges.filter(move |&[a, b]| parts(p, q, [a, b]) && parts(a, b, [p, q]))
}

/// Triangles visited a point by hints in random order.
fn visited(centers: &[[f64; 2]], instance: &[[f64; 2]], seed: u64) -> Result<(f64, bool), Refusal> {
    let mut work = Work::default();
    let mut hints = Hints2::from_points(centers, HintOrder::Random { seed })?;
    hints.triangulate_observed(instance, &mut work)?;
    Ok((work.visited as f64 / centers.len() as f64, hints.gave_up()))
}

/// Tetrahedra visited, in space.
fn visited_in_space(centers: &[[f64; 3]], instance: &[[f64; 3]], seed: u64) -> Result<f64, Refusal> {
    let mut work = Work::default();
    Hints3::from_points(centers, HintOrder::Random { seed })?.triangulate_observed(instance, &mut work)?;
    Ok(work.visited as f64 / centers.len() as f64)
}

/// Unit disks and balls that grow until they overlap: the cost is O(k n) if k of them have a point in common.
fn overlaps(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let mut table = options.table(
        "disks-overlap",
        "Disks and balls, centers at least two apart: visited a point by the radius",
        &[
            "disks",
            "balls",
            "radius",
            "disks over a center, at most",
            "visited",
            "visited / k",
            "visited in space",
        ],
    );
    let mut plot =
        Plot::new("disks-overlap", "Overlapping disks: cost of hints", ["radius", "visited a point"]);
    let mut curves: [Vec<(f64, f64)>; 2] = Default::default();
    for (n, radius) in options.ends(1_000, 100_000).flat_map(|n| RADII.map(|radius| (n, radius))) {
        let m = n.min(20_000);
        if radius == RADII[0] {
            curves = Default::default();
        }
        let [mut in_plane, mut in_space] = <[Trials; 2]>::default();
        let mut most = 0;
        for seed in options.seeds() {
            let mut random = Random::new(seed + 1000);
            let centers = Kind::Disks.points(n, seed);
            in_plane.add(visited(&centers, &moved(&centers, radius, &mut random), seed)?.0);
            let d = Delaunay2::from_points(&centers)?;
            for &p in centers.iter().take(1000) {
                most = most.max(d.within(p, radius)?.len());
            }
            let centers = Kind3::Balls.points(m, seed);
            in_space.add(visited_in_space(&centers, &moved(&centers, radius, &mut random), seed)?);
        }
        table.row([
            n.to_string(),
            m.to_string(),
            short(radius),
            most.to_string(),
            in_plane.to_string(),
            in_plane.over(most as f64).to_string(),
            in_space.to_string(),
        ]);
        for (curve, trials) in curves.iter_mut().zip([&in_plane, &in_space]) {
            curve.push((radius, trials.mean()));
        }
    }
    for (name, curve) in ["disks", "balls in space"].into_iter().zip(curves) {
        plot.curve(name, curve);
    }
    findings.tables.push(table);
    findings.plots.push(plot);
    Ok(())
}

/// Disjoint disks of very different radii: each reaches a random share of the way to the middle between its center and
/// the nearest other one. The paper leaves their analysis open.
fn radii(options: &Options<'_>) -> Result<Table, Error> {
    let mut table = options.table(
        "disks-radii",
        "Disjoint disks of different radii: visited a point",
        &["centers", "points", "largest / smallest radius", "visited"],
    );
    for kind in [Kind::Uniform, Kind::Clusters, Kind::LogNormal, Kind::HugeSpan] {
        for n in decades(1000, options.largest.min(COUNTED)) {
            let mut counts = Trials::default();
            let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
            for seed in options.seeds() {
                let mut random = Random::new(seed + 1000);
                let centers = kind.points(n, seed);
                let d = Delaunay2::from_points(&centers)?;
                let mut instance = Vec::with_capacity(n);
                for &p in &centers {
                    let near = d.k_nearest(p, 2)?;
                    let q = near.get(1).map_or(p, |&v| d.point(v));
                    let radius = random.unit() * (p[0] / 2.0 - q[0] / 2.0).hypot(p[1] / 2.0 - q[1] / 2.0);
                    (least, most) = (least.min(radius), most.max(radius));
                    let shift: [f64; 2] = in_ball(&mut random);
                    instance.push([p[0] + radius * shift[0], p[1] + radius * shift[1]]);
                }
                counts.add(visited(&centers, &instance, seed)?.0);
            }
            let span = (most / least.max(f64::MIN_POSITIVE)).min(f64::MAX);
            table.row([kind.name().to_owned(), n.to_string(), format!("{span:.0e}"), counts.to_string()]);
        }
    }
    Ok(table)
}

/// Disks whose radii fall by tenths and that overlap two by two: walks are quadratic, until they are given up.
fn misled(options: &Options<'_>) -> Result<Table, Error> {
    let mut table = options.table(
        "disks-misled",
        "Nested disks that overlap two by two, hints in random order: visited a point, and whether hints were given up",
        &["points", "visited", "in n", "given up"],
    );
    for n in [51, 101, 201, 401, 601, 801, 1201] {
        let centers = Kind::Nested.points(n, 0);
        let instance = Kind::NestedInstance.points(n, 0);
        let mut counts = Trials::default();
        let mut given_up = 0;
        for seed in options.seeds() {
            let (count, gave_up) = visited(&centers, &instance, seed)?;
            counts.add(count);
            given_up += usize::from(gave_up);
        }
        let share = counts.over(n as f64).to_string();
        table.row([n.to_string(), counts.to_string(), share, format!("{given_up} of {}", options.trials)]);
    }
    Ok(table)
}

/// Edges that every instance has, and that some instance has, beside those of random instances.
fn edges(options: &Options<'_>) -> Result<Table, Error> {
    let n = COMPARED;
    let mut table = options.table(
        "disks-edges",
        &format!(
            "{n} disks, centers at least two apart: edges a point in every, all of 100, any of 100, and some instance"
        ),
        &["radius", "certain", "in all of 100", "in any of 100", "possible"],
    );
    for radius in [0.0, 0.0625, 0.125, 0.25, 0.5, 1.0] {
        let mut counts = <[Trials; 4]>::default();
        for seed in options.seeds() {
            let centers = Kind::Disks.points(n, seed);
            let of_centers = Delaunay2::from_points(&centers)?;
            let edges = of_centers.disk_edges(radius)?;
            let mut random = Random::new(seed + 1000);
            let mut seen: BTreeMap<[VertexId; 2], usize> = BTreeMap::new();
            for _ in 0..INSTANCES {
                let instance = Delaunay2::from_points(&moved(&centers, radius, &mut random))?;
                for [v, w] in instance.edges() {
                    *seen.entry([v.min(w), v.max(w)]).or_default() += 1;
                }
            }
            let all = seen.values().filter(|&&times| times == INSTANCES).count();
            let numbers = [edges.certain().len(), all, seen.len(), edges.possible().len()];
            for (count, number) in counts.iter_mut().zip(numbers) {
                count.add(number as f64 / n as f64);
            }
        }
        table.row([short(radius)].into_iter().chain(counts.map(|t| t.to_string())));
    }
    Ok(table)
}
