//! Errors of files, with the place in the file.

use std::borrow::Cow;

use crate::{Contents, Direction, Format};

/// Why a file could not be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The operating system said no, or the file ended too early.
    #[error(transparent)]
    Io(std::io::Error),
    /// Compressed content is more than 1,000 times as long as the file ([`crate::trust_compressed`]).
    #[error("its compressed content is more than 1,000 times as long as the file")]
    Expands,
    /// More is written than [`crate::limit_output`] allows.
    #[error("more is written than the limit of output allows")]
    TooMuchOutput,
    /// A line of a text format is wrong.
    #[error("line {line}: {}", clipped(what))]
    Line {
        /// Counted from 1.
        line: usize,
        /// The fault.
        what: String,
    },
    /// The file ends too early.
    #[error("the file ends {}", clipped(.0))]
    Truncated(String),
    /// The content contradicts the format.
    #[error("{}", clipped(.0))]
    Content(String),
    /// Files that are read together have different systems of coordinates, or of heights.
    #[error("its {what} are {theirs}, those before it {ours}")]
    Systems {
        /// Coordinates or heights.
        what: &'static str,
        /// The system of the files before.
        ours: String,
        /// The system of this file.
        theirs: String,
    },
    /// A region or a boundary has two names.
    #[error("{what} {number} is named {:?} and {:?}", excerpt(&names[0]), excerpt(&names[1]))]
    TwoNames {
        /// Region or boundary.
        what: &'static str,
        /// Its number.
        number: String,
        /// The names.
        names: Box<[String; 2]>,
    },
    /// Two regions, or two boundaries, have one name.
    #[error(
        "the name {:?} is that of {what} {} and of {what} {}", excerpt(name), numbers[0], numbers[1]
    )]
    SharedName {
        /// Region or boundary.
        what: &'static str,
        /// The name.
        name: String,
        /// Their numbers.
        numbers: Box<[String; 2]>,
    },
    /// The points of a file have no dimension of this name.
    #[error("its points have no {}, but {}", clipped(name), clipped(names))]
    NoDimension {
        /// The name that was given.
        name: String,
        /// The names of the dimensions of the points.
        names: String,
    },
    /// The nodes of an EPT are stored in a way that is not read.
    #[error("EPT: nodes of the type {:?} are not read", clipped(.0))]
    DataType(String),
    /// The values of a raster are compressed in a way that is not read.
    #[error("TIFF: values that are compressed with {0} are not read")]
    Compression(String),
    /// A ring of a polygon does not end where it begins.
    #[error(
        "ring {ring} of polygon {polygon} is not closed: it begins at {:?} {:?} and ends at {:?} {:?}",
        first[0], first[1], last[0], last[1]
    )]
    OpenRing {
        /// The polygon, from 0 in the file.
        polygon: usize,
        /// The ring of that polygon, 0 for the outer one.
        ring: usize,
        /// Its first position.
        first: [f64; 2],
        /// Its last position.
        last: [f64; 2],
    },
    /// The points are in a `.node` file, which is not known here.
    #[error("the file has no points of its own: they are in the .node file beside it")]
    PointsElsewhere,
    /// Files of this format do not hold what was asked for.
    #[error("{contents} are not {direction} {format} files")]
    Unsupported {
        /// The format.
        format: Format,
        /// The contents that it does not hold.
        contents: Contents,
        /// Whether it was to be read or written.
        direction: Direction,
    },
    /// No format has this extension.
    #[error("{0}: no format has this extension")]
    UnknownExtension(String),
    /// The format is not in this program, which was built without what it takes.
    #[error("{format} files are not read or written by this program, which was built without {feature}")]
    LeftOut {
        /// The format.
        format: Format,
        /// The feature of the crate that has it.
        feature: &'static str,
    },
    /// The circumcenter of a triangle is no finite number.
    #[error("the circumcenter of triangle {triangle} is too far away to be written")]
    FarCenter {
        /// Its number in the `.ele` file.
        triangle: usize,
    },
    /// The format has square cells alone, in rows from north to south.
    #[error("the cells of {format} files are square, in rows from north to south, not {:?} by {:?}", step[0], step[1])]
    NotSquare {
        /// The format.
        format: Format,
        /// The steps from column to column and from row to row.
        step: [f64; 2],
    },
    /// The format cannot count so many columns or rows, or there is none.
    #[error("a raster of {columns} columns and {rows} rows is not written to {format} files")]
    Extent {
        /// The format.
        format: Format,
        /// The columns.
        columns: usize,
        /// The rows.
        rows: usize,
    },
    /// Other than whole rows were given, or more or fewer than the raster has.
    #[error("the raster has {rows} rows of {columns} values: {values} values are no such rows")]
    Rows {
        /// The columns of the raster.
        columns: usize,
        /// The rows of the raster.
        rows: usize,
        /// The values that were given.
        values: usize,
    },
    /// A value is beyond the numbers of the raster.
    #[error("the value {value:?} in column {column} of row {row} is beyond the numbers of the raster")]
    Beyond {
        /// The column, from 0.
        column: usize,
        /// The row, from 0.
        row: usize,
        /// The value.
        value: f64,
    },
}

impl From<std::io::Error> for Error {
    fn from(error: std::io::Error) -> Self {
        // Readers that decompress can only say it by way of an error of input.
        error.downcast::<Self>().unwrap_or_else(Self::Io)
    }
}

impl Error {
    pub(crate) fn content(what: impl Into<String>) -> Self {
        Self::Content(what.into())
    }

    /// Advice to the user.
    pub fn help(&self) -> Cow<'static, str> {
        Cow::Borrowed(match self {
            Self::Truncated(_) => "copy or download it again: it is shorter than it says",
            Self::TooMuchOutput => "allow more with --max-output SIZE",
            Self::Expands => "if it is meant, allow memory with --max-memory SIZE, or decompress it first",
            Self::Io(_) => "check the name, the permissions and the room on the disk",
            Self::Line { .. } => "correct that line",
            Self::Content(_) => {
                "check that the file is what its extension says, or name the format with --from"
            }
            Self::Systems { .. } => "transform one of them first",
            Self::TwoNames { .. } => "give it one of them with --region or --boundary",
            Self::SharedName { .. } => "give one of them another name, or both the same number",
            Self::NoDimension { .. } => "name one of these, with extra bytes as delone info lists them",
            Self::DataType(_) => "convert it with pdal translate ept.json out.copc.laz",
            Self::Compression(_) => "convert it with gdal_translate -co COMPRESS=DEFLATE",
            Self::OpenRing { .. } => "repeat the first position of the ring at its end",
            Self::PointsElsewhere => {
                "read the points from the .node file of the same name, or put them into this file"
            }
            Self::UnknownExtension(name) if is_of_others(name) => {
                return Cow::Owned(format!(
                    "convert it with ogr2ogr -f GPKG out.gpkg {name}; as an output write gpkg, and convert that"
                ));
            }
            Self::UnknownExtension(name) if has_extension(name, &["gif", "webp", "apng", "mp4"]) => {
                "pictures are svg or png; of motions delone-lab animate makes a png that moves, which ffmpeg converts"
            }
            Self::UnknownExtension(name)
                if has_extension(name, &["jpg", "jpeg", "bmp", "pdf", "eps", "ps"]) =>
            {
                "pictures are svg or png: write one of these and convert it"
            }
            Self::UnknownExtension(_) => "name the format with --from or --to",
            Self::LeftOut { .. } => {
                "build it with that feature, or convert the file with ogr2ogr -f FlatGeobuf OUT.fgb IN"
            }
            Self::FarCenter { .. } => "leave out such flat triangles, or the Voronoi diagram",
            Self::NotSquare { .. } => "choose tif or npy, or a raster with square cells",
            Self::Extent { .. } => "choose a larger cell, or write the raster in parts",
            Self::Rows { .. } => "give the values of whole rows, as many as the raster has",
            Self::Beyond { .. } => "choose numbers of 64 bits, or remove that value",
            Self::Unsupported { contents, direction, format } => {
                let formats = Format::with(&[*contents], *direction);
                let way = format.other_way(*contents, *direction).map(|way| way + "; ").unwrap_or_default();
                let maker = match (contents, direction) {
                    (Contents::Rasters, Direction::Read) => "; delone dtm makes one of points with heights",
                    _ => "",
                };
                return Cow::Owned(format!("{way}{contents} are {direction}: {formats}{maker}"));
            }
        })
    }
}

/// Whether a name is that of a file of features in a format that is not read here, and that GDAL reads.
fn is_of_others(name: &str) -> bool {
    const OTHERS: [&str; 11] =
        ["kml", "kmz", "gml", "tab", "mif", "gdb", "topojson", "parquet", "geoparquet", "dgn", "osm"];
    has_extension(name, &OTHERS)
}

fn has_extension(name: &str, any: &[&str]) -> bool {
    let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
    any.iter().any(|other| extension.eq_ignore_ascii_case(other))
}

/// A message that may quote what others wrote, at most as long as is read.
fn clipped(text: &str) -> String {
    match text.char_indices().nth(300) {
        Some((end, _)) => format!("{} ...", &text[..end]),
        None => text.to_owned(),
    }
}

/// Names that a message lists: the beginnings of the first ones, and how many more there are.
pub(crate) fn listed<'a>(names: impl ExactSizeIterator<Item = &'a str>) -> String {
    /// Names that are listed; more are counted.
    const LISTED_NAMES: usize = 10;
    let more = names.len().saturating_sub(LISTED_NAMES);
    let first = names.take(LISTED_NAMES).map(excerpt).collect::<Vec<_>>().join(", ");
    if more > 0 { format!("{first} and {more} more") } else { first }
}

/// The beginning of a text that a message quotes.
pub(crate) fn excerpt(text: &str) -> &str {
    match text.char_indices().nth(40) {
        Some((end, _)) => &text[..end],
        None => text,
    }
}
