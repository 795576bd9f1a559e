//! What a sensor of three axes reads at each rest of a record, and the readings over it: eqs (1)–(4) and (7)–(10) of
//! [`gravity`](super::gravity) in use.
//!
//! The axes are the record's vertical and two directions across it. At rest a sensor reads gravity: where its direction changes
//! the sensor was moved between rests, and a length that is not 9.8 m/s² is an error of its gain. A sensor without gravity reads
//! its offset.

use super::gravity::{Estimator, Parts};
use super::record::Track;
use crate::plot::ends;
use crate::recording::{Recording, Sample};
use crate::vector::{Vector, angle, length, unit};
use serde::Serialize;

/// So much of a rest is looked at, in its middle, and at least so much, s.
const LOOKED_AT: f64 = 10.0;
const SHORTEST: f64 = 0.5;

/// Less is no gravity, m/s².
const LEAST: f64 = 5.0;

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

/// The calibrations of a record, in words: a name and a value.
pub fn calibrated(of: &[Calibration]) -> Option<(&'static str, String)> {
    let first = of.first()?;
    let (least, most) = ends(of.iter().map(|it| it.length));
    let rests = match of.len() {
        1 => "at one rest".to_owned(),
        rests => format!("at {rests} rests"),
    };
    let lengths = format!("{least:.3} to {most:.3} m/s² {rests}");
    if first.tilt.is_none() {
        return Some(("offset", lengths + ", without gravity"));
    }
    let turned = of.iter().map(|it| angle(it.up, first.up));
    let turned = turned.fold(0.0, f64::max);
    Some((
        "gravity",
        format!("{lengths}, turned by at most {turned:.1} degrees"),
    ))
}
