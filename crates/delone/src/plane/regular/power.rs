//! Power diagrams, as a view of the regular triangulation: what belongs to whom if distances are powers.
//!
//! The power cell of a site is what has no less power to another one; hidden sites have none. Cells are convex, and tile the
//! plane. The areas of clipped cells depend on the weights, and so steeply that Newton's method finds weights for prescribed
//! areas: their Jacobian is in the lengths of the borders.
//!
//! Sources: Aurenhammer, "Power diagrams: properties, algorithms and applications", SIAM J. Comput. 1987; Aurenhammer, Hoffmann
//! & Aronov, "Minkowski-type theorems and least-squares clustering", Algorithmica 1998; Kitagawa, Mérigot & Thibert, "Convergence of a
//! Newton algorithm for semi-discrete optimal transport", JEMS 2019, for the Jacobian.
//!
//! Cost: O(n) for the cells inside of the region, O(d (d + s)) for a cell with d neighbors where s sides of it are near.

use delone_predicates::{Line, hypotenuse};

use super::Regular2;
use crate::ids::{EdgeId, Place, TriangleId, VertexId};
use crate::plane::layer::kernel::Power;
use crate::plane::region::clip;
use crate::plane::region::tree::Relation;
use crate::plane::region::{Region2, enlarged};
use crate::plane::voronoi::cells::Cells2;
use crate::plane::voronoi::centers::Centers;
use crate::plane::voronoi::clip::{Cellular, cut_out};
use crate::points::Bounds;
use crate::sorting;

/// The power diagram of the sites of a triangulation.
///
/// ```
/// use delone::{Region2, Regular2};
///
/// // Two sites one apart: with the same weights the border is in the middle, and the heavier one moves it away.
/// let square = Region2::rectangle([0.0, 0.0], [1.0, 1.0])?;
/// let mut r = Regular2::from_sites(&[([0.0, 0.5], 0.0), ([1.0, 0.5], 0.0)])?;
/// let [a, b] = [0, 1].map(delone::VertexId::new);
/// assert_eq!(r.power().clip(&square).area(a), 0.5);
/// r.set_weight(a, 0.5)?;
/// assert_eq!(r.power().clip(&square).area(a), 0.75);
/// // What moves it further: half of the border's length over the distance, for each unit of weight.
/// let jacobian = r.power().jacobian(&square);
/// assert_eq!(jacobian.derivatives, [([a, b], -0.5)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Power2<'a> {
    triangulation: &'a Regular2,
}

/// Areas of clipped power cells, and how they change with the weights.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Jacobian2 {
    /// The area of the cell of each site, by id; zero for one that is hidden or gone.
    pub areas: Vec<f64>,
    /// For pairs of sites whose cells share a border in the region, the smaller first and sorted: the derivative of the area of
    /// either by the weight of the other, which is negative. That by its own weight is the sum of all of its, without
    /// the sign.
    pub derivatives: Vec<([VertexId; 2], f64)>,
}

impl Regular2 {
    /// The power diagram.
    ///
    /// ```
    /// use delone::{Region2, Regular2, VertexId};
    ///
    /// let r = Regular2::from_sites(&[([1, 1], 4.0), ([3, 1], 0.0)])?; // the larger weight takes more
    /// let cells = r.power().clip(&Region2::rectangle([0, 0], [4, 4])?);
    /// assert_eq!([0, 1].map(|k| cells.area(VertexId::new(k))), [12.0, 4.0]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn power(&self) -> Power2<'_> {
        Power2 { triangulation: self }
    }
}

impl<'a> Power2<'a> {
    /// The triangulation that it is a view of.
    pub fn triangulation(self) -> &'a Regular2 {
        self.triangulation
    }

    /// The corner of three cells that is dual to a triangle. `None` for a ghost, and if it is too far away for `f64`.
    pub fn vertex(self, t: TriangleId) -> Option<[f64; 2]> {
        let layer = &self.triangulation.base;
        let corners = layer.mesh.places(t);
        if corners.iter().any(|p| p.is_ghost()) {
            return None;
        }
        let [a, b, c] = corners.map(|p| layer.site(p));
        Power::center(a, b, c)
    }

    /// Clips all cells to a region. Sites may be outside of it, and of their cells. The clipped cells tile the region.
    pub fn clip(self, region: &Region2) -> Cells2 {
        Cells2::of(&self.triangulation.base, self.triangulation.ids_given(), region, |_| {})
    }

    /// Areas and their derivatives by the weights, clipped to a region.
    pub fn jacobian(self, region: &Region2) -> Jacobian2 {
        let r = self.triangulation;
        let layer = &r.base;
        let cells = self.clip(region);
        let areas = (0..r.ids_given()).map(|i| cells.area(VertexId::new(i))).collect();
        let centers = Centers::of(layer, None).points;
        let mut derivatives = Vec::new();
        for place in layer.mesh.inhabited().filter(|_| layer.mesh.lone.is_none()) {
            let v = layer.mesh.name(place);
            let mut borders: Option<Vec<(Line, f64)>> = None;
            for e in layer.mesh.spokes(place) {
                let w = layer.mesh.head(e);
                if w.is_ghost() || layer.mesh.name(w) < v {
                    continue;
                }
                let length = self.border(e, &centers, region).unwrap_or_else(|| {
                    let line = Power::border(layer.site(place), layer.site(w));
                    let of_cell = borders.get_or_insert_with(|| clipped_borders(r, region, place));
                    of_cell.iter().filter(|(on, _)| *on == line).map(|(_, length)| length).sum()
                });
                if length > 0.0 {
                    let [p, q] = [place, w].map(|p| layer.points[p.index()]);
                    let distance = hypotenuse(q[0] - p[0], q[1] - p[1]);
                    derivatives.push(([v, layer.mesh.name(w)], -length / (2.0 * distance)));
                }
            }
        }
        sorting::by_key(&mut derivatives, |derivative| derivative.0);
        Jacobian2 { areas, derivatives }
    }

    /// The length of the border that is dual to an edge, if it is surely inside of the region.
    fn border(self, e: EdgeId, centers: &[[f64; 2]], region: &Region2) -> Option<f64> {
        let layer = &self.triangulation.base;
        let triangles = [e, layer.mesh.twin(e)].map(EdgeId::triangle);
        let [p, q] = triangles.map(|t| centers[t.index()]);
        let Bounds { low, high } = Bounds::of([p, q]);
        let [low, high] = enlarged(low, high)?;
        (region.relation(low, high) == Relation::Inside).then(|| hypotenuse(q[0] - p[0], q[1] - p[1]))
    }
}

/// The lines that the sides of a clipped cell are on, and their lengths.
fn clipped_borders(r: &Regular2, region: &Region2, place: Place) -> Vec<(Line, f64)> {
    let rings: Vec<clip::Ring> = cut_out(&r.base, region, place);
    let mut borders = Vec::new();
    for ring in &rings {
        for (corner, next) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            if let (Some(p), Some(q)) = (corner.spot.rounded(), next.spot.rounded()) {
                borders.push((corner.line, hypotenuse(q[0] - p[0], q[1] - p[1])));
            }
        }
    }
    borders
}
