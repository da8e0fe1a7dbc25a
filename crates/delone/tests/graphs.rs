//! Proximity graphs against their definitions, their inclusions on every set, and that nothing but the set decides them.

use std::collections::BTreeSet;

use delone::{Change, Delaunay2, Delaunay3, Error, Graph, VertexId};
use delone_generators::{Kind, Kind3, Random};
use delone_oracle::graphs;

type Pairs = BTreeSet<[usize; 2]>;

const BETAS: [f64; 6] = [1.0 + f64::EPSILON, 1.25, 1.7, 2.0 + f64::EPSILON, 3.0, 40.0];

fn pairs(edges: impl IntoIterator<Item = [VertexId; 2]>) -> Pairs {
    let sorted = |[v, w]: [VertexId; 2]| [v.index().min(w.index()), v.index().max(w.index())];
    edges.into_iter().map(sorted).collect()
}

/// The operations of both triangulations.
trait Graphs<const D: usize>: Change<Point = [f64; D]> {
    fn edges_of(&self, graph: Graph) -> Result<Vec<[VertexId; 2]>, Error>;

    fn found(&self, graph: Graph) -> Pairs {
        let edges = self.edges_of(graph).expect("a graph");
        assert!(edges.is_sorted() && edges.iter().all(|[v, w]| v < w));
        let pairs = pairs(edges.iter().copied());
        assert_eq!(pairs.len(), edges.len(), "none is twice");
        pairs
    }
}

impl Graphs<2> for Delaunay2 {
    fn edges_of(&self, graph: Graph) -> Result<Vec<[VertexId; 2]>, Error> {
        self.graph(graph)
    }
}

impl Graphs<3> for Delaunay3 {
    fn edges_of(&self, graph: Graph) -> Result<Vec<[VertexId; 2]>, Error> {
        self.graph(graph)
    }
}

fn triangulated<const D: usize, T: Graphs<D>>(points: &[[f64; D]]) -> T {
    T::from_vec(points.to_vec()).expect("finite")
}

/// All against the definitions.
fn as_defined<const D: usize, T: Graphs<D>>(points: &[[f64; D]], what: &str) {
    let d = triangulated::<D, T>(points);
    let expected = graphs::gabriel(points);
    assert_eq!(d.found(Graph::Gabriel), expected, "{what}: Gabriel");
    assert_eq!(d.found(Graph::Beta(1.0)), expected, "{what}: beta 1");
    let expected = graphs::relative_neighbors(points);
    assert_eq!(d.found(Graph::RelativeNeighbors), expected, "{what}: relative neighbors");
    assert_eq!(d.found(Graph::Beta(2.0)), expected, "{what}: beta 2");
    assert_eq!(d.found(Graph::SpanningTree), graphs::spanning_tree(points), "{what}: tree");
    for beta in BETAS.into_iter().chain((points.len() < 20).then_some(f64::MAX)) {
        assert_eq!(d.found(Graph::Beta(beta)), graphs::beta_skeleton(points, beta), "{what}: beta {beta}");
    }
    for k in [0, 1, 2, 5, points.len() + 1, usize::MAX] {
        assert_eq!(d.found(Graph::Nearest(k)), graphs::nearest(points, k), "{what}: {k} nearest");
    }
}

/// Each is part of the next.
fn nested<const D: usize, T: Graphs<D>>(d: &T, what: &str) {
    let (tree, rng) = (d.found(Graph::SpanningTree), d.found(Graph::RelativeNeighbors));
    assert_eq!(tree.len(), d.vertex_count().saturating_sub(1), "{what}");
    assert!(tree.is_subset(&rng), "{what}: tree");
    let mut chain = vec![pairs(d.edges()), d.found(Graph::Gabriel)];
    chain.extend([1.0 + f64::EPSILON, 1.5, 2.0, 2.5, 10.0, 100.0].map(|beta| d.found(Graph::Beta(beta))));
    assert_eq!(chain[4], rng);
    for (k, two) in chain.windows(2).enumerate() {
        assert!(two[1].is_subset(&two[0]), "{what}: {k}");
    }
    let nearest = d.found(Graph::Nearest(1));
    assert!(nearest.is_subset(&tree) || d.duplicates().next().is_some(), "{what}: nearest");
}

fn small_sets() -> Vec<(String, Vec<[f64; 2]>)> {
    let mut r = Random::new(5);
    let tiny = f64::from_bits(1);
    let mut sets: Vec<(String, Vec<[f64; 2]>)> = vec![
        ("nothing".into(), vec![]),
        ("one".into(), vec![[1.0, 2.0]]),
        ("two".into(), vec![[1.0, 2.0], [-3.0, 2.0]]),
        ("all equal".into(), vec![[1.0, 2.0]; 5]),
        (
            "spans".into(),
            vec![[1e300, 1e300], [-1e300, 3.0], [1e-300, 0.0], [0.0, 1e-300], [7.0, 8.0], [8.0, 7.0]],
        ),
        (
            "extremes".into(),
            vec![[f64::MAX, 0.0], [-f64::MAX, 0.0], [0.0, f64::MAX], [0.0, -f64::MAX], [0.0, 0.0]],
        ),
        ("subnormal".into(), (0..16).map(|i| [f64::from(i % 4) * tiny, f64::from(i / 4) * tiny]).collect()),
        (
            "circle of radius 65".into(),
            [[65, 0], [63, 16], [60, 25], [56, 33], [52, 39], [39, 52], [33, 56], [16, 63]]
                .iter()
                .flat_map(|&[x, y]| [[x, y], [-x, y], [x, -y]])
                .map(|p| p.map(f64::from))
                .collect(),
        ),
        (
            "hexagons".into(),
            (0..25).map(|i| [f64::from(2 * (i % 5) + i / 5 % 2), f64::from(i / 5) * 3f64.sqrt()]).collect(),
        ),
    ];
    for round in 0..40 {
        let side = 2 + round % 4;
        let lattice = (0..3 + round % 20).map(|_| [r.below(side + 1) as f64, r.below(side) as f64]).collect();
        sets.push((format!("lattice {round}"), lattice));
    }
    for (n, seed) in [(7, 1), (22, 2)] {
        sets.extend(Kind::ALL.iter().map(|kind| (format!("{} {n}", kind.name()), kind.points(n, seed))));
    }
    sets
}

#[test]
fn small_sets_of_the_plane_are_as_defined() {
    for (what, points) in small_sets() {
        as_defined::<2, Delaunay2>(&points, &what);
        nested::<2, Delaunay2>(&triangulated(&points), &what);
    }
}

#[test]
fn small_sets_of_space_are_as_defined() {
    let mut r = Random::new(6);
    for (what, flat) in small_sets().into_iter().filter(|(_, points)| points.len() < 20) {
        // In a plane, on a slanted one, and off it.
        let heights: [fn([f64; 2]) -> f64; 3] =
            [|_| 5.0, |[x, y]| (x + y) / 4.0, |[x, y]| (x * 3.0 + y * 5.0) % 3.0];
        for (k, height) in heights.into_iter().enumerate() {
            let points: Vec<[f64; 3]> = flat.iter().map(|&p| [p[0], p[1], height(p)]).collect();
            if points.as_flattened().iter().all(|x| x.is_finite()) {
                as_defined::<3, Delaunay3>(&points, &format!("{what}, {k}"));
                nested::<3, Delaunay3>(&triangulated(&points), &what);
            }
        }
    }
    for round in 0..30 {
        let side = 2 + round % 3;
        let lattice: Vec<[f64; 3]> =
            (0..4 + round % 15).map(|_| [(); 3].map(|()| r.below(side) as f64)).collect();
        as_defined::<3, Delaunay3>(&lattice, &format!("lattice {round}"));
    }
    for kind in Kind3::ALL {
        as_defined::<3, Delaunay3>(&kind.points(15, 3), kind.name());
    }
}

#[test]
fn larger_sets_are_nested() {
    for kind in Kind::ALL {
        nested::<2, Delaunay2>(&triangulated(&kind.points(300, 4)), kind.name());
    }
    for kind in Kind3::ALL {
        nested::<3, Delaunay3>(&triangulated(&kind.points(100, 4)), kind.name());
    }
}

/// The set decides, not the order of the points, nor what was there before.
fn by_the_set_alone<const D: usize, T: Graphs<D>>(points: &[[f64; D]], what: &str) {
    let mut distinct = points.to_vec();
    distinct.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
    distinct.dedup();
    let mut shuffled: Vec<usize> = (0..distinct.len()).collect();
    let mut r = Random::new(7);
    (1..shuffled.len()).for_each(|i| shuffled.swap(i, r.below(i + 1)));
    let other: Vec<[f64; D]> = shuffled.iter().map(|&i| distinct[i]).collect();
    let (d, e): (T, T) = (triangulated(&distinct), triangulated(&other));
    // And one that had other points, and got these one by one.
    let mut f: T = triangulated(&points.iter().map(|p| p.map(|x| x / 2.0 + 0.25)).collect::<Vec<_>>());
    let before: Vec<VertexId> = f.vertices().collect();
    let inserted: Vec<VertexId> =
        other.iter().map(|&p| f.insert_observed(p, &mut ()).expect("finite").vertex()).collect();
    before
        .iter()
        .filter(|v| !inserted.contains(v))
        .for_each(|&v| f.remove_observed(v, &mut ()).expect("a vertex"));
    for graph in
        [Graph::Gabriel, Graph::RelativeNeighbors, Graph::SpanningTree, Graph::Beta(1.3), Graph::Nearest(3)]
    {
        let expected = d.found(graph);
        let back = |[i, j]: [usize; 2]| {
            let [i, j] = [shuffled[i], shuffled[j]];
            [i.min(j), i.max(j)]
        };
        assert_eq!(e.found(graph).into_iter().map(back).collect::<Pairs>(), expected, "{what}: {graph:?}");
        let index = |v: usize| inserted.iter().position(|w| w.index() == v).expect("inserted");
        let changed: Pairs = f.found(graph).into_iter().map(|edge| back(edge.map(index))).collect();
        assert_eq!(changed, expected, "{what}: {graph:?}, changed");
    }
}

#[test]
fn the_set_alone_decides() {
    for kind in [Kind::Uniform, Kind::Grid, Kind::Circle, Kind::Line, Kind::Duplicates] {
        by_the_set_alone::<2, Delaunay2>(&kind.points(300, 1), kind.name());
    }
    for kind in Kind3::ALL {
        by_the_set_alone::<3, Delaunay3>(&kind.points(80, 1), kind.name());
    }
}

/// Sets that are worth more than one thread.
#[test]
fn threads_do_not_show() {
    let in_pool = |threads: usize, work: &(dyn Fn() -> Vec<Vec<[VertexId; 2]>> + Sync)| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool").install(work)
    };
    let kinds = [Graph::Gabriel, Graph::SpanningTree, Graph::Beta(1.5), Graph::Nearest(2)];
    let plane: Delaunay2 = triangulated(&Kind::Uniform.points(40_000, 1));
    let space: Delaunay3 = triangulated(&Kind3::Cube.points(40_000, 1));
    let all = || -> Vec<Vec<[VertexId; 2]>> {
        let of = |graph| [plane.graph(graph).expect("a graph"), space.graph(graph).expect("a graph")];
        kinds.into_iter().flat_map(of).collect()
    };
    let one = in_pool(1, &all);
    assert!(one.iter().all(|edges| edges.len() > 30_000));
    assert_eq!(in_pool(3, &all), one);
}

#[test]
fn beta_is_at_least_one() {
    let d = Delaunay2::from_points(&[[0.0, 0.0], [1.0, 0.0]]).expect("finite");
    let e = Delaunay3::from_points(&[[0.0, 0.0, 0.0]]).expect("finite");
    for beta in [0.0, -1.0, 1.0 - f64::EPSILON, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for answer in [d.graph(Graph::Beta(beta)), e.graph(Graph::Beta(beta))] {
            assert!(matches!(answer, Err(Error::Parameter { name: "beta", .. })), "{beta}");
        }
    }
    assert_eq!(d.found(Graph::Beta(f64::MAX)).len(), 1);
}
