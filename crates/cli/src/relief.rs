//! `delone relief`: a raster of heights in, hillshades, slopes or aspects out.

use std::path::Path;

use delone_io::{
    Contents, Crs, Direction, Format, Output, Overviews, Raster, RasterInfo, RasterWriter, Sample,
    ShadeWriter,
};

use crate::args::{ReliefArgs, ReliefName};
use crate::files;
use crate::message::Failure;
use crate::progress::Phase;
use crate::stats::Stats;

/// The number for no data in hillshades, and in slopes and aspects.
const NO_SHADE: f64 = 0.0;
const NO_ANGLE: f64 = -9999.0;

pub(crate) fn run(args: &ReliefArgs, quiet: bool) -> Result<(), Failure> {
    let stats_path = args.stats.as_deref();
    let outputs = files::outputs(&args.output, args.to, stats_path, &[&args.input])?;
    let is_shade = args.kind == ReliefName::Hillshade;
    let holds = |format: Format| {
        format.holds(Contents::Rasters, Direction::Written) || is_shade && format == Format::Png
    };
    if let Some((path, format)) = outputs.iter().find(|output| !holds(output.1)) {
        let rasters = Format::with(&[Contents::Rasters], Direction::Written);
        return Err(Failure::usage(
            format!("{}: {format} is no format of this relief", path.display()),
            format!("choose among {rasters}, and png for hillshades"),
        ));
    }
    args.compress.check(outputs.iter().map(|output| output.1))?;
    let format = files::format(&args.input, args.from, "--from")?;
    let mut stats = Stats::start();
    let raster = files::read_raster(&args.input, format, quiet)?;
    stats.phase("read");
    stats.set("cells", raster.grid.cells());
    stats.set("columns", raster.grid.columns());
    stats.set("rows", raster.grid.rows());
    stats.set("no_data", raster.values.iter().filter(|z| z.is_nan()).count());
    let crs = raster.crs.clone();
    let phase = Phase::start(quiet, "shading");
    for (path, format) in &outputs {
        let output = files::create(path)?;
        let written = if *format == Format::Png {
            picture(args, &raster, crs.as_ref(), output)
        } else {
            numbers(args, &raster, crs.as_ref(), (path, *format), output)
        };
        written.and_then(files::finish).map_err(|error| files::cannot_write(path, error))?;
        files::write_sides(path, *format, &raster.grid, crs.as_ref(), quiet)?;
    }
    drop(phase);
    stats.phase("write");
    stats.write(stats_path)
}

/// Writes a picture.
fn picture(
    args: &ReliefArgs,
    raster: &Raster,
    crs: Option<&Crs>,
    output: Output,
) -> Result<Output, delone_io::Error> {
    let mut writer = ShadeWriter::create(output, &raster.grid, crs, args.relief())?;
    writer.write_rows(&raster.values)?;
    writer.finish()
}

/// Writes a raster.
fn numbers(
    args: &ReliefArgs,
    raster: &Raster,
    crs: Option<&Crs>,
    (path, format): (&Path, Format),
    output: Output,
) -> Result<Output, delone_io::Error> {
    let is_shade = args.kind == ReliefName::Hillshade;
    let info = RasterInfo {
        crs: crs.cloned(),
        nodata: Some(if is_shade { NO_SHADE } else { NO_ANGLE }),
        sample: if is_shade { Sample::U8 } else { Sample::F32 },
        compression: args.compress.into(),
        overviews: if args.kind == ReliefName::Aspect { Overviews::Firsts } else { Overviews::Means },
        scratch: files::scratch(path),
        ..RasterInfo::new(raster.grid)
    };
    let mut writer = RasterWriter::create(output, format, &info)?;
    let mut rows = args.relief().rows(&raster.grid, crs);
    for row in raster.values.chunks_exact(raster.grid.columns().max(1)) {
        rows.next(row).map_or(Ok(()), |made| writer.write_rows(&made))?;
    }
    rows.last().map_or(Ok(()), |made| writer.write_rows(&made))?;
    writer.finish()
}
