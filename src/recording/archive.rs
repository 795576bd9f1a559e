//! The one member of a zip archive that is a table of accelerations.
//!
//! phyphox packs its table with a `meta` folder of tables about the device; Sensor Logger packs one table
//! for each sensor, all with the same columns, so that only their names distinguish them. Of several
//! accelerations the one with gravity is taken, because it shows which way is up.

use super::error::{Names, RecordingError, RecordingProblem};
use super::layout::Quantity;
use super::reading::Reading;
use super::source::{Member, Packing, Source};
use super::table::Columns;
use std::io::{self, Read};
use zip::result::ZipError;
use zip::{CompressionMethod, ZipArchive};

const NOT_A_ZIP: &str = "ends in .zip, but is not a zip archive (download it again)";

const NO_ACCELERATION: &str = "zip archive: no member is a table of accelerations, it holds";
const NO_BAROMETER: &str = "zip archive: no member is a table of a barometer, it holds";
const ACCELERATIONS: &str = "zip archive: several members are tables of accelerations:";
pub(super) const BAROMETERS: &str = "zip archive: several members are tables of a barometer:";

/// The members of an archive, or none if the source is no archive.
///
/// # Errors
/// If an archive is damaged, or a file of another kind is called one.
pub(super) fn members(source: &Source) -> Result<Option<Vec<Member>>, RecordingError> {
    if is_archive(source)? {
        return directory(source).map(Some);
    }
    if source.name().to_lowercase().ends_with(".zip") {
        return Err(source.error(None, RecordingProblem::Simple(NOT_A_ZIP)));
    }
    Ok(None)
}

fn is_archive(source: &Source) -> Result<bool, RecordingError> {
    let mut start = Vec::new();
    let unreadable = |error| source.error(None, io::Error::into(error));
    let mut bytes = source.bytes()?.take(4);
    bytes.read_to_end(&mut start).map_err(unreadable)?;
    // A file header, or the end of an archive without files.
    Ok(start == b"PK\x03\x04" || start == b"PK\x05\x06")
}

/// The member that is the table to be read.
///
/// # Errors
/// If there is no suitable table or more than one.
pub(super) fn table(
    source: &Source,
    members: &[Member],
    reading: &Reading,
    quantity: Quantity,
) -> Result<Source, RecordingError> {
    let names = || members.iter().map(|member| &*member.name);
    if let Some(wanted) = &reading.member {
        let found = members.iter().find(|member| member.name == *wanted);
        let unknown = || source.error(None, RecordingProblem::unknown("member", wanted, names()));
        return source.with_member(found.ok_or_else(unknown)?);
    }
    let candidates: Vec<&Member> = members
        .iter()
        .filter(|member| may_be_table(member))
        .collect();
    if let [only] = candidates[..] {
        // An error of the only table is more helpful than "no table".
        return source.with_member(only);
    }
    let mut tables = Vec::new();
    for candidate in candidates {
        let table = source.with_member(candidate)?;
        if let Ok((parser, _)) = Columns::begin(&table, reading, quantity) {
            tables.push((parser.layout.includes_gravity(table.name()), table));
        }
    }
    let with_gravity = tables.iter().filter(|(gravity, _)| *gravity).count();
    if with_gravity == 1 {
        tables.retain(|(gravity, _)| *gravity);
    }
    if let [_] = tables[..] {
        return Ok(tables.remove(0).1);
    }
    let found = tables.iter().filter_map(|(_, table)| table.part());
    let (what, names, remedy) = match (quantity, tables.is_empty()) {
        (Quantity::Acceleration, true) => (NO_ACCELERATION, Names::of(names()), "export as CSV"),
        (Quantity::Pressure, true) => (NO_BAROMETER, Names::of(names()), "export as CSV"),
        (Quantity::Acceleration, false) => (ACCELERATIONS, Names::of(found), "--member NAME"),
        (Quantity::Pressure, false) => (
            BAROMETERS,
            Names::of(found),
            "unpack it, and give one of them: --barometer FILE",
        ),
    };
    let problem = RecordingProblem::Among {
        what,
        names,
        remedy,
    };
    Err(source.error(None, problem))
}

/// Whether it may be a table of readings: not a table about the device, and not a file left by a system.
fn may_be_table(member: &Member) -> bool {
    let name = member.name.to_lowercase();
    let is_text = [".csv", ".txt", ".tsv"]
        .iter()
        .any(|end| name.ends_with(end));
    let mut parts = name.split('/');
    is_text && !parts.any(|part| part == "meta" || part == "__macosx" || part.starts_with('.'))
}

fn directory(source: &Source) -> Result<Vec<Member>, RecordingError> {
    let damaged = |error: ZipError| {
        let problem = RecordingProblem::Damaged {
            what: "zip archive",
            error: error.to_string(),
            remedy: "export it anew",
        };
        source.error(None, problem)
    };
    let mut archive = ZipArchive::new(source.bytes()?).map_err(damaged)?;
    let mut members = Vec::new();
    for index in 0..archive.len() {
        let file = archive.by_index_raw(index).map_err(damaged)?;
        let name = file.name().map_err(damaged)?.into_owned();
        let (Some(start), false) = (file.data_start(), file.is_dir()) else {
            continue;
        };
        members.push(Member {
            name,
            start,
            packed: file.compressed_size(),
            unpacked: file.size(),
            checksum: file.crc32(),
            packing: match file.compression() {
                _ if file.encrypted() => Packing::Unknown,
                CompressionMethod::Deflated => Packing::Deflated,
                CompressionMethod::Stored => Packing::Stored,
                _ => Packing::Unknown,
            },
        });
    }
    Ok(members)
}
