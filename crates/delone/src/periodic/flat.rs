//! Cells of the plane with what is beyond each of their sides.
//!
//! Cells of sites tile with those of copies, so two share a side where each has it. A side that no other cell has is on a wall.
//!
//! Cost: O(k log k) for k corners of the cells of all copies.

use super::cells::{Beyond, Faces};
use super::walls::{Region, Walls};
use crate::ids::VertexId;
use crate::plane::{Cells2, Region2};
use delone_predicates::hypotenuse;

/// Cells of sites, as sides.
#[derive(Clone, Debug)]
#[expect(unnameable_types, reason = "how cells are kept is hidden")]
pub struct FlatCells {
    cells: Cells2,
    /// For each site the first of its sides; and the end of the last.
    starts: Vec<usize>,
    sides: Vec<FlatSide>,
}

/// A side: what is beyond it, and its ends as indices of vertices, the cell on the left.
#[derive(Clone, Copy, Debug)]
#[expect(unnameable_types, reason = "how cells are kept is hidden")]
pub struct FlatSide {
    pub(super) beyond: Beyond,
    pub(super) ends: [u32; 2],
}

impl FlatCells {
    /// The cells of so many sites among those of their copies.
    pub(super) fn new(cells: Cells2, walls: &Walls<Region2, 2>, sites: usize) -> Self {
        let across = cells.across();
        let lines = walls.region.walls();
        let beyond = |other: VertexId, ends: [u32; 2]| {
            if other != VertexId::GHOST {
                return Beyond::Site(other);
            }
            let ends = ends.map(|i| cells.vertices()[i as usize]);
            let off = |line: &[[f64; 2]]| ends.iter().map(|p| distance(p, line)).fold(0.0, f64::max);
            let walls = lines.iter().enumerate().map(|(k, line)| (k, off(line)));
            let nearest = walls.min_by(|a, b| a.1.total_cmp(&b.1));
            Beyond::Wall(nearest.map_or(0, |wall| wall.0))
        };
        let (mut starts, mut sides) = (vec![0], Vec::new());
        for site in (0..sites).map(VertexId::new) {
            for (ring, first) in cells.rings(site).zip(cells.ring_starts(site)) {
                let corners = ring.indices();
                let next = corners.iter().cycle().skip(1);
                let ends = corners.iter().zip(next).map(|(&a, &b)| [a, b]);
                let all = ends.zip(&across[first..]);
                sides.extend(all.map(|(ends, &other)| FlatSide { beyond: beyond(other, ends), ends }));
            }
            starts.push(sides.len());
        }
        Self { cells, starts, sides }
    }

    /// From the beginning of a side to its end.
    fn along(&self, side: &FlatSide) -> [f64; 2] {
        let [p, q] = side.ends.map(|i| self.cells.vertices()[i as usize]);
        [q[0] - p[0], q[1] - p[1]]
    }
}

impl Faces<2> for FlatCells {
    type Face<'a> = &'a FlatSide;

    fn faces(&self, site: VertexId) -> impl ExactSizeIterator<Item = &FlatSide> + Clone {
        let ends = self.starts.get(site.index()..).and_then(|starts| starts.get(..2));
        ends.map_or(&[][..], |ends| &self.sides[ends[0]..ends[1]]).iter()
    }

    fn beyond(side: &FlatSide) -> Beyond {
        side.beyond
    }

    fn indices<'a>(side: &'a FlatSide) -> &'a [u32]
    where
        Self: 'a,
    {
        &side.ends
    }

    fn vertices(&self) -> &[[f64; 2]] {
        self.cells.vertices()
    }

    fn size(&self, site: VertexId) -> f64 {
        self.cells.area(site)
    }

    fn centroid(&self, site: VertexId) -> Option<[f64; 2]> {
        self.cells.centroid(site)
    }

    fn face_size(&self, side: &FlatSide) -> f64 {
        let [x, y] = self.along(side);
        hypotenuse(x, y)
    }

    fn normal(&self, side: &FlatSide) -> Option<[f64; 2]> {
        let [x, y] = self.along(side);
        let length = hypotenuse(x, y);
        // To the right: the cell is on the left.
        (length > 0.0).then(|| [y / length, 0.0 - x / length])
    }
}

/// How far a place is from a line through two points.
fn distance(p: &[f64; 2], line: &[[f64; 2]]) -> f64 {
    let [a, b] = [line[0], line[1]];
    let along = [b[0] - a[0], b[1] - a[1]];
    (along[0] * (p[1] - a[1]) - along[1] * (p[0] - a[0])).abs() / hypotenuse(along[0], along[1])
}
