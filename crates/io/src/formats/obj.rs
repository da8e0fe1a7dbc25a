//! Wavefront: `v x y z` and `f a b c` lines; everything else is passed over.

use std::io::{self, Write};

use super::in_space;
use super::lines::{Line, Lines};
use crate::{Cloud, Error, Shape, Source};

pub(crate) fn read_points(source: Box<dyn Source>) -> Result<Cloud, Error> {
    let mut lines = Lines::new(source);
    let mut cloud = Cloud::with_capacity(0, true);
    while let Some(line) = lines.next()? {
        let mut words = line.text.split_whitespace();
        if words.next() == Some("v") {
            let xy = [line.number(words.next(), "x")?, line.number(words.next(), "y")?];
            cloud.push(xy, line.number(words.next(), "z")?);
        }
    }
    Ok(cloud)
}

/// Reads triangles; texture and normal indices (`a/b/c`) are dropped, negative ones count back from the last
/// vertex.
pub(crate) fn read_triangles(source: Box<dyn Source>) -> Result<Vec<[u64; 3]>, Error> {
    let mut lines = Lines::new(source);
    let mut vertices = 0;
    let mut triangles = Vec::new();
    while let Some(line) = lines.next()? {
        let mut words = line.text.split_whitespace();
        match words.next() {
            Some("v") => vertices += 1,
            Some("f") => {
                let corners =
                    words.map(|word| corner(&line, word, vertices)).collect::<Result<Vec<_>, _>>()?;
                let triangle = corners.try_into();
                triangles.push(triangle.map_err(|list: Vec<u64>| {
                    line.error(format!("a face of {} corners, not 3", list.len()))
                })?);
            }
            _ => {}
        }
    }
    Ok(triangles)
}

fn corner(line: &Line, word: &str, vertices: i64) -> Result<u64, Error> {
    let index: i64 = line.number(word.split('/').next(), "a corner")?;
    let index = if index < 0 { vertices + index } else { index - 1 };
    u64::try_from(index).map_err(|_| line.error(format!("there is no vertex {word}")))
}

pub(crate) fn write(out: &mut dyn Write, shape: &impl Shape) -> io::Result<()> {
    if let Some(number) = shape.crs().and_then(|crs| crs.epsg) {
        writeln!(out, "# crs EPSG:{number}")?;
    }
    for [x, y, z] in shape.positions() {
        writeln!(out, "v {x:?} {y:?} {z:?}")?;
    }
    for [a, b, c] in shape.triangles() {
        writeln!(out, "f {} {} {}", a + 1, b + 1, c + 1)?;
    }
    Ok(())
}

pub(crate) fn write_points<const D: usize>(out: &mut dyn Write, points: &[[f64; D]]) -> io::Result<()> {
    points.iter().map(in_space).try_for_each(|[x, y, z]| writeln!(out, "v {x:?} {y:?} {z:?}"))
}
