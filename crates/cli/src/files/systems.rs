//! Systems of coordinates are passed on, or a line says where they are not.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use delone_io::{Crs, Format, Said, picture};

use crate::message::{Failure, lost, mislead};

/// Systems and outputs of this run. Readers find the systems, writers name the outputs, and at the end both are compared.
static RUN: Mutex<Run> = Mutex::new(Run {
    said: None,
    known: None,
    inputs: Vec::new(),
    is_in_degrees: false,
    outputs: Vec::new(),
});

struct Run {
    /// The system that the command line says all inputs have.
    said: Option<Crs>,
    /// The system of the input that was read first, or of a file beside it until then.
    known: Option<Known>,
    /// Files that are read, with their formats.
    inputs: Vec<(PathBuf, Format)>,
    /// Whether an input that names no system is longitude and latitude by its format.
    is_in_degrees: bool,
    outputs: Vec<(PathBuf, Format)>,
}

fn run() -> MutexGuard<'static, Run> {
    RUN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Inputs have this system from now on, whatever their files tell; files beside them have it if they tell none.
pub(crate) fn say_system(crs: Crs) {
    run().said.get_or_insert(crs);
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

impl Known {
    /// The error that two files have different systems. The file beside the input is the one to transform, whichever was read
    /// first.
    fn differs_from(&self, first: &Self) -> Failure {
        let is_first_wrong = first.role == Role::Beside && self.role == Role::Input;
        let (wrong, right) = if is_first_wrong { (first, self) } else { (self, first) };
        let [this, that] = [wrong, right].map(|known| known.path.display());
        Failure::new(
            format!("{this}: its coordinates are {}, those of {that} {}", wrong.crs, right.crs),
            "transform one of them first: ogr2ogr, gdalwarp and pdal do so",
        )
    }
}

/// Finds the system of a file: its own, that of a file beside it, or the one that was said. Keeps it for the outputs.
///
/// # Errors
/// If another input has another one.
pub(super) fn find_system(
    crs: &mut Option<Crs>,
    path: &Path,
    role: Role,
    quiet: bool,
) -> Result<(), Failure> {
    let losses = delone_io::heed_sides(crs, path);
    losses.iter().for_each(|loss| lost(quiet, loss));
    let mut run = run();
    if let Some(said) = run.said.as_ref().filter(|_| role == Role::Input || crs.is_none()) {
        *crs = Some(said.clone());
    }
    let Some(crs) = crs else {
        let is_geojson = |(input, format): &(PathBuf, Format)| input == path && *format == Format::GeoJson;
        run.is_in_degrees |= role == Role::Input && run.inputs.iter().any(is_geojson);
        return Ok(());
    };
    let own = Known { crs: crs.clone(), path: path.to_owned(), role };
    match &run.known {
        Some(first) if !first.crs.agrees(&own.crs) => return Err(own.differs_from(first)),
        Some(first) if first.role == Role::Input || role == Role::Beside => {}
        _ => run.known = Some(own),
    }
    Ok(())
}

/// Keeps a file that is read.
pub(super) fn expect_input(path: &Path, format: Format) {
    run().inputs.push((path.to_owned(), format));
}

/// The system in which pictures show coordinates: that of the mesh, or that of GeoJSON that names none (RFC 7946, section 4).
pub(crate) fn drawn_system(crs: Option<&Crs>, format: Format) -> Option<Crs> {
    let is_picture = matches!(format, Format::Svg | Format::Png);
    let of_format = || (is_picture && run().is_in_degrees).then(|| Crs::of_name("OGC:CRS84")).flatten();
    crs.cloned().or_else(of_format)
}

/// Options of a picture with the system that the input has by its format.
pub(crate) fn drawn(options: &picture::Options) -> picture::Options {
    let crs = drawn_system(options.crs.as_ref(), Format::Svg);
    picture::Options { crs, ..options.clone() }
}

/// Keeps the system of a folder of tiles for the outputs.
pub(crate) fn keep_system(crs: Option<&Crs>, folder: &Path) {
    let known = |crs: &Crs| Known { crs: crs.clone(), path: folder.to_owned(), role: Role::Input };
    run().known = crs.map(known);
}

/// Keeps the outputs of the command.
pub(super) fn expect(outputs: &[(PathBuf, Format)]) {
    run().outputs.extend_from_slice(outputs);
}

/// The outputs of the command.
pub(super) fn outputs() -> Vec<(PathBuf, Format)> {
    run().outputs.clone()
}

/// Says which outputs do not tell their system, or not to all readers.
pub(super) fn tell(quiet: bool) {
    let Some(Known { crs, .. }) = run().known.take() else { return };
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
