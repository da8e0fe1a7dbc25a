//! Triangles as contours see them: corners and neighbors as numbers, with a border where a neighbor is left out.
//!
//! Cost: O(t), 24 bytes a triangle.

use delone_predicates::{hypotenuse, lexicographic};

use crate::ids::VertexId;
use crate::triangulation::Triangulation;

/// No triangle.
pub(super) const NONE: u32 = u32::MAX;

/// Triangles, numbered from 0 in the order of the triangulation. Edge k of a triangle is opposite to its corner k and goes from
/// corner k + 1 to corner k + 2, with the triangle on its left.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    pub(super) corners: Vec<[u32; 3]>,
    /// The triangles across the edges.
    pub(super) across: Vec<[u32; 3]>,
    /// The coordinates by vertex.
    pub(super) points: Vec<[f64; 2]>,
}

/// Points on edges are rounded by at most 2^-50 of their largest coordinate, so between edges nearer to each other than twice that lines may be
/// anywhere.
const ROUNDING: f64 = 1.776_356_839_400_250_5e-15;

/// Takes out triangles along the border whose sides are one line but for rounding, the longest on the border; those behind them, too.
fn drop_slivers<T>(triangulation: &T, kept: &[T::Simplex], number: &mut [u32])
where
    T: Triangulation<Point = [f64; 2], Corners = [VertexId; 3]>,
{
    let mut pending = kept.to_vec();
    while let Some(t) = pending.pop() {
        if number[triangulation.index(t)] == NONE {
            continue;
        }
        let beyond =
            [0, 1, 2].map(|k| triangulation.across(t, k).filter(|&u| number[triangulation.index(u)] != NONE));
        let corners = triangulation.corners(t).map(|v| triangulation.position(v).unwrap_or_default());
        if beyond.iter().any(Option::is_none) && longest_of_flat(corners).is_some_and(|k| beyond[k].is_none())
        {
            number[triangulation.index(t)] = NONE;
            pending.extend(beyond.into_iter().flatten());
        }
    }
}

/// The longest side, by the opposite corner, of a triangle whose corner there is no further away than rounding.
fn longest_of_flat(unsorted: [[f64; 2]; 3]) -> Option<usize> {
    // What is rounded must not depend on which corner comes first.
    let mut order = [0, 1, 2];
    order.sort_unstable_by(|&i, &j| lexicographic(unsorted[i], unsorted[j]));
    let corners = order.map(|i| unsorted[i]);
    let side = |k: usize| {
        let [p, q] = [corners[(k + 1) % 3], corners[(k + 2) % 3]];
        [q[0] - p[0], q[1] - p[1]]
    };
    let sides = [side(0), side(1), side(2)];
    let lengths = sides.map(|[x, y]| hypotenuse(x, y));
    let longest = (0..3).max_by(|&i, &j| lengths[i].total_cmp(&lengths[j]))?;
    let [[a, b], [c, d]] = [sides[(longest + 1) % 3], sides[(longest + 2) % 3]];
    let size = corners.as_flattened().iter().fold(0.0f64, |most, x| most.max(x.abs()));
    let height = (a / lengths[longest] * d - b / lengths[longest] * c).abs();
    (height <= ROUNDING * size).then_some(order[longest])
}

/// An edge of a triangle, as a number.
pub(super) type Edge = u32;

pub(super) fn edge(t: u32, k: usize) -> Edge {
    3 * t + k as u32
}

impl Sheet {
    pub(super) fn new<T>(triangulation: &T, keep: impl Fn(T::Simplex) -> bool) -> Self
    where
        T: Triangulation<Point = [f64; 2], Corners = [VertexId; 3]>,
    {
        let mut kept: Vec<T::Simplex> = triangulation.simplices().filter(|&t| keep(t)).collect();
        let mut number = vec![NONE; triangulation.slot_count()];
        kept.iter().for_each(|&t| number[triangulation.index(t)] = 0);
        drop_slivers(triangulation, &kept, &mut number);
        kept.retain(|&t| number[triangulation.index(t)] != NONE);
        for (n, &t) in kept.iter().enumerate() {
            number[triangulation.index(t)] = n as u32;
        }
        let corners = kept.iter().map(|&t| triangulation.corners(t).map(|v| v.index() as u32)).collect();
        let beyond = |t| {
            [0, 1, 2].map(|k| triangulation.across(t, k).map_or(NONE, |u| number[triangulation.index(u)]))
        };
        let across = kept.iter().map(|&t| beyond(t)).collect();
        let mut points = vec![[0.0; 2]; triangulation.ids_given()];
        for v in triangulation.vertices() {
            points[v.index()] = triangulation.position(v).unwrap_or_default();
        }
        Self { corners, across, points }
    }

    /// The triangle across an edge, if there is one.
    pub(super) fn beyond(&self, e: Edge) -> Option<u32> {
        let t = self.across[(e / 3) as usize][(e % 3) as usize];
        (t != NONE).then_some(t)
    }

    /// The vertices that an edge goes from and to.
    pub(super) fn ends(&self, e: Edge) -> [u32; 2] {
        let (corners, k) = (&self.corners[(e / 3) as usize], (e % 3) as usize);
        [corners[(k + 1) % 3], corners[(k + 2) % 3]]
    }

    /// The edges of a triangle.
    pub(super) fn edges(t: u32) -> [Edge; 3] {
        [0, 1, 2].map(|k| edge(t, k))
    }

    /// The border edge after another one, with the triangles on the left: around its end, through all triangles that are there.
    pub(super) fn next_on_border(&self, e: Edge) -> Edge {
        let pivot = self.ends(e)[1];
        let mut t = e / 3;
        loop {
            let leaving = |&f: &Edge| self.ends(f)[0] == pivot;
            let Some(f) = Self::edges(t).into_iter().find(leaving) else { return e };
            match self.beyond(f) {
                None => return f,
                Some(next) => t = next,
            }
        }
    }

    /// All border edges, by number.
    pub(super) fn border(&self) -> Vec<Edge> {
        let all = 0..self.corners.len() as u32;
        all.flat_map(Self::edges).filter(|&e| self.beyond(e).is_none()).collect()
    }
}
