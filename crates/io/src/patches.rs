//! The triangles of many polygons, each triangulated alone, as one mesh.

use std::collections::HashSet;
use std::io::Write;

use crate::formats::{geojson, obj, ply, stl, vector, vtu, wkb, wkt};
use crate::picture::{Mark, Sketch, Tone, write_sketch};
use crate::{Contents, Crs, Direction, Error, Format, Remark, Shape, Table, write_indices};

/// Triangles of polygons, and which one each is of.
///
/// Fields may be added: a literal ends with `..` and a value to take the rest from.
#[derive(Clone, Debug, Default)]
pub struct Patches {
    /// The corners of all polygons, and what was added to them.
    pub points: Vec<[f64; 2]>,
    /// The height of each, where there are heights.
    pub heights: Option<Vec<f64>>,
    /// Triangles as indices of points.
    pub triangles: Vec<[usize; 3]>,
    /// The polygon of each triangle, from 0.
    pub polygons: Vec<usize>,
    /// The system of coordinates.
    pub crs: Option<Crs>,
    /// The attributes of the polygons, and the row of each; triangles have them in GeoJSON, FlatGeobuf and GeoPackage, and
    /// of VTK those that are numbers.
    pub table: Table,
    /// See there.
    pub rows: Vec<Option<usize>>,
}

impl Shape for Patches {
    fn positions(&self) -> impl Iterator<Item = [f64; 3]> {
        let height = |i| self.heights.as_ref().map_or(0.0, |heights: &Vec<f64>| heights[i]);
        self.points.iter().enumerate().map(move |(i, &[x, y])| [x, y, height(i)])
    }

    fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + Send {
        self.triangles.iter().copied()
    }

    fn heights(&self) -> Option<&[f64]> {
        self.heights.as_deref()
    }

    fn region_values(&self) -> Option<impl Iterator<Item = f64>> {
        Some(self.polygons.iter().map(|&polygon| polygon as f64))
    }

    fn crs(&self) -> Option<&Crs> {
        self.crs.as_ref()
    }

    fn table(&self) -> Option<&Table> {
        Some(&self.table)
    }

    fn rows(&self) -> impl Iterator<Item = Option<usize>> {
        self.polygons.iter().map(|&polygon| self.rows.get(polygon).copied().flatten())
    }
}

impl Patches {
    /// The box of all points that are somewhere.
    fn window(&self) -> [[f64; 2]; 2] {
        let mut points = self.points.iter().filter(|p| p.iter().all(|x| x.is_finite()));
        let Some(&first) = points.next() else { return [[0.0; 2], [1.0; 2]] };
        points.fold([first; 2], |[low, high], p| {
            [[0, 1].map(|k| f64::min(low[k], p[k])), [0, 1].map(|k| f64::max(high[k], p[k]))]
        })
    }

    /// Each polygon in a color of its own; points beside all triangles as dots.
    fn sketch(&self) -> Sketch {
        let corners = |triangle: &[usize; 3]| triangle.map(|i| self.points[i]);
        let patches = self.triangles.iter().zip(&self.polygons);
        let patches = patches.map(|(triangle, &polygon)| Mark::Patch(corners(triangle).to_vec(), polygon));
        let sides = self.triangles.iter().map(corners);
        let sides = sides.flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
        // A point that equals a corner is no dot.
        let bits = |p: [f64; 2]| p.map(|x| (x + 0.0).to_bits());
        let corner_bits: HashSet<_> =
            self.triangles.as_flattened().iter().map(|&i| bits(self.points[i])).collect();
        let is_shown = |p: &[f64; 2]| p.iter().all(|x| x.is_finite()) && !corner_bits.contains(&bits(*p));
        let dots = self.points.iter().copied().filter(is_shown).map(|p| Mark::Dot(p, Tone::Plain));
        Sketch {
            marks: patches.chain(sides.map(|side| Mark::Line(side, Tone::Plain))).chain(dots).collect(),
            crs: self.crs.clone(),
            ..Sketch::default()
        }
    }
}

/// Writes the triangles: npy and csv hold indices of points, a triangle a row; VTK, PLY and GeoJSON the polygon of each; a picture
/// has `size` pixels on its longer side.
pub fn write_patches(
    out: &mut dyn Write,
    format: Format,
    patches: &Patches,
    size: u32,
) -> Result<Remark, Error> {
    match format {
        Format::Npy | Format::Text => {
            let rows: Vec<i64> = patches.triangles.as_flattened().iter().map(|&i| i as i64).collect();
            write_indices(out, format, 3, &rows)?;
        }
        Format::Ply => ply::write(out, patches)?,
        Format::Obj => obj::write(out, patches)?,
        Format::Stl => return Ok(stl::write(out, patches)?),
        Format::Vtu => return Ok(vtu::write(out, patches)?),
        Format::GeoJson => geojson::write_polygons(out, patches)?,
        Format::FlatGeobuf | Format::GeoPackage => {
            vector::write(out, format, &vector::Triangles::of_patches(patches))?;
        }
        Format::Wkt | Format::WktCollection => wkt::write(out, patches, format == Format::WktCollection)?,
        Format::Wkb => wkb::write(out, patches)?,
        Format::Svg | Format::Png => write_sketch(out, format, &patches.sketch(), patches.window(), size)?,
        _ => return Err(format.without(Contents::Patches, Direction::Written)),
    }
    Ok(None)
}
