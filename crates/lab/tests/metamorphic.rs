//! Units, order, repetition, strategies, turns and moves change what `replay` and `animate` give as they must, and in no other way.

#[allow(dead_code, reason = "the tests of `delone` use more of it")]
#[path = "../../cli/tests/metamorphic/given.rs"]
mod given;
#[path = "../../cli/tests/metamorphic/judge.rs"]
mod judge;

use given::{Given, Map, Point, Row, Shape, compare, drawn, integers, lattice, uniform};
use judge::{all, is_in_space, judge, judge_turned_and_moved, outcome, same};

/// A picture, byte by byte.
fn picture(g: &Given, name: &str) -> Vec<Shape> {
    vec![std::fs::read(g.place.path(name)).expect("a picture").into_iter().map(f64::from).collect()]
}

/// The result of points one after the other, some of which go and move; and the locations of queries then.
fn replayed(g: &Given, options: &str, axes: usize) -> Vec<Shape> {
    let place = |p: Point| g.to(p)[..axes].iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(" ");
    let mut known: Vec<Point> = Vec::new();
    let mut ops = String::new();
    for &p in g.points() {
        ops += &format!("+ {}\n", place(p));
        if !known.contains(&p) {
            known.push(p);
        }
    }
    for (id, p) in known.iter_mut().enumerate() {
        let part = (p[0] * 31.0 / g.set.unit).fract();
        if part < 0.25 {
            ops += &format!("- {id}\n");
        } else if part < 0.5 {
            *p = p.map(|x| x + part * g.set.unit);
            ops += &format!("> {id} {}\n", place(*p));
        }
    }
    g.set.queries.iter().for_each(|&q| ops += &format!("? {0}\n@ {0}\n", place(q)));
    g.place.file("ops.txt", ops);
    let answers = g.run(&format!("replay ops.txt {options} -o r.obj"));
    let answers = answers.lines().filter(|line| line.starts_with(['?', '@']));
    let answer = |(k, line): (usize, &str)| {
        // Of facets of the hull that are equally near that with the smallest ids is said.
        if axes == 3 && line.starts_with("? outside") {
            return g.set.queries[k / 2].to_vec();
        }
        let words = line.split(' ').filter_map(|word| word.parse::<usize>().ok());
        let mut corners: Vec<Point> = words.map(|id| known[id]).collect();
        corners.sort_by(|p, q| compare(p, q));
        [g.set.queries[k / 2].to_vec(), corners.concat()].concat()
    };
    g.obj("r.obj").into_iter().chain(answers.enumerate().map(answer)).collect()
}

const PLANE: &[Row] = &[
    ("replay", |g| replayed(g, "--check", 2)),
    ("animate", |g| {
        g.run("animate p.csv --steps 3 --size 100 -o d.png");
        picture(g, "d.png")
    }),
    ("animate --show", |g| {
        g.run("animate p.csv --show flips --steps 9 -o f-{}.svg");
        drawn(g, "f-9.svg")
    }),
];

const SPACE: &[Row] = &[("replay --dim 3", |g| replayed(g, "--dim 3 --check", 3))];

#[test]
fn units_order_and_repetition_change_nothing() {
    judge(PLANE, &uniform(100), &[-300, -40, 1, 300]);
    judge(PLANE, &lattice(false), &[-300, 52]);
    judge(SPACE, &uniform(60), &[-300, 40, 300]);
    judge(SPACE, &lattice(true), &[-300, 52]);
}

#[test]
fn right_angles_mirrors_and_moves_do_the_same_to_results() {
    let shift = [65536.0, -(640.0 * 1024.0), 0.0];
    judge_turned_and_moved(PLANE, &integers(80), &[[-2, 1, 3], [-1, 2, 3], [2, 1, 3]], shift);
    let shift = [65536.0, -(640.0 * 1024.0), 12345.0];
    judge_turned_and_moved(SPACE, &integers(50), &[[2, 3, 1], [1, -3, 2], [1, 2, -3]], shift);
}

#[test]
fn strategies_and_seeds_change_nothing() {
    for (row, words) in [
        (&PLANE[0], "--locate walk --walk stochastic --seed 3"),
        (&PLANE[0], "--locate jump-and-walk --seed 4"),
        (&PLANE[0], "--locate hierarchy --ratio 4 --seed 5"),
        (&SPACE[0], "--locate hierarchy --ratio 4 --seed 3"),
        (&SPACE[0], "--locate jump-and-walk --seed 4"),
    ] {
        for set in [uniform(100), lattice(is_in_space(row))] {
            let [expected, found] = ["", words].map(|words| outcome(row, &set, Map::NONE, &all(&set), words));
            same(&found, &expected, &format!("{} {words} of {}", row.0, set.name));
        }
    }
}
