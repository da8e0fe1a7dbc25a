//! Switch v: the Voronoi diagram, as the dual of the triangles.
//!
//! Each triangle has a vertex of the diagram, its circumcenter, correctly rounded. Each edge has one of the diagram, in the order of edges: from
//! the triangle with the least row to the other one, or a ray, which has -1 there and a direction.

#![allow(unsafe_code, reason = "results are lists of C")]

use std::ffi::c_int;

use delone_predicates::circumcenter;

use crate::edges::nothing;
use crate::fault::Fault;
use crate::layout::TriangulateIo;
use crate::memory::{Fresh, copy, fill};
use crate::output::Output;
use crate::values::weights;

/// Writes the lists of the diagram.
///
/// # Safety
/// As [`Output::write`].
pub(crate) unsafe fn write(o: &Output, vorout: *mut TriangulateIo, fresh: &mut Fresh) -> Result<(), Fault> {
    let built = o.built;
    let rows = &built.triangles;
    // A center that is too far away for a number.
    let far = [f64::INFINITY; 2];
    let center = |row: usize| {
        let [a, b, c] = built.places(row);
        circumcenter(a, b, c).unwrap_or(far)
    };
    let list = |name| format!("{name} of vorout");
    // SAFETY: as the caller says, for all rooms.
    unsafe {
        let to = fresh.room::<_, [f64; 2]>(&raw mut (*vorout).pointlist, rows.len(), &list("pointlist"))?;
        fill(to, rows, |row, _| center(row));
        if o.attribute_count > 0 {
            let count = rows.len().saturating_mul(o.attribute_count);
            let to = fresh.room::<_, f64>(
                &raw mut (*vorout).pointattributelist,
                count,
                &list("pointattributelist"),
            )?;
            let mut values = Vec::new();
            values.try_reserve_exact(count)?;
            for row in 0..rows.len() {
                let (weights, corners) = (weights(built.places(row), center(row)), built.corners(row));
                let value = |k: usize| (0..3).map(|j| weights[j] * o.values(corners[j])[k]).sum::<f64>();
                values.extend((0..o.attribute_count).map(value));
            }
            copy(to, &values);
        }
        let count = built.edge_count();
        let to = fresh.room::<_, [c_int; 2]>(&raw mut (*vorout).edgelist, count, &list("edgelist"))?;
        o.fill_sides(to, &mut nothing(count), |side| {
            ([side.row as c_int, side.across].map(|row| o.triangle(row)), ())
        });
        let to = fresh.room::<_, [f64; 2]>(&raw mut (*vorout).normlist, count, &list("normlist"))?;
        o.fill_sides(to, &mut nothing(count), |side| {
            let [p, q] = built.ends(side).map(|v| built.points()[v.index()]);
            (if side.across < 0 { [q[1] - p[1], p[0] - q[0]] } else { [0.0; 2] }, ())
        });
    }
    Ok(())
}
