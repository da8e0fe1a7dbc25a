//! LAS files: counts, flags, returns.

use std::io::Cursor;

use delone_io::{Cloud, Format, LasFilter, LasFlag, ReadOptions, Returns, read_points};
use las::point::{Classification, Format as Records};
use las::{Builder, Point, Version, Writer};

/// `count` points at (i, 2 i, 3 i), of a pulse with three returns each three, every fifth withheld, every seventh in an overlap.
fn file(count: u8, version: Version, records: u8, is_compressed: bool) -> Vec<u8> {
    let mut builder = Builder::from(version);
    builder.point_format = Records::new(records).expect("a format");
    builder.point_format.is_compressed = is_compressed;
    let header = builder.into_header().expect("a header");
    let mut writer = Writer::new(Cursor::new(Vec::new()), header).expect("a writer");
    for i in 0..count {
        let point = Point {
            x: i.into(),
            y: f64::from(i) * 2.0,
            z: f64::from(i) * 3.0,
            return_number: i % 3 + 1,
            number_of_returns: 3,
            is_withheld: i % 5 == 0,
            is_overlap: i % 7 == 0,
            is_synthetic: i == 1,
            is_key_point: i == 2,
            classification: Classification::new(if i < 20 { 2 } else { 5 }).expect("a class"),
            gps_time: Some(0.0),
            ..Point::default()
        };
        let point = if records == 0 { Point { gps_time: None, ..point } } else { point };
        writer.write_point(point).expect("memory takes it");
    }
    writer.into_inner().expect("the end").into_inner()
}

fn read(bytes: &[u8], las: LasFilter) -> Cloud {
    let options = ReadOptions::default().las(las);
    read_points(Box::new(Cursor::new(bytes.to_vec())), Format::Las, &options).expect("a file")
}

fn every(las: LasFilter) -> LasFilter {
    las.withheld(true)
}

#[test]
fn the_larger_field_counts() {
    let mut bytes = file(50, Version::new(1, 4), 6, false);
    // The field of 32 bits, which newer files may leave empty or wrong.
    for legacy in [0_u32, 10, 70] {
        bytes[107..111].copy_from_slice(&legacy.to_le_bytes());
        assert_eq!(read(&bytes, every(LasFilter::default())).xy.len(), 50);
    }
    bytes[107..111].copy_from_slice(&40_u32.to_le_bytes());
    bytes[247..255].copy_from_slice(&[0; 8]);
    assert_eq!(read(&bytes, every(LasFilter::default())).xy.len(), 40);
}

#[test]
fn attributes_decide_which_points_are_taken() {
    let kinds = [(Version::new(1, 4), 6), (Version::new(1, 2), 1), (Version::new(1, 2), 0)];
    for ((version, records), is_compressed) in
        kinds.into_iter().flat_map(|kind| [(kind, false), (kind, true)])
    {
        let bytes = file(50, version, records, is_compressed);
        let taken =
            |las: LasFilter| -> Vec<usize> { read(&bytes, las).xy.iter().map(|p| p[0] as usize).collect() };
        let where_is = |test: &dyn Fn(usize) -> bool| (0..50).filter(|&i| test(i)).collect::<Vec<_>>();
        let all = LasFilter::default;
        assert_eq!(taken(all()), where_is(&|i| i % 5 != 0));
        assert_eq!(taken(every(all())), where_is(&|_| true));
        let returns = |returns| every(all().returns(returns));
        assert_eq!(taken(returns(Returns::First)), where_is(&|i| i % 3 == 0));
        assert_eq!(taken(returns(Returns::Last)), where_is(&|i| i % 3 == 2));
        assert_eq!(taken(returns(Returns::Only)), where_is(&|_| false));
        assert_eq!(taken(returns(Returns::Number(2))), where_is(&|i| i % 3 == 1));
        let skip = |skip: &[LasFlag]| every(all().skip(skip.to_vec()));
        assert_eq!(taken(skip(&[LasFlag::Synthetic, LasFlag::KeyPoint])), where_is(&|i| i != 1 && i != 2));
        assert_eq!(taken(skip(&[LasFlag::Overlap])), where_is(&|i| i % 7 != 0));
        let heights = |low, high| every(all().heights(Some([low, high])));
        assert_eq!(taken(heights(6.0, 12.0)), [2, 3, 4]);
        let cloud = read(&bytes, all());
        assert_eq!(cloud.flags, [1, 1, 10, 8]);
        assert_eq!(cloud.remarks, ["10 points that are withheld are left out"]);
    }
}

#[test]
fn words_name_returns_and_flags() {
    assert_eq!("LAST".parse(), Ok(Returns::Last));
    assert_eq!("3".parse(), Ok(Returns::Number(3)));
    assert!(["0", "16", "-1", "some", ""].into_iter().all(|text| text.parse::<Returns>().is_err()));
    assert_eq!("Key-Point".parse(), Ok(LasFlag::KeyPoint));
    assert_eq!(
        "ground".parse::<LasFlag>(),
        Err("a flag is one of synthetic, key-point, withheld, overlap".to_owned())
    );
}
