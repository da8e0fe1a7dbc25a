//! Triangle's switches: which files are written, and what is in them.

use crate::place::{Place, text};

/// A square with a square hole and a bay that no segment closes, counted from 1. Two regions, one with a largest area.
const PLAN: &str = "10 2 0 1
1 0 0 0
2 8 0 0
3 8 8 5
4 0 8 0
5 3 3 0
6 5 3 0
7 5 5 0
8 3 5 0
9 12 4 0
10 4 0 0
11 1
1 1 10 2
2 10 2 2
3 2 3 0
4 3 4 0
5 4 1 0
6 5 6 0
7 6 7 0
8 7 8 0
9 8 5 0
10 10 6 0
11 3 7 4
1
1 4 4
2
1 1 7 1.5 0.25
2 7 1 2.5 -1
";

fn place() -> Place {
    let place = Place::new();
    place.file("x.poly", PLAN);
    place
}

/// The names in the folder, without the input.
fn names(place: &Place) -> Vec<String> {
    let entries = std::fs::read_dir(place.0.path()).expect("readable");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned()).collect();
    names.retain(|name| name != "x.poly");
    names.sort();
    names
}

fn numbers(place: &Place, name: &str) -> Vec<Vec<f64>> {
    let file = std::fs::read_to_string(place.path(name)).expect(name);
    let rows = file
        .lines()
        .map(|line| line.split_whitespace().map(|word| word.parse().expect("a number")).collect());
    rows.filter(|row: &Vec<f64>| !row.is_empty()).collect()
}

/// The triangles by their corners' coordinates, and their areas.
fn triangles(place: &Place, stem: &str) -> Vec<([[f64; 2]; 3], f64)> {
    let node = numbers(place, &format!("{stem}.node"));
    let base = node[1][0] as usize;
    let corner = |i: f64| {
        let row = &node[1 + i as usize - base];
        [row[1], row[2]]
    };
    let of = |row: &Vec<f64>| {
        let [p, q, r] = [1, 2, 3].map(|k| corner(row[k]));
        ([p, q, r], ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2.0)
    };
    numbers(place, &format!("{stem}.ele"))[1..].iter().map(of).collect()
}

#[test]
fn each_letter_writes_its_files() {
    for (line, expected) in [
        ("p", "x.1.ele x.1.node x.1.poly"),
        ("-p", "x.1.ele x.1.node x.1.poly"),
        ("pP", "x.1.ele x.1.node"),
        ("pN", "x.1.ele x.1.poly"),
        ("pE", "x.1.node x.1.poly"),
        ("pNEP", ""),
        ("pNEPe", "x.1.edge"),
        ("pNEPn", "x.1.neigh"),
        ("pNEPv", "x.1.v.edge x.1.v.node"),
        ("pNEPg", "x.1.off"),
        ("pgo2", "x.1.ele x.1.node x.1.off x.1.poly"),
        ("pI", "x.ele x.node"),
        ("pIv", "x.ele x.node x.v.edge x.v.node"),
        ("pq30a0.5uAcDjevngBPNEIOXzo2YYS99iFlsCQVV", "x.edge x.neigh x.off x.v.edge x.v.node"),
    ] {
        let place = place();
        place.file("size.csv", "0,0,9\n9,0,9\n");
        place.succeed(&format!("mesh x.poly --triangle {line} --size size.csv"));
        let mut names = names(&place);
        names.retain(|name| name != "size.csv");
        assert_eq!(names.join(" "), expected, "{line}");
        // A name without an extension is the .poly file with p.
        place.succeed(&format!("mesh x --triangle {line} --size size.csv"));
    }
}

#[test]
fn letters_mean_what_they_mean_there() {
    let place = place();
    let area = |stem: &str| triangles(&place, stem).iter().map(|one| one.1).sum::<f64>();
    // Without p the points alone: x.node is not there.
    place.fail("mesh x.poly --triangle q", 2, "there is no such file, but a .poly file");
    // No refinement without q, a, u or D: the constrained triangulation, without hole and bay.
    place.succeed("-q mesh x.poly --triangle p");
    assert_eq!((numbers(&place, "x.1.node").len(), area("x.1")), (11, 60.0));
    // Holes stay, bays stay.
    place.succeed("-q mesh x.poly --triangle pO");
    assert_eq!(area("x.1"), 64.0);
    place.succeed("-q mesh x.poly --triangle pc");
    assert_eq!(area("x.1"), 76.0);
    place.succeed("-q mesh x.poly --triangle pcO");
    assert_eq!(area("x.1"), 80.0);
    // Markers of points and edges, and none.
    let markers = |name: &str| {
        numbers(&place, name)[1..].iter().map(|row| *row.last().expect("one")).collect::<Vec<_>>()
    };
    assert_eq!(numbers(&place, "x.1.node")[0], [10.0, 2.0, 0.0, 1.0]);
    place.succeed("-q mesh x.poly --triangle pe");
    assert_eq!(markers("x.1.node"), [2.0, 2.0, 5.0, 1.0, 1.0, 1.0, 4.0, 1.0, 0.0, 2.0]);
    place.succeed("-q mesh x.poly --triangle peB");
    assert_eq!(numbers(&place, "x.1.node")[0], [10.0, 2.0, 0.0, 0.0]);
    assert_eq!((numbers(&place, "x.1.edge")[0][1], numbers(&place, "x.1.poly")[11][1]), (0.0, 0.0));
    // Numbers from 1 as in the input, from 0, and without the vertex outside.
    assert_eq!(numbers(&place, "x.1.ele")[1][0], 1.0);
    place.succeed("-q mesh x.poly --triangle pz");
    assert_eq!((numbers(&place, "x.1.ele")[1][0], numbers(&place, "x.1.node")[1][0]), (0.0, 0.0));
    assert_eq!(area("x.1"), 60.0);
    place.succeed("-q mesh x.poly --triangle pj");
    assert_eq!((numbers(&place, "x.1.node").len(), area("x.1")), (10, 60.0));
    // Regions: areas with a bare a, attributes with A.
    let largest = |low: f64, high: f64| {
        let all = triangles(&place, "x.1");
        let middle = |corners: &[[f64; 2]; 3]| corners.iter().map(|p| p[0]).sum::<f64>() / 3.0;
        let some = all.iter().filter(|one| (low..high).contains(&middle(&one.0)));
        some.map(|one| one.1).fold(0.0, f64::max)
    };
    place.succeed("-q mesh x.poly --triangle pqaA");
    let attributes: std::collections::BTreeSet<String> =
        numbers(&place, "x.1.ele")[1..].iter().map(|row| row[4].to_string()).collect();
    // The hole and the two segments at it part the plan: what has no seed has 0 as attribute.
    assert!(attributes.len() <= 2 && attributes.contains("1.5"), "{attributes:?}");
    assert!(largest(0.0, 3.0) <= 0.25 && numbers(&place, "x.1.ele")[0][2] == 1.0);
    place.succeed("-q mesh x.poly --triangle pq");
    assert!(largest(0.0, 3.0) > 0.25 && numbers(&place, "x.1.ele")[0][2] == 0.0);
    place.succeed("-q mesh x.poly --triangle pa1.5");
    assert!(largest(0.0, 9.0) <= 1.5 && largest(0.0, 3.0) > 0.25);
    place.succeed("-q mesh x.poly --triangle pa1.5a");
    assert!(largest(0.0, 9.0) <= 1.5 && largest(0.0, 3.0) <= 0.25);
    // Budget, and segments that are kept.
    place.succeed("-q mesh x.poly --triangle pq30a0.1S7");
    assert_eq!(numbers(&place, "x.1.node").len(), 18);
    place.succeed("-q mesh x.poly --triangle pq30a0.1YY");
    assert_eq!(numbers(&place, "x.1.poly")[11][0], 11.0);
    // Six nodes.
    place.succeed("-q mesh x.poly --triangle po2");
    assert_eq!(numbers(&place, "x.1.ele")[0][1], 6.0);
    // The Voronoi diagram goes with the triangles.
    place.succeed("-q mesh x.poly --triangle pqDev");
    assert_eq!(numbers(&place, "x.1.v.node")[0][0], numbers(&place, "x.1.ele")[0][0]);
    assert_eq!(numbers(&place, "x.1.v.edge")[0][0], numbers(&place, "x.1.edge")[0][0]);
}

#[test]
fn meshes_are_refined_again_and_again() {
    let place = place();
    place.succeed("-q mesh x.poly --triangle pqA");
    let first = triangles(&place, "x.1");
    let rows: Vec<String> = (1..=first.len()).map(|i| format!("{i} 0.5")).collect();
    place.file("x.1.area", format!("{}\n{}\n", first.len(), rows.join("\n")));
    for name in ["x.1", "x.1.node", "x.1.ele", "x.1.poly", "x.1.area"] {
        place.succeed(&format!("-q mesh {name} --triangle rqaC"));
        let second = triangles(&place, "x.2");
        assert!(second.iter().all(|one| one.1 > 0.0 && one.1 <= 0.5));
        assert!((second.iter().map(|one| one.1).sum::<f64>() - 60.0).abs() < 1e-9);
        // Attributes are handed down.
        assert!(
            numbers(&place, "x.2.ele")[1..].iter().all(|row| row[4] == 0.0 || row[4] == 1.5 || row[4] == 2.5)
        );
    }
    assert!(!names(&place).contains(&"x.2.poly".to_owned()));
    place.succeed("-q mesh x.2 --triangle rqa0.2");
    assert!(triangles(&place, "x.3").iter().all(|one| one.1 <= 0.2));
    // With p segments keep their markers.
    place.succeed("-q mesh x.1 --triangle prqa0.4");
    let segments = &numbers(&place, "x.2.poly");
    assert!(segments[1 + segments[0][0] as usize][1] == 1.0);
    place.fail("mesh x.1 --triangle rqI", 2, "would be written over");
    place.file("y.csv", "0,0\n1,0\n0,1\n");
    place.fail("mesh y.csv --triangle rq", 2, "the switch r is for .node files");
    place.fail("mesh x.poly --triangle r", 2, "there is no such file");
}

#[test]
fn inputs_are_not_written_over() {
    let place = Place::new();
    // The points are in a file of their own.
    place.file("y.node", "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n");
    place.file("y.poly", "0 2 0 0\n3 0\n0 0 1\n1 1 2\n2 2 0\n0\n");
    let before = std::fs::read(place.path("y.node")).expect("points");
    place.succeed("-q mesh y.poly --triangle pa0.1I");
    assert_eq!(std::fs::read(place.path("y.node")).expect("points"), before);
    assert!(place.path("y.ele").exists());
    place.succeed("-q mesh y.node --triangle a0.1I");
    assert_eq!(std::fs::read(place.path("y.node")).expect("points"), before);
    // Segments that cross are split, as Triangle does.
    place.file("cross.poly", "4 2 0 0\n1 0 0\n2 2 2\n3 0 2\n4 2 0\n2 0\n1 1 2\n2 3 4\n0\n");
    place.succeed("-q mesh cross.poly --triangle pc");
    assert_eq!(numbers(&place, "cross.1.node").len(), 6);
    place.fail("mesh cross.poly --triangle pc --crossings refuse", 1, "cross");
    // Other formats, other outputs.
    place.file("z.wkt", "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0))");
    place.succeed("-q mesh z.wkt --triangle pqa1");
    assert!(place.path("z.1.ele").exists() && place.path("z.1.poly").exists());
    place.succeed("-q mesh z.wkt --triangle pqa1 -o only.ply");
    assert!(place.path("only.ply").exists());
    place.fail("mesh y.node cross.poly --triangle p", 2, "if that is one file");
    place.fail("mesh - --from poly --triangle p", 2, "if that is one file");
}

#[test]
fn wrong_and_needless_switches_are_told() {
    let place = place();
    place.fail("mesh x.poly --triangle pw", 2, "no switch 'w', which is at position 2");
    place.fail("mesh x.poly --triangle pq1.2.3", 2, "1.2.3, which is no number");
    place.fail("mesh x.poly --triangle po", 2, "wants the number 2");
    place.fail("mesh x.poly --triangle pu", 2, "size of one's own");
    place.fail("mesh x.poly --triangle pa0", 2, "max-area is 0");
    let told = text(&place.run("mesh x.poly --triangle piFlsX").stderr);
    assert_eq!(told.lines().filter(|line| line.contains(" is ignored (")).count(), 5, "{told}");
    assert!(text(&place.run("mesh x.poly --triangle pQX").stderr).is_empty());
    assert!(place.succeed("mesh x.poly --triangle pV").starts_with("  0 to  10 degrees"));
    let help = place.succeed("mesh --help");
    let table = place.succeed("mesh nothing --triangle h");
    assert_eq!(table.lines().count(), 32);
    assert!(table.lines().all(|line| help.contains(line)), "{help}");
    assert!(place.succeed("--help").contains("mesh"));
}
