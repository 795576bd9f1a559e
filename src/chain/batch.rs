//! The noise of [`LANES`] trials side by side: drawn, coloured, observed, whitened.
//!
//! Trials whose indices have the same quotient by [`LANES`] are drawn together, from one stream. The values
//! do not depend on which of them are used or in which order.

use super::family::{Branch, Family};
use super::source::Source;
use crate::rng::Generator;
use crate::signal::{Digitiser, fill_bytes};
use crate::simd::{LANES, Value, Vectors, Wide};
use crate::whiten::{Fitter, step};
use rand::Rng;

/// The noise of one batch of trials, as every branch observes it.
pub(super) struct Batch<'a> {
    family: &'a Family,
    /// The batch held now.
    index: Option<u64>,
    /// Raw samples, burn-in first.
    raw: Vec<Wide>,
    /// Digitised block means of the branch processed last.
    observed: Vec<Wide>,
    /// Whitened observations of that branch from the first of X.
    whitened: Vec<Wide>,
    branches: Vec<Rest>,
    /// 64 random bits for the impulse of each raw observation after X, trial by trial.
    impulses: Vec<[u8; 8]>,
}

/// The rest as one branch observes it, trial by trial.
struct Rest {
    fitter: Fitter<Wide>,
    coefficients: Vec<f64>,
    whitened: Vec<f64>,
}

impl<'a> Batch<'a> {
    pub fn new(family: &'a Family) -> Self {
        let source = &family.source;
        let span = source.samples.span();
        let impulses = if family.has_impulses() {
            source.motion_observations() * source.samples.decimation()
        } else {
            0
        };
        let branches = family.branches.iter();
        Self {
            family,
            index: None,
            raw: vec![Wide::default(); source.burn_in() + source.raw_length()],
            observed: vec![Wide::default(); source.observations()],
            whitened: vec![Wide::default(); span],
            branches: branches
                .map(|branch| Rest {
                    fitter: Fitter::new(branch.whitening, source.sensor.ar()),
                    coefficients: vec![0.0; branch.whitening.highest_order() * LANES],
                    whitened: vec![0.0; span * LANES],
                })
                .collect(),
            impulses: vec![[0; 8]; LANES * impulses],
        }
    }

    /// Draws the batch of `trial` unless it is held already, and returns the lane of the trial.
    pub fn seek(&mut self, trial: u64) -> usize {
        let (index, lane) = (trial / LANES as u64, trial % LANES as u64);
        if self.index != Some(index) {
            self.index = Some(index);
            self.draw(index);
        }
        lane as usize
    }

    /// The coefficients and the whitened rest of branch `index` in the trial of `lane`.
    pub fn rest(&self, index: usize, lane: usize) -> (&[f64], &[f64]) {
        let Rest {
            coefficients,
            whitened,
            ..
        } = &self.branches[index];
        (part(coefficients, lane), part(whitened, lane))
    }

    /// 64 random bits for each raw observation after X; empty without impulses.
    pub fn impulses(&self, lane: usize) -> &[[u8; 8]] {
        part(&self.impulses, lane)
    }

    /// The raw record of rest in the trial of `lane`, without the burn-in.
    pub fn raw(&self, lane: usize) -> impl Iterator<Item = f64> {
        let record = &self.raw[self.family.source.burn_in()..];
        record.iter().map(move |wide| wide.0[lane])
    }

    fn draw(&mut self, index: u64) {
        let family = self.family;
        let source = &family.source;
        source
            .noise
            .fill(&mut family.noise.at(index), &mut self.raw);
        let impulses = self.impulses.as_flattened_mut();
        fill_bytes(Vectors::widest(), &mut family.impulses.at(index), impulses);
        // Created on first use, because only footfalls draw from it.
        let mut footfalls: Option<Generator> = None;
        let footfall = || {
            let generator = footfalls.get_or_insert_with(|| family.footfalls.at(index));
            generator.next_u64()
        };
        Vectors::widest().run(
            #[inline(always)]
            || {
                match source.burn_in() {
                    0 => source.sensor.colour_stationary(&mut self.raw),
                    _ => source.sensor.colour(&mut self.raw),
                }
                let record = &mut self.raw[source.burn_in()..];
                let after_rest = source.rest() * source.samples.decimation();
                source.disturbance.act(record, after_rest, footfall);
                for (branch, rest) in family.branches.iter().zip(&mut self.branches) {
                    see(
                        source,
                        branch,
                        record,
                        &mut self.observed,
                        &mut self.whitened,
                        rest,
                    );
                }
            },
        );
    }
}

/// Observes and whitens `record` by the digitiser and filter of `branch`.
#[inline(always)]
fn see(
    source: &Source,
    branch: &Branch,
    record: &[Wide],
    observed: &mut [Wide],
    whitened: &mut [Wide],
    rest: &mut Rest,
) {
    let decimation = source.samples.decimation();
    // Without a digitiser and block means the record is its own observation and needs no copy.
    let observed = if decimation == 1 && branch.digitiser.is_transparent() {
        record
    } else {
        observe(&branch.digitiser, decimation, record, observed);
        &*observed
    };
    let end = if branch.whitening.includes_reference {
        source.rest()
    } else {
        source.lead
    };
    let training = &observed[end - branch.whitening.training..end];
    let coefficients = rest.fitter.fit(training);
    let order = coefficients.len();
    for (i, y) in (source.lead..).zip(whitened.iter_mut()) {
        *y = step(coefficients, &observed[i - order..i], observed[i]);
    }
    deal(coefficients, &mut rest.coefficients);
    deal(whitened, &mut rest.whitened);
}

/// Digitises raw samples and takes block means: exact sums of integer codes, then one scale factor.
#[inline(always)]
pub(super) fn observe<V: Value>(
    digitiser: &Digitiser,
    decimation: usize,
    raw: &[V],
    observed: &mut [V],
) {
    let scale = digitiser.unit() / decimation as f64;
    for (mean, block) in observed.iter_mut().zip(raw.chunks_exact(decimation)) {
        let mut sum = V::default();
        for x in block {
            let mut code = *x;
            for x in code.lanes_mut() {
                *x = digitiser.code(*x);
            }
            sum = sum + code;
        }
        *mean = sum * scale;
    }
}

/// Transposes lanes into one run of values per trial.
#[inline(always)]
fn deal(wide: &[Wide], trials: &mut [f64]) {
    for (lane, trial) in trials.chunks_exact_mut(wide.len().max(1)).enumerate() {
        for (value, wide) in trial.iter_mut().zip(wide) {
            *value = wide.0[lane];
        }
    }
}

/// The part of `all` that belongs to the trial of `lane`.
fn part<T>(all: &[T], lane: usize) -> &[T] {
    let length = all.len() / LANES;
    &all[lane * length..(lane + 1) * length]
}
