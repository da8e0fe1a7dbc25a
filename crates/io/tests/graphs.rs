//! Graphs of points and segments: every format that has them, and what is wrong with files that are broken.

use std::io::Cursor;

use delone::RegionSeed2;
use delone_io::{
    Beside, Cloud, Crs, Error, Format, Graph, GraphRing, ReadOptions, Source, read_areas, read_graph,
    read_points, read_rings, read_segments, read_triangle_attributes, read_triangles, write_graph,
};

fn source(content: impl AsRef<[u8]>) -> Box<dyn Source> {
    Box::new(Cursor::new(content.as_ref().to_vec()))
}

fn graph(format: Format, content: impl AsRef<[u8]>) -> Result<Graph, Error> {
    read_graph(source(content), format, &ReadOptions::default(), None)
}

fn good(format: Format, content: impl AsRef<[u8]>) -> Graph {
    graph(format, content).unwrap_or_else(|error| panic!("{format}: {error}"))
}

/// A square with a hole and a region, in all detail.
const SQUARE: &str = "# by hand
5 2 2 1
1 0 0  10 0.5  7   # a corner
2 4 0  20 0.5  7
3 4 4  30 0.5  7
4 0 4  40 0.5  7

5 2 2  50 0.5
5 1
1 1 2 3
2 2 3 3
3 3 4
4 4 1 3
5 1 3 -9
1
1 3 1
2
1 1 3 6.5 0.25
2 1 1 7.5 -1
";

#[test]
fn polys_are_read_and_written_whole() {
    let square = good(Format::Poly, SQUARE);
    assert_eq!(square.cloud.xy, [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [2.0, 2.0]]);
    assert_eq!(square.cloud.z, Some(vec![10.0, 20.0, 30.0, 40.0, 50.0]));
    assert_eq!(
        (square.cloud.base, square.attributes.width, square.attributes.row(1)),
        (1, 2, &[20.0, 0.5][..])
    );
    assert_eq!(square.point_markers, Some(vec![7, 7, 7, 7, 0]));
    assert_eq!(square.segments, [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]]);
    assert_eq!((square.is_border.len(), square.markers.clone()), (5, Some(vec![3, 3, 0, 3, -9])));
    assert_eq!(square.holes, [[3.0, 1.0]]);
    let region = RegionSeed2::new([1.0, 3.0]).attribute(6.5).max_area(0.25);
    assert_eq!(square.regions, [region, RegionSeed2::new([1.0, 1.0]).attribute(7.5)]);
    let mut written = Vec::new();
    write_graph(&mut written, Format::Poly, &square).expect("memory takes it");
    assert_eq!(good(Format::Poly, &written), square);
    assert!(matches!(write_graph(&mut written, Format::Ply, &square), Err(Error::Unsupported { .. })));
    // From 0, without markers; heights of other formats are an attribute.
    let plain = Graph {
        cloud: Cloud { z: Some(vec![1.5, 2.5]), xy: vec![[0.0; 2], [1.0; 2]], ..Cloud::default() },
        segments: vec![[1, 0]],
        is_border: vec![true],
        ..Graph::default()
    };
    let mut written = Vec::new();
    write_graph(&mut written, Format::Poly, &plain).expect("memory takes it");
    assert_eq!(String::from_utf8_lossy(&written), "2 2 1 0\n0 0.0 0.0 1.5\n1 1.0 1.0 2.5\n1 0\n0 1 0\n0\n");
    // As points, the same corners.
    let points = read_points(source(SQUARE), Format::Poly, &ReadOptions::default()).expect("points");
    assert_eq!((points.xy, points.z), (square.cloud.xy, square.cloud.z));
    // One value of a region is both, as in Triangle.
    let alone = good(Format::Poly, "1 2 0 0\n0 0 0\n0 0\n0\n1\n1 6 -0.2 0.05\n");
    assert_eq!(alone.regions, [RegionSeed2::new([6.0, -0.2]).attribute(0.05).max_area(0.05)]);
    assert_eq!(alone.cloud.remarks.len(), 1);
}

#[test]
fn points_may_be_beside() {
    let segments = "0 2 0 0\n1 0\n1 1 2\n0\n";
    let mut asked = Vec::new();
    let mut open = |extension: &str| {
        asked.push(extension.to_owned());
        Ok(source("2 2 1 0\n1 0 0 5\n2 1 1 6\n"))
    };
    let beside: Beside = &mut open;
    let both =
        read_graph(source(segments), Format::Poly, &ReadOptions::default(), Some(beside)).expect("both");
    assert_eq!((both.segments, both.attributes.values, both.cloud.base), (vec![[0, 1]], vec![5.0, 6.0], 1));
    assert_eq!(asked, ["node"]);
    assert!(matches!(graph(Format::Poly, segments), Err(Error::PointsElsewhere)));
    let points = read_points(source(segments), Format::Poly, &ReadOptions::default());
    assert!(matches!(points, Err(Error::PointsElsewhere)));
    let mut none = |_: &str| Ok(source("0 2 0 0\n"));
    let error = read_graph(source(segments), Format::Poly, &ReadOptions::default(), Some(&mut none));
    assert_eq!(error.expect_err("no points").to_string(), "line 3: a segment, but there are no points");
    // Points from 0 beside segments from 1.
    let mut from_zero = |_: &str| Ok(source("2 2 0 0\n0 0 0\n1 1 1\n"));
    let error = read_graph(source(segments), Format::Poly, &ReadOptions::default(), Some(&mut from_zero));
    let message = error.expect_err("two bases").to_string();
    assert_eq!(
        message,
        "line 3: there is no point 2: they are numbered from 0 to 1; do the segments count from 1?"
    );
}

#[test]
fn broken_polys_are_named() {
    let points = "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n";
    for (rest, message) in [
        ("", "the file ends before the number of segments"),
        ("2 0\n1 1 2\n", "the file ends after 1 of 2 segments"),
        ("1 0\n1 1 2\n", "the file ends before the number of holes"),
        ("1 0\n1 1 2\n2\n1 0 0\n", "the file ends after 1 of 2 holes"),
        ("1 0\n1 1 2\n0\n3\n1 0 0 1 1\n", "the file ends after 1 of 3 regions"),
        ("1 0\n1 1 2\n2 2 3\n0\n", "line 7: 3 numbers where the number of holes is expected"),
        ("2 0\n1 1 2\n0\n", "line 7: an end of the segment is missing"),
        ("1 0\n1 1 2\n0\n0\n9 9 9\n", "line 9: more follows than the counts before it say"),
        ("1 0\n1 0 2\n0\n", "line 6: a segment ends at point 0 in a file that counts from 1"),
        ("1 0\n1 1 4\n0\n", "line 6: there is no point 4: they are numbered from 1 to 3"),
        ("1 0\n1 1 -2\n0\n", "line 6: an end of the segment is \"-2\", not a number of the kind expected"),
        ("1 0\n1 1 nan\n0\n", "line 6: an end of the segment is \"nan\", not a number of the kind expected"),
        ("1 0\n1 1 18446744073709551615\n0\n", "line 6: there is no point 18446744073709551615"),
        ("1 1\n1 1 2 x\n0\n", "line 6: the marker is \"x\""),
        ("18446744073709551615 1\n1 1 2 0\n", "the file ends after 1 of 18446744073709551615 segments"),
        ("1 0\n1 1 2\n18446744073709551615\n1 0 0\n", "the file ends after 1 of 18446744073709551615 holes"),
        ("1 0\n1 1 2\n1\n1 0\n", "line 8: y is missing"),
        ("1 0\n1 1 2\n0\n1\n1 0 0\n", "line 9: the attribute is missing"),
        ("many\n", "line 5: the number of segments is \"many\""),
    ] {
        let error = graph(Format::Poly, format!("{points}{rest}")).expect_err(rest).to_string();
        assert!(error.starts_with(message), "{rest:?}: {error}");
    }
    for (content, message) in [
        ("", "the file has no header line"),
        ("3 2 0 0\n0 0 0\n2 1 0\n", "line 3: the index is 2 where 1 follows"),
        ("1 3 0 0\n1 0 0 0\n", "its points are in space"),
        ("1 2 18446744073709551615 0\n1 0 0 0\n", "line 2: an attribute is missing"),
        ("1\0", "line 1: it is not text"),
    ] {
        let error = graph(Format::Poly, content).expect_err(content).to_string();
        assert!(error.starts_with(message), "{content:?}: {error}");
    }
    // Cut anywhere, it is an error or says the same of what there still is.
    let all = good(Format::Poly, SQUARE);
    for end in 0..SQUARE.len() {
        if let Ok(part) = graph(Format::Poly, &SQUARE[..end]) {
            assert_eq!((part.cloud.xy, part.segments), (all.cloud.xy.clone(), all.segments.clone()), "{end}");
        }
    }
    // Coordinates are for the triangulation to judge.
    assert!(good(Format::Poly, "1 2 0 0\n0 nan inf\n0 0\n1\n0 nan 0\n").cloud.xy[0][0].is_nan());
}

/// A square with a triangular hole, beside a line.
fn square_and_line() -> Graph {
    let xy = [[0, 0], [8, 0], [8, 8], [0, 8], [2, 2], [2, 4], [4, 2], [9, 9], [10, 9], [10, 10]];
    let mut is_border = vec![true; 7];
    is_border.resize(9, false);
    Graph {
        cloud: Cloud { xy: xy.iter().map(|p| p.map(f64::from)).collect(), ..Cloud::default() },
        segments: vec![[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4], [7, 8], [8, 9]],
        is_border,
        rings: vec![
            GraphRing { polygon: 0, ring: 0, segments: 0..4 },
            GraphRing { polygon: 0, ring: 1, segments: 4..7 },
        ],
        ..Graph::default()
    }
}

/// Well-known binary, little or big endian, with a system or not.
struct Binary {
    bytes: Vec<u8>,
    big: bool,
}

impl Binary {
    fn number(&mut self, value: u32) {
        self.bytes.extend(if self.big { value.to_be_bytes() } else { value.to_le_bytes() });
    }

    fn begin(&mut self, kind: u32, system: Option<u32>) {
        self.bytes.push(u8::from(!self.big));
        self.number(kind | if system.is_some() { 1 << 29 } else { 0 });
        system.into_iter().for_each(|system| self.number(system));
    }

    fn positions(&mut self, all: &[[f64; 2]]) {
        self.number(all.len() as u32);
        for x in all.as_flattened() {
            self.bytes.extend(if self.big { x.to_be_bytes() } else { x.to_le_bytes() });
        }
    }
}

fn binary(big: bool, system: Option<u32>, closed: bool) -> Vec<u8> {
    let xy = square_and_line().cloud.xy;
    let mut out = Binary { bytes: Vec::new(), big };
    out.begin(3, system);
    out.number(2);
    for ring in [0..4, 4..7] {
        let first = xy[ring.start];
        let mut ring = xy[ring].to_vec();
        ring.extend(closed.then_some(first));
        out.positions(&ring);
    }
    out.begin(2, system);
    out.positions(&xy[7..]);
    out.bytes
}

#[test]
fn geometries_have_one_meaning_in_all_formats() {
    let text = "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (2 2, 2 4, 4 2, 2 2))\n\n# a line\nLINESTRING(9 9, 10 9, 10 10)\n";
    let system = text.replace("POLYGON", "SRID=25832;POLYGON").replace("LINE", "srid=25832; LINE");
    let collection = "geometrycollection(Polygon((0 0, 8 0, 8 8, 0 8, 0 0), (2 2, 2 4, 4 2, 2 2)),\
        MULTILINESTRING ((9 9, 10 9, 10 10)))";
    let json = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":null,"geometry":
        {"type":"Polygon","coordinates":[[[0,0],[8,0],[8,8],[0,8],[0,0]],[[2,2],[2,4],[4,2],[2,2]]]}},
        {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[9,9],[10,9],[10,10]]}}]}"#;
    let hex: String = binary(true, Some(25_832), true).iter().map(|byte| format!("{byte:02X}")).collect();
    let crs = Some(Crs::of_epsg(25_832));
    for (format, content, system) in [
        (Format::Wkt, text.as_bytes().to_vec(), None),
        (Format::Wkt, system.into_bytes(), crs.clone()),
        (Format::Wkt, collection.as_bytes().to_vec(), None),
        (Format::Wkb, binary(false, None, true), None),
        (Format::Wkb, binary(true, None, true), None),
        (Format::Wkb, binary(false, Some(25_832), true), crs.clone()),
        (Format::Wkb, format!("\\x{}\n", hex.to_lowercase()).into_bytes(), crs.clone()),
        (Format::Wkb, hex.into_bytes(), crs),
        (Format::GeoJson, json.as_bytes().to_vec(), None),
    ] {
        let found = good(format, &content);
        let points = read_points(source(&content), format, &ReadOptions::default()).expect("points");
        assert_eq!(
            (&points.xy, &points.crs, &found.cloud.crs),
            (&found.cloud.xy, &system, &system),
            "{format}"
        );
        assert_eq!(points.remarks, ["the corners of 2 lines and polygons were taken as points"]);
        let rings = read_rings(source(&content), format).expect("rings").rings;
        assert_eq!(rings, [&points.xy[..4], &points.xy[4..7]], "{format}");
        let mut expected = square_and_line();
        expected.cloud.crs = system;
        assert_eq!(found, expected, "{format}");
    }
}

#[test]
fn heights_and_special_rings() {
    let high = "{\"type\":\"LineString\",\"coordinates\":[[0,0,5],[1,0,6]]}";
    assert_eq!(good(Format::GeoJson, high).cloud.z, Some(vec![5.0, 6.0]));
    let some = "{\"type\":\"LineString\",\"coordinates\":[[0,0,5],[1,0]]}";
    let some = good(Format::GeoJson, some).cloud;
    assert_eq!((some.z, some.losses.len()), (None, 1));
    // Rings that are a point, a segment, nothing.
    let small = good(Format::Wkt, "MULTIPOLYGON (((1 1, 1 1)), ((1 1, 2 2, 1 1)), EMPTY, ((3 3)))");
    assert_eq!((small.cloud.xy.len(), small.segments), (4, vec![[1, 2], [2, 1]]));
    assert_eq!(small.rings.iter().map(|ring| ring.polygon).collect::<Vec<_>>(), [0, 1, 2]);
    // Bare coordinates close their rings; a position alone is a point.
    for bare in ["[[[0,0],[4,0],[0,4]],[[1,1]]]", " [[[[0,0],[4,0],[0,4],[0,0]],[[1,1]]]]"] {
        let bare = good(Format::GeoJson, bare);
        assert_eq!((bare.cloud.xy.len(), bare.segments), (4, vec![[0, 1], [1, 2], [2, 0]]));
    }
    let points = |text: &str| read_points(source(text), Format::GeoJson, &ReadOptions::default());
    assert_eq!(points("[[0,0,1],[4,0,2]]").expect("points").z, Some(vec![1.0, 2.0]));
    // Formats without segments.
    assert_eq!(good(Format::Text, "x,y\n1,2\n3,4\n").cloud.xy.len(), 2);
    assert_eq!(good(Format::Node, "1 2 1 1\n0 1 2 3 4\n").point_markers, Some(vec![4]));
}

/// Heights and measures by the flags of EWKB and by the thousands of OGC.
#[test]
fn positions_of_well_known_binary_are_two_to_four_numbers() {
    for (kind, heights) in [
        (2_u32, false),
        (2 | 1 << 31, true),
        (2 | 1 << 30, false),
        (2 | 3 << 30, true),
        (1002, true),
        (2002, false),
        (3002, true),
    ] {
        let width = match kind {
            2 => 2,
            3002 => 4,
            _ if kind == (2 | 3 << 30) => 4,
            _ => 3,
        };
        for big in [false, true] {
            let mut out = Binary { bytes: vec![u8::from(!big)], big };
            out.number(kind);
            out.number(2);
            for i in 0..2 * width {
                let x = f64::from(i);
                out.bytes.extend(if big { x.to_be_bytes() } else { x.to_le_bytes() });
            }
            let found = good(Format::Wkb, &out.bytes).cloud;
            let step = f64::from(width);
            assert_eq!(found.xy, [[0.0, 1.0], [step, step + 1.0]], "{kind}");
            assert_eq!(found.z, heights.then(|| vec![2.0, step + 2.0]), "{kind}");
        }
    }
}

#[test]
fn broken_geometries_are_named() {
    let open = |error: Error| matches!(error, Error::OpenRing { polygon: 0, ring: 0, .. });
    assert!(open(graph(Format::Wkb, binary(false, None, false)).expect_err("open")));
    let json = "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[8,0],[8,8]]]}";
    assert!(open(graph(Format::GeoJson, json).expect_err("open")));
    assert_eq!(
        read_points(source(json), Format::GeoJson, &ReadOptions::default()).expect("points").xy.len(),
        3
    );
    for (content, message) in [
        ("[[0,0],[1,1]]", "JSON: positions alone may be points, a line or a ring"),
        ("[[[0,0],[1,1]],[[0]]]", "JSON: position 2 is not two or three numbers"),
        ("[[[0,0],[1,null]]]", "JSON: position 1 is not two or three numbers"),
        ("[[[0,0],3]]", "JSON: a number where an array is expected"),
        ("[[[[[0,0]]]]]", "JSON: an array that is neither"),
        ("[[[0,0],[1,", "JSON: EOF"),
        ("", "GeoJSON: the file is empty"),
        ("{\"type\":\"LineString\",\"coordinates\":[[0,0],[1]]}", "GeoJSON"),
    ] {
        let error = graph(Format::GeoJson, content).expect_err(content).to_string();
        assert!(error.starts_with(message), "{content:?}: {error}");
    }
    assert!(graph(Format::GeoJson, "[".repeat(1_000_000)).is_err());
    let nested = "{\"type\":\"GeometryCollection\",\"geometries\":[".repeat(100_000);
    assert!(graph(Format::GeoJson, nested).is_err());
    assert!(graph(Format::Wkt, "GEOMETRYCOLLECTION(".repeat(100_000)).is_err());
    // A hundred thousand collections in each other, and counts of what is not there.
    let nested: Vec<u8> = [1, 7, 0, 0, 0, 1, 0, 0, 0].repeat(100_000);
    assert!(graph(Format::Wkb, nested).is_err());
    for kind in 1..=7 {
        for high in [0, 0x80] {
            assert!(graph(Format::Wkb, [1, kind, 0, 0, high, 0xff, 0xff, 0xff, 0xff]).is_err(), "{kind}");
        }
    }
    let whole = binary(true, Some(4326), true);
    let is_whole = |end| graph(Format::Wkb, &whole[..end]).is_ok();
    let ends: Vec<usize> = (1..=whole.len()).filter(|&end| is_whole(end)).collect();
    assert_eq!(ends.len(), 2, "it ends after each of its geometries: {ends:?}");
    let error = graph(Format::Wkb, "0103zz").expect_err("digits").to_string();
    assert_eq!(error, "line 1: it is neither well-known binary nor hexadecimal digits");
    assert_eq!(graph(Format::Wkb, "").map(|empty| empty.segments.len()).ok(), Some(0));
    for (bytes, message) in [
        (&[2][..], "the order of its bytes is 2, neither 0 nor 1"),
        (&[1, 8, 0, 0, 0], "kind 8 is none of points, lines, polygons and collections of them"),
        (&[1, 1, 16, 0, 0], "kind 4097 is none of points"),
        (&[1, 4, 0, 0, 0, 1, 0, 0, 0, 1, 2, 0, 0, 0], "a geometry of kind 2 among others of kind 1"),
        (&[1, 1, 0, 0, 0, 0], "the file ends inside of it"),
    ] {
        let error = graph(Format::Wkb, bytes).expect_err("broken").to_string();
        assert!(error.starts_with(&format!("WKB: the geometry at byte 0: {message}")), "{error}");
    }
    let nan = [&[1, 1, 0, 0, 0][..], &f64::NAN.to_le_bytes(), &f64::NAN.to_le_bytes()].concat();
    assert!(good(Format::Wkb, nan).cloud.xy.is_empty(), "an empty point");
}

#[test]
fn segments_alone() {
    let expected = vec![[0, 1], [1, 2], [7, 0]];
    let mut array =
        b"\x93NUMPY\x01\x00\x46\x00{'descr': '<i8', 'fortran_order': False, 'shape': (3, 2), }".to_vec();
    array.resize(79, b' ');
    array.push(b'\n');
    array.extend([0_i64, 1, 1, 2, 7, 0].iter().flat_map(|i| i.to_le_bytes()));
    for (format, content) in [
        (Format::Text, &b"from,to\n0,1\n1,2\n7,0\n"[..]),
        (Format::Text, b"# by hand\n0 1\n\n1\t2 # the second\r\n7; 0"),
        (Format::Npy, &array),
        (Format::Edge, b"3 1\n1 1 2 0\n2 2 3 1\n3 8 1 1\n"),
        (Format::Edge, b"3 0\n0 0 1\n1 1 2\n2 7 0\n"),
        (Format::Poly, b"0 2 0 0\n3 0\n1 1 2\n2 2 3\n3 8 1\n0\n"),
    ] {
        let found =
            read_segments(source(content), format).unwrap_or_else(|error| panic!("{format}: {error}"));
        assert_eq!(found, expected, "{format}");
    }
    assert_eq!(read_segments(source(SQUARE), Format::Poly).expect("segments").len(), 5);
    for (format, content, message) in [
        (Format::Text, "0,1\n2\n", "line 2: 1 fields where a segment has two indices"),
        (Format::Text, "0,1\n2,-3\n", "line 2: \"-3\" is no index"),
        (Format::Text, "0,1\n2,3.0\n", "line 2: \"3.0\" is no index"),
        (Format::Text, "-1,1\n", "line 1: \"-1\" is no index"),
        (Format::Edge, "2 0\n1 1 2\n2 0 1\n", "line 3: a segment ends at point 0"),
        (Format::Edge, "1 0\n0 0 18446744073709551615\n", "line 2: there is no point 18446744073709551615"),
        (Format::Poly, "1 2 0 0\n1 0 0\n1 0\n1 1 2\n", "line 4: there is no point 2"),
        (Format::Ply, "", "segments are not read from ply files"),
    ] {
        let error = read_segments(source(content), format).expect_err(content).to_string();
        assert!(error.starts_with(message), "{content:?}: {error}");
    }
}

#[test]
fn what_triangles_have() {
    let ele = "2 6 2\n1 1 2 3 4 5 6  0.5 7\n2 2 3 4 5 6 1  1.5 8\n";
    let attributes = read_triangle_attributes(source(ele), Format::Ele).expect("attributes");
    assert_eq!((attributes.row(1), attributes.row(2)), (&[1.5, 8.0][..], &[][..]));
    assert_eq!(read_triangles(source(ele), Format::Ele).expect("triangles"), [[0, 1, 2], [1, 2, 3]]);
    // Attributes that are missing matter only to those who want them.
    let short = "1 3 1\n0 0 1 2\n";
    assert!(read_triangle_attributes(source(short), Format::Ele).is_err());
    assert_eq!(read_triangles(source(short), Format::Ele).expect("triangles").len(), 1);
    let areas = read_areas(source("3\n1 0.5\n2 -1\n3 nan\n"), Format::Area).expect("areas");
    assert_eq!(areas, [Some(0.5), None, None]);
    let error = read_areas(source("3\n1 0.5\n"), Format::Area).expect_err("short").to_string();
    assert_eq!(error, "the file ends after 1 of 3 areas");
}
