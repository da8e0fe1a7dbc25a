//! Breaklines and level polygons, which are given heights where they have none.

use delone_predicates::hypotenuse;
use std::collections::BTreeMap;
use std::ops::Range;

use delone::surface::{Duplicates, Interpolator, Outside, Several};
use delone::{Constrained2, Crossings, SegmentId};
use delone_io::{Cloud, Crs, Graph};

use crate::error::Error;
use crate::points::of_points;
use crate::remark::Remark;
use crate::values::along;

/// Breaklines and level polygons, one after the other.
///
/// ```
/// use std::io::Cursor;
/// use delone_io::{Format, ReadOptions, read_graph};
/// use delone_terrain::Lines;
///
/// let ridge = r#"{"type": "LineString", "coordinates": [[0, 0, 5], [9, 9, 7]]}"#;
/// let ridge = read_graph(Box::new(Cursor::new(ridge)), Format::GeoJson, &ReadOptions::default(), None)?;
/// let mut lines = Lines::new();
/// lines.breaklines(&ridge)?;
/// assert!(!lines.is_empty());
/// # Ok::<(), delone_terrain::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Lines {
    pub(crate) points: Vec<[f64; 2]>,
    /// The height of each point, where its file has it.
    given: Vec<Option<f64>>,
    pub(crate) segments: Vec<[usize; 2]>,
    /// For each segment the level polygon that it bounds.
    pub(crate) bounds: Vec<Option<u32>>,
    /// Points of each polygon that is level.
    polygons: Vec<Range<usize>>,
    /// Points that segments were cut at, each with an end of its segment.
    cuts: Vec<[usize; 2]>,
    systems: Vec<Crs>,
}

impl Lines {
    /// No lines.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds lines that must be edges, with their own heights or, without, those of the surface below.
    ///
    /// # Errors
    /// [`Error::NoLine`] if there is none.
    pub fn breaklines(&mut self, graph: &Graph) -> Result<(), Error> {
        if graph.segments.is_empty() {
            return Err(Error::NoLine);
        }
        self.add(graph);
        Ok(())
    }

    /// Adds polygons that are level, water say: at the one height that they have, or at the lowest of the surface along their border.
    ///
    /// # Errors
    /// [`Error::NoLine`] and [`Error::NoPolygon`] if there is none.
    pub fn level(&mut self, graph: &Graph) -> Result<Vec<Remark>, Error> {
        if graph.segments.is_empty() {
            return Err(Error::NoLine);
        }
        if graph.rings.is_empty() {
            return Err(Error::NoPolygon);
        }
        let (first, first_segment) = (self.points.len(), self.segments.len());
        self.add(graph);
        Ok(self.level_out(graph, first, first_segment))
    }

    /// Whether there is no line.
    pub fn is_empty(&self) -> bool {
        self.segments.is_empty()
    }

    /// The systems of the lines' coordinates, where they are known.
    pub fn systems(&self) -> &[Crs] {
        &self.systems
    }

    /// Cuts segments into pieces that are not longer, so that what is on the other side of a line is behind its vertices.
    ///
    /// Where lines run along each other both are cut at the same places, the ends of either among them: places between are rounded, and
    /// pieces that nearly lie on each other would have no end of vertices that part them.
    pub(crate) fn cut(&mut self, longest: f64) -> Result<(), delone::Error> {
        let c = Constrained2::with_crossings(&self.points, &self.segments, Crossings::Split)?;
        let known = self.points.len();
        for s in 0..self.segments.len() {
            let [a, b] = self.segments[s];
            let (p, q) = (self.points[a], self.points[b]);
            let axis = usize::from((q[1] - p[1]).abs() > (q[0] - p[0]).abs());
            let chain = c.chain(SegmentId::new(s)).unwrap_or_default();
            let on: Vec<[f64; 2]> = chain.iter().filter(|v| v.index() < known).map(|&v| c.point(v)).collect();
            let mut places: Vec<[f64; 2]> = Vec::new();
            for (k, ends) in on.windows(2).enumerate() {
                places.extend(ends[..1].iter().filter(|_| k > 0));
                places.extend(between(ends[0], ends[1], longest));
            }
            let mut last = a;
            for place in places {
                let share = (place[axis] - p[axis]) / (q[axis] - p[axis]);
                self.points.push(place);
                self.given.push(self.given[a].zip(self.given[b]).map(|(a, b)| a + share * (b - a)));
                let new = self.points.len() - 1;
                self.cuts.push([new, a]);
                self.segments.push([last, new]);
                self.bounds.push(self.bounds[s]);
                last = new;
            }
            self.segments[s] = [last, b];
        }
        Ok(())
    }

    fn add(&mut self, graph: &Graph) {
        let first = self.points.len();
        self.points.extend(&graph.cloud.xy);
        match &graph.cloud.z {
            Some(heights) => self.given.extend(heights.iter().map(|&z| z.is_finite().then_some(z))),
            None => self.given.resize(self.points.len(), None),
        }
        self.segments.extend(graph.segments.iter().map(|ends| ends.map(|i| i + first)));
        self.bounds.resize(self.segments.len(), None);
        self.systems.extend(graph.cloud.crs.clone());
    }

    /// Makes the polygons of a graph level whose points and segments were added from these on.
    fn level_out(&mut self, graph: &Graph, first: usize, first_segment: usize) -> Vec<Remark> {
        let mut remarks = Vec::new();
        for (k, rings) in graph.rings.chunk_by(|a, b| a.polygon == b.polygon).enumerate() {
            let corners = rings.iter().flat_map(|ring| &graph.segments[ring.segments.clone()]).flatten();
            let (from, to) = corners.fold((usize::MAX, 0), |(from, to), &i| (from.min(i), to.max(i + 1)));
            if from >= to {
                continue;
            }
            let range = first + from..first + to;
            let known: Vec<f64> = self.given[range.clone()].iter().copied().flatten().collect();
            let (low, high) =
                known.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &z| (a.min(z), b.max(z)));
            if high > low {
                remarks.push(Remark::SeveralLevels { polygon: k, low, high });
                self.given[range.clone()].fill(Some(low));
            }
            for ring in rings {
                let sides = first_segment + ring.segments.start..first_segment + ring.segments.end;
                self.bounds[sides].fill(Some(self.polygons.len() as u32));
            }
            self.polygons.push(range);
        }
        remarks
    }

    /// The heights of lines where points of the cloud are on them: the first `count` vertices, which no end of a line equals. Of several
    /// lines the rule chooses.
    pub(crate) fn heights_of_points_on(
        &self,
        c: &Constrained2,
        count: usize,
        rule: Duplicates,
    ) -> BTreeMap<usize, Several> {
        let mut found: BTreeMap<usize, Several> = BTreeMap::new();
        for (s, &[a, b]) in self.segments.iter().enumerate() {
            let Some(heights) = self.given[a].zip(self.given[b]) else { continue };
            let chain = c.chain(SegmentId::new(s)).unwrap_or_default();
            let Some(inner) = chain.len().checked_sub(1).and_then(|last| chain.get(1..last)) else {
                continue;
            };
            for v in inner.iter().filter(|v| v.index() < count) {
                let height = along(c.point(*v), [self.points[a], self.points[b]], heights.into());
                let add = |several: &mut Several| several.add(height);
                found.entry(v.index()).and_modify(add).or_insert_with(|| Several::new(rule, height));
            }
        }
        found
    }

    /// The height of each point, and of each level polygon.
    pub(crate) fn heights(&self, cloud: &Cloud, rule: Duplicates) -> Result<(Vec<f64>, Vec<f64>), Error> {
        let mut heights: Vec<f64> = self.given.iter().map(|z| z.unwrap_or(f64::NAN)).collect();
        if heights.iter().any(|z| z.is_nan()) {
            let (below, of_below) = of_points(cloud, rule)?;
            let mut surface = Interpolator::linear(&below).outside(Outside::Nearest);
            for (height, &p) in heights.iter_mut().zip(&self.points) {
                if height.is_nan() {
                    *height = surface.value(p, &of_below).map_err(Error::Points)?.unwrap_or(0.0);
                }
            }
        }
        let mut of_polygon = Vec::new();
        let mut levels = vec![None; heights.len()];
        for range in &self.polygons {
            let lowest = heights[range.clone()].iter().copied().fold(f64::INFINITY, f64::min);
            heights[range.clone()].fill(lowest);
            levels[range.clone()].fill(Some(lowest));
            of_polygon.push(lowest);
        }
        for &[new, end] in &self.cuts {
            heights[new] = levels[end].unwrap_or(heights[new]);
        }
        Ok((heights, of_polygon))
    }
}

/// The places that cut a segment into equal pieces which are not longer; the same ones in both directions.
fn between(p: [f64; 2], q: [f64; 2], longest: f64) -> Vec<[f64; 2]> {
    /// The largest number of pieces of a segment: more would mean lines of another scale than the raster.
    const MAX_PIECES: f64 = 100_000.0;
    let pieces = (hypotenuse(p[0] - q[0], p[1] - q[1]) / longest).ceil().min(MAX_PIECES) as usize;
    let (low, high) = if p <= q { (p, q) } else { (q, p) };
    let place = |k: usize| [0, 1].map(|axis| low[axis] + k as f64 / pieces as f64 * (high[axis] - low[axis]));
    let mut places: Vec<[f64; 2]> = (1..pieces).map(place).collect();
    if q < p {
        places.reverse();
    }
    places
}
