//! Points that come, go and move.

use delone_library::{Inserted, Locate, VertexId};

use crate::planes;

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
            // Some strategies only know how points come.
            triangulation.set_strategy(Locate::default())?;
            triangulation.remove(VertexId::new(vertex))?;
            Ok(0)
        })
    }

    /// Moves a vertex.
    fn move_to(plane: usize, vertex: usize, x: f64, y: f64) -> i32 {
        planes::with(plane, |plane| {
            let triangulation = plane.changes();
            triangulation.set_strategy(Locate::default())?;
            triangulation.move_to(VertexId::new(vertex), [x, y])?;
            Ok(0)
        })
    }
}
