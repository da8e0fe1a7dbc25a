//! Files beside a raster, where other programs look for its place and its system of coordinates.
//!
//! `FILE.aux.xml` is GDAL's (PAM), `.prj` beside ASCII grids and the world file `.pgw` beside pictures are ESRI's. GDAL takes what
//! its file says for more than what the raster's own says, and does not look there for the system of an ASCII grid.

use std::fs;
use std::path::{Path, PathBuf};

use delone::surface::Grid;

use crate::crs::esri;
use crate::crs::keys::encode;
use crate::{Crs, Error, Format, Raster, open_as, read_raster_place};

/// The end of the name of GDAL's file beside another one.
const PAM: &str = ".aux.xml";
/// The ends of names of world files beside a GeoTIFF.
const WORLD: [&str; 3] = ["tfw", "tifw", "wld"];
/// Elements of GDAL's file that go before what a GeoTIFF says, and are not read.
const NOT_READ: [(&str, &str); 2] =
    [("GeoTransform", "the place of the raster"), ("NoDataValue", "the number for no data")];
/// Bytes of a file beside a raster that is read: a `.prj` has a kilobyte, GDAL's file some, with statistics and metadata.
const LONGEST_SIDE: u64 = 16 << 20;

/// The file beside a raster that says what its coordinates mean, or of a picture where it is, and its text; `None` where the raster's own file
/// says all of it, or nothing is known.
///
/// ```
/// use std::path::Path;
/// use delone::surface::Grid;
/// use delone_io::{Crs, Format, beside_raster};
///
/// let grid = Grid::new([100.0, 200.0], [2.0, -2.0], 3, 4)?;
/// let known = Crs::of_epsg(25832);
/// assert_eq!(beside_raster(Path::new("dem.tif"), Format::Tiff, &grid, Some(&known)), None);
/// let ours = Crs::of_wkt("PROJCS[\"ours\",UNIT[\"metre\",1]]").expect("a system");
/// let (path, text) = beside_raster(Path::new("dem.tif"), Format::Tiff, &grid, Some(&ours)).expect("a file");
/// assert_eq!(path, Path::new("dem.tif.aux.xml"));
/// assert!(text.contains("PROJCS[&quot;ours&quot;"));
/// let (path, text) = beside_raster(Path::new("shade.png"), Format::Png, &grid, None).expect("a file");
/// assert_eq!((path.as_path(), text.as_str()), (Path::new("shade.pgw"), "2.0\n0.0\n0.0\n-2.0\n101.0\n199.0\n"));
/// # Ok::<(), delone::Error>(())
/// ```
pub fn beside_raster(
    path: &Path,
    format: Format,
    grid: &Grid,
    crs: Option<&Crs>,
) -> Option<(PathBuf, String)> {
    let name = path.file_name().filter(|_| path != Path::new("-"))?;
    if format == Format::Png {
        return Some((path.with_extension("pgw"), world(grid)));
    }
    match (format, crs?) {
        (Format::Tiff, crs) if !encode(Some(crs)).are_complete => {
            let definition = crs.wkt.clone().or_else(|| Some(format!("EPSG:{}", crs.epsg?)))?;
            let mut side = name.to_owned();
            side.push(PAM);
            let text =
                format!("<PAMDataset>\n  <SRS>{}</SRS>\n</PAMDataset>\n", crate::xml::escaped(&definition));
            Some((path.with_file_name(side), text))
        }
        (Format::Asc, Crs { wkt: Some(wkt), .. }) => Some((path.with_extension("prj"), format!("{wkt}\n"))),
        _ => None,
    }
}

/// The system that a file beside a raster says it has: the element `SRS` of GDAL's, or well-known text.
///
/// # Errors
/// If the file is not understood, in which case other programs may take the raster to be elsewhere.
///
/// ```
/// use std::path::Path;
/// use delone_io::crs_of_side;
///
/// let text = "<PAMDataset><SRS>EPSG:25832</SRS></PAMDataset>";
/// let crs = crs_of_side(Path::new("dem.tif.aux.xml"), text)?.expect("a system");
/// assert_eq!(crs.epsg, Some(25832));
/// assert!(crs_of_side(Path::new("dem.tif.aux.xml"), "<PAMDataset/>")?.is_none());
/// # Ok::<(), delone_io::Error>(())
/// ```
pub fn crs_of_side(side: &Path, text: &str) -> Result<Option<Crs>, Error> {
    let not_known = || Error::content("its system of coordinates is not understood");
    if side.extension() == Some("prj".as_ref()) {
        return esri::read(text).map(Some).ok_or_else(not_known);
    }
    let document = crate::xml::parse(text)?;
    let srs = document.descendants().find(|node| node.has_tag_name("SRS")).and_then(|node| node.text());
    srs.map(|name| Crs::of_name(name).ok_or_else(not_known)).transpose()
}

/// Replaces the system of a raster by that of a file beside it, as GDAL does: GDAL's own file goes before what a GeoTIFF says, and a `.prj`
/// stands for what an ASCII grid cannot say. Other formats have none. Returns what is not understood or not read, with the names of the files.
///
/// ```
/// use std::path::Path;
/// use delone_io::{Crs, heed_sides};
///
/// let folder = std::env::temp_dir();
/// # let folder = folder.join(format!("delone-sides-{}", std::process::id()));
/// # std::fs::create_dir_all(&folder)?;
/// std::fs::write(folder.join("dem.prj"), "PROJCS[\"ETRS_1989_UTM_Zone_32N\",GEOGCS[\"GCS_ETRS_1989\"]]")?;
/// let mut crs = None;
/// assert!(heed_sides(&mut crs, &folder.join("dem.asc")).is_empty());
/// assert_eq!(crs.and_then(|crs| crs.epsg), Some(25832));
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn heed_sides(crs: &mut Option<Crs>, path: &Path) -> Vec<String> {
    let Ok(format @ (Format::Tiff | Format::Asc)) = Format::of(path) else { return Vec::new() };
    let mut losses = Vec::new();
    for side in besides_of_raster(path, format) {
        let is_read = match side.extension().and_then(|extension| extension.to_str()) {
            Some("xml") => format == Format::Tiff,
            Some("prj") => crs.is_none(),
            _ => false,
        };
        let Some(about) = fs::metadata(&side).ok().filter(|about| is_read && about.is_file()) else {
            continue;
        };
        if about.len() > LONGEST_SIDE {
            losses.push(format!("{}: it is not read, because it is longer than 16 MiB", side.display()));
            continue;
        }
        let text = fs::read(&side).map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        if format == Format::Tiff {
            losses.extend(text.iter().flat_map(|text| not_read(&side, text)));
        }
        match text.map_err(Error::from).and_then(|text| crs_of_side(&side, &text)) {
            // Keys that define the system of the file go along where the other name is for the same.
            Ok(Some(other)) => {
                let keys = crs.take().filter(|own| own.epsg == other.epsg).and_then(|own| own.keys);
                *crs = Some(Crs { keys, ..other });
            }
            Ok(None) => {}
            Err(error) => losses.push(format!("{}: {error}", side.display())),
        }
    }
    let mut worlds = WORLD.iter().map(|end| path.with_extension(end));
    // A pipe was read by now, and would be waited for.
    if format == Format::Tiff
        && path.is_file()
        && let Some(world) = worlds.find(|world| world.is_file())
        && is_nowhere(path)
    {
        losses.push(format!("{}: the place of the raster is not read", world.display()));
    }
    losses
}

/// What a file of GDAL says of a raster besides its system, and is not read.
fn not_read(side: &Path, text: &str) -> Vec<String> {
    let Ok(document) = crate::xml::parse(text) else { return Vec::new() };
    let is_there = |name: &str| document.descendants().any(|node| node.has_tag_name(name));
    let found = NOT_READ.iter().filter(|entry| is_there(entry.0));
    found.map(|(name, what)| format!("{}: {what} is not read ({name})", side.display())).collect()
}

/// Whether a GeoTIFF does not say where it is.
fn is_nowhere(path: &Path) -> bool {
    let place = open_as(path, Format::Tiff).and_then(|source| read_raster_place(source, Format::Tiff));
    place.is_ok_and(|(grid, _)| Raster::nowhere(grid.columns(), grid.rows()).is_ok_and(|none| none == grid))
}

/// Where the pixels of a picture are, in six lines: the size of a pixel to the east, two of rotation, the size of a pixel to the next row, and
/// the center of the first pixel (Esri).
fn world(grid: &Grid) -> String {
    let ([dx, dy], [x, y]) = (grid.step(), grid.center(0, 0));
    format!("{dx:?}\n0.0\n0.0\n{dy:?}\n{x:?}\n{y:?}\n")
}

/// All files beside a raster that programs read with it: its system and statistics, overviews, mask; none beside standard output.
/// Whoever replaces the raster replaces or removes them.
///
/// ```
/// use std::path::Path;
/// use delone_io::{Format, besides_of_raster};
///
/// let sides = besides_of_raster(Path::new("dem.asc"), Format::Asc);
/// assert!(sides.iter().any(|side| side == Path::new("dem.prj")));
/// ```
pub fn besides_of_raster(path: &Path, format: Format) -> Vec<PathBuf> {
    let has_some = matches!(format, Format::Tiff | Format::Asc | Format::Png) && path != Path::new("-");
    let (true, Some(name)) = (has_some, path.file_name()) else { return Vec::new() };
    let with = |end: &str| {
        let mut name = name.to_owned();
        name.push(end);
        path.with_file_name(name)
    };
    let mut sides = [PAM, ".ovr", ".msk"].map(with).to_vec();
    match format {
        Format::Asc => sides.push(path.with_extension("prj")),
        Format::Png => sides.push(path.with_extension("pgw")),
        _ => {}
    }
    sides
}
