//! Periodic triangulations: closed, invariant, and equal to a definition by brute force.

use std::collections::{BTreeMap, BTreeSet};

use delone::{
    CellularKind, Dimension, Error, Grid, Image, Lattice2, Lattice3, LatticeProblem, Periodic, Periodic2,
    Periodic3, PeriodicKind, PeriodicRegular2, PeriodicRegular3, VertexId,
};
use delone_generators::Random;
use delone_predicates::{Sign, in_power_sphere, in_sphere, orient3d};

/// On a grid of its inverse the coordinates of these tests are exact.
const FINE: f64 = (1 << 20) as f64;

/// Corners up to translation and order: seen from each corner, in order, and the least of these.
fn standing<const D: usize>(corners: &[Image<D>]) -> Vec<(usize, [i64; D])> {
    let from = |k: usize| {
        let seen = corners.iter().map(|c| (c.0.index(), std::array::from_fn(|i| c.1[i] - corners[k].1[i])));
        let mut seen: Vec<(usize, [i64; D])> = seen.collect();
        seen.sort_unstable();
        seen
    };
    (0..corners.len()).map(from).min().expect("corners")
}

fn simplices<T: PeriodicKind<D, N>, const D: usize, const N: usize>(
    t: &Periodic<T, D, N>,
) -> BTreeSet<Vec<(usize, [i64; D])>> {
    let all: BTreeSet<_> = t.simplices().map(|corners| standing(&corners)).collect();
    assert_eq!(all.len(), t.simplex_count());
    all
}

/// Every facet has two sides, neighbors are mutual, and Euler's number is zero.
fn check_closed<T: PeriodicKind<D, N>, const D: usize, const N: usize>(t: &Periodic<T, D, N>) {
    let mut facets: BTreeMap<Vec<(usize, [i64; D])>, usize> = BTreeMap::new();
    for number in 0..t.simplex_count() {
        let corners = t.simplex(number);
        let neighbors = t.neighbors(number);
        for (k, neighbor) in neighbors.into_iter().enumerate() {
            let facet: Vec<Image<D>> = (0..N).filter(|&i| i != k).map(|i| corners[i]).collect();
            *facets.entry(standing(&facet)).or_default() += 1;
            let (other, offset) = neighbor.expect("periodic along all axes");
            let there = t.simplex(other).map(|(site, o)| (site, std::array::from_fn(|i| o[i] + offset[i])));
            assert!(facet.iter().all(|corner| there.contains(corner)), "{corners:?} {k} {there:?}");
            let back = t.neighbors(other);
            let opposite = offset.map(|x| -x);
            assert!(back.contains(&Some((number, opposite))), "{corners:?} {k} {there:?}");
        }
    }
    assert!(facets.values().all(|&sides| sides == 2));
    let counts = t.face_counts();
    let euler: i64 =
        counts.iter().enumerate().map(|(k, &c)| if k % 2 == 0 { c as i64 } else { -(c as i64) }).sum();
    assert_eq!(euler, 0, "{counts:?}");
    assert_eq!(counts[N - 1], t.simplex_count());
    assert_eq!(counts[N - 2], facets.len());
    assert_eq!(counts[1], t.edges().count());
}

fn random_points<const D: usize>(n: usize, sides: [f64; D], seed: u64) -> Vec<[f64; D]> {
    let mut random = Random::new(seed);
    (0..n).map(|_| sides.map(|side| random.between(0.0, side))).collect()
}

fn volume(t: &Periodic3) -> f64 {
    let tetrahedra = t.simplices().map(|corners| {
        let [a, b, c, d] = corners.map(|c| t.position(c));
        let [u, v, w] = [a, b, c].map(|p| [0, 1, 2].map(|k| p[k] - d[k]));
        let cross = [v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]];
        -(u[0] * cross[0] + u[1] * cross[1] + u[2] * cross[2]) / 6.0
    });
    tetrahedra.map(f64::abs).sum()
}

#[test]
fn random_sets_are_closed_and_fill_the_box() {
    for n in [1, 2, 3, 4, 5, 8, 13, 27, 60, 200, 1000] {
        let sides = [2.0, 3.0, 5.0];
        let lattice = Lattice3::with_sides(sides).expect("a box");
        let t =
            Periodic3::from_points(&random_points(n, sides, n as u64), &lattice).expect("a triangulation");
        check_closed(&t);
        assert!((volume(&t) - 30.0).abs() < 1e-11, "{n} {}", volume(&t));
        let flat = Lattice2::with_sides([2.0, 3.0]).expect("a box");
        let t =
            Periodic2::from_points(&random_points(n, [2.0, 3.0], n as u64), &flat).expect("a triangulation");
        check_closed(&t);
        assert_eq!(t.simplex_count(), 2 * n);
    }
}

/// Every sphere is empty of all copies near it, ties broken as they must be, and the volumes are that of the box: the definition.
fn check_empty(t: &Periodic3, count: usize, wide: i64, axes: [bool; 3]) {
    let range = |axis: usize| if axes[axis] { -wide..=wide } else { 0..=0 };
    for number in 0..t.simplex_count() {
        let corners = t.simplex(number);
        let [a, b, c, d] = corners.map(|corner| t.position(corner));
        for site in (0..count).map(VertexId::new) {
            for offset in range(0).flat_map(|i| range(1).flat_map(move |j| range(2).map(move |k| [i, j, k])))
            {
                let copy = (site, offset);
                if !corners.contains(&copy) {
                    let side = in_sphere(a, b, c, d, t.position(copy));
                    assert_eq!(side, Sign::Negative, "{corners:?} {copy:?}");
                }
            }
        }
        for (k, neighbor) in t.neighbors(number).into_iter().enumerate().filter(|(_, n)| n.is_none()) {
            // On the hull: all sites are on one side.
            let facet: Vec<[f64; 3]> = (0..4).filter(|&i| i != k).map(|i| t.position(corners[i])).collect();
            let apex = orient3d(facet[0], facet[1], facet[2], t.position(corners[k]));
            for site in (0..count).map(VertexId::new) {
                let side = orient3d(facet[0], facet[1], facet[2], t.position((site, [0; 3])));
                assert!(side == apex || side.is_zero(), "{neighbor:?}");
            }
        }
    }
}

#[test]
fn spheres_are_empty_of_all_copies() {
    let tilted = [[4.0, 0.0, 0.0], [1.0, 3.0, 0.0], [-1.0, 1.0, 5.0]];
    let volumes = [60.0; 2];
    for n in [1, 2, 3, 7, 20] {
        for (axes, volume_of_box) in
            [[[3.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 5.0]], tilted].into_iter().zip(volumes)
        {
            let lattice = Lattice3::with_axes(axes).expect("a lattice");
            let mut random = Random::new(n as u64);
            // Half of them with ties: on a coarse grid.
            for coarse in [1.0, 1024.0] {
                let mut points: Vec<[f64; 3]> = Vec::new();
                while points.len() < n {
                    let p = [3.0, 4.0, 5.0].map(|side| (random.between(0.0, side) * coarse).floor() / coarse);
                    if !points.contains(&p) {
                        points.push(p);
                    }
                }
                let t = Periodic3::from_points(&points, &lattice).expect("a triangulation");
                assert_eq!(t.rounding(), 0.0);
                check_closed(&t);
                check_empty(&t, n, 2, [true; 3]);
                assert!((volume(&t) - volume_of_box).abs() < 1e-11);
                for periodic in [[true, true, false], [false, true, true], [true, false, false], [false; 3]] {
                    let t = Periodic3::from_points(&points, &lattice.periodic(periodic))
                        .expect("a triangulation");
                    check_empty(&t, n, 3, periodic);
                }
            }
        }
    }
}

#[test]
fn order_translation_and_axes_do_not_show() {
    let axes = [[3.0, 0.0, 0.0], [1.0, 2.0, 0.0], [0.5, -1.0, 4.0]];
    let lattice = Lattice3::with_axes(axes).expect("a lattice");
    let mut random = Random::new(3);
    for n in [1, 3, 20, 150] {
        let scale = if n == 20 { 4.0 } else { FINE };
        let points: Vec<[f64; 3]> =
            (0..n).map(|_| [(); 3].map(|()| (random.between(-4.0, 4.0) * scale).round() / scale)).collect();
        let t = Periodic3::from_points(&points, &lattice).expect("a triangulation");
        let expected = simplices(&t);

        let shift = [(); 3].map(|()| random.below(1 << 24) as f64 / FINE);
        let moved: Vec<[f64; 3]> = points.iter().map(|p| std::array::from_fn(|k| p[k] + shift[k])).collect();
        let other = Periodic3::from_points(&moved, &lattice).expect("a triangulation");
        assert_eq!(other.duplicates().collect::<Vec<_>>(), t.duplicates().collect::<Vec<_>>());
        assert_eq!(simplices(&other), expected, "{n}");

        let reversed: Vec<[f64; 3]> = points.iter().rev().copied().collect();
        let other = Periodic3::from_points(&reversed, &lattice).expect("a triangulation");
        if t.duplicates().count() == 0 {
            let back = simplices(&other).into_iter().map(|corners| {
                let corners: Vec<Image<3>> =
                    corners.into_iter().map(|(site, offset)| (VertexId::new(n - 1 - site), offset)).collect();
                standing(&corners)
            });
            assert_eq!(back.collect::<BTreeSet<_>>(), expected);
        }

        // Other axes of the same lattice: the second plus thrice the first, the third less the second.
        let sum = |u: [f64; 3], times: f64, v: [f64; 3]| std::array::from_fn(|k| u[k] + times * v[k]);
        let skew = [axes[0], sum(axes[1], 3.0, axes[0]), sum(axes[2], -1.0, axes[1])];
        let skew = Lattice3::with_axes(skew).expect("a lattice");
        let other = Periodic3::from_points(&points, &skew).expect("a triangulation");
        let back = simplices(&other).into_iter().map(|corners| {
            let in_first = |[i, j, k]: [i64; 3]| [i + 3 * j, j - k, k];
            let corners: Vec<Image<3>> =
                corners.into_iter().map(|(site, offset)| (VertexId::new(site), in_first(offset))).collect();
            standing(&corners)
        });
        assert_eq!(back.collect::<BTreeSet<_>>(), expected);
    }
}

fn crystal(basis: &[[f64; 3]], cells: usize, constant: f64) -> (Vec<[f64; 3]>, Lattice3) {
    let mut points = Vec::new();
    for i in 0..cells.pow(3) {
        let cell = [i % cells, i / cells % cells, i / cells / cells].map(|x| x as f64);
        points.extend(basis.iter().map(|b| [0, 1, 2].map(|k| (cell[k] + b[k]) * constant)));
    }
    (points, Lattice3::with_sides([cells as f64 * constant; 3]).expect("a box"))
}

const SC: &[[f64; 3]] = &[[0.0; 3]];
const BCC: &[[f64; 3]] = &[[0.0; 3], [0.5; 3]];
const FCC: &[[f64; 3]] = &[[0.0; 3], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]];

#[test]
fn crystals_have_six_tetrahedra_a_site() {
    for basis in [SC, BCC, FCC] {
        for cells in 1..=4 {
            let (points, lattice) = crystal(basis, cells, 1.0);
            let t = Periodic3::from_points(&points, &lattice).expect("a triangulation");
            check_closed(&t);
            assert_eq!(t.simplex_count(), 6 * points.len());
            assert_eq!(t.edges().count(), 7 * points.len());
            assert!(!t.is_simplicial() || cells > 2, "{cells}");
            assert!(t.is_simplicial() || cells < 4, "{cells}");
            // At a constant that is no sum of powers of two they are no crystals, but on their decimal grid.
            let (points, lattice) = crystal(basis, cells, 3.639);
            let t = Periodic3::from_points(&points, &lattice.grid(Grid::Auto)).expect("a triangulation");
            assert_eq!(t.simplex_count(), 6 * points.len());
            assert!(t.rounding() < 1e-14 && t.decimal_step().is_some_and(|step| step >= 1e-4));
            check_closed(&t);
        }
    }
}

#[test]
fn weights_move_the_borders_of_cells() {
    let lattice =
        Lattice3::with_axes([[4.0, 0.0, 0.0], [1.0, 3.0, 0.0], [-1.0, 1.0, 5.0]]).expect("a lattice");
    let flat = Lattice2::with_axes([[4.0, 0.0], [1.0, 3.0]]).expect("a lattice");
    let mut hidden = 0;
    for n in [1, 2, 5, 40] {
        let mut random = Random::new(n as u64);
        let points: Vec<[f64; 3]> =
            (0..n).map(|_| [(); 3].map(|()| (random.between(0.0, 4.0) * 64.0).round() / 64.0)).collect();
        let plain = Periodic3::from_points(&points, &lattice).expect("a triangulation");
        let equal = PeriodicRegular3::from_parts(&points, &vec![2.5; n], &lattice).expect("a triangulation");
        assert_eq!(simplices(&plain), simplices(&equal));

        let weights: Vec<f64> = (0..n).map(|_| (random.between(0.0, 3.0) * 16.0).round() / 16.0).collect();
        let t = PeriodicRegular3::from_parts(&points, &weights, &lattice).expect("a triangulation");
        check_closed(&t);
        hidden += t.hidden().count();
        assert_eq!(t.vertices().count() + t.hidden().count() + t.duplicates().count(), n);
        for corners in t.simplices() {
            let site = |copy: Image<3>| (t.position(copy), weights[copy.0.index()]);
            let [a, b, c, d] = corners.map(site);
            for i in 0..n * 125 {
                let offset = [i / n % 5, i / n / 5 % 5, i / n / 25].map(|x| x as i64 - 2);
                let copy = (VertexId::new(i % n), offset);
                if !corners.contains(&copy) && t.duplicates().all(|twin| twin.0 != copy.0) {
                    assert_eq!(
                        in_power_sphere(a, b, c, d, site(copy)),
                        Sign::Negative,
                        "{corners:?} {copy:?}"
                    );
                }
            }
        }
        let below: Vec<[f64; 2]> = points.iter().map(|p| [p[0], p[1]]).collect();
        check_closed(&PeriodicRegular2::from_parts(&below, &weights, &flat).expect("a triangulation"));
    }
    assert!(hidden > 5, "{hidden}");
}

#[test]
fn copies_of_a_site_are_duplicates() {
    let lattice = Lattice2::with_axes([[2.0, 0.0], [1.0, 3.0]]).expect("a lattice");
    let points = [[0.0, 0.0], [0.5, 1.0], [3.0, 3.0], [0.5, 1.0], [2e9, 3e9]];
    let t = Periodic2::from_points(&points, &lattice).expect("a triangulation");
    let twins: Vec<_> = t.duplicates().map(|(v, (w, offset))| (v.index(), w.index(), offset)).collect();
    assert_eq!(twins, [(2, 0, [1, 1]), (3, 1, [0, 0]), (4, 0, [500_000_000, 1_000_000_000])]);
    assert_eq!((t.vertices().count(), t.simplex_count(), t.ids_given()), (2, 4, 5));
    for (v, image) in t.duplicates() {
        assert_eq!(t.position(image), points[v.index()]);
    }
    check_closed(&t);
}

#[test]
fn flat_sets_have_no_simplices() {
    let slab = Lattice3::with_sides([1.0; 3]).expect("a box").periodic([true, true, false]);
    let t = Periodic3::from_points(&[[0.25, 0.5, 7.0], [0.75, 0.5, 7.0]], &slab).expect("a triangulation");
    assert_eq!((t.dimension(), t.simplex_count()), (Dimension::Plane, 0));
    let t = Periodic3::from_points(&[[0.25, 0.5, 7.0], [0.75, 0.5, 7.5]], &slab).expect("a triangulation");
    assert!(t.simplex_count() > 0);
    let none = Periodic3::from_points(&[], &slab).expect("a triangulation");
    assert_eq!((none.simplex_count(), none.vertices().count()), (0, 0));
    // A needle, and a box of one site.
    let needle = Lattice3::with_sides([1.0, 1000.0, 1.0]).expect("a box");
    let t = Periodic3::from_points(&[[0.1, 0.2, 0.3]], &needle).expect("a triangulation");
    check_closed(&t);
    assert_eq!(t.simplex_count(), 6);
    let hair = Lattice3::with_sides([1e-9, 1.0, 1.0]).expect("a box");
    check_closed(&Periodic3::from_points(&[[0.0; 3]], &hair).expect("a triangulation"));
}

#[test]
fn bad_lattices_and_points_are_named() {
    let problem = |axes| match Lattice3::with_axes(axes) {
        Err(Error::Lattice { axis, problem }) => (axis, problem),
        other => panic!("{other:?}"),
    };
    let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(problem([y, x, z]), (2, LatticeProblem::LeftHanded));
    assert_eq!(problem([x, x, z]).1, LatticeProblem::Dependent);
    assert_eq!(problem([x, [0.1, 0.2, 0.0], [0.3, 0.6, 0.0]]).1, LatticeProblem::Dependent);
    assert_eq!(problem([x, [0.0; 3], z]), (1, LatticeProblem::Dependent));
    assert_eq!(problem([x, [f64::NAN; 3], z]), (1, LatticeProblem::NotFinite));
    assert_eq!(problem([[1e200, 0.0, 0.0], y, z]), (0, LatticeProblem::Range));
    for side in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        let error = Lattice3::with_sides([1.0, side, 1.0]).expect_err("no side");
        assert_eq!(error, Error::Lattice { axis: 1, problem: LatticeProblem::Side });
    }
    let cube = Lattice3::with_sides([1.0; 3]).expect("a box");
    let points = [[0.0; 3], [0.5, f64::NAN, 0.0]];
    assert!(matches!(
        Periodic3::from_points(&points, &cube),
        Err(Error::NotFinite { index: 1, axis: 1, .. })
    ));
    let far = Periodic3::from_points(&[[0.0, 0.0, 1e300]], &cube);
    assert!(matches!(far, Err(Error::FarAway { index: 0, axis: 2, .. })), "{far:?}");
    let few = PeriodicRegular3::from_parts(&[[0.0; 3]], &[], &cube);
    assert!(matches!(few, Err(Error::Length { expected: 1, found: 0 })));
}

/// Powers of two change nothing; a box and its axes given by hand are one.
#[test]
fn scales_do_not_show() {
    let points = random_points(40, [1.0, 2.0, 3.0], 11);
    let expected = simplices(
        &Periodic3::from_points(&points, &Lattice3::with_sides([1.0, 2.0, 3.0]).expect("a box"))
            .expect("a triangulation"),
    );
    for exponent in [-300, -30, 1, 300] {
        let scale = 2f64.powi(exponent);
        let scaled: Vec<[f64; 3]> = points.iter().map(|p| p.map(|x| x * scale)).collect();
        let lattice = Lattice3::with_sides([1.0, 2.0, 3.0].map(|x| x * scale)).expect("a box");
        assert_eq!(simplices(&Periodic3::from_points(&scaled, &lattice).expect("a triangulation")), expected);
    }
}

/// Cells tile the box: volumes add up, centroids are inside, and each face is one of the cell beyond it too, seen from there.
fn check_cells<T: CellularKind<3, 4>>(t: &Periodic<T, 3, 4>, volume_of_box: f64) -> usize {
    let cells = t.cells().expect("walls");
    let sites = 0..t.ids_given();
    let volume: f64 = sites.clone().map(|i| cells.cell(VertexId::new(i)).volume()).sum();
    assert!((volume / volume_of_box - 1.0).abs() < 1e-12, "{volume} {volume_of_box}");
    let (mut faces, mut walls) = (BTreeMap::new(), 0);
    for site in sites.map(VertexId::new) {
        let cell = cells.cell(site);
        let rings = cell.rings();
        let corners: Vec<[f64; 3]> = cell.corners().collect();
        // Euler's number of a ball.
        let sides: usize = rings.iter().map(Vec::len).sum();
        assert!(rings.is_empty() || corners.len() + rings.len() == sides / 2 + 2);
        let at = t.position((site, [0; 3]));
        let mut flux = [0.0; 3];
        for (face, ring) in cell.faces().zip(&rings) {
            assert!(face.points().eq(ring.iter().map(|&i| corners[i])));
            let Some((other, offset)) = face.neighbor() else {
                walls += 1;
                let normal = face.normal().expect("an area");
                flux = std::array::from_fn(|k| flux[k] + face.area() * normal[k]);
                continue;
            };
            let copy = t.position((other, offset));
            let vector = face.vector().expect("a site");
            let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
            for k in 0..3 {
                assert!((copy[k] - at[k] - vector[k]).abs() < 1e-12);
                flux[k] += face.area() * vector[k] / length;
            }
            assert!(faces.insert((site, other, offset), face.area()).is_none());
        }
        // Closed.
        assert!(flux.iter().all(|x| x.abs() < 1e-9), "{flux:?}");
        assert_eq!(cell.centroid().is_some(), !rings.is_empty());
    }
    for ((site, other, offset), area) in &faces {
        let back = faces.get(&(*other, *site, offset.map(|x| -x)));
        assert!(back.is_some_and(|back| (back - area).abs() < 1e-9), "{site:?} {other:?} {offset:?}");
    }
    walls
}

#[test]
fn cells_tile_the_box() {
    let tilted = [[4.0, 0.0, 0.0], [1.0, 3.0, 0.0], [-1.0, 1.0, 5.0]];
    for axes in [[[3.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 5.0]], tilted] {
        let lattice = Lattice3::with_axes(axes).expect("a lattice");
        for n in [1, 2, 3, 10, 100] {
            // Some of them outside of the box.
            let points = random_points(n, [9.0, 4.0, 5.0], n as u64);
            check_cells(&Periodic3::from_points(&points, &lattice).expect("a triangulation"), 60.0);
            let mut random = Random::new(1);
            let weights: Vec<f64> = (0..n).map(|_| random.between(0.0, 1.0)).collect();
            let t = PeriodicRegular3::from_parts(&points, &weights, &lattice).expect("a triangulation");
            check_cells(&t, 60.0);
            for periodic in [[true, true, false], [false, true, true], [false, true, false], [false; 3]] {
                for origin in [[0.0; 3], [0.0, 0.5, -1.0]] {
                    let lattice = lattice.periodic(periodic).origin(origin);
                    let t = Periodic3::from_points(&points, &lattice).expect("a triangulation");
                    let walls = check_cells(&t, 60.0);
                    assert!(walls >= 2 * periodic.iter().filter(|x| !**x).count(), "{periodic:?} {walls}");
                    let t =
                        PeriodicRegular3::from_parts(&points, &weights, &lattice).expect("a triangulation");
                    check_cells(&t, 60.0);
                }
            }
        }
    }
    for (basis, faces) in [(SC, 6), (BCC, 14), (FCC, 12)] {
        for constant in [1.0, 0.3, 3.639] {
            let (points, lattice) = crystal(basis, 3, constant);
            let t = Periodic3::from_points(&points, &lattice.grid(Grid::Auto)).expect("a triangulation");
            let volume = constant.powi(3) / basis.len() as f64;
            let cells = t.cells().expect("no walls");
            for site in t.vertices() {
                assert_eq!(cells.cell(site).faces().len(), faces);
                assert!((cells.cell(site).volume() - volume).abs() < 1e-14 * volume);
            }
            check_cells(&t, (3.0 * constant).powi(3));
        }
    }
}

/// Walls are where they are, whatever grid the points are on; and what moves is told.
#[test]
fn grids_leave_walls_where_they_are() {
    let points: Vec<[f64; 3]> =
        (0..64).map(|i| [i % 4, i / 4 % 4, i / 16].map(|x| 0.1 * f64::from(x) + 0.1)).collect();
    let tenths = Grid::Decimal(delone::DecimalGrid::with_step(0.1).expect("a step"));
    let sum = |t: &Periodic3| -> f64 {
        let cells = t.cells().expect("cells");
        t.vertices().map(|v| cells.cell(v).volume()).sum()
    };
    for grid in [Grid::Binary, Grid::Auto, tenths] {
        for (sides, origin) in
            [([0.55, 0.5, 0.527], [0.0; 3]), ([0.5; 3], [0.0123; 3]), ([1.25; 3], [-0.77; 3])]
        {
            let lattice = Lattice3::with_sides(sides).expect("a box").origin(origin).grid(grid);
            let t = Periodic3::from_points(&points, &lattice.periodic([false; 3])).expect("points");
            let whole: f64 = sides.iter().product();
            assert!((sum(&t) / whole - 1.0).abs() < 1e-13, "{grid:?} {sides:?}: {}", sum(&t));
            let cells = t.cells().expect("cells");
            let mut walls: Vec<[f64; 3]> = Vec::new();
            for v in t.vertices() {
                let cell = cells.cell(v);
                for face in cell.faces().filter(|face| face.neighbor().is_none()) {
                    walls.extend(face.points());
                }
            }
            for k in 0..3 {
                let least = walls.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
                assert!((least - origin[k]).abs() < 1e-15, "{grid:?} {sides:?}: {least}");
            }
        }
    }
    // An axis that repeats has to be on the grid.
    let t =
        Periodic3::from_points(&points, &Lattice3::with_sides([0.5, 0.5, 0.54]).expect("a box").grid(tenths));
    let t = t.expect("points");
    assert!((sum(&t) - 0.125).abs() < 1e-13 && (t.rounding() - 0.04).abs() < 1e-13, "{}", t.rounding());
}
