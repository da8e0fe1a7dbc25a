//! Points in tiles, of the plane and of space: whatever the cuts, in whatever groups borders are joined, the simplices are those of the
//! definition, with the fingerprint that they have in memory; and damaged borders are refused.

use std::collections::BTreeMap;

use delone::tiles::{BorderOf, Cut, Cuts, Fingerprint, Node, Region, Tile, Tile3, join, join3};
use delone::{Delaunay2, Delaunay3, Error};
use delone_generators::Random;

use crate::attack::{Attack, Judgement};
use crate::nasty::{self, nudged, once_in, pick};
use crate::oracle::delaunay::{Simplices, delaunay, span};

/// Tiles of the plane.
pub(crate) struct Planar;

/// Tiles of space.
pub(crate) struct Spatial;

impl Attack for Planar {
    type Item = [f64; 2];

    fn make(random: &mut Random) -> Vec<[f64; 2]> {
        nasty::points(random, 40)
    }

    fn judge(points: &[[f64; 2]], seed: u64) -> Judgement {
        judge::<Self, 2, 3>(points, seed)
    }
}

impl Attack for Spatial {
    type Item = [f64; 3];

    fn make(random: &mut Random) -> Vec<[f64; 3]> {
        nasty::points(random, 22)
    }

    fn judge(points: &[[f64; 3]], seed: u64) -> Judgement {
        judge::<Self, 3, 4>(points, seed)
    }
}

/// The result of a tile: the indices of its vertices among the points, what is final, and the border, named by these indices.
struct Told<const D: usize, const C: usize> {
    order: Vec<u32>,
    finals: Vec<[u32; C]>,
    fingerprint: Fingerprint,
    border: BorderOf<D, C>,
}

/// The simplices of a seam, their fingerprint, and the border.
type Joined<const D: usize, const C: usize> = (Vec<[u64; C]>, Fingerprint, BorderOf<D, C>);

/// The engine of a dimension.
trait Engine<const D: usize, const C: usize> {
    fn whole(points: &[[f64; D]]) -> Result<Fingerprint, Error>;
    fn tile(points: &[[f64; D]], region: &Region<D>, name: impl Fn(u32) -> u64) -> Result<Told<D, C>, Error>;
    fn join(borders: &[BorderOf<D, C>], region: &Region<D>) -> Result<Joined<D, C>, Error>;
}

impl Engine<2, 3> for Planar {
    fn whole(points: &[[f64; 2]]) -> Result<Fingerprint, Error> {
        Ok(Fingerprint::of(&Delaunay2::from_points(points)?))
    }

    fn tile(points: &[[f64; 2]], region: &Region, name: impl Fn(u32) -> u64) -> Result<Told<2, 3>, Error> {
        let tile = Tile::new(points, region)?;
        let border = tile.border(|v| name(tile.order()[v as usize]));
        let finals = tile.finals().collect();
        Ok(Told { order: tile.order().to_vec(), finals, fingerprint: tile.fingerprint(), border })
    }

    fn join(borders: &[BorderOf<2, 3>], region: &Region) -> Result<Joined<2, 3>, Error> {
        let seam = join(borders, region)?;
        Ok((seam.triangles, seam.fingerprint, seam.border))
    }
}

impl Engine<3, 4> for Spatial {
    fn whole(points: &[[f64; 3]]) -> Result<Fingerprint, Error> {
        Ok(Fingerprint::of(&Delaunay3::from_points(points)?))
    }

    fn tile(points: &[[f64; 3]], region: &Region<3>, name: impl Fn(u32) -> u64) -> Result<Told<3, 4>, Error> {
        let tile = Tile3::new(points, region)?;
        let border = tile.border(|v| name(tile.order()[v as usize]));
        let finals = tile.finals().collect();
        Ok(Told { order: tile.order().to_vec(), finals, fingerprint: tile.fingerprint(), border })
    }

    fn join(borders: &[BorderOf<3, 4>], region: &Region<3>) -> Result<Joined<3, 4>, Error> {
        let seam = join3(borders, region)?;
        Ok((seam.tetrahedra, seam.fingerprint, seam.border))
    }
}

fn judge<E: Engine<D, C>, const D: usize, const C: usize>(points: &[[f64; D]], seed: u64) -> Judgement {
    let mut random = Random::new(seed);
    let fingerprint = E::whole(points).map_err(|error| error.to_string())?;
    let expected = if span(points) == D as isize { delaunay(points) } else { Vec::new() };
    for _ in 0..4 {
        let cuts = cuts(points, &mut random).map_err(|error| format!("cuts: {error}"))?;
        let (simplices, found) = in_tiles::<E, D, C>(points, &cuts, &mut random)?;
        if simplices != expected {
            let extra: Vec<_> = simplices.iter().filter(|s| !expected.contains(s)).take(2).collect();
            let missing: Vec<_> = expected.iter().filter(|s| !simplices.contains(s)).take(2).collect();
            return Err(format!(
                "{} simplices instead of {}; too much {extra:?}, missing {missing:?}, with cuts {:?}",
                simplices.len(),
                expected.len(),
                cuts.cuts()
            ));
        }
        if found != fingerprint {
            return Err(format!(
                "the fingerprint is {found} instead of {fingerprint}, with cuts {:?}",
                cuts.cuts()
            ));
        }
    }
    Ok(())
}

/// Balanced ones of a sample, or some through points or close beside them.
fn cuts<const D: usize>(points: &[[f64; D]], random: &mut Random) -> Result<Cuts<D>, Error> {
    if points.is_empty() || once_in(random, 3) {
        let sample: Vec<[f64; D]> = points.iter().copied().filter(|_| once_in(random, 2)).collect();
        return Cuts::from_sample(&sample, 1 + random.below(12));
    }
    let mut cuts = Cuts::default();
    for _ in 0..random.below(12) {
        let node = pick(random, &cuts.tiles());
        let axis = random.below(D);
        let p = pick(random, points)[axis];
        let at = nudged(random, p);
        let more = cuts.cuts().into_iter().chain([(node, Cut { axis, at })]);
        // Not all are inside of their regions.
        cuts = Cuts::from_cuts(more).unwrap_or(cuts);
    }
    Ok(cuts)
}

/// The simplices as the oracle has them, and their fingerprint.
fn in_tiles<E: Engine<D, C>, const D: usize, const C: usize>(
    points: &[[f64; D]],
    cuts: &Cuts<D>,
    random: &mut Random,
) -> Result<(Simplices<D>, Fingerprint), String> {
    let mut borders: BTreeMap<Node, BorderOf<D, C>> = BTreeMap::new();
    let (mut simplices, mut fingerprint) = (Vec::new(), Fingerprint::default());
    for node in cuts.tiles() {
        let mine: Vec<usize> = (0..points.len()).filter(|&i| cuts.tile_of(points[i]) == node).collect();
        let its: Vec<[f64; D]> = mine.iter().map(|&i| points[i]).collect();
        let tile = E::tile(&its, &cuts.region(node), |i| mine[i as usize] as u64)
            .map_err(|error| format!("tile {node:?}: {error}"))?;
        simplices
            .extend(tile.finals.iter().map(|t| t.map(|v| points[mine[tile.order[v as usize] as usize]])));
        fingerprint += tile.fingerprint;
        borders.insert(node, sent(&tile.border, random)?);
    }
    // From below: a node that is joined is a part for those above.
    let mut nodes: Vec<Node> = cuts.cuts().into_iter().map(|(node, _)| node).collect();
    if nodes.is_empty() {
        nodes.push(Node::ROOT);
    }
    while let Some(node) = nodes.pop() {
        if node != Node::ROOT && once_in(random, 2) {
            continue;
        }
        let mut parts = Vec::new();
        let mut waiting = vec![node];
        while let Some(part) = waiting.pop() {
            match borders.remove(&part) {
                Some(border) => parts.push(border),
                None => waiting.extend(cuts.halves(part).into_iter().flatten()),
            }
        }
        let (more, its, border) =
            E::join(&parts, &cuts.region(node)).map_err(|error| format!("join {node:?}: {error}"))?;
        simplices.extend(more.into_iter().map(|t| t.map(|i| points[i as usize])));
        fingerprint += its;
        borders.insert(node, sent(&border, random)?);
    }
    let normal = |simplex: [[f64; D]; C]| {
        let mut corners = simplex.map(|p| p.map(|x| x + 0.0)).to_vec();
        corners.sort_by(|p, q| p.partial_cmp(q).expect("finite"));
        corners
    };
    let mut simplices: Simplices<D> = simplices.into_iter().map(normal).collect();
    simplices.sort_by(|s, t| s.partial_cmp(t).expect("finite"));
    Ok((simplices, fingerprint))
}

/// A border as it arrives elsewhere; damaged on the way it must not.
fn sent<const D: usize, const C: usize>(
    border: &BorderOf<D, C>,
    random: &mut Random,
) -> Result<BorderOf<D, C>, String> {
    let mut bytes = border.to_bytes();
    let arrived = BorderOf::from_bytes(&bytes).map_err(|problem| format!("a border: {problem}"))?;
    let at = random.below(bytes.len());
    bytes[at] ^= 1 << random.below(8);
    if BorderOf::<D, C>::from_bytes(&bytes).is_ok() {
        return Err(format!("byte {at} of a border was changed, and nobody saw it"));
    }
    Ok(arrived)
}
