//! `liftsim sweep CONFIG`: runs every point, or draws what is no sweep, and writes results and figure.

use super::store::{Origin, Written, file_name, manifest, write_all};
use super::{Failure, Outcome, Simulation, exhibit, print, progress};
use clap::Args;
use liftsim::claim::{self, Evidence, Pair};
use liftsim::config::{Config, Experiment};
use liftsim::figure;
use liftsim::plan::Plan;
use liftsim::report::Section;
use liftsim::results::{self, Comparison, Directory, Manifest, Quantity, Row};
use liftsim::tally::Tally;
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
            Experiment::Sweep(config) => *config,
            Experiment::Exhibit(config) => {
                let config = self.simulation.exhibit(*config)?;
                return exhibit::run(&config, &directory, self.fresh);
            }
        };
        let (config, plan) = self.simulation.plan(config, Plan::new)?;
        directory.admit(&plan, self.fresh).map_err(Failure::input)?;

        rehearse(&config, &plan)?;

        let counts = Counts::simulate(&config, &plan, "", quiet)?;
        let manifest = manifest(&Origin::from(&config), counts.seconds);
        let written = write(&directory, &config, &counts, manifest)?;
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

    fn quantities(&self, config: &Config) -> Result<Vec<Quantity>, Failure> {
        let evidence = Evidence {
            axis: Some(&config.axis),
            rows: &self.rows,
            comparisons: &[],
            quantities: &[],
        };
        claim::gains(&config.narrative.claims, &evidence).map_err(Failure::input)
    }
}

/// Judges the claims and fills the text once on empty counts, so that what they name is known to be
/// there before anything is simulated.
pub(super) fn rehearse(config: &Config, plan: &Plan) -> Result<(), Failure> {
    let empty = Counts::empty(config, plan);
    let quantities = empty.quantities(config)?;
    let section = Section {
        name: String::new(),
        config: file_name(config.name()),
        question: config.question.clone(),
        narrative: config.narrative.clone(),
        axis: Some(config.axis.clone()),
        trials: 1,
        comparisons: empty.comparisons(config),
        rows: empty.rows,
        quantities,
    };
    section.judge().map(drop).map_err(Failure::input)
}

/// results/<file stem>.
fn default_directory(config: &Path) -> PathBuf {
    Path::new("results").join(config.file_stem().unwrap_or(config.as_os_str()))
}

/// Writes counts, then pictures, then the manifest that vouches for both.
pub(super) fn write(
    directory: &Directory,
    config: &Config,
    counts: &Counts,
    manifest: Manifest,
) -> Result<Written, Failure> {
    let drawing = figure::sweep(config, &counts.rows, &manifest).map_err(Failure::run)?;
    let mut files = vec![("points.csv", results::csv_bytes(&counts.rows))];
    if !counts.pairs.is_empty() {
        let comparisons = results::csv_bytes(&counts.comparisons(config));
        files.push(("comparisons.csv", comparisons));
    }
    let quantities = counts.quantities(config)?;
    if !quantities.is_empty() {
        files.push(("quantities.csv", results::csv_bytes(&quantities)));
    }
    files.extend(drawing.files().map(|(name, bytes)| (name, bytes.to_vec())));
    write_all(directory, manifest, &files)
}
