//! Well-known text: one rule for all commands, one geometry a line or one collection.

use crate::place::Place;

/// A command that writes `out.wkt`, and how many geometries it writes.
const COMMANDS: [(&str, usize); 12] = [
    ("triangulate p.csv", 2),
    ("triangulate p.csv --weights w.csv", 2),
    ("triangulate two.geojson", 2),
    ("mesh two.geojson --min-angle 0", 2),
    ("polygons two.geojson", 2),
    ("alpha p.csv --alpha 100", 1),
    ("simplify p.csv --max-error 0", 2),
    ("generate uniform -n 5", 1),
    ("window folder", 2),
    ("voronoi p.csv", 4),
    ("voronoi p.csv --weights w.csv", 4),
    ("voronoi p.csv --order 2", 5),
];

fn place() -> Place {
    let place = Place::new();
    place.file("p.csv", "0,0,1\n4,0,2\n0,4,3\n5,5,5\n");
    place.file("w.csv", "0\n0\n0\n0\n");
    let triangle = |x: i32| {
        let ring = format!("[[{x},0],[{},0],[{x},1],[{x},0]]", x + 1);
        format!(
            r#"{{"type":"Feature","properties":null,"geometry":{{"type":"Polygon","coordinates":[{ring}]}}}}"#
        )
    };
    let features = format!("{},{}", triangle(0), triangle(7));
    place.file("two.geojson", format!(r#"{{"type":"FeatureCollection","features":[{features}]}}"#));
    place.succeed("tiles p.csv -o folder --heights -q");
    place
}

#[test]
fn all_commands_have_one_rule() {
    let place = place();
    for (command, count) in COMMANDS {
        let written = |form: &str| {
            place.succeed(&format!("{command} {form} -o out.wkt -q"));
            std::fs::read_to_string(place.path("out.wkt")).expect("written")
        };
        let lines = written("");
        assert_eq!(lines, written("--wkt lines"), "{command}");
        assert_eq!(lines.lines().count(), count, "{command}: {lines}");
        let is_one = |line: &str| line.starts_with("POLYGON") || line.starts_with("MULTIPOINT");
        assert!(lines.lines().all(is_one), "{command}: {lines}");
        let whole = written("--wkt collection");
        let sign = if lines.contains(" Z ") { " Z" } else { "" };
        let expected = lines.trim_end().lines().collect::<Vec<_>>().join(",\n");
        assert_eq!(whole, format!("GEOMETRYCOLLECTION{sign} (\n{expected}\n)\n"), "{command}");
        place.succeed("info out.wkt -q");
    }
}

#[test]
fn a_form_needs_well_known_text() {
    let place = place();
    for (command, _) in COMMANDS {
        place.fail(
            &format!("{command} --wkt collection -o out.geojson"),
            2,
            "--wkt is for outputs of well-known text",
        );
    }
    place.fail("triangulate p.csv --wkt one -o out.wkt", 2, "one");
}

#[test]
fn nothing_is_an_empty_collection() {
    let place = place();
    place.succeed("alpha p.csv --alpha 0 -o none.wkt -q");
    let text = std::fs::read_to_string(place.path("none.wkt")).expect("written");
    assert_eq!(text, "GEOMETRYCOLLECTION Z EMPTY\n");
}
