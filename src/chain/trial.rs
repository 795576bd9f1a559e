//! One trial of a family, in buffers that are allocated once and reused for a whole block.

use super::family::{Branch, Course, Family, Source};
use super::observation::{Observation, Scratch};
use crate::detect::{Pooled, Samples};
use crate::rng::{Generator, Stream};
use crate::signal::Digitiser;
use crate::whiten::{Fitter, whiten};
use rand::Rng;

/// The buffers of a trial. Times run from the first observation of the record, or, where named
/// `motion`, from the first after X.
pub struct Trial<'a> {
    family: &'a Family,
    fitters: Vec<Fitter>,
    noise: NoiseRecord,
    motion: MotionBuffers,
    keys: Keys<'a>,
    scratch: Scratch,
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
    /// The observed record with the motion in it.
    record: Vec<f64>,
}

/// Keys for a trial's ties; random ones are drawn when first asked for.
pub(super) struct Keys<'a> {
    stream: &'a Stream,
    trial: u64,
    random: Vec<u64>,
    drawn: bool,
    positions: Vec<u64>,
}

impl<'a> Trial<'a> {
    /// The buffers for trials of `family`.
    pub fn new(family: &'a Family) -> Self {
        let source = &family.source;
        let after = source.motion_observations();
        let raw_after = after * source.samples.decimation();
        let span = source.samples.span();
        let fitter = |branch: &Branch| Fitter::new(branch.whitening, source.sensor.ar());
        Self {
            family,
            fitters: family.branches.iter().map(fitter).collect(),
            noise: NoiseRecord {
                raw: vec![0.0; source.burn_in() + source.raw_length()],
                burn_in: source.burn_in(),
                observed: vec![0.0; source.observations()],
                whitened: vec![0.0; span],
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
                record: vec![0.0; after],
            },
            keys: Keys {
                stream: &family.ties,
                trial: 0,
                random: vec![0; span],
                drawn: false,
                positions: (0..span as u64).collect(),
            },
            scratch: Scratch::default(),
        }
    }

    /// Draws the noise of trial `index` and shows every point of the family, by its place, what it
    /// gives there.
    pub fn run(&mut self, index: u64, mut show: impl FnMut(usize, &mut Observation)) {
        let family = self.family;
        let source = &family.source;
        self.keys.start(index);
        self.noise.draw(family, index);
        let mut impulses = family.impulses.at(index);
        for draw in &mut self.motion.draws {
            *draw = impulses.next_u64();
        }
        for (branch, fitter) in family.branches.iter().zip(&mut self.fitters) {
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
                    let (motion, noise) = (&mut self.motion, &mut self.noise);
                    match is_linear {
                        true => motion.add_step(stage.delta),
                        false => motion.record_anew(
                            branch,
                            course,
                            stage.delta,
                            coefficients,
                            source,
                            noise,
                        ),
                    }
                    if stage.needs_record {
                        motion.keep_record(course, stage.delta, is_linear, source, noise);
                    }
                    let record = if stage.needs_record {
                        &motion.record[..]
                    } else {
                        &[]
                    };
                    let mut observation = Observation {
                        pooled: pool(&source.samples, &noise.whitened, &motion.whitened),
                        samples: &source.samples,
                        rest: &noise.observed[..source.rest()],
                        motion: record,
                        keys: &mut self.keys,
                        statistics: None,
                        scratch: &mut self.scratch,
                    };
                    for &place in &stage.places {
                        show(place, &mut observation);
                    }
                }
            }
        }
    }
}

impl NoiseRecord {
    /// Stationary noise of the sensor, and what disturbs it.
    fn draw(&mut self, family: &Family, index: u64) {
        let source = &family.source;
        source
            .noise
            .fill(&mut family.noise.at(index), &mut self.raw);
        source.sensor.colour(&mut self.raw);
        let mut footfalls: Option<Generator> = None;
        let draw = || {
            let generator = footfalls.get_or_insert_with(|| family.footfalls.at(index));
            generator.next_u64()
        };
        let after_rest = source.rest() * source.samples.decimation();
        let record = &mut self.raw[self.burn_in..];
        source.disturbance.act(record, after_rest, draw);
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
            true => source.rest(),
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
        let start = source.rest();
        let decimation = source.samples.decimation();
        observe(
            &self.raw,
            &branch.digitiser,
            decimation,
            &mut noise.observed[start..],
        );
        whiten(coefficients, &noise.observed, start, &mut self.whitened);
    }

    /// The observed record of this stage: already written by the direct path, a sum on the linear one.
    fn keep_record(
        &mut self,
        course: &Course,
        delta: f64,
        is_linear: bool,
        source: &Source,
        noise: &NoiseRecord,
    ) {
        let observed = &noise.observed[source.rest()..];
        if !is_linear {
            self.record.copy_from_slice(observed);
            return;
        }
        let theta = course.impulses.theta();
        let motion = course.observed_shape.iter().zip(&self.observed);
        for ((r, x), (shape, impulse)) in self.record.iter_mut().zip(observed).zip(motion) {
            *r = x + delta * shape + theta * impulse;
        }
    }
}

impl Keys<'_> {
    fn start(&mut self, trial: u64) {
        self.trial = trial;
        self.drawn = false;
    }

    /// A random key for each sample.
    pub fn random(&mut self) -> &[u64] {
        if !self.drawn {
            let mut generator = self.stream.at(self.trial);
            for key in &mut self.random {
                *key = generator.next_u64();
            }
            self.drawn = true;
        }
        &self.random
    }

    /// Keys in the order of time.
    pub fn positions(&self) -> &[u64] {
        &self.positions
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
