//! Observers of operations. `()` observes nothing and costs nothing.

/// Receives one call for each step of an operation.
pub trait Tally {
    /// A triangle was visited by a walk or a descent; where all vertices are on one line, a vertex of it.
    fn visited(&mut self) {}
    /// A vertex was compared with others for its distance.
    fn compared(&mut self) {}
    /// A triangle that was visited, or a vertex that was compared, by its corners; those of a ghost are the ends of its hull
    /// edge. For those who draw what is done: a walk tells all of them, in order.
    fn saw(&mut self, _corners: impl FnOnce() -> Vec<Vec<f64>>) {}
    /// The orientation of three points was asked for.
    fn orientation(&mut self) {}
    /// A triangle was tested for conflict with a point.
    fn in_circle(&mut self) {}
    /// Triangles were created, ghosts included.
    fn created(&mut self, _count: usize) {}
    /// Triangles were destroyed, ghosts included.
    fn destroyed(&mut self, _count: usize) {}
    /// Reports that the next steps are on this level of a hierarchy; 0 is the triangulation itself.
    fn level(&mut self, _level: usize) {}
    /// Reports that the next steps belong to this phase of a search.
    fn phase(&mut self, _phase: Phase) {}
    /// Another part of the operation did this.
    fn add(&mut self, _other: &Self)
    where
        Self: Sized,
    {
    }
}

impl Tally for () {}

/// A phase of a search: those of the Delaunay hierarchy (Devillers 1998, §2.2), and the one before. Every search has the
/// third.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Phase {
    /// Vertices are drawn at random.
    Sample,
    /// Triangles around a vertex, up to the line to the goal.
    Turn,
    /// Triangles on the way to the goal.
    Walk,
    /// The nearest vertex.
    Nearest,
}

/// The work of operations, added up.
///
/// ```
/// use delone::{Ask, Delaunay2, Work};
///
/// let triangulation = Delaunay2::from_points(&[[0.0, 0.0], [2.0, 0.0], [1.0, 2.0]])?;
/// let mut work = Work::default();
/// triangulation.find_observed([1.0, 1.0], &mut work)?;
/// assert!(work.visited > 0);
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Work {
    /// Triangles visited by walks and descents, and vertices of a line.
    pub visited: u64,
    /// Vertices compared for their distance.
    pub compared: u64,
    /// Orientations asked for.
    pub orientations: u64,
    /// Conflict tests of triangles with points.
    pub in_circles: u64,
    /// Triangles created, ghosts included.
    pub created: u64,
    /// Triangles destroyed, ghosts included.
    pub destroyed: u64,
}

impl Tally for Work {
    fn visited(&mut self) {
        self.visited += 1;
    }

    fn compared(&mut self) {
        self.compared += 1;
    }

    fn orientation(&mut self) {
        self.orientations += 1;
    }

    fn in_circle(&mut self) {
        self.in_circles += 1;
    }

    fn created(&mut self, count: usize) {
        self.created += count as u64;
    }

    fn destroyed(&mut self, count: usize) {
        self.destroyed += count as u64;
    }

    fn add(&mut self, other: &Self) {
        self.visited += other.visited;
        self.compared += other.compared;
        self.orientations += other.orientations;
        self.in_circles += other.in_circles;
        self.created += other.created;
        self.destroyed += other.destroyed;
    }
}

/// Counts of an algorithm's steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Counters {
    /// Of [`crate::Algorithm2::DivideAndConquer`].
    DivideAndConquer(Merges),
    /// Of insertion one by one, whatever locates the points.
    Incremental(Work),
    /// Of [`crate::Algorithm2::ConflictLists`].
    ConflictLists {
        /// Splits, flips and conflict tests.
        work: Work,
        /// Points put from one list to another.
        moved: u64,
    },
}

impl Counters {
    /// The steps, of an algorithm that takes them one by one.
    pub fn work(self) -> Option<Work> {
        match self {
            Self::DivideAndConquer(_) => None,
            Self::Incremental(work) | Self::ConflictLists { work, .. } => Some(work),
        }
    }
}

/// Counts of the steps of divide and conquer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Merges {
    /// Sets of two, three or four points triangulated at once.
    pub leaves: u64,
    /// Pairs of triangulations merged.
    pub merges: u64,
    /// Edges added across a cut, the first of each merge not counted.
    pub connected: u64,
    /// Edges removed along a cut.
    pub removed: u64,
}

impl Merges {
    pub(crate) fn add(&mut self, other: &Self) {
        self.leaves += other.leaves;
        self.merges += other.merges;
        self.connected += other.connected;
        self.removed += other.removed;
    }
}
