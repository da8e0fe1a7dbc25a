//! Polygons as regions: which polygon each part is in.
//!
//! A ring parts its inside from its outside. Across a constraint a part enters or leaves the polygons whose rings cover it an odd number of
//! times; so one walk over the parts, from infinity and back, tells all of them. Parity decides, and no coordinate is asked for.
//!
//! Cost: O(m log m) for m constraint edges, and as much memory.

use std::collections::BTreeSet;

use super::domains::{Domains2, Known};
use super::{Constrained2, SegmentId};
use crate::ids::EdgeId;

/// A border between two parts, seen from one of them: the other part, and the constraint, if there is one.
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
        domains.forget_regions();
        domains.regions = attributes.iter().map(|&attribute| Known { attribute, max_area: None }).collect();
        let mut of = vec![None; domains.parts.len()];
        self.each_part_within(domains, polygon, |part, around| of[part] = around.last().copied());
        domains.parts.iter_mut().zip(of).for_each(|(part, region)| part.region = region);
    }

    /// Calls for each part with the polygons that it is in.
    pub(super) fn each_part_within(
        &self,
        domains: &Domains2,
        polygon: impl Fn(SegmentId) -> Option<usize>,
        mut each: impl FnMut(usize, &BTreeSet<usize>),
    ) {
        let outside = domains.parts.len();
        let borders = self.part_borders(domains);
        let mut is_known = vec![false; outside + 1];
        is_known[outside] = true;
        let mut around = BTreeSet::new();
        // Each part on the way from infinity: how it was entered, and how many of its borders were tried.
        let mut way: Vec<(usize, Option<EdgeId>, usize)> = vec![(outside, None, 0)];
        while let Some((part, entered, tried)) = way.last_mut() {
            let Some(&(next, edge)) = borders[*part].get(*tried) else {
                self.cross(*entered, &polygon, &mut around);
                way.pop();
                continue;
            };
            *tried += 1;
            if !std::mem::replace(&mut is_known[next], true) {
                self.cross(edge, &polygon, &mut around);
                each(next, &around);
                way.push((next, edge, 0));
            }
        }
    }

    /// Enters the polygons whose rings cover an edge an odd number of times, or leaves them.
    fn cross(
        &self,
        edge: Option<EdgeId>,
        polygon: &impl Fn(SegmentId) -> Option<usize>,
        around: &mut BTreeSet<usize>,
    ) {
        for covering in edge.map(|e| self.covering(e)).unwrap_or_default() {
            if let Some(own) = polygon(covering.segment)
                && !around.remove(&own)
            {
                around.insert(own);
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
                borders[other].push((one, constraint));
            }
        }
        borders
    }
}
