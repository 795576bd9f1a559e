//! Distances without a filter, for comparison: the bound, and what is usually done.
//!
//! Where the bias is constant and the speed is zero at both ends, with A the times of acceleration and braking,
//! u the acceleration read and t̄ the mean time of A,
//!
//! d = −∫_A (t − t̄) u dt, var d = S_a ∫_A (t − t̄)² dt.
//!
//! The bias cancels, and noise in uniform motion does not count. No estimate is better: d is the best linear unbiased
//! one on the samples of A alone, and the others only know that the speed did not change. With A all of the trip it is
//! zero-velocity integration with the drift of the speed removed linearly, var d = S_a T³/12. Plain integration takes a
//! bias b known beforehand: d = ∫ (t₁ − t) (u − b) dt.

use super::filter::Uncertain;
use super::steps::Step;
use std::ops::Range;

/// The distance of a trip, m, by the steps within any of `parts`, s, where S_a is `density`.
pub fn moments(steps: &[Step], parts: &[Range<f64>], density: f64) -> Uncertain {
    let within = || {
        let is_within = |step: &&Step| parts.iter().any(|part| part.contains(&step.time));
        steps.iter().filter(is_within)
    };
    let seconds: f64 = within().map(|step| step.seconds).sum();
    let middle = within().map(|step| step.time * step.seconds).sum::<f64>() / seconds;
    let mut distance = Uncertain::default();
    for step in within() {
        let lever = step.time - middle;
        distance.mean -= lever * step.seconds * step.acceleration;
        distance.variance += density * lever * lever * step.seconds;
    }
    distance
}

/// The distance by plain integration over `trip`, s.
pub fn integrated(steps: &[Step], trip: &Range<f64>, bias: Uncertain, density: f64) -> Uncertain {
    let mut distance = Uncertain::default();
    let mut lever_of_bias = 0.0;
    for step in steps.iter().filter(|step| trip.contains(&step.time)) {
        let lever = trip.end - step.time;
        distance.mean += lever * step.seconds * (step.acceleration - bias.mean);
        distance.variance += density * lever * lever * step.seconds;
        lever_of_bias += lever * step.seconds;
    }
    distance.variance += bias.variance * lever_of_bias * lever_of_bias;
    distance
}
