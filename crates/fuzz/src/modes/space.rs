//! Small sets in space, as in the plane.

use delone::Delaunay3;
use delone_generators::Random;

use super::builds;
use crate::attack::{Attack, Judgement};
use crate::nasty;

/// See the module.
pub(crate) struct Space;

impl Attack for Space {
    type Item = [f64; 3];

    fn make(random: &mut Random) -> Vec<[f64; 3]> {
        nasty::points(random, 22)
    }

    fn judge(points: &[[f64; 3]], seed: u64) -> Judgement {
        builds::judge::<Delaunay3, 3>(points, seed)
    }
}
