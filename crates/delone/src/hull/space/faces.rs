//! Flat faces from the triangles of a shell: coplanar neighbors joined, corners in the middle of sides left out.
//!
//! Cost: O(f) exact orientations for f triangles; O(f log f) for their order. Faces are rows of one array: most are triangles, and a list
//! for each would cost more than finding them.

use std::ops::Range;

use delone_predicates::{are_collinear3, lexicographic3, orient3d};

use super::shell::{Facet, NONE, Shell};

/// Faces as rows of corners.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Faces {
    pub(super) corners: Vec<usize>,
    /// Where each begins, and where the last one ends.
    starts: Vec<usize>,
}

impl Faces {
    /// No faces.
    pub(super) fn none() -> Self {
        Self { corners: Vec::new(), starts: vec![0] }
    }

    /// One face.
    pub(super) fn one(corners: Vec<usize>) -> Self {
        Self { starts: vec![0, corners.len()], corners }
    }

    /// The faces of a shell, sorted, with other names of points.
    pub(super) fn of(shell: &Shell, name: impl Fn(usize) -> usize) -> Self {
        let Shell { points, facets, .. } = shell;
        let mut joiner = Joiner {
            points,
            facets,
            face: vec![NONE; facets.len()],
            members: Vec::new(),
            border: Vec::new(),
        };
        let mut faces = Self::none();
        for (f, facet) in facets.iter().enumerate() {
            if facet.alive && joiner.face[f] == NONE {
                joiner.add(f as u32, &mut faces.corners);
                faces.starts.push(faces.corners.len());
            }
        }
        faces.renamed(name).0
    }

    /// Adds a face.
    pub(super) fn push(&mut self, corners: &[usize]) {
        self.corners.extend_from_slice(corners);
        self.starts.push(self.corners.len());
    }

    pub(super) fn iter(&self) -> impl ExactSizeIterator<Item = &[usize]> + Clone {
        self.starts.windows(2).map(|ends| &self.corners[ends[0]..ends[1]])
    }

    /// The face of an index.
    pub(super) fn get(&self, face: usize) -> &[usize] {
        &self.corners[self.range(face)]
    }

    /// Where the corners of a face are, which are the starts of its sides too.
    pub(super) fn range(&self, face: usize) -> Range<usize> {
        self.starts[face]..self.starts[face + 1]
    }

    /// Renames the points and sorts the faces; gives the earlier index of each.
    pub(super) fn renamed(mut self, name: impl Fn(usize) -> usize) -> (Self, Vec<u32>) {
        self.corners.iter_mut().for_each(|i| *i = name(*i));
        let mut order: Vec<(u64, u32)> =
            self.iter().map(|face| (face[0] as u64) << 32 | face[1] as u64).zip(0..).collect();
        // No other face leaves a corner along the same edge.
        order.sort_unstable();
        let mut sorted = Self { corners: Vec::with_capacity(self.corners.len()), starts: vec![0] };
        sorted.starts.reserve(order.len());
        for &(_, face) in &order {
            sorted.push(self.get(face as usize));
        }
        (sorted, order.into_iter().map(|(_, face)| face).collect())
    }
}

/// Joins triangles, in buffers that are kept.
struct Joiner<'a> {
    points: &'a [[f64; 3]],
    facets: &'a [Facet],
    /// For each triangle its face.
    face: Vec<u32>,
    members: Vec<u32>,
    /// The sides around a face, as pairs of corners.
    border: Vec<(u32, u32)>,
}

impl Joiner<'_> {
    fn point(&self, corner: u32) -> [f64; 3] {
        self.points[corner as usize]
    }

    /// Adds the corners of the face that a triangle belongs to.
    fn add(&mut self, first: u32, corners: &mut Vec<usize>) {
        self.members.clear();
        self.members.push(first);
        self.face[first as usize] = first;
        let three = self.facets[first as usize].corners;
        let [a, b, c] = three.map(|i| self.point(i));
        let mut k = 0;
        while let Some(&f) = self.members.get(k) {
            k += 1;
            let Facet { corners: own, across, .. } = self.facets[f as usize];
            for g in across {
                if self.face[g as usize] != NONE {
                    continue;
                }
                // The corners that both have are in the plane.
                let apex = self.facets[g as usize].corners.into_iter().find(|corner| !own.contains(corner));
                if apex.is_none_or(|apex| orient3d(a, b, c, self.point(apex)).is_zero()) {
                    self.face[g as usize] = first;
                    self.members.push(g);
                }
            }
        }
        let start = corners.len();
        if self.members.len() == 1 {
            corners.extend(three.map(|i| i as usize));
        } else {
            self.polygon(first, corners);
        }
        let face = &mut corners[start..];
        let least =
            (0..face.len()).min_by(|&i, &j| lexicographic3(self.points[face[i]], self.points[face[j]]));
        face.rotate_left(least.unwrap_or(0));
    }

    /// Adds the strict corners of the face of some triangles.
    fn polygon(&mut self, first: u32, corners: &mut Vec<usize>) {
        self.border.clear();
        for &f in &self.members {
            let Facet { corners, across, .. } = self.facets[f as usize];
            let outer = (0..3).filter(|&i| self.face[across[i] as usize] != first);
            self.border.extend(outer.map(|i| (corners[i], corners[(i + 1) % 3])));
        }
        let border = &mut self.border;
        border.sort_unstable();
        let follow = |u: u32| border.binary_search_by_key(&u, |&(from, _)| from).ok().map(|i| border[i].1);
        let mut around = vec![border[0].0];
        while let Some(v) = follow(around[around.len() - 1]).filter(|&v| v != around[0]) {
            around.push(v);
        }
        let n = around.len();
        let strict = |&i: &usize| {
            let [a, b, c] = [i + n - 1, i, i + 1].map(|k| self.point(around[k % n]));
            !are_collinear3(a, b, c)
        };
        corners.extend((0..n).filter(strict).map(|i| around[i] as usize));
    }
}
