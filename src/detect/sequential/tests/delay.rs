//! What a shift does.

use super::super::reach::Reach;
use super::*;
use crate::signal::white_noise;
use crate::stats::normal;

/// The mean delay with a long reference, by 20 000 runs of U = Φ of a changed block.
#[test]
fn delays_agree_with_simulation() {
    let lattice = Lattice::new(Score::Normal);
    let threshold = 180;
    for (side, change) in [
        (Side::Up, Change::shift(1.0)),
        (Side::Up, Change::shift(2.5)),
        (Side::Down, Change::shift(1.5)),
        (Side::Scale, Change::shift(2.0)),
        (Side::Scale, Change::growth(2.0)),
    ] {
        let chart = chart(&[side], 60);
        let mut draws = stream("delay").at(0);
        let run = |_| {
            let mut cusum = Cusum::new(32, threshold);
            let mut blocks = 0.0;
            loop {
                blocks += 1.0;
                let z = white_noise(1, &mut draws)[0];
                let u = normal::below(chart.towards(change).of(z));
                if cusum.step(lattice.score(side.of(u))) {
                    return blocks;
                }
            }
        };
        let runs: Vec<f64> = (0..20_000).map(run).collect();
        let exact = chart.delay(threshold, change);
        agrees(&format!("{side}: {change:?}"), &runs, exact);
    }
}

/// Without noise an endless shift is ties, and vibration by turns ties on either side: the highest threshold that the law
/// calls reached is reached in 99 % of 20 000 runs before the climb ends, a little higher one is not. Where each block of
/// vibration is on either side by chance it is reached nearly as often.
#[test]
fn reach_agrees_with_simulation() {
    for (sides, by_turns) in [
        (&[Side::Up, Side::Down][..], [1.0, 1.0]),
        (&[Side::Scale], [1.0, -1.0]),
    ] {
        let chart = chart(sides, 12);
        let reach = Reach::new(&chart);
        let highest = (1..400).take_while(|h| reach.reaches(*h)).last().unwrap();
        println!("{sides:?}, N = 12: h = {} is reachable", units(highest));
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
        let mut share = |threshold: i32, is_by_chance: bool| {
            let run = |_: &u32| {
                let mut detector = chart.detector(threshold);
                detector.begin(&[0.0; 12]);
                (0..last).any(|j| {
                    let turn = if is_by_chance {
                        uniform(&mut draws) < 0.5
                    } else {
                        j % 2 == 0
                    };
                    let x = by_turns[usize::from(turn)];
                    matches!(detector.step(x, uniform(&mut draws)), Step::Alarm(_))
                })
            };
            (0..20_000).filter(run).count() as f64 / 2e4
        };
        let error = (0.99f64 * 0.01 / 2e4).sqrt();
        for (threshold, is_reached) in
            [(highest - 10, true), (highest, true), (highest + 12, false)]
        {
            let [share, by_chance] = [false, true].map(|by_chance| share(threshold, by_chance));
            println!(
                "  h = {}: {share:.4} of 20000 within {last} blocks, {by_chance:.4} by chance",
                units(threshold)
            );
            if is_reached {
                assert!(0.99 - share < FAR * error && by_chance > 0.97);
            } else {
                assert!(share - 0.99 < FAR * error);
            }
        }
    }
}

/// What a short reference cannot do is said, with what it can.
#[test]
fn unreachable_rates_are_refused() {
    let short = chart(&[Side::Up, Side::Down], 8);
    let error = short.threshold(1e6).unwrap_err();
    println!("{error}");
    let reachable = error.reachable;
    assert_eq!(error.remedy, Remedy::LongerReference(8));
    assert!(short.threshold(reachable).is_ok() && short.threshold(reachable * 1.05).is_err());
    let rate = Rate::new(0.072, 20.0).unwrap();
    let said = |chart: &Chart| rate.threshold(chart).unwrap_err().to_string();
    println!("{}", said(&short));
    assert!(said(&short).starts_with("per_hour: must be at least "));
    let none = chart(&[Side::Scale], 1);
    let rule = "must be longer for a change of any size to reach a threshold";
    assert_eq!(said(&none), format!("reference: {rule}, got 1"));
    for (score, k) in [(Score::Normal, 3.975), (Score::Ranks, 1.7)] {
        let steep = Chart::new(score, &[Side::Up], k, 60).unwrap();
        let rule = format!("k: must be smaller with a reference of 60 blocks, got {k} (");
        assert!(said(&steep).starts_with(&rule), "{}", said(&steep));
    }
    // A reference as long as usual reaches whatever is usual, by vibration too.
    for side in [Side::Up, Side::Scale] {
        assert!(chart(&[side], 60).threshold(1e10).is_ok());
    }
}

/// What is promised is a rate at which some blocks are quiet.
#[test]
fn rates_that_are_none_are_refused() {
    for (per_hour, rate, expected) in [
        (
            18_000.0,
            5.0,
            "per_hour: must be less than 18000, the blocks in an hour, got 18000",
        ),
        (-1.0, 5.0, "per_hour: must be positive and finite, got -1"),
        (
            1e-300,
            5.0,
            "per_hour: must lie in [1e-30, 10000000000] false alarms, got 1e-300",
        ),
        (
            1.0,
            1e-300,
            "rate: must lie in [0.000001, 1000000] blocks per second, got 1e-300",
        ),
        (
            1.0,
            f64::NAN,
            "rate: must lie in [0.000001, 1000000] blocks per second, got NaN",
        ),
    ] {
        assert_eq!(Rate::new(per_hour, rate).unwrap_err().to_string(), expected);
    }
}

/// A whole reference at once is that block by block.
#[test]
fn a_reference_at_once() {
    let chart = chart(&[Side::Up, Side::Scale], 200);
    let [mut at_once, mut one_by_one] = [0; 2].map(|_| chart.detector(100));
    let mut draws = stream("at once").at(0);
    let blocks = white_noise(200, &mut draws);
    at_once.begin(&blocks);
    for x in blocks {
        assert_eq!(one_by_one.step(x, 0.5), Step::Reference);
    }
    for x in white_noise(300, &mut draws) {
        let v = uniform(&mut draws);
        assert_eq!(at_once.step(x + 1.0, v), one_by_one.step(x + 1.0, v));
        assert!(at_once.sums().eq(one_by_one.sums()));
    }
}
