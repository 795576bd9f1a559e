//! One lift, followed in every way.

use super::table::Point;
use super::watched::{NOISE, Watched};
use super::way::{Published, Way};
use crate::counts::{Shape, Sums, Values};
use crate::recording::Sample;
use crate::study::trips::tracked;
use crate::track::fusion::{Fusion, Position, Reference, stays};
use crate::track::{
    Climbs, Motion, Place, Rules, Track, Uncertain, Unseen, Vertical, VerticalFilter,
};
use libm::{fabs, round};

/// The sums and the sums of squares of the mean size of the error and of its mean square.
pub(super) fn shape() -> Shape {
    let ways = Way::ALL.len();
    Shape {
        most: vec![],
        lengths: 4 * ways,
        values: vec![500; ways],
    }
}

/// The threshold of the published filter, m/s²: of those that were tried the best.
const THRESHOLD: f64 = 0.15;

/// What a hectopascal more is in the height, m.
const METRES: f64 = 8.32;

/// The air: °C, Pa, and the height of it over which the pressure falls by a factor e, m.
const CELSIUS: f64 = 20.0;
const PASCAL: f64 = 101_325.0;
const METRES_OF_AIR: f64 = 8581.0;

/// Errors are counted in steps of this, m, each so many seconds, and of those so many.
const STEP: f64 = 1e-3;
const EVERY: f64 = 0.1;
const COUNTED: usize = 500;

/// A car that is within this of a floor is at it, m, but for so much.
const NEAR: f64 = 1.0;
const LEVEL: f64 = 0.005;

/// The sums of these points, whose lifts are the same.
pub(super) fn run(points: &[&Point], seed: u64, trial: u64) -> Vec<Sums> {
    let watched = Watched::new(points[0].trips, seed, trial);
    let verticals = verticals(&watched);
    let track = tracked(&watched.samples, watched.numbers.rate);
    let each = points.iter().map(|point| {
        let rate = METRES * point.drift / 3600.0;
        let barometer = watched.barometer(rate);
        let mut sums = shape().empty().sums;
        for (place, way) in Way::ALL.into_iter().enumerate() {
            let heights = match way.published() {
                Some(published) => {
                    let each = follow(&watched, &verticals, &barometer, published);
                    each.into_iter().step_by(pitch(&watched)).collect()
                }
                None => carried(&watched, &track, rate, way),
            };
            add(&mut sums, place, &heights, &watched);
        }
        sums
    });
    each.collect()
}

/// From one sample that is looked at to the next.
fn pitch(watched: &Watched) -> usize {
    (EVERY * watched.numbers.rate) as usize
}

fn add(sums: &mut Sums, place: usize, heights: &[f64], watched: &Watched) {
    let truth = watched.truth.iter().step_by(pitch(watched));
    let both = heights.iter().zip(truth);
    let errors: Vec<f64> = both.map(|(found, truth)| fabs(found - truth)).collect();
    let number = errors.len() as f64;
    let mean = errors.iter().sum::<f64>() / number;
    let square = errors.iter().map(|it| it * it).sum::<f64>() / number;
    sums.note(2 * place, mean);
    sums.note(2 * place + 1, square);
    let mut values = Values::default();
    for count in 0..COUNTED {
        let error = errors[count * errors.len() / COUNTED];
        values.push(STEP * round(error / STEP));
    }
    sums.values[place] = values;
}

/// By the published filter of speed and acceleration.
fn verticals(watched: &Watched) -> Vec<Vertical> {
    let samples = &watched.samples;
    let rules = Rules::printed(watched.numbers.sigma(), THRESHOLD);
    let mut filter = VerticalFilter::learnt(rules, samples);
    samples.iter().map(|it| filter.step(*it)).collect()
}

/// The height at each sample by the published filter of the position.
fn follow(
    watched: &Watched,
    verticals: &[Vertical],
    barometer: &[(f64, f64)],
    way: Published,
) -> Vec<f64> {
    let floors: &[f64] = if way.knows_floors {
        &watched.floors
    } else {
        &[]
    };
    let fusion = Fusion {
        adapts: way.adapts,
        ..Fusion::of(NOISE)
    };
    let mut position = Position::new(fusion, floors);
    let mut reference = Reference::default();
    let (mut readings, mut last) = (barometer.iter().peekable(), 0.0);
    let mut speed = 0.0;
    let (seconds, since) = (1.0 / watched.numbers.rate, 1.0 / super::watched::RATE);
    let height = |now: &Vertical| {
        let is_at_rest = now.motion == Motion::Rest;
        // (18) has the speed before the step.
        let by = seconds * (speed + seconds * now.acceleration / 2.0);
        speed = now.speed;
        position.predict(by, seconds, is_at_rest);
        while let Some((time, altitude)) = readings.next_if(|it| it.0 <= now.time) {
            let learns = is_at_rest && (way.calibrates || reference.altitude().is_none());
            if learns {
                reference.rest(*time, *altitude);
            } else {
                reference.leave(position.height());
                if let Some(reference) = reference.altitude() {
                    position.measure(altitude - reference, since);
                }
            }
        }
        last = position.height();
        last
    };
    verticals.iter().map(height).collect()
}

/// The height at each sample that is looked at by the distances of trips, put right at each rest.
fn carried(watched: &Watched, track: &Track, rate: f64, way: Way) -> Vec<f64> {
    let put_right = match way {
        Way::Trips => Vec::new(),
        _ => put_right(watched, track, rate, way == Way::SlowMap),
    };
    let places: Vec<&Place> = track.course.stretches().iter().flatten().collect();
    let samples = watched.samples.iter().step_by(pitch(watched));
    let height = |it: &Sample| {
        let course = between(&places, it.time, |place| (place.time, place.position.mean));
        course + between(&put_right, it.time, |knot| *knot)
    };
    samples.map(height).collect()
}

/// By how much a car is higher than its trips say, at the beginning and the end of each rest.
fn put_right(watched: &Watched, track: &Track, rate: f64, knows_floors: bool) -> Vec<(f64, f64)> {
    let floor = |position: Uncertain| {
        let height = position.mean;
        let near = watched.floors.iter().copied();
        let near = near.min_by(|a, b| fabs(a - height).total_cmp(&fabs(b - height)));
        let floor = near.filter(|it| knows_floors && fabs(it - height) < NEAR);
        floor.map(|mean| Uncertain {
            mean,
            variance: LEVEL * LEVEL,
        })
    };
    let barometer = watched.pressures(CELSIUS, PASCAL, PASCAL / METRES_OF_AIR * NOISE, rate);
    let unseen = Unseen::default();
    let climbs = Climbs::of(&track.trips, &unseen, &barometer, 0.0, None);
    let stays = stays(&climbs.legs(&track.trips, &unseen), floor);
    let end = watched.samples.last().map_or(0.0, |it| it.time);
    let starts = track.trips.iter().filter_map(|it| it.trip.start);
    let stops = track.trips.iter().filter_map(|it| it.trip.stop);
    let distances = track.trips.iter().map(|it| it.distance.unwrap_or(0.0));
    let gone = [0.0].into_iter().chain(distances);
    let gone = gone.scan(0.0, |sum, distance| {
        *sum += distance;
        Some(*sum)
    });
    let rests = [0.0].into_iter().chain(stops).zip(starts.chain([end]));
    let knots = rests
        .zip(stays)
        .zip(gone)
        .flat_map(|(((from, to), stay), gone)| {
            [(from, stay.begin.mean - gone), (to, stay.end.mean - gone)]
        });
    knots.collect()
}

/// The value at a time on straight lines between knots, and as the nearest outside; 0 without any.
fn between<T>(knots: &[T], time: f64, of: impl Fn(&T) -> (f64, f64)) -> f64 {
    let next = knots.partition_point(|knot| of(knot).0 <= time);
    let before = next.checked_sub(1).map(|at| of(&knots[at]));
    let after = knots.get(next).map(&of);
    match (before, after) {
        (Some((from, low)), Some((to, high))) => low + (high - low) * (time - from) / (to - from),
        (Some((_, value)), None) | (None, Some((_, value))) => value,
        (None, None) => 0.0,
    }
}
