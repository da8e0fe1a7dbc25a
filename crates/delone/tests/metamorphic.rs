//! Scaling, permuting, repeating and turning change the result of every operation as they must, and in no other way.
//!
//! Each operation of the table takes a set with weights, heights and a unit of length, and gives shapes (lists of points) and measures
//! (numbers with the power of the unit that they are in). Scaled by a power of two, all numbers are the same but for that power, to the
//! bit; in another order, or with points twice, they are the same; turned by a right angle, sets without ties give the same turned.

use delone::surface::{Contours, Interpolator, Levels, Outside, gradients};
use delone::{
    Constrained2, Crossings, Delaunay2, Delaunay3, Furthest2, Graph, Hull2, Layers2, Placement, Refinement,
    Region2, Regular2, Regular3, Relaxation2, VoronoiEdge2,
};
use delone_generators::{Kind, Random};
use delone_oracle::share;

mod lines;
mod meshes;

use meshes::{coarse, curved, kept, refined, segments};

/// Points of the plane, or of space, with what else operations need.
#[derive(Clone)]
struct Set<const D: usize> {
    points: Vec<[f64; D]>,
    /// Squared lengths.
    weights: Vec<f64>,
    /// Of no unit.
    heights: Vec<f64>,
    /// A length, about that of the whole set.
    unit: f64,
    /// Asked about.
    queries: Vec<[f64; D]>,
}

/// A list of points, as it is known by; and a number with the power of the unit that it is in.
#[derive(Clone, Debug, Default)]
struct Outcome<const D: usize> {
    shapes: Vec<Vec<[f64; D]>>,
    measures: Vec<(Vec<[f64; D]>, f64, i32)>,
}

type Operation<const D: usize> = (&'static str, fn(&Set<D>) -> Outcome<D>);

fn order<const D: usize>(p: &[[f64; D]], q: &[[f64; D]]) -> std::cmp::Ordering {
    let both = p.iter().flatten().zip(q.iter().flatten());
    let first = both.map(|(x, y)| (x + 0.0).total_cmp(&(y + 0.0))).find(|order| order.is_ne());
    first.unwrap_or(p.len().cmp(&q.len()))
}

impl<const D: usize> Outcome<D> {
    /// A shape whose points have no order.
    fn set(&mut self, mut points: Vec<[f64; D]>) {
        points.sort_by(|p, q| order(&[*p], &[*q]));
        self.shapes.push(points);
    }

    /// A closed line, which may begin anywhere.
    fn ring(&mut self, mut points: Vec<[f64; D]>) {
        let least = (0..points.len()).min_by(|&i, &j| order(&[points[i]], &[points[j]]));
        points.rotate_left(least.unwrap_or(0));
        self.shapes.push(points);
    }

    fn measure(&mut self, of: &[[f64; D]], value: f64, power: i32) {
        let mut of = of.to_vec();
        of.sort_by(|p, q| order(&[*p], &[*q]));
        self.measures.push((of, value, power));
    }

    /// In an order of its own, each number mapped.
    fn normal(mut self, map: impl Fn([f64; D]) -> [f64; D], scale: f64) -> Self {
        for p in self.shapes.iter_mut().flatten().chain(self.measures.iter_mut().flat_map(|m| &mut m.0)) {
            *p = map(*p).map(|x| x + 0.0);
        }
        for (_, value, power) in &mut self.measures {
            *value = *value * scale.powi(*power) + 0.0;
        }
        self.shapes.sort_by(|p, q| order(p, q));
        self.measures.sort_by(|p, q| order(&p.0, &q.0).then(p.1.total_cmp(&q.1)));
        self
    }

    fn is(&self, other: &Self) -> bool {
        let bits = |p: &[[f64; D]]| p.iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>();
        let shapes = |o: &Self| o.shapes.iter().map(|p| bits(p)).collect::<Vec<_>>();
        let measures = |o: &Self| o.measures.iter().map(|m| (bits(&m.0), m.1.to_bits())).collect::<Vec<_>>();
        shapes(self) == shapes(other) && measures(self) == measures(other)
    }
}

fn delaunay(set: &Set<2>) -> Delaunay2 {
    Delaunay2::from_points(&set.points).expect("finite")
}

fn regular(set: &Set<2>) -> Regular2 {
    Regular2::from_parts(&set.points, &set.weights).expect("finite")
}

fn window(set: &Set<2>) -> Region2 {
    let u = set.unit;
    let outer =
        vec![[-0.25 * u, -0.125 * u], [1.25 * u, 0.0], [1.125 * u, 1.25 * u], [0.5 * u, 0.5 * u], [0.0, u]];
    Region2::polygon(&[outer]).expect("a polygon")
}

fn cells<'a>(found: impl Iterator<Item = ([f64; 2], delone::Cell2<'a>)>) -> Outcome<2> {
    let mut outcome = Outcome::default();
    for (site, cell) in found {
        cell.rings().for_each(|ring| outcome.ring(ring.points().collect()));
        outcome.measure(&[site], cell.area(), 2);
    }
    outcome
}

fn interpolated(set: &Set<2>, make: fn(&Delaunay2) -> Interpolator<'_, Delaunay2>) -> Outcome<2> {
    let d = delaunay(set);
    let mut values = make(&d).outside(Outside::Nothing);
    let mut outcome = Outcome::default();
    for &q in &set.queries {
        let value = values.value(q, &set.heights).expect("values");
        outcome.measure(&[q], value.unwrap_or(f64::INFINITY), 0);
    }
    outcome
}

const PLANE: &[Operation<2>] = &[
    ("triangles", |set| {
        let d = delaunay(set);
        let mut outcome = Outcome::default();
        d.triangles().for_each(|t| outcome.set(t.map(|v| d.point(v)).to_vec()));
        outcome.ring(d.hull_vertices().map(|v| d.point(v)).collect());
        outcome
    }),
    ("hull", |set| {
        let hull = Hull2::from_points(&set.points).expect("finite");
        let mut outcome = Outcome::default();
        outcome.ring(hull.corners().iter().map(|&i| set.points[i]).collect());
        outcome
    }),
    ("voronoi", |set| {
        let d = delaunay(set);
        let mut outcome = Outcome::default();
        for e in d.voronoi().edges() {
            match e {
                VoronoiEdge2::Segment(ends) => outcome.set(ends.to_vec()),
                VoronoiEdge2::Ray { from, .. } => outcome.set(vec![from]),
                VoronoiEdge2::Line { .. } => (),
            }
        }
        outcome
    }),
    ("cells", |set| {
        let d = delaunay(set);
        let clipped = d.voronoi().clip(&window(set));
        cells(d.vertices().map(|v| (d.point(v), clipped.cell(v))))
    }),
    ("cells merged", |set| {
        let (d, region) = (delaunay(set), window(set));
        let merged = d.voronoi().clip(&region).merged(set.unit / 8.0, &region).expect("a length");
        cells(d.vertices().map(|v| (d.point(v), merged.cell(v))))
    }),
    ("cells alone", |set| {
        let (d, mut outcome) = (delaunay(set), Outcome::default());
        for v in d.vertices() {
            d.voronoi().cell(v, &window(set)).into_iter().for_each(|ring| outcome.ring(ring));
        }
        outcome
    }),
    ("cells of order 2", |set| {
        let d = delaunay(set);
        let mut outcome = Outcome::default();
        if d.vertex_count() > 2 {
            let order = d.order(2).expect("an order");
            let clipped = order.cells(&window(set));
            for region in order.regions() {
                clipped.rings(region).for_each(|ring| outcome.ring(ring.points().collect()));
            }
        }
        outcome
    }),
    ("power cells", |set| {
        let r = regular(set);
        let clipped = r.power().clip(&window(set));
        cells(r.vertices().filter_map(|v| Some((r.site(v)?.0, clipped.cell(v)))))
    }),
    ("regular triangles", |set| {
        let r = regular(set);
        let mut outcome = Outcome::default();
        r.triangles().for_each(|t| outcome.set(t.iter().filter_map(|v| Some(r.site(*v)?.0)).collect()));
        outcome
    }),
    ("relaxed", |set| {
        let unit = set.unit;
        let region = Region2::rectangle([0.0, 0.0], [unit, unit]).expect("a rectangle");
        let mut outcome = Outcome::default();
        let relaxed = Relaxation2::default().steps(1).tolerance(0.0).run(&delaunay(set), &region, |_, _| {});
        relaxed.expect("a tolerance").into_iter().zip(&set.points).for_each(|(p, q)| {
            p.into_iter().for_each(|x| outcome.measure(&[*q], x, 1));
        });
        outcome
    }),
    ("furthest", |set| {
        let d = delaunay(set);
        let furthest: Furthest2 = d.furthest();
        let mut outcome = Outcome::default();
        furthest.triangles().for_each(|t| outcome.set(t.map(|v| d.point(v)).to_vec()));
        if let Some(circle) = furthest.enclosing_circle() {
            outcome.measure(&[circle.center], circle.radius, 1);
        }
        outcome
    }),
    ("graphs", |set| {
        let d = delaunay(set);
        let mut outcome = Outcome::default();
        for graph in [Graph::Gabriel, Graph::RelativeNeighbors, Graph::SpanningTree, Graph::Nearest(3)] {
            for edge in d.graph(graph).expect("a graph") {
                outcome.set(edge.map(|v| d.point(v)).to_vec());
            }
        }
        outcome
    }),
    ("alpha", |set| {
        let d = delaunay(set);
        let mut outcome = Outcome::default();
        for face in d.alpha().filtration() {
            let corners: Vec<[f64; 2]> = face.corners().iter().map(|&v| d.point(v)).collect();
            outcome.measure(&corners, face.value, 2);
        }
        outcome
    }),
    ("constrained", |set| {
        let c =
            Constrained2::with_crossings(&set.points, &segments(set), Crossings::Split).expect("segments");
        let mut outcome = Outcome::default();
        c.triangles().for_each(|t| outcome.set(t.map(|v| c.point(v)).to_vec()));
        c.constraints().for_each(|e| outcome.set(e.map(|v| c.point(v)).to_vec()));
        outcome
    }),
    ("welded segments", lines::welded),
    ("cells of segments", lines::cells),
    ("medial axis", lines::axis),
    ("mesh by angle", |set| refined(set, Refinement::new().min_angle(25.0))),
    ("mesh of circumcenters", |set| {
        refined(set, Refinement::new().min_angle(25.0).placement(Placement::Circumcenter))
    }),
    ("mesh by edge", |set| refined(set, Refinement::new().max_edge(set.unit / 16.0))),
    ("mesh by area", |set| refined(set, Refinement::new().max_area(set.unit * set.unit / 512.0))),
    ("mesh of edges", |set| refined(set, Refinement::new().edge(set.unit / 16.0).growth(1.3))),
    ("mesh along arcs", |set| curved(set, Refinement::new().min_angle(25.0))),
    ("mesh of edges along arcs", |set| curved(set, Refinement::new().edge(set.unit / 8.0))),
    ("mesh of given triangles", |set| kept(set, Refinement::new().min_angle(0.0))),
    ("mesh of given triangles by angle", |set| kept(set, Refinement::new().min_angle(25.0))),
    ("mesh made coarser", coarse),
    ("mesh with layers", |set| {
        let layers = Layers2::new(set.unit / 64.0, 3);
        refined(set, Refinement::new().max_edge(set.unit / 8.0).layers(&layers))
    }),
    ("mesh by size", |set| {
        let size = |[x, y]: [f64; 2]| set.unit / 32.0 + (x.abs() + y.abs()) / 16.0;
        refined(set, Refinement::new().size(&size))
    }),
    ("mesh by area at a place", |set| {
        let area = |[x, _]: [f64; 2]| set.unit * (set.unit / 256.0 + x.abs() / 128.0);
        refined(set, Refinement::new().max_area_at(&area).smooth(1))
    }),
    ("linear", |set| interpolated(set, |d| Interpolator::linear(d))),
    ("laplace", |set| interpolated(set, |d| Interpolator::laplace(d))),
    ("sibson", |set| interpolated(set, |d| Interpolator::sibson(d))),
    ("nearest", |set| interpolated(set, |d| Interpolator::nearest(d))),
    ("gradients", |set| {
        let d = delaunay(set);
        let mut outcome = Outcome::default();
        for slope in gradients(&d, &set.heights).expect("values") {
            slope.iter().for_each(|x| outcome.measure(&[], *x, -1));
        }
        outcome
    }),
    ("contours", |set| {
        let (d, mut outcome) = (delaunay(set), Outcome::default());
        let surface = Contours::new(&d, &set.heights).expect("heights");
        let levels = Levels::every(0.25, 0.0, [0.0, 1.0]).expect("levels");
        for line in surface.lines(&levels).expect("lines") {
            outcome.shapes.push(line.points);
        }
        for band in surface.bands(&levels).expect("bands") {
            band.polygons.into_iter().flatten().for_each(|ring| outcome.ring(ring));
        }
        outcome
    }),
];

const SPACE: &[Operation<3>] = &[
    ("tetrahedra", |set| {
        let d = Delaunay3::from_points(&set.points).expect("finite");
        let mut outcome = Outcome::default();
        d.tetrahedra().for_each(|t| outcome.set(t.map(|v| d.point(v)).to_vec()));
        d.hull_facets().for_each(|t| outcome.set(t.map(|v| d.point(v)).to_vec()));
        outcome
    }),
    ("centers", |set| {
        let d = Delaunay3::from_points(&set.points).expect("finite");
        let mut outcome = Outcome::default();
        d.tetrahedron_ids().filter_map(|t| d.circumcenter(t)).for_each(|center| outcome.set(vec![center]));
        outcome
    }),
    ("regular tetrahedra", |set| {
        let r = Regular3::from_parts(&set.points, &set.weights).expect("finite");
        let mut outcome = Outcome::default();
        r.tetrahedra().for_each(|t| outcome.set(t.iter().filter_map(|v| Some(r.site(*v)?.0)).collect()));
        outcome
    }),
    ("alpha", |set| {
        let d = Delaunay3::from_points(&set.points).expect("finite");
        let mut outcome = Outcome::default();
        for face in d.alpha().filtration() {
            let corners: Vec<[f64; 3]> = face.corners().iter().map(|&v| d.point(v)).collect();
            outcome.measure(&corners, face.value, 2);
        }
        outcome
    }),
    ("sibson", |set| {
        let d = Delaunay3::from_points(&set.points).expect("finite");
        let (mut values, mut outcome) = (Interpolator::sibson(&d), Outcome::default());
        for &q in &set.queries {
            let value = values.value(q, &set.heights).expect("values");
            outcome.measure(&[q], value.unwrap_or(f64::INFINITY), 0);
        }
        outcome
    }),
];

/// A set in other units, in another order, or turned.
fn changed<const D: usize>(
    set: &Set<D>,
    map: impl Fn([f64; D]) -> [f64; D],
    scale: f64,
    which: &[usize],
) -> Set<D> {
    Set {
        points: which.iter().map(|&i| map(set.points[i])).collect(),
        weights: which.iter().map(|&i| set.weights[i] * scale * scale).collect(),
        heights: which.iter().map(|&i| set.heights[i]).collect(),
        unit: set.unit * scale,
        queries: set.queries.iter().map(|&q| map(q)).collect(),
    }
}

fn judge<const D: usize>(table: &[Operation<D>], name: &str, set: &Set<D>) {
    let same: Vec<usize> = (0..set.points.len()).collect();
    for (operation, run) in table {
        let expected = run(set).normal(|p| p, 1.0);
        // Meshes multiply four lengths, which must stay in range.
        let most = if operation.starts_with("mesh") { 120 } else { 300 };
        for k in [-300, -120, -60, -1, 1, 10, 52, 120, 300].into_iter().filter(|k: &i32| k.abs() <= most) {
            let scale = 2f64.powi(k);
            let found = run(&changed(set, |p| p.map(|x| x * scale), scale, &same));
            let back = found.normal(|p| p.map(|x| x / scale), scale.recip());
            assert!(back.is(&expected), "{operation} of {name}, scaled by 2^{k}");
        }
        let mut random = Random::new(9);
        for turn in 0..2 {
            let mut shuffled = same.clone();
            (0..shuffled.len()).for_each(|i| shuffled.swap(i, random.below(set.points.len())));
            if turn == 1 {
                // Some of them twice.
                shuffled.extend_from_within(0..same.len() / 3);
            }
            let by_index = matches!(*operation, "gradients" | "relaxed");
            let found = run(&changed(set, |p| p, 1.0, &shuffled)).normal(|p| p, 1.0);
            assert!(
                (by_index && turn == 1) || found.is(&expected),
                "{operation} of {name}, in another order {turn}"
            );
        }
    }
}

fn set<const D: usize>(points: Vec<[f64; D]>, seed: u64) -> Set<D> {
    let mut random = Random::new(seed);
    let known = |p: &[f64; D]| p.iter().enumerate().map(|(k, x)| (k as f64 + 1.0) * x).sum::<f64>();
    // Functions of the place, so that equal points have equal ones.
    let weights = points.iter().map(|p| (known(p) * 7.0).fract().abs() / 512.0).collect();
    let heights = points.iter().map(|p| (known(p) * 3.0).fract().abs()).collect();
    let queries = (0..20).map(|_| std::array::from_fn(|_| random.unit())).collect();
    Set { points, weights, heights, unit: 1.0, queries }
}

fn sets() -> Vec<(String, Set<2>)> {
    let kinds = [Kind::Uniform, Kind::Grid, Kind::Circle, Kind::Clusters];
    let mut sets: Vec<(String, Set<2>)> =
        kinds.iter().map(|&kind| (format!("{kind:?}"), set(kind.points(share(640), 3), 1))).collect();
    let tenths: Vec<[f64; 2]> = (0..64).map(|i| [i % 8, i / 8].map(|k| f64::from(k) * 0.1)).collect();
    sets.push(("tenths".into(), set(tenths, 2)));
    sets
}

#[test]
fn units_order_and_repetition_change_nothing_in_the_plane() {
    for (name, set) in sets() {
        judge(PLANE, &name, &set);
    }
}

#[test]
fn units_order_and_repetition_change_nothing_in_space() {
    let mut random = Random::new(5);
    let uniform = (0..share(480)).map(|_| std::array::from_fn(|_| random.unit())).collect();
    judge(SPACE, "uniform", &set(uniform, 3));
    let grid = (0..64).map(|i| [i % 4, i / 4 % 4, i / 16].map(|k| f64::from(k) * 0.1)).collect();
    judge(SPACE, "grid", &set(grid, 4));
}

/// Sets in general position, where no tie is broken by the order of coordinates.
#[test]
fn right_angles_and_mirrors_turn_everything() {
    let points = Kind::Uniform.points(80, 11);
    let set = set(points, 6);
    let same: Vec<usize> = (0..set.points.len()).collect();
    let of_points = ["triangles", "hull", "voronoi", "furthest", "graphs", "alpha", "regular triangles"];
    for (operation, run) in PLANE.iter().filter(|(name, _)| of_points.contains(name)) {
        let expected = run(&set).normal(|p| p, 1.0);
        let turned = run(&changed(&set, |[x, y]| [-y, x], 1.0, &same)).normal(|[x, y]| [y, -x], 1.0);
        let mut found = Outcome::default();
        // A mirror turns rings around.
        for shape in run(&changed(&set, |[x, y]| [-x, y], 1.0, &same)).shapes {
            found.set(shape.into_iter().map(|[x, y]| [-x, y]).collect());
        }
        let mut sets_of = Outcome::default();
        for shape in expected.shapes.clone() {
            sets_of.set(shape);
        }
        let mut turned_sets = Outcome::default();
        turned.shapes.iter().for_each(|shape| turned_sets.set(shape.clone()));
        let [a, b, c] = [sets_of, found, turned_sets].map(|outcome| outcome.normal(|p| p, 1.0));
        assert!(a.is(&b) && a.is(&c), "{operation}");
    }
}
