//! Pulses of acceleration: stretches in which the record leaves its level and changes the speed.

use super::blocks::{Cut, median};
use super::level::Level;
use std::ops::Range;

/// The record is smoothed over this time before it is cut into pulses, s.
const SMOOTHING: f64 = 0.3;

/// How far a pulse reaches beyond the point where it falls into the noise, s.
const FOOT: f64 = 0.3;

/// A pulse shorter than this that touches a shock is part of it, s.
const SHORT: f64 = 1.0;

/// A swing has so many pulses at least, with pauses no longer than this and each no longer than this, s; what is
/// shorter carries the sensor no farther than this, m.
const LEAST_IN_SWING: usize = 5;
const PAUSE: f64 = 0.4;
pub const LONGEST_SWING: f64 = 1.3;
pub const FARTHEST_SWING: f64 = 0.5;

/// The smallest change of speed, m/s, and in deviations of what noise adds up to.
const LEAST_CHANGE: f64 = 0.015;
const LEAST_DEVIATIONS: f64 = 5.0;

/// What colour adds to the walk of white noise, at most as a factor.
const MOST_COLOUR: f64 = 5.0;

/// Uncertainty of the level, m/s², and what a step of the sensor adds to it, as a share.
const LEVEL_ERROR: f64 = 0.004;
const STEP_ERROR: f64 = 0.3;

/// A pulse of acceleration.
#[derive(Clone, Debug, PartialEq)]
pub struct Pulse {
    /// Its blocks.
    pub blocks: Range<usize>,
    /// s
    pub from: f64,
    /// s
    pub to: f64,
    /// Change of speed, m/s, up positive.
    pub change: f64,
    /// Its standard deviation, m/s.
    pub deviation: f64,
    /// The largest distance of a block from the level, m/s².
    pub peak: f64,
    /// Whether it is a long swing to and fro.
    pub is_swing: bool,
}

/// The noise of a record around its level.
#[derive(Clone, Copy, Debug, Default)]
pub struct Noise {
    /// Of the smoothed record, m/s².
    pub smoothed: f64,
    /// What a second adds to the speed, m/s.
    pub walk: f64,
}

/// A record with its level: what pulses are cut from.
#[derive(Clone, Debug)]
pub struct Levelled {
    /// The record.
    pub cut: Cut,
    /// Its level.
    pub level: Level,
}

impl Levelled {
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

    /// The noise where the record is at its level.
    pub fn noise(&self, smoothed: &[f64]) -> Noise {
        let near = |values: Vec<f64>| {
            let near = values
                .into_iter()
                .map(f64::abs)
                .filter(|value| *value < self.level.width);
            1.4826 * median(near.collect())
        };
        let second = self.cut.blocks_in(1.0);
        let seconds = (0..self.cut.blocks.len() / second)
            .map(|index| self.change(index * second..(index + 1) * second))
            .collect();
        Noise {
            smoothed: near(smoothed.to_vec()),
            walk: near(seconds).min(MOST_COLOUR * self.cut.scatter() * self.cut.seconds.sqrt()),
        }
    }

    /// All pulses, in order; `violent` is the acceleration beyond which one is a shock, m/s².
    pub fn pulses(&self, violent: f64) -> Vec<Pulse> {
        let smoothed = self.smoothed();
        let noise = self.noise(&smoothed);
        let least = (2.0 * noise.smoothed).clamp(0.02, 0.15);
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
                    let pulse = self.pulse(
                        self.with_feet(core, &smoothed, taken..to, least),
                        noise.walk,
                    );
                    taken = pulse.blocks.end;
                    let least = LEAST_CHANGE.max(LEAST_DEVIATIONS * pulse.deviation);
                    if pulse.change.abs() > least || pulse.peak > violent {
                        pulses.push(pulse);
                    }
                }
                block += length.max(1);
            }
            from = to;
        }
        self.swings(self.joined(pulses, violent, noise.walk), noise.walk)
    }

    /// A long swing to and fro is one pulse: a rope that bounces, somebody who walks. Its pulses are short, follow each
    /// other closely and turn each time.
    fn swings(&self, pulses: Vec<Pulse>, walk: f64) -> Vec<Pulse> {
        let mut swings: Vec<Pulse> = Vec::new();
        let mut rest = &pulses[..];
        while let Some(first) = rest.first() {
            let count = self.swing(rest);
            if count >= LEAST_IN_SWING {
                let blocks = first.blocks.start..rest[count - 1].blocks.end;
                swings.push(Pulse {
                    is_swing: true,
                    ..self.pulse(blocks, walk)
                });
                rest = &rest[count..];
            } else {
                swings.push(first.clone());
                rest = &rest[1..];
            }
        }
        swings
    }

    /// How many pulses from the first on are one swing.
    fn swing(&self, pulses: &[Pulse]) -> usize {
        let mut count = 0;
        for (index, pulse) in pulses.iter().enumerate() {
            let before = index.checked_sub(1).map(|before| &pulses[before]);
            let pause = before.map_or(0.0, |before| pulse.from - before.to);
            let length = pulse.to - pulse.from;
            let turns = before.is_none_or(|before| before.change * pulse.change < 0.0);
            if pause > PAUSE || length > LONGEST_SWING || !turns {
                break;
            }
            count = index + 1;
        }
        count
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

    fn pulse(&self, blocks: Range<usize>, walk: f64) -> Pulse {
        let (from, to) = (
            self.cut.blocks[blocks.start].from,
            self.cut.blocks[blocks.end - 1].to,
        );
        let seconds = to - from;
        let level_error = LEVEL_ERROR.max(STEP_ERROR * self.cut.step);
        let peak = blocks
            .clone()
            .map(|block| self.off(block).abs())
            .fold(0.0, f64::max);
        Pulse {
            change: self.change(blocks.clone()),
            deviation: (walk * walk * seconds + (level_error * seconds).powi(2)).sqrt(),
            blocks,
            from,
            to,
            peak,
            is_swing: false,
        }
    }

    /// A shock and the short pulses that touch it are one: what counts is the speed they leave.
    fn joined(&self, pulses: Vec<Pulse>, violent: f64, walk: f64) -> Vec<Pulse> {
        let belong = |one: &Pulse, other: &Pulse| {
            let part = |shock: &Pulse, pulse: &Pulse| {
                shock.peak > violent && pulse.to - pulse.from < SHORT
            };
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
                let both = self.pulse(one.blocks.start..other.blocks.end, walk);
                joined.truncate(joined.len() - 2);
                joined.push(both);
            }
        }
        joined
    }
}
