//! `delone mesh`: points and segments in, triangles of wanted angles and sizes out.

mod field;
mod kept;
mod layers;
mod markers;
mod names;
mod naming;
mod parts;
mod plan;
mod proof;
mod quads;
mod seeds;
mod source;
mod tell;

use std::collections::BTreeSet;
use std::path::Path;

use delone::{
    Constrained2, EdgeId, Error, Fill, Location2, Middle2, Refined2, Seeds2, SegmentId, Shapes2,
    Triangulation, VertexId,
};
use delone_io::{
    Attributes, Constraints, Contents, Format, Graph, Mesh, Rows, picture, write_mesh, write_voronoi_edge,
    write_voronoi_node,
};
use delone_terrain::values::{along, extended};

use crate::args::{ColorName, FillName, MeshArgs, triangle_table};
use crate::constrained::Constrained;
use crate::constrained::features;
use crate::constrained::regions::{Claims, Regions};
use crate::files;
use crate::message::{Failure, answer, grouped, is_strict, note};
use crate::progress::Phase;
use crate::stats::Stats;
use field::{Sizes, between};
use kept::Kept;
use names::{Content, Target};
use naming::Naming;
use plan::{Plan, Written};
use quads::Cells;
use source::{Again, Material, Sources};

pub(crate) fn run(args: &MeshArgs, quiet: bool) -> Result<(), Failure> {
    if args.triangle.as_ref().is_some_and(|switches| switches.has('h')) {
        return answer(&triangle_table());
    }
    let quiet = quiet || args.triangle.as_ref().is_some_and(|switches| switches.has('Q'));
    let plan = Plan::of(args, quiet)?;
    let sources = Sources::of(args)?;
    let inputs = sources.paths(args);
    let mut targets = names::named(args, &plan, &inputs)?;
    if plan.traits.histogram && args.output.iter().any(|path| path == Path::new("-")) {
        return Err(Failure::usage(
            "the histogram and a mesh cannot both go to standard output",
            "leave --histogram out, or name a file",
        ));
    }
    let is_drawn = |content: &Content| matches!(content, Content::Mesh(Format::Png | Format::Svg));
    if plan.traits.quads.are_wanted() && targets.iter().any(|target| is_drawn(&target.1)) {
        note(quiet, "pictures show the triangles of quadrilaterals");
    }
    let by_triangle = args.triangle.as_ref().filter(|_| args.output.is_empty());
    if by_triangle.is_some() {
        names::input(args)?;
    }
    files::keep_attributes(Contents::Triangles);
    let mut stats = Stats::start();
    let sizes = match &args.size {
        Some(path) => Some(Sizes::read(path, &args.size_columns, quiet)?),
        None => None,
    };
    let material = sources.read(args, &plan, &mut stats, quiet)?;
    if let Some(switches) = by_triangle {
        targets = names::beside(args, switches, &inputs, &material)?;
    }
    let label = sources.input.label();
    let Material { mut graph, fill, again, .. } = material;
    let naming = Naming::of(args, &mut graph)?;
    let claims = Claims {
        lengths: args.size_by.clone(),
        areas: args.area_by.clone(),
        ..Claims::of(args.graph.overlaps)
    };
    let how = (fill, plan.traits.convex, &claims);
    let c = Constrained::of(graph, plan.crossings, how, &label, &mut stats, quiet)?;
    let layers = &args.layers.layers;
    if plan.min_angle > 0.0 && again.is_none() {
        tell::gap(&c.triangulation, &c.inside, quiet);
    }
    let made = Made::of(c, &plan, (fill, sizes.as_ref(), again), (naming, layers), &label, quiet)?;
    stats.phase("build");
    let (c, report) = (&made.triangulation, &made.refined.report);
    if plan.traits.check {
        let _phase = Phase::start(quiet, "checking");
        if let Some(flaw) = proof::flaw(c, &made.refined, &made.seeds, &plan) {
            return Err(Failure::new(
                format!("the mesh is wrong: {flaw}"),
                "please report this with the input: it is a bug",
            ));
        }
        stats.phase("check");
        note(quiet, "checked: constrained Delaunay, and all triangles are as wanted but those that are left");
    }
    if let Some(left) = tell::left(report).filter(|_| is_strict()) {
        return Err(Failure::new(left, "ask for less, or leave --strict out to write what there is"));
    }
    let cells = Cells::of(&made, plan.traits.quads, plan.smooth_quads)?;
    cells.tell_left(quiet);
    if report.triangles == 0 && c.triangle_count() > 0 {
        let why = if c.report().repeated > 0 {
            "no segments close, and borders that are there twice cancel"
        } else if made.graph.holes.is_empty() {
            "no segments close"
        } else {
            "no segments close, or holes take all"
        };
        note(quiet, format_args!("nothing is inside: {why}; see --fill and --convex"));
    }
    let mut kept = Kept::of(c, &made.refined.domains, plan.traits.drop_unused);
    kept.put_back(made.again.as_ref().map_or(&[], Again::apart));
    tell::count(report, kept.points.len(), &mut stats);
    if args.input.stats.is_some() || plan.edge.is_some() {
        tell::shapes(&Shapes2::of(c, &made.refined.domains), &mut stats);
    }
    cells.count(c, &mut stats);
    stats.set("hull", c.hull_facets().count());
    stats.set("vertices", kept.vertex_count());
    let angles = args.color == Some(ColorName::Angle);
    let options = picture::Options { angles, size: args.picture_size, ..picture::Options::default() };
    made.write((&kept, &cells), &plan, (&targets, &options), quiet)?;
    stats.phase("write");
    tell::summary(report, &stats, quiet);
    if plan.traits.histogram {
        answer(&tell::histogram(report))?;
    }
    stats.write(args.input.stats.as_deref())
}

/// A mesh, and what is written beside it.
struct Made {
    triangulation: Constrained2,
    refined: Refined2,
    graph: Graph,
    seeds: Seeds2,
    heights: Option<Vec<f64>>,
    attributes: Option<Attributes>,
    again: Option<Again>,
    /// The regions that polygons of the input are.
    of_polygons: Regions,
    naming: Naming,
    /// The middles of sides that are chords of arcs.
    arc_middles: Vec<Middle2>,
    /// How many such sides are to stay straight.
    straight: usize,
}

impl Made {
    /// Refines.
    fn of(
        from: Constrained,
        plan: &Plan,
        (fill, sizes, again): (FillName, Option<&Sizes>, Option<Again>),
        (naming, markers): (Naming, &[i64]),
        label: &Path,
        quiet: bool,
    ) -> Result<Self, Failure> {
        let Constrained { mut triangulation, mut graph, inside, regions: of_polygons, heights } = from;
        let regions = std::mem::take(&mut graph.regions);
        let seeds = if fill == FillName::Seeds {
            Seeds2::default().holes(graph.holes.clone()).regions(regions).keep_concavities(plan.traits.convex)
        } else {
            // Where everything is inside, so are bays.
            let keep_concavities = fill == FillName::All;
            Seeds2::default()
                .holes(seeds::holes(&triangulation, &inside, quiet))
                .regions(regions)
                .keep_concavities(keep_concavities)
        };
        let size = |p: [f64; 2]| sizes.map_or(f64::INFINITY, |sizes| sizes.at(p));
        let area = |p: [f64; 2]| again.as_ref().map_or(f64::INFINITY, |again| again.area(p));
        let mut wanted = plan.refinement().fill(Fill::Parts(&inside));
        if sizes.is_some() {
            wanted = if plan.edge.is_some() { wanted.edge_at(&size) } else { wanted.size(&size) };
        }
        if again.as_ref().is_some_and(Again::has_areas) {
            wanted = wanted.max_area_at(&area);
        }
        if let Some(again) = &again {
            wanted = wanted.triangles(again.kept());
        }
        let layers = layers::on_segments(plan.layers.as_ref(), markers, &triangulation, &graph)?;
        if let Some(layers) = &layers {
            wanted = wanted.layers(layers);
        }
        let arcs: Vec<_> = graph.arcs.iter().map(|&(s, center)| (SegmentId::new(s), center)).collect();
        wanted = wanted.arcs(&arcs);
        let width = graph.attributes.width;
        let has_values = heights.is_some() || width > 0;
        let before = has_values.then(|| triangulation.clone());
        let refined = {
            let phase = Phase::making(quiet, "refining", "new vertices");
            let watch = |count| phase.made(count);
            wanted.watch(&watch).run(&mut triangulation).map_err(|error| refused(label, &error))?
        };
        let _phase = Phase::start(quiet, "interpolating");
        let c = &triangulation;
        let spread = |width: usize, values: &[f64]| match &before {
            Some(before) => extended(c, width, values, |p| Some(at(before, p, width, values))).0,
            None => Vec::new(),
        };
        let heights = heights.map(|values| spread(1, &values));
        let attributes = (width > 0).then(|| {
            let first = before.as_ref().map_or_else(Vec::new, |before| {
                extended(before, width, &graph.attributes.values, |_| None).0
            });
            Attributes { width, values: spread(width, &first) }
        });
        let arc_middles =
            refined.arc_middles(&triangulation, &arcs).map_err(|error| refused(label, &error))?;
        let straight = sides_along(&triangulation, &refined, &arcs).saturating_sub(arc_middles.len());
        Ok(Self {
            triangulation,
            refined,
            graph,
            seeds,
            heights,
            attributes,
            again,
            of_polygons,
            naming,
            arc_middles,
            straight,
        })
    }

    /// Writes all files.
    fn write(
        &self,
        (kept, cells): (&Kept, &Cells),
        plan: &Plan,
        (targets, options): (&[Target], &picture::Options),
        quiet: bool,
    ) -> Result<(), Failure> {
        let (c, graph, domains) = (&self.triangulation, &self.graph, &self.refined.domains);
        let has_markers = match plan.markers {
            Written::AsGiven => graph.markers.is_some() || graph.point_markers.is_some(),
            Written::Always => true,
            Written::Never => false,
        };
        let markers = has_markers.then(|| markers::of(c, graph, domains));
        let mut edges: Vec<[VertexId; 2]> = Vec::new();
        let lines = features::of_lines(c, graph);
        let (mut edge_markers, mut edge_rows) = (Vec::new(), Vec::new());
        for (i, ([v, w], e)) in c.constraints().zip(c.constraint_edges()).enumerate() {
            if self.refined.only_keeps(c, e) {
                continue;
            }
            if let (Some(v), Some(w)) = (kept.name(v), kept.name(w)) {
                edges.push([v, w]);
                edge_markers.extend(markers.as_ref().map(|markers| markers.edges[i]));
                edge_rows.extend(lines.as_ref().map(|lines| lines[i]));
            }
        }
        let constraints = Constraints {
            edges: &edges,
            markers: has_markers.then_some(&edge_markers[..]),
            features: lines.is_some().then_some(Rows { table: &graph.cloud.features.table, of: &edge_rows }),
            holes: &self.seeds.holes,
            regions: &self.seeds.regions,
        };
        let points = markers.as_ref().map(|markers| kept.rows(1, &markers.points));
        let heights = self.heights.as_ref().map(|heights| kept.rows(1, heights));
        let attributes = self.attributes.as_ref().map(|attributes| Attributes {
            width: attributes.width,
            values: kept.rows(attributes.width, &attributes.values),
        });
        let regions = self.regions(plan);
        let mut rows = vec![None; c.slot_count()];
        c.triangle_ids()
            .for_each(|t| rows[c.index(t)] = domains.region(t).map(|region| self.of_polygons.row(region)));
        let features = Rows { table: &graph.cloud.features.table, of: &rows };
        let partners = cells.partners(c);
        let named = |&([v, w], middle): &Middle2| Some(([kept.name(v)?, kept.name(w)?], middle));
        let middles: Vec<Middle2> = self.arc_middles.iter().filter_map(named).collect();
        if plan.traits.second_order && self.straight > 0 {
            let count = grouped(self.straight as u64);
            note(
                quiet,
                format_args!("sides along arcs that stay straight, or elements would be inverted: {count}"),
            );
        }
        let mesh = Mesh {
            heights: heights.as_deref(),
            crs: graph.cloud.crs.as_ref(),
            base: plan.base.unwrap_or(graph.cloud.base),
            constraints: Some(&constraints),
            regions: regions.as_deref(),
            names: Some(&self.naming.names),
            features: (self.of_polygons.polygons > 0).then_some(features),
            attributes: attributes.as_ref(),
            point_markers: points.as_deref(),
            edge_markers: plan.markers != Written::Never,
            second_order: plan.traits.second_order,
            arc_middles: &middles,
            partners: partners.as_deref(),
            element: plan.element.as_deref(),
            ..Mesh::new(kept, &kept.points)
        };
        self.naming.check(&mesh.side_markers(), &mesh.region_numbers(), quiet);
        self.naming.tell(targets, quiet);
        let _phase = Phase::start(quiet, "writing");
        match cells {
            Cells::Parts(quads) => quads::write_parts((self, quads), &mesh, targets, options, quiet),
            _ => write_all(&mesh, targets, options, quiet),
        }
    }

    /// The region of each triangle, if regions are written.
    fn regions(&self, plan: &Plan) -> Option<Vec<f64>> {
        let (c, domains) = (&self.triangulation, &self.refined.domains);
        let again = self.again.as_ref().filter(|again| again.has_attributes());
        let has_names = !self.naming.names.regions().is_empty() && self.of_polygons.polygons > 0;
        let is_given =
            again.is_some() || !self.seeds.regions.is_empty() || self.of_polygons.polygons > 1 || has_names;
        let is_written = match plan.regions {
            Written::AsGiven => is_given,
            Written::Always => true,
            Written::Never => false,
        };
        let of = |t| match again {
            Some(again) => again.attribute(centroid(c.mesh().corners(t).map(|v| c.point(v)))),
            None if self.of_polygons.polygons > 0 => {
                self.naming.region(domains.attribute(t).unwrap_or_default())
            }
            None => domains.attribute(t).unwrap_or_default(),
        };
        is_written.then(|| {
            let mut regions = vec![0.0; c.slot_count()];
            c.triangle_ids().filter(|&t| domains.is_inside(t)).for_each(|t| regions[c.index(t)] = of(t));
            regions
        })
    }
}

/// The number of sides of triangles inside along arcs.
fn sides_along(c: &Constrained2, refined: &Refined2, arcs: &[(SegmentId, [f64; 2])]) -> usize {
    let chains = arcs.iter().filter_map(|&(s, _)| c.chain(s));
    let ends = chains.flat_map(|chain| chain.windows(2).map(|w| [w[0], w[1]]).collect::<Vec<_>>());
    let beside = |&[v, w]: &[VertexId; 2]| {
        let e = c.mesh().star(v).find(|&e| c.mesh().destination(e) == w);
        let inside = |e: EdgeId| refined.domains.is_inside(e.triangle());
        e.is_some_and(|e| inside(e) || inside(c.mesh().twin(e)))
    };
    let sides: BTreeSet<[VertexId; 2]> = ends.filter(beside).map(|[v, w]| [v.min(w), v.max(w)]).collect();
    sides.len()
}

/// Writes all files.
fn write_all<T: Triangulation<Point = [f64; 2]>>(
    mesh: &Mesh<T>,
    targets: &[Target],
    options: &picture::Options,
    quiet: bool,
) -> Result<(), Failure> {
    for (path, content) in targets {
        files::write_mesh(path, quiet, |out| match content {
            // Its faces have corners alone.
            Content::Mesh(format @ Format::Off) => {
                write_mesh(out, *format, &Mesh { second_order: false, ..*mesh }, &files::drawn(options))
            }
            // Pictures show triangles.
            Content::Mesh(format @ (Format::Png | Format::Svg)) => {
                write_mesh(out, *format, &Mesh { partners: None, ..*mesh }, &files::drawn(options))
            }
            Content::Mesh(format) => write_mesh(out, *format, mesh, &files::drawn(options)),
            Content::VoronoiNode => write_voronoi_node(out, mesh).map(|()| None),
            Content::VoronoiEdge => write_voronoi_edge(out, mesh).map(|()| None),
        })?;
    }
    Ok(())
}

/// The failure of a refusal by the library.
fn refused(label: &Path, error: &Error) -> Failure {
    match error {
        Error::Size { .. } => Failure::new(error, "sizes and areas are positive wherever they are asked for"),
        Error::Parameter { name, value, .. } => Failure::new(
            format!("{} is {value}: more than 2^30 triangles would be needed", name.replace('_', "-")),
            "ask for larger ones, or bound the new vertices with --max-vertices (S in Triangle's switches)",
        ),
        _ => Failure::graph(label, error),
    }
}

/// The values at a place of a triangulation, linear in each triangle.
fn at(c: &Constrained2, p: [f64; 2], width: usize, values: &[f64]) -> Vec<f64> {
    let value = |v: VertexId, k: usize| values[v.index() * width + k];
    let mesh = c.mesh();
    let each = |of: &dyn Fn(usize) -> f64| (0..width).map(of).collect();
    match c.locate(p) {
        Ok(Location2::Triangle(t)) => {
            let corners = mesh.corners(t);
            let places = corners.map(|v| c.point(v));
            each(&|k| between(p, places, corners.map(|v| value(v, k))))
        }
        Ok(Location2::Edge(e) | Location2::Outside(e)) => {
            let ends = [mesh.origin(e), mesh.destination(e)];
            let places = ends.map(|v| c.point(v));
            each(&|k| along(p, places, ends.map(|v| value(v, k))))
        }
        Ok(Location2::Vertex(v)) => each(&|k| value(v, k)),
        _ => each(&|_| 0.0),
    }
}

/// The middle of a triangle.
fn centroid(corners: [[f64; 2]; 3]) -> [f64; 2] {
    [0, 1].map(|k| corners.iter().map(|p| p[k] / 3.0).sum())
}
