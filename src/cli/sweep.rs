//! `liftsim sweep CONFIG`: runs every point and writes counts and figure.

use super::{Failure, Outcome, Simulation, print, progress};
use clap::Args;
use liftsim::config::Config;
use liftsim::figure;
use liftsim::plan::Plan;
use liftsim::results::{self, Directory, Manifest, Row};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Run every point of an experiment; write points.csv, the figure and run.json.
///
/// The same config and seed give the same bytes on any machine, with any number of threads.
#[derive(Debug, Args)]
pub struct Sweep {
    #[command(flatten)]
    simulation: Simulation,
    /// Where to write; results/<name of the config>/ by default.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Start over, replacing whatever experiment the directory holds.
    #[arg(long)]
    fresh: bool,
}

impl Sweep {
    /// Runs the command.
    pub fn run(self, quiet: bool) -> Outcome {
        let (config, plan) = self.simulation.prepare(Plan::new)?;
        let directory = Directory::new(
            self.out
                .clone()
                .unwrap_or_else(|| default_directory(&self.simulation.config)),
        );
        directory.admit(&plan, self.fresh).map_err(Failure::input)?;

        let start = Instant::now();
        let (decisions, outcome) = progress::simulate(&plan, &[], quiet)?;
        let seconds = start.elapsed().as_secs_f64();

        let rows: Vec<Row> = (plan.points.iter().zip(&decisions).zip(outcome.tallies))
            .map(|((point, decision), tally)| {
                Row::new(point, Some(decision), tally, config.confidence)
            })
            .collect();
        write(&directory, &config, &rows, seconds)?;
        Ok(ExitCode::SUCCESS)
    }
}

/// results/<file stem>.
fn default_directory(config: &Path) -> PathBuf {
    Path::new("results").join(config.file_stem().unwrap_or(config.as_os_str()))
}

/// Writes counts, then pictures, then the manifest that vouches for both, and says what is new.
fn write(
    directory: &Directory,
    config: &Config,
    rows: &[Row],
    seconds: f64,
) -> Result<(), Failure> {
    let mut manifest = manifest(config, seconds);
    let drawing = figure::sweep(config, rows, &manifest).map_err(Failure::run)?;
    let counts = results::csv_bytes(rows);
    let mut report = store(directory, &mut manifest, "points.csv", &counts)?;
    for (name, bytes) in drawing.files() {
        report += &store(directory, &mut manifest, name, bytes)?;
    }
    directory
        .write("run.json", &manifest.to_json())
        .map_err(Failure::run)?;
    report += &format!("{}  written\n", directory.path().join("run.json").display());
    let trials = config.trials;
    print(&format!(
        "{} points of {trials} trials in {seconds:.1} s\n{report}",
        rows.len()
    ))
}

/// Writes a file, lets the manifest vouch for it, and says whether it is new.
pub(super) fn store(
    directory: &Directory,
    manifest: &mut Manifest,
    name: &str,
    bytes: &[u8],
) -> Result<String, Failure> {
    let is_new = directory.write(name, bytes).map_err(Failure::run)?;
    manifest
        .files
        .insert(name.to_owned(), results::sha256(bytes));
    let note = if is_new { "written" } else { "unchanged" };
    Ok(format!(
        "{}  {note}\n",
        directory.path().join(name).display()
    ))
}

fn manifest(config: &Config, seconds: f64) -> Manifest {
    Manifest {
        config_name: file_name(config.name()),
        config: config.text().to_owned(),
        config_sha256: results::sha256(config.text().as_bytes()),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        revision: env!("LIFTSIM_REVISION").to_owned(),
        command: command_line(config),
        seed: config.seed,
        trials: config.trials,
        common_random_numbers: config.common_random_numbers,
        seconds,
        threads: rayon::current_num_threads(),
        architecture: architecture(),
        files: BTreeMap::new(),
    }
}

/// The command that makes the same results, wherever the files are.
fn command_line(config: &Config) -> String {
    let Config { seed, trials, .. } = config;
    format!(
        "liftsim sweep {} --seed {seed} --trials {trials}",
        file_name(config.name())
    )
}

fn file_name(path: &str) -> String {
    let name = Path::new(path).file_name();
    name.map_or(path.to_owned(), |name| name.to_string_lossy().into_owned())
}

/// The processor family, and which vector instructions it offers.
fn architecture() -> String {
    #[cfg(target_arch = "x86_64")]
    let features = [
        ("avx2", std::is_x86_feature_detected!("avx2")),
        ("fma", std::is_x86_feature_detected!("fma")),
        ("avx512f", std::is_x86_feature_detected!("avx512f")),
    ];
    #[cfg(not(target_arch = "x86_64"))]
    let features: [(&str, bool); 0] = [];
    let present = features
        .iter()
        .filter(|(_, present)| *present)
        .map(|(name, _)| *name);
    [std::env::consts::ARCH]
        .into_iter()
        .chain(present)
        .collect::<Vec<_>>()
        .join(" ")
}
