//! Points with weights: built in all ways, grown, reweighed and taken away, they are what the definition says at every step.

use delone::{Regular2, Regular3, Triangulation, VertexId};
use delone_generators::Random;
use delone_oracle::power::Lifted;

use crate::attack::{Attack, Judgement};
use crate::nasty::{self, once_in};

/// A point and its weight.
type Site<const D: usize> = ([f64; D], f64);

/// In the plane.
pub(crate) struct Planar;

/// In space.
pub(crate) struct Spatial;

/// What both kinds can do.
trait Regular<const D: usize>: Triangulation<Point = [f64; D]> + Sized {
    fn build(sites: &[Site<D>]) -> Result<Self, delone::Error>;
    /// By all other algorithms, with their names.
    fn otherwise(sites: &[Site<D>], seed: u64) -> Result<Vec<(&'static str, Self)>, delone::Error>;
    fn site(&self, v: VertexId) -> Option<Site<D>>;
    fn insert(&mut self, site: Site<D>) -> Result<VertexId, delone::Error>;
    fn remove(&mut self, v: VertexId) -> Result<(), delone::Error>;
    fn weigh(&mut self, v: VertexId, weight: f64) -> Result<(), delone::Error>;
}

/// Points, weights, a seed.
type Build<const D: usize, R> = fn(&[[f64; D]], &[f64], u64) -> Result<R, delone::Error>;

macro_rules! regular {
    ($kind:ident, $d:literal, $others:expr) => {
        impl Regular<$d> for $kind {
            fn build(sites: &[Site<$d>]) -> Result<Self, delone::Error> {
                Self::from_sites(sites)
            }

            fn otherwise(sites: &[Site<$d>], seed: u64) -> Result<Vec<(&'static str, Self)>, delone::Error> {
                let (points, weights): (Vec<_>, Vec<_>) = sites.iter().copied().unzip();
                let by_name =
                    |(what, build): (_, Build<$d, Self>)| Ok((what, build(&points, &weights, seed)?));
                $others.into_iter().map(by_name).collect()
            }

            fn site(&self, v: VertexId) -> Option<Site<$d>> {
                self.site(v)
            }

            fn insert(&mut self, (p, w): Site<$d>) -> Result<VertexId, delone::Error> {
                self.insert(p, w).map(delone::Inserted::vertex)
            }

            fn remove(&mut self, v: VertexId) -> Result<(), delone::Error> {
                self.remove(v)
            }

            fn weigh(&mut self, v: VertexId, weight: f64) -> Result<(), delone::Error> {
                self.set_weight(v, weight)
            }
        }
    };
}

regular!(Regular2, 2, [("one by one", Self::with_seed as Build<2, Self>)]);
regular!(Regular3, 3, [("one by one", Self::with_seed as Build<3, Self>), ("by flips", Self::by_flips)]);

/// Whether it is the triangulation of the sites that it has.
fn judge<const D: usize>(r: &impl Regular<D>, what: &str) -> Judgement {
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

fn live<const D: usize, R: Regular<D>>(sites: &[Site<D>], seed: u64) -> Judgement {
    let failed = |error: delone::Error| error.to_string();
    let mut random = Random::new(seed);
    let mut r = R::build(sites).map_err(failed)?;
    judge(&r, "built")?;
    for (what, other) in R::otherwise(sites, seed).map_err(failed)? {
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
            format!("step {step}: insert {:?}: {:?}", r.insert(other).map_err(failed)?, other)
        } else {
            let v = alive[random.below(alive.len())];
            if once_in(&mut random, 2) {
                r.remove(v).map_err(failed)?;
                format!("step {step}: remove {v:?}")
            } else {
                r.weigh(v, other.1).map_err(failed)?;
                format!("step {step}: {v:?} weighs {:?}", other.1)
            }
        };
        judge(&r, &what)?;
    }
    Ok(())
}

impl Attack for Planar {
    type Item = Site<2>;

    fn make(random: &mut Random) -> Vec<Site<2>> {
        let points = nasty::points(random, 10);
        nasty::weighted(random, points)
    }

    fn judge(sites: &[Site<2>], seed: u64) -> Judgement {
        live::<2, Regular2>(sites, seed)
    }
}

impl Attack for Spatial {
    type Item = Site<3>;

    fn make(random: &mut Random) -> Vec<Site<3>> {
        let points = nasty::points(random, 8);
        nasty::weighted(random, points)
    }

    fn judge(sites: &[Site<3>], seed: u64) -> Judgement {
        live::<3, Regular3>(sites, seed)
    }
}
