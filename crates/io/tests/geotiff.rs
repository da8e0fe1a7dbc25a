//! GeoTIFF as others write it: masks, parts that are left out, pages, overviews, compressions. The files are made here, tag by tag.

use std::fs;
use std::io::{Cursor, Write};
use std::path::Path;

use delone_io::{Error, Format, Raster, read_raster};
use ruzstd::encoding::{CompressionLevel, compress_to_vec};

/// An image of a file: its tags with one number each, and the strips or tiles.
struct Image {
    tags: Vec<(u16, u32)>,
    nodata: Option<&'static str>,
    is_tiled: bool,
    parts: Vec<Vec<u8>>,
}

/// An image of so many columns and rows of bytes.
fn image(columns: u32, rows: u32, parts: Vec<Vec<u8>>) -> Image {
    let tags = vec![(256, columns), (257, rows), (258, 8), (259, 1), (262, 1), (277, 1), (278, rows)];
    Image { tags, nodata: None, is_tiled: false, parts }
}

impl Image {
    fn with(mut self, tag: u16, value: u32) -> Self {
        self.tags.retain(|known| known.0 != tag);
        self.tags.push((tag, value));
        self
    }

    fn without_data(self, nodata: &'static str) -> Self {
        Self { nodata: Some(nodata), ..self }
    }

    /// The parts are tiles with so many columns and rows.
    fn tiled(self, side: u32) -> Self {
        Self { is_tiled: true, ..self.with(322, side).with(323, side) }
    }
}

/// A file of images, in either order of bytes.
fn file(images: &[Image], is_little: bool) -> Vec<u8> {
    let short = |x: u16| if is_little { x.to_le_bytes() } else { x.to_be_bytes() };
    let long = |x: u32| if is_little { x.to_le_bytes() } else { x.to_be_bytes() };
    let mut bytes = if is_little { b"II".to_vec() } else { b"MM".to_vec() };
    bytes.extend(short(42));
    let mut link = bytes.len();
    bytes.extend(long(0));
    for image in images {
        let (mut places, mut sizes) = (Vec::new(), Vec::new());
        for part in &image.parts {
            places.extend(long(if part.is_empty() { 0 } else { bytes.len() as u32 }));
            sizes.extend(long(part.len() as u32));
            bytes.extend_from_slice(part);
        }
        let count = image.parts.len() as u32;
        let mut entries: Vec<(u16, u16, u32, Vec<u8>)> =
            image.tags.iter().map(|&(tag, value)| (tag, 4, 1, long(value).to_vec())).collect();
        let (at, of) = if image.is_tiled { (324, 325) } else { (273, 279) };
        entries.extend([(at, 4, count, places), (of, 4, count, sizes)]);
        if let Some(nodata) = image.nodata {
            let text = [nodata.as_bytes(), &[0]].concat();
            entries.push((42_113, 2, text.len() as u32, text));
        }
        entries.sort_by_key(|entry| entry.0);
        let mut directory = short(entries.len() as u16).to_vec();
        for (tag, kind, count, mut value) in entries {
            directory.extend(short(tag));
            directory.extend(short(kind));
            directory.extend(long(count));
            if value.len() > 4 {
                directory.extend(long(bytes.len() as u32));
                bytes.extend_from_slice(&value);
            } else {
                value.resize(4, 0);
                directory.extend(value);
            }
        }
        let start = bytes.len();
        bytes[link..link + 4].copy_from_slice(&long(start as u32));
        bytes.extend(directory);
        link = bytes.len();
        bytes.extend(long(0));
    }
    bytes
}

fn read(images: &[Image]) -> Result<Raster, Error> {
    let [little, big] = [true, false]
        .map(|is_little| read_raster(Box::new(Cursor::new(file(images, is_little))), Format::Tiff));
    assert_eq!(little.as_ref().map(bits).map_err(message), big.as_ref().map(bits).map_err(message));
    little
}

fn bits(raster: &Raster) -> Vec<u64> {
    raster.values.iter().map(|x| x.to_bits()).collect()
}

fn message(error: &Error) -> String {
    error.to_string()
}

/// Values with -1 for no data.
fn values(images: &[Image]) -> Vec<f64> {
    let raster = read(images).expect("a raster");
    raster.values.iter().map(|&x| if x.is_nan() { -1.0 } else { x }).collect()
}

fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
    encoder.write_all(bytes).expect("memory");
    encoder.finish().expect("memory")
}

#[test]
fn cells_that_a_mask_leaves_out_have_no_data() {
    let heights = || image(3, 2, vec![vec![10, 11, 12, 13, 14, 15]]);
    let expected = [10.0, -1.0, 12.0, -1.0, -1.0, 15.0];
    let bits = || image(3, 2, vec![vec![0b1010_0000, 0b0010_0000]]).with(258, 1).with(262, 4).with(254, 4);
    assert_eq!(values(&[heights(), bits()]), expected);
    let bytes = image(3, 2, vec![deflated(&[255, 0, 255, 0, 0, 255])]).with(259, 8).with(262, 4).with(254, 4);
    assert_eq!(values(&[heights(), bytes]), expected);
    // A mask in strips, of which one is left out: nothing is valid there.
    let strips = image(3, 2, vec![vec![], vec![0b0010_0000]]);
    let strips = strips.with(258, 1).with(262, 4).with(254, 4).with(278, 1);
    assert_eq!(values(&[heights(), strips]), [-1.0, -1.0, -1.0, -1.0, -1.0, 15.0]);
    // Masks of overviews, and of other sizes, are those of other images.
    let smaller = || image(2, 1, vec![vec![0]]).with(258, 1).with(262, 4);
    let all = [10.0, 11.0, 12.0, 13.0, 14.0, 15.0];
    assert_eq!(values(&[heights(), smaller().with(254, 5), smaller().with(254, 4)]), all);
    let short = image(3, 2, vec![vec![0b1010_0000]]).with(258, 1).with(262, 4).with(254, 4);
    assert!(matches!(read(&[heights(), short]), Err(Error::Truncated(_))));
}

#[test]
fn parts_that_are_left_out_have_no_data_or_zero() {
    let tiles = || image(3, 2, vec![vec![1, 2, 4, 5], vec![]]).tiled(2);
    assert_eq!(values(&[tiles()]), [1.0, 2.0, 0.0, 4.0, 5.0, 0.0]);
    assert_eq!(values(&[tiles().without_data("7")]), [1.0, 2.0, -1.0, 4.0, 5.0, -1.0]);
    let strips = image(2, 2, vec![vec![], vec![1, 7]]).with(278, 1).without_data("7");
    assert_eq!(values(&[strips]), [-1.0, -1.0, 1.0, -1.0]);
    // Many that are left out take no more memory than others: 64 MiB of a small file.
    let side = 1 << 14;
    let large = image(side, side, vec![vec![]]);
    assert!(matches!(read(&[large]), Err(Error::Expands)));
}

#[test]
fn the_first_page_counts_and_overviews_do_not() {
    let page = |value| image(1, 1, vec![vec![value]]);
    let raster = read(&[page(1).with(254, 1), page(2), page(3).with(254, 1)]).expect("a raster");
    assert_eq!((raster.values, raster.losses), (vec![2.0], Vec::<String>::new()));
    let raster = read(&[page(1), page(2).with(254, 2), page(3)]).expect("a raster");
    assert_eq!(
        (&raster.values[..], &raster.losses[..]),
        (&[1.0][..], &["of 3 pages the first is read".to_owned()][..])
    );
    assert_eq!(raster.into_points().losses, ["of 3 pages the first is read"]);
    assert!(read(&[page(1).with(254, 1)]).is_err());
    // Directories that go around are refused, not followed for ever.
    let mut bytes = file(&[page(1), page(2)], true);
    let (link, end) = (bytes[4..8].to_vec(), bytes.len() - 4);
    bytes[end..].copy_from_slice(&link);
    let error = read_raster(Box::new(Cursor::new(bytes)), Format::Tiff).expect_err("a circle");
    assert_eq!(error.to_string(), "TIFF: the directories go around in a circle");
}

#[test]
fn zstandard_is_read_with_predictors() {
    let heights: Vec<u8> = (0..200).map(|k| (k * k % 251) as u8).collect();
    let expected: Vec<f64> = heights.iter().map(|&x| f64::from(x)).collect();
    let packed = |bytes: &[u8]| compress_to_vec(bytes, CompressionLevel::Fastest);
    assert_eq!(values(&[image(20, 10, vec![packed(&heights)]).with(259, 50_000)]), expected);
    let differences: Vec<u8> = (0..200)
        .map(|k| if k % 20 == 0 { heights[k] } else { heights[k].wrapping_sub(heights[k - 1]) })
        .collect();
    let predicted = || image(20, 10, vec![packed(&differences)]).with(259, 50_000).with(317, 2);
    assert_eq!(values(&[predicted()]), expected);
    let short = image(20, 11, vec![packed(&heights)]).with(259, 50_000);
    assert!(matches!(read(&[short]), Err(Error::Truncated(_))));
    let whole = packed(&heights);
    for end in 0..whole.len() {
        assert!(end == 0 || read(&[image(20, 10, vec![whole[..end].to_vec()]).with(259, 50_000)]).is_err());
    }
    // A part that claims more than its bytes can be.
    let claims = image(1 << 14, 1 << 13, vec![packed(&[0; 64])]).with(259, 50_000);
    assert!(matches!(read(&[claims]), Err(Error::Expands)));
}

#[test]
fn compressions_that_are_not_read_are_named() {
    for (number, name) in
        [(34_887, "LERC"), (34_925, "LZMA"), (7, "JPEG"), (50_002, "JPEG XL"), (999, "number 999")]
    {
        let error = read(&[image(1, 1, vec![vec![1]]).with(259, number)]).expect_err(name);
        assert_eq!(error.to_string(), format!("TIFF: values that are compressed with {name} are not read"));
        assert_eq!(error.help(), "convert it with gdal_translate -co COMPRESS=DEFLATE");
    }
}

/// Files that GDAL wrote, of known values: where a mask or a tile that is left out says so there is none.
#[test]
fn files_of_gdal_are_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/rasters");
    for name in
        ["mask_deflate", "mask_tiled", "sparse", "zstd", "zstd_tiled", "overviews_lzw", "packbits_big"]
    {
        let bytes = fs::read(folder.join(format!("{name}.tif"))).expect(name);
        let raster = read_raster(Box::new(Cursor::new(bytes)), Format::Tiff).expect(name);
        assert_eq!((raster.grid.columns(), raster.grid.rows()), (50, 40), "{name}");
        assert_eq!(raster.crs.as_ref().and_then(|crs| crs.epsg), Some(25_832), "{name}");
        for (i, value) in raster.values.iter().enumerate() {
            let (row, column) = (i / 50, i % 50);
            let has_value = match name {
                "sparse" => row < 16 && column < 16 || (16..32).contains(&row) && (32..48).contains(&column),
                _ => !name.starts_with("mask") || !(row + column).is_multiple_of(5),
            };
            let expected = if has_value { ((7 * row + 3 * column) % 250) as f64 } else { f64::NAN };
            assert!(value.total_cmp(&expected).is_eq(), "{name}: {value}, {expected} at {row}, {column}");
        }
    }
}
