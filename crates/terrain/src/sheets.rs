//! A raster in bands of rows, each made when it is its turn, to all outputs at once.

use std::io::Write;
use std::path::PathBuf;

use delone::surface::Grid;
use delone_io::{ASC_NODATA, Compression, Crs, Error, Format, RasterInfo, RasterWriter, Relief, ShadeWriter};

/// What files of a terrain model say beside its heights.
///
/// ```
/// use delone_io::Compression;
/// use delone_terrain::Product;
///
/// let product = Product::new().nodata(-9999.0).compression(Compression::Lzw).interval(5.0);
/// assert_eq!(product.nodata, Some(-9999.0));
/// ```
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Product {
    /// The number for cells without a height; NaN does where there is none, and -9999 in text.
    pub nodata: Option<f64>,
    /// The compression of a GeoTIFF.
    pub compression: Compression,
    /// The relief of pictures.
    pub relief: Relief,
    /// The distance of contours in height; without it there are about ten of them.
    pub interval: Option<f64>,
}

impl Product {
    /// NaN for no data, deflated GeoTIFF, light from the north-west, about ten contours.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets [`Self::nodata`].
    #[must_use]
    pub fn nodata(self, nodata: impl Into<Option<f64>>) -> Self {
        Self { nodata: nodata.into(), ..self }
    }

    /// Sets [`Self::compression`].
    #[must_use]
    pub fn compression(self, compression: Compression) -> Self {
        Self { compression, ..self }
    }

    /// Sets [`Self::relief`].
    #[must_use]
    pub fn relief(self, relief: Relief) -> Self {
        Self { relief, ..self }
    }

    /// Sets [`Self::interval`].
    #[must_use]
    pub fn interval(self, interval: impl Into<Option<f64>>) -> Self {
        Self { interval: interval.into(), ..self }
    }
}

/// The number of an output, from 0, and what is wrong with it.
pub type Fault = (usize, Error);

/// Where rows go.
#[derive(Debug)]
enum Sheet<W: Write + 'static> {
    Raster(Box<RasterWriter<W>>),
    Shade(Box<ShadeWriter<W>>),
}

/// Several files of one raster, which are written row by row: rasters, and hillshades.
#[derive(Debug)]
pub struct Sheets<W: Write + 'static> {
    info: RasterInfo,
    relief: Relief,
    files: Vec<Sheet<W>>,
    has_text: bool,
    known: u64,
    hidden: u64,
}

impl<W: Write + 'static> Sheets<W> {
    /// No file yet.
    pub fn new(grid: Grid, crs: Option<Crs>, product: &Product) -> Self {
        let (nodata, compression) = (product.nodata, product.compression);
        let info = RasterInfo { crs, nodata, compression, ..RasterInfo::new(grid) };
        Self { info, relief: product.relief, files: Vec::new(), has_text: false, known: 0, hidden: 0 }
    }

    /// Begins a file, a hillshade if it is a picture; `scratch` is a folder for what waits until it can be written.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for formats that hold neither, and those of the output.
    pub fn add(&mut self, out: W, format: Format, scratch: Option<PathBuf>) -> Result<(), Error> {
        let (grid, crs) = (&self.info.grid, self.info.crs.as_ref());
        let sheet = if format == Format::Png {
            Sheet::Shade(Box::new(ShadeWriter::create(out, grid, crs, self.relief)?))
        } else {
            Sheet::Raster(Box::new(RasterWriter::create(
                out,
                format,
                &RasterInfo { scratch, ..self.info.clone() },
            )?))
        };
        self.has_text |= format == Format::Asc;
        self.files.push(sheet);
        Ok(())
    }

    /// Writes the next rows to all files.
    ///
    /// # Errors
    /// As [`RasterWriter::write_rows`], with the number of the file.
    pub fn write_rows(&mut self, values: &[f64]) -> Result<(), Fault> {
        let nothing = self.nothing();
        self.known += values.iter().filter(|value| !value.is_nan()).count() as u64;
        self.hidden += values.iter().filter(|&&value| Some(value) == nothing).count() as u64;
        for (number, sheet) in self.files.iter_mut().enumerate() {
            let written = match sheet {
                Sheet::Raster(writer) => writer.write_rows(values),
                Sheet::Shade(writer) => writer.write_rows(values),
            };
            written.map_err(|error| (number, error))?;
        }
        Ok(())
    }

    /// The number of cells that have a value so far.
    pub fn known(&self) -> u64 {
        self.known
    }

    /// The number of cells whose value is the one that stands for no data, and that one.
    pub fn hidden(&self) -> Option<(u64, f64)> {
        self.nothing().filter(|_| self.hidden > 0).map(|nothing| (self.hidden, nothing))
    }

    /// Writes what is left, and gives the outputs back.
    ///
    /// # Errors
    /// As [`RasterWriter::finish`], with the number of the file.
    pub fn finish(self) -> Result<Vec<W>, Fault> {
        let finish = |(number, sheet): (usize, Sheet<W>)| {
            let output = match sheet {
                Sheet::Raster(writer) => writer.finish(),
                Sheet::Shade(writer) => writer.finish(),
            };
            output.map_err(|error| (number, error))
        };
        self.files.into_iter().enumerate().map(finish).collect()
    }

    /// The number for no data: text has one whether it is named or not.
    fn nothing(&self) -> Option<f64> {
        self.info.nodata.or(self.has_text.then_some(ASC_NODATA))
    }
}
