//! A record cut into pulses: stretches in which it leaves its level and changes the speed.

use super::blocks::Cut;
use super::level::Level;
use super::pulse::{AT_ONCE, Pulse, is_at_once};
use super::swing::{self, LEAST_IN_SWING};
use crate::stats::quantile::median;
use std::ops::Range;

/// The record is smoothed over this time before it is cut into pulses, s.
const SMOOTHING: f64 = 0.3;

/// How far a pulse reaches beyond the point where it falls into the noise, s.
const FOOT: f64 = 0.3;

/// A pulse shorter than this that touches a shock is part of it, s.
const SHORT: f64 = 1.0;

/// No lift starts so weakly, m/s².
const WEAK: f64 = 0.12;

/// The smallest change of speed, m/s, and in deviations of what noise adds up to.
const LEAST_CHANGE: f64 = 0.015;
const LEAST_DEVIATIONS: f64 = 5.0;

/// What colour adds to the walk of white noise, at most as a factor.
const MOST_COLOUR: f64 = 5.0;

/// Uncertainty of the level, m/s², and what a step of the sensor adds to it, as a share.
const LEVEL_ERROR: f64 = 0.004;
const STEP_ERROR: f64 = 0.3;

/// So many steps are more than one.
const MORE_THAN_ONE: f64 = 1.5;

/// A record, its level, and the pulses in which it leaves it.
#[derive(Clone, Debug)]
pub struct Record {
    /// The record.
    pub cut: Cut,
    /// Its level.
    pub level: Level,
    /// In order of time.
    pub pulses: Vec<Pulse>,
}

/// What pulses are cut by.
#[derive(Clone, Copy, Debug)]
struct Limits {
    /// A block farther than this from the level is a shock, m/s².
    violent: f64,
    /// What noise adds to the speed in a second, m/s.
    walk: f64,
    /// The deviation of a block if the noise were white, m/s².
    noise: f64,
}

impl Limits {
    /// The deviation of a change of speed in so much time, s, by noise and an error of the level, m/s².
    fn deviation(&self, seconds: f64, level_error: f64) -> f64 {
        (self.walk.powi(2) * seconds + (level_error * seconds).powi(2)).sqrt()
    }
}

impl Record {
    /// A record with its level, pulled to its mean so much (see [`Level::of`]); `violent` is the acceleration beyond
    /// which a pulse is a shock, m/s².
    pub fn of(cut: Cut, pull: f64, violent: f64) -> Self {
        let mut record = Self {
            level: Level::of(&cut, pull),
            cut,
            pulses: Vec::new(),
        };
        record.pulses = record.cut_pulses(violent);
        record
    }

    /// The stretches without holes: how many pulses there are up to the end of each, its beginning and its end, s.
    pub fn stretches(&self) -> Vec<(usize, f64, f64)> {
        let blocks = &self.cut.blocks;
        let mut from = 0;
        let stretches = self.cut.ends.iter().map(|&end| {
            let before = self
                .pulses
                .partition_point(|pulse| pulse.blocks.start < end);
            let stretch = (before, blocks[from].from, blocks[end - 1].to);
            from = end;
            stretch
        });
        let stretches: Vec<_> = stretches.collect();
        // A record without even one block is a stretch without pulses.
        if stretches.is_empty() {
            vec![(0, 0.0, 0.0)]
        } else {
            stretches
        }
    }

    /// Distance of a block from the level, m/s².
    fn off(&self, block: usize) -> f64 {
        self.cut.blocks[block].mean - self.level.at[block]
    }

    /// Change of speed over blocks, m/s.
    pub fn change(&self, blocks: Range<usize>) -> f64 {
        blocks
            .map(|block| self.off(block) * self.cut.blocks[block].seconds)
            .sum()
    }

    /// What a pulse changes the speed by in some of its blocks, m/s.
    pub fn change_by(&self, pulse: &Pulse, blocks: Range<usize>) -> f64 {
        let seconds: f64 = blocks
            .clone()
            .map(|block| self.cut.blocks[block].seconds)
            .sum();
        self.change(blocks) + pulse.shift * seconds
    }

    fn smoothed(&self) -> Vec<f64> {
        let half = (SMOOTHING / 2.0 / self.cut.seconds).round() as usize;
        let mut smoothed = Vec::with_capacity(self.cut.blocks.len());
        let mut from = 0;
        for &to in &self.cut.ends {
            smoothed.extend((from..to).map(|block| {
                let around = block.saturating_sub(half).max(from)..(block + half + 1).min(to);
                let length = around.len() as f64;
                around.map(|other| self.off(other)).sum::<f64>() / length
            }));
            from = to;
        }
        smoothed
    }

    /// The median size of what lies within the level's width, as a deviation.
    fn scatter(&self, values: impl Iterator<Item = f64>) -> f64 {
        let near = values
            .map(f64::abs)
            .filter(|value| *value < self.level.width);
        1.4826 * median(near.collect())
    }

    /// What noise adds to the speed in a second, m/s.
    fn walk(&self) -> f64 {
        let second = self.cut.blocks_in(1.0);
        let seconds = (0..self.cut.blocks.len() / second)
            .map(|index| self.change(index * second..(index + 1) * second));
        let white = self.cut.scatter() * self.cut.seconds.sqrt();
        self.scatter(seconds).min(MOST_COLOUR * white)
    }

    fn cut_pulses(&self, violent: f64) -> Vec<Pulse> {
        let smoothed = self.smoothed();
        let least = (2.0 * self.scatter(smoothed.iter().copied())).clamp(0.02, 0.15);
        let limits = Limits {
            violent,
            walk: self.walk(),
            noise: self.cut.scatter(),
        };
        let mut pulses: Vec<Pulse> = Vec::new();
        let mut from = 0;
        for &to in &self.cut.ends {
            let (mut block, mut taken) = (from, from);
            while block < to {
                let sign = smoothed[block].signum();
                let length = smoothed[block..to]
                    .iter()
                    .take_while(|s| **s * sign > least)
                    .count();
                if length > 0 {
                    let core = block..block + length;
                    let blocks = self.with_feet(core, &smoothed, taken..to, least);
                    taken = blocks.end;
                    let pulse = self.pulse(blocks, limits);
                    // A level between two steps is off by one of them at times, never by more.
                    let is_level_error = self.peak(&pulse.blocks) < MORE_THAN_ONE * self.cut.step;
                    let error = if is_level_error {
                        self.level_error()
                    } else {
                        LEVEL_ERROR
                    };
                    let deviation = limits.deviation(pulse.seconds(), error);
                    let least = LEAST_CHANGE.max(LEAST_DEVIATIONS * deviation);
                    if pulse.change.abs() > least || pulse.is_violent {
                        pulses.push(pulse);
                    }
                }
                block += length.max(1);
            }
            from = to;
        }
        let mut pulses = self.swings(self.joined(pulses, limits), limits);
        pulses.extend(self.shifts(limits));
        pulses.sort_by_key(|pulse| pulse.blocks.start);
        pulses
    }

    /// The shifts of the level, each of which may as well be a long and weak acceleration.
    fn shifts(&self, limits: Limits) -> impl Iterator<Item = Pulse> + '_ {
        let shifts = self.level.shifts.iter();
        let pulses = shifts.map(move |shift| {
            let pulse = self.pulse(shift.blocks.clone(), limits);
            Pulse {
                change: shift.size * pulse.seconds(),
                is_violent: false,
                shift: shift.size,
                is_level: false,
                ..pulse
            }
        });
        pulses.filter(|pulse| pulse.change.abs() > LEAST_CHANGE)
    }

    /// A long swing to and fro is one pulse: a rope that bounces, somebody who walks. Its pulses are short, follow each
    /// other closely and turn each time.
    fn swings(&self, pulses: Vec<Pulse>, limits: Limits) -> Vec<Pulse> {
        let mut swings: Vec<Pulse> = Vec::new();
        let mut rest = &pulses[..];
        while let Some(first) = rest.first() {
            let count = swing::in_one(rest);
            if count >= LEAST_IN_SWING {
                let blocks = first.blocks.start..rest[count - 1].blocks.end;
                swings.push(Pulse {
                    is_swing: true,
                    ..self.pulse(blocks, limits)
                });
                rest = &rest[count..];
            } else {
                swings.push(first.clone());
                rest = &rest[1..];
            }
        }
        swings
    }

    /// A pulse with the blocks on either side that still have its sign.
    fn with_feet(
        &self,
        core: Range<usize>,
        smoothed: &[f64],
        within: Range<usize>,
        least: f64,
    ) -> Range<usize> {
        let reach = (FOOT / self.cut.seconds).round() as usize;
        let sign = smoothed[core.start].signum();
        let is_part = |block: &usize| (0.0..=least).contains(&(smoothed[*block] * sign));
        let before = (within.start..core.start)
            .rev()
            .take(reach)
            .take_while(is_part)
            .count();
        let after = (core.end..within.end)
            .take(reach)
            .take_while(is_part)
            .count();
        core.start - before..core.end + after
    }

    fn pulse(&self, blocks: Range<usize>, limits: Limits) -> Pulse {
        let (from, to) = (
            self.cut.blocks[blocks.start].from,
            self.cut.blocks[blocks.end - 1].to,
        );
        let seconds = to - from;
        let peak = self.peak(&blocks);
        let change = self.change(blocks.clone());
        Pulse {
            change,
            is_level: self.is_level(&blocks, change / seconds, limits.noise),
            deviation: limits.deviation(seconds, self.level_error()),
            blocks,
            from,
            to,
            is_violent: peak > limits.violent,
            is_swing: false,
            shift: 0.0,
        }
    }

    /// How far a block is off the level at most, m/s².
    fn peak(&self, blocks: &Range<usize>) -> f64 {
        let off = blocks.clone().map(|block| self.off(block).abs());
        off.fold(0.0, f64::max)
    }

    /// Uncertainty of the level, m/s².
    fn level_error(&self) -> f64 {
        LEVEL_ERROR.max(STEP_ERROR * self.cut.step)
    }

    /// Whether blocks of this mean, m/s², that reach from an end of a stretch, or to it, may be at another level: a
    /// lift's acceleration is hardly so weak, and does not come or go within a tenth of a second.
    fn is_level(&self, blocks: &Range<usize>, mean: f64, noise: f64) -> bool {
        let ends = &self.cut.ends;
        let place = ends.partition_point(|end| *end <= blocks.start);
        let stretch = (if place > 0 { ends[place - 1] } else { 0 })..ends[place];
        let begins = blocks.start == stretch.start;
        if begins == (blocks.end == stretch.end) {
            return false;
        }
        let (width, reach) = (self.cut.blocks_in(AT_ONCE), self.cut.blocks_in(2.0 * FOOT));
        let edge = if begins { blocks.end } else { blocks.start };
        let part = |from: usize| {
            let off = (from..from + width).map(|block| self.off(block));
            off.sum::<f64>() / width as f64
        };
        let first = edge.saturating_sub(reach).max(stretch.start);
        let last = (edge + reach).min(stretch.end);
        let last = last.saturating_sub(2 * width);
        let noise = noise * (2.0 / width as f64).sqrt();
        let mut jumps = (first..last).map(|from| part(from + width) - part(from));
        mean.abs() < WEAK || jumps.any(|jump| is_at_once(jump, mean, noise))
    }

    /// A shock and the short pulses that touch it are one: what counts is the speed they leave.
    fn joined(&self, pulses: Vec<Pulse>, limits: Limits) -> Vec<Pulse> {
        let belong = |one: &Pulse, other: &Pulse| {
            let part = |shock: &Pulse, pulse: &Pulse| shock.is_violent && pulse.seconds() < SHORT;
            let between = one.blocks.end..=other.blocks.start;
            let is_hole = self.cut.ends.iter().any(|end| between.contains(end));
            other.from - one.to < SMOOTHING && !is_hole && (part(one, other) || part(other, one))
        };
        let mut joined: Vec<Pulse> = Vec::new();
        for pulse in pulses {
            joined.push(pulse);
            while let [.., one, other] = &joined[..] {
                if !belong(one, other) {
                    break;
                }
                let both = self.pulse(one.blocks.start..other.blocks.end, limits);
                joined.truncate(joined.len() - 2);
                joined.push(both);
            }
        }
        joined
    }
}
