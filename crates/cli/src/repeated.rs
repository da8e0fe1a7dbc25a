//! Boxes that repeat: those of files, what is told of triangulations in them, and their cells in the plane.

use std::path::PathBuf;

use delone::{
    CellularKind, Delaunay2, Lattice, Lattice2, Periodic, Periodic2, PeriodicKind, PeriodicRegular2,
    Regular2, Triangulation, VertexId,
};
use delone_io::{Cloud, Diagram, Format};

use crate::args::{PeriodicBox, VoronoiArgs};
use crate::message::{Failure, note};
use crate::progress::Phase;
use crate::stats::Stats;
use crate::{files, sites, weighted};

/// A note where no decimals are found.
pub(crate) const NO_GRID: &str =
    "the coordinates are multiples of no power of ten: they are taken as they are";

/// The box that is asked for: `of_numbers`, or that of the file.
pub(crate) fn lattice<const D: usize>(
    args: &VoronoiArgs,
    of_numbers: Option<Lattice<D>>,
    about: &Cloud,
    quiet: bool,
) -> Result<Option<Lattice<D>>, Failure> {
    args.space.compare(about.cell.as_ref(), quiet);
    if args.space.periodic != Some(PeriodicBox::OfFile) {
        return Ok(of_numbers);
    }
    let cell = about.cell.ok_or_else(|| {
        Failure::new(
            format!("{}: it tells no box", args.input.label().display()),
            "give the box as --periodic LX,LY,LZ, or a file that has one: lammpstrj, extxyz",
        )
    })?;
    args.space.of_cell(&cell, quiet).map(Some)
}

/// Tells what a user should know of a triangulation in a box.
pub(crate) fn tell<T: PeriodicKind<D, N>, const D: usize, const N: usize>(
    made: &Periodic<T, D, N>,
    args: &VoronoiArgs,
    stats: &mut Stats,
    quiet: bool,
) {
    let (points, duplicates) = (made.ids_given(), made.duplicates().count());
    if duplicates > 0 {
        let text = if duplicates == 1 {
            "is a copy of another one, and has no cell"
        } else {
            "are copies of others, and have no cells"
        };
        note(quiet, format_args!("{duplicates} of {points} points {text}"));
    }
    let hidden = made.hidden().count();
    weighted::tell_hidden(hidden, quiet);
    match (args.space.grid, made.decimal_step()) {
        (Some(_), Some(step)) => tell_grid(step, made.rounding(), stats, quiet),
        (Some(_), None) => note(quiet, NO_GRID),
        (None, _) => {}
    }
    stats.set("points", points);
    stats.set("duplicates", duplicates);
    stats.set("vertices", made.vertices().count());
    stats.set("simplices", made.simplex_count());
    stats.set("hidden", hidden);
    stats.set("rounding", made.rounding());
}

/// Tells the decimal grid that was taken.
pub(crate) fn tell_grid(step: f64, moved: f64, stats: &mut Stats, quiet: bool) {
    stats.set("grid", step);
    stats.set("rounding", moved);
    note(
        quiet,
        format_args!("coordinates are taken as multiples of {step:?}, and move by at most {moved:.1e}"),
    );
}

/// Tells how many cells are beyond the walls.
pub(crate) fn tell_beyond(beyond: usize, stats: &mut Stats, quiet: bool) {
    if beyond > 0 {
        let text = if beyond == 1 { "cell is" } else { "cells are" };
        note(quiet, format_args!("{beyond} {text} beyond the walls of the box, and empty"));
    }
    stats.set("beyond", beyond);
}

/// `delone voronoi --periodic` in the plane.
pub(crate) fn run(args: &VoronoiArgs, outputs: &[(PathBuf, Format)], quiet: bool) -> Result<(), Failure> {
    let refused = [
        (args.order.is_some(), "--order"),
        (args.relax > 0, "--relax"),
        (args.areas.is_some(), "--areas"),
        (args.merge.is_some(), "--merge"),
        (args.sites.is_some(), "--sites"),
    ];
    if let Some((_, option)) = refused.iter().find(|option| option.0) {
        return Err(Failure::usage(
            format!("{option} is not for boxes that repeat"),
            format!("leave {option} or --periodic out"),
        ));
    }
    let of_numbers: Option<Lattice2> = args.space.of_numbers()?;
    let mut stats = Stats::start();
    let (points, weights, about) = weighted::read::<Delaunay2>(&args.input, &args.weights, quiet)?;
    stats.phase("read");
    let Some(lattice) = lattice(args, of_numbers, &about, quiet)? else { return Ok(()) };
    let label = args.input.label();
    let failed = |error: delone::Error| Failure::points(&label, &error);
    let phase = Phase::start(quiet, "triangulating");
    let work = Work { args, about: &about, outputs, quiet };
    if args.weights.given().is_some() {
        let made = PeriodicRegular2::from_parts(&points, &weights, &lattice).map_err(failed)?;
        let sites = Regular2::from_parts(&points, &weights).map_err(failed)?;
        drop(phase);
        work.write(&made, &sites, &mut stats)?;
    } else {
        let made = Periodic2::from_points(&points, &lattice).map_err(failed)?;
        let sites = Delaunay2::from_points(&points).map_err(failed)?;
        drop(phase);
        work.write(&made, &sites, &mut stats)?;
    }
    stats.phase("write");
    stats.tell(quiet, ["triangle", "triangles"]);
    stats.write(args.input.stats.as_deref())
}

struct Work<'a> {
    args: &'a VoronoiArgs,
    about: &'a Cloud,
    outputs: &'a [(PathBuf, Format)],
    quiet: bool,
}

impl Work<'_> {
    /// Writes the cells of all sites, of which a triangulation without copies knows where they are.
    fn write<T: CellularKind<2, 3>>(
        &self,
        made: &Periodic<T, 2, 3>,
        sites: &impl Triangulation<Point = [f64; 2]>,
        stats: &mut Stats,
    ) -> Result<(), Failure> {
        stats.phase("build");
        tell(made, self.args, stats, self.quiet);
        let phase = Phase::start(self.quiet, "cutting cells");
        let cells =
            made.cells().map_err(|error| Failure::points(&self.args.input.label(), &error))?.to_cells();
        drop(phase);
        stats.phase("cells");
        let count = made.vertices().filter(|&v| cells.rings(v).next().is_some()).count();
        tell_beyond(made.vertices().count() - count, stats, self.quiet);
        stats.set("cells", count);
        let areas = (0..made.ids_given()).map(|i| cells.area(VertexId::new(i)));
        stats.set("area", areas.sum::<f64>());
        let features = sites::features(self.about, sites, self.quiet);
        let diagram = Diagram {
            triangulation: sites,
            cells: &cells,
            crs: self.about.crs.as_ref(),
            features: Some(&features),
        };
        let _phase = Phase::start(self.quiet, "writing");
        for (path, format) in self.outputs {
            files::write(path, |out| {
                delone_io::write_diagram(out, *format, &diagram, self.args.camera.size)
            })?;
        }
        Ok(())
    }
}
