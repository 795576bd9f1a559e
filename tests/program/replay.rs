//! `liftsim replay`: every stage of one trial.

use super::{liftsim, outcome};
use std::collections::BTreeMap;
use std::fs;

const CONFIG: &str = r#"
question = "?"
seed = 5
trials = 24
pilot = 2000
[axis]
delta = [0.5, 1.0, 1.5, 2.0]
[[curve]]
impulses = { nu = 0.3, theta = 9.0 }
[[curve]]
noise = { law = "laplace", quantum = 0.5 }
samples = { gap = 2, decimation = 2 }
[[curve]]
detector = { rule = "student-t", calibrate = {} }
[[curve]]
whitening = { order = "auto" }
"#;

/// The values of each stage, in their order.
type Stages = BTreeMap<String, Vec<(String, f64)>>;

fn replay(config: &str, point: usize, trial: usize) -> Stages {
    let (point, trial) = (point.to_string(), trial.to_string());
    let arguments = ["replay", config, "--point", &point, "--trial", &trial];
    let (code, out, err) = outcome(liftsim().args(arguments));
    assert_eq!((code, err.as_str()), (0, ""));
    let mut stages = Stages::new();
    for line in out.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let value = (cells[1].to_owned(), cells[3].parse().unwrap());
        stages.entry(cells[0].to_owned()).or_default().push(value);
    }
    stages
}

/// The record is the sum of its parts, the whitened samples follow from it, W is the sum of the ranks of Y₁,
/// and the decisions of all trials add up to the count of the sweep.
#[test]
fn replays_are_the_trials_of_the_sweep() {
    let directory = tempfile::tempdir().unwrap();
    let config = directory.path().join("config.toml");
    fs::write(&config, CONFIG).unwrap();
    let config = config.to_str().unwrap();
    let out = directory.path().join("out");
    let sweep = ["--quiet", "sweep", config, "--out", out.to_str().unwrap()];
    assert_eq!(outcome(liftsim().args(sweep)).0, 0);
    let points = fs::read_to_string(out.join("points.csv")).unwrap();
    let rows: Vec<Vec<&str>> = points
        .lines()
        .map(|line| line.split(',').collect())
        .collect();
    let column = |name: &str| rows[0].iter().position(|cell| *cell == name).unwrap();
    let detections = column("detections");
    for (point, curve) in [(1, "1"), (3, "1"), (8, "2"), (12, "3"), (18, "4")] {
        let row = &rows[point];
        assert_eq!(row[0], curve);
        let mut detected = 0.0;
        for trial in 0..24 {
            let stages = replay(config, point, trial);
            detected += stages["h1"][0].1;
            check(&stages, if curve == "2" { 2 } else { 1 });
        }
        assert_eq!(row[detections], detected.to_string(), "point {point}");
    }
}

fn check(stages: &Stages, decimation: usize) {
    let values = |stage: &str| -> Vec<f64> { stages[stage].iter().map(|v| v.1).collect() };
    let (noise, step) = (values("noise"), values("acceleration"));
    let (impulses, record) = (values("impulse"), values("record"));
    for (i, r) in record.iter().enumerate() {
        let raw = i * decimation..(i + 1) * decimation;
        let codes = raw.map(|j| {
            let r = noise[j] + step[j] + impulses[j];
            if decimation == 2 {
                (r / 0.5).round_ties_even() * 0.5
            } else {
                r
            }
        });
        assert!((r - codes.sum::<f64>() / decimation as f64).abs() < 1e-12);
    }
    let (whitened, a) = (values("whitened"), values("coefficient"));
    let lead = record.len() - whitened.len();
    for (i, y) in whitened.iter().enumerate() {
        let past = (0..a.len()).map(|p| a[p] * record[lead + i - 1 - p]);
        assert!((y - (record[lead + i] - past.sum::<f64>())).abs() < 1e-9);
    }
    let ranks = stages["rank"]
        .iter()
        .filter(|(sample, _)| sample == "shift");
    assert_eq!(
        ranks.map(|(_, rank)| rank).sum::<f64>(),
        stages["rank_sum"][0].1
    );
    if let Some(critical) = stages.get("critical") {
        let exceeds = stages["rank_sum"][0].1 >= critical[0].1;
        assert_eq!(f64::from(u8::from(exceeds)), stages["h1"][0].1);
    }
}

#[test]
fn what_is_not_there_cannot_be_replayed() {
    let refused = |point: &str, trial: &str| {
        let arguments = [
            "replay",
            "configs/fig6.toml",
            "--point",
            point,
            "--trial",
            trial,
        ];
        let (code, _, err) = outcome(liftsim().args(arguments));
        assert_eq!(code, 2);
        err
    };
    assert!(refused("157", "0").contains("--point must lie in 1 to 156"));
    assert!(refused("1", "200000").contains("--trial must lie in 0 to 199999"));
}
