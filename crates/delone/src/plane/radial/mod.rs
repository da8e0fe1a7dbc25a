//! Nearest sites by the history of radial triangles.
//!
//! Each Voronoi cell is cut by rays from its site to its corners into *radial triangles*, one for each Delaunay
//! edge that leaves the site. While sites are inserted, all radial triangles that ever were are kept.
//! The *plane* of a site holds those that its insertion made: the *interior* ones around it, in angular order, and
//! for each neighbor three *exterior* ones in the neighbor's cell. A triangle that an insertion destroys points to
//! the interior triangle that the bisector of the old site and the new one borders. A query tests that bisector first: if
//! the old site stays nearer, one of the three exterior triangles beyond it is next, else a binary search in the plane.
//!
//! Source: Guibas, Knuth & Sharir, "Randomized incremental construction of Delaunay and Voronoi diagrams",
//! Algorithmica 1992, §5, with the pointers of the first remark after Theorem 5.4.
//!
//! Cost: O(n log n) expected to build, O(n) expected size (Theorems 5.3 and 5.2): sites are located by the structure itself, and a
//! new site is a random one, so that the site of a plane that is searched has 36 neighbors at most on average (Devillers 1998,
//! Lemma 1). O(log^2 n) expected for a query, whatever the sites, if they came in random order. A query on the border of two cells
//! looks at all neighbors of its site. Choose it for its bound; `Delaunay2::nearest` is faster on data of this world, and can
//! forget.

mod grow;
mod planes;

use delone_predicates::{compare_distances, lexicographic};

use super::layer::Layer;
use super::nearest::nearer;
use crate::error::Error;
use crate::ids::{Inserted, MAX_POINTS, Place};
use crate::mesh::Mesh2;
use crate::order::random::SplitMix;
use crate::points::{Position2, check_count, check_finite, finite};
use crate::sorting;
use crate::tally::Tally;
use grow::Found;
use planes::{INTERIOR, Planes, Radial};

/// A structure for nearest-site queries on a set that may grow.
///
/// ```
/// use delone::NearestSites2;
///
/// let mut sites = NearestSites2::from_points(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]], 1)?;
/// assert_eq!(sites.nearest([3.0, 1.0])?, Some(1));
/// assert_eq!(sites.nearest([2.0, 2.0])?, Some(0)); // all three are as near: the smallest
/// sites.insert([2.5, 2.0])?;
/// assert_eq!(sites.nearest([2.0, 2.0])?, Some(3));
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct NearestSites2 {
    /// The Delaunay triangulation of all sites, once they span the plane.
    layer: Layer,
    /// The sites that came while all were on one line, along it.
    line: Vec<Place>,
    /// The first site off that line.
    apex: Option<Place>,
    planes: Planes,
    /// For each directed edge its radial triangle.
    current: Vec<Radial>,
    /// For each site its seat in the last plane in which it has one.
    seats: Vec<planes::Seat>,
    triangles: usize,
}

impl NearestSites2 {
    /// The structure of no sites.
    pub fn new() -> Self {
        Self::default()
    }

    /// Builds the structure; the seed decides the random order.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate; [`Error::TooManyPoints`], also where there would be
    /// more than 2^32 radial triangles.
    pub fn from_points<P: Position2>(points: &[P], seed: u64) -> Result<Self, Error> {
        check_count(points.len(), MAX_POINTS)?;
        let points: Vec<[f64; 2]> = points.iter().map(Position2::xy).collect();
        check_finite(points.iter().copied())?;
        let mut order: Vec<usize> = (0..points.len()).collect();
        sorting::by(&mut order, |&i, &j| lexicographic(points[i], points[j]).then(i.cmp(&j)));
        order.dedup_by(|later, first| points[*later] == points[*first]);
        SplitMix(seed).shuffle(&mut order);
        let mut sites = Self { layer: Layer::new(Mesh2::empty(points.len()), points), ..Self::default() };
        let mut order = order.into_iter().map(Place::new).peekable();
        // What comes first is mostly two sites, and on a line all of them.
        while let Some(site) = order.next_if(|site| sites.is_on_line(sites.layer.points[site.index()])) {
            sites.line.push(site);
        }
        let points = &sites.layer.points;
        sorting::by(&mut sites.line, |v, w| lexicographic(points[v.index()], points[w.index()]));
        for site in order {
            let found = sites.find(sites.layer.points[site.index()]);
            sites.settle(site, found)?;
        }
        Ok(sites)
    }

    /// Adds a site. Its index is the number of points given before. Equal points given one by one are one site.
    ///
    /// Cost: a query, and O(1) changes, both expected if the sites come in random order, as in Theorems 5.2 to 5.4; in
    /// another order size and queries may grow, up to n^2 triangles and n planes, and answers are as right. As long as all
    /// sites are on one line, O(log n), and n places moved in memory.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities; [`Error::TooManyPoints`], also where there would be more than 2^32
    /// radial triangles. Nothing has changed then.
    ///
    /// ```
    /// use delone::{Inserted, NearestSites2};
    ///
    /// let mut sites = NearestSites2::new();
    /// let a = sites.insert([1.0, 1.0])?.vertex();
    /// assert_eq!(sites.insert([1.0, 1.0])?, Inserted::Existing(a));
    /// sites.insert([5.0, 1.0])?;
    /// assert_eq!(sites.nearest([4.0, 0.0])?, Some(1));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn insert<P: Position2>(&mut self, point: P) -> Result<Inserted, Error> {
        let q = finite(point.xy())?;
        let found = self.find(q);
        if let Found::Site(v) = found {
            return Ok(Inserted::Existing(v.same()));
        }
        let count = self.layer.points.len() + 1;
        check_count(count, MAX_POINTS)?;
        self.check_room()?;
        let site = self.layer.new_place(0, q);
        self.settle(site, found)?;
        Ok(Inserted::New(site.same()))
    }

    /// The index of the site nearest to a point; of several at the same distance the lexicographically smallest, of
    /// equal sites the first. `None` if there is none. Exact.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    pub fn nearest<P: Position2>(&self, q: P) -> Result<Option<usize>, Error> {
        self.nearest_observed(q, &mut ())
    }

    /// Does what [`Self::nearest`] does, and tells the planes visited, the comparisons of distances, and the rays asked.
    ///
    /// # Errors
    /// As [`Self::nearest`].
    pub fn nearest_observed<P: Position2, T: Tally>(
        &self,
        q: P,
        tally: &mut T,
    ) -> Result<Option<usize>, Error> {
        let q = finite(q.xy())?;
        if self.apex.is_none() {
            return Ok(self.nearest_on_line(q, tally).map(Place::index));
        }
        let [nearest, across] = self.planes.sides(self.trace(q, tally));
        let point = |v: Place| self.layer.points[v.index()];
        if across.is_ghost() {
            return Ok(Some(nearest.index()));
        }
        tally.compared();
        let is_border = compare_distances(q, point(nearest), point(across)).is_eq();
        Ok(Some(if is_border { self.smallest(nearest, q, tally) } else { nearest }.index()))
    }

    /// The smallest of the sites that are as near to `q` as this nearest one. They are on one circle around `q`, and joined.
    fn smallest<T: Tally>(&self, mut nearest: Place, q: [f64; 2], tally: &mut T) -> Place {
        loop {
            let mut best = nearest;
            for e in self.layer.mesh.spokes(nearest) {
                let w = self.layer.mesh.head(e);
                if !w.is_ghost() {
                    tally.compared();
                    best = if self.is_nearer(q, w, best) { w } else { best };
                }
            }
            if best == nearest {
                return nearest;
            }
            nearest = best;
        }
    }

    /// The number of radial triangles that ever were: O(n) expected.
    pub fn size(&self) -> usize {
        self.triangles
    }

    /// By distance, then lexicographically.
    fn is_nearer(&self, q: [f64; 2], v: Place, w: Place) -> bool {
        nearer(q, self.layer.points[v.index()], self.layer.points[w.index()]).is_lt()
    }

    /// The nearest of the sites on the line: along it distances fall, and then rise.
    fn nearest_on_line<T: Tally>(&self, q: [f64; 2], tally: &mut T) -> Option<Place> {
        let (mut low, mut high) = (0, self.line.len().saturating_sub(1));
        while low < high {
            let middle = low.midpoint(high);
            tally.compared();
            if self.is_nearer(q, self.line[middle], self.line[middle + 1]) {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        self.line.get(low).copied()
    }

    /// The present radial triangle that contains `q`, through all that contained it. Its site is a nearest one.
    fn trace<T: Tally>(&self, q: [f64; 2], tally: &mut T) -> Radial {
        let points = &self.layer.points;
        let first = self.nearest_on_line(q, tally).zip(self.apex).map(|(on_line, apex)| {
            tally.compared();
            if self.is_nearer(q, apex, on_line) { apex } else { on_line }
        });
        tally.visited();
        let mut at = self.planes.sector(points, first.unwrap_or(Place::new(0)), q, tally);
        loop {
            if self.is_present(at) {
                return at;
            }
            tally.visited();
            tally.compared();
            let seat = self.planes.destroyer(at);
            let [site, old] = self.planes.bisector(seat);
            at = if self.is_nearer(q, site, old) {
                self.planes.sector(points, site, q, tally)
            } else {
                self.planes.exterior(points, seat, q, tally)
            };
        }
    }

    fn is_present(&self, r: Radial) -> bool {
        self.current.get(self.planes.edge(r).index()) == Some(&r)
    }
}
