//! Windows, counted.

use super::*;
use crate::study::outcomes::Of;
use crate::study::tests::{read, refusal, rows};
use crate::vector::length;

/// Of noise alone the mean has the error that follows from the noise: √3 σ/√400, σ² = S_a · 200 Hz.
#[test]
fn noise_averages_out() {
    let text = "question = \"?\"\nseed = 3\ntrials = 2000\n[gravity]\ncondition = [\"noise\"]\n";
    let study = read::<Of<Windows>>(text);
    let all = rows(&study, 2000);
    let of = |outcome: &str| all.iter().find(|row| row.outcome == outcome).unwrap();
    let sigma = (crate::track::Densities::of_sheet(400e-6) * 200.0).sqrt();
    let expected = 1000.0 * sigma * (3.0f64 / 400.0).sqrt();
    let mean = of("error_mean");
    // Six deviations of a mean of 2000 squares of three normal errors.
    assert!(
        (mean.estimate / expected - 1.0).abs() < 0.055,
        "{mean:?} {expected}"
    );
    // The variance of a geometric median on each of p axes is p/((p − 1) E 1/r)² over n, and E 1/r = √(2/π)/σ where p = 3.
    let ratio = of("over_mean_median");
    let expected = (3.0 * std::f64::consts::PI / 8.0).sqrt();
    assert!((ratio.estimate - expected).abs() < 0.03, "{ratio:?}");
}

/// What happens acts up or in any direction, and the sensor stays where it is.
#[test]
fn windows_are_at_rest() {
    for trial in 0..20 {
        for condition in [Condition::Noise, Condition::CoarseSteps] {
            let Window {
                gravity,
                readings,
                step,
            } = Window::new(condition, 1, trial);
            let off = readings
                .iter()
                .map(|it| length(mix([(1.0, *it), (-1.0, gravity)])));
            assert!(off.fold(0.0, f64::max) < 0.35 + step);
        }
    }
}

#[test]
fn refusals() {
    let refused = |list: &str| {
        let text =
            format!("question = \"?\"\nseed = 3\ntrials = 2\n[gravity]\ncondition = {list}\n");
        refusal::<Windows>(&text)
    };
    assert!(
        refused("[]")
            .unwrap()
            .contains("gravity.condition: must name each condition once, got none")
    );
    assert!(
        refused("[\"start\", \"start\"]")
            .unwrap()
            .contains("got start twice")
    );
    assert_eq!(refused("[\"start\"]"), None);
}
