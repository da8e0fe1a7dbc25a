//! The plane as the Delaunay tree sees it.

use delone_predicates::{Sign, orient2d};

use crate::ids::{EdgeId, Place};
use crate::locate::Ground;
use crate::locate::delaunay_tree::Simplices;
use crate::plane::layer::Layer;
use crate::plane::layer::kernel::Kernel;
use crate::tally::Tally;

impl<K: Kernel<Weight = ()>> Simplices<3> for Layer<K> {
    fn is_in_circle(corners: [Option<[f64; 2]>; 3], _: &[[f64; 2]; 3], q: [f64; 2]) -> bool {
        match corners {
            [Some(a), Some(b), Some(c)] => K::contains((a, ()), (b, ()), (c, ()), (q, ())),
            [Some(a), Some(b), None] | [None, Some(a), Some(b)] | [Some(b), None, Some(a)] => {
                K::contains_beyond((a, ()), (b, ()), (q, ()))
            }
            _ => false, // there is one vertex at infinity
        }
    }

    fn first(points: &[[f64; 2]]) -> Option<[usize; 3]> {
        let turn = |i: usize| orient2d(points[0], points[1], points[i]);
        let third = (2..points.len()).find(|&i| !turn(i).is_zero())?;
        Some(if turn(third) == Sign::Positive { [0, 1, third] } else { [1, 0, third] })
    }

    /// An edge or a triangle at corners. Cost: O(d) for the smallest degree d of the corners.
    fn hint_at<T: Tally>(&self, corners: &[Place], tally: &mut T) -> EdgeId {
        let edge = match *corners {
            [a, b] if self.spanned => self.mesh.edge_around([a, b], || tally.visited()),
            [a, b, c] if self.spanned => self.mesh.edge_around([a, b, c], || tally.visited()),
            _ => None,
        };
        edge.or_else(|| Some(self.hint(*corners.first()?))).unwrap_or(EdgeId::NONE)
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::Kind;

    use crate::locate::delaunay_tree::tests::forgets;
    use crate::{Ask, Delaunay2, Locate, VertexId, Work};

    #[test]
    fn what_is_removed_has_never_been() {
        for &kind in Kind::ALL {
            for n in [4, 5, 8, 40] {
                let d = Delaunay2::from_points(&kind.points(n, 1)).expect("finite");
                forgets::<_, 3>(&d.base, &kind.points(12, 9), kind.name());
            }
        }
    }

    /// Expected over random orders: six triangles a site, and a search of O(log n) tests, also after many removals.
    #[test]
    fn size_and_searches_are_those_of_a_random_order() {
        let points = Kind::Uniform.points(6_000, 1);
        let mut d = Delaunay2::from_points(&points).expect("finite");
        d.set_strategy(Locate::DelaunayTree).expect("in range");
        let tests = |d: &Delaunay2| {
            let mut work = Work::default();
            for q in Kind::Uniform.points(500, 3) {
                d.find_observed(q, &mut work).expect("finite");
            }
            work.in_circles as f64 / 500.0 / (d.vertex_count() as f64).ln()
        };
        let before = tests(&d);
        // The oldest first, as in a sliding window.
        for i in 0..5_000 {
            d.remove(VertexId::new(i)).expect("a vertex");
        }
        let size = d.footprint().versions as f64 / 1000.0;
        assert!((5.0..8.0).contains(&size), "{size} triangles a site");
        let after = tests(&d);
        assert!(before < 20.0 && after < 20.0, "{before} {after} tests for each unit of ln n");
    }
}
