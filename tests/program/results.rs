//! The same config and seed give the same bytes, whatever the threads, the clock or the directory.

use super::{liftsim, outcome, project};
use std::fs;
use std::path::Path;

const FILES: [&str; 3] = ["points.csv", "figure.png", "figure.svg"];

fn sweep(out: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = liftsim();
    command.args(["sweep", "configs/fig6.toml", "--trials", "4000", "--out"]);
    outcome(command.arg(out).args(arguments))
}

fn read(directory: &Path, name: &str) -> Vec<u8> {
    fs::read(directory.join(name)).expect("the sweep wrote it")
}

/// Golden counts on 1, 2 and 7 threads. A change of these bytes is a change of results: say so in
/// the CHANGELOG.
#[test]
fn golden_counts_on_any_number_of_threads() {
    let golden = fs::read(project().join("tests/program/golden/fig6.csv")).unwrap();
    for threads in ["1", "2", "7"] {
        let directory = tempfile::tempdir().unwrap();
        let (code, _, err) = sweep(directory.path(), &["--threads", threads]);
        assert_eq!((code, err.as_str()), (0, ""));
        let counted = read(directory.path(), "points.csv");
        assert!(
            counted == golden,
            "{threads} threads: counts differ from the golden ones"
        );
    }
}

/// Another time zone, locale, working directory and number of threads by the environment.
#[test]
fn same_bytes_in_another_environment() {
    let (here, there) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    assert_eq!(sweep(here.path(), &[]).0, 0);
    let mut elsewhere = liftsim();
    elsewhere
        .current_dir(there.path())
        .env("RAYON_NUM_THREADS", "1")
        .env("TZ", "Pacific/Kiritimati")
        .env("LC_ALL", "ru_RU.UTF-8")
        .env("LIFTSIM_VECTORS", "baseline")
        .args(["sweep", "--trials", "4000", "--out", "."])
        .arg(project().join("configs/fig6.toml"));
    assert_eq!(outcome(&mut elsewhere).0, 0);
    for name in FILES {
        assert!(
            read(here.path(), name) == read(there.path(), name),
            "{name}"
        );
    }
    let manifest = fs::read_to_string(there.path().join("run.json")).unwrap();
    let root = project().to_str().unwrap();
    assert!(
        !manifest.contains(root),
        "a manifest holds no absolute path"
    );
}

#[test]
fn plot_draws_the_same_picture_from_the_counts() {
    let directory = tempfile::tempdir().unwrap();
    assert_eq!(sweep(directory.path(), &[]).0, 0);
    let drawn: Vec<Vec<u8>> = FILES
        .iter()
        .map(|name| read(directory.path(), name))
        .collect();
    for name in ["figure.png", "figure.svg"] {
        fs::remove_file(directory.path().join(name)).unwrap();
    }
    let (code, out, err) = outcome(liftsim().arg("plot").arg(directory.path()));
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    for (name, bytes) in FILES.iter().zip(drawn) {
        assert!(read(directory.path(), name) == bytes, "{name}");
    }
}

/// More trials extend a result, labels do not matter, and any other change is refused.
#[test]
fn results_of_another_experiment_are_kept() {
    let directory = tempfile::tempdir().unwrap();
    assert_eq!(sweep(directory.path(), &[]).0, 0);
    let before = read(directory.path(), "points.csv");

    let (code, _, err) = sweep(directory.path(), &["--seed", "7"]);
    assert_eq!(code, 2);
    assert!(
        err.contains("seed is 2014 there, 7 here") && err.contains("--fresh"),
        "{err}"
    );

    let mut fewer = liftsim();
    fewer
        .args(["sweep", "configs/fig6.toml", "--trials", "3999", "--out"])
        .arg(directory.path());
    let (code, _, err) = outcome(&mut fewer);
    assert_eq!(code, 2);
    assert!(
        err.contains("holds 4000 trials per point, more than the 3999"),
        "{err}"
    );

    let changed = fs::read_to_string(project().join("configs/fig6.toml")).unwrap();
    let path = directory.path().join("changed.toml");
    fs::write(
        &path,
        changed.replace("nu = 0.3, theta = 1.0", "nu = 0.3, theta = 1.5"),
    )
    .unwrap();
    let other = |extra: &[&str]| {
        let mut other = liftsim();
        other
            .arg("sweep")
            .arg(&path)
            .args(["--trials", "4000", "--out"])
            .arg(directory.path())
            .args(extra);
        outcome(&mut other)
    };
    let (code, _, err) = other(&[]);
    assert_eq!(code, 2);
    assert!(err.contains("theta is 1 there, 1.5 here"), "{err}");
    assert!(read(directory.path(), "points.csv") == before);

    assert_eq!(other(&["--fresh"]).0, 0);
    assert!(read(directory.path(), "points.csv") != before);
}

/// Every committed config has its committed results, and there are no others.
#[test]
fn manifests_vouch_for_the_files_beside_them() {
    let mut stems: Vec<String> = fs::read_dir(project().join("configs"))
        .unwrap()
        .filter_map(|entry| {
            Some(
                entry
                    .ok()?
                    .file_name()
                    .to_str()?
                    .strip_suffix(".toml")?
                    .to_owned(),
            )
        })
        .collect();
    stems.sort();
    assert!(stems.len() > 25);
    for name in &stems {
        let directory = liftsim::results::Directory::new(project().join("results").join(name));
        let manifest = directory.manifest().unwrap();
        let config = fs::read(project().join(format!("configs/{name}.toml"))).unwrap();
        assert_eq!(
            manifest.config_sha256,
            liftsim::results::sha256(&config),
            "{name}"
        );
        assert!(directory.is_intact(&manifest), "{name}");
        let files = fs::read_dir(directory.path()).unwrap().count();
        assert_eq!(files, manifest.files.len() + 1, "{name}");
    }
    let directories = fs::read_dir(project().join("results")).unwrap();
    let directories = directories.filter(|entry| entry.as_ref().unwrap().path().is_dir());
    assert_eq!(directories.count(), stems.len());
}

/// A curve or a point that is left out of a finished sweep costs nothing, and the others keep their counts.
#[test]
fn what_is_left_out_is_dropped() {
    let folder = tempfile::tempdir().unwrap();
    let swept = |values: &str, curves: &[&str]| {
        let curves = curves.iter().map(|nu| {
            format!("[[curve]]\nlabel = \"{nu}\"\nimpulses = {{ nu = {nu}, theta = 3.0 }}\n")
        });
        let text = format!(
            "question = \"?\"\nseed = 7\ntrials = 500\n[axis]\ndelta = {values}\n{}",
            curves.collect::<String>()
        );
        fs::write(folder.path().join("it.toml"), text).unwrap();
        let mut command = liftsim();
        command.current_dir(folder.path());
        let (code, _, progress) = outcome(command.args(["sweep", "it.toml", "--json"]));
        assert_eq!(code, 0, "{progress}");
        let points = fs::read_to_string(folder.path().join("results/it/points.csv")).unwrap();
        (progress.contains("\"total\":0,"), points)
    };
    let (_, all) = swept("[0.0, 0.5, 1.0]", &["0.1", "0.2", "0.3"]);
    for (values, curves) in [
        ("[0.0, 0.5, 1.0]", &["0.1", "0.3"][..]),
        ("[0.0, 1.0]", &["0.1", "0.3"]),
    ] {
        let (is_free, points) = swept(values, curves);
        assert!(is_free);
        // All but the number of the curve.
        let cells = |line: &str| line.split_once(',').unwrap().1.to_owned();
        let known: Vec<String> = all.lines().map(cells).collect();
        assert!(
            points.lines().all(|line| known.contains(&cells(line))),
            "{points}"
        );
    }
}
