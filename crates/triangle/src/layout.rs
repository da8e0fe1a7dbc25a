//! The structures of the header, field by field.

use std::ffi::{c_char, c_int, c_uint, c_void};

/// Input and results, `struct triangulateio` of the header.
#[repr(C)]
#[derive(Debug)]
#[allow(missing_docs)]
pub struct TriangulateIo {
    pub pointlist: *mut f64,
    pub pointattributelist: *mut f64,
    pub pointmarkerlist: *mut c_int,
    pub numberofpoints: c_int,
    pub numberofpointattributes: c_int,
    pub trianglelist: *mut c_int,
    pub triangleattributelist: *mut f64,
    pub trianglearealist: *mut f64,
    pub neighborlist: *mut c_int,
    pub numberoftriangles: c_int,
    pub numberofcorners: c_int,
    pub numberoftriangleattributes: c_int,
    pub segmentlist: *mut c_int,
    pub segmentmarkerlist: *mut c_int,
    pub numberofsegments: c_int,
    pub holelist: *mut f64,
    pub numberofholes: c_int,
    pub regionlist: *mut f64,
    pub numberofregions: c_int,
    pub edgelist: *mut c_int,
    pub edgemarkerlist: *mut c_int,
    pub normlist: *mut f64,
    pub numberofedges: c_int,
}

/// The bytes of words in an error.
pub const WORD_BYTES: usize = 244;

/// An error, `struct delone_tri_error` of the header.
#[repr(C)]
#[derive(Debug)]
#[allow(missing_docs)]
pub struct TriError {
    pub size: c_uint,
    pub status: c_int,
    pub index: c_int,
    pub words: [c_char; WORD_BYTES],
}

/// Whether a triangle is to be refined, `delone_tri_test` of the header.
pub type Test = unsafe extern "C" fn(*const f64, *const f64, *const f64, f64, *mut c_void) -> c_int;

/// Triangle's own form of a [`Test`], without what the caller gave along.
pub type PlainTest = unsafe extern "C" fn(*mut f64, *mut f64, *mut f64, f64) -> c_int;
