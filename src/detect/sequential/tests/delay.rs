//! What a shift does.

use super::super::reach::Reach;
use super::*;
use crate::signal::white_noise;
use crate::stats::normal;

/// The mean delay with a long reference, by 20 000 runs of U = Φ(Z + shift).
#[test]
fn delays_agree_with_simulation() {
    let lattice = Lattice::new(Score::Normal);
    let threshold = 180;
    for (side, shift) in [
        (Side::Up, 1.0),
        (Side::Up, 2.5),
        (Side::Down, 1.5),
        (Side::Scale, 2.0),
    ] {
        let mut draws = stream("delay").at(0);
        // A side that looks down is given a shift down.
        let signed = if side == Side::Down { -shift } else { shift };
        let run = |_| {
            let mut cusum = Cusum::new(32, threshold);
            let mut blocks = 0.0;
            loop {
                blocks += 1.0;
                let z = white_noise(1, &mut draws)[0];
                let u = normal::below(z + signed);
                if cusum.step(lattice.score(side.of(u))) {
                    return blocks;
                }
            }
        };
        let runs: Vec<f64> = (0..20_000).map(run).collect();
        let exact = chart(&[side], 60).delay(threshold, shift);
        agrees(&format!("{side} at {shift}"), &runs, exact);
    }
}

/// Without noise an endless shift is ties: the highest threshold that the law calls reached is reached in 99 % of 20 000
/// runs before the climb ends, the next is not.
#[test]
fn reach_agrees_with_simulation() {
    let chart = chart(&[Side::Up, Side::Down], 12);
    let reach = Reach::new(&chart);
    let highest = (1..400).take_while(|h| reach.reaches(*h)).last().unwrap();
    println!("N = 12: h = {} is reachable", units(highest));
    // The mean climb of the j-th block falls to 0 at the first j whose mean score, over U in (N/(N + j), 1), is below k.
    let mean = |j: f64| {
        let from = normal::quantile(12.0 / (12.0 + j));
        (-from * from / 2.0).exp() / (2.0 * std::f64::consts::PI).sqrt() * (12.0 + j) / j
    };
    let last = (1..)
        .take_while(|j| mean(f64::from(*j)) > 0.8)
        .last()
        .unwrap();
    let mut draws = stream("reach").at(0);
    let mut share = |threshold: i32| {
        let run = |_: &u32| {
            let mut detector = chart.detector(threshold);
            for _ in 0..12 {
                detector.step(0.0, uniform(&mut draws));
            }
            (0..last).any(|_| detector.step(1.0, uniform(&mut draws)) == Step::Alarm(Side::Up))
        };
        (0..20_000).filter(run).count() as f64 / 2e4
    };
    let error = (0.99f64 * 0.01 / 2e4).sqrt();
    for (threshold, is_reached) in [(highest - 10, true), (highest, true), (highest + 12, false)] {
        let share = share(threshold);
        println!(
            "  h = {}: {share:.4} of 20000 within {last} blocks",
            units(threshold)
        );
        let beyond = if is_reached {
            0.99 - share
        } else {
            share - 0.99
        };
        assert!(beyond < FAR * error);
    }
}

/// What a short reference cannot do is said, with what it can.
#[test]
fn unreachable_rates_are_refused() {
    let short = chart(&[Side::Up, Side::Down], 8);
    let error = short.threshold(1e6).unwrap_err();
    println!("{error}");
    let reachable = error.reachable;
    assert_eq!(error.reference, Some(8));
    assert!(short.threshold(reachable).is_ok() && short.threshold(reachable * 1.05).is_err());
    let said = error.per_hour(["--per-hour", "--reference"], 7.2e4);
    println!("{said}");
    assert!(
        said.to_string()
            .starts_with("--per-hour: must be at least ")
    );
    let none = chart(&[Side::Scale], 1).threshold(100.0).unwrap_err();
    let said = none.per_hour(["--per-hour", "--reference"], 7.2e4);
    let rule = "must be longer for a shift of any size to reach a threshold";
    assert_eq!(said.to_string(), format!("--reference: {rule}, got 1"));
    // A reference as long as usual reaches whatever is usual.
    assert!(chart(&[Side::Up], 60).threshold(1e10).is_ok());
}
