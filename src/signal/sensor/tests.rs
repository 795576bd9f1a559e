//! Sensors against closed forms, and their refusals.

use super::*;

/// (2) follows from (1): 1.5365 and 0.75056 as printed, 1.536538 and 0.750563 to six digits.
#[test]
fn transfer_gives_the_printed_coefficients() {
    let sensor = Sensor::from_transfer(Transfer {
        a: 2.2e-10,
        b: 1.01e-6,
        c: 0.4,
        period: 6.25e-5,
    })
    .unwrap();
    assert!((sensor.ar()[0] + 1.536538).abs() < 5e-7, "{sensor:?}");
    assert!((sensor.ar()[1] + 0.750563).abs() < 5e-7, "{sensor:?}");
    for (exact, printed) in sensor.ar().iter().zip(Sensor::adxl105().ar()) {
        assert!((exact - printed).abs() < 5e-5);
    }
    assert!((Sensor::adxl105().step_gain() - 3.28706).abs() < 1e-12);
}

/// Impulse invariance means the continuous impulse response at kT₀: e^{−σt} sin ωt.
#[test]
fn transfer_samples_the_impulse_response() {
    let (a, b, c, period) = (1.0, 0.6, 4.0, 0.3);
    let sensor = Sensor::from_transfer(Transfer { a, b, c, period }).unwrap();
    let (decay, frequency) = (0.3, (4.0f64 - 0.09).sqrt());
    let sampled = |k: usize| {
        let t = k as f64 * period;
        (-decay * t).exp() * (frequency * t).sin()
    };
    for k in 2..40 {
        let predicted = sensor.step(&[sampled(k - 2), sampled(k - 1)], 0.0);
        assert!((predicted - sampled(k)).abs() < 1e-14, "{k}");
    }
}

#[test]
fn step_and_colour_agree() {
    for ar in [
        vec![],
        vec![0.5],
        vec![-1.5365, -0.75056],
        vec![0.2, 0.1, -0.3],
    ] {
        let sensor = Sensor::from_ar(ar).unwrap();
        let white: Vec<f64> = (0..50).map(|i| f64::from(i * 37 % 11) - 5.0).collect();
        let mut batch = white.clone();
        sensor.colour(&mut batch);
        let mut record: Vec<f64> = Vec::new();
        for innovation in white {
            record.push(sensor.step(&record, innovation));
        }
        for (a, b) in batch.iter().zip(&record) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }
}

/// |pole|² = 0.75056, so the missing variance falls by that factor per sample: 1e-9 takes about 72 samples.
#[test]
fn burn_in_follows_from_the_poles() {
    let burn_in = Sensor::adxl105().burn_in();
    assert!((68..78).contains(&burn_in), "{burn_in}");
    assert_eq!(Sensor::from_ar(vec![]).unwrap().burn_in(), 0);
    assert!(Sensor::from_ar(vec![0.999]).unwrap().burn_in() > 10_000);
}

/// The start of a stationary record in closed form, as its response to each innovation alone: the
/// covariances of the first samples are the autocovariances that the recursion keeps, at every lag
/// r_k = Σ φ_p r_{k−p}, and at lag 0 with one more for the innovation.
#[test]
fn stationary_start_has_the_autocovariances() {
    for ar in [
        vec![],
        vec![0.5],
        vec![-1.5365, -0.75056],
        vec![0.2, 0.1, -0.3],
    ] {
        let sensor = Sensor::from_ar(ar.clone()).unwrap();
        let length = 8;
        let response = |innovation: usize| {
            let mut record = vec![0.0; length];
            record[innovation] = 1.0;
            sensor.colour_stationary(&mut record);
            record
        };
        let responses: Vec<Vec<f64>> = (0..length).map(response).collect();
        let covariance = |i: usize, j: usize| -> f64 {
            responses
                .iter()
                .map(|response| response[i] * response[j])
                .sum()
        };
        for i in 0..length {
            for j in 0..=i {
                let lag = i - j;
                assert!(
                    (covariance(i, j) - covariance(lag, 0)).abs() < 1e-12,
                    "{ar:?}"
                );
                let predicted: f64 = (1..=ar.len())
                    .map(|p| ar[p - 1] * covariance(lag.abs_diff(p), 0))
                    .sum();
                let innovation = if lag == 0 { 1.0 } else { 0.0 };
                assert!(
                    (covariance(i, j) - predicted - innovation).abs() < 1e-12,
                    "{ar:?}"
                );
            }
        }
    }
}

#[test]
fn refusals() {
    let unstable = |ar: &[f64]| Sensor::from_ar(ar.to_vec()).unwrap_err();
    assert!(matches!(
        unstable(&[1.0]),
        SensorError::Unstable { index: 1, .. }
    ));
    assert!(matches!(
        unstable(&[0.0, -1.2]),
        SensorError::Unstable { index: 2, .. }
    ));
    assert!(matches!(
        unstable(&[2.0, -0.5]),
        SensorError::Unstable { index: 1, .. }
    ));
    assert!(matches!(unstable(&[f64::NAN]), SensorError::NotFinite(_)));
    assert!(matches!(
        unstable(&[1.0 - 1e-9]),
        SensorError::BarelyStable { .. }
    ));
    let transfer = |a, b, c, period| Sensor::from_transfer(Transfer { a, b, c, period });
    assert!(matches!(
        transfer(1.0, 4.0, 4.0, 1.0),
        Err(SensorError::RealPoles { .. })
    ));
    assert!(matches!(
        transfer(1.0, -0.1, 4.0, 1.0),
        Err(SensorError::Unstable { .. })
    ));
    assert!(matches!(
        transfer(0.0, 1.0, 1.0, 1.0),
        Err(SensorError::NotPositive { name: "a", .. })
    ));
}
