//! Points in tiles: whatever the cuts, in whatever groups borders are joined, the triangles are those of the definition; and damaged
//! borders are refused.

use std::collections::BTreeMap;

use delone::Delaunay2;
use delone::tiles::{Border, Cut, Cuts, Fingerprint, Node, Tile, join};
use delone_generators::Random;

use crate::attack::{Attack, Judgement};
use crate::nasty::{self, nudged, once_in, pick};
use crate::oracle::delaunay::{delaunay, span};

/// See the module.
pub(crate) struct Tiles;

impl Attack for Tiles {
    type Item = [f64; 2];

    fn make(random: &mut Random) -> Vec<[f64; 2]> {
        nasty::points(random, 40)
    }

    fn judge(points: &[[f64; 2]], seed: u64) -> Judgement {
        let mut random = Random::new(seed);
        let whole = Delaunay2::from_points(points).map_err(|error| error.to_string())?;
        let fingerprint = Fingerprint::of(&whole);
        for _ in 0..4 {
            let cuts = cuts(points, &mut random).map_err(|error| format!("cuts: {error}"))?;
            let (triangles, found) = in_tiles(points, &cuts, &mut random)?;
            if found != fingerprint {
                return Err(format!(
                    "the fingerprint is {found} instead of {fingerprint}, with cuts {:?}",
                    cuts.cuts()
                ));
            }
            let count = if span(points) == 2 { delaunay(points).len() } else { 0 };
            if triangles.len() != count {
                return Err(format!(
                    "{} triangles instead of {count}, with cuts {:?}",
                    triangles.len(),
                    cuts.cuts()
                ));
            }
        }
        Ok(())
    }
}

/// Balanced ones of a sample, or some through points or close beside them.
fn cuts(points: &[[f64; 2]], random: &mut Random) -> Result<Cuts, delone::Error> {
    if points.is_empty() || once_in(random, 3) {
        let sample: Vec<[f64; 2]> = points.iter().copied().filter(|_| once_in(random, 2)).collect();
        return Cuts::from_sample(&sample, 1 + random.below(12));
    }
    let mut cuts = Cuts::default();
    for _ in 0..random.below(12) {
        let node = pick(random, &cuts.tiles());
        let axis = random.below(2);
        let p = pick(random, points)[axis];
        let at = nudged(random, p);
        let more = cuts.cuts().into_iter().chain([(node, Cut { axis, at })]);
        // Not all are inside of their regions.
        cuts = Cuts::from_cuts(more).unwrap_or(cuts);
    }
    Ok(cuts)
}

fn in_tiles(
    points: &[[f64; 2]],
    cuts: &Cuts,
    random: &mut Random,
) -> Result<(Vec<[usize; 3]>, Fingerprint), String> {
    let mut borders: BTreeMap<Node, Border> = BTreeMap::new();
    let (mut triangles, mut fingerprint) = (Vec::new(), Fingerprint::default());
    for node in cuts.tiles() {
        let mine: Vec<usize> = (0..points.len()).filter(|&i| cuts.tile_of(points[i]) == node).collect();
        let its: Vec<[f64; 2]> = mine.iter().map(|&i| points[i]).collect();
        let tile = Tile::new(&its, &cuts.region(node)).map_err(|error| format!("tile {node:?}: {error}"))?;
        let index = |v: u32| mine[tile.order()[v as usize] as usize];
        triangles.extend(tile.finals().map(|t| t.map(index)));
        fingerprint += tile.fingerprint();
        borders.insert(node, sent(&tile.border(|v| index(v) as u64), random)?);
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
        let seam = join(&parts, &cuts.region(node)).map_err(|error| format!("join {node:?}: {error}"))?;
        triangles.extend(seam.triangles.iter().map(|t| t.map(|i| i as usize)));
        fingerprint += seam.fingerprint;
        borders.insert(node, sent(&seam.border, random)?);
    }
    Ok((triangles, fingerprint))
}

/// A border as it arrives elsewhere; damaged on the way it must not.
fn sent(border: &Border, random: &mut Random) -> Result<Border, String> {
    let mut bytes = border.to_bytes();
    let arrived = Border::from_bytes(&bytes).map_err(|problem| format!("a border: {problem}"))?;
    let at = random.below(bytes.len());
    bytes[at] ^= 1 << random.below(8);
    if Border::from_bytes(&bytes).is_ok() {
        return Err(format!("byte {at} of a border was changed, and nobody saw it"));
    }
    Ok(arrived)
}
