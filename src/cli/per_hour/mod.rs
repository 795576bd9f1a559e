//! `liftsim threshold --per-hour`: the threshold of CUSUMs of sequential ranks, and what it means.

mod words;

use super::output::{self, Output};
use super::rows::FormatArguments;
use super::threshold::{Choice, one_of};
use super::{CommandResult, Failure};
use clap::builder::{PossibleValue, TypedValueParser};
use clap::{Arg, Args, Command};
use liftsim::detect::sequential::{Change, Chart, Rate, RunLength, Score, Side};
use liftsim::rule::{OutOfRange, Rule};
use liftsim::study::run_length::{Delay, delays};
use std::ffi::OsStr;
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
        allow_negative_numbers = true,
        default_value_t = 1,
        requires = "per_hour",
        conflicts_with = "three samples"
    )]
    block: i64,
    /// What a rank scores.
    #[arg(long, value_parser = one_of(&SCORES), default_value = "normal", requires = "per_hour", conflicts_with = "three samples")]
    score: Score,
    /// The changes that it looks for, with commas in between.
    #[arg(long, value_parser = Trimmed(one_of(&SIDES)), value_delimiter = ',', default_value = "up,down",
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

/// Reads a part of a list, with blanks around it.
#[derive(Clone)]
struct Trimmed<P>(P);

impl<P: TypedValueParser> TypedValueParser for Trimmed<P> {
    type Value = P::Value;

    fn parse_ref(
        &self,
        command: &Command,
        flag: Option<&Arg>,
        value: &OsStr,
    ) -> Result<P::Value, clap::Error> {
        let trimmed = value.to_str().map_or(value, |text| OsStr::new(text.trim()));
        self.0.parse_ref(command, flag, trimmed)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        self.0.possible_values()
    }
}

/// N, if no other is given.
const REFERENCE: usize = 300;

/// The shifts of a block, in deviations, whose delays are printed.
const SHIFTS: [f64; 9] = [0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0];

/// The growths of its deviation whose delays are printed.
const GROWTHS: [f64; 4] = [1.5, 2.0, 3.0, 5.0];

/// Trials behind a simulated delay, or fewer where the reference is long or the change is hardly seen.
const TRIALS: u64 = 4000;

impl PerHour {
    /// Prints and draws what is asked for.
    pub fn run(
        &self,
        reference: Option<usize>,
        format: &FormatArguments,
        figure: Option<Output>,
    ) -> CommandResult {
        let found = self.found(reference.unwrap_or(REFERENCE));
        let found = found.map_err(|error| Failure::input(flag(error)))?;
        let path = figure.as_ref().map(|figure| figure.path().clone());
        if let Some(figure) = figure {
            let caption = found.caption();
            let plot = found.plot(&caption);
            figure.draw(&plot, &caption.join("; "))?.publish()?;
        }
        output::print_beside(path.iter(), &format.show(&found))?;
        Ok(ExitCode::SUCCESS)
    }

    fn found(&self, reference: usize) -> Result<Found<'_>, OutOfRange> {
        let (per_hour, rate) = (self.per_hour.unwrap_or(0.0), self.rate.unwrap_or(0.0));
        Rule::Within(1.0, 1e6, "samples").check("block", &(self.block as f64))?;
        let promise = Rate::new(per_hour, rate)?;
        let chart = Chart::new(self.score, &self.sides, self.k, reference)?;
        let threshold = promise.threshold(&chart)?;
        let has_scale = chart.sides().contains(&Side::Scale);
        let growths = if has_scale { &GROWTHS[..] } else { &[] };
        let changes = (SHIFTS.map(Change::shift).into_iter())
            .chain(growths.iter().map(|growth| Change::growth(*growth)));
        let mut shifts = delays(&chart, threshold, &changes.collect::<Vec<_>>(), TRIALS);
        Ok(Found {
            flags: self,
            per_hour,
            rate,
            law: chart.run_length(threshold),
            growths: shifts.split_off(SHIFTS.len()),
            shifts,
            chart,
            threshold,
        })
    }
}

/// A key as a flag.
fn flag(error: OutOfRange) -> OutOfRange {
    let key = format!("--{}", error.key.replace('_', "-"));
    OutOfRange { key, ..error }
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
    shifts: Vec<Delay>,
    /// Of the deviation, if that is looked for.
    growths: Vec<Delay>,
}
