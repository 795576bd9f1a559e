//! One trial: records at rest, or one record with every start.

use super::pilot::Pilot;
use super::start::{LEARNING, REST, SECOND};
use super::table::Point;
use crate::counts::{Shape, Sums, Values};
use crate::detect::running::Running;
use crate::rng::{Generator, Stream, unit};
use libm::ceil;

/// What is looked at of a start, samples.
const LOOKED_AT: usize = 6 * SECOND;

/// An alarm so soon after a start counts, samples.
const WITHIN: usize = 3 * SECOND;

/// A start is up to so many samples later, so that it is anywhere in a block.
const LATER: usize = SECOND;

/// Delays are counted in steps of so many samples.
const STEP: f64 = 10.0;

/// The sums of records at rest: alarms, and samples up to them.
pub fn at_rest(
    pilot: &Pilot,
    points: &[&Point],
    records: usize,
    seed: u64,
    trial: u64,
) -> Vec<Sums> {
    let noise = &points[0].noise;
    let mut sums = vec![empty(); points.len()];
    for record in 0..records {
        let trial = trial * records as u64 + record as u64;
        let mut draws = noise.draws("detectors at rest", seed, trial);
        let read = noise.record(LEARNING + REST, &mut draws);
        let read: Vec<f64> = read.into_iter().map(|x| noise.read(x)).collect();
        for (sums, point) in sums.iter_mut().zip(points) {
            let mut running = pilot.start(point, "detectors at rest ties", seed, trial);
            running.learn(&read[..LEARNING]);
            let threshold = pilot.threshold(point);
            let alarm = running.find(&read[LEARNING..], |score| score >= threshold);
            sums.counts[0] += u64::from(alarm.is_some());
            sums.counts[1] += alarm.map_or(REST, |time| time + 1) as u64;
        }
    }
    sums
}

/// The sums of one start at each point: whether it is seen within 3 s, and the delay. What comes before it is one for all.
pub fn of_starts(pilot: &Pilot, points: &[&Point], seed: u64, trial: u64) -> Vec<Sums> {
    let noise = &points[0].noise;
    let mut draws = noise.draws("detectors", seed, trial);
    let begins = LEARNING + later(seed, trial);
    let record = noise.record(begins + LOOKED_AT, &mut draws);
    let (before, after) = record.split_at(begins);
    let before: Vec<f64> = before.iter().map(|x| noise.read(*x)).collect();
    let mut learnt: Vec<(&Point, Running)> = Vec::new();
    let mut moved: Option<(&Point, Vec<f64>)> = None;
    let each = points.iter().map(|point| {
        let is_same = |(other, _): &&(&Point, Running)| {
            other.detector == point.detector
                && (!point.detector.knows_start() || other.start == point.start)
        };
        let known = learnt.iter().find(is_same).map(|(_, it)| it.clone());
        let mut running = known.unwrap_or_else(|| {
            let mut running = pilot.start(point, "detectors ties", seed, trial);
            running.learn(&before);
            learnt.push((point, running.clone()));
            running
        });
        let is_moved = |(other, _): &(&Point, Vec<f64>)| {
            (&other.start, other.delta) == (&point.start, point.delta)
        };
        if !moved.as_ref().is_some_and(is_moved) {
            moved = Some((point, after_start(point, after)));
        }
        let read = &moved.as_ref().expect("it was just read").1;
        let threshold = pilot.threshold(point);
        seen(running.find(read, |score| score >= threshold))
    });
    each.collect()
}

/// How much later than that the start is.
fn later(seed: u64, trial: u64) -> usize {
    let mut draws: Generator = Stream::new(seed, "detectors start", "").at(trial);
    (unit(&mut draws) * LATER as f64) as usize
}

/// What is read from the start on.
fn after_start(point: &Point, noise: &[f64]) -> Vec<f64> {
    let start = point.start.as_ref().expect("what moves has a start");
    let each = noise.iter().zip(0..).map(|(x, time)| {
        let shift = point.delta * start.shape(f64::from(time) + 0.5);
        point.noise.read(x + shift)
    });
    each.collect()
}

fn seen(alarm: Option<usize>) -> Sums {
    let mut sums = empty();
    let is_soon = alarm.is_some_and(|time| time < WITHIN);
    sums.counts[0] = u64::from(is_soon);
    let delay = alarm.map_or(f64::INFINITY, |time| {
        ceil((time + 1) as f64 / STEP) * STEP / SECOND as f64
    });
    let mut values = Values::default();
    values.push(delay);
    sums.values[0] = values;
    sums
}

fn empty() -> Sums {
    let shape = Shape {
        most: vec![None; 2],
        values: vec![1],
        ..Shape::default()
    };
    shape.empty().sums
}
