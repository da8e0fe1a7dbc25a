//! A canonical order of grown regions: regions are sorted by their sites, circles by their regions,
//! the corners of each region from its first circle on.
//!
//! Cost: O(r k log r) for r regions of k sites.

use std::cmp::Ordering;

use super::OrderK2;
use super::circle::Circle;
use super::grow::{Complex, NO_REGION};
use crate::ids::{TriangleId, VertexId};
use crate::plane::Delaunay2;
use crate::sorting;

/// A diagram in any order.
pub(super) struct Loose {
    pub(super) order: usize,
    pub(super) sites: Vec<VertexId>,
    pub(super) circles: Vec<Circle>,
    pub(super) starts: Vec<u32>,
    pub(super) corners: Vec<u32>,
}

/// The diagram that was grown.
pub(super) fn from_complex<'a>(triangulation: &'a Delaunay2, complex: &Complex) -> OrderK2<'a> {
    let name = |place| triangulation.base.mesh.name(place);
    let mut number = vec![0; complex.mesh.slot_count()];
    let mut circles = Vec::with_capacity(complex.mesh.slot_count());
    for t in (0..complex.mesh.slot_count()).map(TriangleId::new) {
        let regions = [0, 1, 2].map(|k| complex.region[t.edge(k).index()]);
        number[t.index()] = circles.len() as u32;
        if regions != [NO_REGION; 3] {
            let is_old = !complex.is_new(t.edge(0));
            circles.push(Circle { on: complex.mesh.places(t).map(name), regions, is_old });
        }
    }
    let mut starts = Vec::with_capacity(complex.first.len() + 1);
    let mut corners = Vec::with_capacity(3 * circles.len());
    starts.push(0);
    for &first in &complex.first {
        let star = complex.mesh.star_from(first);
        corners.extend(star.map(|e| 3 * number[e.triangle().index()] + e.corner() as u32));
        starts.push(corners.len() as u32);
    }
    let sites = complex.sites.iter().map(|&place| name(place)).collect();
    Loose { order: complex.order, sites, circles, starts, corners }.settle(triangulation)
}

impl Loose {
    /// Sorts everything.
    pub(super) fn settle(mut self, triangulation: &Delaunay2) -> OrderK2<'_> {
        let order = self.order;
        self.sites.chunks_exact_mut(order).for_each(<[_]>::sort_unstable);
        let count = self.starts.len() - 1;
        let set = |region: u32| &self.sites[region as usize * order..][..order];
        let ids = triangulation.points().len();
        let sorted = in_order(count, ids, |r| set(r)[0].index(), |r, s| set(r)[1..].cmp(&set(s)[1..]));
        let mut rank = vec![0; count];
        for (new, &old) in sorted.iter().enumerate() {
            rank[old as usize] = new as u32;
        }
        let turned: Vec<u32> = self.circles.iter_mut().map(|circle| circle.turn(&rank)).collect();
        let circle = |i: u32| &self.circles[i as usize];
        let key = |i: u32| (circle(i).regions, circle(i).on);
        let by_region = in_order(
            self.circles.len(),
            count,
            |i| circle(i).smallest() as usize,
            |i, j| key(i).cmp(&key(j)),
        );
        let mut place = vec![0; by_region.len()];
        for (new, &old) in by_region.iter().enumerate() {
            place[old as usize] = new as u32;
        }
        let moved = |corner: u32| {
            let circle = corner as usize / 3;
            3 * place[circle] + (corner % 3 + 3 - turned[circle]) % 3
        };
        let mut starts = Vec::with_capacity(count + 1);
        let mut corners = Vec::with_capacity(self.corners.len());
        starts.push(0);
        for &region in &sorted {
            let ends = [region, region + 1].map(|r| self.starts[r as usize] as usize);
            let from = corners.len();
            corners.extend(self.corners[ends[0]..ends[1]].iter().map(|&corner| moved(corner)));
            let cycle = &mut corners[from..];
            let first = (0..cycle.len()).min_by_key(|&i| cycle[i]).unwrap_or(0);
            cycle.rotate_left(first);
            starts.push(corners.len() as u32);
        }
        let sites = sorted.iter().flat_map(|&region| set(region)).copied().collect();
        let circles = by_region.iter().map(|&i| self.circles[i as usize]).collect();
        OrderK2 { triangulation, order, sites, circles, starts, corners }
    }
}

/// Sorts items by a number below a limit, and ties by a comparison: few are equal, so that is O(n).
fn in_order(
    items: usize,
    limit: usize,
    number: impl Fn(u32) -> usize,
    compare: impl Fn(u32, u32) -> Ordering,
) -> Vec<u32> {
    let mut ends = vec![0_u32; limit + 1];
    (0..items as u32).for_each(|i| ends[number(i) + 1] += 1);
    for i in 0..limit {
        ends[i + 1] += ends[i];
    }
    let mut sorted = vec![0; items];
    for i in 0..items as u32 {
        let end = &mut ends[number(i)];
        sorted[*end as usize] = i;
        *end += 1;
    }
    let mut from = 0;
    for &to in &ends[..limit] {
        sorting::by(&mut sorted[from..to as usize], |&i, &j| compare(i, j));
        from = to as usize;
    }
    sorted
}

impl Circle {
    /// The smallest region around it.
    fn smallest(&self) -> u32 {
        self.regions.into_iter().min().unwrap_or(NO_REGION)
    }

    /// Turns it so that the smallest site comes first, and names its regions anew. Says by how many corners.
    fn turn(&mut self, rank: &[u32]) -> u32 {
        let by = (0..3).min_by_key(|&i| self.on[i]).unwrap_or(0);
        self.on.rotate_left(by);
        self.regions.rotate_left(by);
        self.regions = self.regions.map(|r| if r == NO_REGION { r } else { rank[r as usize] });
        by as u32
    }
}
