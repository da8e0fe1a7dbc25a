//! What the Delaunay tree must know of space.

use delone_predicates::{Sign, are_collinear3, in_sphere, orient3d};

use super::Layer;
use crate::locate::delaunay_tree::Simplices;

impl Simplices<4> for Layer {
    fn is_in_circle(mut corners: [Option<[f64; 3]>; 4], root: &[[f64; 3]; 4], q: [f64; 3]) -> bool {
        if let Some(k) = corners.iter().position(Option::is_none).filter(|&k| k < 3) {
            // Two exchanges leave the order positive.
            corners.swap(k, 3);
            corners.swap((k + 1) % 3, (k + 2) % 3);
        }
        let [Some(a), Some(b), Some(c), last] = corners else { return false };
        if let Some(d) = last {
            return in_sphere(a, b, c, d, q).is_positive();
        }
        match orient3d(a, b, c, q) {
            Sign::Positive => true,
            Sign::Negative => false,
            // In the plane of a hull facet the sphere through any point inside cuts out its circle.
            Sign::Zero => {
                let inside = root.iter().find(|&&d| !orient3d(a, b, c, d).is_zero());
                inside.is_some_and(|&d| in_sphere(b, a, c, d, q).is_positive())
            }
        }
    }

    fn first(points: &[[f64; 3]]) -> Option<[usize; 4]> {
        let of = |i: usize| points[i];
        let third = (2..points.len()).find(|&i| !are_collinear3(of(0), of(1), of(i)))?;
        let side = |i: usize| orient3d(of(0), of(1), of(third), of(i));
        let fourth = (2..points.len()).find(|&i| !side(i).is_zero())?;
        Some(if side(fourth).is_positive() { [0, 1, third, fourth] } else { [1, 0, third, fourth] })
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::Kind3;

    use crate::Delaunay3;
    use crate::locate::delaunay_tree::tests::forgets;

    #[test]
    fn what_is_removed_has_never_been() {
        for &kind in Kind3::ALL {
            for n in [5, 6, 9, 24] {
                let d = Delaunay3::from_points(&kind.points(n, 1)).expect("finite");
                forgets::<_, 4>(&d.base, &kind.points(12, 9), kind.name());
            }
        }
    }
}
