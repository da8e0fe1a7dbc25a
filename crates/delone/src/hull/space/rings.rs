//! The surface of a hull as rings of neighbors, from which corners are taken.
//!
//! A corner of a hull is one of the hull of fewer corners too, and only facets around a corner change when it goes: triangles between its
//! neighbors take their place (`fill.rs`). So rings of other corners than these stay as they are.
//!
//! Cost: O(n) for the rings of n corners whose numbers of neighbors are bounded, O(k log k) for k neighbors of a corner that goes, and
//! O(k) for each ring that changes, once a round.

use super::sides::{Sides, value};

/// The neighbors of corners, counter-clockwise seen from outside.
pub(super) struct Rings(Vec<Vec<usize>>);

impl Rings {
    /// The rings of facets that close a surface, with corners below a number; each begins with its least neighbor.
    pub(super) fn of(count: usize, facets: &[[usize; 3]]) -> Self {
        let sides = Sides::of(count, facets.iter().flat_map(turns));
        let ring = |v: usize| {
            let sides = sides.leaving(v);
            let first = sides.first().map_or(v, |side| side.0);
            let mut ring = chain(sides, first, first).unwrap_or_default();
            ring.insert(0, first);
            ring
        };
        Self((0..count).map(ring).collect())
    }

    /// The neighbors of a corner.
    pub(super) fn around(&self, v: usize) -> &[usize] {
        &self.0[v]
    }

    /// How the rings around a corner change, if triangles take its place: for each neighbor those that come in the place of the
    /// corner. None if the triangles do not fill the ring, as for points that are not those of the hull.
    pub(super) fn changes(&self, v: usize, fill: &[[usize; 3]]) -> Option<Vec<Change>> {
        let ring = self.around(v);
        let mut sides: Vec<(usize, (usize, usize))> = fill.iter().flat_map(turns).collect();
        sides.sort_unstable();
        let ends: Vec<(usize, usize)> = sides.iter().map(|side| side.1).collect();
        let mut all = Vec::with_capacity(ring.len());
        for (k, &w) in ring.iter().enumerate() {
            let own = sides.partition_point(|side| side.0 < w)..sides.partition_point(|side| side.0 <= w);
            let (after, before) = (ring[(k + 1) % ring.len()], ring[(k + ring.len() - 1) % ring.len()]);
            let instead =
                chain(&ends[own.clone()], after, before).filter(|chain| chain.len() + 1 == own.len())?;
            all.push(Change { at: w, gone: v, instead });
        }
        Some(all)
    }

    /// Takes corners out, none of which are neighbors, with all changes around them; returns the corners whose rings are others now, in
    /// order.
    pub(super) fn change(&mut self, mut changes: Vec<Change>) -> Vec<usize> {
        changes.sort_unstable_by_key(|change| (change.at, change.gone));
        let mut changed = Vec::new();
        for own in changes.chunk_by(|x, y| x.at == y.at) {
            let ring = &mut self.0[own[0].at];
            let mut fresh = Vec::with_capacity(ring.len() + own.len());
            for &w in &*ring {
                match own.binary_search_by_key(&w, |change| change.gone) {
                    Ok(k) => fresh.extend_from_slice(&own[k].instead),
                    Err(_) => fresh.push(w),
                }
            }
            *ring = fresh;
            changed.push(own[0].at);
        }
        changed
    }
}

/// A neighbor that leaves a ring, and those that take its place.
pub(super) struct Change {
    at: usize,
    gone: usize,
    instead: Vec<usize>,
}

/// The sides of a triangle, each with the corner across.
fn turns(&[a, b, c]: &[usize; 3]) -> [(usize, (usize, usize)); 3] {
    [(a, (b, c)), (b, (c, a)), (c, (a, b))]
}

/// The corners between two others on a way along sides, which are sorted; none if no way leads there.
fn chain(sides: &[(usize, usize)], from: usize, to: usize) -> Option<Vec<usize>> {
    let mut chain = Vec::with_capacity(sides.len());
    let mut at = from;
    while chain.len() < sides.len() {
        at = value(sides, at)?;
        if at == to {
            return Some(chain);
        }
        chain.push(at);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::fill::fill;
    use super::Rings;
    use crate::hull::Hull3;
    use delone_generators::Random;

    /// The facets that rings tell of, each from its least corner.
    fn facets(rings: &Rings, corners: &[usize]) -> Vec<[usize; 3]> {
        let mut facets = Vec::new();
        for &v in corners {
            let ring = rings.around(v);
            let sides = ring.iter().zip(ring.iter().cycle().skip(1));
            facets.extend(sides.filter(|&(&u, &w)| v < u && v < w).map(|(&u, &w)| [v, u, w]));
        }
        facets.sort_unstable();
        facets
    }

    #[test]
    fn rings_are_those_of_the_hull_of_what_is_left() {
        let mut random = Random::new(22);
        for (round, count) in [10, 30, 200, 30].into_iter().enumerate() {
            // With a hub, whose neighbors are too many for ears; the last set is on a ball of the lattice, with flat faces.
            let point = |k: usize, random: &mut Random| match (round, k) {
                (3, _) => [0; 3].map(|_| random.below(4) as f64),
                (_, 0) => [0.0, 0.0, 3.0],
                _ => [0; 3].map(|_| random.between(-1.0, 1.0)),
            };
            let all: Vec<[f64; 3]> = (0..count).map(|k| point(k, &mut random)).collect();
            let hull = Hull3::from_points(&all).expect("finite");
            let points: Vec<[f64; 3]> = hull.corners().iter().map(|&i| all[i]).collect();
            let hull = Hull3::from_points(&points).expect("finite");
            let mut rings = Rings::of(points.len(), &hull.facets().collect::<Vec<_>>());
            let mut left: Vec<usize> = (0..points.len()).collect();
            while left.len() > 4 {
                let v = left.remove(random.below(left.len()));
                let filling = fill(&points, v, rings.around(v)).expect("a hull");
                let changes = rings.changes(v, &filling).expect("a ring that is filled");
                let mut around = rings.around(v).to_vec();
                around.sort_unstable();
                assert_eq!(rings.change(changes), around);
                let found = facets(&rings, &left);
                assert_eq!(found.len(), 2 * left.len() - 4);
                if round < 3 {
                    let at: Vec<[f64; 3]> = left.iter().map(|&i| points[i]).collect();
                    let hull = Hull3::named(&at, |i| left[i]);
                    let mut expected: Vec<[usize; 3]> = hull.facets().collect();
                    for facet in &mut expected {
                        let least = (0..3).min_by_key(|&k| facet[k]).expect("three");
                        facet.rotate_left(least);
                    }
                    expected.sort_unstable();
                    assert_eq!(found, expected);
                }
            }
        }
    }

    #[test]
    fn triangles_that_do_not_fill_a_ring_are_told() {
        let tetrahedron = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let rings = Rings::of(4, &tetrahedron);
        assert!(rings.changes(0, &[[1, 3, 2]]).is_none() != rings.changes(0, &[[1, 2, 3]]).is_none());
        assert!(rings.changes(0, &[]).is_none());
    }
}
