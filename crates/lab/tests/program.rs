//! The program as a whole: help, names, wrong usage.

use crate::place::{Place, text};

#[test]
fn help_shows_examples() {
    let place = Place::new();
    for command in ["experiment", "animate", "reduce", "replay"] {
        assert!(place.succeed(&format!("{command} --help")).contains("Example"), "{command}");
    }
    assert!(place.succeed("--version").starts_with("delone-lab "));
}

#[test]
fn wrong_usage_names_this_program() {
    let place = Place::new();
    place.fail("triangulate p.csv -o m.ply", 2, "triangulate");
    let told = text(&place.run("replay --frobnicate").stderr);
    assert!(told.contains("see delone-lab replay --help"), "{told}");
}
