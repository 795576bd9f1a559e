//! The air while the car stands, as a barometer reads it, and what is wrong with one that freezes, falls silent or jumps.

use super::record::Tracked;
use super::rested::Rested;
use super::unseen::Unseen;
use crate::recording::Pressure;
use crate::stats::quantile::median;
use libm::{exp, log};
use std::ops::Range;

/// The rest that is looked at on either side of a trip, and what is left out behind a trip, where a barometer lags, s.
const REST: f64 = 10.0;
const LAG: f64 = 1.0;

/// Before something unseen a barometer is read if it has had so long to settle, s.
const SETTLED: f64 = 4.0;

/// Half a metre, as a logarithm of the pressure.
const JUMP: f64 = 5.8e-5;

/// A jump is so many deviations of the readings on either side of it, and so much of it is from one reading to the next.
const CLEAR: f64 = 8.0;
const ABRUPT: f64 = 0.7;

/// A barometer falls silent where it has no reading for so many seconds, and for so many of its usual intervals.
const SILENT: f64 = 5.0;

/// The air at rest.
#[derive(Clone, Debug)]
pub struct Rest {
    /// The logarithms of the pressures.
    pub read: Rested,
    /// Where it jumps, how far up, as a logarithm.
    pub jump: Option<f64>,
}

impl Rest {
    /// The rest before a trip and that after it, by a barometer with these steps.
    pub fn around(
        trips: &[Tracked],
        at: usize,
        unseen: &Unseen,
        readings: &[Pressure],
        step: f64,
    ) -> [Self; 2] {
        let rests = rests(trips, at, unseen);
        let [before, after] = rests.map(|it| within(readings, it.unwrap_or(NONE)));
        let [early, late] = [before, after].map(|it| jump(it, step));
        // What is beside the trip counts.
        let before = &before[early.map_or(0, |it| it.0)..];
        let after = &after[..late.map_or(after.len(), |it| it.0)];
        let of = |readings: &[Pressure], jump: Option<(usize, f64)>| {
            let logs = readings.iter().map(|it| (it.time, log(it.pascal)));
            Self {
                read: Rested::of(&logs.collect::<Vec<_>>()),
                jump: jump.map(|it| it.1),
            }
        };
        [of(before, early), of(after, late)]
    }

    /// The least jump, as a logarithm.
    pub fn jump(step: f64) -> f64 {
        JUMP.max(1.5 * step)
    }

    pub fn standard_altitude(&self) -> f64 {
        let (time, pascal) = (self.read.time, exp(self.read.mean));
        Pressure { time, pascal }.standard_altitude()
    }
}

/// No time at all.
const NONE: Range<f64> = f64::INFINITY..f64::NEG_INFINITY;

/// The rest before a trip and that after it, as far as they are looked at, and nothing is unseen in them; none where that end is
/// not recorded, nor that of the trip on its other side.
fn rests(trips: &[Tracked], at: usize, unseen: &Unseen) -> [Option<Range<f64>>; 2] {
    let around = |of: &Tracked| {
        let (start, stop) = (of.trip.start, of.trip.stop);
        let from = start.unwrap_or(f64::NEG_INFINITY);
        let all = unseen.around(from, stop.unwrap_or(f64::INFINITY));
        (start.map(|_| all.start), stop.map(|_| all.end))
    };
    let (start, stop) = around(&trips[at]);
    let begin = trips[..at]
        .last()
        .map_or(Some(f64::NEG_INFINITY), |it| around(it).1);
    let end = trips
        .get(at + 1)
        .map_or(Some(f64::INFINITY), |it| around(it).0);
    let before = begin.zip(start).map(|(begin, start)| {
        let hidden = unseen.within(begin, start);
        let begin = hidden.fold(begin, |begin, it| begin.max(it.end));
        (begin + LAG).max(start - REST)..start
    });
    let after = stop.zip(end).map(|(stop, end)| {
        let hidden = unseen.within(stop, end);
        let seen = hidden.fold(end, |end, it| end.min(it.start));
        // What is cut off soon may not have settled.
        let last = if seen < end && seen < stop + LAG + SETTLED {
            stop
        } else {
            seen
        };
        stop + LAG..last.min(stop + LAG + REST)
    });
    [before, after]
}

/// The smallest change from one reading to the next, as a logarithm.
pub fn step(readings: &[Pressure]) -> f64 {
    let changes = readings
        .windows(2)
        .map(|pair| log(pair[1].pascal / pair[0].pascal).abs());
    let step = changes
        .filter(|change| *change > 0.0)
        .fold(f64::INFINITY, f64::min);
    if step.is_finite() { step } else { 0.0 }
}

fn within(readings: &[Pressure], times: Range<f64>) -> &[Pressure] {
    let first = readings.partition_point(|it| it.time < times.start);
    let end = readings.partition_point(|it| it.time <= times.end);
    &readings[first..end.max(first)]
}

/// The first reading after a jump, and how far up it is, as a logarithm.
fn jump(readings: &[Pressure], step: f64) -> Option<(usize, f64)> {
    let logs: Vec<f64> = readings.iter().map(|it| -log(it.pascal)).collect();
    let change = |at: usize| (logs[at] - logs[at - 1]).abs();
    let last = logs.len().saturating_sub(1);
    let at = (2..last).max_by(|a, b| change(*a).total_cmp(&change(*b)))?;
    let sides = [&logs[..at], &logs[at..]];
    let [before, after] = sides.map(|it| median(it.to_vec()));
    let off = sides[0].iter().map(|it| (it - before).abs());
    let off = off.chain(sides[1].iter().map(|it| (it - after).abs()));
    let by = after - before;
    let least = Rest::jump(step).max(CLEAR * 1.4826 * median(off.collect()));
    (by.abs() > least && change(at) > ABRUPT * by.abs()).then_some((at, by))
}

/// Whether the readings of a trip are one and the same, within a step, though it goes farther than two.
pub fn is_frozen(trip: &Tracked, readings: &[Pressure], step: f64) -> bool {
    let Some((start, stop)) = trip.trip.start.zip(trip.trip.stop) else {
        return false;
    };
    let readings = within(readings, start..stop);
    let logs = readings.iter().map(|it| log(it.pascal));
    let (least, most) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), it| {
        (least.min(it), most.max(it))
    });
    // A trip of which nothing is known goes half a metre.
    let far = trip.distance.map_or(JUMP, |it| JUMP * it.abs() / 0.5);
    readings.len() > 1 && most - least <= 1.01 * step && far > 2.0 * step
}

/// From reading to reading, s.
fn intervals(readings: &[Pressure]) -> impl Iterator<Item = (f64, f64)> {
    readings.windows(2).map(|pair| (pair[0].time, pair[1].time))
}

/// The usual interval, s.
pub fn usual_interval(readings: &[Pressure]) -> f64 {
    median(intervals(readings).map(|(from, to)| to - from).collect())
}

/// For how long a barometer with this usual interval is silent in a trip, s, if it is.
pub fn silence(trip: &Tracked, readings: &[Pressure], usual: f64) -> Option<f64> {
    let (start, stop) = trip.trip.start.zip(trip.trip.stop)?;
    let of_trip = intervals(readings).filter(|(from, to)| *to > start && *from < stop);
    let longest = of_trip.map(|(from, to)| to - from).fold(0.0, f64::max);
    (longest > SILENT * usual.max(1.0)).then_some(longest)
}
