//! Sites in boxes that repeat: spheres are empty of all copies nearby, the order does not show, and cells fill the box.

use std::collections::BTreeSet;

use delone::{
    CellularKind, DecimalGrid, Error, Grid, Image, Lattice3, Periodic, Periodic3, PeriodicRegular3, VertexId,
};
use delone_generators::Random;
use delone_predicates::{Sign, in_power_sphere};

use crate::attack::{Attack, Judgement};
use crate::nasty::{self, once_in, pick};

/// A point and its weight.
type Site = ([f64; 3], f64);

/// A corner: a site, and the offset of the copy.
type Corner = (usize, [i64; 3]);

/// See the module.
pub(crate) struct Boxes;

/// Parts of the sides of the grid that most sites are on: few, so that many sites tie.
const PARTS: usize = 4;

/// Positions of copies within so many times the largest number of the box are exact.
const FAR: f64 = (1 << 20) as f64;

/// Volumes may differ by this part of the box, by rounding of corners.
const ROUNDING: f64 = 1e-9;

/// Mostly one, so that sites are as far apart as the box is large.
fn scale(random: &mut Random) -> f64 {
    if once_in(random, 4) { nasty::power(random, -30, 30) } else { 1.0 }
}

/// Axes of small integers, right-handed, scaled; and along which the box repeats.
fn lattice(random: &mut Random) -> ([[f64; 3]; 3], [bool; 3]) {
    let scale = scale(random);
    loop {
        let mut axes = [(); 3].map(|()| [(); 3].map(|()| random.below(7) as f64 - 3.0));
        if once_in(random, 2) {
            for (i, axis) in axes.iter_mut().enumerate() {
                *axis = std::array::from_fn(|k| if k == i { 1.0 + random.below(8) as f64 } else { 0.0 });
            }
        }
        if once_in(random, 4) {
            let long = random.below(3);
            axes[long] = axes[long].map(|x| 8.0 * x);
        }
        let axes = axes.map(|axis| axis.map(|x| x * scale));
        let periodic = [(); 3].map(|()| !once_in(random, 4));
        if Lattice3::with_axes(axes).is_ok() {
            return (axes, periodic);
        }
    }
}

fn standing(corners: &[Corner]) -> Vec<Corner> {
    let from = |k: usize| {
        let seen = corners.iter().map(|c| (c.0, std::array::from_fn(|i| c.1[i] - corners[k].1[i])));
        let mut seen: Vec<Corner> = seen.collect();
        seen.sort_unstable();
        seen
    };
    (0..corners.len()).map(from).min().unwrap_or_default()
}

fn set<T: CellularKind<3, 4>>(t: &Periodic<T, 3, 4>, name: impl Fn(usize) -> usize) -> BTreeSet<Vec<Corner>> {
    let corner = |(site, offset): Image<3>| (name(site.index()), offset);
    t.simplices().map(|corners| standing(&corners.map(corner))).collect()
}

/// Whether no copy near the box has less power to a simplex than its corners have.
fn judge_spheres<T: CellularKind<3, 4>>(
    t: &Periodic<T, 3, 4>,
    weights: &[f64],
    periodic: [bool; 3],
) -> Judgement {
    let twins: BTreeSet<VertexId> = t.duplicates().map(|twin| twin.0).collect();
    let sites: Vec<VertexId> = (0..weights.len()).map(VertexId::new).filter(|v| !twins.contains(v)).collect();
    for corners in t.simplices() {
        let site = |copy: Image<3>| (t.position(copy), weights[copy.0.index()]);
        let [a, b, c, d] = corners.map(site);
        for &v in &sites {
            for i in 0..125 {
                let offset = [i % 5, i / 5 % 5, i / 25].map(|x| x - 2);
                let is_there = (0..3).all(|k| periodic[k] || offset[k] == 0);
                if !is_there || corners.contains(&(v, offset)) {
                    continue;
                }
                if in_power_sphere(a, b, c, d, site((v, offset))) != Sign::Negative {
                    return Err(format!("{corners:?} has {v:?} {offset:?} in its sphere"));
                }
            }
        }
    }
    Ok(())
}

fn judge_kind<T: CellularKind<3, 4>>(
    points: &[[f64; 3]],
    weights: &[f64],
    (axes, periodic, grid): ([[f64; 3]; 3], [bool; 3], Grid),
    build: impl Fn(&[[f64; 3]], &[f64]) -> Result<Periodic<T, 3, 4>, Error>,
) -> Judgement {
    let t = match build(points, weights) {
        // Of hostile points alone.
        Err(Error::FarAway { .. } | Error::TooManyPoints { .. }) => return Ok(()),
        // Of axes that vanish on a coarse grid.
        Err(Error::Lattice { .. }) if matches!(grid, Grid::Decimal(_)) => return Ok(()),
        built => built.map_err(|error| error.to_string())?,
    };
    // Positions of copies far away are rounded.
    let is_near = |p: &[f64; 3]| {
        p.iter().all(|x| x.abs() < FAR * axes.as_flattened().iter().fold(0.0, |m, a| a.abs().max(m)))
    };
    if t.rounding() == 0.0 && t.decimal_step().is_none() && points.iter().all(is_near) {
        judge_spheres(&t, weights, periodic)?;
    }
    for number in 0..t.simplex_count() {
        for (k, neighbor) in t.neighbors(number).into_iter().enumerate() {
            let Some((other, offset)) = neighbor else { continue };
            let back = Some((number, offset.map(|x| -x)));
            if !t.neighbors(other).contains(&back) {
                return Err(format!("simplex {number} is no neighbor of {other}, which is its own at {k}"));
            }
        }
    }
    if t.duplicates().next().is_none() {
        let turned: Vec<[f64; 3]> = points.iter().rev().copied().collect();
        let heavy: Vec<f64> = weights.iter().rev().copied().collect();
        let other = build(&turned, &heavy).map_err(|error| error.to_string())?;
        if set(&other, |i| points.len() - 1 - i) != set(&t, |i| i) {
            return Err("the order shows".to_owned());
        }
    }
    let [u, v, w] = axes;
    let minor = |i: usize, j: usize| v[i] * w[j] - v[j] * w[i];
    let volume_of_box = u[0] * minor(1, 2) + u[1] * minor(2, 0) + u[2] * minor(0, 1);
    let cells = match t.cells() {
        Err(Error::Lattice { .. }) if matches!(grid, Grid::Decimal(_)) => return Ok(()),
        made => made.map_err(|error| error.to_string())?,
    };
    let volume: f64 = (0..points.len()).map(|i| cells.cell(VertexId::new(i)).volume()).sum();
    // Flat boxes change most if their axes do.
    let is_far = t.rounding() > 1e-4 * ROUNDING * volume_of_box.cbrt();
    if !points.is_empty() && !is_far && (volume / volume_of_box - 1.0).abs() > ROUNDING {
        return Err(format!("cells have {volume} of {volume_of_box}"));
    }
    Ok(())
}

impl Attack for Boxes {
    type Item = Site;

    fn make(random: &mut Random) -> Vec<Site> {
        if once_in(random, 8) {
            let points = nasty::points(random, 6);
            return nasty::weighted(random, points);
        }
        let count = random.below(9);
        let step = scale(random) / PARTS as f64;
        let site = |random: &mut Random| {
            let point = [(); 3].map(|()| random.below(8 * PARTS) as f64 * step);
            (point, random.below(8) as f64 * step * step)
        };
        (0..count).map(|_| site(random)).collect()
    }

    fn judge(sites: &[Site], seed: u64) -> Judgement {
        let mut random = Random::new(seed);
        let (axes, periodic) = lattice(&mut random);
        let lattice = Lattice3::with_axes(axes).map_err(|error| error.to_string())?.periodic(periodic);
        let size = axes.as_flattened().iter().fold(0.0_f64, |m, a| a.abs().max(m));
        let lattice = lattice.origin(match random.below(3) {
            0 => [(); 3].map(|()| random.between(-1.0, 1.0) * size),
            1 => [(); 3].map(|()| nasty::integer(&mut random, 3) / PARTS as f64 * size),
            _ => [0.0; 3],
        });
        let step = pick(&mut random, &[0.01, 0.125, 1e-9, 1.0]) * size;
        let grid = match (random.below(4), DecimalGrid::with_step(step)) {
            (0, _) => Grid::Auto,
            (1, Ok(grid)) => Grid::Decimal(grid),
            _ => Grid::Binary,
        };
        let lattice = lattice.grid(grid);
        let (points, weights): (Vec<[f64; 3]>, Vec<f64>) = sites.iter().copied().unzip();
        let even = vec![0.0; points.len()];
        judge_kind(&points, &even, (axes, periodic, grid), |points, _| {
            Periodic3::from_points(points, &lattice)
        })?;
        judge_kind(&points, &weights, (axes, periodic, grid), |points, weights| {
            PeriodicRegular3::from_parts(points, weights, &lattice)
        })
        .map_err(|wrong| format!("with weights: {wrong}"))
    }
}
