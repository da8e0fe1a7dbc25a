//! The header of a NumPy array: a Python dictionary of three entries, written by `numpy.lib.format` (versions 1 to 3).

use std::io::{self, Read, Seek, SeekFrom, Write};

use crate::Error;

const MAGIC: &[u8] = b"\x93NUMPY";

/// NumPy itself reads no longer headers.
const LONGEST: u64 = 10_000;

/// The header of an array: the type and shape of its numbers.
pub(super) struct Header {
    /// The type of a number without its byte order: `f8`.
    pub(super) kind: String,
    /// The first byte of a number is its highest.
    pub(super) is_big: bool,
    /// The numbers of a column are together, not those of a row: the order of Fortran.
    pub(super) by_columns: bool,
    pub(super) shape: Vec<u64>,
}

impl Header {
    /// Reads up to the first number, after a look at how much there is.
    pub(super) fn read(source: &mut (impl Read + Seek)) -> Result<Self, Error> {
        let early = |_| Error::Truncated("inside the array's header".to_owned());
        let length = source.seek(SeekFrom::End(0))?;
        source.rewind()?;
        let mut start = [0; 12];
        let magic = source.read_exact(&mut start[..MAGIC.len()]);
        if magic.is_err() || !start.starts_with(MAGIC) {
            return Err(Error::content("no NumPy array: it does not begin as one"));
        }
        source.read_exact(&mut start[MAGIC.len()..10]).map_err(early)?;
        let (before, text) = match start[6..8] {
            [1, 0] => (10, u64::from(u16::from_le_bytes([start[8], start[9]]))),
            [2 | 3, 0] => {
                source.read_exact(&mut start[10..]).map_err(early)?;
                (12, u64::from(u32::from_le_bytes([start[8], start[9], start[10], start[11]])))
            }
            _ => {
                let version = format!("{}.{}", start[6], start[7]);
                return Err(Error::content(format!("no NumPy array: its version {version} is not known")));
            }
        };
        if before + text > length {
            return Err(Error::Truncated("inside the array's header".to_owned()));
        }
        if text > LONGEST {
            return Err(Error::content("no NumPy array of numbers: its header is too long"));
        }
        let mut bytes = vec![0; text as usize];
        source.read_exact(&mut bytes).map_err(early)?;
        let header = std::str::from_utf8(&bytes).ok().map_or_else(|| Err(wrong("its text")), Self::parse)?;
        header.check_length(length - before - text)?;
        Ok(header)
    }

    /// Reads the dictionary. Its entries come in any order, each once.
    fn parse(text: &str) -> Result<Self, Error> {
        let mut rest = Rest(text);
        let (mut kind, mut by_columns, mut shape) = (None, None, None);
        let mut goes_on = rest.takes("{");
        while goes_on && !rest.takes("}") {
            let key = rest.string().filter(|_| rest.takes(":")).ok_or_else(|| wrong("its header"))?;
            let is_new = match key {
                "descr" if rest.is_at("[") => {
                    return Err(Error::content("the array is of records, which are not read here"));
                }
                "descr" => kind.replace(rest.string().ok_or_else(|| wrong("its type"))?).is_none(),
                "fortran_order" => {
                    let is_true = rest.takes("True");
                    if !is_true && !rest.takes("False") {
                        return Err(wrong("its order"));
                    }
                    by_columns.replace(is_true).is_none()
                }
                "shape" => shape.replace(rest.shape().ok_or_else(|| wrong("its shape"))?).is_none(),
                _ => false,
            };
            goes_on = is_new && (rest.takes(",") || rest.is_at("}"));
        }
        let (true, true, Some(kind), Some(by_columns), Some(shape)) =
            (goes_on, rest.0.trim().is_empty(), kind, by_columns, shape)
        else {
            return Err(wrong("its header"));
        };
        let (order, kind) = kind.split_at_checked(1).ok_or_else(|| wrong("its type"))?;
        // Only a single byte needs no order.
        if !(matches!(order, "<" | ">") || order == "|" && ["i1", "u1", "b1"].contains(&kind)) {
            return Err(Error::content(format!(
                "the array is of type {order}{kind}, which is not read here"
            )));
        }
        Ok(Self { kind: kind.to_owned(), is_big: order == ">", by_columns, shape })
    }

    /// Whether so many bytes hold the rows that are promised, before memory is asked for them.
    fn check_length(&self, bytes: u64) -> Result<(), Error> {
        let size = self.kind.strip_prefix(['f', 'i', 'u']).and_then(|digits| digits.parse::<u64>().ok());
        if let ([rows, columns], Some(size)) = (&self.shape[..], size) {
            let complete = bytes / columns.saturating_mul(size).max(1);
            if complete < *rows && *columns > 0 {
                return Err(Error::Truncated(format!("inside row {complete} of {rows}")));
            }
        }
        Ok(())
    }
}

/// Writes the header of numbers row by row, as long as a multiple of 64 bytes.
pub(super) fn write(out: &mut (impl Write + ?Sized), kind: &str, shape: &[usize]) -> io::Result<()> {
    let shape: String = shape.iter().map(|length| format!("{length}, ")).collect();
    let text = format!("{{'descr': '<{kind}', 'fortran_order': False, 'shape': ({shape}), }}");
    let width = (MAGIC.len() + 4 + text.len() + 1).next_multiple_of(64) - MAGIC.len() - 4;
    out.write_all(MAGIC)?;
    out.write_all(&[1, 0])?;
    out.write_all(&(width as u16).to_le_bytes())?;
    writeln!(out, "{text:<0$}", width - 1)
}

fn wrong(what: &str) -> Error {
    Error::content(format!("no NumPy array: {what} cannot be read"))
}

/// The rest of a text, not read yet.
struct Rest<'a>(&'a str);

impl<'a> Rest<'a> {
    fn is_at(&self, token: &str) -> bool {
        self.0.trim_start().starts_with(token)
    }

    fn takes(&mut self, token: &str) -> bool {
        let after = self.0.trim_start().strip_prefix(token);
        self.0 = after.unwrap_or(self.0);
        after.is_some()
    }

    /// A text in quotes. Escapes occur only in the names of records.
    fn string(&mut self) -> Option<&'a str> {
        let quote = if self.takes("'") { '\'' } else { self.takes("\"").then_some('"')? };
        let (inside, after) = self.0.split_once(quote)?;
        self.0 = after;
        (!inside.contains('\\')).then_some(inside)
    }

    /// Whole numbers between brackets, each followed by a comma but perhaps the last.
    fn shape(&mut self) -> Option<Vec<u64>> {
        let close = if self.takes("(") { ")" } else { self.takes("[").then_some("]")? };
        let mut shape = Vec::new();
        while !self.takes(close) {
            let text = self.0.trim_start();
            let end = text.find(|c: char| !c.is_ascii_digit())?;
            shape.push(text[..end].parse().ok()?);
            self.0 = &text[end..];
            if !self.takes(",") && !self.is_at(close) {
                return None;
            }
        }
        Some(shape)
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::Header;

    fn read(version: u8, text: &str) -> Result<Header, String> {
        let mut bytes = [&b"\x93NUMPY"[..], &[version, 0]].concat();
        match version {
            1 => bytes.extend((text.len() as u16).to_le_bytes()),
            _ => bytes.extend((text.len() as u32).to_le_bytes()),
        }
        bytes.extend(text.bytes());
        bytes.extend([0; 48]);
        Header::read(&mut Cursor::new(bytes)).map_err(|error| error.to_string())
    }

    #[test]
    fn all_versions_and_spellings_are_read() {
        for version in 1..=3 {
            for text in [
                "{'descr': '>f8', 'fortran_order': True, 'shape': (3, 2), }   \n",
                "{'shape':(3,2,),\"fortran_order\":True,'descr':\">f8\"}",
                " { 'fortran_order' : True , 'shape' : [ 3 , 2 ] , 'descr' : '>f8' } ",
            ] {
                let header = read(version, text).expect(text);
                assert_eq!((&*header.kind, &header.shape[..]), ("f8", &[3, 2][..]));
                assert!(header.is_big && header.by_columns);
            }
        }
        let bytes = read(1, "{'descr': '|u1', 'fortran_order': False, 'shape': (), }").expect("a number");
        assert!(bytes.kind == "u1" && !bytes.by_columns && bytes.shape.is_empty());
    }

    #[test]
    fn what_is_no_header_is_refused() {
        for (text, message) in [
            ("", "its header"),
            ("{", "its header"),
            ("{}", "its header"),
            ("{'descr': '<f8', 'fortran_order': False}", "its header"),
            ("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2)", "its header"),
            ("{'descr': '<f8' 'fortran_order': False, 'shape': (3, 2)}", "its header"),
            ("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2)} x", "its header"),
            ("{'descr': '<f8', 'descr': '<f8', 'fortran_order': False, 'shape': (3, 2)}", "its header"),
            ("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), 'x': 1}", "its header"),
            ("{'descr': '<f8', 'fortran_order': 0, 'shape': (3, 2)}", "its order"),
            ("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2]}", "its shape"),
            ("{'descr': '<f8', 'fortran_order': False, 'shape': (-3, 2)}", "its shape"),
            ("{'descr': '<f8', 'fortran_order': False, 'shape': (18446744073709551616, 2)}", "its shape"),
            ("{'descr': '<f8', 'fortran_order': False, 'shape': (3 2)}", "its shape"),
            ("{'descr': '<f8', 'fortran_order': False, 'shape': (((", "its shape"),
            ("{'descr': 8, 'fortran_order': False, 'shape': (3, 2)}", "its type"),
            ("{'descr': '', 'fortran_order': False, 'shape': (3, 2)}", "its type"),
            ("{'descr': '\u{e9}f8', 'fortran_order': False, 'shape': (3, 2)}", "its type"),
            ("{'descr': '=f8', 'fortran_order': False, 'shape': (3, 2)}", "type =f8, which is not read"),
            ("{'descr': '|f8', 'fortran_order': False, 'shape': (3, 2)}", "type |f8, which is not read"),
            ("{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (3,)}", "of records"),
            ("{'descr': '<f8', 'fortran_order': False, 'shape': (4, 2)}", "inside row 3 of 4"),
            (
                "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 18446744073709551615)}",
                "inside row 0 of 2",
            ),
        ] {
            let found = read(1, text).map(|_| ()).expect_err(text);
            assert!(found.contains(message), "{text}: {found}");
        }
        assert!(read(4, "{}").is_err_and(|error| error.contains("version 4.0")));
        assert!(read(3, &" ".repeat(10_001)).is_err_and(|error| error.contains("too long")));
    }
}
