//! The recursion x_i = Σ φ_p x_{i−p} + ξ_i: one step, a stationary start, and the burn-in from a zero state.

use crate::simd::Value;

/// The best prediction of a stationary sample from all earlier ones, and the standard deviation of its error.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Start {
    pub ar: Vec<f64>,
    pub deviation: f64,
}

/// The longest burn-in of a trial, samples.
pub(super) const LONGEST_BURN_IN: usize = 1_000_000;

/// The share of the stationary variance that may be missing at the start of a record.
const BURN_IN_DEFICIT: f64 = 1e-9;

/// The number of samples after the zero state until less than a billionth of the stationary variance is
/// missing: the tail Σ_{k≥n} h_k² of the impulse response, whose decay is set by the poles.
pub(super) fn burn_in(ar: &[f64]) -> usize {
    if ar.is_empty() {
        return 0;
    }
    let mut response = vec![1.0];
    let mut energy = vec![0.0, 1.0];
    let mut quiet = 0;
    while response.len() <= 2 * LONGEST_BURN_IN && quiet < 64 + ar.len() {
        let next = predict(ar, &response, 0.0);
        response.push(next);
        let total = energy[energy.len() - 1] + next * next;
        energy.push(total);
        quiet = if next * next < 1e-20 * total {
            quiet + 1
        } else {
            0
        };
    }
    let total = energy[energy.len() - 1];
    energy.partition_point(|&sum| total - sum > BURN_IN_DEFICIT * total)
}

/// Σ φ_p x_{i−p} + ξ, where `past` ends with x_{i−1} and samples before it count as zero.
#[inline(always)]
pub(super) fn predict<V: Value>(ar: &[f64], past: &[V], innovation: V) -> V {
    let mut sum = innovation;
    for (phi, x) in ar.iter().zip(past.iter().rev()) {
        sum = sum + *x * *phi;
    }
    sum
}

/// The best predictors of order 0, 1, … below that of `ar`, by the step-down recursion from it: the last
/// coefficient k of each order is a reflection coefficient, and the error's variance grows by
/// 1/(1 − k²) with every order taken away.
///
/// # Errors
/// The first reflection coefficient outside (−1, 1), with its index: then nothing is stationary.
pub(super) fn starts(ar: &[f64]) -> Result<Vec<Start>, (usize, f64)> {
    let mut predictor = ar.to_vec();
    let mut variance = 1.0;
    let mut starts = Vec::new();
    while let Some(&reflection) = predictor.last() {
        if reflection.is_nan() || reflection.abs() >= 1.0 {
            return Err((predictor.len(), reflection));
        }
        predictor = step_down(&predictor);
        variance /= 1.0 - reflection * reflection;
        starts.push(Start {
            ar: predictor.clone(),
            deviation: libm::sqrt(variance),
        });
    }
    starts.reverse();
    Ok(starts)
}

/// The best predictor of the order below, by one step of that recursion.
pub(crate) fn step_down(predictor: &[f64]) -> Vec<f64> {
    let Some((reflection, rest)) = predictor.split_last() else {
        return Vec::new();
    };
    let scale = 1.0 - reflection * reflection;
    (rest.iter().zip(rest.iter().rev()))
        .map(|(phi, mirrored)| (phi + reflection * mirrored) / scale)
        .collect()
}
