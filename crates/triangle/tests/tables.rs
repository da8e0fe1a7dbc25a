//! Each switch on small inputs, where the answer is known.

use delone_generators::Random;

use super::client::{Given, area, frame};

/// A square with its center.
fn pyramid() -> Given {
    Given {
        points: vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [2.0, 2.0]],
        attributes: vec![0.0, 4.0, 8.0, 4.0, 9.0],
        markers: vec![0, 0, 3, 0, 0],
        ..Given::default()
    }
}

#[test]
fn points_alone() {
    let got = pyramid().run("zQ").expect("good");
    assert_eq!((got.counts, got.corners.len()), ([5, 4, 4, 8, 0, 0], 4));
    assert_eq!((&got.points, &got.attributes), (&pyramid().points, &pyramid().attributes));
    assert_eq!(got.markers, [1, 1, 3, 1, 0]);
    assert!(got.corners.iter().all(|corners| corners.contains(&4) && area(&got.points, corners) == 4.0));
    assert!(got.segments.is_empty() && got.edges.is_empty() && got.neighbors.is_empty());
    // From one.
    let one = pyramid().run("Q").expect("good");
    let lower = |corners: &Vec<i32>| corners.iter().map(|v| v - 1).collect::<Vec<_>>();
    assert_eq!(one.corners.iter().map(lower).collect::<Vec<_>>(), got.corners);
}

#[test]
fn neighbors_are_opposite_to_corners() {
    for base in [0, 1] {
        let got = pyramid().run(if base == 0 { "znQ" } else { "nQ" }).expect("good");
        for (row, (corners, neighbors)) in (base..).zip(got.corners.iter().zip(&got.neighbors)) {
            for k in 0..3 {
                let shared = [corners[(k + 1) % 3], corners[(k + 2) % 3]];
                let is_hull = !shared.contains(&(4 + base));
                assert_eq!(neighbors[k] == -1, is_hull);
                if !is_hull {
                    let other = usize::try_from(neighbors[k] - base).expect("a row");
                    assert!(shared.iter().all(|v| got.corners[other].contains(v)));
                    assert!(got.neighbors[other].contains(&row));
                }
            }
        }
    }
}

#[test]
fn edges_and_hulls_have_markers() {
    let got = pyramid().run("zecQ").expect("good");
    assert_eq!((got.edges.len(), got.segments.len()), (8, 4));
    assert_eq!(got.segment_markers, [1; 4]);
    let is_hull = |edge: &[i32; 2]| !edge.contains(&4);
    assert!(got.edges.iter().zip(&got.edge_markers).all(|(edge, &marker)| (marker == 1) == is_hull(edge)));
    let bare = pyramid().run("zecQB").expect("good");
    assert!(bare.edge_markers.is_empty() && bare.segment_markers.is_empty() && bare.markers.is_empty());
    assert_eq!((bare.edges, bare.segments), (got.edges, got.segments));
}

#[test]
fn what_is_left_out_is_counted_all_the_same() {
    let all = frame().run("zpenQ").expect("good");
    let none = frame().run("zpQNEP").expect("good");
    assert_eq!(none.counts[..4], all.counts[..4]);
    assert_eq!((all.counts[4], none.counts[4]), (1, 0));
    assert!(none.points.is_empty() && none.corners.is_empty() && none.segments.is_empty());
    assert!(none.markers.is_empty());
}

#[test]
fn middles_of_edges() {
    let got = pyramid().run("zo2eQ").expect("good");
    assert_eq!((got.points.len(), got.attributes.len(), got.markers.len()), (13, 13, 13));
    for corners in &got.corners {
        for k in 0..3 {
            let [p, q, middle] = [(k + 1) % 3, (k + 2) % 3, k + 3].map(|k| corners[k] as usize);
            assert_eq!(got.points[middle], [0, 1].map(|k| f64::midpoint(got.points[p][k], got.points[q][k])));
            assert_eq!(got.attributes[middle], f64::midpoint(got.attributes[p], got.attributes[q]));
        }
    }
    assert_eq!(got.markers[5..], got.edge_markers);
}

#[test]
fn voronoi_diagrams() {
    let [got, diagram] = pyramid().run_with("zevQ", None, std::ptr::null_mut()).expect("good");
    assert_eq!((diagram.points.len(), diagram.edges.len()), (4, 8));
    let mut centers = diagram.points.clone();
    centers.sort_by(|p, q| p.partial_cmp(q).expect("finite"));
    assert_eq!(centers, [[0.0, 2.0], [2.0, 0.0], [2.0, 4.0], [4.0, 2.0]]);
    for (k, (edge, dual)) in got.edges.iter().zip(&diagram.edges).enumerate() {
        let norm = diagram.norms[k];
        assert_eq!(dual[1] == -1, got.edge_markers[k] == 1);
        if dual[1] == -1 {
            let [p, q] = edge.map(|v| got.points[v as usize]);
            // Away from the center of the square.
            let middle = [f64::midpoint(p[0], q[0]) - 2.0, f64::midpoint(p[1], q[1]) - 2.0];
            assert_eq!(norm, middle.map(|x| 2.0 * x));
        } else {
            assert_eq!(norm, [0.0, 0.0]);
        }
    }
}

#[test]
fn points_that_are_no_corner_are_left_out() {
    let mut given = pyramid();
    given.points.insert(1, [0.0, 0.0]);
    given.attributes.insert(1, 1.0);
    given.markers.insert(1, 7);
    let all = given.run("zQ").expect("good");
    assert_eq!((all.points.len(), all.corners.len()), (6, 4));
    let got = given.run("zjenQ").expect("good");
    assert_eq!((got.points, got.attributes), (pyramid().points, pyramid().attributes));
    assert_eq!(got.markers, [1, 1, 3, 1, 0]);
    assert!(got.corners.iter().flatten().all(|v| (0..5).contains(v)));
    let mut edges: Vec<_> = got.edges.iter().map(|&[v, w]| [v.min(w), v.max(w)]).collect();
    edges.sort_unstable();
    edges.dedup();
    assert_eq!((edges.len(), edges.iter().flatten().max()), (8, Some(&4)));
}

#[test]
fn segments_holes_and_regions() {
    let mut given = frame();
    let whole = given.run("zpQO").expect("good");
    assert_eq!(whole.corners.len(), 10);
    let got = given.run("zpeQ").expect("good");
    assert_eq!(got.counts, [8, 8, 8, 16, 1, 0]);
    // A side without a marker is a border, and has 1.
    let mut sides: Vec<_> = got.segments.iter().copied().zip(got.segment_markers.iter().copied()).collect();
    sides.sort_unstable();
    let expected = [5, 6, 7, 8, 1, 1, 9, 1];
    assert_eq!(sides, given.segments.iter().copied().zip(expected).collect::<Vec<_>>());
    assert_eq!(got.markers, [5, 5, 6, 7, 1, 1, 9, 9]);
    // A region on a corner of the hole, and one outside, which does not count.
    given.regions = vec![[99.0, 0.0, 1.0, 0.5], [3.0, 3.0, 2.5, 0.5]];
    let got = given.run("zpAaQ").expect("good");
    assert_eq!(got.triangle_attributes, vec![2.5; got.corners.len()]);
    assert!(got.corners.iter().all(|corners| area(&got.points, corners) <= 0.5));
    let sum: f64 = got.corners.iter().map(|corners| area(&got.points, corners)).sum();
    assert!((sum - 60.0).abs() < 1e-9);
    // Without a region triangles have no attribute.
    assert!(frame().run("zpAQ").expect("good").triangle_attributes.is_empty());
    // Of two regions in one part the last one counts; a hole on its side takes one of the parts.
    given.regions = vec![[1.0, 1.0, 2.5, -1.0], [1.0, 2.0, 3.5, -1.0]];
    assert_eq!(given.run("zpAQ").expect("good").triangle_attributes, [3.5; 8]);
    given.holes = vec![[4.0, 3.0]];
    let sum = |got: &super::client::Got| got.corners.iter().map(|c| area(&got.points, c)).sum::<f64>();
    assert!([4.0, 60.0].contains(&sum(&given.run("zpQ").expect("accepted"))));
}

#[test]
fn bays_stay_with_c() {
    let mut given = pyramid();
    given.segments = vec![[0, 1], [1, 2], [2, 4], [4, 3], [3, 0]];
    given.markers.clear();
    assert_eq!(given.run("zpQ").expect("good").corners.len(), 3);
    let whole = given.run("zpcQ").expect("good");
    assert_eq!((whole.corners.len(), whole.segments.len()), (4, 6));
}

#[test]
fn segments_that_cross_or_have_no_length() {
    let given = Given {
        points: vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]],
        attributes: vec![0.0, 1.0, 4.0, 3.0],
        segments: vec![[0, 2], [1, 3], [1, 1], [0, 1], [1, 2], [2, 3], [3, 0], [0, 2]],
        ..Given::default()
    };
    let got = given.run("zpQ").expect("good");
    assert_eq!((got.points.len(), got.corners.len(), got.segments.len()), (5, 4, 8));
    assert_eq!((got.points[4], got.attributes[4]), ([2.0, 2.0], 2.0));
}

/// Any switches give a triangulation that fits together, or an error.
#[test]
fn random_switches() {
    let mut random = Random::new(5);
    let mut good = 0;
    for _ in 0..600 {
        let mut switches = String::from("z");
        for _ in 0..=(12.0 * random.unit()) as usize {
            let letters = "pppraqADcenvjO2oBNEPYSQ123.{} ";
            switches.extend(letters.chars().nth((letters.len() as f64 * random.unit()) as usize));
        }
        switches.push_str("S20");
        let mut given = Given { regions: vec![[1.0, 1.0, 2.0, 0.5]], ..frame() };
        given.attributes = given.points.iter().map(|p| p[0]).collect();
        let first = given.run("zpQ").expect("good");
        given.triangles = first.corners.iter().map(|c| [c[0], c[1], c[2]]).collect();
        given.areas = vec![0.7; given.triangles.len()];
        match given.run_with(&switches, None, std::ptr::null_mut()) {
            Err((status, _, words)) => {
                assert!(status == 1 && words.starts_with("switch"), "{switches}: {words}");
            }
            Ok([got, diagram]) => {
                good += 1;
                let [points, triangles, _, edges, ..] = got.counts;
                let rows =
                    |list: &[[i32; 2]], below: i32| list.iter().flatten().all(|v| (-1..below).contains(v));
                assert!(got.corners.iter().flatten().all(|v| (0..points).contains(v)), "{switches}");
                assert!(rows(&got.edges, points) && rows(&got.segments, points), "{switches}");
                assert!(
                    diagram.counts[0] == 0 || (diagram.counts[0], diagram.counts[3]) == (triangles, edges)
                );
                assert!(rows(&diagram.edges, triangles), "{switches}");
                if !got.points.is_empty() {
                    assert!(got.corners.iter().all(|corners| area(&got.points, corners) > 0.0), "{switches}");
                }
            }
        }
    }
    assert!(good > 400, "{good}");
}
