//! Polygons as regions: which polygon each part is in.
//!
//! A ring parts its inside from its outside. Across a constraint the winding numbers of the rings that cover it change by one; so one walk
//! over the parts, from infinity and back, tells those of all rings. Numbers decide, and no coordinate is asked for.
//!
//! Cost: O(m log m) for m constraint edges, and as much memory.

use std::collections::{BTreeMap, BTreeSet};

use super::domains::{Domains2, Known};
use super::shells::filled_shells;
use super::{Constrained2, SegmentId};
use crate::ids::EdgeId;

/// The properties of a polygon that is a region.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PolygonRegion2 {
    /// A value for all triangles of the region.
    pub attribute: f64,
    /// The largest area that a triangle of the region should have, for refinement.
    pub max_area: Option<f64>,
    /// The largest length of edges in the region and around it; with [`crate::Refinement::edge`] the length that they are to have.
    pub max_edge: Option<f64>,
}

impl PolygonRegion2 {
    /// A region without bounds of sizes.
    pub fn new(attribute: f64) -> Self {
        Self { attribute, max_area: None, max_edge: None }
    }

    /// Sets [`Self::max_area`]: an area, or `None`.
    #[must_use]
    pub fn max_area(self, area: impl Into<Option<f64>>) -> Self {
        Self { max_area: area.into(), ..self }
    }

    /// Sets [`Self::max_edge`]: a length, or `None`.
    #[must_use]
    pub fn max_edge(self, length: impl Into<Option<f64>>) -> Self {
        Self { max_edge: length.into(), ..self }
    }
}

/// The region of a part that is in several polygons.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Overlaps2 {
    /// The last of them.
    #[default]
    Last,
    /// The first of them.
    First,
    /// The one of the smallest area, rounded; of equal ones the last.
    Smallest,
    /// A region of its own for each set of polygons, with the smallest of their sizes.
    Combined,
}

/// Which places are in a polygon.
#[derive(Clone, Copy, Default)]
#[non_exhaustive]
pub enum Membership2<'a> {
    /// An odd number of its segments is around them.
    #[default]
    EvenOdd,
    /// The winding number of its segments is not zero.
    NonZero,
    /// They are in a shell of it and in none of the holes of that shell, as [`Constrained2::shells_minus_holes`] has it.
    Shells {
        /// The ring of a segment.
        ring: &'a dyn Fn(SegmentId) -> Option<usize>,
        /// The shell of each ring: of a shell, itself.
        shells: &'a [usize],
    },
}

/// How often rings wind around a part, by their numbers; not those of 0.
pub(super) type Windings = BTreeMap<usize, i32>;

/// A border between two parts, seen from one of them: the other part, and the constraint with the one on its left, if there is one.
type Border = (usize, Option<EdgeId>);

impl Constrained2 {
    /// Gives each part to a polygon that it is in, as its region: of several the last. A polygon is what an odd number of its segments is
    /// around; `polygon` tells which one a segment is of, and `attributes` has the value of each polygon, by its index. Regions of
    /// before are forgotten.
    ///
    /// Segments of a polygon form closed rings. Where they do not, parts beyond the gap are in the polygon or not as the walk comes.
    ///
    /// # Panics
    /// If there is no attribute for a polygon.
    ///
    /// ```
    /// use delone::{Constrained2, Fill};
    ///
    /// // Two squares beside each other.
    /// let points = [[0, 0], [1, 0], [2, 0], [2, 1], [1, 1], [0, 1]];
    /// let segments = [[0, 1], [1, 4], [4, 5], [5, 0], [1, 2], [2, 3], [3, 4], [4, 1]];
    /// let c = Constrained2::from_parts(&points, &segments)?;
    /// let mut domains = c.domains(&Fill::EvenOdd)?;
    /// c.claim_polygons(&mut domains, |segment| Some(segment.index() / 4), &[10.0, 20.0]);
    /// let mut found: Vec<_> = c.triangle_ids().filter_map(|t| domains.attribute(t)).collect();
    /// found.sort_by(f64::total_cmp);
    /// assert_eq!(found, [10.0, 10.0, 20.0, 20.0]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn claim_polygons(
        &self,
        domains: &mut Domains2,
        polygon: impl Fn(SegmentId) -> Option<usize>,
        attributes: &[f64],
    ) {
        let regions: Vec<PolygonRegion2> = attributes.iter().copied().map(PolygonRegion2::new).collect();
        self.claim_polygons_as(domains, polygon, &regions, Overlaps2::Last, Membership2::EvenOdd);
    }

    /// As [`Self::claim_polygons`], with sizes for refinement, a rule for parts in several polygons, and one for which polygons a part is in. Gives the polygons of each combined
    /// region: its index is that in the result, after all polygons, and its attribute is the index plus 1.
    ///
    /// # Panics
    /// If there is no region for a polygon, or no shell for a ring.
    ///
    /// ```
    /// use delone::{Constrained2, Fill, Membership2, Overlaps2, PolygonRegion2};
    ///
    /// // A square in a larger one.
    /// let points = [[0, 0], [9, 0], [9, 9], [0, 9], [2, 2], [4, 2], [4, 4], [2, 4]];
    /// let segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]];
    /// let c = Constrained2::from_parts(&points, &segments)?;
    /// let mut domains = c.domains(&Fill::NonZero)?;
    /// let regions = [PolygonRegion2::new(1.0), PolygonRegion2::new(2.0)];
    /// let polygon = |s: delone::SegmentId| Some(s.index() / 4);
    /// let made = c.claim_polygons_as(&mut domains, polygon, &regions, Overlaps2::Combined, Membership2::EvenOdd);
    /// assert_eq!(made, [[0, 1]]);
    /// let inner = c.triangle_ids().find(|&t| domains.region(t) == Some(2)).expect("the inner square");
    /// assert_eq!(domains.attribute(inner), Some(3.0));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn claim_polygons_as(
        &self,
        domains: &mut Domains2,
        polygon: impl Fn(SegmentId) -> Option<usize>,
        regions: &[PolygonRegion2],
        overlaps: Overlaps2,
        membership: Membership2<'_>,
    ) -> Vec<Vec<usize>> {
        domains.forget_regions();
        let around = self.polygons_of_parts(domains, polygon, membership);
        let areas =
            if overlaps == Overlaps2::Smallest { self.areas_of(domains, &around) } else { BTreeMap::new() };
        let combined: BTreeSet<&[usize]> = match overlaps {
            Overlaps2::Combined => around.iter().filter(|all| all.len() > 1).map(Vec::as_slice).collect(),
            _ => BTreeSet::new(),
        };
        let combined: Vec<Vec<usize>> = combined.into_iter().map(<[usize]>::to_vec).collect();
        let smaller = |a: &&usize, b: &&usize| areas[*a].total_cmp(&areas[*b]).then_with(|| b.cmp(a));
        for (part, all) in domains.parts.iter_mut().zip(&around) {
            part.region = match overlaps {
                Overlaps2::Last => all.last().copied(),
                Overlaps2::First => all.first().copied(),
                Overlaps2::Smallest => all.iter().min_by(smaller).copied(),
                Overlaps2::Combined => match combined.binary_search(all) {
                    Ok(number) => Some(regions.len() + number),
                    Err(_) => all.last().copied(),
                },
            };
        }
        let least = |a: Option<f64>, b: Option<f64>| a.into_iter().chain(b).reduce(f64::min);
        let of_all = |(number, all): (usize, &Vec<usize>)| {
            let sizes = all.iter().map(|&polygon| regions[polygon]);
            let together = sizes.reduce(|a, b| PolygonRegion2 {
                max_area: least(a.max_area, b.max_area),
                max_edge: least(a.max_edge, b.max_edge),
                ..a
            });
            let number = (regions.len() + number + 1) as f64;
            PolygonRegion2 { attribute: number, ..together.unwrap_or(PolygonRegion2::new(number)) }
        };
        let known =
            regions.iter().copied().chain(combined.iter().enumerate().map(|all| of_all((all.0, all.1))));
        domains.regions = known
            .map(|region| Known {
                attribute: region.attribute,
                max_area: region.max_area,
                max_edge: region.max_edge,
            })
            .collect();
        combined
    }

    /// The area of each polygon, by the parts that are in it. Rounded.
    fn areas_of(&self, domains: &Domains2, around: &[Vec<usize>]) -> BTreeMap<usize, f64> {
        let mut of_parts = vec![0.0; domains.parts.len()];
        for t in self.triangle_ids() {
            domains.part(t).into_iter().for_each(|part| of_parts[part] += self.area(t));
        }
        let mut areas: BTreeMap<usize, f64> = BTreeMap::new();
        for (all, area) in around.iter().zip(of_parts) {
            all.iter().for_each(|&polygon| *areas.entry(polygon).or_insert(0.0) += area);
        }
        areas
    }

    /// The polygons that each part is in, by increasing number.
    fn polygons_of_parts(
        &self,
        domains: &Domains2,
        polygon: impl Fn(SegmentId) -> Option<usize>,
        membership: Membership2<'_>,
    ) -> Vec<Vec<usize>> {
        let mut all: Vec<Vec<usize>> = vec![Vec::new(); domains.parts.len()];
        match membership {
            Membership2::EvenOdd => self.each_part_within(domains, polygon, |part, windings| {
                all[part] = odd(windings).collect();
            }),
            Membership2::NonZero => self.each_part_within(domains, polygon, |part, windings| {
                all[part] = windings.keys().copied().collect();
            }),
            Membership2::Shells { ring, shells } => {
                let of_segment = |(s, _): (SegmentId, _)| Some((ring(s)?, polygon(s)?));
                let polygons: BTreeMap<usize, usize> = self.segments().filter_map(of_segment).collect();
                self.each_part_within(domains, ring, |part, windings| {
                    let filled = filled_shells(&odd(windings).collect(), shells);
                    let of_shells: BTreeSet<usize> =
                        filled.iter().filter_map(|shell| polygons.get(shell).copied()).collect();
                    all[part] = of_shells.into_iter().collect();
                });
            }
        }
        all
    }

    /// Calls for each part with how often rings wind around it.
    pub(super) fn each_part_within(
        &self,
        domains: &Domains2,
        ring: impl Fn(SegmentId) -> Option<usize>,
        mut each: impl FnMut(usize, &Windings),
    ) {
        let outside = domains.parts.len();
        let borders = self.part_borders(domains);
        let mut is_known = vec![false; outside + 1];
        is_known[outside] = true;
        let mut windings = Windings::new();
        // Each part on the way from infinity: how it was entered, and how many of its borders were tried.
        let mut way: Vec<(usize, Option<EdgeId>, usize)> = vec![(outside, None, 0)];
        while let Some((part, entered, tried)) = way.last_mut() {
            let Some(&(next, edge)) = borders[*part].get(*tried) else {
                self.cross(*entered, &ring, -1, &mut windings);
                way.pop();
                continue;
            };
            *tried += 1;
            if !std::mem::replace(&mut is_known[next], true) {
                self.cross(edge, &ring, 1, &mut windings);
                each(next, &windings);
                way.push((next, edge, 0));
            }
        }
    }

    /// Crosses an edge from its left to its right, or back.
    fn cross(
        &self,
        edge: Option<EdgeId>,
        ring: &impl Fn(SegmentId) -> Option<usize>,
        sign: i32,
        windings: &mut Windings,
    ) {
        for covering in edge.map(|e| self.covering(e)).unwrap_or_default() {
            let Some(own) = ring(covering.segment) else { continue };
            let winding = windings.entry(own).or_default();
            *winding += if covering.is_forward { -sign } else { sign };
            if *winding == 0 {
                windings.remove(&own);
            }
        }
    }

    /// The borders of each part, and of what is outside of the hull last.
    fn part_borders(&self, domains: &Domains2) -> Vec<Vec<Border>> {
        let outside = domains.parts.len();
        let mut borders: Vec<Vec<Border>> = vec![Vec::new(); outside + 1];
        let part = |e: EdgeId| domains.part(e.triangle()).unwrap_or(outside);
        let open = self.hull_edges().filter(|&e| !self.is_constraint(e)).map(|e| (e, None));
        for (e, constraint) in self.constraint_edges().map(|e| (e, Some(e))).chain(open) {
            let [one, other] = [part(e), part(self.mesh().twin(e))];
            if one != other {
                borders[one].push((other, constraint));
                borders[other].push((one, constraint.map(|e| self.mesh().twin(e))));
            }
        }
        borders
    }
}

/// The rings that an odd number of segments of is around.
pub(super) fn odd(windings: &Windings) -> impl Iterator<Item = usize> {
    windings.iter().filter(|(_, winding)| *winding % 2 != 0).map(|(&ring, _)| ring)
}
