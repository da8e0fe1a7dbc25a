//! Insertion and removal.

use delone::MAX_POINTS;
use delone::VertexId;

use crate::failure::{CError, Failure, Status, guard};
use crate::plane::{Kind, Tri2};
use crate::points::{CPoints, list, read, write};

/// The handle that is to be changed.
///
/// # Safety
/// The pointer is NULL or that of a handle that no other thread uses.
unsafe fn changing<'a>(t: *mut Tri2) -> Result<&'a mut Tri2, Failure> {
    // SAFETY: promised by the caller.
    let t = unsafe { t.as_mut() }.ok_or_else(|| Failure::argument("the handle is NULL"))?;
    match t.kind {
        Kind::Plain(_) | Kind::Constrained(_) => {
            t.forget_rows();
            Ok(t)
        }
        Kind::Mesh(..) => Err(Failure::argument("meshes stay as they are")),
        Kind::Regular(..) => Err(Failure::argument("triangulations with weights stay as they are")),
    }
}

impl Tri2 {
    /// Whether segments meet at a vertex.
    fn has_segment(&self, v: VertexId) -> bool {
        match &self.kind {
            Kind::Constrained(c) | Kind::Mesh(c, _) => c.mesh().star(v).any(|e| c.is_constraint(e)),
            Kind::Plain(_) | Kind::Regular(..) => false,
        }
    }
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_insert(
    t: *mut Tri2,
    points: *const CPoints,
    ids: *mut u32,
    error: *mut CError,
) -> i32 {
    guard(error, || {
        // SAFETY: `delone.h` promises a handle that no other thread uses, points, and room for a number each.
        unsafe {
            // A copy: they may be those of the handle itself.
            let points = read::<2>(points, MAX_POINTS)?.into_owned();
            let t = changing(t)?;
            crate::queries::finite(&points)?;
            for (row, &point) in points.iter().enumerate() {
                let inserted = match &mut t.kind {
                    Kind::Plain(d) => d.insert(point),
                    Kind::Constrained(c) | Kind::Mesh(c, _) => c.insert(point),
                    Kind::Regular(..) => return Err(Failure::argument("it has weights")),
                };
                let v = inserted.map_err(|error| Failure::from(error).at(row))?.vertex();
                if !ids.is_null() {
                    write(ids.add(row), std::iter::once(v.index() as u32));
                }
            }
        }
        Ok(())
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_remove(
    t: *mut Tri2,
    vertices: *const u32,
    count: usize,
    error: *mut CError,
) -> i32 {
    guard(error, || {
        // SAFETY: `delone.h` promises a handle that no other thread uses, and numbers.
        unsafe {
            let (vertices, t) = (list(vertices, count, "vertices")?, changing(t)?);
            // All or none: a vertex that is none, or there twice, is refused before any goes.
            let mut seen = std::collections::BTreeSet::new();
            for (row, &v) in vertices.iter().enumerate() {
                if t.has_segment(VertexId::new(v as usize)) {
                    return Err(
                        Failure::argument(format!("a segment ends at vertex {v}, or bends there")).at(row)
                    );
                }
                if !t.mesh().contains(VertexId::new(v as usize)) || !seen.insert(v) {
                    return Err(
                        Failure::new(Status::Index, format!("{v} is no vertex, or is there twice")).at(row)
                    );
                }
            }
            for (row, &v) in vertices.iter().enumerate() {
                let v = VertexId::new(v as usize);
                let removed = match &mut t.kind {
                    Kind::Plain(d) => d.remove(v),
                    Kind::Constrained(c) | Kind::Mesh(c, _) => c.remove(v),
                    Kind::Regular(..) => return Err(Failure::argument("it has weights")),
                };
                removed.map_err(|error| Failure::from(error).at(row))?;
            }
        }
        Ok(())
    })
}
