//! Verification: whether tiles and seams are the canonical triangulation of their points, proved by exact decisions.
//!
//! Every triangle is counter-clockwise; across every edge is another triangle, in the other direction, whose far corner is outside of
//! the circle under the canonical rule; edges without are the border, which is convex and goes around once; and there are as
//! many triangles as so many vertices have. So triangles cover the inside of the border once, and are locally, hence all, Delaunay.
//! Each vertex has an index of its own among the points. One tile at a time; what has no twin in its tile waits for the seams. What no
//! proof can know (which index is whose, heights, neighbors, tables) is held to the hashes of what was written.
//!
//! Cost: O(n log n); memory for the largest tile, some 250 bytes a point, for all edges between tiles, and a bit
//! for each point.

use std::collections::BTreeMap;
use std::path::Path;

use delone::tiles::{Fingerprint, Node};
use delone_predicates::{Sign, in_circle, lexicographic, orient2d};
use rayon::prelude::*;

use crate::error::Error;
use crate::manifest::Manifest;
use crate::node::Done;
use crate::places::place;
use crate::shards;
use crate::store::Store;
use crate::sums::{self, Sums};
use crate::watch::{Phase, Watch};

/// A corner by its name, and where it is.
type Corner = (u64, [f64; 2]);

/// A directed edge with its triangle on the left, whose third corner is the apex.
#[derive(Clone, Copy)]
struct Edge {
    from: Corner,
    to: Corner,
    apex: Corner,
}

impl Edge {
    /// The key of an edge, equal for both directions.
    fn key(&self) -> [u64; 2] {
        [self.from.0.min(self.to.0), self.from.0.max(self.to.0)]
    }
}

impl Store {
    /// Proves by exact decisions that tiles and seams are the canonical triangulation of their points, and that no file was changed.
    ///
    /// # Errors
    /// [`Error::Changed`] with the file and the fault; [`Error::Unknown`]; [`Error::Stopped`].
    pub fn verify(&self, watch: &dyn Watch) -> Result<(), Error> {
        verify(self, watch)
    }
}

/// Judges a folder.
fn verify(store: &Store, watch: &dyn Watch) -> Result<(), Error> {
    let (folder, plan, outcome) = (&*store.folder, &store.plan, &store.outcome);
    let wrong = |what: String| Error::changed(folder, what);
    let nodes = store.nodes();
    let (tiles, seams): (Vec<Done>, Vec<Done>) =
        nodes.partition(|done| plan.cuts.halves(done.node).is_none());
    let phase = Phase::count(watch, "checking", (tiles.len() + seams.len()) as u64);
    let words = plan.count.div_ceil(64) as usize;
    let mut known = Vec::new();
    if known.try_reserve_exact(words).is_err() {
        return Err(wrong(format!("{} points are more than memory has bits", plan.count)));
    }
    known.resize(words, 0);
    let mut judge =
        Judge { folder, plan, waiting: Vec::new(), fingerprint: Fingerprint::default(), vertices: 0, known };
    for tile in &tiles {
        judge.tile(tile)?;
        tile.check_files(folder, &plan.cuts)?;
        phase.advance()?;
    }
    for seam in &seams {
        judge.seam(seam)?;
        seam.check_files(folder, &plan.cuts)?;
        phase.advance()?;
    }
    drop(phase);
    let known: Vec<&Sums> = tiles.iter().chain(&seams).map(|done| &done.sums).collect();
    sums::check_known(folder, &known)?;
    if judge.fingerprint != outcome.fingerprint {
        return Err(wrong(format!(
            "its fingerprint is {}, and tiles.json has {}",
            judge.fingerprint, outcome.fingerprint
        )));
    }
    let (triangles, vertices) = (judge.fingerprint.count(), judge.vertices);
    let hull = judge.outline()?;
    if triangles == 0 {
        judge.line(&tiles)?;
    } else if triangles + hull + 2 != 2 * vertices || hull != outcome.hull {
        return Err(wrong(format!(
            "{triangles} triangles and {hull} edges of the hull are not those of {vertices} vertices"
        )));
    }
    Ok(())
}

struct Judge<'a> {
    folder: &'a Path,
    plan: &'a Manifest,
    /// Edges without a twin so far.
    waiting: Vec<Edge>,
    fingerprint: Fingerprint,
    vertices: u64,
    /// A bit for each point of the input, set if a vertex was seen that is it.
    known: Vec<u64>,
}

impl Judge<'_> {
    fn points(&self, node: Node) -> Result<Vec<[f64; 2]>, Error> {
        let cloud = shards::points(self.folder, node)?;
        if cloud.z.is_some() != self.plan.has_heights {
            let path = place(self.folder, "points", node, "npy");
            return Err(Error::changed(&path, "tiles.json says otherwise whether there are heights"));
        }
        Ok(cloud.xy)
    }

    /// Whether the vertices of a tile are points of the input that no other vertex is.
    fn ids(&mut self, tile: &Done) -> Result<(), Error> {
        let path = place(self.folder, "ids", tile.node, "npy");
        // Numbers that a float does not hold are beyond all points.
        let ids = shards::ids(self.folder, tile.node)?;
        if ids.len() as u64 != tile.vertices {
            return Err(Error::changed(&path, format!("{} indices of {} points", ids.len(), tile.vertices)));
        }
        for (row, id) in ids.into_iter().enumerate() {
            let index = id as u64;
            if id.fract() != 0.0 || id < 0.0 || index >= self.plan.count {
                let what = format!("row {row} is {id}, and there are {} points", self.plan.count);
                return Err(Error::changed(&path, what));
            }
            let (word, bit) = (&mut self.known[(index / 64) as usize], 1 << (index % 64));
            if *word & bit != 0 {
                return Err(Error::changed(
                    &path,
                    format!("row {row} is point {index}, which is another vertex"),
                ));
            }
            *word |= bit;
        }
        Ok(())
    }

    /// Judges the triangles of a tile, all edges between two of them, and keeps the others.
    fn tile(&mut self, tile: &Done) -> Result<(), Error> {
        let points = self.points(tile.node)?;
        let region = self.plan.cuts.region(tile.node);
        let path = place(self.folder, "points", tile.node, "npy");
        if points.len() as u64 != tile.vertices {
            return Err(Error::changed(
                &path,
                format!("{} points, and tiles.json has {}", points.len(), tile.vertices),
            ));
        }
        if let Some(outside) = points.iter().position(|&p| !region.contains(p)) {
            return Err(Error::changed(&path, format!("point {outside} is not in the region of the tile")));
        }
        self.ids(tile)?;
        self.vertices += tile.vertices;
        let path = place(self.folder, "triangles", tile.node, "npy");
        let triangles = shards::triangles(&path)?;
        let id = |v: u64| {
            u32::try_from(v)
                .ok()
                .filter(|&v| (v as usize) < points.len())
                .map(|v| (tile.node.id(v), points[v as usize]))
        };
        self.judge(&path, &triangles, tile, id)?;
        let rest = pair_in_tile(&path, &points, &triangles)?;
        let name = |v: u32| (tile.node.id(v), points[v as usize]);
        self.waiting.extend(rest.into_iter().map(|[from, to, apex]| Edge {
            from: name(from),
            to: name(to),
            apex: name(apex),
        }));
        Ok(())
    }

    /// Judges the triangles of a seam, whose edges wait for those of others.
    fn seam(&mut self, seam: &Done) -> Result<(), Error> {
        let path = place(self.folder, "seam", seam.node, "npy");
        let triangles = shards::triangles(&path)?;
        let corners = shards::corners(&path, &self.plan.cuts, &triangles, |node| self.points(node))?;
        self.judge(&path, &triangles, seam, |id| corners.get(&id).map(|&p| (id, p)))?;
        for t in &triangles {
            let [a, b, c] = t.map(|id| (id, corners[&id]));
            let edge = |from, to, apex| Edge { from, to, apex };
            self.waiting.extend([edge(a, b, c), edge(b, c, a), edge(c, a, b)]);
        }
        Ok(())
    }

    /// Whether triangles are counter-clockwise, and have the fingerprint that is known of them.
    fn judge(
        &mut self,
        path: &Path,
        triangles: &[[u64; 3]],
        done: &Done,
        corner: impl Fn(u64) -> Option<Corner> + Sync,
    ) -> Result<(), Error> {
        let judge = |(t, &corners): (usize, &[u64; 3])| {
            let [Some(a), Some(b), Some(c)] = corners.map(&corner) else {
                return Err(Error::changed(path, format!("triangle {t} has a corner that is no point")));
            };
            if orient2d(a.1, b.1, c.1) != Sign::Positive {
                return Err(Error::changed(path, format!("triangle {t} is not counter-clockwise")));
            }
            let mut one = Fingerprint::default();
            one.add([a.1, b.1, c.1]);
            Ok(one)
        };
        let add = |mut all: Fingerprint, one: Fingerprint| {
            all += one;
            Ok(all)
        };
        let each = triangles.par_iter().enumerate().map(judge);
        let fingerprint = each.try_reduce(Fingerprint::default, add)?;
        if fingerprint != done.fingerprint {
            return Err(Error::changed(path, "the triangles are not those that tiles.json knows"));
        }
        self.fingerprint += fingerprint;
        Ok(())
    }

    /// Pairs the edges between tiles; what is left is the border, which is convex and goes around once. Says how long it is.
    fn outline(&mut self) -> Result<u64, Error> {
        let border = pair(self.folder, std::mem::take(&mut self.waiting))?;
        let wrong = |what: &str| Err(Error::changed(self.folder, what));
        let mut next: BTreeMap<u64, Edge> = BTreeMap::new();
        for edge in &border {
            if next.insert(edge.from.0, *edge).is_some() {
                return wrong("the border meets itself, or there are holes");
            }
        }
        let Some(&first) = border.first() else { return Ok(0) };
        let (mut edge, mut length, mut lowest) = (first, 0, 0);
        loop {
            let Some(&following) = next.get(&edge.to.0) else {
                return wrong("the border is not closed, or there are holes");
            };
            let (p, q, r) = (edge.from.1, edge.to.1, following.to.1);
            if orient2d(p, q, r) == Sign::Negative {
                return wrong("the border is not convex, or there are holes");
            }
            lowest += usize::from(lexicographic(p, q).is_gt() && lexicographic(q, r).is_lt());
            length += 1;
            edge = following;
            if edge.from.0 == first.from.0 {
                break;
            }
            if length > border.len() {
                return wrong("the border does not come back");
            }
        }
        if length != border.len() || lowest != 1 {
            return wrong("the border does not go around once, or there are holes");
        }
        Ok(length as u64)
    }

    /// Whether all points are on a line, if there are no triangles.
    fn line(&self, tiles: &[Done]) -> Result<(), Error> {
        let mut ends: Vec<[f64; 2]> = Vec::new();
        for tile in tiles {
            for p in self.points(tile.node)? {
                match ends[..] {
                    [a, b] if orient2d(a, b, p) != Sign::Zero => {
                        return Err(Error::changed(
                            self.folder,
                            "there are no triangles, and points are not on a line",
                        ));
                    }
                    [_, _] => {}
                    _ => ends.push(p),
                }
            }
        }
        Ok(())
    }
}

/// The edges of the triangles of a tile that have no twin there, with the third corner; those that have are Delaunay.
fn pair_in_tile(path: &Path, points: &[[f64; 2]], triangles: &[[u64; 3]]) -> Result<Vec<[u32; 3]>, Error> {
    // Both ends, the lower first; the third corner; whether it runs from the upper end.
    let edge = |from: u64, to: u64, apex: u64| (from.min(to) << 32 | from.max(to), apex as u32, from > to);
    let of = |&[a, b, c]: &[u64; 3]| [edge(a, b, c), edge(b, c, a), edge(c, a, b)];
    let mut edges: Vec<(u64, u32, bool)> = triangles.iter().flat_map(of).collect();
    edges.par_sort_unstable();
    let mut rest = Vec::new();
    for group in edges.chunk_by(|e, f| e.0 == f.0) {
        let [low, high] = [(group[0].0 >> 32) as u32, group[0].0 as u32];
        let at = |v: u32| points[v as usize];
        match *group {
            [(_, apex, false)] => rest.push([low, high, apex]),
            [(_, apex, true)] => rest.push([high, low, apex]),
            [(_, left, one), (_, right, other)] if one != other => {
                let (left, right) = if one { (right, left) } else { (left, right) };
                judge_edge(path, [at(low), at(high)], at(left), at(right))?;
            }
            _ => return Err(overlap(path, at(low), at(high))),
        }
    }
    Ok(rest)
}

/// Whether the far corner across an edge is outside of the circle through its ends and the corner on its left.
fn judge_edge(path: &Path, [from, to]: [[f64; 2]; 2], left: [f64; 2], right: [f64; 2]) -> Result<(), Error> {
    if in_circle(from, to, left, right) == Sign::Positive {
        return Err(Error::changed(
            path,
            format!("the edge from {from:?} to {to:?} is not Delaunay, or not canonical"),
        ));
    }
    Ok(())
}

fn overlap(path: &Path, from: [f64; 2], to: [f64; 2]) -> Error {
    Error::changed(path, format!("triangles overlap at the edge from {from:?} to {to:?}"))
}

/// Edges that have no twin among others; those that have are Delaunay.
fn pair(path: &Path, mut edges: Vec<Edge>) -> Result<Vec<Edge>, Error> {
    edges.par_sort_unstable_by_key(Edge::key);
    let mut rest = Vec::new();
    for group in edges.chunk_by(|e, f| e.key() == f.key()) {
        match *group {
            [edge] => rest.push(edge),
            [e, f] if e.from.0 == f.to.0 => judge_edge(path, [e.from.1, e.to.1], e.apex.1, f.apex.1)?,
            _ => return Err(overlap(path, group[0].from.1, group[0].to.1)),
        }
    }
    Ok(rest)
}
