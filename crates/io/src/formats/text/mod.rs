//! Columns of numbers: csv, xyz, txt, tsv, pts; with header or without, separated by commas, semicolons, tabs, bars or
//! blanks; quoted or not, with decimal points or decimal commas; and well-known text in a column.
//!
//! A first line without a number is the header; its names choose the columns (`columns.rs`). Every line must have as
//! many fields as the first, or none with anything in it.

mod columns;
mod fields;
mod kept;
mod missing;
#[cfg(test)]
mod tests;

use std::io::{self, Write};

use self::columns::{Columns, are_said, is_header, name_points};
use self::fields::{Separator, number, remark};
use self::kept::Kept;
use self::missing::{Missing, is_missing};
use super::lines::Lines;
use super::shapes::{Heights, Shapes, without_geometry};
use super::wkt;
use crate::chunks::Chunks;
use crate::error::excerpt;
use crate::{Cloud, Crs, Error, Graph, ReadOptions, Rings, Source};

/// No quoted field goes on for longer.
const LONGEST: usize = 1 << 26;

/// Reads points; `said` are header names or numbers from 1 for x, y and perhaps z, or none to find them.
pub(crate) fn read(source: Box<dyn Source>, options: &ReadOptions) -> Result<Cloud, Error> {
    read_in(source, options, &mut Chunks::default())
}

/// Reads in chunks.
pub(crate) fn read_in(
    source: Box<dyn Source>,
    options: &ReadOptions,
    chunks: &mut Chunks,
) -> Result<Cloud, Error> {
    let table = table(source, options, chunks, Wanted::Points)?;
    let parts = table.parts;
    let mut cloud = table.end()?.0;
    if parts > 0 {
        cloud.remarks.push(format!("the corners of {parts} lines and polygons were taken as points"));
    }
    Ok(cloud)
}

/// Reads points, or the lines and rings of a column of geometries.
pub(crate) fn read_graph(source: Box<dyn Source>, options: &ReadOptions) -> Result<Graph, Error> {
    let table = table(source, options, &mut Chunks::default(), Wanted::Shapes)?;
    let is_of_geometries = matches!(table.columns, Some(Columns::Geometry(_)));
    let (cloud, shapes) = table.end()?;
    if !is_of_geometries {
        return Ok(Graph::of_points(cloud));
    }
    let mut graph = shapes.graph()?;
    graph.cloud.crs = cloud.crs;
    graph.cloud.features = cloud.features;
    graph.cloud.remarks.splice(0..0, cloud.remarks);
    graph.cloud.losses.extend(cloud.losses);
    Ok(graph)
}

/// Reads the rings of a column of geometries, or all points as one ring.
pub(crate) fn read_rings(source: Box<dyn Source>) -> Result<Rings, Error> {
    let options = ReadOptions::default();
    let table = table(source, &options, &mut Chunks::default(), Wanted::Shapes)?;
    let is_of_geometries = matches!(table.columns, Some(Columns::Geometry(_)));
    let (cloud, shapes) = table.end()?;
    let rings = if is_of_geometries { shapes.rings().rings } else { vec![cloud.xy] };
    Ok(Rings { rings, crs: cloud.crs, losses: cloud.losses })
}

/// Whether the first lines tell of a column of geometries.
pub(crate) fn has_geometries(source: Box<dyn Source>) -> bool {
    let options = ReadOptions::default();
    let begun = table(source, &options, &mut Chunks::default(), Wanted::Columns);
    begun.is_ok_and(|table| matches!(table.columns, Some(Columns::Geometry(_))))
}

/// The purpose that a table is read for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Wanted {
    Points,
    /// Geometries as they are.
    Shapes,
    /// Which columns there are.
    Columns,
}

/// Reads a table.
fn table<'a>(
    source: Box<dyn Source>,
    options: &'a ReadOptions,
    chunks: &mut Chunks,
    wanted: Wanted,
) -> Result<Table<'a>, Error> {
    let said = &options.columns;
    if !(said.is_empty() || (2..=3).contains(&said.len())) {
        return Err(Error::content("two or three columns are needed, x,y or x,y,z"));
    }
    let mut lines = Lines::new(source);
    let mut table = Table::new(said, wanted, Kept::new(options));
    table.skips_missing = options.skip_missing;
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
        if wanted == Wanted::Columns {
            break;
        }
        table.before += chunks.offer(&mut table.cloud)?;
    }
    Ok(table)
}

/// A table being read.
struct Table<'a> {
    said: &'a [String],
    cloud: Cloud,
    wanted: Wanted,
    /// The geometries, where these are wanted.
    shapes: Shapes,
    /// The other columns.
    kept: Kept,
    /// Lines and polygons whose corners are among the points.
    parts: usize,
    /// Rows whose geometry is empty.
    empty: usize,
    /// Rows without coordinates are left out.
    skips_missing: bool,
    missing: Missing,
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
    fn new(said: &'a [String], wanted: Wanted, kept: Kept) -> Self {
        let cloud = Cloud::default();
        let (columns, above, count) = (None, Vec::new(), None);
        let shapes = Shapes::default();
        Self {
            said,
            cloud,
            wanted,
            shapes,
            kept,
            parts: 0,
            empty: 0,
            skips_missing: false,
            missing: Missing::default(),
            before: 0,
            columns,
            width: 0,
            above,
            left_out: 0,
            count,
            after_header: false,
        }
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
        /// Lines of remarks that are kept for the names of columns: nobody writes them further above.
        const MAX_LINES_ABOVE: usize = 1000;
        self.left_out += 1;
        if self.columns.is_none() && self.above.len() < MAX_LINES_ABOVE {
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
        self.kept.name(names, named, &columns);
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
        let mut lacks = false;
        let before = self.cloud.xy.len() + self.shapes.len();
        self.kept.begin();
        for (column, field) in separator.split(record).enumerate() {
            count += 1;
            last_is_empty = field.is_empty();
            match &self.columns {
                Some(Columns::Numbers(numbers))
                    if self.skips_missing && numbers.contains(&column) && is_missing(&field) =>
                {
                    lacks = true;
                }
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
            self.kept.take(column, &field);
        }
        // A separator may follow the last field.
        if count != self.width && !(last_is_empty && count == self.width + 1) {
            return Err(wrong(format!("{count} fields where the first line has {}", self.width)));
        }
        if lacks {
            self.missing.add(line);
            self.kept.take_back();
        } else if let Some(Columns::Numbers(_)) = self.columns {
            let [x, y, z] = point;
            self.cloud.push([x, y], z);
        }
        let points = self.cloud.xy.len() + self.shapes.len() - before;
        self.empty += usize::from(points == 0 && !lacks);
        self.kept.points(points);
        Ok(())
    }

    /// Rows have one field more than there are names: R writes names of rows without a name for their column.
    fn skip_row_names(&mut self) {
        self.width += 1;
        self.kept.shift();
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
        if self.wanted == Wanted::Shapes {
            let system = wkt::read_one(text, &mut self.shapes)?;
            return self.take_system(system);
        }
        let mut shapes = Shapes::default();
        let system = wkt::read_one(text, &mut shapes)?;
        self.take_system(system)?;
        self.parts += shapes.parts();
        let (xy, heights) = shapes.positions();
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

    /// Takes the system of a geometry, which is that of all.
    fn take_system(&mut self, system: Option<Crs>) -> Result<(), String> {
        match (&self.cloud.crs, system) {
            (Some(before), Some(now)) if *before != now => {
                Err(format!("its coordinates are {now}, those before it {before}"))
            }
            (None, system) => {
                self.cloud.crs = system;
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn end(mut self) -> Result<(Cloud, Shapes), Error> {
        let found = self.before + self.cloud.xy.len() + self.shapes.len();
        match self.count {
            // A number alone, and nothing that it counts.
            Some((_, line)) if self.columns.is_none() => {
                return Err(Error::Line { line, what: "a point needs two numbers, x and y".to_owned() });
            }
            Some((number, _)) if found + self.missing.count < number => {
                return Err(Error::Truncated(format!("after {found} of {number} points")));
            }
            _ => {}
        }
        if self.columns.is_none() && self.left_out > 0 {
            self.cloud.remarks.push(format!("all lines, {} of them, are remarks", self.left_out));
        }
        self.cloud.losses.extend(without_geometry(self.empty));
        self.cloud.remarks.extend(self.missing.told());
        self.cloud.features = self.kept.features();
        Ok((self.cloud, self.shapes))
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
    let mut most = 0;
    while let Some(line) = lines.next()? {
        let mut words = line.text.split_whitespace();
        let first = words.next();
        match words.next() {
            None => announced += line.number::<usize>(first, "the number of points")?,
            second => {
                let xy = [line.number(first, "x")?, line.number(second, "y")?];
                cloud.push(xy, line.number(words.next(), "z")?);
                most = words.count().max(most);
            }
        }
    }
    // An intensity, or red, green and blue, or all four.
    cloud.lose_values(["intensity", "color"].into_iter().filter(|&name| match name {
        "color" => most >= 3,
        _ => most == 1 || most >= 4,
    }));
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
