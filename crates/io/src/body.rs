//! Triangulations of space.

use std::io::Write;

use delone::{Delaunay3, TetrahedronId, VertexId};

use crate::{Crs, Error, Format, Remark, Shape, Solid, picture, write_solid};

/// A triangulation of space to be written, with all points of its input.
#[derive(Clone, Copy, Debug)]
pub struct Body<'a> {
    /// The triangulation.
    pub triangulation: &'a Delaunay3,
    /// The points by id.
    pub points: &'a [[f64; 3]],
    /// What the coordinates mean; formats that can say it do.
    pub crs: Option<&'a Crs>,
    /// What the first point is called in Triangle's formats, 0 or 1.
    pub base: usize,
}

/// A plane that takes away the tetrahedra whose middle is beyond it.
#[derive(Clone, Copy, Debug)]
pub struct Cut {
    /// The side that is taken away.
    pub normal: [f64; 3],
    /// What the scalar product of the normal and a point of the plane is.
    pub offset: f64,
}

impl Body<'_> {
    fn tetrahedra(&self) -> impl Iterator<Item = [usize; 4]> + '_ {
        self.triangulation.tetrahedra().map(|corners| corners.map(VertexId::index))
    }

    /// The hull, with the vertices on it alone, by increasing index.
    pub fn hull(&self) -> Solid {
        let facets: Vec<[usize; 3]> =
            self.triangulation.hull_facets().map(|t| t.map(VertexId::index)).collect();
        let mut used: Vec<usize> = facets.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        let place = |i: usize| used.partition_point(|&corner| corner < i);
        Solid {
            faces: facets.iter().map(|facet| facet.map(place).to_vec()).collect(),
            points: used.iter().map(|&i| self.points[i]).collect(),
            laid_open: Vec::new(),
        }
    }

    /// What a cut leaves.
    pub fn cut(&self, cut: &Cut) -> Solid {
        let (d, mesh) = (self.triangulation, self.triangulation.mesh());
        let along = |v: VertexId| -> f64 {
            let p = d.point(v);
            (0..3).map(|k| cut.normal[k] * p[k] / 4.0).sum()
        };
        let stays = |t: TetrahedronId| mesh.corners(t).into_iter().map(along).sum::<f64>() <= cut.offset;
        let mut solid = Solid { points: self.points.to_vec(), ..Solid::default() };
        for t in d.tetrahedron_ids().filter(|&t| stays(t)) {
            for facet in [0, 1, 2, 3].map(|k| t.facet(k)) {
                let next = mesh.twin(facet).tetrahedron();
                if mesh.is_ghost(next) || !stays(next) {
                    let [a, b, c] = mesh.facet_corners(facet).map(VertexId::index);
                    solid.faces.push(vec![a, c, b]);
                    solid.laid_open.push(!mesh.is_ghost(next));
                }
            }
        }
        solid
    }
}

impl Shape for Body<'_> {
    fn positions(&self) -> impl Iterator<Item = [f64; 3]> {
        self.points.iter().copied()
    }

    fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + Send {
        self.triangulation.hull_facets().map(|corners| corners.map(VertexId::index))
    }

    fn heights(&self) -> Option<&[f64]> {
        None
    }

    fn crs(&self) -> Option<&Crs> {
        self.crs
    }
}

/// Writes a triangulation of space: tetrahedra in the indices of the points, from 0; or, where the format holds
/// triangles alone, its hull; or a picture of that.
pub fn write_body(
    out: &mut dyn Write,
    format: Format,
    body: &Body,
    camera: &picture::Camera,
) -> Result<Remark, Error> {
    use crate::formats::{npy, triangle, vtu};
    match format {
        Format::Npy => {
            npy::write_simplices(out, body.triangulation.tetrahedra().count(), body.tetrahedra())?;
        }
        Format::Ele => triangle::write_ele(out, body.base, body.tetrahedra())?,
        Format::Neigh => write_neigh(out, body)?,
        Format::Node => triangle::write_points(out, body.base, body.points)?,
        Format::Vtu => vtu::write_cells(out, body, body.tetrahedra())?,
        Format::Ply | Format::Obj | Format::Stl | Format::Svg | Format::Png => {
            return write_solid(out, format, &body.hull(), camera);
        }
        _ => return Err(Error::NotABody(format)),
    }
    Ok(None)
}

/// Neighbours opposite corners 0 to 3, numbered as in the `.ele` file; -1 across the hull.
fn write_neigh(out: &mut dyn Write, body: &Body) -> std::io::Result<()> {
    let mesh = body.triangulation.mesh();
    let cells: Vec<TetrahedronId> = body.triangulation.tetrahedron_ids().collect();
    let mut numbers = vec![-1_i64; mesh.slot_count()];
    for (i, t) in cells.iter().enumerate() {
        numbers[t.index()] = (body.base + i) as i64;
    }
    writeln!(out, "{} 4", cells.len())?;
    for (i, &t) in cells.iter().enumerate() {
        let [a, b, c, d] = mesh.adjacent(t).map(|next| numbers[next.index()]);
        writeln!(out, "{} {a} {b} {c} {d}", body.base + i)?;
    }
    Ok(())
}
