//! Meshes of a wanted length of edges: nearly equilateral triangles that grow smoothly.
//!
//! Four steps. `border` gives each constraint vertices at distances as its sizes say (`sizes`, `rings`). `front` fills the rest, a vertex behind
//! an edge of the right length after the other. `relax` moves free vertices to where their triangles are best. Last comes refinement, whose
//! promises about angles hold for these meshes too; where it adds vertices, rounds follow that keep what it reached.
//!
//! Each step is a function of geometry alone, so the mesh is one of the input.
//!
//! Sources: Rebay, "Efficient unstructured mesh generation by means of Delaunay triangulation and Bowyer-Watson algorithm", J. Comput. Phys.
//! 1993 (vertices on Voronoi edges); Engwirda & Ivers, "Off-centre Steiner points for Delaunay-refinement on curved surfaces", CAD 2016
//! (sizes, off-centers and a bound of angles together).
//!
//! Cost: from four to six microseconds a triangle, of which refinement alone takes a quarter of one.

mod border;
mod front;
mod relax;
mod rings;
mod samples;
mod sizes;

use super::mesher::Mesher;
use crate::error::Error;
use crate::ids::Place;
use crate::points::Bounds;
use relax::Way;
use sizes::Sizes;

/// Rounds of relaxation: with the sum of the inverse qualities, and with their squares, which mend the worst. Six or ten of each change
/// the qualities by less than 0.0005.
const RELAXATIONS: [usize; 2] = [4, 4];
/// The weight of equal areas in either. Without it sizes even out, and steps grow.
const EVENNESS: [f64; 2] = [0.15, 0.1];

/// See the module.
pub(super) struct Frontal<'m, 'a> {
    mesher: &'m mut Mesher<'a>,
    sizes: Sizes,
    /// The largest extent of all vertices along an axis.
    extent: f64,
    /// Sizes at vertices of the input that have a reason of their own.
    limits: Vec<(Place, f64)>,
}

impl<'m, 'a> Frontal<'m, 'a> {
    /// For lengths that differ between neighbors by a factor of at most `growth`.
    pub(super) fn new(mesher: &'m mut Mesher<'a>, bounds: &Bounds<2>, growth: f64) -> Self {
        let extent = (0..2).map(|k| bounds.high[k] - bounds.low[k]).fold(0.0, f64::max);
        Self { mesher, sizes: Sizes::new(growth - 1.0), extent, limits: Vec::new() }
    }

    /// Divides constraints, fills what is inside, moves free vertices, and refines.
    pub(super) fn run(mut self) -> Result<(), Error> {
        self.divide_constraints()?;
        self.fill()?;
        for (count, evenness, squares) in
            [(RELAXATIONS[0], EVENNESS[0], false), (RELAXATIONS[1], EVENNESS[1], true)]
        {
            for _ in 0..count {
                self.relax(&Way { evenness, squares, keeps_angles: false })?;
            }
        }
        let before = self.mesher.born.len();
        self.mesher.run()?;
        if self.mesher.born.len() > before {
            self.sizes.resize(self.mesher, &self.mesher.born[before..]);
            for _ in 0..RELAXATIONS[1] {
                self.relax(&Way { evenness: EVENNESS[1], squares: true, keeps_angles: true })?;
            }
            self.mesher.run()?;
        }
        Ok(())
    }

    /// Divides constraints, and does no more; sizes at some vertices have limits.
    pub(super) fn only_divide(mut self, limits: Vec<(Place, f64)>) -> Result<(), Error> {
        self.limits = limits;
        self.divide_constraints()
    }

    fn point(&self, p: Place) -> [f64; 2] {
        self.mesher.point(p)
    }

    fn distance(&self, p: Place, q: Place) -> f64 {
        distance(self.point(p), self.point(q))
    }
}

/// The distance of two points, rounded; the same from either to the other.
fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    super::shape::squared(p, q).sqrt()
}
