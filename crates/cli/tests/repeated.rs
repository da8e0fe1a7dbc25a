//! Cells of the plane in boxes that repeat, as a user meets them.

use serde_json::Value;

use crate::place::{Place, text};

/// The cells of a file of GeoJSON: rings, and areas.
fn cells(place: &Place, name: &str) -> Vec<(Vec<[f64; 2]>, f64)> {
    let file: Value = serde_json::from_str(&place.read(name)).expect("JSON");
    let cell = |feature: &Value| {
        let ring = feature["geometry"]["coordinates"][0].as_array().map(Vec::as_slice).unwrap_or_default();
        let ring = ring.iter().map(|p| [0, 1].map(|k| p[k].as_f64().expect("a number"))).collect();
        (ring, feature["properties"]["area"].as_f64().expect("a number"))
    };
    file["features"].as_array().expect("features").iter().map(cell).collect()
}

/// Cells whose rings have their areas, which add up to so much.
fn judge(cells: &[(Vec<[f64; 2]>, f64)], whole: f64) {
    for (ring, area) in cells {
        let sum: f64 = ring.windows(2).map(|pq| pq[0][0] * pq[1][1] - pq[0][1] * pq[1][0]).sum();
        assert!((sum / 2.0 - area).abs() < 1e-12 * whole, "{ring:?} {area}");
    }
    let sum: f64 = cells.iter().map(|cell| cell.1).sum();
    assert!((sum - whole).abs() < 1e-12 * whole, "{sum} of {whole}");
}

#[test]
fn cells_of_the_plane_fill_their_box() {
    let place = Place::new();
    let mut random = delone_generators::Random::new(4);
    let mut rows = String::from("x,y,r,name\n");
    for i in 0..40 {
        let [x, y, r] = [0; 3].map(|_| (random.unit() * 1e6).round() / 1e6);
        rows += &format!("{},{y},{},n{i}\n", 2.0 * x, r / 10.0);
    }
    place.file("p.csv", &rows);
    for box_ in ["2,1", "2,1,0.5", "2,0.5,-0.5,0.875"] {
        for axes in ["xy", "x", "0,1", "f,f"] {
            for radii in ["", "--radii r"] {
                let line = format!("-q voronoi p.csv --periodic {box_} --axes {axes} {radii}");
                place.succeed(&format!("{line} -o c.geojson --stats s.json"));
                judge(&cells(&place, "c.geojson"), 2.0);
            }
        }
    }
    let stats: Value = serde_json::from_str(&place.read("s.json")).expect("JSON");
    assert!(stats["vertices"].as_u64() <= Some(40) && stats["beyond"].is_u64(), "{stats}");
    // In all formats of cells, with the attributes of the points; and copies of others have none.
    place.file("q.csv", format!("{rows}4.5,0.25,0,a\n2.5,0.25,0,b\n"));
    let told =
        place.run("voronoi q.csv --periodic 2,1 -o c.csv -o c.wkt -o c.fgb -o c.gpkg -o c.svg -o c.png");
    let told = text(&told.stderr);
    assert!(told.contains("1 of 42 points is a copy of another one, and has no cell"), "{told}");
    let table = place.read("c.csv");
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!((rows[0], rows.len()), ("site,area,r,name,wkt", 43));
    assert!(
        rows[42].ends_with("0.0,0,b,\"POLYGON EMPTY\"") && rows[41].contains(",a,\"POLYGON (("),
        "{}",
        rows[42]
    );
    // Decimals at their word: squares of a lattice of tenths.
    let lattice: String =
        (0..9).map(|i| format!("{:?},{:?}\n", f64::from(i % 3) * 0.1, f64::from(i / 3) * 0.1)).collect();
    place.file("l.csv", lattice);
    place.succeed("-q voronoi l.csv --periodic 0.3,0.3 --grid auto -o l.geojson");
    let squares = cells(&place, "l.geojson");
    judge(&squares, 0.09);
    assert!(squares.iter().all(|(ring, _)| ring.len() == 5));
    // With walls all around it is a box that does not repeat.
    place.succeed(
        "-q voronoi l.csv --periodic 0.3,0.3 --axes 0,0 --origin=-0.05,-0.05 --grid auto -o w.geojson",
    );
    let walled = cells(&place, "w.geojson");
    judge(&walled, 0.09);
    assert!(walled.iter().all(|(ring, area)| ring.len() == 5 && (area - 0.01).abs() < 1e-15));
    // The box of a file: its first two axes, along which it repeats.
    place.file(
        "a.extxyz",
        "1\nLattice=\"2 0 0 1 3 0 0 0 4\" pbc=\"T F F\" Origin=\"0 1 0\" Properties=pos:R:3\n0.5 1.5 0\n",
    );
    place.succeed("-q voronoi a.extxyz --periodic -o a.geojson");
    let cell = &cells(&place, "a.geojson")[0];
    judge(std::slice::from_ref(cell), 6.0);
    let ends = cell.0.iter().map(|p| p[1]).fold((f64::MAX, f64::MIN), |(a, b), y| (a.min(y), b.max(y)));
    assert_eq!(ends, (1.0, 4.0));
}

#[test]
fn wrong_usage_is_named() {
    let place = Place::new();
    place.file("p.csv", "x,y\n0,0\n1,1\n");
    let fail = |options: &str, status, word: &str| {
        place.fail(&format!("voronoi p.csv -o c.csv {options}"), status, word);
    };
    for option in ["--order 2", "--relax 2", "--sites s.csv", "--areas equal", "--merge auto"] {
        let word = format!("{} is not for boxes that repeat", option.split(' ').next().expect("a word"));
        fail(&format!("--periodic 2,2 {option}"), 2, &word);
    }
    fail("--periodic 1,1,1,1,1,1", 2, "6 numbers, where a box has 2, 3 or 4");
    fail("--periodic 1,0", 2, "axis 1 of the box");
    fail("--periodic 1,1 --axes xz", 2, "--axes is not for 2 dimensions");
    fail("--periodic 1,1 --origin 1,1,1", 2, "--origin takes 2 finite numbers");
    fail("--periodic", 1, "it tells no box");
    place.file("t.extxyz", "1\nLattice=\"2 0 0 0 3 1 0 0 4\" Properties=pos:R:3\n0.5 1.5 0\n");
    place.fail("voronoi t.extxyz --periodic -o c.csv", 1, "that is no box of the plane");
}
