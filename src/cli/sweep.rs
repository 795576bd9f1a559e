//! `liftsim sweep CONFIG`: runs every point, or draws what is no sweep, and writes results and figure.

use super::progress::{self, Progress, Reporter};
use super::store::{Written, line, manifest, write_all};
use super::{Failure, Outcome, Simulation, exhibit, print};
use clap::Args;
use liftsim::campaign::{Campaign, Counts, Terms};
use liftsim::claim::{self, Evidence};
use liftsim::config::{Config, Experiment};
use liftsim::figure;
use liftsim::plan::Plan;
use liftsim::report::Section;
use liftsim::results::{self, Directory, Manifest, Origin, Shard, file_name};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Run every point of an experiment; write points.csv, the figure and run.json.
///
/// A config that says what to draw instead of what to sweep is computed and drawn in the same way,
/// with single numbers in quantities.csv where it has any.
///
/// The same config and seed give the same bytes on any machine, with any number of threads.
///
/// What is counted is saved in counts.json every few seconds. However a run ends, the same command goes
/// on from there. What a directory holds is never simulated again: more trials, a further curve or
/// claim take only what is missing.
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
    /// Run share I of N of the trials, into results/<name>/shards/<I>-of-<N>/ by default; `merge` joins
    /// them.
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    #[command(flatten)]
    progress: Progress,
}

impl Sweep {
    /// Runs the command.
    pub fn run(self, quiet: bool) -> Outcome {
        let path = &self.simulation.config;
        let out = self.out.clone();
        let directory = Directory::new(out.unwrap_or_else(|| self.default_directory()));
        let config = match Experiment::load(path).map_err(Failure::input)? {
            Experiment::Sweep(config) => *config,
            Experiment::Exhibit(config) if self.shard.is_none() => {
                let config = self.simulation.exhibit(*config)?;
                return exhibit::run(&config, &directory, self.fresh);
            }
            Experiment::Exhibit(_) => {
                return Err(Failure::Input(anyhow::anyhow!(
                    "{}: --shard is for sweeps (run it whole)",
                    path.display()
                )));
            }
        };
        let (config, plan) = self.simulation.plan(config, Plan::new)?;
        rehearse(&config, &plan)?;
        let terms = match self.fresh {
            true => Terms::Fresh,
            false => Terms::Continue,
        };
        let mut campaign =
            Campaign::open(&config, plan, directory, self.shard, terms).map_err(Failure::input)?;
        let reporter = Reporter::new(quiet, &self.progress, "");
        progress::work_off(&mut campaign, &reporter)?;
        print(&finish(&config, campaign, self.shard)?)?;
        Ok(ExitCode::SUCCESS)
    }

    /// results/<file stem>, and a place in it for each shard.
    fn default_directory(&self) -> PathBuf {
        let directory = default_directory(&self.simulation.config);
        match self.shard {
            Some(Shard { number, count }) => directory.join(format!("shards/{number}-of-{count}")),
            None => directory,
        }
    }
}

/// Writes what a campaign came to, and says so. A shard has written all it has.
pub(super) fn finish(
    config: &Config,
    campaign: Campaign,
    shard: Option<Shard>,
) -> Result<String, Failure> {
    let (points, trials) = (campaign.plan().points.len(), campaign.trials());
    let directory = campaign.directory().clone();
    if let Some(shard) = shard {
        // A share of no trials is one, too; and whoever joins it compares the words of the config.
        let is_new = !directory.has_counts();
        campaign.save().map_err(Failure::run)?;
        let counts = line(&directory, "counts.json", is_new);
        return Ok(format!(
            "shard {shard}: {points} points of {trials} trials\n{counts}"
        ));
    }
    let held = campaign.made_by().cloned();
    if let Some(held) = &held
        && Origin::from(config).made(held)
        && directory.is_intact(held)
    {
        let place = directory.path().display();
        return Ok(format!(
            "{points} points of {trials} trials are complete in {place}: nothing to simulate\n"
        ));
    }
    // Until the last file vouches for the others, the counts are what a run goes on from.
    campaign.save().map_err(Failure::run)?;
    let (counts, lock) = campaign.counts();
    let seconds = counts.seconds;
    let written = write(&directory, config, &counts, held)?;
    drop(lock);
    Ok(format!(
        "{points} points of {trials} trials in {seconds:.1} s\n{}",
        written.files
    ))
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
        trials: 1,
        evidence: evidence(&empty, config)?,
    };
    section.judge().map(drop).map_err(Failure::input)
}

/// results/<file stem>.
pub(super) fn default_directory(config: &Path) -> PathBuf {
    Path::new("results").join(config.file_stem().unwrap_or(config.as_os_str()))
}

/// What the claims are judged by, with the numbers that claims of gains ask for.
fn evidence(counts: &Counts, config: &Config) -> Result<Evidence, Failure> {
    let outcomes = counts
        .rows
        .iter()
        .map(|row| row.outcome(config.axis.parameter));
    let mut evidence = Evidence {
        scope: config.scope(),
        outcomes: outcomes.collect(),
        comparisons: counts.comparisons(config),
        quantities: Vec::new(),
    };
    let gains = claim::gains(&config.narrative.claims, &evidence);
    evidence.quantities = gains.map_err(Failure::input)?;
    Ok(evidence)
}

/// Writes counts, then pictures, then the manifest that vouches for both. Counts that are only written
/// anew are as old as they were: `held` has made them.
pub(super) fn write(
    directory: &Directory,
    config: &Config,
    counts: &Counts,
    held: Option<Manifest>,
) -> Result<Written, Failure> {
    let now = manifest(&Origin::from(config), counts.seconds);
    let manifest = match held {
        Some(held) => Manifest {
            revision: held.revision,
            threads: held.threads,
            architecture: held.architecture,
            ..now
        },
        None => now,
    };
    let drawing = figure::sweep(config, &counts.rows, &manifest).map_err(Failure::run)?;
    let mut files = vec![("points.csv", results::csv_bytes(&counts.rows))];
    let evidence = evidence(counts, config)?;
    if !evidence.comparisons.is_empty() {
        files.push(("comparisons.csv", results::csv_bytes(&evidence.comparisons)));
    }
    if !evidence.quantities.is_empty() {
        files.push(("quantities.csv", results::csv_bytes(&evidence.quantities)));
    }
    files.extend(drawing.files().map(|(name, bytes)| (name, bytes.to_vec())));
    write_all(directory, manifest, &files)
}
