//! A terrain model: a surface over the cells of a raster, and its files.

use std::io::Write;
use std::ops::{ControlFlow, Range};
use std::path::{Path, PathBuf};

use delone::surface::{ContourLine, Grid};
use delone_io::{
    Cloud, Contents, ContourMap, Crs, Direction, Format, Output, Said, beside_raster, besides_of_raster,
    give_names, write_contours,
};

use crate::cells::{Cells, bounds, even};
use crate::clip::Clip;
use crate::error::Error;
use crate::lines::Lines;
use crate::options::Options;
use crate::remark::Remark;
use crate::sheets::{Product, Sheets};
use crate::surface::{Surface, heights_of};
use crate::tiled::Tiled;

/// Cells that are made at a time.
const CELLS_AT_ONCE: usize = 1 << 24;

/// The surface below a model.
#[derive(Debug)]
enum Ground {
    Points(Box<Surface>),
    Tiles(Box<Tiled>),
}

/// A terrain model of points.
///
/// ```
/// use delone_io::Cloud;
/// use delone_terrain::{Cells, Lines, Options, Terrain};
///
/// let xy = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [2.0, 2.0]];
/// let cloud = Cloud { xy, z: Some(vec![0.0, 0.0, 0.0, 0.0, 4.0]), ..Cloud::default() };
/// let terrain = Terrain::new(&cloud, Lines::new(), &Cells::new().size(2.0), &Options::new())?;
/// assert_eq!(terrain.values()?, [2.0; 4]);
/// # Ok::<(), delone_terrain::Error>(())
/// ```
#[derive(Debug)]
pub struct Terrain {
    ground: Ground,
    grid: Grid,
    clip: Option<Clip>,
    crs: Option<Crs>,
    remarks: Vec<Remark>,
}

impl Terrain {
    /// The surface of points with lines, over cells.
    ///
    /// # Errors
    /// As [`Surface::new`] and [`Cells::grid`].
    pub fn new(cloud: &Cloud, lines: Lines, cells: &Cells, options: &Options) -> Result<Self, Error> {
        heights_of(cloud)?;
        let bounds = bounds(&cloud.xy)?;
        let grid = cells.grid(&bounds, cloud.xy.len() as u64)?;
        let surface = Surface::new(cloud, lines, &grid, options)?;
        let remarks = cells.remark(&bounds, &grid).into_iter().chain(surface.remarks().iter().cloned());
        let remarks = remarks.collect();
        let ground = Ground::Points(Box::new(surface));
        Ok(Self { ground, grid, clip: None, crs: cloud.crs.clone(), remarks })
    }

    /// The surface of a folder of tiles, over cells.
    ///
    /// # Errors
    /// As [`Cells::grid`].
    pub fn of_tiles(tiles: Tiled, cells: &Cells) -> Result<Self, Error> {
        let grid = cells.grid(tiles.bounds(), tiles.store().summary().points)?;
        let remarks = cells.remark(tiles.bounds(), &grid).into_iter().collect();
        Ok(Self { ground: Ground::Tiles(Box::new(tiles)), grid, clip: None, crs: None, remarks })
    }

    /// Keeps only the heights inside of the polygons; all others become NaN.
    ///
    /// # Errors
    /// [`Error::Systems`] if their coordinates are of another system.
    pub fn clipped(self, clip: Clip) -> Result<Self, Error> {
        match (&self.crs, clip.crs()) {
            (Some(ours), Some(theirs)) if !ours.agrees(theirs) => {
                Err(Error::Systems { ours: Box::new(ours.clone()), theirs: Box::new(theirs.clone()) })
            }
            _ => Ok(Self { clip: Some(clip), ..self }),
        }
    }

    /// Sets the system of coordinates that files say.
    #[must_use]
    pub fn with_crs(self, crs: Option<Crs>) -> Self {
        Self { crs, ..self }
    }

    /// The surface, if it is not that of a folder of tiles.
    pub fn surface(&self) -> Option<&Surface> {
        match &self.ground {
            Ground::Points(surface) => Some(surface),
            Ground::Tiles(_) => None,
        }
    }

    /// The cells.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The system of coordinates, where it is known.
    pub fn crs(&self) -> Option<&Crs> {
        self.crs.as_ref()
    }

    /// Remarks on what might surprise.
    pub fn remarks(&self) -> &[Remark] {
        &self.remarks
    }

    /// The rows in bands that are made at once.
    ///
    /// # Errors
    /// [`Error::LargeRow`] if the memory of a folder of tiles does not hold a row.
    pub fn bands(&self) -> Result<Vec<Range<usize>>, Error> {
        let at_once = (CELLS_AT_ONCE / self.grid.columns().max(1)).max(1);
        match &self.ground {
            Ground::Points(_) => Ok(even(&self.grid, at_once)),
            Ground::Tiles(tiles) => tiles.bands(&self.grid, at_once),
        }
    }

    /// The lines of equal height, at multiples of an interval; without one there are about ten heights.
    ///
    /// # Errors
    /// [`Error::NeedsMemory`] for a folder of tiles; as [`Surface::contours`].
    pub fn contours(&self, interval: Option<f64>) -> Result<Vec<ContourLine>, Error> {
        self.surface().ok_or(Error::NeedsMemory("a map of contours"))?.contours(interval)
    }

    /// The heights of some rows.
    ///
    /// # Errors
    /// As [`Surface::values`] and [`Tiled::values`].
    pub fn rows(&self, rows: Range<usize>) -> Result<Vec<f64>, Error> {
        let window = self.grid.window(0..self.grid.columns(), rows);
        let mut values = match &self.ground {
            Ground::Points(surface) => surface.values(&window),
            Ground::Tiles(tiles) => tiles.values(&window),
        }?;
        if let Some(clip) = &self.clip {
            clip.apply(&window, &mut values);
        }
        Ok(values)
    }

    /// The heights of all cells, row by row; NaN where there is none.
    ///
    /// # Errors
    /// As [`Self::rows`] and [`Self::bands`].
    pub fn values(&self) -> Result<Vec<f64>, Error> {
        let mut values = Vec::new();
        for band in self.bands()? {
            values.append(&mut self.rows(band)?);
        }
        Ok(values)
    }

    /// Contents of the model that files lack: the system of coordinates, of formats that have no room for it.
    pub fn losses(&self, files: &[(PathBuf, Format)]) -> Vec<String> {
        let Some(crs) = &self.crs else { return Vec::new() };
        let lost = |(path, format): &(PathBuf, Format)| {
            let path = path.display();
            match format.says(crs) {
                Said::Not => Some(format!("{path}: nothing in it says that its coordinates are {crs}")),
                Said::Otherwise => Some(format!(
                    "{path}: readers will take its coordinates, which are {crs}, for longitude and latitude"
                )),
                _ => None,
            }
        };
        files.iter().filter_map(lost).collect()
    }

    /// Writes files by their formats: rasters (`tif`, `asc`, `npy`), hillshades (`png`) and contours (`geojson`, `fgb`, `gpkg`); all of
    /// them, or none, and what lies beside rasters; files beside an earlier raster of the name are removed. `progress` is told after each band how many rows are done, and may end the work. Gives the number of
    /// cells with a height.
    ///
    /// # Errors
    /// [`Error::In`] with the file that cannot be written; [`Error::Levels`]; [`Error::Stopped`].
    pub fn write(
        &self,
        files: &[(PathBuf, Format)],
        product: &Product,
        mut progress: impl FnMut(usize) -> ControlFlow<()>,
    ) -> Result<u64, Error> {
        let at = |path: &Path| {
            let path = path.to_owned();
            move |error: delone_io::Error| Error::File(error).at(path)
        };
        let (maps, rasters): (Vec<_>, Vec<_>) = files.iter().partition(|file| is_map(file.1));
        let mut done = Vec::new();
        if !maps.is_empty() {
            let lines = self.contours(product.interval)?;
            let map = ContourMap { lines: &lines, bands: &[], crs: self.crs.as_ref() };
            for (path, format) in maps {
                let mut write = || {
                    let mut output = Output::create(path)?;
                    write_contours(&mut output, *format, &map, 0)?;
                    done.push(output.finish()?);
                    Ok(())
                };
                write().map_err(at(path))?;
            }
        }
        let mut sheets = Sheets::new(self.grid, self.crs.clone(), product);
        for (path, format) in &rasters {
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
            let scratch = Some(folder.unwrap_or(Path::new(".")).to_owned());
            let output = Output::create(path).map_err(|error| at(path)(error.into()))?;
            sheets.add(output, *format, scratch).map_err(at(path))?;
        }
        let bands = if rasters.is_empty() { Vec::new() } else { self.bands()? };
        for band in bands {
            let end = band.end;
            sheets.write_rows(&self.rows(band)?).map_err(|(k, error)| at(&rasters[k].0)(error))?;
            if progress(end).is_break() {
                return Err(Error::Stopped);
            }
        }
        let (known, mut stale) = (sheets.known(), Vec::new());
        if !rasters.is_empty() {
            let outputs = sheets.finish().map_err(|(k, error)| at(&rasters[k].0)(error))?;
            for (output, (path, format)) in outputs.into_iter().zip(&rasters) {
                let finish = || {
                    done.push(output.finish()?);
                    let side = beside_raster(path, *format, &self.grid, self.crs.as_ref());
                    stale.extend(stale_sides(path, *format, side.as_ref().map(|side| side.0.as_path())));
                    if let Some((side, text)) = side {
                        let mut output = Output::create(&side)?;
                        output.write_all(text.as_bytes())?;
                        done.push(output.finish()?);
                    }
                    Ok(())
                };
                finish().map_err(at(path))?;
            }
        }
        give_names(done).map_err(|(path, error)| at(&path)(error.into()))?;
        for side in stale {
            std::fs::remove_file(&side).map_err(|error| at(&side)(error.into()))?;
        }
        Ok(known)
    }
}

/// Whether contours are written to files of a format as features.
pub fn is_map(format: Format) -> bool {
    let holds = |contents| format.holds(contents, Direction::Written);
    holds(Contents::Contours) && !holds(Contents::Pictures)
}

/// The files beside an earlier raster of that name, which would move this one elsewhere. Shapefiles have a `.prj` too.
fn stale_sides(path: &Path, format: Format, written: Option<&Path>) -> Vec<PathBuf> {
    let is_shapes = |side: &Path| {
        side.extension().is_some_and(|extension| extension == "prj") && path.with_extension("shp").exists()
    };
    let mut sides = besides_of_raster(path, format);
    sides.retain(|side| side.is_file() && Some(side.as_path()) != written && !is_shapes(side));
    sides
}
