//! Points, lines and cells of files.

use std::path::{Path, PathBuf};

use delone::surface::Grid;
use delone_io::{
    Cloud, Crs, Format, Graph, ReadOptions, beside, heed_sides, holds_lines, open, read_graph,
    read_points_beside, read_raster_place,
};

use crate::clip::Clip;
use crate::error::Error;

/// The class of ground in LAS files.
pub const GROUND: u8 = 2;

/// Files of points with heights, which are one set in their order.
///
/// ```no_run
/// use delone_terrain::Files;
///
/// let ground = Files::new(["tile.laz"]).read()?;
/// let all = Files::new(["tile.laz", "more.csv"]).all_classes(true).read()?;
/// assert!(ground.xy.len() <= all.xy.len());
/// # Ok::<(), delone_terrain::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Files {
    /// Their names.
    pub paths: Vec<PathBuf>,
    /// How they are read.
    pub options: ReadOptions,
    /// Whether the points of all classes of LAS files are taken; otherwise ground is, unless the options name classes.
    pub all_classes: bool,
}

impl Files {
    /// Files whose points have heights, of LAS files ground.
    pub fn new<P: Into<PathBuf>>(paths: impl IntoIterator<Item = P>) -> Self {
        let options = ReadOptions::default().dimension(3);
        Self { paths: paths.into_iter().map(Into::into).collect(), options, all_classes: false }
    }

    /// Sets the classes of LAS files that are taken.
    #[must_use]
    pub fn classes(mut self, classes: impl Into<Vec<u8>>) -> Self {
        self.options.las.classes = classes.into();
        self
    }

    /// Sets [`Self::all_classes`].
    #[must_use]
    pub fn all_classes(self, all_classes: bool) -> Self {
        Self { all_classes, ..self }
    }

    /// How they are read: of LAS files ground, if nothing else is said.
    pub fn resolved(&self) -> ReadOptions {
        let mut options = self.options.clone();
        let has_classes = |path: &PathBuf| matches!(Format::of(path), Ok(Format::Las | Format::Ept));
        if options.las.classes.is_empty() && !self.all_classes && self.paths.iter().any(has_classes) {
            options.las.classes.push(GROUND);
        }
        options
    }

    /// Reads all of them.
    ///
    /// # Errors
    /// [`Error::In`] with the file, also where files have different systems of coordinates.
    pub fn read(&self) -> Result<Cloud, Error> {
        let options = self.resolved();
        let mut all = Cloud::default();
        for path in &self.paths {
            let failed = |error| Error::File(error).at(path);
            let (source, format) = open(path).map_err(failed)?;
            let mut cloud =
                read_points_beside(source, format, &options, &mut beside(path)).map_err(failed)?;
            cloud.losses.extend(heed_sides(&mut cloud.crs, path));
            all.join(cloud).map_err(failed)?;
        }
        Ok(all)
    }
}

/// Reads lines and polygons of a file.
///
/// # Errors
/// [`Error::In`] with the file.
pub fn read_lines(path: &Path) -> Result<Graph, Error> {
    read(path, false)
}

/// Reads polygons of a file, which closed lines of drawings are too.
///
/// # Errors
/// [`Error::In`] with the file.
pub fn read_polygons(path: &Path) -> Result<Graph, Error> {
    read(path, true)
}

fn read(path: &Path, closed: bool) -> Result<Graph, Error> {
    let failed = |error| Error::File(error).at(path);
    let options = ReadOptions::default().dimension(2).closed(closed);
    let (source, format) = open(path).map_err(failed)?;
    read_graph(source, format, &options, Some(&mut beside(path))).map_err(failed)
}

/// Reads polygons to clip to; the points of a file that has no lines are one ring.
///
/// # Errors
/// [`Error::In`] with the file; [`Error::NoPolygon`] for lines alone.
pub fn read_clip(path: &Path) -> Result<Clip, Error> {
    let failed = |error| Error::File(error).at(path);
    let graph = read_polygons(path)?;
    if graph.rings.is_empty() {
        let (source, format) = open(path).map_err(failed)?;
        if format != Format::Poly && holds_lines(source, format) {
            return Err(Error::NoPolygon.at(path));
        }
    }
    Clip::of(&graph).map_err(|error| error.at(path))
}

/// Reads where the cells of a raster are, and the system of its coordinates.
///
/// # Errors
/// [`Error::In`] with the file.
pub fn read_place(path: &Path) -> Result<(Grid, Option<Crs>), Error> {
    let failed = |error| Error::File(error).at(path);
    let (source, format) = open(path).map_err(failed)?;
    let (grid, mut crs) = read_raster_place(source, format).map_err(failed)?;
    heed_sides(&mut crs, path);
    Ok((grid, crs))
}
