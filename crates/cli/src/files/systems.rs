//! Systems of coordinates are passed on, or a line says where they are not.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock, PoisonError};

use delone_io::{Crs, Format, Said};

use crate::message::{Failure, lost, mislead};

/// The system of the input that was read first, or of a file beside it until then.
static SYSTEM: Mutex<Option<Known>> = Mutex::new(None);
/// The system that the command line says all inputs have.
static SAID: OnceLock<Crs> = OnceLock::new();
/// The outputs of the command.
static OUTPUTS: Mutex<Vec<(PathBuf, Format)>> = Mutex::new(Vec::new());

/// Inputs have this system from now on, whatever their files tell; files beside them have it if they tell none.
pub(crate) fn say_system(crs: Crs) {
    SAID.get_or_init(|| crs);
}

/// Whether a file is the input of a command, or beside it: a clip, queries, breaklines.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Role {
    Input,
    Beside,
}

/// A system, and the file that has it.
struct Known {
    crs: Crs,
    path: PathBuf,
    role: Role,
}

/// Keeps the system of a file, which may be the one that was said, or that of a file beside it.
///
/// # Errors
/// If another input has another one.
pub(super) fn heed(crs: &mut Option<Crs>, path: &Path, role: Role, quiet: bool) -> Result<(), Failure> {
    let losses = delone_io::heed_sides(crs, path);
    losses.iter().for_each(|loss| lost(quiet, loss));
    if let Some(said) = SAID.get().filter(|_| role == Role::Input || crs.is_none()) {
        *crs = Some(said.clone());
    }
    let mut system = SYSTEM.lock().unwrap_or_else(PoisonError::into_inner);
    let Some(own) = crs else { return Ok(()) };
    if let Some(known) = &*system
        && !known.crs.agrees(own)
    {
        // The file beside the input is the one to transform, whichever was read first.
        let own = Known { crs: own.clone(), path: path.to_owned(), role };
        let is_first_wrong = known.role == Role::Beside && role == Role::Input;
        let (wrong, right) = if is_first_wrong { (known, &own) } else { (&own, known) };
        let [this, that] = [wrong, right].map(|known| known.path.display());
        return Err(Failure::new(
            format!("{this}: its coordinates are {}, those of {that} {}", wrong.crs, right.crs),
            "transform one of them first: ogr2ogr, gdalwarp and pdal do so",
        ));
    }
    if system.as_ref().is_none_or(|known| known.role == Role::Beside && role == Role::Input) {
        *system = Some(Known { crs: own.clone(), path: path.to_owned(), role });
    }
    Ok(())
}

/// Keeps the outputs of the command.
pub(super) fn expect(outputs: &[(PathBuf, Format)]) {
    OUTPUTS.lock().unwrap_or_else(PoisonError::into_inner).extend_from_slice(outputs);
}

/// The outputs of the command.
pub(super) fn outputs() -> Vec<(PathBuf, Format)> {
    OUTPUTS.lock().unwrap_or_else(PoisonError::into_inner).clone()
}

/// Says which outputs do not tell their system, or not to all readers.
pub(super) fn tell(quiet: bool) {
    let Some(Known { crs, .. }) = SYSTEM.lock().unwrap_or_else(PoisonError::into_inner).take() else {
        return;
    };
    let outputs = outputs();
    let names = |said: Said| {
        let those = outputs.iter().filter(|(_, format)| format.says(&crs) == said);
        those.map(|(path, _)| path.display().to_string()).collect::<Vec<_>>().join(", ")
    };
    let silent = names(Said::Not);
    if !silent.is_empty() {
        lost(quiet, format_args!("{silent}: nothing in it says that its coordinates are {crs}"));
    }
    let flat = outputs.iter().filter(|(_, format)| format.lacks_heights(&crs));
    let flat = flat.map(|(path, _)| path.display().to_string()).collect::<Vec<_>>().join(", ");
    if !flat.is_empty()
        && let Some(number) = crs.vertical
    {
        lost(quiet, format_args!("{flat}: nothing in it says that its heights are EPSG:{number}"));
    }
    let wrong = names(Said::Otherwise);
    if !wrong.is_empty() {
        let what = format!(
            "{wrong}: readers will take its coordinates, which are {crs}, for longitude and latitude"
        );
        mislead(quiet, format_args!("{what}: nothing but EPSG numbers can be said there"));
    }
}
