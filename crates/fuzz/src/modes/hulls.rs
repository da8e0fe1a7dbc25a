//! Hulls, nearest and furthest sites, the smallest circle around points: against definitions.

use delone::{Delaunay2, Dimension, Hull2, Inserted, NearestSites2};
use delone::{Hull3, HullHistory3};
use delone_generators::Random;

use crate::attack::{Attack, Judgement};
use crate::nasty;
use crate::oracle::delaunay::distinct;
use crate::oracle::exact::{determinant, dot, integers, minus, orientation, sign};
use crate::oracle::hull::{by_distance, contains, corners2, faces};

/// How many points are asked about.
const QUERIES: usize = 12;

/// In the plane.
pub(crate) struct Planar;

/// In space.
pub(crate) struct Spatial;

impl Attack for Planar {
    type Item = [f64; 2];

    fn make(random: &mut Random) -> Vec<[f64; 2]> {
        nasty::points(random, 40)
    }

    fn judge(points: &[[f64; 2]], seed: u64) -> Judgement {
        let mut random = Random::new(seed);
        let text = |error: delone::Error| error.to_string();
        let expected = corners2(points);
        let found = Hull2::from_points(points).map_err(text)?;
        if found.corners() != expected {
            return Err(format!("convex_hull: {found:?} instead of {expected:?}"));
        }
        let d = Delaunay2::from_points(points).map_err(text)?;
        let furthest = d.furthest();
        let mut corners: Vec<usize> = furthest.corners().iter().map(|v| v.index()).collect();
        if let Some(least) = expected.first().and_then(|least| corners.iter().position(|i| i == least)) {
            corners.rotate_left(least);
        }
        if corners != expected {
            return Err(format!("the corners of furthest: {corners:?} instead of {expected:?}"));
        }
        let sites = NearestSites2::from_points(points, seed).map_err(text)?;
        let (mut grown, mut given) = (NearestSites2::new(), Vec::new());
        for &p in points {
            if let Inserted::New(v) = grown.insert(p).map_err(text)? {
                if v.index() != given.len() {
                    return Err(format!("NearestSites: {v:?} is the {}th", given.len()));
                }
                given.push(p);
            }
        }
        for _ in 0..QUERIES {
            let q = nasty::query(&mut random, points);
            let found = sites.nearest(q).map_err(text)?;
            let expected = by_distance(points, q, false);
            if found != expected {
                return Err(format!("NearestSites of {q:?}: {found:?} instead of {expected:?}"));
            }
            let found = grown.nearest(q).map_err(text)?.map(|i| given[i]);
            if found != expected.map(|i| points[i]) {
                return Err(format!("NearestSites on line, of {q:?}: {found:?} instead of {expected:?}"));
            }
            let found = furthest.furthest(q).map_err(text)?.map(|v| v.index());
            let expected = by_distance(points, q, true);
            if found != expected {
                return Err(format!("furthest from {q:?}: {found:?} instead of {expected:?}"));
            }
        }
        furthest_triangles(points, &furthest)?;
        smallest_circle(points, &furthest)
    }
}

/// The triangles of the corners of the hull: no point is outside of the circle of any.
fn furthest_triangles(points: &[[f64; 2]], furthest: &delone::Furthest2) -> Judgement {
    let exact = integers(points);
    let triangles: Vec<[usize; 3]> = furthest.triangles().map(|t| t.map(|v| v.index())).collect();
    if triangles.len() != furthest.corners().len().saturating_sub(2) {
        return Err(format!("furthest: {} triangles", triangles.len()));
    }
    for t in &triangles {
        let lifted = |i: usize| {
            let mut row = minus(&exact[i], &exact[t[0]]);
            row.push(dot(&row, &row));
            row
        };
        let outside = |q: usize| sign(&determinant(&[lifted(t[1]), lifted(t[2]), lifted(q)])) > 0;
        if orientation(&t.map(|i| &exact[i])) <= 0 || (0..points.len()).any(outside) {
            return Err(format!("furthest: the circle of {t:?} is no circle around all"));
        }
    }
    Ok(())
}

/// The circle is determined by its support, and nothing is outside of it.
fn smallest_circle(points: &[[f64; 2]], furthest: &delone::Furthest2) -> Judgement {
    let exact = integers(points);
    let Some(circle) = furthest.enclosing_circle() else {
        // Only a center beyond the range of numbers is an excuse.
        let finite = points.iter().flatten().all(|x| x.abs() < 1e300);
        return if points.is_empty() || !finite { Ok(()) } else { Err("no enclosing circle".to_owned()) };
    };
    let support: Vec<usize> = circle.support.iter().map(|v| v.index()).collect();
    // The sign of the angle at o between a and b.
    let angle =
        |o: usize, a: usize, b: usize| sign(&dot(&minus(&exact[a], &exact[o]), &minus(&exact[b], &exact[o])));
    let right = match support[..] {
        [a] => points.iter().all(|p| *p == points[a]),
        [a, b] => (0..points.len()).all(|o| angle(o, a, b) <= 0),
        [a, b, c] => {
            let acute = [(a, b, c), (b, c, a), (c, a, b)].iter().all(|&(o, p, q)| angle(o, p, q) > 0);
            let lifted = |i: usize| {
                let mut row = minus(&exact[i], &exact[a]);
                row.push(dot(&row, &row));
                row
            };
            let turn = orientation(&[a, b, c].map(|i| &exact[i]));
            let height = |q: usize| sign(&determinant(&[lifted(b), lifted(c), lifted(q)])) * turn;
            acute && turn != 0 && (0..points.len()).all(|q| height(q) <= 0)
        }
        _ => false,
    };
    if !right {
        return Err(format!("enclosing circle: the support is {support:?}"));
    }
    // Where nothing overflows or underflows, the numbers are right too.
    let size = points.iter().flatten().fold(0.0_f64, |size, x| size.max(x.abs()));
    if (1e-100..1e100).contains(&size) {
        for &i in &support {
            let p = points[i];
            let distance = (p[0] - circle.center[0]).hypot(p[1] - circle.center[1]);
            if (distance - circle.radius).abs() > 1e-9 * size {
                return Err(format!("enclosing circle: {circle:?} does not touch {p:?}"));
            }
        }
    }
    Ok(())
}

impl Attack for Spatial {
    type Item = [f64; 3];

    fn make(random: &mut Random) -> Vec<[f64; 3]> {
        nasty::points(random, 24)
    }

    fn judge(points: &[[f64; 3]], seed: u64) -> Judgement {
        let mut random = Random::new(seed);
        let text = |error: delone::Error| error.to_string();
        let history = HullHistory3::from_points(points, seed).map_err(text)?;
        let mut grown = HullHistory3::new();
        points.iter().try_for_each(|&p| grown.insert(p).map(drop)).map_err(text)?;
        for (name, hull) in [
            ("Hull3", &Hull3::from_points(points).map_err(text)?),
            ("HullHistory", history.hull()),
            ("a hull that grows", grown.hull()),
            ("by_flips", &Hull3::by_flips(points, seed).map_err(text)?.0),
        ] {
            judge_hull(points, hull).map_err(|message| format!("{name}: {message}"))?;
        }
        for _ in 0..QUERIES / 3 {
            let q = nasty::query(&mut random, points);
            let found = history.contains(q).map_err(text)?;
            if found != contains_any(points, q) {
                return Err(format!("HullHistory contains {q:?}: {found}"));
            }
        }
        Ok(())
    }
}

fn contains_any(points: &[[f64; 3]], q: [f64; 3]) -> bool {
    !points.is_empty() && contains(&distinct(points), q.map(|x| x + 0.0))
}

fn judge_hull(points: &[[f64; 3]], hull: &Hull3) -> Judgement {
    if points.is_empty() {
        let empty =
            hull.dimension() == Dimension::Empty && hull.corners().is_empty() && hull.faces().len() == 0;
        return if empty { Ok(()) } else { Err(format!("{hull:?}")) };
    }
    let (span, expected) = faces(points);
    let found_span = match hull.dimension() {
        Dimension::Space => 3,
        Dimension::Plane => 2,
        Dimension::Line => 1,
        Dimension::Point => 0,
        Dimension::Empty => usize::MAX,
    };
    if found_span != span {
        return Err(format!("spans {found_span} instead of {span}"));
    }
    let mut found =
        if span < 2 { vec![hull.corners().to_vec()] } else { hull.faces().map(<[usize]>::to_vec).collect() };
    // A line may be read from either end, a flat face seen from either side.
    if let (0..3, [face]) = (span, &mut found[..])
        && [face.clone()] != expected[..]
    {
        let from = usize::from(span == 2).min(face.len());
        face[from..].reverse();
    }
    found.sort();
    if found != expected {
        return Err(format!("the faces are {found:?} instead of {expected:?}"));
    }
    let mut corners: Vec<usize> = expected.concat();
    corners.sort_unstable();
    corners.dedup();
    let mut named = hull.corners().to_vec();
    named.sort_unstable();
    if named == corners { Ok(()) } else { Err(format!("the corners are {named:?} instead of {corners:?}")) }
}
