//! The triangulations that there are, by number.

use std::cell::RefCell;

use delone_library::Delaunay2;

use crate::fault::{Fault, answer};
use crate::memory;
use crate::tray;

/// A triangulation, and what JavaScript calls its triangles.
pub struct Plane {
    pub triangulation: Delaunay2,
    /// For each slot of the mesh its number among the finite triangles; made when asked for, gone with a change.
    numbers: Option<Vec<u32>>,
}

impl Plane {
    /// Something will change.
    #[cfg(feature = "changes")]
    pub fn changes(&mut self) -> &mut Delaunay2 {
        self.numbers = None;
        &mut self.triangulation
    }

    /// The triangulation, and the numbers of its finite triangles.
    pub fn numbered(&mut self) -> (&mut Delaunay2, &[u32]) {
        let Self { triangulation, numbers } = self;
        let numbers = numbers.get_or_insert_with(|| {
            let mesh = triangulation.mesh();
            let mut numbers = vec![u32::MAX; mesh.slot_count()];
            for (number, t) in mesh.triangles().enumerate() {
                numbers[t.index()] = number as u32;
            }
            numbers
        });
        (triangulation, numbers)
    }
}

thread_local! {
    static PLANES: RefCell<Vec<Option<Plane>>> = RefCell::default();
}

/// Works on a triangulation.
pub fn with(plane: usize, work: impl FnOnce(&mut Plane) -> Result<i32, Fault>) -> i32 {
    answer(PLANES.with_borrow_mut(|planes| {
        planes.get_mut(plane).and_then(Option::as_mut).map_or(Err(Fault::DISPOSED), work)
    }))
}

/// Keeps a triangulation, and gives its number.
fn keep(triangulation: Delaunay2) -> i32 {
    let plane = Some(Plane { triangulation, numbers: None });
    PLANES.with_borrow_mut(|planes| {
        let free = planes.iter().position(Option::is_none).unwrap_or(planes.len());
        if free == planes.len() {
            planes.push(plane);
        } else {
            planes[free] = plane;
        }
        free as i32
    })
}

export! {
    /// Triangulates the points on the tray, and gives the number of the triangulation.
    fn triangulate() -> i32 {
        let points = tray::points();
        answer(
            memory::check(points.len(), memory::TRIANGULATION)
                .and_then(|()| Ok(keep(Delaunay2::from_vec(points)?))),
        )
    }

    /// Forgets a triangulation. Its number may be given again.
    fn forget(plane: usize) -> i32 {
        let old = PLANES.with_borrow_mut(|planes| planes.get_mut(plane).and_then(Option::take));
        i32::from(old.is_some())
    }
}
