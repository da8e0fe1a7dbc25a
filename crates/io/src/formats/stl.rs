//! Stereolithography: triangles with their normals, in single precision (the binary format has no other). Read in text
//! and binary, written in binary.

use std::collections::HashSet;
use std::io::{self, Write};

use delone::Bounds;
use delone_predicates::{Sign, orient2d};

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

/// How a triangle is in single precision.
enum Rounded {
    /// As it was.
    Same,
    /// Beyond the numbers of single precision.
    Infinite,
    /// Two corners are one point.
    Joined,
    /// On a line, seen from where it was seen best.
    Flat,
    /// The other way round.
    Turned,
}

/// Counts of the triangles of a surface, by outcome.
#[derive(Default)]
struct Count {
    infinite: usize,
    joined: usize,
    flat: usize,
    turned: usize,
}

/// Writes triangles. Along an axis where single precision would be too coarse they are moved towards the origin, which the title and
/// the remark tell.
///
/// Corners are rounded once, to the nearest. A triangle that this makes flat or turns over is left out of a surface over the plane. A
/// closed surface leaves out a triangle only where two of its corners become one point, and so stays closed. What single precision
/// has no number for is left out of both. The remark counts all of these.
pub(crate) fn write(out: &mut dyn Write, shape: &impl Shape) -> io::Result<Remark> {
    let origin = shift(shape);
    let mut title = [b' '; 80];
    let mut remarks = Vec::new();
    let mut text = "delone".to_owned();
    if let Some([x, y, z]) = origin.map(|origin| origin.map(|x| 0.0 - x)) {
        remarks.push(format!("moved by {x:?}, {y:?}, {z:?}, because STL has single precision only"));
        let whole = format!("delone, moved by {x:?} {y:?} {z:?}");
        // A number that is cut off would be another one.
        text = if whole.len() <= title.len() { whole } else { "delone, moved".to_owned() };
    }
    title[..text.len()].copy_from_slice(text.as_bytes());
    let positions: Vec<_> = shape.positions().map(|p| difference(p, origin.unwrap_or_default())).collect();
    let mut count = Count::default();
    let is_closed = shape.is_closed();
    let mut kept = Vec::new();
    for triangle in shape.triangles() {
        let corners = triangle.map(|i| positions[i]);
        if count.keeps(&rounded(&corners, is_closed), is_closed) {
            kept.push(corners);
        }
    }
    remarks.extend(count.remarks(shape.triangles().count(), is_closed));
    out.write_all(&title)?;
    out.write_all(&(kept.len() as u32).to_le_bytes())?;
    for corners in kept {
        let normal = normal(&corners);
        let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        let unit = normal.map(|x| if length > 0.0 { x / length } else { 0.0 });
        for x in unit.iter().chain(corners.as_flattened()) {
            out.write_all(&(*x as f32).to_le_bytes())?;
        }
        out.write_all(&[0, 0])?;
    }
    Ok((!remarks.is_empty()).then(|| remarks.join("; ")))
}

impl Count {
    /// Counts a triangle, and says whether it is written.
    fn keeps(&mut self, rounded: &Rounded, is_closed: bool) -> bool {
        let (slot, keeps) = match rounded {
            Rounded::Same => return true,
            Rounded::Infinite => (&mut self.infinite, false),
            Rounded::Joined => (&mut self.joined, false),
            Rounded::Flat => (&mut self.flat, is_closed),
            Rounded::Turned => (&mut self.turned, is_closed),
        };
        *slot += 1;
        keeps
    }

    /// Remarks on `all` triangles.
    fn remarks(&self, all: usize, is_closed: bool) -> Vec<String> {
        let Self { infinite, joined, flat, turned } = *self;
        let mut remarks = Vec::new();
        if infinite > 0 {
            remarks
                .push(format!("{infinite} of {all} triangles are left out: STL has no numbers above 3.4e38"));
        }
        if is_closed && joined > 0 {
            remarks.push(format!(
                "{joined} of {all} triangles are left out: two of their corners are one point in single precision"
            ));
        }
        if is_closed && flat + turned > 0 {
            remarks.push(format!(
                "{flat} of {all} triangles are flat in single precision and {turned} turned over: they stay, so that the surface is closed"
            ));
        }
        if !is_closed && joined + flat + turned > 0 {
            remarks.push(format!(
                "{} of {all} triangles are left out: {} are flat in single precision, {turned} turned over",
                joined + flat + turned,
                joined + flat
            ));
        }
        remarks
    }
}

/// A triangle in single precision. Triangles over the plane are seen from above, those around a body along the axis that
/// is the nearest to their normal.
fn rounded(corners: &[[f64; 3]; 3], is_closed: bool) -> Rounded {
    let single = corners.map(|p| p.map(|x| f64::from(x as f32)));
    if single.as_flattened().iter().any(|x| !x.is_finite()) {
        return Rounded::Infinite;
    }
    let [a, b, c] = single;
    if a == b || b == c || c == a {
        return Rounded::Joined;
    }
    let from = if is_closed {
        let normal = normal(corners).map(f64::abs);
        (0..3).fold(2, |best, axis| if normal[axis] > normal[best] { axis } else { best })
    } else {
        2
    };
    let seen = |corners: &[[f64; 3]; 3]| {
        let [p, q, r] = corners.map(|p| [p[(from + 1) % 3], p[(from + 2) % 3]]);
        orient2d(p, q, r)
    };
    match (seen(corners), seen(&single)) {
        (before, after) if before == after => Rounded::Same,
        (_, Sign::Zero) => Rounded::Flat,
        (Sign::Zero, _) => Rounded::Same,
        _ => Rounded::Turned,
    }
}

/// A normal of a triangle, of any length.
fn normal(&[a, b, c]: &[[f64; 3]; 3]) -> [f64; 3] {
    let (u, v) = (difference(b, a), difference(c, a));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// Rounding along an axis may be this part of the extent along it, before coordinates are moved.
const COARSEST: f64 = 1e-6;

/// The shift of the coordinates along each axis: none where rounding is fine enough, else a number of few digits below them.
fn shift(shape: &impl Shape) -> Option<[f64; 3]> {
    let bounds = Bounds::of(shape.positions());
    let extent = bounds.extent();
    let origin = [0, 1, 2].map(|k| {
        let (low, extent) = (bounds.low[k], extent[k]);
        let largest = low.abs().max(bounds.high[k].abs());
        let is_coarse = largest * f64::from(f32::EPSILON) > extent * COARSEST;
        if !(is_coarse && extent > 0.0 && largest.is_finite()) {
            return 0.0;
        }
        // Whole numbers, or decimals no coarser than the extent.
        let scale = 10f64.powi((-libm::log10(extent)).ceil().max(0.0) as i32);
        let floor = (low * scale).floor() / scale;
        if floor.is_finite() { floor } else { low }
    });
    (origin != [0.0; 3]).then_some(origin)
}

fn difference(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    [p[0] - q[0], p[1] - q[1], p[2] - q[2]]
}
