//! `delone-lab experiment conflicts`: the equations (1) to (5) of the analysis of conflict lists, step by step.
//!
//! Source: lecture notes on randomized incremental Delaunay triangulation; Clarkson & Shor 1989. T_r are the triangles of
//! the first r of n points in random order, ghosts included, K(t) the points in the circle of a triangle t, k_r(q) the
//! triangles of T_r whose circles hold q, and k'_r(q) those of them that the r-th point brought.

use delone::{Change, Delaunay2, VertexId, Work};
use delone_generators::{Kind, Random};
use delone_predicates::{in_circle, orient2d};

use super::table::short;
use super::trials::Trials;
use super::{Error, Findings, Options};

/// Points, and at least so many random orders.
const POINTS: usize = 300;
const ORDERS: usize = 10;

/// The work at the insertion of the r-th point, summed over orders.
#[derive(Clone, Copy, Default)]
struct Step {
    /// Sizes of the conflicts of the new triangles: the left side of (1).
    of_triangles: u64,
    /// New triangles in conflict, over the points to come: the right side of (1), and the left one of (2).
    new: u64,
    /// Triangles in conflict, over the points to come: the right sides of (2) and (3).
    all: u64,
    /// Triangles in conflict with the next point: the left sides of (3) and (4).
    next: u64,
    /// Triangles that the next point destroyed, and brought.
    destroyed: u64,
    created: u64,
}

/// Whether the circle of a triangle, or the half-plane of a ghost, holds a point. General position is assumed.
fn conflicts(d: &Delaunay2, corners: [VertexId; 3], q: [f64; 2]) -> bool {
    let at = |k: usize| d.point(corners[k % 3]);
    match corners.iter().position(|v| v.is_ghost()) {
        Some(k) => orient2d(at(k + 1), at(k + 2), q).is_positive(),
        None => in_circle(at(0), at(1), at(2), q).is_positive(),
    }
}

/// Inserts points in an order, and adds up what happens.
fn observe(points: &[[f64; 2]], order: &[usize], steps: &mut [Step]) -> Result<u64, delone::Error> {
    let mut d = Delaunay2::new();
    let mut total = 0;
    for (r, &i) in order.iter().enumerate() {
        let mut work = Work::default();
        let v = d.insert_observed(points[i], &mut work)?.vertex();
        let mesh = d.mesh();
        steps[r].destroyed += work.destroyed;
        steps[r].created += work.created;
        let r = r + 1;
        if r < 3 {
            continue;
        }
        let star: Vec<_> = mesh.star(v).map(|e| e.triangle()).collect();
        let step = &mut steps[r];
        let to_come = &order[r..];
        for &t in &star {
            let size = to_come.iter().filter(|&&j| conflicts(&d, mesh.corners(t), points[j])).count() as u64;
            step.of_triangles += size;
            total += size;
        }
        for (k, &j) in to_come.iter().enumerate() {
            let hit = |t: &_| conflicts(&d, mesh.corners(*t), points[j]);
            let (mut all, mut new) = (0, 0);
            let ghosts = mesh.triangles().flat_map(|t| mesh.adjacent(t)).filter(|&t| mesh.is_ghost(t));
            for t in mesh.triangles().chain(ghosts).filter(hit) {
                all += 1;
                new += u64::from(mesh.corners(t).contains(&v));
            }
            step.all += all;
            step.new += new;
            step.next += if k == 0 { all } else { 0 };
        }
    }
    Ok(total)
}

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let points = Kind::Uniform.points(POINTS, options.seed);
    let mut random = Random::new(options.seed);
    let mut order: Vec<usize> = (0..POINTS).collect();
    let mut steps = vec![Step::default(); POINTS + 1];
    let mut totals = Trials::default();
    let orders = ORDERS.max(options.trials);
    for _ in 0..orders {
        random.shuffle(&mut order);
        totals.add(observe(&points, &order, &mut steps)? as f64 / POINTS as f64);
    }
    let mut table = options.table(
        "conflicts",
        &format!("The equations of the lecture notes, means of {orders} random orders of {POINTS} points"),
        &[
            "r",
            "(1) sizes",
            "(1) by points",
            "(2) new",
            "(2) 3/r of all",
            "(3) of the next",
            "(3) of the mean",
            "(4) destroyed",
            "(4) created - 2",
            "(5) created, < 6",
        ],
    );
    // Sums over ranges of r, which stray less than single steps.
    for range in [3..10, 10..30, 30..100, 100..200, 200..POINTS - 1] {
        let mean = |of: &dyn Fn(usize, &Step) -> f64| {
            let sum: f64 = range.clone().map(|r| of(r, &steps[r])).sum();
            short(sum / orders as f64 / range.len() as f64)
        };
        table.row([
            format!("{} to {}", range.start, range.end - 1),
            mean(&|_, s| s.of_triangles as f64),
            mean(&|_, s| s.new as f64),
            mean(&|_, s| s.new as f64),
            mean(&|r, s| 3.0 / r as f64 * s.all as f64),
            mean(&|_, s| s.next as f64),
            mean(&|r, s| s.all as f64 / (POINTS - r) as f64),
            mean(&|_, s| s.destroyed as f64),
            mean(&|_, s| s.created as f64 - 2.0 * orders as f64),
            mean(&|_, s| s.created as f64),
        ]);
    }
    let harmonic: f64 = (1..=POINTS).map(|r| (POINTS - r) as f64 / r as f64).sum();
    let mut sums = options.table(
        "conflicts-total",
        "Sizes of the conflicts of all triangles that ever appear, a point",
        &["points", "measured", "bound 12 sum (n-r)/r"],
    );
    sums.row([POINTS.to_string(), totals.to_string(), short(12.0 * harmonic / POINTS as f64)]);
    Ok(Findings { tables: vec![table, sums], plots: Vec::new() })
}
