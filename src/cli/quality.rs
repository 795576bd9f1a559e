//! Ride quality, for `track`: its flags, and what is printed of it.

use super::rides::Rides;
use super::{table, warn};
use clap::Args;
use liftsim::track::quality::{PAIRS, Verdict};
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
    #[arg(long, value_name = "M/S", requires = "judged", value_parser = rated_speed)]
    rated_speed: Option<f64>,
}

fn rated_speed(text: &str) -> Result<f64, String> {
    let speed = text.parse().ok().filter(|it| *it > 0.0 && *it <= 30.0);
    speed.ok_or_else(|| "must be a speed above 0 and up to 30 m/s".to_owned())
}

impl QualityArguments {
    /// Whether they are wanted for themselves.
    pub fn is_wanted(&self) -> bool {
        self.quality
    }

    /// Judges all rides.
    pub fn judge(&self, track: &mut Track, rides: &Rides) -> QualityReport {
        let (recording, detection) = (&rides.recording, &rides.detection);
        track.judge(recording, detection);
        let report = QualityReport::new(&track.trips, recording, detection, self.rated_speed);
        if let Some(warning) = report.warning {
            warn(warning);
        }
        report
    }
}

const LEGEND: &str = "the largest, in brackets what 95 % do not exceed; m/s², speed in m/s, jerk in m/s³; vertical and horizontal \
                      vibration peak to peak, as people feel it\n";

/// The quality of all rides, in lines.
pub fn text(rides: &[Tracked], report: &QualityReport) -> String {
    let remarks = report.remarks(rides).into_iter();
    let remarks: String = remarks.map(|line| line + "\n").collect();
    let title = "\nride quality\n";
    let Some(rated_speed) = report.rated_speed else {
        return title.to_owned() + &remarks;
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
        let cells = PAIRS.map(|(_, most, usual)| {
            let most = value(most).unwrap_or_else(|| "-".to_owned());
            let usual = usual.and_then(value).map(|usual| format!(" ({usual})"));
            most + &usual.unwrap_or_default()
        });
        iter::once(ride.to_string()).chain(cells).collect()
    });
    let rows: Vec<Vec<String>> = rows.collect();
    let names: Vec<&str> = iter::once("ride").chain(PAIRS.map(|it| it.0)).collect();
    let is_beyond = |verdict| report.beyond.iter().any(|it| it.verdict == verdict);
    let verdict = if is_beyond(Verdict::Fail) {
        "!: not within"
    } else if is_beyond(Verdict::Noise) {
        "none clearly beyond"
    } else {
        "all within"
    };
    let verdict = format!("{verdict} the limits at {rated_speed:.2} m/s: {limits}\n");
    title.to_owned() + &table(&names, &rows) + LEGEND + &verdict + &remarks
}
