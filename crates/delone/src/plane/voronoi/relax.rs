//! Lloyd relaxation: sites move to the centroids of their cells, step by step, until cells are round and of similar
//! size (a centroidal Voronoi diagram).
//!
//! Source: Lloyd, "Least squares quantization in PCM", IEEE Transactions on Information Theory 1982.
//!
//! Cost: a construction and a clipping for each step. Convergence is linear and slow: tens of steps look even.

use crate::error::Error;
use crate::plane::Delaunay2;
use crate::plane::Region2;
use delone_predicates::hypotenuse;

/// How far to relax.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Relaxation2 {
    /// Steps at most.
    pub steps: usize,
    /// Stop when no site moves further than this, in coordinate units.
    pub tolerance: f64,
}

impl Default for Relaxation2 {
    fn default() -> Self {
        Self { steps: 10, tolerance: 0.0 }
    }
}

impl Relaxation2 {
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

    /// Moves sites to the centroids of their cells in a region. Sites whose cell misses the region stay. Returns for
    /// each point of the triangulation, duplicates included, its new position. After each step `progress` is told the
    /// number of steps and the largest distance that a site has moved.
    ///
    /// # Errors
    /// [`Error::Parameter`] if the tolerance is negative or NaN.
    ///
    /// ```
    /// use delone::{Delaunay2, Region2, Relaxation2};
    ///
    /// let d = Delaunay2::from_points(&[[0.1, 0.5], [0.2, 0.5]])?;
    /// let unit = Region2::rectangle([0.0, 0.0], [1.0, 1.0])?;
    /// let relaxed = Relaxation2::default().steps(100).tolerance(1e-9).run(&d, &unit, |_, _| {})?;
    /// assert!((relaxed[0][0] - 0.25).abs() < 1e-6 && (relaxed[1][0] - 0.75).abs() < 1e-6);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn run(
        self,
        triangulation: &Delaunay2,
        region: &Region2,
        mut progress: impl FnMut(usize, f64),
    ) -> Result<Vec<[f64; 2]>, Error> {
        if self.tolerance.is_nan() || self.tolerance < 0.0 {
            let (name, value) = ("tolerance", self.tolerance);
            return Err(Error::Parameter { name, value, range: "zero or more" });
        }
        let ids: Vec<_> = triangulation.vertices().collect();
        let mut sites: Vec<[f64; 2]> = ids.iter().map(|&v| triangulation.point(v)).collect();
        for step in 1..=self.steps {
            let current = Delaunay2::from_vec(sites.clone())?;
            let cells = current.voronoi().clip(region);
            let mut furthest = 0.0_f64;
            for v in current.vertices() {
                if let Some(centroid) = cells.centroid(v) {
                    let [x, y] = sites[v.index()];
                    furthest = furthest.max(hypotenuse(centroid[0] - x, centroid[1] - y));
                    sites[v.index()] = centroid;
                }
            }
            progress(step, furthest);
            if furthest <= self.tolerance {
                break;
            }
        }
        let mut points = triangulation.points().to_vec();
        for (v, site) in ids.into_iter().zip(sites) {
            points[v.index()] = site;
        }
        for duplicate in triangulation.duplicates() {
            points[duplicate.point] = points[duplicate.vertex.index()];
        }
        Ok(points)
    }
}
