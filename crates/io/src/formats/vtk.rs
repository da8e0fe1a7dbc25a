//! Points of VTK's files: the legacy format (`.vtk`), and XML (`.vtu`, `.vtp`) as ParaView and others write it.

use std::io::Read;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use roxmltree::Node;

use super::numbers::Number;
use crate::error::excerpt;
use crate::input::{Bounded, most_inflated};
use crate::{Cloud, Error, Source, xml};

fn broken(what: impl std::fmt::Display) -> Error {
    Error::content(format!("VTK: {what}"))
}

/// Reads the points of a legacy file.
pub(crate) fn read_legacy(mut source: Box<dyn Source>) -> Result<Cloud, Error> {
    let mut bytes = Vec::new();
    source.read_to_end(&mut bytes)?;
    if !bytes.starts_with(b"# vtk DataFile") {
        return Err(broken("it does not begin as a VTK file"));
    }
    let mut binary = false;
    let mut at = 0;
    for line in bytes.split_inclusive(|&byte| byte == b'\n').take(64) {
        at += line.len();
        let line = String::from_utf8_lossy(line);
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["BINARY"] => binary = true,
            ["POINTS", count, kind] => {
                let wrong = || broken(format!("{:?} is no number of points", excerpt(count)));
                let count: usize = count.parse().map_err(|_| wrong())?;
                let kind = legacy_type(kind)?;
                return if binary { block(&bytes[at..], count, kind) } else { listed(&bytes[at..], count) };
            }
            _ => {}
        }
    }
    Err(broken("it has no list of points"))
}

fn legacy_type(name: &str) -> Result<Number, Error> {
    Ok(match name {
        "float" => Number::Float(4),
        "double" => Number::Float(8),
        "char" => Number::Signed(1),
        "unsigned_char" => Number::Unsigned(1),
        "short" => Number::Signed(2),
        "unsigned_short" => Number::Unsigned(2),
        "int" => Number::Signed(4),
        "unsigned_int" => Number::Unsigned(4),
        "long" | "vtktypeint64" => Number::Signed(8),
        "unsigned_long" => Number::Unsigned(8),
        other => return Err(broken(format!("numbers of type {:?} are not read", excerpt(other)))),
    })
}

/// Points as text.
fn listed(bytes: &[u8], count: usize) -> Result<Cloud, Error> {
    let text = String::from_utf8_lossy(bytes);
    let mut words = text.split_whitespace();
    let mut cloud = Cloud::with_capacity(0, true);
    for i in 0..count {
        let mut number = || {
            let word =
                words.next().ok_or_else(|| Error::Truncated(format!("after {i} of {count} points")))?;
            let wrong = || broken(format!("point {i} has {:?} for a number", excerpt(word)));
            word.parse::<f64>().map_err(|_| wrong())
        };
        let xy = [number()?, number()?];
        cloud.push(xy, number()?);
    }
    Ok(cloud)
}

/// Points as big-endian numbers.
fn block(bytes: &[u8], count: usize, kind: Number) -> Result<Cloud, Error> {
    let there = bytes.len() / (3 * kind.size());
    if there < count {
        return Err(Error::Truncated(format!("after {there} of {count} points")));
    }
    let mut cloud = Cloud::with_capacity(count, true);
    take(&mut cloud, &bytes[..3 * kind.size() * count], kind, true);
    Ok(cloud)
}

fn take(cloud: &mut Cloud, bytes: &[u8], kind: Number, big_endian: bool) {
    for point in bytes.chunks_exact(3 * kind.size()) {
        let [x, y, z] = [0, 1, 2].map(|k| kind.read(&point[k * kind.size()..], big_endian));
        cloud.push([x, y], z);
    }
}

/// Reads the points of all pieces of an XML file.
pub(crate) fn read_xml(mut source: Box<dyn Source>) -> Result<Cloud, Error> {
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
    let mut cloud = Cloud::with_capacity(0, true);
    let pieces = document.descendants().filter(|node| node.has_tag_name("Points"));
    for array in pieces.flat_map(|points| points.children().filter(|node| node.has_tag_name("DataArray"))) {
        if array.attribute("NumberOfComponents").is_some_and(|count| count != "3") {
            return Err(broken("its points have not three coordinates"));
        }
        file.points(array, &mut cloud)?;
    }
    Ok(cloud)
}

/// How an XML file stores its arrays.
struct File<'a> {
    big_endian: bool,
    /// The type of lengths before arrays.
    length: Number,
    compressed: bool,
    /// What is appended, and whether it is base64.
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
        let kind = array.attribute("type").and_then(xml_type);
        let kind = kind.ok_or_else(|| broken("its points are of a type that is not read"))?;
        let text = array.text().unwrap_or_default();
        match array.attribute("format") {
            Some("ascii") | None => {
                let words = text.split_whitespace().count() / 3;
                let listed = listed(text.as_bytes(), words)?;
                cloud.append(listed);
                return Ok(());
            }
            Some("binary") => take(cloud, &self.base64(text.trim().as_bytes())?, kind, self.big_endian),
            Some("appended") => {
                let offset = array.attribute("offset").and_then(|offset| offset.parse::<usize>().ok());
                let (bytes, is_base64) = self.appended.ok_or_else(|| broken("nothing is appended"))?;
                let bytes = offset.and_then(|offset| bytes.get(offset..));
                let bytes =
                    bytes.ok_or_else(|| Error::Truncated("before an array that is appended".to_owned()))?;
                let content = if is_base64 { self.base64(bytes)? } else { self.raw(bytes)? };
                take(cloud, &content, kind, self.big_endian);
            }
            Some(other) => return Err(broken(format!("arrays as {:?} are not read", excerpt(other)))),
        }
        Ok(())
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

    /// The same in base64: lengths are encoded apart where the content is compressed.
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

#[cfg(test)]
mod tests {
    use super::{read_legacy, read_xml};
    use crate::Cloud;
    use std::io::Cursor;

    fn expect(cloud: Result<Cloud, crate::Error>) {
        let cloud = cloud.expect("valid");
        assert_eq!((cloud.xy, cloud.z), (vec![[1.0, 2.0], [4.0, 5.0]], Some(vec![3.0, 6.0])));
    }

    #[test]
    fn legacy_files() {
        let head = "# vtk DataFile Version 3.0\ntitle\n";
        let text = format!("{head}ASCII\nDATASET POLYDATA\nPOINTS 2 float\n1 2 3 4\n5 6\nVERTICES 0 0\n");
        expect(read_legacy(Box::new(Cursor::new(text))));
        let mut binary = format!("{head}BINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 double\n").into_bytes();
        binary.extend((1..=6).flat_map(|x| f64::from(x).to_be_bytes()));
        expect(read_legacy(Box::new(Cursor::new(binary.clone()))));
        binary.pop();
        let error = read_legacy(Box::new(Cursor::new(binary))).expect_err("short");
        assert_eq!(error.to_string(), "the file ends after 1 of 2 points");
        assert!(read_legacy(Box::new(Cursor::new("# vtk DataFile\n"))).is_err());
    }

    #[test]
    fn xml_as_text_and_in_base64() {
        use base64::Engine;
        let file = |attributes: &str, array: &str| {
            format!(
                "<?xml version=\"1.0\"?><VTKFile type=\"PolyData\" {attributes}><PolyData><Piece><Points>\
                 <DataArray type=\"Float32\" NumberOfComponents=\"3\" {array}</DataArray></Points></Piece></PolyData></VTKFile>"
            )
        };
        expect(read_xml(Box::new(Cursor::new(file("", "format=\"ascii\">1 2 3\n4 5 6")))));
        let numbers: Vec<u8> = (1..=6).flat_map(|x| (x as f32).to_le_bytes()).collect();
        let encode = |bytes: &[u8]| super::STANDARD.encode(bytes);
        let plain = [&24_u32.to_le_bytes()[..], &numbers].concat();
        expect(read_xml(Box::new(Cursor::new(file("", &format!("format=\"binary\">{}", encode(&plain)))))));
        let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
        std::io::Write::write_all(&mut encoder, &numbers).expect("memory");
        let packed = encoder.finish().expect("memory");
        let lengths: Vec<u8> =
            [1_u64, 24, 24, packed.len() as u64].iter().flat_map(|x| x.to_le_bytes()).collect();
        let array = format!("format=\"binary\">{}{}", encode(&lengths), encode(&packed));
        let attributes = "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\"";
        expect(read_xml(Box::new(Cursor::new(file(attributes, &array)))));
        let other = file("compressor=\"vtkLZ4DataCompressor\"", "format=\"ascii\">");
        assert!(
            read_xml(Box::new(Cursor::new(other))).is_err_and(|error| error.to_string().contains("zlib"))
        );
    }
}
