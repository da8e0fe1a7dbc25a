//! Cells of space as a user meets them.

use serde_json::Value;

use crate::place::{Place, text};

type Point = [f64; 3];

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

fn point(value: &Value) -> Point {
    [0, 1, 2].map(|k| number(&value[k]))
}

fn cells(place: &Place, name: &str) -> Vec<Value> {
    list(&serde_json::from_str(&place.read(name)).expect("JSON")).to_vec()
}

/// The volume of a cell, by the tetrahedra between its first corner and its faces.
fn volume(cell: &Value) -> f64 {
    let corners: Vec<Point> = list(&cell["vertices"]).iter().map(point).collect();
    let mut sum = 0.0;
    for face in list(&cell["faces"]) {
        let ring: Vec<Point> =
            list(&face["corners"]).iter().map(|i| corners[i.as_u64().expect("an index") as usize]).collect();
        for pair in ring[1..].windows(2) {
            let [a, b, c] = [ring[0], pair[0], pair[1]].map(|p| [0, 1, 2].map(|k| p[k] - corners[0][k]));
            sum += a[0] * (b[1] * c[2] - b[2] * c[1])
                + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0]);
        }
    }
    sum / 6.0
}

/// Cells whose faces, volumes and areas fit each other; they fill so much.
fn judge(cells: &[Value], whole: f64) {
    let mut sum = 0.0;
    for (site, cell) in cells.iter().enumerate() {
        assert_eq!(cell["site"], site);
        assert!((volume(cell) - number(&cell["volume"])).abs() < 1e-12 * whole, "the volume of {site}");
        sum += number(&cell["volume"]);
        let areas: f64 = list(&cell["faces"]).iter().map(|face| number(&face["area"])).sum();
        assert!((areas - number(&cell["area"])).abs() <= 1e-12 * areas, "the area of {site}");
        for face in list(&cell["faces"]) {
            let Some(other) = face["neighbor"].as_u64() else {
                assert!(face["wall"].is_u64(), "{face}");
                continue;
            };
            let opposite = |back: &&Value| {
                let turned = || (0..3).all(|k| number(&back["offset"][k]) == -number(&face["offset"][k]));
                back["neighbor"] == site && (face["offset"].is_null() || turned())
            };
            let back = list(&cells[other as usize]["faces"]).iter().find(opposite);
            let area = number(&back.unwrap_or_else(|| panic!("{site} and {other}"))["area"]);
            assert!((area - number(&face["area"])).abs() < 1e-12, "{site} and {other}");
        }
    }
    assert!((sum - whole).abs() < 1e-12 * whole, "{sum} of {whole}");
}

/// Points in a cube with one of them again, radii and names.
fn points(place: &Place, count: usize) {
    let mut random = delone_generators::Random::new(4);
    let mut rows = String::from("x,y,z,r,name\n");
    for i in 0..count {
        let [x, y, z, r] = [0; 4].map(|_| (random.unit() * 1e6).round() / 1e6);
        rows += &format!("{x},{y},{z},{},n{i}\n", r / 10.0);
    }
    let again = rows.lines().nth(4).expect("a row").to_owned();
    place.file("p.csv", format!("{rows}{again}\n"));
}

#[test]
fn cells_fill_their_region_in_every_format() {
    let place = Place::new();
    points(&place, 60);
    let box_ = "--box -0.5,0,0,1,1,1";
    let outputs = "-o c.json -o c.csv -o c.npy -o c.vtu -o c.ply -o c.obj --stats s.json";
    let told = place.run(&format!("voronoi p.csv --dim 3 {box_} {outputs}"));
    let told = text(&told.stderr);
    assert!(told.contains("1 of 61 points equals an earlier one"), "{told}");
    assert!(told.contains("c.ply: the attributes of the input are left out: r, name"), "{told}");
    assert!(told.contains("c.vtu: arrays have numbers alone: these attributes are left out: name"), "{told}");
    assert!(told.contains("the attributes of points without a cell are left out: 1"), "{told}");
    let all = cells(&place, "c.json");
    judge(&all, 1.5);
    assert_eq!(
        (all.len(), &all[60]["faces"], &all[60]["centroid"]),
        (61, &Value::Array(vec![]), &Value::Null)
    );
    assert_eq!((&all[7]["name"], &all[60]["name"]), (&"n7".into(), &"n3".into()));
    let stats: Value = serde_json::from_str(&place.read("s.json")).expect("JSON");
    assert_eq!(
        (&stats["points"], &stats["cells"], &stats["duplicates"]),
        (&61.into(), &60.into(), &1.into())
    );
    // A table of the same, and an array.
    let table = place.read("c.csv");
    let mut rows = table.lines();
    let header = "site,volume,area,centroid_x,centroid_y,centroid_z,r,name";
    assert_eq!(rows.next(), Some(header));
    let numbers = std::fs::read(place.path("c.npy")).expect("written");
    let numbers: Vec<f64> = numbers[numbers.len() - 61 * 5 * 8..]
        .chunks_exact(8)
        .map(|bytes| f64::from_le_bytes(bytes.try_into().expect("eight")))
        .collect();
    for ((cell, row), numbers) in all.iter().zip(rows).zip(numbers.chunks_exact(5)) {
        let fields: Vec<f64> = row.split(',').map(|field| field.parse().unwrap_or(f64::NAN)).collect();
        let of = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
        let centroid = [0, 1, 2].map(|k| of(&cell["centroid"][k]));
        let expected = [of(&cell["volume"]), of(&cell["area"]), centroid[0], centroid[1], centroid[2]];
        let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!((bits(&fields[1..6]), bits(numbers)), (bits(&expected), bits(&expected)), "{row}");
    }
    // A polygon for each face.
    let faces: usize = all.iter().map(|cell| list(&cell["faces"]).len()).sum();
    let object = place.read("c.obj");
    assert_eq!(object.lines().filter(|line| line.starts_with("f ")).count(), faces);
    assert_eq!(object.lines().filter(|line| line.starts_with("o site_")).count(), 60);
    assert!(place.read("c.ply").contains(&format!("element face {faces}\n")));
    // The hull, and a system of coordinates.
    place.succeed("-q --epsg 25832 voronoi p.csv --dim 3 --clip hull -o h.json -o h.ply --stats h.stats");
    judge(&cells(&place, "h.json"), {
        let stats: Value = serde_json::from_str(&place.read("h.stats")).expect("JSON");
        number(&stats["volume"])
    });
    assert!(place.read("h.ply").contains("comment crs EPSG:25832"));
    place.fail("--strict -q voronoi p.csv --dim 3 -o x.ply", 1, "the attributes of the input are left out");
}

#[test]
fn boxes_that_repeat_are_filled() {
    let place = Place::new();
    points(&place, 50);
    for (axes, whole) in [("1,1,1", 1.0), ("1,1,1,-0.5,0.25,0.5", 1.0), ("2,0,0,0,1,0,0.5,0,1", 2.0)] {
        for radii in ["", "--radii r"] {
            place.succeed(&format!("-q voronoi p.csv --dim 3 --periodic {axes} {radii} -o c.json"));
            judge(&cells(&place, "c.json"), whole);
        }
    }
    // One site is its own neighbor; and a file may begin with an axis that is negative.
    place.file("one.csv", "x,y,z\n5,5,5\n");
    place.succeed("-q voronoi one.csv --dim 3 --periodic=-1,0,0,0,-1,0,0,0,1 -o one.json -o one.vtu");
    let one = cells(&place, "one.json");
    judge(&one, 1.0);
    assert_eq!((point(&one[0]["centroid"]), list(&one[0]["faces"]).len()), ([5.0; 3], 6));
    let told = place.run("voronoi p.csv --dim 3 --periodic 1,1,1 -o c.csv");
    let told = text(&told.stderr);
    assert!(told.contains("1 of 51 points is a copy of another one, and has no cell"), "{told}");
}

#[test]
fn power_cells_and_hidden_sites() {
    let place = Place::new();
    // The border between two is where powers are equal; the third is hidden by the first.
    place.file("r.csv", "x,y,z,r\n0,0,0,0.5\n1,0,0,0\n0.1,0,0,0\n0,1,1,0\n1,1,1,0\n");
    let line = "voronoi r.csv --dim 3 --radii r --box=-0.5,-0.25,-0.25,1.5,0.25,0.25";
    let told = place.run(&format!("{line} -o c.json"));
    assert!(text(&told.stderr).contains("1 site is hidden by others"), "{}", text(&told.stderr));
    let all = cells(&place, "c.json");
    judge(&all, 0.5);
    assert_eq!([0, 1, 2].map(|i| number(&all[i]["volume"])), [0.28125, 0.21875, 0.0]);
    place.file("wrong.csv", "x,y,z,r\n0,0,0,1\n1,0,0,-2\n0,1,0,1\n0,0,1,1\n");
    place.fail(
        "voronoi wrong.csv --dim 3 --radii r -o c.vtu",
        1,
        "point 1 has the radius -2.0, which is negative",
    );
}

/// Crystals have no faces that rounding makes, if decimals are taken at their word.
#[test]
fn decimals_are_taken_at_their_word() {
    let place = Place::new();
    // Face-centered, with the constant 0.1: cells of twelve faces.
    let mut rows = String::from("x,y,z\n");
    for n in 0..64 {
        for half in [[0.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]] {
            let at = [n % 4, n / 4 % 4, n / 16];
            let p = [0, 1, 2].map(|k| format!("{:?}", (f64::from(at[k]) + half[k]) * 0.1));
            rows += &format!("{}\n", p.join(","));
        }
    }
    place.file("fcc.csv", rows);
    let faces = |options: &str| {
        let told = text(&place.run(&format!("voronoi fcc.csv --dim 3 {options} -o c.json")).stderr);
        let all = cells(&place, "c.json");
        (told, all.iter().map(|cell| list(&cell["faces"]).len()).collect::<Vec<_>>(), all)
    };
    let periodic = "--periodic 0.4,0.4,0.4";
    for grid in ["auto", "0.05"] {
        let (told, counts, all) = faces(&format!("{periodic} --grid {grid}"));
        assert!(told.contains("coordinates are taken as multiples of 0.0"), "{told}");
        judge(&all, 0.064);
        assert_eq!(counts, [12; 256], "{grid}");
    }
    assert!(faces(periodic).1 > vec![12; 256], "rounded halves of tenths are no lattice");
    // The same inside of a box.
    let inside = "--box 0,0,0,0.4,0.4,0.4";
    let (_, with, all) = faces(&format!("{inside} --grid auto"));
    judge(&all, 0.064);
    assert!(with.iter().sum::<usize>() < faces(inside).1.iter().sum());
    place.file("p.csv", format!("x,y,z\n{},0,0\n0,1,0\n0,0,1\n1,1,1\n", 1.0 / 3.0));
    let told = text(&place.run("voronoi p.csv --dim 3 --grid auto -o c.json").stderr);
    assert!(told.contains("multiples of no power of ten"), "{told}");
    // What is between the multiples is moved, and that is said.
    let told = text(&place.run("voronoi p.csv --dim 3 --grid 0.25 -o c.json").stderr);
    assert!(told.contains("move by at most 8.3e-2"), "{told}");
}

/// Hexagonal close packing: no decimals, but twelve neighbors of each.
#[test]
fn small_faces_are_no_neighbors() {
    let place = Place::new();
    let axes = [[1.0, 0.0, 0.0], [0.5, 0.75_f64.sqrt(), 0.0], [0.0, 0.0, (8.0_f64 / 3.0).sqrt()]];
    let mut rows = String::from("x,y,z,neighbors\n");
    for n in 0..125 {
        let at = [n % 5, n / 5 % 5, n / 25].map(f64::from);
        for basis in [[0.0, 0.0, 0.0], [1.0 / 3.0, 1.0 / 3.0, 0.5]] {
            let p = [0, 1, 2].map(|k| (0..3).map(|i| (at[i] + basis[i]) * axes[i][k]).sum::<f64>());
            rows += &format!("{:?},{:?},{:?},7\n", p[0], p[1], p[2]);
        }
    }
    place.file("hcp.csv", rows);
    let box_ = axes.as_flattened().iter().map(|x| format!("{:?}", 5.0 * x)).collect::<Vec<_>>().join(",");
    let line = format!("-q voronoi hcp.csv --dim 3 --periodic {box_}");
    place.succeed(&format!("{line} --min-area 0 -o all.json"));
    let all = cells(&place, "all.json");
    judge(&all, 125.0 * 2.0_f64.sqrt());
    assert!(all.iter().any(|cell| number(&cell["neighbors"]) > 12.0), "rounding makes faces");
    for least in ["--min-area 1e-6", "--min-relative-area 1e-6"] {
        place.succeed(&format!("{line} {least} -o c.csv -o c.json -o c.vtu"));
        let found = cells(&place, "c.json");
        for (cell, with) in found.iter().zip(&all) {
            assert_eq!((&cell["neighbors"], &cell["faces"]), (&12.into(), &with["faces"]));
        }
        let table = place.read("c.csv");
        let mut rows = table.lines();
        let header = "site,volume,area,centroid_x,centroid_y,centroid_z,neighbors,neighbors_2";
        assert_eq!(rows.next(), Some(header));
        assert!(rows.all(|row| row.ends_with(",12,7")));
        let grid = std::fs::read(place.path("c.vtu")).expect("written");
        assert!(String::from_utf8_lossy(&grid).contains("Name=\"neighbors\""));
    }
    // Walls are no neighbors.
    place.file("one.csv", "x,y,z\n1,1,1\n");
    place.succeed("-q voronoi one.csv --dim 3 --box 0,0,0,2,2,2 --min-area 0 -o one.csv.json");
    assert_eq!(cells(&place, "one.csv.json")[0]["neighbors"], 0);
    place.fail("voronoi one.csv --dim 3 --min-area 1 -o c.ply", 2, "no output has room");
    place.fail("voronoi one.csv --min-area 1 -o c.csv", 2, "are for cells in space");
    place.fail("voronoi one.csv --dim 3 --min-area=-1 -o c.csv", 2, "--min-area");
}

#[test]
fn wrong_usage_is_named() {
    let place = Place::new();
    points(&place, 10);
    place.file("flat.csv", "x,y,z\n0,0,0\n1,0,0\n0,1,0\n1,1,0\n");
    let fail =
        |options: &str, status, word: &str| place.fail(&format!("voronoi p.csv {options}"), status, word);
    fail("--dim 3 -o c.geojson", 2, "Voronoi cells in space are not written to geojson files");
    fail("--dim 3 -o c.stl", 2, "Voronoi cells in space are not written to stl files");
    fail("-o c.vtu", 2, "Voronoi cells are not written to vtu files");
    fail("--dim 3 -o c.vtu --wkt lines", 2, "--wkt is for outputs of well-known text");
    fail("--grid auto -o c.csv", 2, "--grid is for cells in space, or in boxes");
    for option in ["--order 2", "--relax 2", "--sites s.csv", "--areas equal", "--merge auto"] {
        let word = format!("{} is for cells in the plane", option.split(' ').next().expect("a word"));
        fail(&format!("--dim 3 -o c.vtu {option}"), 2, &word);
    }
    fail("--dim 3 -o c.vtu --clip p.csv", 2, "in space --clip takes box or hull");
    fail("--dim 3 -o c.vtu --box 0,0,1,1", 2, "--box needs six numbers");
    fail("--dim 3 -o c.vtu --box 0,0,0,1,1,0", 2, "--box: ");
    fail("--dim 3 -o c.vtu --box 0,0,0,1,1,1 --clip hull", 2, "--box is for --clip box");
    fail("--dim 3 -o c.vtu --periodic 1,1,1 --box 0,0,0,1,1,1", 2, "cannot be used with");
    fail("--dim 3 -o c.vtu --periodic 1,1", 2, "2 numbers, where a box has 3, 6 or 9");
    fail("--dim 3 -o c.vtu --periodic 1,1,0", 2, "axis 2 of the box, counted from 0, is zero");
    fail("--dim 3 -o c.vtu --periodic=-1,1,1", 2, "--periodic: ");
    fail("--dim 3 -o c.vtu --periodic 1,0,0,1,0,0,0,0,1", 2, "--periodic: axis");
    fail("--dim 3 -o c.vtu --periodic 1,inf,1", 2, "--periodic: axis 1");
    fail("--dim 3 -o c.vtu --grid 0", 2, "--grid");
    fail("--dim 3 -o c.vtu --grid 1e-300", 2, "more steps than can be counted");
    place.fail("voronoi flat.csv --dim 3 -o c.vtu", 1, "the bounding box of the sites has no volume");
    place.fail("voronoi flat.csv --dim 3 --clip hull -o c.vtu", 1, "the sites span no volume");
    place.fail("voronoi flat.csv --dim 3 --columns x,y -o c.vtu", 1, "no third coordinate");
    place.file("none.csv", "x,y,z\n");
    place.fail("voronoi none.csv --dim 3 -o c.vtu", 1, "the bounding box of the sites has no volume");
    place.succeed("-q voronoi flat.csv --dim 3 --box 0,0,0,1,1,1 -o c.vtu");
    place.succeed("-q voronoi none.csv --dim 3 --periodic 1,1,1 -o c.json");
    assert_eq!(place.read("c.json"), "[\n]\n");
    place.file("nan.csv", "x,y,z\n0,0,0\n1,nan,0\n0,1,0\n0,0,1\n");
    for options in ["", "--periodic 1,1,1", "--grid 0.5"] {
        place.fail(&format!("voronoi nan.csv --dim 3 -o c.vtu {options}"), 1, "point 1");
    }
}

const DUMP: &str = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS pp pp pp\n0 2\n0 3\n1 5\nITEM: ATOMS id x y z radius\n7 0.5 1 2 0.25\n3 1.5 2 3 0.5\n5 9 9 9 0.125\n";
const FRAME: &str =
    "2\nLattice=\"2 0 0 1 3 0 0 0 4\" Properties=species:S:1:pos:R:3:r:R:1\nSi 0.5 1 2 0.25\nO 5 4 3 0.5\n";

/// Walls of a cell along an axis, and their ends.
fn walls(all: &[Value]) -> Vec<u64> {
    let faces = all.iter().flat_map(|cell| list(&cell["faces"]));
    let mut walls: Vec<u64> = faces.filter_map(|face| face["wall"].as_u64()).collect();
    walls.sort_unstable();
    walls.dedup();
    walls
}

#[test]
fn boxes_that_repeat_along_some_axes_have_walls() {
    let place = Place::new();
    points(&place, 50);
    for (axes, expected) in
        [("xy", &[4, 5][..]), ("0,1,0", &[0, 1, 4, 5]), ("ff,s,m", &[0, 1, 2, 3, 4, 5]), ("p,p,p", &[])]
    {
        for (axis, whole) in [("1,1,1", 1.0), ("1,1,1,-0.5,0.25,0.5", 1.0), ("2,0,0,0,1,0,0.5,0,1", 2.0)] {
            let line = format!("-q voronoi p.csv --dim 3 --periodic {axis} --origin 0,0,0 --axes {axes}");
            place.succeed(&format!("{line} -o c.json"));
            let all = cells(&place, "c.json");
            judge(&all, whole);
            assert_eq!(walls(&all), expected, "{axes} {axis}");
        }
    }
    // What the file says; and nothing of it is overlooked.
    let slab = DUMP.replace("pp pp pp", "pp pp ff");
    place.file("m.lammpstrj", &slab);
    place.file("m.extxyz", FRAME.replace("Properties", "pbc=\"T F T\" Origin=\"0 1 0\" Properties"));
    let told = text(&place.run("voronoi m.lammpstrj --dim 3 --periodic -o c.json").stderr);
    assert!(
        told.contains("begins at (0.0, 0.0, 1.0) and repeats along the first and the second alone"),
        "{told}"
    );
    assert!(told.contains("1 cell is beyond the walls of the box, and empty"), "{told}");
    let all = cells(&place, "c.json");
    judge(&all, 24.0);
    assert_eq!(walls(&all), [4, 5]);
    let ends = all.iter().flat_map(|cell| list(&cell["vertices"])).map(|p| number(&p[2]));
    assert_eq!(ends.clone().fold((f64::MAX, f64::MIN), |(a, b), z| (a.min(z), b.max(z))), (1.0, 5.0));
    place.succeed("-q voronoi m.lammpstrj --dim 3 --periodic 2,3,4 --axes xy --origin 0,0,1 -o d.json");
    assert_eq!(place.read("c.json"), place.read("d.json"));
    place.succeed("-q voronoi m.extxyz --dim 3 --periodic -o e.json");
    judge(&cells(&place, "e.json"), 24.0);
    assert_eq!(walls(&cells(&place, "e.json")), [2, 3]);
    let told = text(&place.run("voronoi m.extxyz --dim 3 --periodic --axes xyz -o e.json").stderr);
    assert!(told.contains("--axes is taken: the file says otherwise"), "{told}");
    assert_eq!(walls(&cells(&place, "e.json")), [0; 0]);
    let told = text(&place.run("voronoi m.extxyz --dim 3 --periodic 2,3,4 -o e.json").stderr);
    assert!(told.contains("that of the file does as with --axes xz"), "{told}");
    let fail = |options: &str, status, word: &str| {
        place.fail(&format!("-q voronoi p.csv --dim 3 -o x.json {options}"), status, word);
    };
    fail("--axes xy", 2, "--periodic");
    fail("--periodic 1,1,1 --axes up", 2, "letters of axes");
    fail("--periodic 1,1,1 --axes 1,0", 2, "--axes is not for 3 dimensions");
    fail("--periodic 1,1,1 --origin 1,0", 2, "--origin takes 3 finite numbers");
    fail("--periodic 1,1,1 --origin 1,0,inf", 2, "--origin takes 3 finite numbers");
    fail("--periodic 1,1,0 --axes xy", 2, "axis 2 of the box, counted from 0, is zero");
}

#[test]
fn boxes_of_files_are_taken() {
    let place = Place::new();
    place.file("a.lammpstrj", DUMP.repeat(2));
    place.file("a.extxyz", FRAME);
    let told = place.run("voronoi a.lammpstrj --dim 3 --periodic -o c.json -o c.csv");
    let told = text(&told.stderr);
    assert!(told.contains("the first frame is read, one more is left out"), "{told}");
    judge(&cells(&place, "c.json"), 24.0);
    assert!(place.read("c.csv").starts_with("site,volume,area,centroid_x,centroid_y,centroid_z,id,radius\n"));
    place.succeed("-q voronoi a.lammpstrj --dim 3 --periodic 2,3,4 -o d.json");
    assert_eq!(place.read("c.json"), place.read("d.json"));
    place.succeed("-q voronoi a.extxyz --dim 3 --periodic auto --radii r -o e.json");
    judge(&cells(&place, "e.json"), 24.0);
    place.succeed("-q voronoi a.extxyz --dim 3 --periodic 2,3,4,1,0,0 --radii r -o f.json");
    assert_eq!(place.read("e.json"), place.read("f.json"));
    assert_eq!(cells(&place, "e.json")[1]["species"], "O");
    place.succeed("-q voronoi a.lammpstrj --dim 3 --periodic --radii radius -o g.json");
    assert_ne!(place.read("c.json"), place.read("g.json"));

    let fail =
        |line: &str, status, word: &str| place.fail(&format!("-q voronoi {line} -o x.json"), status, word);
    fail("a.lammpstrj --dim 3 --periodic --radii r", 1, "no column is called so, but: id, radius");
    fail("a.extxyz --dim 3 --periodic --radii species", 1, "in this column point 0 has no number");
    place.file("n.lammpstrj", DUMP.replace("0.125", "-0.125"));
    fail(
        "n.lammpstrj --dim 3 --periodic --radii radius",
        1,
        "point 2 has the radius -0.125, which is negative",
    );
    place.file("m.lammpstrj", DUMP.replace("pp pp pp", "pp pp ff"));
    place.file("p.extxyz", "1\nwater\nH 0 0 0\n");
    fail("p.extxyz --dim 3 --periodic", 1, "it tells no box");
    fail("a.lammpstrj m.lammpstrj --dim 3 --periodic", 1, "its box is another one");
    place.fail("-q --strict voronoi a.lammpstrj --dim 3 --periodic -o x.json", 1, "one more is left out");
}

/// A picture of all cells, and of what a plane leaves of them, with its inside in another color.
#[test]
fn pictures_of_cells_are_cut_open() {
    const FACE: &str = "Z\"/>";
    let place = Place::new();
    let points: Vec<String> = (0..64).map(|i| format!("{},{},{}", i % 4, i / 4 % 4, i / 16)).collect();
    place.file("points.csv", format!("{}\n", points.join("\n")));
    let shown = |options: &str| {
        place.succeed(&format!("-q voronoi points.csv --dim 3 --box -0.5,-0.5,-0.5,3.5,3.5,3.5 {options}"));
        place.read("cells.svg").matches(FACE).count()
    };
    // Three sides of a cube of 16 squares each are turned to the viewer, cut or not.
    assert_eq!(shown("-o cells.svg"), 48);
    assert_eq!(shown("-o cells.svg --cut 0,0,1,1.5"), 32);
    place.succeed("-q voronoi points.csv --dim 3 --cut 0,0,1,1.5 -o cells.png --size 100");
    place.fail("voronoi points.csv --dim 3 --cut 0,0,1,1.5 -o cells.csv", 2, "--cut is for pictures");
    place.fail("voronoi points.csv --cut 0,0,1,1.5 -o cells.svg", 2, "--cut is for space");
    place.fail("voronoi points.csv --dim 3 --cut 0,0,1 -o cells.svg", 2, "--cut takes four numbers");
}
