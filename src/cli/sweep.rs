//! `liftsim sweep CONFIG`: runs every point and writes counts and figure.

use super::{Failure, Outcome, Simulation, print, progress};
use clap::Args;
use indicatif::ProgressBar;
use liftsim::claim::{self, Pair};
use liftsim::config::Config;
use liftsim::figure;
use liftsim::plan::Plan;
use liftsim::report::Section;
use liftsim::results::{self, Comparison, Directory, Manifest, Row};
use liftsim::run;
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

        let bar = progress::bar(&plan, quiet);
        let counts = Counts::simulate(&config, &plan, &bar);
        let written = write(
            &directory,
            &config,
            &plan,
            &counts,
            manifest(&config, &counts),
        )?;
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
    pub tallies: Vec<Tally>,
    /// Pairs of points that claims compare.
    pub pairs: Vec<Pair>,
    /// One per pair: trials in which the first alone and the second alone decided for H1, where the
    /// two share their noise.
    pub discordant: Vec<Option<[u64; 2]>>,
    /// Wall clock of the simulation.
    pub seconds: f64,
}

impl Counts {
    /// Runs every trial.
    pub fn simulate(config: &Config, plan: &Plan, bar: &ProgressBar) -> Self {
        let pairs = claim::pairs(config, &plan.points);
        let start = Instant::now();
        let tallies = run::run(plan, |work| bar.inc(work));
        // The discordant counts of pairs that share their noise belong here once a run counts them.
        let discordant = vec![None; pairs.len()];
        bar.finish_and_clear();
        Self {
            tallies,
            pairs,
            discordant,
            seconds: start.elapsed().as_secs_f64(),
        }
    }

    fn rows(&self, config: &Config, plan: &Plan) -> Vec<Row> {
        let points = plan.points.iter().zip(&self.tallies);
        points
            .map(|(point, tally)| Row::new(point, *tally, config.confidence))
            .collect()
    }

    fn comparisons(&self, config: &Config) -> Vec<Comparison> {
        let claims = &config.narrative.claims;
        claim::comparisons(claims, &self.pairs, &self.tallies, &self.discordant)
    }
}

/// Judges the claims and fills the text once on empty counts, so that what they name is known to be
/// there before anything is simulated.
pub(super) fn rehearse(config: &Config, plan: &Plan) -> Result<(), Failure> {
    let pairs = claim::pairs(config, &plan.points);
    let empty = Counts {
        tallies: vec![Tally { hits: 0, trials: 1 }; plan.points.len()],
        discordant: vec![None; pairs.len()],
        pairs,
        seconds: 0.0,
    };
    let section = Section {
        name: String::new(),
        config: file_name(config.name()),
        question: config.question.clone(),
        narrative: config.narrative.clone(),
        axis: Some(config.axis.clone()),
        trials: 1,
        rows: empty.rows(config, plan),
        comparisons: empty.comparisons(config),
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
    plan: &Plan,
    counts: &Counts,
    mut manifest: Manifest,
) -> Result<Written, Failure> {
    let rows = counts.rows(config, plan);
    let drawing = figure::sweep(config, &rows, &manifest).map_err(Failure::run)?;
    let mut files = vec![("points.csv", results::csv_bytes(&rows))];
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
