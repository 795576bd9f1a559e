//! A workbook's sheet as a table of text.

use super::error::{RecordingError, RecordingProblem};
use super::reading::Reading;
use super::source::Source;
use calamine::{DataRef, Reader, Xlsx};
use std::io::{Cursor, Read, Write, sink};
use zip::ZipArchive;

/// The largest workbook, packed and unpacked, bytes: a library keeps parts of it in memory.
const LARGEST: (u64, u64) = (200 << 20, 1 << 30);

/// The most columns, and the most letters in a cell: a few bytes of a workbook may stand for any number.
const MOST_COLUMNS: u32 = 64;
const MOST_LETTERS: usize = 200;

/// The sheet with the readings: the one named, or the first.
///
/// # Errors
/// If the workbook is damaged or too large, or has no such sheet.
pub(super) fn table(source: &Source, reading: &Reading) -> Result<Source, RecordingError> {
    let damaged = |error: String| source.error(None, RecordingProblem::Workbook(error));
    let mut bytes = Vec::new();
    let mut packed = source.bytes()?.take(LARGEST.0 + 1);
    packed
        .read_to_end(&mut bytes)
        .map_err(|error| damaged(error.to_string()))?;
    check_size(&bytes).map_err(damaged)?;
    let mut book = Xlsx::new(Cursor::new(bytes)).map_err(|error| damaged(error.to_string()))?;
    let sheets = book.sheet_names();
    let wanted = reading.member.as_ref().or(sheets.first());
    let Some(name) = wanted.filter(|name| sheets.contains(name)) else {
        let got = reading.member.as_deref().unwrap_or_default();
        let problem = RecordingProblem::unknown_member(got, sheets);
        return Err(source.error(None, problem));
    };
    let text = text(&mut book, name).map_err(|error| damaged(error.to_string()))?;
    Ok(source.converted(text, Some(name), 0))
}

/// Unpacks every part once to nowhere, since an archive may not tell its true size.
fn check_size(bytes: &[u8]) -> Result<(), String> {
    let too_large = || "is too large".to_owned();
    if bytes.len() as u64 > LARGEST.0 {
        return Err(too_large());
    }
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| error.to_string())?;
    let mut left = LARGEST.1;
    for index in 0..archive.len() {
        let part = archive.by_index(index).map_err(|error| error.to_string())?;
        let size = std::io::copy(&mut part.take(left + 1), &mut sink());
        let size = size.map_err(|error| error.to_string())?;
        left = left.checked_sub(size).ok_or_else(too_large)?;
    }
    Ok(())
}

/// A line for each row, cells separated by tabs; columns beyond those of the first row with several are left
/// out, since people calculate beside their readings.
fn text(book: &mut Xlsx<Cursor<Vec<u8>>>, name: &str) -> Result<Vec<u8>, calamine::XlsxError> {
    let mut cells = book.worksheet_cells_reader(name)?;
    let (mut text, mut row, mut column) = (Vec::new(), 0, 0);
    let mut widest = None;
    while let Some(cell) = cells.next_cell()? {
        let (at_row, at_column) = cell.get_position();
        if at_row < row || at_row >= 1 << 20 || at_column >= widest.unwrap_or(MOST_COLUMNS) {
            continue;
        }
        if at_row > row {
            if column > 0 && widest.is_none() {
                widest = Some(column + 1);
            }
            text.resize(text.len() + (at_row - row) as usize, b'\n');
            (row, column) = (at_row, 0);
        }
        if at_column < column {
            continue;
        }
        text.resize(text.len() + (at_column - column) as usize, b'\t');
        column = at_column;
        let written = match cell.get_value() {
            DataRef::Float(number) => write!(text, "{number}"),
            DataRef::Int(number) => write!(text, "{number}"),
            // Days.
            DataRef::DateTime(moment) => write!(text, "{}", moment.as_f64() * 86_400.0),
            DataRef::String(words) => text.write_all(one_cell(words).as_bytes()),
            DataRef::SharedString(words) => text.write_all(one_cell(words).as_bytes()),
            DataRef::DateTimeIso(words) => text.write_all(one_cell(words).as_bytes()),
            _ => Ok(()),
        };
        written.expect("a vector takes it");
    }
    Ok(text)
}

fn one_cell(words: &str) -> String {
    let plain = |c: char| if c.is_control() || c == '"' { ' ' } else { c };
    words.chars().take(MOST_LETTERS).map(plain).collect()
}
