//! NumPy arrays and archives of them: points are numbers of shape (n, 2) or (n, 3), triangles integers of shape (t, 3).

use std::io::{self, BufReader, BufWriter, Cursor, Read, Seek, SeekFrom, Write};
use std::sync::mpsc::sync_channel;

use npyz::{DType, NpyFile, Order, WriterBuilder};
use zip::ZipArchive;

use crate::{Cloud, Error, Source, guard};

/// Numbers are read and written eight bytes at a time: from and to a buffer of a type that the compiler knows, which is ten
/// times faster than from and to one behind a pointer.
const BUFFER: usize = 1 << 18;

/// NumPy itself reads no longer headers.
const LONGEST_HEADER: u64 = 10_000;

type File<R> = NpyFile<BufReader<R>>;

/// Reads the header, after a look at how long it claims to be.
fn open<R: Read + Seek>(mut source: R) -> Result<File<R>, Error> {
    const MAGIC: &[u8] = b"\x93NUMPY";
    let early = |_| Error::Truncated("inside the array's header".to_owned());
    let length = source.seek(SeekFrom::End(0))?;
    source.rewind()?;
    let mut start = [0; 12];
    let magic = source.read_exact(&mut start[..MAGIC.len()]);
    if magic.is_err() || !start.starts_with(MAGIC) {
        return Err(Error::content("no NumPy array: it does not begin as one"));
    }
    source.read_exact(&mut start[MAGIC.len()..10]).map_err(early)?;
    let mut header = 10 + u64::from(u16::from_le_bytes([start[8], start[9]]));
    if start[6] > 1 {
        source.read_exact(&mut start[10..]).map_err(early)?;
        header = 12 + u64::from(u32::from_le_bytes([start[8], start[9], start[10], start[11]]));
    }
    if header > length {
        return Err(Error::Truncated("inside the array's header".to_owned()));
    }
    // What is longer or deeper describes no numbers, and keeps the parser busy for ever.
    let mut text = vec![0; header.min(LONGEST_HEADER) as usize];
    source.rewind()?;
    source.read_exact(&mut text).map_err(early)?;
    if header > LONGEST_HEADER || text.iter().filter(|byte| b"([{".contains(byte)).count() > 8 {
        return Err(Error::content("no NumPy array of numbers: its header is too long or too deep"));
    }
    source.rewind()?;
    let wrong = |error: io::Error| match error.kind() {
        io::ErrorKind::UnexpectedEof => Error::Truncated("inside the array's header".to_owned()),
        _ => Error::content(format!("no NumPy array: {error}")),
    };
    // It multiplies the numbers of a shape without a look at their size.
    let file =
        guard::decode("npy", || NpyFile::new(BufReader::with_capacity(BUFFER, source)).map_err(wrong))?;
    if let ([rows, columns], Some(size)) = (file.shape(), file.dtype().num_bytes()) {
        let row = columns.saturating_mul(size as u64).max(1);
        let complete = (length - header) / row;
        if complete < *rows && *columns > 0 {
            return Err(Error::Truncated(format!("inside row {complete} of {rows}")));
        }
    }
    Ok(file)
}

fn type_name<R: Read>(file: &File<R>) -> String {
    match file.dtype() {
        DType::Plain(plain) => plain.to_string(),
        other => other.descr(),
    }
}

/// Calls `$take` with the numbers of an array, whatever their type, each made another by `$convert`.
macro_rules! numbers {
    ($file:expr, $found:expr, $take:expr, $convert:expr, $($name:literal $from:ty),+) => {
        match $found.trim_start_matches(['<', '>', '|', '=']) {
            $($name => {
                let data = $file.data::<$from>().map_err(|error| Error::content(error.to_string()))?;
                let mut place = 0;
                $take(&mut data.map(|value| {
                    let value = value.map_err(|error| ended(error, place))?;
                    place += 1;
                    $convert(value)
                }))
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
    let shape = file.shape().to_vec();
    let (rows, columns, transposed) = match shape[..] {
        [rows, columns @ (2 | 3)] => (rows as usize, columns as usize, false),
        [columns @ (2 | 3), rows] => (rows as usize, columns as usize, true),
        _ => return Err(Error::content(format!("the array has the shape {shape:?}, not (n, 2) or (n, 3)"))),
    };
    // Point after point, or column after column: all x, all y, all z.
    let by_columns = (file.order() == Order::Fortran) != transposed;
    let found = type_name(&file);
    // The same words serve single and double precision.
    #[allow(clippy::useless_conversion)]
    let mut cloud = if found.contains('f') {
        let take =
            |values: &mut dyn Iterator<Item = Result<f64, Error>>| fill(values, rows, columns, by_columns);
        match found.as_str() {
            // The usual type, for which the compiler sees all of the loop.
            "<f8" => {
                let values = file.data::<f64>().map_err(|error| Error::content(error.to_string()))?;
                fill(values, rows, columns, by_columns)
            }
            _ => numbers!(file, found, take, |value| Ok(f64::from(value)), "f8" f64, "f4" f32),
        }
    } else {
        let take =
            |values: &mut dyn Iterator<Item = Result<f64, Error>>| fill(values, rows, columns, by_columns);
        numbers!(file, found, take, |value| exact(i128::from(value)),
            "i1" i8, "u1" u8, "i2" i16, "u2" u16, "i4" i32, "u4" u32, "i8" i64, "u8" u64)
    }?;
    if transposed {
        cloud.remarks.push(format!("the array of shape ({columns}, {rows}) was taken as {rows} points"));
    }
    Ok(cloud)
}

/// Points from the numbers of an array.
fn fill<E: Into<Error>>(
    mut values: impl Iterator<Item = Result<f64, E>>,
    rows: usize,
    columns: usize,
    by_columns: bool,
) -> Result<Cloud, Error> {
    let mut next = || match values.next() {
        Some(value) => value.map_err(Into::into),
        None => Err(Error::Truncated("inside the numbers".to_owned())),
    };
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
pub(crate) fn read_archive(source: Box<dyn Source>) -> Result<Cloud, Error> {
    const NAMES: [&str; 7] = ["points", "pts", "xy", "xyz", "coords", "coordinates", "vertices"];
    let broken = |error: zip::result::ZipError| Error::content(format!("no NumPy archive: {error}"));
    let mut archive = ZipArchive::new(source).map_err(broken)?;
    let mut arrays = Vec::new();
    let mut names = Vec::new();
    for i in 0..archive.len() {
        let mut entry = archive.by_index(i).map_err(broken)?;
        let name = entry.name().map_err(broken)?.trim_end_matches(".npy").to_owned();
        let mut bytes = Vec::new();
        entry.read_to_end(&mut bytes)?;
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

/// Reads rows of N indices.
pub(crate) fn read_simplices<const N: usize>(source: Box<dyn Source>) -> Result<Vec<[u64; N]>, Error> {
    let file = open(source)?;
    let [rows, width] = file.shape()[..] else {
        return Err(Error::content(format!("the array has the shape {:?}, not (t, {N})", file.shape())));
    };
    if width != N as u64 {
        return Err(Error::content(format!("the array has the shape [{rows}, {width}], not (t, {N})")));
    }
    let (rows, order) = (rows as usize, file.order());
    let index = |value: i128| {
        u64::try_from(value).map_err(|_| Error::content(format!("the array has the negative index {value}")))
    };
    let found = type_name(&file);
    let collect = |values: &mut dyn Iterator<Item = _>| values.collect::<Result<Vec<u64>, Error>>();
    let values = numbers!(file, found, collect, |value| index(i128::from(value)),
        "i1" i8, "u1" u8, "i2" i16, "u2" u16, "i4" i32, "u4" u32, "i8" i64, "u8" u64)?;
    let at = |row: usize, k: usize| match order {
        Order::C => values[N * row + k],
        Order::Fortran => values[k * rows + row],
    };
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
    let mut header = Vec::new();
    let options = npyz::WriteOptions::<i64>::new().default_dtype().shape(&[count as u64, columns as u64]);
    options.writer(&mut header).write_header_only()?;
    out.write_all(&header)?;
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
