//! A run that goes on trusts nothing that it has not checked, and writes through no link.

use std::fs;

use crate::place::{Place, text};

/// The names in a folder that begin so.
fn named(place: &Place, folder: &str, start: &str) -> Vec<String> {
    let entries = fs::read_dir(place.path(folder)).expect("readable");
    let names = entries.map(|entry| entry.expect("there").file_name().into_string().expect("UTF-8"));
    let mut names: Vec<String> = names.filter(|name| name.starts_with(start)).collect();
    names.sort_unstable();
    names
}

fn copy(place: &Place, from: &str, to: &str) {
    _ = fs::remove_dir_all(place.path(to));
    fs::create_dir(place.path(to)).expect("room");
    for name in named(place, from, "") {
        fs::copy(place.path(from).join(&name), place.path(to).join(&name)).expect("room");
    }
}

/// A folder `t` with some tiles that are done, and others whose bucket waits: on a circle all points are on borders, and do not fit.
fn half_done(place: &Place) {
    place.succeed("-q generate unit-circle -n 100000 --seed 1 -o p.npy");
    place.succeed("-q tiles p.npy -o whole --memory 1G --tile 20000");
    let stopped = place.run("tiles p.npy -o t --memory 64M --tile 20000");
    assert!(text(&stopped.stderr).contains("--memory allows"), "{}", text(&stopped.stderr));
}

const RESUME: &str = "tiles p.npy -o u --memory 1G --resume";

/// The name of a change of a file, and how it is made.
type Change = (&'static str, fn(&mut Vec<u8>));

/// Changes of a file that its name does not show.
const CHANGES: [Change; 4] = [
    ("empty", Vec::clear),
    ("half", |bytes| bytes.truncate(bytes.len() / 2)),
    ("zeros at the end", |bytes| {
        let at = bytes.len() - 40;
        bytes[at..].fill(0);
    }),
    ("a bit", |bytes| {
        let at = bytes.len() - 5;
        bytes[at] ^= 1;
    }),
];

#[test]
fn damaged_files_are_not_trusted() {
    let place = Place::new();
    half_done(&place);
    copy(&place, "t", "u");
    place.succeed(&format!("-q {RESUME}"));
    place.succeed("check u");
    for (folder, kinds) in
        [("t", &["points", "ids", "triangles", "seam", "border"][..]), ("whole", &["points", "seam"])]
    {
        for kind in kinds {
            // Some of a kind that is not made on the way.
            let Some(name) = named(&place, folder, kind).pop() else {
                assert_eq!(*kind, "seam");
                continue;
            };
            for (change, make) in CHANGES {
                copy(&place, folder, "u");
                let path = place.path("u").join(&name);
                let mut bytes = fs::read(&path).expect("there");
                make(&mut bytes);
                fs::write(&path, bytes).expect("room");
                let output = place.run(RESUME);
                let told = text(&output.stderr);
                assert_eq!(output.status.code(), Some(1), "{name}, {change}: {told}");
                assert!(told.starts_with("error: ") && told.contains(&name), "{name}, {change}: {told}");
            }
        }
    }
    copy(&place, "t", "u");
    let lost = named(&place, "u", "ids").pop().expect("one");
    fs::remove_file(place.path("u").join(&lost)).expect("there");
    place.fail(RESUME, 1, &lost);
    // One that its node does not know is not vouched for.
    copy(&place, "t", "u");
    let border = place.path("u").join(named(&place, "u", "border").pop().expect("one"));
    let bytes = fs::read(&border).expect("there");
    let end = bytes.iter().position(|&byte| byte == b'\n').expect("a line");
    let line = std::str::from_utf8(&bytes[..end]).expect("text");
    fs::write(&border, [line.replace("\"ids-", "\"odd-").as_bytes(), &bytes[end..]].concat()).expect("room");
    place.fail(RESUME, 1, "has no hash of it");
}

/// A tile is made of its bucket, if that is what was written.
#[cfg(unix)]
#[test]
fn damaged_buckets_are_not_trusted() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 30000 --seed 3 -o p.npy");
    // The disk is full before the first bucket is.
    let shell = format!(
        "ulimit -f 24; {} -q tiles p.npy -o t --tile 5000; test $? = 1",
        env!("CARGO_BIN_EXE_delone")
    );
    let status = std::process::Command::new("sh").current_dir(place.path("")).args(["-c", &shell]).status();
    assert!(status.expect("a shell").success());
    // Folders in the way of all shards: then there are buckets, and no tile.
    let folders: Vec<_> = (1..32).map(|node| place.path(&format!("t/points-{node:05}.npy"))).collect();
    folders.iter().for_each(|folder| fs::create_dir(folder).expect("room"));
    let resume = |folder: &str| place.run(&format!("-q tiles p.npy -o {folder} --tile 5000 --resume"));
    assert!(text(&resume("t").stderr).contains("cannot write t/points-"));
    folders.iter().for_each(|folder| fs::remove_dir(folder).expect("empty"));
    let name = named(&place, "t", "bucket").pop().expect("one");
    for (change, make) in CHANGES {
        copy(&place, "t", "u");
        let path = place.path("u").join(&name);
        let mut bytes = fs::read(&path).expect("there");
        make(&mut bytes);
        fs::write(&path, bytes).expect("room");
        let output = resume("u");
        let told = text(&output.stderr);
        assert!(output.status.code() == Some(1) && told.contains(&name), "{change}: {told}");
    }
    assert!(resume("t").status.success());
    place.succeed("check t");
}

#[cfg(unix)]
#[test]
fn nothing_is_written_through_links_and_no_pipe_is_waited_for() {
    use std::os::unix::fs::symlink;
    let place = Place::new();
    half_done(&place);
    place.file("victim", "precious");
    let node = |name: &str| name.split(['-', '.']).nth(1).expect("a number").to_owned();
    let tile = node(&named(&place, "t", "border").pop().expect("one"));
    let pipe = |path: &std::path::Path| {
        assert!(std::process::Command::new("mkfifo").arg(path).status().expect("mkfifo").success());
    };
    // What is still to be written: the seam of the root, its border, the manifest that says done.
    for name in ["seam-00001.npy", "border-00001.bin", "neighbors-00001.npy"] {
        for is_pipe in [false, true] {
            if is_pipe && name.starts_with("border") {
                continue;
            }
            copy(&place, "t", "u");
            let path = place.path("u").join(name);
            if is_pipe {
                pipe(&path);
            } else {
                symlink(place.path("victim"), &path).expect("linked");
            }
            let output = place.run(&format!("{RESUME} --neighbors"));
            let told = text(&output.stderr);
            if name.starts_with("border") {
                // It would be read as a border that is done.
                assert!(output.status.code() == Some(1) && told.contains(name), "{told}");
            } else {
                assert!(output.status.success(), "{name}: {told}");
                assert!(path.symlink_metadata().expect("there").is_file());
                place.succeed("check u");
            }
            assert_eq!(place.read("victim"), "precious", "{name}");
        }
    }
    // Pipes in place of what is read: it is told, and nobody waits.
    for name in ["tiles.json", &format!("points-{tile}.npy"), &format!("border-{tile}.bin")] {
        copy(&place, "t", "u");
        fs::remove_file(place.path("u").join(name)).expect("there");
        pipe(&place.path("u").join(name));
        let output = place.run(RESUME);
        let told = text(&output.stderr);
        assert!(output.status.code() == Some(1) && told.contains(name), "{name}: {told}");
    }
    pipe(&place.path("pipe"));
    assert!(!place.run("tiles p.npy -o pipe").status.success());
}

/// A window is cut from what was written, and from nothing else.
#[test]
fn windows_are_of_what_was_written() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 3000 --seed 3 -o p.npy");
    place.succeed("-q tiles p.npy -o t --tile 500");
    place.succeed("-q window t -o w.npy");
    for kind in ["points", "triangles", "seam"] {
        let name = named(&place, "t", kind).pop().expect("one");
        copy(&place, "t", "u");
        let path = place.path("u").join(&name);
        let mut bytes = fs::read(&path).expect("there");
        let at = bytes.len() - 8;
        bytes[at] ^= 1;
        fs::write(path, bytes).expect("room");
        place.fail("window u -o x.npy", 1, &format!("{name}: it is not what was written"));
    }
}
