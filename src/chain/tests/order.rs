//! Filters whose order each trial chooses.

use super::naive::naive_order;
use super::{Decision, Impulses, Scenario, arrange, auto, counts, region, scenario};
use crate::chain::{Observation, Replay, Trial};
use crate::detect::Samples;
use crate::signal::{Digitiser, During, Sensor};
use crate::simd::LANES;
use crate::stats::binomial;
use crate::stats::tally::Tally;
use crate::whiten::{Fit, Whitening};

fn replay(scenario: &Scenario, index: u64) -> Replay {
    let decision = Decision::Region {
        region: region(scenario),
        ties: scenario.detector.ties,
    };
    Replay::new(scenario, &decision, 2014, true, index).unwrap()
}

/// Scenarios of this fit, whose training ends where X starts.
fn scenarios(fit: Fit) -> Vec<Scenario> {
    let samples = Samples::new(12, 8, 9, 2, 2).unwrap();
    let impulses = Impulses::new(0.2, 3.0, During::Motion).unwrap();
    let of = |ar: &[f64], training, digitiser| Scenario {
        sensor: Sensor::from_ar(ar.to_vec()).unwrap(),
        whitening: auto(fit, training, false),
        digitiser,
        ..scenario(samples, 0.6, impulses)
    };
    let coarse = Digitiser::new(Some(1.5), Some(60.0)).unwrap();
    vec![
        of(&[-1.5365, -0.75056], 256, Digitiser::default()),
        of(&[0.4, -0.2, 0.3], 37, coarse),
        of(&[], 40, Digitiser::default()),
    ]
}

/// Every trial equals that of a filter of the order chosen by an independent criterion.
#[test]
fn a_trial_is_that_of_the_order_it_chooses() {
    let mut chosen = [0; 9];
    for fit in [Fit::LeastSquares, Fit::YuleWalker, Fit::Burg] {
        for scenario in scenarios(fit) {
            for index in 0..100 {
                let replay_of_auto = replay(&scenario, index);
                let training = &replay_of_auto.record[..scenario.whitening.training];
                let order = naive_order(training);
                chosen[order] += 1;
                let mut fixed = scenario.clone();
                // Order 0 means no filter.
                let (coefficients, fit) = if order == 0 {
                    (1, Fit::None)
                } else {
                    (order, fit)
                };
                fixed.whitening =
                    Whitening::new(coefficients, fit, training.len(), false, 0).unwrap();
                let mut replay_of_fixed = replay(&fixed, index);
                replay_of_fixed.coefficients.truncate(order);
                assert_eq!(
                    replay_of_auto, replay_of_fixed,
                    "{fit} {index}: order {order}"
                );
            }
        }
    }
    println!("trials by order: {chosen:?}");
    assert!(chosen.iter().all(|trials| *trials > 0), "{chosen:?}");
}

/// The usual sizes and training at rest.
fn at_rest(whitening: Whitening) -> Scenario {
    let samples = Samples::contiguous(12, 12, 12).unwrap();
    let mut scenario = scenario(samples, 0.0, Impulses::none());
    scenario.whitening = whitening;
    scenario.detector.alpha = 0.01;
    scenario
}

/// The sensor has order 2. An order found less often than in 95 % of trials would be found so rarely with
/// probability 3e-7.
#[test]
fn finds_the_order_of_the_sensor() {
    let scenarios = [at_rest(auto(Fit::LeastSquares, 256, false))];
    let families = arrange(&scenarios, 2014, true);
    let mut trial = Trial::new(&families[0]);
    let trials = 4000;
    let mut by_order = [0; 9];
    for index in 0..trials {
        trial.run(index, &mut |_: usize, _: &mut Observation| {});
        let lane = (index % LANES as u64) as usize;
        let (coefficients, _) = trial.batch.rest(0, lane);
        let last = coefficients.iter().rposition(|a| *a != 0.0);
        by_order[last.map_or(0, |last| last + 1)] += 1;
    }
    let hits = by_order[2];
    let (low, high) = Tally { hits, trials }.interval(0.95);
    let p = binomial::lower_tail(hits, trials, 0.95);
    println!("order 2: {hits}/{trials} [{low:.4}, {high:.4}], p = {p:.3e}; all {by_order:?}");
    assert!(p > 3e-7);
}

/// The level holds at 256 samples of training: at a true rate of α, each of the two checks fails with
/// probability 1e-6.
#[test]
fn keeps_the_level() {
    let orders = [
        auto(Fit::LeastSquares, 256, false),
        Whitening::new(2, Fit::LeastSquares, 256, false, 2).unwrap(),
        auto(Fit::Burg, 256, false),
    ];
    let scenarios = orders.map(at_rest);
    let trials = 100_000;
    let hits = counts(&scenarios, &arrange(&scenarios, 2014, true), 0..trials);
    for (scenario, hits) in scenarios.iter().zip(hits) {
        let p = binomial::upper_tail(hits, trials, 0.01);
        let below = binomial::lower_tail(hits, trials, 0.012);
        let (fit, order) = (scenario.whitening.fit, scenario.whitening.order);
        println!("{fit}, order {order}: {hits}/{trials}, p = {p:.3e}, of 1.2 α {below:.1e}");
        assert!(p > 5e-7 && below < 1e-4);
    }
}
