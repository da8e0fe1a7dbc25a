//! Records of all kinds, with and without what lies beside them.

use std::io::{self, Cursor};

use crate::{Error, Graph, ReadOptions, Source};

/// A `.shp` file of these records.
fn file(records: &[Vec<u8>]) -> Vec<u8> {
    let mut file = 9994_u32.to_be_bytes().to_vec();
    file.resize(100, 0);
    for (number, record) in (1_u32..).zip(records) {
        file.extend(number.to_be_bytes());
        file.extend((record.len() as u32 / 2).to_be_bytes());
        file.extend(record);
    }
    file
}

fn bytes(kind: u32, counts: &[u32], numbers: &[f64]) -> Vec<u8> {
    let mut record = kind.to_le_bytes().to_vec();
    if !counts.is_empty() {
        record.resize(36, 0);
    }
    counts.iter().for_each(|count| record.extend(count.to_le_bytes()));
    numbers.iter().for_each(|number| record.extend(number.to_le_bytes()));
    record
}

/// A table with fields of several types and two rows, of which the second may be deleted.
fn table(second: u8) -> Vec<u8> {
    let fields = [
        ("NAME", b'C', 6, 0),
        ("N", b'N', 5, 1),
        ("OK", b'L', 1, 0),
        ("DAY", b'D', 8, 0),
        ("MEMO", b'M', 2, 0),
        ("I", b'I', 4, 0),
    ];
    let mut table = vec![3, 124, 1, 1];
    let width: u16 = 1 + fields.iter().map(|field| field.2).sum::<u16>();
    table.extend(2_u32.to_le_bytes());
    table.extend((32 + 32 * fields.len() as u16 + 1).to_le_bytes());
    table.extend(width.to_le_bytes());
    table.resize(32, 0);
    for (name, kind, length, decimals) in fields {
        let start = table.len();
        table.extend(name.bytes());
        table.resize(start + 11, 0);
        table.push(kind);
        table.resize(start + 16, 0);
        table.extend([length as u8, decimals]);
        table.resize(start + 32, 0);
    }
    table.push(0x0d);
    table.extend(b" \xc5re     1.5T20240102xx\xfe\xff\xff\xff");
    table.push(second);
    table.extend(b"          7?        xx\x01\0\0\0");
    table
}

fn read(records: &[Vec<u8>], table: Option<Vec<u8>>) -> Result<Graph, Error> {
    let mut beside = |extension: &str| match (extension, &table) {
        ("dbf", Some(table)) => Ok(Box::new(Cursor::new(table.clone())) as Box<dyn Source>),
        ("prj", _) => Ok(Box::new(Cursor::new("PROJCS[\"ours\",UNIT[\"metre\",1]]")) as Box<dyn Source>),
        _ => Err(io::Error::from(io::ErrorKind::NotFound).into()),
    };
    let options = ReadOptions { attributes: true, ..ReadOptions::default() };
    super::read(Box::new(Cursor::new(file(records))), &options, Some(&mut beside))?.graph()
}

#[test]
fn records_of_all_kinds() {
    let square = [0.0, 0.0, 0.0, 4.0, 4.0, 4.0, 4.0, 0.0, 0.0, 0.0];
    let hole = [1.0, 1.0, 2.0, 1.0, 2.0, 2.0, 1.0, 1.0];
    let graph = read(
        &[
            bytes(0, &[], &[]),
            bytes(21, &[], &[1.0, 2.0, 9.0]),
            bytes(28, &[2], &[1.0, 2.0, 3.0, 4.0]),
            bytes(3, &[2, 4, 0, 2], &[0.0, 0.0, 1.0, 1.0, 5.0, 5.0, 6.0, 6.0]),
            bytes(25, &[2, 9, 0, 5], &[square.as_slice(), &hole].concat()),
        ],
        None,
    );
    let graph = graph.expect("records");
    assert_eq!(graph.cloud.xy.len(), 1 + 2 + 4 + 4 + 3);
    assert_eq!(
        graph.segments,
        [[3, 4], [5, 6], [7, 8], [8, 9], [9, 10], [10, 7], [11, 12], [12, 13], [13, 11]]
    );
    let rings: Vec<_> = graph.rings.iter().map(|ring| (ring.polygon, ring.ring)).collect();
    assert_eq!(rings, [(0, 0), (0, 1)]);
    assert_eq!(graph.cloud.crs.and_then(|crs| crs.name).as_deref(), Some("ours"));
    assert!(graph.cloud.remarks[0].contains("no .dbf"));
    let high =
        read(&[bytes(11, &[], &[1.0, 2.0, 3.0, 0.0]), bytes(18, &[1], &[4.0, 5.0, 0.0, 0.0, 6.0])], None);
    assert_eq!(high.expect("heights").cloud.z, Some(vec![3.0, 6.0]));
    let line = bytes(13, &[1, 2, 0], &[0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 7.0, 8.0]);
    assert_eq!(read(&[line], None).expect("a line").cloud.z, Some(vec![7.0, 8.0]));
    let alone = file(&[bytes(5, &[1, 5, 0], &square)]);
    let rings =
        super::read(Box::new(Cursor::new(alone)), &ReadOptions::default(), None).expect("a ring").rings();
    assert_eq!((rings.rings[0].len(), rings.crs), (4, None));
}

#[test]
fn rows_go_with_their_records() {
    let points = [1.0, 2.0, 3.0].map(|x| bytes(1, &[], &[x, 0.0]));
    let graph = read(&points, Some(table(b' '))).expect("points");
    let row = |i| graph.cloud.features.table.row(i).map(|cell| cell.1.to_owned()).collect::<Vec<_>>();
    assert_eq!(row(0), ["\"\u{c5}re\"", "1.5", "true", "\"2024-01-02\"", "-2"]);
    assert_eq!((row(1), row(2)), (vec!["7".to_owned(), "1".to_owned()], Vec::new()));
    assert_eq!(graph.cloud.losses.len(), 2, "{:?}", graph.cloud.losses);
    assert!(graph.cloud.losses[1].contains("MEMO"));
    let graph = read(&points, Some(table(b'*'))).expect("points");
    assert_eq!(graph.cloud.xy, [[1.0, 0.0], [3.0, 0.0]]);
    assert!(graph.cloud.remarks[0].contains("1 records are deleted"));
}

#[test]
fn broken_files_are_named() {
    for (record, what) in [
        (bytes(7, &[], &[]), "its kind is 7"),
        (bytes(40, &[], &[]), "its kind is 40"),
        (bytes(1, &[], &[1.0]), "ends inside"),
        (bytes(3, &[1, 9, 0], &[1.0; 4]), "ends inside"),
        (bytes(3, &[u32::MAX, 9], &[]), "ends inside"),
        (bytes(3, &[1, 2, 1], &[1.0; 4]), "one after another"),
        (bytes(5, &[2, 2, 0, 3], &[1.0; 4]), "one after another"),
    ] {
        let error = read(&[record], None).expect_err(what);
        assert!(error.to_string().contains(what), "{error}");
    }
    let whole = file(&[bytes(1, &[], &[1.0, 2.0])]);
    for length in 0..whole.len() {
        let cut = Box::new(Cursor::new(whole[..length].to_vec()));
        assert_eq!(super::read(cut, &ReadOptions::default(), None).is_ok(), length == 100, "cut to {length}");
    }
    let patches = read(&[bytes(31, &[], &[])], None).expect("a remark");
    assert!(patches.cloud.losses[0].contains("multipatches"));
    let whole = table(b' ');
    for at in 0..whole.len() {
        for byte in [0, 0x0d, 0xff] {
            let mut changed = whole.clone();
            changed[at] = byte;
            _ = read(&[bytes(1, &[], &[1.0, 2.0])], Some(changed));
        }
        _ = read(&[bytes(1, &[], &[1.0, 2.0])], Some(whole[..at].to_vec()));
    }
}
