//! Visibility from a vertex, for shortest paths among obstacles.
//!
//! Cost: the degree of the vertex, and O(1) for each edge crossed on the way.

use super::Constrained2;
use super::trace::Leaves;
use crate::error::Error;
use crate::ids::{EdgeId, Place, VertexId};

impl Constrained2 {
    /// Whether the open segment between two vertices meets no constraint: it crosses none, does not run along one, and passes
    /// no vertex where one ends. A vertex sees itself.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`].
    ///
    /// ```
    /// use delone::Constrained2;
    ///
    /// let c = Constrained2::from_parts(&[[0, 0], [4, 0], [2, -1], [2, 3]], &[[2, 3]])?;
    /// let v: Vec<_> = c.vertices().collect();
    /// assert!(c.sees(v[0], v[3])? && !c.sees(v[0], v[1])? && !c.sees(v[2], v[3])?);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn sees(&self, a: VertexId, b: VertexId) -> Result<bool, Error> {
        Ok(self.first_constraint(a, b)?.is_none())
    }

    /// The first constraint that the open segment between two vertices meets, from `a` on: crosses, runs along, or comes to an
    /// end of. It is seen from where the segment comes from, or leads along it, or leaves the vertex.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`].
    pub fn first_constraint(&self, a: VertexId, b: VertexId) -> Result<Option<EdgeId>, Error> {
        let mut met = None;
        self.follow(a, b, |step| {
            met = match step {
                Step::Along(e) | Step::Across(e) => Some(e).filter(|&e| self.is_constraint(e)),
                Step::Through(v) => self.mesh().spokes(v).find(|&e| self.is_constraint(e)),
            };
            met.is_none()
        })?;
        Ok(met)
    }

    /// The edges that the segment between two vertices crosses or runs along, constraints or not, from `a` on.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`].
    pub fn edges_along(&self, a: VertexId, b: VertexId) -> Result<Vec<EdgeId>, Error> {
        let mut edges = Vec::new();
        self.follow(a, b, |step| {
            if let Step::Along(e) | Step::Across(e) = step {
                edges.push(e);
            }
            true
        })?;
        Ok(edges)
    }

    /// Follows the segment between two vertices as long as the answer is yes.
    fn follow(&self, a: VertexId, b: VertexId, mut go_on: impl FnMut(Step) -> bool) -> Result<(), Error> {
        let (mesh, ground) = (self.mesh(), self.ground());
        let place = |v: VertexId| mesh.place(v).ok_or(Error::NoSuchVertex { vertex: v });
        let (mut at, goal) = (place(a)?, place(b)?);
        while at != goal {
            let reached = match ground.leave(at, goal) {
                Leaves::Along(e) => go_on(Step::Along(e)).then(|| mesh.head(e)),
                Leaves::Across(first) => ground.cross([at, goal], first, |e, _| go_on(Step::Across(e))),
            };
            match reached {
                Some(v) if v == goal || go_on(Step::Through(v)) => at = v,
                _ => return Ok(()),
            }
        }
        Ok(())
    }
}

/// A step on the way of a segment.
#[derive(Clone, Copy, Debug)]
enum Step {
    Along(EdgeId),
    Across(EdgeId),
    /// A vertex exactly on it.
    Through(Place),
}
