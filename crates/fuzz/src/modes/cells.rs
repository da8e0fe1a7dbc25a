//! Voronoi cells clipped to regions: they tile, and hold what is nearest to their sites.

use std::f64::consts::TAU;

use delone::{Delaunay2, Region2, VertexId};
use delone_generators::Random;
use num_bigint::BigInt;

use crate::attack::{Attack, Judgement};
use crate::nasty::{self, integer, once_in, pick};
use crate::oracle::exact::{Vector, integers, is_inside, orientation, scale};
use crate::oracle::hull::by_distance;

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
        0 => circumcentre(a, b, c),
        1 => [a[0] / 2.0 + b[0] / 2.0, a[1] / 2.0 + b[1] / 2.0],
        2 => [a[0], b[1]],
        3 => [integer(random, 8) / 2.0, integer(random, 8) / 2.0],
        _ => nasty::query(random, sites),
    };
    if at.iter().all(|x| x.is_finite()) { at } else { a }
}

fn circumcentre(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> [f64; 2] {
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
        let mut items = region(random, &sites);
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

/// Whether rings surely are a region: all corners are different, and no side meets another one beside its corners.
fn is_proper(rings: &[Vec<[f64; 2]>]) -> bool {
    let mut corners = rings.concat();
    corners.sort_by(|p, q| p.partial_cmp(q).unwrap_or(std::cmp::Ordering::Equal));
    !rings.is_empty()
        && rings.iter().all(|ring| ring.len() > 2)
        && corners.iter().flatten().all(|x| x.is_finite())
        && corners.windows(2).all(|pair| pair[0] != pair[1])
        && crossing(rings).is_ok()
}

/// No two sides of a region have more than corners in common.
fn crossing(rings: &[Vec<[f64; 2]>]) -> Judgement {
    let ends: Vec<[[f64; 2]; 2]> = rings
        .iter()
        .flat_map(|ring| (0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()]]))
        .collect();
    let exact: Vec<Vec<Vector>> = integers(ends.as_flattened()).chunks(2).map(<[Vector]>::to_vec).collect();
    for (i, s) in exact.iter().enumerate() {
        for (j, t) in exact[..i].iter().enumerate() {
            let side = |s: &[Vector], p: &Vector| orientation(&[&s[0], &s[1], p]);
            let cross = side(s, &t[0]) * side(s, &t[1]) < 0 && side(t, &s[0]) * side(t, &s[1]) < 0;
            let touch = s.iter().any(|p| is_inside(t, p)) || t.iter().any(|p| is_inside(s, p));
            if cross || touch || s == t {
                return Err(format!("a region has the sides {:?} and {:?}", ends[i], ends[j]));
            }
        }
    }
    Ok(())
}

/// The area, exact until it is rounded at the end.
fn exact_area(rings: &[Vec<[f64; 2]>]) -> f64 {
    let scale = scale(rings.iter().flatten().flatten());
    let twice: BigInt = rings
        .iter()
        .map(|ring| {
            let exact = integers_at(ring, scale);
            (0..exact.len())
                .map(|i| {
                    let (p, q) = (&exact[i], &exact[(i + 1) % exact.len()]);
                    &p[0] * &q[1] - &p[1] * &q[0]
                })
                .sum::<BigInt>()
        })
        .sum();
    // 62 bits are enough, and scaled in two steps nothing leaves the range on the way.
    let spare = twice.bits().saturating_sub(62) as i32;
    let digits = i64::try_from(twice >> spare.max(0)).unwrap_or(i64::MAX) as f64;
    let exponent = 2 * scale + spare - 1;
    let half = exponent / 2;
    digits * 2_f64.powi(half) * 2_f64.powi(exponent - half)
}

fn integers_at(points: &[[f64; 2]], scale: i32) -> Vec<Vector> {
    points.iter().map(|p| p.iter().map(|&x| crate::oracle::exact::integer(x, scale)).collect()).collect()
}

fn judge_cells(
    d: &Delaunay2,
    region: &Region2,
    rings: &[Vec<[f64; 2]>],
    sites: &[[f64; 2]],
    seed: u64,
) -> Judgement {
    let cells = d.voronoi().clip(region);
    let [low, high] = region.bounds();
    let largest = low.iter().chain(&high).fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let (width, height) = (high[0] - low[0], high[1] - low[1]);
    let diagonal = width.hypot(height);
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

/// Whether a ray to the right meets the rings an odd number of times, decided exactly.
fn even_odd(rings: &[Vec<[f64; 2]>], q: [f64; 2]) -> bool {
    let mut odd = false;
    for ring in rings {
        for (i, &a) in ring.iter().enumerate() {
            let b = ring[(i + 1) % ring.len()];
            if (a[1] <= q[1]) != (b[1] <= q[1]) {
                let exact = integers(&[a, b, q]);
                let left = orientation(&[&exact[0], &exact[1], &exact[2]]);
                odd ^= (left > 0) == (b[1] > a[1]);
            }
        }
    }
    odd
}

/// The distance of a point from the nearest side, rounded.
fn from_border(rings: &[Vec<[f64; 2]>], q: [f64; 2]) -> f64 {
    let from_side = |a: [f64; 2], b: [f64; 2]| {
        let (u, w) = ([b[0] - a[0], b[1] - a[1]], [q[0] - a[0], q[1] - a[1]]);
        let uu = u[0] * u[0] + u[1] * u[1];
        let t = if uu > 0.0 { ((u[0] * w[0] + u[1] * w[1]) / uu).clamp(0.0, 1.0) } else { 0.0 };
        (w[0] - t * u[0]).hypot(w[1] - t * u[1])
    };
    let sides =
        rings.iter().flat_map(|ring| (0..ring.len()).map(|i| from_side(ring[i], ring[(i + 1) % ring.len()])));
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
    use super::{crossing, even_odd, exact_area, from_border, is_proper};

    #[test]
    fn areas_and_insides_of_rings() {
        let outer = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        let hole = vec![[1.0, 1.0], [1.0, 2.0], [2.0, 1.0]];
        let rings = [outer.clone(), hole];
        assert_eq!(exact_area(&rings), 15.5);
        assert_eq!([[0.5, 0.5], [1.25, 1.25], [5.0, 0.5]].map(|q| even_odd(&rings, q)), [true, false, false]);
        assert_eq!(from_border(&rings, [0.25, 0.5]), 0.25);
        let large = outer.iter().map(|p| p.map(|x| x * 1e150)).collect();
        assert!((exact_area(&[large]) / 1.6e301 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn sides_that_cross_or_touch_are_seen() {
        let square = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        let corner_to_corner = vec![[4.0, 4.0], [5.0, 4.0], [5.0, 5.0]];
        let touching = vec![[4.0, 2.0], [5.0, 1.0], [5.0, 3.0]];
        let bow_tie = vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert!(crossing(&[square.clone(), corner_to_corner]).is_ok());
        assert!(is_proper(std::slice::from_ref(&square)));
        assert!(crossing(&[square, touching]).is_err());
        assert!(crossing(std::slice::from_ref(&bow_tie)).is_err());
        assert!(!is_proper(&[bow_tie]) && !is_proper(&[]));
    }
}
