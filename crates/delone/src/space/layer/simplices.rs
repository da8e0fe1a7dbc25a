//! Space as the Delaunay tree sees it.

use delone_predicates::{are_collinear3, orient3d};

use super::Layer;
use super::kernel::is_in_sphere;
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
