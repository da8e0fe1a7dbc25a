//! Points that move, their triangulation kept up: `cargo run --example moving` leaves `moving.svg`, the last step.
#![expect(
    clippy::disallowed_macros,
    clippy::disallowed_methods,
    reason = "what the library must not do, its users may"
)]

mod picture;

use delone::{Moving2, Step2};
use delone_generators::{Kind, Random};
use picture::Picture;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut positions = Kind::Uniform.points(1000, 1);
    let mut moving = Moving2::from_points(&positions)?;
    let mut random = Random::new(2);
    let mut repaired = 0;
    for _ in 0..50 {
        for p in &mut positions {
            *p = p.map(|x| x + random.between(-0.003, 0.003));
        }
        repaired += usize::from(matches!(moving.step(&positions)?, Step2::Repaired { .. }));
    }
    println!("{repaired} of 50 steps were repaired");
    let d = moving.triangulation();
    let mut picture = Picture::new([-0.1, -0.1], [1.1, 1.1]);
    for (k, triangle) in d.triangles().enumerate() {
        picture.polygon(&triangle.map(|v| d.point(v)), (k % 7) as f64 / 7.0);
    }
    Ok(picture.save("moving.svg")?)
}
