//! Folders of tiles against the triangulation of all points at once; runs that are stopped; every refusal.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use delone::tiles::{Fingerprint, Region};
use delone::{Delaunay2, Triangulation as _};
use delone_io::{Format, ReadOptions};
use delone_store::{Build, Difference, Error, Files, State, Store, Watch, describe};
use tempfile::TempDir;

const MEMORY: u64 = 64 << 20;

/// Points of no pattern, some of them twice, with heights.
fn points(count: u32) -> Vec<[f64; 3]> {
    let point = |i: u32| [f64::from(i * 7919 % 5003), f64::from(i * 6007 % 4999), f64::from(i % 100) / 4.0];
    (0..count).map(point).chain((0..9).map(point)).collect()
}

struct Place {
    folder: TempDir,
    input: PathBuf,
}

impl Place {
    fn new(count: u32) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let input = folder.path().join("points.csv");
        let rows = points(count).into_iter().map(|[x, y, z]| format!("{x},{y},{z}\n"));
        fs::write(&input, rows.collect::<String>()).expect("room");
        Self { folder, input }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn files(&self) -> Files {
        Files::new([&self.input]).expect("a format")
    }

    fn run(&self, build: &Build, name: &str) -> Result<Store, Error> {
        build.run(&self.files(), &self.path(name), &()).map(|made| made.0)
    }
}

fn build() -> Build {
    Build::new().memory(MEMORY).tile(200).workers(2).heights(true)
}

/// The files of a folder by their names; of `tiles.json` what does not tell the time.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let read = |entry: fs::DirEntry| {
        (entry.file_name().to_string_lossy().into_owned(), fs::read(entry.path()).expect("readable"))
    };
    fs::read_dir(folder).expect("a folder").map(|entry| read(entry.expect("readable"))).collect()
}

#[test]
fn tiles_are_the_triangulation_of_all() {
    let place = Place::new(3000);
    let store = place.run(&build(), "tiles").expect("done");
    let xy: Vec<[f64; 2]> = points(3000).iter().map(|p| [p[0], p[1]]).collect();
    let d = Delaunay2::from_points(&xy).expect("finite");
    let summary = store.summary();
    assert_eq!(summary.fingerprint, Fingerprint::of(&d));
    assert_eq!((summary.points, summary.duplicates, summary.vertices), (3009, 9, 3000));
    assert_eq!(summary.triangles, d.triangle_count() as u64);
    assert!(summary.tiles > 10 && summary.of_seams > 0 && summary.joins > 0, "{summary:?}");
    let store = Store::open(place.path("tiles")).expect("done");
    store.verify(&()).expect("canonical");
    assert_eq!(store.summary(), summary);
    let found = describe(&place.path("tiles")).expect("tiles");
    assert_eq!((found.points, found.state), (3009, State::Done(summary)));
    let (mut count, mut of_tiles) = (0, 0);
    for tile in store.cuts().tiles() {
        let corners = store.points(tile).expect("points");
        count += corners.len();
        of_tiles += store.triangles(tile).expect("triangles").len() as u64;
        assert!(corners.iter().all(|([x, y], z)| points(3000).contains(&[*x, *y, *z])));
    }
    assert_eq!((count, of_tiles), (3000, summary.triangles - summary.of_seams));
}

#[test]
fn windows_have_the_triangles_of_all() {
    let place = Place::new(2000);
    let store = place.run(&build(), "tiles").expect("done");
    let xy: Vec<[f64; 2]> = points(2000).iter().map(|p| [p[0], p[1]]).collect();
    let d = Delaunay2::from_points(&xy).expect("finite");
    let window = Region { low: [1000.0, 1500.0], high: [2500.0, 2200.0] };
    let part = store.window(&window, &()).expect("a part");
    let (names, corners) = (part.names(), part.points());
    let name = |p: [f64; 2]| corners.iter().position(|&q| q == p).map(|k| names[k]);
    let mut shown = 0;
    for t in d.simplices() {
        let corners = d.corners(t).map(|v| d.point(v));
        let meets = (0..2).all(|k| {
            corners.iter().any(|p| p[k] >= window.low[k]) && corners.iter().any(|p| p[k] <= window.high[k])
        });
        let found = corners.map(name);
        let is_there = match found {
            [Some(a), Some(b), Some(c)] => part.tile_of([a, b, c]).is_some(),
            _ => false,
        };
        assert_eq!(is_there, meets, "{corners:?}");
        shown += usize::from(meets);
    }
    assert_eq!(part.triangle_count(), shown);
    assert_eq!(part.heights().len(), names.len());
    let few = store.overview(&Region::ALL, 10, &()).expect("an overview");
    assert!((150..400).contains(&few.points().len()) && few.triangle_count() == 0);
}

/// Against the triangulation of all points: places inside, on vertices, on edges and outside.
#[test]
fn places_are_in_the_triangles_of_all() {
    let place = Place::new(1500);
    let store = place.run(&build(), "tiles").expect("done");
    let xy: Vec<[f64; 2]> = points(1500).iter().map(|p| [p[0], p[1]]).collect();
    let d = Delaunay2::from_points(&xy).expect("finite");
    let mut places: Vec<[f64; 2]> =
        (0..400).map(|i| [f64::from(i * 37 % 5400) - 200.0, f64::from(i * 91 % 5300) - 150.5]).collect();
    places.extend(&xy[..100]);
    let middle = |e: [[f64; 2]; 2]| [0, 1].map(|k| f64::midpoint(e[0][k], e[1][k]));
    places.extend(d.edges().take(300).map(|[v, w]| middle([d.point(v), d.point(w)])));
    let known: BTreeMap<u32, Vec<[f64; 2]>> = (store.cuts().tiles().into_iter())
        .map(|tile| (tile.number(), store.points(tile).expect("points").iter().map(|c| c.0).collect()))
        .collect();
    let found = store.locate(&places, &()).expect("finite");
    let mut inside = 0;
    for (&q, found) in places.iter().zip(found) {
        let is_outside = matches!(d.locate(q), Ok(delone::Location2::Outside(_)));
        assert_eq!(found.is_none(), is_outside, "{q:?}");
        let Some(names) = found else { continue };
        inside += 1;
        let [a, b, c] = names.map(|name| known[&((name >> 32) as u32)][(name & 0xffff_ffff) as usize]);
        for (p, r) in [(a, b), (b, c), (c, a)] {
            assert!(!delone_predicates::orient2d(p, r, q).is_negative(), "{q:?} is not in {names:?}");
        }
        let is_one = d.triangles().any(|t| {
            let t = t.map(|v| d.point(v));
            [a, b, c].iter().all(|p| t.contains(p))
        });
        assert!(is_one, "{names:?} is no triangle of all");
    }
    assert!(inside > 500, "{inside}");
    let wrong = store.locate(&[[0.0, 0.0], [0.0, f64::NAN]], &()).expect_err("not finite");
    assert!(matches!(wrong, Error::Points { error: delone::Error::NotFinite { index: 1, axis: 1, .. }, .. }));
}

/// Ends work after some steps.
struct Stopper {
    left: AtomicUsize,
}

impl Watch for Stopper {
    fn advance(&self) {
        let less = |left: usize| left.checked_sub(1);
        _ = self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, less);
    }

    fn goes_on(&self) -> bool {
        self.left.load(Ordering::Relaxed) > 0
    }
}

#[test]
fn a_run_that_is_stopped_goes_on() {
    let place = Place::new(1500);
    let whole = build().neighbors(true);
    place.run(&whole, "whole").expect("done");
    let folder = place.path("parts");
    let mut stops = 0;
    for steps in 0.. {
        let watch = Stopper { left: AtomicUsize::new(steps) };
        match whole.clone().resume(true).run(&place.files(), &folder, &watch) {
            Ok(_) => break,
            Err(Error::Stopped) => stops += 1,
            Err(error) => panic!("{error}"),
        }
    }
    assert!(stops > 4, "{stops}");
    assert_eq!(contents(&place.path("whole")), contents(&folder));
    Store::open(&folder).expect("done").verify(&()).expect("canonical");
}

#[test]
fn requests_that_are_wrong_are_refused() {
    let place = Place::new(600);
    let refuse = |build: Build, name: &str| {
        let error = place.run(&build, name).expect_err("refused");
        assert!(error.is_usage() && !error.help().is_empty(), "{error}");
        error
    };
    assert!(matches!(refuse(build().memory(1 << 20), "a"), Error::LittleMemory { .. }));
    assert!(matches!(refuse(build().tile(0), "a"), Error::EmptyTiles));
    assert!(!place.path("a").exists());
    assert!(matches!(refuse(build(), "."), Error::NotEmpty { .. }));
    assert!(matches!(refuse(build().resume(true), "."), Error::NothingToResume { .. }));
    place.run(&build(), "a").expect("done");
    assert!(matches!(refuse(build(), "a"), Error::HasTiles { .. }));
    assert!(matches!(
        refuse(build().resume(true).apart(vec![place.path("a/x.json")]), "a"),
        Error::Inside { .. }
    ));
    let other = refuse(build().resume(true).heights(false), "a");
    assert!(matches!(other, Error::OtherInput { difference: Difference::Options, .. }));
    let lock = fs::File::open(place.path("a")).expect("a folder");
    lock.lock().expect("nobody else");
    assert!(matches!(refuse(build().resume(true), "a"), Error::Locked { .. }));
    drop(lock);
    let other = place.path("other.csv");
    fs::write(&other, "0,0,0\n").expect("room");
    let run =
        |files: &Files, build: Build| build.run(files, &place.path("a"), &()).map(drop).expect_err("refused");
    let error = run(&Files::new([&other]).expect("a format"), build().resume(true));
    assert!(matches!(error, Error::OtherInput { difference: Difference::Files, .. }));
    fs::write(&place.input, "0,0,0\n1,0,0\n").expect("room");
    let error = run(&place.files(), build().resume(true));
    assert!(matches!(error, Error::OtherInput { difference: Difference::Changed, .. }));
    let named = ReadOptions::default().dimensions(vec!["intensity".to_owned()]);
    assert!(matches!(run(&place.files().options(named), build()), Error::Attributes));
    let folder = Files::with_formats([(place.path("."), Format::Text)]);
    assert!(matches!(run(&folder, build()), Error::NotInPieces { .. }));
}

#[test]
fn points_that_are_wrong_are_named() {
    let place = Place::new(600);
    let run = |text: &str, heights: bool| {
        fs::write(&place.input, text).expect("room");
        place.run(&build().heights(heights), "a").expect_err("refused")
    };
    assert!(matches!(run("0,0\n1,1\n", true), Error::NoHeights { .. }));
    fs::remove_dir_all(place.path("a")).expect("ours");
    let error = run("0,0\n1,inf\n", false);
    assert!(matches!(error, Error::Points { error: delone::Error::NotFinite { index: 1, axis: 1, .. }, .. }));
    let error = run("0,0,nan\n1,1,2\n", true);
    assert!(matches!(error, Error::Points { error: delone::Error::Height { index: 0, .. }, .. }), "{error}");
    let error = run("0,0\nx,y\n", false);
    assert!(matches!(error, Error::Read { .. }) && error.to_string().contains("line 2"), "{error}");
    assert!(matches!(Files::new(["points.unknown"]), Err(Error::Read { .. })));
    assert!(matches!(Store::open(place.path("a")), Err(Error::NoTiles { .. })));
}

#[test]
fn every_change_of_a_folder_is_noticed() {
    let place = Place::new(900);
    let folder = place.path("a");
    place.run(&build().neighbors(true), "a").expect("done");
    let check = || Store::open(&folder).and_then(|store| store.verify(&()));
    check().expect("canonical");
    let files = contents(&folder);
    for (name, bytes) in files.iter().filter(|file| file.0 != "tiles.json") {
        let mut wrong = bytes.clone();
        let last = wrong.len() - 2;
        wrong[last] ^= 4;
        fs::write(folder.join(name), wrong).expect("ours");
        assert!(matches!(check(), Err(Error::Changed { .. })), "{name}");
        fs::write(folder.join(name), bytes).expect("ours");
    }
    check().expect("as it was");
    fs::write(folder.join("points-99999.npy"), "?").expect("ours");
    assert!(matches!(check(), Err(Error::Unknown { .. })));
    fs::remove_file(folder.join("points-99999.npy")).expect("ours");
    fs::write(folder.join("tiles.json"), "{}").expect("ours");
    assert!(matches!(check(), Err(Error::Manifest { .. })));
    let text = String::from_utf8(files["tiles.json"].clone()).expect("text");
    fs::write(folder.join("tiles.json"), text.replace("\"version\": 2", "\"version\": 3")).expect("ours");
    assert!(matches!(check(), Err(Error::Version { found: 3, known: 2, .. })));
}

#[test]
fn whoever_looks_on_hears_of_stages_and_may_refuse() {
    struct Listener(std::sync::Mutex<Vec<&'static str>>);
    impl Watch for Listener {
        fn stage(&self, name: &'static str) {
            self.0.lock().expect("one").push(name);
        }

        fn points(&self, _: &Path, count: u64) -> Result<(), Error> {
            if count > 1000 { Err(Error::Outside("too many".into())) } else { Ok(()) }
        }
    }
    let run = |count: u32| {
        let (place, watch) = (Place::new(count), Listener(std::sync::Mutex::default()));
        let made = build().run(&place.files(), &place.path("a"), &watch).map(drop);
        (made, watch.0.into_inner().expect("one"))
    };
    let (made, stages) = run(500);
    assert!(made.is_ok() && stages == ["read", "distribute", "build", "join"]);
    let (made, stages) = run(2000);
    assert!(stages.is_empty() && made.expect_err("too many").to_string() == "too many");
}
