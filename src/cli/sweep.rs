//! `liftsim sweep CONFIG`: runs every point, or draws what is no sweep, and writes results and figure.

use super::{Failure, Outcome, Simulation, exhibit, print, progress};
use clap::Args;
use liftsim::config::{Config, Experiment};
use liftsim::figure;
use liftsim::plan::Plan;
use liftsim::results::{self, Directory, Manifest, Row};
use liftsim::run;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Run every point of an experiment; write points.csv, the figure and run.json.
///
/// A config that says what to draw instead of what to sweep is computed and drawn in the same way,
/// with single numbers in quantities.csv where it has any.
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
        let directory = Directory::new(
            self.out
                .clone()
                .unwrap_or_else(|| default_directory(&self.simulation.config)),
        );
        let path = &self.simulation.config;
        let config = match Experiment::load(path).map_err(Failure::input)? {
            Experiment::Sweep(config) => config,
            Experiment::Exhibit(config) => {
                let config = self.simulation.exhibit(*config)?;
                return exhibit::run(&config, &directory, self.fresh);
            }
        };
        let (config, plan) = self.simulation.plan(config, Plan::new)?;
        directory.admit(&plan, self.fresh).map_err(Failure::input)?;

        let bar = progress::bar(&plan, quiet);
        let start = Instant::now();
        let tallies = run::run(&plan, |work| bar.inc(work));
        let seconds = start.elapsed().as_secs_f64();
        bar.finish_and_clear();

        let rows: Vec<Row> = (plan.points.iter().zip(tallies))
            .map(|(point, tally)| Row::new(point, tally, config.confidence))
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
    let mut manifest = manifest(&Origin::of(config), seconds);
    let drawing = figure::sweep(config, rows, &manifest).map_err(Failure::run)?;
    let counts = results::csv_bytes(rows);
    let [png, svg] = drawing.files();
    let report = store_all(
        directory,
        &mut manifest,
        &[("points.csv", &counts), png, svg],
    )?;
    let trials = config.trials;
    print(&format!(
        "{} points of {trials} trials in {seconds:.1} s\n{report}",
        rows.len()
    ))
}

/// Writes files, then the manifest that vouches for them, and says what is new.
pub(super) fn store_all(
    directory: &Directory,
    manifest: &mut Manifest,
    files: &[(&str, &[u8])],
) -> Result<String, Failure> {
    let mut report = String::new();
    for (name, bytes) in files {
        report += &store(directory, manifest, name, bytes)?;
    }
    directory
        .write("run.json", &manifest.to_json())
        .map_err(Failure::run)?;
    Ok(report + &format!("{}  written\n", directory.path().join("run.json").display()))
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

/// What a manifest says of an experiment before it is run.
pub(super) struct Origin<'a> {
    pub name: &'a str,
    pub text: &'a str,
    pub seed: u64,
    pub trials: u64,
    pub common_random_numbers: bool,
}

impl<'a> Origin<'a> {
    fn of(config: &'a Config) -> Self {
        Self {
            name: config.name(),
            text: config.text(),
            seed: config.seed,
            trials: config.trials,
            common_random_numbers: config.common_random_numbers,
        }
    }

    /// The command that makes the same results, wherever the files are.
    fn command_line(&self) -> String {
        let Self { seed, trials, .. } = self;
        format!(
            "liftsim sweep {} --seed {seed} --trials {trials}",
            file_name(self.name)
        )
    }
}

pub(super) fn manifest(origin: &Origin, seconds: f64) -> Manifest {
    Manifest {
        config_name: file_name(origin.name),
        config: origin.text.to_owned(),
        config_sha256: results::sha256(origin.text.as_bytes()),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        revision: env!("LIFTSIM_REVISION").to_owned(),
        command: origin.command_line(),
        seed: origin.seed,
        trials: origin.trials,
        common_random_numbers: origin.common_random_numbers,
        seconds,
        threads: rayon::current_num_threads(),
        architecture: architecture(),
        files: BTreeMap::new(),
    }
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
