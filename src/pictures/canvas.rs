//! The sheet the pictures are drawn on.

use super::labels::{Extent, Point};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::*;
use thiserror::Error;

/// Part of a sheet, measured in device units.
pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// A part with axes: coordinates in the units of the picture.
pub(super) type Plane<'a> =
    DrawingArea<SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Device units per pixel of the finished picture. The plotting library rounds
/// to whole units; a quarter of a pixel keeps curves smooth and dots in place.
const DEVICE_PER_PX: f64 = 4.0;

/// Factor by which the library multiplies a font size before it writes the SVG.
const FONT_SIZE_FACTOR: f64 = 1.24;

/// Ink of axes and texts.
pub(super) const INK: RGBColor = RGBColor(38, 42, 48);
/// Ink of secondary elements.
pub(super) const FAINT_INK: RGBColor = RGBColor(105, 112, 122);
/// Grid lines and the like.
pub(super) const HAIRLINE: RGBColor = RGBColor(222, 225, 229);

/// A picture that could not be drawn.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("the picture could not be drawn: {0}")]
pub struct PictureError(String);

impl<E: std::error::Error + Send + Sync> From<DrawingAreaErrorKind<E>> for PictureError {
    fn from(error: DrawingAreaErrorKind<E>) -> Self {
        Self(error.to_string())
    }
}

/// A length in device units, from pixels of the finished picture.
pub(super) fn px(length: f64) -> i32 {
    (length * DEVICE_PER_PX).round() as i32
}

/// A length in pixels, from device units.
pub(super) fn from_device(length: i32) -> f64 {
    f64::from(length) / DEVICE_PER_PX
}

/// A stroke width or radius in device units, from pixels.
pub(super) fn width(length: f64) -> u32 {
    (length * DEVICE_PER_PX).round().max(1.0) as u32
}

/// A sans-serif text of this size [px].
pub(super) fn text(size_px: f64, color: &RGBColor) -> TextStyle<'_> {
    let size = size_px * DEVICE_PER_PX * FONT_SIZE_FACTOR;
    TextStyle::from(("sans-serif", size).into_font()).color(color)
}

/// The same in bold.
pub(super) fn bold(size_px: f64, color: &RGBColor) -> TextStyle<'_> {
    let size = size_px * DEVICE_PER_PX * FONT_SIZE_FACTOR;
    TextStyle::from(("sans-serif", size, FontStyle::Bold).into_font()).color(color)
}

/// An image to be shown on a sheet.
pub(super) struct Image<'a> {
    /// Red, green and blue of its pixels, row by row from the upper left one.
    pub pixels: &'a [u8],
    /// Columns and rows.
    pub count: (u32, u32),
    /// Its upper left corner on the sheet [px].
    pub corner: Point,
    /// Side of a pixel of it on the sheet [px].
    pub pixel: f64,
}

/// An image behind all that is drawn, as an element of SVG.
#[derive(Debug)]
pub(super) struct Backing(String);

impl Backing {
    /// The part of an image that lies within an extent.
    pub(super) fn of(image: &Image<'_>, within: Extent) -> Result<Self, PictureError> {
        let (columns, rows) = image.count;
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, columns, rows);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_compression(png::Compression::High);
        let written = encoder.write_header();
        let written = written.and_then(|mut writer| writer.write_image_data(image.pixels));
        written.map_err(|error| PictureError(error.to_string()))?;
        let data = BASE64_STANDARD.encode(file);
        let clip = [
            within.left,
            within.top,
            within.right - within.left,
            within.bottom - within.top,
        ];
        let [left, top, width, height] = clip.map(px);
        let (x, y) = (px(image.corner.0) - left, px(image.corner.1) - top);
        let [across, down] = [columns, rows].map(|count| px(f64::from(count) * image.pixel));
        Ok(Self(format!(
            "<svg x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\">\
             <image x=\"{x}\" y=\"{y}\" width=\"{across}\" height=\"{down}\" \
             preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" \
             href=\"data:image/png;base64,{data}\"/></svg>"
        )))
    }
}

/// Draws over an image on a white sheet of this size [px] and returns it as an SVG document.
pub(super) fn paint_over(
    size: (f64, f64),
    backing: &Backing,
    draw: impl FnOnce(&Area<'_>) -> Result<(), PictureError>,
) -> Result<String, PictureError> {
    // The first element is the white of the sheet.
    let svg = paint(size, draw)?;
    Ok(svg.replacen("/>", &format!("/>\n{}", backing.0), 1))
}

/// Draws a white sheet of this size [px] and returns it as an SVG document.
pub(super) fn paint(
    (width_px, height_px): (f64, f64),
    draw: impl FnOnce(&Area<'_>) -> Result<(), PictureError>,
) -> Result<String, PictureError> {
    let size = (width(width_px), width(height_px));
    let mut svg = String::new();
    {
        let sheet = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        sheet.fill(&WHITE)?;
        draw(&sheet)?;
        sheet.present()?;
    }
    Ok(finish(&svg, size, (width_px, height_px)))
}

/// Sets the size of the sheet in pixels and removes attributes that only
/// repeat SVG's defaults: they are half of a picture of many dots.
fn finish(svg: &str, device: (u32, u32), shown_px: (f64, f64)) -> String {
    let device = format!("width=\"{}\" height=\"{}\"", device.0, device.1);
    let shown = format!("width=\"{:.0}\" height=\"{:.0}\"", shown_px.0, shown_px.1);
    svg.replacen(&device, &shown, 1)
        .replace(" opacity=\"1\"", "")
        .replace(" stroke=\"none\" stroke-width=\"1\"", "")
}
