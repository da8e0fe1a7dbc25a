//! `delone replay`: a text file of operations, as it comes with a report of a bug.

use std::fmt::Write;

use delone::{Ask, Change, Delaunay2, Delaunay3, Error, Inserted, Location2, Location3, VertexId, Work};
use delone_io::{Body, Format, Surface, picture};

use crate::args::ReplayArgs;
use crate::message::{Failure, answer};
use crate::progress::Phase;
use crate::stats::{Stats, work_done};
use crate::{files, space};

/// Up to this number of vertices every operation is checked; beyond it, one in as many.
const CHECKED: usize = 1000;

/// One line.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Operation<const D: usize> {
    Insert([f64; D]),
    Remove(VertexId),
    Move(VertexId, [f64; D]),
    Locate([f64; D]),
    Nearest([f64; D]),
}

/// A triangulation that can be asked and changed, of the plane or of space.
trait Stage<const D: usize> {
    fn insert(&mut self, p: [f64; D], work: &mut Work) -> Result<Inserted, Error>;
    fn remove(&mut self, v: VertexId, work: &mut Work) -> Result<(), Error>;
    fn move_to(&mut self, v: VertexId, p: [f64; D]) -> Result<(), Error>;
    /// Where a point falls, in words.
    fn describe(&self, q: [f64; D], work: &mut Work) -> Result<String, Error>;
    fn nearest(&self, q: [f64; D], work: &mut Work) -> Result<Option<VertexId>, Error>;
    fn vertex_count(&self) -> usize;
    fn check(&self) -> Result<(), String>;
}

pub(crate) fn run(args: &ReplayArgs, quiet: bool) -> Result<(), Failure> {
    let strategy = args.locate.strategy(args.seed).ok_or_else(|| {
        Failure::usage(
            "that strategy is for building in bulk, not for changes",
            "choose --locate tree, walk, jump-and-walk, hierarchy or history",
        )
    })?;
    let outputs = files::outputs(&args.output, args.to, args.stats.as_deref(), &[&args.operations])?;
    let holds = |format: Format| {
        if args.dim.is_space() { space::holds_bodies(format) } else { format.holds_meshes() }
    };
    if let Some((path, format)) = outputs.iter().find(|(_, format)| !holds(*format)) {
        let error = if args.dim.is_space() {
            delone_io::Error::NotABody(*format)
        } else {
            delone_io::Error::NotAMesh(*format)
        };
        return Err(Failure::file(path, &error));
    }
    let unfit = |error: Error| Failure::usage(error, "see delone --help");
    let mut stats = Stats::start();
    if args.dim.is_space() {
        let mut d = Delaunay3::new();
        d.set_strategy(strategy).map_err(unfit)?;
        let replayed = replay(args, &mut d, &mut stats, quiet)?;
        stats.space(&d, replayed.points.len());
        stats.set("counters", work_done(&replayed.work));
        let body = Body { triangulation: &d, points: &replayed.points, crs: None, base: 0 };
        for (path, format) in &outputs {
            let camera = picture::Camera::default();
            files::write(path, |out| delone_io::write_body(out, *format, &body, &camera))?;
        }
    } else {
        let mut d = Delaunay2::with_strategy(strategy).map_err(unfit)?;
        let replayed = replay(args, &mut d, &mut stats, quiet)?;
        stats.triangulation(&d);
        stats.set("counters", work_done(&replayed.work));
        let surface = Surface::new(&d);
        for (path, format) in &outputs {
            files::write(path, |out| delone_io::write_surface(out, *format, &surface))?;
        }
    }
    stats.phase("write");
    stats.write(args.stats.as_deref())
}

/// Reads and performs all operations, and prints the answers.
fn replay<const D: usize>(
    args: &ReplayArgs,
    stage: &mut impl Stage<D>,
    stats: &mut Stats,
    quiet: bool,
) -> Result<Replayed<D>, Failure> {
    let text = files::text(&args.operations, quiet)?;
    stats.phase("read");
    let wrong = |number: usize, what: String, help: &str| {
        Failure::new(format!("{}: line {number}: {what}", args.operations.display()), help)
    };
    let mut replayed = Replayed::default();
    {
        let _phase = Phase::start(quiet, "replaying");
        for (number, line) in (1..).zip(text.lines()) {
            let operation = parse(line).map_err(|what| wrong(number, what, "see delone replay --help"))?;
            let Some(operation) = operation else { continue };
            replayed
                .perform(stage, operation)
                .map_err(|error| wrong(number, error.to_string(), "see delone replay --help"))?;
            let count = stage.vertex_count();
            if args.check && (count <= CHECKED || replayed.operations.is_multiple_of(CHECKED)) {
                stage
                    .check()
                    .map_err(|what| wrong(number, what, "please report this with the input: it is a bug"))?;
            }
        }
        if args.check {
            stage
                .check()
                .map_err(|what| Failure::new(what, "please report this with the input: it is a bug"))?;
        }
    }
    stats.phase("build");
    stats.set("operations", replayed.operations);
    answer(&replayed.answers)?;
    Ok(replayed)
}

/// An operation, or nothing on a line without one.
fn parse<const D: usize>(line: &str) -> Result<Option<Operation<D>>, String> {
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
    let takes = usize::from(with_id) + if sign == "-" { 0 } else { D };
    if values.len() != takes {
        return Err(format!("{sign} takes {takes} values, not {}", values.len()));
    }
    let mut point = [0.0; D];
    for (x, word) in point.iter_mut().zip(&values[usize::from(with_id)..]) {
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

/// What was done and said.
struct Replayed<const D: usize> {
    answers: String,
    work: Work,
    operations: usize,
    /// By id, where each vertex is or was.
    points: Vec<[f64; D]>,
}

impl<const D: usize> Default for Replayed<D> {
    fn default() -> Self {
        Self { answers: String::new(), work: Work::default(), operations: 0, points: Vec::new() }
    }
}

impl<const D: usize> Replayed<D> {
    fn perform(&mut self, stage: &mut impl Stage<D>, operation: Operation<D>) -> Result<(), Error> {
        self.operations += 1;
        match operation {
            Operation::Insert(p) => {
                let sign = match stage.insert(p, &mut self.work)? {
                    Inserted::New(v) => {
                        self.points.push(p);
                        ('+', v)
                    }
                    Inserted::Existing(v) => ('=', v),
                };
                self.say(format_args!("{} {}", sign.0, sign.1.index()));
            }
            Operation::Remove(v) => stage.remove(v, &mut self.work)?,
            Operation::Move(v, p) => {
                stage.move_to(v, p)?;
                self.points[v.index()] = p;
            }
            Operation::Locate(q) => {
                let words = stage.describe(q, &mut self.work)?;
                self.say(format_args!("? {words}"));
            }
            Operation::Nearest(q) => match stage.nearest(q, &mut self.work)? {
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

/// From the smallest on, in the same sense.
fn turned<const N: usize>(mut corners: [usize; N]) -> [usize; N] {
    let least = (0..N).min_by_key(|&k| corners[k]).unwrap_or(0);
    corners.rotate_left(least);
    corners
}

impl Stage<2> for Delaunay2 {
    fn insert(&mut self, p: [f64; 2], work: &mut Work) -> Result<Inserted, Error> {
        self.insert_observed(p, work)
    }

    fn remove(&mut self, v: VertexId, work: &mut Work) -> Result<(), Error> {
        self.remove_observed(v, work)
    }

    fn move_to(&mut self, v: VertexId, p: [f64; 2]) -> Result<(), Error> {
        self.move_to(v, p)
    }

    fn describe(&self, q: [f64; 2], work: &mut Work) -> Result<String, Error> {
        let mesh = self.mesh();
        let ends = |e| [mesh.origin(e), mesh.destination(e)].map(VertexId::index);
        Ok(match self.find_observed(q, work)? {
            Location2::Triangle(t) => {
                let [a, b, c] = turned(mesh.corners(t).map(VertexId::index));
                format!("triangle {a} {b} {c}")
            }
            Location2::Edge(e) => {
                let [a, b] = ends(e);
                format!("edge {} {}", a.min(b), a.max(b))
            }
            Location2::Vertex(v) => format!("vertex {}", v.index()),
            Location2::Outside(e) => {
                let [a, b] = ends(e);
                format!("outside {a} {b}")
            }
            Location2::LowerDimensional(_) => "nowhere".to_owned(),
        })
    }

    fn nearest(&self, q: [f64; 2], work: &mut Work) -> Result<Option<VertexId>, Error> {
        self.nearest_observed(q, work)
    }

    fn vertex_count(&self) -> usize {
        self.vertex_count()
    }

    fn check(&self) -> Result<(), String> {
        self.check().map_err(|flaw| format!("the triangulation is wrong: {flaw}"))
    }
}

impl Stage<3> for Delaunay3 {
    fn insert(&mut self, p: [f64; 3], work: &mut Work) -> Result<Inserted, Error> {
        self.insert_observed(p, work)
    }

    fn remove(&mut self, v: VertexId, work: &mut Work) -> Result<(), Error> {
        self.remove_observed(v, work)
    }

    fn move_to(&mut self, v: VertexId, p: [f64; 3]) -> Result<(), Error> {
        self.move_to(v, p)
    }

    fn describe(&self, q: [f64; 3], work: &mut Work) -> Result<String, Error> {
        let mesh = self.mesh();
        let corners = |f| turned(mesh.facet_corners(f).map(VertexId::index));
        Ok(match self.find_observed(q, work)? {
            Location3::Tetrahedron(t) => {
                let [a, b, c, d] = space::positive(mesh.corners(t).map(VertexId::index));
                format!("tetrahedron {a} {b} {c} {d}")
            }
            Location3::Facet(f) => {
                // The same from both sides.
                let [a, b, c] = corners(f).min(corners(mesh.twin(f)));
                format!("facet {a} {b} {c}")
            }
            Location3::Edge(ends) => {
                let [a, b] = ends.map(VertexId::index);
                format!("edge {} {}", a.min(b), a.max(b))
            }
            Location3::Vertex(v) => format!("vertex {}", v.index()),
            Location3::Outside(f) => {
                let [a, b, c] = corners(mesh.twin(f));
                format!("outside {a} {b} {c}")
            }
            Location3::LowerDimensional(_) => "nowhere".to_owned(),
        })
    }

    fn nearest(&self, q: [f64; 3], work: &mut Work) -> Result<Option<VertexId>, Error> {
        self.nearest_observed(q, work)
    }

    fn vertex_count(&self) -> usize {
        self.vertex_count()
    }

    fn check(&self) -> Result<(), String> {
        self.check().map_err(|flaw| format!("the triangulation is wrong: {flaw}"))
    }
}

#[cfg(test)]
mod tests {
    use super::{Operation, parse};
    use delone::VertexId;

    #[test]
    fn lines_are_read() {
        let parse = parse::<2>;
        assert_eq!(parse("+ 1 -2.5e-3"), Ok(Some(Operation::Insert([1.0, -2.5e-3]))));
        assert_eq!(parse("  - 7 # gone"), Ok(Some(Operation::Remove(VertexId::new(7)))));
        assert_eq!(parse("> 0 1 2"), Ok(Some(Operation::Move(VertexId::new(0), [1.0, 2.0]))));
        assert_eq!(parse("# nothing"), Ok(None));
        for wrong in ["+ 1", "+ 1 2 3", "* 1 2", "- -1", "- 1.5", "? a b", "- 99999999999"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
        assert_eq!(super::parse("@ 1 2 3"), Ok(Some(Operation::Nearest([1.0, 2.0, 3.0]))));
        assert!(super::parse::<3>("@ 1 2").is_err());
    }
}
