//! Rasters: what is written is read again, whatever comes in between; what is broken is named and takes no memory.

use std::io::Cursor;
use std::path::Path;

use delone::surface::Grid;
use delone_io::{
    Compression, Crs, Error, Format, Raster, RasterInfo, RasterWriter, ReadOptions, Sample, read_points,
    read_raster,
};

/// Heights with cells that have none.
fn values(columns: usize, rows: usize) -> Vec<f64> {
    let height = |i: usize| match i % 17 {
        0 => f64::NAN,
        _ => 100.0 + ((i * 7919) % 1000) as f64 / 7.0 - (i % columns) as f64,
    };
    (0..columns * rows).map(height).collect()
}

fn written(format: Format, info: &RasterInfo, values: &[f64], rows: usize) -> Vec<u8> {
    let mut writer = RasterWriter::create(Cursor::new(Vec::new()), format, info).expect("begun");
    for part in values.chunks(rows * info.grid.columns()) {
        writer.write_rows(part).expect("written");
    }
    writer.finish().expect("finished").into_inner()
}

fn read(format: Format, bytes: &[u8]) -> Result<Raster, Error> {
    read_raster(Box::new(Cursor::new(bytes.to_vec())), format)
}

fn same(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a == b || a.is_nan() && b.is_nan())
}

#[test]
fn rasters_come_back_however_rows_are_given() {
    let crs = Crs { vertical: Some(7837), ..Crs::of_epsg(25832) };
    for (columns, rows) in [(1, 1), (3, 2), (63, 64), (200, 130), (5, 300)] {
        let grid = Grid::new([350_000.5, 5_400_000.25], [0.5, -0.5], columns, rows).expect("a raster");
        let values = values(columns, rows);
        let single: Vec<f64> = values.iter().map(|&x| f64::from(x as f32)).collect();
        for (sample, nodata) in [(Sample::F64, None), (Sample::F32, None), (Sample::F32, Some(-9999.0))] {
            let info = RasterInfo { crs: Some(crs.clone()), nodata, sample, ..RasterInfo::new(grid) };
            let expected = if sample == Sample::F64 { &values } else { &single };
            for format in [Format::Tiff, Format::Asc, Format::Npy] {
                let whole = written(format, &info, &values, rows);
                for parts in [1, 7, 65] {
                    assert_eq!(written(format, &info, &values, parts), whole, "{format} by {parts} rows");
                }
                let raster = read(format, &whole).expect("a raster");
                let expected = if format == Format::Npy { &values } else { expected };
                // Text has the digits that its numbers need.
                let read: Vec<f64> = match (format, sample) {
                    (Format::Asc, Sample::F32) => {
                        raster.values.iter().map(|&x| f64::from(x as f32)).collect()
                    }
                    _ => raster.values,
                };
                assert!(same(&read, expected), "{format} {columns} {rows} {sample:?}");
                if format != Format::Npy {
                    assert_eq!((raster.grid.corner(), raster.grid.step()), (grid.corner(), grid.step()));
                }
                assert_eq!(raster.crs, (format == Format::Tiff).then(|| crs.clone()));
            }
        }
    }
}

#[test]
fn threads_write_the_same_bytes() {
    let grid = Grid::new([0.0; 2], [1.0, -1.0], 300, 1000).expect("a raster");
    let values = values(300, 1000);
    let [one, three] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| written(Format::Tiff, &RasterInfo::new(grid), &values, 1000))
    });
    assert!(one == three);
}

/// A directory of a file: where it is, and the tags of its entries with their number of values, and these or their place.
type Directory = (usize, Vec<(u16, usize, usize)>);

/// The directories of a small GeoTIFF in their order.
fn directories(bytes: &[u8]) -> Vec<Directory> {
    let long = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes")) as usize;
    let short = |at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
    let mut found = Vec::new();
    let mut start = long(4);
    while start != 0 {
        let entries = (0..usize::from(short(start))).map(|k| start + 2 + 12 * k);
        let entries: Vec<_> = entries.map(|at| (short(at), long(at + 4), long(at + 8))).collect();
        let next = long(start + 2 + 12 * entries.len());
        found.push((start, entries));
        start = next;
    }
    found
}

/// The rules of GDAL's `validate_cloud_optimized_geotiff`: directories first, tiles, overviews before the raster.
#[test]
fn geotiff_is_optimized_for_clouds() {
    let (columns, rows) = (1300, 1100);
    let grid = Grid::new([0.0; 2], [1.0, -1.0], columns, rows).expect("a raster");
    let values = values(columns, rows);
    let mut files = Vec::new();
    for compression in [Compression::Deflate, Compression::Lzw, Compression::None] {
        let info = RasterInfo { compression, ..RasterInfo::new(grid) };
        let bytes = written(Format::Tiff, &info, &values, 100);
        let raster = read(Format::Tiff, &bytes).expect("a raster");
        assert!(
            raster.values.iter().zip(&values).all(|(a, b)| a.to_bits() == f64::from(*b as f32).to_bits())
        );
        let long = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes")) as usize;
        let directories = directories(&bytes);
        assert_eq!(directories[0].0, 8);
        assert!(directories.is_sorted_by(|a, b| a.0 < b.0));
        let number = |entries: &[(u16, usize, usize)], tag| {
            entries.iter().find(|entry| entry.0 == tag).map(|entry| entry.2)
        };
        let sizes: Vec<_> =
            directories.iter().map(|d| [254, 256, 257, 322, 323].map(|tag| number(&d.1, tag))).collect();
        let level = |kind, width, height| [kind, Some(width), Some(height), Some(512), Some(512)];
        assert_eq!(sizes, [level(None, 1300, 1100), level(Some(1), 650, 550), level(Some(1), 325, 275)]);
        // Tiles follow each other without gaps, from the smallest overview to the raster, and end with the file.
        let mut position = None;
        for (_, entries) in directories.iter().rev() {
            let list = |tag| {
                let &(_, count, at) = entries.iter().find(|entry| entry.0 == tag).expect("a list");
                if count == 1 { vec![at] } else { (0..count).map(|k| long(at + 4 * k)).collect::<Vec<_>>() }
            };
            for (at, length) in list(324).into_iter().zip(list(325)) {
                assert!(at > directories[2].0 && position.is_none_or(|position| position == at));
                position = Some(at + length);
            }
        }
        assert_eq!(position, Some(bytes.len()));
        files.push(bytes.len());
    }
    assert!(files[0] < files[1] && files[1] < files[2]);
    // Files that do not wait in memory are the same.
    let folder = tempfile::tempdir().expect("a folder");
    let grid = Grid::new([0.0; 2], [1.0, -1.0], 1600, 1400).expect("a raster");
    let values: Vec<f64> = (0..1600 * 1400).map(f64::from).collect();
    let info = RasterInfo { sample: Sample::F64, compression: Compression::None, ..RasterInfo::new(grid) };
    let bytes = written(Format::Tiff, &info, &values, 1400);
    let on_disk = RasterInfo { scratch: Some(folder.path().to_owned()), ..info };
    assert!(bytes == written(Format::Tiff, &on_disk, &values, 99));
    assert!(read(Format::Tiff, &bytes).expect("a raster").values == values);
}

#[test]
fn shades_are_rounded() {
    let grid = Grid::new([0.0; 2], [1.0, -1.0], 4, 1).expect("a raster");
    let info = RasterInfo { sample: Sample::U8, nodata: Some(0.0), ..RasterInfo::new(grid) };
    let bytes = written(Format::Tiff, &info, &[f64::NAN, 1.4, 254.6, 300.0], 1);
    assert!(same(&read(Format::Tiff, &bytes).expect("a raster").values, &[f64::NAN, 1.0, 255.0, 255.0]));
}

#[test]
fn rasters_are_points_where_they_have_data() {
    let grid = Grid::new([10.0, 20.0], [2.0, -2.0], 2, 2).expect("a raster");
    for format in [Format::Tiff, Format::Asc] {
        let bytes = written(format, &RasterInfo::new(grid), &[1.0, f64::NAN, 3.0, 4.0], 1);
        let cloud =
            read_points(Box::new(Cursor::new(bytes)), format, &ReadOptions::default()).expect("points");
        assert_eq!(cloud.xy, [[11.0, 19.0], [11.0, 17.0], [13.0, 17.0]], "{format}");
        assert_eq!(cloud.z, Some(vec![1.0, 3.0, 4.0]));
        assert_eq!(cloud.remarks, ["1 cells without data are left out"]);
    }
}

#[test]
fn what_cannot_be_written_is_refused() {
    let grid = |step, columns, rows| Grid::new([0.0; 2], step, columns, rows).expect("a raster");
    let create = |format, grid| {
        RasterWriter::create(Cursor::new(Vec::new()), format, &RasterInfo::new(grid)).map(|_| ())
    };
    let down = grid([1.0, -1.0], 2, 2);
    assert!(matches!(create(Format::Ply, down), Err(Error::Unsupported { .. })));
    for step in [[1.0, 1.0], [2.0, -1.0], [-1.0, -1.0]] {
        assert!(matches!(create(Format::Asc, grid(step, 2, 2)), Err(Error::NotSquare { .. })));
        assert!(create(Format::Tiff, grid(step, 2, 2)).is_ok());
    }
    for format in [Format::Tiff, Format::Asc] {
        assert!(matches!(create(format, grid([1.0, -1.0], 0, 2)), Err(Error::Extent { .. })));
    }
    assert!(matches!(create(Format::Tiff, grid([1.0, -1.0], 1 << 40, 2)), Err(Error::Extent { .. })));
    for format in [Format::Tiff, Format::Asc, Format::Npy] {
        let begin =
            || RasterWriter::create(Cursor::new(Vec::new()), format, &RasterInfo::new(down)).expect("begun");
        assert!(matches!(begin().write_rows(&[1.0; 3]), Err(Error::Rows { values: 3, .. })));
        assert!(matches!(begin().write_rows(&[1.0; 6]), Err(Error::Rows { values: 6, .. })));
        assert!(matches!(begin().finish(), Err(Error::Rows { values: 0, .. })));
    }
    let mut writer =
        RasterWriter::create(Cursor::new(Vec::new()), Format::Tiff, &RasterInfo::new(down)).expect("begun");
    let beyond = writer.write_rows(&[1.0, 2.0, 3.0, 1e300]);
    assert!(matches!(beyond, Err(Error::Beyond { column: 1, row: 1, value: 1e300 })));
}

#[test]
fn text_of_other_programs_is_read() {
    let text = "NCOLS 2\r\nNROWS 2\r\nXLLCENTER 1.5\r\nYLLCENTER 2.5\r\nDX 1\r\nDY 2\r\n 1 2 3\r\n-9999 \r\n";
    let raster = read(Format::Asc, text.as_bytes()).expect("a raster");
    assert_eq!((raster.grid.corner(), raster.grid.step()), ([1.0, 5.5], [1.0, -2.0]));
    assert_eq!(raster.values, [1.0, 2.0, 3.0, -9999.0]);
    for (text, message) in [
        ("", "does not say ncols"),
        ("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\n1 2 3 4\n", "does not say cellsize"),
        ("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0\n1 2 3 4\n", "the size of a cell"),
        ("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n", "ends after 3 of 4 values"),
        (
            "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n4 5\n",
            "line 7: there are more than 4",
        ),
        ("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 x\n", "line 6: \"x\" is no number"),
        ("ncols -2\n", "line 1: ncols is no whole number"),
        ("north 2\n", "line 1: an ASCII grid says nothing of \"north\""),
        (
            "ncols 900000000000\nnrows 900000000000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1\n",
            "ends after 1 of",
        ),
    ] {
        let found = read(Format::Asc, text.as_bytes()).expect_err(text).to_string();
        assert!(found.contains(message), "{text}: {found}");
    }
}

#[test]
fn broken_files_are_named_and_take_no_memory() {
    let grid = Grid::new([0.0, 100.0], [1.0, -1.0], 40, 100).expect("a raster");
    let info = RasterInfo { crs: Some(Crs::of_epsg(4326)), ..RasterInfo::new(grid) };
    let bytes = written(Format::Tiff, &info, &values(40, 100), 100);
    for end in [0, 1, 4, 8, 100, bytes.len() / 2, bytes.len() - 20, bytes.len() - 1] {
        assert!(read(Format::Tiff, &bytes[..end]).is_err(), "the first {end} bytes");
    }
    // Every byte changed in turn: no panic, whatever is read.
    for place in 0..bytes.len() {
        for value in [0, 0x7f, 0xff] {
            let mut changed = bytes.clone();
            changed[place] = value;
            _ = read(Format::Tiff, &changed);
        }
    }
    // Claims of billions of cells: the width, or the rows, of the first entries of the directory.
    let start = u32::from_le_bytes(bytes[4..8].try_into().expect("four bytes")) as usize;
    for entry in [0, 1] {
        let mut changed = bytes.clone();
        changed[start + 2 + 12 * entry + 8..][..4].copy_from_slice(&u32::MAX.to_le_bytes());
        assert!(read(Format::Tiff, &changed).is_err());
    }
    assert!(read(Format::Tiff, b"no picture").is_err());
    assert!(matches!(read(Format::Ply, b""), Err(Error::Unsupported { .. })));
    let array = written(Format::Npy, &info, &values(40, 100), 100);
    assert!(read(Format::Npy, &array[..array.len() - 1]).is_err());
}

/// Rasters that others made, where `DELONE_RASTERS` names their folder: tiles of 16-bit numbers, strips of floating point.
#[test]
fn rasters_of_others_are_read() {
    let Some(folder) = std::env::var_os("DELONE_RASTERS") else { return };
    let folder = Path::new(&folder);
    for (name, [columns, rows], epsg, low, high, data) in [
        ("pysheds_dem.tif", [367, 359], 4326, 147.0, 298.0, 367 * 359),
        ("valid_raster.tif", [100, 80], 3857, 0.0, 44.072_563_171_386_72, 8000),
    ] {
        let Ok(bytes) = std::fs::read(folder.join(name)) else { continue };
        let raster = read(Format::Tiff, &bytes).expect("a raster");
        assert_eq!([raster.grid.columns(), raster.grid.rows()], [columns, rows]);
        assert_eq!(raster.crs.as_ref().and_then(|crs| crs.epsg), Some(epsg));
        let valid: Vec<f64> = raster.values.iter().copied().filter(|x| !x.is_nan()).collect();
        let (least, most) = valid.iter().fold((f64::MAX, f64::MIN), |(a, b), &x| (a.min(x), b.max(x)));
        assert!(
            valid.len() <= data && least >= low && most == high,
            "{name}: {} {least} {most}",
            valid.len()
        );
    }
}
