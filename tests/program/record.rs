//! `liftsim record`: files, refusals, and the example that ships.

use super::{liftsim, outcome, project};
use std::fs;
use std::path::Path;

fn record(directory: &Path, flags: &[&str]) -> (i32, String, String) {
    let mut command = liftsim();
    command.current_dir(directory).arg("record").args(flags);
    outcome(&mut command)
}

fn refused(flags: &[&str]) -> String {
    let directory = tempfile::tempdir().unwrap();
    let all = [&["--out", "ride.csv"], flags].concat();
    let (code, out, err) = record(directory.path(), &all);
    assert_eq!((code, out.as_str()), (2, ""), "{flags:?}: {err}");
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
    err
}

/// The files in `examples/` are what the program writes, twice the same, and says so.
#[test]
fn examples_are_up_to_date() {
    let directory = tempfile::tempdir().unwrap();
    let flags = ["--out", "ride.csv", "--seed", "1"];
    let (code, out, err) = record(directory.path(), &flags);
    assert_eq!((code, err.as_str()), (0, ""));
    assert_eq!(
        out,
        "ride.csv  6212 samples, 62.1 s at 100 Hz\nride.truth.csv  2 trips\n"
    );
    for name in ["ride.csv", "ride.truth.csv"] {
        let written = fs::read(directory.path().join(name)).unwrap();
        let shipped = fs::read(project().join("examples").join(name)).unwrap();
        assert!(
            written == shipped,
            "liftsim record --out examples/ride.csv --seed 1 --force"
        );
    }
}

#[test]
fn replaces_nothing_unasked() {
    let directory = tempfile::tempdir().unwrap();
    let flags = ["--out", "ride.csv", "--still", "--rest", "1"];
    assert_eq!(record(directory.path(), &flags).0, 0);
    let first = fs::read(directory.path().join("ride.csv")).unwrap();
    let other = [&flags[..], &["--seed", "2"]].concat();
    let (code, _, err) = record(directory.path(), &other);
    assert_eq!(code, 2);
    assert!(
        err.contains("ride.csv: is there already (give another name, or --force"),
        "{err}"
    );
    assert_eq!(fs::read(directory.path().join("ride.csv")).unwrap(), first);
    fs::remove_file(directory.path().join("ride.csv")).unwrap();
    let (code, _, err) = record(directory.path(), &other);
    assert_eq!(code, 2);
    assert!(err.contains("ride.truth.csv: is there already"), "{err}");
    let forced = [&other[..], &["--force"]].concat();
    assert_eq!(record(directory.path(), &forced).0, 0);
    assert_ne!(fs::read(directory.path().join("ride.csv")).unwrap(), first);
}

/// A jam, steps and gravity are in the files.
#[test]
fn flags_shape_the_ride() {
    let directory = tempfile::tempdir().unwrap();
    let flags = [
        "--out",
        "jam.csv",
        "--trip",
        "down:30:jam@9",
        "--trip",
        "up:3",
        "--rest",
        "1",
        "--rest",
        "2",
        "--rest",
        "3",
        "--speed",
        "2",
        "--rate",
        "50",
        "--step",
        "0.1",
        "--with-gravity",
    ];
    let (code, out, err) = record(directory.path(), &flags);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    let truth = fs::read_to_string(directory.path().join("jam.truth.csv")).unwrap();
    let trips: Vec<Vec<&str>> = truth
        .lines()
        .map(|line| line.split(',').collect())
        .collect();
    assert_eq!(
        trips[0][..6],
        ["start", "stop", "direction", "distance", "speed", "ended"]
    );
    assert_eq!((trips[1][0], trips[1][1]), ("1.010000", "10.110000"));
    assert_eq!((trips[1][2], trips[1][5]), ("down", "jam"));
    assert_eq!((trips[2][0], trips[2][3]), ("12.110000", "3.000000"));
    let text = fs::read_to_string(directory.path().join("jam.csv")).unwrap();
    assert!(text.starts_with("\"Time (s)\",\"Acceleration x (m/s^2)\","));
    assert!(!text.ends_with('\n'));
    let peak = text.lines().skip(1).map(|line| {
        let z: f64 = line.split(',').nth(3).unwrap().parse().unwrap();
        let steps = z / 0.1;
        assert!((steps - steps.round()).abs() < 1e-6, "{line}");
        z
    });
    // The mean of the half-sine's middle fifth, π/2 · v/w at its peak.
    let peak = peak.fold(0.0, f64::max);
    assert!((35.0..42.0).contains(&peak), "{peak}");
}

#[test]
fn bad_flags_get_sentences() {
    for trip in [
        "12",
        "up",
        "up:",
        "up:x",
        "left:3",
        "up:3:stop",
        "up:3:jam@x",
        "up:3:jam:4",
    ] {
        let err = refused(&["--trip", trip]);
        assert!(
            err.contains("a trip reads up:METRES or down:METRES"),
            "{trip}: {err}"
        );
    }
    for metres in ["0", "-3", "inf", "nan"] {
        let err = refused(&["--trip", &format!("up:{metres}")]);
        assert!(
            err.to_lowercase()
                .contains(&format!("metres must be positive, got {metres}")),
            "{err}"
        );
    }
    for (flags, sentence) in [
        (
            &["--trip", "up:0.5:jam"][..],
            "--trip, number 1: jam: a trip of 0.5 m never moves uniformly",
        ),
        (
            &["--trip", "up:12:jam@1"],
            "jam.after must lie in the uniform motion",
        ),
        (
            &["--speed", "0"],
            "speed must be positive and finite, got 0",
        ),
        (
            &["--rest", "1", "--rest", "2"],
            "rests: 2 trips need 3, got 2",
        ),
        (
            &["--rest", "nan"],
            "rest 1 must last zero or more seconds, got NaN",
        ),
        (&["--rate", "0"], "rate must lie in"),
        (
            &["--rest", "1e9"],
            "a ride must have 1 to 200000000 samples",
        ),
        (&["--sigma", "0"], "sigma must lie in"),
        (&["--vibration=-1"], "vibration must be zero or positive"),
        (
            &["--step", "0"],
            "--step must lie in [1e-9, 1e9] times --sigma, got 0",
        ),
        (
            &["--still", "--rest", "3", "--rest", "4"],
            "--still is one rest, got 2 (give --rest once)",
        ),
        (&["--still", "--trip", "up:3"], "cannot be used with"),
        (&["--out", "ride"], "cannot be used multiple times"),
    ] {
        let err = refused(flags);
        assert!(err.contains(sentence), "{flags:?}: {err}");
    }
    let directory = tempfile::tempdir().unwrap();
    let (code, _, err) = record(directory.path(), &["--out", "ride"]);
    assert_eq!(code, 2);
    assert!(err.contains("--out must end in .csv, got ride"), "{err}");
    let (code, _, err) = record(directory.path(), &["--out", "none/ride.csv"]);
    assert_eq!(code, 2);
    assert!(
        err.contains(
            "none/ride.csv: cannot be written: no folder none (make it, or give another name)"
        ),
        "{err}"
    );
}
