//! Stereolithography: triangles with their normals, in single precision (the binary format has no other). Read in text
//! and binary, written in binary.

use std::collections::HashSet;
use std::io::{self, Write};

use delone::Bounds;

use super::lines::Lines;
use crate::{Cloud, Error, Remark, Shape, Source};

/// Bytes before the triangles, and of each.
const HEAD: usize = 84;
const TRIANGLE: usize = 50;

/// Reads the corners of all triangles, each point once, in the order in which they come.
pub(crate) fn read_points(mut source: Box<dyn Source>) -> Result<Cloud, Error> {
    let start = source.fill_buf()?;
    // Binary files may begin with this word too, but not with lines of text.
    let text = start.starts_with(b"solid") && !start[..start.len().min(400)].contains(&0);
    let mut corners = Corners::default();
    if text {
        let mut lines = Lines::new(source);
        while let Some(line) = lines.next()? {
            let mut words = line.text.split_whitespace();
            if words.next() == Some("vertex") {
                let mut number = |axis| line.number(words.next(), axis);
                corners.take([number("x")?, number("y")?, number("z")?]);
            }
        }
        return Ok(corners.cloud);
    }
    let mut head = [0; HEAD];
    let broken = |_| Error::Truncated("inside the header".to_owned());
    source.read_exact(&mut head).map_err(broken)?;
    let count = u32::from_le_bytes([head[80], head[81], head[82], head[83]]);
    for i in 0..count {
        let mut bytes = [0; TRIANGLE];
        let broken = |_| Error::Truncated(format!("after {i} of {count} triangles"));
        source.read_exact(&mut bytes).map_err(broken)?;
        let numbers: &[[u8; 4]] = bytes.as_chunks().0;
        // After the normal.
        for corner in numbers[3..12].as_chunks::<3>().0 {
            corners.take(corner.map(|number| f32::from_le_bytes(number).into()));
        }
    }
    Ok(corners.cloud)
}

/// Points, and those that were met.
struct Corners {
    cloud: Cloud,
    met: HashSet<[u64; 3]>,
}

impl Default for Corners {
    fn default() -> Self {
        Self { cloud: Cloud::with_capacity(0, true), met: HashSet::new() }
    }
}

impl Corners {
    fn take(&mut self, [x, y, z]: [f64; 3]) {
        // Zero has two signs.
        if self.met.insert([x, y, z].map(|value| (value + 0.0).to_bits())) {
            self.cloud.push([x, y], z);
        }
    }
}

/// Writes triangles; where single precision would be too coarse for them they are moved towards the origin, which the
/// title and the remark tell.
pub(crate) fn write(out: &mut dyn Write, shape: &impl Shape) -> io::Result<Remark> {
    let shift = shift(shape);
    let mut title = [b' '; 80];
    let mut text = "delone".to_owned();
    let remark = shift.map(|[x, y, z]| {
        text = format!("delone, moved by {:?} {:?} {:?}", -x, -y, -z);
        format!("moved by {:?}, {:?}, {:?}, because STL has single precision only", -x, -y, -z)
    });
    let length = text.len().min(title.len());
    title[..length].copy_from_slice(&text.as_bytes()[..length]);
    out.write_all(&title)?;
    out.write_all(&(shape.triangles().count() as u32).to_le_bytes())?;
    let origin = shift.unwrap_or_default();
    let positions: Vec<_> = shape.positions().map(|p| difference(p, origin)).collect();
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
    Ok(remark)
}

/// Where to move the origin to: nowhere, as long as rounding is less than a millionth of the extent.
fn shift(shape: &impl Shape) -> Option<[f64; 3]> {
    let bounds = Bounds::of(shape.positions());
    let extent = bounds.extent().into_iter().fold(0.0, f64::max);
    let largest = bounds.low.iter().chain(&bounds.high).map(|x| x.abs()).fold(0.0, f64::max);
    let coarse = largest * f64::from(f32::EPSILON) > extent * 1e-6;
    (coarse && extent > 0.0 && largest.is_finite()).then(|| bounds.low.map(f64::floor))
}

fn difference(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    [p[0] - q[0], p[1] - q[1], p[2] - q[2]]
}
