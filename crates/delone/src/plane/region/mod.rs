//! Regions that cells are clipped to: a rectangle, the convex hull of the sites, a polygon with holes.
//!
//! Cost: a rectangle O(1); a polygon of m sides O(m log m) typical, at worst O(m log m) to validate and O(m^2) to cut into
//! boxes (`tree.rs`).

pub(in crate::plane) mod clip;
pub(in crate::plane) mod measure;
pub(in crate::plane) mod rings;
mod sweep;
pub(in crate::plane) mod tree;

use delone_predicates::Line;

use crate::error::{Error, RegionProblem};
use crate::plane::Delaunay2;
use crate::points::{Bounds, Position2};
use crate::sorting;
use clip::{Ring, clip, sides};
use sweep::nesting;
use tree::{Node, Relation};

/// Corners of a part, above which it is first cut to the box around the cell.
const UNCUT_CORNERS: usize = 16;

/// A region of the plane with a border of straight sides.
#[derive(Clone, Debug)]
pub struct Region2 {
    low: [f64; 2],
    high: [f64; 2],
    rings: Vec<Vec<[f64; 2]>>,
    /// All sides, ring by ring.
    sides: Vec<[[f64; 2]; 2]>,
    tree: Node,
    /// Whether rings of a cell are its border. Those of a rectangle have one ring each, so that programs without other regions do not
    /// contain the sweep.
    are_border: fn(&[Vec<[f64; 2]>]) -> bool,
}

impl Region2 {
    /// An axis-parallel rectangle.
    ///
    /// # Errors
    /// [`Error::Region`] if it is empty or not finite.
    ///
    /// ```
    /// use delone::Region2;
    /// assert_eq!(Region2::rectangle([0.0, 0.0], [4.0, 2.0])?.area(), 8.0);
    /// assert!(Region2::rectangle([0.0, 0.0], [0.0, 2.0]).is_err());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn rectangle<P: Position2>(low: P, high: P) -> Result<Self, Error> {
        let ([x0, y0], [x1, y1]) = (low.xy(), high.xy());
        let corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
        let finite = corners.iter().flatten().all(|x| x.is_finite());
        let problem = |problem| Error::Region { ring: 0, corner: 0, problem };
        if !finite {
            return Err(problem(RegionProblem::NotFinite));
        }
        if x0 >= x1 || y0 >= y1 {
            return Err(problem(RegionProblem::Empty));
        }
        let tree = Node::whole(sides(&corners, 0));
        Ok(Self {
            low: [x0, y0],
            high: [x1, y1],
            rings: vec![corners.to_vec()],
            sides: Vec::new(),
            tree,
            are_border: rings::each_is_border,
        })
    }

    /// A polygon: rings of corners, each closed by its first corner, in any direction. A ring inside of another one
    /// is a hole, one inside of a hole an island, and so on. Rings may touch at corners that both have, without crossing
    /// there, and no other way. O(m log m) for m sides, typical.
    ///
    /// # Errors
    /// [`Error::Region`] names ring, corner and problem: a side that crosses or overlaps another one, a corner
    /// where rings cross, a corner visited twice, fewer than three corners, no area, a coordinate that is not finite.
    ///
    /// ```
    /// use delone::Region2;
    /// let outer = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    /// let hole = vec![[1.0, 1.0], [2.0, 1.0], [1.0, 2.0]];
    /// assert_eq!(Region2::polygon(&[outer, hole])?.area(), 15.5);
    /// let bow_tie = vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    /// assert!(Region2::polygon(&[bow_tie]).is_err());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn polygon<P: Position2>(rings: &[Vec<P>]) -> Result<Self, Error> {
        let mut rings: Vec<Vec<[f64; 2]>> =
            rings.iter().map(|ring| ring.iter().map(Position2::xy).collect()).collect();
        for (i, ring) in rings.iter_mut().enumerate() {
            if ring.len() > 1 && ring.first() == ring.last() {
                ring.pop();
            }
            validate_corners(i, ring)?;
        }
        let nesting = nesting(&rings)?;
        for (ring, nesting) in rings.iter_mut().zip(nesting) {
            if nesting.is_counter_clockwise != (nesting.depth % 2 == 0) {
                ring.reverse();
            }
        }
        Self::of_rings(rings)
    }

    /// The convex hull of the vertices of a triangulation.
    ///
    /// # Errors
    /// [`Error::Region`] if they do not span the plane.
    ///
    /// ```
    /// use delone::{Delaunay2, Region2};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [0, 4], [1, 1]])?;
    /// assert_eq!(Region2::hull(&d)?.area(), 8.0);
    /// assert!(Region2::hull(&Delaunay2::from_points(&[[0, 0], [1, 1]])?).is_err());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn hull(triangulation: &Delaunay2) -> Result<Self, Error> {
        let corners: Vec<[f64; 2]> = triangulation.hull_vertices().map(|v| triangulation.point(v)).collect();
        if !triangulation.base.spanned {
            return Err(Error::Region { ring: 0, corner: 0, problem: RegionProblem::Empty });
        }
        Self::of_rings(vec![corners])
    }

    fn of_rings(rings: Vec<Vec<[f64; 2]>>) -> Result<Self, Error> {
        let Some(&first) = rings.first().and_then(|ring| ring.first()) else {
            return Err(Error::Region { ring: 0, corner: 0, problem: RegionProblem::Empty });
        };
        let (mut low, mut high) = (first, first);
        for corner in rings.iter().flatten() {
            for axis in 0..2 {
                low[axis] = low[axis].min(corner[axis]);
                high[axis] = high[axis].max(corner[axis]);
            }
        }
        let (mut all, mut numbered) = (Vec::new(), Vec::new());
        for ring in &rings {
            numbered.push(sides(ring, all.len()));
            let next = ring.iter().cycle().skip(1);
            all.extend(ring.iter().zip(next).map(|(&p, &q)| [p, q]));
        }
        Ok(Self { low, high, rings, sides: all, tree: Node::new(numbered), are_border: rings::are_border })
    }

    /// The area, in coordinate units squared; infinite if it is beyond the range of `f64`. O(m).
    pub fn area(&self) -> f64 {
        measure::area(self.rings.iter().map(|ring| ring.iter().copied()))
    }

    /// The rings: outer ones counter-clockwise, holes clockwise.
    ///
    /// ```
    /// use delone::Region2;
    ///
    /// let outer = vec![[0, 0], [4, 0], [4, 4], [0, 4]];
    /// let region = Region2::polygon(&[outer, vec![[1, 1], [2, 1], [1, 2]]])?;
    /// assert_eq!(region.rings().map(<[_]>::len).collect::<Vec<_>>(), [4, 3]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn rings(&self) -> impl Iterator<Item = &[[f64; 2]]> {
        self.rings.iter().map(Vec::as_slice)
    }

    /// The corners of the smallest rectangle around it, low and high.
    ///
    /// ```
    /// use delone::Region2;
    ///
    /// let region = Region2::polygon(&[vec![[0, 0], [4, 1], [1, 3]]])?;
    /// assert_eq!(region.bounds(), [[0.0, 0.0], [4.0, 3.0]]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        [self.low, self.high]
    }

    /// The test whether several rings of a cell are its border.
    pub(in crate::plane) fn are_border(&self) -> fn(&[Vec<[f64; 2]>]) -> bool {
        self.are_border
    }

    /// Its low and its high corner, if it is a rectangle.
    pub(in crate::plane) fn as_box(&self) -> Option<[[f64; 2]; 2]> {
        self.tree.full.then_some([self.low, self.high])
    }

    /// How a box lies to the region.
    #[inline]
    pub(in crate::plane) fn relation(&self, low: [f64; 2], high: [f64; 2]) -> Relation {
        let within = |axis: usize| self.low[axis] <= low[axis] && high[axis] <= self.high[axis];
        let beside = |axis: usize| self.high[axis] < low[axis] || high[axis] < self.low[axis];
        if within(0) && within(1) {
            self.tree.around(low, high).relation(&self.sides, low, high)
        } else if beside(0) || beside(1) {
            Relation::Outside
        } else {
            Relation::Across
        }
    }

    /// The polygon as far as it is near parts of the region's own box. `None` if these are all inside of it.
    pub(in crate::plane) fn around(&self, rings: &[Ring]) -> Option<Vec<Ring>> {
        let corners = rings.iter().flatten().filter_map(|corner| corner.spot.rounded());
        let Bounds { low, high } = Bounds::of(corners);
        let [low, high] = enlarged(low, high).unwrap_or([self.low, self.high]);
        let node = self.tree.around_rings(rings, low, high);
        if node.full {
            return None;
        }
        let mut part = node.rings.clone();
        // Parts across an early cut of the tree have a long border around them, most of it not near. To compare with
        // numbers is cheaper than with bisectors.
        let lines = [
            Line::Above(0, low[0]),
            Line::Below(0, high[0]),
            Line::Above(1, low[1]),
            Line::Below(1, high[1]),
        ];
        for line in lines {
            if part.iter().map(Vec::len).sum::<usize>() > UNCUT_CORNERS {
                part = clip(part, line);
            }
        }
        Some(part)
    }

    /// The region's own box as a ring.
    pub(in crate::plane) fn frame(&self) -> Ring {
        let ([x0, y0], [x1, y1]) = (self.low, self.high);
        sides(&[[x0, y0], [x1, y0], [x1, y1], [x0, y1]], 0)
    }
}

/// A box around correctly rounded corners, so enlarged that the exact ones are in it. `None` if it is not finite.
#[inline]
pub(in crate::plane) fn enlarged(low: [f64; 2], high: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    let ends = [low.map(f64::next_down), high.map(f64::next_up)];
    [low, high].iter().chain(&ends).flatten().all(|x| x.is_finite()).then_some(ends)
}

fn validate_corners(ring: usize, corners: &[[f64; 2]]) -> Result<(), Error> {
    let problem = |corner, problem| Err(Error::Region { ring, corner, problem });
    if let Some(corner) = corners.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
        return problem(corner, RegionProblem::NotFinite);
    }
    if corners.len() < 3 {
        return problem(0, RegionProblem::Empty);
    }
    let mut order: Vec<usize> = (0..corners.len()).collect();
    sorting::by(&mut order, |&i, &j| {
        delone_predicates::lexicographic(corners[i], corners[j]).then(i.cmp(&j))
    });
    match order.windows(2).find(|pair| corners[pair[0]] == corners[pair[1]]) {
        Some(pair) => problem(pair[1], RegionProblem::VisitedTwice),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::{Region2, UNCUT_CORNERS, enlarged};
    use crate::plane::region::clip::sides;
    use crate::plane::region::tree::Relation;

    fn polygon(n: u32, radius: f64) -> Vec<[f64; 2]> {
        let angle = |k: u32| std::f64::consts::TAU * f64::from(k) / f64::from(n);
        (0..n).map(|k| [radius * angle(k).cos(), radius * angle(k).sin()]).collect()
    }

    #[test]
    fn boxes_are_inside_or_outside_or_near_a_side() {
        let square = Region2::rectangle([0.0, 0.0], [4.0, 4.0]).expect("a rectangle");
        let relation = |low, high| square.relation(low, high);
        assert_eq!(relation([0.0, 0.0], [4.0, 4.0]), Relation::Inside);
        assert_eq!(relation([1.0, 1.0], [2.0, 2.0]), Relation::Inside);
        for (low, high) in [
            ([5.0, 1.0], [6.0, 2.0]),
            ([-2.0, 1.0], [-1.0, 2.0]),
            ([1.0, 5.0], [2.0, 6.0]),
            ([1.0, -2.0], [2.0, -1.0]),
        ] {
            assert_eq!(relation(low, high), Relation::Outside, "{low:?} {high:?}");
        }
        // Across one side, two of them, or touching from outside.
        for (low, high) in [
            ([3.0, 1.0], [5.0, 2.0]),
            ([3.0, 3.0], [5.0, 5.0]),
            ([-1.0, 1.0], [5.0, 2.0]),
            ([4.0, 1.0], [6.0, 2.0]),
            ([-1.0, 1.0], [0.0, 2.0]),
            ([1.0, 4.0], [2.0, 6.0]),
        ] {
            assert_eq!(relation(low, high), Relation::Across, "{low:?} {high:?}");
        }
        let annulus = Region2::polygon(&[polygon(100, 10.0), polygon(100, 5.0)]).expect("a region");
        for i in 0..2500 {
            let [x, y] = [i % 50, i / 50].map(|k| f64::from(k) * 0.43 - 10.7);
            let radius = x.hypot(y);
            let found = annulus.relation([x - 1e-3, y - 1e-3], [x + 1e-3, y + 1e-3]);
            if (5.01..9.98).contains(&radius) {
                assert_eq!(found, Relation::Inside, "{x} {y}");
            } else if !(4.98..10.01).contains(&radius) {
                assert_eq!(found, Relation::Outside, "{x} {y}");
            }
        }
        let far = annulus.relation([4.0, -1.0], [6.0, 1.0]);
        assert_eq!(far, Relation::Across);
    }

    /// Parts with a long border are cut to what is near, others are left alone.
    #[test]
    fn long_borders_are_cut_to_what_is_near() {
        // At the top, across the first cut of the tree, which is at the median corner.
        let near = |n: u32| {
            let region = Region2::polygon(&[polygon(n, 10.0)]).expect("a polygon");
            let cell = sides(&[[-0.25, 9.5], [0.25, 9.5], [0.25, 10.0], [-0.25, 10.0]], 0);
            let part = region.around(&[cell]).expect("not inside");
            part.iter().map(Vec::len).sum::<usize>()
        };
        assert_eq!([near(12), near(UNCUT_CORNERS as u32)], [12, UNCUT_CORNERS]);
        assert!(near(400) <= UNCUT_CORNERS, "{}", near(400));
    }

    #[test]
    fn rectangles_without_area_are_refused() {
        let flat = |x: f64, y: f64| Region2::rectangle([0.0; 2], [x, y]).is_err();
        assert!(flat(1.0, 0.0) && flat(0.0, 1.0) && flat(-1.0, 1.0) && flat(1.0, -1.0) && !flat(1.0, 1.0));
    }

    /// By a step, which is more than rounding can do.
    #[test]
    fn boxes_are_enlarged_by_a_step() {
        let step = 2f64.powi(-52);
        assert_eq!(
            enlarged([1.0, 0.0], [1.0, 2.0]),
            Some([[1.0 - step / 2.0, -f64::from_bits(1)], [1.0 + step, 2.0 + 2.0 * step]])
        );
        assert_eq!(enlarged([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]), None);
        assert_eq!(enlarged([0.0; 2], [f64::MAX, 1.0]), None);
    }
}
