//! The moment formula.

use super::{phases, simulated};
use crate::track::{Densities, Method, Phases, Steps, TrackSettings, Uncertain, moments};
use nalgebra::{DMatrix, DVector};

/// Var d = (2/3) S_a [(T_c/2 + T_a)³ − (T_c/2)³] of a symmetric trip with changes of T_a and uniform motion of T_c. Steps of
/// 5 ms put the ends wrong by half of one, of 2 s and more: below 1 %.
#[test]
fn agrees_with_the_closed_form() {
    let density = Densities::default().acceleration;
    for (distance, centimetres) in [(3.0, 0.62), (9.0, 1.59), (15.0, 2.62), (27.0, 4.70)] {
        let (samples, journey) = simulated(distance, 0, false);
        let (change, uniform) = (
            journey.uniform - journey.start,
            journey.braking - journey.uniform,
        );
        let cube = |seconds: f64| seconds.powi(3);
        let variance = 2.0 / 3.0 * density * (cube(uniform / 2.0 + change) - cube(uniform / 2.0));
        let steps: Vec<_> = Steps::of(&samples).collect();
        let found = moments(&steps, &phases(&journey).changes(), density);
        assert!(
            (found.variance / variance - 1.0).abs() < 0.01,
            "{distance} m"
        );
        // As printed in the table of the specification.
        assert!(
            (100.0 * variance.sqrt() - centimetres).abs() < 0.006,
            "{distance} m"
        );
        assert!(
            (found.mean - distance).abs() < 1e-4,
            "{distance} m: {found:?}"
        );
    }
}

/// Least squares over every acceleration of the changes, whose sum is zero, and the bias of all samples, written down as one
/// system of equations: its distance, and what unit noise does to it, are those of the formula.
#[test]
fn is_the_projection() {
    let (samples, journey) = simulated(3.0, 1, true);
    let samples: Vec<_> = samples.into_iter().step_by(20).collect();
    let steps: Vec<_> = Steps::of(&samples).skip(1).collect();
    let steps = &steps[..steps.len() - 1];
    let phases = phases(&journey);
    let is_change = |time: f64| phases.changes().iter().any(|part| part.contains(&time));
    let changes: Vec<usize> = (0..steps.len())
        .filter(|k| is_change(steps[*k].time))
        .collect();
    let (count, unknowns) = (steps.len(), changes.len() + 1);
    let mut model = DMatrix::zeros(count, unknowns);
    for row in 0..count {
        model[(row, unknowns - 1)] = 1.0;
    }
    for (column, &row) in changes.iter().enumerate() {
        model[(row, column)] = 1.0;
    }
    let mut system = DMatrix::zeros(unknowns + 1, unknowns + 1);
    let normal = model.transpose() * &model;
    system
        .view_mut((0, 0), (unknowns, unknowns))
        .copy_from(&normal);
    for column in 0..changes.len() {
        system[(column, unknowns)] = 1.0;
        system[(unknowns, column)] = 1.0;
    }
    // The distance that a constant bias and each sample give.
    let mut weights = DVector::zeros(unknowns + 1);
    let seconds = steps[0].seconds;
    for (column, &row) in changes.iter().enumerate() {
        weights[column] = -steps[row].time * seconds;
    }
    let solved = system.lu().solve(&weights).expect("it has one solution");
    let gains = model * solved.rows(0, unknowns);
    let distance: f64 = (gains.iter().zip(steps))
        .map(|(gain, step)| gain * step.acceleration)
        .sum();
    let variance: f64 = gains.iter().map(|gain| gain * gain / seconds).sum();
    let found = moments(steps, &phases.changes(), 1.0);
    assert!((found.mean - distance).abs() < 1e-9, "{found:?} {distance}");
    assert!(
        (found.variance / variance - 1.0).abs() < 1e-9,
        "{found:?} {variance}"
    );
}

/// Of all methods only plain integration feels the bias: without noise the others find the distance, and it is off by
/// δb T²/2.
#[test]
fn methods_without_noise() {
    let (samples, journey) = simulated(9.0, 0, false);
    let phases = phases(&journey);
    let bias = Uncertain {
        mean: 0.31,
        variance: 1e-4,
    };
    let settings = TrackSettings::default();
    let distance = |method| phases.distance(method, &samples, bias, &settings);
    let seconds = journey.stop - journey.start;
    for method in [Method::Filter, Method::Moments, Method::DriftRemoved] {
        let error = distance(method).mean - 9.0;
        assert!(error.abs() < 1e-3, "{method:?}: {error}");
    }
    let plain = distance(Method::Integrated);
    let error = -0.01 * seconds * seconds / 2.0;
    assert!(
        (plain.mean - 9.0 - error).abs() < 0.01 * error.abs(),
        "{plain:?} {error}"
    );
    let order = [
        Method::Moments,
        Method::Filter,
        Method::DriftRemoved,
        Method::Integrated,
    ];
    let variances = order.map(|method| distance(method).variance);
    assert!(variances.is_sorted(), "{variances:?}");
}

/// A step wrong by e all through the acceleration, and by another through the braking, whose mean is taken for bias: of a trip
/// of T seconds without uniform motion d = (e₁ − e₂) T²/8.
#[test]
fn coarse_steps_of_a_trip_without_uniform_motion() {
    let phases = Phases {
        before: 0.0..2.0,
        uniform: [4.3..3.7, 6.0..6.0],
        after: 6.0..7.0,
    };
    let error = 0.18 / 12f64.sqrt();
    let expected = error * 2f64.sqrt() * 4.0 * 4.0 / 8.0;
    let found = phases.error_of_steps(0.18);
    assert!((found - expected).abs() < 1e-12, "{found} {expected}");
}
