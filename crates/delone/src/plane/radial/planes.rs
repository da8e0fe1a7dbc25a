//! The planes of all sites: the radial triangles that each insertion made, and what became of them.
//!
//! Rays are never computed: on which side of one a point is, an exact predicate says.
//!
//! Cost: O(log d) rays for the interior triangle of a site that had d neighbors, two rays for an exterior one; 28 bytes a
//! neighbor.

use delone_predicates::{Sign, angle, center_direction, center_side};

use crate::ids::{EdgeId, Place};
use crate::tally::Tally;

/// Triangles for each neighbor in a plane: the interior one, and in the neighbor's cell those towards the following
/// neighbor, the site, and the neighbor before.
pub(super) const KINDS: usize = 4;
pub(super) const INTERIOR: usize = 0;
pub(super) const FOLLOWING: usize = 1;
pub(super) const TO_SITE: usize = 2;
pub(super) const BEFORE: usize = 3;

/// The most neighbors in all planes.
pub(super) const MAX_SEATS: usize = (1 << 30) - 1;

/// A neighbor in a plane: its number in all of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seat(u32);

impl Seat {
    /// No seat yet.
    pub(super) const NONE: Self = Self(u32::MAX);
}

/// A radial triangle: `4 * seat + kind`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Radial(u32);

impl Radial {
    /// No triangle.
    pub(super) const NONE: Self = Self(u32::MAX);

    /// That of a kind at a seat.
    pub(super) fn new(seat: Seat, kind: usize) -> Self {
        Self(KINDS as u32 * seat.0 + kind as u32)
    }

    fn seat(self) -> usize {
        self.0 as usize / KINDS
    }

    fn kind(self) -> usize {
        self.0 as usize % KINDS
    }
}

/// The neighbors of a site when it was inserted, turned so that the rays between them begin in the upper half-plane.
#[derive(Clone, Copy, Debug, Default)]
struct Plane {
    start: u32,
    count: u32,
    /// How many rays are in the upper half-plane: the ray k is between the neighbors k and k + 1.
    upper: u32,
}

impl Plane {
    fn range(self) -> std::ops::Range<usize> {
        self.start as usize..(self.start + self.count) as usize
    }
}

/// The data of a seat beside the neighbor.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// Whose plane it is.
    site: Place,
    /// The corner across the edge from the neighbor to the following one.
    beyond: Place,
    /// For each triangle its Delaunay edge as long as it is present; then the seat at which the neighbor in whose cell it
    /// is sits in the plane of the site that destroyed it. Whoever remembers the triangles of edges knows which.
    links: [u32; KINDS],
}

/// See the module.
#[derive(Clone, Debug, Default)]
pub(super) struct Planes {
    /// For each site its plane.
    ranges: Vec<Plane>,
    /// Of all planes the neighbors, counter-clockwise around the site.
    neighbors: Vec<Place>,
    rows: Vec<Row>,
}

impl Planes {
    /// The number of neighbors in all planes.
    pub(super) fn seats(&self) -> usize {
        self.neighbors.len()
    }

    /// Adds the plane of a site; says to which number in the plane a number in the lists given goes.
    pub(super) fn add(
        &mut self,
        points: &[[f64; 2]],
        site: Place,
        around: &[Place],
        beyond: &[Place],
    ) -> impl Fn(usize) -> usize + use<> {
        let count = around.len();
        let is_upper = |k: usize| is_upper(points, [site, around[k % count], around[(k + 1) % count]]);
        let first = (0..count).find(|&k| is_upper(k) && !is_upper(k + count - 1)).unwrap_or(0);
        let upper = (0..count).filter(|&k| is_upper(k)).count() as u32;
        if self.ranges.len() <= site.index() {
            self.ranges.resize(site.index() + 1, Plane::default());
        }
        let start = self.neighbors.len() as u32;
        self.ranges[site.index()] = Plane { start, count: count as u32, upper };
        self.neighbors.extend(around[first..].iter().chain(&around[..first]));
        let turned = beyond[first..].iter().chain(&beyond[..first]);
        self.rows.extend(turned.map(|&beyond| Row { site, beyond, links: [u32::MAX; KINDS] }));
        move |k| (k + count - first) % count
    }

    /// The seat of a number in the plane of a site.
    pub(super) fn seat(&self, site: Place, k: usize) -> Seat {
        Seat(self.ranges[site.index()].start + k as u32)
    }

    /// Whose plane a seat is in, and who sits there.
    pub(super) fn bisector(&self, seat: Seat) -> [Place; 2] {
        [self.rows[seat.0 as usize].site, self.neighbors[seat.0 as usize]]
    }

    /// The site in whose cell a triangle is, or was, and the one on the other side of its base.
    pub(super) fn sides(&self, r: Radial) -> [Place; 2] {
        let (site, own) = (self.rows[r.seat()].site, self.neighbors[r.seat()]);
        match r.kind() {
            INTERIOR => [site, own],
            TO_SITE => [own, site],
            FOLLOWING => [own, self.beside(r.seat(), 1)],
            _ => [own, self.beside(r.seat(), -1)],
        }
    }

    /// The edge of a present triangle.
    pub(super) fn edge(&self, r: Radial) -> EdgeId {
        EdgeId::from_bits(self.rows[r.seat()].links[r.kind()])
    }

    /// Where a destroyed triangle leads.
    pub(super) fn destroyer(&self, r: Radial) -> Seat {
        Seat(self.rows[r.seat()].links[r.kind()])
    }

    pub(super) fn set_edge(&mut self, r: Radial, e: EdgeId) {
        self.rows[r.seat()].links[r.kind()] = e.bits();
    }

    pub(super) fn set_destroyer(&mut self, r: Radial, seat: Seat) {
        self.rows[r.seat()].links[r.kind()] = seat.0;
    }

    /// Who sits one further, or one before.
    fn beside(&self, seat: usize, step: isize) -> Place {
        let range = self.ranges[self.rows[seat].site.index()].range();
        let k = (seat - range.start).wrapping_add_signed(step).wrapping_add(range.len()) % range.len();
        self.neighbors[range.start + k]
    }

    /// The interior triangle of a site's plane in whose angle `q` is: a binary search.
    pub(super) fn sector<T: Tally>(
        &self,
        points: &[[f64; 2]],
        site: Place,
        q: [f64; 2],
        tally: &mut T,
    ) -> Radial {
        let plane = self.ranges[site.index()];
        let around = &self.neighbors[plane.range()];
        let [x, y] = points[site.index()];
        let (mut low, mut high) = if q[1] > y || (q[1] == y && q[0] > x) {
            (0, plane.upper as usize)
        } else {
            (plane.upper as usize, around.len())
        };
        // Rays of one half-plane are less than half a turn apart.
        while low < high {
            let middle = low.midpoint(high);
            if is_from(points, [site, around[middle], around[(middle + 1) % around.len()]], q, tally) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        Radial::new(self.seat(site, low % around.len()), INTERIOR)
    }

    /// The exterior triangle at a seat in whose angle `q` is.
    pub(super) fn exterior<T: Tally>(
        &self,
        points: &[[f64; 2]],
        seat: Seat,
        q: [f64; 2],
        tally: &mut T,
    ) -> Radial {
        let [site, own] = self.bisector(seat);
        let at = seat.0 as usize;
        let (before, following) = (self.beside(at, -1), self.beside(at, 1));
        let kind = if is_from(points, [own, following, site], q, tally) {
            if is_from(points, [own, site, before], q, tally) { BEFORE } else { TO_SITE }
        } else if is_from(points, [own, self.rows[at].beyond, following], q, tally) {
            FOLLOWING
        } else {
            BEFORE
        };
        Radial::new(seat, kind)
    }
}

/// Whether the ray from `o` to the circumcenter of the triangle `o`, `a`, `b` points up, or to the right.
fn is_upper(points: &[[f64; 2]], [o, a, b]: [Place; 3]) -> bool {
    let point = |v: Place| points[v.index()];
    let [x, y] = if b.is_ghost() {
        outward(point(a), point(o))
    } else if a.is_ghost() {
        outward(point(o), point(b))
    } else {
        center_direction(point(o), point(a), point(b))
    };
    y.is_positive() || (y.is_zero() && x.is_positive())
}

/// Whether `q` is on that ray, or on its left.
fn is_from<T: Tally>(points: &[[f64; 2]], [o, a, b]: [Place; 3], q: [f64; 2], tally: &mut T) -> bool {
    let point = |v: Place| points[v.index()];
    tally.orientation();
    // The center of a ghost is far away, square to its hull edge.
    if b.is_ghost() {
        !angle(point(o), point(a), q).is_positive()
    } else if a.is_ghost() {
        !angle(point(o), point(b), q).is_negative()
    } else {
        !center_side(point(o), point(a), point(b), q).is_negative()
    }
}

/// The signs of the direction square to a hull edge from `a` to `b`, away from the hull.
fn outward(a: [f64; 2], b: [f64; 2]) -> [Sign; 2] {
    [Sign::of(&b[1], &a[1]), Sign::of(&a[0], &b[0])]
}
