//! What was found, as a table, JSON and a picture.

use super::super::rows::{Rows, Shown, pretty};
use super::super::table;
use super::Found;
use liftsim::detect::sequential::{Change, Side, units};
use liftsim::format::brief;
use liftsim::study::run_length::{Delay, plot_delays};
use serde_json::{Value, json};

/// Probabilities of a false alarm by the times printed.
const PROBABILITIES: [f64; 4] = [0.01, 0.05, 0.5, 0.95];

const COLUMNS: [&str; 18] = [
    "of",
    "probability",
    "hours",
    "delta",
    "shift",
    "growth",
    "blocks",
    "seconds",
    "this_reference_trials",
    "this_reference_seen",
    "this_reference_blocks",
    "this_reference_low",
    "this_reference_high",
    "this_reference_seconds",
    "threshold",
    "exact",
    "hours_between_false_alarms",
    "hours_of_one_side",
];

impl Found<'_> {
    fn hours(&self, blocks: f64) -> f64 {
        blocks / (3600.0 * self.rate)
    }

    /// Δ/σ of a sample.
    fn delta(&self, shift: f64) -> f64 {
        shift / (self.flags.block as f64).sqrt()
    }

    /// Probabilities of a false alarm, each with the hours in which it is no larger.
    fn quantiles(&self) -> Vec<(f64, f64)> {
        let hours = |p: f64| self.hours(self.law.quantile(p));
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

    pub fn caption(&self) -> Vec<String> {
        let Self { flags, .. } = self;
        vec![
            format!("{} scores of sequential ranks", flags.score),
            format!("sides {}", self.sides().join(", ")),
            format!("k = {}", flags.k),
            format!("h = {}", units(self.threshold)),
            format!("reference of {} blocks", self.chart.reference()),
            format!("{} blocks per second, {} each", self.rate, self.samples()),
            format!("at most {} false alarms per hour", brief(self.per_hour)),
            format!(
                "a shift of normal noise; {}, drawn where 99 % are seen",
                trials(&self.shifts)
            ),
        ]
    }

    pub fn plot(&self, caption: &[String]) -> liftsim::plot::Plot {
        let shifts = (0..=110).map(|step| 0.5 + 0.05 * f64::from(step));
        let long = shifts.map(|shift| {
            (
                shift,
                self.chart.delay(self.threshold, Change::shift(shift)),
            )
        });
        let scale = [self.rate, self.flags.block as f64];
        plot_delays(&long.collect::<Vec<_>>(), &self.shifts, scale, caption)
    }

    fn facts(&self) -> Value {
        let Self { flags, law, .. } = self;
        let first = self.quantiles().into_iter();
        let first = first.map(|(p, hours)| json!({ "probability": p, "hours": hours }));
        let shifts = self.shifts.iter().map(|delay| {
            let shift = delay.change.shift;
            self.with_delay(json!({ "delta": self.delta(shift), "shift": shift }), delay)
        });
        let growths = self.growths.iter().map(|delay| {
            let growth = delay.change.growth;
            self.with_delay(json!({ "growth": growth }), delay)
        });
        json!({
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
            "delays": shifts.collect::<Vec<_>>(),
            "growths": growths.collect::<Vec<_>>(),
        })
    }

    /// The delays of vibration, if that is looked for.
    fn growths(&self) -> String {
        if self.growths.is_empty() {
            return String::new();
        }
        let rows = self.growths.iter().map(|delay| {
            let before = vec![delay.change.growth.to_string()];
            [before, self.cells(delay)].concat()
        });
        format!(
            "\nmean delay of a growth of the deviation of blocks, as by vibration ({})\n\n{}",
            trials(&self.growths),
            delays_table(&["times"], rows)
        )
    }

    fn cells(&self, delay: &Delay) -> Vec<String> {
        let (low, high) = delay.interval;
        let mut cells = [delay.long, delay.long / self.rate].map(digits).to_vec();
        cells.push(format!("{:.4}", delay.seen.rate()));
        // The mean of those seen says little where many are not.
        let short = delay.is_nearly_always_seen().then(|| {
            let interval = format!("[{}, {}]", digits(low), digits(high));
            [digits(delay.mean), interval, digits(delay.mean / self.rate)]
        });
        cells.extend(short.unwrap_or_default());
        cells
    }

    /// A change with its delay.
    fn with_delay(&self, mut change: Value, delay: &Delay) -> Value {
        change["blocks"] = json!(delay.long);
        change["seconds"] = json!(delay.long / self.rate);
        change["this_reference"] = json!({
            "trials": delay.seen.trials,
            "seen": delay.seen.hits,
            "blocks": delay.mean,
            "low": delay.interval.0,
            "high": delay.interval.1,
            "seconds": delay.mean / self.rate,
        });
        change
    }
}

impl Shown for Found<'_> {
    fn text(&self) -> String {
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
        let shifts = self.shifts.iter().map(|delay| {
            let shift = delay.change.shift;
            let before = [digits(self.delta(shift)), shift.to_string()];
            [before.to_vec(), self.cells(delay)].concat()
        });
        let shifts = delays_table(&["Δ/σ", "of a block"], shifts);
        format!(
            "{} scores of sequential ranks, sides {}, k = {}, reference {} blocks, {} blocks per second\n\n\
             threshold h = {}\n\
             mean time between false alarms: {exactly}{} h, or {} per hour (asked for: at most {}); of one side alone {} h\n\n\
             {}\n\
             mean delay of a shift of normal noise, {} to a block: with a long reference (exact), and where it begins \
             right after\nthis reference of {}, which it enters ({}; where 99 % are seen)\n\n{shifts}{}",
            flags.score,
            self.sides().join(", "),
            flags.k,
            self.chart.reference(),
            self.rate,
            units(self.threshold),
            digits(self.hours(law.promised())),
            digits(1.0 / self.hours(law.promised())),
            brief(self.per_hour),
            digits(self.hours(law.one_side())),
            table(&first, &quantiles.collect::<Vec<_>>()),
            self.samples(),
            self.chart.reference(),
            trials(&self.shifts),
            self.growths(),
        )
    }

    fn json(&self) -> String {
        pretty(&self.facts())
    }

    /// One for each probability and each change, of which `of` says what it is.
    fn rows(&self) -> Rows {
        let facts = self.facts();
        let lists = ["first_false_alarm", "delays", "growths"];
        let rows = lists.iter().flat_map(|list| {
            let rows = facts[list].as_array().into_iter().flatten();
            rows.map(move |row| {
                let mut row = row.clone();
                row["of"] = json!(list);
                row
            })
        });
        Rows::of(&COLUMNS, &rows.collect::<Vec<_>>(), &facts)
    }
}

/// How many there are behind each delay.
fn trials(delays: &[Delay]) -> String {
    let of = || delays.iter().map(|delay| delay.seen.trials);
    let (least, most) = (of().min().unwrap_or(0), of().max().unwrap_or(0));
    if least == most {
        format!("{most} trials")
    } else {
        format!("{least} to {most} trials")
    }
}

/// The columns of the delay after those that say of what it is.
fn delays_table(first: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let columns = [
        "blocks",
        "seconds",
        "this reference: seen",
        "blocks",
        "95 % interval",
        "seconds",
    ];
    table(&[first, &columns].concat(), &rows.collect::<Vec<_>>())
}

/// Four digits.
fn digits(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let decimals = 3 - libm::log10(value.abs()).floor().clamp(-300.0, 3.0) as i32;
    if (1e-4..1e7).contains(&value) {
        format!("{value:.0$}", decimals.max(0) as usize)
    } else {
        format!("{value:.3e}")
    }
}
