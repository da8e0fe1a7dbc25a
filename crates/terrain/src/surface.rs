//! The surface of points in memory, with breaklines and level polygons if there are some.

use delone::surface::{
    ContourLine, Contours, Grid, Interpolator, Levels, Outside, Raster, gradients, rasterize,
};
use delone::{Constrained2, Crossings, Delaunay2, Refinement, Triangulation};
use delone_io::{Cloud, Trim};

use crate::cells::round;
use crate::error::Error;
use crate::level::{Level, level_triangles};
use crate::lines::Lines;
use crate::options::{Method, Options};
use crate::points::of_points;
use crate::remark::Remark;
use crate::values::extended;

/// The largest number of vertices added on lines, beside four for each point.
const MAX_VERTICES_ON_LINES: usize = 1000;

/// The counts of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Counts {
    /// The points that were given, without those of lines.
    pub points: u64,
    /// The points, those of lines too, that are at the place of another one.
    pub duplicates: u64,
    /// The vertices of the triangulation.
    pub vertices: u64,
    /// Its triangles.
    pub triangles: u64,
    /// The vertices of its hull.
    pub hull: u64,
    /// The places where lines cross.
    pub crossings: u64,
}

/// The surface of points in memory.
///
/// ```
/// use delone::surface::Grid;
/// use delone_io::Cloud;
/// use delone_terrain::{Lines, Options, Surface};
///
/// // A ramp that rises to the east.
/// let xy = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
/// let z = Some(vec![0.0, 8.0, 8.0, 0.0]);
/// let cloud = Cloud { xy, z, ..Cloud::default() };
/// let grid = Grid::new([0.0, 4.0], [2.0, -2.0], 2, 2)?;
/// let surface = Surface::new(&cloud, Lines::new(), &grid, &Options::new())?;
/// assert_eq!(surface.values(&grid)?, [2.0, 6.0, 2.0, 6.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Surface {
    kind: Kind,
    method: Method,
    counts: Counts,
    remarks: Vec<Remark>,
}

impl Surface {
    /// Triangulates points with lines. Natural neighbors may see across a line by less than a quarter of the side of a cell.
    ///
    /// # Errors
    /// Those of points and heights; [`Error::Lines`] where lines cannot be edges; [`Error::OneLine`]; [`Error::Systems`].
    pub fn new(cloud: &Cloud, mut lines: Lines, cells: &Grid, options: &Options) -> Result<Self, Error> {
        heights_of(cloud)?;
        let differs = |crs: &&delone_io::Crs| cloud.crs.as_ref().is_some_and(|own| !own.agrees(crs));
        if let (Some(ours), Some(theirs)) = (&cloud.crs, lines.systems().iter().find(differs)) {
            return Err(Error::Systems { ours: Box::new(ours.clone()), theirs: Box::new(theirs.clone()) });
        }
        let (mut remarks, mut crossings) = (Vec::new(), 0);
        let mut kind = if lines.is_empty() {
            let (d, heights) = of_points(cloud, options.duplicates)?;
            Kind::Points(Box::new(Sheet::new(d, heights, options, Vec::new())?))
        } else {
            if options.method != Method::Linear {
                let [width, height] = cells.step();
                lines.cut(width.abs().min(height.abs()) / 4.0).map_err(Error::Lines)?;
            }
            let (kind, count) = with_lines(cloud, &lines, options, &mut remarks)?;
            crossings = count;
            kind
        };
        kind.prepare(options.method).map_err(Error::Points)?;
        let (vertices, triangles, hull) = kind.counts();
        let count = |n: usize| n as u64;
        let counts = Counts {
            points: count(cloud.xy.len()),
            duplicates: count((cloud.xy.len() + lines.points.len()).saturating_sub(vertices)),
            vertices: count(vertices),
            triangles: count(triangles),
            hull: count(hull),
            crossings: count(crossings),
        };
        Ok(Self { kind, method: options.method, counts, remarks })
    }

    /// The numbers of its parts.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// Remarks on what might surprise.
    pub fn remarks(&self) -> &[Remark] {
        &self.remarks
    }

    /// The heights at the centers of cells, row by row; NaN where there is no triangle.
    ///
    /// # Errors
    /// [`Error::Points`] for centers that are not finite.
    pub fn values(&self, cells: &Grid) -> Result<Vec<f64>, Error> {
        self.kind.values(self.method, cells).map_err(Error::Points)
    }

    /// The lines of equal height of its triangles, at multiples of an interval; without one there are about ten heights.
    ///
    /// # Errors
    /// [`Error::Levels`] for an interval that is not positive, or gives too many heights.
    pub fn contours(&self, interval: Option<f64>) -> Result<Vec<ContourLine>, Error> {
        self.kind.contours(interval).map_err(Error::Levels)
    }
}

/// The heights of points that have a surface.
///
/// # Errors
/// [`Error::NoPoints`], [`Error::NoHeights`], and [`Error::Points`] with the first height that is not finite.
pub fn heights_of(cloud: &Cloud) -> Result<&[f64], Error> {
    if cloud.xy.is_empty() {
        return Err(Error::NoPoints);
    }
    let heights = cloud.z.as_deref().ok_or(Error::NoHeights)?;
    match heights.iter().position(|z| !z.is_finite()) {
        Some(index) => Err(Error::Points(delone::Error::Height { index, value: heights[index] })),
        None => Ok(heights),
    }
}

/// A triangulation with heights, and what of it is shown.
#[derive(Clone, Debug)]
struct Sheet<T: Triangulation> {
    d: T,
    /// By the index of the vertex.
    heights: Vec<f64>,
    trim: Option<Trim>,
    /// Level triangles, which stay so whatever the method.
    level: Vec<Level>,
    slopes: Vec<[f64; 2]>,
}

/// The kinds of surfaces.
#[derive(Clone, Debug)]
enum Kind {
    Points(Box<Sheet<Delaunay2>>),
    Lines(Box<Sheet<Constrained2>>),
}

/// Triangulates points with lines; tells at how many places these cross.
fn with_lines(
    cloud: &Cloud,
    lines: &Lines,
    options: &Options,
    remarks: &mut Vec<Remark>,
) -> Result<(Kind, usize), Error> {
    let failed = Error::Lines;
    let mut given = cloud.z.clone().unwrap_or_default();
    let (line_heights, levels) = lines.heights(cloud, options.duplicates)?;
    let first = given.len();
    given.extend(&line_heights);
    let points: Vec<[f64; 2]> = cloud.xy.iter().chain(&lines.points).copied().collect();
    let segments: Vec<[usize; 2]> = lines.segments.iter().map(|ends| ends.map(|i| i + first)).collect();
    let mut c = Constrained2::with_crossings(&points, &segments, Crossings::Split).map_err(failed)?;
    // Lines say what the height is where points are too.
    let pairs: Vec<(usize, usize)> = c.duplicates().map(|pair| (pair.point, pair.vertex.index())).collect();
    let rule = options.duplicates;
    rule.settle(&mut given, pairs.iter().copied().filter(|pair| pair.0 < first));
    let on_lines = lines.heights_of_points_on(&c, first, rule);
    on_lines.into_iter().for_each(|(vertex, several)| given[vertex] = several.height());
    pairs.iter().filter(|pair| pair.0 >= first).for_each(|&(line, place)| given[place] = given[line]);
    let (mut heights, widest) = extended(&c, 1, &given, |_| None);
    let crossings = c.report().crossings;
    if widest > 0.0 {
        remarks.push(Remark::CrossingHeights { widest });
    } else if crossings > 0 {
        remarks.push(Remark::Crossings { count: crossings });
    }
    if options.method != Method::Linear {
        let before = c.points().len();
        // Lines that nearly lie on each other would want vertices without end.
        let most = MAX_VERTICES_ON_LINES + 4 * before;
        let how = Refinement::new().min_angle(0.0).conforming(true).max_vertices(most);
        how.run(&mut c).map_err(failed)?;
        heights = extended(&c, 1, &heights, |_| None).0;
        let added = c.points().len() - before;
        if added >= most {
            remarks.push(Remark::NearLines);
        }
        if added > 0 {
            remarks.push(Remark::Added { count: added });
        }
    }
    let mut level = Vec::new();
    if !levels.is_empty() {
        level = level_triangles(&c, &lines.bounds, &levels).map_err(failed)?;
        // A vertex of several level polygons takes the lowest height.
        for &(corners, _) in &level {
            corners.iter().for_each(|v| heights[v.index()] = f64::INFINITY);
        }
        // The lowest polygon is painted last, so it wins on common edges.
        level.sort_unstable_by(|a, b| b.1.total_cmp(&a.1));
        for &(corners, height) in &level {
            corners.iter().for_each(|v| heights[v.index()] = heights[v.index()].min(height));
        }
    }
    if options.method == Method::Linear {
        return Ok((Kind::Lines(Box::new(Sheet::new(c, heights, options, level)?)), crossings));
    }
    // Lines are edges of the triangulation of all vertices now.
    let d = Delaunay2::from_points(c.points()).map_err(failed)?;
    Ok((Kind::Points(Box::new(Sheet::new(d, heights, options, level)?)), crossings))
}

impl<T: Triangulation<Point = [f64; 2]>> Sheet<T> {
    fn new(d: T, heights: Vec<f64>, options: &Options, level: Vec<Level>) -> Result<Self, Error> {
        if d.simplices().next().is_none() {
            return Err(Error::OneLine);
        }
        let border = options.border;
        let trim = border.longest.map(|_| Trim::along_border(&d, &border, |_| true));
        Ok(Self { d, heights, trim, level, slopes: Vec::new() })
    }

    /// Whether a triangle is shown.
    fn keeps(&self, s: T::Simplex) -> bool {
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
    /// Vertices, triangles, and vertices of the hull.
    fn counts(&self) -> (usize, usize, usize) {
        match self {
            Self::Points(s) => (s.d.vertex_count(), s.d.triangle_count(), s.d.hull_vertices().count()),
            Self::Lines(s) => (s.d.vertex_count(), s.d.triangle_count(), s.d.hull_vertices().count()),
        }
    }

    /// Prepares the surface before rows are asked for.
    fn prepare(&mut self, method: Method) -> Result<(), delone::Error> {
        if let Self::Points(surface) = self
            && method.needs_gradients()
        {
            surface.slopes = gradients(&surface.d, &surface.heights)?;
        }
        Ok(())
    }

    /// The lines of equal height of its triangles, at multiples of an interval.
    fn contours(&self, interval: Option<f64>) -> Result<Vec<ContourLine>, delone::Error> {
        let surface = match self {
            Self::Points(s) => Contours::of_triangles(&s.d, &s.heights, |t| s.keeps(t)),
            Self::Lines(s) => Contours::of_triangles(&s.d, &s.heights, |t| s.keeps(t)),
        }?;
        let range = surface.range().unwrap_or_default();
        let interval = interval.unwrap_or_else(|| round((range[1] - range[0]) / 10.0));
        surface.lines(&Levels::every(interval, 0.0, range)?)
    }

    /// The values of some rows.
    fn values(&self, method: Method, grid: &Grid) -> Result<Vec<f64>, delone::Error> {
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
fn fill(
    d: &Delaunay2,
    method: Method,
    (heights, slopes): (&[f64], &[[f64; 2]]),
    grid: &Grid,
    values: &mut [f64],
) -> Result<(), delone::Error> {
    let sibson = || Interpolator::sibson(d);
    match method {
        Method::Linear => Ok(()),
        Method::Natural => sibson().fill(grid, heights, values),
        Method::Laplace => Interpolator::laplace(d).fill(grid, heights, values),
        Method::Nearest => Interpolator::nearest(d).outside(Outside::Nothing).fill(grid, heights, values),
        Method::Smooth => sibson().fill_with(grid, values, |own, q| own.smooth(q, heights, slopes)),
        Method::Farin => sibson().fill_with(grid, values, |own, q| own.farin(q, heights, slopes)),
    }
}
