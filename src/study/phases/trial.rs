//! One trip, followed in every way.

use super::table::Point;
use crate::counts::{Shape, Sums, Values};
use crate::detection;
use crate::recording::Sample;
use crate::rng::Stream;
use crate::study::trips::{self, Recorded};
use crate::track::{Motion, Move, Moves, Rules};
use libm::{fabs, round};

/// How the cage is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// By the published rules.
    Printed,
    /// By the same, mended.
    Mended,
    /// As `liftsim track` does it.
    Track,
}

impl Way {
    pub const ALL: [Self; 3] = [Self::Printed, Self::Mended, Self::Track];

    pub fn name(self) -> &'static str {
        match self {
            Self::Printed => "printed",
            Self::Mended => "mended",
            Self::Track => "track",
        }
    }
}

/// For each way, whether the trip is told, its direction right, and its phases; the sums and the sums of squares of the share
/// of time whose phase is wrong, of the error, and of its size.
pub(super) const COUNTS: usize = 3;
pub(super) const PAIRS: usize = 3;

pub(super) fn shape() -> Shape {
    let ways = Way::ALL.len();
    Shape {
        most: vec![Some(1); COUNTS * ways],
        lengths: 2 * PAIRS * ways,
        values: vec![1; ways],
    }
}

/// Errors are counted in steps of this, m.
const STEP: f64 = 1e-4;

/// How far off a phase may begin, s.
const NEAR: f64 = 0.5;

/// The sums of these points, whose records are the same.
pub(super) fn run(points: &[&Point], seed: u64, trial: u64) -> Vec<Sums> {
    let (numbers, distance) = points[0].numbers();
    let sign = if trial.is_multiple_of(2) { 1.0 } else { -1.0 };
    let mut draws = Stream::new(seed, "phases", "").at(trial);
    let recorded = Recorded::new(numbers, sign * distance, &mut draws);
    let track = tracked(&recorded);
    let each = points.iter().map(|point| {
        let rules = Rules::printed(numbers.sigma(), point.threshold);
        let [printed, mended] = [rules, rules.mended()].map(|rules| followed(&recorded, rules));
        let mut sums = shape().empty().sums;
        for (place, followed) in [&printed, &mended, &track].into_iter().enumerate() {
            add(&mut sums, place, followed, &recorded);
        }
        sums
    });
    each.collect()
}

/// The cage as it is followed.
struct Followed {
    /// What it does at each sample.
    motions: Vec<Motion>,
    trips: Vec<Trip>,
}

/// From rest to rest.
struct Trip {
    /// m, up positive.
    distance: f64,
    /// When it starts, moves uniformly, brakes and stops, where it does each once.
    phases: Option<[f64; 4]>,
}

fn add(sums: &mut Sums, place: usize, followed: &Followed, recorded: &Recorded) {
    let Recorded {
        samples, journey, ..
    } = recorded;
    let begins = [
        journey.start,
        journey.uniform,
        journey.braking,
        journey.stop,
    ];
    let motions = followed.motions.iter().zip(samples);
    let wrong = motions.filter(|(found, it)| **found != motion(begins, it.time));
    let wrong = wrong.count() as f64 / samples.len() as f64;
    let mut lengths = [wrong, 0.0, 0.0];
    if let [trip] = &followed.trips[..] {
        let forwards = f64::from(journey.direction);
        let error = forwards * (trip.distance - journey.distance);
        lengths = [wrong, error, fabs(error)];
        let near = |found: [f64; 4]| found.iter().zip(begins).all(|(a, b)| fabs(a - b) < NEAR);
        let is_right = [
            true,
            trip.distance * journey.distance > 0.0,
            trip.phases.is_some_and(near),
        ];
        sums.counts[COUNTS * place..][..COUNTS].copy_from_slice(&is_right.map(u64::from));
        let mut values = Values::default();
        values.push(STEP * round(fabs(error) / STEP));
        sums.values[place] = values;
    }
    for (at, value) in lengths.into_iter().enumerate() {
        sums.note(PAIRS * place + at, value);
    }
}

/// What a cage does that starts, moves uniformly, brakes and stops at these times.
fn motion([start, uniform, braking, stop]: [f64; 4], time: f64) -> Motion {
    match time {
        _ if time < start || time >= stop => Motion::Rest,
        _ if time < uniform => Motion::Acceleration,
        _ if time < braking => Motion::Inertial,
        _ => Motion::Braking,
    }
}

/// By the published filter.
fn followed(recorded: &Recorded, rules: Rules) -> Followed {
    let Moves { motions, trips } = Moves::of(&recorded.samples, rules);
    let trip = |it: &Move| Trip {
        distance: it.distance,
        phases: match it.parts[..] {
            [
                (Motion::Acceleration, start),
                (Motion::Inertial, uniform),
                (Motion::Braking, braking),
            ] => Some([start, uniform, braking, it.stop]),
            _ => None,
        },
    };
    Followed {
        trips: trips.iter().map(trip).collect(),
        motions,
    }
}

fn tracked(recorded: &Recorded) -> Followed {
    let samples = &recorded.samples;
    let track = trips::tracked(samples, recorded.numbers.rate);
    let phases = |trip: &detection::Trip| {
        let (start, stop) = trip.start.zip(trip.stop)?;
        // A trip that never moves uniformly brakes where it ends to speed up.
        let braking = trip.braking.or(trip.inertial)?;
        Some([start, trip.inertial.unwrap_or(braking), braking, stop])
    };
    let whole = track.trips.iter().filter_map(|it| {
        let phases = phases(&it.trip)?;
        Some(Trip {
            distance: it.distance?,
            phases: Some(phases),
        })
    });
    let trips: Vec<Trip> = whole.collect();
    let at = |sample: &Sample| {
        let here = trips.iter().filter_map(|it| it.phases);
        let mut here = here.map(|phases| motion(phases, sample.time));
        here.find(|it| *it != Motion::Rest).unwrap_or(Motion::Rest)
    };
    Followed {
        motions: samples.iter().map(at).collect(),
        trips,
    }
}
