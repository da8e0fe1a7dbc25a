//! Points that come, go and move, and the proof that all is right.

use delone_library::{Delaunay2, Error, Inserted, Locate, VertexId};

use crate::fault::Fault;
use crate::planes;

/// Chooses another strategy if the one at work cannot let vertices go: a history only knows how points come. Any other one stays with what it has
/// built, which takes as long as thousands of changes.
fn let_go(triangulation: &mut Delaunay2) -> Result<(), Error> {
    if triangulation.strategy() == Locate::History {
        triangulation.set_strategy(Locate::default())?;
    }
    Ok(())
}

export! {
    /// Inserts a point, and gives its vertex: a new one, or the one that is there.
    fn insert(plane: usize, x: f64, y: f64) -> i32 {
        planes::with(plane, |plane| {
            let inserted: Inserted = plane.changes().insert([x, y])?;
            Ok(inserted.vertex().index() as i32)
        })
    }

    /// Removes a vertex.
    fn remove(plane: usize, vertex: usize) -> i32 {
        planes::with(plane, |plane| {
            let triangulation = plane.changes();
            let_go(triangulation)?;
            triangulation.remove(VertexId::new(vertex))?;
            Ok(0)
        })
    }

    /// Moves a vertex.
    fn move_to(plane: usize, vertex: usize, x: f64, y: f64) -> i32 {
        planes::with(plane, |plane| {
            let triangulation = plane.changes();
            let_go(triangulation)?;
            triangulation.move_to(VertexId::new(vertex), [x, y])?;
            Ok(0)
        })
    }

    /// Proves that a triangulation is the canonical one.
    fn check(plane: usize) -> i32 {
        planes::with(plane, |plane| plane.triangulation.check().map(|()| 0).map_err(|_| Fault::FLAW))
    }
}
