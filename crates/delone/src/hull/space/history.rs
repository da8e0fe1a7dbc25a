//! The hull by random order, and all facets that ever were: queries afterwards.
//!
//! Points are inserted in random order; a facet that a point sees gives way to those that join the point to the border
//! of what it sees. No facet is forgotten. A new facet hangs below the two that met in its edge of the border, the one
//! that was seen and the one that was not: whoever sees the new facet sees one of these. So a descent from the first
//! tetrahedron, through facets that are seen alone, finds a facet of today's hull that is seen, if there is one.
//!
//! Source: Guibas, Knuth & Sharir, "Randomized incremental construction of Delaunay and Voronoi diagrams",
//! Algorithmica 1992, §4.1 and the end of §5. The paper descends to the one facet above or below a point; the
//! descent to all that are seen is by Boissonnat & Teillaud, "On the randomized construction of the Delaunay tree",
//! TCS 1993, and needs no direction, so no perturbation either.
//!
//! Cost: O(n log n) expected to build, O(n) expected facets that ever were (Theorem 4.1); O(log n) expected for a
//! query inside of the hull. For the hull alone, [`Hull3::from_points`] is faster.

use std::sync::OnceLock;

use delone_predicates::{are_collinear3, lexicographic3, orient3d};

use super::faces::Faces;
use super::shell::{NONE, Shell};
use super::start::turn;
use super::{Hull3, check};
use crate::error::Error;
use crate::mesh::Dimension;
use crate::order::random::SplitMix;
use crate::points::{self, Position3};
use crate::sorting;
use crate::tally::{Counters, Tally, Work};

/// A convex hull with its history.
///
/// ```
/// use delone::HullHistory3;
///
/// let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let history = HullHistory3::from_points(&corners, 1)?;
/// assert_eq!(history.hull().faces().len(), 4);
/// assert!(history.contains([0.25, 0.25, 0.5])?); // on a face
/// assert!(!history.contains([0.5, 0.5, 0.5])?);
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct HullHistory3 {
    /// The hull, once it was asked for.
    hull: OnceLock<Hull3>,
    facets: Facets,
    work: Work,
}

#[derive(Clone, Debug)]
enum Facets {
    /// The points do not span space: all of them, and the first ones that span what they span.
    None(Vec<[f64; 3]>, Vec<usize>),
    /// All facets that ever were.
    Some(Box<History>),
}

/// Facets that hang below each other.
#[derive(Clone, Debug)]
struct History {
    shell: Shell,
    /// The lists of what hangs below facets.
    links: Vec<Link>,
}

/// A facet that hangs below another.
#[derive(Clone, Copy, Debug)]
struct Link {
    to: u32,
    /// Its other parent, if that is to be followed where both are seen: then each facet is met once.
    unless: u32,
    next: u32,
}

impl HullHistory3 {
    /// Builds the hull; the seed decides the random order.
    ///
    /// # Errors
    /// As [`Hull3::from_points`].
    pub fn from_points<P: Position3>(points: &[P], seed: u64) -> Result<Self, Error> {
        let points = &*P::all(points);
        check(points)?;
        let mut order: Vec<usize> = (0..points.len()).collect();
        sorting::by(&mut order, |&i, &j| lexicographic3(points[i], points[j]).then(i.cmp(&j)));
        order.dedup_by(|later, first| points[*later] == points[*first]);
        SplitMix(seed).shuffle(&mut order);
        let mut work = Work::default();
        let base = base(points, &order);
        let facets = match base[..] {
            [a, b, c, d] => {
                Facets::Some(Box::new(History::of(points.to_vec(), [a, b, c, d], order, &mut work)))
            }
            _ => Facets::None(points.to_vec(), base),
        };
        Ok(Self { hull: OnceLock::new(), facets, work })
    }

    /// The hull of no points.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a point, whose index is the number of points given before; says whether it was outside of the hull.
    ///
    /// Cost: O(log n) expected for a descent, and O(1) new facets, if the points come in random order; in another order up to
    /// n facets each time, as right as in that. All planes are made anew when the box around the points has doubled. While
    /// the points do not span space, nothing is kept, and it costs O(n log n).
    ///
    /// # Errors
    /// [`Error::Coordinate`] if a coordinate is NaN or infinite; [`Error::TooManyPoints`]. Nothing has changed then.
    ///
    /// ```
    /// use delone::HullHistory3;
    ///
    /// let mut history = HullHistory3::new();
    /// for p in [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]] {
    ///     assert!(history.insert(p)?);
    /// }
    /// assert!(!history.insert([1.0; 3])?);
    /// assert!(history.insert([2.0; 3])?);
    /// assert_eq!(history.hull().corners(), [0, 1, 2, 3, 5]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn insert<P: Position3>(&mut self, point: P) -> Result<bool, Error> {
        let q = points::finite(point.xyz())?;
        let given = match &self.facets {
            Facets::None(points, _) => points.len(),
            Facets::Some(history) => history.shell.points.len(),
        };
        points::check_count(given + 1, crate::MAX_POINTS)?;
        let is_flat_outside = matches!(self.facets, Facets::None(..)) && !self.contains(q)?;
        let is_outside = match &mut self.facets {
            Facets::None(points, base) => {
                points.push(q);
                if widens(points, base, given) {
                    base.push(given);
                }
                if let [a, b, c, d] = base[..] {
                    let points = std::mem::take(points);
                    let order = (0..points.len()).collect();
                    let first = oriented(&points, [a, b, c, d]);
                    self.facets = Facets::Some(Box::new(History::of(points, first, order, &mut self.work)));
                }
                is_flat_outside
            }
            Facets::Some(history) => {
                let p = history.shell.add(q);
                history.settle(p, &mut self.work)
            }
        };
        if is_outside {
            self.hull.take();
        }
        Ok(is_outside)
    }

    /// Counters of the construction: facets visited by descents, created and destroyed.
    pub fn counters(&self) -> Counters {
        Counters::Incremental(self.work)
    }

    /// The hull, equal to what [`Hull3::from_points`] makes.
    pub fn hull(&self) -> &Hull3 {
        self.hull.get_or_init(|| match &self.facets {
            Facets::None(points, _) => Hull3::of(points),
            Facets::Some(history) => Hull3::solid(Faces::of(&history.shell, |i| i)),
        })
    }

    /// The number of facets that ever were.
    pub fn size(&self) -> usize {
        match &self.facets {
            Facets::None(..) => 0,
            Facets::Some(history) => history.shell.facets.len(),
        }
    }

    /// Whether a point is inside of the hull or on it.
    ///
    /// # Errors
    /// [`Error::Coordinate`] if a coordinate is NaN or infinite.
    pub fn contains<P: Position3>(&self, q: P) -> Result<bool, Error> {
        self.contains_observed(q.xyz(), &mut ())
    }

    /// Does what [`Self::contains`] does, and tells the facets visited and the planes asked.
    ///
    /// # Errors
    /// As [`Self::contains`].
    pub fn contains_observed<T: Tally>(&self, q: [f64; 3], tally: &mut T) -> Result<bool, Error> {
        let q = points::finite(q)?;
        Ok(match &self.facets {
            Facets::None(points, _) => {
                let hull = self.hull();
                let corners: Vec<[f64; 3]> = hull.corners.iter().map(|&i| points[i]).collect();
                lies_in(hull.span, &corners, q)
            }
            Facets::Some(history) => history.shell.is_in_box(q) && history.seen_from(q, tally).is_none(),
        })
    }
}

impl Default for HullHistory3 {
    fn default() -> Self {
        Self { hull: OnceLock::new(), facets: Facets::None(Vec::new(), Vec::new()), work: Work::default() }
    }
}

impl History {
    /// Points inserted in their order, after four that span space.
    fn of(points: Vec<[f64; 3]>, first: [usize; 4], order: Vec<usize>, tally: &mut Work) -> Self {
        let mut history = Self { shell: Shell::new(points, first), links: Vec::new() };
        tally.created(4);
        for p in order.into_iter().filter(|p| !first.contains(p)) {
            history.settle(p as u32, tally);
        }
        history
    }

    /// Makes a point a corner, if it is outside.
    fn settle<T: Tally>(&mut self, p: u32, tally: &mut T) -> bool {
        let seen = self.seen_from(self.shell.points[p as usize], tally);
        if let Some(f) = seen {
            self.insert(p, f);
            tally.created(self.shell.fresh.len());
            tally.destroyed(self.shell.seen.len());
        }
        seen.is_some()
    }

    /// A facet of today's hull that a point in the box sees, if there is one.
    fn seen_from<T: Tally>(&self, q: [f64; 3], tally: &mut T) -> Option<u32> {
        let sees = |f: u32, tally: &mut T| {
            tally.orientation();
            self.shell.sees(q, f)
        };
        let mut stack: Vec<u32> = (0..4).filter(|&f| sees(f, tally)).collect();
        while let Some(f) = stack.pop() {
            tally.visited();
            let facet = &self.shell.facets[f as usize];
            if facet.alive {
                return Some(f);
            }
            let mut next = facet.head;
            while next != NONE {
                let link = self.links[next as usize];
                if sees(link.to, tally) && (link.unless == NONE || !sees(link.unless, tally)) {
                    stack.push(link.to);
                }
                next = link.next;
            }
        }
        None
    }

    /// Caps what a point sees, from a facet that it sees.
    fn insert(&mut self, p: u32, from: u32) {
        self.shell.look(p, from);
        self.shell.cap(p);
        for (&to, border) in self.shell.fresh.iter().zip(&self.shell.horizon) {
            for (parent, unless) in [(border.inside, NONE), (border.outside, border.inside)] {
                let head = &mut self.shell.facets[parent as usize].head;
                let next = std::mem::replace(head, self.links.len() as u32);
                self.links.push(Link { to, unless, next });
            }
        }
    }
}

/// Whether a point is not in the span of the first ones.
fn widens(points: &[[f64; 3]], base: &[usize], p: usize) -> bool {
    let of = |i: usize| points[i];
    match *base {
        [] => true,
        [a] => of(a) != of(p),
        [a, b] => !are_collinear3(of(a), of(b), of(p)),
        [a, b, c] => !orient3d(of(a), of(b), of(c), of(p)).is_zero(),
        _ => false,
    }
}

/// The first points of an order that span what all span; of four the last one is on the positive side of the others.
fn base(points: &[[f64; 3]], order: &[usize]) -> Vec<usize> {
    let mut base = Vec::new();
    for &p in order {
        if base.len() < 4 && widens(points, &base, p) {
            base.push(p);
        }
    }
    match base[..] {
        [a, b, c, d] => oriented(points, [a, b, c, d]).to_vec(),
        _ => base,
    }
}

/// The last one of four points on the positive side of the others.
fn oriented(points: &[[f64; 3]], [a, b, c, d]: [usize; 4]) -> [usize; 4] {
    let side = orient3d(points[a], points[b], points[c], points[d]);
    if side.is_positive() { [a, b, c, d] } else { [b, a, c, d] }
}

/// Whether a point is in what corners span that do not span space.
fn lies_in(span: Dimension, corners: &[[f64; 3]], q: [f64; 3]) -> bool {
    match (span, corners) {
        (Dimension::Point, &[a]) => a == q,
        (Dimension::Line, &[a, b]) => {
            are_collinear3(a, b, q) && lexicographic3(a, q).is_le() && lexicographic3(q, b).is_le()
        }
        (Dimension::Plane, &[a, b, c, ..]) if orient3d(a, b, c, q).is_zero() => {
            // Along an axis in which the plane does not vanish, inside stays inside.
            let axis = (0..3).find(|&axis| turn(&[a, b, c], [0, 1, 2], axis).is_ne()).unwrap_or(2);
            let around = turn(&[a, b, c], [0, 1, 2], axis);
            let sides = corners.iter().zip(corners.iter().cycle().skip(1));
            sides.into_iter().all(|(&u, &v)| turn(&[u, v, q], [0, 1, 2], axis) != around.reverse())
        }
        _ => false,
    }
}
