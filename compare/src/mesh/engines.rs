//! The engines that refine. Each is timed from its own kind of points and segments, prepared beforehand, to its own refined
//! mesh, the constrained triangulation included.

use std::time::Duration;

use delone::{Constrained2, Fill, Refinement, Seeds2};

use super::judge::Mesh;
use crate::engines::timed;

/// The task of an engine.
pub struct Task {
    pub points: Vec<[f64; 2]>,
    pub segments: Vec<[usize; 2]>,
    pub holes: Vec<[f64; 2]>,
    pub is_hull: bool,
    /// No angle should be less: degrees.
    pub angle: f64,
}

/// The result: the mesh is fetched after time and memory are measured.
pub struct Refined {
    pub time: Duration,
    /// How many triangles it says that it could not refine, if it says so.
    pub left: Option<usize>,
    pub mesh: Box<dyn FnOnce() -> Mesh>,
}

/// An engine's own call.
pub type Run = fn(&Task) -> Result<Refined, String>;

/// Something that refines, in a process of its own.
pub struct Engine {
    pub name: &'static str,
    /// Runs once, or says why not. The engine without is a program.
    pub run: Option<Run>,
}

/// The one that all others are measured against.
pub const TRIANGLE: &str = "triangle";

/// All of them, ours first.
pub const ENGINES: &[Engine] = &[
    Engine { name: "delone", run: Some(delone) },
    Engine { name: TRIANGLE, run: None },
    #[cfg(cgal)]
    Engine { name: "cgal", run: Some(cgal::run) },
    Engine { name: "spade", run: Some(spade) },
];

fn delone(task: &Task) -> Result<Refined, String> {
    let seeds = Seeds2::default().holes(task.holes.clone());
    let refinement = Refinement::new().min_angle(task.angle).fill(Fill::Seeds(&seeds));
    let (time, result) = timed(|| {
        let mut c = Constrained2::from_parts(&task.points, &task.segments)?;
        let refined = refinement.run(&mut c)?;
        Ok::<_, delone::Error>((c, refined))
    });
    let (c, refined) = result.map_err(|error| error.to_string())?;
    let report = &refined.report;
    let steiner = report.inside + report.on_constraints;
    if steiner + task.points.len() != c.vertex_count() {
        return Err(format!(
            "reports {steiner} new vertices and has {}",
            c.vertex_count() - task.points.len()
        ));
    }
    let left = Some(report.left.len());
    let mesh = move || {
        let inside = c.triangle_ids().filter(|&t| refined.domains.is_inside(t));
        let triangles: Vec<_> = inside.map(|t| c.mesh().corners(t).map(|v| v.index())).collect();
        assert_eq!(triangles.len(), refined.report.triangles, "the report is wrong");
        Mesh { points: c.vertices().map(|v| c.point(v)).collect(), triangles }
    };
    Ok(Refined { time, left, mesh: Box::new(mesh) })
}

/// Up to so many Steiner points for each point; its own default is 10.
const BUDGET: usize = 20;

/// Inside is what an odd number of segments surrounds, or all; where segments do not close, or have the inside on both
/// sides, its rule may find nothing.
fn spade(task: &Task) -> Result<Refined, String> {
    use spade::{
        AngleLimit, ConstrainedDelaunayTriangulation, Point2, RefinementParameters, Triangulation as _,
    };
    let points: Vec<Point2<f64>> = task.points.iter().map(|p| Point2::new(p[0], p[1])).collect();
    let segments = task.segments.clone();
    let parameters = RefinementParameters::<f64>::new()
        .with_angle_limit(AngleLimit::from_deg(task.angle))
        .exclude_outer_faces(!task.is_hull)
        .with_max_additional_vertices(BUDGET * points.len() + 10_000);
    let (time, result) = timed(|| {
        let mut d = ConstrainedDelaunayTriangulation::<Point2<f64>>::bulk_load_cdt(points, segments)?;
        let result = d.refine(parameters);
        Ok::<_, spade::InsertionError>((d, result))
    });
    let (d, result) = result.map_err(|error| format!("{error:?}"))?;
    if !result.refinement_complete {
        return Err(format!("is not done after {} points", d.num_vertices() - task.points.len()));
    }
    if result.excluded_faces.len() == d.num_inner_faces() {
        return Err("(its rule finds nothing inside)".to_owned());
    }
    let mesh = move || {
        let mut is_excluded = vec![false; d.num_all_faces()];
        result.excluded_faces.iter().for_each(|face| is_excluded[face.index()] = true);
        let faces = d.inner_faces().filter(|face| !is_excluded[face.fix().index()]);
        Mesh {
            points: d.vertices().map(|v| [v.position().x, v.position().y]).collect(),
            triangles: faces.map(|face| face.vertices().map(|v| v.fix().index())).collect(),
        }
    };
    Ok(Refined { time, left: None, mesh: Box::new(mesh) })
}

#[cfg(cgal)]
mod cgal {
    use std::ffi::c_void;
    use std::ptr::NonNull;
    use std::time::Duration;

    use super::super::judge::{Mesh, least_square_of_sine};
    use super::{Refined, Task};

    unsafe extern "C" {
        fn cgal_mesh(
            xy: *const f64,
            n: usize,
            ends: *const u32,
            m: usize,
            holes: *const f64,
            h: usize,
            bound: f64,
            seconds: *mut f64,
        ) -> *mut c_void;
        fn cgal_mesh_sizes(mesh: *const c_void, vertices: *mut usize, triangles: *mut usize);
        fn cgal_mesh_copy(mesh: *const c_void, xy: *mut f64, triangles: *mut u32);
        fn cgal_mesh_free(mesh: *mut c_void);
    }

    /// Is CGAL's.
    struct Handle(NonNull<c_void>);

    impl Drop for Handle {
        fn drop(&mut self) {
            // SAFETY: made by `cgal_mesh`, and nobody else frees it.
            unsafe { cgal_mesh_free(self.0.as_ptr()) }
        }
    }

    impl Handle {
        fn mesh(&self) -> Mesh {
            let (mut vertices, mut count) = (0, 0);
            // SAFETY: the mesh lives, and two numbers are written.
            unsafe { cgal_mesh_sizes(self.0.as_ptr(), &raw mut vertices, &raw mut count) };
            let mut points = vec![[0.0; 2]; vertices];
            let mut triangles = vec![[0_u32; 3]; count];
            // SAFETY: there is room for as many as it has just counted.
            unsafe {
                let (xy, corners) = (points.as_mut_ptr().cast(), triangles.as_mut_ptr().cast());
                cgal_mesh_copy(self.0.as_ptr(), xy, corners);
            }
            Mesh { points, triangles: triangles.into_iter().map(|t| t.map(|i| i as usize)).collect() }
        }
    }

    pub fn run(task: &Task) -> Result<Refined, String> {
        let ends: Vec<[u32; 2]> = task.segments.iter().map(|ends| ends.map(|i| i as u32)).collect();
        let mut seconds = 0.0;
        // SAFETY: the shim reads as many numbers as said, and writes one.
        let handle = unsafe {
            cgal_mesh(
                task.points.as_ptr().cast(),
                task.points.len(),
                ends.as_ptr().cast(),
                ends.len(),
                task.holes.as_ptr().cast(),
                task.holes.len(),
                least_square_of_sine(task.angle),
                &raw mut seconds,
            )
        };
        let handle = Handle(NonNull::new(handle).ok_or("an exception")?);
        let time = Duration::from_secs_f64(seconds);
        Ok(Refined { time, left: None, mesh: Box::new(move || handle.mesh()) })
    }
}
