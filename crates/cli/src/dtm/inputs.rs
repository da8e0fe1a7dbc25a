//! Which files are read, which points of them, and where work is done.

use std::path::{Path, PathBuf};

use delone_io::{Cloud, Format, LAS_CLASSES, TemporaryFolder};
use delone_store::{Build, Store};
use delone_terrain::{Clip, Error, GROUND, Lines, Remark};

use super::failure::{failure, failure_of_level};
use crate::args::{DtmArgs, InputArgs};
use crate::files;
use crate::message::{Failure, note, warn};
use crate::tiles::{self, Watched};

/// The files of a command, and of these ground alone where nothing else is said.
pub(super) fn resolve(args: &DtmArgs) -> InputArgs {
    let mut input = args.input.clone();
    if input.las.class.is_empty() && !args.all_classes && has_classes(&input) {
        input.las.class.push(GROUND);
    }
    input
}

/// Whether some file has classes of points.
fn has_classes(input: &InputArgs) -> bool {
    let is_las = |path: &PathBuf| input.from.or_else(|| Format::of(path).ok()).is_some_and(files::is_las);
    input.input.iter().any(is_las)
}

/// Refuses points that have no surface.
pub(super) fn check(cloud: &Cloud, label: &Path, args: &DtmArgs) -> Result<(), Failure> {
    check_count(cloud.xy.len() as u64, label, args)?;
    delone_terrain::heights_of(cloud).map(drop).map_err(|error| failure(label, error))
}

/// Refuses no points.
pub(super) fn check_count(count: u64, label: &Path, args: &DtmArgs) -> Result<(), Failure> {
    if count > 0 {
        return Ok(());
    }
    let names: Vec<String> = args.input.las.class.iter().map(|&class| name(class)).collect();
    let of = match &names[..] {
        [] if args.all_classes || !has_classes(&args.input) => {
            let what = format!("{}: there are no points", label.display());
            return Err(Failure::new(what, "give points with heights"));
        }
        [] => " of ground".to_owned(),
        names => format!(" of class {}", names.join(", ")),
    };
    let what = format!("{}: there are no points{of}", label.display());
    Err(Failure::new(what, "see delone info for the classes there are; take all with --all-classes"))
}

fn name(class: u8) -> String {
    LAS_CLASSES.iter().find(|known| known.1 == class).map_or(class.to_string(), |known| known.0.to_owned())
}

/// Reads breaklines and level polygons.
pub(super) fn lines(args: &DtmArgs, quiet: bool) -> Result<Lines, Failure> {
    let mut lines = Lines::new();
    for path in &args.breaklines {
        let graph = files::graph_beside(path, quiet)?;
        lines.breaklines(&graph).map_err(|error| failure(path, error))?;
    }
    for path in &args.flat {
        let graph = files::polygons_beside(path, quiet)?;
        let remarks = lines.level(&graph).map_err(|error| failure_of_level(path, error))?;
        remarks.iter().for_each(|remark| tell(remark, Some(path), quiet));
    }
    Ok(lines)
}

/// Reads polygons to clip to; the points of a file without lines are one ring.
pub(super) fn clip(path: &Path, quiet: bool) -> Result<Clip, Failure> {
    let format = files::format_beside(path)?;
    let graph = files::polygons_beside(path, quiet)?;
    // Points of Triangle's graphs are a ring, whatever segments there are.
    if graph.rings.is_empty() && format != Format::Poly && files::holds_lines(path, format) {
        return Err(failure(path, Error::NoPolygon));
    }
    Clip::of(&graph).map_err(|error| failure(path, error))
}

/// Tells of a remark, and the file that it is about.
pub(super) fn tell(remark: &Remark, path: Option<&Path>, quiet: bool) {
    let label = path.map(|path| format!("{}: ", path.display())).unwrap_or_default();
    if remark.is_warning() {
        warn(quiet, format_args!("{label}{remark}"));
    } else {
        note(quiet, format_args!("{label}{remark}"));
    }
}

/// A folder for tiles beside the first output that is a file; it goes with the work.
pub(super) fn workspace(outputs: &[(PathBuf, Format)]) -> Result<TemporaryFolder, Failure> {
    let folder = outputs.iter().map(|output| files::folder_of(&output.0)).next().unwrap_or(Path::new("."));
    TemporaryFolder::create(folder).map_err(|error| {
        let what = format!("cannot make a folder for tiles in {}: {error}", folder.display());
        Failure::new(what, "check the permissions and the room on the disk")
    })
}

/// Makes tiles of the input in a folder, with heights.
pub(super) fn tiles(
    args: &DtmArgs,
    input: &InputArgs,
    (folder, memory): (&Path, u64),
    watch: &Watched,
) -> Result<(Store, Cloud), Failure> {
    let files = crate::tiles::input(input, true)?;
    let build = Build::new().memory(memory).heights(true).duplicates(args.duplicates.rule()).tile(args.tile);
    build.run(&files, folder, watch).map_err(tiles::failure)
}
