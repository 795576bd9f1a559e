//! Ride quality, for `track`: its flags, and what is printed of it.

use super::rides::Rides;
use super::{table, warn};
use clap::Args;
use liftsim::track::quality::{LEAST_RATE, Measure, Verdict};
use liftsim::track::{QualityReport, Track, Tracked};
use std::iter;

/// How rides are judged.
#[derive(Debug, Args)]
#[command(next_help_heading = "Ride quality")]
pub struct QualityArguments {
    /// Judge how hard and how smoothly each ride goes: acceleration, jerk, and vibration as people feel it, beside the limits
    /// of GB/T 10058-2009 (from memory: its text could not be read).
    #[arg(long)]
    quality: bool,
    /// The lift's rated speed, m/s, on which limits depend [default: that of its fastest ride].
    #[arg(long, value_name = "M/S", requires = "quality", value_parser = rated_speed)]
    rated_speed: Option<f64>,
}

fn rated_speed(text: &str) -> Result<f64, String> {
    let speed = text.parse().ok().filter(|it| *it > 0.0 && *it <= 30.0);
    speed.ok_or_else(|| "must be a speed above 0 and up to 30 m/s".to_owned())
}

impl QualityArguments {
    /// Whether the record across the vertical is needed.
    pub fn is_wanted(&self) -> bool {
        self.quality
    }

    /// Judges all rides, if that is wanted.
    pub fn judge(&self, track: &mut Track, rides: &Rides) -> Option<QualityReport> {
        if !self.quality {
            return None;
        }
        let recording = &rides.recording;
        track.judge(recording, &rides.detection);
        let rate = recording.rate();
        if rides.detection.filter.time_constant().is_some() {
            warn(
                "no ride is judged: behind a high-pass filter accelerations and jerks are not those of the car (record the raw accelerometer, with g)",
            );
        } else if rate < LEAST_RATE {
            warn(format!(
                "no ride is judged: at {rate:.1} Hz the record holds no vibration (record {LEAST_RATE} Hz or more, best 200 Hz)"
            ));
        } else if recording.across().is_none() {
            warn("horizontal vibration is not judged: only one axis was read (record all three)");
        }
        Some(QualityReport::new(&track.trips, rate, self.rated_speed))
    }
}

/// The columns of the table, each with its largest value and what 95 % do not exceed.
const COLUMNS: [(&str, Measure, Option<Measure>); 6] = [
    (
        "acceleration",
        Measure::Acceleration,
        Some(Measure::Acceleration95),
    ),
    (
        "deceleration",
        Measure::Deceleration,
        Some(Measure::Deceleration95),
    ),
    ("speed", Measure::Speed, Some(Measure::Speed95)),
    ("jerk", Measure::Jerk, None),
    ("vertical", Measure::Vertical, Some(Measure::Vertical95)),
    (
        "horizontal",
        Measure::Horizontal,
        Some(Measure::Horizontal95),
    ),
];

const LEGEND: &str = "the largest, in brackets what 95 % do not exceed; m/s², speed in m/s, jerk in m/s³; vertical and horizontal \
                      vibration peak to peak, as people feel it\n";

/// The quality of all rides, in lines.
pub fn text(rides: &[Tracked], report: &QualityReport) -> String {
    let title = "\nride quality\n";
    let Some(rated_speed) = report.rated_speed else {
        return title.to_owned()
            + "no ride is judged: none is in the record with a second of rest around it, and no hole\n";
    };
    let limits = &report.limits;
    let judged = rides
        .iter()
        .filter_map(|it| Some((it.trip.ride, it.quality?)));
    let rows = judged.map(|(ride, quality)| {
        let value = |measure| {
            let figure = quality.figure(measure)?;
            let mark = match limits.verdict(&quality, measure) {
                Some(Verdict::Fail) => "!",
                _ if figure.is_noise() => "~",
                _ => "",
            };
            Some(format!("{:.2}{mark}", figure.value))
        };
        let cells = COLUMNS.map(|(_, most, usual)| {
            let most = value(most).unwrap_or_else(|| "-".to_owned());
            let usual = usual.and_then(value).map(|usual| format!(" ({usual})"));
            most + &usual.unwrap_or_default()
        });
        iter::once(ride.to_string()).chain(cells).collect()
    });
    let rows: Vec<Vec<String>> = rows.collect();
    let is_marked = |mark| rows.iter().flatten().any(|cell| cell.contains(mark));
    let names: Vec<&str> = iter::once("ride").chain(COLUMNS.map(|it| it.0)).collect();
    let verdict = if is_marked('!') {
        "!: not within"
    } else {
        "all within"
    };
    let mut lines = vec![format!(
        "{verdict} the limits at {rated_speed:.2} m/s: {limits}"
    )];
    if is_marked('~') {
        lines.push(
            "~: at most 1.5 times what the sensor shows at rest: this may be its noise".to_owned(),
        );
    }
    let others = rides.iter().filter(|it| it.quality.is_none());
    let others: Vec<String> = others.map(|it| it.trip.ride.to_string()).collect();
    if !others.is_empty() {
        let others = others.join(", ");
        lines.push(format!(
            "not judged, since it has a hole, or is not in the record with a second of rest around it: ride {others}"
        ));
    }
    let lines = lines
        .iter()
        .chain(&report.notes)
        .map(|line| format!("{line}\n"));
    title.to_owned() + &table(&names, &rows) + LEGEND + &lines.collect::<String>()
}
