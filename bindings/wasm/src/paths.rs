//! How points are found, for those who draw it: every strategy of location, and what it looked at.

use delone_library::{Ask, Hierarchy, JumpAndWalk, Locate, Tally, Walk};

use crate::locate::leave_found;
use crate::planes;
use crate::tray;

/// The strategies by number, as `js/plane.js` has them by name.
fn strategy(number: u32) -> Locate {
    match number {
        1 => Locate::Walk(Walk::default()),
        2 => Locate::JumpAndWalk(JumpAndWalk::default()),
        3 => Locate::Hierarchy(Hierarchy::default()),
        4 => Locate::History,
        _ => Locate::Tree,
    }
}

/// The trace of a search: triangles, the ends of hull edges, and vertices, by their corners.
#[derive(Default)]
struct Path {
    corners: Vec<f64>,
    /// Where each ends, in coordinates.
    ends: Vec<u32>,
}

impl Tally for Path {
    fn saw(&mut self, corners: impl FnOnce() -> Vec<Vec<f64>>) {
        self.corners.extend(corners().into_iter().flatten());
        self.ends.push(self.corners.len() as u32);
    }
}

export! {
    /// As `locate`, by a strategy of choice, and leaves also what was looked at: coordinates, and as integers where each ends.
    fn locate_by(plane: usize, x: f64, y: f64, by: u32) -> i32 {
        planes::with(plane, |plane| {
            let (triangulation, numbers) = plane.numbered();
            let wanted = strategy(by);
            if triangulation.strategy() != wanted {
                triangulation.set_strategy(wanted)?;
            }
            let mut path = Path::default();
            let found = triangulation.find_observed([x, y], &mut path)?;
            let kind = leave_found(&found, numbers);
            tray::leave_ints(1, path.ends);
            tray::leave_floats(0, path.corners);
            Ok(kind)
        })
    }
}
