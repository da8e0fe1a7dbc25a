//! Voronoi cells against their definition: what is nearest to a site; and clipped cells tile.

use delone::{Cells2, Delaunay2, Error, Region2, RegionProblem, Relaxation2, VertexId, VoronoiEdge2};
use delone_generators::{Kind, Random};
use delone_oracle::all_cases;

/// A rectangle that holds most of the points, one that cuts through, and polygons, all scaled to the points.
fn regions(d: &Delaunay2) -> Vec<(&'static str, Region2)> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in d.points() {
        for axis in 0..2 {
            low[axis] = low[axis].min(p[axis]);
            high[axis] = high[axis].max(p[axis]);
        }
    }
    let size = (high[0] - low[0]).max(high[1] - low[1]).max(1e-3);
    let at = |x: f64, y: f64| [low[0] + x * size, low[1] + y * size];
    let star: Vec<[f64; 2]> = (0..400)
        .map(|i| {
            let (angle, radius) =
                (f64::from(i) * std::f64::consts::TAU / 400.0, if i % 2 == 0 { 0.7 } else { 0.3 });
            at(0.5 + radius * angle.cos(), 0.5 + radius * angle.sin())
        })
        .collect();
    let ring = |low: f64, high: f64| vec![at(low, low), at(high, low), at(high, high), at(low, high)];
    // Sets that span the whole range of f64 leave no room for some of these.
    let regions = [
        ("around", Region2::rectangle(at(-0.5, -0.25), at(1.5, 1.75))),
        ("through", Region2::rectangle(at(0.31, 0.17), at(0.72, 1.4))),
        ("away", Region2::rectangle(at(7.0, 8.0), at(9.0, 9.0))),
        ("star", Region2::polygon(&[star])),
        ("frame", Region2::polygon(&[ring(0.0, 1.0), ring(0.2, 0.8), ring(0.4, 0.6)])),
        ("hull", Region2::hull(d)),
    ];
    regions.into_iter().filter_map(|(name, region)| Some((name, region.ok()?))).collect()
}

#[test]
fn clipped_cells_tile_the_region() {
    let mut checked = 0;
    for &kind in Kind::ALL {
        for n in [1, 2, 3, 7, 50, if all_cases() { 600 } else { 200 }] {
            let d = Delaunay2::from_points(&kind.points(n, 3)).expect("finite");
            for (name, region) in regions(&d) {
                let cells = d.voronoi().clip(&region);
                let sum: f64 = d.vertices().map(|v| cells.area(v)).sum();
                // The hull of points near a line has an area of nothing but rounding.
                let [low, high] = region.bounds();
                let size = region.area().max(1e-3 * (high[0] - low[0]).max(high[1] - low[1]).powi(2));
                // Areas beyond the range of f64.
                if !(1e-200..1e200).contains(&size) {
                    continue;
                }
                checked += 1;
                // A corner on a side is rounded off it by as much as its coordinates are.
                let largest = region.bounds().as_flattened().iter().fold(0.0_f64, |max, x| max.max(x.abs()));
                let rounding = largest * f64::EPSILON / size.sqrt();
                let error = (sum - region.area()).abs() / size;
                assert!(
                    error <= 1e-12 + 4.0 * rounding,
                    "{kind:?} {n} {name}: {sum} of {}, {error:e}",
                    region.area()
                );
                assert!(
                    d.vertices().all(|v| cells.area(v) >= -(1e-13 + rounding) * size),
                    "{kind:?} {n} {name}"
                );
            }
        }
    }
    assert!(checked > 500, "only {checked} sets have areas");
}

/// The cell as an intersection with all bisectors, by the plainest code.
fn brute_area(points: &[[f64; 2]], site: usize, [low, high]: [[f64; 2]; 2]) -> f64 {
    let mut ring = vec![low, [high[0], low[1]], high, [low[0], high[1]]];
    for other in points.iter().filter(|&&p| p != points[site]) {
        let value = |p: [f64; 2]| {
            let square = |q: [f64; 2]| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2);
            square(*other) - square(points[site])
        };
        let mut cut = Vec::new();
        for (i, &p) in ring.iter().enumerate() {
            let q = ring[(i + 1) % ring.len()];
            let (at_p, at_q) = (value(p), value(q));
            if at_p >= 0.0 {
                cut.push(p);
            }
            if (at_p >= 0.0) != (at_q >= 0.0) {
                let t = at_p / (at_p - at_q);
                cut.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
            }
        }
        ring = cut;
    }
    area(&ring)
}

#[test]
fn cells_are_what_is_nearest() {
    for kind in [Kind::Uniform, Kind::Grid, Kind::Circle, Kind::Line, Kind::Clusters, Kind::Duplicates] {
        for n in [1, 2, 5, 60] {
            let points = kind.points(n, 5);
            let d = Delaunay2::from_points(&points).expect("finite");
            for (name, region) in regions(&d).into_iter().take(3) {
                let cells = d.voronoi().clip(&region);
                for v in d.vertices() {
                    let expected = brute_area(&points, v.index(), region.bounds());
                    let error = (cells.area(v) - expected).abs() / region.area();
                    assert!(error < 1e-9, "{kind:?} {n} {name} {v:?}: {} not {expected}", cells.area(v));
                    let alone: f64 = d.voronoi().cell(v, &region).iter().map(|ring| area(ring)).sum();
                    assert!((alone - cells.area(v)).abs() <= 1e-12 * region.area());
                }
            }
        }
    }
}

fn area(ring: &[[f64; 2]]) -> f64 {
    let Some(&[x, y]) = ring.first() else { return 0.0 };
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(p, q)| (p[0] - x) * (q[1] - y) - (p[1] - y) * (q[0] - x)).sum::<f64>() / 2.0
}

#[test]
fn cells_of_a_grid_merge_their_corners() {
    let points: Vec<[f64; 2]> = (0..100).map(|i| [f64::from(i % 10), f64::from(i / 10)]).collect();
    let d = Delaunay2::from_points(&points).expect("finite");
    let voronoi = d.voronoi();
    for v in d.vertices() {
        let on_border = |i: usize| usize::from(i.is_multiple_of(9));
        let borders = on_border(v.index() % 10) + on_border(v.index() / 10);
        assert_eq!(voronoi.is_bounded(v), borders == 0);
        assert_eq!(voronoi.neighbors(v).count(), 4 - borders);
        let corners = [4, 2, 1][borders];
        assert_eq!(voronoi.corners(v).count(), corners);
    }
}

#[test]
fn low_dimensions_have_cells() {
    let unit = Region2::rectangle([-1.0, -1.0], [3.0, 1.0]).expect("a rectangle");
    let none = Delaunay2::new();
    assert_eq!(none.voronoi().edges().count(), 0);
    assert!(std::ptr::eq(none.voronoi().triangulation(), &raw const none));
    assert_eq!(none.voronoi().clip(&unit).rings(VertexId::new(0)).count(), 0);
    assert_eq!(Cells2::default().rings(VertexId::new(0)).count(), 0);
    let one = Delaunay2::from_points(&[[0.0, 0.0]]).expect("finite");
    assert_eq!(one.voronoi().clip(&unit).area(VertexId::new(0)), 8.0);
    let line = Delaunay2::from_points(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]).expect("finite");
    assert!(line.voronoi().edges().all(|e| matches!(e, VoronoiEdge2::Line { .. })));
    let cells = line.voronoi().clip(&unit);
    assert_eq!([0, 1, 2].map(|i| cells.area(VertexId::new(i))), [3.0, 2.0, 3.0]);
    assert!(Region2::hull(&line).is_err());
}

#[test]
fn the_view_follows_changes() {
    let mut d = Delaunay2::from_points(&Kind::Uniform.points(500, 1)).expect("finite");
    let region = Region2::rectangle([0.0, 0.0], [1.0, 1.0]).expect("a rectangle");
    for i in 0..200 {
        d.remove(VertexId::new(2 * i)).expect("a vertex");
        d.move_to(VertexId::new(2 * i + 1), [i as f64 / 200.0, 0.25]).expect("free");
    }
    for p in Kind::Uniform.points(300, 2) {
        d.insert(p).expect("finite");
    }
    let left: Vec<VertexId> = d.vertices().collect();
    let points: Vec<[f64; 2]> = left.iter().map(|&v| d.point(v)).collect();
    let anew = Delaunay2::from_points(&points).expect("finite");
    let (cells, expected) = (d.voronoi().clip(&region), anew.voronoi().clip(&region));
    for (v, w) in left.iter().zip(anew.vertices()) {
        assert!((cells.area(*v) - expected.area(w)).abs() < 1e-15);
    }
    assert_eq!(cells.rings(VertexId::new(0)).count(), 0);
}

#[test]
fn bad_regions_are_named() {
    let problem = |rings: &[Vec<[f64; 2]>]| match Region2::polygon(rings) {
        Err(Error::Region { ring, corner, problem }) => Some((ring, corner, problem)),
        _ => None,
    };
    let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    assert_eq!(problem(&[]), Some((0, 0, RegionProblem::Empty)));
    assert_eq!(problem(&[square[..2].to_vec()]), Some((0, 0, RegionProblem::Empty)));
    assert_eq!(problem(&[vec![[1.0, f64::INFINITY]]]), Some((0, 0, RegionProblem::NotFinite)));
    assert!(matches!(
        problem(&[vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]]),
        Some((.., RegionProblem::Crossing))
    ));
    let not_a_number = vec![[0.0, 0.0], [f64::NAN, 0.0], [2.0, 1.0]];
    assert_eq!(problem(&[square.clone(), not_a_number]), Some((1, 1, RegionProblem::NotFinite)));
    let eight = vec![[0.0, 0.0], [1.0, 1.0], [2.0, 0.0], [2.0, 2.0], [1.0, 1.0], [0.0, 2.0]];
    assert_eq!(problem(&[eight]), Some((0, 4, RegionProblem::VisitedTwice)));
    let across = vec![[0.5, 0.5], [2.0, 0.5], [2.0, 0.75]];
    assert!(matches!(problem(&[square.clone(), across]), Some((.., RegionProblem::Crossing))));
    assert_eq!(problem(&[square.clone(), square.clone()]).map(|p| p.2), Some(RegionProblem::Crossing));
    // Closed explicitly, and the other way round.
    let mut closed = square.clone();
    closed.push(square[0]);
    closed.reverse();
    assert_eq!(Region2::polygon(&[closed]).map(|region| region.area()), Ok(1.0));
}

#[test]
fn relaxation_evens_out() {
    let d = Delaunay2::from_points(&Kind::Uniform.points(400, 1)).expect("finite");
    let region = Region2::rectangle([0.0, 0.0], [1.0, 1.0]).expect("a rectangle");
    let spread = |d: &Delaunay2| {
        let cells = d.voronoi().clip(&region);
        let areas: Vec<f64> = d.vertices().map(|v| cells.area(v)).collect();
        areas.iter().fold(0.0, |max: f64, a| max.max(*a)) / areas.iter().fold(1.0, |min: f64, a| min.min(*a))
    };
    let mut moves = Vec::new();
    let relaxed = Relaxation2::default()
        .steps(30)
        .tolerance(0.0)
        .run(&d, &region, |_, moved| moves.push(moved))
        .expect("fine");
    let relaxed = Delaunay2::from_points(&relaxed).expect("finite");
    assert!(spread(&relaxed) < 3.0 && spread(&d) > 10.0, "{} {}", spread(&relaxed), spread(&d));
    assert!(moves.len() == 30 && moves[29] < moves[0] / 4.0);
    // Of one site, to the middle.
    let one = Delaunay2::from_points(&[[0.25, 0.125]]).expect("finite");
    let middle = Relaxation2::default()
        .steps(1)
        .tolerance(0.0)
        .run(&one, &region, |_, moved| assert_eq!(moved, 0.25_f64.hypot(0.375)))
        .expect("fine");
    assert_eq!(middle, [[0.5, 0.5]]);
    assert!(Relaxation2::default().steps(1).tolerance(-1.0).run(&d, &region, |_, _| {}).is_err());
}

/// Each from both of its sides: what is unbounded goes away from the site that is on the other side, at a right angle.
#[test]
fn edges_go_between_their_sites() {
    let sites = [[1.0, 2.0], [5.0, 4.0], [2.0, 7.0]];
    let d = Delaunay2::from_points(&sites).expect("finite");
    let center = d.voronoi().vertices().next().flatten().expect("a triangle");
    for e in d.mesh().undirected_edges().flat_map(|e| [e, d.mesh().twin(e)]) {
        let [a, b] = d.segment(e);
        let apart = [b[0] - a[0], b[1] - a[1]];
        let third = sites.iter().find(|p| **p != a && **p != b).expect("three");
        let VoronoiEdge2::Ray { from, direction: [x, y] } = d.voronoi().edge(e) else {
            panic!("{a:?} {b:?}")
        };
        assert_eq!(from, center);
        // Half as long as the edge.
        assert_eq!([x.abs(), y.abs()], [apart[1].abs() / 2.0, apart[0].abs() / 2.0], "{a:?} {b:?}");
        assert_eq!(x * apart[0] + y * apart[1], 0.0, "{a:?} {b:?}");
        assert!(x * (third[0] - a[0]) + y * (third[1] - a[1]) < 0.0, "{a:?} {b:?}");
    }
    let d = Delaunay2::from_points(&sites[..2]).expect("finite");
    for e in d.mesh().undirected_edges().flat_map(|e| [e, d.mesh().twin(e)]) {
        let is_forward = d.segment(e)[0] == sites[0];
        let direction = if is_forward { [1.0, -2.0] } else { [-1.0, 2.0] };
        assert_eq!(d.voronoi().edge(e), VoronoiEdge2::Line { through: [3.0, 3.0], direction });
    }
}

#[test]
fn rings_are_measured() {
    let ring = |low: f64, high: f64| {
        vec![[low, low + 4.0], [high, low + 4.0], [high, high + 4.0], [low, high + 4.0]]
    };
    let region = Region2::polygon(&[ring(1.0, 5.0), ring(2.0, 3.0)]).expect("a frame");
    let d = Delaunay2::from_points(&[[4.5, 8.5]]).expect("finite");
    let (v, cells) = (VertexId::new(0), d.voronoi().clip(&region));
    assert_eq!((cells.perimeter(v), cells.area(v)), (20.0, 15.0));
    let mut areas: Vec<f64> = cells.rings(v).map(|ring| ring.area()).collect();
    areas.sort_by(f64::total_cmp);
    assert_eq!(areas, [-1.0, 16.0]);
    for ring in cells.rings(v) {
        let corners = ring.indices().iter().map(|&i| cells.vertices()[i as usize]);
        assert!(corners.eq(ring.points()) && ring.indices().len() == 4);
    }
    // An id that is no vertex has none, and neither has a cell that is elsewhere.
    assert_eq!(cells.rings(VertexId::new(1)).count(), 0);
    let d = Delaunay2::from_points(&[[4.5, 8.5], [100.0, 8.0], [101.0, 9.0], [102.0, 7.0]]).expect("finite");
    let cells = d.voronoi().clip(&region);
    assert_eq!([0, 2].map(|i| cells.rings(VertexId::new(i)).count()), [2, 0]);
}

/// In any unit, and whatever the corner that is first.
#[test]
fn centers_of_mass_are_where_they_are_at_any_scale() {
    let mut corners = [[1.0, 2.0], [7.0, 2.0], [7.0, 5.0], [1.0, 11.0]];
    let d = Delaunay2::from_points(&[[3.0, 4.0]]).expect("finite");
    for exponent in [0, -400, -200, 300, 600, 1000] {
        let scale = 2f64.powi(exponent);
        for _ in 0..corners.len() {
            corners.rotate_left(1);
            let scaled: Vec<[f64; 2]> = corners.iter().map(|p| p.map(|x| x * scale)).collect();
            let region = Region2::polygon(&[scaled]).expect("simple");
            let cells = d.voronoi().clip(&region);
            // A rectangle of 18 around (4, 3.5), and a triangle of 18 on it around (3, 7).
            let found = cells.centroid(VertexId::new(0)).expect("an area");
            for (found, expected) in found.iter().zip([3.5, 5.25]) {
                assert!((found / scale - expected).abs() < 1e-12, "2^{exponent}: {}", found / scale);
            }
        }
    }
}

#[test]
fn progress_is_told_now_and_then() {
    let points: Vec<[f64; 2]> = (0..66_000).map(|i| [f64::from(i % 256), f64::from(i / 256)]).collect();
    let d = Delaunay2::from_points(&points).expect("finite");
    let region = Region2::rectangle([-1.0, -1.0], [256.0, 258.0]).expect("a rectangle");
    let mut told = Vec::new();
    let cells = d.voronoi().clip_with(&region, |done| told.push(done));
    assert_eq!(told, [65_536]);
    assert!(d.vertices().all(|v| cells.rings(v).count() == 1));
}

/// Cells of one lattice beside a border: made of the centers of triangles, which they share, or cut out.
#[test]
fn cells_that_roundings_could_take_across_are_cut_out() {
    // A cell of this size around the middle, its box ending at half of it, and the border a bit further on.
    let is_whole = |size: [f64; 2], middle: [f64; 2], axis: usize, sign: f64, bit: f64| {
        let at = |k: usize, i: usize| middle[k] + size[k] * (i as f64 - 2.0);
        let sites: Vec<[f64; 2]> = (0..25).map(|i| [at(0, i % 5), at(1, i / 5)]).collect();
        let d = Delaunay2::from_points(&sites).expect("finite");
        let (mut low, mut high) = ([0, 1].map(|k| at(k, 0)), [0, 1].map(|k| at(k, 4)));
        let border = if sign > 0.0 { &mut high[axis] } else { &mut low[axis] };
        *border = middle[axis] + sign * (size[axis] / 2.0 + bit);
        let cells = d.voronoi().clip(&Region2::rectangle(low, high).expect("a rectangle"));
        let v = VertexId::new(12);
        assert_eq!(cells.area(v), size[0] * size[1]);
        let is_shared = |i: &u32| (*i as usize) < d.mesh().slot_count();
        let shared: Vec<bool> = cells.rings(v).flat_map(|ring| ring.indices()).map(is_shared).collect();
        assert!(shared.iter().all(|is| *is == shared[0]) && shared.len() == 4);
        shared[0]
    };
    let two = |exponent: i32| 2f64.powi(exponent);
    for size in [[1.0, 1.0], [1024.0, 1.0], [1.0, 1024.0], [1024.0, 1024.0]] {
        for (axis, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
            assert!(!is_whole(size, [0.0, 0.0], axis, sign, 0.0), "{size:?} {axis} {sign}");
            // A step beyond is enough, because corners are correctly rounded; far away steps are larger.
            let half = size[axis] / 2.0;
            assert!(is_whole(size, [0.0, 0.0], axis, sign, half * f64::EPSILON), "{size:?} {axis} {sign}");
            let far = [two(22), two(22)];
            assert!(!is_whole(size, far, axis, sign, two(-32)), "{size:?} {axis} {sign}");
            assert!(is_whole(size, far, axis, sign, two(-30)), "{size:?} {axis} {sign}");
        }
    }
}

/// Removal leaves triangles that are none among the others: the cells are those of the sites that stay.
#[test]
fn cells_after_removal_are_those_of_a_new_triangulation() {
    let mut random = Random::new(13);
    let region = Region2::rectangle([-1.0; 2], [2.0; 2]).expect("a rectangle");
    for n in 3..40 {
        let points: Vec<[f64; 2]> = (0..n).map(|_| [random.unit(), random.unit()]).collect();
        let mut d = Delaunay2::from_points(&points).expect("finite");
        let gone = n / 3;
        (0..gone).for_each(|i| d.remove(VertexId::new(i)).expect("a vertex"));
        let anew = Delaunay2::from_points(&points[gone..]).expect("finite");
        let [cells, expected] = [&d, &anew].map(|d| d.voronoi().clip(&region));
        for i in 0..n {
            let found = cells.area(VertexId::new(i));
            let area = i.checked_sub(gone).map_or(0.0, |i| expected.area(VertexId::new(i)));
            assert_eq!(found, area, "{i} of {n}");
        }
    }
}
