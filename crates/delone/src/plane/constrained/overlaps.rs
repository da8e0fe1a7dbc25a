//! Segments on one line that share a part of their length: found, counted, and laid without walking along what is there.
//!
//! The edges of segments that overlap make a run, from the first of their ends to the last. Whoever comes to an edge of a run goes
//! on at the run's end, so that n nested segments are laid in O(n) steps, not in O(n^2). Which of them repeat or overlap others
//! their intervals tell.
//!
//! Cost: O(log n) amortized for each edge of a segment with vertices inside of it that is not skipped; O(k log k) to count k
//! segments. A segment that is one edge costs nothing, unless that edge is shared.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use delone_predicates::{lexicographic, strictly_between};

use super::ConstraintReport2;
use super::trace::{Beginning, Ground, Leaves};
use crate::ids::{EdgeId, Place};
use crate::sorting;

/// A constraint edge, the segments along it less those against it, and the number of both.
pub(super) type Weight = (EdgeId, i32, usize);

/// An edge by its ends, the lesser one first.
type Ends = [Place; 2];

pub(super) fn sorted([v, w]: [Place; 2]) -> Ends {
    [v.min(w), v.max(w)]
}

/// Segments that share edges, while they are inserted.
#[derive(Default)]
pub(super) struct Overlaps {
    /// Edges that were met more than once.
    shared: Vec<Ends>,
    /// Segments with vertices inside of them, and a run that each is in.
    through: Vec<(u32, u32)>,
    /// A run that each edge of these is in.
    of: BTreeMap<Ends, u32>,
    runs: Vec<Run>,
}

/// Edges on a line, one after another.
#[derive(Clone, Copy)]
struct Run {
    /// The run that it is a part of; itself if it is whole.
    of: u32,
    /// The lexicographically first and last vertex, if it is whole.
    ends: [Place; 2],
}

impl Overlaps {
    /// An edge was met that is a constraint already.
    pub(super) fn share(&mut self, edge: [Place; 2]) {
        self.shared.push(sorted(edge));
    }

    /// How far a segment on its way from `near` to `far` may go on along constraints, if the edge that it is on is one of a run.
    pub(super) fn skip(
        &mut self,
        points: &[[f64; 2]],
        edge: [Place; 2],
        [near, far]: [Place; 2],
    ) -> Option<Place> {
        let run = *self.of.get(&sorted(edge))?;
        let [from, to] = [near, far].map(|v| points[v.index()]);
        let end = self.whole(run).ends[usize::from(lexicographic(from, to).is_lt())];
        Some(if strictly_between(from, to, points[end.index()]) { end } else { far })
    }

    /// Remembers a segment with vertices inside of it, and the edges that it met.
    pub(super) fn add(
        &mut self,
        points: &[[f64; 2]],
        s: u32,
        ends: [Place; 2],
        edges: impl Iterator<Item = [Place; 2]>,
    ) {
        let new = self.runs.len() as u32;
        self.runs.push(Run { of: new, ends });
        let mut whole = new;
        sorting::by(&mut self.runs[new as usize].ends, |&v, &w| along(points, v, w));
        for edge in edges {
            if let Some(old) = self.of.insert(sorted(edge), new) {
                whole = self.join(points, whole, old);
            }
        }
        self.through.push((s, new));
    }

    /// The number of segments with vertices inside of them.
    pub(super) fn through_vertices(&self) -> usize {
        self.through.len()
    }

    /// The run that a part is in. Ways are halved as they are gone.
    fn find(&mut self, mut run: u32) -> u32 {
        while self.runs[run as usize].of != run {
            let next = self.runs[self.runs[run as usize].of as usize].of;
            self.runs[run as usize].of = next;
            run = next;
        }
        run
    }

    fn whole(&mut self, run: u32) -> Run {
        let run = self.find(run);
        self.runs[run as usize]
    }

    /// Two runs that share an edge become one.
    fn join(&mut self, points: &[[f64; 2]], a: u32, b: u32) -> u32 {
        let [a, b] = [a, b].map(|run| self.find(run));
        let [of_a, of_b] = [a, b].map(|run| self.runs[run as usize].ends);
        let first = if along(points, of_b[0], of_a[0]).is_lt() { of_b[0] } else { of_a[0] };
        let last = if along(points, of_b[1], of_a[1]).is_gt() { of_b[1] } else { of_a[1] };
        self.runs[a as usize].of = b;
        self.runs[b as usize].ends = [first, last];
        b
    }

    /// Counts segments that repeat others, and that overlap others.
    pub(super) fn count(
        mut self,
        points: &[[f64; 2]],
        segments: &[[Place; 2]],
        report: &mut ConstraintReport2,
    ) {
        if self.shared.is_empty() {
            return;
        }
        self.shared.sort_unstable();
        // Of segments on one line in one group: by the run, or by the edge that repeats.
        let mut groups: Vec<(Result<u32, Ends>, [Place; 2])> = Vec::new();
        for (s, run) in std::mem::take(&mut self.through) {
            groups.push((Ok(self.find(run)), segments[s as usize]));
        }
        for ends in segments.iter().copied().map(sorted).filter(|ends| ends[0] != ends[1]) {
            if self.shared.binary_search(&ends).is_ok() {
                let run = self.of.get(&ends).copied();
                groups.push((run.map_or(Err(ends), |run| Ok(self.find(run))), ends));
            }
        }
        groups.iter_mut().for_each(|(_, ends)| sorting::by(ends, |&v, &w| along(points, v, w)));
        sorting::by(&mut groups, |(a, [v, w]), (b, [x, y])| {
            a.cmp(b).then_with(|| along(points, *v, *x)).then_with(|| along(points, *w, *y))
        });
        for group in groups.chunk_by(|a, b| a.0 == b.0) {
            let distinct: Vec<&[(_, [Place; 2])]> = group.chunk_by(|a, b| a.1 == b.1).collect();
            report.repeated += group.len() - distinct.len();
            let mut reached: Option<Place> = None;
            for (i, same) in distinct.iter().enumerate() {
                let [first, last] = same[0].1;
                let before = reached.is_some_and(|end| along(points, end, first).is_gt());
                let after = distinct.get(i + 1).is_some_and(|next| along(points, next[0].1[0], last).is_lt());
                report.overlapping += if before || after { same.len() } else { 0 };
                reached = reached.filter(|&end| along(points, end, last).is_gt()).or(Some(last));
            }
        }
    }
}

/// The weights of all edges that straight segments cover, each edge in one of its directions, sorted.
///
/// # Errors
/// The first segment that is no chain of constraints, by its number.
pub(super) fn weights(
    ground: Ground,
    segments: impl Iterator<Item = [Place; 2]>,
) -> Result<Vec<Weight>, usize> {
    let mut overlaps = Overlaps::default();
    let mut through: Vec<[Place; 2]> = Vec::new();
    let mut weights: Vec<Weight> = Vec::new();
    // The same segment once more needs no look at its ends, which may be hubs.
    let mut last = ([Place::GHOST; 2], None);
    for (number, ends) in segments.enumerate() {
        if last.0 == [ends[1], ends[0]] {
            last = (ends, last.1.map(|e| ground.mesh.twin(e)));
        } else if last.0 != ends {
            last = (ends, ground.mesh.edge_between(ends[0], ends[1]));
        }
        match last.1 {
            Some(e) if ground.mesh.is_fixed(e) => weights.push((e, 1, 1)),
            Some(_) => return Err(number),
            None => {
                let edges = overlaps.follow(ground, ends).ok_or(number)?;
                overlaps.add(ground.points, through.len() as u32, ends, edges.into_iter());
                through.push(ends);
            }
        }
    }
    let mut of_runs: Vec<(u32, [Place; 2])> = Vec::new();
    for (s, run) in std::mem::take(&mut overlaps.through) {
        of_runs.push((overlaps.find(run), through[s as usize]));
    }
    of_runs.sort_unstable();
    for of_run in of_runs.chunk_by(|a, b| a.0 == b.0) {
        let chain = ground.chain(overlaps.runs[of_run[0].0 as usize].ends);
        let position =
            |v: Place| chain.partition_point(|&e| along(ground.points, ground.mesh.tail(e), v).is_lt());
        // What begins at each vertex less what ends there.
        let mut change = vec![(0, 0); chain.len() + 1];
        for [first, last] in of_run.iter().map(|(_, ends)| ends.map(position)) {
            let (from, to, direction) = if first < last { (first, last, 1) } else { (last, first, -1) };
            change[from] = (change[from].0 + direction, change[from].1 + 1);
            change[to] = (change[to].0 - direction, change[to].1 - 1);
        }
        let mut sum = (0, 0_isize);
        for (&e, (direction, count)) in chain.iter().zip(change) {
            sum = (sum.0 + direction, sum.1 + count);
            weights.push((e, sum.0, sum.1.unsigned_abs()));
        }
    }
    for weight in &mut weights {
        let twin = ground.mesh.twin(weight.0);
        *weight = if weight.0 < twin { *weight } else { (twin, -weight.1, weight.2) };
    }
    sorting::by_key(&mut weights, |weight| weight.0);
    weights.dedup_by(|later, first| {
        let same = later.0 == first.0;
        if same {
            *first = (first.0, first.1.saturating_add(later.1), first.2 + later.2);
        }
        same
    });
    Ok(weights)
}

impl Overlaps {
    /// The constraints along a segment, but for those inside of runs; `None` if it is not covered by constraints.
    fn follow(&mut self, ground: Ground, [mut a, mut b]: [Place; 2]) -> Option<Vec<[Place; 2]>> {
        let mut met = Vec::new();
        while a != b {
            let Beginning { leaves: Leaves::Along(e), at_second } = ground.begin(a, b) else { return None };
            if !ground.mesh.is_fixed(e) {
                return None;
            }
            let edge = [ground.mesh.tail(e), ground.mesh.head(e)];
            met.push(edge);
            let (near, far) = if at_second { (&mut b, a) } else { (&mut a, b) };
            *near = self.skip(ground.points, edge, [*near, far]).unwrap_or(edge[1]);
        }
        Some(met)
    }
}

/// The order of vertices on a line.
fn along(points: &[[f64; 2]], v: Place, w: Place) -> Ordering {
    lexicographic(points[v.index()], points[w.index()])
}
