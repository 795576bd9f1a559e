//! An upper bound on power: the Neyman–Pearson detector for known Δ, ν, θ and filter, and normal noise.
//!
//! With the true filter the record becomes z_i = ξ_i + d_i + θ Σ_p c_p l_{i−p}, c = (1, −φ₁, −φ₂, …),
//! where d is the whitened acceleration and l = λ/θ the impulses. At rest z is white, so samples before
//! the motion carry no information, and the best statistic is
//!
//! ln Σ_l P(l) ∏_i φ(z_i − d_i − θ Σ_p c_p l_{i−p}) / φ(z_i),
//!
//! over all sequences of impulses. They form a Markov chain: an impulse depends on S, the sum of those
//! before it, and the filter looks back m samples, so the state is (S_{i−m}, …, S_i), and the sum is
//! one pass of the forward algorithm.

use crate::series::exp;
use crate::simd::{Vectors, greatest, least};

/// Transitions into a state, at most: the sum that its path has dropped was 0, 1 or −1.
const INTO: usize = 3;

/// The statistic, ready for one alternative.
#[derive(Clone, Debug, PartialEq)]
pub struct Clairvoyant {
    /// d: the whitened acceleration at each sample of the motion.
    shift: Vec<f64>,
    /// The first sample that may carry an impulse.
    first_impulse: usize,
    /// Those into each state. Where there are fewer, the others have no probability.
    steps: Vec<[Step; INTO]>,
    /// The effects that steps have on the mean, each once.
    means: Vec<f64>,
}

/// A transition into a state: from which, the place of its effect on the mean, and its probability.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Step {
    from: usize,
    mean: usize,
    probability: f64,
}

/// Scratch space of an evaluation.
#[derive(Clone, Debug, Default)]
pub struct Forward {
    now: Vec<f64>,
    next: Vec<f64>,
    /// Of each step.
    weights: Vec<[f64; INTO]>,
    /// Of each effect on the mean: the exponents, then what they come to.
    likelihoods: Vec<f64>,
}

impl Clairvoyant {
    /// The statistic for a whitened acceleration `shift`, impulses of probability `nu` and strength `theta`
    /// from sample `first_impulse` on, and a sensor with the autoregression `ar`.
    pub fn new(shift: Vec<f64>, first_impulse: usize, nu: f64, theta: f64, ar: &[f64]) -> Self {
        let states = states(ar.len());
        let mut steps = vec![[Step::default(); INTO]; states.len()];
        let (mut known, mut means) = (vec![0; states.len()], Vec::<f64>::new());
        for (from, path) in states.iter().enumerate() {
            for (sum, probability) in next_sums(path[path.len() - 1], nu) {
                let longer = extended(path, sum);
                let mean = theta * whitened_impulse(&longer, ar);
                let place = means.iter().position(|other| *other == mean);
                let place = place.unwrap_or_else(|| {
                    means.push(mean);
                    means.len() - 1
                });
                let to = states.iter().position(|path| *path == longer[1..]);
                let to = to.expect("every allowed path is a state");
                steps[to][known[to]] = Step {
                    from,
                    mean: place,
                    probability,
                };
                known[to] += 1;
            }
        }
        Self {
            shift,
            first_impulse,
            steps,
            means,
        }
    }

    /// The log likelihood ratio of `innovations`: the record from the first sample of the motion on, whitened
    /// with the true filter.
    pub fn log_likelihood_ratio(&self, innovations: &[f64], forward: &mut Forward) -> f64 {
        Vectors::widest().run(
            #[inline(always)]
            || self.pass(innovations, forward),
        )
    }

    #[inline(always)]
    fn pass(&self, innovations: &[f64], forward: &mut Forward) -> f64 {
        let Forward {
            now,
            next,
            weights,
            likelihoods,
        } = forward;
        now.clear();
        now.resize(self.steps.len(), 0.0);
        next.resize(self.steps.len(), 0.0);
        weights.resize(self.steps.len(), [0.0; INTO]);
        likelihoods.resize(self.means.len(), 0.0);
        // Before the first impulse every sum is zero, which is the first state.
        now[0] = 1.0;
        let mut logarithm = 0.0;
        for (i, (z, shift)) in innovations.iter().zip(&self.shift).enumerate() {
            if i < self.first_impulse {
                logarithm += shift * (z - shift / 2.0);
                continue;
            }
            for (exponent, mean) in likelihoods.iter_mut().zip(&self.means) {
                let mean = shift + mean;
                *exponent = mean * (z - mean / 2.0);
            }
            // The largest exponent of what is possible is factored out of the sum, so that nothing overflows.
            let mut largest = f64::NEG_INFINITY;
            for (weights, steps) in weights.iter_mut().zip(&self.steps) {
                for (weight, step) in weights.iter_mut().zip(steps) {
                    *weight = now[step.from] * step.probability;
                    if *weight > 0.0 {
                        largest = greatest(likelihoods[step.mean], largest);
                    }
                }
            }
            for likelihood in likelihoods.iter_mut() {
                *likelihood = exp(least(0.0, *likelihood - largest));
            }
            for ((next, weights), steps) in next.iter_mut().zip(&*weights).zip(&self.steps) {
                let each = weights.iter().zip(steps);
                *next = each
                    .map(|(weight, step)| weight * likelihoods[step.mean])
                    .sum();
            }
            let sum: f64 = next.iter().sum();
            logarithm += largest;
            logarithm += libm::log(sum);
            next.iter_mut().for_each(|weight| *weight /= sum);
            std::mem::swap(now, next);
        }
        logarithm
    }
}

/// All possible paths (S_{i−m}, …, S_i), all zeros first.
fn states(order: usize) -> Vec<Vec<i8>> {
    let mut paths: Vec<Vec<i8>> = vec![vec![0], vec![1], vec![-1]];
    for _ in 0..order {
        paths = (paths.iter())
            .flat_map(|path| {
                let sums = next_sums(path[path.len() - 1], 0.5).into_iter();
                sums.map(|(sum, _)| extended(path, sum))
            })
            .collect();
    }
    paths
}

fn extended(path: &[i8], sum: i8) -> Vec<i8> {
    [path, &[sum]].concat()
}

/// The possible next values of S, with their probabilities.
fn next_sums(sum: i8, nu: f64) -> Vec<(i8, f64)> {
    match sum {
        0 => vec![(0, 1.0 - nu), (1, nu / 2.0), (-1, nu / 2.0)],
        _ => vec![(sum, 1.0 - nu), (0, nu)],
    }
}

/// Σ_p c_p l_{i−p} for the impulses along a path of sums.
fn whitened_impulse(sums: &[i8], ar: &[f64]) -> f64 {
    let impulses = sums
        .windows(2)
        .rev()
        .map(|pair| f64::from(pair[1] - pair[0]));
    let filter = std::iter::once(1.0).chain(ar.iter().map(|phi| -phi));
    impulses.zip(filter).map(|(l, c)| l * c).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the definition: a sum over every sequence of impulses, each by its own probability and
    /// density.
    #[test]
    fn forward_pass_is_the_sum_over_all_sequences() {
        let ar = [-1.5365, -0.75056];
        let z = [0.3, -1.2, 2.5, 0.1, -0.7, 1.9];
        let shift = [0.5, 1.0, 1.5, 1.5, 0.0, -0.5];
        for (nu, theta, first) in [(0.3, 2.0, 0), (0.1, 1.0, 2), (1.0, 0.5, 0), (0.0, 3.0, 0)] {
            let mut total = 0.0;
            // Each sample: no impulse, or one with either sign of a fresh start.
            for code in 0..3u32.pow(z.len() as u32) {
                let mut impulses = [0.0; 6];
                let (mut sum, mut probability, mut rest) = (0.0, 1.0, code);
                for (i, impulse) in impulses.iter_mut().enumerate() {
                    let choice = rest % 3;
                    rest /= 3;
                    let chance = if i < first { 0.0 } else { nu };
                    match (choice, sum == 0.0) {
                        (0, _) => probability *= 1.0 - chance,
                        (_, true) => {
                            *impulse = if choice == 1 { 1.0 } else { -1.0 };
                            probability *= chance / 2.0;
                        }
                        (1, false) => {
                            *impulse = -sum;
                            probability *= chance;
                        }
                        _ => probability = 0.0,
                    }
                    sum += *impulse;
                }
                let ratio: f64 = (0..6)
                    .map(|i| {
                        let back = |p: usize| if i >= p { impulses[i - p] } else { 0.0 };
                        let mean = shift[i] + theta * (back(0) - ar[0] * back(1) - ar[1] * back(2));
                        mean * z[i] - mean * mean / 2.0
                    })
                    .sum();
                total += probability * ratio.exp();
            }
            let clairvoyant = Clairvoyant::new(shift.to_vec(), first, nu, theta, &ar);
            let ratio = clairvoyant.log_likelihood_ratio(&z, &mut Forward::default());
            assert!(
                (ratio - total.ln()).abs() < 1e-12,
                "{nu} {theta}: {ratio} {}",
                total.ln()
            );
        }
    }

    #[test]
    fn without_impulses_it_is_the_matched_filter() {
        let clairvoyant = Clairvoyant::new(vec![1.0, 2.0], 0, 0.0, 5.0, &[0.5]);
        let ratio = clairvoyant.log_likelihood_ratio(&[0.7, -0.2], &mut Forward::default());
        assert!((ratio - (0.7 - 0.5 - 0.4 - 2.0)).abs() < 1e-12);
    }
}
