//! Voronoi diagrams of higher order against their definition, the engine and the furthest sites.

use std::collections::BTreeSet;

use delone::{Delaunay2, Error, OrderK2, Region2, VertexId, Voronoi2};
use delone_generators::{Kind, Random};

use delone_oracle::orders::Circles;

type Sites = Vec<usize>;

fn indices(sites: impl IntoIterator<Item = VertexId>) -> Sites {
    sites.into_iter().map(VertexId::index).collect()
}

/// Everything that can be asked about the combinatorics of a diagram is what it should be.
fn is_sound(order: &OrderK2, context: &str) {
    let k = order.order();
    let mut last: Option<Sites> = None;
    for region in order.regions() {
        let sites = indices(region.sites().iter().copied());
        assert!(sites.len() == k && sites.is_sorted_by(|a, b| a < b), "{context} {sites:?}");
        assert!(last.as_ref().is_none_or(|last| *last < sites), "{context} {sites:?}");
        assert_eq!(
            order.region(region.sites()).map(|found| found.index()),
            Some(region.index()),
            "{context}"
        );
        for (exchange, beyond) in region.sides() {
            let mut other = region.sites().to_vec();
            other.retain(|&v| v != exchange.lost);
            assert!(other.len() + 1 == k && !other.contains(&exchange.gained), "{context}");
            other.push(exchange.gained);
            other.sort_unstable();
            assert_eq!(beyond.sites(), other, "{context} {sites:?}");
            let back = beyond.sides().any(|(back, own)| {
                own.index() == region.index() && back.lost == exchange.gained && back.gained == exchange.lost
            });
            assert!(back, "{context} {sites:?}");
        }
        for circle in region.circles() {
            assert!(circle.regions().iter().any(|around| around.index() == region.index()), "{context}");
        }
        // As many corners as sides around a bounded region.
        let (corners, sides) = (region.circles().count(), region.sides().count());
        assert!(!region.is_bounded() || corners == sides && corners > 1, "{context} {sites:?}");
        last = Some(sites);
    }
}

/// All orders of some distinct points, by the definition.
fn all_orders(points: &[[f64; 2]], most: usize, context: &str) {
    let d = Delaunay2::from_points(points).expect("finite");
    let circles = Circles::new(points);
    for k in 1..points.len().min(most + 1) {
        let context = format!("{context} order {k} of {points:?}");
        let order = d.order(k).expect("an order");
        is_sound(&order, &context);
        let expected = circles.order(k);
        let regions = order.regions().map(|region| indices(region.sites().iter().copied()));
        assert!(regions.eq(expected.regions.iter().cloned()), "{context}");
        let unbounded = order.regions().filter(|region| !region.is_bounded());
        let unbounded = unbounded.map(|region| indices(region.sites().iter().copied()));
        assert!(unbounded.eq(expected.unbounded.iter().cloned()), "{context}");
        let found: Vec<(Sites, [usize; 3])> = order
            .circles()
            .map(|circle| {
                let mut on = circle.on().map(VertexId::index);
                on.sort_unstable();
                (indices(circle.inside()), on)
            })
            .collect();
        assert_eq!(found.len(), expected.circles.len(), "{context}");
        assert_eq!(BTreeSet::from_iter(found), expected.circles, "{context}");
    }
}

fn distinct(points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for p in points {
        if !kept.contains(&p) {
            kept.push(p);
        }
    }
    kept
}

#[test]
fn all_orders_are_as_defined() {
    for &kind in Kind::ALL {
        for n in [1, 2, 3, 4, 5, 9, 13] {
            all_orders(&distinct(kind.points(n, 7)), n, &format!("{kind:?}"));
        }
    }
}

/// Lattices: circles through many points, lines through many, and nothing but ties.
#[test]
fn ties_are_as_defined() {
    let mut random = Random::new(11);
    for round in 0..400 {
        let side = 3 + round % 3;
        let count = 3 + random.below(8);
        let points: Vec<[f64; 2]> =
            (0..count).map(|_| [random.below(side) as f64, random.below(side) as f64]).collect();
        all_orders(&distinct(points), count, "a lattice");
    }
}

/// Regions with many neighbors, whose polygons are triangulated otherwise: the hub of a wheel, a point beside a line.
#[test]
fn large_regions_are_as_defined() {
    let rim = |n: u32| (0..n).map(move |i| std::f64::consts::TAU * f64::from(i) / f64::from(n));
    let mut wheel: Vec<[f64; 2]> = rim(36).map(|a| [a.cos(), a.sin()]).collect();
    wheel.push([0.1, 0.0]);
    all_orders(&wheel, 4, "a wheel");
    let integers = (-65..=65).flat_map(|x| (-65..=65).map(move |y| [f64::from(x), f64::from(y)]));
    let mut circle: Vec<[f64; 2]> = integers.filter(|p| p[0] * p[0] + p[1] * p[1] == 4225.0).collect();
    assert!(circle.len() > 30, "on one circle exactly");
    circle.push([0.0, 1.0]);
    all_orders(&circle, 3, "a circle");
    let mut line: Vec<[f64; 2]> = (0..34).map(|i| [f64::from(i), 0.0]).collect();
    line.push([4.0, 3.0]);
    all_orders(&line, 3, "a line and a point above");
    line.push([9.0, -2.0]);
    all_orders(&line, 3, "a line and points on both sides");
}

#[test]
fn few_points_and_bad_orders() {
    let range = "at least 1 and at most the number of vertices";
    let refused = |k: usize| Err(Error::Parameter { name: "the order", value: k as f64, range });
    for n in 0..5 {
        let points: Vec<[f64; 2]> = Kind::Uniform.points(n, 3);
        let d = Delaunay2::from_points(&points).expect("finite");
        for k in [0, n + 1, usize::MAX] {
            assert_eq!(d.order(k).map(|_| ()), refused(k), "{n} {k}");
        }
        if n > 0 {
            // All sites are nearest everywhere.
            let all = d.order(n).expect("an order");
            assert_eq!((all.region_count(), all.circles().count()), (1, 0));
            let region = all.locate([9.0, 9.0]).expect("finite");
            assert!(!region.is_bounded() && region.sites().len() == n && region.sides().next().is_none());
            let cells = all.cells(&Region2::rectangle([0.0, 0.0], [2.0, 3.0]).expect("a box"));
            assert_eq!(cells.area(region), 6.0);
        }
    }
    let d = Delaunay2::from_points(&[[0.0, 0.0], [1.0, 0.0]]).expect("finite");
    assert!(matches!(d.order(1).expect("an order").locate([f64::NAN, 0.0]), Err(Error::Coordinate { .. })));
}

/// Runs along a line, given in any order.
#[test]
fn collinear_sites_have_runs() {
    let along = [3.0, 0.0, 7.0, 1.0, 12.0, 5.0];
    for points in [along.map(|x| [x, 2.0 * x]), along.map(|x| [0.0, x])] {
        all_orders(&points, 6, "a line");
        let d = Delaunay2::from_points(&points).expect("finite");
        let order = d.order(3).expect("an order");
        let cells = order.cells(&Region2::rectangle([-5.0, -5.0], [9.0, 30.0]).expect("a box"));
        let area: f64 = order.regions().map(|region| cells.area(region)).sum();
        assert!((area - 14.0 * 35.0).abs() < 1e-9);
    }
}

/// Order 1 is the engine's diagram, and order n - 1 that of the furthest site.
#[test]
fn the_first_and_the_last_order_are_known() {
    for &kind in Kind::ALL {
        let points = kind.points(40, 3);
        let d = Delaunay2::from_points(&points).expect("finite");
        let n = d.vertex_count();
        if n < 3 {
            continue;
        }
        let first = d.order(1).expect("an order");
        assert!(first.regions().map(|region| region.sites()[0]).eq(d.vertices()), "{kind:?}");
        for region in first.regions() {
            let site = region.sites()[0];
            let sides: BTreeSet<VertexId> = region.sides().map(|(side, _)| side.gained).collect();
            assert_eq!(sides, d.neighbors(site).collect(), "{kind:?}");
            assert_eq!(region.is_bounded(), d.voronoi().is_bounded(site), "{kind:?}");
        }
        let last = d.order(n - 1).expect("an order");
        let missing = |sites: &[VertexId]| d.vertices().find(|v| !sites.contains(v)).expect("one is missing");
        let furthest = d.furthest();
        let corners: BTreeSet<VertexId> = furthest.corners().iter().copied().collect();
        assert!(last.regions().all(|region| !region.is_bounded()), "{kind:?}");
        let found: BTreeSet<VertexId> = last.regions().map(|region| missing(region.sites())).collect();
        // Points on a side of the hull are furthest nowhere but by the perturbation.
        assert!(found.is_superset(&corners), "{kind:?}");
        if found == corners {
            let mut edges: BTreeSet<[VertexId; 2]> = BTreeSet::new();
            for region in last.regions() {
                edges.extend(region.sides().map(|(side, _)| [side.lost, side.gained]));
            }
            let expected = furthest.edges().flat_map(|([v, w], _)| [[v, w], [w, v]]).collect();
            assert_eq!(edges, expected, "{kind:?}");
        }
    }
}

/// The number of regions is a function of the numbers of unbounded ones (Lee 1982), ties or not.
#[test]
fn regions_are_as_many_as_proved() {
    for &kind in Kind::ALL {
        let d = Delaunay2::from_points(&kind.points(700, 5)).expect("finite");
        let n = d.vertex_count();
        if d.triangle_count() == 0 {
            continue;
        }
        let mut unbounded = 0;
        for k in 1..=6 {
            let order = d.order(k).expect("an order");
            is_sound(&order, &format!("{kind:?} {k}"));
            assert_eq!(order.region_count() + k * k - 1 + unbounded, (2 * k - 1) * n, "{kind:?} {k}");
            unbounded += order.regions().filter(|region| !region.is_bounded()).count();
        }
    }
}

/// A point is in the region of its k nearest sites, on the borders of regions too.
#[test]
fn points_are_in_the_region_of_their_nearest() {
    for kind in [Kind::Uniform, Kind::Grid, Kind::Circle, Kind::Clusters, Kind::Line] {
        let points = kind.points(150, 9);
        let d = Delaunay2::from_points(&points).expect("finite");
        for k in [1, 2, 3, 5, 8] {
            let order = d.order(k).expect("an order");
            let between = points.windows(3).flat_map(|p| {
                let middle = [p[0][0] / 2.0 + p[1][0] / 2.0, p[0][1] / 2.0 + p[1][1] / 2.0];
                let center = delone_predicates::circumcenter(p[0], p[1], p[2]);
                [Some(p[0]), Some(middle), center]
            });
            for q in between.flatten().chain(Kind::Uniform.points(100, 4)) {
                let mut nearest = d.k_nearest(q, k).expect("finite");
                nearest.sort_unstable();
                assert_eq!(order.locate(q).expect("finite").sites(), nearest, "{kind:?} {k} {q:?}");
            }
        }
    }
}

/// Clipped regions tile, and each is where its sites are nearest.
#[test]
fn regions_tile_and_are_in_their_places() {
    let l = [[-0.2, -0.1], [1.1, -0.1], [1.1, 0.4], [0.5, 0.4], [0.5, 1.2], [-0.2, 1.2]].to_vec();
    let regions = [
        Region2::rectangle([-0.5, -0.5], [1.5, 1.5]).expect("a box"),
        Region2::rectangle([0.2, 0.3], [0.6, 0.5]).expect("a box"),
        Region2::polygon(&[l]).expect("a polygon"),
    ];
    for kind in [Kind::Uniform, Kind::Grid, Kind::Circle, Kind::Clusters, Kind::Line] {
        for n in [5, 120] {
            let d = Delaunay2::from_points(&kind.points(n, 2)).expect("finite");
            for k in (1..=4).filter(|&k| k <= d.vertex_count()) {
                let order = d.order(k).expect("an order");
                for (i, region) in regions.iter().enumerate() {
                    let cells = order.cells(region);
                    let area: f64 = order.regions().map(|own| cells.area(own)).sum();
                    assert!((area - region.area()).abs() < 1e-9 * region.area(), "{kind:?} {n} {k} {i}");
                    for own in order.regions().filter(|&own| cells.area(own) > 1e-9 && i < 2) {
                        let center = cells.centroid(own).expect("an area");
                        let found = order.locate(center).expect("finite");
                        assert_eq!(found.index(), own.index(), "{kind:?} {n} {k} {i}");
                    }
                }
            }
        }
    }
    // Order 1 cells are the plain ones, to the bit.
    let d = Delaunay2::from_points(&Kind::Uniform.points(300, 2)).expect("finite");
    let (order, plain) = (d.order(1).expect("an order"), Voronoi2::clip(d.voronoi(), &regions[0]));
    let cells = order.cells(&regions[0]);
    for own in order.regions() {
        let set = |ring: delone::Ring| ring.points().map(|p| p.map(f64::to_bits)).collect::<BTreeSet<_>>();
        let found: Vec<_> = cells.rings(own).map(set).collect();
        assert_eq!(found, plain.rings(own.sites()[0]).map(set).collect::<Vec<_>>());
    }
}

/// Where the sites of each region and circle are, sorted: what must not depend on how they were given.
fn places(order: &OrderK2) -> BTreeSet<Vec<[u64; 2]>> {
    let at = |v: VertexId| order.triangulation().point(v).map(f64::to_bits);
    let sorted = |mut places: Vec<[u64; 2]>| {
        places.sort_unstable();
        places
    };
    let regions = order.regions().map(|region| sorted(region.sites().iter().map(|&v| at(v)).collect()));
    let circles = order.circles().map(|circle| {
        let inside = sorted(circle.inside().map(at).collect());
        [sorted(circle.on().map(at).to_vec()), inside].concat()
    });
    regions.chain(circles).collect()
}

/// Neither the order of the sites nor what was there before shows, nor do duplicates.
#[test]
fn how_it_was_made_does_not_show() {
    for kind in [Kind::Uniform, Kind::Grid, Kind::Circle, Kind::Line] {
        let points = distinct(kind.points(60, 1));
        let d = Delaunay2::from_points(&points).expect("finite");
        let reversed: Vec<[f64; 2]> = points.iter().rev().chain(points.iter().skip(9)).copied().collect();
        let reversed = Delaunay2::from_points(&reversed).expect("finite");
        let mut changed = Delaunay2::new();
        let extra: Vec<VertexId> = (0..40)
            .map(|i| {
                changed
                    .insert([f64::from(i) * 0.037 + 0.01, 3.3 - f64::from(i * i)])
                    .expect("finite")
                    .vertex()
            })
            .collect();
        for &p in &points {
            changed.insert(p).expect("finite");
        }
        for v in extra {
            changed.remove(v).expect("a vertex");
        }
        for k in [1, 2, 3, 6] {
            let order = d.order(k).expect("an order");
            for other in [&reversed, &changed] {
                let other = other.order(k).expect("an order");
                is_sound(&other, &format!("{kind:?} {k}"));
                assert_eq!(places(&order), places(&other), "{kind:?} {k}");
            }
        }
    }
}
