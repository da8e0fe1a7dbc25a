//! A folder of tiles that somebody changed: it is noticed, nothing panics, and no output goes over its files.

use std::fs;

use crate::place::{Place, text};

/// Tables too, where the program has them.
const TABLES: &str = if cfg!(feature = "parquet") { "--parquet" } else { "" };

/// Copies the folder `t` as `u`.
fn copy(place: &Place) {
    _ = fs::remove_dir_all(place.path("u"));
    fs::create_dir(place.path("u")).expect("room");
    for entry in fs::read_dir(place.path("t")).expect("there") {
        let entry = entry.expect("there");
        fs::copy(entry.path(), place.path("u").join(entry.file_name())).expect("room");
    }
}

fn tiles(place: &Place) {
    place.succeed("-q generate grid -n 500 --seed 3 -o p.csv");
    place.succeed("-q tiles p.csv p.csv -o t --tile 100");
}

#[test]
fn numbers_of_tiles_json_are_checked() {
    let place = Place::new();
    tiles(&place);
    let text = fs::read_to_string(place.path("t/tiles.json")).expect("written");
    let known: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let refuse = |changed: &serde_json::Value| {
        copy(&place);
        fs::write(place.path("u/tiles.json"), changed.to_string()).expect("room");
        for command in
            ["check u", "info u", "window u -o x.off", "tiles p.csv p.csv -o u --resume --neighbors"]
        {
            place.fail(command, 1, "tiles.json");
        }
    };
    let more =
        |value: &mut serde_json::Value, add: u64| *value = (value.as_u64().expect("a number") + add).into();
    for name in ["count", "vertices", "duplicates", "triangles", "left_out"] {
        let mut changed = known.clone();
        more(&mut changed[name], 1);
        refuse(&changed);
    }
    let nodes = known["nodes"].as_array().expect("nodes").len();
    for (node, name) in [(0, "triangles"), (nodes - 1, "vertices"), (nodes - 1, "duplicates")] {
        let mut changed = known.clone();
        more(&mut changed["nodes"][node][name], 1);
        refuse(&changed);
    }
    for count in ["0000000000000000", "4000000000000000", "ffffffffffffffff"] {
        let mut changed = known.clone();
        let old = known["nodes"][0]["fingerprint"].as_str().expect("a text");
        changed["nodes"][0]["fingerprint"] = format!("{}{count}", &old[..32]).into();
        refuse(&changed);
        changed["nodes"][0]["triangles"] = u64::from_str_radix(count, 16).expect("digits").into();
        refuse(&changed);
    }
    let mut changed = known.clone();
    changed["nodes"].as_array_mut().expect("nodes").pop();
    refuse(&changed);
    let mut changed = known.clone();
    changed["nodes"].as_array_mut().expect("nodes").push(known["nodes"][0].clone());
    refuse(&changed);
}

#[test]
fn indices_are_checked() {
    let place = Place::new();
    tiles(&place);
    let name = |entry: fs::DirEntry| entry.file_name().into_string().expect("UTF-8");
    let mut names: Vec<String> = fs::read_dir(place.path("t"))
        .expect("there")
        .map(|entry| name(entry.expect("there")))
        .filter(|name| name.starts_with("ids-"))
        .collect();
    names.sort_unstable();
    let at = |place: &Place, k: usize| place.path(&format!("u/{}", names[k]));
    let change = |message: &str, change: &dyn Fn(&mut Vec<u8>)| {
        copy(&place);
        let mut bytes = fs::read(at(&place, 0)).expect("there");
        change(&mut bytes);
        fs::write(at(&place, 0), bytes).expect("room");
        place.fail("check u", 1, message);
    };
    // The last eight bytes are an index, those before it another one.
    change("another vertex", &|bytes| {
        let at = bytes.len() - 8;
        bytes.copy_within(at.., at - 8);
    });
    change("there are 1000 points", &|bytes| {
        let at = bytes.len() - 5;
        bytes[at] = 1;
    });
    change("ids-", &|bytes| {
        let at = bytes.len() - 8;
        bytes.truncate(at);
    });
    copy(&place);
    fs::copy(at(&place, 0), at(&place, 1)).expect("room");
    place.fail("check u", 1, "ids-");
    fs::remove_file(at(&place, 1)).expect("there");
    place.fail("check u", 1, "ids-");
}

/// Data that no proof can check: which index is whose, heights, neighbors, tables.
#[test]
fn content_is_checked() {
    let place = Place::new();
    tiles(&place);
    let rows = fs::read_to_string(place.path("p.csv")).expect("written");
    let with_heights = rows
        .lines()
        .enumerate()
        .map(|(k, row)| if k == 0 { "x,y,z\n".into() } else { format!("{row},{k}\n") });
    place.file("h.csv", with_heights.collect::<String>());
    fs::remove_dir_all(place.path("t")).expect("there");
    place.succeed(&format!("-q tiles h.csv -o t --heights --tile 100 --neighbors {TABLES}"));
    place.succeed("check t");
    let named = |folder: &str, start: &str, end: &str| {
        let entries = fs::read_dir(place.path(folder)).expect("there");
        let names = entries.map(|entry| entry.expect("there").file_name().into_string().expect("UTF-8"));
        let mut names: Vec<String> =
            names.filter(|name| name.starts_with(start) && name.ends_with(end)).collect();
        names.sort_unstable();
        names.pop().expect("one")
    };
    let refuse = |name: &str, change: &dyn Fn(&mut Vec<u8>)| {
        copy(&place);
        let path = place.path("u").join(name);
        let mut bytes = fs::read(&path).expect("there");
        change(&mut bytes);
        fs::write(&path, bytes).expect("room");
        place.fail("check u", 1, &format!("{name}: it is not what was written"));
    };
    refuse(&named("t", "ids-", ".npy"), &|bytes| {
        let at = bytes.len() - 16;
        bytes[at..].rotate_left(8);
    });
    // The last height, in its last bit.
    refuse(&named("t", "points-", ".npy"), &|bytes| {
        let at = bytes.len() - 8;
        bytes[at] ^= 1;
    });
    let tables = [("points-", ".parquet"), ("triangles-", ".parquet")];
    let tables = tables.iter().filter(|_| !TABLES.is_empty());
    for &(start, end) in [("neighbors-", ".npy"), ("across-", ".npy"), ("seam-", ".npy")].iter().chain(tables)
    {
        let name = named("t", start, end);
        if start == "seam-" {
            // A triangle that begins with another corner is the same, and another file.
            let turn = |bytes: &mut Vec<u8>| {
                let at = bytes.len() - 24;
                bytes[at..].rotate_left(8);
            };
            refuse(&name, &turn);
        } else {
            refuse(&name, &|bytes| *bytes.last_mut().expect("some") ^= 1);
            refuse(&name, &|bytes| bytes.truncate(bytes.len() - 1));
        }
        copy(&place);
        fs::remove_file(place.path("u").join(&name)).expect("there");
        place.fail("check u", 1, &name);
    }
    // Files that nobody vouches for, as a kill leaves them between.
    copy(&place);
    fs::write(place.path("u/neighbors-00099.npy"), "half").expect("room");
    place.fail("check u", 1, "neighbors-00099.npy: tiles.json does not know it");
    // A hash that is missing or leads elsewhere.
    let text = fs::read_to_string(place.path("t/tiles.json")).expect("written");
    for (from, to, message) in [
        ("\"ids-", "\"other-", "has no hash of it"),
        ("\"ids-", "\"../ids-", "something is missing in it, or wrong"),
    ] {
        copy(&place);
        fs::write(place.path("u/tiles.json"), text.replacen(from, to, 1)).expect("room");
        place.fail("check u", 1, message);
    }
}

/// Neighbors and tables of a folder that was done before, or whose run was stopped while it wrote them.
#[test]
fn content_that_comes_later_is_known() {
    let place = Place::new();
    tiles(&place);
    place.succeed(&format!("-q tiles p.csv p.csv -o whole --tile 100 --neighbors {TABLES}"));
    let manifest = || fs::read_to_string(place.path("t/tiles.json")).expect("written");
    let before = manifest();
    place.succeed("-q tiles p.csv p.csv -o t --tile 100 --resume --neighbors");
    assert!(manifest().contains("\"neighbors-") && !before.contains("\"neighbors-"));
    // Stopped before they were known.
    fs::write(place.path("t/tiles.json"), before).expect("room");
    place.fail("check t", 1, "tiles.json does not know it");
    place.succeed(&format!("-q tiles p.csv p.csv -o t --tile 100 --resume --neighbors {TABLES}"));
    place.succeed("check t");
    place.succeed("-q tiles p.csv p.csv -o t --tile 100 --resume");
    assert_eq!(manifest(), fs::read_to_string(place.path("whole/tiles.json")).expect("written"));
}

/// Numbers that somebody changed while work went on are told with their file, and are not taken for memory that is needed.
#[test]
fn numbers_of_a_run_that_goes_on_are_checked() {
    let place = Place::new();
    place.succeed("-q generate unit-circle -n 100000 --seed 1 -o p.npy");
    // All points are on borders, and do not fit.
    let stopped = place.run("tiles p.npy -o t --memory 64M --tile 20000");
    assert!(text(&stopped.stderr).contains("--memory allows"));
    let resume = "tiles p.npy -o u --memory 64M --resume";
    let text = fs::read_to_string(place.path("t/tiles.json")).expect("written");
    let known: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let with = |changed: &serde_json::Value| {
        copy(&place);
        fs::write(place.path("u/tiles.json"), changed.to_string()).expect("room");
    };
    // Of a bucket, alone: they do not add up. With the sum: the tile, or the bucket, has not so many.
    let (mut one, mut both) = (known.clone(), known.clone());
    let more = 1_u64 << 40;
    one["buckets"][0][1] = more.into();
    with(&one);
    place.fail(resume, 1, "tiles.json: something is missing in it, or wrong");
    let old = known["buckets"][0][1].as_u64().expect("a number");
    both["buckets"][0][1] = more.into();
    both["count"] = (known["count"].as_u64().expect("a number") - old + more).into();
    let node = known["buckets"][0][0].as_u64().expect("a number");
    with(&both);
    place.fail(resume, 1, &format!("border-{node:05}.bin"));
    fs::remove_file(place.path(&format!("u/border-{node:05}.bin"))).expect("there");
    let bucket = format!("bucket-{node:05}.bin");
    place.fail(resume, 1, &bucket);
    fs::write(place.path("u").join(&bucket), [0; 48]).expect("room");
    place.fail(resume, 1, &format!("{bucket}: the bucket has 48 bytes"));
    // Such a length costs nothing where nobody wrote it: it is told which file is so long.
    let file = fs::File::create(place.path("u").join(&bucket)).expect("room");
    if file.set_len(24 * more).or_else(|_| file.set_len(24 << 36)).is_ok() {
        place.fail(resume, 1, &bucket);
    }
    // The first line of a border.
    let border = place.path(&format!("u/border-{node:05}.bin"));
    for (from, message) in
        [("\"border\":", "points"), ("\"duplicates\":", "duplicates"), ("\"node\":", "it is of node")]
    {
        copy(&place);
        let bytes = fs::read(&border).expect("there");
        let end = bytes.iter().position(|&byte| byte == b'\n').expect("a line");
        let line = std::str::from_utf8(&bytes[..end]).expect("text");
        let changed = [line.replacen(from, &format!("{from}7"), 1).as_bytes(), &bytes[end..]].concat();
        fs::write(&border, changed).expect("room");
        place.fail(resume, 1, message);
    }
}

/// Asked before there is work to lose.
#[test]
fn outputs_that_cannot_be_written_are_told_first() {
    let place = Place::new();
    tiles(&place);
    for command in [
        "tiles p.csv -o v --stats no/s.json",
        "check t --stats no/s.json",
        "info t --stats no/s.json",
        "window t -o x.off --stats no/s.json",
        "triangulate p.csv -o x.npy --stats no/s.json",
        "triangulate p.csv -o no/x.npy",
        "triangulate p.csv -o x.npy --stats t",
    ] {
        place.fail(command, 1, "cannot write");
    }
}

#[test]
fn neighbors_of_changed_triangles_are_refused() {
    let place = Place::new();
    tiles(&place);
    copy(&place);
    let seam = place.path("u/seam-00001.npy");
    let tile = fs::read_dir(place.path("u"))
        .expect("there")
        .map(|entry| entry.expect("there").path())
        .find(|path| path.display().to_string().contains("triangles-"))
        .expect("a tile");
    let mut bytes = fs::read(&tile).expect("there");
    *bytes.last_mut().expect("some") = 0x7f;
    fs::write(&tile, bytes).expect("room");
    place.fail("tiles p.csv p.csv -o u --resume --neighbors", 1, "it is not what was written");
    fs::copy(&tile, seam).expect("room");
    place.fail("tiles p.csv p.csv -o u --resume --neighbors", 1, "it is not what was written");
}

#[test]
fn no_output_is_in_the_folder() {
    let place = Place::new();
    tiles(&place);
    for command in [
        "window t -o t/tiles.json --to geojson",
        "window t -o x.off --stats t/tiles.json",
        "check t --stats t/tiles.json",
        "info t --stats t/tiles.json",
        "tiles p.csv p.csv -o t --resume --stats t/tiles.json",
    ] {
        place.fail(command, 2, "is in the folder");
    }
    place.succeed("check t");
}

#[test]
fn one_run_at_a_time() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 500 --seed 3 -o p.csv");
    fs::create_dir(place.path("t")).expect("made");
    let held = fs::File::open(place.path("t")).expect("a folder");
    // Where folders can be locked: not everywhere.
    if held.try_lock().is_ok() {
        place.fail("tiles p.csv -o t", 2, "another run works in");
        place.fail("tiles p.csv -o t --resume", 2, "another run works in");
        assert_eq!(fs::read_dir(place.path("t")).expect("readable").count(), 0);
    }
    drop(held);
    place.succeed("-q tiles p.csv -o t");
}
