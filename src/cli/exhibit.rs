//! Experiments that are no sweep: computed and written, or drawn again from what was written.

use super::store::{Written, manifest, write_all};
use super::{Failure, Outcome, print, table};
use liftsim::claim::Evidence;
use liftsim::config::ExhibitConfig;
use liftsim::exhibit::{self, Exhibit, Rows, independence};
use liftsim::figure::{self, Drawing};
use liftsim::report::Section;
use liftsim::results::{self, Directory, Manifest, Origin, file_name};
use std::process::ExitCode;
use std::time::Instant;

/// Computes an exhibit and writes it into `directory`, unless that holds something else.
pub fn run(config: &ExhibitConfig, directory: &Directory, fresh: bool) -> Outcome {
    let _lock = directory.lock().map_err(Failure::input)?;
    (directory.admit_exhibit(config, fresh)).map_err(Failure::input)?;
    rehearse(config)?;
    let (made, seconds) = compute(config)?;
    let written = write(directory, config, &made, seconds)?;
    print(&format!(
        "{}{} rows of [{}] in {seconds:.1} s\n{}",
        findings(&made.rows),
        made.rows.len(),
        config.kind.name(),
        written.files
    ))?;
    Ok(ExitCode::SUCCESS)
}

/// Judges the claims and fills the text once on as few trials as there can be, so that what they name
/// is known to be there before anything takes long.
pub fn rehearse(config: &ExhibitConfig) -> Result<(), Failure> {
    let short = config.clone().with_trials(2).map_err(Failure::input)?;
    let (made, _) = compute(&short)?;
    let section = Section {
        name: String::new(),
        config: file_name(config.name()),
        question: config.question.clone(),
        narrative: config.narrative.clone(),
        trials: 2,
        evidence: Evidence {
            quantities: made.quantities,
            ..Evidence::default()
        },
    };
    section.judge().map(drop).map_err(Failure::input)
}

/// What it comes to, and the seconds that took.
pub fn compute(config: &ExhibitConfig) -> Result<(Exhibit, f64), Failure> {
    let start = Instant::now();
    let made = exhibit::compute(config).map_err(Failure::input)?;
    Ok((made, start.elapsed().as_secs_f64()))
}

/// Writes rows, numbers and pictures.
pub fn write(
    directory: &Directory,
    config: &ExhibitConfig,
    made: &Exhibit,
    seconds: f64,
) -> Result<Written, Failure> {
    let manifest = manifest(&Origin::from(config), seconds);
    let drawing = figure::exhibit(config, &made.rows, &manifest).map_err(Failure::run)?;
    let mut files = vec![("points.csv", made.rows.csv())];
    if !made.quantities.is_empty() {
        files.push(("quantities.csv", results::csv_bytes(&made.quantities)));
    }
    files.extend(drawing.files().map(|(name, bytes)| (name, bytes.to_vec())));
    write_all(directory, manifest, &files)
}

/// The picture of an exhibit, from the rows that `directory` holds.
pub fn redraw(
    config: &ExhibitConfig,
    directory: &Directory,
    manifest: &Manifest,
) -> Result<Drawing, Failure> {
    let points = directory.points(manifest).map_err(Failure::input)?;
    let rows = Rows::from_csv(&config.kind, &points)
        .map_err(|error| Failure::input(directory.damaged_points(error)))?;
    figure::exhibit(config, &rows, manifest).map_err(Failure::run)
}

/// What an enumeration found, as a table; nothing of other exhibits.
fn findings(rows: &Rows) -> String {
    let Rows::Independence(rows) = rows else {
        return String::new();
    };
    let findings = independence::findings(rows);
    let lines: Vec<Vec<String>> = findings
        .iter()
        .map(|finding| {
            vec![
                finding.sizes.map(|size| size.to_string()).join("/"),
                finding.assignments.to_string(),
                finding.cells.to_string(),
                finding.largest_difference.to_string(),
            ]
        })
        .collect();
    let header = [
        "N/M1/M2",
        "assignments",
        "cells",
        "largest |n(w,t) n - n(w) n(t)|",
    ];
    table(&header, &lines) + "\n"
}
