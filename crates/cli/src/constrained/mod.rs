//! Points with segments: read, triangulated, told of and written.

pub(crate) mod features;
pub(crate) mod regions;

use std::path::{Path, PathBuf};

use delone::surface::Duplicates;
use delone::{
    Constrained2, Counters, Crossings, Domains2, Fill, Membership2, Merges, Seeds2, SegmentId, TriangleId,
    Triangulation, VertexId,
};
use delone_io::{Border, Constraints, Contents, Format, Graph, Mesh, Names, Rows, Trim, picture, write_mesh};
use delone_terrain::values::extended;

use crate::antimeridian;
use crate::args::{CrossingsName, DrawArgs, FillName, GraphArgs, InputArgs, TriangulateArgs};
use crate::files;
use crate::message::{Failure, lost, note};
use crate::progress::Phase;
use crate::room;
use crate::stats::Stats;
use crate::weld;
use features::Shells;
use regions::{Claims, Regions};

/// Whether a command is about segments: they were asked for, or files hold them.
pub fn is_meant(input: &InputArgs, graph: &GraphArgs) -> bool {
    let holds = |path: &PathBuf| {
        let format = input.from.or_else(|| Format::of(path).ok());
        format.is_some_and(|format| files::holds_lines(path, format))
    };
    graph.is_given() || input.input.iter().any(holds)
}

/// `delone triangulate`, with segments.
pub(crate) fn triangulate(args: &TriangulateArgs, quiet: bool) -> Result<(), Failure> {
    let stats_path = args.input.stats.as_deref();
    let mut inputs = args.input.paths();
    inputs.extend(args.graph.segments.as_deref());
    let outputs = args.wkt.of(files::outputs(&args.output, args.to, stats_path, &inputs)?)?;
    room::check_formats::<delone::Delaunay2>(&outputs)?;
    files::keep_attributes(Contents::Triangles);
    let mut stats = Stats::start();
    let rule = args.duplicates.rule();
    let c = Constrained::read(&args.input, &args.graph, rule, &mut stats, quiet)?;
    if args.check {
        let _phase = Phase::start(quiet, "checking");
        c.triangulation.check().map_err(|flaw| {
            Failure::new(
                format!("the triangulation is wrong: {flaw}"),
                "please report this with the input: it is a bug",
            )
        })?;
        stats.phase("check");
        note(quiet, "checked: this is the canonical constrained Delaunay triangulation");
    }
    c.write(&outputs, &args.border(), &picture::Options::default(), &mut stats, quiet)?;
    stats.tell(quiet, ["triangle", "triangles"]);
    stats.write(stats_path)
}

/// `delone draw`, with segments.
pub(crate) fn draw(
    args: &DrawArgs,
    outputs: &[(PathBuf, Format)],
    options: &picture::Options,
    quiet: bool,
) -> Result<(), Failure> {
    let mut stats = Stats::start();
    let rule = Duplicates::default();
    let c = Constrained::read(&args.input, &args.graph, rule, &mut stats, quiet)?;
    c.write(outputs, &Border::long_edges(args.max_edge), options, &mut stats, quiet)?;
    stats.tell(quiet, ["triangle", "triangles"]);
    stats.write(args.input.stats.as_deref())
}

/// A triangulation with segments, and what is inside of it.
pub(crate) struct Constrained {
    pub(crate) triangulation: Constrained2,
    pub(crate) graph: Graph,
    /// The parts of it, and which regions of the input they are.
    pub(crate) inside: Domains2,
    /// The regions that polygons of the input are.
    pub(crate) regions: Regions,
    /// The height of every point, those added too.
    pub(crate) heights: Option<Vec<f64>>,
}

impl Constrained {
    /// Reads and triangulates, and tells what a user should know.
    pub(crate) fn read(
        input: &InputArgs,
        args: &GraphArgs,
        rule: Duplicates,
        stats: &mut Stats,
        quiet: bool,
    ) -> Result<Self, Failure> {
        let mut graph = files::graph(input, args.segments.as_deref(), quiet)?;
        antimeridian::heed(&mut graph, args.antimeridian, input, stats, quiet)?;
        weld::weld(&mut graph, args.weld, &input.label(), stats, quiet)?;
        if let Some(heights) = &mut graph.cloud.z {
            rule.settle_equal(&graph.cloud.xy, heights);
        }
        stats.phase("read");
        let crossings = args.crossings.unwrap_or(CrossingsName::Refuse);
        let name = args.fill.unwrap_or_else(|| usual(input, &graph));
        let claims = Claims::of(args.overlaps);
        Self::of(graph, crossings, (name, false, &claims), &input.label(), stats, quiet)
    }

    /// Triangulates, and tells what a user should know. Where seeds say what is inside bays of the hull may be kept.
    pub(crate) fn of(
        mut graph: Graph,
        crossings: CrossingsName,
        (fill, keep_concavities, claims): (FillName, bool, &Claims),
        label: &Path,
        stats: &mut Stats,
        quiet: bool,
    ) -> Result<Self, Failure> {
        let refused = |error: delone::Error| Failure::graph(label, &error);
        let crossings = match crossings {
            CrossingsName::Split => Crossings::Split,
            CrossingsName::Refuse => Crossings::Refuse,
        };
        let phase = Phase::start(quiet, "triangulating");
        let triangulation =
            Constrained2::with_crossings(&graph.cloud.xy, &graph.segments, crossings).map_err(refused)?;
        features::leave_far_seeds(&triangulation, &mut graph, quiet);
        let seeds = Seeds2::default().holes(graph.holes.clone()).keep_concavities(keep_concavities);
        // Without polygons, lines are all that can bound an area.
        let lines_bound = !graph.is_border.contains(&true);
        let is_border = |s: SegmentId| lines_bound || graph.is_border.get(s.index()).copied().unwrap_or(true);
        let within = |fill: Fill| triangulation.domains_within(&fill, is_border).map_err(refused);
        let shells = Shells::of(&graph);
        let mut inside = match fill {
            FillName::All => within(Fill::All)?,
            FillName::EvenOdd => within(Fill::EvenOdd)?,
            FillName::Nonzero => within(Fill::NonZero)?,
            FillName::Positive => within(Fill::Positive)?,
            FillName::Negative => within(Fill::Negative)?,
            FillName::Seeds => within(Fill::Seeds(&seeds))?,
            FillName::ShellsMinusHoles if graph.rings.is_empty() => {
                let problem = format!(
                    "{}: --fill shells-minus-holes is for polygons, and there are none",
                    label.display()
                );
                return Err(Failure::new(problem, "give a file of polygons, or --fill even-odd"));
            }
            FillName::ShellsMinusHoles => shells.minus_holes(&triangulation),
        };
        if fill != FillName::All && graph.rings.iter().any(|ring| ring.ring > 0) {
            shells.remark(&triangulation, &graph, &inside).into_iter().for_each(|text| note(quiet, text));
        }
        triangulation.claim(&mut inside, &graph.regions).map_err(refused)?;
        let ring = |s: SegmentId| shells.ring(s);
        let membership = match fill {
            FillName::Nonzero | FillName::Positive | FillName::Negative => Membership2::NonZero,
            FillName::ShellsMinusHoles => Membership2::Shells { ring: &ring, shells: shells.shells() },
            FillName::All | FillName::EvenOdd | FillName::Seeds => Membership2::EvenOdd,
        };
        let regions = Regions::claim(&triangulation, &graph, &mut inside, claims, membership)?;
        files::heed_unshown(features::unshown(&triangulation, &graph, &inside, &regions));
        drop(phase);
        stats.phase("build");
        let heights = graph.cloud.z.as_deref().map(|given| {
            let (heights, widest) = extended(&triangulation, 1, given, |_| None);
            if widest > 0.0 {
                let text = format!(
                    "where segments cross their heights differ by {widest} at most; the mean was taken"
                );
                note(quiet, text);
            }
            heights
        });
        let c = Self { triangulation, graph, inside, regions, heights };
        c.tell(stats, quiet);
        Ok(c)
    }

    /// Remarks and counts.
    fn tell(&self, stats: &mut Stats, quiet: bool) {
        let (c, report) = (&self.triangulation, self.triangulation.report());
        room::remark(c, quiet);
        stats.triangulation(c, Counters::DivideAndConquer(Merges::default()));
        let counts = [
            ("zero_length", report.zero_length, "of no length", "left out"),
            ("repeated", report.repeated, "the same as others", "taken once"),
            ("overlapping", report.overlapping, "overlapping others", "joined"),
            ("through_vertices", report.through_vertices, "with vertices inside of them", "cut there"),
        ];
        for (name, count, what, done) in counts {
            stats.set(name, count);
            if count > 0 {
                note(quiet, format_args!("segments {what}: {count}, {done}"));
            }
        }
        stats.set("crossings", report.crossings);
        stats.set("added_points", report.added_points);
        stats.set("rounds", report.rounds);
        if report.crossings > 0 {
            let (count, added) = (report.crossings, report.added_points);
            note(
                quiet,
                format_args!("crossings of segments: {count}, split at {added} points that were added"),
            );
        }
        stats.set("segments", self.graph.segments.len());
        stats.set("constraints", c.constraint_edges().count());
        stats.set("parts", self.inside.parts().len());
        if let Some(report) = self.regions.report() {
            let count = self.regions.combined();
            note(
                quiet,
                format_args!(
                    "regions of several polygons: {count}; they have the attributes of the last, and --stats lists them"
                ),
            );
            stats.set("combined", report);
        }
        for [first, second] in self.inside.rivals() {
            note(
                quiet,
                format_args!("regions {first} and {second} are in one part, which region {first} has"),
            );
        }
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
        let (c, graph) = (&self.triangulation, &self.graph);
        // Segments stay edges.
        let may_go = |t: TriangleId| [0, 1, 2].into_iter().all(|k| !c.is_constraint(t.edge(k)));
        let gone = Trim::along_border(c, border, may_go);
        room::tell_slivers(&gone, border, stats, quiet);
        let stays = |t: TriangleId| self.inside.is_inside(t) && gone.keeps(c.index(t));
        let trim = Trim::keeping(c, stays);
        stats.set("left_out", trim.count());
        let edges: Vec<[VertexId; 2]> = c.constraints().collect();
        let markers = graph.markers.as_deref().map(|markers| self.markers(markers));
        let lines = features::of_lines(c, graph);
        let of_lines = lines.as_ref().map(|of| Rows { table: &graph.cloud.features.table, of });
        let constraints = Constraints {
            edges: &edges,
            markers: markers.as_deref(),
            features: of_lines,
            holes: &graph.holes,
            regions: &graph.regions,
        };
        let mut regions = vec![0.0; c.slot_count()];
        let mut rows = vec![None; c.slot_count()];
        for t in c.triangle_ids() {
            regions[c.index(t)] = self.inside.attribute(t).unwrap_or_default();
            rows[c.index(t)] = self.inside.region(t).map(|region| self.regions.row(region));
        }
        let features = Rows { table: &graph.cloud.features.table, of: &rows };
        let has_regions = !graph.regions.is_empty() || self.regions.polygons > 1;
        let mesh = Mesh {
            heights: self.heights.as_deref(),
            crs: graph.cloud.crs.as_ref(),
            base: graph.cloud.base,
            trim: (trim.count() > 0).then_some(&trim),
            constraints: Some(&constraints),
            regions: has_regions.then_some(&regions[..]),
            names: Some(&graph.names),
            features: (self.regions.polygons > 0).then_some(features),
            ..Mesh::new(c, c.points())
        };
        let phase = Phase::start(quiet, "writing");
        for (path, format) in outputs {
            tell_names(&graph.names, path, *format, quiet);
            files::write_mesh(path, quiet, |out| write_mesh(out, *format, &mesh, &files::drawn(options)))?;
        }
        drop(phase);
        stats.phase("write");
        Ok(())
    }

    /// The marker of each constraint: that of the first segment on it.
    fn markers(&self, of_segments: &[i64]) -> Vec<i64> {
        let c = &self.triangulation;
        let first = |e| c.covering(e).first().map(|covering| covering.segment.index());
        c.constraint_edges()
            .map(|e| first(e).and_then(|s| of_segments.get(s)).copied().unwrap_or(0))
            .collect()
    }
}

/// Tells that a file is without names, if there are some and it is more than a picture.
pub(crate) fn tell_names(names: &Names, path: &Path, format: Format, quiet: bool) {
    if !names.is_empty() && !format.keeps_names() && !matches!(format, Format::Png | Format::Svg) {
        lost(quiet, format_args!("{}: names of regions and boundaries are left out", path.display()));
    }
}

/// The default rule for the inside.
pub(crate) fn usual(input: &InputArgs, graph: &Graph) -> FillName {
    let is_poly = |path: &PathBuf| input.from.or_else(|| Format::of(path).ok()) == Some(Format::Poly);
    if input.input.iter().any(is_poly) && graph.rings.is_empty() {
        FillName::Seeds
    } else if graph.rings.is_empty() {
        FillName::All
    } else {
        FillName::EvenOdd
    }
}
