//! Points with weights: read, triangulated, told of and written.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use delone::surface::Duplicates;
use delone::{Regular, Triangulation};
use delone_io::{Border, Cloud, Format, picture, write_mesh};

use crate::args::{DrawArgs, InputArgs, TriangulateArgs, WeightArgs};
use crate::files;
use crate::message::{Failure, note};
use crate::progress::Phase;
use crate::room::{self, Room};
use crate::stats::Stats;

/// Sites, and their regular triangulation.
pub(crate) struct Weighted<R: Room> {
    pub(crate) triangulation: R::Regular,
    pub(crate) points: Vec<R::Point>,
    pub(crate) about: Cloud,
}

/// `delone triangulate`, with weights.
pub(crate) fn triangulate<R: Room>(args: &TriangulateArgs, quiet: bool) -> Result<(), Failure> {
    let algorithm = R::plan_regular(&args.strategy)?;
    let stats_path = args.input.stats.as_deref();
    let inputs: Vec<&Path> = args.input.paths().into_iter().chain(args.weights.file()).collect();
    let outputs = args.wkt.of(files::outputs(&args.output, args.to, stats_path, &inputs)?)?;
    room::check_formats::<R>(&outputs)?;
    let mut stats = Stats::start();
    let mut r = Weighted::<R>::read_for(algorithm, &args.input, &args.weights, &mut stats, quiet)?;
    r.settle(args.duplicates.rule());
    if args.check {
        let _phase = Phase::start(quiet, "checking");
        r.triangulation.check().map_err(|flaw| {
            Failure::new(
                format!("the triangulation is wrong: {flaw}"),
                "please report this with the input: it is a bug",
            )
        })?;
        stats.phase("check");
        note(quiet, "checked: this is the canonical regular triangulation");
    }
    if let Some(locate) = args.strategy.locate.and_then(|locate| locate.to_possible_value()) {
        stats.set("locate", locate.get_name());
    }
    r.write(&outputs, &args.border(), &picture::Options::default(), &mut stats, quiet)?;
    stats.tell(quiet, R::WORDS.simplex);
    stats.write(stats_path)
}

/// `delone draw`, with weights.
pub(crate) fn draw<R: Room>(
    args: &DrawArgs,
    outputs: &[(PathBuf, Format)],
    options: &picture::Options,
    quiet: bool,
) -> Result<(), Failure> {
    let mut stats = Stats::start();
    let mut r = Weighted::<R>::read(&args.input, &args.weights, &mut stats, quiet)?;
    r.settle(Duplicates::default());
    r.write(outputs, &Border::long_edges(args.max_edge), options, &mut stats, quiet)?;
    stats.tell(quiet, R::WORDS.simplex);
    stats.write(args.input.stats.as_deref())
}

impl<R: Room> Weighted<R> {
    /// Reads and triangulates, and tells what a user should know.
    pub(crate) fn read(
        input: &InputArgs,
        args: &WeightArgs,
        stats: &mut Stats,
        quiet: bool,
    ) -> Result<Self, Failure> {
        Self::read_for(R::RegularAlgorithm::default(), input, args, stats, quiet)
    }

    fn read_for(
        algorithm: R::RegularAlgorithm,
        input: &InputArgs,
        args: &WeightArgs,
        stats: &mut Stats,
        quiet: bool,
    ) -> Result<Self, Failure> {
        let (points, weights, about) = read::<R>(input, args, quiet)?;
        stats.phase("read");
        let phase = Phase::start(quiet, "triangulating");
        let triangulation = R::regular(&points, &weights, algorithm)
            .map_err(|error| Failure::points(&input.label(), &error))?;
        drop(phase);
        tell(&triangulation, stats, quiet);
        Ok(Self { triangulation, points, about })
    }

    /// Gives the vertex of each place the height of the place, whichever of the points there it is: the heaviest.
    fn settle(&mut self, rule: Duplicates) {
        let Some(heights) = &mut self.about.z else { return };
        let points: Vec<[f64; 2]> = self.points.iter().map(|p| [p.as_ref()[0], p.as_ref()[1]]).collect();
        rule.settle_at(&points, self.triangulation.vertices().map(|v| v.index()), heights);
    }

    /// Writes all outputs.
    pub(crate) fn write(
        &self,
        outputs: &[(PathBuf, Format)],
        border: &Border,
        options: &picture::Options,
        stats: &mut Stats,
        quiet: bool,
    ) -> Result<(), Failure> {
        let trim = room::trim_border(&self.triangulation, border, stats, quiet);
        let mesh = room::mesh(&self.triangulation, &self.points, &self.about, trim.as_ref());
        let phase = Phase::start(quiet, "writing");
        for (path, format) in outputs {
            files::write_mesh(path, quiet, |out| write_mesh(out, *format, &mesh, &files::drawn(options)))?;
        }
        drop(phase);
        stats.phase("write");
        Ok(())
    }
}

/// Ends the construction of a triangulation, and tells what a user should know of it.
pub(crate) fn tell(triangulation: &impl Regular, stats: &mut Stats, quiet: bool) {
    stats.phase("build");
    room::remark(triangulation, quiet);
    let hidden = triangulation.hidden().count();
    tell_hidden(hidden, quiet);
    stats.triangulation(triangulation, triangulation.counters());
    stats.set("hidden", hidden);
}

/// Tells that so many sites have no cell.
pub(crate) fn tell_hidden(hidden: usize, quiet: bool) {
    if hidden > 0 {
        let (is, site) = if hidden == 1 { ("is", "site") } else { ("are", "sites") };
        note(quiet, format_args!("{hidden} {site} {is} hidden by others: no point is nearest to them"));
    }
}

/// Points, their weights, and what is known of them.
type Sites<P> = (Vec<P>, Vec<f64>, Cloud);

/// Reads points and their weights.
pub(crate) fn read<R: Room>(
    input: &InputArgs,
    args: &WeightArgs,
    quiet: bool,
) -> Result<Sites<R::Point>, Failure> {
    if let Some(said) = args.given() {
        check_beside(input, said)?;
    }
    let (points, about) = room::read::<R>(input, quiet)?;
    let weights = weights(input, args, points.len(), quiet)?;
    Ok((points, weights, about))
}

/// Refuses a column of what has none, before anything is read.
pub(crate) fn check_beside(input: &InputArgs, said: &str) -> Result<(), Failure> {
    if Path::new(said).exists() { Ok(()) } else { files::check_column(input, said) }
}

/// A number for each of so many points, from a file or from a column of their own; and where it is from.
pub(crate) fn beside(
    input: &InputArgs,
    said: &str,
    count: usize,
    what: &str,
    quiet: bool,
) -> Result<(Vec<f64>, PathBuf), Failure> {
    let path = Path::new(said);
    let (numbers, label) = if path.exists() {
        (files::numbers(path, quiet)?, path.to_owned())
    } else {
        (files::column(input, said, quiet)?, input.label())
    };
    if numbers.len() != count {
        return Err(Failure::new(
            format!("{}: {} {what} for {count} points", label.display(), numbers.len()),
            "give one number for each point, row by row",
        ));
    }
    Ok((numbers, label))
}

/// The weight of every point.
fn weights(input: &InputArgs, args: &WeightArgs, count: usize, quiet: bool) -> Result<Vec<f64>, Failure> {
    let Some(said) = args.given() else { return Ok(vec![0.0; count]) };
    let (numbers, label) = beside(input, said, count, "weights", quiet)?;
    let weight = |(index, number)| {
        args.weight(number).map_err(|flaw| {
            Failure::new(
                format!("{}: point {index} has {flaw}", label.display()),
                "remove that point or repair its number: weights may be any finite ones, radii from 0 to 1e154",
            )
        })
    };
    numbers.into_iter().enumerate().map(weight).collect()
}
