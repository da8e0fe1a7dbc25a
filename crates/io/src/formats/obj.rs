//! Wavefront: vertices (`v x y z`), faces (`f a b c`), lines (`l a b c ...`). Other lines are passed over, and named.

use std::collections::BTreeSet;
use std::io::{self, Write};

use super::in_space;
use super::lines::{Line, Lines};
use crate::error::{excerpt, listed};
use crate::polyhedra::Polyhedra;
use crate::{Cloud, Crs, Error, Graph, Shape, Source};

pub(crate) fn read_points(source: Box<dyn Source>) -> Result<Cloud, Error> {
    read(source, |_, _, _| Ok(()))
}

/// Reads points, and the segments of lines.
pub(crate) fn read_graph(source: Box<dyn Source>) -> Result<Graph, Error> {
    let mut ends: Vec<([u64; 2], usize)> = Vec::new();
    let cloud = read(source, |line, words, vertices| {
        let corners = words.map(|word| corner(line, word, vertices)).collect::<Result<Vec<_>, _>>()?;
        ends.extend(corners.windows(2).map(|side| ([side[0], side[1]], line.number)));
        Ok(())
    })?;
    let mut graph = Graph::of_points(cloud);
    for (side, line) in ends {
        // Lines may come before their vertices.
        if let Some(&far) = side.iter().find(|&&end| end >= graph.cloud.xy.len() as u64) {
            return Err(Error::Line { line, what: format!("there is no vertex {}", far + 1) });
        }
        graph.segments.push(side.map(|end| end as usize));
    }
    graph.is_border = vec![false; graph.segments.len()];
    Ok(graph)
}

/// Whether there is a line in it.
pub(crate) fn has_lines(source: Box<dyn Source>) -> bool {
    let mut lines = Lines::new(source);
    while let Ok(Some(line)) = lines.next() {
        if line.text.split_whitespace().next() == Some("l") {
            return true;
        }
    }
    false
}

/// Reads vertices; `take` is given lines with their words and the number of vertices before.
fn read(
    source: Box<dyn Source>,
    mut take: impl FnMut(&Line, std::str::SplitWhitespace, i64) -> Result<(), Error>,
) -> Result<Cloud, Error> {
    let mut lines = Lines::new(source);
    let mut cloud = Cloud::with_capacity(0, true);
    let mut is_first = true;
    let mut others = BTreeSet::new();
    let mut has_values = false;
    while let Some(line) = lines.next_whole()? {
        let (text, remark) = line.text.split_once('#').unwrap_or((line.text, ""));
        if cloud.crs.is_none() {
            cloud.crs = remark.trim().strip_prefix("crs ").and_then(Crs::of_name);
        }
        let mut words = text.split_whitespace();
        let Some(keyword) = words.next() else { continue };
        if std::mem::take(&mut is_first) && !is_keyword(keyword) {
            return Err(line.error(format!("{:?} begins no line of an OBJ file", excerpt(text.trim()))));
        }
        match keyword {
            "v" => {
                let xy = [line.number(words.next(), "x")?, line.number(words.next(), "y")?];
                cloud.push(xy, line.number(words.next(), "z")?);
                // A weight, or a color.
                has_values |= words.next().is_some();
            }
            "l" => take(&line, words, cloud.xy.len() as i64)?,
            "f" | "p" => {}
            _ if !others.contains(keyword) => {
                others.insert(keyword.to_owned());
            }
            _ => {}
        }
    }
    cloud.lose_values(has_values.then_some("numbers after z").into_iter());
    if !others.is_empty() {
        let names = listed(others.iter().map(String::as_str));
        cloud.losses.push(format!("lines of other kinds are left out: {names}"));
    }
    Ok(cloud)
}

/// Whether a word begins lines of OBJ files: all keywords are short, of small letters, and some have a digit.
fn is_keyword(word: &str) -> bool {
    const LONGEST: usize = 16;
    word.len() <= LONGEST
        && word.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
        && word.starts_with(|c: char| c.is_ascii_lowercase())
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

/// Writes cells as objects of polygons.
pub(crate) fn write_polyhedra(out: &mut dyn Write, cells: &Polyhedra) -> io::Result<()> {
    if let Some(number) = cells.crs.and_then(|crs| crs.epsg) {
        writeln!(out, "# crs EPSG:{number}")?;
    }
    for [x, y, z] in &cells.vertices {
        writeln!(out, "v {x:?} {y:?} {z:?}")?;
    }
    for site in cells.present() {
        writeln!(out, "o site_{site}")?;
        for (_, ring) in cells.faces(site) {
            write!(out, "f")?;
            ring.iter().try_for_each(|corner| write!(out, " {}", u64::from(*corner) + 1))?;
            writeln!(out)?;
        }
    }
    Ok(())
}

pub(crate) fn write_points<const D: usize>(out: &mut dyn Write, points: &[[f64; D]]) -> io::Result<()> {
    points.iter().map(in_space).try_for_each(|[x, y, z]| writeln!(out, "v {x:?} {y:?} {z:?}"))
}

#[cfg(test)]
mod tests {
    use super::read_points;

    #[test]
    fn another_content_is_told() {
        let read = |text: &'static str| read_points(Box::new(std::io::Cursor::new(text)));
        for text in ["x,y,z\n1,2,3\n", "1 2 3\n", "OFF\n1 0 0\n", "{}\n"] {
            let error = read(text).expect_err(text).to_string();
            assert!(error.contains("line 1") && error.contains("no line of an OBJ file"), "{error}");
        }
        assert_eq!(read("# nothing\n\nmtllib a.mtl\n").expect("no points").xy.len(), 0);
        assert_eq!(read("").expect("no points").xy.len(), 0);
        let cloud =
            read("# crs EPSG:25832\nvn 0 0 1\nv 1 2 3 # here\nusemtl red\nv 4 5 6 255 0 0\nvn 0 0 1\n");
        let cloud = cloud.expect("two points");
        assert_eq!(cloud.xy, [[1.0, 2.0], [4.0, 5.0]]);
        assert_eq!(cloud.crs, Some(crate::Crs::of_epsg(25832)));
        assert_eq!(
            cloud.losses,
            [
                "values of points are left out: numbers after z",
                "lines of other kinds are left out: usemtl, vn"
            ]
        );
    }
}
