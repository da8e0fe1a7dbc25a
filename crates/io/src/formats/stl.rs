//! Binary stereolithography: triangles with their normals, in single precision (the format has no other).

use std::io::{self, Write};

use crate::Shape;

pub(crate) fn write(out: &mut dyn Write, shape: &impl Shape) -> io::Result<()> {
    let mut title = [b' '; 80];
    title[..6].copy_from_slice(b"delone");
    out.write_all(&title)?;
    out.write_all(&(shape.triangles().count() as u32).to_le_bytes())?;
    let positions: Vec<_> = shape.positions().collect();
    for triangle in shape.triangles() {
        let corners @ [a, b, c] = triangle.map(|i| positions[i]);
        let (u, v) = (difference(b, a), difference(c, a));
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        let unit = normal.map(|x| if length > 0.0 { x / length } else { 0.0 });
        for x in unit.iter().chain(corners.as_flattened()) {
            out.write_all(&(*x as f32).to_le_bytes())?;
        }
        out.write_all(&[0, 0])?;
    }
    Ok(())
}

fn difference(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    [p[0] - q[0], p[1] - q[1], p[2] - q[2]]
}
