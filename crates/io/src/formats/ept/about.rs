//! Reads `ept.json`.

use std::io::Read;

use serde_json::Value;

use super::super::las::{Cubes, Dimension, Key, Kind};
use crate::{Crs, Error, Source};

/// How nodes are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DataType {
    Laszip,
    Binary,
    Zstandard,
}

/// The description of all nodes.
pub(super) struct About {
    pub(super) data: DataType,
    pub(super) cubes: Cubes,
    /// How many points there are.
    pub(super) points: u64,
    /// The fields of a record, coordinates among them, and the bytes of one.
    pub(super) dimensions: Vec<Dimension>,
    pub(super) record: usize,
    pub(super) crs: Option<Crs>,
}

/// The error of a fault of an EPT.
pub(super) fn wrong(what: impl std::fmt::Display) -> Error {
    Error::content(format!("EPT: {what}"))
}

/// A JSON text, all of it.
pub(super) fn json(mut source: Box<dyn Source>, name: &str) -> Result<Value, Error> {
    let mut bytes = Vec::new();
    source.read_to_end(&mut bytes)?;
    serde_json::from_slice(&bytes).map_err(|error| wrong(format!("{name} is no JSON: {error}")))
}

impl About {
    pub(super) fn read(source: Box<dyn Source>) -> Result<Self, Error> {
        let all = json(source, super::NAME)?;
        let text = |name: &str| all[name].as_str().unwrap_or_default();
        let data = match text("dataType") {
            "laszip" => DataType::Laszip,
            "binary" => DataType::Binary,
            "zstandard" => DataType::Zstandard,
            "" => return Err(wrong("ept.json has no dataType")),
            other => return Err(Error::DataType(other.to_owned())),
        };
        if !matches!(text("hierarchyType"), "" | "json") {
            return Err(wrong(format!("a hierarchy of the type {:?} is not read", text("hierarchyType"))));
        }
        let bounds: Vec<f64> =
            all["bounds"].as_array().into_iter().flatten().filter_map(Value::as_f64).collect();
        let [x0, y0, _, x1, y1, _] = bounds[..] else {
            return Err(wrong("its bounds are not six numbers"));
        };
        let (dimensions, record) = schema(&all["schema"])?;
        let step = |name: &str| {
            let own = dimensions.iter().find(|own| own.name == name);
            own.and_then(|own| own.scale).map_or(0.0, |scale| scale[0])
        };
        let cubes = Cubes { low: [x0, y0], width: [x1 - x0, y1 - y0], step: [step("X"), step("Y")] };
        let points = all["points"].as_u64().unwrap_or_default();
        Ok(Self { data, cubes, points, dimensions, record, crs: system(&all["srs"]) })
    }

    /// Where a node is, from the folder of `ept.json`.
    pub(super) fn path(&self, key: Key) -> String {
        let extension = match self.data {
            DataType::Laszip => "laz",
            DataType::Binary => "bin",
            DataType::Zstandard => "zst",
        };
        format!("ept-data/{key}.{extension}")
    }
}

/// The fields of a record in their order, and its length.
fn schema(fields: &Value) -> Result<(Vec<Dimension>, usize), Error> {
    let fields = fields.as_array().ok_or_else(|| wrong("it has no schema"))?;
    let (mut all, mut place) = (Vec::with_capacity(fields.len()), 0_usize);
    for field in fields {
        let name = field["name"].as_str().ok_or_else(|| wrong("a field of its schema has no name"))?;
        let size = field["size"].as_u64().unwrap_or_default();
        let kind = match (field["type"].as_str().unwrap_or_default(), size) {
            ("unsigned", 1 | 2 | 4 | 8) => Kind::Unsigned(size as usize),
            ("signed", 1 | 2 | 4 | 8) => Kind::Signed(size as usize),
            ("float" | "floating", 4 | 8) => Kind::Float(size as usize),
            (kind, _) => {
                let name = crate::error::excerpt(name);
                return Err(wrong(format!("the field {name} of its schema is {kind:?} of {size} bytes")));
            }
        };
        let number = |of: &str| field[of].as_f64();
        let scale = match (number("scale"), number("offset")) {
            (None, None) => None,
            (scale, shift) => Some([scale.unwrap_or(1.0), shift.unwrap_or(0.0)]),
        };
        let mut own = Dimension::new(name, place, kind);
        own.scale = scale;
        all.push(own);
        place += size as usize;
    }
    Ok((all, place))
}

/// The system of coordinates: its definition, or else its numbers.
fn system(srs: &Value) -> Option<Crs> {
    let text = |name: &str| srs[name].as_str().filter(|text| !text.is_empty());
    let number = |name: &str| {
        let own = &srs[name];
        own.as_u64().or_else(|| own.as_str()?.parse().ok()).and_then(|number| u32::try_from(number).ok())
    };
    let is_epsg = text("authority").is_some_and(|name| name.eq_ignore_ascii_case("EPSG"));
    let horizontal = number("horizontal").filter(|_| is_epsg);
    let mut crs = Crs::of_both(horizontal, text("wkt").and_then(Crs::of_wkt))?;
    crs.vertical = crs.vertical.or_else(|| number("vertical").filter(|_| is_epsg));
    Some(crs)
}
