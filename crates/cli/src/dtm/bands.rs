//! A raster in bands of rows, each made when it is its turn, to all outputs at once.

use std::ops::Range;
use std::path::PathBuf;

use delone::surface::Grid;
use delone_io::{
    ASC_NODATA, Compression, Crs, Format, Output, RasterInfo, RasterWriter, Relief, ShadeWriter,
};

use crate::files;
use crate::message::{Failure, warn};
use crate::progress::Phase;

/// Where rows go.
enum Sheet {
    Raster(RasterWriter<Output>),
    Shade(ShadeWriter<Output>),
}

/// The description of a raster.
pub(super) struct About {
    pub(super) grid: Grid,
    pub(super) crs: Option<Crs>,
    pub(super) nodata: Option<f64>,
    pub(super) compression: Compression,
    /// The relief of pictures.
    pub(super) relief: Relief,
}

/// Writes all rasters and hillshades, whole or not at all; says how many cells have a value.
pub(super) fn write(
    outputs: &[(PathBuf, Format)],
    about: &About,
    bands: &[Range<usize>],
    quiet: bool,
    mut values: impl FnMut(&Grid) -> Result<Vec<f64>, Failure>,
) -> Result<u64, Failure> {
    let info = RasterInfo {
        crs: about.crs.clone(),
        nodata: about.nodata,
        compression: about.compression,
        ..RasterInfo::new(about.grid)
    };
    let mut sheets = Vec::new();
    for (path, format) in outputs {
        let failed = |error| files::cannot_write(path, error);
        let output = files::create(path)?;
        let sheet = if *format == Format::Png {
            ShadeWriter::create(output, &about.grid, about.crs.as_ref(), about.relief).map(Sheet::Shade)
        } else {
            let info = RasterInfo { scratch: files::scratch(path), ..info.clone() };
            RasterWriter::create(output, *format, &info).map(Sheet::Raster)
        };
        sheets.push(sheet.map_err(failed)?);
    }
    // Text has a number for no data whether one is named or not.
    let is_text = outputs.iter().any(|output| output.1 == Format::Asc);
    let nothing = about.nodata.or(is_text.then_some(ASC_NODATA));
    let (mut known, mut hidden) = (0, 0);
    let phase = Phase::count(quiet, "rows", about.grid.rows() as u64);
    for rows in bands {
        let window = about.grid.window(0..about.grid.columns(), rows.clone());
        let band = values(&window)?;
        known += band.iter().filter(|value| !value.is_nan()).count() as u64;
        hidden += band.iter().filter(|&&value| Some(value) == nothing).count() as u64;
        for (sheet, (path, _)) in sheets.iter_mut().zip(outputs) {
            let written = match sheet {
                Sheet::Raster(writer) => writer.write_rows(&band),
                Sheet::Shade(writer) => writer.write_rows(&band),
            };
            written.map_err(|error| files::cannot_write(path, error))?;
        }
        rows.clone().for_each(|_| phase.advance());
    }
    let mut done = Vec::new();
    for (sheet, (path, _)) in sheets.into_iter().zip(outputs) {
        let output = match sheet {
            Sheet::Raster(writer) => writer.finish(),
            Sheet::Shade(writer) => writer.finish(),
        };
        done.push(output.map_err(|error| files::cannot_write(path, error))?);
    }
    for (output, (path, format)) in done.into_iter().zip(outputs) {
        files::finish(output).map_err(|error| files::cannot_write(path, error))?;
        files::write_sides(path, *format, &about.grid, about.crs.as_ref(), quiet)?;
    }
    if let Some(number) = nothing.filter(|_| hidden > 0) {
        let what = format!("{hidden} cells have the height {number}, which stands for no data");
        warn(quiet, format_args!("{what}: name another with --nodata"));
    }
    Ok(known)
}
