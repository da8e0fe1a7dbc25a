//! The threads that work runs on: a pool of this library alone, and a new one in the child of a fork.

/// Does work on so many points.
pub(crate) fn run<T: Send>(points: usize, work: impl FnOnce() -> T + Send) -> T {
    delone_pool::survive_forks();
    delone_pool::run(points, work)
}
