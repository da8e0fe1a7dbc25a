//! Which clipped cells are beside each other: those that share a side.
//!
//! Cells tile with the same rounded corners, so two share a side where each has it, in opposite directions.
//!
//! Cost: O(k log k) for k corners of all cells.

use super::cells::{Cells2, Ring};
use crate::ids::VertexId;
use crate::sorting;
use delone_predicates::hypotenuse;

/// A side of a cell.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    /// The coordinates of its ends as bits, the lesser first.
    ends: [[u64; 2]; 2],
    /// Whether the cell is on the left from the first to the second.
    is_left: bool,
    site: VertexId,
}

impl Side {
    fn of(site: VertexId, ends: [[f64; 2]; 2]) -> Self {
        // Both zeros are one place.
        let [p, q] = ends.map(|p| p.map(|x| (x + 0.0).to_bits()));
        Self { ends: [p.min(q), p.max(q)], is_left: p < q, site }
    }

    fn length(&self) -> f64 {
        let [p, q] = self.ends.map(|p| p.map(f64::from_bits));
        hypotenuse(q[0] - p[0], q[1] - p[1])
    }
}

impl Cells2 {
    /// For each corner, ring by ring, the cell on the other side of the side that leaves it; the ghost where the region ends. Sides
    /// that rounding has left no length have none either.
    pub(crate) fn across(&self) -> Vec<VertexId> {
        let mut sides: Vec<(Side, usize)> = Vec::with_capacity(self.corners.len());
        for site in (0..self.sites.len()).map(VertexId::new) {
            for (ring, start) in self.rings(site).zip(self.ring_starts(site)) {
                sides.extend(ring.sides().map(|ends| Side::of(site, ends)).zip(start..));
            }
        }
        sorting::by(&mut sides, |a, b| a.cmp(b));
        let mut across = vec![VertexId::GHOST; self.corners.len()];
        for same in sides.chunk_by(|a, b| a.0.ends == b.0.ends) {
            let (right, left) = same.split_at(same.partition_point(|(side, _)| !side.is_left));
            for ((a, at_a), (b, at_b)) in right.iter().zip(left) {
                (across[*at_a], across[*at_b]) = (b.site, a.site);
            }
        }
        across
    }

    /// The pairs of cells that share a side after clipping, and the length of what they share, in coordinate units: the smaller site first,
    /// sorted. Cells that only touch in a corner are none; for cells that are not clipped, [`crate::Voronoi2::neighbors`] tells. Sides are
    /// those between rounded corners: a border that rounding leaves no length is none.
    ///
    /// O(k log k) for k corners of all cells. Infinite lengths are beyond the range of `f64`.
    ///
    /// ```
    /// use delone::{Delaunay2, Region2};
    ///
    /// // Three sites in a row, in a region that has a dent down to the border of the last two.
    /// let d = Delaunay2::from_points(&[[0, 0], [2, 0], [4, 0]])?;
    /// let dented = [[-1, -1], [5, -1], [5, 1], [4, 1], [3, 0], [2, 1], [-1, 1]];
    /// let cells = d.voronoi().clip(&Region2::polygon(&[dented.to_vec()])?);
    /// let [a, b, c] = [0, 1, 2].map(delone::VertexId::new);
    /// assert_eq!(cells.borders(), [([a, b], 2.0), ([b, c], 1.0)]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("neighbors", "neighbours", "adjacency"))]
    pub fn borders(&self) -> Vec<([VertexId; 2], f64)> {
        let mut sides: Vec<Side> = Vec::with_capacity(self.corners.len());
        for site in (0..self.sites.len()).map(VertexId::new) {
            sides.extend(self.rings(site).flat_map(Ring::sides).map(|ends| Side::of(site, ends)));
        }
        sorting::by(&mut sides, Side::cmp);
        let mut shared: Vec<([VertexId; 2], f64)> = Vec::with_capacity(sides.len() / 2);
        for same in sides.chunk_by(|a, b| a.ends == b.ends) {
            let (right, left) = same.split_at(same.partition_point(|side| !side.is_left));
            for (a, b) in right.iter().flat_map(|a| left.iter().map(move |b| (a, b))) {
                let length = a.length();
                if a.site != b.site && length > 0.0 {
                    shared.push(([a.site.min(b.site), a.site.max(b.site)], length));
                }
            }
        }
        // By length too, so that sums are the same whatever the order of the sides.
        sorting::by(&mut shared, |a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        shared.dedup_by(|next, kept| {
            let is_same = next.0 == kept.0;
            kept.1 += if is_same { next.1 } else { 0.0 };
            is_same
        });
        shared
    }
}
