//! Flat faces from the triangles of a shell: coplanar neighbours joined, corners in the middle of sides left out.

use delone_predicates::{are_collinear3, lexicographic3, orient3d};

use super::shell::{Facet, NONE, Shell};

/// Flat faces from triangles.
pub(super) struct Faces<'a> {
    points: &'a [[f64; 3]],
    facets: &'a [Facet],
    /// For each triangle its face.
    face: Vec<u32>,
}

impl<'a> Faces<'a> {
    pub(super) fn of(Shell { points, facets, .. }: &'a Shell) -> Vec<Vec<usize>> {
        let mut faces = Self { points, facets, face: vec![NONE; facets.len()] };
        let mut all = Vec::new();
        for (f, facet) in facets.iter().enumerate() {
            if facet.alive && faces.face[f] == NONE {
                all.push(faces.merge(f as u32));
            }
        }
        all.sort_unstable();
        all
    }

    /// The corners of the face that a triangle belongs to.
    fn merge(&mut self, first: u32) -> Vec<usize> {
        let mut members = vec![first];
        self.face[first as usize] = first;
        let [a, b, c] = self.facets[first as usize].corners.map(|i| self.points[i as usize]);
        let is_flat = |j: u32| orient3d(a, b, c, self.points[j as usize]).is_zero();
        let mut k = 0;
        while let Some(&f) = members.get(k) {
            k += 1;
            for g in self.facets[f as usize].across {
                if self.face[g as usize] == NONE && self.facets[g as usize].corners.into_iter().all(is_flat) {
                    self.face[g as usize] = first;
                    members.push(g);
                }
            }
        }
        let mut border = Vec::new();
        for &f in &members {
            let Facet { corners, across, .. } = self.facets[f as usize];
            let outer = (0..3).filter(|&i| self.face[across[i] as usize] != first);
            border.extend(outer.map(|i| (corners[i] as usize, corners[(i + 1) % 3] as usize)));
        }
        self.polygon(border)
    }

    /// The strict corners of a border, from the smallest one.
    fn polygon(&self, mut border: Vec<(usize, usize)>) -> Vec<usize> {
        border.sort_unstable();
        let follow = |u: usize| border.binary_search_by_key(&u, |&(from, _)| from).ok().map(|i| border[i].1);
        let mut around = vec![border[0].0];
        while let Some(v) = follow(around[around.len() - 1]).filter(|&v| v != around[0]) {
            around.push(v);
        }
        let n = around.len();
        let strict = |&i: &usize| {
            let [a, b, c] = [i + n - 1, i, i + 1].map(|k| self.points[around[k % n]]);
            !are_collinear3(a, b, c)
        };
        let mut corners: Vec<usize> = (0..n).filter(strict).map(|i| around[i]).collect();
        let order = |i: &usize| self.points[corners[*i]];
        let least = (0..corners.len()).min_by(|i, j| lexicographic3(order(i), order(j))).unwrap_or(0);
        corners.rotate_left(least);
        corners
    }
}
