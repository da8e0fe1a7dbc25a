//! Conditions of all cells: they are closed, share faces, have their corners where they must be, and fill the region.

use std::collections::{BTreeMap, BTreeSet};

use delone::{Across3, Cell3, Cells3, Region3, VertexId};

use super::Site;
use crate::attack::Judgement;
use crate::oracle::half_spaces::{HalfSpace, Place, Unit};

/// Volumes may differ by this part, by rounding of corners and of sums.
pub(super) const ROUNDING: f64 = 1e-12;

/// Volume, area, centroid, and faces.
pub(super) type Facts = (f64, f64, Option<[f64; 3]>, Vec<(Across3, Vec<[f64; 3]>)>);

pub(super) fn facts(cell: Cell3<'_>) -> Facts {
    let faces = cell.faces().map(|face| (face.across(), face.points().collect()));
    (cell.volume(), cell.area(), cell.centroid(), faces.collect())
}

pub(super) fn extent(points: impl Iterator<Item = [f64; 3]>) -> f64 {
    let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for p in points {
        bounds = [[0, 1, 2].map(|k| bounds[0][k].min(p[k])), [0, 1, 2].map(|k| bounds[1][k].max(p[k]))];
    }
    (0..3).fold(0.0, |most, k| f64::max(most, bounds[1][k] - bounds[0][k]))
}

/// Cells are closed, both sides of a face name the same corners, and a place has one index.
pub(super) fn judge_faces(cells: &Cells3, all: &[VertexId], is_bounded_only: bool) -> Judgement {
    let mut faces: BTreeMap<(VertexId, VertexId), Vec<Vec<u32>>> = BTreeMap::new();
    let mut index_at: BTreeMap<[u64; 3], u32> = BTreeMap::new();
    for &v in all {
        let mut sides: BTreeMap<[u32; 2], i32> = BTreeMap::new();
        for face in cells.faces(v) {
            let ring = face.indices();
            if ring.len() < 3 {
                return Err(format!("{v:?} has a face of {ring:?}"));
            }
            for (&p, &q) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                *sides.entry([p.min(q), p.max(q)]).or_default() += if p < q { 1 } else { -1 };
            }
            for (p, &i) in face.points().zip(ring) {
                if p.iter().any(|x| !x.is_finite() || x.to_bits() == (-0.0_f64).to_bits()) {
                    return Err(format!("{v:?} has the corner {p:?}"));
                }
                if *index_at.entry(p.map(f64::to_bits)).or_insert(i) != i {
                    return Err(format!("two vertices are at {p:?}"));
                }
            }
            if let Some(w) = face.neighbor() {
                faces.entry((v, w)).or_default().push(from_least(ring.to_vec()));
            }
        }
        if sides.values().any(|&turns| turns != 0) {
            return Err(format!("the cell of {v:?} is open"));
        }
    }
    // Bounded cells may be beside those without bounds, which have no faces.
    let has_faces = |w: &VertexId| !is_bounded_only || cells.faces(*w).len() > 0;
    for ((v, w), rings) in faces.iter().filter(|(pair, _)| has_faces(&pair.1)) {
        let mut back = faces.get(&(*w, *v)).cloned().unwrap_or_default();
        back.iter_mut().for_each(|ring| ring.reverse());
        let back: Vec<Vec<u32>> = back.into_iter().map(from_least).collect();
        if rings.len() != 1 || back != *rings {
            return Err(format!("between {v:?} and {w:?} are {rings:?}, and from the other side {back:?}"));
        }
    }
    Ok(())
}

pub(super) fn from_least<T: Ord + Copy>(mut ring: Vec<T>) -> Vec<T> {
    let least = (0..ring.len()).min_by_key(|&k| ring[k]).unwrap_or_default();
    ring.rotate_left(least);
    ring
}

/// Corners are in the region and nearest to their site, and on the planes of their faces; exactly, but for one rounding.
pub(super) fn judge_places(cells: &Cells3, sites: &[Site], region: &Region3) -> Judgement {
    let walls: Vec<[[f64; 3]; 3]> = region
        .walls()
        .map(|wall| {
            let corners: Vec<[f64; 3]> = wall.collect();
            [corners[0], corners[1], corners[2]]
        })
        .collect();
    let used: BTreeSet<u32> = (0..sites.len())
        .flat_map(|v| cells.faces(VertexId::new(v)).flat_map(|face| face.indices().to_vec()))
        .collect();
    let mut places: Vec<[f64; 3]> = used.iter().map(|&i| cells.vertices()[i as usize]).collect();
    let count = places.len();
    places.extend(walls.as_flattened());
    let unit = Unit::of(sites, &places);
    let exact: BTreeMap<u32, Place> =
        used.iter().copied().zip(places[..count].iter().map(|&p| unit.place(p))).collect();
    let walls: Vec<HalfSpace> = walls.into_iter().map(|wall| unit.beside(wall)).collect();
    for v in 0..sites.len() {
        let cell = cells.cell(VertexId::new(v));
        let corners: BTreeSet<u32> = cell.faces().flat_map(|face| face.indices().to_vec()).collect();
        let others = (0..sites.len()).filter(|&w| sites[w].0 != sites[v].0);
        let nearer: BTreeMap<usize, HalfSpace> =
            others.map(|w| (w, unit.nearer(sites[v], sites[w]))).collect();
        for i in &corners {
            let all = nearer.values().chain(&walls);
            if all.into_iter().any(|half_space| half_space.side(&exact[i]) > 0) {
                return Err(format!("{v} is not nearest to its corner {:?}", cells.vertices()[*i as usize]));
            }
        }
        for face in cell.faces() {
            let plane = match face.across() {
                Across3::Site(w) => nearer.get(&w.index()),
                Across3::Wall(k) => walls.get(k),
            };
            let plane = plane.ok_or_else(|| format!("{v} has a face beside {:?}", face.across()))?;
            if face.indices().iter().any(|i| plane.side(&exact[i]) != 0) {
                return Err(format!("{v} has a face beside {:?} that is not in its plane", face.across()));
            }
        }
    }
    Ok(())
}

/// Volumes sum up to that of the region.
pub(super) fn judge_volumes(cells: &Cells3, sites: &[Site], region: &Region3) -> Judgement {
    let (mut sum, mut area) = (0.0, 0.0);
    for v in (0..sites.len()).map(VertexId::new) {
        let (volume, surface) = (cells.volume(v), cells.area(v));
        if volume.is_nan() || volume < 0.0 || surface.is_nan() || surface < 0.0 {
            return Err(format!("the cell of {v:?} has the volume {volume} and the area {surface}"));
        }
        sum += volume;
        area += surface;
        let Some(centroid) = cells.centroid(v) else { continue };
        let [low, high] = region.bounds();
        if (0..3).any(|k| centroid[k].is_nan() || centroid[k] < low[k] || high[k] < centroid[k]) {
            return Err(format!("the centroid of {v:?} is {centroid:?}"));
        }
    }
    let largest = region.bounds().as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let whole = region.volume();
    let off = ROUNDING * whole + f64::EPSILON * largest * area + noise(region);
    // Beyond the range of numbers sums say nothing, and below it products lose bits.
    if !sites.is_empty() && whole > 1e-300 && off.is_finite() && (sum - whole).abs() > off {
        return Err(format!("volumes sum up to {sum} of {whole}"));
    }
    Ok(())
}

/// The volume that rounding makes of nothing where walls are slanted: a part of a needle's length cubed.
pub(super) fn noise(region: &Region3) -> f64 {
    let [low, high] = region.bounds();
    let is_box = region.corners().iter().all(|p| (0..3).all(|k| p[k] == low[k] || p[k] == high[k]));
    let length = extent([low, high].into_iter());
    if is_box { 0.0 } else { f64::EPSILON * length * length * length }
}
