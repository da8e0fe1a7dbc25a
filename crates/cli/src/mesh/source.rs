//! Sources of a mesh: files as they are named, or as Triangle finds them beside each other.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use delone::VertexId;
use delone_io::{Attributes, Format, Graph};

use super::field::Elements;
use super::plan::Plan;
use crate::antimeridian;
use crate::args::{AntimeridianName, FillName, InputArgs, MeshArgs};
use crate::constrained::usual;
use crate::files;
use crate::message::Failure;
use crate::stats::Stats;
use crate::weld;

/// The files that are read.
pub(super) struct Sources {
    pub(super) input: InputArgs,
    segments: Option<PathBuf>,
    /// Triangles that are refined again.
    refine: Option<PathBuf>,
    /// The largest areas of these.
    areas: Option<PathBuf>,
    /// Whether these triangles are made anew.
    is_rebuilt: bool,
    /// Whether segments, holes and regions of the input count.
    has_segments: bool,
}

/// The name of a Triangle's file without its extension; `None` for other files.
pub(super) fn stem(input: &InputArgs) -> Option<PathBuf> {
    let [path] = &input.input[..] else { return None };
    if input.from.is_some() || path == Path::new("-") {
        return None;
    }
    match Format::of(path) {
        Ok(Format::Poly | Format::Node | Format::Ele | Format::Area) => {
            let is_gzip = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("gz"));
            let plain = if is_gzip { path.with_extension("") } else { path.clone() };
            Some(plain.with_extension(""))
        }
        Ok(_) => None,
        Err(_) => Some(path.clone()),
    }
}

/// A name with an extension after all that it has.
pub(super) fn with(stem: &Path, extension: &str) -> PathBuf {
    let mut name = stem.as_os_str().to_owned();
    name.push(".");
    name.push(extension);
    name.into()
}

impl Sources {
    /// The sources that a command line names.
    pub(super) fn of(args: &MeshArgs) -> Result<Self, Failure> {
        if args.graph.weld.is_some() && args.refine.is_some() {
            let help = "weld the outline before it is meshed, or leave --weld out";
            return Err(Failure::usage("--weld is not for triangles that are refined", help));
        }
        if args.graph.antimeridian == Some(AntimeridianName::Cut) && args.refine.is_some() {
            let help = "cut the outline before it is meshed, or leave --antimeridian out";
            return Err(Failure::usage("--antimeridian cut is not for triangles that are refined", help));
        }
        let mut sources = Self {
            input: args.input.clone(),
            segments: args.graph.segments.clone(),
            refine: args.refine.clone(),
            areas: args.areas.clone(),
            is_rebuilt: args.rebuild,
            has_segments: true,
        };
        let Some(switches) = &args.triangle else { return Ok(sources) };
        sources.has_segments = switches.has('p') || args.graph.is_given();
        let Some(stem) = stem(&args.input) else {
            if switches.has('r') && sources.refine.is_none() {
                return Err(Failure::usage(
                    "the switch r is for .node files with their .ele file beside",
                    "name such a file, or the triangles with --refine",
                ));
            }
            return Ok(sources);
        };
        let (named, wanted) =
            (&args.input.input[0], if switches.has('p') { Format::Poly } else { Format::Node });
        // The file that was named, perhaps compressed, if it is the one that is read.
        let path = match Format::of(named) {
            Ok(format) if format == wanted => named.clone(),
            _ => with(&stem, &wanted.to_string()),
        };
        if !path.exists() && wanted == Format::Node && with(&stem, "poly").exists() {
            return Err(Failure::usage(
                format!("{}: there is no such file, but a .poly file", path.display()),
                "add p to the switches to read that",
            ));
        }
        sources.input.input = vec![path];
        if switches.has('r') {
            sources.refine = sources.refine.or(Some(with(&stem, "ele")));
            if switches.has_areas {
                sources.areas = sources.areas.or(Some(with(&stem, "area")));
            }
        }
        Ok(sources)
    }

    /// All of them.
    pub(super) fn paths<'a>(&'a self, args: &'a MeshArgs) -> Vec<&'a Path> {
        let others = [&self.segments, &self.refine, &self.areas, &args.size];
        self.input.paths().into_iter().chain(others.into_iter().filter_map(|path| path.as_deref())).collect()
    }

    /// Reads them.
    pub(super) fn read(
        &self,
        args: &MeshArgs,
        plan: &Plan,
        stats: &mut Stats,
        quiet: bool,
    ) -> Result<Material, Failure> {
        let (mut graph, besides) = files::graph_with_points(&self.input, self.segments.as_deref(), quiet)?;
        if self.has_segments && self.refine.is_none() {
            antimeridian::heed(&mut graph, args.graph.antimeridian, &self.input, stats, quiet)?;
        }
        weld::weld(&mut graph, args.graph.weld, &self.input.label(), stats, quiet)?;
        let mut fill = args.graph.fill.unwrap_or_else(|| usual(&self.input, &graph));
        if !self.has_segments {
            graph = Graph {
                cloud: graph.cloud,
                attributes: graph.attributes,
                point_markers: graph.point_markers,
                ..Graph::default()
            };
            fill = FillName::All;
        }
        if plan.traits.ignore_holes {
            graph.holes.clear();
        }
        if !plan.traits.region_areas {
            graph.regions.iter_mut().for_each(|region| region.max_area = None);
        }
        let again = match &self.refine {
            Some(path) => Some(self.again(path, &mut graph, quiet)?),
            None => None,
        };
        if again.is_some() {
            graph.holes.clear();
            fill = args.graph.fill.unwrap_or(FillName::EvenOdd);
        }
        stats.phase("read");
        Ok(Material { graph, fill, again, besides })
    }

    /// Reads triangles that are refined again. The border of what they cover becomes segments, and the only border; so do the sides
    /// between triangles of other attributes, so that no new triangle has a part of both.
    fn again(&self, path: &Path, graph: &mut Graph, quiet: bool) -> Result<Again, Failure> {
        let rows = files::simplices(path, quiet, delone_io::read_triangles)?;
        files::tell_quads(path, quiet)?;
        let attributes = files::simplices(path, quiet, delone_io::read_triangle_attributes)?;
        let count = graph.cloud.xy.len();
        let corner = |(row, &corner): (usize, &u64)| {
            usize::try_from(corner).ok().filter(|&corner| corner < count).ok_or_else(|| {
                Failure::new(
                    format!(
                        "{}: triangle {} has corner {corner}, but there are {count} points",
                        path.display(),
                        row / 3
                    ),
                    "triangles and points are counted from 0 here; name the points of these triangles",
                )
            })
        };
        let corners: Vec<usize> =
            rows.as_flattened().iter().enumerate().map(corner).collect::<Result<_, _>>()?;
        let triangles = corners.as_chunks::<3>().0;
        let areas = match &self.areas {
            None => None,
            Some(file) => {
                let areas = files::simplices(file, quiet, delone_io::read_areas)?;
                if areas.len() != triangles.len() {
                    let (areas, triangles) = (areas.len(), triangles.len());
                    return Err(Failure::new(
                        format!("{}: {areas} areas for {triangles} triangles", file.display()),
                        format!(
                            "give one for each triangle of {}, -1 where there is no bound",
                            path.display()
                        ),
                    ));
                }
                Some(areas)
            }
        };
        let apart = set_apart(graph, &corners);
        let elements = Elements::of(path, &graph.cloud.xy, triangles)?;
        let mut sides: Vec<([usize; 2], usize)> = Vec::with_capacity(3 * triangles.len());
        for (row, &[a, b, c]) in triangles.iter().enumerate() {
            sides.extend([[a, b], [b, c], [c, a]].map(|[from, to]| ([from.min(to), from.max(to)], row)));
        }
        sides.sort_unstable();
        let (mut border, mut between) = (Vec::new(), Vec::new());
        for same in sides.chunk_by(|one, other| one.0 == other.0) {
            match same {
                [(side, _)] => border.push(*side),
                [(side, one), (_, other)] if attributes.row(*one) != attributes.row(*other) => {
                    between.push(*side);
                }
                _ => {}
            }
        }
        add_between(graph, &between);
        add_border(graph, &border);
        Ok(Again { elements, attributes, areas, is_rebuilt: self.is_rebuilt, apart })
    }
}

/// Points that no triangle and no segment has, such as centers of circles, would split the triangle that they are in. So they are outside
/// of all from here on, by the largest extent. Gives them with their places. Points at the place of a corner stay: they are its vertex.
fn set_apart(graph: &mut Graph, corners: &[usize]) -> Vec<(usize, [f64; 2])> {
    let mut is_used = vec![false; graph.cloud.xy.len()];
    corners.iter().chain(graph.segments.as_flattened()).for_each(|&i| is_used[i] = true);
    let place = |i: usize| graph.cloud.xy[i].map(|x| (x + 0.0).to_bits());
    let places: HashSet<[u64; 2]> = (0..is_used.len()).filter(|&i| is_used[i]).map(place).collect();
    let unused: Vec<usize> =
        (0..is_used.len()).filter(|&i| !is_used[i] && !places.contains(&place(i))).collect();
    let bound = |k: usize, of: fn(f64, f64) -> f64, start: f64| {
        corners.iter().map(|&i| graph.cloud.xy[i][k]).fold(start, of)
    };
    let high = [0, 1].map(|k| bound(k, f64::max, f64::NEG_INFINITY));
    let low = [0, 1].map(|k| bound(k, f64::min, f64::INFINITY));
    let extent = (high[0] - low[0]).max(high[1] - low[1]);
    let outside = high.map(|x| x + extent);
    if !outside.iter().all(|x| x.is_finite()) {
        return Vec::new();
    }
    let apart = unused.iter().map(|&i| (i, graph.cloud.xy[i])).collect();
    unused.into_iter().for_each(|i| graph.cloud.xy[i] = outside);
    apart
}

/// Makes these sides segments, if they are not.
fn add_between(graph: &mut Graph, between: &[[usize; 2]]) {
    let mut is_there = vec![false; between.len()];
    for &[from, to] in &graph.segments {
        if let Ok(at) = between.binary_search(&[from.min(to), from.max(to)]) {
            is_there[at] = true;
        }
    }
    graph.segments.extend(between.iter().zip(is_there).filter(|side| !side.1).map(|side| *side.0));
    if let Some(markers) = &mut graph.markers {
        markers.resize(graph.segments.len(), 0);
    }
}

/// Makes these sides the border, and the only one. Those that are segments already need not be added.
fn add_border(graph: &mut Graph, border: &[[usize; 2]]) {
    graph.is_border = vec![false; graph.segments.len()];
    let mut is_there = vec![false; border.len()];
    for (segment, is_border) in graph.segments.iter().zip(&mut graph.is_border) {
        let [from, to] = *segment;
        if let Ok(at) = border.binary_search(&[from.min(to), from.max(to)]) {
            // Of equal segments one, because even and odd are counted.
            *is_border = !std::mem::replace(&mut is_there[at], true);
        }
    }
    let missing = border.iter().zip(is_there).filter(|side| !side.1).map(|side| *side.0);
    graph.segments.extend(missing);
    graph.is_border.resize(graph.segments.len(), true);
    if let Some(markers) = &mut graph.markers {
        markers.resize(graph.segments.len(), 0);
    }
}

/// The content that was read.
pub(super) struct Material {
    pub(super) graph: Graph,
    pub(super) fill: FillName,
    /// The mesh that is refined again.
    pub(super) again: Option<Again>,
    /// Files of points beside those that were named.
    pub(super) besides: Vec<PathBuf>,
}

/// A mesh that is refined again.
pub(super) struct Again {
    elements: Elements,
    attributes: Attributes,
    areas: Option<Vec<Option<f64>>>,
    /// Whether its triangles are made anew.
    is_rebuilt: bool,
    /// Points that nothing has, with their places.
    apart: Vec<(usize, [f64; 2])>,
}

impl Again {
    /// Points that nothing has, with their places.
    pub(super) fn apart(&self) -> &[(usize, [f64; 2])] {
        &self.apart
    }

    /// The triangles that stay until a vertex comes near.
    pub(super) fn kept(&self) -> &[[VertexId; 3]] {
        if self.is_rebuilt { &[] } else { self.elements.corners() }
    }

    /// Whether there are bounds of areas.
    pub(super) fn has_areas(&self) -> bool {
        self.areas.is_some()
    }

    /// Whether triangles have attributes.
    pub(super) fn has_attributes(&self) -> bool {
        self.attributes.width > 0
    }

    /// The largest area at a place.
    pub(super) fn area(&self, p: [f64; 2]) -> f64 {
        let of = |row: usize| self.areas.as_ref().and_then(|areas| areas.get(row).copied().flatten());
        self.elements.at(p).filter_map(of).fold(f64::INFINITY, f64::min)
    }

    /// The first attribute at a place.
    pub(super) fn attribute(&self, p: [f64; 2]) -> f64 {
        let first = self.elements.at(p).next();
        first.and_then(|row| self.attributes.row(row).first().copied()).unwrap_or_default()
    }
}
