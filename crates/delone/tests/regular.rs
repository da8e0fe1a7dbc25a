//! Regular triangulations by their definition, in the plane and in space: built in any way and order, and at every step of a life.

use delone::{
    Change, Delaunay2, Delaunay3, Error, Location2, Location3, Regular, Regular2, Regular3, Reweighed,
    TetrahedronId, TriangleId, Triangulation, VertexId,
};
use delone_generators::{Kind, Kind3, Random};
use delone_oracle::power::Lifted;
use delone_oracle::share;
use delone_predicates::{compare_powers, orient2d, orient3d};

type Site<const D: usize> = ([f64; D], f64);

/// The simplices, each with its corners sorted, sorted.
fn simplices<T: Triangulation>(t: &T) -> Vec<Vec<VertexId>> {
    let sorted = |s| {
        let mut corners = t.corners(s).as_ref().to_vec();
        corners.sort_unstable();
        corners
    };
    let mut all: Vec<_> = t.simplices().map(sorted).collect();
    all.sort_unstable();
    all
}

/// One of several families of sites that tie in many ways.
fn in_plane(random: &mut Random, n: usize) -> Vec<Site<2>> {
    let family = random.below(6);
    (0..n)
        .map(|_| {
            let [x, y] = [random.below(4) as f64, random.below(4) as f64];
            match family {
                0 => ([x, y], x * x + y * y),
                1 => ([x, y], random.below(3) as f64),
                2 => ([x, 2.0 * x], random.below(4) as f64),
                3 => ([x, 0.0], x * x),
                4 => ([x, y], x * x + y * y + [0.0, 0.0, 0.0, 1.0, -1.0][random.below(5)]),
                _ => ([random.unit(), random.unit()], random.unit() / 4.0),
            }
        })
        .collect()
}

/// Random sites in space.
fn in_space(random: &mut Random, n: usize) -> Vec<Site<3>> {
    let family = random.below(8);
    let square = |p: [f64; 3]| p.iter().map(|x| x * x).sum::<f64>();
    (0..n)
        .map(|_| {
            let p @ [x, y, _] = [(); 3].map(|()| random.below(3) as f64);
            match family {
                0 => (p, square(p)),
                1 => (p, random.below(3) as f64),
                2 => ([x, 2.0 * x, y], random.below(4) as f64),
                3 => ([x, y, 1.0], x * x + y * y),
                4 => (p, square(p) + [0.0, 0.0, 0.0, 1.0, -1.0][random.below(5)]),
                5 => ([x, x, -x], random.below(4) as f64),
                6 => ([1.0, 2.0, 3.0], x),
                _ => ([(); 3].map(|()| random.unit()), random.unit() / 4.0),
            }
        })
        .collect()
}

/// By definition, of the sites that are neither removed nor later than an equal one.
fn judge<const D: usize, R: Regular<Point = [f64; D]>>(r: &R, what: &str) {
    r.check().unwrap_or_else(|flaw| panic!("{what}: {flaw}"));
    let ids: Vec<VertexId> = (0..r.ids_given()).map(VertexId::new).filter(|&v| r.site(v).is_some()).collect();
    let all: Vec<Site<D>> = ids.iter().filter_map(|&v| r.site(v)).collect();
    let first = |i: usize| all[..i].iter().all(|site| *site != all[i]);
    let distinct: Vec<usize> = (0..all.len()).filter(|&i| first(i)).collect();
    if distinct.is_empty() {
        assert_eq!(r.vertex_count(), 0);
        return;
    }
    let lifted = Lifted::new(&distinct.iter().map(|&i| all[i]).collect::<Vec<_>>());
    let name = |&i: &usize| ids[distinct[i]];
    let mut expected: Vec<Vec<VertexId>> =
        lifted.regular().iter().map(|simplex| simplex.iter().map(name).collect()).collect();
    expected.sort_unstable();
    let mut corners: Vec<VertexId> = expected.iter().flatten().copied().collect();
    corners.sort_unstable();
    corners.dedup();
    assert!(r.vertices().eq(corners.iter().copied()), "{what}: vertices {corners:?} of {all:?}");
    let hidden = distinct.iter().map(|&i| ids[i]).filter(|v| !corners.contains(v));
    assert!(r.hidden().filter(|&v| distinct.iter().any(|&i| ids[i] == v)).eq(hidden), "{what}: {all:?}");
    if lifted.dimension() == D {
        assert_eq!(simplices(r), expected, "{what}: {all:?}");
    } else {
        assert_eq!(r.simplices().count(), 0);
        if lifted.dimension() == 1 {
            assert_eq!(r.edges().count(), expected.len(), "{what}: {all:?}");
        }
    }
}

/// Without weights it is what it is called without them.
fn equal_weights_change_nothing<R: Regular, D: Change<Point = R::Point>>(name: &str, points: &[R::Point]) {
    let d = D::from_vec(points.to_vec()).expect("finite");
    for weight in [0.0, 0.37, -1e300, 1e-300] {
        let weights = vec![weight; points.len()];
        let r = R::from_parts(points, &weights).expect("finite");
        let one_by_one = R::with_seed(points, &weights, 3).expect("finite");
        for r in [r, one_by_one] {
            assert_eq!(simplices(&r), simplices(&d), "{name} {weight}");
            assert_eq!(r.vertex_count(), d.vertex_count());
            assert!(r.duplicates().eq(d.duplicates()), "{name} {weight}");
            r.check().unwrap_or_else(|flaw| panic!("{name} {weight}: {flaw}"));
        }
    }
}

#[test]
fn equal_weights_change_nothing_in_the_plane() {
    for kind in Kind::ALL {
        equal_weights_change_nothing::<Regular2, Delaunay2>(kind.name(), &kind.points(300, 1));
    }
}

#[test]
fn equal_weights_change_nothing_in_space() {
    for kind in Kind3::ALL {
        equal_weights_change_nothing::<Regular3, Delaunay3>(kind.name(), &kind.points(150, 1));
    }
}

/// A construction of points, weights and a seed.
type Build<const D: usize, R> = fn(&[[f64; D]], &[f64], u64) -> Result<R, Error>;

/// Returns how many sites were hidden in all.
fn in_any_order<const D: usize, R: Regular<Point = [f64; D]>>(
    sites: impl Fn(&mut Random, usize) -> Vec<Site<D>>,
    rounds: usize,
    others: &[Build<D, R>],
) -> usize {
    let mut random = Random::new(1);
    let mut hidden = 0;
    for round in 0..rounds {
        let count = 1 + random.below(9);
        let mut all = sites(&mut random, count);
        for seed in 0..3 {
            let (points, weights): (Vec<_>, Vec<_>) = all.iter().copied().unzip();
            let r = R::from_parts(&points, &weights).expect("finite");
            judge(&r, &format!("round {round}, order {seed}"));
            for (k, build) in others.iter().enumerate() {
                let other = build(&points, &weights, seed).expect("finite");
                judge(&other, &format!("round {round}, order {seed}, construction {k}"));
                assert!(other.hidden().eq(r.hidden()) && other.duplicates().eq(r.duplicates()), "{all:?}");
            }
            hidden += r.hidden().count();
            random.shuffle(&mut all);
        }
    }
    hidden
}

#[test]
fn it_is_the_definition_in_any_order_in_the_plane() {
    let hidden = in_any_order::<2, Regular2>(in_plane, 800, &[Regular2::with_seed]);
    assert!(hidden > 1000, "{hidden}");
}

#[test]
fn it_is_the_definition_in_any_order_in_space() {
    let hidden = in_any_order::<3, Regular3>(in_space, 300, &[Regular3::with_seed, Regular3::by_flips]);
    assert!(hidden > 400, "{hidden}");
}

/// Nothing, more often than not.
fn once(random: &mut Random) -> f64 {
    [0.0, 0.0, 0.0, 0.5][random.below(4)]
}

/// After every insertion, removal and change of a weight.
fn a_life<const D: usize, R: Regular<Point = [f64; D]>>(
    sites: impl Fn(&mut Random, usize) -> Vec<Site<D>>,
    rounds: usize,
    builds: &[Build<D, R>],
) {
    let mut random = Random::new(2);
    for round in 0..rounds {
        let count = random.below(7);
        let (points, weights): (Vec<_>, Vec<_>) = sites(&mut random, count).into_iter().unzip();
        let more = sites(&mut random, 30);
        let mut r = builds[round % builds.len()](&points, &weights, 1).expect("finite");
        for step in 0..40 {
            let alive: Vec<VertexId> =
                (0..r.ids_given()).map(VertexId::new).filter(|&v| r.site(v).is_some()).collect();
            let any = |random: &mut Random| alive[random.below(alive.len())];
            let what = match random.below(5) {
                4 => {
                    let weights: Vec<f64> =
                        (0..r.ids_given()).map(|i| more[(i + step) % 30].1 + once(&mut random)).collect();
                    r.set_weights(&weights).expect("finite");
                    assert!(alive.iter().all(|&v| r.site(v).expect("alive").1 == weights[v.index()]));
                    format!("all weigh {weights:?}")
                }
                0 if !alive.is_empty() => {
                    let v = any(&mut random);
                    r.remove(v).expect("alive");
                    assert!(r.site(v).is_none());
                    format!("remove {v:?}")
                }
                1 if !alive.is_empty() => {
                    let (v, w) = (any(&mut random), more[random.below(30)].1);
                    r.set_weight(v, w).expect("alive");
                    assert_eq!(r.site(v).map(|site| site.1), Some(w));
                    format!("{v:?} weighs {w}")
                }
                _ if alive.len() < 10 => {
                    let (p, w) = more[random.below(30)];
                    let v = r.insert(p, w).expect("finite").vertex();
                    assert_eq!(r.site(v), Some((p, w)));
                    format!("insert {p:?} {w}")
                }
                _ => continue,
            };
            judge(&r, &format!("round {round}, step {step}: {what}"));
        }
    }
}

#[test]
fn a_life_is_the_definition_at_every_step_in_the_plane() {
    let built: Build<2, Regular2> = |points, weights, _| Regular2::from_parts(points, weights);
    a_life::<2, Regular2>(in_plane, 3 * share(150), &[built, Regular2::with_seed]);
}

#[test]
fn a_life_is_the_definition_at_every_step_in_space() {
    a_life::<3, Regular3>(in_space, 3 * share(60), &[Regular3::with_seed, Regular3::by_flips]);
}

/// Where points fall, against all triangles and tetrahedra.
#[test]
fn points_fall_where_they_are() {
    let mut random = Random::new(9);
    let side = |a: [f64; 2], b: [f64; 2], q: [f64; 2]| orient2d(a, b, q).is_positive();
    let mut inside = [0; 2];
    for _ in 0..200 {
        let count = 1 + random.below(20);
        let r = Regular2::from_sites(&in_plane(&mut random, count)).expect("finite");
        for _ in 0..10 {
            let q = [random.below(9) as f64 / 2.0, random.below(15) as f64 / 4.0 - 0.5];
            let is_vertex = r.vertices().find(|&v| r.site(v).expect("alive").0 == q);
            let corners = |t| r.mesh().corners(t).map(|v| r.site(v).expect("alive").0);
            let strictly = |t: &TriangleId| {
                let [a, b, c] = corners(*t);
                side(a, b, q) && side(b, c, q) && side(c, a, q)
            };
            let beyond = |t: TriangleId| {
                let [a, b, c] = corners(t);
                side(b, a, q) || side(c, b, q) || side(a, c, q)
            };
            let found = r.locate(q).expect("finite");
            match found {
                Location2::Vertex(v) => assert_eq!(is_vertex, Some(v)),
                Location2::Triangle(t) => assert_eq!(r.triangle_ids().find(strictly), Some(t)),
                Location2::Edge(_) => assert!(is_vertex.is_none() && !r.triangle_ids().any(|t| strictly(&t))),
                Location2::Outside(_) => assert!(r.triangle_ids().all(beyond), "{q:?}"),
                Location2::LowerDimensional(_) => assert_eq!(r.triangle_ids().count(), 0),
            }
            inside[0] += usize::from(matches!(found, Location2::Triangle(_)));
        }
        let r = Regular3::from_sites(&in_space(&mut random, count)).expect("finite");
        for _ in 0..10 {
            let q = [(); 3].map(|()| random.below(17) as f64 / 8.0);
            let strictly = |t: &TetrahedronId| {
                let [a, b, c, d] = r.mesh().corners(*t).map(|v| r.site(v).expect("alive").0);
                let sides = [[a, b, c, q], [b, a, d, q], [c, b, d, q], [a, c, d, q]];
                sides.into_iter().all(|[a, b, c, d]| orient3d(a, b, c, d).is_positive())
            };
            let inner = r.tetrahedron_ids().find(strictly);
            match r.locate(q).expect("finite") {
                Location3::Vertex(v) => assert_eq!(r.site(v).expect("alive").0, q),
                Location3::Tetrahedron(t) => assert_eq!(inner, Some(t)),
                _ => assert_eq!(inner, None),
            }
            inside[1] += usize::from(inner.is_some());
        }
    }
    assert!(inside.iter().all(|&inside| inside > 100), "{inside:?}");
}

/// A cell is empty if three of the half-planes that make it have no point in common (Helly's theorem), of which two may do: decided in
/// integers, without any triangle.
fn is_hidden(site: Site<2>, others: &[Site<2>]) -> bool {
    let whole = |x: f64| x as i64;
    let ([x, y], w) = site;
    let (x, y, w) = (whole(x), whole(y), whole(w));
    // n . q <= c, for points q seen from the site.
    let half_planes = others.iter().map(|&([p, q], v)| {
        let [p, q] = [whole(p) - x, whole(q) - y];
        ([2 * p, 2 * q], p * p + q * q - whole(v) + w)
    });
    let all: Vec<([i64; 2], i64)> = half_planes.collect();
    let cross = |a: [i64; 2], b: [i64; 2]| a[0] * b[1] - a[1] * b[0];
    let dot = |a: [i64; 2], b: [i64; 2]| a[0] * b[0] + a[1] * b[1];
    all.iter().any(|&(a, c)| {
        (a == [0, 0] && c < 0)
            || all.iter().any(|&(b, d)| {
                let opposite = cross(a, b) == 0 && dot(a, b) < 0 && -dot(a, b) * c + dot(a, a) * d < 0;
                opposite
                    || all.iter().any(|&(e, f)| {
                        let shares = [cross(b, e), cross(e, a), cross(a, b)];
                        shares.iter().all(|&share| share > 0)
                            && shares[0] * c + shares[1] * d + shares[2] * f < 0
                    })
            })
    })
}

#[test]
fn hidden_sites_are_those_without_a_cell() {
    let mut random = Random::new(10);
    let mut hidden = 0;
    for _ in 0..600 {
        let count = 1 + random.below(12);
        let size = [3, 5, 40][random.below(3)];
        let site = |random: &mut Random| {
            let p = [(); 2].map(|()| random.below(size) as f64);
            (p, random.below(2 * size) as f64 + if size == 3 { p[0] * p[0] + p[1] * p[1] } else { 0.0 })
        };
        let all: Vec<Site<2>> = (0..count).map(|_| site(&mut random)).collect();
        let r = Regular2::from_sites(&all).expect("finite");
        for v in (0..count).map(VertexId::new) {
            assert_eq!(r.is_hidden(v), is_hidden(all[v.index()], &all), "{v:?} of {all:?}");
        }
        hidden += r.hidden().count();
    }
    assert!(hidden > 500, "{hidden}");
}

/// Steps of weights, small ones and large ones, some sites removed: what is repaired is what is built. Returns how many steps
/// were repaired, and how many sites fell again.
fn steps<const D: usize, R: Regular<Point = [f64; D]>>(
    points: &[[f64; D]],
    random: &mut Random,
) -> [usize; 2] {
    let mut weights = vec![0.0; points.len()];
    let mut r = R::from_parts(points, &weights).expect("finite");
    let mut alive: Vec<VertexId> = (0..points.len()).map(VertexId::new).collect();
    let mut counts = [0; 2];
    for step in 0..12 {
        let spread = [1e-4, 1e-3, 1e-2, 0.1][random.below(4)];
        let steps = [3.0, 1000.0][random.below(2)];
        for w in &mut weights {
            *w += spread * (random.unit() * steps).floor() / steps;
        }
        let found = r.set_weights(&weights).expect("finite");
        if let Reweighed::Repaired { settled, .. } = found {
            counts = [counts[0] + 1, counts[1] + settled];
        }
        r.check().unwrap_or_else(|flaw| panic!("step {step}: {flaw}"));
        let sites: (Vec<[f64; D]>, Vec<f64>) = alive.iter().filter_map(|&v| r.site(v)).unzip();
        let expected = R::from_parts(&sites.0, &sites.1).expect("finite");
        let name = |v: VertexId| alive[v.index()];
        let named = simplices(&expected).into_iter().map(|s| s.into_iter().map(name).collect::<Vec<_>>());
        assert!(simplices(&r).into_iter().eq(named), "step {step}: {found:?}");
        assert!(r.hidden().eq(expected.hidden().map(name)), "step {step}: {found:?}");
        let v = alive.remove(random.below(alive.len()));
        r.remove(v).expect("alive");
    }
    counts
}

#[test]
fn other_weights_at_once_are_as_good_as_new() {
    let mut random = Random::new(8);
    let mut counts = [[0; 2]; 2];
    for round in 0..12 {
        for kind in [Kind::Uniform, Kind::Grid, Kind::Clusters, Kind::Circle] {
            let [repaired, settled] = steps::<2, Regular2>(&kind.points(400, round), &mut random);
            counts[0] = [counts[0][0] + repaired, counts[0][1] + settled];
        }
        for kind in [Kind3::Cube, Kind3::Grid3] {
            let [repaired, settled] = steps::<3, Regular3>(&kind.points(100, round), &mut random);
            counts[1] = [counts[1][0] + repaired, counts[1][1] + settled];
        }
    }
    assert!(counts[0][0] > 40 && counts[0][1] > 400, "{counts:?}");
}

/// Of any sites at points on half-integers.
fn nearest_is_least<const D: usize, R: Regular<Point = [f64; D]>>(
    sites: impl Fn(&mut Random, usize) -> Vec<Site<D>>,
) {
    let mut random = Random::new(3);
    for _ in 0..200 {
        let count = 1 + random.below(40);
        let all = sites(&mut random, count);
        let (points, weights): (Vec<_>, Vec<_>) = all.iter().copied().unzip();
        let r = R::from_parts(&points, &weights).expect("finite");
        for _ in 0..10 {
            let mut q = [1.0; D];
            q[0] = random.below(9) as f64 / 2.0;
            q[1] = random.between(-1.0, 4.0);
            let v = r.nearest(q).expect("finite").expect("a site");
            let found = r.site(v).expect("alive");
            assert!(all.iter().all(|&site| compare_powers(q, found, site).is_le()), "{all:?} {q:?}");
        }
    }
    assert_eq!(R::default().nearest([0.0; D]), Ok(None));
}

#[test]
fn the_nearest_site_has_the_least_power() {
    nearest_is_least::<2, Regular2>(in_plane);
    nearest_is_least::<3, Regular3>(in_space);
}

/// Two constructions that share only predicates and mesh, from no site hidden to nearly all.
#[test]
fn merging_and_inserting_agree() {
    let mut random = Random::new(5);
    let mut hidden = [0; 2];
    for round in 0..150 {
        let kind = Kind::ALL[round % Kind::ALL.len()];
        let points = kind.points(4 + random.below(400), round as u64);
        let size = points.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
        let spacing = size / (points.len() as f64).sqrt();
        let (share, steps) = ([0.1, 1.0, 3.0][random.below(3)], [2, 5, 1 << 40][random.below(3)]);
        let weight = |p: &[f64; 2]| match round % 4 {
            0 => p[0] * p[0] + p[1] * p[1],
            1 => share * spacing * spacing * (random.below(steps) as f64 / steps as f64),
            2 => (share * spacing * random.unit()).powi(2),
            _ => -(p[0] * p[0]) * share,
        };
        let weights: Vec<f64> = points.iter().map(weight).collect();
        if weights.iter().any(|w| !w.is_finite()) {
            continue;
        }
        let merged = Regular2::from_parts(&points, &weights).expect("finite");
        let inserted = Regular2::with_seed(&points, &weights, round as u64).expect("finite");
        let what = format!("round {round}, {} {}", kind.name(), points.len());
        merged.check().unwrap_or_else(|flaw| panic!("{what}: {flaw}"));
        inserted.check().unwrap_or_else(|flaw| panic!("{what}: {flaw}"));
        assert_eq!(simplices(&merged), simplices(&inserted), "{what}");
        assert!(
            merged.hidden().eq(inserted.hidden()) && merged.duplicates().eq(inserted.duplicates()),
            "{what}"
        );
        hidden = [hidden[0] + merged.hidden().count(), hidden[1] + points.len()];
    }
    assert!(4 * hidden[0] > hidden[1], "{hidden:?}");
}
