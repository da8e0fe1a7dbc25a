//! A database that others made, opened so that it can do no harm: it is read alone, its views end, and nothing of it is trusted.
//!
//! Source: <https://www.sqlite.org/security.html>, "Untrusted SQLite Database Files".

use std::io::{self, Read, SeekFrom};

use rusqlite::config::DbConfig;
use rusqlite::limits::Limit;
use rusqlite::{Connection, ErrorCode, MAIN_DB, OpenFlags};
use tempfile::NamedTempFile;

use crate::input::{Bounded, most_inflated};
use crate::{Error, Source};

/// A database of so many bytes is taken into memory; SQLite has no room for two GiB.
pub(super) const MOST_IN_MEMORY: u64 = 1 << 30;

/// A database, and how much may be read from it.
pub(super) struct Database {
    pub(super) connection: Connection,
    /// Bytes of values that may come: more than the file has come from views, and from pages that are in two places.
    pub(super) most: u64,
    /// A copy on the disk, which goes with this.
    _copy: Option<NamedTempFile>,
}

impl Database {
    /// Opens a database, in memory if it has at most so many bytes.
    pub(super) fn open(mut source: Box<dyn Source>, most_in_memory: u64) -> Result<Self, Error> {
        let length = source.seek(SeekFrom::End(0))?;
        source.rewind()?;
        if length == 0 {
            return Err(Error::content("GeoPackage: the file is empty"));
        }
        let (bytes, head) = without_journal(source)?;
        let whole = io::Cursor::new(head).chain(Bounded::to(length, bytes));
        let mut connection;
        let mut copy = None;
        if length <= most_in_memory {
            connection = Connection::open_in_memory().map_err(failed)?;
            connection.deserialize_read_exact(MAIN_DB, whole, length as usize, true).map_err(failed)?;
        } else {
            let mut file = NamedTempFile::new()?;
            io::copy(&mut { whole }, &mut file)?;
            connection =
                Connection::open_with_flags(file.path(), OpenFlags::SQLITE_OPEN_READ_ONLY).map_err(failed)?;
            copy = Some(file);
        }
        restrict(&mut connection, length).map_err(failed)?;
        Ok(Self { connection, most: most_inflated(length), _copy: copy })
    }
}

/// The first bytes, and what follows. A database whose header names a write-ahead log is opened only beside that, which is no part of the
/// file; what is in the file is whole without it.
fn without_journal(mut source: Box<dyn Source>) -> io::Result<(Box<dyn Source>, Vec<u8>)> {
    /// The versions of the format that are needed to write and to read: 2 with a log, 1 without.
    const VERSIONS: std::ops::Range<usize> = 18..20;
    let mut head = Vec::new();
    (&mut source).take(VERSIONS.end as u64).read_to_end(&mut head)?;
    if head.get(VERSIONS) == Some(&[2, 2]) {
        head[VERSIONS].fill(1);
    }
    Ok((source, head))
}

/// Lets a database do no more than give its tables and views.
fn restrict(connection: &mut Connection, length: u64) -> rusqlite::Result<()> {
    /// Steps of the machine that a database of no bytes may take, and for each byte more. A row takes a few for each of its values, and
    /// a view some for each row that it looks at.
    const STEPS: u64 = 20_000_000;
    const STEPS_A_BYTE: u64 = 100;
    const STEPS_AT_ONCE: u32 = 1000;
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_DEFENSIVE, true)?;
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_TRUSTED_SCHEMA, false)?;
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_ENABLE_TRIGGER, false)?;
    // A name in quotes that no column has is no text.
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_DQS_DML, false)?;
    let longest = i32::try_from(length.max(1 << 20)).unwrap_or(i32::MAX);
    for (limit, most) in [
        (Limit::SQLITE_LIMIT_LENGTH, longest),
        (Limit::SQLITE_LIMIT_SQL_LENGTH, 1_000_000),
        (Limit::SQLITE_LIMIT_EXPR_DEPTH, 100),
        (Limit::SQLITE_LIMIT_COMPOUND_SELECT, 50),
        (Limit::SQLITE_LIMIT_VDBE_OP, 100_000),
        (Limit::SQLITE_LIMIT_ATTACHED, 0),
        (Limit::SQLITE_LIMIT_TRIGGER_DEPTH, 1),
    ] {
        connection.set_limit(limit, most)?;
    }
    connection.pragma_update(None, "cell_size_check", true)?;
    connection.pragma_update(None, "mmap_size", 0)?;
    let mut left = STEPS.saturating_add(STEPS_A_BYTE.saturating_mul(length)) / u64::from(STEPS_AT_ONCE);
    let ends = move || {
        left = left.saturating_sub(1);
        left == 0
    };
    connection.progress_handler(STEPS_AT_ONCE as i32, Some(ends))
}

/// An error of SQLite as one of ours.
pub(super) fn failed(error: rusqlite::Error) -> Error {
    let what = match error.sqlite_error_code() {
        Some(ErrorCode::DiskFull) => return std::io::Error::from(std::io::ErrorKind::StorageFull).into(),
        Some(ErrorCode::SystemIoFailure | ErrorCode::CannotOpen | ErrorCode::ReadOnly) => {
            return std::io::Error::other(format!("SQLite: {error}")).into();
        }
        Some(ErrorCode::NotADatabase) => "it is no database of SQLite".to_owned(),
        Some(ErrorCode::OperationInterrupted) => "one of its views has no end".to_owned(),
        Some(ErrorCode::DatabaseCorrupt) => "its pages contradict themselves".to_owned(),
        _ => error.to_string(),
    };
    Error::content(format!("GeoPackage: {what}"))
}
