//! Experiments that are no sweep: computed and written, or drawn again from what was written.

use super::sweep::{Origin, manifest, store_all};
use super::{Failure, Outcome, print, table};
use liftsim::config::ExhibitConfig;
use liftsim::exhibit::{self, Rows, independence};
use liftsim::figure::{self, Drawing};
use liftsim::results::{self, Directory, Manifest};
use std::process::ExitCode;
use std::time::Instant;

/// Computes an exhibit and writes rows, numbers and pictures into `directory`, unless that holds
/// something else.
pub fn run(config: &ExhibitConfig, directory: &Directory, fresh: bool) -> Outcome {
    (directory.admit_exhibit(config, fresh)).map_err(Failure::input)?;
    let start = Instant::now();
    let made = exhibit::compute(config).map_err(Failure::input)?;
    let seconds = start.elapsed().as_secs_f64();

    let mut manifest = manifest(&origin(config), seconds);
    let drawing = figure::exhibit(config, &made.rows, &manifest).map_err(Failure::run)?;
    let (points, quantities) = (made.rows.csv(), results::csv_bytes(&made.quantities));
    let [png, svg] = drawing.files();
    let mut files = vec![("points.csv", &points[..]), png, svg];
    if !made.quantities.is_empty() {
        files.insert(1, ("quantities.csv", &quantities));
    }
    let report = store_all(directory, &mut manifest, &files)?;
    let findings = findings(&made.rows);
    print(&format!(
        "{findings}{} rows of [{}] in {seconds:.1} s\n{report}",
        made.rows.len(),
        config.kind.name()
    ))?;
    Ok(ExitCode::SUCCESS)
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

fn origin(config: &ExhibitConfig) -> Origin<'_> {
    Origin {
        name: config.name(),
        text: config.text(),
        seed: config.seed,
        trials: config.trials,
        common_random_numbers: true,
    }
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
