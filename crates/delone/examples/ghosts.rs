//! The hull is no end: `cargo run --example ghosts` leaves `ghosts.svg`, triangles and the wedges that ghost triangles stand for.
#![expect(
    clippy::disallowed_macros,
    clippy::disallowed_methods,
    reason = "what the library must not do, its users may"
)]

mod picture;

use delone::Delaunay2;
use picture::Picture;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let points: Vec<[f64; 2]> =
        (1..24).map(f64::from).map(|i| [(i * 0.618).fract(), (i * 0.414).fract()]).collect();
    let d = Delaunay2::from_points(&points)?;
    let mut picture = Picture::new([-0.4, -0.4], [1.4, 1.4]);
    let hull: Vec<[f64; 2]> = d.hull_vertices().map(|v| d.point(v)).collect();
    for (i, &p) in hull.iter().enumerate() {
        let q = hull[(i + 1) % hull.len()];
        // Far away from the middle of all.
        let far = |p: [f64; 2]| p.map(|x| 0.5 + (x - 0.5) * 1.7);
        picture.polygon(&[p, far(p), far(q), q], 0.9);
    }
    for t in d.triangles() {
        picture.polygon(&t.map(|v| d.point(v)), 0.3);
    }
    Ok(picture.save("ghosts.svg")?)
}
