//! The installed program in a folder without a checkout: shipped configs by name, `new`, `keys NAME`.

use super::{outcome, project};
use assert_cmd::Command;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

fn liftsim(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::cargo_bin("liftsim").expect("the binary is built with the tests");
    outcome(command.current_dir(folder).arg("--quiet").args(arguments))
}

/// The configs of a folder, by name.
fn configs(folder: &str) -> BTreeSet<String> {
    let entries = fs::read_dir(project().join(folder)).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let configs = paths.filter(|path| path.extension().is_some_and(|end| end == "toml"));
    let name = |path: std::path::PathBuf| path.file_stem().unwrap().to_str().unwrap().to_owned();
    configs.map(name).collect()
}

#[test]
fn every_config_is_shipped_and_listed() {
    let folder = tempfile::tempdir().unwrap();
    let (code, list, _) = liftsim(folder.path(), &["new"]);
    assert_eq!(code, 0);
    let first = |line: &str| line.split_whitespace().next().unwrap_or("").to_owned();
    let listed: BTreeSet<String> = list.lines().map(first).collect();
    let all = &configs("configs") | &configs("configs/simulate");
    assert!(all.len() > 50 && all.is_subset(&listed), "{list}");
    for name in &all {
        assert_eq!(liftsim(folder.path(), &["new", name]).0, 0, "{name}");
        let written = fs::read(folder.path().join(format!("{name}.toml"))).unwrap();
        let there = ["configs", "configs/simulate"]
            .map(|of| project().join(of).join(format!("{name}.toml")));
        let original = there.iter().find_map(|path| fs::read(path).ok());
        assert_eq!(Some(written), original, "{name}");
    }
}

#[test]
fn no_file_is_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fig6.toml");
    fs::write(&path, "mine").unwrap();
    for arguments in [
        &["new", "fig6"][..],
        &["new", "fig6.toml", "--like", "fig5"],
    ] {
        let (code, _, error) = liftsim(folder.path(), arguments);
        assert_eq!(code, 2);
        assert!(error.contains("fig6.toml: already exists"), "{error}");
        assert_eq!(fs::read(&path).unwrap(), b"mine");
    }
}

/// A shipped config by name, its file of this name, and the original give the same bytes.
#[test]
fn a_name_runs_what_its_file_runs() {
    let folder = tempfile::tempdir().unwrap();
    let run = |config: &str| {
        let arguments = [
            "sweep", config, "--trials", "200", "--fresh", "--out", "out",
        ];
        let (code, _, error) = liftsim(folder.path(), &arguments);
        assert_eq!(code, 0, "{error}");
        ["points.csv", "figure.png"]
            .map(|file| fs::read(folder.path().join("out").join(file)).unwrap())
    };
    let original = run(project().join("configs/fig6.toml").to_str().unwrap());
    assert!(run("fig6") == original);
    assert_eq!(liftsim(folder.path(), &["new", "fig6"]).0, 0);
    assert!(run("fig6.toml") == original);
    // A file of one's own goes before the shipped one.
    let text = fs::read_to_string(folder.path().join("fig6.toml")).unwrap();
    let changed = text.replace("seed = 2014", "seed = 2015");
    fs::write(folder.path().join("fig6.toml"), changed).unwrap();
    assert!(run("fig6")[0] != original[0]);
}

#[test]
fn a_study_is_begun_planned_run_and_judged() {
    let folder = tempfile::tempdir().unwrap();
    let ran = |arguments: &[&str]| {
        let (code, text, error) = liftsim(folder.path(), arguments);
        assert_eq!(code, 0, "{arguments:?}: {error}");
        text
    };
    ran(&["new", "my_study", "--like", "fig6"]);
    assert!(ran(&["plan", "my_study"]).contains("trials"));
    let said = ran(&["sweep", "my_study", "--trials", "2000"]);
    let claim = "Frequent strong impulses lower D once the acceleration is strong";
    assert!(said.contains(claim) && said.contains("undecided"), "{said}");
    assert!(
        said.contains("trials per point decide it (--trials)"),
        "{said}"
    );
    assert!(folder.path().join("results/my_study/figure.png").exists());
    // Nothing is left to simulate, and the verdicts are said again.
    assert!(ran(&["sweep", "my_study", "--trials", "2000"]).contains("decide it (--trials)"));
}

/// A name stays that of the shipped config beside a folder of results; and a copy of a ride can be copied.
#[test]
fn names_are_not_confused() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("fig6")).unwrap();
    let ran =
        |arguments: &[&str]| assert_eq!(liftsim(folder.path(), arguments).0, 0, "{arguments:?}");
    ran(&["sweep", "fig6", "--trials", "50"]);
    ran(&["new", "house", "--like", "ride"]);
    ran(&["new", "other", "--like", "house.toml"]);
    ran(&["simulate", "other", "--out", "other.csv"]);
}

/// What the copy says of further keys is a config with those defaults.
#[test]
fn the_commented_sections_are_the_defaults() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(
        liftsim(folder.path(), &["new", "mine", "--like", "fig6"]).0,
        0
    );
    let text = fs::read_to_string(folder.path().join("mine.toml")).unwrap();
    let (_, sections) = text.split_once("# All sections").unwrap();
    let lines = sections
        .lines()
        .skip(2)
        .map(|line| line.trim_start_matches(['#', ' ']));
    // What the axis sweeps cannot be set too.
    let is_set = |line: &&str| !line.contains("= …") && !line.starts_with("delta = ");
    let set: Vec<&str> = lines.filter(is_set).collect();
    assert!(set.contains(&"[whitening]") && set.len() > 25, "{set:?}");
    let plain = "question = \"?\"\nseed = 1\ntrials = 300\n[axis]\ndelta = [0.0, 1.0]\n";
    let counted = |sections: &str| {
        let path = folder.path().join("both.toml");
        fs::write(&path, format!("{plain}{sections}\n")).unwrap();
        let (code, _, error) = liftsim(folder.path(), &["sweep", "both.toml", "--fresh"]);
        assert_eq!(code, 0, "{error}");
        fs::read(folder.path().join("results/both/points.csv")).unwrap()
    };
    assert!(counted("") == counted(&set.join("\n")));
}

#[test]
fn what_is_not_there_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |arguments: &[&str], words: &[&str]| {
        let (code, _, error) = liftsim(folder.path(), arguments);
        assert_eq!(code, 2, "{arguments:?}");
        for word in words {
            assert!(error.contains(word), "{arguments:?}: {error}");
        }
    };
    refused(
        &["sweep", "fig7"],
        &["fig7: no such file", "did you mean `fig"],
    );
    refused(
        &["sweep", "elsewhere/fig6"],
        &["`fig6` alone is the shipped config"],
    );
    refused(
        &["sweep", "fig6.toml"],
        &["`fig6` alone is the shipped config"],
    );
    refused(&["sweep", "ride"], &["is for `liftsim simulate`"]);
    refused(
        &["simulate", "fig6", "--out", "x.csv"],
        &["is for `liftsim sweep`"],
    );
    refused(&["monitor", "--config", "fig6"], &["fig6: cannot be read"]);
    refused(&["sweep", "fig6", "--force"], &["--save-trials"]);
    refused(&["new", "fgi6"], &["did you mean fig6?", "--like"]);
    refused(
        &["new", "my_study"],
        &["no shipped config is called my_study", "--like fig6"],
    );
    refused(&["new", "fig6.csv"], &["NAME must end in .toml"]);
    refused(
        &["new", "mine", "--like", "fig66"],
        &["did you mean `fig6`"],
    );
    refused(
        &["keys", "trianing"],
        &["did you mean training?", "`liftsim keys` lists all"],
    );
}

#[test]
fn keys_are_found_by_table_or_name() {
    let folder = tempfile::tempdir().unwrap();
    let text = |name: &str| liftsim(folder.path(), &["keys", name]).1;
    let whitening = text("whitening");
    assert!(whitening.contains("## [whitening]") && whitening.contains("| `training` |"));
    assert!(!whitening.contains("## [axis]"), "{whitening}");
    assert_eq!(whitening, text("[whitening]"));
    let training = text("training");
    for table in ["[axis]", "[whitening]"] {
        assert!(training.contains(&format!("## {table}")), "{training}");
    }
    assert!(!training.contains("`order`"), "{training}");
}

/// Places in a message are under what they mean, whatever the width of its characters, and a config may come from any
/// editor.
#[test]
fn carets_stand_where_the_eye_sees_them() {
    let folder = tempfile::tempdir().unwrap();
    let head = "question = \"?\"\nseed = 1\n[axis]\ndelta = [1.0]\n[[curve]]\n";
    let shown = |line: &str| {
        fs::write(folder.path().join("bad.toml"), format!("{head}{line}\n")).unwrap();
        let (code, _, error) = liftsim(folder.path(), &["sweep", "bad.toml"]);
        assert_eq!(code, 2);
        error.lines().skip(1).map(str::to_owned).collect::<Vec<_>>()
    };
    // Chinese characters are two columns wide; a tab is shown as one blank. TOML wants a line for each key.
    let lines = shown("label = \"电梯\"\timpulses = 5");
    assert_eq!(
        lines.last().map(|line| line.find('^')),
        Some(Some(20)),
        "{lines:?}"
    );
    let lines = shown("impulses = { nu = 0.1,\ttheta = -2.0 }");
    assert!(lines[1].contains("nu = 0.1, theta"), "{lines:?}");
    assert_eq!(lines[1].find("-2.0"), lines[2].find('^'), "{lines:?}");
}

#[test]
fn configs_of_any_editor_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let text = "question = \"Δ?\"\nseed = 1\ntrials = 50\n[axis]\ndelta = [1.0]\n";
    let utf16 = |order: fn(u16) -> [u8; 2]| {
        let units = std::iter::once(0xFEFF).chain(text.encode_utf16());
        units.flat_map(order).collect::<Vec<u8>>()
    };
    let written = |bytes: Vec<u8>| {
        fs::write(folder.path().join("it.toml"), bytes).unwrap();
        let (code, _, error) = liftsim(folder.path(), &["sweep", "it.toml", "--fresh"]);
        assert_eq!(code, 0, "{error}");
        fs::read(folder.path().join("results/it/points.csv")).unwrap()
    };
    let plain = written(text.into());
    for bytes in [
        format!("\u{feff}{text}").into_bytes(),
        text.replace('\n', "\r\n").into_bytes(),
        utf16(u16::to_le_bytes),
        utf16(u16::to_be_bytes),
    ] {
        assert!(written(bytes) == plain);
    }
    // A byte that is no text, after either mark or none, and half a character of UTF-16.
    for bytes in [
        &b"question = \"\xff\""[..],
        b"\xef\xbb\xbfquestion = \"\xff\"",
        b"\xff\xfe\x00\xd8q\x00",
        b"\xff\xfeq",
    ] {
        fs::write(folder.path().join("it.toml"), bytes).unwrap();
        let (code, _, error) = liftsim(folder.path(), &["sweep", "it.toml"]);
        assert_eq!(code, 2);
        assert!(error.contains("save it as UTF-8"), "{error}");
    }
}
