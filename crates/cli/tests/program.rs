//! The program as a user meets it: outputs, exit statuses, messages, and no half-written files.

use std::process::{Command, Stdio};

use crate::place::{Place, answers, data, text};

#[test]
fn real_ground_points_become_a_mesh_and_a_picture() {
    let place = Place::new();
    let tile = data("autzen_trim.laz");
    place.succeed(&format!(
        "triangulate {} --class 2 -o t.ply -o t.png -o t.npy --check --stats s.json",
        tile.display()
    ));
    let stats: serde_json::Value =
        serde_json::from_slice(&std::fs::read(place.path("s.json")).expect("stats")).expect("JSON");
    assert_eq!(
        (&stats["points"], &stats["simplices"], &stats["hull"]),
        (&26107.into(), &52187.into(), &25.into())
    );
    for phase in ["read", "build", "check", "write"] {
        assert!(stats["seconds"][phase].is_number(), "{phase}");
    }
    assert!(std::fs::read(place.path("t.png")).expect("a picture").starts_with(b"\x89PNG"));
    assert!(std::fs::metadata(place.path("t.ply")).expect("a mesh").len() > 1_000_000);
    // The PLY holds the points too, so that it can be judged by itself.
    assert!(place.succeed("check t.ply t.ply").contains("and the canonical"));
    assert!(place.succeed("check t.ply t.npy").contains("52187 triangles"));
}

#[test]
fn every_format_that_is_written_can_be_judged() {
    let place = Place::new();
    for points in ["csv", "xyz", "npy", "bin", "node", "ply", "obj", "geojson"] {
        place.succeed(&format!("generate uniform -n 300 --seed 3 -o p.{points}"));
        for mesh in ["npy", "ele", "ply", "obj", "msh", "mesh", "su2"] {
            place.succeed(&format!("-q triangulate p.{points} -o m.{mesh}"));
            let verdict = place.succeed(&format!("check p.{points} m.{mesh}"));
            assert!(verdict.starts_with("Delaunay, and the canonical"), "{points} {mesh}: {verdict}");
        }
        place.succeed(&format!(
            "triangulate p.{points} -o m.neigh -o m.edge -o m.stl -o m.vtu -o m.inp -o m.geojson -o m.svg"
        ));
    }
}

#[test]
fn algorithms_write_the_same_triangles() {
    let place = Place::new();
    place.succeed("generate grid -n 400 -o p.npy");
    for algorithm in ["divide-conquer", "incremental --locate spatial --seed 5", "incremental --threads 4"] {
        place.succeed(&format!("triangulate p.npy -o m.npy --check --algorithm {algorithm}"));
        assert!(place.succeed("check p.npy m.npy").contains("and the canonical"), "{algorithm}");
    }
}

#[test]
fn statistics_tell_the_threads_there_were() {
    let place = Place::new();
    place.file("p.csv", "0,0,1\n4,0,2\n0,4,3\n5,5,5\n");
    place.file("w.csv", "0\n1\n0\n0\n");
    let json = || -> serde_json::Value {
        let stats = std::fs::read_to_string(place.path("s.json")).expect("written");
        serde_json::from_str(&stats).expect("JSON")
    };
    for command in [
        "triangulate p.csv -o m.npy",
        "triangulate p.csv --dim 3 -o m.npy",
        "triangulate p.csv --weights w.csv -o m.npy",
        "mesh p.csv -o m.npy",
        "hull p.csv --dim 3 -o h.npy",
        "alpha p.csv --dim 3 --optimal -o a.npy",
        "voronoi p.csv -o v.geojson",
        "tiles p.csv -o folder",
    ] {
        for threads in [1, 2] {
            place.succeed(&format!("{command} -q --threads {threads} --stats s.json"));
            assert_eq!(json()["threads"], threads, "{command}");
            _ = std::fs::remove_dir_all(place.path("folder"));
        }
    }
    // What inserts points one by one with a strategy of location has no use for a second one.
    for command in [
        "--algorithm incremental",
        "--locate walk --dim 3",
        "--algorithm incremental --locate history",
        "--hints p.csv",
    ] {
        place.succeed(&format!("triangulate p.csv {command} -o m.npy -q --threads 2 --stats s.json"));
        assert_eq!(json()["threads"], 1, "{command}");
    }
}

#[test]
fn standard_input_and_output() {
    let place = Place::new();
    let mut program = Command::new(env!("CARGO_BIN_EXE_delone"))
        .args(["triangulate", "-", "--from", "csv", "-o", "-", "--to", "ele"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    std::io::Write::write_all(&mut program.stdin.take().expect("piped"), b"0,0\n1,0\n0,1\n")
        .expect("written");
    let output = program.wait_with_output().expect("ended");
    assert_eq!(text(&output.stdout), "1 3 0\n0 0 1 2\n");
    place.fail("triangulate - -o m.npy", 2, "format of - is not known");
    assert!(place.succeed("generate uniform -n 2 -o - --to csv").starts_with("x,y\n"));
}

#[test]
fn sets_without_triangles_are_valid() {
    let place = Place::new();
    for (name, content, note) in [
        ("empty.csv", "", "no points"),
        ("header.csv", "x,y\n", "no points"),
        ("one.csv", "1,2\n", "only one distinct point"),
        ("two.csv", "1,2\n3,4\n", "on one line"),
        ("line.csv", "1,1\n2,2\n3,3\n4,4\n", "on one line"),
        ("equal.csv", "1,1\n1,1\n1,1\n", "only one distinct point"),
    ] {
        place.file(name, content);
        let output = place.run(&format!(
            "triangulate {name} -o m.npy -o m.ply -o m.vtu -o m.svg -o m.png -o m.ele --check"
        ));
        let stderr = text(&output.stderr);
        assert!(output.status.success(), "{name}: {stderr}");
        assert!(stderr.contains("note: ") && stderr.contains(note), "{name}: {stderr}");
        assert!(place.succeed(&format!("check {name} m.npy")).contains("0 triangles"));
        place.succeed(&format!("info {name}"));
    }
}

#[test]
fn bad_points_are_named() {
    let place = Place::new();
    for (name, content, message) in [
        ("nan.csv", "0,0\n1,nan\n", "point 1 has the y coordinate NaN"),
        ("infinite.csv", "0,0\n1,0\n-inf,1\n", "point 2 has the x coordinate -inf"),
        ("huge.csv", "0,0\n1,1e999\n", "point 1 has the y coordinate inf"),
        ("ragged.csv", "0,0\n1,2,3\n", "line 2: 3 fields"),
        ("word.csv", "0,0\n1,two\n", "line 2: field 2 is \"two\""),
        ("narrow.csv", "0\n1\n", "needs two numbers"),
        ("binary.csv", "\u{0}\u{1}", "line 1"),
        ("short.bin", "0123456789", "inside point 0"),
        ("empty.npy", "", "no NumPy array"),
        ("no.npy", "not an array at all", "no NumPy array"),
        ("bad.las", "LASF but nothing else", "ends inside the header"),
        ("bad.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "PLY"),
        ("bad.geojson", "{\"type\":", "GeoJSON"),
        ("bad.node", "3 2 0 0\n0 1 2\n", "ends after 1 of 3 points"),
        ("bad.obj", "v 1 2\n", "line 1: z is missing"),
        ("bad.mesh", "MeshVersionFormatted 2\nDimension 5\n", "line 2: the dimension is 2 or 3"),
        ("bad.su2", "NDIME= 2\nNPOIN= 3\n0 0\n", "the file ends after 1 points"),
        ("bad.msh", "$MeshFormat\n4.1 1 8\n", "line 2: a binary file: save it as text"),
    ] {
        place.file(name, content);
        place.fail(&format!("triangulate {name} -o m.npy"), 1, message);
        place.fail(&format!("draw {name} -o m.svg"), 1, message);
    }
    place.fail("triangulate missing.csv -o m.npy", 1, "missing.csv");
    place.fail("triangulate . --from csv -o m.npy", 1, "folder");
}

/// A NumPy array of a type and a shape, with zeros for content.
fn array(kind: &str, shape: &str, bytes: usize) -> Vec<u8> {
    let mut header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
    while (header.len() + 11) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let mut content = b"\x93NUMPY\x01\x00".to_vec();
    content.extend((header.len() as u16).to_le_bytes());
    content.extend(header.bytes());
    content.extend(std::iter::repeat_n(0, bytes));
    content
}

#[test]
fn wrong_arrays_are_refused() {
    let place = Place::new();
    for (kind, shape, bytes, message) in [
        ("<c16", "(2, 2)", 64, "type c16, which is not read"),
        ("<U4", "(2, 2)", 64, "type U4, which is not read"),
        ("|b1", "(2, 2)", 4, "type b1, which is not read"),
        ("<f8", "(4,)", 32, "shape [4], not (n, 2) or (n, 3)"),
        ("<f8", "(1, 4)", 32, "shape [1, 4]"),
        ("<f8", "(2, 2, 1)", 32, "shape [2, 2, 1]"),
        ("<f8", "(3, 2)", 32, "ends inside row 2 of 3"),
        ("<f8", "(1000000000000, 2)", 32, "ends inside row 2"),
    ] {
        place.file("p.npy", array(kind, shape, bytes));
        place.fail("triangulate p.npy -o m.ply", 1, message);
    }
    place.file("p.npy", array("<f8", "(0, 2)", 0));
    assert!(place.succeed("triangulate p.npy -o - --to ele").starts_with("0 3 0"));
    place.file("p.npy", array(">f8", "(2, 3)", 48));
    place.succeed("triangulate p.npy -o m.npy");
}

#[test]
fn arrays_in_either_order() {
    let place = Place::new();
    let bytes = |numbers: &[f64]| numbers.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>();
    let rows = [array("<f8", "(3, 2)", 0), bytes(&[0.0, 0.0, 5.0, 0.0, 0.0, 7.0])].concat();
    place.file("rows.npy", &rows);
    assert!(place.succeed("info rows.npy").contains("y                      0.0 to 7.0"));
    let mut turned = rows.clone();
    let at = rows.windows(5).position(|w| w == b"False").expect("the flag");
    turned[at..at + 5].copy_from_slice(b"True ");
    turned.truncate(rows.len() - 48);
    turned.extend(bytes(&[0.0, 5.0, 0.0, 0.0, 0.0, 7.0]));
    place.file("columns.npy", turned);
    assert_eq!(place.succeed("info columns.npy"), place.succeed("info rows.npy"));
}

#[test]
fn a_truncated_tile_is_refused() {
    let place = Place::new();
    let whole = std::fs::read(data("autzen_trim.laz")).expect("the tile");
    for length in [10, 300, 5_000, whole.len() / 2, whole.len() - 100] {
        place.file("cut.laz", &whole[..length]);
        place.fail("triangulate cut.laz -o m.ply", 1, "the file ends");
    }
}

#[test]
fn wrong_usage() {
    let place = Place::new();
    place.file("p.csv", "0,0\n1,0\n0,1\n");
    for (line, message) in [
        ("triangulate p.csv", "required"),
        ("triangulate p.csv -o m.what", "no format has this extension"),
        ("triangulate p.csv -o m", "no format has this extension"),
        ("triangulate p.csv -o m.las", "triangles are not written to las files"),
        ("triangulate p.csv -o p.csv", "would overwrite"),
        ("triangulate p.csv -o ./p.csv --to ply", "would overwrite"),
        ("triangulate p.csv -o m.ply -o ./m.ply", "would overwrite"),
        ("triangulate p.csv -o m.ply --stats m.ply", "would overwrite"),
        ("triangulate p.csv -o m.ply --stats p.csv", "would overwrite"),
        ("draw p.csv -o m.svg --stats p.csv", "would overwrite"),
        ("info p.csv --stats p.csv", "would overwrite"),
        ("triangulate p.csv -o m.ply --algorithm sweep", "sweep"),
        ("triangulate p.csv -o m.ply --locate spatial", "--locate"),
        ("triangulate p.csv -o m.ply --dim 4", "4"),
        ("triangulate p.csv -o m.ply --dim 3 --algorithm divide-conquer", "for the plane"),
        ("triangulate p.csv -o m.geojson --dim 3", "tetrahedra are not written to geojson files"),
        ("triangulate p.csv -o m.ply --dim 3 --locate stars", "for the plane"),
        ("triangulate p.csv -o m.ply --threads 0", "0"),
        ("triangulate p.csv -o m.ply --class 2", "--class"),
        ("triangulate p.csv -o m.ply --class two", "two"),
        ("draw p.csv -o m.ply", "pictures are not written to ply files"),
        ("draw p.csv -o m.png --size 3", "3"),
        ("generate nothing -n 5 -o p.npy", "no set named"),
        ("generate uniform -n 5", "output file is missing"),
        ("generate uniform -n x -o q.npy", "x"),
        ("contours p.csv -o c.geojson --interval 5m", "'--interval <DZ>': not a number"),
        ("generate uniform -o q.npy --seed 0.5", "'--seed <S>': not a whole number"),
        ("frobnicate", "frobnicate"),
        ("check p.csv p.csv --stats p.csv", "would overwrite"),
        ("check p.csv -", "standard input"),
        ("check p.csv m.laz", "m.laz"),
    ] {
        let status = if line.ends_with("m.laz") { 1 } else { 2 };
        place.fail(line, status, message);
    }
    place.file("p.svg", "");
    place.fail("triangulate p.svg -o m.ply", 2, "points are not read");
    for (line, help) in [
        ("triangulate p.csv -o m.ply --3d", "help: did you mean --dim 3? see delone triangulate --help"),
        ("triangulate p.csv -o m.ply -3", "help: did you mean --dim 3? see delone triangulate --help"),
        ("thiessen p.csv", "help: did you mean voronoi? see delone --help, or delone COMMAND --help"),
        ("dtm p.csv -o m.tif --resolution 2", "help: did you mean --cell? see delone dtm --help"),
        ("triangulate p.csv m.ply", "help: name the output with -o FILE; see delone triangulate --help"),
        ("contours p.csv -o c.gpkg --interval 5m", "help: see delone contours --help"),
        ("animate p.csv", "delone-lab: cargo install --locked --path crates/lab"),
        ("voronoi p.csv -o c.kml", "as an output write gpkg, and convert that"),
        ("voronoi p.csv --clip 0,0,9,9 -o c.csv", "help: give the box as --box 0,0,9,9"),
        (
            "hull p.csv -o h.geojson",
            "delone alpha --alpha inf writes it as a polygon, delone draw as a picture",
        ),
        ("relief p.csv -o shade.png", "; delone dtm makes one of points with heights"),
    ] {
        let output = place.run(line);
        let told = text(&output.stderr);
        assert!(output.status.code() == Some(2) && told.trim_end().ends_with(help), "{line}: {told}");
    }
}

#[test]
fn outputs_that_cannot_be_written() {
    let place = Place::new();
    place.file("p.csv", "0,0\n1,0\n0,1\n");
    place.fail("triangulate p.csv -o no/such/folder/m.ply", 1, "cannot write");
    std::fs::create_dir(place.path("taken.ply")).expect("made");
    place.fail("triangulate p.csv -o taken.ply", 1, "cannot write");
    let kept = place.file("kept.ply", "precious");
    place.file("bad.csv", "0,0\nx,y\n");
    place.fail("triangulate bad.csv -o kept.ply", 1, "line 2");
    assert_eq!(std::fs::read(kept).expect("still there"), b"precious");
}

#[test]
fn triangles_are_judged() {
    let place = Place::new();
    place.file("p.csv", "0,0\n1,0\n1,1\n0,1\n");
    place.file("good.ele", "2 3 0\n1 1 2 4\n2 2 3 4\n");
    place.file("other.obj", "f 1 2 3\nf 1 3 4\n");
    place.file("overlap.obj", "f 1 2 3\nf 1 2 4\n");
    place.file("index.obj", "f 1 2 9\n");
    assert!(place.succeed("check p.csv good.ele --stats s.json").contains("and the canonical"));
    assert!(place.succeed("check p.csv other.obj").contains("not the canonical triangulation: 1 of its"));
    place.fail("check p.csv overlap.obj", 1, "triangles 0 and 1 overlap");
    place.fail("check p.csv index.obj", 1, "triangle 0 has the corner 8, but there are 4 points");
    place.file("q.csv", "0,0\n1,0\n1.2,1.2\n0,1\n");
    place.fail("check q.csv other.obj", 1, "triangle 0 is not Delaunay: its circle contains point 3");
}

#[test]
fn the_same_seed_gives_the_same_bytes() {
    let place = Place::new();
    place.succeed("generate disks -n 500 --seed 9 -o a.bin");
    place.succeed("generate disks -n 500 --seed 9 -o b.bin");
    assert_eq!(
        std::fs::read(place.path("a.bin")).expect("a"),
        std::fs::read(place.path("b.bin")).expect("b")
    );
    assert!(place.succeed("generate list").contains("ellipse2"));
}

#[test]
fn every_command_writes_stats() {
    let place = Place::new();
    for line in [
        "generate uniform -n 50 -o p.npy",
        "triangulate p.npy -o m.npy",
        "check p.npy m.npy",
        "draw p.npy -o m.svg",
        "info p.npy",
        "voronoi p.npy -o v.svg",
        "hull p.npy -o h.npy",
        "furthest p.npy --queries p.npy -o f.npy",
    ] {
        place.succeed(&format!("{line} --stats s.json"));
        let bytes = std::fs::read(place.path("s.json")).expect("stats");
        let stats: serde_json::Value = serde_json::from_slice(&bytes).expect("JSON");
        assert_eq!(stats["points"], 50, "{line}");
        for key in ["duplicates", "simplices", "hull", "counters"] {
            assert!(stats.get(key).is_some(), "{line}: {key}");
        }
        for phase in ["read", "build", "write"] {
            assert!(stats["seconds"][phase].is_number(), "{line}: {phase}");
        }
    }
}

#[test]
fn help_shows_examples() {
    let place = Place::new();
    for command in ["triangulate", "check", "generate", "draw", "info", "voronoi", "hull", "furthest"] {
        assert!(place.succeed(&format!("{command} --help")).contains("Example"), "{command}");
    }
    assert!(place.succeed("--version").starts_with("delone "));
}

#[test]
fn strategies_of_location_give_the_same_answers() {
    let place = Place::new();
    place.file("points.csv", "0,0\n4,0\n0,4\n4,4\n2,2\n");
    place.file("queries.csv", "1,0.5\n2,2\n1,1\n9,9\n2,0\n");
    for locate in ["tree", "walk", "jump-and-walk", "hierarchy", "history", "stars", "delaunay-tree"] {
        let line = format!("locate points.csv --queries queries.csv -o - --to csv --locate {locate}");
        let found = answers(&place.succeed(&line), 3);
        assert_eq!(found[0], [0.0, 1.0, 4.0], "{locate}");
        assert!(found[1].contains(&4.0) && found[2].contains(&0.0) && found[2].contains(&4.0), "{locate}");
        assert_eq!(found[3], [-1.0; 3], "{locate}");
        assert_eq!(found[4], [0.0, 1.0, 4.0], "{locate}");
        let nearest = place.succeed(&format!(
            "nearest points.csv --queries queries.csv -k 2 -o - --to csv --locate {locate}"
        ));
        let pairs = [[0.0, 4.0], [4.0, 0.0], [0.0, 4.0], [3.0, 4.0], [0.0, 4.0]];
        assert_eq!(answers(&nearest, 2), pairs, "{locate}");
    }
    place.succeed("nearest points.csv --queries queries.csv -k 7 -o n.npy --stats s.json");
    let bytes = std::fs::read(place.path("n.npy")).expect("written");
    assert!(text(&bytes).contains("'descr': '<i8'") && text(&bytes).contains("(5, 7"));
    let stats = std::fs::read_to_string(place.path("s.json")).expect("written");
    assert!(stats.contains("\"queries\": 5") && stats.contains("\"visited\""));
}

#[test]
fn every_way_to_build_writes_the_same_triangles() {
    let place = Place::new();
    place.succeed("generate duplicates -n 500 --seed 3 -o p.npy");
    place.succeed("triangulate p.npy -o expected.npy");
    let sorted = |name: &str| {
        let bytes = std::fs::read(place.path(name)).expect("written");
        let start = bytes.iter().position(|&b| b == b'\n').expect("a header") + 1;
        let numbers: Vec<i64> =
            bytes[start..].as_chunks().0.iter().map(|chunk| i64::from_le_bytes(*chunk)).collect();
        let mut triangles: Vec<[i64; 3]> = numbers.as_chunks().0.to_vec();
        for t in &mut triangles {
            let least = (0..3).min_by_key(|&k| t[k]).expect("three corners");
            t.rotate_left(least);
        }
        triangles.sort_unstable();
        triangles
    };
    for locate in ["tree", "walk", "jump-and-walk", "hierarchy", "history", "conflict", "spatial"] {
        place.succeed(&format!(
            "triangulate p.npy -o other.npy --algorithm incremental --locate {locate} --check"
        ));
        assert_eq!(sorted("other.npy"), sorted("expected.npy"), "{locate}");
    }
}

#[test]
fn wrong_queries_are_named() {
    let place = Place::new();
    place.file("points.csv", "0,0\n4,0\n0,4\n");
    place.file("bad.csv", "1,1\nnan,2\n");
    place.fail("locate points.csv --queries bad.csv -o t.npy", 1, "query 1: the x coordinate NaN");
    place.fail("nearest points.csv --queries bad.csv -o t.npy -k 3", 1, "query 1: the x coordinate NaN");
    place.fail("locate points.csv --queries none.csv -o t.npy", 1, "none.csv");
    place.fail(
        "locate points.csv --queries points.csv -o t.png",
        2,
        "answers to queries are not written to png files",
    );
    place.fail("locate points.csv --queries points.csv -o points.csv", 2, "overwrite");
    place.fail("nearest points.csv --queries points.csv -o t.npy -k 0", 2, "0");
    place.fail("nearest points.csv --queries points.csv -o t.npy --locate conflict", 2, "building in bulk");
    place.file("empty.csv", "");
    assert_eq!(
        place.succeed("locate empty.csv --queries points.csv -o - --to csv -q"),
        "x,y,a,b,c\n0.0,0.0,-1,-1,-1\n4.0,0.0,-1,-1,-1\n0.0,4.0,-1,-1,-1\n"
    );
    let nearest = place.succeed("nearest empty.csv --queries points.csv -o - --to csv -q");
    assert_eq!(answers(&nearest, 1), [[-1.0]; 3]);
    assert_eq!(place.succeed("locate points.csv --queries empty.csv -o - --to csv -q"), "x,y,a,b,c\n");
}

/// What was a command once is named with the program that has it.
#[test]
fn commands_of_the_lab_name_it() {
    let place = Place::new();
    for (command, rest) in [
        ("experiment", "hierarchy -o out"),
        ("animate", "p.csv"),
        ("reduce", "--help"),
        ("replay", "- --check"),
    ] {
        let output = place.run(&format!("{command} {rest}"));
        assert_eq!(output.status.code(), Some(2), "{command}");
        let told = text(&output.stderr);
        assert!(
            told.contains(&format!("help: {command} is a command of delone-lab: cargo install")),
            "{told}"
        );
    }
}

/// Features that are left out are named, with the way to get them.
#[test]
#[cfg(not(feature = "parquet"))]
fn features_that_are_off_say_how_to_get_them() {
    let place = Place::new();
    place.file("p.csv", "0,0\n1,0\n0,1\n");
    for (line, feature) in
        [("tiles p.csv -o t --parquet", "parquet"), ("tiles nothing.csv --parquet -o t", "parquet")]
    {
        place.fail(line, 2, &format!("built without {feature}"));
        let help = text(&place.run(line).stderr);
        assert!(help.contains(&format!("cargo install delone-cli --features {feature}")), "{help}");
    }
    let help = place.succeed("tiles --help").split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(help.contains("without the feature parquet"), "{help}");
}
