//! Memory is asked for before long work starts: the engine, which takes it piece by piece, ends the process where there is none.

use crate::failure::{Failure, Status};

/// Memory of work for a point, in bytes: measured on a million points, and half as much again.
pub(crate) const PLANE_BYTES: usize = 160;
/// As in the plane, for the tetrahedra of space.
pub(crate) const SPACE_BYTES: usize = 430;

/// Refuses work on so many points if there is no memory for it.
pub(crate) fn check(points: usize, bytes: usize) -> Result<(), Failure> {
    let bytes = points.saturating_mul(bytes);
    if !delone_pool::has_room(bytes) {
        let words = format!("{points} points need about {} megabytes", bytes >> 20);
        return Err(Failure::new(Status::Memory, words));
    }
    Ok(())
}
