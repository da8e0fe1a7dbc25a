//! Power cells: they tile, hold what is nearest to them, and change as their Jacobian says.

use delone::{Error, Region2, Regular2, VertexId};
use delone_generators::Random;

type Site = ([f64; 2], f64);

/// Cells tile, hold what is nearest to them, and change as their Jacobian says.
#[test]
fn power_cells_tile_and_change_as_their_jacobian_says() {
    let mut random = Random::new(6);
    let regions = [
        Region2::rectangle([-0.5, -0.25], [1.25, 1.0]).expect("a box"),
        Region2::polygon(&[vec![[0.0, 0.0], [1.0, 0.1], [0.4, 0.4], [0.2, 1.2]]]).expect("a polygon"),
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
            if let Some(center) = cells.centroid(v).filter(|_| region.rings().count() == 1 && round % 2 == 0)
            {
                let nearest = r.nearest(center).expect("finite").expect("one");
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
    let cells = r.power().clip(&Region2::rectangle([-0.5, -0.5], [2.5, 2.5]).expect("a box"));
    for v in r.vertices() {
        assert_eq!(cells.area(v), 1.0);
        let moment = cells.second_moment(v, sites[v.index()].0);
        assert!((moment - 1.0 / 6.0).abs() < 1e-15, "{moment}");
    }
}

/// Any shares, in a box and in a polygon with a notch, come out as near as rounding allows.
#[test]
fn prescribed_areas_come_out() {
    let mut random = Random::new(7);
    let regions = [
        Region2::rectangle([0.0, 0.0], [1.0, 1.0]).expect("a box"),
        Region2::polygon(&[vec![[-0.1, -0.1], [1.1, -0.2], [0.6, 0.5], [1.2, 1.1], [-0.2, 1.3]]])
            .expect("one"),
    ];
    for round in 0..30 {
        let count = 1 + random.below(60);
        let region = &regions[round % 2];
        let points: Vec<[f64; 2]> = (0..count).map(|_| [random.unit() / 2.0, random.unit()]).collect();
        let shares: Vec<f64> = (0..count).map(|_| 0.1 + random.unit()).collect();
        let (r, found) = Regular2::with_areas(&points, &shares, region, 1e-9).expect("cells");
        assert!(found.error <= 1e-9, "round {round}: {found:?}");
        assert!(found.steps < 40, "round {round}: {found:?}");
        r.check().expect("regular");
        let cells = r.power().clip(region);
        let whole: f64 = shares.iter().sum();
        for (i, share) in shares.iter().enumerate() {
            let area = cells.area(VertexId::new(i));
            assert!((area / region.area() - share / whole).abs() < 1e-9, "round {round}, {i}: {area}");
        }
    }
    let square = &regions[0];
    let prescribe = |points: &[[f64; 2]], shares: &[f64]| Regular2::with_areas(points, shares, square, 1e-9);
    assert_eq!(prescribe(&[[0.5, 0.5], [0.5, 0.5]], &[1.0, 1.0]).unwrap_err(), Error::NoCell { site: 1 });
    assert_eq!(prescribe(&[[0.5, 0.5], [9.0, 0.5]], &[1.0, 1.0]).unwrap_err(), Error::NoCell { site: 1 });
    assert_eq!(prescribe(&[[0.5, 0.5]], &[0.0]).unwrap_err(), Error::Area { index: 0, value: 0.0 });
    // At every scale there is an end, and areas that are no numbers are refused.
    for scale in [1e-160, 1e-130, 1e-82, 1e80, 1e140, 1e152, 1e160] {
        let at = |p: [f64; 2]| p.map(|x| x * scale);
        let points = [[0.1, 0.1], [0.2, 0.9], [0.7, 0.4]].map(at);
        let region = Region2::rectangle([0.0, 0.0], at([1.0, 1.0])).expect("a box");
        match Regular2::with_areas(&points, &[1.0, 2.0, 3.0], &region, 1e-9) {
            Ok((_, found)) => assert!(found.error <= 1e-9 && scale > 1e-140 && scale < 1e151, "{scale:e}"),
            Err(error) => assert!(matches!(error, Error::Parameter { .. }), "{scale:e}: {error}"),
        }
    }
    assert!(matches!(prescribe(&[[0.5, 0.5]], &[1.0, 1.0]), Err(Error::Length { .. })));
    assert_eq!(prescribe(&[], &[]).expect("nothing").1.steps, 0);
}
