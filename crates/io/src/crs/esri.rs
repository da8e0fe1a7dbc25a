//! Systems by the names that `.prj` files have, which seldom have a number: those of Esri's registry, which has one definition for each name.

use crate::Crs;

/// Names of single systems.
const ALONE: [(&str, u32); 5] = [
    ("GCS_WGS_1984", 4326),
    ("GCS_ETRS_1989", 4258),
    ("GCS_North_American_1983", 4269),
    ("WGS_1984_Web_Mercator_Auxiliary_Sphere", 3857),
    ("RGF_1993_Lambert_93", 2154),
];

/// How the names of zones of UTM begin and end, the numbers of the first zone and the last, and the number of a zone 0.
const ZONES: [(&str, &str, u32, u32, u32); 4] = [
    ("WGS_1984_UTM_Zone_", "N", 1, 60, 32_600),
    ("WGS_1984_UTM_Zone_", "S", 1, 60, 32_700),
    ("ETRS_1989_UTM_Zone_", "N", 28, 38, 25_800),
    ("NAD_1983_UTM_Zone_", "N", 1, 23, 26_900),
];

/// The system of a `.prj` file.
pub(crate) fn read(text: &str) -> Option<Crs> {
    let crs = Crs::of_wkt(text)?;
    let epsg = crs.epsg.or_else(|| number(crs.name.as_deref()?));
    Some(Crs { epsg, ..crs })
}

fn number(name: &str) -> Option<u32> {
    let alone = ALONE.iter().find(|known| known.0 == name).map(|known| known.1);
    alone.or_else(|| {
        ZONES.iter().find_map(|&(begin, end, first, last, zero)| {
            let zone = name.strip_prefix(begin)?.strip_suffix(end)?.parse().ok()?;
            (first..=last).contains(&zone).then_some(zero + zone)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::read;

    #[test]
    fn names_have_their_numbers() {
        let of = |name: &str| read(&format!("PROJCS[\"{name}\",GEOGCS[\"x\"]]")).and_then(|crs| crs.epsg);
        assert_eq!(of("WGS_1984_UTM_Zone_33N"), Some(32_633));
        assert_eq!(of("WGS_1984_UTM_Zone_7S"), Some(32_707));
        assert_eq!(of("ETRS_1989_UTM_Zone_32N"), Some(25_832));
        assert_eq!([of("ETRS_1989_UTM_Zone_32S"), of("ETRS_1989_UTM_Zone_60N"), of("ours")], [None; 3]);
        assert_eq!(read("GEOGCS[\"GCS_WGS_1984\"]").and_then(|crs| crs.epsg), Some(4326));
        assert_eq!(read("nothing"), None);
    }
}
