//! Folders and patterns stand for files: shells that expand patterns do so before, others leave it to programs.

use std::path::{Path, PathBuf};

use delone_io::Format;

use crate::args::{Command, InputArgs};
use crate::message::Failure;
use crate::{files, tiles};

/// The file that describes Entwine Point Tiles in its folder.
const EPT: &str = "ept.json";

/// The files of points of a command that reads some.
fn input(command: &mut Command) -> Option<&mut InputArgs> {
    Some(match command {
        Command::Triangulate(args) => &mut args.input,
        Command::Tiles(args) => &mut args.input,
        Command::Dtm(args) => &mut args.input,
        Command::Interpolate(args) => &mut args.input,
        Command::Mesh(args) => &mut args.input,
        Command::Check(args) => &mut args.input,
        Command::Draw(args) => &mut args.input,
        Command::Info(args) => &mut args.input,
        Command::Locate(args) => &mut args.input,
        Command::Nearest(args) => &mut args.input,
        Command::Alpha(args) => &mut args.input,
        Command::Graph(args) => &mut args.input,
        Command::Hull(args) => &mut args.input,
        Command::Furthest(args) => &mut args.input,
        Command::Voronoi(args) => &mut args.input,
        Command::Contours(args) => &mut args.input,
        Command::Simplify(args) => &mut args.input,
        _ => return None,
    })
}

/// Expands the input of a command. A folder that `delone tiles` made stays one for commands that know them.
pub(crate) fn expand_all(command: &mut Command) -> Result<(), Failure> {
    let may_be_tiles = matches!(command, Command::Info(_) | Command::Check(_));
    input(command).map_or(Ok(()), |input| expand(input, may_be_tiles))
}

/// Puts the LAS and LAZ files and the EPT of folders, nested ones too, in their place, by name; and the files that patterns stand for. Folders of
/// tiles stay if the command may have one.
pub fn expand(input: &mut InputArgs, may_be_tiles: bool) -> Result<(), Failure> {
    let from = input.from;
    let takes_folders = from.is_none_or(files::is_las);
    for path in std::mem::take(&mut input.input) {
        let mut inside = if takes_folders { clouds(&path, from)? } else { Vec::new() };
        if !inside.is_empty() {
            input.input.append(&mut inside);
        } else if path.is_dir() && !may_be_tiles {
            let what = format!("{} is a folder, with no las or laz file in it", path.display());
            return Err(Failure::new(what, "name a file in it"));
        } else if let Some(mut files) = alike(&path)? {
            input.input.append(&mut files);
        } else {
            input.input.push(path);
        }
    }
    Ok(())
}

/// The files of point clouds in a folder and in those below, if it is a folder and not one of tiles. A folder of Entwine Point Tiles has one, the
/// file that tells of the others. Links to folders are not followed: they may lead back.
fn clouds(folder: &Path, from: Option<Format>) -> Result<Vec<PathBuf>, Failure> {
    let mut found = Vec::new();
    if !folder.is_dir() || folder.join(tiles::MANIFEST).exists() {
        return Ok(found);
    }
    let mut pending = vec![folder.to_owned()];
    while let Some(folder) = pending.pop() {
        let one = folder.join(EPT);
        if from != Some(Format::Las) && one.is_file() {
            found.push(one);
            continue;
        }
        let failed = |error: std::io::Error| Failure::file(&folder, &error.into());
        for entry in std::fs::read_dir(&folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            let path = entry.path();
            if entry.file_type().map_err(failed)?.is_dir() {
                pending.push(path);
            } else if from != Some(Format::Ept) && Format::of(&path).ok() == Some(Format::Las) {
                found.push(path);
            }
        }
    }
    found.sort();
    Ok(found)
}

/// The files that a pattern stands for, by name; nothing if it is the name of a file or none.
fn alike(path: &Path) -> Result<Option<Vec<PathBuf>>, Failure> {
    let Some(pattern) = path.to_str().filter(|text| text.contains(['*', '?']) && !path.exists()) else {
        return Ok(None);
    };
    let wrong = |what: &dyn std::fmt::Display| {
        Failure::new(format!("{pattern}: {what}"), "name a file, a folder, or a pattern such as survey/*.laz")
    };
    let files: Result<Vec<PathBuf>, _> = glob::glob(pattern).map_err(|error| wrong(&error))?.collect();
    let files: Vec<PathBuf> =
        files.map_err(|error| wrong(&error))?.into_iter().filter(|path| path.is_file()).collect();
    if files.is_empty() { Err(wrong(&"no file is like that")) } else { Ok(Some(files)) }
}
