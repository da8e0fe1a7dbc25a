//! Well-known binary of geometries, plain or with the number of their system (EWKB), one after another; or the same in
//! hexadecimal digits, as databases print it.
//!
//! Source: OGC 06-103r4 "Simple feature access", section 8.2; PostGIS for the flags of EWKB. Read by hand: the crates that read it take
//! longer to build than the rest of the readers.

use std::io::{self, Read, Write};

use super::shapes::Shapes;
use crate::{Crs, Error, ReadOptions, Shape, Source};

/// Reads all geometries, in their order.
pub(crate) fn read(mut source: Box<dyn Source>, options: &ReadOptions) -> Result<Shapes, Error> {
    let mut bytes = Vec::new();
    source.read_to_end(&mut bytes)?;
    let bytes = match digits(&bytes)? {
        Some(decoded) => decoded,
        None => bytes,
    };
    let mut shapes = Shapes::new(options.attributes);
    let mut at = 0;
    while at < bytes.len() {
        let wrong = |what: String| Error::content(format!("WKB: the geometry at byte {at}: {what}"));
        let mut reader = Reader { rest: &bytes[at..], is_big: false };
        shapes.feature();
        let system = reader.geometry(&mut shapes, None, DEEPEST).map_err(wrong)?;
        if let (Some(before), Some(now)) = (&shapes.crs, &system)
            && before != now
        {
            return Err(wrong(format!("its coordinates are {now}, those before it {before}")));
        }
        shapes.crs = shapes.crs.or(system);
        at = bytes.len() - reader.rest.len();
    }
    Ok(shapes)
}

/// The bytes that a text of hexadecimal digits stands for, geometries on lines of their own or not; `None` if it is binary.
fn digits(text: &[u8]) -> Result<Option<Vec<u8>>, Error> {
    // Binary begins with the order of bytes, 0 or 1.
    if !text
        .first()
        .is_some_and(|byte| byte.is_ascii_hexdigit() || byte.is_ascii_whitespace() || *byte == b'\\')
    {
        return Ok(None);
    }
    let mut bytes = Vec::with_capacity(text.len() / 2);
    for (i, line) in text.split(|&byte| byte == b'\n').enumerate() {
        let wrong = |what: &str| Error::Line { line: i + 1, what: what.to_owned() };
        let line = line.trim_ascii();
        let line = line.strip_prefix(b"\\x").unwrap_or(line);
        let (pairs, rest) = line.as_chunks::<2>();
        for pair in pairs {
            let pair = str::from_utf8(pair).ok().and_then(|pair| u8::from_str_radix(pair, 16).ok());
            bytes.push(pair.ok_or_else(|| wrong("it is neither well-known binary nor hexadecimal digits"))?);
        }
        if !rest.is_empty() {
            return Err(wrong("an odd number of hexadecimal digits"));
        }
    }
    Ok(Some(bytes))
}

/// Whether a word is the digits of a geometry: the order of bytes first, and enough of them for an empty one.
pub(super) fn is_digits(word: &str) -> bool {
    const SHORTEST: usize = 2 * (1 + 4 + 4);
    let digits = word.strip_prefix("\\x").unwrap_or(word);
    digits.len() >= SHORTEST
        && (digits.starts_with("00") || digits.starts_with("01"))
        && digits.bytes().all(|byte| byte.is_ascii_hexdigit())
}

/// Reads the one geometry that digits stand for, and gives its system.
pub(super) fn read_digits(word: &str, shapes: &mut Shapes) -> Result<Option<Crs>, String> {
    let bytes = digits(word.as_bytes()).map_err(|error| error.to_string())?.unwrap_or_default();
    let mut reader = Reader { rest: &bytes, is_big: false };
    let system = reader.geometry(shapes, None, DEEPEST)?;
    if reader.rest.is_empty() { Ok(system) } else { Err("there are digits after its geometry".to_owned()) }
}

/// Reads the one geometry that bytes stand for.
#[cfg(feature = "geopackage")]
pub(super) fn read_binary(bytes: &[u8], shapes: &mut Shapes) -> Result<(), String> {
    Reader { rest: bytes, is_big: false }.geometry(shapes, None, DEEPEST).map(|_| ())
}

/// Collections in each other at most: nobody has more, and each takes a piece of the stack.
const DEEPEST: u32 = 100;

/// The rest of the bytes, and the order of numbers.
struct Reader<'a> {
    rest: &'a [u8],
    is_big: bool,
}

/// How many numbers a position has, and whether the third is a height.
#[derive(Clone, Copy)]
struct Width {
    numbers: usize,
    high: bool,
}

impl Reader<'_> {
    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let (&bytes, rest) = self.rest.split_first_chunk().ok_or("the file ends inside of it")?;
        self.rest = rest;
        Ok(bytes)
    }

    fn count(&mut self) -> Result<u32, String> {
        self.bytes().map(if self.is_big { u32::from_be_bytes } else { u32::from_le_bytes })
    }

    fn number(&mut self) -> Result<f64, String> {
        self.bytes().map(if self.is_big { f64::from_be_bytes } else { f64::from_le_bytes })
    }

    /// Reads a geometry, of a given kind if it is inside of one that has no others, and gives its system.
    fn geometry(
        &mut self,
        shapes: &mut Shapes,
        inside: Option<u32>,
        depth: u32,
    ) -> Result<Option<Crs>, String> {
        let [order] = self.bytes()?;
        if order > 1 {
            return Err(format!("the order of its bytes is {order}, neither 0 nor 1"));
        }
        self.is_big = order == 0;
        let word = self.count()?;
        let flags = word & (WITH_HEIGHTS | WITH_MEASURES | WITH_SYSTEM);
        // The flags of EWKB, or the thousands of OGC.
        let (kind, thousands) = ((word ^ flags) % 1000, (word ^ flags) / 1000);
        let high = flags & WITH_HEIGHTS != 0 || thousands & 1 != 0;
        let measured = flags & WITH_MEASURES != 0 || thousands & 2 != 0;
        let width = Width { numbers: 2 + usize::from(high) + usize::from(measured), high };
        if thousands > 3 || !((POINT..=COLLECTION).contains(&kind) || (SURFACE..=TRIANGLE).contains(&kind)) {
            return Err(format!("kind {word} is none of points, lines, polygons and collections of them"));
        }
        if let Some(expected) = inside
            && expected != kind
        {
            return Err(format!("a geometry of kind {kind} among others of kind {expected}"));
        }
        let system =
            if flags & WITH_SYSTEM == 0 { None } else { Some(self.count()?).filter(|&number| number > 0) };
        match kind {
            POINT => self.position(width, shapes, true)?,
            LINE => {
                let start = shapes.len();
                self.positions(width, shapes)?;
                shapes.line(start);
            }
            POLYGON | TRIANGLE => {
                shapes.polygon();
                for _ in 0..self.count()? {
                    let start = shapes.len();
                    self.positions(width, shapes)?;
                    shapes.ring(start, false);
                }
            }
            _ if depth == 0 => return Err(format!("more than {DEEPEST} collections in each other")),
            _ => {
                let inside = match kind {
                    COLLECTION => None,
                    TIN => Some(TRIANGLE),
                    SURFACE => Some(POLYGON),
                    _ => Some(kind - 3),
                };
                for _ in 0..self.count()? {
                    self.geometry(shapes, inside, depth - 1)?;
                }
            }
        }
        Ok(system.map(Crs::of_epsg))
    }

    fn positions(&mut self, width: Width, shapes: &mut Shapes) -> Result<(), String> {
        (0..self.count()?).try_for_each(|_| self.position(width, shapes, false))
    }

    /// Reads a position; a point that has no number is an empty one.
    fn position(&mut self, width: Width, shapes: &mut Shapes, may_be_empty: bool) -> Result<(), String> {
        let mut numbers = [0.0; 4];
        for number in &mut numbers[..width.numbers] {
            *number = self.number()?;
        }
        let taken = &numbers[..if width.high { 3 } else { 2 }];
        if !(may_be_empty && taken.iter().all(|number| number.is_nan())) {
            shapes.position(taken);
        }
        Ok(())
    }
}

/// Kinds of geometries; several points, lines or polygons are three further.
const POINT: u32 = 1;
const LINE: u32 = 2;
pub(super) const POLYGON: u32 = 3;
const MULTIPOINT: u32 = 4;
pub(super) const MULTIPOLYGON: u32 = 6;
pub(super) const COLLECTION: u32 = 7;
/// Polygons that share sides, triangles that do, and one triangle.
const SURFACE: u32 = 15;
const TIN: u32 = 16;
const TRIANGLE: u32 = 17;
/// Flags that EWKB adds to a kind: positions have heights, or measures; the number of the system follows.
const WITH_HEIGHTS: u32 = 1 << 31;
const WITH_MEASURES: u32 = 1 << 30;
const WITH_SYSTEM: u32 = 1 << 29;

/// The first bytes of a geometry, little endian.
pub(super) fn begin(out: &mut dyn Write, kind: u32, crs: Option<u32>) -> io::Result<()> {
    out.write_all(&[1])?;
    out.write_all(&(kind | crs.map_or(0, |_| WITH_SYSTEM)).to_le_bytes())?;
    crs.map_or(Ok(()), |number| out.write_all(&number.to_le_bytes()))
}

/// How many parts, rings or positions follow.
pub(super) fn write_count(out: &mut dyn Write, count: usize) -> io::Result<()> {
    out.write_all(&(count as u32).to_le_bytes())
}

/// Writes a collection of triangles.
pub(crate) fn write(out: &mut dyn Write, shape: &impl Shape) -> io::Result<()> {
    let positions: Vec<_> = shape.positions().collect();
    let (width, high) = if shape.heights().is_some() { (3, WITH_HEIGHTS) } else { (2, 0) };
    begin(out, COLLECTION | high, shape.crs().and_then(|crs| crs.epsg))?;
    write_count(out, shape.triangles().count())?;
    for triangle in shape.triangles() {
        begin(out, POLYGON | high, None)?;
        // One ring of four positions.
        out.write_all(&[1_u32, 4].map(u32::to_le_bytes).concat())?;
        for corner in [0, 1, 2, 0] {
            let position = &positions[triangle[corner]][..width];
            position.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))?;
        }
    }
    Ok(())
}

pub(crate) fn write_points<const D: usize>(out: &mut dyn Write, points: &[[f64; D]]) -> io::Result<()> {
    let high = if D == 3 { WITH_HEIGHTS } else { 0 };
    begin(out, MULTIPOINT | high, None)?;
    write_count(out, points.len())?;
    for p in points {
        begin(out, POINT | high, None)?;
        p.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))?;
    }
    Ok(())
}
