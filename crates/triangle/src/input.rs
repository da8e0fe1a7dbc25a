//! The input, checked and copied: results may be written over it.

#![allow(unsafe_code, reason = "lists of C are pointers and counts")]

use std::ffi::c_int;

use crate::fault::{Fault, Status};
use crate::layout::TriangulateIo;
use crate::switches::Switches;

/// Memory of work for a point, in bytes: measured on a million points, and half as much again.
const BYTES_PER_POINT: usize = 160;
/// The fewest points that span a triangle.
const TRIANGLE_POINTS: usize = 3;

/// A region.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Region {
    pub(crate) at: [f64; 2],
    pub(crate) attribute: f64,
    pub(crate) max_area: f64,
}

/// The triangles of a mesh that is read.
#[derive(Debug, Default)]
pub(crate) struct Given {
    pub(crate) triangles: Vec<[usize; 3]>,
    pub(crate) attributes: Vec<f64>,
    pub(crate) attribute_count: usize,
    /// The largest areas, if they are asked for.
    pub(crate) areas: Vec<f64>,
}

/// See the module.
#[derive(Debug, Default)]
pub(crate) struct Input {
    pub(crate) points: Vec<[f64; 2]>,
    pub(crate) attributes: Vec<f64>,
    pub(crate) attribute_count: usize,
    /// None if there are none: they are zeros then.
    pub(crate) markers: Vec<c_int>,
    pub(crate) segments: Vec<[usize; 2]>,
    /// One for each segment.
    pub(crate) segment_markers: Vec<c_int>,
    pub(crate) holes: Vec<[f64; 2]>,
    pub(crate) regions: Vec<Region>,
    pub(crate) given: Option<Given>,
}

/// A count of rows.
fn count(value: c_int, name: &str) -> Result<usize, Fault> {
    usize::try_from(value).map_err(|_| Fault::new(Status::Argument, format!("{name} is {value}")))
}

/// A copy of a list with so many rows of so many values.
///
/// # Safety
/// A list that is not NULL has so many values.
unsafe fn copy<T: Copy>(list: *const T, rows: usize, columns: usize, name: &str) -> Result<Vec<T>, Fault> {
    let values = rows.saturating_mul(columns);
    if values == 0 {
        return Ok(Vec::new());
    }
    if list.is_null() {
        let words = format!("{name} is NULL, and {values} values should be there");
        return Err(Fault::new(Status::Argument, words));
    }
    let mut all = Vec::new();
    let bytes = values.saturating_mul(size_of::<T>());
    all.try_reserve_exact(values).map_err(|_| Fault::memory(bytes, name))?;
    // SAFETY: the caller says so; more bytes than a list can have were refused by the line before.
    all.extend_from_slice(unsafe { std::slice::from_raw_parts(list, values) });
    Ok(all)
}

/// The index of a point that a row names.
fn index(value: c_int, base: c_int, points: usize, what: &str, row: usize) -> Result<usize, Fault> {
    let index = usize::try_from(i64::from(value) - i64::from(base)).ok().filter(|&index| index < points);
    index.ok_or_else(|| {
        let words = format!("{what} {row} has the point {value}; there are {points}, counted from {base}");
        Fault::at(Status::Index, row, words)
    })
}

/// Refuses numbers that are not finite.
fn finite<const W: usize>(rows: &[[f64; W]], what: &str) -> Result<(), Fault> {
    let wrong = rows.iter().enumerate().find(|(_, row)| !row[..2].iter().all(|x| x.is_finite()));
    wrong.map_or(Ok(()), |(k, row)| {
        Err(Fault::at(
            Status::NotFinite,
            k,
            format!("{what} {k} is at ({}, {}), which is not finite", row[0], row[1]),
        ))
    })
}

impl Input {
    /// # Safety
    /// `io` is readable, and its lists that the switches use have the lengths that its counts say.
    pub(crate) unsafe fn read(io: *const TriangulateIo, s: &Switches) -> Result<Self, Fault> {
        // SAFETY: for all reads below, as the caller says. Fields that the switches do not use may be unwritten memory, so each is
        // read where it is needed.
        unsafe {
            let points = count((*io).numberofpoints, "numberofpoints")?;
            if points < TRIANGLE_POINTS {
                let words = format!("numberofpoints is {points}, and a triangle has three");
                return Err(Fault::new(Status::Argument, words));
            }
            if !delone_pool::has_room(points.saturating_mul(BYTES_PER_POINT)) {
                return Err(Fault::memory(points.saturating_mul(BYTES_PER_POINT), "the points"));
            }
            let attribute_count = count((*io).numberofpointattributes, "numberofpointattributes")?;
            let mut input = Self {
                points: copy((*io).pointlist.cast(), points, 1, "pointlist")?,
                attributes: copy((*io).pointattributelist, points, attribute_count, "pointattributelist")?,
                attribute_count,
                ..Self::default()
            };
            let markers = (*io).pointmarkerlist;
            if !markers.is_null() {
                input.markers = copy(markers, points, 1, "pointmarkerlist")?;
            }
            if s.poly {
                input.read_segments(io, s)?;
            }
            if s.poly && !s.refine {
                input.read_seeds(io, s)?;
            }
            if s.refine {
                input.given = Some(input.read_triangles(io, s)?);
            }
            Ok(input)
        }
    }

    /// # Safety
    /// As [`Self::read`].
    unsafe fn read_segments(&mut self, io: *const TriangulateIo, s: &Switches) -> Result<(), Fault> {
        // SAFETY: as the caller says.
        let (pairs, markers) = unsafe {
            let rows = count((*io).numberofsegments, "numberofsegments")?;
            let pairs: Vec<[c_int; 2]> = copy((*io).segmentlist.cast(), rows, 1, "segmentlist")?;
            let markers = (*io).segmentmarkerlist;
            let none = markers.is_null();
            let markers = if none { vec![0; rows] } else { copy(markers, rows, 1, "segmentmarkerlist")? };
            (pairs, markers)
        };
        let points = self.points.len();
        let ends = |(row, pair): (usize, [c_int; 2])| {
            Ok([
                index(pair[0], s.base, points, "segment", row)?,
                index(pair[1], s.base, points, "segment", row)?,
            ])
        };
        self.segments = pairs.into_iter().enumerate().map(ends).collect::<Result<_, Fault>>()?;
        self.segment_markers = markers;
        Ok(())
    }

    /// # Safety
    /// As [`Self::read`].
    unsafe fn read_seeds(&mut self, io: *const TriangulateIo, s: &Switches) -> Result<(), Fault> {
        // SAFETY: as the caller says.
        let regions: Vec<[f64; 4]> = unsafe {
            if !s.no_holes {
                let rows = count((*io).numberofholes, "numberofholes")?;
                self.holes = copy((*io).holelist.cast(), rows, 1, "holelist")?;
            }
            let rows = count((*io).numberofregions, "numberofregions")?;
            copy((*io).regionlist.cast(), rows, 1, "regionlist")?
        };
        finite(&self.holes, "hole")?;
        finite(&regions, "region")?;
        let region = |[x, y, attribute, max_area]: [f64; 4]| Region { at: [x, y], attribute, max_area };
        self.regions = regions.into_iter().map(region).collect();
        Ok(())
    }

    /// # Safety
    /// As [`Self::read`].
    unsafe fn read_triangles(&self, io: *const TriangulateIo, s: &Switches) -> Result<Given, Fault> {
        // SAFETY: as the caller says.
        let (list, columns, attributes, attribute_count, areas) = unsafe {
            let rows = count((*io).numberoftriangles, "numberoftriangles")?;
            // Some clients leave it at zero.
            let columns = count((*io).numberofcorners, "numberofcorners")?.max(TRIANGLE_POINTS);
            let list = copy((*io).trianglelist, rows, columns, "trianglelist")?;
            let attribute_count = count((*io).numberoftriangleattributes, "numberoftriangleattributes")?;
            let attributes =
                copy((*io).triangleattributelist, rows, attribute_count, "triangleattributelist")?;
            let areas = (*io).trianglearealist;
            let has_areas = s.areas && !areas.is_null();
            let areas = if has_areas { copy(areas, rows, 1, "trianglearealist")? } else { Vec::new() };
            (list, columns, attributes, attribute_count, areas)
        };
        let points = self.points.len();
        let corners = |(row, corners): (usize, &[c_int])| {
            let mut found = [0; 3];
            for (to, &corner) in found.iter_mut().zip(corners) {
                *to = index(corner, s.base, points, "triangle", row)?;
            }
            Ok(found)
        };
        let triangles = list.chunks_exact(columns).enumerate().map(corners).collect::<Result<_, Fault>>()?;
        Ok(Given { triangles, attributes, attribute_count, areas })
    }
}
