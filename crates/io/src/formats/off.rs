//! Object files of Geomview (`OFF`): vertices, and triangles among the faces.

use std::io::{self, Write};

use super::lines::Lines;
use crate::{Cloud, Error, Shape, Source};

/// Reads the vertices.
pub(crate) fn read_points(source: Box<dyn Source>) -> Result<Cloud, Error> {
    let mut lines = Lines::new(source);
    let (vertices, _) = counts(&mut lines)?;
    let mut cloud = Cloud::with_capacity(0, true);
    for i in 0..vertices {
        let Some(line) = lines.next()? else {
            return Err(Error::Truncated(format!("after {i} of {vertices} points")));
        };
        let mut words = line.text.split_whitespace();
        let xy = [line.number(words.next(), "x")?, line.number(words.next(), "y")?];
        cloud.push(xy, line.number(words.next(), "z")?);
    }
    Ok(cloud)
}

/// Reads the faces, which must be triangles.
pub(crate) fn read_triangles(source: Box<dyn Source>) -> Result<Vec<[u64; 3]>, Error> {
    let mut lines = Lines::new(source);
    let (vertices, faces) = counts(&mut lines)?;
    for i in 0..vertices {
        if lines.next()?.is_none() {
            return Err(Error::Truncated(format!("after {i} of {vertices} points")));
        }
    }
    let mut triangles = Vec::new();
    for i in 0..faces {
        let Some(line) = lines.next()? else {
            return Err(Error::Truncated(format!("after {i} of {faces} faces")));
        };
        let mut words = line.text.split_whitespace();
        let corners: usize = line.number(words.next(), "the number of corners")?;
        if corners != 3 {
            return Err(line.error(format!("a face of {corners} corners, not 3")));
        }
        let mut corner = || line.number(words.next(), "a corner");
        triangles.push([corner()?, corner()?, corner()?]);
    }
    Ok(triangles)
}

/// Writes points, at their heights or at 0, and triangles.
pub(crate) fn write(out: &mut dyn Write, shape: &impl Shape) -> io::Result<()> {
    writeln!(out, "OFF\n{} {} 0", shape.positions().count(), shape.triangles().count())?;
    for [x, y, z] in shape.positions() {
        writeln!(out, "{x:?} {y:?} {z:?}")?;
    }
    for [a, b, c] in shape.triangles() {
        writeln!(out, "3 {a} {b} {c}")?;
    }
    Ok(())
}

/// The numbers of vertices and of faces, beside the first word or in a line of their own.
fn counts(lines: &mut Lines) -> Result<(usize, usize), Error> {
    let missing = || Error::Truncated("inside the header".to_owned());
    let first = lines.next()?.ok_or_else(missing)?;
    let rest = first.text.strip_prefix("OFF").ok_or_else(|| first.error("it does not begin with OFF"))?;
    let line = if rest.trim().is_empty() { lines.next()?.ok_or_else(missing)? } else { first };
    let mut words = line.text.split_whitespace().filter(|&word| word != "OFF");
    Ok((
        line.number(words.next(), "the number of points")?,
        line.number(words.next(), "the number of faces")?,
    ))
}
