//! The medial axis of an area: the places with two or more nearest places on the border, and how wide the area is there.
//!
//! The border gets sites as lines do ([`LineCells2`]). Of the Voronoi edges inside those are kept from which the nearest places on both sides are
//! seen under a large angle. So branches into corners that are nearly straight, and into each corner of a border with many short sides, are
//! left out (Attali & Montanvert, "Computing and simplifying 2D and 3D continuous skeletons", CVIU 1997).
//!
//! Cost: that of the cells of lines.

use delone_predicates::hypotenuse;
use std::collections::BTreeMap;

use super::VoronoiEdge2;
use super::lines::{Borders, LineCells2, Round, deviation_at};
use crate::error::Error;
use crate::ids::TriangleId;
use crate::plane::Location2;
use crate::plane::constrained::{Constrained2, Domains2};
use crate::plane::region::Region2;
use crate::points::Bounds;

/// The medial axis of an area.
///
/// ```
/// use delone::{Constrained2, Fill, MedialAxis2};
///
/// // A bar of the width 2: a line in its middle, and a branch into each corner.
/// let bar = [[0, 0], [9, 0], [9, 2], [0, 2]];
/// let c = Constrained2::from_parts(&bar, &[[0, 1], [1, 2], [2, 3], [3, 0]])?;
/// let axis = MedialAxis2::new(&c, &c.domains(&Fill::EvenOdd)?, 0.01, 60.0)?;
/// let widest = axis.widths.iter().copied().fold(0.0, f64::max);
/// assert!((widest - 2.0).abs() <= 0.02);
/// let length: f64 = axis.edges.iter().map(|edge| {
///     let [a, b] = edge.map(|i| axis.points[i]);
///     (b[0] - a[0]).hypot(b[1] - a[1])
/// }).sum();
/// assert!((length - (7.0 + 4.0 * 2.0_f64.sqrt())).abs() < 0.1);
/// # Ok::<(), delone::Error>(())
/// ```
#[doc(alias("skeleton", "centerline", "center line"))]
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct MedialAxis2 {
    /// Places on the axis.
    pub points: Vec<[f64; 2]>,
    /// Pieces of the axis between them.
    pub edges: Vec<[usize; 2]>,
    /// The width of the area at the middle of each piece: twice the distance from the border, rounded. In coordinate units.
    pub widths: Vec<f64>,
    /// The triangle of the area that the middle of each piece is in.
    pub triangles: Vec<TriangleId>,
    /// How many sites there are along the border.
    pub sites: usize,
    /// The largest distance of a piece from the exact bisector of both sides of the border, as measured beside pieces of the border that
    /// could be divided. Rounded, in coordinate units.
    pub deviation: f64,
}

impl MedialAxis2 {
    /// The medial axis of all that is inside. The tolerance is a length in coordinate units, more than 0; the angle is that under which the
    /// nearest places on both sides are seen, in degrees from 0 to 180: 60 leaves out corners of more than 120.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a tolerance or an angle out of range, and [`Error::TooManyPoints`] if so many sites would be needed
    /// that there are not enough indices.
    pub fn new(c: &Constrained2, domains: &Domains2, tolerance: f64, angle: f64) -> Result<Self, Error> {
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            let range = "positive and finite";
            return Err(Error::Parameter { name: "tolerance", value: tolerance, range });
        }
        if !(0.0..=180.0).contains(&angle) {
            return Err(Error::Parameter { name: "angle", value: angle, range: "from 0 to 180 degrees" });
        }
        let bounds = Bounds::of(c.vertices().map(|v| c.point(v)));
        let Ok(region) = Region2::rectangle(bounds.low, bounds.high) else { return Ok(Self::default()) };
        let most = libm::cos(angle.to_radians());
        let borders = Borders { tolerance, cosine: Some(most) };
        let mut border = LineCells2::default();
        let mut pieces = border.pieces(c, |_| 0);
        let d = border.settle(&mut pieces, &region, borders)?;
        let round = Round::new(&border, &pieces, &d, &region, borders);
        let mut made = Self { sites: border.sites.len(), deviation: border.deviation, ..Self::default() };
        let mut places: BTreeMap<TriangleId, usize> = BTreeMap::new();
        let mesh = d.mesh();
        for e in mesh.undirected_edges().filter(|&e| d.voronoi().has_length(e)) {
            let VoronoiEdge2::Segment([p, q]) = d.voronoi().edge(e) else { continue };
            let middle = [0, 1].map(|k| 0.5 * p[k] + 0.5 * q[k]);
            let near =
                [mesh.origin(e), mesh.destination(e)].map(|site| round.nearest(middle, site.index()).0);
            let is_wide = deviation_at(middle, near).is_some_and(|(_, cosine)| cosine <= most);
            let Some(inside) = triangle_at(c, middle).filter(|&t| is_wide && domains.is_inside(t)) else {
                continue;
            };
            let ends = [(e.triangle(), p), (mesh.twin(e).triangle(), q)];
            made.edges.push(ends.map(|(t, at)| {
                *places.entry(t).or_insert_with(|| {
                    made.points.push(at);
                    made.points.len() - 1
                })
            }));
            let distance = |place: [f64; 2]| hypotenuse(place[0] - middle[0], place[1] - middle[1]);
            made.widths.push(2.0 * distance(near[0]).min(distance(near[1])));
            made.triangles.push(inside);
        }
        Ok(made)
    }
}

/// The triangle at a place; none at a vertex and outside of the hull.
fn triangle_at(c: &Constrained2, at: [f64; 2]) -> Option<TriangleId> {
    match c.locate(at) {
        Ok(Location2::Triangle(t)) => Some(t),
        Ok(Location2::Edge(e)) => Some(e.triangle()),
        _ => None,
    }
}
