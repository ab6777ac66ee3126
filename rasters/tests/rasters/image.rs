//! Small GeoTIFF files with whatever is to be wrong in them.

use std::io::Cursor;
use tiff::encoder::TiffEncoder;
use tiff::encoder::colortype::Gray32Float;
use tiff::tags::Tag;

/// A file of 4 × 3 cells whose tags can be changed.
pub(crate) struct Image {
    pub(crate) values: Vec<f32>,
    pub(crate) doubles: Vec<(u16, Vec<f64>)>,
    pub(crate) shorts: Vec<(u16, u16)>,
    pub(crate) keys: Vec<[u16; 4]>,
    pub(crate) texts: Vec<(u16, &'static str)>,
}

pub(crate) const SCALE: u16 = 33550;
pub(crate) const TIE_POINT: u16 = 33922;
pub(crate) const PREDICTOR: u16 = 317;
pub(crate) const KEY_DOUBLES: u16 = 34736;
pub(crate) const TRANSFORMATION: u16 = 34264;
pub(crate) const NODATA: u16 = 42113;
pub(crate) const METADATA: u16 = 42112;

impl Image {
    /// A raster in metres without errors.
    pub(crate) fn plain() -> Self {
        Self {
            values: (1_u8..=12).map(f32::from).collect(),
            doubles: vec![
                (SCALE, vec![2.0, 2.0, 0.0]),
                (TIE_POINT, vec![0.0, 0.0, 0.0, 500.0, 900.0, 0.0]),
            ],
            shorts: Vec::new(),
            keys: vec![[1024, 0, 1, 1], [3072, 0, 1, 32632]],
            texts: Vec::new(),
        }
    }

    /// Its bytes.
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let mut file = Cursor::new(Vec::new());
        let mut encoder = TiffEncoder::new(&mut file).unwrap();
        let mut image = encoder.new_image::<Gray32Float>(4, 3).unwrap();
        let tags = image.encoder();
        for (tag, numbers) in &self.doubles {
            tags.write_tag(Tag::Unknown(*tag), &numbers[..]).unwrap();
        }
        for (tag, number) in &self.shorts {
            tags.write_tag(Tag::Unknown(*tag), *number).unwrap();
        }
        for (tag, text) in &self.texts {
            tags.write_tag(Tag::Unknown(*tag), *text).unwrap();
        }
        let keys = [&[[1, 1, 0, self.keys.len() as u16]], &self.keys[..]].concat();
        let directory = Tag::GeoKeyDirectoryTag;
        tags.write_tag(directory, keys.as_flattened()).unwrap();
        image.write_data(&self.values).unwrap();
        file.into_inner()
    }

    /// Its bytes after a change.
    pub(crate) fn with(change: impl FnOnce(&mut Self)) -> Vec<u8> {
        let mut image = Self::plain();
        change(&mut image);
        image.bytes()
    }
}
