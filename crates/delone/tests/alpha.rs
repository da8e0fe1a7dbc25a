//! Alpha complexes against their definition over big integers, and what shapes and orders have to be.

use std::collections::BTreeMap;

use delone::{
    Alpha, Delaunay2, Delaunay3, Dimension, Face, Region2, Regular2, Regular3, Triangulation, VertexId,
};
use delone_generators::{Kind, Kind3, Random};
use delone_oracle::alpha::complex;

type Site<const D: usize> = ([f64; D], f64);

/// Families of sites that tie, hide each other, repeat, lie flat, and span the range of numbers.
const FAMILIES: usize = 12;

fn sites<const D: usize>(random: &mut Random, n: usize, family: usize) -> Vec<Site<D>> {
    let mut site = || -> Site<D> {
        let lattice: [f64; D] = std::array::from_fn(|_| random.below(3) as f64);
        let square: f64 = lattice.iter().map(|x| x * x).sum();
        let unit: [f64; D] = std::array::from_fn(|_| random.unit());
        let size = 2f64.powi(random.below(600) as i32 - 300);
        match family {
            0 => (unit, 0.0),
            1 => (lattice, 0.0),
            2 => (lattice, random.below(3) as f64),
            3 => (lattice, square),
            4 => (unit, random.unit() / 4.0),
            5 => (lattice.map(|x| x * 0.1), 0.3),
            // On a line, and in a plane of space.
            6 => (std::array::from_fn(|axis| lattice[0] * (axis + 1) as f64), random.below(2) as f64),
            7 => (
                std::array::from_fn(|axis| if axis == 2 { lattice[0] - lattice[1] } else { lattice[axis] }),
                0.0,
            ),
            8 => (unit.map(|x| (x - 0.5) * size), 0.0),
            9 => (unit.map(|x| x * 1e-310), random.unit() * 1e-320),
            10 => (unit.map(|x| (x - 0.5) * 1e308), (random.unit() - 0.5) * 1e308),
            _ => (std::array::from_fn(|axis| lattice[axis] + unit[axis] * 1e-14), 0.0),
        }
    };
    (0..n).map(|_| site()).collect()
}

/// Faces by their corners.
fn faces<const D: usize>(alpha: &Alpha<D>) -> BTreeMap<Vec<usize>, f64> {
    let indices = |face: &Face| face.corners().iter().map(|v| v.index()).collect();
    alpha.filtration().map(|face| (indices(&face), face.value)).collect()
}

/// The simplices of what the points span, by index.
fn simplices<T: Triangulation>(t: &T) -> Vec<Vec<usize>> {
    let indices = |corners: &[VertexId]| corners.iter().map(|v| v.index()).collect::<Vec<_>>();
    let full: Vec<_> = t.simplices().map(|s| indices(t.corners(s).as_ref())).collect();
    if !full.is_empty() {
        return full;
    }
    match t.dimension() {
        Dimension::Plane => t.hull_facets().map(|facet| indices(facet.as_ref())).collect(),
        Dimension::Line => t.edges().map(|edge| indices(&edge)).collect(),
        _ => t.vertices().map(|v| indices(&[v])).collect(),
    }
}

fn judge<const D: usize>(t: &impl Triangulation, alpha: &Alpha<D>, sites: &[Site<D>], what: &str) {
    let expected = complex(sites, &simplices(t));
    let found = faces(alpha);
    assert!(found.keys().eq(expected.keys()), "{what}: {sites:?}");
    for ((face, value), size) in found.iter().zip(expected.values()) {
        assert!(size.is_rounded_to(*value), "{what}: {face:?} {value:e} {sites:?}");
    }
    check_order(alpha, what);
}

/// By value, dimension and corners; every side before what it is a side of; each dimension as it is given by itself.
fn check_order<const D: usize>(alpha: &Alpha<D>, what: &str) {
    let all: Vec<Face> = alpha.filtration().collect();
    let key = |face: &Face| (face.corners().len(), face.corners().to_vec());
    assert!(all.is_sorted_by(|a, b| a.value < b.value || (a.value == b.value && key(a) < key(b))), "{what}");
    let values = faces(alpha);
    for (face, value) in values.iter().filter(|(face, _)| face.len() > 1) {
        for k in 0..face.len() {
            let mut side = face.clone();
            side.remove(k);
            assert!(values[&side] <= *value, "{what}: {side:?} {:e} {face:?} {value:e}", values[&side]);
        }
    }
    for dimension in 0..4 {
        let own = all.iter().filter(|face| face.corners().len() == dimension + 1);
        assert!(own.map(|face| face.value).eq(alpha.values(dimension).iter().copied()), "{what}");
    }
    let complex = alpha.all();
    assert_eq!(complex.euler_characteristic(), i64::from(!complex.vertices.is_empty()), "{what}");
    assert!(alpha.complex(f64::NAN).vertices.is_empty() && alpha.values(4).is_empty());
}

#[test]
fn values_are_those_of_the_definition() {
    let mut random = Random::new(1);
    for round in 0..240 {
        let (family, n) = (round % FAMILIES, round % 11);
        let what = format!("family {family}, round {round}");
        let flat: Vec<Site<2>> = sites(&mut random, n, family);
        let r = Regular2::from_sites(&flat).expect("finite");
        judge(&r, &r.alpha(), &flat, &what);
        let solid: Vec<Site<3>> = sites(&mut random, n, family);
        let r = Regular3::from_sites(&solid).expect("finite");
        judge(&r, &r.alpha(), &solid, &what);
        // Without weights by both types.
        let (points2, points3): (Vec<_>, Vec<_>) = flat.iter().zip(&solid).map(|(p, q)| (p.0, q.0)).unzip();
        let (plain2, plain3) = (points2.iter().map(|&p| (p, 0.0)), points3.iter().map(|&p| (p, 0.0)));
        let d = Delaunay2::from_points(&points2).expect("finite");
        judge(&d, &d.alpha(), &plain2.clone().collect::<Vec<_>>(), &what);
        let weighted = Regular2::from_sites(&plain2.collect::<Vec<_>>()).expect("finite").alpha();
        assert_eq!(faces(&d.alpha()), faces(&weighted), "{what}");
        let d = Delaunay3::from_points(&points3).expect("finite");
        judge(&d, &d.alpha(), &plain3.clone().collect::<Vec<_>>(), &what);
        let weighted = Regular3::from_sites(&plain3.collect::<Vec<_>>()).expect("finite").alpha();
        assert_eq!(faces(&d.alpha()), faces(&weighted), "{what}");
    }
}

/// Every named set, in space and in the plane: in order, and the same for the points in another order.
#[test]
fn every_set_has_one_filtration() {
    let mut random = Random::new(2);
    for &kind in Kind::ALL {
        let points = kind.points(300, 3);
        let mut order: Vec<usize> = (0..points.len()).collect();
        random.shuffle(&mut order);
        let shuffled: Vec<[f64; 2]> = order.iter().map(|&i| points[i]).collect();
        let [one, other] = [&points, &shuffled].map(|p| Delaunay2::from_points(p).expect("finite").alpha());
        check_order(&one, kind.name());
        assert!(by_points(&one) == by_points(&other), "{}", kind.name());
    }
    for &kind in Kind3::ALL {
        let points = kind.points(300, 3);
        let mut order: Vec<usize> = (0..points.len()).collect();
        random.shuffle(&mut order);
        let shuffled: Vec<[f64; 3]> = order.iter().map(|&i| points[i]).collect();
        let [one, other] = [&points, &shuffled].map(|p| Delaunay3::from_points(p).expect("finite").alpha());
        check_order(&one, kind.name());
        assert!(by_points(&one) == by_points(&other), "{}", kind.name());
    }
}

/// Faces by the coordinates of their corners, in bits.
fn by_points<const D: usize>(alpha: &Alpha<D>) -> BTreeMap<Vec<[u64; D]>, u64> {
    let name = |face: &Face| {
        let mut corners: Vec<_> =
            face.corners().iter().map(|&v| alpha.position(v).map(|x| (x + 0.0).to_bits())).collect();
        corners.sort_unstable();
        corners
    };
    alpha.filtration().map(|face| (name(&face), face.value.to_bits())).collect()
}

#[test]
fn threads_do_not_show() {
    let points = Kind3::Ball.points(6_000, 1);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let alpha = Delaunay3::from_points(&points).expect("finite").alpha();
            let all: Vec<_> =
                alpha.filtration().map(|face| (face.value.to_bits(), face.corners().to_vec())).collect();
            (all, alpha.outline(1e-3), alpha.optimal(1))
        })
    };
    assert!(with(1) == with(3));
}

/// Points beside a curve or on a surface: at a radius between their distance and the size of holes the complex has its shape.
#[test]
fn shapes_have_their_euler_characteristic() {
    let step = std::f64::consts::TAU / 60.0;
    let ring = |k: usize, radius: f64| {
        let angle = step * k as f64;
        [radius * angle.cos(), radius * angle.sin()]
    };
    let annulus: Vec<[f64; 2]> = (0..60).flat_map(|k| [ring(k, 1.0), ring(k, 1.15)]).collect();
    let alpha = Delaunay2::from_points(&annulus).expect("finite").alpha();
    assert_eq!(alpha.complex(0.02).euler_characteristic(), 0);
    let [part] = &alpha.outline(0.02)[..] else { panic!("one part") };
    assert_eq!(part.iter().map(Vec::len).collect::<Vec<_>>(), [60, 60]);
    // A torus, solid where tubes are filled, its surface before that.
    let torus: Vec<[f64; 3]> = (0..60)
        .flat_map(|k| (0..20).map(move |l| (k, 3.0 * step * f64::from(l))))
        .map(|(k, tube)| {
            let [x, y] = ring(k, 3.0 + tube.cos());
            [x, y, tube.sin()]
        })
        .collect();
    let alpha = Delaunay3::from_points(&torus).expect("finite").alpha();
    assert_eq!(alpha.complex(0.1).euler_characteristic(), 0);
    assert_eq!(alpha.complex(1.3).euler_characteristic(), 0);
    assert_eq!(surface_genus(&alpha.outline(1.3)), 0);
    let mut random = Random::new(3);
    let mut clusters: Vec<[f64; 2]> = Vec::new();
    for center in [0.0, 10.0] {
        clusters.extend((0..200).map(|_| [center + random.unit(), random.unit()]));
    }
    let alpha = Delaunay2::from_points(&clusters).expect("finite").alpha();
    let labels = alpha.components(1.0);
    assert!((0..400).all(|i| labels[i] == Some(i / 200)));
    assert_eq!(alpha.complex(1.0).euler_characteristic(), 2);
    assert_eq!(alpha.outline(alpha.optimal(2).expect("spans the plane")).len(), 2);
}

/// Vertices less edges plus triangles of a surface.
fn surface_genus(surface: &[[VertexId; 3]]) -> i64 {
    let mut corners: Vec<VertexId> = surface.iter().flatten().copied().collect();
    corners.sort_unstable();
    corners.dedup();
    corners.len() as i64 - surface.len() as i64 / 2
}

/// Outlines are borders that a validator accepts, with the area of the triangles.
#[test]
fn outlines_are_polygons() {
    let mut random = Random::new(4);
    for round in 0..300 {
        let side = 3 + round % 9;
        let points: Vec<[f64; 2]> =
            (0..6 * side).map(|_| [random.below(side) as f64, random.below(side) as f64]).collect();
        let alpha = Delaunay2::from_points(&points).expect("finite").alpha();
        let spectrum = alpha.spectrum();
        let value = spectrum[random.below(spectrum.len())];
        let triangles = alpha.complex(value).triangles;
        let twice = |[a, b, c]: [[f64; 2]; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let expected: f64 = triangles.iter().map(|t| twice(t.map(|v| alpha.position(v))).abs() / 2.0).sum();
        let outline = alpha.outline(value);
        let place = |ring: &Vec<VertexId>| ring.iter().map(|&v| alpha.position(v)).collect::<Vec<_>>();
        let rings: Vec<Vec<[f64; 2]>> = outline.iter().flatten().map(place).collect();
        assert_eq!(rings.is_empty(), triangles.is_empty());
        if rings.is_empty() {
            continue;
        }
        let region = Region2::polygon(&rings).unwrap_or_else(|error| panic!("{error}: {points:?} {value}"));
        assert_eq!(region.area(), expected, "{points:?} {value}");
        // Outer rings first and counter-clockwise, holes clockwise; each part by itself.
        let shoelace = |ring: &[[f64; 2]]| {
            (1..ring.len() - 1).map(|i| twice([ring[0], ring[i], ring[i + 1]]) / 2.0).sum::<f64>()
        };
        let mut sum = 0.0;
        for part in &outline {
            let areas: Vec<f64> = part.iter().map(|ring| shoelace(&place(ring))).collect();
            assert!(areas[0] > 0.0 && areas[1..].iter().all(|&area| area < 0.0), "{points:?} {value}");
            let alone: Vec<_> = part.iter().map(place).collect();
            let area = Region2::polygon(&alone).expect("a polygon").area();
            assert_eq!(area, areas.iter().sum::<f64>(), "{points:?} {value}");
            sum += area;
        }
        assert_eq!(sum, expected);
        assert_eq!(outline.len(), solid_parts(triangles), "{points:?} {value}");
    }
}

/// Surfaces are closed and around as much as the tetrahedra have.
#[test]
fn surfaces_are_closed() {
    let mut random = Random::new(5);
    for round in 0..200 {
        let side = 2 + round % 4;
        let points: Vec<[f64; 3]> =
            (0..30).map(|_| std::array::from_fn(|_| random.below(side) as f64)).collect();
        let alpha = Delaunay3::from_points(&points).expect("finite").alpha();
        let spectrum = alpha.spectrum();
        let value = spectrum[random.below(spectrum.len())];
        let surface = alpha.outline(value);
        let six = |corners: [[f64; 3]; 4]| {
            let [a, b, c] =
                [1, 2, 3].map(|i| std::array::from_fn(|axis| corners[i][axis] - corners[0][axis]));
            let [x, y, z]: [f64; 3] = a;
            let ([p, q, r], [s, t, u]): ([f64; 3], [f64; 3]) = (b, c);
            x * (q * u - r * t) - y * (p * u - r * s) + z * (p * t - q * s)
        };
        let tetrahedra = alpha.complex(value).tetrahedra;
        let expected: f64 = tetrahedra.iter().map(|t| six(t.map(|v| alpha.position(v))).abs()).sum();
        let inside = surface.iter().map(|f| {
            let [a, b, c] = f.map(|v| alpha.position(v));
            six([[0.0; 3], a, b, c])
        });
        assert_eq!(inside.sum::<f64>(), expected, "{points:?} {value}");
        let mut balance: BTreeMap<[VertexId; 2], i32> = BTreeMap::new();
        for [a, b, c] in surface {
            for [v, w] in [[a, b], [b, c], [c, a]] {
                *balance.entry([v.min(w), v.max(w)]).or_default() += if v < w { 1 } else { -1 };
            }
        }
        assert!(balance.values().all(|&balance| balance == 0), "{points:?} {value}");
    }
}

/// Parts of simplices that share sides, by flooding.
fn solid_parts<const N: usize>(simplices: &[[VertexId; N]]) -> usize {
    let mut left: Vec<&[VertexId; N]> = simplices.iter().collect();
    let mut parts = 0;
    while let Some(first) = left.pop() {
        parts += 1;
        let mut border = vec![first];
        while let Some(simplex) = border.pop() {
            let is_near =
                |other: &&[VertexId; N]| other.iter().filter(|v| simplex.contains(v)).count() == N - 1;
            border.extend(left.extract_if(.., |other| is_near(other)));
        }
    }
    parts
}

/// The least radius that covers all vertices in few parts, against a trial of every value.
#[test]
fn the_optimal_radius_is_the_least() {
    let mut random = Random::new(6);
    for round in 0..60 {
        let points: Vec<[f64; 3]> =
            sites(&mut random, 14, round % 2).into_iter().map(|site| site.0).collect();
        let alpha = Delaunay3::from_points(&points).expect("finite").alpha();
        for parts in 0..4 {
            let holds = |&value: &f64| {
                let complex = alpha.complex(value);
                let has = |v: &VertexId| complex.tetrahedra.iter().any(|t| t.contains(v));
                alpha.all().vertices.iter().flatten().all(has) && solid_parts(complex.tetrahedra) <= parts
            };
            let expected = alpha.spectrum().into_iter().find(holds).filter(|_| parts > 0);
            let expected = expected.filter(|_| !alpha.all().tetrahedra.is_empty());
            assert_eq!(alpha.optimal(parts), expected, "{parts} {points:?}");
        }
    }
}

#[test]
fn sets_that_span_little_have_what_there_is() {
    let none = Delaunay2::new().alpha();
    assert_eq!((none.filtration().count(), none.optimal(1), none.spectrum().len()), (0, None, 0));
    let line = Delaunay3::from_points(&[[0, 0, 0], [2, 0, 0], [6, 0, 0]]).expect("finite").alpha();
    assert_eq!((line.values(1), line.optimal(1)), (&[1.0, 4.0][..], None));
    assert_eq!(line.components(1.0), [Some(0), Some(0), Some(1)]);
    assert!(line.outline(9.0).is_empty());
    // A duplicate, and one that is hidden, are in no component.
    let sites = [([0.0, 0.0], 1.0), ([0.0, 0.0], 1.0), ([0.1, 0.0], 0.0), ([9.0, 0.0], 0.0)];
    let alpha = Regular2::from_sites(&sites).expect("finite").alpha();
    assert_eq!(alpha.components(-0.5), [Some(0), None, None, None]);
    assert_eq!(alpha.values(0), [-1.0, 0.0]);
    let far = Delaunay2::from_points(&[[1e300, 0.0], [-1e300, 0.0], [0.0, 1e-300]]).expect("finite").alpha();
    assert!(far.values(1).iter().all(|&value| value == f64::INFINITY));
}
