//! `order = "auto"`: sweeps in which each trial chooses the order of its filter.

use super::{liftsim, outcome};
use std::fs;
use std::path::Path;

const CONFIG: &str = r#"
question = "Does every fit and every rule take a filter of the order that the trial chooses?"
seed = 5
trials = 500
pilot = 1000
[axis]
delta = [0.5, 1.0, 1.5, 2.0]
[whitening]
order = "auto"
[detector]
alpha = 0.05
[[curve]]
label = "least squares"
[[curve]]
label = "Burg"
whitening = { fit = "burg" }
[[curve]]
label = "Yule-Walker, digitised"
whitening = { fit = "yule-walker", training = 30 }
noise = { law = "laplace", quantum = 0.5 }
samples = { gap = 2, decimation = 2 }
[[curve]]
label = "X inside"
whitening = { includes_reference = true }
[[curve]]
label = "likelihood ratio"
detector = { rule = "likelihood-ratio" }
[[curve]]
label = "calibrated"
detector = { calibrate = true }
[[curve]]
label = "clairvoyant"
detector = { rule = "clairvoyant", calibrate = {} }
[[curve]]
label = "order 2"
whitening = { order = 2 }
"#;

fn sweep(directory: &Path, out: &str, threads: &str, vectors: &str) -> String {
    let arguments = [
        "--quiet",
        "sweep",
        "auto.toml",
        "--out",
        out,
        "--threads",
        threads,
    ];
    let mut command = liftsim();
    command.current_dir(directory).args(arguments);
    let (code, _, err) = outcome(command.env("LIFTSIM_VECTORS", vectors));
    assert_eq!((code, err.as_str()), (0, ""));
    fs::read_to_string(directory.join(out).join("points.csv")).unwrap()
}

/// The same bytes on 1, 2 and 7 threads and at every vector width, with and without shared noise.
#[test]
fn counts_are_the_same_on_any_machine() {
    for shared in ["", "common_random_numbers = false\n"] {
        let directory = tempfile::tempdir().unwrap();
        let directory = directory.path();
        fs::write(directory.join("auto.toml"), format!("{shared}{CONFIG}")).unwrap();
        let expected = sweep(directory, "first", "1", "baseline");
        for (threads, vectors) in [("2", "avx2"), ("7", "avx512"), ("1", "avx512")] {
            let counted = sweep(directory, &format!("{threads} {vectors}"), threads, vectors);
            assert!(counted == expected, "{threads} threads, {vectors}");
        }
    }
}

/// Rows with `auto` can be read: a finished sweep simulates nothing, and its picture is drawn again.
#[test]
fn rows_say_auto() {
    let directory = tempfile::tempdir().unwrap();
    let directory = directory.path();
    fs::write(directory.join("auto.toml"), CONFIG).unwrap();
    let counted = sweep(directory, "out", "2", "avx512");
    let rows: Vec<Vec<&str>> = (counted.lines())
        .map(|line| line.split(',').collect())
        .collect();
    let order = rows[0].iter().position(|cell| *cell == "order").unwrap();
    let fixed = rows[0].iter().position(|cell| *cell == "label").unwrap();
    for row in &rows[1..] {
        // A label with a comma is two cells.
        let shift = row.len() - rows[0].len();
        let expected = if row[fixed] == "order 2" { "2" } else { "auto" };
        assert_eq!(row[order + shift], expected, "{row:?}");
    }
    assert_eq!(sweep(directory, "out", "2", "avx512"), counted);
    let picture = directory.join("out/figure.svg");
    let drawn = fs::read_to_string(&picture).unwrap();
    fs::remove_file(&picture).unwrap();
    let (code, _, err) = outcome(liftsim().arg("plot").arg(directory.join("out")));
    assert_eq!((code, err.as_str()), (0, ""));
    assert_eq!(fs::read_to_string(&picture).unwrap(), drawn);
}
