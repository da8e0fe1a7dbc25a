//! The commands `voronoi`, `hull` and `furthest`, and motions and imprecise points in pictures.

use crate::place::{Place, answers, data, rows};
use serde_json::Value;

/// The features of a file of cells: site, area, geometry.
fn cells(place: &Place, name: &str) -> Vec<(u64, f64, Value)> {
    let bytes = std::fs::read(place.path(name)).expect("cells");
    let json: Value = serde_json::from_slice(&bytes).expect("JSON");
    let features = json["features"].as_array().expect("features");
    let of = |feature: &Value| {
        let properties = &feature["properties"];
        let site = properties["site"].as_u64().expect("a site");
        (site, properties["area"].as_f64().expect("an area"), feature["geometry"].clone())
    };
    features.iter().map(of).collect()
}

#[test]
fn cells_are_written_in_the_order_of_sites() {
    let place = Place::new();
    place.file("sites.csv", "1,1\n3,1\n1,1\n1,3\n9,9\n");
    place.succeed("voronoi sites.csv -o c.geojson -o c.png -o c.svg --box 0,0,4,4 -q");
    let found = cells(&place, "c.geojson");
    let areas: Vec<_> = found.iter().map(|(site, area, _)| (*site, *area)).collect();
    assert_eq!(areas, [(0, 4.0), (1, 6.0), (3, 6.0), (4, 0.0)]);
    assert_eq!(found[0].2["type"], "Polygon");
    let ring = found[0].2["coordinates"][0].as_array().expect("a ring");
    assert_eq!((ring.len(), &ring[0]), (5, &ring[4]));
    assert!(found[3].2.is_null());
    assert!(std::fs::read(place.path("c.png")).expect("a picture").starts_with(b"\x89PNG"));
    // The bounding box of the sites, and their hull.
    place.succeed("voronoi sites.csv -o b.geojson -q");
    assert_eq!(cells(&place, "b.geojson").iter().map(|c| c.1).sum::<f64>(), 64.0);
    place.succeed("voronoi sites.csv -o h.geojson --clip hull -q");
    let sum: f64 = cells(&place, "h.geojson").iter().map(|c| c.1).sum();
    assert!((sum - 16.0).abs() < 1e-12, "{sum}");
}

/// JSON has no number for an infinite area.
#[test]
fn areas_beyond_the_range_are_written_as_null() {
    let place = Place::new();
    place.file("huge.csv", "1e300,0\n0,1e300\n-1e300,-1e300\n");
    place.succeed("voronoi huge.csv -o huge.geojson -q");
    let bytes = std::fs::read(place.path("huge.geojson")).expect("cells");
    let json: Value = serde_json::from_slice(&bytes).expect("JSON");
    let features = json["features"].as_array().expect("features");
    assert_eq!(features.len(), 3);
    for feature in features {
        assert!(feature["properties"]["area"].is_null() && feature["geometry"]["type"] == "Polygon");
    }
}

#[test]
fn cells_are_clipped_to_polygons() {
    let place = Place::new();
    place.file("sites.csv", "0,0\n10,0\n");
    // A comb: the left cell falls into two pieces.
    place.file("comb.csv", "0,0\n8,0\n8,3\n2,3\n2,1\n1,1\n1,3\n0,3\n");
    place.file(
        "ring.geojson",
        r#"{"type":"Polygon","coordinates":
        [[[0,0],[4,0],[4,4],[0,4],[0,0]],[[1,1],[1,2],[2,2],[2,1],[1,1]]]}"#,
    );
    place.succeed("voronoi sites.csv --clip comb.csv -o comb.geojson");
    assert_eq!(cells(&place, "comb.geojson").iter().map(|c| c.1).collect::<Vec<_>>(), [13.0, 9.0]);
    place.succeed("voronoi sites.csv --clip ring.geojson -o ring.geojson2 --to geojson");
    let found = cells(&place, "ring.geojson2");
    assert_eq!((found[0].1, found[1].1), (15.0, 0.0));
    assert_eq!(found[0].2["coordinates"].as_array().map(Vec::len), Some(2), "an outer ring and a hole");
    place.file("teeth.csv", "0,-1\n0,-3\n");
    place.file("crown.csv", "-3,-3\n3,-3\n3,0\n2,-2.5\n-2,-2.5\n-3,0\n");
    place.succeed("voronoi teeth.csv --clip crown.csv -o crown.geojson");
    let found = cells(&place, "crown.geojson");
    assert_eq!(found[0].2["type"], "MultiPolygon");
    for bad in ["0,0\n1,1\n1,0\n0,1\n", "0,0\n1,1\n", "", "0,0\n1,0\n2,0\n", "0,0\n1,nan\n2,0\n"] {
        place.file("bad.csv", bad);
        place.fail("voronoi sites.csv --clip bad.csv -o x.geojson", 1, "ring 0");
    }
    place.file("bad.geojson", "{\"type\":\"Polygon\",");
    place.fail("voronoi sites.csv --clip bad.geojson -o x.geojson", 1, "GeoJSON");
}

#[test]
fn relaxed_sites_are_even() {
    let place = Place::new();
    place.succeed("generate uniform -n 100 --seed 1 -o p.csv");
    place.succeed("voronoi p.csv --box 0,0,1,1 --relax 50 -o c.geojson --sites r.csv --stats s.json");
    let stats: Value =
        serde_json::from_slice(&std::fs::read(place.path("s.json")).expect("stats")).expect("JSON");
    assert_eq!(stats["relaxed"], 50);
    let areas: Vec<f64> = cells(&place, "c.geojson").iter().map(|c| c.1).collect();
    assert!(areas.iter().all(|area| (0.005..0.015).contains(area)), "{areas:?}");
    assert_eq!(std::fs::read_to_string(place.path("r.csv")).expect("sites").lines().count(), 101);
}

#[test]
fn voronoi_says_what_is_wrong() {
    let place = Place::new();
    place.file("p.csv", "0,0\n4,0\n0,4\n");
    place.fail("voronoi p.csv -o x.npy", 2, "Voronoi cells are not written to npy");
    place.fail("voronoi p.csv -o x.svg --box 0,0,1", 2, "four numbers");
    place.fail("voronoi p.csv -o x.svg --box 1,0,0,1", 2, "no area");
    place.fail("voronoi p.csv -o x.svg --clip hull --box 0,0,1,1", 2, "--box is for --clip box");
    place.fail("voronoi p.csv -o x.svg --clip nowhere.geojson", 1, "nowhere.geojson");
    place.fail("voronoi p.csv -o p.csv --to geojson", 2, "overwrite");
    place.fail("voronoi p.csv -o x.svg --sites p.csv", 2, "overwrite");
    place.fail("voronoi p.csv -o x.svg --relax 2 --tolerance -1", 2, "");
    place.file("line.csv", "0,0\n1,0\n");
    place.fail("voronoi line.csv -o x.svg", 1, "no area");
    place.fail("voronoi line.csv -o x.svg --clip hull", 1, "no area");
    place.succeed("voronoi line.csv -o x.svg --box 0,-1,1,1 -q");
}

/// Points of a grid that is turned are corners by rounding alone.
#[test]
fn hulls_are_merged_within_rounding() {
    let place = Place::new();
    let (s, c) = (0.5, 0.75_f64.sqrt());
    let at = |i: usize| [i % 4, i / 4 % 4, i / 16].map(|k| k as f64);
    let turned =
        |[x, y, z]: [f64; 3]| [c * x - s * y, c * (s * x + c * y) - s * z, s * (s * x + c * y) + c * z];
    let row = |p: [f64; 3]| p.map(|x| format!("{x}")).join(",");
    let grid: Vec<[f64; 3]> = (0..64).map(|i| turned(at(i))).collect();
    place.file("grid.csv", grid.iter().map(|&p| row(p)).collect::<Vec<_>>().join("\n"));
    let corners = |how: &str| {
        place.succeed(&format!("hull grid.csv --dim 3 -o h.obj -o h.npy --stats s.json -q {how}"));
        let stats = std::fs::read(place.path("s.json")).expect("stats");
        let stats: Value = serde_json::from_slice(&stats).expect("JSON");
        ["hull", "faces", "simplices"].map(|name| stats[name].as_u64().expect("a number"))
    };
    assert!(corners("")[0] > 8);
    assert_eq!(corners("--merge auto"), [8, 6, 12]);
    assert_eq!(corners("--merge 1e-9 --algorithm flips"), [8, 6, 12]);
    assert_eq!(rows(&place.succeed("hull grid.csv -o - --to csv -q --merge auto")).len(), 6);
    place.fail("hull grid.csv --dim 3 -o h.npy --merge 9", 1, "less than the thickness of the hull");
    place.fail("hull grid.csv -o h.npy --merge 99", 1, "less than the width of the hull");
    place.fail("hull grid.csv -o h.npy --merge=-1", 2, "a length");
}

#[test]
fn hulls_and_furthest_points() {
    let place = Place::new();
    place.file("p.csv", "0,0\n4,0\n2,0\n4,4\n1,1\n0,4\n0,0\n");
    assert_eq!(rows(&place.succeed("hull p.csv -o - --to csv")), [[0], [1], [3], [5]]);
    place.file("q.csv", "0,0\n4,4\n2,2\n9,0\n");
    let furthest = place.succeed("furthest p.csv --queries q.csv -o - --to csv -q");
    assert_eq!(furthest, "x,y,furthest\n0.0,0.0,3\n4.0,4.0,0\n2.0,2.0,0\n9.0,0.0,5\n");
    place.succeed("furthest p.csv --queries q.csv -o f.npy --stats s.json -q");
    let stats: Value =
        serde_json::from_slice(&std::fs::read(place.path("s.json")).expect("stats")).expect("JSON");
    assert_eq!(stats["enclosing_circle"]["center"], serde_json::json!([2.0, 2.0]));
    let npy = std::fs::read(place.path("f.npy")).expect("answers");
    assert!(String::from_utf8_lossy(&npy).contains("'shape': (4, )"), "one dimension");
    place.file("none.csv", "");
    assert_eq!(place.succeed("hull none.csv -o - --to csv"), "");
    let nothing = place.succeed("furthest none.csv --queries q.csv -o - --to csv -q");
    assert_eq!(answers(&nothing, 1), [[-1.0]; 4]);
    place.file("bad.csv", "0,0\nnan,1\n");
    place.fail("hull bad.csv -o h.npy", 1, "point 1");
    place.fail("furthest p.csv --queries bad.csv -o h.npy", 1, "query 1");
    place.fail(
        "furthest p.csv --queries - -o h.npy",
        2,
        "only the input itself can come from standard input",
    );
    place.fail("hull p.csv -o h.png", 2, "npy or csv");
    // What would change nothing is refused.
    place.fail("hull p.csv --algorithm flips -o h.npy", 2, "--algorithm is for hulls in space");
    place.fail("hull p.csv --seed 3 -o h.npy", 2, "--seed is for random orders");
    place.fail(
        "hull p.csv --dim 3 --algorithm quickhull --seed 3 -o h.npy",
        2,
        "--seed is for random orders",
    );
    place.fail(
        "hull p.csv --dim 3 -o h.laz",
        2,
        "surfaces in space or rows of indices are not written to las files",
    );
    place.fail("hull p.csv --dim 3 -o h.svg --view 10,100", 2, "two angles");
    place.fail("hull p.csv --dim 3 -o h.npy", 1, "no third coordinate");
    let cube: String = (0..9).map(|i| format!("{} {} {}\n", i & 1, i >> 1 & 1, i >> 2 & 1)).collect();
    place.file("cube.xyz", cube);
    assert_eq!(rows(&place.succeed("hull cube.xyz --dim 3 -o - --to csv --stats s.json")).len(), 12);
    let stats: Value =
        serde_json::from_slice(&std::fs::read(place.path("s.json")).expect("stats")).expect("JSON");
    assert_eq!((&stats["hull"], &stats["faces"]), (&8.into(), &6.into()));
    let made =
        "hull cube.xyz --dim 3 --algorithm history --seed 3 -o h.npy -o h.stl -o h.obj -o h.svg -o h.png";
    place.succeed(&format!("{made} --view 30,30 --size 300 --stats t.json"));
    place.succeed("hull cube.xyz --dim 3 -o q.npy");
    let read = |name: &str| std::fs::read(place.path(name)).expect("written");
    assert_eq!(read("h.npy"), read("q.npy"));
    assert_eq!(read("h.stl").len(), 84 + 12 * 50);
    // Three faces of a cube are seen at once.
    assert_eq!(String::from_utf8_lossy(&read("h.svg")).matches("<path fill=\"#").count(), 3);
    let obj = String::from_utf8(read("h.obj")).expect("text");
    assert_eq!((obj.matches("v ").count(), obj.matches("f ").count()), (8, 12));
    place.file("flat.xyz", "0 0 0\n1 0 0\n0 1 0\n");
    assert_eq!(place.succeed("hull flat.xyz --dim 3 -o - --to csv -q"), "");
}

#[test]
fn cells_of_real_data() {
    let place = Place::new();
    let tile = data("autzen_trim.laz");
    place.succeed(&format!("voronoi {} --class 2 -o cells.png --size 400 -q --stats s.json", tile.display()));
    let stats: Value =
        serde_json::from_slice(&std::fs::read(place.path("s.json")).expect("stats")).expect("JSON");
    assert_eq!(stats["cells"], stats["vertices"]);
}

#[test]
fn disks_and_hints_are_drawn() {
    let place = Place::new();
    place.succeed("generate disks -n 30 --seed 1 -o p.csv");
    place.succeed("draw p.csv --disks 1 --hints -o d.svg -o d.png --size 300 -q");
    let svg = std::fs::read_to_string(place.path("d.svg")).expect("written");
    assert_eq!(svg.matches("<circle").count(), 60);
    assert_eq!(svg.matches("fill-opacity").count(), 1);
    place.fail("draw p.csv --disks=-1 -o x.svg", 2, "--disks");
    place.fail("draw p.csv --dim 3 --hints -o x.svg", 2, "for the plane");
    place.file("square.csv", "0,0\n4,0\n4,4\n0,4\n");
    place.succeed("draw square.csv --disks 0.25 --certain -o c.svg -o c.png --size 300 -q");
    let svg = std::fs::read_to_string(place.path("c.svg")).expect("written");
    let strokes = |color: &str| {
        let path = svg.lines().find(|line| line.contains(&format!(r#"stroke="{color}""#))).expect("lines");
        path.split_once(" d=").map_or(0, |(_, steps)| steps.matches('m').count())
    };
    // The sides are certain, both diagonals possible.
    assert_eq!((strokes("#2e7d32"), strokes("#cfd8dc")), (4, 2));
    place.fail("draw p.csv --certain -o x.svg", 2, "--disks");
    place.fail("draw p.csv --disks 1e308 --certain -o x.svg", 1, "radius");
}

/// Where which sites are the nearest: a feature a set, and a sound answer to orders that there are not.
#[test]
fn orders_are_written_by_their_sites() {
    let place = Place::new();
    place.file("sites.csv", "0,0\n4,0\n0,0\n0,4\n4,4\n2,1\n");
    place.succeed("voronoi sites.csv --order 2 -o o.geojson -o o.svg -o o.png --stats o.json -q");
    let json = |name: &str| -> Value {
        serde_json::from_slice(&std::fs::read(place.path(name)).expect("a file")).expect("JSON")
    };
    let features = json("o.geojson")["features"].as_array().expect("features").clone();
    let area: f64 = features.iter().map(|f| f["properties"]["area"].as_f64().expect("an area")).sum();
    assert!((area - 16.0).abs() < 1e-12, "{area}");
    let sets: Vec<String> = features.iter().map(|f| f["properties"]["sites"].to_string()).collect();
    assert!(sets.contains(&"[0,5]".to_owned()) && sets.is_sorted(), "{sets:?}");
    assert!(!sets.iter().any(|set| set.contains('2')), "a duplicate is no site: {sets:?}");
    assert_eq!(json("o.json")["regions"], features.len());
    assert!(std::fs::read(place.path("o.png")).expect("a picture").starts_with(b"\x89PNG"));
    let svg = String::from_utf8(std::fs::read(place.path("o.svg")).expect("a picture")).expect("text");
    assert!(svg.contains("<title>0 5</title>"));
    // All sites at once, and orders beyond.
    place.succeed("voronoi sites.csv --order 5 -o all.geojson -q");
    assert_eq!(json("all.geojson")["features"].as_array().map(Vec::len), Some(1));
    for k in ["0", "6"] {
        let line = format!("voronoi sites.csv --order {k} -o bad.geojson -q");
        place.fail(&line, 2, "there are 5 sites");
        assert!(!place.path("bad.geojson").exists());
    }
    place.fail("voronoi sites.csv --order 2 --relax 1 -o bad.geojson", 2, "cannot be used with");
}
