//! A small hole filled from its border inwards: behind each facet comes the vertex whose sphere is empty of the others.
//!
//! Every tetrahedron of the filling has its corners among the vertices around the hole and a sphere that is empty of them,
//! and with the canonical rule each facet has one such tetrahedron on each side; so the order in which facets are
//! taken does not matter, and nothing has to be triangulated that is not in the hole. The plane fills its holes so, too.
//!
//! The search for an apex needs no orientations but of the first candidate. Where a sphere through the facet shrinks on
//! its inner side, it grows beyond the facet, and the last one has no vertex there: so what is in any of the spheres that are met
//! on the way is on the inner side, and nearer.
//!
//! Vertices have small numbers, by which their coordinates are gathered in one piece of memory, and a facet is
//! known by its three numbers.
//!
//! Cost: O(t d) for d vertices and t tetrahedra of the filling: 16 and 20 on average, where points are spread evenly.

use delone_predicates::{Site, SpherePencil};

use super::Layer;
use super::kernel::Lift;
use crate::ids::{FacetId, Place, TetrahedronId};
use crate::mesh::tetrahedra::surgery::turned;
use crate::mesh::tetrahedra::{FACETS, Mesh3, Tetrahedron};
use crate::prefetch::prefetch;

/// Tetrahedra of a hole, up to which it is gift-wrapped; a larger hole is triangulated apart, which avoids the square of its size.
const WRAPPED_TETRAHEDRA: usize = 200;

/// Buffers that are kept between holes.
#[derive(Clone, Debug, Default)]
pub(in crate::space) struct Wrap {
    /// The vertices around the hole by their number, each with the tetrahedron that it has for its own before.
    vertices: Vec<(Place, TetrahedronId)>,
    sites: Vec<Site<3>>,
    /// The facets with nothing on their inner side yet, as that sees them.
    open: Vec<Facet>,
    /// For each of them the same facet seen from its outer side.
    outer: Vec<FacetId>,
    /// The tetrahedra of the filling.
    cells: Vec<(TetrahedronId, Tetrahedron)>,
}

/// Three numbers of ten bits, the smallest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Facet(u32);

impl Facet {
    #[inline]
    fn new(numbers: [usize; 3]) -> Self {
        let [a, b, c] = turned(numbers);
        Self((a << 20 | b << 10 | c) as u32)
    }

    #[inline]
    fn numbers(self) -> [usize; 3] {
        [20, 10, 0].map(|shift| (self.0 >> shift & 0x3ff) as usize)
    }
}

impl Wrap {
    /// Whether the star of a vertex may be filled so: it is not large, and the vertex is inside of the hull.
    pub(in crate::space) fn suits(mesh: &Mesh3, star: &[TetrahedronId]) -> bool {
        star.len() <= WRAPPED_TETRAHEDRA && !star.iter().any(|&t| mesh.is_ghost(t))
    }

    /// How many tetrahedra the last filling has.
    pub(in crate::space) fn count(&self) -> usize {
        self.cells.len()
    }

    /// Removes the star of a vertex and fills the hole. `None`, and nothing has changed, if there is no room.
    pub(in crate::space) fn fill<W: Lift>(
        &mut self,
        layer: &mut Layer<W>,
        v: Place,
        star: &[TetrahedronId],
    ) -> Option<()> {
        self.set_border(layer, v, star);
        self.cells.clear();
        while let Some((facet, outer)) = self.open.pop().zip(self.outer.pop()) {
            let apex = self.apex(layer, facet);
            let mut slot = || star.get(self.cells.len()).copied().or_else(|| layer.mesh.new_cell());
            let Some((apex, t)) = apex.and_then(|apex| Some((apex, slot()?))) else {
                self.cells.iter().skip(star.len()).for_each(|cell| layer.mesh.free_cell(cell.0));
                return None;
            };
            self.put(facet, outer, apex, t);
        }
        // Of two that meet, the later one knows the other.
        self.cells.iter().for_each(|&(t, cell)| layer.mesh.records().put(t, cell));
        star.iter().skip(self.cells.len()).for_each(|&t| layer.mesh.free_cell(t));
        Some(())
    }

    /// Takes the facets across from a vertex for the border, and gathers their corners.
    fn set_border<W: Lift>(&mut self, layer: &mut Layer<W>, v: Place, star: &[TetrahedronId]) {
        let Mesh3 { cells, incident, .. } = &mut layer.mesh;
        for t in star {
            cells[t.index()].corners.iter().for_each(|p| prefetch(incident, p.index()));
        }
        self.vertices.clear();
        self.open.clear();
        self.outer.clear();
        for t in star {
            let Tetrahedron { corners, across } = cells[t.index()];
            let k = corners.iter().position(|&p| p == v).unwrap_or_default();
            // As in a cavity, a number is for the while where the vertex keeps its tetrahedron.
            let number = |i: usize| {
                let p = corners[i];
                let slot = &mut incident[p.index()];
                if self.vertices.get(slot.index()).is_none_or(|vertex| vertex.0 != p) {
                    prefetch(&layer.points, p.index());
                    self.vertices.push((p, *slot));
                    *slot = TetrahedronId::new(self.vertices.len() - 1);
                }
                slot.index()
            };
            self.open.push(Facet::new(FACETS[k].map(number)));
            self.outer.push(across[k]);
            prefetch(cells, across[k].tetrahedron().index());
        }
        self.vertices.iter().for_each(|&(p, t)| incident[p.index()] = t);
        self.sites.clear();
        self.sites.extend(self.vertices.iter().map(|&(p, _)| {
            let (point, weight) = layer.site(p);
            (point, weight.value())
        }));
    }

    /// The vertex that makes a tetrahedron of the filling with a facet.
    #[inline]
    fn apex<W: Lift>(&self, layer: &Layer<W>, facet: Facet) -> Option<usize> {
        let corners @ [a, b, c] = facet.numbers();
        let filter = &layer.filter;
        let pencil = SpherePencil::new(corners.map(|n| self.sites[n]));
        let is_inner = |&n: &usize| {
            pencil.side(self.sites[n], filter).map_or_else(
                || {
                    let [a, b, c, p] = [a, b, c, n].map(|n| self.sites[n].0);
                    filter.orient3d(a, b, c, p).is_positive()
                },
                |side| side.is_positive(),
            )
        };
        let mut others = (0..self.sites.len()).filter(|n| !corners.contains(n));
        let mut best = others.find(is_inner)?;
        let mut ball = pencil.through(self.sites[best]);
        for n in others {
            let side = ball.side(self.sites[n], filter).unwrap_or_else(|| {
                let view = layer.view();
                let site = |n: usize| view.site(self.vertices[n].0);
                W::in_sphere(filter, [a, b, c, best].map(site), site(n))
            });
            if side.is_positive() {
                best = n;
                ball = pencil.through(self.sites[n]);
            }
        }
        Some(best)
    }

    /// Adds the tetrahedron of a facet and an apex: its other facets meet open ones, or are open themselves.
    #[inline]
    fn put(&mut self, facet: Facet, outer: FacetId, apex: usize, t: TetrahedronId) {
        let [a, b, c] = facet.numbers();
        let corners = [a, b, c, apex];
        let mut across = [outer; 4];
        for k in 0..3 {
            let [a, b, c] = FACETS[k].map(|i| corners[i]);
            let seen = Facet::new([a, b, c]);
            if let Some(i) = self.open.iter().position(|&open| open == seen) {
                self.open.swap_remove(i);
                across[k] = self.outer.swap_remove(i);
            } else {
                self.open.push(Facet::new([a, c, b]));
                self.outer.push(t.facet(k));
                across[k] = FacetId::NONE;
            }
        }
        self.cells.push((t, Tetrahedron { corners: corners.map(|n| self.vertices[n].0), across }));
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::Kind3;

    use super::Wrap;
    use crate::ids::Place;
    use crate::mesh::Names;
    use crate::space::Delaunay3;
    use crate::space::layer::Layer;
    use crate::space::layer::kernel::Lift;

    /// Finite tetrahedra and ghosts by their places, sorted.
    fn cells<W: Lift>(layer: &Layer<W>) -> Vec<[Place; 4]> {
        let mut cells: Vec<_> = layer.mesh.cells().map(|t| layer.mesh.cells[t.index()].corners).collect();
        cells.iter_mut().for_each(|corners| corners.sort_unstable());
        cells.sort_unstable();
        cells
    }

    /// Each star filled from its border and by a triangulation apart; and the whole by its definition.
    fn compare<W: Lift>(layer: &Layer<W>, name: &str) -> usize {
        let mut wrapped = 0;
        let mut star = Vec::new();
        for v in layer.mesh.inhabited().filter(|&v| !layer.is_scaffold(v)).take(60) {
            layer.mesh.star(v, &mut star);
            if !Wrap::suits(&layer.mesh, &star) {
                continue;
            }
            wrapped += 1;
            let [mut one, mut other] = [layer.clone(), layer.clone()];
            let before = one.mesh.cells().count();
            assert_eq!(one.remove(v, &mut ()), Some(()), "{name}");
            assert_eq!(one.mesh.check(), Ok(()), "{name}");
            assert_eq!(
                one.mesh.cells().count() + star.len(),
                before + one.wrap.as_ref().map_or(0, |wrap| wrap.count()),
                "{name}"
            );
            let mut hole = std::mem::take(&mut other.hole);
            hole.cells.clone_from(&star);
            other.fill_apart(v, &mut hole, &mut Box::default());
            assert!(cells(&one) == cells(&other), "{name}: {v:?}");
        }
        wrapped
    }

    #[test]
    fn holes_are_filled_as_by_their_triangulation() {
        for &kind in Kind3::ALL {
            let points = kind.points(if kind == Kind3::HugeSpan3 { 20 } else { 120 }, 5);
            let d = Delaunay3::from_points(&points).expect("finite");
            compare(&d.base, kind.name());
            // With weights that tie as often as the points.
            let weights: Vec<f64> = points.iter().map(|p| if p[0] < p[1] { 0.0 } else { 0.25 }).collect();
            let mut layer = Layer::with_weights(points, weights);
            layer.mesh.names = Names::identical(layer.points.len(), |_| true);
            let order: Vec<u32> = (0..layer.points.len() as u32).collect();
            let sites = crate::space::construct::build(&mut layer, &order, &mut Vec::new(), &mut ());
            assert!(sites.is_some());
            compare(&layer, kind.name());
        }
        // All ties: a lattice, and lattices on spheres around their middle.
        let lattice: Vec<[f64; 3]> =
            (0..343).map(|i| [i % 7, i / 7 % 7, i / 49].map(|x| f64::from(x - 3))).collect();
        let square = |p: &[f64; 3]| p.iter().map(|x| x * x).sum::<f64>();
        let shells = lattice.iter().copied().filter(|p| [0.0, 14.0].contains(&square(p)));
        for points in [lattice.clone(), shells.collect()] {
            for scale in [1.0, 0.1, 1e-30] {
                let scaled: Vec<_> = points.iter().map(|p| p.map(|x| x * scale + 1.0 * scale)).collect();
                let d = Delaunay3::from_points(&scaled).expect("finite");
                assert!(compare(&d.base, "lattice") > 0, "{} points by {scale}", points.len());
            }
        }
    }
}
