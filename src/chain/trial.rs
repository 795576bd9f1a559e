//! One trial of a family, in buffers that are allocated once and reused for a whole block.

use super::family::{Branch, Course, Family, Source, Stage};
use crate::detect::{Pooled, Samples, Statistics};
use crate::rng::{Generator, Stream};
use crate::signal::Digitiser;
use crate::whiten::{Fitter, whiten};
use rand::Rng;

/// The buffers of a trial. Times run from the first observation of the record, or, where named
/// `motion`, from the first after X.
pub(super) struct Trial<'a> {
    family: &'a Family,
    fitters: Vec<Fitter>,
    noise: NoiseRecord,
    motion: MotionBuffers,
    ties: Ties<'a>,
}

/// The sensor's noise, as drawn and as observed.
struct NoiseRecord {
    /// Raw samples, burn-in first.
    raw: Vec<f64>,
    burn_in: usize,
    /// Digitised block means.
    observed: Vec<f64>,
    /// Whitened observations from the first of X.
    whitened: Vec<f64>,
}

/// What a motion adds.
struct MotionBuffers {
    /// One 64-bit draw for each raw observation.
    draws: Vec<u64>,
    /// λ/θ for each raw observation.
    pattern: Vec<f64>,
    /// The raw record with the motion in it.
    raw: Vec<f64>,
    /// Block means of the pattern.
    observed: Vec<f64>,
    /// Whitened step and impulses; noise and impulses; all three.
    step: Vec<f64>,
    impulse: Vec<f64>,
    without_step: Vec<f64>,
    whitened: Vec<f64>,
}

/// Random keys for a trial's ties, drawn when first asked for.
struct Ties<'a> {
    stream: &'a Stream,
    trial: u64,
    keys: Vec<u64>,
    drawn: bool,
}

impl<'a> Trial<'a> {
    pub fn new(family: &'a Family) -> Self {
        let source = &family.source;
        let after = source.motion_observations();
        let raw_after = after * source.samples.decimation();
        let fitter = |branch: &Branch| Fitter::new(branch.whitening, source.sensor.ar());
        Self {
            family,
            fitters: family.branches.iter().map(fitter).collect(),
            noise: NoiseRecord {
                raw: vec![0.0; source.burn_in() + source.raw_length()],
                burn_in: source.burn_in(),
                observed: vec![0.0; source.observations()],
                whitened: vec![0.0; source.samples.span()],
            },
            motion: MotionBuffers {
                draws: vec![0; raw_after],
                pattern: vec![0.0; raw_after],
                raw: vec![0.0; raw_after],
                observed: vec![0.0; after],
                step: vec![0.0; after],
                impulse: vec![0.0; after],
                without_step: vec![0.0; after],
                whitened: vec![0.0; after],
            },
            ties: Ties {
                stream: &family.ties,
                trial: 0,
                keys: vec![0; source.samples.span()],
                drawn: false,
            },
        }
    }

    /// Draws the noise of trial `index` and decides every point of the family on it.
    pub fn run(&mut self, index: u64, counters: &mut [u64]) {
        let source = &self.family.source;
        self.ties.start(index);
        self.noise.draw(source, &mut self.family.noise.at(index));
        let mut impulses = self.family.impulses.at(index);
        for draw in &mut self.motion.draws {
            *draw = impulses.next_u64();
        }
        for (branch, fitter) in self.family.branches.iter().zip(&mut self.fitters) {
            self.noise
                .observe(&branch.digitiser, source.samples.decimation());
            let coefficients = fitter.fit(self.noise.training(branch, source));
            whiten(
                coefficients,
                &self.noise.observed,
                source.lead,
                &mut self.noise.whitened,
            );
            let is_linear = branch.digitiser.is_transparent();
            for course in &branch.courses {
                self.motion.draw_impulses(course, source);
                if is_linear {
                    self.motion
                        .respond(course, coefficients, source, &self.noise.whitened);
                }
                for stage in &course.stages {
                    match is_linear {
                        true => self.motion.add_step(stage.delta),
                        false => self.motion.record_anew(
                            branch,
                            course,
                            stage.delta,
                            coefficients,
                            source,
                            &mut self.noise,
                        ),
                    }
                    let pooled = pool(&source.samples, &self.noise.whitened, &self.motion.whitened);
                    stage.decide(pooled.statistics(|| self.ties.keys()), counters);
                }
            }
        }
    }
}

impl Stage {
    /// Counts the regions that decide H₁.
    #[inline]
    fn decide(&self, statistics: Statistics, counters: &mut [u64]) {
        for decision in &self.decisions {
            counters[decision.counter] += u64::from(decision.region.contains(statistics));
        }
    }
}

impl NoiseRecord {
    /// Stationary noise of the sensor.
    fn draw(&mut self, source: &Source, generator: &mut Generator) {
        source.noise.fill(generator, &mut self.raw);
        source.sensor.colour(&mut self.raw);
    }

    /// The record of rest as the sensor writes it down.
    fn observe(&mut self, digitiser: &Digitiser, decimation: usize) {
        observe(
            &self.raw[self.burn_in..],
            digitiser,
            decimation,
            &mut self.observed,
        );
    }

    /// The observations the filter is fitted to.
    fn training(&self, branch: &Branch, source: &Source) -> &[f64] {
        let end = match branch.whitening.includes_reference() {
            true => source.lead + source.samples.reference(),
            false => source.lead,
        };
        &self.observed[end - branch.whitening.training()..end]
    }
}

impl MotionBuffers {
    /// The pattern of this course from the trial's draws.
    fn draw_impulses(&mut self, course: &Course, source: &Source) {
        let first = course.first_impulse(&source.samples);
        let (silent, acting) = self.pattern.split_at_mut(first);
        silent.fill(0.0);
        course.impulses.pattern(&self.draws[first..], acting);
    }

    /// Whitened responses to a unit step and to the impulses, and the whitened record without step.
    fn respond(&mut self, course: &Course, coefficients: &[f64], source: &Source, noise: &[f64]) {
        whiten(coefficients, &course.observed_shape, 0, &mut self.step);
        let decimation = source.samples.decimation();
        observe(
            &self.pattern,
            &Digitiser::default(),
            decimation,
            &mut self.observed,
        );
        whiten(coefficients, &self.observed, 0, &mut self.impulse);
        let theta = course.impulses.theta();
        let noise = &noise[source.samples.reference()..];
        for ((sum, xi), impulse) in self.without_step.iter_mut().zip(noise).zip(&self.impulse) {
            *sum = xi + theta * impulse;
        }
    }

    /// Adds Δ times the step response.
    fn add_step(&mut self, delta: f64) {
        for ((y, rest), step) in self
            .whitened
            .iter_mut()
            .zip(&self.without_step)
            .zip(&self.step)
        {
            *y = rest + delta * step;
        }
    }

    /// Writes the record with the motion in it, digitises it and whitens it.
    fn record_anew(
        &mut self,
        branch: &Branch,
        course: &Course,
        delta: f64,
        coefficients: &[f64],
        source: &Source,
        noise: &mut NoiseRecord,
    ) {
        let theta = course.impulses.theta();
        let rest = &noise.raw[noise.raw.len() - self.raw.len()..];
        for (i, r) in self.raw.iter_mut().enumerate() {
            *r = rest[i] + delta * course.shape[i] + theta * self.pattern[i];
        }
        let start = source.lead + source.samples.reference();
        let decimation = source.samples.decimation();
        observe(
            &self.raw,
            &branch.digitiser,
            decimation,
            &mut noise.observed[start..],
        );
        whiten(coefficients, &noise.observed, start, &mut self.whitened);
    }
}

impl Ties<'_> {
    fn start(&mut self, trial: u64) {
        self.trial = trial;
        self.drawn = false;
    }

    fn keys(&mut self) -> &[u64] {
        if !self.drawn {
            let mut generator = self.stream.at(self.trial);
            for key in &mut self.keys {
                *key = generator.next_u64();
            }
            self.drawn = true;
        }
        &self.keys
    }
}

/// X from the whitened rest, Y₁ and Y₂ from what follows it.
fn pool<'a>(samples: &Samples, rest: &'a [f64], motion: &'a [f64]) -> Pooled<'a> {
    let after = |range: std::ops::Range<usize>| {
        &motion[range.start - samples.reference()..range.end - samples.reference()]
    };
    Pooled {
        reference: &rest[samples.reference_range()],
        shift: after(samples.shift_range()),
        scale: after(samples.scale_range()),
    }
}

/// Digitises raw samples and takes block means: sums of codes, which are exact, then one scale.
fn observe(raw: &[f64], digitiser: &Digitiser, decimation: usize, observed: &mut [f64]) {
    let scale = digitiser.unit() / decimation as f64;
    for (mean, block) in observed.iter_mut().zip(raw.chunks_exact(decimation)) {
        *mean = block.iter().map(|&x| digitiser.code(x)).sum::<f64>() * scale;
    }
}
