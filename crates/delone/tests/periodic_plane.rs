//! Cells of periodic sets of the plane: they tile the box, and are those of enough copies.

use std::collections::BTreeMap;

use delone::{
    AcrossPeriodic2, CellularKind, Delaunay2, Grid, Lattice2, Periodic, Periodic2, PeriodicRegular2, Region2,
    Regular2, VertexId,
};
use delone_generators::Random;

type Point = [f64; 2];

fn random_points(n: usize, sides: Point, seed: u64) -> Vec<Point> {
    let mut random = Random::new(seed);
    (0..n).map(|_| sides.map(|side| random.between(0.0, side))).collect()
}

fn area(ring: &[Point]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    // From the first corner: rings may be far from the origin.
    let at = |p: &Point| [p[0] - ring[0][0], p[1] - ring[0][1]];
    ring.iter().zip(next).map(|(p, q)| at(p)[0] * at(q)[1] - at(p)[1] * at(q)[0]).sum::<f64>() / 2.0
}

/// Areas add up to the box, sides are those of the cells beyond them too, and walls are as long as they should be, by axis and end.
fn check<T: CellularKind<2, 3>>(
    t: &Periodic<T, 2, 3>,
    area_of_box: f64,
) -> BTreeMap<(usize, bool), (f64, f64)> {
    let cells = t.cells().expect("a box");
    let (mut sides, mut walls, mut sum) = (BTreeMap::new(), BTreeMap::new(), 0.0);
    let kept = cells.to_cells();
    for site in (0..t.ids_given()).map(VertexId::new) {
        let cell = cells.cell(site);
        sum += cell.area();
        assert!((kept.area(site) - cell.area()).abs() <= 1e-12 * area_of_box);
        let rings = cell.rings();
        let of_rings: f64 = rings.iter().map(|ring| area(ring)).sum();
        assert!((of_rings - cell.area()).abs() <= 1e-12 * area_of_box, "{site:?}");
        assert!(rings.iter().flatten().copied().eq(cell.faces().filter_map(|side| side.points().next())));
        assert_eq!(cell.centroid().is_some(), cell.area() > 0.0);
        let lengths: f64 = cell.faces().map(delone::PeriodicSide2::length).sum();
        assert!((lengths - cell.perimeter()).abs() <= 1e-12 * lengths);
        let at = t.position((site, [0; 2]));
        for side in cell.faces() {
            let normal = side.normal().expect("a length");
            match side.across() {
                AcrossPeriodic2::Site((other, offset)) => {
                    let copy = t.position((other, offset));
                    let vector = side.vector().expect("a site");
                    assert!((0..2).all(|k| (copy[k] - at[k] - vector[k]).abs() < 1e-12), "{site:?}");
                    if side.length() > 1e-6 {
                        let turned = normal[0] * vector[1] - normal[1] * vector[0];
                        assert!(turned.abs() < 1e-8 && normal[0] * vector[0] + normal[1] * vector[1] > 0.0);
                    }
                    assert!(
                        sides.insert((site, other, offset), side.length()).is_none(),
                        "{site:?} {other:?}"
                    );
                }
                AcrossPeriodic2::Wall { axis, is_end } => {
                    let of: &mut (f64, f64) = walls.entry((axis, is_end)).or_default();
                    of.0 += side.length();
                    let far = if is_end { f64::MIN } else { f64::MAX };
                    of.1 = side
                        .points()
                        .map(|p| p[axis])
                        .fold(far, |x, y| if is_end { x.max(y) } else { x.min(y) });
                }
            }
        }
    }
    assert!((sum / area_of_box - 1.0).abs() < 1e-12, "{sum} {area_of_box}");
    for ((site, other, offset), length) in &sides {
        let back = sides.get(&(*other, *site, offset.map(|x| -x)));
        assert!(back.is_some_and(|back| (back - length).abs() < 1e-9), "{site:?} {other:?} {offset:?}");
    }
    walls
}

const BOXES: [[Point; 2]; 3] =
    [[[3.0, 0.0], [0.0, 4.0]], [[4.0, 0.0], [1.0, 3.0]], [[40.0, 0.0], [13.0, 0.3]]];

#[test]
fn cells_tile_the_box() {
    for axes in BOXES {
        let lattice = Lattice2::with_axes(axes).expect("a lattice");
        for n in [1, 2, 3, 10, 300] {
            // Some of them outside of the box.
            let points = random_points(n, [9.0, 4.0], n as u64);
            let mut random = Random::new(1);
            let weights: Vec<f64> = (0..n).map(|_| random.between(0.0, 1.0)).collect();
            for periodic in [[true, true], [true, false], [false, true], [false; 2]] {
                for origin in [[0.0; 2], [0.5, -1.0]] {
                    let lattice = lattice.periodic(periodic).origin(origin);
                    let t = Periodic2::from_points(&points, &lattice).expect("a triangulation");
                    let walls = check(&t, 12.0);
                    for axis in (0..2).filter(|&axis| !periodic[axis]) {
                        let along = axes[1 - axis];
                        let length = along[0].hypot(along[1]);
                        for is_end in [false, true] {
                            let found = walls[&(axis, is_end)].0;
                            assert!(
                                (found / length - 1.0).abs() < 1e-12,
                                "{axes:?} {n} {periodic:?} {found}"
                            );
                        }
                    }
                    let free = periodic.iter().filter(|is_periodic| !**is_periodic).count();
                    assert_eq!(walls.len(), 2 * free);
                    let t =
                        PeriodicRegular2::from_parts(&points, &weights, &lattice).expect("a triangulation");
                    check(&t, 12.0);
                }
            }
        }
    }
    // Where walls are.
    let lattice =
        Lattice2::with_sides([3.0, 4.0]).expect("a box").periodic([true, false]).origin([7.0, -1.0]);
    let t = Periodic2::from_points(&random_points(20, [3.0, 3.0], 1), &lattice).expect("a triangulation");
    let walls = check(&t, 12.0);
    assert_eq!([walls[&(1, false)].1, walls[&(1, true)].1], [-1.0, 3.0]);
    let none = Periodic2::from_points(&[], &lattice).expect("nothing");
    assert_eq!(none.cells().expect("a box").cell(VertexId::new(0)).faces().len(), 0);
}

/// As those of 49 copies, which are enough for boxes that are not thin.
#[test]
fn cells_are_those_of_enough_copies() {
    for (axes, seed) in BOXES[..2].iter().zip(1..) {
        for n in [1, 4, 30] {
            let points = random_points(n, [3.0, 3.0], seed);
            let weights: Vec<f64> = points.iter().map(|p| p[0].fract() / 4.0).collect();
            let shifts = (0..49).map(|i| [i % 7, i / 7].map(|k| f64::from((k + 3) % 7 - 3)));
            let moved = |[i, j]: Point, p: Point| [0, 1].map(|k| p[k] + i * axes[0][k] + j * axes[1][k]);
            let copies: Vec<Point> = shifts.flat_map(|s| points.iter().map(move |&p| moved(s, p))).collect();
            let region = Region2::rectangle([-50.0; 2], [50.0; 2]).expect("a region");
            let plain = Delaunay2::from_points(&copies).expect("points");
            let sites: Vec<_> = copies.iter().enumerate().map(|(i, &p)| (p, weights[i % n])).collect();
            let weighted = Regular2::from_sites(&sites).expect("sites");
            let expected = [plain.voronoi().clip(&region), weighted.power().clip(&region)];
            let lattice = Lattice2::with_axes(*axes).expect("a lattice");
            let plain = Periodic2::from_points(&points, &lattice).expect("a triangulation");
            let weighted =
                PeriodicRegular2::from_parts(&points, &weights, &lattice).expect("a triangulation");
            let found = (plain.cells().expect("cells"), weighted.cells().expect("cells"));
            for site in (0..n).map(VertexId::new) {
                let cells = [
                    (found.0.cell(site).area(), found.0.cell(site).centroid(), found.0.cell(site).rings()),
                    (found.1.cell(site).area(), found.1.cell(site).centroid(), found.1.cell(site).rings()),
                ];
                for ((area, centroid, rings), expected) in cells.into_iter().zip(&expected) {
                    assert!((area - expected.area(site)).abs() < 1e-11, "{area} {}", expected.area(site));
                    let close = |p: Point, q: Point| (0..2).all(|k| (p[k] - q[k]).abs() < 1e-8);
                    assert!(centroid.zip(expected.centroid(site)).is_none_or(|(p, q)| close(p, q)));
                    let ring: Vec<Point> = expected.rings(site).flat_map(delone::Ring::points).collect();
                    assert!(rings.concat().iter().all(|&p| ring.iter().any(|&q| close(p, q))));
                }
            }
        }
    }
}

#[test]
fn lattices_have_the_neighbors_that_they_have() {
    for constant in [1.0, 0.3, 3.639] {
        let points: Vec<Point> = (0..25).map(|i| [i % 5, i / 5].map(|k| f64::from(k) * constant)).collect();
        let lattice = Lattice2::with_sides([5.0 * constant; 2]).expect("a box").grid(Grid::Auto);
        let t = Periodic2::from_points(&points, &lattice).expect("a triangulation");
        check(&t, 25.0 * constant * constant);
        let cells = t.cells().expect("cells");
        for site in t.vertices() {
            let sides = cells.cell(site).faces();
            assert_eq!(sides.len(), 4);
            assert!((cells.cell(site).area() - constant * constant).abs() < 1e-14 * constant * constant);
            assert!(sides.into_iter().all(|side| (side.length() - constant).abs() < 1e-14 * constant));
        }
    }
}

/// Walls between the multiples of a grid stay where they are.
#[test]
fn walls_are_not_rounded_to_a_grid() {
    let points: Vec<Point> = (0..9).map(|i| [i % 3, i / 3].map(|k| f64::from(k) * 0.1)).collect();
    for periodic in [[true, false], [false; 2]] {
        let lattice = Lattice2::with_sides([0.3, 0.3]).expect("a box").periodic(periodic).origin([-0.05; 2]);
        let t = Periodic2::from_points(&points, &lattice.grid(Grid::Auto)).expect("a triangulation");
        assert_eq!(t.decimal_step(), Some(0.1));
        let walls = check(&t, 0.09);
        assert_eq!([walls[&(1, false)].1, walls[&(1, true)].1], [-0.05, 0.25]);
        let cells = t.cells().expect("cells");
        for site in t.vertices() {
            assert!((cells.cell(site).area() - 0.01).abs() < 1e-16 && cells.cell(site).faces().len() == 4);
        }
    }
}

/// Points in a row between walls, duplicates and hidden sites.
#[test]
fn rows_and_sites_without_cells() {
    let lattice = Lattice2::with_sides([4.0, 2.0]).expect("a box").periodic([true, false]);
    let points = [[0.0, 1.0], [1.0, 1.0], [5.0, 1.0], [1.5, 9.0]];
    let t = Periodic2::from_points(&points[..3], &lattice).expect("a triangulation");
    check(&t, 8.0);
    let cells = t.cells().expect("cells");
    let areas = [0, 1, 2].map(|i| cells.cell(VertexId::new(i)).area());
    assert_eq!(areas, [4.0, 4.0, 0.0]);
    // One beyond the walls has no cell, but for what reaches in.
    let t = Periodic2::from_points(&points, &lattice).expect("a triangulation");
    check(&t, 8.0);
    assert_eq!(t.cells().expect("cells").cell(VertexId::new(3)).faces().len(), 0);
    let t = PeriodicRegular2::from_parts(&points[..2], &[9.0, 0.0], &lattice).expect("a triangulation");
    check(&t, 8.0);
    assert_eq!(t.cells().expect("cells").cell(VertexId::new(1)).rings().len(), 0);
}
