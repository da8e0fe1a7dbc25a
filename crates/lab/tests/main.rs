//! All tests of the program from outside, in one program.

mod animate;
mod experiments;
mod metamorphic;
#[allow(dead_code, reason = "the tests of `delone` use more of it")]
#[path = "../../cli/tests/place/mod.rs"]
mod place;
mod program;
mod reduce;
mod replay;

use delone_generators::{Kind, Kind3};

use place::Place;

/// The program.
const PROGRAM: &str = env!("CARGO_BIN_EXE_delone-lab");

/// Writes a named set of points as csv.
fn set(place: &Place, kind: &str, count: usize, file: &str) {
    let row = |p: &[f64]| p.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(",") + "\n";
    let plane = Kind::named(kind).map(|kind| kind.points(count, 1).iter().map(|p| row(p)).collect());
    let space = || Kind3::named(kind).map(|kind| kind.points(count, 1).iter().map(|p| row(p)).collect());
    let rows: String = plane.or_else(space).expect("a name");
    place.file(file, rows);
}
