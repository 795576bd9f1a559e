//! Other commands.

use super::survival::{Bench, TINY};
use super::{liftsim, outcome, project};
use liftsim::experiment::{SWEEP, SweepConfig};
use liftsim::study;
use std::fs;

fn run(arguments: &[&str]) -> String {
    let (code, out, err) = outcome(liftsim().args(arguments));
    assert_eq!((code, err.as_str()), (0, ""), "{arguments:?}");
    out
}

const SIZES: [&str; 9] = [
    "threshold",
    "--reference",
    "12",
    "--shift",
    "12",
    "--scale",
    "12",
    "--alpha",
    "0.01",
];

#[test]
fn threshold_prints_a_table() {
    insta::assert_snapshot!("threshold", run(&SIZES));
}

/// JSON and the table agree, and every rule and alternative has a region.
#[test]
fn threshold_prints_json() {
    for rule in ["wilcoxon", "product", "disjunction", "conjunction"] {
        for (alternative, of) in ["greater", "less", "two-sided"]
            .iter()
            .flat_map(|sign| [(sign, "scale"), (sign, "motion")])
        {
            let extra = [
                "--rule",
                rule,
                "--alternative",
                alternative,
                "--exceedances",
                of,
            ];
            let json = run(&[&SIZES[..], &extra, &["--json"]].concat());
            let value: serde_json::Value = serde_json::from_str(&json).unwrap();
            let size = value["size"].as_f64().unwrap();
            assert!(size > 0.0 && size <= 0.01, "{rule} {alternative} {of}");
            let critical = value["critical"].as_array().unwrap();
            assert_eq!(critical.len(), if of == "scale" { 13 } else { 25 });
            let sum: f64 = critical
                .iter()
                .map(|c| {
                    c["probability"].as_f64().unwrap() * c["rank_sum_probability"].as_f64().unwrap()
                })
                .sum();
            assert!((sum - size).abs() < 1e-14, "eq. (15)");
            assert!(run(&[&SIZES[..], &extra].concat()).contains(&format!("exact size {size}")));
        }
    }
}

#[test]
fn threshold_draws_the_plane() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("plane.png");
    let draw = [&SIZES[..], &["--figure", path.to_str().unwrap()]].concat();
    run(&draw);
    assert!(fs::read(&path).unwrap().starts_with(b"\x89PNG"));
    // Existing files are not replaced without --force.
    fs::write(&path, "old").unwrap();
    let (code, _, err) = outcome(liftsim().args(&draw));
    assert_eq!(code, 2);
    assert!(err.contains("plane.png: already exists"), "{err}");
    assert_eq!(fs::read(&path).unwrap(), b"old");
    run(&[&draw[..], &["--force"]].concat());
    assert!(fs::read(&path).unwrap().starts_with(b"\x89PNG"));
}

/// The largest supported sizes.
#[test]
fn threshold_at_large_sizes() {
    let sizes = ["--reference", "200", "--shift", "200", "--scale", "200"];
    let out = run(&[&["threshold", "--alpha", "0.01"], &sizes[..]].concat());
    assert!(out.contains("exact size 0.00"), "{out}");
}

/// Sizes that need too much memory are refused before any is allocated: in an address space of 200 MB.
#[cfg(target_os = "linux")]
#[test]
fn huge_sizes_are_refused_at_once() {
    let program = assert_cmd::cargo::cargo_bin("liftsim");
    for (command, sentence) in [
        (
            "threshold --reference 12 --shift 1 --scale 1000000 --alpha 0.01",
            "MB of counts",
        ),
        (
            "threshold --reference 12 --shift 12 --scale 10000000 --alpha 0.01",
            "MB of counts",
        ),
        (
            "threshold --reference 10000000 --shift 12 --scale 12 --alpha 0.01",
            "MB of counts",
        ),
        (
            "threshold --reference 12 --shift 10000000 --scale 12 --alpha 0.01",
            "MB of counts",
        ),
        (
            "threshold --reference 3000 --shift 3000 --scale 3000 --alpha 0.01",
            "MB of counts",
        ),
        (
            "threshold --reference 18446744073709551615 --shift 12 --scale 12 --alpha 0.01",
            "MB of counts",
        ),
        (
            "threshold --reference 67 --shift 67 --scale 67 --alpha 0.01 --exceedances motion",
            "s to count, more than the 12 s allowed (sizes of about 45/45/45 would do",
        ),
        (
            "sweep configs/fig6.toml --threads 10000",
            "must lie in 1 to 1024 (leave it out to use all cores)",
        ),
        (
            "sweep configs/fig6.toml --threads 1000000000",
            "must lie in 1 to 1024",
        ),
    ] {
        let script = format!("ulimit -v 200000; exec {} {command}", program.display());
        let mut shell = std::process::Command::new("sh");
        let output = shell.args(["-c", &script]).current_dir(project()).output();
        let output = output.unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{command}: {err}");
        assert!(err.contains(sentence), "{command}: {err}");
    }
}

/// No message repeats more than 200 characters of any input.
#[test]
fn messages_repeat_little_of_what_was_typed() {
    let long = "x".repeat(100_000);
    let cases: [&[&str]; 9] = [
        &["sweep", &long],
        &["detect", &long],
        &["status", &long],
        &["plot", &long],
        &["simulate", "--out", &long],
        &["simulate", "--out", "a.csv", "--trip", &long],
        &["threshold", "--alpha", &long],
        &[&long],
        &["figures", "--only", &long],
    ];
    for arguments in cases {
        let (code, out, err) = outcome(liftsim().args(arguments));
        assert!(
            out.is_empty() || arguments[0] == "status",
            "{}",
            arguments[0]
        );
        assert!(
            code == 2 || arguments[0] == "status",
            "{}: {err}",
            arguments[0]
        );
        let repeated = (err + &out).matches('x').count();
        assert!(repeated < 250, "{}: {repeated}", arguments[0]);
    }
}

#[test]
fn plan_says_what_a_sweep_would_do() {
    let out = run(&["plan", "configs/fig6.toml"]);
    assert!(
        out.contains("155 in motion, 1 at rest, of 5 curves"),
        "{out}"
    );
    assert!(out.contains("31200000 trial-points"), "{out}");
    assert!(out.contains("0.00219 at a rate of 1/2"), "{out}");
}

/// Every config of the project is planned and runs; that its results come out again is for `scripts/reproduce`.
#[test]
fn every_config_runs() {
    for entry in fs::read_dir(project().join("configs")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let directory = tempfile::tempdir().unwrap();
        let (path, out) = (path.to_str().unwrap(), directory.path().to_str().unwrap());
        let is_sweep = study::load(path.as_ref()).unwrap().study() == SWEEP;
        let short: &[&str] = if is_sweep {
            &["--trials", "2", "--pilot", "2000"]
        } else {
            &["--trials", "2"]
        };
        run(&[&["plan", path], short].concat());
        run(&[&["sweep", path, "--out", out], short].concat());
        let rows = fs::read_to_string(directory.path().join("points.csv")).unwrap();
        assert!(rows.lines().count() > 1, "{path}");
        assert!(!is_sweep || rows.contains(",H0,"), "{path}");
    }
}

/// Pilots belong to sweeps; any other study says so.
#[test]
fn a_flag_that_means_nothing_is_refused() {
    let arguments = ["sweep", "configs/fig1.toml", "--pilot", "7"];
    let (code, _, err) = outcome(liftsim().args(arguments));
    assert_eq!(code, 2, "{err}");
    let message = "--pilot: means nothing to [autocorrelation] (leave it out)";
    assert!(err.contains(message), "{err}");
}

/// No output may be the recording, or another output, by whatever name.
#[cfg(unix)]
#[test]
fn an_output_is_one_file() {
    let directory = tempfile::tempdir().unwrap();
    let at = |name: &str| directory.path().join(name).to_str().unwrap().to_owned();
    let ride = at("ride.csv");
    run(&["simulate", "--out", &ride]);
    let recording = fs::read(&ride).unwrap();
    std::os::unix::fs::symlink(&ride, at("link.csv")).unwrap();
    let (link, dotted, both) = (at("link.csv"), at("./ride.csv"), at("both.csv"));
    for files in [
        [&ride, "--csv", &ride, "--json"],
        [&link, "--csv", &ride, "--json"],
        [&ride, "--save-state", &dotted, "--json"],
        [&ride, "--csv", &both, "--save-state"],
    ] {
        let mut arguments = vec!["detect", "--force"];
        arguments.extend(files);
        if arguments.last() == Some(&"--save-state") {
            arguments.push(&both);
        }
        let (code, _, err) = outcome(liftsim().args(&arguments));
        assert_eq!(code, 2, "{err}");
        assert!(err.contains("used for something else too"), "{err}");
        assert_eq!(fs::read(&ride).unwrap(), recording);
        assert!(!fs::exists(&both).unwrap());
    }
}

#[test]
fn the_manual_has_every_command() {
    let manual = run(&["man"]);
    for verb in [
        "sweep",
        "plot",
        "check",
        "figures",
        "threshold",
        "plan",
        "completions",
    ] {
        assert!(
            manual.contains(&format!("liftsim\\-{verb}")) || manual.contains(verb),
            "{verb}"
        );
    }
}

/// A reader that closes the pipe early is not an error.
#[test]
fn closed_pipe_is_no_error() {
    let program = assert_cmd::cargo::cargo_bin("liftsim");
    let script = format!(
        "{} man | head -n 1; echo ${{PIPESTATUS[0]}}",
        program.display()
    );
    let output = std::process::Command::new("bash")
        .args(["-c", &script])
        .output()
        .unwrap();
    assert!(output.stderr.is_empty());
    assert!(String::from_utf8_lossy(&output.stdout).ends_with("\n0\n"));
}

/// Errors in a text are reported before anything runs, with the known names.
#[test]
fn an_unknown_label_in_a_text_names_every_curve() {
    let bench = Bench::new(&format!("text = \"D is {{rate:TYPO@1.0}}.\"{TINY}"));
    let (code, _, err) = bench.run(&["sweep", "tiny.toml", "--out", "out"]);
    assert_eq!(code, 2, "{err}");
    let sentence = "{rate:TYPO@1.0}: unknown curve `TYPO` (one of plain, calibrated, laplace)";
    assert!(err.contains(sentence), "{err}");
}

/// The experiment in the README runs, and all its links have targets.
#[test]
fn the_readme_is_right() {
    let readme = fs::read_to_string(project().join("README.md")).unwrap();
    let (_, config) = readme.split_once("```toml\n").unwrap();
    let (config, _) = config.split_once("```").unwrap();
    SweepConfig::parse("README.md", config).unwrap_or_else(|error| panic!("{error}"));
    for link in readme.split("](").skip(1) {
        let (path, _) = link.split_once(')').unwrap();
        let is_there = project().join(path).exists();
        assert!(is_there, "{path}");
    }
}

/// The joint law of W and T' is counted on the threads that are asked for, by every command that simulates.
#[test]
fn joint_laws_on_any_number_of_threads() {
    let directory = tempfile::tempdir().unwrap();
    let config = directory.path().join("motion.toml");
    let text = "question = \"?\"\nseed = 1\ntrials = 20\n[detector]\nexceedances = \"motion\"\n[axis]\ndelta = [0.0, 1.0]\n";
    std::fs::write(&config, text).unwrap();
    let config = config.to_str().unwrap();
    for threads in ["1", "2", "5"] {
        let out = directory.path().join(threads);
        let out = out.to_str().unwrap();
        for (command, expected) in [
            (vec!["sweep", config, "-q", "--out", out], 0),
            (vec!["plan", config], 0),
            (vec!["check", config, "-q"], 3),
            (vec!["replay", config, "--point", "1", "--trial", "3"], 0),
        ] {
            let (code, _, err) = outcome(liftsim().args(&command).args(["--threads", threads]));
            assert_eq!((code, err.as_str()), (expected, ""), "{command:?}");
        }
    }
}
