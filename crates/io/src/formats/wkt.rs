//! Well-known text of geometries: points, lines and polygons, one after another, each perhaps with the number of its system
//! before it (`SRID=25832;POINT (1 2)`).
//!
//! Lists in lists are bounded here, so that no text fills the stack.

use std::io::{self, Read, Write};

use super::shapes::Shapes;
use super::wkb;
use crate::error::excerpt;
use crate::{Crs, Error, ReadOptions, Shape, Source};

/// The names of geometries, and how deep their positions are in lists.
const KINDS: [(&str, usize); 9] = [
    ("POINT", 0),
    ("MULTIPOINT", 0),
    ("LINESTRING", 0),
    ("MULTILINESTRING", 1),
    ("POLYGON", 1),
    ("MULTIPOLYGON", 2),
    ("TRIANGLE", 1),
    ("TIN", 2),
    ("POLYHEDRALSURFACE", 2),
];

/// Geometries that have rings.
const AREAS: [&str; 5] = ["POLYGON", "MULTIPOLYGON", "TRIANGLE", "TIN", "POLYHEDRALSURFACE"];

/// The geometry that has geometries in it.
const COLLECTION: &str = "GEOMETRYCOLLECTION";

/// No geometry is in more collections.
const DEEPEST: usize = 16;

/// Reads all geometries, in their order.
pub(crate) fn read(mut source: Box<dyn Source>, options: &ReadOptions) -> Result<Shapes, Error> {
    let mut bytes = Vec::new();
    source.read_to_end(&mut bytes)?;
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
    let line = |at: usize| 1 + memchr::memchr_iter(b'\n', &bytes[..at]).count();
    let text = std::str::from_utf8(bytes).map_err(|error| Error::Line {
        line: line(error.valid_up_to()),
        what: "it is not UTF-8 text".to_owned(),
    })?;
    let mut reader = Reader { rest: text };
    let mut shapes = Shapes::new(options.attributes);
    loop {
        reader.skip_remarks();
        let begin = reader.rest;
        if begin.is_empty() {
            return Ok(shapes);
        }
        shapes.feature();
        let system = match reader.one(&mut shapes) {
            Ok(system) => system,
            Err(what) => return Err(Error::Line { line: line(text.len() - reader.rest.len()), what }),
        };
        if let (Some(before), Some(now)) = (&shapes.crs, &system)
            && before != now
        {
            let what = format!("its coordinates are {now}, those before it {before}");
            return Err(Error::Line { line: line(text.len() - begin.len()), what });
        }
        shapes.crs = shapes.crs.or(system);
    }
}

fn no_geometry(text: &str) -> String {
    format!(
        "{:?} is no geometry such as POINT (1 2)",
        excerpt(text.lines().next().unwrap_or_default().trim())
    )
}

/// Whether a text begins like a geometry: its kind, and a list or the word that there is none; or the digits of a binary one.
pub(super) fn is_geometry(text: &str) -> bool {
    let mut reader = Reader { rest: text.trim() };
    reader.system();
    reader.kind().is_some() || wkb::is_digits(text.trim())
}

/// Reads a text that is one geometry, and gives its system.
pub(super) fn read_one(text: &str, shapes: &mut Shapes) -> Result<Option<Crs>, String> {
    let mut reader = Reader { rest: text.trim() };
    let system = reader.one(shapes)?;
    reader.skip_remarks();
    if reader.rest.is_empty() { Ok(system) } else { Err(no_geometry(text.trim())) }
}

/// A kind of geometry.
#[derive(Clone, Copy)]
struct Kind {
    name: &'static str,
    /// How deep positions are in lists.
    depth: usize,
    /// The last number of a position is a measure.
    measured: bool,
    empty: bool,
}

/// The rest of a text. A part that is not as it should be is `None`.
struct Reader<'a> {
    rest: &'a str,
}

impl<'a> Reader<'a> {
    /// Steps over remarks, and over semicolons after geometries.
    fn skip_remarks(&mut self) {
        let is_between = |c: char| c.is_whitespace() || c == ';';
        self.rest = self.rest.trim_start_matches(is_between);
        while self.rest.starts_with('#') {
            let (_, after) = self.rest.split_once('\n').unwrap_or_default();
            self.rest = after.trim_start_matches(is_between);
        }
    }

    /// A geometry with the number of its system before it, or in hexadecimal digits. No number, or 0, is no system.
    fn one(&mut self, shapes: &mut Shapes) -> Result<Option<Crs>, String> {
        let begin = self.rest;
        let digits = begin.find(char::is_whitespace).map_or(begin, |end| &begin[..end]);
        if wkb::is_digits(digits) {
            self.rest = &begin[digits.len()..];
            return wkb::read_digits(digits, shapes);
        }
        let system = self.system();
        self.geometry(shapes, 0).ok_or_else(|| no_geometry(begin))?;
        Ok(system.filter(|&number| number > 0).map(Crs::of_epsg))
    }

    /// The number of a system that stands before a geometry.
    fn system(&mut self) -> Option<u32> {
        const NAME: &str = "SRID=";
        /// Longer numbers are none. Without a limit all that follows would be searched, for each geometry.
        const NUMBER_BYTES: usize = 20;
        self.rest.get(..NAME.len()).filter(|name| name.eq_ignore_ascii_case(NAME))?;
        let after = &self.rest[NAME.len()..];
        let end = after.bytes().take(NUMBER_BYTES + 1).position(|byte| byte == b';')?;
        let number = &after[..end];
        self.rest = after[end + 1..].trim_start();
        number.trim().parse().ok()
    }

    fn word(&mut self) -> &'a str {
        let rest = self.rest.trim_start();
        let end = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
        self.rest = rest[end..].trim_start();
        &rest[..end]
    }

    fn sign(&mut self, sign: char) -> Option<()> {
        self.rest = self.rest.trim_start().strip_prefix(sign)?.trim_start();
        Some(())
    }

    fn kind(&mut self) -> Option<Kind> {
        let word = self.word().to_ascii_uppercase();
        let (name, mut dimensions) = ["ZM", "Z", "M", ""].into_iter().find_map(|end| {
            let name = word.strip_suffix(end)?;
            let known = KINDS.iter().map(|kind| kind.0).chain([COLLECTION]).find(|&known| known == name);
            known.map(|name| (name, end.to_owned()))
        })?;
        let mut empty = false;
        if !self.rest.starts_with('(') {
            match self.word().to_ascii_uppercase().as_str() {
                "EMPTY" => empty = true,
                word @ ("Z" | "M" | "ZM") => {
                    word.clone_into(&mut dimensions);
                    empty = !self.rest.starts_with('(') && self.word().eq_ignore_ascii_case("EMPTY");
                }
                _ => return None,
            }
        }
        (empty || self.rest.starts_with('(')).then_some(())?;
        let depth = KINDS.iter().find(|kind| kind.0 == name).map_or(0, |kind| kind.1);
        Some(Kind { name, depth, measured: dimensions.ends_with('M'), empty })
    }

    fn geometry(&mut self, shapes: &mut Shapes, collections: usize) -> Option<()> {
        let kind = self.kind()?;
        if kind.empty {
            return Some(());
        }
        if kind.name != COLLECTION {
            return self.list(kind, kind.depth, shapes);
        }
        (collections < DEEPEST).then_some(())?;
        self.sign('(')?;
        loop {
            self.geometry(shapes, collections + 1)?;
            if self.sign(',').is_none() {
                return self.sign(')');
            }
        }
    }

    /// Positions, or lists of them.
    fn list(&mut self, kind: Kind, depth: usize, shapes: &mut Shapes) -> Option<()> {
        if !self.rest.starts_with('(') {
            return self.word().eq_ignore_ascii_case("EMPTY").then_some(());
        }
        self.sign('(')?;
        let is_area = AREAS.contains(&kind.name);
        if is_area && depth == 1 {
            shapes.polygon();
        }
        let start = shapes.len();
        loop {
            if depth > 0 {
                self.list(kind, depth - 1, shapes)?;
            } else if kind.name == "MULTIPOINT" && self.sign('(').is_some() {
                // Each point has brackets of its own, or none.
                self.position(kind, shapes)?;
                self.sign(')')?;
            } else {
                self.position(kind, shapes)?;
            }
            if self.sign(',').is_none() {
                break;
            }
        }
        if depth == 0 && is_area {
            shapes.ring(start, false);
        } else if depth == 0 && kind.name.ends_with("LINESTRING") {
            shapes.line(start);
        }
        self.sign(')')
    }

    fn position(&mut self, kind: Kind, shapes: &mut Shapes) -> Option<()> {
        let end = self.rest.find([',', '(', ')'])?;
        let mut numbers = [0.0; 4];
        let mut count = 0;
        for word in self.rest[..end].split_whitespace() {
            *numbers.get_mut(count)? = word.parse().ok()?;
            count += 1;
        }
        let kept = count.checked_sub(usize::from(kind.measured))?;
        self.rest = &self.rest[end..];
        shapes.position(&numbers[..kept.min(3)]).then_some(())
    }
}

/// Writes geometries, each in a line of its own, or as one collection. Where there is none it is an empty collection.
pub(super) struct Geometries<'a> {
    out: &'a mut dyn Write,
    in_collection: bool,
    sign: &'static str,
    count: usize,
}

impl<'a> Geometries<'a> {
    /// With heights or without.
    pub(super) fn new(out: &'a mut dyn Write, in_collection: bool, high: bool) -> Self {
        Self { out, in_collection, sign: if high { " Z" } else { "" }, count: 0 }
    }

    /// Begins a geometry, and gives what its coordinates are written to.
    pub(super) fn begin(&mut self, kind: &str) -> io::Result<&mut dyn Write> {
        match (self.in_collection, self.count) {
            (true, 0) => writeln!(self.out, "{COLLECTION}{} (", self.sign)?,
            (true, _) => writeln!(self.out, ",")?,
            (false, 0) => {}
            (false, _) => writeln!(self.out)?,
        }
        self.count += 1;
        write!(self.out, "{kind}{} ", self.sign)?;
        Ok(self.out)
    }

    pub(super) fn end(self) -> io::Result<()> {
        match (self.in_collection, self.count) {
            (_, 0) => writeln!(self.out, "{COLLECTION}{} EMPTY", self.sign),
            (true, _) => writeln!(self.out, "\n)"),
            (false, _) => writeln!(self.out),
        }
    }
}

/// Writes triangles.
pub(crate) fn write(out: &mut dyn Write, shape: &impl Shape, in_collection: bool) -> io::Result<()> {
    let positions: Vec<_> = shape.positions().collect();
    let high = shape.heights().is_some();
    let mut geometries = Geometries::new(out, in_collection, high);
    for triangle in shape.triangles() {
        let out = geometries.begin("POLYGON")?;
        for (k, corner) in [0, 1, 2, 0].into_iter().enumerate() {
            let [x, y, z] = positions[triangle[corner]];
            write!(out, "{}{x:?} {y:?}", if k == 0 { "((" } else { ", " })?;
            if high {
                write!(out, " {z:?}")?;
            }
        }
        write!(out, "))")?;
    }
    geometries.end()
}

/// Writes points as one geometry.
pub(crate) fn write_points<const D: usize>(
    out: &mut dyn Write,
    points: &[[f64; D]],
    in_collection: bool,
) -> io::Result<()> {
    let mut geometries = Geometries::new(out, in_collection, D == 3);
    let out = geometries.begin("MULTIPOINT")?;
    for (i, p) in points.iter().enumerate() {
        write!(out, "{}", if i == 0 { "((" } else { ", (" })?;
        for (k, x) in p.iter().enumerate() {
            write!(out, "{}{x:?}", if k == 0 { "" } else { " " })?;
        }
        write!(out, ")")?;
    }
    write!(out, "{}", if points.is_empty() { "EMPTY" } else { ")" })?;
    geometries.end()
}

#[cfg(test)]
mod tests {
    use super::{is_geometry, read, read_one};
    use crate::ReadOptions;
    use crate::formats::shapes::{Heights, Shapes};
    use std::io::Cursor;

    type Positions = (Vec<[f64; 2]>, Heights);

    fn flat(xy: &[[f64; 2]]) -> Positions {
        (xy.to_vec(), Heights::None)
    }

    fn high(xy: &[[f64; 2]], z: &[f64]) -> Positions {
        (xy.to_vec(), Heights::OfAll(z.to_vec()))
    }

    #[test]
    fn geometries_of_all_kinds() {
        for (text, expected) in [
            ("POINT (1 2)", flat(&[[1.0, 2.0]])),
            ("point z(1 2 3)", high(&[[1.0, 2.0]], &[3.0])),
            ("POINTZ (1 2 3)", high(&[[1.0, 2.0]], &[3.0])),
            ("POINT M (1 2 3)", flat(&[[1.0, 2.0]])),
            ("POINTZM(1 2 3 4)", high(&[[1.0, 2.0]], &[3.0])),
            ("SRID=4326;POINT(7.5 -3e1)", flat(&[[7.5, -30.0]])),
            ("MULTIPOINT ((1 2), (3 4))", flat(&[[1.0, 2.0], [3.0, 4.0]])),
            ("MULTIPOINT (1 2, 3 4)", flat(&[[1.0, 2.0], [3.0, 4.0]])),
            ("POLYGON ((0 0, 1 0, 0 1, 0 0))", flat(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])),
            (
                "POLYGON Z ((0 0 1, 1 0 2, 0 1 3, 0 0 1))",
                high(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], &[1.0, 2.0, 3.0]),
            ),
            ("GEOMETRYCOLLECTION (POINT (1 2), POINT (3 4))", flat(&[[1.0, 2.0], [3.0, 4.0]])),
            ("MULTIPOLYGON (EMPTY, ((1 2, 3 4, 1 2)))", flat(&[[1.0, 2.0], [3.0, 4.0]])),
            ("TRIANGLE ((0 0, 1 0, 0 1, 0 0));", flat(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])),
            (
                "TIN Z (((0 0 1, 1 0 2, 0 1 3, 0 0 1)), ((1 0 2, 1 1 4, 0 1 3, 1 0 2)))",
                high(
                    &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
                    &[1.0, 2.0, 3.0, 2.0, 4.0, 3.0],
                ),
            ),
            ("POLYHEDRALSURFACE (((0 0, 1 0, 0 1, 0 0)))", flat(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])),
            ("0101000000000000000000f03f0000000000000040", flat(&[[1.0, 2.0]])),
            ("POINT EMPTY", flat(&[])),
            (
                "GEOMETRYCOLLECTION (POINT (1 2), POINT Z (3 4 5))",
                (vec![[1.0, 2.0], [3.0, 4.0]], Heights::OfSome),
            ),
        ] {
            let mut shapes = Shapes::default();
            assert!(read_one(text, &mut shapes).is_ok(), "{text}");
            assert_eq!(shapes.positions(), expected, "{text}");
        }
        for text in [
            "POINT (1)",
            "POINT (a b)",
            "CIRCLE (1 2)",
            "",
            "(",
            "POINT 1 2",
            "POINT ()",
            "POINT (1 2 3 4 5)",
            "MULTIPOINT ((((",
            "POLYGON ((0 0, 5 0, 5 5",
            "POLYGON (0 0, 5 0, 5 5, 0 0)",
            "LINESTRING ((1 2, 3 4))",
            "POINT (1 2))",
            "POINT(1 2 )x",
            "LINESTRING (1 2,, 3 4)",
            "POINT (1 2) POINT (3 4)",
            "GEOMETRYCOLLECTION(GEOMETRYCOLLECTION(",
        ] {
            assert!(read_one(text, &mut Shapes::default()).is_err(), "{text}");
        }
        assert!(read_one(&"GEOMETRYCOLLECTION(".repeat(100_000), &mut Shapes::default()).is_err());
        assert!(read_one(&format!("POINT {}", "(".repeat(100_000)), &mut Shapes::default()).is_err());
        for text in ["points", "Point", "Point Number", "POINT_X", "Polygon"] {
            assert!(!is_geometry(text), "{text}");
        }
    }

    /// Minutes, if each line were to search all that follow.
    #[test]
    fn many_geometries_are_read_in_one_pass() {
        let text = "LINESTRING (0 0, 1 2)\n".repeat(300_000);
        let shapes = read(Box::new(Cursor::new(text)), &ReadOptions::default()).expect("lines");
        assert_eq!(shapes.len(), 600_000);
    }

    #[test]
    fn errors_name_the_line() {
        for (text, message) in [
            ("POINT (1 2)\n\nPOLYGON ((0 0,\n1 0, x 1, 0 0))", "line 4: \"POLYGON ((0 0,\" is no geometry"),
            ("# a remark\nCIRCLE (1 2)", "line 2: \"CIRCLE (1 2)\" is no geometry"),
            ("SRID=1;POINT (1 2)\nSRID=2;POINT (1 2)", "line 2: its coordinates are EPSG:2, those before it"),
            (
                "POLYGON ((0 0, 1 0, 0 1, 0 0), (0 0, 1 0, 0 1))",
                "ring 1 of polygon 0 is not closed: it begins at 0.0 0.0 and ends at 0.0 1.0",
            ),
        ] {
            let error = read(Box::new(Cursor::new(text)), &ReadOptions::default())
                .and_then(Shapes::graph)
                .expect_err(text)
                .to_string();
            assert!(error.starts_with(message), "{error}");
        }
    }
}
