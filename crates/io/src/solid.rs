//! Closed surfaces in space, such as convex hulls.

use std::io::Write;

use delone::Dimension;
use delone::Hull3;

use crate::{Error, Format, Remark, Shape, picture};

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
        let faces = hull.faces().iter().filter(|_| hull.dimension() == Dimension::Space);
        Self {
            points: hull.corners().iter().map(|&i| points[i]).collect(),
            faces: faces.map(|face| face.iter().map(place).collect()).collect(),
            laid_open: Vec::new(),
        }
    }
}

impl Shape for Solid {
    fn positions(&self) -> impl Iterator<Item = [f64; 3]> {
        self.points.iter().copied()
    }

    fn triangles(&self) -> impl Iterator<Item = [usize; 3]> {
        self.faces.iter().flat_map(|face| face[1..].windows(2).map(|side| [face[0], side[0], side[1]]))
    }

    fn heights(&self) -> Option<&[f64]> {
        None
    }
}

/// Writes a closed surface: its triangles, or a picture of it.
pub fn write_solid(
    out: &mut dyn Write,
    format: Format,
    solid: &Solid,
    camera: &picture::Camera,
) -> Result<Remark, Error> {
    use crate::formats::{obj, ply, stl, vtu};
    match format {
        Format::Ply => ply::write(out, solid)?,
        Format::Obj => obj::write(out, solid)?,
        Format::Stl => return Ok(stl::write(out, solid)?),
        Format::Vtu => vtu::write(out, solid)?,
        Format::Svg | Format::Png => picture::write_solid(out, format, solid, camera)?,
        _ => return Err(Error::NotASolid(format)),
    }
    Ok(None)
}
