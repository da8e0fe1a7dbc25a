//! `delone-lab experiment scopes`: which triangles, edges and tetrahedra ever appear, by how many points are in their circles.
//!
//! Source: Guibas, Knuth & Sharir 1992, §2.1 to §2.3, §4.2 and §4.3. On small sets all scopes are counted by exact decisions, what
//! appears is simulated in random orders, and both stand beside the lemmas.

mod adding;
mod edges;
mod planes;
mod space;
mod triangles;

use delone_generators::{Kind, Random};

use super::{Error, Findings, Options};

/// Random orders of a simulation.
const ORDERS: usize = 4_000;

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let mut findings = Findings::default();
    triangles::run(options, &mut findings)?;
    edges::run(options, &mut findings)?;
    adding::run(options, &mut findings)?;
    planes::run(options, &mut findings);
    space::run(options, &mut findings)?;
    Ok(findings)
}

/// The sets whose scopes are counted: evenly spread points, and points on curves.
fn sets(even: usize, on_curves: usize) -> [(Kind, usize); 4] {
    let curves = [Kind::Ellipse, Kind::Parabola, Kind::Circle].map(|kind| (kind, on_curves));
    [(Kind::Uniform, even), curves[0], curves[1], curves[2]]
}

/// Does something in each of many random orders of so many points.
fn in_orders(
    points: usize,
    seed: u64,
    mut each: impl FnMut(&[usize]) -> Result<(), delone::Error>,
) -> Result<(), Error> {
    let mut random = Random::new(seed);
    let mut order: Vec<usize> = (0..points).collect();
    for _ in 0..ORDERS {
        random.shuffle(&mut order);
        each(&order)?;
    }
    Ok(())
}

/// The probability that k + 1, k + 2, ... k + m are all passed: m! / ((k + 1) ... (k + m)). With m = 3 a triangle of scope
/// k appears with it (Lemma 2.1), with m = 4 a tetrahedron (Lemma 4.4).
fn first(m: usize, k: usize) -> f64 {
    (1..=m).map(|i| i as f64 / (k + i) as f64).product()
}
