//! `delone replay`: a text file of operations, as it comes with a report of a bug.

use std::fmt::Write;

use delone::{Delaunay2, Inserted, Location, VertexId, Work};
use delone_io::Surface;

use crate::args::ReplayArgs;
use crate::files;
use crate::message::{Failure, answer};
use crate::progress::Phase;
use crate::stats::{Stats, work_done};

/// Up to this number of vertices every operation is checked; beyond it, one in as many.
const CHECKED: usize = 1000;

/// One line.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Operation {
    Insert([f64; 2]),
    Remove(VertexId),
    Move(VertexId, [f64; 2]),
    Locate([f64; 2]),
    Nearest([f64; 2]),
}

pub(crate) fn run(args: &ReplayArgs, quiet: bool) -> Result<(), Failure> {
    let strategy = args.locate.strategy(args.seed).ok_or_else(|| {
        Failure::usage(
            "that strategy is for building in bulk, not for changes",
            "choose --locate tree, walk, jump-and-walk, hierarchy or history",
        )
    })?;
    let outputs = files::outputs(&args.output, args.to, args.stats.as_deref(), &[&args.operations])?;
    if let Some((path, format)) = outputs.iter().find(|(_, format)| !format.holds_meshes()) {
        return Err(Failure::file(path, &delone_io::Error::NotAMesh(*format)));
    }
    let mut stats = Stats::start();
    let text = files::text(&args.operations, quiet)?;
    stats.phase("read");
    let wrong = |number: usize, what: String, help: &str| {
        Failure::new(format!("{}: line {number}: {what}", args.operations.display()), help)
    };
    let mut triangulation =
        Delaunay2::with_strategy(strategy).map_err(|error| Failure::usage(error, "see delone --help"))?;
    let mut replayed = Replayed::default();
    {
        let _phase = Phase::start(quiet, "replaying");
        for (number, line) in (1..).zip(text.lines()) {
            let operation = parse(line).map_err(|what| wrong(number, what, "see delone replay --help"))?;
            let Some(operation) = operation else { continue };
            replayed
                .perform(&mut triangulation, operation)
                .map_err(|error| wrong(number, error.to_string(), "see delone replay --help"))?;
            let count = triangulation.vertex_count();
            if args.check && (count <= CHECKED || replayed.operations.is_multiple_of(CHECKED)) {
                check(&triangulation)
                    .map_err(|what| wrong(number, what, "please report this with the input: it is a bug"))?;
            }
        }
        if args.check {
            check(&triangulation)
                .map_err(|what| Failure::new(what, "please report this with the input: it is a bug"))?;
        }
    }
    stats.phase("build");
    stats.triangulation(&triangulation);
    stats.set("operations", replayed.operations);
    stats.set("counters", work_done(&replayed.work));
    answer(&replayed.answers)?;
    let surface = Surface { triangulation: &triangulation, heights: None };
    for (path, format) in &outputs {
        files::write(path, |out| delone_io::write_surface(out, *format, &surface))?;
    }
    stats.phase("write");
    stats.write(args.stats.as_deref())
}

fn check(triangulation: &Delaunay2) -> Result<(), String> {
    triangulation.check().map_err(|flaw| format!("the triangulation is wrong: {flaw}"))
}

/// An operation, or nothing on a line without one.
fn parse(line: &str) -> Result<Option<Operation>, String> {
    let content = line.split('#').next().unwrap_or_default();
    let words: Vec<&str> = content.split_whitespace().collect();
    let number = |word: &str| word.parse::<f64>().map_err(|_| format!("{word:?} is no number"));
    let point = |x: &str, y: &str| Ok::<_, String>([number(x)?, number(y)?]);
    let vertex = |word: &str| {
        let id = word.parse::<usize>().ok().filter(|&id| id < delone::MAX_POINTS);
        id.map(VertexId::new).ok_or_else(|| format!("{word:?} is no id"))
    };
    Ok(Some(match words[..] {
        [] => return Ok(None),
        ["+", x, y] => Operation::Insert(point(x, y)?),
        ["-", id] => Operation::Remove(vertex(id)?),
        [">", id, x, y] => Operation::Move(vertex(id)?, point(x, y)?),
        ["?", x, y] => Operation::Locate(point(x, y)?),
        ["@", x, y] => Operation::Nearest(point(x, y)?),
        [sign @ ("+" | "-" | ">" | "?" | "@"), ..] => {
            return Err(format!("{sign} takes another number of values than {}", words.len() - 1));
        }
        [other, ..] => return Err(format!("{other:?} is no operation")),
    }))
}

/// What was done and said.
#[derive(Default)]
struct Replayed {
    answers: String,
    work: Work,
    operations: usize,
}

impl Replayed {
    fn perform(&mut self, triangulation: &mut Delaunay2, operation: Operation) -> Result<(), delone::Error> {
        self.operations += 1;
        match operation {
            Operation::Insert(p) => {
                let sign = match triangulation.insert_counted(p, &mut self.work)? {
                    Inserted::New(v) => ('+', v),
                    Inserted::Existing(v) => ('=', v),
                };
                self.say(format_args!("{} {}", sign.0, sign.1.index()));
            }
            Operation::Remove(v) => triangulation.remove_counted(v, &mut self.work)?,
            Operation::Move(v, p) => triangulation.move_to(v, p)?,
            Operation::Locate(q) => {
                let mesh = triangulation.mesh();
                let ends = |e| [mesh.origin(e), mesh.destination(e)].map(|v| v.index());
                match triangulation.locate_counted(q, &mut self.work)? {
                    Location::Triangle(t) => {
                        let mut corners = mesh.corners(t).map(VertexId::index);
                        let least = (0..3).min_by_key(|&k| corners[k]).unwrap_or(0);
                        corners.rotate_left(least);
                        let [a, b, c] = corners;
                        self.say(format_args!("? triangle {a} {b} {c}"));
                    }
                    Location::Edge(e) => {
                        let [a, b] = ends(e);
                        self.say(format_args!("? edge {} {}", a.min(b), a.max(b)));
                    }
                    Location::Vertex(v) => self.say(format_args!("? vertex {}", v.index())),
                    Location::Outside(e) => {
                        let [a, b] = ends(e);
                        self.say(format_args!("? outside {a} {b}"));
                    }
                    Location::LowerDimensional(_) => self.say(format_args!("? nowhere")),
                }
            }
            Operation::Nearest(q) => match triangulation.nearest_counted(q, &mut self.work)? {
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

#[cfg(test)]
mod tests {
    use super::{Operation, parse};
    use delone::VertexId;

    #[test]
    fn lines_are_read() {
        assert_eq!(parse("+ 1 -2.5e-3"), Ok(Some(Operation::Insert([1.0, -2.5e-3]))));
        assert_eq!(parse("  - 7 # gone"), Ok(Some(Operation::Remove(VertexId::new(7)))));
        assert_eq!(parse("> 0 1 2"), Ok(Some(Operation::Move(VertexId::new(0), [1.0, 2.0]))));
        assert_eq!(parse("# nothing"), Ok(None));
        for wrong in ["+ 1", "+ 1 2 3", "* 1 2", "- -1", "- 1.5", "? a b", "- 99999999999"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
