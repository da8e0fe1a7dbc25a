//! A triangulation of any kind to be written, whole or without what is left out of it.

use std::collections::HashMap;
use std::io::Write;

use delone::{Coordinates, Corners, Middle2, RegionSeed2, Triangulation, VertexId};

use crate::formats::vector::Layer;
use crate::formats::{
    adcirc, geojson, geopackage, inp, medit, msh, nastran, npy, obj, off, ply, poly, sms, stl, su2, triangle,
    vector, vtu, wkb, wkt, xdmf,
};
use crate::middles::{Middles, ordered};
use crate::{
    Attributes, Contents, Crs, Direction, Error, Format, Names, Remark, Shape, Table, Trim, picture,
    write_solid,
};

/// A triangulation to be written, with what lies beside it.
///
/// ```
/// use delone::{Delaunay2, Delaunay3};
/// use delone_io::{Format, Mesh, picture, write_mesh};
///
/// let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
/// let triangulation = Delaunay2::from_points(&points)?;
/// let mut file = Vec::new();
/// write_mesh(&mut file, Format::Ele, &Mesh::new(&triangulation, &points), &picture::Options::default())?;
/// assert_eq!(file, b"1 3 0\n0 0 1 2\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Mesh<'a, T: Triangulation> {
    /// The triangulation.
    pub triangulation: &'a T,
    /// All points of the input by id, those that are no vertices too.
    pub points: &'a [T::Point],
    /// In the plane, the height of each of them.
    pub heights: Option<&'a [f64]>,
    /// The system of coordinates; formats that can say it do.
    pub crs: Option<&'a Crs>,
    /// The number of the first point in Triangle's formats, 0 or 1.
    pub base: usize,
    /// Simplices that are left out.
    pub trim: Option<&'a Trim>,
    /// The edges that were asked for.
    pub constraints: Option<&'a Constraints<'a>>,
    /// The region of each simplex, by its index.
    pub regions: Option<&'a [f64]>,
    /// Names of regions, and of boundaries by their markers.
    pub names: Option<&'a Names>,
    /// The attributes of the polygons that triangles are in, which GeoJSON, FlatGeobuf and GeoPackage have.
    pub features: Option<Rows<'a>>,
    /// Values of the points by id, which `.node` and `.poly` files have instead of heights.
    pub attributes: Option<&'a Attributes>,
    /// A number for each of the points, for `.node` and `.poly` files.
    pub point_markers: Option<&'a [i64]>,
    /// Whether `.edge` files have a marker for each edge.
    pub edge_markers: bool,
    /// In the plane, whether triangles have six nodes: their corners and the middles of their edges. These follow the points, by the
    /// ends of their edges in order; heights and attributes of a middle are means, and its marker is that of the edge. Not
    /// all formats hold that: see [`Drawable::check_second_order`].
    pub second_order: bool,
    /// Middles of edges that are on arcs, by the ends of their edges; all others are halfway between the ends.
    pub arc_middles: &'a [Middle2],
    /// In the plane, for each triangle by index the index of the one that it makes a quadrilateral with. Not all formats hold that: see
    /// [`Drawable::check_quads`]. Elements are of first order then.
    pub partners: Option<&'a [Option<usize>]>,
    /// The type of elements in `.inp` files, if it is not the usual one, such as `CPS6`.
    pub element: Option<&'a str>,
}

/// A row of a table for each simplex, by its index, or for each constraint.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a> {
    /// The table.
    pub table: &'a Table,
    /// The row of each, if it has one.
    pub of: &'a [Option<usize>],
}

/// The constraints of a triangulation, and what a `.poly` file says beside them.
///
/// ```
/// use std::io::Cursor;
/// use delone::{Constrained2, Fill, Seeds2, Triangulation};
/// use delone_io::{Constraints, Format, Mesh, ReadOptions, Trim, picture, read_graph, write_mesh};
///
/// // A triangle with a triangular hole.
/// let text = "6 2 0 0\n0 0 0\n1 9 0\n2 0 9\n3 1 1\n4 4 1\n5 1 4\n6 0\n0 0 1\n1 1 2\n2 2 0\n3 3 4\n4 4 5\n5 5 3\n1\n0 2 2\n";
/// let graph = read_graph(Box::new(Cursor::new(text)), Format::Poly, &ReadOptions::default(), None)?;
/// let c = Constrained2::from_parts(&graph.cloud.xy, &graph.segments)?;
/// let seeds = Seeds2::default().holes(graph.holes.clone());
/// let domains = c.domains(&Fill::Seeds(&seeds))?;
/// let trim = Trim::keeping(&c, |t| domains.is_inside(t));
/// let edges: Vec<_> = c.constraints().collect();
/// let constraints = Constraints { edges: &edges, holes: &graph.holes, ..Constraints::default() };
/// let mesh = Mesh { trim: Some(&trim), constraints: Some(&constraints), ..Mesh::new(&c, &graph.cloud.xy) };
/// let mut file = Vec::new();
/// write_mesh(&mut file, Format::Svg, &mesh, &picture::Options::default())?;
/// assert_eq!((mesh.simplex_count(), trim.count()), (6, 1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Constraints<'a> {
    /// The edges, each once.
    pub edges: &'a [[VertexId; 2]],
    /// A number for each of them.
    pub markers: Option<&'a [i64]>,
    /// The attributes of the lines that they are on, which GeoPackage has in a layer of its own, `lines`.
    pub features: Option<Rows<'a>>,
    /// Points in areas that are left out.
    pub holes: &'a [[f64; 2]],
    /// Points in areas that have an attribute.
    pub regions: &'a [RegionSeed2],
}

impl<'a, T: Triangulation> Mesh<'a, T> {
    /// Corners of a simplex.
    pub(crate) const WIDTH: usize = T::Point::COUNT + 1;

    /// All of a triangulation.
    pub fn new(triangulation: &'a T, points: &'a [T::Point]) -> Self {
        Self {
            triangulation,
            points,
            heights: None,
            crs: None,
            base: 0,
            trim: None,
            constraints: None,
            regions: None,
            names: None,
            features: None,
            attributes: None,
            point_markers: None,
            edge_markers: true,
            second_order: false,
            arc_middles: &[],
            partners: None,
            element: None,
        }
    }

    fn keeps(&self, s: T::Simplex) -> bool {
        self.trim.is_none_or(|trim| trim.keeps(self.triangulation.index(s)))
    }

    /// The finite simplices that are not left out.
    pub(crate) fn simplices(&self) -> impl Iterator<Item = T::Simplex> + Send + '_ {
        self.triangulation.simplices().filter(|&s| self.keeps(s))
    }

    /// How many there are.
    pub fn simplex_count(&self) -> usize {
        self.triangulation.simplex_count() - self.trim.map_or(0, Trim::count)
    }

    /// The simplex across the facet opposite to corner `k`, if it is not left out.
    pub(crate) fn across(&self, s: T::Simplex, k: usize) -> Option<T::Simplex> {
        self.triangulation.across(s, k).filter(|&next| self.keeps(next))
    }

    /// The corners of each simplex as indices of points.
    pub(crate) fn rows(&self) -> impl Iterator<Item = impl Iterator<Item = usize>> + Send + '_ {
        self.simplices().map(|s| self.triangulation.corners(s).indices())
    }

    /// The nodes of a simplex: its corners, and then the middles of a triangle from corner 1 to 2, 2 to 3 and 3 to 1.
    pub(crate) fn nodes(
        &self,
        s: T::Simplex,
        middles: Option<&Middles>,
    ) -> impl Iterator<Item = usize> + use<T> {
        let corners = self.triangulation.corners(s);
        corners.indices().chain(middles.map(|middles| middles.of_triangle(corners)).into_iter().flatten())
    }

    /// The corners of the cells, each with its simplex: simplices, but for quadrilaterals, which stand for two triangles, at the place of the
    /// first one.
    pub(crate) fn cells(&self) -> impl Iterator<Item = (T::Simplex, Vec<usize>)> + '_ {
        let t = self.triangulation;
        self.simplices().filter_map(move |s| {
            let corners: Vec<usize> = t.corners(s).indices().collect();
            let Some(partner) = self.partner(s) else { return Some((s, corners)) };
            let is_across = |&k: &usize| self.across(s, k).is_some_and(|next| t.index(next) == partner);
            let k = (0..corners.len()).find(is_across)?;
            let other = t.corners(self.across(s, k)?);
            let far = other.indices().find(|corner| !corners.contains(corner))?;
            let [at, after, before] = [0, 1, 2].map(|step| corners[(k + step) % 3]);
            (t.index(s) < partner).then(|| (s, vec![at, after, far, before]))
        })
    }

    /// The index of the triangle that one makes a quadrilateral with.
    pub(crate) fn partner(&self, s: T::Simplex) -> Option<usize> {
        self.partners?.get(self.triangulation.index(s)).copied().flatten()
    }

    /// The region of each simplex that is not left out.
    pub(crate) fn region_values(&self) -> Option<impl Iterator<Item = f64> + '_> {
        let regions = self.regions?;
        let of = |s| regions.get(self.triangulation.index(s)).copied().unwrap_or_default();
        Some(self.simplices().map(of))
    }

    /// The row of each simplex that is not left out, in the table of the features.
    pub(crate) fn feature_rows(&self) -> impl Iterator<Item = Option<usize>> + '_ {
        let of = |s| self.features?.of.get(self.triangulation.index(s)).copied().flatten();
        self.simplices().map(of)
    }

    /// The markers of constraints, by the ends of these in order; those that have none are 0.
    fn constraint_markers(&self) -> HashMap<[VertexId; 2], i64> {
        let Constraints { edges, markers, .. } = self.constraints.copied().unwrap_or_default();
        let marker = |i: usize| markers.and_then(|markers| markers.get(i)).copied().unwrap_or_default();
        edges.iter().enumerate().map(|(i, &ends)| (ordered(ends), marker(i))).collect()
    }

    /// The edges with their markers: that of the constraint that the edge is, or else 1 on the border and 0 inside.
    pub(crate) fn marked_edges(&self) -> impl Iterator<Item = ([VertexId; 2], i64)> + '_ {
        let markers = self.constraint_markers();
        self.edges().map(move |(ends, is_border)| {
            let marker = markers.get(&ordered(ends)).copied().filter(|&marker| marker != 0);
            (ends, marker.unwrap_or(i64::from(is_border)))
        })
    }

    /// The edges that are constraints or on the border, with their markers.
    pub(crate) fn sides(&self) -> impl Iterator<Item = ([VertexId; 2], i64)> + '_ {
        let markers = self.constraint_markers();
        self.edges().filter_map(move |(ends, is_border)| {
            let marker = markers.get(&ordered(ends)).copied();
            let is_side = is_border || marker.is_some();
            let marker = marker.filter(|&marker| marker != 0).unwrap_or(i64::from(is_border));
            is_side.then_some((ends, marker))
        })
    }

    /// The edges on lines that have attributes, with the rows of these.
    pub(crate) fn lines(&self) -> Vec<([VertexId; 2], usize)> {
        let Some(constraints) = self.constraints else { return Vec::new() };
        let of = constraints.features.map_or(&[][..], |features| features.of);
        let rows = constraints.edges.iter().zip(of).filter_map(|(&ends, &row)| Some((ordered(ends), row?)));
        let rows: HashMap<[VertexId; 2], usize> = rows.collect();
        self.constraint_edges().iter().filter_map(|&ends| Some((ends, *rows.get(&ordered(ends))?))).collect()
    }

    /// The constraints that are edges of what is not left out.
    pub(crate) fn constraint_edges(&self) -> Vec<[VertexId; 2]> {
        let edges = self.constraints.map_or(&[][..], |constraints| constraints.edges);
        let mut wanted: Vec<[VertexId; 2]> = edges.iter().map(|&ends| ordered(ends)).collect();
        wanted.sort_unstable();
        let is_wanted = |ends: &[VertexId; 2]| wanted.binary_search(&ordered(*ends)).is_ok();
        if wanted.is_empty() { wanted } else { self.edges().map(|edge| edge.0).filter(is_wanted).collect() }
    }

    /// The edges of what is left out, those between it and the rest too.
    pub(crate) fn edges_left_out(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        let t = self.triangulation;
        t.simplices().filter(|&s| !self.keeps(s)).flat_map(move |s| pairs(t.corners(s)))
    }

    /// The coordinates of a vertex.
    pub(crate) fn point(&self, v: VertexId) -> T::Point {
        self.points[v.index()]
    }

    /// All points with three coordinates: heights are the third, or zero.
    pub(crate) fn positions(&self) -> impl Iterator<Item = [f64; 3]> + '_ {
        let height = |i: usize| self.heights.and_then(|heights| heights.get(i)).copied().unwrap_or_default();
        let position = move |(i, p): (usize, &T::Point)| {
            let coordinate = |k: usize| p.as_ref().get(k).copied();
            [0, 1, 2].map(|k| coordinate(k).unwrap_or_else(|| height(i)))
        };
        self.points.iter().enumerate().map(position)
    }

    /// The edges of what is not left out, each with whether it is on the border of that. Those of points that span less are
    /// nothing but border, and edges of no simplex that a trim would keep.
    pub(crate) fn edges(&self) -> impl Iterator<Item = ([VertexId; 2], bool)> + '_ {
        let t = self.triangulation;
        let is_spanned = t.simplices().next().is_some();
        let mut border = Vec::new();
        for s in self.simplices() {
            for k in (0..Self::WIDTH).filter(|&k| self.across(s, k).is_none()) {
                border.extend(pairs(t.corners(s)).filter(|pair| !pair.contains(&t.corners(s).as_ref()[k])));
            }
        }
        border.sort_unstable();
        // What is kept and what is left out share no edge but on the border between them.
        let mut gone: Vec<[VertexId; 2]> = Vec::new();
        if self.trim.is_some() {
            gone.extend(t.simplices().filter(|&s| !self.keeps(s)).flat_map(|s| pairs(t.corners(s))));
            gone.sort_unstable();
        }
        let shown = t.edges().filter(move |_| is_spanned || self.trim.is_none());
        shown.filter_map(move |edge| {
            let pair = ordered(edge);
            let is_border = !is_spanned || border.binary_search(&pair).is_ok();
            (is_border || gone.binary_search(&pair).is_err()).then_some((edge, is_border))
        })
    }
}

/// The edges of a simplex, by their ends in order.
fn pairs<C: Corners>(corners: C) -> impl Iterator<Item = [VertexId; 2]> {
    let count = corners.as_ref().len();
    let each = (0..count).flat_map(move |i| (i + 1..count).map(move |j| (i, j)));
    each.map(move |(i, j)| ordered([corners.as_ref()[i], corners.as_ref()[j]]))
}

impl<T: Triangulation<Point = [f64; 2]>> Shape for Mesh<'_, T> {
    fn positions(&self) -> impl Iterator<Item = [f64; 3]> {
        self.positions()
    }

    fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + Send {
        self.simplices().map(|s| {
            let corners = self.triangulation.corners(s);
            [0, 1, 2].map(|k| corners.as_ref()[k].index())
        })
    }

    fn heights(&self) -> Option<&[f64]> {
        self.heights
    }

    fn region_values(&self) -> Option<impl Iterator<Item = f64>> {
        self.region_values()
    }

    fn crs(&self) -> Option<&Crs> {
        self.crs
    }

    fn table(&self) -> Option<&Table> {
        self.features.map(|features| features.table)
    }

    fn rows(&self) -> impl Iterator<Item = Option<usize>> {
        self.feature_rows()
    }
}

/// Points whose triangulations are drawn, and written where a format holds triangles alone: those of the plane as they
/// are, those of space by their border.
pub trait Drawable: Coordinates {
    /// The contents of files of such triangulations.
    const CONTENTS: Contents;

    /// Whether triangulations of such points are written in a format if their elements are of second order.
    fn check_second_order(format: Format) -> Result<(), Error>;

    /// Whether triangulations of such points are written in a format if some triangles make quadrilaterals.
    fn check_quads(format: Format) -> Result<(), Error>;

    /// Writes the triangles of a triangulation, or draws it.
    fn write_triangles<T: Triangulation<Point = Self>>(
        out: &mut dyn Write,
        format: Format,
        mesh: &Mesh<T>,
        options: &picture::Options,
    ) -> Result<Remark, Error>;
}

impl Drawable for [f64; 2] {
    const CONTENTS: Contents = Contents::Triangles;

    fn check_second_order(format: Format) -> Result<(), Error> {
        format.check(Self::CONTENTS, Direction::Written)?;
        format.check(Contents::SecondOrder, Direction::Written)
    }

    fn check_quads(format: Format) -> Result<(), Error> {
        format.check(Self::CONTENTS, Direction::Written)?;
        format.check(Contents::Quads, Direction::Written)
    }

    fn write_triangles<T: Triangulation<Point = Self>>(
        out: &mut dyn Write,
        format: Format,
        mesh: &Mesh<T>,
        options: &picture::Options,
    ) -> Result<Remark, Error> {
        match format {
            Format::Ply => ply::write(out, mesh)?,
            Format::Obj => obj::write(out, mesh)?,
            Format::Off => off::write(out, mesh)?,
            Format::Stl => return Ok(stl::write(out, mesh)?),
            Format::GeoJson => geojson::write(out, mesh)?,
            Format::FlatGeobuf => vector::write(out, format, &vector::Triangles::of_mesh(mesh))?,
            Format::GeoPackage => {
                let (triangles, lines) = (vector::Triangles::of_mesh(mesh), vector::LinesOf::new(mesh));
                let with_lines: [&dyn vector::Layer; 2] = [&triangles, &lines];
                let layers = if lines.count() > 0 { &with_lines[..] } else { &with_lines[..1] };
                geopackage::write(out, layers)?;
            }
            Format::Poly => poly::write(out, mesh)?,
            Format::Sms => return Ok(sms::write(out, mesh)?),
            Format::Adcirc => return Ok(adcirc::write(out, mesh)?),
            Format::Wkt | Format::WktCollection => wkt::write(out, mesh, format == Format::WktCollection)?,
            Format::Wkb => wkb::write(out, mesh)?,
            Format::Svg | Format::Png => picture::write(out, format, mesh, options)?,
            _ => return Err(format.without(Self::CONTENTS, Direction::Written)),
        }
        Ok(None)
    }
}

impl Drawable for [f64; 3] {
    const CONTENTS: Contents = Contents::Tetrahedra;

    fn check_second_order(format: Format) -> Result<(), Error> {
        Err(format.without(Contents::SecondOrder, Direction::Written))
    }

    fn check_quads(format: Format) -> Result<(), Error> {
        Err(format.without(Contents::Quads, Direction::Written))
    }

    fn write_triangles<T: Triangulation<Point = Self>>(
        out: &mut dyn Write,
        format: Format,
        mesh: &Mesh<T>,
        options: &picture::Options,
    ) -> Result<Remark, Error> {
        format.check(Self::CONTENTS, Direction::Written)?;
        let mut solid = mesh.solid();
        if solid.faces.is_empty() && matches!(format, Format::Png | Format::Svg) {
            // A picture of points on a line shows them.
            solid.points = mesh.triangulation.vertices().map(|v| mesh.point(v)).collect();
        }
        write_solid(out, format, &solid, options)
    }
}

/// Writes a triangulation, or draws it as the options say. Indices in the file are those of the input points (duplicates
/// are written as points that no simplex uses), from 0 unless the format counts from 1. Of space, formats that hold
/// triangles alone get the border, with the points on it. Well-known text has a polygon a line, or one collection of them
/// ([`Format::WktCollection`]). The formats of finite elements, `msh` and `inp`, leave out points that no
/// simplex uses, and have the border and the constraints too, in groups by marker.
pub fn write_mesh<T: Triangulation<Point: Drawable>>(
    out: &mut dyn Write,
    format: Format,
    mesh: &Mesh<T>,
    options: &picture::Options,
) -> Result<Remark, Error> {
    if mesh.second_order {
        T::Point::check_second_order(format)?;
    }
    if mesh.partners.is_some() {
        T::Point::check_quads(format)?;
    }
    match format {
        Format::Npy => npy::write_simplices(out, mesh.simplex_count(), Mesh::<T>::WIDTH, mesh.rows())?,
        Format::Node => triangle::write_node(out, mesh)?,
        Format::Ele => triangle::write_ele(out, mesh)?,
        Format::Neigh => triangle::write_neigh(out, mesh)?,
        Format::Edge => triangle::write_edge(out, mesh)?,
        Format::Vtu => return Ok(vtu::write_mesh(out, mesh)?),
        Format::Msh => return Ok(msh::write(out, mesh)?),
        Format::Inp => return Ok(inp::write(out, mesh)?),
        Format::Medit => return Ok(medit::write(out, mesh)?),
        Format::Su2 => return Ok(su2::write(out, mesh)?),
        Format::Nastran => return Ok(nastran::write(out, mesh)?),
        Format::Xdmf => return Ok(xdmf::write(out, mesh)?),
        _ => return T::Point::write_triangles(out, format, mesh, options),
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Cut, Trim};
    use delone::{Delaunay2, Delaunay3};

    #[test]
    fn strips_are_trimmed() {
        // A strip of unit squares, and a point far away.
        let mut points: Vec<[f64; 2]> = (0..12).map(|i| [f64::from(i % 6), f64::from(i / 6)]).collect();
        points.push([3.0, 50.0]);
        let d = Delaunay2::from_points(&points).expect("finite");
        let trim = Trim::long_edges(&d, 2.0);
        let mesh = Mesh { trim: Some(&trim), ..Mesh::new(&d, &points) };
        assert_eq!((mesh.simplex_count(), mesh.triangles().count()), (10, 10));
        assert!(mesh.triangles().flatten().all(|i| i < 12));
        assert_eq!(mesh.edges().count(), 21);
        assert_eq!(mesh.edges().filter(|edge| edge.1).count(), 12);
    }

    #[test]
    fn bodies_are_trimmed_and_cut() {
        // A cube, and a point far above.
        let mut points: Vec<[f64; 3]> = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from)).collect();
        points.push([0.5, 0.5, 9.0]);
        let d = Delaunay3::from_points(&points).expect("finite");
        let trim = Trim::long_edges(&d, 2.0);
        let mesh = Mesh { trim: Some(&trim), ..Mesh::new(&d, &points) };
        // The top is laid open.
        let solid = mesh.solid();
        assert_eq!((solid.faces.len(), solid.laid_open.iter().filter(|&&open| open).count()), (12, 2));
        assert_eq!(mesh.edges().filter(|edge| edge.1).count(), 18);
        let cut = Cut { normal: [0.0, 0.0, 1.0], offset: 1.0 };
        assert_eq!(Trim::beyond(&d, &cut).count(), trim.count());
        assert_eq!(Trim::beyond(&d, &Cut { offset: -1.0, ..cut }).count(), d.tetrahedron_count());
    }
}
