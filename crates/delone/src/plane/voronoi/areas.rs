//! Voronoi cells of areas: the inside of an area is its own, and the places outside of all belong to the nearest one.
//!
//! Sites along the borders have cells as those of lines do ([`LineCells2`]), which are clipped to what is outside of all areas. Each area is joined with the cells of
//! its sites. So areas may share sides. Slits that are hardly wider than a rounding are closed before ([`Weld2`]), so no gap is too narrow.
//!
//! Cost: that of the cells of lines, and a constrained triangulation of the borders.

use std::collections::BTreeMap;

use super::cells::Cells2;
use super::lines::{Borders, LineCells2, checked};
use crate::error::Error;
use crate::ids::{TriangleId, VertexId};
use crate::plane::constrained::{
    Constrained2, Crossings, Fill, Membership2, Overlaps2, PolygonRegion2, SegmentId,
};
use crate::plane::region::Region2;
use crate::plane::weld::Weld2;
use crate::points::Position2;

/// A place as it is compared: zero has no sign.
type Key = [u64; 2];

fn key(p: [f64; 2]) -> Key {
    p.map(|x| (x + 0.0).to_bits())
}

/// As a part of the largest coordinate: some thousand steps between numbers. A slit between areas that is narrower has no room for corners of
/// cells, which are rounded, and is closed: cells across slits of 100 steps were invalid now and then, of 1,000 steps never.
const SLIT_WIDTH: f64 = 4096.0 * f64::EPSILON;

/// A ring.
type Places = Vec<[f64; 2]>;

impl LineCells2 {
    /// The cells of areas in a region: the inside of each area, with the places outside of all that are nearer to it than to any other. Segments
    /// are between points by index; `areas` has the area of each, which an odd number of its segments is around. Areas may touch and
    /// share sides, and slits narrower than 2^-40 of the largest coordinate are closed; of places in several the one of the least number has them. The tolerance is that of [`LineCells2::new`].
    ///
    /// # Errors
    /// As [`LineCells2::new`].
    ///
    /// ```
    /// use delone::{LineCells2, Region2, VertexId};
    ///
    /// // Two houses with a wall in common.
    /// let points = [[1, 1], [3, 1], [3, 3], [1, 3], [5, 1], [5, 2], [3, 2]];
    /// let segments = [[0, 1], [1, 2], [2, 3], [3, 0], [1, 4], [4, 5], [5, 6], [6, 1]];
    /// let areas = [0, 0, 0, 0, 1, 1, 1, 1];
    /// let region = Region2::rectangle([0, 0], [6, 4])?;
    /// let made = LineCells2::of_areas(&points, &segments, &areas, &region, 0.01)?;
    /// let [one, other] = [0, 1].map(|area| made.cells.area(VertexId::new(area)));
    /// assert!((one + other - 24.0).abs() < 1e-12 && one > 12.0);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn of_areas<P: Position2>(
        points: &[P],
        segments: &[[usize; 2]],
        areas: &[usize],
        region: &Region2,
        tolerance: f64,
    ) -> Result<Self, Error> {
        checked(segments.len(), areas.len(), tolerance)?;
        let (segments, areas) = without_slits(points, segments, areas)?;
        let (segments, areas) = (&segments[..], &areas[..]);
        let c = Constrained2::with_crossings(points, segments, Crossings::Split)?;
        let mut made = Self::default();
        let mut pieces = made.pieces(&c, |segment| areas[segment.index()]);
        made.points_of(points, segments, areas);
        let d = made.settle(&mut pieces, region, Borders { tolerance, cosine: None })?;
        let count = areas.iter().max().map_or(0, |last| last + 1);
        let plan = Plan::new(points, segments, areas, region)?;
        let outside = plan.rings_of(count);
        // Areas may fill the region.
        let beyond = if outside.is_empty() {
            Cells2::default()
        } else {
            d.voronoi().clip(&Region2::polygon(&outside)?)
        };
        let stretches = stretches(&beyond, &outside);
        let sites = made.sites.len();
        let own = (0..sites)
            .map(|site| beyond.rings(VertexId::new(site)).map(|ring| ring.points().collect()).collect());
        let inside = (0..count).map(|area| divided(plan.rings_of(area), &stretches));
        let all = Cells2::of_rings(own.chain(inside));
        let group = |cell: VertexId| {
            cell.index().checked_sub(sites).or_else(|| made.lines.get(cell.index()).copied())
        };
        made.cells = all.joined(group, count);
        Ok(made)
    }
}

/// Segments and their areas, with slits closed. A segment that became a point is one: its area has a cell all the same.
fn without_slits<P: Position2>(
    points: &[P],
    segments: &[[usize; 2]],
    areas: &[usize],
) -> Result<(Vec<[usize; 2]>, Vec<usize>), Error> {
    let farthest = points.iter().flat_map(Position2::xy).fold(0.0, |most: f64, x| most.max(x.abs()));
    let welded = Weld2::new(points, segments, SLIT_WIDTH * farthest)?;
    let mut closed: Vec<[usize; 2]> = welded.segments;
    let mut of: Vec<usize> = welded.origins.iter().map(|&segment| areas[segment]).collect();
    let points =
        segments.iter().zip(areas).filter(|(ends, _)| welded.stays[ends[0]] == welded.stays[ends[1]]);
    for (ends, &area) in points {
        closed.push([welded.stays[ends[0]]; 2]);
        of.push(area);
    }
    Ok((closed, of))
}

/// The areas within the region, and last what is outside of all, by the triangles of their borders.
struct Plan {
    cells: Cells2,
}

impl Plan {
    fn new<P: Position2>(
        points: &[P],
        segments: &[[usize; 2]],
        areas: &[usize],
        region: &Region2,
    ) -> Result<Self, Error> {
        let mut places: Places = points.iter().map(Position2::xy).collect();
        let mut sides = segments.to_vec();
        for ring in region.rings() {
            let first = places.len();
            places.extend(ring);
            let next = |i: usize| if i + 1 < places.len() { i + 1 } else { first };
            sides.extend((first..places.len()).map(|i| [i, next(i)]));
        }
        let c = Constrained2::with_crossings(&places, &sides, Crossings::Split)?;
        let count = areas.iter().max().map_or(0, |last| last + 1);
        let polygon = |segment: SegmentId| Some(areas.get(segment.index()).copied().unwrap_or(count));
        let mut domains = c.domains(&Fill::All)?;
        let regions = vec![PolygonRegion2::new(0.0); count + 1];
        let several =
            c.claim_polygons_as(&mut domains, polygon, &regions, Overlaps2::Combined, Membership2::EvenOdd);
        let group = |t: TriangleId| match domains.region(t)? {
            own if own == count => Some(count),
            // Of several the last is the region.
            own if own > count => match several[own - count - 1][..] {
                [first, .., last] if last == count => Some(first),
                _ => None,
            },
            _ => None,
        };
        let (mut triangles, mut groups): (Vec<Vec<Places>>, Vec<usize>) = (Vec::new(), Vec::new());
        for t in c.triangle_ids() {
            let Some(own) = group(t) else { continue };
            triangles.push(vec![c.mesh().corners(t).map(|v| c.point(v)).to_vec()]);
            groups.push(own);
        }
        let cells = Cells2::of_rings(triangles.into_iter());
        Ok(Self { cells: cells.joined(|t| groups.get(t.index()).copied(), count + 1) })
    }

    fn rings_of(&self, area: usize) -> Vec<Places> {
        self.cells.rings(VertexId::new(area)).map(|ring| ring.points().collect()).collect()
    }
}

/// Sides of a region against which cells lie: by their ends, with the corners of cells between them.
fn stretches(cells: &Cells2, rings: &[Places]) -> BTreeMap<[Key; 2], Places> {
    let mut corners: Vec<Key> = rings.iter().flatten().map(|&p| key(p)).collect();
    corners.sort_unstable();
    let is_corner = |p: [f64; 2]| corners.binary_search(&key(p)).is_ok();
    let mut found = BTreeMap::new();
    for ring in cells.joined(|_| Some(0), 1).rings(VertexId::new(0)) {
        let mut places: Places = ring.points().collect();
        let Some(first) = places.iter().position(|&p| is_corner(p)) else { continue };
        places.rotate_left(first);
        places.push(places[0]);
        let mut from = 0;
        for to in 1..places.len() {
            if is_corner(places[to]) {
                found.insert([key(places[from]), key(places[to])], places[from + 1..to].to_vec());
                from = to;
            }
        }
    }
    found
}

/// Rings with the corners of cells that lie against them from outside.
fn divided(rings: Vec<Places>, stretches: &BTreeMap<[Key; 2], Places>) -> Vec<Places> {
    let divided = |ring: Places| {
        let next = ring.iter().cycle().skip(1);
        let side = |(&p, &q): (&[f64; 2], &[f64; 2])| {
            let between = stretches.get(&[key(q), key(p)]).map_or(&[][..], Vec::as_slice);
            std::iter::once(p).chain(between.iter().rev().copied())
        };
        ring.iter().zip(next).flat_map(side).collect()
    };
    rings.into_iter().map(divided).collect()
}
