//! What was found in a recording, as a table, as JSON, as CSV.

use super::table;
use liftsim::detection::{Detection, Ride};
use liftsim::monitor::{Decision, Kind};
use liftsim::signal::recording::Recording;
use serde::Serialize;
use serde_json::{Value, json};
use std::path::Path;

/// A recording and what was found in it.
pub struct Found<'a> {
    pub path: &'a Path,
    pub recording: &'a Recording,
    pub detection: &'a Detection,
}

/// Below this p-value a filter is said to leave colour.
const COLOURED: f64 = 0.01;

/// The CSV of no rides.
const HEADER: &str = "ride,direction,start,inertial,braking,stop,speed,ended,start_reported,start_rank_sum,\
    start_exceedances,start_lower,start_upper,stop_reported,stop_rank_sum,stop_exceedances,stop_lower,stop_upper,\
    alpha\n";

/// A row of the CSV.
#[derive(Serialize)]
struct Row {
    ride: usize,
    direction: &'static str,
    start: f64,
    inertial: Option<f64>,
    braking: Option<f64>,
    stop: Option<f64>,
    speed: f64,
    ended: &'static str,
    start_reported: f64,
    start_rank_sum: Option<u64>,
    start_exceedances: Option<usize>,
    start_lower: Option<u64>,
    start_upper: Option<u64>,
    stop_reported: Option<f64>,
    stop_rank_sum: Option<u64>,
    stop_exceedances: Option<usize>,
    stop_lower: Option<u64>,
    stop_upper: Option<u64>,
    alpha: f64,
}

impl Found<'_> {
    /// The file's name.
    pub fn name(&self) -> String {
        let name = self.path.file_name().unwrap_or(self.path.as_os_str());
        name.to_string_lossy().into_owned()
    }

    /// What should be known before the rides are trusted.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if self.detection.is_high_passed {
            warnings.push(
                "this looks like a sensor behind a high-pass filter: pulses of acceleration decay and overshoot, so \
                 speeds and stops cannot be trusted (record the raw accelerometer, with g)"
                    .to_owned(),
            );
        }
        let (now, then) = (self.recording.rate(), self.detection.design.rate);
        if (now / then - 1.0).abs() > 0.05 {
            warnings.push(format!(
                "the state was learnt at {then:.1} Hz, this recording has {now:.1} Hz (use --resample {then:.1})"
            ));
        }
        if let Some(reference) = &self.detection.knowledge.reference
            && !is_level_of_rest(reference.level)
        {
            warnings.push(format!(
                "rest reads {:.3} m/s^2, neither 0 nor the 9.8 of gravity (is the unit right? --unit g, mg, or counts \
                 with --scale)",
                reference.level
            ));
        }
        let lost = self
            .detection
            .rides
            .iter()
            .filter(|ride| is_lost(ride))
            .count();
        if lost > 0 {
            warnings.push(format!(
                "{lost} rides were lost from sight: no stop was found that fits their start"
            ));
        }
        warnings
    }

    /// For people.
    pub fn table(&self) -> String {
        [
            self.about_recording(),
            self.about_rest(),
            self.rides(),
            self.decisions(),
        ]
        .join("")
    }

    fn about_recording(&self) -> String {
        let (recording, facts) = (self.recording, self.recording.facts());
        let (time, time_unit) = recording.time_column();
        let mut text = format!(
            "{}: {}, time in \"{time}\" ({time_unit}), acceleration in \"{}\" ({}), vertical {}\n\
             {} samples in {:.2} s, {:.1} Hz with {:.1} % jitter",
            self.name(),
            recording.format(),
            recording.acceleration_columns().join("\", \""),
            recording.unit(),
            recording.vertical(),
            facts.samples,
            facts.duration(),
            facts.rate,
            100.0 * facts.jitter,
        );
        if let Some(quantum) = facts.quantum {
            text += &format!(", step {quantum:.3e} m/s^2");
        }
        text + "\n"
    }

    fn about_rest(&self) -> String {
        let Detection {
            design,
            knowledge,
            at_rest,
            ..
        } = self.detection;
        let mut text = String::new();
        if let Some(reference) = &knowledge.reference {
            text += &format!(
                "rest: {:.4} m/s^2, deviation {:.4} m/s^2 in blocks of {:.0} ms after whitening with order {}",
                // Of a rounded level that is nothing, the sign says nothing.
                (1e4 * reference.level).round() / 1e4 + 0.0,
                reference.deviation,
                1000.0 * design.block,
                reference.coefficients.len(),
            );
            text += &match reference.whiteness {
                Some(p) if p < COLOURED => {
                    format!(" (Ljung-Box p = {p:.2e}: colour is left, so alpha is no promise)\n")
                }
                Some(p) => format!(" (Ljung-Box p = {p:.3})\n"),
                None => " (too short for a Ljung-Box test)\n".to_owned(),
            };
        }
        text += &format!(
            "decisions: {} blocks, alpha {}; {}\n\n",
            design.samples,
            design.settings.alpha,
            at_rest_words(at_rest.decisions, at_rest.alarms)
        );
        if !knowledge.begins_at_rest {
            text += "the recording may begin in motion: the state is unknown at first\n\n";
        }
        text
    }

    fn rides(&self) -> String {
        if self.detection.rides.is_empty() {
            return "no rides\n".to_owned();
        }
        let seconds = |time: Option<f64>| time.map_or("-".to_owned(), |time| format!("{time:.2}"));
        let rows: Vec<Vec<String>> = (1..)
            .zip(&self.detection.rides)
            .map(|(number, ride): (usize, _)| {
                vec![
                    number.to_string(),
                    ride.direction.name().to_owned(),
                    seconds(Some(ride.start)),
                    seconds(ride.inertial),
                    seconds(ride.braking),
                    seconds(ride.stop),
                    format!("{:.2}", ride.speed),
                    ended(ride).to_owned(),
                ]
            })
            .collect();
        let header = [
            "ride",
            "direction",
            "start",
            "inertial",
            "braking",
            "stop",
            "speed",
            "ended by",
        ];
        table(&header, &rows)
            + "times in s of the recording's clock, speed in m/s\n"
            + &self.alarms()
    }

    fn alarms(&self) -> String {
        let alarms = self
            .detection
            .events
            .iter()
            .filter_map(|event| match event.kind {
                Kind::Alarm(alarm) => Some(format!(
                    "\nALARM: {} at {:.2} s, known at {:.2} s\n",
                    alarm.name(),
                    event.time,
                    event.reported
                )),
                Kind::Change { .. } => None,
            });
        alarms.collect()
    }

    fn decisions(&self) -> String {
        let mut rows = Vec::new();
        for (number, ride) in (1..).zip(&self.detection.rides) {
            let made = [
                ("start", Some(ride.start_reported), ride.start_decision),
                ("stop", ride.stop_reported, ride.stop_decision),
            ];
            for (what, reported, decision) in made {
                let (Some(reported), Some(decision)) = (reported, decision) else {
                    continue;
                };
                rows.push(vec![
                    format!("{number}"),
                    what.to_owned(),
                    format!("{reported:.2}"),
                    decision.statistics.rank_sum.to_string(),
                    decision.statistics.exceedances.to_string(),
                    where_it_decides(&decision),
                ]);
            }
        }
        if rows.is_empty() {
            return String::new();
        }
        let header = ["ride", "decision", "made at", "W", "T", "H1* where"];
        "\n".to_owned() + &table(&header, &rows)
    }

    /// For programs.
    pub fn json(&self) -> String {
        let (recording, facts) = (self.recording, self.recording.facts());
        let Detection {
            design,
            knowledge,
            at_rest,
            ..
        } = self.detection;
        let mut warnings: Vec<String> = recording
            .warnings()
            .iter()
            .map(ToString::to_string)
            .collect();
        warnings.extend(self.warnings());
        let rides: Vec<Value> = self.detection.rides.iter().map(ride_json).collect();
        let value = json!({
            "recording": {
                "file": self.name(),
                "format": recording.format().to_string(),
                "time": recording.time_column().0,
                "acceleration": recording.acceleration_columns(),
                "unit": recording.unit().to_string(),
                "vertical": recording.vertical().to_string(),
                "samples": facts.samples,
                "start": facts.start,
                "end": facts.end,
                "rate": facts.rate,
                "jitter": facts.jitter,
                "quantum": facts.quantum,
                "has_gravity": facts.has_gravity,
                "high_passed": self.detection.is_high_passed,
            },
            "warnings": warnings,
            "settings": design.settings,
            "block": design.block,
            "knowledge": knowledge,
            "at_rest": {
                "decisions": at_rest.decisions,
                "false_alarms": at_rest.alarms,
            },
            "rides": rides,
            "events": self.detection.events,
        });
        format!("{value:#}\n")
    }

    /// One row a ride.
    pub fn csv(&self) -> Vec<u8> {
        let rows = (1..).zip(&self.detection.rides).map(|(number, ride)| {
            let (start, stop) = (ride.start_decision, ride.stop_decision);
            let lower = |decision: Option<Decision>| decision.and_then(|made| made.threshold.0);
            let upper = |decision: Option<Decision>| decision.and_then(|made| made.threshold.1);
            Row {
                ride: number,
                direction: ride.direction.name(),
                start: ride.start,
                inertial: ride.inertial,
                braking: ride.braking,
                stop: ride.stop,
                speed: ride.speed,
                ended: ended(ride),
                start_reported: ride.start_reported,
                start_rank_sum: start.map(|made| made.statistics.rank_sum),
                start_exceedances: start.map(|made| made.statistics.exceedances),
                start_lower: lower(start),
                start_upper: upper(start),
                stop_reported: ride.stop_reported,
                stop_rank_sum: stop.map(|made| made.statistics.rank_sum),
                stop_exceedances: stop.map(|made| made.statistics.exceedances),
                stop_lower: lower(stop),
                stop_upper: upper(stop),
                alpha: self.detection.design.settings.alpha,
            }
        });
        match self.detection.rides.is_empty() {
            true => HEADER.as_bytes().to_vec(),
            false => liftsim::results::csv_bytes(&rows.collect::<Vec<_>>()),
        }
    }
}

fn is_lost(ride: &Ride) -> bool {
    ended(ride) == "lost"
}

fn ended(ride: &Ride) -> &'static str {
    ride.end.map_or("end of the recording", |end| end.name())
}

/// The region that a decision was held against, at its T.
fn where_it_decides(decision: &Decision) -> String {
    match decision.threshold {
        (Some(lower), Some(upper)) if lower + 1 >= upper => "any W".to_owned(),
        (Some(lower), Some(upper)) => format!("W <= {lower} or W >= {upper}"),
        (Some(lower), None) => format!("W <= {lower}"),
        (None, Some(upper)) => format!("W >= {upper}"),
        (None, None) => "no W".to_owned(),
    }
}

fn ride_json(ride: &Ride) -> Value {
    json!({
        "direction": ride.direction.name(),
        "start": ride.start,
        "start_reported": ride.start_reported,
        "start_decision": ride.start_decision,
        "inertial": ride.inertial,
        "braking": ride.braking,
        "speed": ride.speed,
        "end": ride.end.map(|end| end.name()),
        "stop": ride.stop,
        "stop_reported": ride.stop_reported,
        "stop_decision": ride.stop_decision,
    })
}

fn at_rest_words(decisions: u64, alarms: u64) -> String {
    match decisions {
        0 => "none at rest".to_owned(),
        _ => format!(
            "false alarms at rest: {alarms} of {decisions} ({:.2} %)",
            100.0 * alarms as f64 / decisions as f64
        ),
    }
}

/// Whether a sensor may read this at rest, m/s²: nothing or gravity, and its own offset.
fn is_level_of_rest(level: f64) -> bool {
    const OFFSET: f64 = 1.5;
    level.abs() < OFFSET || (level.abs() - 9.81).abs() < OFFSET
}
