//! `delone simplify`: many points with heights in, a mesh of few of them out.

use std::path::Path;

use delone::Delaunay2;
use delone::surface::{Thinned, Thinning};
use delone_io::{Cloud, Graph, Raster, picture, write_mesh};

use crate::args::{CrossingsName, GraphArgs, SimplifyArgs};
use crate::constrained::regions::Claims;
use crate::constrained::{self, Constrained};
use crate::files;
use crate::message::{Failure, grouped, say};
use crate::progress::Phase;
use crate::room::{self, Room};
use crate::stats::Stats;

pub(crate) fn run(args: &SimplifyArgs, quiet: bool) -> Result<(), Failure> {
    let stats_path = args.input.stats.as_deref();
    let mut inputs = args.input.paths();
    inputs.extend(args.segments.as_deref());
    let written = args.output.iter().chain(&args.kept).map(std::path::PathBuf::as_path);
    files::keep_apart(&inputs, written.chain(stats_path))?;
    let outputs = args.wkt.of(files::outputs(&args.output, args.to, stats_path, &inputs)?)?;
    room::check_formats::<Delaunay2>(&outputs)?;
    let kept_format = args.kept.as_ref().map(|path| files::index_format(path, None)).transpose()?;
    let how = how(args)?;
    let mut stats = Stats::start();
    let given = Given::read(args, quiet)?;
    stats.phase("read");
    let phase = Phase::start(quiet, "thinning");
    let (mut graph, thinned) = given.thin(&how, &args.input.label())?;
    drop(phase);
    stats.phase("thin");
    let (count, error) = (graph.cloud.xy.len(), thinned.error);
    let mut kept = thinned.vertices;
    kept.sort_unstable();
    leave(&mut graph, &kept);
    stats.set("input_points", count);
    stats.set("kept", kept.len());
    stats.set("error", error);
    say(
        quiet,
        format_args!(
            "{} of {} points are left; none is further away than {error}",
            grouped(kept.len() as u64),
            grouped(count as u64)
        ),
    );
    if let (Some(path), Some(format)) = (&args.kept, kept_format) {
        let kept: Vec<i64> = kept.iter().map(|&i| i as i64).collect();
        files::write(path, |out| delone_io::write_index_list(out, format, &kept))?;
    }
    let options = picture::Options::default();
    if graph.segments.is_empty() {
        let about = &graph.cloud;
        let d: Delaunay2 = room::build(&about.xy, Delaunay2::FASTEST, &args.input.label(), quiet)?;
        room::remark(&d, quiet);
        stats.phase("build");
        stats.triangulation(&d, d.counters());
        let trim = room::trim_border(&d, &args.edges.border(), &mut stats, quiet);
        let mesh = room::mesh(&d, &about.xy, about, trim.as_ref());
        let _phase = Phase::start(quiet, "writing");
        for (path, format) in &outputs {
            files::write_mesh(path, quiet, |out| write_mesh(out, *format, &mesh, &files::drawn(&options)))?;
        }
        stats.phase("write");
    } else {
        let claims = Claims::default();
        let fill = (constrained::usual(&args.input, &graph), false, &claims);
        let label = args.input.label();
        let c = Constrained::of(graph, CrossingsName::Refuse, fill, &label, &mut stats, quiet)?;
        c.write(&outputs, &args.edges.border(), &options, &mut stats, quiet)?;
    }
    stats.tell(quiet, Delaunay2::WORDS.simplex);
    stats.write(stats_path)
}

/// How far to go.
fn how(args: &SimplifyArgs) -> Result<Thinning, Failure> {
    if args.max_error.is_some_and(|error| error.is_nan() || error < 0.0) {
        return Err(Failure::usage(
            "--max-error takes a height",
            "as in --max-error 0.2, in the units of heights",
        ));
    }
    let how = Thinning::new().max_error(args.max_error.unwrap_or(0.0));
    Ok(args.points.map_or(how, |points| how.max_points(points)))
}

/// The input of thinning.
enum Given {
    Raster(Raster),
    Points(Box<Graph>),
}

impl Given {
    fn read(args: &SimplifyArgs, quiet: bool) -> Result<Self, Failure> {
        let segments = GraphArgs { segments: args.segments.clone(), ..GraphArgs::default() };
        if constrained::is_meant(&args.input, &segments) {
            let mut graph = files::graph(&args.input, args.segments.as_deref(), quiet)?;
            files::need_heights(graph.cloud.z.as_deref(), &args.input.label())?;
            if let Some(heights) = &mut graph.cloud.z {
                args.duplicates.rule().settle_equal(&graph.cloud.xy, heights);
            }
            return Ok(Self::Points(Box::new(graph)));
        }
        if let Some(raster) = files::raster(&args.input, quiet)? {
            return Ok(Self::Raster(raster));
        }
        let (xy, mut z, about) = files::surface(&args.input, quiet)?;
        args.duplicates.rule().settle_equal(&xy, &mut z);
        Ok(Self::Points(Box::new(Graph::of_points(Cloud { xy, z: Some(z), ..about }))))
    }

    /// The points with what was chosen of them.
    fn thin(self, how: &Thinning, label: &Path) -> Result<(Graph, Thinned), Failure> {
        match self {
            Self::Points(graph) => {
                let heights = graph.cloud.z.as_deref().unwrap_or_default();
                let thinned = how.points(&graph.cloud.xy, heights, &graph.segments);
                let thinned = thinned.map_err(|error| Failure::graph(label, &error))?;
                Ok((*graph, thinned))
            }
            Self::Raster(raster) => {
                let thinned = how.raster(&raster.grid, &raster.values);
                let mut thinned = thinned.map_err(|error| Failure::points(label, &error))?;
                // Cells without data are no points.
                let number = |count: &mut usize, z: &f64| {
                    *count += usize::from(!z.is_nan());
                    Some(*count)
                };
                let numbers: Vec<usize> = raster.values.iter().scan(0, number).collect();
                thinned.vertices.iter_mut().for_each(|v| *v = numbers[*v] - 1);
                Ok((Graph::of_points(raster.into_points()), thinned))
            }
        }
    }
}

/// Leaves some of the points of a graph, among them all ends of segments, which are increasing.
fn leave(graph: &mut Graph, kept: &[usize]) {
    let cloud = &mut graph.cloud;
    let place = |i: usize| kept.partition_point(|&k| k < i);
    // An end at the place of an earlier point is that point.
    let ends: Vec<usize> = graph.segments.as_flattened().to_vec();
    let missing = ends.iter().any(|end| kept.binary_search(end).is_err());
    if missing {
        let mut at: Vec<usize> = kept.to_vec();
        let key = |i: usize| cloud.xy[i].map(|x| (x + 0.0).to_bits());
        at.sort_unstable_by_key(|&i| key(i));
        for end in graph.segments.as_flattened_mut() {
            if let Ok(found) = at.binary_search_by_key(&key(*end), |&i| key(i)) {
                *end = at[found];
            }
        }
    }
    graph.segments.as_flattened_mut().iter_mut().for_each(|end| *end = place(*end));
    cloud.xy = kept.iter().map(|&i| cloud.xy[i]).collect();
    cloud.z = cloud.z.as_ref().map(|z| kept.iter().map(|&i| z[i]).collect());
    graph.point_markers = None;
    graph.attributes = delone_io::Attributes::default();
}
