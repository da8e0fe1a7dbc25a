//! Units, order, repetition, threads, strategies, turns and moves change all outputs of the program as they must, and in no other way.
//!
//! Each row of the table is a command with what there is to compare of its files. Scaled by a power of two, in another order, with points
//! twice, on any number of threads and by any strategy it gives the same numbers, to the bit. Turned or moved, sets without ties give the
//! same turned or moved, to the bit where nothing is rounded on the way.

mod given;
mod judge;
mod table;

use std::collections::BTreeSet;

use crate::place::Place;
use given::{Map, integers, lattice, uniform};
use judge::{all, is_in_space, judge, judge_turned_and_moved, outcome, same};
use table::{PLANE, SPACE};

/// Commands that give no geometry, or none of points that they are given.
const OTHERS: [&str; 8] = ["check", "completions", "generate", "help", "info", "man", "relief", "version"];

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
    ("tiles", &["--workers 3", "--neighbors --memory 64M"]),
    ("hull --dim 3", &["--algorithm history --seed 3", "--algorithm flips --seed 4"]),
    ("locate --dim 3", &["--locate hierarchy --ratio 4 --seed 3", "--locate jump-and-walk --seed 4"]),
    ("nearest --dim 3", &["--locate hierarchy --ratio 4 --seed 3", "--locate jump-and-walk --seed 4"]),
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
