//! The filter of the paper is a linear one; what it does at floors; and the slow height.

use super::*;
use crate::rng::{self, Stream};
use crate::track::Uncertain;

fn fusion(adapts: Adapts) -> Fusion {
    Fusion {
        adapts,
        ..Fusion::of(0.25)
    }
}

/// Without floors sigma points give what the Kalman filter gives, whatever Q does.
#[test]
fn unscented_is_linear() {
    for adapts in [Adapts::Never, Adapts::Printed, Adapts::Mended] {
        let fusion = fusion(adapts);
        let mut draws = Stream::new(1, "test", "").at(0);
        let mut position = Position::new(fusion, &[]);
        let (mut mean, mut variance) = (0.0f64, 0.0f64);
        for step in 0..10_000 {
            let [by, off] = [(); 2].map(|()| rng::unit(&mut draws) - 0.5);
            // Back to where it began, so that rounding stays small.
            let by = by - 0.5 * mean;
            let q = position.process;
            position.predict(by, 0.01, step % 3 == 0);
            mean += by;
            variance += 0.01 * q;
            assert!((position.mean - mean).abs() < 1e-12, "{step}");
            assert!((position.variance - variance).abs() < 1e-12, "{step}");
            position.measure(mean + off, 0.01);
            let gain = variance / (variance + fusion.noise);
            mean += gain * off;
            variance *= 1.0 - gain;
        }
    }
}

/// As printed Q grows on half of the readings of a filter that is right; with the noise in it on 4.6 % of them.
#[test]
fn adaptive_noise() {
    let growths = |adapts| {
        let mut draws = Stream::new(2, "test", "").at(0);
        let mut position = Position::new(fusion(adapts), &[]);
        let mut grown = 0;
        for _ in 0..40_000 {
            position.predict(0.0, 0.025, false);
            // The filter as it is without: Q is put back after each reading.
            position.process = position.fusion.process;
            let noise: f64 = (0..12).map(|_| rng::unit(&mut draws)).sum::<f64>() - 6.0;
            position.measure(0.25 * noise, 0.025);
            grown += u32::from(position.process > position.fusion.process);
        }
        f64::from(grown) / 40_000.0
    };
    let (printed, mended) = (growths(Adapts::Printed), growths(Adapts::Mended));
    assert!(printed > 0.5, "{printed}");
    assert!((0.035..0.055).contains(&mended), "{mended}");
}

#[test]
fn floors() {
    let mut position = Position::new(fusion(Adapts::Never), &[0.0, 4.0, 8.0]);
    position.predict(3.8, 1.0, false);
    assert_eq!(position.height(), 3.8);
    assert!(!position.is_abnormal());
    position.predict(0.0, 1.0, true);
    assert!((position.height() - 4.0).abs() < 1e-12);
    position.predict(1.9, 1.0, false);
    assert!(position.is_abnormal());
    position.predict(0.0, 1.0, true);
    assert!((position.height() - 5.9).abs() < 1e-12);
}

#[test]
fn the_reference_is_what_is_read_less_the_height() {
    let mut reference = Reference::default();
    assert_eq!(reference.altitude(), None);
    for at in 0..400 {
        let time = f64::from(at) / 40.0;
        reference.rest(time, 120.0 + 0.01 * f64::from(at % 2));
    }
    reference.leave(20.0);
    assert!((reference.altitude().unwrap() - 100.005).abs() < 1e-3);
    // A rest of less than a window says nothing.
    reference.rest(20.0, 500.0);
    reference.leave(20.0);
    assert!((reference.altitude().unwrap() - 100.005).abs() < 1e-3);
}

/// The variance is true whatever the weather, and in steady weather far less than that of the trips. A sum of squares of 200
/// normal variables over their variance is between 115 and 316 but once in a million.
#[test]
fn a_slow_height_knows_how_well_it_knows() {
    let usual = Drift::default();
    let steady = Drift {
        rate: usual.rate / 20.0,
        ..usual
    };
    for drift in [usual, steady] {
        let [squares, of_trips] = errors(drift);
        assert!((115.0..316.0).contains(&squares), "{drift:?}: {squares}");
        let gain = if drift == steady { 3.0 } else { 1.0 };
        assert!(of_trips > gain * squares, "{drift:?}: {of_trips}");
    }
}

/// The squares of the errors after 40 trips, in 200 weathers, and of those of the trips alone, in stated variances.
fn errors(drift: Drift) -> [f64; 2] {
    let mut errors = [0.0; 2];
    for trial in 0..200 {
        let mut draws = Stream::new(3, "test", "").at(trial);
        let mut normal = || (0..12).map(|_| rng::unit(&mut draws)).sum::<f64>() - 6.0;
        let rate = drift.rate * normal();
        let error = |deviation: f64, mean: f64| Uncertain {
            mean,
            variance: deviation * deviation,
        };
        let (mut truth, mut sum, mut time) = (0.0, 0.0, 0.0);
        let mut slow = SlowHeight::new(drift);
        slow.read(error(0.1, 0.1 * normal()));
        for trip in 0..40 {
            let distance = if trip % 2 == 0 { 12.0 } else { -12.0 };
            truth += distance;
            time += 60.0;
            let measured = distance + 0.05 * normal();
            sum += measured;
            slow.travel(error(0.05, measured), 60.0);
            slow.read(error(0.1, truth + rate * time + 0.1 * normal()));
        }
        let Uncertain { mean, variance } = slow.position();
        for (error, found) in errors.iter_mut().zip([mean, sum]) {
            *error += (found - truth) * (found - truth) / variance;
        }
    }
    errors
}

/// Two steps are one, also of a drift that changes on the way.
#[test]
fn a_drift_in_two_steps_is_that_in_one() {
    let begun = || {
        let mut slow = SlowHeight::new(Drift::default());
        slow.read(Uncertain {
            mean: 3.0,
            variance: 0.01,
        });
        slow
    };
    let still = |seconds: f64, slow: &mut SlowHeight| slow.travel(Uncertain::default(), seconds);
    for seconds in [30.0, 3600.0, 30_000.0] {
        let (mut one, mut two) = (begun(), begun());
        still(seconds, &mut one);
        still(0.3 * seconds, &mut two);
        still(0.7 * seconds, &mut two);
        let read = Uncertain {
            mean: 5.0,
            variance: 0.04,
        };
        let floor = Uncertain {
            mean: 0.0,
            variance: 1e-4,
        };
        for slow in [&mut one, &mut two] {
            slow.stand(floor);
            slow.read(read);
            slow.travel(read, seconds);
            slow.read(read);
        }
        let [one, two] = [one, two].map(|it| it.position());
        assert!((one.mean - two.mean).abs() < 1e-6, "{one:?} {two:?}");
        assert!(
            (one.variance / two.variance - 1.0).abs() < 1e-6,
            "{one:?} {two:?}"
        );
    }
}
