//! Uniform motion as it happens: the local mean of the acceleration is near the bias.
//!
//! The mean over a window around a sample must be near, and that around every sample `beside` it too: at the foot of an
//! acceleration the mean is still near. So a sample is judged half a window and `beside` later. The energy of a window
//! would not do: the plateau of an acceleration is as quiet as uniform motion, and taken for it, it would be learnt as
//! the bias.

use super::settings::UniformSettings;
use super::steps::Step;
use std::collections::VecDeque;

/// Judges steps, in their order, some later than they come.
#[derive(Clone, Debug)]
pub struct UniformDetector {
    settings: UniformSettings,
    /// Those that are not judged, or that a mean still needs.
    steps: VecDeque<Step>,
    /// The sum of the window, and its ends in `steps`.
    sum: f64,
    window: (usize, usize),
    /// How many of `steps` have a mean, and how many are judged.
    averaged: usize,
    judged: usize,
    /// The latest time at which the mean was off, s.
    off: f64,
}

impl UniformDetector {
    /// A detector that has seen nothing.
    pub fn new(settings: UniformSettings) -> Self {
        Self {
            settings,
            steps: VecDeque::new(),
            sum: 0.0,
            window: (0, 0),
            averaged: 0,
            judged: 0,
            off: f64::NEG_INFINITY,
        }
    }

    /// How long it takes to judge a step, s.
    pub fn delay(settings: &UniformSettings) -> f64 {
        settings.beside + settings.window * if settings.looks_ahead { 0.5 } else { 0.0 }
    }

    /// Takes a step. The mean of a window may be so far off the bias.
    #[inline]
    pub fn push(&mut self, step: Step, bias: f64, limit: f64) {
        self.forget();
        self.steps.push_back(step);
        let ahead = if self.settings.looks_ahead {
            self.settings.window / 2.0
        } else {
            0.0
        };
        while self.averaged < self.steps.len() {
            let time = self.steps[self.averaged].time;
            if time + ahead > step.time {
                break;
            }
            if (self.mean(time + ahead) - bias).abs() >= limit {
                self.off = time;
            }
            self.averaged += 1;
        }
    }

    /// The next step that is judged, and whether it belongs to uniform motion.
    #[inline]
    pub fn judged(&mut self) -> Option<(Step, bool)> {
        let step = *self.steps.get(self.judged)?;
        let newest = self.averaged.checked_sub(1)?;
        if self.judged > newest || self.steps[newest].time < step.time + self.settings.beside {
            return None;
        }
        self.judged += 1;
        Some((step, self.off < step.time - self.settings.beside))
    }

    /// The steps that are left at the end of a record: whether they are uniform is not known.
    pub fn left(self) -> impl Iterator<Item = Step> {
        self.steps.into_iter().skip(self.judged)
    }

    /// The mean of the window that ends at a time.
    fn mean(&mut self, to: f64) -> f64 {
        let (mut first, mut end) = self.window;
        while self.steps.get(end).is_some_and(|step| step.time <= to) {
            self.sum += self.steps[end].acceleration;
            end += 1;
        }
        while self.steps[first].time < to - self.settings.window {
            self.sum -= self.steps[first].acceleration;
            first += 1;
        }
        self.window = (first, end);
        self.sum / (end - first) as f64
    }

    fn forget(&mut self) {
        let unused = self.window.0.min(self.judged);
        self.steps.drain(..unused);
        self.window = (self.window.0 - unused, self.window.1 - unused);
        self.averaged -= unused;
        self.judged -= unused;
    }
}
