//! Which systems of the EPSG registry count in feet, and which unit other systems name.
//!
//! Feet of the United States are 0.3048006 metres, others 0.3048 or 0.304797: all are taken as 0.3048, which is off by one in a hundred
//! thousand at most.

use super::codes::is_in_feet;
use super::{Crs, GEOGRAPHIC, PROJECTED, VERTICAL, bracketed};

/// Metres of a foot.
const FOOT: f64 = 0.3048;

impl Crs {
    /// The metres of a unit of x and y, as far as the system tells; none of degrees.
    ///
    /// ```
    /// use delone_io::Crs;
    ///
    /// assert_eq!(Crs::of_epsg(25832).metres(), Some(1.0));
    /// assert_eq!(Crs::of_epsg(2992).metres(), Some(0.3048));
    /// assert_eq!(Crs::of_epsg(4326).metres(), None);
    /// ```
    pub fn metres(&self) -> Option<f64> {
        if self.is_degrees() {
            return None;
        }
        let named = self.wkt.as_deref().and_then(|text| part(text, &PROJECTED)).and_then(unit);
        named.or_else(|| self.keys.as_ref()?.metres(3_076, 3_077)).or_else(|| self.epsg.map(of_number))
    }

    /// The metres of a unit of heights, where the system has one of heights.
    pub fn metres_of_heights(&self) -> Option<f64> {
        let named = self.wkt.as_deref().and_then(|text| part(text, &VERTICAL)).and_then(unit);
        named.or_else(|| self.keys.as_ref()?.metres(4_099, 0)).or_else(|| self.vertical.map(of_number))
    }

    /// Whether x and y are longitude and latitude.
    pub fn is_degrees(&self) -> bool {
        let of_text = || {
            self.wkt
                .as_deref()
                .is_some_and(|text| part(text, &PROJECTED).is_none() && part(text, &GEOGRAPHIC).is_some())
        };
        self.is_geographic.unwrap_or_else(|| self.is_plain_degrees() || of_text())
    }
}

/// The metres of the unit of a projected system, or of one of heights.
fn of_number(code: u32) -> f64 {
    if is_in_feet(code) { FOOT } else { 1.0 }
}

/// A part of well-known text, by how it may begin.
fn part<'a>(text: &'a str, names: &[&str]) -> Option<&'a str> {
    names.iter().filter_map(|name| text.find(name)).min().map(|at| bracketed(&text[at..]))
}

/// The metres of the last unit of length in a part of well-known text: that of its axes.
fn unit(part: &str) -> Option<f64> {
    let at = part.rmatch_indices("UNIT[").map(|found| found.0).find(|&at| {
        let before = &part[..at];
        !before.ends_with("ANGLE") && !before.ends_with("SCALE")
    })?;
    // After the name, which may have commas.
    let after = bracketed(&part[at..]).splitn(3, '"').nth(2)?.trim_start().strip_prefix(',')?;
    let factor: f64 = after.split([',', ']']).next()?.trim().parse().ok()?;
    (factor > 0.0 && factor.is_finite()).then_some(factor)
}

/// The metres of a unit by its number.
pub(super) fn of_unit(number: u16) -> Option<f64> {
    match number {
        9_001 => Some(1.0),
        9_002 | 9_003 | 9_005 | 9_041 => Some(FOOT),
        9_036 => Some(1000.0),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::Crs;
    use crate::crs::keys::decode;

    #[test]
    fn units_are_told_by_numbers() {
        for (code, metres) in [(2992, 0.3048), (2263, 0.3048), (32_633, 1.0), (3857, 1.0), (2056, 1.0)] {
            assert_eq!(Crs::of_epsg(code).metres(), Some(metres), "{code}");
        }
        let heights = |vertical| Crs { vertical: Some(vertical), ..Crs::of_epsg(2992) }.metres_of_heights();
        assert_eq!((heights(5703), heights(6360)), (Some(1.0), Some(0.3048)));
        assert_eq!(Crs::of_epsg(2992).metres_of_heights(), None);
    }

    #[test]
    fn units_are_told_by_text_and_keys() {
        let first = r#"COMPD_CS["b",PROJCS["p",GEOGCS["g",UNIT["degree",0.0174532925199433]],UNIT["foot, ours",0.3048,AUTHORITY["EPSG","9002"]],
            AXIS["X",EAST]],VERT_CS["v",VERT_DATUM["d",2005],UNIT["metre",1.0,AUTHORITY["EPSG","9001"]]]]"#;
        let crs = Crs::of_wkt(first).expect("a system");
        assert_eq!((crs.metres(), crs.metres_of_heights()), (Some(0.3048), Some(1.0)));
        let second = r#"PROJCRS["p",BASEGEOGCRS["g",DATUM["d",ELLIPSOID["e",6378137,298,LENGTHUNIT["metre",1]]]],CONVERSION["c",
            PARAMETER["f",0,LENGTHUNIT["metre",1]]],CS[Cartesian,2],AXIS["x",east],LENGTHUNIT["US survey foot",0.304800609601219]]"#;
        let crs = Crs::of_wkt(second).expect("a system");
        assert_eq!((crs.metres(), crs.metres_of_heights()), (Some(0.304_800_609_601_219), None));
        assert_eq!(
            Crs::of_wkt(r#"GEOGCS["g",UNIT["degree",0.0174532925199433]]"#).expect("one").metres(),
            None
        );
        for text in ["PROJCS[\"p\",UNIT[\"none\",0]]", "PROJCS[\"p\",UNIT[", "PROJCS[\"p\"]"] {
            assert_eq!(Crs::of_wkt(text).expect("one").metres(), None, "{text}");
        }
        let numbers = [
            1, 1, 0, 5, 1024, 0, 1, 1, 3072, 0, 1, 32_767, 3076, 0, 1, 9002, 3078, 34_736, 1, 0, 4099, 0, 1,
            9001,
        ];
        let crs = decode(&numbers, &[45.5], b"").map(|crs| (crs.metres(), crs.metres_of_heights()));
        assert!(crs.is_none_or(|units| units == (Some(0.3048), Some(1.0))));
    }
}
