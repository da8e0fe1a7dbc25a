//! The walls of a box that repeats along some axes only: the region that its cells end at.
//!
//! A wall is parallel to the other axes. Where it is across a coordinate axis it is so exactly; else it is a face of the hull of the
//! corners. Along axes that repeat the region goes further than cells of sites in the box do: by more than the covering radius.

use super::lattice::{Prepared, add};
use super::reduced::covering_radius;
use crate::error::{Error, LatticeProblem};
use crate::plane::Region2;
use crate::points::Bounds;
use crate::space::Region3;

/// A side of the box that is a wall: an axis, and whether it is at its end.
pub(super) type Side = (usize, bool);

/// A region, and which side of the box each of its walls is; none of those that are beyond all cells.
#[derive(Clone, Debug)]
#[expect(unnameable_types, reason = "a parameter of a hidden function")]
pub struct Walls<R, const D: usize> {
    pub(super) region: R,
    pub(super) sides: Vec<Option<Side>>,
}

/// A convex region that cells are clipped to.
#[expect(unnameable_types, reason = "a bound of a hidden type")]
pub trait Region<const D: usize>: Sized {
    /// A box; none if it is empty.
    fn cuboid(low: [f64; D], high: [f64; D]) -> Option<Self>;

    /// The convex hull of the corners of a parallelepiped, of which corner i is at the end of axis k where bit k of i is set; none if
    /// it is empty.
    fn parallelepiped(corners: &[[f64; D]]) -> Option<Self>;

    /// The corners of each wall.
    fn walls(&self) -> Vec<Vec<[f64; D]>>;
}

impl Region<2> for Region2 {
    fn cuboid(low: [f64; 2], high: [f64; 2]) -> Option<Self> {
        Self::rectangle(low, high).ok()
    }

    fn parallelepiped(corners: &[[f64; 2]]) -> Option<Self> {
        Self::polygon(&[[0, 1, 3, 2].map(|i| corners[i]).to_vec()]).ok()
    }

    fn walls(&self) -> Vec<Vec<[f64; 2]>> {
        let sides = |ring: &[[f64; 2]]| {
            let next = ring.iter().cycle().skip(1);
            ring.iter().zip(next).map(|(&p, &q)| vec![p, q]).collect::<Vec<_>>()
        };
        self.rings().flat_map(sides).collect()
    }
}

impl Region<3> for Region3 {
    fn cuboid(low: [f64; 3], high: [f64; 3]) -> Option<Self> {
        Self::cuboid(low, high).ok()
    }

    fn parallelepiped(corners: &[[f64; 3]]) -> Option<Self> {
        Self::convex(corners).ok()
    }

    fn walls(&self) -> Vec<Vec<[f64; 3]>> {
        self.walls().map(Iterator::collect).collect()
    }
}

impl<R: Region<D>, const D: usize> Walls<R, D> {
    /// The walls of a box.
    ///
    /// # Errors
    /// [`Error::Lattice`] for an axis that walls are along, and that has no part away from the others.
    pub(super) fn of(lattice: &Prepared<D>) -> Result<Self, Error> {
        let free: Vec<usize> = (0..D).filter(|&axis| lattice.walled[axis].is_some()).collect();
        let axes: [[f64; D]; D] = std::array::from_fn(|axis| lattice.walled[axis].unwrap_or([0.0; D]));
        // The coordinate that no other axis changes.
        let across = |axis: usize| {
            let is_alone = |k: &usize| {
                let is_zero = |other: usize| axes[other][*k] == 0.0;
                axes[axis][*k] != 0.0
                    && free.iter().all(|&other| other == axis || is_zero(other))
                    && lattice.reduced.iter().all(|v| v.steps[*k] == 0)
            };
            (0..D).find(is_alone)
        };
        let corners = corners(lattice, &axes, &free);
        let axis = free.first().copied().unwrap_or(0);
        let dependent = Error::Lattice { axis, problem: LatticeProblem::Dependent };
        if let Some(coordinates) = free.iter().map(|&axis| across(axis)).collect::<Option<Vec<_>>>() {
            let Bounds { mut low, mut high } = Bounds::of(corners.iter().copied());
            for (&axis, &k) in free.iter().zip(&coordinates) {
                let ends = [lattice.origin[k], lattice.origin[k] + axes[axis][k]];
                (low[k], high[k]) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            }
            let region = R::cuboid(low, high).ok_or(dependent)?;
            let side = |wall: &Vec<[f64; D]>| {
                free.iter().zip(&coordinates).find_map(|(&axis, &k)| {
                    let is_turned = axes[axis][k] < 0.0;
                    let is_at = |end: f64| wall.iter().all(|p| p[k] == end);
                    let is_end =
                        if is_at(low[k]) { Some(is_turned) } else { is_at(high[k]).then_some(!is_turned) };
                    is_end.map(|is_end| (axis, is_end))
                })
            };
            let sides = region.walls().iter().map(side).collect();
            return Ok(Self { region, sides });
        }
        let region = R::parallelepiped(&corners).ok_or(dependent)?;
        let side = |wall: &Vec<[f64; D]>| {
            // All its corners are at one end of the axis.
            let end = |axis: usize, is_end: bool| {
                let is_there = |p: &[f64; D]| {
                    corners.iter().position(|q| q == p).is_some_and(|i| (i >> axis & 1 == 1) == is_end)
                };
                wall.iter().all(is_there)
            };
            free.iter()
                .flat_map(|&axis| [(axis, false), (axis, true)])
                .find(|&(axis, is_end)| end(axis, is_end))
        };
        let sides = region.walls().iter().map(side).collect();
        Ok(Self { region, sides })
    }

    /// The region, if cells end anywhere.
    pub(super) fn within(&self) -> Option<&R> {
        self.sides.iter().any(Option::is_some).then_some(&self.region)
    }
}

/// The corners of the box, stretched along the axes that repeat: corner i is at the end of axis k where bit k of i is set.
fn corners<const D: usize>(lattice: &Prepared<D>, axes: &[[f64; D]; D], free: &[usize]) -> Vec<[f64; D]> {
    /// Cells reach no further than the covering radius from their sites.
    const FURTHER: f64 = 1.25;
    let radius = FURTHER * covering_radius(&lattice.reduced);
    let repeated: Vec<usize> = (0..D).filter(|axis| !free.contains(axis)).collect();
    let corner = |i: usize| {
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
    };
    (0..1_usize << D).map(corner).collect()
}
