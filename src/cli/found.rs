//! The result of `detect`.

use super::rows::{Rows, Shown};
use super::table;
use liftsim::detection::{
    DetectReport, Detection, Event, Recorded, Trip, Undecided, event_lines, no_rides,
};
use liftsim::monitor::Reference;
use serde_json::Value;

/// Below this p-value the filter counts as leaving colour.
const COLOURED: f64 = 0.01;

/// The columns shown of every trip.
const TRIP: [&str; 9] = [
    "ride",
    "direction",
    "start",
    "inertial",
    "braking",
    "levelling",
    "stop",
    "speed",
    "ended",
];

/// The columns shown of its start and of its stop, without that prefix.
const DECISION: [&str; 4] = ["rank_sum", "exceedances", "lower", "upper"];

/// The most undecided stretches that are printed.
const MOST_STRETCHES: usize = 8;

/// What was found in a recording.
pub struct Found<'a> {
    pub report: DetectReport<'a>,
    pub detection: &'a Detection,
}

impl Shown for Found<'_> {
    fn text(&self) -> String {
        let Self { report, detection } = self;
        [
            recording(&report.recording),
            rest(detection),
            trips(report),
            undecided(report.undecided),
            events(report.events),
            decisions(report.rides),
        ]
        .concat()
    }

    fn json(&self) -> String {
        self.report.json()
    }

    fn rows(&self) -> Rows {
        Rows {
            columns: self.report.columns(),
            cells: self.report.rows(),
        }
    }
}

/// How it was read.
pub fn recording(it: &Recorded) -> String {
    let quantum = it.quantum.map(|step| format!(", step {step:.3e} m/s^2"));
    let missing = match it.missing {
        0 => String::new(),
        count => {
            let least = if it.more_may_be_missing {
                "at least "
            } else {
                ""
            };
            format!(
                ", {least}{:.1} % missing ({count})",
                100.0 * it.missing_share
            )
        }
    };
    let zero = (it.counts_from.as_ref()).map(|zero| format!("; times count from {zero}"));
    format!(
        "{}: {}, time in \"{}\" ({}), acceleration in \"{}\" ({}), vertical {}\n\
         {} samples in {:.2} s, {:.1} Hz with {:.1} % jitter{}{}{}\n",
        it.file,
        it.format,
        it.time,
        it.time_unit,
        it.acceleration.join("\", \""),
        it.unit,
        it.vertical,
        it.samples,
        it.end - it.start,
        it.rate,
        100.0 * it.jitter,
        missing,
        quantum.unwrap_or_default(),
        zero.unwrap_or_default(),
    )
}

fn rest(detection: &Detection) -> String {
    let (design, knowledge) = (&detection.design, &detection.knowledge);
    let mut text = String::new();
    if let Some(reference) = &knowledge.reference {
        text += &learnt(reference, design.block);
    }
    let at_rest = &detection.at_rest;
    let alpha = design.settings.detector.alpha;
    text += &format!(
        "decisions: {} blocks, alpha {alpha}; {}\n",
        design.samples,
        wrong(at_rest.false_alarms, at_rest.decisions),
    );
    if design.ranks.is_some() {
        let wrong = wrong(at_rest.rank_alarms, at_rest.ranked);
        text += &format!("ranks: alpha {alpha} a block; {wrong}\n");
    }
    text += "\n";
    text
}

fn learnt(reference: &Reference, block: f64) -> String {
    let colour = match reference.whiteness {
        Some(p) if p < COLOURED => {
            format!("Ljung-Box p = {p:.2e}: colour is left, so alpha is not guaranteed")
        }
        Some(p) => format!("Ljung-Box p = {p:.3}"),
        None => "too short for a Ljung-Box test".to_owned(),
    };
    format!(
        "rest: {:.4} m/s^2, deviation {:.4} m/s^2 in blocks of {:.0} ms after whitening with order {} ({colour})\n",
        // Never "-0.0000".
        (1e4 * reference.level).round() / 1e4 + 0.0,
        reference.deviation,
        1000.0 * block,
        reference.coefficients.len(),
    )
}

/// How often decisions at rest were wrong.
fn wrong(alarms: u64, decisions: u64) -> String {
    if decisions == 0 {
        return "none at rest".to_owned();
    }
    let percent = 100.0 * alarms as f64 / decisions as f64;
    format!("false alarms at rest: {alarms} of {decisions} ({percent:.2} %)")
}

fn trips(report: &DetectReport) -> String {
    if report.rides.is_empty() {
        return no_rides(report.undecided, report.events).to_owned() + "\n";
    }
    let shown = [&TRIP[..], dated(&report.recording)].concat();
    let rows: Vec<Vec<String>> = (report.rides.iter())
        .map(|trip| shown.iter().map(|name| cell(&trip.column(name))).collect())
        .collect();
    let ends = report.rides.iter().map(other_ends).collect::<String>();
    table(&shown, &rows) + "times in s of the recording's clock, speed in m/s\n" + &ends
}

/// The column shown where the clock has dates.
pub fn dated(recording: &Recorded) -> &'static [&'static str] {
    match recording.clock_zero {
        Some(_) => &["start_at"],
        None => &[],
    }
}

/// A line for every end that may be another.
pub fn other_ends(trip: &Trip) -> String {
    trip.other_ends().map(|line| line + "\n").collect()
}

/// A paragraph for each of the first.
pub fn undecided(stretches: &[Undecided]) -> String {
    let told = |it: &Undecided| {
        format!(
            "\nundecided, {:.1} to {:.1} s: {}\n",
            it.from,
            it.to,
            it.readings()
        )
    };
    stretches.iter().take(MOST_STRETCHES).map(told).collect()
}

/// A line for every kind of event.
pub fn events(events: &[Event]) -> String {
    let lines = event_lines(events);
    if lines.is_empty() {
        return String::new();
    }
    format!("\n{}\n", lines.join("\n"))
}

fn decisions(trips: &[Trip]) -> String {
    let moments = trips
        .iter()
        .flat_map(|trip| [(trip, "start"), (trip, "stop")]);
    let rows: Vec<_> = moments
        .filter(|(trip, moment)| !trip.column(&format!("{moment}_rank_sum")).is_null())
        .map(|(trip, moment)| {
            let of_decision = DECISION.map(|name| cell(&trip.column(&format!("{moment}_{name}"))));
            [
                &[trip.ride.to_string(), moment.to_owned()],
                &of_decision[..],
            ]
            .concat()
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    let header = [&["ride", "decision"], &DECISION[..]].concat();
    let legend = "motion where rank_sum <= lower or rank_sum >= upper\n";
    "\n".to_owned() + &table(&header, &rows) + legend
}

/// A value for a table.
pub fn cell(value: &Value) -> String {
    match value {
        Value::Null => "-".to_owned(),
        Value::String(text) => text.clone(),
        Value::Number(number) if number.is_f64() => {
            format!("{:.2}", number.as_f64().unwrap_or(f64::NAN))
        }
        value => value.to_string(),
    }
}
