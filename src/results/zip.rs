//! ZIP archives of uncompressed files, written as a stream: lengths and
//! checksums come after each file. Below 4 GiB, so without ZIP64.

/// Writes an archive: for each file `begin`, `data`, `end`; then `finish`.
#[derive(Debug, Default)]
pub struct ZipWriter {
    written: u32,
    files: Vec<File>,
}

#[derive(Debug)]
struct File {
    name: String,
    offset: u32,
    length: u32,
    crc: u32,
}

/// Flags: lengths come after the file (bit 3), names are UTF-8 (bit 11).
const FLAGS: u16 = 1 << 3 | 1 << 11;
/// 1 January 1980, midnight: the archive of a run does not depend on its time of creation.
const TIME_AND_DATE: u32 = 0x0021_0000;
const VERSION: u16 = 20;

impl ZipWriter {
    /// Begins a file.
    pub fn begin(&mut self, name: &str, out: &mut Vec<u8>) {
        let start = out.len();
        out.extend(0x0403_4b50_u32.to_le_bytes());
        put(out, &[VERSION, FLAGS, 0]);
        out.extend(TIME_AND_DATE.to_le_bytes());
        out.extend([0; 12]);
        put(out, &[name.len() as u16, 0]);
        out.extend(name.bytes());
        self.files.push(File {
            name: name.to_owned(),
            offset: self.written,
            length: 0,
            crc: !0,
        });
        self.written += (out.len() - start) as u32;
    }

    /// Writes into the file begun last.
    pub fn data(&mut self, bytes: &[u8], out: &mut Vec<u8>) {
        if let Some(file) = self.files.last_mut() {
            file.crc = bytes.iter().fold(file.crc, |crc, byte| {
                TABLE[((crc ^ u32::from(*byte)) & 0xff) as usize] ^ (crc >> 8)
            });
            file.length += bytes.len() as u32;
            self.written += bytes.len() as u32;
            out.extend(bytes);
        }
    }

    /// Ends the file begun last.
    pub fn end(&mut self, out: &mut Vec<u8>) {
        if let Some(file) = self.files.last_mut() {
            file.crc = !file.crc;
            for number in [0x0807_4b50, file.crc, file.length, file.length] {
                out.extend(number.to_le_bytes());
            }
            self.written += 16;
        }
    }

    /// Ends the archive with its directory.
    pub fn finish(&mut self, out: &mut Vec<u8>) {
        let start = out.len();
        for file in &self.files {
            out.extend(0x0201_4b50_u32.to_le_bytes());
            put(out, &[VERSION, VERSION, FLAGS, 0]);
            for number in [TIME_AND_DATE, file.crc, file.length, file.length] {
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

/// CRC-32 of each byte, polynomial 0xEDB88320.
const TABLE: [u32; 256] = {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let mut crc = byte as u32;
        let mut bit = 0;
        while bit < 8 {
            crc = if crc & 1 == 1 {
                0xedb8_8320 ^ (crc >> 1)
            } else {
                crc >> 1
            };
            bit += 1;
        }
        table[byte] = crc;
        byte += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_is_that_of_the_standard() {
        let mut archive = ZipWriter::default();
        let mut out = Vec::new();
        archive.begin("a", &mut out);
        archive.data(b"1234", &mut out);
        archive.data(b"56789", &mut out);
        archive.end(&mut out);
        assert_eq!(archive.files[0].crc, 0xcbf4_3926);
        assert_eq!(archive.files[0].length, 9);
        assert_eq!(archive.written as usize, out.len());
    }
}
