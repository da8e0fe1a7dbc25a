//! The cells of a raster that is asked for: around points, over an area, or those of another raster.

use delone::Bounds;
use delone_io::Crs;
use delone_terrain::Cells;

use crate::args::PlaceArgs;
use crate::files;
use crate::message::Failure;

/// The cells, as far as they are known before points are read.
pub(crate) struct Place {
    pub(crate) cells: Cells,
    /// The system of the other raster.
    crs: Option<Crs>,
}

impl Place {
    /// Reads where the cells of another raster are, if they are to be the same.
    pub(crate) fn read(args: &PlaceArgs, size: Option<f64>, quiet: bool) -> Result<Self, Failure> {
        let extent = args.extent.map(|[x0, y0, x1, y1]| Bounds { low: [x0, y0], high: [x1, y1] });
        let cells = Cells::new().size(size).extent(extent).origin(args.origin.unwrap_or_default());
        let Some(path) = &args.like else { return Ok(Self { cells, crs: None }) };
        let (grid, crs) = files::place(path, quiet)?;
        let turned =
            |error| Failure::new(format!("{}: {error}", path.display()), "turn it with gdalwarp first");
        Ok(Self { cells: cells.like(grid).map_err(turned)?, crs })
    }

    /// The system of the cells: that of the points, or else of the other raster.
    pub(crate) fn crs(&self, points: Option<&Crs>) -> Option<Crs> {
        points.or(self.crs.as_ref()).cloned()
    }
}
