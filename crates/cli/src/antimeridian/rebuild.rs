//! A graph whose segments are replaced by parts of them: points keep their indices, and what was made follows them.

use std::collections::BTreeMap;

use delone_io::{Graph, GraphRing};

use super::parts::Outline;
use super::turns::{Corner, Made};

/// The new segments of a graph.
pub(super) struct Rebuilt<'a> {
    given: &'a Graph,
    made: &'a [Made],
    /// The longitude that each point has got.
    placed: Vec<Option<f64>>,
    /// Points that were added, with their longitudes, and where corners are among all points.
    added: Vec<(Made, f64)>,
    places: BTreeMap<(Corner, u64), usize>,
    segments: Vec<[usize; 2]>,
    /// The segment of the input that each one is of, if it is of one, and that which has its attributes.
    origins: Vec<(Option<usize>, usize)>,
    rings: Vec<GraphRing>,
    /// Whether anything is other than it was.
    pub(super) is_other: bool,
}

impl<'a> Rebuilt<'a> {
    pub(super) fn new(given: &'a Graph, made: &'a [Made]) -> Self {
        Self {
            given,
            made,
            placed: vec![None; given.cloud.xy.len()],
            added: Vec::new(),
            places: BTreeMap::new(),
            segments: Vec::with_capacity(given.segments.len()),
            origins: Vec::with_capacity(given.segments.len()),
            rings: Vec::with_capacity(given.rings.len()),
            is_other: false,
        }
    }

    /// How many points were added.
    pub(super) fn added(&self) -> usize {
        self.added.len()
    }

    /// How many points of the input have got another longitude.
    pub(super) fn moved(&self) -> usize {
        let places = self.given.cloud.xy.iter().zip(&self.placed);
        places.filter(|(p, x)| x.is_some_and(|x| x.to_bits() != p[0].to_bits())).count()
    }

    /// The point of a corner at a longitude.
    fn point(&mut self, corner: Corner, x: f64) -> usize {
        if let Corner::Given(i) = corner {
            let is_there = self.placed[i].get_or_insert(x).to_bits() == x.to_bits();
            if is_there {
                self.is_other |= self.given.cloud.xy[i][0].to_bits() != x.to_bits();
                return i;
            }
        }
        self.is_other = true;
        let next = self.given.cloud.xy.len() + self.added.len();
        let place = *self.places.entry((corner, x.to_bits())).or_insert(next);
        if place == next {
            let made = match corner {
                Corner::Given(i) => Made::copy(self.given, i),
                Corner::Made(i) => self.made[i].clone(),
            };
            self.added.push((made, x));
        }
        place
    }

    /// A segment of the input, as it is.
    pub(super) fn keep(&mut self, segment: usize) {
        let ends = self.given.segments[segment];
        let ends = ends.map(|i| self.point(Corner::Given(i), self.given.cloud.xy[i][0]));
        self.segments.push(ends);
        self.origins.push((Some(segment), segment));
    }

    /// A ring of the input, as it is.
    pub(super) fn keep_ring(&mut self, ring: &GraphRing) {
        let start = self.segments.len();
        ring.segments.clone().for_each(|segment| self.keep(segment));
        self.rings.push(GraphRing { segments: start..self.segments.len(), ..ring.clone() });
    }

    /// A piece of a segment that is of no ring.
    pub(super) fn add_line(&mut self, ends: [(Corner, f64); 2], segment: usize) {
        let ends = ends.map(|(corner, x)| self.point(corner, x));
        self.segments.push(ends);
        self.origins.push((Some(segment), segment));
    }

    /// A ring of a part of a polygon, with the attributes of one of its segments.
    pub(super) fn add_ring(&mut self, outline: &Outline, polygon: usize, ring: usize, attributes: usize) {
        let start = self.segments.len();
        let points: Vec<usize> = outline.iter().map(|&(corner, x, _)| self.point(corner, x)).collect();
        for (i, &(_, _, segment)) in outline.iter().enumerate() {
            self.segments.push([points[i], points[(i + 1) % points.len()]]);
            self.origins.push((segment, segment.unwrap_or(attributes)));
        }
        self.rings.push(GraphRing { polygon, ring, segments: start..self.segments.len() });
    }

    /// A point that no segment ends at.
    pub(super) fn move_point(&mut self, i: usize, x: f64) {
        if self.placed[i].is_none() {
            _ = self.point(Corner::Given(i), x);
        }
    }

    /// Its new parts, to be put in the place of the old ones.
    pub(super) fn changes(self) -> Changes {
        Changes {
            placed: self.placed,
            added: self.added,
            segments: self.segments,
            origins: self.origins,
            rings: self.rings,
        }
    }
}

/// New parts of a graph.
pub(super) struct Changes {
    placed: Vec<Option<f64>>,
    added: Vec<(Made, f64)>,
    segments: Vec<[usize; 2]>,
    origins: Vec<(Option<usize>, usize)>,
    rings: Vec<GraphRing>,
}

impl Changes {
    /// Changes a graph. Returns how many arcs could not stay.
    pub(super) fn apply(self, graph: &mut Graph) -> usize {
        let rows = self.origins.iter().map(|origin| graph.row_of_segment(origin.1)).collect();
        let markers = |values: &Vec<i64>| {
            let of =
                |origin: &(Option<usize>, usize)| origin.0.and_then(|s| values.get(s).copied()).unwrap_or(0);
            self.origins.iter().map(of).collect()
        };
        graph.markers = graph.markers.as_ref().map(markers);
        graph.is_border =
            self.origins.iter().map(|o| graph.is_border.get(o.1).copied().unwrap_or(true)).collect();
        let arcs = graph.arcs.len();
        if arcs > 0 {
            let is_still = |i: usize| graph.cloud.xy.get(i).is_some_and(|p| self.placed[i] == Some(p[0]));
            let mut new = Vec::new();
            for (at, (origin, ends)) in self.origins.iter().zip(&self.segments).enumerate() {
                let Some(old) = origin.0.filter(|&old| graph.segments[old] == *ends) else { continue };
                if let Ok(known) = graph.arcs.binary_search_by_key(&old, |arc| arc.0)
                    && ends.iter().all(|&i| is_still(i))
                {
                    new.push((at, graph.arcs[known].1));
                }
            }
            graph.arcs = new;
        }
        for (p, x) in graph.cloud.xy.iter_mut().zip(&self.placed) {
            p[0] = x.unwrap_or(p[0]);
        }
        for (made, x) in self.added {
            graph.cloud.xy.push([x, made.latitude]);
            if let (Some(heights), Some(height)) = (&mut graph.cloud.z, made.height) {
                heights.push(height);
            }
            graph.point_markers.iter_mut().for_each(|markers| markers.push(0));
            graph.attributes.values.extend(made.attributes);
        }
        (graph.segments, graph.rings, graph.rows) = (self.segments, self.rings, Some(rows));
        arcs - graph.arcs.len()
    }
}
