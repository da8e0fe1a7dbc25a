//! A new site in the history of radial triangles: its plane, and what becomes of the triangles that it destroys.
//!
//! Source: Guibas, Knuth & Sharir, Algorithmica 1992, §5. The radial triangle that contains the site says where the cavity
//! is: one of the two Delaunay triangles at its edge has the site in its circle, as the circles around the ends of its base
//! through its apex cover it.
//!
//! Cost: O(d) for a site with d neighbors.

use delone_predicates::{lexicographic, orient2d};

use super::planes::{BEFORE, FOLLOWING, KINDS, MAX_SEATS, Seat, TO_SITE};
use super::{INTERIOR, NearestSites2, Radial};
use crate::error::Error;
use crate::ids::{EdgeId, Place};
use crate::locate::Start;
use crate::plane::layer::insert::Spot;
use crate::plane::layer::kernel::{Kernel, NearestSites};

/// Where a point falls.
#[derive(Clone, Copy, Debug)]
pub(super) enum Found {
    /// On this site.
    Site(Place),
    /// On the line of all sites, at this number.
    Line(usize),
    /// Off the line of all sites.
    Apex,
    /// In this present triangle.
    Cell(Radial),
}

impl NearestSites2 {
    /// Whether all sites so far are on one line, and `q` is.
    pub(super) fn is_on_line(&self, q: [f64; 2]) -> bool {
        let point = |v: &Place| self.layer.points[v.index()];
        self.apex.is_none()
            && match &self.line[..] {
                [first, .., last] => orient2d(point(first), point(last), q).is_zero(),
                _ => true,
            }
    }

    pub(super) fn find(&self, q: [f64; 2]) -> Found {
        let point = |v: Place| self.layer.points[v.index()];
        if self.apex.is_some() {
            let r = self.trace(q, &mut ());
            let [nearest, _] = self.planes.sides(r);
            return if point(nearest) == q { Found::Site(nearest) } else { Found::Cell(r) };
        }
        match self.line.binary_search_by(|&v| lexicographic(point(v), q)) {
            Ok(k) => Found::Site(self.line[k]),
            Err(k) if self.is_on_line(q) => Found::Line(k),
            Err(_) => Found::Apex,
        }
    }

    /// Whether one more site can be added, whatever its number of neighbors.
    pub(super) fn check_room(&self) -> Result<(), Error> {
        let most = self.layer.mesh.vertex_count;
        if self.planes.seats() + 4 * self.layer.points.len() > MAX_SEATS {
            return Err(Error::TooManyPoints { count: most + 1, most });
        }
        Ok(())
    }

    /// Makes a place a site, whose point falls where `found` says.
    pub(super) fn settle(&mut self, site: Place, found: Found) -> Result<(), Error> {
        self.check_room()?;
        match found {
            Found::Site(_) => {}
            Found::Line(k) => self.line.insert(k, site),
            Found::Apex => self.leave_line(site),
            Found::Cell(r) => self.add_site(site, self.planes.edge(r)),
        }
        Ok(())
    }

    /// The first site off the line: all that there are get a plane, of interior triangles alone.
    fn leave_line(&mut self, apex: Place) {
        self.layer.mesh.build_line(self.line.iter().map(|&v| (v, false)));
        let (spot, _) = self.layer.spot(Start::Anywhere, self.layer.points[apex.index()], &mut ());
        self.layer.insert_at(apex, spot, &mut ());
        self.apex = Some(apex);
        for k in 0..=self.line.len() {
            let site = self.line.get(k).copied().unwrap_or(apex);
            let star: Vec<EdgeId> = self.layer.mesh.spokes(site).collect();
            let around: Vec<Place> = star.iter().map(|&e| self.layer.mesh.head(e)).collect();
            let turn = self.planes.add(&self.layer.points, site, &around, &vec![Place::GHOST; around.len()]);
            for (k, e) in star.into_iter().enumerate() {
                self.appear(e, Radial::new(self.planes.seat(site, turn(k)), INTERIOR));
            }
        }
        self.triangles = self.planes.seats();
    }

    /// Adds a site in the radial triangle of an edge.
    fn add_site(&mut self, site: Place, e: EdgeId) {
        let (mesh, points) = (&self.layer.mesh, &self.layer.points);
        let q = points[site.index()];
        let is_hit = |e: EdgeId| {
            let corners = mesh.places(e.triangle());
            NearestSites::conflicts(corners, |k| (points[corners[k].index()], ()), (q, ()))
        };
        let seed = if is_hit(e) { e } else { mesh.twin(e) };
        debug_assert!(is_hit(seed), "a site in a radial triangle is in one of two circles");
        self.layer.insert_at(site, Spot::Triangle(seed.triangle()), &mut ());

        let (triangles, border) = self.layer.cavity.last();
        let around: Vec<Place> = border.iter().map(|&(place, _)| place).collect();
        let beyond: Vec<Place> = border.iter().map(|&(_, outside)| self.layer.mesh.tip(outside)).collect();
        let gone: Vec<EdgeId> =
            triangles[..triangles.len() - 2].iter().flat_map(|t| [0, 1, 2].map(|k| t.edge(k))).collect();
        let border: Vec<[EdgeId; 2]> =
            triangles.iter().zip(border).map(|(t, &(_, outside))| [t.edge(0), outside]).collect();

        let turn = self.planes.add(&self.layer.points, site, &around, &beyond);
        self.triangles += KINDS * around.len();
        self.seats.resize(self.layer.points.len(), Seat::NONE);
        for (k, v) in around.into_iter().enumerate().filter(|(_, v)| !v.is_ghost()) {
            self.seats[v.index()] = self.planes.seat(site, turn(k));
        }
        gone.into_iter().chain(border.iter().map(|&[_, outside]| outside)).for_each(|e| self.disappear(e));
        for (k, [edge, outside]) in border.into_iter().enumerate() {
            let [own, following] = [k, k + 1].map(|k| self.planes.seat(site, turn(k)));
            self.appear(edge, Radial::new(own, FOLLOWING));
            self.appear(edge.next(), Radial::new(following, TO_SITE));
            self.appear(edge.previous(), Radial::new(own, INTERIOR));
            self.appear(outside, Radial::new(following, BEFORE));
        }
    }

    /// From now on this is the radial triangle of an edge.
    fn appear(&mut self, e: EdgeId, r: Radial) {
        if self.current.len() <= e.index() {
            self.current.resize(e.index() + 1, Radial::NONE);
        }
        self.current[e.index()] = r;
        self.planes.set_edge(r, e);
    }

    /// The radial triangle of an edge points to where its site sits in the new plane.
    fn disappear(&mut self, e: EdgeId) {
        let Some(&r) = self.current.get(e.index()).filter(|r| **r != Radial::NONE) else { return };
        let [cell, _] = self.planes.sides(r);
        if !cell.is_ghost() {
            self.planes.set_destroyer(r, self.seats[cell.index()]);
        }
    }
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
                    let [found, _] = sites.planes.sides(sites.trace(q, &mut ()));
                    let found = points[found.index()];
                    let is_nearest = points.iter().all(|&p| compare_distances(q, found, p).is_le());
                    assert!(is_nearest, "{kind:?} {n} {q:?}");
                }
            }
        }
    }
}
