//! Alpha complexes of hostile sites: values, order and shapes against their definitions.

use std::collections::BTreeMap;

use delone::{Alpha, Dimension, Face, Regular2, Regular3, Triangulation, VertexId};
use delone_generators::Random;
use delone_oracle::alpha::complex;

use crate::attack::{Attack, Judgement};
use crate::nasty::{self, once_in};

/// A point and its weight.
type Site<const D: usize> = ([f64; D], f64);

/// In the plane.
pub(crate) struct Planar;

/// In space.
pub(crate) struct Spatial;

impl Attack for Planar {
    type Item = Site<2>;

    fn make(random: &mut Random) -> Vec<Site<2>> {
        let points = nasty::points(random, 14);
        nasty::weighted(random, points)
    }

    fn judge(sites: &[Site<2>], seed: u64) -> Judgement {
        let r = Regular2::from_sites(sites).map_err(|error| error.to_string())?;
        let alpha = r.alpha();
        judge(&r, &alpha, sites)?;
        let value = any(&alpha, seed);
        let triangles = alpha.complex(value).triangles;
        let outline = alpha.outline(value);
        // Every side that one triangle has is in one ring, in one direction.
        let mut sides: Vec<[VertexId; 2]> = Vec::new();
        for ring in outline.iter().flatten() {
            let mut corners = ring.clone();
            corners.sort_unstable();
            corners.dedup();
            if corners.len() != ring.len() {
                return Err(format!("outline at {value:e}: a ring touches itself: {ring:?}"));
            }
            sides.extend((0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()]]));
        }
        sides.iter_mut().for_each(|side| side.sort_unstable());
        sides.sort_unstable();
        let mut expected: BTreeMap<[VertexId; 2], usize> = BTreeMap::new();
        for &[a, b, c] in triangles {
            [[a, b], [a, c], [b, c]].into_iter().for_each(|side| *expected.entry(side).or_default() += 1);
        }
        expected.retain(|_, count| *count == 1);
        if !expected.keys().eq(sides.iter()) {
            return Err(format!("outline at {value:e}: {sides:?} instead of {expected:?}"));
        }
        parts(&alpha, value, triangles, outline.len())
    }
}

impl Attack for Spatial {
    type Item = Site<3>;

    fn make(random: &mut Random) -> Vec<Site<3>> {
        let points = nasty::points(random, 9);
        nasty::weighted(random, points)
    }

    fn judge(sites: &[Site<3>], seed: u64) -> Judgement {
        let r = Regular3::from_sites(sites).map_err(|error| error.to_string())?;
        let alpha = r.alpha();
        judge(&r, &alpha, sites)?;
        let value = any(&alpha, seed);
        let mut balance: BTreeMap<[VertexId; 2], i32> = BTreeMap::new();
        for [a, b, c] in alpha.outline(value) {
            for [v, w] in [[a, b], [b, c], [c, a]] {
                *balance.entry([v.min(w), v.max(w)]).or_default() += if v < w { 1 } else { -1 };
            }
        }
        if balance.values().any(|&balance| balance != 0) {
            return Err(format!("outline at {value:e}: the surface is open: {balance:?}"));
        }
        let tetrahedra = alpha.complex(value).tetrahedra;
        let count = alpha.parts(value).into_iter().max().map_or(0, |last| last + 1);
        parts(&alpha, value, tetrahedra, count)
    }
}

/// A value where something changes, or any number.
fn any<const D: usize>(alpha: &Alpha<D>, seed: u64) -> f64 {
    let mut random = Random::new(seed);
    let spectrum = alpha.spectrum();
    if spectrum.is_empty() || once_in(&mut random, 8) {
        return nasty::any_bits(&mut random);
    }
    spectrum[random.below(spectrum.len())]
}

/// All faces with their values, by definition, and in order.
fn judge<const D: usize>(t: &impl Triangulation, alpha: &Alpha<D>, sites: &[Site<D>]) -> Judgement {
    let expected = complex(sites, &simplices(t));
    let key = |face: &Face| (face.corners().len(), face.corners().to_vec());
    let all: Vec<Face> = alpha.filtration().collect();
    if !all.is_sorted_by(|a, b| a.value < b.value || (a.value == b.value && key(a) < key(b))) {
        return Err(format!("the filtration is not in order: {all:?}"));
    }
    let found: BTreeMap<Vec<usize>, f64> =
        all.iter().map(|face| (face.corners().iter().map(|v| v.index()).collect(), face.value)).collect();
    if !found.keys().eq(expected.keys()) || found.len() != all.len() {
        return Err(format!("faces {:?} instead of {:?}", found.keys(), expected.keys()));
    }
    for ((face, value), size) in found.iter().zip(expected.values()) {
        if !size.is_rounded_to(*value) {
            return Err(format!("the value of {face:?} is not {value:e} but {size:?}"));
        }
    }
    Ok(())
}

/// The simplices of what the points span, by index.
fn simplices<T: Triangulation>(t: &T) -> Vec<Vec<usize>> {
    let indices = |corners: &[VertexId]| corners.iter().map(|v| v.index()).collect::<Vec<_>>();
    let full: Vec<_> = t.simplices().map(|s| indices(t.corners(s).as_ref())).collect();
    match t.dimension() {
        _ if !full.is_empty() => full,
        Dimension::Plane => t.hull_facets().map(|facet| indices(facet.as_ref())).collect(),
        Dimension::Line => t.edges().map(|edge| indices(&edge)).collect(),
        _ => t.vertices().map(|v| indices(&[v])).collect(),
    }
}

/// The parts of the simplices of the highest dimension by flooding, and whether the optimal value has what it is asked for.
fn parts<const D: usize, const N: usize>(
    alpha: &Alpha<D>,
    value: f64,
    simplices: &[[VertexId; N]],
    count: usize,
) -> Judgement {
    let expected = flooded(simplices);
    if count != expected {
        return Err(format!("{count} parts at {value:e} instead of {expected}"));
    }
    let optimal = alpha.optimal(2);
    let is_covered = alpha.all().vertices.iter().flatten().all(|v| simplices.iter().any(|s| s.contains(v)));
    let holds = is_covered && expected <= 2 && !simplices.is_empty();
    match optimal {
        Some(optimal) if holds && value < optimal => Err(format!("optimal: {optimal:e} and not {value:e}")),
        Some(optimal) if !holds && value == optimal => Err(format!("optimal: {optimal:e} is too small")),
        None if holds => Err(format!("optimal: none and not {value:e}")),
        _ => Ok(()),
    }
}

fn flooded<const N: usize>(simplices: &[[VertexId; N]]) -> usize {
    let mut left: Vec<&[VertexId; N]> = simplices.iter().collect();
    let mut parts = 0;
    while let Some(first) = left.pop() {
        parts += 1;
        let mut border = vec![first];
        while let Some(simplex) = border.pop() {
            let is_near =
                |other: &&[VertexId; N]| other.iter().filter(|v| simplex.contains(v)).count() == N - 1;
            border.extend(left.extract_if(.., |other| is_near(other)));
        }
    }
    parts
}
