//! Corners of cells that are one to a reader: short sides are contracted (`joining.rs`), in all cells that have them.
//!
//! The corners of the region stay, and corners on its border stay on it: they are contracted along the border alone. If a ring would
//! not be a border any more, its corners stay, and all is done again without their sides. So the rings are simple and have the region's own
//! border around them: they tile it.
//!
//! Cost: O(n log n) for n corners in each round, of which there are few.

use super::cells::Cells2;
use crate::error::Error;
use crate::joining::{self, Numbered};
use crate::plane::region::Region2;
use crate::plane::region::rings::is_border;
use crate::sorting;

type Point = [f64; 2];

/// Of two corners that become one that of lower rank stays: first the corners of the region, then what is on its border.
const CORNER: u8 = 0;
const BORDER: u8 = 1;
const INSIDE: u8 = 2;

/// Where cells are as small as the length, rings go bad beside those that stay, round after round. After so many rounds their neighbors
/// stay too, more of them each time, and after the last everything.
const ALONE: usize = 4;
const ROUNDS: usize = 12;

/// How far a corner on the border is from it at most, as a part of the largest coordinate: 2^-50, four units in the last place. Each
/// coordinate was rounded once, and so was each of the side.
const ON_BORDER: f64 = 8.881_784_197_001_252e-16;

impl Cells2 {
    /// The cells with sides up to a length contracted, in coordinate units: corners that are nearer to each other along a side become
    /// one, in all cells. [`crate::MERGE_AUTO`] times the largest coordinate is a length of rounding.
    ///
    /// `region` is what the cells were clipped to. They still tile it, and all of its corners are kept, however near to each other they are.
    /// A cell without three corners is empty then. Short sides are left between corners of the region, between its borders, and
    /// where a ring would cross itself or turn over without them; if the length is that of cells, beside those too.
    ///
    /// Errors: a length that is negative or not finite. Cost: O(n log n) for n corners.
    ///
    /// ```
    /// use delone::{Delaunay2, Region2};
    ///
    /// // Four sites an ulp off a circle.
    /// let d = Delaunay2::from_points(&[[0.1, 0.1], [0.3, 0.1], [0.3, 0.3], [0.1, 0.1 + 0.2]])?;
    /// let region = Region2::rectangle([0.0, 0.0], [0.5, 0.5])?;
    /// let cells = d.voronoi().clip(&region).merged(1e-12, &region)?;
    /// assert!(d.vertices().all(|v| cells.rings(v).next().is_some_and(|ring| ring.indices().len() == 4)));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn merged(mut self, length: f64, region: &Region2) -> Result<Self, Error> {
        joining::check(length)?;
        // Of equal places one vertex.
        let numbered = Numbered::of(&self.vertices);
        let one = numbered.equal();
        self.corners.iter_mut().for_each(|v| *v = one[*v as usize]);
        let sides = self.sides();
        let is_border = borders(&sides);
        let mut ranks = vec![INSIDE; self.vertices.len()];
        let on_border = sides.iter().zip(&is_border).filter(|(_, is_border)| **is_border);
        on_border.flat_map(|(side, _)| side).for_each(|&v| ranks[v as usize] = BORDER);
        let mut corners: Vec<Point> = region.rings().flatten().copied().collect();
        sorting::by(&mut corners, |p, q| delone_predicates::lexicographic(*p, *q));
        for (rank, p) in ranks.iter_mut().zip(&self.vertices) {
            if corners.binary_search_by(|q| delone_predicates::lexicographic(*q, *p)).is_ok() {
                *rank = CORNER;
            }
        }
        let numbered = numbered.ranked(|v| ranks[v]);
        let mut stays = vec![false; self.vertices.len()];
        for round in 0..=ROUNDS + 1 {
            let to = numbered.joined(&sides, length, &|ranks, side| {
                let is_along = is_border[side] || ranks.contains(&INSIDE);
                is_along && ranks != [CORNER; 2] && !sides[side].iter().any(|&v| stays[v as usize])
            });
            let mut bad = self.bad(&to, region);
            let on_border = sides.iter().zip(&is_border).filter(|(_, is_border)| **is_border);
            let border: Vec<[u32; 2]> = on_border.map(|(side, _)| *side).collect();
            bad.extend(off_border(&border, &to, &self.vertices));
            bad.retain(|&v| !stays[v as usize]);
            if bad.is_empty() {
                self.rewrite(&to);
                return Ok(self);
            }
            bad.into_iter().for_each(|v| stays[v as usize] = true);
            for _ in ALONE..round {
                self.spread(&mut stays);
            }
            if round == ROUNDS {
                stays.fill(true);
            }
        }
        Ok(self)
    }

    /// All corners of cells of which one stays stay too.
    fn spread(&self, stays: &mut [bool]) {
        let before = stays.to_vec();
        for &site in &self.sites {
            let corners = || self.ranges(site).flat_map(|ring| &self.corners[ring]);
            if corners().any(|&v| before[v as usize]) {
                corners().for_each(|&v| stays[v as usize] = true);
            }
        }
    }

    /// The rings of all sites, each from its start to its end among the corners.
    fn ranges(&self, site: [u32; 2]) -> impl Iterator<Item = std::ops::Range<usize>> {
        let [first, count] = site.map(|n| n as usize);
        self.starts[first..].windows(2).take(count).map(|ends| ends[0] as usize..ends[1] as usize)
    }

    fn sides(&self) -> Vec<[u32; 2]> {
        let rings = self.sites.iter().flat_map(|&site| self.ranges(site)).map(|ring| &self.corners[ring]);
        rings.flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&v, &w)| [v, w])).collect()
    }

    /// The corners of cells that have moved and are bad then.
    fn bad(&self, to: &[u32], region: &Region2) -> Vec<u32> {
        let mut touched = vec![false; to.len()];
        for (v, &w) in to.iter().enumerate().filter(|&(v, &w)| v != w as usize) {
            touched[v] = true;
            touched[w as usize] = true;
        }
        let mut bad = Vec::new();
        for &site in &self.sites {
            let corners = || self.ranges(site).flat_map(|ring| &self.corners[ring]);
            if !corners().any(|&v| touched[v as usize]) {
                continue;
            }
            let rings: Vec<Vec<u32>> = self.ranges(site).map(|ring| moved(&self.corners[ring], to)).collect();
            let rings: Vec<Vec<u32>> = rings.into_iter().filter(|ring| !ring.is_empty()).collect();
            let place = |&v: &u32| self.vertices[v as usize];
            let is_good = match &rings[..] {
                [] => true,
                [ring] => is_border(ring.iter().map(place), |i| !touched[ring[i] as usize]),
                _ => {
                    let rings: Vec<Vec<Point>> =
                        rings.iter().map(|ring| ring.iter().map(place).collect()).collect();
                    (region.are_border())(&rings)
                }
            };
            if !is_good {
                bad.extend(corners());
            }
        }
        bad
    }

    /// Gives all rings the vertices that theirs become.
    fn rewrite(&mut self, to: &[u32]) {
        let mut new = Self { starts: vec![0], ..Self::default() };
        for &site in &self.sites {
            let first = new.starts.len() - 1;
            for ring in self.ranges(site).map(|ring| moved(&self.corners[ring], to)) {
                if !ring.is_empty() {
                    new.corners.extend(ring);
                    new.starts.push(new.corners.len() as u32);
                }
            }
            new.sites.push([first, new.starts.len() - 1 - first].map(|n| n as u32));
        }
        new.vertices = std::mem::take(&mut self.vertices);
        *self = new;
    }
}

/// The new form of a ring: nothing without three corners.
fn moved(ring: &[u32], to: &[u32]) -> Vec<u32> {
    let mut moved: Vec<u32> = ring.iter().map(|&v| to[v as usize]).collect();
    moved.dedup();
    while moved.len() > 1 && moved.first() == moved.last() {
        moved.pop();
    }
    if moved.len() < 3 { Vec::new() } else { moved }
}

/// The corners on the border of the region that have moved and are off its border then: two of its sides had met there by rounding.
fn off_border(border: &[[u32; 2]], to: &[u32], vertices: &[Point]) -> Vec<u32> {
    let largest =
        vertices.iter().flatten().filter(|x| x.is_finite()).fold(0.0_f64, |most, x| most.max(x.abs()));
    let mut beside: Vec<[u32; 2]> = Vec::new();
    for [v, w] in border.iter().map(|side| side.map(|v| to[v as usize])).filter(|[v, w]| v != w) {
        beside.extend([[v, w], [w, v]]);
    }
    sorting::by_key(&mut beside, |pair| *pair);
    let is_on = |v: u32| {
        let from = beside.partition_point(|pair| pair[0] < to[v as usize]);
        let mut sides = beside[from..].iter().take_while(|pair| pair[0] == to[v as usize]);
        sides.any(|side| is_near(vertices[v as usize], side.map(|v| vertices[v as usize]), largest))
    };
    let is_moved = |v: &u32| to[*v as usize] != *v;
    border.iter().flatten().copied().filter(is_moved).filter(|&v| !is_on(v)).collect()
}

/// Whether a place is on a side, but for rounding.
fn is_near(at: Point, [p, q]: [Point; 2], largest: f64) -> bool {
    let away = |r: Point| [0, 1].map(|k| r[k] / largest - p[k] / largest);
    let ([x, y], [dx, dy]) = (away(at), away(q));
    let square = dx * dx + dy * dy;
    let part = ((x * dx + y * dy) / square).clamp(0.0, 1.0);
    let miss = [x - part * dx, y - part * dy];
    miss[0].abs().max(miss[1].abs()) <= ON_BORDER
}

/// Of sides, whether no cell has it the other way round.
fn borders(sides: &[[u32; 2]]) -> Vec<bool> {
    let ends = sides.iter().map(|&[v, w]| [v.min(w), v.max(w)]);
    let mut order: Vec<([u32; 2], u32)> = ends.zip(0..).collect();
    order.sort_unstable();
    let mut borders = vec![false; sides.len()];
    for same in order.chunk_by(|a, b| a.0 == b.0) {
        let forwards = same.iter().filter(|&&(ends, i)| sides[i as usize] == ends).count();
        if 2 * forwards != same.len() {
            same.iter().for_each(|&(_, i)| borders[i as usize] = true);
        }
    }
    borders
}

#[cfg(test)]
mod tests {
    use crate::plane::{Delaunay2, Region2};

    /// A lattice of decimals turned: every cell inside has four corners again.
    #[test]
    fn lattices_have_square_cells() {
        let turned = |i: usize| {
            let (x, y) = (0.1 * (i % 20) as f64, 0.1 * (i / 20) as f64);
            [5e5 + 0.6 * x - 0.8 * y, 4e6 + 0.8 * x + 0.6 * y]
        };
        let sites: Vec<[f64; 2]> = (0..400).map(turned).collect();
        let d = Delaunay2::from_points(&sites).expect("sites");
        let region = Region2::hull(&d).expect("a hull");
        let exact = d.voronoi().clip(&region);
        let cells = exact.clone().merged(1e-6, &region).expect("a length");
        let is_inside = |i: usize| (1..19).contains(&(i % 20)) && (20..380).contains(&i);
        let inside: Vec<_> = d.vertices().filter(|v| is_inside(v.index())).collect();
        let corners =
            |cells: &crate::Cells2, v| cells.rings(v).map(|ring| ring.indices().len()).sum::<usize>();
        assert!(inside.iter().any(|&v| corners(&exact, v) > 4), "a lattice of decimals is none");
        inside.into_iter().for_each(|v| assert_eq!(corners(&cells, v), 4, "{v:?}"));
        let area: f64 = d.vertices().map(|v| cells.area(v)).sum();
        assert!((area - region.area()).abs() < 1e-6, "{area}");
    }

    /// A length as long as the region leaves its corners.
    #[test]
    fn corners_of_the_region_are_kept() {
        let sites: Vec<[f64; 2]> = (0..50).map(|i| [f64::from(i * 7 % 11), f64::from(i * 5 % 13)]).collect();
        let d = Delaunay2::from_points(&sites).expect("sites");
        let ring = [[0.0, 0.0], [9.0, 1.0], [10.0, 10.0], [5.0, 2.0], [0.0, 12.0]];
        let region = Region2::polygon(&[ring.to_vec()]).expect("a polygon");
        for length in [0.0, 1e-3, 0.5, 3.0, 100.0] {
            let cells = d.voronoi().clip(&region).merged(length, &region).expect("a length");
            let places = || d.vertices().flat_map(|v| cells.rings(v)).flat_map(|ring| ring.points());
            assert!(ring.iter().all(|corner| places().any(|p| p == *corner)), "merged by {length}");
            let area: f64 = d.vertices().map(|v| cells.area(v)).sum();
            assert!((area - region.area()).abs() < 1e-9, "{area} merged by {length}");
        }
        assert!(d.voronoi().clip(&region).merged(-1.0, &region).is_err());
    }
}
