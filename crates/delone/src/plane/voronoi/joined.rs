//! Cells joined into cells of groups: sides between cells of one group go.
//!
//! Neighboring cells share their corners, so a side between two of them is there once in each direction. What is left is the border of the
//! group, with the group on its left. At a corner where it meets itself it turns around the area on its left, and is cut there into rings
//! that touch no more than in points. Corners at one place are one.
//!
//! Cost: O(k log k) for k corners.

use std::collections::BTreeMap;

use delone_predicates::{Sign, orient2d};

use super::cells::Cells2;
use crate::ids::VertexId;
use crate::sorting;

/// The place of a vertex that is not on the way.
const OFF: u32 = u32::MAX;

impl Cells2 {
    /// The cells of groups of sites: the cell of a group is the union of those of its sites, and has the group's number for its site.
    /// Sites without a group have no part in any.
    ///
    /// ```
    /// use delone::{Delaunay2, Region2, VertexId};
    ///
    /// let d = Delaunay2::from_points(&[[1, 1], [3, 1], [5, 1]])?;
    /// let cells = d.voronoi().clip(&Region2::rectangle([0, 0], [6, 2])?);
    /// let joined = cells.joined(|site| Some(usize::from(site.index() == 2)), 2);
    /// assert_eq!([0, 1].map(|group| joined.area(VertexId::new(group))), [8.0, 4.0]);
    /// assert_eq!(joined.rings(VertexId::new(0)).count(), 1);
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[must_use]
    pub fn joined(&self, group: impl Fn(VertexId) -> Option<usize>, groups: usize) -> Self {
        let same = self.same_places();
        let mut of_groups: Vec<Vec<[u32; 2]>> = vec![Vec::new(); groups];
        for site in (0..self.sites.len()).map(VertexId::new) {
            let Some(sides) = group(site).and_then(|group| of_groups.get_mut(group)) else { continue };
            for ring in self.rings(site) {
                let corners = ring.indices();
                let next = corners.iter().cycle().skip(1);
                let side = corners.iter().zip(next).map(|(&p, &q)| [same[p as usize], same[q as usize]]);
                sides.extend(side.filter(|[p, q]| p != q));
            }
        }
        let mut on_way = vec![OFF; self.vertices.len()];
        let mut all = Self { starts: vec![0], vertices: self.vertices.clone(), ..Self::default() };
        for sides in of_groups {
            let rings = self.rings_of(border_of(&sides), &mut on_way);
            all.sites.push([all.starts.len() - 1, rings.len()].map(|n| n as u32));
            for ring in rings {
                all.corners.extend(ring);
                all.starts.push(all.corners.len() as u32);
            }
        }
        all
    }

    /// For each vertex the first one at its place.
    fn same_places(&self) -> Vec<u32> {
        let mut order: Vec<u32> = (0..self.vertices.len() as u32).collect();
        // Zero has no sign here.
        let key = |i: u32| self.vertices[i as usize].map(|x| (x + 0.0).to_bits());
        sorting::by(&mut order, |&i, &j| key(i).cmp(&key(j)).then(i.cmp(&j)));
        let mut same: Vec<u32> = (0..self.vertices.len() as u32).collect();
        for pair in order.windows(2) {
            if key(pair[0]) == key(pair[1]) {
                same[pair[1] as usize] = same[pair[0] as usize];
            }
        }
        same
    }

    /// Sides of a border as rings. For each vertex its place on the way that is followed, or [`OFF`], is kept between calls.
    fn rings_of(&self, sides: Vec<[u32; 2]>, on_way: &mut [u32]) -> Vec<Vec<u32>> {
        let mut leaving: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for &[p, q] in &sides {
            leaving.entry(p).or_default().push(q);
        }
        let mut rings = Vec::new();
        for [start, _] in sides {
            let mut way: Vec<u32> = vec![start];
            on_way[start as usize] = 0;
            while let Some(&at) = way.last() {
                let before = way.len().checked_sub(2).map(|i| way[i]);
                let Some(next) = leaving.get_mut(&at).and_then(|ends| self.take_next(before, at, ends))
                else {
                    break;
                };
                let first = on_way[next as usize];
                if first < OFF {
                    let ring = way.split_off(first as usize);
                    ring.iter().for_each(|&p| on_way[p as usize] = OFF);
                    rings.push(ring);
                }
                on_way[next as usize] = way.len() as u32;
                way.push(next);
            }
            way.iter().for_each(|&p| on_way[p as usize] = OFF);
        }
        rings
    }

    /// The end of the side that goes on from a corner: the first one clockwise from where the border came from.
    fn take_next(&self, before: Option<u32>, at: u32, ends: &mut Vec<u32>) -> Option<u32> {
        let place = |i: u32| self.vertices[i as usize];
        let first = match before {
            Some(before) if ends.len() > 1 => {
                let (from, at) = (place(before), place(at));
                let nearer = |&i: &usize, &j: &usize| clockwise(at, from, place(ends[i]), place(ends[j]));
                (0..ends.len()).min_by(nearer)?
            }
            _ => 0,
        };
        (first < ends.len()).then(|| ends.remove(first))
    }
}

/// The sides that are not there in the other direction as well.
fn border_of(sides: &[[u32; 2]]) -> Vec<[u32; 2]> {
    let mut counts: BTreeMap<[u32; 2], i32> = BTreeMap::new();
    for &[p, q] in sides {
        *counts.entry([p.min(q), p.max(q)]).or_insert(0) += if p < q { 1 } else { -1 };
    }
    let mut border = Vec::new();
    for ([p, q], count) in counts {
        let side = if count > 0 { [p, q] } else { [q, p] };
        border.extend(std::iter::repeat_n(side, count.unsigned_abs() as usize));
    }
    border
}

/// Which of two directions from a place comes first when one turns clockwise from a third.
fn clockwise(at: [f64; 2], from: [f64; 2], p: [f64; 2], q: [f64; 2]) -> std::cmp::Ordering {
    // Directions in the first half turn are on the right.
    let is_late = |r: [f64; 2]| !orient2d(at, from, r).is_negative();
    let order = is_late(p).cmp(&is_late(q));
    order.then_with(|| match orient2d(at, p, q) {
        Sign::Negative => std::cmp::Ordering::Less,
        Sign::Positive => std::cmp::Ordering::Greater,
        Sign::Zero => std::cmp::Ordering::Equal,
    })
}
