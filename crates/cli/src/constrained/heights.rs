//! Heights of points that were added where segments crossed.

use delone::Constrained2;

use crate::message::note;

/// The heights of all points: those given, and for added ones the mean of what the segments through them have there.
pub(crate) fn of_all(c: &Constrained2, given: Option<&[f64]>, quiet: bool) -> Option<Vec<f64>> {
    let given = given?;
    let mut sums = vec![(0.0, 0_u32); c.points().len() - given.len()];
    let mut widest = 0.0_f64;
    for (s, _) in c.segments() {
        let Some(chain) = c.chain(s).filter(|chain| chain.iter().any(|v| v.index() >= given.len())) else {
            continue;
        };
        let [first, last] = [chain[0], chain[chain.len() - 1]];
        let (p, q) = (c.point(first), c.point(last));
        let (from, to) = (given[first.index()], given[last.index()]);
        let axis = usize::from((q[1] - p[1]).abs() > (q[0] - p[0]).abs());
        for v in chain.iter().filter(|v| v.index() >= given.len()) {
            let share = (c.point(*v)[axis] - p[axis]) / (q[axis] - p[axis]);
            let height = from + share * (to - from);
            let (sum, count) = &mut sums[v.index() - given.len()];
            if *count > 0 {
                widest = widest.max((height - *sum / f64::from(*count)).abs());
            }
            *sum += height;
            *count += 1;
        }
    }
    if widest > 0.0 {
        note(
            quiet,
            format_args!("where segments cross their heights differ by {widest} at most; the mean was taken"),
        );
    }
    let added = sums.into_iter().map(|(sum, count)| sum / f64::from(count.max(1)));
    Some(given.iter().copied().chain(added).collect())
}
