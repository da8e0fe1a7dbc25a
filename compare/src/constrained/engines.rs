//! The engines that know constraints. Each is timed from its own kind of points and segments, prepared beforehand, to its own
//! complete result.

use std::time::Duration;

use super::Set;
use crate::engines::{Indexed, POOLS, indexed, timed};
#[cfg(cgal)]
use std::ptr;

/// The result: triangles as indices of the input, only if they are wanted.
pub struct Output {
    pub time: Duration,
    pub triangles: Vec<[usize; 3]>,
    /// Not of the convex hull.
    pub is_inside: bool,
}

/// Something that triangulates graphs.
pub struct Engine {
    pub name: &'static str,
    /// Runs once, or says why not.
    pub run: fn(&Set, bool) -> Result<Output, String>,
}

/// All of them, ours first.
pub const ENGINES: &[Engine] = &[
    Engine { name: "delone", run: |set, wanted| delone(set, wanted, 1) },
    Engine { name: "delone-2-threads", run: |set, wanted| delone(set, wanted, 2) },
    Engine { name: "delone-inside", run: delone_inside },
    #[cfg(cgal)]
    Engine { name: "cgal", run: |set, wanted| cgal(set, wanted, cgal_graph) },
    #[cfg(cgal)]
    Engine { name: "cgal-splitting", run: |set, wanted| cgal(set, wanted, cgal_graph_splitting) },
    Engine { name: "spade", run: spade },
    Engine { name: "cdt", run: cdt },
    Engine { name: "earcut", run: earcut },
    Engine { name: "earcutr", run: earcutr },
];

fn delone(set: &Set, wanted: bool, threads: usize) -> Result<Output, String> {
    let build = || timed(|| delone::Constrained2::from_parts(&set.points, &set.segments));
    let (time, result) = POOLS[threads - 1].install(build);
    let c = result.map_err(|error| error.to_string())?;
    let triangles = c.triangles().filter(|_| wanted).map(|t| t.map(|v| v.index())).collect();
    Ok(Output { time, triangles, is_inside: false })
}

/// By the even-odd rule.
fn delone_inside(set: &Set, wanted: bool) -> Result<Output, String> {
    if set.polygons.is_empty() {
        return Err("(knows polygons only)".to_owned());
    }
    let rings: Vec<&[[f64; 2]]> =
        set.polygons.iter().flatten().map(|ring| &set.points[ring.clone()]).collect();
    let (time, result) = timed(|| delone::Polygons2::default().triangulate(&rings));
    let triangles = result.map_err(|error| error.to_string())?.triangles.into_iter().filter(|_| wanted);
    Ok(Output { time, triangles: triangles.map(|t| t.map(|i| i as usize)).collect(), is_inside: true })
}

#[cfg(cgal)]
type CgalGraph = unsafe extern "C" fn(*const f64, usize, *const u32, usize, *mut u32, *mut f64) -> isize;

#[cfg(cgal)]
unsafe extern "C" {
    fn cgal_graph(
        xy: *const f64,
        n: usize,
        ends: *const u32,
        m: usize,
        triangles: *mut u32,
        seconds: *mut f64,
    ) -> isize;
    fn cgal_graph_splitting(
        xy: *const f64,
        n: usize,
        ends: *const u32,
        m: usize,
        triangles: *mut u32,
        seconds: *mut f64,
    ) -> isize;
}

#[cfg(cgal)]
fn cgal(set: &Set, wanted: bool, run: CgalGraph) -> Result<Output, String> {
    let ends: Vec<[u32; 2]> = set.segments.iter().map(|ends| ends.map(|i| i as u32)).collect();
    let n = set.points.len();
    let mut triangles = if wanted { vec![0_u32; 6 * n] } else { Vec::new() };
    let out = if wanted { triangles.as_mut_ptr() } else { ptr::null_mut() };
    let mut seconds = 0.0;
    // SAFETY: the shim reads 2 n numbers and 2 m indices, and writes one number and the indices of less than 2 n triangles,
    // because it does so only if there are at most n vertices.
    let count = unsafe {
        run(set.points.as_ptr().cast(), n, ends.as_ptr().cast(), ends.len(), out, &raw mut seconds)
    };
    let count = usize::try_from(count).map_err(|_| "an exception".to_owned())?;
    triangles.truncate(3 * count);
    let triangles = triangles.as_chunks().0.iter().map(|t: &[u32; 3]| t.map(|i| i as usize)).collect();
    Ok(Output { time: Duration::from_secs_f64(seconds), triangles, is_inside: false })
}

/// Its bulk load keeps the order of the points.
fn spade(set: &Set, wanted: bool) -> Result<Output, String> {
    use spade::{ConstrainedDelaunayTriangulation, Triangulation as _};
    let points: Vec<Indexed> = set.points.iter().enumerate().map(indexed).collect();
    let segments = set.segments.clone();
    let (time, result) =
        timed(|| ConstrainedDelaunayTriangulation::<Indexed>::bulk_load_cdt(points, segments));
    let d = result.map_err(|error| format!("{error:?}"))?;
    let faces = d.inner_faces().filter(|_| wanted);
    let triangles = faces.map(|face| face.vertices().map(|v| v.data().index as usize)).collect();
    Ok(Output { time, triangles, is_inside: false })
}

fn cdt(set: &Set, wanted: bool) -> Result<Output, String> {
    let points: Vec<_> = set.points.iter().map(|p| (p[0], p[1])).collect();
    let segments: Vec<_> = set.segments.iter().map(|ends| (ends[0], ends[1])).collect();
    let (time, result) = timed(|| cdt::triangulate_with_edges(&points, &segments));
    let rows = result.map_err(|error| format!("{error:?}"))?;
    let triangles = rows.into_iter().filter(|_| wanted).map(|(a, b, c)| [a, b, c]).collect();
    Ok(Output { time, triangles, is_inside: true })
}

/// Polygon by polygon, by a function that has the points of one and where its holes begin.
fn by_polygons(
    set: &Set,
    wanted: bool,
    mut cut: impl FnMut(&[[f64; 2]], &[usize]) -> Result<Vec<usize>, String>,
) -> Result<Output, String> {
    if set.polygons.is_empty() {
        return Err("(knows polygons only)".to_owned());
    }
    let (time, result) = timed(|| {
        let mut all = Vec::new();
        for rings in &set.polygons {
            let first = rings[0].start;
            let last = rings.last().map_or(first, |ring| ring.end);
            let holes: Vec<usize> = rings[1..].iter().map(|ring| ring.start - first).collect();
            all.extend(cut(&set.points[first..last], &holes)?.into_iter().map(|i| first + i));
        }
        Ok::<_, String>(all)
    });
    let corners = result?;
    let triangles = corners.as_chunks().0.iter().filter(|_| wanted).copied().collect();
    Ok(Output { time, triangles, is_inside: true })
}

fn earcut(set: &Set, wanted: bool) -> Result<Output, String> {
    let mut earcut = earcut::Earcut::new();
    by_polygons(set, wanted, |points, holes| {
        let mut triangles = Vec::new();
        earcut.earcut_slice(points, holes, &mut triangles);
        Ok(triangles)
    })
}

fn earcutr(set: &Set, wanted: bool) -> Result<Output, String> {
    by_polygons(set, wanted, |points, holes| {
        earcutr::earcut(points.as_flattened(), holes, 2).map_err(|error| format!("{error:?}"))
    })
}
