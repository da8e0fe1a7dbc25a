//! Answers to queries: a table with a row for each query, which has its place, its attributes and what was found.

use std::io::{self, Write};

use crate::formats::geojson::{Properties, write_system};
use crate::formats::vector;
use crate::{Contents, Crs, Direction, Error, Features, Format, Value};

/// The axes, as columns are called.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Answers to queries of the plane or of space.
#[derive(Debug)]
pub struct Answers<'a, P> {
    /// The queries.
    pub queries: &'a [P],
    /// Their attributes.
    pub features: &'a Features,
    /// The system of coordinates; formats that can say it do.
    pub crs: Option<&'a Crs>,
    /// The names of the answers to a query, in their order.
    pub names: &'a [String],
    /// The answers to all queries.
    pub found: Found<'a>,
}

/// The answers, a row for each query.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Found<'a> {
    /// Indices, -1 where there is none.
    Indices(&'a [i64]),
    /// Numbers, NaN where there is none.
    Numbers(&'a [f64]),
}

impl Found<'_> {
    /// One of them, for tables of text and as JSON.
    fn text(self, at: usize) -> [String; 2] {
        match self {
            Self::Indices(all) => [all[at].to_string(), all[at].to_string()],
            Self::Numbers(all) if all[at].is_finite() => [all[at].to_string(), format!("{:?}", all[at])],
            Self::Numbers(all) => [all[at].to_string(), "null".to_owned()],
        }
    }
}

/// Writes answers: as CSV with the columns `x,y` or `x,y,z`, those of the attributes and those of the answers, under a header; or as
/// GeoJSON, FlatGeobuf or GeoPackage, a point for each query with all of that as properties. An attribute that has the name of another column gets a number after it.
///
/// # Errors
/// [`Error::Unsupported`] for other formats, and those of the output.
///
/// # Panics
/// If there are not as many answers as queries and names.
///
/// ```
/// use delone_io::{Answers, Features, Format, Found, write_answers};
///
/// let answers = Answers {
///     queries: &[[0.5, 2.0]],
///     features: &Features::default(),
///     crs: None,
///     names: &["nearest".to_owned()],
///     found: Found::Indices(&[7]),
/// };
/// let mut file = Vec::new();
/// write_answers(&mut file, Format::Text, &answers)?;
/// assert_eq!(file, b"x,y,nearest\n0.5,2.0,7\n");
/// # Ok::<(), delone_io::Error>(())
/// ```
pub fn write_answers<P: AsRef<[f64]>>(
    out: &mut dyn Write,
    format: Format,
    answers: &Answers<P>,
) -> Result<(), Error> {
    match format {
        Format::Text => answers.write_text(out)?,
        Format::GeoJson => answers.write_geojson(out)?,
        Format::FlatGeobuf | Format::GeoPackage => vector::write(out, format, &vector::Answered(answers))?,
        _ => return Err(format.without(Contents::Answers, Direction::Written)),
    }
    Ok(())
}

impl<P: AsRef<[f64]>> Answers<'_, P> {
    fn write_text(&self, out: &mut dyn Write) -> io::Result<()> {
        let table = &self.features.table;
        let axes = &AXES[..self.queries.first().map_or(2, |query| query.as_ref().len())];
        let ours: Vec<&str> = axes.iter().copied().chain(self.names.iter().map(String::as_str)).collect();
        let names = table.names_beside(&ours);
        let header = axes.iter().copied().chain(names.iter().chain(self.names).map(String::as_str));
        let header: Vec<String> = header.map(|name| Value::Text(name).field()).collect();
        writeln!(out, "{}", header.join(","))?;
        for (i, query) in self.queries.iter().enumerate() {
            let place = query.as_ref().iter().map(|x| format!("{x:?}"));
            let attributes = table.fields(self.features.row(i));
            let found = self.own(i).map(|at| self.found.text(at).into_iter().next().unwrap_or_default());
            let fields: Vec<String> = place.chain(attributes).chain(found).collect();
            writeln!(out, "{}", fields.join(","))?;
        }
        Ok(())
    }

    fn write_geojson(&self, out: &mut dyn Write) -> io::Result<()> {
        let ours: Vec<&str> = self.names.iter().map(String::as_str).collect();
        let properties = Properties::beside(&self.features.table, &ours);
        let names: Vec<String> = ours.iter().map(|&name| serde_json::Value::from(name).to_string()).collect();
        write!(out, "{{\"type\":\"FeatureCollection\",")?;
        write_system(out, self.crs)?;
        write!(out, "\"features\":[")?;
        for (i, query) in self.queries.iter().enumerate() {
            write!(out, "{}\n{{\"type\":\"Feature\",\"properties\":{{", if i == 0 { "" } else { "," })?;
            for (k, (name, at)) in names.iter().zip(self.own(i)).enumerate() {
                let [_, value] = self.found.text(at);
                write!(out, "{}{name}:{value}", if k == 0 { "" } else { "," })?;
            }
            properties.write(out, self.features.row(i))?;
            let place: Vec<String> = query.as_ref().iter().map(|x| format!("{x:?}")).collect();
            write!(out, "}},\"geometry\":{{\"type\":\"Point\",\"coordinates\":[{}]}}}}", place.join(","))?;
        }
        writeln!(out, "\n]}}")
    }

    /// Where the answers to a query are.
    pub(crate) fn own(&self, query: usize) -> std::ops::Range<usize> {
        let width = self.names.len();
        query * width..(query + 1) * width
    }
}
