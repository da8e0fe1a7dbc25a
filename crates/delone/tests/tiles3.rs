//! Triangulated in tiles of space, a set of points has the tetrahedra that it has in memory: on every generator, in many tilings,
//! however the borders are joined.

use std::collections::BTreeMap;

use delone::tiles::{Border3, Cut, Cuts, Fingerprint, Node, Region, Tile3, join3};
use delone::{BorderProblem, Delaunay3, Dimension, Error};
use delone_generators::{Kind3, Random};
use delone_oracle::{all_cases, some_of};

type Point = [f64; 3];
type Tetrahedron = [Point; 4];

/// The result of tiles and joins.
struct Found {
    tetrahedra: Vec<Tetrahedron>,
    fingerprint: Fingerprint,
    /// The vertices of the hull.
    hull: usize,
    /// The most points of borders that were joined at once.
    widest: usize,
}

/// The points of the tiles of a tree, with their indices.
fn distribute(points: &[Point], cuts: &Cuts<3>) -> BTreeMap<Node, Vec<usize>> {
    let mut buckets: BTreeMap<Node, Vec<usize>> = cuts.tiles().into_iter().map(|t| (t, Vec::new())).collect();
    for (i, &p) in points.iter().enumerate() {
        buckets.get_mut(&cuts.tile_of(p)).expect("a tile").push(i);
    }
    buckets
}

/// Triangulates in the tiles of a tree, and joins so many levels at once.
fn in_tiles(points: &[Point], cuts: &Cuts<3>, levels: u32) -> Found {
    by_rules(points, cuts, levels, |region| region, |border| border)
}

/// Runs tiles and joins with regions other than their own, and with changed borders.
fn by_rules(
    points: &[Point],
    cuts: &Cuts<3>,
    levels: u32,
    region: fn(Region<3>) -> Region<3>,
    change: fn(Border3) -> Border3,
) -> Found {
    let mut found = Found { tetrahedra: Vec::new(), fingerprint: Fingerprint::default(), hull: 0, widest: 0 };
    let mut borders: BTreeMap<Node, Border3> = BTreeMap::new();
    for (node, mine) in distribute(points, cuts) {
        let its: Vec<Point> = mine.iter().map(|&i| points[i]).collect();
        let tile = Tile3::new(&its, &region(cuts.region(node))).expect("points of the region");
        assert_eq!(tile.points().len() + tile.duplicates().len(), its.len());
        assert!(tile.order().iter().zip(tile.points()).all(|(&i, p)| its[i as usize] == *p));
        for duplicate in tile.duplicates() {
            assert_eq!(its[duplicate.point], its[duplicate.vertex.index()]);
            assert!(duplicate.vertex.index() < duplicate.point);
        }
        let finals = tile.finals().map(|t| t.map(|v| tile.points()[v as usize]));
        found.tetrahedra.extend(finals);
        found.fingerprint += tile.fingerprint();
        let border = tile.border(|v| mine[tile.order()[v as usize] as usize] as u64);
        assert_eq!(border.open.len(), tile.open().count());
        borders.insert(node, change(Border3::from_bytes(&border.to_bytes()).expect("its bytes")));
    }
    let mut nodes = vec![(Node::ROOT, false)];
    while let Some((node, is_ready)) = nodes.pop() {
        let parts = cuts.parts(node, levels);
        if parts.is_empty() && node != Node::ROOT {
            continue;
        }
        if !is_ready {
            nodes.push((node, true));
            nodes.extend(parts.iter().map(|&part| (part, false)));
            continue;
        }
        // A tree of one tile is joined with nothing.
        let parts = if parts.is_empty() { vec![node] } else { parts };
        let joined: Vec<Border3> = parts.iter().map(|part| borders.remove(part).expect("done")).collect();
        found.widest = found.widest.max(joined.iter().map(|border| border.points.len()).sum());
        let seam = join3(&joined, &cuts.region(node)).expect("borders of the parts");
        found.tetrahedra.extend(seam.tetrahedra.iter().map(|t| t.map(|i| points[i as usize])));
        found.fingerprint += seam.fingerprint;
        borders.insert(node, if node == Node::ROOT { seam.border } else { change(seam.border) });
    }
    let root = borders.remove(&Node::ROOT).expect("joined last");
    assert!(borders.is_empty() && root.open.is_empty());
    found.hull = root.points.len();
    found
}

/// A set of tetrahedra in a form that can be compared: corners sorted by an even permutation, but for the last two.
fn normalized(tetrahedra: impl IntoIterator<Item = Tetrahedron>) -> Vec<Tetrahedron> {
    let turned = |t: Tetrahedron| {
        let mut t = t.map(|p| p.map(|x| x + 0.0));
        let mut is_odd = false;
        for last in (1..4).rev() {
            for k in 0..last {
                if t[k] > t[k + 1] {
                    t.swap(k, k + 1);
                    is_odd = !is_odd;
                }
            }
        }
        if is_odd {
            t.swap(2, 3);
        }
        t
    };
    let mut all: Vec<Tetrahedron> = tetrahedra.into_iter().map(turned).collect();
    all.sort_by(|s, t| s.partial_cmp(t).expect("finite"));
    all
}

/// The trees that sets are cut by: from all points, from a few of them, slabs, through a point.
fn tilings(points: &[Point]) -> Vec<Cuts<3>> {
    let few: Vec<Point> = points.iter().copied().step_by(7).take(30).collect();
    let node = |number| Node::new(number).expect("not 0");
    let mut all: Vec<Cuts<3>> =
        [2, 8, 19].map(|tiles| Cuts::from_sample(points, tiles).expect("finite")).into();
    all.push(Cuts::from_sample(&few, 12).expect("finite"));
    // Slabs, each cut off the rest: a tree that is not even.
    let slabs = (0..5).map(|k| (node((2 << k) - 1), Cut { axis: 2, at: 0.1 + 0.15 * f64::from(k) }));
    all.push(Cuts::from_cuts(slabs).expect("a tree"));
    // Through a point, all ways.
    if let Some(&[x, y, z]) = points.get(points.len() / 2) {
        let cross = [(1, 0, x), (2, 1, y), (3, 1, y), (4, 2, z), (5, 2, z), (6, 2, z), (7, 2, z)];
        all.push(Cuts::from_cuts(cross.map(|(n, axis, at)| (node(n), Cut { axis, at }))).expect("a tree"));
    }
    all
}

/// All tilings and joins of a set of points.
fn judge(points: &[Point], what: &str) -> usize {
    let whole = Delaunay3::from_points(points).expect("finite");
    let expected = normalized(whole.tetrahedra().map(|corners| corners.map(|v| whole.point(v))));
    let fingerprint = Fingerprint::of(&whole);
    assert_eq!(fingerprint.count(), expected.len() as u64);
    // Of less than space every vertex is one of the hull.
    let is_space = whole.dimension() == Dimension::Space;
    let hull = if is_space { whole.hull_vertices().count() } else { whole.vertex_count() };
    let mut runs = 0;
    for (k, cuts) in tilings(points).iter().enumerate() {
        for levels in [1, 2, 4] {
            let found = in_tiles(points, cuts, levels);
            assert_eq!(found.fingerprint, fingerprint, "{what}, tiling {k}, {levels} levels");
            assert!(normalized(found.tetrahedra) == expected, "{what}, tiling {k}, {levels} levels");
            assert_eq!(found.hull, hull, "{what}, tiling {k}, {levels} levels");
            runs += 1;
        }
    }
    runs
}

#[test]
fn tiles_give_what_memory_gives() {
    let mut runs = 0;
    for &kind in Kind3::ALL {
        // Linked circles have a tetrahedron for each pair of points.
        let most = if kind == Kind3::Linked { 150 } else { 600 };
        for n in some_of(0..25).chain([40, 100, 250, 600]).filter(|&n| n <= most) {
            runs += judge(&kind.points(n, n as u64), &format!("{} {n}", kind.name()));
        }
    }
    assert!(runs > if all_cases() { 8_000 } else { 2_000 }, "{runs}");
}

#[test]
#[ignore = "long: .ci/run --long"]
fn tiles_give_what_memory_gives_of_many() {
    for kind in [Kind3::Cube, Kind3::Ball, Kind3::Grid3, Kind3::Clusters3, Kind3::Layers, Kind3::Balls] {
        let points = kind.points(120_000, 1);
        let expected = Fingerprint::of(&Delaunay3::from_points(&points).expect("finite"));
        let cuts = Cuts::from_sample(&points, 16).expect("finite");
        for levels in [1, 4] {
            let found = in_tiles(&points, &cuts, levels);
            assert_eq!(found.fingerprint, expected, "{}, {levels} levels", kind.name());
        }
    }
}

/// Sets that the generators do not make.
#[test]
fn nasty_sets() {
    let mut r = Random::new(9);
    let lattice = |step: f64, w: u32| -> Vec<Point> {
        (0..w * w * w).map(|i| [i % w, i / w % w, i / w / w].map(|k| step * f64::from(k))).collect()
    };
    let on_sphere = |r: &mut Random| -> Point {
        let p = [0; 3].map(|_| r.between(-1.0, 1.0));
        let size = p.iter().map(|x| x * x).sum::<f64>().sqrt();
        p.map(|x| x / size)
    };
    let small = |r: &mut Random| [0; 3].map(|_| r.below(5) as f64);
    let mut sets: Vec<Vec<Point>> = vec![
        // All cospherical, in every cell.
        lattice(1.0, 7),
        lattice(5e-324, 6),
        lattice(f64::from_bits(1 << 14), 6),
        lattice(2f64.powi(1000), 6),
        // Centered cubes: cells of other shapes, integers.
        lattice(2.0, 5).into_iter().flat_map(|p| [p, p.map(|x| x + 1.0)]).collect(),
        // All on one sphere, exactly: integers whose squares have the sum 81 (turned and mirrored), and nearly.
        (0..48)
            .map(|i| {
                let p = [[1.0, 4.0, 8.0], [4.0, 4.0, 7.0], [3.0, 6.0, 6.0]][i % 3];
                let turned = [p[i / 3 % 3], p[(i / 3 + 1) % 3], p[(i / 3 + 2) % 3]];
                [0, 1, 2].map(|k| if i >> k & 1 == 0 { turned[k] } else { -turned[k] })
            })
            .collect(),
        (0..200).map(|_| on_sphere(&mut r)).collect(),
        // In planes, along axes and not; on lines; equal.
        (0..144).map(|i| [f64::from(i % 12), f64::from(i / 12), 3.0]).collect(),
        (0..144).map(|i| [f64::from(i % 12), f64::from(i / 12), f64::from(i % 12 - 2 * (i / 12))]).collect(),
        (0..100).map(|i| [-0.0, f64::from(i), 0.0]).collect(),
        (0..100).map(|i| [f64::from(i), 3.0 * f64::from(i), -f64::from(i)]).collect(),
        vec![[1.0, 2.0, 3.0]; 50],
        // A plane with one point beside it.
        (0..145).map(|i| [f64::from(i % 12), f64::from(i / 12), if i == 144 { 5.0 } else { 0.0 }]).collect(),
        // 1e-300 beside 1e300, and what is between.
        (0..100).map(|i| [10f64.powi(6 * (i - 50)), f64::from(i), f64::from(i * i % 17)]).collect(),
        (0..100)
            .map(|i| [if i % 2 == 0 { 1e300 } else { 1e-300 } * r.unit(), 1e-300 * r.unit(), r.unit()])
            .collect(),
        (0..100).map(|_| [5e-324 * r.below(9) as f64, f64::MAX * r.between(-1.0, 1.0), r.unit()]).collect(),
        // Few places, each many times.
        (0..400).map(|_| small(&mut r)).collect(),
    ];
    // Duplicates in the corners that cuts have, with both zeros.
    let mut crossed: Vec<Point> = Vec::new();
    for _ in 0..200 {
        crossed.push([0; 3].map(|_| [0.0, -0.0, 1.0, -1.0, 5e-324, -5e-324][r.below(6)]));
    }
    crossed.extend(Kind3::Cube.points(100, 1).iter().map(|p| p.map(|x| x - 0.5)));
    sets.push(crossed);
    // A tenth on a flat cap far around the others.
    let cap = (0..60).map(|i| {
        let [s, t] = [f64::from(i % 8) - 3.5, f64::from(i / 8) - 3.5].map(|x| x / 1e4);
        [0.5 + 1e4 * s, 0.5 + 1e4 * t, -10.0 + 1e4 * (s * s + t * t) / 2.0]
    });
    sets.push(Kind3::Cube.points(540, 1).into_iter().chain(cap).collect());
    // A hole, whose spheres are in no tile.
    let around = |p: &Point| p.iter().map(|x| (x - 0.5).powi(2)).sum::<f64>() > 0.16;
    sets.push(Kind3::Cube.points(900, 4).into_iter().filter(around).collect());
    for (k, points) in sets.iter().enumerate() {
        judge(points, &format!("nasty set {k}"));
        if !all_cases() {
            continue;
        }
        let mut shuffled = points.clone();
        r.shuffle(&mut shuffled);
        judge(&shuffled, &format!("nasty set {k}, shuffled"));
    }
}

/// Of evenly spread points most are final in their tiles, and all at the root.
#[test]
fn borders_are_small() {
    let points = Kind3::Cube.points(40_000, 1);
    let cuts = Cuts::from_sample(&points, 2).expect("finite");
    let found = in_tiles(&points, &cuts, 4);
    assert!(found.widest < points.len() / 4, "{} points of borders", found.widest);
    let whole = Delaunay3::from_points(&points).expect("finite");
    assert_eq!(found.fingerprint, Fingerprint::of(&whole));
}

/// Each rule is needed: without it there are other tetrahedra.
#[test]
fn every_rule_is_needed() {
    /// The vertices of a border that are corners of open tetrahedra.
    fn without_hull(border: Border3) -> Border3 {
        let is_open = |v: &usize| border.open.iter().flatten().any(|&w| w as usize == *v);
        let kept: Vec<usize> = (0..border.points.len()).filter(is_open).collect();
        let index = |v: u32| kept.binary_search(&(v as usize)).expect("kept") as u32;
        Border3 {
            points: kept.iter().map(|&v| border.points[v]).collect(),
            ids: kept.iter().map(|&v| border.ids[v]).collect(),
            open: border.open.iter().map(|t| t.map(index)).collect(),
        }
    }
    /// With all tetrahedra of its points.
    fn all_open(border: Border3) -> Border3 {
        let tile = Tile3::new(&border.points, &Region::ALL).expect("finite");
        let open = tile.finals().map(|t| t.map(|v| tile.order()[v as usize])).collect();
        Border3 { open, ..border }
    }
    fn none_open(border: Border3) -> Border3 {
        Border3 { open: Vec::new(), ..border }
    }
    fn grown(region: Region<3>) -> Region<3> {
        Region { low: region.low.map(|x| x - 0.05), high: region.high.map(|x| x + 0.05) }
    }
    // In a cube the spheres at the hull are so large that its vertices are corners of open tetrahedra anyway.
    let points = Kind3::Clusters3.points(6_000, 1);
    let cuts = Cuts::from_sample(&points, 4).expect("finite");
    let expected = in_tiles(&points, &cuts, 1).fingerprint;
    let found = |region: fn(Region<3>) -> Region<3>, change: fn(Border3) -> Border3| {
        by_rules(&points, &cuts, 1, region, change).fingerprint
    };
    assert_eq!(expected, Fingerprint::of(&Delaunay3::from_points(&points).expect("finite")));
    assert_eq!(found(|region| region, |border| border), expected);
    assert_ne!(found(|region| region, without_hull), expected, "the hull travels");
    assert_ne!(found(|region| region, all_open), expected, "tetrahedra of one part that were not open go");
    assert_ne!(found(|region| region, none_open), expected, "those that were stay");
    assert_ne!(found(grown, |border| border), expected, "spheres are inside of the region");
}

/// A tile names what is wrong with its points.
#[test]
fn points_that_are_none_are_named() {
    let region = Region { low: [0.0; 3], high: [1.0; 3] };
    assert!(matches!(
        Tile3::new(&[[0.5; 3], [0.5, 0.5, f64::NAN]], &region),
        Err(Error::NotFinite { index: 1, axis: 2, .. })
    ));
    for axis in 0..3 {
        for value in [1.0, -0.1] {
            let mut at = [0.5; 3];
            at[axis] = value;
            let found = Tile3::new(&[[0.0; 3], at, [7.0; 3]], &region).err();
            assert_eq!(found, Some(Error::OutsideRegion { index: 1, axis, value }));
        }
    }
    assert!(Tile3::new(&[], &region).is_ok_and(|tile| tile.border(u64::from) == Border3::default()));
    let axis = Cuts::<3>::from_cuts([(Node::ROOT, Cut { axis: 3, at: 0.0 })]);
    assert!(matches!(axis, Err(Error::Cut { node: 1, .. })));
}

/// So does a join.
#[test]
fn borders_that_are_none_are_named() {
    let border =
        |x: f64| Border3 { points: vec![[x, 0.0, 0.0], [x, 1.0, 0.0]], ids: vec![1, 2], open: Vec::new() };
    let region = Region { low: [0.0, f64::NEG_INFINITY, -1.0], high: [9.0, 2.0, 1.0] };
    let problem = |index, problem| Some(Error::Border { index, problem });
    let found = |second: Border3| join3(&[border(1.0), second], &region).err();
    assert_eq!(found(border(2.0)), None);
    assert_eq!(found(border(9.0)), problem(1, BorderProblem::Outside { point: 0 }));
    assert_eq!(found(border(1.0)), problem(1, BorderProblem::Twice { point: 0 }));
    let without = Border3 { ids: vec![1], ..border(2.0) };
    assert_eq!(found(without), problem(1, BorderProblem::Ids { points: 2, ids: 1 }));
    let broken = Border3 { open: vec![[0, 1, 0, 1], [0, 1, 0, 2]], ..border(2.0) };
    assert_eq!(found(broken), problem(1, BorderProblem::Corner { simplex: 1, points: 2 }));
    let strange = Border3 { points: vec![[2.0; 3], [1.0, 1.0, f64::INFINITY]], ..border(2.0) };
    assert_eq!(found(strange), problem(1, BorderProblem::NotFinite { point: 1 }));
}
