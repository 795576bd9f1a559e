//! A run that was interrupted in any way continues where it stopped and gives the same bytes.

use super::{liftsim, outcome};
use liftsim::results::{Checkpoint, Directory, sha256};
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Two families, a calibrated curve, and claims that compare points.
pub const TINY: &str = r#"
question = "Does it survive?"
seed = 11
trials = 15_000
pilot = 5000
[detector]
alpha = 0.05
[whitening]
training = 64
[axis]
delta = [0.5, 1.0]
[[curve]]
label = "plain"
[[curve]]
label = "calibrated"
detector = { calibrate = true }
[[curve]]
label = "laplace"
noise = { law = "laplace" }
[[claim]]
claim = "The promise costs power"
test = { exceeds = { first = "plain", second = "calibrated" } }
[[claim]]
claim = "D grows"
test = { grows = { curves = ["laplace"] } }
"#;

/// One small config of each study that counts trials, except sweeps.
pub const STUDIES: [&str; 5] = [
    "question = \"?\"\nseed = 3\ntrials = 400\n[autocorrelation]\nlags = 5\nlength = 300\n",
    "question = \"?\"\nseed = 3\ntrials = 9000\n[impulse_law]\nnu = [0.1, 0.3]\nlength = 20\n",
    "question = \"?\"\nseed = 3\ntrials = 5000\n[detector]\nalpha = 0.05\n[operating_point]\n\
     sizes = [6, 8]\npower = [0.5, 0.8]\ndelta = { from = 0.0, to = 3.2 }\n",
    "question = \"?\"\nseed = 3\ntrials = 24\n[ride]\nmeasure = \"tradeoff\"\nlength = 60\n\
     rest = [15, 20]\ntrips = 1\n[ride.axis]\ndelta_over_sigma = [1, 16]\n",
    "question = \"?\"\nseed = 3\ntrials = 24\n[records]\nwatch = \"monitor\"\n\
     class = [\"drum\", \"express\"]\n",
];

/// A directory with a config.
pub struct Bench(TempDir);

impl Bench {
    pub fn new(text: &str) -> Self {
        let bench = Self(tempfile::tempdir().unwrap());
        bench.write(text);
        bench
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, text: &str) {
        fs::write(self.path("tiny.toml"), text).unwrap();
    }

    /// Runs `liftsim` here.
    pub fn run(&self, arguments: &[&str]) -> (i32, String, String) {
        outcome(liftsim().current_dir(self.0.path()).args(arguments))
    }

    /// Sweeps into `out`; returns the number of trial-points simulated.
    pub fn sweep(&self, out: &str, more: &[&str]) -> u64 {
        let arguments = [&["sweep", "tiny.toml", "--json", "--out", out], more].concat();
        let (code, _, err) = self.run(&arguments);
        assert_eq!(code, 0, "{err}");
        let first: serde_json::Value = serde_json::from_str(err.lines().next().unwrap()).unwrap();
        assert_eq!(first["event"], "started");
        first["total"].as_u64().unwrap()
    }

    /// Starts a sweep in the background.
    pub fn start(&self, out: &str, more: &[&str]) -> Child {
        Command::new(assert_cmd::cargo::cargo_bin("liftsim"))
            .current_dir(self.0.path())
            .env("LIFTSIM_SAVE_EVERY", "0.01")
            .args(["sweep", "tiny.toml", "--quiet", "--out", out])
            .args(more)
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap()
    }

    /// The result files, except the record of the run itself.
    pub fn files(&self, out: &str) -> BTreeMap<String, Vec<u8>> {
        let names = self.names(out).into_iter();
        names
            .filter(|name| name != "run.json" && self.path(out).join(name).is_file())
            .map(|name| (name.clone(), fs::read(self.path(out).join(&name)).unwrap()))
            .collect()
    }

    pub fn names(&self, out: &str) -> BTreeSet<String> {
        let entries = fs::read_dir(self.path(out)).unwrap();
        let name = |entry: std::io::Result<fs::DirEntry>| entry.unwrap().file_name();
        entries.map(|e| name(e).into_string().unwrap()).collect()
    }
}

/// Waits until a run has made progress; a run that ends before has failed.
fn wait_until(child: &mut Child, has_happened: impl Fn() -> bool) {
    while !has_happened() {
        let ended = child.try_wait().unwrap();
        assert!(ended.is_none(), "ended too early: {ended:?}");
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn signal(child: &Child, name: &str) {
    let sent = Command::new("kill")
        .args([name, &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
}

/// Kills spread over a whole run, each followed by the same command. The duration of a run depends on the load
/// of the machine, so the times adapt: a kill that comes too late makes the next ones earlier, one before the
/// first save makes them later.
fn kill_and_go_on(text: &str, enough: u32) {
    let most_attempts = 40 * enough;
    let bench = Bench::new(text);
    let start = Instant::now();
    assert!(bench.start("whole", &[]).wait().unwrap().success());
    let mut length = start.elapsed().as_secs_f64();
    let (expected, names) = (bench.files("whole"), bench.names("whole"));
    let (mut attempts, mut in_time, mut after_a_save) = (0, 0, 0);
    let mut state = 2014u64;
    while in_time < enough || after_a_save < enough / 5 {
        attempts += 1;
        assert!(
            attempts <= most_attempts,
            "{in_time} in time, {after_a_save} after a save"
        );
        // Knuth's generator.
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        let instant = length * (state >> 40) as f64 / (1u64 << 24) as f64;
        let mut child = bench.start("killed", &[]);
        std::thread::sleep(Duration::from_secs_f64(instant));
        child.kill().unwrap();
        if child.wait().unwrap().success() {
            length *= 0.9;
        } else {
            in_time += 1;
            let has_saved = bench.path("killed/counts.json").exists();
            after_a_save += u32::from(has_saved);
            length *= if has_saved { 1.0 } else { 1.05 };
            let out = bench.start("killed", &[]).wait_with_output().unwrap();
            let err = String::from_utf8_lossy(&out.stderr);
            assert!(out.status.success(), "{err}");
        }
        assert!(bench.files("killed") == expected, "attempt {attempts}");
        assert_eq!(bench.names("killed"), names, "no litter");
        fs::remove_dir_all(bench.path("killed")).unwrap();
    }
    println!("{in_time} kills in time of {attempts}, {after_a_save} after a save");
}

#[test]
fn a_killed_run_comes_to_the_same_bytes() {
    kill_and_go_on(TINY, 50);
}

#[test]
fn a_killed_study_comes_to_the_same_bytes() {
    for study in STUDIES {
        kill_and_go_on(study, 10);
    }
}

/// A result that only needs to be drawn again, and whose run ends between the first file and the manifest: here
/// because of a limit on file size that the counts keep and the picture exceeds.
#[test]
fn an_interrupted_redraw_loses_nothing() {
    let bench = Bench::new(TINY);
    bench.sweep("out", &[]);
    bench.write(
        &TINY
            .replace("label = \"laplace\"", "label = \"heavy\"")
            .replace("[\"laplace\"]", "[\"heavy\"]"),
    );
    let program = assert_cmd::cargo::cargo_bin("liftsim");
    let sweep = format!(
        "ulimit -f 40; exec {} --quiet sweep tiny.toml --out out",
        program.display()
    );
    let mut shell = Command::new("sh");
    shell.args(["-c", &sweep]).current_dir(bench.path("."));
    assert!(
        !shell.output().unwrap().status.success(),
        "the picture fits"
    );
    let points = fs::read_to_string(bench.path("out/points.csv")).unwrap();
    assert!(points.contains("heavy"), "nothing was written");
    assert_eq!(bench.sweep("out", &[]), 0, "counts were lost");
    bench.sweep("fresh", &[]);
    assert!(bench.files("out") == bench.files("fresh"));
    assert_eq!(bench.names("out"), bench.names("fresh"));
}

/// Existing counts are not simulated again, and an extended result has the bytes of a single run.
#[test]
fn only_what_is_missing_is_simulated() {
    let bench = Bench::new(TINY);
    let check = |text: &str, more: &[&str], expected: u64| {
        bench.write(text);
        assert_eq!(bench.sweep("out", more), expected);
        let _ = fs::remove_dir_all(bench.path("own"));
        bench.sweep("own", more);
        assert!(bench.files("out") == bench.files("own"));
    };
    // Of each of two families a point at rest and two in motion; the calibrated ones see the same.
    check(TINY, &["--trials", "3000"], 6 * 3000);
    check(TINY, &["--trials", "3000"], 0);
    check(TINY, &["--trials", "5000"], 6 * 2000);
    let told = TINY
        .replace("\"plain\"", "\"simple\"")
        .replace("costs power", "is dear");
    let told = told.replace("survive?", "live on?");
    check(&told, &["--trials", "5000"], 0);
    let point = told.replace("[0.5, 1.0]", "[0.5, 1.0, 1.5]");
    // "D grows" compares the new point with the old ones, which run again for that.
    check(&point, &["--trials", "5000"], 4 * 5000);
    let curve = point + "[[curve]]\nlabel = \"new\"\nnoise = { law = \"uniform\" }\n";
    check(&curve, &["--trials", "5000"], 4 * 5000);
    // The pairs of a new claim are counted; the points they are of run again, and are not counted twice.
    let claim = "[[claim]]\nclaim = \"?\"\ntest = { grows = { curves = [\"new\"] } }\n";
    check(&(curve + claim), &["--trials", "5000"], 3 * 5000);
}

#[test]
fn what_changes_results_is_refused() {
    let bench = Bench::new(TINY);
    let trials = ["--trials", "3000"];
    bench.sweep("finished", &trials);
    bench.sweep(
        "half/shards/1-of-2",
        &[&trials[..], &["--shard", "1/2"]].concat(),
    );
    let (code, out, _) = bench.run(&["merge", "half/shards/1-of-2", "--out", "unfinished"]);
    assert_eq!(code, 0);
    assert!(out.contains("no directory of shard 2/2"), "{out}");
    let seed = ["--trials", "3000", "--seed", "12"];
    let cases: [(&str, &[&str], &str); 5] = [
        (TINY, &seed, "seed is 11 there, 12 here"),
        (
            TINY,
            &["--trials", "2999"],
            "3000 trials per point, more than the 2999",
        ),
        (
            &TINY.replace("1.0]", "1.5]"),
            &trials,
            "delta is 1 there, 1.5 here",
        ),
        (
            &TINY.replace("= 5000", "= 6000"),
            &trials,
            "pilot is 5000 there, 6000 here",
        ),
        (
            &format!("common_random_numbers = false\n{TINY}"),
            &trials,
            "common_random_numbers is true there, false here",
        ),
    ];
    for (text, more, message) in cases {
        bench.write(text);
        for out in ["finished", "unfinished"] {
            let before = bench.names(out);
            let (code, _, err) = bench.run(&[&["sweep", "tiny.toml", "--out", out], more].concat());
            assert_eq!(code, 2, "{err}");
            assert!(err.contains(message) && err.contains("--fresh"), "{err}");
            assert_eq!(bench.names(out), before);
        }
    }
    bench.write(TINY);
    assert!(bench.sweep("unfinished", &trials) < 6 * 3000);
    assert!(bench.files("unfinished") == bench.files("finished"));
}

#[test]
fn damaged_counts_are_refused() {
    let bench = Bench::new(TINY);
    bench.sweep("out", &["--trials", "3000", "--shard", "1/2"]);
    let path = bench.path("out/counts.json");
    let whole = fs::read(&path).unwrap();
    let mut edited = whole.clone();
    let digit = edited.iter().rposition(|&byte| byte == b'[').unwrap() + 1;
    edited[digit] = if edited[digit] == b'1' { b'2' } else { b'1' };
    for damaged in [&whole[..whole.len() / 2], &edited, b""] {
        fs::write(&path, damaged).unwrap();
        for verb in [
            &[
                "sweep",
                "tiny.toml",
                "--trials",
                "3000",
                "--shard",
                "1/2",
                "--out",
            ][..],
            &["merge"],
        ] {
            let (code, _, err) = bench.run(&[verb, &["out"]].concat());
            assert_eq!(code, 2, "{err}");
            assert!(
                err.contains("counts.json: damaged") && err.contains("restore"),
                "{err}"
            );
        }
        assert_eq!(fs::read(&path).unwrap(), damaged, "nothing is lost");
        assert!(bench.run(&["status", "out"]).1.contains("damaged"));
    }
    bench.sweep("out", &["--trials", "3000", "--shard", "1/2", "--fresh"]);
    assert!(bench.run(&["status", "out"]).1.contains("finished"));
}

/// A run of hours, on any machine.
const LONG: [&str; 2] = ["--trials", "100000000000"];

/// One run at a time; a signal stops it cleanly, and the same command continues.
#[test]
fn a_stopped_run_says_how_to_go_on() {
    let bench = Bench::new(TINY);
    for (name, code, out) in [("-INT", 130, "out"), ("-TERM", 143, "other")] {
        let mut child = bench.start(out, &[&LONG[..], &["--fresh"]].concat());
        let counts = bench.path(out).join("counts.json");
        wait_until(&mut child, || counts.exists());
        let (second, _, err) = bench.run(&["sweep", "tiny.toml", "--out", out]);
        assert_eq!(second, 2);
        let message = "another run of liftsim is writing here (wait";
        assert!(err.contains(message), "{err}");
        assert!(bench.run(&["status", out]).1.contains("running"));
        signal(&child, name);
        let output = child.wait_with_output().unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{err}");
        let is_told = err.contains("to go on:") && !err.contains("--fresh");
        assert!(is_told, "{err}");
        let left = BTreeSet::from(["counts.json".to_owned()]);
        assert_eq!(bench.names(out), left);
        let status = bench.run(&["status", out]).1;
        assert!(status.contains("unfinished"), "{status}");
    }
}

/// A disk that fills up once all is counted: the file that does not fit is named, the run is not finished without it, and
/// the same command finishes it without counting anything.
#[test]
fn a_run_without_its_files_is_unfinished() {
    let bench = Bench::new(TINY);
    let program = assert_cmd::cargo::cargo_bin("liftsim");
    let sweep = format!(
        "trap '' XFSZ; ulimit -f 40; exec {} --quiet sweep tiny.toml --out out",
        program.display()
    );
    let mut shell = Command::new("sh");
    shell.args(["-c", &sweep]).current_dir(bench.path("."));
    let output = shell.output().unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{err}");
    assert!(err.contains("out/figure.png: cannot be written"), "{err}");
    assert!(err.contains("make room there"), "{err}");
    let status = bench.run(&["status", "out"]).1;
    assert!(status.contains("unfinished"), "{status}");
    let counts = fs::read(bench.path("out/counts.json")).unwrap();
    assert!(!counts.is_empty());
    assert_eq!(bench.sweep("out", &[]), 0, "counts were lost");
    let status = bench.run(&["status", "out"]).1;
    assert!(status.contains(" finished"), "{status}");
}

/// A file system of its own, if this user may have one.
struct Disk<'a>(&'a Path);

impl<'a> Disk<'a> {
    fn mount(place: &'a Path) -> Option<Self> {
        fs::create_dir_all(place).unwrap();
        let mut mount = Command::new("mount");
        mount
            .args(["-t", "tmpfs", "-o", "size=96k", "tmpfs"])
            .arg(place);
        match mount.stderr(Stdio::null()).status() {
            Ok(status) if status.success() => Some(Self(place)),
            _ => {
                println!("skipped: this user may mount no tmpfs");
                None
            }
        }
    }
}

impl Drop for Disk<'_> {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.0).status();
    }
}

/// On a full disk no saved counts are lost, and nothing is counted twice.
#[test]
fn a_full_or_read_only_disk_is_a_clear_error() {
    let bench = Bench::new(TINY);
    let place = bench.path("disk");
    let Some(_disk) = Disk::mount(&place) else {
        return;
    };
    let mut child = bench.start("disk/out", &LONG);
    wait_until(&mut child, || place.join("out/counts.json").exists());
    // Fill the disk.
    while fs::write(place.join("filler"), vec![0; 96 << 10]).is_ok() {}
    let output = child.wait_with_output().unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{err}");
    assert!(
        err.contains("counts.json: cannot be written") && err.contains("make room"),
        "{err}"
    );
    let status = bench.run(&["status", "disk/out"]).1;
    assert!(status.contains("unfinished"), "{status}");

    let (code, _, err) = bench.run(&["sweep", "tiny.toml", "--out", "disk/other"]);
    assert_eq!(code, 1, "{err}");
    fs::remove_file(place.join("filler")).unwrap();
    let saved = fs::read(place.join("out/counts.json")).unwrap();
    let mut readonly = Command::new("mount");
    assert!(
        readonly
            .args(["-o", "remount,ro"])
            .arg(&place)
            .status()
            .unwrap()
            .success()
    );
    let (code, _, err) = bench.run(&["sweep", "tiny.toml", "--out", "disk/out", LONG[0], LONG[1]]);
    assert_eq!(code, 2);
    assert!(err.contains("cannot be written"), "{err}");
    assert_eq!(fs::read(place.join("out/counts.json")).unwrap(), saved);
    let mut writable = Command::new("mount");
    assert!(
        writable
            .args(["-o", "remount,rw"])
            .arg(&place)
            .status()
            .unwrap()
            .success()
    );
    let mut child = bench.start("disk/out", &LONG);
    wait_until(&mut child, || {
        fs::read(place.join("out/counts.json")).unwrap() != saved
    });
    signal(&child, "-INT");
    assert_eq!(child.wait_with_output().unwrap().status.code(), Some(130));
}

/// Impossible counts are refused, even if their hash is right.
#[test]
fn impossible_counts_are_refused() {
    let bench = Bench::new(TINY);
    let shard = ["--trials", "3000", "--shard", "1/2"];
    bench.sweep("out", &shard);
    let whole = Directory::new(bench.path("out")).checkpoint().unwrap();
    let whole = serde_json::to_value(whole.unwrap()).unwrap();
    let refused = |change: &dyn Fn(&mut serde_json::Value), words: &str| {
        let mut state = whole.clone();
        let counters = state["counts"]["counters"].as_object_mut().unwrap();
        counters.values_mut().for_each(change);
        let text = state.to_string();
        let json = match serde_json::from_str::<Checkpoint>(&text) {
            Ok(state) => state.to_json(),
            // Counts that cannot even be represented are written by hand.
            Err(_) => format!("{{\"sha256\":\"\",\"checkpoint\":{text}}}").into_bytes(),
        };
        fs::write(bench.path("out/counts.json"), json).unwrap();
        for verb in [
            &[&["sweep", "tiny.toml"], &shard[..], &["--out"]].concat()[..],
            &["merge"],
        ] {
            let (code, _, err) = bench.run(&[verb, &["out"]].concat());
            assert_eq!(code, 2, "{err}");
            assert!(err.contains("damaged") && err.contains(words), "{err}");
        }
    };
    let set = |name: &'static str, value: serde_json::Value| {
        move |counter: &mut serde_json::Value| match name {
            "trials" => counter["trials"] = value.clone(),
            _ => counter["sums"][name] = value.clone(),
        }
    };
    refused(&set("counts", json!([1, 1, 1])), "not as many sums");
    refused(&set("counts", json!([])), "not as many sums");
    let too_many = |counter: &mut serde_json::Value| {
        let counts = counter["sums"]["counts"].as_array_mut().unwrap();
        counts.iter_mut().for_each(|count| *count = json!(2000));
    };
    refused(&too_many, "2000 of something");
    refused(&set("trials", json!([[0, 4000]])), "trial 3999 of 3000");
    refused(&set("trials", json!([[0, 9], [5, 20]])), "counted twice");
    refused(&set("trials", json!([[9, 5]])), "must end after its start");
    let lonely = |counter: &mut serde_json::Value| {
        let counts = counter["sums"]["counts"].as_array_mut().unwrap();
        if counts.len() == 2 {
            counts[0] = json!(counts[0].as_u64().unwrap() + 1);
        }
    };
    refused(&lonely, "at one point of a pair alone");
}

/// The same for rides, whose numbers must be consistent; and a small file that claims many delays takes little
/// memory.
#[test]
fn impossible_rides_are_refused() {
    let bench = Bench::new(STUDIES[3]);
    let shard = ["--shard", "1/2", "--out", "out"];
    assert_eq!(
        bench.run(&[&["sweep", "tiny.toml"], &shard[..]].concat()).0,
        0
    );
    let whole = Directory::new(bench.path("out")).checkpoint().unwrap();
    let whole = serde_json::to_value(whole.unwrap()).unwrap();
    for (name, value, words) in [
        (
            "values",
            json!([{ "0": 1_000_000_000_000_000_000u64 }, {}, {}, {}]),
            "of something",
        ),
        (
            "values",
            json!([{ "0": 12 }, { "0": 11 }, {}, { "0": 12 }]),
            "stop_delays: must lie in [12, 12]",
        ),
        (
            "values",
            json!([{ "0": 12 }, { "0": 12 }, { "0": 1 }, { "0": 12 }]),
            "alarm_delays: must",
        ),
        (
            "counts",
            json!([13, 0, 0, 0, 0, 0, 0, 0, 0]),
            "13 of something",
        ),
        (
            "counts",
            json!([0, 0, 5, 0, 0, 0, 0, 0, 0]),
            "alarmed: must lie in [0, 0]",
        ),
        (
            "counts",
            json!([0, 0, 0, 0, 0, 0, 3, 0, 0]),
            "disturbed: must lie in [1, 3]",
        ),
        ("lengths", json!(["-5"]), "stood: must lie in"),
    ] {
        let mut state = whole.clone();
        let counters = state["counts"]["counters"].as_object_mut().unwrap();
        for counter in counters.values_mut() {
            counter["sums"][name] = value.clone();
        }
        let state: Checkpoint = serde_json::from_value(state).unwrap();
        fs::write(bench.path("out/counts.json"), state.to_json()).unwrap();
        for verb in [
            &[&["sweep", "tiny.toml"], &shard[..]].concat()[..],
            &["merge", "out"],
        ] {
            let (code, _, err) = bench.run(verb);
            assert_eq!(code, 2, "{err}");
            assert!(err.contains("damaged") && err.contains(words), "{err}");
        }
    }
}

/// Rows that cannot have been counted are refused by whoever reads them, even if the manifest has their hash: more
/// detections than trials, and detections that contradict the comparisons.
#[test]
fn impossible_rows_are_refused() {
    let bench = Bench::new(TINY);
    bench.sweep("out", &["--trials", "3000"]);
    let directory = Directory::new(bench.path("out"));
    let mut manifest = directory.manifest().unwrap();
    let points = fs::read_to_string(bench.path("out/points.csv")).unwrap();
    let lines: Vec<&str> = points.lines().collect();
    let mut columns = lines[0].split(',');
    let detections = columns.position(|name| name == "detections").unwrap();
    let moving = lines.iter().position(|line| line.contains("plain,H1"));
    for (count, words) in [
        ("3001", "3001 detections in 3000 trials"),
        ("2999", "at one point of a pair alone"),
    ] {
        let mut cells: Vec<&str> = lines[moving.unwrap()].split(',').collect();
        cells[detections] = count;
        let edited = points.replace(lines[moving.unwrap()], &cells.join(","));
        fs::write(bench.path("out/points.csv"), &edited).unwrap();
        (manifest.files).insert("points.csv".to_owned(), sha256(edited.as_bytes()));
        fs::write(bench.path("out/run.json"), manifest.to_json()).unwrap();
        for verb in [
            &["sweep", "tiny.toml", "--trials", "5000", "--out", "out"][..],
            &["plot", "out"],
        ] {
            let (code, _, err) = bench.run(verb);
            assert_eq!(code, 2, "{err}");
            assert!(err.contains("points.csv: ") && err.contains(words), "{err}");
        }
    }
}

/// Counts are written before anything is drawn, and a config that cannot be drawn is refused before counting.
#[test]
fn what_cannot_be_drawn_loses_no_counts() {
    let mut text = TINY.split("[[curve]]").next().unwrap().to_owned();
    for panel in 0..300 {
        text += &format!("[[curve]]\nlabel = \"{panel}\"\npanel = \"{panel}\"\n");
    }
    let bench = Bench::new(&text);
    for verb in ["sweep", "plan"] {
        let (code, _, err) = bench.run(&[verb, "tiny.toml"]);
        assert_eq!(code, 2, "{err}");
        assert!(err.contains("panels: must be at most 12, got 300"), "{err}");
    }
    assert!(!bench.path("results").exists());
}

/// Sizes are checked before memory is allocated.
#[test]
fn what_nobody_could_wait_for_is_refused() {
    let head = "question = \"?\"\nseed = 1\n[axis]\n";
    let values = "delta = { from = 0.0, to = 2.99, step = 0.01 }\n";
    let curves = "[[curve]]\nlabel = \"a\"\n[[curve]]\nlabel = \"b\"\n";
    let claim =
        "[[claim]]\nclaim = \"?\"\ntest = { exceeds = { first = \"a\", second = \"b\" } }\n";
    let many: String = (0..100)
        .map(|i| format!("[[curve]]\nlabel = \"{i}\"\n"))
        .collect();
    for (text, words) in [
        (
            format!("{head}{values}{curves}{}", claim.repeat(2000)),
            "comparisons: must be at most 50000, got 600000",
        ),
        (
            format!("{head}{values}{many}"),
            "points: must be at most 20000, got 30000",
        ),
    ] {
        let bench = Bench::new(&text);
        let (code, _, err) = bench.run(&["sweep", "tiny.toml"]);
        assert_eq!(code, 2, "{err}");
        assert!(err.contains(words), "{err}");
    }
}
