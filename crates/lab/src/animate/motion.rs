//! Points in Brownian motion (Devillers 2011, §5), and their triangulation kept up.

use delone::{Bounds, Delaunay2, Moving2, Step2};
use delone_cli::message::Failure;
use delone_generators::{Random, in_ball};
use delone_io::Error;

use crate::args::AnimateArgs;

/// Points that move at random inside of their box.
pub(super) struct Film {
    pub(super) moving: Moving2,
    positions: Vec<[f64; 2]>,
    pub(super) window: [[f64; 2]; 2],
    radius: f64,
    random: Random,
    pub(super) repaired: usize,
    pub(super) rebuilt: usize,
}

/// The box of some points; a window has finite corners, around no point too.
pub(super) fn window(points: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let bounds = Bounds::of(points.iter().copied());
    [bounds.low, bounds.high].map(|corner| corner.map(|x| x.clamp(f64::MIN, f64::MAX)))
}

impl Film {
    pub(super) fn new(positions: Vec<[f64; 2]>, args: &AnimateArgs) -> Result<Self, Failure> {
        let moving =
            Moving2::from_points(&positions).map_err(|error| Failure::points(&args.input.label(), &error))?;
        let window = window(&positions);
        let [low, high] = window;
        // A tenth of the distance of neighbors in an even set.
        let longer = [0, 1].into_iter().map(|k| high[k] / 2.0 - low[k] / 2.0).fold(0.0, f64::max);
        let radius = args.radius.unwrap_or(0.2 * longer / (positions.len().max(1) as f64).sqrt());
        let random = Random::new(args.seed);
        Ok(Self { moving, positions, window, radius, random, repaired: 0, rebuilt: 0 })
    }

    /// The triangulation at a step: the start, or one step after the last.
    pub(super) fn at(&mut self, step: usize) -> Result<&Delaunay2, Error> {
        if step > 0 {
            let [low, high] = self.window;
            for p in &mut self.positions {
                let shift: [f64; 2] = in_ball(&mut self.random);
                // Those that reach the border stay there until they turn.
                *p = [0, 1].map(|k| (p[k] + self.radius * shift[k]).clamp(low[k], high[k]));
            }
            let step =
                self.moving.step(&self.positions).map_err(|error| Error::Content(error.to_string()))?;
            match step {
                Step2::Repaired { .. } => self.repaired += 1,
                _ => self.rebuilt += 1,
            }
        }
        Ok(self.moving.triangulation())
    }
}
