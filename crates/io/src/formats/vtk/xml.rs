//! XML files of VTK (`.vtu`, `.vtp`) as ParaView and others write them: points and cells of all pieces; arrays as text, in
//! base64 or appended, plain or compressed by zlib.

use std::collections::BTreeSet;
use std::io::Read;
use std::ops::Range;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use roxmltree::Node;

use super::broken;
use super::cells::{Cells, POLYGON, POLYLINE, STRIP};
use crate::error::{excerpt, listed};
use crate::formats::numbers::Number;
use crate::input::{Bounded, most_inflated};
use crate::{Cloud, Error, Source, xml};

/// The lists of cells that a piece may have, and the kind of their cells if they are all of one.
const LISTS: [(&str, Option<u8>); 4] =
    [("Cells", None), ("Lines", Some(POLYLINE)), ("Polys", Some(POLYGON)), ("Strips", Some(STRIP))];

/// Reads the points of all pieces, and their cells if they are wanted.
pub(super) fn read(mut source: Box<dyn Source>, with_cells: bool) -> Result<(Cloud, Cells), Error> {
    let mut bytes = Vec::new();
    source.read_to_end(&mut bytes)?;
    // What is appended raw is no XML.
    let (text, appended) = match bytes.windows(13).position(|word| word == b"<AppendedData") {
        Some(at) => (&bytes[..at], Some(&bytes[at..])),
        None => (&bytes[..], None),
    };
    let text = std::str::from_utf8(text).map_err(|_| broken("it is not text"))?;
    let whole = if appended.is_some() { format!("{text}</VTKFile>") } else { text.to_owned() };
    let document = xml::parse(&whole)?;
    let file = File::of(document.root_element(), appended)?;
    let (mut cloud, mut cells) = (Cloud::with_capacity(0, true), Cells::default());
    let mut fields = BTreeSet::new();
    for piece in document.descendants().filter(|node| node.has_tag_name("Piece")) {
        let first = cloud.xy.len();
        for points in piece.children().filter(|node| node.has_tag_name("Points")) {
            for array in points.children().filter(|node| node.has_tag_name("DataArray")) {
                file.points(array, &mut cloud)?;
            }
        }
        let first_cell = cells.len();
        let values = piece.children().filter(|node| FIELDS.iter().any(|name| node.has_tag_name(*name)));
        let arrays = values.flat_map(|node| node.children()).filter(|node| node.has_tag_name("DataArray"));
        fields.extend(arrays.map(|array| array.attribute("Name").unwrap_or("without a name")));
        if with_cells {
            let points = first..cloud.xy.len();
            for list in piece.children() {
                if let Some(&(_, kind)) = LISTS.iter().find(|entry| list.has_tag_name(entry.0)) {
                    file.cells(list, kind, points.clone(), &mut cells)?;
                }
            }
            let mut of_cells = piece.children().filter(|node| node.has_tag_name("CellData"));
            let array = of_cells
                .find_map(|data| data.children().find(|array| array.attribute("Name") == Some(MARKER)));
            if let Some(array) = array
                && file.numbers(array).is_ok_and(|numbers| cells.mark(first_cell, &numbers))
            {
                fields.remove(MARKER);
            }
        }
    }
    if !fields.is_empty() {
        cloud.losses.push(super::left_out(&listed(fields.into_iter())));
    }
    Ok((cloud, cells))
}

/// The array of cells that has the markers of lines.
const MARKER: &str = "marker";

/// The elements of a piece whose arrays are values.
const FIELDS: [&str; 2] = ["PointData", "CellData"];

/// How an XML file stores its arrays.
struct File<'a> {
    big_endian: bool,
    /// The type of lengths before arrays.
    length: Number,
    compressed: bool,
    /// The appended data, and whether they are base64.
    appended: Option<(&'a [u8], bool)>,
}

impl<'a> File<'a> {
    fn of(root: Node, appended: Option<&'a [u8]>) -> Result<Self, Error> {
        if !root.has_tag_name("VTKFile") {
            return Err(broken("it is another kind of XML"));
        }
        let compressed = match root.attribute("compressor") {
            None | Some("") => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => {
                return Err(broken(format!(
                    "arrays compressed by {:?} are not read, only by zlib",
                    excerpt(other)
                )));
            }
        };
        let length = if root.attribute("header_type") == Some("UInt64") { 8 } else { 4 };
        let appended = appended.map(|bytes| {
            // After the underscore that follows the tag.
            let tag = bytes.iter().position(|&byte| byte == b'>').unwrap_or(bytes.len());
            let is_base64 = bytes[..tag].windows(6).any(|word| word == b"base64");
            let start =
                bytes[tag..].iter().position(|&byte| byte == b'_').map_or(bytes.len(), |at| tag + at + 1);
            (&bytes[start..], is_base64)
        });
        let big_endian = root.attribute("byte_order") == Some("BigEndian");
        Ok(Self { big_endian, length: Number::Unsigned(length), compressed, appended })
    }

    fn points(&self, array: Node, cloud: &mut Cloud) -> Result<(), Error> {
        if array.attribute("NumberOfComponents").is_some_and(|count| count != "3") {
            return Err(broken("its points have not three coordinates"));
        }
        let numbers = self.numbers(array)?;
        cloud.xy.reserve(numbers.len() / 3);
        numbers.chunks_exact(3).for_each(|p| cloud.push([p[0], p[1]], p[2]));
        Ok(())
    }

    /// Reads a list of cells of the points of a piece; of one kind, or of kinds that are listed too.
    fn cells(
        &self,
        list: Node,
        kind: Option<u8>,
        points: Range<usize>,
        cells: &mut Cells,
    ) -> Result<(), Error> {
        let named = |name| {
            let mut arrays = list.children();
            arrays.find(|node| node.has_tag_name("DataArray") && node.attribute("Name") == Some(name))
        };
        let numbers = |name| named(name).map_or(Ok(Vec::new()), |array| self.numbers(array));
        let (ends, corners) = (numbers("offsets")?, numbers("connectivity")?);
        let kinds = match kind {
            Some(kind) => vec![kind.into(); ends.len()],
            None => numbers("types")?,
        };
        cells.add(&kinds, &ends, &corners, points)
    }

    /// The numbers of an array.
    fn numbers(&self, array: Node) -> Result<Vec<f64>, Error> {
        let kind = array.attribute("type").and_then(xml_type);
        let kind = kind.ok_or_else(|| broken("an array has numbers of a type that is not read"))?;
        let text = array.text().unwrap_or_default();
        let bytes = match array.attribute("format") {
            Some("ascii") | None => return text.split_whitespace().map(super::number).collect(),
            Some("binary") => self.base64(text.trim().as_bytes())?,
            Some("appended") => {
                let offset = array.attribute("offset").and_then(|offset| offset.parse::<usize>().ok());
                let (bytes, is_base64) = self.appended.ok_or_else(|| broken("nothing is appended"))?;
                let bytes = offset.and_then(|offset| bytes.get(offset..));
                let bytes =
                    bytes.ok_or_else(|| Error::Truncated("before an array that is appended".to_owned()))?;
                if is_base64 { self.base64(bytes)? } else { self.raw(bytes)? }
            }
            Some(other) => return Err(broken(format!("arrays as {:?} are not read", excerpt(other)))),
        };
        Ok(bytes.chunks_exact(kind.size()).map(|word| kind.read(word, self.big_endian)).collect())
    }

    /// A length in front of an array.
    fn number(&self, bytes: &[u8], place: usize) -> Result<usize, Error> {
        let size = self.length.size();
        let word = bytes.get(place * size..(place + 1) * size).ok_or_else(ended)?;
        Ok(self.length.read(word, self.big_endian) as usize)
    }

    /// The content of an array, after its length, or its lengths where it is compressed.
    fn raw(&self, bytes: &[u8]) -> Result<Vec<u8>, Error> {
        let size = self.length.size();
        if !self.compressed {
            let length = self.number(bytes, 0)?;
            return bytes[size..].get(..length).map(<[u8]>::to_vec).ok_or_else(ended);
        }
        let blocks = self.number(bytes, 0)?;
        let start = blocks.checked_add(3).and_then(|words| words.checked_mul(size)).ok_or_else(ended)?;
        self.blocks(bytes, bytes.get(start..).ok_or_else(ended)?)
    }

    /// The content of an array in base64: lengths are encoded apart where the content is compressed.
    fn base64(&self, text: &[u8]) -> Result<Vec<u8>, Error> {
        let text: Vec<u8> = text.iter().copied().filter(|byte| !byte.is_ascii_whitespace()).collect();
        let size = self.length.size();
        let encoded = |bytes: usize| bytes.div_ceil(3) * 4;
        let decode = |text: &[u8]| STANDARD.decode(text).map_err(|_| broken("an array is not base64"));
        let part = |from: usize, length: usize| text.get(from..from + length).ok_or_else(ended);
        if !self.compressed {
            let head = decode(part(0, encoded(size))?)?;
            let length = self.number(&head, 0)?;
            let all = length.checked_add(size).filter(|&all| all <= text.len()).ok_or_else(ended)?;
            return self.raw(&decode(part(0, encoded(all))?)?);
        }
        let head = decode(part(0, encoded(size))?)?;
        let blocks = self.number(&head, 0)?;
        let words = blocks.checked_add(3).and_then(|words| words.checked_mul(size));
        let words = words.filter(|&words| words <= text.len()).ok_or_else(ended)?;
        let lengths = decode(part(0, encoded(words))?)?;
        let mut content = 0_usize;
        for k in 0..blocks {
            content = content.checked_add(self.number(&lengths, 3 + k)?).ok_or_else(ended)?;
        }
        let content = (content <= text.len()).then_some(content).ok_or_else(ended)?;
        self.blocks(&lengths, &decode(part(encoded(words), encoded(content))?)?)
    }

    /// Decompresses block after block.
    fn blocks(&self, lengths: &[u8], mut content: &[u8]) -> Result<Vec<u8>, Error> {
        let mut out = Vec::new();
        let packed = content.len() as u64;
        for k in 0..self.number(lengths, 0)? {
            let length = self.number(lengths, 3 + k)?;
            let block = content.get(..length).ok_or_else(ended)?;
            let left = most_inflated(packed).saturating_sub(out.len() as u64);
            let inflated = Bounded::to(left, ZlibDecoder::new(block)).read_to_end(&mut out);
            inflated.map_err(|error| match error.into() {
                Error::Io(_) => broken("a compressed block is damaged"),
                other => other,
            })?;
            content = &content[length..];
        }
        Ok(out)
    }
}

fn ended() -> Error {
    Error::Truncated("inside an array".to_owned())
}

fn xml_type(name: &str) -> Option<Number> {
    let digits = name.find(|c: char| c.is_ascii_digit())?;
    let size = name[digits..].parse::<usize>().ok()? / 8;
    match &name[..digits] {
        "Float" => Number::Float(size),
        "Int" => Number::Signed(size),
        "UInt" => Number::Unsigned(size),
        _ => return None,
    }
    .checked()
}
