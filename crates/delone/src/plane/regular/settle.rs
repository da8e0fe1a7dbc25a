//! Where a site falls among others: it becomes a vertex and may hide some, or is hidden itself.
//!
//! Source: Edelsbrunner & Shah, "Incremental topological flipping works for regular triangulations", Algorithmica 1996, for
//! the cavity of a site; it is dug as without weights, and the vertices inside of it are hidden. Sites on one line have a
//! regular triangulation of their own: a chain, from which the neighbors of a new one go as long as it hides them.
//!
//! Cost: that of the cavity, and O(1) for each site that is hidden.

use crate::ids::{EdgeId, Place};
use crate::plane::layer::Layer;
use crate::plane::layer::insert::Spot;
use crate::plane::layer::kernel::{Kernel, Power};
use crate::tally::Tally;

/// The outcome for a site.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Settled {
    Vertex,
    /// It equals this vertex, its weight included.
    Equal(Place),
    Hidden,
}

impl Layer<Power> {
    /// Makes the site at a place a vertex, if it is one among the others. It falls where `spot` says; the places of those
    /// that it hides are added to a list.
    pub(super) fn settle<T: Tally>(
        &mut self,
        v: Place,
        spot: Spot,
        hidden: &mut Vec<Place>,
        tally: &mut T,
    ) -> Settled {
        let q = self.site(v);
        let stays_above = match spot {
            Spot::Vertex(w) if q.1 == self.weights[w.index()] => return Settled::Equal(w),
            Spot::Vertex(w) => q.1 < self.weights[w.index()],
            Spot::Segment(e) => {
                let [a, b] = [self.mesh.tail(e), self.mesh.head(e)].map(|p| self.site(p));
                !Power::contains_on_line(a, b, q)
            }
            Spot::Triangle(t) => {
                let corners = self.mesh.places(t);
                tally.in_circle();
                !Power::conflicts(corners, |k| self.site(corners[k]), q)
            }
            Spot::Empty | Spot::BesidePoint | Spot::End(_) | Spot::BesideLine(_) => false,
        };
        if stays_above {
            return Settled::Hidden;
        }
        match spot {
            Spot::Vertex(w) if self.spanned => {
                let t = self.mesh.incident[w.index()].triangle();
                self.insert_at(v, Spot::Triangle(t), tally);
            }
            Spot::Vertex(w) => {
                self.rename(w, v);
                hidden.push(w);
            }
            spot => self.insert_at(v, spot, tally),
        }
        match spot {
            Spot::Vertex(_) | Spot::Segment(_) | Spot::End(_) if !self.spanned => self.hide_along(v, hidden),
            Spot::Vertex(_) | Spot::Triangle(_) => hidden.extend(self.cavity.swallowed().0),
            _ => {}
        }
        Settled::Vertex
    }

    /// Takes the neighbors of a vertex away that it hides, while all are on one line.
    fn hide_along(&mut self, v: Place, hidden: &mut Vec<Place>) {
        while let Some(w) = self.hidden_neighbor(v) {
            self.leave_line(w);
            self.mesh.incident[w.index()] = EdgeId::NONE;
            hidden.push(w);
        }
    }

    fn hidden_neighbor(&self, v: Place) -> Option<Place> {
        let along = |p: Place| self.mesh.spokes(p).map(|e| self.mesh.head(e)).filter(|p| !p.is_ghost());
        if self.mesh.lone.is_some() {
            return None;
        }
        along(v).find(|&w| {
            let beyond = along(w).find(|&x| x != v);
            beyond.is_some_and(|x| !Power::contains_on_line(self.site(v), self.site(x), self.site(w)))
        })
    }
}
