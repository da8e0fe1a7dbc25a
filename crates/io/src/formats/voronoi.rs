//! Voronoi diagrams in Triangle's files: `.v.node` with the corners, `.v.edge` with the edges.
//!
//! Corner i is the circumcenter of triangle i of the `.ele` file, and edge i is dual to edge i of the `.edge` file: between
//! the corners of two triangles, or a ray from one. It is the diagram of the points if the triangles are those of their
//! Delaunay triangulation, all of them; of others it is merely dual. O(n log n).

use std::io::Write;

use delone::{Triangulation, VertexId};
use delone_predicates::circumcenter;

use super::triangle::NodeRows;
use crate::middles::ordered;
use crate::{Error, Mesh};

/// Writes the corners of the Voronoi diagram, as a `.node` file: the circumcenters of the triangles that are not left out, in
/// the order of the `.ele` file and counted from the base, rounded as [`circumcenter`] says. The attributes of the mesh are
/// continued linearly from the corners of the triangle; where it is too flat for that in floating point, they are means.
///
/// Time and memory linear in the triangles.
///
/// # Errors
/// [`Error::FarCenter`] names a triangle, before anything is written, whose center is no finite number.
///
/// ```
/// use delone::Delaunay2;
/// use delone_io::{Mesh, write_voronoi_edge, write_voronoi_node};
///
/// let points = [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]];
/// let triangulation = Delaunay2::from_points(&points)?;
/// let mesh = Mesh::new(&triangulation, &points);
/// let (mut nodes, mut edges) = (Vec::new(), Vec::new());
/// write_voronoi_node(&mut nodes, &mesh)?;
/// write_voronoi_edge(&mut edges, &mesh)?;
/// assert_eq!(nodes, b"1 2 0 0\n0 1.0 1.0\n");
/// assert!(edges.starts_with(b"3 0\n0 0 -1 "));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_voronoi_node<T: Triangulation<Point = [f64; 2]>>(
    out: &mut dyn Write,
    mesh: &Mesh<T>,
) -> Result<(), Error> {
    let width = mesh.attributes.map_or(0, |attributes| attributes.width);
    let mut centers = Vec::with_capacity(mesh.simplex_count());
    let mut values = Vec::with_capacity(width * mesh.simplex_count());
    for (i, s) in mesh.simplices().enumerate() {
        let corners = mesh.triangulation.corners(s);
        let corners = [0, 1, 2].map(|k| corners.as_ref()[k]);
        let [a, b, c] = corners.map(|v| mesh.point(v));
        centers.push(circumcenter(a, b, c).ok_or(Error::FarCenter { triangle: mesh.base + i })?);
        if let Some(attributes) = mesh.attributes {
            let [_, u, w] = weights([a, b, c]);
            let rows = corners.map(|v| attributes.row(v.index()));
            // Differences, so that what is the same at all corners is the same at the center.
            values.extend((0..width).map(|k| {
                let [x, y, z] = rows.map(|row| row.get(k).copied().unwrap_or_default());
                x + (u * (y - x) + w * (z - x))
            }));
        }
    }
    let rows =
        NodeRows { base: mesh.base, columns: 2, points: &centers, width, values: &values, markers: None };
    Ok(rows.write(out)?)
}

/// The weights of the corners at the circumcenter, in proportion to the sines of twice their angles. Their sum is 1.
fn weights([a, b, c]: [[f64; 2]; 3]) -> [f64; 3] {
    let squared = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2);
    let (aa, bb, cc) = (squared(b, c), squared(c, a), squared(a, b));
    let raw = [aa * (bb + cc - aa), bb * (cc + aa - bb), cc * (aa + bb - cc)];
    let sum: f64 = raw.iter().sum();
    let weights = raw.map(|weight| weight / sum);
    if weights.iter().all(|weight| weight.is_finite()) { weights } else { [1.0 / 3.0; 3] }
}

/// Writes the edges of the Voronoi diagram, as a `.edge` file without markers: the dual of each edge of a triangle that is not
/// left out, in the order of the `.edge` file. Where a triangle is on both sides it has the numbers of two corners in the `.v.node`
/// file; on the border, that of one, -1, and a vector away from the triangle across its edge, as long as that, never zero.
///
/// See [`write_voronoi_node`].
///
/// # Errors
/// What the system says.
pub fn write_voronoi_edge<T: Triangulation<Point = [f64; 2]>>(
    out: &mut dyn Write,
    mesh: &Mesh<T>,
) -> Result<(), Error> {
    // Each side of a triangle: its ends in order, the triangle, and its ends with the triangle on the left.
    let mut sides: Vec<([VertexId; 2], usize, [VertexId; 2])> = Vec::with_capacity(3 * mesh.simplex_count());
    for (i, s) in mesh.simplices().enumerate() {
        let corners = mesh.triangulation.corners(s);
        let corner = |k: usize| corners.as_ref()[k % 3];
        sides.extend(
            (0..3).map(|k| [corner(k), corner(k + 1)]).map(|ends| (ordered(ends), mesh.base + i, ends)),
        );
    }
    sides.sort_unstable();
    let beside = |ends: [VertexId; 2]| {
        let start = sides.partition_point(|side| side.0 < ends);
        sides[start..].iter().take_while(move |side| side.0 == ends).take(2)
    };
    let edges: Vec<_> =
        mesh.edges().map(|edge| ordered(edge.0)).filter(|&ends| beside(ends).count() > 0).collect();
    writeln!(out, "{} 0", edges.len())?;
    for (i, &ends) in edges.iter().enumerate() {
        write!(out, "{}", mesh.base + i)?;
        let mut triangles = 0;
        for side in beside(ends) {
            write!(out, " {}", side.1)?;
            triangles += 1;
        }
        if let (1, Some(side)) = (triangles, beside(ends).next()) {
            let [dx, dy] = away(side.2.map(|v| mesh.point(v)));
            write!(out, " -1 {dx:?} {dy:?}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// A vector to the right of an edge, as long as that, or half as long if it is too long for a number.
fn away([from, to]: [[f64; 2]; 2]) -> [f64; 2] {
    let vector = [to[1] - from[1], from[0] - to[0]];
    if vector.iter().all(|x| x.is_finite()) {
        return vector;
    }
    [to[1] / 2.0 - from[1] / 2.0, from[0] / 2.0 - to[0] / 2.0]
}
