//! Why predicates have to be exact: `cargo run --example exactness` leaves `exactness.svg`, the orientation of points beside a line,
//! rounded on the left and exact on the right.
#![expect(
    clippy::disallowed_macros,
    clippy::disallowed_methods,
    reason = "what the library must not do, its users may"
)]

mod picture;

use delone::Delaunay2;
use picture::Picture;

/// Squares on each side.
const SIDE: usize = 64;

/// The determinant as it is written, rounded at each step.
fn rounded([a, b, c]: [[f64; 2]; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The area by the triangulation of the points, which has a triangle unless they are on a line.
fn exact(points: [[f64; 2]; 3]) -> Result<f64, delone::Error> {
    let d = Delaunay2::from_points(&points)?;
    // The triangle is counter-clockwise: are its corners in the order of the points?
    let turn = |t: [delone::VertexId; 3]| {
        let first = t.iter().position(|v| v.index() == 0).unwrap_or(0);
        if t[(first + 1) % 3].index() == 1 { 1.0 } else { -1.0 }
    };
    Ok(d.triangles().next().map_or(0.0, turn))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut picture = Picture::new([0.0, 0.0], [2.2, 1.0]);
    let size = 1.0 / SIDE as f64;
    for (side, is_exact) in [(0.0, false), (1.2, true)] {
        for y in 0..SIDE {
            let sign = |x: usize| -> Result<f64, delone::Error> {
                let near = |k: usize| 0.5 + k as f64 * f64::EPSILON / 2.0;
                let points = [[near(x), near(y)], [12.0, 12.0], [24.0, 24.0]];
                let sign = if is_exact { exact(points)? } else { rounded(points) };
                Ok(if sign == 0.0 { 0.0 } else { sign.signum() })
            };
            let row: Vec<f64> = (0..SIDE).map(sign).collect::<Result<_, _>>()?;
            // Equal neighbors are one box.
            let mut start = 0;
            for run in row.chunk_by(|a, b| a == b) {
                let ends = [start, start + run.len()].map(|x| side + x as f64 * size);
                let [low, high] = [y, y + 1].map(|y| y as f64 * size);
                let shade = 0.55 + run[0] * if run[0] > 0.0 { 0.45 } else { 0.55 };
                picture.polygon(&[[ends[0], low], [ends[1], low], [ends[1], high], [ends[0], high]], shade);
                start += run.len();
            }
        }
    }
    Ok(picture.save("exactness.svg")?)
}
