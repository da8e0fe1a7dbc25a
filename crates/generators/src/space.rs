//! Named point sets in space.

use crate::{Point3, Random, repeat};

kinds! {
    /// A named family of point sets in space.
    Kind3, points -> Vec<Point3>:
    /// Uniform in the unit cube.
    Cube = "cube", |n, r| repeat(n, || [r.unit(), r.unit(), r.unit()]);
    /// Uniform in the unit ball.
    Ball = "ball", |n, r| repeat(n, || in_ball(r));
    /// On the unit sphere, rounded: nearly cospherical.
    Sphere = "sphere", |n, r| repeat(n, || on_sphere(r));
    /// Centers of disjoint unit balls, at distance above 2, in a cube of side 4 n^(1/3).
    Balls = "balls", balls;
    /// The cubic integer grid, in random order: every cell is cospherical.
    Grid3 = "grid3", grid;
    /// A hundred normal clusters.
    Clusters3 = "clusters3", |n, r| {
        let centers: Vec<Point3> = repeat(100, || [r.unit(), r.unit(), r.unit()]);
        repeat(n, || {
            let center = centers[r.below(100)];
            center.map(|x| x + 0.01 * r.normal())
        })
    };
    /// Ten horizontal layers of random points.
    Layers = "layers", |n, r| repeat(n, || [r.unit(), r.unit(), r.below(10) as f64 / 8.0]);
    /// On vertical lines over a small lattice: many collinear points.
    Lines = "lines", |n, r| repeat(n, || [r.below(5) as f64, r.below(5) as f64, r.below(n.max(1)) as f64]);
    /// Few different points, many times.
    Repeated = "repeated", |n, r| repeat(n, || [r.below(3) as f64, r.below(3) as f64, r.below(2) as f64]);
    /// In a slanted plane, exactly.
    Slanted = "slanted", |n, r| repeat(n, || {
        let (x, y) = (r.below(1 << 20) as f64, r.below(1 << 20) as f64);
        [x, y, 2.0 * x - y + 7.0]
    });
    /// A lattice in a slanted plane: cocircular too.
    SlantedGrid = "slanted-grid", |n, r| {
        let side = (n as f64).sqrt().ceil().max(1.0) as usize;
        let mut points: Vec<_> = (0..n).map(|i| [(i % side) as f64, (i / side) as f64, (i % side) as f64]).collect();
        r.shuffle(&mut points);
        points
    };
    /// On a slanted line, exactly.
    OnLine = "on-line", |n, r| repeat(n, || {
        let t = r.below(1 << 20) as f64;
        [t, 1.0 - 2.0 * t, 3.0 * t]
    });
    /// Nearly in a plane: heights of a few units in the last place.
    NearlyFlat = "nearly-flat", |n, r| repeat(n, || {
        let height = r.below(5) as f64;
        [r.unit(), r.unit(), 1.0 + height * f64::EPSILON]
    });
    /// Nearly on a line.
    NearlyLine = "nearly-line", |n, r| repeat(n, || {
        let t = r.unit();
        [t, t / 3.0, 0.1 - t]
    });
    /// On two circles in different planes that are linked: quadratically many tetrahedra.
    Linked = "linked", |n, r| (0..n).map(|i| {
        let angle = r.between(0.0, std::f64::consts::TAU);
        let (x, y) = (libm::cos(angle), libm::sin(angle));
        if i % 2 == 0 { [x, y, 0.0] } else { [1.0 + x, 0.0, y] }
    }).collect();
    /// Integers near 2^53 beside small ones.
    Far = "far", |n, r| repeat(n, || [0, 1, 2].map(|_| match r.below(3) {
        0 => 9_007_199_254_740_992.0 - r.below(4) as f64,
        1 => r.below(4) as f64,
        _ => r.unit(),
    }));
    /// Any magnitude that a double has, of either sign.
    HugeSpan3 = "huge-span3", |n, r| repeat(n, || [0, 1, 2].map(|_| any_magnitude(r)));
}

fn in_ball(random: &mut Random) -> Point3 {
    loop {
        let p = [0, 1, 2].map(|_| random.between(-1.0, 1.0));
        if p.iter().map(|x| x * x).sum::<f64>() <= 1.0 {
            return p;
        }
    }
}

fn on_sphere(random: &mut Random) -> Point3 {
    let p = in_ball(random);
    let size = p.iter().map(|x| x * x).sum::<f64>().sqrt();
    if size < 0.01 { on_sphere(random) } else { p.map(|x| x / size) }
}

fn any_magnitude(random: &mut Random) -> f64 {
    loop {
        let x = f64::from_bits(random.bits());
        if x.is_finite() {
            return x;
        }
    }
}

fn grid(n: usize, random: &mut Random) -> Vec<Point3> {
    let side = (1..=n).find(|side| side.pow(3) >= n).unwrap_or(1);
    let mut points: Vec<Point3> =
        (0..n).map(|i| [i % side, i / side % side, i / side / side].map(|x| x as f64)).collect();
    random.shuffle(&mut points);
    points
}

/// Rejects candidates that are too near to one before: those in the neighboring cells of a lattice.
fn balls(n: usize, random: &mut Random) -> Vec<Point3> {
    let side = 4.0 * libm::cbrt(n as f64).max(1.0);
    let cells = (side / 2.0).floor().max(1.0) as usize;
    let cell_of = |x: f64| ((x / side * cells as f64) as usize).min(cells - 1);
    let mut taken: Vec<Vec<Point3>> = vec![Vec::new(); cells.pow(3)];
    let mut points = Vec::with_capacity(n);
    while points.len() < n {
        let p = [0, 1, 2].map(|_| random.unit() * side);
        let [i, j, k] = p.map(cell_of);
        let around = |c: usize| c.saturating_sub(1)..=(c + 1).min(cells - 1);
        let free = around(i).all(|i| {
            around(j).all(|j| {
                around(k).all(|k| {
                    taken[(i * cells + j) * cells + k]
                        .iter()
                        .all(|q: &Point3| (0..3).map(|axis| (p[axis] - q[axis]).powi(2)).sum::<f64>() > 4.0)
                })
            })
        });
        if free {
            taken[(i * cells + j) * cells + k].push(p);
            points.push(p);
        }
    }
    points
}
