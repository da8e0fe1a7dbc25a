//! Meshes as a user meets them: what is written is read back and measured by nothing but its coordinates.

use std::collections::BTreeSet;
use std::process::{Command, Stdio};

use crate::place::{Place, text};

/// A square with a square hole, a segment inside that ends freely, heights 2 x + y + 5, markers, and a region.
pub(crate) const PLAN: &str = "# a plan
10 2 1 1
1 0 0 5 0
2 9 0 23 0
3 9 9 32 3
4 0 9 14 0
5 3 3 14 0
6 6 3 20 0
7 6 6 23 0
8 3 6 17 0
9 1 1 8 0
10 1 7 14 0
9 1
1 1 2 2
2 2 3 0
3 3 4 7
4 4 1 0
5 5 6 9
6 6 7 9
7 7 8 9
8 8 5 9
9 9 10 -4
1
1 4 4
1
1 0.5 0.5 7 -1
";

/// A mesh as its `.node` and `.ele` files have it, with indices from 0.
pub(crate) struct Mesh {
    pub(crate) points: Vec<[f64; 2]>,
    pub(crate) attributes: Vec<Vec<f64>>,
    pub(crate) markers: Vec<i64>,
    pub(crate) triangles: Vec<[usize; 3]>,
    pub(crate) regions: Vec<f64>,
}

fn numbers(file: &str) -> Vec<Vec<f64>> {
    let lines = file.lines().map(|line| line.split('#').next().unwrap_or_default());
    let rows =
        lines.map(|line| line.split_whitespace().map(|word| word.parse().expect("a number")).collect());
    rows.filter(|row: &Vec<f64>| !row.is_empty()).collect()
}

pub(crate) fn mesh(place: &Place, stem: &str) -> Mesh {
    let (node, ele) =
        (numbers(&place.read(&format!("{stem}.node"))), numbers(&place.read(&format!("{stem}.ele"))));
    let (width, has_markers) = (node[0][2] as usize, node[0][3] == 1.0);
    assert_eq!(node[0][0] as usize, node.len() - 1, "the header counts the points");
    assert_eq!(ele[0][0] as usize, ele.len() - 1, "the header counts the triangles");
    let base = node.get(1).map_or(0, |row| row[0] as usize);
    let corners = |row: &Vec<f64>| [1, 2, 3].map(|k| row[k] as usize - base);
    Mesh {
        points: node[1..].iter().map(|row| [row[1], row[2]]).collect(),
        attributes: node[1..].iter().map(|row| row[3..3 + width].to_vec()).collect(),
        markers: if has_markers {
            node[1..].iter().map(|row| row[3 + width] as i64).collect()
        } else {
            Vec::new()
        },
        triangles: ele[1..].iter().map(corners).collect(),
        regions: ele[1..]
            .iter()
            .filter(|_| ele[0][2] > 0.0)
            .map(|row| *row.last().expect("numbers"))
            .collect(),
    }
}

impl Mesh {
    pub(crate) fn area_of(&self, [a, b, c]: [usize; 3]) -> f64 {
        let [p, q, r] = [a, b, c].map(|i| self.points[i]);
        ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2.0
    }

    pub(crate) fn area(&self) -> f64 {
        self.triangles.iter().map(|&t| self.area_of(t)).sum()
    }

    fn angles(&self) -> Vec<f64> {
        let length = |i: usize, j: usize| {
            let (p, q) = (self.points[i], self.points[j]);
            (p[0] - q[0]).hypot(p[1] - q[1])
        };
        let each = self.triangles.iter().flat_map(|&[a, b, c]| [[a, b, c], [b, c, a], [c, a, b]]);
        // By the law of cosines, which the program uses nowhere.
        each.map(|[a, b, c]| {
            let (x, y, z) = (length(a, b), length(a, c), length(b, c));
            ((x * x + y * y - z * z) / (2.0 * x * y)).clamp(-1.0, 1.0).acos().to_degrees()
        })
        .collect()
    }

    pub(crate) fn edges(&self) -> BTreeSet<[usize; 2]> {
        let sides = self.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        sides.map(|[v, w]| [v.min(w), v.max(w)]).collect()
    }

    /// The points on an axis-parallel segment, in their order along it.
    fn along(&self, [p, q]: [[f64; 2]; 2]) -> Vec<usize> {
        let across = usize::from(p[0] != q[0]);
        let (low, high) = (p[1 - across].min(q[1 - across]), p[1 - across].max(q[1 - across]));
        let is_on = |x: &[f64; 2]| x[across] == p[across] && (low..=high).contains(&x[1 - across]);
        let mut on: Vec<usize> = (0..self.points.len()).filter(|&i| is_on(&self.points[i])).collect();
        on.sort_by(|&i, &j| self.points[i][1 - across].total_cmp(&self.points[j][1 - across]));
        on
    }

    /// Everything that is true of all meshes: oriented, no side used twice in one direction, angles as wanted.
    pub(crate) fn judge(&self, min_angle: f64) {
        let mut sides = BTreeSet::new();
        for &t in &self.triangles {
            assert!(self.area_of(t) > 0.0, "{t:?}");
            let [a, b, c] = t;
            assert!(
                [[a, b], [b, c], [c, a]].into_iter().all(|side| sides.insert(side)),
                "{t:?} overlaps another"
            );
        }
        let smallest = self.angles().into_iter().fold(180.0, f64::min);
        assert!(smallest > min_angle - 1e-6, "an angle of {smallest} degrees");
    }
}

/// The segments of the plan, with their markers as Triangle gives them to edges.
const SEGMENTS: [([[f64; 2]; 2], i64); 9] = [
    ([[0.0, 0.0], [9.0, 0.0]], 2),
    ([[9.0, 0.0], [9.0, 9.0]], 1),
    ([[9.0, 9.0], [0.0, 9.0]], 7),
    ([[0.0, 9.0], [0.0, 0.0]], 1),
    ([[3.0, 3.0], [6.0, 3.0]], 9),
    ([[6.0, 3.0], [6.0, 6.0]], 9),
    ([[6.0, 6.0], [3.0, 6.0]], 9),
    ([[3.0, 6.0], [3.0, 3.0]], 9),
    ([[1.0, 1.0], [1.0, 7.0]], -4),
];

#[test]
fn a_mesh_is_what_was_asked_for() {
    let place = Place::new();
    place.file("plan.poly", PLAN);
    for (options, min_angle, max_area) in [
        ("", 20.0, f64::INFINITY),
        ("--min-angle 33", 33.0, f64::INFINITY),
        ("--min-angle 30 --max-area 0.3", 30.0, 0.3),
        ("--max-edge 0.8", 20.0, 0.4),
        ("--smooth 5 --min-angle 25 --max-area 0.3", 25.0, 0.3),
        ("--conforming --max-area 0.5", 20.0, 0.5),
        ("--drop-unused --min-angle 25 --max-area 1", 25.0, 1.0),
    ] {
        place.succeed(&format!(
            "-q mesh plan.poly {options} --check --strict -o m.node -o m.ele -o m.edge -o m.poly --stats s.json"
        ));
        let mesh = mesh(&place, "m");
        mesh.judge(min_angle);
        assert!(mesh.triangles.iter().all(|&t| mesh.area_of(t) <= max_area), "{options}");
        assert!((mesh.area() - 72.0).abs() < 1e-9, "{options}: {}", mesh.area());
        assert!(mesh.regions.iter().all(|&region| region == 7.0) && !mesh.regions.is_empty());
        let edges = mesh.edges();
        let marked: Vec<Vec<f64>> = numbers(&place.read("m.edge"))[1..].to_vec();
        for (ends, marker) in SEGMENTS {
            let along = mesh.along(ends);
            assert_eq!(mesh.points[along[0]].map(|x| x.min(9.0)), [0, 1].map(|k| ends[0][k].min(ends[1][k])));
            for pair in along.windows(2) {
                let side = [pair[0].min(pair[1]), pair[0].max(pair[1])];
                assert!(edges.contains(&side), "{options}: a part of {ends:?} is no edge");
                let is_it = |row: &&Vec<f64>| {
                    let found = [row[1] as usize - 1, row[2] as usize - 1];
                    [found[0].min(found[1]), found[0].max(found[1])] == side
                };
                assert_eq!(marked.iter().find(is_it).expect("an edge")[3] as i64, marker, "{ends:?}");
            }
            // What is strictly inside of a segment was added, and has its marker.
            for &i in &along[1..along.len() - 1] {
                assert_eq!(mesh.markers[i], marker, "{options}: point {i} on {ends:?}");
            }
        }
        assert_eq!(mesh.markers[2], 3, "a point keeps its marker");
        // Linear values stay linear, wherever points were added.
        for (p, row) in mesh.points.iter().zip(&mesh.attributes) {
            assert!((row[0] - (2.0 * p[0] + p[1] + 5.0)).abs() < 1e-12, "{p:?} {row:?}");
        }
        let stats: serde_json::Value = serde_json::from_str(&place.read("s.json")).expect("JSON");
        let count = |key: &str| stats[key].as_u64().expect(key) as usize;
        assert_eq!((count("points"), count("simplices")), (mesh.points.len(), mesh.triangles.len()));
        assert_eq!(count("steiner_inside") + count("steiner_on_constraints") + 10, mesh.points.len());
        let angles = mesh.angles();
        let histogram: Vec<usize> = stats["histogram"]
            .as_array()
            .expect("a list")
            .iter()
            .map(|n| n.as_u64().expect("a number") as usize)
            .collect();
        assert_eq!((histogram.len(), histogram.iter().sum::<usize>()), (18, angles.len()));
        let steep = angles.iter().filter(|&&angle| angle > 90.0 + 1e-6).count();
        assert!(histogram[9..].iter().sum::<usize>() >= steep);
        let smallest = angles.iter().copied().fold(180.0, f64::min);
        assert!((stats["smallest_angle"].as_f64().expect("an angle") - smallest).abs() < 1e-6);
        assert!(
            ["duplicates", "hull", "seconds", "left", "largest_angle"]
                .iter()
                .all(|key| !stats[key].is_null())
        );
        assert!(stats["left"].as_object().expect("reasons").values().all(|count| *count == 0));
        // What was written is a graph whose constrained triangulation is the mesh.
        place.succeed("-q triangulate m.poly -o again.ele");
        assert_eq!(numbers(&place.read("again.ele"))[0][0] as usize, mesh.triangles.len());
    }
}

#[test]
fn many_formats_are_read_and_written() {
    let place = Place::new();
    place.file("ring.wkt", "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (2 2, 2 4, 4 4, 4 2, 2 2))");
    // A polygon with a line inside that does not bound it.
    place.file(
        "both.geojson",
        r#"{"type":"GeometryCollection","geometries":[
            {"type":"Polygon","coordinates":[[[0,0],[8,0],[8,8],[0,8],[0,0]],[[2,2],[2,4],[4,4],[4,2],[2,2]]]},
            {"type":"LineString","coordinates":[[6,1],[6,7]]}]}"#,
    );
    place.file("p.csv", "0,0\n8,0\n8,8\n0,8\n2,2\n4,2\n4,4\n2,4\n");
    place.file("s.csv", "0,1\n1,2\n2,3\n3,0\n4,5\n5,6\n6,7\n7,4\n");
    for input in ["ring.wkt", "both.geojson", "p.csv --segments s.csv --fill even-odd"] {
        place.succeed(&format!("-q mesh {input} --check --max-area 0.5 -o m.node -o m.ele -o m.poly"));
        let mesh = mesh(&place, "m");
        mesh.judge(20.0);
        assert!((mesh.area() - 60.0).abs() < 1e-9, "{input}: {}", mesh.area());
        // Holes are written as seeds, so that the graph means the same.
        place.succeed("-q triangulate m.poly -o again.ele");
        assert_eq!(numbers(&place.read("again.ele"))[0][0] as usize, mesh.triangles.len(), "{input}");
    }
    place.succeed(
        "-q mesh ring.wkt --min-angle 30 -o m.v.node -o m.v.edge -o m.neigh -o m.npy -o m.ply -o m.obj -o m.off -o m.stl -o m.vtu \
         -o m.msh -o m.inp -o m.mesh -o m.su2 -o m.2dm -o m.14 -o m.bdf -o m.xdmf -o m.geojson -o m.wkt -o m.wkb -o m.svg -o m.png --color angle",
    );
    // Geomview's file has the points and the triangles.
    place.succeed("-q mesh m.off --refine m.off --min-angle 0 -o off.node -o off.ele");
    assert!((mesh(&place, "off").area() - 60.0).abs() < 1e-9);
    assert!(place.read("m.svg").contains("<svg"));
    place.succeed(
        "-q mesh ring.wkt --second-order -o six.node -o six.ele -o six.msh -o six.2dm -o six.bdf -o six.xdmf",
    );
    assert_eq!(numbers(&place.read("six.ele"))[0][1], 6.0);
    place.fail("mesh ring.wkt --second-order -o six.ply", 2, "second order");
    place.fail("mesh ring.wkt -o m.las", 2, "las");
    let mut program = Command::new(env!("CARGO_BIN_EXE_delone"))
        .args(["-q", "mesh", "-", "--from", "poly", "-o", "-", "--to", "ele"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    std::io::Write::write_all(&mut program.stdin.take().expect("piped"), PLAN.as_bytes()).expect("written");
    let output = program.wait_with_output().expect("ended");
    place.file("plan.poly", PLAN);
    assert_eq!(text(&output.stdout), place.succeed("-q mesh plan.poly -o - --to ele"));
}

#[test]
fn smoothing_makes_angles_larger() {
    let place = Place::new();
    place.file("plan.poly", PLAN);
    let mean = |rounds: usize| {
        place.succeed(&format!(
            "-q mesh plan.poly --max-area 0.2 --smooth {rounds} --check -o m.node -o m.ele"
        ));
        let mesh = mesh(&place, "m");
        let angles = mesh.angles();
        angles.chunks(3).map(|three| three.iter().copied().fold(180.0, f64::min)).sum::<f64>()
            / mesh.triangles.len() as f64
    };
    let (before, after) = (mean(0), mean(5));
    assert!(after > before + 1.0, "{before} {after}");
}

#[test]
fn off_centers_make_fewer_triangles() {
    let place = Place::new();
    let wing = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/gallery/wing.poly");
    place.file("wing.poly", std::fs::read(wing).expect("a file of the gallery"));
    let count = |placement: &str| {
        place.succeed(&format!("-q mesh wing.poly --min-angle 30 {placement} --check -o m.node -o m.ele"));
        mesh(&place, "m").triangles.len()
    };
    let [usual, off, center] = ["", "--placement offcenter", "--placement circumcenter"].map(count);
    assert!(usual == off && off < center, "{usual} {off} {center}");
}

#[test]
fn colors_of_angles_differ_from_others() {
    let place = Place::new();
    place.file("plan.poly", PLAN);
    place.succeed("-q mesh plan.poly -o a.svg --color angle -o a.png");
    place.succeed("-q mesh plan.poly -o b.svg -o b.png");
    assert_ne!(place.read("a.svg"), place.read("b.svg"));
    assert_ne!(
        std::fs::read(place.path("a.png")).expect("a"),
        std::fs::read(place.path("b.png")).expect("b")
    );
}

#[test]
fn sizes_come_from_a_file() {
    let place = Place::new();
    place.file("square.poly", "4 2 0 0\n1 0 0\n2 8 0\n3 8 8\n4 0 8\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
    // Small on the left, large on the right, in columns that are named.
    let sizes = "edge,x,y\n0.25,0,0\n0.25,0,8\n2,8,0\n2,8,8\n";
    place.file("sizes.csv", sizes);
    place.succeed("-q mesh square.poly --size sizes.csv --size-columns x,y,edge --check -o m.node -o m.ele");
    let mesh = mesh(&place, "m");
    mesh.judge(20.0);
    for &[a, b, c] in &mesh.triangles {
        let [p, q, r] = [a, b, c].map(|i| mesh.points[i]);
        let wanted = 0.25 + 1.75 * (p[0] + q[0] + r[0]) / 24.0;
        let longest = [[p, q], [q, r], [r, p]]
            .map(|[p, q]| (p[0] - q[0]).hypot(p[1] - q[1]))
            .into_iter()
            .fold(0.0, f64::max);
        assert!(longest <= wanted * (1.0 + 1e-12), "{longest} where {wanted} is wanted");
    }
    let left = mesh.triangles.iter().filter(|t| t.iter().all(|&i| mesh.points[i][0] < 2.0)).count();
    let right = mesh.triangles.iter().filter(|t| t.iter().all(|&i| mesh.points[i][0] > 6.0)).count();
    assert!(left > 5 * right, "{left} {right}");
    // Around the points the nearest counts: one point is a constant.
    place.file("one.csv", "100,100,0.5\n");
    place.succeed("-q mesh square.poly --size one.csv -o m.node -o m.ele");
    let longest = |mesh: &Mesh| {
        let lengths = mesh.edges().into_iter().map(|[i, j]| {
            let (p, q) = (mesh.points[i], mesh.points[j]);
            (p[0] - q[0]).hypot(p[1] - q[1])
        });
        lengths.fold(0.0, f64::max)
    };
    assert!(longest(&self::mesh(&place, "m")) <= 0.5);
    // Of a file of Triangle the first attribute counts.
    place.file("one.node", "1 2 2 0\n1 100 100 0.5 7\n");
    let one = place.read("m.node");
    place.succeed("-q mesh square.poly --size one.node -o m.node");
    assert_eq!(place.read("m.node"), one);
    for (bad, named) in [("0", "is 0"), ("-1", "is -1"), ("nan", "is NaN"), ("-inf", "is -inf")] {
        place.file("bad.csv", format!("0,0,1\n8,0,{bad}\n"));
        place.fail("mesh square.poly --size bad.csv -o m.vtu", 1, &format!("the size at point 1 {named}"));
    }
    place.file("flat.csv", "0,0\n8,0\n");
    place.fail("mesh square.poly --size flat.csv -o m.vtu", 1, "no points with values");
    place.fail("mesh square.poly --size none.csv -o m.vtu", 1, "none.csv");
    place.fail("mesh square.poly --size-columns x,y,edge -o m.vtu", 2, "--size");
}

/// Types of elements in files of Abaqus: those that most programs know, or the one that is asked for.
#[test]
fn elements_of_abaqus_have_the_type_that_is_asked_for() {
    let place = Place::new();
    place.file("plan.poly", "4 2 0 0\n0 0 0\n1 2 0\n2 2 2\n3 0 2\n4 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n0\n");
    for (options, kind) in [
        ("", "CPS3"),
        ("--second-order", "CPE6"),
        ("--second-order --element CPS6", "CPS6"),
        ("--element S3", "S3"),
    ] {
        place.succeed(&format!("-q mesh plan.poly {options} -o m.inp"));
        let text = place.read("m.inp");
        assert!(
            text.lines()
                .filter(|line| line.starts_with("*ELEMENT"))
                .all(|line| { line.contains(&format!("TYPE={kind},")) })
        );
    }
    place.fail("mesh plan.poly --element cps6 -o m.inp", 2, "no type of elements");
    place.fail("mesh plan.poly --element CPS6 -o m.vtu", 2, "--element is for .inp files");
}

#[test]
fn what_cannot_be_is_said() {
    let place = Place::new();
    place.file("plan.poly", PLAN);
    place.fail("mesh plan.poly --min-angle 61 -o m.vtu", 2, "min-angle is 61");
    place.fail("mesh plan.poly --triangle pq61", 2, "min-angle is 61");
    place.fail("mesh plan.poly --min-angle 60 --max-vertices 5 -o m.vtu", 2, "min-angle is 60");
    place.fail("mesh none.poly --min-angle nan -o m.vtu", 2, "min-angle is NaN");
    place.fail("mesh plan.poly --max-area 0 -o m.vtu", 2, "max-area is 0");
    place.fail("mesh plan.poly --max-area 1e-20 -o m.vtu", 1, "more than 2^30 triangles");
    place.fail("mesh plan.poly --max-edge=-1 -o m.vtu", 2, "max-edge is -1");
    place.fail("mesh plan.poly", 2, "--output");
    place.fail("mesh plan.poly -o plan.poly", 2, "would overwrite");
    place.fail("mesh plan.poly --histogram -o - --to ele", 2, "standard output");
    place.fail("mesh plan.poly --triangle pq --min-angle 20 -o m.vtu", 2, "cannot be used with");
    place.fail("mesh plan.poly --keep walls -o m.vtu", 2, "walls");
    // With a budget all angles below 60 degrees may be asked for, and what is left is told.
    let output = place
        .run("mesh plan.poly --min-angle 50 --max-vertices 20 --check -o m.node -o m.ele --stats s.json");
    assert!(output.status.success());
    let told = text(&output.stderr);
    let warnings: Vec<&str> = told.lines().filter(|line| line.starts_with("warning: ")).collect();
    assert!(warnings.len() == 1 && warnings[0].contains("no more vertices allowed"), "{told}");
    assert!(mesh(&place, "m").points.len() <= 30);
    let stats: serde_json::Value = serde_json::from_str(&place.read("s.json")).expect("JSON");
    assert!(stats["left"]["budget"].as_u64().expect("a count") > 0);
    place.fail(
        "mesh plan.poly --min-angle 50 --max-vertices 20 --strict -o n.node",
        1,
        "no more vertices allowed",
    );
    assert!(text(&place.run("-q mesh plan.poly --min-angle 50 --max-vertices 9 -o m.ele").stderr).is_empty());
    // A needle of the input: one line, and no failure.
    place.file("needle.poly", "3 2 0 0\n1 0 0\n2 100 0\n3 100 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n");
    let told = text(&place.run("mesh needle.poly --min-angle 30 --check -o m.ele").stderr);
    assert!(told.contains("small angle of the input"), "{told}");
    place.fail("mesh needle.poly --min-angle 30 --strict -o n.ele", 1, "small angle of the input");
    // Kept segments.
    for keep in ["border", "constraints"] {
        place.succeed(&format!("-q mesh plan.poly --keep {keep} --max-area 0.5 --check -o m.node -o m.ele"));
        let mesh = mesh(&place, "m");
        let counts = SEGMENTS.map(|(ends, _)| mesh.along(ends).len());
        assert!(counts[..8].iter().all(|&count| count == 2), "{keep}: {counts:?}");
        assert_eq!(counts[8] == 2, keep == "constraints", "{counts:?}");
    }
}

#[test]
fn hostile_files_are_named() {
    let place = Place::new();
    for end in [0, 15, 60, 120, 190, PLAN.len() - 20] {
        place.file("short.poly", &PLAN[..end]);
        place.fail("mesh short.poly -o m.vtu", 1, "short.poly");
        place.fail("mesh short.poly --triangle pq", 1, "short.poly");
    }
    place.file("nan.poly", PLAN.replace("3 9 9 32 3", "3 nan 9 32 3"));
    place.fail("mesh nan.poly -o m.vtu", 1, "point 2");
    place.fail("mesh nan.poly --triangle pq", 1, "point 2");
    place.file("inf.poly", PLAN.replace("3 9 9 32 3", "3 9 inf 32 3"));
    place.fail("mesh inf.poly -o m.vtu", 1, "point 2");
    place.file("far.poly", PLAN.replace("9 9 10 -4", "9 9 11 -4"));
    place.fail("mesh far.poly -o m.vtu", 1, "line");
    place.file("seed.poly", PLAN.replace("1 4 4\n", "1 9 9\n"));
    place.fail("mesh seed.poly -o m.vtu", 1, "the seed of hole 0");
    let bowtie = "4 2 0 0\n1 0 0\n2 2 2\n3 2 0\n4 0 2\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n";
    place.file("bowtie.poly", bowtie);
    place.fail("mesh bowtie.poly -o m.vtu", 1, "segments 0 and 2 cross");
    place.succeed("-q mesh bowtie.poly --crossings split --check -o m.node -o m.ele");
    assert!((mesh(&place, "m").area() - 2.0).abs() < 1e-9);
    // Nothing inside is no failure.
    place.file("open.poly", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n1 0\n1 1 2\n0\n");
    let told = text(&place.run("mesh open.poly -o m.ele").stderr);
    assert!(told.contains("nothing is inside"), "{told}");
    assert_eq!(place.read("m.ele"), "0 3 0\n");
    place.file("none.csv", "");
    place.succeed("-q mesh none.csv -o m.ele");
    place.file("line.csv", "0,0\n1,1\n2,2\n");
    place.succeed("-q mesh line.csv --check -o m.ele -o m.svg");
}

#[test]
fn a_histogram_is_printed() {
    let place = Place::new();
    place.file("plan.poly", PLAN);
    let told = place.succeed("-q mesh plan.poly --histogram -o m.ele");
    let lines: Vec<&str> = told.lines().collect();
    assert!(lines.len() == 18 && lines[0].starts_with("  0 to  10 degrees"), "{told}");
    let longest = lines.iter().map(|line| line.matches('#').count()).max();
    assert_eq!(longest, Some(50));
}
