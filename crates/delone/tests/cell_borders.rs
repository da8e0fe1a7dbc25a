//! Borders of clipped cells against their definition: the part of a bisector that is in the region and to which no other site is nearer.

use delone::{Cells2, Delaunay2, Region2, Regular2, VertexId};
use delone_generators::Random;
use delone_oracle::share;

type Site = ([f64; 2], f64);

/// The length of the border of two cells: the line between both is cut where another site or the region may end it, and each part is judged in
/// its middle.
fn length(all: &[Site], region: &Region2, [i, j]: [usize; 2]) -> f64 {
    let dot = |u: [f64; 2], v: [f64; 2]| u[0] * v[0] + u[1] * v[1];
    // Twice the scalar product with a place, for the difference of two powers.
    let row = |k: usize, l: usize| {
        let ([p, w], [q, u]) = ([all[k].0, [all[k].1; 2]], [all[l].0, [all[l].1; 2]]);
        ([2.0 * (q[0] - p[0]), 2.0 * (q[1] - p[1])], dot(q, q) - u[0] - dot(p, p) + w[0])
    };
    let (n, c) = row(i, j);
    let square = dot(n, n);
    let (foot, along) = (n.map(|x| x * c / square), [-n[1] / square.sqrt(), n[0] / square.sqrt()]);
    let at = |t: f64| [foot[0] + t * along[0], foot[1] + t * along[1]];
    let mut cuts = Vec::new();
    let others = (0..all.len()).filter(|&k| k != i && k != j);
    for (n, c) in others.clone().map(|k| row(i, k)) {
        let slope = dot(n, along);
        if slope.abs() > 1e-12 {
            cuts.push((c - dot(n, foot)) / slope);
        }
    }
    let rings: Vec<Vec<[f64; 2]>> = region.rings().map(<[_]>::to_vec).collect();
    let sides =
        || rings.iter().flat_map(|ring| (0..ring.len()).map(|k| [ring[k], ring[(k + 1) % ring.len()]]));
    for [p, q] in sides() {
        let (side, to) = ([q[0] - p[0], q[1] - p[1]], [p[0] - foot[0], p[1] - foot[1]]);
        let cross = along[0] * side[1] - along[1] * side[0];
        if cross.abs() > 1e-12 {
            cuts.push((to[0] * side[1] - to[1] * side[0]) / cross);
        }
    }
    cuts.sort_by(f64::total_cmp);
    let is_in = |m: [f64; 2]| {
        let crossed = sides().filter(|[p, q]| {
            (p[1] > m[1]) != (q[1] > m[1]) && m[0] < p[0] + (m[1] - p[1]) / (q[1] - p[1]) * (q[0] - p[0])
        });
        crossed.count() % 2 == 1
    };
    let is_part = |m: [f64; 2]| {
        let is_least = |k| {
            let (n, c) = row(i, k);
            dot(n, m) <= c + 1e-12
        };
        is_in(m) && others.clone().all(is_least)
    };
    let parts = cuts
        .windows(2)
        .filter(|ends| ends[1] - ends[0] > 1e-9 && is_part(at(f64::midpoint(ends[0], ends[1]))));
    parts.map(|ends| ends[1] - ends[0]).sum()
}

fn judge(cells: &Cells2, all: &[Site], region: &Region2, what: &str) -> usize {
    let found = cells.borders();
    assert!(found.is_sorted_by(|a, b| a.0 < b.0), "{what}: {found:?}");
    let mut count = 0;
    for j in 0..all.len() {
        for i in (0..j).filter(|&i| all[i].0 != all[j].0) {
            let expected = length(all, region, [i, j]);
            let pair = [i, j].map(VertexId::new);
            let border = found.iter().find(|border| border.0 == pair).map_or(0.0, |border| border.1);
            assert!(
                (border - expected).abs() < 1e-7,
                "{what}, {pair:?}: {border}, not {expected}, of {all:?}"
            );
            count += usize::from(expected > 0.0);
        }
    }
    // What rounding makes is short.
    assert!(found.iter().filter(|border| border.1 > 1e-7).count() <= count, "{what}: {found:?}");
    count
}

#[test]
fn borders_are_parts_of_bisectors() {
    let mut random = Random::new(11);
    let polygon = |rings: &[&[[f64; 2]]]| {
        Region2::polygon(&rings.iter().map(|ring| ring.to_vec()).collect::<Vec<_>>()).expect("a polygon")
    };
    let regions = [
        Region2::rectangle([-0.07, 0.03], [4.01, 3.52]).expect("a box"),
        polygon(&[&[[0.1, 0.13], [3.9, 0.11], [1.03, 1.07], [0.21, 4.3]]]),
        polygon(&[
            &[[-1.1, -1.2], [5.3, -1.1], [5.2, 5.4], [-1.3, 5.1]],
            &[[0.71, 0.83], [3.13, 0.77], [2.9, 3.01], [0.93, 2.87]],
        ]),
        // A comb, in which cells fall apart.
        polygon(&[&[[0.0, -0.9], [4.1, -0.9], [4.1, 5.0], [3.1, 0.3], [2.1, 5.0], [1.1, 0.2], [0.0, 5.0]]]),
    ];
    let mut counts = [0; 2];
    for round in 0..share(160) {
        let region = &regions[round % regions.len()];
        let is_lattice = random.below(3) == 0;
        let points: Vec<[f64; 2]> = (0..=random.below(14))
            .map(|_| {
                [(); 2].map(|()| if is_lattice { random.below(5) as f64 } else { random.between(-0.5, 4.5) })
            })
            .collect();
        let plain: Vec<Site> = points.iter().map(|&p| (p, 0.0)).collect();
        let d = Delaunay2::from_points(&points).expect("finite");
        let distinct = d.duplicates().count() == 0;
        if distinct {
            counts[0] += judge(&d.voronoi().clip(region), &plain, region, &format!("round {round}"));
        }
        let weighted: Vec<Site> = points.iter().map(|&p| (p, random.between(0.0, 1.0))).collect();
        let r = Regular2::from_sites(&weighted).expect("finite");
        if distinct {
            counts[1] +=
                judge(&r.power().clip(region), &weighted, region, &format!("round {round}, weights"));
        }
    }
    assert!(counts.iter().all(|&count| count > share(160)), "{counts:?}");
    assert!(Cells2::default().borders().is_empty());
}
