//! Terrain as a user meets it: rasters that follow the contract, the same in memory and in tiles, lines and borders; and every refusal.

use std::fs;

use delone::Delaunay2;
use delone::surface::Interpolator;
use delone_generators::{Kind, Random};

use crate::place::{Place, data, text};

/// The shape and the values of an array of f64.
fn array(bytes: &[u8]) -> (Vec<usize>, Vec<f64>) {
    let start = 10 + (usize::from(bytes[8]) | usize::from(bytes[9]) << 8);
    let header = text(&bytes[10..start]);
    assert!(header.contains("'<f8'"), "{header}");
    let shape = header.split('(').nth(1).and_then(|rest| rest.split(')').next()).expect("a shape");
    let shape = shape.split(',').filter_map(|n| n.trim().parse().ok()).collect();
    let values =
        bytes[start..].chunks_exact(8).map(|c| f64::from_le_bytes(c.try_into().expect("8"))).collect();
    (shape, values)
}

pub(crate) fn raster(place: &Place, name: &str) -> (usize, usize, Vec<f64>) {
    let (shape, values) = array(&fs::read(place.path(name)).expect("a raster"));
    (shape[0], shape[1], values)
}

/// Points as text, with heights that are a function of where they are, and some of their own.
fn with_heights(points: &[[f64; 2]], random: &mut Random) -> String {
    points.iter().map(|[x, y]| format!("{x:?},{y:?},{:?}\n", random.between(-5.0, 5.0))).collect()
}

#[test]
fn cells_are_where_the_contract_says() {
    let place = Place::new();
    let points = [[0.3, 10.2], [7.9, 10.4], [8.4, 17.6], [0.4, 16.9], [4.0, 13.0]];
    let rows: String = points.iter().map(|[x, y]| format!("{x},{y},{}\n", 3.0 * x - y)).collect();
    place.file("p.csv", &rows);
    place.succeed("-q dtm p.csv --cell 0.5 -o dem.npy");
    let (rows, columns, values) = raster(&place, "dem.npy");
    let [west, north] = [(0.3f64 / 0.5).floor() * 0.5, (17.6f64 / 0.5).ceil() * 0.5];
    assert_eq!(columns, (8.4f64 / 0.5).ceil() as usize - (0.3f64 / 0.5).floor() as usize);
    assert_eq!(rows, (17.6f64 / 0.5).ceil() as usize - (10.2f64 / 0.5).floor() as usize);
    let d = Delaunay2::from_points(&points).expect("finite");
    let mut known = 0;
    for (k, value) in values.iter().enumerate() {
        let q = [west + (0.5 + (k % columns) as f64) * 0.5, north - (0.5 + (k / columns) as f64) * 0.5];
        let inside = !matches!(d.locate(q), Ok(delone::Location2::Outside(_)));
        assert_eq!(value.is_nan(), !inside, "{q:?}");
        if inside {
            known += 1;
            assert!((value - (3.0 * q[0] - q[1])).abs() < 1e-12, "{q:?}: {value}");
        }
    }
    assert!(known > 150);
}

/// Bit for bit, whatever the tiles, and those of the library.
#[test]
fn tiles_do_not_show() {
    let place = Place::new();
    let mut random = Random::new(5);
    let kinds = [Kind::Uniform, Kind::Grid, Kind::Clusters, Kind::Circle, Kind::Duplicates, Kind::Utm];
    for (k, kind) in kinds.into_iter().enumerate() {
        let points = kind.points(600, k as u64);
        place.file("p.csv", with_heights(&points, &mut random));
        let bounds = delone::Bounds::of(points.iter().copied());
        let cell = (bounds.high[0] - bounds.low[0]).max(bounds.high[1] - bounds.low[1]) / 37.0;
        for (m, method) in ["linear", "natural", "laplace", "nearest"].into_iter().enumerate() {
            let rule = ["lowest", "first", "highest", "mean"][(k + m) % 4];
            let long = if m % 2 == 0 { String::new() } else { format!("--max-edge-anywhere {}", 9.0 * cell) };
            let common = format!("-q dtm p.csv --cell {cell} --method {method} --duplicates {rule} {long}");
            place.succeed(&format!("{common} -o a.npy -o a.asc"));
            for tile in [40, 150, 1000] {
                place.succeed(&format!("{common} --memory 64M --tile {tile} -o b.npy -o b.asc"));
                let [a, b] = ["a.npy", "b.npy"].map(|name| fs::read(place.path(name)).expect("a raster"));
                assert!(a == b, "{} {method} {tile}", kind.name());
                assert_eq!(
                    fs::read(place.path("a.asc")).expect("text"),
                    fs::read(place.path("b.asc")).expect("text")
                );
            }
        }
        let left: Vec<String> = fs::read_dir(place.path("."))
            .expect("a folder")
            .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
            .filter(|name| name.starts_with(".delone"))
            .collect();
        assert!(left.is_empty(), "{left:?}");
    }
}

#[test]
fn duplicates_go_by_rule() {
    let place = Place::new();
    place.file("p.csv", "0,0,1\n4,0,1\n4,4,1\n0,4,1\n2.5,2.5,9\n2.5,2.5,3\n2.5,2.5,6\n");
    for (rule, height) in [("lowest", 3.0), ("first", 9.0), ("highest", 9.0), ("mean", 6.0)] {
        place.succeed(&format!("-q dtm p.csv --cell 1 --duplicates {rule} -o a.npy"));
        let (_, columns, values) = raster(&place, "a.npy");
        assert_eq!(values[columns + 2], height, "{rule}");
    }
}

/// Also where a tile has more points at one place than it may have; and a mean does not depend on the order.
#[test]
fn many_duplicates_go_by_rule_in_tiles() {
    let place = Place::new();
    let mut random = Random::new(7);
    let mut rows: Vec<String> = ["0,0", "4,0", "4,4", "0,4"].map(|corner| format!("{corner},1")).to_vec();
    rows.extend((0..60).map(|_| format!("2.5,2.5,{:?}", random.between(-100.0, 100.0))));
    place.file("p.csv", rows.join("\n"));
    rows.reverse();
    place.file("q.csv", rows.join("\n"));
    for rule in ["lowest", "first", "highest", "mean"] {
        let common = format!("--cell 1 --duplicates {rule}");
        place.succeed(&format!("-q dtm p.csv {common} -o a.npy"));
        place.succeed(&format!("-q dtm p.csv {common} --memory 64M --tile 5 -o b.npy"));
        assert!(
            fs::read(place.path("a.npy")).expect("a") == fs::read(place.path("b.npy")).expect("b"),
            "{rule}"
        );
        place.succeed(&format!("-q dtm q.csv {common} -o b.npy"));
        let is_same = fs::read(place.path("a.npy")).expect("a") == fs::read(place.path("b.npy")).expect("b");
        assert_eq!(is_same, rule != "first", "{rule}");
    }
}

/// Of a place on the hull the nearest point may be further away than all points are high.
#[test]
fn the_hull_of_few_points_has_nearest_values_in_tiles() {
    let place = Place::new();
    place.file("p.csv", "-2,2,1\n-5,0,2\n2,-2,3\n4,-3,4\n5,0,5\n");
    for tile in [1, 200] {
        place.succeed("-q dtm p.csv --cell 0.25 --method nearest -o a.npy");
        place.succeed(&format!(
            "-q dtm p.csv --cell 0.25 --method nearest --memory 64M --tile {tile} -o b.npy"
        ));
        assert!(
            fs::read(place.path("a.npy")).expect("a") == fs::read(place.path("b.npy")).expect("b"),
            "{tile}"
        );
    }
}

#[test]
fn the_shipped_scan() {
    let place = Place::new();
    let scan = data("autzen_trim.laz");
    let scan = scan.display();
    place.succeed(&format!("-q dtm {scan} --cell 10 -o a.tif -o a.npy -o shade.png --stats s.json"));
    let (rows, columns, values) = raster(&place, "a.npy");
    assert_eq!(rows * columns, values.len());
    assert!(values.iter().filter(|z| z.is_finite()).all(|z| (400.0..500.0).contains(z)));
    let stats: serde_json::Value =
        serde_json::from_slice(&fs::read(place.path("s.json")).expect("statistics")).expect("JSON");
    assert_eq!(stats["points"], 26107);
    assert_eq!(stats["cells"], (rows * columns) as f64);
    assert!(fs::read(place.path("shade.png")).expect("a picture").starts_with(b"\x89PNG"));
    place.succeed(&format!("-q dtm {scan} --cell 10 -o c.geojson --interval 5"));
    let lines: serde_json::Value =
        serde_json::from_slice(&fs::read(place.path("c.geojson")).expect("contours")).expect("JSON");
    let lines = lines["features"].as_array().expect("features");
    assert!(lines.len() > 5);
    assert!(
        lines.iter().all(|line| line["properties"]["elevation"].as_f64().is_some_and(|z| z % 5.0 == 0.0))
    );
    place.succeed(&format!("-q dtm {scan} --cell 10 -o b.npy --memory 64M --tile 3000"));
    assert!(fs::read(place.path("a.npy")).expect("a") == fs::read(place.path("b.npy")).expect("b"));
    // A folder of scans, all classes.
    fs::create_dir(place.path("scans")).expect("made");
    fs::copy(data("autzen_trim.laz"), place.path("scans/one.laz")).expect("copied");
    place.succeed("-q dtm scans --cell 10 --all-classes -o c.npy --stats s.json");
    let stats: serde_json::Value =
        serde_json::from_slice(&fs::read(place.path("s.json")).expect("statistics")).expect("JSON");
    assert_eq!(stats["points"], 110_000);
    // A second one that ends too early: nothing is written.
    let bytes = fs::read(data("autzen_trim.laz")).expect("readable");
    fs::write(place.path("scans/two.laz"), &bytes[..bytes.len() / 2]).expect("written");
    for memory in ["", "--memory 64M"] {
        place.fail(&format!("-q dtm scans --cell 10 {memory} -o d.npy"), 1, "two.laz");
        assert!(!place.path("d.npy").exists());
    }
}

#[test]
fn lines_and_polygons() {
    let place = Place::new();
    // A plain at height 0, with a wall of height 5 across it.
    let plain: String = (0..121).map(|i| format!("{},{},0\n", i % 11, i / 11)).collect();
    place.file("p.csv", &plain);
    place.file("wall.geojson", r#"{"type":"LineString","coordinates":[[0.5,5.25,5],[9.5,5.25,5]]}"#);
    for method in ["linear", "natural", "laplace", "smooth", "farin"] {
        place.succeed(&format!(
            "-q dtm p.csv --cell 0.5 --method {method} --breaklines wall.geojson -o a.npy"
        ));
        let (_, columns, values) = raster(&place, "a.npy");
        // The row of centers along the wall.
        let along: Vec<f64> = values[9 * columns..10 * columns].to_vec();
        assert!(
            along[2..18].iter().all(|z| (z - 5.0).abs() < if method == "linear" { 1e-9 } else { 0.6 }),
            "{method}: {along:?}"
        );
        assert!(method != "linear" || values[..8 * columns].iter().all(|z| z.abs() < 1e-9));
    }
    // Soft lines change nothing of a plane.
    place.file("soft.geojson", r#"{"type":"LineString","coordinates":[[0.5,5.25],[9.5,3.25]]}"#);
    place.succeed("-q dtm p.csv --cell 0.5 --breaklines soft.geojson -o a.npy");
    assert!(raster(&place, "a.npy").2.iter().all(|z| *z == 0.0));
    // A lake in a slope lies at the lowest of its border.
    let slope: String = (0..121).map(|i| format!("{},{},{}\n", i % 11, i / 11, i % 11)).collect();
    place.file("p.csv", &slope);
    let ring = "[[3,3],[7,3],[7,7],[3,7],[3,3]]";
    place.file("lake.geojson", format!(r#"{{"type":"Polygon","coordinates":[{ring}]}}"#));
    for method in ["linear", "natural"] {
        place.succeed(&format!("-q dtm p.csv --cell 1 --method {method} --flat lake.geojson -o a.npy"));
        let (_, columns, values) = raster(&place, "a.npy");
        for row in 3..7 {
            assert_eq!(values[row * columns + 3..row * columns + 7], [3.0; 4], "{method}");
        }
        assert!((values[5 * columns + 9] - 9.5).abs() < 1e-9);
    }
    // Nothing outside of an area.
    place.succeed("-q dtm p.csv --cell 1 --clip lake.geojson -o a.npy");
    assert_eq!(raster(&place, "a.npy").2.iter().filter(|z| !z.is_nan()).count(), 16);
    // Lines that cross at other heights are told.
    place.file(
        "cross.geojson",
        r#"{"type":"MultiLineString","coordinates":[[[1.3,1.1,0],[8.9,9.2,0]],[[1.2,9.1,4],[9.3,1.4,4]]]}"#,
    );
    let told = text(&place.run("dtm p.csv --cell 1 --breaklines cross.geojson -o a.npy").stderr);
    assert!(told.contains("differ by up to 4"), "{told}");
    // Without long triangles at the border, or anywhere.
    place.file("p.csv", format!("{slope}60,5,0\n"));
    for option in ["--carve 2", "--max-edge 2", "--max-edge-anywhere 2"] {
        place.succeed(&format!("-q dtm p.csv --cell 1 {option} -o a.npy"));
        assert_eq!(raster(&place, "a.npy").2.iter().filter(|z| !z.is_nan()).count(), 100, "{option}");
    }
}

/// Files whose coordinates or heights are of different systems are not one surface.
#[test]
fn systems_are_not_mixed() {
    let place = Place::new();
    let scan = |name: &str, keys: &[[u16; 2]]| {
        let mut head = vec![0_u8; 227];
        head[..4].copy_from_slice(b"LASF");
        head[24..26].copy_from_slice(&[1, 2]);
        let vlr = 54 + 8 * (1 + keys.len()) as u32;
        head[94..96].copy_from_slice(&227_u16.to_le_bytes());
        head[96..100].copy_from_slice(&(227 + vlr).to_le_bytes());
        head[100..104].copy_from_slice(&1_u32.to_le_bytes());
        head[105..107].copy_from_slice(&20_u16.to_le_bytes());
        head[107..111].copy_from_slice(&3_u32.to_le_bytes());
        (0..3).for_each(|k| head[131 + 8 * k..139 + 8 * k].copy_from_slice(&1.0_f64.to_le_bytes()));
        let mut user = [0_u8; 54];
        user[2..17].copy_from_slice(b"LASF_Projection");
        user[18..20].copy_from_slice(&34735_u16.to_le_bytes());
        user[20..22].copy_from_slice(&((vlr - 54) as u16).to_le_bytes());
        head.extend(user);
        let words = [1, 1, 0, keys.len() as u16].into_iter();
        let words = words.chain(keys.iter().flat_map(|&[key, value]| [key, 0, 1, value]));
        head.extend(words.flat_map(u16::to_le_bytes));
        for p in [[0, 0, 1], [9, 0, 2], [0, 9, 3]] {
            head.extend(p.into_iter().flat_map(i32::to_le_bytes));
            head.extend([0, 0, 0, 2, 0, 0, 0, 0]);
        }
        place.file(name, head);
    };
    scan("a.las", &[[1024, 1], [3072, 25832], [4096, 5783]]);
    scan("b.las", &[[1024, 1], [3072, 25833], [4096, 5783]]);
    scan("c.las", &[[1024, 1], [3072, 25832], [4096, 7837]]);
    place.succeed("-q dtm a.las --cell 1 -o a.npy");
    for memory in ["", "--memory 64M"] {
        place.fail(
            &format!("-q dtm a.las b.las --cell 1 {memory} -o x.npy"),
            1,
            "its coordinates are EPSG:25833",
        );
        place.fail(&format!("-q dtm a.las c.las --cell 1 {memory} -o x.npy"), 1, "its heights are EPSG:7837");
    }
}

/// Polygons may overlap, touch and be given twice: each is level, and the lowest counts where there are several.
#[test]
fn polygons_share_places() {
    let place = Place::new();
    let slope: String = (0..121).map(|i| format!("{},{},{}\n", i % 11, i / 11, i % 11)).collect();
    place.file("p.csv", &slope);
    let square = |west: f64, south: f64, east: f64, z: f64| {
        let north = south + 4.0;
        format!(
            "[[[{west},{south},{z}],[{east},{south},{z}],[{east},{north},{z}],[{west},{north},{z}],[{west},{south},{z}]]]"
        )
    };
    let file = |polygons: &[String]| {
        place.file(
            "f.geojson",
            format!(r#"{{"type":"MultiPolygon","coordinates":[{}]}}"#, polygons.join(",")),
        );
    };
    let over = [square(1.0, 1.0, 5.0, 20.0), square(3.0, 3.0, 9.0, 30.0)];
    let beside = [square(1.0, 3.0, 4.0, 50.0), square(4.0, 3.0, 9.0, 30.0)];
    let turned = [beside[1].clone(), beside[0].clone()];
    let twice = [over[0].clone(), over[0].clone()];
    for method in ["linear", "natural"] {
        let heights = |polygons: &[String], option: &str| {
            file(polygons);
            place.succeed(&format!("-q dtm p.csv --cell 1 --method {method} {option} f.geojson -o a.npy"));
            let (_, columns, values) = raster(&place, "a.npy");
            move |x: usize, y: usize| values[(9 - y) * columns + x]
        };
        let at = heights(&over, "--flat");
        for (x, y) in (1..9).flat_map(|x| (1..7).map(move |y| (x, y))) {
            let is_in = [x < 5 && y < 5, x >= 3 && y >= 3];
            if is_in[0] || is_in[1] {
                assert_eq!(at(x, y), if is_in[0] { 20.0 } else { 30.0 }, "{method} {x} {y}");
            }
        }
        let at = heights(&twice, "--flat");
        assert!((1..5).all(|k| at(k, k) == 20.0), "{method}");
        for polygons in [&beside, &turned] {
            let at = heights(polygons, "--flat");
            assert!((1..9).all(|x| at(x, 4) == if x < 4 { 50.0 } else { 30.0 }), "{method}");
        }
        let at = heights(&over, "--clip");
        let count = (0..100).filter(|k| !at(k % 10, k / 10).is_nan()).count();
        assert_eq!(count, 16 + 24 - 4, "{method}");
    }
    let crs = r#""crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25832"}}"#;
    place.file("f.geojson", format!(r#"{{"type":"Polygon",{crs},"coordinates":{}}}"#, over[0]));
    for memory in ["", "--memory 64M"] {
        place.fail(
            &format!("-q dtm p.csv --epsg 4326 --cell 1 --clip f.geojson {memory} -o c.npy"),
            1,
            "EPSG:25832",
        );
    }
    place.file("line.geojson", r#"{"type":"LineString","coordinates":[[1,1],[3,3]]}"#);
    place.fail("-q dtm p.csv --cell 1 --clip line.geojson -o c.npy", 1, "no polygon");
    // The points of a graph of Triangle are a ring.
    fs::write(place.path("ring.poly"), "3 2 0 0\n1 0 0\n2 9 0\n3 0 9\n1 0\n1 1 2\n0\n").expect("a file");
    place.succeed("-q dtm p.csv --cell 1 --clip ring.poly -o c.npy");
}

/// Lines that run along each other, in pieces of their own, or nearly do.
#[test]
fn lines_along_each_other_come_to_an_end() {
    let place = Place::new();
    let slope: String = (0..121).map(|i| format!("{},{},{}\n", i % 11, i / 11, i % 11)).collect();
    place.file("p.csv", &slope);
    for ring in
        ["[3,4,1],[9,10,1],[7,8,1],[2,6,1],[3,4,1]", "[4,4,1],[6,2,1],[3,5,1],[4,2,1],[1,3,1],[4,4,1]"]
    {
        place.file("f.geojson", format!(r#"{{"type":"Polygon","coordinates":[[{ring}]]}}"#));
        place.file(
            "b.geojson",
            r#"{"type":"MultiLineString","coordinates":[[[1,0],[8,9]],[[1.7,0.9],[8,9]],[[1,3],[9,4]],[[1,3],[5,3.5000000000000004]]]}"#,
        );
        for method in ["natural", "smooth"] {
            let told = place.run(&format!(
                "dtm p.csv --cell 1 --method {method} --flat f.geojson --breaklines b.geojson -o a.npy"
            ));
            assert!(told.status.success(), "{}", text(&told.stderr));
        }
    }
}

#[test]
fn a_height_that_stands_for_nothing_is_told() {
    let place = Place::new();
    place.file("p.csv", "0,0,7\n4,0,7\n4,4,7\n0,4,7\n");
    let told = text(&place.run("dtm p.csv --cell 1 --nodata 7 -o a.tif").stderr);
    assert!(told.contains("16 cells have the height 7"), "{told}");
    assert!(!text(&place.run("dtm p.csv --cell 1 -o a.asc").stderr).contains("stands for"));
}

#[cfg(unix)]
#[test]
fn a_signal_leaves_no_tiles() {
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};

    let place = Place::new();
    let mut random = Random::new(3);
    place.file("p.csv", with_heights(&Kind::Uniform.points(100_000, 1), &mut random));
    fs::create_dir(place.path("out")).expect("made");
    let mut child = Command::new(env!("CARGO_BIN_EXE_delone"))
        .current_dir(place.path("out"))
        .args(["-q", "dtm", "../p.csv", "--cell", "0.001", "--memory", "64M", "--tile", "500", "-o", "a.npy"])
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let started = Instant::now();
    let names = || fs::read_dir(place.path("out")).expect("readable").count();
    while names() == 0 && started.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(2));
    }
    let kill = Command::new("kill").args(["-TERM", &child.id().to_string()]).status();
    assert!(kill.expect("kill").success());
    assert!(!child.wait().expect("it ends").success());
    assert_eq!(names(), 0);
}

#[test]
fn refusals() {
    let place = Place::new();
    place.file("p.csv", "0,0,1\n4,0,1\n4,4,1\n0,4,1\n");
    place.file("flat.csv", "0,0\n4,0\n4,4\n");
    place.file("line.csv", "0,0,1\n1,1,1\n2,2,1\n");
    place.file("one.csv", "1,1,1\n1,1,2\n");
    place.file("nan.csv", "0,0,1\n4,0,nan\n4,4,1\n");
    place.file("none.csv", "x,y,z\n");
    place.file("line.geojson", r#"{"type":"LineString","coordinates":[[1,1],[3,3]]}"#);
    for (status, arguments, part) in [
        (1, "p.csv --cell 1e-6 -o a.npy", "cells of 0.000001"),
        (2, "p.csv --cell 0 -o a.npy", "--cell 0"),
        (2, "p.csv --cell nan -o a.npy", "positive"),
        (2, "p.csv --cell 1 -o a.ply", "no format of terrain"),
        (2, "p.csv --cell 1 -o p.csv --to npy", "overwrite"),
        (1, "flat.csv --cell 1 -o a.npy", "heights"),
        (1, "line.csv --cell 1 -o a.npy", "on one line"),
        (1, "one.csv --cell 1 -o a.npy", "on one line"),
        (1, "nan.csv --cell 1 -o a.npy", "point 1"),
        (1, "none.csv --cell 1 -o a.npy", "there are no points"),
        (1, "missing.csv --cell 1 -o a.npy", "missing.csv"),
        (2, "p.csv --cell 1 --memory 1M -o a.npy", "least"),
        (2, "p.csv --cell 1 --memory 1G --breaklines line.geojson -o a.npy", "--memory"),
        (2, "p.csv --cell 1 --memory 1G --method farin -o a.npy", "--memory"),
        (1, "p.csv --cell 1 --flat line.geojson -o a.npy", "no polygon"),
        (1, "p.csv --cell 1 --breaklines p.csv -o a.npy", "no line"),
        (2, "p.csv --cell 1 --class ground -o a.npy", "--class"),
    ] {
        for memory in ["", " --memory 64M"] {
            // Not all are for tiles.
            let is_plain = !arguments.contains("line.geojson") && !arguments.contains("--memory");
            if !memory.is_empty() && (!is_plain || arguments.contains("--breaklines")) {
                continue;
            }
            place.fail(&format!("-q dtm {arguments}{memory}"), status, part);
        }
    }
    // One row is more than the memory that is allowed.
    place.file("long.csv", "0,0,1\n1e9,0,1\n1e9,1,1\n");
    place.fail("-q dtm long.csv --cell 1 --memory 64M -o a.npy", 1, "a row of 1000000000 cells");
    let scan = data("autzen_trim.laz");
    let line = format!("-q dtm {} --cell 10 --class water -o a.npy", scan.display());
    place.fail(&line, 1, "no points of class water");
}

#[test]
fn values_are_interpolated() {
    let place = Place::new();
    let points = Kind::Uniform.points(300, 1);
    let text: String =
        points.iter().map(|[x, y]| format!("{x:?},{y:?},{:?},{:?}\n", x + 2.0 * y, 5.0)).collect();
    place.file("p.csv", format!("x,y,a,b\n{text}"));
    let asked = Kind::Uniform.points(50, 2);
    place.file("q.csv", asked.iter().map(|[x, y]| format!("{x:?},{y:?}\n")).collect::<String>());
    let d = Delaunay2::from_points(&points).expect("finite");
    let table: Vec<f64> = points.iter().map(|[x, y]| x + 2.0 * y).collect();
    for method in ["linear", "natural", "laplace", "smooth", "farin", "nearest"] {
        place.succeed(&format!(
            "-q interpolate p.csv --value a --value b --queries q.csv --method {method} -o v.npy"
        ));
        let (shape, values) = array(&fs::read(place.path("v.npy")).expect("values"));
        assert_eq!(shape, [50, 2]);
        for (row, q) in values.chunks(2).zip(&asked) {
            let linear = Interpolator::linear(&d).value(*q, &table).expect("finite");
            assert_eq!(row[0].is_nan(), linear.is_none());
            if linear.is_some() {
                assert!((row[0] - (q[0] + 2.0 * q[1])).abs() < 1e-9 || method == "nearest", "{method}");
                assert!((row[1] - 5.0).abs() < 1e-12);
            }
        }
    }
    place.succeed("-q interpolate p.csv --value a --grid 0.1 -o g.tif");
    place.succeed("-q interpolate p.csv --value a --grid 0.1 --outside nearest -o g.npy");
    assert!(raster(&place, "g.npy").2.iter().all(|z| z.is_finite()));
    place.succeed("-q interpolate p.csv --value a --queries q.csv -o v.csv");
    assert_eq!(fs::read_to_string(place.path("v.csv")).expect("text").lines().count(), 51);
    place.file("nan.csv", "x,y,a\n0,0,1\n4,0,nan\n4,4,inf\n");
    for (status, arguments, part) in [
        (1, "nan.csv --value a --queries q.csv -o v.npy", "the value of point 1 is NaN"),
        (2, "p.csv --queries q.csv -o v.npy", "nothing to interpolate"),
        (1, "p.csv --value c --queries q.csv -o v.npy", "c"),
        (2, "p.csv --value a --queries q.csv -o v.tif", "answers to queries are not written to tif files"),
        (2, "p.csv --value a --value b --grid 1 -o v.tif", "one value"),
        (2, "p.csv --value a -o v.npy", "--queries"),
    ] {
        place.fail(&format!("-q interpolate {arguments}"), status, part);
    }
}
