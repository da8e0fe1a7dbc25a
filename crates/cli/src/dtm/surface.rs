//! The surface of points in memory, with breaklines and level polygons if there are some.

use std::path::Path;

use delone::surface::{
    ContourLine, Contours, Duplicates, Grid, Interpolator, Levels, Outside, Raster, gradients, rasterize,
};
use delone::{Constrained2, Crossings, Delaunay2, Refinement, Surround, Triangulation};
use delone_io::{Cloud, Trim};

use super::level::{Level, level_triangles};
use super::lines::Lines;
use super::round;
use crate::args::{DtmArgs, MethodName};
use crate::constrained::extended;
use crate::message::{Failure, note, warn};
use crate::stats::Stats;

/// The largest number of vertices added on lines, beside four for each point.
const MAX_VERTICES_ON_LINES: usize = 1000;

/// A triangulation with heights, and what of it is shown.
pub(super) struct Surface<T: Triangulation> {
    pub(super) d: T,
    /// By the index of the vertex.
    pub(super) heights: Vec<f64>,
    trim: Option<Trim>,
    /// Level triangles, which stay so whatever the method.
    level: Vec<Level>,
    slopes: Vec<[f64; 2]>,
}

/// The kinds of surfaces.
pub(super) enum Kind {
    Points(Box<Surface<Delaunay2>>),
    Lines(Box<Surface<Constrained2>>),
}

/// Triangulates points alone. Vertices are numbered along a curve, so that what is near in the plane is near in memory.
pub(super) fn of_points(
    cloud: &Cloud,
    rule: Duplicates,
    label: &Path,
) -> Result<(Delaunay2, Vec<f64>), Failure> {
    let failed = |error| Failure::points(label, &error);
    let (d, order) = Delaunay2::along_curve(&cloud.xy).map_err(failed)?;
    let mut given = cloud.z.clone().unwrap_or_default();
    if order.len() < cloud.xy.len() {
        let mut is_vertex = vec![false; cloud.xy.len()];
        order.iter().for_each(|&i| is_vertex[i as usize] = true);
        let mut pairs = Vec::new();
        let mut near = None;
        for point in (0..cloud.xy.len()).filter(|&i| !is_vertex[i]) {
            let found = d.find_near(near, cloud.xy[point]).map_err(failed)?;
            near = found.simplex.or(near);
            pairs.extend(found.face().first().map(|v| (point, order[v.index()] as usize)));
        }
        rule.settle(&mut given, pairs);
    }
    let heights = order.iter().map(|&i| given[i as usize]).collect();
    Ok((d, heights))
}

/// Triangulates points with lines.
pub(super) fn with_lines(
    cloud: &Cloud,
    lines: &Lines,
    args: &DtmArgs,
    label: &Path,
    stats: &mut Stats,
    quiet: bool,
) -> Result<Kind, Failure> {
    let failed = |error| Failure::graph(label, &error);
    let mut given = cloud.z.clone().unwrap_or_default();
    let (line_heights, levels) = lines.heights(cloud, args.duplicates.rule(), label)?;
    let first = given.len();
    given.extend(&line_heights);
    let points: Vec<[f64; 2]> = cloud.xy.iter().chain(&lines.points).copied().collect();
    let segments: Vec<[usize; 2]> = lines.segments.iter().map(|ends| ends.map(|i| i + first)).collect();
    let mut c = Constrained2::with_crossings(&points, &segments, Crossings::Split).map_err(failed)?;
    // Lines say what the height is where points are too.
    let pairs: Vec<(usize, usize)> = c.duplicates().map(|pair| (pair.point, pair.vertex.index())).collect();
    let rule = args.duplicates.rule();
    rule.settle(&mut given, pairs.iter().copied().filter(|pair| pair.0 < first));
    let on_lines = lines.heights_of_points_on(&c, first, rule);
    on_lines.into_iter().for_each(|(vertex, several)| given[vertex] = several.height());
    pairs.iter().filter(|pair| pair.0 >= first).for_each(|&(line, place)| given[place] = given[line]);
    let (mut heights, widest) = extended(&c, 1, &given, |_| None);
    let crossings = c.report().crossings;
    stats.set("crossings", crossings);
    if widest > 0.0 {
        warn(
            quiet,
            format_args!("lines cross at heights that differ by up to {widest}: their means are taken"),
        );
    } else if crossings > 0 {
        note(quiet, format_args!("lines cross at {crossings} places, where vertices were added"));
    }
    if args.method != MethodName::Linear {
        let before = c.points().len();
        // Lines that nearly lie on each other would want vertices without end.
        let most = MAX_VERTICES_ON_LINES + 4 * before;
        let how = Refinement::new().min_angle(0.0).conforming(true).max_vertices(most);
        how.run(&mut c).map_err(failed)?;
        heights = extended(&c, 1, &heights, |_| None).0;
        let added = c.points().len() - before;
        if added >= most {
            warn(quiet, "some lines are so near to each other that natural neighbors see across them");
        }
        if added > 0 {
            note(
                quiet,
                format_args!("{added} vertices were added on lines, so that natural neighbors respect them"),
            );
        }
    }
    let mut level = Vec::new();
    if !levels.is_empty() {
        level = level_triangles(&c, &lines.bounds, &levels).map_err(failed)?;
        // A corner of several is at the lowest.
        for &(corners, _) in &level {
            corners.iter().for_each(|v| heights[v.index()] = f64::INFINITY);
        }
        // On an edge between two the one that is painted last counts.
        level.sort_unstable_by(|a, b| b.1.total_cmp(&a.1));
        for &(corners, height) in &level {
            corners.iter().for_each(|v| heights[v.index()] = heights[v.index()].min(height));
        }
    }
    if args.method == MethodName::Linear {
        return Ok(Kind::Lines(Box::new(Surface::new(c, heights, args, level, label)?)));
    }
    // Lines are edges of the triangulation of all vertices now.
    let d = Delaunay2::from_points(c.points()).map_err(failed)?;
    Ok(Kind::Points(Box::new(Surface::new(d, heights, args, level, label)?)))
}

impl<T: Triangulation<Point = [f64; 2]>> Surface<T> {
    pub(super) fn new(
        d: T,
        heights: Vec<f64>,
        args: &DtmArgs,
        level: Vec<Level>,
        label: &Path,
    ) -> Result<Self, Failure> {
        if d.simplices().next().is_none() {
            let what = format!("{}: the points are on one line, which has no surface", label.display());
            return Err(Failure::new(what, "give points that span an area"));
        }
        let border = args.edges.border();
        let trim = border.longest.map(|_| Trim::along_border(&d, &border, |_| true));
        Ok(Self { d, heights, trim, level, slopes: Vec::new() })
    }

    /// Whether a triangle is shown.
    pub(super) fn keeps(&self, s: T::Simplex) -> bool {
        self.trim.as_ref().is_none_or(|trim| trim.keeps(self.d.index(s)))
    }

    /// Gives cells with values that are in level triangles the heights of these.
    fn level_out(&self, grid: &Grid, values: &mut [f64]) {
        if self.level.is_empty() {
            return;
        }
        let raster = Raster::new(*grid);
        for &(corners, height) in &self.level {
            raster.paint(corners.map(|v| self.d.position(v).unwrap_or_default()), [height; 3]);
        }
        let levels = raster.into_values();
        let pairs = values.iter_mut().zip(levels).filter(|pair| !pair.1.is_nan() && !pair.0.is_nan());
        pairs.for_each(|(value, level)| *value = level);
    }
}

impl Kind {
    /// Prepares the surface before rows are asked for.
    pub(super) fn prepare(&mut self, method: MethodName) -> Result<(), delone::Error> {
        if let Self::Points(surface) = self
            && method.is_bent()
        {
            surface.slopes = gradients(&surface.d, &surface.heights)?;
        }
        Ok(())
    }

    /// The lines of equal height of its triangles, at multiples of an interval.
    pub(super) fn contours(&self, interval: Option<f64>) -> Result<Vec<ContourLine>, delone::Error> {
        let surface = match self {
            Self::Points(s) => Contours::of_triangles(&s.d, &s.heights, |t| s.keeps(t)),
            Self::Lines(s) => Contours::of_triangles(&s.d, &s.heights, |t| s.keeps(t)),
        }?;
        let range = surface.range().unwrap_or_default();
        let interval = interval.unwrap_or_else(|| round((range[1] - range[0]) / 10.0));
        surface.lines(&Levels::every(interval, 0.0, range)?)
    }

    /// The values of some rows.
    pub(super) fn values(&self, method: MethodName, grid: &Grid) -> Result<Vec<f64>, delone::Error> {
        match self {
            Self::Points(surface) => {
                let mut values = rasterize(&surface.d, &surface.heights, grid, |s| surface.keeps(s))?;
                fill(&surface.d, method, (&surface.heights, &surface.slopes), grid, &mut values)?;
                surface.level_out(grid, &mut values);
                Ok(values)
            }
            Self::Lines(surface) => {
                let mut values = rasterize(&surface.d, &surface.heights, grid, |s| surface.keeps(s))?;
                surface.level_out(grid, &mut values);
                Ok(values)
            }
        }
    }
}

/// Replaces linear values by those of another method.
pub(super) fn fill(
    d: &Delaunay2,
    method: MethodName,
    (heights, slopes): (&[f64], &[[f64; 2]]),
    grid: &Grid,
    values: &mut [f64],
) -> Result<(), delone::Error> {
    let sibson = || Interpolator::sibson(d);
    match method {
        MethodName::Linear => Ok(()),
        MethodName::Natural => sibson().fill(grid, heights, values),
        MethodName::Laplace => Interpolator::laplace(d).fill(grid, heights, values),
        MethodName::Nearest => Interpolator::nearest(d).outside(Outside::Nothing).fill(grid, heights, values),
        MethodName::Smooth => sibson().fill_with(grid, values, |own, q| own.smooth(q, heights, slopes)),
        MethodName::Farin => sibson().fill_with(grid, values, |own, q| own.farin(q, heights, slopes)),
    }
}
