//! Files as the commands use them: names checked first, points read, outputs written whole.

mod apart;
mod attributes;
mod graphs;
mod sides;
mod systems;
mod write;

use std::io::{BufReader, Cursor, Read};
use std::path::{Path, PathBuf};

use delone::surface::Grid;
use delone_io::{
    Beside, Cloud, Contents, Crs, Direction, Format, Raster, ReadOptions, Source, Value, decompressed,
};

pub use apart::keep_apart;
pub(crate) use apart::{beside, keep_names_apart};
pub(crate) use attributes::{
    Unshown, are_kept as are_attributes_kept, heed_naming, heed_unshown, keep_attributes,
};
pub use graphs::graph;
pub(crate) use graphs::{graph_beside, graph_with_points, holds_lines, polygons, polygons_beside, rings};
pub(crate) use sides::write_sides;
pub(crate) use systems::{Role, drawn, drawn_system, keep_system, say_system};
pub(crate) use write::{cannot_write, create, finish, folder_of, publish, scratch, write_mesh};
pub use write::{write, write_own};

use crate::args::InputArgs;
use crate::limits;
use crate::message::{Failure, grouped, lost, note};
use crate::progress::Phase;

/// The title of the progress bar while a file is read.
const READING: &str = "reading";

/// The format of a file: as said, or by its extension.
pub(crate) fn format(path: &Path, said: Option<Format>, option: &str) -> Result<Format, Failure> {
    match said {
        Some(format) => Ok(format),
        None if is_standard(path) => Err(Failure::usage(
            "the format of - is not known",
            format!("name it with {option}, as in {option} csv"),
        )),
        None => Format::of(path).map_err(|error| {
            if path.is_dir() {
                return Failure::usage(format!("{} is a folder", path.display()), "name a file in it");
            }
            Failure::file(path, &error)
        }),
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
pub fn outputs(
    paths: &[PathBuf],
    to: Option<Format>,
    stats: Option<&Path>,
    inputs: &[&Path],
) -> Result<Vec<(PathBuf, Format)>, Failure> {
    outputs_of(paths, to, stats, inputs, |_, format| format)
}

/// [`outputs`], of contents for which formats have other names.
pub(crate) fn outputs_of(
    paths: &[PathBuf],
    to: Option<Format>,
    stats: Option<&Path>,
    inputs: &[&Path],
    renamed: impl Fn(&Path, Format) -> Format,
) -> Result<Vec<(PathBuf, Format)>, Failure> {
    keep_apart(inputs, paths.iter().map(PathBuf::as_path).chain(stats))?;
    let by_extension = |path: &PathBuf| {
        // With several outputs, --to is for those that do not tell by themselves.
        let known = if paths.len() > 1 { Format::of(path).ok() } else { None };
        let format = known.map_or_else(|| format(path, to, "--to"), Ok)?;
        Ok((path.clone(), renamed(path, format)))
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
    let way = any.iter().find_map(|&contents| format.other_way(contents, Direction::Written));
    let way = way.map(|way| way + "; ").unwrap_or_default();
    Err(Failure::usage(
        format!("{}: {} are not written to {format} files", path.display(), what.join(" or ")),
        format!("{way}choose among {}", Format::with(any, Direction::Written)),
    ))
}

/// Keeps an output, which should say what the input does.
pub(crate) fn expect(outputs: &[(PathBuf, Format)]) {
    systems::expect(outputs);
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
    if format == Format::Tiff {
        heed_mask(path, quiet);
    }
    open_part(path, format, what, quiet)
}

/// Opens a file as [`open`] does, for a part of its content alone: nothing beside it is heeded.
fn open_part(
    path: &Path,
    format: Format,
    what: &'static str,
    quiet: bool,
) -> Result<(Box<dyn Source>, Phase), Failure> {
    systems::expect_input(path, format);
    let (source, phase) = open_raw(path, what, quiet)?;
    let source = decompressed(source, format).map_err(|error| wrong(path, format, &error))?;
    Ok((source, phase))
}

/// Tells of a mask in a file beside a raster, as GDAL writes them: it is not read.
fn heed_mask(path: &Path, quiet: bool) {
    let mut mask = path.as_os_str().to_owned();
    mask.push(".msk");
    if Path::new(&mask).is_file() {
        let what = "a mask beside the raster is not read: gdal_translate --config GDAL_TIFF_INTERNAL_MASK YES puts it inside";
        lost(quiet, format_args!("{}: {what}", Path::new(&mask).display()));
    }
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
        let what = format!("{} is a folder, with no las or laz file in it", path.display());
        return Err(Failure::new(what, "name a file in it"));
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
    let is_las = formats.iter().any(|&format| is_las(format));
    if let Some(option) = args.las.option().filter(|_| !is_las) {
        let what = format!("{option} is for LAS, LAZ and EPT");
        return Err(Failure::usage(what, format!("leave {option} out")));
    }
    if !args.columns.is_empty() && !is_las && !formats.contains(&Format::Text) {
        return Err(Failure::usage("--columns is for text, LAS, LAZ and EPT", "leave --columns out"));
    }
    if args.skip_missing && !formats.contains(&Format::Text) {
        return Err(Failure::usage("--skip-missing is for text", "leave --skip-missing out"));
    }
    Ok(formats)
}

/// Whether points of a format have classes, returns and dimensions.
pub(crate) fn is_las(format: Format) -> bool {
    matches!(format, Format::Las | Format::Ept)
}

/// How the files of a command are read.
pub(crate) fn options(args: &InputArgs, dimension: usize) -> ReadOptions {
    if !args.las.attributes.is_empty() {
        attributes::ask();
    }
    ReadOptions::default()
        .las(args.las.filter())
        .columns(args.columns.clone())
        .dimensions(args.las.attributes.clone())
        .dimension(dimension)
        .attributes(are_attributes_kept())
        .skip_missing(args.skip_missing)
}

/// Reads the points of a command.
pub fn points(args: &InputArgs, dimension: usize, quiet: bool) -> Result<Cloud, Failure> {
    let options = options(args, dimension);
    read_all(args, quiet, |source, format, beside| {
        delone_io::read_points_beside(source, format, &options, beside)
    })
}

/// Reads all files of a command as one set.
fn read_all(
    args: &InputArgs,
    quiet: bool,
    read: impl Fn(Box<dyn Source>, Format, Beside) -> Result<Cloud, delone_io::Error>,
) -> Result<Cloud, Failure> {
    let formats = formats(args)?;
    let mut all = Cloud::default();
    for (path, format) in args.input.iter().zip(formats) {
        let failed = |error| wrong(path, format, &error);
        let (source, _phase) = open(path, format, READING, quiet)?;
        let mut cloud = read(source, format, &mut beside(path)).map_err(failed)?;
        heed(&mut cloud, path, Role::Input, quiet)?;
        all.join(cloud).map_err(failed)?;
        limits::check_points(all.xy.len(), path)?;
        tell(&mut all, None, quiet);
    }
    Ok(all)
}

/// Tells what a file says besides its points, and keeps what outputs should say.
pub(crate) fn heed(cloud: &mut Cloud, path: &Path, role: Role, quiet: bool) -> Result<(), Failure> {
    tell(cloud, Some(path), quiet);
    attributes::heed(cloud);
    systems::find_system(&mut cloud.crs, path, role, quiet)
}

/// Tells of a file, or of several that were joined, what a user should know; once.
fn tell(cloud: &mut Cloud, path: Option<&Path>, quiet: bool) {
    let label = path.map(|path| format!("{}: ", path.display())).unwrap_or_default();
    std::mem::take(&mut cloud.remarks).iter().for_each(|remark| note(quiet, format_args!("{label}{remark}")));
    std::mem::take(&mut cloud.losses).iter().for_each(|loss| lost(quiet, format_args!("{label}{loss}")));
}

/// Points, their heights, and what else the files tell.
type Surface = (Vec<[f64; 2]>, Vec<f64>, Cloud);

/// Reads the points of a command with their heights: points of any format, or cells of rasters. The cloud has the rest of what is told.
pub(crate) fn surface(args: &InputArgs, quiet: bool) -> Result<Surface, Failure> {
    let options = options(args, 3);
    let mut all = read_all(args, quiet, |source, format, beside| match format {
        Format::Npy => delone_io::read_surface(source, format, &options),
        _ => delone_io::read_points_beside(source, format, &options, beside),
    })?;
    need_heights(all.z.as_deref(), &args.label())?;
    heed_classes(args, &all, quiet);
    Ok((std::mem::take(&mut all.xy), all.z.take().unwrap_or_default(), all))
}

/// Says that roofs and trees are part of a surface, where ground could be told from them and was not.
fn heed_classes(args: &InputArgs, cloud: &Cloud, quiet: bool) {
    const GROUND: u8 = 2;
    let has_ground = cloud.classes.iter().any(|&(class, count)| class == GROUND && count > 0);
    if args.las.class.is_empty() && has_ground && cloud.classes.len() > 1 {
        let what = "points of all classes are taken; --class ground takes the ground alone";
        note(quiet, format_args!("{}: {what}", args.label().display()));
    }
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
    let mut raster = delone_io::read_raster(source, format).map_err(|error| wrong(path, format, &error))?;
    systems::find_system(&mut raster.crs, path, Role::Input, quiet)?;
    raster.losses.iter().for_each(|loss| lost(quiet, format_args!("{}: {loss}", path.display())));
    Ok(raster)
}

/// Reads where the cells of a raster are, and the system of its coordinates.
pub(crate) fn place(path: &Path, quiet: bool) -> Result<(Grid, Option<Crs>), Failure> {
    let format = format_beside(path)?;
    let (source, _phase) = open_part(path, format, READING, quiet)?;
    let place = delone_io::read_raster_place(source, format).map_err(|error| wrong(path, format, &error));
    let (grid, mut crs) = place?;
    systems::find_system(&mut crs, path, Role::Beside, quiet)?;
    Ok((grid, crs))
}

/// Reads a number for each point.
pub(crate) fn numbers(path: &Path, quiet: bool) -> Result<Vec<f64>, Failure> {
    let format = format_beside(path)?;
    let (source, _phase) = open(path, format, READING, quiet)?;
    delone_io::read_numbers(source, format).map_err(|error| wrong(path, format, &error))
}

/// Advice where a number for each point is not found.
const NUMBERS: &str = "name a file with one for each point, or a column of a text file";

/// Refuses a column of files that have none.
pub(crate) fn check_column(args: &InputArgs, name: &str) -> Result<(), Failure> {
    for path in &args.input {
        if is_standard(path) || !has_columns(format(path, args.from, "--from")?) {
            let what = format!("{name} is no file, and {} has no columns to look for it in", path.display());
            return Err(Failure::usage(what, NUMBERS));
        }
    }
    Ok(())
}

/// Whether points of a format have columns with names.
fn has_columns(format: Format) -> bool {
    matches!(format, Format::Text | Format::Lammps | Format::ExtXyz)
}

/// Reads a column of the points' own files, by name or number from 1; of atoms by name.
pub(crate) fn column(args: &InputArgs, name: &str, quiet: bool) -> Result<Vec<f64>, Failure> {
    let mut all = Vec::new();
    for path in &args.input {
        let format = format(path, args.from, "--from")?;
        // Of rows that are left out the others are told by what they hold.
        if format != Format::Text || args.skip_missing {
            all.extend(attribute(args, path, format, name, quiet)?);
            continue;
        }
        let options = ReadOptions::default().columns([name; 2]);
        let (source, _phase) = open(path, Format::Text, READING, quiet)?;
        let cloud = delone_io::read_points(source, Format::Text, &options).map_err(|error| {
            let what = format!("{}: {name} is no file, and as a column: {error}", path.display());
            Failure::new(what, NUMBERS)
        })?;
        all.extend(cloud.xy.into_iter().map(|[number, _]| number));
    }
    Ok(all)
}

/// Reads an attribute of all points, which must be a number.
fn attribute(
    args: &InputArgs,
    path: &Path,
    format: Format,
    name: &str,
    quiet: bool,
) -> Result<Vec<f64>, Failure> {
    let (source, _phase) = open(path, format, READING, quiet)?;
    let options = ReadOptions::default().attributes(true).skip_missing(args.skip_missing);
    let options = if format == Format::Text { options.columns(args.columns.clone()) } else { options };
    let cloud =
        delone_io::read_points(source, format, &options).map_err(|error| wrong(path, format, &error))?;
    let table = &cloud.features.table;
    let failed =
        |what: String| Failure::new(format!("{}: {name} is no file, and {what}", path.display()), NUMBERS);
    let names = || table.names().join(", ");
    let column = table.names().iter().position(|known| known == name);
    let column = column.ok_or_else(|| failed(format!("no column is called so, but: {}", names())))?;
    let number = |point| {
        let value = cloud.features.row(point).map(|row| table.value(row, column));
        let number = match value {
            Some(Value::Number(number)) => Some(number),
            Some(Value::Integer(whole)) => Some(whole as f64),
            _ => None,
        };
        number.ok_or_else(|| failed(format!("in this column point {point} has no number")))
    };
    (0..cloud.xy.len()).map(number).collect()
}

/// The input of a command, and the dimensions of LAS files that are attributes of its queries: those that are asked for, where these are such
/// files.
pub(crate) fn attributes_apart(input: &InputArgs, queries: &Path) -> (InputArgs, Vec<String>) {
    let mut input = input.clone();
    let is_of_queries = Format::of(queries).is_ok_and(is_las);
    let names = if is_of_queries { std::mem::take(&mut input.las.attributes) } else { Vec::new() };
    (input, names)
}

/// Reads points that are asked for, with some dimensions of LAS files as attributes.
pub(crate) fn queries(
    path: &Path,
    dimension: usize,
    dimensions: Vec<String>,
    quiet: bool,
) -> Result<Cloud, Failure> {
    let attributes = are_attributes_kept();
    cloud(
        path,
        &ReadOptions::default().dimension(dimension).dimensions(dimensions).attributes(attributes),
        quiet,
    )
}

/// Reads the points of a file beside those of the input.
pub(crate) fn cloud(path: &Path, options: &ReadOptions, quiet: bool) -> Result<Cloud, Failure> {
    let format = format_beside(path)?;
    let (source, _phase) = open(path, format, READING, quiet)?;
    let cloud = delone_io::read_points_beside(source, format, options, &mut beside(path));
    let mut cloud = cloud.map_err(|error| wrong(path, format, &error))?;
    heed(&mut cloud, path, Role::Beside, quiet)?;
    Ok(cloud)
}

/// The failure of a file: its beginning tells whether it is of the format, if it can be read again.
pub(crate) fn wrong(path: &Path, format: Format, error: &delone_io::Error) -> Failure {
    const LENGTH: u64 = 4096;
    let mut beginning = Vec::new();
    if path.is_file()
        && let Ok(source) = apart::source(path)
        && let Ok(content) = decompressed(source, format)
    {
        // What is there before an error is the beginning.
        _ = content.take(LENGTH).read_to_end(&mut beginning);
    }
    Failure::content(path, format, error, &beginning)
}

/// Reads a text.
pub fn text(path: &Path, quiet: bool) -> Result<String, Failure> {
    let (mut source, _phase) = open(path, Format::Text, READING, quiet)?;
    let mut bytes = Vec::new();
    source.read_to_end(&mut bytes).map_err(|error| Failure::file(path, &error.into()))?;
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        Failure::new(format!("{}: byte {at} is not text", path.display()), "give a text file")
    })
}

/// Tells how many quadrilaterals of a mesh are read as two triangles each.
pub fn tell_quads(path: &Path, quiet: bool) -> Result<(), Failure> {
    let count = simplices(path, quiet, delone_io::count_quads)?;
    if count > 0 {
        let (path, count) = (path.display(), grouped(count as u64));
        note(quiet, format_args!("{path}: {count} quadrilaterals are read as two triangles each"));
    }
    Ok(())
}

/// Reads the simplices of a mesh, or what else is said of them.
pub fn simplices<T>(
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
    read(source, format).map_err(|error| wrong(path, format, &error))
}
