//! No file that is read is written over: also one that a reader opens by itself, or that has other names, and also by a file that is
//! written beside an output.

use std::fs;

use crate::place::Place;

/// A file of segments whose points are in a `.node` file, as Triangle has them.
fn beside(place: &Place) {
    place.file("beside.poly", "0 2 0 0\n4 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n0\n");
    place.file("beside.node", "4 2 0 0\n0 0 0\n1 2 0\n2 2 2\n3 0 2\n");
}

/// Every file as it was after a line that is refused, which names both files.
fn refused(place: &Place, line: &str, output: &str, input: &str) {
    let content = || {
        let names = fs::read_dir(place.path("")).expect("readable").map(|entry| entry.expect("there").path());
        let mut all: Vec<_> = names.map(|path| (path.clone(), fs::read(path).unwrap_or_default())).collect();
        all.sort();
        all
    };
    let before = content();
    place.fail(line, 2, &format!("{output} would overwrite {input}, which this command reads"));
    assert!(content() == before, "{line}");
}

#[test]
fn points_beside_segments_stay() {
    let place = Place::new();
    beside(&place);
    place.file("p.csv", "0,0\n1,0\n0,1\n");
    for line in [
        "triangulate beside.poly -o beside.node",
        "triangulate beside.poly -o m.npy --stats beside.node",
        "mesh beside.poly -o beside.node",
        "draw beside.poly -o beside.node --to svg",
        "info beside.poly --stats beside.node",
        "simplify beside.poly --max-error 1 -o m.npy --kept beside.node",
        "polygons beside.poly -o beside.node --to geojson",
        "dtm p.csv --breaklines beside.poly --cell 1 -o beside.node --to asc",
    ] {
        refused(&place, line, "beside.node", "beside.node");
    }
    refused(&place, "triangulate beside.poly -o ./beside.node", "./beside.node", "beside.node");
    // Named by an option, which its name does not tell: then it is what was opened that counts.
    fs::rename(place.path("beside.poly"), place.path("beside.txt")).expect("renamed");
    refused(&place, "triangulate beside.txt --from poly -o beside.node", "beside.node", "beside.node");
    // A file that has its points itself reads none beside it.
    place.file("own.poly", "4 2 0 0\n0 0 0\n1 2 0\n2 2 2\n3 0 2\n1 0\n0 0 1\n0\n");
    place.file("own.node", "of another day");
    place.succeed("triangulate own.poly -o own.node");
    assert!(place.read("own.node").starts_with("4 "));
}

#[cfg(unix)]
#[test]
fn other_names_are_the_same_file() {
    let place = Place::new();
    beside(&place);
    let link = |from: &str, to: &str| std::os::unix::fs::symlink(from, place.path(to)).expect("linked");
    link("beside.node", "link.node");
    link("link.node", "chain.node");
    link("beside.poly", "other.poly");
    link("beside.node", "other.node");
    fs::hard_link(place.path("beside.node"), place.path("hard.node")).expect("linked");
    fs::create_dir(place.path("folder")).expect("made");
    for output in ["link.node", "chain.node", "hard.node", "folder/../beside.node"] {
        refused(&place, &format!("triangulate beside.poly -o {output}"), output, "beside.node");
    }
    refused(&place, "triangulate other.poly -o beside.node", "beside.node", "other.node");
    assert!(place.path("other.node").is_symlink());
}

#[test]
fn files_of_folders_stay() {
    let place = Place::new();
    fs::create_dir(place.path("survey")).expect("made");
    let scan = crate::place::data("autzen_trim.laz");
    fs::copy(&scan, place.path("survey/a.laz")).expect("copied");
    let before = fs::read(&scan).expect("there");
    let line = "dtm survey --cell 100 -o survey/a.laz --to tif";
    place.fail(line, 2, "survey/a.laz would overwrite survey/a.laz, which this command reads");
    assert!(fs::read(place.path("survey/a.laz")).expect("there") == before);
    // A folder of tiles, whose files have other names too.
    place.succeed("-q generate uniform -n 300 -o p.npy");
    place.succeed("-q tiles p.npy -o t");
    fs::hard_link(place.path("t/points-00001.npy"), place.path("twin.npy")).expect("linked");
    for line in ["window t -o twin.npy", "check t --stats twin.npy", "info t --stats twin.npy"] {
        place.fail(line, 2, "twin.npy would overwrite t/points-00001.npy, which this command reads");
    }
    place.succeed("check t");
}

#[cfg(unix)]
#[test]
fn files_beside_outputs_are_no_inputs() {
    let place = Place::new();
    let link = |from: &str, to: &str| std::os::unix::fs::symlink(from, place.path(to)).expect("linked");
    place.file("p.csv", "x,y,z\n0,0,1\n9,0,2\n0,9,3\n9,9,4\n");
    link("p.csv", "dem.prj");
    link("p.csv", "dem.tif.aux.xml");
    fs::hard_link(place.path("p.csv"), place.path("hard.prj")).expect("linked");
    refused(&place, "dtm p.csv --cell 1 -o dem.asc", "dem.prj", "p.csv");
    refused(&place, "dtm p.csv --cell 1 -o hard.asc", "hard.prj", "p.csv");
    refused(&place, "dtm p.csv --cell 1 -o dem.tif", "dem.tif.aux.xml", "p.csv");
    // Nor are they other outputs.
    place.fail(
        "dtm p.csv --cell 1 -o a.asc --stats a.prj",
        2,
        "a.prj would overwrite a.prj, which this command writes too",
    );
    place.succeed("dtm p.csv --cell 1 -o other.asc");
    assert!(place.read("p.csv").starts_with("x,y,z"));
}
