//! The orientation of points that are moved, beside a determinant of points that are moved by small parts indeed.

use delone_generators::Random;
use delone_predicates::{Sign, are_collinear3, orient3d, orient3d_moved};

/// One over the part of a way that is small enough for coordinates from 0 to 2.
const K: i128 = 256;

type Point = [i128; 3];

fn sub(p: Point, q: Point) -> Point {
    [0, 1, 2].map(|k| p[k] - q[k])
}

fn determinant([a, b, c]: [Point; 3]) -> i128 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// With `c` in units of one over K^3, and `d` of one over K^12.
fn moved(a: Point, b: Point, c: &[Point], d: Point) -> Sign {
    let part = |i: usize| K.pow(3 - i as u32);
    let from_first = c.iter().enumerate().skip(1).map(|(i, &other)| sub(other, c[0]).map(|x| x * part(i)));
    let c = from_first.fold(sub(c[0], a).map(|x| x * part(0)), |p, q| [0, 1, 2].map(|k| p[k] + q[k]));
    let d = sub(d, a).map(|x| x * K.pow(12));
    let d = [d[0] + K.pow(8), d[1] + K.pow(4), d[2] + 1];
    Sign::of(&determinant([sub(b, a), c, d]), &0)
}

#[test]
fn steps_are_infinitesimal() {
    let mut random = Random::new(1);
    let mut ties = [0; 2];
    for _ in 0..200_000 {
        let mut point = || [(); 3].map(|()| random.below(3) as i128);
        let (a, b, d) = (point(), point(), point());
        let c = [point(), point(), point(), point()];
        let count = 1 + random.below(4);
        let of = |p: Point| p.map(|x| x as f64);
        let floats = c.map(of);
        let found = orient3d_moved(of(a), of(b), &floats[..count], of(d));
        assert_eq!(found, moved(a, b, &c[..count], d), "{a:?} {b:?} {:?} {d:?}", &c[..count]);
        ties[0] += usize::from(orient3d(of(a), of(b), floats[0], of(d)).is_zero());
        ties[1] += usize::from(found.is_zero());
        if count == 1 {
            assert_eq!(found.is_zero(), are_collinear3(of(a), of(b), floats[0]));
        }
    }
    assert!(ties[0] > 50_000 && ties[1] > 1_000, "{ties:?}");
}
