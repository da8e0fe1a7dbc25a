//! Breaklines and level polygons: read, and given heights where they have none.

use std::path::Path;

use delone::surface::{Interpolator, Outside};
use delone_io::{Cloud, Crs, Graph};

use super::surface::of_points;
use crate::args::{DtmArgs, DuplicatesName, InputArgs};
use crate::files;
use crate::message::{Failure, warn};

/// All of them, one after the other.
#[derive(Default)]
pub(super) struct Lines {
    pub(super) points: Vec<[f64; 2]>,
    /// The height of each point, where its file has it.
    given: Vec<Option<f64>>,
    pub(super) segments: Vec<[usize; 2]>,
    /// For each segment, whether what it bounds is level.
    pub(super) is_level: Vec<bool>,
    /// Points of each polygon that is level, or of what else is in one file.
    polygons: Vec<std::ops::Range<usize>>,
    /// Points that segments were cut at, each with an end of its segment.
    cuts: Vec<[usize; 2]>,
}

impl Lines {
    /// Reads the files of a command.
    pub(super) fn read(args: &DtmArgs, crs: Option<&Crs>, quiet: bool) -> Result<Self, Failure> {
        let mut lines = Self::default();
        let files = args.breaklines.iter().map(|path| (path, false));
        for (path, is_level) in files.chain(args.flat.iter().map(|path| (path, true))) {
            let graph = files::graph(&InputArgs::of(std::slice::from_ref(path)), None, quiet)?;
            if graph.segments.is_empty() {
                let what = format!("{}: there is no line in it", path.display());
                return Err(Failure::new(what, "give lines or polygons as geojson, wkt, wkb or poly"));
            }
            if let (Some(ours), Some(theirs)) = (crs, &graph.cloud.crs)
                && ours.epsg.zip(theirs.epsg).is_some_and(|(a, b)| a != b)
            {
                let what =
                    format!("{}: its coordinates are {theirs}, those of the points {ours}", path.display());
                return Err(Failure::new(what, "transform one of them first"));
            }
            if is_level && graph.rings.is_empty() {
                let what = format!("{}: there is no polygon in it", path.display());
                return Err(Failure::new(what, "give polygons, or --breaklines for lines"));
            }
            lines.add(graph, is_level, path, quiet)?;
        }
        Ok(lines)
    }

    /// Cuts segments into pieces that are not longer, so that what is on the other side of a line is behind its vertices.
    pub(super) fn cut(&mut self, longest: f64) {
        /// More would be lines of another scale than the raster.
        const MOST: f64 = 100_000.0;
        for s in 0..self.segments.len() {
            let [a, b] = self.segments[s];
            let (p, q) = (self.points[a], self.points[b]);
            let pieces = ((p[0] - q[0]).hypot(p[1] - q[1]) / longest).ceil().min(MOST) as usize;
            let mut last = a;
            for k in 1..pieces {
                let share = k as f64 / pieces as f64;
                let between = |a: f64, b: f64| a + share * (b - a);
                self.points.push([between(p[0], q[0]), between(p[1], q[1])]);
                self.given.push(self.given[a].zip(self.given[b]).map(|(a, b)| between(a, b)));
                let new = self.points.len() - 1;
                self.cuts.push([new, a]);
                self.segments.push([last, new]);
                self.is_level.push(self.is_level[s]);
                last = new;
            }
            self.segments[s] = [last, b];
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.segments.is_empty()
    }

    fn add(&mut self, graph: Graph, is_level: bool, path: &Path, quiet: bool) -> Result<(), Failure> {
        let first = self.points.len();
        self.points.extend(&graph.cloud.xy);
        match &graph.cloud.z {
            Some(heights) => self.given.extend(heights.iter().map(|&z| z.is_finite().then_some(z))),
            None => self.given.resize(self.points.len(), None),
        }
        self.segments.extend(graph.segments.iter().map(|ends| ends.map(|i| i + first)));
        self.is_level.resize(self.segments.len(), is_level);
        if !is_level {
            return Ok(());
        }
        for (k, polygon) in graph.rings.chunk_by(|a, b| a.polygon == b.polygon).enumerate() {
            let corners = polygon.iter().flat_map(|ring| &graph.segments[ring.segments.clone()]).flatten();
            let (from, to) = corners.fold((usize::MAX, 0), |(from, to), &i| (from.min(i), to.max(i + 1)));
            if from >= to {
                continue;
            }
            let range = first + from..first + to;
            let known: Vec<f64> = self.given[range.clone()].iter().copied().flatten().collect();
            let (low, high) =
                known.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &z| (a.min(z), b.max(z)));
            if high > low {
                let what = format!(
                    "{}: polygon {k} is to be level and has heights from {low} to {high}",
                    path.display()
                );
                warn(quiet, format_args!("{what}: the lowest is taken"));
                self.given[range.clone()].fill(Some(low));
            }
            self.polygons.push(range);
        }
        Ok(())
    }

    /// The height of each point; and of points of level polygons, by index, the height of the polygon.
    pub(super) fn heights(
        &self,
        cloud: &Cloud,
        rule: DuplicatesName,
        label: &Path,
    ) -> Result<(Vec<f64>, Vec<Option<f64>>), Failure> {
        let failed = |error| Failure::points(label, &error);
        let mut heights: Vec<f64> = self.given.iter().map(|z| z.unwrap_or(f64::NAN)).collect();
        if heights.iter().any(|z| z.is_nan()) {
            let (below, of_below) = of_points(cloud, rule, label)?;
            let mut surface = Interpolator::linear(&below).outside(Outside::Nearest);
            for (height, &p) in heights.iter_mut().zip(&self.points) {
                if height.is_nan() {
                    *height = surface.value(p, &of_below).map_err(failed)?.unwrap_or(0.0);
                }
            }
        }
        let mut levels = vec![None; heights.len()];
        for range in &self.polygons {
            let lowest = heights[range.clone()].iter().copied().fold(f64::INFINITY, f64::min);
            heights[range.clone()].fill(lowest);
            levels[range.clone()].fill(Some(lowest));
        }
        for &[new, end] in &self.cuts {
            levels[new] = levels[end];
            heights[new] = levels[end].unwrap_or(heights[new]);
        }
        if self.polygons.is_empty() {
            levels.clear();
        }
        Ok((heights, levels))
    }
}
