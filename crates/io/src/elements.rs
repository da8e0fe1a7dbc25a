//! A mesh as programs for finite elements take it: cells in groups by region, and sides in groups by marker. Sides are the
//! edges of the border and those that were asked for; of space, the triangles of the border.
//!
//! Nodes that no cell uses are left out: nothing holds them, and systems of equations with them have no solution. So
//! nodes are numbered with gaps: each has the index of its point, from 1. O(n log n).

use std::cmp::Ordering;

use delone::{Coordinates, Triangulation};

use crate::Mesh;
use crate::middles::Middles;

/// The corners of the facet of a tetrahedron opposite to each corner, counter-clockwise seen from outside.
pub(crate) const FACETS: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// Elements to be written, with nodes by the indices of their points, from 0.
#[derive(Debug)]
pub(crate) struct Elements {
    /// The dimension of the cells, 2 or 3.
    pub(crate) dimension: usize,
    pub(crate) second_order: bool,
    /// Whether points have heights besides their two coordinates.
    pub(crate) has_heights: bool,
    /// All points, and the middles of edges after them.
    pub(crate) positions: Vec<[f64; 3]>,
    pub(crate) sides: Vec<Group>,
    pub(crate) cells: Vec<Group>,
}

/// Elements that have a number in common. It is the tag if it can be one: a positive integer of 32 bits with sign. Others
/// have the least tag that is free. The name has the number in any case.
#[derive(Debug, PartialEq)]
pub(crate) struct Group {
    pub(crate) tag: u32,
    pub(crate) name: String,
    /// How many nodes an element has.
    width: usize,
    nodes: Vec<usize>,
}

impl Group {
    /// The nodes of each element.
    pub(crate) fn rows(&self) -> impl ExactSizeIterator<Item = &[usize]> {
        self.nodes.chunks_exact(self.width)
    }

    /// The nodes of all elements, by increasing index.
    pub(crate) fn nodes(&self) -> Vec<usize> {
        let mut nodes = self.nodes.clone();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }
}

impl Elements {
    pub(crate) fn of<T: Triangulation>(mesh: &Mesh<T>) -> Self {
        let middles = mesh.second_order.then(|| Middles::of(mesh));
        let middles = middles.as_ref();
        let dimension = T::Point::COUNT;
        let cells: Vec<Vec<usize>> = mesh.simplices().map(|s| mesh.nodes(s, middles).collect()).collect();
        let regions: Vec<f64> = match mesh.region_values() {
            Some(values) => values.collect(),
            None => vec![0.0; cells.len()],
        };
        let mut sides: Vec<Vec<usize>> = Vec::new();
        let mut markers: Vec<i64> = Vec::new();
        if dimension == 3 {
            for s in mesh.simplices() {
                let corners = mesh.triangulation.corners(s);
                for k in (0..4).filter(|&k| mesh.across(s, k).is_none()) {
                    sides.push(FACETS[k].map(|i| corners.as_ref()[i].index()).to_vec());
                }
            }
            markers = vec![1; sides.len()];
        } else if !cells.is_empty() {
            for (ends, marker) in mesh.sides() {
                let middle = middles.map(|middles| middles.of_edge(ends));
                sides.push(ends.iter().map(|v| v.index()).chain(middle).collect());
                markers.push(marker);
            }
        }
        let mut positions: Vec<[f64; 3]> = mesh.positions().collect();
        if let Some(middles) = middles {
            positions = middles.points(&positions);
        }
        Self {
            dimension,
            second_order: mesh.second_order,
            has_heights: dimension == 2 && mesh.heights.is_some(),
            positions,
            sides: grouped("marker", &markers, &sides),
            cells: grouped("region", &regions, &cells),
        }
    }

    /// How many cells there are.
    pub(crate) fn cell_count(&self) -> usize {
        self.cells.iter().map(|group| group.rows().len()).sum()
    }

    /// Whether a cell uses each node.
    pub(crate) fn is_used(&self) -> Vec<bool> {
        let mut is_used = vec![false; self.positions.len()];
        self.cells.iter().flat_map(|group| &group.nodes).for_each(|&node| is_used[node] = true);
        is_used
    }
}

/// The numbers that elements share.
trait Number: Copy {
    fn order(&self, other: &Self) -> Ordering;
    /// The number in a name: digits, letters and hyphens alone, because other characters mean something in some formats.
    fn label(self) -> String;
    /// The number as a tag.
    fn tag(self) -> Option<u32>;
}

impl Number for i64 {
    fn order(&self, other: &Self) -> Ordering {
        self.cmp(other)
    }

    fn label(self) -> String {
        self.to_string()
    }

    fn tag(self) -> Option<u32> {
        u32::try_from(self).ok().filter(|tag| (1..=i32::MAX as u32).contains(tag))
    }
}

impl Number for f64 {
    /// There is one zero, and one number that is none.
    fn order(&self, other: &Self) -> Ordering {
        self.partial_cmp(other).unwrap_or_else(|| self.is_nan().cmp(&other.is_nan()))
    }

    fn label(self) -> String {
        // Zero has no sign here.
        let digits = format!("{:?}", self + 0.0);
        digits.strip_suffix(".0").unwrap_or(&digits).replace('.', "p")
    }

    fn tag(self) -> Option<u32> {
        let is_tag = self.fract() == 0.0 && (1.0..=f64::from(i32::MAX)).contains(&self);
        is_tag.then_some(self as u32)
    }
}

/// Groups by increasing number; elements keep their order in each.
fn grouped<N: Number>(kind: &str, numbers: &[N], elements: &[Vec<usize>]) -> Vec<Group> {
    let mut order: Vec<usize> = (0..elements.len()).collect();
    order.sort_by(|&i, &j| numbers[i].order(&numbers[j]));
    let parts: Vec<&[usize]> = order.chunk_by(|&i, &j| numbers[i].order(&numbers[j]).is_eq()).collect();
    // Numbers increase, and so do those that are tags.
    let taken: Vec<u32> = parts.iter().filter_map(|part| numbers[part[0]].tag()).collect();
    let mut free = (1..).filter(|tag| taken.binary_search(tag).is_err());
    let group = |part: &[usize]| {
        let number = numbers[part[0]];
        Group {
            tag: number.tag().or_else(|| free.next()).unwrap_or_default(),
            name: format!("{kind}_{}", number.label()),
            width: elements[part[0]].len(),
            nodes: part.iter().flat_map(|&i| &elements[i]).copied().collect(),
        }
    };
    parts.into_iter().map(group).collect()
}

#[cfg(test)]
mod tests {
    use super::grouped;

    #[test]
    fn numbers_are_tags_where_they_can_be() {
        let elements: Vec<Vec<usize>> = (0..9).map(|i| vec![i]).collect();
        let of = |numbers: &[f64]| -> Vec<(u32, String, usize)> {
            let groups = grouped("region", numbers, &elements[..numbers.len()]);
            groups.into_iter().map(|group| (group.tag, group.name.clone(), group.nodes().len())).collect()
        };
        let expected = [
            (2, "region_-2p5", 1),
            (4, "region_0", 2),
            (1, "region_1", 1),
            (3, "region_3", 1),
            (2_147_483_647, "region_2147483647", 1),
            (5, "region_1e300", 1),
            (6, "region_NaN", 2),
        ];
        let numbers = [f64::NAN, 3.0, -0.0, 1e300, 1.0, 0.0, -2.5, -f64::NAN, 2_147_483_647.0];
        assert_eq!(of(&numbers), expected.map(|(tag, name, count)| (tag, name.to_owned(), count)));
        assert!(of(&[]).is_empty());
        let markers = grouped("marker", &[i64::MAX, -8, 0, 1], &elements[..4]);
        let tags: Vec<(u32, &str)> = markers.iter().map(|group| (group.tag, &group.name[..])).collect();
        assert_eq!(
            tags,
            [(2, "marker_-8"), (3, "marker_0"), (1, "marker_1"), (4, "marker_9223372036854775807")]
        );
    }
}
