//! Space: an edge has of its dual, in a tetrahedron, the two right-angled triangles between the middle of the edge, the centres of the two
//! facets at it, and the centre of the tetrahedron; with signs, where centres are outside.

use super::super::real::{Real, cross, dot, minus};
use super::{Local, Measure};

/// The edges of a tetrahedron with corners 0 to 3.
pub(super) const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// For each facet, opposite to a corner, its corners.
const FACETS: [[usize; 3]; 4] = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]];

/// Four times the dual of each edge over its length, of a tetrahedron whose last corner is relative to nothing; and their errors in
/// units of the last place.
pub(super) fn duals<R: Real>(p: [[R; 3]; 4]) -> ([R; 6], f64) {
    let [u, v, w] = [0, 1, 2].map(|k| minus(p[k], p[3]));
    let squares = [u, v, w].map(|a| dot(a, a));
    let normals = [cross(v, w), cross(w, u), cross(u, v)];
    let volume = dot(u, normals[0]);
    let twice = volume + volume;
    // Relative to corner 3.
    let centre = [0, 1, 2].map(|k| {
        (squares[0] * normals[0][k] + squares[1] * normals[1][k] + squares[2] * normals[2][k]) / twice
    });
    let local = [u, v, w, [R::default(); 3]];
    let mut sums = [R::default(); 6];
    for (k, facet) in FACETS.iter().enumerate() {
        let [a, b, c] = facet.map(|i| local[i]);
        let normal = cross(minus(b, a), minus(c, a));
        // How far inside the centre is, times the length of the normal, and how far inside corner k is.
        let height = dot(minus(centre, a), normal);
        let inside = dot(minus(local[k], a), normal);
        let height = if inside.value() < 0.0 { R::default() - height } else { height };
        let over = height / dot(normal, normal);
        for opposite in 0..3 {
            let apex = local[facet[opposite]];
            let ends = [facet[(opposite + 1) % 3], facet[(opposite + 2) % 3]];
            let cotangent = dot(minus(local[ends[0]], apex), minus(local[ends[1]], apex));
            let edge = EDGES.iter().position(|e| e.iter().all(|end| ends.contains(end))).unwrap_or_default();
            sums[edge] += cotangent * over;
        }
    }
    let size = squares.iter().map(|s| s.value()).sum::<f64>();
    let flat = size * size.sqrt() / volume.value().abs();
    (sums, 16.0 + 8.0 * flat)
}

pub(super) fn sum<R: Real>(local: &mut Local<R>, cavity: &[[u32; 4]], border: &[[u32; 3]], measure: Measure) {
    let one = R::difference(1.0, 0.0, 1.0);
    for &[i, j, k] in border {
        let corners = [i, j, k].map(|v| local.at[v as usize]);
        let [a, b, c] = corners;
        let (sums, doubt) = duals([a, b, c, [R::default(); 3]]);
        if measure == Measure::Laplace {
            [(i, 2), (j, 4), (k, 5)].into_iter().for_each(|(v, edge)| local.add(v, [sums[edge]], one, doubt));
            continue;
        }
        let pieces = pieces([a, b, c, [R::default(); 3]], sums);
        for (v, at) in [i, j, k].into_iter().zip([[0, 1, 2], [0, 3, 4], [1, 3, 5]]) {
            at.into_iter().for_each(|edge| local.add(v, [R::default() - pieces[edge]], one, doubt));
        }
    }
    if measure == Measure::Laplace {
        return;
    }
    for &numbers in cavity {
        let corners = numbers.map(|v| local.at[v as usize]);
        let (sums, doubt) = duals(corners);
        let pieces = pieces(corners, sums);
        for (edge, ends) in EDGES.into_iter().enumerate() {
            ends.into_iter().for_each(|end| local.add(numbers[end], [pieces[edge]], one, doubt));
        }
    }
}

/// What each end of an edge has of the tetrahedron, up to a factor that is the same for all: the dual times the length.
fn pieces<R: Real>(p: [[R; 3]; 4], sums: [R; 6]) -> [R; 6] {
    std::array::from_fn(|edge| {
        let along = minus(p[EDGES[edge][1]], p[EDGES[edge][0]]);
        sums[edge] * dot(along, along)
    })
}
