//! Which way is up, by gravity, by the ride, or as the user says.

use super::*;
use std::f64::consts::PI;

/// Gravity shows which way is up, for either sign of the sensor's axis.
#[test]
fn down_is_turned_up() {
    let recording = open("time,x,y,z\n0.00,0,0,-9.75\n0.01,0,0,-10\n0.02,0,0,-9.5\n");
    assert_eq!(read(&recording), [(0.0, 9.75), (0.01, 10.0), (0.02, 9.5)]);
    assert_eq!(
        recording.vertical().to_string(),
        "projected on (0.00, 0.00, -1.00), the direction of gravity"
    );
    let recording = open("time,acceleration (g)\n0.00,-1\n0.01,-1.25\n0.02,-1\n");
    assert!(recording.facts().has_gravity);
    assert!((recording.facts().greatest - 1.25 * 9.80665).abs() < 1e-12);
}

#[test]
fn the_user_chooses_an_axis_and_its_sign() {
    let text = "time,x,y,z\n0,1,2,3\n0.01,2,3,5\n0.02,1,2,4\n";
    let read_as = |axis: &str, invert| {
        let reading = Reading {
            axis: axis.parse().unwrap(),
            invert,
            ..Reading::default()
        };
        let recording = open_as(text, &reading);
        (read(&recording)[1].1, recording.vertical().to_string())
    };
    assert_eq!(read_as("x", false), (2.0, "x (as given)".into()));
    assert_eq!(read_as("-y", false), (-3.0, "-y (as given)".into()));
    assert_eq!(read_as("-y", true), (3.0, "y (as given)".into()));
    let (z, text) = read_as("auto", true);
    assert_eq!(z, -5.0);
    assert_eq!(text, "-z; no axis carries a ride (--axis x, y or z)");
}

/// 45° between y and z: neither axis is vertical.
#[test]
fn tilted_axes_are_projected() {
    let half = 9.8 / 2f64.sqrt();
    let row = |i: i32| {
        format!(
            "{},0,{},{}\n",
            0.01 * f64::from(i),
            half,
            half + f64::from(i % 2)
        )
    };
    let rows: String = (0..200).map(row).collect();
    let text = format!("time,x,y,z\n{rows}");
    let recording = open(&text);
    assert_eq!(recording.acceleration_columns(), ["x", "y", "z"]);
    assert!(
        (recording.facts().mean - 10.16).abs() < 0.01,
        "{}",
        recording.facts().mean
    );
    // Axes in different rows cannot be projected.
    let apart = |i: i32| match i % 2 {
        0 => format!("{},0,{half},\n", 0.01 * f64::from(i)),
        _ => format!(
            "{},,,{}\n",
            0.01 * f64::from(i),
            half + 0.1 * f64::from(i % 4)
        ),
    };
    let rows: String = (0..200).map(apart).collect();
    let recording = open(&format!("time,x,y,z\n{rows}"));
    let is_tilted = |warning: &Warning| matches!(warning, Warning::Tilted { from } if *from > 30.0);
    assert!(recording.warnings().iter().any(is_tilted));
}

/// A ride before a phone without gravity that is turned by so many degrees from z to y.
fn ride_at(degrees: f64, gravity: f64) -> String {
    let angle = degrees.to_radians();
    let row = |i: u32| {
        let pulse = |from: u32| 0.6 * (PI * f64::from(i - from) / 200.0).sin();
        let ride = match i {
            500..700 => pulse(500),
            1100..1300 => -pulse(1100),
            _ => 0.0,
        };
        let noise = |n: u32| f64::from(n.wrapping_mul(2_654_435_761) >> 16) / 65536.0 - 0.5;
        let [x, y, z] = [0, 1, 2].map(|axis| 0.05 * noise(3 * i + axis));
        let up = gravity + ride;
        format!(
            "{},{x},{},{}\n",
            0.01 * f64::from(i),
            y + angle.sin() * up,
            z + angle.cos() * up
        )
    };
    let rows: String = (0..2000).map(row).collect();
    format!("time,x,y,z\n{rows}")
}

/// An axis that is chosen and is not the vertical: said with by how much, and what to do; by pulses as by gravity.
#[test]
fn a_tilt_is_said() {
    for (degrees, gravity) in [
        (0.0, 0.0),
        (10.0, 0.0),
        (24.0, 0.0),
        (40.0, 0.0),
        (30.0, 9.8),
    ] {
        let reading = Reading {
            axis: "z".parse().unwrap(),
            ..Reading::default()
        };
        let recording = open_as(&ride_at(degrees, gravity), &reading);
        let warnings = recording.warnings().iter();
        let tilts: Vec<String> = warnings
            .filter(|warning| matches!(warning, Warning::TiltedAxis { .. }))
            .map(ToString::to_string)
            .collect();
        assert_eq!(
            tilts.len(),
            usize::from(degrees > 15.0),
            "{degrees}: {tilts:?}"
        );
        assert!(
            !tilts.iter().any(|tilt| !tilt.contains("(leave out --axis")),
            "{tilts:?}"
        );
        if degrees == 24.0 {
            let text = "the sensor is tilted: the vertical lies 24 degrees from z, as pulses along all three axes show, so \
                        that speeds and distances are 9 % too small";
            assert!(tilts[0].starts_with(text), "{}", tilts[0]);
        }
        // All three are turned, and nothing is lost.
        let all = open(&ride_at(degrees, gravity));
        let is_tilt = |warning: &Warning| {
            matches!(warning, Warning::Tilted { .. } | Warning::TiltedAxis { .. })
        };
        assert!(!all.warnings().iter().any(is_tilt));
    }
}

/// Steps of 18 mg, tilted: what is projected lies on no grid, but each axis does, and adds its part of a step.
#[test]
fn coarse_axes_are_known_in_any_pose() {
    const STEP: f64 = 0.1765;
    let up = [0.6, 0.0, 0.8];
    let row = |i: u32| {
        let pulse = |from: u32| 0.6 * (PI * f64::from(i - from) / 200.0).sin();
        let ride = match i {
            500..700 => pulse(500),
            1100..1300 => -pulse(1100),
            _ => 0.0,
        };
        let noise = f64::from(i.wrapping_mul(2_654_435_761) >> 16) / 65536.0;
        let reads = up.map(|up| ((9.7 + ride + 0.03 * noise) * up / STEP).round() * STEP);
        let [x, y, z] = reads;
        format!("{},{x},{y},{z}\n", 0.01 * f64::from(i))
    };
    let rows: String = (0..2000).map(row).collect();
    let recording = open(&format!("time,x,y,z\n{rows}"));
    let step = recording.facts().coarse_step.unwrap();
    assert!((step / STEP - 1.0).abs() < 0.01, "{step}");
}

/// A pulse along y, shaking along x that averages out, and handling at the end that moves all axes.
#[test]
fn the_axis_with_the_ride() {
    let row = |i: i32| {
        let time = 0.01 * f64::from(i);
        let pulse = if (300..500).contains(&i) { 0.5 } else { 0.0 };
        let hand = if i >= 1800 { 4.0 } else { 0.0 };
        let shaking = f64::from(i % 2) * 3.0;
        format!(
            "{time},{},{},{}\n",
            shaking + hand,
            pulse - hand,
            0.01 + hand
        )
    };
    let rows: String = (0..2000).map(row).collect();
    let recording = open(&format!("time,x,y,z\n{rows}"));
    let [x, y, z] = recording.vertical().up;
    assert_eq!(recording.vertical().column, None);
    assert!(x.abs() < 1e-6 && y > 0.999 && z.abs() < 1e-6, "{x} {y} {z}");
    assert!(!recording.vertical().is_sign_known);
    assert_eq!(recording.vertical().reason, Reason::Pulses);
}

#[test]
fn rest_is_along_z() {
    let row = |i: i32| {
        format!(
            "{},{},0,{}\n",
            0.01 * f64::from(i),
            0.01 * f64::from(i % 3),
            i % 2
        )
    };
    let rows: String = (0..500).map(row).collect();
    let recording = open(&format!("time,x,y,z\n{rows}"));
    assert_eq!(recording.acceleration_columns(), ["z"]);
    assert_eq!(recording.vertical().reason, Reason::Nothing);
    assert!(matches!(recording.warnings()[0], Warning::Vertical(_)));
}

/// Turned from flat to upright at rest: the acceleration stays that of gravity, without a step.
#[test]
fn a_turned_phone_is_followed() {
    let row = |i: i32| {
        let share = (f64::from(i - 3000) / 200.0).clamp(0.0, 1.0);
        let angle = share * std::f64::consts::FRAC_PI_2;
        let noise = 0.01 * f64::from(i % 3);
        let (y, z) = (9.8 * angle.sin() + noise, 9.8 * angle.cos() + noise);
        format!("{},0,{y},{z}\n", 0.01 * f64::from(i))
    };
    let rows: String = (0..8000).map(row).collect();
    let recording = open(&format!("time,x,y,z\n{rows}"));
    let samples = read(&recording);
    let is_still = |time: f64| !(25.0..37.0).contains(&time);
    for (time, a) in samples.iter().filter(|(time, _)| is_still(*time)) {
        assert!((a - 9.81).abs() < 0.02, "{a} at {time} s");
    }
    let step = samples.windows(2).map(|pair| (pair[1].1 - pair[0].1).abs());
    assert!(step.fold(0.0, f64::max) < 0.2);
    assert!(
        matches!(recording.warnings(), [Warning::Vertical(_)]),
        "{:?}",
        recording.warnings()
    );
    let text = recording.vertical().to_string();
    assert!(
        text.contains("which turns by 90 degrees and is followed"),
        "{text}"
    );
}
