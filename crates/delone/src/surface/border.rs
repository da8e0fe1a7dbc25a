//! The nearest point of the hull to a point outside, as weights of the corners of the facet that it is on.
//!
//! Source: Ericson, "Real-time collision detection", 2005, section 5.1, for triangles. Cost: O(1).

use super::natural::{apart, scale, three};
use crate::closest::{dot, on_edge, on_triangle};
use crate::space::{NearestFace, nearest_face};
use crate::triangulation::{Coordinates, Triangulation};

/// The rounding of points on the border, more than once if they were turned or converted: a point outside that is no further away than
/// this part of the largest coordinate is on the border. 2^-48, the last sixteenth of what a number tells of 53 bits.
const ROUNDING: f64 = 3.552_713_678_800_501e-15;

/// The least and the largest coordinates of the vertices of a hull; none without facets. Cost: O(h) for h facets.
pub(super) fn corners_of_box<T: Triangulation>(d: &T) -> Option<[T::Point; 2]> {
    let mut found: Option<[T::Point; 2]> = None;
    for facet in d.hull_facets() {
        for p in facet.as_ref().iter().filter_map(|&v| d.position(v)) {
            let [low, high] = found.get_or_insert([p; 2]);
            for (k, &x) in p.as_ref().iter().enumerate() {
                low.as_mut()[k] = low.as_ref()[k].min(x);
                high.as_mut()[k] = high.as_ref()[k].max(x);
            }
        }
    }
    found
}

/// Whether a point is outside of a box by more than rounding.
pub(super) fn is_far<P: Coordinates>(q: P, [low, high]: [P; 2]) -> bool {
    let all = [low, high, q];
    let largest = all.iter().flat_map(|p| p.as_ref()).fold(0.0f64, |most, x| most.max(x.abs()));
    // Twice as much, for the rounding of what is compared.
    let margin = 2.0 * ROUNDING * largest;
    (0..P::COUNT)
        .any(|k| q.as_ref()[k] < low.as_ref()[k] - margin || q.as_ref()[k] > high.as_ref()[k] + margin)
}

/// The nearest point of a facet.
pub(super) struct Nearest<P> {
    /// The weights of its corners: not negative, with the sum one.
    pub(super) weights: [f64; 3],
    pub(super) point: P,
    /// Whether the point outside is only there by rounding.
    pub(super) is_rounding: bool,
}

/// The nearest point of an edge or a triangle. Corners are sorted, so that those of a side are in the same order in both of its triangles.
///
/// The nearest facet of a point is exact: facets that share the side or the corner say the same, to the bit.
pub(super) fn nearest<P: Coordinates>(q: P, corners: &[P]) -> Nearest<P> {
    let from = three(q);
    let active: &[usize] = match corners {
        [_, _] => &[0, 1],
        [a, b, c] => match nearest_face([*a, *b, *c].map(three), from) {
            NearestFace::Whole => &[0, 1, 2],
            NearestFace::Side(k) => [&[1, 2], &[0, 2], &[0, 1]][k],
            NearestFace::Corner(k) => [&[0], &[1], &[2]][k],
        },
        _ => &[0],
    };
    let at: Vec<[f64; 3]> = active.iter().map(|&i| three(corners[i])).collect();
    let size = at.iter().flat_map(|p| (0..3).map(|k| apart(p[k], from[k]))).fold(0.0, f64::max);
    let [before, after] = scale(size);
    let away = |p: &[f64; 3]| [0, 1, 2].map(|k| (p[k] * before - from[k] * before) * after);
    let local: Vec<[f64; 3]> = at.iter().map(away).collect();
    let of_active = match local[..] {
        [a, b] => on_edge(a, b),
        [a, b, c] => on_triangle(a, b, c),
        _ => [1.0, 0.0, 0.0],
    };
    let blend =
        |points: &[[f64; 3]], k: usize| -> f64 { points.iter().zip(of_active).map(|(p, w)| w * p[k]).sum() };
    let miss = [0, 1, 2].map(|k| blend(&local, k));
    let largest = at.iter().flatten().chain(&from).fold(0.0f64, |most, x| most.max(x.abs()));
    let mut point = q;
    for (k, x) in point.as_mut().iter_mut().enumerate() {
        let ends = at.iter().map(|p| p[k]);
        let [low, high] =
            [ends.clone().fold(f64::INFINITY, f64::min), ends.fold(f64::NEG_INFINITY, f64::max)];
        *x = blend(&at, k).clamp(low, high);
    }
    let is_rounding = dot(miss, miss).sqrt() <= largest * before * after * ROUNDING;
    let mut weights = [0.0; 3];
    active.iter().zip(of_active).for_each(|(&i, weight)| weights[i] = weight);
    Nearest { weights, point, is_rounding }
}

#[cfg(test)]
mod tests {
    use super::nearest;
    use crate::closest::distance;

    #[test]
    fn the_nearest_point_is_on_a_corner_a_side_or_inside() {
        let edge = [[0.0, 0.0], [4.0, 0.0]];
        for (q, expected) in
            [([1.0, -2.0], [1.0, 0.0]), ([-1.0, -1.0], [0.0, 0.0]), ([9.0, -1.0], [4.0, 0.0])]
        {
            assert_eq!(nearest(q, &edge).point, expected);
        }
        let triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
        for (q, expected) in [
            ([1.0, 1.0, 3.0], [1.0, 1.0, 0.0]),
            ([3.0, 3.0, 1.0], [2.0, 2.0, 0.0]),
            ([-1.0, 2.0, 1.0], [0.0, 2.0, 0.0]),
            ([2.0, -1.0, 1.0], [2.0, 0.0, 0.0]),
            ([-1.0, -1.0, 5.0], [0.0, 0.0, 0.0]),
        ] {
            let found = nearest(q, &triangle);
            assert_eq!((found.point, found.is_rounding), (expected, false));
            let [x, y, z] = [0, 1, 2].map(|k| q[k] - expected[k]);
            assert!((distance(q, triangle) - (x * x + y * y + z * z).sqrt()).abs() < 1e-15);
        }
        assert!(nearest([1.0, -1e-17], &edge).is_rounding && nearest([1.0, -1e-14], &edge).is_rounding);
        assert!(!nearest([1.0, -1e-13], &edge).is_rounding);
        // As far as numbers go.
        assert_eq!(nearest([1e307, -1e308], &[[-1e308, 0.0], [1e308, 0.0]]).point[1], 0.0);
    }
}
