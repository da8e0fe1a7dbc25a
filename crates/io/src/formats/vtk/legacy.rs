//! VTK's legacy files: a heading, then sections that a word begins, whose numbers are text or big-endian.
//!
//! Cells are lists `count corner ...` up to version 4, and from version 5 on the ends of all cells and then all corners.

use super::cells::{Cells, POLYGON, POLYLINE, STRIP};
use super::{broken, number};
use crate::error::excerpt;
use crate::formats::numbers::Number;
use crate::{Cloud, Error, Source};

/// Sections of cells of one kind.
const LISTS: [(&str, u8); 3] = [("LINES", POLYLINE), ("POLYGONS", POLYGON), ("TRIANGLE_STRIPS", STRIP)];

/// Reads the points, and the cells if they are wanted.
pub(super) fn read(mut source: Box<dyn Source>, with_cells: bool) -> Result<(Cloud, Cells), Error> {
    let mut bytes = Vec::new();
    source.read_to_end(&mut bytes)?;
    let mut reader = Reader::start(&bytes)?;
    let mut cloud = reader.points()?;
    if reader.has_fields() {
        cloud.losses.push("values of points and cells are left out".to_owned());
    }
    let cells = if with_cells { reader.cells(cloud.xy.len())? } else { Cells::default() };
    Ok((cloud, cells))
}

struct Reader<'a> {
    bytes: &'a [u8],
    /// The place in the bytes.
    at: usize,
    is_binary: bool,
    /// Whether cells are ends and corners.
    has_ends: bool,
}

impl<'a> Reader<'a> {
    /// Reads the heading: the version, a title, and how numbers are stored.
    fn start(bytes: &'a [u8]) -> Result<Self, Error> {
        let mut reader = Self { bytes, at: 0, is_binary: false, has_ends: false };
        let first = reader.line();
        let Some(version) = first.strip_prefix("# vtk DataFile") else {
            return Err(broken("it does not begin as a VTK file"));
        };
        let version = version.split_whitespace().last().unwrap_or_default();
        reader.has_ends = version.parse().is_ok_and(|version: f64| version >= 5.0);
        reader.line();
        reader.is_binary = reader.word() == Some("BINARY");
        Ok(reader)
    }

    /// The rest of a line.
    fn line(&mut self) -> &'a str {
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
        self.at += (end + 1).min(rest.len());
        std::str::from_utf8(&rest[..end]).unwrap_or_default().trim()
    }

    /// The next word; nothing at the end, or where there is no text.
    fn word(&mut self) -> Option<&'a str> {
        let rest = &self.bytes[self.at..];
        let Some(start) = rest.iter().position(|byte| !byte.is_ascii_whitespace()) else {
            self.at = self.bytes.len();
            return None;
        };
        let length = rest[start..].iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len() - start);
        self.at += start + length;
        std::str::from_utf8(&rest[start..start + length]).ok()
    }

    fn count(&mut self, what: &str) -> Result<usize, Error> {
        let word = self.word().unwrap_or_default();
        word.parse().map_err(|_| broken(format!("{:?} is no number of {what}", excerpt(word))))
    }

    /// The type of the numbers that follow from the next line on.
    fn kind(&mut self) -> Result<Number, Error> {
        let kind = legacy_type(self.word().unwrap_or_default())?;
        self.line();
        Ok(kind)
    }

    /// `each` numbers for each of `count` things.
    fn numbers(&mut self, each: usize, count: usize, kind: Number, what: &str) -> Result<Vec<f64>, Error> {
        let ends = |there| Err(Error::Truncated(format!("after {there} of {count} {what}")));
        let rest = &self.bytes[self.at..];
        if each == 0 {
            return Ok(Vec::new());
        }
        if self.is_binary {
            let row = each.saturating_mul(kind.size());
            let bytes = count.checked_mul(row).filter(|&length| length <= rest.len());
            let Some(length) = bytes else { return ends(rest.len() / row) };
            self.at += length;
            return Ok(rest[..length].chunks_exact(kind.size()).map(|word| kind.read(word, true)).collect());
        }
        let mut numbers = Vec::with_capacity(each.saturating_mul(count).min(rest.len() / 2));
        for i in 0..count {
            for _ in 0..each {
                let Some(word) = self.word() else { return ends(i) };
                numbers.push(number(word)?);
            }
        }
        Ok(numbers)
    }

    /// Reads up to the points, and the points.
    fn points(&mut self) -> Result<Cloud, Error> {
        loop {
            match self.word() {
                None => return Err(broken("it has no list of points")),
                Some("POINTS") => break,
                Some("FIELD") => self.pass_field()?,
                Some(_) => {
                    self.line();
                }
            }
        }
        let count = self.count("points")?;
        let kind = self.kind()?;
        let numbers = self.numbers(3, count, kind, "points")?;
        let mut cloud = Cloud::with_capacity(count, true);
        numbers.chunks_exact(3).for_each(|p| cloud.push([p[0], p[1]], p[2]));
        Ok(cloud)
    }

    /// Whether there are values of points or cells in the rest.
    fn has_fields(&self) -> bool {
        let is_heading = |line: &[u8]| line.starts_with(b"POINT_DATA ") || line.starts_with(b"CELL_DATA ");
        self.bytes[self.at..].split(|&byte| byte == b'\n').any(is_heading)
    }

    /// Reads the cells of so many points, which follow them; up to what is no cell.
    fn cells(&mut self, points: usize) -> Result<Cells, Error> {
        let mut cells = Cells::default();
        while let Some(word) = self.word() {
            match word {
                "METADATA" => self.pass_metadata(),
                "FIELD" => self.pass_field()?,
                "VERTICES" => {
                    self.list()?;
                }
                "CELLS" => {
                    let (ends, corners) = self.list()?;
                    while self.word() != Some("CELL_TYPES") {
                        if self.at >= self.bytes.len() {
                            return Err(broken("its cells have no CELL_TYPES"));
                        }
                    }
                    let count = self.count("kinds of cells")?;
                    self.line();
                    let kinds = self.numbers(1, count, Number::Signed(4), "kinds of cells")?;
                    cells.add(&kinds, &ends, &corners, 0..points)?;
                }
                _ => {
                    let Some(&(_, kind)) = LISTS.iter().find(|entry| entry.0 == word) else { break };
                    let (ends, corners) = self.list()?;
                    cells.add(&vec![kind.into(); ends.len()], &ends, &corners, 0..points)?;
                }
            }
        }
        Ok(cells)
    }

    /// Reads where cells end in the list of corners, and that list.
    fn list(&mut self) -> Result<(Vec<f64>, Vec<f64>), Error> {
        let (count, size) = (self.count("cells")?, self.count("corners")?);
        if self.has_ends {
            let mut array = |name: &str, count| {
                if self.word() != Some(name) {
                    return Err(broken(format!("cells without their {name}")));
                }
                let kind = self.kind()?;
                self.numbers(1, count, kind, "numbers of cells")
            };
            let mut ends = array("OFFSETS", count)?;
            let corners = array("CONNECTIVITY", size)?;
            // The first cell begins at 0.
            ends.drain(..ends.len().min(1));
            return Ok((ends, corners));
        }
        self.line();
        let numbers = self.numbers(1, size, Number::Signed(4), "numbers of cells")?;
        let mut rest = &numbers[..];
        let (mut ends, mut corners) = (Vec::new(), Vec::with_capacity(size.saturating_sub(count)));
        while let Some((&length, after)) = rest.split_first() {
            let cell = after.get(..length as usize);
            let cell = cell.ok_or_else(|| broken(format!("cell {} has {length} corners", ends.len())))?;
            corners.extend_from_slice(cell);
            ends.push(corners.len() as f64);
            rest = &after[cell.len()..];
        }
        if ends.len() != count {
            return Err(broken(format!("{} cells, not {count}", ends.len())));
        }
        Ok((ends, corners))
    }

    /// Passes over what is said of an array: up to an empty line.
    fn pass_metadata(&mut self) {
        self.line();
        while self.at < self.bytes.len() && !self.line().is_empty() {}
    }

    /// Passes over arrays of the whole file.
    fn pass_field(&mut self) -> Result<(), Error> {
        self.word();
        for _ in 0..self.count("arrays")? {
            let mut name = self.word();
            if name == Some("METADATA") {
                self.pass_metadata();
                name = self.word();
            }
            if name.is_none() {
                return Err(Error::Truncated("inside of FIELD".to_owned()));
            }
            let (each, count) = (self.count("components")?, self.count("tuples")?);
            let kind = self.word().unwrap_or_default();
            self.line();
            if kind == "string" {
                self.pass_strings(each.saturating_mul(count))?;
            } else {
                self.numbers(each, count, legacy_type(kind)?, "tuples of a field")?;
            }
        }
        Ok(())
    }

    /// Passes over so many strings: a line each, or a length and as many bytes each. The first two bits of a length say
    /// in how many bytes it is: 8, 4, 2 or 1 (`vtkDataReader`).
    fn pass_strings(&mut self, count: usize) -> Result<(), Error> {
        for i in 0..count {
            let rest = &self.bytes[self.at..];
            let ended = || Error::Truncated(format!("after {i} of {count} strings"));
            let &first = rest.first().ok_or_else(ended)?;
            if !self.is_binary {
                self.line();
                continue;
            }
            let size = 8 >> (first >> 6);
            let word = rest.get(..size).ok_or_else(ended)?;
            let length = Number::Unsigned(size).read(word, true) as usize & ((1 << (8 * size - 2)) - 1);
            self.at += length.checked_add(size).filter(|&all| all <= rest.len()).ok_or_else(ended)?;
        }
        Ok(())
    }
}

fn legacy_type(name: &str) -> Result<Number, Error> {
    Ok(match name {
        "float" => Number::Float(4),
        "double" => Number::Float(8),
        "char" => Number::Signed(1),
        "unsigned_char" => Number::Unsigned(1),
        "short" => Number::Signed(2),
        "unsigned_short" => Number::Unsigned(2),
        // VTK writes its own kind of index, which has 64 bits in memory, as 32.
        "int" | "vtkIdType" => Number::Signed(4),
        "unsigned_int" => Number::Unsigned(4),
        "long" | "vtktypeint64" => Number::Signed(8),
        "unsigned_long" => Number::Unsigned(8),
        other => return Err(broken(format!("numbers of type {:?} are not read", excerpt(other)))),
    })
}
