//! The result of `detect` as text.

use super::table;
use liftsim::detection::{
    AtRest, Brief, DetectReport, Detection, Event, Recorded, Trip, Undecided, What, Why,
};
use liftsim::monitor::{Direction, Reference};
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

/// The most times in a line.
const MOST_TIMES: usize = 8;

/// The whole text.
pub fn text(report: &DetectReport, detection: &Detection) -> String {
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

/// How it was read.
pub fn recording(it: &Recorded) -> String {
    let quantum = it.quantum.map(|step| format!(", step {step:.3e} m/s^2"));
    let offset = (it.clock_offset).map(|offset| format!("; times count from {offset:.3} s"));
    format!(
        "{}: {}, time in \"{}\" ({}), acceleration in \"{}\" ({}), vertical {}\n\
         {} samples in {:.2} s, {:.1} Hz with {:.1} % jitter{}{}\n",
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
        quantum.unwrap_or_default(),
        offset.unwrap_or_default(),
    )
}

fn rest(detection: &Detection) -> String {
    let (design, knowledge) = (&detection.design, &detection.knowledge);
    let mut text = String::new();
    if let Some(reference) = &knowledge.reference {
        text += &learnt(reference, design.block);
    }
    text += &format!(
        "decisions: {} blocks, alpha {}; {}\n\n",
        design.samples,
        design.settings.detector.alpha,
        at_rest(&detection.at_rest)
    );
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

fn at_rest(at_rest: &AtRest) -> String {
    let (alarms, decisions) = (at_rest.false_alarms, at_rest.decisions);
    if decisions == 0 {
        return "none at rest".to_owned();
    }
    let percent = 100.0 * alarms as f64 / decisions as f64;
    format!("false alarms at rest: {alarms} of {decisions} ({percent:.2} %)")
}

fn trips(report: &DetectReport) -> String {
    if report.rides.is_empty() {
        return no_rides(report.undecided, report.events).to_owned();
    }
    let rows: Vec<_> = (report.rides.iter())
        .map(|trip| TRIP.map(|name| cell(&trip.column(name))).to_vec())
        .collect();
    let ends = report.rides.iter().map(other_ends).collect::<String>();
    table(&TRIP, &rows) + "times in s of the recording's clock, speed in m/s\n" + &ends
}

/// What is said where there are none.
pub fn no_rides(undecided: &[Undecided], events: &[Event]) -> &'static str {
    if undecided.is_empty() && events.is_empty() {
        "no rides: the record stays at its level\n"
    } else {
        "no rides that are decided\n"
    }
}

/// A line for every end that may be another.
pub fn other_ends(trip: &Trip) -> String {
    let end = |name: &str, time: Option<f64>| {
        let of = |time| {
            format!(
                "ride {}: the {name} may be at {time:.2} s as well\n",
                trip.ride
            )
        };
        time.map(of).unwrap_or_default()
    };
    end("start", trip.or_start) + &end("stop", trip.or_stop)
}

/// A line for each.
pub fn undecided(stretches: &[Undecided]) -> String {
    let told = |it: &Undecided| {
        let unknown = match it.why {
            Why::Close | Why::Filter => None,
            Why::NoRide => Some("a change of speed that fits no ride"),
            Why::Frozen => Some("the sensor repeats one value"),
            Why::InHand => Some("the sensor may have been in somebody's hand"),
        };
        if let Some(why) = unknown {
            return format!("\nundecided, {:.1} to {:.1} s: {why}\n", it.from, it.to);
        }
        let more = match it.more {
            0 => String::new(),
            1 => ", or in another way".to_owned(),
            more => format!(", or in {more} other ways"),
        };
        let odds = if it.why == Why::Filter {
            String::new()
        } else {
            format!(" ({})", likelier(it.log_odds))
        };
        format!(
            "\nundecided, {:.1} to {:.1} s: either {}, or {}{}{more}\n",
            it.from,
            it.to,
            briefly(&it.either),
            briefly(&it.or),
            odds,
        )
    };
    stretches.iter().take(MOST_TIMES).map(told).collect()
}

/// How much likelier the first of two explanations is.
fn likelier(log_odds: f64) -> String {
    let odds = libm::exp(log_odds).round();
    if odds < 2.0 {
        "about as likely".to_owned()
    } else {
        format!("the first is {odds} times as likely")
    }
}

fn briefly(trips: &[Brief]) -> String {
    let end = |time: Option<f64>| time.map_or("?".to_owned(), |time| format!("{time:.1}"));
    let told = trips.iter().map(|trip| {
        let direction = match trip.direction {
            Direction::Up => "up",
            Direction::Down => "down",
        };
        format!("{direction} {}-{} s", end(trip.start), end(trip.stop))
    });
    let told: Vec<String> = told.collect();
    if told.is_empty() {
        "no ride".to_owned()
    } else {
        told.join(" and ")
    }
}

/// A line for every kind of event.
pub fn events(events: &[Event]) -> String {
    let kinds = [
        (What::Shock, "shocks"),
        (What::Swing, "swings to and fro"),
        (What::Push, "changes of speed that belong to no ride"),
        (What::LevelShift, "shifts of the sensor's level"),
        (What::SlowMotion, "slow motions"),
    ];
    let line = |(what, name): (What, &str)| {
        let times = events.iter().filter(|event| event.what == what);
        let times: Vec<String> = times.map(|event| format!("{:.1}", event.from)).collect();
        let more = times.len().saturating_sub(MOST_TIMES);
        let shown = times
            .iter()
            .take(MOST_TIMES)
            .cloned()
            .collect::<Vec<_>>()
            .join(", ");
        let more = if more > 0 {
            format!(" and {more} more")
        } else {
            String::new()
        };
        (!times.is_empty()).then(|| format!("\n{name} at {shown}{more} s"))
    };
    let lines: String = kinds.into_iter().filter_map(line).collect();
    if lines.is_empty() {
        lines
    } else {
        lines + "\n"
    }
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
