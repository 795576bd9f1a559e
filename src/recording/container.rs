//! The table of readings in a file of whatever kind: plain text, an archive, a workbook or JSON.

use super::error::RecordingError;
use super::layout::Quantity;
use super::reading::Reading;
use super::source::Source;
use super::{archive, json, sheet};

/// The table that is to be read.
///
/// # Errors
/// If the file is damaged, or no table of it or more than one can be meant.
pub(super) fn table(
    source: Source,
    reading: &Reading,
    quantity: Quantity,
) -> Result<Source, RecordingError> {
    let source = match archive::members(&source)? {
        Some(members) if sheet::is_book(&members) => sheet::table(&source, &members, reading)?,
        Some(members) => archive::table(&source, &members, reading, quantity)?,
        None => source,
    };
    json::table(source, reading, quantity)
}
