//! NumPy arrays: points are float64 of shape (n, 2) or (n, 3), triangles integers of shape (t, 3).

use std::io::{self, BufReader, BufWriter, Write};
use std::sync::mpsc::sync_channel;

use npyz::{DType, NpyFile, Order, WriterBuilder};

use crate::{Cloud, Error, Source};

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

/// Writes so many rows of indices: int64 of shape (count, N), from 0.
///
/// Half of the time goes to the numbers and half to the system, so they are two threads' work where there are two.
pub(crate) fn write_simplices<const N: usize>(
    out: &mut dyn Write,
    count: usize,
    rows: impl Iterator<Item = [usize; N]> + Send,
) -> io::Result<()> {
    let mut header = Vec::new();
    let options = npyz::WriteOptions::<i64>::new().default_dtype().shape(&[count as u64, N as u64]);
    options.writer(&mut header).write_header_only()?;
    out.write_all(&header)?;
    let mut rows = rows.fuse();
    let mut block = move || {
        let mut block = Vec::with_capacity(BUFFER);
        for row in rows.by_ref().take(BUFFER / (8 * N)) {
            row.iter().for_each(|&i| block.extend_from_slice(&(i as i64).to_le_bytes()));
        }
        (!block.is_empty()).then_some(block)
    };
    if count < BUFFER || rayon::current_num_threads() == 1 {
        return std::iter::from_fn(block).try_for_each(|block| out.write_all(&block));
    }
    std::thread::scope(|scope| {
        let (ready, blocks) = sync_channel::<Vec<u8>>(4);
        // A writer that fails hangs up.
        scope.spawn(move || std::iter::from_fn(&mut block).all(|block| ready.send(block).is_ok()));
        blocks.iter().try_for_each(|block| out.write_all(&block))
    })
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

#[cfg(test)]
mod tests {
    use std::io::{self, Write};

    use super::{BUFFER, write_simplices};

    /// Takes so many bytes.
    struct Full(usize);

    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0 = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    fn rows(count: usize) -> impl Iterator<Item = [usize; 3]> + Send {
        (0..count).map(|i| [i, i + 1, 7 * i])
    }

    #[test]
    fn rows_are_written_in_order_by_one_thread_or_two() {
        for count in [0, 1, BUFFER / 24, BUFFER / 24 + 1, BUFFER - 1, BUFFER, 2 * BUFFER + 5] {
            let mut bytes = Vec::new();
            write_simplices(&mut bytes, count, rows(count)).expect("room");
            let (header, data) = bytes.split_at(bytes.len() - 24 * count);
            assert!(header.starts_with(b"\x93NUMPY") && header.len() % 64 == 0);
            let numbers = data.as_chunks().0.iter().map(|&bytes| i64::from_le_bytes(bytes));
            assert!(numbers.eq(rows(count).flatten().map(|i| i as i64)), "{count}");
        }
    }

    #[test]
    fn a_full_disk_is_an_error_soon() {
        for room in [0, 100, 24 * BUFFER] {
            let endless = write_simplices(&mut Full(room), 1 << 40, rows(usize::MAX / 8));
            assert_eq!(endless.map_err(|error| error.kind()), Err(io::ErrorKind::StorageFull));
        }
    }
}
