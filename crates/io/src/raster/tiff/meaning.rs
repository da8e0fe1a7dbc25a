//! The meaning of numbers in a GeoTIFF: no data, or values after scale and offset.

use crate::error::excerpt;
use crate::{Error, xml};

/// The meaning of numbers in a file.
pub(super) struct Meaning {
    pub(super) nodata: Option<f64>,
    scale: f64,
    offset: f64,
}

impl Meaning {
    pub(super) fn of(nodata: &str, about: &str) -> Result<Self, Error> {
        let text = nodata.trim_matches(|c: char| c == '\0' || c.is_whitespace());
        let number = || {
            text.parse::<f64>().map_err(|_| {
                Error::content(format!("TIFF: what stands for no data is no number: {:?}", excerpt(text)))
            })
        };
        let nodata = if text.is_empty() { None } else { Some(number()?) };
        let mut meaning = Self { nodata, scale: 1.0, offset: 0.0 };
        let Ok(document) = xml::parse(about.trim_matches('\0')) else { return Ok(meaning) };
        for item in document.descendants().filter(|node| node.has_tag_name("Item")) {
            let is_first = item.attribute("sample").is_none_or(|sample| sample == "0");
            let value =
                item.text().and_then(|text| text.trim().parse::<f64>().ok()).filter(|x| x.is_finite());
            match (item.attribute("role"), value) {
                (Some("scale"), Some(value)) if is_first => meaning.scale = value,
                (Some("offset"), Some(value)) if is_first => meaning.offset = value,
                _ => {}
            }
        }
        Ok(meaning)
    }

    /// The value of a cell that is in no part of the file.
    pub(super) fn absent(&self) -> f64 {
        if self.nodata.is_some() { f64::NAN } else { self.value(0.0, None) }
    }

    pub(super) fn value(&self, stored: f64, nodata: Option<f64>) -> f64 {
        if Some(stored) == nodata {
            return f64::NAN;
        }
        if self.scale == 1.0 && self.offset == 0.0 { stored } else { stored * self.scale + self.offset }
    }
}
