//! Clipped cells tile their region whatever falls on its border: circumcenters, midpoints, lattices, combs, all scales.

use delone::{Cells2, Delaunay2, Region2, VertexId};
use delone_generators::{Kind, Random};
use delone_oracle::share;
use proptest::prelude::*;

type Points = Vec<[f64; 2]>;

fn area_of(ring: &[[f64; 2]]) -> f64 {
    Region2::polygon(&[ring.to_vec()]).map_or(f64::NAN, |region| region.area())
}

fn cells_of(sites: &[[f64; 2]], region: &Region2) -> (Delaunay2, Cells2) {
    let d = Delaunay2::from_points(sites).expect("finite");
    let cells = d.voronoi().clip(region);
    (d, cells)
}

/// The areas of all cells: none negative, none NaN, and all rings inside of the region's box.
fn judge(name: &str, sites: &[[f64; 2]], region: &Region2) -> Vec<f64> {
    let (d, cells) = cells_of(sites, region);
    let [low, high] = region.bounds();
    let areas: Vec<f64> = d.vertices().map(|v| cells.area(v)).collect();
    assert!(areas.iter().all(|&area| area >= 0.0), "{name}: {areas:?} of {sites:?}");
    for ring in d.vertices().flat_map(|v| cells.rings(v)) {
        assert!(ring.indices().len() > 2, "{name}: {:?} of {sites:?}", ring.indices());
        for [p, q] in ring.sides() {
            let inside = (0..2).all(|axis| (low[axis]..=high[axis]).contains(&p[axis]));
            assert!(inside && p != q, "{name}: {p:?} of {sites:?}");
        }
    }
    let (sum, all) = (areas.iter().sum::<f64>(), region.area());
    // Rings are rounded to the last place of their coordinates: far from the origin that is more than 1e-9 of a small region.
    let [w, h] = [0, 1].map(|axis| high[axis] - low[axis]);
    let largest = low.iter().chain(&high).fold(0.0_f64, |max, x| max.max(x.abs()));
    let rounding = 8.0 * f64::EPSILON * largest * (w + h);
    assert!(
        (sum - all).abs() <= 1e-9 * all + rounding || sum == all,
        "{name}: {sum} of {all}, {areas:?} of {sites:?} in {region:?}"
    );
    areas
}

fn rectangle(x0: f64, y0: f64, x1: f64, y1: f64) -> Region2 {
    Region2::rectangle([x0, y0], [x1, y1]).expect("a rectangle")
}

fn regular(n: usize, radius: f64, x: f64, y: f64) -> Points {
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / n as f64;
    (0..n).map(|k| [x + radius * angle(k).cos(), y + radius * angle(k).sin()]).collect()
}

#[test]
fn lattices_of_tenths() {
    let sites: Points = (0..100).map(|i| [f64::from(i / 10) * 0.1, f64::from(i % 10) * 0.1]).collect();
    for (low, high) in [(0.05, 0.85), (0.1 * 0.5, 0.1 * 8.5), (0.15, 0.75)] {
        let areas = judge("tenths", &sites, &rectangle(low, low, high, high));
        let all = areas.iter().filter(|&&area| area > 1e-6);
        assert!(all.clone().count() >= 36 && all.clone().all(|area| (area - 0.01).abs() < 1e-12));
    }
    let hexagonal: Points = (0..400)
        .map(|i| (f64::from(i / 20), f64::from(i % 20)))
        .map(|(i, j)| [(i + 0.5 * (j % 2.0)) * 0.1, j * 0.1 * 3f64.sqrt() / 2.0])
        .collect();
    judge("hexagonal", &hexagonal, &rectangle(0.1, 0.1 / 3f64.sqrt(), 1.0, 1.0));
}

#[test]
fn regular_polygons_around_a_corner_of_the_region() {
    for n in [3, 4, 5, 6, 7, 12, 100] {
        let sites = regular(n, 1.0, 0.0, 0.0);
        for (low, high) in [(0.0, 2.0), (-2.0, 0.0)] {
            judge("regular", &sites, &rectangle(low, low, high, high));
        }
    }
    let far = regular(12, 10.0, 500_000.3, 4_500_000.7);
    judge("far away", &far, &rectangle(500_000.3, 4_500_000.7, 500_020.0, 4_500_020.0));
    for far in [1e3, 1e6, 1e9, 1e12] {
        judge("far around", &regular(9, far, 0.3, 0.7), &rectangle(0.0, 0.0, 1.0, 1.0));
        judge("far aside", &regular(9, 1.0, far, far), &rectangle(0.0, 0.0, 1.0, 1.0));
    }
}

#[test]
fn three_ordinary_sites() {
    let sites = [
        [-0.783_844_115_193_797_4, 1.702_878_682_654_059_8],
        [5.005_507_860_031_199, -0.460_915_807_030_428_1],
        [6.117_392_148_505_074, 0.493_634_864_502_197_5],
    ];
    judge("three", &sites, &rectangle(0.0, 0.0, 3.0, 8.0));
    let combs = [
        vec![
            [0.0, 0.0],
            [3.0, 0.0],
            [3.0, 8.0],
            [2.5, 0.5],
            [2.4, 8.0],
            [2.0, 8.0],
            [1.5, 1e-6],
            [1.4, 8.0],
            [1.0, 8.0],
            [0.5, 1e-6],
            [0.0, 8.0],
        ],
        vec![[0.0, 0.0], [3.0, 0.0], [3.0, 8.0], [2.5, 0.5], [2.4, 8.0], [2.0, 8.0]],
        vec![
            [0.0, 0.0],
            [3.0, 0.0],
            [3.0, 8.0],
            [2.5, 0.5],
            [2.4, 8.0],
            [2.0, 8.0],
            [1.5, 0.1],
            [1.4, 8.0],
            [1.0, 8.0],
            [0.5, 0.1],
            [0.0, 8.0],
        ],
    ];
    for comb in combs {
        let region = Region2::polygon(&[comb]).expect("a comb");
        for some in 1..8_usize {
            let some: Points = (0..3).filter(|k| some >> k & 1 == 1).map(|k| sites[k]).collect();
            judge("comb", &some, &region);
        }
        for some in [vec![[-1.0, 2.0], [5.0, 0.0], [6.0, 1.0]], vec![[1.0, 1.0], [2.0, 2.0]]] {
            judge("comb of integers", &some, &region);
        }
    }
}

#[test]
fn sites_a_few_units_in_the_last_place_apart() {
    let sets: [&[[f64; 2]]; 5] = [
        &[
            [0.999_999_999_999_999_9, 3.999_999_999_999_999],
            [1.0, 2.000_000_000_000_001],
            [-1.000_000_000_000_000_2, 2.000_000_000_000_001],
        ],
        &[[4.999_999_999_999_999, 0.0], [4.999_999_999_999_999, 5e-324]],
        &[
            [7.000_000_000_000_002, 7.000_000_000_000_002],
            [7.000_000_000_000_001, 5.999_999_999_999_999],
            [7.000_000_000_000_001, 7.0],
        ],
        &[
            [-1.000_000_000_000_000_2, 1.999_999_999_999_999_6],
            [-1.000_000_000_000_000_2, 1.999_999_999_999_999_8],
            [0.0, 0.999_999_999_999_999_8],
        ],
        &[[0.0, 0.0], [5e-324, 0.0], [0.0, 5e-324], [5e-324, 1e-323], [1.0, 1.0]],
    ];
    for sites in sets {
        judge("close", sites, &rectangle(0.0, 0.0, 8.0, 8.0));
        judge("close", sites, &rectangle(-8.0, -8.0, 8.0, 0.0));
        let kite = vec![[0.0, 0.0], [5.0, 0.0], [1.0, 1.0], [0.0, 5.0]];
        judge("close", sites, &Region2::polygon(&[kite]).expect("a kite"));
    }
    // Corners halfway between numbers: some cells are nothing but a line when these are rounded.
    let at = |i: u64| f64::from_bits(1.0_f64.to_bits() + i);
    let sites: Points = (0..36).map(|i| [at(i / 6), at(i % 6)]).collect();
    judge("halves", &sites, &rectangle(0.0, 0.0, 4.0, 4.0));
}

#[test]
fn areas_beyond_the_range_are_infinite() {
    let huge = f64::MAX;
    let sites = [[-huge, 0.0], [huge, huge], [huge, -huge], [1.0, 2.0], [1e200, -3e307]];
    let region = rectangle(-huge, -huge, huge, huge);
    assert_eq!(region.area(), f64::INFINITY);
    let (d, cells) = cells_of(&sites, &region);
    assert!(d.vertices().all(|v| cells.area(v) == f64::INFINITY));
    assert!(d.vertices().all(|v| cells.perimeter(v) == f64::INFINITY));
    let center = cells.centroid(VertexId::new(1)).expect("a cell");
    assert!(center.iter().all(|x| x.is_finite() && *x > 1e307), "{center:?}");
    // With a hole as large, and with an area that fits while products on the way do not.
    let ring = |x: f64, y: f64| vec![[-x, -y], [x, -y], [x, y], [-x, y]];
    let frame = Region2::polygon(&[ring(huge, huge), ring(huge / 2.0, huge / 2.0)]).expect("a frame");
    assert_eq!(frame.area(), f64::INFINITY);
    let (d, cells) = cells_of(&[[0.0, 1.0]], &frame);
    assert_eq!(cells.area(d.vertices().next().expect("a site")), f64::INFINITY);
    assert_eq!(cells.rings(VertexId::new(0)).map(|ring| ring.area()).collect::<Vec<_>>().len(), 2);
    let flat =
        Region2::polygon(&[vec![[-huge, -huge], [huge, huge], [huge, huge / 2.0]]]).expect("a triangle");
    assert_eq!(flat.area(), f64::INFINITY);
    assert!((area_of(&ring(huge, 1e-10)) / (4e-10 * huge) - 1.0).abs() < 1e-12);
}

#[test]
fn centers_of_tiny_and_huge_cells() {
    for scale in [1e-300, 1e-150, 1.0, 1e150, 1e300] {
        let at = |x: f64, y: f64| [x * scale, y * scale];
        let region = Region2::rectangle(at(0.0, 0.0), at(4.0, 2.0)).expect("a rectangle");
        let (_, cells) = cells_of(&[at(1.0, 1.0), at(3.0, 1.0)], &region);
        let [x, y] = cells.centroid(VertexId::new(1)).expect("a cell");
        assert!((x / scale - 3.0).abs() < 1e-12 && (y / scale - 1.0).abs() < 1e-12, "{scale}: {x} {y}");
    }
}

#[test]
fn rectilinear_regions_with_many_corners_on_the_cuts() {
    // A staircase and a sieve: sides on cuts of the tree, bisectors on sides, vertices on corners.
    let n = 24;
    let mut stairs: Points = vec![[f64::from(n), 0.0]];
    for i in (0..n).rev() {
        stairs.extend([[f64::from(i + 1), f64::from(n - i)], [f64::from(i), f64::from(n - i)]]);
    }
    stairs.push([0.0, 0.0]);
    let mut sieve = vec![vec![[0.0, 0.0], [24.0, 0.0], [24.0, 24.0], [0.0, 24.0]]];
    for (i, j) in (0..8).flat_map(|i| (0..8).map(move |j| (3.0 * f64::from(i), 3.0 * f64::from(j)))) {
        sieve.push(vec![[i + 1.0, j + 1.0], [i + 2.0, j + 1.0], [i + 2.0, j + 2.0], [i + 1.0, j + 2.0]]);
    }
    for rings in [vec![stairs], sieve] {
        let region = Region2::polygon(&rings).expect("a region");
        for step in [0.5, 1.0, 2.0, 3.0] {
            let count = (26.0 / step) as i32;
            let sites: Points = (0..count)
                .flat_map(|i| (0..count).map(move |j| [f64::from(i) * step, f64::from(j) * step]))
                .collect();
            judge("lattice", &sites, &region);
            let moved: Points = sites.iter().map(|p| p.map(|x| x + step / 2.0)).collect();
            judge("moved lattice", &moved, &region);
        }
    }
}

/// Sites of a kind, at a scale, with what may fall on the border.
fn sites(kind: usize, random: &mut Random) -> Points {
    let n = 3 + random.below(30);
    let coordinate = |random: &mut Random| match kind {
        0 => random.unit(),
        1 => random.below(6) as f64,
        2 => random.below(12) as f64 * 0.1,
        3 => random.below(3) as f64 * f64::from_bits(1) + if random.below(2) == 0 { 0.0 } else { 1.0 },
        4 => f64::from_bits(1.0_f64.to_bits() + random.below(4) as u64),
        5 => 4_500_000.7 + random.below(20) as f64 * 0.1,
        _ => 0.0,
    };
    match kind {
        6 => regular(n, 1.0, 0.0, 0.0),
        7 => regular(n, 0.1, 0.3, 0.7),
        8 => (0..n).map(|_| random.unit()).map(|x| [x, 0.1 + 0.3 * x]).collect(),
        _ => (0..n).map(|_| [coordinate(random), coordinate(random)]).collect(),
    }
}

/// Every edge of a cell is that of its neighbor, the other way round and to the bit, or on the border.
#[test]
fn neighbors_share_their_corners_to_the_bit() {
    let tenths: Points = (0..400).map(|i| [f64::from(i / 20) * 0.1, f64::from(i % 20) * 0.1]).collect();
    let mut sets = vec![("tenths", tenths)];
    sets.extend([7, 12, 100].map(|n| ("regular", regular(n, 1.0, 0.5, 0.5))));
    sets.extend([Kind::Uniform, Kind::Grid, Kind::Clusters].map(|kind| (kind.name(), kind.points(500, 1))));
    for (name, sites) in sets {
        let most = sites.iter().flatten().fold(0.0_f64, |max, x| max.max(*x));
        let region = rectangle(0.2 * most, 0.1 * most, 0.85 * most, 0.95 * most);
        let (d, cells) = cells_of(&sites, &region);
        let [low, high] = region.bounds();
        let mut edges: Vec<[[u64; 2]; 2]> = Vec::new();
        for [p, q] in d.vertices().flat_map(|v| cells.rings(v)).flat_map(|ring| ring.sides()) {
            let on_border = (0..2).any(|k| p[k] == q[k] && (p[k] == low[k] || p[k] == high[k]));
            if !on_border {
                edges.push([p, q].map(|p| p.map(f64::to_bits)));
            }
        }
        edges.sort_unstable();
        let alone = edges.iter().filter(|[p, q]| edges.binary_search(&[*q, *p]).is_err()).count();
        assert_eq!(alone, 0, "{name}: of {} edges", edges.len());
        assert!(edges.len() > 12, "{name}");
    }
}

/// Numbers that the diagram has on its own: circumcenters that are not far away, midpoints, sites.
fn landmarks(d: &Delaunay2) -> Points {
    let largest = d.points().iter().flatten().fold(0.0_f64, |max, x| max.max(x.abs()));
    let near = |p: &[f64; 2]| p.iter().all(|x| x.abs() <= 1e7 * largest);
    let mut marks: Points = d.voronoi().vertices().flatten().filter(near).collect();
    for v in d.vertices() {
        marks.push(d.point(v));
        for w in d.voronoi().neighbors(v) {
            marks.push([0, 1].map(|axis| f64::midpoint(d.point(v)[axis], d.point(w)[axis])));
        }
    }
    marks
}

proptest! {
    #![proptest_config(ProptestConfig { cases: share(3000) as u32, ..ProptestConfig::default() })]

    #[test]
    fn cells_tile_regions_made_of_landmarks(kind in 0..9_usize, seed in any::<u64>(), scale in -3..4_i32) {
        let mut random = Random::new(seed);
        let mut points = sites(kind, &mut random);
        if kind != 3 {
            let factor = 2f64.powi(scale * 100);
            points.iter_mut().for_each(|p| *p = p.map(|x| x * factor));
        }
        let d = Delaunay2::from_points(&points).expect("finite");
        let marks = landmarks(&d);
        let mut mark = || marks[random.below(marks.len())];
        for _ in 0..4 {
            let (p, q) = (mark(), mark());
            let (low, high) = ([p[0].min(q[0]), p[1].min(q[1])], [p[0].max(q[0]), p[1].max(q[1])]);
            if let Ok(region) = Region2::rectangle(low, high) {
                judge("rectangle", &points, &region);
            }
            // Most are no polygons.
            for corners in 3..8 {
                let ring: Points = (0..corners).map(|_| mark()).collect();
                if let Ok(region) = Region2::polygon(&[ring]) {
                    judge("polygon", &points, &region);
                }
            }
            // A star around a landmark.
            let mut star: Points = (0..40).map(|_| mark()).filter(|&m| m != p).collect();
            let angle = |m: &[f64; 2]| (m[1] - p[1]).atan2(m[0] - p[0]);
            star.sort_by(|m, n| angle(m).total_cmp(&angle(n)));
            star.dedup_by_key(|m| angle(m));

            if let Ok(region) = Region2::polygon(&[star]) {

                judge("star", &points, &region);
            }
            // A comb between landmarks.
            let (mut comb, teeth) = (vec![p], 5);
            for i in 0..teeth {
                let x = p[0] + (q[0] - p[0]) * f64::from(i) / f64::from(teeth);
                comb.extend([[x, q[1]], [x, p[1].midpoint(q[1])]]);
            }
            comb.push([q[0], p[1]]);
            if let Ok(region) = Region2::polygon(&[comb]) {
                judge("comb", &points, &region);
            }
        }
        if let Ok(hull) = Region2::hull(&d) {
            judge("hull", &points, &hull);
        }
    }
}
