//! Recordings of real lifts, from the folder named by `LIFTSIM_RECORDINGS`.

use super::*;
use std::env;
use std::path::PathBuf;

fn folder() -> Option<PathBuf> {
    let folder = env::var_os("LIFTSIM_RECORDINGS").map(PathBuf::from);
    if folder.is_none() {
        println!("skipped: LIFTSIM_RECORDINGS names no folder");
    }
    folder
}

/// Name, rate, whether the axis is found by a clear lead.
const WITHOUT_GRAVITY: [(&str, f64, bool); 6] = [
    ("midterm/floor_up.csv", 99.4, true),
    ("midterm/floor_down.csv", 99.4, true),
    ("midterm/floor_up_then_down.csv", 99.4, true),
    ("midterm/floor_rest_on_table.csv", 99.4, false),
    ("midterm/iphone12mini_up.csv", 100.8, true),
    ("midterm/note20_down_highpassed.csv", 210.6, true),
];

#[test]
fn phyphox_without_gravity() {
    let Some(folder) = folder() else { return };
    for (name, rate, is_clear) in WITHOUT_GRAVITY {
        let recording = Recording::open(&folder.join(name), &Reading::default()).unwrap();
        let facts = recording.facts();
        println!("{name}: {}\n{facts:?}", recording.vertical());
        assert_eq!(recording.format(), Format::Phyphox);
        assert_eq!(
            recording.acceleration_columns(),
            ["Linear Acceleration z (m/s^2)"],
            "{name}"
        );
        assert_eq!(recording.unit(), Unit::MetresPerSecondSquared);
        // The rates are stated to one digit.
        assert!((facts.rate - rate).abs() < 0.05, "{name}: {}", facts.rate);
        assert!(facts.jitter < 1e-3 && facts.gaps == 0);
        assert_eq!((facts.quantum, facts.saturated), (None, None), "{name}");
        assert!(!facts.has_gravity);
        // The smallest lead of the five, 11.8, is that of the record with people moving.
        let lead = match recording.vertical().reason {
            Reason::Ride(lead) => lead,
            _ => 1.0,
        };
        assert_eq!(lead > 8.0, is_clear, "{name}: {lead}");
        assert_eq!(recording.warnings().len(), usize::from(!is_clear), "{name}");
        assert_eq!(read(&recording).len() as u64, facts.samples);
    }
}

#[test]
fn science_journal_with_gravity() {
    let Some(folder) = folder() else { return };
    let path = folder.join("elevator-tool/skyscrapper_up.csv");
    let recording = Recording::open(&path, &Reading::default()).unwrap();
    let facts = recording.facts();
    println!("{}\n{facts:?}", recording.vertical());
    assert_eq!(recording.format(), Format::ScienceJournal);
    assert_eq!(
        recording.time_column(),
        ("relative_time", TimeUnit::Milliseconds)
    );
    assert_eq!(recording.acceleration_columns(), ["AccZ"]);
    assert!(matches!(recording.vertical().reason, Reason::Gravity(angle) if angle < 10.0));
    assert!(facts.has_gravity && facts.saturated.is_none());
    assert!((facts.rate - 50.0).abs() < 0.1);
    assert!((0.15..0.17).contains(&facts.jitter));
    assert!((facts.quantum.unwrap() - 0.00119).abs() < 1e-5);
    let is_uneven = |warning: &Warning| matches!(warning, Warning::Uneven { .. });
    assert!(recording.warnings().iter().any(is_uneven));
}

/// On a grid of 50 Hz the uneven record keeps its mean, and its gaps.
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
