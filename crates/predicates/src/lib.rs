//! Exact geometric predicates: points in, a [`Sign`] out.
//!
//! Every geometric decision of Delone is made here, and this crate knows no mesh. Coordinates are any
//! finite `f64`, subnormals and `1e308` in one tuple included; the sign returned is always that of the
//! real-number expression. NaN and infinities must be refused before they come here.
//!
//! Each door reads in stages, and a stage is asked only when the one before it cannot tell:
//!
//! 1. **filter**: floating point with a proven error bound. [`Filter`] takes its bound from a bounding
//!    box, once for many decisions; without a box the bound comes from the operands themselves.
//! 2. **exact**: integers when the operands fit 61 bits on a common scale, expansions (the `robust` crate)
//!    when no product can overflow or underflow, arbitrary precision otherwise.
//! 3. **perturb**: an exact tie of the in-circle test is broken by the canonical rule (see [`in_circle`]).
//!
//! ```
//! use delone_predicates::{Sign, in_circle, orient2d};
//!
//! let (a, b, c) = ([0.0, 0.0], [1.0, 0.0], [1.0, 1.0]);
//! assert_eq!(orient2d(a, b, c), Sign::Positive); // a, b, c turn left
//! assert_eq!(in_circle(a, b, c, [0.5, 0.5]), Sign::Positive); // inside
//! // Cocircular: (1, 1) is the lexicographic maximum, so it is raised out of the others' circle.
//! assert_eq!(in_circle(a, b, [0.0, 1.0], c), Sign::Negative);
//! ```

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod ball;
mod cell;
mod center;
mod clear;
pub mod counters;
#[cfg(test)]
mod decided;
mod disks;
mod distance;
mod exact;
mod filter;
mod fixed_point;
mod hypotenuse;
mod in_box;
mod in_circle;
mod in_sphere;
mod lanes;
mod length;
mod lexicographic;
mod line;
mod lune;
mod mean;
mod ordinate;
mod orient;
mod orient3d;
mod orthosphere;
mod pencil;
mod perturb;
mod plane;
mod power;
mod segment;
mod side_in_plane;
mod sign;
mod solid;
mod sphere_center;
mod sphere_pencil;
#[cfg(test)]
mod stages;
mod within;

pub use cell::segment_rounds_to;
pub use center::{center_direction, center_side};
pub use clear::{keeps_clear, keeps_clear_of_sites};
pub use disks::{DiskPair, End, Stretch};
pub use distance::{
    SearchLimit, angle, angle3, compare_distances, compare_distances3, compare_with_radius,
    compare_with_radius3, is_surely_further, segment_keeps_away,
};
pub use filter::{Filter, Filter3, Grid};
pub use fixed_point::{FixedPoint, SeenCorner};
pub use hypotenuse::hypotenuse;
pub use in_box::SiteRef;
pub use in_circle::{in_circle, in_circle_with_ties};
pub use in_sphere::{in_sphere, in_sphere_with_ties};
pub use length::{Length, compare_lengths};
pub use lexicographic::{lexicographic, lexicographic3, strictly_between};
pub use line::{Line, Spot, circumcenter, power_center};
pub use lune::{Lune, LunePlace, in_diametral_ball};
pub use mean::mean;
pub use ordinate::ordinate;
pub use orient::orient2d;
pub use orient3d::{are_collinear3, orient3d, orient3d_moved};
pub use orthosphere::{
    RadiusScale, edge_is_attached, squared_radius, triangle_is_attached, vertex_is_attached,
};
pub use pencil::{Four, Member, Pencil};
pub use plane::Plane;
pub use power::{
    compare_powers, in_power_circle, in_power_circle_with_ties, in_power_interval, in_power_sphere,
    in_power_sphere_with_ties,
};
pub use segment::compare_segment_with_radius;
pub use side_in_plane::side_in_plane;
pub use sign::Sign;
pub use solid::{Corner3, HalfSpace, HalfSpaces};
pub use sphere_center::{circumcenter3, power_center3};
pub use sphere_pencil::{Ball, SpherePencil};
pub use within::{stays_within, stays_within3};

/// A point of the plane: x, then y. Both finite.
pub type Point2 = [f64; 2];

/// A point of space: x, y, z. All finite.
pub type Point3 = [f64; 3];

/// A point with a weight, the square of a radius in the units of the coordinates; it may be negative. All numbers are finite.
pub type Site<const D: usize> = ([f64; D], f64);
