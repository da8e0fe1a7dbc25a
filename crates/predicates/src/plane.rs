//! One plane against many points: the orientation of four points, three of them fixed.

use crate::{Point3, Sign};

const U: f64 = f64::EPSILON / 2.0;
/// Each term of the sum: four roundings in the normal, one of a difference, one of a product, two of sums, and room
/// for the higher orders.
pub(crate) const BOUND: f64 = 10.0 * U;

/// The plane through three points, for points in a box.
///
/// ```
/// use delone_predicates::{Plane, Sign};
/// let plane = Plane::new([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [4.0, 4.0, 4.0]);
/// assert_eq!(plane.side([1.0, 1.0, 2.0]), Some(Sign::Positive));
/// assert_eq!(plane.side([3.0, 1.0, 0.0]), None); // too near to tell
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Plane {
    origin: Point3,
    normal: Point3,
    bound: f64,
}

impl Plane {
    /// The plane through `a`, `b`, `c`. `extent` is at least the size of the box that they and all points asked for
    /// are in, axis by axis.
    pub fn new(a: Point3, b: Point3, c: Point3, extent: [f64; 3]) -> Self {
        let [u, v] = [b, c].map(|p| [0, 1, 2].map(|k| p[k] - a[k]));
        let products = [0, 1, 2].map(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            (u[i] * v[j], u[j] * v[i])
        });
        let permanent: f64 = (0..3).map(|k| (products[k].0.abs() + products[k].1.abs()) * extent[k]).sum();
        // All errors by underflow: two products in each component of the normal, and three after.
        let floor = f64::MIN_POSITIVE * (1.0 + extent[0] + extent[1] + extent[2]);
        Self { origin: a, normal: products.map(|(x, y)| x - y), bound: BOUND * permanent + floor }
    }

    /// Proportional to the distance of a point from the plane, rounded; positive where [`crate::orient3d`] is.
    #[inline]
    pub fn height(&self, p: Point3) -> f64 {
        let [x, y, z] = [0, 1, 2].map(|k| self.normal[k] * (p[k] - self.origin[k]));
        x + y + z
    }

    /// The side of a point, if floating point can tell; [`crate::orient3d`] can always.
    #[inline]
    pub fn side(&self, p: Point3) -> Option<Sign> {
        let height = self.height(p);
        if height > self.bound {
            Some(Sign::Positive)
        } else if height < -self.bound {
            Some(Sign::Negative)
        } else {
            None
        }
    }
}
