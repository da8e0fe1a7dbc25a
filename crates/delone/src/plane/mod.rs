//! Delaunay triangulations of the plane.
pub mod build;
use crate::ids::*;
use crate::mesh::*;
/// dup
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Duplicate {
    /// The index of the point that is no vertex.
    pub point: usize,
    /// The vertex that stands for it.
    pub vertex: VertexId,
}
/// D
pub struct Delaunay2 { pub points: Vec<[f64;2]>, pub mesh: Mesh, pub duplicates: Vec<Duplicate>}
impl Delaunay2 {
    pub fn from_points(points: &[[f64;2]]) -> Self {
        let (mesh, duplicates, c) = build::divide_and_conquer(points); if std::env::var("CNT").is_ok() {eprintln!("{c:?}");}
        Self { points: points.to_vec(), mesh, duplicates }
    }
}
