//! Files as the commands use them: names checked first, points read, outputs written whole.

mod apart;
mod sides;
mod systems;
mod write;

use std::io::{BufReader, Cursor, Read};
use std::path::{Path, PathBuf};

use delone::surface::Grid;
use delone_io::{Cloud, Contents, Crs, Direction, Format, Graph, Raster, ReadOptions, Source, decompressed};

pub(crate) use apart::{keep_apart, keep_names_apart};
pub(crate) use sides::write_sides;
pub(crate) use write::{
    cannot_write, create, finish, folder_of, publish, scratch, write, write_mesh, write_own,
};

use crate::args::InputArgs;
use crate::limits;
use crate::message::{Failure, note};
use crate::progress::Phase;

/// What progress says while a file is read.
const READING: &str = "reading";

/// The format of a file: as said, or by its extension.
pub(crate) fn format(path: &Path, said: Option<Format>, option: &str) -> Result<Format, Failure> {
    match said {
        Some(format) => Ok(format),
        None if is_standard(path) => Err(Failure::usage(
            "the format of - is not known",
            format!("name it with {option}, as in {option} csv"),
        )),
        None => Format::of(path).map_err(|error| Failure::file(path, &error)),
    }
}

/// The format of a file beside the input and the output, which alone may be standard ones.
pub(crate) fn format_beside(path: &Path) -> Result<Format, Failure> {
    if is_standard(path) {
        return Err(Failure::usage(
            "only the input itself can come from standard input, and only -o go to standard output",
            "name a file for this one",
        ));
    }
    format(path, None, "the extension")
}

fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

/// Whether a path is there but no file: a device or a pipe, which may be named twice.
fn is_special(path: &Path) -> bool {
    path.metadata().is_ok_and(|about| !about.is_file())
}

/// Outputs with their formats, kept apart from the inputs, from each other and from the statistics.
pub(crate) fn outputs(
    paths: &[PathBuf],
    to: Option<Format>,
    stats: Option<&Path>,
    inputs: &[&Path],
) -> Result<Vec<(PathBuf, Format)>, Failure> {
    keep_apart(inputs, paths.iter().map(PathBuf::as_path).chain(stats))?;
    let by_extension = |path: &PathBuf| {
        // With several outputs, --to is for those that do not tell by themselves.
        let known = if paths.len() > 1 { Format::of(path).ok() } else { None };
        Ok((path.clone(), known.map_or_else(|| format(path, to, "--to"), Ok)?))
    };
    let outputs = paths.iter().map(by_extension).collect::<Result<Vec<_>, _>>()?;
    systems::expect(&outputs);
    Ok(outputs)
}

/// Refuses files whose formats hold none of what could be written.
pub(crate) fn check_formats(outputs: &[(PathBuf, Format)], any: &[Contents]) -> Result<(), Failure> {
    let holds = |format: Format| any.iter().any(|&contents| format.holds(contents, Direction::Written));
    let Some((path, format)) = outputs.iter().find(|(_, format)| !holds(*format)) else { return Ok(()) };
    let what: Vec<_> = any.iter().map(ToString::to_string).collect();
    Err(Failure::usage(
        format!("{}: {} are not written to {format} files", path.display(), what.join(" or ")),
        format!("choose among {}", Format::with(any, Direction::Written)),
    ))
}

/// The format of a file of indices.
pub(crate) fn index_format(path: &Path, said: Option<Format>) -> Result<Format, Failure> {
    let format = format(path, said, "--to")?;
    check_formats(&[(path.to_owned(), format)], &[Contents::Indices])?;
    Ok(format)
}

/// Opens a file, or takes all of standard input, or of what is no file, into memory; decompresses.
pub(crate) fn open(
    path: &Path,
    format: Format,
    what: &'static str,
    quiet: bool,
) -> Result<(Box<dyn Source>, Phase), Failure> {
    let (source, phase) = open_raw(path, what, quiet)?;
    let source = decompressed(source, format).map_err(|error| Failure::file(path, &error))?;
    Ok((source, phase))
}

fn open_raw(path: &Path, what: &'static str, quiet: bool) -> Result<(Box<dyn Source>, Phase), Failure> {
    let failed = |error: std::io::Error| Failure::file(path, &error.into());
    if is_standard(path) {
        let phase = Phase::start(quiet, what);
        let mut bytes = Vec::new();
        std::io::stdin().lock().read_to_end(&mut bytes).map_err(failed)?;
        return Ok((Box::new(Cursor::new(bytes)), phase));
    }
    let mut file = apart::open(path).map_err(failed)?;
    let about = file.metadata().map_err(failed)?;
    if about.is_dir() {
        return Err(Failure::new(format!("{} is a folder", path.display()), "name a file in it"));
    }
    if !about.is_file() {
        // Nobody can go back in a pipe.
        let phase = Phase::start(quiet, what);
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(failed)?;
        return Ok((Box::new(Cursor::new(bytes)), phase));
    }
    let phase = Phase::bytes(quiet, what, about.len());
    let reader = phase.watch(BufReader::with_capacity(1 << 16, file));
    Ok((Box::new(reader), phase))
}

/// The formats of the files of a command, to which what is said of them applies.
pub(crate) fn formats(args: &InputArgs) -> Result<Vec<Format>, Failure> {
    let mut formats = Vec::new();
    for path in &args.input {
        formats.push(format(path, args.from, "--from")?);
    }
    if let Some(option) = args.las.option().filter(|_| !formats.contains(&Format::Las)) {
        return Err(Failure::usage(
            format!("{option} is for LAS and LAZ files"),
            format!("leave {option} out"),
        ));
    }
    if !args.columns.is_empty() && !formats.contains(&Format::Text) {
        return Err(Failure::usage("--columns is for text files", "leave --columns out"));
    }
    Ok(formats)
}

/// Reads the points of a command.
pub(crate) fn points(args: &InputArgs, dimension: usize, quiet: bool) -> Result<Cloud, Failure> {
    let options = ReadOptions { las: args.las.filter(), columns: args.columns.clone(), dimension };
    read_all(args, quiet, |source, format| delone_io::read_points(source, format, &options))
}

/// Reads all files of a command as one set.
fn read_all(
    args: &InputArgs,
    quiet: bool,
    read: impl Fn(Box<dyn Source>, Format) -> Result<Cloud, delone_io::Error>,
) -> Result<Cloud, Failure> {
    let formats = formats(args)?;
    let mut all = Cloud::default();
    for (path, format) in args.input.iter().zip(formats) {
        let failed = |error| Failure::file(path, &error);
        let (source, _phase) = open(path, format, READING, quiet)?;
        let cloud = read(source, format).map_err(failed)?;
        for remark in &cloud.remarks {
            note(quiet, format_args!("{}: {remark}", path.display()));
        }
        let told = all.remarks.len() + cloud.remarks.len();
        systems::heed(cloud.crs.as_ref());
        all.join(cloud).map_err(failed)?;
        limits::check_points(all.xy.len(), path)?;
        all.remarks[told..].iter().for_each(|remark| note(quiet, remark));
    }
    Ok(all)
}

/// Points, their heights, and what else the files tell.
type Surface = (Vec<[f64; 2]>, Vec<f64>, Cloud);

/// Reads the points of a command with their heights: points of any format, or cells of rasters. The cloud has the rest of what is told.
pub(crate) fn surface(args: &InputArgs, quiet: bool) -> Result<Surface, Failure> {
    let options = ReadOptions { las: args.las.filter(), columns: args.columns.clone(), dimension: 3 };
    let mut all = read_all(args, quiet, |source, format| delone_io::read_surface(source, format, &options))?;
    need_heights(all.z.as_deref(), &args.label())?;
    Ok((std::mem::take(&mut all.xy), all.z.take().unwrap_or_default(), all))
}

/// Refuses points without heights.
pub(crate) fn need_heights(heights: Option<&[f64]>, label: &Path) -> Result<(), Failure> {
    if heights.is_some() {
        return Ok(());
    }
    let help = "give points with a third coordinate, or a raster; of text choose them with --columns x,y,z";
    Err(Failure::new(format!("{}: the points have no heights", label.display()), help))
}

/// Reads the raster of a command, if that is what its only input surely is.
pub(crate) fn raster(args: &InputArgs, quiet: bool) -> Result<Option<Raster>, Failure> {
    let (formats, [path]) = (formats(args)?, &args.input[..]) else { return Ok(None) };
    let Some(&format @ (Format::Tiff | Format::Asc)) = formats.first() else { return Ok(None) };
    read_raster(path, format, quiet).map(Some)
}

/// Reads a raster.
pub(crate) fn read_raster(path: &Path, format: Format, quiet: bool) -> Result<Raster, Failure> {
    let (source, _phase) = open(path, format, READING, quiet)?;
    let raster = delone_io::read_raster(source, format).map_err(|error| Failure::file(path, &error))?;
    raster.remarks.iter().for_each(|remark| note(quiet, remark));
    Ok(raster)
}

/// Reads where the cells of a raster are, and the system of its coordinates.
pub(crate) fn place(path: &Path, quiet: bool) -> Result<(Grid, Option<Crs>), Failure> {
    let format = format_beside(path)?;
    let (source, _phase) = open(path, format, READING, quiet)?;
    delone_io::read_raster_place(source, format).map_err(|error| Failure::file(path, &error))
}

/// Reads the points and segments of a command.
pub(crate) fn graph(args: &InputArgs, segments: Option<&Path>, quiet: bool) -> Result<Graph, Failure> {
    Ok(graph_with_points(args, segments, quiet)?.0)
}

/// The same, and says which files of points were read beside those that were named.
pub(crate) fn graph_with_points(
    args: &InputArgs,
    segments: Option<&Path>,
    quiet: bool,
) -> Result<(Graph, Vec<PathBuf>), Failure> {
    let mut besides = Vec::new();
    let options = ReadOptions { las: args.las.filter(), columns: args.columns.clone(), dimension: 2 };
    let mut all = Graph::default();
    for path in &args.input {
        let format = format(path, args.from, "--from")?;
        let failed = |error| Failure::file(path, &error);
        let (source, _phase) = open(path, format, READING, quiet)?;
        let mut beside = |extension: &str| {
            let beside = path.with_extension(extension);
            let named = |error: std::io::Error| {
                std::io::Error::new(error.kind(), format!("its points in {}: {error}", beside.display()))
            };
            let points = apart::source(&beside).map_err(named)?;
            besides.push(beside);
            Ok(points)
        };
        let graph = delone_io::read_graph(source, format, &options, Some(&mut beside)).map_err(failed)?;
        for remark in &graph.cloud.remarks {
            note(quiet, format_args!("{}: {remark}", path.display()));
        }
        let told = all.cloud.remarks.len() + graph.cloud.remarks.len();
        systems::heed(graph.cloud.crs.as_ref());
        all.join(graph).map_err(failed)?;
        limits::check_points(all.cloud.xy.len(), path)?;
        all.cloud.remarks[told..].iter().for_each(|remark| note(quiet, remark));
    }
    if let Some(path) = segments {
        let format = format_beside(path)?;
        let failed = |error| Failure::file(path, &error);
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

/// Reads a number for each point.
pub(crate) fn numbers(path: &Path, quiet: bool) -> Result<Vec<f64>, Failure> {
    let format = format_beside(path)?;
    let (source, _phase) = open(path, format, READING, quiet)?;
    delone_io::read_numbers(source, format).map_err(|error| Failure::file(path, &error))
}

/// What to do where a number for each point is not found.
const NUMBERS: &str = "name a file with one for each point, or a column of a text file";

/// Refuses a column of files that have none.
pub(crate) fn check_column(args: &InputArgs, name: &str) -> Result<(), Failure> {
    for path in &args.input {
        if is_standard(path) || format(path, args.from, "--from")? != Format::Text {
            let what = format!("{name} is no file, and {} has no columns to look for it in", path.display());
            return Err(Failure::usage(what, NUMBERS));
        }
    }
    Ok(())
}

/// Reads a column of the points' own files, by name or number from 1.
pub(crate) fn column(args: &InputArgs, name: &str, quiet: bool) -> Result<Vec<f64>, Failure> {
    let mut all = Vec::new();
    for path in &args.input {
        let options = ReadOptions { columns: vec![name.to_owned(); 2], ..ReadOptions::default() };
        let (source, _phase) = open(path, Format::Text, READING, quiet)?;
        let cloud = delone_io::read_points(source, Format::Text, &options).map_err(|error| {
            let what = format!("{}: {name} is no file, and as a column: {error}", path.display());
            Failure::new(what, NUMBERS)
        })?;
        all.extend(cloud.xy.into_iter().map(|[number, _]| number));
    }
    Ok(all)
}

/// Reads points that are asked for.
pub(crate) fn queries(path: &Path, dimension: usize, quiet: bool) -> Result<Cloud, Failure> {
    cloud(path, &ReadOptions { dimension, ..ReadOptions::default() }, quiet)
}

/// Reads the points of a file beside those of the input.
pub(crate) fn cloud(path: &Path, options: &ReadOptions, quiet: bool) -> Result<Cloud, Failure> {
    let format = format_beside(path)?;
    let (source, _phase) = open(path, format, READING, quiet)?;
    let cloud =
        delone_io::read_points(source, format, options).map_err(|error| Failure::file(path, &error))?;
    for remark in &cloud.remarks {
        note(quiet, format_args!("{}: {remark}", path.display()));
    }
    Ok(cloud)
}

/// Whether a file is one of lines and polygons. Of standard input, and of pipes, the format alone tells.
pub(crate) fn holds_lines(path: &Path, format: Format) -> bool {
    let nothing: Box<dyn Source> = Box::new(Cursor::new(Vec::new()));
    let content = if path.is_file() { apart::source(path) } else { Ok(nothing) };
    let content = content.map_err(delone_io::Error::from).and_then(|source| decompressed(source, format));
    content.is_ok_and(|source| delone_io::holds_lines(source, format))
}

/// Reads the rings of polygons.
pub(crate) fn rings(path: &Path, quiet: bool) -> Result<Vec<Vec<[f64; 2]>>, Failure> {
    let format = format_beside(path)?;
    let (source, _phase) = open(path, format, READING, quiet)?;
    delone_io::read_rings(source, format).map_err(|error| Failure::file(path, &error))
}

/// Reads a text.
pub(crate) fn text(path: &Path, quiet: bool) -> Result<String, Failure> {
    let (mut source, _phase) = open(path, Format::Text, READING, quiet)?;
    let mut bytes = Vec::new();
    source.read_to_end(&mut bytes).map_err(|error| Failure::file(path, &error.into()))?;
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        Failure::new(format!("{}: byte {at} is not text", path.display()), "give a text file")
    })
}

/// Reads the simplices of a mesh, or what else is said of them.
pub(crate) fn simplices<T>(
    path: &Path,
    quiet: bool,
    read: impl Fn(Box<dyn Source>, Format) -> Result<T, delone_io::Error>,
) -> Result<T, Failure> {
    if is_standard(path) {
        return Err(Failure::usage(
            "triangles are not read from standard input",
            format!("name a file: {}", Format::with(&[Contents::Triangles], Direction::Read)),
        ));
    }
    let format = format(path, None, "the extension")?;
    let (source, _phase) = open(path, format, READING, quiet)?;
    read(source, format).map_err(|error| Failure::file(path, &error))
}
