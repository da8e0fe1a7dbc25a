//! Graphs as geometries: polygons, lines of what else is joined, and points of what is not; as GeoJSON or well-known text.
//!
//! Shapes repeat positions that they share, so what is read back may have more points than were written. The set of points and
//! the union of segments are the same. Cost: linear in points and segments.

use std::io::{self, Write};

use super::geojson::write_system;
use super::wkt::Geometries;
use crate::Graph;

/// The shapes of a graph, as indices of points.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Pieces {
    /// Polygons by their rings, which end where they begin.
    pub(super) polygons: Vec<Vec<Vec<usize>>>,
    pub(super) lines: Vec<Vec<usize>>,
    pub(super) alone: Vec<usize>,
}

impl Pieces {
    pub(super) fn of(graph: &Graph) -> Self {
        let mut pieces = Self::default();
        let mut in_ring = vec![false; graph.segments.len()];
        let mut last = None;
        for ring in graph.rings.iter().filter(|ring| !ring.segments.is_empty()) {
            in_ring[ring.segments.clone()].fill(true);
            let sides = &graph.segments[ring.segments.clone()];
            let corners = sides.iter().map(|side| side[0]).chain(sides.last().map(|side| side[1])).collect();
            if last != Some(ring.polygon) {
                pieces.polygons.push(Vec::new());
                last = Some(ring.polygon);
            }
            pieces.polygons.last_mut().into_iter().for_each(|polygon| polygon.push(Vec::clone(&corners)));
        }
        let mut is_joined = vec![false; graph.cloud.xy.len()];
        graph.segments.as_flattened().iter().for_each(|&i| is_joined[i] = true);
        for (&[from, to], _) in graph.segments.iter().zip(in_ring).filter(|(_, in_ring)| !in_ring) {
            match pieces.lines.last_mut() {
                Some(line) if line.last() == Some(&from) => line.push(to),
                _ => pieces.lines.push(vec![from, to]),
            }
        }
        pieces.alone = (0..is_joined.len()).filter(|&i| !is_joined[i]).collect();
        pieces
    }
}

/// How coordinates are written: what is around a position, what between its numbers, and what around a list.
struct Style {
    position: [&'static str; 2],
    between: &'static str,
    list: [&'static str; 2],
}

const JSON: Style = Style { position: ["[", "]"], between: ",", list: ["[", "]"] };
const TEXT: Style = Style { position: ["", ""], between: " ", list: ["(", ")"] };

/// A writer of positions of a graph.
struct Writer<'a> {
    graph: &'a Graph,
    style: Style,
}

impl Writer<'_> {
    fn position(&self, out: &mut dyn Write, i: usize) -> io::Result<()> {
        let Style { position: [open, close], between, .. } = self.style;
        let [x, y] = self.graph.cloud.xy[i];
        write!(out, "{open}{x:?}{between}{y:?}")?;
        if let Some(z) = &self.graph.cloud.z {
            write!(out, "{between}{:?}", z.get(i).copied().unwrap_or_default())?;
        }
        write!(out, "{close}")
    }

    /// A list of things, each written by a function.
    fn list<T>(
        &self,
        out: &mut dyn Write,
        things: &[T],
        each: impl Fn(&mut dyn Write, &T) -> io::Result<()>,
    ) -> io::Result<()> {
        write!(out, "{}", self.style.list[0])?;
        for (k, thing) in things.iter().enumerate() {
            write!(out, "{}", if k == 0 { "" } else { "," })?;
            each(out, thing)?;
        }
        write!(out, "{}", self.style.list[1])
    }

    fn chain(&self, out: &mut dyn Write, chain: &[usize]) -> io::Result<()> {
        self.list(out, chain, |out, &i| self.position(out, i))
    }

    fn chains(&self, out: &mut dyn Write, chains: &[Vec<usize>]) -> io::Result<()> {
        self.list(out, chains, |out, chain| self.chain(out, chain))
    }
}

/// Writes GeoJSON: a feature for each polygon, one for all lines, one for all points that no segment joins.
pub(crate) fn write_geojson(out: &mut dyn Write, graph: &Graph) -> io::Result<()> {
    let (pieces, writer) = (Pieces::of(graph), Writer { graph, style: JSON });
    write!(out, "{{\"type\":\"FeatureCollection\",")?;
    write_system(out, graph.cloud.crs.as_ref())?;
    write!(out, "\"features\":[")?;
    let mut separator = "";
    let mut begin = |out: &mut dyn Write, kind: &str| {
        write!(
            out,
            "{separator}\n{{\"type\":\"Feature\",\"properties\":{{}},\"geometry\":{{\"type\":\"{kind}\",\"coordinates\":"
        )?;
        separator = ",";
        Ok::<(), io::Error>(())
    };
    for polygon in &pieces.polygons {
        begin(out, "Polygon")?;
        writer.chains(out, polygon)?;
        write!(out, "}}}}")?;
    }
    if !pieces.lines.is_empty() {
        begin(out, "MultiLineString")?;
        writer.chains(out, &pieces.lines)?;
        write!(out, "}}}}")?;
    }
    if !pieces.alone.is_empty() {
        begin(out, "MultiPoint")?;
        writer.chain(out, &pieces.alone)?;
        write!(out, "}}}}")?;
    }
    writeln!(out, "\n]}}")
}

/// Writes well-known text: a geometry for each polygon, one for all lines, one for all points that no segment joins.
pub(crate) fn write_wkt(out: &mut dyn Write, graph: &Graph, in_collection: bool) -> io::Result<()> {
    let (pieces, writer) = (Pieces::of(graph), Writer { graph, style: TEXT });
    let mut geometries = Geometries::new(out, in_collection, graph.cloud.z.is_some());
    for polygon in &pieces.polygons {
        writer.chains(geometries.begin("POLYGON")?, polygon)?;
    }
    if !pieces.lines.is_empty() {
        writer.chains(geometries.begin("MULTILINESTRING")?, &pieces.lines)?;
    }
    if !pieces.alone.is_empty() {
        writer.list(geometries.begin("MULTIPOINT")?, &pieces.alone, |out, &i| {
            write!(out, "(")?;
            writer.position(out, i)?;
            write!(out, ")")
        })?;
    }
    geometries.end()
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use crate::{Cloud, Format, Graph, GraphRing, ReadOptions, read_graph, write_graph};

    fn sample() -> Graph {
        let xy = vec![
            [0.0, 0.0],
            [9.0, 0.0],
            [0.0, 9.0],
            [1.0, 1.0],
            [2.0, 1.0],
            [1.0, 2.0],
            [5.0, 5.0],
            [8.0, 8.0],
        ];
        Graph {
            cloud: Cloud { xy, ..Cloud::default() },
            segments: vec![[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [1, 6], [6, 2]],
            is_border: vec![true, true, true, true, true, true, false, false],
            rings: vec![
                GraphRing { polygon: 0, ring: 0, segments: 0..3 },
                GraphRing { polygon: 0, ring: 1, segments: 3..6 },
            ],
            ..Graph::default()
        }
    }

    /// Points and segments by their coordinates, sorted.
    fn content(graph: &Graph) -> (Vec<String>, Vec<String>) {
        let mut points: Vec<_> = graph.cloud.xy.iter().map(|p| format!("{p:?}")).collect();
        let place = |i: usize| graph.cloud.xy[i];
        let mut segments: Vec<_> =
            graph.segments.iter().map(|ends| format!("{:?}", ends.map(place))).collect();
        points.sort();
        points.dedup();
        segments.sort();
        (points, segments)
    }

    #[test]
    fn graphs_come_back() {
        let high =
            Graph { cloud: Cloud { z: Some((0..8).map(f64::from).collect()), ..sample().cloud }, ..sample() };
        for graph in [sample(), high, Graph::default()] {
            for format in
                [Format::GeoJson, Format::FlatGeobuf, Format::Wkt, Format::WktCollection, Format::Poly]
            {
                let mut file = Vec::new();
                write_graph(&mut file, format, &graph).expect("written");
                if graph.cloud.xy.is_empty() && format == Format::Poly {
                    continue;
                }
                let text = String::from_utf8_lossy(&file).into_owned();
                let back = read_graph(Box::new(Cursor::new(file)), format, &ReadOptions::default(), None);
                let back = back.unwrap_or_else(|error| panic!("{format}: {error}\n{text}"));
                assert_eq!(content(&back), content(&graph), "{text}");
                assert_eq!(back.cloud.z.is_some(), graph.cloud.z.is_some(), "{text}");
                if format != Format::Poly {
                    assert_eq!(back.rings, graph.rings, "{text}");
                }
            }
        }
    }
}
