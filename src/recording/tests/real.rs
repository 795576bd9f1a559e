//! Recordings of real lifts and made ones, from the folder named by `LIFTSIM_LIFTS`.

use super::*;
use std::env;
use std::path::PathBuf;

fn folder() -> Option<PathBuf> {
    let folder = env::var_os("LIFTSIM_LIFTS").map(PathBuf::from);
    if folder.is_none() {
        println!("skipped: LIFTSIM_LIFTS names no folder");
    }
    folder
}

fn along(recording: &Recording) -> [f64; 3] {
    let vertical = recording.vertical();
    assert_eq!(vertical.column, None, "{vertical}");
    vertical.up
}

/// Name, rate, whether the pulses show the vertical.
const FLAT_WITHOUT_GRAVITY: [(&str, f64, bool); 7] = [
    ("midterm/floor_up.csv", 99.4, true),
    ("midterm/floor_down.csv", 99.4, true),
    ("midterm/floor_up_then_down.csv", 99.4, true),
    ("midterm/floor_rest_on_table.csv", 99.4, false),
    ("midterm/iphone12mini_up.csv", 100.8, true),
    ("midterm/long_brake_down.csv", 100.4, true),
    ("midterm/note20_down_highpassed.csv", 210.6, true),
];

#[test]
fn phyphox_without_gravity() {
    let Some(folder) = folder() else { return };
    for (name, rate, is_clear) in FLAT_WITHOUT_GRAVITY {
        let recording = Recording::open(&folder.join(name), &Reading::default()).unwrap();
        let facts = recording.facts();
        println!("{name}: {}\n{facts:?}", recording.vertical());
        assert_eq!(recording.format(), "phyphox");
        assert_eq!(recording.unit(), Unit::MetresPerSecondSquared);
        // The rates are stated to one digit.
        assert!((facts.rate - rate).abs() < 0.05, "{name}: {}", facts.rate);
        assert!(facts.jitter < 1e-3 && facts.gaps == 0);
        assert_eq!((facts.quantum, facts.saturated), (None, None), "{name}");
        assert!(!facts.has_gravity);
        assert!(!recording.vertical().is_sign_known);
        assert_eq!(read(&recording).len() as u64, facts.samples);
        if is_clear {
            // Phones lay flat, to 5 degrees.
            assert!(
                along(&recording)[2] > 0.996,
                "{name}: {}",
                recording.vertical()
            );
            assert_eq!(recording.warnings(), [], "{name}");
        } else {
            assert_eq!(recording.vertical().reason, Reason::Nothing, "{name}");
            assert!(matches!(recording.warnings(), [Warning::Vertical(_)]));
        }
    }
}

/// Tilted by 24 degrees from y to z.
#[test]
fn a_tilted_phone() {
    let Some(folder) = folder() else { return };
    let path = folder.join("midterm/tilted_down.csv");
    let recording = Recording::open(&path, &Reading::default()).unwrap();
    let [x, y, z] = along(&recording);
    let cosine = (0.92 * y + 0.40 * z) / 0.92f64.hypot(0.40);
    let angle = cosine.acos().to_degrees();
    assert!(angle < 3.0, "({x}, {y}, {z}), {angle} degrees off");
    let text = recording.vertical().to_string();
    assert!(
        text.ends_with("the direction of the pulses; up assumed along +y (--invert)"),
        "{text}"
    );
}

#[test]
fn science_journal_with_gravity() {
    let Some(folder) = folder() else { return };
    let path = folder.join("elevator-tool/skyscrapper_up.csv");
    let recording = Recording::open(&path, &Reading::default()).unwrap();
    let facts = recording.facts();
    println!("{}\n{facts:?}", recording.vertical());
    assert_eq!(recording.format(), "Science Journal");
    assert_eq!(
        recording.time_column(),
        ("relative_time", TimeUnit::Milliseconds)
    );
    assert_eq!(recording.acceleration_columns(), ["AccZ"]);
    assert!(matches!(recording.vertical().reason, Reason::Gravity { from, .. } if from < 10.0));
    assert!(facts.has_gravity && facts.saturated.is_none());
    assert!((facts.rate - 50.0).abs() < 0.1);
    assert!((0.15..0.17).contains(&facts.jitter));
    assert!((facts.quantum.unwrap() - 0.00119).abs() < 1e-5);
    let is_uneven = |warning: &Warning| matches!(warning, Warning::Uneven { .. });
    assert!(recording.warnings().iter().any(is_uneven));
}

/// On a grid of 25 Hz the uneven record keeps its mean, and its gaps.
#[test]
fn resampled() {
    let Some(folder) = folder() else { return };
    let path = folder.join("elevator-tool/skyscrapper_up.csv");
    let reading = Reading {
        resample: Some(25.0),
        ..Reading::default()
    };
    let recording = Recording::open(&path, &reading).unwrap();
    let samples = read(&recording);
    let facts = recording.facts();
    let expected = facts.duration() * 25.0;
    assert!(samples.len() as f64 > 0.95 * expected && samples.len() as f64 <= expected);
    let mean = samples.iter().map(|(_, a)| a).sum::<f64>() / samples.len() as f64;
    assert!((mean - facts.mean).abs() < 0.1, "{mean}");
}

/// Every made file of one ride is that ride, whatever it is written in: 5783 rows less those left out, with g
/// but for iOS, in which the mean is 0.
#[test]
fn every_made_format() {
    let Some(folder) = folder() else { return };
    let lost = [("nan_rows.csv", 116), ("hole_in_first_ride.csv", 300)];
    let with_rate = |name| Reading {
        rate: (name == "one_column.csv").then_some(100.0),
        ..Reading::default()
    };
    for name in [
        "arduino.txt",
        "date_times.csv",
        "decimal_commas_quoted.csv",
        "decimal_mixed.csv",
        "hole_in_first_ride.csv",
        "matlab_dates.csv",
        "millis.csv",
        "nan_rows.csv",
        "no_header.csv",
        "one_column.csv",
        "physics_toolbox_g.csv",
        "sensor_logger_ios.csv",
        "toa5.dat",
        "units_row.csv",
        "whole_second_stamps.csv",
        "witmotion.txt",
        "xsens.csv",
    ] {
        let path = folder.join("made").join(name);
        let recording = Recording::open(&path, &with_rate(name)).unwrap();
        let facts = recording.facts();
        let lost = lost
            .iter()
            .find(|(of, _)| *of == name)
            .map_or(0, |(_, lost)| *lost);
        assert_eq!(facts.samples, 5783 - lost, "{name}");
        assert!((facts.rate - 100.0).abs() < 0.5, "{name}: {}", facts.rate);
        assert!((facts.duration() - 57.82).abs() < 0.01, "{name}: {facts:?}");
        assert!(facts.start.abs() < 0.011, "{name}: {}", facts.start);
        let mean = if name == "sensor_logger_ios.csv" {
            0.0
        } else {
            9.806
        };
        assert!((facts.mean - mean).abs() < 0.02, "{name}: {}", facts.mean);
        assert!((facts.deviation - 0.153).abs() < 0.005, "{name}: {facts:?}");
        // The first ride goes up: it accelerates upwards around 8.5 s.
        let pulse = recording
            .samples()
            .iter()
            .filter(|s| (8.2..8.8).contains(&s.time));
        let pulse: Vec<f64> = pulse.map(|s| s.acceleration - facts.mean).collect();
        let mean = pulse.iter().sum::<f64>() / pulse.len() as f64;
        assert!(mean > 0.2, "{name}: {mean}");
    }
    let sheet = Recording::open(&folder.join("made/phyphox.xlsx"), &Reading::default()).unwrap();
    assert_eq!((sheet.format(), sheet.facts().samples), ("phyphox", 4057));
}

/// A phone flat on the floor reads the same along gravity as along its z axis, where it is exactly flat.
#[test]
fn flat_is_flat() {
    let Some(folder) = folder() else { return };
    let path = folder.join("made/physics_toolbox_g.csv");
    let open = |axis| {
        let reading = Reading {
            axis,
            ..Reading::default()
        };
        Recording::open(&path, &reading).unwrap()
    };
    let (projected, z) = (open(Axis::Auto), open("z".parse().unwrap()));
    for (a, b) in projected.samples().iter().zip(z.samples()) {
        assert!(
            (a.acceleration - b.acceleration).abs() < 1e-3,
            "{a:?} {b:?}"
        );
    }
}
