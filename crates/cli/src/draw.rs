//! `delone draw`: pictures.

use delone::{Algorithm2, HintOrder, Hints2};
use delone_io::{Format, picture};

use crate::args::{Choice, DrawArgs};
use crate::message::Failure;
use crate::progress::Phase;
use crate::stats::Stats;
use crate::{files, space, triangulate};

pub(crate) fn run(args: &DrawArgs, quiet: bool) -> Result<(), Failure> {
    let outputs = files::outputs(&args.output, args.to, args.input.stats.as_deref(), &args.input.paths())?;
    if let Some((path, format)) =
        outputs.iter().find(|(_, format)| !matches!(format, Format::Svg | Format::Png))
    {
        return Err(Failure::usage(
            format!("{}: {format} is no picture", path.display()),
            "pictures are svg and png; for other files use delone triangulate",
        ));
    }
    if args.disks.is_some_and(|radius| !radius.is_finite() || radius < 0.0) {
        return Err(Failure::usage("--disks takes a radius", "as in --disks 0.5, in coordinate units"));
    }
    if args.dim.is_space() {
        if args.disks.is_some() || args.hints || args.max_edge.is_some() {
            return Err(Failure::usage(
                "--disks, --hints and --max-edge are for the plane",
                "leave them or --dim 3 out",
            ));
        }
        return space::draw(args, &outputs, quiet);
    }
    if !args.cut.is_empty() || args.wireframe {
        return Err(Failure::usage("--cut and --wireframe are for space", "add --dim 3, or leave them out"));
    }
    let mut stats = Stats::start();
    let mut cloud = files::points(&args.input, 2, quiet)?;
    stats.phase("read");
    let links = if args.hints { links(&cloud.xy, args)? } else { Vec::new() };
    let xy = std::mem::take(&mut cloud.xy);
    let triangulation = triangulate::build(xy, Algorithm2::default(), &args.input.label(), quiet)?;
    triangulate::remark(&triangulation, quiet);
    stats.phase("build");
    stats.triangulation(&triangulation);
    let trim = triangulate::trim(&triangulation, args.max_edge, &mut stats);
    let surface = triangulate::surface(&triangulation, &cloud, trim.as_ref());
    let yes = |choice: Option<Choice>| choice.map(|choice| choice == Choice::Yes);
    let options = picture::Options {
        size: args.camera.size,
        edges: yes(args.edges),
        points: yes(args.points),
        fill: yes(args.fill),
        disks: args.disks,
        links,
        window: None,
    };
    let _phase = Phase::start(quiet, "drawing");
    for (path, format) in &outputs {
        files::write(path, |out| picture::write(out, *format, &surface, &options))?;
    }
    stats.phase("write");
    stats.tell(quiet, ["triangle", "triangles"]);
    stats.write(args.input.stats.as_deref())
}

/// From each point to its hint.
fn links(points: &[[f64; 2]], args: &DrawArgs) -> Result<Vec<[[f64; 2]; 2]>, Failure> {
    let hints = Hints2::from_points(points, HintOrder::Random { seed: args.seed })
        .map_err(|error| Failure::points(&args.input.label(), &error))?;
    Ok(hints.order().zip(hints.hints()).skip(1).map(|(i, j)| [points[i], points[j]]).collect())
}
