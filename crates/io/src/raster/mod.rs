//! Rasters in files, a file a format: GeoTIFF, ESRI ASCII grids and NumPy arrays.
//!
//! Rows are written as they come, from memory for a few of them. Cells are areas: a value belongs to the center of its cell,
//! and what the files say is where the corner of the first cell is. Cost: O(cells); compression is shared among the threads.

mod asc;
mod beside;
mod npy;
mod relief;
mod tiff;

use std::io::Write;
use std::path::PathBuf;

use delone::surface::Grid;

use crate::{Cloud, Contents, Crs, Direction, Error, Format, ReadOptions, Source, read_points};

pub use asc::ASC_NODATA;
pub(crate) use asc::read as read_asc;
pub use beside::{beside_raster, besides_of_raster, crs_of_side, heed_sides};
pub(crate) use npy::read as read_npy;
pub use relief::{Light, Relief, ReliefKind, ReliefRows, ShadeWriter};
pub(crate) use tiff::read as read_tiff;

/// The numbers that a GeoTIFF is written with. Text is written with as many digits as these need, and arrays of NumPy with 64 bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Sample {
    /// Floating point of 32 bits; as text the fewest digits that read back as the same 32 bits.
    #[default]
    F32,
    /// Floating point of 64 bits.
    F64,
    /// Whole numbers from 0 to 255, for shades; others are rounded to the nearest.
    U8,
}

impl Sample {
    /// The bytes of a number.
    fn size(self) -> usize {
        match self {
            Self::U8 => 1,
            Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

/// How a GeoTIFF is compressed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Compression {
    /// Deflate, which is read everywhere.
    #[default]
    Deflate,
    /// LZW: larger files, for old readers.
    Lzw,
    /// Nothing: numbers as they are.
    None,
}

/// The value of a cell in an overview of a GeoTIFF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Overviews {
    /// The mean of the cells below that have data.
    #[default]
    Means,
    /// The value of the first of these: for angles and classes.
    Firsts,
}

/// The description of a raster besides its values.
///
/// ```
/// use delone::surface::Grid;
/// use delone_io::{Crs, RasterInfo};
///
/// let grid = Grid::new([500_000.0, 5_400_000.0], [1.0, -1.0], 1000, 500)?;
/// let info = RasterInfo { crs: Some(Crs::of_epsg(25832)), nodata: Some(-9999.0), ..RasterInfo::new(grid) };
/// assert_eq!(info.grid.columns(), 1000);
/// # Ok::<(), delone::Error>(())
/// ```
///
/// Fields may be added: a literal ends with `..` and a value to take the rest from.
#[derive(Clone, Debug, PartialEq)]
pub struct RasterInfo {
    /// Where the cells are, in the units of the system of coordinates.
    pub grid: Grid,
    /// The system of coordinates.
    pub crs: Option<Crs>,
    /// The number that stands for no data; NaN does where there is none, and in arrays always. ASCII grids have -9999 then.
    pub nodata: Option<f64>,
    /// The numbers of the values.
    pub sample: Sample,
    /// The compression of a GeoTIFF.
    pub compression: Compression,
    /// The overviews of a GeoTIFF.
    pub overviews: Overviews,
    /// A folder in which tiles of a large GeoTIFF wait until their places are known; the system's for temporary files where none is named.
    pub scratch: Option<PathBuf>,
}

impl RasterInfo {
    /// A raster of numbers of 32 bits, of unknown coordinates, where NaN is no data.
    pub fn new(grid: Grid) -> Self {
        Self {
            grid,
            crs: None,
            nodata: None,
            sample: Sample::default(),
            compression: Compression::default(),
            overviews: Overviews::default(),
            scratch: None,
        }
    }
}

/// Writes a raster row by row, from memory for a few of them.
///
/// ```
/// use std::io::Cursor;
/// use delone::surface::Grid;
/// use delone_io::{Format, RasterInfo, RasterWriter, read_raster};
///
/// let grid = Grid::new([0.0, 20.0], [10.0, -10.0], 3, 2)?;
/// let mut writer = RasterWriter::create(Cursor::new(Vec::new()), Format::Tiff, &RasterInfo::new(grid))?;
/// writer.write_rows(&[1.0, 2.0, f64::NAN])?;
/// writer.write_rows(&[4.0, 5.0, 6.0])?;
/// let bytes = writer.finish()?.into_inner();
/// let raster = read_raster(Box::new(Cursor::new(bytes)), Format::Tiff)?;
/// assert_eq!((raster.grid, raster.values[5]), (grid, 6.0));
/// assert!(raster.values[2].is_nan());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct RasterWriter<W: Write> {
    sheet: Sheet<W>,
    columns: usize,
    rows: usize,
    /// Values that were written.
    values: usize,
}

/// Writers of each format.
#[derive(Debug)]
enum Sheet<W: Write> {
    Tiff(tiff::Writer<W>),
    Asc(asc::Writer<W>),
    Npy(npy::Writer<W>),
}

impl<W: Write> RasterWriter<W> {
    /// Begins a file: an [`Output`](crate::Output), or anything else that is written to, forwards only.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for other formats, [`Error::NotSquare`] and
    /// [`Error::Extent`] for rasters that the format does not hold, and those of the output.
    pub fn create(out: W, format: Format, info: &RasterInfo) -> Result<Self, Error> {
        let sheet = match format {
            Format::Tiff => Sheet::Tiff(tiff::Writer::create(out, info)?),
            Format::Asc => Sheet::Asc(asc::Writer::create(out, info)?),
            Format::Npy => Sheet::Npy(npy::Writer::create(out, info)?),
            _ => return Err(format.without(Contents::Rasters, Direction::Written)),
        };
        Ok(Self { sheet, columns: info.grid.columns(), rows: info.grid.rows(), values: 0 })
    }

    /// Writes the next rows of the grid, any whole number of them; NaN is no data.
    ///
    /// # Errors
    /// [`Error::Rows`] for values that are no whole rows or too many, [`Error::Beyond`] for one that the numbers of the file cannot
    /// hold, and those of the output.
    pub fn write_rows(&mut self, values: &[f64]) -> Result<(), Error> {
        let all = self.values + values.len();
        if !values.len().is_multiple_of(self.columns.max(1))
            || all as f64 > self.columns as f64 * self.rows as f64
        {
            return Err(self.wrong(all));
        }
        let row = self.values / self.columns.max(1);
        match &mut self.sheet {
            Sheet::Tiff(sheet) => sheet.write_rows(values, row),
            Sheet::Asc(sheet) => Ok(sheet.write_rows(values)?),
            Sheet::Npy(sheet) => Ok(sheet.write_rows(values)?),
        }?;
        self.values = all;
        Ok(())
    }

    /// Writes what is left, and gives the output back, which is then to be committed.
    ///
    /// # Errors
    /// [`Error::Rows`] if rows are missing, and those of the output.
    pub fn finish(self) -> Result<W, Error> {
        if self.values as f64 != self.columns as f64 * self.rows as f64 {
            return Err(self.wrong(self.values));
        }
        match self.sheet {
            Sheet::Tiff(sheet) => sheet.finish(),
            Sheet::Asc(sheet) => sheet.finish(),
            Sheet::Npy(sheet) => sheet.finish(),
        }
    }

    fn wrong(&self, values: usize) -> Error {
        Error::Rows { columns: self.columns, rows: self.rows, values }
    }
}

/// A raster in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    /// Where the cells are.
    pub grid: Grid,
    /// The system of coordinates, where the file tells.
    pub crs: Option<Crs>,
    /// The values row by row as the file has them; NaN where there is no data.
    pub values: Vec<f64>,
    /// Contents of the file that the values lack: other pages, other bands.
    pub losses: Vec<String>,
}

impl Raster {
    /// The centers of the cells that have data as points with heights, row by row.
    ///
    /// ```
    /// use std::io::Cursor;
    /// use delone_io::{Format, read_raster};
    ///
    /// let text = "ncols 2\nnrows 1\nxllcorner 10\nyllcorner 0\ncellsize 2\nNODATA_value -1\n-1 7.5\n";
    /// let cloud = read_raster(Box::new(Cursor::new(text)), Format::Asc)?.into_points();
    /// assert_eq!((cloud.xy, cloud.z), (vec![[13.0, 1.0]], Some(vec![7.5])));
    /// # Ok::<(), delone_io::Error>(())
    /// ```
    pub fn into_points(self) -> Cloud {
        let mut cloud = Cloud { crs: self.crs, z: Some(Vec::new()), losses: self.losses, ..Cloud::default() };
        let rows = self.values.chunks_exact(self.grid.columns().max(1));
        for (row, values) in rows.enumerate() {
            for (column, &value) in values.iter().enumerate().filter(|cell| !cell.1.is_nan()) {
                cloud.push(self.grid.center(column, row), value);
            }
        }
        let without = self.values.len() - cloud.xy.len();
        if without > 0 {
            cloud.remarks.push(format!("{without} cells without data are left out"));
        }
        cloud
    }

    /// A raster of so many rows and columns whose file does not say where it is: cells of one unit, the last row at the origin.
    fn nowhere(columns: usize, rows: usize) -> Result<Grid, Error> {
        placed([0.0, rows as f64], [1.0, -1.0], columns, rows)
    }
}

/// Where a file says that cells are.
fn placed(corner: [f64; 2], step: [f64; 2], columns: usize, rows: usize) -> Result<Grid, Error> {
    Grid::new(corner, step, columns, rows)
        .map_err(|error| Error::content(format!("the place of the raster: {error}")))
}

/// Reads a raster: a GeoTIFF of any numbers (the first band of its first page, with its scale and its mask), an ASCII grid, or a NumPy array of shape (rows, columns).
/// Values that stand for no data become NaN. An array says nothing of where it is: its cells have one unit, and its last row is at
/// the origin.
///
/// Costs 8 bytes a cell, and a strip or tile of the file; what a header claims takes no memory.
///
/// # Errors
/// What is wrong with the file; [`Error::Unsupported`] for other formats.
pub fn read_raster(source: Box<dyn Source>, format: Format) -> Result<Raster, Error> {
    format.readers().rasters.ok_or_else(|| format.without(Contents::Rasters, Direction::Read))?(source)
}

/// Reads where the cells of a raster are and what their coordinates mean, without its values.
///
/// # Errors
/// What is wrong with the file; [`Error::Unsupported`] for formats that do not tell.
pub fn read_raster_place(source: Box<dyn Source>, format: Format) -> Result<(Grid, Option<Crs>), Error> {
    match format {
        Format::Tiff => tiff::read_place(source),
        Format::Asc => asc::read_place(source),
        _ => Err(format.without(Contents::Rasters, Direction::Read)),
    }
}

/// Reads points with heights, of whatever formats have them: as [`read_points`](crate::read_points), and an array of a shape that is not
/// that of points as a raster.
///
/// # Errors
/// As [`read_points`](crate::read_points).
pub fn read_surface(
    mut source: Box<dyn Source>,
    format: Format,
    options: &ReadOptions,
) -> Result<Cloud, Error> {
    if format != Format::Npy {
        return read_points(source, format, options);
    }
    let error = match crate::formats::npy::read_points(&mut source) {
        Ok(cloud) => return Ok(cloud),
        Err(error) => error,
    };
    source.rewind()?;
    npy::read(source).map(Raster::into_points).map_err(|_| error)
}
