//! What a sensor of three axes reads at each rest of a record, and the readings over it: eqs (1)–(4) and (7)–(10) of
//! [`gravity`](super::gravity) in use.
//!
//! The axes are the record's vertical and two directions across it. At rest a sensor reads gravity: where its direction changes
//! the sensor was moved between rests, and a length that is not 9.8 m/s² is an error of its gain. A sensor without gravity reads
//! its offset.

use super::gravity::{Estimator, Parts};
use super::record::Track;
use crate::plot::ends;
use crate::recording::{GRAVITY, Recording, Sample};
use crate::vector::{Vector, angle, length, unit};
use serde::Serialize;

/// So much of a rest is looked at, in its middle, and at least so much, s.
const LOOKED_AT: f64 = 10.0;
const SHORTEST: f64 = 0.5;

/// Less is no gravity, m/s².
const LEAST: f64 = 5.0;

/// By so much gravity differs from place to place, and a little more, as a share.
const ELSEWHERE: f64 = 0.005;

/// The vertical of the record.
const UP: Vector = [0.0, 0.0, 1.0];

/// What is read at a rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Calibration {
    /// s.
    pub from: f64,
    /// s.
    pub to: f64,
    /// m/s².
    pub length: f64,
    /// Between it and the vertical of the record, if it is gravity, degrees.
    pub tilt: Option<f64>,
    #[serde(skip)]
    reads: Vector,
    #[serde(skip)]
    up: Vector,
}

/// Three axes at a time.
struct Axes<'a>(&'a [Sample], &'a [Vec<Sample>; 2]);

impl<'a> Axes<'a> {
    /// None if they were not read together.
    fn of(recording: &'a Recording) -> Option<Self> {
        let (vertical, across) = (recording.samples(), recording.across()?);
        let is_alike = |other: &Vec<Sample>| {
            let pairs = other.iter().zip(vertical);
            other.len() == vertical.len() && pairs.into_iter().all(|(a, b)| a.time == b.time)
        };
        across
            .iter()
            .all(is_alike)
            .then_some(Self(vertical, across))
    }

    fn at(&self, place: usize) -> Vector {
        let across = self.1.each_ref().map(|it| it[place].acceleration);
        [across[0], across[1], self.0[place].acceleration]
    }
}

impl Track {
    /// What is read at each rest, where three axes are in the record.
    pub fn calibrations(&self, recording: &Recording) -> Vec<Calibration> {
        let Some(axes) = Axes::of(recording) else {
            return Vec::new();
        };
        let place = |time: f64| axes.0.partition_point(|it| it.time < time);
        let each = self.rests.iter().filter_map(|rest| {
            let middle = f64::midpoint(rest.start, rest.end);
            let half = (rest.end - rest.start).min(LOOKED_AT) / 2.0;
            let (from, to) = (middle - half, middle + half);
            let readings: Vec<Vector> = (place(from)..place(to)).map(|at| axes.at(at)).collect();
            let step = self.step.unwrap_or_default();
            let reads = Estimator::Calibration.gravity(&readings, step)?;
            let length = length(reads);
            let up = unit(reads).filter(|_| length >= LEAST);
            (to - from >= SHORTEST).then_some(Calibration {
                from,
                to,
                length,
                tilt: up.map(|up| angle(up, UP)),
                reads,
                up: up.unwrap_or(UP),
            })
        });
        each.collect()
    }

    /// How much is read across gravity at each time, s, m/s²: over that of the rest before it, or of the first.
    pub fn horizontal(&self, recording: &Recording) -> Vec<(f64, f64)> {
        let calibrations = self.calibrations(recording);
        let (Some(axes), Some(first)) = (Axes::of(recording), calibrations.first()) else {
            return Vec::new();
        };
        let mut later = calibrations[1..].iter().peekable();
        let mut rest = first;
        let times = axes.0.iter().enumerate();
        let sizes = times.map(|(place, sample)| {
            while let Some(next) = later.next_if(|it| it.from <= sample.time) {
                rest = next;
            }
            let parts = Parts::of(axes.at(place), rest.reads, rest.up);
            (sample.time, length(parts.horizontal))
        });
        sizes.collect()
    }
}

/// The calibrations of a record, in words: a name and a value. What the vertical `follows` is no turn here.
pub fn calibrated(of: &[Calibration], follows: bool) -> Option<(&'static str, String)> {
    let first = of.first()?;
    let (least, most) = ends(of.iter().map(|it| it.length));
    let rests = match of.len() {
        1 => "at one rest".to_owned(),
        rests => format!("at {rests} rests"),
    };
    let lengths = if of.len() == 1 {
        format!("{least:.3} m/s²")
    } else {
        format!("{least:.3} to {most:.3} m/s²")
    };
    let mut words = format!("{lengths} {rests}");
    if first.tilt.is_none() {
        return Some(("Offset at rest", words + ", without gravity"));
    }
    let turned = of.iter().map(|it| angle(it.up, first.up));
    let turned = turned.fold(0.0, f64::max);
    words += &if follows {
        ", without the turn that is followed".to_owned()
    } else {
        format!(", turned by at most {turned:.1} degrees from the first")
    };
    let off = f64::midpoint(least, most) / GRAVITY - 1.0;
    if off.abs() > ELSEWHERE {
        let way = if off > 0.0 { "more" } else { "less" };
        let by = 100.0 * off.abs();
        words += &format!(
            "; {by:.1} % {way} than on earth: an offset, or a gain that every distance shares"
        );
    }
    Some(("Gravity at rest", words))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::detection::Detection;
    use crate::monitor;
    use crate::recording::Reading;
    use crate::track::TrackSettings;
    use std::fmt::Write;

    /// A sensor of 1.01 that stands for 10 s, goes up for 6 s, is turned by 2 degrees, and stands again.
    fn recording(gravity: f64) -> Recording {
        let mut text = "t (s),x (m/s^2),y (m/s^2),z (m/s^2)\n".to_owned();
        for sample in 0..2600 {
            let time = f64::from(sample) / 100.0;
            let pulse = |from: f64| {
                if (from..from + 1.5).contains(&time) {
                    1.0
                } else {
                    0.0
                }
            };
            let up = 1.01 * (gravity + pulse(10.0) - pulse(14.5));
            let turned: f64 = if time < 16.0 { 0.0 } else { 2.0 };
            let (sin, cos) = turned.to_radians().sin_cos();
            let shake = 0.01 * f64::from(sample % 7 - 3);
            writeln!(
                text,
                "{time},{},{shake},{}",
                0.3 + up * sin,
                up * cos + shake
            )
            .unwrap();
        }
        let reading = Reading {
            across: true,
            ..Reading::default()
        };
        Recording::from_bytes("made.csv", text.into_bytes(), &reading).unwrap()
    }

    fn tracked(recording: &Recording) -> Track {
        let design = monitor::Settings::default().at(100.0).unwrap();
        let detection = Detection::of(&design, recording.samples(), None, Some(true));
        let samples = recording.samples();
        Track::of(samples, None, &detection, TrackSettings::default())
    }

    #[test]
    fn gravity_shows_a_gain_and_a_turn() {
        let recording = recording(9.81);
        let track = tracked(&recording);
        let calibrations = track.calibrations(&recording);
        assert_eq!(calibrations.len(), 2, "{calibrations:?}");
        for it in &calibrations {
            assert!((it.length - 1.01 * 9.81).abs() < 0.02, "{it:?}");
        }
        let turned = angle(calibrations[0].up, calibrations[1].up);
        assert!((turned - 2.0).abs() < 0.02, "{turned}");
        let (name, words) = calibrated(&calibrations, false).unwrap();
        assert_eq!(name, "Gravity at rest");
        let part =
            "at 2 rests, turned by at most 2.0 degrees from the first; 1.1 % more than on earth";
        assert!(words.contains(part), "{words}");
        // In motion nothing is across but the shaking, and the turn is seen until the next rest.
        let horizontal = track.horizontal(&recording);
        let most = |from: f64, to: f64| {
            let part = horizontal.iter().filter(|it| (from..to).contains(&it.0));
            part.fold(0.0, |most: f64, it| most.max(it.1))
        };
        assert!(most(0.0, 15.9) < 0.05, "{}", most(0.0, 15.9));
        assert!(most(22.0, 26.0) < 0.05, "{}", most(22.0, 26.0));
    }

    #[test]
    fn without_gravity_rest_reads_an_offset() {
        let recording = recording(0.0);
        let calibrations = tracked(&recording).calibrations(&recording);
        let (name, words) = calibrated(&calibrations, false).unwrap();
        assert_eq!(name, "Offset at rest");
        assert!(words.starts_with("0.30"), "{words}");
        assert!(
            words.ends_with("rests, without gravity") || words.ends_with("rest, without gravity"),
            "{words}"
        );
    }
}
