//! One building: its sweep, its trips, and what is measured after them.

use super::building::{Building, Measured};
use super::keys::Keys;
use super::measure::Measure;
use crate::counts::{Fixed, Shape, Sums};
use crate::rng::Stream;
use crate::study::curves::Point;
use crate::track::floors::{Floors, Map, Start, Stop};
use libm::sqrt;

/// The building of a trial, its map, and what was counted so far.
struct Run {
    building: Building,
    map: Floors,
    /// The position by the map at the latest stop, m.
    position: f64,
    /// The sum of all measured distances, m.
    reckoned: f64,
    counted: Stops,
}

/// Ordinary stops.
#[derive(Clone, Copy, Debug, Default)]
struct Stops {
    all: u64,
    at_once: u64,
    again: u64,
    any: u64,
    wrong: u64,
    was_alarm: bool,
}

/// What a measure sums up.
pub fn shape(measure: Measure, points: &[Point<Keys>]) -> Shape {
    let trips = points
        .iter()
        .map(|point| point.of.trips)
        .max()
        .unwrap_or_default();
    let (one, trips) = (Some(1), Some(trips as u64));
    match measure {
        Measure::Alarm => Shape {
            most: vec![one, one, trips, trips, trips, trips],
            ..Shape::default()
        },
        Measure::Stops => Shape {
            most: vec![trips, trips, trips, trips, trips],
            ..Shape::default()
        },
        Measure::Position => Shape {
            lengths: 8,
            ..Shape::default()
        },
        Measure::Healing => Shape::events(1),
    }
}

/// The sums of one trial for points that share a building.
pub fn run(measure: Measure, points: &[&Point<Keys>], seed: u64, trial: u64) -> Vec<Sums> {
    let keys = &points[0].of;
    let mut run = Run::new(keys, seed, trial);
    let probes = Stream::new(seed, "floors after", "").at(trial);
    if measure == Measure::Position {
        return positions(run, points);
    }
    (0..keys.trips).for_each(|_| run.ride());
    run.building.draws = probes;
    match measure {
        Measure::Alarm => points.iter().map(|point| run.alarm(&point.of)).collect(),
        Measure::Healing => run.healing(points),
        Measure::Stops | Measure::Position => vec![Sums::of(&run.counted.counts())],
    }
}

/// The errors after each point's trips, in one course.
fn positions(mut run: Run, points: &[&Point<Keys>]) -> Vec<Sums> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by_key(|at| points[*at].of.trips);
    let mut sums = vec![Sums::default(); points.len()];
    let mut done = 0;
    for at in order {
        let trips = points[at].of.trips;
        (done..trips).for_each(|_| run.ride());
        done = trips;
        sums[at] = run.errors();
    }
    sums
}

impl Run {
    fn new(keys: &Keys, seed: u64, trial: u64) -> Self {
        let draws = Stream::new(seed, "floors", "").at(trial);
        let mut building = Building::new(draws, vec![0.0], keys.level);
        for floor in 1..keys.floors {
            let storey = keys.storey + keys.uneven * building.normal();
            building.heights.push(building.heights[floor - 1] + storey);
        }
        (building.noise, building.traffic) = (keys.noise, keys.traffic);
        let settings = keys.settings();
        let mut map = Floors::unknown(settings).expect("the settings were checked");
        let mut reckoned = building.car;
        let mut position = 0.0;
        for floor in 1..keys.floors {
            let trip = building.go(floor, 0.0);
            reckoned += trip.distance;
            position = map.step(trip.distance, trip.variance).position;
        }
        if keys.vague > 0.0 {
            let error = building.within(keys.vague, 0.9 * keys.storey);
            map = blurred(&map, keys, error);
        }
        Self {
            building,
            position,
            map,
            reckoned,
            counted: Stops::default(),
        }
    }

    fn step(&mut self, trip: Measured) -> Stop {
        self.reckoned += trip.distance;
        let stop = self.map.step(trip.distance, trip.variance);
        self.position = stop.position;
        stop
    }

    fn ride(&mut self) {
        let to = self.building.next();
        let trip = self.building.go(to, 0.0);
        let stop = self.step(trip);
        self.counted.add(&stop, to);
    }

    /// A trip that ends beside its floor, and the next.
    fn alarm(&self, keys: &Keys) -> Sums {
        let mut building = self.building.clone();
        let mut map = self.map.clone();
        let mut stop = |building: &mut Building, to: usize, offset: f64| {
            let trip = building.go(to, offset);
            map.step(trip.distance, trip.variance)
        };
        let low = building.below(keys.floors - keys.storeys);
        let is_up = building.unit() < 0.5;
        let (low, high) = (low, low + keys.storeys);
        let [from, to] = if is_up { [low, high] } else { [high, low] };
        if building.at != from {
            stop(&mut building, from, 0.0);
        }
        let offset = keys.offset * building.sign();
        let first = stop(&mut building, to, offset);
        let next = building.away(keys.next_storeys);
        let second = stop(&mut building, next, 0.0);
        let at_once = first.judgement.is_some_and(|of| of.fault.is_some());
        let again = second.earlier.is_some_and(|of| of.fault.is_some());
        let Stops {
            all,
            at_once: ordinary,
            again: ordinary_again,
            any,
            ..
        } = self.counted;
        Sums::of(&[
            u64::from(at_once),
            u64::from(again),
            all,
            ordinary,
            ordinary_again,
            any,
        ])
    }

    /// After a trip that the map is not told of.
    fn healing(mut self, points: &[&Point<Keys>]) -> Vec<Sums> {
        let to = self.building.next();
        self.building.go(to, 0.0);
        let mut sums = vec![Sums::of(&[0]); points.len()];
        let longest = points.iter().map(|point| point.of.since).max();
        for since in 1..=longest.unwrap_or_default() {
            let to = self.building.next();
            let trip = self.building.go(to, 0.0);
            let is_right = self.step(trip).floor == Some(to);
            for (point, sums) in points.iter().zip(&mut sums) {
                if point.of.since == since {
                    sums.counts[0] = u64::from(is_right);
                }
            }
        }
        sums
    }

    /// Squares and fourth powers of the errors of the position by the map and by the sum of trips, of the heights,
    /// and the normalised square of the heights' error with its square.
    fn errors(&self) -> Sums {
        let building = &self.building;
        let lowest = building.heights[0];
        let position = self.position - (building.car - lowest);
        let reckoned = self.reckoned - building.car;
        let heights = building.heights.iter().map(|height| height - lowest);
        let heights: Vec<f64> = heights.collect();
        let (square, normalised) = map_errors(&self.map.map(), &heights);
        let values = [position * position, reckoned * reckoned, square, normalised];
        Sums {
            lengths: values
                .iter()
                .flat_map(|x| [Fixed::new(*x), Fixed::new(x * x)])
                .collect(),
            ..Sums::default()
        }
    }
}

/// The map with one floor, the middle one, as if from a plan.
fn blurred(map: &Floors, keys: &Keys, error: f64) -> Floors {
    let mut map = map.map();
    let (floors, at) = (keys.floors, keys.floors / 2);
    map.heights[at] += error;
    for floor in 0..floors {
        map.covariance[at * floors + floor] = 0.0;
        map.covariance[floor * floors + at] = 0.0;
    }
    map.covariance[at * floors + at] = keys.vague * keys.vague;
    let start = Start::Floor(floors - 1);
    Floors::known(keys.settings(), &map, start).expect("floors stay in order")
}

/// The mean square of the heights' errors, and their normalised square, eᵀ P⁻¹ e per floor, by Cholesky's factor;
/// of all floors but the lowest, which is 0 by definition.
fn map_errors(map: &Map, truth: &[f64]) -> (f64, f64) {
    let n = truth.len();
    let mut factor = map.covariance.clone();
    let mut whitened: Vec<f64> = map.heights.iter().zip(truth).map(|(a, b)| a - b).collect();
    let square = whitened.iter().map(|error| error * error).sum::<f64>();
    for i in 1..n {
        for j in 1..=i {
            let sum: f64 = (1..j).map(|k| factor[i * n + k] * factor[j * n + k]).sum();
            let rest = factor[i * n + j] - sum;
            factor[i * n + j] = if i == j {
                sqrt(rest)
            } else {
                rest / factor[j * n + j]
            };
        }
        let sum: f64 = (1..i).map(|k| factor[i * n + k] * whitened[k]).sum();
        whitened[i] = (whitened[i] - sum) / factor[i * n + i];
    }
    let floors = (n - 1) as f64;
    let normalised = whitened[1..].iter().map(|error| error * error).sum::<f64>();
    (square / floors, normalised / floors)
}

impl Stops {
    fn add(&mut self, stop: &Stop, at: usize) {
        let is_alarm = stop.judgement.is_some_and(|of| of.fault.is_some());
        let again = stop.earlier.is_some_and(|of| of.fault.is_some());
        self.all += 1;
        self.at_once += u64::from(is_alarm);
        self.again += u64::from(again);
        self.any += u64::from(again || self.was_alarm);
        self.wrong += u64::from(stop.floor.is_some_and(|floor| floor != at));
        self.was_alarm = is_alarm;
    }

    fn counts(&self) -> [u64; 5] {
        [self.all, self.at_once, self.again, self.any, self.wrong]
    }
}
