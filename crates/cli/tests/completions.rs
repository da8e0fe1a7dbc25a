//! Scripts of shells complete formats and names of sets.

use std::process::Command;

use crate::place::{Place, text};

/// The words that bash offers after a line.
fn offered(place: &Place, line: &str) -> Vec<String> {
    let script = format!(
        "source c.bash; COMP_WORDS=({line}); COMP_CWORD=$(({} - 1)); COMPREPLY=(); \
         _delone delone \"${{COMP_WORDS[COMP_CWORD]}}\" \"${{COMP_WORDS[COMP_CWORD - 1]}}\"; echo \"${{COMPREPLY[@]}}\"",
        line.split(' ').count()
    );
    let output = Command::new("bash").args(["-c", &script]).current_dir(place.path("")).output();
    let output = output.expect("bash");
    text(&output.stdout).split_whitespace().map(str::to_owned).collect()
}

#[test]
fn formats_and_sets_are_completed() {
    let place = Place::new();
    for shell in ["bash", "zsh", "fish"] {
        let script = place.succeed(&format!("completions {shell}"));
        place.file(&format!("c.{shell}"), &script);
        for word in ["gpkg", "unit-circle", "planar-subset", "laz"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
    if Command::new("bash").arg("--version").output().is_err() {
        return;
    }
    assert_eq!(offered(&place, "delone triangulate x --to gp"), ["gpkg"]);
    assert_eq!(offered(&place, "delone triangulate x --from la"), ["lammpstrj", "las", "laz"]);
    assert_eq!(offered(&place, "delone generate unif"), ["uniform"]);
    assert!(offered(&place, "delone draw x --to s").contains(&"svg".to_owned()));
    // What is written alone is not read.
    assert!(offered(&place, "delone draw x --from sv").is_empty());
}
