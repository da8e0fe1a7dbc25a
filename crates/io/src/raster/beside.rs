//! What a raster's own file cannot say of its system of coordinates: in a file beside it, where other programs look for it.
//!
//! `FILE.aux.xml` is GDAL's (PAM), `.prj` beside ASCII grids is ESRI's.

use std::path::{Path, PathBuf};

use crate::crs::keys::encode;
use crate::{Crs, Format};

/// The file beside a raster that says what its coordinates mean, and its text; `None` where the raster's own file says all of
/// it, or nothing is known.
///
/// ```
/// use std::path::Path;
/// use delone_io::{Crs, Format, beside_raster};
///
/// let known = Crs::of_epsg(25832);
/// assert_eq!(beside_raster(Path::new("dem.tif"), Format::Tiff, Some(&known)), None);
/// let ours = Crs::of_wkt("PROJCS[\"ours\",UNIT[\"metre\",1]]").expect("a system");
/// let (path, text) = beside_raster(Path::new("dem.tif"), Format::Tiff, Some(&ours)).expect("a file");
/// assert_eq!(path, Path::new("dem.tif.aux.xml"));
/// assert!(text.contains("PROJCS[&quot;ours&quot;"));
/// ```
pub fn beside_raster(path: &Path, format: Format, crs: Option<&Crs>) -> Option<(PathBuf, String)> {
    let (crs, beside) = (crs?, beside_raster_name(path, format)?);
    let text = match format {
        Format::Tiff if encode(Some(crs)).are_complete => return None,
        Format::Tiff => {
            let definition = crs.wkt.clone().or_else(|| Some(format!("EPSG:{}", crs.epsg?)))?;
            format!("<PAMDataset>\n  <SRS>{}</SRS>\n</PAMDataset>\n", escaped(&definition))
        }
        _ => format!("{}\n", crs.wkt.as_ref()?),
    };
    Some((beside, text))
}

/// The file that [`beside_raster`] may name; `None` for formats that have none.
pub fn beside_raster_name(path: &Path, format: Format) -> Option<PathBuf> {
    if path == Path::new("-") {
        return None;
    }
    match format {
        Format::Tiff => {
            let mut name = path.file_name()?.to_owned();
            name.push(".aux.xml");
            Some(path.with_file_name(name))
        }
        Format::Asc => Some(path.with_extension("prj")),
        _ => None,
    }
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
    let mut sides = [".aux.xml", ".ovr", ".msk"].map(with).to_vec();
    if format == Format::Asc {
        sides.push(path.with_extension("prj"));
    }
    sides
}

/// A text as XML has it, without what XML cannot hold.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c if c.is_control() && !c.is_whitespace() => {}
            c => escaped.push(c),
        }
    }
    escaped
}
