//! Messages of the program: one line on the fault, then advice.

use std::fmt::Display;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use clap::error::{ContextKind, ContextValue, ErrorKind};

use delone_io::Format;

use crate::closed;

/// Commands that `delone-lab` has.
const OF_THE_LAB: [&str; 4] = ["animate", "experiment", "reduce", "replay"];

/// Names in other programs of commands and options of this one.
const ELSEWHERE: [(&str, &str); 13] = [
    ("-3", "--dim 3"),
    ("--3d", "--dim 3"),
    ("--3D", "--dim 3"),
    ("--crs", "--epsg"),
    ("--srs", "--epsg"),
    ("--resolution", "--cell"),
    ("convex-hull", "hull"),
    ("delaunay", "triangulate"),
    ("dem", "dtm"),
    ("hillshade", "relief"),
    ("slope", "relief"),
    ("thiessen", "voronoi"),
    ("tin", "triangulate"),
];

/// Why a command did not do its work.
#[derive(Debug)]
pub struct Failure {
    message: String,
    help: String,
    /// 1 for bad data or failed work, 2 for wrong usage.
    status: u8,
}

impl Failure {
    /// Bad data, or work that failed.
    pub fn new(message: impl Display, help: impl Display) -> Self {
        Self { message: message.to_string(), help: help.to_string(), status: 1 }
    }

    /// Wrong usage.
    pub fn usage(message: impl Display, help: impl Display) -> Self {
        Self { status: 2, ..Self::new(message, help) }
    }

    /// Something that a feature of the crate has, which is off in this program.
    #[cfg(not(feature = "parquet"))]
    pub(crate) fn left_out(what: &str, feature: &str) -> Self {
        Self::usage(
            format!("{what} is not in this program, which was built without {feature}"),
            format!("cargo install delone-cli --features {feature}"),
        )
    }

    /// Something wrong with a file.
    pub fn file(path: &Path, error: &delone_io::Error) -> Self {
        use delone_io::Error;
        let message = match error {
            Error::UnknownExtension(_) => error.to_string(),
            _ => format!("{}: {error}", path.display()),
        };
        let usage = matches!(error, Error::UnknownExtension(_) | Error::Unsupported { .. });
        Self { message, help: error.help().into_owned(), status: if usage { 2 } else { 1 } }
    }

    /// Something wrong with what is in a file of this format that begins so.
    pub(crate) fn content(path: &Path, format: Format, error: &delone_io::Error, beginning: &[u8]) -> Self {
        let help = format.help(error, beginning);
        Self { help: help.into_owned(), ..Self::file(path, error) }
    }

    /// Something wrong with points.
    pub fn points(path: &Path, error: &delone::Error) -> Self {
        let help = match error {
            delone::Error::NotFinite { .. } => {
                "remove that point or repair its coordinates: every finite number is accepted"
            }
            delone::Error::Height { .. } => "remove that point or repair its height",
            delone::Error::NoCell { .. } => "clip to what contains all points, and give each point once",
            delone::Error::Parameter { .. } => "give a number in that range",
            delone::Error::Area { .. } => "give a positive number for each point, or leave the point out",
            delone::Error::Length { .. } => "give as many centers as points, row by row",
            _ => "split the points into smaller sets",
        };
        Self::new(format!("{}: {error}", path.display()), help)
    }

    /// Something wrong with points and segments.
    pub fn graph(path: &Path, error: &delone::Error) -> Self {
        let help = match error {
            delone::Error::SegmentsCross { .. } => {
                "repair the data, or split segments with --crossings split, which triangulate and mesh have"
            }
            delone::Error::NoSuchPoint { .. } => "segments name points by index, from 0",
            delone::Error::Coordinate { .. } => "seeds of holes and regions are finite points",
            delone::Error::Seed { .. } => "move the seed into the hole or region, or choose another --fill",
            delone::Error::Arc { .. } => "of two arcs with the same ends, divide one with a further vertex",
            delone::Error::KeptTriangle { .. } => {
                "leave out segments that cross triangles, or make the triangles anew with --rebuild"
            }
            _ => return Self::points(path, error),
        };
        Self::new(format!("{}: {error}", path.display()), help)
    }

    /// Prints the failure and gives the exit status.
    pub fn report(&self) -> ExitCode {
        tell(format_args!("error: {}\nhelp: {}", one_line(&self.message), one_line(&self.help)));
        ExitCode::from(self.status)
    }
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Failure {}

/// A line on standard error, if somebody reads it.
pub fn tell(text: impl Display) {
    _ = writeln!(std::io::stderr(), "{text}");
}

/// A message in one line, which may hold what a file holds: without what moves the cursor, and not longer than a
/// screen.
fn one_line(text: &str) -> String {
    const LONGEST: usize = 600;
    let text = text.replace(|c: char| c.is_control() && !c.is_whitespace(), "\u{fffd}");
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{} ...", &line[..end]),
        None => line,
    }
}

/// Prints help and version where they were asked for, and a usage error of a program in one line otherwise.
pub fn usage(error: &clap::Error, program: &str, command: &clap::Command) -> ExitCode {
    if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) {
        return match closed::check().and_then(|()| error.print()) {
            Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => unanswered(&error).report(),
            _ => ExitCode::SUCCESS,
        };
    }
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        _ = error.print();
        return ExitCode::from(2);
    }
    let rendered = error.render().to_string();
    let message = rendered.split("\n\n").next().unwrap_or_default().trim_start_matches("error: ");
    // Words of Rust's own parsers.
    let message = message
        .replace("invalid float literal", "not a number")
        .replace("invalid digit found in string", "not a whole number");
    let named = |kind: ContextKind| match error.get(kind) {
        Some(ContextValue::String(name)) => Some(name.as_str()),
        Some(ContextValue::Strings(names)) => names.first().map(String::as_str),
        _ => None,
    };
    let unknown = named(ContextKind::InvalidSubcommand).or_else(|| named(ContextKind::InvalidArg));
    let is_here = |name: &&str| name.starts_with('-') || command.find_subcommand(name).is_some();
    let known = ELSEWHERE.iter().find(|entry| Some(entry.0) == unknown).map(|entry| entry.1).filter(is_here);
    let suggestion =
        [ContextKind::SuggestedArg, ContextKind::SuggestedValue, ContextKind::SuggestedSubcommand]
            .into_iter()
            .find_map(named);
    let mut words = std::env::args_os().skip(1).filter_map(|word| word.into_string().ok());
    let called = words.find(|word| command.find_subcommand(word).is_some());
    let see = match called {
        Some(name) => format!("see {program} {name} --help"),
        None => format!("see {program} --help, or {program} COMMAND --help"),
    };
    let help = match (unknown, known.or(suggestion)) {
        (Some(name), _) if OF_THE_LAB.contains(&name) => {
            format!("{name} is a command of delone-lab: cargo install --locked --path crates/lab")
        }
        (_, Some(name)) => format!("did you mean {name}? {see}"),
        (Some(name), None) if name.starts_with("--output") => format!("name the output with -o FILE; {see}"),
        (_, None) => see,
    };
    Failure::usage(message, help).report()
}

/// Tells on standard error what was done.
pub(crate) fn say(quiet: bool, text: impl Display) {
    if !quiet {
        tell(text);
    }
}

/// A remark on standard error.
pub fn note(quiet: bool, text: impl Display) {
    if !quiet {
        tell(format_args!("note: {text}"));
    }
}

/// The first thing that an input has and no output of the command.
static LOST: Mutex<Option<String>> = Mutex::new(None);
/// Whether that is an error.
static IS_STRICT: AtomicBool = AtomicBool::new(false);

/// Whatever an input has and an output has not is an error from now on.
pub(crate) fn be_strict(is_strict: bool) {
    IS_STRICT.store(is_strict, Ordering::Relaxed);
}

/// Whether whatever is not as it was asked for is an error.
pub(crate) fn is_strict() -> bool {
    IS_STRICT.load(Ordering::Relaxed)
}

/// Something that an input has and an output has not.
pub(crate) fn lost(quiet: bool, text: impl Display) {
    remember_loss(&text);
    note(quiet, text);
}

/// The same, where readers will take the output for something else.
pub(crate) fn mislead(quiet: bool, text: impl Display) {
    remember_loss(&text);
    warn(quiet, text);
}

fn remember_loss(text: &impl Display) {
    LOST.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert_with(|| text.to_string());
}

/// Refuses to go on where something was lost and none may be.
pub(crate) fn refuse_losses() -> Result<(), Failure> {
    let lost = LOST.lock().unwrap_or_else(PoisonError::into_inner);
    match lost.as_ref().filter(|_| is_strict()) {
        Some(what) => Err(Failure::new(what, "choose a format that has room for it, or leave --strict out")),
        None => Ok(()),
    }
}

/// Warns on standard error.
pub(crate) fn warn(quiet: bool, text: impl Display) {
    if !quiet {
        tell(format_args!("warning: {text}"));
    }
}

fn unanswered(error: &std::io::Error) -> Failure {
    Failure::new(format!("cannot write the answer: {error}"), "check where standard output goes")
}

/// Prints a command's answer on standard output. A reader that has seen enough (`| head`) is no failure.
pub fn answer(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match closed::check().and_then(|()| out.write_all(text.as_bytes())).and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(unanswered(&error)),
        _ => Ok(()),
    }
}

/// A number in groups of three digits.
pub(crate) fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let groups: Vec<&str> =
        digits.as_bytes().rchunks(3).rev().filter_map(|group| str::from_utf8(group).ok()).collect();
    groups.join(",")
}
