//! `liftsim sweep CONFIG`: runs every point and writes counts and figure.

use super::{Failure, Outcome, Simulation, print, progress};
use clap::Args;
use liftsim::claim::{self, Pair};
use liftsim::config::Config;
use liftsim::figure;
use liftsim::plan::Plan;
use liftsim::report::Section;
use liftsim::results::{self, Comparison, Directory, Manifest, Row};
use liftsim::tally::Tally;
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

        rehearse(&config, &plan)?;

        let counts = Counts::simulate(&config, &plan, "", quiet)?;
        let written = write(&directory, &config, &counts, manifest(&config, &counts))?;
        let Config { trials, .. } = config;
        let (points, seconds) = (plan.points.len(), counts.seconds);
        print(&format!(
            "{points} points of {trials} trials in {seconds:.1} s\n{}",
            written.files
        ))?;
        Ok(ExitCode::SUCCESS)
    }
}

/// What a plan came to.
pub(super) struct Counts {
    /// One per point.
    pub rows: Vec<Row>,
    /// Pairs of points that claims compare.
    pub pairs: Vec<Pair>,
    /// One per pair: trials in which the first alone and the second alone decided for H1, where the
    /// two share their noise.
    pub discordant: Vec<Option<[u64; 2]>>,
    /// Wall clock of the simulation.
    pub seconds: f64,
}

impl Counts {
    /// Runs every trial, with `prefix` before the bar.
    pub fn simulate(
        config: &Config,
        plan: &Plan,
        prefix: &str,
        quiet: bool,
    ) -> Result<Self, Failure> {
        let pairs = claim::pairs(config, &plan.points);
        let places: Vec<[usize; 2]> =
            (pairs.iter().map(|pair| [pair.first, pair.second])).collect();
        let start = Instant::now();
        let (decisions, outcome) = progress::simulate(plan, &places, prefix, quiet)?;
        let points = plan.points.iter().zip(&decisions).zip(outcome.tallies);
        Ok(Self {
            rows: points
                .map(|((point, decision), tally)| {
                    Row::new(point, Some(decision), tally, config.confidence)
                })
                .collect(),
            pairs,
            discordant: outcome.discordant,
            seconds: start.elapsed().as_secs_f64(),
        })
    }

    /// What would be counted in one trial in which nothing happens.
    fn empty(config: &Config, plan: &Plan) -> Self {
        let pairs = claim::pairs(config, &plan.points);
        let nothing = Tally { hits: 0, trials: 1 };
        let points = plan.points.iter();
        Self {
            rows: points
                .map(|point| Row::new(point, None, nothing, config.confidence))
                .collect(),
            discordant: vec![None; pairs.len()],
            pairs,
            seconds: 0.0,
        }
    }

    fn comparisons(&self, config: &Config) -> Vec<Comparison> {
        let claims = &config.narrative.claims;
        let tallies: Vec<Tally> = self.rows.iter().map(Row::tally).collect();
        claim::comparisons(claims, &self.pairs, &tallies, &self.discordant)
    }
}

/// Judges the claims and fills the text once on empty counts, so that what they name is known to be
/// there before anything is simulated.
pub(super) fn rehearse(config: &Config, plan: &Plan) -> Result<(), Failure> {
    let empty = Counts::empty(config, plan);
    let section = Section {
        name: String::new(),
        config: file_name(config.name()),
        question: config.question.clone(),
        narrative: config.narrative.clone(),
        axis: Some(config.axis.clone()),
        trials: 1,
        comparisons: empty.comparisons(config),
        rows: empty.rows,
        quantities: Vec::new(),
    };
    section.judge().map(drop).map_err(Failure::input)
}

/// results/<file stem>.
fn default_directory(config: &Path) -> PathBuf {
    Path::new("results").join(config.file_stem().unwrap_or(config.as_os_str()))
}

/// What has been written.
pub(super) struct Written {
    /// A line per file.
    pub files: String,
    /// Whether a file other than the manifest has new bytes.
    pub is_new: bool,
}

/// Writes counts, then pictures, then the manifest that vouches for both.
pub(super) fn write(
    directory: &Directory,
    config: &Config,
    counts: &Counts,
    mut manifest: Manifest,
) -> Result<Written, Failure> {
    let drawing = figure::sweep(config, &counts.rows, &manifest).map_err(Failure::run)?;
    let mut files = vec![("points.csv", results::csv_bytes(&counts.rows))];
    if !counts.pairs.is_empty() {
        let comparisons = results::csv_bytes(&counts.comparisons(config));
        files.push(("comparisons.csv", comparisons));
    }
    files.extend(drawing.files().map(|(name, bytes)| (name, bytes.to_vec())));
    let mut written = Written {
        files: String::new(),
        is_new: false,
    };
    for (name, bytes) in files {
        let is_new = store(directory, &mut manifest, name, &bytes)?;
        written.files += &line(directory, name, is_new);
        written.is_new |= is_new;
    }
    directory
        .write("run.json", &manifest.to_json())
        .map_err(Failure::run)?;
    directory.remove_stale(&manifest).map_err(Failure::run)?;
    written.files += &line(directory, "run.json", true);
    Ok(written)
}

/// Writes a file, lets the manifest vouch for it, and says whether it is new.
pub(super) fn store(
    directory: &Directory,
    manifest: &mut Manifest,
    name: &str,
    bytes: &[u8],
) -> Result<bool, Failure> {
    let is_new = directory.write(name, bytes).map_err(Failure::run)?;
    manifest
        .files
        .insert(name.to_owned(), results::sha256(bytes));
    Ok(is_new)
}

/// A file and whether it is new.
pub(super) fn line(directory: &Directory, name: &str, is_new: bool) -> String {
    let note = if is_new { "written" } else { "unchanged" };
    format!("{}  {note}\n", directory.path().join(name).display())
}

/// How these counts of a config came about.
pub(super) fn manifest(config: &Config, counts: &Counts) -> Manifest {
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
        seconds: counts.seconds,
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

/// Without the way to it.
pub(super) fn file_name(path: &str) -> String {
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
