//! Measures of a mesh that tell how good it is for computing: qualities of triangles, and steps from one to the next.
//!
//! Cost: O(n), 16 bytes a triangle for a moment.

use super::shape::squared;
use crate::ids::TriangleId;
use crate::plane::{Constrained2, Domains2};

/// How nearly equilateral the triangles inside are, and how evenly they grow. Rounded.
///
/// The quality of a triangle is 4 sqrt(3) times its area over the sum of the squares of its sides: 1 if it is equilateral, nearly 0 if it is
/// flat (Bank, "PLTMG", SIAM 1998). A step is the ratio of the areas of two triangles with a common edge, the larger one first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Shapes2 {
    /// The mean of all qualities; 0 if there is no triangle.
    pub quality_mean: f64,
    /// A quality that 5 percent of the triangles do not reach; 0 if there is no triangle.
    pub quality_p5: f64,
    /// A step that 5 percent of the edges inside exceed; 1 if there is none.
    pub step_p95: f64,
}

impl Shapes2 {
    /// Measures the triangles inside, but for those of boundary layers.
    ///
    /// ```
    /// use delone::{Constrained2, Fill, Shapes2};
    ///
    /// let c = Constrained2::from_parts(&[[0.0, 0.0], [1.0, 0.0], [0.5, 0.75_f64.sqrt()]], &[])?;
    /// let shapes = Shapes2::of(&c, &c.domains(&Fill::All)?);
    /// assert!((shapes.quality_mean - 1.0).abs() < 1e-15 && shapes.step_p95 == 1.0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn of(c: &Constrained2, domains: &Domains2) -> Self {
        let mesh = c.mesh();
        let counts = |&t: &TriangleId| domains.is_inside(t) && !domains.is_layer(t);
        let inside = || c.triangle_ids().filter(counts);
        let quality = |t| {
            let [p, q, r] = mesh.corners(t).map(|v| c.point(v));
            4.0 * 3.0_f64.sqrt() * (c.area(t) / (squared(p, q) + squared(q, r) + squared(r, p)))
        };
        let mut qualities: Vec<f64> = inside().map(quality).collect();
        if qualities.is_empty() {
            return Self { step_p95: 1.0, ..Self::default() };
        }
        // In the order of their sizes, so that the sum does not depend on the order of triangles.
        qualities.sort_unstable_by(f64::total_cmp);
        let edges = inside().flat_map(|t| [0, 1, 2].map(|k| t.edge(k)));
        let inner = edges.filter(|&e| e < mesh.twin(e) && counts(&mesh.twin(e).triangle()));
        let areas = inner.map(|e| [e, mesh.twin(e)].map(|e| c.area(e.triangle())));
        let mut steps: Vec<f64> = areas.map(|[p, q]| (p / q).max(q / p)).collect();
        let at = steps.len() * 95 / 100;
        let step_p95 =
            if steps.is_empty() { 1.0 } else { *steps.select_nth_unstable_by(at, f64::total_cmp).1 };
        Self {
            quality_mean: qualities.iter().sum::<f64>() / qualities.len() as f64,
            quality_p5: qualities[qualities.len() / 20],
            step_p95,
        }
    }
}
