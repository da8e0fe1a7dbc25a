//! Tables in Parquet: named columns of integers and numbers, for programs that read nothing else.
//!
//! One row group a file; integers as differences, which of indices along a curve are small.
//!
//! Cost: O(n); a column is held once more while it is written.

use std::io::Write;
use std::sync::Arc;

use parquet::basic::{Encoding, Repetition, Type as Physical};
use parquet::data_type::{DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use crate::Error;

/// A column of a table.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Column<'a> {
    /// Integers: INT64.
    Integers(&'a [i64]),
    /// Numbers: DOUBLE.
    Numbers(&'a [f64]),
}

impl Column<'_> {
    fn physical(&self) -> Physical {
        match self {
            Self::Integers(_) => Physical::INT64,
            Self::Numbers(_) => Physical::DOUBLE,
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
    let mut properties = WriterProperties::builder().set_dictionary_enabled(false);
    for (name, column) in columns {
        if let Column::Integers(_) = column {
            properties = properties.set_column_encoding((*name).into(), Encoding::DELTA_BINARY_PACKED);
        }
    }
    let mut file = SerializedFileWriter::new(out, schema, Arc::new(properties.build()))?;
    let mut group = file.next_row_group()?;
    for (_, column) in columns {
        let Some(mut writer) = group.next_column()? else { break };
        match column {
            Column::Integers(values) => writer.typed::<Int64Type>().write_batch(values, None, None)?,
            Column::Numbers(values) => writer.typed::<DoubleType>().write_batch(values, None, None)?,
        };
        writer.close()?;
    }
    group.close()?;
    file.close()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;

    use super::{Column, write_columns};

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
    fn columns_of_several_lengths_are_refused() {
        let columns = [("a", Column::Integers(&[1, 2])), ("x", Column::Numbers(&[0.5]))];
        assert!(write_columns(&mut Vec::new(), &columns).is_err());
    }
}
