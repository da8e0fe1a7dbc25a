//! `delone furthest`: for each query the vertex furthest from it.

use delone::Delaunay2;
use delone_io::{Format, Found};
use serde_json::json;

use crate::args::FurthestArgs;
use crate::files;
use crate::message::Failure;
use crate::progress::Phase;
use crate::queries::{self, answer_format};
use crate::room::{self, Room, build, remark};
use crate::stats::Stats;

pub(crate) fn run(args: &FurthestArgs, quiet: bool) -> Result<(), Failure> {
    let stats_path = args.input.stats.as_deref();
    let outputs = std::iter::once(args.output.as_path()).chain(stats_path);
    files::keep_apart(&args.input.paths_and(&args.queries), outputs)?;
    let format = answer_format(&args.output, args.to)?;
    let mut stats = Stats::start();
    let (input, dimensions) = files::attributes_apart(&args.input, &args.queries);
    let (points, _) = room::read::<Delaunay2>(&input, quiet)?;
    let (queries, about) = room::queries_with::<Delaunay2>(&args.queries, dimensions, quiet)?;
    stats.phase("read");
    let triangulation: Delaunay2 = build(&points, Delaunay2::FASTEST, &args.input.label(), quiet)?;
    remark(&triangulation, quiet);
    let furthest = triangulation.furthest();
    stats.phase("build");
    let mut answers = Vec::with_capacity(queries.len());
    {
        let _phase = Phase::start(quiet, "asking");
        for (index, &q) in queries.iter().enumerate() {
            let found = furthest.furthest(q).map_err(|error| {
                Failure::new(
                    format!("{}: query {index}: {error}", args.queries.display()),
                    "remove that query or repair its coordinates: every finite number is accepted",
                )
            })?;
            answers.push(found.map_or(-1, |v| v.index() as i64));
        }
    }
    stats.phase("query");
    stats.triangulation(&triangulation, triangulation.counters());
    stats.set("queries", queries.len());
    let circle = furthest.enclosing_circle().map(|circle| {
        let support: Vec<usize> = circle.support.iter().map(|v| v.index()).collect();
        json!({ "center": circle.center, "radius": circle.radius, "support": support })
    });
    stats.set("enclosing_circle", circle);
    if format == Format::Npy {
        files::write(&args.output, |out| delone_io::write_index_list(out, format, &answers))?;
    } else {
        let names = ["furthest".to_owned()];
        queries::write(&args.output, format, &queries, &about, (&names, Found::Indices(&answers)))?;
    }
    stats.phase("write");
    stats.tell(quiet, ["triangle", "triangles"]);
    stats.write(stats_path)
}
