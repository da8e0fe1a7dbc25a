//! Points with weights: built in all ways, grown, reweighed and taken away, they are what the definition says at every step.

use delone::{Bounds, Region2, Regular, Regular2, Regular3, VertexId};
use delone_generators::Random;
use delone_oracle::power::Lifted;

use crate::attack::{Attack, Judgement};
use crate::nasty::{self, once_in};
use crate::oracle::rings::{Ring, tile};

/// A point and its weight.
type Site<const D: usize> = ([f64; D], f64);

/// In the plane.
pub(crate) struct Planar;

/// In space.
pub(crate) struct Spatial;

/// A construction of points, weights and a seed, with its name.
type Build<const D: usize, R> = (&'static str, fn(&[[f64; D]], &[f64], u64) -> Result<R, delone::Error>);

/// Whether it is the triangulation of the sites that it has.
fn judge<const D: usize>(r: &impl Regular<Point = [f64; D]>, what: &str) -> Judgement {
    r.check().map_err(|flaw| format!("{what}: check: {flaw}"))?;
    let alive = (0..r.ids_given()).map(VertexId::new).filter_map(|v| Some((v, r.site(v)?)));
    let alive: Vec<(VertexId, Site<D>)> = alive.collect();
    let is_first = |i: usize| alive[..i].iter().all(|other| other.1 != alive[i].1);
    let distinct: Vec<(VertexId, Site<D>)> =
        (0..alive.len()).filter(|&i| is_first(i)).map(|i| alive[i]).collect();
    if distinct.is_empty() {
        return if r.vertex_count() == 0 { Ok(()) } else { Err(format!("{what}: vertices of nothing")) };
    }
    let lifted = Lifted::new(&distinct.iter().map(|site| site.1).collect::<Vec<_>>());
    let expected: Vec<Vec<VertexId>> =
        lifted.regular().iter().map(|simplex| simplex.iter().map(|&i| distinct[i].0).collect()).collect();
    let mut vertices: Vec<VertexId> = expected.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    let found: Vec<VertexId> = r.vertices().collect();
    if found != vertices {
        return Err(format!("{what}: vertices {found:?} instead of {vertices:?}"));
    }
    let corners = |s| {
        let mut corners = r.corners(s).as_ref().to_vec();
        corners.sort_unstable();
        corners
    };
    let mut found: Vec<Vec<VertexId>> = r.simplices().map(corners).collect();
    found.sort_unstable();
    let expected = if lifted.dimension() == D { expected } else { Vec::new() };
    if found != expected {
        return Err(format!("{what}: simplices {found:?} instead of {expected:?}"));
    }
    Ok(())
}

fn live<const D: usize, R: Regular<Point = [f64; D]>>(
    sites: &[Site<D>],
    seed: u64,
    others: &[Build<D, R>],
) -> Judgement {
    let failed = |error: delone::Error| error.to_string();
    let mut random = Random::new(seed);
    let (points, weights): (Vec<_>, Vec<_>) = sites.iter().copied().unzip();
    let mut r = R::from_parts(&points, &weights).map_err(failed)?;
    judge(&r, "built")?;
    for (what, build) in others {
        let other = build(&points, &weights, seed).map_err(failed)?;
        judge(&other, what)?;
        if !other.duplicates().eq(r.duplicates()) {
            return Err(format!("{what}: other duplicates"));
        }
    }
    for step in 0..sites.len() {
        let alive: Vec<VertexId> =
            (0..r.ids_given()).map(VertexId::new).filter(|&v| r.site(v).is_some()).collect();
        let other = sites[random.below(sites.len())];
        let what = if alive.is_empty() || (alive.len() < sites.len() && once_in(&mut random, 2)) {
            format!("step {step}: insert {:?}: {:?}", r.insert(other.0, other.1).map_err(failed)?, other)
        } else if once_in(&mut random, 4) {
            let turn = random.below(sites.len());
            let weights: Vec<f64> = (0..r.ids_given()).map(|i| sites[(i + turn) % sites.len()].1).collect();
            format!("step {step}: all weigh {weights:?}: {:?}", r.set_weights(&weights).map_err(failed)?)
        } else {
            let v = alive[random.below(alive.len())];
            if once_in(&mut random, 2) {
                r.remove(v).map_err(failed)?;
                format!("step {step}: remove {v:?}")
            } else {
                r.set_weight(v, other.1).map_err(failed)?;
                format!("step {step}: {v:?} weighs {:?}", other.1)
            }
        };
        judge(&r, &what)?;
    }
    Ok(())
}

/// Power cells tile a rectangle.
fn judge_cells(sites: &[Site<2>], seed: u64) -> Judgement {
    let mut random = Random::new(seed);
    let points: Vec<[f64; 2]> = sites.iter().map(|site| site.0).collect();
    let corners = [(); 2].map(|()| nasty::query(&mut random, &points));
    let around: &[[f64; 2]] = if once_in(&mut random, 2) { &points } else { &[] };
    let bounds = Bounds::of(corners.iter().chain(around).copied());
    let Ok(region) = Region2::rectangle(bounds.low, bounds.high) else { return Ok(()) };
    let r = Regular2::from_sites(sites).map_err(|error| error.to_string())?;
    if r.vertex_count() == 0 {
        return Ok(());
    }
    let cells = r.power().clip(&region);
    let of = |v| cells.rings(v).map(|ring| ring.points().collect()).collect::<Vec<Ring>>();
    let border: Vec<Ring> = region.rings().map(<[_]>::to_vec).collect();
    tile(&r.vertices().map(of).collect::<Vec<_>>(), &border)
        .map_err(|wrong| format!("cells in {:?}, {:?}: {wrong}", bounds.low, bounds.high))
}

impl Attack for Planar {
    type Item = Site<2>;

    fn make(random: &mut Random) -> Vec<Site<2>> {
        let points = if once_in(random, 3) { nasty::everyday(random, 12) } else { nasty::points(random, 10) };
        nasty::weighted(random, points)
    }

    fn judge(sites: &[Site<2>], seed: u64) -> Judgement {
        live::<2, Regular2>(sites, seed, &[("one by one", Regular2::with_seed)])?;
        judge_cells(sites, seed)
    }
}

impl Attack for Spatial {
    type Item = Site<3>;

    fn make(random: &mut Random) -> Vec<Site<3>> {
        let points = nasty::points(random, 8);
        nasty::weighted(random, points)
    }

    fn judge(sites: &[Site<3>], seed: u64) -> Judgement {
        let others: [Build<3, Regular3>; 2] =
            [("one by one", Regular3::with_seed), ("by flips", Regular3::by_flips)];
        live::<3, Regular3>(sites, seed, &others)
    }
}
