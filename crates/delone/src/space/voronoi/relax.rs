//! Lloyd relaxation in space: sites move to the centroids of their cells, step by step, until cells are round and of similar size (a
//! centroidal Voronoi diagram).
//!
//! Source: Lloyd, "Least squares quantization in PCM", IEEE Transactions on Information Theory 1982.
//!
//! Cost: a construction and a clipping for each step. Convergence is linear and slow: tens of steps look even.

use crate::error::Error;
use crate::space::{Delaunay3, Region3};

/// How far to relax.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Relaxation3 {
    /// Steps at most.
    pub steps: usize,
    /// Stop when no site moves further than this, in coordinate units.
    pub tolerance: f64,
}

impl Default for Relaxation3 {
    fn default() -> Self {
        Self { steps: 10, tolerance: 0.0 }
    }
}

impl Relaxation3 {
    /// Sets [`Self::steps`].
    #[must_use]
    pub fn steps(self, steps: usize) -> Self {
        Self { steps, ..self }
    }

    /// Sets [`Self::tolerance`].
    #[must_use]
    pub fn tolerance(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    /// Moves vertices to the centroids of their cells in a region. Those whose cell misses the region stay. Returns their new positions, in
    /// the order of [`Delaunay3::vertices`]. After each step `progress` is told the number of steps and the largest distance that a site has
    /// moved.
    ///
    /// # Errors
    /// [`Error::Parameter`] if the tolerance is negative or NaN.
    ///
    /// ```
    /// use delone::{Delaunay3, Region3, Relaxation3};
    ///
    /// let d = Delaunay3::from_points(&[[0.1, 0.5, 0.5], [0.2, 0.5, 0.5]])?;
    /// let unit = Region3::cuboid([0.0, 0.0, 0.0], [1.0, 1.0, 1.0])?;
    /// let relaxed = Relaxation3::default().steps(100).tolerance(1e-9).run(&d, &unit, |_, _| {})?;
    /// assert!((relaxed[0][0] - 0.25).abs() < 1e-6 && (relaxed[1][0] - 0.75).abs() < 1e-6);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn run(
        self,
        triangulation: &Delaunay3,
        region: &Region3,
        mut progress: impl FnMut(usize, f64),
    ) -> Result<Vec<[f64; 3]>, Error> {
        if self.tolerance.is_nan() || self.tolerance < 0.0 {
            let (name, value) = ("tolerance", self.tolerance);
            return Err(Error::Parameter { name, value, range: "zero or more" });
        }
        let mut sites: Vec<[f64; 3]> = triangulation.points().map(|(_, p)| p).collect();
        for step in 1..=self.steps {
            let current = Delaunay3::from_vec(sites.clone())?;
            let mut furthest = 0.0_f64;
            current.voronoi().clip_each(region, |v, cell| {
                if let Some(centroid) = cell.centroid() {
                    let site = &mut sites[v.index()];
                    let square: f64 = (0..3).map(|k| (centroid[k] - site[k]).powi(2)).sum();
                    furthest = furthest.max(square.sqrt());
                    *site = centroid;
                }
            });
            progress(step, furthest);
            if furthest <= self.tolerance {
                break;
            }
        }
        Ok(sites)
    }
}
