//! Outputs appear together or not at all, and what was there before survives whatever fails.

use std::fs;
use std::process::{Command, Stdio};

use crate::place::{Place, text};

/// Runs a line of a shell in the folder; `delone` is the program.
fn shell(place: &Place, line: &str) -> std::process::Output {
    let line = line.replace("delone", env!("CARGO_BIN_EXE_delone"));
    let mut shell = Command::new("sh");
    shell.current_dir(place.path("")).args(["-c", &line]).stdin(Stdio::null()).output().expect("a shell")
}

fn names(place: &Place) -> Vec<String> {
    let entries = fs::read_dir(place.path("")).expect("readable");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("there").file_name().into_string().expect("UTF-8")).collect();
    names.sort();
    names
}

#[test]
fn of_several_outputs_all_appear_or_none() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 5000 -o p.npy");
    place.file("old.off", "old");
    // Room for the first two, and not for the last one.
    let line =
        "ulimit -f 1000; delone -q triangulate p.npy -o new.node -o old.off -o m.geojson --stats s.json";
    let output = shell(&place, line);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    assert!(text(&output.stderr).starts_with("error: cannot write m.geojson"), "{}", text(&output.stderr));
    assert_eq!(names(&place), ["old.off", "p.npy"]);
    assert_eq!(place.read("old.off"), "old");
    place.succeed("-q triangulate p.npy -o new.node -o old.off -o m.geojson --stats s.json");
    assert_eq!(names(&place), ["m.geojson", "new.node", "old.off", "p.npy", "s.json"]);
    assert!(place.read("old.off").starts_with("OFF"));
}

#[test]
fn a_file_with_several_names_survives() {
    use std::os::unix::fs::MetadataExt;
    let place = Place::new();
    place.succeed("-q generate uniform -n 5000 -o p.npy");
    place.file("one.geojson", "old");
    fs::hard_link(place.path("one.geojson"), place.path("two.geojson")).expect("linked");
    let output = shell(&place, "ulimit -f 100; delone -q triangulate p.npy -o one.geojson");
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    assert_eq!((place.read("one.geojson"), place.read("two.geojson")), ("old".into(), "old".into()));
    place.succeed("-q triangulate p.npy -o one.geojson");
    assert!(place.read("two.geojson").starts_with('{'));
    assert_eq!(fs::metadata(place.path("two.geojson")).expect("there").nlink(), 2);
    assert_eq!(names(&place), ["one.geojson", "p.npy", "two.geojson"]);
}

/// A file that may be written in a folder that may not.
#[cfg(target_os = "linux")]
#[test]
fn a_file_in_a_folder_that_may_not_be_written_survives() {
    use std::os::unix::fs::PermissionsExt;
    let place = Place::new();
    place.succeed("-q generate uniform -n 5000 -o p.npy");
    fs::create_dir(place.path("closed")).expect("room");
    place.file("closed/one.geojson", "old");
    let allow = |name: &str, mode: u32| {
        fs::set_permissions(place.path(name), fs::Permissions::from_mode(mode)).expect("ours");
    };
    allow("closed/one.geojson", 0o666);
    allow("closed", 0o555);
    let output = place.run_as_other("ulimit -f 100", "-q triangulate p.npy -o closed/one.geojson");
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    assert_eq!(place.read("closed/one.geojson"), "old");
    let output = place.run_as_other("true", "-q triangulate p.npy -o closed/new.geojson");
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let output = place.run_as_other("true", "-q triangulate p.npy -o closed/one.geojson");
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(place.read("closed/one.geojson").starts_with('{'));
    assert_eq!(
        fs::metadata(place.path("closed/one.geojson")).expect("there").permissions().mode() & 0o777,
        0o666
    );
    allow("closed", 0o755);
    assert_eq!(fs::read_dir(place.path("closed")).expect("readable").count(), 1);
}

/// Leavings of a killed run go with the next run in that folder, and files of a run that still works stay.
#[test]
fn left_overs_of_killed_runs_go() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 200000 -o p.npy");
    let hidden = || names(&place).into_iter().filter(|name| name.starts_with(".delone-")).collect::<Vec<_>>();
    // Its half file is there for as long as it writes; before, there is one for a moment that shows whether it may.
    let has_half = || {
        let inside = |name: &String| fs::read_dir(place.path(name)).into_iter().flatten().flatten().count();
        hidden().len() == 1 && hidden().iter().map(inside).sum::<usize>() == 1
    };
    let was_killed = |_| {
        let mut child = Command::new(env!("CARGO_BIN_EXE_delone"))
            .current_dir(place.path(""))
            .args(["-q", "triangulate", "p.npy", "-o", "m.geojson", "-o", "n.geojson"])
            .spawn()
            .expect("the program starts");
        while !has_half() && child.try_wait().expect("asked").is_none() {
            std::thread::yield_now();
        }
        child.kill().expect("killed");
        child.wait().expect("ended");
        !hidden().is_empty()
    };
    assert!((0..50).any(was_killed), "a kill leaves something");
    assert!(!place.path("m.geojson").exists());
    fs::create_dir(place.path(".delone-held")).expect("made");
    let held = fs::File::open(place.path(".delone-held")).expect("there");
    held.try_lock().expect("free");
    place.succeed("-q generate uniform -n 10 -o q.npy");
    assert_eq!(hidden(), [".delone-held"]);
    drop(held);
    place.succeed("-q generate uniform -n 10 -o q.npy");
    assert_eq!(hidden(), [""; 0]);
}

#[test]
fn closed_standard_output_is_an_error() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 100 -o p.npy");
    for line in [
        "delone -q triangulate p.npy -o - --to off >&-",
        "delone -q generate uniform -n 10 -o - --to csv >&-",
        "delone info p.npy >&-",
        "delone version >&-",
        "delone --help >&-",
    ] {
        let output = shell(&place, line);
        let told = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{line}: {told}");
        assert!(told.starts_with("error: ") && told.lines().count() == 2, "{line}: {told}");
    }
    for line in [
        "delone -q triangulate p.npy -o m.npy >&-",
        "delone -q triangulate p.npy -o - --to off >/dev/null",
        "delone -q triangulate p.npy -o - --to off 1<>/dev/null",
        "delone -q triangulate p.npy -o /dev/null --to off",
    ] {
        assert!(shell(&place, line).status.success(), "{line}");
    }
}

/// A raster is not moved by what is left of another one.
#[test]
fn files_beside_an_earlier_raster_go() {
    let place = Place::new();
    let write = |name: &str, text: &str| fs::write(place.path(name), text).expect("a file");
    write("p.csv", "x,y,z\n0,0,1\n9,0,2\n0,9,3\n9,9,4\n");
    let sides = ["dem.tif.aux.xml", "dem.tif.ovr", "dem.asc.aux.xml", "dem.prj", "dem.png.aux.xml"];
    for command in
        ["dtm p.csv --cell 1 -o dem.tif -o dem.asc -o dem.png", "interpolate p.csv --grid 1 -o dem.tif"]
    {
        sides.iter().for_each(|side| write(side, "of another"));
        write("dem.txt", "mine");
        let told = text(&place.run(command).stderr);
        for side in sides {
            let of = side.rsplit_once('.').expect("two names").0;
            let goes = command.contains("-o dem.png") || of.starts_with("dem.tif");
            assert_eq!(place.path(side).exists(), !goes, "{command}: {side}");
            assert_eq!(told.contains(&format!("{side}: removed")), goes, "{told}");
        }
        assert!(place.path("dem.txt").exists());
    }
    // Work that failed leaves the earlier raster as it was.
    write("dem.tif.aux.xml", "of another");
    place.fail("dtm p.csv --cell 1 -o dem.tif --stats no/such/folder.json", 1, "folder");
    assert!(place.path("dem.tif.aux.xml").exists());
    // A shapefile of the same name keeps its system.
    write("dem.shp", "");
    write("dem.prj", "of the shapefile");
    let told = text(&place.run("dtm p.csv --cell 1 -o dem.asc").stderr);
    assert!(place.path("dem.prj").exists() && told.contains("dem.prj: it may not be that of"), "{told}");
}

#[test]
fn what_coordinates_mean_is_passed_on_or_told() {
    let place = Place::new();
    let write = |name: &str, text: &str| fs::write(place.path(name), text).expect("a file");
    let points = |system: &str| {
        format!(
            "{{\"type\":\"MultiPoint\",\"crs\":{{\"type\":\"name\",\"properties\":{{\"name\":\"{system}\"}}}},\"coordinates\":[[0,0],[1,0],[0,1]]}}"
        )
    };
    write("utm.geojson", &points("urn:ogc:def:crs:EPSG::25832"));
    write("own.geojson", &points("ours"));
    write("plain.csv", "0,0\n1,0\n0,1\n");
    let told = |line: &str| text(&place.run(line).stderr);
    let line = "triangulate utm.geojson -o a.geojson -o a.wkb -o a.ply -o a.npy -o a.png";
    assert_eq!(told(line).lines().count(), 1, "{}", told(line));
    let line = told("triangulate utm.geojson -o a.vtu -o a.npy -o a.stl");
    assert!(line.contains("a.vtu, a.stl: nothing in it says that its coordinates are EPSG:25832"), "{line}");
    let line = told("voronoi own.geojson -o a.geojson -o a.wkb");
    assert!(
        line.contains("a.wkb: nothing in it says") && line.contains("warning: a.geojson: readers will take"),
        "{line}"
    );
    assert_eq!(told("triangulate plain.csv -o a.vtu").lines().count(), 1);
    assert_eq!(told("-q voronoi own.geojson -o a.geojson"), "");
}

/// Files beside a raster say what it does not, as GDAL sees them.
#[test]
fn files_beside_a_raster_are_read() {
    let place = Place::new();
    let write = |name: &str, text: &str| fs::write(place.path(name), text).expect("a file");
    write("p.csv", "x,y,z\n0,0,1\n9,0,2\n0,9,3\n9,9,4\n");
    place.succeed("-q dtm p.csv --cell 1 -o dem.asc -o dem.tif");
    let system = |name: &str| {
        place.succeed(&format!("-q contours {name} --interval 1 -o c.geojson"));
        let map = fs::read_to_string(place.path("c.geojson")).expect("contours");
        map.lines()
            .next()
            .and_then(|line| line.split("crs:").nth(1))
            .map(|rest| rest.split('"').next().map(str::to_owned))
    };
    let epsg = |number: u32| Some(Some(format!("EPSG::{number}")));
    assert_eq!([system("dem.asc"), system("dem.tif")], [None, None]);
    write("dem.prj", "PROJCS[\"ETRS_1989_UTM_Zone_32N\",GEOGCS[\"GCS_ETRS_1989\"]]");
    write(
        "dem.tif.aux.xml",
        "<PAMDataset><SRS dataAxisToSRSAxisMapping=\"1,2\">EPSG:25833</SRS></PAMDataset>",
    );
    assert_eq!([system("dem.asc"), system("dem.tif")], [epsg(25832), epsg(25833)]);
    // That of the file goes before the other one's.
    place.succeed("-q --epsg 31467 dtm p.csv --cell 1 -o other.tif");
    assert_eq!(system("other.tif"), epsg(31467));
    write("other.tif.aux.xml", "<PAMDataset><SRS>EPSG:25833</SRS></PAMDataset>");
    assert_eq!(system("other.tif"), epsg(25833));
    // What is not understood or not read is told.
    let told = |name: &str| text(&place.run(&format!("contours {name} --interval 1 -o c.geojson")).stderr);
    let place_and_nodata = "<GeoTransform>0,1,0,0,0,-1</GeoTransform><PAMRasterBand band=\"1\"><NoDataValue>3</NoDataValue></PAMRasterBand>";
    write("dem.tif.aux.xml", &format!("<PAMDataset>{place_and_nodata}</PAMDataset>"));
    for what in ["the place of the raster is not read", "the number for no data is not read"] {
        assert!(told("dem.tif").contains(&format!("dem.tif.aux.xml: {what}")), "{}", told("dem.tif"));
    }
    write("dem.tif.aux.xml", &" ".repeat(17 << 20));
    assert!(told("dem.tif").contains("dem.tif.aux.xml: it is not read, because it is longer"));
    // A world file is for rasters that do not say where they are.
    write("far.csv", "x,y,z\n90,0,1\n99,0,2\n90,9,3\n99,9,4\n");
    place.succeed("-q dtm far.csv --cell 1 -o far.tif");
    write("far.tfw", "10\n0\n0\n-10\n5\n-5\n");
    assert!(!told("far.tif").contains("far.tfw"), "{}", told("far.tif"));
    let mut bytes = fs::read(place.path("far.tif")).expect("a raster");
    let scale = bytes.windows(4).position(|word| word == [0x0e, 0x83, 12, 0]).expect("the tag of the scale");
    bytes[scale] += 1;
    fs::write(place.path("far.tif"), bytes).expect("a file");
    assert!(told("far.tif").contains("far.tfw: the place of the raster is not read"), "{}", told("far.tif"));
    write("dem.prj", "Projection UTM\nZone 32\n");
    write("dem.tif.aux.xml", "<PAMDataset><SRS>");
    for (name, what) in [("dem.asc", "dem.prj: its system"), ("dem.tif", "dem.tif.aux.xml: XML")] {
        let told = text(&place.run(&format!("contours {name} --interval 1 -o c.geojson")).stderr);
        assert!(told.contains(what), "{told}");
        place.fail(&format!("-q --strict contours {name} --interval 1 -o c.geojson"), 1, what);
    }
}

#[test]
fn polygons_are_needed_where_they_are_asked_for() {
    let place = Place::new();
    place.file("p.csv", "0,0\n1,0\n0,1\n");
    place.file("l.wkt", "LINESTRING (0 0, 1 0, 0 1, 0 0)\n");
    for name in ["p.csv", "l.wkt"] {
        place.fail(&format!("polygons {name} -o t.npy"), 1, &format!("{name}: there is no polygon in it"));
    }
    let drawing = "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n70\n1\n10\n0\n20\n0\n10\n4\n20\n0\n10\n0\n20\n3\n0\nENDSEC\n0\nEOF\n";
    place.file("d.dxf", drawing);
    place.succeed("polygons d.dxf -o t.wkt");
    assert_eq!(fs::read_to_string(place.path("t.wkt")).expect("a triangle").matches("((").count(), 1);
}
