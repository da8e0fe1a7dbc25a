//! Tables in Parquet: named columns of integers, numbers and places, for programs that read nothing else.
//!
//! One row group a file; integers as differences, which of indices along a curve are small. Columns are compressed by Snappy, which all
//! readers know and which needs no C compiler. With places a file is GeoParquet, version 1.1 (<https://geoparquet.org/releases/v1.1.0/>).
//!
//! Cost: O(n); a column is held once more while it is written.

use std::io::Write;
use std::sync::Arc;

use parquet::basic::{Compression, Encoding, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use serde_json::{Value, json};

use crate::{Crs, Error};

/// A column of a table.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Column<'a> {
    /// Integers: INT64.
    Integers(&'a [i64]),
    /// Numbers: DOUBLE.
    Numbers(&'a [f64]),
    /// Places, perhaps with heights, as well-known binary: a column of geometries, one a table.
    Places {
        /// x and y.
        xy: &'a [[f64; 2]],
        /// z.
        z: Option<&'a [f64]>,
        /// The system of coordinates, which the table says where it can ([`Crs::is_said_by_geoparquet`]).
        crs: Option<&'a Crs>,
    },
}

impl Column<'_> {
    fn physical(&self) -> Physical {
        match self {
            Self::Integers(_) => Physical::INT64,
            Self::Numbers(_) => Physical::DOUBLE,
            Self::Places { .. } => Physical::BYTE_ARRAY,
        }
    }
}

/// Writes a table of columns that are equally long.
///
/// # Errors
/// Those of the writer; and for columns of several lengths.
///
/// ```
/// use delone_io::{Column, write_columns};
///
/// let mut bytes = Vec::new();
/// write_columns(&mut bytes, &[("id", Column::Integers(&[3, 4])), ("x", Column::Numbers(&[0.5, 1.5]))])?;
/// assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"));
/// # Ok::<(), delone_io::Error>(())
/// ```
pub fn write_columns(out: &mut (dyn Write + Send), columns: &[(&str, Column)]) -> Result<(), Error> {
    write(out, columns).map_err(|error| match error {
        ParquetError::External(error) => match error.downcast::<std::io::Error>() {
            Ok(error) => Error::Io(*error),
            Err(error) => Error::Io(std::io::Error::other(error)),
        },
        error => Error::Io(std::io::Error::other(error)),
    })
}

fn write(out: &mut (dyn Write + Send), columns: &[(&str, Column)]) -> Result<(), ParquetError> {
    let field = |(name, column): &(&str, Column)| {
        let field = Type::primitive_type_builder(name, column.physical());
        Ok(Arc::new(field.with_repetition(Repetition::REQUIRED).build()?))
    };
    let fields = columns.iter().map(field).collect::<Result<Vec<_>, ParquetError>>()?;
    let schema = Arc::new(Type::group_type_builder("table").with_fields(fields).build()?);
    let mut properties =
        WriterProperties::builder().set_dictionary_enabled(false).set_compression(Compression::SNAPPY);
    let mut about = None;
    for (name, column) in columns {
        match column {
            Column::Integers(_) => {
                properties = properties.set_column_encoding((*name).into(), Encoding::DELTA_BINARY_PACKED);
            }
            Column::Numbers(_) => {}
            Column::Places { xy, z, crs } => {
                // Least and greatest strings of bytes mean nothing.
                properties =
                    properties.set_column_statistics_enabled((*name).into(), EnabledStatistics::None);
                about = Some(vec![KeyValue::new("geo".to_owned(), geo(name, xy, *z, *crs).to_string())]);
            }
        }
    }
    properties = properties.set_key_value_metadata(about);
    let mut file = SerializedFileWriter::new(out, schema, Arc::new(properties.build()))?;
    let mut group = file.next_row_group()?;
    for (_, column) in columns {
        let Some(mut writer) = group.next_column()? else { break };
        match column {
            Column::Integers(values) => writer.typed::<Int64Type>().write_batch(values, None, None)?,
            Column::Numbers(values) => writer.typed::<DoubleType>().write_batch(values, None, None)?,
            Column::Places { xy, z, .. } => {
                let writer = writer.typed::<ByteArrayType>();
                let mut written = 0;
                for start in (0..xy.len()).step_by(PLACES_AT_ONCE) {
                    let part = start..xy.len().min(start + PLACES_AT_ONCE);
                    let places: Vec<ByteArray> = part.map(|i| place(xy[i], z.map(|z| z[i])).into()).collect();
                    written += writer.write_batch(&places, None, None)?;
                }
                written
            }
        };
        writer.close()?;
    }
    group.close()?;
    file.close()?;
    Ok(())
}

/// Places that are made in memory before they are written.
const PLACES_AT_ONCE: usize = 1 << 16;

/// A point as well-known binary, as ISO has it.
fn place([x, y]: [f64; 2], z: Option<f64>) -> Vec<u8> {
    let kind: u32 = if z.is_some() { 1001 } else { 1 };
    let numbers = [Some(x), Some(y), z].into_iter().flatten().flat_map(f64::to_le_bytes);
    [1].into_iter().chain(kind.to_le_bytes()).chain(numbers).collect()
}

/// The entry of a table that makes it GeoParquet.
fn geo(name: &str, xy: &[[f64; 2]], z: Option<&[f64]>, crs: Option<&Crs>) -> Value {
    let kind = if z.is_some() { "Point Z" } else { "Point" };
    let mut column = json!({ "encoding": "WKB", "geometry_types": [kind] });
    // A system that is left out is longitude and latitude of WGS 84, and null one that is not known.
    if !crs.is_some_and(Crs::is_plain_degrees) {
        column["crs"] = crs.and_then(Crs::projjson).unwrap_or_default();
    }
    let ends = |values: &mut dyn Iterator<Item = f64>| {
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        values.fold(none, |(low, high), x| (low.min(x), high.max(x)))
    };
    let sides = [0, 1].map(|k| ends(&mut xy.iter().map(|p| p[k])));
    let sides: Vec<(f64, f64)> = sides.into_iter().chain(z.map(|z| ends(&mut z.iter().copied()))).collect();
    if !xy.is_empty() {
        let low = sides.iter().map(|side| side.0);
        column["bbox"] = low.chain(sides.iter().map(|side| side.1)).collect();
    }
    json!({ "version": "1.1.0", "primary_column": name, "columns": { name: column } })
}

#[cfg(test)]
mod tests {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;

    use super::{Column, write_columns};
    use crate::Crs;

    #[test]
    fn what_is_written_is_read_again() {
        let integers: Vec<i64> = (0..3000).map(|i| (i * 7919 % 1000) << 32 | i).collect();
        let numbers: Vec<f64> = (0..3000).map(|i| f64::from(i).sqrt() - 30.0).chain([]).collect();
        for count in [0, 1, 3000] {
            let mut bytes = Vec::new();
            let columns =
                [("name", Column::Integers(&integers[..count])), ("x", Column::Numbers(&numbers[..count]))];
            write_columns(&mut bytes, &columns).expect("written");
            let reader = SerializedFileReader::new(bytes::Bytes::from(bytes)).expect("a table");
            let rows: Vec<(i64, f64)> = reader
                .get_row_iter(None)
                .expect("rows")
                .map(|row| row.expect("a row"))
                .map(|row| (row.get_long(0).expect("an integer"), row.get_double(1).expect("a number")))
                .collect();
            let expected: Vec<(i64, f64)> =
                integers[..count].iter().copied().zip(numbers.iter().copied()).collect();
            assert_eq!(rows, expected);
        }
    }

    #[test]
    fn places_say_their_system() {
        let (xy, z) = ([[3.0, 4.0], [1.0, 7.0]], [5.0, 6.0]);
        let about = |z, crs: Option<&Crs>| {
            let mut bytes = Vec::new();
            write_columns(&mut bytes, &[("geometry", Column::Places { xy: &xy, z, crs })]).expect("written");
            let reader = SerializedFileReader::new(bytes::Bytes::from(bytes)).expect("a table");
            let row = reader.get_row_iter(None).expect("rows").next().expect("one").expect("a row");
            let told = reader.metadata().file_metadata().key_value_metadata().expect("told")[0].clone();
            assert_eq!(told.key, "geo");
            let geo: serde_json::Value = serde_json::from_str(&told.value.expect("a value")).expect("JSON");
            (geo["columns"]["geometry"].clone(), row.get_bytes(0).expect("bytes").data().to_vec())
        };
        let (column, bytes) = about(None, Some(&Crs::of_epsg(32_733)));
        assert_eq!(bytes, [&[1, 1, 0, 0, 0][..], &3f64.to_le_bytes(), &4f64.to_le_bytes()].concat());
        assert_eq!(column["crs"]["id"]["code"], 32_733);
        assert_eq!(column["bbox"], serde_json::json!([1.0, 4.0, 3.0, 7.0]));
        let (column, bytes) = about(Some(&z), Some(&Crs::of_epsg(4326)));
        assert_eq!((bytes.len(), bytes[1..3].to_vec()), (29, vec![0xe9, 3]));
        assert!(column.get("crs").is_none(), "it goes without saying");
        for unsaid in [None, Some(&Crs::of_epsg(2056))] {
            let (column, _) = about(None, unsaid);
            assert!(column.get("crs").is_some_and(serde_json::Value::is_null));
        }
    }

    #[test]
    fn columns_of_several_lengths_are_refused() {
        let columns = [("a", Column::Integers(&[1, 2])), ("x", Column::Numbers(&[0.5]))];
        assert!(write_columns(&mut Vec::new(), &columns).is_err());
    }
}
