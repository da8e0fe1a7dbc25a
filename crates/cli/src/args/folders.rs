//! Folders and patterns stand for files: shells that expand patterns do so before, others leave it to programs.

use std::path::{Path, PathBuf};

use delone_io::Format;

use super::{Command, InputArgs};
use crate::message::Failure;
use crate::tiles;

impl Command {
    /// The files of points of a command that reads some.
    pub(crate) fn input(&mut self) -> Option<&mut InputArgs> {
        Some(match self {
            Self::Triangulate(args) => &mut args.input,
            Self::Tiles(args) => &mut args.input,
            Self::Dtm(args) => &mut args.input,
            Self::Interpolate(args) => &mut args.input,
            Self::Mesh(args) => &mut args.input,
            Self::Check(args) => &mut args.input,
            Self::Draw(args) => &mut args.input,
            Self::Animate(args) => &mut args.input,
            Self::Info(args) => &mut args.input,
            Self::Reduce(args) => &mut args.input,
            Self::Locate(args) => &mut args.input,
            Self::Nearest(args) => &mut args.input,
            Self::Alpha(args) => &mut args.input,
            Self::Graph(args) => &mut args.input,
            Self::Hull(args) => &mut args.input,
            Self::Furthest(args) => &mut args.input,
            Self::Voronoi(args) => &mut args.input,
            Self::Contours(args) => &mut args.input,
            Self::Simplify(args) => &mut args.input,
            _ => return None,
        })
    }
}

impl InputArgs {
    /// Puts the LAS and LAZ files of folders, nested ones too, in their place, by name; and the files that patterns stand for. A folder that
    /// `delone tiles` made stays one for commands that know them.
    pub(crate) fn expand(&mut self, may_be_tiles: bool) -> Result<(), Failure> {
        let takes_folders = self.from.is_none_or(|format| format == Format::Las);
        for path in std::mem::take(&mut self.input) {
            let mut inside = if takes_folders { clouds(&path)? } else { Vec::new() };
            if !inside.is_empty() {
                self.input.append(&mut inside);
            } else if path.is_dir() && !may_be_tiles {
                let what = format!("{} is a folder, with no las or laz file in it", path.display());
                return Err(Failure::new(what, "name a file in it"));
            } else if let Some(mut files) = alike(&path)? {
                self.input.append(&mut files);
            } else {
                self.input.push(path);
            }
        }
        Ok(())
    }
}

/// The files of point clouds in a folder and in those below, if it is a folder and not one of tiles. Links to folders are not followed: they may lead back.
fn clouds(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut found = Vec::new();
    if !folder.is_dir() || folder.join(tiles::MANIFEST).exists() {
        return Ok(found);
    }
    let mut pending = vec![folder.to_owned()];
    while let Some(folder) = pending.pop() {
        let failed = |error: std::io::Error| Failure::file(&folder, &error.into());
        for entry in std::fs::read_dir(&folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            let path = entry.path();
            if entry.file_type().map_err(failed)?.is_dir() {
                pending.push(path);
            } else if Format::of(&path).ok() == Some(Format::Las) {
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
