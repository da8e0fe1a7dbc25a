//! Arrays of the types that files of tiles have, written as they come.

use std::io::{self, BufWriter, Write};

use super::{BUFFER, header};

/// A number of an array.
pub trait Element: Copy {
    /// Its type as NumPy calls it.
    #[doc(hidden)]
    const KIND: &'static str;
    /// Its bytes, the least first.
    #[doc(hidden)]
    fn put(self, out: &mut impl Write) -> io::Result<()>;
}

macro_rules! elements {
    ($($number:ty = $kind:literal),+) => { $(
        impl Element for $number {
            const KIND: &'static str = $kind;

            fn put(self, out: &mut impl Write) -> io::Result<()> {
                out.write_all(&self.to_le_bytes())
            }
        }
    )+ };
}

elements! { f64 = "f8", u32 = "u4", u64 = "u8" }

/// Writes a NumPy array of a shape, given its numbers row by row, as many as the shape says: f64, u32 or u64.
///
/// ```
/// let mut bytes = Vec::new();
/// delone_io::write_array(&mut bytes, &[2, 3], [0_u32, 1, 2, 2, 1, 3])?;
/// assert_eq!(bytes.len(), 128 + 24);
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn write_array<T: Element>(
    out: &mut dyn Write,
    shape: &[usize],
    numbers: impl IntoIterator<Item = T>,
) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(BUFFER, out);
    header::write(&mut out, T::KIND, shape)?;
    numbers.into_iter().try_for_each(|number| number.put(&mut out))?;
    out.flush()
}
