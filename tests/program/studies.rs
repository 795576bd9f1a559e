//! Studies other than sweeps: run, drawn again, and kept apart.

use super::{liftsim, outcome, project};
use liftsim::results::{Directory, sha256};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Each config, and the head of its rows.
const STUDIES: [(&str, &str); 9] = [
    ("fig1", "lag,theory,exact_transfer,estimate,low,high"),
    (
        "fig2",
        "time,phase,record,whitened,sample,acceleration,impulse",
    ),
    (
        "fig3_4",
        "time,phase,record,whitened,sample,acceleration,impulse",
    ),
    ("fig5", "name,start,end"),
    ("regions", "rule,size,exceedances,lower,upper"),
    (
        "independence",
        "reference,shift,scale,rank_sum,exceedances,count,product,joint",
    ),
    ("impulse_law", "nu,sample,trials,zero_sum,zero_sum_count"),
    (
        "field",
        "all_samples,alpha,size,power,delta,low,high,trials,confidence",
    ),
    (
        "ride_rate",
        "curve,label,axis,x,outcome,count,exposure,unit,estimate,low,high,trials,confidence,measure",
    ),
];

fn sweep(name: &str, out: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = liftsim();
    command.arg("sweep").arg(format!("configs/{name}.toml"));
    command.args(["--trials", "50", "--out"]).arg(out);
    outcome(command.args(arguments))
}

/// Every file listed in `run.json`.
fn files(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    let manifest = Directory::new(directory).manifest().unwrap();
    let mut files = BTreeMap::new();
    for (name, hash) in manifest.files {
        let bytes = fs::read(directory.join(&name)).unwrap();
        assert_eq!(hash, sha256(&bytes), "{name}");
        files.insert(name, bytes);
    }
    files
}

/// Same bytes on 1, 2 and 7 threads, and again from the rows alone.
#[test]
fn studies_run_and_redraw_to_the_byte() {
    for (name, head) in STUDIES {
        let directory = tempfile::tempdir().unwrap();
        let (code, out, err) = sweep(name, directory.path(), &["--threads", "1"]);
        assert_eq!((code, err.as_str()), (0, ""), "{name}: {out}");
        let first = files(directory.path());
        assert!(first["points.csv"].starts_with(head.as_bytes()), "{name}");
        assert!(first["figure.png"].starts_with(b"\x89PNG"));
        for threads in ["2", "7"] {
            let again = ["--fresh", "--threads", threads];
            let (code, out, err) = sweep(name, directory.path(), &again);
            assert_eq!((code, err.as_str()), (0, ""), "{name}");
            assert!(!out.contains("figure.png  written"), "{name}: {out}");
            assert!(
                files(directory.path()) == first,
                "{name}: {threads} threads"
            );
        }
        fs::remove_file(directory.path().join("figure.png")).unwrap();
        fs::remove_file(directory.path().join("figure.svg")).unwrap();
        let (code, _, err) = outcome(liftsim().arg("plot").arg(directory.path()));
        assert_eq!((code, err.as_str()), (0, ""), "{name}");
        assert!(files(directory.path()) == first, "{name}: drawn again");
    }
}

/// The numbers that do not depend on the trials. A change of them is a change of results.
#[test]
fn exact_quantities() {
    let mut exact = String::new();
    for name in ["fig1", "fig3_4", "independence", "impulse_law"] {
        let directory = tempfile::tempdir().unwrap();
        assert_eq!(sweep(name, directory.path(), &[]).0, 0);
        let text = fs::read_to_string(directory.path().join("quantities.csv")).unwrap();
        for line in text.lines().filter(|line| !line.contains("deviation")) {
            exact += &format!("{name}: {line}\n");
        }
    }
    insta::assert_snapshot!("exact_quantities", exact);
}

#[test]
fn independence_prints_a_table() {
    let directory = tempfile::tempdir().unwrap();
    let (code, out, _) = sweep("independence", directory.path(), &[]);
    assert_eq!(code, 0);
    let table = out.split("\n\n").next().unwrap();
    insta::assert_snapshot!("independence", table);
}

/// More trials extend a result and a new question changes nothing; anything else is refused.
#[test]
fn results_of_another_study_are_kept() {
    let directory = tempfile::tempdir().unwrap();
    assert_eq!(sweep("fig1", directory.path(), &[]).0, 0);
    let before = files(directory.path());
    let refused = |(code, out, err): (i32, String, String), words: &str| {
        assert_eq!((code, out.as_str()), (2, ""), "{err}");
        assert!(err.contains(words) && err.contains("--fresh"), "{err}");
    };
    let seed = sweep("fig1", directory.path(), &["--seed", "7"]);
    refused(seed, "seed is 2014 there, 7 here");
    let kind = sweep("fig5", directory.path(), &[]);
    refused(kind, "[autocorrelation] there, [layout] here");
    let axis = sweep("fig6", directory.path(), &[]);
    refused(axis, "[autocorrelation] there, [axis] here");

    let text = fs::read_to_string(project().join("configs/fig1.toml")).unwrap();
    let path = directory.path().join("changed.toml");
    let changed = |from: &str, to: &str, trials: &str| {
        fs::write(&path, text.replace(from, to)).unwrap();
        let mut command = liftsim();
        command.arg("sweep").arg(&path);
        command.args(["--trials", trials, "--out"]);
        outcome(command.arg(directory.path()))
    };
    let fewer = changed("", "", "49");
    refused(fewer, "holds 50 trials per point, more than the 49");
    let lags = changed("lags = 40", "lags = 30", "50");
    refused(lags, "lags is 40 there, 30 here");
    let sensor = changed("model = \"adxl105\"", "ar = [0.5]", "50");
    refused(sensor, "sensor is ar(-1.5365 -0.75056) there, ar(0.5) here");
    assert!(files(directory.path()) == before);

    let rows = || files(directory.path())["points.csv"].clone();
    assert_eq!(changed("Does the", "Has the", "50").0, 0);
    assert!(rows() == before["points.csv"]);
    assert_eq!(changed("", "", "60").0, 0);
    assert!(rows() != before["points.csv"]);
    assert_eq!(sweep("fig5", directory.path(), &["--fresh"]).0, 0);
}

/// A sweep's directory is not given to another study either.
#[test]
fn results_of_a_sweep_are_kept_from_another_study() {
    let directory = tempfile::tempdir().unwrap();
    assert_eq!(sweep("fig6", directory.path(), &[]).0, 0);
    let (code, _, err) = sweep("fig1", directory.path(), &[]);
    assert_eq!(code, 2);
    assert!(
        err.contains("[axis] there, [autocorrelation] here"),
        "{err}"
    );
}

/// A command that needs a sweep says so, and so does one with too few trials.
#[test]
fn verbs_that_need_a_sweep() {
    let (code, out, err) = outcome(liftsim().args(["check", "configs/fig5.toml"]));
    assert_eq!((code, out.as_str()), (2, ""), "{err}");
    let words = "[layout] says what to draw, but nothing is swept here";
    assert!(
        err.contains("configs/fig5.toml:17:1") && err.contains(words),
        "{err}"
    );
    let shard = ["sweep", "configs/fig5.toml", "--shard", "1/2"];
    let (code, _, err) = outcome(liftsim().args(shard));
    assert_eq!(code, 2);
    assert!(err.contains("[layout] counts no trials"), "{err}");
    let one = ["sweep", "configs/fig1.toml", "--trials", "1"];
    let (code, _, err) = outcome(liftsim().args(one));
    assert_eq!(code, 2);
    assert!(err.contains("trials: must be at least 2, got 1"), "{err}");
}

/// Every study can be planned.
#[test]
fn studies_are_planned() {
    for (name, _) in STUDIES {
        let config = format!("configs/{name}.toml");
        let (code, out, err) = outcome(liftsim().args(["plan", &config, "--trials", "20"]));
        assert_eq!((code, err.as_str()), (0, ""), "{name}: {out}");
        let json = outcome(liftsim().args(["plan", &config, "--trials", "20", "--json"])).1;
        let facts: serde_json::Value = serde_json::from_str(&json).unwrap();
        assert!(facts["study"].is_string(), "{json}");
    }
}

/// Rows changed by hand are not drawn.
#[test]
fn changed_rows_are_not_drawn() {
    let directory = tempfile::tempdir().unwrap();
    assert_eq!(sweep("fig5", directory.path(), &[]).0, 0);
    fs::write(directory.path().join("points.csv"), "name,start,end\n").unwrap();
    let (code, _, err) = outcome(liftsim().arg("plot").arg(directory.path()));
    assert_eq!(code, 2);
    assert!(
        err.contains("its bytes are not those that run.json vouches for"),
        "{err}"
    );
}

/// Every class of records before the monitor.
#[test]
fn records_of_every_class() {
    let directory = tempfile::tempdir().unwrap();
    let mut command = liftsim();
    command.args([
        "sweep",
        "configs/ride_danger.toml",
        "--trials",
        "4",
        "--out",
    ]);
    let (code, out, err) = outcome(command.arg(directory.path()));
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert!(out.contains("21 points of 4 trials"), "{out}");
    let rows = String::from_utf8(files(directory.path())["points.csv"].clone()).unwrap();
    assert!(rows.starts_with("class,outcome,count,exposure,unit,estimate,low,high,trials"));
}
