//! What coordinates mean is passed on, or a line says where it is not.

use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

use delone_io::{Crs, Format, Said};

use crate::message::{note, warn};

/// The system of what was read first.
static SYSTEM: Mutex<Option<Crs>> = Mutex::new(None);
/// The outputs of the command.
static OUTPUTS: Mutex<Vec<(PathBuf, Format)>> = Mutex::new(Vec::new());

/// Keeps the system of an input.
pub(super) fn heed(crs: Option<&Crs>) {
    let mut system = SYSTEM.lock().unwrap_or_else(PoisonError::into_inner);
    if system.is_none() {
        *system = crs.cloned();
    }
}

/// Keeps the outputs of the command.
pub(super) fn expect(outputs: &[(PathBuf, Format)]) {
    OUTPUTS.lock().unwrap_or_else(PoisonError::into_inner).extend_from_slice(outputs);
}

/// Says which outputs do not tell their system, or not to all readers.
pub(super) fn tell(quiet: bool) {
    let Some(crs) = SYSTEM.lock().unwrap_or_else(PoisonError::into_inner).take() else { return };
    let outputs = std::mem::take(&mut *OUTPUTS.lock().unwrap_or_else(PoisonError::into_inner));
    let names = |said: Said| {
        let those = outputs.iter().filter(|(_, format)| format.says(&crs) == said);
        those.map(|(path, _)| path.display().to_string()).collect::<Vec<_>>().join(", ")
    };
    let silent = names(Said::Not);
    if !silent.is_empty() {
        note(quiet, format_args!("{silent}: nothing in it says that its coordinates are {crs}"));
    }
    let wrong = names(Said::Otherwise);
    if !wrong.is_empty() {
        let what = format!(
            "{wrong}: readers will take its coordinates, which are {crs}, for longitude and latitude"
        );
        warn(quiet, format_args!("{what}: nothing but EPSG numbers can be said there"));
    }
}
