//! The outline in space as a two-manifold: where sheets of it touch, vertices and edges are doubled.
//!
//! At each edge of the outline facets are paired that bound the same tetrahedra around it, found by walking through these. Corners of paired
//! facets at the same vertex are one copy of it, so a copy has the facets of one turn around it. A turn may pass an edge twice, at
//! both ends of it: of a ring of tetrahedra that bites itself in an edge. There two pairs exchange a facet, which divides both turns
//! in two; so this ends, with as many copies as there are corners at most.
//!
//! Cost: O(k log k) for k tetrahedra and O(n), a few times where rings bite themselves.

use super::Alpha;
use super::facing::{NONE, across};
use super::surface::Facet;
use crate::ids::VertexId;
use crate::sets::Sets;

/// A closed surface of triangles in which every edge has two triangles and every vertex one cycle of them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Manifold3 {
    /// The vertex of the triangulation that each vertex of the surface is a copy of, increasing.
    pub vertices: Vec<VertexId>,
    /// Triangles as indices of these, in the order and with the orientation of [`Alpha::outline`].
    pub triangles: Vec<[usize; 3]>,
}

/// The side of a facet opposite to one of its corners.
type Side = (u32, u8);

impl Alpha<3> {
    /// The border of the tetrahedra that are there at a squared radius, without pinches: the triangles of [`Self::outline`], where sheets touch
    /// along an edge or in a vertex with a copy of it for each. So every edge has two triangles and every vertex one cycle of them, which
    /// programs call watertight, and the area and the solid are those of the outline. Whoever joins vertices at one place makes the
    /// pinches again. O(k log k) for k tetrahedra, and O(n).
    ///
    /// ```
    /// use delone::Delaunay3;
    /// // Two tetrahedra that touch along an edge.
    /// let points = [[0, 0, -1], [0, 0, 1], [3, -1, 0], [3, 1, 0], [-3, -1, 0], [-3, 1, 0]];
    /// let alpha = Delaunay3::from_points(&points)?.alpha();
    /// let surface = alpha.manifold(4.0);
    /// assert_eq!((alpha.outline(4.0).len(), surface.triangles.len()), (8, 8));
    /// assert_eq!(surface.vertices.iter().map(|v| v.index()).collect::<Vec<_>>(), [0, 0, 1, 1, 2, 3, 4, 5]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn manifold(&self, alpha: f64) -> Manifold3 {
        let tetrahedra = self.tetrahedra.until(alpha);
        let across = across(self.points.len(), tetrahedra);
        let facets = self.facets(tetrahedra, &across);
        let mut pairs = pairs(tetrahedra, &across, &facets);
        loop {
            let mut copies = copies(&facets, &pairs);
            if !part(&facets, &mut pairs, &mut copies) {
                return numbered(&facets, &mut copies);
            }
        }
    }
}

/// The place of a corner among those of all facets.
fn corner(facet: u32, k: usize) -> u32 {
    3 * facet + k as u32
}

/// The places of the corners at the ends of a side: that at the lesser vertex first.
fn ends(facets: &[Facet], (facet, k): Side) -> [u32; 2] {
    let [a, b] = [1, 2].map(|step| (usize::from(k) + step) % 3);
    let corners = facets[facet as usize].corners;
    (if corners[a] < corners[b] { [a, b] } else { [b, a] }).map(|k| corner(facet, k))
}

/// The sides of facets at edges, in pairs that bound the same tetrahedra.
fn pairs(tetrahedra: &[[VertexId; 4]], across: &[[u32; 4]], facets: &[Facet]) -> Vec<[Side; 2]> {
    let mut at = vec![[NONE; 4]; tetrahedra.len()];
    facets.iter().enumerate().for_each(|(i, facet)| at[facet.inside as usize][facet.opposite] = i as u32);
    let place = |t: u32, v: VertexId| tetrahedra[t as usize].iter().position(|&w| w == v).unwrap_or(0);
    let mut pairs = Vec::with_capacity(facets.len() * 3 / 2);
    for (i, facet) in facets.iter().enumerate() {
        for k in 0..3 {
            // Through the facet opposite to what the one that was come through has beside the edge.
            let edge = [1, 2].map(|step| facet.corners[(k + step) % 3]);
            let (mut t, mut beside) = (facet.inside, facet.corners[k]);
            let other = loop {
                let out = place(t, beside);
                let beyond = across[t as usize][out];
                if beyond == NONE {
                    break at[t as usize][out];
                }
                let next = tetrahedra[t as usize].iter().find(|v| **v != beside && !edge.contains(v));
                beside = *next.unwrap_or(&beside);
                t = beyond;
            };
            if (i as u32) < other {
                let opposite = facets[other as usize].corners.iter().position(|v| !edge.contains(v));
                pairs.push([(i as u32, k as u8), (other, opposite.unwrap_or(0) as u8)]);
            }
        }
    }
    pairs
}

/// Corners that are one copy of a vertex.
fn copies(facets: &[Facet], pairs: &[[Side; 2]]) -> Sets {
    let mut copies = Sets::new(3 * facets.len());
    for pair in pairs {
        let [one, other] = pair.map(|side| ends(facets, side));
        for (a, b) in one.into_iter().zip(other) {
            copies.join(a, b);
        }
    }
    copies
}

/// Lets pairs between the same copies exchange a facet. Says whether there were any.
fn part(facets: &[Facet], pairs: &mut [[Side; 2]], copies: &mut Sets) -> bool {
    let mut between: Vec<([u32; 2], u32)> = Vec::with_capacity(pairs.len());
    for (i, pair) in pairs.iter().enumerate() {
        between.push((ends(facets, pair[0]).map(|corner| copies.find(corner)), i as u32));
    }
    between.sort_unstable();
    // Where a turn is divided once, it is another one for the rest.
    let mut divided = vec![false; 3 * facets.len()];
    let mut any = false;
    for same in between.windows(2).filter(|same| same[0].0 == same[1].0) {
        any = true;
        if same[0].0.iter().any(|&copy| divided[copy as usize]) {
            continue;
        }
        same[0].0.iter().for_each(|&copy| divided[copy as usize] = true);
        let [i, j] = [same[0].1, same[1].1].map(|i| i as usize);
        // Those facets of a pair go along the edge in opposite directions.
        let goes_up = |(facet, k): Side| {
            let corners = facets[facet as usize].corners;
            corners[(usize::from(k) + 1) % 3] < corners[(usize::from(k) + 2) % 3]
        };
        let last = usize::from(goes_up(pairs[i][0]) == goes_up(pairs[j][0]));
        let kept = pairs[i][1];
        pairs[i][1] = pairs[j][last];
        pairs[j][last] = kept;
    }
    any
}

/// Copies by their vertices, and those of one by their first triangles.
fn numbered(facets: &[Facet], copies: &mut Sets) -> Manifold3 {
    let vertex = |corner: u32| facets[corner as usize / 3].corners[corner as usize % 3];
    let mut all: Vec<(VertexId, u32)> =
        (0..3 * facets.len() as u32).filter(|&c| copies.find(c) == c).map(|c| (vertex(c), c)).collect();
    all.sort_unstable();
    let mut numbers = vec![0; 3 * facets.len()];
    all.iter().enumerate().for_each(|(number, (_, copy))| numbers[*copy as usize] = number);
    let number = |corner: u32, copies: &mut Sets| numbers[copies.find(corner) as usize];
    let triangles =
        (0..facets.len() as u32).map(|i| [0, 1, 2].map(|k| number(corner(i, k), copies))).collect();
    Manifold3 { vertices: all.into_iter().map(|(v, _)| v).collect(), triangles }
}

#[cfg(test)]
mod tests {
    use std::collections::{BTreeMap, BTreeSet};

    use delone_generators::Random;

    use super::{Alpha, Manifold3, VertexId};
    use crate::alpha::Faces;

    /// Cubes of a lattice of this many cubes along each axis.
    const SIDE: usize = 3;

    /// Cubes as six tetrahedra each, which fit to those of the cubes beside.
    fn cubes(all: &[[usize; 3]]) -> Alpha<3> {
        let (mut points, mut corners) = (Vec::new(), Vec::new());
        for i in 0..(SIDE + 1).pow(3) {
            points.push([i % 4, i / 4 % 4, i / 16].map(|x| x as f64));
        }
        let id = |[x, y, z]: [usize; 3]| VertexId::new(x + 4 * y + 16 * z);
        for cube in all {
            for [i, j, k] in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]] {
                let mut at = *cube;
                corners.push([None, Some(i), Some(j), Some(k)].map(|axis| {
                    axis.into_iter().for_each(|axis: usize| at[axis] += 1);
                    id(at)
                }));
            }
        }
        corners.sort_unstable();
        let tetrahedra = Faces { values: vec![0.0; corners.len()], corners };
        let (vertices, edges, triangles) = (Faces::default(), Faces::default(), Faces::default());
        Alpha { points, vertices, edges, triangles, tetrahedra }
    }

    /// Every edge has two triangles, in opposite directions, every vertex one cycle, and the triangles are those of the outline.
    fn judge(alpha: &Alpha<3>, what: &[[usize; 3]]) -> Manifold3 {
        let surface = alpha.manifold(0.0);
        let of = |t: &[usize; 3]| t.map(|i| surface.vertices[i]);
        assert_eq!(surface.triangles.iter().map(of).collect::<Vec<_>>(), alpha.outline(0.0), "{what:?}");
        assert!(surface.vertices.is_sorted());
        let mut edges = BTreeSet::new();
        let mut after: Vec<BTreeMap<usize, usize>> = vec![BTreeMap::new(); surface.vertices.len()];
        for &[a, b, c] in &surface.triangles {
            for (from, to, far) in [(a, b, c), (b, c, a), (c, a, b)] {
                assert!(edges.insert((from, to)), "twice: {what:?}");
                after[from].insert(to, far);
            }
        }
        assert!(edges.iter().all(|&(from, to)| edges.contains(&(to, from))), "{what:?}");
        for link in after {
            let Some((&first, _)) = link.first_key_value() else {
                panic!("a vertex without triangles: {what:?}")
            };
            let (mut at, mut steps) = (link[&first], 1);
            while at != first {
                (at, steps) = (link[&at], steps + 1);
            }
            assert_eq!(steps, link.len(), "{what:?}");
        }
        surface
    }

    #[test]
    fn touching_cubes_come_apart() {
        let copies = |all: &[[usize; 3]]| judge(&cubes(all), all).vertices.len();
        assert_eq!(copies(&[]), 0);
        assert_eq!(copies(&[[0, 0, 0]]), 8);
        // Across a side, along an edge, in a vertex.
        assert_eq!(copies(&[[0, 0, 0], [1, 0, 0]]), 12);
        assert_eq!(copies(&[[0, 0, 0], [1, 1, 0]]), 16);
        assert_eq!(copies(&[[0, 0, 0], [1, 1, 1]]), 16);
    }

    /// A ring whose ends touch along an edge: both of its ends are passed twice by one turn.
    #[test]
    fn rings_that_bite_themselves_are_surfaces() {
        let ring = [[1, 0, 0], [0, 0, 0], [0, 1, 0], [0, 2, 0], [1, 2, 0], [2, 2, 0], [2, 1, 0]];
        let surface = judge(&cubes(&ring), &ring);
        assert_eq!(surface.vertices.len(), 32);
    }

    #[test]
    fn sets_of_cubes_are_surfaces() {
        let mut random = Random::new(11);
        for case in 0..if cfg!(miri) { 1 } else { 400 } {
            let rare = 2 + case % 3;
            let at = |i: usize| [i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE];
            let all: Vec<[usize; 3]> = (0..SIDE.pow(3)).map(at).filter(|_| random.below(rare) == 0).collect();
            judge(&cubes(&all), &all);
        }
    }
}
