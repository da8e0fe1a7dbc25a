//! Sites, relaxed, and their cells in a polygon with a hole: `cargo run --example cells` leaves `cells.svg`.
#![expect(
    clippy::disallowed_macros,
    clippy::disallowed_methods,
    reason = "what the library must not do, its users may"
)]

mod picture;

use delone::{Delaunay2, Region2, Relaxation2};
use delone_generators::Kind;
use picture::Picture;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let outer = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.5, 0.7], [0.0, 1.0]];
    let hole = vec![[0.4, 0.2], [0.6, 0.2], [0.5, 0.4]];
    let region = Region2::polygon(&[outer, hole])?;
    let sites = Delaunay2::from_points(&Kind::Uniform.points(400, 1))?;
    let sites = Relaxation2::default().steps(40).tolerance(1e-3).run(&sites, &region, |_, _| {})?;
    let relaxed = Delaunay2::from_points(&sites)?;
    let cells = relaxed.voronoi().clip(&region);
    let mut picture = Picture::new([0.0, 0.0], [1.0, 1.0]);
    for site in relaxed.vertices() {
        for ring in cells.rings(site) {
            picture.polygon(&ring.points().collect::<Vec<_>>(), 200.0 * cells.area(site).min(0.005));
        }
    }
    let total: f64 = relaxed.vertices().map(|v| cells.area(v)).sum();
    println!("the cells have {total:.6} of {:.6}", region.area());
    Ok(picture.save("cells.svg")?)
}
