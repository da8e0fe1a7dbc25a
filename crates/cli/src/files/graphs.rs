//! Lines and polygons of files, with the points between them.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use delone_io::{Format, Graph, Rings, Source, decompressed};

use super::systems::{self, Role};
use super::{READING, apart, beside, format, format_beside, heed, open, options, tell, wrong};
use crate::args::InputArgs;
use crate::limits;
use crate::message::{Failure, lost};

/// Reads the points and segments of a command.
pub fn graph(args: &InputArgs, segments: Option<&Path>, quiet: bool) -> Result<Graph, Failure> {
    Ok(graph_with_points(args, segments, quiet)?.0)
}

/// Reads lines and polygons beside the input of a command.
pub(crate) fn graph_beside(path: &Path, quiet: bool) -> Result<Graph, Failure> {
    Ok(read_graph(&InputArgs::of(&[path.to_owned()]), None, Purpose::Lines, Role::Beside, quiet)?.0)
}

/// Reads polygons beside the input of a command, which closed lines of drawings are too.
pub(crate) fn polygons_beside(path: &Path, quiet: bool) -> Result<Graph, Failure> {
    Ok(read_graph(&InputArgs::of(&[path.to_owned()]), None, Purpose::Polygons, Role::Beside, quiet)?.0)
}

/// Reads the polygons of a command, which closed lines of drawings are too.
///
/// # Errors
/// If there is none.
pub(crate) fn polygons(args: &InputArgs, quiet: bool) -> Result<Graph, Failure> {
    let graph = read_graph(args, None, Purpose::Polygons, Role::Input, quiet)?.0;
    if graph.rings.is_empty() && !graph.cloud.xy.is_empty() {
        let help = "give files of polygons; delone mesh and delone triangulate take lines and points";
        return Err(Failure::new(format!("{}: there is no polygon in it", args.label().display()), help));
    }
    Ok(graph)
}

/// Reads the points and segments of a command, and says which files of points were read beside those that were named.
pub(crate) fn graph_with_points(
    args: &InputArgs,
    segments: Option<&Path>,
    quiet: bool,
) -> Result<(Graph, Vec<PathBuf>), Failure> {
    read_graph(args, segments, Purpose::Lines, Role::Input, quiet)
}

/// Whether closed lines of drawings are lines or polygons.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Purpose {
    Lines,
    Polygons,
}

fn read_graph(
    args: &InputArgs,
    segments: Option<&Path>,
    purpose: Purpose,
    role: Role,
    quiet: bool,
) -> Result<(Graph, Vec<PathBuf>), Failure> {
    let mut besides = Vec::new();
    let options = options(args, 2).closed(purpose == Purpose::Polygons);
    let mut all = Graph::default();
    for path in &args.input {
        let format = format(path, args.from, "--from")?;
        let failed = |error| wrong(path, format, &error);
        let (source, _phase) = open(path, format, READING, quiet)?;
        let mut open = beside(path);
        let mut beside = |extension: &str| {
            let source = open(extension)?;
            besides.push(delone_io::side(path, extension));
            Ok(source)
        };
        let mut graph = delone_io::read_graph(source, format, &options, Some(&mut beside)).map_err(failed)?;
        heed(&mut graph.cloud, path, role, quiet)?;
        all.join(graph).map_err(failed)?;
        limits::check_points(all.cloud.xy.len(), path)?;
        tell(&mut all.cloud, None, quiet);
    }
    if let Some(path) = segments {
        let format = format_beside(path)?;
        let failed = |error| wrong(path, format, &error);
        let (source, _phase) = open(path, format, READING, quiet)?;
        let more = delone_io::read_segments(source, format).map_err(failed)?;
        let count = all.cloud.xy.len();
        let wrong = |(s, ends): (usize, &[usize; 2])| ends.iter().find(|&&i| i >= count).map(|&i| (s, i));
        if let Some((segment, index)) = more.iter().enumerate().find_map(wrong) {
            return Err(Failure::graph(path, &delone::Error::NoSuchPoint { segment, index, count }));
        }
        if let Some(markers) = &mut all.markers {
            markers.resize(markers.len() + more.len(), 0);
        }
        all.is_border.resize(all.is_border.len() + more.len(), true);
        all.segments.extend(more);
    }
    Ok((all, besides))
}

/// Whether a file is one of lines and polygons. Of standard input, and of pipes, the format alone tells.
pub(crate) fn holds_lines(path: &Path, format: Format) -> bool {
    let nothing: Box<dyn Source> = Box::new(Cursor::new(Vec::new()));
    let content = if path.is_file() { apart::source(path) } else { Ok(nothing) };
    let content = content.map_err(delone_io::Error::from).and_then(|source| decompressed(source, format));
    content.is_ok_and(|source| delone_io::holds_lines(source, format))
}

/// Reads the rings of polygons.
pub(crate) fn rings(path: &Path, quiet: bool) -> Result<Rings, Failure> {
    let format = format_beside(path)?;
    let (source, _phase) = open(path, format, READING, quiet)?;
    let found = delone_io::read_rings_beside(source, format, &mut beside(path));
    let mut found = found.map_err(|error| wrong(path, format, &error))?;
    found.losses.iter().for_each(|loss| lost(quiet, format_args!("{}: {loss}", path.display())));
    systems::find_system(&mut found.crs, path, Role::Beside, quiet)?;
    Ok(found)
}
