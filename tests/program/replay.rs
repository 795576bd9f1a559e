//! `liftsim replay`: every stage of one trial.

use super::{liftsim, outcome};
use std::collections::BTreeMap;
use std::fs;
use std::io::Read;
use std::path::Path;
use zip::ZipArchive;

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

/// The table of some trials and the arrays of all of them say what the stages of each trial and the counts say.
#[test]
fn trials_leave_for_other_tools() {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name).to_str().unwrap().to_owned();
    let config = path("config.toml");
    fs::write(&config, CONFIG).unwrap();
    let (out, file) = (path("out"), path("trials.npz"));
    let sweep = [
        "--quiet",
        "sweep",
        &config,
        "--out",
        &out,
        "--save-trials",
        &file,
    ];
    assert_eq!(outcome(liftsim().args(sweep)).0, 0);
    let (code, _, again) = outcome(liftsim().args(sweep));
    assert_eq!(code, 2);
    assert!(again.contains("--force"), "{again}");

    let points = fs::read_to_string(Path::new(&out).join("points.csv")).unwrap();
    let rows: Vec<Vec<&str>> = points
        .lines()
        .map(|line| line.split(',').collect())
        .collect();
    let detections = rows[0]
        .iter()
        .position(|cell| *cell == "detections")
        .unwrap();
    let detections = rows[1..].iter().map(|row| row[detections].parse().unwrap());
    let detections: Vec<usize> = detections.collect();
    let mut archive = ZipArchive::new(fs::File::open(&file).unwrap()).unwrap();
    let mut array = |name: &str, width: usize| {
        let mut bytes = Vec::new();
        archive
            .by_name(name)
            .unwrap()
            .read_to_end(&mut bytes)
            .unwrap();
        let numbers = bytes.split_off(128);
        let number = |bytes: &[u8]| {
            bytes
                .iter()
                .rfold(0, |sum, byte| 256 * sum + u64::from(*byte))
        };
        let numbers: Vec<u64> = numbers.chunks(width).map(number).collect();
        assert_eq!(numbers.len(), 24 * detections.len());
        numbers
    };
    let [rank_sums, exceedances, h1] = [
        array("rank_sum.npy", 8),
        array("exceedances.npy", 4),
        array("h1.npy", 1),
    ];
    let of_rows = h1.chunks(24).map(|row| row.iter().sum::<u64>() as usize);
    assert_eq!(of_rows.collect::<Vec<_>>(), detections);

    for point in [1, 8, 12, 18] {
        let number = point.to_string();
        let arguments = [
            "--quiet", "replay", &config, "--point", &number, "--trials", "3..7",
        ];
        let (code, table, err) = outcome(liftsim().args(arguments));
        assert_eq!((code, err.as_str()), (0, ""));
        let mut expected = "trial,rank_sum,exceedances,h1\n".to_owned();
        for trial in 3..7 {
            let stages = replay(&config, point, trial);
            let at = 24 * (point - 1) + trial;
            let row = [rank_sums[at], exceedances[at], h1[at]];
            let of_scale = stages["exceedances"]
                .iter()
                .find(|(sample, _)| sample == "scale");
            let alone = [
                stages["rank_sum"][0].1,
                of_scale.unwrap().1,
                stages["h1"][0].1,
            ];
            assert_eq!(row.map(|value| value as f64), alone, "{point} {trial}");
            expected += &format!("{trial},{},{},{}\n", row[0], row[1], row[2]);
        }
        assert_eq!(table, expected);
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
    assert!(refused("1", "100000000000").contains("--trial must lie in 0 to 99999999999"));
}
