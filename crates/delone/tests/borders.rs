//! Values on the border of the hull and beyond: those of the nearest point of the hull, also where a point is beside it by rounding alone.

use delone::surface::{Interpolator, Outside, gradients};
use delone::{Coordinates, Delaunay2, Delaunay3, Surround, VertexId};
use delone_generators::{Kind, Kind3, Random};

const SLOPE: [f64; 3] = [3.0, -2.0, 5.0];

fn linear<P: Coordinates>(p: P) -> f64 {
    7.0 + p.as_ref().iter().zip(SLOPE).map(|(x, g)| g * x).sum::<f64>()
}

fn blend<P: Coordinates>(points: &[P], weights: &[f64]) -> P {
    let mut q = P::default();
    for (k, x) in q.as_mut().iter_mut().enumerate() {
        *x = points.iter().zip(weights).map(|(p, w)| p.as_ref()[k] * w).sum();
    }
    q
}

fn distance<P: Coordinates>(p: P, q: P) -> f64 {
    p.as_ref().iter().zip(q.as_ref()).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// All ways to interpolate but that of the nearest vertex.
fn values<T: Surround>(d: &T, outside: Outside, q: T::Point, heights: &[f64]) -> Vec<Option<f64>> {
    let slopes = gradients(d, heights).expect("values");
    let all = [Interpolator::linear(d), Interpolator::laplace(d), Interpolator::sibson(d)];
    let mut found: Vec<_> = all.map(|f| f.outside(outside).value(q, heights).expect("finite")).into();
    let mut f = Interpolator::sibson(d).outside(outside);
    found.push(f.smooth(q, heights, &slopes).expect("finite"));
    found.push(f.farin(q, heights, &slopes).expect("finite"));
    found
}

fn judge<T: Surround>(name: &str, d: &T) {
    let facets: Vec<Vec<T::Point>> = d
        .hull_facets()
        .map(|facet| facet.as_ref().iter().map(|&v| d.position(v).expect("a vertex")).collect())
        .collect();
    let points: Vec<T::Point> = d.vertices().map(|v| d.position(v).expect("a vertex")).collect();
    let heights: Vec<f64> =
        (0..d.ids_given()).map(|v| d.position(VertexId::new(v)).map_or(0.0, linear)).collect();
    let size = heights.iter().fold(1.0f64, |most, z| most.max(z.abs()));
    let mut random = Random::new(1);
    for _ in 0..60 {
        let facet = &facets[random.below(facets.len())];
        let mut shares: Vec<f64> = facet.iter().map(|_| random.unit()).collect();
        let total: f64 = shares.iter().sum();
        shares.iter_mut().for_each(|share| *share /= total);
        // On the border but for rounding.
        let q = blend(facet, &shares);
        for value in values(d, Outside::Nothing, q, &heights) {
            let value = value.unwrap_or(f64::NAN);
            assert!((value - linear(q)).abs() <= 1e-9 * size, "{name}: {value} at {q:?} on the border");
        }
        // Beyond it: the nearest of many points of all facets is no nearer, and hardly further.
        let middle = blend(&points, &vec![1.0 / points.len() as f64; points.len()]);
        let far = 1.0 + random.unit();
        let q = blend(&[q, middle], &[far, 1.0 - far]);
        assert!(
            values(d, Outside::Nothing, q, &heights).iter().all(Option::is_none),
            "{name}: {q:?} is outside"
        );
        let mut f = Interpolator::linear(d).outside(Outside::Hull);
        let weights = f.weights(q).expect("finite").to_vec();
        let corners: Vec<T::Point> = weights.iter().map(|w| d.position(w.0).expect("a vertex")).collect();
        let nearest = blend(&corners, &weights.iter().map(|w| w.1).collect::<Vec<_>>());
        let reach = distance(q, nearest);
        for facet in &facets {
            for _ in 0..4 {
                let cut = random.unit();
                let other = blend(&facet[..2], &[cut, 1.0 - cut]);
                assert!(
                    reach <= distance(q, other) * (1.0 + 1e-9) + 1e-9,
                    "{name}: {other:?} is nearer to {q:?}"
                );
            }
        }
        for value in values(d, Outside::Hull, q, &heights) {
            let value = value.unwrap_or(f64::NAN);
            assert!((value - linear(nearest)).abs() <= 1e-9 * size, "{name}: {value} beyond at {q:?}");
        }
    }
}

#[test]
fn values_on_the_border_and_beyond() {
    for (degrees, offset) in [(0.0, 0.0), (17.0, 0.0), (33.0, 5e5)] {
        let (sin, cos) = f64::to_radians(degrees).sin_cos();
        let turn = |[x, y]: [f64; 2]| [offset + cos * x - sin * y, offset + sin * x + cos * y];
        let points: Vec<_> = (0..64).map(|i| turn([f64::from(i % 8), f64::from(i / 8)])).collect();
        judge(&format!("lattice {degrees}"), &Delaunay2::from_points(&points).expect("finite"));
    }
    for kind in [Kind::Uniform, Kind::Circle] {
        judge(kind.name(), &Delaunay2::from_points(&kind.points(100, 2)).expect("finite"));
    }
    for kind in [Kind3::Ball, Kind3::Sphere] {
        judge(kind.name(), &Delaunay3::from_points(&kind.points(60, 2)).expect("finite"));
    }
}

/// The nearest vertex is another question than the nearest point of the hull; flat sets have no hull.
#[test]
fn nearest_vertices_and_flat_sets() {
    let d = Delaunay2::from_points(&[[0, 0], [10, 0], [0, 10], [10, 10]]).expect("finite");
    let x = [0.0, 10.0, 0.0, 10.0];
    let at = |outside, q| Interpolator::linear(&d).outside(outside).value(q, &x).expect("finite");
    assert_eq!(at(Outside::Hull, [5.0, -1e-9]), Some(5.0));
    assert_eq!(at(Outside::Nearest, [4.0, -1e-9]), Some(0.0));
    assert_eq!(at(Outside::Nothing, [5.0, -1e-9]), None);
    assert_eq!(at(Outside::Nothing, [5.0, -1e-15]), Some(5.0));
    assert_eq!(at(Outside::Hull, [20.0, 20.0]), Some(10.0));
    let mut nearest = Interpolator::nearest(&d).outside(Outside::Hull);
    assert_eq!(nearest.value([4.0, -3.0], &x), Ok(Some(0.0)));
    let line = Delaunay2::from_points(&[[0, 0], [4, 4]]).expect("finite");
    let mut f = Interpolator::linear(&line).outside(Outside::Hull);
    assert_eq!(f.value([3.0, 4.0], &[1.0, 2.0]), Ok(Some(2.0)));
    assert_eq!(Interpolator::linear(&line).value([3.0, 4.0], &[1.0, 2.0]), Ok(None));
}

/// Many points at once have the values of one after the other, on the border, beside it and far away.
#[test]
fn many_points_around_the_border() {
    let points = Kind::Circle.points(50, 3);
    let d = Delaunay2::from_points(&points).expect("finite");
    let heights: Vec<f64> = points.iter().map(|&p| linear(p)).collect();
    let hull: Vec<[f64; 2]> = d.hull_vertices().map(|v| d.point(v)).collect();
    let mut random = Random::new(4);
    let at = |_| {
        let i = random.below(hull.len());
        let share = random.unit();
        let q = blend(&[hull[i], hull[(i + 1) % hull.len()]], &[share, 1.0 - share]);
        q.map(|x| if random.below(3) == 0 { x * (1.0 + random.unit()) } else { x })
    };
    let queries: Vec<[f64; 2]> = (0..2000).map(at).collect();
    let mut f = Interpolator::linear(&d);
    let together = f.many(&queries, &heights, 1).expect("finite");
    for (&q, value) in queries.iter().zip(together) {
        let alone = f.value(q, &heights).expect("finite").unwrap_or(f64::NAN);
        assert_eq!(alone.to_bits(), value.to_bits(), "{q:?}");
    }
}
