//! The segments of a constrained triangulation, and which constraint edges they cover.
//!
//! A segment is known by its two ends. Its chain of edges is found in the triangulation, by following it through the vertices
//! exactly on it; only where it was split at rounded crossings does it bend, and the bends are kept. Which segments cover an
//! edge is asked when constraints are removed, and by users: that table is made at the first need and kept up from then on.
//!
//! Cost: 12 bytes a segment; the table some 100 bytes a constraint edge.

use std::collections::BTreeMap;

use crate::ids::VertexId;

/// A segment of the input, by its index, or one inserted later.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(transparent))]
pub struct SegmentId(pub(super) u32);

impl SegmentId {
    /// The segment with this index.
    pub fn new(index: usize) -> Self {
        Self(u32::try_from(index).unwrap_or(u32::MAX))
    }

    /// Its index: that in the input, then counting up.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A segment that covers a constraint edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub struct Covering2 {
    /// The segment.
    pub segment: SegmentId,
    /// Whether it runs in the direction of the edge.
    pub is_forward: bool,
}

/// All segments.
#[derive(Clone, Debug, Default)]
pub(super) struct Segments {
    /// The vertices at both ends; the ghost for a segment that was removed, or has no length.
    ends: Vec<[VertexId; 2]>,
    /// The vertices along those that bend, ends included.
    bent: BTreeMap<SegmentId, Vec<VertexId>>,
}

impl Segments {
    /// A table without the segments of no length.
    pub(super) fn new(mut ends: Vec<[VertexId; 2]>, bent: BTreeMap<SegmentId, Vec<VertexId>>) -> Self {
        ends.iter_mut().filter(|ends| ends[0] == ends[1]).for_each(|ends| *ends = [VertexId::GHOST; 2]);
        Self { ends, bent }
    }

    /// Both ends, if the segment is there.
    pub(super) fn ends(&self, s: SegmentId) -> Option<[VertexId; 2]> {
        self.ends.get(s.index()).copied().filter(|ends| !ends[0].is_ghost())
    }

    /// The segments, with their ends.
    pub(super) fn iter(&self) -> impl Iterator<Item = (SegmentId, [VertexId; 2])> + '_ {
        let all = self.ends.iter().enumerate();
        all.map(|(i, &ends)| (SegmentId::new(i), ends)).filter(|(_, ends)| !ends[0].is_ghost())
    }

    /// The straight pieces of a segment, each between two vertices.
    pub(super) fn pieces(&self, s: SegmentId) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        let bent = self.bent.get(&s);
        let straight = if bent.is_none() { self.ends(s) } else { None };
        let links = bent.into_iter().flat_map(|chain| chain.windows(2).map(|w| [w[0], w[1]]));
        straight.into_iter().chain(links)
    }

    /// Whether a vertex is where a segment ends or bends.
    pub(super) fn turns_at(&self, s: SegmentId, v: VertexId) -> bool {
        self.ends(s).is_some_and(|ends| ends.contains(&v))
            || self.bent.get(&s).is_some_and(|chain| chain.contains(&v))
    }

    /// A segment that is there runs along these vertices from now on, ends included.
    pub(super) fn bend(&mut self, s: SegmentId, chain: Vec<VertexId>) {
        self.bent.insert(s, chain);
    }

    pub(super) fn is_bent(&self, s: SegmentId) -> bool {
        self.bent.contains_key(&s)
    }

    /// The id of the next segment to be inserted.
    pub(super) fn next(&self) -> SegmentId {
        SegmentId::new(self.ends.len())
    }

    pub(super) fn remove(&mut self, s: SegmentId) {
        self.ends[s.index()] = [VertexId::GHOST; 2];
        self.bent.remove(&s);
    }

    /// A segment is there: the next one, or one that was removed.
    pub(super) fn set(&mut self, s: SegmentId, ends: [VertexId; 2]) {
        if s.index() == self.ends.len() {
            self.ends.push(ends);
        } else {
            self.ends[s.index()] = ends;
        }
    }
}

/// An edge by its ends, the lesser one first.
pub(super) type Ends = [VertexId; 2];

/// For each constraint edge the segments that cover it, in the direction from its lesser end.
#[derive(Clone, Debug, Default)]
pub(super) struct Cover(BTreeMap<Ends, Vec<Covering2>>);

fn sorted([v, w]: Ends) -> (Ends, bool) {
    if v < w { ([v, w], true) } else { ([w, v], false) }
}

impl Cover {
    /// A segment covers an edge, in this direction.
    pub(super) fn add(&mut self, segment: SegmentId, edge: Ends) {
        let (ends, is_forward) = sorted(edge);
        let list = self.0.entry(ends).or_default();
        let at = list.partition_point(|c| c.segment <= segment);
        list.insert(at, Covering2 { segment, is_forward });
    }

    /// It does not any more. Returns whether none does.
    pub(super) fn take(&mut self, segment: SegmentId, edge: Ends) -> bool {
        let (ends, _) = sorted(edge);
        let Some(list) = self.0.get_mut(&ends) else { return true };
        list.retain(|c| c.segment != segment);
        if list.is_empty() {
            self.0.remove(&ends);
            return true;
        }
        false
    }

    /// The segments that cover an edge, by id, as seen in its direction.
    pub(super) fn of(&self, edge: Ends) -> Vec<Covering2> {
        let (ends, same) = sorted(edge);
        let turned = |c: &Covering2| Covering2 { is_forward: c.is_forward == same, ..*c };
        self.0.get(&ends).into_iter().flatten().map(turned).collect()
    }

    /// An edge becomes a chain of several, in its direction.
    pub(super) fn replace(&mut self, edges: &[Ends], by: &[Ends]) {
        let covering = self.of(edges[0]);
        for &edge in edges {
            self.0.remove(&sorted(edge).0);
        }
        for &edge in by {
            for c in &covering {
                self.add(c.segment, if c.is_forward { edge } else { [edge[1], edge[0]] });
            }
        }
    }
}
