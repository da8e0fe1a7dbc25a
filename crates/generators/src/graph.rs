//! Named planar straight line graphs: points, and segments between them.

use std::f64::consts::TAU;

use crate::planar::short_segments;
use crate::{Point2, Random, Segments, repeat};

kinds! {
    /// A named family of points with segments between them. Unless it says so, segments meet in points only.
    Graph, parts -> Segments:
    /// Uniform points, and a tenth as many segments between near ones.
    PlanarSubset = "planar-subset", |n, r| {
        let points = repeat(n, || [r.unit(), r.unit()]);
        let segments = short_segments(&points, 1.0, n / 10, r);
        (points, segments)
    };
    /// A planar graph on an integer grid of at least 16 n places: some points are equal, some are on segments.
    PlanarGrid = "planar-grid", |n, r| {
        let side = (4.0 * (n as f64).sqrt()).ceil().max(1.0) as usize;
        let side = side.next_power_of_two();
        let points = repeat(n, || [r.below(side) as f64, r.below(side) as f64]);
        let segments = short_segments(&points, side as f64, n / 10, r);
        (points, segments)
    };
    /// Uniform points, and about sqrt(n) segments through all of the square.
    Long = "long", long;
    /// The snowflake of Koch, a polygon of 3 times a power of four corners.
    Koch = "koch", |n, _| polygon(koch(n));
    /// A polygon with n / 2 long teeth.
    Comb = "comb", |n, _| polygon(comb(n));
    /// A polygon around the origin with spikes of random lengths.
    Star = "star", |n, r| polygon(star(n, r));
    /// A polygon that winds around itself.
    Spiral = "spiral", |n, _| polygon(spiral(n));
    /// Squares in squares.
    Nested = "nested-squares", |n, _| nested(n);
    /// Segments through one point, which is the middle of each.
    Hub = "hub-segments", hub;
    /// The square integer grid with segments along its lines: through points, on one another, some without length.
    GridSegments = "grid-segments", grid_segments;
    /// Segments between random points of a small integer grid, which cross a lot.
    Crossing = "crossing", |n, r| {
        let side = 2 + (n as f64).sqrt() as usize;
        let points = repeat(n, || [r.below(side) as f64, r.below(side) as f64]);
        (points, (0..n / 2).map(|i| [2 * i, 2 * i + 1]).collect())
    };
}

impl Graph {
    /// Whether no two segments cross but at points of the set.
    pub fn is_planar(self) -> bool {
        self != Self::Crossing
    }

    /// Whether it is one ring of segments, point by point, which does not meet itself.
    pub fn is_polygon(self) -> bool {
        matches!(self, Self::Koch | Self::Comb | Self::Star | Self::Spiral)
    }
}

fn polygon(points: Vec<Point2>) -> Segments {
    let n = points.len();
    (points, (0..n).map(|i| [i, (i + 1) % n]).collect())
}

/// In each of the strips that the square is cut into a segment from its leftmost to its rightmost point.
fn long(n: usize, random: &mut Random) -> Segments {
    let points: Vec<Point2> = repeat(n, || [random.unit(), random.unit()]);
    let strips = (n as f64).sqrt() as usize;
    let mut ends: Vec<Option<[usize; 2]>> = vec![None; strips];
    for (i, p) in points.iter().enumerate() {
        let [left, right] = ends[(p[1] * strips as f64) as usize].get_or_insert([i, i]);
        if p[0] < points[*left][0] {
            *left = i;
        }
        if p[0] > points[*right][0] {
            *right = i;
        }
    }
    let mut segments: Vec<[usize; 2]> =
        ends.into_iter().flatten().filter(|[left, right]| left != right).collect();
    random.shuffle(&mut segments);
    (points, segments)
}

/// With as many corners as are nearest to n by ratio.
fn koch(n: usize) -> Vec<Point2> {
    let half = 3_f64.sqrt() / 2.0;
    let mut ring = vec![[0.0, 0.0], [0.5, half], [1.0, 0.0]];
    while ring.len() * 2 < n {
        let next = |i: usize| ring[(i + 1) % ring.len()];
        let bent = |(i, &[px, py]): (usize, &Point2)| {
            let [u, v] = [(next(i)[0] - px) / 3.0, (next(i)[1] - py) / 3.0];
            // The corner of the equilateral triangle on the middle third, on the left of the way.
            let tip = [px + 1.5 * u - half * v, py + 1.5 * v + half * u];
            [[px, py], [px + u, py + v], tip, [px + 2.0 * u, py + 2.0 * v]]
        };
        ring = ring.iter().enumerate().flat_map(bent).collect();
    }
    ring.reverse();
    ring
}

fn comb(n: usize) -> Vec<Point2> {
    let zigzag = n.max(4) - 2;
    let height = zigzag as f64;
    let tooth = |i: usize| [i as f64, if i.is_multiple_of(2) { 0.0 } else { height }];
    [[0.0, -1.0], [(zigzag - 1) as f64, -1.0]].into_iter().chain((0..zigzag).rev().map(tooth)).collect()
}

fn star(n: usize, random: &mut Random) -> Vec<Point2> {
    let n = n.max(6);
    let corner = |i: usize| {
        let radius = if i.is_multiple_of(2) { random.between(0.5, 1.0) } else { random.between(0.01, 0.1) };
        let (sin, cos) = libm::sincos(TAU * i as f64 / n as f64);
        [radius * cos, radius * sin]
    };
    (0..n).map(corner).collect()
}

/// Two arms half a turn's distance apart, in so many steps a turn that chords keep clear of the other arm.
fn spiral(n: usize) -> Vec<Point2> {
    let arm = n.max(6) / 2;
    let steps = libm::cbrt(30.0 * arm as f64).ceil().max(8.0);
    let point = |i: usize, more: f64| {
        let turns = i as f64 / steps;
        let (sin, cos) = libm::sincos(TAU * turns);
        [(1.0 + turns + more) * cos, (1.0 + turns + more) * sin]
    };
    let outer = (0..arm).map(|i| point(i, 0.5));
    outer.chain((0..arm).rev().map(|i| point(i, 0.0))).collect()
}

fn nested(n: usize) -> Segments {
    let square = |i: usize| {
        let x = (i + 1) as f64;
        [[-x, -x], [x, -x], [x, x], [-x, x]]
    };
    let squares = n.div_ceil(4);
    let ring = |i: usize| (0..4).map(move |k| [4 * i + k, 4 * i + (k + 1) % 4]);
    ((0..squares).flat_map(square).collect(), (0..squares).flat_map(ring).collect())
}

fn hub(n: usize, random: &mut Random) -> Segments {
    let pairs = n.saturating_sub(1) / 2;
    let mut points = vec![[0.0, 0.0]];
    for _ in 0..pairs {
        let p = [0, 1].map(|_| random.below(1 << 21) as f64 - f64::from(1 << 20));
        points.extend([p, p.map(|x| -x)]);
    }
    (points, (0..pairs).map(|i| [2 * i + 1, 2 * i + 2]).collect())
}

/// Along rows, columns and the rising diagonals, which meet in points of the grid only.
fn grid_segments(n: usize, random: &mut Random) -> Segments {
    let side = (n as f64).sqrt().ceil().max(1.0) as usize;
    let points = (0..side * side).map(|i| [(i % side) as f64, (i / side) as f64]).collect();
    let mut segment = || {
        let from = [random.below(side), random.below(side)];
        let step = [[1, 0], [0, 1], [1, 1]][random.below(3)];
        let room = |k: usize| if step[k] == 1 { side - 1 - from[k] } else { side };
        let length = random.below(12).min(room(0)).min(room(1));
        let to = [0, 1].map(|k| from[k] + length * step[k]);
        let mut ends = [from, to].map(|[x, y]| y * side + x);
        if random.below(2) == 0 {
            ends.reverse();
        }
        ends
    };
    let segments = repeat(n / 2, &mut segment);
    (points, segments)
}

#[cfg(test)]
mod tests {
    use delone_oracle::crossings::{Split, crossing_pairs};

    use super::Graph;

    #[test]
    fn every_graph_gives_about_what_was_asked() {
        for &graph in Graph::ALL {
            let name = graph.name();
            assert_eq!(Graph::named(name), Some(graph));
            for n in [0, 1, 2, 3, 4, 5, 11, 1000] {
                let (points, segments) = graph.parts(n, 7);
                let most = if graph == Graph::Koch { 2 * n } else { n + 63 };
                assert!((n / 2..=most.max(6)).contains(&points.len()), "{name}: {} of {n}", points.len());
                assert!(points.iter().flatten().all(|x| x.is_finite()), "{name}");
                assert!(segments.iter().flatten().all(|&i| i < points.len()), "{name}");
                assert!(n < 1000 || segments.len() >= 31, "{name}: {} segments", segments.len());
                assert_eq!((points, segments), graph.parts(n, 7), "{name}");
            }
        }
    }

    #[test]
    fn segments_cross_only_where_that_is_said() {
        for &graph in Graph::ALL {
            for n in [5, 20, 100, 400] {
                let (points, segments) = graph.parts(n, 3);
                let crossings = crossing_pairs(&points, &segments).len();
                assert_eq!(crossings == 0, graph.is_planar() || n < 20, "{} {n}", graph.name());
            }
        }
    }

    #[test]
    fn polygons_do_not_meet_themselves() {
        for &graph in Graph::ALL.iter().filter(|graph| graph.is_polygon()) {
            for n in [3, 6, 48, 150, 400] {
                let (points, segments) = graph.parts(n, 3);
                let chains = Split::new(&points, &segments).chains;
                assert!(chains.iter().all(|chain| chain.len() == 2), "{} {n}", graph.name());
                assert_eq!(segments.len(), points.len());
                let cross = |&[i, j]: &[usize; 2]| points[i][0] * points[j][1] - points[i][1] * points[j][0];
                let area = segments.iter().map(cross).sum::<f64>();
                assert!(area > 0.0, "{} {n} is not counter-clockwise", graph.name());
            }
        }
    }

    /// A change of any generator is a change of everybody's data.
    #[test]
    fn bits_are_fixed() {
        let hash = |graph: Graph| {
            let (points, segments) = graph.parts(200, 42);
            let bits = points.into_iter().flatten().map(f64::to_bits);
            let bits = bits.chain(segments.into_iter().flatten().map(|i| i as u64));
            bits.fold(0_u64, |h, b| (h ^ b).wrapping_mul(0x0100_0000_01b3).rotate_left(23))
        };
        let found: String =
            Graph::ALL.iter().map(|&graph| format!("{} {:016x}\n", graph.name(), hash(graph))).collect();
        assert_eq!(found, include_str!("graphs.txt"));
    }
}
