//! The input of all engines: distinct points, segments that meet in points only, and a point in each hole.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use delone::{Constrained2, Fill, Seeds2};
use delone_generators::Graph;
use delone_io::{Format, ReadOptions, Source};

/// A planar straight line graph with an inside.
pub struct Input {
    pub name: String,
    pub points: Vec<[f64; 2]>,
    pub segments: Vec<[usize; 2]>,
    /// A point in each hole. What no segment parts from the outside is outside too.
    pub holes: Vec<[f64; 2]>,
    /// Whether the inside is all of the convex hull.
    pub is_hull: bool,
    /// Of the inside.
    pub area: f64,
}

impl Input {
    /// A generated polygon of so many corners about, or a file: the seeds of a `.poly` file say what its holes are, everywhere
    /// else it is the even-odd rule.
    pub fn named(name: &str, size: usize) -> Result<Self, String> {
        if let Some(graph) = Graph::named(name) {
            let (points, segments) = graph.parts(size, 1);
            return Self::new(name, &points, &segments, None);
        }
        let path = Path::new(name);
        let format = Format::of(path).map_err(|error| error.to_string())?;
        let file = BufReader::new(File::open(path).map_err(|error| error.to_string())?);
        let mut beside = |extension: &str| -> Result<Box<dyn Source>, delone_io::Error> {
            Ok(Box::new(BufReader::new(File::open(path.with_extension(extension))?)))
        };
        let options = ReadOptions::default().dimension(2);
        let graph = delone_io::read_graph(Box::new(file), format, &options, Some(&mut beside))
            .map_err(|error| error.to_string())?;
        let holes = (format == Format::Poly).then_some(graph.holes);
        let name = path.file_stem().map_or_else(|| name.into(), |stem| stem.to_string_lossy().into_owned());
        Self::new(&name, &graph.cloud.xy, &graph.segments, holes)
    }

    /// Each point once, each segment cut at the points on it, in the order of the input, which shows in what some engines do;
    /// and the inside measured.
    fn new(
        name: &str,
        points: &[[f64; 2]],
        segments: &[[usize; 2]],
        holes: Option<Vec<[f64; 2]>>,
    ) -> Result<Self, String> {
        let c = Constrained2::from_parts(points, segments).map_err(|error| error.to_string())?;
        let holes = match holes {
            Some(holes) => holes,
            None => seeds_of_holes(&c)?,
        };
        let seeds = Seeds2::default().holes(holes.clone());
        let domains = c.domains(&Fill::Seeds(&seeds)).map_err(|error| error.to_string())?;
        let inside = c.triangle_ids().filter(|&t| domains.is_inside(t));
        let mut index = vec![usize::MAX; points.len()];
        c.vertices().enumerate().for_each(|(i, v)| index[v.index()] = i);
        let chains = c.segments().filter_map(|(s, _)| c.chain(s));
        let chains: Vec<Vec<usize>> =
            chains.map(|chain| chain.iter().map(|v| index[v.index()]).collect()).collect();
        let mut seen = BTreeSet::new();
        let edges = chains.iter().flat_map(|chain| chain.array_windows().copied());
        let segments = edges.filter(|&[a, b]: &[usize; 2]| seen.insert([a.min(b), a.max(b)])).collect();
        Ok(Self {
            name: name.to_owned(),
            points: c.vertices().map(|v| c.point(v)).collect(),
            segments,
            holes,
            is_hull: domains.parts().iter().all(|part| part.is_inside),
            area: inside.map(|t| c.area(t)).sum(),
        })
    }
}

/// The center of the largest triangle of each part that an even number of segments is around, and some.
fn seeds_of_holes(c: &Constrained2) -> Result<Vec<[f64; 2]>, String> {
    let even_odd = c.domains(&Fill::EvenOdd).map_err(|error| error.to_string())?;
    let unseeded = Seeds2::default();
    let closed = c.domains(&Fill::Seeds(&unseeded)).map_err(|error| error.to_string())?;
    let mut largest = vec![None; even_odd.parts().len()];
    for t in c.triangle_ids().filter(|&t| closed.is_inside(t) && !even_odd.is_inside(t)) {
        let part = even_odd.part(t).ok_or("a triangle without part")?;
        let area = c.area(t);
        if largest[part].is_none_or(|(_, most)| area > most) {
            largest[part] = Some((t, area));
        }
    }
    let center = |t| {
        let corners = c.mesh().corners(t).map(|v| c.point(v));
        [0, 1].map(|k| corners.iter().map(|p| p[k]).sum::<f64>() / 3.0)
    };
    Ok(largest.into_iter().flatten().map(|(t, _)| center(t)).collect())
}
