//! `delone-lab replay`: a text file of operations, as it comes with a report of a bug.

use std::fmt::Write;
use std::path::Path;

use delone::{Coordinates, Error, Found, Inserted, VertexId, Work};
use delone_cli::files;
use delone_cli::message::{Failure, answer, tell};
use delone_cli::progress::Phase;
use delone_cli::room::{self, Room, positive};
use delone_cli::stats::{Stats, work_done};
use delone_io::{Mesh, picture, write_mesh};

use crate::args::ReplayArgs;

/// Up to this number of vertices every operation is checked; beyond it, one in as many.
const CHECKED: usize = 1000;
/// Advice about a triangulation that is wrong.
const BUG: &str = "please report this with the input: it is a bug";

/// One line.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Operation<P> {
    Insert(P),
    Remove(VertexId),
    Move(VertexId, P),
    Locate(P),
    Nearest(P),
}

pub(crate) fn run<R: Room>(args: &ReplayArgs, quiet: bool) -> Result<(), Failure> {
    let strategy = room::strategy::<R>(&args.strategy, "changes")?;
    let outputs = files::outputs(&args.output, args.to, args.stats.as_deref(), &[&args.operations])?;
    room::check_formats::<R>(&outputs)?;
    let mut stats = Stats::start();
    let mut d = R::default();
    d.set_strategy(strategy).map_err(|error| args.strategy.refused(&error))?;
    let replayed = replay(args, &mut d, &mut stats, quiet)?;
    if outputs.iter().any(|(path, _)| path == Path::new("-")) {
        // The file alone.
        tell(replayed.answers.trim_end());
    } else {
        answer(&replayed.answers)?;
    }
    stats.triangulation(&d, d.counters());
    stats.set("counters", work_done(&replayed.work));
    let mesh = Mesh::new(&d, &replayed.points);
    for (path, format) in &outputs {
        let options = picture::Options::default();
        files::write(path, |out| write_mesh(out, *format, &mesh, &options))?;
    }
    stats.phase("write");
    stats.write(args.stats.as_deref())
}

/// Reads and performs all operations.
fn replay<R: Room>(
    args: &ReplayArgs,
    d: &mut R,
    stats: &mut Stats,
    quiet: bool,
) -> Result<Replayed<R::Point>, Failure> {
    let text = files::text(&args.operations, quiet)?;
    stats.phase("read");
    let wrong = |number: usize, what: String, help: &str| {
        Failure::new(format!("{}: line {number}: {what}", args.operations.display()), help)
    };
    let mut replayed = Replayed::default();
    let check = |d: &R| d.check().map_err(|flaw| format!("the triangulation is wrong: {flaw}"));
    {
        let _phase = Phase::start(quiet, "replaying");
        for (number, line) in (1..).zip(text.lines()) {
            let operation =
                parse(line).map_err(|what| wrong(number, what, "see delone-lab replay --help"))?;
            let Some(operation) = operation else { continue };
            replayed
                .perform(d, operation)
                .map_err(|error| wrong(number, error.to_string(), "see delone-lab replay --help"))?;
            let count = d.vertex_count();
            if args.check && (count <= CHECKED || replayed.operations.is_multiple_of(CHECKED)) {
                check(d).map_err(|what| wrong(number, what, BUG))?;
            }
        }
        if args.check {
            check(d).map_err(|what| Failure::new(what, BUG))?;
        }
    }
    stats.phase("build");
    stats.set("operations", replayed.operations);
    Ok(replayed)
}

/// An operation, or nothing on a line without one.
fn parse<P: Coordinates>(line: &str) -> Result<Option<Operation<P>>, String> {
    let content = line.split('#').next().unwrap_or_default();
    let words: Vec<&str> = content.split_whitespace().collect();
    let number = |word: &str| word.parse::<f64>().map_err(|_| format!("{word:?} is no number"));
    let vertex = |word: &str| {
        let id = word.parse::<usize>().ok().filter(|&id| id < delone::MAX_POINTS);
        id.map(VertexId::new).ok_or_else(|| format!("{word:?} is no id"))
    };
    let Some((&sign, values)) = words.split_first() else { return Ok(None) };
    if !["+", "-", ">", "?", "@"].contains(&sign) {
        return Err(format!("{sign:?} is no operation"));
    }
    let with_id = sign == "-" || sign == ">";
    let takes = usize::from(with_id) + if sign == "-" { 0 } else { P::COUNT };
    if values.len() != takes {
        let word = if takes == 1 { "value" } else { "values" };
        return Err(format!("{sign} takes {takes} {word}, not {}", values.len()));
    }
    let mut point = P::default();
    for (x, word) in point.as_mut().iter_mut().zip(&values[usize::from(with_id)..]) {
        *x = number(word)?;
    }
    Ok(Some(match sign {
        "+" => Operation::Insert(point),
        "-" => Operation::Remove(vertex(values[0])?),
        ">" => Operation::Move(vertex(values[0])?, point),
        "?" => Operation::Locate(point),
        _ => Operation::Nearest(point),
    }))
}

/// The outcome of a replay.
struct Replayed<P> {
    answers: String,
    work: Work,
    operations: usize,
    /// By id, where each vertex is or was.
    points: Vec<P>,
}

impl<P> Default for Replayed<P> {
    fn default() -> Self {
        Self { answers: String::new(), work: Work::default(), operations: 0, points: Vec::new() }
    }
}

impl<P: Coordinates> Replayed<P> {
    fn perform<R: Room<Point = P>>(&mut self, d: &mut R, operation: Operation<P>) -> Result<(), Error> {
        self.operations += 1;
        match operation {
            Operation::Insert(p) => {
                let sign = match d.insert_observed(p, &mut self.work)? {
                    Inserted::New(v) => {
                        self.points.push(p);
                        ('+', v)
                    }
                    Inserted::Existing(v) => ('=', v),
                };
                self.say(format_args!("{} {}", sign.0, sign.1.index()));
            }
            Operation::Remove(v) => d.remove_observed(v, &mut self.work)?,
            Operation::Move(v, p) => {
                d.move_to(v, p)?;
                self.points[v.index()] = p;
            }
            Operation::Locate(q) => {
                let words = describe::<R>(&d.find_observed(q, &mut self.work)?);
                self.say(format_args!("? {words}"));
            }
            Operation::Nearest(q) => match d.nearest_observed(q, &mut self.work)? {
                Some(v) => self.say(format_args!("@ {}", v.index())),
                None => self.say(format_args!("@ none")),
            },
        }
        Ok(())
    }

    fn say(&mut self, line: std::fmt::Arguments) {
        _ = writeln!(self.answers, "{line}");
    }
}

/// Where a point falls, in words.
fn describe<R: Room>(found: &Found<R::Simplex>) -> String {
    let face = found.face();
    let kind = match face.len() {
        0 => return "nowhere".to_owned(),
        _ if found.is_outside => "outside",
        count if count > R::Point::COUNT => R::WORDS.simplex[0],
        1 => "vertex",
        2 => "edge",
        _ => "facet",
    };
    let mut corners = positive(face);
    if ["edge", "facet"].contains(&kind) {
        // The same from both sides.
        corners.sort_unstable();
    }
    corners.iter().fold(kind.to_owned(), |words, corner| format!("{words} {corner}"))
}

#[cfg(test)]
mod tests {
    use super::{Operation, parse};
    use delone::VertexId;

    #[test]
    fn lines_are_read() {
        let parse = parse::<[f64; 2]>;
        assert_eq!(parse("+ 1 -2.5e-3"), Ok(Some(Operation::Insert([1.0, -2.5e-3]))));
        assert_eq!(parse("  - 7 # gone"), Ok(Some(Operation::Remove(VertexId::new(7)))));
        assert_eq!(parse("> 0 1 2"), Ok(Some(Operation::Move(VertexId::new(0), [1.0, 2.0]))));
        assert_eq!(parse("# nothing"), Ok(None));
        for wrong in ["+ 1", "+ 1 2 3", "* 1 2", "- -1", "- 1.5", "? a b", "- 99999999999"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
        assert_eq!(super::parse("@ 1 2 3"), Ok(Some(Operation::Nearest([1.0, 2.0, 3.0]))));
        assert!(super::parse::<[f64; 3]>("@ 1 2").is_err());
    }
}
