//! Files as they are found: hostile, half-known, special, and written by others.

use std::fs;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::place::{Place, data, text};

/// The number of points that `info` counts.
fn points(place: &Place, line: &str) -> usize {
    let answer = place.succeed(&format!("-q info {line}"));
    let count = answer.lines().find_map(|line| line.strip_prefix("points ")).expect("a count");
    count.trim().parse().expect("a number")
}

#[test]
fn hostile_files_end_in_errors_or_points() {
    let place = Place::new();
    for (name, message) in [
        ("f_3000000_0_3000007.laz", "ends inside"),
        ("f_3000000_1_3000051.laz", ""),
        ("f_3000000_2_3000064.las", "ends inside extended record 0"),
        ("f_3000000_3_3000152.las", "ends inside extended record 0"),
        ("f_3000000_4_3000206.laz", "ends inside extended record 0"),
        ("f_3000000_5_3002539.laz", "its compressed fields are not those of its points"),
        ("hang_before40.ply", "have no properties"),
        ("hdrlen.npy", "ends inside the array's header"),
        ("xlist.ply", "x is a list, not a number"),
    ] {
        let path = data("hostile").join(name);
        place.fail(&format!("triangulate {} -o m.npy", path.display()), 1, message);
    }
    let bounds = |name: &str| {
        let answer = place.succeed(&format!("-q info {}", data("hostile").join(name).display()));
        answer.lines().filter(|line| line.starts_with("x ")).collect::<String>()
    };
    for name in ["xchar.ply", "xuchar.ply", "xuint8.ply"] {
        assert!(!bounds(name).contains("0.0 to 0.0"), "{name}: {}", bounds(name));
    }
    assert!(points(&place, &data("hostile/cr.csv").display().to_string()) > 0);
    let named = place.succeed(&format!("-q info {}", data("hostile/X_Y.csv").display()));
    assert!(named.contains("z                      1.0 to 3.0"), "{named}");
}

#[test]
fn columns_are_told() {
    let place = Place::new();
    for (name, content, remark) in [
        (
            "fid.csv",
            "fid,X_COORD,Y_COORD,Z_VAL\n7,1,2,3\n8,4,5,6\n",
            "columns X_COORD, Y_COORD, Z_VAL were taken",
        ),
        ("many.xyz", "1 2 3 4 5\n2 3 4 5 6\n", "columns 1, 2, 3 were taken as x, y, z"),
        ("comma.csv", "x;y\n1,5;2\n3;4,25\n", ""),
        (
            "quoted.csv",
            "name,lon,lat\n\"a, b\",\"1.5\",2\n\"c \"\"d\"\"\",3,4\n",
            "columns lon, lat were taken",
        ),
        ("latin.csv", "stra\u{df}e,x,y\na,1,2\nb,3,4\n", ""),
        ("savetxt.txt", "# lat lon\n50 7\n51 8\n", "columns lon, lat were taken"),
        ("r.txt", "\"x\" \"y\"\n\"1\" 1 2\n\"2\" 3 4\n", "the first column, which has no name, was left out"),
        ("wkt.csv", "id,wkt\n1,POINT (1 2)\n2,\"MULTIPOINT (3 4, 5 6)\"\n", "column wkt was taken"),
        ("ring.geojson", RING, ""),
        (
            "text.geojsons",
            "\u{1e}{\"type\":\"Point\",\"coordinates\":[1,2]}\n\u{1e}{\"type\":\"Point\",\"coordinates\":[3,4]}\n",
            "",
        ),
        ("a.pts", "2\n1 2 3 -5 0 0 0\n4 5 6 -5 0 0 0\n", "values of points are left out: intensity, color"),
        ("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ""),
        (
            "a.stl",
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n",
            "",
        ),
        ("one.node", "2 2 1 0\n1 0 0 7\n2 1 1 8\n", "the first of 1 attributes was taken as height"),
    ] {
        place.file(name, content);
        let output = place.run(&format!("info {name}"));
        let told = text(&output.stderr);
        assert!(output.status.success() && told.contains(remark), "{name}: {told}");
        assert!(remark.is_empty() == told.is_empty(), "{name}: {told}");
        assert!(points(&place, name) >= 2, "{name}");
    }
    // A command that knows no segments says that it takes points alone.
    let told = text(&place.run("hull ring.geojson -o hull.npy").stderr);
    assert!(told.contains("the corners of 1 lines and polygons were taken as points"), "{told}");
    place.file("foo.csv", "id,foo,bar\n1,2,3\n");
    place.fail("info foo.csv", 1, "none of the columns id, foo, bar is called x or y");
    assert_eq!(points(&place, "foo.csv --columns foo,bar"), 1);
    assert_eq!(points(&place, "foo.csv --columns 2,3"), 1);
    place.file("na.csv", "N/A,1\n2,3\n");
    place.fail("info na.csv", 1, "line 1: field 1 is \"N/A\"");
    place.file("wide.csv", b"\xff\xfex\0,\0y\0".as_slice());
    place.fail("info wide.csv", 1, "UTF-16");
    place.file("jump.node", "2 2 0 0\n1 0 0\n3 1 1\n");
    place.fail("info jump.node", 1, "line 3: the index is 3 where 2 follows");
}

const RING: &str = r#"{"type":"Polygon","coordinates":[[[0,0],[4,0],[0,4],[0,0]]],
    "crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25832"}}}"#;

#[test]
fn compressed_and_joined() {
    let place = Place::new();
    place.succeed("generate uniform -n 300 --seed 1 -o a.csv");
    place.succeed("generate uniform -n 300 --seed 1 -o a.csv.gz");
    place.succeed("generate uniform -n 200 --seed 2 -o b.npy");
    assert!(fs::read(place.path("a.csv.gz")).expect("a file").starts_with(&[0x1f, 0x8b]));
    place.succeed("triangulate a.csv -o a.npy");
    place.succeed("triangulate a.csv.gz -o z.npy");
    assert_eq!(fs::read(place.path("a.npy")).ok(), fs::read(place.path("z.npy")).ok());
    place.succeed("triangulate a.csv.gz b.npy -o both.npy --check --stats s.json");
    assert!(fs::read_to_string(place.path("s.json")).expect("stats").contains("\"points\": 500"));
    assert!(place.succeed("check a.csv b.npy both.npy").contains("and the canonical"));
    place.file("broken.csv.gz", &fs::read(place.path("a.csv.gz")).expect("a file")[..500]);
    place.fail("info broken.csv.gz", 1, "broken.csv.gz");
}

#[test]
fn systems_of_coordinates_are_passed_on() {
    let place = Place::new();
    place.file("a.geojson", RING);
    assert!(place.succeed("info a.geojson").contains("EPSG:25832"));
    for name in ["b.geojson", "b.ply"] {
        place.succeed(&format!("triangulate a.geojson -o {name}"));
        assert!(place.succeed(&format!("-q info {name}")).contains("EPSG:25832"), "{name}");
    }
    place.file("c.geojson", RING.replace("25832", "25833"));
    place.fail("triangulate a.geojson c.geojson -o m.npy", 1, "c.geojson: its coordinates are EPSG:25833");
    let tile = data("autzen_trim.laz");
    let told = place.succeed(&format!("-q info {}", tile.display()));
    assert!(told.contains("class 2 ground") && told.contains("26107"), "{told}");
    assert_eq!(points(&place, &format!("{} --class ground", tile.display())), 26_107);
    let part = |options: &str| points(&place, &format!("{} {options}", tile.display()));
    assert_eq!(
        part("--returns first") + part("--returns 2") + part("--returns 3") + part("--returns 4"),
        110_000
    );
    assert!(
        part("--z-range=-5,420") > part("--z-range 410,420 --returns last") && part("--z-range 1,2") == 0
    );
    fs::write(place.path("p.csv"), "0,0\n1,0\n0,1\n").expect("a file");
    for (options, message) in [
        ("--returns last", "--returns is for LAS"),
        ("--returns some", "returns are all, first"),
        ("--skip ground", "a flag is one of"),
        ("--z-range 3,2", "the lower one first"),
    ] {
        place.fail(&format!("triangulate p.csv -o m.ply {options}"), 2, message);
    }
}

#[test]
fn long_triangles_are_left_out() {
    let place = Place::new();
    place.file("p.csv", "0,0\n1,0\n2,0\n0,1\n1,1\n2,1\n1,30\n");
    place.succeed("triangulate p.csv --max-edge 2 -o m.npy -o m.svg -o m.neigh -o m.edge --stats s.json");
    place.succeed("triangulate p.csv --max-edge 2 -o m.ele");
    assert!(fs::read_to_string(place.path("m.ele")).expect("a mesh").starts_with("4 3 0"));
    assert!(fs::read_to_string(place.path("m.neigh")).expect("a mesh").starts_with("4 3"));
    assert!(fs::read_to_string(place.path("m.edge")).expect("a mesh").starts_with("9 1"));
    assert!(fs::read_to_string(place.path("s.json")).expect("stats").contains("\"left_out\": 2"));
    place.fail("triangulate p.csv --max-edge=-3 -o m.npy", 2, "it is no length");
}

#[test]
fn files_of_triangle_keep_their_base() {
    let place = Place::new();
    place.file("p.node", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n");
    place.succeed("triangulate p.node -o p.ele -o q.node -o p.edge -o p.npy");
    assert_eq!(fs::read_to_string(place.path("p.ele")).expect("a mesh"), "1 3 0\n1 1 2 3\n");
    assert!(fs::read_to_string(place.path("q.node")).expect("points").contains("\n1 0.0 0.0\n"));
    assert!(place.succeed("check p.node p.ele").contains("canonical"));
    assert!(place.succeed("check p.node p.npy").contains("canonical"));
}

#[cfg(unix)]
#[test]
fn special_outputs_stay_special() {
    use std::os::unix::fs::{FileTypeExt, symlink};
    let place = Place::new();
    place.succeed("generate uniform -n 50 -o p.csv");
    place.succeed("triangulate p.csv -o /dev/null --to npy");
    assert!(fs::metadata("/dev/null").expect("there").file_type().is_char_device());
    assert!(place.succeed("triangulate p.csv -o /dev/stdout --to ele").contains("3 0\n"));
    // A pipe is written into, and stays a pipe.
    let made = Command::new("mkfifo").arg(place.path("pipe.ele")).status().expect("mkfifo");
    assert!(made.success());
    let reader = std::thread::spawn({
        let path = place.path("pipe.ele");
        move || fs::read_to_string(path).expect("read")
    });
    place.succeed("triangulate p.csv -o pipe.ele");
    assert!(reader.join().expect("no panic").contains(" 3 0\n"));
    assert!(fs::metadata(place.path("pipe.ele")).expect("there").file_type().is_fifo());
    // Points come through a pipe too, where a format goes back and forth.
    let tile = fs::read(data("autzen_trim.laz")).expect("the tile");
    let made = Command::new("mkfifo").arg(place.path("pipe.laz")).status().expect("mkfifo");
    assert!(made.success());
    let writer = std::thread::spawn({
        let path = place.path("pipe.laz");
        move || fs::write(path, tile)
    });
    assert_eq!(points(&place, "pipe.laz"), 110_000);
    writer.join().expect("no panic").expect("written");
    // Another name of an input is noticed, by whatever link.
    fs::hard_link(place.path("p.csv"), place.path("hard.csv")).expect("linked");
    symlink("p.csv", place.path("soft.csv")).expect("linked");
    place.fail("triangulate p.csv -o hard.csv --to ply", 2, "would overwrite");
    place.fail("triangulate p.csv -o soft.csv --to ply", 2, "would overwrite");
}

#[cfg(unix)]
#[test]
fn descriptors_are_written_where_they_lead() {
    let place = Place::new();
    place.succeed("generate uniform -n 50 --seed 1 -o p.csv");
    let bash = |line: &str| {
        let line = line.replace("delone", env!("CARGO_BIN_EXE_delone"));
        let output =
            Command::new("bash").current_dir(place.0.path()).args(["-c", &line]).output().expect("bash");
        (output.status.code(), text(&output.stdout), text(&output.stderr))
    };
    // What a file held before stays where a shell appends to it, and what a shell writes after.
    bash("echo keep me > log; delone -q triangulate p.csv --to ele -o /dev/fd/5 5>>log");
    let log = fs::read_to_string(place.path("log")).expect("a log");
    assert!(log.starts_with("keep me\n") && log.contains(" 3 0\n"), "{log}");
    bash("(echo before >&2; delone -q triangulate p.csv --to ele -o /dev/stderr; echo after >&2) 2> log");
    let log = fs::read_to_string(place.path("log")).expect("a log");
    assert!(log.starts_with("before\n") && log.contains(" 3 0\n") && log.ends_with("after\n"), "{log}");
    let (status, counted, told) =
        bash("delone -q triangulate p.csv --to ele -o >(head -1 > first); sleep 0.3; cat first");
    assert!(status == Some(0) && counted.contains(" 3 0"), "{counted} {told}");
    // Standard input and output that are a file of the command.
    let before = fs::read(place.path("p.csv")).expect("points");
    for line in [
        "delone triangulate - --from csv --to npy -o p.csv < p.csv",
        "delone triangulate p.csv --to npy -o - 1<>p.csv",
        "delone triangulate p.csv --to npy -o - >>p.csv",
    ] {
        let (status, _, told) = bash(line);
        assert!(status == Some(2) && told.contains("would overwrite"), "{line}: {status:?} {told}");
        assert_eq!(fs::read(place.path("p.csv")).expect("points"), before, "{line}");
    }
    // Two names that lead to one new file.
    let (status, _, told) =
        bash("mkdir d; ln -s d/z.npy a.npy; ln -s d/z.npy b.npy; delone triangulate p.csv -o a.npy -o b.npy");
    assert!(status == Some(2) && told.contains("would overwrite"), "{told}");
    let (status, _, _) = bash("delone --help > /dev/full");
    assert_eq!(status, Some(1));
    // Nobody reads what is said: the work is done all the same.
    let (status, _, _) = bash("delone triangulate p.csv -o said.ele 2>/dev/full");
    assert!(status == Some(0) && place.path("said.ele").exists());
    let (status, _, _) = bash("delone triangulate none.csv -o said.ele 2>/dev/full");
    assert_eq!(status, Some(1));
    // A file by a way through the system is a file.
    bash("delone -q triangulate p.csv -o /proc/self/cwd/said.ele");
    assert_eq!(fs::read_to_string(place.path("said.ele")).expect("a mesh").matches(" 3 0\n").count(), 1);
}

#[test]
fn long_quotes_and_wide_lines_take_their_length() {
    let place = Place::new();
    // Each of these took minutes when the time was quadratic; they would not end in the time of a test.
    let open = format!("x,y,n\n1,2,\"5 inch\n{}", "1,2,pipe\n".repeat(1_000_000));
    place.file("open.csv", open);
    place.fail("info open.csv", 1, "line 2: a quotation mark is not closed");
    place.file("cell.csv", format!("x,y,n\n1,2,\"{}\"\n3,4,b\n", "a\n".repeat(1_000_000)));
    assert_eq!(points(&place, "cell.csv"), 2);
    place.file("wide.xyz", "1 ".repeat(3_000_000));
    assert_eq!(points(&place, "wide.xyz"), 1);
    place.file("none.ply", "ply\nformat ascii 1.0\nelement point 1\nproperty float x\nend_header\n1\n");
    place.fail("info none.ply", 1, "it has no vertices");
    place.file("mixed.geojson", "\u{feff}{\"type\":\"MultiPoint\",\"coordinates\":[[1,2],[3,4,5]]}");
    assert!(text(&place.run("info mixed.geojson").stderr).contains("heights are left out"));
}

#[cfg(unix)]
#[test]
fn signals_leave_nothing_behind() {
    let place = Place::new();
    place.succeed("generate uniform -n 300000 -o p.npy");
    fs::create_dir(place.path("out")).expect("made");
    // What these tests were started to ignore (under nohup, in the background), the program ignores too.
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:")).unwrap_or("0");
    let ignored = u64::from_str_radix(ignored.trim(), 16).expect("a mask");
    for (signal, number) in [("INT", 2), ("TERM", 15), ("HUP", 1)] {
        if ignored >> (number - 1) & 1 == 1 {
            continue;
        }
        let mut child = Command::new(env!("CARGO_BIN_EXE_delone"))
            .current_dir(place.path("out"))
            .args(["-q", "triangulate", "../p.npy", "-o", "m.geojson", "-o", "n.geojson", "-o", "o.geojson"])
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        let started = Instant::now();
        let names = || fs::read_dir(place.path("out")).expect("readable").count();
        while names() == 0 && started.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(2));
        }
        let kill = Command::new("kill").args([&format!("-{signal}"), &child.id().to_string()]).status();
        assert!(kill.expect("kill").success());
        let status = child.wait().expect("it ends");
        assert!(!status.success(), "{signal}: {status}");
        let half: Vec<_> = fs::read_dir(place.path("out"))
            .expect("readable")
            .map(|entry| entry.expect("an entry").file_name())
            .filter(|name| name.to_string_lossy().ends_with(".tmp"))
            .collect();
        assert!(half.is_empty(), "{signal} left {half:?}");
        fs::read_dir(place.path("out"))
            .expect("readable")
            .for_each(|entry| fs::remove_file(entry.expect("an entry").path()).expect("removed"));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_hangup_that_is_ignored_stays_so() {
    let place = Place::new();
    place.succeed("generate uniform -n 200000 -o p.npy");
    let command =
        format!("trap '' HUP; exec {} -q triangulate p.npy -o m.geojson", env!("CARGO_BIN_EXE_delone"));
    let mut child =
        Command::new("sh").current_dir(place.0.path()).args(["-c", &command]).spawn().expect("sh");
    for _ in 0..5 {
        std::thread::sleep(Duration::from_millis(20));
        _ = Command::new("kill").args(["-HUP", &child.id().to_string()]).stderr(Stdio::null()).status();
    }
    assert!(child.wait().expect("it ends").success());
    assert!(place.path("m.geojson").exists());
}

#[cfg(unix)]
#[test]
fn files_that_may_not_grow_are_errors() {
    let place = Place::new();
    place.succeed("generate uniform -n 20000 -o p.npy");
    let command =
        format!("ulimit -f 100; exec {} -q triangulate p.npy -o m.geojson", env!("CARGO_BIN_EXE_delone"));
    let output = Command::new("sh").current_dir(place.0.path()).args(["-c", &command]).output().expect("sh");
    let told = text(&output.stderr);
    assert!(output.status.code() == Some(1) && told.starts_with("error: cannot write m.geojson"), "{told}");
    assert_eq!(fs::read_dir(place.0.path()).expect("readable").count(), 1);
}

#[cfg(target_os = "linux")]
#[test]
fn too_little_memory_is_one_line() {
    let place = Place::new();
    // More than fit whatever the program itself takes, which is less where it is compiled without debug information.
    place.succeed("generate uniform -n 2e6 -o p.npy");
    for limit in [60_000, 120_000, 200_000] {
        let command =
            format!("ulimit -v {limit}; exec {} -q triangulate p.npy -o m.npy", env!("CARGO_BIN_EXE_delone"));
        let output =
            Command::new("sh").current_dir(place.0.path()).args(["-c", &command]).output().expect("sh");
        let told = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{limit}: {told}");
        assert!(told.starts_with("error: ") && told.lines().count() == 2, "{limit}: {told}");
        assert!(!place.path("m.npy").exists());
    }
}

#[test]
fn the_program_about_itself() {
    let place = Place::new();
    assert!(place.succeed("version").starts_with("delone 0."));
    assert!(place.succeed("completions bash").contains("_delone"));
    assert!(place.succeed("man").contains(".TH"));
    place.succeed("man -o pages");
    assert!(!place.path("pages/delone-help.1").exists());
    assert!(
        fs::read_to_string(place.path("pages/delone-triangulate.1")).expect("a page").contains("max\\-edge")
    );
    place.file("p.csv", "0,0\n1,0\n0,1\n");
    let output = place.run("triangulate p.csv -o m.npy --threads 5000");
    assert!(output.status.success() && text(&output.stderr).contains("not 5000"), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("3 points, 1 triangle, 3 on the hull"));
    place.fail("draw p.csv --cut 1,0,0,0 -o m.png", 2, "--cut and --wireframe are for space");
    place.file("long.csv", format!("1,{}\n", "9e".repeat(30_000)));
    let told = text(&place.run("info long.csv").stderr);
    assert!(told.len() < 800, "{told}");
}
