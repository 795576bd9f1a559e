//! The gate passes if the level holds, and fails or is inconclusive otherwise.

use super::{config, liftsim, outcome};

fn check(arguments: &[&str]) -> (i32, String) {
    let (code, out, err) = outcome(liftsim().arg("check").args(arguments));
    assert_eq!(err, "", "progress stays off a pipe");
    (code, out)
}

/// Every scenario passes. The gate itself fails with probability at most 1e-3 when all hold; the
/// seeds are fixed.
#[test]
fn holds_on_four_seeds() {
    for seed in ["2014", "1", "2", "3"] {
        let (code, out) = check(&["configs/alpha.toml", "--seed", seed]);
        println!("{out}");
        assert_eq!(code, 0, "seed {seed}");
        assert!(out.contains(" 30 pass, 0 inconclusive, 0 fail"));
    }
}

/// X inside a training record of 32 samples: the rate is about 0.0127 at α = 0.01, some 17 standard
/// errors above it.
#[test]
fn fails_with_the_reference_in_a_short_training_record() {
    let name = config("reference_in_training.toml");
    let (code, out) = check(&[name.to_str().unwrap()]);
    println!("{out}");
    assert_eq!(code, 1);
    assert!(out.contains("FAIL"));
}

#[test]
fn fails_against_a_lower_nominal() {
    let (code, out) = check(&["configs/alpha.toml", "--nominal", "0.008"]);
    println!("{out}");
    assert_eq!(code, 1);
    assert!(out.contains(" 0 pass, 0 inconclusive, 30 fail"));
}

#[test]
fn abstains_on_a_tenth_of_the_trials() {
    let (code, out) = check(&["configs/alpha.toml", "--trials", "40000"]);
    println!("{out}");
    assert_eq!(code, 3);
    assert!(out.contains(" 0 pass, 30 inconclusive, 0 fail"));
}

/// Ordinary stops of a floor map: twenty buildings are too few to pass, and the rule as printed fails with more.
#[test]
fn floors_are_gated() {
    let (code, out) = check(&["configs/floors_alarm.toml", "--trials", "20"]);
    assert_eq!(code, 3, "{out}");
    assert!(
        out.contains("false_any") && out.contains("stops would be enough"),
        "{out}"
    );
    let (code, out) = check(&["configs/floors_noise.toml", "--trials", "20"]);
    assert_eq!(code, 1, "{out}");
    assert!(out.contains("FAIL"), "{out}");
}
