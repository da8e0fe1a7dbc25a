//! Triangulated in tiles, a set of points has the triangles that it has in memory: on every generator, in many tilings,
//! however the borders are joined.

use std::collections::BTreeMap;

use delone::tiles::{Border, Cut, Cuts, Fingerprint, Node, Region, Tile, join};
use delone::{BorderProblem, Delaunay2, Error, Triangulation as _};
use delone_generators::{Kind, Random};
use delone_oracle::{all_cases, brute, some_of};

type Triangle = [[f64; 2]; 3];

/// The result of tiles and joins.
struct Found {
    triangles: Vec<Triangle>,
    fingerprint: Fingerprint,
    /// The vertices of the hull.
    hull: usize,
    /// The most points of borders that were joined at once.
    widest: usize,
}

/// The points of the tiles of a tree, with their indices.
fn distribute(points: &[[f64; 2]], cuts: &Cuts) -> BTreeMap<Node, Vec<usize>> {
    let mut buckets: BTreeMap<Node, Vec<usize>> = cuts.tiles().into_iter().map(|t| (t, Vec::new())).collect();
    for (i, &p) in points.iter().enumerate() {
        buckets.get_mut(&cuts.tile_of(p)).expect("a tile").push(i);
    }
    buckets
}

/// Triangulates in the tiles of a tree, and joins so many levels at once.
fn in_tiles(points: &[[f64; 2]], cuts: &Cuts, levels: u32) -> Found {
    by_rules(points, cuts, levels, |region| region, |border| border)
}

/// Runs tiles and joins with regions other than their own, and with changed borders.
fn by_rules(
    points: &[[f64; 2]],
    cuts: &Cuts,
    levels: u32,
    region: fn(Region) -> Region,
    change: fn(Border) -> Border,
) -> Found {
    let mut found = Found { triangles: Vec::new(), fingerprint: Fingerprint::default(), hull: 0, widest: 0 };
    let mut borders: BTreeMap<Node, Border> = BTreeMap::new();
    for (node, mine) in distribute(points, cuts) {
        let its: Vec<[f64; 2]> = mine.iter().map(|&i| points[i]).collect();
        let tile = Tile::new(&its, &region(cuts.region(node))).expect("points of the region");
        assert_eq!(tile.points().len() + tile.duplicates().len(), its.len());
        assert!(tile.order().iter().zip(tile.points()).all(|(&i, p)| its[i as usize] == *p));
        let finals = tile.finals().map(|t| t.map(|v| tile.points()[v as usize]));
        found.triangles.extend(finals);
        found.fingerprint += tile.fingerprint();
        let border = tile.border(|v| mine[tile.order()[v as usize] as usize] as u64);
        borders.insert(node, change(Border::from_bytes(&border.to_bytes()).expect("its bytes")));
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
        let joined: Vec<Border> = parts.iter().map(|part| borders.remove(part).expect("done")).collect();
        found.widest = found.widest.max(joined.iter().map(|border| border.points.len()).sum());
        let seam = join(&joined, &cuts.region(node)).expect("borders of the parts");
        found.triangles.extend(seam.triangles.iter().map(|t| t.map(|i| points[i as usize])));
        found.fingerprint += seam.fingerprint;
        borders.insert(node, change(seam.border));
    }
    let root = borders.remove(&Node::ROOT).expect("joined last");
    assert!(borders.is_empty());
    found.hull = root.points.len();
    found
}

/// The trees that sets are cut by: from all points, from a few of them, of the middle alone, through points.
fn tilings(points: &[[f64; 2]]) -> Vec<Cuts> {
    let few: Vec<[f64; 2]> = points.iter().copied().step_by(7).take(30).collect();
    let node = |number| Node::new(number).expect("not 0");
    let mut all: Vec<Cuts> =
        [2, 3, 8, 37].map(|tiles| Cuts::from_sample(points, tiles).expect("finite")).into();
    all.push(Cuts::from_sample(&few, 16).expect("finite"));
    // Slabs, each cut off the rest: a tree that is not even.
    let slabs = (0..6).map(|k| (node((2 << k) - 1), Cut { axis: 1, at: 0.1 + 0.15 * f64::from(k) }));
    all.push(Cuts::from_cuts(slabs).expect("a tree"));
    // Through a point, both ways.
    if let Some(&[x, y]) = points.get(points.len() / 2) {
        let cross = [(1, 0, x), (2, 1, y), (3, 1, y)];
        all.push(Cuts::from_cuts(cross.map(|(n, axis, at)| (node(n), Cut { axis, at }))).expect("a tree"));
    }
    all
}

/// All tilings and joins of a set of points.
fn judge(points: &[[f64; 2]], what: &str) -> usize {
    let whole = Delaunay2::from_points(points).expect("finite");
    let expected = brute::normalized(whole.triangles().map(|corners| corners.map(|v| whole.point(v))));
    let fingerprint = Fingerprint::of(&whole);
    assert_eq!(fingerprint.count(), expected.len() as u64);
    let mut runs = 0;
    for (k, cuts) in tilings(points).iter().enumerate() {
        for levels in [1, 2, 4] {
            let found = in_tiles(points, cuts, levels);
            assert_eq!(found.fingerprint, fingerprint, "{what}, tiling {k}, {levels} levels");
            assert!(brute::normalized(found.triangles) == expected, "{what}, tiling {k}, {levels} levels");
            assert_eq!(found.hull, whole.hull_vertices().count(), "{what}, tiling {k}, {levels} levels");
            runs += 1;
        }
    }
    runs
}

#[test]
fn tiles_give_what_memory_gives() {
    let mut runs = 0;
    for &kind in Kind::ALL {
        let large = (all_cases() && !kind.is_extreme()).then_some(2000);
        for n in some_of(0..40).chain([50, 100, 300, 700]).chain(large) {
            runs += judge(&kind.points(n, n as u64), &format!("{} {n}", kind.name()));
        }
    }
    assert!(runs > if all_cases() { 22_000 } else { 5_000 }, "{runs}");
}

#[test]
#[ignore = "long: .ci/run --long"]
fn tiles_give_what_memory_gives_of_many() {
    for &kind in Kind::ALL {
        if !kind.is_extreme() {
            judge(&kind.points(20_000, 1), kind.name());
        }
    }
}

/// Sets that the generators do not make.
#[test]
fn nasty_sets() {
    let mut r = Random::new(9);
    let lattice = |step: f64, w: u32| -> Vec<[f64; 2]> {
        (0..w * w).map(|i| [step * f64::from(i % w), step * f64::from(i / w)]).collect()
    };
    let mut sets: Vec<Vec<[f64; 2]>> = vec![
        lattice(1.0, 30),
        lattice(5e-324, 20),
        lattice(f64::from_bits(1 << 14), 20),
        lattice(2f64.powi(1000), 20),
        // A hexagonal lattice: six cocircular points everywhere, in integers.
        (0..600).map(|i| [f64::from(2 * (i % 25) + i / 25 % 2), f64::from(i / 25)]).collect(),
        // Lines along the axes, and one that leans.
        (0..200).map(|i| [f64::from(i), 0.0]).collect(),
        (0..200).map(|i| [-0.0, f64::from(i)]).collect(),
        (0..200).map(|i| [f64::from(i), 3.0 * f64::from(i)]).collect(),
        // 1e-300 beside 1e300, and what is between.
        (0..200).map(|i| [10f64.powi(3 * (i - 100)), f64::from(i)]).collect(),
        (0..200).map(|i| [if i % 2 == 0 { 1e300 } else { 1e-300 } * r.unit(), 1e-300 * r.unit()]).collect(),
        (0..200).map(|_| [5e-324 * r.below(20) as f64, f64::MAX * r.between(-1.0, 1.0)]).collect(),
    ];
    // Duplicates in the corners that cuts have, with both zeros.
    let mut crossed: Vec<[f64; 2]> = Vec::new();
    for _ in 0..300 {
        let zero = |r: &mut Random| [0.0, -0.0, 1.0, -1.0, 5e-324, -5e-324][r.below(6)];
        crossed.push([zero(&mut r), zero(&mut r)]);
    }
    crossed.extend(Kind::Uniform.points(100, 1).iter().map(|p| p.map(|x| x - 0.5)));
    sets.push(crossed);
    // A tenth on a flat arc far around the others.
    let arc = (0..200).map(|i| {
        let t = (f64::from(i) - 100.0) / 1e5;
        [0.5 + 1e4 * t, -10.0 + 1e4 * t * t / 2.0]
    });
    sets.push(Kind::Uniform.points(1800, 1).into_iter().chain(arc).collect());
    // A hole, whose circles are in no tile.
    let around = |[x, y]: &[f64; 2]| (x - 0.5).hypot(y - 0.5) > 0.35;
    sets.push(Kind::Uniform.points(3000, 4).into_iter().filter(around).collect());
    for (k, points) in sets.iter().enumerate() {
        judge(points, &format!("nasty set {k}"));
        let mut shuffled = points.clone();
        r.shuffle(&mut shuffled);
        judge(&shuffled, &format!("nasty set {k}, shuffled"));
    }
}

/// Of evenly spread points little is left open, and all is final at the root.
#[test]
fn borders_are_small() {
    let points = Kind::Uniform.points(100_000, 1);
    let cuts = Cuts::from_sample(&points, 16).expect("finite");
    let found = in_tiles(&points, &cuts, 4);
    assert!(found.widest < points.len() / 10, "{} points of borders", found.widest);
    assert_eq!(found.triangles.len(), 2 * points.len() - 2 - found.hull);
}

/// Each rule is needed: without it there are other triangles.
#[test]
fn every_rule_is_needed() {
    /// The vertices of a border that are corners of open triangles.
    fn without_hull(border: Border) -> Border {
        let is_open = |v: &usize| border.open.iter().flatten().any(|&w| w as usize == *v);
        let kept: Vec<usize> = (0..border.points.len()).filter(is_open).collect();
        let index = |v: u32| kept.binary_search(&(v as usize)).expect("kept") as u32;
        Border {
            points: kept.iter().map(|&v| border.points[v]).collect(),
            ids: kept.iter().map(|&v| border.ids[v]).collect(),
            open: border.open.iter().map(|t| t.map(index)).collect(),
        }
    }
    /// With all triangles of its points.
    fn all_open(border: Border) -> Border {
        let tile = Tile::new(&border.points, &Region::ALL).expect("finite");
        let open = tile.finals().map(|t| t.map(|v| tile.order()[v as usize])).collect();
        Border { open, ..border }
    }
    fn none_open(border: Border) -> Border {
        Border { open: Vec::new(), ..border }
    }
    fn grown(region: Region) -> Region {
        Region { low: region.low.map(|x| x - 0.01), high: region.high.map(|x| x + 0.01) }
    }
    let points = Kind::Uniform.points(5_000, 1);
    let cuts = Cuts::from_sample(&points, 16).expect("finite");
    let expected = in_tiles(&points, &cuts, 1).fingerprint;
    let found = |region: fn(Region) -> Region, change: fn(Border) -> Border| {
        by_rules(&points, &cuts, 1, region, change).fingerprint
    };
    assert_eq!(found(|region| region, |border| border), expected);
    assert_ne!(found(|region| region, without_hull), expected, "the hull travels");
    assert_ne!(found(|region| region, all_open), expected, "triangles of one part that were not open go");
    assert_ne!(found(|region| region, none_open), expected, "those that were stay");
    assert_ne!(found(grown, |border| border), expected, "circles are inside of the region");
}

/// A tile names what is wrong with its points.
#[test]
fn points_that_are_none_are_named() {
    let region = Region { low: [0.0; 2], high: [1.0; 2] };
    assert!(matches!(
        Tile::new(&[[0.5, 0.5], [0.5, f64::NAN]], &region),
        Err(Error::NotFinite { index: 1, axis: 1, .. })
    ));
    for at in [[1.0, 0.5], [0.5, 1.0], [-0.1, 0.5], [0.5, -0.1]] {
        let found = Tile::new(&[[0.0, 0.0], at, [7.0, 7.0]], &region).err();
        let axis = usize::from((0.0..1.0).contains(&at[0]));
        assert_eq!(found, Some(Error::OutsideRegion { index: 1, axis, value: at[axis] }));
    }
    assert!(Tile::new(&[], &region).is_ok_and(|tile| tile.border(u64::from) == Border::default()));
}

/// So does a join.
#[test]
fn borders_that_are_none_are_named() {
    let border = |x: f64| Border { points: vec![[x, 0.0], [x, 1.0]], ids: vec![1, 2], open: Vec::new() };
    let region = Region { low: [0.0, f64::NEG_INFINITY], high: [9.0, 2.0] };
    let problem = |index, problem| Some(Error::Border { index, problem });
    let found = |second: Border| join(&[border(1.0), second], &region).err();
    assert_eq!(found(border(2.0)), None);
    assert_eq!(found(border(9.0)), problem(1, BorderProblem::Outside { point: 0 }));
    assert_eq!(found(border(1.0)), problem(1, BorderProblem::Twice { point: 0 }));
    let without = Border { ids: vec![1], ..border(2.0) };
    assert_eq!(found(without), problem(1, BorderProblem::Ids { points: 2, ids: 1 }));
    let broken = Border { open: vec![[0, 1, 0], [0, 1, 2]], ..border(2.0) };
    assert_eq!(found(broken), problem(1, BorderProblem::Corner { simplex: 1, points: 2 }));
    let strange = Border { points: vec![[2.0, 0.0], [f64::INFINITY, 1.0]], ..border(2.0) };
    assert_eq!(found(strange), problem(1, BorderProblem::NotFinite { point: 1 }));
}

/// A window grows until nothing is open in it, by what is open and by guesses; what is seen then is what memory shows.
#[test]
fn what_is_seen_through_a_window_is_final() {
    let clip = |box_: Region, p: [f64; 2]| (0..2).all(|k| box_.low[k] <= p[k] && p[k] <= box_.high[k]);
    let (mut alone, mut seen) = (0, 0);
    for &kind in Kind::ALL {
        let points = kind.points(3000, 5);
        let all = Delaunay2::from_points(&points).expect("finite");
        let mut sorted: Vec<Triangle> =
            all.simplices().map(|t| all.corners(t).map(|v| all.point(v))).collect();
        sorted.iter_mut().for_each(|t| t.sort_by(|p, q| p.partial_cmp(q).expect("numbers")));
        for center in points.iter().step_by(if all_cases() { 601 } else { 1601 }) {
            let near = points.iter().map(|p| (p[0] - center[0]).abs().max((p[1] - center[1]).abs()));
            let mut near: Vec<f64> = near.collect();
            near.sort_by(f64::total_cmp);
            let side = near[20];
            let window = Region { low: center.map(|x| x - side), high: center.map(|x| x + side) };
            let mut region = window;
            let tile = loop {
                let inside: Vec<_> = points.iter().copied().filter(|&p| region.contains(p)).collect();
                let tile = Tile::new(&inside, &region).expect("inside");
                let open = tile.border(u64::from).open_in(&region, &window);
                if open.is_empty() {
                    break tile;
                }
                for k in 0..2 {
                    let low = open.iter().map(|r| r.low[k]).fold(f64::INFINITY, f64::min);
                    let high = open.iter().map(|r| r.high[k]).fold(f64::NEG_INFINITY, f64::max);
                    let step = 0.5 * (region.high[k] - region.low[k]) + side;
                    // A step at least, and not more than is asked for beyond it; where nothing is known, all.
                    let is_all = step > 1e3 * side || !step.is_finite() || step == 0.0;
                    region.low[k] = if is_all {
                        f64::NEG_INFINITY
                    } else {
                        (region.low[k] - step).max(low).min(region.low[k] - 0.1 * step)
                    };
                    region.high[k] = if is_all {
                        f64::INFINITY
                    } else {
                        (region.high[k] + step).min(high).max(region.high[k] + 0.1 * step)
                    };
                }
            };
            alone += usize::from(tile.points().len() < points.len() / 4);
            let meets = |t: &Triangle| {
                (0..2).all(|k| {
                    t.iter().any(|p| p[k] >= window.low[k]) && t.iter().any(|p| p[k] <= window.high[k])
                })
            };
            let of_tile = tile.finals().chain(tile.open()).map(|t| t.map(|v| tile.points()[v as usize]));
            let mut of_tile: Vec<Triangle> =
                of_tile.filter(|t| meets(t) && t.iter().any(|&p| clip(window, p))).collect();
            of_tile.iter_mut().for_each(|t| t.sort_by(|p, q| p.partial_cmp(q).expect("numbers")));
            of_tile.sort_by(|s, t| s.partial_cmp(t).expect("numbers"));
            let mut of_all: Vec<Triangle> =
                sorted.iter().copied().filter(|t| t.iter().any(|&p| clip(window, p))).collect();
            of_all.sort_by(|s, t| s.partial_cmp(t).expect("numbers"));
            assert_eq!(of_tile, of_all, "{} {center:?}", kind.name());
            seen += of_all.len();
        }
    }
    // Most were alone, so this has seen what it should.
    let windows = if all_cases() { 3 } else { 1 };
    assert!(alone > 17 * windows && seen > 1700 * windows, "{alone} {seen}");
}
