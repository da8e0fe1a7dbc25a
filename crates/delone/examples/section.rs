//! Tetrahedra of a ball, seen from above where a plane cuts them: `cargo run --example section` leaves `section.svg`.
#![expect(
    clippy::disallowed_macros,
    clippy::disallowed_methods,
    reason = "what the library must not do, its users may"
)]

mod picture;

use delone::{Delaunay3, Triangulation};
use delone_generators::Kind3;
use picture::Picture;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let d = Delaunay3::from_points(&Kind3::Ball.points(2000, 1))?;
    let mut picture = Picture::new([-1.05, -1.05], [1.05, 1.05]);
    let mut cut = 0;
    for corners in d.simplices().map(|t| d.corners(t)) {
        let points = corners.map(|v| d.point(v));
        let [below, above]: [Vec<_>; 2] =
            [false, true].map(|up| points.into_iter().filter(|p| (p[2] > 0.0) == up).collect());
        // The plane z = 0 meets each edge between the two sides.
        let mut section: Vec<[f64; 2]> = Vec::new();
        for p in &below {
            for q in &above {
                let t = p[2] / (p[2] - q[2]);
                section.push([0, 1].map(|k| p[k] + t * (q[k] - p[k])));
            }
        }
        if section.len() == 4 {
            section.swap(2, 3); // around the quadrilateral
        }
        if section.len() > 2 {
            cut += 1;
            picture.polygon(&section, f64::from(cut % 9) / 9.0);
        }
    }
    println!("{} tetrahedra, {cut} of them cut", d.tetrahedron_count());
    Ok(picture.save("section.svg")?)
}
