//! The trips of a record by the published filter.

use super::{LEARNT, Motion, Rules, VerticalFilter};
use crate::monitor::Direction;
use crate::recording::Sample;
use crate::track::Level;
use crate::track::steps::HOLE;
use libm::sqrt;
use serde::Serialize;

/// A shorter motion is no trip, m.
const LEAST: f64 = 0.5;

/// A shorter part of one is noise, s.
const PART: f64 = 0.25;

/// The threshold where none is given, in deviations of a reading, and the least of those, m/s².
const LOUD: f64 = 5.0;
const LEAST_NOISE: f64 = 0.005;

/// What a cage does, sample by sample, and its trips.
#[derive(Clone, Debug, Default)]
pub struct Moves {
    /// At each sample.
    pub motions: Vec<Motion>,
    /// In order of time.
    pub trips: Vec<Move>,
}

/// The trips of a recording, and by which numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ByRules {
    /// Of a reading, m/s².
    pub threshold: f64,
    /// The deviation of a reading at rest, m/s².
    pub noise: f64,
    /// In order of time.
    pub trips: Vec<Move>,
}

impl ByRules {
    /// They need so much rest at the beginning, s.
    pub const REST: f64 = LEARNT;

    /// Those of a record of so many samples a second whose sensor is of this level; unless a threshold is given, m/s², that
    /// which its noise at rest hardly ever exceeds.
    pub fn new(samples: &[Sample], rate: f64, level: &Level, threshold: Option<f64>) -> Self {
        let noise = sqrt(level.rest.density * rate).max(LEAST_NOISE);
        let threshold = threshold.unwrap_or(LOUD * noise);
        Self {
            threshold,
            noise,
            trips: Moves::of(samples, Rules::printed(noise, threshold)).trips,
        }
    }
}

/// A motion from rest to rest. Times in s.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Move {
    /// Which way.
    pub direction: Direction,
    /// When it starts.
    pub start: f64,
    /// And stops.
    pub stop: f64,
    /// m, up positive.
    pub distance: f64,
    /// What it does in turn, and from when on.
    pub parts: Vec<(Motion, f64)>,
}

impl Moves {
    /// Those of a record that begins with some seconds of rest.
    pub fn of(samples: &[Sample], rules: Rules) -> Self {
        let Some(first) = samples.first() else {
            return Self::default();
        };
        let mut filter = VerticalFilter::learnt(rules, samples);
        let mut moves = Self::default();
        let mut under_way: Option<Move> = None;
        let (mut last, mut distance) = (first.time, 0.0);
        for sample in samples {
            let now = filter.step(*sample);
            moves.motions.push(now.motion);
            if now.time - last > HOLE {
                (under_way, distance) = (None, 0.0);
            }
            distance += now.speed * (now.time - last);
            last = now.time;
            let part = (now.motion, now.time);
            match (now.motion, &mut under_way) {
                (Motion::Rest, _) => {
                    let whole = under_way.take().and_then(|it| it.ended(now.time, distance));
                    moves.trips.extend(whole);
                    distance = 0.0;
                }
                (motion, Some(it)) if it.parts.last().is_some_and(|last| last.0 != motion) => {
                    it.parts.push(part);
                }
                (_, Some(_)) => {}
                (_, None) => under_way = Some(Move::begun(part)),
            }
        }
        moves
    }
}

impl Move {
    fn begun(part: (Motion, f64)) -> Self {
        Self {
            direction: Direction::Up,
            start: part.1,
            stop: part.1,
            distance: 0.0,
            parts: vec![part],
        }
    }

    /// Ends it, if it is a trip.
    fn ended(mut self, stop: f64, distance: f64) -> Option<Self> {
        let ends: Vec<f64> = self.parts[1..]
            .iter()
            .map(|part| part.1)
            .chain([stop])
            .collect();
        let mut ends = ends.into_iter();
        self.parts
            .retain(|part| ends.next().is_some_and(|end| end - part.1 >= PART));
        self.parts.dedup_by_key(|part| part.0);
        let direction = if distance > 0.0 {
            Direction::Up
        } else {
            Direction::Down
        };
        (distance.abs() > LEAST).then_some(Self {
            direction,
            stop,
            distance,
            ..self
        })
    }
}
