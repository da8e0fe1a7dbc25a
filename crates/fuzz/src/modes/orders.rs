//! Voronoi diagrams of higher order against their definition: all orders of a set however it was made, points and cells.
//!
//! Cost: O(n^4) for all circles of n points, once for each set; so sets are small, and few of a life of changes are judged.

use std::collections::BTreeSet;

use delone::{Algorithm2, Delaunay2, Error, OrderCircle2, OrderK2, OrderRegion2, Region2, VertexId};
use delone_generators::Random;
use delone_oracle::orders::{Circles, Diagram};

use crate::attack::{Attack, Judgement};
use crate::nasty::{self, once_in};
use crate::oracle::exact::{integers, squared};
use crate::oracle::rings::{Ring, tile};

/// Points, up to which all orders are judged and changes made; of more points the first orders.
const ALL_ORDERS_POINTS: usize = 10;
/// The largest order that is judged of more points.
const FIRST: usize = 4;
/// Points asked about in each set.
const QUERIES: usize = 6;

/// See the module.
pub(crate) struct Orders;

impl Attack for Orders {
    type Item = [f64; 2];

    fn make(random: &mut Random) -> Vec<[f64; 2]> {
        match random.below(24) {
            0 => wheel(random),
            1 => nasty::points(random, 34),
            2..8 => nasty::everyday(random, ALL_ORDERS_POINTS),
            _ => nasty::points(random, ALL_ORDERS_POINTS),
        }
    }

    fn judge(points: &[[f64; 2]], seed: u64) -> Judgement {
        let failed = |error: Error| error.to_string();
        let mut random = Random::new(seed);
        let first = Delaunay2::from_points(points).map_err(failed)?;
        let truth = Truth::new(points.to_vec(), &mut random);
        truth.judge(&first).map_err(|wrong| format!("built: {wrong}"))?;
        let mut shuffled = points.to_vec();
        random.shuffle(&mut shuffled);
        shuffled.extend(points.iter().copied().take(random.below(4)));
        let second = Delaunay2::from_points(&shuffled).map_err(failed)?;
        truth.judge(&second).map_err(|wrong| format!("shuffled {shuffled:?}: {wrong}"))?;
        let alone = Algorithm2::Incremental { seed };
        let third = Delaunay2::with_algorithm(points, alone).map_err(failed)?;
        same(&first, &third).map_err(|wrong| format!("one by one: {wrong}"))?;
        if points.len() <= ALL_ORDERS_POINTS { live(points, second, &mut random) } else { Ok(()) }
    }
}

/// Points with a region that has more neighbors than holes are filled side by side for: most of a circle of the lattice or of a
/// line, and few others.
fn wheel(random: &mut Random) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = if once_in(random, 3) {
        (0..32).map(|i| [f64::from(i), 0.0]).collect()
    } else {
        let lattice = (-65..=65).flat_map(|x| (-65..=65).map(move |y| [f64::from(x), f64::from(y)]));
        lattice.filter(|p| p[0] * p[0] + p[1] * p[1] == 4225.0).collect()
    };
    if once_in(random, 2) {
        points.iter_mut().for_each(|p| *p = p.map(|x| nasty::nudged(random, x)));
    }
    random.shuffle(&mut points);
    points.truncate(28 + random.below(6));
    points.extend((0..=random.below(3)).map(|_| [(); 2].map(|()| nasty::integer(random, 9))));
    random.shuffle(&mut points);
    points
}

/// Vertices come, go and move. Now and then all is judged, and compared with what a triangulation without a past says.
fn live(points: &[[f64; 2]], mut d: Delaunay2, random: &mut Random) -> Judgement {
    let failed = |error: Error| error.to_string();
    for step in 0..points.len() {
        let mut what = String::new();
        for _ in 0..=random.below(4) {
            let alive: Vec<VertexId> = d.vertices().collect();
            let known = points[random.below(points.len())];
            let p = if once_in(random, 4) { nasty::query(random, points) } else { known };
            let v = (!alive.is_empty()).then(|| alive[random.below(alive.len())]);
            match (random.below(5), v) {
                (0 | 1, Some(v)) => {
                    d.remove(v).map_err(failed)?;
                    what += &format!(" remove {v:?},");
                }
                (2, Some(v)) => {
                    what += &format!(" move {v:?} to {p:?}: {:?},", d.move_to(v, p));
                }
                (3, _) if alive.len() + 2 < ALL_ORDERS_POINTS => {
                    d.extend(&[p, known, p], step as u64).map_err(failed)?;
                    what += &format!(" extend by {:?},", [p, known, p]);
                }
                _ if alive.len() < ALL_ORDERS_POINTS => {
                    what += &format!(" insert {p:?}: {:?},", d.insert(p).map_err(failed)?);
                }
                _ => {}
            }
        }
        let context = |wrong: String| format!("step {step},{what} {wrong}");
        let kept: Vec<[f64; 2]> = d.vertices().map(|v| d.point(v)).collect();
        let truth = Truth::new(kept.clone(), random);
        truth.judge(&d).map_err(context)?;
        let fresh = Delaunay2::from_points(&kept).map_err(failed)?;
        same(&fresh, &d).map_err(context)?;
        if once_in(random, 8) {
            d.compact();
            same(&fresh, &d).map_err(|wrong| context(format!("compact: {wrong}")))?;
        }
    }
    Ok(())
}

/// Truths about the distinct ones of some points.
struct Truth {
    points: Vec<[f64; 2]>,
    circles: Circles,
    /// Points, and for each all sites by their distance from it.
    queries: Vec<([f64; 2], Vec<usize>)>,
    /// The rectangle that cells are clipped to: its lower left corner and its upper right one.
    rectangle: [[f64; 2]; 2],
}

/// A set of sites, by their places among the distinct points.
type Sites = Vec<usize>;

impl Truth {
    fn new(points: Vec<[f64; 2]>, random: &mut Random) -> Self {
        let mut distinct: Vec<[f64; 2]> = Vec::new();
        points.into_iter().for_each(|p| {
            if !distinct.contains(&p) {
                distinct.push(p);
            }
        });
        let points = distinct;
        let mut queries: Vec<[f64; 2]> = (0..QUERIES).map(|_| nasty::query(random, &points)).collect();
        if !points.is_empty() {
            // Ties: as far from three sites as rounding allows.
            let centers = (0..QUERIES).filter_map(|_| {
                let [a, b, c] = [(); 3].map(|()| points[random.below(points.len())]);
                delone_predicates::circumcenter(a, b, c)
            });
            queries.extend(centers.filter(|q| q.iter().all(|x| x.is_finite())));
        }
        let corners = [(); 2].map(|()| nasty::query(random, &points));
        // All of the points, or any part of the plane.
        let around = if once_in(random, 2) { &points[..] } else { &[] };
        let all = || corners.iter().chain(around);
        let least = |k: usize| all().fold(f64::INFINITY, |least, p| least.min(p[k]));
        let largest = |k: usize| all().fold(f64::NEG_INFINITY, |largest, p| largest.max(p[k]));
        let rectangle = [[least(0), least(1)], [largest(0), largest(1)]];
        let queries = queries.into_iter().map(|q| (q, by_distance(&points, q))).collect();
        Self { circles: Circles::new(&points), points, queries, rectangle }
    }

    /// All orders of a triangulation of the points.
    fn judge(&self, d: &Delaunay2) -> Judgement {
        let n = self.points.len();
        let place = |v: VertexId| self.points.iter().position(|p| *p == d.point(v));
        let places: Option<Vec<(VertexId, usize)>> = d.vertices().map(|v| Some((v, place(v)?))).collect();
        let Some(places) = places.filter(|places| places.len() == n) else {
            return Err("the vertices are not the points".to_owned());
        };
        let sites = |set: &mut dyn Iterator<Item = VertexId>| -> Sites {
            let place = |v| places.iter().find(|(w, _)| *w == v).map_or(usize::MAX, |found| found.1);
            let mut sites: Sites = set.map(place).collect();
            sites.sort_unstable();
            sites
        };
        for k in [0, n + 1] {
            if !matches!(d.order(k), Err(Error::Parameter { .. })) {
                return Err(format!("order {k} of {n} points is not refused"));
            }
        }
        for k in (1..=n).filter(|&k| n <= ALL_ORDERS_POINTS || k <= FIRST) {
            let order = d.order(k).map_err(|error| format!("order {k}: {error}"))?;
            self.judge_order(&order, &sites).map_err(|wrong| format!("order {k}: {wrong}"))?;
        }
        Ok(())
    }

    fn judge_order(
        &self,
        order: &OrderK2,
        sites: &dyn Fn(&mut dyn Iterator<Item = VertexId>) -> Sites,
    ) -> Judgement {
        let k = order.order();
        let expected = if k < self.points.len() {
            self.circles.order(k)
        } else {
            let all = BTreeSet::from([(0..k).collect::<Sites>()]);
            Diagram { regions: all.clone(), unbounded: all, circles: BTreeSet::new() }
        };
        let set = |region: OrderRegion2| sites(&mut region.sites().iter().copied());
        let circle = |circle: OrderCircle2| {
            let on = sites(&mut circle.on().into_iter());
            (sites(&mut circle.inside()), [on[0], on[1], on[2]])
        };
        let regions: Vec<Sites> = order.regions().map(set).collect();
        let unbounded = order.regions().filter(|region| !region.is_bounded()).map(set);
        let circles: Vec<(Sites, [usize; 3])> = order.circles().map(circle).collect();
        let counts = (regions.len(), circles.len());
        let found = Diagram {
            regions: regions.into_iter().collect(),
            unbounded: unbounded.collect(),
            circles: circles.into_iter().collect(),
        };
        if found != expected || counts != (expected.regions.len(), expected.circles.len()) {
            return Err(format!("{found:?} with {counts:?} regions and circles instead of {expected:?}"));
        }
        if !order.regions().map(OrderRegion2::sites).is_sorted_by(|a, b| a < b) {
            return Err("regions are not in order".to_owned());
        }
        order.regions().try_for_each(|region| judge_region(order, region))?;
        for (q, nearest) in &self.queries {
            let mut nearest = nearest[..k].to_vec();
            nearest.sort_unstable();
            let found = order.locate(*q).map(set);
            if found.as_ref() != Ok(&nearest) {
                return Err(format!("locate {q:?}: {found:?} instead of {nearest:?}"));
            }
        }
        self.judge_cells(order)
    }

    /// Clipped regions tile a rectangle, and each is where its sites are nearest.
    fn judge_cells(&self, order: &OrderK2) -> Judgement {
        let [low, high] = self.rectangle;
        let Ok(region) = Region2::rectangle(low, high) else { return Ok(()) };
        let cells = order.cells(&region);
        let of = |own| cells.rings(own).map(|ring| ring.points().collect()).collect::<Vec<Ring>>();
        let border: Vec<Ring> = region.rings().map(<[_]>::to_vec).collect();
        tile(&order.regions().map(of).collect::<Vec<_>>(), &border)
            .map_err(|wrong| format!("clipped to {low:?}, {high:?}: {wrong}"))?;
        let (width, height) = (high[0] - low[0], high[1] - low[1]);
        let diagonal = width.hypot(height);
        let largest = low.iter().chain(&high).fold(0.0_f64, |largest, x| largest.max(x.abs()));
        // Areas beyond the range of numbers, and those of which rounding leaves nothing, say nothing.
        if !(1e-140..1e140).contains(&diagonal) || diagonal < 1e-6 * largest {
            return Ok(());
        }
        let tolerance = 1e-10 * diagonal * diagonal + 64.0 * f64::EPSILON * largest * diagonal;
        let mut sum = 0.0;
        for own in order.regions() {
            let area = cells.area(own);
            if area.is_nan() || area < -tolerance {
                return Err(format!("{:?} has the area {area} in {low:?} to {high:?}", own.sites()));
            }
            sum += area;
            // Regions in a rectangle are convex, and a large one has its center of mass well inside.
            if area > 1e-4 * diagonal * diagonal {
                let found = cells.centroid(own).map(|center| order.locate(center));
                if !matches!(&found, Some(Ok(found)) if found.index() == own.index()) {
                    return Err(format!(
                        "{:?} has its center in {found:?} of {low:?}, {high:?}",
                        own.sites()
                    ));
                }
            }
        }
        let rounding = tolerance * (1.0 + order.region_count() as f64).sqrt();
        if (sum - width * height).abs() > rounding {
            return Err(format!("areas add up to {sum} and not {} in {low:?}, {high:?}", width * height));
        }
        Ok(())
    }
}

/// Whether a region is found by its sites, and fits to what is around it.
fn judge_region(order: &OrderK2, region: OrderRegion2) -> Judgement {
    let sites = region.sites();
    let mut backwards = sites.to_vec();
    backwards.reverse();
    if order.region(&backwards).map(OrderRegion2::index) != Some(region.index()) {
        return Err(format!("there is no region of {backwards:?}"));
    }
    for (exchange, beyond) in region.sides() {
        let mut other: Vec<VertexId> = sites.iter().copied().filter(|v| *v != exchange.lost).collect();
        other.push(exchange.gained);
        other.sort_unstable();
        other.dedup();
        let back = beyond.sides().filter(|(back, own)| {
            own.index() == region.index() && (back.lost, back.gained) == (exchange.gained, exchange.lost)
        });
        if beyond.sites() != other || back.count() != 1 {
            return Err(format!("{sites:?} has {exchange:?} beside {:?}", beyond.sites()));
        }
    }
    for circle in region.circles() {
        if circle.regions().iter().filter(|around| around.index() == region.index()).count() != 1 {
            return Err(format!("{:?} is a corner of {sites:?}, which is not around it", circle.on()));
        }
    }
    let (corners, sides) = (region.circles().count(), region.sides().count());
    if region.is_bounded() && (corners != sides || corners < 2) {
        return Err(format!("{sites:?} has {corners} corners and {sides} sides"));
    }
    Ok(())
}

/// The sites from the nearest to the furthest one, those at one distance in lexicographic order.
fn by_distance(points: &[[f64; 2]], q: [f64; 2]) -> Sites {
    let with_q: Vec<[f64; 2]> = points.iter().copied().chain([q]).collect();
    let exact = integers(&with_q);
    let mut order: Vec<_> =
        (0..points.len()).map(|i| (squared(&exact[i], &exact[points.len()]), &exact[i], i)).collect();
    order.sort();
    order.into_iter().map(|(.., i)| i).collect()
}

/// Whether two triangulations whose vertices are the same in the order of their names have diagrams equal in everything.
fn same(d: &Delaunay2, other: &Delaunay2) -> Judgement {
    if d.vertex_count() != other.vertex_count() {
        return Err(format!("{} vertices instead of {}", other.vertex_count(), d.vertex_count()));
    }
    let most = if d.vertex_count() <= ALL_ORDERS_POINTS { d.vertex_count() } else { FIRST };
    for k in 1..=most {
        let [expected, found] = [d, other].map(|d| d.order(k).map(|order| everything(d, &order)));
        if found != expected {
            return Err(format!("order {k}: {found:?} instead of {expected:?}"));
        }
    }
    Ok(())
}

/// All that a diagram has, as numbers: sites are counted among the vertices.
fn everything(d: &Delaunay2, order: &OrderK2) -> Vec<Sites> {
    let vertices: Vec<VertexId> = d.vertices().collect();
    let number = |v: VertexId| vertices.binary_search(&v).unwrap_or(usize::MAX);
    let mut all = Vec::new();
    for region in order.regions() {
        all.push(region.sites().iter().copied().map(number).collect());
        all.push(region.circles().flat_map(|circle| circle.on().map(number)).collect());
        let sides = region.sides();
        all.push(sides.flat_map(|(e, s)| [number(e.lost), number(e.gained), s.index()]).collect());
    }
    for circle in order.circles() {
        let around = circle.regions().map(OrderRegion2::index);
        all.push(
            circle.on().map(number).into_iter().chain(circle.inside().map(number)).chain(around).collect(),
        );
    }
    all
}
