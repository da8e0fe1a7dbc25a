//! The cells of a raster that is asked for: around points, over an area, or those of another raster.

use delone::Bounds;
use delone::surface::Grid;
use delone_io::Crs;

use crate::args::PlaceArgs;
use crate::files;
use crate::message::Failure;

/// The cells, as far as they are known before points are read.
pub(crate) struct Place<'a> {
    args: &'a PlaceArgs,
    /// The cells of another raster, and its system.
    like: Option<(Grid, Option<Crs>)>,
}

impl<'a> Place<'a> {
    /// Reads where the cells of another raster are, if they are to be the same.
    pub(crate) fn read(args: &'a PlaceArgs, quiet: bool) -> Result<Self, Failure> {
        let like = args.like.as_deref().map(|path| files::place(path, quiet)).transpose()?;
        if let (Some((grid, _)), Some(path)) = (&like, &args.like)
            && !(grid.step()[0] > 0.0 && grid.step()[1] < 0.0)
        {
            let what = format!(
                "{}: its rows do not go from north to south, or its columns to the east",
                path.display()
            );
            return Err(Failure::new(what, "turn it with gdalwarp first"));
        }
        Ok(Self { args, like })
    }

    /// The cells of another raster.
    pub(crate) fn given(&self) -> Option<Grid> {
        self.like.as_ref().map(|like| like.0)
    }

    /// The area that cells are to cover, for points within bounds.
    pub(crate) fn area(&self, points: &Bounds<2>) -> Bounds<2> {
        match self.args.extent {
            Some([x0, y0, x1, y1]) => Bounds { low: [x0, y0], high: [x1, y1] },
            None => *points,
        }
    }

    /// Square cells over an area.
    pub(crate) fn grid(&self, area: &Bounds<2>, cell: f64) -> Result<Grid, delone::Error> {
        Grid::aligned_at(area, cell, self.args.origin.unwrap_or_default())
    }

    /// The system of the cells: that of the points, or else of the other raster.
    pub(crate) fn crs(&self, points: Option<&Crs>) -> Option<Crs> {
        points.or_else(|| self.like.as_ref()?.1.as_ref()).cloned()
    }
}
