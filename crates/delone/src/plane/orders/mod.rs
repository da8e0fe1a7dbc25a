//! Voronoi diagrams of higher order: the plane by the set of the k nearest sites.
//!
//! A region of order k is where the same k sites are nearest. Order 1 is the Voronoi diagram, order n - 1 of n sites that of
//! the furthest one. Its corners are centers of circles through three sites with k - 1 or k - 2 others inside; its unbounded
//! regions are the *k-sets*, which a line cuts off from all other sites.
//!
//! Source: Shamos & Hoey, "Closest-point problems", FOCS 1975; Lee 1982 for how it is made (`grow.rs`). Guibas, Knuth and Sharir
//! count its edges (§4.2, Lemma 4.3).
//!
//! Cost: of n sites with u unbounded regions of all orders below there are (2k - 1) n - k^2 + 1 - u regions, O(k n). Made order
//! by order: O(k^2 n) expected on evenly spread sites, and O(k) a region for its sites.

mod canonical;
mod cells;
mod circle;
mod grow;
mod line;
mod locate;

pub use cells::OrderCells2;
pub use circle::{Exchange, OrderCircle2, OrderRegion2};

use super::Delaunay2;
use crate::error::Error;
use crate::ids::VertexId;
use crate::mesh::Dimension;
use circle::Circle;

/// The largest number of circles of one order, old and new: each has four 32-bit indices of edges.
const MAX_CIRCLES: usize = 1 << 30;

/// The Voronoi diagram of one order.
///
/// It is a function of the set of points alone, as the triangulation is: of four sites on one circle the lexicographically
/// largest counts as further away. So where sites are cocircular a region may be no more than a point or a segment.
///
/// ```
/// use delone::{Delaunay2, Region2};
///
/// let d = Delaunay2::from_points(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 3.0], [2.0, 1.0]])?;
/// let order = d.order(2)?;
/// let nearest = order.locate([1.0, 0.0])?;
/// assert_eq!(nearest.sites().iter().map(|v| v.index()).collect::<Vec<_>>(), [0, 4]);
/// for region in order.regions() {
///     println!("{:?} is bounded: {}", region.sites(), region.is_bounded());
/// }
/// let cells = order.cells(&Region2::rectangle([0.0, 0.0], [4.0, 4.0])?);
/// let area: f64 = order.regions().map(|region| cells.area(region)).sum();
/// assert!((area - 16.0).abs() < 1e-12);
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct OrderK2<'a> {
    triangulation: &'a Delaunay2,
    order: usize,
    /// For each region its sites, sorted; the regions are sorted by them.
    sites: Vec<VertexId>,
    /// Sorted by the regions around them.
    circles: Vec<Circle>,
    /// Where the corners of each region start, and the end of the last.
    starts: Vec<u32>,
    /// The corners of each region, counter-clockwise: three times the circle, and the corner of the circle.
    corners: Vec<u32>,
}

impl Delaunay2 {
    /// The Voronoi diagram of order k: for k of the n vertices where they are the k nearest ones, if that is anywhere.
    ///
    /// O(k^2 n) expected on evenly spread vertices; the circles of two orders are in memory at once, about 16 bytes times
    /// 4 k n each. For orders close to n see [`Furthest2`](crate::Furthest2).
    ///
    /// # Errors
    /// [`Error::Parameter`] for an order that is 0 or larger than the number of vertices; [`Error::TooManyCircles`] beyond
    /// 2^30 of them.
    pub fn order(&self, k: usize) -> Result<OrderK2<'_>, Error> {
        if k == 0 || k > self.vertex_count() {
            let range = "at least 1 and at most the number of vertices";
            return Err(Error::Parameter { name: "the order", value: k as f64, range });
        }
        if k == self.vertex_count() || self.dimension() != Dimension::Plane {
            return Ok(line::windows(self, k));
        }
        Ok(canonical::from_complex(self, &grow::grow(&self.base, k)?))
    }
}

impl<'a> OrderK2<'a> {
    /// The triangulation of its sites.
    pub fn triangulation(&self) -> &'a Delaunay2 {
        self.triangulation
    }

    /// How many sites a region has.
    pub fn order(&self) -> usize {
        self.order
    }

    /// The number of regions.
    pub fn region_count(&self) -> usize {
        self.starts.len() - 1
    }

    /// All regions, sorted by their sites.
    pub fn regions(&self) -> impl ExactSizeIterator<Item = OrderRegion2<'_>> + Clone {
        (0..self.region_count()).map(|index| OrderRegion2 { diagram: self, index })
    }

    /// The region where a set of sites is nearest, sorted or not. `None` if there is none.
    ///
    /// O(k log n).
    pub fn region(&self, sites: &[VertexId]) -> Option<OrderRegion2<'_>> {
        let mut sites = sites.to_vec();
        sites.sort_unstable();
        self.region_of_sorted(&sites)
    }

    /// The circles with k - 1 and k - 2 sites inside, which regions have their corners at: each once, in an order that depends
    /// on the set alone.
    pub fn circles(&self) -> impl Iterator<Item = OrderCircle2<'_>> + Clone {
        let all = (0..self.circles.len()).map(|index| OrderCircle2 { diagram: self, index });
        all.filter(|circle| circle.is_finite())
    }

    /// The sites of the region with an index.
    fn sites_of(&self, region: usize) -> &[VertexId] {
        &self.sites[region * self.order..][..self.order]
    }

    fn region_of_sorted(&self, sites: &[VertexId]) -> Option<OrderRegion2<'_>> {
        if sites.len() != self.order {
            return None;
        }
        let (mut low, mut high) = (0, self.region_count());
        while low < high {
            let middle = usize::midpoint(low, high);
            match self.sites_of(middle).cmp(sites) {
                std::cmp::Ordering::Less => low = middle + 1,
                std::cmp::Ordering::Equal => return Some(OrderRegion2 { diagram: self, index: middle }),
                std::cmp::Ordering::Greater => high = middle,
            }
        }
        None
    }
}
