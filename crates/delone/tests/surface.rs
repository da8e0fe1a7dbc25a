//! Interpolation and rasters against their definitions: cells with and without the point, identities, one cell after the other.

use delone::surface::{Grid, Interpolator, Outside, Raster, gradients, rasterize};
use delone::{Ask, Bounds, Constrained2, Delaunay2, Delaunay3, Region2, Surround, VertexId};
use delone_generators::{Kind, Kind3, Random};
use delone_oracle::all_cases;

/// Places to ask at: everywhere, on vertices, on edges, near the hull, outside.
fn queries<const D: usize>(points: &[[f64; D]], random: &mut Random) -> Vec<[f64; D]> {
    let bounds = Bounds::of(points.iter().copied());
    let mut all: Vec<[f64; D]> =
        (0..40).map(|_| std::array::from_fn(|k| random.between(bounds.low[k], bounds.high[k]))).collect();
    for _ in 0..20 {
        let [a, b] = [0, 1].map(|_| points[random.below(points.len())]);
        all.push(a);
        all.push(std::array::from_fn(|k| a[k] / 2.0 + b[k] / 2.0));
        let share = random.unit();
        all.push(std::array::from_fn(|k| a[k] * share + b[k] * (1.0 - share)));
    }
    all.push(bounds.high.map(|x| x * 2.0 + 1.0));
    all.retain(|q| q.iter().all(|x| x.is_finite()));
    all
}

/// Weights that are positive, with the sum one, whose vertices they bring back to the point.
fn judge<const D: usize>(
    q: [f64; D],
    weights: &[(VertexId, f64)],
    position: impl Fn(VertexId) -> [f64; D],
    what: &str,
    is_extreme: bool,
) {
    let total: f64 = weights.iter().map(|weight| weight.1).sum();
    assert!(weights.iter().all(|weight| weight.1 >= 0.0), "{what} {q:?}: {weights:?}");
    assert!((total - 1.0).abs() < 1e-14 * weights.len().max(8) as f64, "{what} {q:?}: sum {total}");
    // Magnitudes from 1e-300 to 1e300 in one triangle leave no floats for weights.
    for k in (0..D).filter(|_| !is_extreme) {
        let away = |v| position(v)[k] / 4.0 - q[k] / 4.0;
        let size = weights.iter().map(|weight| away(weight.0).abs()).fold(0.0, f64::max);
        let miss: f64 = weights.iter().map(|&(v, w)| w * away(v)).sum();
        assert!(miss.abs() <= 1e-9 * size, "{what} {q:?}: off by {miss} of {size}, {weights:?}");
    }
}

/// Whether a point outside is as near to the hull as the nearest point of the hull tells.
fn is_on_border<T: Surround>(d: &T, q: T::Point) -> bool {
    let weights = Interpolator::linear(d).outside(Outside::Hull).weights(q).expect("finite").to_vec();
    let at = |v: VertexId| d.position(v).expect("a vertex");
    let largest = d.vertices().map(at).chain([q]);
    let largest = largest.flat_map(|p| p.as_ref().to_vec()).fold(0.0f64, |most, x| most.max(x.abs()));
    let axes = q.as_ref().iter().enumerate();
    let miss =
        axes.map(|(k, x)| weights.iter().map(|w| w.1 * (at(w.0).as_ref()[k] / largest - x / largest)).sum());
    d.simplices().next().is_some() && miss.map(|x: f64| x * x).sum::<f64>().sqrt() <= 2f64.powi(-48)
}

fn all_methods<T: Surround>(d: &T) -> [(&'static str, Interpolator<'_, T>); 3] {
    [
        ("linear", Interpolator::linear(d)),
        ("laplace", Interpolator::laplace(d)),
        ("sibson", Interpolator::sibson(d)),
    ]
}

#[test]
fn weights_bring_back_the_point() {
    for &kind in Kind::ALL {
        for n in [1, 2, 3, 5, 30, 400] {
            let points = kind.points(n, n as u64);
            let d = Delaunay2::from_points(&points).expect("finite");
            let mut random = Random::new(n as u64);
            for q in queries(&points, &mut random) {
                let found = d.find(q).expect("finite");
                for (name, mut f) in all_methods(&d) {
                    let weights = f.weights(q).expect("finite").to_vec();
                    let what = format!("{} {n} {name}", kind.name());
                    // On the border but for rounding is not nothing.
                    let is_beyond = weights.is_empty();
                    let is_right = is_beyond == found.is_outside || (!is_beyond && is_on_border(&d, q));
                    assert!(is_right, "{what} {q:?}");
                    if !found.is_outside {
                        judge(q, &weights, |v| d.point(v), &what, kind.is_extreme());
                    }
                    if let [v] = found.face() {
                        assert_eq!(weights, [(*v, 1.0)], "{what}");
                    }
                    let nearest = f.outside(Outside::Nearest).weights(q).expect("finite").to_vec();
                    if is_beyond {
                        assert_eq!(nearest, [(d.nearest(q).unwrap().unwrap(), 1.0)]);
                    }
                }
            }
        }
    }
}

#[test]
fn weights_bring_back_the_point_in_space() {
    for &kind in Kind3::ALL {
        for n in [1, 4, 7, 150] {
            let points = kind.points(n, n as u64);
            let d = Delaunay3::from_points(&points).expect("finite");
            let mut random = Random::new(n as u64);
            for q in queries(&points, &mut random) {
                let found = d.find(q).expect("finite");
                for (name, mut f) in all_methods(&d) {
                    let weights = f.weights(q).expect("finite").to_vec();
                    let what = format!("{} {n} {name}", kind.name());
                    // On the border but for rounding is not nothing.
                    let is_beyond = weights.is_empty();
                    let is_right = is_beyond == found.is_outside || (!is_beyond && is_on_border(&d, q));
                    assert!(is_right, "{what} {q:?}");
                    if !found.is_outside {
                        let is_extreme = [Kind3::NearlyLine, Kind3::HugeSpan3].contains(&kind);
                        judge(q, &weights, |v| d.point(v), &what, is_extreme);
                    }
                }
            }
        }
    }
}

/// The area of the new cell equals the area that the other cells lose.
#[test]
fn sibson_is_what_cells_lose() {
    for kind in [Kind::Uniform, Kind::Clusters, Kind::Grid, Kind::Circle] {
        let points = kind.points(300, 2);
        let d = Delaunay2::from_points(&points).expect("finite");
        let bounds = Bounds::of(points.iter().copied());
        let size = bounds.high[0] - bounds.low[0];
        // Cells that are cut far away, so that those of the inside are whole.
        let far = Region2::rectangle(bounds.low.map(|x| x - 1e3 * size), bounds.high.map(|x| x + 1e3 * size))
            .expect("a region");
        let mut random = Random::new(1);
        let mut compared = 0;
        for _ in 0..60 {
            let q = [0, 1].map(|k| {
                let [low, high] = [bounds.low[k], bounds.high[k]];
                random.between(low + 0.2 * (high - low), high - 0.2 * (high - low))
            });
            let weights = Interpolator::sibson(&d).weights(q).expect("finite").to_vec();
            let mut with = d.clone();
            let new = with.insert(q).expect("finite").vertex();
            let (before, after) = (d.voronoi(), with.voronoi());
            let (before, after) = (before.clip(&far), after.clip(&far));
            let whole = after.area(new);
            if whole > size * size {
                continue; // cut
            }
            compared += 1;
            for (v, weight) in weights {
                let lost = (before.area(v) - after.area(v)) / whole;
                let scale = before.area(v) / whole * 1e-12 + 1e-9;
                assert!((lost - weight).abs() < scale, "{} {q:?} {v:?}: {weight} {lost}", kind.name());
            }
        }
        assert!(compared > 20 || kind == Kind::Circle, "{}: {compared}", kind.name());
    }
}

/// In space by sampling: whose cell was a place of the new cell in?
#[test]
fn sibson_is_what_cells_lose_in_space() {
    let points = Kind3::Cube.points(200, 3);
    let d = Delaunay3::from_points(&points).expect("finite");
    let mut random = Random::new(4);
    let queries = [[0.5, 0.45, 0.55], [0.4, 0.6, 0.5]];
    for &q in &queries[usize::from(!all_cases())..] {
        let weights = Interpolator::sibson(&d).weights(q).expect("finite").to_vec();
        let mut hits = vec![0.0; points.len()];
        let mut total = 0.0;
        for _ in 0..400_000 {
            let x: [f64; 3] = std::array::from_fn(|k| q[k] + random.between(-0.3, 0.3));
            let square = |p: [f64; 3]| -> f64 { (0..3).map(|k| (p[k] - x[k]) * (p[k] - x[k])).sum() };
            let nearest = d.nearest(x).expect("finite").expect("a vertex");
            if square(q) < square(d.point(nearest)) {
                hits[nearest.index()] += 1.0;
                total += 1.0;
            }
        }
        for &(v, weight) in &weights {
            let share = hits[v.index()] / total;
            assert!((share - weight).abs() < 0.02, "{v:?}: {weight} sampled as {share}");
        }
        assert!(total > 1000.0);
    }
}

#[test]
fn surfaces_with_gradients_are_exact_where_they_should_be() {
    let points = Kind::Uniform.points(500, 1);
    let d = Delaunay2::from_points(&points).expect("finite");
    let quadratic = |[x, y]: [f64; 2]| 2.0 * x * x - 3.0 * x * y + y * y + x;
    let slope = |[x, y]: [f64; 2]| [4.0 * x - 3.0 * y + 1.0, 2.0 * y - 3.0 * x];
    let sphere = |[x, y]: [f64; 2]| 1.0 + x - 2.0 * y + 5.0 * (x * x + y * y);
    let values: Vec<f64> = points.iter().map(|&p| quadratic(p)).collect();
    let slopes: Vec<[f64; 2]> = points.iter().map(|&p| slope(p)).collect();
    let round: Vec<f64> = points.iter().map(|&p| sphere(p)).collect();
    let estimated = gradients(&d, &round).expect("values");
    let on_hull: Vec<VertexId> = d.hull_vertices().collect();
    for (v, [x, y]) in estimated.iter().enumerate() {
        if !on_hull.contains(&VertexId::new(v)) {
            let [a, b] = points[v];
            let miss = (x - (1.0 + 10.0 * a)).abs() + (y - (10.0 * b - 2.0)).abs();
            assert!(miss < 1e-7, "{v}: {miss}");
        }
    }
    let mut random = Random::new(2);
    let mut f = Interpolator::sibson(&d);
    for _ in 0..500 {
        let q = [random.between(0.2, 0.8), random.between(0.2, 0.8)];
        let farin = f.farin(q, &values, &slopes).expect("finite").expect("inside");
        assert!((farin - quadratic(q)).abs() < 1e-12, "{q:?}: {farin}");
        let smooth = f.smooth(q, &round, &estimated).expect("finite").expect("inside");
        assert!((smooth - sphere(q)).abs() < 1e-9, "{q:?}: {smooth}");
    }
}

#[test]
fn gradients_in_space_and_on_lines() {
    let points = Kind3::Ball.points(300, 1);
    let d = Delaunay3::from_points(&points).expect("finite");
    let values: Vec<f64> = points.iter().map(|[x, y, z]| x - 2.0 * y + 3.0 * z).collect();
    for slope in gradients(&d, &values).expect("values") {
        assert!(slope.iter().zip([1.0, -2.0, 3.0]).all(|(a, b)| (a - b).abs() < 1e-8), "{slope:?}");
    }
    let line = Delaunay2::from_points(&[[0, 0], [1, 1], [3, 3]]).expect("finite");
    assert_eq!(gradients(&line, &[0.0; 3]).expect("values"), [[0.0; 2]; 3]);
    assert!(gradients(&line, &[0.0; 2]).is_err());
}

/// Natural neighbors do not jump where triangles change.
#[test]
fn natural_neighbors_are_continuous() {
    let points = Kind::Uniform.points(200, 5);
    let d = Delaunay2::from_points(&points).expect("finite");
    let values: Vec<f64> = points.iter().map(|[x, y]| (9.0 * x).sin() * (7.0 * y).cos()).collect();
    let mut random = Random::new(9);
    for (_, mut f) in all_methods(&d) {
        for _ in 0..2000 {
            let q = [random.between(0.1, 0.9), random.between(0.1, 0.9)];
            let near = q.map(|x| x + random.between(-1e-9, 1e-9));
            let [a, b] = [q, near].map(|q| f.value(q, &values).expect("finite").expect("inside"));
            assert!((a - b).abs() < 1e-6, "{q:?}: {a} {b}");
        }
    }
}

/// Rasters of sets with their own lattice, so that centers fall on vertices and edges.
fn grids(points: &[[f64; 2]], random: &mut Random) -> Vec<Grid> {
    let bounds = Bounds::of(points.iter().copied());
    let size = [0, 1].map(|k| bounds.high[k] - bounds.low[k]).into_iter().fold(0.0, f64::max);
    let mut all = Vec::new();
    if !(size.is_finite() && size > 0.0) {
        return all;
    }
    for cells in [7.0, 40.0] {
        all.extend(Grid::aligned(&bounds, size / cells * (0.7 + 0.6 * random.unit())).ok());
        // With centers on points.
        let [a, b] = [0, 1].map(|_| points[random.below(points.len())]);
        let step = [0, 1].map(|k| if a[k] == b[k] { size / cells } else { (a[k] - b[k]).abs() / 3.0 });
        let corner = [a[0] - 3.5 * step[0], a[1] + 4.5 * step[1]];
        all.extend(Grid::new(corner, [step[0], -step[1]], 9, 9).ok());
        all.extend(
            Grid::new([corner[0] + 9.0 * step[0], a[1] - 4.5 * step[1]], [-step[0], step[1]], 9, 9).ok(),
        );
    }
    all.retain(|grid| grid.cells() < 1e5);
    all
}

/// Each center by location.
#[test]
fn rasters_are_what_locating_gives() {
    for &kind in Kind::ALL {
        for n in [3, 12, 200] {
            let points = kind.points(n, n as u64 + 1);
            let d = Delaunay2::from_points(&points).expect("finite");
            let mut random = Random::new(n as u64);
            let heights: Vec<f64> = points.iter().map(|_| random.between(-1.0, 1.0)).collect();
            for grid in grids(&points, &mut random) {
                let values = rasterize(&d, &heights, &grid, |_| true).expect("heights");
                let mut f = Interpolator::linear(&d);
                for row in 0..grid.rows() {
                    for column in 0..grid.columns() {
                        let q = grid.center(column, row);
                        let value = values[row * grid.columns() + column];
                        let located = f.value(q, &heights).expect("finite");
                        let found = d.find(q).expect("finite");
                        let what = format!("{} {n} {q:?} {:?}", kind.name(), found.face());
                        if d.triangle_count() == 0 {
                            assert!(value.is_nan(), "{what}");
                            continue;
                        }
                        // The nearest points of the hull are for who asks at points; cells beyond it have nothing.
                        assert_eq!(value.is_nan(), found.is_outside, "{what}");
                        let Some(located) = located.filter(|_| !found.is_outside) else { continue };
                        match found.face() {
                            [v] => assert_eq!(value, heights[v.index()], "{what}"),
                            _ if kind.is_extreme() => assert!((-1.0..=1.0).contains(&value), "{what}"),
                            _ => {
                                let flat = flatness(&d, found.face(), found.simplex);
                                assert!(
                                    (value - located).abs() < 1e-12 + 1e-15 * flat,
                                    "{what}: {value} {located}"
                                );
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Slopes that no number is small enough for, and coordinates with few bits.
#[test]
fn rasters_are_linear_at_any_scale() {
    let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let plane = [0.0, 1.0, 3.0, 2.0];
    let some = Kind::Uniform.points(30, 1);
    for size in [1e300, 1.0, 1e-300, f64::from_bits(1 << 44)] {
        for height in [1e-25, 1e-15, 1.0, 1e-300, 1e300] {
            let mut points: Vec<[f64; 2]> = corners.iter().map(|p| p.map(|x| x * size)).collect();
            points.extend(some.iter().map(|p| p.map(|x| 4.0 * x * size)));
            let heights: Vec<f64> = (0..points.len())
                .map(|i| match plane.get(i) {
                    Some(z) => z * height,
                    None => (points[i][0] / size / 4.0 + points[i][1] / size / 2.0) * height,
                })
                .collect();
            let d = Delaunay2::from_points(&points).expect("finite");
            let grid = Grid::new([0.0, 0.0], [size * 0.5; 2], 8, 8).expect("a raster");
            let values = rasterize(&d, &heights, &grid, |_| true).expect("heights");
            for (k, value) in values.iter().enumerate() {
                let [x, y] = [(k % 8) as f64 + 0.5, (k / 8) as f64 + 0.5].map(|x| x / 2.0);
                let expected = (x / 4.0 + y / 2.0) * height;
                assert!(
                    (value - expected).abs() <= 1e-11 * height,
                    "{size:e} {height:e} {k}: {value:e} {expected:e}"
                );
            }
        }
    }
}

/// How many last places of a coordinate fit into the width of a triangle: what roundings of a coordinate may do to a height.
fn flatness(d: &Delaunay2, _: &[VertexId], t: Option<delone::TriangleId>) -> f64 {
    let Some(t) = t else { return 0.0 };
    let corners = d.mesh().corners(t).map(|v| d.point(v));
    let size = corners.as_flattened().iter().fold(0.0f64, |most, x| most.max(x.abs()));
    let long = (0..3)
        .map(|k| (corners[k][0] - corners[(k + 1) % 3][0]).hypot(corners[k][1] - corners[(k + 1) % 3][1]))
        .fold(0.0, f64::max);
    size * long / d.area(t)
}

#[test]
fn windows_orders_and_threads_do_not_show() {
    let points = Kind::Clusters.points(3000, 1);
    let d = Delaunay2::from_points(&points).expect("finite");
    let heights: Vec<f64> = points.iter().map(|[x, y]| (5.0 * x).sin() + y).collect();
    let grid = Grid::aligned(&Bounds::of(points.iter().copied()), 0.004).expect("a raster");
    let bits = |values: &[f64]| values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    let whole = rasterize(&d, &heights, &grid, |_| true).expect("heights");
    let raster = Raster::new(grid);
    let mut triangles: Vec<_> = d.triangles().collect();
    Random::new(1).shuffle(&mut triangles);
    for (k, [a, b, c]) in triangles.into_iter().enumerate() {
        let turned = [[a, b, c], [b, c, a], [c, a, b]][k % 3];
        raster.paint(turned.map(|v| d.point(v)), turned.map(|v| heights[v.index()]));
    }
    assert_eq!(bits(&whole), bits(&raster.into_values()));
    for methods in [Interpolator::laplace(&d), Interpolator::sibson(&d)] {
        let mut natural = whole.clone();
        methods.fill(&grid, &heights, &mut natural).expect("heights");
        for (columns, rows) in [(0..grid.columns(), 3..17), (5..33, 0..grid.rows())] {
            let window = grid.window(columns.clone(), rows.clone());
            let mut part = rasterize(&d, &heights, &window, |_| true).expect("heights");
            let cut = |all: &[f64]| -> Vec<f64> {
                rows.clone()
                    .flat_map(|row| columns.clone().map(move |column| row * grid.columns() + column))
                    .map(|at| all[at])
                    .collect()
            };
            assert_eq!(bits(&part), bits(&cut(&whole)));
            methods.fill(&window, &heights, &mut part).expect("heights");
            assert_eq!(bits(&part), bits(&cut(&natural)));
        }
    }
    // Of a triangulation with constraints the same, where no segment matters.
    let constrained = Constrained2::from_parts(&points, &[] as &[[usize; 2]]).expect("finite");
    assert_eq!(bits(&rasterize(&constrained, &heights, &grid, |_| true).expect("heights")), bits(&whole));
}

/// Values are a function of the set of points, bit for bit, as triangles are.
#[test]
fn orders_of_points_do_not_show() {
    let mut random = Random::new(3);
    for kind in [Kind::Uniform, Kind::Grid, Kind::Circle, Kind::Clusters, Kind::Duplicates] {
        let points = kind.points(300, 1);
        let mut order: Vec<usize> = (0..points.len()).collect();
        random.shuffle(&mut order);
        let other: Vec<[f64; 2]> = order.iter().map(|&i| points[i]).collect();
        let height = |p: &[f64; 2]| (3.0 * p[0]).sin() + p[1];
        let heights = [&points, &other].map(|points| points.iter().map(height).collect::<Vec<_>>());
        let d = Delaunay2::from_points(&points).expect("finite");
        let mut e = Delaunay2::new();
        e.extend(&other, 5).expect("finite");
        for q in queries(&points, &mut random) {
            for ((_, mut f), (name, mut g)) in all_methods(&d).into_iter().zip(all_methods(&e)) {
                let one = f.value(q, &heights[0]).expect("finite").map(f64::to_bits);
                let two = g.value(q, &heights[1]).expect("finite").map(f64::to_bits);
                assert_eq!(one, two, "{} {name} {q:?}", kind.name());
            }
        }
        let slopes = [gradients(&d, &heights[0]), gradients(&e, &heights[1])].map(|s| s.expect("values"));
        for (k, &i) in order.iter().enumerate() {
            let is_vertex = |d: &Delaunay2, v: usize| d.mesh().contains(VertexId::new(v));
            if is_vertex(&d, i) && is_vertex(&e, k) {
                assert_eq!(slopes[0][i].map(f64::to_bits), slopes[1][k].map(f64::to_bits));
            }
        }
    }
    let points = Kind3::Cube.points(200, 1);
    let other: Vec<[f64; 3]> = points.iter().rev().copied().collect();
    let [d, e] = [&points, &other].map(|points| Delaunay3::from_points(points).expect("finite"));
    let [a, b] = [&points, &other].map(|points| points.iter().map(|p| p[0] * p[1]).collect::<Vec<_>>());
    for q in queries(&points, &mut random) {
        for ((_, mut f), (name, mut g)) in all_methods(&d).into_iter().zip(all_methods(&e)) {
            let [one, two] = [f.value(q, &a), g.value(q, &b)].map(|v| v.expect("finite").map(f64::to_bits));
            assert_eq!(one, two, "{name} {q:?}");
        }
    }
    let slopes = [gradients(&d, &a), gradients(&e, &b)].map(|s| s.expect("values"));
    for (one, two) in slopes[0].iter().zip(slopes[1].iter().rev()) {
        assert_eq!(one.map(f64::to_bits), two.map(f64::to_bits));
    }
}

/// Points on a plane in space have no gradients, and on a line in the plane; what is between them is linear.
#[test]
fn flat_sets_are_linear() {
    let value = |p: &[f64]| 3.0 + p.iter().enumerate().map(|(k, x)| (k + 1) as f64 * x).sum::<f64>();
    let points = [[0.0, 0.0, 1.0], [4.0, 0.0, 5.0], [0.0, 4.0, 1.0]];
    let d = Delaunay3::from_points(&points).expect("finite");
    let values = points.map(|p| value(&p));
    let slopes = gradients(&d, &values).expect("values");
    let q = [1.0, 1.0, 2.0];
    let mut f = Interpolator::sibson(&d);
    let found = [f.smooth(q, &values, &slopes), f.farin(q, &values, &slopes)];
    assert!(found.iter().all(|found| found.as_ref().is_ok_and(|v| *v == Some(value(&q)))), "{found:?}");
    let points = [[0.0, 0.0], [4.0, 4.0], [1.0, 1.0]];
    let d = Delaunay2::from_points(&points).expect("finite");
    let values = points.map(|p| value(&p));
    let slopes = gradients(&d, &values).expect("values");
    let mut f = Interpolator::sibson(&d);
    let found = [f.smooth([2.5; 2], &values, &slopes), f.farin([2.5; 2], &values, &slopes)];
    assert!(
        found.iter().all(|found| found.as_ref().is_ok_and(|v| *v == Some(value(&[2.5; 2])))),
        "{found:?}"
    );
}

#[test]
fn many_points_at_once() {
    let points = Kind::Uniform.points(2000, 1);
    let d = Delaunay2::from_points(&points).expect("finite");
    let table: Vec<f64> = points.iter().flat_map(|[x, y]| [*x, x * y, 3.0]).collect();
    let asked = Kind::Uniform.points(100_000, 2);
    for (name, mut f) in all_methods(&d) {
        let values = f.many(&asked, &table, 3).expect("finite");
        let weights = f.matrix(&asked).expect("finite");
        assert_eq!((values.len(), weights.starts.len()), (300_000, 100_001));
        for (i, q) in asked.iter().enumerate().step_by(997) {
            let mut row = [0.0; 3];
            let is_inside = f.values(*q, &table, &mut row).expect("finite");
            let range = weights.starts[i]..weights.starts[i + 1];
            assert_eq!(range.is_empty(), !is_inside);
            if is_inside {
                assert_eq!(row[..], values[3 * i..3 * i + 3], "{name}");
                assert!((row[0] - q[0]).abs() < 1e-12 && (row[2] - 3.0).abs() < 1e-12);
                let of_matrix: f64 =
                    range.map(|k| weights.values[k] * table[3 * weights.columns[k] as usize + 1]).sum();
                assert!((of_matrix - row[1]).abs() < 1e-14);
            } else {
                assert!(values[3 * i].is_nan());
            }
        }
        let error = f.many(&[[0.5, 0.5], [f64::NAN, 0.0]], &table, 3).unwrap_err();
        assert!(error.to_string().contains("point 1"), "{error}");
        assert!(f.many(&asked, &table, 2).is_err());
    }
}
