//! Cells of space against rational half-space cuts, against the plane, and against what must add up.

use std::collections::{BTreeMap, BTreeSet};

use delone::{Across3, Cell3, Cells3, Delaunay2, Delaunay3, Region2, Region3, Regular3, VertexId};
use delone_generators::{Kind3, Random};
use delone_oracle::solid::{self, Fraction, HalfSpace as Judged};
use delone_oracle::{all_cases, is_due, share};

type Site = ([f64; 3], f64);

/// The least of a turn of corners first, so that equal polygons are equal.
fn turned(mut ring: Vec<u32>) -> Vec<u32> {
    let least = (0..ring.len()).min_by_key(|&k| ring[k]).unwrap_or_default();
    ring.rotate_left(least);
    ring
}

/// Conditions of all cells: each is closed, faces fit those beyond, corners are used under one index, and volumes sum up.
fn check(cells: &Cells3, sites: &[VertexId], region: &Region3, name: &str) {
    let mut faces: BTreeMap<(VertexId, VertexId), Vec<Vec<u32>>> = BTreeMap::new();
    let mut places: BTreeMap<[u64; 3], u32> = BTreeMap::new();
    let mut sum = 0.0;
    let mut walls = vec![0.0; region.walls().count()];
    for &v in sites {
        let cell = cells.cell(v);
        let mut edges: BTreeMap<[u32; 2], i32> = BTreeMap::new();
        for face in cell.faces() {
            let ring = face.indices();
            assert!(ring.len() >= 3, "{name}: {v:?}");
            assert_eq!(
                ring.iter().collect::<BTreeSet<_>>().len(),
                ring.len(),
                "{name}: {v:?} twice at a corner"
            );
            for (&p, &q) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                *edges.entry([p.min(q), p.max(q)]).or_default() += if p < q { 1 } else { -1 };
            }
            for (p, &i) in face.points().zip(ring) {
                let one = *places.entry(p.map(f64::to_bits)).or_insert(i);
                assert_eq!(one, i, "{name}: two vertices at {p:?}");
            }
            match face.across() {
                Across3::Site(w) => faces.entry((v, w)).or_default().push(ring.to_vec()),
                Across3::Wall(k) => walls[k] += face.area(),
            }
        }
        assert!(edges.values().all(|&turn| turn == 0), "{name}: {v:?} is open");
        sum += cell.volume();
    }
    for ((v, w), rings) in &faces {
        let back = faces.get(&(*w, *v)).unwrap_or_else(|| panic!("{name}: {v:?} has a face to {w:?} alone"));
        assert_eq!((rings.len(), back.len()), (1, 1));
        let reversed = back[0].iter().rev().copied().collect();
        assert_eq!(turned(rings[0].clone()), turned(reversed), "{name}: {v:?} {w:?}");
    }
    let volume = region.volume();
    let areas: Vec<f64> = region.walls().map(|wall| area_of(wall.collect())).collect();
    // Corners on slanted walls are off by roundings of their coordinates.
    let largest = region.bounds().as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let all = 1e-15 * largest * largest + areas.iter().sum::<f64>();
    let off = if name.ends_with("hull") { 1e-15 * largest * all } else { 0.0 };
    assert!(
        volume.is_infinite() || (sum - volume).abs() <= 1e-13 * volume + off,
        "{name}: {sum} of {volume}"
    );
    for (k, area) in areas.into_iter().enumerate() {
        let off = if name.ends_with("hull") { 4e-15 * largest * largest } else { 0.0 };
        let is_told = area.is_finite() && area > 0.0;
        assert!(
            !is_told || (walls[k] - area).abs() <= 1e-12 * area + off,
            "{name}: wall {k} has {} of {area}",
            walls[k]
        );
    }
}

fn area_of(polygon: Vec<[f64; 3]>) -> f64 {
    let less = |p: [f64; 3]| [0, 1, 2].map(|k| p[k] - polygon[0][k]);
    let mut sum = [0.0; 3];
    for pair in polygon[1..].windows(2) {
        let (p, q) = (less(pair[0]), less(pair[1]));
        for k in 0..3 {
            sum[k] += p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3];
        }
    }
    sum.iter().map(|x| x * x).sum::<f64>().sqrt() / 2.0
}

/// A box around points, moved and scaled.
fn box_around(points: &[[f64; 3]], scale: f64, moved: f64) -> Region3 {
    let (mut low, mut high) = (points[0], points[0]);
    for p in points {
        for k in 0..3 {
            (low[k], high[k]) = (low[k].min(p[k]), high[k].max(p[k]));
        }
    }
    let size = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    let size = if size > 0.0 { size } else { 1.0 };
    let ends = [0, 1, 2].map(|k| {
        let middle = f64::midpoint(low[k], high[k]) + moved * size;
        let half = (high[k] - low[k]) / 2.0 * scale;
        let half = if half > 0.0 { half } else { size / 2.0 };
        let ends = [middle - half, middle + half].map(|x| x.clamp(f64::MIN / 2.0, f64::MAX / 2.0));
        if ends[0] < ends[1] { ends } else { [-1.0, 1.0] }
    });
    Region3::cuboid(ends.map(|end| end[0]), ends.map(|end| end[1])).expect("a box")
}

#[test]
fn cells_tile_every_region() {
    for &kind in Kind3::ALL {
        for (n, seed) in [(1, 1), (2, 2), (4, 3), (30, 4), (share(1600), 6)] {
            let points = kind.points(n, seed);
            let d = Delaunay3::from_points(&points).expect("points");
            let sites: Vec<VertexId> = d.vertices().collect();
            for (scale, moved) in [(1.0, 0.0), (0.5, 0.1), (1.0, 2.0)] {
                let region = box_around(&points, scale, moved);
                let name = format!("{} {n} {scale} {moved}", kind.name());
                check(&d.voronoi().clip(&region), &sites, &region, &name);
            }
            // Not where a region is as thin as roundings.
            let [low, high] = box_around(&points, 1.0, 0.0).bounds();
            let around: f64 = (0..3).map(|k| high[k] - low[k]).product();
            if let Some(region) = Region3::hull(&d).ok().filter(|region| region.volume() > 1e-9 * around) {
                check(&d.voronoi().clip(&region), &sites, &region, &format!("{} {n} hull", kind.name()));
            }
        }
    }
}

#[test]
fn power_cells_tile_every_region() {
    let mut random = Random::new(4);
    for &kind in Kind3::ALL {
        for (n, seed) in [(2, 2), (30, 4), (share(1200), 5)] {
            let points = kind.points(n, seed);
            let region = box_around(&points, 1.2, 0.0);
            let [low, high] = region.bounds();
            let size = (high[0] - low[0]) / (n as f64).cbrt();
            if size > 1e150 {
                continue;
            }
            for spread in [0.25_f64, 1.0, 1e6] {
                let radius =
                    |r: &mut Random| size * r.unit() * if spread > 1.0 { r.unit().powi(8) } else { 1.0 };
                let weights: Vec<f64> =
                    points.iter().map(|_| spread.min(1.0) * radius(&mut random).powi(2)).collect();
                let r = Regular3::from_parts(&points, &weights).expect("sites");
                let sites: Vec<VertexId> = r.vertices().collect();
                let cells = r.power().clip(&region);
                check(&cells, &sites, &region, &format!("{} {n} {spread}", kind.name()));
                assert!(r.hidden().all(|v| cells.volume(v) == 0.0 && cells.faces(v).len() == 0));
            }
        }
    }
}

/// The half-spaces of a site in rational arithmetic, walls first.
fn judged(own: Site, others: &[Site], walls: &[Judged]) -> (Vec<Judged>, Vec<Option<usize>>) {
    let mut rows = walls.to_vec();
    let mut of = vec![None; walls.len()];
    for (k, other) in others.iter().enumerate().filter(|(_, other)| other.0 != own.0) {
        rows.push(Judged::Nearer(own, *other));
        of.push(Some(k));
    }
    (rows, of)
}

fn walls_of(region: &Region3) -> Vec<Judged> {
    region
        .walls()
        .map(|wall| {
            let p: Vec<[f64; 3]> = wall.take(3).collect();
            Judged::Through(p[0], p[2], p[1])
        })
        .collect()
}

/// Volumes and neighbors are those of exact cuts; the exact volumes sum to exactly the region.
fn compare(sites: &[Site], region: &Region3, is_exact: bool, name: &str) {
    let r = Regular3::from_sites(sites).expect("sites");
    let cells = r.power().clip(region);
    let walls = walls_of(region);
    let unit = {
        let all: Vec<Judged> =
            sites.iter().map(|&site| Judged::Nearer(site, site)).chain(walls.clone()).collect();
        solid::unit_of(&all)
    };
    let scale = 2f64.powi(unit).powi(3);
    let mut sum = Fraction::zero();
    for v in r.vertices() {
        let (rows, of) = judged(sites[v.index()], sites, &walls);
        let expected = solid::polyhedron(&solid::rows(&rows, unit));
        sum = sum.plus(&expected.volume);
        let volume = expected.volume.value() * scale;
        let off = (cells.volume(v) - volume).abs();
        assert!(off <= 1e-13 * region.volume(), "{name}: {v:?} {} for {volume}", cells.volume(v));
        if is_exact && volume > 0.0 {
            let found: BTreeSet<Option<usize>> =
                cells.faces(v).map(|face| face.neighbor().map(VertexId::index)).collect();
            let expected: BTreeSet<Option<usize>> = expected.faces.iter().map(|&k| of[k]).collect();
            assert_eq!(found, expected, "{name}: {v:?}");
        }
    }
    let whole = solid::polyhedron(&solid::rows(&walls, unit)).volume;
    assert_eq!(sum.numerator * whole.denominator, whole.numerator * sum.denominator, "{name}");
}

#[test]
fn cells_are_those_of_rational_cuts() {
    let mut random = Random::new(11);
    let octahedron = [
        [3.0, 0.0, 0.0],
        [-3.0, 0.0, 0.0],
        [0.0, 3.0, 0.0],
        [0.0, -3.0, 0.0],
        [0.0, 0.0, 3.0],
        [0.0, 0.0, -3.0],
    ];
    let octahedron = Region3::convex(&octahedron.map(|p: [f64; 3]| p.map(|x| x + 2.0))).expect("a region");
    let cube = Region3::cuboid([0.0; 3], [4.0; 3]).expect("a box");
    let small = Region3::cuboid([0.5, 1.0, 1.5], [1.0, 3.0, 2.0]).expect("a box");
    for case in 0..share(160) {
        let n = [1, 2, 3, 5, 8, 12, 16][case % 7];
        let grid = [2, 5, 9][case % 3];
        let mut whole = || [(); 3].map(|()| random.below(grid) as f64 * 0.5);
        let mut sites: Vec<Site> = (0..n).map(|_| (whole(), 0.0)).collect();
        let has_weights = case % 4 == 3;
        if has_weights {
            sites.iter_mut().for_each(|site| site.1 = random.below(5) as f64 * 0.25);
        }
        for (region, name) in [(&cube, "cube"), (&octahedron, "octahedron"), (&small, "small")] {
            compare(&sites, region, !has_weights, &format!("{name} {case}: {sites:?}"));
        }
    }
    // In general position, and nearly.
    for (case, &kind) in Kind3::ALL.iter().enumerate() {
        let n = if all_cases() || is_due(case) { 40 } else { 10 };
        let points = kind.points(n, 21);
        let region = box_around(&points, 1.5, 0.05);
        let sites: Vec<Site> = points.iter().map(|&p| (p, 0.0)).collect();
        if region.volume().is_finite() {
            compare(&sites, &region, false, kind.name());
        }
    }
}

/// In lattices inner cells have 6, 14 or 12 faces, and volumes are exact.
#[test]
fn lattices_have_no_tiny_faces() {
    let k = 5;
    for (basis, faces) in [
        (&[[0, 0, 0]][..], 6),
        (&[[0, 0, 0], [2, 2, 2]], 14),
        (&[[0, 0, 0], [2, 2, 0], [2, 0, 2], [0, 2, 2]], 12),
    ] {
        for constant in [1.0, 3639.0] {
            let mut points = Vec::new();
            for i in 0..k * k * k {
                let cell = [i % k, i / k % k, i / k / k];
                points.extend(
                    basis.iter().map(|b| [0, 1, 2].map(|a| f64::from(4 * cell[a] + b[a]) * constant)),
                );
            }
            let (low, high) = ([-2.0 * constant; 3], [f64::from(4 * k - 2) * constant; 3]);
            let region = Region3::cuboid(low, high).expect("a box");
            let d = Delaunay3::from_points(&points).expect("points");
            let cells = d.voronoi().clip(&region);
            let sites: Vec<VertexId> = d.vertices().collect();
            check(&cells, &sites, &region, &format!("lattice {faces}"));
            let sum: f64 = sites.iter().map(|&v| cells.volume(v)).sum();
            // Thirds are rounded.
            let off = if faces == 6 { 0.0 } else { 1e-14 * region.volume() };
            assert!((sum - region.volume()).abs() <= off, "{sum}");
            let is_inner = |v: &VertexId| {
                d.point(*v).iter().all(|&x| x > 4.0 * constant && x < f64::from(4 * k - 8) * constant)
            };
            let mut inner = 0;
            for v in sites.into_iter().filter(is_inner) {
                assert_eq!(cells.faces(v).len(), faces);
                assert_eq!(d.voronoi().neighbors(v).len(), faces);
                assert_eq!(cells.volume(v), (4.0 * constant).powi(3) / basis.len() as f64);
                inner += 1;
            }
            assert!(inner > 0);
        }
    }
}

/// Over coplanar sites cells are prisms over those of the plane.
#[test]
fn prisms_are_the_cells_of_the_plane() {
    let mut random = Random::new(5);
    let flat: Vec<[f64; 2]> = (0..share(8000)).map(|_| [random.unit(), random.unit()]).collect();
    let d2 = Delaunay2::from_points(&flat).expect("points");
    let cells2 = d2.voronoi().clip(&Region2::rectangle([0.0; 2], [1.0; 2]).expect("a region"));
    for axis in 0..3 {
        let at = |p: [f64; 2], z: f64| {
            let mut q = [z; 3];
            (q[(axis + 1) % 3], q[(axis + 2) % 3]) = (p[0], p[1]);
            q
        };
        let solid: Vec<[f64; 3]> = flat.iter().map(|&p| at(p, 0.25)).collect();
        let d3 = Delaunay3::from_points(&solid).expect("points");
        let region = Region3::cuboid(at([0.0; 2], -1.0), at([1.0; 2], 2.0)).expect("a box");
        let cells3 = d3.voronoi().clip(&region);
        check(&cells3, &d3.vertices().collect::<Vec<_>>(), &region, "prisms");
        for v in d2.vertices() {
            assert!((cells3.volume(v) - 3.0 * cells2.area(v)).abs() < 1e-14);
            let sides = cells2.rings(v).flat_map(|ring| ring.sides()).count();
            assert_eq!(cells3.faces(v).len(), sides + 2, "{v:?}");
            let (p, q) = (cells2.centroid(v).expect("a cell"), cells3.centroid(v).expect("a cell"));
            let expected = at(p, 0.5);
            assert!((0..3).all(|k| (q[k] - expected[k]).abs() < 1e-12), "{q:?} {expected:?}");
        }
    }
}

/// Centers of mass and volumes by random places and their nearest sites.
#[test]
fn centroids_are_means_of_places() {
    let mut random = Random::new(6);
    let sites: Vec<Site> =
        (0..20).map(|_| ([random.unit(), random.unit(), random.unit()], 0.02 * random.unit())).collect();
    let r = Regular3::from_sites(&sites).expect("sites");
    let cells = r.power().clip(&Region3::cuboid([0.0; 3], [1.0, 1.0, 0.5]).expect("a box"));
    let mut sums = vec![[0.0; 4]; sites.len()];
    let n = 200_000;
    for _ in 0..n {
        let q = [random.unit(), random.unit(), 0.5 * random.unit()];
        let power = |i: usize| (0..3).map(|k| (q[k] - sites[i].0[k]).powi(2)).sum::<f64>() - sites[i].1;
        let nearest = (0..sites.len()).min_by(|&i, &j| power(i).total_cmp(&power(j))).expect("some");
        let sum = &mut sums[nearest];
        *sum = [sum[0] + q[0], sum[1] + q[1], sum[2] + q[2], sum[3] + 1.0];
    }
    for (i, [x, y, z, count]) in sums.into_iter().enumerate() {
        let v = VertexId::new(i);
        let volume = 0.5 * count / f64::from(n);
        assert!((cells.volume(v) - volume).abs() < 0.002, "{i}: {} {volume}", cells.volume(v));
        if count > 1000.0 {
            let center = cells.centroid(v).expect("a cell");
            let error = 2.0 / count.sqrt();
            assert!([x, y, z].iter().zip(center).all(|(sum, c)| (sum / count - c).abs() < error), "{i}");
        }
    }
}

type Polygon = (Across3, Vec<[f64; 3]>);

fn facts(cell: Cell3<'_>) -> (f64, Option<[f64; 3]>, Vec<Polygon>) {
    let faces = cell.faces().map(|face| (face.across(), face.points().collect()));
    (cell.volume(), cell.centroid(), faces.collect())
}

/// One after the other cells are the same, and bounded ones are those clipped to a large region.
#[test]
fn all_ways_give_the_same_cells() {
    for &kind in Kind3::ALL {
        let points = kind.points(share(1200), 3);
        let d = Delaunay3::from_points(&points).expect("points");
        let region = box_around(&points, 1.0, 0.2);
        let cells = d.voronoi().clip(&region);
        let mut count = 0;
        d.voronoi().clip_each(&region, |v, cell| {
            assert_eq!(facts(cell), facts(cells.cell(v)), "{} {v:?}", kind.name());
            count += 1;
        });
        assert_eq!(count, d.vertex_count());
        let bounded = d.voronoi().bounded();
        let wide = d.voronoi().clip(&box_around(&points, 1e3, 0.0));
        for v in d.vertices() {
            let is_whole = wide.faces(v).len() > 0 && wide.faces(v).all(|face| face.neighbor().is_some());
            if is_whole {
                assert!(d.voronoi().is_bounded(v));
                assert_eq!(facts(bounded.cell(v)), facts(wide.cell(v)), "{} {v:?}", kind.name());
            }
            assert!(d.voronoi().is_bounded(v) || bounded.faces(v).len() == 0);
            // Faces that are there are neighbors exactly; of tiny ones nothing may be left.
            let exact: BTreeSet<VertexId> = d.voronoi().neighbors(v).into_iter().collect();
            let found: BTreeSet<VertexId> = wide.faces(v).filter_map(|face| face.neighbor()).collect();
            assert!(found.is_subset(&exact), "{} {v:?}: {found:?} {exact:?}", kind.name());
        }
    }
}

#[test]
fn threads_do_not_show() {
    let points = Kind3::Cube.points(40_000, 9);
    let d = Delaunay3::from_points(&points).expect("points");
    let region = Region3::cuboid([0.0; 3], [1.0; 3]).expect("a box");
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| d.voronoi().clip(&region))
    };
    let (one, two) = (with(1), with(2));
    assert_eq!(one.vertices(), two.vertices());
    for v in d.vertices() {
        let indices = |cells: &Cells3| -> Vec<(Across3, Vec<u32>)> {
            cells.faces(v).map(|face| (face.across(), face.indices().to_vec())).collect()
        };
        assert_eq!(indices(&one), indices(&two));
    }
    check(&one, &d.vertices().collect::<Vec<_>>(), &region, "threads");
}

/// Sets on which others go wrong.
#[test]
fn hostile_sets() {
    let mut random = Random::new(8);
    let unit = |r: &mut Random| [r.unit(), r.unit(), r.unit()];
    let cube = Region3::cuboid([0.0; 3], [1.0; 3]).expect("a box");
    let mut on_sphere: Vec<[f64; 3]> = Vec::new();
    for [x, y, z] in [[1.0, 4.0, 8.0], [4.0, 4.0, 7.0]] {
        for i in 0..48 {
            let sign = |k: i32| if i >> k & 1 == 0 { 0.05 } else { -0.05 };
            let p = [x * sign(0), y * sign(1), z * sign(2)];
            let turn = (i / 8) as usize;
            let p = [p[turn % 3], p[(turn + 1) % 3], p[(turn + 2) % 3]];
            let p = if turn < 3 { p } else { [p[1], p[0], p[2]] };
            on_sphere.push(p.map(|x| x + 0.5));
        }
    }
    let flat: Vec<[f64; 3]> = (0..share(80_000)).map(|_| [random.unit(), random.unit(), 0.5]).collect();
    let mut outliers: Vec<[f64; 3]> = (0..200).map(|_| unit(&mut random)).collect();
    outliers.extend([[1e9, 0.0, 0.0], [0.0, -1e12, 3.0], [1e15; 3]]);
    let outside: Vec<[f64; 3]> = (0..200).map(|_| unit(&mut random).map(|x| x + 3.0)).collect();
    let mut twice: Vec<[f64; 3]> = (0..100).map(|_| unit(&mut random)).collect();
    twice.extend(twice.clone());
    for (name, points) in [
        ("sphere", on_sphere),
        ("flat", flat),
        ("outliers", outliers),
        ("outside", outside),
        ("twice", twice),
        ("one", vec![[5.0, 0.5, 0.25]]),
        ("on the border", vec![[0.0; 3], [1.0; 3], [1.0, 0.0, 0.0], [0.5, 0.0, 1.0]]),
        ("mirrored in a wall", vec![[0.25, 0.5, 0.5], [-0.25, 0.5, 0.5], [0.25, 0.5, 1.5]]),
    ] {
        let d = Delaunay3::from_points(&points).expect("points");
        let cells = d.voronoi().clip(&cube);
        check(&cells, &d.vertices().collect::<Vec<_>>(), &cube, name);
        for duplicate in d.duplicates() {
            let v = VertexId::new(duplicate.point);
            assert_eq!((cells.volume(v), cells.faces(v).len()), (0.0, 0));
        }
        // A box like a needle.
        let needle = Region3::cuboid([0.0, 0.5, 0.5], [1.0, 0.5 + 1e-9, 0.5 + 1e-12]).expect("a box");
        check(&d.voronoi().clip(&needle), &d.vertices().collect::<Vec<_>>(), &needle, name);
    }
    // A cell that only touches the region has no face there, and the wall is the neighbor.
    let d = Delaunay3::from_points(&[[0.25, 0.5, 0.5], [-0.25, 0.5, 0.5]]).expect("points");
    let cells = d.voronoi().clip(&cube);
    assert_eq!(cells.faces(VertexId::new(1)).len(), 0);
    assert!(cells.faces(VertexId::new(0)).all(|face| face.neighbor().is_none()));
}

/// At both ends of the range.
#[test]
fn sizes_far_from_one() {
    let points = Kind3::Cube.points(100, 2);
    let volumes = |unit: f64| {
        let scaled: Vec<[f64; 3]> = points.iter().map(|p| p.map(|x| x * unit)).collect();
        let region = Region3::cuboid([0.0; 3], [unit; 3]).expect("a box");
        let d = Delaunay3::from_points(&scaled).expect("points");
        let cells = d.voronoi().clip(&region);
        d.vertices().map(|v| (cells.volume(v), cells.centroid(v), cells.area(v))).collect::<Vec<_>>()
    };
    let plain = volumes(1.0);
    for power in [-500, -340, -100, 100, 330, 500] {
        let unit = 2f64.powi(power);
        for (found, expected) in volumes(unit).into_iter().zip(&plain) {
            let scaled = expected.0 * unit * unit * unit;
            assert!(
                found.0 == scaled || (scaled < 1e-307 && found.0 < 1e-307),
                "2^{power}: {} {scaled}",
                found.0
            );
            let (p, q) = (found.1.expect("a cell"), expected.1.expect("a cell"));
            assert!((0..3).all(|k| (p[k] / unit - q[k]).abs() < 1e-14), "2^{power}");
            assert!((found.2 / unit / unit / expected.2 - 1.0).abs() < 1e-14, "2^{power}");
        }
    }
}
