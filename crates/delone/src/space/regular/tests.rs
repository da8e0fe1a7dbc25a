use delone_generators::{Kind3, Random};

use super::Regular3;
use crate::{Delaunay3, VertexId};

type Site = ([f64; 3], f64);

fn tetrahedra(all: impl Iterator<Item = [VertexId; 4]>) -> Vec<[usize; 4]> {
    let sorted = |t: [VertexId; 4]| {
        let mut t = t.map(VertexId::index);
        t.sort_unstable();
        t
    };
    let mut all: Vec<_> = all.map(sorted).collect();
    all.sort_unstable();
    all
}

/// Without weights it is what it is called without them.
#[test]
fn equal_weights_change_nothing() {
    for &kind in Kind3::ALL {
        for weight in [0.0, 0.37, -1e300, 1e-300] {
            let points = kind.points(150, 1);
            let r = Regular3::with_seed(&points, &vec![weight; points.len()], 3).expect("finite");
            let d = Delaunay3::from_points(&points).expect("finite");
            assert_eq!(tetrahedra(r.tetrahedra()), tetrahedra(d.tetrahedra()), "{} {weight}", kind.name());
            assert_eq!(r.vertex_count(), d.vertex_count());
            assert!(r.duplicates().eq(d.duplicates()), "{} {weight}", kind.name());
            r.check().unwrap_or_else(|flaw| panic!("{} {weight}: {flaw}", kind.name()));
        }
    }
}

/// One of several families of sites that tie in many ways.
fn sites(random: &mut Random, n: usize) -> Vec<Site> {
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
fn judge(r: &Regular3, what: &str) {
    r.check().unwrap_or_else(|flaw| panic!("{what}: {flaw}"));
    let ids: Vec<VertexId> = (0..r.ids_given()).map(VertexId::new).filter(|&v| r.site(v).is_some()).collect();
    let all: Vec<Site> = ids.iter().filter_map(|&v| r.site(v)).collect();
    let first = |i: usize| all[..i].iter().all(|site| *site != all[i]);
    let distinct: Vec<usize> = (0..all.len()).filter(|&i| first(i)).collect();
    if distinct.is_empty() {
        assert_eq!(r.vertex_count(), 0);
        return;
    }
    let lifted = delone_oracle::power::Lifted::new(&distinct.iter().map(|&i| all[i]).collect::<Vec<_>>());
    let expected = lifted.regular();
    let name = |i: usize| ids[distinct[i]];
    let mut corners: Vec<VertexId> = expected.iter().flatten().map(|&i| name(i)).collect();
    corners.sort_unstable();
    corners.dedup();
    assert!(r.vertices().eq(corners.iter().copied()), "{what}: vertices {corners:?} of {all:?}");
    let hidden = distinct.iter().map(|&i| ids[i]).filter(|v| !corners.contains(v));
    assert!(r.hidden().filter(|&v| distinct.iter().any(|&i| ids[i] == v)).eq(hidden), "{what}: {all:?}");
    if lifted.dimension() == 3 {
        let mut expected: Vec<[usize; 4]> =
            expected.iter().map(|t| [0, 1, 2, 3].map(|k| name(t[k]).index())).collect();
        expected.sort_unstable();
        assert_eq!(tetrahedra(r.tetrahedra()), expected, "{what}: {all:?}");
    } else {
        assert_eq!(r.tetrahedra().count(), 0);
        if lifted.dimension() == 1 {
            assert_eq!(r.edges().count(), expected.len(), "{what}: {all:?}");
        }
    }
}

#[test]
fn it_is_the_definition_in_any_order() {
    let mut random = Random::new(1);
    let mut hidden = 0;
    for round in 0..300 {
        let count = 1 + random.below(9);
        let mut all = sites(&mut random, count);
        for seed in 0..2 {
            let r = Regular3::from_sites(&all).expect("finite");
            judge(&r, &format!("round {round}, order {seed}"));
            hidden += r.hidden().count();
            let (points, weights): (Vec<_>, Vec<_>) = all.iter().copied().unzip();
            let by_flips = Regular3::by_flips(&points, &weights, seed).expect("finite");
            judge(&by_flips, &format!("round {round}, order {seed}, by flips"));
            assert!(by_flips.hidden().eq(r.hidden()) && by_flips.duplicates().eq(r.duplicates()), "{all:?}");
            random.shuffle(&mut all);
        }
    }
    assert!(hidden > 400, "{hidden}");
}

/// What flips made can change as what cavities made.
#[test]
fn what_flips_made_changes() {
    let mut random = Random::new(4);
    for round in 0..40 {
        let count = 5 + random.below(8);
        let all = sites(&mut random, count);
        let (points, weights): (Vec<_>, Vec<_>) = all.iter().copied().unzip();
        let mut r = Regular3::by_flips(&points, &weights, round).expect("finite");
        for &(p, w) in &sites(&mut random, 3) {
            r.insert(p, w).expect("finite");
        }
        for v in 0..count {
            r.remove(VertexId::new(v)).expect("alive");
            judge(&r, &format!("round {round}, without {v}"));
        }
    }
}

/// After every insertion, removal and change of a weight.
#[test]
fn a_life_is_the_definition_at_every_step() {
    let mut random = Random::new(2);
    for round in 0..60 {
        let count = random.below(7);
        let start = sites(&mut random, count);
        let more = sites(&mut random, 30);
        let mut r = Regular3::from_sites(&start).expect("finite");
        for step in 0..40 {
            let alive: Vec<VertexId> =
                (0..r.ids_given()).map(VertexId::new).filter(|&v| r.site(v).is_some()).collect();
            let any = |random: &mut Random| alive[random.below(alive.len())];
            let what = match random.below(4) {
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
fn the_nearest_site_has_the_least_power() {
    use delone_predicates::compare_powers;
    let mut random = Random::new(3);
    for _ in 0..200 {
        let count = 1 + random.below(40);
        let all = sites(&mut random, count);
        let r = Regular3::from_sites(&all).expect("finite");
        for _ in 0..10 {
            let q = [random.below(9) as f64 / 2.0, random.between(-1.0, 4.0), 1.0];
            let v = r.nearest(q).expect("finite").expect("a site");
            let found = r.site(v).expect("alive");
            assert!(all.iter().all(|&site| compare_powers(q, found, site).is_le()), "{all:?} {q:?}");
        }
    }
    assert_eq!(Regular3::new().nearest([0.0; 3]), Ok(None));
}
