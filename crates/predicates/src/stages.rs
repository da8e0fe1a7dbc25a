//! Which stage answers what: the shares are part of the contract, because speed hangs on them.

use crate::counters::{Counts, Predicate, Stage, take};
use crate::{Point2, in_circle, orient2d};
use delone_generators::Kind;

fn counted(points: &[Point2]) -> Counts {
    take();
    for w in points.windows(4) {
        orient2d(w[0], w[1], w[2]);
        in_circle(w[0], w[1], w[2], w[3]);
    }
    take()
}

fn share(counts: &Counts, predicate: Predicate, stage: Stage) -> f64 {
    use Stage::{Big, Expansions, Filter, Integers, Scaled};
    let all: u64 =
        [Filter, Integers, Expansions, Scaled, Big].map(|stage| counts.get(predicate, stage)).iter().sum();
    counts.get(predicate, stage) as f64 / all as f64
}

#[test]
fn shares_of_the_stages() {
    use Predicate::{InCircle, Orient2d};
    let uniform = counted(&Kind::Uniform.points(20_000, 1));
    assert!(share(&uniform, Orient2d, Stage::Filter) > 0.9999);
    assert!(share(&uniform, InCircle, Stage::Filter) > 0.999);
    assert_eq!(uniform.get(InCircle, Stage::Perturb), 0);

    let line = counted(&Kind::Line.points(20_000, 1));
    assert_eq!(share(&line, Orient2d, Stage::Integers), 1.0);

    let near_line = counted(&Kind::NearLine.points(20_000, 1));
    assert!(share(&near_line, Orient2d, Stage::Integers) > 0.5);
    assert_eq!(share(&near_line, Orient2d, Stage::Big), 0.0);

    let huge = counted(&Kind::HugeSpan.points(2_000, 1));
    assert!(share(&huge, InCircle, Stage::Scaled) > 0.5);
    assert!(share(&huge, InCircle, Stage::Big) < 0.1);

    let spokes = counted(&Kind::Spokes.points(20_000, 1));
    assert!(spokes.get(InCircle, Stage::Perturb) > 0);
}
