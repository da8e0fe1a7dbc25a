//! Files of other programs: an index, all types of columns, systems by name, geometries of all kinds; and what is broken.

use std::io::Cursor;

use super::tables::{Builder, OFFSET};
use super::{MAGIC, column, crs, feature, geometry, header, kind};
use crate::{Error, Graph, ReadOptions};

fn read(bytes: Vec<u8>) -> Result<Graph, Error> {
    let options = ReadOptions { attributes: true, ..ReadOptions::default() };
    super::read(Box::new(Cursor::new(bytes)), &options)?.graph()
}

/// The beginning of a file with an index of so many nodes.
fn head(form: u8, columns: &[u8], count: u64, node: u16, nodes: usize) -> Vec<u8> {
    let mut builder = Builder::default();
    builder.begin();
    let mut sizes = [0; header::CRS + 1];
    sizes[header::GEOMETRY] = 1;
    sizes[header::COLUMNS] = OFFSET;
    sizes[header::COUNT] = 8;
    sizes[header::NODE_SIZE] = 2;
    sizes[header::CRS] = OFFSET;
    let fields = builder.table(Builder::ROOT, &sizes);
    builder.put(fields.at(header::GEOMETRY), &[form]);
    builder.put(fields.at(header::COUNT), &count.to_le_bytes());
    builder.put(fields.at(header::NODE_SIZE), &node.to_le_bytes());
    let places = builder.tables(fields.at(header::COLUMNS), columns.len());
    for (place, own) in places.zip(columns) {
        let fields = builder.table(place, &[OFFSET, 1]);
        builder.put(fields.at(column::KIND), &[*own]);
        builder.text(fields.at(column::NAME), &format!("column {own}"));
    }
    let system = builder.table(fields.at(header::CRS), &[OFFSET, 4]);
    builder.text(system.at(crs::AUTHORITY), "EPSG");
    builder.put(system.at(crs::CODE), &25_832_u32.to_le_bytes());
    let mut file = [&MAGIC[..], &[1]].concat();
    file.extend(builder.finish());
    file.resize(file.len() + 40 * nodes, 7);
    file
}

/// A feature of a point in its own kind, with properties.
fn point(own: u8, xy: &[f64], properties: &[u8]) -> Vec<u8> {
    let mut builder = Builder::default();
    builder.begin();
    let fields = builder.table(Builder::ROOT, &[OFFSET, OFFSET]);
    builder.vector(fields.at(feature::PROPERTIES), properties.len(), 1);
    builder.push(properties);
    let mut sizes = [0; geometry::KIND + 1];
    (sizes[geometry::XY], sizes[geometry::KIND]) = (OFFSET, 1);
    let fields = builder.table(fields.at(feature::GEOMETRY), &sizes);
    builder.put(fields.at(geometry::KIND), &[own]);
    builder.vector(fields.at(geometry::XY), xy.len(), 8);
    xy.iter().for_each(|x| builder.push(&x.to_le_bytes()));
    builder.finish().to_vec()
}

#[test]
fn an_index_is_passed_over() {
    for (count, nodes) in [(1, 2), (2, 3), (16, 17), (17, 20), (257, 257 + 17 + 2 + 1)] {
        let mut file = head(1, &[], count, 16, nodes);
        (0..count).for_each(|i| file.extend(point(0, &[i as f64, 1.0], &[])));
        let graph = read(file.clone()).expect("points");
        assert_eq!(graph.cloud.xy.len() as u64, count);
        assert_eq!(graph.cloud.crs.and_then(|crs| crs.epsg), Some(25_832));
        file.extend(point(0, &[0.0, 0.0], &[]));
        assert!(read(file).expect_err("one more").to_string().contains("more follows"));
    }
    let far = read(head(1, &[], u64::MAX, 16, 9)).expect_err("no file is so long");
    assert!(far.to_string().contains("fit no file"), "{far}");
    let long = read(head(1, &[], 1 << 40, 16, 9)).expect_err("its index is not there");
    assert!(matches!(long, Error::Truncated(_)), "{long}");
    let endless = read(head(1, &[], 2, 1, 9)).expect_err("an index without an end");
    assert!(endless.to_string().contains("no end"), "{endless}");
}

#[test]
fn columns_have_all_types() {
    let types: Vec<u8> = (kind::BYTE..=kind::BINARY).collect();
    let mut properties = Vec::new();
    let text = |bytes: &[u8]| [&(bytes.len() as u32).to_le_bytes(), bytes].concat();
    let values: [Vec<u8>; 15] = [
        vec![0xff],
        vec![0xff],
        vec![1],
        (-2_i16).to_le_bytes().to_vec(),
        u16::MAX.to_le_bytes().to_vec(),
        i32::MIN.to_le_bytes().to_vec(),
        u32::MAX.to_le_bytes().to_vec(),
        i64::MIN.to_le_bytes().to_vec(),
        u64::MAX.to_le_bytes().to_vec(),
        0.5_f32.to_le_bytes().to_vec(),
        1e300_f64.to_le_bytes().to_vec(),
        text("\u{c5}re".as_bytes()),
        text(b" {\"a\": [1, null]} "),
        text(b"2024-01-02T03:04:05Z"),
        text(&[0, 0xab]),
    ];
    for (place, value) in values.iter().enumerate() {
        properties.extend((place as u16).to_le_bytes());
        properties.extend(value);
    }
    let file = [head(0, &types, 1, 0, 0), point(1, &[1.0, 2.0], &properties)].concat();
    let table = read(file).expect("a point").cloud.features.table;
    let cells: Vec<&str> = table.row(0).map(|cell| cell.1).collect();
    let expected = [
        "-1",
        "255",
        "true",
        "-2",
        "65535",
        "-2147483648",
        "4294967295",
        "-9223372036854775808",
        "1.8446744073709552e19",
        "0.5",
        "1e300",
        "\"\u{c5}re\"",
        "{\"a\": [1, null]}",
        "\"2024-01-02T03:04:05Z\"",
        "\"00ab\"",
    ];
    assert_eq!(cells, expected);
    assert_eq!(table.names()[14], "column 14");
    // What is no JSON stays a text, and a value ends where its file does.
    let broken = [&12_u16.to_le_bytes()[..], &text(b"{\"a\":")].concat();
    let of_one = |properties: &[u8]| {
        let file = [head(1, &types, 1, 0, 0), point(1, &[1.0, 2.0], properties)].concat();
        read(file)
            .map(|graph| graph.cloud.features.table.row(0).map(|cell| cell.1.to_owned()).collect::<Vec<_>>())
    };
    assert_eq!(of_one(&broken).expect("a text"), ["\"{\\\"a\\\":\""]);
    for (properties, what) in [(&[9, 0, 1][..], "inside of a value"), (&[99, 0], "in column 99 of 15")] {
        let error = of_one(properties).expect_err(what);
        assert!(error.to_string().contains(what), "{error}");
    }
}

#[test]
fn broken_geometries_are_named() {
    for (own, xy, what) in
        [(9, &[1.0, 2.0][..], "arcs"), (30, &[1.0, 2.0], "kind 30"), (1, &[1.0], "one number alone")]
    {
        let error = read([head(0, &[], 1, 0, 0), point(own, xy, &[])].concat()).expect_err(what);
        assert!(error.to_string().contains(what), "{error}");
    }
}

#[test]
fn parts_that_are_one_are_bounded() {
    let mut builder = Builder::default();
    builder.begin();
    let fields = builder.table(Builder::ROOT, &[OFFSET]);
    let mut sizes = [0; geometry::PARTS + 1];
    (sizes[geometry::KIND], sizes[geometry::PARTS]) = (1, OFFSET);
    // Each level is a collection whose two parts are the next level: thirty of them would be a thousand million geometries.
    let mut from = vec![fields.at(feature::GEOMETRY)];
    for level in (0..30).rev() {
        let fields = builder.shared(&from, &sizes);
        builder.put(fields.at(geometry::KIND), &[7]);
        from = builder.tables(fields.at(geometry::PARTS), if level > 0 { 2 } else { 0 }).collect();
    }
    let feature = builder.finish().to_vec();
    let error = read([head(0, &[], 1, 0, 0), feature].concat()).expect_err("too many");
    assert!(error.to_string().contains("more than it has bytes for"), "{error}");
}

#[test]
fn what_is_cut_or_changed_is_an_error() {
    let file = [head(1, &[11], 2, 16, 3), point(0, &[1.0, 2.0], &[]), point(0, &[3.0, 4.0], &[])].concat();
    assert_eq!(read(file.clone()).expect("two points").cloud.xy.len(), 2);
    for length in 0..file.len() {
        assert!(read(file[..length].to_vec()).is_err(), "cut to {length}");
    }
    for at in 0..file.len() {
        for byte in [0, 1, 0x7f, 0xff] {
            let mut changed = file.clone();
            changed[at] = byte;
            // Whatever it is taken for, it ends.
            _ = read(changed);
        }
    }
}
