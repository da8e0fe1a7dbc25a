//! Voronoi cells clipped to regions: they tile, and hold what is nearest to their sites.

use std::f64::consts::TAU;

use delone::{Bounds, Cell2, Delaunay2, MERGE_AUTO, Region2, VertexId};
use delone_generators::Random;

use crate::attack::{Attack, Judgement};
use crate::nasty::{self, integer, once_in, pick};
use crate::oracle::hull::by_distance;
use crate::oracle::rings::{Ring, crossing, even_odd, exact_area, from_side, is_proper, tile};

/// How many points are asked whose they are.
const SAMPLES: usize = 30;

/// See the module.
pub(crate) struct Cells;

/// A site, a ring of the region's border, or a rectangle, which is the region instead of all rings.
#[derive(Clone, Debug)]
pub(crate) enum Item {
    Site([f64; 2]),
    Ring(Vec<[f64; 2]>),
    Rectangle([f64; 2], [f64; 2]),
}

/// Where a region has its corners: on Voronoi vertices and edges, on grid lines, on sites, or anywhere.
fn corner(random: &mut Random, sites: &[[f64; 2]]) -> [f64; 2] {
    let site = |r: &mut Random| if sites.is_empty() { [0.0, 0.0] } else { sites[r.below(sites.len())] };
    let [a, b, c] = [(); 3].map(|()| site(random));
    let at = match random.below(5) {
        0 => circumcenter(a, b, c),
        1 => [a[0] / 2.0 + b[0] / 2.0, a[1] / 2.0 + b[1] / 2.0],
        2 => [a[0], b[1]],
        3 => [integer(random, 8) / 2.0, integer(random, 8) / 2.0],
        _ => nasty::query(random, sites),
    };
    if at.iter().all(|x| x.is_finite()) { at } else { a }
}

fn circumcenter(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> [f64; 2] {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let area = 2.0 * (u[0] * v[1] - u[1] * v[0]);
    let (uu, vv) = (u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1]);
    [a[0] + (v[1] * uu - u[1] * vv) / area, a[1] + (u[0] * vv - v[0] * uu) / area]
}

fn rectangle(random: &mut Random, sites: &[[f64; 2]]) -> Item {
    let (p, q) = (corner(random, sites), corner(random, sites));
    Item::Rectangle([p[0].min(q[0]), p[1].min(q[1])], [p[0].max(q[0]), p[1].max(q[1])])
}

fn square([x, y]: [f64; 2], [w, h]: [f64; 2]) -> Vec<[f64; 2]> {
    vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]]
}

/// Regions as large as the sites, about them: many sides, stars, holes, corners on what cells have.
fn around(random: &mut Random, sites: &[[f64; 2]]) -> Vec<Item> {
    let bounds = Bounds::of(sites.iter().copied());
    let [middle, half] =
        [1.0, -1.0].map(|sign| [0, 1].map(|k| bounds.high[k] / 2.0 + sign * bounds.low[k] / 2.0));
    let size = half[0].max(half[1]) * pick(random, &[1.0, 1.25, 0.7, 0.31]);
    let ring = |radius: f64, inner: f64, count: usize, turn: f64| {
        let corner = |i: usize| {
            let angle = TAU * i as f64 / count as f64 + turn;
            let radius = if i.is_multiple_of(2) { radius } else { inner };
            [middle[0] + radius * angle.cos(), middle[1] + radius * angle.sin()]
        };
        (0..count).map(corner).collect::<Vec<_>>()
    };
    let count = 3 + random.below(40);
    let turn = pick(random, &[0.0, 0.1, TAU / 8.0]);
    let mut rings = match random.below(4) {
        0 => vec![ring(size, size, count, turn)],
        1 => vec![ring(size, size * 0.4, 2 * count, turn)],
        2 => vec![vec![
            bounds.low,
            [bounds.high[0], bounds.low[1]],
            bounds.high,
            [bounds.low[0], bounds.high[1]],
        ]],
        _ => {
            let mut corners: Vec<[f64; 2]> =
                (0..3 + random.below(12)).map(|_| corner(random, sites)).collect();
            let angle = |p: &[f64; 2]| (p[1] - middle[1]).atan2(p[0] - middle[0]);
            corners.sort_by(|p, q| angle(p).total_cmp(&angle(q)));
            corners.dedup();
            vec![corners]
        }
    };
    match random.below(4) {
        0 => rings.push(ring(size * 0.3, size * 0.3, 3 + random.below(9), turn)),
        1 => rings.push((0..3).map(|_| corner(random, sites)).collect()),
        2 => {
            let at = corner(random, sites);
            rings.push(square(at, [size * 0.1, size * 0.2]));
        }
        _ => {}
    }
    rings.into_iter().map(Item::Ring).collect()
}

/// A region's rings, proper or not: what is not is refused, and nothing more is asked.
fn region(random: &mut Random, sites: &[[f64; 2]]) -> Vec<Item> {
    let size = pick(random, &[1.0, 4.0, 0.1, 10.0]);
    let ring = |points: Vec<[f64; 2]>| Item::Ring(points);
    match random.below(7) {
        0 => vec![rectangle(random, sites)],
        // Corners around a point, by angle: proper most of the time.
        1 | 2 => {
            let middle = corner(random, sites);
            let mut corners: Vec<[f64; 2]> =
                (0..3 + random.below(8)).map(|_| corner(random, sites)).collect();
            let angle = |p: &[f64; 2]| (p[1] - middle[1]).atan2(p[0] - middle[0]);
            corners.sort_by(|p, q| angle(p).total_cmp(&angle(q)));
            vec![ring(corners)]
        }
        // Frames with holes and islands, and holes that touch in corners.
        3 => {
            let mut rings = vec![ring(square([-8.0 * size, -8.0 * size], [16.0 * size; 2]))];
            for (x, y) in [(-4.0, -4.0), (-2.0, -2.0), (0.0, 0.0), (1.0, -5.0)] {
                if once_in(random, 2) {
                    rings.push(ring(square([x * size, y * size], [2.0 * size; 2])));
                }
            }
            if once_in(random, 2) {
                rings.push(ring(square([0.5 * size, 0.5 * size], [size; 2])));
            }
            rings
        }
        // A comb.
        4 => {
            let teeth = 2 + random.below(12);
            let mut points = vec![[teeth as f64 * size, -size], [0.0, -size]];
            for i in 0..teeth {
                let x = i as f64 * size;
                points.push([x, 5.0 * size]);
                points.push([x + size / 2.0, pick(random, &[0.0, size, 4.0 * size])]);
            }
            points.push([teeth as f64 * size, 5.0 * size]);
            points.reverse();
            vec![ring(points)]
        }
        // A star of many corners.
        5 => {
            let count = 2 * (3 + random.below(40));
            let at = corner(random, sites);
            let point = |i: usize| {
                let (angle, radius) =
                    (TAU * i as f64 / count as f64, if i.is_multiple_of(2) { 4.0 } else { 1.5 });
                [at[0] + size * radius * angle.cos(), at[1] + size * radius * angle.sin()]
            };
            vec![ring((0..count).map(point).collect())]
        }
        // Two rings that share corners.
        _ => {
            let shared = corner(random, sites);
            let mut other = |dx: f64, dy: f64| {
                let [x, y] = corner(random, sites);
                vec![shared, [x + dx, y], [x, y + dy]]
            };
            vec![ring(other(1.0, 2.0)), ring(other(-1.0, 3.0))]
        }
    }
}

impl Attack for Cells {
    type Item = Item;

    fn make(random: &mut Random) -> Vec<Item> {
        let mut sites = nasty::points::<2>(random, 40);
        if once_in(random, 3) {
            sites = (0..=random.below(60))
                .map(|_| [random.between(-5.0, 5.0), random.between(-5.0, 5.0)])
                .collect();
        }
        let mut items = if once_in(random, 2) {
            sites = nasty::everyday(random, 40);
            if once_in(random, 3) { vec![rectangle(random, &sites)] } else { around(random, &sites) }
        } else {
            region(random, &sites)
        };
        items.extend(sites.into_iter().map(Item::Site));
        items
    }

    fn judge(items: &[Item], seed: u64) -> Judgement {
        let sites: Vec<[f64; 2]> =
            items.iter().filter_map(|item| if let Item::Site(p) = item { Some(*p) } else { None }).collect();
        let rings: Vec<Vec<[f64; 2]>> = items
            .iter()
            .filter_map(|item| if let Item::Ring(ring) = item { Some(ring.clone()) } else { None })
            .collect();
        let rectangle = items.iter().find_map(|item| match item {
            Item::Rectangle(low, high) => Some((*low, *high)),
            _ => None,
        });
        let region = match rectangle {
            Some((low, high)) => Region2::rectangle(low, high),
            None => Region2::polygon(&rings),
        };
        let d = Delaunay2::from_points(&sites).map_err(|error| error.to_string())?;
        let region = match region {
            Ok(region) => region,
            Err(error) if rectangle.is_none() && is_proper(&rings) => {
                return Err(format!("a region is refused, but nothing meets in it: {error}"));
            }
            Err(_) => return Ok(()),
        };
        if d.vertex_count() == 0 {
            return Ok(());
        }
        let rings: Vec<Vec<[f64; 2]>> = region.rings().map(<[_]>::to_vec).collect();
        crossing(&rings)?;
        judge_cells(&d, &region, &rings, &sites, seed)
    }
}

fn judge_cells(
    d: &Delaunay2,
    region: &Region2,
    rings: &[Vec<[f64; 2]>],
    sites: &[[f64; 2]],
    seed: u64,
) -> Judgement {
    let cells = d.voronoi().clip(region);
    let of = |cell: Cell2<'_>| -> Vec<Ring> { cell.rings().map(|ring| ring.points().collect()).collect() };
    let all: Vec<Vec<Ring>> = d.vertices().map(|v| of(cells.cell(v))).collect();
    tile(&all, rings).map_err(|wrong| format!("clipped to {rings:?}: {wrong}"))?;
    for (v, expected) in d.vertices().zip(&all) {
        let alone = d.voronoi().cell(v, region);
        if turned(&alone) != turned(expected) {
            return Err(format!("the cell of {v:?} is {expected:?}, and alone {alone:?}"));
        }
    }
    let mut one_by_one: Vec<(VertexId, Vec<Ring>)> = Vec::new();
    d.voronoi().clip_each(region, |v, cell| one_by_one.push((v, of(cell))));
    one_by_one.sort_by_key(|cell| cell.0);
    if !one_by_one.iter().map(|(v, cell)| (*v, cell)).eq(d.vertices().zip(&all)) {
        return Err(format!("cells are {all:?}, and one after the other {one_by_one:?}"));
    }
    let [low, high] = region.bounds();
    let largest = low.iter().chain(&high).fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let (width, height) = (high[0] - low[0], high[1] - low[1]);
    let diagonal = width.hypot(height);
    let length = pick(&mut Random::new(seed), &[0.0, MERGE_AUTO * largest, diagonal / 16.0, diagonal]);
    if length.is_finite() {
        let merged = cells.clone().merged(length, region).map_err(|error| error.to_string())?;
        let all: Vec<Vec<Ring>> = d.vertices().map(|v| of(merged.cell(v))).collect();
        tile(&all, rings).map_err(|wrong| format!("clipped to {rings:?}, merged by {length}: {wrong}"))?;
    }
    for v in d.vertices() {
        for p in cells.rings(v).flat_map(|ring| ring.points()) {
            let slack = 1e-9 * diagonal;
            let inside = (0..2).all(|k| low[k] - slack <= p[k] && p[k] <= high[k] + slack);
            if !inside && slack.is_finite() {
                return Err(format!("the cell of {v:?} has the corner {p:?}, not in {low:?} to {high:?}"));
            }
        }
    }
    // Areas beyond the range of numbers, and those of which rounding leaves nothing, say nothing.
    if !(1e-140..1e140).contains(&diagonal) || diagonal < 1e-6 * largest {
        return Ok(());
    }
    let whole = exact_area(rings);
    let tolerance = 1e-10 * diagonal * diagonal + 64.0 * f64::EPSILON * largest * diagonal;
    if (region.area() - whole).abs() > tolerance || region.area().is_nan() {
        return Err(format!("the area of the region is {} instead of {whole}", region.area()));
    }
    let mut sum = 0.0;
    for v in d.vertices() {
        let area = cells.area(v);
        if area.is_nan() || area < -tolerance {
            return Err(format!("the cell of {v:?} has the area {area}"));
        }
        let alone = d.voronoi().cell(v, region);
        let alone: f64 = alone.iter().map(|ring| shoelace(ring)).sum();
        if alone.is_nan() || (alone - area).abs() > tolerance {
            return Err(format!("the cell of {v:?} has the area {area}, and alone {alone}"));
        }
        sum += area;
    }
    if (sum - whole).abs() > tolerance * (1.0 + d.vertex_count() as f64).sqrt() {
        return Err(format!("the areas of the cells add up to {sum} instead of {whole}"));
    }
    whose(d, &cells, rings, sites, (low, high), seed)
}

/// Rings as bits, each from its least corner on, and these in order.
fn turned(rings: &[Ring]) -> Vec<Vec<[u64; 2]>> {
    let from_least = |ring: &Ring| {
        let mut corners: Vec<[u64; 2]> = ring.iter().map(|p| p.map(f64::to_bits)).collect();
        let least = (0..corners.len()).min_by_key(|&i| corners[i]).unwrap_or(0);
        corners.rotate_left(least);
        corners
    };
    let mut all: Vec<_> = rings.iter().map(from_least).collect();
    all.sort_unstable();
    all
}

fn shoelace(ring: &[[f64; 2]]) -> f64 {
    let Some(&[x, y]) = ring.first() else { return 0.0 };
    let cross = |(p, q): (&[f64; 2], &[f64; 2])| (p[0] - x) * (q[1] - y) - (p[1] - y) * (q[0] - x);
    ring.iter().zip(ring.iter().cycle().skip(1)).map(cross).sum::<f64>() / 2.0
}

/// Points of the region are in the cell of the nearest site, those very near its border excepted.
fn whose(
    d: &Delaunay2,
    cells: &delone::Cells2,
    rings: &[Vec<[f64; 2]>],
    sites: &[[f64; 2]],
    (low, high): ([f64; 2], [f64; 2]),
    seed: u64,
) -> Judgement {
    let mut random = Random::new(seed);
    let diagonal = (high[0] - low[0]).hypot(high[1] - low[1]);
    for _ in 0..SAMPLES {
        let q = [0, 1].map(|k| random.between(low[k], high[k]));
        let Some(nearest) = by_distance(sites, q, false) else { return Ok(()) };
        let inside = even_odd(rings, q);
        for v in d.vertices() {
            let cell: Vec<Vec<[f64; 2]>> = cells.rings(v).map(|ring| ring.points().collect()).collect();
            let is_its = even_odd(&cell, q);
            if is_its == (inside && v == VertexId::new(nearest)) {
                continue;
            }
            let border = [rings, &cell, &cells_of(cells, nearest)].concat();
            if from_border(&border, q) > 1e-7 * diagonal
                && from_bisectors(sites, nearest, q) > 1e-7 * diagonal
            {
                let verb = if is_its { "is" } else { "is not" };
                return Err(format!(
                    "{q:?} {verb} in the cell of {v:?}; nearest is {nearest}, in the region {inside}"
                ));
            }
        }
    }
    Ok(())
}

fn cells_of(cells: &delone::Cells2, site: usize) -> Vec<Vec<[f64; 2]>> {
    cells.rings(VertexId::new(site)).map(|ring| ring.points().collect()).collect()
}

/// The distance of a point from the nearest side, rounded.
fn from_border(rings: &[Vec<[f64; 2]>], q: [f64; 2]) -> f64 {
    let sides = rings
        .iter()
        .flat_map(|ring| (0..ring.len()).map(|i| from_side(ring[i], ring[(i + 1) % ring.len()], q)));
    sides.fold(f64::INFINITY, f64::min)
}

/// The distance of a point from the nearest bisector of its nearest site and another one, rounded.
fn from_bisectors(sites: &[[f64; 2]], nearest: usize, q: [f64; 2]) -> f64 {
    let a = sites[nearest];
    let from = |b: &[f64; 2]| {
        let u = [b[0] - a[0], b[1] - a[1]];
        let middle = [a[0] / 2.0 + b[0] / 2.0 - q[0], a[1] / 2.0 + b[1] / 2.0 - q[1]];
        let size = u[0].hypot(u[1]);
        (middle[0] * (u[0] / size) + middle[1] * (u[1] / size)).abs()
    };
    sites.iter().filter(|b| **b != a).map(from).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::from_border;

    #[test]
    fn distances_from_the_nearest_side() {
        let square = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        assert_eq!(from_border(&[square], [0.25, 0.5]), 0.25);
    }
}
