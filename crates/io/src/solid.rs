//! Closed surfaces in space: convex hulls, and the borders of triangulations.

use std::io::Write;

use delone::{Corners, Dimension, Hull3, Triangulation, VertexId};

use crate::elements::FACETS;
use crate::{Contents, Direction, Error, Format, Mesh, Remark, Shape, picture};

/// Flat convex faces around a body.
#[derive(Clone, Debug, Default)]
pub struct Solid {
    /// The corners.
    pub points: Vec<[f64; 3]>,
    /// The faces as indices of corners, counter-clockwise seen from outside.
    pub faces: Vec<Vec<usize>>,
    /// For each face whether a cut has laid it open; none is, if this is empty.
    pub laid_open: Vec<bool>,
}

impl Solid {
    /// A convex hull of points, with its corners alone, by increasing index in the input.
    pub fn of_hull(hull: &Hull3, points: &[[f64; 3]]) -> Self {
        let place = |i: &usize| hull.corners().partition_point(|corner| corner < i);
        let faces = hull.faces().filter(|_| hull.dimension() == Dimension::Space);
        Self {
            points: hull.corners().iter().map(|&i| points[i]).collect(),
            faces: faces.map(|face| face.iter().map(place).collect()).collect(),
            laid_open: Vec::new(),
        }
    }
}

impl<T: Triangulation<Point = [f64; 3]>> Mesh<'_, T> {
    /// The border: the hull with its vertices alone, by increasing index; or, if something is left out, that of the rest.
    pub fn solid(&self) -> Solid {
        if self.trim.is_some() { self.rest() } else { self.hull() }
    }

    fn hull(&self) -> Solid {
        let facets: Vec<T::Facet> = self.triangulation.hull_facets().collect();
        let mut used: Vec<VertexId> = facets.iter().flat_map(|facet| facet.as_ref()).copied().collect();
        used.sort_unstable();
        used.dedup();
        let place = |i: usize| used.partition_point(|&corner| corner.index() < i);
        Solid {
            faces: facets.iter().map(|facet| facet.indices().map(place).collect()).collect(),
            points: used.iter().map(|&v| self.point(v)).collect(),
            laid_open: Vec::new(),
        }
    }

    fn rest(&self) -> Solid {
        let mut solid = Solid { points: self.points.to_vec(), ..Solid::default() };
        for s in self.simplices() {
            let corners = self.triangulation.corners(s);
            for k in (0..4).filter(|&k| self.across(s, k).is_none()) {
                solid.faces.push(FACETS[k].map(|i| corners.as_ref()[i].index()).to_vec());
                solid.laid_open.push(self.triangulation.across(s, k).is_some());
            }
        }
        solid
    }
}

impl Shape for Solid {
    fn positions(&self) -> impl Iterator<Item = [f64; 3]> {
        self.points.iter().copied()
    }

    fn triangles(&self) -> impl Iterator<Item = [usize; 3]> {
        self.faces.iter().flat_map(|face| face[1..].windows(2).map(|side| [face[0], side[0], side[1]]))
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn heights(&self) -> Option<&[f64]> {
        None
    }
}

/// Writes a closed surface: its triangles, or a picture of it, which shows the points where there are no faces.
pub fn write_solid(
    out: &mut dyn Write,
    format: Format,
    solid: &Solid,
    options: &picture::Options,
) -> Result<Remark, Error> {
    use crate::formats::{obj, ply, stl, vtu};
    match format {
        Format::Ply => ply::write(out, solid)?,
        Format::Obj => obj::write(out, solid)?,
        Format::Stl => return Ok(stl::write(out, solid)?),
        Format::Vtu => return Ok(vtu::write(out, solid)?),
        Format::Svg | Format::Png => picture::write_solid(out, format, solid, options)?,
        _ => return Err(format.without(Contents::Surfaces, Direction::Written)),
    }
    Ok(None)
}
