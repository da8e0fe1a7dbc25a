//! The header of a LAS file and the record about compression, each length compared with the file.
//!
//! Source: ASPRS, "LAS specification 1.4 - R15", tables 3 and 4.

use crate::Fault;

/// Bytes of a record by format, without what a writer adds.
const SIZES: [usize; 11] = [20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67];
/// More points than a byte can hold, however well they are compressed: a file that claims them lies.
const POINTS_A_BYTE: u64 = 4096;
/// Before the data of a record of variable length.
const RECORD_HEAD: usize = 54;

/// The part of a header that is needed.
pub struct Header {
    /// Where points begin.
    pub start: usize,
    pub total: u64,
    /// Bytes of a point.
    pub record: usize,
    /// Whether the class has a byte of its own, as in formats from 6 on.
    pub wide: bool,
    pub scale: [f64; 3],
    pub offset: [f64; 3],
    /// The data of the record about compression, if points are compressed.
    pub laszip: Option<Vec<u8>>,
}

/// `N` bytes from a place on.
pub fn bytes<const N: usize>(file: &[u8], at: usize) -> Result<[u8; N], Fault> {
    let end = at.checked_add(N).ok_or(Fault::Truncated)?;
    file.get(at..end).and_then(|bytes| bytes.try_into().ok()).ok_or(Fault::Truncated)
}

fn short(file: &[u8], at: usize) -> Result<usize, Fault> {
    Ok(u16::from_le_bytes(bytes(file, at)?).into())
}

fn word(file: &[u8], at: usize) -> Result<usize, Fault> {
    Ok(u32::from_le_bytes(bytes(file, at)?) as usize)
}

impl Header {
    pub fn read(file: &[u8]) -> Result<Self, Fault> {
        if file.get(..4).is_some_and(|magic| magic != b"LASF") || file.is_empty() {
            return Err(Fault::NoLas);
        }
        let [minor] = bytes(file, 25)?;
        let (first_record, start, records) = (short(file, 94)?, word(file, 96)?, word(file, 100)?);
        let [format] = bytes(file, 104)?;
        let (record, mut total) = (short(file, 105)?, word(file, 107)? as u64);
        if minor >= 4 {
            // What this field counts holds; a writer that left it empty has used the smaller one.
            let count = u64::from_le_bytes(bytes(file, 247)?);
            total = if count > 0 { count } else { total };
        }
        let number = |at| Ok(f64::from_le_bytes(bytes(file, at)?));
        let scale = [number(131)?, number(139)?, number(147)?];
        let offset = [number(155)?, number(163)?, number(171)?];
        let id = usize::from(format & 0x3f);
        let size = *SIZES.get(id).ok_or(Fault::Unsupported)?;
        if start > file.len() {
            return Err(Fault::Truncated);
        }
        if record < size || first_record > start || !scale.iter().chain(&offset).all(|x| x.is_finite()) {
            return Err(Fault::Damaged);
        }
        let room = (file.len() - start) as u64;
        let is_compressed = format & 0x80 != 0;
        let fits = if is_compressed { room.saturating_mul(POINTS_A_BYTE) } else { room / record as u64 };
        if total > fits {
            return Err(Fault::Truncated);
        }
        let laszip = if is_compressed { Some(laszip(&file[..start], first_record, records)?) } else { None };
        Ok(Self { start, total, record, wide: id >= 6, scale, offset, laszip })
    }
}

/// The data of the record about compression.
fn laszip(head: &[u8], mut at: usize, records: usize) -> Result<Vec<u8>, Fault> {
    for _ in 0..records {
        let length = short(head, at + 20)?;
        let end = at + RECORD_HEAD + length;
        let data = head.get(at + RECORD_HEAD..end).ok_or(Fault::Damaged)?;
        let user = &head[at + 2..at + 18];
        if user.starts_with(laz::LazVlr::USER_ID.as_bytes())
            && short(head, at + 18)? == laz::LazVlr::RECORD_ID.into()
        {
            return Ok(data.to_vec());
        }
        at = end;
    }
    Err(Fault::Damaged)
}
