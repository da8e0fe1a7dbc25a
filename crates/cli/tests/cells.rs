//! `delone voronoi` to well-known text, CSV and well-known binary: what GeoJSON has, bit for bit.

use std::fmt::Write;

use serde_json::Value;

use crate::place::Place;

/// Cells whole, in pieces, with a hole, and one of which nothing is left; with weights; of two sites each.
const COMMANDS: [&str; 4] = [
    "voronoi sites.csv --clip crown.geojson",
    "voronoi sites.csv --clip crown.geojson --weights w.csv",
    "voronoi sites.csv --clip crown.geojson --order 2",
    "voronoi thirds.csv --box 0,0,1,1",
];

fn place() -> Place {
    let place = Place::new();
    place.file("sites.csv", "0,-1\n0,-3\n0.1,0.3\n50,50\n7,-7\n");
    place.file("w.csv", "0\n0.5\n0.25\n0\n0\n");
    place.file("thirds.csv", "0.1,0.2\n0.3,0.7\n0.9,0.4\n0.65,0.35\n");
    place.file(
        "crown.geojson",
        r#"{"type":"Polygon","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25832"}},"coordinates":
        [[[-3,-3],[3,-3],[3,3],[2,-2.5],[-2,-2.5],[-3,3],[-3,-3]],[[-2.5,-2],[-2.5,-2.2],[-2.7,-2.2],[-2.5,-2]]]}"#,
    );
    place
}

/// A geometry of GeoJSON as well-known text.
fn text(geometry: &Value) -> String {
    fn list(value: &Value, depth: usize) -> String {
        let items = value.as_array().expect("a list");
        if depth == 0 {
            let numbers: Vec<_> =
                items.iter().map(|x| format!("{:?}", x.as_f64().expect("a number"))).collect();
            return numbers.join(" ");
        }
        let parts: Vec<_> = items.iter().map(|item| list(item, depth - 1)).collect();
        format!("({})", parts.join(", "))
    }
    match geometry["type"].as_str() {
        None => "POLYGON EMPTY".to_owned(),
        Some("Polygon") => format!("POLYGON {}", list(&geometry["coordinates"], 2)),
        Some("MultiPolygon") => format!("MULTIPOLYGON {}", list(&geometry["coordinates"], 3)),
        Some(other) => panic!("{other}"),
    }
}

/// A geometry of well-known binary as text.
fn binary_text(bytes: &mut &[u8]) -> String {
    fn number(bytes: &mut &[u8]) -> usize {
        u32::from_le_bytes(bytes.split_off(..4).expect("four bytes").try_into().expect("four")) as usize
    }
    fn list(bytes: &mut &[u8], mut item: impl FnMut(&mut &[u8]) -> String) -> String {
        let parts: Vec<String> = (0..number(bytes)).map(|_| item(bytes)).collect();
        if parts.is_empty() { "EMPTY".to_owned() } else { format!("({})", parts.join(", ")) }
    }
    fn rings(bytes: &mut &[u8]) -> String {
        let coordinate = |bytes: &mut &[u8]| {
            f64::from_le_bytes(bytes.split_off(..8).expect("eight bytes").try_into().expect("eight"))
        };
        list(bytes, |bytes| list(bytes, |bytes| format!("{:?} {:?}", coordinate(bytes), coordinate(bytes))))
    }
    assert_eq!(bytes.split_off(..1), Some(&[1][..]), "little endian");
    match number(bytes) {
        3 => format!("POLYGON {}", rings(bytes)),
        6 => {
            let polygon = |bytes: &mut &[u8]| binary_text(bytes).replace("POLYGON ", "");
            format!("MULTIPOLYGON {}", list(bytes, polygon))
        }
        7 => list(bytes, binary_text),
        other => panic!("kind {other}"),
    }
}

#[test]
fn all_formats_have_the_same_rings() {
    let place = place();
    let read = |name: &str| std::fs::read(place.path(name)).expect("written");
    let mut kinds = [0; 3];
    for command in COMMANDS {
        place.succeed(&format!("{command} -q -o c.geojson -o c.wkt -o c.csv -o c.wkb"));
        let json: Value = serde_json::from_slice(&read("c.geojson")).expect("JSON");
        let (mut lines, mut table) = (String::new(), String::new());
        for feature in json["features"].as_array().expect("features") {
            let (about, text) = (&feature["properties"], text(&feature["geometry"]));
            kinds[["POLYGON (", "POLYGON EMPTY", "MULTIPOLYGON"]
                .iter()
                .position(|k| text.starts_with(k))
                .expect("one")] += 1;
            writeln!(lines, "{text}").expect("text");
            let sites = match &about["sites"] {
                Value::Array(sites) => sites.iter().map(Value::to_string).collect::<Vec<_>>().join(" "),
                _ => about["site"].to_string(),
            };
            writeln!(table, "{sites},{:?},\"{text}\"", about["area"].as_f64().expect("an area"))
                .expect("text");
        }
        let name = if command.contains("order") { "sites" } else { "site" };
        assert_eq!(String::from_utf8(read("c.wkt")).expect("text"), lines, "{command}");
        assert_eq!(
            String::from_utf8(read("c.csv")).expect("text"),
            format!("{name},area,wkt\n{table}"),
            "{command}"
        );
        let binary = read("c.wkb");
        let whole = lines.trim_end().lines().collect::<Vec<_>>().join(", ");
        let mut rest = &binary[..];
        assert_eq!(binary_text(&mut rest), format!("({whole})"), "{command}");
        assert!(rest.is_empty());
        // The program reads its own files, the empty ones too.
        for name in ["c.wkt", "c.csv", "c.wkb"] {
            place.succeed(&format!("info {name} -q"));
        }
    }
    assert!(kinds.iter().all(|&count| count > 0), "all kinds are tried: {kinds:?}");
}

#[test]
fn systems_and_ranges() {
    let place = Place::new();
    place.file("known.wkt", "SRID=25832;MULTIPOINT ((0 0), (4 0), (0 4))");
    place.succeed("voronoi known.wkt -o c.geojson -o c.wkb -q");
    let read = |name: &str| std::fs::read(place.path(name)).expect("written");
    assert!(String::from_utf8(read("c.geojson")).expect("text").contains("EPSG::25832"));
    // A collection, with the number of its system.
    assert_eq!(read("c.wkb")[..9], [[1, 7, 0, 0, 0x20].as_slice(), &25832_u32.to_le_bytes()].concat());
    place.file("huge.csv", "1e300,0\n0,1e300\n-1e300,-1e300\n");
    let table = place.succeed("voronoi huge.csv -o - --to csv -q");
    assert!(table.lines().skip(1).all(|line| line.contains(",,\"POLYGON ((")), "{table}");
}

/// Cells of a lattice of decimals, turned: four corners each, but for the border.
#[test]
fn sides_are_merged() {
    let place = Place::new();
    let mut rows = String::new();
    for (i, j) in (0..64).map(|k| (f64::from(k % 8), f64::from(k / 8))) {
        let (x, y) = (0.1 * i, 0.1 * j);
        writeln!(rows, "{},{}", 7.3 + 0.6 * x - 0.8 * y, 46.9 + 0.8 * x + 0.6 * y).expect("text");
    }
    place.file("lattice.csv", &rows);
    place.file("equal.csv", "0.5\n".repeat(64));
    let whole = |text: &str| -> Vec<usize> {
        let cells = text.lines().skip(1).map(|line| line.matches(", ").count());
        cells.collect()
    };
    for how in ["", "--order 1", "--weights equal.csv"] {
        let exact = whole(&place.succeed(&format!("voronoi lattice.csv -o - --to csv --clip hull -q {how}")));
        assert!(exact.iter().any(|&sides| sides > 5), "{how}: {exact:?}");
        for merge in ["auto", "1e-9"] {
            let command = format!("voronoi lattice.csv -o - --to csv --clip hull -q {how} --merge {merge}");
            let cells = whole(&place.succeed(&command));
            assert!(cells.iter().filter(|&&sides| sides == 4).count() >= 36, "{command}: {cells:?}");
        }
    }
    for wrong in ["-1", "much"] {
        place.fail(
            &format!("voronoi lattice.csv -o c.csv --merge {wrong}"),
            2,
            "a length, or `auto`, is expected",
        );
    }
    place.fail("voronoi lattice.csv -o c.csv --merge inf", 2, "merge is inf; it must be a length");
    place.succeed("voronoi lattice.csv -o c.csv --merge auto -q --stats s.json");
    assert!(place.read("s.json").contains("\"merge\""));
}
