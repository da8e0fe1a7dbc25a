//! Nearest sites by the history of radial triangles.
//!
//! Each Voronoi cell is cut by rays from its site to its corners into *radial triangles*, one for each Delaunay
//! edge that leaves the site. While sites are inserted in random order, all radial triangles that ever were are kept.
//! The *plane* of a site holds those that its insertion made: the *interior* ones around it, in angular order, and
//! for each neighbour three *exterior* ones in the neighbour's cell. A triangle that an insertion destroys points to
//! the plane of the inserted site. A query follows these pointers: of the two sites the nearer one is taken, and its
//! triangle found by binary search in the plane, or among the three.
//!
//! Source: Guibas, Knuth & Sharir, "Randomized incremental construction of Delaunay and Voronoi diagrams",
//! Algorithmica 1992, §5. Rays are never computed: on which side of one a point is, an exact predicate says.
//!
//! Cost: O(n log^2 n) expected to build (sites are located by the structure itself), O(n) expected size; O(log^2 n)
//! expected for a query, whatever the sites. Choose it for its bound; `Delaunay2::nearest` is faster on data of
//! this world, and can change.

use delone_predicates::{Sign, angle, centre_direction, centre_side, lexicographic, orient2d};

use super::layer::Layer;
use super::nearest::nearer;

use crate::error::Error;
use crate::ids::{EdgeId, MAX_POINTS, Place};
use crate::locate::{Start, Walk};
use crate::mesh::Mesh2;
use crate::order::random::SplitMix;
use crate::points::{Position2, finite};
use crate::points::{check_count, check_finite};
use crate::tally::Tally;

/// Not destroyed; no triangle.
const NONE: u32 = u32::MAX;
/// Triangles for each neighbour in a plane: the interior one, and in the neighbour's cell those towards the following
/// neighbour, the site, and the neighbour before.
const KINDS: usize = 4;
const INTERIOR: usize = 0;
const FOLLOWING: usize = 1;
const TO_SITE: usize = 2;
const BEFORE: usize = 3;

/// A structure for nearest-site queries on a fixed set.
///
/// ```
/// use delone::NearestSites2;
///
/// let sites = NearestSites2::from_points(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]], 1)?;
/// assert_eq!(sites.nearest([3.0, 1.0])?, Some(1));
/// assert_eq!(sites.nearest([2.0, 2.0])?, Some(0)); // all three are as near: the smallest
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct NearestSites2 {
    /// The Delaunay triangulation in the end.
    layer: Layer,
    /// For each site its plane.
    planes: Vec<Plane>,
    /// Of all planes the neighbours, counter-clockwise around the site.
    neighbors: Vec<Place>,
    /// For each of them the corner across the edge from it to the following neighbour.
    beyond: Vec<Place>,
    /// For each of them the destroyers of its radial triangles.
    destroyers: Vec<[u32; KINDS]>,
    /// The sites of the first triangle; or all sites in their order, if they are on one line.
    first: Vec<Place>,
    triangles: usize,
}

/// The neighbours of a site when it was inserted, turned so that the rays between them begin in the upper half-plane.
#[derive(Clone, Copy, Debug, Default)]
struct Plane {
    start: u32,
    count: u32,
    /// How many rays are in the upper half-plane: the ray k is between the neighbours k and k + 1.
    upper: u32,
}

impl NearestSites2 {
    /// Builds the structure; the seed decides the random order.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate; [`Error::TooManyPoints`].
    pub fn from_points<P: Position2>(points: &[P], seed: u64) -> Result<Self, Error> {
        check_count(points.len(), MAX_POINTS)?;
        let points: Vec<[f64; 2]> = points.iter().map(Position2::xy).collect();
        check_finite(points.iter().copied())?;
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_unstable_by(|&i, &j| lexicographic(points[i], points[j]).then(i.cmp(&j)));
        order.dedup_by(|later, first| points[*later] == points[*first]);
        let places = |order: &[usize]| order.iter().map(|&i| Place::new(i)).collect();
        let mut sites = Self {
            layer: Layer::default(),
            planes: vec![Plane::default(); points.len()],
            neighbors: Vec::new(),
            beyond: Vec::new(),
            destroyers: Vec::new(),
            first: places(&order),
            triangles: 0,
        };
        SplitMix(seed).shuffle(&mut order);
        let off_line = |&k: &usize| !orient2d(points[order[0]], points[order[1]], points[order[k]]).is_zero();
        let third = (2..order.len()).find(off_line);
        sites.layer = Layer::new(Mesh2::empty(points.len()), points);
        if let Some(third) = third {
            order.swap(2, third);
            sites.first = places(&order[..3]);
            sites.insert_all(&order);
        }
        Ok(sites)
    }

    fn insert_all(&mut self, order: &[usize]) {
        for &i in &order[..3] {
            let (spot, _) = self.layer.spot(Start::Anywhere, self.layer.points[i], &mut ());
            self.layer.insert_at(Place::new(i), spot, &mut ());
        }
        // For each directed edge its radial triangle.
        let mut current = Vec::new();
        for site in self.first.clone() {
            let star: Vec<EdgeId> = self.layer.mesh.spokes(site).collect();
            let around: Vec<Place> = star.iter().map(|&e| self.layer.mesh.head(e)).collect();
            let turn = self.add_plane(site, &around, &vec![Place::GHOST; around.len()]);
            for (k, &e) in star.iter().enumerate() {
                remember(&mut current, e, self.node(site, turn(k), INTERIOR));
            }
        }
        self.triangles = self.neighbors.len();
        let (mut around, mut beyond) = (Vec::new(), Vec::new());
        for &i in &order[3..] {
            let (site, q) = (Place::new(i), self.layer.points[i]);
            let nearest = self.trace(q, &mut ());
            let start = Start::At(self.layer.mesh.incident[nearest.index()], Walk::Visibility);
            let (spot, _) = self.layer.spot(start, q, &mut ());
            self.layer.insert_at(site, spot, &mut ());

            let (triangles, border) = self.layer.cavity.last();
            let destroyed =
                triangles[..triangles.len() - 2].iter().flat_map(|t| [0, 1, 2].map(|k| t.edge(k)));
            for e in destroyed.chain(border.iter().map(|&(_, outside)| outside)) {
                if let Some(&node) = current.get(e.index()).filter(|node| **node != NONE) {
                    self.destroyers[node as usize / KINDS][node as usize % KINDS] = i as u32;
                }
            }
            around.clear();
            around.extend(border.iter().map(|&(place, _)| place));
            beyond.clear();
            beyond.extend(border.iter().map(|&(_, outside)| self.layer.mesh.tip(outside)));
            let border: Vec<(EdgeId, EdgeId)> =
                triangles.iter().zip(border).map(|(t, &(_, outside))| (t.edge(0), outside)).collect();
            let turn = self.add_plane(site, &around, &beyond);
            self.triangles += KINDS * around.len();
            for (k, (edge, outside)) in border.into_iter().enumerate() {
                let (own, following) = (turn(k), turn(k + 1));
                remember(&mut current, edge, self.node(site, own, FOLLOWING));
                remember(&mut current, edge.next(), self.node(site, following, TO_SITE));
                remember(&mut current, edge.previous(), self.node(site, own, INTERIOR));
                remember(&mut current, outside, self.node(site, following, BEFORE));
            }
        }
    }

    /// Adds the plane of a site; says to which number in the plane a number in the lists given goes.
    fn add_plane(
        &mut self,
        site: Place,
        around: &[Place],
        beyond: &[Place],
    ) -> impl Fn(usize) -> usize + use<> {
        let count = around.len();
        let is_upper = |k: usize| self.is_upper(site, around[k % count], around[(k + 1) % count]);
        let first = (0..count).find(|&k| is_upper(k) && !is_upper(k + count - 1)).unwrap_or(0);
        let upper = (0..count).filter(|&k| is_upper(k)).count();
        let start = self.neighbors.len();
        self.planes[site.index()] = Plane { start: start as u32, count: count as u32, upper: upper as u32 };
        let turned = |list: &[Place]| list[first..].iter().chain(&list[..first]).copied().collect::<Vec<_>>();
        self.neighbors.extend(turned(around));
        self.beyond.extend(turned(beyond));
        self.destroyers.resize(self.neighbors.len(), [NONE; KINDS]);
        move |k| (k + count - first) % count
    }

    fn node(&self, site: Place, k: usize, kind: usize) -> u32 {
        (KINDS * (self.planes[site.index()].start as usize + k) + kind) as u32
    }

    /// Whether the ray from `o` to the circumcentre of the triangle `o`, `a`, `b` points up, or to the right.
    fn is_upper(&self, o: Place, a: Place, b: Place) -> bool {
        let point = |v: Place| self.layer.points[v.index()];
        let [x, y] = if b.is_ghost() {
            outward(point(a), point(o))
        } else if a.is_ghost() {
            outward(point(o), point(b))
        } else {
            centre_direction(point(o), point(a), point(b))
        };
        y.is_positive() || (y.is_zero() && x.is_positive())
    }

    /// Whether `q` is on that ray, or on its left.
    fn is_from<T: Tally>(&self, [o, a, b]: [Place; 3], q: [f64; 2], tally: &mut T) -> bool {
        let point = |v: Place| self.layer.points[v.index()];
        tally.orientation();
        // The centre of a ghost is far away, square to its hull edge.
        if b.is_ghost() {
            !angle(point(o), point(a), q).is_positive()
        } else if a.is_ghost() {
            !angle(point(o), point(b), q).is_negative()
        } else {
            !centre_side(point(o), point(a), point(b), q).is_negative()
        }
    }

    /// The number of the interior triangle of a plane in whose angle `q` is.
    fn sector<T: Tally>(&self, site: Place, q: [f64; 2], tally: &mut T) -> usize {
        let Plane { start, count, upper } = self.planes[site.index()];
        let (start, count, upper) = (start as usize, count as usize, upper as usize);
        let around = &self.neighbors[start..start + count];
        let [x, y] = self.layer.points[site.index()];
        let (mut low, mut high) =
            if q[1] > y || (q[1] == y && q[0] > x) { (0, upper) } else { (upper, count) };
        // Rays of one half-plane are less than half a turn apart.
        while low < high {
            let middle = low.midpoint(high);
            if self.is_from([site, around[middle], around[(middle + 1) % count]], q, tally) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        low % count
    }

    /// The exterior triangle in the cell of the neighbour `k` of a plane in whose angle `q` is.
    fn exterior<T: Tally>(&self, site: Place, k: usize, q: [f64; 2], tally: &mut T) -> usize {
        let Plane { start, count, .. } = self.planes[site.index()];
        let (start, count) = (start as usize, count as usize);
        let [before, own, following] = [k + count - 1, k, k + 1].map(|k| self.neighbors[start + k % count]);
        let from_site = self.is_from([own, following, site], q, tally);
        if from_site && !self.is_from([own, site, before], q, tally) {
            TO_SITE
        } else if !from_site && self.is_from([own, self.beyond[start + k], following], q, tally) {
            FOLLOWING
        } else {
            BEFORE
        }
    }

    /// A site nearest to `q`, through all radial triangles that contain it.
    fn trace<T: Tally>(&self, q: [f64; 2], tally: &mut T) -> Place {
        let point = |v: Place| self.layer.points[v.index()];
        let mut nearest = self.first[0];
        for &site in &self.first[1..] {
            tally.compared();
            if nearer(q, point(site), point(nearest)).is_lt() {
                nearest = site;
            }
        }
        tally.visited();
        let mut node = self.node(nearest, self.sector(nearest, q, tally), INTERIOR) as usize;
        loop {
            let destroyer = self.destroyers[node / KINDS][node % KINDS];
            if destroyer == NONE {
                return nearest;
            }
            tally.visited();
            tally.compared();
            let site = Place::new(destroyer as usize);
            let plane = self.planes[site.index()];
            let k = self.sector(site, q, tally);
            if nearer(q, point(site), point(nearest)).is_lt() {
                nearest = site;
                node = self.node(site, k, INTERIOR) as usize;
            } else {
                // Mostly the neighbour at the base of that triangle.
                let around = &self.neighbors[plane.start as usize..][..plane.count as usize];
                let k =
                    if around[k] == nearest { Some(k) } else { around.iter().position(|&w| w == nearest) };
                let Some(k) = k else {
                    debug_assert!(false, "who destroys a triangle is a neighbour");
                    return nearest;
                };
                node = self.node(site, k, self.exterior(site, k, q, tally)) as usize;
            }
        }
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
        let point = |v: Place| self.layer.points[v.index()];
        let better = |v: Place, w: Place| if nearer(q, point(w), point(v)).is_lt() { w } else { v };
        if self.neighbors.is_empty() {
            // Along a line distances fall, and then rise.
            let rises = |i: usize| nearer(q, point(self.first[i]), point(self.first[i + 1])).is_lt();
            let (mut low, mut high) = (0, self.first.len().saturating_sub(1));
            while low < high {
                let middle = low.midpoint(high);
                tally.compared();
                if rises(middle) { high = middle } else { low = middle + 1 }
            }
            return Ok(self.first.get(low).map(|v| v.index()));
        }
        let mut nearest = self.trace(q, tally);
        // Sites at the same distance are on one circle around the query, and joined.
        loop {
            let mesh = &self.layer.mesh;
            let joined = mesh.spokes(nearest).map(|e| mesh.head(e)).filter(|w| !w.is_ghost());
            let best = joined.fold(nearest, better);
            if best == nearest {
                return Ok(Some(nearest.index()));
            }
            nearest = best;
        }
    }

    /// The number of radial triangles that ever were: O(n) expected.
    pub fn size(&self) -> usize {
        self.triangles
    }
}

/// The signs of the direction square to a hull edge from `a` to `b`, away from the hull.
fn outward(a: [f64; 2], b: [f64; 2]) -> [Sign; 2] {
    [Sign::of(&b[1], &a[1]), Sign::of(&a[0], &b[0])]
}

/// Remembers the radial triangle of a directed edge.
fn remember(current: &mut Vec<u32>, e: EdgeId, node: u32) {
    if current.len() <= e.index() {
        current.resize(e.index() + 1, NONE);
    }
    current[e.index()] = node;
}

#[cfg(test)]
mod tests {
    use delone_generators::Kind;
    use delone_predicates::compare_distances;

    use super::NearestSites2;

    /// By the history alone: not one step along edges is needed at the end, but for ties.
    #[test]
    fn the_history_leads_to_a_nearest_site() {
        for kind in [Kind::Uniform, Kind::Clusters, Kind::Grid, Kind::Circle, Kind::UnitCircle] {
            for n in [5, 40, 200] {
                let points = kind.points(n, 1);
                let sites = NearestSites2::from_points(&points, 2).expect("finite");
                let mut queries = kind.points(200, 9);
                queries.extend(points.iter().copied());
                queries.extend([[1e3, 1.0], [-1e3, 0.25], [0.5, 1e3], [0.25, -1e3]]);
                for q in queries.into_iter().flat_map(|q| [q, q.map(|x| 0.5 * x), [2.0 * q[0], -q[1]]]) {
                    let found = points[sites.trace(q, &mut ()).index()];
                    let is_nearest = points.iter().all(|&p| compare_distances(q, found, p).is_le());
                    assert!(is_nearest, "{kind:?} {n} {q:?}");
                }
            }
        }
    }
}
