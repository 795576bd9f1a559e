//! Ride quality: how hard a ride accelerates and brakes, how fast and how smooth it is, beside the limits of a norm.
//!
//! | figure | is |
//! |---|---|
//! | `acceleration`, `deceleration` | the largest, m/s², behind a low pass of 10 Hz |
//! | `acceleration_95`, `deceleration_95` | what 95 % of them do not exceed, between 5 and 95 % of the ride's highest speed |
//! | `speed`, `speed_95` | the largest, m/s, and what 95 % of the speeds above 0.95 of it do not exceed |
//! | `jerk` | the largest slope of a line through 0.5 s, m/s³, behind the low pass |
//! | `vertical`, `vertical_95` | peak to peak, m/s², weighted by W_k, in uniform motion |
//! | `horizontal`, `horizontal_95` | the same by W_d, the larger of two directions, from 0.5 s after the start to 0.5 s before the stop |
//!
//! Peak to peak is the sum of two neighbouring largest values between crossings of zero; `_95` is what 95 % of those sums do
//! not exceed. The speed is the integral of the acceleration, zero at both ends.
//!
//! # What was checked, and what was not
//! The weightings agree with the tables of ISO 8041-1 to four digits. The text of ISO 18738-1 (ISO 8100-34) and of GB/T 10058
//! could not be read: the definitions above follow what others write of them, and the limits of GB/T 10058-2009 are from
//! memory. A norm begins its measurement with the doors; here it begins with the motion, since an accelerometer does not see
//! doors. Vertical vibration is looked at in uniform motion alone: while the acceleration changes, the band limit passes some of it.

mod limits;
mod peaks;
mod signal;
#[cfg(test)]
mod tests;
mod weighting;

pub use limits::{Limit, Limits, Verdict};
pub use weighting::Weighting;

use super::phases::Phases;
use crate::recording::Sample;
use peaks::{greatest, peak_to_peak};
use serde::{Serialize, Serializer};
use signal::{SHORTEST, Signal};
use std::ops::Range;
use weighting::slopes;

/// The lowest rate of a record whose rides are judged, Hz: twice the low pass.
pub const LEAST_RATE: f64 = 20.0;

/// What is no more than so many times what rest shows may be noise.
const NOISE: f64 = 1.5;

/// How long a line is for a jerk, s.
const LINE: f64 = 0.5;

/// Left out at both ends for horizontal vibration, s.
const BOUNDARY: f64 = 0.5;

/// For so long the band limit remembers a change of the acceleration, s.
const REMEMBERS: f64 = 1.2;

/// The shares of the highest speed between which a cage speeds up, and brakes.
const SPEEDS: (f64, f64) = (0.05, 0.95);

/// A figure of a ride.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the module's table says it")]
pub enum Measure {
    Acceleration,
    Acceleration95,
    Deceleration,
    Deceleration95,
    Speed,
    Speed95,
    Jerk,
    Vertical,
    Vertical95,
    Horizontal,
    Horizontal95,
}

impl Measure {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Acceleration,
        Self::Acceleration95,
        Self::Deceleration,
        Self::Deceleration95,
        Self::Speed,
        Self::Speed95,
        Self::Jerk,
        Self::Vertical,
        Self::Vertical95,
        Self::Horizontal,
        Self::Horizontal95,
    ];

    /// The name of its column.
    pub fn name(self) -> &'static str {
        match self {
            Self::Acceleration => "acceleration",
            Self::Acceleration95 => "acceleration_95",
            Self::Deceleration => "deceleration",
            Self::Deceleration95 => "deceleration_95",
            Self::Speed => "top_speed",
            Self::Speed95 => "speed_95",
            Self::Jerk => "jerk",
            Self::Vertical => "vertical",
            Self::Vertical95 => "vertical_95",
            Self::Horizontal => "horizontal",
            Self::Horizontal95 => "horizontal_95",
        }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Speed | Self::Speed95 => "m/s",
            Self::Jerk => "m/s³",
            _ => "m/s²",
        }
    }
}

/// Figures that stand side by side: a name, the largest, and what 95 % do not exceed.
pub const PAIRS: [(&str, Measure, Option<Measure>); 6] = {
    use Measure::*;
    [
        ("acceleration", Acceleration, Some(Acceleration95)),
        ("deceleration", Deceleration, Some(Deceleration95)),
        ("speed", Speed, Some(Speed95)),
        ("jerk", Jerk, None),
        ("vertical", Vertical, Some(Vertical95)),
        ("horizontal", Horizontal, Some(Horizontal95)),
    ]
};

/// The value of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Figure {
    /// In the unit of its measure.
    pub value: f64,
    /// What rest before the ride shows in its place, which is noise.
    pub at_rest: Option<f64>,
}

impl Figure {
    /// Whether it may be the noise of the sensor.
    pub fn is_noise(&self) -> bool {
        self.at_rest.is_some_and(|rest| self.value <= NOISE * rest)
    }
}

/// The figures of a ride, in the order of [`Measure::ALL`]; those that the record shows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quality([Option<Figure>; Measure::ALL.len()]);

impl Quality {
    /// A figure.
    pub fn figure(&self, measure: Measure) -> Option<Figure> {
        self.0[measure as usize]
    }

    fn set(&mut self, measure: Measure, figure: Option<Figure>) {
        self.0[measure as usize] = figure;
    }

    /// Of a ride in these phases, from the vertical and, if it was read, from two directions across it; none if a hole is
    /// in it, or too little rest around it to know what rest reads.
    pub(crate) fn of(
        vertical: &[Sample],
        across: &[Vec<Sample>],
        rate: f64,
        ride: &Ride,
    ) -> Option<Self> {
        let vertical = Signal::of(vertical, rate, &ride.phases)?;
        let mut quality = Self::default();
        quality.accelerate(&vertical, ride);
        let uniform = &ride.phases.uniform[0];
        quality.vibrate(
            [Measure::Vertical, Measure::Vertical95],
            &[vertical.weighted(Weighting::Vertical)],
            &(uniform.start + REMEMBERS..uniform.end),
        );
        let across = across.iter().map(|it| Signal::of(it, rate, &ride.phases));
        let across: Option<Vec<Signal>> = across.collect();
        let across = across.unwrap_or_default();
        let across: Vec<Signal> = across
            .iter()
            .map(|it| it.weighted(Weighting::Horizontal))
            .collect();
        let trip = ride.phases.trip();
        quality.vibrate(
            [Measure::Horizontal, Measure::Horizontal95],
            &across,
            &(trip.start + BOUNDARY..trip.end - BOUNDARY),
        );
        Some(quality)
    }

    /// Acceleration, speed and jerk.
    fn accelerate(&mut self, vertical: &Signal, ride: &Ride) {
        let trip = vertical.places(&ride.phases.trip());
        let speeds = vertical.speeds(&trip);
        let top = speeds
            .iter()
            .fold(0.0, |top: f64, speed| top.max(speed.abs()));
        let is_above = |share: f64| move |speed: &f64| speed.abs() >= share * top;
        let first = |share| speeds.iter().position(is_above(share));
        let last = |share| speeds.iter().rposition(is_above(share));
        let [up_from, up_to] = [SPEEDS.0, SPEEDS.1].map(|it| first(it).unwrap_or(0));
        let [down_from, down_to] = [SPEEDS.1, SPEEDS.0].map(|it| last(it).unwrap_or(0));
        let smooth = vertical.weighted(Weighting::LowPass);
        let along: Vec<f64> = smooth.values[trip.clone()]
            .iter()
            .map(|it| ride.sign * it)
            .collect();
        let braking: Vec<f64> = along.iter().map(|it| -it).collect();
        let rest = smooth.at(&ride.phases.before).iter().map(|it| it.abs());
        let rest = greatest(rest.collect());
        let sides = [
            (
                [Measure::Acceleration, Measure::Acceleration95],
                &along,
                up_from..up_to + 1,
            ),
            (
                [Measure::Deceleration, Measure::Deceleration95],
                &braking,
                down_from..down_to + 1,
            ),
        ];
        for (measures, values, between) in sides {
            let most = greatest(values.clone());
            let between = values.get(between).unwrap_or_default();
            let usual = greatest(between.iter().map(|it| it.abs()).collect());
            self.pair(
                measures,
                most.zip(usual).map(|(most, usual)| (most.0, usual.1)),
                rest,
            );
        }
        let fast = speeds
            .iter()
            .map(|it| it.abs())
            .filter(|it| *it >= SPEEDS.1 * top);
        self.pair(
            [Measure::Speed, Measure::Speed95],
            greatest(fast.collect()),
            None,
        );
        let steepest = |values: &[f64]| {
            let slopes = slopes(values, vertical.rate, LINE);
            greatest(slopes.iter().map(|it| it.abs()).collect()).map(|it| it.0)
        };
        let jerk = steepest(&smooth.values[trip]).map(|value| Figure {
            value,
            at_rest: steepest(smooth.at(&ride.phases.before)),
        });
        self.set(Measure::Jerk, jerk);
    }

    /// Vibration within a time: of the directions the one in which it is larger.
    fn vibrate(&mut self, measures: [Measure; 2], weighted: &[Signal], within: &Range<f64>) {
        if within.end - within.start < SHORTEST {
            return;
        }
        // What never crosses zero does not vibrate.
        let shakes = |part: &[f64]| greatest(peak_to_peak(part)).unwrap_or_default();
        let each = weighted.iter().map(|signal| {
            let rest = signal.rest.end - signal.rest.start >= SHORTEST;
            let rest = rest.then(|| shakes(signal.at(&signal.rest)));
            (shakes(signal.at(within)), rest)
        });
        let largest = |all: Vec<(f64, f64)>| {
            let larger = |a: (f64, f64), b: (f64, f64)| (a.0.max(b.0), a.1.max(b.1));
            all.into_iter().reduce(larger)
        };
        let (found, rests): (Vec<_>, Vec<_>) = each.unzip();
        let rests = rests.into_iter().flatten().collect();
        self.pair(measures, largest(found), largest(rests));
    }

    fn pair(
        &mut self,
        measures: [Measure; 2],
        found: Option<(f64, f64)>,
        rest: Option<(f64, f64)>,
    ) {
        let Some((most, usual)) = found else {
            return;
        };
        let figure = |value, at_rest| Some(Figure { value, at_rest });
        self.set(measures[0], figure(most, rest.map(|it| it.0)));
        self.set(measures[1], figure(usual, rest.map(|it| it.1)));
    }
}

impl Serialize for Quality {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(Measure::ALL.map(|it| (it.name(), self.figure(it))))
    }
}

/// A ride to be judged.
pub(crate) struct Ride {
    pub phases: Phases,
    /// 1 if it goes up, −1 if down.
    pub sign: f64,
}
