//! ZIP archives written as a stream: lengths and checksums come after each file. Below 4 GiB, so
//! without ZIP64.

use flate2::write::DeflateEncoder;
use flate2::{Compression, Crc};
use std::io::Write as _;

/// Form in which a file is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// As it is.
    Stored,
    /// Compressed by DEFLATE, at its fastest level.
    Deflated,
}

/// Writes an archive: for each file `begin`, `data`, `end`; then `finish`.
#[derive(Debug, Default)]
pub struct ZipWriter {
    written: u32,
    files: Vec<File>,
    /// Checksum of the file begun last.
    crc: Crc,
    /// Compressor of the file begun last, if it is compressed.
    deflater: Option<DeflateEncoder<Vec<u8>>>,
}

#[derive(Debug)]
struct File {
    name: String,
    method: Method,
    offset: u32,
    /// Length, and length in the archive [bytes].
    length: u32,
    packed: u32,
    crc: u32,
}

impl Method {
    /// Its number in the format.
    fn number(self) -> u16 {
        match self {
            Self::Stored => 0,
            Self::Deflated => 8,
        }
    }
}

/// Flags: lengths come after the file (bit 3), names are UTF-8 (bit 11).
const FLAGS: u16 = 1 << 3 | 1 << 11;
/// 1 January 1980, midnight: the archive of a run does not depend on its time of creation.
const TIME_AND_DATE: u32 = 0x0021_0000;
const VERSION: u16 = 20;

impl ZipWriter {
    /// Begins a file.
    pub fn begin(&mut self, name: &str, method: Method, out: &mut Vec<u8>) {
        let start = out.len();
        out.extend(0x0403_4b50_u32.to_le_bytes());
        put(out, &[VERSION, FLAGS, method.number()]);
        out.extend(TIME_AND_DATE.to_le_bytes());
        out.extend([0; 12]);
        put(out, &[name.len() as u16, 0]);
        out.extend(name.bytes());
        self.files.push(File {
            name: name.to_owned(),
            method,
            offset: self.written,
            length: 0,
            packed: 0,
            crc: 0,
        });
        self.crc.reset();
        self.deflater = match method {
            Method::Stored => None,
            Method::Deflated => Some(DeflateEncoder::new(Vec::new(), Compression::fast())),
        };
        self.written += (out.len() - start) as u32;
    }

    /// Writes into the file begun last.
    pub fn data(&mut self, bytes: &[u8], out: &mut Vec<u8>) {
        self.crc.update(bytes);
        match &mut self.deflater {
            None => self.put_packed(bytes, out),
            Some(deflater) => {
                // Writing into memory can't fail.
                let _ = deflater.write_all(bytes);
                let packed = std::mem::take(deflater.get_mut());
                self.put_packed(&packed, out);
            }
        }
    }

    /// Ends the file begun last.
    pub fn end(&mut self, out: &mut Vec<u8>) {
        if let Some(rest) = self
            .deflater
            .take()
            .and_then(|deflater| deflater.finish().ok())
        {
            self.put_packed(&rest, out);
        }
        if let Some(file) = self.files.last_mut() {
            file.crc = self.crc.sum();
            file.length = self.crc.amount();
            for number in [0x0807_4b50, file.crc, file.packed, file.length] {
                out.extend(number.to_le_bytes());
            }
            self.written += 16;
        }
    }

    /// Writes a whole file.
    pub fn file(&mut self, name: &str, method: Method, bytes: &[u8], out: &mut Vec<u8>) {
        self.begin(name, method, out);
        self.data(bytes, out);
        self.end(out);
    }

    fn put_packed(&mut self, bytes: &[u8], out: &mut Vec<u8>) {
        if let Some(file) = self.files.last_mut() {
            file.packed += bytes.len() as u32;
            self.written += bytes.len() as u32;
            out.extend(bytes);
        }
    }

    /// Ends the archive with its directory.
    pub fn finish(&mut self, out: &mut Vec<u8>) {
        let start = out.len();
        for file in &self.files {
            out.extend(0x0201_4b50_u32.to_le_bytes());
            put(out, &[VERSION, VERSION, FLAGS, file.method.number()]);
            for number in [TIME_AND_DATE, file.crc, file.packed, file.length] {
                out.extend(number.to_le_bytes());
            }
            put(out, &[file.name.len() as u16, 0, 0, 0, 0]);
            out.extend([0; 4]);
            out.extend(file.offset.to_le_bytes());
            out.extend(file.name.bytes());
        }
        let length = (out.len() - start) as u32;
        let count = self.files.len() as u16;
        out.extend(0x0605_4b50_u32.to_le_bytes());
        put(out, &[0, 0, count, count]);
        out.extend(length.to_le_bytes());
        out.extend(self.written.to_le_bytes());
        put(out, &[0]);
    }
}

fn put(out: &mut Vec<u8>, numbers: &[u16]) {
    out.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read as _;

    #[test]
    fn lengths_and_checksum_are_those_of_the_standard() {
        for method in [Method::Stored, Method::Deflated] {
            let mut archive = ZipWriter::default();
            let mut out = Vec::new();
            archive.begin("a", method, &mut out);
            let start = out.len();
            archive.data(b"1234", &mut out);
            archive.data(b"56789", &mut out);
            archive.end(&mut out);
            let file = &archive.files[0];
            assert_eq!((file.crc, file.length), (0xcbf4_3926, 9));
            assert_eq!(archive.written as usize, out.len());
            let packed = &out[start..start + file.packed as usize];
            let mut text = String::new();
            match method {
                Method::Stored => text = String::from_utf8(packed.to_vec()).unwrap(),
                Method::Deflated => {
                    let mut inflater = flate2::read::DeflateDecoder::new(packed);
                    inflater.read_to_string(&mut text).unwrap();
                }
            }
            assert_eq!(text, "123456789");
        }
    }
}
