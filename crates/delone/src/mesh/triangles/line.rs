//! Operations on the flat sphere of ghosts that vertices on one line have: two for each segment.
//!
//! Cost: O(1).

use super::Mesh2;
use crate::ids::{EdgeId, Place, TriangleId};

impl Mesh2 {
    /// Adds two triangles, the ghosts on both sides of a segment u-v: the first left of u -> v, its edges u -> v,
    /// v -> ghost, ghost -> u; the second left of v -> u, likewise.
    fn add_segment(&mut self, u: Place, v: Place) -> [TriangleId; 2] {
        let ghosts = [[u, v], [v, u]].map(|[a, b]| {
            let t = self.new_triangle(TriangleId::new(0));
            self.set_corners(t, [a, b, Place::GHOST]);
            t
        });
        self.link(ghosts[0].edge(0), ghosts[1].edge(0));
        ghosts
    }

    /// The line from the lone vertex to a second one.
    pub(crate) fn begin_line(&mut self, v: Place) {
        let u = self.lone.take().expect("a line begins at a lone vertex");
        let [left, right] = self.add_segment(u, v);
        self.link(left.edge(1), right.edge(2));
        self.link(left.edge(2), right.edge(1));
        self.ghost_edge = left.edge(2);
        self.incident[u.index()] = left.edge(0);
        self.incident[v.index()] = right.edge(0);
        self.vertex_count += 1;
    }

    /// Makes `v` the new end beyond `end`.
    pub(crate) fn extend_line(&mut self, end: Place, v: Place) {
        let outward = self.spokes(end).find(|&e| self.head(e).is_ghost());
        let outward = outward.expect("an end of a line sees the ghost vertex");
        let inward = self.twin(outward);
        // The hull runs ... -> end -> v -> end -> ...
        let [left, right] = self.add_segment(end, v);
        self.link(left.edge(1), right.edge(2));
        self.link(left.edge(2), outward);
        self.link(right.edge(1), inward);
        self.incident[v.index()] = right.edge(0);
        self.vertex_count += 1;
    }

    /// Makes `v` a vertex inside the segment of an edge e = a -> b.
    pub(crate) fn split_segment(&mut self, e: EdgeId, v: Place) {
        let (f, b) = (self.twin(e), self.head(e));
        let (b_ghost, ghost_b) = (e.next(), f.previous());
        let (across_left, across_right) = (self.twin(b_ghost), self.twin(ghost_b));
        let fixed = self.is_fixed(e);
        let [left, right] = self.add_segment(v, b);
        self.set_fixed(left.edge(0), fixed);
        // The old ghosts shrink to a-v: what left b leaves v.
        self.edges[b_ghost.index()].origin = v;
        self.edges[f.index()].origin = v;
        self.link(b_ghost, left.edge(2));
        self.link(ghost_b, right.edge(1));
        if across_left == ghost_b {
            self.link(left.edge(1), right.edge(2)); // b is an end
        } else {
            self.link(left.edge(1), across_left);
            self.link(right.edge(2), across_right);
        }
        self.ghost_edge = left.edge(2);
        self.incident[v.index()] = left.edge(0);
        self.incident[b.index()] = right.edge(0);
        self.vertex_count += 1;
    }

    /// Removes a vertex of the line; its place stays.
    pub(crate) fn remove_from_line(&mut self, v: Place) {
        let along: Vec<EdgeId> = self.spokes(v).filter(|&e| !self.head(e).is_ghost()).collect();
        self.vertex_count -= 1;
        match along[..] {
            [e] if self.vertex_count == 1 => {
                let left = self.head(e);
                self.lone = Some(left);
                self.incident[left.index()] = EdgeId::NONE;
                for t in [e.triangle(), self.twin(e).triangle()] {
                    self.free_triangle(t);
                }
                self.ghost_edge = EdgeId::NONE;
            }
            // The end of the line: e runs from it to its neighbor a, one ghost on either side.
            [e] => {
                let f = self.twin(e);
                let (out_of_a, into_a) = (self.twin(f.previous()), self.twin(e.next()));
                self.link(out_of_a, into_a);
                self.remember(out_of_a);
                self.remember(into_a);
                for t in [e.triangle(), f.triangle()] {
                    self.free_triangle(t);
                }
            }
            // Between a and c: the ghosts of a-v grow to a-c, those of v-c go.
            [to_a, to_c] => {
                let c = self.head(to_c);
                let (left, right) = (self.twin(to_a), to_a); // a -> v and v -> a
                let (left_gone, right_gone) = (to_c, self.twin(to_c)); // v -> c and c -> v
                let (across_left, across_right) =
                    (self.twin(left_gone.next()), self.twin(right_gone.previous()));
                let is_end = across_left == right_gone.previous();
                let fixed = self.is_fixed(to_a) && self.is_fixed(to_c);
                self.set_fixed(right, fixed);
                self.edges[left.next().index()].origin = c;
                self.edges[right.index()].origin = c;
                if is_end {
                    self.link(left.next(), right.previous());
                } else {
                    self.link(left.next(), across_left);
                    self.link(right.previous(), across_right);
                }
                self.remember(right);
                self.remember(left.previous());
                for t in [left_gone.triangle(), right_gone.triangle()] {
                    self.free_triangle(t);
                }
            }
            _ => unreachable!("a vertex of a line has one or two neighbors"),
        }
    }

    /// The line through vertices given from end to end, each with whether its segment with the one before is fixed.
    pub(crate) fn build_line(&mut self, chain: impl IntoIterator<Item = (Place, bool)>) {
        let mut end = None;
        for (v, fixed) in chain {
            match end {
                None => {
                    self.lone = Some(v);
                    self.vertex_count = 1;
                    end = Some(v);
                    continue;
                }
                Some(_) if self.vertex_count == 1 => self.begin_line(v),
                Some(end) => self.extend_line(end, v),
            }
            end = Some(v);
            // The last segment is the one that leaves its end.
            self.set_fixed(self.incident[v.index()], fixed);
        }
    }
}
