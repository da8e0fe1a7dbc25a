//! A large side of a channel: the apexes of its sides, taken from a constrained triangulation of its own vertices.
//!
//! The edges of the chain were edges before the segment came, so that nearly all of them are Delaunay among themselves and
//! have only to be fixed. To look at all vertices for each apex takes O(k^2) where apexes are near the ends of chains, as on
//! curves; this does not.
//!
//! Cost: O(k log k) for a chain of k vertices, and forcing those edges of it that are not Delaunay.

use crate::ids::Place;
use crate::mesh::triangles::channel::Channel;
use crate::mesh::triangles::surgery::BorderEdge;
use crate::plane::construct::{self, InOrder};
use crate::plane::layer::Layer;

/// The triangulation of a side.
pub(super) struct Patch {
    layer: Layer,
    /// For each vertex of the border its place in the patch.
    places: Vec<Place>,
    /// The positions of each vertex on the border, sorted: a vertex may be on it more than once.
    occurrences: Vec<(Place, usize)>,
}

impl Patch {
    /// Triangulates the vertices of a border, closed by the segment, with its edges for constraints. `None` if these cross, which
    /// edges of a triangulation do not.
    pub(super) fn new(points: &[[f64; 2]], border: &[BorderEdge]) -> Option<Self> {
        let local: Vec<[f64; 2]> = border.iter().map(|(v, _)| points[v.index()]).collect();
        let ordered = construct::in_order(&local);
        let places = ordered.positions(local.len());
        let InOrder { mesh, points, .. } = ordered;
        let mut layer = Layer::new(mesh, points);
        let mut channel = Channel::default();
        for pair in places.windows(2) {
            match layer.mesh.edge_between(pair[0], pair[1]) {
                Some(e) => layer.mesh.set_fixed(e, true),
                None => layer.force([pair[0], pair[1]], &mut channel, |_, _| {}).ok()?,
            }
        }
        let mut occurrences: Vec<_> = places.iter().enumerate().map(|(i, &place)| (place, i)).collect();
        occurrences.sort_unstable();
        Some(Self { layer, places, occurrences })
    }

    /// The apex of the side from `last` to `first`.
    pub(super) fn apex(&self, first: usize, last: usize) -> Option<usize> {
        let mesh = &self.layer.mesh;
        let side = mesh.edge_between(self.places[last], self.places[first])?;
        let apex = mesh.tip(side);
        // Of several occurrences one is between the ends.
        let at = self.occurrences.partition_point(|&occurrence| occurrence <= (apex, first));
        self.occurrences.get(at).filter(|&&(place, i)| place == apex && i < last).map(|&(_, i)| i)
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::{Kind, Random};
    use delone_predicates::Filter;

    use super::Patch;
    use crate::ids::{EdgeId, Place};
    use crate::mesh::triangles::channel::Channel;
    use crate::plane::constrained::force::apex;
    use crate::plane::constrained::trace::{Beginning, Leaves};
    use crate::{Constrained2, VertexId};

    /// On the sides of channels among short constraints, which hang into them.
    #[test]
    fn apexes_are_those_that_a_look_at_all_vertices_finds() {
        let mut random = Random::new(1);
        let (mut sides, mut repeated) = (0, 0);
        for kind in
            [Kind::Uniform, Kind::Grid, Kind::Circle, Kind::SmallIntegers, Kind::RotatedGrid, Kind::Clusters]
        {
            let points = kind.points(300, 1);
            let mut c = Constrained2::from_parts(&points, &[]).expect("no segments");
            let vertices: Vec<VertexId> = c.vertices().collect();
            let any = |random: &mut Random| vertices[random.below(vertices.len())];
            // Sticks, which no segment across may cross, and which are long beside the triangles.
            for _ in 0..100 {
                _ = c.insert_segment(any(&mut random), any(&mut random));
            }
            let ground = c.ground();
            let mut channel = Channel::default();
            let unknown = Filter::for_box(f64::INFINITY, f64::INFINITY, None);
            for _ in 0..8000 {
                let [a, b] = [(); 2].map(|()| c.mesh().place(any(&mut random)).expect("a vertex"));
                if a == b {
                    continue;
                }
                let Beginning { leaves: Leaves::Across(across), at_second } = ground.begin(a, b) else {
                    continue;
                };
                let ends = if at_second { [b, a] } else { [a, b] };
                let Ok(end) = ground.channel(ends, across, &mut channel) else { continue };
                channel.left.push((ends[0], EdgeId::NONE));
                channel.right.push((end, EdgeId::NONE));
                for border in [&channel.left, &channel.right] {
                    let patch = Patch::new(ground.points, border).expect("nothing crosses");
                    let mut pending = vec![(0, border.len() - 1)];
                    while let Some((first, last)) = pending.pop() {
                        if last > first + 1 {
                            let found = apex(ground.points, &unknown, border, first, last);
                            assert_eq!(patch.apex(first, last), Some(found), "{} {border:?}", kind.name());
                            pending.extend([(first, found), (found, last)]);
                        }
                    }
                    let mut places: Vec<Place> = border.iter().map(|edge| edge.0).collect();
                    places.sort_unstable();
                    places.dedup();
                    sides += 1;
                    repeated += usize::from(places.len() < border.len());
                }
            }
        }
        assert!(sides > 1000 && repeated > 20, "{sides} sides, {repeated} with a vertex twice");
    }
}
