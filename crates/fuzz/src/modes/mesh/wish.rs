//! Random criteria of a mesh.

use std::cell::Cell;

use delone::{
    Constrained2, Error, Fill, Keep, Layers2, Refined2, Refinement, RegionSeed2, Seeds2, SegmentId, VertexId,
};
use delone_generators::Random;

use crate::nasty::{self, once_in, pick};

type Point = [f64; 2];

/// How large triangles may be at a place: so much, and so much more for each unit along the axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Field {
    from: f64,
    base: f64,
    pub(super) slope: f64,
}

impl Field {
    pub(super) fn at(&self, p: Point) -> f64 {
        self.base + self.slope * (p[0] - self.from).abs()
    }
}

/// The criteria of a mesh.
#[derive(Clone, Debug)]
pub(super) struct Wish {
    pub(super) min_angle: f64,
    pub(super) max_area: Option<f64>,
    pub(super) max_edge: Option<f64>,
    /// The length that edges are to have, and how it may grow.
    length: Option<f64>,
    length_at: Option<Field>,
    growth: f64,
    pub(super) size: Option<Field>,
    pub(super) area: Option<Field>,
    /// Beyond this the size is none.
    pub(super) none_beyond: Option<f64>,
    pub(super) keep: Keep,
    pub(super) conforming: bool,
    pub(super) smooth: usize,
    pub(super) most: usize,
    pub(super) stop: Option<usize>,
    /// Boundary layers, and whether on all segments.
    pub(super) layers: Option<(Layers2, bool)>,
    /// 0 all, 1 parity, 2 winding, 3 seeds.
    fill: usize,
    seeds: Seeds2,
    /// Triangles that are given.
    triangles: Vec<[VertexId; 3]>,
    /// Segments that are chords of arcs.
    arcs: Vec<(SegmentId, Point)>,
}

impl Wish {
    /// For a set of points, whose size sizes follow.
    pub(super) fn random(random: &mut Random, points: &[Point]) -> Self {
        let extent = |k: usize| {
            let (low, high) = points
                .iter()
                .map(|p| p[k])
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
            high / 2.0 - low / 2.0
        };
        let span = extent(0).max(extent(1));
        // Sizes that are no numbers are refused before anything is done.
        let positive = |x: f64| Some(x).filter(|x| x.is_finite() && *x > 0.0);
        let part =
            |random: &mut Random| span * 2f64.powi(-(random.below(10) as i32)) * random.between(0.5, 1.5);
        let mut sometimes = |n: usize| if once_in(random, n) { positive(part(random)) } else { None };
        let [edge, area, size, area_at, length, length_at] = [4, 3, 5, 6, 3, 6].map(&mut sometimes);
        let field = |base: f64, slope: f64| {
            let from = points.first().map_or(0.0, |p| p[0]);
            Some(Field { from, base, slope }).filter(|field| positive(field.base).is_some())
        };
        let mut seeds = Seeds2::default().keep_concavities(once_in(random, 2));
        for _ in 0..random.below(3) {
            let at = nasty::query(random, points);
            let max_area = if once_in(random, 2) { positive(span * span * 0.01) } else { None };
            if once_in(random, 2) {
                seeds.holes.push(at);
            } else {
                seeds.regions.push(RegionSeed2::new(at).attribute(1.0).max_area(max_area));
            }
        }
        let height = if once_in(random, 3) { positive(0.05 * part(random)) } else { None };
        let layers = height.map(|height| {
            let growth = pick(random, &[1.0, 1.2, 1.5, 3.0]);
            (Layers2::new(height, 1 + random.below(6)).growth(growth), once_in(random, 2))
        });
        Self {
            layers,
            min_angle: pick(random, &[0.0, 1.0, 15.0, 20.0, 25.0, 28.6, 30.0, 33.0, 34.0, 45.0]),
            max_area: area.and_then(|x| positive(0.3 * x * x)),
            max_edge: edge,
            length,
            length_at: length_at.and_then(|x| field(0.2 * x, 0.3)),
            growth: pick(random, &[1.05, 1.2, 1.2, 1.5, 4.0]),
            size: size.and_then(|x| field(0.2 * x, 0.3)),
            area: area_at.and_then(|x| field(0.1 * x * x, 0.1 * x)),
            none_beyond: if once_in(random, 30) { points.last().map(|p| p[0]) } else { None },
            keep: pick(random, &[Keep::Nothing, Keep::Nothing, Keep::Border, Keep::Constraints]),
            conforming: once_in(random, 4),
            smooth: if once_in(random, 4) { 1 + random.below(3) } else { 0 },
            most: pick(random, &[0, 1, 7, 50, 300, 300, 2000]),
            stop: if once_in(random, 20) { Some(random.below(3)) } else { None },
            fill: pick(random, &[0, 0, 1, 1, 2, 3]),
            seeds,
            triangles: Vec::new(),
            arcs: Vec::new(),
        }
    }

    /// These criteria, with triangles that are given.
    pub(super) fn keeping(self, triangles: Vec<[VertexId; 3]>) -> Self {
        Self { triangles, ..self }
    }

    /// Whether directions of segments say nothing.
    pub(super) fn may_turn(&self) -> bool {
        self.fill != 2
    }

    pub(super) fn fill(&self) -> Fill<'_> {
        match self.fill {
            0 => Fill::All,
            1 => Fill::EvenOdd,
            2 => Fill::NonZero,
            _ => Fill::Seeds(&self.seeds),
        }
    }

    /// The largest area of a region's own, if there are regions.
    pub(super) fn area_of(&self, region: Option<usize>) -> Option<f64> {
        let own = region.filter(|_| self.fill == 3).and_then(|r| self.seeds.regions[r].max_area);
        [own, self.max_area].into_iter().flatten().reduce(f64::min)
    }

    /// These criteria, with the inside of other ones.
    pub(super) fn inside_of(self, other: &Self) -> Self {
        Self { fill: other.fill, seeds: other.seeds.clone(), ..self }
    }

    /// These criteria, with segments that are chords of arcs.
    pub(super) fn along(self, arcs: Vec<(SegmentId, Point)>) -> Self {
        Self { arcs, ..self }
    }

    /// These criteria, with an angle that is easier.
    pub(super) fn easier(&self) -> Self {
        let (length, length_at) = (None, None);
        let min_angle = 0.5 * self.min_angle;
        Self { min_angle, smooth: 0, stop: None, length, length_at, layers: None, ..self.clone() }
    }

    /// Does it.
    pub(super) fn run(&self, c: &mut Constrained2, fill: Fill) -> Result<Refined2, Error> {
        let size = |p: Point| match (self.none_beyond, self.size) {
            (Some(x), _) if p[0] > x => f64::NAN,
            (_, Some(field)) => field.at(p),
            _ => f64::INFINITY,
        };
        let length = |p: Point| self.length_at.map_or(f64::INFINITY, |field| field.at(p));
        let area = |p: Point| self.area.map_or(f64::INFINITY, |field| field.at(p));
        let asked = Cell::new(0);
        let stop = || asked.replace(asked.get() + 1) >= self.stop.unwrap_or(usize::MAX);
        let mut how = Refinement::new()
            .min_angle(self.min_angle)
            .keep(self.keep)
            .conforming(self.conforming)
            .smooth(self.smooth)
            .growth(self.growth)
            .max_vertices(self.most)
            .stop_if(&stop)
            .triangles(&self.triangles)
            .arcs(&self.arcs)
            .fill(fill);
        if let Some(most) = self.max_area {
            how = how.max_area(most);
        }
        if let Some(most) = self.max_edge {
            how = how.max_edge(most);
        }
        if let Some(length) = self.length {
            how = how.edge(length);
        }
        if self.length_at.is_some() {
            how = how.edge_at(&length);
        }
        if self.size.is_some() || self.none_beyond.is_some() {
            how = how.size(&size);
        }
        if self.area.is_some() {
            how = how.max_area_at(&area);
        }
        let layers = self.layers.clone().map(|(layers, is_on_all)| {
            if is_on_all { layers.on(c.segments().map(|(s, _)| s).collect()) } else { layers }
        });
        if let Some(layers) = &layers {
            how = how.layers(layers);
        }
        how.run(c)
    }
}
