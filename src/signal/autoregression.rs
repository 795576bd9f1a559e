//! The recursion x_i = Σ φ_p x_{i−p} + ξ_i: one step, how it starts out stationary, and how long it takes
//! to become so from nothing.

use crate::simd::Value;

/// The best prediction of a stationary sample from all before it, and the deviation of its error.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Start {
    pub ar: Vec<f64>,
    pub deviation: f64,
}

/// The longest burn-in that a trial may spend.
pub(super) const LONGEST_BURN_IN: usize = 1_000_000;

/// The share of the stationary variance that the start of a record may lack.
const BURN_IN_DEFICIT: f64 = 1e-9;

/// How many samples after the zero state lack no more than a billionth of the stationary variance:
/// the tail Σ_{k≥n} h_k² of the impulse response, whose decay the poles set.
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

/// Σ φ_p x_{i−p} + ξ, where `past` ends with x_{i−1} and what precedes it counts as zero.
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
