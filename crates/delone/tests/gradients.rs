//! Gradients of linear functions are those functions', whatever slivers there are; of spheres inside; nothing else shows than the points.

use delone::surface::{Interpolator, gradients};
use delone::{Coordinates, Delaunay2, Delaunay3, Surround, VertexId};
use delone_generators::{Kind, Kind3, Random};
use delone_oracle::some_of;

const SLOPE: [f64; 3] = [3.0, -2.0, 5.0];

/// A lattice turned about the origin and moved.
fn turned(side: usize, degrees: f64, offset: [f64; 2]) -> Vec<[f64; 2]> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let at = |i: usize| ((i % side) as f64, (i / side) as f64);
    let turn = |(x, y): (f64, f64)| [offset[0] + cos * x - sin * y, offset[1] + sin * x + cos * y];
    (0..side * side).map(|i| turn(at(i))).collect()
}

fn turned3(side: usize, degrees: [f64; 2], offset: [f64; 3]) -> Vec<[f64; 3]> {
    let [(s, c), (t, u)] = degrees.map(|angle| angle.to_radians().sin_cos());
    let at = |i: usize| [i % side, i / side % side, i / (side * side)].map(|x| x as f64);
    let turn = |[x, y, z]: [f64; 3]| {
        let (x, y) = (c * x - s * y, s * x + c * y);
        [offset[0] + x, offset[1] + u * y - t * z, offset[2] + t * y + u * z]
    };
    (0..side * side * side).map(|i| turn(at(i))).collect()
}

/// Everyday sets of the plane that have slivers along their hulls or inside.
fn plane() -> Vec<(String, Vec<[f64; 2]>)> {
    let mut all = Vec::new();
    for degrees in [0.0, 1.0, 17.0, 30.0, 33.3, 45.0, 61.0, 89.0] {
        for (name, offset) in [("", [0.0; 2]), (" UTM", [500_000.0, 5_200_000.0])] {
            all.push((format!("lattice {degrees}{name}"), turned(20, degrees, offset)));
        }
    }
    for n in [8, 17, 100] {
        let on_circle = |i: usize| {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / n as f64).sin_cos();
            [100.0 * cos, 100.0 * sin]
        };
        all.push((format!("circle {n}"), (0..n).map(on_circle).collect()));
    }
    let tenths = (0..400).map(|i| [f64::from(i % 20) * 0.1, f64::from(i / 20) * 0.3]).collect();
    all.push(("tenths".into(), tenths));
    // Eight points: four on a side, of which two are an ulp off it, and four beyond.
    let side = |x: f64, off: f64| [x, x / 3.0 + off];
    let ulp = f64::EPSILON / 2.0;
    all.push((
        "eight".into(),
        vec![
            side(0.25, 0.0),
            side(0.5, ulp),
            side(0.75, ulp),
            side(1.0, 0.0),
            [0.0, 1.0],
            [0.4, 1.1],
            [0.8, 1.3],
            [1.0, 1.6],
        ],
    ));
    for thickness in [1e-3, 1e-6] {
        let points = Kind::Uniform.points(200, 5).iter().map(|p| [p[0], p[1] * thickness]).collect();
        all.push((format!("strip {thickness}"), points));
    }
    all.push(("uniform".into(), Kind::Uniform.points(500, 3)));
    all
}

fn space() -> Vec<(String, Vec<[f64; 3]>)> {
    let mut all = Vec::new();
    for degrees in [[0.0, 0.0], [10.0, 0.0], [17.0, 31.0], [30.0, 45.0], [61.0, 2.0]] {
        all.push((format!("lattice {degrees:?}"), turned3(6, degrees, [0.0; 3])));
        all.push((format!("lattice {degrees:?} far"), turned3(6, degrees, [4000.0, 500.0, 4900.0])));
    }
    all.push(("ball".into(), Kind3::Ball.points(300, 1)));
    all.push(("sphere".into(), Kind3::Sphere.points(200, 1)));
    all
}

/// The largest value in size, and the least distance of two points along an axis.
fn size_and_step<P: Coordinates>(points: &[P], values: &[f64]) -> (f64, f64) {
    let size = values.iter().fold(0.0f64, |most, z| most.max(z.abs()));
    let mut step = f64::INFINITY;
    for (i, p) in points.iter().enumerate() {
        for q in &points[..i] {
            let square: f64 = p.as_ref().iter().zip(q.as_ref()).map(|(a, b)| (a - b) * (a - b)).sum();
            step = step.min(square.sqrt());
        }
    }
    (size, step)
}

fn judge<T: Surround>(name: &str, d: &T, points: &[T::Point], thinness: f64)
where
    T::Point: Coordinates,
{
    let linear = |p: &T::Point| 7.0 + p.as_ref().iter().zip(SLOPE).map(|(x, g)| g * x).sum::<f64>();
    let values: Vec<f64> = points.iter().map(linear).collect();
    let (size, step) = size_and_step(points, &values);
    let bound = 2f64.powi(-36) * 7.0 + 2f64.powi(-32) * thinness * size / step;
    let slopes = gradients(d, &values).expect("values");
    let mut worst = 0.0f64;
    for slope in &slopes {
        worst = slope.as_ref().iter().zip(SLOPE).fold(worst, |worst, (a, b)| worst.max((a - b).abs()));
    }
    assert!(worst <= bound, "{name}: a gradient is off by {worst}, which may be {bound}");
    // Surfaces of these gradients are the function.
    let mut f = Interpolator::sibson(d);
    let mut random = Random::new(5);
    for _ in 0..200 {
        let mut q = T::Point::default();
        let ends = [0, 1, 2, 3].map(|_| points[random.below(points.len())]);
        for (k, x) in q.as_mut().iter_mut().enumerate() {
            *x = ends.iter().map(|p| p.as_ref()[k] / 4.0).sum();
        }
        for surface in [Interpolator::<T>::smooth, Interpolator::<T>::farin] {
            if let Some(value) = surface(&mut f, q, &values, &slopes).expect("finite") {
                let miss = (value - linear(&q)).abs();
                assert!(miss <= 1e-9 * size, "{name}: {q:?} is off by {miss}");
            }
        }
    }
}

#[test]
fn gradients_of_linear_functions_are_theirs() {
    for (name, points) in plane() {
        let thinness = if name.starts_with("strip") { 1e6 } else { 1.0 };
        judge(&name, &Delaunay2::from_points(&points).expect("finite"), &points, thinness);
    }
    for (name, points) in space() {
        judge(&name, &Delaunay3::from_points(&points).expect("finite"), &points, 1.0);
    }
}

/// Inside of a turned lattice, beside hull slivers of an ulp, but for vertices between such slivers alone.
#[test]
fn gradients_of_spheres_are_theirs_beside_slivers() {
    let mut beside = 0;
    for degrees in [17.0, 30.0, 61.0] {
        let points = turned(20, degrees, [0.0; 2]);
        let d = Delaunay2::from_points(&points).expect("finite");
        let values: Vec<f64> = points.iter().map(|[x, y]| x - y + 0.5 * (x * x + y * y)).collect();
        let on_hull: Vec<VertexId> = d.hull_vertices().collect();
        for (v, slope) in gradients(&d, &values).expect("values").into_iter().enumerate() {
            let [x, y] = points[v];
            let miss = (slope[0] - 1.0 - x).abs() + (slope[1] + 1.0 - y).abs();
            let around: Vec<usize> = d.neighbors(VertexId::new(v)).map(|w| w.index()).collect();
            let on_one_side =
                [|v: usize| v / 20, |v| v % 20].iter().any(|of| around.iter().all(|&w| of(w) == of(v)));
            if on_hull.contains(&VertexId::new(v)) || on_one_side {
                continue;
            }
            beside += usize::from([0, 19].contains(&(v / 20)) || [0, 19].contains(&(v % 20)));
            assert!(miss < 1e-9, "{degrees}: {v} is off by {miss}, beside {around:?}");
        }
    }
    assert!(beside > 20, "{beside} vertices beside slivers");
}

/// Other orders of the same points give the same bits; points and values times powers of two theirs times a power of two.
#[test]
fn order_and_powers_of_two_do_not_show() {
    for (name, points) in some_of(plane()) {
        let values: Vec<f64> = points.iter().map(|[x, y]| (x * 3.0).sin() + y * y).collect();
        let of = |points: &[[f64; 2]], values: &[f64]| {
            gradients(&Delaunay2::from_points(points).expect("finite"), values).expect("values")
        };
        let known = of(&points, &values);
        let mut order: Vec<usize> = (0..points.len()).collect();
        Random::new(3).shuffle(&mut order);
        let (others, moved): (Vec<_>, Vec<_>) = order.iter().map(|&i| (points[i], values[i])).unzip();
        let expected: Vec<_> = order.iter().map(|&i| known[i]).collect();
        assert_eq!(of(&others, &moved), expected, "{name}: order");
        for (length, height) in [(-200, 0), (-1, 1), (1, -1), (3, 100), (300, -300), (-130, -50)] {
            let [length, height] = [length, height].map(|power| 2f64.powi(power));
            let points: Vec<_> = points.iter().map(|p| p.map(|x| x * length)).collect();
            let values: Vec<_> = values.iter().map(|z| z * height).collect();
            let expected: Vec<_> = known.iter().map(|slope| slope.map(|x| x / length * height)).collect();
            assert_eq!(of(&points, &values), expected, "{name}: times {length}, {height}");
        }
    }
    for (name, points) in some_of(space()) {
        let values: Vec<f64> = points.iter().map(|[x, y, z]| (x * 3.0).sin() + y * z).collect();
        let of = |points: &[[f64; 3]], values: &[f64]| {
            gradients(&Delaunay3::from_points(points).expect("finite"), values).expect("values")
        };
        let known = of(&points, &values);
        let (others, moved): (Vec<_>, Vec<_>) =
            (0..points.len()).rev().map(|i| (points[i], values[i])).unzip();
        assert!(of(&others, &moved).iter().rev().eq(&known), "{name}: order");
        let points: Vec<_> = points.iter().map(|p| p.map(|x| x * 2f64.powi(-100))).collect();
        let expected: Vec<_> = known.iter().map(|slope| slope.map(|x| x * 2f64.powi(100))).collect();
        assert_eq!(of(&points, &values), expected, "{name}: scaled");
    }
}
