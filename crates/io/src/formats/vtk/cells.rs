//! Cells of VTK's files, as far as they are lines, triangles, quadrilaterals or tetrahedra.

use std::ops::Range;

use super::broken;
use crate::Error;
use crate::formats::quads::Quads;

/// VTK's number of chains of segments.
pub(super) const POLYLINE: u8 = 4;
/// VTK's number of polygons.
pub(super) const POLYGON: u8 = 7;
/// VTK's number of strips of triangles.
pub(super) const STRIP: u8 = 6;

/// The family of a kind of cell.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Family {
    /// Points, of which there is a list already.
    Points,
    /// Segments from each point to the next.
    Chain,
    /// A simplex of so many corners, which are its first points.
    Simplex(usize),
    /// A quadrilateral, whose corners are its first points.
    Quad,
    /// A triangle if it has three points, a quadrilateral if it has four.
    Polygon,
    Other,
}

impl Family {
    /// By VTK's number of the kind (`vtkCellType.h`): linear, quadratic, Lagrange's, Bezier's.
    fn of(kind: u8) -> Self {
        match kind {
            1 | 2 => Self::Points,
            POLYLINE => Self::Chain,
            3 | 21 | 35 | 68 | 75 => Self::Simplex(2),
            5 | 22 | 34 | 69 | 76 => Self::Simplex(3),
            10 | 24 | 71 | 78 => Self::Simplex(4),
            9 | 23 | 28 | 70 | 77 => Self::Quad,
            POLYGON => Self::Polygon,
            _ => Self::Other,
        }
    }
}

/// Cells: their kinds, where the corners of each end, and the corners as indices of all points.
#[derive(Default)]
pub(super) struct Cells {
    kinds: Vec<u8>,
    ends: Vec<usize>,
    corners: Vec<u64>,
    /// A number for each cell; nothing if none has one.
    markers: Vec<i64>,
}

impl Cells {
    pub(super) fn len(&self) -> usize {
        self.kinds.len()
    }

    /// Gives the cells from one on their markers, which are whole numbers, one for each; false if they are others.
    pub(super) fn mark(&mut self, first: usize, numbers: &[f64]) -> bool {
        let whole = |&number: &f64| {
            (number.fract() == 0.0 && number.abs() < 2.0_f64.powi(53)).then_some(number as i64)
        };
        let markers: Option<Vec<i64>> = numbers.iter().map(whole).collect();
        let Some(markers) = markers.filter(|markers| first + markers.len() == self.len()) else {
            return false;
        };
        self.markers.resize(first, 0);
        self.markers.extend(markers);
        true
    }

    /// Adds cells of a piece with the points `points`, from which its corners count.
    pub(super) fn add(
        &mut self,
        kinds: &[f64],
        ends: &[f64],
        corners: &[f64],
        points: Range<usize>,
    ) -> Result<(), Error> {
        if kinds.len() != ends.len() {
            return Err(broken(format!("{} kinds of {} cells", kinds.len(), ends.len())));
        }
        let (first, mut start) = (self.corners.len(), 0);
        for (i, (&kind, &end)) in kinds.iter().zip(ends).enumerate() {
            let end = whole(end).filter(|end| (start..=corners.len()).contains(end));
            let end = end.ok_or_else(|| broken(format!("cell {i} ends outside of the list of corners")))?;
            let kind = whole(kind).and_then(|kind| u8::try_from(kind).ok());
            self.kinds.push(kind.ok_or_else(|| broken(format!("cell {i} is of no kind")))?);
            self.ends.push(first + end);
            for &corner in &corners[start..end] {
                let index = whole(corner).filter(|&corner| corner < points.len());
                let index = index
                    .ok_or_else(|| broken(format!("cell {i} has a corner {corner}, which is no point")))?;
                self.corners.push((points.start + index) as u64);
            }
            start = end;
        }
        Ok(())
    }

    /// The family of each cell, and its points.
    fn iter(&self) -> impl Iterator<Item = (Family, &[u64])> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        let ranges = starts.zip(&self.ends).map(|(start, &end)| &self.corners[start..end]);
        self.kinds.iter().map(|&kind| Family::of(kind)).zip(ranges)
    }

    pub(super) fn has_lines(&self) -> bool {
        self.iter().any(|(family, points)| match family {
            Family::Chain | Family::Simplex(2) => points.len() > 1,
            _ => false,
        })
    }

    /// The segments of all lines, and their markers, if any is other than 0.
    pub(super) fn segments(&self) -> (Vec<[usize; 2]>, Option<Vec<i64>>) {
        let (mut segments, mut markers) = (Vec::new(), Vec::new());
        for (i, (family, points)) in self.iter().enumerate() {
            let chain = match family {
                Family::Chain => points,
                // Other nodes follow the ends.
                Family::Simplex(2) => points.get(..2).unwrap_or_default(),
                _ => continue,
            };
            segments.extend(chain.windows(2).map(|side| [side[0] as usize, side[1] as usize]));
            markers.resize(segments.len(), self.markers.get(i).copied().unwrap_or_default());
        }
        let has_markers = markers.iter().any(|&marker| marker != 0);
        (segments, has_markers.then_some(markers))
    }

    /// The simplices of N corners between points, and how many quadrilaterals are two triangles of them. Cells of a lower dimension are passed
    /// over, and so are tetrahedra where triangles are wanted.
    pub(super) fn simplices<const N: usize>(
        &self,
        points: &[[f64; 2]],
    ) -> Result<(Vec<[u64; N]>, usize), Error> {
        let (mut simplices, mut quads) = (Vec::new(), Quads::default());
        let place = |i: u64| points[i as usize];
        for (i, (family, points)) in self.iter().enumerate() {
            let too_few = || broken(format!("cell {i} has too few corners"));
            let width = match family {
                Family::Points | Family::Chain => continue,
                Family::Simplex(width) => width,
                Family::Polygon if points.len() == 3 => 3,
                Family::Polygon if points.len() != 4 => return Err(self.strange(i, points)),
                Family::Quad | Family::Polygon => {
                    if N == 3 {
                        let corners = points.first_chunk().copied();
                        quads.push(simplices.len(), corners.ok_or_else(too_few)?, 0);
                    }
                    continue;
                }
                Family::Other => return Err(self.strange(i, points)),
            };
            if width == N {
                let corners = points.first_chunk().copied();
                simplices.push((corners.ok_or_else(too_few)?, 0));
            }
        }
        let all = quads.among("VTK", simplices, place)?;
        Ok((all.into_iter().map(|row| row.0).collect(), quads.len()))
    }

    fn strange(&self, i: usize, points: &[u64]) -> Error {
        let (kind, count) = (self.kinds[i], points.len());
        broken(format!(
            "cell {i} (of VTK's kind {kind}, with {count} points) is no triangle, quadrilateral or tetrahedron"
        ))
    }
}

/// A number that counts something.
fn whole(number: f64) -> Option<usize> {
    (number >= 0.0 && number < 2.0_f64.powi(53) && number.fract() == 0.0).then_some(number as usize)
}
