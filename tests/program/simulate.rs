//! `liftsim simulate`: files, refusals, and the ride of the README.

use super::{liftsim, outcome, project};
use liftsim::results::sha256;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

fn simulate(directory: &Path, flags: &[&str]) -> (i32, String, String) {
    let mut command = liftsim();
    command.current_dir(directory).arg("simulate").args(flags);
    outcome(&mut command)
}

fn refused(flags: &[&str]) -> String {
    let directory = tempfile::tempdir().unwrap();
    let all = [&["--out", "ride.csv"], flags].concat();
    let (code, out, err) = simulate(directory.path(), &all);
    assert_eq!((code, out.as_str()), (2, ""), "{flags:?}: {err}");
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
    err
}

/// The ride of the README: the same bytes on every machine, equal to those of the defaults.
#[test]
fn the_ride_of_the_readme() {
    let directory = tempfile::tempdir().unwrap();
    let config = project().join("configs/simulate/ride.toml");
    let flags = [config.to_str().unwrap(), "--out", "ride.csv"];
    let (code, out, err) = simulate(directory.path(), &flags);
    assert_eq!((code, err.as_str()), (0, ""));
    assert_eq!(
        out,
        "ride.csv  6212 samples, 62.1 s at 100 Hz\nride.truth.csv  2 trips\n"
    );
    let read = |name| fs::read(directory.path().join(name)).unwrap();
    let golden = "ba87a45dfb66374249fe60ac94244a9bf2b43a045608c47e61787e5030151ba1";
    assert_eq!(sha256(&read("ride.csv")), golden);
    let truth = "start,stop,direction,distance,speed,ended,uniform,braking\n\
        8.005000,27.064524,up,12.000000,0.700000,commanded,9.921667,25.147857\n\
        35.064524,54.124048,down,-12.000000,0.700000,commanded,36.981190,52.207381\n";
    assert_eq!(String::from_utf8(read("ride.truth.csv")).unwrap(), truth);
    assert_eq!(simulate(directory.path(), &["--out", "default.csv"]).0, 0);
    assert!(read("default.csv") == read("ride.csv"));
}

/// Flags override the config, and errors in the config point into it.
#[test]
fn a_config_is_read_strictly() {
    let directory = tempfile::tempdir().unwrap();
    let config = |text: &str| {
        fs::write(directory.path().join("short.toml"), text).unwrap();
        let flags = ["short.toml", "--out", "ride.csv", "--rest", "2", "--force"];
        simulate(directory.path(), &flags)
    };
    let (code, out, err) = config("rate = 50\ntrip = [\"up:3\"]\nrest = [600]\n");
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(
        out.contains("at 50 Hz") && out.contains(" 1 trip\n"),
        "{out}"
    );
    for (text, message) in [
        (
            "rates = 50",
            "short.toml:1:1: unknown key `rates`, did you mean `rate`?",
        ),
        ("trip = [\"up\"]", "must be up:METRES or down:METRES"),
        (
            "rate = \"fast\"",
            "short.toml:1:8: rate: must be a finite number, got \"fast\"",
        ),
        ("rate = 0", "rate must lie in"),
    ] {
        let (code, _, err) = config(text);
        assert_eq!(code, 2, "{text}: {err}");
        assert!(err.contains(message), "{text}: {err}");
    }
}

#[test]
fn replaces_nothing_unasked() {
    let directory = tempfile::tempdir().unwrap();
    let flags = ["--out", "ride.csv", "--still", "--rest", "1"];
    assert_eq!(simulate(directory.path(), &flags).0, 0);
    let first = fs::read(directory.path().join("ride.csv")).unwrap();
    let other = [&flags[..], &["--seed", "2"]].concat();
    let (code, _, err) = simulate(directory.path(), &other);
    assert_eq!(code, 2);
    assert!(
        err.contains("ride.csv: already exists (give another name, or --force"),
        "{err}"
    );
    assert_eq!(fs::read(directory.path().join("ride.csv")).unwrap(), first);
    fs::remove_file(directory.path().join("ride.csv")).unwrap();
    let (code, _, err) = simulate(directory.path(), &other);
    assert_eq!(code, 2);
    assert!(err.contains("ride.truth.csv: already exists"), "{err}");
    let forced = [&other[..], &["--force"]].concat();
    assert_eq!(simulate(directory.path(), &forced).0, 0);
    assert_ne!(fs::read(directory.path().join("ride.csv")).unwrap(), first);
}

/// Links are not followed, and a full disk leaves the old files whole and no others.
#[cfg(unix)]
#[test]
fn files_are_replaced_whole_or_not_at_all() {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name);
    fs::write(path("precious"), "old").unwrap();
    for (name, planted) in [("ride.csv", "precious"), ("ride.truth.csv", "nothing")] {
        std::os::unix::fs::symlink(path(planted), path(name)).unwrap();
        let flags = ["--out", "ride.csv", "--still", "--rest", "1"];
        let (code, _, err) = simulate(directory.path(), &flags);
        assert_eq!(code, 2);
        assert!(err.contains("already exists"), "{err}");
        let forced = [&flags[..], &["--force"]].concat();
        let (code, _, err) = simulate(directory.path(), &forced);
        assert_eq!(code, 2);
        assert!(
            err.contains(&format!("{name}: is not an ordinary file")),
            "{err}"
        );
        fs::remove_file(path(name)).unwrap();
    }
    assert_eq!(fs::read(path("precious")).unwrap(), b"old");
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);

    assert_eq!(simulate(directory.path(), &["--out", "ride.csv"]).0, 0);
    let read = || ["ride.csv", "ride.truth.csv"].map(|name| fs::read(path(name)).unwrap());
    let old = read();
    let program = assert_cmd::cargo::cargo_bin("liftsim");
    let script = format!(
        "trap '' XFSZ; ulimit -f 100; exec {} simulate --out ride.csv --seed 2 --force",
        program.display()
    );
    let mut shell = std::process::Command::new("sh");
    let output = shell
        .args(["-c", &script])
        .current_dir(directory.path())
        .output();
    let output = output.unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{err}");
    assert!(err.contains("ride.csv: cannot be written"), "{err}");
    assert!(read() == old);
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 3);
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
    let (code, out, err) = simulate(directory.path(), &flags);
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
            err.contains("must be up:METRES or down:METRES"),
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
            "trip 1: jam: a trip of 0.5 m never moves uniformly",
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
        (&["--vibration=-1"], "vibration must lie in [0, 1e6] sigma"),
        (
            &["--step", "0"],
            "step must lie in [1e-9, 1e9] times sigma, got 0",
        ),
        (
            &["--still", "--rest", "3", "--rest", "4"],
            "--still: needs one rest, got 2 (give --rest once)",
        ),
        (&["--still", "--trip", "up:3"], "cannot be used with"),
        (&["--out", "ride"], "cannot be used multiple times"),
    ] {
        let err = refused(flags);
        assert!(err.contains(sentence), "{flags:?}: {err}");
    }
    let directory = tempfile::tempdir().unwrap();
    let (code, _, err) = simulate(directory.path(), &["--out", "ride"]);
    assert_eq!(code, 2);
    assert!(err.contains("--out must end in .csv, got ride"), "{err}");
    let (code, _, err) = simulate(directory.path(), &["--out", "none/ride.csv"]);
    assert_eq!(code, 2);
    assert!(
        err.contains(
            "none/ride.csv: cannot be written: no folder none (make it, or give another name)"
        ),
        "{err}"
    );
}

/// The building that is shipped: its truth, its trips as `track` measures them within four deviations, and its floors,
/// with an alarm at the two stops that are wrong and at no other.
#[test]
fn the_building_is_tracked() {
    let directory = tempfile::tempdir().unwrap();
    let config = project().join("configs/simulate/building.toml");
    let flags = [config.to_str().unwrap(), "--out", "building.csv"];
    let (code, out, err) = simulate(directory.path(), &flags);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(out.ends_with("building.truth.csv  10 trips\n"), "{out}");
    let mut truth = csv::Reader::from_path(directory.path().join("building.truth.csv")).unwrap();
    let truth: Vec<BTreeMap<String, String>> =
        truth.deserialize().collect::<Result<_, _>>().unwrap();
    let mut track = liftsim();
    track.current_dir(directory.path()).args([
        "track",
        "building.csv",
        "--floors",
        "0,4.2,7.4,10.6,13.8,17",
        "--at",
        "0",
        "--format",
        "json",
    ]);
    let (code, out, err) = outcome(&mut track);
    assert_eq!(code, 0, "{err}");
    let report: Value = serde_json::from_str(&out).unwrap();
    let rides = report["rides"].as_array().unwrap();
    assert_eq!(rides.len(), truth.len());
    for (ride, truth) in rides.iter().zip(&truth) {
        let number = |name: &str| truth[name].parse::<f64>().unwrap();
        let of = |name: &str| ride[name].as_f64().unwrap();
        let (distance, deviation) = (of("distance"), of("deviation"));
        let error = distance - number("distance");
        println!(
            "{distance:.3} ± {deviation:.3} m, off by {error:.3}, {}",
            ride["landing"]
        );
        assert!(error.abs() < 4.0 * deviation, "{ride}");
        assert!((of("start") - number("start")).abs() < 0.5, "{ride}");
        assert!((of("stop") - number("stop")).abs() < 0.5, "{ride}");
        let landing = &ride["landing"];
        let is_wrong = !truth["fault"].is_empty();
        assert_eq!(
            landing["judgement"]["fault"].is_string(),
            is_wrong,
            "{landing}"
        );
        if !is_wrong {
            assert_eq!(landing["floor"].to_string(), truth["to"], "{landing}");
        }
    }
}

/// What is wrong with a building is said at its place, with a remedy.
#[test]
fn buildings_are_refused_at_their_place() {
    let directory = tempfile::tempdir().unwrap();
    let refused = |text: &str, flags: &[&str]| {
        fs::write(directory.path().join("b.toml"), text).unwrap();
        let all = [&["b.toml", "--out", "b.csv"], flags].concat();
        let (code, out, err) = simulate(directory.path(), &all);
        assert_eq!((code, out.as_str()), (2, ""), "{text}: {err}");
        err
    };
    for (text, message) in [
        (
            "[building]\nfloors = [0, 3, 2]",
            "b.toml:2:17: building.floors[2]: must lie above the floor before it, 3, got 2 (give heights",
        ),
        (
            "[building]\njourneys = [0, 9]",
            "b.toml:2:16: building.journeys[1]: must be a floor, 0 to 5, got 9 (count floors from 0, the lowest)",
        ),
        (
            "[building]\njourneys = \"all\"",
            "b.toml:2:12: building.journeys: must be a list of floors, or { random = N } with a whole number",
        ),
        (
            "speed = 0\n[building]",
            "b.toml:1:9: speed: must be positive and finite, got 0",
        ),
        (
            "[building]\nfloor = [0, 3]",
            "b.toml:2:1: building: unknown key `floor`, did you mean `floors`?",
        ),
        (
            "[building]\nfaults = [{ journey = 1, kind = { pitt = 1 } }]",
            "unknown key `pitt`, did you mean `pit`?",
        ),
        (
            "[building]\nfaults = [{ journey = 1, kind = { between_floors = 1 } }]",
            "must lie strictly between 0 and 1, got 1",
        ),
        (
            "[building]\nfaults = [{ journey = 0, kind = { pit = 1 } }]",
            "b.toml:2:23: building.faults[0].journey: must be a journey, 1 to 10, got 0",
        ),
        (
            "trip = [\"up:3\"]\n[building]",
            "b.toml:1:8: trip: means nothing with a [building] (leave it out)",
        ),
        (
            "[sensor]\nmodel = \"phone\"",
            "sensor: means nothing without a [building]",
        ),
        (
            "[building]\n[sensor]\nmodel = \"mpu6051\"",
            "b.toml:3:9: sensor.model: unknown value `mpu6051`, did you mean `mpu6050`?",
        ),
        (
            "[building]\n[sensor]\ndensity = 0",
            "b.toml:3:11: sensor.density: must lie in [1e-6, 1e6] µg/√Hz, got 0",
        ),
        (
            "[building]\n[sensor]\nstep = 1e-9\ndensity = 1e6",
            "b.toml:3:8: sensor.step: must be 1e-9 to 1e9 times the noise, got 1e-9 (0 is none)",
        ),
        (
            "[building]\nfloors = [0, 0.9]\njourneys = [0, 1]\nfaults = [{ journey = 1, kind = { mis_levelling = -0.9 } }]",
            "b.toml:3:12: building: journey 1: distance must be finite and not zero, got 0",
        ),
        (
            "[building]\nfaults = [{ journey = 1, kind = { mis_levelling = -4.2 } }]",
            "building.faults[0].kind.mis_levelling: must lie in [-1, 1] m, got -4.2",
        ),
        (
            "[building]\nfaults = [{ journey = 1, kind = { emergency_stop = 0.05 } }]",
            "building.faults[0].kind.emergency_stop: must lie in [0.5, 50] m/s², got 0.05",
        ),
        (
            "rate = 0\n[building]",
            "b.toml:1:8: rate must lie in [1e-3, 1e9] Hz, got 0",
        ),
    ] {
        let err = refused(text, &[]);
        assert!(err.contains(message), "{text}: {err}");
    }
    let err = refused("speed = 1\n[building]", &["--speed", "0"]);
    assert!(
        err.starts_with("error: --speed: must be positive and finite, got 0"),
        "{err}"
    );
    let err = refused("[building]", &["--still"]);
    assert!(
        err.contains("--trip: means nothing with a [building]"),
        "{err}"
    );
}
