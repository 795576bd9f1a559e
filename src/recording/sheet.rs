//! A workbook's sheet as a table of text.
//!
//! A workbook (ECMA-376, part 1, §18) is an archive of XML: `workbook.xml` names the sheets, its relations tell
//! which part is which, texts stand once in a part that they share, and a format in the styles tells that a
//! number is a date.

use super::error::{RecordingError, RecordingProblem};
use super::moment::Moment;
use super::reading::Reading;
use super::source::{Member, Source};
use super::text_table::{MOST_COLUMNS, TextTable, too_large};
use super::xml::{self, Piece, attribute};
use quick_xml::events::BytesStart;
use std::collections::BTreeSet;

const BOOK: &str = "xl/workbook.xml";

/// The largest workbook, packed, bytes.
const LARGEST: u64 = 200 << 20;

/// The most rows, shared texts and styles.
const MOST_ROWS: usize = 1 << 20;
const TOO_MANY: &str = "must have at most 1048576 rows and texts";

/// Whether an archive is a workbook.
pub(super) fn is_book(members: &[Member]) -> bool {
    members.iter().any(|member| member.name == BOOK)
}

/// The sheet with the readings: the one named, or the first.
///
/// # Errors
/// If the workbook is damaged or too large, or has no such sheet.
pub(super) fn table(
    source: &Source,
    members: &[Member],
    reading: &Reading,
) -> Result<Source, RecordingError> {
    let book = Book { source, members };
    let damaged = |error| {
        let (what, remedy) = ("workbook", "export as CSV");
        let problem = RecordingProblem::Damaged {
            what,
            error,
            remedy,
        };
        source.error(None, problem)
    };
    if source.size() > LARGEST {
        return Err(damaged(too_large()));
    }
    let sheets = book.sheets().map_err(damaged)?;
    let wanted = match &reading.member {
        Some(name) => sheets.iter().find(|(of, _)| of == name),
        None => sheets.first(),
    };
    let Some((name, part)) = wanted else {
        let names = sheets.iter().map(|(name, _)| &**name);
        let got = reading.member.as_deref().unwrap_or_default();
        return Err(source.error(None, RecordingProblem::unknown("sheet", got, names)));
    };
    let text = book.text(part).map_err(damaged)?;
    Ok(source.converted(text, Some(name), 0))
}

struct Book<'a> {
    source: &'a Source,
    members: &'a [Member],
}

impl Book<'_> {
    fn has(&self, part: &str) -> bool {
        self.members.iter().any(|member| member.name == part)
    }

    /// Reads a part; errors name it.
    fn read(
        &self,
        part: &str,
        take: impl FnMut(Piece) -> Result<(), String>,
    ) -> Result<(), String> {
        let member = self.members.iter().find(|member| member.name == part);
        let member = member.ok_or_else(|| format!("there is no part {part}"))?;
        let text = (self.source.with_member(member))
            .and_then(|source| source.text())
            .map_err(|error| error.to_string())?;
        xml::read(text, take).map_err(|error| format!("{part}: {error}"))
    }

    /// The names of the sheets, and their parts.
    fn sheets(&self) -> Result<Vec<(String, String)>, String> {
        let mut parts = Vec::new();
        self.read("xl/_rels/workbook.xml.rels", |piece| {
            if let Piece::Start("Relationship", tag) = piece {
                let wanted = |name| Ok::<_, String>(attribute(tag, name)?.unwrap_or_default());
                let target = wanted("Target")?;
                let part = match target.strip_prefix('/') {
                    Some(part) => part.to_owned(),
                    None => format!("xl/{target}"),
                };
                if wanted("Type")?.ends_with("/worksheet") {
                    push(&mut parts, (wanted("Id")?, part))?;
                }
            }
            Ok(())
        })?;
        let mut sheets = Vec::new();
        self.read(BOOK, |piece| {
            if let Piece::Start("sheet", tag) = piece {
                let id = attribute(tag, "id")?;
                let part = parts.iter().find(|(of, _)| Some(of) == id.as_ref());
                if let (Some(name), Some((_, part))) = (attribute(tag, "name")?, part) {
                    push(&mut sheets, (name, part.clone()))?;
                }
            }
            Ok(())
        })?;
        Ok(sheets)
    }

    /// The number of 1970-01-01: days count from 1899-12-30, or on old Macs from 1904.
    fn epoch(&self) -> Result<f64, String> {
        let mut epoch = 25_569.0;
        self.read(BOOK, |piece| {
            if let Piece::Start("workbookPr", tag) = piece
                && matches!(attribute(tag, "date1904")?.as_deref(), Some("1" | "true"))
            {
                epoch -= 1462.0;
            }
            Ok(())
        })?;
        Ok(epoch)
    }

    /// The texts that cells share.
    fn shared(&self) -> Result<Vec<String>, String> {
        const PART: &str = "xl/sharedStrings.xml";
        let (mut shared, mut text) = (Vec::new(), Words::default());
        if !self.has(PART) {
            return Ok(shared);
        }
        self.read(PART, |piece| {
            text.take(&piece);
            if let Piece::End("si") = piece {
                push(&mut shared, text.end())?;
            }
            Ok(())
        })?;
        Ok(shared)
    }

    /// For each style of cells whether it shows numbers as dates.
    fn dates(&self) -> Result<Vec<bool>, String> {
        const PART: &str = "xl/styles.xml";
        let mut formats: BTreeSet<String> =
            (14..=22).chain(45..=47).map(|id| id.to_string()).collect();
        let (mut dates, mut is_of_cells) = (Vec::new(), false);
        if !self.has(PART) {
            return Ok(dates);
        }
        self.read(PART, |piece| {
            match piece {
                Piece::Start("numFmt", tag) => {
                    let code = attribute(tag, "formatCode")?.unwrap_or_default();
                    if is_date(&code) && formats.len() < MOST_ROWS {
                        formats.extend(attribute(tag, "numFmtId")?);
                    }
                }
                Piece::Start("cellXfs", _) => is_of_cells = true,
                Piece::End("cellXfs") => is_of_cells = false,
                Piece::Start("xf", tag) if is_of_cells => {
                    let format = attribute(tag, "numFmtId")?;
                    push(&mut dates, format.is_some_and(|id| formats.contains(&id)))?;
                }
                _ => {}
            }
            Ok(())
        })?;
        Ok(dates)
    }

    /// A line for each row, cells separated by tabs; columns beyond those of the first row with several are left
    /// out, since people calculate beside their readings.
    fn text(&self, part: &str) -> Result<Vec<u8>, String> {
        let (shared, dates, epoch) = (self.shared()?, self.dates()?, self.epoch()?);
        let (mut table, mut words) = (TextTable::default(), Words::default());
        let (mut cell, mut widest) = (Cell::default(), None);
        self.read(part, |piece| {
            words.take(&piece);
            let (row, column) = table.next();
            match piece {
                Piece::Start("row", tag) => match number(tag, "r")?.unwrap_or(row) {
                    row @ ..=MOST_ROWS => table.begin_row(row)?,
                    _ => return Err(TOO_MANY.to_owned()),
                },
                Piece::End("row") => {
                    if column > 1 && widest.is_none() {
                        widest = Some(column);
                    }
                    table.end_row(widest.unwrap_or(0));
                }
                Piece::Start("c", tag) => {
                    words.end();
                    cell = Cell::of(tag, &dates)?;
                }
                Piece::End("c") => {
                    let column = cell.column.unwrap_or(column);
                    if column < widest.unwrap_or(MOST_COLUMNS) {
                        table.cell(column, &cell.value(words.end(), &shared, epoch)?)?;
                    }
                }
                _ => {}
            }
            Ok(())
        })?;
        Ok(table.into_text())
    }
}

fn push<T>(list: &mut Vec<T>, item: T) -> Result<(), String> {
    if list.len() == MOST_ROWS {
        return Err(TOO_MANY.to_owned());
    }
    list.push(item);
    Ok(())
}

fn number(tag: &BytesStart, name: &str) -> Result<Option<usize>, String> {
    let value = attribute(tag, name)?;
    let parsed = value.map(|value| {
        value
            .parse()
            .map_err(|_| format!("{name}=\"{value}\" is no number"))
    });
    parsed.transpose()
}

/// Whether a format shows a number as a date: it has letters of dates beside literal text and colours.
fn is_date(code: &str) -> bool {
    let mut closing = None;
    code.chars().any(|c| match (closing, c) {
        (Some(end), c) => {
            closing = Some(end).filter(|end| *end != c);
            false
        }
        (None, '"') => {
            closing = Some('"');
            false
        }
        (None, '[') => {
            closing = Some(']');
            false
        }
        (None, c) => "dmyhsDMYHS".contains(c),
    })
}

/// The words of a cell as they come, without hints for their pronunciation.
#[derive(Default)]
struct Words {
    text: String,
    is_hint: bool,
}

impl Words {
    fn take(&mut self, piece: &Piece) {
        match piece {
            Piece::Start("rPh", _) => self.is_hint = true,
            Piece::End("rPh") => self.is_hint = false,
            Piece::Text("t" | "v", text) if !self.is_hint => {
                self.text.push_str(text);
            }
            _ => {}
        }
    }

    fn end(&mut self) -> String {
        std::mem::take(&mut self.text)
    }
}

/// What stands in the tag of a cell.
#[derive(Default)]
struct Cell {
    column: Option<usize>,
    kind: String,
    is_date: bool,
}

impl Cell {
    fn of(tag: &BytesStart, dates: &[bool]) -> Result<Self, String> {
        // "B12" is in the second column.
        let place = attribute(tag, "r")?.unwrap_or_default();
        let letters = place.bytes().take_while(u8::is_ascii_uppercase);
        let column = letters.fold(0usize, |column, letter| {
            column
                .saturating_mul(26)
                .saturating_add(usize::from(letter - b'A' + 1))
        });
        let style = number(tag, "s")?.unwrap_or(0);
        Ok(Self {
            column: column.checked_sub(1),
            kind: attribute(tag, "t")?.unwrap_or_default(),
            is_date: dates.get(style) == Some(&true),
        })
    }

    fn value(&self, words: String, shared: &[String], epoch: f64) -> Result<String, String> {
        Ok(match &*self.kind {
            _ if words.is_empty() => words,
            "s" => {
                let place: Option<usize> = words.trim().parse().ok();
                let found = place.and_then(|place| shared.get(place));
                found
                    .ok_or_else(|| format!("there is no shared text {words}"))?
                    .clone()
            }
            "b" => if words.trim() == "0" { "FALSE" } else { "TRUE" }.to_owned(),
            "e" => String::new(),
            "" | "n" if self.is_date => match words.trim().parse::<f64>() {
                Ok(days) if days >= 1.0 => Moment::of_days(days - epoch).to_string(),
                // A time of day.
                Ok(days) => (days * 86_400.0).to_string(),
                Err(_) => words,
            },
            _ => words,
        })
    }
}
