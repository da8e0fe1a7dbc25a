//! Small sets in the plane: every algorithm, strategy and number of threads gives what the definition says.

use delone::Delaunay2;
use delone_generators::Random;

use super::builds;
use crate::attack::{Attack, Judgement};
use crate::nasty;

/// See the module.
pub(crate) struct Plane;

impl Attack for Plane {
    type Item = [f64; 2];

    fn make(random: &mut Random) -> Vec<[f64; 2]> {
        nasty::points(random, 40)
    }

    fn judge(points: &[[f64; 2]], seed: u64) -> Judgement {
        builds::judge::<Delaunay2, 2>(points, seed)?;
        builds::judge_hull(points)
    }
}
