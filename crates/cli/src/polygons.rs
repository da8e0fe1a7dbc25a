//! `delone polygons`: many polygons in, the triangles inside of each out.

use std::path::PathBuf;

use delone::{Crossings, PolygonTriangles2, Polygons2};
use delone_io::{Contents, Graph, Patches, write_patches};

use crate::antimeridian;
use crate::args::{CrossingsName, InputArgs, PolygonsArgs};
use crate::constrained::features::filled_holes;
use crate::files;
use crate::message::{Failure, lost, note};
use crate::progress::Phase;
use crate::stats::Stats;
use crate::weld;

/// Polygons left out that are named; more are counted.
const NAMED: usize = 10;

pub(crate) fn run(args: &PolygonsArgs, quiet: bool) -> Result<(), Failure> {
    let inputs: Vec<_> = args.input.iter().map(PathBuf::as_path).collect();
    let outputs = args.wkt.of(files::outputs(&args.output, args.to, args.stats.as_deref(), &inputs)?)?;
    files::check_formats(&outputs, &[Contents::Patches])?;
    files::keep_attributes(Contents::Patches);
    let mut stats = Stats::start();
    let input = InputArgs { from: args.from, ..InputArgs::of(&args.input) };
    let mut graph = files::polygons(&input, quiet)?;
    antimeridian::heed(&mut graph, args.antimeridian, &input, &mut stats, quiet)?;
    weld::weld(&mut graph, args.weld, &input.label(), &mut stats, quiet)?;
    let polygons = corners(&graph);
    if graph.is_border.contains(&false) {
        lost(quiet, "lines are left out: they are no polygons");
    }
    if graph.lone_points().contains(&true) {
        lost(quiet, "points are left out: they are no polygons");
    }
    stats.phase("read");
    let phase = Phase::start(quiet, "triangulating");
    let crossings = match args.crossings {
        Some(CrossingsName::Split) => Crossings::Split,
        _ => Crossings::Refuse,
    };
    let how = Polygons2::default().with_crossings(crossings).with_fill(args.fill.rule());
    let place = |ring: &Vec<usize>| -> Vec<[f64; 2]> { ring.iter().map(|&i| graph.cloud.xy[i]).collect() };
    let rings: Vec<Vec<Vec<[f64; 2]>>> =
        polygons.iter().map(|rings| rings.iter().map(place).collect()).collect();
    let results = how.triangulate_all(&rings);
    let filled = how.filled_holes_of_all(&rings);
    drop(phase);
    let mut patches = Patches { points: graph.cloud.xy.clone(), ..Patches::default() };
    patches.rows = vec![None; polygons.len()];
    graph.rings.iter().for_each(|ring| patches.rows[ring.polygon] = graph.row_of(ring));
    (patches.crs, patches.table) = (graph.cloud.crs, graph.cloud.features.table);
    let given = patches.points.len();
    tell_filled(&filled, quiet);
    let mut refused = 0;
    for (index, (result, rings)) in results.into_iter().zip(&polygons).enumerate() {
        match result {
            Ok(inside) => add(&mut patches, index, inside, &rings.concat()),
            Err(error) if args.keep_going => {
                refused += 1;
                if refused <= NAMED {
                    note(quiet, format_args!("polygon {index} is left out: {error}"));
                }
            }
            Err(error) => {
                let help = match error {
                    delone::Error::SegmentsCross { .. } => {
                        "repair the data, split sides with --crossings split, or leave such polygons out with --keep-going"
                    }
                    _ => "repair that polygon, or leave such polygons out with --keep-going",
                };
                let file = input.label();
                return Err(Failure::new(format!("{}: polygon {index}: {error}", file.display()), help));
            }
        }
    }
    if refused > NAMED {
        note(quiet, format_args!("{} more polygons are left out", refused - NAMED));
    }
    let added = patches.points.len() - given;
    if added == 0 {
        patches.heights = graph.cloud.z;
    } else {
        note(quiet, format_args!("sides that cross were split: {added} points were added"));
        if graph.cloud.z.is_some() {
            lost(quiet, "heights are left out: points that were added have none");
        }
    }
    stats.phase("build");
    stats.set("polygons", polygons.len());
    if args.keep_going {
        stats.set("refused", refused);
    }
    stats.set("points", patches.points.len());
    stats.set("added_points", added);
    stats.set("simplices", patches.triangles.len());
    let phase = Phase::start(quiet, "writing");
    for (path, format) in &outputs {
        let own = patches.crs.clone();
        patches.crs = files::drawn_system(own.as_ref(), *format);
        files::write_mesh(path, quiet, |out| write_patches(out, *format, &patches, args.size))?;
        patches.crs = own;
    }
    drop(phase);
    stats.phase("write");
    stats.tell(quiet, ["triangle", "triangles"]);
    stats.write(args.stats.as_deref())
}

/// Tells which holes are filled at least in part, by polygon.
fn tell_filled(filled: &[Vec<usize>], quiet: bool) {
    let count = filled.iter().map(Vec::len).sum();
    if let Some((polygon, ring)) = filled.iter().enumerate().find_map(|(i, rings)| Some((i, *rings.first()?)))
    {
        note(quiet, filled_holes(count, polygon, ring));
    }
}

/// The rings of each polygon, as indices of points.
fn corners(graph: &Graph) -> Vec<Vec<Vec<usize>>> {
    let count = graph.rings.iter().map(|ring| ring.polygon + 1).max().unwrap_or(0);
    let mut polygons = vec![Vec::new(); count];
    for ring in &graph.rings {
        let sides = &graph.segments[ring.segments.clone()];
        polygons[ring.polygon].push(sides.iter().map(|side| side[0]).collect());
    }
    polygons
}

/// Adds the triangles of a polygon, whose corners are these points; what was split follows them.
fn add(patches: &mut Patches, polygon: usize, inside: PolygonTriangles2, corners: &[usize]) {
    let first = patches.points.len();
    patches.points.extend(&inside.points[corners.len()..]);
    let index = |i: u32| {
        let i = i as usize;
        corners.get(i).copied().unwrap_or_else(|| first + i - corners.len())
    };
    patches.polygons.resize(patches.triangles.len() + inside.triangles.len(), polygon);
    patches.triangles.extend(inside.triangles.into_iter().map(|triangle| triangle.map(index)));
}
