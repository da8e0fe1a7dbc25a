//! A convex polyhedron cut by half-spaces.
//!
//! Its corners are meetings of three planes, and stay that until the end: what is decided about them is decided exactly, and never a tie. So
//! three faces meet at each corner, and to cut is: drop the corners beyond; each edge with one end among them gets a new corner.
//!
//! Cost: O(k) for a cut of a polyhedron with k corners, O(k log k) for its faces.

use delone_predicates::{Corner3, HalfSpace, HalfSpaces};

/// See the module.
pub(in crate::space) struct Solid {
    planes: HalfSpaces,
    /// For each plane what is beyond it, if it is to have a face.
    beyond: Vec<Option<u32>>,
    corners: Vec<Corner3>,
    edges: Vec<[usize; 2]>,
    /// Of each corner its three faces, with the face before and the face after in the turn around it, and its index.
    turns: Vec<[usize; 4]>,
}

impl Default for Solid {
    fn default() -> Self {
        Self {
            planes: HalfSpaces::new([0.0; 3]),
            beyond: Vec::new(),
            corners: Vec::new(),
            edges: Vec::new(),
            turns: Vec::new(),
        }
    }
}

impl Solid {
    /// Begins anew, seen from a point.
    pub(in crate::space) fn restart(&mut self, from: [f64; 3]) {
        self.planes.restart(from);
        self.beyond.clear();
        self.corners.clear();
    }

    /// Adds a plane without cutting, and what is beyond it, if it is to have a face.
    pub(in crate::space) fn push_plane(&mut self, side: HalfSpace, beyond: Option<u32>) {
        self.planes.push(side);
        self.beyond.push(beyond);
    }

    /// Adds the corner of three planes.
    pub(in crate::space) fn push_corner(&mut self, planes: [usize; 3]) {
        self.corners.extend(self.planes.corner(planes));
    }

    /// Begins with a box, seen from a point: its sides low and high by axis, each with what is beyond it.
    pub(in crate::space) fn restart_with_box(
        &mut self,
        from: [f64; 3],
        sides: impl Iterator<Item = (HalfSpace, Option<u32>)>,
    ) {
        self.restart(from);
        sides.for_each(|(side, beyond)| self.push_plane(side, beyond));
        (0..8).for_each(|i| self.push_corner([i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2 & 1)]));
    }

    /// Keeps what is inside of a half-space.
    pub(in crate::space) fn cut(&mut self, half_space: HalfSpace, beyond: u32) {
        let plane = self.planes.push(half_space);
        let Self { planes, corners, edges, .. } = self;
        edges.clear();
        corners.retain(|corner| {
            let is_kept = planes.holds(corner, plane);
            if !is_kept {
                let [i, j, k] = corner.planes();
                edges.extend([[i, j], [j, k], [k, i]].map(|[i, j]| [i.min(j), i.max(j)]));
            }
            is_kept
        });
        if edges.is_empty() {
            planes.pop();
            return;
        }
        self.beyond.push(Some(beyond));
        edges.sort_unstable();
        for edge in edges.chunk_by(|p, q| p == q).filter(|ends| ends.len() == 1) {
            let [i, j] = edge[0];
            corners.extend(planes.corner([i, j, plane]));
        }
    }

    pub(in crate::space) fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }

    /// The corners, each after the codes of what is beyond its three planes.
    pub(in crate::space) fn corners(&self) -> impl Iterator<Item = ([Option<u32>; 3], &Corner3)> {
        self.corners.iter().map(|corner| (corner.planes().map(|i| self.beyond[i]), corner))
    }

    /// The place of a corner, correctly rounded.
    pub(in crate::space) fn place(&self, corner: &Corner3) -> [f64; 3] {
        self.planes.rounded(corner)
    }

    /// Hands out each face: what is beyond it, and its corners by index, counter-clockwise seen from outside.
    pub(in crate::space) fn faces(&mut self, mut each: impl FnMut(u32, &[u32])) {
        self.turns.clear();
        for (index, corner) in self.corners.iter().enumerate() {
            let [i, j, k] = corner.planes();
            // A face is entered along the edge with the one and left along that with the other.
            self.turns.extend([[i, j, k, index], [j, k, i, index], [k, i, j, index]]);
        }
        self.turns.sort_unstable();
        let mut ring = Vec::new();
        for face in self.turns.chunk_by(|p, q| p[0] == q[0]) {
            let Some(beyond) = self.beyond[face[0][0]] else { continue };
            ring.clear();
            let mut at = 0;
            for _ in face {
                ring.push(face[at][3] as u32);
                let left = face[at][2];
                at = face.binary_search_by_key(&left, |turn| turn[1]).unwrap_or_default();
            }
            each(beyond, &ring);
        }
    }
}
