//! A caller: lists go in and come out, and memory that nobody should touch is watched.

use std::ffi::{CString, c_int, c_void};
use std::ptr::null_mut;

use delone_triangle::{Test, TriError, TriangulateIo, WORD_BYTES, delone_triangulate, trifree};

/// An input; empty lists are NULL.
#[derive(Clone, Debug, Default)]
pub(crate) struct Given {
    pub(crate) points: Vec<[f64; 2]>,
    pub(crate) attributes: Vec<f64>,
    pub(crate) markers: Vec<c_int>,
    pub(crate) segments: Vec<[c_int; 2]>,
    pub(crate) segment_markers: Vec<c_int>,
    pub(crate) holes: Vec<[f64; 2]>,
    pub(crate) regions: Vec<[f64; 4]>,
    pub(crate) triangles: Vec<[c_int; 3]>,
    pub(crate) triangle_attributes: Vec<f64>,
    pub(crate) areas: Vec<f64>,
}

/// Results.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Got {
    pub(crate) points: Vec<[f64; 2]>,
    pub(crate) attributes: Vec<f64>,
    pub(crate) markers: Vec<c_int>,
    pub(crate) corners: Vec<Vec<c_int>>,
    pub(crate) triangle_attributes: Vec<f64>,
    pub(crate) neighbors: Vec<[c_int; 3]>,
    pub(crate) segments: Vec<[c_int; 2]>,
    pub(crate) segment_markers: Vec<c_int>,
    pub(crate) edges: Vec<[c_int; 2]>,
    pub(crate) edge_markers: Vec<c_int>,
    pub(crate) norms: Vec<[f64; 2]>,
    /// Points, triangles, segments, edges, holes, regions.
    pub(crate) counts: [c_int; 6],
}

/// A status that is not good, with its index and words.
pub(crate) type Refusal = (c_int, c_int, String);

fn list<T, U>(values: &[T]) -> *mut U {
    if values.is_empty() { null_mut() } else { values.as_ptr().cast_mut().cast() }
}

fn count<T>(values: &[T]) -> c_int {
    values.len().try_into().expect("few")
}

/// A structure of bytes that nobody wrote.
pub(crate) fn unwritten() -> TriangulateIo {
    // SAFETY: pointers and numbers may have any bits.
    unsafe { std::mem::transmute([0xff_u8; size_of::<TriangulateIo>()]) }
}

fn is_unwritten<T>(list: *const T) -> bool {
    list as usize == usize::MAX
}

impl Given {
    /// The structure; lists that switches do not use are unwritten memory.
    pub(crate) fn io(&self, switches: &str) -> TriangulateIo {
        let mut io = unwritten();
        let has = |letter: char| switches.contains(letter);
        (io.pointlist, io.numberofpoints) = (list(&self.points), count(&self.points));
        (io.pointattributelist, io.pointmarkerlist) = (list(&self.attributes), list(&self.markers));
        io.numberofpointattributes = count(&self.attributes).checked_div(count(&self.points)).unwrap_or(0);
        if has('p') {
            (io.segmentlist, io.numberofsegments) = (list(&self.segments), count(&self.segments));
            io.segmentmarkerlist = list(&self.segment_markers);
            (io.holelist, io.numberofholes) = (list(&self.holes), count(&self.holes));
            (io.regionlist, io.numberofregions) = (list(&self.regions), count(&self.regions));
        }
        if has('r') {
            (io.trianglelist, io.numberoftriangles) = (list(&self.triangles), count(&self.triangles));
            (io.triangleattributelist, io.trianglearealist) =
                (list(&self.triangle_attributes), list(&self.areas));
            io.numberofcorners = 3;
            io.numberoftriangleattributes =
                count(&self.triangle_attributes).checked_div(count(&self.triangles)).unwrap_or(0);
        }
        io
    }

    pub(crate) fn run(&self, switches: &str) -> Result<Got, Refusal> {
        self.run_with(switches, None, null_mut()).map(|[got, _]| got)
    }

    /// The results, and the Voronoi diagram.
    pub(crate) fn run_with(
        &self,
        switches: &str,
        test: Option<Test>,
        user: *mut c_void,
    ) -> Result<[Got; 2], Refusal> {
        let has = |letter: char| switches.contains(letter);
        let io = self.io(switches);
        let (mut out, mut vorout) = (unwritten(), unwritten());
        let lists = (has('N'), has('E'), has('B'), has('P'));
        if !lists.0 {
            (out.pointlist, out.pointattributelist, out.pointmarkerlist) =
                (null_mut(), null_mut(), null_mut());
        }
        if !lists.1 {
            (out.trianglelist, out.triangleattributelist) = (null_mut(), null_mut());
        }
        if has('n') {
            out.neighborlist = null_mut();
        }
        if (has('p') || has('c')) && !lists.3 {
            (out.segmentlist, out.segmentmarkerlist) = (null_mut(), null_mut());
        }
        if has('e') {
            (out.edgelist, out.edgemarkerlist) = (null_mut(), null_mut());
        }
        if has('v') {
            (vorout.pointlist, vorout.pointattributelist) = (null_mut(), null_mut());
            (vorout.edgelist, vorout.normlist) = (null_mut(), null_mut());
        }
        let words = CString::new(switches).expect("no zero");
        let mut error =
            TriError { size: size_of::<TriError>() as u32, status: 77, index: 77, words: [1; WORD_BYTES] };
        // SAFETY: lists are as long as counts say.
        let status = unsafe {
            delone_triangulate(
                words.as_ptr(),
                &raw const io,
                &raw mut out,
                &raw mut vorout,
                test,
                user,
                &raw mut error,
            )
        };
        assert_eq!(status, error.status);
        if status != 0 {
            let bytes = error.words.iter().map(|&c| c.cast_unsigned()).take_while(|&c| c != 0).collect();
            assert_eq!(
                [out.numberofpoints, out.numberoftriangles, out.numberofsegments, out.numberofedges],
                [0; 4]
            );
            return Err((status, error.index, String::from_utf8(bytes).expect("UTF-8")));
        }
        assert!(has('v') || vorout.numberofpoints == -1, "vorout is touched");
        assert!(is_unwritten(out.trianglearealist) && is_unwritten(out.normlist), "input alone is touched");
        Ok([taken(&out), if has('v') { taken(&vorout) } else { Got::default() }])
    }
}

/// The values of a list, whose memory is given back.
fn values<T: Copy, U>(list: *mut U, rows: c_int) -> Vec<T> {
    if list.is_null() || is_unwritten(list) {
        return Vec::new();
    }
    // SAFETY: a list that was written has so many rows.
    unsafe {
        let values =
            std::slice::from_raw_parts(list.cast::<T>(), rows.try_into().expect("positive")).to_vec();
        trifree(list.cast());
        values
    }
}

fn taken(io: &TriangulateIo) -> Got {
    let corners: Vec<c_int> = values(io.trianglelist, io.numberoftriangles * io.numberofcorners);
    Got {
        points: values(io.pointlist, io.numberofpoints),
        attributes: values(io.pointattributelist, io.numberofpoints * io.numberofpointattributes),
        markers: values(io.pointmarkerlist, io.numberofpoints),
        corners: corners
            .chunks(io.numberofcorners.max(1).try_into().expect("positive"))
            .map(<[_]>::to_vec)
            .collect(),
        triangle_attributes: values(
            io.triangleattributelist,
            io.numberoftriangles * io.numberoftriangleattributes,
        ),
        neighbors: values(io.neighborlist, io.numberoftriangles),
        segments: values(io.segmentlist, io.numberofsegments),
        segment_markers: values(io.segmentmarkerlist, io.numberofsegments),
        edges: values(io.edgelist, io.numberofedges),
        edge_markers: values(io.edgemarkerlist, io.numberofedges),
        norms: values(io.normlist, io.numberofedges),
        counts: [
            io.numberofpoints,
            io.numberoftriangles,
            io.numberofsegments,
            io.numberofedges,
            io.numberofholes,
            io.numberofregions,
        ],
    }
}

/// The area of a triangle.
pub(crate) fn area(points: &[[f64; 2]], corners: &[c_int]) -> f64 {
    let [a, b, c] = [0, 1, 2].map(|k| points[usize::try_from(corners[k]).expect("an index")]);
    ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
}

/// A square with a square hole, whose sides are segments.
pub(crate) fn frame() -> Given {
    let square = |low: f64, high: f64| [[low, low], [high, low], [high, high], [low, high]];
    Given {
        points: [square(0.0, 8.0), square(3.0, 5.0)].concat(),
        segments: (0..8).map(|k| [k, k / 4 * 4 + (k + 1) % 4]).collect(),
        segment_markers: vec![5, 6, 7, 8, 0, 0, 9, 0],
        holes: vec![[4.0, 4.0]],
        ..Given::default()
    }
}
