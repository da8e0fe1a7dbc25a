//! A mesh as programs for finite elements take it: cells in groups by region, and sides in groups by marker. Sides are the
//! edges of the border and those that were asked for; of space, the triangles of the border.
//!
//! Nodes that no cell uses are left out: nothing holds them, and systems of equations with them have no solution. So
//! nodes are numbered with gaps: each has the index of its point, from 1. O(n log n).

use delone::{Coordinates, Triangulation, VertexId};

use crate::error::listed;
use crate::middles::{Middles, ordered};
use crate::names::{Number, Rule};
use crate::{Mesh, Names, Remark};

/// The corners of the facet of a tetrahedron opposite to each corner, counter-clockwise seen from outside.
pub(crate) const FACETS: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// The sides of a tetrahedron by the corner that a side is opposite to, as Abaqus numbers them.
const SIDES_OF_TETRAHEDRON: [usize; 4] = [3, 4, 2, 1];

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
    /// The cell of each side, by its place among all, and the number of the side there, from 1.
    owners: Vec<Owner>,
    /// Whether the regions of cells are known.
    pub(crate) has_regions: bool,
}

/// A cell and one of its sides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Owner {
    /// The number of the cell in a file that counts from 1, in the order of the groups.
    pub(crate) cell: usize,
    /// The number of the side as Abaqus has it: of triangles and quadrilaterals 1 from corner 1 to 2, and so on.
    pub(crate) side: usize,
}

/// Elements that have a number in common. It is the tag if it can be one: a positive integer of 32 bits with sign. Others
/// have the least tag that is free. The label has the number in any case.
#[derive(Debug, PartialEq)]
pub(crate) struct Group {
    pub(crate) tag: u32,
    /// The number, if it is a whole one of 32 bits.
    whole: Option<i32>,
    number: f64,
    /// The kind and the number, which is the name of what has no other.
    label: String,
    /// The name that was given.
    given: Option<String>,
    nodes: Vec<usize>,
    /// Where each element ends among them.
    ends: Vec<usize>,
    /// The elements by their places among all.
    members: Vec<usize>,
}

impl Group {
    /// The name that was given, or else the kind and the number.
    pub(crate) fn name(&self) -> &str {
        self.given.as_deref().unwrap_or(&self.label)
    }

    /// Whether it has a name of its own.
    pub(crate) fn is_named(&self) -> bool {
        self.given.is_some()
    }

    /// The number for formats whose numbers may be any whole ones: the tag where it is none.
    pub(crate) fn reference(&self) -> i64 {
        self.whole.map_or(self.tag.into(), i64::from)
    }

    /// The tag, if it is not the number.
    fn changed_tag(&self) -> Option<i64> {
        (self.whole.and_then(|whole| whole.try_into().ok()) != Some(self.tag)).then(|| self.tag.into())
    }

    /// The number that the elements have in common.
    pub(crate) fn number(&self) -> f64 {
        self.number
    }

    /// The nodes of each element.
    pub(crate) fn rows(&self) -> impl ExactSizeIterator<Item = &[usize]> {
        let start = |i: usize| i.checked_sub(1).map_or(0, |before| self.ends[before]);
        self.ends.iter().enumerate().map(move |(i, &end)| &self.nodes[start(i)..end])
    }

    /// The numbers of nodes that elements have, increasing.
    pub(crate) fn widths(&self) -> Vec<usize> {
        let mut widths: Vec<usize> = self.rows().map(<[usize]>::len).collect();
        widths.sort_unstable();
        widths.dedup();
        widths
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
        let with_middles = |(s, corners): (T::Simplex, Vec<usize>)| {
            if middles.is_some() { mesh.nodes(s, middles).collect() } else { corners }
        };
        let cells: Vec<Vec<usize>> = mesh.cells().map(with_middles).collect();
        let of = |s| mesh.regions.and_then(|regions| regions.get(mesh.triangulation.index(s))).copied();
        let regions: Vec<f64> = mesh.cells().map(|cell| of(cell.0).unwrap_or_default()).collect();
        let mut sides: Vec<Vec<usize>> = Vec::new();
        let mut markers: Vec<i64> = Vec::new();
        let mut owners: Vec<(usize, usize)> = Vec::new();
        if dimension == 3 {
            for (cell, s) in mesh.simplices().enumerate() {
                let corners = mesh.triangulation.corners(s);
                for k in (0..4).filter(|&k| mesh.across(s, k).is_none()) {
                    sides.push(FACETS[k].map(|i| corners.as_ref()[i].index()).to_vec());
                    owners.push((cell, SIDES_OF_TETRAHEDRON[k]));
                }
            }
            markers = vec![1; sides.len()];
        } else if !cells.is_empty() {
            let mut ends_of = Vec::new();
            for (ends, marker) in mesh.sides() {
                let middle = middles.map(|middles| middles.of_edge(ends));
                sides.push(ends.iter().map(|v| v.index()).chain(middle).collect());
                markers.push(marker);
                ends_of.push(ends);
            }
            owners = owners_of(mesh, &ends_of, &regions);
        }
        let mut positions: Vec<[f64; 3]> = mesh.positions().collect();
        if let Some(middles) = middles {
            positions = middles.points(&positions);
        }
        let name_of_side = |marker| mesh.names.and_then(|names: &Names| names.boundary(marker));
        let name_of_cell = |region| mesh.names.and_then(|names: &Names| names.region(region));
        let cells = grouped("region", &regions, &cells, name_of_cell);
        let mut number_of = vec![0; regions.len()];
        let in_order = cells.iter().flat_map(|group| &group.members);
        in_order.zip(1..).for_each(|(&cell, number)| number_of[cell] = number);
        Self {
            dimension,
            second_order: mesh.second_order,
            has_heights: dimension == 2 && mesh.heights.is_some(),
            positions,
            sides: grouped("marker", &markers, &sides, name_of_side),
            cells,
            owners: owners.into_iter().map(|(cell, side)| Owner { cell: number_of[cell], side }).collect(),
            has_regions: mesh.regions.is_some(),
        }
    }

    /// The cell of each side of a group: of two, the one in the region of the lesser number, or else the one on the left of the
    /// side where it is walked towards larger x, then y.
    pub(crate) fn owners(&self, group: &Group) -> impl Iterator<Item = Owner> {
        group.members.iter().map(|&side| self.owners[side])
    }

    /// The names of the sides and of the cells as a format permits them, and what is changed.
    pub(crate) fn names(&self, rule: Rule) -> Permitted {
        let mut changed = Vec::new();
        let sides = rule.of(self.sides.iter().map(Group::name), &mut changed);
        let cells = rule.of(self.cells.iter().map(Group::name), &mut changed);
        Permitted { sides, cells, changed }
    }

    /// A remark for formats whose numbers are any whole ones, and that have no names.
    pub(crate) fn renumbered(&self) -> Remark {
        changed(self.sides.iter().chain(&self.cells), |group| {
            (group.whole.is_none()).then(|| group.reference())
        })
    }

    /// A remark for those that have sides alone.
    pub(crate) fn renumbered_sides(&self) -> Remark {
        changed(self.sides.iter(), |group| group.whole.is_none().then(|| group.reference()))
    }

    /// A remark for formats whose regions have positive numbers.
    pub(crate) fn retagged_cells(&self) -> Remark {
        // Where there are no regions, nobody misses their number.
        changed(self.cells.iter().filter(|_| self.has_regions), Group::changed_tag)
    }

    /// A remark for formats whose markers have positive numbers.
    pub(crate) fn retagged_sides(&self) -> Remark {
        changed(self.sides.iter(), Group::changed_tag)
    }

    /// A remark for formats whose points of the plane have no third coordinate.
    pub(crate) fn without_heights(&self) -> Remark {
        self.has_heights.then(|| "heights are left out".to_owned())
    }

    /// The nodes that cells use, and the number of each node among them, from 0.
    pub(crate) fn dense(&self) -> (Vec<usize>, Vec<usize>) {
        let is_used = self.is_used();
        let used: Vec<usize> = (0..is_used.len()).filter(|&node| is_used[node]).collect();
        let mut number_of = vec![0; is_used.len()];
        used.iter().enumerate().for_each(|(number, &node)| number_of[node] = number);
        (used, number_of)
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

impl<T: Triangulation> Mesh<'_, T> {
    /// The markers of the sides, each once, by increasing number: of the border, which is 1 where nothing else is said, and of the
    /// constraints.
    pub fn side_markers(&self) -> Vec<i64> {
        let mut markers: Vec<i64> =
            if T::Point::COUNT == 2 { self.sides().map(|side| side.1).collect() } else { vec![1] };
        markers.sort_unstable();
        markers.dedup();
        markers
    }

    /// The regions of the simplices, each once, by increasing number; 0 where there are none.
    pub fn region_numbers(&self) -> Vec<f64> {
        let mut regions: Vec<f64> = self.region_values().map_or(vec![0.0], Iterator::collect);
        regions.sort_by(Number::order);
        regions.dedup_by(|one, other| one.order(other).is_eq());
        regions
    }
}

/// Names of groups as a format permits them.
pub(crate) struct Permitted {
    pub(crate) sides: Vec<String>,
    pub(crate) cells: Vec<String>,
    pub(crate) changed: Vec<String>,
}

/// The cell of each side, by its place, and the number of the side there.
fn owners_of<T: Triangulation>(
    mesh: &Mesh<T>,
    sides: &[[VertexId; 2]],
    regions: &[f64],
) -> Vec<(usize, usize)> {
    let mut places: Vec<([VertexId; 2], usize)> =
        sides.iter().enumerate().map(|(side, &ends)| (ordered(ends), side)).collect();
    places.sort_unstable();
    let mut owners: Vec<Option<(usize, usize)>> = vec![None; sides.len()];
    for (cell, (_, corners)) in mesh.cells().enumerate() {
        for k in 0..corners.len() {
            let ends = [0, 1].map(|step| VertexId::new(corners[(k + step) % corners.len()]));
            let Ok(at) = places.binary_search_by_key(&ordered(ends), |place| place.0) else { continue };
            let owner = &mut owners[places[at].1];
            let [from, to] = ends.map(|v| mesh.point(v));
            // Cells are counter-clockwise: this one is on the left of its sides.
            let is_left = from.as_ref() < to.as_ref();
            let goes_first = |&(other, _): &(usize, usize)| match regions[cell].order(&regions[other]) {
                order if order.is_eq() => is_left,
                order => order.is_lt(),
            };
            if owner.as_ref().is_none_or(goes_first) {
                *owner = Some((cell, k + 1));
            }
        }
    }
    owners.into_iter().map(Option::unwrap_or_default).collect()
}

/// A remark on groups whose numbers a format does not permit, and the numbers that they have there.
fn changed<'a>(groups: impl Iterator<Item = &'a Group>, number: impl Fn(&Group) -> Option<i64>) -> Remark {
    let changed: Vec<String> =
        groups.filter_map(|group| Some(format!("{} is {}", group.label, number(group)?))).collect();
    let list = listed(changed.iter().map(String::as_str));
    (!changed.is_empty()).then(|| format!("numbers that it does not permit are changed: {list}"))
}

/// Groups by increasing number; elements keep their order in each.
fn grouped<'a, N: Number>(
    kind: &str,
    numbers: &[N],
    elements: &[Vec<usize>],
    given: impl Fn(N) -> Option<&'a str>,
) -> Vec<Group> {
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
            whole: number.whole(),
            number: number.value(),
            label: format!("{kind}_{}", number.label()),
            given: given(number).map(str::to_owned),
            nodes: part.iter().flat_map(|&i| &elements[i]).copied().collect(),
            ends: part
                .iter()
                .scan(0, |end, &i| {
                    *end += elements[i].len();
                    Some(*end)
                })
                .collect(),
            members: part.to_vec(),
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
            let groups = grouped("region", numbers, &elements[..numbers.len()], |_| None);
            groups
                .into_iter()
                .map(|group| (group.tag, group.name().to_owned(), group.nodes().len()))
                .collect()
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
        let markers = grouped("marker", &[i64::MAX, -8, 0, 1], &elements[..4], |_| None);
        let tags: Vec<(u32, &str)> = markers.iter().map(|group| (group.tag, group.name())).collect();
        assert_eq!(
            tags,
            [(2, "marker_-8"), (3, "marker_0"), (1, "marker_1"), (4, "marker_9223372036854775807")]
        );
    }
}
