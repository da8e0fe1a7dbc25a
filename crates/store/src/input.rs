//! The points of many files as one row of them, read piece by piece.

use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use delone_io::{Cloud, Format, ReadOptions, read_chunks_beside};
use serde_json::{Value, json};

use crate::error::Error;
use crate::watch::{Watch, go_on, stopped};

/// Points that are read at a time.
const CHUNK: usize = 1 << 16;

/// The files of a run: one set of points, in their order. Each is read twice, piece by piece.
///
/// ```
/// use delone_store::Files;
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("points.csv");
/// std::fs::write(&path, "0,0\n1,0\n0,1\n")?;
/// let files = Files::new([path])?;
/// assert!(!files.options.las.withheld);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Files {
    /// Their names.
    pub paths: Vec<PathBuf>,
    /// Their formats, one for each.
    pub formats: Vec<Format>,
    /// The format that was said of all of them, if their names do not tell. It is a part of what a resumed run compares.
    pub from: Option<Format>,
    /// How they are read; the dimension follows from the heights that a run keeps.
    pub options: ReadOptions,
}

/// Takes points of a file with the index of the first among all, and their heights.
pub(crate) type Take<'a> = &'a mut dyn FnMut(&Path, u64, &[[f64; 2]], Option<&[f64]>) -> Result<(), Error>;

impl Files {
    /// Files whose names tell their formats.
    ///
    /// # Errors
    /// [`Error::Read`] if one does not.
    pub fn new<P: Into<PathBuf>>(paths: impl IntoIterator<Item = P>) -> Result<Self, Error> {
        let paths: Vec<PathBuf> = paths.into_iter().map(Into::into).collect();
        let format = |path: &PathBuf| Format::of(path).map_err(|error| Error::read(path, error));
        let formats = paths.iter().map(format).collect::<Result<_, _>>()?;
        Ok(Self { paths, formats, from: None, options: ReadOptions::default() })
    }

    /// Files whose formats are known.
    pub fn with_formats<P: Into<PathBuf>>(files: impl IntoIterator<Item = (P, Format)>) -> Self {
        let (paths, formats) = files.into_iter().map(|(path, format)| (path.into(), format)).unzip();
        Self { paths, formats, from: None, options: ReadOptions::default() }
    }

    /// Sets how they are read.
    #[must_use]
    pub fn options(self, options: ReadOptions) -> Self {
        Self { options, ..self }
    }

    /// Keeps the classes of LAS files that are named; all of them, if none is.
    #[must_use]
    pub fn classes(mut self, classes: impl Into<Vec<u8>>) -> Self {
        self.options.las.classes = classes.into();
        self
    }
}

/// The files of a run, checked.
pub(crate) struct Input<'a> {
    files: &'a Files,
    has_heights: bool,
    options: ReadOptions,
    watch: &'a dyn Watch,
}

impl<'a> Input<'a> {
    pub(crate) fn new(files: &'a Files, has_heights: bool, watch: &'a dyn Watch) -> Result<Self, Error> {
        if !files.options.dimensions.is_empty() {
            return Err(Error::Attributes);
        }
        for (path, &format) in files.paths.iter().zip(&files.formats) {
            let is_standard = path == Path::new("-");
            let is_file =
                !is_standard && path.metadata().map_err(|error| Error::read(path, error))?.is_file();
            let is_compressed =
                path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("gz"));
            if !is_file || is_compressed && format != Format::Text {
                return Err(Error::NotInPieces { path: path.clone() });
            }
        }
        let options = files.options.clone().dimension(if has_heights { 3 } else { 2 });
        Ok(Self { files, has_heights, options, watch })
    }

    /// The input at present: files, and how they are read.
    pub(crate) fn describe(&self) -> Result<Value, Error> {
        let mut told = json!({
            "files": described(&self.files.paths)?,
            "from": self.files.from.map(|format| format.to_string()),
            "las": format!("{:?}", self.options.las),
            "columns": self.options.columns,
            "heights": self.has_heights,
        });
        if self.options.skip_missing {
            told["skip_missing"] = true.into();
        }
        Ok(told)
    }

    /// Reads all points in their order once more.
    pub(crate) fn read_again(&self, what: &'static str, take: Take) -> Result<Cloud, Error> {
        self.read(what, true, take)
    }

    /// Reads all points in their order, and tells what else the files say, if that is not known from before.
    fn read(&self, what: &'static str, is_told: bool, take: Take) -> Result<Cloud, Error> {
        let mut all = Cloud::default();
        let mut first = 0;
        for (path, &format) in self.files.paths.iter().zip(&self.files.formats) {
            let source = self.watch.open(path, format, what)?;
            // Whoever takes tells why it stops, not the reader.
            let mut refused = None;
            let mut offer = |points: &[[f64; 2]], heights: Option<&[f64]>| {
                let outcome = match heights {
                    None if self.has_heights => Err(Error::NoHeights { path: path.clone() }),
                    _ => self
                        .watch
                        .points(path, first + points.len() as u64)
                        .and_then(|()| go_on(self.watch))
                        .and_then(|()| take(path, first, points, heights.filter(|_| self.has_heights))),
                };
                first += points.len() as u64;
                outcome.map_err(|error| {
                    refused = Some(error);
                    stopped()
                })
            };
            let beside = &mut |extension: &str| self.watch.beside(path, extension);
            let found = read_chunks_beside(source, format, &self.options, CHUNK, &mut offer, beside);
            self.watch.end();
            if let Some(error) = refused {
                return Err(error);
            }
            let failed = |error| self.watch.failed(path, format, error);
            let mut about = found.map_err(failed)?;
            if is_told {
                about.remarks.clear();
                about.losses.clear();
            }
            self.watch.heed(path, &mut about)?;
            all.join(about).map_err(failed)?;
        }
        Ok(all)
    }

    /// Counts the points, and draws a sample of some, about, at hashed indices: those of scan lines or of a grid are not met
    /// in their own rhythm.
    ///
    /// # Errors
    /// The first point that is not finite, or whose height is not.
    pub(crate) fn survey(&self, some: usize) -> Result<(u64, Vec<[f64; 2]>, Cloud), Error> {
        let mut sample: Vec<(u64, [f64; 2])> = Vec::new();
        let (mut most, mut count) = (u64::MAX, 0);
        let about = self.read("counting", false, &mut |path, first, points, heights| {
            let heights = heights.unwrap_or_default();
            if let Some(k) = heights.iter().position(|z| !z.is_finite()) {
                let (index, value) = (first as usize + k, heights[k]);
                return Err(Error::points(path, delone::Error::Height { index, value }));
            }
            for (k, &p) in points.iter().enumerate() {
                let index = first + k as u64;
                if let Some(axis) = p.iter().position(|x| !x.is_finite()) {
                    let error = delone::Error::NotFinite { index: index as usize, axis, value: p[axis] };
                    return Err(Error::points(path, error));
                }
                let hash = hashed(index);
                if hash <= most {
                    sample.push((hash, p));
                    if sample.len() > 2 * some {
                        most /= 2;
                        sample.retain(|&(hash, _)| hash <= most);
                    }
                }
            }
            count = first + points.len() as u64;
            Ok(())
        })?;
        Ok((count, sample.into_iter().map(|(_, p)| p).collect(), about))
    }
}

/// Files as they are now: names, sizes and times.
fn described(paths: &[PathBuf]) -> Result<Value, Error> {
    let of = |path: &PathBuf| {
        let failed = |error: std::io::Error| Error::read(path, error);
        let about = path.metadata().map_err(failed)?;
        let modified = about.modified().ok().and_then(|time| time.duration_since(UNIX_EPOCH).ok());
        let place = path.canonicalize().map_err(failed)?;
        Ok(json!({
            "file": place.to_string_lossy(),
            "bytes": about.len(),
            "modified": modified.map(|time| format!("{}.{:09}", time.as_secs(), time.subsec_nanos())),
        }))
    };
    paths.iter().map(of).collect()
}

/// The finalizer of splitmix64 (Steele, Lea & Flood, OOPSLA 2014).
pub(crate) fn hashed(index: u64) -> u64 {
    let z = index.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}
