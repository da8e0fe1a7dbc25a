//! A mesh is made coarser: vertices that refinement has put go again, where that is wanted.
//!
//! A vertex goes if all triangles around it are marked, and if the triangles that take their place have no angle below the bound, or none
//! smaller than there was. They are known before anything changes: they are the constrained Delaunay triangulation of the star's border. New
//! triangles are not marked, so one call takes away no two neighbors.
//!
//! Cost: O(k log k) for a star of k triangles; O(n log n) in all.

use std::collections::BTreeSet;

use super::shape::Shape;
use super::{Refined2, Refinement};
use crate::error::Error;
use crate::ids::{EdgeId, TriangleId, VertexId};
use crate::plane::constrained::{Constrained2, Fill};

/// The corners of a triangle, in order.
type Corners = [VertexId; 3];

fn sorted(mut corners: Corners) -> Corners {
    corners.sort_unstable();
    corners
}

impl Refined2 {
    /// Takes vertices away that refinement has put, where all triangles around are marked: for solvers whose solution has become smooth. No
    /// angle falls below `min_angle` degrees, or below the smallest around. The last vertices go first, so that it undoes refinement. A vertex
    /// on a constraint goes where the constraint is exactly straight there. Ids stay, and those that went are free.
    ///
    /// Gives the mesh as it is then; this one is no longer valid.
    ///
    /// Cost: O(n log n).
    ///
    /// # Errors
    /// [`Error::Parameter`] for an angle that is not from 0 to less than 60, [`Error::Parts`] if the mesh has changed since.
    ///
    /// ```
    /// use delone::{Constrained2, Refinement};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [4, 0], [4, 4], [0, 4]], &[])?;
    /// let fine = Refinement::new().max_area(0.1).run(&mut c)?;
    /// let coarse = fine.coarsen(&mut c, &|_| true, 20.0)?;
    /// assert!(coarse.report.triangles < fine.report.triangles && coarse.report.smallest_angle >= 20.0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn coarsen(
        &self,
        c: &mut Constrained2,
        is_marked: &dyn Fn(TriangleId) -> bool,
        min_angle: f64,
    ) -> Result<Self, Error> {
        Refinement::new().min_angle(min_angle).check()?;
        // Parts of another triangulation are refused.
        c.domains(&Fill::Parts(&self.domains))?;
        let corners = |c: &Constrained2, t: TriangleId| sorted(c.mesh().corners(t));
        let (mut marked, mut outside) = (BTreeSet::new(), BTreeSet::new());
        for t in c.triangle_ids() {
            if !self.domains.is_inside(t) {
                outside.insert(corners(c, t));
            } else if is_marked(t) {
                marked.insert(corners(c, t));
            }
        }
        let old = c.clone();
        let may_go = |v: VertexId| {
            let origin = self.domains.origins.get(v.index());
            origin.is_some_and(|origin| origin.on[0].is_ghost() || origin.on[0] != origin.on[1])
        };
        let mut candidates: Vec<VertexId> = c.vertices().filter(|&v| may_go(v)).collect();
        candidates.sort_unstable();
        let cosine = libm::cos(min_angle.to_radians());
        for v in candidates.into_iter().rev() {
            let mesh = c.mesh();
            let star: Vec<EdgeId> = mesh.star(v).filter(|e| !mesh.is_ghost(e.triangle())).collect();
            let known: Vec<Corners> = star.iter().map(|e| corners(c, e.triangle())).collect();
            let is_free = known.iter().all(|corners| marked.contains(corners) || outside.contains(corners));
            if !is_free {
                continue;
            }
            let is_inside: Vec<bool> = known.iter().map(|corners| !outside.contains(corners)).collect();
            if keeps_angles(c, v, &star, &is_inside, cosine * cosine) && c.remove(v).is_ok() {
                known.iter().for_each(|corners| {
                    marked.remove(corners);
                    outside.remove(corners);
                });
            }
        }
        let domains = c.carried(&old, &self.domains);
        Refinement::new().min_angle(0.0).fill(Fill::Parts(&domains)).run(c)
    }
}

/// Whether no angle becomes too small where a vertex goes, of whose edges some are given with whether their triangle is inside.
fn keeps_angles(c: &mut Constrained2, v: VertexId, star: &[EdgeId], is_inside: &[bool], bound: f64) -> bool {
    let mut worst = bound;
    for (e, _) in star.iter().zip(is_inside).filter(|side| *side.1) {
        let Some(shape) = Shape::of(c.layer(), e.triangle()) else { return false };
        worst = worst.max(shape.squared_cosine());
    }
    let mesh = c.mesh();
    let is_all = star.len() == mesh.star(v).count();
    // Where a constraint begins, and behind the hull, there is another polygon.
    let first = (0..star.len()).find(|&k| c.is_constraint(star[k])).unwrap_or(0);
    let mut polygons: Vec<Vec<[f64; 2]>> = Vec::new();
    for k in (0..star.len()).map(|step| (first + step) % star.len()) {
        let (e, end) = (star[k], mesh.apex(star[k]));
        if polygons.is_empty() || c.is_constraint(e) || mesh.is_ghost(mesh.twin(e).triangle()) {
            polygons.push(vec![c.point(mesh.destination(e))]);
        }
        let polygon = polygons.last_mut().expect("just made");
        polygon.push(c.point(end));
        if !is_inside[k] {
            // No triangle of it counts.
            polygon.clear();
        }
    }
    if is_all && polygons.len() == 1 {
        polygons[0].pop();
    }
    polygons.iter().filter(|polygon| polygon.len() > 2).all(|polygon| {
        let sides: Vec<[usize; 2]> = (0..polygon.len()).map(|k| [k, (k + 1) % polygon.len()]).collect();
        let Ok(mut made) = Constrained2::from_parts(polygon, &sides) else { return false };
        let Ok(parts) = made.domains(&Fill::EvenOdd) else { return false };
        let inside: Vec<TriangleId> = made.triangle_ids().filter(|&t| parts.is_inside(t)).collect();
        inside
            .into_iter()
            .all(|t| Shape::of(made.layer(), t).is_some_and(|shape| shape.squared_cosine() <= worst))
    })
}
