//! Insertion one by one, location, nearest vertex and removal: Delone beside the hierarchies of CGAL and spade.
//!
//! Points and queries are random and in random order. Every engine is asked the same, and the answers are compared:
//! which queries are inside the hull, and how far the nearest vertex is.

use std::time::Instant;

use delone::{Delaunay2, Hierarchy, Locate, Location2, VertexId};
use delone_generators::{Kind, Random};
use delone_oracle::exact::compare_distances;
use spade::{HierarchyHintGenerator, PositionInTriangulation, Triangulation as _};

type Points = [[f64; 2]];

/// The operations, in their order.
const OPERATIONS: [&str; 4] = ["insert", "locate", "nearest", "remove"];

/// The run of an engine.
pub struct Run {
    /// Seconds for each operation.
    seconds: [f64; 4],
    inside: Vec<bool>,
    nearest: Vec<[f64; 2]>,
}

pub type Engine = (&'static str, fn(&Points, &Points) -> Run);

const ENGINES: &[Engine] = &[
    ("delone", |points, queries| delone(points, queries, Locate::Tree)),
    ("delone-hierarchy", |points, queries| delone(points, queries, Locate::Hierarchy(Hierarchy::default()))),
    #[cfg(cgal)]
    ("cgal-hierarchy", cgal),
    ("spade-hierarchy", spade),
];

/// The engines of these names; all for none.
pub fn chosen(names: &[String]) -> Vec<&'static Engine> {
    let is_chosen = |engine: &&Engine| names.is_empty() || names.iter().any(|name| name == engine.0);
    ENGINES.iter().filter(is_chosen).collect()
}

/// Times the four operations and prints the minimum over the runs. False if an engine of ours answers otherwise than
/// the others.
pub fn run(engines: &[&Engine], kind: Kind, size: usize, runs: usize) -> bool {
    let mut random = Random::new(2);
    let mut points = kind.points(size, 1);
    random.shuffle(&mut points);
    let mut queries = kind.points(size, 3);
    random.shuffle(&mut queries);
    let mut best = vec![[f64::INFINITY; 4]; engines.len()];
    let mut all_right = true;
    for round in 0..runs {
        let mut first: Option<Run> = None;
        for (i, (name, engine)) in engines.iter().enumerate() {
            let run = engine(&points, &queries);
            for (least, seconds) in best[i].iter_mut().zip(run.seconds) {
                *least = least.min(seconds);
            }
            match &first {
                None => first = Some(run),
                Some(first) if round == 0 => all_right &= agree(name, first, &run, &queries),
                Some(_) => {}
            }
        }
    }
    println!("\n{} {size}, one by one in random order, ns per operation", kind.name());
    println!("  {:20} {}", "", OPERATIONS.map(|name| format!("{name:>16}")).concat());
    let count = |k: usize| if k == 3 { size / 2 } else { size } as f64;
    for ((name, _), seconds) in engines.iter().zip(&best) {
        let cell =
            |k: usize| format!("{:>8.0} {:>6.2}x", seconds[k] * 1e9 / count(k), seconds[k] / best[0][k]);
        println!("  {name:20} {}", [0, 1, 2, 3].map(cell).concat());
    }
    let (ours, others): (Vec<_>, Vec<_>) =
        engines.iter().zip(&best).partition(|((name, _), _)| name.starts_with("delone"));
    for ((name, _), own) in ours.into_iter().filter(|_| !others.is_empty()) {
        let ratio = |k: usize| others.iter().map(|(_, best)| best[k] / own[k]).fold(f64::INFINITY, f64::min);
        let ratios = [0, 1, 2, 3].map(|k| format!("{} {:.2} x", OPERATIONS[k], ratio(k)));
        println!("  best of the others / {name}: {}", ratios.join(", "));
    }
    all_right
}

fn agree(name: &str, ours: &Run, theirs: &Run, queries: &Points) -> bool {
    let inside = ours.inside.iter().zip(&theirs.inside).filter(|(a, b)| a != b).count();
    let far = |i: &usize| compare_distances(queries[*i], ours.nearest[*i], theirs.nearest[*i]) != 0;
    let nearest = (0..queries.len()).filter(far).count();
    if inside + nearest > 0 {
        println!(
            "  {name}: {inside} queries on another side of the hull, {nearest} with another nearest distance"
        );
    }
    inside + nearest == 0 || !name.starts_with("delone")
}

fn delone(points: &Points, queries: &Points, locate: Locate) -> Run {
    let mut d = Delaunay2::with_strategy(locate).expect("in range");
    let mut run = Run { seconds: [0.0; 4], inside: Vec::new(), nearest: Vec::new() };
    run.inside.reserve(queries.len());
    run.nearest.reserve(queries.len());
    let mut ids = Vec::with_capacity(points.len());
    let start = Instant::now();
    for &p in points {
        ids.push(d.insert(p).expect("finite").vertex());
    }
    run.seconds[0] = start.elapsed().as_secs_f64();
    let start = Instant::now();
    for &q in queries {
        run.inside.push(!matches!(d.locate(q).expect("finite"), Location2::Outside(_)));
    }
    run.seconds[1] = start.elapsed().as_secs_f64();
    let start = Instant::now();
    for &q in queries {
        let v: Option<VertexId> = d.nearest(q).expect("finite");
        run.nearest.push(v.map_or([f64::NAN; 2], |v| d.point(v)));
    }
    run.seconds[2] = start.elapsed().as_secs_f64();
    let start = Instant::now();
    for &v in &ids[..points.len() / 2] {
        // A duplicate was removed with the vertex that it equals.
        _ = d.remove(v);
    }
    run.seconds[3] = start.elapsed().as_secs_f64();
    run
}

#[cfg(cgal)]
unsafe extern "C" {
    fn cgal_changes(
        xy: *const f64,
        n: usize,
        queries: *const f64,
        m: usize,
        inside: *mut u8,
        nearest: *mut f64,
        seconds: *mut f64,
    );
}

#[cfg(cgal)]
fn cgal(points: &Points, queries: &Points) -> Run {
    let mut inside = vec![0_u8; queries.len()];
    let mut nearest = vec![[0.0; 2]; queries.len()];
    let mut seconds = [0.0; 4];
    // SAFETY: the shim reads 2 n and 2 m numbers and writes m flags, 2 m numbers and four times.
    unsafe {
        cgal_changes(
            points.as_ptr().cast(),
            points.len(),
            queries.as_ptr().cast(),
            queries.len(),
            inside.as_mut_ptr(),
            nearest.as_mut_ptr().cast(),
            seconds.as_mut_ptr(),
        );
    }
    Run { seconds, inside: inside.into_iter().map(|flag| flag != 0).collect(), nearest }
}

type Spade = spade::DelaunayTriangulation<spade::Point2<f64>, (), (), (), HierarchyHintGenerator<f64>>;

/// spade renumbers vertices when one is removed: those removed are random ones.
fn spade(points: &Points, queries: &Points) -> Run {
    let mut d = Spade::new();
    let mut run = Run { seconds: [0.0; 4], inside: Vec::new(), nearest: Vec::new() };
    run.inside.reserve(queries.len());
    run.nearest.reserve(queries.len());
    let start = Instant::now();
    for p in points {
        _ = d.insert(spade::Point2::new(p[0], p[1]));
    }
    run.seconds[0] = start.elapsed().as_secs_f64();
    let start = Instant::now();
    for q in queries {
        let place = d.locate(spade::Point2::new(q[0], q[1]));
        run.inside.push(!matches!(place, PositionInTriangulation::OutsideOfConvexHull(_)));
    }
    run.seconds[1] = start.elapsed().as_secs_f64();
    let start = Instant::now();
    for q in queries {
        let v = d.nearest_neighbor(spade::Point2::new(q[0], q[1])).map(|v| v.position());
        run.nearest.push(v.map_or([f64::NAN; 2], |p| [p.x, p.y]));
    }
    run.seconds[2] = start.elapsed().as_secs_f64();
    let mut random = Random::new(4);
    let start = Instant::now();
    for _ in 0..points.len() / 2 {
        d.remove(spade::handles::FixedVertexHandle::from_index(random.below(d.num_vertices())));
    }
    run.seconds[3] = start.elapsed().as_secs_f64();
    run
}
