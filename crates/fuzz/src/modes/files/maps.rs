//! Files of maps to begin with: FlatGeobuf and GeoPackage as ours write them, a shapefile with its table behind it, a drawing.

use delone_io::{Answers, Crs, Features, Format, Found, Table, Value};

use super::corpus::{Seeds, mesh, points, written};

pub(super) fn all() -> Seeds {
    let mut seeds = Vec::new();
    for format in [Format::FlatGeobuf, Format::GeoPackage] {
        seeds.extend([written(format), mesh(format), answers(format)]);
    }
    seeds.push((Format::Shapefile, shapefile()));
    seeds.push((Format::Dxf, DRAWING.replace(' ', "\n").into_bytes()));
    seeds
}

/// Points with attributes of all types.
fn answers(format: Format) -> (Format, Vec<u8>) {
    let points = points();
    let mut table = Table::default();
    for (i, point) in points.iter().enumerate() {
        table.begin();
        table.set("name", Value::Text("\u{c5}re"));
        table.set("count", Value::Integer(i as i64));
        table.set("size", Value::Number(point[0]));
        table.set("is", Value::Bool(i % 2 == 0));
    }
    let crs = Crs::of_wkt("PROJCS[\"ours\",GEOGCS[\"theirs\"]]");
    let answers = Answers {
        queries: &points,
        features: &Features::of_points(table),
        crs: crs.as_ref(),
        names: &["nearest".to_owned()],
        found: Found::Indices(&(0..points.len() as i64).collect::<Vec<_>>()),
    };
    let mut bytes = Vec::new();
    let outcome = delone_io::write_answers(&mut bytes, format, &answers);
    assert!(outcome.is_ok(), "{format} is written");
    (format, bytes)
}

/// Records of a polygon with a hole in two parts, of a line with heights and of a point; then the table of them.
fn shapefile() -> Vec<u8> {
    let record = |kind: u32, counts: &[u32], numbers: &[f64]| {
        let mut record = kind.to_le_bytes().to_vec();
        record.resize(if counts.is_empty() { 4 } else { 36 }, 0);
        counts.iter().for_each(|count| record.extend(count.to_le_bytes()));
        numbers.iter().for_each(|number| record.extend(number.to_le_bytes()));
        record
    };
    let rings =
        [0., 0., 0., 4., 4., 4., 0., 0., 1., 2., 2., 3., 1., 3., 1., 2., 9., 9., 9., 10., 10., 9., 9., 9.];
    let records = [
        record(5, &[3, 12, 0, 4, 8], &rings),
        record(13, &[1, 2, 0], &[0.0, 0.0, 1.0, 1.0, 0.0, 9.0, 7.0, 8.0]),
        record(1, &[], &[1.0, 2.0]),
    ];
    let mut file = 9994_u32.to_be_bytes().to_vec();
    file.resize(100, 0);
    for (number, record) in (1_u32..).zip(&records) {
        file.extend(number.to_be_bytes());
        file.extend((record.len() as u32 / 2).to_be_bytes());
        file.extend(record);
    }
    let words = (file.len() as u32 / 2).to_be_bytes();
    file[24..28].copy_from_slice(&words);
    // Three rows of eleven bytes: letters, digits, truth.
    let mut table = vec![3, 124, 1, 1, 3, 0, 0, 0, 129, 0, 12, 0];
    table.resize(32, 0);
    for (name, kind, length) in [("NAME", b'C', 5), ("COUNT", b'N', 5), ("IS", b'L', 1)] {
        let start = table.len();
        table.extend(name.bytes());
        table.resize(start + 11, 0);
        table.push(kind);
        table.resize(start + 16, 0);
        table.push(length);
        table.resize(start + 32, 0);
    }
    table.push(0x0d);
    (0..3).for_each(|_| table.extend(b" \xc5re   1.5T"));
    [file, table].concat()
}

/// A drawing whose lines are apart by blanks.
const DRAWING: &str = "0 SECTION 2 BLOCKS 0 BLOCK 8 0 2 arm 10 1 20 0 30 0 0 LINE 8 0 10 1 20 0 11 3 21 0 0 ENDBLK 0 BLOCK 2 two 10 0 20 0 \
0 INSERT 2 arm 10 10 20 0 50 90 0 ENDBLK 0 ENDSEC 0 SECTION 2 ENTITIES 0 CIRCLE 10 9 20 9 40 2 0 ARC 10 0 20 0 40 1 50 300 51 45 \
0 ELLIPSE 10 5 20 1 11 3 21 0 40 0.3 41 0 42 6.283185307179586 0 SPLINE 71 2 40 0 40 0 40 0 40 1 40 1 40 1 41 1 41 2 41 1 10 0 20 0 10 1 20 2 10 2 20 0 \
0 LWPOLYLINE 70 1 10 0 20 0 42 0.01 10 1 20 0 0 POINT 8 a 10 1 20 2 30 3 0 LWPOLYLINE 8 c 90 3 70 1 38 7 \
10 0 20 0 10 4 20 0 42 0.5 10 0 20 4 0 POLYLINE 8 d 66 1 70 8 0 VERTEX 8 d 10 1 20 1 30 9 0 VERTEX 8 d 10 2 20 1 30 8 0 SEQEND \
0 3DFACE 8 f 10 0 20 0 30 0 11 1 21 0 31 1 12 0 22 1 32 2 0 CIRCLE 10 0 20 0 40 1 0 INSERT 8 top 2 two 10 100 20 0 41 2 \
0 INSERT 2 arm 10 0 20 50 70 2 71 2 44 5 45 7 0 ENDSEC 0 EOF";
