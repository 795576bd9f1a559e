//! Every config's results and the report, from two configs that take a second.

use super::{liftsim, outcome, project};
use liftsim::claim::words::interval;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const POWER: &str = r#"
question = "How does the power grow?"
title = "Power"
text = "At Δ/σ_ξ = 2 the power is {rate:quiet@2.0} and {rate:loud@2}; at rest it is {false_alarm:quiet}, of exact size {size:quiet}."
order = 1
seed = 5
trials = 3000
[impulses]
nu = 0.01
theta = 1.0
[axis]
delta = [0.0, 1.0, 2.0]
[[curve]]
label = "quiet"
[[curve]]
label = "loud"
impulses = { nu = 0.3, theta = 20.0 }
[[claim]]
claim = "D grows"
source = "Fig. 6"
margin = 0.05
test = "grows"
[[claim]]
claim = "Loud | impulses lower D"
source = "Fig. 6"
test = { exceeds = { first = "quiet", second = "loud" } }
[[claim]]
claim = "They cost nothing"
source = "nowhere"
test = { equals = { first = "quiet", second = "loud" } }
[[claim]]
claim = "They cost decibels"
source = "nowhere"
test = { gain = { first = "quiet", second = "loud", power = 0.6 } }
"#;

const REST: &str = r#"
question = "Is the level kept?"
seed = 5
trials = 40_000
[impulses]
nu = 0.0
[axis]
rule = ["wilcoxon", "product"]
[[claim]]
claim = "It is"
source = "eq. (15)"
test = "alpha_held"
"#;

/// A directory with the two configs.
fn workshop() -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    fs::create_dir(directory.path().join("configs")).unwrap();
    fs::write(directory.path().join("configs/power.toml"), POWER).unwrap();
    fs::write(directory.path().join("configs/at_rest.toml"), REST).unwrap();
    fs::write(directory.path().join("configs/notes.txt"), "no config").unwrap();
    directory
}

fn figures(place: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = liftsim();
    outcome(command.current_dir(place).arg("figures").args(arguments))
}

fn read(place: &Path, name: &str) -> String {
    fs::read_to_string(place.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The outcome of an experiment in the table.
fn note<'a>(out: &'a str, name: &str) -> &'a str {
    let line = out.lines().find(|line| line.starts_with(name));
    line.unwrap_or_else(|| panic!("{name}: {out}"))
        .split_whitespace()
        .nth(1)
        .unwrap()
}

fn run(place: &Path, arguments: &[&str]) -> String {
    let (code, out, err) = figures(place, arguments);
    assert_eq!((code, err.as_str()), (0, ""), "{arguments:?}: {out}");
    out
}

#[test]
fn report_in_full() {
    let place = workshop();
    let out = run(place.path(), &[]);
    assert_eq!(
        (note(&out, "power"), note(&out, "at_rest")),
        ("written", "written")
    );
    insta::assert_snapshot!("report", read(place.path(), "results/README.md"));
}

/// The second call does nothing, and the same results give the same report elsewhere.
#[test]
fn complete_results_are_skipped() {
    let (place, elsewhere) = (workshop(), workshop());
    run(place.path(), &[]);
    let report = read(place.path(), "results/README.md");
    let manifest = read(place.path(), "results/power/run.json");
    let out = run(place.path(), &[]);
    assert_eq!(
        (note(&out, "power"), note(&out, "at_rest")),
        ("skipped", "skipped")
    );
    assert!(out.contains("README.md  unchanged"), "{out}");
    assert_eq!(read(place.path(), "results/power/run.json"), manifest);
    run(elsewhere.path(), &[]);
    assert_eq!(read(elsewhere.path(), "results/README.md"), report);
    assert!(!report.contains(place.path().to_str().unwrap()));
    // A new simulation gives the same again.
    let out = run(place.path(), &["--fresh", "--only", "power"]);
    assert_eq!(note(&out, "power"), "unchanged");
}

/// Every number with an interval in the report is in a CSV beside it. (A gain is computed from the rows and
/// has no row of its own.)
#[test]
fn numbers_come_from_the_files() {
    let place = workshop();
    run(place.path(), &[]);
    let report = read(place.path(), "results/README.md");
    assert!(numbers_found(&place.path().join("results"), &report, "They cost decibels") >= 9);
}

/// The same for the committed report, except for the crossings of gains.
#[test]
fn numbers_of_the_committed_report_come_from_the_files() {
    let results = project().join("results");
    let report = fs::read_to_string(results.join("README.md")).unwrap();
    assert!(numbers_found(&results, &report, " reaches 0.9 at ") > 150);
}

/// The number of intervals in a report, each of which must be in a result file; lines with `apart` are left
/// out.
fn numbers_found(results: &Path, report: &str, apart: &str) -> usize {
    let mut known = BTreeSet::new();
    for entry in fs::read_dir(results).unwrap() {
        for (file, value) in [
            ("points.csv", "rate"),
            ("comparisons.csv", "difference"),
            ("quantities.csv", "value"),
        ] {
            let Ok(text) = fs::read_to_string(entry.as_ref().unwrap().path().join(file)) else {
                continue;
            };
            let mut reader = csv::Reader::from_reader(text.as_bytes());
            let header = reader.headers().unwrap().clone();
            let column = |name: &str| header.iter().position(|column| column == name);
            let Some(value) = column(value) else {
                continue;
            };
            let columns = [value, column("low").unwrap(), column("high").unwrap()];
            for row in reader.records() {
                let row = row.unwrap();
                let [value, low, high] = columns.map(|column| row[column].parse::<f64>().unwrap());
                known.insert(interval(value, low, high));
            }
        }
    }
    let text: Vec<&str> = (report.lines())
        .filter(|line| !line.contains(apart))
        .flat_map(str::split_whitespace)
        .collect();
    let is_number = |word: &str| word.replace('−', "-").parse::<f64>().is_ok();
    let mut found = 0;
    for words in text.windows(3) {
        let (low, high) = (words[1].strip_prefix('['), words[2].split_once(']'));
        let (Some(low), Some((high, _))) = (low, high) else {
            continue;
        };
        if is_number(words[0]) && is_number(low.trim_end_matches(',')) {
            let number = format!("{} [{low} {high}]", words[0]);
            assert!(known.contains(&number), "{number} is in no CSV");
            found += 1;
        }
    }
    found
}

/// `--only` runs one experiment; the report is written once all are complete.
#[test]
fn only_one() {
    let (place, all) = (workshop(), workshop());
    let (code, out, err) = figures(place.path(), &["--only", "power"]);
    assert_eq!(code, 0, "{err}");
    assert_eq!(note(&out, "power"), "written");
    assert!(!out.contains("at_rest"), "{out}");
    assert!(
        err.contains("README.md: not written: no complete results of at_rest"),
        "{err}"
    );
    assert!(!place.path().join("results/README.md").exists());
    let out = run(place.path(), &["--only", "at_rest"]);
    assert!(out.contains("README.md  written"), "{out}");
    run(all.path(), &[]);
    let report = |place: &Path| read(place, "results/README.md");
    assert_eq!(report(place.path()), report(all.path()));
}

/// Changed words need no simulation; a claim about other points, or another seed, does.
#[test]
fn changes_cost_what_they_must() {
    let place = workshop();
    run(place.path(), &[]);
    let points = read(place.path(), "results/power/points.csv");
    let config = place.path().join("configs/power.toml");
    let change = |from: &str, to: &str| {
        let text = fs::read_to_string(&config).unwrap();
        assert!(text.contains(from));
        fs::write(&config, text.replace(from, to)).unwrap();
        let out = run(place.path(), &["--only", "power"]);
        note(&out, "power").to_owned()
    };
    assert_eq!(change("title = \"Power\"", "title = \"Might\""), "redrawn");
    assert!(read(place.path(), "results/README.md").contains("## Might"));
    // Another level gives other intervals from the same counts.
    let comparisons = read(place.path(), "results/power/comparisons.csv");
    assert_eq!(
        change("margin = 0.05", "margin = 0.04\nlevel = 0.05"),
        "redrawn"
    );
    assert_ne!(
        read(place.path(), "results/power/comparisons.csv"),
        comparisons
    );
    // A renamed curve is the same curve.
    assert_eq!(change("loud", "noisy"), "redrawn");
    assert!(read(place.path(), "results/power/comparisons.csv").contains("noisy"));
    assert_eq!(
        read(place.path(), "results/power/points.csv"),
        points.replace("loud", "noisy")
    );
    // These points have not been compared before: they are counted again, with the same result.
    let pair = "first = \"quiet\", second = \"noisy\"";
    let swapped = "first = \"noisy\", second = \"quiet\"";
    assert_eq!(change(pair, swapped), "written");
    assert_eq!(change("seed = 5", "seed = 6"), "written");
    let manifest = read(place.path(), "results/power/run.json");
    assert!(manifest.contains("--seed 6"), "{manifest}");
    // Without claims nothing is compared, and no file of comparisons is left.
    let text = fs::read_to_string(&config).unwrap();
    fs::write(&config, text.split("[[claim]]").next().unwrap()).unwrap();
    assert_eq!(note(&run(place.path(), &[]), "power"), "redrawn");
    assert!(!place.path().join("results/power/comparisons.csv").exists());
}

/// Any damaged, missing or shortened file is made again.
#[test]
fn damaged_results_are_rebuilt() {
    let place = workshop();
    run(place.path(), &[]);
    let report = read(place.path(), "results/README.md");
    for (name, expected) in [
        ("points.csv", "written"),
        ("comparisons.csv", "written"),
        ("figure.svg", "redrawn"),
        ("run.json", "unchanged"),
    ] {
        let path = place.path().join("results/power").join(name);
        let whole = fs::read(&path).unwrap();
        let damaged = String::from_utf8_lossy(&whole[..whole.len() - 20]).into_owned();
        fs::write(&path, damaged).unwrap();
        let out = run(place.path(), &[]);
        assert_eq!(note(&out, "power"), expected, "{name}");
        assert_eq!(note(&out, "at_rest"), "skipped", "{name}");
        if name != "run.json" {
            assert!(fs::read(&path).unwrap() == whole, "{name}");
        }
    }
    assert_eq!(read(place.path(), "results/README.md"), report);
}

/// Errors are reported before the first trial, and no results are lost.
#[test]
fn refusals() {
    let place = workshop();
    let refused = |arguments: &[&str], expected: &str| {
        let (code, out, err) = figures(place.path(), arguments);
        assert_eq!((code, out.as_str()), (2, ""), "{arguments:?}: {err}");
        assert!(err.contains(expected), "{arguments:?}: {err}");
    };
    refused(
        &["--only", "pwoer"],
        "--only: no config pwoer in configs (one of at_rest, power)",
    );
    refused(&["--configs", "nowhere"], "nowhere: cannot be read");
    fs::create_dir(place.path().join("empty")).unwrap();
    refused(&["--configs", "empty"], "empty: holds no config");
    refused(&["--trials", "0"], "--trials");
    fs::create_dir_all(place.path().join("results/power")).unwrap();
    fs::write(place.path().join("results/power/points.csv"), "x\n").unwrap();
    refused(&[], "holds points.csv, but no run.json");
    assert!(!place.path().join("results/at_rest").exists());
    run(place.path(), &["--fresh"]);
    refused(
        &["--trials", "100"],
        "trials per point, more than the 100 asked for",
    );
    fs::write(place.path().join("configs/bad.toml"), "question = \"?\"\n").unwrap();
    refused(&[], "bad.toml");
    // A broken config prevents the report, but not the experiment asked for.
    let (code, _, err) = figures(place.path(), &["--only", "power"]);
    assert!(
        code == 0 && err.contains("no complete results of bad"),
        "{err}"
    );
}

/// `sweep` and `figures` leave the same files.
#[test]
fn sweep_writes_the_same() {
    let place = workshop();
    run(place.path(), &[]);
    let mut sweep = liftsim();
    sweep
        .current_dir(place.path())
        .args(["sweep", "configs/power.toml", "--out", "swept"]);
    assert_eq!(outcome(&mut sweep).0, 0);
    for name in ["points.csv", "comparisons.csv", "figure.png", "figure.svg"] {
        let bytes = |directory: &str| fs::read(place.path().join(directory).join(name)).unwrap();
        assert!(bytes("swept") == bytes("results/power"), "{name}");
    }
}

/// What somebody else has written among the results is not written over unasked.
#[test]
fn a_readme_that_is_no_report_stays() {
    let place = workshop();
    let results = place.path().join("results");
    fs::create_dir(&results).unwrap();
    fs::write(results.join("README.md"), "My notes\n").unwrap();
    let (code, out, err) = figures(place.path(), &[]);
    assert_eq!((code, out.as_str()), (2, ""), "nothing was run");
    let refused = "README.md: is not a report of liftsim";
    assert!(err.contains(refused) && err.contains("--force"), "{err}");
    assert_eq!(read(place.path(), "results/README.md"), "My notes\n");
    run(place.path(), &["--force", "--trials", "500"]);
    assert!(read(place.path(), "results/README.md").starts_with("# Reproduction report"));
    run(place.path(), &["--trials", "500"]);
}
