//! `threshold --per-hour`, and `check` of a promised rate.

use super::{liftsim, outcome};
use serde_json::Value;
use std::fs;

fn run(arguments: &[&str]) -> (i32, String, String) {
    outcome(liftsim().arg("threshold").args(arguments))
}

fn json(more: &[&str]) -> Value {
    let arguments = ["--per-hour", "1", "--rate", "5", "--block", "20", "--json"];
    let (code, out, err) = run(&[&arguments[..], more].concat());
    assert_eq!((code, err.as_str()), (0, ""));
    serde_json::from_str(&out).unwrap()
}

/// What is promised is kept, by no more than one step of the lattice; the table says the same.
#[test]
fn a_rate_gives_a_threshold() {
    for (sides, is_exact) in [
        ("up", true),
        ("down", true),
        ("up, down", true),
        ("down,scale,up", false),
        ("down,scale", false),
    ] {
        let value = json(&["--sides", sides]);
        let number = |name: &str| value[name].as_f64().unwrap();
        let hours = number("hours_between_false_alarms");
        assert!((1.0..1.05).contains(&hours), "{sides}: {hours}");
        let count = sides.split(',').count() as f64;
        assert!((number("hours_of_one_side") / count - hours).abs() < 1e-9);
        assert_eq!(value["exact"], is_exact);
        let first = value["first_false_alarm"].as_array().unwrap();
        assert!(
            first
                .windows(2)
                .all(|pair| pair[0]["hours"].as_f64() < pair[1]["hours"].as_f64())
        );
        let delays = value["delays"].as_array().unwrap();
        let growths = value["growths"].as_array().unwrap();
        assert_eq!(growths.len(), if sides.contains("scale") { 4 } else { 0 });
        let is_seen =
            |delay: &&Value| delay["this_reference"]["seen"] == delay["this_reference"]["trials"];
        assert!(
            delays.iter().filter(is_seen).count() > 2,
            "{sides}: {value}"
        );
        let blocks = |at: usize| delays[at]["blocks"].as_f64().unwrap();
        assert!((1..delays.len()).all(|at| blocks(at) < blocks(at - 1)));
        let delta = delays[1]["delta"].as_f64().unwrap();
        assert!((delta - 1.0 / 20f64.sqrt()).abs() < 1e-12, "{delta}");
        let (_, table, _) = run(&["--per-hour", "1", "--rate", "5", "--sides", sides]);
        assert!(
            table.contains(&format!("threshold h = {}\n", value["threshold"])),
            "{table}"
        );
    }
}

#[test]
fn the_delay_is_drawn() {
    let directory = tempfile::tempdir().unwrap();
    for (name, start) in [("delay.png", &b"\x89PNG"[..]), ("delay.svg", b"<")] {
        let path = directory.path().join(name);
        json(&["--figure", path.to_str().unwrap(), "--score", "ranks"]);
        assert!(fs::read(&path).unwrap().starts_with(start), "{name}");
    }
}

#[test]
fn refusals() {
    let rate = ["--rate", "5"];
    for (arguments, expected) in [
        (vec!["--per-hour", "1"], "--rate <HZ>"),
        (
            "--reference 12 --shift 12 --scale 12 --alpha 0.01 --rate 5"
                .split(' ')
                .collect(),
            "cannot be used with",
        ),
        (
            vec!["--per-hour", "1", "--alpha", "0.1"],
            "cannot be used with",
        ),
        (
            vec!["--per-hour", "1", "--rule", "product"],
            "cannot be used with",
        ),
        (
            vec!["--rate", "5", "--reference", "12"],
            "--per-hour <RATE>",
        ),
        (vec!["--k", "0.5", "--alpha", "1"], "cannot be used with"),
        (vec!["--reference", "12"], "--shift <M1>"),
        (
            vec!["--per-hour", "-1"],
            "--per-hour: must be positive and finite, got -1",
        ),
        (
            vec!["--per-hour", "1", "--rate", "0"],
            "--rate: must lie in [0.000001, 1000000]",
        ),
        (
            vec!["--per-hour", "1", "--k", "0.81"],
            "--k: must be a multiple of 0.025, got 0.81",
        ),
        (
            vec!["--per-hour", "1", "--k", "4"],
            "--k: must lie in [0, 3.975], got 4",
        ),
        (
            vec!["--per-hour", "1", "--sides", "up,up"],
            "--sides: must name each side once, got \"up,up\"",
        ),
        (
            vec!["--per-hour", "1", "--sides", "left"],
            "invalid value 'left'",
        ),
        (
            vec!["--per-hour", "1", "--block", "0"],
            "--block: must lie in [1, 1000000] samples, got 0",
        ),
        (
            vec!["--per-hour", "0.001", "--reference", "12"],
            "with a reference of 12 blocks, got 0.001 (lengthen the reference",
        ),
        (
            vec!["--per-hour", "1", "--reference", "1"],
            "--reference: must be longer for a change of any size to reach a threshold, got 1",
        ),
        (
            vec!["--per-hour", "1e-300"],
            "--per-hour: must lie in [1e-30, 10000000000] false alarms, got 1e-300",
        ),
        (
            vec!["--per-hour", "18000"],
            "--per-hour: must be less than 18000, the blocks in an hour, got 18000",
        ),
        (
            vec!["--per-hour", "1", "--k", "3.975"],
            "--k: must be smaller with a reference of 300 blocks, got 3.975",
        ),
        (
            vec!["--per-hour", "1", "--block", "-1"],
            "--block: must lie in [1, 1000000] samples, got -1",
        ),
        (
            "--reference 12 --shift 12 --scale 12 --alpha -0.1"
                .split(' ')
                .collect(),
            "alpha must lie strictly between 0 and 1, got -0.1",
        ),
        (
            "--reference 12 --shift 12 --scale 12 --alpha 1e-300"
                .split(' ')
                .collect(),
            "decides H1 nowhere at 1e-300",
        ),
        (
            vec!["--per-hour", "1e-12", "--reference", "1000"],
            "--per-hour: must be at least",
        ),
    ] {
        let needs_rate = arguments.contains(&"--per-hour") && !expected.starts_with("--rate");
        let more = if needs_rate { &rate[..] } else { &[] };
        let (code, out, err) = run(&[&arguments[..], more].concat());
        assert_eq!((code, out.as_str()), (2, ""), "{arguments:?}: {err}");
        assert!(err.contains(expected), "{arguments:?}: {err}");
    }
}

/// The rate that a refusal calls reachable is reachable.
#[test]
fn a_refusal_says_what_is_reachable() {
    let at = |per_hour: &str| run(&["--per-hour", per_hour, "--rate", "5", "--reference", "12"]);
    let (_, _, err) = at("0.001");
    let (_, least) = err.split_once("must be at least ").unwrap();
    let (least, _) = least.split_once(' ').unwrap();
    assert_eq!(at(least).0, 0, "{least}");
}

/// What is promised holds for every noise, not at a lower rate, and too few blocks are inconclusive.
#[test]
fn the_promised_rate_is_tested() {
    for (more, code, says) in [
        (
            &["--trials", "400"][..],
            0,
            " 6 pass, 0 inconclusive, 0 fail",
        ),
        (
            &["--trials", "400", "--seed", "7"],
            0,
            " 6 pass, 0 inconclusive, 0 fail",
        ),
        (&["--trials", "40"], 3, "blocks would be enough"),
        (
            &["--trials", "400", "--nominal", "0.0004"],
            1,
            " 0 pass, 0 inconclusive, 6 fail",
        ),
    ] {
        let check = ["check", "configs/per_hour.toml", "-q"];
        let (got, out, _) = outcome(liftsim().args(check).args(more));
        assert!(got == code && out.contains(says), "{more:?}: {got}\n{out}");
        assert!(
            !out.contains("AR(1)"),
            "nothing is promised of coloured blocks"
        );
    }
}

/// A study that promises nothing says where, and one that cannot says that it is no sweep.
#[test]
fn nothing_promised() {
    let directory = tempfile::tempdir().unwrap();
    let config = directory.path().join("coloured.toml");
    let text = "question = \"?\"\nseed = 1\ntrials = 1\n[run_length]\nper_hour = 10\nrate = 5\nblocks = 10\n\
                noise = [{ label = \"a\", law = \"normal\", promised = false }]\n";
    fs::write(&config, text).unwrap();
    let check = |config: &str| outcome(liftsim().args(["check", config, "-q"]));
    let (code, _, err) = check(config.to_str().unwrap());
    assert_eq!(code, 2, "{err}");
    let expected =
        "coloured.toml:8:9: run_length.noise: must promise a rate, got promised = false in all";
    assert!(err.contains(expected), "{err}");
    let (code, _, err) = check("configs/impulse_law.toml");
    assert!(code == 2 && err.contains("nothing is swept here"), "{err}");
}
