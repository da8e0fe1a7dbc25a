//! Counts, points, triangles, edges and stars of a triangulation of the plane.

use delone::{Dimension, EdgeId, Refined2, TriangleId, VertexId};

use crate::failure::{CError, Failure, Status, guard};
use crate::plane::{Kind, Tri2};
use crate::points::{handle, write};

/// `DELONE_NO_VERTEX`.
const NO_VERTEX: u32 = u32::MAX;

/// `delone_counts`.
#[repr(C)]
pub(crate) struct CCounts {
    pub(crate) size: u32,
    pub(crate) dimension: i32,
    pub(crate) points: usize,
    pub(crate) vertices: usize,
    pub(crate) simplices: usize,
    pub(crate) edges: usize,
    pub(crate) hull: usize,
    pub(crate) constraints: usize,
    pub(crate) duplicates: usize,
}

/// Numbers, and how `delone.h` counts dimensions.
pub(crate) fn number(dimension: Dimension) -> i32 {
    match dimension {
        Dimension::Empty => -1,
        Dimension::Point => 0,
        Dimension::Line => 1,
        Dimension::Plane => 2,
        Dimension::Space => 3,
    }
}

/// Fills in the counts of a caller.
///
/// # Safety
/// The pointer is NULL or that of a `delone_counts`.
pub(crate) unsafe fn fill(counts: *mut CCounts, values: CCounts) -> Result<(), Failure> {
    // SAFETY: promised by the caller.
    let counts =
        unsafe { counts.as_mut() }.ok_or_else(|| Failure::argument("counts: the pointer is NULL"))?;
    let size = size_of::<CCounts>() as u32;
    if counts.size < size {
        return Err(Failure::argument(format!("counts: size is {}, not sizeof(delone_counts)", counts.size)));
    }
    *counts = CCounts { size: counts.size, ..values };
    Ok(())
}

impl CCounts {
    pub(crate) fn none() -> Self {
        let (size, dimension) = (0, -1);
        Self {
            size,
            dimension,
            points: 0,
            vertices: 0,
            simplices: 0,
            edges: 0,
            hull: 0,
            constraints: 0,
            duplicates: 0,
        }
    }
}

impl Tri2 {
    /// Whether a triangle is one of those that callers see.
    fn is_inside(&self, e: EdgeId) -> bool {
        self.rows().of(e.triangle()) >= 0
    }

    /// The edges of these triangles; of points on a line those between neighbors. A mesh has those inside.
    fn edges(&self) -> impl Iterator<Item = EdgeId> {
        let mesh = self.mesh();
        let is_mesh = matches!(self.kind, Kind::Mesh(..));
        mesh.undirected_edges()
            .filter(move |&e| !is_mesh || self.is_inside(e) || self.is_inside(mesh.twin(e)))
    }

    /// The edges of the border with what is inside on their left.
    fn hull(&self) -> Vec<EdgeId> {
        let mesh = self.mesh();
        let both = mesh.undirected_edges().flat_map(|e| [e, mesh.twin(e)]);
        both.filter(|&e| self.is_inside(e) && !self.is_inside(mesh.twin(e))).collect()
    }

    /// How many edges there are, and how many of them are on the border: a triangle has three, and two share each that is not.
    fn edge_counts(&self) -> [usize; 2] {
        let (mesh, rows) = (self.mesh(), self.rows());
        if rows.triangles.is_empty() {
            return [self.edges().count(), 0];
        }
        let open = |&t: &TriangleId| mesh.adjacent(t).into_iter().filter(|&t| rows.of(t) < 0).count();
        let border: usize = rows.triangles.iter().map(open).sum();
        [usize::midpoint(3 * rows.triangles.len(), border), border]
    }

    fn is_constraint(&self, e: EdgeId) -> bool {
        match &self.kind {
            Kind::Constrained(c) | Kind::Mesh(c, _) => c.is_constraint(e),
            Kind::Plain(_) | Kind::Regular(..) => false,
        }
    }

    fn duplicates(&self) -> Vec<(usize, VertexId)> {
        let pair = |duplicate: delone::Duplicate| (duplicate.point, duplicate.vertex);
        match &self.kind {
            Kind::Plain(d) => d.duplicates().map(pair).collect(),
            Kind::Constrained(c) | Kind::Mesh(c, _) => c.duplicates().map(pair).collect(),
            Kind::Regular(r, _) => r.duplicates().map(pair).collect(),
        }
    }

    fn ends(&self, e: EdgeId) -> [u32; 2] {
        [self.mesh().origin(e), self.mesh().destination(e)].map(|v| v.index() as u32)
    }

    /// The neighbors of a vertex along edges that callers see.
    fn star(&self, v: VertexId) -> impl Iterator<Item = u32> {
        let mesh = self.mesh();
        let is_mesh = matches!(self.kind, Kind::Mesh(..));
        let seen = move |e: &EdgeId| {
            !mesh.destination(*e).is_ghost()
                && (!is_mesh || self.is_inside(*e) || self.is_inside(mesh.twin(*e)))
        };
        mesh.star(v).filter(seen).map(move |e| mesh.destination(e).index() as u32)
    }
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_counts(t: *const Tri2, counts: *mut CCounts) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle and a struct.
        let t = unsafe { handle(t)? };
        let [edges, hull] = t.edge_counts();
        let constraints = match t.kind {
            Kind::Constrained(_) | Kind::Mesh(..) => t.edges().filter(|&e| t.is_constraint(e)).count(),
            Kind::Plain(_) | Kind::Regular(..) => 0,
        };
        let made = CCounts {
            dimension: number(t.mesh().dimension()),
            points: t.points().len(),
            vertices: t.mesh().vertex_count(),
            simplices: t.rows().triangles.len(),
            edges,
            hull,
            constraints,
            duplicates: t.duplicates().len(),
            ..CCounts::none()
        };
        // SAFETY: as above.
        unsafe { fill(counts, made) }
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_points(t: *const Tri2, count: *mut usize) -> *const f64 {
    // SAFETY: `delone.h` promises a handle.
    let points = unsafe { t.as_ref() }.map_or(&[][..], Tri2::points);
    // SAFETY: a pointer that is not NULL is that of a number.
    unsafe { write(count, std::iter::once(points.len())) };
    if t.is_null() { std::ptr::null() } else { points.as_ptr().cast() }
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_triangles(
    t: *const Tri2,
    corners: *mut u32,
    neighbors: *mut i32,
) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle.
        let t = unsafe { handle(t)? };
        let (mesh, rows) = (t.mesh(), t.rows());
        let of = rows.triangles.iter();
        let corner = of.clone().flat_map(|&t| mesh.corners(t)).map(|v| v.index() as u32);
        // The edge across from a corner follows the one that leaves it.
        let across = of.flat_map(|&t| [1, 2, 0].map(|k| mesh.adjacent(t)[k])).map(|t| rows.of(t));
        // SAFETY: `delone.h` promises room for three numbers a triangle each.
        unsafe {
            write(corners, corner);
            write(neighbors, across);
        }
        Ok(())
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_edges(
    t: *const Tri2,
    ends: *mut u32,
    is_constraint: *mut u8,
) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle, and room for all edges.
        unsafe {
            let t = handle(t)?;
            write(ends, t.edges().flat_map(|e| t.ends(e)));
            write(is_constraint, t.edges().map(|e| u8::from(t.is_constraint(e))));
        }
        Ok(())
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_hull(t: *const Tri2, ends: *mut u32) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle, and room for all edges of the hull.
        unsafe {
            let t = handle(t)?;
            write(ends, t.hull().into_iter().flat_map(|e| t.ends(e)));
        }
        Ok(())
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_stars(
    t: *const Tri2,
    starts: *mut usize,
    neighbors: *mut u32,
) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle, and room for a number a point and one more, and for two an edge.
        unsafe {
            let t = handle(t)?;
            let vertices = || (0..t.points().len()).map(VertexId::new);
            let mut next = 0;
            let ends = vertices().map(|v| {
                next += t.star(v).count();
                next
            });
            write(starts, std::iter::once(0).chain(ends));
            write(neighbors, vertices().flat_map(|v| t.star(v)));
        }
        Ok(())
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_regions(t: *const Tri2, regions: *mut i32) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle, and room for a number a triangle.
        unsafe {
            let t = handle(t)?;
            let refined = mesh(t)?;
            let region = |row: &TriangleId| refined.domains.region(*row).map_or(-1, |region| region as i32);
            write(regions, t.rows().triangles.iter().map(region));
        }
        Ok(())
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_left(t: *const Tri2, count: *mut usize) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle, and room for a number.
        unsafe { write(count, std::iter::once(mesh(handle(t)?)?.report.left.len())) };
        Ok(())
    })
}

/// A mesh, and no other triangulation.
fn mesh(t: &Tri2) -> Result<&Refined2, Failure> {
    match &t.kind {
        Kind::Mesh(_, refined) => Ok(refined),
        _ => Err(Failure::new(Status::Dimension, "it is no mesh")),
    }
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_vertices(t: *const Tri2, vertices: *mut u32) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle, and room for a number a point.
        unsafe {
            let t = handle(t)?;
            let own = |v: u32| if t.mesh().contains(VertexId::new(v as usize)) { v } else { NO_VERTEX };
            let mut of: Vec<u32> = (0..t.points().len() as u32).map(own).collect();
            t.duplicates().into_iter().for_each(|(point, vertex)| of[point] = vertex.index() as u32);
            write(vertices, of.into_iter());
        }
        Ok(())
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_check(t: *const Tri2, error: *mut CError) -> i32 {
    guard(error, || {
        // SAFETY: `delone.h` promises a handle.
        let t = unsafe { handle(t)? };
        let flaw = match &t.kind {
            Kind::Plain(d) => d.check().err().map(|flaw| flaw.to_string()),
            Kind::Constrained(c) | Kind::Mesh(c, _) => c.check().err().map(|flaw| flaw.to_string()),
            Kind::Regular(r, _) => r.check().err().map(|flaw| flaw.to_string()),
        };
        flaw.map_or(Ok(()), |flaw| Err(Failure::new(Status::Bug, flaw)))
    })
}
