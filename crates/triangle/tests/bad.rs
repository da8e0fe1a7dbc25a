//! Bad input is named, and nothing is touched.

use std::ffi::{CStr, c_int};
use std::ptr::{null, null_mut};

use delone_triangle::{TriangulateIo, delone_tri_last_error, delone_triangulate, triangulate};

use super::client::{Given, frame, unwritten};

/// The status of a call with a structure as it is, and its words.
fn status(io: &TriangulateIo, switches: &CStr) -> (c_int, String) {
    let mut out = unwritten();
    // SAFETY: lists are as long as counts say, or NULL.
    let status = unsafe {
        delone_triangulate(switches.as_ptr(), io, &raw mut out, null_mut(), None, null_mut(), null_mut())
    };
    assert!(status == 0 || (out.numberofpoints, out.numberoftriangles, out.numberofedges) == (0, 0, 0));
    assert!(out.pointlist as usize == usize::MAX && out.trianglelist as usize == usize::MAX);
    // SAFETY: the words end with a zero.
    let words = unsafe { CStr::from_ptr(delone_tri_last_error()) };
    (status, words.to_string_lossy().into_owned())
}

#[test]
fn lists_and_counts_that_do_not_fit() {
    type Change = fn(&mut TriangulateIo);
    let cases: [(&CStr, Change, &str); 16] = [
        (c"pz", |io| io.numberofpoints = -1, "numberofpoints is -1"),
        (c"pz", |io| io.numberofpoints = 2, "numberofpoints is 2"),
        (c"pz", |io| io.pointlist = null_mut(), "pointlist is NULL"),
        (c"pz", |io| io.numberofpointattributes = -3, "numberofpointattributes is -3"),
        (c"pz", |io| io.numberofpointattributes = 1, "pointattributelist is NULL"),
        (c"pz", |io| io.numberofpointattributes = c_int::MAX, "pointattributelist is NULL"),
        (c"pz", |io| io.numberofsegments = c_int::MIN, "numberofsegments is -2147483648"),
        (c"pz", |io| io.segmentlist = null_mut(), "segmentlist is NULL"),
        (c"pz", |io| io.numberofholes = -1, "numberofholes is -1"),
        (c"pz", |io| io.holelist = null_mut(), "holelist is NULL"),
        (c"pz", |io| io.numberofregions = 2, "regionlist is NULL"),
        (c"rz", |io| io.numberoftriangles = -1, "numberoftriangles is -1"),
        (c"rz", |io| io.numberofcorners = -6, "numberofcorners is -6"),
        (c"rz", |io| io.trianglelist = null_mut(), "trianglelist is NULL"),
        (c"rz", |io| io.numberoftriangleattributes = 1, "triangleattributelist is NULL"),
        (c"rz", |io| io.numberoftriangleattributes = -1, "numberoftriangleattributes is -1"),
    ];
    let given = Given { triangles: vec![[0, 1, 4]], ..frame() };
    for (switches, change, words) in cases {
        let mut io = given.io(switches.to_str().expect("ASCII"));
        change(&mut io);
        let (status, said) = status(&io, switches);
        assert!(status == 1 && said.starts_with(words), "{status} {said}");
    }
}

#[test]
fn numbers_that_are_none_and_indices_out_of_range() {
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for switches in ["zQ", "zpQ", "zpqQ", "zq", "zprQ"] {
            let mut given = Given { triangles: vec![[0, 1, 4]], ..frame() };
            given.points[6][1] = wrong;
            let (status, index, words) = given.run(switches).expect_err("not finite");
            assert!((status, index) == (2, 6) && words.contains("point 6"), "{words}");
        }
        let given = Given { holes: vec![[4.0, 4.0], [wrong, 0.0]], ..frame() };
        assert_eq!(given.run("zpQ").expect_err("a hole").1, 1);
        let given = Given { regions: vec![[0.0, wrong, 1.0, 1.0]], ..frame() };
        assert_eq!(given.run("zpQ").expect_err("a region").1, 0);
    }
    for wrong in [-1, 8, c_int::MIN, c_int::MAX] {
        let mut given = frame();
        given.segments[5][1] = wrong;
        let (status, index, words) = given.run("zpQ").expect_err("an index");
        assert!((status, index) == (4, 5) && words.contains(&wrong.to_string()), "{words}");
        let given = Given { triangles: vec![[0, 1, 4], [1, wrong, 4]], ..frame() };
        assert_eq!(given.run("zrQ").expect_err("an index").0, 4);
    }
    // Counted from one there is no 0.
    assert_eq!(frame().run("pQ").expect_err("from one").0, 4);
}

#[test]
fn meshes_that_are_none() {
    for (triangles, row) in [
        (vec![[0, 1, 2], [0, 1, 3]], 1),
        (vec![[0, 1, 1]], 0),
        (vec![[0, 4, 3], [0, 5, 3]], 1),
        (vec![[4, 5, 6], [0, 6, 2]], 1),
        (vec![[0, 1, 2], [1, 2, 0]], 1),
        (vec![[0, 1, 2], [4, 5, 6]], 0),
    ] {
        let given = Given { triangles, ..frame() };
        let (status, index, words) = given.run("zrQ").expect_err("no mesh");
        assert!((status, index) == (1, row) && !words.is_empty(), "{status} {index} {words}");
    }
}

#[test]
fn pointers_that_are_missing() {
    let io = frame().io("zQ");
    let mut out = unwritten();
    let errors = |switches: *const std::ffi::c_char, input: *const TriangulateIo, out: *mut TriangulateIo| {
        // SAFETY: what is not NULL is readable.
        unsafe { delone_triangulate(switches, input, out, null_mut(), None, null_mut(), null_mut()) }
    };
    assert_eq!(errors(null(), &raw const io, &raw mut out), 1);
    assert_eq!(errors(c"zQ".as_ptr(), null(), &raw mut out), 1);
    assert_eq!(errors(c"zQ".as_ptr(), &raw const io, null_mut()), 1);
    assert_eq!(errors(c"zvQ".as_ptr(), &raw const io, &raw mut out), 1);
    assert_eq!(errors(c"zuQ".as_ptr(), &raw const io, &raw mut out), 1);
    assert_eq!(out.numberofpoints, 0);
}

#[test]
fn results_may_be_where_the_input_is() {
    let mut given = frame();
    let points = given.points.clone();
    given.points.resize(500, [f64::NAN; 2]);
    let mut io = given.io("zpq30Q");
    io.numberofpoints = 8;
    let mut out = unwritten();
    (out.pointlist, out.pointmarkerlist, out.trianglelist) = (io.pointlist, null_mut(), null_mut());
    (out.segmentlist, out.segmentmarkerlist) = (null_mut(), null_mut());
    let switches = c"zpq30Q".as_ptr().cast_mut();
    // SAFETY: the list of points has room for 500.
    let status = unsafe { triangulate(switches, &raw mut io, &raw mut out, null_mut()) };
    assert_eq!((status, out.pointlist), (0, io.pointlist));
    let count = usize::try_from(out.numberofpoints).expect("positive");
    assert!(count > 8 && count < 500);
    assert_eq!(given.points[..8], points);
    assert!(given.points[..count].iter().flatten().all(|x| x.is_finite()) && given.points[count][0].is_nan());
    for list in [out.pointmarkerlist, out.trianglelist, out.segmentlist, out.segmentmarkerlist] {
        // SAFETY: it is of malloc.
        unsafe { delone_triangle::trifree(list.cast()) };
    }
}

#[test]
fn an_area_for_which_there_is_no_memory() {
    let (status, _, words) = frame().run("zpa0.0000000000001Q").expect_err("no memory");
    assert!([1, 6].contains(&status) && !words.is_empty(), "{status} {words}");
}
