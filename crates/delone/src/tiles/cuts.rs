//! How the plane, or space, is cut into the regions of tiles: a tree of cuts, each by one coordinate, taken from a sample of the points.
//!
//! Which tile a point is in is a function of its coordinates, so equal points are in one tile, and nothing else hangs on the sample:
//! whatever the cuts, the triangles, or tetrahedra, are the same.
//!
//! Cost: O(s log t) for a sample of s points and t tiles; O(log t) to find the tile of a point, if the tree is balanced.

use super::Region;
use crate::error::Error;
use crate::points::{Bounds, check_finite};
use crate::sorting;

/// A node of the tree of tiles: a tile, or what it was cut into. The root is 1, the halves of node k are 2 k, below the cut, and
/// 2 k + 1, above it and on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Node(u32);

impl Node {
    /// All of the plane, or of space.
    pub const ROOT: Self = Self(1);

    /// The node with a number; none has 0.
    pub fn new(number: u32) -> Option<Self> {
        (number > 0).then_some(Self(number))
    }

    /// Its number.
    pub fn number(self) -> u32 {
        self.0
    }

    /// The node that it is a half of; none for the root.
    pub fn parent(self) -> Option<Self> {
        Self::new(self.0 / 2)
    }

    /// Its halves, if it is cut; none below 31 cuts.
    pub fn halves(self) -> Option<[Self; 2]> {
        let first = self.0.checked_mul(2)?;
        Some([Self(first), Self(first + 1)])
    }

    /// A name for a vertex of its tile that no vertex of another tile has: the number of the node, then the 32 bits of the
    /// vertex.
    pub fn id(self, vertex: u32) -> u64 {
        u64::from(self.0) << 32 | u64::from(vertex)
    }
}

/// A line parallel to an axis, a plane in space. What is on it belongs to the upper side. An axis and a coordinate
/// are all there is to it: no field will be added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// The coordinate that decides: 0 for x, 1 for y, 2 for z.
    pub axis: usize,
    /// Its least value above the cut.
    pub at: f64,
}

/// A tree of cuts, of the plane unless it is said to be of space: `Cuts<3>`.
///
/// ```
/// use delone::tiles::{Cuts, Node};
///
/// let cuts = Cuts::from_sample(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 1.0]], 2)?;
/// let [left, right] = cuts.halves(Node::ROOT).expect("two tiles");
/// assert_eq!((cuts.tile_of([1.9, 7.0]), cuts.tile_of([2.0, -7.0])), (left, right));
/// assert_eq!(cuts.region(right).low, [2.0, f64::NEG_INFINITY]);
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Cuts<const D: usize = 2> {
    /// The root is the first.
    steps: Vec<Step>,
}

#[derive(Clone, Copy, Debug)]
struct Step {
    node: Node,
    /// The cut, and where the steps of both halves are; none for a tile.
    cut: Option<(Cut, [u32; 2])>,
}

impl<const D: usize> Default for Cuts<D> {
    /// One tile.
    fn default() -> Self {
        Self { steps: vec![Step { node: Node::ROOT, cut: None }] }
    }
}

impl<const D: usize> Cuts<D> {
    /// Cuts the plane, or space, into so many tiles with nearly as many points of a sample each; into fewer where the sample has not so many
    /// points that differ.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate; [`Error::Cut`] below 31 cuts.
    pub fn from_sample(sample: &[[f64; D]], tiles: usize) -> Result<Self, Error> {
        let mut cuts = Self::default();
        cuts.cut(Node::ROOT, sample, tiles)?;
        Ok(cuts)
    }

    /// The tree of given cuts; those of parents come before those of their halves.
    ///
    /// # Errors
    /// [`Error::Cut`] if a node is no tile when it is cut, or the line is not inside of its region.
    pub fn from_cuts(given: impl IntoIterator<Item = (Node, Cut)>) -> Result<Self, Error> {
        let mut cuts = Self::default();
        for (node, cut) in given {
            cuts.cut_at(node, cut)?;
        }
        Ok(cuts)
    }

    /// Cuts a tile into smaller ones, by a sample of its points, as [`Self::from_sample`] does. Says whether it could be cut: not if all
    /// points of the sample are equal.
    ///
    /// # Errors
    /// [`Error::Cut`] if this is no tile, or below 31 cuts; [`Error::NotFinite`]; [`Error::OutsideRegion`] names the first
    /// point that is not in the tile.
    pub fn cut(&mut self, node: Node, sample: &[[f64; D]], tiles: usize) -> Result<bool, Error> {
        check_finite(sample.iter().copied())?;
        self.region(node).check(sample)?;
        let mut waiting = vec![(node, sample.to_vec(), tiles)];
        let mut is_cut = false;
        while let Some((node, mut points, tiles)) = waiting.pop() {
            let Some(cut) = (tiles > 1).then(|| best_cut(&mut points, tiles)).flatten() else {
                continue;
            };
            let halves = self.cut_at(node, cut)?;
            let (below, above) = points.into_iter().partition(|p| p[cut.axis] < cut.at);
            waiting.push((halves[1], above, tiles - tiles / 2));
            waiting.push((halves[0], below, tiles / 2));
            is_cut = true;
        }
        Ok(is_cut)
    }

    /// Cuts a tile in two.
    fn cut_at(&mut self, node: Node, cut: Cut) -> Result<[Node; 2], Error> {
        let wrong = |problem| Error::Cut { node: node.0, problem };
        let at = self
            .way_to(node)
            .last()
            .filter(|&at| self.steps[at].node == node && self.steps[at].cut.is_none());
        let at = at.ok_or(wrong("it is no tile"))?;
        let region = self.region(node);
        if cut.axis >= D {
            return Err(wrong("there is no such axis"));
        }
        if !(cut.at.is_finite() && region.low[cut.axis] < cut.at && cut.at < region.high[cut.axis]) {
            return Err(wrong("the cut is not inside of its region"));
        }
        let halves = node.halves().ok_or(wrong("31 cuts below each other are the most"))?;
        let next = self.steps.len() as u32;
        self.steps[at].cut = Some((cut, [next, next + 1]));
        self.steps.extend(halves.map(|node| Step { node, cut: None }));
        Ok(halves)
    }

    /// The tile of a point, whose coordinates are not NaN.
    #[inline]
    pub fn tile_of(&self, p: [f64; D]) -> Node {
        let mut step = &self.steps[0];
        while let Some((cut, next)) = step.cut {
            step = &self.steps[next[usize::from(p[cut.axis] >= cut.at)] as usize];
        }
        step.node
    }

    /// The region of a node; of one that the tree does not have, that of the last node on the way to it.
    pub fn region(&self, node: Node) -> Region<D> {
        let mut region = Region::ALL;
        let way: Vec<usize> = self.way_to(node).collect();
        for step in way.windows(2) {
            if let Some((cut, next)) = self.steps[step[0]].cut {
                let side = if next[0] as usize == step[1] { &mut region.high } else { &mut region.low };
                side[cut.axis] = cut.at;
            }
        }
        region
    }

    /// The steps from the root towards a node, as far as there are some.
    fn way_to(&self, node: Node) -> impl Iterator<Item = usize> + '_ {
        let mut at = Some(0);
        let mut levels = node.0.ilog2();
        std::iter::from_fn(move || {
            let here = at?;
            at = None;
            if levels > 0 {
                levels -= 1;
                at = self.steps[here].cut.map(|(_, next)| next[(node.0 >> levels & 1) as usize] as usize);
            }
            Some(here)
        })
    }

    /// How a node is cut; none for a tile, and for a node that the tree does not have.
    pub fn cut_of(&self, node: Node) -> Option<Cut> {
        let at = self.way_to(node).last().filter(|&at| self.steps[at].node == node);
        at.and_then(|at| self.steps[at].cut).map(|(cut, _)| cut)
    }

    /// Whether a node is a tile.
    pub fn is_tile(&self, node: Node) -> bool {
        self.way_to(node).last().is_some_and(|at| self.steps[at].node == node && self.steps[at].cut.is_none())
    }

    /// The halves of a node that is cut.
    pub fn halves(&self, node: Node) -> Option<[Node; 2]> {
        self.cut_of(node).and_then(|_| node.halves())
    }

    /// The parts of a node after `levels` cuts below each other; tiles that are met before are among them. From low to high, none
    /// if it is not cut. Whoever joins takes them instead of its halves, so that fewer points are triangulated again and again.
    pub fn parts(&self, node: Node, levels: u32) -> Vec<Node> {
        let mut parts: Vec<Node> = Vec::new();
        let mut waiting: Vec<(Node, u32)> = Vec::new();
        let halves =
            |node, left: u32| self.halves(node).filter(|_| left > 0).map(|h| h.map(|n| (n, left - 1)));
        waiting.extend(halves(node, levels).into_iter().flatten().rev());
        while let Some((node, left)) = waiting.pop() {
            match halves(node, left) {
                Some(halves) => waiting.extend(halves.into_iter().rev()),
                None => parts.push(node),
            }
        }
        parts
    }

    /// The tiles, from low to high.
    pub fn tiles(&self) -> Vec<Node> {
        if self.steps.len() == 1 { vec![Node::ROOT] } else { self.parts(Node::ROOT, u32::BITS) }
    }

    /// The cuts by increasing node, so those of parents come before those of their halves.
    pub fn cuts(&self) -> Vec<(Node, Cut)> {
        let cut = |step: &Step| step.cut.map(|(cut, _)| (step.node, cut));
        let mut cuts: Vec<(Node, Cut)> = self.steps.iter().filter_map(cut).collect();
        sorting::by_key(&mut cuts, |&(node, _)| node);
        cuts
    }
}

/// Cuts the longest side of the box around points where those below are to those above as half of the tiles to the other half,
/// nearly, with some on each side; the next one if all have the same coordinate. None if all are equal.
fn best_cut<const D: usize>(points: &mut [[f64; D]], tiles: usize) -> Option<Cut> {
    let extent = Bounds::of(points.iter().copied()).extent();
    let mut axes: [usize; D] = std::array::from_fn(|axis| axis);
    sorting::by(&mut axes, |&i, &j| extent[j].total_cmp(&extent[i]));
    let rank = (points.len() as u128 * (tiles / 2) as u128 / tiles as u128) as usize;
    axes.into_iter().find_map(|axis| {
        let by_axis = |p: &[f64; D], q: &[f64; D]| p[axis].total_cmp(&q[axis]);
        let middle = (!points.is_empty()).then(|| points.select_nth_unstable_by(rank, by_axis).1[axis])?;
        let below = points.iter().filter(|p| p[axis] < middle).count();
        let up_to = points.iter().filter(|p| p[axis] <= middle).count();
        let next = points.iter().map(|p| p[axis]).filter(|&x| x > middle).fold(f64::INFINITY, f64::min);
        let possible =
            [(below, middle), (up_to, next)].into_iter().filter(|&(n, _)| n > 0 && n < points.len());
        possible.min_by_key(|&(n, _)| n.abs_diff(rank)).map(|(_, at)| Cut { axis, at: at + 0.0 })
    })
}

#[cfg(test)]
mod tests {
    use delone_generators::Kind;

    use super::{Cut, Cuts, Node};
    use crate::Error;
    use crate::tiles::Region;

    /// Each point is in the region of its tile and of all above it, and in no other region of a tile.
    #[test]
    fn regions_tile_the_plane() {
        for &kind in Kind::ALL {
            let points = kind.points(500, 3);
            for count in [1, 2, 3, 7, 16, 100] {
                let cuts = Cuts::from_sample(&points, count).expect("finite");
                let tiles = cuts.tiles();
                assert!(tiles.len() <= count, "{}", kind.name());
                for &p in &points {
                    let own = cuts.tile_of(p);
                    let mut up = Some(own);
                    while let Some(node) = up {
                        assert!(cuts.region(node).contains(p), "{}", kind.name());
                        up = node.parent();
                    }
                    let around = tiles.iter().filter(|&&tile| cuts.region(tile).contains(p));
                    assert!(around.eq([&own]), "{}", kind.name());
                }
                let again = Cuts::from_cuts(cuts.cuts()).expect("the same cuts");
                assert_eq!(again.cuts(), cuts.cuts());
                assert!(again.tiles() == tiles && tiles.iter().all(|&t| again.region(t) == cuts.region(t)));
                assert_eq!(cuts.region(Node::ROOT), Region::ALL);
            }
        }
    }

    #[test]
    fn tiles_have_nearly_as_many_points_each() {
        let points = Kind::Clusters.points(10_000, 3);
        for count in [2, 3, 5, 16, 37] {
            let cuts = Cuts::from_sample(&points, count).expect("finite");
            assert_eq!(cuts.tiles().len(), count);
            for tile in cuts.tiles() {
                let inside = points.iter().filter(|&&p| cuts.tile_of(p) == tile).count();
                assert!(inside.abs_diff(points.len() / count) <= 8, "{inside} of {count}");
            }
        }
    }

    #[test]
    fn what_cannot_be_cut_is_not() {
        assert_eq!(Cuts::from_sample(&[[1.0, 2.0]; 50], 8).expect("finite").tiles(), [Node::ROOT]);
        assert_eq!(<Cuts>::from_sample(&[], 8).expect("finite").tiles(), [Node::ROOT]);
        // Two places, of which one is nearly always.
        let mut points = vec![[-0.0, 2.0]; 50];
        points[17] = [0.0, 3.0];
        let cuts = Cuts::from_sample(&points, 8).expect("finite");
        assert_eq!(cuts.tiles().len(), 2);
        assert_eq!(cuts.tile_of([0.0, 2.0]), cuts.tile_of([-0.0, 2.0]));
        // Nearly no extent along x, none along y.
        let cuts = Cuts::from_sample(&[[0.0, 7.0], [5e-324, 7.0]], 2).expect("finite");
        assert_eq!(cuts.cut_of(Node::ROOT), Some(Cut { axis: 0, at: 5e-324 }));
    }

    #[test]
    fn tiles_are_cut_again() {
        let points = Kind::Uniform.points(1000, 1);
        let mut cuts = Cuts::from_sample(&points, 4).expect("finite");
        let tile = cuts.tiles()[1];
        let inside: Vec<_> = points.iter().copied().filter(|&p| cuts.tile_of(p) == tile).collect();
        assert_eq!(cuts.cut(tile, &inside, 3), Ok(true));
        assert_eq!((cuts.tiles().len(), cuts.parts(tile, 1).len(), cuts.parts(tile, 9).len()), (6, 2, 3));
        assert_eq!(cuts.parts(Node::ROOT, 2).len(), 4);
        let no_tile = Error::Cut { node: tile.number(), problem: "it is no tile" };
        assert_eq!(cuts.cut(tile, &inside, 3), Err(no_tile));
        let outside = points.iter().position(|&p| !cuts.region(tile).contains(p)).expect("some");
        let found = cuts.cut(tile, &points, 3);
        assert!(matches!(found, Err(Error::OutsideRegion { index, .. }) if index == outside));
        let bad = [[0.0, 1.0], [f64::NAN, 2.0]];
        assert!(matches!(Cuts::from_sample(&bad, 2), Err(Error::NotFinite { index: 1, axis: 0, .. })));
    }

    #[test]
    fn cuts_from_elsewhere_are_checked() {
        let node = |number| Node::new(number).expect("not 0");
        let good = (node(1), Cut { axis: 0, at: 5.0 });
        for (number, axis, at) in [
            (1, 0, 6.0),
            (4, 0, 1.0),
            (2, 0, 5.0),
            (2, 0, 6.0),
            (3, 0, 5.0),
            (3, 1, f64::NAN),
            (3, 1, f64::INFINITY),
            (2, 2, 1.0),
        ] {
            let found = <Cuts>::from_cuts([good, (node(number), Cut { axis, at })]);
            assert!(matches!(found, Err(Error::Cut { node, .. }) if node == number), "{number} {axis} {at}");
        }
        let chain = (0..32).map(|k| (node(1 << k), Cut { axis: 0, at: -f64::from(k) }));
        assert!(matches!(<Cuts>::from_cuts(chain.clone()), Err(Error::Cut { .. })));
        assert_eq!(<Cuts>::from_cuts(chain.take(31)).expect("31 cuts").tiles().len(), 32);
        assert_eq!(Node::new(0), None);
        assert_eq!(Node::ROOT.parent(), None);
    }
}
