//! The source of a recording's text: a file, bytes in memory, or a member of a zip archive.
//!
//! Text in UTF-16 is recognised by its byte order mark and converted to UTF-8; everything else is passed
//! unchanged. A member of a zip archive is unpacked as it is read.

use super::error::{RecordingError, RecordingProblem};
use encoding_rs_io::DecodeReaderBytesBuilder;
use flate2::CrcReader;
use flate2::read::DeflateDecoder;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Cursor, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The size of a read buffer, bytes.
const BUFFER: usize = 1 << 17;

/// A reader of lines.
pub(super) type Text = Box<dyn BufRead + Send>;

/// Bytes that can be opened.
#[derive(Clone, Debug)]
pub(super) struct Source {
    name: String,
    bytes: Bytes,
    member: Option<Member>,
    /// The member, or the sheet or the sensor that was converted.
    part: Option<String>,
    /// Lines of the text that the file does not have.
    added_lines: u64,
}

#[derive(Clone, Debug)]
enum Bytes {
    File(PathBuf),
    Memory(Arc<[u8]>),
}

/// The position of a member in an archive.
#[derive(Clone, Debug)]
pub(super) struct Member {
    pub name: String,
    pub start: u64,
    pub packed: u64,
    pub unpacked: u64,
    pub checksum: u32,
    pub packing: Packing,
}

/// How the bytes of a member are packed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Packing {
    Stored,
    Deflated,
    /// Encrypted, or by another method.
    Unknown,
}

pub(super) trait ReadSeek: Read + Seek + Send {}
impl<T: Read + Seek + Send> ReadSeek for T {}

impl Source {
    /// # Errors
    /// If there is no such file, or it cannot be read twice.
    pub fn file(path: &Path) -> Result<Self, RecordingError> {
        let source = Self::new(path.display().to_string(), Bytes::File(path.to_owned()));
        let metadata = fs::metadata(path).map_err(|error| source.error(None, error.into()))?;
        if metadata.is_file() {
            return Ok(source);
        }
        let got = if metadata.is_dir() {
            "a directory"
        } else {
            "a pipe or a device"
        };
        let remedy = "a stream of readings is for `liftsim monitor`";
        Err(source.error(None, RecordingProblem::must("must be a file", got, remedy)))
    }

    pub fn memory(name: &str, bytes: Arc<[u8]>) -> Self {
        Self::new(name.to_owned(), Bytes::Memory(bytes))
    }

    fn new(name: String, bytes: Bytes) -> Self {
        Self {
            name,
            bytes,
            member: None,
            part: None,
            added_lines: 0,
        }
    }

    /// The same, converted into a table with so many lines above the first of the file.
    pub fn converted(&self, table: Vec<u8>, part: Option<&str>, added_lines: u64) -> Self {
        let part = part.map(str::to_owned);
        let name = part
            .iter()
            .fold(self.name.clone(), |name, part| format!("{name}:{part}"));
        Self {
            added_lines,
            part: part.or(self.part.clone()),
            ..Self::new(name, Bytes::Memory(table.into()))
        }
    }

    /// The same file, read at one of its members.
    ///
    /// # Errors
    /// If it cannot be unpacked.
    pub fn with_member(&self, member: &Member) -> Result<Self, RecordingError> {
        let name = &member.name;
        if member.packing == Packing::Unknown {
            let problem = RecordingProblem::Damaged {
                what: "zip archive",
                error: format!("{name} is encrypted, or packed by another method than deflate"),
                remedy: "unpack it",
            };
            return Err(self.error(None, problem));
        }
        Ok(Self {
            member: Some(member.clone()),
            part: Some(name.clone()),
            ..Self::new(format!("{}:{name}", self.name), self.bytes.clone())
        })
    }

    /// The size of its text, bytes.
    pub fn size(&self) -> u64 {
        match (&self.member, &self.bytes) {
            (Some(member), _) => member.unpacked,
            (None, Bytes::File(path)) => fs::metadata(path).map_or(0, |file| file.len()),
            (None, Bytes::Memory(bytes)) => bytes.len() as u64,
        }
    }

    /// The name in messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The member, the sheet or the sensor that is read.
    pub fn part(&self) -> Option<&str> {
        self.part.as_deref()
    }

    /// An error of this source, in a line if one is given.
    pub fn error(&self, line: Option<u64>, problem: RecordingProblem) -> RecordingError {
        let line = line.and_then(|line| line.checked_sub(self.added_lines));
        RecordingError {
            file: self.name.clone(),
            line: line.filter(|line| *line > 0),
            problem: Box::new(problem),
        }
    }

    /// Its bytes, which may be packed.
    pub fn bytes(&self) -> Result<Box<dyn ReadSeek>, RecordingError> {
        match &self.bytes {
            Bytes::File(path) => match File::open(path) {
                Ok(file) => Ok(Box::new(file)),
                Err(error) => Err(self.error(None, error.into())),
            },
            Bytes::Memory(bytes) => Ok(Box::new(Cursor::new(bytes.clone()))),
        }
    }

    /// Its text, from the start.
    pub fn text(&self) -> Result<Text, RecordingError> {
        let mut bytes = self.bytes()?;
        let Some(member) = &self.member else {
            return Ok(decoded(bytes));
        };
        bytes
            .seek(SeekFrom::Start(member.start))
            .map_err(|error| self.error(None, error.into()))?;
        let packed = BufReader::with_capacity(BUFFER, bytes).take(member.packed);
        let checksum = member.checksum;
        Ok(if member.packing == Packing::Deflated {
            decoded(Checked::new(DeflateDecoder::new(packed), checksum))
        } else {
            decoded(Checked::new(packed, checksum))
        })
    }
}

fn decoded(bytes: impl Read + Send + 'static) -> Text {
    let utf8 = DecodeReaderBytesBuilder::new()
        .utf8_passthru(true)
        .strip_bom(true)
        .bom_override(true)
        .build(bytes);
    Box::new(BufReader::with_capacity(BUFFER, utf8))
}

/// Unpacked bytes whose checksum is verified at their end.
struct Checked<R> {
    reader: CrcReader<R>,
    checksum: u32,
}

impl<R: Read> Checked<R> {
    fn new(reader: R, checksum: u32) -> Self {
        Self {
            reader: CrcReader::new(reader),
            checksum,
        }
    }
}

impl<R: Read> Read for Checked<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.reader.read(buffer)?;
        if read == 0 && !buffer.is_empty() && self.reader.crc().sum() != self.checksum {
            return Err(io::Error::new(
                io::ErrorKind::InvalidData,
                "the archive is damaged: a checksum differs",
            ));
        }
        Ok(read)
    }
}
