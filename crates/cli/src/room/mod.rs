//! The plane and space as the commands see them, so that each command is written once.
//!
//! Common parts of commands are here too: how points are read, triangulated and remarked on. A dimension tells in its own file
//! what is different there.

mod plane;
mod space;

use std::path::{Path, PathBuf};

use delone::surface::Duplicates;
use delone::{
    Bounds, Change, Coordinates, Counters, Dimension, Graph, Imprecise, Locate, Regular, Triangulation,
    Verdict, VertexId,
};
use delone_io::{Border, Cloud, Drawable, Format, Mesh, Source, Trim};

use crate::args::{AlgorithmName, InputArgs, LocateName, StrategyArgs};
use crate::files;
use crate::message::{Failure, note};
use crate::progress::Phase;
use crate::stats::Stats;

/// The plane or space, by its triangulation.
pub trait Room: Change<Point: Drawable> {
    const WORDS: Words;
    type Algorithm: Copy;
    /// The algorithm of commands that leave no choice.
    const FASTEST: Self::Algorithm;
    type Hints: Imprecise<Triangulation = Self>;
    /// The corners of a simplex in a file.
    type Row;

    /// Whether this is space.
    fn is_space() -> bool {
        Self::Point::COUNT == 3
    }

    /// Takes the coordinates that are triangulated out of what a file has.
    fn take_points(cloud: &mut Cloud, path: &Path) -> Result<Vec<Self::Point>, Failure>;

    /// How to build, by the names of options.
    fn plan(
        algorithm: Option<AlgorithmName>,
        strategy: &StrategyArgs,
    ) -> Result<Plan<Self::Algorithm>, Failure>;

    fn build(points: &[Self::Point], algorithm: Self::Algorithm) -> Result<Self, delone::Error>;

    /// The edges of a proximity graph.
    fn graph(&self, graph: Graph) -> Result<Vec<[VertexId; 2]>, delone::Error>;

    /// Counters of the construction.
    fn counters(&self) -> Counters;

    /// The triangulation of points with weights.
    type Regular: Regular<Point = Self::Point>;

    /// How to build it: what is chosen among.
    type RegularAlgorithm: Copy + Default;

    /// The algorithm for sites with weights, by the names of options.
    fn plan_regular(strategy: &StrategyArgs) -> Result<Self::RegularAlgorithm, Failure>;

    fn regular(
        points: &[Self::Point],
        weights: &[f64],
        algorithm: Self::RegularAlgorithm,
    ) -> Result<Self::Regular, delone::Error>;

    /// Whether a point is on the circle or sphere through the corners of a simplex.
    fn is_tie(simplex: &[Self::Point], q: Self::Point) -> bool;

    /// Tells `info` more of simplices and hull, line by line.
    fn describe(&self, line: &mut impl FnMut(&str, String), stats: &mut Stats);

    fn read_simplices(source: Box<dyn Source>, format: Format) -> Result<Vec<Self::Row>, delone_io::Error>;

    /// Judges simplices of points, with weights if there are some.
    fn verify(
        points: &[Self::Point],
        weights: Option<&[f64]>,
        simplices: &[Self::Row],
    ) -> Result<Verdict, Objection>;
}

/// The words of a dimension.
pub struct Words {
    /// A simplex, and several.
    pub simplex: [&'static str; 2],
    /// The word for corners of neighbors that could be divided in another way.
    pub(crate) tied: &'static str,
    /// The words of `check` for simplices in negative order: in statistics, and in a sentence.
    pub(crate) negative: [&'static str; 2],
    /// And neighbors that are divided in another way than the canonical one.
    pub(crate) other: [&'static str; 2],
}

/// How to build, and what statistics say of it.
pub struct Plan<A> {
    pub(crate) algorithm: A,
    pub(crate) name: AlgorithmName,
    /// How points are located, where that is a choice.
    pub(crate) locate: Option<LocateName>,
}

/// The construction that has no parameters.
const WITH_WEIGHTS: &str = "a construction with weights";

/// Why simplices from elsewhere are wrong.
pub enum Objection {
    /// The points themselves are.
    Points(delone::Error),
    Simplices(String),
}

/// Reads the points of a command, and what else their files tell.
pub(crate) fn read<R: Room>(input: &InputArgs, quiet: bool) -> Result<(Vec<R::Point>, Cloud), Failure> {
    let mut cloud = files::points(input, R::Point::COUNT, quiet)?;
    let points = R::take_points(&mut cloud, &input.label())?;
    Ok((points, cloud))
}

/// The box around points, in the plane.
///
/// # Errors
/// The first point whose place is not finite; and where there is none.
pub(crate) fn bounds<P: AsRef<[f64]>>(points: &[P], label: &Path) -> Result<Bounds<2>, Failure> {
    delone_terrain::bounds(points).map_err(|error| match error {
        delone_terrain::Error::Points(error) => Failure::points(label, &error),
        other => {
            let what = format!("{}: {other}", label.display());
            Failure::new(what, "give other points, or all classes of them")
        }
    })
}

/// Reads points that are asked for, or centers.
pub fn queries<R: Room>(path: &Path, quiet: bool) -> Result<Vec<R::Point>, Failure> {
    R::take_points(&mut files::queries(path, R::Point::COUNT, Vec::new(), quiet)?, path)
}

/// Reads points that are asked for with their attributes, heights in the plane among them, and dimensions of LAS files that are named.
pub(crate) fn queries_with<R: Room>(
    path: &Path,
    dimensions: Vec<String>,
    quiet: bool,
) -> Result<(Vec<R::Point>, Cloud), Failure> {
    let mut cloud = files::queries(path, R::Point::COUNT, dimensions, quiet)?;
    let points = R::take_points(&mut cloud, path)?;
    if let Some(heights) = cloud.z.take_if(|_| files::are_attributes_kept()) {
        cloud.features = cloud.features.with_heights(&heights);
    }
    Ok((points, cloud))
}

/// Refuses formats that hold no triangulations.
pub fn check_formats<R: Room>(outputs: &[(PathBuf, Format)]) -> Result<(), Failure> {
    files::check_formats(outputs, &[R::Point::CONTENTS])
}

/// Triangulates, with progress.
pub(crate) fn build<R: Room>(
    points: &[R::Point],
    algorithm: R::Algorithm,
    input: &Path,
    quiet: bool,
) -> Result<R, Failure> {
    let _phase = Phase::start(quiet, "triangulating");
    R::build(points, algorithm).map_err(|error| Failure::points(input, &error))
}

/// The strategy of a triangulation that is asked or changed, as `purpose` says.
pub fn strategy<R: Room>(args: &StrategyArgs, purpose: &str) -> Result<Locate, Failure> {
    located::<R>(args, LocateName::Tree)?.ok_or_else(|| {
        Failure::usage(
            format!("that strategy is for building in bulk, not for {purpose}"),
            "choose --locate tree, walk, jump-and-walk, hierarchy or delaunay-tree; in the plane history or stars too",
        )
    })
}

/// The strategy of choice, or else this one, with parameters in range; `None` if it is for building in bulk.
fn located<R: Room>(args: &StrategyArgs, default: LocateName) -> Result<Option<Locate>, Failure> {
    let Some(locate) = args.strategy(default)? else { return Ok(None) };
    R::default().set_strategy(locate).map_err(|error| args.refused(&error))?;
    Ok(Some(locate))
}

/// Points that equal an earlier one, with that one.
pub(crate) fn duplicates(d: &impl Triangulation) -> impl Iterator<Item = (usize, usize)> {
    d.duplicates().map(|pair| (pair.point, pair.vertex.index()))
}

/// Gives places with several points their heights.
pub(crate) fn settle(rule: Duplicates, d: &impl Triangulation, about: &mut Cloud) {
    if let Some(heights) = &mut about.z {
        rule.settle(heights, duplicates(d));
    }
}

/// Notes on what might surprise.
pub(crate) fn remark(d: &impl Triangulation, quiet: bool) {
    let (points, duplicates) = (d.ids_given(), d.duplicates().count());
    if duplicates > 0 {
        let text = match duplicates {
            1 => "equals an earlier one and is no vertex",
            _ => "equal earlier ones and are no vertices",
        };
        note(quiet, format_args!("{duplicates} of {points} points {text}"));
    }
    let is_space = coordinates(d) == 3;
    let what = match d.dimension() {
        Dimension::Empty => "there are no points",
        Dimension::Point => "there is only one distinct point",
        Dimension::Line => "all points are on one line",
        Dimension::Plane if is_space => "all points are in one plane",
        Dimension::Plane | Dimension::Space => return,
    };
    note(
        quiet,
        format_args!("{what}, so there are no {}", if is_space { "tetrahedra" } else { "triangles" }),
    );
}

fn coordinates<T: Triangulation>(_: &T) -> usize {
    T::Point::COUNT
}

/// Simplices that are left out for their length.
pub(crate) fn trim(d: &impl Triangulation, longest: Option<f64>, stats: &mut Stats) -> Option<Trim> {
    trim_border(d, &Border::long_edges(longest), stats, true)
}

/// Simplices that are left out along the border.
pub(crate) fn trim_border(
    d: &impl Triangulation,
    rule: &Border,
    stats: &mut Stats,
    quiet: bool,
) -> Option<Trim> {
    if rule.longest.is_none() && rule.slivers.is_none() {
        return None;
    }
    let trim = Trim::along_border(d, rule, |_| true);
    stats.set("left_out", trim.count());
    tell_slivers(&trim, rule, stats, quiet);
    Some(trim)
}

/// Tells of slivers, if these were to go.
pub(crate) fn tell_slivers(trim: &Trim, rule: &Border, stats: &mut Stats, quiet: bool) {
    if let Some(ratio) = rule.slivers {
        stats.set("slivers", trim.slivers());
        let count = trim.slivers();
        note(quiet, format_args!("triangles of the border flatter than {ratio:?}: {count}, left out"));
    }
}

/// The mesh of a triangulation to be written.
pub(crate) fn mesh<'a, T: Triangulation>(
    d: &'a T,
    points: &'a [T::Point],
    about: &'a Cloud,
    trim: Option<&'a Trim>,
) -> Mesh<'a, T> {
    let (heights, crs, base) = (about.z.as_deref(), about.crs.as_ref(), about.base);
    Mesh { heights, crs, base, trim, ..Mesh::new(d, points) }
}

/// The least of all even permutations of corners: the same whatever found them.
pub fn positive(corners: &[VertexId]) -> Vec<usize> {
    let mut corners: Vec<usize> = corners.iter().map(|v| v.index()).collect();
    let before = |(k, &v): (usize, &usize)| corners[..k].iter().filter(|&&w| w > v).count();
    let is_odd = corners.iter().enumerate().map(before).sum::<usize>() % 2 == 1;
    corners.sort_unstable();
    if is_odd && let [.., v, w] = &mut corners[..] {
        std::mem::swap(v, w);
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::positive;
    use delone::VertexId;

    #[test]
    fn corners_have_one_order() {
        let of = |corners: &[usize]| positive(&corners.iter().map(|&i| VertexId::new(i)).collect::<Vec<_>>());
        assert_eq!((of(&[7, 3]), of(&[3, 7])), (vec![7, 3], vec![3, 7]));
        assert_eq!((of(&[5, 2, 4]), of(&[2, 5, 4])), (vec![2, 4, 5], vec![2, 5, 4]));
        assert_eq!((of(&[4, 3, 2, 1]), of(&[4, 3, 1, 2])), (vec![1, 2, 3, 4], vec![1, 2, 4, 3]));
    }
}
