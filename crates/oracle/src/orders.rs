//! Voronoi diagrams of order k by trying everything: all triples and all pairs against all points, O(n^4).

use std::collections::BTreeSet;

use crate::exact::Point2;
use crate::quick::{in_circle, orient2d};

/// All circles and half-planes of some distinct points. Made once, it answers for every order.
pub struct Circles {
    /// The points inside, sorted, and three on the circle, sorted.
    circles: Vec<(Vec<usize>, [usize; 3])>,
    /// The points inside, sorted, and two on the line.
    half_planes: Vec<(Vec<usize>, [usize; 2])>,
}

/// The diagram of one order.
#[derive(Debug, PartialEq, Eq)]
pub struct Diagram {
    /// The sets of sites that are nearest somewhere, each sorted.
    pub regions: BTreeSet<Vec<usize>>,
    /// Of these those whose regions are unbounded.
    pub unbounded: BTreeSet<Vec<usize>>,
    /// The corners: the points inside of each circle, and the three on it.
    pub circles: BTreeSet<(Vec<usize>, [usize; 3])>,
}

impl Circles {
    /// Tries all triples and pairs against all points.
    pub fn new(points: &[Point2]) -> Self {
        let n = points.len();
        let (mut circles, mut half_planes) = (Vec::new(), Vec::new());
        for i in 0..n {
            for j in 0..n {
                if i == j {
                    continue;
                }
                let (a, b) = (points[i], points[j]);
                let between = |q: Point2| (a < q && q < b) || (b < q && q < a);
                let is_inside = |q: &usize| {
                    ![i, j].contains(q)
                        && match orient2d(a, b, points[*q]) {
                            0 => between(points[*q]),
                            side => side > 0,
                        }
                };
                half_planes.push(((0..n).filter(is_inside).collect(), [i, j]));
                for k in (i.max(j) + 1..n).filter(|_| i < j) {
                    let c = points[k];
                    let side = orient2d(a, b, c);
                    let is_inside =
                        |q: &usize| ![i, j, k].contains(q) && in_circle(a, b, c, points[*q]) * side > 0;
                    if side != 0 {
                        circles.push(((0..n).filter(is_inside).collect(), [i, j, k]));
                    }
                }
            }
        }
        Self { circles, half_planes }
    }

    /// The diagram of order k, for k from 1 to n - 1.
    pub fn order(&self, k: usize) -> Diagram {
        let with = |inside: &[usize], more: &[usize]| {
            let mut sites = [inside, more].concat();
            sites.sort_unstable();
            sites
        };
        let (mut regions, mut unbounded, mut circles) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
        for (inside, [a, b]) in self.half_planes.iter().filter(|(inside, _)| inside.len() + 1 == k) {
            for site in [*a, *b] {
                regions.insert(with(inside, &[site]));
                unbounded.insert(with(inside, &[site]));
            }
        }
        for (inside, on) in &self.circles {
            let [a, b, c] = *on;
            let around: &[&[usize]] = match k.checked_sub(inside.len()) {
                Some(1) => &[&[a], &[b], &[c]],
                Some(2) => &[&[b, c], &[c, a], &[a, b]],
                _ => continue,
            };
            regions.extend(around.iter().map(|more| with(inside, more)));
            circles.insert((inside.clone(), *on));
        }
        Diagram { regions, unbounded, circles }
    }
}

#[cfg(test)]
mod tests {
    use super::Circles;

    /// Five points, two of them inside: counted by hand.
    #[test]
    fn a_square_and_its_center() {
        let circles = Circles::new(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0]]);
        let first = circles.order(1);
        assert_eq!((first.regions.len(), first.unbounded.len(), first.circles.len()), (5, 4, 4));
        let last = circles.order(4);
        assert_eq!((last.regions.len(), last.unbounded.len()), (4, 4));
        assert!(last.regions.iter().all(|sites| sites.contains(&4)));
    }
}
