//! `GDAL_METADATA`: scale, offset and unit of the band.

use super::{GeoTiffError, Tiff, text};
use roxmltree::{Document, Node};
use tiff::tags::Tag;

const GDAL_METADATA: Tag = Tag::Unknown(42112);
/// Names of the metre.
const METRE: [&str; 6] = ["m", "metre", "metres", "meter", "meters", "9001"];

/// Meaning of the numbers in the cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Metadata {
    scale: f64,
    offset: f64,
}

impl Metadata {
    pub(super) fn of(tiff: &mut Tiff<'_>) -> Result<Self, GeoTiffError> {
        let plain = Self {
            scale: 1.0,
            offset: 0.0,
        };
        let text = text(tiff, GDAL_METADATA)?.filter(|text| !text.is_empty());
        text.map_or(Ok(plain), |text| plain.with(&text))
    }

    fn with(mut self, text: &str) -> Result<Self, GeoTiffError> {
        let document = Document::parse(text).map_err(GeoTiffError::Metadata)?;
        for item in document.descendants() {
            match item.attribute("role") {
                Some("scale") => self.scale = number(item, "scale")?,
                Some("offset") => self.offset = number(item, "offset")?,
                Some("unittype") => require_metres(item.text().unwrap_or_default())?,
                _ => {}
            }
        }
        if self.scale == 0.0 {
            let text = "0".to_owned();
            return Err(GeoTiffError::Scaling {
                role: "scale",
                text,
            });
        }
        Ok(self)
    }

    /// Value that a number stands for.
    pub(super) fn value(self, number: f64) -> f64 {
        if (self.scale, self.offset) == (1.0, 0.0) {
            // As it is: adding 0 would change the sign of -0.
            return number;
        }
        number * self.scale + self.offset
    }
}

fn number(item: Node<'_, '_>, role: &'static str) -> Result<f64, GeoTiffError> {
    let text = item.text().unwrap_or_default().trim();
    let number = text.parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| GeoTiffError::Scaling {
        role,
        text: text.chars().take(20).collect(),
    })
}

fn require_metres(unit: &str) -> Result<(), GeoTiffError> {
    let unit = unit.trim();
    let is_metre = METRE.iter().any(|name| name.eq_ignore_ascii_case(unit));
    if unit.is_empty() || is_metre {
        return Ok(());
    }
    Err(GeoTiffError::BandUnit {
        unit: unit.chars().take(20).collect(),
    })
}
