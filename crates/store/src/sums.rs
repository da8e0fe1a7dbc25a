//! Hashes of what files of a folder have in them, taken while they are written, so that a change of any byte is noticed: also of what no
//! proof can know, as indices, heights and neighbors.
//!
//! Source: XXH3 of 64 bits (Collet), which `xxhsum -H3` prints too. It is for accidents, not against somebody who wants to deceive.
//!
//! Cost: some ten gigabytes a second.

use std::collections::BTreeMap;
use std::fs;
use std::hash::Hasher;
use std::io::{self, Read, Write};
use std::path::Path;

use delone::tiles::Node;
use delone_io::Output;
use serde_json::{Map, Value};
use twox_hash::XxHash3_64;

use crate::error::Error;
use crate::own;

/// The hashes of files by their names.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Sums(BTreeMap<String, u64>);

/// The hashes of what was written for each node.
pub(crate) type Written = BTreeMap<Node, Sums>;

/// A file that is being written, and the hash of it so far.
pub(crate) struct Summed<'a> {
    out: &'a mut Output,
    hasher: XxHash3_64,
}

impl Write for Summed<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes)?;
        self.hasher.write(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

impl Sums {
    /// Writes a file whole, and keeps its hash.
    pub(crate) fn write(
        &mut self,
        path: &Path,
        content: impl FnOnce(&mut Summed) -> Result<(), delone_io::Error>,
    ) -> Result<(), Error> {
        let sum = own::write(path, |out| {
            let mut summed = Summed { out, hasher: XxHash3_64::new() };
            content(&mut summed)?;
            Ok(summed.hasher.finish())
        })?;
        self.0.insert(name(path), sum);
        Ok(())
    }

    /// As the manifest has them.
    pub(crate) fn describe(&self) -> Value {
        let text = |(name, sum): (&String, &u64)| (name.clone(), Value::from(format!("{sum:016x}")));
        Value::Object(self.0.iter().map(text).collect::<Map<_, _>>())
    }

    pub(crate) fn parse(value: &Value) -> Option<Self> {
        let sum = |(name, sum): (&String, &Value)| {
            // Nothing that leads out of the folder.
            let is_name = name.starts_with(|c: char| c.is_ascii_lowercase())
                && name.bytes().all(|b| b.is_ascii_alphanumeric() || b"-.".contains(&b));
            let sum = u64::from_str_radix(sum.as_str()?, 16).ok()?;
            is_name.then(|| (name.clone(), sum))
        };
        Some(Self(value.as_object()?.iter().map(sum).collect::<Option<_>>()?))
    }

    /// Takes in what was written later.
    pub(crate) fn extend(&mut self, more: Self) {
        self.0.extend(more.0);
    }

    /// Whether a file is among them.
    pub(crate) fn has(&self, path: &Path) -> bool {
        self.0.contains_key(&name(path))
    }

    /// Whether all of them are as they were written.
    pub(crate) fn check(&self, folder: &Path) -> Result<(), Error> {
        self.0.iter().try_for_each(|(name, &sum)| check(&folder.join(name), sum))
    }

    /// Whether one of them is as it was written.
    pub(crate) fn check_file(&self, path: &Path) -> Result<(), Error> {
        let sum =
            self.0.get(&name(path)).ok_or_else(|| Error::changed(path, "tiles.json has no hash of it"))?;
        check(path, *sum)
    }
}

fn check(path: &Path, expected: u64) -> Result<(), Error> {
    let found = of_file(path).map_err(|error| Error::changed(path, error))?;
    if found == expected {
        return Ok(());
    }
    let what =
        format!("it is not what was written: its hash is {found:016x}, and {expected:016x} was written");
    Err(Error::changed(path, what))
}

fn of_file(path: &Path) -> io::Result<u64> {
    let (mut file, mut hasher) = (own::open(path)?, XxHash3_64::new());
    let mut bytes = vec![0; 1 << 18];
    loop {
        match file.read(&mut bytes) {
            Ok(0) => return Ok(hasher.finish()),
            Ok(count) => hasher.write(&bytes[..count]),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

/// Whether all files of a folder that are named as shards are known: a run that was stopped while it wrote neighbors or tables leaves
/// some that nobody vouches for.
pub(crate) fn check_known(folder: &Path, known: &[&Sums]) -> Result<(), Error> {
    const KINDS: [&str; 6] = ["points-", "ids-", "triangles-", "seam-", "neighbors-", "across-"];
    let entries = fs::read_dir(folder).map_err(|error| Error::changed(folder, error))?;
    let mut names: Vec<String> =
        entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort_unstable();
    let is_shard = |name: &str| {
        let extension = Path::new(name).extension();
        KINDS.iter().any(|kind| name.starts_with(kind))
            && extension.is_some_and(|extension| extension == "npy" || extension == "parquet")
    };
    let is_known = |name: &str| known.iter().any(|sums| sums.0.contains_key(name));
    match names.into_iter().find(|name| is_shard(name) && !is_known(name)) {
        Some(name) => Err(Error::Unknown { path: folder.join(&name) }),
        None => Ok(()),
    }
}
