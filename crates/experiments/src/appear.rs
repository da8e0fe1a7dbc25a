//! Simplices that ever appear while points are inserted one by one.

use delone::{Change, Delaunay2, VertexId};

/// Inserts points in an order and reports each finite simplex when it appears, by the sorted indices of its corners: all
/// that appear are at the new vertex. Returns the number of simplices there are in the end.
pub(crate) fn simplices<T: Change>(
    points: &[T::Point],
    order: &[usize],
    mut appears: impl FnMut(T::Corners, &[usize]),
) -> Result<usize, delone::Error> {
    let mut d = T::default();
    for &i in order {
        let v = d.insert_observed(points[i], &mut ())?.vertex();
        for s in d.simplices_at(v) {
            appears(d.corners(s), order);
        }
    }
    Ok(d.simplex_count())
}

/// Inserts points of the plane in an order and reports each edge when it appears, by the indices of its ends.
pub(crate) fn edges(
    points: &[[f64; 2]],
    order: &[usize],
    mut appears: impl FnMut([usize; 2]),
) -> Result<(), delone::Error> {
    let mut d = Delaunay2::new();
    for &i in order {
        let v = d.insert(points[i])?.vertex();
        for w in d.mesh().star(v).map(|e| d.mesh().destination(e)).filter(|w| !w.is_ghost()) {
            appears([i, order[w.index()]]);
        }
    }
    Ok(())
}

/// The indices of points that were inserted in an order, from the corners of a simplex, sorted.
pub(crate) fn sorted<const N: usize>(corners: [VertexId; N], order: &[usize]) -> [usize; N] {
    let mut indices = corners.map(|v| order[v.index()]);
    indices.sort_unstable();
    indices
}

/// How many triangles appear, and how many edges.
pub(crate) fn totals(points: &[[f64; 2]], order: &[usize]) -> Result<[u64; 2], delone::Error> {
    let mut d = Delaunay2::new();
    let mut totals = [0; 2];
    for &i in order {
        let v = d.insert(points[i])?.vertex();
        let mesh = d.mesh();
        for e in mesh.star(v) {
            totals[0] += u64::from(!mesh.is_ghost(e.triangle()));
            totals[1] += u64::from(!mesh.destination(e).is_ghost());
        }
    }
    Ok(totals)
}
