//! Many places at once: the triangles that they are in, the vertices that are nearest, values.

use delone::MAX_POINTS;
use delone::surface::Interpolator;
use delone::{Ask, Constrained2, Delaunay2, Error, Location2, TriangleId, VertexId};

use crate::failure::{CError, Failure, Status, guard};
use crate::memory;
use crate::plane::{Kind, Tri2};
use crate::points::{CPoints, handle, list, read, write};
use crate::run::run;

/// Places of a task: each one takes less than a microsecond mostly, and a thread some to wake up.
const TASK_PLACES: usize = 1 << 12;

/// How values come about, as `delone.h` numbers it.
pub(crate) const LINEAR: i32 = 0;
pub(crate) const NEAREST: i32 = 1;
pub(crate) const LAPLACE: i32 = 2;
pub(crate) const SIBSON: i32 = 3;

/// Answers for all places, in tasks of many on the threads of the pool, one after the other in each.
pub(crate) fn each_task<Q: Sync, A: Send>(
    places: &[Q],
    task: impl Fn(&[Q]) -> Result<Vec<A>, Failure> + Sync + Send,
) -> Result<Vec<A>, Failure> {
    // Of no places, too, it is seen whether the rest of the question is right.
    if places.is_empty() {
        return task(places);
    }
    let tasks: Vec<&[Q]> = places.chunks(TASK_PLACES).collect();
    let answers = run(places.len(), || delone_pool::shared(&tasks, 1, |places| task(places)))?;
    Ok(answers.into_iter().flatten().collect())
}

/// Refuses places that are not finite, with their row.
pub(crate) fn finite<const D: usize>(places: &[[f64; D]]) -> Result<(), Failure> {
    match places.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
        Some(row) => {
            let words = format!("place {row} is {:?}: its coordinates must be finite", places[row]);
            Err(Failure::new(Status::NotFinite, words).at(row))
        }
        None => Ok(()),
    }
}

/// A triangulation that is asked about places.
pub(crate) trait Places<const D: usize>: Sync {
    /// How many points there may be at most, and how many there are.
    const MOST_POINTS: usize;
    fn count(&self) -> usize;
    /// The row of a simplex that a place is in, or -1.
    fn row_at(&self, place: [f64; D]) -> Result<i64, Error>;
    fn k_nearest(&self, place: [f64; D], k: usize) -> Result<Vec<VertexId>, Error>;
}

/// Locates places.
///
/// # Safety
/// The handle and the places are right or NULL, and there is room for a number each.
pub(crate) unsafe fn locate<T: Places<D>, const D: usize>(
    t: *const T,
    places: *const CPoints,
    rows: *mut i64,
) -> Result<(), Failure> {
    // SAFETY: promised by the caller.
    unsafe {
        let (t, places) = (handle(t)?, read::<D>(places, T::MOST_POINTS)?);
        finite(&places)?;
        let all = each_task(&places, |places| {
            Ok(places.iter().map(|&p| t.row_at(p)).collect::<Result<_, _>>()?)
        })?;
        write(rows, all.into_iter());
    }
    Ok(())
}

/// Finds the nearest vertices of places.
///
/// # Safety
/// As [`locate`], with room for k numbers each.
pub(crate) unsafe fn nearest<T: Places<D>, const D: usize>(
    t: *const T,
    places: *const CPoints,
    k: u32,
    vertices: *mut i64,
) -> Result<(), Failure> {
    // SAFETY: promised by the caller.
    unsafe {
        let (t, places) = (handle(t)?, read::<D>(places, T::MOST_POINTS)?);
        finite(&places)?;
        let k = k as usize;
        memory::check(places.len(), k.saturating_mul(size_of::<i64>()))?;
        let all = each_task(&places, |places| {
            let mut found = Vec::new();
            for &place in places {
                found.extend(nearest_rows(t.k_nearest(place, k.min(t.count()))?, k));
            }
            Ok(found)
        })?;
        write(vertices, all.into_iter());
    }
    Ok(())
}

/// Rows of the nearest vertices, filled up with -1.
fn nearest_rows(found: Vec<VertexId>, k: usize) -> impl Iterator<Item = i64> {
    let found = found.into_iter().map(|v| v.index() as i64);
    found.chain(std::iter::repeat(-1)).take(k)
}

impl Tri2 {
    fn located(&self, place: [f64; 2]) -> Result<Location2, Error> {
        match &self.kind {
            Kind::Plain(d) => d.locate(place),
            Kind::Constrained(c) | Kind::Mesh(c, _) => c.locate(place),
            Kind::Regular(r, _) => r.locate(place),
        }
    }
}

impl Places<2> for Tri2 {
    const MOST_POINTS: usize = MAX_POINTS;

    fn count(&self) -> usize {
        self.points().len()
    }

    fn row_at(&self, place: [f64; 2]) -> Result<i64, Error> {
        let (mesh, rows) = (self.mesh(), self.rows());
        let first = |of: &mut dyn Iterator<Item = TriangleId>| of.map(|t| rows.of(t)).find(|&row| row >= 0);
        let row = match self.located(place)? {
            Location2::Triangle(t) => first(&mut [t].into_iter()),
            Location2::Edge(e) => first(&mut [e.triangle(), mesh.twin(e).triangle()].into_iter()),
            Location2::Vertex(v) => first(&mut mesh.star(v).map(|e| e.triangle())),
            _ => None,
        };
        Ok(i64::from(row.unwrap_or(-1)))
    }

    fn k_nearest(&self, place: [f64; 2], k: usize) -> Result<Vec<VertexId>, Error> {
        match &self.kind {
            Kind::Plain(d) => d.k_nearest(place, k),
            Kind::Constrained(c) | Kind::Mesh(c, _) => c.k_nearest(place, k),
            Kind::Regular(r, _) => r.k_nearest(place, k),
        }
    }
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_locate(
    t: *const Tri2,
    places: *const CPoints,
    triangles: *mut i64,
    error: *mut CError,
) -> i32 {
    guard(error, || {
        // SAFETY: `delone.h` promises a handle, places, and room for a number each.
        unsafe { locate(t, places, triangles) }
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_nearest(
    t: *const Tri2,
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

/// The values of a caller, one a point.
pub(crate) fn table(values: &[f64], points: usize) -> Result<&[f64], Failure> {
    if values.len() == points {
        return Ok(values);
    }
    Err(Failure::argument(format!("values: there are {}, and {points} points", values.len())))
}

/// Values at places, NaN where there is none.
pub(crate) fn values<T: Ask>(
    mut values: Interpolator<'_, T>,
    table: &[f64],
    places: &[T::Point],
) -> Result<Vec<f64>, Failure>
where
    T::Point: Copy,
{
    let value = |&place: &T::Point| Ok(values.value(place, table)?.unwrap_or(f64::NAN));
    places.iter().map(value).collect()
}

fn of_delaunay(d: &Delaunay2, how: i32) -> Result<Interpolator<'_, Delaunay2>, Failure> {
    match how {
        LINEAR => Ok(Interpolator::linear(d)),
        NEAREST => Ok(Interpolator::nearest(d)),
        LAPLACE => Ok(Interpolator::laplace(d)),
        SIBSON => Ok(Interpolator::sibson(d)),
        other => Err(Failure::argument(format!("how: {other} is no method"))),
    }
}

fn of_constrained(c: &Constrained2, how: i32) -> Result<Interpolator<'_, Constrained2>, Failure> {
    match how {
        LINEAR => Ok(Interpolator::linear_in(c)),
        NEAREST => Ok(Interpolator::nearest(c)),
        other => {
            Err(Failure::argument(format!("how: method {other} is for triangulations without segments")))
        }
    }
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_interpolate(
    t: *const Tri2,
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
            let (t, places) = (handle(t)?, read::<2>(places, MAX_POINTS)?);
            let table = table(list(values_of_points, value_count, "values")?, t.points().len())?;
            finite(&places)?;
            let all = each_task(&places, |places| match &t.kind {
                Kind::Plain(d) => values(of_delaunay(d, how)?, table, places),
                Kind::Constrained(c) => values(of_constrained(c, how)?, table, places),
                Kind::Mesh(c, _) => {
                    let mut all = values(of_constrained(c, how)?, table, places)?;
                    for (value, &place) in all.iter_mut().zip(places) {
                        if t.row_at(place)? < 0 {
                            *value = f64::NAN;
                        }
                    }
                    Ok(all)
                }
                Kind::Regular(..) => Err(Failure::argument("values are for triangulations without weights")),
            })?;
            write(out, all.into_iter());
        }
        Ok(())
    })
}
