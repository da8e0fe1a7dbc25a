//! The wish for boundary layers: heights, rows, and the segments that they are on.

use crate::error::Error;
use crate::plane::constrained::SegmentId;

/// Rows at most.
const MOST_ROWS: usize = 1024;
/// The default of [`Layers2::growth`].
const GROWTH: f64 = 1.2;

/// Boundary layers, as flows need them along walls: rows of thin triangles, each row some times as high as the one before.
///
/// Each vertex of the chosen segments gets a rib across the rows. At a corner with more than 240 degrees of the mesh around it there is a fan
/// of ribs, at others one in the middle. Where chosen segments end at another one, the rows follow that one if it leaves at 50 to 130 degrees;
/// else they come to an end one by one. Where there is no room, such as in a gap, there are fewer rows, and next to them at most one more from
/// vertex to vertex. [`crate::LayerReport2`] tells how many vertices have fewer.
///
/// The sides of the rows, and the ribs, become segments: nothing else keeps triangles that are so thin. They have the ids after those of the
/// segments before. The triangles are inside, in the region around them; [`crate::Domains2::is_layer`] tells them. No angle or size is asked of
/// them, and a mesh that is refined once more keeps them.
///
/// ```
/// use delone::{Constrained2, Layers2, Refinement};
///
/// // A channel with walls below and above.
/// let sides = [[0, 1], [1, 2], [2, 3], [3, 0]];
/// let mut c = Constrained2::from_parts(&[[0, 0], [6, 0], [6, 1], [0, 1]], &sides)?;
/// let walls = c.segments().map(|(segment, _)| segment).filter(|segment| segment.index() % 2 == 0).collect();
/// let layers = Layers2::new(0.01, 5).growth(1.5).on(walls);
/// let made = Refinement::new().edge(0.2).min_angle(25.0).layers(&layers).run(&mut c)?;
/// assert_eq!((made.report.layers.rows, made.report.layers.shortened), (5, 0));
/// assert!(c.vertices().any(|v| c.point(v) == [0.0, 0.01])); // on the inlet
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Layers2 {
    /// The height of the first row.
    pub first_height: f64,
    /// The number of rows.
    pub count: usize,
    /// How many times as high as the row before a row is; 1.2, if nothing is said.
    pub growth: f64,
    /// The height of all rows together: there are fewer rows if that comes nearer to it.
    pub thickness: Option<f64>,
    /// The segments, on those sides that are inside. `None` for all that have the mesh on one side only.
    pub segments: Option<Vec<SegmentId>>,
}

impl Layers2 {
    /// A number of rows along all of the border.
    pub fn new(first_height: f64, count: usize) -> Self {
        Self { first_height, count, growth: GROWTH, thickness: None, segments: None }
    }

    /// Sets [`Self::growth`].
    #[must_use]
    pub fn growth(self, growth: f64) -> Self {
        Self { growth, ..self }
    }

    /// Sets [`Self::thickness`].
    #[must_use]
    pub fn thickness(self, thickness: f64) -> Self {
        Self { thickness: Some(thickness), ..self }
    }

    /// Sets [`Self::segments`].
    #[must_use]
    pub fn on(self, segments: Vec<SegmentId>) -> Self {
        Self { segments: Some(segments), ..self }
    }

    /// The distances of the lines between rows from the border, with 0 for the border itself.
    ///
    /// ```
    /// use delone::Layers2;
    ///
    /// assert_eq!(Layers2::new(0.5, 3).growth(2.0).heights(), [0.0, 0.5, 1.5, 3.5]);
    /// assert_eq!(Layers2::new(0.5, 9).growth(2.0).thickness(1.4).heights(), [0.0, 0.5, 1.5]);
    /// ```
    pub fn heights(&self) -> Vec<f64> {
        let most = self.thickness.unwrap_or(f64::INFINITY);
        let (mut heights, mut sum, mut power) = (vec![0.0], 0.0, 1.0);
        for _ in 0..self.count.min(MOST_ROWS) {
            let last = self.first_height * sum;
            sum += power;
            power *= self.growth;
            let height = self.first_height * sum;
            if !height.is_finite() || 0.5 * last + 0.5 * height > most {
                break;
            }
            heights.push(height);
        }
        heights
    }

    /// Whether all numbers are in their ranges.
    pub(in crate::plane::refine) fn check(&self) -> Result<(), Error> {
        let refused = |name, value, range| Err(Error::Parameter { name, value, range });
        let is_positive = |value: f64| value.is_finite() && value > 0.0;
        let thickness = self.thickness.unwrap_or(1.0);
        if !is_positive(self.first_height) {
            return refused("layer_height", self.first_height, "positive and finite");
        }
        if !(self.growth.is_finite() && self.growth >= 1.0) {
            return refused("layer_growth", self.growth, "at least 1, and finite");
        }
        if !(1..=MOST_ROWS).contains(&self.count) {
            return refused("layer_count", self.count as f64, "from 1 to 1024");
        }
        if !is_positive(thickness) {
            return refused("layer_thickness", thickness, "positive and finite");
        }
        Ok(())
    }
}
