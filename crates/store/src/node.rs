//! Finished nodes: a file with a line that describes the node, and its border behind.
//!
//! A node is done when this file has its name, because it is written last.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};

use delone::tiles::{Border, Cuts, Fingerprint, Node};
use delone_io::sync_folder;
use serde_json::{Value, json};
use twox_hash::XxHash3_64;

use crate::error::Error;
use crate::own;
use crate::places::place;
use crate::sums::Sums;

/// The description of a node.
#[derive(Clone, Debug)]
pub(crate) struct Done {
    pub(crate) node: Node,
    /// Its distinct points and those that equal them, if it is a tile.
    pub(crate) vertices: u64,
    pub(crate) duplicates: u64,
    /// Of its final triangles; of a node that is cut, of those of its seam.
    pub(crate) fingerprint: Fingerprint,
    /// The points of its border.
    pub(crate) border: u64,
    /// The hashes of its files.
    pub(crate) sums: Sums,
}

/// The key of the hash of the border itself, XXH3 of 64 bits as for other files.
const SUM: &str = "sum";

fn path(folder: &Path, node: Node) -> PathBuf {
    place(folder, "border", node, "bin")
}

fn damaged(path: &Path, what: impl std::fmt::Display) -> Error {
    Error::Border { path: path.to_owned(), what: what.to_string() }
}

impl Done {
    /// Bytes of a point of a border, with its id.
    const LEAST: u64 = 24;

    /// As the manifest has it.
    pub(crate) fn describe(&self) -> Value {
        json!({
            "node": self.node.number(),
            "vertices": self.vertices,
            "duplicates": self.duplicates,
            "triangles": self.fingerprint.count(),
            "fingerprint": self.fingerprint.to_string(),
            "border": self.border,
            "files": self.sums.describe(),
        })
    }

    pub(crate) fn parse(value: &Value) -> Option<Self> {
        let count = |name: &str| value[name].as_u64();
        let fingerprint: Fingerprint = value["fingerprint"].as_str()?.parse().ok()?;
        // Rows of a file have numbers of 32 bits.
        let is_count =
            u32::try_from(fingerprint.count()).is_ok() && count("triangles")? == fingerprint.count();
        is_count.then_some(Self {
            node: Node::new(u32::try_from(count("node")?).ok()?)?,
            vertices: count("vertices")?,
            duplicates: count("duplicates")?,
            fingerprint,
            border: count("border")?,
            sums: Sums::parse(&value["files"])?,
        })
    }

    /// Whether a tile has so many points, as its bucket had.
    pub(crate) fn check_points(&self, folder: &Path, count: u64) -> Result<(), Error> {
        if self.vertices.checked_add(self.duplicates) == Some(count) {
            return Ok(());
        }
        let what = format!(
            "{} vertices and {} duplicates are not the {count} points of tiles.json",
            self.vertices, self.duplicates
        );
        Err(damaged(&path(folder, self.node), what))
    }

    /// Whether its files are as they were written, and all that it must have are among them.
    pub(crate) fn check_files(&self, folder: &Path, cuts: &Cuts) -> Result<(), Error> {
        let kinds: &[&str] =
            if cuts.is_tile(self.node) { &["points", "ids", "triangles"] } else { &["seam"] };
        let files = kinds.iter().map(|kind| place(folder, kind, self.node, "npy"));
        if let Some(path) = files.into_iter().find(|path| !self.sums.has(path)) {
            return Err(Error::changed(&path, "tiles.json has no hash of it"));
        }
        self.sums.check(folder)
    }

    /// Writes it with its border: the node is done then. Its files are on the disk before, and this one after.
    pub(crate) fn write(&self, folder: &Path, border: &Border) -> Result<(), Error> {
        let sync = || sync_folder(folder).map_err(|error| Error::write(folder, error));
        sync()?;
        let bytes = border.to_bytes();
        let mut head = self.describe();
        head[SUM] = json!(format!("{:016x}", XxHash3_64::oneshot(&bytes)));
        own::write(&path(folder, self.node), |out| {
            writeln!(out, "{head}")?;
            Ok(out.write_all(&bytes)?)
        })?;
        sync()
    }

    /// Reads the description of a node, if it is done.
    pub(crate) fn find(folder: &Path, node: Node) -> Result<Option<Self>, Error> {
        let path = path(folder, node);
        let file = match own::open(&path) {
            Ok(file) => file,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(Error::read(&path, error)),
        };
        let failed = |error: std::io::Error| Error::read(&path, error);
        let length = file.metadata().map_err(failed)?.len();
        let (done, _) = Self::head(&path, &mut BufReader::new(file))?;
        if done.node != node {
            return Err(damaged(&path, format_args!("it is of node {}", done.node.number())));
        }
        // More would be taken for memory that joins need.
        if done.border > length / Self::LEAST {
            return Err(damaged(&path, format_args!("{length} bytes are no {} points", done.border)));
        }
        Ok(Some(done))
    }

    /// It, and the hash of its border.
    fn head(path: &Path, source: &mut impl BufRead) -> Result<(Self, u64), Error> {
        let mut line = Vec::new();
        let read = source.take(1 << 12).read_until(b'\n', &mut line);
        read.map_err(|error| Error::read(path, error))?;
        let value = serde_json::from_slice(&line).unwrap_or(Value::Null);
        let sum = value[SUM].as_str().and_then(|sum| u64::from_str_radix(sum, 16).ok());
        let head = Self::parse(&value).zip(sum);
        head.ok_or_else(|| damaged(path, "it does not begin with what a node has"))
    }
}

/// The border of a node that is done.
pub(crate) fn border(folder: &Path, node: Node) -> Result<Border, Error> {
    let path = path(folder, node);
    let failed = |error: std::io::Error| Error::read(&path, error);
    let mut source = BufReader::new(own::open(&path).map_err(failed)?);
    let (_, sum) = Done::head(&path, &mut source)?;
    let mut bytes = Vec::new();
    source.read_to_end(&mut bytes).map_err(failed)?;
    if XxHash3_64::oneshot(&bytes) != sum {
        return Err(damaged(&path, "the border is not what was written"));
    }
    Border::from_bytes(&bytes).map_err(|problem| damaged(&path, problem))
}

/// Removes all borders of a folder: nothing is done.
pub(crate) fn remove_all(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        if entry.file_name().to_string_lossy().starts_with("border-") {
            _ = fs::remove_file(entry.path());
        }
    }
}

/// Forgets the border of a node: all is done.
pub(crate) fn forget(folder: &Path, node: Node) {
    _ = fs::remove_file(path(folder, node));
}
