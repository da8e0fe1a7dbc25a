//! Columns of numbers: csv, xyz, txt, tsv, pts; with header or without, separated by commas, semicolons, tabs, bars or
//! blanks; quoted or not, with decimal points or decimal commas; and well-known text in a column.
//!
//! A first line without a number is the header; its names choose the columns (`columns.rs`). Every line must have as
//! many fields as the first, or none with anything in it.

mod columns;
mod wkt;

use std::borrow::Cow;
use std::io::{self, Write};

use self::columns::{Columns, is_header};
use super::lines::Lines;
use crate::error::excerpt;
use crate::{Cloud, Error, Source};

/// Reads points; `said` are header names or numbers from 1 for x, y and perhaps z, or none to find them.
pub(crate) fn read(source: Box<dyn Source>, said: &[String]) -> Result<Cloud, Error> {
    if !(said.is_empty() || (2..=3).contains(&said.len())) {
        return Err(Error::content("two or three columns are needed, x,y or x,y,z"));
    }
    let mut lines = Lines::new(source);
    let mut table = Table { said, cloud: Cloud::default(), columns: None, width: 0 };
    let mut separator = None;
    let mut record = String::new();
    while let Some(line) = lines.next_whole()? {
        let at = line.number;
        record.clear();
        record.push_str(line.text);
        let separator = *separator.get_or_insert_with(|| Separator::of(&record));
        // A quoted field may go on in the next line.
        while separator.is_open(&record) {
            let Some(more) = lines.next_whole()? else {
                return Err(Error::Line { line: at, what: "a quotation mark is not closed".to_owned() });
            };
            record.push('\n');
            record.push_str(more.text);
        }
        let fields = separator.split(&record);
        match table.columns {
            None => table.first(at, &fields.map(Cow::into_owned).collect::<Vec<_>>())?,
            // Spreadsheets leave rows of nothing at the end.
            Some(_) if separator.is_nothing(&record) => {}
            Some(_) => table.row(at, fields)?,
        }
    }
    Ok(table.cloud)
}

/// A table being read.
struct Table<'a> {
    said: &'a [String],
    cloud: Cloud,
    columns: Option<Columns>,
    width: usize,
}

impl Table<'_> {
    /// Finds out what the columns are.
    fn first(&mut self, line: usize, fields: &[String]) -> Result<(), Error> {
        let header = is_header(fields, |field| number(field).is_some());
        let columns =
            Columns::choose(fields, header, self.said).map_err(|what| Error::Line { line, what })?;
        let heights = matches!(&columns, Columns::Numbers(numbers) if numbers.len() == 3);
        self.cloud = Cloud::with_capacity(0, heights);
        self.cloud.remarks.extend(columns.remark(fields, header).filter(|_| self.said.is_empty()));
        (self.columns, self.width) = (Some(columns), fields.len());
        if header { Ok(()) } else { self.row(line, fields.iter()) }
    }

    /// Takes the points of a row: one, or those of a geometry.
    fn row<F: AsRef<str>>(&mut self, line: usize, fields: impl Iterator<Item = F>) -> Result<(), Error> {
        let wrong = |what: String| Error::Line { line, what };
        let mut point = [0.0; 3];
        let mut count = 0;
        for (column, field) in fields.enumerate() {
            count += 1;
            match &self.columns {
                Some(Columns::Numbers(numbers)) => {
                    for (axis, _) in numbers.iter().enumerate().filter(|entry| *entry.1 == column) {
                        let field = field.as_ref();
                        point[axis] = number(field).ok_or_else(|| {
                            wrong(format!("field {} is {:?}, not a number", column + 1, excerpt(field)))
                        })?;
                    }
                }
                Some(Columns::Geometry(geometry)) if *geometry == column => {
                    self.geometry(field.as_ref()).map_err(wrong)?;
                }
                _ => {}
            }
        }
        if count != self.width {
            return Err(wrong(format!("{count} fields where the first line has {}", self.width)));
        }
        if let Some(Columns::Numbers(_)) = self.columns {
            let [x, y, z] = point;
            self.cloud.push([x, y], z);
        }
        Ok(())
    }

    fn geometry(&mut self, text: &str) -> Result<(), String> {
        for position in wkt::positions(text)? {
            if self.cloud.xy.is_empty() && position.len() > 2 {
                self.cloud.z = Some(Vec::new());
            }
            match (position.get(2), &self.cloud.z) {
                (None, Some(_)) => return Err("a position without height after some with heights".to_owned()),
                (z, _) => self.cloud.push([position[0], position[1]], z.copied().unwrap_or_default()),
            }
        }
        Ok(())
    }
}

/// A number with a decimal point or a decimal comma; a remark after it is left out.
fn number(field: &str) -> Option<f64> {
    let field = field.split('#').next().unwrap_or_default().trim();
    field.parse().ok().or_else(|| match field.split_once(',') {
        Some((whole, part)) if !part.contains(',') && !field.contains('.') => {
            format!("{whole}.{part}").parse().ok()
        }
        _ => None,
    })
}

/// Reads points of a `.pts` file: the number of points, then x, y, z and other numbers in each line; perhaps several
/// such lists.
pub(crate) fn read_pts(source: Box<dyn Source>) -> Result<Cloud, Error> {
    let mut lines = Lines::new(source);
    let mut cloud = Cloud::with_capacity(0, true);
    let mut announced = 0;
    while let Some(line) = lines.next()? {
        let mut words = line.text.split_whitespace();
        let first = words.next();
        match words.next() {
            None => announced += line.number::<usize>(first, "the number of points")?,
            second => {
                let xy = [line.number(first, "x")?, line.number(second, "y")?];
                cloud.push(xy, line.number(words.next(), "z")?);
            }
        }
    }
    if cloud.xy.len() < announced {
        return Err(Error::Truncated(format!("after {} of {announced} points", cloud.xy.len())));
    }
    Ok(cloud)
}

/// What stands between fields.
#[derive(Clone, Copy)]
enum Separator {
    Sign(char),
    Blank,
}

impl Separator {
    /// By the first line, outside of quotes; a comma may be a decimal one, so others go first.
    fn of(line: &str) -> Self {
        let plain: String = line.split('"').step_by(2).collect();
        let geometry = wkt::is_geometry(&plain);
        let sign = ['\t', ';', '|', ','].into_iter().find(|&sign| plain.contains(sign));
        match sign {
            Some(sign) => Self::Sign(sign),
            // One column of quoted or well-known text.
            None if geometry || line.starts_with('"') => Self::Sign(','),
            None => Self::Blank,
        }
    }

    /// Whether there is nothing but separators.
    fn is_nothing(self, record: &str) -> bool {
        record.chars().all(|c| self.is(c) || c == '"' || c.is_whitespace())
    }

    fn is(self, c: char) -> bool {
        matches!(self, Self::Sign(sign) if sign == c)
    }

    /// Whether a quoted field has no end yet.
    fn is_open(self, record: &str) -> bool {
        matches!(self, Self::Sign(_)) && record.contains('"') && record.matches('"').count() % 2 == 1
    }

    /// The fields, without quotation marks around them.
    fn split(self, record: &str) -> Fields<'_> {
        Fields { separator: self, rest: Some(record) }
    }
}

/// The fields of a record.
struct Fields<'a> {
    separator: Separator,
    rest: Option<&'a str>,
}

impl<'a> Iterator for Fields<'a> {
    type Item = Cow<'a, str>;

    fn next(&mut self) -> Option<Cow<'a, str>> {
        let rest = self.rest?;
        let Separator::Sign(sign) = self.separator else {
            let word = rest.split('#').next().unwrap_or_default().trim_start();
            let end = word.find(char::is_whitespace).unwrap_or(word.len());
            self.rest = Some(&word[end..]);
            return (end > 0).then_some(Cow::Borrowed(&word[..end]));
        };
        let end = if rest.trim_start().starts_with('"') {
            // Two marks in a row stand for one: what is outside of marks changes at every one.
            let mut quoted = false;
            rest.char_indices().find_map(|(at, c)| {
                quoted ^= c == '"';
                (c == sign && !quoted).then_some(at)
            })
        } else {
            rest.find(sign)
        };
        self.rest = end.map(|end| &rest[end + 1..]);
        let field = rest[..end.unwrap_or(rest.len())].trim();
        Some(match field.strip_prefix('"') {
            None => Cow::Borrowed(field),
            Some(inner) => {
                let inner = inner.strip_suffix('"').unwrap_or(inner).trim();
                if inner.contains('"') {
                    Cow::Owned(inner.replace("\"\"", "\""))
                } else {
                    Cow::Borrowed(inner)
                }
            }
        })
    }
}

pub(crate) fn write<const D: usize>(out: &mut dyn Write, points: &[[f64; D]]) -> io::Result<()> {
    writeln!(out, "{}", ["x", "y", "z"][..D].join(","))?;
    for p in points {
        for (k, x) in p.iter().enumerate() {
            write!(out, "{}{x:?}", if k > 0 { "," } else { "" })?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// Writes rows of integers.
pub(crate) fn write_indices(out: &mut dyn Write, columns: usize, values: &[i64]) -> io::Result<()> {
    for row in values.chunks_exact(columns) {
        for (k, value) in row.iter().enumerate() {
            if k > 0 {
                write!(out, ",")?;
            }
            write!(out, "{value}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::read;
    use crate::Cloud;
    use std::io::Cursor;

    fn parse(text: &'static str, columns: &[&str]) -> Result<Cloud, String> {
        let columns: Vec<_> = columns.iter().map(ToString::to_string).collect();
        read(Box::new(Cursor::new(text)), &columns).map_err(|error| error.to_string())
    }

    #[test]
    fn separators_and_headers() {
        let plain = Cloud { xy: vec![[1.0, 2.0], [3.5, -4.0]], ..Cloud::default() };
        for text in [
            "1,2\n3.5,-4",
            "1 2\n3.5   -4\n\n",
            "x;y\n1;2\n3.5;-4\n",
            "# made by hand\n1\t2\n3.5\t-4",
            "lat,lon\n2,1\n-4,3.5",
            "1,2\r3.5,-4\r",
            "\u{feff}x,y\r\n\"1\",\"2\"\r\n3.5,-4\r\n",
            "name;x;y\n\"a; b\";1;2\nc;3,5;-4,0",
            "1|2\n3.5|-4",
            "id,geom\n1,POINT (1 2)\n2,\"MULTIPOINT (3.5 -4)\"",
            "POINT (1 2)\nPOINT (3.5 -4)",
            "x,y,2020\n1,2,0\n3.5,-4,0\n,,\n",
            "1,2 # the first\n3.5,-4",
        ] {
            let cloud = parse(text, &[]).unwrap_or_else(|error| panic!("{text:?}: {error}"));
            assert_eq!((&cloud.xy, &cloud.z), (&plain.xy, &plain.z), "{text:?}");
        }
        let high = parse("id,x,y,z\n7,1,2,3", &[]).expect("valid");
        assert_eq!((high.xy, high.z), (vec![[1.0, 2.0]], Some(vec![3.0])));
        assert_eq!(parse("a b c\n1 2 3", &["c", "1"]).expect("valid").xy, [[3.0, 1.0]]);
        assert_eq!(parse("", &[]), Ok(Cloud::default()));
        assert!(parse("nan,1", &[]).expect("the library judges").xy[0][0].is_nan());
    }

    #[test]
    fn errors_name_the_line() {
        for (text, message) in [
            ("1,2\n3", "line 2: 1 fields where the first line has 2"),
            ("1,2\n\n# comment\n3,x", "line 4: field 2 is \"x\", not a number"),
            ("1,2\n3,", "line 2: field 2 is \"\", not a number"),
            ("1\n2", "line 1: a point needs two numbers, x and y"),
            ("N/A,1\n2,3", "line 1: field 1 is \"N/A\", not a number"),
            ("id,foo,bar\n1,2,3", "line 1: none of the columns id, foo, bar is called x or y"),
            ("1.5;1,234.5", "line 1: field 2 is \"1,234.5\", not a number"),
            ("id,wkt\n1,POINT (1)", "line 2: \"1\" is no position"),
            ("1,2\0", "line 1: it is not text"),
        ] {
            assert_eq!(parse(text, &[]), Err(message.to_owned()), "{text:?}");
        }
        assert_eq!(
            parse("1,2", &["3", "1"]),
            Err("line 1: there is no column \"3\" among 2 without names".to_owned())
        );
    }
}
