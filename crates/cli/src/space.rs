//! What commands do with `--dim 3`: triangulate, draw, locate, find the nearest, describe, judge.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use delone::space::verify::{Objection3, verify};
use delone::{Algorithm3, Ask, Delaunay3, Dimension, Location3, TetrahedronId, VertexId, Work};
use delone_io::{Body, Cloud, Cut, Format, picture};
use delone_predicates::in_sphere_with_ties;

use crate::args::{
    AlgorithmName, CheckArgs, DrawArgs, InfoArgs, InputArgs, LocateName, QueryArgs, TriangulateArgs,
};
use crate::files;
use crate::locate::strategy;
use crate::message::{Failure, answer, note};
use crate::progress::Phase;
use crate::stats::{Stats, work_done};

/// `delone triangulate --dim 3`.
pub(crate) fn triangulate(args: &TriangulateArgs, quiet: bool) -> Result<(), Failure> {
    if args.max_edge.is_some() {
        return Err(Failure::usage("--max-edge is for the plane", "leave it or --dim 3 out"));
    }
    if args.algorithm == Some(AlgorithmName::DivideConquer) {
        return Err(Failure::usage(
            "divide and conquer is for the plane",
            "leave --algorithm out: in space points are inserted one by one in spatial order",
        ));
    }
    let locate = args.locate.unwrap_or(LocateName::Spatial);
    let algorithm = match (locate, locate.strategy(args.seed)) {
        (LocateName::Spatial, _) => Algorithm3::Spatial { seed: args.seed },
        (LocateName::Conflict | LocateName::History, _) | (_, None) => {
            return Err(Failure::usage(
                "location by history and by conflict lists is for the plane",
                "choose --locate spatial, tree, walk, jump-and-walk or hierarchy",
            ));
        }
        (_, Some(locate)) => Algorithm3::Located { locate, seed: args.seed },
    };
    let stats_path = args.input.stats.as_deref();
    let outputs = files::outputs(&args.output, args.to, stats_path, &args.input.paths())?;
    check_formats(&outputs)?;
    let mut stats = Stats::start();
    let (points, about) = files::points_in_space(&args.input, quiet)?;
    stats.phase("read");
    let d = build(&points, algorithm, &args.input.label(), quiet)?;
    stats.phase("build");
    stats.set("algorithm", "incremental");
    stats.set("locate", locate.to_possible_value().map(|value| value.get_name().to_owned()));
    finish(args, &outputs, &d, &points, &about, &mut stats, quiet)?;
    stats.write(stats_path)
}

/// Refuses formats that hold neither tetrahedra nor their hull.
pub(crate) fn check_formats(outputs: &[(PathBuf, Format)]) -> Result<(), Failure> {
    match outputs.iter().find(|(_, format)| !holds_bodies(*format)) {
        Some((path, format)) => Err(Failure::file(path, &delone_io::Error::NotABody(*format))),
        None => Ok(()),
    }
}

/// Remarks, checks, counts and writes.
pub(crate) fn finish(
    args: &TriangulateArgs,
    outputs: &[(PathBuf, Format)],
    d: &Delaunay3,
    points: &[[f64; 3]],
    about: &Cloud,
    stats: &mut Stats,
    quiet: bool,
) -> Result<(), Failure> {
    stats.set("threads", 1);
    remark(d, points.len(), quiet);
    if args.check {
        let _phase = Phase::start(quiet, "checking");
        d.check().map_err(|flaw| {
            Failure::new(
                format!("the triangulation is wrong: {flaw}"),
                "please report this with the input: it is a bug",
            )
        })?;
        stats.phase("check");
        note(quiet, "checked: this is the canonical Delaunay triangulation");
    }
    stats.space(d, points.len());
    let body = Body { triangulation: d, points, crs: about.crs.as_ref(), base: about.base };
    let phase = Phase::start(quiet, "writing");
    for (path, format) in outputs {
        files::write_mesh(path, quiet, |out| {
            delone_io::write_body(out, *format, &body, &picture::Camera::default())
        })?;
    }
    drop(phase);
    stats.phase("write");
    stats.tell(quiet, ["tetrahedron", "tetrahedra"]);
    Ok(())
}

/// Whether a triangulation of space, or its hull, can be written in a format.
pub(crate) fn holds_bodies(format: Format) -> bool {
    use Format::{Ele, Neigh, Node, Npy, Obj, Ply, Png, Stl, Svg, Vtu};
    matches!(format, Npy | Ele | Neigh | Node | Vtu | Ply | Obj | Stl | Svg | Png)
}

/// Triangulates, with progress.
fn build(
    points: &[[f64; 3]],
    algorithm: Algorithm3,
    input: &Path,
    quiet: bool,
) -> Result<Delaunay3, Failure> {
    let _phase = Phase::start(quiet, "triangulating");
    Delaunay3::with_algorithm(points, algorithm).map_err(|error| Failure::points(input, &error))
}

/// Notes on what might surprise.
fn remark(d: &Delaunay3, points: usize, quiet: bool) {
    let duplicates = d.duplicates().count();
    if duplicates > 0 {
        note(quiet, format_args!("{duplicates} of {points} points equal earlier ones and are no vertices"));
    }
    let what = match d.dimension() {
        Dimension::Empty => "there are no points",
        Dimension::Point => "there is only one distinct point",
        Dimension::Line => "all points are on one line",
        Dimension::Plane => "all points are in one plane",
        Dimension::Space => return,
    };
    note(quiet, format_args!("{what}, so there are no tetrahedra"));
}

/// `delone draw --dim 3`.
pub(crate) fn draw(args: &DrawArgs, outputs: &[(PathBuf, Format)], quiet: bool) -> Result<(), Failure> {
    let mut camera = args.camera.camera()?;
    camera.wireframe = args.wireframe;
    let cut = match args.cut[..] {
        [] => None,
        [a, b, c, offset] if args.cut.iter().all(|x| x.is_finite()) => {
            Some(Cut { normal: [a, b, c], offset })
        }
        _ => {
            return Err(Failure::usage(
                "--cut takes four numbers",
                "as in --cut 1,0,0,0.5: what has x above 0.5 is taken away",
            ));
        }
    };
    let mut stats = Stats::start();
    let (points, _) = files::points_in_space(&args.input, quiet)?;
    stats.phase("read");
    let d = build(&points, Algorithm3::Spatial { seed: 0 }, &args.input.label(), quiet)?;
    remark(&d, points.len(), quiet);
    stats.phase("build");
    stats.space(&d, points.len());
    let _phase = Phase::start(quiet, "drawing");
    let body = Body { triangulation: &d, points: &points, crs: None, base: 0 };
    let solid = cut.map_or_else(|| body.hull(), |cut| body.cut(&cut));
    for (path, format) in outputs {
        files::write(path, |out| delone_io::write_solid(out, *format, &solid, &camera))?;
    }
    stats.phase("write");
    stats.tell(quiet, ["tetrahedron", "tetrahedra"]);
    stats.write(args.input.stats.as_deref())
}

/// `delone locate --dim 3`.
pub(crate) fn locate(input: &InputArgs, query: &QueryArgs, quiet: bool) -> Result<(), Failure> {
    let mut work = Work::default();
    ask(input, query, 4, quiet, |d, q, row| {
        let location = d.find_observed(q, &mut work)?;
        row.extend(tetrahedron(d, location).map_or([-1; 4], |t| t.map(|i| i as i64)));
        Ok(work)
    })
}

/// `delone nearest --dim 3`.
pub(crate) fn nearest(input: &InputArgs, query: &QueryArgs, k: usize, quiet: bool) -> Result<(), Failure> {
    let mut work = Work::default();
    ask(input, query, k, quiet, |d, q, row| {
        let end = row.len() + k;
        if k == 1 {
            row.extend(d.nearest_observed(q, &mut work)?.map(|v| v.index() as i64));
        } else {
            row.extend(d.k_nearest(q, k)?.iter().map(|v| v.index() as i64));
        }
        row.resize(end, -1);
        Ok(work)
    })
}

/// Asks the same question for every query and writes a row of indices for each.
fn ask(
    input: &InputArgs,
    query: &QueryArgs,
    columns: usize,
    quiet: bool,
    mut ask: impl FnMut(&Delaunay3, [f64; 3], &mut Vec<i64>) -> Result<Work, delone::Error>,
) -> Result<(), Failure> {
    let strategy = strategy(query)?;
    let format = files::index_format(&query.output, query.to)?;
    files::keep_apart(
        &input.paths_and(&query.queries),
        std::iter::once(query.output.as_path()).chain(input.stats.as_deref()),
    )?;
    let mut stats = Stats::start();
    let (points, _) = files::points_in_space(input, quiet)?;
    let queries = files::queries_in_space(&query.queries, quiet)?;
    stats.phase("read");
    let mut d = build(&points, Algorithm3::Spatial { seed: 0 }, &input.label(), quiet)?;
    d.set_strategy(strategy).map_err(|error| Failure::usage(error, "see delone --help"))?;
    stats.phase("build");
    remark(&d, points.len(), quiet);
    let mut rows = Vec::with_capacity(columns * queries.len());
    let mut work = Work::default();
    {
        let _phase = Phase::start(quiet, "locating");
        for (index, &q) in queries.iter().enumerate() {
            work = ask(&d, q, &mut rows).map_err(|error| {
                Failure::new(
                    format!("{}: query {index}: {error}", query.queries.display()),
                    "remove that query or repair its coordinates: every finite number is accepted",
                )
            })?;
        }
    }
    stats.phase("query");
    stats.space(&d, points.len());
    stats.set("queries", queries.len());
    stats.set("counters", work_done(&work));
    files::write(&query.output, |out| delone_io::write_indices(out, format, columns, &rows))?;
    stats.phase("write");
    stats.tell(quiet, ["tetrahedron", "tetrahedra"]);
    stats.write(input.stats.as_deref())
}

/// The corners of a tetrahedron that contains a point, the same ones whatever found it: of several the first.
fn tetrahedron(d: &Delaunay3, location: Location3) -> Option<[usize; 4]> {
    let mesh = d.mesh();
    let around: Vec<TetrahedronId> = match location {
        Location3::Tetrahedron(t) => vec![t],
        Location3::Facet(f) => vec![f.tetrahedron(), mesh.twin(f).tetrahedron()],
        Location3::Edge([v, w]) => {
            d.tetrahedra_at(v).into_iter().filter(|&t| mesh.corners(t).contains(&w)).collect()
        }
        Location3::Vertex(v) => d.tetrahedra_at(v),
        Location3::Outside(_) | Location3::LowerDimensional(_) => Vec::new(),
    };
    let finite = around.into_iter().filter(|&t| d.dimension() == Dimension::Space && !mesh.is_ghost(t));
    finite.map(|t| positive(mesh.corners(t).map(VertexId::index))).min()
}

/// The even permutation that starts with the smallest corner, followed by the smallest of the others.
pub(crate) fn positive(mut corners: [usize; 4]) -> [usize; 4] {
    // Two swaps keep the order positive.
    let least = (0..4).min_by_key(|&k| corners[k]).unwrap_or(0);
    if least > 0 {
        corners.swap(0, least);
        let [i, j] = [[2, 3], [1, 3], [1, 2]][least - 1];
        corners.swap(i, j);
    }
    let turn = (1..4).min_by_key(|&k| corners[k]).unwrap_or(1) - 1;
    corners[1..].rotate_left(turn);
    corners
}

/// `delone info --dim 3`.
pub(crate) fn info(args: &InfoArgs, quiet: bool) -> Result<(), Failure> {
    files::keep_apart(&args.input.paths(), args.input.stats.as_deref())?;
    let mut stats = Stats::start();
    let (points, about) = files::points_in_space(&args.input, quiet)?;
    stats.phase("read");
    let d = build(&points, Algorithm3::Spatial { seed: 0 }, &args.input.label(), quiet)?;
    stats.phase("build");
    stats.space(&d, points.len());
    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:22} {value}\n");
    line("points", points.len().to_string());
    line("duplicates", d.duplicates().count().to_string());
    let span = match d.dimension() {
        Dimension::Empty => "nothing: there is no point",
        Dimension::Point => "a point",
        Dimension::Line => "a line: all points are collinear",
        Dimension::Plane => "a plane: all points are coplanar",
        Dimension::Space => "space",
    };
    line("they span", span.to_owned());
    for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
        if let Some(range) = crate::info::range(points.iter().map(|p| p[k])) {
            line(axis, range);
        }
    }
    crate::info::file(&about, &mut line, &mut stats);
    if d.dimension() == Dimension::Space {
        let mesh = d.mesh();
        let ties = d
            .cells()
            .flat_map(|t| [0, 1, 2, 3].map(|k| t.facet(k)))
            .filter(|&f| {
                let g = mesh.twin(f);
                let [a, b, c, e] = mesh.corners(f.tetrahedron());
                let across = mesh.corners(g.tetrahedron())[g.corner()];
                let [a, b, c, e] = [a, b, c, e].map(|v| d.point(v));
                f < g
                    && !mesh.is_ghost(g.tetrahedron())
                    && in_sphere_with_ties(a, b, c, e, d.point(across)).is_zero()
            })
            .count();
        line("tetrahedra", d.tetrahedron_ids().count().to_string());
        line("edges", d.edges().count().to_string());
        line("hull facets", d.hull_facets().count().to_string());
        line("cospherical neighbours", format!("{ties} pairs of tetrahedra"));
        stats.set("cospherical_pairs", ties);
    }
    stats.phase("count");
    stats.write(args.input.stats.as_deref())?;
    answer(&text)
}

/// `delone check --dim 3`.
pub(crate) fn check(args: &CheckArgs, quiet: bool) -> Result<(), Failure> {
    let mut stats = Stats::start();
    let (points, _) = files::points_in_space(&args.input, quiet)?;
    let tetrahedra = files::tetrahedra(&args.mesh, quiet)?;
    stats.phase("read");
    let verdict = {
        let _phase = Phase::start(quiet, "checking");
        verify(&points, &tetrahedra)
    };
    stats.phase("check");
    stats.set("points", points.len());
    stats.set("simplices", tetrahedra.len());
    stats.set("delaunay", verdict.is_ok());
    stats.set("canonical", verdict.is_ok_and(|verdict| verdict.is_canonical()));
    if let Ok(verdict) = verdict {
        stats.set("duplicates", verdict.duplicates);
        stats.set("hull", verdict.hull);
        stats.set("negative", verdict.negative);
        stats.set("other_ties", verdict.other_ties);
    }
    stats.write(args.input.stats.as_deref())?;
    let verdict = match verdict {
        Ok(verdict) => verdict,
        Err(Objection3::Points(error)) => return Err(Failure::points(&args.input.label(), &error)),
        Err(objection) => {
            return Err(Failure::new(
                format!("{}: not Delaunay: {objection}", args.mesh.display()),
                "tetrahedra and points are counted from 0",
            ));
        }
    };
    let count = tetrahedra.len();
    answer(&if verdict.is_canonical() {
        format!("Delaunay, and the canonical triangulation: {count} tetrahedra\n")
    } else {
        let others = verdict.other_ties;
        format!(
            "Delaunay, not the canonical triangulation: {others} ties between neighbours are broken in another way; {count} tetrahedra\n"
        )
    })?;
    if verdict.negative > 0 {
        note(quiet, format_args!("{} tetrahedra are in negative order", verdict.negative));
    }
    Ok(())
}
