//! Changes that must not show in cells: of threads, the order of sites, mirrors, units.

use std::collections::{BTreeMap, BTreeSet};

use delone::{Across3, Cells3, Region3, Regular3, VertexId};
use delone_generators::Random;

use super::judges::{ROUNDING, extent, from_least, judge_faces};
use super::{Diagram, LEAST_SHARED, Site};
use crate::attack::Judgement;
use crate::nasty;

/// A face: the place of the site beyond it or the number of the wall, and the corners from the least on, as bits.
type Polygon = (Option<[u64; 3]>, usize, Vec<[u64; 3]>);

/// The number of threads does not show.
pub(super) fn judge_threads(diagram: &(impl Diagram + Sync), count: usize, region: &Region3) -> Judgement {
    delone::share_work_from(LEAST_SHARED);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.map(|pool| pool.install(|| diagram.clip(region))).map_err(|error| error.to_string())
    };
    let (one, many) = (with(1)?, with(5)?);
    let all: Vec<VertexId> = (0..count).map(VertexId::new).collect();
    judge_faces(&one, &all, false)?;
    if one.vertices() != many.vertices() {
        return Err("threads show in the corners".to_owned());
    }
    let faces = |cells: &Cells3, v| {
        let indices = cells.faces(v).map(|face| (face.across(), face.indices().to_vec()));
        indices.collect::<Vec<_>>()
    };
    match all.into_iter().find(|&v| faces(&one, v) != faces(&many, v)) {
        Some(v) => Err(format!("threads show in the cell of {v:?}")),
        None => Ok(()),
    }
}

/// All cells of a set: by the place of the site the faces, with a map of places.
fn polygons(
    sites: &[Site],
    region: &Region3,
    place: impl Fn([f64; 3]) -> [f64; 3],
) -> Result<BTreeMap<[u64; 3], BTreeSet<Polygon>>, String> {
    let r = Regular3::from_sites(sites).map_err(|error| error.to_string())?;
    let cells = r.power().clip(region);
    let bits = |p: [f64; 3]| place(p).map(|x| (x + 0.0).to_bits());
    let polygon = |face: delone::Face3<'_>| {
        let ring = from_least(face.points().map(bits).collect());
        match face.across() {
            Across3::Site(w) => (Some(bits(sites[w.index()].0)), 0, ring),
            Across3::Wall(k) => (None, k, ring),
        }
    };
    let cell = |v: VertexId| (bits(sites[v.index()].0), cells.faces(v).map(polygon).collect());
    Ok(r.vertices().map(cell).collect())
}

pub(super) fn judge_order(sites: &[Site], region: &Region3, random: &mut Random) -> Judgement {
    let mut other = sites.to_vec();
    for i in (1..other.len()).rev() {
        other.swap(i, random.below(i + 1));
    }
    let [found, expected] = [polygons(&other, region, |p| p)?, polygons(sites, region, |p| p)?];
    if found == expected { Ok(()) } else { Err(format!("the order shows: {other:?}")) }
}

/// The order of space decides ties, which have no volume: nothing that has one changes in a mirror.
pub(super) fn judge_mirrored(sites: &[Site], region: &Region3, axis: usize) -> Judgement {
    let mirrored = |mut p: [f64; 3]| {
        p[axis] = -p[axis];
        p
    };
    let corners: Vec<[f64; 3]> = region.corners().iter().copied().map(mirrored).collect();
    let other = Region3::convex(&corners).map_err(|error| error.to_string())?;
    let turned: Vec<Site> = sites.iter().map(|&(p, w)| (mirrored(p), w)).collect();
    let both = [(sites, region), (&turned[..], &other)].map(|(sites, region)| {
        Regular3::from_sites(sites).map(|r| r.power().clip(region)).map_err(|error| error.to_string())
    });
    let [plain, turned] = both;
    let (plain, turned) = (plain?, turned?);
    let largest = region.bounds().as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    for v in (0..sites.len()).map(VertexId::new) {
        let (one, two) = (plain.volume(v), turned.volume(v));
        let area = plain.area(v).max(turned.area(v));
        let length = extent(plain.faces(v).chain(turned.faces(v)).flat_map(|face| face.points()));
        let needle = f64::EPSILON * length * length * length;
        let off = ROUNDING * one.max(two) + 8.0 * f64::EPSILON * largest * area + needle;
        if off.is_finite() && (one - two).abs() > off + 1e-300 {
            return Err(format!("{v:?} has {one}, and in a mirror {two}"));
        }
    }
    Ok(())
}

/// A power of two changes no digit, where all are in the range of numbers.
pub(super) fn judge_scaled(sites: &[Site], region: &Region3, random: &mut Random) -> Judgement {
    let sizes = || sites.iter().flat_map(|site| site.0).chain(region.corners().iter().flatten().copied());
    let is_middling = |x: f64| x == 0.0 || (1e-30..1e30).contains(&x.abs());
    if !sizes().all(is_middling) || !sites.iter().all(|site| is_middling(site.1)) {
        return Ok(());
    }
    let factor = nasty::power(random, -90, 90);
    let scaled = |p: [f64; 3]| p.map(|x| x * factor);
    let other: Vec<Site> = sites.iter().map(|&(p, w)| (scaled(p), w * factor * factor)).collect();
    let corners: Vec<[f64; 3]> = region.corners().iter().copied().map(scaled).collect();
    let walls = Region3::convex(&corners).map_err(|error| error.to_string())?;
    let plain = Region3::convex(region.corners()).map_err(|error| error.to_string())?;
    let [found, expected] =
        [polygons(&other, &walls, |p| p.map(|x| x / factor))?, polygons(sites, &plain, |p| p)?];
    if found == expected { Ok(()) } else { Err(format!("a factor of {factor:e} shows")) }
}
