//! Units, order, repetition, threads, strategies, turns and moves change all outputs of the program as they must, and in no other way.
//!
//! Each row of the table is a command with what there is to compare of its files. Scaled by a power of two, in another order, with points
//! twice, on any number of threads and by any strategy it gives the same numbers, to the bit. Turned or moved, sets without ties give the
//! same turned or moved, to the bit where nothing is rounded on the way.

mod given;
mod table;

use std::collections::BTreeSet;

use delone_generators::Random;

use crate::place::Place;
use given::{Given, Map, Set, Shape, compare, integers, lattice, uniform};
use table::{PLANE, Row, SPACE};

/// Commands that give no geometry, or none of points that they are given.
const OTHERS: [&str; 10] =
    ["check", "completions", "experiment", "generate", "help", "info", "man", "reduce", "relief", "version"];

/// Shapes in an order of their own.
fn outcome(row: &Row, set: &Set, map: Map, which: &[usize], words: &str) -> Vec<Shape> {
    let mut shapes = (row.1)(&Given::new(set, map, which, words));
    // What is no number is one kind of it, and so are zeros.
    let plain = |x: &mut f64| *x = if x.is_nan() { f64::INFINITY } else { *x + 0.0 };
    shapes.iter_mut().flatten().for_each(plain);
    shapes.sort_by(|p, q| compare(p, q));
    shapes
}

/// Says where two outcomes differ.
fn same(found: &[Shape], expected: &[Shape], what: &str) {
    if let Some(k) = found.iter().zip(expected).position(|(p, q)| compare(p, q).is_ne()) {
        let [found, expected] = [found, expected].map(|shapes| &shapes[k][..shapes[k].len().min(40)]);
        panic!("{what}: shape {k}\n  is  {found:?}\n  not {expected:?}");
    }
    assert_eq!(found.len(), expected.len(), "{what}");
}

fn is_one_of(row: &Row, names: &[&str]) -> bool {
    names.iter().any(|name| row.0.starts_with(name))
}

fn is_in_space(row: &Row) -> bool {
    row.0.contains("--dim 3")
}

fn all(set: &Set) -> Vec<usize> {
    (0..set.points.len()).collect()
}

/// Pictures show points in their order, one above the other, and motion at random in it: of them the unit alone is tried.
const PICTURES: [&str; 2] = ["draw", "animate"];

/// A site at the point of another one can have no area. An overview has points of each tile, and tiles have so many, repeated or not.
const ONCE: [&str; 2] = ["voronoi --areas", "window --points"];

fn judge(table: &[Row], set: &Set, powers: &[i32]) {
    for row in table {
        let expected = outcome(row, set, Map::NONE, &all(set), "");
        assert!(!expected.is_empty(), "{} of {}: nothing", row.0, set.name);
        let judge = |map: Map, which: &[usize], words: &str, what: String| {
            let what = format!("{} of {}, {what}", row.0, set.name);
            same(&outcome(row, set, map, which, words), &expected, &what);
        };
        for &k in powers {
            // Heights of the plane have a unit of their own, but how steep slopes are is seen in pictures.
            let up = if is_in_space(row) || is_one_of(row, &PICTURES) { k } else { 20 - k / 5 };
            judge(Map { powers: [k, k, up], ..Map::NONE }, &all(set), "", format!("scaled by 2^{k}, 2^{up}"));
        }
        if is_one_of(row, &PICTURES) {
            continue;
        }
        let mut which = all(set);
        Random::new(9).shuffle(&mut which);
        judge(Map::NONE, &which, "--threads 1", "in another order".into());
        if !is_one_of(row, &ONCE) {
            which.extend(all(set));
            Random::new(10).shuffle(&mut which);
            judge(Map::NONE, &which, "--threads 7", "every point twice".into());
        }
    }
}

#[test]
fn units_order_and_repetition_change_nothing_in_the_plane() {
    judge(PLANE, &uniform(100), &[-300, -40, 1, 300]);
}

#[test]
fn ties_do_not_depend_on_them_in_the_plane() {
    judge(PLANE, &lattice(false), &[-300, 52]);
}

#[test]
fn units_order_and_repetition_change_nothing_in_space() {
    judge(SPACE, &uniform(60), &[-300, 40, 300]);
    judge(SPACE, &lattice(true), &[-300, 52]);
}

/// Numbers to a thousandth, where the last bits may differ.
fn rounded(mut shapes: Vec<Shape>) -> Vec<Shape> {
    shapes.iter_mut().flatten().for_each(|x| *x = (*x * 1024.0).round() / 1024.0 + 0.0);
    shapes.sort_by(|p, q| compare(p, q));
    shapes
}

/// Floating point chooses where new vertices go, and of equally long edges the least comes first; curves of tiles run along the axes.
const NOT_TURNED: [&str; 4] = ["mesh", "window --points", "draw", "animate"];

/// Sums begin at the lexicographically least point, and squares of lengths at the first axis: turned sets round both differently.
const ROUNDED_IF_TURNED: [&str; 11] = [
    "triangulate --segments",
    "triangulate polygons",
    "polygons",
    "voronoi: areas",
    "voronoi --areas",
    "voronoi --relax",
    "graph --dim 3",
    "furthest",
    "contours",
    "dtm",
    "interpolate",
];

/// Places that are no points of the input are rounded, and numbers are as far apart as where they are says.
const ROUNDED_IF_MOVED: [&str; 6] =
    ["voronoi", "polygons", "triangulate polygons", "furthest", "contours", "dtm"];

fn judge_turned_and_moved(table: &[Row], set: &Set, turns: &[[i8; 3]], shift: [f64; 3]) {
    for row in table.iter().filter(|row| !is_one_of(row, &PICTURES)) {
        let expected = outcome(row, set, Map::NONE, &all(set), "");
        let judge = |map: Map, is_rounded: bool| {
            let found = outcome(row, set, map, &all(set), "");
            let what = format!("{} of {}, {map:?}", row.0, set.name);
            if is_rounded {
                same(&rounded(found), &rounded(expected.clone()), &what);
            } else {
                same(&found, &expected, &what);
            }
        };
        if !is_one_of(row, &NOT_TURNED) {
            turns
                .iter()
                .for_each(|&axes| judge(Map { axes, ..Map::NONE }, is_one_of(row, &ROUNDED_IF_TURNED)));
        }
        if !row.0.starts_with("mesh") {
            judge(Map { shift, ..Map::NONE }, is_one_of(row, &ROUNDED_IF_MOVED));
        }
    }
}

#[test]
fn right_angles_mirrors_and_moves_do_the_same_to_results() {
    let shift = [65536.0, -(640.0 * 1024.0), 0.0];
    judge_turned_and_moved(PLANE, &integers(80), &[[-2, 1, 3], [-1, 2, 3], [2, 1, 3]], shift);
    let shift = [65536.0, -(640.0 * 1024.0), 12345.0];
    judge_turned_and_moved(SPACE, &integers(50), &[[2, 3, 1], [1, -3, 2], [1, 2, -3]], shift);
}

/// Rows whose work threads share, if there is enough of it.
const SHARED: &[&str] = &[
    "triangulate",
    "triangulate --weights",
    "triangulate --hints",
    "triangulate --segments",
    "graph --kind spanning-tree",
    "graph --kind beta",
    "alpha --filtration",
    "simplify --max-error",
    "dtm --method smooth",
    "triangulate --dim 3",
    "graph --dim 3 --kind nearest",
];

#[test]
fn threads_change_nothing() {
    let set = uniform(8500);
    for row in PLANE.iter().chain(SPACE).filter(|row| SHARED.contains(&row.0)) {
        let expected = outcome(row, &set, Map::NONE, &all(&set), "--threads 1");
        for threads in [2, 7] {
            let found = outcome(row, &set, Map::NONE, &all(&set), &format!("--threads {threads}"));
            same(&found, &expected, &format!("{}, {threads} threads", row.0));
        }
    }
}

/// Words that change the course of a row alone.
const COURSES: &[(&str, &[&str])] = &[
    ("triangulate", LOCATED),
    ("triangulate --hints", &["--hint-order random --seed 5"]),
    ("locate", WALKS),
    ("nearest", WALKS),
    ("replay", WALKS),
    ("tiles", &["--workers 3", "--neighbors --memory 64M"]),
    ("hull --dim 3", &["--algorithm history --seed 3", "--algorithm flips --seed 4"]),
    ("locate --dim 3", &["--locate hierarchy --ratio 4 --seed 3", "--locate jump-and-walk --seed 4"]),
    ("nearest --dim 3", &["--locate hierarchy --ratio 4 --seed 3", "--locate jump-and-walk --seed 4"]),
    ("replay --dim 3", &["--locate hierarchy --ratio 4 --seed 3", "--locate jump-and-walk --seed 4"]),
    ("triangulate --dim 3", &["--algorithm incremental --locate hierarchy --seed 3"]),
];
const WALKS: &[&str] = &[
    "--locate walk --walk stochastic --seed 3",
    "--locate jump-and-walk --seed 4",
    "--locate hierarchy --ratio 4 --seed 5",
];
const LOCATED: &[&str] = &[
    "--algorithm incremental --seed 1",
    "--algorithm incremental --locate walk --seed 2",
    "--algorithm incremental --locate jump-and-walk --seed 3",
    "--algorithm incremental --locate hierarchy --seed 4",
    "--algorithm incremental --locate history --seed 5",
    "--algorithm incremental --locate stars --seed 6",
    "--algorithm incremental --locate delaunay-tree --seed 7",
    "--algorithm incremental --locate conflict --seed 8",
    "--algorithm incremental --locate tree --seed 9",
];

#[test]
fn strategies_and_seeds_change_nothing() {
    for (name, words) in COURSES {
        let row = PLANE.iter().chain(SPACE).find(|row| row.0 == *name).expect(name);
        for set in [uniform(100), lattice(is_in_space(row))] {
            let expected = outcome(row, &set, Map::NONE, &all(&set), "");
            for words in *words {
                let found = outcome(row, &set, Map::NONE, &all(&set), words);
                same(&found, &expected, &format!("{name} {words} of {}", set.name));
            }
        }
    }
}

#[test]
fn every_command_that_gives_geometry_has_a_row() {
    let help = Place::new().succeed("--help");
    let (_, commands) = help.split_once("Commands:\n").expect("commands");
    let commands = commands.lines().take_while(|line| !line.is_empty());
    let names = commands.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let listed: BTreeSet<&str> = names.filter(|name| !name.is_empty()).collect();
    let rows = PLANE.iter().chain(SPACE).filter_map(|row| row.0.split([' ', ':']).next());
    assert_eq!(listed, rows.chain(OTHERS).collect());
}
