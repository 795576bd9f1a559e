//! `liftsim detect` and `liftsim monitor`: the rides of a recording, the same from a pipe; and every bad input:
//! exit 2, a message with the place, the value and the remedy, no panic, and no files left behind.

use super::{liftsim, outcome};
use serde_json::Value;
use std::fmt::Write as _;
use std::fs;
use std::io::{BufRead, BufReader, Write as _};
use std::path::Path;
use std::process::{Command, Stdio};
use tempfile::TempDir;

pub(super) type Said = (i32, String, String);

fn detect(directory: &Path, arguments: &[&str]) -> Said {
    let mut command = liftsim();
    command.current_dir(directory).arg("detect").args(arguments);
    outcome(&mut command)
}

fn monitor(directory: &Path, arguments: &[&str], input: impl Into<Vec<u8>>) -> Said {
    let mut command = liftsim();
    command
        .current_dir(directory)
        .arg("monitor")
        .args(arguments)
        .write_stdin(input);
    outcome(&mut command)
}

/// Runs a command that must succeed without warnings.
pub(super) fn well((code, out, err): Said) -> String {
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    out
}

/// A directory with a simulated ride, `ride.csv`.
pub(super) fn recorded(flags: &[&str]) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    let mut command = liftsim();
    command.current_dir(&directory);
    command.args(["simulate", "--out", "ride.csv"]).args(flags);
    well(outcome(&mut command));
    directory
}

fn found(directory: &Path, arguments: &[&str]) -> Value {
    let out = well(detect(directory, &[&["--json"], arguments].concat()));
    serde_json::from_str(&out).unwrap()
}

/// `ride.csv` as `name`, its times written by `stamp`.
fn stamped(directory: &Path, name: &str, stamp: impl Fn(f64) -> String) {
    let text = fs::read_to_string(directory.join("ride.csv")).unwrap();
    let (header, rows) = text.split_once('\n').unwrap();
    let row = |line: &str| {
        let (time, rest) = line.split_once(',').unwrap();
        format!("{},{rest}\n", stamp(time.parse().unwrap()))
    };
    let rows: String = rows.lines().map(row).collect();
    let header = header.replace("Time (s)", "time");
    fs::write(directory.join(name), format!("{header}\n{rows}")).unwrap();
}

/// A clock that goes from +02:00 to +01:00 after 2 s, and the same moments written otherwise.
#[test]
fn dates_in_and_out() {
    let directory = recorded(&[]);
    let path = directory.path();
    let of_day = |ms: i64| {
        let (s, ms) = (ms.div_euclid(1000), ms.rem_euclid(1000));
        format!("{:02}:{:02}:{:02}.{ms:03}", s / 3600, s / 60 % 60, s % 60)
    };
    // 01:59:58 by UTC.
    let ms = |time: f64| 7_198_000 + (1000.0 * time).round() as i64;
    let utc = move |time: f64| format!("2026-10-25T{}Z", of_day(ms(time)));
    stamped(path, "utc.csv", utc);
    let paris = move |time: f64| {
        let ms = ms(time);
        let hours = if ms < 7_200_000 { 2 } else { 1 };
        format!("2026-10-25 {}+0{hours}:00", of_day(ms + hours * 3_600_000))
    };
    stamped(path, "paris.csv", paris);
    stamped(path, "wall.csv", move |time| {
        format!("25.10.2026 {}", of_day(ms(time)))
    });
    stamped(path, "unix.csv", move |time| {
        (1_792_886_400_000 + ms(time)).to_string()
    });
    let bare = found(path, &["ride.csv"]);
    let start = bare["rides"][0]["start"].as_f64().unwrap();
    assert!(bare["rides"][0].get("start_at").is_none());
    for (file, zone, ahead) in [
        ("utc.csv", "Z", 0),
        ("paris.csv", "+02:00", 2),
        ("wall.csv", "", 0),
        ("unix.csv", "Z", 0),
    ] {
        let report = found(path, &[file]);
        let recording = &report["recording"];
        let hour = 1 + ahead;
        let zero = format!("2026-10-25T{hour:02}:59:58.005{zone}");
        assert_eq!(recording["clock_zero"], zero, "{file}");
        // Times now count from the first row, at 0.005 s.
        let ride = &report["rides"][0];
        let since = ride["start"].as_f64().unwrap();
        assert!((since + 0.005 - start).abs() < 0.06, "{file}: {since}");
        let moment = of_day(ms(since + 0.005) + ahead * 3_600_000);
        assert_eq!(
            ride["start_at"],
            format!("2026-10-25T{moment}{zone}"),
            "{file}"
        );
        let table = well(detect(path, &[file]));
        assert!(
            table.contains(&format!("times count from {zero}\n")),
            "{table}"
        );
        assert!(table.contains("start_at"), "{table}");
        let csv = well(detect(path, &[file, "--csv", "rides.csv", "--force"]));
        assert!(csv.contains("start_at"));
        let csv = fs::read_to_string(path.join("rides.csv")).unwrap();
        assert!(csv.contains(&moment), "{csv}");
    }
    let input: String = (rows(path).iter())
        .map(|(time, z)| format!("{},{z}\n", paris(time.parse().unwrap())))
        .collect();
    let events = objects(&well(monitor(
        path,
        &["--begins", "rest", "--trips"],
        input,
    )));
    assert_eq!(events[0]["at"], "2026-10-25T03:59:58.005+02:00");
    assert!(events.iter().all(|event| event["at"].is_string()));
    let trips: Vec<&Value> = events
        .iter()
        .filter_map(|event| event.get("trip"))
        .collect();
    assert!(!trips.is_empty());
    assert!(trips.iter().all(|trip| trip["start_at"].is_string()));
    let plain = monitor(path, &["--rate", "100"], "0\n0.1\n0\n");
    assert!(!plain.1.contains("\"at\""), "{}", plain.1);
}

/// The times and the vertical acceleration of `ride.csv`, as written there.
fn rows(directory: &Path) -> Vec<(String, String)> {
    let text = fs::read_to_string(directory.join("ride.csv")).unwrap();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        (cells[0].to_owned(), cells[3].to_owned())
    };
    text.lines().skip(1).map(row).collect()
}

/// The same as lines with cells separated by `separator`.
pub(super) fn lines(directory: &Path, separator: &str) -> String {
    let line = |(time, acceleration)| format!("{time}{separator}{acceleration}\n");
    rows(directory).into_iter().map(line).collect()
}

fn objects(lines: &str) -> Vec<Value> {
    let object = |line| serde_json::from_str(line).unwrap();
    lines.lines().map(object).collect()
}

/// Both trips of the example, their times within 0.2 s of the truth.
#[test]
fn finds_the_rides_of_the_example() {
    let directory = recorded(&[]);
    let found = found(directory.path(), &["ride.csv"]);
    let truth = fs::read_to_string(directory.path().join("ride.truth.csv")).unwrap();
    let rides = found["rides"].as_array().unwrap();
    assert_eq!(rides.len(), 2);
    for (ride, truth) in rides.iter().zip(truth.lines().skip(1)) {
        let cells: Vec<&str> = truth.split(',').collect();
        for (name, true_time) in [("start", cells[0]), ("stop", cells[1])] {
            let (time, true_time) = (ride[name].as_f64().unwrap(), true_time.parse::<f64>());
            assert!((time - true_time.unwrap()).abs() < 0.2, "{ride} {truth}");
        }
        assert_eq!(ride["direction"], cells[2]);
        assert_eq!(ride["ended"], "stop");
    }
    let table = well(detect(directory.path(), &["ride.csv"]));
    assert!(
        table.contains("   1  up ") && table.contains("   2  down "),
        "{table}"
    );
}

#[test]
fn writes_csv_and_pictures() {
    let directory = recorded(&[]);
    let path = |name| directory.path().join(name);
    let outputs = ["--csv", "rides.csv", "--figure", "ride.png"];
    well(detect(
        directory.path(),
        &[&["ride.csv"], &outputs[..]].concat(),
    ));
    well(detect(
        directory.path(),
        &["ride.csv", "--figure", "ride.svg"],
    ));
    assert!(fs::read(path("ride.png")).unwrap().starts_with(b"\x89PNG"));
    assert!(
        fs::read_to_string(path("ride.svg"))
            .unwrap()
            .contains("</svg>")
    );
    let rides = fs::read_to_string(path("rides.csv")).unwrap();
    assert_eq!(rides.lines().count(), 3, "{rides}");
    // Existing files are not replaced without --force, and then nothing else is written.
    for (flag, name) in [
        ("--csv", "rides.csv"),
        ("--figure", "ride.png"),
        ("--save-state", "ride.csv"),
    ] {
        let before = fs::read(path(name)).unwrap();
        let (code, out, err) = detect(directory.path(), &["ride.csv", flag, name]);
        assert_eq!((code, out.as_str()), (2, ""));
        let sentence = "already exists (give another name, or --force to replace it)";
        assert_eq!(err, format!("error: {name}: {sentence}\n"));
        assert_eq!(fs::read(path(name)).unwrap(), before);
    }
    well(detect(
        directory.path(),
        &[&["ride.csv", "--force"], &outputs[..]].concat(),
    ));
    // Without rides there is an empty table.
    let still = recorded(&["--still"]);
    let along_z = ["ride.csv", "--axis", "z", "--csv", "rides.csv"];
    well(detect(still.path(), &along_z));
    let none = fs::read_to_string(still.path().join("rides.csv")).unwrap();
    assert_eq!(Some(none.trim_end()), rides.lines().next());
}

/// The monitor reports the rides that `detect` finds; both say the same with any separator.
#[test]
fn the_monitor_says_the_same() {
    let directory = recorded(&[]);
    let path = directory.path();
    let found_in = |name, more: &[&str]| found(path, &[&[name], more].concat());
    // The pipe has z alone, and so must `detect`.
    let expected = found_in("ride.csv", &["--axis", "z", "--save-state", "lift.json"]);
    let rides = expected["rides"].as_array().unwrap();
    let arguments = ["--state", "lift.json", "--begins", "rest"];
    let said = |separator| objects(&well(monitor(path, &arguments, lines(path, separator))));
    let events = said(",");
    assert_eq!(events[0]["state"], "unknown");
    for (state, end) in [("acceleration", "start"), ("rest", "stop")] {
        let times = events.iter().filter(|event| event["state"] == state);
        let times: Vec<f64> = times.map(|event| event["time"].as_f64().unwrap()).collect();
        let first = times.len() - rides.len();
        for (time, ride) in times[first..].iter().zip(rides) {
            assert!(
                (time - ride[end].as_f64().unwrap()).abs() < 0.5,
                "{state}: {times:?}"
            );
        }
    }
    for separator in [";", "\t", " "] {
        assert_eq!(said(separator), events, "{separator:?}");
    }
    for separator in [",", ";", "\t"] {
        let text = format!("time{separator}acceleration\n{}", lines(path, separator));
        fs::write(path.join("plain.csv"), text).unwrap();
        for state in [&[][..], &["--state", "lift.json"]] {
            let found = found_in("plain.csv", state);
            assert_eq!(found["rides"], expected["rides"], "{separator:?}");
        }
    }
    // The beginning of a record is known only for that record.
    let input = lines(path, ",");
    let said = |input: &str| objects(&well(monitor(path, &["--state", "lift.json"], input)));
    assert_eq!(said(&input), events);
    let (_, later) = input.split_once('\n').unwrap();
    assert_ne!(said(later).get(1), events.get(1));
}

/// Either rule tells the rides of the example, with its own decision behind each start, also from a saved state, which
/// holds what the rule needs.
#[test]
fn either_rule_tells_the_rides() {
    let directory = recorded(&[]);
    let path = directory.path();
    let starts = |arguments: &[&str]| {
        let events = objects(&well(monitor(path, arguments, lines(path, ","))));
        let starts = events.into_iter();
        let starts = starts.filter(|event| event["state"] == "acceleration");
        starts.collect::<Vec<Value>>()
    };
    let by_default = starts(&["--begins", "rest"]);
    assert!(!by_default.is_empty());
    for (rule, decided, other) in [
        ("sequential", "alarmed", "rank_sum"),
        ("three-sample", "rank_sum", "alarmed"),
    ] {
        let told = starts(&["--begins", "rest", "--rule", rule]);
        found(
            path,
            &[
                "ride.csv",
                "--axis",
                "z",
                "--rule",
                rule,
                "--save-state",
                "lift.json",
                "--force",
            ],
        );
        let learnt = starts(&["--state", "lift.json", "--begins", "rest"]);
        for told in [told, learnt] {
            assert_eq!(told.len(), by_default.len(), "{rule}");
            for (event, as_told) in told.iter().zip(&by_default) {
                let decision = &event["decision"];
                assert!(
                    decision[decided].is_number() && decision[other].is_null(),
                    "{event}"
                );
                let apart = event["time"].as_f64().unwrap() - as_told["time"].as_f64().unwrap();
                assert!(apart.abs() < 0.5, "{event} {as_told}");
            }
        }
    }
    let (code, _, err) = monitor(path, &["--rule", "both"], "");
    assert!(
        code == 2 && err.contains("sequential, three-sample"),
        "{err}"
    );
}

#[test]
fn a_jam_is_an_alarm() {
    let directory = recorded(&["--trip", "up:6", "--trip", "down:20:jam"]);
    let path = directory.path();
    let found = found(path, &["ride.csv", "--save-state", "lift.json"]);
    assert_eq!(found["rides"][1]["ended"], "jam", "{found}");
    let arguments = ["--state", "lift.json", "--begins", "rest"];
    let said = well(monitor(path, &arguments, lines(path, ",")));
    let is_jam = |event: &&Value| event["alarm"] == "jam";
    let alarms: Vec<Value> = objects(&said).iter().filter(is_jam).cloned().collect();
    assert_eq!(alarms.len(), 1, "{said}");
    let distance =
        alarms[0]["time"].as_f64().unwrap() - found["rides"][1]["stop"].as_f64().unwrap();
    assert!(distance.abs() < 0.5, "{said}");
}

/// The drum turns from 20 s on, and the cage stands.
#[test]
fn slack_is_an_alarm() {
    let directory = recorded(&["--still", "--rest", "30"]);
    let drum = |index| usize::from(index >= 2000);
    let line = |(index, (_, acceleration))| format!("{acceleration},{}\n", drum(index));
    let input: String = rows(directory.path())
        .into_iter()
        .enumerate()
        .map(line)
        .collect();
    let arguments = ["--rate", "100", "--begins", "rest", "--expected-moving"];
    let said = objects(&well(monitor(directory.path(), &arguments, input)));
    let [beginning, rest, alarm] = &said[..] else {
        panic!("{said:?}");
    };
    assert_eq!(
        (&beginning["state"], &rest["state"]),
        (&"unknown".into(), &"rest".into())
    );
    assert_eq!(alarm["alarm"], "slack");
    assert!(
        (alarm["time"].as_f64().unwrap() - 20.0).abs() < 0.2,
        "{alarm}"
    );
}

/// If its output is closed, the monitor ends without an error.
#[test]
fn a_closed_pipe_ends_the_monitor() {
    let directory = recorded(&[]);
    let mut child = Command::new(assert_cmd::cargo::cargo_bin("liftsim"))
        .args(["monitor", "--rate", "100", "--begins", "rest"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let input = lines(directory.path(), ",");
    let (first, rest) = input.split_at(8000);
    stdin.write_all(first.as_bytes()).unwrap();
    let mut said = String::new();
    let mut stdout = BufReader::new(child.stdout.take().unwrap());
    stdout.read_line(&mut said).unwrap();
    assert!(said.contains("unknown"), "{said}");
    drop(stdout);
    // It may have ended before it has read all.
    let _ = stdin.write_all(rest.as_bytes());
    drop(stdin);
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), output.stderr.len()), (Some(0), 0));
}

/// Memory does not grow with five million samples.
#[cfg(target_os = "linux")]
#[test]
fn memory_stays_constant() {
    let directory = recorded(&["--rest", "30"]);
    let lines: String = (rows(directory.path()).into_iter())
        .map(|(_, acceleration)| acceleration + "\n")
        .collect();
    let mut child = Command::new(assert_cmd::cargo::cargo_bin("liftsim"))
        .args(["monitor", "--rate", "100", "--begins", "rest"])
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    for _ in 0..5_000_000 / lines.lines().count() {
        stdin.write_all(lines.as_bytes()).unwrap();
    }
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = peak.and_then(|peak| peak.trim().strip_suffix(" kB"));
    let kilobytes: u64 = kilobytes.unwrap().trim().parse().unwrap();
    println!("peak memory: {kilobytes} kB");
    assert!(kilobytes < 20_000, "{kilobytes} kB");
    drop(stdin);
    assert!(child.wait().unwrap().success());
}

const NO_TABLE: &[u8] = b"PK\x05\x06\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0";

/// The subject of each message, the recording, and further arguments.
const RECORDINGS: &[(&str, &[u8], &[&str])] = &[
    ("an empty file", b"", &[]),
    ("a header only", b"time,acc\n", &[]),
    ("one sample", b"time,acc\n0.1,9.8\n", &[]),
    ("all equal", b"0.01,9.81\n0.02,9.81\n0.03,9.81\n", &[]),
    ("NaN", b"time,acc\n0,9.8\n0.01,NaN\n0.02,9.7\n", &[]),
    ("blank cells", b"time,acc\n0,9.8\n0.01,\n0.02,\n", &[]),
    (
        "time going back",
        b"time,acc\n0,9.8\n0.02,9.7\n0.01,9.8\n",
        &[],
    ),
    (
        "time that only repeats",
        b"time,acc\n0,9.8\n0,9.7\n0,9.6\n",
        &[],
    ),
    (
        "mixed separators",
        b"time,acc\n0,9.8\n0.02;9.7\n0.03,9.8\n",
        &[],
    ),
    ("wrong columns", b"when,pressure\n0,9.8\n0.02,9.7\n", &[]),
    (
        "a misspelt column",
        b"time,pressure\n0,9.8\n0.02,9.7\n",
        &["--acceleration", "presure"],
    ),
    ("binary junk", b"\x7fELF\x02\x01\x01\0\0\0", &[]),
    ("junk after a header", b"time,acc\n0,9.8\n\0\0\0\0\n", &[]),
    ("a zip without a table", NO_TABLE, &[]),
    ("a damaged zip", b"PK\x03\x04 and no more", &[]),
    (
        "a rest too short",
        b"0.01,9.81\n0.02,9.82\n0.03,9.81\n",
        &[],
    ),
    (
        "milliseconds as seconds",
        b"0,9.81\n10,9.82\n20,9.81\n30,9.82\n",
        &[],
    ),
    (
        "counts of a converter",
        b"0.01,16384\n0.02,16380\n0.03,16390\n",
        &[],
    ),
    (
        "counts without a scale",
        b"0.01,16384\n0.02,16380\n",
        &["--unit", "counts"],
    ),
    (
        "a slow grid",
        b"0.01,9.81\n0.02,9.82\n0.03,9.81\n",
        &["--resample", "0.5"],
    ),
    (
        "a fine grid",
        b"0.01,9.81\n0.02,9.82\n0.03,9.81\n",
        &["--resample", "1e9"],
    ),
    (
        "a wrong picture",
        b"0.01,9.81\n0.02,9.82\n",
        &["--figure", "ride.jpg"],
    ),
    ("a level of 0", b"0.01,9.81\n0.02,9.82\n", &["--alpha", "0"]),
    (
        "a block of NaN",
        b"0.01,9.81\n0.02,9.82\n",
        &["--block", "nan"],
    ),
    (
        "a block of 1 s",
        b"0.01,9.81\n0.02,9.82\n",
        &["--block", "1"],
    ),
    (
        "no such config",
        b"0.01,9.81\n0.02,9.82\n",
        &["--config", "nowhere.toml"],
    ),
    (
        "no such state",
        b"0.01,9.81\n0.02,9.82\n",
        &["--state", "nowhere.json"],
    ),
    (
        "no state",
        b"0.01,9.81\n0.02,9.82\n",
        &["--state", "ride.csv"],
    ),
    (
        "a state and a level",
        b"0.01,9.81\n0.02,9.82\n",
        &["--state", "lift.json", "--alpha", "0.1"],
    ),
];

/// Adds a refusal to the snapshot, after checks of its exit code and of files left behind.
fn note(messages: &mut String, about: &str, (code, out, err): Said) {
    assert_eq!(code, 2, "{about}: {err}{out}");
    assert!(
        out.is_empty() || out.contains("\"unknown\""),
        "{about}: {out}"
    );
    assert!(!err.contains("panicked"), "{about}: {err}");
    writeln!(messages, "--- {about}\n{err}").unwrap();
}

#[test]
fn bad_recordings() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let mut messages = String::new();
    for (about, bytes, arguments) in RECORDINGS {
        fs::write(path.join("ride.csv"), bytes).unwrap();
        let said = detect(path, &[&["ride.csv"], *arguments].concat());
        note(&mut messages, about, said);
        assert_eq!(fs::read_dir(path).unwrap().count(), 1, "{about}");
    }
    fs::create_dir(path.join("folder")).unwrap();
    note(
        &mut messages,
        "a missing file",
        detect(path, &["nowhere.csv"]),
    );
    note(&mut messages, "a directory", detect(path, &["folder"]));
    note(&mut messages, "a device", detect(path, &["/dev/null"]));
    fs::write(path.join("ride.zip"), "time,acc\n").unwrap();
    note(&mut messages, "no zip", detect(path, &["ride.zip"]));
    fs::write(path.join("long.csv"), vec![b'7'; 64 << 20]).unwrap();
    note(&mut messages, "a long line", detect(path, &["long.csv"]));
    insta::assert_snapshot!("recordings", messages);
}

/// Recordings that are read with a warning.
#[test]
fn warnings() {
    let directory = recorded(&[]);
    let path = directory.path();
    let text = fs::read_to_string(path.join("ride.csv")).unwrap();
    fs::write(path.join("cut.csv"), &text[..text.len() - 60]).unwrap();
    let (code, out, err) = detect(path, &["cut.csv"]);
    assert_eq!(code, 0);
    assert!(out.contains("   2  down"), "{out}");
    assert!(
        err.contains("the file ends within this row (it is left out)"),
        "{err}"
    );
    let clipped = |(time, acceleration): (String, String)| {
        let acceleration: f64 = acceleration.parse().unwrap();
        format!("{time},{}\n", acceleration.clamp(-0.3, 0.3))
    };
    let clipped: String = rows(path).into_iter().map(clipped).collect();
    fs::write(path.join("clipped.csv"), clipped).unwrap();
    let (code, _, err) = detect(path, &["clipped.csv"]);
    assert_eq!(code, 0);
    assert!(err.contains("the sensor was at its limit in"), "{err}");
    let raised = |(time, acceleration): (String, String)| {
        let acceleration: f64 = acceleration.parse().unwrap();
        format!("{time},{}\n", 2048.0 + acceleration)
    };
    let raised: String = rows(path).into_iter().map(raised).collect();
    fs::write(path.join("counts.csv"), raised).unwrap();
    let (code, _, err) = detect(path, &["counts.csv"]);
    assert_eq!(code, 0);
    assert!(err.contains("as 2048 counts per g have it"), "{err}");
    let (code, _, err) = detect(path, &["counts.csv", "--unit", "m/s^2"]);
    assert_eq!(code, 0);
    assert!(err.contains("give the unit with --unit"), "{err}");
    // The sensor is turned after a ride, for good; what the warning says helps.
    let turned = |i: u32| {
        let time = f64::from(i) / 100.0;
        let noise = f64::from(i.wrapping_mul(2_654_435_761) >> 16) / 65536.0 - 0.5;
        let ride = match time {
            10.0..12.0 | 80.0..82.0 => 0.6,
            18.0..20.0 | 90.0..92.0 => -0.6,
            _ => 0.0,
        };
        let level = if time > 24.0 { 10.11 } else { 9.81 };
        format!("{time:.2},{:.4}\n", ride + level + 0.04 * noise)
    };
    let turned: String = (0..10_000).map(turned).collect();
    fs::write(path.join("turned.csv"), turned).unwrap();
    let (code, _, err) = detect(path, &["turned.csv"]);
    assert_eq!(code, 0);
    let remedy =
        "as if the sensor had been turned (if it was, leave the ride out with --from 24.0)";
    assert!(err.contains(remedy), "{err}");
    let (code, out, err) = detect(path, &["turned.csv", "--from", "24.0"]);
    assert_eq!((code, &err[..]), (0, ""));
    assert!(out.contains("   1  up         80.0"), "{out}");
    // Somebody walks with the sensor.
    let step = |i: i32| 5.0 * libm::sin(12.0 * f64::from(i) / 100.0);
    let row = |i: i32| format!("{:.2},{:.4}\n", f64::from(i) / 100.0, step(i));
    fs::write(
        path.join("walk.csv"),
        (0..3000).map(row).collect::<String>(),
    )
    .unwrap();
    let (code, out, err) = detect(path, &["walk.csv"]);
    assert_eq!(code, 0);
    assert!(err.contains("the sensor is shaken for"), "{err}");
    assert!(out.contains("no rides that are decided"), "{out}");
}

/// A rest of 20 s: in each row what `row` makes of its number and the acceleration.
fn rest(head: &str, row: impl Fn(i32, f64) -> String) -> String {
    let noise = |i: i32| f64::from((i.wrapping_mul(7919) & 1023) - 512) / 5e4;
    let row = |i: i32| row(i, 9.81 + noise(i ^ (i << 3))) + "\n";
    head.to_owned() + &(0..2000).map(row).collect::<String>()
}

/// Each remedy that names a flag works: the message, and the flags as it says them.
#[test]
fn remedies_work() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let time = |i: i32| f64::from(i) / 100.0;
    let cases: [(String, &str, &[&str]); 9] = [
        (
            rest("az\n", |_, a| a.to_string()),
            "--rate HZ",
            &["--rate", "100"],
        ),
        (
            rest("when,az\n", |i, a| format!("{},{a}", time(i))),
            "--time COLUMN",
            &["--time", "when"],
        ),
        (
            rest("time,lift\n", |i, a| format!("{},{a}", time(i))),
            "--acceleration COLUMN",
            &["--acceleration", "lift"],
        ),
        (
            rest("", |i, a| format!("{},{a},3,4,5", time(i))),
            "--time 1 --acceleration 4",
            &["--time", "1", "--acceleration", "2"],
        ),
        (
            rest("time,az\n", |i, a| format!("{},{a}", 10 * i)),
            "--time-unit ms",
            &["--time-unit", "ms"],
        ),
        (
            rest("time,az\n", |i, a| format!("{},{}", time(i), 70.0 * a)),
            "--unit counts --scale 1.4281e-2",
            &["--unit", "counts", "--scale", "1.4281e-2"],
        ),
        (
            rest("time,x,y,z\n", |i, a| {
                format!("{},0,0,{}", time(i), a - 9.8)
            }),
            "--axis x, y or z",
            &["--axis", "z"],
        ),
        (
            rest("time,az\n", |i, a| format!("{},{a}", time(i))),
            "change --from or --to",
            &["--from", "5", "--to", "15"],
        ),
        (
            rest("time,az\n", |i, a| format!("{},{a}", time(i))),
            "leave out --member",
            &[],
        ),
    ];
    for (text, remedy, flags) in cases {
        fs::write(path.join("ride.csv"), text).unwrap();
        let wrong: &[&str] = match remedy {
            "--axis x, y or z" => &["--axis", "gravity"],
            "change --from or --to" => &["--from", "50"],
            "leave out --member" => &["--member", "z"],
            _ => &[],
        };
        let (code, _, err) = detect(path, &[&["ride.csv"], wrong].concat());
        assert_eq!(code, 2, "{remedy}: {err}");
        assert!(err.contains(remedy), "{remedy}: {err}");
        let (code, out, err) = detect(path, &[&["ride.csv"], flags].concat());
        assert_eq!(code, 0, "{remedy}: {err}");
        assert!(out.contains("no rides"), "{out}");
    }
}

/// A stream is read as a file: header, units, columns, and the flags that choose them.
#[test]
fn a_stream_with_a_header() {
    let directory = recorded(&[]);
    let path = directory.path();
    well(detect(
        path,
        &["ride.csv", "--axis", "z", "--save-state", "lift.json"],
    ));
    let arguments = ["--state", "lift.json", "--begins", "rest"];
    let expected = well(monitor(path, &arguments, lines(path, ",")));
    let text = fs::read_to_string(path.join("ride.csv")).unwrap();
    let (code, _, err) = monitor(path, &arguments, &*text);
    assert_eq!(code, 2);
    assert!(err.contains("(choose one: --axis x, y or z"), "{err}");
    let along_z = [&arguments[..], &["--axis", "z"]].concat();
    assert_eq!(well(monitor(path, &along_z, text)), expected);
}

/// The subject of each message, the input from the pipe, and further arguments.
const PIPES: &[(&str, &str, &[&str])] = &[
    ("nothing", "", &[]),
    ("nothing at a rate", "", &["--rate", "100"]),
    ("a header only", "time,acc\n", &[]),
    ("one sample", "0.1,9.8\n", &[]),
    ("no rate", "9.8\n9.7\n", &[]),
    ("a bad number", "9.8\nnine\n", &["--rate", "100"]),
    ("NaN", "9.8\nnan\n", &["--rate", "100"]),
    ("a cell too many", "0,9.8\n0.01,9.8,3\n", &["--rate", "100"]),
    (
        "another number of cells",
        "9.8\n0.01,9.8\n",
        &["--rate", "100"],
    ),
    ("time going back", "0,9.8\n0.02,9.8\n0.01,9.8\n", &[]),
    ("decimal commas", "9,81\n9,82\n", &[]),
    ("milliseconds", "0,9.8\n10,9.8\n20,9.8\n", &[]),
    ("a time beyond all", "0,9.8\n1e300,9.8\n", &[]),
    (
        "counts of a converter",
        "16384\n16380\n",
        &["--rate", "100"],
    ),
    (
        "a missing drum",
        "9.8,1\n9.8\n",
        &["--rate", "100", "--expected-moving"],
    ),
    (
        "half a drum",
        "9.8,1\n9.8,0.5\n",
        &["--rate", "100", "--expected-moving"],
    ),
    ("a rate of 0", "9.8\n", &["--rate", "0"]),
    ("a rate of NaN", "9.8\n", &["--rate", "nan"]),
    ("no such state", "9.8\n", &["--state", "nowhere.json"]),
    ("a directory", "9.8\n", &["--state", "."]),
    ("an empty state", "9.8\n", &["--state", "empty.json"]),
    ("a hostile state", "9.8\n", &["--state", "hostile.json"]),
    (
        "a state and a level",
        "9.8\n",
        &["--state", "hostile.json", "--alpha", "0.1"],
    ),
];

#[test]
fn bad_pipes() {
    let directory = recorded(&["--still"]);
    let path = directory.path();
    let along_z = ["ride.csv", "--axis", "z", "--save-state", "lift.json"];
    well(detect(path, &along_z));
    let state = fs::read_to_string(path.join("lift.json")).unwrap();
    let hostile = state.replace("\"training\": 72\n", "\"training\": 1000000000000\n");
    assert_ne!(hostile, state);
    fs::write(path.join("hostile.json"), hostile).unwrap();
    fs::write(path.join("empty.json"), "").unwrap();
    let mut messages = String::new();
    for (about, input, arguments) in PIPES {
        note(&mut messages, about, monitor(path, arguments, *input));
    }
    let long = vec![b'7'; 64 << 20];
    let said = monitor(path, &["--rate", "100"], long);
    note(&mut messages, "a long line", said);
    insta::assert_snapshot!("pipes", messages);
}

/// Unreadable lines are skipped on request, with a warning for each.
#[test]
fn keeps_going() {
    let directory = recorded(&[]);
    let path = directory.path();
    well(detect(path, &["ride.csv", "--save-state", "lift.json"]));
    let good = lines(path, ",");
    let bad = good.replacen('\n', "\nnine\n0.001,9.8,7\n0.001,nan\n0.001\n0.0,9.8\n", 1);
    let arguments = ["--state", "lift.json", "--begins", "rest"];
    let expected = well(monitor(path, &arguments, good));
    let going = [&arguments[..], &["--keep-going"]].concat();
    let (code, out, err) = monitor(path, &going, bad);
    assert_eq!(code, 0, "{err}");
    assert_eq!(out, expected);
    insta::assert_snapshot!("passed_over", err);
    // What a clock that is often set back does is said once, and counted.
    let late = "0.0,9.8\n".repeat(5);
    let (code, _, err) = monitor(path, &going, lines(path, ",") + &late);
    assert_eq!(code, 0, "{err}");
    assert_eq!(err.matches("the clock was set back").count(), 1, "{err}");
    assert_eq!(err.matches("time must increase").count(), 1, "{err}");
    assert!(err.contains("does not increase, passed over: 4"), "{err}");
}

/// Warnings are best effort: if standard error is closed, the work continues.
#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_error_stops_nothing() {
    let directory = recorded(&[]);
    let path = directory.path();
    let bad = lines(path, ",").replacen('\n', "\nnine\n", 1);
    fs::write(path.join("bad.txt"), bad).unwrap();
    let run = |arguments: &str| {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let program = assert_cmd::cargo::cargo_bin("liftsim");
        let output = Command::new(program)
            .current_dir(path)
            .args(arguments.split(' '))
            .stdin(fs::File::open(path.join("bad.txt")).unwrap())
            .stderr(full)
            .output()
            .unwrap();
        (output.status.code(), output.stdout)
    };
    let (code, said) = run("monitor --begins rest --keep-going");
    assert_eq!(code, Some(0));
    assert!(said.ends_with(b"}\n"));
    let text = "question = \"?\"\nseed = 1\ntrials = 10\n[axis]\ndelta = [1]\n";
    fs::write(path.join("small.toml"), text).unwrap();
    assert_eq!(run("sweep small.toml --out small --json").0, Some(0));
    // Unusable input is still refused, though without a message.
    assert_eq!(run("sweep nowhere.toml").0, Some(2));
}
