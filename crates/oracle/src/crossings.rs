//! Which segments cross, where, and what is left of them once they are split in rounds: by trying all pairs.
//!
//! First edges are cut at all vertices inside of them. A round finds all crossings then, and rounds each once to the nearest point
//! of doubles. Each edge is replaced by the chain through its rounded crossings, those of others through whose cells it passes
//! (whose points are rounded to them), and, if it is crossed, all vertices through whose cells it passes. Rounds follow until
//! nothing crosses. Cost: O(m^2 + m n) exact decisions a round; mostly there is one.

use num_bigint::BigInt;

use crate::constrained::{is_between, side};
use crate::exact::{Point2, common_exponent, integers};

/// A fraction with a positive denominator.
type Fraction = (BigInt, BigInt);

/// Points on a common scale, and what the scale is.
struct Exact {
    points: Vec<[BigInt; 2]>,
    /// Coordinates are integers times two to the power of this.
    exponent: i64,
}

impl Exact {
    fn new(points: &[Point2]) -> Self {
        Self { points: integers(points), exponent: common_exponent(points).max(1) - 1075 }
    }

    /// Whether two edges cross inside of both.
    fn cross(&self, [a, b]: [usize; 2], [c, d]: [usize; 2]) -> bool {
        let [a, b, c, d] = [a, b, c, d].map(|v| &self.points[v]);
        side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0
    }

    /// Whether a point is inside of an edge.
    fn is_on(&self, v: usize, [a, b]: [usize; 2]) -> bool {
        let [v, a, b] = [v, a, b].map(|v| &self.points[v]);
        side(a, b, v) == 0 && is_between(a, b, v)
    }

    /// Where two edges cross: the part of the way along the first, and the place.
    fn crossing(&self, [a, b]: [usize; 2], [c, d]: [usize; 2]) -> (Fraction, [Fraction; 2]) {
        let [a, b, c, d] = [a, b, c, d].map(|v| &self.points[v]);
        let u = [&b[0] - &a[0], &b[1] - &a[1]];
        let v = [&d[0] - &c[0], &d[1] - &c[1]];
        let mut below = &u[0] * &v[1] - &u[1] * &v[0];
        let mut along = (&c[0] - &a[0]) * &v[1] - (&c[1] - &a[1]) * &v[0];
        if below < BigInt::ZERO {
            (below, along) = (-below, -along);
        }
        let place = [0, 1].map(|k| (&a[k] * &below + &along * &u[k], below.clone()));
        ((along, below), place)
    }

    /// The part of the way along an edge at which a point on it is.
    fn part(&self, v: usize, [a, b]: [usize; 2]) -> Fraction {
        let [v, a, b] = [v, a, b].map(|v| &self.points[v]);
        let k = usize::from(a[0] == b[0]);
        let (above, below) = (&v[k] - &a[k], &b[k] - &a[k]);
        if below < BigInt::ZERO { (-above, -below) } else { (above, below) }
    }
}

/// Whether a point of a segment is rounded to a point in its box.
fn rounds_to([a, b]: [Point2; 2], p: Point2) -> bool {
    if (0..2).any(|k| p[k] < a[k].min(b[k]) || p[k] > a[k].max(b[k])) {
        return false;
    }
    // All doubled, so that the middles between neighbors are integers; none of these is infinite in a box of numbers
    // but for the largest, whose cell goes as far up as down.
    let beside = |x: f64| [x.next_down(), x.next_up()].map(|y| if y.is_finite() { y } else { x });
    let [below, above] = [0, 1].map(|side| p.map(|x| beside(x)[side]));
    let [a, b, p2, below, above] = &integers(&[a, b, p, below, above])[..] else { return false };
    // From which part of the way on, and up to which: fractions, and whether they belong to it.
    let mut parts: [(Fraction, bool); 2] = [0, 1].map(|end| ((BigInt::from(end), BigInt::from(1)), true));
    for k in 0..2 {
        let (mut low, mut high) = (&p2[k] + &below[k], &p2[k] + &above[k]);
        if below[k] == p2[k] {
            low = &p2[k] * 3 - &above[k];
        }
        if above[k] == p2[k] {
            high = &p2[k] * 3 - &below[k];
        }
        let is_even = p[k].to_bits().is_multiple_of(2);
        let (start, way): (BigInt, BigInt) = (&a[k] * 2, (&b[k] - &a[k]) * 2);
        if way == BigInt::ZERO {
            if start < low || start > high || (!is_even && (start == low || start == high)) {
                return false;
            }
            continue;
        }
        let (first, last) = if way > BigInt::ZERO { (low, high) } else { (high, low) };
        for (end, border) in [first, last].into_iter().enumerate() {
            let mut fraction = (border - &start, way.clone());
            if way < BigInt::ZERO {
                fraction = (-fraction.0, -fraction.1);
            }
            let ((n, d), closed) = &parts[end];
            let (new, old) = (&fraction.0 * d, n * &fraction.1);
            let is_tighter = if end == 0 { new > old } else { new < old };
            if new == old {
                parts[end].1 = *closed && is_even;
            } else if is_tighter {
                parts[end] = (fraction, is_even);
            }
        }
    }
    let [((n, d), first), ((m, e), last)] = &parts;
    let (from, to) = (n * e, m * d);
    from < to || (from == to && *first && *last)
}

/// The nearest double to a fraction times a power of two, ties to even. It must be in range.
fn nearest((above, below): &Fraction, exponent: i64) -> f64 {
    let magnitude = BigInt::from(above.magnitude().clone());
    if magnitude == BigInt::ZERO {
        return 0.0;
    }
    let shifted = |x: &BigInt, by: i64| if by > 0 { x << by } else { x.clone() };
    // The largest power of two that is not above it, from the lengths or one less.
    let mut power = magnitude.bits() as i64 - below.bits() as i64;
    if shifted(&magnitude, -power) < shifted(below, power) {
        power -= 1;
    }
    let unit = (power + exponent - 52).max(-1074);
    let above_units = shifted(&magnitude, exponent - unit);
    let below_units = shifted(below, unit - exponent);
    let (mut digits, rest) = (&above_units / &below_units, (&above_units % &below_units) * 2);
    let is_odd = &digits % 2 != BigInt::ZERO;
    if rest > below_units || rest == below_units && is_odd {
        digits += 1;
    }
    let digits = u64::try_from(&digits).expect("53 bits");
    // Below 2^52 only numbers of the least unit come here, whose bits are their digits.
    let bits = if digits < 1 << 52 { digits } else { digits - (1 << 52) + (((unit + 1075) as u64) << 52) };
    f64::from_bits(bits).copysign(if *above < BigInt::ZERO { -1.0 } else { 1.0 })
}

/// The crossing of two segments that cross inside of both, each coordinate rounded once; `None` if they do not.
pub fn crossing([a, b]: [Point2; 2], [c, d]: [Point2; 2]) -> Option<Point2> {
    let exact = Exact::new(&[a, b, c, d]);
    exact.cross([0, 1], [2, 3]).then(|| {
        let (_, place) = exact.crossing([0, 1], [2, 3]);
        place.map(|fraction| nearest(&fraction, exact.exponent))
    })
}

/// All pairs of segments that cross inside of both, where no point of the set is, the lesser index first, sorted.
pub fn crossing_pairs(points: &[Point2], segments: &[[usize; 2]]) -> Vec<[usize; 2]> {
    let exact = Exact::new(points);
    let mut pairs = Vec::new();
    for i in 0..segments.len() {
        for j in i + 1..segments.len() {
            let (first, second) = (segments[i], segments[j]);
            let is_common = |v: usize| exact.is_on(v, first) && exact.is_on(v, second);
            if exact.cross(first, second) && !(0..points.len()).any(is_common) {
                pairs.push([i, j]);
            }
        }
    }
    pairs
}

/// Segments cut until none crosses another and none has a vertex inside of it.
pub struct Split {
    /// The points given, then those added, of each round in lexicographic order.
    pub points: Vec<Point2>,
    /// For each segment the vertices along it, of equal points the first; one alone if its ends are equal.
    pub chains: Vec<Vec<usize>>,
    /// The rounds in which edges crossed.
    pub rounds: usize,
    /// How many pairs of edges crossed, in all rounds.
    pub crossings: usize,
}

impl Split {
    /// Splits all segments.
    pub fn new(points: &[Point2], segments: &[[usize; 2]]) -> Self {
        let first_of = |points: &[Point2], p: Point2| points.iter().position(|q| *q == p);
        let vertex = |i: usize| first_of(points, points[i]).expect("itself");
        let chain = |&[a, b]: &[usize; 2]| {
            let mut chain = vec![vertex(a), vertex(b)];
            chain.dedup();
            chain
        };
        let mut split = Self {
            points: points.to_vec(),
            chains: segments.iter().map(chain).collect(),
            rounds: 0,
            crossings: 0,
        };
        while split.round() {}
        split
    }

    /// The edges of all chains, each once, the lesser index first, sorted.
    pub fn edges(&self) -> Vec<[usize; 2]> {
        let links = self.chains.iter().flat_map(|chain| chain.windows(2));
        let mut edges: Vec<_> = links.map(|link| [link[0].min(link[1]), link[0].max(link[1])]).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// The segments that cover an edge, and whether they go from its first vertex to its second.
    pub fn covering(&self, [a, b]: [usize; 2]) -> Vec<(usize, bool)> {
        let has = |chain: &Vec<usize>, link: [usize; 2]| chain.windows(2).any(|w| *w == link);
        let mut covering = Vec::new();
        for (i, chain) in self.chains.iter().enumerate() {
            if has(chain, [a, b]) || has(chain, [b, a]) {
                covering.push((i, has(chain, [a, b])));
            }
        }
        covering
    }

    /// One round; false if it found nothing.
    fn round(&mut self) -> bool {
        let exact = Exact::new(&self.points);
        let edges = self.edges();
        let is_first = |&v: &usize| !self.points[..v].contains(&self.points[v]);
        let vertices: Vec<usize> = (0..self.points.len()).filter(is_first).collect();
        // What is on each edge: vertices, or else, when all are cut at these, rounded crossings.
        let is_cut = edges.iter().any(|&edge| vertices.iter().any(|&v| exact.is_on(v, edge)));
        let mut crossings = 0;
        let on_edge = |&edge: &[usize; 2]| {
            let is_on = |v: &usize| exact.is_on(*v, edge);
            let on_it: Vec<usize> = vertices.iter().copied().filter(is_on).collect();
            let mut places: Vec<Point2> = Vec::new();
            for &other in edges.iter().filter(|&&other| !is_cut && exact.cross(edge, other)) {
                let (part, place) = exact.crossing(edge, other);
                // A crossing at a vertex is none.
                let is_at = |&v: &usize| {
                    let (a, b) = exact.part(v, edge);
                    a * &part.1 == &part.0 * b
                };
                if !on_it.iter().any(is_at) {
                    crossings += 1;
                    places.push(place.map(|fraction| nearest(&fraction, exact.exponent) + 0.0));
                }
            }
            (on_it.into_iter().map(|v| self.points[v]).collect::<Vec<Point2>>(), places)
        };
        let met: Vec<(Vec<Point2>, Vec<Point2>)> = edges.iter().map(on_edge).collect();
        if crossings == 0 && met.iter().all(|(on_it, _)| on_it.is_empty()) {
            return false;
        }
        let hot: Vec<Point2> = met.iter().flat_map(|(_, places)| places.iter().copied()).collect();
        // And what is near: vertices through whose cells an edge passes that is crossed, and rounded crossings.
        let with_cells = |(edge, (on_it, places)): (&[usize; 2], &(Vec<Point2>, Vec<Point2>))| {
            let ends = edge.map(|v| self.points[v]);
            let mut all = [&on_it[..], places].concat();
            let old = vertices.iter().map(|&v| self.points[v]).filter(|_| !places.is_empty());
            all.extend(old.chain(hot.iter().copied()).filter(|&p| rounds_to(ends, p)));
            all.retain(|p| !ends.contains(p));
            let forward = [0, 1].map(|k| if ends[1][k] < ends[0][k] { -1.0 } else { 1.0 });
            all.sort_by(|p, q| {
                let [p, q] = [p, q].map(|p| [p[0] * forward[0], p[1] * forward[1]]);
                p.partial_cmp(&q).expect("finite")
            });
            all.dedup();
            all
        };
        let found: Vec<Vec<Point2>> = edges.iter().zip(&met).map(with_cells).collect();
        // Each was met from both sides.
        self.crossings += crossings / 2;
        self.rounds += usize::from(crossings > 0);
        let mut new: Vec<Point2> =
            found.iter().flatten().filter(|p| !self.points.contains(p)).copied().collect();
        new.sort_by(|p, q| p.partial_cmp(q).expect("finite"));
        new.dedup();
        self.points.extend(new);
        let vertex = |p: &Point2| self.points.iter().position(|q| q == p).expect("was added");
        let inner: Vec<Vec<usize>> = found.iter().map(|places| places.iter().map(vertex).collect()).collect();
        for chain in &mut self.chains {
            let mut longer = vec![chain[0]];
            for link in chain.windows(2) {
                let edge = [link[0].min(link[1]), link[0].max(link[1])];
                let on_it = &inner[edges.binary_search(&edge).expect("an edge")];
                if link[0] == edge[0] {
                    longer.extend(on_it);
                } else {
                    longer.extend(on_it.iter().rev());
                }
                longer.push(link[1]);
            }
            longer.dedup();
            *chain = longer;
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::{Split, crossing, crossing_pairs, nearest};
    use crate::samples::Numbers;

    #[test]
    fn fractions_are_rounded_as_doubles_are_divided() {
        let mut numbers = Numbers(1);
        for _ in 0..20_000 {
            let mut below =
                |bits: u32| (numbers.below(1 << 26) << (bits - 26) | numbers.below(1 << 26)) as i64;
            let (a, b) = (below(53) - (1 << 52), below(27) + 1);
            let fraction = (a.into(), b.into());
            assert_eq!(nearest(&fraction, 0), a as f64 / b as f64);
            assert_eq!(nearest(&fraction, -60), a as f64 / b as f64 * 2_f64.powi(-60));
            // Half of a double with an odd digit is a tie.
            assert_eq!(nearest(&((2 * a + 1).into(), 2.into()), 0), (2 * a + 1) as f64 / 2.0);
        }
        // Subnormal ones: 3/2 and 5/2 of the least go to the even one.
        let least = f64::from_bits(1);
        assert_eq!(nearest(&(3.into(), 2.into()), -1074), 2.0 * least);
        assert_eq!(nearest(&(5.into(), 2.into()), -1074), 2.0 * least);
        assert_eq!(nearest(&(1.into(), 2.into()), -1074), 0.0);
        assert_eq!(nearest(&((-1).into(), 3.into()), -1074).to_bits(), (-0.0_f64).to_bits());
        // From the largest subnormal number up to the least normal one.
        assert_eq!(nearest(&(((1_i64 << 53) - 1).into(), 2.into()), -1074), f64::MIN_POSITIVE);
    }

    #[test]
    fn segments_cross_where_they_do() {
        assert_eq!(crossing([[0.0, 0.0], [3.0, 1.0]], [[1.0, 0.0], [1.0, 1.0]]), Some([1.0, 1.0 / 3.0]));
        assert_eq!(crossing([[0.0, 0.0], [1.0, 1.0]], [[1.0, 1.0], [1.0, 2.0]]), None);
        let huge = 1e308;
        assert_eq!(
            crossing([[-huge, -huge], [huge, huge]], [[-huge, huge], [huge, -huge]]),
            Some([0.0, 0.0])
        );
        let tiny = 5e-324;
        assert_eq!(crossing([[0.0, 0.0], [tiny, tiny]], [[0.0, tiny], [tiny, 0.0]]), Some([0.0, 0.0]));
    }

    #[test]
    fn a_crossing_at_a_point_is_none() {
        let points = [[0.0, 0.0], [2.0, 2.0], [0.0, 2.0], [2.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]];
        assert_eq!(crossing_pairs(&points, &[[0, 1], [2, 3], [5, 6]]), [[0, 2]]);
        assert_eq!(crossing_pairs(&points[..4], &[[0, 1], [2, 3], [1, 0]]), [[0, 1], [1, 2]]);
    }

    #[test]
    fn a_cross_gets_its_middle() {
        let points = [[0.0, 0.0], [2.0, 2.0], [0.0, 2.0], [2.0, 0.0], [0.0, 0.0]];
        let split = Split::new(&points, &[[4, 1], [2, 3], [0, 4], [1, 0]]);
        assert_eq!(split.points[5..], [[1.0, 1.0]]);
        assert_eq!(split.chains, [vec![0, 5, 1], vec![2, 5, 3], vec![0], vec![1, 5, 0]]);
        assert_eq!((split.rounds, split.crossings, split.edges().len()), (1, 1, 4));
        assert_eq!(split.covering([0, 5]), [(0, true), (3, false)]);
    }

    /// Neighboring doubles: chains collapse onto what is there, and rounds follow rounds.
    #[test]
    fn nothing_crosses_in_the_end() {
        let mut numbers = Numbers(7);
        let mut most = 0;
        for _ in 0..40 {
            let mut coordinate = || f64::from_bits(1.0_f64.to_bits() + numbers.below(12) as u64);
            let points: Vec<[f64; 2]> = (0..24).map(|_| [coordinate(), coordinate()]).collect();
            let segments: Vec<[usize; 2]> = (0..12).map(|i| [2 * i, 2 * i + 1]).collect();
            let split = Split::new(&points, &segments);
            let edges = split.edges();
            assert!(crossing_pairs(&split.points, &edges).is_empty());
            for (chain, &[a, b]) in split.chains.iter().zip(&segments) {
                assert_eq!(split.points[chain[0]], points[a]);
                assert_eq!(split.points[chain[chain.len() - 1]], points[b]);
            }
            // Neither the order nor the direction of segments shows.
            let turned: Vec<[usize; 2]> = segments.iter().rev().map(|&[a, b]| [b, a]).collect();
            let again = Split::new(&points, &turned);
            assert_eq!((again.points, again.rounds), (split.points, split.rounds));
            let back = again.chains.into_iter().rev().map(|chain| chain.into_iter().rev().collect());
            assert_eq!(back.collect::<Vec<Vec<usize>>>(), split.chains);
            most = most.max(split.rounds);
        }
        assert!(most > 0, "nothing crossed");
    }
}
