//! Space: an edge has of its dual, in a tetrahedron, the two right-angled triangles between the middle of the edge, the centers of the two
//! facets at it, and the center of the tetrahedron; with signs, where centers are outside.

use super::super::real::{Double, Real, cross, dot, minus};
use super::{GOOD, Measure, apart, compare, normalize, scale, three};
use crate::around::Around;
use crate::ids::VertexId;
use crate::triangulation::Triangulation;

/// The neighbors of a point by a small number each, in lexicographic order, and simplices between them.
#[derive(Clone, Debug, Default)]
pub(super) struct Cell {
    ids: Vec<VertexId>,
    /// Their coordinates.
    points: Vec<[f64; 3]>,
    /// Both, to sort and to look for.
    by_id: Vec<([f64; 3], VertexId)>,
    cavity: Vec<[u32; 4]>,
    border: Vec<[u32; 3]>,
    plain: Local<f64>,
    double: Local<Double>,
}

/// Coordinates relative to the point, and what was summed for each neighbor.
#[derive(Clone, Debug, Default)]
struct Local<R> {
    at: Vec<[R; 3]>,
    shares: Vec<R>,
    /// A bound of the errors of all sums, in units of the last place.
    doubt: f64,
}

impl<R: Real> Local<R> {
    /// Adds a sum of parts times a factor; its error is so many units of the last place of the parts.
    #[inline]
    fn add<const N: usize>(&mut self, k: u32, parts: [R; N], factor: R, doubt: f64) {
        let (mut sum, mut size) = (R::default(), 0.0);
        for part in parts {
            sum += part;
            size += part.value().abs();
        }
        self.shares[k as usize] += sum * factor;
        self.doubt += size * factor.value().abs() * doubt;
    }

    fn begin(&mut self, q: [f64; 3], points: &[[f64; 3]], [before, after]: [f64; 2]) {
        self.at.clear();
        let relative = |p: &[f64; 3]| [0, 1, 2].map(|k| R::difference(p[k] * before, q[k] * before, after));
        self.at.extend(points.iter().map(relative));
        self.shares.clear();
        self.shares.resize(points.len(), R::default());
        self.doubt = 0.0;
    }
}

/// Turns the least number to the front.
fn turn(numbers: &mut [u32]) {
    let least = (0..numbers.len()).min_by_key(|&k| numbers[k]).unwrap_or_default();
    numbers.rotate_left(least);
}

impl Cell {
    /// As [`super::Cell::weigh`].
    pub(super) fn weigh<T: Triangulation>(
        &mut self,
        d: &T,
        around: &Around<T>,
        q: [f64; 3],
        measure: Measure,
        weights: &mut Vec<(VertexId, f64)>,
    ) -> bool {
        self.take(d, around);
        let size = self.points.iter().flat_map(|p| (0..3).map(|k| apart(p[k], q[k])));
        let scale = scale(size.fold(0.0, f64::max));
        let Self { ids, points, cavity, border, plain, double, .. } = self;
        plain.begin(q, points, scale);
        sum(plain, cavity, border, measure);
        let total: f64 = plain.shares.iter().sum();
        weights.clear();
        // In units of the last place of f64, whose half is 2^-53.
        if total > 0.0 && plain.doubt * f64::EPSILON <= GOOD * total {
            weights.extend(ids.iter().copied().zip(plain.shares.iter().copied()));
        } else {
            double.begin(q, points, scale);
            sum(double, cavity, border, measure);
            let total: f64 = double.shares.iter().map(|share| share.value()).sum();
            let is_good = double.doubt * f64::EPSILON * f64::EPSILON <= GOOD * total;
            if !is_good {
                return false;
            }
            weights.extend(ids.iter().copied().zip(double.shares.iter().map(|share| share.value())));
        }
        normalize(weights)
    }

    /// Numbers neighbors in lexicographic order, and sorts what is between them.
    fn take<T: Triangulation>(&mut self, d: &T, around: &Around<T>) {
        let Self { ids, points, by_id, cavity, border, .. } = self;
        around.neighbors(ids);
        by_id.clear();
        by_id.extend(ids.iter().map(|&v| (three(d.position(v).unwrap_or_default()), v)));
        by_id.sort_unstable_by(|a, b| compare(a.0, b.0));
        points.clear();
        points.extend(by_id.iter().map(|known| known.0));
        ids.clear();
        ids.extend(by_id.iter().map(|known| known.1));
        let is_small = ids.len() <= 16;
        if !is_small {
            by_id.iter_mut().enumerate().for_each(|(k, known)| known.0[0] = k as f64);
            by_id.sort_unstable_by_key(|known| known.1);
        }
        let number = |&v: &VertexId| {
            if is_small {
                return ids.iter().position(|&id| id == v).unwrap_or_default() as u32;
            }
            by_id.binary_search_by_key(&v, |known| known.1).map_or(0, |k| by_id[k].0[0] as u32)
        };
        cavity.clear();
        cavity.extend(around.cavity().iter().map(|&s| {
            let corners = d.corners(s);
            let corners = corners.as_ref();
            let mut numbers = [0, 1, 2, 3].map(|k| corners.get(k).map_or(0, number));
            numbers.sort_unstable();
            numbers
        }));
        cavity.sort_unstable();
        border.clear();
        border.extend(around.border().iter().map(|(facet, _)| {
            let corners = facet.as_ref();
            let mut numbers = [0, 1, 2].map(|k| corners.get(k).map_or(0, number));
            turn(&mut numbers);
            numbers
        }));
        border.sort_unstable();
    }
}

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
    let center = [0, 1, 2].map(|k| {
        (squares[0] * normals[0][k] + squares[1] * normals[1][k] + squares[2] * normals[2][k]) / twice
    });
    let local = [u, v, w, [R::default(); 3]];
    let mut sums = [R::default(); 6];
    for (k, facet) in FACETS.iter().enumerate() {
        let [a, b, c] = facet.map(|i| local[i]);
        let normal = cross(minus(b, a), minus(c, a));
        // How far inside the center is, times the length of the normal, and how far inside corner k is.
        let height = dot(minus(center, a), normal);
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

fn sum<R: Real>(local: &mut Local<R>, cavity: &[[u32; 4]], border: &[[u32; 3]], measure: Measure) {
    let one = R::one();
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

/// The part of the tetrahedron that belongs to each edge, up to a common factor: the dual times the length.
fn pieces<R: Real>(p: [[R; 3]; 4], sums: [R; 6]) -> [R; 6] {
    std::array::from_fn(|edge| {
        let along = minus(p[EDGES[edge][1]], p[EDGES[edge][0]]);
        sums[edge] * dot(along, along)
    })
}
