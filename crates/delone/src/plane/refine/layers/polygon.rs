//! Convex polygons: whether they are, and whether two are apart; decided exactly.

use delone_predicates::orient2d;

/// Whether three or four corners are those of a convex polygon, counter-clockwise: four turns to the left, each less than half a turn,
/// go around once.
pub(super) fn is_convex(corners: &[[f64; 2]]) -> bool {
    let count = corners.len();
    count > 2
        && corners.iter().flatten().all(|x| x.is_finite())
        && (0..count).all(|k| {
            let [p, q, r] = [0, 1, 2].map(|step| corners[(k + step) % count]);
            orient2d(p, q, r).is_positive()
        })
}

/// Whether all points are strictly to the right of a line.
fn is_right_of(points: &[[f64; 2]], p: [f64; 2], q: [f64; 2]) -> bool {
    points.iter().all(|&r| orient2d(p, q, r).is_negative())
}

/// Whether an edge of a polygon, one of two corners included, has all of the others to its right.
fn parts(polygon: &[[f64; 2]], others: &[[f64; 2]]) -> bool {
    let count = polygon.len();
    (0..count).any(|k| is_right_of(others, polygon[k], polygon[(k + 1) % count]))
}

/// Whether two convex polygons are apart, of which one may have two corners or one: between them is a line along an edge of either.
pub(super) fn are_apart(one: &[[f64; 2]], other: &[[f64; 2]]) -> bool {
    parts(one, other) || (other.len() > 1 && parts(other, one))
}

/// Whether a segment from a corner of a convex polygon leads away from it.
pub(super) fn leads_away(polygon: &[[f64; 2]], corner: [f64; 2], end: [f64; 2]) -> bool {
    let count = polygon.len();
    (0..count).any(|k| {
        let [p, q] = [polygon[k], polygon[(k + 1) % count]];
        (p == corner || q == corner) && orient2d(p, q, end).is_negative()
    })
}

#[cfg(test)]
mod tests {
    use super::{are_apart, is_convex, leads_away};

    #[test]
    fn polygons_are_apart_or_not() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let moved = |x: f64, y: f64| square.map(|p| [p[0] + x, p[1] + y]);
        assert!(is_convex(&square) && !is_convex(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]));
        assert!(!is_convex(&[square[0], square[2], square[1], square[3]]));
        assert!(are_apart(&square, &moved(1.5, 0.0)) && are_apart(&square, &moved(1.1, 1.1)));
        assert!(!are_apart(&square, &moved(1.0, 0.0)) && !are_apart(&square, &moved(0.2, 0.9)));
        assert!(are_apart(&square, &[[2.0, -1.0], [-1.0, -0.1]]));
        assert!(!are_apart(&square, &[[2.0, 0.5], [-1.0, 0.5]]));
        assert!(are_apart(&square, &[[2.0, 0.5]]) && !are_apart(&square, &[[0.5, 0.5]]));
        assert!(leads_away(&square, [0.0, 0.0], [-1.0, 0.0]) && !leads_away(&square, [0.0, 0.0], [2.0, 1.0]));
    }
}
