//! Vertices by power: the least, the k least, and those up to some power.
//!
//! All follow edges (`locate/nearest.rs`): lifted, the vertices are those of a convex hull, and the power at a point is a height above a
//! plane. By distance edges may lead to a vertex that is not the nearest one, and hidden sites have none. So regular triangulations
//! have no [`crate::Ask`], which is by distance.
//!
//! Cost: location, and O(1) expected for the least, O(k log k) for k of them, and the size of the answer for a bound (up to logarithmic
//! factors, on evenly spread sites).

use std::cmp::Ordering;

use delone_predicates::{compare_powers, lexicographic};

use super::Regular2;
use crate::error::Error;
use crate::ids::{Place, VertexId};
use crate::locate::nearest::{self, Near};
use crate::plane::layer::Layer;
use crate::plane::layer::insert::Spot;
use crate::plane::layer::kernel::Power;
use crate::points::{Position2, finite};

/// Vertices by power.
struct ByPower<'a>(&'a Layer<Power>);

impl Near<[f64; 2]> for ByPower<'_> {
    fn nearer(&self, q: [f64; 2], a: Place, b: Place) -> Ordering {
        let [a, b] = [a, b].map(|p| self.0.site(p));
        compare_powers(q, a, b).then_with(|| lexicographic(a.0, b.0))
    }

    fn is_within(&self, q: [f64; 2], v: Place, power: f64) -> bool {
        // A site at `q` has its negative weight as its power there.
        compare_powers(q, self.0.site(v), (q, -power)).is_le()
    }

    fn beside(&self, v: Place, each: impl FnMut(Place)) {
        let mesh = &self.0.mesh;
        let around = mesh.lone.is_none().then(|| mesh.spokes(v));
        around.into_iter().flatten().map(|e| mesh.head(e)).filter(|w| !w.is_ghost()).for_each(each);
    }
}

impl Regular2 {
    /// The vertex with the least power at a point: the one whose power cell contains it; of several the one whose point is the
    /// smallest. None where there is no vertex. O(log n) on average on evenly spread sites.
    ///
    /// # Errors
    /// [`Error::Coordinate`] if a coordinate is not finite.
    ///
    /// ```
    /// use delone::Regular2;
    ///
    /// let r = Regular2::from_sites(&[([0, 0], 0.0), ([4, 0], 9.0), ([0, 4], 0.0)])?;
    /// assert_eq!(r.nearest([1, 0])?.map(|v| v.index()), Some(1)); // 3 * 3 - 9 < 1 * 1
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "nearest_power_vertex")]
    pub fn nearest<P: Position2>(&self, q: P) -> Result<Option<VertexId>, Error> {
        Ok(self.lowest(finite(q.xy())?).map(|place| self.mesh().name(place)))
    }

    /// The k vertices with the least powers at a point, the least first, ties as in [`Self::nearest`]; all of them if there are fewer.
    /// Hidden sites are not among them, whatever their power.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    ///
    /// ```
    /// use delone::Regular2;
    ///
    /// // The one further away is the heavier one.
    /// let r = Regular2::from_sites(&[([0, 0], 0.0), ([4, 0], 9.0)])?;
    /// let [a, b] = [0, 1].map(delone::VertexId::new);
    /// assert_eq!(r.k_nearest([0, 0], 5)?, [a, b]);
    /// assert_eq!(r.k_nearest([4, 0], 1)?, [b]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn k_nearest<P: Position2>(&self, q: P, k: usize) -> Result<Vec<VertexId>, Error> {
        let q = finite(q.xy())?;
        let found = nearest::k_nearest(&ByPower(&self.base), self.lowest(q), q, k);
        Ok(found.into_iter().map(|place| self.mesh().name(place)).collect())
    }

    /// The vertices whose power at a point is at most `power`, by increasing id: at 0 those whose disks hold the point. Hidden sites are
    /// not among them. Exact.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities, [`Error::Parameter`] for a power that is not finite.
    ///
    /// ```
    /// use delone::Regular2;
    ///
    /// let r = Regular2::from_sites(&[([0, 0], 1.0), ([4, 0], 9.0)])?;
    /// let [a, b] = [0, 1].map(delone::VertexId::new);
    /// assert_eq!((r.within([0, 0], 0.0)?, r.within([0, 0], 7.0)?), (vec![a], vec![a, b]));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn within<P: Position2>(&self, q: P, power: f64) -> Result<Vec<VertexId>, Error> {
        let q = finite(q.xy())?;
        if !power.is_finite() {
            return Err(Error::Parameter { name: "power", value: power, range: "finite" });
        }
        let found = nearest::within(&ByPower(&self.base), self.lowest(q), q, power);
        let mut names: Vec<VertexId> = found.into_iter().map(|place| self.mesh().name(place)).collect();
        names.sort_unstable();
        Ok(names)
    }

    /// The vertex with the least power at a point.
    fn lowest(&self, q: [f64; 2]) -> Option<Place> {
        let mesh = &self.base.mesh;
        let from = match self.spot(q).0 {
            Spot::Empty => return None,
            Spot::Vertex(v) | Spot::End(v) => v,
            Spot::BesidePoint => mesh.lone.unwrap_or(Place::new(0)),
            Spot::Segment(e) => mesh.tail(e),
            Spot::BesideLine(t) | Spot::Triangle(t) => {
                mesh.places(t).into_iter().find(|p| !p.is_ghost()).unwrap_or(Place::new(0))
            }
        };
        Some(nearest::descend(&ByPower(&self.base), from, q, &mut ()))
    }
}
