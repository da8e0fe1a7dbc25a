//! Meshes: the wishes of a caller, and callbacks on its thread.

use std::cell::Cell;
use std::ffi::c_void;

use delone::{Constrained2, Error, Fill, Keep, Refined2, Refinement, RegionSeed2, Seeds2};

use crate::failure::{CError, Failure, Status, guard};
use crate::plane::{Kind, Tri2, crossings, graph};
use crate::points::{CPoints, clear, give, list};
use crate::run::run;

/// `delone_region`.
#[repr(C)]
#[derive(Clone, Copy)]
struct CRegion {
    at: [f64; 2],
    attribute: f64,
    max_area: f64,
}

/// `delone_mesh_options`.
#[repr(C)]
#[derive(Clone, Copy)]
pub(crate) struct COptions {
    size: u32,
    flags: u32,
    fill: i32,
    keep: i32,
    min_angle: f64,
    max_area: f64,
    max_edge: f64,
    min_edge: f64,
    max_vertices: usize,
    holes: *const f64,
    hole_count: usize,
    regions: *const CRegion,
    region_count: usize,
    user: *mut c_void,
    area_at: Option<unsafe extern "C" fn(*mut c_void, f64, f64) -> f64>,
    unsuitable: Option<unsafe extern "C" fn(*mut c_void, *const f64, f64) -> i32>,
    progress: Option<unsafe extern "C" fn(*mut c_void, u64) -> i32>,
}

impl COptions {
    /// No wish.
    const NONE: Self = Self {
        size: size_of::<Self>() as u32,
        flags: 0,
        fill: 0,
        keep: 0,
        min_angle: 0.0,
        max_area: 0.0,
        max_edge: 0.0,
        min_edge: 0.0,
        max_vertices: 0,
        holes: std::ptr::null(),
        hole_count: 0,
        regions: std::ptr::null(),
        region_count: 0,
        user: std::ptr::null_mut(),
        area_at: None,
        unsuitable: None,
        progress: None,
    };

    /// Wishes that are numbers.
    fn refinement<'a>(&self) -> Result<Refinement<'a>, Failure> {
        let keep = match self.keep {
            0 => Keep::Nothing,
            1 => Keep::Border,
            2 => Keep::Constraints,
            other => return Err(Failure::argument(format!("keep: {other} is none"))),
        };
        let mut how = Refinement::new().min_angle(self.min_angle).keep(keep);
        let wish = |value: f64| value != 0.0;
        if wish(self.max_area) {
            how = how.max_area(self.max_area);
        }
        if wish(self.max_edge) {
            how = how.max_edge(self.max_edge);
        }
        if wish(self.min_edge) {
            how = how.min_edge(self.min_edge);
        }
        if self.max_vertices > 0 {
            how = how.max_vertices(self.max_vertices);
        }
        Ok(how)
    }

    /// Points in holes and regions.
    ///
    /// # Safety
    /// The pointers are those of so many holes and regions.
    unsafe fn seeds(&self) -> Result<Seeds2, Failure> {
        // SAFETY: promised by the caller.
        let (holes, regions) = unsafe {
            let holes = list(self.holes.cast::<[f64; 2]>(), self.hole_count, "holes")?;
            (holes, list(self.regions, self.region_count, "regions")?)
        };
        let is_finite = |p: &[f64; 2]| p.iter().all(|x| x.is_finite());
        let wrong = |what: &str, row: usize| {
            Failure::new(Status::NotFinite, format!("{what} {row}: its point must be finite")).at(row)
        };
        if let Some(row) = holes.iter().position(|hole| !is_finite(hole)) {
            return Err(wrong("hole", row));
        }
        if let Some(row) = regions.iter().position(|region| !is_finite(&region.at)) {
            return Err(wrong("region", row));
        }
        let seed = |region: &CRegion| {
            let max_area = (region.max_area != 0.0).then_some(region.max_area);
            RegionSeed2::new(region.at).attribute(region.attribute).max_area(max_area)
        };
        Ok(Seeds2::default().holes(holes.to_vec()).regions(regions.iter().map(seed).collect()))
    }
}

/// The options behind a pointer; those of an older program are shorter.
///
/// # Safety
/// The pointer is NULL or that of options of the size that they tell.
unsafe fn options(given: *const COptions) -> Result<COptions, Failure> {
    let mut all = COptions::NONE;
    if given.is_null() {
        return Ok(all);
    }
    // SAFETY: promised by the caller: at least the size is there.
    let size = unsafe { given.cast::<u32>().read() } as usize;
    let least = std::mem::offset_of!(COptions, min_angle);
    if size < least || size > size_of::<COptions>() {
        return Err(Failure::argument(format!("options: size is {size}, not sizeof(delone_mesh_options)")));
    }
    // SAFETY: both are options, of which so many bytes are there. Bytes of 0 are a NULL pointer, and no wish.
    unsafe { std::ptr::copy_nonoverlapping(given.cast::<u8>(), (&raw mut all).cast::<u8>(), size) };
    Ok(all)
}

/// Work that stays on the thread that it was made on.
struct Here<W>(W);

// SAFETY: `delone_pool::alone` does the work on the thread that calls it.
unsafe impl<W> Send for Here<W> {}

impl<W> Here<W> {
    fn into_inner(self) -> W {
        self.0
    }
}

/// Refines on the thread of the caller, where its callbacks may be called.
///
/// # Safety
/// The pointers in the options are right, and the callbacks return.
unsafe fn refine(c: &mut Constrained2, options: &COptions) -> Result<Refined2, Failure> {
    // SAFETY: promised by the caller.
    let seeds = unsafe { options.seeds()? };
    let fill = match options.fill {
        0 => Fill::All,
        1 => Fill::EvenOdd,
        2 => Fill::NonZero,
        3 => Fill::Seeds(&seeds),
        other => return Err(Failure::argument(format!("fill: {other} is none"))),
    };
    let is_stopped = Cell::new(false);
    let watch = |vertices: usize| {
        if let Some(progress) = options.progress {
            // SAFETY: promised by the caller.
            let stops = unsafe { progress(options.user, vertices as u64) } != 0;
            is_stopped.set(is_stopped.get() || stops);
        }
    };
    let stop = || is_stopped.get();
    // SAFETY: promised by the caller.
    let area =
        |[x, y]: [f64; 2]| options.area_at.map_or(f64::INFINITY, |area| unsafe { area(options.user, x, y) });
    let unsuitable = |corners: [[f64; 2]; 3], area: f64| {
        let test = |test: unsafe extern "C" fn(*mut c_void, *const f64, f64) -> i32| {
            // SAFETY: promised by the caller.
            unsafe { test(options.user, corners.as_ptr().cast(), area) != 0 }
        };
        options.unsuitable.is_some_and(test)
    };
    let mut how = options.refinement()?.fill(fill).watch(&watch).stop_if(&stop);
    if options.area_at.is_some() {
        how = how.max_area_at(&area);
    }
    if options.unsuitable.is_some() {
        how = how.refine_if(&unsuitable);
    }
    let work = Here(|| how.run(c));
    let refined: Result<Refined2, Error> = delone_pool::alone(move || work.into_inner()());
    Ok(refined?)
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_mesh2_new(
    points: *const CPoints,
    segments: *const u32,
    segment_count: usize,
    given: *const COptions,
    out: *mut *mut Tri2,
    error: *mut CError,
) -> i32 {
    guard(error, || {
        // SAFETY: `delone.h` promises points, pairs of indices, options, callbacks that return, and room for the handle.
        unsafe {
            clear(out)?;
            let options = options(given)?;
            let crossings = crossings(options.flags)?;
            let (points, segments) = graph(points, segments, segment_count)?;
            let mut c = run(points.len(), || Constrained2::with_crossings(&points, &segments, crossings))?;
            let refined = refine(&mut c, &options)?;
            give(out, Ok(Tri2::new(Kind::Mesh(c, Box::new(refined)))))
        }
    })
}
