//! Polygons as regions: their sizes, and which one has a place that is in several.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::place::{Place, text};

/// A square, one that sticks out of it, and one that overlaps another corner.
const THREE: &str = r#"{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"m":"big","h":1.0},"geometry":{"type":"Polygon","coordinates":[[[0,0],[4,0],[4,4],[0,4],[0,0]]]}},
{"type":"Feature","properties":{"m":"small","h":0.25},"geometry":{"type":"Polygon","coordinates":[[[3,1],[5,1],[5,2],[3,2],[3,1]]]}},
{"type":"Feature","properties":{"m":"mid","h":null},"geometry":{"type":"Polygon","coordinates":[[[-1,-1],[1,-1],[1,2],[-1,2],[-1,-1]]]}}]}"#;

fn json(place: &Place, name: &str) -> Value {
    serde_json::from_slice(&std::fs::read(place.path(name)).expect("a file")).expect("JSON")
}

fn triangles(of: &Value) -> Vec<(String, u64, [[f64; 2]; 3])> {
    let features = of["features"].as_array().expect("features");
    let corner = |p: &Value| [0, 1].map(|k| p[k].as_f64().expect("a coordinate"));
    let of = |feature: &Value| {
        let ring = &feature["geometry"]["coordinates"][0];
        let name = feature["properties"]["m"].as_str().unwrap_or_default().to_owned();
        let region = feature["properties"]["region"].as_f64().unwrap_or(0.0) as u64;
        (name, region, [0, 1, 2].map(|k| corner(&ring[k])))
    };
    features.iter().map(of).collect()
}

fn area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
}

#[test]
fn a_place_in_several_polygons_has_the_one_that_is_asked_for() {
    let expected = [
        ("last", vec![("big", 1, 13.0), ("mid", 3, 6.0), ("small", 2, 2.0)]),
        ("first", vec![("big", 1, 16.0), ("mid", 3, 4.0), ("small", 2, 1.0)]),
        ("smallest", vec![("big", 1, 13.0), ("mid", 3, 6.0), ("small", 2, 2.0)]),
        (
            "combined",
            vec![("big", 1, 13.0), ("mid", 3, 4.0), ("mid", 5, 2.0), ("small", 2, 1.0), ("small", 4, 1.0)],
        ),
    ];
    let place = Place::new();
    place.file("three.geojson", THREE);
    for (rule, areas) in expected {
        for command in ["triangulate", "mesh --min-angle 25"] {
            let options = "--crossings split --fill nonzero --stats s.json -o t.geojson";
            place.succeed(&format!("{command} three.geojson --overlaps {rule} {options}"));
            let mut found: BTreeMap<(String, u64), f64> = BTreeMap::new();
            for (name, region, corners) in triangles(&json(&place, "t.geojson")) {
                *found.entry((name, region)).or_default() += area(corners);
            }
            let found: Vec<(&str, u64, f64)> = found
                .iter()
                .map(|((name, region), area)| (name.as_str(), *region, (area * 1e9).round() / 1e9))
                .collect();
            assert_eq!(found, areas, "{command} {rule}");
            let combined = &json(&place, "s.json")["combined"];
            let listed =
                serde_json::json!([{"region": 4, "polygons": [1, 2]}, {"region": 5, "polygons": [1, 3]}]);
            assert_eq!(combined, if rule == "combined" { &listed } else { &Value::Null });
        }
    }
}

#[test]
fn attributes_are_sizes() {
    let place = Place::new();
    place.file("three.geojson", THREE);
    let made = |options: &str| {
        place.succeed(&format!("mesh three.geojson --crossings split --fill nonzero {options} -o t.geojson"));
        triangles(&json(&place, "t.geojson"))
    };
    let longest = |[a, b, c]: [[f64; 2]; 3]| {
        [(a, b), (b, c), (c, a)]
            .into_iter()
            .map(|(p, q)| (q[0] - p[0]).hypot(q[1] - p[1]))
            .fold(0.0, f64::max)
    };
    let bound = |name: &str| {
        BTreeMap::from([("big", 1.0), ("small", 0.25)]).get(name).copied().unwrap_or(f64::INFINITY)
    };
    for options in [
        "--size-by h",
        "--size-by h --smooth 3",
        "--size-by h --max-edge 0.5",
        "--size-by h --min-angle 34.5",
    ] {
        let all = made(options);
        assert!(all.iter().all(|(name, _, corners)| longest(*corners) <= bound(name)), "{options}");
        assert!(all.len() > 150, "{options}");
    }
    assert!(made("--area-by h").iter().all(|(name, _, corners)| area(*corners) <= bound(name)));
    // A wanted length is that of most edges.
    let mut small: Vec<f64> =
        made("--edge 1 --size-by h").iter().filter(|t| t.0 == "small").map(|t| longest(t.2)).collect();
    small.sort_by(f64::total_cmp);
    assert!((0.2..0.35).contains(&small[small.len() / 2]), "{small:?}");
    // The sizes of a combined region are the smallest of its polygons.
    let all = made("--size-by h --overlaps combined");
    assert!(all.iter().filter(|t| t.1 == 4).all(|t| longest(t.2) <= 0.25));
}

#[test]
fn an_attribute_that_is_no_size_is_named() {
    let place = Place::new();
    place.file("three.geojson", THREE.replace("\"h\":0.25", "\"h\":-1"));
    for (option, status, expected) in [
        ("--size-by h", 1, "the attribute \"h\" of feature 2 is no size"),
        ("--area-by m", 1, "the attribute \"m\" of feature 1 is no size"),
        ("--size-by q", 2, "no feature has the attribute \"q\""),
    ] {
        let output = place.run(&format!("mesh three.geojson --crossings split {option} -o t.obj"));
        assert_eq!(output.status.code(), Some(status), "{option}");
        assert!(text(&output.stderr).contains(expected), "{}", text(&output.stderr));
        assert!(!place.path("t.obj").exists());
    }
}

/// Parts of a feature that overlap, a ring that crosses itself: by these rules all of it is inside, and has the attributes of the feature.
#[test]
fn parts_that_overlap_have_the_attributes_of_their_feature() {
    let place = Place::new();
    let polygons = [
        (
            "nonzero",
            "MultiPolygon",
            "[[[[0,0],[4,0],[4,4],[0,4],[0,0]]],[[[2,2],[6,2],[6,6],[2,6],[2,2]]]]",
            28.0,
        ),
        (
            "shells-minus-holes",
            "MultiPolygon",
            "[[[[0,0],[4,0],[4,4],[0,4],[0,0]]],[[[2,2],[2,6],[6,6],[6,2],[2,2]]]]",
            28.0,
        ),
        ("nonzero", "Polygon", "[[[0,0],[6,0],[6,4],[2,4],[2,2],[4,2],[4,6],[0,6],[0,0]]]", 32.0),
    ];
    for (fill, kind, coordinates, whole) in polygons {
        let feature = format!(
            r#"{{"type":"Feature","properties":{{"m":"one"}},"geometry":{{"type":"{kind}","coordinates":{coordinates}}}}}"#
        );
        place.file("one.geojson", feature);
        place.succeed(&format!("mesh one.geojson --crossings split --fill {fill} -o t.geojson"));
        let found = triangles(&json(&place, "t.geojson"));
        assert!(found.iter().all(|(name, ..)| name == "one"), "{fill} {kind}");
        let area: f64 = found.iter().map(|(_, _, corners)| area(*corners)).sum();
        assert!((area - whole).abs() < 1e-9, "{fill} {kind}: {area}");
    }
}
