//! Points of an array, some rows at a time, wherever in the file their numbers are.

use std::io::{Read, Seek, SeekFrom};

use super::header::Header;
use super::{ended, exact, shape_of_points};
use crate::chunks::Chunks;
use crate::{Cloud, Error, Source};

/// Rows that are read at a time where nobody says.
const ROWS: usize = 1 << 16;

/// Reads points of shape (n, 2) or (n, 3), or transposed, in chunks.
pub(crate) fn read_in(mut source: Box<dyn Source>, chunks: &mut Chunks) -> Result<Cloud, Error> {
    let header = Header::read(&mut source)?;
    let start = source.stream_position()?;
    let (rows, columns, transposed) = shape_of_points(&header.shape)?;
    let by_columns = header.by_columns != transposed;
    let mut blocks = Blocks { source, start, size: size_of_number(&header.kind)?, header };
    let mut cloud = Cloud::with_capacity(0, columns == 3);
    let most = chunks.most().min(ROWS);
    let mut first = 0;
    while first < rows {
        let count = most.min(rows - first);
        if by_columns {
            let mut numbers = [Vec::new(), Vec::new(), Vec::new()];
            for (k, column) in numbers.iter_mut().enumerate().take(columns) {
                *column = blocks.read(k * rows + first, count)?;
            }
            let [x, y, z] = numbers;
            cloud.xy.extend(x.into_iter().zip(y).map(|(x, y)| [x, y]));
            cloud.z.iter_mut().for_each(|heights| heights.extend_from_slice(&z));
        } else {
            let numbers = blocks.read(columns * first, columns * count)?;
            for row in numbers.chunks_exact(columns) {
                cloud.push([row[0], row[1]], row[columns - 1]);
            }
        }
        first += count;
        chunks.offer(&mut cloud)?;
    }
    if transposed {
        cloud.remarks.push(format!("the array of shape ({columns}, {rows}) was taken as {rows} points"));
    }
    Ok(cloud)
}

fn size_of_number(kind: &str) -> Result<usize, Error> {
    match kind {
        "f8" | "i8" | "u8" => Ok(8),
        "f4" | "i4" | "u4" => Ok(4),
        "i2" | "u2" => Ok(2),
        "i1" | "u1" => Ok(1),
        found => Err(Error::content(format!("the array is of type {found}, which is not read here"))),
    }
}

/// The numbers of an array.
struct Blocks {
    source: Box<dyn Source>,
    /// Where the first one is, and how many bytes each has.
    start: u64,
    size: usize,
    header: Header,
}

impl Blocks {
    /// `count` numbers from one on.
    fn read(&mut self, first: usize, count: usize) -> Result<Vec<f64>, Error> {
        self.source.seek(SeekFrom::Start(self.start + (first as u64) * (self.size as u64)))?;
        let mut bytes = vec![0; count * self.size];
        self.source.read_exact(&mut bytes).map_err(|error| ended(error, first))?;
        macro_rules! decoded {
            ($number:ty, $convert:expr) => {{
                let decode =
                    if self.header.is_big { <$number>::from_be_bytes } else { <$number>::from_le_bytes };
                bytes.as_chunks().0.iter().map(|&number| $convert(decode(number))).collect()
            }};
        }
        match &*self.header.kind {
            "f8" => decoded!(f64, Ok),
            "f4" => decoded!(f32, |x| Ok(f64::from(x))),
            "i8" => decoded!(i64, |x| exact(i128::from(x))),
            "u8" => decoded!(u64, |x| exact(i128::from(x))),
            "i4" => decoded!(i32, |x| Ok(f64::from(x))),
            "u4" => decoded!(u32, |x| Ok(f64::from(x))),
            "i2" => decoded!(i16, |x| Ok(f64::from(x))),
            "u2" => decoded!(u16, |x| Ok(f64::from(x))),
            "i1" => decoded!(i8, |x| Ok(f64::from(x))),
            _ => decoded!(u8, |x| Ok(f64::from(x))),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::super::{header, read_points};
    use super::read_in;
    use crate::chunks::Chunks;

    /// Every type, order of bytes and order of numbers, against the reader of whole arrays.
    #[test]
    fn blocks_are_the_array() {
        let kinds = ["f8", "f4", "i8", "u8", "i4", "u4", "i2", "u2", "i1", "u1"];
        for (kind, size) in kinds.into_iter().zip([8, 4, 8, 8, 4, 4, 2, 2, 1, 1]) {
            for shape in [[5, 2], [5, 3], [2, 5], [3, 7], [2, 3], [0, 3]] {
                for order in ["<", ">"] {
                    for fortran in ["False", "True"] {
                        let mut bytes = Vec::new();
                        header::write(&mut bytes, kind, &shape).expect("written");
                        let text = String::from_utf8_lossy(&bytes[10..]).into_owned();
                        let text = text.replace('<', order).replace("False", fortran);
                        let mut bytes =
                            [&bytes[..8], &(text.len() as u16).to_le_bytes(), text.as_bytes()].concat();
                        // Small whole numbers of any type, or floating point with some bits.
                        let numbers = shape[0] * shape[1] * size;
                        bytes
                            .extend((0..numbers).map(|i| if i % size < 2 { (i * 7 % 100) as u8 } else { 0 }));
                        let whole = read_points(Cursor::new(bytes.clone())).expect("valid");
                        let mut found = Vec::new();
                        let mut z = Vec::new();
                        let mut take = |points: &[[f64; 2]], heights: Option<&[f64]>| {
                            found.extend_from_slice(points);
                            z.extend(heights.into_iter().flatten().copied());
                            Ok(())
                        };
                        let rest = read_in(Box::new(Cursor::new(bytes)), &mut Chunks(Some((2, &mut take))));
                        let rest = rest.expect("valid");
                        found.extend(&rest.xy);
                        z.extend(rest.z.iter().flatten());
                        assert_eq!(
                            (found, rest.remarks),
                            (whole.xy, whole.remarks),
                            "{kind} {shape:?} {text}"
                        );
                        assert_eq!(z, whole.z.unwrap_or_default());
                    }
                }
            }
        }
    }
}
