//! Edges between points, with their lengths: as arrays of indices, text, and lines of GeoJSON.

use delone_predicates::hypotenuse;
use std::io::{self, Write};

use delone::Coordinates;

use super::{geojson, npy, vector};
use crate::{Contents, Crs, Direction, Error, Format};

/// Edges to be written.
#[derive(Clone, Copy, Debug)]
pub struct Edges<'a, P> {
    /// The points.
    pub points: &'a [P],
    /// Pairs of indices of points.
    pub pairs: &'a [[usize; 2]],
    /// The width around each, where edges have one.
    pub widths: Option<&'a [f64]>,
    /// The system of coordinates; formats that can say it do.
    pub crs: Option<&'a Crs>,
}

impl<P: Coordinates> Edges<'_, P> {
    /// The distance of the ends of each, rounded; infinite where it is beyond the range.
    pub fn lengths(&self) -> impl Iterator<Item = f64> + '_ {
        self.pairs.iter().map(|edge| {
            let [a, b] = edge.map(|i| self.points[i].as_ref());
            a.iter().zip(b).map(|(x, y)| y - x).fold(0.0, hypotenuse)
        })
    }

    fn write_text(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "from,to,length{}", if self.widths.is_some() { ",width" } else { "" })?;
        for (k, ([v, w], length)) in self.pairs.iter().zip(self.lengths()).enumerate() {
            write!(out, "{v},{w},{length:?}")?;
            match self.widths {
                Some(widths) => writeln!(out, ",{:?}", widths[k])?,
                None => writeln!(out)?,
            }
        }
        Ok(())
    }

    /// A feature for each edge, with the indices of its ends and its length.
    fn write_geojson(&self, out: &mut dyn Write) -> io::Result<()> {
        write!(out, "{{\"type\":\"FeatureCollection\",")?;
        geojson::write_system(out, self.crs)?;
        write!(out, "\"features\":[")?;
        for (k, (edge, length)) in self.pairs.iter().zip(self.lengths()).enumerate() {
            let separator = if k == 0 { "" } else { "," };
            // JSON has no number for what is infinite.
            let number = |x: f64| if x.is_finite() { format!("{x:?}") } else { "null".to_owned() };
            let length = number(length);
            let width = self.widths.map_or_else(String::new, |of| format!(",\"width\":{}", number(of[k])));
            write!(
                out,
                "{separator}\n{{\"type\":\"Feature\",\"properties\":{{\"vertices\":{edge:?},\"length\":{length}{width}}},"
            )?;
            let [a, b] = edge.map(|i| self.points[i].as_ref());
            write!(out, "\"geometry\":{{\"type\":\"LineString\",\"coordinates\":[{a:?},{b:?}]}}}}")?;
        }
        writeln!(out, "\n]}}")
    }
}

/// Writes edges: npy (int64, two columns), text (from, to, length), GeoJSON, FlatGeobuf or GeoPackage (a line each).
///
/// # Errors
/// For other formats, and when writing fails.
pub fn write_edges(
    out: &mut dyn Write,
    format: Format,
    edges: &Edges<impl Coordinates>,
) -> Result<(), Error> {
    match format {
        Format::Npy => {
            let indices: Vec<i64> = edges.pairs.as_flattened().iter().map(|&i| i as i64).collect();
            npy::write_indices(out, 2, &indices)?;
        }
        Format::Text => edges.write_text(out)?,
        Format::GeoJson => edges.write_geojson(out)?,
        Format::FlatGeobuf | Format::GeoPackage => vector::write(out, format, &vector::Edged(edges))?,
        _ => return Err(format.without(Contents::Edges, Direction::Written)),
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{Edges, write_edges};
    use crate::Format;

    fn written(format: Format) -> String {
        let points = [[0.0, 0.0, 0.0], [1.0, 2.0, -2.0], [f64::MAX, -f64::MAX, 0.5]];
        let edges = Edges { points: &points, pairs: &[[0, 1], [1, 2]], widths: None, crs: None };
        let mut out = Vec::new();
        write_edges(&mut out, format, &edges).expect("written");
        String::from_utf8_lossy(&out).into_owned()
    }

    #[test]
    fn lengths_that_no_number_holds_are_said() {
        assert_eq!(written(Format::Text), "from,to,length\n0,1,3.0\n1,2,inf\n");
        let json: serde_json::Value = serde_json::from_str(&written(Format::GeoJson)).expect("JSON");
        assert_eq!(json["features"][0]["properties"]["length"], 3.0);
        assert_eq!(json["features"][1]["properties"]["length"], serde_json::Value::Null);
        assert_eq!(json["features"][0]["geometry"]["coordinates"][1][2], -2.0);
        assert_eq!(json["features"][1]["properties"]["vertices"], serde_json::json!([1, 2]));
        assert!(
            write_edges(
                &mut Vec::new(),
                Format::Las,
                &Edges::<[f64; 2]> { points: &[], pairs: &[], widths: None, crs: None }
            )
            .is_err()
        );
    }
}
