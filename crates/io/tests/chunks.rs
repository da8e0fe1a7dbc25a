//! Points that are read in chunks are those that are read at once.

use std::io::Cursor;

use delone_io::{Error, Format, ReadOptions, read_chunks, read_points, write_points};

fn in_chunks(
    bytes: &[u8],
    format: Format,
    options: &ReadOptions,
    most: usize,
) -> (Vec<[f64; 2]>, Vec<f64>, usize) {
    let (mut xy, mut z, mut largest) = (Vec::new(), Vec::new(), 0);
    let source = Box::new(Cursor::new(bytes.to_vec()));
    let about = read_chunks(source, format, options, most, &mut |points, heights| {
        xy.extend(points);
        z.extend(heights.into_iter().flatten());
        largest = largest.max(points.len());
        assert!(heights.is_none_or(|heights| heights.len() == points.len()));
        Ok(())
    });
    assert!(about.expect("valid").xy.is_empty());
    (xy, z, largest)
}

/// In chunks of every size come the points that come at once.
#[test]
fn chunks_are_the_whole() {
    let points: Vec<[f64; 3]> =
        (0..100).map(|i| [0.1 * f64::from(i), f64::from(i * i), -f64::from(i)]).collect();
    let flat: Vec<[f64; 2]> = points.iter().map(|p| [p[0], p[1]]).collect();
    for format in [Format::Text, Format::Npy, Format::Raw] {
        for dimension in [2, 3] {
            let options = ReadOptions::default().dimension(dimension);
            let mut bytes = Vec::new();
            match dimension {
                2 => write_points(&mut bytes, format, &flat),
                _ => write_points(&mut bytes, format, &points),
            }
            .expect("written");
            let whole = read_points(Box::new(Cursor::new(bytes.clone())), format, &options).expect("valid");
            for most in [1, 2, 7, 99, 100, 101, usize::MAX] {
                let (xy, z, largest) = in_chunks(&bytes, format, &options, most);
                assert!(xy == whole.xy && z == whole.z.clone().unwrap_or_default(), "{format} {most}");
                assert!(largest <= most, "{format} {most}");
            }
        }
    }
}

/// Geometries in a column come many at a time, with heights or without.
#[test]
fn geometries_keep_their_heights() {
    let text = b"MULTIPOINT Z (1 2 3, 4 5 6)\nPOINT Z (7 8 9)\nPOINT Z (1 1 1)\n";
    let (xy, z, _) = in_chunks(text, Format::Text, &ReadOptions::default(), 1);
    assert_eq!((xy.len(), z), (4, vec![3.0, 6.0, 9.0, 1.0]));
    let mixed = Box::new(Cursor::new("POINT (1 2)\nPOINT Z (7 8 9)\n"));
    let found = read_chunks(mixed, Format::Text, &ReadOptions::default(), 1, &mut |_, _| Ok(()));
    assert!(found.is_err_and(|error| error.to_string().contains("line 2")));
    let counted = Box::new(Cursor::new("3\n1 2\n3 4\n"));
    let found = read_chunks(counted, Format::Text, &ReadOptions::default(), 1, &mut |_, _| Ok(()));
    assert!(found.is_err_and(|error| error.to_string().contains("after 2 of 3 points")));
}

#[test]
fn whoever_takes_may_stop() {
    let text = Box::new(Cursor::new("1,2\n3,4\nno number\n"));
    let stop = |_: &[[f64; 2]], _: Option<&[f64]>| Err(Error::Content("enough".to_owned()));
    let found = read_chunks(text, Format::Text, &ReadOptions::default(), 1, &mut { stop });
    assert!(found.is_err_and(|error| error.to_string() == "enough"));
    let other =
        read_chunks(Box::new(Cursor::new("")), Format::Ply, &ReadOptions::default(), 1, &mut { stop });
    assert!(matches!(other, Err(Error::Unsupported { .. })));
}
