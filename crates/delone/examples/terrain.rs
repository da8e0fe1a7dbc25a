//! Heights on a hill, triangulated in the plane and shaded: `cargo run --example terrain` leaves `terrain.svg`.
#![expect(
    clippy::disallowed_macros,
    clippy::disallowed_methods,
    reason = "what the library must not do, its users may"
)]

mod picture;

use delone::{Delaunay2, VertexMap};
use delone_generators::Kind;
use picture::Picture;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let points = Kind::Uniform.points(2000, 1);
    let d = Delaunay2::from_points(&points)?;
    let height = |[x, y]: [f64; 2]| (7.0 * x).sin() * (5.0 * y).cos() + x;
    let heights: VertexMap<f64> = d.vertices().map(|v| (v, height(d.point(v)))).collect();
    let mut picture = Picture::new([0.0, 0.0], [1.0, 1.0]);
    for triangle in d.triangles() {
        let middle = triangle.iter().map(|&v| heights[v]).sum::<f64>() / 3.0;
        picture.polygon(&triangle.map(|v| d.point(v)), (middle + 1.0) / 3.0);
    }
    println!("{} triangles", d.triangle_count());
    Ok(picture.save("terrain.svg")?)
}
