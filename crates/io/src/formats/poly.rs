//! The `.poly` files of Shewchuk's Triangle: points, segments between them, holes, regions; and its `.area` files. Indices
//! are from 0 or from 1, as the first point says; for all points and all ends of segments it is the same.
//!
//! Names are comments of ours: `# boundary 2 inlet` and `# region 1 steel`, anywhere in the file.

use std::io::{self, Write};

use delone::{RegionSeed2, Triangulation};

use super::lines::{Line, Lines};
use super::osmosis;
use super::triangle::{NodeRows, Nodes, RESERVED_ROWS, count};
use crate::{Cloud, Constraints, Error, Graph, Mesh, Names, Rings, Source};

/// Opens a file beside the one that is read, by its extension.
pub type Beside<'a> = &'a mut dyn FnMut(&str) -> Result<Box<dyn Source>, Error>;

/// Reads a graph. Where the file has no points, they are in the `.node` file beside it.
pub(crate) fn read(mut source: Box<dyn Source>, beside: Option<Beside>) -> Result<Graph, Error> {
    if osmosis::is_one(&mut source)? {
        return osmosis::read(source)?.graph();
    }
    let mut lines = Lines::of_triangle(source);
    lines.keep_comments();
    let mut nodes = Nodes::read(&mut lines, true)?;
    if nodes.cloud.xy.is_empty() {
        let open = beside.ok_or(Error::PointsElsewhere)?;
        nodes = Nodes::read(&mut Lines::of_triangle(open("node")?), true)?;
    }
    if nodes.is_in_space {
        return Err(Error::content(
            "its points are in space: this is a file of TetGen, with facets, not of Triangle",
        ));
    }
    let mut graph = nodes.graph();
    let (base, points) = (graph.cloud.base, graph.cloud.xy.len());
    let end = |line: &Line, word: Option<&str>| end(line, word, base, points);
    let (segments, markers) = segments(&mut lines, end)?;
    graph.is_border = vec![true; segments.len()];
    (graph.segments, graph.markers) = (segments, markers);
    graph.holes = holes(&mut lines)?;
    graph.regions = regions(&mut lines, &mut graph.cloud.remarks)?;
    if let Some(line) = lines.next()? {
        return Err(line.error("more follows than the counts before it say"));
    }
    graph.names = names(&lines.comments())?;
    Ok(graph)
}

/// The names in comments; other comments are none.
fn names(comments: &[String]) -> Result<Names, Error> {
    let mut names = Names::default();
    for comment in comments {
        let comment = comment.trim();
        let Some((kind, rest)) = comment.split_once(char::is_whitespace) else { continue };
        let parts = |c: char| c.is_whitespace() || c == '=' || c == ':';
        let Some((number, name)) = rest.trim().split_once(parts) else { continue };
        let name = name.trim_start_matches(parts);
        match (&kind.to_ascii_lowercase()[..], number.parse(), number.parse()) {
            ("boundary", Ok(marker), _) => names.name_boundary(marker, name)?,
            ("region", _, Ok(number)) => names.name_region(number, name)?,
            _ => {}
        }
    }
    Ok(names)
}

/// Whether the points of a file are in the `.node` file beside it: its first number, which counts them, is 0.
pub fn has_points_beside(source: Box<dyn Source>) -> Result<bool, Error> {
    let mut lines = Lines::of_triangle(source);
    let line = lines.next()?;
    let word = line.as_ref().and_then(|line| line.text.split_whitespace().next());
    Ok(word.and_then(|word| word.parse().ok()) == Some(0))
}

/// Reads the points alone.
pub(crate) fn read_points(mut source: Box<dyn Source>) -> Result<Cloud, Error> {
    if osmosis::is_one(&mut source)? {
        return Ok(osmosis::read(source)?.graph()?.cloud);
    }
    let nodes = Nodes::read(&mut Lines::of_triangle(source), false)?;
    if nodes.cloud.xy.is_empty() { Err(Error::PointsElsewhere) } else { Ok(nodes.cloud) }
}

/// Reads the rings of polygons, or else all points as one ring.
pub(crate) fn read_rings(mut source: Box<dyn Source>) -> Result<Rings, Error> {
    if osmosis::is_one(&mut source)? {
        return Ok(osmosis::read(source)?.rings());
    }
    Ok(Rings { rings: vec![read_points(source)?.xy], ..Rings::default() })
}

/// Reads segments alone. Where there are no points, the number of the first segment tells the base.
pub(crate) fn read_segments(source: Box<dyn Source>) -> Result<Vec<[usize; 2]>, Error> {
    let mut lines = Lines::of_triangle(source);
    let nodes = Nodes::read(&mut lines, false)?;
    let points = nodes.cloud.xy.len();
    if points == 0 {
        return numbered(&mut lines);
    }
    Ok(segments(&mut lines, |line, word: Option<&str>| end(line, word, nodes.cloud.base, points))?.0)
}

/// Reads the edges of an `.edge` file, which are like segments: the number of the first tells the base.
pub(crate) fn read_edges(source: Box<dyn Source>) -> Result<Vec<[usize; 2]>, Error> {
    numbered(&mut Lines::of_triangle(source))
}

/// Segments of points that are elsewhere.
fn numbered(lines: &mut Lines) -> Result<Vec<[usize; 2]>, Error> {
    let mut base = None;
    let end = |line: &Line, word: Option<&str>| {
        let base = *base.get_or_insert_with(|| {
            let first = line.text.split_whitespace().next().and_then(|word| word.parse::<usize>().ok());
            first.unwrap_or(0).min(1)
        });
        end(line, word, base, usize::MAX - 1)
    };
    Ok(segments(lines, end)?.0)
}

/// An end of a segment as an index from 0.
fn end(line: &Line, word: Option<&str>, base: usize, points: usize) -> Result<usize, Error> {
    let number: usize = line.number(word, "an end of the segment")?;
    match number.checked_sub(base) {
        None => Err(line.error("a segment ends at point 0 in a file that counts from 1")),
        Some(_) if points == 0 => Err(line.error("a segment, but there are no points")),
        Some(index) if index >= points => {
            let counts =
                format!("there is no point {number}: they are numbered from {base} to {}", points - 1 + base);
            let other = if base == 0 && number == points { "; do the segments count from 1?" } else { "" };
            Err(line.error(format!("{counts}{other}")))
        }
        Some(index) => Ok(index),
    }
}

/// Segments, and their markers where there are any.
type Marked = (Vec<[usize; 2]>, Option<Vec<i64>>);

/// Segments: `count markers`, then `index from to marker` each.
fn segments(
    lines: &mut Lines,
    mut end: impl FnMut(&Line, Option<&str>) -> Result<usize, Error>,
) -> Result<Marked, Error> {
    let Some(line) = lines.next()? else {
        return Err(Error::Truncated("before the number of segments".to_owned()));
    };
    let words: Vec<&str> = line.text.split_whitespace().collect();
    let number = heading(&line, &words, 2, "segments")?;
    let has_markers = words.get(1).is_some_and(|&word| word != "0");
    let mut segments = Vec::with_capacity(number.min(RESERVED_ROWS));
    let mut markers = has_markers.then(Vec::new);
    for i in 0..number {
        let Some(line) = lines.next()? else {
            return Err(Error::Truncated(format!("after {i} of {number} segments")));
        };
        let mut words = line.text.split_whitespace();
        _ = line.number::<usize>(words.next(), "the number of the segment")?;
        segments.push([end(&line, words.next())?, end(&line, words.next())?]);
        if let Some(markers) = &mut markers {
            // Triangle lets them be left out.
            markers.push(words.next().map_or(Ok(0), |word| line.number(Some(word), "the marker"))?);
        }
    }
    Ok((segments, markers))
}

/// Holes: `count`, then `index x y` each.
fn holes(lines: &mut Lines) -> Result<Vec<[f64; 2]>, Error> {
    let Some(line) = lines.next()? else {
        return Err(Error::Truncated("before the number of holes".to_owned()));
    };
    let words: Vec<&str> = line.text.split_whitespace().collect();
    let number = heading(&line, &words, 1, "holes")?;
    let mut holes = Vec::with_capacity(number.min(RESERVED_ROWS));
    for i in 0..number {
        let Some(line) = lines.next()? else {
            return Err(Error::Truncated(format!("after {i} of {number} holes")));
        };
        let mut words = line.text.split_whitespace();
        _ = line.number::<usize>(words.next(), "the number of the hole")?;
        holes.push([line.number(words.next(), "x")?, line.number(words.next(), "y")?]);
    }
    Ok(holes)
}

/// Regions, if there are any: `count`, then `index x y attribute area` each. As in Triangle, one value alone is both, and an
/// area that is not positive is none.
fn regions(lines: &mut Lines, remarks: &mut Vec<String>) -> Result<Vec<RegionSeed2>, Error> {
    let Some(line) = lines.next()? else { return Ok(Vec::new()) };
    let words: Vec<&str> = line.text.split_whitespace().collect();
    let number = heading(&line, &words, 1, "regions")?;
    let mut regions = Vec::with_capacity(number.min(RESERVED_ROWS));
    let mut alone = 0;
    for i in 0..number {
        let Some(line) = lines.next()? else {
            return Err(Error::Truncated(format!("after {i} of {number} regions")));
        };
        let mut words = line.text.split_whitespace();
        _ = line.number::<usize>(words.next(), "the number of the region")?;
        let at = [line.number(words.next(), "x")?, line.number(words.next(), "y")?];
        let attribute = line.number(words.next(), "the attribute")?;
        let area = match words.next() {
            Some(word) => line.number(Some(word), "the largest area")?,
            None => attribute,
        };
        let max_area = (area > 0.0).then_some(area);
        alone += usize::from(words.next().is_none() && line.text.split_whitespace().count() == 4);
        regions.push(RegionSeed2::new(at).attribute(attribute).max_area(max_area));
    }
    if alone > 0 {
        remarks.push(format!("the one value of {alone} regions was taken as attribute and as largest area"));
    }
    Ok(regions)
}

/// The count that begins a part, which has at most so many numbers: a row in its place shows that the count of the part
/// before is wrong.
fn heading(line: &Line, words: &[&str], most: usize, what: &str) -> Result<usize, Error> {
    if words.len() > most {
        let found = words.len();
        return Err(line.error(format!("{found} numbers where the number of {what} is expected")));
    }
    line.number(words.first().copied(), &format!("the number of {what}"))
}

/// The largest areas of triangles, in their order: `count`, then `index area` each, where what is not positive is no bound.
pub(crate) fn read_areas(source: Box<dyn Source>) -> Result<Vec<Option<f64>>, Error> {
    let mut lines = Lines::of_triangle(source);
    let number = count(&mut lines, "triangles")?;
    let mut areas = Vec::with_capacity(number.min(RESERVED_ROWS));
    for i in 0..number {
        let Some(line) = lines.next()? else {
            return Err(Error::Truncated(format!("after {i} of {number} areas")));
        };
        let mut words = line.text.split_whitespace();
        _ = line.number::<usize>(words.next(), "the number of the triangle")?;
        let area: f64 = line.number(words.next(), "the area")?;
        areas.push((area > 0.0).then_some(area));
    }
    Ok(areas)
}

/// Writes a graph, with all that it has; a graph without attributes writes its heights as one.
pub(crate) fn write_graph(out: &mut dyn Write, graph: &Graph) -> io::Result<()> {
    let Graph { cloud, attributes, point_markers, names, .. } = graph;
    let (width, values) = match &cloud.z {
        Some(heights) if attributes.width == 0 => (1, heights),
        _ => (attributes.width, &attributes.values),
    };
    let (base, points, markers) = (cloud.base, &cloud.xy[..], point_markers.as_deref());
    NodeRows { base, columns: 2, points, width, values, markers }.write(out)?;
    let Graph { segments, markers, holes, regions, .. } = graph;
    Rest { segments, markers: markers.as_deref(), holes, regions, names: Some(names) }.write(out, cloud.base)
}

/// Writes the points of a mesh, and its constraints as segments; the border where there are none. The middles of edges are no
/// points of a graph, whatever the order of the triangles is.
pub(crate) fn write<T: Triangulation<Point = [f64; 2]>>(
    out: &mut dyn Write,
    mesh: &Mesh<T>,
) -> io::Result<()> {
    NodeRows::of_mesh(mesh).write(out)?;
    let Some(&Constraints { edges, markers, holes, regions, .. }) = mesh.constraints else {
        let border = mesh.edges().filter(|edge| edge.1);
        let segments: Vec<_> = border.map(|(ends, _)| ends.map(|v| v.index())).collect();
        let markers = vec![1; segments.len()];
        let rest = Rest {
            segments: &segments,
            markers: Some(&markers),
            holes: &[],
            regions: &[],
            names: mesh.names,
        };
        return rest.write(out, mesh.base);
    };
    let segments: Vec<_> = edges.iter().map(|ends| ends.map(|v| v.index())).collect();
    Rest { segments: &segments, markers, holes, regions, names: mesh.names }.write(out, mesh.base)
}

/// The part of a file after the points.
struct Rest<'a> {
    segments: &'a [[usize; 2]],
    markers: Option<&'a [i64]>,
    holes: &'a [[f64; 2]],
    regions: &'a [RegionSeed2],
    names: Option<&'a Names>,
}

impl Rest<'_> {
    /// Writes it, counted from the base.
    fn write(&self, out: &mut dyn Write, base: usize) -> io::Result<()> {
        writeln!(out, "{} {}", self.segments.len(), u8::from(self.markers.is_some()))?;
        for (i, ends) in self.segments.iter().enumerate() {
            let [from, to] = ends.map(|end| base + end);
            write!(out, "{} {from} {to}", base + i)?;
            if let Some(markers) = self.markers {
                write!(out, " {}", markers.get(i).copied().unwrap_or_default())?;
            }
            writeln!(out)?;
        }
        writeln!(out, "{}", self.holes.len())?;
        for (i, [x, y]) in self.holes.iter().enumerate() {
            writeln!(out, "{} {x:?} {y:?}", base + i)?;
        }
        if !self.regions.is_empty() {
            writeln!(out, "{}", self.regions.len())?;
        }
        for (i, RegionSeed2 { at: [x, y], attribute, max_area, .. }) in self.regions.iter().enumerate() {
            writeln!(out, "{} {x:?} {y:?} {attribute:?} {:?}", base + i, max_area.unwrap_or(-1.0))?;
        }
        let Some(names) = self.names else { return Ok(()) };
        // No name ends the line of its comment.
        let on_line = |name: &str| name.replace(char::is_control, "_");
        for (marker, name) in names.boundaries() {
            writeln!(out, "# boundary {marker} {}", on_line(name))?;
        }
        for (number, name) in names.regions() {
            writeln!(out, "# region {number:?} {}", on_line(name))?;
        }
        Ok(())
    }
}
