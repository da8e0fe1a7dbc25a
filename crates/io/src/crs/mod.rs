//! Coordinate reference systems: what a file says its coordinates mean. They are passed on, not transformed.

mod codes;
pub(crate) mod esri;
pub(crate) mod keys;
#[cfg(feature = "parquet")]
mod projjson;
mod registry;
mod units;

use std::fmt;

/// A coordinate reference system, as far as a file names it.
///
/// Fields may be added: a literal ends with `..` and a value to take the rest from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Crs {
    /// Its number in the EPSG registry; of a compound system the number of the horizontal part.
    pub epsg: Option<u32>,
    /// Its name.
    pub name: Option<String>,
    /// Its definition as well-known text.
    pub wkt: Option<String>,
    /// The number of the system of heights in the EPSG registry, where one is named.
    pub vertical: Option<u32>,
    /// Its definition as GeoTIFF keys, where these alone have it: they have no number for it.
    pub keys: Option<Box<GeoKeys>>,
    /// Whether the axes are longitude and latitude, where the file says so or its number tells.
    pub is_geographic: Option<bool>,
}

/// A system as GeoTIFF keys: in LAS files and GeoTIFF, passed on key by key.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GeoKeys {
    /// Entries of four numbers after a head of four.
    pub(crate) numbers: Vec<u16>,
    /// The bits of the numbers with fractions that entries point to.
    pub(crate) doubles: Vec<u64>,
    /// The texts that entries point to.
    pub(crate) texts: String,
}

/// How well-known text begins the systems that are projected, the others that have two horizontal axes, and those of heights.
const PROJECTED: [&str; 2] = ["PROJCS[", "PROJCRS["];
const GEOGRAPHIC: [&str; 3] = ["GEOGCS[", "GEOGCRS[", "GEODCRS["];
const LOCAL: &str = "LOCAL_CS[";
const VERTICAL: [&str; 4] = ["VERT_CS[", "VERTCRS[", "VERTICALCRS[", "VERTCS["];
/// How the names of systems of two parts begin.
const PARTS: &str = "urn:ogc:def:crs,";

impl Crs {
    /// A system by its number.
    ///
    /// ```
    /// use delone_io::Crs;
    ///
    /// assert_eq!(Crs::of_epsg(25832).is_geographic, Some(false));
    /// assert_eq!(Crs::of_epsg(4326).is_geographic, Some(true));
    /// ```
    pub fn of_epsg(epsg: u32) -> Self {
        let is_geographic = (!codes::is_compound(epsg)).then(|| codes::is_geographic(epsg));
        Self { epsg: Some(epsg), is_geographic, ..Self::default() }
    }

    /// A system by well-known text, version 1 or 2; of a compound system the name and number of the horizontal part, and the
    /// number of the vertical one. Where there is a projected system and a geographic one, the projected one is meant.
    ///
    /// ```
    /// use delone_io::Crs;
    ///
    /// let text = r#"COMPD_CS["both",PROJCS["UTM 32N",AUTHORITY["EPSG","25832"]],VERT_CS["DHHN2016",AUTHORITY["EPSG","7837"]]]"#;
    /// let crs = Crs::of_wkt(text).expect("a system");
    /// assert_eq!((crs.epsg, crs.vertical, crs.is_geographic), (Some(25832), Some(7837), Some(false)));
    /// ```
    pub fn of_wkt(text: &str) -> Option<Self> {
        let text = text.trim_matches(|c: char| c == '\0' || c.is_whitespace());
        let first = |names: &[&str]| names.iter().filter_map(|name| text.find(name)).min();
        let (start, is_geographic) = first(&PROJECTED)
            .map(|at| (at, Some(false)))
            .or_else(|| first(&GEOGRAPHIC).map(|at| (at, Some(true))))
            .or_else(|| first(&[LOCAL]).map(|at| (at, None)))?;
        let part = bracketed(&text[start..]);
        let name = part.split('"').nth(1).filter(|name| !name.is_empty()).map(str::to_owned);
        let vertical = first(&VERTICAL).and_then(|at| own_number(bracketed(&text[at..])));
        Some(Self {
            epsg: own_number(part),
            name,
            wkt: Some(text.to_owned()),
            keys: None,
            vertical,
            is_geographic,
        })
    }

    /// The system of which a file gives a number, a definition or both. The definition of a compound system tells the number of its
    /// horizontal part better.
    pub(crate) fn of_both(number: Option<u32>, definition: Option<Self>) -> Option<Self> {
        match definition {
            Some(crs) => Some(Self { epsg: crs.epsg.or(number), ..crs }),
            None => number.map(Self::of_epsg),
        }
    }

    /// The system that a name such as `EPSG:25832`, `EPSG:25832+7837` (with heights) `urn:ogc:def:crs:EPSG::25832` or
    /// `urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::7837` stands for; or well-known text, which some files have as a name.
    pub fn of_name(name: &str) -> Option<Self> {
        let name = name.trim();
        if name.is_empty() {
            return None;
        }
        if name.contains('[') {
            return Self::of_wkt(name);
        }
        if name.to_ascii_uppercase().contains("EPSG") {
            let number = |text: &str| text.rsplit([':', '/']).next()?.parse().ok();
            let parts = name.split_once(PARTS).and_then(|(_, parts)| parts.split_once(','));
            let (horizontal, vertical) = parts.or_else(|| name.rsplit_once('+')).unwrap_or((name, ""));
            let horizontal = number(horizontal).map(Self::of_epsg)?;
            return Some(Self { vertical: number(vertical), ..horizontal });
        }
        match name.rsplit(':').next() {
            Some("CRS84") => Some(Self { name: Some("OGC:CRS84".to_owned()), ..Self::default() }),
            _ => Some(Self { name: Some(name.to_owned()), ..Self::default() }),
        }
    }

    /// Whether it is the same horizontal system as another one, as far as both say: by their numbers, or else by all that is known of them.
    /// Longitude and latitude of WGS 84 have two names.
    ///
    /// ```
    /// use delone_io::Crs;
    ///
    /// let named = Crs { name: Some("ETRS89 / UTM zone 32N".to_owned()), ..Crs::of_epsg(25832) };
    /// assert!(named.agrees(&Crs::of_epsg(25832)));
    /// assert!(!named.agrees(&Crs::of_epsg(25833)));
    /// ```
    pub fn agrees(&self, other: &Self) -> bool {
        match (self.epsg, other.epsg) {
            (Some(ours), Some(theirs)) => {
                // Of a compound system, one file says its number, and another one that of its horizontal part.
                let is_part = self.is_compound() != other.is_compound() && self.name.is_some();
                ours == theirs || is_part && self.name == other.name
            }
            _ if self.is_plain_degrees() && other.is_plain_degrees() => true,
            (None, None) => self.name == other.name && (self.wkt == other.wkt || self.keys == other.keys),
            // Who names one by its number and who defines it otherwise may mean one system.
            _ => {
                self.is_geographic.is_none()
                    || other.is_geographic.is_none()
                    || self.is_geographic == other.is_geographic
            }
        }
    }

    /// Whether its coordinates are surely longitude and latitude.
    ///
    /// ```
    /// use delone_io::Crs;
    ///
    /// let named = Crs::of_name("urn:ogc:def:crs:OGC:1.3:CRS84").expect("a system");
    /// assert!(named.is_longitude_latitude() && Crs::of_epsg(4258).is_longitude_latitude());
    /// assert!(!Crs::of_epsg(25832).is_longitude_latitude());
    /// ```
    pub fn is_longitude_latitude(&self) -> bool {
        self.is_geographic == Some(true) || self.is_plain_degrees()
    }

    /// Whether its number stands for a horizontal and a vertical system together.
    pub(crate) fn is_compound(&self) -> bool {
        self.epsg.is_some_and(codes::is_compound)
    }

    /// Whether it is longitude and latitude as GeoJSON has them.
    pub fn is_plain_degrees(&self) -> bool {
        self.epsg == Some(4326) || self.name.as_deref() == Some("OGC:CRS84")
    }

    /// The name that other programs understand: by its number, and that of its heights, or else its definition.
    pub fn known_name(&self) -> Option<String> {
        let vertical = self.vertical.filter(|_| !self.is_compound());
        let by_number = self.epsg.map(|number| match vertical {
            Some(vertical) => format!("{PARTS}crs:EPSG::{number},crs:EPSG::{vertical}"),
            None => format!("urn:ogc:def:crs:EPSG::{number}"),
        });
        by_number.or_else(|| self.wkt.clone())
    }
}

impl fmt::Display for Crs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.epsg, &self.name) {
            (Some(number), Some(name)) => write!(f, "EPSG:{number} ({name})"),
            (Some(number), None) => write!(f, "EPSG:{number}"),
            (None, Some(name)) => f.write_str(name),
            (None, None) => f.write_str("not named"),
        }
    }
}

/// The beginning of a text up to the bracket that closes its first one.
fn bracketed(text: &str) -> &str {
    let mut depth = 0;
    let mut quoted = false;
    for (at, c) in text.char_indices() {
        match c {
            '"' => quoted = !quoted,
            '[' if !quoted => depth += 1,
            ']' if !quoted => {
                depth -= 1;
                if depth == 0 {
                    return &text[..=at];
                }
            }
            _ => {}
        }
    }
    text
}

/// The EPSG number of the system itself: its last one that is not inside of a part.
fn own_number(part: &str) -> Option<u32> {
    let places = ["AUTHORITY[", "ID["].iter().flat_map(|name| part.match_indices(name));
    let own = places.filter(|&(at, _)| {
        let before = &part[..at];
        before.matches('[').count() == before.matches(']').count() + 1
    });
    let (at, _) = own.max_by_key(|place| place.0)?;
    let mut fields = bracketed(&part[at..]).split(['[', ']', ',']).skip(1);
    let authority = fields.next()?.trim_matches([' ', '"']);
    let number = fields.next()?.trim_matches([' ', '"']);
    authority.eq_ignore_ascii_case("EPSG").then(|| number.parse().ok()).flatten()
}

#[cfg(test)]
mod tests {
    use super::Crs;

    #[test]
    fn numbers_of_well_known_text() {
        let oregon = r#"COMPD_CS["NAD83 / Oregon + NAVD88",PROJCS["NAD83 / Oregon GIC Lambert (ft)",GEOGCS["NAD83",
            AUTHORITY["EPSG","4269"]],UNIT["foot",0.3048,AUTHORITY["EPSG","9002"]],AUTHORITY["EPSG","2992"]],
            VERT_CS["NAVD88",AUTHORITY["EPSG","6360"]]]"#;
        let crs = Crs::of_wkt(oregon).expect("a system");
        assert_eq!(crs.to_string(), "EPSG:2992 (NAD83 / Oregon GIC Lambert (ft))");
        assert_eq!((crs.vertical, crs.is_geographic), (Some(6360), Some(false)));
        let second =
            Crs::of_wkt(r#"GEOGCRS["WGS 84",DATUM["x",ID["EPSG",6326]],ID["EPSG",4326]]"#).expect("one");
        assert_eq!((second.epsg, second.is_geographic, second.vertical), (Some(4326), Some(true), None));
        let third = r#"COMPOUNDCRS["both",GEOGCRS["ETRS89",ID["EPSG",4258]],VERTCRS["EVRF",VDATUM["x"],ID["EPSG",5621]]]"#;
        let third = Crs::of_wkt(third).expect("one");
        assert_eq!((third.epsg, third.vertical), (Some(4258), Some(5621)));
        let local = Crs::of_wkt("PROJCS[\"ours\",UNIT[\"metre\",1]]\0\0").expect("one");
        assert_eq!((local.epsg, local.name.as_deref()), (None, Some("ours")));
        assert_eq!(Crs::of_wkt("PROJCS[").expect("one").name, None);
        assert_eq!(Crs::of_wkt(""), None);
    }

    #[test]
    fn numbers_of_names() {
        for name in
            ["EPSG:25832", "urn:ogc:def:crs:EPSG::25832", "http://www.opengis.net/def/crs/EPSG/0/25832"]
        {
            assert_eq!(Crs::of_name(name), Some(Crs::of_epsg(25832)), "{name}");
        }
        assert_eq!(Crs::of_name("urn:ogc:def:crs:OGC:1.3:CRS84").expect("one").to_string(), "OGC:CRS84");
        assert_eq!(Crs::of_name("EPSG:"), None);
        let both = Crs::of_name("EPSG:25832+7837").expect("two");
        assert_eq!((both.epsg, both.vertical), (Some(25832), Some(7837)));
        let named = both.known_name().expect("a name");
        assert_eq!(named, "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::7837");
        assert_eq!(Crs::of_name(&named), Some(both));
        let whole = Crs { vertical: Some(5709), ..Crs::of_epsg(7415) };
        assert_eq!(whole.known_name().as_deref(), Some("urn:ogc:def:crs:EPSG::7415"));
        assert_eq!(Crs::of_epsg(7405).is_geographic, None, "it is compound");
    }
}
