//! Two, three or four points triangulated at once, from tables.
//!
//! Half of all merges of a binary recursion would join one to four points; writing their few triangles down
//! saves those merges and the mispredicted branches in them. Sets with three collinear points are left to the
//! merge.

use delone_predicates::{Filter, Four, Member, Pencil, Sign};

use super::builder::Builder;
use super::merge::{Merging, Part};
use crate::ids::{Place, TriangleId};
use crate::mesh::triangles::HalfEdge;

/// The triangulation of a few points.
pub(super) enum Leaf {
    Part(Part),
    /// Three of them are collinear: nothing was written.
    Collinear,
}

/// A triangulation of points 0.. written as (corner, twin) for each edge, triangle by triangle; the corner
/// [`G`] is the ghost, and the edge `10 t + k` leaves corner k of triangle t.
type Template<const N: usize> = [[(u8, u8); 3]; N];

/// The ghost corner of a template.
const G: u8 = u8::MAX;

/// The edge 0-1.
const SEGMENT: Template<2> = [[(1, 10), (0, 12), (G, 11)], [(0, 0), (1, 2), (G, 1)]];

/// The triangle 0, 1, 2.
const TRIANGLE: Template<4> = [
    [(0, 10), (1, 20), (2, 30)],
    [(1, 0), (0, 32), (G, 21)],
    [(2, 1), (1, 12), (G, 31)],
    [(0, 2), (2, 22), (G, 11)],
];

/// The convex quadrilateral 0, 1, 2, 3 with the diagonal 0-2.
const QUADRILATERAL: Template<6> = [
    [(0, 20), (1, 30), (2, 10)],
    [(0, 2), (2, 40), (3, 50)],
    [(1, 0), (0, 52), (G, 31)],
    [(2, 1), (1, 22), (G, 41)],
    [(3, 11), (2, 32), (G, 51)],
    [(0, 12), (3, 42), (G, 21)],
];

/// The triangle 0, 1, 2 with 3 inside.
const FAN: Template<6> = [
    [(0, 30), (1, 12), (3, 21)],
    [(1, 40), (2, 22), (3, 1)],
    [(2, 50), (0, 2), (3, 11)],
    [(1, 0), (0, 52), (G, 41)],
    [(2, 10), (1, 32), (G, 51)],
    [(0, 20), (2, 42), (G, 31)],
];

/// How four points a, b, c, d in general position lie.
#[derive(Clone, Copy)]
struct Layout {
    /// Which of them play the corners 0 to 3 of a template.
    corners: [u8; 4],
    /// Corners 0 to 3 are a convex quadrilateral, counter-clockwise; else 3 is inside the triangle 0, 1, 2.
    convex: bool,
    /// The order of `corners` is an even permutation, so the in-circle sign of a, b, c, d is theirs.
    even: bool,
}

/// Layouts by the signs of the four orientations: bit 0 for (a, b, c), 1 for (a, b, d), 2 for (a, c, d), 3 for
/// (b, c, d), set when counter-clockwise.
const LAYOUTS: [Layout; 16] = {
    let mut table = [Layout { corners: [0; 4], convex: false, even: true }; 16];
    let mut signs = 0;
    while signs < 16 {
        table[signs] = layout(signs);
        signs += 1;
    }
    table
};

/// Whether corners i, j, k of a permutation turn left, given the signs of the sorted triples.
const fn turns_left(signs: usize, i: u8, j: u8, k: u8) -> bool {
    let missing = 6 - i - j - k;
    let sorted_left = signs >> (3 - missing) & 1 == 1;
    let swaps = (i > j) as u8 + (i > k) as u8 + (j > k) as u8;
    sorted_left == swaps.is_multiple_of(2)
}

/// Tries all 24 orders of the points until one fits a template. Two of the sixteen combinations cannot occur
/// and keep a placeholder.
const fn layout(signs: usize) -> Layout {
    let mut code = 0;
    while code < 256 {
        let p = [code as u8 & 3, code as u8 >> 2 & 3, code as u8 >> 4 & 3, code as u8 >> 6];
        code += 1;
        if 1 << p[0] | 1 << p[1] | 1 << p[2] | 1 << p[3] != 15 {
            continue;
        }
        let left_012 = turns_left(signs, p[0], p[1], p[2]);
        let left_123 = turns_left(signs, p[1], p[2], p[3]);
        let left_230 = turns_left(signs, p[2], p[3], p[0]);
        let left_301 = turns_left(signs, p[3], p[0], p[1]);
        let convex = left_012 && left_123 && left_230 && left_301;
        let fan = left_012 && left_123 && !left_230 && left_301;
        if convex || fan {
            let swaps = (p[0] > p[1]) as u8
                + (p[0] > p[2]) as u8
                + (p[0] > p[3]) as u8
                + (p[1] > p[2]) as u8
                + (p[1] > p[3]) as u8
                + (p[2] > p[3]) as u8;
            return Layout { corners: p, convex, even: swaps.is_multiple_of(2) };
        }
    }
    Layout { corners: [0, 1, 2, 3], convex: false, even: true }
}

impl<K: Merging> Builder<'_, K> {
    /// Triangulates the two to four points from `start` on. The filter holds for them.
    pub(super) fn leaf(&mut self, start: usize, count: usize, filter: &Filter) -> Leaf {
        let written = match count {
            2 => {
                self.write(start, [0, 1], &SEGMENT);
                true
            }
            3 => self.three(start, filter),
            _ => self.four(start, filter),
        };
        if !written {
            return Leaf::Collinear;
        }
        self.counters.leaves += 1;
        Leaf::Part(Part::of_points(self.points, start, start + count))
    }

    fn three(&mut self, start: usize, filter: &Filter) -> bool {
        let [a, b, c] = [0, 1, 2].map(|i| self.points[start + i]);
        let pencil = Pencil::new(a, b);
        let corners = match pencil.side(&pencil.member(c), filter) {
            Sign::Positive => [0, 1, 2],
            Sign::Negative => [0, 2, 1],
            Sign::Zero => return false,
        };
        self.write(start, corners, &TRIANGLE);
        true
    }

    fn four(&mut self, start: usize, filter: &Filter) -> bool {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| self.points[start + i]);
        if !K::HIDES
            && let Some(Four { turns, circle }) = Four::of(a, b, c, d, filter)
        {
            // Either template by one way: which one it is cannot be foretold.
            let Layout { corners: p, convex, even } = LAYOUTS[usize::from(turns)];
            let first = usize::from(convex) & usize::from(circle == even);
            let corners = [p[first], p[first + 1], p[first + 2], p[(first + 3) % 4]];
            self.write_four(start, corners, if convex { &QUADRILATERAL } else { &FAN });
            return true;
        }
        let (over_ab, over_cd) = (Pencil::new(a, b), Pencil::new(c, d));
        let (mc, md) = (over_ab.member(c), over_ab.member(d));
        let (ma, mb) = (over_cd.member(a), over_cd.member(b));
        let side = |pencil: &Pencil, member: &Member| pencil.side(member, filter);
        // (c, d, a) and (c, d, b) are rotations of (a, c, d) and (b, c, d).
        let signs = [side(&over_ab, &mc), side(&over_ab, &md), side(&over_cd, &ma), side(&over_cd, &mb)];
        if signs.contains(&Sign::Zero) {
            return false;
        }
        let code =
            signs.iter().enumerate().map(|(i, sign)| usize::from(sign.is_positive()) << i).sum::<usize>();
        let Layout { corners: p, convex, even } = LAYOUTS[code];
        if convex {
            // The diagonal 0-2 stays unless corner 3 is inside the circle of the other three.
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| self.site(Place::new(start + i)));
            let inside = K::in_circle(&over_ab, [a, b], (&mc, c), (&md, d), filter).is_positive() == even;
            let corners = if inside { [p[1], p[2], p[3], p[0]] } else { p };
            self.write(start, corners, &QUADRILATERAL);
        } else if K::HIDES && self.is_hidden(start, p) {
            let [a, b, c, _] = p;
            self.write(start, [a, b, c], &TRIANGLE);
            self.records(TriangleId::new(2 * start + TRIANGLE.len()), FAN.len() - TRIANGLE.len())
                .fill(HalfEdge::UNUSED);
        } else {
            self.write(start, p, &FAN);
        }
        true
    }

    /// Whether the last of four points is hidden by the triangle around it, which is counter-clockwise.
    fn is_hidden(&self, start: usize, corners: [u8; 4]) -> bool {
        let [a, b, c, d] = corners.map(|i| self.site(Place::new(start + usize::from(i))));
        !K::contains(a, b, c, d)
    }

    /// Writes either template of four points.
    #[inline]
    fn write_four(&mut self, start: usize, corners: [u8; 4], template: &Template<6>) {
        let first = 2 * start;
        let mut vertices = [Place::GHOST; 8];
        for (vertex, corner) in vertices.iter_mut().zip(corners) {
            *vertex = Place::new(start + usize::from(corner));
        }
        let vertex = |corner: u8| vertices[usize::from(corner % 8)];
        let records = self.records(TriangleId::new(first), 6);
        for (triangle, records) in template.iter().zip(records.chunks_exact_mut(4)) {
            for (&(corner, twin), record) in triangle.iter().zip(records) {
                let twin = TriangleId::new(first + usize::from(twin / 10)).edge(usize::from(twin % 10));
                *record = HalfEdge { origin: vertex(corner), twin };
            }
        }
        // The third triangle of a fan is no ghost; the ghost of the same corner comes after it.
        for (slot, triangle) in template.iter().enumerate().skip(2) {
            self.set_leaving(vertex(triangle[1].0), TriangleId::new(first + slot));
        }
    }

    /// Writes a template for the points `start + corners[i]`, into the triangles that they own.
    #[inline]
    fn write<const C: usize, const N: usize>(
        &mut self,
        start: usize,
        corners: [u8; C],
        template: &Template<N>,
    ) {
        let first = 2 * start;
        let records = self.records(TriangleId::new(first), N);
        for (triangle, records) in template.iter().zip(records.chunks_exact_mut(4)) {
            for (&(corner, twin), record) in triangle.iter().zip(records) {
                let twin = TriangleId::new(first + usize::from(twin / 10)).edge(usize::from(twin % 10));
                *record = HalfEdge { origin: self::vertex(start, &corners, corner), twin };
            }
        }
        for (slot, triangle) in template.iter().enumerate().filter(|(_, triangle)| triangle[2].0 == G) {
            let u = self::vertex(start, &corners, triangle[1].0);
            self.set_leaving(u, TriangleId::new(first + slot));
        }
    }
}

/// The vertex that plays a corner of a template.
#[inline]
fn vertex(start: usize, corners: &[u8], corner: u8) -> Place {
    if corner == G { Place::GHOST } else { Place::new(start + usize::from(corners[usize::from(corner)])) }
}

#[cfg(test)]
mod tests {
    use super::{FAN, G, LAYOUTS, QUADRILATERAL, SEGMENT, TRIANGLE};

    fn is_closed(template: &[[(u8, u8); 3]]) {
        let corner = |e: u8| template[usize::from(e / 10)][usize::from(e % 10)].0;
        let next = |e: u8| if e % 10 == 2 { e - 2 } else { e + 1 };
        for (t, triangle) in template.iter().enumerate() {
            for (k, &(origin, twin)) in triangle.iter().enumerate() {
                let e = 10 * t as u8 + k as u8;
                assert_eq!(template[usize::from(twin / 10)][usize::from(twin % 10)].1, e, "twin of {e}");
                assert_eq!(corner(next(twin)), origin, "destination of the twin of {e}");
            }
            assert!(triangle[..2].iter().all(|&(corner, _)| corner != G), "the ghost is the last corner");
        }
    }

    #[test]
    fn templates_are_closed_surfaces() {
        is_closed(&SEGMENT);
        is_closed(&TRIANGLE);
        is_closed(&QUADRILATERAL);
        is_closed(&FAN);
    }

    #[test]
    fn fourteen_of_sixteen_sign_patterns_occur() {
        let real = LAYOUTS.iter().filter(|l| l.convex).count();
        assert_eq!(real, 6);
        let fans = LAYOUTS.iter().filter(|l| !l.convex && l.corners != [0, 1, 2, 3]).count();
        assert!((7..=8).contains(&fans), "{fans}");
    }
}
