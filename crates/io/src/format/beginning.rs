//! Beginnings of files: they tell the format of a content where something is wrong with it.

use std::borrow::Cow;

use super::Format;
use crate::Error;

/// How the beginning of a content fits a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fit {
    /// As far as can be told.
    Well,
    /// All files of the format begin in another way.
    Not,
    /// It is the beginning of this one.
    Of(Format),
}

/// The first bytes of files of binary formats.
const SIGNATURES: &[(Format, &[u8])] = &[
    (Format::Las, b"LASF"),
    (Format::Npy, b"\x93NUMPY"),
    (Format::Npz, b"PK\x03\x04"),
    (Format::E57, b"ASTM-E57"),
    (Format::Tiff, b"II*\0"),
    (Format::Tiff, b"II+\0"),
    (Format::Tiff, b"MM\0*"),
    (Format::Tiff, b"MM\0+"),
    (Format::FlatGeobuf, b"fgb\x03fgb"),
    (Format::GeoPackage, b"SQLite format 3\0"),
    (Format::Shapefile, b"\0\0\x27\x0a"),
    (Format::Ply, b"ply\n"),
    (Format::Ply, b"ply\r"),
    (Format::Vtk, b"# vtk DataFile"),
    (Format::Pcd, b"# .PCD"),
];

/// Formats whose files all begin in a way that is known here.
const ALWAYS: [Format; 14] = [
    Format::Las,
    Format::Npy,
    Format::Npz,
    Format::E57,
    Format::Tiff,
    Format::FlatGeobuf,
    Format::GeoPackage,
    Format::Shapefile,
    Format::Ply,
    Format::Vtk,
    Format::Vtu,
    Format::Off,
    Format::GeoJson,
    Format::Gpx,
];

/// The first words of files of text.
const WORDS: [(Format, &[&str]); 7] = [
    (Format::Msh, &["$MeshFormat"]),
    (Format::Medit, &["MeshVersionFormatted"]),
    (Format::Su2, &["NDIME=", "NZONE="]),
    (Format::Off, &["OFF", "COFF", "NOFF", "CNOFF", "STOFF"]),
    (Format::Stl, &["solid"]),
    (Format::Pcd, &["VERSION", "FIELDS"]),
    (Format::Asc, &["ncols", "nrows", "NCOLS", "NROWS"]),
];

/// The kinds of geometries in well-known text.
const GEOMETRIES: [&str; 11] = [
    "POINT",
    "LINESTRING",
    "POLYGON",
    "MULTIPOINT",
    "MULTILINESTRING",
    "MULTIPOLYGON",
    "GEOMETRYCOLLECTION",
    "TRIANGLE",
    "TIN",
    "POLYHEDRALSURFACE",
    "SRID",
];

impl Format {
    /// Advice on an error in a file of this format. `beginning` holds its first few thousand bytes, or nothing where that is
    /// not known.
    ///
    /// ```
    /// use delone_io::{Error, Format};
    ///
    /// let error = Error::Line { line: 7, what: "\"q\" is no number".to_owned() };
    /// assert_eq!(Format::Asc.help(&error, b"ncols 2"), "correct that line");
    /// assert!(Format::Text.help(&error, b"ncols 2").ends_with("name the format with --from asc"));
    /// ```
    pub fn help(self, error: &Error, beginning: &[u8]) -> Cow<'static, str> {
        if !matches!(error, Error::Line { .. } | Error::Content(_) | Error::Truncated(_)) {
            return error.help();
        }
        match (self.fit(beginning), error) {
            (Fit::Of(found), _) => {
                let what = format!("it begins as {found} files do ({})", found.title());
                Cow::Owned(format!("{what}: give it that extension, or name the format with --from {found}"))
            }
            (Fit::Not, Error::Line { .. } | Error::Content(_)) => Cow::Owned(format!(
                "it does not begin as {self} files do: check what it is, and name its format with --from"
            )),
            (_, Error::Line { .. }) if self == Self::Text => {
                Cow::Borrowed("correct that line, or choose columns with --columns")
            }
            (_, Error::Content(_)) => {
                Cow::Borrowed("correct it there, or write it anew with the program that it is from")
            }
            _ => error.help(),
        }
    }

    /// How a content that begins so fits this format.
    fn fit(self, beginning: &[u8]) -> Fit {
        let own = self.read_as();
        match of(beginning) {
            // A table may have geometries in its first column.
            Some(found) if found == own || (own, found) == (Self::Text, Self::Wkt) => Fit::Well,
            Some(found) => Fit::Of(found),
            None if ALWAYS.contains(&own) => Fit::Not,
            None => Fit::Well,
        }
    }

    /// The one of the formats with its reader that stands for all.
    fn read_as(self) -> Self {
        match self {
            Self::Vtp => Self::Vtu,
            // Both are JSON.
            Self::GeoJsonLines | Self::Ept => Self::GeoJson,
            Self::WktCollection => Self::Wkt,
            other => other,
        }
    }
}

/// The format of a content that begins so, where that is a sign of one.
fn of(beginning: &[u8]) -> Option<Format> {
    if let Some(known) = SIGNATURES.iter().find(|known| beginning.starts_with(known.1)) {
        return Some(known.0);
    }
    let text = String::from_utf8_lossy(beginning);
    // Before sequences of JSON there is a separator.
    let text = text.trim_start_matches(['\u{feff}', '\u{1e}']).trim_start();
    match text.chars().next()? {
        '{' | '[' => return Some(Format::GeoJson),
        '<' => return of_xml(text),
        _ => {}
    }
    let mut words =
        text.lines().filter(|line| !line.trim_start().starts_with('#')).flat_map(str::split_whitespace);
    let first = words.next()?;
    if let Some((format, _)) = WORDS.iter().find(|(_, known)| known.contains(&first)) {
        return Some(*format);
    }
    let second = words.next().unwrap_or_default();
    if (first, second) == ("ITEM:", "TIMESTEP") {
        return Some(Format::Lammps);
    }
    if first.parse::<u64>().is_ok()
        && text
            .lines()
            .nth(1)
            .is_some_and(|line| ["Lattice=", "Properties="].iter().any(|key| line.contains(key)))
    {
        return Some(Format::ExtXyz);
    }
    if (first, second) == ("0", "SECTION") {
        return Some(Format::Dxf);
    }
    let (kind, rest) = text.split_at(text.find(|c: char| !c.is_ascii_alphabetic())?);
    let is_kind = GEOMETRIES.iter().any(|known| known.eq_ignore_ascii_case(kind));
    let goes_on = rest.trim_start().starts_with(['(', '='])
        || ["Z", "M", "ZM", "EMPTY"].iter().any(|word| word.eq_ignore_ascii_case(second));
    (is_kind && goes_on).then_some(Format::Wkt)
}

fn of_xml(text: &str) -> Option<Format> {
    let has = |element: &str| text.contains(element);
    if has("<VTKFile") {
        Some(Format::Vtu)
    } else if has("<gpx") || has(":gpx") {
        Some(Format::Gpx)
    } else {
        None
    }
}
