//! Filters whose order each trial chooses.

use super::naive::naive_order;
use super::{Decision, Impulses, Scenario, auto, region, scenario};
use crate::chain::Replay;
use crate::detect::Samples;
use crate::signal::{Digitiser, During, Sensor};
use crate::stats::binomial;
use crate::whiten::{Fit, Order, Whitening};

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

/// Every trial is that of a filter of the order which a criterion written anew asks for.
#[test]
fn a_trial_is_that_of_the_order_it_chooses() {
    let mut chosen = [0; 9];
    for fit in [Fit::LeastSquares, Fit::YuleWalker, Fit::Burg] {
        for scenario in scenarios(fit) {
            for index in 0..100 {
                let replay_of_auto = replay(&scenario, index);
                let training = &replay_of_auto.record[..scenario.whitening.training()];
                let order = naive_order(training);
                chosen[order] += 1;
                let mut fixed = scenario.clone();
                // A filter of order 0 is none.
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
