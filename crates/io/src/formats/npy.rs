//! NumPy arrays: points are float64 of shape (n, 2) or (n, 3), triangles integers of shape (t, 3).

use std::io::{self, BufReader, BufWriter, Write};

use npyz::{DType, NpyFile, Order, WriterBuilder};

use crate::{Cloud, Error, Shape, Source, Surface};

/// Numbers are read and written eight bytes at a time: from and to a buffer of a type that the compiler knows, which is ten
/// times faster than from and to one behind a pointer.
const BUFFER: usize = 1 << 18;

type File = NpyFile<BufReader<Box<dyn Source>>>;

fn open(source: Box<dyn Source>) -> Result<File, Error> {
    NpyFile::new(BufReader::with_capacity(BUFFER, source)).map_err(|error| match error.kind() {
        io::ErrorKind::UnexpectedEof => Error::Truncated("inside the array's header".to_owned()),
        _ => Error::content(format!("no NumPy array: {error}")),
    })
}

/// The rows and columns of a two-dimensional array in C order; NumPy writes Fortran order for transposed ones.
fn shape(file: &File, columns: &[u64], what: &str) -> Result<[usize; 2], Error> {
    match *file.shape() {
        [rows, width] if columns.contains(&width) => Ok([rows as usize, width as usize]),
        ref other => Err(Error::content(format!("the array has the shape {other:?}, not {what}"))),
    }
}

fn type_name(file: &File) -> String {
    match file.dtype() {
        DType::Plain(plain) => plain.to_string(),
        other => other.descr(),
    }
}

pub(crate) fn read_points(source: Box<dyn Source>) -> Result<Cloud, Error> {
    let file = open(source)?;
    let [rows, columns] = shape(&file, &[2, 3], "(n, 2) or (n, 3)")?;
    let (found, order) = (type_name(&file), file.order());
    let wrong = |_| Error::content(format!("the array is of type {found}, not float64"));
    let mut values = file.data::<f64>().map_err(wrong)?;
    let mut next = |row: usize| match values.next() {
        Some(Err(error)) if error.kind() != io::ErrorKind::UnexpectedEof => Err(error.into()),
        Some(Ok(value)) => Ok(value),
        _ => Err(Error::Truncated(format!("inside row {row} of {rows}"))),
    };
    let mut cloud = Cloud::with_capacity(rows, columns == 3);
    if order == Order::Fortran {
        // Column after column: all x, all y, all z.
        for row in 0..rows {
            cloud.xy.push([next(row)?, 0.0]);
        }
        for (row, point) in cloud.xy.iter_mut().enumerate() {
            point[1] = next(row)?;
        }
        if let Some(heights) = &mut cloud.z {
            for row in 0..rows {
                heights.push(next(row)?);
            }
        }
    } else {
        for row in 0..rows {
            let xy = [next(row)?, next(row)?];
            cloud.push(xy, if columns == 3 { next(row)? } else { 0.0 });
        }
    }
    Ok(cloud)
}

/// Reads rows of N indices.
pub(crate) fn read_simplices<const N: usize>(source: Box<dyn Source>) -> Result<Vec<[u64; N]>, Error> {
    let file = open(source)?;
    let [rows, _] = shape(&file, &[N as u64], &format!("(t, {N})"))?;
    let (found, order) = (type_name(&file), file.order());
    let values: Vec<i128> = match found.trim_start_matches(['<', '>', '|', '=']) {
        "i4" => integers(file.data::<i32>())?,
        "u4" => integers(file.data::<u32>())?,
        "i8" => integers(file.data::<i64>())?,
        "u8" => integers(file.data::<u64>())?,
        _ => return Err(Error::content(format!("the array is of type {found}, not an integer type"))),
    };
    if let Some(&negative) = values.iter().find(|&&i| i < 0) {
        return Err(Error::content(format!("the array has the negative index {negative}")));
    }
    let at = |row: usize, k: usize| match order {
        Order::C => values[N * row + k] as u64,
        Order::Fortran => values[k * rows + row] as u64,
    };
    Ok((0..rows).map(|row| std::array::from_fn(|k| at(row, k))).collect())
}

fn integers<T: Into<i128>, E: std::fmt::Display>(
    values: Result<impl Iterator<Item = io::Result<T>>, E>,
) -> Result<Vec<i128>, Error> {
    let values = values.map_err(|error| Error::content(error.to_string()))?;
    Ok(values.map(|value| value.map(Into::into)).collect::<io::Result<_>>()?)
}

/// Writes the triangles: int64 of shape (t, 3), from 0, counter-clockwise.
pub(crate) fn write_triangles(out: &mut dyn Write, surface: &Surface) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(BUFFER, out);
    let count = surface.triangles().count() as u64;
    let mut writer =
        npyz::WriteOptions::new().default_dtype().shape(&[count, 3]).writer(&mut out).begin_nd()?;
    for triangle in surface.triangles() {
        for index in triangle {
            writer.push(&(index as i64))?;
        }
    }
    writer.finish()?;
    out.flush()
}

pub(crate) fn write_points<const D: usize>(out: &mut dyn Write, points: &[[f64; D]]) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(BUFFER, out);
    let shape = [points.len() as u64, D as u64];
    let mut writer = npyz::WriteOptions::new().default_dtype().shape(&shape).writer(&mut out).begin_nd()?;
    writer.extend(points.as_flattened().iter().copied())?;
    writer.finish()?;
    out.flush()
}

/// Writes rows of integers: int64 of shape (rows, columns).
pub(crate) fn write_indices(out: &mut dyn Write, columns: usize, values: &[i64]) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(BUFFER, out);
    let shape = [(values.len() / columns) as u64, columns as u64];
    let mut writer = npyz::WriteOptions::new().default_dtype().shape(&shape).writer(&mut out).begin_nd()?;
    writer.extend(values.iter().copied())?;
    writer.finish()?;
    out.flush()
}

pub(crate) fn write_index_list(out: &mut dyn Write, values: &[i64]) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(BUFFER, out);
    let shape = [values.len() as u64];
    let mut writer = npyz::WriteOptions::new().default_dtype().shape(&shape).writer(&mut out).begin_nd()?;
    writer.extend(values.iter().copied())?;
    writer.finish()?;
    out.flush()
}
