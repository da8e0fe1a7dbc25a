//! Values between the vertices of a triangulation, one point after the other.
//!
//! Cost: location, O(1) expected where a point is near the one before; then O(1) for [`Interpolator::linear`], O(k log k) for k
//! natural neighbors, which are six on average in the plane and fifteen in space.

use super::border;
use super::linear;
use super::natural::{Cell, Measure, compare, three};
use crate::around::{Around, Surround};
use crate::error::Error;
use crate::ids::VertexId;
use crate::sorting;
use crate::triangulation::{Ask, Found};

/// The values outside of the hull.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Outside {
    /// Nothing.
    #[default]
    Nothing,
    /// The value of the nearest vertex.
    Nearest,
    /// The value at the nearest point of the hull, so that values are continuous across it. Where points span less than the plane or space that of
    /// the nearest vertex.
    Hull,
}

/// From so many points on the box of the hull is looked for before the first: it takes as long as a few of them.
const POINTS_FOR_A_BOX: usize = 1000;

/// How values come about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Method {
    Nearest,
    Linear,
    Natural(Measure),
}

/// Interpolates values at the vertices of a triangulation: the nearest one, linear in triangles and tetrahedra, or natural neighbors
/// in the sense of Laplace or of Sibson, which are smooth but at the vertices.
///
/// At a vertex there is its value. On the hull everything is linear, and outside there is nothing, unless [`Self::outside`] asks for
/// it. A point that was computed to be on the hull is mostly beside it, because its coordinates are rounded: what is outside by no more than 2^-48 of the
/// largest coordinate has the value of the nearest point of the hull. Which vertices take part is exact; weights are rounded, are never negative and have the sum one; all methods but the nearest
/// vertex reproduce linear functions. Where points span less than the plane or space, everything is linear on their line, or in their plane.
///
/// It remembers where it was, so points should follow each other in space. It borrows the triangulation, so each thread can have one.
///
/// ```
/// use delone::{Delaunay2, surface::Interpolator};
///
/// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4], [2, 1]])?;
/// let heights = [0.0, 4.0, 4.0, 0.0, 2.0]; // x
/// for mut f in [Interpolator::linear(&d), Interpolator::laplace(&d), Interpolator::sibson(&d)] {
///     assert!((f.value([2.5, 2.5], &heights)?.unwrap() - 2.5).abs() < 1e-12);
///     assert_eq!(f.value([2.0, 1.0], &heights)?, Some(2.0));
///     assert_eq!(f.value([5.0, 1.0], &heights)?, None);
/// }
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Debug)]
pub struct Interpolator<'t, T: Ask> {
    d: &'t T,
    method: Method,
    outside: Outside,
    /// How a point is found, and what surrounds it.
    find: Find<T>,
    near: Option<T::Simplex>,
    around: Around<T>,
    cell: Cell,
    corners: Vec<(VertexId, T::Point)>,
    weights: Vec<(VertexId, f64)>,
    /// Where the weights are those of: the point, or the nearest one of the hull.
    place: T::Point,
    /// The box of the hull, where many points are asked for: beyond it nothing is on the border.
    surroundings: Option<[T::Point; 2]>,
}

impl<T: Ask> Clone for Interpolator<'_, T> {
    /// Another one for the same triangulation, which has been nowhere yet.
    fn clone(&self) -> Self {
        let new = Self::new(self.d, self.method, self.find);
        Self { outside: self.outside, surroundings: self.surroundings, ..new }
    }
}

/// Finds a point near a simplex, and what surrounds it if that is wanted.
type Find<T> = fn(
    &T,
    Option<<T as crate::Triangulation>::Simplex>,
    <T as crate::Triangulation>::Point,
    Option<&mut Around<T>>,
) -> Result<Found<<T as crate::Triangulation>::Simplex>, Error>;

fn by_location<T: Ask>(
    d: &T,
    _: Option<T::Simplex>,
    q: T::Point,
    _: Option<&mut Around<T>>,
) -> Result<Found<T::Simplex>, Error> {
    d.find(q)
}

fn by_walk<T: Surround>(
    d: &T,
    near: Option<T::Simplex>,
    q: T::Point,
    around: Option<&mut Around<T>>,
) -> Result<Found<T::Simplex>, Error> {
    match around {
        Some(around) => d.surround(near, q, around),
        None => d.find_near(near, q),
    }
}

impl<'t, T: Surround> Interpolator<'t, T> {
    /// Linear in each triangle or tetrahedron.
    ///
    /// ```
    /// use delone::{Delaunay2, surface::Interpolator};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4]])?;
    /// let heights = [0.0, 4.0, 8.0, 4.0]; // x + y
    /// assert_eq!(Interpolator::linear(&d).value([1.0, 2.0], &heights)?, Some(3.0));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn linear(d: &'t T) -> Self {
        Self::new(d, Method::Linear, by_walk)
    }

    /// Natural neighbors, each with the size of the facet between its cell and that of the point, over their distance.
    ///
    /// ```
    /// use delone::{Delaunay2, surface::Interpolator};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4]])?;
    /// let heights = [0.0, 4.0, 8.0, 4.0]; // x + y
    /// let between = Interpolator::laplace(&d).value([1.0, 2.0], &heights)?;
    /// assert!(between.is_some_and(|z| (z - 3.0).abs() < 1e-12));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn laplace(d: &'t T) -> Self {
        Self::new(d, Method::Natural(Measure::Laplace), by_walk)
    }

    /// Natural neighbors, each with what the cell of the point takes from its cell: the area, or the volume. Continuously
    /// differentiable but at vertices.
    ///
    /// ```
    /// use delone::{Delaunay2, surface::Interpolator};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4]])?;
    /// let heights = [0.0, 4.0, 8.0, 4.0]; // x + y
    /// let between = Interpolator::sibson(&d).value([1.0, 2.0], &heights)?;
    /// assert!(between.is_some_and(|z| (z - 3.0).abs() < 1e-12));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn sibson(d: &'t T) -> Self {
        Self::new(d, Method::Natural(Measure::Sibson), by_walk)
    }
}

impl<'t, T: Ask> Interpolator<'t, T> {
    /// The value of the nearest vertex.
    ///
    /// ```
    /// use delone::{Delaunay2, surface::Interpolator};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4]])?;
    /// let heights = [0.0, 4.0, 8.0, 4.0]; // x + y
    /// assert_eq!(Interpolator::nearest(&d).value([1.0, 1.5], &heights)?, Some(0.0));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn nearest(d: &'t T) -> Self {
        Self::new(d, Method::Nearest, by_location)
    }

    /// Linear in each triangle, of a triangulation of any kind: with constraints, say. Each point is located anew.
    ///
    /// ```
    /// use delone::{Constrained2, surface::Interpolator};
    ///
    /// let c = Constrained2::from_parts(&[[0, 0], [4, 0], [4, 4], [0, 4]], &[[0, 2]])?; // a valley that no height is across
    /// let heights = [0.0, 9.0, 0.0, 9.0];
    /// assert_eq!(Interpolator::linear_in(&c).value([2.0, 2.0], &heights)?, Some(0.0));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn linear_in(d: &'t T) -> Self {
        Self::new(d, Method::Linear, by_location)
    }

    fn new(d: &'t T, method: Method, find: Find<T>) -> Self {
        Self {
            d,
            method,
            outside: Outside::default(),
            find,
            near: None,
            around: Around::default(),
            cell: Cell::default(),
            corners: Vec::new(),
            weights: Vec::new(),
            place: T::Point::default(),
            surroundings: None,
        }
    }

    /// Says what there is outside of the hull.
    ///
    /// ```
    /// use delone::{Delaunay2, surface::{Interpolator, Outside}};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4]])?;
    /// let heights = [0.0, 4.0, 8.0, 4.0]; // x + y
    /// let mut f = Interpolator::linear(&d);
    /// assert_eq!(f.value([6.0, 2.0], &heights)?, None);
    /// assert_eq!(f.outside(Outside::Hull).value([6.0, 2.0], &heights)?, Some(6.0)); // as at 4, 2
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[must_use]
    pub fn outside(self, outside: Outside) -> Self {
        Self { outside, ..self }
    }

    /// The triangulation.
    pub fn triangulation(&self) -> &'t T {
        self.d
    }

    /// The weights of vertices at a point: positive or zero, with the sum one; none outside. They come in an order that depends on the
    /// points alone (natural neighbors of the plane counter-clockwise, from the lexicographically least one on; all others in
    /// lexicographic order), and with the same bits from every triangulation of the same points.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    ///
    /// ```
    /// use delone::{Delaunay2, surface::Interpolator};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4]])?;
    /// let mut f = Interpolator::sibson(&d);
    /// let weights: Vec<f64> = f.weights([2.0, 2.0])?.iter().map(|weight| weight.1).collect();
    /// assert_eq!(weights, [0.25; 4]); // all four, whichever diagonal there is
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn weights(&mut self, q: T::Point) -> Result<&[(VertexId, f64)], Error> {
        self.weights.clear();
        let around = matches!(self.method, Method::Natural(_)).then_some(&mut self.around);
        let found = (self.find)(self.d, self.near, q, around)?;
        self.near = found.simplex.or(self.near);
        self.place = q;
        if found.is_outside {
            self.beyond(q)?;
            return Ok(&self.weights);
        }
        if self.method == Method::Nearest && !found.face().is_empty() {
            self.weights.extend(self.d.nearest_observed(q, &mut ())?.map(|v| (v, 1.0)));
            return Ok(&self.weights);
        }
        if let Method::Natural(measure) = self.method
            && !self.around.cavity().is_empty()
            && self.cell.weigh(self.d, &self.around, q, measure, &mut self.weights)
        {
            return Ok(&self.weights);
        }
        self.corners.clear();
        let point = |&v: &VertexId| (v, self.d.position(v).unwrap_or_default());
        self.corners.extend(found.face().iter().map(point));
        sorting::by(&mut self.corners, |a, b| compare(three(a.1), three(b.1)));
        linear::weigh(q, &self.corners, &mut self.weights);
        Ok(&self.weights)
    }

    /// Another one, for so many points: if they are many the box of the hull tells most of what is outside.
    pub(super) fn for_many(&self, points: usize) -> Self {
        let is_worth_a_box = points >= POINTS_FOR_A_BOX && self.outside == Outside::Nothing;
        let surroundings = if is_worth_a_box { border::corners_of_box(self.d) } else { None };
        Self { surroundings, ..self.clone() }
    }

    /// The weights at a point outside, if there are any.
    fn beyond(&mut self, q: T::Point) -> Result<(), Error> {
        let is_far = self.surroundings.is_some_and(|corners| border::is_far(q, corners));
        if self.outside == Outside::Nothing && is_far {
            return Ok(());
        }
        let facet = self.d.find(q)?;
        self.corners.clear();
        let point = |&v: &VertexId| (v, self.d.position(v).unwrap_or_default());
        self.corners.extend(facet.face().iter().map(point));
        // What is nearest must not depend on which corner comes first.
        sorting::by(&mut self.corners, |a, b| compare(three(a.1), three(b.1)));
        let points: Vec<T::Point> = self.corners.iter().map(|corner| corner.1).collect();
        let on_hull = (!points.is_empty()).then(|| border::nearest(q, &points));
        match on_hull.filter(|on_hull| on_hull.is_rounding || self.outside == Outside::Hull) {
            Some(on_hull) if self.method != Method::Nearest => {
                self.place = on_hull.point;
                let corners = self.corners.iter().zip(on_hull.weights);
                self.weights.extend(corners.map(|(corner, weight)| (corner.0, weight)).filter(|w| w.1 > 0.0));
            }
            on_hull if on_hull.is_some() || self.outside != Outside::Nothing => {
                let from = on_hull.map_or(q, |on_hull| on_hull.point);
                self.weights.extend(self.d.nearest_observed(from, &mut ())?.map(|v| (v, 1.0)));
            }
            _ => {}
        }
        Ok(())
    }

    /// The weights asked for last, and where they are those of: the point itself, or outside the nearest one of the hull.
    pub(super) fn found(&self) -> (T::Point, &[(VertexId, f64)]) {
        (self.place, &self.weights)
    }

    /// The value at a point, of values by the index of their vertex; `None` outside.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities; [`Error::Values`] if there are not as many values as ids of vertices.
    ///
    /// ```
    /// use delone::{Delaunay2, surface::Interpolator};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4]])?;
    /// let heights = [0.0, 4.0, 8.0, 4.0]; // x + y
    /// let mut f = Interpolator::sibson(&d); // it is near where it was: the next point is found fast
    /// assert_eq!(f.value([4.0, 4.0], &heights)?, Some(8.0));
    /// assert_eq!(f.value([5.0, 4.0], &heights)?, None);
    /// assert!(f.value([0.0, 0.0], &[1.0]).is_err()); // a value for each vertex
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn value(&mut self, q: T::Point, values: &[f64]) -> Result<Option<f64>, Error> {
        check_values(self.d, values.len(), 1)?;
        let weights = self.weights(q)?;
        Ok((!weights.is_empty()).then(|| blend(weights, |v| values[v])))
    }

    /// Interpolates many values at each vertex, a row for each, into a row; tells whether there are any.
    ///
    /// # Errors
    /// As [`Self::value`].
    ///
    /// ```
    /// use delone::{Delaunay2, surface::Interpolator};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [2, 0], [0, 2]])?;
    /// let table = [0.0, 5.0, 2.0, 7.0, 4.0, 9.0]; // two values at each vertex
    /// let mut row = [0.0; 2];
    /// assert!(Interpolator::linear(&d).values([1.0, 0.0], &table, &mut row)?);
    /// assert_eq!(row, [1.0, 6.0]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn values(&mut self, q: T::Point, table: &[f64], row: &mut [f64]) -> Result<bool, Error> {
        let columns = row.len();
        check_values(self.d, table.len(), columns)?;
        let weights = self.weights(q)?;
        for (column, value) in row.iter_mut().enumerate() {
            *value = blend(weights, |v| table[v * columns + column]);
        }
        Ok(!weights.is_empty())
    }
}

/// Whether there is a row of values for each id.
pub(super) fn check_values<T: Ask>(d: &T, count: usize, columns: usize) -> Result<(), Error> {
    let expected = d.ids_given() * columns;
    if count == expected { Ok(()) } else { Err(Error::Values { expected, found: count }) }
}

/// A weighted mean of values by vertex: one value is itself.
#[inline]
pub(super) fn blend(weights: &[(VertexId, f64)], value: impl Fn(usize) -> f64) -> f64 {
    match weights {
        [(v, _)] => value(v.index()),
        _ => weights.iter().filter(|weight| weight.1 != 0.0).map(|(v, w)| w * value(v.index())).sum(),
    }
}
