//! `--antimeridian`: what crosses 180 degrees of longitude is told, or cut there.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::place::{Place, text};

type Ring<'a> = &'a [[f64; 2]];

/// A band across 180 degrees, as Fiji is, and with a pond that crosses too.
const FIJI: Ring = &[[177.0, -20.0], [-178.0, -20.0], [-178.0, -15.0], [177.0, -15.0]];
const POND: Ring = &[[179.0, -18.0], [179.0, -17.0], [-179.0, -16.0], [-179.0, -19.0]];
/// A ring around the south pole, shell by its direction.
const ANTARCTICA: Ring =
    &[[-120.0, -70.0], [170.0, -75.0], [120.0, -70.0], [60.0, -68.0], [0.0, -70.0], [-60.0, -72.0]];
const WORLD: Ring = &[[-180.0, -90.0], [180.0, -90.0], [180.0, 90.0], [-180.0, 90.0]];

/// A collection of polygons, of which each has its number as an attribute.
fn collection(polygons: &[&[Ring]]) -> String {
    let features: Vec<Value> = polygons
        .iter()
        .enumerate()
        .map(|(i, rings)| {
            let closed = |ring: &Ring| ring.iter().chain(ring.first()).copied().collect::<Vec<_>>();
            let rings: Vec<_> = rings.iter().map(closed).collect();
            let geometry = serde_json::json!({ "type": "Polygon", "coordinates": rings });
            serde_json::json!({ "type": "Feature", "properties": { "name": format!("n{i}") }, "geometry": geometry })
        })
        .collect();
    serde_json::json!({ "type": "FeatureCollection", "features": features }).to_string()
}

fn reversed(ring: Ring) -> Vec<[f64; 2]> {
    ring.iter().rev().copied().collect()
}

fn json(place: &Place, name: &str) -> Value {
    serde_json::from_str(&place.read(name)).expect("JSON")
}

fn ring_of(feature: &Value) -> Vec<[f64; 2]> {
    serde_json::from_value(feature["geometry"]["coordinates"][0].clone()).expect("a ring")
}

fn area(ring: Ring) -> f64 {
    ring.windows(2).map(|side| (side[0][0] * side[1][1] - side[1][0] * side[0][1]) / 2.0).sum()
}

/// The area of each part by its number and the name of what it is of; all longitudes are in [-180, 180].
fn parts(place: &Place, name: &str) -> BTreeMap<(u64, String), f64> {
    let mut areas = BTreeMap::new();
    for feature in json(place, name)["features"].as_array().expect("features") {
        let (ring, about) = (ring_of(feature), &feature["properties"]);
        assert!(ring.iter().all(|p| p[0].abs() <= 180.0 && p[1].abs() <= 90.0), "{ring:?}");
        let number = about["polygon"].as_u64().expect("a number");
        *areas.entry((number, about["name"].as_str().expect("a name").to_owned())).or_insert(0.0) +=
            area(&ring);
    }
    areas
}

/// The areas of the parts of one polygon, by `polygons`, and what was told.
fn cut(rings: &[Ring]) -> (Vec<f64>, String) {
    let place = Place::new();
    place.file("p.geojson", collection(&[rings]));
    let output = place.run("polygons p.geojson --antimeridian cut -o t.geojson");
    let told = text(&output.stderr);
    assert!(output.status.success(), "{told}");
    let areas = parts(&place, "t.geojson");
    // Other commands have the same inside.
    place.succeed("triangulate p.geojson --antimeridian cut -o t.obj -o u.geojson");
    let all = json(&place, "u.geojson")["features"]
        .as_array()
        .map(|all| all.iter().map(|f| area(&ring_of(f))).sum());
    assert!((all.unwrap_or(0.0) - areas.values().sum::<f64>()).abs() < 1e-9, "{areas:?}");
    (areas.into_values().collect(), told)
}

fn near(found: &[f64], expected: &[f64]) {
    let is_near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-9 * b;
    assert!(
        found.len() == expected.len() && found.iter().zip(expected).all(is_near),
        "{found:?}, not {expected:?}"
    );
}

#[test]
fn crossings_are_told_where_they_are_kept() {
    let place = Place::new();
    place.file(
        "p.geojson",
        collection(&[&[&[[0.0, 0.0], [9.0, 0.0], [9.0, 9.0]]], &[FIJI, POND], &[ANTARCTICA]]),
    );
    let expected = "note: p.geojson: edges whose longitudes differ by more than 180 degrees: 5 (polygon 1, ring 0); rings around a pole: 1 (polygon 2, ring 0); they are taken as they stand, and --antimeridian cut goes the short way";
    for command in ["triangulate", "mesh", "polygons"] {
        let told = text(
            &place.run(&format!("{command} p.geojson --fill nonzero --crossings split -o t.obj")).stderr,
        );
        assert!(told.contains(expected), "{command}: {told}");
    }
    assert!(
        text(&place.run("draw p.geojson --crossings split --antimeridian keep -o t.svg").stderr)
            .contains(expected)
    );
    place.file("s.csv", "1,1\n2,1\n2,3\n");
    place.file("c.geojson", collection(&[&[FIJI]]));
    let told = text(&place.run("voronoi s.csv --clip c.geojson -o t.geojson").stderr);
    assert!(
        told.contains("note: c.geojson: edges whose longitudes differ by more than 180 degrees: 2"),
        "{told}"
    );
    let line = r#"{"type":"Feature","properties":{"n":1},"geometry":{"type":"LineString","coordinates":[[170,0],[-170,1]]}}"#;
    place.file("l.geojson", line);
    let told = text(&place.run("triangulate l.geojson -o t.gpkg").stderr);
    assert!(told.contains("more than 180 degrees: 1 (row 0); they"), "{told}");
    // Plane coordinates, other systems and what was cut already are told nothing.
    let closed: Ring = &[[-180.0, -90.0], [180.0, -90.0], [180.0, -70.0], [0.0, -65.0], [-180.0, -70.0]];
    for quiet in [
        collection(&[&[&[[0.0, 0.0], [900.0, 0.0], [9.0, 9.0]]]]),
        collection(&[&[closed]]),
        collection(&[&[WORLD]]),
    ] {
        place.file("q.geojson", quiet);
        let told = text(&place.run("polygons q.geojson -o t.ply").stderr);
        assert!(!told.contains("180"), "{told}");
    }
    place.file("w.wkt", "POLYGON ((170 0, -170 0, -170 9, 170 0))\n");
    assert!(!text(&place.run("polygons w.wkt -o t.ply").stderr).contains("180"));
}

#[test]
fn nothing_is_done_and_told_where_nothing_crosses() {
    let place = Place::new();
    let touching: Ring = &[[170.0, 0.0], [180.0, 5.0], [170.0, 10.0]];
    let along: Ring = &[[170.0, 20.0], [180.0, 20.0], [180.0, 25.0], [180.0, 30.0], [170.0, 30.0]];
    let far_latitude: Ring = &[[0.0, 95.0], [9.0, 95.0], [9.0, 99.0]];
    place.file("p.geojson", collection(&[&[touching], &[along], &[WORLD], &[far_latitude]]));
    for command in
        ["polygons p.geojson", "triangulate p.geojson --crossings split", "mesh p.geojson --crossings split"]
    {
        let [kept, cut] = ["keep", "cut"].map(|how| {
            let output = place.run(&format!("{command} --antimeridian {how} -o {how}.geojson"));
            assert!(output.status.success());
            let told = text(&output.stderr);
            assert!(!told.contains("meridian") && !told.contains("180"), "{told}");
            place.read(&format!("{how}.geojson"))
        });
        assert_eq!(kept, cut, "{command}");
    }
}

#[test]
fn polygons_are_cut() {
    let (areas, told) = cut(&[FIJI]);
    near(&areas, &[15.0, 10.0]);
    assert!(told.contains("note: polygons cut at the meridian of 180 degrees: 1, into parts: 2; further parts are polygons from 1 on"), "{told}");
    // Both directions, and the forms of longitudes: beyond 180, and either sign of it.
    near(&cut(&[&reversed(FIJI)]).0, &[15.0, 10.0]);
    near(&cut(&[&[[177.0, -20.0], [182.0, -20.0], [182.0, -15.0], [177.0, -15.0]]]).0, &[15.0, 10.0]);
    near(&cut(&[&[[-183.0, -20.0], [-178.0, -20.0], [-178.0, -15.0], [-183.0, -15.0]]]).0, &[15.0, 10.0]);
    // With a hole, which is a part of the outline then.
    near(&cut(&[FIJI, POND]).0, &[15.0 - 1.5, 10.0 - 2.5]);
    near(&cut(&[FIJI, &reversed(POND)]).0, &[13.5, 7.5]);
    // A hole on one side stays one.
    let lake: Ring = &[[178.0, -18.0], [178.0, -17.0], [179.0, -17.0], [179.0, -18.0]];
    near(&cut(&[FIJI, lake]).0, &[14.0, 10.0]);
    // From 180 on there is one part.
    for sign in [-180.0, 180.0] {
        let (areas, told) = cut(&[&[[sign, 0.0], [-179.0, 0.0], [-179.0, 10.0], [-sign, 10.0]]]);
        near(&areas, &[10.0]);
        assert!(
            told.contains("points moved by 360 degrees of longitude: 1") && !told.contains("cut"),
            "{told}"
        );
    }
    near(&cut(&[&[[190.0, 0.0], [200.0, 0.0], [200.0, 10.0], [190.0, 10.0]]]).0, &[100.0]);
    // A notch whose end is on the meridian: three parts, in the order of the ring.
    let notch: Ring = &[
        [170.0, 0.0],
        [190.0, 0.0],
        [190.0, 10.0],
        [170.0, 10.0],
        [170.0, 7.0],
        [180.0, 7.0],
        [180.0, 3.0],
        [170.0, 3.0],
    ];
    near(&cut(&[notch]).0, &[30.0, 100.0, 30.0]);
    // A hole that touches the meridian.
    let wide: Ring = &[[160.0, -30.0], [-160.0, -30.0], [-160.0, 30.0], [160.0, 30.0]];
    near(&cut(&[wide, &[[170.0, -20.0], [170.0, 20.0], [180.0, 0.0]]]).0, &[1000.0, 1200.0]);
    near(&cut(&[wide, &[[170.0, -20.0], [170.0, 20.0], [180.0, 20.0], [180.0, -20.0]]]).0, &[800.0, 1200.0]);
    // Across 180 and across 0.
    let long: Ring = &[
        [-10.0, 0.0],
        [80.0, 0.0],
        [170.0, 0.0],
        [-100.0, 0.0],
        [-100.0, 9.0],
        [170.0, 9.0],
        [80.0, 9.0],
        [-10.0, 9.0],
    ];
    near(&cut(&[long]).0, &[190.0 * 9.0, 80.0 * 9.0]);
}

#[test]
fn rings_around_a_pole_are_closed_along_it() {
    let below: f64 = 6900.0;
    let (areas, told) = cut(&[ANTARCTICA]);
    near(&areas, &[below]);
    assert!(
        told.contains("note: polygon 0, ring 0 goes around the south pole and is closed along it"),
        "{told}"
    );
    // The other direction is what is north of it.
    let (areas, told) = cut(&[&reversed(ANTARCTICA)]);
    near(&areas, &[64_800.0 - below]);
    assert!(told.contains("the north pole"), "{told}");
    near(&cut(&[WORLD, &reversed(ANTARCTICA)]).0, &[64_800.0 - below]);
    near(&cut(&[WORLD, FIJI]).0, &[64_800.0 - 25.0]);
    // A band between two rings.
    let north: Vec<_> = ANTARCTICA.iter().map(|p| [p[0], p[1] + 10.0]).collect();
    near(&cut(&[&north, &reversed(ANTARCTICA)]).0, &[3600.0]);
    // Formats without a rule for directions: the pole that is nearer.
    let place = Place::new();
    for ring in [ANTARCTICA.to_vec(), reversed(ANTARCTICA)] {
        let closed: Vec<String> = ring.iter().chain(ring.first()).map(|[x, y]| format!("{x} {y}")).collect();
        place.file("a.wkt", format!("POLYGON (({}))\n", closed.join(", ")));
        let told = text(&place.run("polygons a.wkt --antimeridian cut -o t.geojson").stderr);
        assert!(told.contains("the south pole"), "{told}");
        let all: f64 = json(&place, "t.geojson")["features"]
            .as_array()
            .expect("some")
            .iter()
            .map(|f| area(&ring_of(f)))
            .sum();
        near(&[all], &[below]);
    }
}

/// The latitude of a crossing is rounded once, so both parts and both directions have the same one.
#[test]
fn latitudes_are_the_same_on_both_sides() {
    let place = Place::new();
    let ring: Ring = &[[100.1, 0.7], [-97.3, 21.9], [-120.7, 55.5]];
    place.file("p.geojson", collection(&[&[ring], &[&reversed(ring)]]));
    place.succeed("polygons p.geojson --antimeridian cut -o t.geojson");
    let mut latitudes: BTreeMap<u64, Vec<bool>> = BTreeMap::new();
    for feature in json(&place, "t.geojson")["features"].as_array().expect("some") {
        for [x, y] in ring_of(feature).into_iter().filter(|p| p[0].abs() == 180.0) {
            latitudes.entry(y.to_bits()).or_default().push(x > 0.0);
        }
    }
    assert_eq!(latitudes.len(), 2);
    assert!(latitudes.values().all(|sides| sides.contains(&true) && sides.contains(&false)), "{latitudes:?}");
}

#[test]
fn lines_are_cut_with_what_they_have() {
    let place = Place::new();
    let line = |n: u8, corners: &str| {
        format!(
            r#"{{"type":"Feature","properties":{{"name":"n{n}"}},"geometry":{{"type":"LineString","coordinates":{corners}}}}}"#
        )
    };
    let lines =
        [line(0, "[[170,0,1],[-170,10,3],[-160,10,5]]"), line(1, "[[170,-20,0],[180,-20,1],[-179,-21,2]]")]
            .join(",");
    place.file("l.geojson", format!(r#"{{"type":"FeatureCollection","features":[{lines}]}}"#));
    let output = place.run("triangulate l.geojson --antimeridian cut -o l.obj -o l.poly --stats s.json");
    let told = text(&output.stderr);
    assert!(output.status.success(), "{told}");
    assert!(told.contains("note: segments of lines cut at the meridian of 180 degrees: 1"), "{told}");
    let corners = place.read("l.obj");
    // Heights are interpolated as latitudes are.
    for corner in ["v 180.0 5.0 2.0", "v -180.0 5.0 2.0", "v 180.0 -20.0 1.0", "v -180.0 -20.0 1.0"] {
        assert!(corners.replace(".0", "").contains(&corner.replace(".0", "")), "{corner}: {corners}");
    }
    let stats = &json(&place, "s.json")["antimeridian"];
    assert_eq!((&stats["segments"], &stats["added_points"]), (&1.into(), &3.into()));
    let segments = place.read("l.poly");
    assert!(segments.lines().any(|line| line == "5 0"), "{segments}");
}

#[test]
fn attributes_and_numbers_stay() {
    let place = Place::new();
    place.file("p.geojson", collection(&[&[FIJI], &[&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]]], &[ANTARCTICA]]));
    for command in ["polygons", "mesh", "triangulate"] {
        place.succeed(&format!("-q {command} p.geojson --antimeridian cut -o t.geojson"));
        let mut areas = BTreeMap::new();
        for feature in json(&place, "t.geojson")["features"].as_array().expect("some") {
            let name = feature["properties"]["name"].as_str().expect("a name").to_owned();
            *areas.entry(name).or_insert(0.0) += area(&ring_of(feature));
        }
        near(&areas.into_values().collect::<Vec<f64>>(), &[25.0, 2.0, 6900.0]);
    }
    place.succeed("-q polygons p.geojson --antimeridian cut -o t.geojson");
    let numbers: Vec<(u64, String)> = parts(&place, "t.geojson").into_keys().collect();
    let expected = [(0, "n0"), (1, "n1"), (2, "n2"), (3, "n0")].map(|(i, name)| (i, name.to_owned()));
    assert_eq!(numbers, expected);
}

#[test]
fn cells_are_clipped_to_the_parts() {
    let place = Place::new();
    place.file("s.csv", "x,y\n175,5\n-175,5\n185,6\n172,3\n");
    place.file("c.geojson", collection(&[&[&[[170.0, 0.0], [-170.0, 0.0], [-170.0, 10.0], [170.0, 10.0]]]]));
    place.succeed("voronoi s.csv --clip c.geojson --antimeridian cut -o v.geojson --stats s.json");
    assert_eq!(json(&place, "s.json")["cells"], 4);
    near(&[json(&place, "s.json")["area"].as_f64().expect("an area")], &[200.0]);
    place.fail(
        "voronoi s.csv --antimeridian cut --periodic 5,5 -o c.geojson",
        2,
        "--antimeridian cut is for points",
    );
}

#[test]
fn what_cannot_be_cut_is_named() {
    let place = Place::new();
    let fail = |ring: Ring, expected: &str| {
        place.file("p.geojson", collection(&[&[FIJI], &[ring]]));
        place.fail(
            "polygons p.geojson --antimeridian cut -o t.ply",
            1,
            &format!("p.geojson: polygon 1, ring 0: {expected}"),
        );
    };
    fail(&[[170.0, 0.0], [541.0, 0.0], [190.0, 9.0]], "the longitude 541 is not within 540 degrees of 0");
    fail(&[[170.0, 0.0], [190.0, 0.0], [190.0, 91.0]], "the latitude 91 is beyond 90 degrees");
    let twice: Ring = &[[0.0, 0.0], [120.0, 0.0], [-120.0, 0.0], [0.0, 9.0], [120.0, 9.0], [-120.0, 9.0]];
    fail(twice, "it goes 2 times around the world");
    let projected = r#"{"type":"Polygon","crs":{"type":"name","properties":{"name":"EPSG:25832"}},"coordinates":[[[170,0],[-170,0],[-170,10],[170,0]]]}"#;
    place.file("u.geojson", projected);
    place.fail("polygons u.geojson --antimeridian cut -o t.ply", 1, "its coordinates are EPSG:25832");
    place.file("t.csv", "0,1,2\n");
    place.fail(
        "mesh p.geojson --refine t.csv --antimeridian cut -o t.ply",
        2,
        "--antimeridian cut is not for triangles",
    );
    // Places of no number are for the triangulation to refuse, and sides that cross too.
    place.file("n.wkt", "POLYGON ((170 0, 190 0, NaN 9, 170 0))\n");
    assert_eq!(place.run("polygons n.wkt --antimeridian cut -o t.ply").status.code(), Some(1));
    place.file("b.wkt", "POLYGON ((150 0, 170 10, 170 0, -170 0, 150 10, 150 0))\n");
    place.fail("polygons b.wkt --antimeridian cut -o t.ply", 1, "cross");
}
