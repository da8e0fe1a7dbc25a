//! Space as histories see it.

use delone_predicates::{Sign, are_collinear3, orient3d};

use super::Layer;
use super::kernel::Lift;
use crate::locate::delaunay_tree::Simplices;

impl Simplices<4> for Layer {
    fn is_in_circle(corners: [Option<[f64; 3]>; 4], root: &[[f64; 3]; 4], q: [f64; 3]) -> bool {
        is_in_sphere(corners.map(|corner| corner.map(|p| (p, ()))), root, (q, ()))
    }

    fn first(points: &[[f64; 3]]) -> Option<[usize; 4]> {
        let of = |i: usize| points[i];
        let third = (2..points.len()).find(|&i| !are_collinear3(of(0), of(1), of(i)))?;
        let side = |i: usize| orient3d(of(0), of(1), of(third), of(i));
        let fourth = (2..points.len()).find(|&i| !side(i).is_zero())?;
        Some(if side(fourth).is_positive() { [0, 1, third, fourth] } else { [1, 0, third, fourth] })
    }
}

/// Whether a site is in the sphere of corners in positive order, one of which may be at infinity. All of `root` is in the hull.
pub(in crate::space) fn is_in_sphere<W: Lift>(
    mut corners: [Option<([f64; 3], W)>; 4],
    root: &[[f64; 3]; 4],
    q: ([f64; 3], W),
) -> bool {
    if let Some(k) = corners.iter().position(Option::is_none).filter(|&k| k < 3) {
        // Two exchanges leave the order positive.
        corners.swap(k, 3);
        corners.swap((k + 1) % 3, (k + 2) % 3);
    }
    let [Some(a), Some(b), Some(c), last] = corners else { return false };
    if let Some(d) = last {
        return W::is_in_sphere([a, b, c, d], q);
    }
    match orient3d(a.0, b.0, c.0, q.0) {
        Sign::Positive => true,
        Sign::Negative => false,
        // In the plane of a hull facet the sphere through any point inside cuts out its circle, whatever that weighs.
        Sign::Zero => {
            let inside = root.iter().find(|&&d| !orient3d(a.0, b.0, c.0, d).is_zero());
            inside.is_some_and(|&d| W::is_in_sphere([b, a, c, (d, W::default())], q))
        }
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
