//! Rasters as a user asks for them: where cells are, what lines and duplicates do to heights, relief.

use std::fs;

use delone_generators::Kind;

use crate::dtm::raster;
use crate::place::{Place, text};

/// Points exactly on a line are at the height of the line, whatever the method and wherever the line is cut.
#[test]
fn lines_keep_their_heights_over_points() {
    let place = Place::new();
    let slope: String =
        (0..121).map(|i| format!("{},{},{}\n", 10 * (i % 11), 10 * (i / 11), i % 11)).collect();
    place.file("p.csv", &slope);
    place.file("river.geojson", r#"{"type":"LineString","coordinates":[[3.1,50,-5],[94.3,50,-5]]}"#);
    for method in ["linear", "natural", "laplace"] {
        place
            .succeed(&format!("-q dtm p.csv --cell 4 --method {method} --breaklines river.geojson -o a.npy"));
        let (_, columns, values) = raster(&place, "a.npy");
        // The row of centers on the river. Natural neighbors look past the vertices of a line a little.
        let along = &values[12 * columns..13 * columns];
        let off = if method == "linear" { 1e-9 } else { 0.05 };
        assert!(along[1..23].iter().all(|z| (z + 5.0).abs() < off), "{method}: {along:?}");
    }
    // Where several lines meet in a point the rule says which counts.
    place.file(
        "cross.geojson",
        r#"{"type":"MultiLineString","coordinates":[[[5,50,-5],[95,50,-5]],[[50,5,3],[50,95,3]]]}"#,
    );
    for (rule, height) in [("lowest", -5.0), ("highest", 3.0), ("mean", -1.0), ("first", -5.0)] {
        place.succeed(&format!(
            "-q dtm p.csv --cell 4 --duplicates {rule} --breaklines cross.geojson -o a.npy"
        ));
        let (_, columns, values) = raster(&place, "a.npy");
        assert_eq!(values[12 * columns + 12], height, "{rule}");
    }
}

/// Cells are where they were asked for.
#[test]
fn cells_have_a_place() {
    let place = Place::new();
    let points = Kind::Uniform.points(200, 3);
    let rows: String =
        points.iter().map(|[x, y]| format!("{:?},{:?},{:?}\n", 9.0 * x, 7.0 * y, x + y)).collect();
    place.file("p.csv", format!("x,y,z\n{rows}"));
    for command in ["dtm p.csv --cell", "interpolate p.csv --columns x,y,z --method linear --grid"] {
        place.succeed(&format!("-q {command} 0.5 --extent 1,2,4,6.2 -o a.asc"));
        let head = |name: &str| {
            let text = fs::read_to_string(place.path(name)).expect("text");
            text.lines()
                .take(5)
                .map(|line| line.split(' ').next_back().unwrap_or_default().to_owned())
                .collect()
        };
        let found: Vec<String> = head("a.asc");
        assert_eq!(found, ["6", "9", "1.0", "2.0", "0.5"], "{command}");
        place.succeed(&format!("-q {command} 0.5 --origin 0.25,-0.1 --extent 1,2,4,6.2 -o b.asc"));
        let found: Vec<String> = head("b.asc");
        assert_eq!(found, ["7", "9", "0.75", "1.9", "0.5"], "{command}");
    }
    // The cells of another raster, in tiles too.
    place.succeed(
        "-q dtm p.csv --cell 0.3 --origin 0.1,0.2 --extent -1,-1,5,4 --epsg 25832 -o like.tif -o a.npy",
    );
    for rest in ["", "--memory 64M --tile 60"] {
        place.succeed(&format!("-q dtm p.csv --like like.tif {rest} -o b.tif -o b.npy"));
        let [a, b] = ["like.tif", "b.tif"].map(|name| fs::read(place.path(name)).expect("a raster"));
        assert!(a == b, "{rest}");
    }
    place.succeed("-q interpolate p.csv --columns x,y,z --method linear --like like.tif -o c.tif");
    let [a, c] = ["like.tif", "c.tif"].map(|name| fs::read(place.path(name)).expect("a raster"));
    assert!(a == c);
    let told = "like.tif: its coordinates are EPSG:25832, those of p.csv EPSG:25833";
    place.fail("-q dtm p.csv --like like.tif --epsg 25833 -o b.tif", 1, told);
    for wrong in ["--like like.tif --cell 1", "--like like.tif --extent 0,0,1,1", "--cell 1 --extent 1,1,0,0"]
    {
        place.fail(&format!("-q dtm p.csv {wrong} -o b.tif"), 2, "--");
    }
    place.fail("-q dtm p.csv --like p.csv -o b.tif", 2, "rasters");
    place.fail(
        "-q dtm p.csv --cell 1 --memory 64M --max-edge 3 -o b.tif",
        2,
        "--max-edge needs all triangles",
    );
    place.fail("-q dtm p.csv --cell 1 --compress lzw -o b.npy", 2, "--compress is for GeoTIFF");
}

/// Hillshades, slopes and aspects of rasters, in the units that their system has.
#[test]
fn relief_has_units() {
    let place = Place::new();
    let heights: String = (0..4).map(|_| "0 2 4 6\n").collect();
    place.file("d.asc", format!("ncols 4\nnrows 4\nxllcorner 10\nyllcorner 45\ncellsize 2\n{heights}"));
    let middle = |line: &str| {
        place.succeed(&format!("-q relief d.asc {line} -o r.npy"));
        raster(&place, "r.npy").2[5]
    };
    assert!((middle("--kind slope") - 45.0).abs() < 1e-9);
    assert!((middle("--kind slope --z-factor 2") - 2f64.atan().to_degrees()).abs() < 1e-9);
    assert!((middle("--kind aspect") - 270.0).abs() < 1e-9);
    // Lit from the west at 45 degrees, straight on the slope.
    assert!((middle("--azimuth 270") - 255.0).abs() < 1e-9);
    assert!((middle("--azimuth 90") - 1.0).abs() < 1e-9);
    // Two degrees are 150 kilometres, which two metres do not make steep.
    assert!(middle("--kind slope --epsg 4326") < 0.001);
    assert_eq!(middle("--kind slope --epsg 2992"), middle("--kind slope"));
    place.succeed("-q relief d.asc --epsg 25832 -o r.tif -o r.png");
    assert_eq!(
        fs::read_to_string(place.path("r.pgw")).expect("a world file"),
        "2.0\n0.0\n0.0\n-2.0\n11.0\n52.0\n"
    );
    place.succeed("-q relief r.tif --kind slope -o s.tif -o s.asc --stats s.json");
    let stats = fs::read_to_string(place.path("s.json")).expect("statistics");
    let stats: serde_json::Value = serde_json::from_str(&stats).expect("JSON");
    assert_eq!((&stats["columns"], &stats["rows"], &stats["no_data"]), (&4.into(), &4.into(), &0.into()));
    assert!(stats["seconds"]["write"].as_f64().is_some_and(|seconds| seconds > 0.0));
    place.fail("-q relief r.tif -o s.tif --stats s.tif", 2, "s.tif");
    place.fail("-q relief d.asc --kind slope -o s.png", 2, "no format of this relief");
    place.fail("-q relief d.asc --z-factor 0 -o s.tif", 2, "--z-factor");
    place.file("p.csv", "0,0,1\n4,0,2\n4,4,1\n0,4,3\n");
    place.succeed("-q dtm p.csv --cell 1 --z-factor 2 --multidirectional -o a.png");
    assert!(place.path("a.pgw").exists());
}

/// One rule, and one default, for the height of a place with several points.
#[test]
fn duplicates_have_one_rule() {
    let place = Place::new();
    place.file("p.csv", "x,y,z\n0,0,1\n4,0,1\n4,4,1\n0,4,1\n2,2,7\n2,2,3\n2,2,8\n");
    place.file("q.csv", "2,2\n");
    for (rule, height) in [("", "3"), ("lowest", "3"), ("highest", "8"), ("mean", "6"), ("first", "7")] {
        let rule = if rule.is_empty() { String::new() } else { format!("--duplicates {rule}") };
        place.succeed(&format!(
            "-q interpolate p.csv --columns x,y,z {rule} --queries q.csv --method linear -o v.csv"
        ));
        let answers = fs::read_to_string(place.path("v.csv")).expect("text");
        assert_eq!(answers, format!("x,y,z\n2.0,2.0,{height}\n"), "{rule}");
        place.succeed(&format!("-q triangulate p.csv --columns x,y,z {rule} -o t.obj"));
        let text = fs::read_to_string(place.path("t.obj")).expect("text");
        let fifth = text.lines().filter(|line| line.starts_with("v ")).nth(4);
        assert_eq!(fifth, Some(format!("v 2.0 2.0 {height}.0").as_str()), "{rule}: {text}");
        // The same from hints; with weights the vertex is the heaviest, not the first, and the others keep what they have.
        for (more, vertex) in [("--hints p.csv", 4), ("--weights w.csv", 5)] {
            place.file("w.csv", "0\n0\n0\n0\n0\n1\n0\n");
            place.succeed(&format!("-q triangulate p.csv --columns x,y,z {rule} {more} -o t.obj"));
            let text = fs::read_to_string(place.path("t.obj")).expect("text");
            let found: Vec<&str> = text.lines().filter(|line| line.starts_with("v ")).skip(4).collect();
            let mut expected = ["7", "3", "8"];
            expected[vertex - 4] = height;
            assert_eq!(found, expected.map(|z| format!("v 2.0 2.0 {z}.0")), "{rule} {more}");
        }
    }
    place.file("s.csv", "0,0,0\n1,0,0\n0,1,0\n0,0,1\n");
    place.fail("triangulate s.csv --dim 3 --duplicates mean -o t.npy", 2, "--duplicates is for heights");
}

#[test]
fn other_bands_pages_and_masks_beside_are_told() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 50 --seed 1 -o p.csv");
    place.file("h.csv", "x,y,z\n0,0,1\n9,0,2\n0,9,3\n9,9,4\n");
    place.succeed("-q dtm h.csv --cell 1 -o one.tif");
    place.succeed("-q --strict triangulate one.tif -o one.ply");
    place.file("one.tif.msk", "a mask");
    place.fail(
        "-q --strict triangulate one.tif -o two.ply",
        1,
        "one.tif.msk: a mask beside the raster is not read",
    );
    place.fail("-q --strict relief one.tif -o two.tif", 1, "a mask beside the raster is not read");
    // Only the place of its cells is wanted.
    place.succeed("-q --strict dtm h.csv --like one.tif -o like.tif");
    // A pixel of three bands, uncompressed: a heading, a directory and its values.
    let mut tiff = b"II*\0\x08\0\0\0".to_vec();
    let entries: [(u16, u16, u32, u32); 10] = [
        (256, 3, 1, 1),
        (257, 3, 1, 1),
        (258, 3, 1, 8),
        (259, 3, 1, 1),
        (262, 3, 1, 1),
        (273, 4, 1, 134),
        (277, 3, 1, 3),
        (278, 3, 1, 1),
        (279, 4, 1, 3),
        (339, 3, 1, 1),
    ];
    tiff.extend(10_u16.to_le_bytes());
    for (tag, kind, count, value) in entries {
        tiff.extend(tag.to_le_bytes());
        tiff.extend(kind.to_le_bytes());
        tiff.extend(count.to_le_bytes());
        tiff.extend(value.to_le_bytes());
    }
    tiff.extend([0; 4]);
    tiff.extend([7, 8, 9]);
    place.file("three.tif", &tiff);
    let said = text(&place.run("triangulate three.tif -o three.ply").stderr);
    assert!(said.contains("note: three.tif: of 3 bands the first is read"), "{said}");
    place.fail("-q --strict triangulate three.tif -o t.ply", 1, "of 3 bands the first is read");
}

#[test]
fn systems_of_heights_are_not_lost_in_silence() {
    let place = Place::new();
    place.file("h.csv", "x,y,z\n0,0,1\n9,0,2\n0,9,3\n");
    let names = ["ply", "obj", "fgb", "wkb", "geojson"].map(|kind| format!("-o o.{kind}")).join(" ");
    let said = text(&place.run(&format!("triangulate h.csv --epsg 25832+7837 {names}")).stderr);
    assert!(
        said.contains("note: o.ply, o.obj, o.fgb, o.wkb: nothing in it says that its heights are EPSG:7837"),
        "{said}"
    );
    place.fail("-q --strict triangulate h.csv --epsg 25832+7837 -o s.ply", 1, "its heights are EPSG:7837");
    place.succeed("-q --strict triangulate h.csv --epsg 25832+7837 -o s.geojson");
    place.succeed("-q --strict triangulate h.csv --epsg 7415 -o s.ply");
}
