//! The points of many files as one row of them, read piece by piece.

use std::path::Path;

use delone::Error;
use delone_io::{Cloud, Format, ReadOptions};
use serde_json::{Value, json};

use super::manifest;
use crate::args::TilesArgs;
use crate::files;
use crate::limits;
use crate::message::Failure;

/// Points that are read at a time.
const CHUNK: usize = 1 << 16;

/// The files of a run.
pub(super) struct Input<'a> {
    args: &'a TilesArgs,
    formats: Vec<Format>,
    options: ReadOptions,
}

/// Takes points of a file with the index of the first among all, and their heights.
pub(super) type Take<'a> = &'a mut dyn FnMut(&Path, u64, &[[f64; 2]], Option<&[f64]>) -> Result<(), Failure>;

impl<'a> Input<'a> {
    pub(super) fn new(args: &'a TilesArgs) -> Result<Self, Failure> {
        let formats = files::formats(&args.input)?;
        if !args.input.las.attributes.is_empty() {
            return Err(Failure::usage("points in tiles have no attributes", "leave --attributes out"));
        }
        for (path, &format) in args.input.input.iter().zip(&formats) {
            let is_standard = path == Path::new("-");
            let is_file = !is_standard
                && path.metadata().map_err(|error| Failure::file(path, &error.into()))?.is_file();
            let is_compressed =
                path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("gz"));
            if !is_file || is_compressed && format != Format::Text {
                let what = format!("{} cannot be read piece by piece, twice", path.display());
                return Err(Failure::usage(what, "name a file, decompressed unless it is text"));
            }
        }
        let dimension = if args.heights { 3 } else { 2 };
        Ok(Self { args, formats, options: files::options(&args.input, dimension) })
    }

    /// The input at present: files, and how they are read.
    pub(super) fn describe(&self) -> Result<Value, Failure> {
        Ok(json!({
            "files": manifest::describe(&self.args.input.input)?,
            "from": self.args.input.from.map(|format| format.to_string()),
            "las": format!("{:?}", self.options.las),
            "columns": self.args.input.columns,
            "heights": self.args.heights,
        }))
    }

    /// Reads all points in their order once more.
    pub(super) fn read_again(&self, what: &'static str, quiet: bool, take: Take) -> Result<Cloud, Failure> {
        self.read(what, quiet, true, take)
    }

    /// Reads all points in their order, and says what else the files tell, if that is not known from before.
    fn read(&self, what: &'static str, quiet: bool, is_told: bool, take: Take) -> Result<Cloud, Failure> {
        let mut all = Cloud::default();
        let mut first = 0;
        for (path, &format) in self.args.input.input.iter().zip(&self.formats) {
            let (source, _phase) = files::open(path, format, what, quiet)?;
            // What stops is told by whoever takes, not by the reader.
            let mut stopped = None;
            let mut offer = |points: &[[f64; 2]], heights: Option<&[f64]>| {
                let outcome = match heights {
                    None if self.args.heights => {
                        let what = format!("{}: it has no heights", path.display());
                        Err(Failure::new(what, "give files with heights: x, y and z"))
                    }
                    _ => limits::check_points(first as usize + points.len(), path)
                        .and_then(|()| take(path, first, points, heights.filter(|_| self.args.heights))),
                };
                first += points.len() as u64;
                outcome.map_err(|failure| {
                    stopped = Some(failure);
                    delone_io::Error::Io(std::io::Error::other("stopped"))
                })
            };
            let (options, beside) = (&self.options, &mut files::beside(path));
            let found = delone_io::read_chunks_beside(source, format, options, CHUNK, &mut offer, beside);
            if let Some(failure) = stopped {
                return Err(failure);
            }
            let failed = |error| files::wrong(path, format, &error);
            let mut about = found.map_err(failed)?;
            if is_told {
                about.remarks.clear();
                about.losses.clear();
            }
            files::heed(&mut about, path, files::Role::Input, quiet)?;
            all.join(about).map_err(failed)?;
        }
        Ok(all)
    }

    /// Counts the points, and draws a sample of some, about, at hashed indices: those of scan lines or of a grid are not met
    /// in their own rhythm.
    ///
    /// # Errors
    /// The first point that is not finite, or whose height is not.
    pub(super) fn survey(&self, some: usize, quiet: bool) -> Result<(u64, Vec<[f64; 2]>, Cloud), Failure> {
        let mut sample: Vec<(u64, [f64; 2])> = Vec::new();
        let (mut most, mut count) = (u64::MAX, 0);
        let about = self.read("counting", quiet, false, &mut |path, first, points, heights| {
            let heights = heights.unwrap_or_default();
            if let Some(k) = heights.iter().position(|z| !z.is_finite()) {
                let (index, value) = (first as usize + k, heights[k]);
                return Err(Failure::points(path, &Error::Height { index, value }));
            }
            for (k, &p) in points.iter().enumerate() {
                let index = first + k as u64;
                if let Some(axis) = p.iter().position(|x| !x.is_finite()) {
                    let error = Error::NotFinite { index: index as usize, axis, value: p[axis] };
                    return Err(Failure::points(path, &error));
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

/// The finalizer of splitmix64 (Steele, Lea & Flood, OOPSLA 2014).
pub(super) fn hashed(index: u64) -> u64 {
    let z = index.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}
