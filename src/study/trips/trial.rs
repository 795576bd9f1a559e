//! One trip, and its distance by every method.

use super::recorded::{Recorded, tracked};
use super::table::Point;
use crate::counts::{Fixed, Shape, Sums, Values};
use crate::recording::Sample;
use crate::rng::Stream;
use crate::track::{LiveTrips, Method, Track, TrackSettings, Uncertain};
use libm::{fabs, round};

/// How a distance is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// As `liftsim track` does it.
    Track,
    /// The same filter, sample by sample.
    Live,
    /// The patent by its words.
    Words,
    /// Integration, with the drift of the speed removed.
    DriftRemoved,
    /// Plain integration.
    Integrated,
    /// The moment formula, told the phases: the bound.
    Moments,
}

impl Way {
    pub const ALL: [Self; 6] = [
        Self::Track,
        Self::Live,
        Self::Words,
        Self::DriftRemoved,
        Self::Integrated,
        Self::Moments,
    ];

    /// Where its sums begin among the lengths.
    pub fn lengths(self) -> usize {
        2 + LENGTHS * self as usize
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Track => "track",
            Self::Live => "live",
            Self::Words => "words",
            Self::DriftRemoved => "drift_removed",
            Self::Integrated => "integrated",
            Self::Moments => "moments",
        }
    }
}

/// For each way, whether it gives the trip a distance, and whether that is within 1.96 deviations; the sums and the sums
/// of squares of the error, of its square and of the square over its variance. First the variance of the bound; last the
/// product of the squares of `track` and `drift_removed`.
pub(super) const COUNTS: usize = 2;
pub(super) const LENGTHS: usize = 6;

pub(super) fn shape() -> Shape {
    let ways = Way::ALL.len();
    Shape {
        most: vec![Some(1); COUNTS * ways],
        lengths: 2 + LENGTHS * ways + 1,
        values: vec![1; ways],
    }
}

/// Of 95 %, in deviations.
const WITHIN: f64 = 1.96;

/// Errors are counted in steps of this, m.
const STEP: f64 = 1e-4;

/// The sums of one trial.
pub(super) fn run(point: &Point, seed: u64, trial: u64) -> Sums {
    let mut draws = Stream::new(seed, "trips", "").at(trial);
    let recorded = Recorded::new(point.condition.numbers(), point.distance, &mut draws);
    let settings = TrackSettings::default();
    let samples = &recorded.samples;
    let track = tracked(samples, recorded.numbers.rate);
    let bound = recorded.bound();
    let mut sums = shape().empty().sums;
    sums.note(0, bound.variance);
    let bias = Uncertain {
        mean: track.level.bias,
        variance: settings.bias_error * settings.bias_error,
    };
    let told = recorded.told();
    for (place, way) in Way::ALL.into_iter().enumerate() {
        let found = match way {
            Way::Track => only(&track),
            Way::Live => live(samples, settings, bias.mean),
            Way::Words => live(samples, TrackSettings::by_the_words(), bias.mean),
            Way::DriftRemoved => {
                Some(told.distance(Method::DriftRemoved, samples, bias, &settings))
            }
            Way::Integrated => Some(told.distance(Method::Integrated, samples, bias, &settings)),
            Way::Moments => Some(bound),
        };
        if let Some(found) = found {
            let error = found.mean - recorded.journey.distance;
            add(&mut sums, place, error, found.variance);
        }
    }
    let square = |way: Way| sums.lengths[way.lengths() + 2].value();
    let product = square(Way::Track) * square(Way::DriftRemoved);
    *sums.lengths.last_mut().expect("there is one") = Fixed::new(product);
    sums
}

fn add(sums: &mut Sums, place: usize, error: f64, variance: f64) {
    sums.counts[COUNTS * place] = 1;
    let square = error * error;
    sums.counts[COUNTS * place + 1] = u64::from(square <= WITHIN * WITHIN * variance);
    let first = Way::ALL[place].lengths() / 2;
    for (at, value) in [error, square, square / variance].into_iter().enumerate() {
        sums.note(first + at, value);
    }
    let mut values = Values::default();
    values.push(STEP * round(fabs(error) / STEP));
    sums.values[place] = values;
}

/// The one trip that is found.
fn only(track: &Track) -> Option<Uncertain> {
    let [trip] = track.trips[..] else {
        return None;
    };
    let (mean, deviation) = trip.distance.zip(trip.deviation)?;
    let variance = deviation * deviation;
    trip.trip.stop.map(|_| Uncertain { mean, variance })
}

fn live(samples: &[Sample], settings: TrackSettings, bias: f64) -> Option<Uncertain> {
    let mut filter = LiveTrips::new(settings, bias);
    let mut told: Vec<_> = samples.iter().filter_map(|it| filter.step(*it)).collect();
    told.extend(filter.end());
    match told[..] {
        [trip] => Some(trip.travelled.distance),
        _ => None,
    }
}
