//! The GeoTIFF keys of a system (OGC 19-008r4), which LAS and GeoTIFF have in common.
//!
//! A projected system is in key 3072, a geographic one in 2048, heights are in 4096: never a number of both in one key, which
//! no reader understands.

use super::units::of_unit;
use super::{Crs, GeoKeys, codes};

/// The keys, by number: what the model is, whether cells are areas, names, systems.
const MODEL: u16 = 1_024;
const RASTER: u16 = 1_025;
const NAME: u16 = 1_026;
const GEOGRAPHIC: u16 = 2_048;
const GEOGRAPHIC_NAME: u16 = 2_049;
const PROJECTED: u16 = 3_072;
const PROJECTED_NAME: u16 = 3_073;
const VERTICAL: u16 = 4_096;

/// The tags, and the records of LAS, that numbers with fractions and texts of keys are in.
const DOUBLES: u16 = 34_736;
const TEXTS: u16 = 34_737;

/// The key's value for a system without a number.
const OWN: u16 = 32_767;

/// The system that keys name, entries of four numbers after a head of four. A projected system wins over a geographic one, which is the base
/// of it: where the projected one has no number, neither has the system.
pub(crate) fn decode(numbers: &[u16], doubles: &[f64], texts: &[u8]) -> Option<Crs> {
    let number = |key| {
        let found = entry(numbers, key).filter(|e| e[1] == 0 && e[3] != 0 && e[3] != OWN);
        found.map(|e| u32::from(e[3]))
    };
    let name = |key| {
        let [_, _, count, at] = entry(numbers, key).filter(|e| e[1] == TEXTS)?;
        let text = texts.get(usize::from(at)..)?.get(..usize::from(count))?;
        let text = String::from_utf8_lossy(text);
        let text = text.trim_matches(['\0', '|', ' ']);
        (!text.is_empty()).then(|| text.to_owned())
    };
    let model = entry(numbers, MODEL).map(|e| e[3]);
    let is_projected = entry(numbers, PROJECTED).is_some() || model == Some(1);
    let geographic = number(GEOGRAPHIC).filter(|_| !is_projected);
    let epsg = number(PROJECTED).or(geographic);
    let name = [PROJECTED_NAME, NAME, GEOGRAPHIC_NAME].into_iter().find_map(name);
    let is_geographic = match (is_projected, geographic, model) {
        (true, _, _) => Some(false),
        (false, Some(_), _) | (false, None, Some(2)) => Some(true),
        _ => None,
    };
    let vertical = number(VERTICAL);
    (epsg.is_some() || name.is_some() || vertical.is_some()).then_some(Crs {
        epsg,
        name,
        vertical,
        is_geographic,
        wkt: None,
        keys: if epsg.is_none() { own(numbers, doubles, texts) } else { None },
    })
}

/// The keys of a system that has no number, if all that they point to is there.
fn own(numbers: &[u16], doubles: &[f64], texts: &[u8]) -> Option<Box<GeoKeys>> {
    let (&[version, revision, minor, count], entries) = numbers.split_first_chunk::<4>()?;
    let entries = entries.as_chunks::<4>().0.get(..usize::from(count))?;
    let is_there = |&[_, place, count, at]: &[u16; 4]| {
        let end = usize::from(at) + usize::from(count);
        match place {
            0 => true,
            DOUBLES => end <= doubles.len(),
            TEXTS => end <= texts.len(),
            _ => false,
        }
    };
    let defines = entries.iter().any(|entry| entry[1] == DOUBLES);
    // One more is written.
    let has_room = count < u16::MAX;
    (defines && has_room && entries.iter().all(is_there) && texts.is_ascii()).then(|| {
        Box::new(GeoKeys {
            numbers: [version, revision, minor, count]
                .into_iter()
                .chain(entries.iter().flatten().copied())
                .collect(),
            doubles: doubles.iter().map(|number| number.to_bits()).collect(),
            texts: String::from_utf8_lossy(texts).trim_end_matches('\0').to_owned(),
        })
    })
}

impl GeoKeys {
    /// The metres of a unit of length: by its number in one key, or its size in another.
    pub(super) fn metres(&self, unit: u16, size: u16) -> Option<f64> {
        let sized = || {
            let entry = entry(&self.numbers, size).filter(|entry| entry[1] == DOUBLES)?;
            let metres = f64::from_bits(*self.doubles.get(usize::from(entry[3]))?);
            (metres > 0.0 && metres.is_finite()).then_some(metres)
        };
        let named = || of_unit(entry(&self.numbers, unit).filter(|entry| entry[1] == 0)?[3]);
        named().or_else(sized)
    }
}

/// Keys as they are, of a raster whose cells are areas.
fn passed_on(own: &GeoKeys) -> Keys {
    let (head, entries) = own.numbers.split_first_chunk::<4>().unwrap_or((&[1, 1, 0, 0], &[]));
    let mut entries: Vec<[u16; 4]> = entries.as_chunks::<4>().0.to_vec();
    entries.retain(|entry| entry[0] != RASTER);
    entries.push([RASTER, 0, 1, 1]);
    entries.sort_by_key(|entry| entry[0]);
    let head = [head[0], head[1], head[2], entries.len() as u16];
    let numbers = head.into_iter().chain(entries.into_iter().flatten()).collect();
    let doubles = own.doubles.iter().map(|&bits| f64::from_bits(bits)).collect();
    Keys { numbers, doubles, texts: own.texts.clone(), are_complete: true }
}

/// Whether the points of a raster are the centers of its cells, and not their corners.
pub(crate) fn is_point(numbers: &[u16]) -> bool {
    entry(numbers, RASTER).is_some_and(|e| e[3] == 2)
}

fn entry(numbers: &[u16], key: u16) -> Option<[u16; 4]> {
    let (_, entries) = numbers.split_first_chunk::<4>()?;
    entries.as_chunks::<4>().0.iter().find(|entry| entry[0] == key).copied()
}

/// The keys of a raster whose cells are areas.
#[derive(Debug, PartialEq)]
pub(crate) struct Keys {
    pub(crate) numbers: Vec<u16>,
    pub(crate) doubles: Vec<f64>,
    pub(crate) texts: String,
    /// Whether the keys say all of the system.
    pub(crate) are_complete: bool,
}

/// The keys of a system; none where none is known, because readers take keys without a system for one of their own.
pub(crate) fn encode(crs: Option<&Crs>) -> Keys {
    let mut keys =
        Keys { numbers: Vec::new(), doubles: Vec::new(), texts: String::new(), are_complete: true };
    let Some(crs) = crs else { return keys };
    if let (None, Some(own)) = (crs.epsg, &crs.keys) {
        return passed_on(own);
    }
    let code =
        |number: Option<u32>| number.and_then(|n| u16::try_from(n).ok()).filter(|&n| n != 0 && n != OWN);
    let epsg = code(crs.epsg.filter(|&epsg| !codes::is_compound(epsg)));
    let vertical = code(crs.vertical);
    let is_geographic = crs.is_geographic.or_else(|| epsg.map(|n| codes::is_geographic(n.into())));
    keys.are_complete = epsg.is_some() && vertical.map(u32::from) == crs.vertical;
    match is_geographic {
        Some(true) => keys.number(MODEL, 2),
        Some(false) => keys.number(MODEL, 1),
        None => keys.number(MODEL, OWN),
    }
    keys.number(RASTER, 1);
    let title = crs.name.clone().or_else(|| crs.epsg.map(|number| format!("EPSG:{number}")));
    let title = title.filter(|_| epsg.is_none());
    if let Some(title) = &title {
        keys.text(NAME, title);
    }
    match is_geographic {
        Some(true) => keys.number(GEOGRAPHIC, epsg.unwrap_or(OWN)),
        Some(false) => keys.number(PROJECTED, epsg.unwrap_or(OWN)),
        None => {}
    }
    if let (Some(title), Some(false)) = (&title, is_geographic) {
        keys.text(PROJECTED_NAME, title);
    }
    if let Some(vertical) = vertical {
        keys.number(VERTICAL, vertical);
    }
    keys.with_head()
}

impl Keys {
    fn number(&mut self, key: u16, value: u16) {
        self.numbers.extend([key, 0, 1, value]);
    }

    fn text(&mut self, key: u16, text: &str) {
        let at = self.texts.len();
        // ASCII, and the bar is what ends a text.
        self.texts
            .extend(text.chars().take(200).map(|c| if c.is_ascii_graphic() && c != '|' { c } else { ' ' }));
        self.texts.push('|');
        self.numbers.extend([key, TEXTS, (self.texts.len() - at) as u16, at as u16]);
    }

    fn with_head(mut self) -> Self {
        let count = self.numbers.len() / 4;
        self.numbers.splice(0..0, [1, 1, 0, count as u16]);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::{Crs, decode, encode, is_point};

    #[test]
    fn systems_come_back_from_their_keys() {
        let compound = Crs { vertical: Some(7837), ..Crs::of_epsg(25832) };
        for crs in [Crs::of_epsg(25832), Crs::of_epsg(4326), compound] {
            let keys = encode(Some(&crs));
            assert!(keys.are_complete);
            assert_eq!(decode(&keys.numbers, &keys.doubles, keys.texts.as_bytes()), Some(crs));
            assert!(!is_point(&keys.numbers));
            let order: Vec<u16> = keys.numbers[4..].iter().step_by(4).copied().collect();
            assert!(order.is_sorted(), "{order:?}");
        }
        let keys = encode(None);
        assert_eq!((decode(&keys.numbers, &[], &[]), keys.numbers.len()), (None, 0));
    }

    #[test]
    fn what_has_no_number_has_a_name() {
        let ours = Crs::of_wkt("PROJCS[\"our|s \u{e9}\",UNIT[\"metre\",1]]").expect("a system");
        let keys = encode(Some(&ours));
        assert!(!keys.are_complete);
        let read = decode(&keys.numbers, &keys.doubles, keys.texts.as_bytes()).expect("a system");
        assert_eq!((read.name.as_deref(), read.is_geographic), (Some("our s"), Some(false)));
        // A number of two systems fits no key.
        let keys = encode(Some(&Crs::of_epsg(7405)));
        assert!(!keys.are_complete && !keys.numbers.contains(&7405));
        assert_eq!(
            decode(&keys.numbers, &keys.doubles, keys.texts.as_bytes()).expect("one").name.as_deref(),
            Some("EPSG:7405")
        );
    }

    #[test]
    fn a_projected_system_wins() {
        let numbers = [1, 1, 0, 3, 2048, 0, 1, 4258, 3072, 0, 1, 25832, 4096, 0, 1, 5783];
        let crs = decode(&numbers, &[], &[]).expect("a system");
        assert_eq!((crs.epsg, crs.vertical, crs.is_geographic), (Some(25832), Some(5783), Some(false)));
    }

    /// As GDAL writes Albers' projection of the United States, ESRI:102003.
    #[test]
    fn the_base_of_a_projected_system_is_not_the_system() {
        let numbers = [
            1, 1, 0, 6, 1024, 0, 1, 1, 1026, 34737, 7, 0, 2048, 0, 1, 4269, 3072, 0, 1, 32767, 3075, 0, 1,
            11, 3078, 34736, 1, 0,
        ];
        let crs = decode(&numbers, &[29.5], b"Albers|").expect("a system");
        assert_eq!((crs.epsg, crs.name.as_deref(), crs.is_geographic), (None, Some("Albers"), Some(false)));
        let keys = encode(Some(&crs));
        assert!(keys.are_complete && keys.doubles == [29.5]);
    }

    #[test]
    fn keys_without_a_number_are_passed_on() {
        let numbers = [
            1, 1, 0, 5, 1024, 0, 1, 1, 1026, 34737, 4, 0, 3072, 0, 1, 32767, 3078, 34736, 1, 1, 3079, 34736,
            1, 0,
        ];
        let crs = decode(&numbers, &[0.3048, 45.5], b"own|").expect("a system");
        assert_eq!((crs.epsg, crs.name.as_deref(), crs.is_geographic), (None, Some("own"), Some(false)));
        let keys = encode(Some(&crs));
        assert!(keys.are_complete && keys.numbers[3] == 6 && keys.doubles == [0.3048, 45.5]);
        assert!(keys.numbers[4..].chunks(4).is_sorted_by_key(|entry| entry[0]));
        let again = decode(&keys.numbers, &keys.doubles, keys.texts.as_bytes()).expect("a system");
        assert_eq!(encode(Some(&again)), keys);
        // What keys point to must be there.
        assert_eq!(decode(&numbers, &[0.3048], b"own|").expect("a name").keys, None);
    }
}
