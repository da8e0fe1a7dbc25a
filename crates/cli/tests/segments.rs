//! Points with segments as a user meets them: what is written, in which order, and what is said of it.

use std::process::{Command, Stdio};

use crate::place::{Place, rows, text};

/// The triangles that `triangulate` writes of something.
fn triangles(place: &Place, what: &str) -> Vec<Vec<i64>> {
    place.succeed(&format!("-q triangulate {what} -o triangles.npy"));
    array(&std::fs::read(place.path("triangles.npy")).expect("an array"))
}

/// The rows of a NumPy array of triangles.
fn array(bytes: &[u8]) -> Vec<Vec<i64>> {
    let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let numbers: Vec<i64> =
        bytes[start..].chunks(8).map(|x| i64::from_le_bytes(x.try_into().expect("whole"))).collect();
    numbers.chunks(3).map(<[i64]>::to_vec).collect()
}

/// A square with a square hole, a duplicate of its first corner, and a region, counted from 1.
const PLAN: &str = "9 2 0 0
1 0 0
2 9 0
3 9 9
4 0 9
5 0 0
6 3 3
7 6 3
8 6 6
9 3 6
8 0
1 5 2
2 2 3
3 3 4
4 4 1
5 6 7
6 7 8
7 8 9
8 9 6
1
1 4 4
1
1 1 1 7 -1
";

/// Two diagonals of a square and a point beside.
const CROSS: &str = "5 2 0 0\n1 0 0\n2 2 2\n3 0 2\n4 2 0\n5 4 1\n2 0\n1 1 2\n2 3 4\n0\n";

#[test]
fn rows_are_indices_in_file_order() {
    let place = Place::new();
    place.file("plan.poly", PLAN);
    // All of the hull: 8 vertices, 4 of them on it.
    place.succeed("-q triangulate plan.poly --fill all -o t.npy -o t.ele --check --stats s.json");
    let all = triangles(&place, "plan.poly --fill all");
    assert_eq!(all.len(), 10);
    assert!(all.iter().flatten().all(|&i| (0..9).contains(&i) && i != 4), "{all:?}");
    assert!(all.iter().flatten().any(|&i| i == 0), "of equal points the first is the vertex");
    assert_eq!(array(&std::fs::read(place.path("t.npy")).expect("an array")), all);
    // Triangle's own format counts as the file does.
    let ele = std::fs::read_to_string(place.path("t.ele")).expect("triangles");
    assert!(ele.lines().nth(1).expect("a triangle").starts_with("1 "), "{ele}");
    // Without the hole, which is the default.
    let inside = triangles(&place, "plan.poly");
    assert_eq!(inside.len(), 8);
    assert!(inside.iter().all(|row| all.contains(row)));
    let stats: serde_json::Value =
        serde_json::from_slice(&std::fs::read(place.path("s.json")).expect("stats")).expect("JSON");
    assert_eq!(
        (&stats["segments"], &stats["constraints"], &stats["parts"]),
        (&8.into(), &8.into(), &2.into())
    );
}

#[test]
fn crossings_are_refused_or_split() {
    let place = Place::new();
    place.file("cross.poly", CROSS);
    place.fail("triangulate cross.poly -o t.npy", 1, "segments 0 and 1 cross near (1, 1)");
    let told = text(&place.run("triangulate cross.poly -o t.npy").stderr);
    assert!(told.contains("\nhelp: ") && told.contains("--crossings split"), "{told}");
    place
        .succeed("triangulate cross.poly --crossings split --fill all -o t.node -o t.ply -o t.ele -o t.poly");
    let read = |name: &str| std::fs::read_to_string(place.path(name)).expect("written");
    let node = read("t.node");
    let lines: Vec<&str> = node.lines().collect();
    assert_eq!((lines.len(), lines[5], lines[6]), (7, "5 4.0 1.0", "6 1.0 1.0"), "{node}");
    let ply = std::fs::read(place.path("t.ply")).expect("a mesh");
    assert!(text(&ply).contains("element vertex 6"));
    // The pieces are segments of the .poly file, so that all can be judged.
    assert!(place.succeed("check t.poly t.ele").contains("and the canonical triangulation: 5 triangles"));
    place.fail("check cross.poly t.ele", 1, "corner 5");
}

#[test]
fn bad_files_are_named() {
    let place = Place::new();
    for end in [0, 20, 60, 90, 130, PLAN.len() - 12] {
        place.file("short.poly", &PLAN[..end]);
        place.fail("triangulate short.poly -o t.npy", 1, "short.poly");
        place.fail("draw short.poly -o t.svg", 1, "short.poly");
    }
    place.file("p.csv", "0,0\n1,0\n0,1\n");
    place.file("s.csv", "0,1\n1,3\n");
    place.fail("triangulate p.csv --segments s.csv -o t.npy", 1, "segment 1 ends at point 3");
    place.file("open.geojson", r#"{"type":"Polygon","coordinates":[[[0,0],[1,0],[0,1]]]}"#);
    place.fail("triangulate open.geojson -o t.npy", 1, "ring 0 of polygon 0 is not closed");
    place.file("s.png", "0,1\n");
    place.fail("triangulate p.csv --segments s.png -o t.npy", 2, "segments are not read from png");
    place.fail("triangulate p.csv --segments s.csv --dim 3 -o t.npy", 2, "segments are for the plane");
    place.fail("draw p.csv --segments s.csv --hints -o t.svg", 2, "segments are for the plane");
    place.fail("triangulate p.csv --segments p.csv -o p.csv", 2, "would overwrite");
}

#[test]
fn files_are_joined_and_standard_input_is_read() {
    let place = Place::new();
    place.file("plan.poly", PLAN);
    place.file("more.csv", "1,2\n20,20\n");
    let all = triangles(&place, "plan.poly more.csv --fill all");
    // 10 vertices, 5 of them on the hull; the second file's points follow those of the first.
    assert!(all.iter().flatten().any(|&i| i == 10) && all.iter().flatten().all(|&i| i < 11), "{all:?}");
    place.file("s.csv", "9,10\n");
    place.fail("triangulate plan.poly more.csv --segments s.csv -o t.npy", 1, "cross");
    let mut program = Command::new(env!("CARGO_BIN_EXE_delone"))
        .args(["-q", "triangulate", "-", "--from", "poly", "-o", "-", "--to", "npy"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    std::io::Write::write_all(&mut program.stdin.take().expect("piped"), PLAN.as_bytes()).expect("written");
    let output = program.wait_with_output().expect("ended");
    assert_eq!(array(&output.stdout), triangles(&place, "plan.poly"));
}

#[test]
fn named_graphs_are_written_judged_and_drawn() {
    let place = Place::new();
    assert!(place.succeed("generate list").contains("\nWith segments:\n"));
    for name in ["planar-subset", "planar-grid", "koch", "comb", "star", "nested-squares", "grid-segments"] {
        place.succeed(&format!("-q generate {name} -n 100 --seed 2 -o g.poly"));
        place.succeed("-q triangulate g.poly --fill all -o g.npy");
        assert!(place.succeed("check g.poly g.npy").contains("and the canonical"), "{name}");
        for other in ["geojson", "wkt"] {
            place.succeed(&format!("-q generate {name} -n 100 --seed 2 -o g.{other}"));
            place.succeed(&format!("-q triangulate g.{other} --fill all --check -o o.npy --stats s.json"));
            let stats: serde_json::Value =
                serde_json::from_slice(&std::fs::read(place.path("s.json")).expect("stats")).expect("JSON");
            let read = std::fs::read(place.path("g.npy")).expect("an array");
            assert_eq!(
                read.len() - 128,
                stats["simplices"].as_u64().expect("a count") as usize * 24,
                "{name}"
            );
        }
        place.succeed("-q draw g.poly -o g.svg -o g.png --size 200");
    }
    let told = text(&place.run("generate koch -n 20 -o g.npy").stderr);
    assert!(told.contains("npy files hold no segments"), "{told}");
    place.fail("generate koch -n 20 --noise 1 -o none.poly", 2, "--noise is for points");
    let about = place.succeed("info g.poly");
    assert!(about.contains("segments   ") && about.contains("crossings              0"), "{about}");
    place.file("cross.poly", CROSS);
    assert!(place.succeed("info cross.poly").contains("crossings              1"));
}

#[test]
fn triangles_from_elsewhere_are_judged() {
    let place = Place::new();
    place.file("p.csv", "0,0\n8,0\n4,1\n4,-1\n");
    place.file("s.csv", "1,0\n");
    place.file("long.ele", "2 3 0\n0 0 1 2\n1 0 3 1\n");
    place.file("short.ele", "2 3 0\n0 0 3 2\n1 3 1 2\n");
    assert!(place.succeed("check p.csv long.ele --segments s.csv").contains("and the canonical"));
    assert!(place.succeed("check p.csv short.ele").contains("and the canonical"));
    place.fail("check p.csv short.ele --segments s.csv", 1, "not Delaunay: segment 0 is missing");
    place.fail("check p.csv long.ele", 1, "circle contains point");
    place.file("both.csv", "1,0\n2,3\n");
    place.fail("check p.csv long.ele --segments both.csv", 1, "segments 0 and 1 cross");
    // A square that is divided in the other way.
    place.file("q.csv", "0,0\n1,0\n1,1\n0,1\n5,5\n");
    place.file("q.seg.csv", "0,1\n");
    place.succeed("-q triangulate q.csv --segments q.seg.csv -o q.npy");
    assert!(place.succeed("check q.csv q.npy --segments q.seg.csv").contains("and the canonical"));
    let ours = triangles(&place, "q.csv");
    let divided = ours.iter().any(|row| row.contains(&0) && row.contains(&2));
    let [first, second] = if divided { ["0 1 3", "1 2 3"] } else { ["0 1 2", "0 2 3"] };
    place.file("q.ele", format!("4 3 0\n0 {first}\n1 {second}\n2 1 4 2\n3 2 4 3\n"));
    let verdict = place.succeed("check q.csv q.ele --segments q.seg.csv");
    assert!(verdict.contains("not the canonical triangulation: 1 of its"), "{verdict}");
    place.fail("check p.csv long.ele --segments s.csv --dim 3", 2, "--segments is for the plane");
}

#[test]
fn polygons_are_triangulated_each_alone() {
    let place = Place::new();
    // A square with a hole, a bow tie, and two parts of one multipolygon; the second part is the same as the first polygon's hole.
    place.file(
        "p.wkt",
        "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (3 3, 3 6, 6 6, 6 3, 3 3))\nPOLYGON ((10 0, 12 2, 12 0, 10 2, 10 0))
MULTIPOLYGON (((20 0, 21 0, 20 1, 20 0)), ((3 3, 6 3, 6 6, 3 6, 3 3)))\nPOINT (1 1)\n",
    );
    place.fail("polygons p.wkt -o t.npy", 1, "polygon 1: segments 0 and 2 cross near (11, 1)");
    let output = place.run("polygons p.wkt -o - --to csv --keep-going");
    let (told, found) = (text(&output.stderr), rows(&text(&output.stdout)));
    assert!(
        told.contains("note: polygon 1 is left out") && told.contains("4 polygons, 1 left out"),
        "{told}"
    );
    let of = |range: std::ops::Range<i64>| {
        found.iter().filter(|row| row.iter().all(|i| range.contains(i))).count()
    };
    assert_eq!((of(0..8), of(8..12), of(12..15), of(15..19), found.len()), (8, 0, 1, 2, 11));
    // Where sides cross a point is added, which follows all corners and those of no polygon.
    let split = rows(&place.succeed("-q polygons p.wkt -o - --to csv --crossings split"));
    let added: Vec<_> = split.iter().filter(|row| row.contains(&20)).collect();
    assert_eq!((split.len(), added.len()), (13, 2), "{split:?}");
    place.succeed(
        "-q polygons p.wkt -o t.ply -o t.obj -o t.geojson -o t.wkt -o t.svg -o t.png --size 100 --keep-going",
    );
    let geojson = std::fs::read_to_string(place.path("t.geojson")).expect("features");
    assert_eq!(geojson.matches("\"polygon\":3}").count(), 2, "{geojson}");
    // A ring around twice is inside by one rule only.
    place.file("twice.json", "[[[0,0],[4,0],[0,4],[0,0],[4,0],[0,4]]]");
    assert!(place.succeed("-q polygons twice.json -o - --to csv").is_empty());
    assert_eq!(rows(&place.succeed("-q polygons twice.json --fill nonzero -o - --to csv")).len(), 1);
    place.fail("polygons p.wkt -o t.ele", 2, "triangles of polygons are not written to ele");
    place.fail("polygons p.wkt -o p.wkt", 2, "would overwrite");
    place.file("none.wkt", "POINT (1 1)\n");
    place.fail("polygons none.wkt -o t.csv", 1, "none.wkt: there is no polygon in it");
    place.file("empty.wkt", "POLYGON EMPTY\n");
    assert!(place.succeed("-q polygons empty.wkt -o - --to csv").is_empty());
}
