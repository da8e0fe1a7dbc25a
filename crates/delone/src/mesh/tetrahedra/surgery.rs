//! Operations on the tetrahedra of a mesh: fill a hole one by one, flip, join a vertex to the border of a cavity.
//!
//! Nothing else writes corners and links. A flip, a star, and a hole that is filled to its last facet put tetrahedra in the place of
//! others with the same border: if [`Mesh3::check`] held before, it holds after. Coordinates are not known here, so whoever calls
//! answers for positive order. There are no tags: nothing in space is constrained.
//!
//! Flips: Edelsbrunner & Shah, "Incremental topological flipping works for regular triangulations", Algorithmica 1996. Stars:
//! Bowyer, and Watson, The Computer Journal 1981. Cost: O(1) for each tetrahedron written, unless an operation says more.

use super::{FACETS, Mesh3, Tetrahedron};
use crate::ids::{FacetId, Place, TetrahedronId};

/// Facets of a border, above which they are glued by sorting: the table grows with the square of their number.
const TABLED_FACETS: usize = 2000;

/// The most facets that wait for their other side in a flip: of its five tetrahedra at most six have another side outside.
const OPEN_FACETS: usize = 16;

/// The least side of the table, in vertices: hardly any border has more.
const LEAST_TABLE: usize = 64;

/// The records that surgery writes: all of a mesh, or the memory of one task.
pub(crate) struct Records<'a> {
    pub(crate) cells: &'a mut [Tetrahedron],
    /// For each tetrahedron a mark, zero between operations.
    pub(crate) marks: &'a mut [u8],
    /// For each place a tetrahedron at its vertex.
    pub(crate) incident: &'a mut [TetrahedronId],
}

impl Records<'_> {
    /// Glues two facets to each other. They must have the same corners.
    #[inline]
    pub(crate) fn link(&mut self, f: FacetId, g: FacetId) {
        self.cells[f.tetrahedron().index()].across[f.corner()] = g;
        self.cells[g.tetrahedron().index()].across[g.corner()] = f;
    }

    /// Takes a tetrahedron away. Those across from it do not know.
    #[inline]
    pub(crate) fn clear(&mut self, t: TetrahedronId) {
        self.cells[t.index()] = Tetrahedron::FREE;
    }

    /// Writes a tetrahedron of a filling. Its corners, and the facets that it is glued to, know it then. A facet whose other side
    /// is written later is glued to none; that other side must name it.
    #[inline]
    pub(crate) fn put(&mut self, t: TetrahedronId, cell: Tetrahedron) {
        self.cells[t.index()] = cell;
        for (k, f) in cell.across.into_iter().enumerate().filter(|(_, f)| *f != FacetId::NONE) {
            self.cells[f.tetrahedron().index()].across[f.corner()] = t.facet(k);
        }
        cell.corners.into_iter().filter(|p| !p.is_ghost()).for_each(|p| self.incident[p.index()] = t);
    }

    /// Flips: some tetrahedra give way to others with the same border, matched by their corners. Two become three around an edge
    /// of their own, one becomes four around a vertex, and back. None become five: a tetrahedron and its ghosts. An edge or a facet
    /// that is new must not be in the mesh before. Slots may be those of the old ones; the ghost is the last corner. A vertex that
    /// is in the old ones alone is none any more.
    ///
    /// Cost: O(1), nothing is allocated.
    pub(crate) fn flip(&mut self, old: &[TetrahedronId], new: &[(TetrahedronId, [Place; 4])]) {
        // The facets that wait for their other side, as that sees them.
        let (mut open, mut count) = ([([Place::GHOST; 3], FacetId::NONE); OPEN_FACETS], 0);
        for t in old {
            let Tetrahedron { corners, across } = self.cells[t.index()];
            for (k, f) in across.into_iter().enumerate().filter(|(_, f)| !old.contains(&f.tetrahedron())) {
                open[count] = (turned(FACETS[k].map(|i| corners[i])), f);
                count += 1;
            }
            let vertices = corners.into_iter().filter(|p| !p.is_ghost());
            vertices.for_each(|p| self.incident[p.index()] = TetrahedronId::NONE);
        }
        for &(t, corners) in new {
            let across = [0, 1, 2, 3].map(|k| {
                let side @ [a, b, c] = turned(FACETS[k].map(|i| corners[i]));
                if let Some(found) = open[..count].iter().position(|facet| facet.0 == side) {
                    count -= 1;
                    open.swap(found, count);
                    return open[count].1;
                }
                open[count] = ([a, c, b], t.facet(k));
                count += 1;
                FacetId::NONE
            });
            self.put(t, Tetrahedron { corners, across });
        }
        debug_assert_eq!(count, 0, "new tetrahedra fill the place of the old ones");
    }

    /// Gives places and tetrahedra other numbers, where they are written. No record moves.
    pub(crate) fn renumber(
        &mut self,
        place: impl Fn(Place) -> Place,
        slot: impl Fn(TetrahedronId) -> TetrahedronId,
    ) {
        let place = |p: Place| if p.is_ghost() { p } else { place(p) };
        for cell in self.cells.iter_mut().filter(|cell| !cell.corners[0].is_ghost()) {
            let across = cell.across.map(|f| slot(f.tetrahedron()).facet(f.corner()));
            *cell = Tetrahedron { corners: cell.corners.map(place), across };
        }
        let used = self.incident.iter_mut().filter(|t| **t != TetrahedronId::NONE);
        used.for_each(|t| *t = slot(*t));
    }
}

impl Mesh3 {
    #[inline]
    pub(crate) fn records(&mut self) -> Records<'_> {
        Records { cells: &mut self.cells, marks: &mut self.marks, incident: &mut self.incident }
    }

    /// A tetrahedron to be filled in, if there is room.
    pub(crate) fn new_cell(&mut self) -> Option<TetrahedronId> {
        self.free.pop().or_else(|| {
            (self.cells.len() < self.most.0).then(|| {
                self.cells.push(Tetrahedron::FREE);
                self.marks.push(0);
                TetrahedronId::new(self.cells.len() - 1)
            })
        })
    }

    /// Gives a tetrahedron back.
    pub(crate) fn free_cell(&mut self, t: TetrahedronId) {
        self.records().clear(t);
        self.free.push(t);
    }

    /// [`Records::flip`], in the slots of the old ones as far as they go. Corners are in positive order, the ghost anywhere. `None`,
    /// and nothing has changed, if there is no room.
    pub(crate) fn flip(
        &mut self,
        old: &[TetrahedronId],
        new: impl ExactSizeIterator<Item = [Place; 4]>,
    ) -> Option<Vec<TetrahedronId>> {
        if new.len() > old.len() + self.room() {
            return None;
        }
        let mut slots: Vec<TetrahedronId> = old.iter().copied().take(new.len()).collect();
        while slots.len() < new.len() {
            slots.push(self.new_cell()?);
        }
        let new: Vec<_> = slots.iter().copied().zip(new.map(ghost_last)).collect();
        self.records().flip(old, &new);
        old.iter().skip(new.len()).for_each(|&t| self.free_cell(t));
        Some(slots)
    }

    /// Moves the last tetrahedra into free slots, given in increasing order, so that none of these is left. Marks stay as
    /// they are.
    pub(crate) fn pack(&mut self, free: &[TetrahedronId]) {
        for &to in free {
            while self.cells.last().is_some_and(|cell| cell.corners[0].is_ghost()) {
                self.cells.pop();
            }
            if to.index() >= self.cells.len() {
                break;
            }
            // Its slot is taken by the last.
            self.cells.swap_remove(to.index());
            let moved = self.cells[to.index()];
            self.records().put(to, moved);
        }
    }
}

/// Joins a vertex to the border of a cavity, in buffers that are kept between cavities.
///
/// Each border vertex gets a small number, and a table by pairs of numbers holds the facet above each directed edge of the
/// border; so nothing is searched. The numbers are found without marks: the slot where a vertex keeps its tetrahedron holds
/// the number for the while. The edges of large borders (of the center of a sphere's surface) are sorted instead.
///
/// Cost: O(k) for k facets; nothing is allocated once the buffers have grown. Sorting: O(k log k).
#[derive(Clone, Debug, Default)]
pub(crate) struct StarFill {
    /// The border's vertices by their number, each with a new tetrahedron; the ghost has the first.
    vertices: Vec<(Place, TetrahedronId)>,
    /// For each facet of the border where its edges are in the table, as seen from the other side.
    edges: Vec<[u32; 3]>,
    /// By the numbers of its ends, the facet above each directed edge of the border.
    table: Vec<FacetId>,
}

impl StarFill {
    /// Joins `v` to every facet of a border, seen from outside, in as many tetrahedra. `v` is the first corner of each, so facet 0 is
    /// the border's. What is written or glued has no mark then. Vertices inside of the cavity keep the tetrahedra that they had.
    pub(crate) fn fill(
        &mut self,
        records: &mut Records<'_>,
        v: Place,
        border: &[FacetId],
        tetrahedra: &[TetrahedronId],
    ) {
        debug_assert_eq!(tetrahedra.len(), border.len(), "a tetrahedron for each facet");
        for (&g, &t) in border.iter().zip(tetrahedra) {
            let outside = &mut records.cells[g.tetrahedron().index()];
            outside.across[g.corner()] = t.facet(0);
            let [a, b, c] = FACETS[g.corner()].map(|k| outside.corners[k]);
            let corners = if a.is_ghost() {
                [v, b, c, a]
            } else if b.is_ghost() {
                [v, c, a, b]
            } else {
                [v, a, b, c]
            };
            records.marks[g.tetrahedron().index()] = 0;
            records.marks[t.index()] = 0;
            records.cells[t.index()] = Tetrahedron { corners, across: [g; 4] };
        }
        if border.len() > TABLED_FACETS {
            self.glue_by_sorting(records, tetrahedra);
        } else {
            self.glue_by_table(records, tetrahedra);
        }
        self.vertices[1..].iter().for_each(|&(p, t)| records.incident[p.index()] = t);
        records.incident[v.index()] = tetrahedra[0];
    }

    /// The vertices that the last one is joined to, the ghost not among them.
    pub(crate) fn joined(&self) -> impl Iterator<Item = Place> {
        self.vertices[1..].iter().map(|vertex| vertex.0)
    }

    /// Glues the tetrahedra of a star to each other, and lists the vertices of the border.
    fn glue_by_table(&mut self, records: &mut Records<'_>, tetrahedra: &[TetrahedronId]) {
        // A sphere of F triangles has F / 2 + 2 corners; the ghost has a number even if it is none of them.
        let side = (tetrahedra.len() / 2 + 3).next_power_of_two();
        let width = side.trailing_zeros();
        if self.table.len() < side * side {
            let most = side.max(LEAST_TABLE);
            self.table.resize(most * most, FacetId::NONE);
            self.vertices.reserve(most);
        }
        let table = &mut self.table[..side * side];
        self.edges.clear();
        self.vertices.clear();
        self.vertices.push((Place::GHOST, TetrahedronId::NONE));
        for &t in tetrahedra {
            let [_, a, b, c] = records.cells[t.index()].corners;
            let i = number(&mut self.vertices, records.incident, a, t);
            let j = number(&mut self.vertices, records.incident, b, t);
            let k = if c.is_ghost() { 0 } else { number(&mut self.vertices, records.incident, c, t) };
            table[j << width | k] = t.facet(1);
            table[k << width | i] = t.facet(2);
            table[i << width | j] = t.facet(3);
            self.edges.push([k << width | j, i << width | k, j << width | i].map(|at| at as u32));
        }
        for (&t, edges) in tetrahedra.iter().zip(&self.edges) {
            let across = &mut records.cells[t.index()].across;
            across[1] = table[edges[0] as usize];
            across[2] = table[edges[1] as usize];
            across[3] = table[edges[2] as usize];
        }
    }

    /// Glues a star of any size.
    #[cold]
    fn glue_by_sorting(&mut self, records: &mut Records<'_>, tetrahedra: &[TetrahedronId]) {
        let mut edges = Vec::with_capacity(3 * tetrahedra.len());
        self.vertices.clear();
        for &t in tetrahedra {
            let [_, a, b, c] = records.cells[t.index()].corners;
            edges.extend([(1, b, c), (2, c, a), (3, a, b)].map(|(k, p, q)| (p.min(q), p.max(q), t.facet(k))));
            self.vertices.extend([(a, t), (b, t), (c, t)]);
        }
        edges.sort_unstable();
        edges.chunks_exact(2).for_each(|pair| records.link(pair[0].2, pair[1].2));
        self.vertices.retain(|vertex| !vertex.0.is_ghost());
        self.vertices.sort_unstable();
        self.vertices.dedup_by_key(|vertex| vertex.0);
        self.vertices.insert(0, (Place::GHOST, TetrahedronId::NONE));
    }
}

/// The number of a vertex of the border, of which `t` is a new tetrahedron.
#[inline]
fn number(
    vertices: &mut Vec<(Place, TetrahedronId)>,
    incident: &mut [TetrahedronId],
    p: Place,
    t: TetrahedronId,
) -> usize {
    let slot = &mut incident[p.index()];
    if vertices.get(slot.index()).is_none_or(|vertex| vertex.0 != p) {
        *slot = TetrahedronId::new(vertices.len());
        vertices.push((p, t));
    }
    slot.index()
}

/// Three from the smallest on, in the same sense.
pub(crate) fn turned<T: Copy + Ord>([a, b, c]: [T; 3]) -> [T; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// Corners in the same order but for two exchanges, so that the ghost is the last.
fn ghost_last(mut corners: [Place; 4]) -> [Place; 4] {
    if let Some(k) = corners[..3].iter().position(|p| p.is_ghost()) {
        corners.swap(k, 3);
        corners.swap((k + 1) % 3, (k + 2) % 3);
    }
    corners
}

#[cfg(test)]
mod tests {
    use delone_generators::{Kind3, Random};

    use super::*;
    use crate::{Delaunay3, VertexId};

    /// A place for one more vertex.
    fn new_place(mesh: &mut Mesh3) -> Place {
        mesh.incident.push(TetrahedronId::NONE);
        mesh.names.add_place();
        let (v, p) = (VertexId::new(mesh.names.given()), Place::new(mesh.incident.len() - 1));
        mesh.names.reserve(1);
        mesh.names.bind(v, p);
        p
    }

    /// Corners from the smallest on, but for the last two, which say the sense.
    fn sorted(mut corners: [Place; 4]) -> [Place; 4] {
        let mut is_odd = false;
        for _ in 0..3 {
            for k in 0..3 {
                if corners[k] > corners[k + 1] {
                    corners.swap(k, k + 1);
                    is_odd = !is_odd;
                }
            }
        }
        if is_odd {
            corners.swap(2, 3);
        }
        corners
    }

    fn all(mesh: &Mesh3) -> Vec<[Place; 4]> {
        let mut all: Vec<_> = mesh.cells().map(|t| sorted(mesh.cells[t.index()].corners)).collect();
        all.sort_unstable();
        all
    }

    fn has(mesh: &Mesh3, face: &[Place]) -> bool {
        let corners = mesh.cells().map(|t| mesh.cells[t.index()].corners);
        corners.into_iter().any(|corners| face.iter().all(|p| corners.contains(p)))
    }

    fn with(mut corners: [Place; 4], k: usize, p: Place) -> [Place; 4] {
        corners[k] = p;
        corners
    }

    /// The tetrahedra of a flip: those that go, and those that come.
    type Flip = (Vec<TetrahedronId>, Vec<[Place; 4]>);

    /// A flip at a tetrahedron whose result is a mesh: that has an edge, or a facet, at most once.
    fn choose(mesh: &mut Mesh3, t: TetrahedronId, random: &mut Random) -> Option<Flip> {
        let Tetrahedron { corners, across } = mesh.cells[t.index()];
        let (i, j) = (random.below(4), random.below(4));
        match random.below(8) {
            0 => {
                let p = new_place(mesh);
                Some((vec![t], (0..4).map(|k| with(corners, k, p)).collect()))
            }
            1..4 => {
                let beyond = across[i].tetrahedron();
                let apex = mesh.cells[beyond.index()].corners[across[i].corner()];
                let new = (0..4).filter(|&k| k != i).map(|k| with(corners, k, apex)).collect();
                (!has(mesh, &[corners[i], apex])).then_some((vec![t, beyond], new))
            }
            4..7 if i != j => {
                let old: Vec<_> = mesh.around_edge(t, [i, j]).collect();
                let others = |t: &TetrahedronId| mesh.cells[t.index()].corners;
                let third = others(&old[1]).into_iter().find(|p| !corners.contains(p))?;
                let ends = [corners[i], corners[j]];
                let mut ring: Vec<_> = corners.into_iter().filter(|p| !ends.contains(p)).collect();
                ring.push(third);
                let new = vec![with(corners, i, third), with(corners, j, third)];
                (old.len() == 3 && !has(mesh, &ring)).then_some((old, new))
            }
            _ => {
                let v = corners[i];
                let mut old = Vec::new();
                if !v.is_ghost() {
                    mesh.star(v, &mut old);
                }
                let link = old.iter().flat_map(|t| mesh.cells[t.index()].corners);
                let last = link.into_iter().find(|p| !corners.contains(p))?;
                let new = with(corners, i, last);
                (old.len() == 4 && !has(mesh, &new)).then_some((old, vec![new]))
            }
        }
    }

    #[test]
    fn flips_can_be_undone() {
        let mut counts = [[0; 5]; 5];
        for seed in 0..4 {
            let mut random = Random::new(seed);
            let mut mesh = Mesh3::default();
            let first = [(); 4].map(|()| new_place(&mut mesh));
            let mut five = vec![first];
            five.extend((0..4).map(|k| {
                let mut beyond = with(first, k, Place::GHOST);
                beyond.swap((k + 1) % 4, (k + 2) % 4);
                beyond
            }));
            assert!(mesh.flip(&[], five.into_iter()).is_some());
            assert_eq!((mesh.check(), mesh.cells().count()), (Ok(()), 5));
            let (begin, mut done) = (all(&mesh), Vec::new());
            for _ in 0..500 {
                let t = TetrahedronId::new(random.below(mesh.slot_count()));
                if !mesh.is_cell(t) {
                    continue;
                }
                let Some((old, new)) = choose(&mut mesh, t, &mut random) else { continue };
                let before: Vec<_> = old.iter().map(|t| mesh.cells[t.index()].corners).collect();
                counts[old.len()][new.len()] += 1;
                let made = mesh.flip(&old, new.iter().copied()).expect("room");
                let corners = made.iter().map(|t| sorted(mesh.cells[t.index()].corners));
                assert!(corners.eq(new.iter().copied().map(sorted)));
                assert_eq!(mesh.check(), Ok(()), "seed {seed}: {before:?} to {new:?}");
                done.push((before, new));
            }
            while let Some((before, new)) = done.pop() {
                let is_new = |t: &TetrahedronId| {
                    let corners = sorted(mesh.cells[t.index()].corners);
                    new.iter().any(|&other| sorted(other) == corners)
                };
                let old: Vec<_> = mesh.cells().filter(is_new).collect();
                assert_eq!(old.len(), new.len());
                assert!(mesh.flip(&old, before.into_iter()).is_some());
                assert_eq!(mesh.check(), Ok(()), "seed {seed}");
            }
            assert!(all(&mesh) == begin);
            assert_eq!(mesh.inhabited().count(), 4);
        }
        let each = [counts[1][4], counts[2][3], counts[3][2], counts[4][1]];
        assert!(each.iter().all(|&count| count > 10), "{each:?}");
    }

    #[test]
    fn flips_without_room_change_nothing() {
        let mut mesh = Delaunay3::from_points(&Kind3::Cube.points(20, 1)).expect("finite").mesh().clone();
        mesh.most = crate::mesh::tetrahedra::Most(mesh.cells.len() + 2);
        let p = new_place(&mut mesh);
        let t = mesh.cells().next().expect("a tetrahedron");
        let before = mesh.cells.clone();
        let corners = mesh.cells[t.index()].corners;
        assert_eq!(mesh.flip(&[t], (0..4).map(|k| with(corners, k, p))), None);
        assert!(mesh.cells == before && mesh.check() == Ok(()));
    }

    /// Tetrahedra that make a ball with all of its corners on its border: each has one corner more than those before.
    fn ball(mesh: &Mesh3, most: usize, random: &mut Random) -> Vec<TetrahedronId> {
        let cells: Vec<_> = mesh.cells().collect();
        let mut ball = vec![cells[random.below(cells.len())]];
        let mut vertices: Vec<Place> = mesh.cells[ball[0].index()].corners.to_vec();
        for _ in 0..40 * most {
            let f = ball[random.below(ball.len())].facet(random.below(4));
            let g = mesh.twin(f);
            let apex = mesh.cells[g.tetrahedron().index()].corners[g.corner()];
            if ball.len() < most && !vertices.contains(&apex) {
                ball.push(g.tetrahedron());
                vertices.push(apex);
            }
        }
        ball
    }

    #[test]
    fn a_star_and_a_hole_undo_each_other() {
        let mut random = Random::new(7);
        let mut star = StarFill::default();
        let mut largest = 0;
        for (n, most) in [(5, 3), (30, 1), (30, 2), (30, 8), (200, 60), (1800, 1200), (200, 60)] {
            let d = Delaunay3::from_points(&Kind3::Cube.points(n, 3)).expect("finite");
            for _ in 0..if n < 1000 { 20 } else { 1 } {
                let mut mesh = d.mesh().clone();
                let before = mesh.cells.clone();
                let ball = ball(&mesh, most, &mut random);
                let facets = ball.iter().flat_map(|t| [0, 1, 2, 3].map(|k| mesh.twin(t.facet(k))));
                let border: Vec<_> = facets.filter(|f| !ball.contains(&f.tetrahedron())).collect();
                assert_eq!(border.len(), 2 * ball.len() + 2);
                largest = largest.max(border.len());
                let mut slots = ball.clone();
                while slots.len() < border.len() {
                    slots.push(mesh.new_cell().expect("room"));
                }
                let v = new_place(&mut mesh);
                mesh.marks.fill(1);
                star.fill(&mut mesh.records(), v, &border, &slots);
                assert_eq!(mesh.check(), Ok(()), "{n} {most}");
                let written = slots.iter().copied().chain(border.iter().map(|f| f.tetrahedron()));
                assert!(written.map(|t| mesh.marks[t.index()]).all(|mark| mark == 0));
                let corners = ball.iter().flat_map(|t| before[t.index()].corners).filter(|p| !p.is_ghost());
                let mut corners: Vec<_> = corners.collect();
                corners.sort_unstable();
                corners.dedup();
                let mut joined: Vec<_> = star.joined().collect();
                joined.sort_unstable();
                assert!(joined == corners);
                let mut found = Vec::new();
                mesh.star(v, &mut found);
                found.sort_unstable();
                let mut expected = slots.clone();
                expected.sort_unstable();
                assert!(found == expected);

                slots[ball.len()..].iter().for_each(|&t| mesh.free_cell(t));
                ball.iter().for_each(|&t| mesh.records().put(t, before[t.index()]));
                mesh.incident[v.index()] = TetrahedronId::NONE;
                assert_eq!(mesh.check(), Ok(()), "{n} {most}");
                assert!(mesh.cells[..before.len()] == before[..]);
            }
        }
        assert!(largest > TABLED_FACETS, "{largest}");
    }
}
