//! Segments of lines without seams: two that go the same way forth and back cancel, and what is left is linked anew.
//!
//! A ridge or a plain exactly at a level has no area above the level, or none below it, so lines go along it on both sides. What is
//! between them is nothing, and the parts that meet there are one.
//!
//! Where several lines meet in a point each goes on along the next one clockwise, with what is on its left between the two: so none
//! crosses another, by exact decisions. Cost: O(k log k) for k segments, and O(m^2) more where m lines meet.

use std::cmp::Ordering;

use delone_predicates::{Sign, orient2d};

use super::loops::order;
use crate::sorting;

/// A line, to which of the caller's sets it belongs, and whether it is closed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Path {
    pub(super) set: u32,
    pub(super) points: Vec<[f64; 2]>,
    pub(super) is_closed: bool,
}

/// Lines without seams, each with whether it may come to a point twice; `meet` hears of sets whose lines cancel, or are
/// linked where rounding made them cross. Lines whose points nobody shares stay as they are.
pub(super) fn mend(mut paths: Vec<Path>, mut meet: impl FnMut(u32, u32)) -> Vec<(Path, bool)> {
    let mut places = Vec::with_capacity(paths.iter().map(|path| path.points.len()).sum());
    for (number, path) in paths.iter_mut().enumerate() {
        // Minus zero is zero, so that equal points have equal bits.
        path.points.as_flattened_mut().iter_mut().for_each(|x| *x += 0.0);
        places.extend(path.points.iter().map(|p| (p.map(f64::to_bits), number as u32)));
    }
    places.sort_unstable();
    let mut is_touched = vec![false; paths.len()];
    for pair in places.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        pair.iter().for_each(|place| is_touched[place.1 as usize] = true);
    }
    let mut touched = Vec::new();
    let mut mended = Vec::new();
    for (path, is_touched) in paths.into_iter().zip(is_touched) {
        if is_touched {
            touched.extend(segments(path.set, &path.points, path.is_closed));
        } else {
            mended.push((path, false));
        }
    }
    cancel(&mut touched, &mut meet);
    mended.extend(link(touched, meet).into_iter().map(|path| (path, true)));
    mended
}

/// A segment, and to which of the caller's sets it belongs.
#[derive(Clone, Copy, Debug)]
struct Segment {
    set: u32,
    from: [f64; 2],
    to: [f64; 2],
}

/// The segments of a line; those without a length are left out.
fn segments(set: u32, points: &[[f64; 2]], is_closed: bool) -> impl Iterator<Item = Segment> + '_ {
    let count = if is_closed { points.len() } else { points.len().saturating_sub(1) };
    let at = move |i: usize| points[i % points.len()];
    (0..count).map(move |i| Segment { set, from: at(i), to: at(i + 1) }).filter(|s| s.from != s.to)
}

/// Takes out pairs of segments that go the same way forth and back; `meet` hears of the sets of all that lie on each other.
fn cancel(segments: &mut Vec<Segment>, mut meet: impl FnMut(u32, u32)) {
    let ends = |s: &Segment| if order(s.from, s.to).is_lt() { (s.from, s.to) } else { (s.to, s.from) };
    let compare = |s: &Segment, t: &Segment| {
        let ((a, b), (c, d)) = (ends(s), ends(t));
        order(a, c).then_with(|| order(b, d)).then_with(|| order(s.from, t.from)).then(s.set.cmp(&t.set))
    };
    sorting::by(segments, compare);
    let mut kept = Vec::with_capacity(segments.len());
    for same in segments.chunk_by(|s, t| ends(s) == ends(t)) {
        let forth = same.partition_point(|s| order(s.from, s.to).is_lt());
        let back = same.len() - forth;
        let gone = forth.min(back);
        kept.extend_from_slice(&same[gone..forth]);
        kept.extend_from_slice(&same[forth + gone..]);
        // Which of equal ones are gone is not to be seen.
        same.windows(2)
            .filter(|pair| pair[0].set != pair[1].set)
            .for_each(|pair| meet(pair[0].set, pair[1].set));
    }
    *segments = kept;
}

/// Lines of all segments, each with the set of its first one, and whether it is closed.
fn link(mut segments: Vec<Segment>, mut meet: impl FnMut(u32, u32)) -> Vec<Path> {
    sorting::by(&mut segments, |s, t| order(s.from, t.from).then_with(|| order(s.to, t.to)));
    let mut entering: Vec<u32> = (0..segments.len() as u32).collect();
    let at = |i: u32| segments[i as usize];
    sorting::by(&mut entering, |&i, &j| {
        order(at(i).to, at(j).to).then_with(|| order(at(i).from, at(j).from))
    });
    // After each segment the next one.
    let mut next = vec![NONE; segments.len()];
    let mut is_first = vec![true; segments.len()];
    let mut start = 0;
    for ins in entering.chunk_by(|&i, &j| at(i).to == at(j).to) {
        let p = at(ins[0]).to;
        while start < segments.len() && order(segments[start].from, p).is_lt() {
            start += 1;
        }
        let count = segments[start..].iter().take_while(|s| s.from == p).count();
        for &i in ins {
            let free = (start..start + count).filter(|&j| is_first[j]);
            let best = free.min_by(|&j, &k| clockwise(p, at(i).from, segments[j].to, segments[k].to));
            if let Some(j) = best {
                next[i as usize] = j as u32;
                if at(i).set != at(j as u32).set {
                    meet(at(i).set, at(j as u32).set);
                }
                is_first[j] = false;
            }
        }
    }
    let mut is_used = vec![false; segments.len()];
    let mut lines = Vec::new();
    // Open lines begin with what comes after nothing; what is then left is closed.
    let open: Vec<usize> = (0..segments.len()).filter(|&i| is_first[i]).collect();
    for start in open.into_iter().chain(0..segments.len()) {
        if is_used[start] {
            continue;
        }
        let mut points = Vec::new();
        let mut i = start as u32;
        while i != NONE && !std::mem::replace(&mut is_used[i as usize], true) {
            points.push(segments[i as usize].from);
            if next[i as usize] == NONE {
                points.push(segments[i as usize].to);
            }
            i = next[i as usize];
        }
        lines.push(Path { set: segments[start].set, points, is_closed: !is_first[start] });
    }
    lines
}

/// No segment.
const NONE: u32 = u32::MAX;

/// Which of two directions from a point comes first clockwise after another one; the other one itself is last.
fn clockwise(p: [f64; 2], after: [f64; 2], a: [f64; 2], b: [f64; 2]) -> Ordering {
    let part = |x: [f64; 2]| match orient2d(p, after, x) {
        Sign::Negative => 0,
        Sign::Zero if order(p, after) != order(p, x) => 1,
        Sign::Positive => 2,
        Sign::Zero => 3,
    };
    part(a).cmp(&part(b)).then_with(|| match orient2d(p, a, b) {
        Sign::Negative => Ordering::Less,
        Sign::Zero => Ordering::Equal,
        Sign::Positive => Ordering::Greater,
    })
}

#[cfg(test)]
mod tests {
    use super::{Path, cancel, clockwise, link, mend, segments};

    const A: [f64; 2] = [0.0, 0.0];
    const B: [f64; 2] = [2.0, 0.0];
    const C: [f64; 2] = [2.0, 2.0];
    const D: [f64; 2] = [0.0, 2.0];
    const E: [f64; 2] = [4.0, 0.0];
    const F: [f64; 2] = [4.0, 2.0];

    /// Two squares with a side in common are one; a line along a side of one goes to where that ends.
    #[test]
    fn seams_cancel() {
        let mut all: Vec<_> =
            segments(0, &[A, B, C, D], true).chain(segments(1, &[B, E, F, C], true)).collect();
        let mut met = Vec::new();
        cancel(&mut all, |s, t| met.push((s, t)));
        assert_eq!(met, [(0, 1)]);
        assert_eq!(link(all, |_, _| ()), [Path { set: 0, points: vec![A, B, E, F, C, D], is_closed: true }]);
        let mut all: Vec<_> =
            segments(0, &[A, B, C], false).chain(segments(1, &[F, C, B, E], false)).collect();
        cancel(&mut all, |_, _| ());
        let open = |set, points| Path { set, points, is_closed: false };
        assert_eq!(link(all, |_, _| ()), [open(0, vec![A, B, E]), open(1, vec![F, C])]);
        // What nobody shares stays.
        let paths = vec![open(0, vec![A, B, C]), open(1, vec![F, C, B, E]), open(2, vec![D, [0.0, 9.0]])];
        let mended = mend(paths, |_, _| ());
        assert_eq!(mended[0], (open(2, vec![D, [0.0, 9.0]]), false));
        assert_eq!(mended.len(), 3);
    }

    /// Two triangles at a point stay apart, one inside of another is found on the way around.
    #[test]
    fn lines_that_meet_do_not_cross() {
        let apart = segments(0, &[A, B, D], true).chain(segments(1, &[B, E, C], true)).collect();
        assert_eq!(link(apart, |_, _| ()).len(), 2);
        let hole = [B, [1.0, 0.5], [1.0, 0.25]];
        let inside = segments(0, &[A, B, D], true).chain(segments(0, &hole, true)).collect();
        assert_eq!(link(inside, |_, _| ()).len(), 1);
        assert!(clockwise(A, B, [1.0, -1.0], [-1.0, 0.0]).is_lt());
        assert!(clockwise(A, B, [-1.0, 1.0], [-1.0, 0.0]).is_gt());
        assert!(clockwise(A, B, E, [1.0, 1.0]).is_gt());
    }
}
