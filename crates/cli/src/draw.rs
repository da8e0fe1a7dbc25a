//! `delone draw`: pictures.

use delone::Algorithm;
use delone_io::{Format, Surface, picture};

use crate::args::{Choice, DrawArgs};
use crate::message::Failure;
use crate::progress::Phase;
use crate::stats::Stats;
use crate::{files, space, triangulate};

pub(crate) fn run(args: &DrawArgs, quiet: bool) -> Result<(), Failure> {
    let outputs = files::outputs(&args.output, args.to, args.input.stats.as_deref(), &[&args.input.input])?;
    if let Some((path, format)) =
        outputs.iter().find(|(_, format)| !matches!(format, Format::Svg | Format::Png))
    {
        return Err(Failure::usage(
            format!("{}: {format} is no picture", path.display()),
            "pictures are svg and png; for other files use delone triangulate",
        ));
    }
    if args.dim.is_space() {
        return space::draw(args, &outputs, quiet);
    }
    let mut stats = Stats::start();
    let cloud = files::points(&args.input, 2, quiet)?;
    stats.phase("read");
    let triangulation = triangulate::build(cloud.xy, Algorithm::default(), &args.input.input, quiet)?;
    triangulate::remark(&triangulation, quiet);
    stats.phase("build");
    stats.triangulation(&triangulation);
    let surface = Surface { triangulation: &triangulation, heights: cloud.z.as_deref() };
    let yes = |choice: Option<Choice>| choice.map(|choice| choice == Choice::Yes);
    let options = picture::Options {
        size: args.camera.size,
        edges: yes(args.edges),
        points: yes(args.points),
        fill: yes(args.fill),
    };
    let _phase = Phase::start(quiet, "drawing");
    for (path, format) in &outputs {
        files::write(path, |out| picture::write(out, *format, &surface, &options))?;
    }
    stats.phase("write");
    stats.write(args.input.stats.as_deref())
}
