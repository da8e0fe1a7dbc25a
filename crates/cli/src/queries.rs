//! Queries: the common part of `locate`, `nearest` and `furthest`: many points, and a row of indices as the answer to each.

use std::path::Path;

use delone::Work;
use delone_io::{Answers, Cloud, Contents, Format, Found, write_answers};

use crate::args::{InputArgs, QueryArgs};
use crate::files;
use crate::message::Failure;
use crate::progress::Phase;
use crate::room::{self, Room};
use crate::stats::{Stats, work_done};

/// Asks the same question for every query and writes a row of indices for each, filled up by -1.
pub(crate) fn answer<R: Room>(
    input: &InputArgs,
    query: &QueryArgs,
    names: &[String],
    quiet: bool,
    ask: impl Fn(&R, R::Point, &mut Work) -> Result<Vec<usize>, delone::Error>,
) -> Result<(), Failure> {
    let strategy = room::strategy::<R>(&query.strategy, "queries")?;
    let format = answer_format(&query.output, query.to)?;
    let columns = names.len();
    files::keep_apart(
        &input.paths_and(&query.queries),
        std::iter::once(query.output.as_path()).chain(input.stats.as_deref()),
    )?;
    let mut stats = Stats::start();
    let (own, dimensions) = files::attributes_apart(input, &query.queries);
    let (points, _) = room::read::<R>(&own, quiet)?;
    let (queries, about) = room::queries_with::<R>(&query.queries, dimensions, quiet)?;
    stats.phase("read");
    let mut d: R = room::build(&points, R::FASTEST, &input.label(), quiet)?;
    drop(points);
    d.set_strategy(strategy).map_err(|error| query.strategy.refused(&error))?;
    stats.phase("build");
    room::remark(&d, quiet);
    let mut rows = Vec::with_capacity(columns * queries.len());
    let mut work = Work::default();
    {
        let _phase = Phase::start(quiet, "locating");
        for (index, &q) in queries.iter().enumerate() {
            let found = ask(&d, q, &mut work).map_err(|error| {
                Failure::new(
                    format!("{}: query {index}: {error}", query.queries.display()),
                    "remove that query or repair its coordinates: every finite number is accepted",
                )
            })?;
            rows.extend(found.into_iter().map(|i| i as i64));
            rows.resize(columns * (index + 1), -1);
        }
    }
    stats.phase("query");
    stats.triangulation(&d, d.counters());
    stats.set("queries", queries.len());
    stats.set("counters", work_done(&work));
    if format == Format::Npy {
        files::write(&query.output, |out| delone_io::write_indices(out, format, columns, &rows))?;
    } else {
        write(&query.output, format, &queries, &about, (names, Found::Indices(&rows)))?;
    }
    stats.phase("write");
    stats.tell(quiet, R::WORDS.simplex);
    stats.write(input.stats.as_deref())
}

/// The format of a file of answers: arrays have the answers alone, other formats the queries with their attributes too.
pub(crate) fn answer_format(path: &Path, said: Option<Format>) -> Result<Format, Failure> {
    let format = files::format(path, said, "--to")?;
    let output = [(path.to_owned(), format)];
    if format != Format::Npy {
        files::check_formats(&output, &[Contents::Answers])?;
    }
    files::expect(&output);
    files::keep_attributes(Contents::Answers);
    Ok(format)
}

/// Writes answers with the queries and their attributes.
pub(crate) fn write<P: AsRef<[f64]>>(
    path: &Path,
    format: Format,
    queries: &[P],
    about: &Cloud,
    (names, found): (&[String], Found),
) -> Result<(), Failure> {
    let (features, crs) = (&about.features, about.crs.as_ref());
    let answers = Answers { queries, features, crs, names, found };
    files::write(path, |out| write_answers(out, format, &answers))
}
