//! The coordinate reference system of a LAS file: well-known text, or GeoTIFF keys, in its variable length records. Extended ones may also
//! describe extra bytes.

use std::io::{Read, Seek, SeekFrom};

use las::raw::header::Evlr;
use las::{Builder, Vlr};

use super::dimensions;
use crate::crs::keys::decode;
use crate::{Crs, Error, Source};

/// Who the records about coordinates belong to, and their numbers.
const OWNER: &str = "LASF_Projection";
const KEYS: u16 = 34_735;
const DOUBLES: u16 = 34_736;
const TEXTS: u16 = 34_737;
const WELL_KNOWN_TEXT: u16 = 2_112;

/// Bytes of an extended record before its content.
const HEAD: u64 = 60;

/// Reads the extended records about coordinates and about extra bytes, and steps over the others, which may be as long as the points.
pub(super) fn read_extended(
    source: &mut Box<dyn Source>,
    records: Evlr,
    length: u64,
    about: &mut Builder,
) -> Result<(), Error> {
    let mut at = records.start_of_first_evlr;
    for i in 0..records.number_of_evlrs {
        let end = || Error::Truncated(format!("inside extended record {i} of {}", records.number_of_evlrs));
        if at.checked_add(HEAD).is_none_or(|content| content > length) {
            return Err(end());
        }
        source.seek(SeekFrom::Start(at))?;
        let mut head = [0; HEAD as usize];
        source.read_exact(&mut head)?;
        let mut size = [0; 8];
        size.copy_from_slice(&head[20..28]);
        let size = u64::from_le_bytes(size);
        let next = (at + HEAD).checked_add(size).filter(|&next| next <= length).ok_or_else(end)?;
        let record_id = u16::from_le_bytes([head[18], head[19]]);
        let is_of = |owner: &str| head[2..18].starts_with(owner.as_bytes());
        let is_extra = is_of(dimensions::OWNER) && record_id == dimensions::EXTRA_BYTES;
        if is_of(OWNER) || is_extra {
            let mut data = vec![0; size as usize];
            source.read_exact(&mut data)?;
            let user_id = if is_extra { dimensions::OWNER } else { OWNER }.to_owned();
            about.vlrs.push(Vlr { user_id, record_id, description: String::new(), data });
        }
        at = next;
    }
    Ok(())
}

/// The system that records name.
pub(super) fn find(records: &[Vlr]) -> Option<Crs> {
    let content = |id: u16| {
        let mut ours = records.iter().filter(|record| record.user_id == OWNER);
        ours.find(|record| record.record_id == id).map(|record| record.data.as_slice())
    };
    let text = content(WELL_KNOWN_TEXT).map(String::from_utf8_lossy);
    text.and_then(|text| Crs::of_wkt(&text)).or_else(|| {
        of_keys(content(KEYS)?, content(DOUBLES).unwrap_or_default(), content(TEXTS).unwrap_or_default())
    })
}

/// The system that GeoTIFF keys name.
fn of_keys(keys: &[u8], doubles: &[u8], texts: &[u8]) -> Option<Crs> {
    let numbers: Vec<u16> = keys.as_chunks().0.iter().map(|&pair| u16::from_le_bytes(pair)).collect();
    let doubles: Vec<f64> = doubles.as_chunks().0.iter().map(|&word| f64::from_le_bytes(word)).collect();
    decode(&numbers, &doubles, texts)
}

#[cfg(test)]
mod tests {
    use super::{KEYS, OWNER, TEXTS, find};
    use las::Vlr;

    fn record(record_id: u16, data: Vec<u8>) -> Vlr {
        Vlr { user_id: OWNER.to_owned(), record_id, description: String::new(), data }
    }

    fn words(numbers: &[u16]) -> Vec<u8> {
        numbers.iter().flat_map(|n| n.to_le_bytes()).collect()
    }

    #[test]
    fn keys_name_a_system() {
        let keys = words(&[1, 1, 0, 3, 1024, 0, 1, 1, 3072, 0, 1, 25832, 3073, TEXTS, 9, 2]);
        let system = find(&[record(KEYS, keys), record(TEXTS, b"..UTM 32N|\0".to_vec())]);
        assert_eq!(system.expect("a system").to_string(), "EPSG:25832 (UTM 32N)");
        assert_eq!(find(&[]), None);
        // Keys that point beyond their texts, and too few of them.
        let beyond = words(&[1, 1, 0, 9, 3073, TEXTS, 60_000, 60_000, 3072]);
        assert_eq!(find(&[record(KEYS, beyond)]), None);
    }
}
