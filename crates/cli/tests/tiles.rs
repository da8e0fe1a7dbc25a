//! Tiles as a user meets them: the same triangles as in memory, whatever the input, the memory and the moment of a kill; and every refusal.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::place::{Place, data, text};

fn manifest(place: &Place, folder: &str) -> Value {
    let text = fs::read(place.path(folder).join("tiles.json")).expect("a manifest");
    serde_json::from_slice(&text).expect("JSON")
}

/// The files of a folder with their contents; without the manifest's account of what was read.
fn content(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).expect("readable").map(|entry| entry.expect("readable"));
    entries
        .map(|entry| {
            (entry.file_name().to_string_lossy().into_owned(), fs::read(entry.path()).expect("readable"))
        })
        .collect()
}

/// Tiles of some points have the fingerprint that they have in memory, and are proved.
fn judge(place: &Place, input: &str, tiles: &str) -> Value {
    place.succeed(&format!("-q tiles {input} -o t {tiles}"));
    let found = manifest(place, "t");
    let expected = place.succeed(&format!("-q triangulate {input} --fingerprint"));
    assert_eq!(found["fingerprint"].as_str(), Some(expected.trim()), "{input} {tiles}");
    let verdict = place.succeed("check t");
    assert!(verdict.starts_with("Delaunay, and the canonical"), "{input} {tiles}: {verdict}");
    assert!(verdict.contains(expected.trim()));
    let names: Vec<String> = content(&place.path("t")).into_keys().collect();
    assert!(names.iter().all(|name| !name.starts_with("bucket") && !name.starts_with("border")), "{names:?}");
    fs::remove_dir_all(place.path("t")).expect("removed");
    found
}

#[test]
fn every_set_is_that_of_memory() {
    let place = Place::new();
    let kinds = delone_generators::Kind::ALL;
    for (k, kind) in kinds.iter().enumerate() {
        place.succeed(&format!("-q generate {} -n 500 --seed {k} -o p.npy", kind.name()));
        let found = judge(&place, "p.npy", &format!("--tile {}", [20, 70, 1000][k % 3]));
        assert_eq!(found["count"], 500);
    }
}

#[test]
fn sets_without_triangles_are_valid() {
    let place = Place::new();
    for (content, vertices) in
        [("", 0), ("1,2\n", 1), ("1,2\n1,2\n-0,0\n0,-0\n", 2), ("0,0\n1,1\n2,2\n3,3\n", 4)]
    {
        place.file("p.csv", content);
        for tiles in ["", "--tile 1"] {
            let found = judge(&place, "p.csv", tiles);
            assert_eq!(
                (&found["vertices"], &found["triangles"]),
                (&vertices.into(), &0.into()),
                "{content:?}"
            );
        }
    }
}

/// All formats that are read piece by piece, and several files of them as one set.
#[test]
fn formats_and_files() {
    let place = Place::new();
    for (k, extension) in ["npy", "csv", "xyz", "bin"].into_iter().enumerate() {
        place.succeed(&format!("-q generate uniform -n 3000 --seed {k} -o p{k}.{extension}"));
        judge(&place, &format!("p{k}.{extension}"), "--tile 400");
    }
    // The last one has points of the first once more.
    fs::copy(place.path("p0.npy"), place.path("again.npy")).expect("copied");
    let found = judge(&place, "p0.npy p1.csv p2.xyz p3.bin again.npy", "--tile 1000 --workers 3");
    assert_eq!((&found["count"], &found["duplicates"]), (&15_000.into(), &3000.into()));
    let scan = data("autzen_trim.laz");
    judge(&place, &format!("{} --class ground", scan.display()), "--tile 3000");
}

/// The content of the shards: points along a curve with their indices, and triangles of all of them.
#[test]
fn shards_hold_what_is_said() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 2000 --seed 3 -o p.csv");
    let table = fs::read_to_string(place.path("p.csv")).expect("text");
    let with_heights: String = table
        .lines()
        .enumerate()
        .map(|(k, line)| if k == 0 { format!("{line},z\n") } else { format!("{line},{}\n", k - 1) })
        .collect();
    place.file("h.csv", with_heights);
    place.succeed("-q tiles h.csv -o t --heights --tile 300");
    place.succeed("-q triangulate h.csv -o whole.npy");
    let mut points: BTreeMap<u64, (u64, u64)> = BTreeMap::new();
    let folder = place.path("t");
    let numbers = |bytes: &[u8], size: usize| -> Vec<u64> {
        let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        let word = |word: &[u8]| word.iter().rev().fold(0, |number, &byte| number << 8 | u64::from(byte));
        bytes[start..].chunks_exact(size).map(word).collect()
    };
    let files = content(&folder);
    let mut found: Vec<[u64; 3]> = Vec::new();
    let node =
        |name: &str| name.split(['-', '.']).nth(1).and_then(|n| n.parse::<u64>().ok()).expect("a number");
    for (name, bytes) in files.iter().filter(|(name, _)| name.starts_with("points")) {
        assert!(text(&bytes[..128]).contains(", 3, )"), "heights");
        let ids = numbers(&files[&name.replace("points", "ids")], 8);
        let coordinates = numbers(bytes, 8);
        assert_eq!(coordinates.len(), 3 * ids.len());
        for (v, (&id, p)) in ids.iter().zip(coordinates.chunks_exact(3)).enumerate() {
            assert_eq!(f64::from_bits(p[2]), id as f64, "the height of a point is its index here");
            points.insert(node(name) << 32 | v as u64, (id, p[0]));
        }
    }
    assert_eq!(points.len(), 2000);
    let corner = |id: u64| points[&id].0;
    for (name, bytes) in &files {
        if name.starts_with("triangles") {
            let of_tile = numbers(bytes, 4);
            found.extend(
                of_tile.as_chunks().0.iter().map(|t: &[u64; 3]| t.map(|v| corner(node(name) << 32 | v))),
            );
        } else if name.starts_with("seam") {
            found.extend(numbers(bytes, 8).as_chunks().0.iter().map(|t: &[u64; 3]| t.map(corner)));
        }
    }
    let whole = numbers(&fs::read(place.path("whole.npy")).expect("triangles"), 8);
    let mut whole: Vec<[u64; 3]> = whole.as_chunks().0.to_vec();
    for set in [&mut found, &mut whole] {
        // From the least corner on.
        set.iter_mut().for_each(|t| {
            while t[0] > t[1] || t[0] > t[2] {
                t.rotate_left(1);
            }
        });
        set.sort_unstable();
    }
    assert!(found == whole);
}

/// Whatever the moment of a kill, and however often: the same files in the end.
#[test]
#[cfg(unix)]
fn kills_lose_nothing() {
    let place = Place::new();
    place.succeed("-q generate clusters -n 20000 --seed 3 -o p.npy");
    let line = "-q tiles p.npy -o whole --tile 400 --workers 2";
    let started = Instant::now();
    place.succeed(line);
    let mut took = started.elapsed();
    let expected = content(&place.path("whole"));
    let mut random = delone_generators::Random::new(5);
    let (mut rounds, mut killed) = (0, 0);
    while rounds < 8 || killed < 8 {
        rounds += 1;
        let folder = format!("t{rounds}");
        let mut resume = "";
        // More and more patience: what one try does may be less than it takes to begin.
        for tries in 1.. {
            let args = format!("-q tiles p.npy -o {folder} --tile 400 --workers 2 {resume}");
            let mut command = Command::new(env!("CARGO_BIN_EXE_delone"));
            command.current_dir(place.path("")).args(args.split_whitespace()).stderr(Stdio::piped());
            let mut program = command.spawn().expect("the program starts");
            let patience = took.mul_f64(random.between(0.0, 0.8)) * tries;
            let begun = Instant::now();
            while begun.elapsed() < patience && program.try_wait().expect("asked").is_none() {
                std::thread::sleep(Duration::from_millis(1));
            }
            _ = program.kill();
            let output = program.wait_with_output().expect("ended");
            if output.status.success() {
                if tries == 1 {
                    // The machine is faster than it was: patience is for less.
                    took = took.min(begun.elapsed());
                }
                break;
            }
            assert!(output.status.code().is_none(), "{folder}: {}", text(&output.stderr));
            killed += 1;
            // A folder that was not even made is begun.
            resume = "--resume";
        }
        let found = content(&place.path(&folder));
        let differ = |name: &&String| found.get(*name) != expected.get(*name);
        let others: Vec<&String> = found.keys().chain(expected.keys()).filter(differ).collect();
        assert!(others.is_empty(), "{folder}: {others:?} are other files");
        fs::remove_dir_all(place.path(&folder)).expect("removed");
    }
}

/// Memory that is too small for the borders of a circle: a clear stop, and more memory goes on.
#[test]
fn borders_that_do_not_fit_are_told() {
    let place = Place::new();
    place.succeed("-q generate unit-circle -n 200000 --seed 1 -o p.npy");
    let output = place.run("-q tiles p.npy -o t --memory 64M --tile 20000");
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(
        message.contains("points, ") && message.contains("% of all") && message.contains("--resume --memory")
    );
    let unfinished = place.run("check t");
    assert!(text(&unfinished.stderr).contains("not finished"));
    assert!(place.succeed("info t").contains("tiles are done: go on with --resume"));
    let before = fs::metadata(place.path("t/points-00008.npy")).expect("done").modified().expect("a time");
    place.succeed("-q tiles p.npy -o t --memory 1G --resume");
    let after = fs::metadata(place.path("t/points-00008.npy")).expect("done").modified().expect("a time");
    assert_eq!(before, after, "what was finished is not done again");
    let expected = place.succeed("-q triangulate p.npy --fingerprint");
    assert_eq!(manifest(&place, "t")["fingerprint"].as_str(), Some(expected.trim()));
    // Done is done.
    place.succeed("tiles p.npy -o t --resume");
    assert!(place.succeed("info t").contains("fingerprint"));
}

/// Points that no sample shows, and more equal ones than a tile may have.
#[test]
fn buckets_that_are_too_large_are_cut_again() {
    let place = Place::new();
    let mut rows = String::from("x,y\n");
    let mut r = delone_generators::Random::new(1);
    for k in 0..9000 {
        let p = match k % 3 {
            0 => [r.unit(), r.unit()],
            1 => [0.25, 0.75],
            _ => [0.5 + 1e-9 * r.unit(), 0.5 + 1e-9 * r.unit()],
        };
        rows += &format!("{:?},{:?}\n", p[0], p[1]);
    }
    place.file("p.csv", rows);
    let found = judge(&place, "p.csv", "--tile 200");
    assert_eq!(found["duplicates"], 2999);
    assert!(found["left_out"].as_u64() > Some(2000), "{}", found["left_out"]);
    let buckets = found["buckets"].as_array().expect("counts");
    assert!(buckets.iter().all(|bucket| bucket[1].as_u64() <= Some(200)));
}

#[test]
fn refusals_say_what_to_do() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 3000 --seed 3 -o p.npy");
    place.succeed("-q generate uniform -n 3000 --seed 4 -o q.npy");
    place.succeed("-q generate uniform -n 30 --seed 4 -o p.ply");
    place.file("bad.csv", "0,0\n1,1\n2,nan\n");
    place.file("flat.csv", "x,y\n0,0\n1,1\n2,0\n");
    place.succeed("-q tiles p.npy -o t --tile 500");
    for (line, status, message) in [
        ("tiles p.npy -o t --tile 500", 2, "has tiles already"),
        ("tiles p.npy -o .", 2, "is not empty"),
        ("tiles p.npy -o . --resume", 2, "has no tiles.json"),
        ("tiles q.npy -o t --resume", 2, "another one than that of the run"),
        ("tiles p.npy -o t --resume --heights", 2, "are others than the run"),
        ("tiles p.npy -o u --memory 1M", 2, "64M are the least"),
        ("tiles p.npy -o u --memory lots", 2, "a size is a number of bytes"),
        ("tiles p.npy -o u --tile 0", 2, "--tile 0"),
        ("tiles - --from csv -o u", 2, "- cannot be read piece by piece, twice"),
        ("tiles none.npy -o u", 1, "No such file"),
        ("tiles p.npy -o p.ply", 1, "p.ply"),
        ("check nowhere", 2, "points and triangles are needed"),
        ("triangulate p.npy", 2, "--output"),
        ("triangulate p.npy --fingerprint -o - --to csv", 2, "standard output"),
    ] {
        place.fail(line, status, message);
    }
    // What makes a folder before it fails leaves nothing in it.
    for (line, status, message) in [
        ("tiles p.ply -o u", 2, "points in pieces are not read from ply files"),
        ("tiles bad.csv -o u", 1, "bad.csv: point 2 has the y coordinate NaN"),
        ("tiles flat.csv bad.csv -o u", 1, "bad.csv: point 5 has the y coordinate NaN"),
        ("tiles flat.csv -o u --heights", 1, "has no heights"),
    ] {
        let output = place.run(line);
        let found = text(&output.stderr);
        assert!(output.status.code() == Some(status) && found.contains(message), "{line}: {found}");
        assert_eq!(fs::read_dir(place.path("u")).expect("a folder").count(), 0, "{line}");
    }
}

/// Folders that somebody touched.
#[test]
fn what_changed_between_is_seen() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 3000 --seed 3 -o p.npy");
    let fails = |line: &str, message: &str| {
        let output = place.run(line);
        let found = text(&output.stderr);
        assert!(!output.status.success() && found.contains(message), "{line}: {found}");
        assert!(found.contains("help: "), "{line}: {found}");
    };
    let path = place.path("t/tiles.json");
    let begin = || {
        _ = fs::remove_dir_all(place.path("t"));
        place.succeed("-q tiles p.npy -o t --tile 500");
    };
    let edit = |from: &str, to: &str| {
        let text = fs::read_to_string(&path).expect("a manifest");
        assert!(text.contains(from), "{text}");
        fs::write(&path, text.replace(from, to)).expect("written");
    };
    begin();
    // Those of the first version have no hashes.
    for version in [1, 7] {
        begin();
        edit("\"version\": 2", &format!("\"version\": {version}"));
        fails("tiles p.npy -o t --resume", &format!("of version {version}, and this program knows 2"));
        fails("check t", &format!("of version {version}"));
    }
    for (from, to, message) in [
        ("\"delone tiles\"", "\"other\"", "does not describe tiles"),
        ("{", "", "not JSON"),
        ("\"count\"", "\"amount\"", "something is missing"),
        ("\"axis\": 0", "\"axis\": 7", "no such axis"),
    ] {
        begin();
        edit(from, to);
        fails("info t", message);
    }
    // The stage before: tiles are to be made again, and their buckets are gone.
    begin();
    edit("\"stage\": \"done\"", "\"stage\": \"distributed\"");
    fails("tiles p.npy -o t --resume", "bucket");
    // Shards of others.
    let shard = |kind: &str| {
        let names = content(&place.path("t")).into_keys();
        place.path("t").join(names.rev().find(|name| name.starts_with(kind)).expect("one"))
    };
    for (kind, message) in
        [("points", "tiles.json"), ("triangles", "tiles.json knows"), ("seam", "tiles.json knows")]
    {
        begin();
        let path = shard(kind);
        let bytes = fs::read(&path).expect("readable");
        let mut changed = bytes.clone();
        let end = changed.len();
        if kind == "points" {
            // One in the last bit.
            changed[end - 16] ^= 1;
        } else {
            // A triangle in place of another.
            let size = if kind == "seam" { 24 } else { 12 };
            changed.copy_within(end - 2 * size..end - size, end - size);
        }
        fs::write(&path, &changed).expect("written");
        fails("check t", message);
        fs::write(&path, &bytes[..end - 8]).expect("written");
        fails("check t", "the file ends");
        fs::remove_file(&path).expect("removed");
        fails("check t", "No such file");
    }
    // The input itself.
    begin();
    place.succeed("-q generate uniform -n 3001 --seed 3 -o p.npy");
    fails("tiles p.npy -o t --resume", "the input has changed since");
}

/// A disk that is full: nothing that was finished is lost.
#[test]
#[cfg(unix)]
fn a_full_disk_is_told() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 60000 --seed 3 -o p.npy");
    let limited = |blocks: usize, resume: &str| {
        let line = format!(
            "ulimit -f {blocks}; exec {} -q tiles p.npy -o t --tile 20000 --workers 1 {resume}",
            env!("CARGO_BIN_EXE_delone")
        );
        let mut shell = Command::new("sh");
        shell.current_dir(place.path("")).args(["-c", &line]).output().expect("a shell")
    };
    // Enough for a bucket, not for all shards.
    for blocks in [100, 600] {
        let output = limited(blocks, if blocks == 100 { "" } else { "--resume" });
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert!(message.contains("cannot write") && message.contains("help: "), "{message}");
    }
    place.succeed("-q tiles p.npy -o t --tile 20000 --resume");
    let expected = place.succeed("-q triangulate p.npy --fingerprint");
    assert_eq!(manifest(&place, "t")["fingerprint"].as_str(), Some(expected.trim()));
}

/// The limit `--memory` holds: these points do not fit in memory.
#[test]
#[cfg(target_os = "linux")]
fn memory_is_kept() {
    let place = Place::new();
    place.succeed("-q generate uniform -n 3000000 --seed 3 -o p.npy");
    // Addresses are not memory: threads take some for their stacks, beside what is allowed, and would for heaps of their own.
    let limit = format!("ulimit -v {}; exec {}", 300 << 10, env!("CARGO_BIN_EXE_delone"));
    let run = |args: &str| {
        let mut shell = Command::new("sh");
        shell.current_dir(place.path("")).env("MALLOC_ARENA_MAX", "1");
        shell.args(["-c", &format!("{limit} {args}")]).output().expect("a shell")
    };
    let output = run("-q tiles p.npy -o t --memory 64M --threads 2");
    assert!(output.status.success(), "{}", text(&output.stderr));
    let output = run("-q triangulate p.npy --fingerprint --threads 2");
    assert!(text(&output.stderr).contains("not enough memory"), "{}", text(&output.stderr));
}
