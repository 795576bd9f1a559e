//! A monitor that is left alone: its heartbeat, and the unit of the README.

use super::liftsim;
#[cfg(unix)]
use super::{outcome, project};
#[cfg(unix)]
use std::fs;
use std::io::{BufRead, BufReader, Write};
#[cfg(unix)]
use std::path::Path;
use std::process::{Command, Stdio};

/// The heart beats before the first reading, counts the readings, and goes on while none comes.
#[test]
fn the_heart_beats_while_the_sensor_is_silent() {
    let mut monitor = Command::new(env!("CARGO_BIN_EXE_liftsim"))
        .args([
            "monitor",
            "--rate",
            "100",
            "--begins",
            "rest",
            "--heartbeat",
            "0.1",
        ])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut sensor = monitor.stdin.take().unwrap();
    let lines = BufReader::new(monitor.stdout.take().unwrap()).lines();
    let mut beats = lines.map_while(Result::ok).filter_map(|line| {
        let event: serde_json::Value = serde_json::from_str(&line).unwrap();
        (event["event"] == "heartbeat").then_some(event)
    });
    let first = beats.next().unwrap();
    assert!(first["time"].is_null() && first["readings"] == 0 && first["state"] == "unknown");
    for number in 0..500u32 {
        writeln!(
            sensor,
            "{}",
            f64::from(number.wrapping_mul(7919) % 101) * 1e-4
        )
        .unwrap();
    }
    sensor.flush().unwrap();
    let all = beats.find(|beat| beat["readings"] == 500).unwrap();
    assert_eq!(all["state"], "rest");
    let silent = |beat: &serde_json::Value| beat["silent"].as_f64().unwrap();
    assert!(beats.any(|beat| beat["readings"] == 500 && silent(&beat) > silent(&all)));
    drop(sensor);
    assert!(beats.last().is_none_or(|beat| beat["readings"] == 500));
    assert!(monitor.wait().unwrap().success());
}

/// Readings count as they come, also while the rate is still being measured from them; and where nobody reads the lines,
/// the heart ends the monitor though the sensor goes on.
#[test]
fn the_heart_sees_every_reading_and_the_reader() {
    let mut monitor = Command::new(env!("CARGO_BIN_EXE_liftsim"))
        .args(["monitor", "--heartbeat", "0.1"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut sensor = monitor.stdin.take().unwrap();
    for number in 0..60 {
        writeln!(sensor, "{},0.0{}", f64::from(number) * 0.02, number % 7).unwrap();
    }
    sensor.flush().unwrap();
    let mut lines = BufReader::new(monitor.stdout.take().unwrap()).lines();
    let all = lines.find(|line| line.as_ref().unwrap().contains("\"readings\":60"));
    assert!(all.is_some());
    drop(lines);
    assert!(monitor.wait().unwrap().success());
    drop(sensor);
}

/// What systemd would start runs, with a sensor at a real pipe.
#[cfg(unix)]
#[test]
fn the_unit_of_the_readme_runs() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let readme = fs::read_to_string(project().join("README.md")).unwrap();
    let start = readme
        .lines()
        .find_map(|line| line.strip_prefix("ExecStart=/bin/sh -c '"));
    let script = start.unwrap().strip_suffix('\'').unwrap();

    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    for arguments in [
        &["simulate", "ride", "--out", "ride.csv"][..],
        &["detect", "ride.csv", "--save-state", "lift.json"],
    ] {
        let (code, _, error) = outcome(liftsim().current_dir(folder.path()).args(arguments));
        assert_eq!(code, 0, "{error}");
    }
    symlink(env!("CARGO_BIN_EXE_liftsim"), path("liftsim")).unwrap();
    fs::write(path("sensor"), "#!/bin/sh\nexec cut -d, -f1,4 ride.csv\n").unwrap();
    fs::set_permissions(path("sensor"), fs::Permissions::from_mode(0o755)).unwrap();
    let tools = std::env::var("PATH").unwrap();
    let status = Command::new("/bin/sh")
        .args(["-c", script])
        .current_dir(folder.path())
        .env("PATH", format!("{}:{tools}", folder.path().display()))
        .status();
    assert!(status.unwrap().success());
    let events = fs::read_to_string(path("events.jsonl")).unwrap();
    for state in ["\"rest\"", "\"acceleration\"", "\"inertial\""] {
        assert!(events.contains(&format!("\"state\":{state}")), "{events}");
    }
}

/// However often a monitor is stopped and started again at a pipe, the same is told as without.
#[cfg(unix)]
#[test]
fn a_monitor_goes_on_where_another_was_stopped() {
    use std::fs::{File, OpenOptions};
    use std::io::Read;
    use std::os::unix::process::ExitStatusExt;
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let make = ["simulate", "ride", "--out", "ride.csv"];
    let (code, _, error) = outcome(liftsim().current_dir(folder.path()).args(make));
    assert_eq!(code, 0, "{error}");
    // Only the first reader sees the header, which has the unit.
    let ride = fs::read_to_string(path("ride.csv")).unwrap();
    let lines = ride.lines().map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        format!("{},{}\n", cells[0], cells[3])
    });
    let lines: String = lines.collect();
    let monitor = |input: File, state: &[&str]| {
        Command::new(env!("CARGO_BIN_EXE_liftsim"))
            .current_dir(folder.path())
            .args(["monitor", "--trips", "--save-state", "lift.json"])
            .args(state)
            .stdin(input)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap()
    };
    fs::write(path("lines.csv"), &lines).unwrap();
    let begins = ["--begins", "rest", "--rate", "100"];
    let whole = monitor(File::open(path("lines.csv")).unwrap(), &begins);
    let whole = String::from_utf8(whole.wait_with_output().unwrap().stdout).unwrap();
    assert!(whole.lines().count() > 10, "{whole}");
    fs::remove_file(path("lift.json")).unwrap();

    let made = Command::new("mkfifo").arg(path("pipe")).status();
    assert!(made.unwrap().success());
    // Open at both ends, so that neither waits for the other.
    let both = OpenOptions::new().read(true).write(true).open(path("pipe"));
    let mut sensor = both.unwrap();
    let mut told = String::new();
    let mut rest = &lines[..];
    let go_on = || match path("lift.json").exists() {
        true => &["--state", "lift.json"][..],
        false => &begins,
    };
    for _ in 0..10 {
        let mut monitor = monitor(File::open(path("pipe")).unwrap(), go_on());
        // Parts that end within lines, and fit into the pipe.
        let (part, after) = rest.split_at(lines.len() / 12);
        sensor.write_all(part.as_bytes()).unwrap();
        let mut out = BufReader::new(monitor.stdout.take().unwrap());
        // It has read something, or will be told before.
        if told.is_empty() {
            out.read_line(&mut told).unwrap();
        }
        let stop = ["-TERM".to_owned(), monitor.id().to_string()];
        assert!(Command::new("kill").args(stop).status().unwrap().success());
        // It ends at the end of a line.
        let (line, after) = after.split_at(after.find('\n').unwrap() + 1);
        sensor.write_all(line.as_bytes()).unwrap();
        rest = after;
        out.read_to_string(&mut told).unwrap();
        // It may have been told before it could listen, and has read nothing then.
        let status = monitor.wait().unwrap();
        assert!(status.success() || status.signal() == Some(15), "{status}");
    }
    let monitor = monitor(File::open(path("pipe")).unwrap(), go_on());
    sensor.write_all(rest.as_bytes()).unwrap();
    drop(sensor);
    told += &String::from_utf8(monitor.wait_with_output().unwrap().stdout).unwrap();
    assert_eq!(told, whole);
}

/// What a saved state does not hold is not taken for known.
#[test]
fn a_saved_state_does_not_guess() {
    let monitor = |flags: &[&str]| {
        let run = liftsim()
            .args(["monitor", "--rate", "100"])
            .args(flags)
            .write_stdin("0.0\n")
            .output();
        let output = run.unwrap();
        (
            output.status.code(),
            String::from_utf8(output.stderr).unwrap(),
        )
    };
    for (flags, said) in [
        (
            &["--save-state", "s.json", "--floors", "0,3"][..],
            "among the floors",
        ),
        (&["--save-state", "-"], "standard output"),
        (&["--save-state", "nowhere/s.json"], "no such folder"),
    ] {
        let (code, error) = monitor(flags);
        assert_eq!(code, Some(2), "{error}");
        assert!(error.contains(said), "{error}");
    }
}

/// What was saved is used as it was, or it is said why not.
#[test]
fn a_saved_monitor_goes_on_as_it_was_or_says_why_not() {
    let folder = tempfile::tempdir().unwrap();
    let lines: String = (0..400).map(|i| format!("0.0{}\n", i % 3)).collect();
    let monitor = |flags: &[&str], input: &str| {
        let mut run = liftsim();
        let run = run.current_dir(folder.path()).arg("monitor").args(flags);
        outcome(run.write_stdin(input.to_owned()))
    };
    let save = ["--save-state", "lift.json"];
    let begins = ["--rate", "100", "--begins", "rest"];
    let (code, _, error) = monitor(&[&save[..], &begins].concat(), &lines);
    assert_eq!(code, 0, "{error}");
    let state = ["--state", "lift.json"];
    let (code, _, error) = monitor(&[&state[..], &["--unit", "g"]].concat(), &lines);
    assert_eq!(code, 2);
    assert!(error.contains("leave them out"), "{error}");
    let (code, _, error) = monitor(&[&state[..], &["--begins", "rest"]].concat(), &lines);
    assert_eq!(code, 0);
    assert!(error.contains("begins anew"), "{error}");
    // The rest of a line whose beginning another has read is no header.
    let (code, _, error) = monitor(&state, &format!(".01 x\n{lines}"));
    assert_eq!(code, 2);
    assert!(error.contains("line 1"), "{error}");
    // The state cannot be kept where its folder is gone.
    let gone = folder.path().join("gone");
    fs::create_dir(&gone).unwrap();
    let mut run = Command::new(env!("CARGO_BIN_EXE_liftsim"))
        .current_dir(folder.path())
        .args(["monitor", "--save-state", "gone/lift.json"])
        .args(begins)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = String::new();
    let mut out = BufReader::new(run.stdout.take().unwrap());
    let mut sensor = run.stdin.take().unwrap();
    sensor.write_all(lines.as_bytes()).unwrap();
    out.read_line(&mut first).unwrap();
    fs::remove_dir_all(&gone).unwrap();
    drop(sensor);
    let output = run.wait_with_output().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(error.contains("the state cannot be saved"), "{error}");
}

/// What a monitor says that saves its state and is told to end once it has printed so many lines, though its sensor sends no
/// more than this. The signal is heard then: it is looked for before anything is printed.
#[cfg(unix)]
fn stopped(folder: &Path, flags: &[&str], sent: &str, lines: usize) -> String {
    let mut run = Command::new(env!("CARGO_BIN_EXE_liftsim"))
        .current_dir(folder)
        .args(["monitor", "--begins", "rest", "--save-state", "lift.json"])
        .args(flags)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut sensor = run.stdin.take().unwrap();
    sensor.write_all(sent.as_bytes()).unwrap();
    let mut out = BufReader::new(run.stdout.take().unwrap());
    for _ in 0..lines {
        out.read_line(&mut String::new()).unwrap();
    }
    let stop = ["-TERM".to_owned(), run.id().to_string()];
    assert!(Command::new("kill").args(stop).status().unwrap().success());
    let output = run.wait_with_output().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{error}");
    drop(sensor);
    error
}

/// A sensor that hangs in the middle of a line keeps no monitor from ending.
#[cfg(unix)]
#[test]
fn half_a_line_is_not_waited_for_for_ever() {
    let folder = tempfile::tempdir().unwrap();
    let lines: String = (0..400).map(|i| format!("0.0{}\n", i % 3)).collect();
    // Its second event comes after some seconds of the record: it has read what was there.
    let error = stopped(folder.path(), &["--rate", "100"], &format!("{lines}0.0"), 2);
    assert!(error.contains("in the middle of a line"), "{error}");
    assert!(folder.path().join("lift.json").exists());
}

/// Readings without times say nothing of how many are missing: the clock of this machine does.
#[cfg(unix)]
#[test]
fn what_nobody_took_is_missing() {
    let folder = tempfile::tempdir().unwrap();
    let lines: String = (0..1000).map(|i| format!("0.0{}\n", i % 3)).collect();
    let monitor = |flags: &[&str]| {
        let mut run = liftsim();
        let run = run.current_dir(folder.path()).arg("monitor").args(flags);
        let (code, out, error) = outcome(run.write_stdin(lines.clone()));
        assert_eq!(code, 0, "{error}");
        (out, error)
    };
    let save = ["--save-state", "lift.json"];
    let (_, error) = monitor(&[&save[..], &["--rate", "100", "--begins", "rest"]].concat());
    assert!(!error.contains("missing"), "{error}");
    std::thread::sleep(std::time::Duration::from_secs(2));
    let (out, error) = monitor(&[&save[..], &["--state", "lift.json"]].concat());
    assert!(
        error.contains("none was taken for") && error.contains("are missing"),
        "{error}"
    );
    let events = out.lines().map(|line| serde_json::from_str(line).unwrap());
    let events: Vec<serde_json::Value> = events.collect();
    assert!(
        events.iter().any(|event| event["reason"] == "hole"),
        "{out}"
    );
    assert!(
        events
            .iter()
            .all(|event| event["reported"].as_f64() > Some(11.9)),
        "{out}"
    );
}

/// A signal before the first reading leaves nothing to save, and that is said.
#[cfg(unix)]
#[test]
fn nothing_read_is_nothing_saved() {
    let folder = tempfile::tempdir().unwrap();
    let error = stopped(folder.path(), &["--heartbeat", "0.1"], "", 1);
    let said = "lift.json: not written: there was no reading yet";
    assert!(error.contains(said), "{error}");
}
