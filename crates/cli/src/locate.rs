//! `delone locate`: for each query the triangle that contains it. Also what it has in common with `nearest`.

use delone::{Algorithm2, Ask, Delaunay2, Locate, Location2, TriangleId, Work};

use crate::args::{InputArgs, LocateArgs, QueryArgs};
use crate::message::Failure;
use crate::progress::Phase;
use crate::stats::{Stats, work_done};
use crate::triangulate::{build, remark};
use crate::{files, space};

pub(crate) fn run(args: &LocateArgs, quiet: bool) -> Result<(), Failure> {
    if args.dim.is_space() {
        return space::locate(&args.input, &args.query, quiet);
    }
    let mut work = Work::default();
    answer(&args.input, &args.query, 3, quiet, |triangulation, q, row| {
        let location = triangulation.find_observed(q, &mut work)?;
        let corners = triangle(triangulation, location).map_or([-1; 3], |t| t.map(|i| i as i64));
        row.extend(corners);
        Ok(work)
    })
}

/// Asks the same question for every query and writes a row of indices for each.
pub(crate) fn answer(
    input: &InputArgs,
    query: &QueryArgs,
    columns: usize,
    quiet: bool,
    mut ask: impl FnMut(&Delaunay2, [f64; 2], &mut Vec<i64>) -> Result<Work, delone::Error>,
) -> Result<(), Failure> {
    let strategy = strategy(query)?;
    let format = files::index_format(&query.output, query.to)?;
    files::keep_apart(
        &input.paths_and(&query.queries),
        std::iter::once(query.output.as_path()).chain(input.stats.as_deref()),
    )?;
    let mut stats = Stats::start();
    let cloud = files::points(input, 2, quiet)?;
    let queries = files::queries(&query.queries, quiet)?;
    stats.phase("read");
    let mut triangulation = build(cloud.xy, Algorithm2::default(), &input.label(), quiet)?;
    triangulation.set_strategy(strategy).map_err(|error| Failure::usage(error, "see delone --help"))?;
    stats.phase("build");
    remark(&triangulation, quiet);
    let mut rows = Vec::with_capacity(columns * queries.len());
    let mut work = Work::default();
    {
        let _phase = Phase::start(quiet, "locating");
        for (index, &q) in queries.iter().enumerate() {
            work = ask(&triangulation, q, &mut rows).map_err(|error| {
                Failure::new(
                    format!("{}: query {index}: {error}", query.queries.display()),
                    "remove that query or repair its coordinates: every finite number is accepted",
                )
            })?;
        }
    }
    stats.phase("query");
    stats.triangulation(&triangulation);
    stats.set("queries", queries.len());
    stats.set("counters", work_done(&work));
    files::write(&query.output, |out| delone_io::write_indices(out, format, columns, &rows))?;
    stats.phase("write");
    stats.tell(quiet, ["triangle", "triangles"]);
    stats.write(input.stats.as_deref())
}

pub(crate) fn strategy(query: &QueryArgs) -> Result<Locate, Failure> {
    query.locate.strategy(query.seed).ok_or_else(|| {
        Failure::usage(
            "that strategy is for building in bulk, not for queries",
            "choose --locate tree, walk, jump-and-walk, hierarchy or history",
        )
    })
}

/// The corners of a triangle that contains a point, the same ones whatever found it: from the smallest index on,
/// and of several triangles the first.
fn triangle(triangulation: &Delaunay2, location: Location2) -> Option<[usize; 3]> {
    let mesh = triangulation.mesh();
    let around: Vec<TriangleId> = match location {
        Location2::Triangle(t) => vec![t],
        Location2::Edge(e) => vec![e.triangle(), mesh.twin(e).triangle()],
        Location2::Vertex(v) => mesh.star(v).map(|e| e.triangle()).collect(),
        Location2::Outside(_) | Location2::LowerDimensional(_) => Vec::new(),
    };
    let corners = |t: TriangleId| {
        let mut corners = mesh.corners(t).map(delone::VertexId::index);
        let least = (0..3).min_by_key(|&k| corners[k]).unwrap_or(0);
        corners.rotate_left(least);
        corners
    };
    around.into_iter().filter(|&t| !mesh.is_ghost(t)).map(corners).min()
}
