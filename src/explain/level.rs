//! The level of a record: what the sensor reads without acceleration, at every block.
//!
//! Rest and uniform motion read the same, so the level is what most of a record agrees with. It drifts slowly and
//! may step where the sensor is moved. It is the cheapest path ([`super::steps`]) through the means of windows of half
//! a second, in groups of three seconds: one step of the grid in that time is twice the drift of 0.1 m/s² a minute;
//! a jump of a few steps costs what it takes to be there in 15 to 20 s.
//!
//! A shift that does not last that long is found by a second path, through what the first leaves ([`Shift`]).

use super::blocks::Cut;
use super::steps::{Costs, Segment, cut, path};
use crate::stats::quantile::median;
use rayon::prelude::*;
use std::ops::Range;

/// Length of a window, s.
const WINDOW: f64 = 0.5;

/// Windows between two steps of the path.
const GROUP: usize = 6;

/// What a path of the level for good costs.
const LASTING: Costs = Costs {
    step: 4.0,
    jump: 6.0,
    most: 40.0,
};

/// What one for a while costs, on top of it.
const PASSING: Costs = Costs {
    step: 3.0,
    jump: 0.0,
    most: 3.0,
};

/// A shift is larger than the first and smaller than the second, m/s².
const SHIFTS: (f64, f64) = (0.015, 0.16);

/// A shift comes and goes within this time, s, and within this share of it is the level on either side.
const ABRUPT: f64 = 0.2;
const SAME: f64 = 0.35;

/// So few windows are not worth another thread.
const FEW: usize = 1024;

/// Windows on either side whose median refines the path.
const REACH: usize = 30;

/// The level of a record.
#[derive(Clone, Debug, Default)]
pub struct Level {
    /// m/s², one value for each block.
    pub at: Vec<f64>,
    /// w: windows nearer than this to the path agree with it, m/s².
    pub width: f64,
    /// The cost of the path, in windows off the level.
    pub cost: f64,
    /// Where it seems to be another for a while; they are part of `at`.
    pub shifts: Vec<Shift>,
}

/// A shift of the level for a while, or a long and weak acceleration that is as flat and as abrupt.
#[derive(Clone, Debug, PartialEq)]
pub struct Shift {
    /// Its blocks.
    pub blocks: Range<usize>,
    /// m/s².
    pub size: f64,
}

impl Level {
    /// The level of a record. A `pull` of 1 makes a window cost 1 more for every 0.1 m/s² that the level is from the
    /// mean of the record, which it equals where the record begins and ends at one speed.
    pub fn of(record: &Cut, pull: f64) -> Self {
        let means = record.window_means(WINDOW);
        let per_window = record.blocks_in(WINDOW) as f64;
        let differences = means.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        let white = 20.0 * record.scatter() / per_window.sqrt();
        let width = (4.0 * median(differences.collect()))
            .min(white)
            .clamp(0.03, 0.3);
        let least = means.iter().copied().fold(f64::INFINITY, f64::min);
        let greatest = means.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (mut lasting, cost) = path(&means, (least, greatest), (GROUP, width), pull, LASTING);
        let blocks: Vec<f64> = record.blocks.iter().map(|block| block.mean).collect();
        let mut level = Self {
            at: Vec::with_capacity(blocks.len()),
            width,
            cost,
            shifts: Vec::new(),
        };
        for segment in cut(&mut lasting, GROUP, &blocks, record.blocks_in(WINDOW)) {
            level.follow(&segment, &means, &lasting, per_window);
        }
        level.shift(record, &blocks);
        level
    }

    /// The level of a segment: the median of the windows around that agree with the path.
    fn follow(&mut self, segment: &Segment, means: &[f64], path: &[f64], per_window: f64) {
        let windows = segment.windows.clone();
        let fine: Vec<f64> = windows
            .clone()
            .into_par_iter()
            .with_min_len(FEW)
            .map(|window| refined(means, path, self.width, window, &windows))
            .collect();
        let first = windows.start as f64;
        let at = segment.blocks.clone().map(|block| {
            let place = (block as f64 + 0.5) / per_window - 0.5 - first;
            between(&fine, place)
        });
        self.at.extend(at);
    }

    /// Finds the shifts, and makes them part of the level.
    fn shift(&mut self, record: &Cut, blocks: &[f64]) {
        let per_window = record.blocks_in(WINDOW);
        let off: Vec<f64> = blocks.iter().zip(&self.at).map(|(a, b)| a - b).collect();
        let means: Vec<f64> = off
            .chunks(per_window)
            .map(|window| window.iter().sum::<f64>() / window.len() as f64)
            .collect();
        let (mut passing, _) = path(&means, (-SHIFTS.1, SHIFTS.1), (1, self.width), 0.0, PASSING);
        for segment in cut(&mut passing, GROUP, &off, per_window) {
            let near = segment
                .windows
                .filter(|window| (means[*window] - passing[*window]).abs() < self.width);
            let shift = Shift {
                size: median(near.map(|window| means[window]).collect()),
                blocks: segment.blocks,
            };
            if shift.size.abs() > SHIFTS.0 && shift.is_abrupt(record, &off) {
                self.shifts.extend(shift.without_holes(record));
            }
        }
        for shift in &self.shifts {
            let at = &mut self.at[shift.blocks.clone()];
            at.iter_mut().for_each(|level| *level += shift.size);
        }
    }
}

impl Shift {
    /// Its parts between holes.
    fn without_holes(self, record: &Cut) -> Vec<Self> {
        let Range { start, end } = self.blocks;
        let within = record
            .ends
            .iter()
            .copied()
            .filter(|hole| (start + 1..end).contains(hole));
        let edges: Vec<usize> = [start].into_iter().chain(within).chain([end]).collect();
        let part = |ends: &[usize]| Self {
            blocks: ends[0]..ends[1],
            size: self.size,
        };
        edges.windows(2).map(part).collect()
    }

    /// Whether it comes or goes at once.
    fn is_abrupt(&self, record: &Cut, off: &[f64]) -> bool {
        let (gap, reach) = (record.blocks_in(ABRUPT) / 2, record.blocks_in(WINDOW));
        let mean = |blocks: Range<usize>| {
            let length = blocks.len() as f64;
            off[blocks].iter().sum::<f64>() / length
        };
        let is_edge = |block: usize, is_start: bool| {
            let before = (block.saturating_sub(gap + reach), block.saturating_sub(gap));
            let after = (
                (block + gap).min(off.len()),
                (block + gap + reach).min(off.len()),
            );
            if before.0 == before.1 || after.0 == after.1 {
                return false;
            }
            let (before, after) = (mean(before.0..before.1), mean(after.0..after.1));
            let (outside, inside) = if is_start {
                (before, after)
            } else {
                (after, before)
            };
            let near = SAME * self.size.abs();
            (inside - self.size).abs() < near && outside.abs() < near
        };
        is_edge(self.blocks.start, true) || is_edge(self.blocks.end, false)
    }
}

/// The median of the windows around that agree with the path.
fn refined(means: &[f64], path: &[f64], width: f64, window: usize, within: &Range<usize>) -> f64 {
    let here = path[window];
    let from = window.saturating_sub(REACH).max(within.start);
    let around = from..(window + REACH + 1).min(within.end);
    let near = around.filter(|other| {
        let there = path[*other];
        (means[*other] - there).abs() < width && (there - here).abs() < width
    });
    let near: Vec<f64> = near.map(|other| means[other]).collect();
    if near.is_empty() { here } else { median(near) }
}

/// The value at a place between windows, held constant beyond the ends.
fn between(values: &[f64], place: f64) -> f64 {
    let place = place.clamp(0.0, values.len() as f64 - 1.0);
    let before = place as usize;
    let after = (before + 1).min(values.len() - 1);
    let share = place - before as f64;
    values[before] * (1.0 - share) + values[after] * share
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::Sample;

    /// The largest error of the level of a record with these accelerations and levels, with a little noise.
    fn worst(acceleration: impl Fn(f64) -> f64, level: impl Fn(f64) -> f64) -> f64 {
        let noise = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 16) / 65536.0 - 0.5;
        let samples: Vec<Sample> = (0..6000)
            .map(|i| {
                let time = f64::from(i) / 50.0;
                let acceleration = acceleration(time) + level(time) + 0.05 * noise(i);
                Sample { time, acceleration }
            })
            .collect();
        let cut = Cut::new(&samples, 2, 0.04);
        let found = Level::of(&cut, 0.0);
        let errors = cut
            .blocks
            .iter()
            .zip(&found.at)
            .map(|(block, found)| (found - level(block.to)).abs());
        errors.fold(0.0, f64::max)
    }

    fn pulse(time: f64, from: f64, to: f64, size: f64) -> f64 {
        if (from..to).contains(&time) {
            size
        } else {
            0.0
        }
    }

    /// A braking of 8 s does not become the level, nor does a drift escape it.
    #[test]
    fn the_level_stays_below_pulses_and_follows_drift() {
        let ride = |time| pulse(time, 20.0, 22.0, 1.0) + pulse(time, 60.0, 68.0, -0.25);
        assert!(worst(ride, |_| 9.81) < 0.01);
        assert!(worst(ride, |time| 9.81 + time / 600.0) < 0.03);
        assert!(worst(ride, |time| -0.1 * time / 60.0) < 0.03);
    }

    /// A step of the level for good is followed within three seconds.
    #[test]
    fn the_level_follows_a_step() {
        let near = |time: f64| (57.0..63.5).contains(&time);
        let step = |time: f64| if time < 60.25 { 0.0 } else { 0.4 };
        // Near the step the sensor reads nothing but the level found, so that only the rest is compared.
        let found = worst(|_| 0.0, |time| if near(time) { 0.2 } else { step(time) });
        assert!(found < 0.21, "{found}");
    }
}
