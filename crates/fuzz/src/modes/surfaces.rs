//! Surfaces over points with heights: whose neighbor a place has, which cells have data, where contours run, what thinning leaves,
//! each against its definition in integers; and the same bits whichever way the triangulation came about.

use delone::surface::{ContourBand, ContourLine, Contours, Grid, Interpolator, Levels, Thinning, rasterize};
use delone::{Bounds, Delaunay2, Delaunay3, Surround, VertexId};
use delone_generators::Random;

use crate::attack::{Attack, Judgement};
use crate::nasty::{self, once_in};
use crate::oracle::exact::{Vector, integer, integers, orientation, scale};
use crate::oracle::rings::{Ring, Side, are_apart, are_neighbors, from_side};

/// Points and heights nearer to each other than this part of the largest leave contours no room: 2^-26. Rounding moves them by 2^-52.
const ROOM: f64 = 1.490_116_119_384_765_6e-8;

/// Nor do triangles whose height is a smaller part of their longest edge: 2^-16.
const THIN: f64 = 1.525_878_906_25e-5;

/// A point and its height.
type Sample<const D: usize> = ([f64; D], f64);

/// In the plane.
pub(crate) struct Planar;

/// In space: interpolation alone.
pub(crate) struct Spatial;

impl Attack for Planar {
    type Item = Sample<2>;

    fn make(random: &mut Random) -> Vec<Sample<2>> {
        let points =
            if once_in(random, 3) { nasty::everyday(random, 24) } else { nasty::points::<2>(random, 24) };
        with_heights(points, random)
    }

    fn judge(samples: &[Sample<2>], seed: u64) -> Judgement {
        let (all, heights_of_all): (Vec<_>, Vec<_>) = samples.iter().copied().unzip();
        let mut random = Random::new(seed);
        judge_thinning(&all, &heights_of_all, &mut random)?;
        // Of equal points one has to be chosen, which is for thinning to do alone.
        let is_first = |i: usize| all[..i].iter().all(|p| *p != all[i]);
        let (points, heights): (Vec<_>, Vec<_>) =
            (0..all.len()).filter(|&i| is_first(i)).map(|i| samples[i]).unzip();
        let d = Delaunay2::from_points(&points).map_err(|error| error.to_string())?;
        let (shuffled, order) = shuffled(&points, &mut random);
        let mut e = Delaunay2::new();
        for &p in &shuffled {
            e.insert(p).map_err(|error| error.to_string())?;
        }
        let asked = places(&points, &mut random);
        let triangles: Vec<[VertexId; 3]> = d.triangles().collect();
        judge_weights(&d, &e, &order, &asked, |v| d.point(v), |v| e.point(v), &triangles)?;
        judge_raster(&d, &heights, &triangles, &mut random)?;
        let moved: Vec<f64> = order.iter().map(|&i| heights[i]).collect();
        judge_contours(&d, &heights, &e, &moved, &mut random)
    }
}

impl Attack for Spatial {
    type Item = Sample<3>;

    fn make(random: &mut Random) -> Vec<Sample<3>> {
        with_heights(nasty::points(random, 12), random)
    }

    fn judge(samples: &[Sample<3>], seed: u64) -> Judgement {
        let points: Vec<[f64; 3]> = samples.iter().map(|sample| sample.0).collect();
        let mut random = Random::new(seed);
        let d = Delaunay3::from_points(&points).map_err(|error| error.to_string())?;
        let (shuffled, order) = shuffled(&points, &mut random);
        let mut e = Delaunay3::new();
        for &p in &shuffled {
            e.insert(p).map_err(|error| error.to_string())?;
        }
        let asked = places(&points, &mut random);
        let cells: Vec<[VertexId; 4]> = d.tetrahedra().collect();
        judge_weights(&d, &e, &order, &asked, |v| d.point(v), |v| e.point(v), &cells)
    }
}

fn with_heights<const D: usize>(points: Vec<[f64; D]>, random: &mut Random) -> Vec<Sample<D>> {
    let kind = random.below(5);
    let size = if once_in(random, 4) { nasty::power(random, -1000, 1000) } else { 1.0 };
    let height = |p: &[f64; D], random: &mut Random| match kind {
        0 => random.between(-1.0, 1.0) * size,
        1 => nasty::integer(random, 2) * size,
        2 => (p[0] / 2.0 - p[1] / 4.0).clamp(-1e300, 1e300),
        3 => 1.0,
        _ => nasty::any_bits(random),
    };
    points.into_iter().map(|p| (p, height(&p, random))).collect()
}

fn shuffled<const D: usize>(points: &[[f64; D]], random: &mut Random) -> (Vec<[f64; D]>, Vec<usize>) {
    let mut order: Vec<usize> = (0..points.len()).collect();
    random.shuffle(&mut order);
    (order.iter().map(|&i| points[i]).collect(), order)
}

/// On points, between them, near them, outside.
fn places<const D: usize>(points: &[[f64; D]], random: &mut Random) -> Vec<[f64; D]> {
    let mut all = nasty::points(random, 3);
    for _ in 0..if points.is_empty() { 0 } else { 6 } {
        let [a, b, c] = [0, 1, 2].map(|_| points[random.below(points.len())]);
        all.push(match random.below(4) {
            0 => a,
            1 => std::array::from_fn(|k| a[k] / 2.0 + b[k] / 2.0),
            2 => std::array::from_fn(|k| a[k] / 4.0 + b[k] / 4.0 + c[k] / 2.0),
            _ => a.map(|x| nasty::nudged(random, x)),
        });
    }
    all
}

/// Points outside by no more than 2^-48 of the largest coordinate are on the border; twice that for the sums here.
const BORDER: f64 = 2.0 / (1_u64 << 48) as f64;

/// Weights of a place: of both triangulations the same, none outside, of natural neighbors alone.
fn judge_weights<T: Surround<Point = [f64; D]>, const D: usize, const C: usize>(
    d: &T,
    e: &T,
    order: &[usize],
    asked: &[[f64; D]],
    of_d: impl Fn(VertexId) -> [f64; D],
    of_e: impl Fn(VertexId) -> [f64; D],
    simplices: &[[VertexId; C]],
) -> Judgement {
    let of_two = [
        ("linear", Interpolator::linear(d), Interpolator::linear(e)),
        ("laplace", Interpolator::laplace(d), Interpolator::laplace(e)),
        ("sibson", Interpolator::sibson(d), Interpolator::sibson(e)),
    ];
    for (name, mut f, mut g) in of_two {
        for &q in asked {
            let weights = f.weights(q).map_err(|error| error.to_string())?.to_vec();
            let others = g.weights(q).map_err(|error| error.to_string())?.to_vec();
            let what = || format!("{name} at {q:?}: {weights:?}, one by one {others:?} of {order:?}");
            let same = |(v, w): (&(VertexId, f64), &(VertexId, f64))| {
                v.1.to_bits() == w.1.to_bits() && of_d(v.0) == of_e(w.0)
            };
            if weights.len() != others.len() || !weights.iter().zip(&others).all(same) {
                return Err(what());
            }
            if let Some(here) = weights.iter().position(|weight| of_d(weight.0) == q)
                && (here, weights.len(), weights[here].1) != (0, 1, 1.0)
            {
                return Err(format!("not the vertex alone: {}", what()));
            }
            if simplices.is_empty() {
                continue;
            }
            let is_inside = simplices.iter().any(|s| holds(&s.map(&of_d), q));
            // On the border but for rounding the nearest point of the hull stands in.
            if !is_inside && !weights.is_empty() {
                let largest = simplices
                    .iter()
                    .flatten()
                    .flat_map(|v| of_d(*v))
                    .chain(q)
                    .fold(0.0, |m: f64, x| m.max(x.abs()));
                let at = |k: usize| weights.iter().map(|(v, w)| w * of_d(*v)[k]).sum::<f64>();
                if (0..D).all(|k| (at(k) - q[k]).abs() <= largest * BORDER) {
                    continue;
                }
            }
            if is_inside == weights.is_empty() {
                return Err(format!("inside {is_inside}: {}", what()));
            }
            let total: f64 = weights.iter().map(|weight| weight.1).sum();
            if is_inside && !((total - 1.0).abs() < 1e-12 && weights.iter().all(|weight| weight.1 >= 0.0)) {
                return Err(format!("sum {total}: {}", what()));
            }
            let is_neighbor =
                |v: VertexId| simplices.iter().any(|s| s.contains(&v) && conflicts(&s.map(&of_d), q));
            if let Some(weight) = weights.iter().find(|weight| !is_neighbor(weight.0)) {
                return Err(format!("{:?} is no natural neighbor: {}", weight.0, what()));
            }
        }
    }
    Ok(())
}

/// Whether a closed simplex holds a point.
fn holds<const D: usize, const C: usize>(corners: &[[f64; D]; C], q: [f64; D]) -> bool {
    let mut all = corners.to_vec();
    all.push(q);
    let all = integers(&all);
    let whole: Vec<&Vector> = all[..C].iter().collect();
    let sign = orientation(&whole);
    (0..C).all(|i| {
        let mut one = whole.clone();
        one[i] = &all[C];
        sign * orientation(&one) >= 0
    })
}

/// Whether a point is in the circumscribed ball of a simplex or on its border: the orientation of the lifted points.
fn conflicts<const D: usize, const C: usize>(corners: &[[f64; D]; C], q: [f64; D]) -> bool {
    let mut all = corners.to_vec();
    all.push(q);
    let mut all = integers(&all);
    let sign = orientation(&all[..C].iter().collect::<Vec<_>>());
    for p in &mut all {
        let square = p.iter().map(|x| x * x).sum();
        p.push(square);
    }
    // With a positive simplex, what is above the plane through its lifted corners is outside.
    sign * orientation(&all.iter().collect::<Vec<_>>()) <= 0
}

/// Which cells have data, and values between those of the corners; windows of the raster.
fn judge_raster(
    d: &Delaunay2,
    heights: &[f64],
    triangles: &[[VertexId; 3]],
    random: &mut Random,
) -> Judgement {
    let bounds = Bounds::of(d.points().iter().copied());
    let size = (bounds.high[0] - bounds.low[0]).max(bounds.high[1] - bounds.low[1]);
    if triangles.is_empty() || !size.is_finite() {
        return Ok(());
    }
    let p = d.point(triangles[random.below(triangles.len())][0]);
    let step = size / (2 + random.below(8)) as f64;
    // Centers on a point, or anywhere.
    let corner =
        if once_in(random, 2) { [p[0] - 2.5 * step, p[1] + 2.5 * step] } else { [bounds.low[0], p[1]] };
    let Ok(grid) = Grid::new(corner, [step, -step], 6, 6) else { return Ok(()) };
    let values = rasterize(d, heights, &grid, |_| true).map_err(|error| error.to_string())?;
    for (i, &value) in values.iter().enumerate() {
        let q = grid.center(i % 6, i / 6);
        if !q.iter().all(|x| x.is_finite()) {
            if value.is_nan() {
                continue;
            }
            return Err(format!("a cell beyond all numbers has {value}"));
        }
        let over: Vec<_> = triangles.iter().filter(|t| holds(&t.map(|v| d.point(v)), q)).collect();
        let what = || format!("the cell at {q:?} has {value}, triangles {over:?}");
        if value.is_nan() != over.is_empty() {
            return Err(what());
        }
        let is_between = |t: &[VertexId; 3]| {
            let zs = t.map(|v| heights[v.index()]);
            zs.iter().any(|&z| z <= value) && zs.iter().any(|&z| z >= value)
        };
        if !over.iter().all(|t| is_between(t)) {
            return Err(format!("not between the corners: {}", what()));
        }
    }
    let (columns, rows) = (random.below(6)..6, random.below(6)..6);
    let part = rasterize(d, heights, &grid.window(columns.clone(), rows.clone()), |_| true);
    let part = part.map_err(|error| error.to_string())?;
    let expected = rows.flat_map(|row| columns.clone().map(move |column| row * 6 + column));
    if !expected.map(|i| values[i].to_bits()).eq(part.iter().map(|value| value.to_bits())) {
        return Err(format!("a window of {grid:?} has other values"));
    }
    Ok(())
}

/// Judges that both triangulations give equal contours inside of the points' box, and bands with the area of all triangles.
fn judge_contours(
    d: &Delaunay2,
    heights: &[f64],
    e: &Delaunay2,
    moved: &[f64],
    random: &mut Random,
) -> Judgement {
    // How thin a sliver of the hull is takes products of four coordinates.
    let is_in_range = |x: &f64| *x == 0.0 || (1e-70..1e70).contains(&x.abs());
    if !d.points().iter().flatten().all(is_in_range) {
        return Ok(());
    }
    let failed = |error: delone::Error| error.to_string();
    let (one, other) = (Contours::new(d, heights).map_err(failed)?, Contours::new(e, moved).map_err(failed)?);
    let Some([low, high]) = one.range() else { return Ok(()) };
    let mut levels: Vec<f64> = heights.iter().copied().filter(|_| once_in(random, 3)).collect();
    levels.extend(
        (0..3).map(|_| low + (high / 2.0 - low / 2.0) * 2.0 * random.unit()).filter(|z| z.is_finite()),
    );
    let levels = Levels::given(&levels).map_err(failed)?;
    let lines = one.lines(&levels).map_err(failed)?;
    if lines != other.lines(&levels).map_err(failed)? {
        return Err(format!("lines depend on the order of the points: {lines:?}"));
    }
    let bounds = Bounds::of(d.points().iter().copied());
    let is_within = |p: &[f64; 2]| (0..2).all(|k| bounds.low[k] <= p[k] && p[k] <= bounds.high[k]);
    if let Some(p) = lines.iter().flat_map(|line| &line.points).find(|p| !is_within(p)) {
        return Err(format!("a contour leaves the points at {p:?}"));
    }
    let bands = one.bands(&levels).map_err(failed)?;
    let is_thin = |t: [VertexId; 3]| {
        let [p, q, r] = t.map(|v| d.point(v));
        [[p, q, r], [q, r, p], [r, p, q]]
            .iter()
            .any(|&[p, q, r]| from_side(p, q, r) < THIN * (q[0] - p[0]).hypot(q[1] - p[1]))
    };
    if has_room(d.points(), heights, levels.values()) && !d.triangles().any(is_thin) {
        judge_shapes(&lines, &bands)?;
    }
    if bands != other.bands(&levels).map_err(failed)? {
        return Err(format!("bands depend on the order of the points: {bands:?}"));
    }
    let size = bounds.low.iter().chain(&bounds.high).fold(0.0_f64, |most, x| most.max(x.abs()));
    if !(1e-100..1e100).contains(&size) {
        return Ok(());
    }
    let twice_area = |ring: &[[f64; 2]]| {
        let sides = ring.iter().zip(ring.iter().cycle().skip(1));
        sides.map(|(a, b)| a[0] / size * (b[1] / size) - a[1] / size * (b[0] / size)).sum::<f64>()
    };
    let of_bands: f64 =
        bands.iter().flat_map(|band| band.polygons.iter().flatten()).map(|ring| twice_area(ring)).sum();
    let of_triangles: f64 = d.triangles().map(|t| twice_area(&t.map(|v| d.point(v)))).sum();
    if (of_bands - of_triangles).abs() > 1e-12 {
        return Err(format!("bands have {of_bands} of {of_triangles}: {bands:?}"));
    }
    Ok(())
}

/// Whether points, and heights with levels, are apart by a part of the largest: contours between them are no roundings.
fn has_room(points: &[[f64; 2]], heights: &[f64], levels: &[f64]) -> bool {
    let mut all: Vec<f64> = heights.iter().chain(levels).map(|z| z + 0.0).collect();
    all.sort_by(f64::total_cmp);
    let range = all[all.len() - 1] / 2.0 - all[0] / 2.0;
    let gaps = all.windows(2).map(|pair| pair[1] / 2.0 - pair[0] / 2.0);
    let largest = points.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    let near = |p: &[f64; 2], q: &[f64; 2]| (p[0] - q[0]).abs().max((p[1] - q[1]).abs());
    let apart = points.iter().flat_map(|p| points.iter().map(move |q| near(p, q)));
    gaps.filter(|gap| *gap > 0.0).all(|gap| gap >= ROOM * range)
        && apart.filter(|apart| *apart > 0.0).all(|apart| apart >= ROOM * largest)
}

/// Lines do not cross, and bands are polygons that share whole sides.
fn judge_shapes(lines: &[ContourLine], bands: &[ContourBand]) -> Judgement {
    let mut segments: Vec<Side> = Vec::new();
    for line in lines {
        let closing = line.is_closed.then(|| [line.points[line.points.len() - 1], line.points[0]]);
        segments.extend(line.points.windows(2).map(|ends| [ends[0], ends[1]]).chain(closing));
    }
    // Lines of several heights may run together.
    segments.iter_mut().for_each(|ends| ends.sort_by(|p, q| p.partial_cmp(q).expect("finite")));
    segments.sort_by(|s, t| s.partial_cmp(t).expect("finite"));
    segments.dedup();
    are_apart(&segments).map_err(|wrong| format!("lines cross: {wrong}: {lines:?}"))?;
    let polygons: Vec<Vec<Ring>> = bands.iter().flat_map(|band| band.polygons.clone()).collect();
    are_neighbors(&polygons).map_err(|wrong| format!("bands: {wrong}: {bands:?}"))
}

/// No sample is further from the triangles of those that are left than was asked for.
fn judge_thinning(points: &[[f64; 2]], heights: &[f64], random: &mut Random) -> Judgement {
    let range = heights.iter().fold(0.0_f64, |most, z| most.max(z.abs()));
    let bound = if once_in(random, 3) { 0.0 } else { range * random.unit() };
    let thinned = Thinning::new().max_error(bound).points(points, heights, &[]);
    let thinned = thinned.map_err(|error| error.to_string())?;
    let kept: Vec<[f64; 2]> = thinned.vertices.iter().map(|&i| points[i]).collect();
    let d = Delaunay2::from_points(&kept).map_err(|error| error.to_string())?;
    if d.duplicates().count() > 0 {
        return Err(format!("a point is left twice: {thinned:?}"));
    }
    // Besides rounding, as documented, and that of the least numbers.
    let slack = range * 2_f64.powi(-40) + 2e-323;
    let unit = scale(heights.iter().chain([&bound, &slack]));
    let most = integer(bound, unit) + integer(slack, unit);
    for (i, &q) in points.iter().enumerate() {
        if points[..i].contains(&q) {
            continue;
        }
        let over = d.triangles().find(|t| holds(&t.map(|v| d.point(v)), q));
        let Some(t) = over else {
            if d.triangle_count() > 0 || !kept.contains(&q) {
                return Err(format!("{q:?} has no triangle above it: {thinned:?}"));
            }
            continue;
        };
        let mut all = t.map(|v| d.point(v)).to_vec();
        all.push(q);
        let all = integers(&all);
        let doubled = |a: &Vector, b: &Vector, c: &Vector| {
            (&b[0] - &a[0]) * (&c[1] - &a[1]) - (&b[1] - &a[1]) * (&c[0] - &a[0])
        };
        let parts = [
            doubled(&all[1], &all[2], &all[3]),
            doubled(&all[2], &all[0], &all[3]),
            doubled(&all[0], &all[1], &all[3]),
        ];
        let whole = &parts[0] + &parts[1] + &parts[2];
        // So flat that twice the precision leaves too little: what is above such a triangle is not known.
        let side = |k: usize| (0..3).map(|i| (&all[i][k] - &all[(i + 1) % 3][k]).magnitude().clone()).max();
        if (0..2).filter_map(side).product::<num_bigint::BigUint>() >> 56 > *whole.magnitude() {
            continue;
        }
        let mut off = &whole * integer(heights[i], unit);
        for (part, v) in parts.iter().zip(t) {
            off -= part * integer(heights[thinned.vertices[v.index()]], unit);
        }
        if off.magnitude() > (&most * &whole).magnitude() {
            return Err(format!("{q:?} with {} is further off than {bound}: {thinned:?}", heights[i]));
        }
    }
    Ok(())
}
