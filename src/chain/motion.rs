//! The components that a motion adds to the rest of a trial.

use super::batch::observe;
use super::family::Course;
use super::source::Source;
use crate::detect::{Along, Crossings, Lines, Pooled, Samples};
use crate::signal::Digitiser;
use crate::simd::Vectors;
use crate::whiten::whiten;
use std::ops::Range;

/// The components that a motion adds.
pub(super) struct Motion {
    /// λ/θ for each raw observation.
    pub pattern: Vec<f64>,
    /// Block means of the pattern; unused where a block is one observation.
    means: Vec<f64>,
    /// Whitened step and impulses; noise and impulses; all three.
    step: Vec<f64>,
    impulse: Vec<f64>,
    without_step: Vec<f64>,
    pub whitened: Vec<f64>,
}

impl Motion {
    /// Buffers for `raw` samples after X and `observed` block means of them.
    pub fn new(raw: usize, observed: usize) -> Self {
        Self {
            pattern: vec![0.0; raw],
            means: vec![0.0; observed],
            step: vec![0.0; observed],
            impulse: vec![0.0; observed],
            without_step: vec![0.0; observed],
            whitened: vec![0.0; observed],
        }
    }

    /// Sets the pattern of this course from the trial's draws.
    pub fn draw_impulses(&mut self, course: &Course, draws: &[[u8; 8]], source: &Source) {
        let first = course.first_impulse(&source.samples);
        let (silent, acting) = self.pattern.split_at_mut(first);
        silent.fill(0.0);
        if course.impulses.are_absent() {
            acting.fill(0.0);
            return;
        }
        Vectors::widest().run(
            #[inline(always)]
            || course.impulses.pattern(&draws[first..], acting),
        );
    }

    /// Whitened responses to a unit step and to the impulses, and the whitened record without step. The
    /// response to a step is still there if the course before it had the same.
    pub fn respond(
        &mut self,
        course: &Course,
        coefficients: &[f64],
        source: &Source,
        rest: &[f64],
    ) {
        Vectors::widest().run(
            #[inline(always)]
            || {
                if !course.repeats_shape {
                    whiten(coefficients, &course.observed_shape, 0, &mut self.step);
                }
                if source.samples.decimation() > 1 {
                    self.average(source.samples.decimation());
                }
                let observed = observed(source, &self.pattern, &self.means);
                whiten(coefficients, observed, 0, &mut self.impulse);
                let theta = course.impulses.theta.get();
                let noise = &rest[source.samples.reference()..];
                let sums = self.without_step.iter_mut().zip(noise);
                for ((sum, xi), impulse) in sums.zip(&self.impulse) {
                    *sum = xi + theta * impulse;
                }
            },
        );
    }

    /// Takes block means of the pattern.
    #[inline(always)]
    fn average(&mut self, decimation: usize) {
        let transparent = Digitiser::default();
        observe(&transparent, decimation, &self.pattern, &mut self.means);
    }

    /// The observed pattern, after a response.
    pub fn observed(&self, source: &Source) -> &[f64] {
        observed(source, &self.pattern, &self.means)
    }

    /// Adds Δ times the step response.
    pub fn add_step(&mut self, delta: f64) {
        for ((y, rest), step) in self
            .whitened
            .iter_mut()
            .zip(&self.without_step)
            .zip(&self.step)
        {
            *y = rest + delta * step;
        }
    }

    /// The statistics at every Δ of the course; `None` if a near tie makes one of them uncertain.
    pub fn count<'c>(
        &self,
        crossings: &'c mut Crossings,
        samples: &Samples,
        rest: &[f64],
    ) -> Option<&'c Along> {
        let base = pool(samples, rest, &self.without_step);
        let slope = pool(samples, rest, &self.step);
        let lines = |base, slope| Lines { base, slope };
        crossings.count(
            base.reference,
            lines(base.shift, slope.shift),
            lines(base.scale, slope.scale),
        )
    }
}

/// The pattern as it is observed: itself, or its block means.
#[inline(always)]
fn observed<'a>(source: &Source, pattern: &'a [f64], means: &'a [f64]) -> &'a [f64] {
    if source.samples.decimation() == 1 {
        pattern
    } else {
        means
    }
}

/// X from the whitened rest, Y₁ and Y₂ from the whitened motion.
pub(super) fn pool<'a>(samples: &Samples, rest: &'a [f64], motion: &'a [f64]) -> Pooled<'a> {
    let after = |range: Range<usize>| {
        &motion[range.start - samples.reference()..range.end - samples.reference()]
    };
    Pooled {
        reference: &rest[samples.reference_range()],
        shift: after(samples.shift_range()),
        scale: after(samples.scale_range()),
    }
}
