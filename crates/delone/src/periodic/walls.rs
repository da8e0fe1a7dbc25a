//! The walls of a box that repeats along some axes only: the region that its cells end at.
//!
//! A wall is parallel to the other axes. Where it is across a coordinate axis it is so exactly; else it is a face of the hull of eight
//! corners. Along axes that repeat the region goes further than cells of sites in the box do: by more than the covering radius.

use super::lattice::{Prepared, add};
use super::reduced::covering_radius;
use crate::error::{Error, LatticeProblem};
use crate::points::Bounds;
use crate::space::Region3;

/// A side of the box that is a wall: an axis, and whether it is at its end.
pub(super) type Side = (usize, bool);

/// A region, and which side of the box each of its walls is; none of those that are beyond all cells.
#[derive(Clone, Debug)]
pub(super) struct Walls {
    pub region: Region3,
    pub sides: Vec<Option<Side>>,
}

impl Walls {
    /// The walls of a box; none if it repeats along all axes.
    ///
    /// # Errors
    /// [`Error::Lattice`] for an axis that walls are along, and that has no part away from the others.
    pub(super) fn of(lattice: &Prepared<3>) -> Result<Option<Self>, Error> {
        let free: Vec<usize> = (0..3).filter(|&axis| lattice.walled[axis].is_some()).collect();
        if free.is_empty() {
            return Ok(None);
        }
        let axes: [[f64; 3]; 3] = std::array::from_fn(|axis| lattice.walled[axis].unwrap_or_default());
        // The coordinate that no other axis changes.
        let across = |axis: usize| {
            let is_alone = |k: &usize| {
                let is_zero = |other: usize| axes[other][*k] == 0.0;
                axes[axis][*k] != 0.0
                    && free.iter().all(|&other| other == axis || is_zero(other))
                    && lattice.reduced.iter().all(|v| v.steps[*k] == 0)
            };
            (0..3).find(is_alone)
        };
        let corners = corners(lattice, &axes, &free);
        let dependent = |axis| Error::Lattice { axis, problem: LatticeProblem::Dependent };
        if let Some(coordinates) = free.iter().map(|&axis| across(axis)).collect::<Option<Vec<_>>>() {
            let Bounds { mut low, mut high } = Bounds::of(corners);
            let mut sides = vec![None; 6];
            for (&axis, k) in free.iter().zip(coordinates) {
                let ends = [lattice.origin[k], lattice.origin[k] + axes[axis][k]];
                let is_turned = ends[1] < ends[0];
                (low[k], high[k]) = if is_turned { (ends[1], ends[0]) } else { (ends[0], ends[1]) };
                (sides[2 * k], sides[2 * k + 1]) = (Some((axis, is_turned)), Some((axis, !is_turned)));
            }
            let region = Region3::cuboid(low, high).map_err(|_| dependent(free[0]))?;
            return Ok(Some(Self { region, sides }));
        }
        let region = Region3::convex(&corners).map_err(|_| dependent(free[0]))?;
        let side = |wall: &[[f64; 3]]| {
            // All its corners are at one end of the axis.
            let end = |axis: usize, is_end: bool| {
                let is_there = |p: &[f64; 3]| {
                    corners.iter().position(|q| q == p).is_some_and(|i| (i >> axis & 1 == 1) == is_end)
                };
                wall.iter().all(is_there)
            };
            free.iter()
                .flat_map(|&axis| [(axis, false), (axis, true)])
                .find(|&(axis, is_end)| end(axis, is_end))
        };
        let sides = region.walls().map(|wall| side(&wall.collect::<Vec<_>>())).collect();
        Ok(Some(Self { region, sides }))
    }
}

/// The corners of the box, stretched along the axes that repeat: corner i is at the end of axis k where bit k of i is set.
fn corners(lattice: &Prepared<3>, axes: &[[f64; 3]; 3], free: &[usize]) -> [[f64; 3]; 8] {
    /// Cells reach no further than the covering radius from their sites.
    const FURTHER: f64 = 1.25;
    let radius = FURTHER * covering_radius(&lattice.reduced);
    let repeated: Vec<usize> = (0..3).filter(|axis| !free.contains(axis)).collect();
    std::array::from_fn(|i| {
        let mut corner = lattice.origin;
        for &axis in free {
            add(&mut corner, if i >> axis & 1 == 1 { 1.0 } else { 0.0 }, &axes[axis]);
        }
        for (vector, axis) in lattice.reduced.iter().zip(&repeated) {
            // The ends of the box may be shifted along the lattice, and its beginning may be anywhere.
            let shift: f64 = free.iter().map(|&axis| vector.fraction(&axes[axis]).abs()).sum();
            let margin = radius / vector.width + shift;
            let from = vector.fraction(&lattice.origin);
            let times = if i >> axis & 1 == 1 { 1.0 + margin - from } else { -margin - from };
            add(&mut corner, times, &vector.vector);
        }
        corner
    })
}
