//! Octrees of LiDAR points (COPC and EPT), boxes of them, and dimensions of records.
//!
//! The files are of other programs: `data/lidar/make.py` writes them with laspy and lazrs.

use std::fs::File;
use std::io::{BufReader, Cursor, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use delone_io::{
    Cloud, Error, Format, LasFilter, LasFlag, ReadOptions, Returns, Source, Value, read_chunks_beside,
    read_points, read_points_beside,
};

/// All kinds of trees of the same points.
const TREES: [&str; 4] = ["small.copc.laz", "laszip/ept.json", "binary/ept.json", "zstandard/ept.json"];

const BOX: [f64; 4] = [1010.0, 2010.0, 1030.25, 2040.0];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/lidar")
}

/// Opens a file of a folder by its path there.
fn beside(folder: PathBuf) -> impl FnMut(&str) -> Result<Box<dyn Source>, Error> {
    move |name| Ok(Box::new(BufReader::new(File::open(folder.join(name))?)))
}

fn try_read(name: &str, options: &ReadOptions) -> Result<Cloud, Error> {
    let path = folder().join(name);
    let source = Box::new(BufReader::new(File::open(&path)?));
    let mut beside = beside(path.parent().expect("a folder").to_owned());
    read_points_beside(source, Format::of(&path)?, options, &mut beside)
}

fn read(name: &str, options: &ReadOptions) -> Cloud {
    try_read(name, options).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn of(las: LasFilter) -> ReadOptions {
    ReadOptions::default().las(las)
}

fn in_box(within: [f64; 4]) -> ReadOptions {
    of(LasFilter::default().within(Some(within)))
}

/// All points, with columns that are named.
fn columns(names: &str) -> ReadOptions {
    of(LasFilter::default().withheld(true)).columns(names.split(','))
}

/// The points with their heights, in one order.
fn sorted(cloud: &Cloud) -> Vec<[f64; 3]> {
    let heights = cloud.z.as_ref().expect("heights");
    let mut all: Vec<[f64; 3]> = cloud.xy.iter().zip(heights).map(|(&[x, y], &z)| [x, y, z]).collect();
    all.sort_unstable_by(|p, q| p.partial_cmp(q).expect("finite"));
    all
}

#[test]
fn trees_have_the_points_of_the_file() {
    let plain = LasFilter::default;
    let filters = [
        plain(),
        plain().withheld(true),
        plain().classes(vec![2]),
        plain().returns(Returns::Last).skip(vec![LasFlag::Overlap]),
        plain().heights(Some([25.0, 30.0])).within(Some(BOX)),
        plain().within(Some(BOX)),
        plain().within(Some([0.0, 0.0, 9.0, 9.0])),
    ];
    for filter in filters {
        let options = of(filter);
        let whole = read("small.laz", &options);
        for name in TREES {
            let tree = read(name, &options);
            assert_eq!(sorted(&tree), sorted(&whole), "{name} {options:?}");
            assert_eq!((&tree.classes, tree.flags), (&whole.classes, whole.flags), "{name}");
            let is_far = options.las.within.is_some_and(|within| within[0] < 1.0);
            let number = tree.crs.and_then(|crs| crs.epsg);
            assert!(number == Some(25832) || is_far, "{name}: {number:?}");
        }
    }
}

#[test]
fn a_box_is_a_filter_of_all_points() {
    let all = sorted(&read("small.laz", &of(LasFilter::default())));
    let [x, y, _] = all[100];
    // The border counts: a box that is a point of the file has it.
    for within in [BOX, [x, y, x, y], [1000.0, 2000.0, 1128.0, 2128.0], [x, 0.0, x, 9999.0]] {
        let [x0, y0, x1, y1] = within;
        let is_inside = |p: &&[f64; 3]| x0 <= p[0] && p[0] <= x1 && y0 <= p[1] && p[1] <= y1;
        let expected: Vec<_> = all.iter().filter(is_inside).copied().collect();
        assert!(!expected.is_empty());
        for name in ["small.laz"].iter().chain(&TREES) {
            assert_eq!(sorted(&read(name, &in_box(within))), expected, "{name} {within:?}");
        }
    }
}

/// Kept points are in the order of the file, or of the nodes, whatever the box.
#[test]
fn a_box_keeps_the_order() {
    for name in TREES {
        let (all, some) = (read(name, &of(LasFilter::default())), read(name, &in_box(BOX)));
        let mut rest = all.xy.iter();
        assert!(some.xy.len() > 20 && some.xy.iter().all(|p| rest.any(|q| p == q)), "{name}");
    }
}

#[test]
fn points_in_chunks_are_those_at_once() {
    for name in TREES {
        let (options, path) = (in_box(BOX), folder().join(name));
        let whole = read(name, &options);
        let (mut xy, mut z) = (Vec::new(), Vec::new());
        let source = Box::new(BufReader::new(File::open(&path).expect("a file")));
        let mut beside = beside(path.parent().expect("a folder").to_owned());
        let mut take = |points: &[[f64; 2]], heights: Option<&[f64]>| {
            xy.extend_from_slice(points);
            z.extend_from_slice(heights.unwrap_or_default());
            Ok(())
        };
        let format = Format::of(&path).expect("a format");
        let rest = read_chunks_beside(source, format, &options, 7, &mut take, &mut beside).expect(name);
        assert_eq!((xy, Some(z), rest.classes), (whole.xy, whole.z, whole.classes), "{name}");
    }
}

/// A file that counts the bytes that are read.
struct Watched(Cursor<Vec<u8>>, Arc<AtomicU64>);

impl Read for Watched {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let count = self.0.read(buffer)?;
        self.1.fetch_add(count as u64, Ordering::Relaxed);
        Ok(count)
    }
}

impl Seek for Watched {
    fn seek(&mut self, to: SeekFrom) -> std::io::Result<u64> {
        self.0.seek(to)
    }
}

#[test]
fn a_small_box_of_copc_reads_few_bytes() {
    let bytes = std::fs::read(folder().join("small.copc.laz")).expect("a file");
    let read = |options: &ReadOptions| {
        let count = Arc::new(AtomicU64::new(0));
        let source = Watched(Cursor::new(bytes.clone()), Arc::clone(&count));
        let cloud = read_points(Box::new(BufReader::with_capacity(64, source)), Format::Las, options);
        (count.load(Ordering::Relaxed), cloud.expect("a file").remarks)
    };
    let (all, _) = read(&of(LasFilter::default()));
    let (some, remarks) = read(&in_box([1120.0, 2001.0, 1121.0, 2002.0]));
    assert!(all >= bytes.len() as u64 * 9 / 10, "{all} of {}", bytes.len());
    assert!(2 * some < all, "{some} of {all} bytes");
    let said = &remarks[0];
    assert!(said.contains(" of 32 nodes are read") && said.ends_with("bytes of points"), "{said}");
}

#[test]
fn an_ept_opens_the_nodes_of_a_box_alone() {
    let folder = folder().join("laszip");
    let opened = |options: &ReadOptions| {
        let mut names = Vec::new();
        let mut files = beside(folder.clone());
        let mut open = |name: &str| {
            names.push(name.to_owned());
            files(name)
        };
        let source = Box::new(BufReader::new(File::open(folder.join("ept.json")).expect("a file")));
        read_points_beside(source, Format::Ept, options, &mut open).expect("an EPT");
        names
    };
    assert_eq!(opened(&of(LasFilter::default())).len(), 34);
    let some = opened(&in_box([1120.0, 2001.0, 1121.0, 2002.0]));
    let nodes = some.iter().filter(|name| name.starts_with("ept-data")).count();
    assert!((1..10).contains(&nodes) && some.len() - nodes < 2, "{some:?}");
}

#[test]
fn dimensions_are_heights() {
    // Each point has a time of its own.
    let of_name = |file: &str, name: &str| {
        let read = |name: &str| read(file, &columns(&format!("x,y,{name}"))).z.expect("heights");
        let mut all: Vec<(f64, f64)> = read("gps_time").into_iter().zip(read(name)).collect();
        all.sort_unstable_by(|p, q| p.0.total_cmp(&q.0));
        assert!(all.len() == 600 && all.is_sorted_by(|p, q| p.0 < q.0));
        all
    };
    for name in ["intensity", "Pulse", "Normal[2]", "scan_angle", "classification", "red", "GpsTime"] {
        let expected = of_name("small.laz", name);
        for file in ["small.copc.laz", "laszip/ept.json"] {
            assert_eq!(of_name(file, name), expected, "{file} {name}");
        }
    }
    // What laspy has read of the same records.
    for name in ["Intensity", "return_number", "NumberOfReturns", "Classification", "Pulse", "red", "overlap"]
    {
        assert_eq!(of_name("zstandard/ept.json", name), of_name("small.laz", name), "{name}");
    }
    let by_place = |file| sorted(&read(file, &columns("x,y,Reflectance")));
    let (values, mut of_laspy) = (by_place("small.laz"), by_place("binary/ept.json"));
    // Without what stands for no value, which laspy takes for one.
    of_laspy.retain(|p| p[2] > -300.0);
    assert_eq!((values, of_laspy.len()), (of_laspy.clone(), 588));
    let cloud = read("small.laz", &columns("x,y,Reflectance"));
    assert_eq!(cloud.xy.len(), 588);
    assert_eq!(cloud.losses, ["12 points without a value of Reflectance are left out"]);
    assert_eq!(read("small.laz", &columns("x,y")).z, None);
    let all = of(LasFilter::default().withheld(true));
    assert_eq!(read("small.laz", &columns("X,Y,Z")), read("small.laz", &all));
}

#[test]
fn names_that_are_not_there_are_told_with_those_that_are() {
    let said = |names| try_read("small.laz", &columns(names)).expect_err(names);
    let error = said("x,y,nir");
    assert!(matches!(&error, Error::NoDimension { name, .. } if name == "nir"));
    let text = error.to_string();
    assert!(text.starts_with("its points have no nir, but intensity, return_number, "), "{text}");
    let end = "gps_time, red, green, blue, Reflectance, Normal[0], Normal[1], Normal[2], Pulse";
    assert!(text.ends_with(end), "{text}");
    assert_eq!(said("y,x,z").to_string(), "LAS: the first columns are x and y");
    assert_eq!(said("x,y,z,intensity").to_string(), "LAS: columns are x, y and one for the height");
}

#[test]
fn dimensions_are_attributes() {
    for name in ["small.laz"].iter().chain(&TREES) {
        let dimensions = ["gps_time", "Reflectance", "Pulse", "gps_time"].map(str::to_owned).to_vec();
        let options = in_box(BOX).dimensions(dimensions).attributes(true);
        let cloud = read(name, &options);
        let table = &cloud.features.table;
        assert_eq!(table.names(), ["gps_time", "Reflectance", "Pulse"]);
        let times = in_box(BOX).columns(columns("x,y,gps_time").columns);
        let times = read(name, &times).z.expect("times");
        let of_row = |row| table.value(row, 0);
        assert_eq!(
            (0..table.len()).map(of_row).collect::<Vec<_>>(),
            times.into_iter().map(Value::Number).collect::<Vec<_>>(),
            "{name}"
        );
        assert!((0..cloud.xy.len()).all(|point| cloud.features.row(point) == Some(point)));
        let names_alone = read(name, &options.attributes(false));
        assert_eq!((names_alone.features.table.names().len(), names_alone.features.table.len()), (3, 0));
    }
}

#[test]
fn extra_bytes_are_told() {
    let cloud = read("small.laz", &of(LasFilter::default()));
    let told: Vec<String> = cloud.dimensions.iter().map(|(name, kind)| format!("{name} {kind}")).collect();
    let expected = [
        "Reflectance int16 times 0.01 plus -5.0, no data -32768",
        "Normal[0] float32",
        "Normal[1] float32",
        "Normal[2] float32",
        "Pulse uint64",
    ];
    assert_eq!(told, expected);
    assert_eq!(read("laszip/ept.json", &of(LasFilter::default())).dimensions, cloud.dimensions);
}

#[test]
fn a_file_of_which_nothing_is_taken_says_so() {
    let none = read("small.laz", &of(LasFilter::default().classes(vec![9])));
    assert_eq!(none.remarks, ["none of its 600 points is taken"]);
    let beyond = read("small.laz", &in_box([0.0; 4]));
    assert!(beyond.remarks.is_empty() && beyond.classes.is_empty());
}

/// The error of a COPC file with other bytes at some place.
fn of_broken(at: usize, with: &[u8]) -> String {
    let mut bytes = std::fs::read(folder().join("small.copc.laz")).expect("a file");
    bytes[at..at + with.len()].copy_from_slice(with);
    let options = in_box([1000.0, 2000.0, 1128.0, 2128.0]);
    match read_points(Box::new(Cursor::new(bytes)), Format::Las, &options) {
        Ok(cloud) => format!("{} points", cloud.xy.len()),
        Err(error) => error.to_string(),
    }
}

#[test]
fn hierarchies_of_copc_that_contradict_themselves_are_refused() {
    const ROOT: usize = 375 + 54 + 40;
    let bytes = std::fs::read(folder().join("small.copc.laz")).expect("a file");
    let page = u64::from_le_bytes(bytes[ROOT..ROOT + 8].try_into().expect("eight bytes")) as usize;
    // The last entry of the first page names another page.
    let last = bytes.len() - 32;
    let says = |at, with: &[u8], end: &str| {
        let said = of_broken(at, with);
        assert!(said.ends_with(end), "{said}");
    };
    says(0, b"LASF", "570 points");
    says(last + 16, &(page as u64).to_le_bytes(), &format!("at byte {page} is in it twice"));
    says(last + 16, &u64::MAX.to_le_bytes(), "reaches beyond the file");
    says(last + 24, &33_i32.to_le_bytes(), "has another length than its entries");
    says(last + 28, &(-2_i32).to_le_bytes(), "has a length or a number of points that is none");
    says(page, &77_i32.to_le_bytes(), "has a node that is none");
    says(page + 28, &9_i32.to_le_bytes(), "node 0-0-0-0 of its hierarchy is none of its chunks");
    says(ROOT, &u64::MAX.to_le_bytes(), "reaches beyond the file");
    says(page + 32, &bytes[page..page + 32], "two nodes of its hierarchy are one chunk");
}

/// The error of an EPT in which one file has another text.
fn of_changed(kind: &str, name: &str, with: &str) -> String {
    let folder = folder().join(kind);
    let mut beside = beside(folder.clone());
    let mut open = |asked: &str| -> Result<Box<dyn Source>, Error> {
        if asked == name { Ok(Box::new(Cursor::new(with.to_owned()))) } else { beside(asked) }
    };
    let text = std::fs::read_to_string(folder.join("ept.json")).expect("a text");
    let text = if name == "ept.json" { with.to_owned() } else { text };
    match read_points_beside(Box::new(Cursor::new(text)), Format::Ept, &ReadOptions::default(), &mut open) {
        Ok(cloud) => format!("{} points, {:?}", cloud.xy.len(), cloud.losses),
        Err(error) => error.to_string(),
    }
}

#[test]
fn trees_in_files_that_contradict_themselves_are_refused() {
    let says = |kind, name, with: &str, end: &str| {
        let said = of_changed(kind, name, with);
        assert!(said.ends_with(end), "{said}");
    };
    for (kind, with, end) in [
        ("laszip", r#"{"0-0-0-0": -1}"#, "0-0-0-0.json leads to the hierarchy of 0-0-0-0 again"),
        ("laszip", r#"{"0-0-0-0": -7}"#, "0-0-0-0 has no number of points"),
        ("laszip", r#"{"0-0-0-0": 1e300}"#, "0-0-0-0 has no number of points"),
        ("laszip", r#"{"../../x": 4}"#, "\"../../x\" is no node"),
        ("laszip", "[]", "0-0-0-0.json is no object"),
        ("laszip", r#"{"0-0-0-0": 41}"#, "node 0-0-0-0: EPT: it has 40 points, 41 by the hierarchy"),
        ("laszip", r#"{"0-0-0-0": 40}"#, "[\"its nodes have 40 points, 600 are told of\"]"),
        ("laszip", r#"{"5-0-0-0": 40}"#, "(os error 2)"),
        ("binary", r#"{"0-0-0-0": 9000000000000000000}"#, "node 0-0-0-0: EPT: it has too many points"),
        ("binary", r#"{"0-0-0-0": 41}"#, "it has 1800 bytes, 41 points have 1845"),
        ("zstandard", r#"{"0-0-0-0": 39}"#, "it has other than the 1755 bytes of 39 points"),
        ("zstandard", r#"{"0-0-0-0": 41}"#, "it has other than the 1845 bytes of 41 points"),
    ] {
        says(kind, "ept-hierarchy/0-0-0-0.json", with, end);
    }
    let schema = r#"{"dataType": "binary", "bounds": [0,0,0,1,1,1],
        "schema": [{"name": "X", "type": "float", "size": 3}]}"#;
    for (with, end) in [
        (r#"{"dataType": "zip"}"#, "EPT: nodes of the type \"zip\" are not read"),
        ("{}", "EPT: ept.json has no dataType"),
        (r#"{"dataType": "laszip", "hierarchyType": "gzip"}"#, "of the type \"gzip\" is not read"),
        (r#"{"dataType": "laszip", "bounds": [1]}"#, "its bounds are not six numbers"),
        (schema, "the field X of its schema is \"float\" of 3 bytes"),
        ("[", "EPT: ept.json is no JSON: EOF while parsing a list at line 1 column 1"),
    ] {
        says("binary", "ept.json", with, end);
    }
    let alone = schema.replace(": 3", ": 4");
    let alone = read_points(Box::new(Cursor::new(alone)), Format::Ept, &ReadOptions::default());
    assert_eq!(alone.unwrap_err().to_string(), "EPT: its points are in files beside it, which are not known");
}
