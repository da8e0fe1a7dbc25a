//! Rows of a table on sets that are changed, compared with the sets as they were.

use delone_generators::Random;

use super::given::{Given, Map, Row, Set, Shape, compare};

/// Shapes in an order of their own.
pub(super) fn outcome(row: &Row, set: &Set, map: Map, which: &[usize], words: &str) -> Vec<Shape> {
    let mut shapes = (row.1)(&Given::new(set, map, which, words));
    // What is no number is one kind of it, and so are zeros.
    let plain = |x: &mut f64| *x = if x.is_nan() { f64::INFINITY } else { *x + 0.0 };
    shapes.iter_mut().flatten().for_each(plain);
    shapes.sort_by(|p, q| compare(p, q));
    shapes
}

/// Says where two outcomes differ.
pub(super) fn same(found: &[Shape], expected: &[Shape], what: &str) {
    if let Some(k) = found.iter().zip(expected).position(|(p, q)| compare(p, q).is_ne()) {
        let [found, expected] = [found, expected].map(|shapes| &shapes[k][..shapes[k].len().min(40)]);
        panic!("{what}: shape {k}\n  is  {found:?}\n  not {expected:?}");
    }
    assert_eq!(found.len(), expected.len(), "{what}");
}

fn is_one_of(row: &Row, names: &[&str]) -> bool {
    names.iter().any(|name| row.0.starts_with(name))
}

pub(super) fn is_in_space(row: &Row) -> bool {
    row.0.contains("--dim 3")
}

pub(super) fn all(set: &Set) -> Vec<usize> {
    (0..set.points.len()).collect()
}

/// Pictures show points in their order, one above the other, and motion at random in it: of them the unit alone is tried.
const PICTURES: [&str; 2] = ["draw", "animate"];

/// A site at the point of another one can have no area. An overview has points of each tile, and tiles have so many, repeated or not.
const ONCE: [&str; 2] = ["voronoi --areas", "window --points"];

pub(super) fn judge(table: &[Row], set: &Set, powers: &[i32]) {
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

pub(super) fn judge_turned_and_moved(table: &[Row], set: &Set, turns: &[[i8; 3]], shift: [f64; 3]) {
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
