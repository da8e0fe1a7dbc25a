//! Lines and polygons of longitude and latitude that cross the meridian of 180 degrees or hold a pole: told, or cut there.
//!
//! As plane coordinates, an edge from 179 to -179 degrees goes around the world. `--antimeridian cut` goes the short way, as RFC 7946 says in
//! section 3.1.9 (`parts`). Walks along longitudes are in `turns`, the new graph is in `rebuild`.

mod cut;
mod parts;
mod rebuild;
mod turns;

use std::path::Path;

use delone_io::{Crs, Format, Graph, GraphRing, Rings};

use crate::args::{AntimeridianName, InputArgs};
use crate::files;
use crate::message::{Failure, note};
use crate::stats::Stats;
use parts::Pole;
use turns::{LARGEST_LONGITUDE_DEGREES, POLE_DEGREES, jumps, reduced};

/// The meaning of coordinates.
enum System {
    /// They are longitude and latitude, by a name or by the format.
    Degrees { is_named: bool },
    /// They are something else, or nobody knows of this name.
    Other,
    /// Nothing says.
    Unsaid,
}

impl System {
    fn of(crs: Option<&Crs>, formats: &[Option<Format>]) -> Self {
        match crs {
            Some(crs) if crs.is_longitude_latitude() => Self::Degrees { is_named: true },
            Some(_) => Self::Other,
            // RFC 7946, section 4.
            None if formats.contains(&Some(Format::GeoJson)) => Self::Degrees { is_named: false },
            None => Self::Unsaid,
        }
    }
}

/// The formats of files.
fn formats(input: &InputArgs) -> Vec<Option<Format>> {
    input.input.iter().map(|path| input.from.or_else(|| Format::of(path).ok())).collect()
}

/// Cuts the lines and polygons of a command, or tells which of them cross the meridian.
pub(crate) fn heed(
    graph: &mut Graph,
    how: Option<AntimeridianName>,
    input: &InputArgs,
    stats: &mut Stats,
    quiet: bool,
) -> Result<(), Failure> {
    heed_files(graph, how, &input.label(), &formats(input), stats, quiet)
}

/// Reads the rings of polygons beside the input of a command, and cuts them, or tells which of them cross the meridian.
pub(crate) fn rings_beside(
    path: &Path,
    how: Option<AntimeridianName>,
    stats: &mut Stats,
    quiet: bool,
) -> Result<Vec<Vec<[f64; 2]>>, Failure> {
    let format = files::format_beside(path)?;
    let is_cut = how == Some(AntimeridianName::Cut);
    let mut graph = if is_cut && files::holds_lines(path, format) {
        files::polygons_beside(path, quiet)?
    } else {
        of_rings(files::rings(path, quiet)?)
    };
    heed_files(&mut graph, how, path, &[Some(format)], stats, quiet)?;
    let corners = |ring: &GraphRing| {
        graph.segments[ring.segments.clone()].iter().map(|&[start, _]| graph.cloud.xy[start]).collect()
    };
    Ok(graph.rings.iter().map(corners).collect())
}

/// Rings as those of one polygon.
fn of_rings(Rings { rings, crs, .. }: Rings) -> Graph {
    let mut graph = Graph::default();
    graph.cloud.crs = crs;
    for (number, ring) in rings.into_iter().enumerate() {
        let (start, n) = (graph.cloud.xy.len(), ring.len());
        graph.cloud.xy.extend(ring);
        graph.segments.extend((0..n).map(|i| [start + i, start + (i + 1) % n]));
        graph.rings.push(GraphRing { polygon: 0, ring: number, segments: start..start + n });
    }
    graph
}

/// Moves points by whole turns into longitudes from -180 to 180, if that is asked for.
pub(crate) fn heed_points(
    points: &mut Vec<[f64; 2]>,
    crs: Option<&Crs>,
    how: Option<AntimeridianName>,
    input: &InputArgs,
    stats: &mut Stats,
    quiet: bool,
) -> Result<(), Failure> {
    if how == Some(AntimeridianName::Cut) {
        let mut graph = Graph::default();
        (graph.cloud.xy, graph.cloud.crs) = (std::mem::take(points), crs.cloned());
        heed(&mut graph, how, input, stats, quiet)?;
        *points = graph.cloud.xy;
    }
    Ok(())
}

fn heed_files(
    graph: &mut Graph,
    how: Option<AntimeridianName>,
    label: &Path,
    formats: &[Option<Format>],
    stats: &mut Stats,
    quiet: bool,
) -> Result<(), Failure> {
    let system = System::of(graph.cloud.crs.as_ref(), formats);
    if how != Some(AntimeridianName::Cut) {
        if let System::Degrees { is_named } = system
            && (is_named || graph.cloud.xy.iter().all(are_degrees))
        {
            tell(graph, label, quiet);
        }
        return Ok(());
    }
    if let (System::Other, Some(crs)) = (system, &graph.cloud.crs) {
        let label = label.display();
        return Err(Failure::new(
            format!(
                "{label}: --antimeridian cut is for longitude and latitude, and its coordinates are {crs}"
            ),
            "leave the option out, or transform the file first: ogr2ogr -t_srs OGC:CRS84 does so",
        ));
    }
    // The outer rings of RFC 7946 are counter-clockwise; other formats have other rules, or none.
    let by_direction = formats.iter().all(|&format| format == Some(Format::GeoJson));
    cut::cut(graph, by_direction, label, stats, quiet)
}

/// Whether numbers can be longitude and latitude.
fn are_degrees(&[x, y]: &[f64; 2]) -> bool {
    x.abs() <= LARGEST_LONGITUDE_DEGREES && y.abs() <= POLE_DEGREES
}

/// Tells how many edges jump, and which rings go around a pole by that.
fn tell(graph: &Graph, label: &Path, quiet: bool) {
    let xy = &graph.cloud.xy;
    let jumps = |segment: &usize| {
        let [a, b] = graph.segments[*segment].map(|i| xy[i]);
        are_degrees(&a) && are_degrees(&b) && jumps(a, b)
    };
    let Some(first) = (0..graph.segments.len()).find(jumps) else { return };
    let count = (first..graph.segments.len()).filter(jumps).count();
    let goes_around = |ring: &&GraphRing| {
        let corners = || graph.segments[ring.segments.clone()].iter().map(|ends| ends.map(|i| xy[i]));
        ring.segments.clone().any(|segment| jumps(&segment))
            && corners().all(|[a, _]| are_degrees(&a))
            && corners().map(|[a, b]| turns::turns(a, b)).sum::<i32>() != 0
    };
    let mut around = graph.rings.iter().filter(goes_around);
    let poles = match around.next() {
        Some(ring) => format!("; rings around a pole: {} ({})", 1 + around.count(), name_of(ring)),
        None => String::new(),
    };
    let (label, place) = (label.display(), place_of(graph, first));
    note(
        quiet,
        format_args!(
            "{label}: edges whose longitudes differ by more than 180 degrees: {count} ({place}){poles}; they are taken as they stand, and --antimeridian cut goes the short way"
        ),
    );
}

/// The name of a ring in messages.
fn name_of(ring: &GraphRing) -> String {
    format!("polygon {}, ring {}", ring.polygon, ring.ring)
}

/// The name in messages of what a segment is of.
fn place_of(graph: &Graph, segment: usize) -> String {
    let ring = graph.rings.iter().find(|ring| ring.segments.contains(&segment));
    match (ring, graph.row_of_segment(segment)) {
        (Some(ring), _) => name_of(ring),
        (None, Some(row)) => format!("row {row}"),
        (None, None) => format!("segment {segment}"),
    }
}

impl std::fmt::Display for Pole {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::South => "the south pole",
            Self::North => "the north pole",
        })
    }
}
