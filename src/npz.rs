//! Arrays for NumPy: `numpy.load` reads a zip archive of files that each hold a header and the numbers.
//!
//! The same arrays give the same bytes: no clock is written.

use std::io::{self, Seek, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

/// Writes arrays to an archive.
pub struct Archive<W: Write + Seek>(ZipWriter<W>);

/// A number as NumPy stores it.
pub trait Element: Copy {
    /// Its type in NumPy's words.
    const TYPE: &'static str;
    /// Its bytes.
    fn bytes(self) -> impl AsRef<[u8]>;
}

impl Element for u32 {
    const TYPE: &'static str = "<u4";

    fn bytes(self) -> impl AsRef<[u8]> {
        self.to_le_bytes()
    }
}

impl Element for u64 {
    const TYPE: &'static str = "<u8";

    fn bytes(self) -> impl AsRef<[u8]> {
        self.to_le_bytes()
    }
}

impl Element for bool {
    const TYPE: &'static str = "|b1";

    fn bytes(self) -> impl AsRef<[u8]> {
        [u8::from(self)]
    }
}

impl<W: Write + Seek> Archive<W> {
    /// An empty archive.
    pub fn new(out: W) -> Self {
        Self(ZipWriter::new(out))
    }

    /// Adds a table, row by row.
    ///
    /// # Panics
    /// If the rows differ in length.
    ///
    /// # Errors
    /// If the writer refuses.
    pub fn add<'a, T: Element + 'a>(
        &mut self,
        name: &str,
        rows: impl ExactSizeIterator<Item = &'a [T]> + Clone,
    ) -> io::Result<()> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .large_file(true)
            .last_modified_time(DateTime::default());
        self.0.start_file(format!("{name}.npy"), options)?;
        let columns = rows.clone().next().map_or(0, <[T]>::len);
        assert!(
            rows.clone().all(|row| row.len() == columns),
            "rows of one length"
        );
        let shape = (rows.len(), columns);
        self.0.write_all(&header(T::TYPE, shape))?;
        let mut bytes = Vec::new();
        for row in rows {
            bytes.clear();
            for &element in row {
                bytes.extend_from_slice(element.bytes().as_ref());
            }
            self.0.write_all(&bytes)?;
        }
        Ok(())
    }

    /// Ends the archive.
    ///
    /// # Errors
    /// If the writer refuses.
    pub fn close(self) -> io::Result<()> {
        self.0.finish()?.flush()
    }
}

/// Version 1.0 of NumPy's header: a magic word, the length of the description, and the description, padded so that the
/// numbers begin at a multiple of 64 bytes.
fn header(element: &str, (rows, columns): (usize, usize)) -> Vec<u8> {
    const BEFORE: usize = 10;
    let description =
        format!("{{'descr': '{element}', 'fortran_order': False, 'shape': ({rows}, {columns}), }}");
    let length = (BEFORE + description.len() + 1).next_multiple_of(64) - BEFORE;
    let mut header = b"\x93NUMPY\x01\x00".to_vec();
    header.extend_from_slice(&(length as u16).to_le_bytes());
    header.extend_from_slice(format!("{description:<0$}\n", length - 1).as_bytes());
    header
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Cursor, Read};
    use zip::ZipArchive;

    #[test]
    fn a_table_is_a_header_and_its_numbers() {
        let mut out = Cursor::new(Vec::new());
        let mut archive = Archive::new(&mut out);
        let rows: [&[u32]; 2] = [&[1, 2, 3], &[4, 5, 600]];
        archive.add("w", rows.into_iter()).unwrap();
        archive.add("h", [&[true, false][..]].into_iter()).unwrap();
        archive.close().unwrap();
        let mut archive = ZipArchive::new(out).unwrap();
        let mut bytes = |name| {
            let mut bytes = Vec::new();
            archive
                .by_name(name)
                .unwrap()
                .read_to_end(&mut bytes)
                .unwrap();
            bytes
        };
        let table = bytes("w.npy");
        let start = 10 + usize::from(u16::from_le_bytes([table[8], table[9]]));
        assert_eq!((start % 64, &table[..8]), (0, &b"\x93NUMPY\x01\x00"[..]));
        let words = String::from_utf8(table[10..start].to_vec()).unwrap();
        let expected = "{'descr': '<u4', 'fortran_order': False, 'shape': (2, 3), }";
        assert_eq!((words.trim_end(), words.ends_with('\n')), (expected, true));
        let numbers = [1u32, 2, 3, 4, 5, 600].map(u32::to_le_bytes);
        assert_eq!(&table[start..], numbers.as_flattened());
        assert_eq!(bytes("h.npy")[128..], [1, 0]);
    }
}
