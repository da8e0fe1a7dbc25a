//! Answers of a triangulation, against the definition of each question.

use delone::{Found, VertexId};
use num_bigint::BigInt;

use crate::attack::Judgement;
use crate::engine::Engine;
use crate::oracle::exact::{Vector, along, axes, integer, integers, is_inside, orientation, scale, squared};

/// Asks about a point, a ball around it and the box between it and another one.
pub(crate) fn judge<E: Engine<D>, const D: usize>(
    engine: &E,
    sites: &[(VertexId, [f64; D])],
    q: [f64; D],
    other: [f64; D],
    radius: f64,
    k: usize,
) -> Judgement {
    let numbers = sites.iter().flat_map(|(_, p)| p).chain(&q).chain([&radius]);
    let scale = scale(numbers);
    let exact = |p: &[f64; D]| -> Vector { p.iter().map(|&x| integer(x, scale)).collect() };
    let (center, reach) = (exact(&q), integer(radius, scale));
    let mut by_distance: Vec<(BigInt, [f64; D], VertexId)> =
        sites.iter().map(|(v, p)| (squared(&exact(p), &center), *p, *v)).collect();
    by_distance.sort_by(|(d, p, _), (e, r, _)| d.cmp(e).then(p.partial_cmp(r).expect("finite")));
    let mut answers = Answers(Vec::new());

    let nearest: Vec<VertexId> = by_distance.iter().map(|(_, _, v)| *v).collect();
    answers.compare(
        "nearest",
        engine.nearest_observed(q, &mut ()).map(Vec::from_iter),
        nearest.iter().take(1).copied(),
    );
    answers.compare("k_nearest", engine.k_nearest(q, k), nearest.iter().take(k).copied());
    let is_within = |(d, ..): &&(BigInt, [f64; D], VertexId)| radius >= 0.0 && *d <= &reach * &reach;
    let within = by_distance.iter().filter(is_within).map(|(_, _, v)| *v);
    answers.compare("within", engine.within(q, radius), ascending(within));
    let (low, high): ([f64; D], [f64; D]) =
        (std::array::from_fn(|k| q[k].min(other[k])), std::array::from_fn(|k| q[k].max(other[k])));
    if let Some(found) = engine.in_box(low, high) {
        let in_box = |p: &[f64; D]| (0..D).all(|k| low[k] <= p[k] && p[k] <= high[k]);
        let expected = sites.iter().filter(|(_, p)| in_box(p)).map(|(v, _)| *v);
        answers.compare("in_rectangle", found, ascending(expected));
    }
    if let Some((_, at, v)) = by_distance.get(k) {
        let here = exact(at);
        let others = by_distance.iter().filter(|(_, _, w)| w != v);
        let best = others.min_by(|(_, p, _), (_, r, _)| {
            let [to_p, to_r] = [p, r].map(|p| squared(&exact(p), &here));
            to_p.cmp(&to_r).then(p.partial_cmp(r).expect("finite"))
        });
        let found: Vec<VertexId> = engine.nearest_neighbor(*v).into_iter().collect();
        answers.compare("nearest_neighbor", Ok(found), best.map(|(_, _, w)| *w));
    }
    match answers.0.into_iter().next() {
        Some(wrong) => Err(wrong),
        None => judge_place(engine, sites, q),
    }
}

/// The wrong answers.
struct Answers(Vec<String>);

impl Answers {
    fn compare(
        &mut self,
        name: &str,
        found: Result<Vec<VertexId>, delone::Error>,
        expected: impl IntoIterator<Item = VertexId>,
    ) {
        let expected: Vec<VertexId> = expected.into_iter().collect();
        if found.as_ref() != Ok(&expected) {
            self.0.push(format!("{name}: {found:?} instead of {expected:?}"));
        }
    }
}

fn ascending(vertices: impl Iterator<Item = VertexId>) -> Vec<VertexId> {
    let mut all: Vec<VertexId> = vertices.collect();
    all.sort_unstable();
    all
}

/// Where the engine says that a point is.
fn judge_place<E: Engine<D>, const D: usize>(
    engine: &E,
    sites: &[(VertexId, [f64; D])],
    q: [f64; D],
) -> Judgement {
    let found = engine.find(q).map_err(|error| error.to_string())?;
    let mut points: Vec<[f64; D]> = sites.iter().map(|(_, p)| *p).collect();
    points.push(q);
    // All that is compared has to be on one scale.
    let exact = integers(&points);
    let of =
        |p: &[f64; D]| points.iter().position(|site| site == p).map_or_else(Vec::new, |i| exact[i].clone());
    let of_all = |corners: &[[f64; D]]| -> Vec<Vector> { corners.iter().map(of).collect() };
    let goal = &exact[sites.len()];
    let face: Vec<[f64; D]> = found.face().iter().filter_map(|&v| engine.position(v)).collect();
    let right = match (found.is_outside, found.face().is_empty()) {
        (false, _) => is_inside(&of_all(&face), goal) && is_of_simplex(engine, &found),
        (true, false) => {
            let facet = of_all(&face);
            let side = |p: &Vector| orientation(&facet.iter().chain([p]).collect::<Vec<_>>());
            let beyond = side(goal);
            facet.len() == D && beyond != 0 && exact[..sites.len()].iter().all(|p| side(p) != beyond)
        }
        (true, true) => {
            engine.span() < D as isize && !is_in_flat_hull(engine, &exact[..sites.len()], goal, &of_all)
        }
    };
    if right { Ok(()) } else { Err(format!("find: {found:?}")) }
}

/// Whether the simplex found has the face found; there is none only where the vertices span less than the space.
fn is_of_simplex<E: Engine<D>, const D: usize>(engine: &E, found: &Found<E::Simplex>) -> bool {
    match found.simplex {
        Some(s) => {
            let corners = engine.corners(s);
            found.face().iter().all(|v| corners.as_ref().contains(v))
        }
        None => engine.span() < D as isize,
    }
}

/// Whether a point is in a simplex of a triangulation that does not span everything, or on a face of it.
fn is_in_flat_hull<E: Engine<D>, const D: usize>(
    engine: &E,
    sites: &[Vector],
    goal: &Vector,
    of_all: &impl Fn(&[[f64; D]]) -> Vec<Vector>,
) -> bool {
    if sites.contains(goal) {
        return true;
    }
    let with_goal: Vec<Vector> = sites.iter().chain([goal]).cloned().collect();
    let axes = axes(&with_goal);
    if sites.is_empty() || axes.len() as isize != engine.span() {
        return false;
    }
    // Not outside of any side of the simplex.
    let flat_goal = along(goal, &axes);
    engine.points_of_simplices().iter().any(|simplex| {
        let corners: Vec<Vector> = of_all(simplex).iter().map(|p| along(p, &axes)).collect();
        let whole = orientation(&corners.iter().collect::<Vec<_>>());
        (0..corners.len()).all(|i| {
            let with: Vec<&Vector> =
                (0..corners.len()).map(|j| if i == j { &flat_goal } else { &corners[j] }).collect();
            orientation(&with) * whole >= 0
        })
    })
}
