//! Markers of segments and points.
//!
//! A piece of a segment has the marker of the segment; on the border of the mesh, where that is 0 or there is no segment, it has 1. A point
//! keeps a marker that is not 0. Others get it from the segments at them: from the first of the input that has one, else from the border.

use std::ffi::c_int;

use delone::EdgeId;

use crate::built::{Built, Segment};
use crate::input::Input;

/// The marker of each segment.
pub(crate) fn of_segments(built: &Built, input: &Input) -> Vec<c_int> {
    let marker = |segment: &Segment| {
        let given = segment.origin.map_or(0, |row| input.segment_markers[row]);
        let is_border = || {
            let mesh = built.mesh();
            [segment.edge, mesh.twin(segment.edge)].into_iter().any(|e| built.row(e.triangle()) < 0)
        };
        if given == 0 && is_border() { 1 } else { given }
    };
    built.segments.iter().map(marker).collect()
}

/// The marker of each point, of the input and new.
pub(crate) fn of_points(built: &Built, input: &Input, of_segments: &[c_int]) -> Vec<c_int> {
    let mut markers = input.markers.clone();
    markers.resize(built.points().len(), 0);
    let mut mark = |segment: &Segment, marker: c_int| {
        for v in segment.ends {
            let own = &mut markers[v.index()];
            *own = if *own == 0 { marker } else { *own };
        }
    };
    let given = |segment: &Segment| segment.origin.map_or(0, |row| input.segment_markers[row]);
    let outside = built.outside.iter().map(|segment| (segment, given(segment)));
    let mut order: Vec<(&Segment, c_int)> = built.segments.iter().zip(of_segments.iter().copied()).collect();
    order.extend(outside);
    if !built.is_plain() {
        order.sort_by_key(|(segment, _)| (given(segment) == 0, segment.origin));
    }
    order.into_iter().for_each(|(segment, marker)| mark(segment, marker));
    markers
}

/// The index of a directed edge: four a triangle, of which three are used.
pub(crate) fn index(e: EdgeId) -> usize {
    4 * e.triangle().index() + e.corner()
}

/// The marker of each directed edge, by [`index`].
pub(crate) fn of_edges(built: &Built, of_segments: &[c_int]) -> Vec<c_int> {
    let mesh = built.mesh();
    let mut markers = vec![0; 4 * mesh.slot_count()];
    for (segment, &marker) in built.segments.iter().zip(of_segments) {
        markers[index(segment.edge)] = marker;
        markers[index(mesh.twin(segment.edge))] = marker;
    }
    markers
}
