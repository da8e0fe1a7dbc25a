//! The areas between levels, as polygons.
//!
//! A band is on the left of the line at its lower level, on the right of that at its upper one, and on the left of the border of the
//! triangles. So its rings are followed: along a line to the border, along the border to where the next line begins, until they close.
//! Which rings belong to one polygon is known before anything is rounded: the parts of triangles in a band are joined across edges, and
//! each set of joined parts is one polygon. Seams, where a ridge or plain at a level has no area, are taken out, which joins more.
//!
//! Cost: O(t + k log k) for t triangles and k points.

use std::collections::BTreeMap;

use crate::sets::Sets;
use crate::sorting;

use super::ContourBand;
use super::link::{Path, mend};
use super::loops::{compare, holds, simple, turns_left};
use super::sheet::{Edge, Sheet};
use super::trace::{Chain, Cut};

type Ring = Vec<[f64; 2]>;

/// All bands that are not empty, by height.
pub(super) fn assemble(cut: &Cut<'_>) -> Vec<ContourBand> {
    let chains = cut.chains();
    let mut walker = Walker::new(cut, &chains);
    // For each band its rings, each with the set of parts that it belongs to.
    let mut found: BTreeMap<u32, Vec<Path>> = BTreeMap::new();
    let mut parts = Parts::new(cut);
    let mut add = |band: u32, part: u32, points: Ring| {
        found.entry(band).or_default().push(Path { set: part, points, is_closed: true });
    };
    for (number, chain) in chains.iter().enumerate() {
        let level = chain.level as u32;
        for (band, upper) in [(level + 1, false), (level, true)] {
            let ring = match (chain.is_closed, upper) {
                (true, false) => Some(chain.points.clone()),
                (true, true) => Some(chain.points.iter().rev().copied().collect()),
                (false, _) => walker.ring(number, band, upper),
            };
            if let Some(ring) = ring {
                add(band, parts.root(cut, chain.ends[0] / 3, band), ring);
            }
        }
    }
    for (edge, ring) in walker.rest() {
        let band = cut.band[cut.sheet.ends(edge)[0] as usize];
        add(band, parts.root(cut, edge / 3, band), ring);
    }
    let mut bands: Vec<ContourBand> = Vec::new();
    for (band, paths) in found {
        // Parts that meet along a seam are one.
        let mended = mend(paths, |i, j| _ = parts.sets.join(i, j));
        let mut rings: BTreeMap<u32, Vec<Ring>> = BTreeMap::new();
        for (path, is_touched) in mended {
            let part = parts.sets.find(path.set);
            rings.entry(part).or_default().extend(simple((path, is_touched)).into_iter().map(|ring| ring.0));
        }
        let at =
            |level: Option<usize>, beyond| level.and_then(|k| cut.levels.get(k)).copied().unwrap_or(beyond);
        let (lower, upper) =
            (at((band as usize).checked_sub(1), f64::NEG_INFINITY), at(Some(band as usize), f64::INFINITY));
        let polygons = rings.into_values().flat_map(polygons).collect();
        bands.push(ContourBand { lower, upper, polygons });
    }
    for band in &mut bands {
        sorting::by(&mut band.polygons, |a, b| compare(&a[0], &b[0]));
    }
    bands.retain(|band| !band.polygons.is_empty());
    bands
}

/// The polygons of the rings of one set of parts: one, unless it is held together by points alone.
fn polygons(rings: Vec<Ring>) -> Vec<Vec<Ring>> {
    let (mut polygons, mut holes) = (Vec::new(), Vec::new());
    for ring in rings {
        match turns_left(&ring) {
            Some(true) => polygons.push(vec![ring]),
            Some(false) => holes.push(ring),
            None => {}
        }
    }
    sorting::by(&mut holes, |a, b| compare(a, b));
    // The smallest that hold a hole come first: what is inside of another begins further on.
    sorting::by(&mut polygons, |a: &Vec<Ring>, b| compare(&b[0], &a[0]));
    for hole in holes {
        let strictly =
            |polygon: &Vec<Ring>| hole.iter().any(|q| !polygon[0].contains(q) && holds(&polygon[0], *q));
        let touching =
            |polygon: &Vec<Ring>| hole.iter().all(|q| polygon[0].contains(q) || holds(&polygon[0], *q));
        let holder = match &polygons[..] {
            [_] => Some(0),
            // Where rounding hides which, the one that begins first: the area stays what it is.
            _ => polygons
                .iter()
                .position(strictly)
                .or_else(|| polygons.iter().position(touching))
                .or_else(|| polygons.len().checked_sub(1)),
        };
        if let Some(holder) = holder {
            polygons[holder].push(hole);
        }
    }
    polygons
}

/// Follows rings along lines and the border.
struct Walker<'a> {
    cut: &'a Cut<'a>,
    chains: &'a [Chain],
    /// Open lines by level and the edge that they come in through, and by that they go out through.
    entries: BTreeMap<(usize, Edge), usize>,
    exits: BTreeMap<(usize, Edge), usize>,
    /// The border edge after each.
    next: BTreeMap<Edge, Edge>,
    /// Border edges whose beginning is on a ring.
    seen: BTreeMap<Edge, bool>,
    /// Lines that are the lower, and the upper, side of a ring.
    used: [Vec<bool>; 2],
}

impl<'a> Walker<'a> {
    fn new(cut: &'a Cut<'a>, chains: &'a [Chain]) -> Self {
        let open = || chains.iter().enumerate().filter(|(_, chain)| !chain.is_closed);
        let border = cut.sheet.border();
        Self {
            cut,
            chains,
            entries: open().map(|(i, chain)| ((chain.level, chain.ends[0]), i)).collect(),
            exits: open().map(|(i, chain)| ((chain.level, chain.ends[1]), i)).collect(),
            next: border.iter().map(|&e| (e, cut.sheet.next_on_border(e))).collect(),
            seen: border.iter().map(|&e| (e, false)).collect(),
            used: [vec![false; chains.len()], vec![false; chains.len()]],
        }
    }

    /// The ring of a band that an open line is a part of, unless it was followed before: a line at the lower level forwards, one at the
    /// upper level backwards.
    fn ring(&mut self, chain: usize, band: u32, upper: bool) -> Option<Ring> {
        let mut ring = Ring::new();
        let (mut chain, mut upper) = (chain, upper);
        loop {
            if std::mem::replace(&mut self.used[usize::from(upper)][chain], true) {
                return (!ring.is_empty()).then_some(ring);
            }
            let followed = &self.chains[chain];
            let end = if upper {
                ring.extend(followed.points.iter().rev());
                followed.ends[0]
            } else {
                ring.extend(&followed.points);
                followed.ends[1]
            };
            (chain, upper) = self.along_border(end, band, &mut ring)?;
        }
    }

    /// Goes on along the border from inside of an edge to where a line of the band leaves it; which one, and whether it is the upper one.
    fn along_border(&mut self, mut e: Edge, band: u32, ring: &mut Ring) -> Option<(usize, bool)> {
        loop {
            let end = self.cut.sheet.ends(e)[1];
            let there = self.cut.band[end as usize];
            if there > band {
                return self.exits.get(&(band as usize, e)).map(|&chain| (chain, true));
            }
            if there < band {
                return self.entries.get(&(band as usize - 1, e)).map(|&chain| (chain, false));
            }
            ring.push(self.cut.sheet.points[end as usize]);
            e = *self.next.get(&e)?;
            self.seen.insert(e, true);
        }
    }

    /// The rings of the border that no line meets, each with one of its edges.
    fn rest(mut self) -> Vec<(Edge, Ring)> {
        let mut rings = Vec::new();
        let edges: Vec<Edge> = self.seen.keys().copied().collect();
        for start in edges {
            let mut ring = Ring::new();
            let mut e = start;
            while self.seen.insert(e, true) == Some(false) {
                ring.push(self.cut.sheet.points[self.cut.sheet.ends(e)[0] as usize]);
                e = self.next.get(&e).copied().unwrap_or(start);
            }
            if !ring.is_empty() {
                rings.push((start, ring));
            }
        }
        rings
    }
}

/// The parts of triangles in bands, joined across edges.
struct Parts {
    /// For each triangle the number of its first part.
    first: Vec<u64>,
    sets: Sets,
}

impl Parts {
    fn new(cut: &Cut<'_>) -> Self {
        let mut first = vec![0];
        let mut count = 0;
        for t in 0..cut.sheet.corners.len() as u32 {
            let [low, high] = cut.bands_of(t);
            count += u64::from(high - low) + 1;
            first.push(count);
        }
        let mut parts = Self { first, sets: Sets::new(count as usize) };
        for e in (0..cut.sheet.corners.len() as u32).flat_map(Sheet::edges) {
            let Some(other) = cut.sheet.beyond(e).filter(|&other| other > e / 3) else { continue };
            let [a, b] = cut.sheet.ends(e).map(|v| cut.band[v as usize]);
            for band in a.min(b)..=a.max(b) {
                let [i, j] = [e / 3, other].map(|t| parts.root(cut, t, band));
                parts.sets.join(i, j);
            }
        }
        parts
    }

    /// The representative of the set of a part.
    fn root(&mut self, cut: &Cut<'_>, t: u32, band: u32) -> u32 {
        self.sets.find((self.first[t as usize] + u64::from(band - cut.bands_of(t)[0])) as u32)
    }
}
