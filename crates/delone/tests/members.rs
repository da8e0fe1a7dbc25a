//! Polygons as regions, against rectangles that are counted.

use delone::{Constrained2, Crossings, Fill, Refinement};
use delone_generators::Random;

/// A rectangle with a hole or without: its rings as corners that are whole numbers.
type Polygon = Vec<[[i32; 2]; 2]>;

fn polygons(random: &mut Random) -> Vec<Polygon> {
    let mut side = |low: i32, high: i32| {
        let mut ends = [0, 0];
        while ends[0] == ends[1] {
            ends = [0, 0].map(|_| low + (random.below((high - low + 1) as usize) as i32));
        }
        [ends[0].min(ends[1]), ends[0].max(ends[1])]
    };
    let count = side(1, 7)[0];
    let polygon = |_| {
        let (x, y) = (side(0, 9), side(0, 9));
        let outer = [[x[0], y[0]], [x[1], y[1]]];
        if x[1] - x[0] < 3 || y[1] - y[0] < 3 {
            return vec![outer];
        }
        let (x, y) = (side(x[0], x[1]), side(y[0], y[1]));
        vec![outer, [[x[0], y[0]], [x[1], y[1]]]]
    };
    (0..count).map(polygon).collect()
}

/// Points, segments, and the polygon of each segment.
fn graph(polygons: &[Polygon]) -> (Vec<[f64; 2]>, Vec<[usize; 2]>, Vec<usize>) {
    let (mut points, mut segments, mut of) = (Vec::new(), Vec::new(), Vec::new());
    for (i, ring) in
        polygons.iter().enumerate().flat_map(|(i, rings)| rings.iter().map(move |ring| (i, ring)))
    {
        let [[x0, y0], [x1, y1]] = ring.map(|p| p.map(f64::from));
        let first = points.len();
        points.extend([[x0, y0], [x1, y0], [x1, y1], [x0, y1]]);
        segments.extend([0, 1, 2, 3].map(|k| [first + k, first + (k + 1) % 4]));
        of.extend([i; 4]);
    }
    (points, segments, of)
}

/// The last polygon that has a place strictly inside, by the parity of its rings.
fn last(polygons: &[Polygon], [x, y]: [f64; 2]) -> Option<usize> {
    let is_in = |ring: &[[i32; 2]; 2]| {
        let [[x0, y0], [x1, y1]] = ring.map(|p| p.map(f64::from));
        x0 < x && x < x1 && y0 < y && y < y1
    };
    polygons.iter().rposition(|rings| rings.iter().filter(|ring| is_in(ring)).count() % 2 == 1)
}

fn middle(c: &Constrained2, corners: [delone::VertexId; 3]) -> [f64; 2] {
    let places = corners.map(|v| c.point(v));
    [0, 1].map(|k| places.iter().map(|p| p[k] / 3.0).sum())
}

#[test]
fn parts_are_in_the_last_polygon_around_them() {
    let mut random = Random::new(53);
    for _ in 0..300 {
        let polygons = polygons(&mut random);
        let (points, segments, of) = graph(&polygons);
        let mut c = Constrained2::with_crossings(&points, &segments, Crossings::Split).expect("a graph");
        let mut domains = c.domains(&Fill::All).expect("domains");
        let attributes: Vec<f64> = (0..polygons.len()).map(|i| i as f64 + 0.5).collect();
        c.claim_polygons(&mut domains, |s| Some(of[s.index()]), &attributes);
        for t in c.triangle_ids() {
            let expected = last(&polygons, middle(&c, c.mesh().corners(t)));
            assert_eq!(domains.region(t), expected, "{polygons:?}");
            assert_eq!(domains.attribute(t), expected.map(|i| attributes[i]));
        }
        // New vertices of a mesh are in the region that they are in.
        let fill = Fill::Parts(&domains);
        let refined = Refinement::new().fill(fill).run(&mut c).expect("refined");
        for t in c.triangle_ids() {
            let expected = last(&polygons, middle(&c, c.mesh().corners(t)));
            assert_eq!(refined.domains.region(t), expected, "{polygons:?}");
        }
    }
}

#[test]
fn lines_and_open_rings_are_no_polygons() {
    let points = [[0, 0], [4, 0], [4, 4], [0, 4], [2, 0], [2, 4]];
    let segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5]];
    let c = Constrained2::from_parts(&points, &segments).expect("a square and a line");
    let mut domains = c.domains(&Fill::All).expect("domains");
    c.claim_polygons(&mut domains, |s| (s.index() < 4).then_some(0), &[7.0]);
    assert!(c.triangle_ids().all(|t| domains.attribute(t) == Some(7.0)));
    c.claim_polygons(&mut domains, |_| None, &[]);
    assert!(c.triangle_ids().all(|t| domains.region(t).is_none()));
    let empty = Constrained2::new();
    let mut domains = empty.domains(&Fill::All).expect("nothing");
    empty.claim_polygons(&mut domains, |_| None, &[]);
}
