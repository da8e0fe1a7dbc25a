//! Regions of space that cells are clipped to: a box, the convex hull of points.
//!
//! A region is the inside of all of its walls. Cutting starts from the box around it, whose sides are walls where the region has such.
//!
//! Cost: a box O(1); a hull O(n log n) in practice.

pub(in crate::space) mod measure;
pub(in crate::space) mod solid;

use delone_predicates::HalfSpace;

use crate::error::Error;
use crate::hull::Hull3;
use crate::mesh::Dimension;
use crate::points::{Bounds, Position3, check_in_space};
use crate::space::Delaunay3;

/// A convex region of space with flat walls.
#[derive(Clone, Debug)]
pub struct Region3 {
    bounds: Bounds<3>,
    /// The sides of a box around it, low and high by axis, each with the number of the wall that is on it.
    pub(in crate::space) frame: [(HalfSpace, Option<u32>); 6],
    /// The other walls.
    pub(in crate::space) slanted: Vec<(HalfSpace, u32)>,
    corners: Vec<[f64; 3]>,
    /// The corners of each wall, counter-clockwise seen from outside.
    walls: Vec<Vec<u32>>,
}

/// The corners of the sides of a box, low and high by axis: corner i is high on axis k where bit k of i is set.
const SIDES: [[u32; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

impl Region3 {
    /// An axis-parallel box. Its walls are, by number: low x, high x, low y, high y, low z, high z.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names a corner (0 is `low`, 1 is `high`) with a coordinate that is not finite; [`Error::NoVolume`] is for a
    /// box without inside.
    ///
    /// ```
    /// use delone::Region3;
    /// assert_eq!(Region3::cuboid([0.0, 0.0, 0.0], [4.0, 2.0, 1.0])?.volume(), 8.0);
    /// assert!(Region3::cuboid([0.0, 0.0, 0.0], [4.0, 0.0, 1.0]).is_err());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn cuboid<P: Position3>(low: P, high: P) -> Result<Self, Error> {
        let ends = [low.xyz(), high.xyz()];
        check_in_space(&ends)?;
        // Without negative zeros.
        let [low, high] = ends.map(|p| p.map(|x| x + 0.0));
        if (0..3).any(|k| low[k] >= high[k]) {
            return Err(Error::NoVolume);
        }
        let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 1 { high[k] } else { low[k] });
        let mut frame = frame_of(&Bounds { low, high });
        frame.iter_mut().zip(0..).for_each(|(side, k)| side.1 = Some(k));
        Ok(Self {
            bounds: Bounds { low, high },
            frame,
            slanted: Vec::new(),
            corners: (0..8).map(corner).collect(),
            walls: SIDES.iter().map(|side| side.to_vec()).collect(),
        })
    }

    /// The convex hull of the vertices of a triangulation.
    ///
    /// # Errors
    /// [`Error::NoVolume`] if they do not span space.
    pub fn hull(triangulation: &Delaunay3) -> Result<Self, Error> {
        let corners: Vec<[f64; 3]> = triangulation.hull_vertices().map(|v| triangulation.point(v)).collect();
        Self::convex(&corners)
    }

    /// The convex hull of points. Its walls are numbered as [`Hull3::faces`] of the points; so flat faces are whole. O(n log n) in practice.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names a coordinate; [`Error::NoVolume`] is for points that do not span space, [`Error::TooManyPoints`] for more
    /// than a hull holds.
    ///
    /// ```
    /// use delone::Region3;
    /// let octahedron = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
    /// let region = Region3::convex(&octahedron)?;
    /// assert_eq!((region.walls().count(), region.volume()), (8, 4.0 / 3.0));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn convex<P: Position3>(points: &[P]) -> Result<Self, Error> {
        let hull = Hull3::from_points(points)?;
        if hull.dimension() != Dimension::Space {
            return Err(Error::NoVolume);
        }
        let used = hull.corners();
        let corners: Vec<[f64; 3]> = used.iter().map(|&i| points[i].xyz().map(|x| x + 0.0)).collect();
        let index = |i: &usize| used.binary_search(i).unwrap_or_default() as u32;
        let walls: Vec<Vec<u32>> = hull.faces().map(|face| face.iter().map(index).collect()).collect();
        let bounds = Bounds::of(corners.iter().copied());
        let mut frame = frame_of(&bounds);
        let mut slanted = Vec::new();
        for (wall, number) in walls.iter().zip(0..) {
            let [a, b, c] = [0, 1, 2].map(|k| corners[wall[k] as usize]);
            // A face across an axis is at one end of the box.
            match (0..3).find(|&k| a[k] == b[k] && b[k] == c[k]) {
                Some(k) => frame[2 * k + usize::from(a[k] == bounds.high[k])].1 = Some(number),
                None => slanted.push((HalfSpace::Through(a, c, b), number)),
            }
        }
        // Other sides of the box are beyond all, unless there are no larger numbers.
        for (side, _) in frame.iter_mut().filter(|(_, wall)| wall.is_none()) {
            match side {
                HalfSpace::Above(_, at) => *at = at.next_down().max(f64::MIN),
                HalfSpace::Below(_, at) => *at = at.next_up().min(f64::MAX),
                _ => {}
            }
        }
        Ok(Self { bounds, frame, slanted, corners, walls })
    }

    /// The volume, in coordinate units cubed; infinite if it is beyond the range of `f64`.
    pub fn volume(&self) -> f64 {
        measure::of(self.walls()).volume
    }

    /// The walls by number: their corners, counter-clockwise seen from outside.
    pub fn walls(
        &self,
    ) -> impl ExactSizeIterator<Item = impl Iterator<Item = [f64; 3]> + Clone + '_> + Clone {
        self.walls.iter().map(|wall| wall.iter().map(|&i| self.corners[i as usize]))
    }

    /// The corners.
    pub fn corners(&self) -> &[[f64; 3]] {
        &self.corners
    }

    /// The corners of the smallest box around it, low and high.
    pub fn bounds(&self) -> [[f64; 3]; 2] {
        [self.bounds.low, self.bounds.high]
    }

    /// Whether a place is strictly inside, by its correctly rounded coordinates; false where these cannot tell.
    #[inline]
    pub(in crate::space) fn surely_holds(&self, rounded: [f64; 3]) -> bool {
        let Bounds { low, high } = &self.bounds;
        // Rounding keeps order: what is rounded below a number is below it.
        (0..3).all(|k| low[k] < rounded[k] && rounded[k] < high[k])
            && self.slanted.iter().all(|(wall, _)| wall.surely_holds(rounded))
    }
}

/// The sides of a box, low and high by axis, none of them a wall.
fn frame_of(bounds: &Bounds<3>) -> [(HalfSpace, Option<u32>); 6] {
    [0, 1, 2, 3, 4, 5].map(|i| {
        let axis = i / 2;
        let side = match i % 2 {
            0 => HalfSpace::Above(axis, bounds.low[axis]),
            _ => HalfSpace::Below(axis, bounds.high[axis]),
        };
        (side, None)
    })
}

#[cfg(test)]
mod tests {
    use super::Region3;

    #[test]
    fn regions_without_volume_are_refused() {
        let flat = |x: f64, y: f64, z: f64| Region3::cuboid([0.0; 3], [x, y, z]).is_err();
        assert!(
            flat(0.0, 1.0, 1.0) && flat(1.0, -1.0, 1.0) && flat(1.0, 1.0, f64::NAN) && !flat(1.0, 1.0, 1.0)
        );
        let square = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]];
        assert!(Region3::convex(&square).is_err() && Region3::convex::<[f64; 3]>(&[]).is_err());
    }

    /// A box by its corners is the box; a wedge has walls of both kinds.
    #[test]
    fn boxes_and_wedges() {
        let corners: Vec<[f64; 3]> =
            (0..8).map(|i| [0, 1, 2].map(|k| if i >> k & 1 == 1 { 3.0 } else { -1.0 })).collect();
        let hull = Region3::convex(&corners).expect("a box");
        assert_eq!((hull.volume(), hull.walls().count(), hull.slanted.len()), (64.0, 6, 0));
        assert_eq!(Region3::cuboid([-1.0; 3], [3.0; 3]).expect("a box").volume(), 64.0);
        let wedge = [[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 1], [2, 0, 1], [0, 2, 1]];
        let wedge = Region3::convex(&wedge).expect("a wedge");
        assert_eq!((wedge.volume(), wedge.walls().count(), wedge.slanted.len()), (2.0, 5, 1));
        assert!(wedge.surely_holds([0.5; 3]) && !wedge.surely_holds([1.0, 1.0, 0.5]));
        assert!(!wedge.surely_holds([1.5, 1.0, 0.5]) && !wedge.surely_holds([0.5, 0.5, 1.0]));
    }
}
