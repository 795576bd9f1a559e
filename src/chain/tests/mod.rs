//! The chain against a second, deliberately naive one that is given the same draws.

mod naive;
mod order;

use super::{Decision, Family, Observation, Purpose, Score, Trial};
use crate::detect::{
    Alternative, Baseline, Clairvoyant, Exceedances, Forward, Method, NullLaws, Region, Rule,
    Samples, Ties,
};
use crate::scenario::{Calibration, Detector, Scenario};
use crate::signal::{
    DeltaAt, Digitiser, Disturbance, During, Impulses, Law, Motion, Noise, Profile, Sensor,
};
use crate::whiten::{Fit, Order, Whitening};
use naive::naive_count;
use rand::Rng;
use std::ops::Range;
use std::sync::Arc;

const TRIALS: u64 = 600;

fn scenario(samples: Samples, delta: f64, impulses: Impulses) -> Scenario {
    Scenario {
        sensor: Sensor::adxl105(),
        noise: Noise::new(Law::Normal).unwrap(),
        disturbance: Disturbance::default(),
        digitiser: Digitiser::default(),
        motion: Motion {
            delta,
            delta_at: DeltaAt::Record,
            profile: Profile::Rectangular,
            duration: samples.acceleration(),
            offset: 0,
        },
        impulses,
        whitening: Whitening::new(2, Fit::LeastSquares, 40, false, 2).unwrap(),
        samples,
        detector: Detector {
            alpha: 0.05,
            method: Method::Rule(Rule::Product),
            exceedances: Exceedances::Scale,
            alternative: Alternative::Greater,
            ties: Ties::Random,
            calibration: Calibration::None,
            stated: None,
            pilot: 0,
        },
    }
}

fn auto(fit: Fit, training: usize, includes_reference: bool) -> Whitening {
    Whitening::new(Order::Auto, fit, training, includes_reference, 2).unwrap()
}

/// Points that exercise every part of the layout, all different, some sharing their noise. Quantisation
/// steps are fine enough that the fitted coefficients are not simple fractions: otherwise different records
/// would whiten to equal values, and rounding would decide their order in either chain.
fn scenarios() -> Vec<Scenario> {
    let plain = Samples::contiguous(12, 12, 12).unwrap();
    let spread = Samples::new(9, 7, 8, 3, 2).unwrap();
    let impulses = |nu, theta, during| Impulses::new(nu, theta, during).unwrap();
    let strong = impulses(0.3, 20.0, During::Motion);
    let mut points = vec![
        scenario(plain, 0.0, Impulses::none()),
        scenario(plain, 0.3, strong),
        scenario(plain, 0.6, strong),
        scenario(plain, 0.6, impulses(0.1, 2.0, During::Inertial)),
        scenario(spread, -0.4, strong),
        scenario(spread, 0.7, impulses(0.2, 3.0, During::Inertial)),
    ];
    let mut change = |index: usize, change: &dyn Fn(&mut Scenario)| {
        let mut changed: Scenario = points[index].clone();
        change(&mut changed);
        points.push(changed);
    };
    change(2, &|s| s.motion.profile = Profile::Trapezoid { rise: 4.0 });
    change(2, &|s| (s.motion.duration, s.motion.offset) = (6, 5));
    change(2, &|s| s.motion.delta_at = DeltaAt::Whitened);
    change(2, &|s| {
        s.digitiser = Digitiser::new(Some(1.5), Some(6.0)).unwrap()
    });
    change(5, &|s| {
        s.digitiser = Digitiser::new(Some(0.7), None).unwrap()
    });
    change(4, &|s| s.motion.profile = Profile::Trapezoid { rise: 2.5 });
    change(2, &|s| {
        s.whitening = Whitening::new(2, Fit::LeastSquares, 40, true, 2).unwrap()
    });
    change(2, &|s| {
        s.whitening = Whitening::new(3, Fit::Known, 0, false, 2).unwrap()
    });
    change(2, &|s| s.whitening = auto(Fit::LeastSquares, 40, true));
    change(5, &|s| s.whitening = auto(Fit::LeastSquares, 40, false));
    change(4, &|s| s.detector.alternative = Alternative::Less);
    change(3, &|s| s.detector.alternative = Alternative::TwoSided);
    change(3, &|s| s.noise = Noise::new(Law::Cauchy).unwrap());
    for place in [2, 4, 5, 9, 12] {
        change(place, &|s| s.detector.exceedances = Exceedances::Motion);
    }
    points
}

fn region(scenario: &Scenario) -> Arc<Region> {
    let Detector {
        alpha,
        method,
        alternative,
        exceedances,
        ..
    } = &scenario.detector;
    let Method::Rule(rule) = method else {
        unreachable!("every scenario here has a rule");
    };
    let laws = NullLaws::new(*exceedances, *alternative, &scenario.samples).unwrap();
    Arc::new(laws.region(rule, *alpha).unwrap())
}

/// How often each scenario decides H₁ in `trials`, by the chain.
fn counts(scenarios: &[Scenario], families: &[Family], trials: Range<u64>) -> Vec<u64> {
    let decision = |scenario: &Scenario| Decision::Region {
        region: region(scenario),
        ties: scenario.detector.ties,
    };
    let decisions: Vec<Decision> = scenarios.iter().map(decision).collect();
    let mut counts = vec![0; scenarios.len()];
    for family in families {
        let mut trial = Trial::new(family);
        for index in trials.clone() {
            trial.run(index, &mut |place: usize, observation: &mut Observation| {
                counts[place] += u64::from(decisions[place].is_h1(observation));
            });
        }
    }
    counts
}

fn arrange(scenarios: &[Scenario], seed: u64, common_random_numbers: bool) -> Vec<Family> {
    Family::arrange(scenarios, seed, Purpose::Results, common_random_numbers).unwrap()
}

#[test]
fn counts_equal_those_of_the_naive_chain() {
    for common_random_numbers in [true, false] {
        let scenarios = scenarios();
        let families = arrange(&scenarios, 2014, common_random_numbers);
        assert_eq!(
            families.len(),
            if common_random_numbers {
                4
            } else {
                // Seven differ from another by how they decide alone.
                scenarios.len() - 7
            }
        );
        let counts = counts(&scenarios, &families, 0..TRIALS);
        for (index, scenario) in scenarios.iter().enumerate() {
            let holds_it = |family: &&Family| family.places().any(|place| place == index);
            let family = families.iter().find(holds_it).unwrap();
            let expected = naive_count(scenario, family);
            println!("{index}: {expected} of {TRIALS}");
            assert_eq!(counts[index], expected, "point {index}: {scenario:?}");
        }
    }
}

/// Along a grid of Δ that is counted by crossings, rules on T and on T′ side by side.
#[test]
fn rules_along_a_grid_equal_the_naive_chain() {
    let samples = Samples::contiguous(12, 12, 12).unwrap();
    let strong = Impulses::new(0.3, 20.0, During::Motion).unwrap();
    let scenarios: Vec<Scenario> = (0..8)
        .map(|i| scenario(samples, 0.3 * f64::from(i / 2), strong))
        .zip(
            [Exceedances::Scale, Exceedances::Motion]
                .into_iter()
                .cycle(),
        )
        .map(|(scenario, exceedances)| Scenario {
            detector: Detector {
                exceedances,
                ..scenario.detector
            },
            ..scenario
        })
        .collect();
    let families = arrange(&scenarios, 2014, true);
    let counts = counts(&scenarios, &families, 0..TRIALS);
    for (scenario, count) in scenarios.iter().zip(counts) {
        assert_eq!(count, naive_count(scenario, &families[0]), "{scenario:?}");
    }
}

/// A digitiser that changes nothing takes the direct path, which must agree with the linear one.
#[test]
fn direct_and_linear_paths_agree() {
    let linear = scenarios();
    let mut direct = linear.clone();
    for scenario in &mut direct {
        if scenario.digitiser.is_transparent() {
            scenario.digitiser = Digitiser::new(None, Some(1e300)).unwrap();
        }
    }
    let counts =
        |scenarios: &[Scenario]| counts(scenarios, &arrange(scenarios, 7, true), 0..TRIALS);
    assert_eq!(counts(&linear), counts(&direct));
}

/// A trial is its index: any partition of the trials gives the same counts.
#[test]
fn a_trial_does_not_depend_on_others() {
    let scenarios = scenarios();
    let families = arrange(&scenarios, 1, true);
    let counts = |parts: &[(u64, u64)]| {
        let mut sum = vec![0; scenarios.len()];
        for &(first, last) in parts {
            let counts = counts(&scenarios, &families[..1], first..last);
            sum.iter_mut()
                .zip(counts)
                .for_each(|(sum, more)| *sum += more);
        }
        sum
    };
    assert_eq!(counts(&[(0, 200)]), counts(&[(150, 200), (0, 1), (1, 150)]));
}

#[test]
fn refuses_a_record_that_does_not_fit() {
    let samples = Samples::new(12, 12, 12, 1 << 40, 1).unwrap();
    let mut huge = scenario(
        Samples::contiguous(12, 12, 12).unwrap(),
        0.0,
        Impulses::none(),
    );
    huge.samples = samples;
    let (point, refusal) = Family::arrange([&huge], 1, Purpose::Results, true).unwrap_err();
    assert_eq!(point, 0);
    assert!(refusal.to_string().contains("GB"), "{refusal}");
}

/// The counts of a point do not depend on its position in the list, with shared noise or without.
#[test]
fn counts_do_not_depend_on_the_order_of_points() {
    for common_random_numbers in [true, false] {
        let mut scenarios = scenarios();
        let counts = |scenarios: &[Scenario]| {
            counts(
                scenarios,
                &arrange(scenarios, 3, common_random_numbers),
                0..100,
            )
        };
        let forwards = counts(&scenarios);
        scenarios.reverse();
        let backwards: Vec<u64> = counts(&scenarios).into_iter().rev().collect();
        assert_eq!(forwards, backwards);
    }
}

/// A pilot's draws are neither those of the results nor those of another kind of pilot.
#[test]
fn purposes_draw_apart() {
    let scenarios = scenarios();
    let purposes = [Purpose::Results, Purpose::Ordering, Purpose::Calibration];
    let mut first = std::collections::HashSet::new();
    let mut streams = 0;
    for purpose in purposes {
        for family in Family::arrange(&scenarios, 3, purpose, true).unwrap() {
            for stream in [
                &family.noise,
                &family.impulses,
                &family.ties,
                &family.footfalls,
            ] {
                first.insert(stream.at(0).next_u64());
                streams += 1;
            }
        }
    }
    assert_eq!(first.len(), streams);
}

/// The clairvoyant of the chain against its definition on the same draws: Δ · the whitened shape, and θ ·
/// impulses that start at the stated sample, here the first of Y₂.
#[test]
fn clairvoyant_sees_the_stated_motion() {
    let samples = Samples::contiguous(4, 3, 2).unwrap();
    let impulses = Impulses::new(0.3, 2.0, During::Inertial).unwrap();
    let mut stated = scenario(samples, 0.7, impulses);
    stated.detector.method = Method::Baseline(Baseline::Clairvoyant);
    stated.detector.stated = Some((stated.motion, impulses));
    let Some(Score::Clairvoyant { statistic, .. }) = Score::new(&stated) else {
        panic!("no clairvoyant");
    };
    let ar = stated.sensor.ar();
    let shape = [1.0, 1.0, 1.0, 0.0, 0.0];
    let shift = (0..5).map(|i: usize| {
        let back = |p: usize| if i >= p { shape[i - p] } else { 0.0 };
        0.7 * (back(0) - ar[0] * back(1) - ar[1] * back(2))
    });
    let expected = Clairvoyant::new(shift.collect(), 3, 0.3, 2.0, ar);
    let z = [0.4, -1.0, 2.2, 0.3, -0.8];
    let value = |of: &Clairvoyant| of.log_likelihood_ratio(&z, &mut Forward::default());
    assert!((value(&statistic) - value(&expected)).abs() < 1e-12);
}

/// Noise, impulses and ties of every family are streams of their own.
#[test]
fn streams_are_all_different() {
    for common_random_numbers in [true, false] {
        let scenarios = scenarios();
        let families = arrange(&scenarios, 3, common_random_numbers);
        let streams = families
            .iter()
            .flat_map(|f| [&f.noise, &f.impulses, &f.ties, &f.footfalls]);
        let first: std::collections::HashSet<u64> =
            streams.map(|stream| stream.at(0).next_u64()).collect();
        assert_eq!(first.len(), 4 * families.len());
    }
}
