//! Columns of numbers: csv, xyz, txt, tsv, pts; with header or without, separated by commas, semicolons, tabs, bars or
//! blanks; quoted or not, with decimal points or decimal commas; and well-known text in a column.
//!
//! A first line without a number is the header; its names choose the columns (`columns.rs`). Every line must have as
//! many fields as the first, or none with anything in it.

mod columns;
mod fields;

use std::io::{self, Write};

use self::columns::{Columns, are_said, is_header, name_points};
use self::fields::{Separator, number, remark};
use super::lines::Lines;
use super::shapes::Heights;
use super::wkt;
use crate::chunks::Chunks;
use crate::error::excerpt;
use crate::{Cloud, Error, Source};

/// No quoted field goes on for longer.
const LONGEST: usize = 1 << 26;

/// Reads points; `said` are header names or numbers from 1 for x, y and perhaps z, or none to find them.
pub(crate) fn read(source: Box<dyn Source>, said: &[String]) -> Result<Cloud, Error> {
    read_in(source, said, &mut Chunks::default())
}

/// Reads in chunks.
pub(crate) fn read_in(source: Box<dyn Source>, said: &[String], chunks: &mut Chunks) -> Result<Cloud, Error> {
    if !(said.is_empty() || (2..=3).contains(&said.len())) {
        return Err(Error::content("two or three columns are needed, x,y or x,y,z"));
    }
    let mut lines = Lines::new(source);
    let mut table = Table::new(said);
    let mut separator = None;
    let mut record = String::new();
    while let Some(line) = lines.next_whole()? {
        let at = line.number;
        if at == 1
            && let Some(said) = Separator::said(line.text)
        {
            separator = Some(said);
            continue;
        }
        record.clear();
        record.push_str(line.text);
        if let Some(text) = remark(&record) {
            if table.is_like_a_row(separator, &record, text) {
                let what =
                    "it may be a remark or a row: put its first field in quotes, or a blank after its sign";
                return Err(Error::Line { line: at, what: what.to_owned() });
            }
            table.heed(text);
            continue;
        }
        let sign = *separator.get_or_insert_with(|| Separator::of(&record));
        // A quoted field may go on in the next lines.
        let wrong = |what: String| Error::Line { line: at, what };
        let mut open = sign.stays_open(&record, false).map_err(wrong)?;
        while open {
            let more = lines.next_whole()?.filter(|_| record.len() < LONGEST);
            let more = more.ok_or_else(|| wrong("a quotation mark is not closed".to_owned()))?;
            open = sign.stays_open(more.text, true).map_err(wrong)?;
            record.push('\n');
            record.push_str(more.text);
        }
        // Spreadsheets leave rows of nothing at the end.
        if sign.is_nothing(&record) {
            continue;
        }
        if table.columns.is_none() && table.takes_count(at, sign, &record) {
            separator = None;
            continue;
        }
        match table.columns {
            None => table.first(at, sign, &record)?,
            Some(_) => table.row(at, sign, &record)?,
        }
        table.before += chunks.offer(&mut table.cloud)?;
    }
    table.end()
}

/// A table being read.
struct Table<'a> {
    said: &'a [String],
    cloud: Cloud,
    /// How many points were given away.
    before: usize,
    columns: Option<Columns>,
    width: usize,
    /// The remarks before the first line, one of which may hold its names.
    above: Vec<String>,
    /// How many lines were remarks.
    left_out: usize,
    /// A number alone before the first line, which tells how many follow, and its line.
    count: Option<(usize, usize)>,
    /// The next row is the first after a header.
    after_header: bool,
}

impl<'a> Table<'a> {
    fn new(said: &'a [String]) -> Self {
        let cloud = Cloud::default();
        let (columns, above, count) = (None, Vec::new(), None);
        Self { said, cloud, before: 0, columns, width: 0, above, left_out: 0, count, after_header: false }
    }

    /// Whether a line that looks like a remark may be a row: its first field, such as #ff0000, is not a coordinate, and
    /// there are as many fields as in a row.
    fn is_like_a_row(&self, separator: Option<Separator>, record: &str, text: &str) -> bool {
        let is_coordinate = match &self.columns {
            None => true,
            Some(Columns::Numbers(numbers)) => numbers.contains(&0),
            Some(Columns::Geometry(column)) => *column == 0,
        };
        let fields = match separator {
            Some(sign @ Separator::Sign(_)) => sign.split(record).count(),
            _ => record.split_whitespace().count(),
        };
        !is_coordinate && !text.starts_with(char::is_whitespace) && fields >= self.width.max(2)
    }

    /// Keeps a remark before the first line.
    fn heed(&mut self, text: &str) {
        /// Nobody writes names so far above.
        const MOST: usize = 1000;
        self.left_out += 1;
        if self.columns.is_none() && self.above.len() < MOST {
            self.above.push(text.to_owned());
        }
    }

    /// The names in a remark above the first line, of which there are so many: the last that fits.
    fn names_above(&mut self, separator: Separator, width: usize) -> Option<Vec<String>> {
        let ways =
            [separator, Separator::Sign(','), Separator::Sign(';'), Separator::Sign('\t'), Separator::Blank];
        let by_name = self.said.iter().any(|name| name.trim().parse::<usize>().is_err());
        let above = std::mem::take(&mut self.above);
        above.iter().rev().find_map(|text| {
            let bare = without_brackets(text);
            let texts = [text.as_str(), &bare, bare.split_once(':').map_or("", |parts| parts.1)];
            let splits = texts.iter().flat_map(|text| {
                ways.iter().map(|way| way.split(text).map(String::from).collect::<Vec<String>>())
            });
            let fits = |names: &Vec<String>| {
                name_points(names, width) || (by_name && names.len() == width && are_said(names, self.said))
            };
            splits.into_iter().find(fits)
        })
    }

    /// Whether a line before all others only tells how many follow.
    fn takes_count(&mut self, line: usize, separator: Separator, record: &str) -> bool {
        let number = if separator == Separator::Blank { record.trim().parse::<usize>().ok() } else { None };
        let takes = number.is_some() && self.count.is_none();
        if takes {
            self.count = number.map(|number| (number, line));
        }
        takes
    }

    /// Finds out what the columns are.
    fn first(&mut self, line: usize, separator: Separator, record: &str) -> Result<(), Error> {
        let own: Vec<String> = separator.split(record).map(String::from).collect();
        let header = is_header(&own) || are_said(&own, self.said);
        let unread = !self.above.is_empty() && !header;
        // A remark before numbers may hold their names.
        let above = if header { None } else { self.names_above(separator, own.len()) };
        let (names, named) = match &above {
            Some(names) => (names, true),
            None => (&own, header),
        };
        let columns = Columns::choose(names, named, self.said).map_err(|what| Error::Line { line, what })?;
        let heights = matches!(&columns, Columns::Numbers(numbers) if numbers.len() == 3);
        self.cloud = Cloud::with_capacity(0, heights);
        let mut told = columns.remark(names, named);
        if told.is_none() && unread && above.is_none() {
            told =
                Some("the first columns were taken as x, y: the remarks above do not name them".to_owned());
        }
        self.cloud.remarks.extend(told.filter(|_| self.said.is_empty()));
        (self.columns, self.width, self.after_header) = (Some(columns), own.len(), header);
        if header { Ok(()) } else { self.row(line, separator, record) }
    }

    /// Takes the points of a row: one, or those of a geometry.
    fn row(&mut self, line: usize, separator: Separator, record: &str) -> Result<(), Error> {
        // R quotes the names of rows, and their column has no name.
        if std::mem::take(&mut self.after_header)
            && record.trim_start().starts_with('"')
            && separator.split(record).count() == self.width + 1
        {
            self.skip_row_names();
        }
        let wrong = |what: String| Error::Line { line, what };
        let mut point = [0.0; 3];
        let mut count = 0;
        let mut last_is_empty = false;
        for (column, field) in separator.split(record).enumerate() {
            count += 1;
            last_is_empty = field.is_empty();
            match &self.columns {
                Some(Columns::Numbers(numbers)) => {
                    for (axis, _) in numbers.iter().enumerate().filter(|entry| *entry.1 == column) {
                        point[axis] = number(&field, separator).ok_or_else(|| {
                            wrong(format!("field {} is {:?}, not a number", column + 1, excerpt(&field)))
                        })?;
                    }
                }
                Some(Columns::Geometry(geometry)) if *geometry == column => {
                    self.geometry(&field).map_err(wrong)?;
                }
                _ => {}
            }
        }
        // A separator may follow the last field.
        if count != self.width && !(last_is_empty && count == self.width + 1) {
            return Err(wrong(format!("{count} fields where the first line has {}", self.width)));
        }
        if let Some(Columns::Numbers(_)) = self.columns {
            let [x, y, z] = point;
            self.cloud.push([x, y], z);
        }
        Ok(())
    }

    /// Rows have one field more than there are names: R writes names of rows without a name for their column.
    fn skip_row_names(&mut self) {
        self.width += 1;
        if self.said.iter().any(|name| name.trim().parse::<usize>().is_ok()) {
            // Numbers are those of the columns of rows.
            return;
        }
        match &mut self.columns {
            Some(Columns::Numbers(numbers)) => numbers.iter_mut().for_each(|column| *column += 1),
            Some(Columns::Geometry(column)) => *column += 1,
            None => {}
        }
        self.cloud.remarks.push("the first column, which has no name, was left out".to_owned());
    }

    fn geometry(&mut self, text: &str) -> Result<(), String> {
        let (xy, heights) = wkt::read_one(text)?.positions();
        let is_first = self.before == 0 && self.cloud.xy.is_empty();
        match (heights, &mut self.cloud.z) {
            _ if xy.is_empty() => {}
            (Heights::OfAll(mut more), Some(z)) => z.append(&mut more),
            (Heights::OfAll(more), z) if is_first => *z = Some(more),
            (Heights::OfAll(_), None) => return Err("a position with height after some without".to_owned()),
            (Heights::None, None) => {}
            (Heights::None, Some(_)) => {
                return Err("a position without height after some with heights".to_owned());
            }
            (Heights::OfSome, _) => return Err("a position without height beside one with height".to_owned()),
        }
        self.cloud.xy.extend(xy);
        Ok(())
    }

    fn end(mut self) -> Result<Cloud, Error> {
        match self.count {
            // A number alone, and nothing that it counts.
            Some((_, line)) if self.columns.is_none() => {
                return Err(Error::Line { line, what: "a point needs two numbers, x and y".to_owned() });
            }
            Some((number, _)) if self.before + self.cloud.xy.len() < number => {
                let found = self.before + self.cloud.xy.len();
                return Err(Error::Truncated(format!("after {found} of {number} points")));
            }
            _ => {}
        }
        if self.columns.is_none() && self.left_out > 0 {
            self.cloud.remarks.push(format!("all lines, {} of them, are remarks", self.left_out));
        }
        Ok(self.cloud)
    }
}

/// A text without what is in brackets, such as units.
fn without_brackets(text: &str) -> String {
    let mut depth = 0_usize;
    text.chars()
        .filter(|&c| {
            depth += usize::from("([".contains(c));
            let outside = depth == 0;
            depth = depth.saturating_sub(usize::from(")]".contains(c)));
            outside
        })
        .collect()
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
            "sep=;\n1;2\n3,5;-4",
            "# lat lon\n2 1\n-4 3.5",
            "#lat,lon\n2,1\n-4,3.5",
            "#,x,y\n7,1,2\n8,3.5,-4",
            "2\n1 2\n3.5 -4\n\u{1a}",
            "//X Y\n2\n1 2\n3.5 -4",
            "\"x\" \"y\"\n\"1\" 1 2\n\"2\" 3.5 -4",
            "\tx\ty\tz\n0\t1\t2\t7\n1\t3.5\t-4\t7",
            "colour,x,y\n\"#ff0000\",1,2\n# 2,7,8\nred,3.5,-4",
            "1,2,\n3.5,-4,",
            "x,y\n1,2,\n3.5,-4,",
            "# lat lon (WGS84)\n# made by me\n2 1\n-4 3.5",
            "# columns: lat lon\n2 1\n-4 3.5",
            "geometry\nPOINT (1 2)\nMULTIPOINT (3.5 -4)",
            "wkt\nSRID=4326;MULTIPOINT (1 2,3.5 -4)",
            "MULTIPOINT (1 2, 3.5 -4)",
            "\"n\" \"x\" \"y\"\n\"a\"\"b\" 1 2\n\"c\" 3.5 -4",
            "n,x,y\n5\" pipe,1,2\n\"a\n\nb\",3.5,-4",
        ] {
            let cloud = parse(text, &[]).unwrap_or_else(|error| panic!("{text:?}: {error}"));
            let heights = text.contains('z').then(|| vec![7.0, 7.0]);
            assert_eq!((&cloud.xy, &cloud.z), (&plain.xy, &heights), "{text:?}");
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
            ("1\n2", "line 2: a point needs two numbers, x and y"),
            ("3\n1 2\n3 4\n", "the file ends after 2 of 3 points"),
            (
                "x,y,n\n1,2,\"5\" pipe\"\n3,4,\"6\" pipe\"",
                "line 2: a quotation mark inside of quotes is not doubled",
            ),
            ("x,y,z\n1,2,3,4", "line 2: 4 fields where the first line has 3"),
            ("x,y\n\"1,000\",2", "line 2: field 1 is \"1,000\", not a number"),
            (
                "colour,wkt\n#ff0000,POINT (1 2)",
                "line 2: it may be a remark or a row: put its first field in quotes, or a blank after its sign",
            ),
            (
                "name x y\n#1 1 2",
                "line 2: it may be a remark or a row: put its first field in quotes, or a blank after its sign",
            ),
            ("wkt\nPOINT (1 2)\nPOINT Z (1 2 3)", "line 3: a position with height after some without"),
            ("1\n", "line 1: a point needs two numbers, x and y"),
            ("NA,NA\n1,2", "line 1: field 1 is \"NA\", not a number"),
            ("0.1D+01,0.2D+01\n1,2", "line 1: field 1 is \"0.1D+01\", not a number"),
            ("50N,7E\n1,2", "line 1: field 1 is \"50N\", not a number"),
            ("x,y\n1.#INF,2", "line 2: field 1 is \"1.#INF\", not a number"),
            (
                "1,5000,1000,100.5,TP",
                "line 1: without names it cannot be told which of 5 columns are x and y, one of which is \"TP\"",
            ),
            ("Breite,Wert\n1,2", "line 1: none of the columns Breite, Wert is called x or y"),
            ("x,y,n\n1,2,\"a\n3,4,b\n", "line 2: a quotation mark is not closed"),
            (
                "id,x,y\n1,2,3\n#2,7,8",
                "line 3: it may be a remark or a row: put its first field in quotes, or a blank after its sign",
            ),
            ("x;wkt\n1;POINT 1 2", "line 2: \"POINT 1 2\" is no geometry such as POINT (1 2)"),
            ("N/A,1\n2,3", "line 1: field 1 is \"N/A\", not a number"),
            ("id,foo,bar\n1,2,3", "line 1: none of the columns id, foo, bar is called x or y"),
            ("1.5;1,234.5", "line 1: field 2 is \"1,234.5\", not a number"),
            ("id,wkt\n1,POINT (1)", "line 2: \"POINT (1)\" is no geometry such as POINT (1 2)"),
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
