//! Files beside a raster: written with it, and removed with the raster that they were of.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use delone::surface::Grid;
use delone_io::{Crs, Format, beside_raster, besides_of_raster};

use super::apart::refuse_read;
use super::is_special;
use crate::message::{Failure, note, warn};

/// Files to remove when the outputs of the command get their names.
static STALE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Writes the file that says what a raster's own cannot. Files beside an earlier raster of that name, which would move this one elsewhere,
/// go with that raster.
pub(crate) fn write_sides(
    path: &Path,
    format: Format,
    grid: &Grid,
    crs: Option<&Crs>,
    quiet: bool,
) -> Result<(), Failure> {
    let written = beside_raster(path, format, grid, crs);
    if let Some((side, text)) = &written {
        super::write(side, |out| Ok(std::io::Write::write_all(out, text.as_bytes())?))?;
    }
    if is_special(path) {
        return Ok(());
    }
    let stale = besides_of_raster(path, format);
    let is_stale = |side: &&PathBuf| side.is_file() && written.as_ref().is_none_or(|own| own.0 != **side);
    for side in stale.iter().filter(is_stale) {
        // Shapefiles have such a file too, under the same name.
        if side.extension() == Some("prj".as_ref()) && path.with_extension("shp").exists() {
            warn(quiet, format_args!("{}: it may not be that of {}", side.display(), path.display()));
        } else if refuse_read(side).is_ok() {
            note(quiet, format_args!("{}: removed, it was that of an earlier raster", side.display()));
            STALE.lock().unwrap_or_else(PoisonError::into_inner).push(side.clone());
        }
    }
    Ok(())
}

/// Removes what belonged to files that are replaced.
pub(super) fn remove_stale() -> Result<(), Failure> {
    let stale = std::mem::take(&mut *STALE.lock().unwrap_or_else(PoisonError::into_inner));
    stale.iter().try_for_each(|side| match std::fs::remove_file(side) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            let what = format!("cannot remove {}: {error}", side.display());
            Err(Failure::new(what, "it is of an earlier raster: remove it, or choose another name"))
        }
        _ => Ok(()),
    })
}
