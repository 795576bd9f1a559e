//! The three axes of a sensor, against its data sheet.

use super::building::{building, quiet};
use super::drive;
use crate::lift::{Accelerometer, Pickup, Ride};
use crate::recording::GRAVITY;
use crate::stats::chi_squared;
use serde_json::json;

/// The up vector, turned by matrices: about y, then about x.
fn up(roll_deg: f64, pitch_deg: f64) -> [f64; 3] {
    let [(sr, cr), (sp, cp)] = [roll_deg, pitch_deg].map(|angle: f64| angle.to_radians().sin_cos());
    let about_y = [[cp, 0.0, -sp], [0.0, 1.0, 0.0], [sp, 0.0, cp]];
    let about_x = [[1.0, 0.0, 0.0], [0.0, cr, sr], [0.0, -sr, cr]];
    let turn = |matrix: [[f64; 3]; 3], v: [f64; 3]| {
        matrix.map(|row| row.iter().zip(v).map(|(a, b)| a * b).sum())
    };
    turn(about_x, turn(about_y, [0.0, 0.0, 1.0]))
}

fn read(ride: &Ride, axes: &[Pickup; 3]) -> [Vec<f64>; 3] {
    let axis = |i: usize| ride.simulate(&axes[i], 1, i as u64).record;
    [0, 1, 2].map(axis)
}

/// Projected on the vertical the axes give what one vertical axis reads, people included and the doors not: to 1e-8 m/s²,
/// a hundred deviations of what noise is left. Their square sums to that of the whole, doors included.
#[test]
fn any_pose_has_the_same_vertical() {
    let (ride, _) = building(json!({ "journeys": { "random": 3 } }))
        .ride(drive(1.6, 1.0, 1.5), 100.0, 1)
        .unwrap();
    let vertical = ride.simulate(&Pickup::white(1e-12), 1, 0).record;
    let across = Pickup {
        cosine: 0.0,
        across: 1.0,
        ..Pickup::white(1e-12)
    };
    let across = ride.simulate(&across, 1, 0).record;
    assert!(across.iter().any(|a| a.abs() > 0.05), "doors knock");
    for (roll, pitch) in [(0.0, 0.0), (20.0, -35.0), (180.0, 0.0), (-77.0, 88.0)] {
        let pose = json!({ "pose": { "roll_deg": roll, "pitch_deg": pitch } });
        let axes = quiet(pose).axes(100.0, 0.0, 1).unwrap();
        let [x, y, z] = read(&ride, &axes);
        let up = up(roll, pitch);
        for i in 0..vertical.len() {
            let projected = x[i] * up[0] + y[i] * up[1] + z[i] * up[2] - GRAVITY;
            assert!((projected - vertical[i]).abs() < 1e-8, "{roll} {pitch} {i}");
            let square = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
            let whole = (GRAVITY + vertical[i]).powi(2) + across[i].powi(2);
            assert!((square - whole).abs() < 1e-6, "{roll} {pitch} {i}");
        }
    }
}

/// Whether n squares of deviation `sigma` sum to what χ² allows but for 3e-8 at either end: 15 checks in all, 9e-7.
fn check_deviation(what: &str, values: impl Iterator<Item = f64> + Clone, sigma: f64) {
    let n = values.clone().count();
    let square: f64 = values.map(|x| x * x / (sigma * sigma)).sum();
    let p = chi_squared::upper_tail(square, n);
    println!("{what}: n = {n}, χ² = {square:.1}, p = {p:.3}");
    assert!((3e-8..1.0 - 3e-8).contains(&p), "{what}");
}

/// One-sided: white noise of density n has n²·f/2 within the band of f/2 Hz that samples at f show.
#[test]
fn noise_has_the_density_of_the_data_sheet() {
    let ride = Ride::still(200.0, 100.0).unwrap();
    for (model, density) in [
        ("phone", 180e-6),
        ("mpu6050", 400e-6),
        ("lis302dl", 218e-6),
        ("adxl105", 225e-6),
    ] {
        let keys = json!({ "model": model, "step": 0.0, "offset": [10.0, -20.0, 30.0] });
        let sensor: Accelerometer = serde_json::from_value(keys).unwrap();
        let axes = sensor.axes(200.0, 0.0, 1).unwrap();
        let level = [0.010, -0.020, 1.030].map(|g| g * GRAVITY);
        let sigma = density * GRAVITY * 10.0;
        for (axis, level) in read(&ride, &axes).iter().zip(level) {
            check_deviation(model, axis.iter().map(|a| a - level), sigma);
        }
    }
}

/// The increments of the bias are independent, and a hundred of them in a second have the variance of a second.
#[test]
fn the_bias_walks() {
    let axes = quiet(json!({ "bias_walk": 50.0 }))
        .axes(100.0, 0.0, 1)
        .unwrap();
    let [x, ..] = read(&Ride::still(100.0, 100.0).unwrap(), &axes);
    let steps = x.windows(2).map(|pair| pair[1] - pair[0]);
    check_deviation("steps", steps, 50e-6 * GRAVITY / 10.0);
    let seconds: Vec<f64> = x.iter().step_by(100).copied().collect();
    let walked = seconds.windows(2).map(|pair| pair[1] - pair[0]);
    check_deviation("seconds", walked, 50e-6 * GRAVITY);
}

/// (1 + ε)(g + a)·up, then the offset.
#[test]
fn gain_errors_scale_gravity_and_motion() {
    let keys = json!({ "gain_error": [0.01, 0.0, -0.02], "offset": [0.0, 40.0, 5.0], "pose": { "roll_deg": 60.0 } });
    let axes = quiet(keys).axes(100.0, 0.0, 1).unwrap();
    let [x, y, z] = axes.clone().map(|axis| (axis.bias / GRAVITY, axis.cosine));
    let sine = 60f64.to_radians().sin();
    for ((bias, cosine), (expected_bias, expected_cosine)) in [
        (x, (0.0, 0.0)),
        (y, (sine + 0.040, sine)),
        (z, (0.98 * 0.5 + 0.005, 0.98 * 0.5)),
    ] {
        assert!((bias - expected_bias).abs() < 1e-12);
        assert!((cosine - expected_cosine).abs() < 1e-12);
    }
    assert!((axes[0].across - 1.01).abs() < 1e-12);
}

#[test]
fn steps_and_limits_are_those_of_the_data_sheet() {
    let (ride, _) = building(json!({ "journeys": [0, 2], "doors": 100.0 }))
        .ride(drive(1.6, 1.0, 1.5), 100.0, 1)
        .unwrap();
    for (model, step) in [("lis302dl", 0.018), ("mpu6050", 1.0 / 16384.0)] {
        let keys = json!({ "model": model });
        let sensor: Accelerometer = serde_json::from_value(keys).unwrap();
        let axes = sensor.axes(100.0, 0.02, 1).unwrap();
        let record = read(&ride, &axes).concat();
        for a in &record {
            let steps = a / (step * GRAVITY);
            assert!((steps - steps.round()).abs() < 1e-6, "{model}: {a}");
            assert!(a.abs() <= 2.0 * GRAVITY + 1e-9, "{model}: {a}");
        }
        let most = record.iter().fold(0.0, |most: f64, a| most.max(a.abs()));
        assert!(
            most > (2.0 - step) * GRAVITY - 1e-9,
            "{model} is driven to its limit"
        );
    }
}

/// Offsets are drawn within the sheet's limits, by the seed.
#[test]
fn offsets_and_records_depend_on_the_seed_alone() {
    let sensor: Accelerometer = serde_json::from_value(json!({ "model": "mpu6050" })).unwrap();
    let axes = |seed| sensor.axes(200.0, 0.02, seed).unwrap();
    let biases = |seed| axes(seed).map(|axis| axis.bias / GRAVITY);
    for seed in 0..200 {
        let [x, y, z] = biases(seed);
        assert!(x.abs() <= 0.05 && y.abs() <= 0.05 && (z - 1.0).abs() <= 0.08);
    }
    assert!((0..200).any(|seed| (biases(seed)[2] - 1.0).abs() > 0.07));
    let made = |seed| {
        let of = building(json!({ "journeys": { "random": 2 } }));
        let (ride, stops) = of.ride(drive(1.6, 1.0, 1.5), 200.0, seed).unwrap();
        (read(&ride, &axes(seed)), ride.clock(1e-3, seed), stops)
    };
    assert!(made(3) == made(3));
    assert!(made(3) != made(4));
}

/// Times stray by their deviation, and increase whatever it is.
#[test]
fn jitter_moves_the_times() {
    let ride = Ride::still(100.0, 100.0).unwrap();
    let strays = |jitter| {
        let times = ride.clock(jitter, 1);
        assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
        let exact = (0..).map(|i| (f64::from(i) + 0.5) / 100.0);
        let strays: Vec<f64> = times.iter().zip(exact).map(|(a, b)| a - b).collect();
        strays
    };
    assert!(strays(0.0).iter().all(|stray| *stray == 0.0));
    // Cut off at eight deviations, where there is none.
    check_deviation("jitter", strays(5e-4).into_iter(), 5e-4);
    assert!(strays(1.0).iter().all(|stray| stray.abs() <= 4e-3 + 1e-12));
}
