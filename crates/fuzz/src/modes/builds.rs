//! All ways to build a triangulation of a few points, against the definition.

use delone::Delaunay2;
use delone_generators::Random;

use crate::attack::Judgement;
use crate::engine::{Engine, THREADS, pools, strategies};
use crate::oracle::delaunay::{Simplices, delaunay, span};
use crate::oracle::exact::{integers, orientation};
use crate::oracle::hull::corners2;

/// The first fault of a triangulation of some points, if any.
pub(crate) fn compare<E: Engine<D>, const D: usize>(
    made: &E,
    span: isize,
    expected: &Simplices<D>,
    name: &str,
) -> Judgement {
    if made.span() != span {
        return Err(format!("{name}: spans {} instead of {span}", made.span()));
    }
    let found = made.points_of_simplices();
    if found != *expected {
        let extra: Vec<_> = found.iter().filter(|s| !expected.contains(s)).take(2).collect();
        let missing: Vec<_> = expected.iter().filter(|s| !found.contains(s)).take(2).collect();
        return Err(format!(
            "{name}: {} simplices instead of {}; too much {extra:?}, missing {missing:?}",
            found.len(),
            expected.len()
        ));
    }
    made.is_sound().map_err(|flaw| format!("{name}: {flaw}"))
}

/// Every algorithm, strategy and number of threads.
pub(crate) fn judge<E: Engine<D> + Send, const D: usize>(points: &[[f64; D]], seed: u64) -> Judgement {
    let (span, expected) = (span(points), delaunay(points));
    let twins: Vec<(usize, usize)> =
        (0..points.len()).filter_map(|i| (0..i).find(|&j| points[j] == points[i]).map(|j| (i, j))).collect();
    let compare = |made: Result<E, delone::Error>, name: &str| {
        let made = made.map_err(|error| format!("{name}: {error}"))?;
        compare(&made, span, &expected, name)?;
        let found: Vec<_> = made.duplicates().map(|d| (d.point, d.vertex.index())).collect();
        if found == twins { Ok(()) } else { Err(format!("{name}: duplicates {found:?}")) }
    };
    for (pool, threads) in pools().iter().zip(THREADS) {
        compare(pool.install(|| E::build(points)), &format!("built on {threads} threads"))?;
    }
    for (name, made) in E::others(points, seed) {
        compare(made, &name)?;
    }
    for locate in &strategies(seed)[..E::STRATEGIES] {
        compare(E::located(points, *locate, seed), &format!("{locate:?}"))?;
    }
    let mut shuffled = points.to_vec();
    Random::new(seed).shuffle(&mut shuffled);
    let made = E::build(&shuffled).map_err(|error| format!("shuffled: {error}"))?;
    self::compare(&made, span, &expected, "shuffled")
}

/// Judges the hull of the plane's engine: orientations, and all vertices on it.
pub(crate) fn judge_hull(points: &[[f64; 2]]) -> Judgement {
    let d = Delaunay2::from_points(points).map_err(|error| error.to_string())?;
    for t in d.triangles() {
        let corners = integers(&t.map(|v| d.point(v)));
        if orientation(&corners.iter().collect::<Vec<_>>()) <= 0 {
            return Err(format!("{t:?} is not counter-clockwise"));
        }
    }
    if d.dimension() != delone::Dimension::Plane {
        return Ok(());
    }
    let hull: Vec<usize> = d.hull_vertices().map(|v| v.index()).collect();
    let corners = corners2(points);
    let start = hull.iter().position(|i| i == &corners[0]).ok_or("the smallest point is not on the hull")?;
    let around: Vec<usize> = hull[start..].iter().chain(&hull[..start]).copied().collect();
    let strict: Vec<usize> = around.iter().copied().filter(|i| corners.contains(i)).collect();
    if strict != corners {
        return Err(format!("the hull is {hull:?}, with the corners {corners:?}"));
    }
    let exact = integers(points);
    let straight = |window: [usize; 3]| orientation(&window.map(|i| &exact[i])) >= 0;
    let n = around.len();
    if (0..n).all(|i| straight([around[i], around[(i + 1) % n], around[(i + 2) % n]])) {
        Ok(())
    } else {
        Err(format!("the hull {hull:?} is not convex"))
    }
}
