//! Inside and outside: the parts of the hull that constraints bound, and the domain of each.
//!
//! A flood over edges that are no constraints gives the parts. Across a constraint the winding number changes by the segments
//! that cover it, those in one direction less those in the other; their number decides parity. So one search from infinity over
//! the parts tells how deep each is.
//!
//! Cost: O(n), and O(m log m) for m constraint edges where segments overlap, have directions or are no borders. Four bytes a
//! triangle.

use super::overlaps::{self, Weight};
use super::refined::Origin;
use super::{Constrained2, SegmentId};
use crate::error::Error;
use crate::ids::{EdgeId, TriangleId, VertexId};
use crate::plane::Location2;
use crate::points::finite;
use crate::sorting;

/// The rule for what is inside.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Fill<'a> {
    /// Everything in the hull.
    #[default]
    All,
    /// Inside is what an odd number of segments surrounds. Rings may come in any direction; where segments do not close, the way to
    /// infinity across the fewest of them counts.
    EvenOdd,
    /// Inside is where the winding number of the segments is not zero.
    NonZero,
    /// Inside is where it is more than zero: in counter-clockwise rings.
    Positive,
    /// Inside is where it is less than zero: in clockwise rings.
    Negative,
    /// Inside is the hull without its holes, given by a point in each, and without the parts that no constraint separates from the
    /// outside; as Triangle has it.
    Seeds(&'a Seeds2),
    /// Inside is as in these parts, with their regions. They are parts of this triangulation as it is: a mesh that is refined again keeps what
    /// it has, as its borders may have bent past seeds, or away from the hull; and where it could not be better, no vertex is added.
    Parts(&'a Domains2),
}

/// Points in holes and regions.
///
/// ```
/// use delone::{RegionSeed2, Seeds2};
///
/// let fine = RegionSeed2::new([3.0, 1.0]).attribute(7.0).max_area(0.1);
/// let seeds = Seeds2::default().holes(vec![[1.0, 1.0]]).regions(vec![fine]);
/// assert!(!seeds.keep_concavities && seeds.regions[0].max_area == Some(0.1));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Seeds2 {
    /// A point in each hole.
    pub holes: Vec<[f64; 2]>,
    /// A point in each region, and what is known of it.
    pub regions: Vec<RegionSeed2>,
    /// Whether bays of the hull stay that no constraint closes.
    pub keep_concavities: bool,
}

/// A point in a region, and what is known of the region.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RegionSeed2 {
    /// The point.
    pub at: [f64; 2],
    /// A value for all triangles of the region.
    pub attribute: f64,
    /// The largest area that a triangle of the region should have, for refinement.
    pub max_area: Option<f64>,
}

impl Seeds2 {
    /// Sets [`Self::holes`].
    #[must_use]
    pub fn holes(self, holes: Vec<[f64; 2]>) -> Self {
        Self { holes, ..self }
    }

    /// Sets [`Self::regions`].
    #[must_use]
    pub fn regions(self, regions: Vec<RegionSeed2>) -> Self {
        Self { regions, ..self }
    }

    /// Sets [`Self::keep_concavities`].
    #[must_use]
    pub fn keep_concavities(self, keep_concavities: bool) -> Self {
        Self { keep_concavities, ..self }
    }
}

impl RegionSeed2 {
    /// A region of attribute 0, without a largest area.
    pub fn new(at: [f64; 2]) -> Self {
        Self { at, attribute: 0.0, max_area: None }
    }

    /// Sets [`Self::attribute`].
    #[must_use]
    pub fn attribute(self, attribute: f64) -> Self {
        Self { attribute, ..self }
    }

    /// Sets [`Self::max_area`]: an area, or `None`.
    #[must_use]
    pub fn max_area(self, area: impl Into<Option<f64>>) -> Self {
        Self { max_area: area.into(), ..self }
    }
}

/// A part of the hull that constraints bound.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Part2 {
    /// Whether it is inside, as the fill says.
    pub is_inside: bool,
    /// How often the segments that are borders wind around it, counter-clockwise less clockwise; 0 where nobody asked.
    pub winding: i32,
    /// Whether it is a boundary layer ([`crate::Layers2`]): inside, and not refined again.
    pub is_layer: bool,
    /// The region whose seed is in it, by index; or the polygon that it is in ([`Constrained2::claim_polygons`]).
    pub region: Option<usize>,
    /// The number of its triangles.
    pub triangles: usize,
}

/// The parts of a constrained triangulation at some time. Triangles of later changes are in none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Domains2 {
    /// For each triangle its part; [`NONE`] for ghosts.
    pub(super) of: Vec<u32>,
    pub(super) parts: Vec<Part2>,
    pub(in crate::plane) regions: Vec<Known>,
    /// Pairs of regions that claim one part; the first one has it.
    rivals: Vec<[usize; 2]>,
    /// The origin of each vertex, by id, if the triangulation was refined.
    pub(in crate::plane) origins: Vec<Origin>,
    /// The segments that only keep triangles, if it was refined with such.
    pub(in crate::plane) kept: Vec<SegmentId>,
    /// The lines and ribs of boundary layers.
    pub(in crate::plane) layered: Vec<SegmentId>,
    /// Of layers: their vertices, the most rows, places, and how many of these have fewer.
    pub(in crate::plane) layer_counts: [usize; 4],
}

/// A region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::plane) struct Known {
    pub(super) attribute: f64,
    pub(in crate::plane) max_area: Option<f64>,
    pub(in crate::plane) max_edge: Option<f64>,
}

pub(super) const NONE: u32 = u32::MAX;

impl Domains2 {
    /// The part that a triangle is in; `None` for a ghost.
    pub fn part(&self, t: TriangleId) -> Option<usize> {
        self.of.get(t.index()).filter(|&&part| part != NONE).map(|&part| part as usize)
    }

    /// All parts. They are numbered by their triangles with the least vertices.
    pub fn parts(&self) -> &[Part2] {
        &self.parts
    }

    /// Whether a triangle is inside.
    pub fn is_inside(&self, t: TriangleId) -> bool {
        self.part(t).is_some_and(|part| self.parts[part].is_inside)
    }

    /// Whether a triangle is of a boundary layer; it is inside, too.
    pub fn is_layer(&self, t: TriangleId) -> bool {
        self.part(t).is_some_and(|part| self.parts[part].is_layer)
    }

    /// The region that a triangle is in, by the index of its seed or polygon.
    pub fn region(&self, t: TriangleId) -> Option<usize> {
        self.part(t).and_then(|part| self.parts[part].region)
    }

    /// The attribute of the region that a triangle is in.
    pub fn attribute(&self, t: TriangleId) -> Option<f64> {
        self.region(t).map(|region| self.regions[region].attribute)
    }

    /// Gives no part a region.
    pub(super) fn forget_regions(&mut self) {
        self.parts.iter_mut().for_each(|part| part.region = None);
        self.regions.clear();
        self.rivals.clear();
    }

    /// Pairs of regions whose seeds are in one part. The first of each pair has it.
    pub fn rivals(&self) -> &[[usize; 2]] {
        &self.rivals
    }
}

/// A number of borders, and how often they wind around what is behind them.
type Depth = (usize, i32);

impl Constrained2 {
    /// The parts of the hull, and which of them are inside. All segments are borders.
    ///
    /// # Errors
    /// [`Error::Seed`] for a seed on a constraint or outside of the hull, [`Error::Coordinate`] for one that is not finite,
    /// [`Error::Parts`] for parts of another triangulation.
    ///
    /// ```
    /// use delone::{Constrained2, Fill};
    ///
    /// let points = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 1], [2, 3]];
    /// let rings = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]];
    /// let c = Constrained2::from_parts(&points, &rings)?;
    /// let domains = c.domains(&Fill::EvenOdd)?;
    /// let inside = c.triangle_ids().filter(|&t| domains.is_inside(t));
    /// assert_eq!(inside.map(|t| c.area(t)).sum::<f64>(), 14.0); // without the hole
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn domains(&self, fill: &Fill) -> Result<Domains2, Error> {
        self.domains_within(fill, |_| true)
    }

    /// The same, but only some segments are borders for [`Fill::EvenOdd`] and the rules of winding numbers; the others are constraints
    /// with the same on both sides.
    ///
    /// # Errors
    /// As [`Self::domains`].
    pub fn domains_within(
        &self,
        fill: &Fill,
        is_border: impl Fn(SegmentId) -> bool,
    ) -> Result<Domains2, Error> {
        let mut domains = self.parts();
        let count = domains.parts.len();
        match fill {
            Fill::Parts(known) if self.is_parted_by(known) => return Ok((*known).clone()),
            Fill::Parts(_) => return Err(Error::Parts),
            Fill::All => domains.parts.iter_mut().for_each(|part| part.is_inside = true),
            Fill::EvenOdd | Fill::NonZero | Fill::Positive | Fill::Negative => {
                let weights = self.weights(is_border);
                let depths = self.depths(&domains, &weights);
                for (part, (covered, winding)) in domains.parts.iter_mut().zip(depths) {
                    part.winding = winding;
                    part.is_inside = match fill {
                        Fill::EvenOdd => covered % 2 == 1,
                        Fill::Positive => winding > 0,
                        Fill::Negative => winding < 0,
                        _ => winding != 0,
                    };
                }
            }
            Fill::Seeds(seeds) => {
                let mut outside = vec![false; count];
                if !seeds.keep_concavities {
                    for e in self.hull_edges().filter(|&e| !self.is_constraint(e)) {
                        outside[domains.of[e.triangle().index()] as usize] = true;
                    }
                }
                for (index, &at) in seeds.holes.iter().enumerate() {
                    outside[self.seeded(&domains, "hole", index, at)?] = true;
                }
                self.claim(&mut domains, &seeds.regions)?;
                domains.parts.iter_mut().zip(outside).for_each(|(part, outside)| part.is_inside = !outside);
            }
        }
        Ok(domains)
    }

    /// Gives parts to the regions whose seeds are in them, whatever says what is inside. Regions of before are forgotten.
    ///
    /// # Errors
    /// As [`Self::domains`]; no part has a region then.
    pub fn claim(&self, domains: &mut Domains2, regions: &[RegionSeed2]) -> Result<(), Error> {
        domains.forget_regions();
        let parts =
            regions.iter().enumerate().map(|(index, seed)| self.seeded(domains, "region", index, seed.at));
        let parts: Vec<usize> = parts.collect::<Result<_, _>>()?;
        for (index, part) in parts.into_iter().enumerate() {
            match domains.parts[part].region {
                None => domains.parts[part].region = Some(index),
                Some(first) => domains.rivals.push([first, index]),
            }
        }
        let known =
            |seed: &RegionSeed2| Known { attribute: seed.attribute, max_area: seed.max_area, max_edge: None };
        domains.regions = regions.iter().map(known).collect();
        Ok(())
    }

    /// Whether parts are of this triangulation as it is: constraints alone are around what is inside. Beyond the hull of before a border
    /// that bent may have triangles of no part beside those outside.
    fn is_parted_by(&self, domains: &Domains2) -> bool {
        let mesh = self.mesh();
        let inside = |t: TriangleId| domains.part(t).filter(|&part| domains.parts[part].is_inside);
        let is_same = |e: EdgeId| {
            let other = mesh.twin(e).triangle();
            mesh.is_fixed(e) || mesh.is_ghost(other) || inside(other) == inside(e.triangle())
        };
        domains.of.len() == mesh.slot_count()
            && mesh.triangles().all(|t| [0, 1, 2].into_iter().all(|k| is_same(t.edge(k))))
    }

    /// The part that a seed is in.
    fn seeded(
        &self,
        domains: &Domains2,
        what: &'static str,
        index: usize,
        at: [f64; 2],
    ) -> Result<usize, Error> {
        let refused = |place| Err(Error::Seed { what, index, at, place });
        finite(at)?;
        let mesh = self.mesh();
        let of = |e: EdgeId| [e, mesh.twin(e)].into_iter().find_map(|e| domains.part(e.triangle()));
        let part = match self.locate(at)? {
            Location2::Triangle(t) => domains.part(t),
            Location2::Edge(e) if self.is_constraint(e) => return refused("on a constraint"),
            Location2::Edge(e) => of(e),
            Location2::Vertex(v) if mesh.star(v).any(|e| self.is_constraint(e)) => {
                return refused("on an end of a constraint");
            }
            Location2::Vertex(v) => mesh.star(v).find_map(of),
            Location2::Outside(_) | Location2::LowerDimensional(_) => None,
        };
        part.map_or_else(|| refused("outside of the hull"), Ok)
    }

    /// The edges of the hull, seen from inside.
    pub(super) fn hull_edges(&self) -> impl Iterator<Item = EdgeId> + '_ {
        let mesh = self.mesh();
        let spanned = self.graph.base.spanned;
        mesh.star_from(mesh.ghost_edge).filter(move |_| spanned).map(|e| mesh.twin(e.next()))
    }

    /// The parts, not told apart yet.
    pub(super) fn parts(&self) -> Domains2 {
        let mesh = self.mesh();
        let mut of = vec![NONE; mesh.slot_count()];
        let mut found: Vec<([VertexId; 3], Part2)> = Vec::new();
        let mut pending = Vec::new();
        for first in mesh.triangles() {
            if of[first.index()] != NONE {
                continue;
            }
            let number = found.len() as u32;
            let mut part =
                Part2 { is_inside: false, winding: 0, is_layer: false, region: None, triangles: 0 };
            let mut least = [VertexId::GHOST; 3];
            of[first.index()] = number;
            pending.push(first);
            while let Some(t) = pending.pop() {
                part.triangles += 1;
                let mut corners = mesh.corners(t);
                corners.sort_unstable();
                least = least.min(corners);
                for e in [0, 1, 2].map(|k| t.edge(k)) {
                    let next = mesh.twin(e).triangle();
                    if of[next.index()] == NONE && !mesh.is_fixed(e) && !mesh.is_ghost(next) {
                        of[next.index()] = number;
                        pending.push(next);
                    }
                }
            }
            found.push((least, part));
        }
        let mut order: Vec<u32> = (0..found.len() as u32).collect();
        sorting::by_key(&mut order, |&part| found[part as usize].0);
        let mut number = vec![0; found.len()];
        order.iter().enumerate().for_each(|(new, &old)| number[old as usize] = new as u32);
        of.iter_mut().filter(|part| **part != NONE).for_each(|part| *part = number[*part as usize]);
        let parts = order.iter().map(|&part| found[part as usize].1).collect();
        Domains2 { of, parts, ..Domains2::default() }
    }

    /// The change of the winding number across each constraint edge, from its right to its left. Only segments that are borders count.
    fn weights(&self, is_border: impl Fn(SegmentId) -> bool) -> Vec<Weight> {
        let borders = self.segments().map(|(s, _)| s).filter(|&s| is_border(s));
        let pieces = borders.flat_map(|s| self.places_of(s));
        overlaps::weights(self.ground(), pieces).expect("segments are constraints")
    }

    /// For each part a number of borders between it and infinity, and how often they wind around it.
    ///
    /// Around closed chains all ways agree. Where open ones make them differ, the way across the fewest constraints counts, and
    /// of several the one with the least numbers, so that the answer does not depend on where the search begins.
    fn depths(&self, domains: &Domains2, weights: &[Weight]) -> Vec<Depth> {
        let mesh = self.mesh();
        let beyond = |(count, winding): Depth, (more, covering): (i32, usize)| {
            (count + covering, winding.saturating_add(more))
        };
        let borders = self.borders(domains, weights);
        let mut depths: Vec<Option<Depth>> = vec![None; domains.parts.len()];
        // The parts that are entered, and how deep they are then. From outside it is over hull edges, of which not all are constraints.
        let from_outside = |e: EdgeId| {
            let twin = mesh.twin(e);
            let found = weights.binary_search_by_key(&e.min(twin), |weight| weight.0);
            let (along, count) = found.map_or((0, 0), |at| (weights[at].1, weights[at].2));
            let more = if e < twin { along } else { -along };
            Some((domains.part(e.triangle())?, beyond((0, 0), (more, count))))
        };
        let mut entered: Vec<(usize, Depth)> = self.hull_edges().filter_map(from_outside).collect();
        while !entered.is_empty() {
            let mut reached = std::mem::take(&mut entered);
            reached.retain(|(part, _)| depths[*part].is_none());
            reached.sort_unstable();
            reached.dedup_by_key(|(part, _)| *part);
            for &(part, depth) in &reached {
                depths[part] = Some(depth);
                let start = borders.partition_point(|border| (border.part as usize) < part);
                let of_part = borders[start..].iter().take_while(|border| border.part as usize == part);
                let next = of_part.filter_map(|border| {
                    let other = domains.part(border.outside.triangle())?;
                    Some((other, beyond(depth, (border.more, border.covering))))
                });
                entered.extend(next.filter(|(other, _)| depths[*other].is_none()));
            }
        }
        depths.into_iter().map(Option::unwrap_or_default).collect()
    }

    /// The constraint edges around each part, part by part.
    fn borders(&self, domains: &Domains2, weights: &[Weight]) -> Vec<Border> {
        let mesh = self.mesh();
        let mut weights = weights.iter().peekable();
        // Both are in the order of the edges, so each weight is met in passing.
        let both = self.constraint_edges().flat_map(|e| {
            while weights.next_if(|weight| weight.0 < e).is_some() {}
            let (along, covering) =
                weights.peek().filter(|weight| weight.0 == e).map_or((0, 0), |weight| (weight.1, weight.2));
            let twin = mesh.twin(e);
            let part = |e: EdgeId| domains.of[e.triangle().index()];
            // Left of the edge is more than right of it.
            [
                Border { part: part(e), outside: twin, more: -along, covering },
                Border { part: part(twin), outside: e, more: along, covering },
            ]
        });
        let mut borders: Vec<Border> = both.collect();
        sorting::by_key(&mut borders, |border| border.part);
        borders
    }
}

/// A constraint edge seen from inside of a part: what is behind it, how much more segments wind around that, and how many
/// cover the edge.
#[derive(Clone, Copy)]
struct Border {
    part: u32,
    outside: EdgeId,
    more: i32,
    covering: usize,
}
