//! Small hostile graphs are refined, in every way that can be asked for: what comes out is proved by definitions over integers,
//! is the same for other orders of the input, and is refined again and changed like any other triangulation.

mod arcs;
mod judge;
mod kept;
mod shapes;
mod wish;

use delone::{Constrained2, Crossings, Error, Fill, Reason, Refined2, VertexId};
use delone_generators::Random;

use super::graphs::{Item, constraints, parts, triangles};
use crate::attack::{Attack, Judgement};
use crate::nasty::{self, once_in};
use judge::{Case, Lines};
use wish::Wish;

type Point = [f64; 2];

/// See the module.
pub(crate) struct Mesh;

/// Points and segments in another order; segments in another direction too, if that says nothing.
fn shuffled(
    (points, segments): (&[Point], &[[usize; 2]]),
    may_turn: bool,
    random: &mut Random,
) -> (Vec<Point>, Vec<[usize; 2]>) {
    let mut order: Vec<usize> = (0..points.len()).collect();
    random.shuffle(&mut order);
    let mut place = vec![0; order.len()];
    order.iter().enumerate().for_each(|(at, &i)| place[i] = at);
    let mut turned = |[a, b]: [usize; 2]| if may_turn && once_in(random, 2) { [b, a] } else { [a, b] };
    let mut other: Vec<[usize; 2]> = segments.iter().map(|ends| turned(ends.map(|i| place[i]))).collect();
    random.shuffle(&mut other);
    (order.iter().map(|&i| points[i]).collect(), other)
}

/// Builds and refines; the triangulation before and after, and what was said.
fn refined(
    points: &[Point],
    segments: &[[usize; 2]],
    wish: &Wish,
) -> Result<(Constrained2, Constrained2, Result<Refined2, Error>), String> {
    let before = Constrained2::with_crossings(points, segments, Crossings::Split)
        .map_err(|error| format!("building: {error}"))?;
    let mut c = before.clone();
    let answer = wish.run(&mut c, wish.fill());
    Ok((before, c, answer))
}

/// Whether two refinements of the same input, in other orders, gave the same.
fn is_same(
    (before, c, answer): (&Constrained2, &Constrained2, &Result<Refined2, Error>),
    (other_before, d, other): (&Constrained2, &Constrained2, &Result<Refined2, Error>),
) -> Judgement {
    let new = |before: &Constrained2, c: &Constrained2| c.points()[before.points().len()..].to_vec();
    if new(before, c) != new(other_before, d) {
        return Err("new vertices are others, or in another order".to_owned());
    }
    if triangles(c) != triangles(d) || constraints(c) != constraints(d) {
        return Err("other triangles".to_owned());
    }
    match (answer, other) {
        (Ok(one), Ok(two)) if judge::said(c, one) == judge::said(d, two) => Ok(()),
        (Ok(_), Ok(_)) => Err("another report".to_owned()),
        (Err(one), Err(two)) if one.to_string() == two.to_string() => Ok(()),
        (one, two) => {
            Err(format!("{:?}, then {:?}", one.as_ref().map(|_| "refined"), two.as_ref().map(|_| "refined")))
        }
    }
}

/// A mesh that has all that was asked for, but where angles of the input are small, stays as it is.
fn good_stays(c: &Constrained2, refined: &Refined2, wish: &Wish) -> Judgement {
    let report = &refined.report;
    // With as many vertices as there may be, constraints are left too.
    let is_whole = report.inside + report.on_constraints < wish.most;
    if !is_whole || report.left.iter().any(|left| left.reason != Reason::InputAngle) {
        return Ok(());
    }
    let easier = wish.easier();
    let mut d = c.clone();
    let again = easier.run(&mut d, Fill::Parts(&refined.domains)).map_err(|error| error.to_string())?;
    if c.points() != d.points() {
        return Err(format!("{:?} more, though all was good", &d.points()[c.points().len()..]));
    }
    if judge::said(c, refined).0 != judge::said(&d, &again).0 {
        return Err("other triangles are inside, though all was good".to_owned());
    }
    Ok(())
}

/// Refines the inside again, as it is.
fn refine_again(c: &Constrained2, refined: &Refined2, wish: &Wish, lines: &Lines) -> Judgement {
    let mut d = c.clone();
    let fill = Fill::Parts(&refined.domains);
    let answer = wish.run(&mut d, fill);
    Case { before: c, after: &d, wish, fill, lines, kept: &refined.kept }.judge(&answer).map(|_| ())
}

/// Vertices come and go in what was refined, as in any other triangulation.
fn change(c: &mut Constrained2, given: usize, random: &mut Random) -> Judgement {
    for _ in 0..4 {
        let vertices: Vec<VertexId> = c.vertices().collect();
        if vertices.is_empty() {
            return Ok(());
        }
        let new: Vec<VertexId> = vertices.iter().copied().filter(|v| v.index() >= given).collect();
        let event = if once_in(random, 2) {
            let from: Vec<Point> = vertices.iter().map(|&v| c.point(v)).collect();
            let p = nasty::query(random, &from);
            c.insert(p).map_err(|error| format!("insert {p:?}: {error}"))?;
            format!("insert {p:?}")
        } else {
            let of = if new.is_empty() { &vertices } else { &new };
            let v = of[random.below(of.len())];
            match c.remove(v) {
                Ok(()) | Err(Error::ConstraintsEnd { .. }) => format!("remove {v:?}"),
                Err(error) => return Err(format!("remove {v:?}: {error}")),
            }
        };
        judge::is_valid(c).map_err(|what| format!("{event}: {what}"))?;
    }
    Ok(())
}

impl Attack for Mesh {
    type Item = Item;

    fn make(random: &mut Random) -> Vec<Item> {
        shapes::graph(random)
    }

    fn judge(items: &[Item], seed: u64) -> Judgement {
        let (points, segments) = parts(items);
        let mut random = Random::new(seed);
        let wish = Wish::random(&mut random, &points);
        let named = |what: String| format!("{wish:?}: {what}");
        let (before, mut c, answer) = refined(&points, &segments, &wish)?;
        let nothing = Lines::new();
        let case =
            Case { before: &before, after: &c, wish: &wish, fill: wish.fill(), lines: &nothing, kept: &[] };
        let lines = case.judge(&answer).map_err(named)?;
        let (points_too, segments_too) = shuffled((&points, &segments), wish.may_turn(), &mut random);
        let (other_before, d, other) = refined(&points_too, &segments_too, &wish)?;
        is_same((&before, &c, &answer), (&other_before, &d, &other))
            .map_err(|what| named(format!("in another order: {what}")))?;
        let again = Wish::random(&mut random, &points);
        if let Ok(refined) = &answer {
            good_stays(&c, refined, &wish).map_err(named)?;
            kept::attack(&before, &wish, &again, &mut random)
                .map_err(|what| named(format!("of other triangles, then by {again:?}: {what}")))?;
            arcs::attack(&before, &wish, &again, &mut random)
                .map_err(|what| named(format!("along arcs, then by {again:?}: {what}")))?;
            let more = again.clone().inside_of(&wish);
            refine_again(&c, refined, &more, &lines)
                .map_err(|what| named(format!("then what is inside by {more:?}: {what}")))?;
        }
        // The mesh is an input like others.
        let first = c.clone();
        let answer = again.run(&mut c, again.fill());
        let case =
            Case { before: &first, after: &c, wish: &again, fill: again.fill(), lines: &nothing, kept: &[] };
        case.judge(&answer).map_err(|what| named(format!("then {again:?}: {what}")))?;
        change(&mut c, points.len(), &mut random)
            .map_err(|what| named(format!("then {again:?}: then {what}")))
    }
}
