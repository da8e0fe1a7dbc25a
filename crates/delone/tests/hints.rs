//! Imprecise points: every instance is what it is without hints, and walks are as short as the paper says.

use delone::{Delaunay2, Error, HintOrder, Hints2, Work};
use delone_oracle::brute;
use delone_oracle::generate::{Kind, Random};

const ORDERS: [HintOrder; 2] = [HintOrder::Random { seed: 3 }, HintOrder::Spatial { seed: 4 }];

fn triangles(d: &Delaunay2) -> Vec<[[f64; 2]; 3]> {
    brute::normalized(d.triangles().map(|corners| corners.map(|v| d.point(v))))
}

fn same(d: &Delaunay2, points: &[[f64; 2]], what: &str) {
    assert_eq!(d.check(), Ok(()), "{what}");
    let fresh = Delaunay2::from_points(points).expect("finite");
    assert!(triangles(d) == triangles(&fresh), "{what}");
    assert!(d.duplicates().eq(fresh.duplicates()), "{what}");
    assert_eq!(d.points(), points, "{what}");
}

#[test]
fn every_instance_is_the_canonical_triangulation() {
    for &kind in Kind::ALL {
        for order in ORDERS {
            let centres = kind.points(300, 1);
            let mut hints = Hints2::preprocess(&centres, order).expect("finite");
            let mut random = Random::new(7);
            for round in 0..6 {
                let instance: Vec<[f64; 2]> = match round {
                    0 => centres.clone(),
                    1 => centres.iter().map(|p| p.map(|x| x + random.between(-0.5, 0.5))).collect(),
                    // Anywhere, all in one place, on a line, and apart again.
                    2 => kind.points(300, 99),
                    3 => vec![[2.0, 3.0]; 300],
                    4 => (0..300).map(|i| [f64::from(i % 50), 1.0]).collect(),
                    _ => centres.iter().rev().copied().collect(),
                };
                let what = format!("{} {order:?} {round}", kind.name());
                if round % 2 == 0 {
                    same(hints.triangulate(&instance).expect("finite"), &instance, &what);
                } else {
                    same(hints.follow(&instance).expect("finite"), &instance, &what);
                }
            }
        }
    }
}

#[test]
fn bad_instances_leave_the_last_one() {
    let centres = Kind::Uniform.points(50, 1);
    let mut hints = Hints2::preprocess(&centres, HintOrder::default()).expect("finite");
    hints.triangulate(&centres).expect("finite");
    let before = triangles(hints.current());
    let error = hints.triangulate(&centres[1..]).err();
    assert_eq!(error, Some(Error::Length { expected: 50, found: 49 }));
    let mut bad = centres.clone();
    bad[7][1] = f64::NAN;
    let error = hints.triangulate(&bad).err().map(|error| error.to_string());
    assert_eq!(error.as_deref(), Some("point 7 has the y coordinate NaN, which is not finite"));
    assert!(triangles(hints.current()) == before);
    bad[7][1] = f64::INFINITY;
    assert!(Hints2::preprocess(&bad, HintOrder::default()).is_err());
    let mut none = Hints2::preprocess::<[f64; 2]>(&[], HintOrder::default()).expect("finite");
    assert_eq!(none.triangulate::<[f64; 2]>(&[]).expect("finite").vertex_count(), 0);
}

#[test]
fn walks_are_as_short_as_in_the_paper() {
    // §5: 2.8 triangles visited a point for disjoint unit disks, whatever their number and the order.
    for order in ORDERS {
        for n in [1_000, 10_000, 100_000] {
            let centres = Kind::Disks.points(n, 5);
            let mut hints = Hints2::preprocess(&centres, order).expect("finite");
            let mut random = Random::new(9);
            let instance: Vec<[f64; 2]> = centres
                .iter()
                .map(|&[x, y]| {
                    loop {
                        let (u, v) = (random.between(-1.0, 1.0), random.between(-1.0, 1.0));
                        if u * u + v * v <= 1.0 {
                            break [x + u, y + v];
                        }
                    }
                })
                .collect();
            let mut work = Work::default();
            hints.triangulate_counted(&instance, &mut work).expect("finite");
            let visited = work.visited as f64 / n as f64;
            // In spatial order the triangle where a walk starts is one of the last made, and a better one.
            let expected = if matches!(order, HintOrder::Random { .. }) { 2.65..2.95 } else { 2.4..2.7 };
            assert!(expected.contains(&visited), "{order:?} {n}: {visited}");
        }
    }
}
