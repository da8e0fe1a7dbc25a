//! Errors of folders of tiles, with advice.

use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};

use crate::bytes::in_words;

/// Why a folder of tiles could not be made, read or trusted.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file of the folder was changed or lost after it was written.
    #[error("{}: {what}", path.display())]
    Changed {
        /// The file, or the folder.
        path: PathBuf,
        /// The fault.
        what: String,
    },
    /// A file is in the folder that no record of it knows.
    #[error("{}: tiles.json does not know it", path.display())]
    Unknown {
        /// The file.
        path: PathBuf,
    },
    /// The border of a node is damaged.
    #[error("{}: {what}", path.display())]
    Border {
        /// Its file.
        path: PathBuf,
        /// The fault.
        what: String,
    },
    /// The bucket of a tile, in which its points wait, is damaged or lost.
    #[error("{}: {what}", path.display())]
    Bucket {
        /// Its file.
        path: PathBuf,
        /// The fault.
        what: String,
    },
    /// The border of a tile that must be done is not there.
    #[error("{} is missing", path.display())]
    Missing {
        /// Its file.
        path: PathBuf,
    },
    /// `tiles.json` is not what a run has written.
    #[error("{}: {what}", path.display())]
    Manifest {
        /// Its path.
        path: PathBuf,
        /// The fault.
        what: String,
    },
    /// `tiles.json` is of another version of the format.
    #[error("{}: it is of version {found}, and this program knows {known}", path.display())]
    Version {
        /// Its path.
        path: PathBuf,
        /// The version it is of.
        found: u64,
        /// The version that is read.
        known: u64,
    },
    /// A folder has no tiles.
    #[error("{} is a folder without tiles.json", folder.display())]
    NoTiles {
        /// The folder.
        folder: PathBuf,
    },
    /// The tiles of a folder are not done.
    #[error("{}: the tiles are not finished", folder.display())]
    Unfinished {
        /// The folder.
        folder: PathBuf,
    },
    /// Another run works in the folder.
    #[error("another run works in {}", folder.display())]
    Locked {
        /// The folder.
        folder: PathBuf,
    },
    /// The folder has other files.
    #[error("{} is not empty", folder.display())]
    NotEmpty {
        /// The folder.
        folder: PathBuf,
    },
    /// The folder has tiles, and the run was not to be resumed.
    #[error("{} has tiles already", folder.display())]
    HasTiles {
        /// The folder.
        folder: PathBuf,
    },
    /// The folder has files and no run to resume.
    #[error("{} is not empty and has no tiles.json", folder.display())]
    NothingToResume {
        /// The folder.
        folder: PathBuf,
    },
    /// The folder cannot be made or read.
    #[error("{}: {error}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// The error of the system.
        error: io::Error,
    },
    /// A file that is read or written beside the tiles is in their folder.
    #[error("{} is in the folder of the tiles", path.display())]
    Inside {
        /// The file.
        path: PathBuf,
    },
    /// A run is resumed with another input than it began with.
    #[error("{} the run in {}", difference.words(), folder.display())]
    OtherInput {
        /// The difference.
        difference: Difference,
        /// The folder.
        folder: PathBuf,
    },
    /// A file cannot be read piece by piece, twice.
    #[error("{} cannot be read piece by piece, twice", path.display())]
    NotInPieces {
        /// The file.
        path: PathBuf,
    },
    /// Attributes of points, which tiles do not have, were asked for.
    #[error("points in tiles have no attributes")]
    Attributes,
    /// The heights of a file that has none are to be kept.
    #[error("{}: it has no heights", path.display())]
    NoHeights {
        /// The file.
        path: PathBuf,
    },
    /// The input changed while it was read.
    #[error("the input changed while it was read: {count} points, {before} before")]
    InputChanged {
        /// The points that were read.
        count: u64,
        /// The points that were counted before.
        before: u64,
    },
    /// The points of the input are not as many as `tiles.json` has.
    #[error("{}: it has {known} points, and the input {count}", path.display())]
    CountDiffers {
        /// `tiles.json`.
        path: PathBuf,
        /// The points that it has.
        known: u64,
        /// The points that were read.
        count: u64,
    },
    /// A point is wrong.
    #[error("{}: {error}", path.display())]
    Points {
        /// The file that it is in.
        path: PathBuf,
        /// The fault.
        error: delone::Error,
    },
    /// A file of the input, or of the folder, cannot be read.
    #[error("{}: {error}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The fault.
        error: delone_io::Error,
    },
    /// A file cannot be written.
    #[error("cannot write {}: {error}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The fault.
        error: delone_io::Error,
    },
    /// A bucket cannot be written.
    #[error("cannot write {}: {error}", path.display())]
    WriteBucket {
        /// The bucket.
        path: PathBuf,
        /// The fault.
        error: io::Error,
    },
    /// Less memory is allowed than any run takes.
    #[error("{} is not enough: {} are the least", in_words(*memory), in_words(*least))]
    LittleMemory {
        /// The bytes that are allowed.
        memory: u64,
        /// The least.
        least: u64,
    },
    /// A tile is to have no point.
    #[error("a tile has at least one point")]
    EmptyTiles,
    /// A tile does not fit into memory.
    #[error("{} has {points} points, which take {}, and memory allows {}", path.display(), in_words(*needed), in_words(*memory))]
    LargeTile {
        /// Its bucket.
        path: PathBuf,
        /// Its points.
        points: u64,
        /// The bytes that they take.
        needed: u64,
        /// The bytes that are allowed.
        memory: u64,
    },
    /// The borders of a node cannot be joined in memory.
    #[error(
        "the borders that meet at node {node} have {points} points, {share:.1}% of all: to join them takes {}, and memory allows {}",
        in_words(*needed), in_words(*memory)
    )]
    LargeJoin {
        /// The number of the node.
        node: u32,
        /// The points of its borders.
        points: u64,
        /// Their share of all, in percent.
        share: f64,
        /// The bytes that they take.
        needed: u64,
        /// The bytes that are allowed.
        memory: u64,
    },
    /// The borders of some nodes do not fit each other.
    #[error("node {node} cannot be joined of nodes {parts:?}: {error}")]
    Join {
        /// The number of the node.
        node: u32,
        /// The numbers of its parts.
        parts: Vec<u32>,
        /// The fault.
        error: Box<dyn std::error::Error + Send + Sync>,
    },
    /// Tiles and seams are no triangulation of as many points.
    #[error(
        "{}: {vertices} vertices, {duplicates} duplicates, {triangles} triangles and {hull} vertices of the hull are no triangulation of \
         {points} points",
        folder.display()
    )]
    NotWhole {
        /// The folder.
        folder: PathBuf,
        /// The vertices of all tiles.
        vertices: u64,
        /// The points that equal others.
        duplicates: u64,
        /// The triangles of tiles and seams.
        triangles: u64,
        /// The vertices of the hull.
        hull: u64,
        /// The points of the input.
        points: u64,
    },
    /// Whoever looks on has refused to go on, or failed.
    #[error(transparent)]
    Outside(Box<dyn std::error::Error + Send + Sync>),
    /// Whoever looks on wanted no more. The run can be resumed.
    #[error("the work was stopped")]
    Stopped,
}

/// The difference of an input from that of the run that is resumed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Difference {
    /// The same files are read in another way.
    Options,
    /// The same files were written since.
    Changed,
    /// The files are others.
    Files,
}

impl Difference {
    fn words(self) -> &'static str {
        match self {
            Self::Options => "formats, classes, columns or heights are others than those of",
            Self::Changed => "the input has changed since",
            Self::Files => "the input is another one than that of",
        }
    }
}

impl Error {
    /// Advice to the user, in the words of the program.
    pub fn help(&self) -> Cow<'static, str> {
        Cow::Borrowed(match self {
            Self::Changed { .. } => "files of the folder were changed or lost: start again in another folder",
            Self::Unknown { .. } => {
                "if delone tiles was stopped while it wrote neighbors or tables, go on with --resume; or remove it"
            }
            Self::Border { .. } => {
                "remove that file to have the node made again, if its bucket or the borders of its parts are there"
            }
            Self::Bucket { .. } => {
                "its points are lost: start again in another folder, or with this one empty"
            }
            Self::Manifest { .. } => {
                "start again in another folder; tiles.json is written by delone tiles alone"
            }
            Self::Version { .. } => "use the version of delone that began it, or start again",
            Self::NoTiles { .. } => "name a folder that delone tiles made, or a file",
            Self::Unfinished { .. } => "go on with delone tiles --resume",
            Self::Locked { .. } => "wait for its end, or name another folder",
            Self::NotEmpty { .. } => "name another folder for the tiles",
            Self::HasTiles { .. } => "go on with --resume, or name another folder",
            Self::NothingToResume { .. } => "name the folder of the run that is to go on",
            Self::Folder { .. } => "name a folder that can be made or written",
            Self::Inside { .. } => "name a file somewhere else",
            Self::OtherInput { .. } => {
                "go on with what that run began with, or start again in another folder"
            }
            Self::NotInPieces { .. } => "name a file, decompressed unless it is text",
            Self::Attributes => "leave --attributes out",
            Self::NoHeights { .. } => "give files with heights: x, y and z",
            Self::InputChanged { .. } => "start again in another folder when nobody writes to it",
            Self::CountDiffers { .. } => {
                "it was changed: start again in another folder, or with this one empty"
            }
            Self::Points { .. } => "remove that point or repair it",
            Self::Write { error: delone_io::Error::Io(_), .. } => {
                "check the name, the permissions and the room on the disk"
            }
            Self::Read { error, .. } | Self::Write { error, .. } => return error.help(),
            Self::WriteBucket { .. } => {
                "make room on the disk, or check the permissions; then go on with --resume"
            }
            Self::LittleMemory { .. } => "allow more memory, as in --memory 1G",
            Self::EmptyTiles => "give a larger number",
            Self::LargeTile { needed, .. } => {
                return Cow::Owned(format!(
                    "go on with --resume --memory {}, or start again",
                    in_words(*needed)
                ));
            }
            Self::LargeJoin { needed, .. } => {
                return Cow::Owned(format!(
                    "go on with --resume --memory {}; borders are small unless points lie on few circles or lines",
                    in_words(*needed)
                ));
            }
            Self::Join { .. } => "the files of the folder are not of one run: start again in another folder",
            Self::NotWhole { .. } => {
                "start again in another folder; if nobody changed files in this one, please report it: it is a bug"
            }
            Self::Missing { .. } | Self::Outside(_) | Self::Stopped => "go on with --resume",
        })
    }

    /// Whether the request is wrong, not the data or the disk.
    pub fn is_usage(&self) -> bool {
        matches!(
            self,
            Self::Locked { .. }
                | Self::NotEmpty { .. }
                | Self::HasTiles { .. }
                | Self::NothingToResume { .. }
                | Self::Inside { .. }
                | Self::OtherInput { .. }
                | Self::NotInPieces { .. }
                | Self::Attributes
                | Self::LittleMemory { .. }
                | Self::EmptyTiles
        )
    }

    /// The error of a file that nobody should have changed.
    pub(crate) fn changed(path: &Path, what: impl std::fmt::Display) -> Self {
        Self::Changed { path: path.to_owned(), what: what.to_string() }
    }

    pub(crate) fn points(path: &Path, error: delone::Error) -> Self {
        Self::Points { path: path.to_owned(), error }
    }

    pub(crate) fn read(path: &Path, error: impl Into<delone_io::Error>) -> Self {
        Self::Read { path: path.to_owned(), error: error.into() }
    }

    pub(crate) fn write(path: &Path, error: impl Into<delone_io::Error>) -> Self {
        Self::Write { path: path.to_owned(), error: error.into() }
    }
}
