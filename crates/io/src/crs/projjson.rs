//! Systems in the JSON of PROJ (<https://proj.org/specifications/projjson.html>), which GeoParquet wants in full.
//!
//! A number alone is no system there, and the registry itself is not in this program. What a number alone defines by a rule is
//! written: longitude and latitude of three datums, and their zones of UTM.

use serde_json::{Value, json};

use super::Crs;

/// Longitude and latitude of a datum, and the zones of UTM on it.
struct Datum {
    epsg: u32,
    name: &'static str,
    frame: &'static str,
    ellipsoid: &'static str,
    inverse_flattening: f64,
    /// The number of zone 0 in the north and in the south, and the zones that have one.
    zones: &'static [(u32, bool, std::ops::RangeInclusive<u32>)],
}

const DATUMS: [Datum; 3] = [
    Datum {
        epsg: 4326,
        name: "WGS 84",
        frame: "World Geodetic System 1984",
        ellipsoid: "WGS 84",
        inverse_flattening: 298.257_223_563,
        zones: &[(32_600, true, 1..=60), (32_700, false, 1..=60)],
    },
    Datum {
        epsg: 4258,
        name: "ETRS89",
        frame: "European Terrestrial Reference System 1989",
        ellipsoid: "GRS 1980",
        inverse_flattening: 298.257_222_101,
        zones: &[(25_800, true, 28..=37)],
    },
    Datum {
        epsg: 4269,
        name: "NAD83",
        frame: "North American Datum 1983",
        ellipsoid: "GRS 1980",
        inverse_flattening: 298.257_222_101,
        zones: &[(26_900, true, 1..=23)],
    },
];

/// The larger half axis of both ellipsoids, in metres.
const HALF_AXIS_METRES: u32 = 6_378_137;
/// UTM: the easting of the middle of a zone, the northing of the equator in the south, and the scale along the middle.
const FALSE_EASTING_METRES: u32 = 500_000;
const FALSE_NORTHING_METRES: u32 = 10_000_000;
const MIDDLE_SCALE: f64 = 0.9996;

fn id(code: u32) -> Value {
    json!({ "authority": "EPSG", "code": code })
}

fn axis(name: &str, abbreviation: &str, direction: &str, unit: &str) -> Value {
    json!({ "name": name, "abbreviation": abbreviation, "direction": direction, "unit": unit })
}

impl Datum {
    fn geographic(&self) -> Value {
        let ellipsoid = json!({
            "name": self.ellipsoid,
            "semi_major_axis": HALF_AXIS_METRES,
            "inverse_flattening": self.inverse_flattening,
        });
        let axes = [
            axis("Geodetic latitude", "Lat", "north", "degree"),
            axis("Geodetic longitude", "Lon", "east", "degree"),
        ];
        json!({
            "type": "GeographicCRS",
            "name": self.name,
            "datum": { "type": "GeodeticReferenceFrame", "name": self.frame, "ellipsoid": ellipsoid },
            "coordinate_system": { "subtype": "ellipsoidal", "axis": axes },
            "id": id(self.epsg),
        })
    }

    /// A zone of UTM, if the number is that of one.
    fn zone(&self, epsg: u32) -> Option<Value> {
        let (first, is_north, zone) = self.zones.iter().find_map(|(first, is_north, zones)| {
            let zone = epsg.checked_sub(*first)?;
            zones.contains(&zone).then_some((first, *is_north, zone))
        })?;
        debug_assert_eq!(first + zone, epsg);
        let half = if is_north { 'N' } else { 'S' };
        let parameter = |name: &str, value: Value, unit: &str, code: u32| json!({ "name": name, "value": value, "unit": unit, "id": id(code) });
        let northing = if is_north { 0 } else { FALSE_NORTHING_METRES };
        let middle = i64::from(6 * zone) - 183;
        let parameters = [
            parameter("Latitude of natural origin", json!(0), "degree", 8801),
            parameter("Longitude of natural origin", json!(middle), "degree", 8802),
            parameter("Scale factor at natural origin", json!(MIDDLE_SCALE), "unity", 8805),
            parameter("False easting", json!(FALSE_EASTING_METRES), "metre", 8806),
            parameter("False northing", json!(northing), "metre", 8807),
        ];
        let method = json!({ "name": "Transverse Mercator", "id": id(9807) });
        let conversion =
            json!({ "name": format!("UTM zone {zone}{half}"), "method": method, "parameters": parameters });
        let axes = [axis("Easting", "E", "east", "metre"), axis("Northing", "N", "north", "metre")];
        Some(json!({
            "type": "ProjectedCRS",
            "name": format!("{} / UTM zone {zone}{half}", self.name),
            "base_crs": self.geographic(),
            "conversion": conversion,
            "coordinate_system": { "subtype": "Cartesian", "axis": axes },
            "id": id(epsg),
        }))
    }
}

impl Crs {
    /// The system in the JSON of PROJ, where its number alone defines it: longitude and latitude of WGS 84, ETRS89 and NAD83, and
    /// zones of UTM on these.
    ///
    /// ```
    /// use delone_io::Crs;
    ///
    /// let zone = Crs::of_epsg(25832).projjson().expect("a zone");
    /// assert_eq!(zone["name"], "ETRS89 / UTM zone 32N");
    /// assert!(Crs::of_epsg(2056).projjson().is_none());
    /// ```
    pub fn projjson(&self) -> Option<Value> {
        let epsg = self.epsg?;
        DATUMS
            .iter()
            .find_map(|datum| if datum.epsg == epsg { Some(datum.geographic()) } else { datum.zone(epsg) })
    }

    /// Whether GeoParquet says it: longitude and latitude of WGS 84 go without saying there.
    pub fn is_said_by_geoparquet(&self) -> bool {
        self.is_plain_degrees() || self.projjson().is_some()
    }
}
