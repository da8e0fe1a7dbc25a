//! Small hostile graphs: built in bulk and one by one, in any order and direction, they are what the definition says, and
//! segments that cross are refused, or split as the definition says.

use delone::{Constrained2, Crossings, Error, SegmentId, VertexId};
use delone_generators::Random;
use delone_oracle::certificate::certify;
use delone_oracle::constrained;
use delone_oracle::crossings::{Split, crossing_pairs};

use crate::attack::{Attack, Judgement};
use crate::engine::{THREADS, pools};
use crate::nasty::{self, once_in};

type Point = [f64; 2];

/// Rounds beyond which the definition takes seconds. Near zero crossings can go from one power of two to the next: a thousand
/// rounds.
const MANY_ROUNDS: usize = 12;

/// See the module.
pub(crate) struct Graphs;

/// An item of a graph. Segments bring points of their own, so that any part of the list is a graph.
#[derive(Clone, Debug)]
pub(crate) enum Item {
    Point(Point),
    Segment([Point; 2]),
}

/// Points, of which many are equal, and segments between them.
pub(crate) fn parts(items: &[Item]) -> (Vec<Point>, Vec<[usize; 2]>) {
    let (mut points, mut segments) = (Vec::new(), Vec::new());
    for item in items {
        match item {
            Item::Point(p) => points.push(*p),
            Item::Segment(ends) => {
                segments.push([points.len(), points.len() + 1]);
                points.extend(ends);
            }
        }
    }
    (points, segments)
}

/// Triangles as coordinates, in a form that can be compared.
pub(crate) fn triangles(c: &Constrained2) -> Vec<[Point; 3]> {
    delone_oracle::brute::normalized(c.triangles().map(|t| t.map(|v| c.point(v))))
}

/// Constraints as coordinates, the lesser end first, sorted.
pub(crate) fn constraints(c: &Constrained2) -> Vec<[Point; 2]> {
    let order = |p: &Point, q: &Point| p.partial_cmp(q).expect("finite");
    let ends = |edge: [VertexId; 2]| {
        let mut ends = edge.map(|v| c.point(v).map(|x| x + 0.0));
        ends.sort_by(order);
        ends
    };
    let mut all: Vec<[Point; 2]> = c.constraints().map(ends).collect();
    all.sort_by(|p, q| p.partial_cmp(q).expect("finite"));
    all
}

/// Whether a triangulation is the one of its points and of these segments.
pub(crate) fn judge(c: &Constrained2, points: &[Point], segments: &[[usize; 2]]) -> Judgement {
    c.check().map_err(|flaw| format!("check: {flaw:?}"))?;
    let expected = constrained::constraints(points, segments);
    if constraints(c) != expected {
        return Err(format!("the constraints are {:?} instead of {expected:?}", constraints(c)));
    }
    let expected = constrained::triangulation(points, segments);
    if triangles(c) != expected {
        return Err(format!("the triangles are {:?} instead of {expected:?}", triangles(c)));
    }
    Ok(())
}

/// Crossings are refused by name, and split as the definition says.
fn judge_crossings(points: &[Point], segments: &[[usize; 2]], pairs: &[[usize; 2]]) -> Judgement {
    match Constrained2::from_parts(points, segments) {
        Err(Error::SegmentsCross { first, second, count, .. }) => {
            if !pairs.contains(&[first.min(second), first.max(second)]) || count != pairs.len() {
                return Err(format!("{count} crossings, of {first} and {second}, instead of {pairs:?}"));
            }
        }
        other => return Err(format!("crossings {pairs:?}: {:?}", other.map(|_| "accepted"))),
    }
    let c = Constrained2::with_crossings(points, segments, Crossings::Split)
        .map_err(|error| format!("split: {error}"))?;
    c.check().map_err(|flaw| format!("split: check: {flaw:?}"))?;
    let rows: Vec<[usize; 3]> = c.triangles().map(|t| t.map(|v| v.index())).collect();
    let mut edges: Vec<[usize; 2]> = c.constraints().map(|edge| edge.map(|v| v.index())).collect();
    edges.sort_unstable();
    certify(c.points(), &edges, &rows).map_err(|flaw| format!("split: {flaw:?}"))?;
    if c.report().rounds > MANY_ROUNDS {
        return Ok(());
    }
    let split = Split::new(points, segments);
    if c.points() != split.points {
        let added = |all: &[Point]| all[points.len()..].to_vec();
        return Err(format!("split: points {:?} instead of {:?}", added(c.points()), added(&split.points)));
    }
    let counts = (c.report().rounds, c.report().crossings, c.report().added_points);
    let expected = (split.rounds, split.crossings, split.points.len() - points.len());
    if counts != expected {
        return Err(format!("split: rounds, crossings, points {counts:?} instead of {expected:?}"));
    }
    for (i, chain) in split.chains.iter().enumerate().filter(|(_, chain)| chain.len() > 1) {
        let found = c.chain(SegmentId::new(i)).unwrap_or_default();
        if !found.iter().map(|v| v.index()).eq(chain.iter().copied()) {
            return Err(format!("split: chain {i} is {found:?} instead of {chain:?}"));
        }
    }
    if edges != split.edges() {
        return Err(format!("split: edges {edges:?} instead of {:?}", split.edges()));
    }
    Ok(())
}

/// Shuffles a graph: segments in another order and direction, some of them twice; points in another order.
fn shuffled(points: &[Point], segments: &[[usize; 2]], random: &mut Random) -> (Vec<Point>, Vec<[usize; 2]>) {
    let mut order: Vec<usize> = (0..points.len()).collect();
    random.shuffle(&mut order);
    let mut place = vec![0; order.len()];
    order.iter().enumerate().for_each(|(at, &i)| place[i] = at);
    let mut other: Vec<[usize; 2]> = Vec::new();
    for &[a, b] in segments {
        let ends = if once_in(random, 2) { [place[a], place[b]] } else { [place[b], place[a]] };
        other.push(ends);
        if once_in(random, 4) {
            other.push(ends);
        }
    }
    random.shuffle(&mut other);
    (order.iter().map(|&i| points[i]).collect(), other)
}

/// Points and segments come one by one, in any order. Where a vertex parts two segments that would cross, it has to come first:
/// refused, a segment changes nothing, and comes again after all points.
fn one_by_one(points: &[Point], segments: &[[usize; 2]], random: &mut Random) -> Result<Constrained2, Error> {
    let mut c = Constrained2::new();
    let mut ids: Vec<Option<VertexId>> = vec![None; points.len()];
    let mut order: Vec<usize> = (0..points.len() + segments.len()).collect();
    random.shuffle(&mut order);
    for at in order {
        let mut vertex = |c: &mut Constrained2, i: usize| match ids[i] {
            Some(v) => Ok(v),
            None => c.insert(points[i]).map(|inserted| *ids[i].insert(inserted.vertex())),
        };
        match at.checked_sub(points.len()) {
            None => _ = vertex(&mut c, at)?,
            Some(s) => {
                let [a, b] = segments[s];
                let ends = [vertex(&mut c, a)?, vertex(&mut c, b)?];
                if ends[0] == ends[1] {
                    continue;
                }
                let mut laid = c.insert_segment(ends[0], ends[1]);
                if matches!(laid, Err(Error::SegmentsCross { .. })) {
                    for i in 0..points.len() {
                        vertex(&mut c, i)?;
                    }
                    laid = c.insert_segment(ends[0], ends[1]);
                }
                laid?;
            }
        }
    }
    Ok(c)
}

impl Attack for Graphs {
    type Item = Item;

    fn make(random: &mut Random) -> Vec<Item> {
        let mut places = nasty::points::<2>(random, 30);
        let hub = nasty::query(random, &places);
        places.push(hub);
        let mut segments: Vec<[Point; 2]> = Vec::new();
        let crosses_seldom = !once_in(random, 4);
        let has_hub = once_in(random, 4);
        for _ in 0..random.below(20) {
            let from = if has_hub { hub } else { places[random.below(places.len())] };
            let new = [from, places[random.below(places.len())]];
            let [a, b] = new;
            let crosses = |&[c, d]: &[Point; 2]| !crossing_pairs(&[a, b, c, d], &[[0, 1], [2, 3]]).is_empty();
            if !crosses_seldom || once_in(random, 100) || !segments.iter().any(crosses) {
                segments.push(new);
            }
        }
        let mut items: Vec<Item> = places.into_iter().map(Item::Point).collect();
        items.extend(segments.into_iter().map(Item::Segment));
        random.shuffle(&mut items);
        items
    }

    fn judge(items: &[Item], seed: u64) -> Judgement {
        let (points, segments) = parts(items);
        let pairs = crossing_pairs(&points, &segments);
        if !pairs.is_empty() {
            return judge_crossings(&points, &segments, &pairs);
        }
        let build = |points: &[Point], segments: &[[usize; 2]]| {
            Constrained2::from_parts(points, segments).map_err(|error| error.to_string())
        };
        let first = build(&points, &segments)?;
        judge(&first, &points, &segments)?;
        let alike = |c: &Constrained2, how: &str| {
            c.check().map_err(|flaw| format!("{how}: check: {flaw:?}"))?;
            let are = triangles(c) == triangles(&first) && constraints(c) == constraints(&first);
            if are { Ok(()) } else { Err(format!("{how}: other triangles")) }
        };
        let mut random = Random::new(seed);
        for (pool, threads) in pools().iter().zip(THREADS) {
            alike(&pool.install(|| build(&points, &segments))?, &format!("{threads} threads"))?;
        }
        let (other_points, other_segments) = shuffled(&points, &segments, &mut random);
        alike(&build(&other_points, &other_segments)?, "in another order")?;
        let mut grown =
            one_by_one(&points, &segments, &mut random).map_err(|error| format!("one by one: {error}"))?;
        alike(&grown, "one by one")?;
        // Without the segments it is the triangulation of the points.
        let mut ids: Vec<SegmentId> = grown.segments().map(|(s, _)| s).collect();
        random.shuffle(&mut ids);
        for s in ids {
            grown.remove_segment(s).map_err(|error| format!("remove a segment: {error}"))?;
        }
        judge(&grown, &points, &[]).map_err(|what| format!("without segments: {what}"))
    }
}
