//! `liftsim threshold --per-hour`: the threshold of CUSUMs of sequential ranks, and what it means.

use super::output::Output;
use super::threshold::{Choice, one_of};
use super::{CommandResult, Failure, print, table};
use clap::Args;
use liftsim::detect::sequential::{Chart, RunLength, Score, Side, units};
use liftsim::rule::{OutOfRange, Rule};
use liftsim::study::run_length::{Delay, delays, plot_delays};
use serde_json::json;
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
        requires = "per_hour"
    )]
    rate: Option<f64>,
    /// Samples in a block: the delays are those of a shift by Δ/σ of each.
    #[arg(
        long,
        value_name = "SAMPLES",
        default_value_t = 1,
        requires = "per_hour"
    )]
    block: u32,
    /// What a rank scores.
    #[arg(long, value_parser = one_of(&SCORES), default_value = "normal", requires = "per_hour")]
    score: Score,
    /// The changes that it looks for, with commas in between.
    #[arg(long, value_parser = one_of(&SIDES), value_delimiter = ',', default_value = "up,down",
          requires = "per_hour")]
    sides: Vec<Side>,
    /// What each score is lowered by, a multiple of 0.025: half the shift of a block, in deviations, that is to be seen
    /// soonest.
    #[arg(
        long,
        value_name = "K",
        allow_negative_numbers = true,
        default_value_t = 0.8,
        requires = "per_hour"
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

/// Probabilities of a false alarm by the times printed.
const PROBABILITIES: [f64; 4] = [0.01, 0.05, 0.5, 0.95];

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

impl Found<'_> {
    fn hours(&self, blocks: f64) -> f64 {
        blocks / (3600.0 * self.rate)
    }

    /// Δ/σ of a sample.
    fn delta(&self, shift: f64) -> f64 {
        shift / f64::from(self.flags.block).sqrt()
    }

    /// Probabilities of a false alarm, each with the hours in which it is no larger.
    fn quantiles(&self) -> Vec<(f64, f64)> {
        let hours = |p: f64| self.hours(self.law.quantile(p) as f64);
        PROBABILITIES.into_iter().map(|p| (p, hours(p))).collect()
    }

    fn sides(&self) -> Vec<String> {
        self.chart.sides().iter().map(Side::to_string).collect()
    }

    fn samples(&self) -> String {
        match self.flags.block {
            1 => "one sample".to_owned(),
            block => format!("{block} samples"),
        }
    }

    fn caption(&self) -> Vec<String> {
        let Self { flags, .. } = self;
        vec![
            format!("{} scores of sequential ranks", flags.score),
            format!("sides {}", self.sides().join(", ")),
            format!("k = {}", flags.k),
            format!("h = {}", units(self.threshold)),
            format!("reference of {} blocks", self.chart.reference()),
            format!(
                "{} blocks per second, {} samples each",
                self.rate, flags.block
            ),
            format!("at most {} false alarms per hour", self.per_hour),
            format!("a shift in normal noise; {TRIALS} trials, drawn where 99 % are seen"),
        ]
    }

    fn plot(&self, caption: &[String]) -> liftsim::plot::Plot {
        let shifts = (0..=110).map(|step| 0.5 + 0.05 * f64::from(step));
        let long = shifts.map(|shift| (shift, self.chart.delay(self.threshold, shift)));
        let scale = [self.rate, f64::from(self.flags.block)];
        plot_delays(&long.collect::<Vec<_>>(), &self.delays, scale, caption)
    }

    fn as_table(&self) -> String {
        let Self { flags, law, .. } = self;
        let exactly = if law.is_exact() {
            "exactly "
        } else {
            "at least "
        };
        let quantiles = self.quantiles().into_iter();
        let quantiles = quantiles.map(|(p, hours)| vec![format!("{} %", 100.0 * p), digits(hours)]);
        let first = [
            "a false alarm",
            if law.is_exact() {
                "within, h"
            } else {
                "not before, h"
            },
        ];
        let header = [
            "Δ/σ",
            "of a block",
            "blocks",
            "seconds",
            "this reference: seen",
            "blocks",
            "95 % interval",
            "seconds",
        ];
        let delays: Vec<_> = self.delays.iter().map(|delay| self.cells(delay)).collect();
        format!(
            "{} scores of sequential ranks, sides {}, k = {}, reference {} blocks, {} blocks per second\n\n\
             threshold h = {}\n\
             mean time between false alarms: {exactly}{} h, or {} per hour (asked for: at most {}); of one side alone {} h\n\n\
             {}\n\
             mean delay of a shift in normal noise, {} to a block: with a long reference (exact), and where it begins \
             right after\nthis reference of {}, which it enters ({TRIALS} trials; where 99 % are seen)\n\n{}",
            flags.score,
            self.sides().join(", "),
            flags.k,
            self.chart.reference(),
            self.rate,
            units(self.threshold),
            digits(self.hours(law.promised())),
            digits(1.0 / self.hours(law.promised())),
            self.per_hour,
            digits(self.hours(law.one_side())),
            table(&first, &quantiles.collect::<Vec<_>>()),
            self.samples(),
            self.chart.reference(),
            table(&header, &delays),
        )
    }

    fn cells(&self, delay: &Delay) -> Vec<String> {
        let (low, high) = delay.interval;
        let long = [delay.long, delay.long / self.rate].map(digits);
        let mut cells = vec![digits(self.delta(delay.shift)), delay.shift.to_string()];
        cells.extend(long);
        cells.push(format!("{:.4}", delay.seen.rate()));
        // The mean of those seen says little where many are not.
        let short = delay.is_nearly_always_seen().then(|| {
            let interval = format!("[{}, {}]", digits(low), digits(high));
            [digits(delay.mean), interval, digits(delay.mean / self.rate)]
        });
        cells.extend(short.unwrap_or_default());
        cells
    }

    fn as_json(&self) -> String {
        let Self { flags, law, .. } = self;
        let first = self.quantiles().into_iter();
        let first = first.map(|(p, hours)| json!({ "probability": p, "hours": hours }));
        let delays = self.delays.iter().map(|delay| {
            json!({
                "delta": self.delta(delay.shift),
                "shift": delay.shift,
                "blocks": delay.long,
                "seconds": delay.long / self.rate,
                "this_reference": {
                    "trials": delay.seen.trials,
                    "seen": delay.seen.hits,
                    "blocks": delay.mean,
                    "low": delay.interval.0,
                    "high": delay.interval.1,
                    "seconds": delay.mean / self.rate,
                },
            })
        });
        let value = json!({
            "score": flags.score,
            "sides": self.chart.sides(),
            "k": flags.k,
            "reference": self.chart.reference(),
            "rate": self.rate,
            "block": flags.block,
            "per_hour": self.per_hour,
            "threshold": units(self.threshold),
            "exact": law.is_exact(),
            "hours_between_false_alarms": self.hours(law.promised()),
            "hours_of_one_side": self.hours(law.one_side()),
            "first_false_alarm": first.collect::<Vec<_>>(),
            "delays": delays.collect::<Vec<_>>(),
        });
        format!("{value:#}\n")
    }
}

/// Four digits.
fn digits(value: f64) -> String {
    let decimals = 3 - value.abs().log10().floor().clamp(-300.0, 3.0) as i32;
    if (1e-4..1e7).contains(&value) {
        format!("{value:.0$}", decimals.max(0) as usize)
    } else {
        format!("{value:.3e}")
    }
}
