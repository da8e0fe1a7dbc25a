//! Switches that add vertices, and meshes that are refined again.

use std::cell::Cell;
use std::ffi::{c_int, c_void};
use std::ptr::null_mut;
use std::thread::ThreadId;

use super::client::{Given, Got, area, frame};

fn largest(got: &Got) -> f64 {
    got.corners.iter().map(|corners| area(&got.points, corners)).fold(0.0, f64::max)
}

fn sharpest(got: &Got) -> f64 {
    let angle = |corners: &Vec<c_int>, k: usize| {
        let [o, p, q] = [0, 1, 2].map(|j| got.points[corners[(k + j) % 3] as usize]);
        let [a, b] = [p, q].map(|r| (r[1] - o[1]).atan2(r[0] - o[0]).to_degrees());
        (b - a).rem_euclid(360.0)
    };
    got.corners.iter().flat_map(|corners| (0..3).map(move |k| angle(corners, k))).fold(180.0, f64::min)
}

#[test]
fn bounds_hold() {
    let got = frame().run("zpq30a0.3Q").expect("good");
    assert!(largest(&got) <= 0.3 && sharpest(&got) > 29.999);
    assert!(sharpest(&frame().run("zpq30Q").expect("good")) > 29.999);
    let bounded = frame().run("zpa0.001S17Q").expect("good");
    assert_eq!(bounded.points.len(), 8 + 17);
    let kept = frame().run("zpa0.3YQ").expect("good");
    assert!(kept.segments.len() == 8 && kept.points.len() > 20);
    // Attributes of new points are linear.
    let mut given = frame();
    given.attributes = given.points.iter().flat_map(|[x, y]| [*x, 2.0 - y]).collect();
    let got = given.run("zpq30a0.3Q").expect("good");
    for (p, values) in got.points.iter().zip(got.attributes.chunks(2)) {
        assert!((p[0] - values[0]).abs() < 1e-12 && (2.0 - p[1] - values[1]).abs() < 1e-12);
    }
}

#[test]
fn meshes_are_refined_again() {
    let first = frame().run("zpq30a2Q").expect("good");
    let mut given = Given {
        points: first.points.clone(),
        markers: first.markers.clone(),
        segments: first.segments.clone(),
        segment_markers: first.segment_markers.clone(),
        triangles: first.corners.iter().map(|c| [c[0], c[1], c[2]]).collect(),
        triangle_attributes: (0..first.corners.len()).map(|row| row as f64).collect(),
        ..Given::default()
    };
    let sorted = |got: &Got| {
        let mut rows: Vec<Vec<c_int>> = got.corners.clone();
        for row in &mut rows {
            let least = (0..3).min_by_key(|&k| row[k]).expect("three");
            row.rotate_left(least);
        }
        rows.sort_unstable();
        rows
    };
    // Nothing is to be done.
    let same = given.run("zprQ").expect("good");
    assert_eq!((sorted(&same), &same.points), (sorted(&first), &first.points));
    assert_eq!(given.run("zrQ").expect("good").corners.len(), first.corners.len());
    // Clockwise triangles are the same mesh.
    let mut turned = given.clone();
    turned.triangles.iter_mut().for_each(|corners| corners.swap(0, 1));
    assert_eq!(sorted(&turned.run("zprQ").expect("good")), sorted(&first));
    // Areas hold for places, and attributes go on.
    given.areas = (0..first.corners.len()).map(|row| if row == 0 { 0.01 } else { -1.0 }).collect();
    let finer = given.run("zpraqQ").expect("good");
    assert!(finer.corners.len() > first.corners.len() + 20);
    let old = area(&first.points, &first.corners[0]);
    let inside = |row: &usize| finer.triangle_attributes[*row] == 0.0;
    let new: Vec<f64> =
        (0..finer.corners.len()).filter(inside).map(|row| area(&finer.points, &finer.corners[row])).collect();
    assert!(new.iter().all(|&area| area <= 0.01) && (new.iter().sum::<f64>() - old).abs() < 0.1 * old);
    // As many as nobody wants are refused, unless there is a bound.
    given.areas[0] = 1e-12;
    let (status, _, words) = given.run("zpraQ").expect_err("too many");
    assert!(status == 5 && words.contains("switch S"), "{words}");
    assert_eq!(given.run("zpraS50Q").expect("a bound").points.len(), first.points.len() + 50);
}

/// The state of a test of triangles.
struct Calls {
    thread: ThreadId,
    count: Cell<usize>,
}

unsafe extern "C" fn is_large(
    a: *const f64,
    b: *const f64,
    c: *const f64,
    area: f64,
    user: *mut c_void,
) -> c_int {
    // SAFETY: corners are two numbers each, and the user's pointer is of the test.
    let ([ax, ay], [bx, by], [cx, cy], calls) = unsafe {
        (*a.cast::<[f64; 2]>(), *b.cast::<[f64; 2]>(), *c.cast::<[f64; 2]>(), &*user.cast::<Calls>())
    };
    calls.count.set(calls.count.get() + 1);
    let own = ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2.0;
    let is_right = calls.thread == std::thread::current().id() && (own - area).abs() <= 1e-9 * area;
    // A wrong one is never content.
    c_int::from(area > 0.2 || !is_right)
}

unsafe extern "C" fn always(_: *const f64, _: *const f64, _: *const f64, _: f64, _: *mut c_void) -> c_int {
    1
}

#[test]
fn functions_refuse_triangles_on_the_thread_of_the_call() {
    let calls = Calls { thread: std::thread::current().id(), count: Cell::new(0) };
    let user = (&raw const calls).cast_mut().cast();
    let [got, _] = frame().run_with("zpuQ", Some(is_large), user).expect("good");
    assert!(largest(&got) <= 0.2 && calls.count.get() >= got.corners.len());
    // Without the switch nobody is asked.
    let before = calls.count.get();
    frame().run_with("zpQ", Some(is_large), user).expect("good");
    assert_eq!(calls.count.get(), before);
}

#[test]
#[ignore = "long: .ci/run --long"]
fn functions_that_are_never_content_end_in_an_error() {
    let (status, _, words) = frame().run_with("zpuQ", Some(always), null_mut()).expect_err("too many");
    assert!(status == 5, "{words}");
}

#[test]
fn functions_that_are_never_content_have_a_bound() {
    let [got, _] = frame().run_with("zpuS100Q", Some(always), null_mut()).expect("good");
    assert_eq!(got.points.len(), 108);
}
