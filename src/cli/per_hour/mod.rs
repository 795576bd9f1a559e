//! `liftsim threshold --per-hour`: the threshold of CUSUMs of sequential ranks, and what it means.

mod words;

use super::output::Output;
use super::threshold::{Choice, one_of};
use super::{CommandResult, Failure, print};
use clap::Args;
use liftsim::detect::sequential::{Chart, RunLength, Score, Side};
use liftsim::rule::{OutOfRange, Rule};
use liftsim::study::run_length::{Delay, delays};
use std::process::ExitCode;

/// The threshold of a rate of false alarms.
#[derive(Debug, Args)]
#[command(next_help_heading = "A rate of false alarms, block by block")]
pub struct PerHour {
    /// At most so many false alarms in an hour at rest, all sides together.
    #[arg(
        long,
        value_name = "RATE",
        allow_negative_numbers = true,
        requires = "rate",
        conflicts_with = "three samples"
    )]
    per_hour: Option<f64>,
    /// Blocks per second. Blocks are means of some samples, long beside the memory of the noise.
    #[arg(
        long,
        value_name = "HZ",
        allow_negative_numbers = true,
        requires = "per_hour",
        conflicts_with = "three samples"
    )]
    rate: Option<f64>,
    /// Samples in a block: the delays are those of a shift by Δ/σ of each.
    #[arg(
        long,
        value_name = "SAMPLES",
        default_value_t = 1,
        requires = "per_hour",
        conflicts_with = "three samples"
    )]
    block: u32,
    /// What a rank scores.
    #[arg(long, value_parser = one_of(&SCORES), default_value = "normal", requires = "per_hour", conflicts_with = "three samples")]
    score: Score,
    /// The changes that it looks for, with commas in between.
    #[arg(long, value_parser = one_of(&SIDES), value_delimiter = ',', default_value = "up,down",
          requires = "per_hour", conflicts_with = "three samples")]
    sides: Vec<Side>,
    /// What each score is lowered by, a multiple of 0.025: half the shift of a block, in deviations, that is to be seen
    /// soonest.
    #[arg(
        long,
        value_name = "K",
        allow_negative_numbers = true,
        default_value_t = 0.8,
        requires = "per_hour",
        conflicts_with = "three samples"
    )]
    k: f64,
}

static SCORES: [Choice<Score>; 2] = [
    ("normal", Score::Normal, "The best for normal noise"),
    ("ranks", Score::Ranks, "The rank itself"),
];

static SIDES: [Choice<Side>; 3] = [
    ("up", Side::Up, "Larger blocks"),
    ("down", Side::Down, "Smaller blocks"),
    ("scale", Side::Scale, "Blocks farther out either way"),
];

/// N, if no other is given.
const REFERENCE: usize = 60;

/// The shifts of a block, in deviations, whose delays are printed.
const SHIFTS: [f64; 9] = [0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0];

/// Trials behind a simulated delay.
const TRIALS: u64 = 4000;

impl PerHour {
    /// Prints and draws what is asked for.
    pub fn run(
        &self,
        reference: Option<usize>,
        json: bool,
        figure: Option<Output>,
    ) -> CommandResult {
        let found = self.found(reference.unwrap_or(REFERENCE));
        let found = found.map_err(Failure::input)?;
        if let Some(figure) = figure {
            let caption = found.caption();
            let plot = found.plot(&caption);
            figure.draw(&plot, &caption.join("; "))?.publish()?;
        }
        print(&if json {
            found.as_json()
        } else {
            found.as_table()
        })?;
        Ok(ExitCode::SUCCESS)
    }

    fn found(&self, reference: usize) -> Result<Found<'_>, OutOfRange> {
        let (per_hour, rate) = (self.per_hour.unwrap_or(0.0), self.rate.unwrap_or(0.0));
        Rule::Positive.check("--per-hour", &per_hour)?;
        Rule::Within(1e-6, 1e6, "blocks per second").check("--rate", &rate)?;
        Rule::Within(1.0, 1e6, "samples").check("--block", &f64::from(self.block))?;
        let chart = Chart::new(self.score, &self.sides, self.k, reference);
        let chart = chart.map_err(|error| OutOfRange {
            key: format!("--{}", error.key),
            ..error
        })?;
        let blocks = 3600.0 * rate;
        let threshold = chart.threshold(blocks / per_hour);
        let threshold =
            threshold.map_err(|error| error.per_hour(["--per-hour", "--reference"], blocks))?;
        Ok(Found {
            flags: self,
            per_hour,
            rate,
            law: chart.run_length(threshold),
            delays: delays(&chart, threshold, &SHIFTS, TRIALS),
            chart,
            threshold,
        })
    }
}

/// The threshold and all that follows from it.
struct Found<'a> {
    flags: &'a PerHour,
    per_hour: f64,
    rate: f64,
    chart: Chart,
    /// In steps.
    threshold: i32,
    law: RunLength,
    delays: Vec<Delay>,
}
