//! Voronoi and power cells of space, clipped to boxes and convex bodies: they tile the region, whatever the order of the sites.

mod judges;
mod unchanged;

use std::collections::BTreeSet;

use delone::{Cell3, Cells3, Delaunay3, Error, Power3, Region3, Regular3, Relaxation3, VertexId, Voronoi3};
use delone_generators::{Kind3, Random};

use judges::{extent, facts, judge_faces, judge_places, judge_volumes};
use unchanged::{judge_mirrored, judge_order, judge_scaled, judge_threads};

use crate::attack::{Attack, Judgement};
use crate::nasty::{self, once_in, pick};
use crate::oracle::delaunay::span;

/// See the module.
pub(crate) struct Cells3d;

/// A point and its weight.
type Site = ([f64; 3], f64);

#[derive(Clone, Debug)]
pub(crate) enum Item {
    Site([f64; 3], f64),
    /// A corner of a convex region.
    Corner([f64; 3]),
    /// The corners of a box.
    Cuboid([f64; 3], [f64; 3]),
}

/// The number of sites from which threads share them; too many for definitions.
const LEAST_SHARED: usize = 2048;

/// A diagram of either kind.
trait Diagram {
    fn clip(&self, region: &Region3) -> Cells3;
    fn each(&self, region: &Region3, each: impl FnMut(VertexId, Cell3<'_>));
    fn bounded(&self) -> Cells3;
    fn is_bounded(&self, v: VertexId) -> bool;
    fn neighbors(&self, v: VertexId) -> Vec<VertexId>;
}

macro_rules! diagram {
    ($name:ident) => {
        impl Diagram for $name<'_> {
            fn clip(&self, region: &Region3) -> Cells3 {
                (*self).clip(region)
            }
            fn each(&self, region: &Region3, each: impl FnMut(VertexId, Cell3<'_>)) {
                self.clip_each(region, each);
            }
            fn bounded(&self) -> Cells3 {
                (*self).bounded()
            }
            fn is_bounded(&self, v: VertexId) -> bool {
                (*self).is_bounded(v)
            }
            fn neighbors(&self, v: VertexId) -> Vec<VertexId> {
                (*self).neighbors(v)
            }
        }
    };
}

diagram!(Voronoi3);
diagram!(Power3);

fn site_of(random: &mut Random, sites: &[Site]) -> [f64; 3] {
    if sites.is_empty() { [0.0; 3] } else { sites[random.below(sites.len())].0 }
}

fn finite(x: f64) -> f64 {
    x.clamp(f64::MIN, f64::MAX)
}

/// A region beside sites: boxes through them, needles, hulls of some of them or of anything.
fn region(random: &mut Random, sites: &[Site]) -> Vec<Item> {
    let least = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| p[k].min(q[k]));
    let most = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| p[k].max(q[k]));
    let (p, q) = (site_of(random, sites), site_of(random, sites));
    let largest = sites.iter().flat_map(|site| site.0).fold(0.0_f64, |most, x| most.max(x.abs()));
    let largest = if largest > 0.0 { largest } else { 1.0 };
    let size = finite(pick(random, &[1.0, 0.25, 1e-3, 1e-9, 16.0]) * largest);
    match random.below(8) {
        // Around all of them, by a power of two.
        0 | 1 => {
            let (mut low, mut high) =
                sites.iter().fold((p, p), |(low, high), site| (least(low, site.0), most(high, site.0)));
            let more = if once_in(random, 3) { 0.0 } else { size };
            (low, high) = (low.map(|x| finite(x - more)), high.map(|x| finite(x + more)));
            vec![Item::Cuboid(low, high)]
        }
        // Between two of them.
        2 => vec![Item::Cuboid(least(p, q), most(p, q))],
        // A plate or a needle.
        3 => {
            let mut sides = [size; 3];
            sides[random.below(3)] *= pick(random, &[1e-6, 1e-12, 1.0]);
            sides[random.below(3)] *= pick(random, &[1e-6, 1e-3, 1e6]);
            vec![Item::Cuboid(p, [0, 1, 2].map(|k| finite(p[k] + sides[k])))]
        }
        4 => vec![Item::Cuboid(p, nasty::query(random, &[p, q]))],
        // The hull of all.
        5 => Vec::new(),
        // The hull of some, and of places beside them.
        6 => (0..4 + random.below(8))
            .map(|_| {
                let at = site_of(random, sites);
                Item::Corner(at.map(|x| finite(x + size * nasty::integer(random, 2))))
            })
            .collect(),
        _ => nasty::points::<3>(random, 12).into_iter().map(Item::Corner).collect(),
    }
}

/// Lattices, crystals and spheres of decimals.
fn everyday(random: &mut Random) -> Vec<[f64; 3]> {
    let step = pick(random, &[0.3, 3.639, 0.1, 1.0, 1.0 / 3.0]);
    let shift = pick(random, &[0.0, 0.5, 0.7, 1e3, 1e6]);
    let kind = random.below(4);
    let count = 1 + random.below(30);
    let at = |i: usize, random: &mut Random| match kind {
        0 => [i % 3, i / 3 % 3, i / 9].map(|x| x as f64 * step),
        // Body-centered.
        1 => [i / 2 % 2, i / 4 % 2, i / 8].map(|x| (x as f64 + 0.5 * (i % 2) as f64) * step),
        // On a sphere, exactly before they are scaled.
        2 => {
            let p = pick(random, &[[1.0, 4.0, 8.0], [4.0, 4.0, 7.0], [9.0, 0.0, 0.0]]);
            let by = random.below(3);
            [0, 1, 2].map(|k| if once_in(random, 2) { p[(k + by) % 3] } else { -p[(k + by) % 3] } * step)
        }
        _ => [(); 3].map(|()| nasty::integer(random, 2) * step),
    };
    (0..count).map(|i| at(i, random).map(|x| x + shift)).collect()
}

impl Attack for Cells3d {
    type Item = Item;

    fn make(random: &mut Random) -> Vec<Item> {
        if once_in(random, 60) {
            let kind = pick(random, &[Kind3::Cube, Kind3::Grid3, Kind3::SlantedGrid]);
            let points = kind.points(LEAST_SHARED + random.below(3 * LEAST_SHARED), random.bits());
            return nasty::weighted(random, points).into_iter().map(|(p, w)| Item::Site(p, w)).collect();
        }
        let points = match random.below(3) {
            0 => everyday(random),
            1 => nasty::points(random, 20),
            _ => (0..=random.below(30)).map(|_| [(); 3].map(|()| random.between(-4.0, 4.0))).collect(),
        };
        let sites = nasty::weighted(random, points);
        let mut items = region(random, &sites);
        items.extend(sites.into_iter().map(|(p, w)| Item::Site(p, w)));
        items
    }

    fn judge(items: &[Item], seed: u64) -> Judgement {
        let sites: Vec<Site> = items
            .iter()
            .filter_map(|item| if let Item::Site(p, w) = item { Some((*p, *w)) } else { None })
            .collect();
        let corners: Vec<[f64; 3]> = items
            .iter()
            .filter_map(|item| if let Item::Corner(p) = item { Some(*p) } else { None })
            .collect();
        let cuboid = items.iter().find_map(|item| match item {
            Item::Cuboid(low, high) => Some((*low, *high)),
            _ => None,
        });
        let (points, weights): (Vec<[f64; 3]>, Vec<f64>) = sites.iter().copied().unzip();
        let d = Delaunay3::from_points(&points).map_err(|error| error.to_string())?;
        let (region, has_inside) = match cuboid {
            Some((low, high)) => (Region3::cuboid(low, high), (0..3).all(|k| low[k] < high[k])),
            None if corners.is_empty() => (Region3::hull(&d), span(&points) == 3),
            None => (Region3::convex(&corners), span(&corners) == 3),
        };
        let region = match region {
            Ok(region) if has_inside => region,
            Err(Error::NoVolume) if !has_inside => return Ok(()),
            other => return Err(format!("a region of {has_inside} inside: {other:?}")),
        };
        if sites.len() >= LEAST_SHARED {
            judge_threads(&d.voronoi(), sites.len(), &region)?;
            let r = Regular3::from_parts(&points, &weights).map_err(|error| error.to_string())?;
            return judge_threads(&r.power(), sites.len(), &region)
                .map_err(|wrong| format!("with weights: {wrong}"));
        }
        let even: Vec<Site> = points.iter().map(|&p| (p, 0.0)).collect();
        judge_cells(&d.voronoi(), &even, &region)?;
        let r = Regular3::from_parts(&points, &weights).map_err(|error| error.to_string())?;
        judge_cells(&r.power(), &sites, &region).map_err(|wrong| format!("with weights: {wrong}"))?;
        let empty = d.duplicates().map(|twin| twin.point).map(VertexId::new);
        none_of(&d.voronoi().clip(&region), empty)?;
        none_of(&r.power().clip(&region), r.hidden())?;
        let mut random = Random::new(seed);
        judge_order(&sites, &region, &mut random)?;
        judge_mirrored(&sites, &region, random.below(3))?;
        judge_scaled(&sites, &region, &mut random)?;
        judge_relaxed(&d, &region)
    }
}

fn none_of(cells: &Cells3, sites: impl Iterator<Item = VertexId>) -> Judgement {
    for v in sites {
        if cells.faces(v).len() > 0 || cells.volume(v) != 0.0 || cells.centroid(v).is_some() {
            return Err(format!("{v:?} is no vertex and has a cell"));
        }
    }
    Ok(())
}

/// The definition, and that all ways to ask give the same.
fn judge_cells(diagram: &impl Diagram, sites: &[Site], region: &Region3) -> Judgement {
    let cells = diagram.clip(region);
    let all: Vec<VertexId> = (0..sites.len()).map(VertexId::new).collect();
    let mut seen = BTreeSet::new();
    let mut wrong = Ok(());
    diagram.each(region, |v, cell| {
        if facts(cell) != facts(cells.cell(v)) && wrong.is_ok() {
            wrong =
                Err(format!("the cell of {v:?} is {:?}, and alone {:?}", facts(cells.cell(v)), facts(cell)));
        }
        seen.insert(v);
    });
    wrong?;
    if let Some(v) = all.iter().find(|v| cells.faces(**v).len() > 0 && !seen.contains(v)) {
        return Err(format!("{v:?} has a cell, and not one after the other"));
    }
    judge_faces(&cells, &all, false)?;
    judge_places(&cells, sites, region)?;
    judge_volumes(&cells, sites, region)?;
    let bounded = diagram.bounded();
    judge_faces(&bounded, &all, true).map_err(|wrong| format!("bounded: {wrong}"))?;
    for &v in &all {
        if bounded.faces(v).len() > 0 && !diagram.is_bounded(v) {
            return Err(format!("the cell of {v:?} is without bounds, and has faces"));
        }
        let neighbors = diagram.neighbors(v);
        for face in bounded.faces(v).chain(cells.faces(v)) {
            let is_one = face.neighbor().is_none_or(|w| neighbors.contains(&w));
            let extent = extent(face.points());
            if !is_one && face.area() > 1e-6 * extent * extent && extent.is_finite() {
                return Err(format!("{v:?} has a face beside {:?}, no neighbor", face.across()));
            }
        }
    }
    Ok(())
}

/// Sites move to the centers of their cells.
fn judge_relaxed(d: &Delaunay3, region: &Region3) -> Judgement {
    let moved = Relaxation3::default().steps(1).run(d, region, |_, _| {});
    let moved = moved.map_err(|error| error.to_string())?;
    let cells = d.voronoi().clip(region);
    for (v, at) in d.vertices().zip(moved) {
        let center = cells.centroid(v).unwrap_or(d.point(v));
        // Without duplicates faces may come in another order.
        let off = 1e-9 * extent(cells.faces(v).flat_map(|face| face.points()));
        if (0..3).any(|k| (at[k] - center[k]).abs() > off) {
            return Err(format!("{v:?} moves to {at:?}, not to {:?}", cells.centroid(v)));
        }
    }
    Relaxation3::default().steps(3).run(d, region, |_, _| {}).map_err(|error| error.to_string())?;
    Ok(())
}
