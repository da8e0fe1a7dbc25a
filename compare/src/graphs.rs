//! Proximity graphs of a set: Delone beside its own construction, and beside what is written without it: the edges of the
//! triangulation sorted by rounded lengths, with a union-find (the length of that tree must be the same up to rounding).

use std::time::Instant;

use delone::{Delaunay2, Graph};
use delone_generators::Kind;

const GRAPHS: [(&str, Graph); 5] = [
    ("Gabriel", Graph::Gabriel),
    ("spanning tree", Graph::SpanningTree),
    ("relative neighbors", Graph::RelativeNeighbors),
    ("beta 1.5", Graph::Beta(1.5)),
    ("6 nearest", Graph::Nearest(6)),
];

/// Times all graphs of a set and prints the minimum over the runs; whether the trees are equally long.
pub fn run(kind: Kind, size: usize, runs: usize) -> bool {
    let points = kind.points(size, 1);
    let mut best = [f64::INFINITY; GRAPHS.len() + 2];
    let (mut counts, mut lengths) = ([0; GRAPHS.len()], [0.0; 2]);
    for _ in 0..runs {
        let start = Instant::now();
        let Ok(d) = Delaunay2::from_points(&points) else { return false };
        best[0] = start.elapsed().as_secs_f64().min(best[0]);
        for (k, (_, graph)) in GRAPHS.into_iter().enumerate() {
            let start = Instant::now();
            let Ok(edges) = d.graph(graph) else { return false };
            best[k + 1] = start.elapsed().as_secs_f64().min(best[k + 1]);
            counts[k] = edges.len();
            if graph == Graph::SpanningTree {
                lengths[0] = edges.iter().map(|&[v, w]| squared(d.point(v), d.point(w)).sqrt()).sum();
            }
        }
        let start = Instant::now();
        lengths[1] = plain_tree(&d);
        best[GRAPHS.len() + 1] = start.elapsed().as_secs_f64().min(best[GRAPHS.len() + 1]);
    }
    println!("\n{} {size}, ns per point and times the construction", kind.name());
    let tell = |name: &str, seconds: f64, count: usize| {
        println!(
            "  {name:20} {:>8.0} {:>6.2} x {count:>10} edges",
            seconds * 1e9 / size as f64,
            seconds / best[0]
        );
    };
    tell("construction", best[0], 0);
    GRAPHS.iter().enumerate().for_each(|(k, (name, _))| tell(name, best[k + 1], counts[k]));
    tell("tree by plain sorting", best[GRAPHS.len() + 1], counts[1]);
    let is_right = (lengths[0] - lengths[1]).abs() <= 1e-9 * lengths[1];
    if !is_right {
        println!("  WRONG: trees of the lengths {} and {}", lengths[0], lengths[1]);
    }
    is_right
}

fn squared(p: [f64; 2], q: [f64; 2]) -> f64 {
    (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2)
}

/// The length of the spanning tree as it is mostly written.
fn plain_tree(d: &Delaunay2) -> f64 {
    let mut edges: Vec<(f64, [usize; 2])> =
        d.edges().map(|[v, w]| (squared(d.point(v), d.point(w)), [v.index(), w.index()])).collect();
    edges.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut above: Vec<usize> = (0..d.points().len()).collect();
    let mut length = 0.0;
    for (square, ends) in edges {
        let [a, b] = ends.map(|mut v| {
            while above[v] != v {
                above[v] = above[above[v]];
                v = above[v];
            }
            v
        });
        if a != b {
            above[a] = b;
            length += square.sqrt();
        }
    }
    length
}
