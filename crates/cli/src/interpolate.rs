//! `delone interpolate`: values between points, at other points or on a raster.

use std::path::{Path, PathBuf};

use delone::surface::{Grid, Interpolator, Outside, gradients};
use delone::{Delaunay2, Delaunay3, Error, Surround};
use delone_io::{Cloud, Contents, Crs, Format, Found, RasterInfo, RasterWriter, write_array};

use crate::args::{InterpolateArgs, MethodName, OutsideName};
use crate::message::Failure;
use crate::place::Place;
use crate::progress::Phase;
use crate::room::{self, Room};
use crate::stats::Stats;
use crate::{files, queries};

pub(crate) fn run(args: &InterpolateArgs, quiet: bool) -> Result<(), Failure> {
    if args.dim.is_space() { run_in::<Delaunay3>(args, quiet) } else { run_in::<Delaunay2>(args, quiet) }
}

fn run_in<R: Room + Surround>(args: &InterpolateArgs, quiet: bool) -> Result<(), Failure> {
    let stats_path = args.input.stats.as_deref();
    keep_apart(args, stats_path)?;
    let format = files::format(&args.output, args.to, "--to")?;
    check(args, format, R::is_space())?;
    let mut stats = Stats::start();
    let label = args.input.label();
    let mut task = Task::<R>::read(args, &label, quiet)?;
    stats.phase("read");
    let d: R = room::build(&task.points, R::FASTEST, &label, quiet)?;
    stats.phase("build");
    task.table.iter_mut().for_each(|values| args.duplicates.rule().settle(values, room::duplicates(&d)));
    room::remark(&d, quiet);
    let phase = Phase::start(quiet, "interpolating");
    let failed = |error: Error| match (&args.queries, &error) {
        (Some(path), Error::NotFinite { .. }) => Failure::points(path, &error),
        _ => Failure::points(&label, &error),
    };
    let values = values(&d, args, &task.queries, &task.table).map_err(failed)?;
    drop(phase);
    stats.phase("query");
    stats.triangulation(&d, d.counters());
    stats.set("queries", task.queries.len());
    stats.set("outside", values.chunks(task.table.len()).filter(|row| row[0].is_nan()).count());
    match &task.grid {
        Some(grid) => write_raster(args, format, grid, task.crs.as_ref(), &values, quiet)?,
        None => task.write_answers(args, format, &values)?,
    }
    stats.phase("write");
    stats.tell(quiet, R::WORDS.simplex);
    stats.write(stats_path)
}

/// No output is one of the inputs.
fn keep_apart(args: &InterpolateArgs, stats: Option<&Path>) -> Result<(), Failure> {
    let mut inputs = args.input.paths();
    inputs.extend(args.queries.as_deref());
    inputs.extend(args.place.like.as_deref());
    inputs.extend(args.value.iter().map(Path::new).filter(|path| path.is_file()));
    files::keep_apart(&inputs, std::iter::once(args.output.as_path()).chain(stats))
}

/// The points, their values, and the places where values are asked for.
struct Task<R: Room> {
    points: Vec<R::Point>,
    /// A list for each value.
    table: Vec<Vec<f64>>,
    crs: Option<Crs>,
    queries: Vec<R::Point>,
    /// What else the file of queries holds.
    of_queries: Cloud,
    /// The raster whose cells are the queries, if there is no file of queries.
    grid: Option<Grid>,
}

impl<R: Room> Task<R> {
    fn read(args: &InterpolateArgs, label: &Path, quiet: bool) -> Result<Self, Failure> {
        let place = Place::read(&args.place, None, quiet)?;
        let (input, dimensions) = match &args.queries {
            Some(path) => files::attributes_apart(&args.input, path),
            None => (args.input.clone(), Vec::new()),
        };
        let (points, about) = room::read::<R>(&input, quiet)?;
        let crs = place.crs(about.crs.as_ref());
        let table = table(args, &about, points.len(), quiet)?;
        if let Some(path) = &args.queries {
            let (queries, of_queries) = room::queries_with::<R>(path, dimensions, quiet)?;
            return Ok(Self { points, table, crs, queries, of_queries, grid: None });
        }
        let grid = match place.cells.like {
            Some(grid) => grid,
            None => place
                .cells
                .squares(&room::bounds(&points, label)?, args.grid.unwrap_or(1.0))
                .map_err(|error| Failure::points(label, &error))?,
        };
        let queries = centers::<R>(&grid, label)?;
        Ok(Self { points, table, crs, queries, of_queries: Cloud::default(), grid: Some(grid) })
    }

    /// Writes the values at the queries, a row for each.
    fn write_answers(&self, args: &InterpolateArgs, format: Format, values: &[f64]) -> Result<(), Failure> {
        let columns = self.table.len();
        if format == Format::Npy {
            let shape = [values.len() / columns, columns];
            let shape = if columns == 1 { &shape[..1] } else { &shape };
            return files::write(&args.output, |out| Ok(write_array(out, shape, values.iter().copied())?));
        }
        let found = (&*names(args), Found::Numbers(values));
        queries::write(&args.output, format, &self.queries, &self.of_queries, found)
    }
}

fn check(args: &InterpolateArgs, format: Format, is_space: bool) -> Result<(), Failure> {
    let is_raster = args.grid.is_some() || args.place.like.is_some();
    if is_raster && is_space {
        return Err(Failure::usage(
            "rasters are for the plane",
            "give places with --queries, or leave --dim 3 out",
        ));
    }
    if is_raster && args.value.len() > 1 {
        return Err(Failure::usage("a raster has one value", "give --value once, or places with --queries"));
    }
    args.compress.check([format])?;
    if !is_raster {
        return queries::answer_format(&args.output, args.to).map(drop);
    }
    files::check_formats(&[(args.output.clone(), format)], &[Contents::Rasters])
}

/// The names of the values: those of their columns or files, or the axis of heights.
fn names(args: &InterpolateArgs) -> Vec<String> {
    if args.value.is_empty() {
        return vec!["z".to_owned()];
    }
    let name = |value: &String| match Path::new(value).file_stem() {
        Some(stem) if Path::new(value).is_file() => stem.to_string_lossy().into_owned(),
        _ if value.parse::<usize>().is_ok() => format!("value_{value}"),
        _ => value.clone(),
    };
    args.value.iter().map(name).collect()
}

/// The values that there are, a list for each.
fn table(args: &InterpolateArgs, about: &Cloud, count: usize, quiet: bool) -> Result<Vec<Vec<f64>>, Failure> {
    // Nothing can be said around a value that is missing, and NaN is what there is outside.
    let check = |name: &str, values: &[f64]| match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(point) => {
            let what =
                format!("{name}: the value of point {point} is {}, which is not finite", values[point]);
            Err(Failure::new(what, "remove that point or repair its value"))
        }
    };
    if args.value.is_empty() {
        let heights = about.z.clone().filter(|_| !args.dim.is_space());
        let missing =
            || Failure::usage("there is nothing to interpolate", "name a column or a file with --value");
        let heights = heights.ok_or_else(missing)?;
        check(&args.input.label().to_string_lossy(), &heights)?;
        return Ok(vec![heights]);
    }
    let mut table = Vec::new();
    for name in &args.value {
        let path = PathBuf::from(name);
        let values = if path.is_file() {
            files::numbers(&path, quiet)?
        } else {
            files::check_column(&args.input, name)?;
            files::column(&args.input, name, quiet)?
        };
        if values.len() != count {
            let what = format!("{name}: {} values for {count} points", values.len());
            return Err(Failure::new(what, "give one for each point"));
        }
        check(name, &values)?;
        table.push(values);
    }
    Ok(table)
}

/// The centers of all cells.
fn centers<R: Room>(grid: &Grid, label: &Path) -> Result<Vec<R::Point>, Failure> {
    /// The largest number of cells: each takes some fifty bytes.
    const MAX_CELLS: f64 = 2e9;
    if grid.cells() > MAX_CELLS {
        let what = format!("{}: the raster would have {:e} cells", label.display(), grid.cells());
        return Err(Failure::new(what, "choose a larger --grid, or use delone dtm"));
    }
    let center = |row: usize, column: usize| {
        let mut point = R::Point::default();
        point.as_mut()[..2].copy_from_slice(&grid.center(column, row));
        point
    };
    Ok((0..grid.rows()).flat_map(|row| (0..grid.columns()).map(move |column| center(row, column))).collect())
}

/// Values at all places, a row for each.
fn values<R: Surround>(
    d: &R,
    args: &InterpolateArgs,
    queries: &[R::Point],
    table: &[Vec<f64>],
) -> Result<Vec<f64>, Error> {
    let columns = table.len();
    let by_method = match args.method {
        MethodName::Linear => Interpolator::linear(d),
        MethodName::Nearest => Interpolator::nearest(d),
        MethodName::Laplace => Interpolator::laplace(d),
        _ => Interpolator::sibson(d),
    };
    let by_method = by_method.outside(match args.outside {
        OutsideName::Nothing => Outside::Nothing,
        OutsideName::Nearest => Outside::Nearest,
        OutsideName::Hull => Outside::Hull,
    });
    if !args.method.is_bent() {
        let rows: Vec<f64> =
            (0..d.ids_given()).flat_map(|v| table.iter().map(move |column| column[v])).collect();
        return by_method.many(queries, &rows, columns);
    }
    let mut values = vec![0.0; queries.len() * columns];
    for (k, column) in table.iter().enumerate() {
        let slopes = gradients(d, column)?;
        let is_farin = args.method == MethodName::Farin;
        let bent = by_method.many_bent(queries, |own, q| {
            if is_farin { own.farin(q, column, &slopes) } else { own.smooth(q, column, &slopes) }
        })?;
        bent.into_iter().enumerate().for_each(|(row, value)| values[row * columns + k] = value);
    }
    Ok(values)
}

fn write_raster(
    args: &InterpolateArgs,
    format: Format,
    grid: &Grid,
    crs: Option<&Crs>,
    values: &[f64],
    quiet: bool,
) -> Result<(), Failure> {
    let path = &args.output;
    let info = RasterInfo {
        crs: crs.cloned(),
        compression: args.compress.into(),
        scratch: files::scratch(path),
        ..RasterInfo::new(*grid)
    };
    let output = files::create(path)?;
    let write = || -> Result<(), delone_io::Error> {
        let mut writer = RasterWriter::create(output, format, &info)?;
        writer.write_rows(values)?;
        files::finish(writer.finish()?)
    };
    write().map_err(|error| files::cannot_write(path, error))?;
    files::write_sides(path, format, grid, crs, quiet)
}
