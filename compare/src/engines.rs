//! The engines that are compared. Each is timed from its own kind of points, prepared beforehand, to its own
//! complete result; its triangles are taken out for judging after the clock has stopped.

use std::hint::black_box;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use rayon::{ThreadPool, ThreadPoolBuilder};
use spade::Triangulation as _;

type Points = [[f64; 2]];

/// Time of one run, and its triangles as indices of the input.
pub type Run = (Duration, Vec<[u64; 3]>);

/// Something that triangulates.
pub struct Engine {
    pub name: &'static str,
    /// A Rust crate of others.
    pub is_peer_crate: bool,
    /// Points beyond which it takes minutes.
    pub most: usize,
    /// Runs once, or says why not. Triangles are only collected when asked for.
    pub run: fn(&Points, bool) -> Result<Run, String>,
}

/// All of them, ours first.
pub const ENGINES: &[Engine] = &[
    Engine { name: "delone", is_peer_crate: false, most: usize::MAX, run: delone_divide_and_conquer },
    Engine { name: "delone-2-threads", is_peer_crate: false, most: usize::MAX, run: delone_on_two_threads },
    Engine { name: "delone-incremental", is_peer_crate: false, most: usize::MAX, run: delone_incremental },
    #[cfg(cgal)]
    Engine { name: "cgal", is_peer_crate: false, most: usize::MAX, run: cgal_plain },
    #[cfg(cgal)]
    Engine { name: "cgal-indexed", is_peer_crate: false, most: usize::MAX, run: cgal_indexed },
    Engine { name: "spade", is_peer_crate: true, most: usize::MAX, run: spade_bulk },
    Engine { name: "spade-stable", is_peer_crate: true, most: usize::MAX, run: spade_stable },
    Engine { name: "delaunator", is_peer_crate: true, most: usize::MAX, run: delaunator },
    Engine { name: "cdt", is_peer_crate: true, most: usize::MAX, run: cdt },
    Engine { name: "startin", is_peer_crate: true, most: 50_000, run: startin },
];

pub fn timed<T>(work: impl FnOnce() -> T) -> (Duration, T) {
    let start = Instant::now();
    let result = black_box(work());
    (start.elapsed(), result)
}

/// Pools of one and of two threads; everybody else works on one.
pub static POOLS: [LazyLock<ThreadPool>; 2] = [LazyLock::new(|| pool(1)), LazyLock::new(|| pool(2))];

/// Each of several threads stays on a core of its own, if there are enough. A guest of a virtual machine wakes threads on the
/// core that wakes them, because an idle one seems to be taken, and they share it for milliseconds: half of a short run.
fn pool(threads: usize) -> ThreadPool {
    let cores = core_affinity::get_core_ids().unwrap_or_default();
    let alone = threads > 1 && cores.len() >= threads;
    let stay = move |thread: usize| {
        if alone {
            core_affinity::set_for_current(cores[thread]);
        }
    };
    ThreadPoolBuilder::new().num_threads(threads).start_handler(stay).build().expect("threads")
}

fn delone(
    points: &Points,
    wanted: bool,
    algorithm: delone::Algorithm2,
    threads: usize,
) -> Result<Run, String> {
    let own = points.to_vec();
    let pool = &POOLS[threads - 1];
    let (time, result) = pool.install(|| {
        timed(|| match algorithm {
            delone::Algorithm2::DivideAndConquer => delone::Delaunay2::from_vec(own),
            _ => delone::Delaunay2::with_algorithm(&own, algorithm),
        })
    });
    let d = result.map_err(|error| error.to_string())?;
    let triangles =
        if wanted { d.triangles().map(|t| t.map(|v| v.index() as u64)).collect() } else { Vec::new() };
    Ok((time, triangles))
}

fn delone_divide_and_conquer(points: &Points, wanted: bool) -> Result<Run, String> {
    delone(points, wanted, delone::Algorithm2::DivideAndConquer, 1)
}

fn delone_on_two_threads(points: &Points, wanted: bool) -> Result<Run, String> {
    delone(points, wanted, delone::Algorithm2::DivideAndConquer, 2)
}

fn delone_incremental(points: &Points, wanted: bool) -> Result<Run, String> {
    delone(points, wanted, delone::Algorithm2::Incremental { seed: 1 }, 1)
}

#[cfg(cgal)]
unsafe extern "C" {
    fn cgal_plain_time(xy: *const f64, n: usize, seconds: *mut f64) -> usize;
    fn cgal_indexed_time(xy: *const f64, n: usize, triangles: *mut u32, seconds: *mut f64) -> usize;
}

/// CGAL without indices, its fastest way; judged through `cgal_indexed`, which makes the same triangles.
#[cfg(cgal)]
fn cgal_plain(points: &Points, wanted: bool) -> Result<Run, String> {
    let mut seconds = 0.0;
    // SAFETY: the shim reads 2 n numbers and writes one.
    unsafe { cgal_plain_time(points.as_ptr().cast(), points.len(), &raw mut seconds) };
    let triangles = if wanted { cgal_indexed(points, true)?.1 } else { Vec::new() };
    Ok((Duration::from_secs_f64(seconds), triangles))
}

#[cfg(cgal)]
fn cgal_indexed(points: &Points, wanted: bool) -> Result<Run, String> {
    let mut triangles = vec![0_u32; 6 * points.len()];
    let mut seconds = 0.0;
    // SAFETY: the shim reads 2 n numbers and writes at most 3 (2 n - 5) indices and one number.
    let count = unsafe {
        cgal_indexed_time(points.as_ptr().cast(), points.len(), triangles.as_mut_ptr(), &raw mut seconds)
    };
    let rows = triangles[..3 * count].as_chunks().0.iter().filter(|_| wanted);
    Ok((Duration::from_secs_f64(seconds), rows.map(|t: &[u32; 3]| t.map(u64::from)).collect()))
}

/// A point that knows its index.
#[derive(Clone, Copy)]
pub struct Indexed {
    at: spade::Point2<f64>,
    pub index: u32,
}

pub fn indexed((index, p): (usize, &[f64; 2])) -> Indexed {
    Indexed { at: spade::Point2::new(p[0], p[1]), index: index as u32 }
}

impl spade::HasPosition for Indexed {
    type Scalar = f64;

    fn position(&self) -> spade::Point2<f64> {
        self.at
    }
}

type Spade = spade::DelaunayTriangulation<Indexed>;

fn spade_with(
    points: &Points,
    wanted: bool,
    load: fn(Vec<Indexed>) -> Result<Spade, spade::InsertionError>,
) -> Result<Run, String> {
    let own: Vec<_> = points.iter().enumerate().map(indexed).collect();
    let (time, result) = timed(|| load(own));
    let d = result.map_err(|error| format!("{error:?}"))?;
    let mut triangles = Vec::new();
    if wanted {
        triangles.extend(d.inner_faces().map(|face| face.vertices().map(|v| u64::from(v.data().index))));
    }
    Ok((time, triangles))
}

fn spade_bulk(points: &Points, wanted: bool) -> Result<Run, String> {
    spade_with(points, wanted, Spade::bulk_load)
}

fn spade_stable(points: &Points, wanted: bool) -> Result<Run, String> {
    spade_with(points, wanted, Spade::bulk_load_stable)
}

fn delaunator(points: &Points, wanted: bool) -> Result<Run, String> {
    let own: Vec<_> = points.iter().map(|p| delaunator::Point { x: p[0], y: p[1] }).collect();
    let (time, d) = timed(|| delaunator::triangulate(&own));
    let rows = d.triangles.as_chunks().0.iter().filter(|_| wanted);
    Ok((time, rows.map(|t: &[usize; 3]| t.map(|i| i as u64)).collect()))
}

fn cdt(points: &Points, wanted: bool) -> Result<Run, String> {
    let own: Vec<_> = points.iter().map(|p| (p[0], p[1])).collect();
    let (time, result) = timed(|| cdt::triangulate_points(&own));
    let rows = result.map_err(|error| format!("{error:?}"))?;
    Ok((time, rows.into_iter().filter(|_| wanted).map(|(a, b, c)| [a, b, c].map(|i| i as u64)).collect()))
}

/// startin numbers its vertices itself: they are found again by their coordinates.
fn startin(points: &Points, wanted: bool) -> Result<Run, String> {
    let own: Vec<_> = points.iter().map(|p| [p[0], p[1], 0.0]).collect();
    let (time, d) = timed(|| {
        let mut d = startin::Triangulation::new();
        d.set_snap_tolerance(f64::MIN_POSITIVE);
        d.insert(&own, startin::InsertionStrategy::AsIs);
        d
    });
    if !wanted {
        return Ok((time, Vec::new()));
    }
    let mut order: Vec<usize> = (0..points.len()).collect();
    let by_place = |p: [f64; 2], q: [f64; 2]| p.partial_cmp(&q).expect("finite");
    order.sort_unstable_by(|&i, &j| by_place(points[i], points[j]));
    let index = |v: usize| {
        let p = d.get_point(v).map_err(|error| format!("{error:?}"))?;
        let found = order.binary_search_by(|&i| by_place(points[i], [p[0], p[1]]));
        found.map(|at| order[at] as u64).map_err(|_| "a vertex is no input point".to_owned())
    };
    let finite = d.all_finite_triangles().into_iter();
    // Duplicates may be found under another of their indices: judged by the first found.
    let mut triangles = Vec::new();
    for t in finite {
        triangles.push([index(t.v[0])?, index(t.v[1])?, index(t.v[2])?]);
    }
    Ok((time, triangles))
}
