//! `liftsim replay CONFIG --point P --trial T`: every stage of one trial.

use super::outcomes;
use super::progress::{Progress, Reporter};
use super::{CommandResult, Failure, Simulation, print};
use anyhow::anyhow;
use clap::Args;
use liftsim::chain::{Decision, Replay};
use liftsim::detect::Samples;
use liftsim::experiment::SweepConfig;
use liftsim::pilot::Pilots;
use liftsim::stats::tally::MOST_TRIALS;
use liftsim::study::Sweep;
use std::fmt::Write;
use std::ops::Range;
use std::process::ExitCode;

/// Print every stage of one trial as CSV: what was drawn, recorded, fitted, ranked and decided.
///
/// Columns are stage, sample, index and value. Stages: innovation (the draws behind the noise), noise, acceleration and
/// impulse (one for each raw sample), record (as observed), coefficient (of the filter, from 1), whitened,
/// rank, rank_sum (W), exceedances (T, or T' if the config counts
/// those of all of the motion), critical (the smallest W that decides H1 at so many) and
/// critical_below (the largest, where small ones do), threshold (of a score) and h1 (1 where the decision is
/// H1). The decision is the one that a sweep with this config, seed and number of pilot trials counts.
#[derive(Debug, Args)]
pub struct ReplayCommand {
    #[command(flatten)]
    simulation: Simulation,
    /// Which point: its row in points.csv, from 1.
    #[arg(long, value_name = "P", value_parser = clap::value_parser!(u64).range(1..))]
    point: u64,
    /// Which trial, from 0.
    #[arg(
        long,
        value_name = "T",
        required_unless_present = "trials",
        conflicts_with = "trials"
    )]
    trial: Option<u64>,
    /// Only W, T and the decision of each of these trials, the last not included, as a table.
    #[arg(long, value_name = "A..B", value_parser = outcomes::range)]
    trials: Option<Range<u64>>,
    #[command(flatten)]
    progress: Progress,
}

impl ReplayCommand {
    /// Runs the command.
    pub fn run(self, quiet: bool) -> CommandResult {
        let config = SweepConfig::new(self.simulation.config()?).map_err(Failure::input)?;
        self.simulation.start_threads()?;
        let sweep = Sweep::new(config).map_err(Failure::input)?;
        let plan = &sweep.plan;
        let points = plan.points.len();
        if self.point > points as u64 {
            return Err(Failure::Input(anyhow!(
                "--point must lie in 1 to {points}, the rows of points.csv, got {}",
                self.point
            )));
        }
        let point = self.point as usize - 1;
        if let Some(trials) = &self.trials {
            let reporter = Reporter::new(quiet, &self.progress, "");
            outcomes::print_table(&sweep, point, trials.clone(), &reporter)?;
            return Ok(ExitCode::SUCCESS);
        }
        let trial = self.trial.expect("one of both is given");
        if trial >= MOST_TRIALS {
            return Err(Failure::Input(anyhow!(
                "--trial must lie in 0 to {}, got {trial}",
                MOST_TRIALS - 1
            )));
        }
        let alone = &plan.points[point..][..1];
        let pilots = Pilots::new(alone, plan.pilot, plan.seed);
        let decisions = pilots.and_then(|pilots| pilots.decide(|_| {}));
        let decision = &decisions.map_err(Failure::input)?[0];
        let replay = Replay::new(
            &alone[0].scenario,
            decision,
            plan.seed,
            plan.common_random_numbers,
            trial,
        );
        print(&csv(&replay.map_err(Failure::input)?, decision))?;
        Ok(ExitCode::SUCCESS)
    }
}

fn csv(replay: &Replay, decision: &Decision) -> String {
    let Replay { samples, lead, .. } = replay;
    let decimation = samples.decimation();
    let burn_in = replay.innovations.len() - replay.noise.len();
    let raw = |i: usize| part(samples, *lead, i / decimation);
    let mut text = "stage,sample,index,value\n".to_owned();
    let mut line = |stage: &str, sample: &str, index: usize, value: &dyn std::fmt::Display| {
        writeln!(text, "{stage},{sample},{index},{value}").expect("a string takes every line");
    };
    for (i, value) in replay.innovations.iter().enumerate() {
        match i.checked_sub(burn_in) {
            Some(i) => line("innovation", raw(i), i, value),
            None => line("innovation", "burn-in", i, value),
        }
    }
    for (stage, values) in [
        ("noise", &replay.noise),
        ("acceleration", &replay.acceleration),
        ("impulse", &replay.impulses),
    ] {
        for (i, value) in values.iter().enumerate() {
            line(stage, raw(i), i, value);
        }
    }
    for (i, value) in replay.record.iter().enumerate() {
        line("record", part(samples, *lead, i), i, value);
    }
    for (i, value) in replay.coefficients.iter().enumerate() {
        line("coefficient", "", i + 1, value);
    }
    for (i, value) in replay.whitened.iter().enumerate() {
        line("whitened", part(samples, 0, i), i, value);
    }
    for (i, rank) in replay.ranks.iter().enumerate() {
        if let Some(rank) = rank {
            line("rank", part(samples, 0, i), i, rank);
        }
    }
    line("rank_sum", "shift", 0, &replay.statistics.rank_sum);
    line(
        "exceedances",
        "shift",
        0,
        &replay.statistics.shift_exceedances,
    );
    line("exceedances", "scale", 0, &replay.statistics.exceedances);
    if let Decision::Region { region, .. } = decision {
        let (lower, upper) = region.critical_values()[region.exceedances(replay.statistics)];
        for (stage, critical) in [("critical_below", lower), ("critical", upper)] {
            if let Some(critical) = critical {
                line(stage, "shift", 0, &critical);
            }
        }
    }
    if let Some(threshold) = decision.threshold() {
        line("threshold", "", 0, &threshold);
    }
    line("h1", "", 0, &u8::from(replay.is_h1));
    text
}

/// Which sample an observation belongs to, where X starts with observation `lead`.
fn part(samples: &Samples, lead: usize, observation: usize) -> &'static str {
    let Some(place) = observation.checked_sub(lead) else {
        return "training";
    };
    let named = [
        (samples.reference_range(), "reference"),
        (samples.shift_range(), "shift"),
        (samples.scale_range(), "scale"),
    ];
    let found = named.into_iter().find(|(range, _)| range.contains(&place));
    found.map_or("gap", |(_, name)| name)
}
