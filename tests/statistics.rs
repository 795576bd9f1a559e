//! Statistical tests of whole runs. Seeds are fixed; every test states its false-failure rate.

use liftsim::chain::Decision;
use liftsim::config::Config;
use liftsim::detect::{NullLaw, Samples};
use liftsim::pilot::Pilots;
use liftsim::plan::{Design, Hypothesis, Plan};
use liftsim::run;
use liftsim::tally::Tally;

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha20Rng;
use statrs::distribution::{ChiSquared, ContinuousCDF, DiscreteCDF, Hypergeometric};

fn plan(text: &str) -> Plan {
    let config = Config::parse("test", text).unwrap_or_else(|error| panic!("{error}"));
    Plan::new(&config).unwrap_or_else(|error| panic!("{error}"))
}

fn decisions(plan: &Plan) -> Vec<Decision> {
    let decisions = Pilots::new(plan).unwrap().decide(|_| {});
    decisions.unwrap_or_else(|error| panic!("{error}"))
}

fn tallies(plan: &Plan) -> Vec<Tally> {
    run::run(plan, &decisions(plan), &[], |_| {}).tallies
}

/// The cells (W ≥ w, T ≥ t) of the whole chain at rest with the known filter follow the exact joint
/// law. Tables whose rule fires from one corner on give the counts of corners; differences of
/// corners are cells of a partition of the (W, T) plane, and χ² on them has p > 1e-7 unless the law
/// is wrong: three noise laws, false-failure rate 3e-7.
#[test]
fn joint_counts_at_rest_follow_the_exact_law() {
    let samples = Samples::contiguous(12, 12, 12).unwrap();
    let w_law = NullLaw::rank_sum(&samples).unwrap();
    let t_law = NullLaw::exceedances(&samples).unwrap();
    let w_edges = [78, 170, 195, 210, 222, 234, 249, 274, 367];
    let t_edges = [0, 1, 2, 3, 4, 6, 13];
    for law in ["normal", "laplace", "cauchy"] {
        let mut text = format!(
            "question = \"?\"\nseed = 5\ntrials = 300_000\n[noise]\nlaw = \"{law}\"\n\
             [whitening]\nfit = \"known\"\n[impulses]\nnu = 0.0\n[detector]\nalpha = 0.999999\n[axis]\ndelta = [0.0]\n"
        );
        let mut corners = Vec::new();
        for &w in &w_edges[..8] {
            for &t in &t_edges[..6] {
                if (w, t) == (78, 0) {
                    continue; // The whole plane, whose size is no level.
                }
                let entry = |column: u64| {
                    if column < t {
                        "\"never\"".to_owned()
                    } else {
                        w.to_string()
                    }
                };
                let entries: Vec<String> = (0..=12).map(entry).collect();
                text += &format!(
                    "[[curve]]\ndetector = {{ rule = {{ table = [{}] }} }}\n",
                    entries.join(", ")
                );
                corners.push((w, t));
            }
        }
        let plan = plan(&text);
        assert_eq!(plan.points.len(), corners.len());
        let tallies = tallies(&plan);
        let trials = tallies[0].trials;
        let corner = |w: u64, t: u64| -> f64 {
            match corners.iter().position(|&c| c == (w, t)) {
                Some(index) => tallies[index].hits as f64,
                None if (w, t) == (78, 0) => trials as f64,
                None => 0.0,
            }
        };
        let (mut statistic, mut cells) = (0.0, 0);
        for w in w_edges.windows(2) {
            for t in t_edges.windows(2) {
                let counted = corner(w[0], t[0]) - corner(w[1], t[0]) - corner(w[0], t[1])
                    + corner(w[1], t[1]);
                let w_mass = w_law.tail(w[0]) - w_law.tail(w[1]);
                let t_mass = t_law.tail(t[0]) - t_law.tail(t[1]);
                let expected = w_mass * t_mass * trials as f64;
                assert!(expected > 100.0);
                statistic += (counted - expected).powi(2) / expected;
                cells += 1;
            }
        }
        let p = ChiSquared::new(f64::from(cells - 1)).unwrap().sf(statistic);
        println!("{law}: n = {trials}, {cells} cells, chi-square {statistic:.1}, p = {p:.3}");
        assert!(p > 1e-7);
    }
}

/// Δ/σ, ν, θ of the points compared with the second implementation.
const POINTS: [(f64, f64, f64); 8] = [
    (0.0, 0.3, 20.0),
    (0.2, 0.1, 2.0),
    (0.3, 0.3, 1.0),
    (0.5, 0.01, 20.0),
    (0.5, 0.1, 20.0),
    (0.8, 0.3, 20.0),
    (-0.4, 0.1, 2.0),
    (0.4, 0.0, 0.0),
];

/// D against a second, deliberately naive implementation of the whole chain, with noise of its own.
/// Equality of two binomial probabilities by Fisher's exact test, two-sided at 1e-7 a point: 8
/// points, false-failure rate 8e-7.
#[test]
fn power_agrees_with_a_second_implementation() {
    let (trials, naive_trials) = (200_000, 40_000);
    let mut text =
        format!("question = \"?\"\nseed = 6\ntrials = {trials}\n[axis]\ntraining = [64]\n");
    for (delta, nu, theta) in POINTS {
        text += &format!(
            "[[curve]]\nmotion = {{ delta = {delta} }}\nimpulses = {{ nu = {nu}, theta = {theta} }}\n"
        );
    }
    let plan = plan(&text);
    let tallies = tallies(&plan);
    let in_motion = plan
        .points
        .iter()
        .zip(&tallies)
        .filter(|(point, _)| point.hypothesis == Hypothesis::H1);
    for ((point, tally), (delta, nu, theta)) in in_motion.zip(POINTS) {
        let mut random = ChaCha20Rng::seed_from_u64(99);
        let Design::Region(region) = &point.design else {
            unreachable!("the rule has an exact region");
        };
        let detections = (0..naive_trials)
            .filter(|_| {
                let (w, t) = naive_trial(&mut random, delta, nu, theta);
                naive_decision(&region.critical_values(), w, t)
            })
            .count() as u64;
        let p = fisher(tally.hits, trials, detections, naive_trials);
        let naive = Tally {
            hits: detections,
            trials: naive_trials,
        };
        println!(
            "Δ = {delta}, ν = {nu}, θ = {theta}: {}/{trials} = {:.5}, naive {detections}/{naive_trials} = {:.5}, p = {p:.3}",
            tally.hits,
            tally.rate(),
            naive.rate()
        );
        assert!(p > 1e-7);
    }
}

/// Two-sided p-value of equal probabilities, given the total number of hits.
fn fisher(hits: u64, trials: u64, other_hits: u64, other_trials: u64) -> f64 {
    let law = Hypergeometric::new(trials + other_trials, hits + other_hits, other_trials).unwrap();
    let below = law.cdf(other_hits);
    let above = 1.0
        - if other_hits == 0 {
            0.0
        } else {
            law.cdf(other_hits - 1)
        };
    2.0 * below.min(above)
}

fn naive_decision(critical: &[(Option<u64>, Option<u64>)], w: u64, t: usize) -> bool {
    critical[t].1.is_some_and(|upper| w >= upper)
}

/// Box and Muller, one of the pair thrown away.
fn normal(random: &mut impl Rng) -> f64 {
    let (u, v): (f64, f64) = (1.0 - random.random::<f64>(), random.random());
    (-2.0 * u.ln()).sqrt() * (2.0 * std::f64::consts::PI * v).cos()
}

/// N = M₁ = M₂ = 12, 64 training samples, order 2, the printed coefficients of (3).
fn naive_trial(random: &mut impl Rng, delta: f64, nu: f64, theta: f64) -> (u64, usize) {
    let mut x = vec![0.0, 0.0];
    for _ in 0..500 + 64 + 36 {
        let n = x.len();
        x.push(-1.5365 * x[n - 1] - 0.75056 * x[n - 2] + normal(random));
    }
    let mut r = x.split_off(x.len() - 100);
    let mut sum = 0.0;
    for i in 0..24 {
        let mut impulse = 0.0;
        if random.random::<f64>() < nu {
            impulse = match sum == 0.0 {
                true => theta * if random.random::<bool>() { 1.0 } else { -1.0 },
                false => -sum,
            };
        }
        sum += impulse;
        r[76 + i] += impulse + if i < 12 { delta } else { 0.0 };
    }
    let mean = r[..64].iter().sum::<f64>() / 64.0;
    let (mut c11, mut c12, mut c22, mut b1, mut b2) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for i in 2..64 {
        let (now, one, two) = (r[i] - mean, r[i - 1] - mean, r[i - 2] - mean);
        c11 += one * one;
        c12 += one * two;
        c22 += two * two;
        b1 += now * one;
        b2 += now * two;
    }
    let determinant = c11 * c22 - c12 * c12;
    let a1 = (b1 * c22 - b2 * c12) / determinant;
    let a2 = (b2 * c11 - b1 * c12) / determinant;
    let y: Vec<f64> = (64..100)
        .map(|i| r[i] - a1 * r[i - 1] - a2 * r[i - 2])
        .collect();
    let rank = |i: usize| 1 + y.iter().filter(|other| **other < y[i]).count() as u64;
    let low = y[..12].iter().copied().fold(f64::INFINITY, f64::min);
    let high = y[..12].iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let outside = y[24..].iter().filter(|y| **y < low || **y > high).count();
    ((12..24).map(rank).sum(), outside)
}
