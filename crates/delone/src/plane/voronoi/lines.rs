//! Voronoi cells of lines: each place belongs to the nearest line.
//!
//! The lines get sites along them, and the cells of the sites of a line are joined. A piece between two sites is divided
//!
//! - as long as another site is in the circle on it: without any the piece is in the cells of its ends, and no border crosses it;
//! - as long as one of its ends is the site of another line;
//! - as long as it reaches into a disc without sites about a border between lines, or about the rim of the region, by more than half of the
//!   tolerance: somewhere it is nearer than the sites tell;
//! - as long as a border beside it is farther than half of the tolerance from the exact bisector of both lines. This is measured at both
//!   ends and in the middle of each side of the border, by the distances from the pieces themselves.
//!
//! A piece of length h is nearer than its ends by at most h^2 / 8d at the distance d, and the border moves by at most h^2 / 8g, where g is the
//! distance between the nearest places of both lines. So pieces are about sqrt(8 g t) long for a tolerance t, whatever the distance is.
//! Where lines meet g goes to 0; there pieces are divided until they are at most half as long as the tolerance.
//!
//! It ends, because pieces are halved and have a least length. It is canonical: a function of the set of points and of each line.
//!
//! Cost: a triangulation of all sites in each round, O(log(length / tolerance)) rounds; the last few have most of the sites.

use std::collections::BTreeMap;

use delone_predicates::{angle, hypotenuse, lexicographic};

use super::VoronoiEdge2;
use super::cells::Cells2;
use super::crossed::{mark_crossed, middle};
use super::discs::Discs;
use crate::error::Error;
use crate::ids::{EdgeId, MAX_POINTS, VertexId};
use crate::plane::constrained::{Constrained2, Crossings, SegmentId};
use crate::plane::delaunay::Delaunay2;
use crate::plane::region::Region2;
use crate::points::Position2;
use crate::sorting;

/// A piece is not divided that is shorter than this part of the tolerance.
const LEAST_PIECE: f64 = 0.5;

/// Pieces are divided beside a border that is off by more than this part of the tolerance: between the three places where that is measured,
/// and by terms of second order, it may be off by more.
const MEASURED_PART: f64 = 0.5;

/// A piece at one of both sites of a border may reach this many times as far into discs around it: there the border itself is measured.
const OWN_REACH: f64 = 4.0;

/// Ends of borders are on the rim that are within this part of the width of the box. More stretches of the rim cost time only.
const RIM_ROUNDING: f64 = 1e-9;

/// The clipped Voronoi cells of lines.
///
/// ```
/// use delone::{LineCells2, Region2, VertexId};
///
/// // A wall, and a point-like pillar beside it: the border is a parabola.
/// let points = [[0.0, 0.0], [8.0, 0.0], [4.0, 2.0], [4.0, 2.001]];
/// let region = Region2::rectangle([0.0, 0.0], [8.0, 4.0])?;
/// let made = LineCells2::new(&points, &[[0, 1], [2, 3]], &[0, 1], &region, 0.001)?;
/// let area = made.cells.area(VertexId::new(1));
/// assert!((area - 8.0 * 3.0_f64.sqrt()).abs() < 0.02);
/// assert!(made.deviation <= 0.001);
/// # Ok::<(), delone::Error>(())
/// ```
#[doc(alias("segment Voronoi diagram", "medial axis", "Thiessen polygons of lines"))]
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct LineCells2 {
    /// The cells, by the number of the line.
    pub cells: Cells2,
    /// The sites along the lines.
    pub sites: Vec<[f64; 2]>,
    /// The line of each site: of several the one of the least number.
    pub lines: Vec<usize>,
    /// How often all sites were triangulated.
    pub rounds: usize,
    /// The largest distance of a border from the exact bisector of both lines, as measured at both ends and in the middle of each side.
    /// Beside pieces that are too short to be divided at most their length. Rounded, in coordinate units.
    pub deviation: f64,
    /// Pieces of lines that several lines share: they belong to the one of the least number.
    pub shared: usize,
}

impl LineCells2 {
    /// The cells of lines in a region. Segments are between points by index; `lines` has the line of each. Lines may cross, touch and overlap,
    /// and a segment without a length is a point.
    /// The tolerance is a length in coordinate units, more than 0.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a tolerance that is not positive and finite, and for fewer lines than segments;
    /// [`Error::TooManyPoints`] if so many sites would be needed that there are not enough indices; and those of
    /// [`Constrained2::with_crossings`].
    pub fn new<P: Position2>(
        points: &[P],
        segments: &[[usize; 2]],
        lines: &[usize],
        region: &Region2,
        tolerance: f64,
    ) -> Result<Self, Error> {
        checked(segments.len(), lines.len(), tolerance)?;
        let c = Constrained2::with_crossings(points, segments, Crossings::Split)?;
        let mut made = Self::default();
        let mut pieces = made.pieces(&c, |segment| lines[segment.index()]);
        made.points_of(points, segments, lines);
        let d = made.settle(&mut pieces, region, Borders { tolerance, cosine: None })?;
        let groups = lines.iter().max().map_or(0, |last| last + 1);
        let cells = d.voronoi().clip(region);
        made.cells = cells.joined(|site| made.lines.get(site.index()).copied(), groups);
        Ok(made)
    }

    /// Divides pieces until none must be. Gives the triangulation of all sites.
    pub(super) fn settle(
        &mut self,
        pieces: &mut Vec<Piece>,
        region: &Region2,
        borders: Borders,
    ) -> Result<Delaunay2, Error> {
        // Borders are as they were where no site is new or has another piece.
        let mut changed = vec![true; self.sites.len()];
        loop {
            self.rounds += 1;
            let d = Delaunay2::from_points(&self.sites)?;
            let (mut marked, mut deviation) = Round::new(self, pieces, &d, region, borders).run(&changed);
            if marked.is_empty() && changed.contains(&false) {
                changed.fill(true);
                (marked, deviation) = Round::new(self, pieces, &d, region, borders).run(&changed);
            }
            if marked.is_empty() {
                self.deviation = deviation;
                return Ok(d);
            }
            changed.fill(false);
            marked.iter().flat_map(|&piece| pieces[piece].ends).for_each(|end| changed[end] = true);
            self.divide(pieces, marked)?;
            changed.resize(self.sites.len(), true);
        }
    }

    /// The pieces that lines have at first: constraints between vertices.
    pub(super) fn pieces(&mut self, c: &Constrained2, line: impl Fn(SegmentId) -> usize) -> Vec<Piece> {
        let mut sites: Vec<Option<usize>> = vec![None; c.points().len()];
        let mut pieces = Vec::new();
        for (e, [v, w]) in c.constraint_edges().zip(c.constraints()) {
            let mut of: Vec<usize> =
                c.covering(e).into_iter().map(|covering| line(covering.segment)).collect();
            of.sort_unstable();
            of.dedup();
            let Some(&first) = of.first() else { continue };
            self.shared += usize::from(of.len() > 1);
            let ends = if lexicographic(c.point(v), c.point(w)).is_lt() { [v, w] } else { [w, v] };
            let ends = ends.map(|v| {
                let site = *sites[v.index()].get_or_insert_with(|| {
                    self.sites.push(c.point(v));
                    self.lines.push(first);
                    self.sites.len() - 1
                });
                self.lines[site] = self.lines[site].min(first);
                site
            });
            pieces.push(Piece { ends, line: first });
        }
        pieces
    }

    /// Segments without a length are places, too.
    pub(super) fn points_of<P: Position2>(&mut self, points: &[P], segments: &[[usize; 2]], lines: &[usize]) {
        let place = |i: usize| points[i].xy().map(|x| x + 0.0);
        let short = segments.iter().zip(lines).filter(|(ends, _)| place(ends[0]) == place(ends[1]));
        let short: Vec<([f64; 2], usize)> = short.map(|(ends, &line)| (place(ends[0]), line)).collect();
        if short.is_empty() {
            return;
        }
        let key = |p: [f64; 2]| p.map(|x| (x + 0.0).to_bits());
        let mut known: BTreeMap<[u64; 2], usize> = self.sites.iter().copied().map(key).zip(0..).collect();
        for (at, line) in short {
            let site = *known.entry(key(at)).or_insert(self.sites.len());
            if site == self.sites.len() {
                self.sites.push(at);
                self.lines.push(line);
            }
            self.lines[site] = self.lines[site].min(line);
        }
    }

    /// Halves pieces.
    fn divide(&mut self, pieces: &mut Vec<Piece>, marked: Vec<usize>) -> Result<(), Error> {
        if self.sites.len() + marked.len() > MAX_POINTS {
            return Err(Error::TooManyPoints { count: self.sites.len() + marked.len(), most: MAX_POINTS });
        }
        for piece in marked {
            let Piece { ends: [v, w], line } = pieces[piece];
            let [a, b] = [v, w].map(|site| self.sites[site]);
            let new = self.sites.len();
            self.sites.push(middle([a, b]));
            self.lines.push(line);
            pieces[piece].ends = [v, new];
            pieces.push(Piece { ends: [new, w], line });
        }
        Ok(())
    }
}

/// A piece of a line between two sites.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) ends: [usize; 2],
    line: usize,
}

/// The borders that count, and how exact they are to be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Borders {
    pub(super) tolerance: f64,
    /// Not those between lines, but where the nearest places on both sides are seen under an angle of at most this cosine.
    pub(super) cosine: Option<f64>,
}

/// The look at one triangulation.
pub(super) struct Round<'a> {
    made: &'a LineCells2,
    pieces: &'a [Piece],
    d: &'a Delaunay2,
    region: &'a Region2,
    borders: Borders,
    /// The pieces of its line at each site.
    at_sites: Vec<Vec<usize>>,
}

impl<'a> Round<'a> {
    pub(super) fn new(
        made: &'a LineCells2,
        pieces: &'a [Piece],
        d: &'a Delaunay2,
        region: &'a Region2,
        borders: Borders,
    ) -> Self {
        let mut at_sites: Vec<Vec<usize>> = vec![Vec::new(); made.sites.len()];
        for (number, piece) in pieces.iter().enumerate() {
            let own = piece.ends.into_iter().filter(|&site| made.lines[site] == piece.line);
            own.for_each(|site| at_sites[site].push(number));
        }
        Self { made, pieces, d, region, borders, at_sites }
    }

    /// The pieces that must be divided, and the largest deviation of a border, of all borders that changed sites have a part in.
    fn run(&self, changed: &[bool]) -> (Vec<usize>, f64) {
        let clear = self.clear_pieces();
        let may_be_crossed = (0..self.pieces.len()).filter(|&piece| !clear[piece]);
        let mut marked: Vec<usize> = may_be_crossed.filter(|&piece| self.may_be_divided(piece)).collect();
        let mut deviation: f64 = 0.0;
        let mesh = self.d.mesh();
        // Borders within one line are measured alone.
        let discs = self.borders.cosine.is_none().then(|| self.discs());
        for e in mesh.undirected_edges() {
            let sites = [mesh.origin(e), mesh.destination(e)].map(VertexId::index);
            let [one, other] = sites.map(|site| self.made.lines[site]);
            let is_between = one != other || self.borders.cosine.is_some();
            let around = [mesh.origin(e), mesh.destination(e), mesh.apex(e), mesh.apex(mesh.twin(e))];
            let is_changed = around.iter().any(|site| changed.get(site.index()) == Some(&true));
            if !is_between || !is_changed || !self.d.voronoi().has_length(e) {
                continue;
            }
            let Some([p, q]) = self.within(self.d.voronoi().edge(e)) else { continue };
            let middle = [0, 1].map(|k| 0.5 * p[k] + 0.5 * q[k]);
            if let Some(discs) = &discs {
                let is_own = |piece| sites.iter().any(|&site| self.at_sites[site].contains(&piece));
                let reach = |piece| if is_own(piece) { OWN_REACH } else { 1.0 };
                discs.mark([p, q], sites[0], reach, &mut marked);
            }
            for at in [p, middle, q] {
                let near = sites.map(|site| self.nearest(at, site));
                let Some((off, cosine)) = deviation_at(at, near.map(|near| near.0)) else { continue };
                if self.borders.cosine.is_some_and(|most| cosine > most) {
                    continue;
                }
                let divided: Vec<usize> = near
                    .iter()
                    .filter_map(|near| near.1)
                    .filter(|&piece| self.may_be_divided(piece))
                    .collect();
                let whole = near.iter().filter_map(|near| near.1).filter(|piece| !divided.contains(piece));
                let longest = whole.map(|piece| self.length(piece)).reduce(f64::max);
                // Where lines cross at a small angle, the measure is too large: borders stay between the lines.
                let off_there = if divided.is_empty() { off.min(longest.unwrap_or(off)) } else { off };
                deviation = deviation.max(off_there);
                if off > MEASURED_PART * self.borders.tolerance {
                    marked.extend(divided);
                }
            }
        }
        match &discs {
            Some(discs) => self.mark_rim(discs, &mut marked),
            None => self.mark_far(changed, &mut marked),
        }
        marked.sort_unstable();
        marked.dedup();
        mark_crossed(&self.made.sites, self.pieces, &self.divisible(), &mut marked);
        (marked, deviation)
    }

    fn ends(&self, piece: usize) -> [[f64; 2]; 2] {
        self.pieces[piece].ends.map(|site| self.made.sites[site])
    }

    /// The pieces that may be divided.
    fn divisible(&self) -> Vec<usize> {
        (0..self.pieces.len()).filter(|&piece| self.may_be_divided(piece)).collect()
    }

    /// The pieces that may be divided, to be asked about discs.
    fn discs(&self) -> Discs<'_> {
        let depth = MEASURED_PART * self.borders.tolerance;
        Discs::new(&self.made.sites, self.pieces, self.divisible(), depth)
    }

    /// Marks pieces that reach into the box around the region through a stretch of its border that is in the cell of another line.
    fn mark_rim(&self, discs: &Discs<'_>, marked: &mut Vec<usize>) {
        let [low, high] = self.region.bounds();
        // Of each side of the box the axis across it, the coordinate on that, and how far along it borders cross it.
        let mut rim = [(0, low), (1, low), (0, high), (1, high)]
            .map(|(across, corner)| (across, corner[across], vec![low[1 - across], high[1 - across]]));
        let mesh = self.d.mesh();
        let is_within = |at: [f64; 2]| (0..2).all(|k| low[k] < at[k] && at[k] < high[k]);
        let mut has_center_within = vec![false; 1 + mesh.triangles().map(|t| t.index()).max().unwrap_or(0)];
        for t in mesh.triangles() {
            has_center_within[t.index()] = self.d.circumcenter(t).is_some_and(is_within);
        }
        let is_within_at = |e: EdgeId| has_center_within.get(e.triangle().index()) == Some(&true);
        let may_cross = |e: EdgeId| !is_within_at(e) || !is_within_at(mesh.twin(e));
        for e in mesh.undirected_edges().filter(|&e| may_cross(e) && self.d.voronoi().has_length(e)) {
            let Some(ends) = self.within(self.d.voronoi().edge(e)) else { continue };
            for end in ends {
                for (across, at, along) in &mut rim {
                    let is_there =
                        (end[*across] - *at).abs() <= RIM_ROUNDING * (high[*across] - low[*across]);
                    along.extend(is_there.then_some(end[1 - *across]));
                }
            }
        }
        for (across, at, mut along) in rim {
            along.sort_unstable_by(f64::total_cmp);
            along.dedup();
            for stretch in along.windows(2) {
                let place = |x: f64| if across == 0 { [at, x] } else { [x, at] };
                let middle = place(stretch[0].midpoint(stretch[1]));
                let Ok(Some(site)) = self.d.nearest(middle) else { continue };
                let own = self.made.lines[site.index()];
                let reach = |piece: usize| if self.pieces[piece].line == own { f64::INFINITY } else { 1.0 };
                discs.mark([place(stretch[0]), place(stretch[1])], site.index(), reach, marked);
            }
        }
    }

    /// Marks pieces that are nearer to a Voronoi vertex than their ends, by more than a part of the tolerance. Without that there may be no border
    /// to measure: of a rectangle by its corners the diagram is one vertex.
    fn mark_far(&self, changed: &[bool], marked: &mut Vec<usize>) {
        let mesh = self.d.mesh();
        let [low, high] = self.region.bounds();
        for t in mesh.triangles().filter(|&t| mesh.corners(t).iter().any(|site| changed[site.index()])) {
            let Some(at) = self.d.circumcenter(t) else { continue };
            let is_within = [0, 1].into_iter().all(|k| low[k] <= at[k] && at[k] <= high[k]);
            let distance = |p: [f64; 2]| hypotenuse(p[0] - at[0], p[1] - at[1]);
            for site in mesh.corners(t).map(VertexId::index).into_iter().filter(|_| is_within) {
                let (near, piece) = self.nearest(at, site);
                let nearer = distance(self.made.sites[site]) - distance(near);
                if nearer > MEASURED_PART * self.borders.tolerance {
                    marked.extend(piece.filter(|&piece| self.may_be_divided(piece)));
                }
            }
        }
    }

    fn length(&self, piece: usize) -> f64 {
        let [a, b] = self.ends(piece);
        hypotenuse(b[0] - a[0], b[1] - a[1])
    }

    fn may_be_divided(&self, piece: usize) -> bool {
        let ends = self.ends(piece);
        !ends.contains(&middle(ends)) && self.length(piece) > LEAST_PIECE * self.borders.tolerance
    }

    /// For each piece, whether it is an edge with no site in the circle on it, and both ends are sites of its line.
    fn clear_pieces(&self) -> Vec<bool> {
        let mesh = self.d.mesh();
        let sorted = |[v, w]: [usize; 2]| [v.min(w), v.max(w)];
        let mut order: Vec<usize> = (0..self.pieces.len()).collect();
        sorting::by(&mut order, |&i, &j| sorted(self.pieces[i].ends).cmp(&sorted(self.pieces[j].ends)));
        let mut is_clear = vec![false; self.pieces.len()];
        for e in mesh.undirected_edges() {
            let ends = sorted([mesh.origin(e), mesh.destination(e)].map(VertexId::index));
            let found = order.binary_search_by(|&piece| sorted(self.pieces[piece].ends).cmp(&ends));
            let Ok(piece) = found.map(|at| order[at]) else { continue };
            let [a, b] = ends.map(|site| self.made.sites[site]);
            let is_in_circle =
                |site: VertexId| !site.is_ghost() && angle(self.made.sites[site.index()], a, b).is_negative();
            let is_own = ends.iter().all(|&site| self.made.lines[site] == self.pieces[piece].line);
            is_clear[piece] = is_own && ![e, mesh.twin(e)].into_iter().any(|e| is_in_circle(mesh.apex(e)));
        }
        is_clear
    }

    /// The nearest place to a point on the pieces at a site, and the piece, unless it is the site.
    pub(super) fn nearest(&self, at: [f64; 2], site: usize) -> ([f64; 2], Option<usize>) {
        let own = self.made.sites[site];
        // No square overflows or vanishes.
        let distance = |p: [f64; 2]| hypotenuse(p[0] - at[0], p[1] - at[1]);
        let mut best = (own, None);
        for &piece in &self.at_sites[site] {
            let place = nearest_on(at, self.pieces[piece].ends.map(|site| self.made.sites[site]));
            if distance(place) < distance(best.0) {
                best = (place, Some(piece));
            }
        }
        best
    }

    /// The part of an edge of the diagram that is in the box around the region.
    fn within(&self, edge: VoronoiEdge2) -> Option<[[f64; 2]; 2]> {
        let (from, way, [mut low, mut high]) = match edge {
            VoronoiEdge2::Segment([p, q]) => (p, [q[0] - p[0], q[1] - p[1]], [0.0, 1.0]),
            VoronoiEdge2::Ray { from, direction } => (from, direction, [0.0, f64::INFINITY]),
            VoronoiEdge2::Line { through, direction } => {
                (through, direction, [f64::NEG_INFINITY, f64::INFINITY])
            }
        };
        let bounds = self.region.bounds();
        for k in 0..2 {
            let [near, far] = bounds.map(|corner| (corner[k] - from[k]) / way[k]);
            if way[k] == 0.0 {
                if from[k] < bounds[0][k] || from[k] > bounds[1][k] {
                    return None;
                }
            } else {
                low = low.max(near.min(far));
                high = high.min(near.max(far));
            }
        }
        let place = |t: f64| [from[0] + t * way[0], from[1] + t * way[1]];
        (low <= high && low.is_finite() && high.is_finite()).then(|| [place(low), place(high)])
    }
}

/// Whether there is a line for each segment, and a tolerance.
pub(super) fn checked(segments: usize, lines: usize, tolerance: f64) -> Result<(), Error> {
    let refused = |name, value, range| Err(Error::Parameter { name, value, range });
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        return refused("tolerance", tolerance, "positive and finite");
    }
    if lines != segments {
        return refused("lines", lines as f64, "one for each segment");
    }
    Ok(())
}

/// The place of a segment that is nearest to a point.
pub(super) fn nearest_on(at: [f64; 2], [a, b]: [[f64; 2]; 2]) -> [f64; 2] {
    let length = hypotenuse(b[0] - a[0], b[1] - a[1]);
    let way = [0, 1].map(|k| (b[k] - a[k]) / length);
    let along = way[0] * (at[0] - a[0]) + way[1] * (at[1] - a[1]);
    if along > 0.0 && along < length {
        [a[0] + along * way[0], a[1] + along * way[1]]
    } else if along >= length {
        b
    } else {
        a
    }
}

/// How far a place is from the bisector of two others, to first order, and the cosine of the angle that it sees them under. Nothing
/// if these are one place.
pub(super) fn deviation_at(at: [f64; 2], near: [[f64; 2]; 2]) -> Option<(f64, f64)> {
    let ways = near.map(|p| [p[0] - at[0], p[1] - at[1]]);
    let lengths = ways.map(|way| hypotenuse(way[0], way[1]));
    let units = [0, 1].map(|i| ways[i].map(|x| x / lengths[i]));
    let steepness = hypotenuse(units[0][0] - units[1][0], units[0][1] - units[1][1]);
    let off = (lengths[0] - lengths[1]).abs() / steepness;
    let cosine = units[0][0] * units[1][0] + units[0][1] * units[1][1];
    (!off.is_nan()).then_some((off, cosine))
}
