//! Learning the reference of rest from a whole record.
//!
//! A record is cut into windows of half a second. Windows near the median level and not much noisier than
//! the median are rest or smooth motion, and together give a first reference. With it a monitor runs over the
//! record once and finds the motions. The windows between the motions are rest and give the final reference.
//! This assumes that the cage stands between the motions found, and not during them; the assumption is
//! dropped only if the windows during the motions are clearly quieter.

use super::blocks::Blocks;
use super::design::Design;
use super::event::{Event, Kind, State};
use super::pulse::is_level;
use super::reference::Reference;
use super::settings::{LEAST_TRAINING, MOST_ORDER};
use super::{Knowledge, Monitor};
use crate::recording::Sample;
use crate::signal::Phase;

/// Length of a window, s.
const WINDOW: f64 = 0.5;

/// The fewest blocks in a window: more than the longest filter looks back.
const SHORTEST_WINDOW: usize = MOST_ORDER + 2;

/// A window noisier than the median by this factor was disturbed, for example by handling the sensor.
const NOISIEST: f64 = 4.0;

/// The most windows kept; of a longer record every second is kept, or every fourth, and so on.
const MOST_WINDOWS: usize = 4096;

/// If the windows in motion are quieter than those at rest by this factor, the two are exchanged.
const QUIETER: f64 = 0.5;

/// Nothing could be learnt from a record.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "no rest to learn from: {level:.1} of {length:.1} s stay at one level between motions, and {needed:.1} s \
     are needed (record a few seconds of rest before or after the ride)"
)]
pub struct NoRest {
    /// Length of the record, s.
    pub length: f64,
    /// Time apparently at rest, s.
    pub level: f64,
    /// Time at rest needed, s.
    pub needed: f64,
}

/// A piece of a record.
#[derive(Clone, Debug, Default)]
struct Window {
    from: f64,
    to: f64,
    means: Vec<f64>,
}

/// The windows of a record that stay at one level.
#[derive(Clone, Debug)]
struct Windows {
    design: Design,
    blocks: Blocks,
    open: Window,
    /// Blocks in a window.
    length: usize,
    kept: Vec<Window>,
    /// One of every `stride` windows is kept.
    stride: usize,
    seen: usize,
}

impl Knowledge {
    /// Learns from a whole record in two passes, each begun by a call of `pass`.
    ///
    /// # Errors
    /// If reading a sample fails (outer), or the record has too little rest (inner).
    pub fn from_record<I, E>(
        design: &Design,
        mut pass: impl FnMut() -> Result<I, E>,
    ) -> Result<Result<Self, NoRest>, E>
    where
        I: Iterator<Item = Result<Sample, E>>,
    {
        let mut windows = Windows::new(design);
        for sample in pass()? {
            windows.step(sample?);
        }
        let first = match windows.reference(|_| true) {
            Ok(reference) => reference,
            Err(none) => return Ok(Err(none)),
        };
        // Assume rest at the start; `first_is_whole` checks this afterwards.
        let mut monitor = Monitor::new(design.clone(), Self::at_rest(first));
        let mut motions = Motions::default();
        for sample in pass()? {
            for event in monitor.step(sample?, None) {
                motions.step(event);
            }
        }
        // Behind a high-pass filter motions are distorted, so they cannot show how the record begins.
        let begins_at_rest = motions.first_is_whole() || monitor.is_high_passed();
        Ok(windows.knowledge(&motions, begins_at_rest))
    }

    fn at_rest(reference: Reference) -> Self {
        Self {
            reference: Some(reference),
            begins_at_rest: true,
            motion_shows: false,
        }
    }
}

impl Windows {
    fn new(design: &Design) -> Self {
        Self {
            blocks: Blocks::new(design.samples.decimation(), design.block),
            open: Window::default(),
            length: SHORTEST_WINDOW.max((WINDOW / design.block).round() as usize),
            design: design.clone(),
            kept: Vec::new(),
            stride: 1,
            seen: 0,
        }
    }

    fn step(&mut self, sample: Sample) {
        if self.blocks.is_gap(sample.time) {
            self.blocks.clear();
            self.open = Window::default();
        }
        let Some(block) = self.blocks.step(sample) else {
            return;
        };
        if self.open.means.is_empty() {
            self.open.from = block.from;
        }
        self.open.means.push(block.mean);
        if self.open.means.len() == self.length {
            let window = Window {
                to: block.to,
                ..std::mem::take(&mut self.open)
            };
            self.close(window);
        }
    }

    /// Keeps a window that stays at one level, if it is due by the stride.
    fn close(&mut self, window: Window) {
        let settings = &self.design.settings;
        let drift = settings.monitor.least_acceleration / 2.0;
        let bound = settings.monitor.least_speed / 2.0;
        self.seen += 1;
        if !self.seen.is_multiple_of(self.stride)
            || !is_level(&window.means, drift, self.design.block, bound)
        {
            return;
        }
        self.kept.push(window);
        // Thinning by two and doubling the stride keeps memory constant and the windows evenly spread.
        if self.kept.len() == MOST_WINDOWS {
            self.stride *= 2;
            let mut place = 0;
            self.kept.retain(|_| {
                place += 1;
                place % 2 == 0
            });
        }
    }

    /// The reference from the windows at the common level for which `are` holds.
    fn reference(&self, are: impl Fn(&Window) -> bool) -> Result<Reference, NoRest> {
        let chosen: Vec<&Window> = self.level().into_iter().filter(|w| are(w)).collect();
        let blocks = chosen.len() * self.length;
        let follows = |a: &&Window, b: &&Window| b.from - a.to < 2.0 * self.design.block;
        let stretches: Vec<Vec<f64>> = (chosen.chunk_by(follows))
            .map(|stretch| {
                stretch
                    .iter()
                    .flat_map(|w| w.means.iter().copied())
                    .collect()
            })
            .collect();
        // The first blocks of a stretch are not whitened, and X takes no block twice.
        let needed = self.design.samples.reference() + MOST_ORDER * stretches.len();
        let needed = needed.max(LEAST_TRAINING);
        let seconds = |blocks: usize| blocks as f64 * self.design.block;
        if blocks < needed {
            return Err(NoRest {
                length: seconds(self.seen * self.length),
                level: seconds(blocks),
                needed: seconds(needed),
            });
        }
        Ok(Reference::from_stretches(&stretches, &self.design))
    }

    /// The windows near the median level without unusual noise.
    fn level(&self) -> Vec<&Window> {
        let Some(level) = median(self.kept.iter().map(Window::level)) else {
            return Vec::new();
        };
        let drift = self.design.settings.monitor.least_acceleration / 2.0;
        let is_near = |window: &&Window| (window.level() - level).abs() <= drift;
        let near: Vec<&Window> = self.kept.iter().filter(is_near).collect();
        let noise = median(near.iter().map(|w| w.deviation())).unwrap_or(0.0);
        let is_usual = |window: &&Window| window.deviation() <= NOISIEST * noise;
        near.into_iter().filter(is_usual).collect()
    }

    /// The knowledge of rest, given the motions.
    fn knowledge(&self, motions: &Motions, begins_at_rest: bool) -> Result<Knowledge, NoRest> {
        let inside = |window: &Window| motions.hold(window.from, window.to);
        let outside = |window: &Window| !motions.touch(window.from, window.to);
        let deviation = |are: &dyn Fn(&Window) -> bool| {
            let windows = self.level().into_iter().filter(|w| are(w));
            median(windows.map(Window::deviation))
        };
        let is_inverted = match (deviation(&inside), deviation(&outside)) {
            (Some(inside), Some(outside)) => inside < QUIETER * outside,
            _ => false,
        };
        let reference = if is_inverted {
            self.reference(inside)?
        } else {
            self.reference(outside)?
        };
        Ok(Knowledge {
            begins_at_rest: begins_at_rest && !is_inverted,
            ..Knowledge::at_rest(reference)
        })
    }
}

impl Window {
    fn level(&self) -> f64 {
        self.means.iter().sum::<f64>() / self.means.len() as f64
    }

    fn deviation(&self) -> f64 {
        let level = self.level();
        let squares = self.means.iter().map(|mean| (mean - level).powi(2));
        (squares.sum::<f64>() / self.means.len() as f64).sqrt()
    }
}

fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// The motions that a monitor reported.
#[derive(Clone, Debug, Default)]
struct Motions(Vec<Motion>);

#[derive(Clone, Copy, Debug)]
struct Motion {
    /// s
    from: f64,
    /// s
    to: f64,
    /// Whether it ended at rest.
    is_whole: bool,
}

impl Motions {
    fn step(&mut self, event: &Event) {
        let Kind::Change { state, .. } = event.kind else {
            return;
        };
        match (state, self.0.last_mut()) {
            (State::Known(Phase::Accelerating), _) => self.0.push(Motion {
                from: event.time,
                to: f64::INFINITY,
                is_whole: false,
            }),
            (State::Known(Phase::Rest) | State::Unknown, Some(last)) if last.to.is_infinite() => {
                last.to = event.time;
                last.is_whole = state != State::Unknown;
            }
            _ => {}
        }
    }

    /// Whether there are no motions, or the first has an end that fits its start. If a record begins in motion,
    /// the first braking is taken for a start, and the next start does not end that motion.
    fn first_is_whole(&self) -> bool {
        self.0.first().is_none_or(|first| first.is_whole)
    }

    fn hold(&self, from: f64, to: f64) -> bool {
        self.0
            .iter()
            .any(|motion| motion.from <= from && to <= motion.to)
    }

    fn touch(&self, from: f64, to: f64) -> bool {
        self.0
            .iter()
            .any(|motion| motion.from < to && from < motion.to)
    }
}
