//! Errors of the library as failures of a command, and failures of the program that pass through the library.

use delone_store::{Difference, Error};

use crate::files;
use crate::message::Failure;

/// The failure of work on a folder of tiles.
pub(crate) fn failure(error: Error) -> Failure {
    match error {
        Error::Outside(outside) => match outside.downcast::<Failure>() {
            Ok(own) => *own,
            Err(other) => Failure::new(other, "go on with --resume"),
        },
        Error::Points { path, error } => Failure::points(&path, &error),
        Error::Read { path, error } => Failure::file(&path, &error),
        Error::Write { path, error } => files::cannot_write(&path, error),
        Error::LittleMemory { .. } => Failure::usage(format!("--memory {error}"), error.help()),
        Error::EmptyTiles => Failure::usage(format!("--tile 0: {error}"), error.help()),
        Error::LargeTile { .. } | Error::LargeJoin { .. } => {
            Failure::new(error.to_string().replace("memory allows", "--memory allows"), error.help())
        }
        Error::OtherInput { difference: Difference::Options, ref folder } => {
            let what = "--from, --class, --columns or --heights are others than the run in";
            Failure::usage(format!("{what} {}", folder.display()), error.help())
        }
        _ if error.is_usage() => Failure::usage(&error, error.help()),
        _ => Failure::new(&error, error.help()),
    }
}

/// A failure as an error that passes through the library.
pub(super) fn outside(failure: Failure) -> Error {
    Error::Outside(Box::new(failure))
}
