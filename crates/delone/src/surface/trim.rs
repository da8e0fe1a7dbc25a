//! Trimming: simplices that are left out of a triangulation where it is shown.

use delone_predicates::hypotenuse;
use std::collections::VecDeque;

use crate::triangulation::{Coordinates, Triangulation};

/// Simplices that are left out.
#[derive(Clone, Debug)]
pub struct Trim {
    /// By the index of the simplex.
    left_out: Vec<bool>,
    count: usize,
    slivers: usize,
}

/// The rule for simplices along the border.
#[derive(Clone, Copy, Debug, Default)]
#[non_exhaustive]
pub struct Border {
    /// Simplices with a longer edge.
    pub longest: Option<f64>,
    /// Whether simplices with a longer edge go wherever they are, not from the border inwards alone.
    pub is_anywhere: bool,
    /// Triangles whose height over their longest edge is smaller than this part of it.
    pub slivers: Option<f64>,
}

/// A plane that takes away the simplices whose middle is beyond it. A normal and an offset are all there is to a plane: no field will
/// be added.
#[derive(Clone, Copy, Debug)]
pub struct Cut {
    /// The side that is taken away.
    pub normal: [f64; 3],
    /// The scalar product of the normal and a point of the plane.
    pub offset: f64,
}

impl Border {
    /// Long edges alone.
    pub fn long_edges(longest: Option<f64>) -> Self {
        Self { longest, ..Self::default() }
    }

    /// Sets [`Self::is_anywhere`].
    #[must_use]
    pub fn anywhere(self, is_anywhere: bool) -> Self {
        Self { is_anywhere, ..self }
    }

    /// Sets [`Self::slivers`]: a part, or `None`.
    #[must_use]
    pub fn slivers(self, slivers: impl Into<Option<f64>>) -> Self {
        Self { slivers: slivers.into(), ..self }
    }
}

impl Trim {
    /// Leaves out simplices with an edge longer than `longest`, from the hull inwards: as long as they are next to
    /// nothing or to one that is left out. Long ones in the middle stay. Lengths are rounded. O(n).
    pub fn long_edges<T: Triangulation>(t: &T, longest: f64) -> Self {
        Self::along_border(t, &Border::long_edges(Some(longest)), |_| true)
    }

    /// Leaves out simplices by a rule, from the hull inwards: as long as they are next to nothing or to one that is left out. Of
    /// slivers only those go that may. O(n).
    ///
    /// ```
    /// use delone::Delaunay2;
    /// use delone::surface::{Border, Trim};
    ///
    /// // Three squares, whose lower side is bent by a rounding error.
    /// let points = [[0.0, 0.0], [1.0, 1e-16], [2.0, 0.0], [0.0, 1.0], [1.0, 1.0], [2.0, 1.0]];
    /// let d = Delaunay2::from_points(&points)?;
    /// let rule = Border::default().slivers(1e-9);
    /// let trim = Trim::along_border(&d, &rule, |_| true);
    /// assert_eq!((d.triangle_count(), trim.slivers()), (5, 1));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn along_border<T: Triangulation>(
        t: &T,
        rule: &Border,
        may_go_as_sliver: impl Fn(T::Simplex) -> bool,
    ) -> Self {
        let facets = 0..=T::Point::COUNT;
        let at_border = |s: &T::Simplex| facets.clone().any(|k| t.across(*s, k).is_none());
        let points = |s: T::Simplex| -> Vec<T::Point> {
            t.corners(s).as_ref().iter().filter_map(|&v| t.position(v)).collect()
        };
        let is_long =
            |points: &[T::Point]| rule.longest.is_some_and(|longest| longest_side(points) > longest);
        let mut waiting: VecDeque<T::Simplex> = t.simplices().filter(at_border).collect();
        if rule.is_anywhere {
            waiting.extend(t.simplices().filter(|&s| is_long(&points(s))));
        }
        let mut trim = Self::new(t);
        while let Some(s) = waiting.pop_front() {
            if !trim.keeps(t.index(s)) {
                continue;
            }
            let points = points(s);
            let is_long = is_long(&points);
            let is_flat = || rule.slivers.is_some_and(|ratio| slenderness(&points) < ratio);
            let is_sliver = !is_long && is_flat() && may_go_as_sliver(s);
            if is_long || is_sliver {
                trim.leave_out(t.index(s));
                trim.slivers += usize::from(is_sliver);
                waiting.extend(facets.clone().filter_map(|k| t.across(s, k)));
            }
        }
        trim
    }

    /// Leaves out what is beyond a plane.
    pub fn beyond<T: Triangulation>(t: &T, cut: &Cut) -> Self {
        let count = (T::Point::COUNT + 1) as f64;
        let mut trim = Self::new(t);
        let along =
            |p: T::Point| -> f64 { cut.normal.iter().zip(p.as_ref()).map(|(n, x)| n * x / count).sum() };
        for s in t.simplices() {
            let corners = t.corners(s);
            let middle: f64 = corners.as_ref().iter().filter_map(|&v| t.position(v)).map(along).sum();
            let stays = middle <= cut.offset;
            if !stays {
                trim.leave_out(t.index(s));
            }
        }
        trim
    }

    /// Leaves out the simplices that are not to stay, such as those outside of a domain.
    pub fn keeping<T: Triangulation>(t: &T, stays: impl Fn(T::Simplex) -> bool) -> Self {
        let mut trim = Self::new(t);
        t.simplices().filter(|&s| !stays(s)).for_each(|s| trim.leave_out(t.index(s)));
        trim
    }

    fn new(t: &impl Triangulation) -> Self {
        Self { left_out: vec![false; t.slot_count()], count: 0, slivers: 0 }
    }

    fn leave_out(&mut self, index: usize) {
        self.left_out[index] = true;
        self.count += 1;
    }

    /// Whether the simplex of an index stays.
    pub fn keeps(&self, index: usize) -> bool {
        !self.left_out[index]
    }

    /// How many are left out.
    pub fn count(&self) -> usize {
        self.count
    }

    /// How many of these are left out as slivers. What has an edge that is too long is none.
    pub fn slivers(&self) -> usize {
        self.slivers
    }
}

/// The length of the longest side between some points.
fn longest_side<P: Coordinates>(points: &[P]) -> f64 {
    let pairs =
        points.iter().enumerate().flat_map(|(i, p)| points[..i].iter().map(move |q| distance(*p, *q)));
    pairs.fold(0.0, f64::max)
}

/// The height of a triangle of the plane over its longest side, as a part of that; of others nothing is known, which is no number.
/// Coordinates are subtracted and multiplied once each, so it is off by 2^-50 at most.
fn slenderness<P: Coordinates>(points: &[P]) -> f64 {
    let [p, q, r] = points else { return f64::NAN };
    let longest = longest_side(points);
    let side = |q: &P, k: usize| (q.as_ref()[k] - p.as_ref()[k]) / longest;
    (side(q, 0) * side(r, 1) - side(q, 1) * side(r, 0)).abs()
}

/// The distance of two points, rounded.
fn distance<P: Coordinates>(p: P, q: P) -> f64 {
    let differences = p.as_ref().iter().zip(q.as_ref()).map(|(x, y)| x - y);
    differences.fold(0.0, hypotenuse)
}

#[cfg(test)]
mod tests {
    use super::{Border, Trim};
    use crate::Delaunay2;

    #[test]
    fn long_triangles_go_from_the_border_inwards() {
        // A strip of unit squares, one of which lacks its neighbors, and a point far away.
        let mut points: Vec<[f64; 2]> = (0..12).map(|i| [f64::from(i % 6), f64::from(i / 6)]).collect();
        points.push([3.0, 50.0]);
        let d = Delaunay2::from_points(&points).expect("finite");
        let trim = Trim::long_edges(&d, 2.0);
        let kept: Vec<_> = d.triangle_ids().filter(|t| trim.keeps(t.index())).collect();
        assert_eq!((kept.len(), d.triangle_count() - trim.count()), (10, 10));
        assert!(kept.iter().all(|&t| d.mesh().corners(t).iter().all(|v| v.index() < 12)));
        // Nothing is long; everything is.
        assert_eq!(Trim::long_edges(&d, 100.0).count(), 0);
        assert_eq!(Trim::long_edges(&d, 0.5).count(), d.triangle_count());
        // A hole in the middle, with long edges around it, stays.
        let ring: Vec<[f64; 2]> = (0..100)
            .map(|i| [f64::from(i % 10), f64::from(i / 10)])
            .filter(|&[x, y]| !(3.0..7.0).contains(&x) || !(3.0..7.0).contains(&y))
            .collect();
        let d = Delaunay2::from_points(&ring).expect("finite");
        assert_eq!(Trim::long_edges(&d, 2.0).count(), 0);
        let anywhere = Border { is_anywhere: true, ..Border::long_edges(Some(2.0)) };
        let trim = Trim::along_border(&d, &anywhere, |_| true);
        let is_long = |t: &crate::TriangleId| {
            let [a, b, c] = d.mesh().corners(*t).map(|v| d.point(v));
            [[a, b], [b, c], [c, a]].iter().any(|[p, q]| (p[0] - q[0]).hypot(p[1] - q[1]) > 2.0)
        };
        assert!(trim.count() > 0);
        assert!(d.triangle_ids().all(|t| trim.keeps(t.index()) != is_long(&t)));
    }

    #[test]
    fn slivers_go_from_the_border_inwards() {
        // Along the border of a turned lattice points are on lines but for rounding.
        let (sin, cos) = 0.3_f64.sin_cos();
        let turned = |i: i32| {
            let (x, y) = (f64::from(i % 20), f64::from(i / 20));
            [x * cos - y * sin, x * sin + y * cos]
        };
        let points: Vec<[f64; 2]> = (0..400).map(turned).collect();
        let d = Delaunay2::from_points(&points).expect("finite");
        let rule = |ratio| Border { slivers: Some(ratio), ..Border::default() };
        let trim = Trim::along_border(&d, &rule(1e-9), |_| true);
        assert_eq!(d.triangle_count() - trim.count(), 2 * 19 * 19);
        assert_eq!(trim.slivers(), d.triangle_count() - 2 * 19 * 19);
        assert!(trim.slivers() > 0);
        assert_eq!(Trim::along_border(&d, &rule(1e-9), |_| false).count(), 0);
        assert_eq!(Trim::along_border(&d, &rule(0.0), |_| true).count(), 0);
        // Every triangle is less than equilateral; at the ends of the range of numbers too.
        for scale in [1.0, 1e-300, 1e300] {
            let points: Vec<[f64; 2]> = points.iter().map(|p| p.map(|x| x * scale)).collect();
            let d = Delaunay2::from_points(&points).expect("finite");
            assert_eq!(Trim::along_border(&d, &rule(0.9), |_| true).slivers(), d.triangle_count());
            assert!(
                Trim::along_border(&d, &rule(1e-9), |_| true).slivers() + 2 * 19 * 19 <= d.triangle_count()
            );
        }
        // One in the middle stays.
        let points = [[0.0, 0.0], [1.0, 1e-12], [2.0, 0.0], [1.0, 1.0], [1.0, -1.0]];
        let d = Delaunay2::from_points(&points).expect("finite");
        assert_eq!(Trim::along_border(&d, &rule(1e-9), |_| true).count(), 0);
    }
}
