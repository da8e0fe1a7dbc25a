//! Pictures: sizes that are what was asked for, the shape and the scale of what is on the ground, what colors mean, and notes.

use crate::place::{Place, text};

/// Width and height of a picture.
fn size(place: &Place, name: &str) -> [u32; 2] {
    let bytes = std::fs::read(place.path(name)).expect("written");
    if bytes.starts_with(b"\x89PNG") {
        return [16, 20].map(|at| u32::from_be_bytes(bytes[at..at + 4].try_into().expect("four")));
    }
    let svg = place.read(name);
    let (_, rest) = svg.split_once("viewBox=\"0 0 ").expect("a box");
    let mut sides = rest.split(['"', ' ']).map(|side| side.parse().expect("a number"));
    [(); 2].map(|()| sides.next().expect("a side"))
}

/// The texts of a vector picture.
fn labels(place: &Place, name: &str) -> Vec<String> {
    let texts = place.read(name);
    let texts = texts.split("<text ").skip(1).filter_map(|part| part.split(['>', '<']).nth(1));
    texts.map(str::to_owned).collect()
}

#[test]
fn the_longer_side_is_what_was_asked_for() {
    let place = Place::new();
    for (wide, high) in [(1.0, 1.0), (1.0, 0.97), (3.0, 1.0), (1.0, 3.0), (1e6, 1.0), (1.0, 1e6), (0.0, 0.0)]
    {
        place.file("p.csv", format!("0,0,1\n{wide},0,2\n{wide},{high},3\n0,{high},4\n"));
        for wanted in [16, 200, 448, 449, 1600, 1601] {
            place.succeed(&format!("-q draw p.csv --size {wanted} -o p.svg -o p.png"));
            let sides = size(&place, "p.svg");
            assert_eq!(sides, size(&place, "p.png"), "{wide} {high} {wanted}");
            assert_eq!(sides.into_iter().max(), Some(wanted), "{wide} {high} {wanted}");
            assert!(sides.into_iter().all(|side| side >= wanted / 3), "{wide} {high} {wanted}: {sides:?}");
        }
    }
}

#[test]
fn degrees_have_the_shape_that_they_have_on_the_ground() {
    let place = Place::new();
    let ring = "[[[10,59],[14,59],[14,61],[10,61],[10,59]]]";
    let geojson = format!(r#"{{"type":"Polygon","coordinates":{ring}}}"#);
    place.file("a.geojson", &geojson);
    place.file("a.csv", "10,59\n14,59\n14,61\n10,61\n");
    // At 60 degrees a degree of longitude is half of one of latitude: the area is square.
    for (line, name) in [
        ("triangulate a.geojson -o s.svg", "km"),
        ("draw a.csv --epsg 4326 -o s.svg", "km"),
        ("polygons a.geojson -o s.svg", "km"),
        ("voronoi a.geojson --of areas -o s.svg", "km"),
        ("voronoi a.csv --epsg 4258 -o s.svg", "km"),
    ] {
        place.succeed(&format!("-q {line}"));
        let [wide, high] = size(&place, "s.svg");
        assert!(high == 1600 && wide > 1535 && wide < 1550, "{line}: {wide} {high}");
        let labels = labels(&place, "s.svg");
        assert!(labels.iter().any(|label| label.ends_with(name)), "{line}: {labels:?}");
    }
    // Nobody says that columns are degrees, and what is beyond the poles is none.
    place.file("far.geojson", geojson.replace("61]", "99]"));
    for line in ["draw a.csv -o s.svg", "triangulate far.geojson -o s.svg"] {
        place.succeed(&format!("-q {line}"));
        assert!(labels(&place, "s.svg").iter().any(|label| label.ends_with(" units")), "{line}");
    }
    place.succeed("-q draw a.csv -o s.svg");
    assert!(size(&place, "s.svg")[1] < 900);
    // Disks are drawn as ellipses, twice as high as wide.
    place.succeed("-q draw a.csv --epsg 4326 --disks 0.5 -o s.svg");
    assert!(place.read("s.svg").contains("<ellipse"));
    // Metres, kilometres, and feet in metres.
    for (epsg, scale, unit) in [(25832, 1.0, " m"), (25832, 1000.0, " km"), (2992, 1.0, " m")] {
        let corners =
            [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|[x, y]| format!("{},{}\n", x * scale, y * scale));
        place.file("m.csv", corners.concat());
        place.succeed(&format!("-q draw m.csv --epsg {epsg} -o s.svg -o s.png"));
        let found = labels(&place, "s.svg");
        assert!(found.iter().any(|label| label.ends_with(unit)) || scale == 1000.0, "{epsg}: {found:?}");
    }
}

#[test]
fn colors_are_told() {
    let place = Place::new();
    place.file("h.csv", "x,y,z\n0,0,100\n9,0,250\n9,9,600\n0,9,50\n5,4,480\n");
    place.succeed("-q triangulate h.csv --epsg 25832+7837 -o h.svg -o h.png");
    assert_eq!(labels(&place, "h.svg"), ["50", "325", "600 m", "1 m"]);
    place.succeed("-q triangulate h.csv -o h.svg");
    assert_eq!(labels(&place, "h.svg"), ["50", "325", "600", "1 unit"]);
    place.succeed("-q contours h.csv --interval 100 --bands --epsg 25832+6360 -o h.svg");
    assert!(
        labels(&place, "h.svg").iter().any(|label| label.ends_with(" ft")),
        "{:?}",
        labels(&place, "h.svg")
    );
    // Two regions, by their attributes.
    let square = "8 2 0 0\n1 0 0\n2 4 0\n3 4 4\n4 0 4\n5 1 1\n6 2 1\n7 2 2\n8 1 2\n\
                  8 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n5 5 6\n6 6 7\n7 7 8\n8 8 5\n0\n2\n\
                  1 0.5 0.5 7 -1\n2 1.5 1.5 8.5 -1\n";
    place.file("r.poly", square);
    place.succeed("-q triangulate r.poly -o r.svg -o r.png");
    assert_eq!(labels(&place, "r.svg"), ["region 7", "8.5", "0.5 units"]);
    place.succeed("-q draw r.poly --colors=no -o r.svg");
    assert_eq!(labels(&place, "r.svg").len(), 1);
    // The legend is in the strip below: its squares have the colors of the areas.
    place.succeed("-q triangulate r.poly -o r.svg");
    let svg = place.read("r.svg");
    let squares = svg.lines().filter(|line| line.contains("width=\"18.0\""));
    for square in squares {
        let (_, fill) = square.split_once("fill=").expect("a color");
        assert!(svg.contains(&format!("<path fill={}", &fill[..9])), "{square}");
    }
}

#[test]
fn vector_pictures_are_short() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 20000 --seed 1 -o p.npy");
    place.succeed("-q draw p.npy --edges=no --points=no -o p.svg");
    let bytes = place.path("p.svg").metadata().expect("written").len();
    assert!(bytes < 40_000 * 30, "{bytes} bytes for 40,000 triangles");
    place.succeed("-q generate uniform -n 180000 --seed 1 -o p.npy");
    let output = place.run("draw p.npy --edges --points -o p.svg");
    let told = text(&output.stderr);
    assert!(told.contains("p.svg: ") && told.contains("megabytes") && told.contains("png"), "{told}");
    let told = text(&place.run("draw p.npy -o p.png").stderr);
    assert!(!told.contains("megabytes"), "{told}");
}

#[test]
fn windows_show_what_crosses_the_border() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 2000 --seed 3 -o p.csv");
    place.succeed("-q tiles p.csv -o t --tile 400");
    place.succeed("-q window t --box 0.4,0.4,0.5,0.5 -o w.svg");
    let [wide, high] = size(&place, "w.svg").map(f64::from);
    let circles: Vec<[f64; 2]> = place
        .read("w.svg")
        .lines()
        .filter_map(|line| line.strip_prefix("<circle cx=\""))
        .map(|line| {
            let mut parts = line.split('"');
            [0, 2]
                .map(|skip| parts.nth(usize::from(skip > 0)).and_then(|x| x.parse().ok()).expect("a number"))
        })
        .collect();
    assert!(circles.len() > 20);
    assert!(circles.iter().all(|[x, y]| (0.0..wide).contains(x) && (0.0..high).contains(y)), "{circles:?}");
    // A folder knows the system of what it was made of.
    place.succeed("-q tiles p.csv -o u --tile 400 --epsg 25832");
    place.succeed("-q window u -o u.svg -o u.geojson");
    assert_eq!(labels(&place, "u.svg").last().map(String::as_str), Some("0.2 m"));
    assert!(place.read("u.geojson").contains("EPSG::25832"));
    let told = text(&place.run("window u -o u.off").stderr);
    assert!(told.contains("nothing in it says that its coordinates are EPSG:25832"), "{told}");
    let told = text(&place.run("window t --box 7,7,8,8 -o none.png").stderr);
    assert!(told.contains("no triangle of t is in the box"), "{told}");
    place.fail("window t --box 0.5,0.4,0.4,0.5 -o w.png", 2, "from 0.5,0.4 to 0.4,0.5");
    place.fail("window t --box 0.5,0.4,0.4 -o w.png", 2, "four numbers");
}
