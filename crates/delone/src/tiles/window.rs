//! One tile alone: what must be read besides its own points until all that is seen through a window is final.
//!
//! Who wants the terrain of one tile reads its points and a margin, and triangulates these. If an open triangle meets the window, or
//! the window is not inside of the hull, points further away may change what is seen: they are in the circles of these triangles,
//! or anywhere. So one reads these boxes too, and asks again; where nothing is open any more, what is seen is what the
//! triangulation of all points shows, whatever was guessed for the margin.
//!
//! Cost: O(k + h log h) for k open triangles and h points of the border.

use delone_predicates::{circumcenter, hypotenuse, orient2d};

use super::{Border, Region};
use crate::hull::Hull2;

/// Circles are rounded; boxes are this part of a radius wider.
const MARGIN: f64 = 1e-6;

impl Border {
    /// Boxes where points outside of the region may be that change what is seen through a window; none if that is final.
    /// [`Region::ALL`] is one of them if nothing is known of some of the window.
    ///
    /// `region` is the one that this is the border of. All sides of the window should be finite. Units are those of the points.
    ///
    /// ```
    /// use delone::tiles::{Region, Tile};
    ///
    /// let points: Vec<[f64; 2]> = (0..10_000).map(|i| [f64::from(i * 37 % 1009), f64::from(i * i % 907)]).collect();
    /// let window = Region { low: [400.0; 2], high: [500.0; 2] };
    /// let mut region = window;
    /// let tile = loop {
    ///     let inside: Vec<_> = points.iter().copied().filter(|&p| region.contains(p)).collect();
    ///     let tile = Tile::new(&inside, &region)?;
    ///     let open = tile.border(u64::from).open_in(&region, &window);
    ///     if open.is_empty() {
    ///         break tile;
    ///     }
    ///     for k in 0..2 {
    ///         region.low[k] -= 20.0;
    ///         region.high[k] += 20.0;
    ///     }
    /// };
    /// assert!(tile.points().len() < 1000);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn open_in(&self, region: &Region, window: &Region) -> Vec<Region> {
        if *region == Region::ALL {
            return Vec::new();
        }
        if !self.surrounds(window) {
            return vec![Region::ALL];
        }
        let corners = self.open.iter().map(|t| t.map(|v| self.points[v as usize]));
        corners.filter(|corners| meets(*corners, window)).map(around).collect()
    }

    /// Whether a window is inside of the hull of the points.
    fn surrounds(&self, window: &Region) -> bool {
        let Ok(hull) = Hull2::from_points(&self.points) else { return false };
        let corners = hull.corners();
        let [low, high] = [window.low, window.high];
        let seen = [low, [high[0], low[1]], high, [low[0], high[1]]];
        let is_left = |(k, &v): (usize, &usize)| {
            let (a, b) = (self.points[v], self.points[corners[(k + 1) % corners.len()]]);
            seen.into_iter().all(|p| orient2d(a, b, p).is_positive())
        };
        corners.len() > 2
            && seen.as_flattened().iter().all(|x| x.is_finite())
            && corners.iter().enumerate().all(is_left)
    }
}

/// Whether the box of a triangle meets a window.
fn meets(corners: [[f64; 2]; 3], window: &Region) -> bool {
    (0..2).all(|k| {
        corners.iter().any(|p| p[k] >= window.low[k]) && corners.iter().any(|p| p[k] <= window.high[k])
    })
}

/// The box of the circle of a triangle.
fn around([a, b, c]: [[f64; 2]; 3]) -> Region {
    let Some(center) = circumcenter(a, b, c) else { return Region::ALL };
    let radius = hypotenuse(center[0] - a[0], center[1] - a[1]) * (1.0 + MARGIN);
    Region { low: center.map(|x| x - radius), high: center.map(|x| x + radius) }
}
