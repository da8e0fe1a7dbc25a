use delone_generators::{Kind, Random};

use super::Regular2;
use crate::{Delaunay2, VertexId};

type Site = ([f64; 2], f64);

fn triangles(r: &Regular2) -> Vec<[usize; 3]> {
    let sorted = |t: [VertexId; 3]| {
        let mut t = t.map(VertexId::index);
        t.sort_unstable();
        t
    };
    let mut all: Vec<_> = r.triangles().map(sorted).collect();
    all.sort_unstable();
    all
}

/// Without weights it is what it is called without them.
#[test]
fn equal_weights_change_nothing() {
    for &kind in Kind::ALL {
        for weight in [0.0, 0.37, -1e300, 1e-300] {
            let points = kind.points(300, 1);
            let weights = vec![weight; points.len()];
            let r = Regular2::from_parts(&points, &weights).expect("finite");
            let one_by_one = Regular2::with_seed(&points, &weights, 3).expect("finite");
            assert_eq!(triangles(&one_by_one), triangles(&r), "{} {weight}", kind.name());
            let d = Delaunay2::from_points(&points).expect("finite");
            let mut expected: Vec<[usize; 3]> = d.triangles().map(|t| t.map(VertexId::index)).collect();
            expected.iter_mut().for_each(|t| t.sort_unstable());
            expected.sort_unstable();
            assert_eq!(triangles(&r), expected, "{} {weight}", kind.name());
            assert_eq!(r.vertex_count(), d.vertex_count());
            assert!(r.duplicates().eq(d.duplicates()), "{} {weight}", kind.name());
            r.check().unwrap_or_else(|flaw| panic!("{} {weight}: {flaw}", kind.name()));
        }
    }
}

/// One of several families of sites that tie in many ways.
fn sites(random: &mut Random, n: usize) -> Vec<Site> {
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

/// By definition, of the sites that are neither removed nor later than an equal one.
fn judge(r: &Regular2, what: &str) {
    r.check().unwrap_or_else(|flaw| panic!("{what}: {flaw}"));
    let ids: Vec<VertexId> = (0..r.ids_given()).map(VertexId::new).filter(|&v| r.site(v).is_some()).collect();
    let all: Vec<Site> = ids.iter().filter_map(|&v| r.site(v)).collect();
    let first = |i: usize| all[..i].iter().all(|site| *site != all[i]);
    let distinct: Vec<usize> = (0..all.len()).filter(|&i| first(i)).collect();
    let lifted = delone_oracle::power::Lifted::new(&distinct.iter().map(|&i| all[i]).collect::<Vec<_>>());
    let expected = lifted.regular();
    let name = |i: usize| ids[distinct[i]];
    let mut corners: Vec<VertexId> = expected.iter().flatten().map(|&i| name(i)).collect();
    corners.sort_unstable();
    corners.dedup();
    if distinct.is_empty() {
        assert_eq!(r.vertex_count(), 0);
        return;
    }
    assert!(
        r.vertices().eq(corners.iter().copied()),
        "{what}: vertices {corners:?} of {all:?}, not {:?}",
        r.vertices().collect::<Vec<_>>()
    );
    let hidden = distinct.iter().map(|&i| ids[i]).filter(|v| !corners.contains(v));
    assert!(r.hidden().filter(|&v| distinct.iter().any(|&i| ids[i] == v)).eq(hidden), "{what}: {all:?}");
    if lifted.dimension() == 2 {
        let mut expected: Vec<[usize; 3]> =
            expected.iter().map(|t| [0, 1, 2].map(|k| name(t[k]).index())).collect();
        expected.sort_unstable();
        assert_eq!(triangles(r), expected, "{what}: {all:?}");
    } else {
        assert_eq!(r.triangles().count(), 0);
    }
}

#[test]
fn it_is_the_definition_in_any_order() {
    let mut random = Random::new(1);
    let mut hidden = 0;
    for round in 0..800 {
        let count = 1 + random.below(9);
        let mut all = sites(&mut random, count);
        for seed in 0..3 {
            let (points, weights): (Vec<_>, Vec<_>) = all.iter().copied().unzip();
            let one_by_one = Regular2::with_seed(&points, &weights, seed).expect("finite");
            judge(&one_by_one, &format!("round {round}, order {seed}, one by one"));
            let r = Regular2::from_sites(&all).expect("finite");
            judge(&r, &format!("round {round}, order {seed}"));
            hidden += r.hidden().count();
            random.shuffle(&mut all);
        }
    }
    assert!(hidden > 1000, "{hidden}");
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
        assert_eq!(triangles(&merged), triangles(&inserted), "{what}");
        assert!(
            merged.hidden().eq(inserted.hidden()) && merged.duplicates().eq(inserted.duplicates()),
            "{what}"
        );
        hidden = [hidden[0] + merged.hidden().count(), hidden[1] + points.len()];
    }
    assert!(4 * hidden[0] > hidden[1], "{hidden:?}");
}

/// After every insertion, removal and change of a weight.
#[test]
fn a_life_is_the_definition_at_every_step() {
    let mut random = Random::new(2);
    for round in 0..150 {
        let count = random.below(7);
        let start = sites(&mut random, count);
        let more = sites(&mut random, 30);
        let mut r = Regular2::from_sites(&start).expect("finite");
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

/// Cells tile, hold what is nearest to them, and change as their Jacobian says.
#[test]
fn power_cells_tile_and_change_as_their_jacobian_says() {
    let mut random = Random::new(6);
    let regions = [
        crate::Region2::rectangle([-0.5, -0.25], [1.25, 1.0]).expect("a box"),
        crate::Region2::polygon(&[vec![[0.0, 0.0], [1.0, 0.1], [0.4, 0.4], [0.2, 1.2]]]).expect("a polygon"),
    ];
    for round in 0..40 {
        let region = &regions[round % 2];
        let count = 1 + random.below(40);
        let all: Vec<Site> =
            (0..count).map(|_| ([random.unit(), random.unit()], (random.unit() - 0.5) / 8.0)).collect();
        let r = Regular2::from_sites(&all).expect("finite");
        let jacobian = r.power().jacobian(region);
        let sum: f64 = jacobian.areas.iter().sum();
        assert!((sum - region.area()).abs() < 1e-12, "round {round}: {sum} of {}", region.area());
        assert!(r.hidden().all(|v| jacobian.areas[v.index()] == 0.0));
        for i in 0..count.min(5) {
            // The difference of areas that a small change makes; where the triangulation stays, it is what the Jacobian says up
            // to the second order.
            let step = 1e-7;
            let mut moved = all.clone();
            moved[i].1 += step;
            let after = Regular2::from_sites(&moved).expect("finite").power().jacobian(region);
            for j in 0..count {
                let pair = [i.min(j), i.max(j)].map(VertexId::new);
                let of_pair = |(ends, value): &([VertexId; 2], f64)| if *ends == pair { *value } else { 0.0 };
                let expected: f64 = if i == j {
                    let own = |([v, w], value): &([VertexId; 2], f64)| {
                        if v.index() == i || w.index() == i { -value } else { 0.0 }
                    };
                    jacobian.derivatives.iter().map(own).sum()
                } else {
                    jacobian.derivatives.iter().map(of_pair).sum()
                };
                let found = (after.areas[j] - jacobian.areas[j]) / step;
                assert!((found - expected).abs() < 1e-3, "round {round}, {i} {j}: {found}, not {expected}");
            }
        }
        let cells = r.power().clip(region);
        for v in r.vertices() {
            let (site, rings) = (r.site(v).expect("a site"), cells.rings(v));
            if let Some(centre) = cells.centroid(v).filter(|_| region.rings().count() == 1 && round % 2 == 0)
            {
                let nearest = r.nearest(centre).expect("finite").expect("one");
                assert!(
                    nearest == v || cells.area(v) < 1e-12,
                    "round {round} {v:?} {site:?} {}",
                    rings.count()
                );
            }
        }
    }
}

/// Four sites at the corners of a lattice's cell meet in one point, and the whole is a square's.
#[test]
fn second_moments_are_integrals() {
    let sites: Vec<Site> = (0..9).map(|i| ([f64::from(i % 3), f64::from(i / 3)], 1.0)).collect();
    let r = Regular2::from_sites(&sites).expect("finite");
    let cells = r.power().clip(&crate::Region2::rectangle([-0.5, -0.5], [2.5, 2.5]).expect("a box"));
    for v in r.vertices() {
        assert_eq!(cells.area(v), 1.0);
        let moment = cells.second_moment(v, sites[v.index()].0);
        assert!((moment - 1.0 / 6.0).abs() < 1e-15, "{moment}");
    }
}

#[test]
fn the_nearest_site_has_the_least_power() {
    use delone_predicates::compare_powers;
    let mut random = Random::new(3);
    for _ in 0..200 {
        let count = 1 + random.below(40);
        let all = sites(&mut random, count);
        let r = Regular2::from_sites(&all).expect("finite");
        for _ in 0..10 {
            let q = [random.below(9) as f64 / 2.0, random.between(-1.0, 4.0)];
            let v = r.nearest(q).expect("finite").expect("a site");
            let found = r.site(v).expect("alive");
            assert!(all.iter().all(|&site| compare_powers(q, found, site).is_le()), "{all:?} {q:?}");
        }
    }
    assert_eq!(Regular2::new().nearest([0.0, 0.0]), Ok(None));
}
