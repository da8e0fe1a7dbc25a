//! Voronoi diagrams of space, as a view of the triangulation.
//!
//! The cell of a site is what is at least as near to it as to every other vertex. Cells are dual to vertices, their faces to Delaunay
//! edges, Voronoi edges to facets, Voronoi vertices (the centers of spheres) to tetrahedra. So the diagram takes no memory and is always that
//! of the triangulation as it is.
//!
//! A cell inside of its region is read off (`read`), any other is cut out of the region by half-spaces (`clip`). Until the end a corner is the
//! exact meeting of three planes, so that cells tile. Each coordinate is rounded once, and corners at one place are one in all cells
//! (`centers`, `build`).
//!
//! Cost: O(1) for a vertex, O(d log d) for the neighbors of a site with d tetrahedra.

mod build;
pub(in crate::space) mod cells;
pub(in crate::space) mod centers;
pub(in crate::space) mod clip;
pub(in crate::space) mod faces;
mod read;
mod relax;

pub use cells::{Across3, Cell3, Cells3, Face3};
pub use relax::Relaxation3;

use super::Delaunay3;
use crate::ids::{TetrahedronId, VertexId};

/// The Voronoi diagram of the vertices of a triangulation of space.
///
/// ```
/// use delone::{Delaunay3, Region3};
///
/// let sites = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [-2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, -2.0, 0.0], [0.0, 0.0, 2.0], [0.0, 0.0, -2.0]];
/// let d = Delaunay3::from_points(&sites)?;
/// let center = d.vertices().next().unwrap();
/// assert!(d.voronoi().is_bounded(center));
/// assert_eq!(d.voronoi().neighbors(center).len(), 6);
///
/// let cells = d.voronoi().clip(&Region3::cuboid([-2.0, -2.0, -2.0], [2.0, 2.0, 2.0])?);
/// assert_eq!(cells.volume(center), 8.0);
/// assert_eq!(cells.centroid(center), Some([0.0; 3]));
/// assert!(cells.faces(center).all(|face| face.area() == 4.0 && face.neighbor().is_some()));
/// let sum: f64 = d.vertices().map(|v| cells.volume(v)).sum();
/// assert!((sum - 64.0).abs() < 1e-12);
/// # Ok::<(), delone::Error>(())
/// ```
#[doc(alias = "Voronoi_diagram_3")]
#[derive(Clone, Copy, Debug)]
pub struct Voronoi3<'a> {
    triangulation: &'a Delaunay3,
}

impl Delaunay3 {
    /// The Voronoi diagram of the vertices.
    pub fn voronoi(&self) -> Voronoi3<'_> {
        Voronoi3 { triangulation: self }
    }
}

impl<'a> Voronoi3<'a> {
    /// The triangulation that it is a view of.
    pub fn triangulation(self) -> &'a Delaunay3 {
        self.triangulation
    }

    /// The Voronoi vertex of a tetrahedron: the center of its sphere. `None` for a ghost, and if it is too far away for `f64`.
    pub fn vertex(self, t: TetrahedronId) -> Option<[f64; 3]> {
        self.triangulation.circumcenter(t)
    }

    /// The Voronoi vertices, one for each finite tetrahedron, in the order of [`Delaunay3::tetrahedron_ids`]; those of tetrahedra on
    /// one sphere coincide, to the bit.
    pub fn vertices(self) -> impl Iterator<Item = Option<[f64; 3]>> + 'a {
        self.triangulation.tetrahedron_ids().map(move |t| self.vertex(t))
    }

    /// Whether the cell of a vertex is bounded: it is for vertices that are not on the hull. Exact.
    pub fn is_bounded(self, site: VertexId) -> bool {
        faces::is_bounded(&self.triangulation.base, site)
    }

    /// The sites whose cells share more than a point or a line with a cell, by increasing id. Exact.
    ///
    /// ```
    /// use delone::{Delaunay3, VertexId};
    ///
    /// // In a cubic lattice six of 26 neighbors share a face.
    /// let grid: Vec<_> = (0..27).map(|i| [i % 3, i / 3 % 3, i / 9]).collect();
    /// let d = Delaunay3::from_points(&grid)?;
    /// assert_eq!(d.voronoi().neighbors(VertexId::new(13)).len(), 6);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("neighbours", "ridge_points"))]
    pub fn neighbors(self, site: VertexId) -> Vec<VertexId> {
        faces::neighbors(&self.triangulation.base, site)
    }
}
