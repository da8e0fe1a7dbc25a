//! A polygon in parts: its rings are cut where they cross the meridian of 180 degrees, and closed along it (RFC 7946, section 3.1.9).
//!
//! All strips are laid upon one. Pieces of rings between two crossings are chains, whose ends are on its left or right border. Along a border
//! the inside begins and ends in turn from the south to the north: so each end is joined to the next one. A pole that is inside is one more
//! chain, along its parallel. O(n log n).

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::ops::Range;

use delone_io::Graph;
use delone_predicates::{Sign, lexicographic, orient2d};

use super::turns::{Corner, HALF_TURN_DEGREES, Made, POLE_DEGREES, Piece, Side, Walk, reduced};

/// A ring of a part: corners with their longitudes, and the segment that each edge from there is of, if it is of any.
pub(super) type Outline = Vec<(Corner, f64, Option<usize>)>;

/// A part of a polygon.
#[derive(Debug)]
pub(super) struct Part {
    /// The outer ring, then holes.
    pub(super) rings: Vec<Outline>,
}

/// The pole that a ring goes around.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pole {
    South,
    North,
}

/// A ring of a polygon, walked around.
pub(super) struct Walked {
    pub(super) pieces: Vec<Piece>,
    /// How often it goes around the world, to the east.
    pub(super) winding: i32,
}

impl Walked {
    pub(super) fn of(graph: &Graph, segments: &Range<usize>, made: &mut Vec<Made>) -> Self {
        let Some(&[start, _]) = graph.segments.get(segments.start).filter(|_| !segments.is_empty()) else {
            return Self { pieces: Vec::new(), winding: 0 };
        };
        let mut walk = Walk::from(graph, start);
        let winding = walk.around(segments.clone(), made);
        Self { pieces: walk.pieces, winding }
    }

    /// The strip that all of it is in; `None` if it is in several, or goes around the world.
    pub(super) fn only_strip(&self) -> Option<i32> {
        let mut strips = self.pieces.iter().filter_map(|piece| piece.strip);
        // All on the meridian: as its first corner says.
        let on_border = || self.pieces.first().map_or(0, |piece| piece.from.place - 1);
        let first = strips.next().unwrap_or_else(on_border);
        (self.winding == 0 && strips.all(|strip| strip == first)).then_some(first)
    }

    /// Whether it is wider than a turn.
    pub(super) fn is_wide(&self, graph: &Graph) -> bool {
        // Borders are the ends of the strips before them.
        let far = |piece: &Piece| match piece.from.corner {
            Corner::Given(_) if piece.from.place % 2 != 0 => {
                Some(((piece.from.place - 1) / 2, HALF_TURN_DEGREES))
            }
            Corner::Given(i) => Some((piece.from.place / 2, reduced(graph.cloud.xy[i][0]).1)),
            Corner::Made(_) => None,
        };
        let order = |p: &(i32, f64), q: &(i32, f64)| p.0.cmp(&q.0).then(p.1.total_cmp(&q.1));
        let all = || self.pieces.iter().filter_map(far);
        let ends = all().min_by(order).zip(all().max_by(order));
        self.winding == 0
            && ends.is_some_and(|((low, x), (high, y))| high - low > 1 || high - low == 1 && y > x)
    }

    /// The pole that is inside of it: on the left of a shell, on the right of a hole. Where directions do not count, that which it comes
    /// nearer to.
    pub(super) fn pole(&self, graph: &Graph, is_shell: bool, by_direction: bool) -> Pole {
        let latitude = |piece: &Piece| match piece.from.corner {
            Corner::Given(i) => Some(graph.cloud.xy[i][1]),
            Corner::Made(_) => None,
        };
        let [mut south, mut north] = [0.0_f64; 2];
        for y in self.pieces.iter().filter_map(latitude) {
            (south, north) = (south.max(-y), north.max(y));
        }
        match north.total_cmp(&south) {
            Ordering::Greater if !by_direction => Pole::North,
            Ordering::Less if !by_direction => Pole::South,
            _ if (self.winding > 0) == is_shell => Pole::North,
            _ => Pole::South,
        }
    }
}

/// Pieces of a ring from border to border, or the whole of it.
struct Chain {
    corners: Vec<(Corner, f64)>,
    /// The segment of each edge between them.
    segments: Vec<Option<usize>>,
    sides: [Side; 2],
}

/// An end of a chain: the first, or the last.
type End = (usize, usize);

/// The rings of one polygon while they are cut.
pub(super) struct Cutting<'a> {
    graph: &'a Graph,
    made: &'a mut Vec<Made>,
    chains: Vec<Chain>,
    /// Rings that stay whole, and whether they are shells.
    whole: Vec<(Outline, bool)>,
    /// Corners of rings on the left and on the right border.
    along: [Vec<Corner>; 2],
}

impl<'a> Cutting<'a> {
    pub(super) fn new(graph: &'a Graph, made: &'a mut Vec<Made>) -> Self {
        Self { graph, made, chains: Vec::new(), whole: Vec::new(), along: Default::default() }
    }

    /// Takes the next ring.
    pub(super) fn take(&mut self, ring: &Walked, is_shell: bool) {
        let pieces = &ring.pieces;
        let Some(last) = pieces.last() else { return };
        let before = |i: usize| match i {
            0 => last.strip.map(|strip| strip - 2 * ring.winding),
            _ => pieces[i - 1].strip,
        };
        for Piece { from, to, strip, .. } in pieces {
            let side = strip.map(|strip| from.side(strip));
            for (along, border) in self.along.iter_mut().zip([Side::Left, Side::Right]) {
                match side {
                    Some(side) => along.extend((side == border).then_some(from.corner)),
                    None => along.extend([from.corner, to.corner]),
                }
            }
        }
        let breaks: Vec<usize> = (0..pieces.len()).filter(|&i| before(i) != pieces[i].strip).collect();
        let Some((&first, &final_)) = breaks.first().zip(breaks.last()) else {
            if let Some(strip) = last.strip {
                self.whole.push((in_strip(self.graph, pieces, strip), is_shell));
            }
            return;
        };
        let around = [&pieces[final_..], &pieces[..first]].concat();
        // First the chain with the first corner of the ring.
        if first > 0 {
            self.add(&around);
        }
        breaks.windows(2).for_each(|pair| self.add(&pieces[pair[0]..pair[1]]));
        if first == 0 {
            self.add(&around);
        }
    }

    /// Adds a chain of pieces in one strip, or of none.
    fn add(&mut self, pieces: &[Piece]) {
        let Some((first, last)) = pieces.first().zip(pieces.last()) else { return };
        // Around the start of a ring that goes around the world strips are counted anew.
        let (Some(from), Some(to)) = (first.strip, last.strip) else { return };
        let mut corners: Vec<(Corner, f64)> = pieces
            .iter()
            .filter_map(|piece| {
                Some((piece.from.corner, self.longitude(piece.from.corner, piece.from.side(piece.strip?))))
            })
            .collect();
        corners.push((last.to.corner, self.longitude(last.to.corner, last.to.side(to))));
        let segments = pieces.iter().map(|piece| Some(piece.segment)).collect();
        self.chains.push(Chain { corners, segments, sides: [first.from.side(from), last.to.side(to)] });
    }

    fn longitude(&self, corner: Corner, side: Side) -> f64 {
        longitude(self.graph, corner, side)
    }

    fn latitude(&self, corner: Corner) -> f64 {
        match corner {
            Corner::Given(i) => self.graph.cloud.xy[i][1],
            Corner::Made(i) => self.made[i].latitude,
        }
    }

    fn xy(&self, &(corner, x): &(Corner, f64)) -> [f64; 2] {
        [x, self.latitude(corner)]
    }

    /// The corner at an end of a chain, and its neighbor.
    fn end(&self, (chain, end): End) -> [[f64; 2]; 2] {
        let corners = &self.chains[chain].corners;
        let n = corners.len();
        let places = if end == 0 { [0, 1] } else { [n - 1, n - 2] };
        places.map(|i| self.xy(&corners[i]))
    }

    /// The parts, where these poles are inside.
    pub(super) fn parts(mut self, poles: [bool; 2]) -> Vec<Part> {
        let count = self.chains.len();
        let mut ends: [Vec<End>; 2] = [Side::Left, Side::Right].map(|side| {
            let all = (0..count).flat_map(|chain| [(chain, 0), (chain, 1)]);
            let mut ends: Vec<End> =
                all.filter(|&(chain, end)| self.chains[chain].sides[end] == side).collect();
            ends.sort_by(|&p, &q| self.compare(side, p, q));
            ends
        });
        for (is_inside, latitude) in poles.into_iter().zip([-POLE_DEGREES, POLE_DEGREES]) {
            if is_inside {
                self.add_pole(latitude, &mut ends);
            }
        }
        let mut others = vec![[None; 2]; self.chains.len()];
        for pair in ends.iter().flat_map(|ends| ends.chunks_exact(2)) {
            let (p, q) = (pair[0], pair[1]);
            (others[p.0][p.1], others[q.0][q.1]) = (Some(q), Some(p));
        }
        let along = std::mem::take(&mut self.along).map(|corners| {
            let mut along: Vec<(f64, Corner)> =
                corners.into_iter().map(|corner| (self.latitude(corner), corner)).collect();
            along.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
            along.dedup_by_key(|corner| corner.0);
            along
        });
        let mut is_done = vec![false; self.chains.len()];
        let (mut parts, mut holes) = (Vec::new(), Vec::new());
        for chain in 0..is_done.len() {
            if !is_done[chain] {
                let outline = self.outline(chain, &others, &along, &mut is_done);
                if self.has_area(&outline) {
                    self.part(outline, &mut parts, &mut holes);
                }
            }
        }
        for (ring, is_shell) in std::mem::take(&mut self.whole) {
            if is_shell {
                parts.push(Part { rings: vec![ring] });
            } else {
                holes.push(ring);
            }
        }
        for hole in holes {
            let at = if parts.len() < 2 {
                Some(0)
            } else {
                parts.iter().position(|part| self.is_inside(&part.rings[0], &hole))
            };
            match parts.get_mut(at.unwrap_or(0)) {
                Some(part) => part.rings.push(hole),
                None => parts.push(Part { rings: vec![hole] }),
            }
        }
        parts
    }

    /// The order of two ends on one border: by latitude, and at one place by the edges from there.
    fn compare(&self, side: Side, p: End, q: End) -> Ordering {
        let ([at, first], [other, second]) = (self.end(p), self.end(q));
        at[1].total_cmp(&other[1]).then_with(|| match (orient2d(at, first, second), side) {
            (Sign::Zero, _) => p.cmp(&q),
            (Sign::Positive, Side::Left) | (Sign::Negative, Side::Right) => Ordering::Less,
            _ => Ordering::Greater,
        })
    }

    /// Adds a chain along a pole, from border to border. Its corners have the heights of what they are joined to.
    fn add_pole(&mut self, latitude: f64, ends: &mut [Vec<End>; 2]) {
        let is_south = latitude < 0.0;
        let mut corners = Vec::new();
        for (side, (ends, x)) in ends.iter_mut().zip([-HALF_TURN_DEGREES, HALF_TURN_DEGREES]).enumerate() {
            let Some(&(chain, end)) = (if is_south { ends.first() } else { ends.last() }) else { return };
            let corners_there = &self.chains[chain].corners;
            let beside = if end == 0 { corners_there[0].0 } else { corners_there[corners_there.len() - 1].0 };
            let like = match beside {
                Corner::Given(i) => Made::copy(self.graph, i),
                Corner::Made(i) => self.made[i].clone(),
            };
            self.made.push(Made { latitude, ..like });
            corners.push((Corner::Made(self.made.len() - 1), x));
            let pole = (self.chains.len(), side);
            ends.insert(if is_south { 0 } else { ends.len() }, pole);
        }
        self.chains.push(Chain { corners, segments: vec![None], sides: [Side::Left, Side::Right] });
    }

    /// The ring of a chain and those that it is joined to.
    fn outline(
        &self,
        first: usize,
        others: &[[Option<End>; 2]],
        along: &[Vec<(f64, Corner)>; 2],
        is_done: &mut [bool],
    ) -> Outline {
        let mut outline = Outline::new();
        let mut next = (first, 0);
        while !std::mem::replace(&mut is_done[next.0], true) {
            let (chain, start) = next;
            let Chain { corners, segments, .. } = &self.chains[chain];
            let n = corners.len();
            let order = |k: usize| if start == 0 { k } else { n - 1 - k };
            for k in 0..n {
                let (corner, x) = corners[order(k)];
                let edge = if start == 0 { k } else { n.wrapping_sub(2 + k) };
                let segment = segments.get(edge).copied().flatten();
                self.join(&mut outline, (corner, x, segment));
            }
            let Some(other) = others[chain][1 - start] else { break };
            let (from, to) = (self.end((chain, 1 - start))[0], self.end(other)[0]);
            let [low, high] = [from[1].min(to[1]), from[1].max(to[1])];
            let along = &along[usize::from(from[0] > 0.0)];
            let begin = along.partition_point(|corner| corner.0 <= low);
            let end = along.partition_point(|corner| corner.0 < high).max(begin);
            let between = along[begin..end].iter().map(|&(_, corner)| (corner, from[0], None));
            if from[1] < to[1] {
                between.for_each(|corner| self.join(&mut outline, corner));
            } else {
                between.rev().for_each(|corner| self.join(&mut outline, corner));
            }
            next = other;
        }
        let at = |&(corner, x, _): &(Corner, f64, Option<usize>)| self.xy(&(corner, x));
        if outline.len() > 1 && outline.first().map(at) == outline.last().map(at) {
            outline.pop();
        }
        outline
    }

    /// Appends a corner, unless the last one is at its place and nothing but the meridian is between them.
    fn join(&self, outline: &mut Outline, next: (Corner, f64, Option<usize>)) {
        match outline.last_mut() {
            Some(last) if last.2.is_none() && self.xy(&(last.0, last.1)) == self.xy(&(next.0, next.1)) => {
                last.2 = next.2;
            }
            _ => outline.push(next),
        }
    }

    /// Makes parts of a ring, which may touch itself where a hole touched its shell. Loops that turn the other way are holes.
    fn part(&self, outline: Outline, parts: &mut Vec<Part>, holes: &mut Vec<Outline>) {
        let first =
            outline.iter().map(|&(corner, x, _)| self.xy(&(corner, x))).min_by(|p, q| lexicographic(*p, *q));
        let loops: Vec<(Sign, [f64; 2], Outline)> = self
            .loops(outline)
            .into_iter()
            .map(|ring| {
                let (turn, least) = self.turn(&ring);
                (turn, least, ring)
            })
            .collect();
        let outer = loops.iter().find(|ring| Some(ring.1) == first).map(|ring| ring.0);
        for (turn, _, ring) in loops {
            if Some(turn) == outer {
                parts.push(Part { rings: vec![ring] });
            } else {
                holes.push(ring);
            }
        }
    }

    /// The loops of a ring between visits of one place, of three or more corners. O(n log n).
    fn loops(&self, outline: Outline) -> Vec<Outline> {
        let mut loops = Vec::new();
        let mut open = Outline::new();
        let mut visits: BTreeMap<[u64; 2], usize> = BTreeMap::new();
        let key = |&(corner, x, _): &(Corner, f64, Option<usize>)| {
            [x, self.latitude(corner)].map(|x| (x + 0.0).to_bits())
        };
        for corner in outline {
            if let Some(&at) = visits.get(&key(&corner)).filter(|&&at| at + 2 < open.len()) {
                let closed = open.split_off(at);
                closed.iter().for_each(|corner| _ = visits.remove(&key(corner)));
                loops.push(closed);
            }
            visits.insert(key(&corner), open.len());
            open.push(corner);
        }
        loops.push(open);
        loops
    }

    /// How a ring turns at its first place, from the west and then from the south, and that place.
    fn turn(&self, ring: &Outline) -> (Sign, [f64; 2]) {
        let (n, at) = (ring.len(), |i: usize| self.xy(&(ring[i].0, ring[i].1)));
        let least = (0..n).min_by(|&i, &j| lexicographic(at(i), at(j))).unwrap_or_default();
        (orient2d(at((least + n - 1) % n), at(least), at((least + 1) % n)), at(least))
    }

    /// Whether a ring is more than a line along a parallel.
    fn has_area(&self, outline: &Outline) -> bool {
        let latitude = |corner: &(Corner, f64, Option<usize>)| self.latitude(corner.0);
        let first = outline.first().map(latitude);
        outline.len() > 2 && outline.iter().any(|corner| Some(latitude(corner)) != first)
    }

    /// Whether a ring is inside of another one: by the first of its corners that is not on that. Edges that cross the parallel to the east are
    /// counted.
    fn is_inside(&self, outline: &Outline, ring: &Outline) -> bool {
        let places = |ring: &Outline| -> Vec<[f64; 2]> {
            ring.iter().map(|&(corner, x, _)| self.xy(&(corner, x))).collect()
        };
        let around = places(outline);
        let is_inside = |p: [f64; 2]| {
            let mut is_inside = false;
            for (i, &b) in around.iter().enumerate() {
                let a = around[i.checked_sub(1).unwrap_or(around.len() - 1)];
                let (low, high) = if a[1] <= b[1] { (a, b) } else { (b, a) };
                if p[1] < low[1] || p[1] > high[1] {
                    continue;
                }
                let side = orient2d(low, high, p);
                if side == Sign::Zero && (a[0].min(b[0])..=a[0].max(b[0])).contains(&p[0]) {
                    return None;
                }
                is_inside ^= side == Sign::Positive && p[1] < high[1];
            }
            Some(is_inside)
        };
        places(ring).into_iter().find_map(is_inside).unwrap_or(false)
    }
}

/// The longitude of a corner on a border of a strip or inside.
pub(super) fn longitude(graph: &Graph, corner: Corner, side: Side) -> f64 {
    match (side, corner) {
        (Side::Left, _) => -HALF_TURN_DEGREES,
        (Side::Inside, Corner::Given(i)) => reduced(graph.cloud.xy[i][0]).1,
        // Others are made on a border.
        (Side::Right | Side::Inside, _) => HALF_TURN_DEGREES,
    }
}

/// A whole ring, as it is in a strip.
pub(super) fn in_strip(graph: &Graph, pieces: &[Piece], strip: i32) -> Outline {
    let corner = |piece: &Piece| {
        let Piece { from, segment, .. } = *piece;
        (from.corner, longitude(graph, from.corner, from.side(strip)), Some(segment))
    };
    pieces.iter().map(corner).collect()
}
