//! The results, written row by row where they are to be.

#![allow(unsafe_code, reason = "results are lists of C")]

use std::ffi::c_int;

use delone::VertexId;

use crate::built::{Built, Side};
use crate::edges::nothing;
use crate::fault::{Fault, Status};
use crate::input::Input;
use crate::layout::TriangulateIo;
use crate::markers;
use crate::memory::{Fresh, copy, fill};
use crate::switches::Switches;
use crate::voronoi;

/// Rows of results, with the names of their points.
pub(crate) struct Output<'a> {
    pub(crate) built: &'a Built,
    pub(crate) s: &'a Switches,
    /// The number of attributes of a point.
    pub(crate) attribute_count: usize,
    input: &'a Input,
    /// By vertex, its row; empty if that is its index.
    names: Vec<c_int>,
    /// The vertices that points are, if points are left out.
    kept: Vec<VertexId>,
    pub(crate) segment_markers: Vec<c_int>,
    /// By directed edge; empty if nobody asks.
    edge_markers: Vec<c_int>,
}

/// Sets all counts of results to nothing.
///
/// # Safety
/// `io` is NULL or writable.
pub(crate) unsafe fn clear(io: *mut TriangulateIo) {
    if io.is_null() {
        return;
    }
    // SAFETY: the caller says so.
    unsafe {
        (*io).numberofpoints = 0;
        (*io).numberofpointattributes = 0;
        (*io).numberoftriangles = 0;
        (*io).numberofcorners = 0;
        (*io).numberoftriangleattributes = 0;
        (*io).numberofsegments = 0;
        (*io).numberofholes = 0;
        (*io).numberofregions = 0;
        (*io).numberofedges = 0;
    }
}

/// A count as C has it.
pub(crate) fn number(count: usize, what: &str) -> Result<c_int, Fault> {
    c_int::try_from(count)
        .map_err(|_| Fault::new(Status::TooMany, format!("{count} {what} are more than an int counts")))
}

impl<'a> Output<'a> {
    pub(crate) fn new(built: &'a Built, input: &'a Input, s: &'a Switches) -> Self {
        let segment_markers = if s.no_markers { Vec::new() } else { markers::of_segments(built, input) };
        let asks = (s.edges || s.second_order) && !s.no_markers && !built.is_plain();
        let edge_markers = if asks { markers::of_edges(built, &segment_markers) } else { Vec::new() };
        let attribute_count = input.attribute_count;
        let (mut names, mut kept) = (Vec::new(), Vec::new());
        if s.jettison {
            names = vec![-1; built.points().len()];
            for row in 0..built.triangles.len() {
                built.corners(row).into_iter().for_each(|v| names[v.index()] = 0);
            }
            kept = (0..names.len()).filter(|&v| names[v] == 0).map(VertexId::new).collect();
            kept.iter().zip(0..).for_each(|(v, row)| names[v.index()] = row);
        }
        Self { built, s, attribute_count, input, names, kept, segment_markers, edge_markers }
    }

    /// The row of a point, as the caller counts.
    #[inline]
    pub(crate) fn name(&self, v: VertexId) -> c_int {
        self.names.get(v.index()).copied().unwrap_or(v.index() as c_int) + self.s.base
    }

    /// The row of a triangle, or -1.
    #[inline]
    pub(crate) fn triangle(&self, row: c_int) -> c_int {
        if row < 0 { -1 } else { row + self.s.base }
    }

    /// The marker of an edge.
    #[inline]
    pub(crate) fn marker(&self, side: &Side) -> c_int {
        if self.built.is_plain() {
            c_int::from(side.across < 0)
        } else {
            self.edge_markers[markers::index(side.edge)]
        }
    }

    /// The number of points, those in the middles of edges not counted.
    pub(crate) fn point_count(&self) -> usize {
        if self.s.jettison { self.kept.len() } else { self.built.points().len() }
    }

    /// The attributes of a point.
    pub(crate) fn values(&self, v: VertexId) -> &[f64] {
        &self.built.values[v.index() * self.attribute_count..][..self.attribute_count]
    }

    /// Writes all that the switches ask for.
    ///
    /// # Safety
    /// `out` and, with switch v, `vorout` are writable. Lists of results that are not NULL have room, and nothing else uses them.
    pub(crate) unsafe fn write(
        &self,
        out: *mut TriangulateIo,
        vorout: *mut TriangulateIo,
        given: *const TriangulateIo,
    ) -> Result<(), Fault> {
        let (built, s) = (self.built, self.s);
        let mut fresh = Fresh::default();
        let middles = if s.second_order { built.edge_count() } else { 0 };
        let points = number(self.point_count() + middles, "points")?;
        let (triangles, edges) =
            (number(built.triangles.len(), "triangles")?, number(built.edge_count(), "edges")?);
        // SAFETY: as the caller says, here and below. The input was copied; its lists of holes and regions are given on as pointers.
        unsafe {
            clear(out);
            let has_seeds = s.poly && !s.no_segments;
            if has_seeds {
                let (holes, regions) = ((*given).numberofholes, (*given).numberofregions);
                ((*out).holelist, (*out).regionlist) = ((*given).holelist, (*given).regionlist);
                ((*out).numberofholes, (*out).numberofregions) = (holes, regions);
            }
            self.write_points(out, &mut fresh)?;
            self.write_triangles(out, &mut fresh)?;
            self.write_edges(out, &mut fresh)?;
            (*out).numberofpoints = points;
            (*out).numberofpointattributes = number(self.attribute_count, "attributes")?;
            (*out).numberoftriangles = triangles;
            (*out).numberofcorners = if s.second_order { 6 } else { 3 };
            (*out).numberoftriangleattributes = number(built.triangle_value_count, "attributes")?;
            (*out).numberofsegments = number(built.segments.len(), "segments")?;
            (*out).numberofedges = edges;
            if s.voronoi {
                clear(vorout);
                voronoi::write(self, vorout, &mut fresh)?;
                (*vorout).numberofpoints = triangles;
                (*vorout).numberofpointattributes = (*out).numberofpointattributes;
                (*vorout).numberofedges = edges;
            }
        }
        fresh.keep();
        Ok(())
    }

    /// # Safety
    /// As [`Self::write`].
    unsafe fn write_points(&self, out: *mut TriangulateIo, fresh: &mut Fresh) -> Result<(), Fault> {
        let (built, s) = (self.built, self.s);
        if s.no_vertices {
            return Ok(());
        }
        let corner = self.point_count();
        let middles_count = if s.second_order { built.edge_count() } else { 0 };
        let count = corner + middles_count;
        // SAFETY: as the caller says.
        unsafe {
            let to = fresh.room::<_, [f64; 2]>(&raw mut (*out).pointlist, count, "pointlist")?;
            let (corners, middles) = to.split_at_mut(corner);
            if s.jettison {
                fill(corners, &self.kept, |_, v| built.points()[v.index()]);
            } else {
                copy(corners, built.points());
            }
            self.fill_sides(middles, &mut nothing(middles_count), |side| {
                let [p, q] = built.ends(side).map(|v| built.points()[v.index()]);
                ([0, 1].map(|k| p[k] / 2.0 + q[k] / 2.0), ())
            });
            if self.attribute_count > 0 {
                let each = self.attribute_count;
                let rows = count.saturating_mul(each);
                let to =
                    fresh.room::<_, f64>(&raw mut (*out).pointattributelist, rows, "pointattributelist")?;
                let (corners, middles) = to.split_at_mut(corner * each);
                if s.jettison {
                    let values: Vec<f64> = self.kept.iter().flat_map(|&v| self.values(v)).copied().collect();
                    copy(corners, &values);
                } else {
                    copy(corners, &built.values);
                }
                let mut values: Vec<f64> = Vec::new();
                for side in built.all_sides().filter(|_| s.second_order) {
                    let [p, q] = built.ends(&side).map(|v| self.values(v));
                    values.extend(p.iter().zip(q).map(|(p, q)| p / 2.0 + q / 2.0));
                }
                copy(middles, &values);
            }
            if !s.no_markers {
                let to = fresh.room::<_, c_int>(&raw mut (*out).pointmarkerlist, count, "pointmarkerlist")?;
                let (corners, middles) = to.split_at_mut(corner);
                let markers = markers::of_points(built, self.input, &self.segment_markers);
                if s.jettison {
                    fill(corners, &self.kept, |_, v| markers[v.index()]);
                } else {
                    copy(corners, &markers);
                }
                self.fill_sides(middles, &mut nothing(middles_count), |side| (self.marker(side), ()));
            }
        }
        Ok(())
    }

    /// # Safety
    /// As [`Self::write`].
    unsafe fn write_triangles(&self, out: *mut TriangulateIo, fresh: &mut Fresh) -> Result<(), Fault> {
        let (built, s) = (self.built, self.s);
        let rows = &built.triangles;
        // SAFETY: as the caller says.
        unsafe {
            if !s.no_triangles && s.second_order {
                let to =
                    fresh.room::<_, [c_int; 6]>(&raw mut (*out).trianglelist, rows.len(), "trianglelist")?;
                let middles = self.middles();
                fill(to, rows, |row, _| {
                    let ([a, b, c], [d, e, f]) = (built.corners(row).map(|v| self.name(v)), middles[row]);
                    [a, b, c, d, e, f]
                });
            } else if !s.no_triangles {
                let to =
                    fresh.room::<_, [c_int; 3]>(&raw mut (*out).trianglelist, rows.len(), "trianglelist")?;
                let mesh = built.mesh();
                fill(to, rows, |_, &t| mesh.corners(t).map(|v| self.name(v)));
            }
            if !s.no_triangles && built.triangle_value_count > 0 {
                let count = built.triangle_values.len();
                let list = &raw mut (*out).triangleattributelist;
                copy(fresh.room::<_, f64>(list, count, "triangleattributelist")?, &built.triangle_values);
            }
            if s.neighbors {
                let to =
                    fresh.room::<_, [c_int; 3]>(&raw mut (*out).neighborlist, rows.len(), "neighborlist")?;
                // Edge k leaves corner k, so that corner is opposite to the edge after it.
                fill(to, rows, |_, t| [1, 2, 0].map(|k| self.triangle(built.across(t.edge(k)))));
            }
        }
        Ok(())
    }
}
