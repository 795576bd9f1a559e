//! What every single trial gave, for other tools: a table of one point, or arrays of all.

use super::output::Output;
use super::progress::{Reporter, trial_outcomes};
use super::{Failure, print_to};
use anyhow::anyhow;
use liftsim::experiment::{Experiment, SWEEP, SweepConfig};
use liftsim::npz::Archive;
use liftsim::stats::tally::MOST_TRIALS;
use liftsim::study::Sweep;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Trials that are printed at once.
const AT_ONCE: usize = 1 << 20;

/// The most trials of points that are kept in memory, 13 bytes each.
const MOST: u64 = 50_000_000;

/// The trials `A..B` of a flag.
pub fn range(text: &str) -> Result<Range<u64>, String> {
    let (first, end) = text.split_once("..").ok_or("must be A..B, as 0..1000")?;
    let number = |text: &str| text.parse().ok();
    match (number(first), number(end)) {
        (Some(first), Some(end)) if first < end && end <= MOST_TRIALS => Ok(first..end),
        _ => Err(format!(
            "must be A..B with A < B <= {MOST_TRIALS}, as 0..1000"
        )),
    }
}

/// Prints the outcomes of one point as CSV, as long as anybody reads it.
pub fn print_table(
    sweep: &Sweep,
    point: usize,
    trials: Range<u64>,
    reporter: &Reporter,
) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    let mut is_read = print_to(&mut out, "trial,rank_sum,exceedances,h1\n")?;
    for first in trials.clone().step_by(AT_ONCE) {
        if !is_read {
            break;
        }
        let part = first..trials.end.min(first + AT_ONCE as u64);
        let outcomes = trial_outcomes(sweep, &[point], &part, reporter)?.remove(0);
        let mut text = String::new();
        for (at, trial) in part.enumerate() {
            let (rank_sum, exceedances) = (outcomes.rank_sums[at], outcomes.exceedances[at]);
            let h1 = u8::from(outcomes.h1[at]);
            text += &format!("{trial},{rank_sum},{exceedances},{h1}\n");
        }
        is_read = print_to(&mut out, &text)?;
    }
    Ok(())
}

/// The file of `--save-trials`, and what it is of.
pub struct SavedTrials {
    file: Output,
    sweep: Sweep,
}

impl SavedTrials {
    /// Refuses what cannot be saved.
    pub fn new(path: &Path, replaces: bool, experiment: Experiment) -> Result<Self, Failure> {
        let file = Output::named(path, replaces, "--save-trials", &["npz"])?;
        if experiment.study() != SWEEP {
            return Err(Failure::Input(anyhow!(
                "--save-trials: [{}] has no W and T (leave it out)",
                experiment.study()
            )));
        }
        let config = SweepConfig::new(experiment).map_err(Failure::input)?;
        let sweep = Sweep::new(config).map_err(Failure::input)?;
        let points = sweep.plan.points.len() as u64;
        let outcomes = sweep.plan.schedule.trials.saturating_mul(points);
        if outcomes > MOST {
            return Err(Failure::Input(anyhow!(
                "--save-trials: {outcomes} trials of points are more than the {MOST} that are kept in memory (lower \
                 --trials)"
            )));
        }
        Ok(Self { file, sweep })
    }

    /// Simulates all trials and writes the file; returns its name.
    pub fn write(self, reporter: &Reporter) -> Result<PathBuf, Failure> {
        let plan = &self.sweep.plan;
        let all: Vec<usize> = (0..plan.points.len()).collect();
        let outcomes = trial_outcomes(&self.sweep, &all, &(0..plan.schedule.trials), reporter)?;
        let path = self.file.path().clone();
        let written = self.file.write_with(|out| {
            let mut archive = Archive::new(out);
            archive.add("rank_sum", outcomes.iter().map(|of| &of.rank_sums[..]))?;
            archive.add("exceedances", outcomes.iter().map(|of| &of.exceedances[..]))?;
            archive.add("h1", outcomes.iter().map(|of| &of.h1[..]))?;
            archive.close()
        });
        written?.publish()?;
        Ok(path)
    }
}
