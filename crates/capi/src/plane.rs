//! Triangulations of the plane: what a handle holds, building it, freeing it.

use std::borrow::Cow;
use std::sync::OnceLock;

use delone::MAX_POINTS;
use delone::{Constrained2, Crossings, Delaunay2, Mesh2, Refined2, Regular2, TriangleId};

use crate::failure::{CError, Failure, guard};
use crate::memory;
use crate::points::{CPoints, clear, give, list, read};
use crate::run::run;

/// The flag of `delone.h` for crossings that get a vertex.
pub(crate) const SPLIT_CROSSINGS: u32 = 1;

/// `delone_tri2`.
pub(crate) struct Tri2 {
    pub(crate) kind: Kind,
    rows: OnceLock<Rows>,
}

/// A triangulation.
pub(crate) enum Kind {
    Plain(Delaunay2),
    Constrained(Constrained2),
    /// With what is inside, and what is not as wanted.
    Mesh(Constrained2, Box<Refined2>),
    /// With all points, those of hidden sites, too.
    Regular(Regular2, Vec<[f64; 2]>),
}

/// The triangles that callers see, in their order.
pub(crate) struct Rows {
    pub(crate) triangles: Vec<TriangleId>,
    /// The row of each triangle by its slot, or -1.
    of: Vec<i32>,
}

impl Rows {
    /// The row of a triangle, -1 for one outside.
    pub(crate) fn of(&self, t: TriangleId) -> i32 {
        self.of.get(t.index()).copied().unwrap_or(-1)
    }
}

impl Tri2 {
    pub(crate) fn new(kind: Kind) -> Self {
        Self { kind, rows: OnceLock::new() }
    }

    pub(crate) fn mesh(&self) -> &Mesh2 {
        match &self.kind {
            Kind::Plain(d) => d.mesh(),
            Kind::Constrained(c) | Kind::Mesh(c, _) => c.mesh(),
            Kind::Regular(r, _) => r.mesh(),
        }
    }

    pub(crate) fn points(&self) -> &[[f64; 2]] {
        match &self.kind {
            Kind::Plain(d) => d.points(),
            Kind::Constrained(c) | Kind::Mesh(c, _) => c.points(),
            Kind::Regular(_, points) => points,
        }
    }

    pub(crate) fn rows(&self) -> &Rows {
        self.rows.get_or_init(|| {
            let mesh = self.mesh();
            let is_inside = |t: &TriangleId| match &self.kind {
                Kind::Mesh(_, refined) => refined.domains.is_inside(*t),
                _ => true,
            };
            let triangles: Vec<TriangleId> = mesh.triangles().filter(is_inside).collect();
            let mut of = vec![-1; mesh.slot_count()];
            triangles.iter().zip(0..).for_each(|(t, row)| of[t.index()] = row);
            Rows { triangles, of }
        })
    }

    /// To be called before a change.
    pub(crate) fn forget_rows(&mut self) {
        self.rows = OnceLock::new();
    }
}

/// Handles are asked by several threads at once.
const _: fn() = || {
    fn is_shared<T: Send + Sync>() {}
    is_shared::<Tri2>();
};

/// Points, and segments between them by index.
type Parts<'a> = (Cow<'a, [[f64; 2]]>, Vec<[usize; 2]>);

/// Points and segments of the caller.
///
/// # Safety
/// As `read` and `list`.
pub(crate) unsafe fn graph<'a>(
    points: *const CPoints,
    segments: *const u32,
    count: usize,
) -> Result<Parts<'a>, Failure> {
    // SAFETY: promised by the caller.
    let (points, ends) =
        unsafe { (read::<2>(points, MAX_POINTS)?, list(segments.cast::<[u32; 2]>(), count, "segments")?) };
    memory::check(points.len() + 2 * count, memory::PLANE_BYTES)?;
    Ok((points, ends.iter().map(|ends| ends.map(|end| end as usize)).collect()))
}

/// The rule for crossings by flags; others are an error.
pub(crate) fn crossings(flags: u32) -> Result<Crossings, Failure> {
    match flags {
        0 => Ok(Crossings::Refuse),
        SPLIT_CROSSINGS => Ok(Crossings::Split),
        other => Err(Failure::argument(format!("flags: {other} has bits of no flag"))),
    }
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_new(
    points: *const CPoints,
    out: *mut *mut Tri2,
    error: *mut CError,
) -> i32 {
    guard(error, || {
        // SAFETY: `delone.h` promises points, and room for the handle.
        unsafe {
            clear(out)?;
            let points = read::<2>(points, MAX_POINTS)?;
            memory::check(points.len(), memory::PLANE_BYTES)?;
            let points = points.into_owned();
            give(out, run(|| Ok(Tri2::new(Kind::Plain(Delaunay2::from_vec(points)?)))))
        }
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_constrained2_new(
    points: *const CPoints,
    segments: *const u32,
    segment_count: usize,
    flags: u32,
    out: *mut *mut Tri2,
    error: *mut CError,
) -> i32 {
    guard(error, || {
        // SAFETY: `delone.h` promises points, pairs of indices, and room for the handle.
        unsafe {
            clear(out)?;
            let crossings = crossings(flags)?;
            let (points, segments) = graph(points, segments, segment_count)?;
            give(
                out,
                run(|| {
                    let c = Constrained2::with_crossings(&points, &segments, crossings)?;
                    Ok(Tri2::new(Kind::Constrained(c)))
                }),
            )
        }
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_regular2_new(
    points: *const CPoints,
    weights: *const f64,
    out: *mut *mut Tri2,
    error: *mut CError,
) -> i32 {
    guard(error, || {
        // SAFETY: `delone.h` promises points, a weight for each, and room for the handle.
        unsafe {
            clear(out)?;
            let points = read::<2>(points, MAX_POINTS)?;
            let weights = list(weights, points.len(), "weights")?;
            memory::check(points.len(), memory::PLANE_BYTES)?;
            let points = points.into_owned();
            give(
                out,
                run(|| {
                    let r = Regular2::from_parts(&points, weights)?;
                    Ok(Tri2::new(Kind::Regular(r, points)))
                }),
            )
        }
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_free(t: *mut Tri2) {
    if !t.is_null() {
        // SAFETY: `delone.h` promises a handle of this library that was not freed.
        drop(unsafe { Box::from_raw(t) });
    }
}
