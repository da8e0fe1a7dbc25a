//! Quadrilaterals in meshes that are read: each is two triangles, by the diagonal that exact rules choose.
//!
//! Of a convex one it is the diagonal that a Delaunay triangulation of the four corners has. Of one with a corner that is no turn, or a turn
//! to the other side, it is the diagonal from there, which alone is inside. One that crosses itself or is flat is refused.

use delone_predicates::{Sign, in_circle, orient2d};

use crate::Error;

/// A quadrilateral as its file lists it.
#[derive(Debug)]
struct Quad {
    /// How many triangles were listed before it.
    before: usize,
    corners: [u64; 4],
    number: i64,
}

/// The quadrilaterals of a mesh, in the order of the file.
#[derive(Debug, Default)]
pub(crate) struct Quads(Vec<Quad>);

impl Quads {
    /// Adds one after so many triangles, by its corners as indices of points, with the number that it has.
    pub(crate) fn push(&mut self, before: usize, corners: [u64; 4], number: i64) {
        self.0.push(Quad { before, corners, number });
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// Triangles, and the two of each quadrilateral where that was among them.
    pub(crate) fn among<const N: usize>(
        &self,
        format: &str,
        triangles: Vec<([u64; N], i64)>,
        place: impl Fn(u64) -> [f64; 2],
    ) -> Result<Vec<([u64; N], i64)>, Error> {
        if self.0.is_empty() {
            return Ok(triangles);
        }
        let mut all = Vec::with_capacity(triangles.len() + 2 * self.0.len());
        let mut listed = triangles.into_iter();
        let mut done = 0;
        for Quad { before, corners, number } in &self.0 {
            all.extend(listed.by_ref().take(before - done));
            done = *before;
            let halves = halves(corners.map(&place)).ok_or_else(|| {
                let [a, b, c, d] = corners;
                Error::content(format!(
                    "{format}: the quadrilateral of points {a}, {b}, {c} and {d}, counted from 0, crosses itself or is flat, so it is no two triangles"
                ))
            })?;
            all.extend(halves.map(|half| (std::array::from_fn(|k| corners[half[k]]), *number)));
        }
        all.extend(listed);
        Ok(all)
    }
}

/// The corners of the two triangles of a quadrilateral, turning as it does.
fn halves(p: [[f64; 2]; 4]) -> Option<[[usize; 3]; 2]> {
    if !p.iter().flatten().all(|x| x.is_finite()) {
        return None;
    }
    let turns = [0, 1, 2, 3].map(|k| orient2d(p[(k + 3) % 4], p[k], p[(k + 1) % 4]));
    // The diagonal from a corner is inside if both triangles beside it turn alike.
    let is_inside = |k: usize| !turns[k + 1].is_zero() && turns[k + 1] == turns[(k + 3) % 4];
    let [a, b, c, d] = p;
    let from = match (is_inside(0), is_inside(1)) {
        (true, true) => {
            let is_in_circle =
                if turns[0] == Sign::Positive { in_circle(a, b, c, d) } else { in_circle(c, b, a, d) };
            usize::from(is_in_circle == Sign::Positive)
        }
        (true, false) => 0,
        (false, true) => 1,
        (false, false) => return None,
    };
    Some([[0, 1, 2], [2, 3, 0]].map(|half| half.map(|k| (k + from) % 4)))
}

#[cfg(test)]
mod tests {
    use delone_generators::Random;

    use super::{Quads, halves};

    /// Turns of the triangles, and whether a corner of one is in the circle of the other, over integers.
    fn turn([a, b, c]: [[i64; 2]; 3]) -> i64 {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    fn in_circle([a, b, c]: [[i64; 2]; 3], d: [i64; 2]) -> i64 {
        let [a, b, c] = [a, b, c].map(|p| [p[0] - d[0], p[1] - d[1]]);
        let lift = |p: [i64; 2]| p[0] * p[0] + p[1] * p[1];
        let cross = |p: [i64; 2], q: [i64; 2]| p[0] * q[1] - p[1] * q[0];
        lift(a) * cross(b, c) + lift(b) * cross(c, a) + lift(c) * cross(a, b)
    }

    /// All quadrilaterals on a small lattice at random: halves fill them, or they have no inside.
    #[test]
    fn halves_fill_a_quadrilateral() {
        let mut random = Random::new(4);
        let (mut refused, mut bent) = (0, 0);
        for _ in 0..20_000 {
            let p = [0; 4].map(|_| [0; 2].map(|_| random.below(6) as i64));
            let area = turn([p[0], p[1], p[2]]) + turn([p[0], p[2], p[3]]);
            let corners = [0, 1, 2, 3].map(|k| turn([p[(k + 3) % 4], p[k], p[(k + 1) % 4]]).signum());
            let Some(found) = halves(p.map(|p| p.map(|x| x as f64))) else {
                // With two corners of each turn it crosses itself; with two that are none it is flat or less.
                let count = |sign: i64| corners.iter().filter(|&&corner| corner == sign).count();
                assert!(count(1) < 3 && count(-1) < 3, "{p:?}");
                refused += 1;
                continue;
            };
            let turns = found.map(|half| turn(half.map(|k| p[k])));
            assert!(turns[0] * turns[1] > 0 && turns[0] + turns[1] == area, "{p:?}");
            if corners.iter().all(|&corner| corner == area.signum()) {
                let [half, other] = found.map(|half| half.map(|k| p[k]));
                let far = p[(0..4).find(|k| !found[0].contains(k)).expect("one is left")];
                assert!(in_circle(half, far) * area.signum() <= 0, "{half:?} {other:?}");
            } else {
                bent += 1;
            }
        }
        assert!(refused > 1000 && bent > 1000, "{refused} {bent}");
        // Any first corner gives the same diagonal, in a tie too.
        for p in [
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
            [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]],
        ] {
            let diagonals = [0, 1, 2, 3].map(|first| {
                let turned = [0, 1, 2, 3].map(|k| (k + first) % 4);
                let [half, _] = halves(turned.map(|k| p[k])).expect("a rectangle");
                (turned[half[0]] % 2, turned[half[2]] % 2)
            });
            assert!(diagonals.iter().all(|diagonal| *diagonal == diagonals[0]), "{diagonals:?}");
        }
        assert_eq!(halves([[0.0, 0.0], [f64::NAN, 0.0], [1.0, 1.0], [0.0, 1.0]]), None);
    }

    #[test]
    fn the_order_of_the_file_stays() {
        let place = |i: u64| [[0.0, 0.0], [1.0, 0.0], [2.0, 1.0], [0.0, 1.0]][i as usize];
        let mut quads = Quads::default();
        quads.push(1, [0, 1, 2, 3], 7);
        quads.push(2, [3, 0, 1, 2], 8);
        let listed = vec![([0, 1, 2], 1), ([0, 2, 3], 2), ([1, 2, 3], 3)];
        let all = quads.among("X", listed, place).expect("two triangles each");
        assert_eq!(all.iter().map(|row| row.1).collect::<Vec<_>>(), [1, 7, 7, 2, 8, 8, 3]);
        quads.push(3, [0, 2, 1, 3], 9);
        let error =
            quads.among("X", vec![([0, 1, 2], 0); 3], place).expect_err("it crosses itself").to_string();
        assert!(error.contains("points 0, 2, 1 and 3"), "{error}");
    }
}
