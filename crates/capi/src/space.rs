//! Triangulations of space.

use delone::surface::Interpolator;
use delone::{Delaunay3, Error, Location3, MAX_POINTS_IN_SPACE, TetrahedronId, Triangulation, VertexId};

use crate::failure::{CError, Failure, Status, guard};
use crate::memory;
use crate::points::{CPoints, clear, give, handle, list, read, write};
use crate::queries::{
    LAPLACE, LINEAR, NEAREST, Places, SIBSON, each_task, finite, locate, nearest, table, values,
};
use crate::rows::{CCounts, fill, number};
use crate::run::run;

/// `delone_tri3`.
pub(crate) struct Tri3 {
    d: Delaunay3,
    /// How many points were given.
    points: usize,
    tetrahedra: Vec<TetrahedronId>,
    /// The row of each tetrahedron by its slot, or -1.
    rows: Vec<i32>,
}

impl Tri3 {
    fn new(points: Vec<[f64; 3]>) -> Result<Self, Error> {
        let count = points.len();
        let d = Delaunay3::from_vec(points)?;
        let tetrahedra: Vec<TetrahedronId> = d.tetrahedron_ids().collect();
        let mut rows = vec![-1; d.slot_count()];
        tetrahedra.iter().zip(0..).for_each(|(&t, row)| rows[d.index(t)] = row);
        Ok(Self { d, points: count, tetrahedra, rows })
    }

    fn row(&self, t: TetrahedronId) -> i32 {
        self.rows.get(self.d.index(t)).copied().unwrap_or(-1)
    }
}

impl Places<3> for Tri3 {
    const MOST_POINTS: usize = MAX_POINTS_IN_SPACE;

    fn count(&self) -> usize {
        self.points
    }

    fn k_nearest(&self, place: [f64; 3], k: usize) -> Result<Vec<VertexId>, Error> {
        self.d.k_nearest(place, k)
    }

    fn row_at(&self, place: [f64; 3]) -> Result<i64, Error> {
        let around = |vertices: &[VertexId]| {
            let all = vertices.first().map(|&v| self.d.tetrahedra_at(v)).unwrap_or_default();
            all.into_iter().find(|&t| {
                let corners = self.d.mesh().corners(t);
                self.row(t) >= 0 && vertices.iter().all(|v| corners.contains(v))
            })
        };
        let found = match self.d.locate(place)? {
            Location3::Tetrahedron(t) => Some(t),
            Location3::Facet(f) => around(&self.d.mesh().facet_corners(f)),
            Location3::Edge(ends) => around(&ends),
            Location3::Vertex(v) => around(&[v]),
            _ => None,
        };
        Ok(found.map_or(-1, |t| i64::from(self.row(t))))
    }
}

/// Handles are asked by several threads at once.
const _: fn() = || {
    fn is_shared<T: Send + Sync>() {}
    is_shared::<Tri3>();
};

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri3_new(
    points: *const CPoints,
    out: *mut *mut Tri3,
    error: *mut CError,
) -> i32 {
    guard(error, || {
        // SAFETY: `delone.h` promises points, and room for the handle.
        unsafe {
            clear(out)?;
            let points = read::<3>(points, MAX_POINTS_IN_SPACE)?;
            memory::check(points.len(), memory::SPACE_BYTES)?;
            let points = points.into_owned();
            give(out, run(points.len(), || Ok(Tri3::new(points)?)))
        }
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri3_free(t: *mut Tri3) {
    if !t.is_null() {
        // SAFETY: `delone.h` promises a handle of this library that was not freed.
        drop(unsafe { Box::from_raw(t) });
    }
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri3_counts(t: *const Tri3, counts: *mut CCounts) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle and a struct.
        unsafe {
            let t = handle(t)?;
            let made = CCounts {
                dimension: number(t.d.dimension()),
                points: t.points,
                vertices: t.d.vertex_count(),
                simplices: t.tetrahedra.len(),
                hull: t.d.hull_facets().count(),
                duplicates: t.d.duplicates().count(),
                ..CCounts::none()
            };
            fill(counts, made)
        }
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri3_tetrahedra(
    t: *const Tri3,
    corners: *mut u32,
    neighbors: *mut i32,
) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle, and room for four numbers a tetrahedron each.
        unsafe {
            let t = handle(t)?;
            let of = t.tetrahedra.iter();
            write(corners, of.clone().flat_map(|&s| t.d.mesh().corners(s)).map(|v| v.index() as u32));
            let across = |s: TetrahedronId| [0, 1, 2, 3].map(|k| t.d.across(s, k).map_or(-1, |s| t.row(s)));
            write(neighbors, of.flat_map(|&s| across(s)));
        }
        Ok(())
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri3_hull(t: *const Tri3, corners: *mut u32) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle, and room for three numbers a triangle.
        unsafe {
            let t = handle(t)?;
            write(corners, t.d.hull_facets().flatten().map(|v| v.index() as u32));
        }
        Ok(())
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri3_locate(
    t: *const Tri3,
    places: *const CPoints,
    tetrahedra: *mut i64,
    error: *mut CError,
) -> i32 {
    guard(error, || {
        // SAFETY: `delone.h` promises a handle, places, and room for a number each.
        unsafe { locate(t, places, tetrahedra) }
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri3_nearest(
    t: *const Tri3,
    places: *const CPoints,
    k: u32,
    vertices: *mut i64,
    error: *mut CError,
) -> i32 {
    guard(error, || {
        // SAFETY: `delone.h` promises a handle, places, and room for k numbers each.
        unsafe { nearest(t, places, k, vertices) }
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri3_interpolate(
    t: *const Tri3,
    values_of_points: *const f64,
    value_count: usize,
    places: *const CPoints,
    how: i32,
    out: *mut f64,
    error: *mut CError,
) -> i32 {
    guard(error, || {
        // SAFETY: `delone.h` promises a handle, values, places, and room for a number each.
        unsafe {
            let (t, places) = (handle(t)?, read::<3>(places, MAX_POINTS_IN_SPACE)?);
            let table = table(list(values_of_points, value_count, "values")?, t.points)?;
            finite(&places)?;
            let all = each_task(&places, |places| {
                let method = match how {
                    LINEAR => Interpolator::linear(&t.d),
                    NEAREST => Interpolator::nearest(&t.d),
                    LAPLACE => Interpolator::laplace(&t.d),
                    SIBSON => Interpolator::sibson(&t.d),
                    other => return Err(Failure::argument(format!("how: {other} is no method"))),
                };
                values(method, table, places)
            })?;
            write(out, all.into_iter());
        }
        Ok(())
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri3_check(t: *const Tri3, error: *mut CError) -> i32 {
    guard(error, || {
        // SAFETY: `delone.h` promises a handle.
        let t = unsafe { handle(t)? };
        t.d.check().map_err(|flaw| Failure::new(Status::Bug, flaw.to_string()))
    })
}
