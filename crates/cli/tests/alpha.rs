//! The command `alpha`.

use crate::place::{Place, rows};
use serde_json::Value;

fn json(place: &Place, name: &str) -> Value {
    serde_json::from_slice(&std::fs::read(place.path(name)).expect("a file")).expect("JSON")
}

/// A ring of lattice points around a missing one, and a triangle far away.
const RING: &str = "0,0\n1,0\n2,0\n0,1\n2,1\n0,2\n1,2\n2,2\n10,0\n11,0\n10,1\n";

#[test]
fn outlines_are_written_as_polygons() {
    let place = Place::new();
    place.file("ring.csv", RING);
    place.succeed(
        "alpha ring.csv --optimal 2 -o o.geojson -o o.wkt -o o.poly -o o.svg -o o.npy --stats s.json -q",
    );
    let stats = json(&place, "s.json");
    assert_eq!((&stats["alpha"], &stats["parts"]), (&Value::from(1.0), &Value::from(2)), "{stats}");
    let outline = json(&place, "o.geojson");
    let polygons: Vec<&Value> =
        outline["features"].as_array().expect("features").iter().map(|f| &f["geometry"]).collect();
    assert_eq!(polygons.len(), 2, "{outline}");
    assert!(polygons.iter().all(|polygon| polygon["type"] == "Polygon"));
    // With half of a square as the radius there are the corners alone.
    place.succeed("alpha ring.csv --alpha 0.5 -o half.geojson -o half.csv -q");
    assert_eq!(rows(&std::fs::read_to_string(place.path("half.csv")).expect("rows")).len(), 5);
    place.succeed("alpha ring.csv --radius 0.71 -o same.csv -q");
    assert_eq!(
        std::fs::read(place.path("same.csv")).expect("rows"),
        std::fs::read(place.path("half.csv")).expect("rows")
    );
    assert!(std::fs::read(place.path("o.svg")).expect("a picture").starts_with(b"<svg"));
    let wkt = std::fs::read_to_string(place.path("o.wkt")).expect("text");
    assert_eq!(wkt.matches("POLYGON").count(), 2, "{wkt}");
}

#[test]
fn filtrations_are_written_in_order() {
    let place = Place::new();
    place.file("p.csv", "0,0\n2,0\n0,2\n");
    place.succeed("alpha p.csv --filtration f.csv -q");
    let text = std::fs::read_to_string(place.path("f.csv")).expect("text");
    assert_eq!(text, "0.0,0\n0.0,1\n0.0,2\n1.0,0,1\n1.0,0,2\n2.0,1,2\n2.0,0,1,2\n");
    place.succeed("alpha p.csv --filtration f.npz -q");
    let bytes = std::fs::read(place.path("f.npz")).expect("an archive");
    assert!(bytes.starts_with(b"PK") && bytes.windows(19).any(|name| name == b"triangle_values.npy"));
    // Weights are squared radii: the values of vertices are their opposites.
    place.file("w.csv", "1\n0\n0.25\n");
    place.succeed("alpha p.csv --weights w.csv --filtration w.csv.txt -q");
    let text = std::fs::read_to_string(place.path("w.csv.txt")).expect("text");
    assert!(text.starts_with("-1.0,0\n-0.25,2\n0.0,1\n"), "{text}");
}

#[test]
fn surfaces_are_closed_and_named_by_points() {
    let place = Place::new();
    let cube: String = (0..27).map(|i| format!("{},{},{}\n", i % 3, i / 3 % 3, i / 9)).collect();
    place.file("cube.csv", cube);
    place.succeed("alpha cube.csv --dim 3 --optimal -o f.csv -o f.stl -o f.ply -o f.png --stats s.json -q");
    assert_eq!(rows(&std::fs::read_to_string(place.path("f.csv")).expect("rows")).len(), 48);
    assert_eq!(json(&place, "s.json")["alpha"], 0.75);
    // Two balls that meet: none of their tetrahedra, and no error.
    place.file("balls.csv", "0,0,0,1\n1,0,0,1\n");
    place.succeed("alpha balls.csv --dim 3 --columns 1,2,3 --radii 4 --alpha 0 -o none.ply --stats b.json");
    assert_eq!(json(&place, "b.json")["components"], 1);
}

#[test]
fn pictures_of_shapes_without_area_show_the_points() {
    let place = Place::new();
    place.file("p.csv", "0,0\n2,0\n0,2\n9,9\n");
    place.file("q.csv", "0,0,0\n2,0,0\n0,2,0\n0,0,2\n");
    place.file("line.csv", "0,0,0\n2,0,0\n3,0,0\n");
    place.file("flat.csv", "0,0,0\n2,0,0\n0,2,0\n2,2,0\n");
    let dots = |name: &str| {
        let picture = std::fs::read_to_string(place.path(name)).expect("written");
        picture.matches("<circle").count()
    };
    place.succeed("alpha p.csv --alpha 0.5 -o p.svg -o p.png -q");
    assert_eq!(dots("p.svg"), 4);
    // What is in no triangle is shown beside one.
    place.succeed("alpha p.csv --alpha 2 -o p.svg -q");
    assert_eq!(dots("p.svg"), 1);
    place.succeed("alpha q.csv --dim 3 --alpha 0.5 -o q.svg -o q.png -q");
    assert_eq!(dots("q.svg"), 4);
    place.succeed("alpha q.csv --dim 3 --alpha 9 -o q2.svg -q");
    assert_eq!(dots("q2.svg"), 0);
    place.succeed("triangulate line.csv --dim 3 -o line.svg -o line.png -q");
    place.succeed("hull flat.csv --dim 3 -o hull.svg -q");
    assert_eq!((dots("line.svg"), dots("hull.svg")), (3, 4));
    for name in ["p.png", "q.png", "line.png"] {
        assert!(std::fs::metadata(place.path(name)).expect("written").len() > 1000, "{name}");
    }
}

#[test]
fn points_that_are_no_vertices_keep_their_places() {
    let place = Place::new();
    place.file("p.csv", "100,200\n102,200\n100,202\n100,200\n100.5,200.5\n");
    place.file("w.csv", "0\n0\n0\n0\n-9\n");
    for more in ["", "--weights w.csv"] {
        for alpha in [0, 9] {
            place.succeed(&format!("alpha p.csv {more} --alpha {alpha} -o a.obj -o a.svg -q"));
            let obj = std::fs::read_to_string(place.path("a.obj")).expect("written");
            assert!(obj.contains("v 100.0 200.0 0.0\nv 100.5 200.5 0.0\n"), "{more} {alpha}: {obj}");
            // A picture of the points is square, one with the origin would be twice as high as wide.
            let svg = std::fs::read_to_string(place.path("a.svg")).expect("written");
            assert!(svg.contains(r#"viewBox="0 0 1544 1600""#), "{more} {alpha}: {svg}");
        }
    }
}

#[test]
fn wrong_use_is_named() {
    let place = Place::new();
    place.file("p.csv", "0,0\n2,0\n0,2\n");
    place.file("line.csv", "0,0\n1,0\n2,0\n");
    place.fail("alpha p.csv --alpha 1", 2, "nothing to write");
    place.fail("alpha p.csv -o a.geojson", 2, "the radius of the shape is not known");
    place.fail(
        "alpha p.csv --alpha 1 -o a.las",
        2,
        "lines and polygons or triangles of polygons are not written to las files",
    );
    place.fail(
        "alpha p.csv --alpha 1 --dim 3 -o a.geojson",
        2,
        "surfaces in space or rows of indices are not written to geojson files",
    );
    place.fail("alpha p.csv --filtration f.ply", 2, "filtrations are not written to ply files");
    place.fail("alpha line.csv --optimal -o a.geojson", 1, "span no shape");
    place.fail("alpha p.csv --optimal 0 -o a.geojson", 2, "0 parts");
    place.fail("alpha p.csv --filtration p.csv", 2, "overwrite");
}

#[test]
fn surfaces_that_touch_themselves_come_apart() {
    let place = Place::new();
    place.file("p.csv", "0,0,-1\n0,0,1\n3,-1,0\n3,1,0\n-3,-1,0\n-3,1,0\n");
    place.succeed("alpha p.csv --dim 3 --alpha 4 -o pinched.obj -o pinched.csv -q");
    place.succeed("alpha p.csv --dim 3 --alpha 4 --manifold -o apart.obj -o apart.csv -q");
    let count =
        |name: &str, what: &str| place.read(name).lines().filter(|line| line.starts_with(what)).count();
    assert_eq!(
        ["pinched.obj", "apart.obj"].map(|name| (count(name, "v "), count(name, "f "))),
        [(6, 8), (8, 8)]
    );
    // Indices of points are the same.
    assert_eq!(place.read("pinched.csv"), place.read("apart.csv"));
    place.fail("alpha p.csv --alpha 4 --manifold -o p.geojson", 2, "no surfaces");
}
