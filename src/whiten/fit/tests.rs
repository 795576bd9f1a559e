//! The three fits against their definitions, and records side by side against each alone.

use super::*;
use crate::rng::Stream;
use crate::signal::{Law, Noise, Sensor};
use crate::simd::{LANES, Wide};
use crate::whiten::{Chosen, WhiteningError, step, whiten};

fn record(ar: &[f64], length: usize, position: u64) -> Vec<f64> {
    let sensor = Sensor::from_ar(ar.to_vec()).unwrap();
    let mut record = vec![0.0; length + sensor.burn_in()];
    let mut generator = Stream::new(2014, "whiten", "test").at(position);
    Noise::new(Law::Normal)
        .unwrap()
        .fill(&mut generator, &mut record);
    sensor.colour(&mut record);
    record.split_off(sensor.burn_in())
}

fn fit(fit: Fit, order: usize, training: &[f64]) -> Vec<f64> {
    let whitening = Whitening::new(order, fit, training.len(), false, 2).unwrap();
    Fitter::new(whitening, &[]).fit(training).to_vec()
}

const FITS: [Fit; 3] = [Fit::LeastSquares, Fit::YuleWalker, Fit::Burg];

/// Estimates of φ are asymptotically normal with covariance (1 − φ₂²)/n and correlation
/// ρ₁, here deviation 0.66/√n each; a bound of 6 deviations fails with probability 2e-9 a
/// coefficient, 12 coefficients. The extra coefficients of a longer filter tend to zero.
#[test]
fn recovers_known_coefficients() {
    let n = 100_000;
    let training = record(&[-1.5365, -0.75056], n, 0);
    let bound = 6.0 / (n as f64).sqrt();
    for method in FITS {
        let short = fit(method, 2, &training);
        println!(
            "{method}: n = {n}, a = {short:?}, bound {:.5}",
            0.661 * bound
        );
        assert!((short[0] + 1.5365).abs() < 0.661 * bound);
        assert!((short[1] + 0.75056).abs() < 0.661 * bound);
        for extra in &fit(method, 4, &training)[2..] {
            assert!(extra.abs() < 2.0 * bound, "{method} {extra}");
        }
    }
}

/// The three differ by O(m/n) on one record.
#[test]
fn fits_agree_on_long_records() {
    let n = 100_000;
    let training = record(&[0.5, -0.3, 0.1], n, 1);
    let fits = FITS.map(|method| fit(method, 3, &training));
    for other in &fits[1..] {
        for (a, b) in fits[0].iter().zip(other) {
            assert!((a - b).abs() < 20.0 / n as f64, "{a} {b}");
        }
    }
}

/// Against the definition: the gradient of Σ_{i≥m} y_i² vanishes at the solution.
#[test]
fn least_squares_is_the_minimum() {
    for (order, length) in [(1, 3), (2, 5), (3, 12), (8, 40)] {
        let training = record(&[-1.5365, -0.75056], length, 2);
        let a = fit(Fit::LeastSquares, order, &training);
        let mean = training.iter().sum::<f64>() / length as f64;
        let x: Vec<f64> = training.iter().map(|x| x - mean).collect();
        let energy: f64 = x.iter().map(|x| x * x).sum();
        for p in 1..=order {
            let gradient: f64 = (order..length)
                .map(|i| step(&a, &x[..i], x[i]) * x[i - p])
                .sum();
            assert!(gradient.abs() < 1e-9 * energy, "{order} {p}: {gradient}");
        }
    }
}

/// Yule–Walker against its own equations, Burg against order 1 in closed form.
#[test]
fn recursions_solve_their_equations() {
    let training = record(&[-1.5365, -0.75056], 60, 3);
    let mean = training.iter().sum::<f64>() / 60.0;
    let x: Vec<f64> = training.iter().map(|x| x - mean).collect();
    let r = |k: usize| lagged_product(&x, 0.0, k, k..60);
    let a = fit(Fit::YuleWalker, 4, &training);
    for j in 1..=4usize {
        let sum: f64 = (1..=4usize).map(|k| a[k - 1] * r(j.abs_diff(k))).sum();
        assert!((sum - r(j)).abs() < 1e-10 * r(0), "{j}");
    }
    let burg = fit(Fit::Burg, 1, &training)[0];
    let energy = 2.0 * r(0) - x[0] * x[0] - x[59] * x[59];
    assert!((burg - 2.0 * r(1) / energy).abs() < 1e-14);
}

#[test]
fn mean_does_not_reach_the_fit() {
    let training = record(&[0.5], 200, 4);
    let shifted: Vec<f64> = training.iter().map(|x| x + 1000.0).collect();
    for method in FITS {
        let (a, b) = (fit(method, 2, &training), fit(method, 2, &shifted));
        assert!((a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9);
    }
}

#[test]
fn degenerate_records_get_finite_coefficients() {
    for training in [vec![3.0; 20], vec![0.0; 20], {
        let mut one = vec![0.0; 20];
        one[19] = 1.0;
        one
    }] {
        for method in FITS {
            assert!(fit(method, 4, &training).iter().all(|a| a.is_finite()));
        }
    }
}

#[test]
fn step_and_batch_agree_and_whitening_undoes_colour() {
    let sensor = Sensor::adxl105();
    let white: Vec<f64> = (0..40).map(|i| f64::from(i * 29 % 13) - 6.0).collect();
    let mut coloured = white.clone();
    sensor.colour(&mut coloured);
    let mut whitened = vec![0.0; 40];
    whiten(sensor.ar(), &coloured, 0, &mut whitened);
    for i in 0..40 {
        assert!((whitened[i] - white[i]).abs() < 1e-12);
        assert_eq!(whitened[i], step(sensor.ar(), &coloured[..i], coloured[i]));
    }
}

/// An impulse becomes λ_i − Σ a_p λ_{i−p}: the sign that (9) prints is wrong.
#[test]
fn impulse_spreads_with_a_minus() {
    let mut whitened = [0.0; 4];
    whiten(
        &[-1.5365, -0.75056],
        &[1.0, 0.0, 0.0, 0.0],
        0,
        &mut whitened,
    );
    assert_eq!(whitened, [1.0, 1.5365, 0.75056, 0.0]);
    let mut step_response = [0.0; 5];
    whiten(&[-1.5365, -0.75056], &[1.0; 5], 0, &mut step_response);
    assert!((step_response[4] - Sensor::adxl105().step_gain()).abs() < 1e-15);
}

#[test]
fn refusals() {
    let new = |order, fit, training| Whitening::new(order, fit, training, false, 2);
    assert_eq!(new(0, Fit::Burg, 10), Err(WhiteningError::NoOrder));
    assert!(new(2, Fit::LeastSquares, 4).is_err());
    assert!(new(2, Fit::LeastSquares, 5).is_ok());
    assert!(new(1, Fit::Known, 0).is_err());
    assert_eq!(new(2, Fit::Known, 256).unwrap().training, 0);
    let auto = |fit, training| Whitening::new(Order::Auto, fit, training, false, 2);
    assert!(auto(Fit::Burg, 4).is_err());
    assert_eq!(auto(Fit::Burg, 5).unwrap().highest_order(), 1);
    for fit in [Fit::Known, Fit::None] {
        assert_eq!(auto(fit, 256), Err(WhiteningError::NothingToChoose(fit)));
    }
}

/// Side by side or alone, a record gets the filter of the order chosen for it, zeros behind.
#[test]
fn each_record_gets_the_order_chosen_for_it() {
    let records: [Vec<f64>; LANES] = std::array::from_fn(|lane| match lane {
        0 => vec![0.1; 60],
        1 => record(&[], 60, 10),
        2 => record(&[0.7], 60, 11),
        _ => record(&[-1.5365, -0.75056], 60, 9 + lane as u64),
    });
    let together: Vec<Wide> = (0..60)
        .map(|i| Wide(std::array::from_fn(|lane| records[lane][i])))
        .collect();
    for method in FITS {
        let auto = Whitening::new(Order::Auto, method, 60, false, 2).unwrap();
        let mut fitter = Fitter::<Wide>::new(auto, &[]);
        for _ in 0..2 {
            let fitted = fitter.fit(&together);
            for (lane, record) in records.iter().enumerate() {
                let mut expected = Chosen::new(record, 8, method).unwrap().coefficients;
                expected.resize(8, 0.0);
                let got: Vec<f64> = fitted.iter().map(|a| a.0[lane]).collect();
                assert_eq!(got, expected, "{method}, record {lane}");
            }
        }
    }
}
