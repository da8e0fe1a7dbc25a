//! Many polygons one by one, of ten corners each up to a hundred thousand: the triangles inside.

use std::time::{Duration, Instant};

use delone_generators::{Graph, Random};

type Rings = [Vec<[f64; 2]>];

/// Seconds, and the number of triangles.
type Engine = (&'static str, fn(&Rings) -> Option<(Duration, usize)>);

const ENGINES: &[Engine] = &[
    ("delone", delone),
    #[cfg(cgal)]
    ("cgal", cgal),
    ("earcut", earcut),
    ("earcutr", earcutr),
    ("cdt", cdt),
];

/// Corners of one polygon.
const CORNERS: [usize; 5] = [10, 100, 1000, 10_000, 100_000];

/// Nanoseconds per corner above which an engine is not asked for ten times as many.
const SLOW: f64 = 3000.0;

/// Times all engines on so many corners in all, and prints the minimum over the runs.
pub fn run(size: usize, runs: usize) {
    println!("the inside of polygons, ns per corner, minimum of {runs} alternating runs, one thread");
    for graph in [Graph::Koch, Graph::Star, Graph::Spiral] {
        let mut is_slow = [false; ENGINES.len()];
        for corners in CORNERS.into_iter().filter(|&corners| corners <= size) {
            let rings = rings(graph, corners, size / corners);
            let all: usize = rings.iter().map(Vec::len).sum();
            let expected = all - 2 * rings.len();
            println!("\n{} polygons like a {} of {} corners", rings.len(), graph.name(), rings[0].len());
            let mut found: Vec<Option<(Duration, usize)>> = vec![None; ENGINES.len()];
            for _ in 0..runs {
                for (((_, engine), found), _) in
                    ENGINES.iter().zip(&mut found).zip(&is_slow).filter(|(_, is_slow)| !**is_slow)
                {
                    let new = engine(&rings);
                    *found = (*found).map_or(new, |old| new.map(|new| new.min(old)));
                }
            }
            let first = found.first().copied().flatten().map_or(f64::NAN, |(time, _)| time.as_secs_f64());
            for (((name, _), found), is_slow) in ENGINES.iter().zip(found).zip(&mut is_slow) {
                let Some((time, triangles)) = found else {
                    println!("  {name:20} {:>8}", if *is_slow { "not run" } else { "fails" });
                    continue;
                };
                let (seconds, others) = (time.as_secs_f64(), triangles as f64 - expected as f64);
                let ns = seconds * 1e9 / all as f64;
                *is_slow = ns > SLOW;
                let remark = if others == 0.0 { String::new() } else { format!("{others:+} triangles") };
                println!("  {name:20} {ns:>8.1} {:>7.2} x  {remark}", seconds / first);
            }
        }
    }
}

/// Polygons in different places.
fn rings(graph: Graph, corners: usize, count: usize) -> Vec<Vec<[f64; 2]>> {
    let mut random = Random::new(1);
    let mut ring = |seed: usize| {
        let at = [random.between(-100.0, 100.0), random.between(-100.0, 100.0)];
        let (points, _) = graph.parts(corners, seed as u64);
        points.into_iter().map(|p| [p[0] + at[0], p[1] + at[1]]).collect()
    };
    (0..count).map(&mut ring).collect()
}

fn delone(rings: &Rings) -> Option<(Duration, usize)> {
    let start = Instant::now();
    let mut count = 0;
    for ring in rings {
        count += delone::Polygons2::default().triangulate(&[ring]).ok()?.triangles.len();
    }
    Some((start.elapsed(), count))
}

fn earcut(rings: &Rings) -> Option<(Duration, usize)> {
    let start = Instant::now();
    let (mut earcut, mut triangles, mut count) = (earcut::Earcut::new(), Vec::<u32>::new(), 0);
    for ring in rings {
        earcut.earcut_slice(ring, &[], &mut triangles);
        count += triangles.len() / 3;
    }
    Some((start.elapsed(), count))
}

fn earcutr(rings: &Rings) -> Option<(Duration, usize)> {
    let start = Instant::now();
    let mut count = 0;
    for ring in rings {
        count += earcutr::earcut(ring.as_flattened(), &[], 2).ok()?.len() / 3;
    }
    Some((start.elapsed(), count))
}

/// A ring as `cdt` takes it: points, and segments by their ends.
type PlainGraph = (Vec<(f64, f64)>, Vec<(usize, usize)>);

fn cdt(rings: &Rings) -> Option<(Duration, usize)> {
    let rings: Vec<PlainGraph> = rings
        .iter()
        .map(|ring| {
            let n = ring.len();
            (ring.iter().map(|p| (p[0], p[1])).collect(), (0..n).map(|i| (i, (i + 1) % n)).collect())
        })
        .collect();
    let start = Instant::now();
    let mut count = 0;
    for (points, segments) in &rings {
        count += cdt::triangulate_with_edges(points, segments).ok()?.len();
    }
    Some((start.elapsed(), count))
}

#[cfg(cgal)]
unsafe extern "C" {
    fn cgal_polygons(xy: *const f64, corners: *const usize, rings: usize, seconds: *mut f64) -> isize;
}

#[cfg(cgal)]
fn cgal(rings: &Rings) -> Option<(Duration, usize)> {
    let points: Vec<[f64; 2]> = rings.iter().flatten().copied().collect();
    let end = |at: &mut usize, ring: &Vec<[f64; 2]>| {
        *at += ring.len();
        Some(*at)
    };
    let ends: Vec<usize> = rings.iter().scan(0, end).collect();
    let mut seconds = 0.0;
    // SAFETY: the shim reads so many ends of rings, their points, and writes one number.
    let count = unsafe { cgal_polygons(points.as_ptr().cast(), ends.as_ptr(), ends.len(), &raw mut seconds) };
    Some((Duration::from_secs_f64(seconds), usize::try_from(count).ok()?))
}
