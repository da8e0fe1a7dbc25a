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

use delone_predicates::{are_collinear3, lexicographic3, orient3d};

use super::faces::Faces;
use super::shell::{NONE, Shell};
use super::start::turn;
use super::{Hull3, check};
use crate::error::Error;
use crate::mesh::Dimension;
use crate::order::random::SplitMix;
use crate::points::{self, Position3};
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
    hull: Hull3,
    facets: Facets,
    work: Work,
}

#[derive(Clone, Debug)]
enum Facets {
    /// The points do not span space; the corners of what they span.
    None(Vec<[f64; 3]>),
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
        let (points, mut work) = (&*P::all(points), Work::default());
        let tally = &mut work;
        check(points)?;
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_unstable_by(|&i, &j| lexicographic3(points[i], points[j]).then(i.cmp(&j)));
        order.dedup_by(|later, first| points[*later] == points[*first]);
        SplitMix(seed).shuffle(&mut order);
        let Some(first) = first_four(points, &order) else {
            let hull = Hull3::from_points(points)?;
            let corners = hull.corners.iter().map(|&i| points[i]).collect();
            return Ok(Self { hull, facets: Facets::None(corners), work });
        };
        let mut history = History { shell: Shell::new(points.to_vec(), first), links: Vec::new() };
        tally.created(4);
        for p in order.into_iter().filter(|p| !first.contains(p)) {
            if let Some(f) = history.seen_from(points[p], tally) {
                history.insert(p as u32, f);
                tally.created(history.shell.fresh.len());
                tally.destroyed(history.shell.seen.len());
            }
        }
        let hull = Hull3::solid(Faces::of(&history.shell));
        Ok(Self { hull, facets: Facets::Some(Box::new(history)), work })
    }

    /// What the construction did: facets visited by descents, created and destroyed.
    pub fn counters(&self) -> Counters {
        Counters::Incremental(self.work)
    }

    /// The hull, equal to what [`Hull3::from_points`] makes.
    pub fn hull(&self) -> &Hull3 {
        &self.hull
    }

    /// The number of facets that ever were.
    pub fn size(&self) -> usize {
        match &self.facets {
            Facets::None(_) => 0,
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
            Facets::None(corners) => lies_in(self.hull.span, corners, q),
            Facets::Some(history) => history.shell.is_in_box(q) && history.seen_from(q, tally).is_none(),
        })
    }
}

impl History {
    /// A facet of today's hull that a point in the box sees, if there is one.
    fn seen_from<T: Tally>(&self, q: [f64; 3], tally: &mut T) -> Option<u32> {
        let mut sees = |f: u32| {
            tally.orientation();
            self.shell.sees(q, f)
        };
        let mut stack: Vec<u32> = (0..4).filter(|&f| sees(f)).collect();
        while let Some(f) = stack.pop() {
            let facet = &self.shell.facets[f as usize];
            if facet.alive {
                return Some(f);
            }
            let mut next = facet.head;
            while next != NONE {
                let link = self.links[next as usize];
                if sees(link.to) && (link.unless == NONE || !sees(link.unless)) {
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

/// The first four points of an order that span space, the last one on the positive side of the others.
fn first_four(points: &[[f64; 3]], order: &[usize]) -> Option<[usize; 4]> {
    let [&a, &b] = [order.first()?, order.get(1)?];
    let c = order.iter().copied().find(|&c| !are_collinear3(points[a], points[b], points[c]))?;
    let side = |&d: &usize| orient3d(points[a], points[b], points[c], points[d]);
    let d = order.iter().copied().find(|d| !side(d).is_zero())?;
    Some(if side(&d).is_positive() { [a, b, c, d] } else { [b, a, c, d] })
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
