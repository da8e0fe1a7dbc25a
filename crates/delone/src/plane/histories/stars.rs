//! The history without intermediate triangles: a version is searched, not traced.
//!
//! Source: Guibas, Knuth & Sharir, Algorithmica 1992, the remark in §3 after the unlucky site. Only triangles that are
//! Delaunay in some version are kept. A site kills some of them, and makes those around it, its *star*, in angular order.
//! Who is in a killed triangle is in the star of its killer, and finds its triangle there by binary search. Where the flips
//! of one insertion make a long chain of intermediate triangles, the trace of the history follows the chain, and this search
//! halves it.
//!
//! Triangles are among the dummy points of `flips`, so that a star is around its site on all sides.
//!
//! Cost: O(n) memory, six triangles a point of 8 bytes each, beside the present triangulation; a search of v versions with stars
//! of d sites takes the sum of log d orientations. The paper leaves open whether v is O(log n) for each query; over random
//! orders O(log n) on average, and O(log^2 n) orientations at most. The triangle of
//! the last star is looked up in the triangulation as `flips` says.

use delone_predicates::Sign;

use super::flips::{DUMMIES, Flips};
use super::history::Observer;
use crate::ids::{EdgeId, Place, TriangleId};
use crate::locate::{Ground, Start, Strategy};
use crate::order::random::SplitMix;
use crate::plane::layer::Layer;
use crate::tally::Tally;

/// No triangle that is kept.
const NONE: u32 = u32::MAX;

/// See the module.
#[derive(Clone, Debug)]
pub(in crate::plane) struct Stars {
    flips: Flips,
    kept: Kept,
    /// For each point its star.
    ranges: Vec<Star>,
    /// Of all stars the corners around, counter-clockwise: a triangle has two of them and the site.
    around: Vec<Place>,
    /// For each point the place of its vertex.
    places: Vec<Place>,
}

/// The triangles around a site when it came.
#[derive(Clone, Copy, Debug)]
struct Star {
    first: u32,
    count: u32,
    /// How many corners are less than half a turn after the first one.
    upper: u32,
}

/// The later versions of triangles.
#[derive(Clone, Debug, Default)]
struct Kept {
    /// For each present triangle its number among those kept.
    numbers: Vec<u32>,
    /// For each triangle kept the present one that it is, or else the point that killed it. A triangle of that number knows.
    links: Vec<u32>,
    /// The point that comes.
    point: u32,
}

impl Kept {
    fn kill(&mut self, t: TriangleId) {
        if let Some(number) = self.numbers.get_mut(t.index()).filter(|number| **number != NONE) {
            self.links[*number as usize] = self.point;
            *number = NONE;
        }
    }
}

impl Observer<Flips> for Kept {
    const KEEPS: bool = false;

    fn split<T: Tally>(&mut self, _: &Flips, old: TriangleId, _: [TriangleId; 3], _: &mut T) {
        self.kill(old);
    }

    /// One of the two is intermediate, and not kept.
    fn flip<T: Tally>(&mut self, _: &Flips, old: [TriangleId; 2], _: [TriangleId; 2], _: &mut T) {
        old.into_iter().for_each(|t| self.kill(t));
    }
}

impl Stars {
    /// Inserts the vertices that there are in random order, as the analysis wants it.
    pub(super) fn build(layer: &Layer) -> Self {
        let mut stars = Self {
            flips: Flips::new(),
            kept: Kept::default(),
            ranges: Vec::new(),
            around: Vec::new(),
            places: Vec::new(),
        };
        let mut order: Vec<Place> = layer.mesh.inhabited().collect();
        SplitMix(0).shuffle(&mut order);
        for v in order {
            stars.inserted(layer, v, Start::Anywhere, &mut ());
        }
        stars
    }

    /// Triangles that are or were Delaunay, those at the dummies included.
    pub(super) fn count(&self) -> usize {
        self.around.len()
    }

    pub(super) fn bytes(&self) -> usize {
        self.flips.bytes()
            + size_of_val(&*self.kept.numbers)
            + size_of_val(&*self.kept.links)
            + size_of_val(&*self.ranges)
            + size_of_val(&*self.around)
            + size_of_val(&*self.places)
    }

    /// The present triangle that contains `q`.
    fn search<T: Tally>(&self, q: [f64; 2], tally: &mut T) -> Option<TriangleId> {
        let mut point = 0;
        if self.ranges.is_empty() {
            return None;
        }
        loop {
            tally.visited();
            let number = self.sector(point, q, tally);
            let link = self.kept.links[number as usize];
            if self.kept.numbers.get(link as usize) == Some(&number) {
                return Some(TriangleId::new(link as usize));
            }
            point = link as usize;
        }
    }

    /// The triangle of a star that contains `q`. Less than half a turn after the first corner, and from there on, corners are
    /// sorted by the side of the ray to them on which `q` is.
    fn sector<T: Tally>(&self, point: usize, q: [f64; 2], tally: &mut T) -> u32 {
        let Star { first, count, upper } = self.ranges[point];
        let around = &self.around[first as usize..(first + count) as usize];
        let site = Place::new(DUMMIES + point);
        let mut side = |k: usize| {
            tally.orientation();
            self.flips.side(site, around[k], q)
        };
        let is_upper = match side(0) {
            Sign::Positive => true,
            Sign::Negative => false,
            // On the ray to the first corner, or opposite.
            Sign::Zero => !side(1).is_positive(),
        };
        let (mut low, mut high) = if is_upper { (1, upper as usize) } else { (upper as usize, around.len()) };
        while low < high {
            let middle = low.midpoint(high);
            if side(middle).is_negative() { high = middle } else { low = middle + 1 }
        }
        first + low as u32 - 1
    }

    /// Writes down the star of a point that has come.
    fn add_star(&mut self, point: usize) {
        let site = Place::new(DUMMIES + point);
        let mesh = &self.flips.mesh;
        let star: Vec<EdgeId> = mesh.spokes(site).collect();
        let corners: Vec<Place> = star.iter().map(|&e| mesh.head(e)).collect();
        let is_upper = |&&w: &&Place| self.flips.turn(site, corners[0], w).is_positive();
        let upper = 1 + corners.iter().skip(1).take_while(is_upper).count() as u32;
        let first = self.around.len() as u32;
        self.ranges.push(Star { first, count: corners.len() as u32, upper });
        self.around.extend(corners);
        self.kept.numbers.resize(mesh.slot_count(), NONE);
        for (k, e) in star.into_iter().enumerate() {
            let t = e.triangle().index();
            self.kept.numbers[t] = first + k as u32;
            self.kept.links.push(t as u32);
        }
    }
}

impl Strategy<Layer> for Stars {
    /// The walk starts in the triangle that the search ends at; the number is that triangle's.
    fn start<T: Tally>(&self, layer: &Layer, q: [f64; 2], tally: &mut T) -> Start {
        match self.search(q, tally) {
            Some(t) => Start::Hint(self.flips.hint(layer, &self.places, t, q, tally), t.index() as u32),
            None => Start::Hint(EdgeId::NONE, 0),
        }
    }

    fn inserted<T: Tally>(&mut self, layer: &Layer, v: Place, start: Start, _: &mut T) {
        let q = layer.point(v);
        let t = match start {
            Start::Hint(_, number) => TriangleId::new(number as usize),
            _ => self.search(q, &mut ()).unwrap_or(TriangleId::new(0)),
        };
        let point = self.places.len();
        self.flips.points.push(q);
        self.places.push(v);
        self.kept.point = point as u32;
        self.flips.insert(Place::new(DUMMIES + point), t, &mut self.kept, &mut ());
        self.add_star(point);
    }

    fn removing<T: Tally>(&mut self, _: &Layer, _: Place, _: &mut T) {
        debug_assert!(false, "nothing is removed from a history");
    }

    fn rearranged(&mut self, _: &Layer, moved: &[Place]) {
        self.places.iter_mut().for_each(|place| *place = moved[place.index()]);
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::Kind;

    use super::*;
    use crate::Delaunay2;
    use crate::plane::histories::versions::Versions;

    /// The triangle found contains the point, inside or on its border: no walk would be needed. For the history of all
    /// triangles too.
    #[test]
    fn histories_lead_to_a_triangle_that_contains_the_point() {
        for &kind in Kind::ALL {
            for n in [1, 2, 3, 5, 60, 300] {
                let points = kind.points(n, 1);
                let d = Delaunay2::from_points(&points).expect("finite");
                let (stars, versions) = (Stars::build(&d.base), Versions::build(&d.base));
                let middles = points.windows(2).map(|p| [0, 1].map(|k| p[0][k] / 2.0 + p[1][k] / 2.0));
                let queries = kind.points(40, 2).into_iter().chain(middles).chain(points.iter().copied());
                for q in queries.chain([[1e300, 0.5], [-1e300, 1.0], [0.0, 1e300]]) {
                    let t = stars.search(q, &mut ()).expect("there are sites");
                    for (flips, t) in [(&stars.flips, t), (&versions.flips, versions.trace(q, &mut ()))] {
                        let [a, b, c] = flips.corners(t);
                        let is_left = |[u, v]: [Place; 2]| !flips.side(u, v, q).is_negative();
                        assert!(
                            [[a, b], [b, c], [c, a]].into_iter().all(is_left),
                            "{} {n} {q:?}",
                            kind.name()
                        );
                    }
                }
            }
        }
    }
}
