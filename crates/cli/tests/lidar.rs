//! Trees of LiDAR points, boxes of them and their dimensions, by the program.

use std::fs;
use std::path::Path;

use crate::place::{Place, data};

/// A folder with a copy of the files of `data/lidar`.
fn place() -> Place {
    fn copy(from: &Path, to: &Path) {
        fs::create_dir_all(to).expect("room");
        for entry in fs::read_dir(from).expect("a folder") {
            let path = entry.expect("an entry").path();
            let to = to.join(path.file_name().expect("a name"));
            if path.is_dir() { copy(&path, &to) } else { _ = fs::copy(&path, &to).expect("room") }
        }
    }
    let place = Place::new();
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/lidar"), &place.path("l"));
    place
}

fn said(place: &Place, line: &str) -> String {
    let output = place.run(line);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{line}: {said}");
    said
}

#[test]
fn a_tree_is_one_input_whatever_its_name() {
    let place = place();
    for options in ["", " --within 1010,2010,1030.25,2040", " --class ground --columns x,y,intensity"] {
        place.succeed(&format!("-q triangulate l/small.laz -o whole.ply{options}"));
        let names = ["l/small.copc.laz", "l/laszip", "l/laszip/ept.json", "l/binary", "l/zstandard/ept.json"];
        for name in names {
            place.succeed(&format!("-q triangulate {name} -o tree.ply{options}"));
            let sorted = |name: &str| {
                let text = fs::read(place.path(name)).expect("a mesh");
                let count = text.windows(10).position(|word| word == b"end_header").expect("a header");
                text[..count].to_vec()
            };
            assert_eq!(sorted("tree.ply"), sorted("whole.ply"), "{name}");
            // Tiles read the input twice, in pieces, and know triangles by their corners alone.
            for (input, folder) in [("l/small.laz", "a"), (name, "b")] {
                _ = fs::remove_dir_all(place.path(folder));
                place.succeed(&format!("-q tiles {input} --heights -o {folder}{options}"));
            }
            let print = |folder: &str| {
                let text = place.succeed(&format!("info {folder}"));
                text.lines().find(|line| line.starts_with("fingerprint")).expect("a line").to_owned()
            };
            assert_eq!(print("a"), print("b"), "{name} {options}");
        }
    }
    // A folder of both kinds has the tree once, and with its format named the files.
    fs::create_dir(place.path("both")).expect("room");
    fs::rename(place.path("l/laszip"), place.path("both/tree")).expect("room");
    fs::copy(place.path("l/small.laz"), place.path("both/a.laz")).expect("room");
    for (options, points) in [("", 1140), (" --from las", 1140), (" --from ept", 570)] {
        place.succeed(&format!("-q triangulate both -o o.ply --stats s.json{options}"));
        assert!(place.read("s.json").contains(&format!("\"points\": {points},")), "{options}");
    }
    fs::remove_file(place.path("both/tree/ept-data/0-0-0-0.laz")).expect("it is there");
    place.fail("triangulate both -o o.ply", 1, "0-0-0-0.laz");
    place.fail("triangulate l/binary/ept.json -o l/binary/ept.json --to geojson", 2, "would overwrite");
    place.fail("triangulate l/binary -o l/binary/ept-data/0-0-0-0.bin --to ply", 2, "would overwrite");
}

#[test]
fn the_rest_of_a_tree_is_not_read() {
    let place = place();
    for name in ["l/small.copc.laz", "l/laszip"] {
        let said = said(&place, &format!("triangulate {name} --within 1120,2001,1121,2002 -o o.ply"));
        assert!(said.contains(": 4 of ") && said.contains(" nodes are read, with "), "{said}");
    }
    let wrong = "a box is four numbers, the least x and y first";
    for within in ["1,2,3", "3,0,1,1", "0,0,nan,1", "a,b,c,d"] {
        place.fail(&format!("triangulate l/small.laz -o o.ply --within {within}"), 2, wrong);
    }
    place.file("a.csv", "x,y\n0,0\n1,0\n0,1\n");
    place.fail("triangulate a.csv -o o.ply --within 0,0,1,1", 2, "--within is for LAS, LAZ and EPT");
    place.fail("triangulate a.csv -o o.ply --attributes red", 2, "--attributes is for LAS, LAZ and EPT");
    place.succeed("-q triangulate l/small.laz -o o.ply --within -5,-1e9,1e9,1e9");
}

#[test]
fn dimensions_go_along() {
    let place = place();
    let within = "--within 1010,2010,1030.25,2040";
    let names = "intensity,Reflectance,Pulse";
    place.succeed(&format!("-q voronoi l/small.laz {within} --attributes {names} -o cells.csv"));
    let text = place.read("cells.csv");
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("site,area,intensity,Reflectance,Pulse,z,wkt"));
    let whole = |field: &str| field.parse::<u64>().is_ok();
    assert!(lines.clone().count() > 20);
    for line in lines {
        let fields: Vec<&str> = line.splitn(6, ',').collect();
        assert!(whole(fields[2]) && (fields[3].is_empty() || fields[3].contains('.')), "{line}");
        // Beyond whole numbers of 64 bits with a sign, as near as numbers come.
        assert!(whole(fields[4]) || fields[4].parse::<f64>().is_ok_and(|n| n > 9.2e18), "{line}");
    }
    place.file("a.csv", "x,y\n1010,2010\n1030,2010\n1010,2050\n");
    place.succeed(
        "-q nearest a.csv --queries l/small.copc.laz --attributes gps_time,class -o n.csv"
            .replace(",class", ",Classification")
            .as_str(),
    );
    assert!(
        place.read("n.csv").starts_with("x,y,gps_time,Classification,z,"),
        "{}",
        &place.read("n.csv")[..60]
    );
    let of_mesh = said(&place, "triangulate l/small.laz --attributes red -o o.ply");
    assert!(of_mesh.contains("o.ply: the attributes of the input are left out: red"), "{of_mesh}");
    place.fail(
        "triangulate l/small.laz --attributes nir -o o.ply",
        1,
        "its points have no nir, but intensity, ",
    );
    place.fail("triangulate l/small.laz --columns x,y,Red,Green -o o.ply", 1, "columns are x, y and one");
    let info = place.succeed("info l/small.laz --stats s.json");
    assert!(
        info.contains("extra bytes            Reflectance: int16 times 0.01 plus -5.0, no data -32768\n"),
        "{info}"
    );
    assert!(place.read("s.json").contains("\"Pulse\": \"uint64\""));
}

#[test]
fn a_file_without_ground_is_named() {
    let place = place();
    fs::create_dir(place.path("many")).expect("room");
    fs::copy(place.path("l/small.laz"), place.path("many/a.laz")).expect("room");
    let tile = crate::folders::scan(1000, 1);
    place.file("many/b.las", tile);
    for line in [
        "dtm many --cell 4 -o o.npy",
        "dtm many --cell 4 -o o.npy --memory 64M",
        "tiles many --class ground -o t",
        "triangulate many --class ground -o o.ply",
        "voronoi many --class ground -o o.csv",
        "info many --class ground",
    ] {
        let said = said(&place, line);
        assert_eq!(said.matches("b.las: none of its 3 points is taken").count(), 1, "{line}: {said}");
        assert!(!said.contains("a.laz: none"), "{line}: {said}");
    }
    fs::remove_file(place.path("many/a.laz")).expect("it is there");
    place.file("many/c.las", crate::folders::scan(0, 5));
    place.fail("dtm many -o o.npy", 1, "there are no points of ground");
    place.fail("dtm many -o o.npy --memory 64M", 1, "there are no points of ground");
}

#[test]
fn ground_and_units_are_told() {
    let place = place();
    let note = "l/small.laz: points of all classes are taken; --class ground takes the ground alone";
    for command in
        ["contours l/small.laz --interval 5 -o c.geojson", "simplify l/small.laz --max-error 1 -o s.ply"]
    {
        assert_eq!(said(&place, command).matches(note).count(), 1, "{command}");
        assert!(!said(&place, &format!("{command} --class ground")).contains("of all classes"), "{command}");
    }
    let told = |line: &str| place.succeed(line);
    let feet = told(&format!("-q info {}", data("autzen_trim.laz").display()));
    assert!(feet.contains("unit of x and y        foot\n"), "{feet}");
    place.file("p.csv", "x,y,z\n1,2,3\n");
    let both = told("-q info p.csv --epsg 25832+6360");
    assert!(both.contains("unit of x and y        metre\nunit of heights        foot\n"), "{both}");
    let degrees = told("-q info p.csv --epsg 4326");
    assert!(degrees.contains("unit of x and y        degree\n") && !degrees.contains("heights"), "{degrees}");
}
