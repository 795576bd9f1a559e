//! The record of the sensor.

use super::{LIFT, trip, two_trips};
use crate::lift::{Ending, Pickup, Ride};
use crate::signal::{Digitiser, Disturbance, During, Impulses, Law, Noise, Phase, Sensor};
use crate::stats::binomial;

/// With negligible noise the samples add up to the speed at their edges at every moment, and their double sum
/// to the distance, with an error of at most a period times the total variation of the speed, 0.04 m.
#[test]
fn samples_add_up_to_the_motion() {
    let ride = two_trips();
    let simulated = ride.simulate(&Pickup::white(1e-12), 1, 0);
    let h = 1.0 / ride.rate();
    let (mut speed, mut way) = (0.0, 0.0);
    for (i, a) in simulated.record.iter().enumerate() {
        let edge = (i as f64 + 0.5) * h;
        let expected: f64 = ride
            .started()
            .map(|(start, course)| course.speed_at(edge - start))
            .sum();
        speed += a * h;
        assert!((speed - expected).abs() < 1e-9, "{i}: {speed} {expected}");
        way += speed * h;
    }
    let net: f64 = ride.journeys().iter().map(|journey| journey.distance).sum();
    println!("way {way}, of the journeys {net}");
    assert!((way - net).abs() < 0.04);
}

/// Σ x² of n independent normals lies within n ± 5.5 √(2n) but for 1e-7 (at n of 1e6 the law is normal
/// to that); white noise's correlations within 5.5/√n. Six checks: 6e-7.
#[test]
fn white_noise_has_its_deviation() {
    let n = 1_000_000;
    let pickup = Pickup {
        bias: 9.81,
        ..Pickup::white(0.012)
    };
    let record = Ride::still(100.0, 10_000.0)
        .unwrap()
        .simulate(&pickup, 2014, 0)
        .record;
    assert_eq!(record.len(), n);
    let x: Vec<f64> = record.iter().map(|r| (r - 9.81) / 0.012).collect();
    for lag in 0..5 {
        let sum: f64 = x[lag..].iter().zip(&x).map(|(a, b)| a * b).sum();
        let (expected, variance) = if lag == 0 {
            (n as f64, 2.0)
        } else {
            (0.0, 1.0)
        };
        let z = (sum - expected) / (variance * n as f64).sqrt();
        println!("n = {n}, lag {lag}: z = {z:.2}");
        assert!(z.abs() < 5.5);
    }
    let z = x.iter().sum::<f64>() / (n as f64).sqrt();
    assert!(z.abs() < 5.5, "mean: z = {z}");
}

/// The first sample of coloured records over many of them: deviation and the correlation with the second
/// as those of the ADXL105 in closed form, for a law with an exact start and for one with a burn-in. Laplace's
/// kurtosis of 6 lets the mean square deviate by √(5/n) at most; 6 deviations, four checks: 1e-8.
#[test]
fn records_start_stationary() {
    let (phi_1, phi_2) = (-1.5365f64, -0.75056f64);
    let variance = (1.0 - phi_2) / ((1.0 + phi_2) * ((1.0 - phi_2).powi(2) - phi_1 * phi_1));
    let covariance = variance * phi_1 / (1.0 - phi_2);
    let n = 20_000;
    let ride = Ride::still(100.0, 0.02).unwrap();
    for law in [Law::Normal, Law::Laplace] {
        let pickup = Pickup {
            sensor: Sensor::adxl105(),
            noise: Noise::new(law).unwrap(),
            ..Pickup::white(1.0)
        };
        let (mut square, mut product) = (0.0, 0.0);
        for index in 0..n {
            let record = ride.simulate(&pickup, 2014, index).record;
            square += record[0] * record[0];
            product += record[0] * record[1];
        }
        let bound = 6.0 * variance * (5.0 / n as f64).sqrt();
        let (square, product) = (square / n as f64, product / n as f64);
        println!("{law:?}: {square:.3} for {variance:.3}, {product:.3} for {covariance:.3}");
        assert!((square - variance).abs() < bound);
        assert!((product - covariance).abs() < bound);
    }
}

/// In uniform motion at full speed the mean square is 1 + v² in σ², in n samples to 5.5 √(2/n) of it; at
/// rest 1. False failures: 1e-7.
#[test]
fn vibration_acts_in_motion() {
    let trip = trip(2000.0, LIFT, Ending::Commanded);
    let ride = Ride::new(100.0, vec![1000.0, 1000.0], vec![trip]).unwrap();
    let pickup = Pickup {
        vibration: 2.0,
        ..Pickup::white(0.5)
    };
    let simulated = ride.simulate(&pickup, 2014, 0);
    for stretch in &simulated.truth {
        let expected = match stretch.phase {
            Phase::Rest => 1.0,
            Phase::Inertial => 5.0,
            _ => continue,
        };
        let range = (stretch.from * 100.0) as usize + 1..(stretch.to * 100.0) as usize;
        let n = range.len() as f64;
        let energy: f64 = simulated.record[range].iter().map(|r| r * r * 4.0).sum();
        let z = (energy / n / expected - 1.0) / (2.0 / n).sqrt();
        println!("{:?}: n = {n}, z = {z:.2}", stretch.phase);
        assert!(z.abs() < 5.5);
    }
}

/// Rides that differ only in strength share their draws, so their difference shows the impulses.
#[test]
fn impulses_act_in_uniform_motion_alone() {
    let trip = trip(200.0, LIFT, Ending::Commanded);
    let ride = Ride::new(50.0, vec![3.0, 3.0], vec![trip]).unwrap();
    let quiet = Pickup::white(1.0);
    let knocked = Pickup {
        impulses: Impulses::new(0.3, 8.0, During::Inertial).unwrap(),
        ..quiet.clone()
    };
    let record = |pickup: &Pickup| ride.simulate(pickup, 2014, 0).record;
    let inertial = ride.truth()[2];
    let (mut hits, mut places, mut sum) = (0, 0, 0.0f64);
    for (i, (a, b)) in record(&knocked).iter().zip(record(&quiet)).enumerate() {
        let time = i as f64 / 50.0;
        let impulse = (a - b).round();
        sum += impulse;
        assert!(sum.abs() == 0.0 || sum.abs() == 8.0);
        if (inertial.from..inertial.to).contains(&time) {
            places += 1
        } else {
            assert_eq!(impulse, 0.0)
        }
        hits += u64::from(impulse != 0.0);
    }
    let tail = binomial::lower_tail(hits, places, 0.3).min(binomial::upper_tail(hits, places, 0.3));
    println!(
        "{hits} impulses in {places} samples at ν = 0.3, p = {:.3}",
        2.0 * tail
    );
    assert!(tail > 5e-7);
}

#[test]
fn digitised_records_are_whole_steps() {
    let quantum = 0.1;
    let pickup = Pickup {
        digitiser: Digitiser::new(Some(quantum / 0.02), Some(2.0 * 9.81 / 0.02)).unwrap(),
        bias: 9.81,
        ..Pickup::white(0.02)
    };
    let record = two_trips().simulate(&pickup, 2014, 0).record;
    let level = Pickup {
        cosine: 0.0,
        ..pickup.clone()
    };
    let level = two_trips().simulate(&level, 2014, 0).record;
    assert!(level.iter().all(|r| (r - 9.81).abs() < 0.3), "no motion");
    for r in &record {
        let steps = r / quantum;
        assert!((steps - steps.round()).abs() < 1e-9, "{r}");
        assert!(r.abs() <= 2.0 * 9.81);
    }
    let distinct: std::collections::BTreeSet<u64> = record.iter().map(|r| r.to_bits()).collect();
    assert!(distinct.len() < 100, "equal steps are equal numbers");
    // The jam's 31 m/s² meet the limit.
    assert!(record.iter().any(|r| (r - 196.0 * quantum).abs() < 1e-9));
}

#[test]
fn disturbances_act_throughout() {
    let ride = Ride::still(100.0, 10.0).unwrap();
    let quiet = Pickup::white(0.5);
    let drifting = Pickup {
        disturbance: Disturbance::new(0.0, 3.0, 0.0, 0.0).unwrap(),
        ..quiet.clone()
    };
    let (quiet, drifting) = (ride.simulate(&quiet, 1, 0), ride.simulate(&drifting, 1, 0));
    let pairs = quiet.record.iter().zip(&drifting.record);
    for (i, (a, b)) in pairs.enumerate() {
        assert!((a * 3.0 - b).abs() < 1e-12, "{i}");
    }
}

/// A change of these values changes results: say so in the CHANGELOG.
#[test]
fn golden_draws() {
    let pickup = Pickup {
        vibration: 2.5,
        impulses: Impulses::new(0.1, 4.0, During::Motion).unwrap(),
        disturbance: Disturbance::new(0.0, 1.0, 0.01, 5.0).unwrap(),
        ..Pickup::white(0.012)
    };
    let record = two_trips().simulate(&pickup, 2014, 3).record;
    let sum: f64 = record.iter().sum();
    assert_eq!(
        (record.len(), record[0], record[700], sum),
        (
            3377,
            -0.00448632563074493,
            0.3327867897469897,
            1.3182104836011537
        )
    );
}
