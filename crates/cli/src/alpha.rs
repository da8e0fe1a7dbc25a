//! `delone alpha`: shapes of points at a radius, and the radii at which all faces come.

use std::path::{Path, PathBuf};

use delone::{Alpha, Delaunay2, Delaunay3, Manifold3, VertexId};
use delone_io::{
    Cloud, Contents, Direction, Format, Graph, GraphRing, Patches, Solid, picture, write_filtration,
    write_graph, write_indices, write_patches, write_solid,
};

use crate::args::{AlphaArgs, IN_SPACE, IN_THE_PLANE};
use crate::files;
use crate::message::Failure;
use crate::progress::Phase;
use crate::room::{self, Room};
use crate::stats::Stats;
use crate::weighted::Weighted;

pub(crate) fn run(args: &AlphaArgs, quiet: bool) -> Result<(), Failure> {
    let stats_path = args.input.stats.as_deref();
    let inputs: Vec<&Path> = args.input.paths().into_iter().chain(args.weights.file()).collect();
    let all = args.output.iter().chain(&args.filtration).map(PathBuf::as_path).chain(stats_path);
    files::keep_apart(&inputs, all)?;
    let outputs = args.wkt.of(files::outputs(&args.output, args.to, stats_path, &inputs)?)?;
    check(args, &outputs)?;
    let mut stats = Stats::start();
    if args.dim.is_space() {
        let camera = args.camera.camera()?;
        let options = picture::Options { size: args.camera.size, camera, ..picture::Options::default() };
        let (alpha, points, _) =
            complexes(args, &mut stats, quiet, Delaunay3::alpha, delone::Regular3::alpha)?;
        let value = value(args, &alpha, &mut stats)?;
        let surface = Surface::of(&alpha, value.unwrap_or(f64::NAN), args.manifold);
        stats.set("facets", surface.faces.len());
        stats.phase("outline");
        write_surface(&alpha, &surface, points, &outputs, &options, quiet)?;
    } else {
        let (alpha, points, about) =
            complexes(args, &mut stats, quiet, Delaunay2::alpha, delone::Regular2::alpha)?;
        let value = value(args, &alpha, &mut stats)?;
        let value = value.unwrap_or(f64::NAN);
        write_outline(&alpha, value, (points, about), &outputs, args.camera.size, quiet)?;
    }
    stats.phase("write");
    let words = if args.dim.is_space() { Delaunay3::WORDS } else { Delaunay2::WORDS };
    stats.tell(quiet, words.simplex);
    stats.write(stats_path)
}

/// Refuses outputs that say nothing, or that formats cannot hold.
fn check(args: &AlphaArgs, outputs: &[(PathBuf, Format)]) -> Result<(), Failure> {
    if outputs.is_empty() && args.filtration.is_none() {
        return Err(Failure::usage("there is nothing to write", "name an output with -o or --filtration"));
    }
    if args.manifold && !args.dim.is_space() {
        return Err(Failure::usage(
            "outlines in the plane are no surfaces",
            "leave --manifold out, or give --dim 3",
        ));
    }
    let is_chosen = args.alpha.is_some() || args.radius.is_some() || args.optimal.is_some();
    if !outputs.is_empty() && !is_chosen {
        return Err(Failure::usage(
            "the radius of the shape is not known",
            "give --alpha, --radius or --optimal; without a shape leave -o out",
        ));
    }
    if let Some(path) = &args.filtration {
        let format = files::format_beside(path)?;
        files::check_formats(&[(path.clone(), format)], &[Contents::Filtrations])?;
    }
    files::check_formats(outputs, if args.dim.is_space() { IN_SPACE } else { IN_THE_PLANE })
}

/// The complexes of the points, with weights or without, written if that is asked for; and the points, all of which have their places
/// there, those that are no vertices too.
fn complexes<R: Room, const D: usize>(
    args: &AlphaArgs,
    stats: &mut Stats,
    quiet: bool,
    plain: impl Fn(&R) -> Alpha<D>,
    weighted: impl Fn(&R::Regular) -> Alpha<D>,
) -> Result<(Alpha<D>, Vec<R::Point>, Cloud), Failure> {
    let (alpha, points, about) = if args.weights.given().is_some() {
        let sites = Weighted::<R>::read(&args.input, &args.weights, stats, quiet)?;
        let _phase = Phase::start(quiet, "growing");
        (weighted(&sites.triangulation), sites.points, sites.about)
    } else {
        let (points, about) = room::read::<R>(&args.input, quiet)?;
        stats.phase("read");
        let d: R = room::build(&points, R::FASTEST, &args.input.label(), quiet)?;
        room::remark(&d, quiet);
        stats.phase("build");
        stats.triangulation(&d, d.counters());
        let _phase = Phase::start(quiet, "growing");
        (plain(&d), points, about)
    };
    stats.phase("alpha");
    let all: usize = (0..4).map(|dimension| alpha.values(dimension).len()).sum();
    stats.set("faces", all);
    if let Some(path) = &args.filtration {
        let format = files::format_beside(path)?;
        let _phase = Phase::start(quiet, "writing");
        files::write(path, |out| write_filtration(out, format, &alpha))?;
    }
    Ok((alpha, points, about))
}

/// The squared radius that is asked for, if one is, with what is there.
fn value<const D: usize>(
    args: &AlphaArgs,
    alpha: &Alpha<D>,
    stats: &mut Stats,
) -> Result<Option<f64>, Failure> {
    let value = if let Some(parts) = args.optimal {
        let found = alpha.optimal(parts).ok_or_else(|| match parts {
            0 => Failure::usage("no shape has 0 parts", "leave the number out for one part"),
            _ => Failure::new("the points span no shape that has all of them", "give points that span more"),
        });
        Some(found?)
    } else {
        args.alpha.or(args.radius.map(|radius| radius * radius))
    };
    if let Some(value) = value {
        stats.set("alpha", value);
        stats.set("parts", alpha.parts(value).into_iter().max().map_or(0, |last| last + 1));
        stats.set(
            "components",
            alpha.components(value).into_iter().flatten().max().map_or(0, |last| last + 1),
        );
        stats.set("euler_characteristic", alpha.complex(value).euler_characteristic());
    }
    Ok(value)
}

/// Polygons where formats have them, triangles for all others.
fn write_outline(
    alpha: &Alpha<2>,
    value: f64,
    (points, about): (Vec<[f64; 2]>, Cloud),
    outputs: &[(PathBuf, Format)],
    size: u32,
    quiet: bool,
) -> Result<(), Failure> {
    let _phase = Phase::start(quiet, "writing");
    let is_polygon = |format: &Format| format.holds(Contents::Lines, Direction::Written);
    if outputs.iter().any(|(_, format)| is_polygon(format)) {
        let graph = graph(alpha, value, &about);
        for (path, format) in outputs.iter().filter(|(_, format)| is_polygon(format)) {
            files::write(path, |out| write_graph(out, *format, &graph))?;
        }
    }
    if outputs.iter().any(|(_, format)| !is_polygon(format)) {
        let triangles = alpha.complex(value).triangles;
        let mut patches = Patches {
            points,
            heights: about.z,
            triangles: triangles.iter().map(|t| counter_clockwise(alpha, *t).map(VertexId::index)).collect(),
            polygons: alpha.parts(value),
            crs: about.crs,
            ..Patches::default()
        };
        for (path, format) in outputs.iter().filter(|(_, format)| !is_polygon(format)) {
            let own = patches.crs.clone();
            patches.crs = files::drawn_system(own.as_ref(), *format);
            files::write_mesh(path, quiet, |out| write_patches(out, *format, &patches, size))?;
            patches.crs = own;
        }
    }
    Ok(())
}

fn counter_clockwise(alpha: &Alpha<2>, [a, b, c]: [VertexId; 3]) -> [VertexId; 3] {
    let [p, q, r] = [a, b, c].map(|v| alpha.position(v));
    if delone_predicates::orient2d(p, q, r).is_positive() { [a, b, c] } else { [a, c, b] }
}

/// The outline as polygons, with the points that are on it.
fn graph(alpha: &Alpha<2>, value: f64, about: &Cloud) -> Graph {
    let mut graph = Graph::default();
    graph.cloud.crs.clone_from(&about.crs);
    let mut heights = Vec::new();
    for (polygon, part) in alpha.outline(value).iter().enumerate() {
        for (number, ring) in part.iter().enumerate() {
            let (first, start) = (graph.cloud.xy.len(), graph.segments.len());
            for (i, v) in ring.iter().enumerate() {
                graph.cloud.xy.push(alpha.position(*v));
                heights.extend(about.z.as_ref().map(|z| z[v.index()]));
                graph.segments.push([first + i, first + (i + 1) % ring.len()]);
            }
            let segments = start..graph.segments.len();
            graph.rings.push(GraphRing { polygon, ring: number, segments });
        }
    }
    graph.is_border = vec![true; graph.segments.len()];
    graph.cloud.z = about.z.as_ref().map(|_| heights);
    graph
}

/// A surface with its corners alone.
struct Surface {
    corners: Vec<VertexId>,
    /// As indices of corners.
    faces: Vec<[usize; 3]>,
}

impl Surface {
    /// Of a shape; with corners more than once, if sheets that touch are to be apart.
    fn of(alpha: &Alpha<3>, value: f64, apart: bool) -> Self {
        if apart {
            let Manifold3 { vertices, triangles, .. } = alpha.manifold(value);
            return Self { corners: vertices, faces: triangles };
        }
        let outline = alpha.outline(value);
        let mut corners: Vec<VertexId> = outline.as_flattened().to_vec();
        corners.sort_unstable();
        corners.dedup();
        let place = |v: VertexId| corners.partition_point(|&corner| corner < v);
        let faces = outline.iter().map(|face| face.map(place)).collect();
        Self { corners, faces }
    }
}

/// The surface, or as indices of points.
fn write_surface(
    alpha: &Alpha<3>,
    surface: &Surface,
    points: Vec<[f64; 3]>,
    outputs: &[(PathBuf, Format)],
    options: &picture::Options,
    quiet: bool,
) -> Result<(), Failure> {
    let _phase = Phase::start(quiet, "writing");
    let solid = Solid {
        points: surface.corners.iter().map(|&v| alpha.position(v)).collect(),
        faces: surface.faces.iter().map(|face| face.to_vec()).collect(),
        laid_open: Vec::new(),
    };
    // A picture of a shape without a surface shows the points.
    let points = Solid { points, ..Solid::default() };
    for (path, format) in outputs {
        let is_picture = matches!(format, Format::Png | Format::Svg);
        let solid = if surface.faces.is_empty() && is_picture { &points } else { &solid };
        if matches!(format, Format::Npy | Format::Text) {
            let rows: Vec<i64> =
                surface.faces.as_flattened().iter().map(|&i| surface.corners[i].index() as i64).collect();
            files::write(path, |out| write_indices(out, *format, 3, &rows))?;
        } else {
            files::write_mesh(path, quiet, |out| write_solid(out, *format, solid, options))?;
        }
    }
    Ok(())
}
