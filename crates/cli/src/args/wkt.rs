//! How well-known text holds several geometries.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use delone_io::Format;

use crate::message::Failure;

/// How well-known text is written.
#[derive(Clone, Debug, Default, Args)]
pub struct WktArgs {
    /// The form of outputs of well-known text [default: lines].
    #[arg(long, value_name = "FORM")]
    wkt: Option<WktForm>,
}

/// The form of a file of well-known text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum WktForm {
    /// One geometry a line.
    Lines,
    /// One GEOMETRYCOLLECTION with all of them.
    Collection,
}

impl WktArgs {
    /// Outputs in the form that is asked for.
    ///
    /// # Errors
    /// A form without an output of well-known text.
    pub fn of(&self, mut outputs: Vec<(PathBuf, Format)>) -> Result<Vec<(PathBuf, Format)>, Failure> {
        let Some(form) = self.wkt else { return Ok(outputs) };
        let mut is_written = false;
        for (_, format) in outputs.iter_mut().filter(|(_, format)| *format == Format::Wkt) {
            is_written = true;
            if form == WktForm::Collection {
                *format = Format::WktCollection;
            }
        }
        if is_written {
            return Ok(outputs);
        }
        Err(Failure::usage(
            "--wkt is for outputs of well-known text",
            "leave --wkt out, or name such an output, as in -o out.wkt",
        ))
    }
}
