//! Names of outputs: the files given, or those that Triangle writes beside its input.

use std::path::{Path, PathBuf};

use delone_io::{Contents, Direction, Drawable, Format, next_file};

use super::plan::Plan;
use super::source::{Material, stem, with};
use crate::args::{MeshArgs, Switches};
use crate::files;
use crate::message::Failure;

/// The content of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Content {
    Mesh(Format),
    VoronoiNode,
    VoronoiEdge,
}

/// A file that is written.
pub(super) type Target = (PathBuf, Content);

/// The files that were named, kept apart from all others.
pub(super) fn named(args: &MeshArgs, plan: &Plan, inputs: &[&Path]) -> Result<Vec<Target>, Failure> {
    let outputs = args.wkt.of(files::outputs(&args.output, args.to, args.input.stats.as_deref(), inputs)?)?;
    let mut targets = Vec::new();
    for (path, format) in outputs {
        let is_picture = matches!(format, Format::Png | Format::Svg);
        let check = if plan.traits.second_order {
            <[f64; 2]>::check_second_order(format)
        } else if plan.traits.quads.are_wanted() && !is_picture {
            <[f64; 2]>::check_quads(format)
        } else {
            format.check(Contents::Triangles, Direction::Written)
        };
        check.map_err(|error| Failure::file(&path, &error))?;
        let is_voronoi =
            path.file_stem().is_some_and(|stem| Path::new(stem).extension() == Some("v".as_ref()));
        let content = match format {
            Format::Node if is_voronoi => Content::VoronoiNode,
            Format::Edge if is_voronoi => Content::VoronoiEdge,
            _ => Content::Mesh(format),
        };
        targets.push((path, content));
    }
    if plan.element.is_some() && !targets.iter().any(|target| target.1 == Content::Mesh(Format::Inp)) {
        return Err(Failure::usage("--element is for .inp files", "write one, or leave --element out"));
    }
    Ok(targets)
}

/// The files that Triangle writes, which depend on what was read.
pub(super) fn beside(
    args: &MeshArgs,
    switches: &Switches,
    inputs: &[&Path],
    material: &Material,
) -> Result<Vec<Target>, Failure> {
    let path = input(args)?;
    let name = |extension: &str| {
        if switches.has('I') {
            with(&stem(&args.input).unwrap_or_else(|| path.with_extension("")), extension)
        } else {
            next_file(path, extension)
        }
    };
    let keeps = |own: &Path| {
        switches.has('I') && (inputs.contains(&own) || material.besides.iter().any(|read| read == own))
    };
    let mesh = [
        (!switches.has('N') && !keeps(&name("node")), Format::Node),
        (!switches.has('E'), Format::Ele),
        ((switches.has('p') || switches.has('c')) && !switches.has('P') && !switches.has('I'), Format::Poly),
        (switches.has('e'), Format::Edge),
        (switches.has('n'), Format::Neigh),
        (switches.has('g'), Format::Off),
    ];
    let mesh = mesh
        .into_iter()
        .filter(|one| one.0)
        .map(|(_, format)| (name(&format.to_string()), Content::Mesh(format)));
    let voronoi = [("v.node", Content::VoronoiNode), ("v.edge", Content::VoronoiEdge)];
    let voronoi = voronoi.into_iter().filter(|_| switches.has('v'));
    let targets: Vec<Target> =
        mesh.chain(voronoi.map(|(extension, content)| (name(extension), content))).collect();
    let besides = material.besides.iter().map(PathBuf::as_path);
    let read: Vec<&Path> = inputs.iter().copied().chain(besides).collect();
    let written = targets.iter().map(|target| target.0.as_path());
    files::keep_apart(&read, written.chain(args.input.stats.as_deref()))?;
    Ok(targets)
}

/// The one file that names are made of.
pub(super) fn input(args: &MeshArgs) -> Result<&Path, Failure> {
    match &args.input.input[..] {
        [one] if one != Path::new("-") => Ok(one),
        _ => Err(Failure::usage(
            "files are written beside the input if that is one file",
            "name outputs with -o",
        )),
    }
}
