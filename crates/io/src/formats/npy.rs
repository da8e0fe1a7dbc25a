//! NumPy arrays and archives of them: points are numbers of shape (n, 2) or (n, 3), triangles integers of shape (t, 3).

use std::io::{self, BufReader, BufWriter, Cursor, Read, Seek, Write};
use std::sync::mpsc::sync_channel;

use crate::{Cloud, Error, Source};

mod archive;
mod array;
mod blocks;
mod header;
mod stored;

pub use array::{Element, write_array};
pub(crate) use blocks::read_in;

use header::Header;

/// Numbers are read and written eight bytes at a time: from and to a buffer of a type that the compiler knows, which is ten
/// times faster than from and to one behind a pointer.
const BUFFER: usize = 1 << 18;

/// An array whose header is read.
struct File<R> {
    header: Header,
    source: BufReader<R>,
}

fn open<R: Read + Seek>(mut source: R) -> Result<File<R>, Error> {
    let header = Header::read(&mut source)?;
    Ok(File { header, source: BufReader::with_capacity(BUFFER, source) })
}

impl<R: Read> File<R> {
    /// All numbers until the source ends, each of so many bytes.
    fn numbers<T, const N: usize>(
        mut self,
        decode: impl Fn([u8; N]) -> T,
    ) -> impl Iterator<Item = Result<T, Error>> {
        let mut place = 0;
        std::iter::from_fn(move || {
            let mut bytes = [0; N];
            let read = self.source.read_exact(&mut bytes);
            place += 1;
            Some(read.map(|()| decode(bytes)).map_err(|error| ended(error, place - 1)))
        })
    }
}

/// Calls `$take` with the numbers of an array, whatever their type, each made another by `$convert`.
macro_rules! numbers {
    ($file:expr, $take:expr, $convert:expr, $($name:literal $from:ty),+) => {
        match $file.header.kind.as_str() {
            $($name => {
                let decode = if $file.header.is_big { <$from>::from_be_bytes } else { <$from>::from_le_bytes };
                $take(&mut $file.numbers(decode).map(|value| $convert(value?)))
            })+
            found => Err(Error::content(format!("the array is of type {found}, which is not read here"))),
        }
    };
}

fn ended(error: io::Error, at: usize) -> Error {
    match error.kind() {
        io::ErrorKind::UnexpectedEof => Error::Truncated(format!("after {at} numbers")),
        _ => error.into(),
    }
}

/// A whole number that a coordinate cannot be is refused: beyond 2^53 they are not all among the coordinates.
fn exact(value: i128) -> Result<f64, Error> {
    let near = value as f64;
    if near as i128 == value {
        Ok(near)
    } else {
        Err(Error::content(format!("{value} is no coordinate: it has more digits than float64")))
    }
}

/// Reads points of shape (n, 2) or (n, 3), or transposed, of floating point or whole numbers.
pub(crate) fn read_points<R: Read + Seek>(source: R) -> Result<Cloud, Error> {
    let file = open(source)?;
    let (rows, columns, transposed) = shape_of_points(&file.header.shape)?;
    // Point after point, or column after column: all x, all y, all z.
    let by_columns = file.header.by_columns != transposed;
    let take = |values: &mut dyn Iterator<Item = Result<f64, Error>>| fill(values, rows, columns, by_columns);
    let mut cloud = if file.header.kind == "f8" && !file.header.is_big {
        // The usual type, for which the compiler sees all of the loop.
        fill(file.numbers(f64::from_le_bytes), rows, columns, by_columns)
    } else if file.header.kind.starts_with('f') {
        numbers!(file, take, |value| Ok(Into::<f64>::into(value)), "f8" f64, "f4" f32)
    } else {
        numbers!(file, take, |value| exact(i128::from(value)),
            "i1" i8, "u1" u8, "i2" i16, "u2" u16, "i4" i32, "u4" u32, "i8" i64, "u8" u64)
    }?;
    if transposed {
        cloud.remarks.push(format!("the array of shape ({columns}, {rows}) was taken as {rows} points"));
    }
    Ok(cloud)
}

/// The numbers of points and of their coordinates, and whether the array is transposed.
fn shape_of_points(shape: &[u64]) -> Result<(usize, usize, bool), Error> {
    match *shape {
        [rows, columns @ (2 | 3)] => Ok((rows as usize, columns as usize, false)),
        [columns @ (2 | 3), rows] => Ok((rows as usize, columns as usize, true)),
        _ => Err(Error::content(format!("the array has the shape {shape:?}, not (n, 2) or (n, 3)"))),
    }
}

/// Reads numbers of shape (n,), (n, 1) or (1, n), floating point or whole.
pub(crate) fn read_list<R: Read + Seek>(source: R) -> Result<Vec<f64>, Error> {
    let file = open(source)?;
    let shape = &file.header.shape;
    let ([count] | [count, 1] | [1, count]) = shape[..] else {
        return Err(Error::content(format!("the array has the shape {shape:?}, not (n,)")));
    };
    // What a header claims takes no memory.
    let take = |values: &mut dyn Iterator<Item = Result<f64, Error>>| -> Result<Vec<f64>, Error> {
        values.take(count as usize).collect()
    };
    if file.header.kind.starts_with('f') {
        numbers!(file, take, |value| Ok(Into::<f64>::into(value)), "f8" f64, "f4" f32)
    } else {
        numbers!(file, take, |value| exact(i128::from(value)),
            "i1" i8, "u1" u8, "i2" i16, "u2" u16, "i4" i32, "u4" u32, "i8" i64, "u8" u64)
    }
}

/// Reads numbers of shape (rows, columns), floating point or whole: the numbers of rows and columns, and the values row by row.
pub(crate) fn read_grid<R: Read + Seek>(source: R) -> Result<(usize, usize, Vec<f64>), Error> {
    let file = open(source)?;
    let (shape, by_columns) = (&file.header.shape, file.header.by_columns);
    let [rows, columns] = shape[..] else {
        return Err(Error::content(format!("the array has the shape {shape:?}, not (rows, columns)")));
    };
    let too_many = || Error::content(format!("the array has the shape {shape:?}, too many for memory"));
    let (rows, columns) = (rows as usize, columns as usize);
    let count = rows.checked_mul(columns).ok_or_else(too_many)?;
    let take = |values: &mut dyn Iterator<Item = Result<f64, Error>>| -> Result<Vec<f64>, Error> {
        values.take(count).collect()
    };
    let values = if file.header.kind.starts_with('f') {
        numbers!(file, take, |value| Ok(Into::<f64>::into(value)), "f8" f64, "f4" f32)
    } else {
        numbers!(file, take, |value| exact(i128::from(value)),
            "i1" i8, "u1" u8, "i2" i16, "u2" u16, "i4" i32, "u4" u32, "i8" i64, "u8" u64)
    }?;
    if by_columns {
        let at = |i: usize| values[i % columns * rows + i / columns];
        return Ok((rows, columns, (0..count).map(at).collect()));
    }
    Ok((rows, columns, values))
}

/// Writes what stands before float64 of a shape, row by row.
pub(crate) fn write_header(out: &mut impl Write, shape: &[usize]) -> io::Result<()> {
    header::write(out, "f8", shape)
}

/// Points from the numbers of an array.
fn fill(
    mut values: impl Iterator<Item = Result<f64, Error>>,
    rows: usize,
    columns: usize,
    by_columns: bool,
) -> Result<Cloud, Error> {
    let mut next = || values.next().unwrap_or_else(|| Err(Error::Truncated("inside the numbers".to_owned())));
    let mut cloud = Cloud::with_capacity(rows, columns == 3);
    if by_columns {
        for _ in 0..rows {
            cloud.xy.push([next()?, 0.0]);
        }
        for point in &mut cloud.xy {
            point[1] = next()?;
        }
        if let Some(heights) = &mut cloud.z {
            for _ in 0..rows {
                heights.push(next()?);
            }
        }
    } else {
        for _ in 0..rows {
            let xy = [next()?, next()?];
            cloud.push(xy, if columns == 3 { next()? } else { 0.0 });
        }
    }
    Ok(cloud)
}

/// Reads the array of points of an archive: the one that is called so, or the only one that has the shape of points.
pub(crate) fn read_archive(mut source: Box<dyn Source>) -> Result<Cloud, Error> {
    const NAMES: [&str; 7] = ["points", "pts", "xy", "xyz", "coords", "coordinates", "vertices"];
    let mut arrays = Vec::new();
    let mut names = Vec::new();
    for entry in archive::entries(&mut source)? {
        let name = entry.name.trim_end_matches(".npy").to_owned();
        let bytes = entry.read(&mut source)?;
        if let Ok(cloud) = read_points(Cursor::new(bytes)) {
            arrays.push((name.clone(), cloud));
        }
        names.push(name);
    }
    let called = NAMES.iter().find_map(|name| arrays.iter().position(|(called, _)| called == name));
    let chosen = called.or_else(|| (arrays.len() == 1).then_some(0));
    let Some(chosen) = chosen else {
        return Err(Error::content(format!(
            "of its arrays {} {} points: call one of them points",
            names.join(", "),
            if arrays.is_empty() { "none has the shape of" } else { "several could be the" }
        )));
    };
    let (name, mut cloud) = arrays.swap_remove(chosen);
    if names.len() > 1 {
        cloud.remarks.push(format!("the array {name} of {} was taken", names.join(", ")));
    }
    Ok(cloud)
}

/// Reads pairs of indices, an array of shape (m, 2); an index that no list can have is the largest there is.
pub(crate) fn read_pairs(source: Box<dyn Source>) -> Result<Vec<[usize; 2]>, Error> {
    let rows = read_simplices::<2>(source)?;
    Ok(rows.into_iter().map(|ends| ends.map(|end| usize::try_from(end).unwrap_or(usize::MAX))).collect())
}

/// Reads rows of N indices.
pub(crate) fn read_simplices<const N: usize>(source: Box<dyn Source>) -> Result<Vec<[u64; N]>, Error> {
    let file = open(source)?;
    let shape = &file.header.shape;
    let [rows, width] = shape[..] else {
        return Err(Error::content(format!("the array has the shape {shape:?}, not (t, {N})")));
    };
    if width != N as u64 {
        return Err(Error::content(format!("the array has the shape [{rows}, {width}], not (t, {N})")));
    }
    let (rows, by_columns) = (rows as usize, file.header.by_columns);
    let index = |value: i128| {
        u64::try_from(value).map_err(|_| Error::content(format!("the array has the negative index {value}")))
    };
    let collect =
        |values: &mut dyn Iterator<Item = _>| values.take(N * rows).collect::<Result<Vec<u64>, Error>>();
    let values = numbers!(file, collect, |value| index(i128::from(value)),
        "i1" i8, "u1" u8, "i2" i16, "u2" u16, "i4" i32, "u4" u32, "i8" i64, "u8" u64)?;
    let at = |row: usize, k: usize| values[if by_columns { k * rows + row } else { N * row + k }];
    Ok((0..rows).map(|row| std::array::from_fn(|k| at(row, k))).collect())
}

/// Writes so many rows of `columns` indices: int64 of shape (count, columns), from 0.
///
/// Half of the time goes to the numbers and half to the system, so they are two threads' work where there are two.
pub(crate) fn write_simplices(
    out: &mut dyn Write,
    count: usize,
    columns: usize,
    rows: impl Iterator<Item: IntoIterator<Item = usize>> + Send,
) -> io::Result<()> {
    header::write(out, "i8", &[count, columns])?;
    let mut rows = rows.fuse();
    let mut block = move || {
        let mut block = Vec::with_capacity(BUFFER);
        for row in rows.by_ref().take(BUFFER / (8 * columns)) {
            row.into_iter().for_each(|i| block.extend_from_slice(&(i as i64).to_le_bytes()));
        }
        (!block.is_empty()).then_some(block)
    };
    if count < BUFFER || rayon::current_num_threads() == 1 {
        return std::iter::from_fn(block).try_for_each(|block| out.write_all(&block));
    }
    let lent = &mut block;
    let by_two = std::thread::scope(|scope| {
        let (ready, blocks) = sync_channel::<Vec<u8>>(4);
        // A writer that fails hangs up.
        let make = move || std::iter::from_fn(lent).all(|block| ready.send(block).is_ok());
        let other = std::thread::Builder::new().spawn_scoped(scope, make);
        other.is_ok().then(|| blocks.iter().try_for_each(|block| out.write_all(&block)))
    });
    // Where there is no second thread, this one does all.
    by_two.unwrap_or_else(|| std::iter::from_fn(block).try_for_each(|block| out.write_all(&block)))
}

pub(crate) fn write_points<const D: usize>(out: &mut dyn Write, points: &[[f64; D]]) -> io::Result<()> {
    let numbers = points.as_flattened().iter().map(|x| x.to_le_bytes());
    write_numbers(out, "f8", &[points.len(), D], numbers)
}

/// Writes rows of integers: int64 of shape (rows, columns).
pub(crate) fn write_indices(out: &mut dyn Write, columns: usize, values: &[i64]) -> io::Result<()> {
    let shape = [values.len() / columns, columns];
    write_numbers(out, "i8", &shape, values.iter().map(|value| value.to_le_bytes()))
}

pub(crate) fn write_index_list(out: &mut dyn Write, values: &[i64]) -> io::Result<()> {
    write_numbers(out, "i8", &[values.len()], values.iter().map(|value| value.to_le_bytes()))
}

/// An array of an archive.
pub(crate) enum Array<'a> {
    /// float64 of one dimension.
    Numbers(&'a [f64]),
    /// int64 in rows of so many columns.
    Indices(usize, &'a [i64]),
}

/// Writes named arrays, each made in memory before.
pub(crate) fn write_archive(out: &mut dyn Write, arrays: &[(&str, Array<'_>)]) -> io::Result<()> {
    let mut archive = stored::Archive::new(out);
    for (name, array) in arrays {
        let mut content = Vec::new();
        match array {
            Array::Numbers(values) => {
                let numbers = values.iter().map(|x| x.to_le_bytes());
                write_numbers(&mut content, "f8", &[values.len()], numbers)?;
            }
            Array::Indices(columns, values) => write_indices(&mut content, *columns, values)?,
        }
        archive.add(&format!("{name}.npy"), &content)?;
    }
    archive.finish()
}

fn write_numbers(
    out: &mut dyn Write,
    kind: &str,
    shape: &[usize],
    mut numbers: impl Iterator<Item = [u8; 8]>,
) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(BUFFER, out);
    header::write(&mut out, kind, shape)?;
    numbers.try_for_each(|bytes| out.write_all(&bytes))?;
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
            write_simplices(&mut bytes, count, 3, rows(count)).expect("room");
            let (header, data) = bytes.split_at(bytes.len() - 24 * count);
            assert!(header.starts_with(b"\x93NUMPY") && header.len() % 64 == 0);
            let numbers = data.as_chunks().0.iter().map(|&bytes| i64::from_le_bytes(bytes));
            assert!(numbers.eq(rows(count).flatten().map(|i| i as i64)), "{count}");
        }
    }

    #[test]
    fn a_full_disk_is_an_error_soon() {
        for room in [0, 100, 24 * BUFFER] {
            let endless = write_simplices(&mut Full(room), 1 << 40, 3, rows(usize::MAX / 8));
            assert_eq!(endless.map_err(|error| error.kind()), Err(io::ErrorKind::StorageFull));
        }
    }
}
