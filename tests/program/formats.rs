//! `--format`: a result has the same numbers in every format.

use super::{config, liftsim, outcome};
use serde_json::Value;
use std::path::Path;

/// Runs a command in a folder, in which failing is a finding.
fn run(folder: &Path, arguments: &[&str], format: &str) -> String {
    let mut command = liftsim();
    command
        .current_dir(folder)
        .args(["--quiet"])
        .args(arguments);
    let (code, out, error) = outcome(command.args(["--format", format]));
    assert!(code != 2, "{arguments:?}: {error}");
    out
}

/// The rows of CSV, the first of which has the names of the columns.
fn csv(text: &str) -> Vec<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new();
    let mut reader = reader.has_headers(false).from_reader(text.as_bytes());
    let row = |row: csv::StringRecord| row.iter().map(str::to_owned).collect();
    reader
        .records()
        .map(|record| row(record.unwrap()))
        .collect()
}

fn markdown(text: &str) -> Vec<Vec<String>> {
    let cells = |line: &str| {
        let line = line.strip_prefix("| ").unwrap().strip_suffix(" |").unwrap();
        line.split(" | ").map(str::to_owned).collect()
    };
    let lines = text.lines().filter(|line| !line.starts_with("|---"));
    lines.map(cells).collect()
}

/// A value as a cell.
fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        value => value.to_string(),
    }
}

/// Runs a command in every format. Its rows in JSON are in these lists. The text has these columns with so many decimals, or
/// as they are.
fn agree(folder: &Path, arguments: &[&str], lists: &[&str], shown: &[(&str, Option<usize>)]) {
    let json: Value = serde_json::from_str(&run(folder, arguments, "json")).unwrap();
    let objects: Vec<&Value> = match (&json, lists) {
        (Value::Array(rows), _) => rows.iter().collect(),
        (object, []) => vec![object],
        _ => (lists.iter())
            .flat_map(|list| json[list].as_array().unwrap())
            .collect(),
    };
    let rows = csv(&run(folder, arguments, "csv"));
    assert_eq!(rows.len(), objects.len() + 1, "{arguments:?}");
    assert!(rows.len() > 1 && rows[0].len() > 5, "{rows:?}");
    let text = run(folder, arguments, "table");
    let is_in_text = |word: &str| text.split([' ', ',', '\n', '[', ']']).any(|it| it == word);
    let written = markdown(&run(folder, arguments, "markdown"));
    for (at, name) in rows[0].iter().enumerate() {
        // What a plan expects is measured anew each time.
        if name == "seconds" && lists.is_empty() {
            continue;
        }
        let mut numbers = 0;
        for ((row, markdown), object) in rows.iter().zip(&written).skip(1).zip(&objects) {
            assert_eq!(row[at], markdown[at].trim(), "{name}");
            let value = object.get(name).or_else(|| json.get(name));
            if let Some(value) = value {
                numbers += 1;
                assert_eq!(row[at], cell(value), "{name}");
                for (_, decimals) in shown.iter().filter(|(shown, _)| shown == name) {
                    let word = match decimals {
                        Some(decimals) => format!("{:.*}", decimals, value.as_f64().unwrap()),
                        None => cell(value),
                    };
                    assert!(is_in_text(&word), "{arguments:?}: {name} {word} in {text}");
                }
            }
        }
        let is_shown = shown.iter().any(|(shown, _)| shown == name);
        assert!(numbers > 0 || !is_shown, "{name}");
    }
    for (name, _) in shown {
        assert!(rows[0].iter().any(|it| it == name), "{name}");
    }
}

#[test]
fn formats_agree() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for arguments in [
        &["simulate", "ride", "--out", "ride.csv"][..],
        &["sweep", "fig6", "--trials", "300"],
    ] {
        let (code, _, error) = outcome(liftsim().current_dir(folder).args(arguments));
        assert_eq!(code, 0, "{error}");
    }
    let whole = None;
    let sizes = "threshold --reference 12 --shift 12 --scale 6 --alpha 0.01";
    let sizes: Vec<&str> = sizes.split(' ').collect();
    agree(
        folder,
        &sizes,
        &["critical"],
        &[("size", whole), ("exceedances", whole), ("upper", whole)],
    );
    agree(
        folder,
        &[
            "threshold",
            "--per-hour",
            "1",
            "--rate",
            "5",
            "--sides",
            "up,scale",
        ],
        &["first_false_alarm", "delays", "growths"],
        &[("threshold", whole)],
    );
    let plan = [
        ("trials", whole),
        ("work", whole),
        ("half_width", Some(5)),
        ("half_width_at_a_hundredth", Some(5)),
    ];
    agree(folder, &["plan", "fig6", "--trials", "300"], &[], &plan);
    agree(
        folder,
        &["status", "results/fig6"],
        &[],
        &[
            ("trials", whole),
            ("of", whole),
            ("percent", Some(1)),
            ("experiment", whole),
        ],
    );
    let times = [("start", Some(2)), ("stop", Some(2)), ("speed", Some(2))];
    agree(folder, &["detect", "ride.csv"], &["rides"], &times);
    agree(
        folder,
        &["track", "ride.csv"],
        &["rides"],
        &[("distance", Some(2)), ("stop", Some(2))],
    );
    let failing = config("reference_in_training.toml");
    let check = ["check", failing.to_str().unwrap(), "--trials", "2000"];
    let counts = [("cases", whole), ("false_alarms", whole), ("rate", Some(6))];
    agree(folder, &check, &["scenarios"], &counts);
}

/// The older flag for JSON, and both together.
#[test]
fn json_is_a_format() {
    let folder = tempfile::tempdir().unwrap();
    let sizes = "threshold --reference 9 --shift 9 --scale 9 --alpha 0.05";
    let sizes: Vec<&str> = sizes.split(' ').collect();
    let (_, out, _) = outcome(liftsim().args(&sizes).arg("--json"));
    assert_eq!(out, run(folder.path(), &sizes, "json"));
    let both = ["--json", "--format", "csv"];
    let (code, _, error) = outcome(liftsim().args(&sizes).args(both));
    assert!(
        code == 2 && error.contains("cannot be used with"),
        "{error}"
    );
}
