//! One lift: what is learnt of it, and what its guard line does.

use super::car::{Car, DRIVE, JOINT, RATE, Way, knock_at};
use super::keys::{Keys, MOST_TRIPS};
use super::measure::Measure;
use crate::counts::{Fixed, Shape, Sums};
use crate::lift::{Ending, Pickup, Ride, Trip};
use crate::recording::Sample;
use crate::rng::{self, Generator, Stream};
use crate::study::curves::Point;
use crate::study::trips;
use crate::track::vibration::{Baseline, PrintedStop, Stop};
use crate::track::{Densities, Exceedance, Placed, Track};
use libm::{fabs, sqrt};

/// The ordinary trips that are tested, and those alike that show the true mean.
const TESTED: usize = 100;
const TRUTH: usize = 400;

/// A mean is early if it is off by more than this share.
const EARLY: f64 = 0.1;

/// Of baselines, how many stop and how many of these are early, and how many have a guard line; the sums and the sums of squares
/// of the mean's relative error's square, the trips and windows learnt, the line over the true mean, and the shares of windows and
/// of trips above it.
pub(super) const COUNTS: usize = 3;
pub(super) const PAIRS: usize = 6;

/// A height at which the car knocks, m: beside it is a joint of the rails.
const KNOCK: f64 = 3.0 * JOINT;

/// The trip with a knock goes from here to there, m, or back, with rests of these, s.
const WAY: [f64; 2] = [3.0, 30.0];
const RESTS: [f64; 2] = [5.0, 5.0];

/// What a measure sums up.
pub fn shape(measure: Measure) -> Shape {
    match measure {
        Measure::Baseline => Shape {
            most: vec![Some(1); COUNTS],
            lengths: 2 * PAIRS,
            ..Shape::default()
        },
        Measure::Knock => Shape {
            most: vec![Some(1); COUNTS],
            lengths: 2,
            ..Shape::default()
        },
    }
}

/// The sums of one trial for points that share a lift.
pub fn run(measure: Measure, points: &[&Point<Keys>], seed: u64, trial: u64) -> Vec<Sums> {
    let draws = |purpose: &str| Stream::new(seed, purpose, "").at(trial);
    let car = Car::new(&points[0].of, &mut draws("vibration"));
    let mut lift = Lift {
        draws: draws("vibration learnt"),
        car,
        trips: Vec::new(),
    };
    let baselines = points.iter().map(|point| lift.learnt(&point.of));
    let baselines: Vec<(Baseline, bool)> = baselines.collect();
    match measure {
        Measure::Baseline => {
            let mut tested = draws("vibration tested");
            let tested = lift.energies(TESTED, &mut tested);
            let truth = lift.mean(&mut draws("vibration truth"));
            let each = points.iter().zip(&baselines);
            each.map(|(point, learnt)| baseline(&point.of, learnt, truth, &tested))
                .collect()
        }
        Measure::Knock => {
            let knocked = Knocked::new(&lift.car, seed, trial);
            let each = points.iter().zip(&baselines);
            each.map(|(point, (learnt, _))| knocked.sums(&point.of, learnt))
                .collect()
        }
    }
}

/// A lift and the trips that were made to learn of it.
struct Lift {
    draws: Generator,
    car: Car,
    trips: Vec<Vec<f64>>,
}

impl Lift {
    fn energies(&self, trips: usize, draws: &mut Generator) -> Vec<Vec<f64>> {
        let trips = (0..trips).map(|_| {
            let way = self.car.way(draws);
            self.car.energies(&way, draws)
        });
        trips.collect()
    }

    /// The mean energy of a window.
    fn mean(&self, draws: &mut Generator) -> f64 {
        let trips = (0..TRUTH).flat_map(|_| {
            let way = Way {
                energy: 1.0,
                ..self.car.way(draws)
            };
            self.car.energies(&way, draws)
        });
        let (sum, number) = trips.fold((0.0, 0.0), |(sum, number), it| (sum + it, number + 1.0));
        sum / number
    }

    fn trip(&mut self, place: usize) -> &[f64] {
        while self.trips.len() <= place {
            let way = self.car.way(&mut self.draws);
            let energies = self.car.energies(&way, &mut self.draws);
            self.trips.push(energies);
        }
        &self.trips[place]
    }

    /// What a rule learns, and whether it stops.
    fn learnt(&mut self, keys: &Keys) -> (Baseline, bool) {
        let mut baseline = Baseline::new(RATE);
        let mut printed = PrintedStop::default();
        for place in 0..keys.trips.unwrap_or(MOST_TRIPS) {
            let energies = self.trip(place);
            let level = energies
                .iter()
                .position(|energy| printed.step(*energy).is_some_and(PrintedStop::is_level));
            let stops = keys.trips.is_none() && keys.stop == Stop::Printed;
            if let Some(last) = level.filter(|_| stops) {
                baseline.learn(energies[..=last].to_vec());
                return (baseline, true);
            }
            baseline.learn(energies.to_vec());
            let settles = keys.trips.is_none() && keys.stop == Stop::StandardError;
            if settles && baseline.has_settled() {
                return (baseline, true);
            }
        }
        (baseline, keys.trips.is_some())
    }
}

fn guard(keys: &Keys, baseline: &Baseline) -> Option<f64> {
    keys.guard.line(baseline.trips().concat(), keys.alarm_rate)
}

fn baseline(
    keys: &Keys,
    (baseline, stops): &(Baseline, bool),
    truth: f64,
    tested: &[Vec<f64>],
) -> Sums {
    let off = baseline.mean().map_or(0.0, |mean| mean / truth - 1.0);
    let guard = guard(keys, baseline);
    let line = guard.unwrap_or(f64::INFINITY);
    let above = |trip: &Vec<f64>| trip.iter().filter(|it| **it > line).count();
    let windows: usize = tested.iter().map(Vec::len).sum();
    let alarmed = tested.iter().filter(|trip| above(trip) > 0).count();
    let values = [
        off * off,
        baseline.trips().len() as f64,
        baseline.windows() as f64,
        guard.map_or(0.0, |guard| guard / truth),
        tested.iter().map(above).sum::<usize>() as f64 / windows as f64,
        alarmed as f64 / tested.len() as f64,
    ];
    let counts = [*stops, *stops && fabs(off) > EARLY, guard.is_some()];
    sums(&counts, &values)
}

fn sums(counts: &[bool], values: &[f64]) -> Sums {
    let pairs = values.iter().flat_map(|it| [*it, it * it]);
    Sums {
        counts: counts.iter().map(|it| u64::from(*it)).collect(),
        lengths: pairs.map(Fixed::new).collect(),
        ..Sums::default()
    }
}

/// A recorded trip, before it is knocked.
struct Knocked {
    across: [Vec<Sample>; 2],
    /// The sample of the knock, its direction, and its position from the start, m.
    place: usize,
    direction: [f64; 2],
    position: f64,
    track: Track,
}

impl Knocked {
    fn new(car: &Car, seed: u64, trial: u64) -> Self {
        let mut draws = Stream::new(seed, "vibration knock", "").at(trial);
        let up = rng::unit(&mut draws) < 0.5;
        let [low, high] = WAY;
        let heights = if up { [low, high] } else { [high, low] };
        let way = car.way_between(&mut draws, heights);
        let trip = Trip {
            distance: way.to - way.from,
            drive: DRIVE,
            ending: Ending::Commanded,
        };
        let ride = Ride::new(RATE, RESTS.to_vec(), vec![trip]).expect("every limit is positive");
        let speeds = ride.acceleration().into_iter().scan(0.0, |speed, it| {
            *speed += it / RATE;
            Some(*speed)
        });
        let speeds: Vec<f64> = speeds.collect();
        let across = car.across(&way, &speeds, &mut draws);
        let (mut height, mut place) = (way.from, 0);
        while place < speeds.len() && (height < KNOCK) == up {
            height += speeds[place] / RATE;
            place += 1;
        }
        let turn = std::f64::consts::TAU * rng::unit(&mut draws);
        Self {
            across,
            place,
            direction: [libm::cos(turn), libm::sin(turn)],
            position: height - way.from,
            track: tracked(&ride, seed, trial),
        }
    }

    /// Whether one ride is found, whether the knock is, and whether there is an alarm elsewhere; and how far off it is located.
    fn sums(&self, keys: &Keys, baseline: &Baseline) -> Sums {
        let line = guard(keys, baseline).unwrap_or(f64::INFINITY);
        let mut across = self.across.clone();
        for (samples, along) in across.iter_mut().zip(self.direction) {
            let mut added = vec![0.0; samples.len()];
            knock_at(&mut added, self.place, keys.size * along);
            let each = samples.iter_mut().zip(added);
            each.for_each(|(sample, added)| sample.acceleration += added);
        }
        let windows: Vec<Placed> = match &self.track.trips[..] {
            [trip] => self.track.windows(trip, &across, RATE),
            _ => Vec::new(),
        };
        let time = self.place as f64 / RATE;
        let alarms = Exceedance::all(&windows, line);
        // What rings on after it is the same knock.
        let (here, elsewhere): (Vec<_>, Vec<_>) = alarms
            .into_iter()
            .partition(|it| it.from <= time + OVER && time <= it.to);
        let found = here.iter().find_map(|it| it.most.position);
        let off = found.map_or(0.0, |position| position - self.position);
        let counts = [!windows.is_empty(), found.is_some(), !elsewhere.is_empty()];
        sums(&counts, &[off * off])
    }
}

/// How long a knock rings on, s.
const OVER: f64 = 0.5;

/// The vertical, as a phone reads it, and its rides as `liftsim track` finds them.
fn tracked(ride: &Ride, seed: u64, trial: u64) -> Track {
    let density = Densities::default().acceleration;
    let pickup = Pickup::white(sqrt(density * RATE));
    let record = ride.simulate(&pickup, seed, trial).record;
    let samples = record.iter().enumerate().map(|(place, it)| Sample {
        time: place as f64 / RATE,
        acceleration: *it,
    });
    let samples: Vec<Sample> = samples.collect();
    trips::tracked(&samples, RATE)
}
