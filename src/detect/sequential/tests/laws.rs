//! The law of one side's run.

use super::*;
use rayon::prelude::*;

/// The monitored blocks until the first alarm, with a reference of blocks of this law.
fn runs(chart: &Chart, threshold: i32, (name, law, step): (&str, Law, f64), n: u64) -> Vec<f64> {
    let stream = stream(name);
    let run = |run: u64| {
        let (mut next, mut draws) = (blocks(law, step), stream.at(run));
        let mut detector = chart.detector(threshold);
        let mut monitored = 0.0;
        loop {
            let x = next(&mut draws);
            match detector.step(x, uniform(&mut draws)) {
                Step::Reference => {}
                Step::Quiet => monitored += 1.0,
                Step::Alarm(_) => return monitored + 1.0,
            }
        }
    };
    (0..n).into_par_iter().map(run).collect()
}

/// N blocks are the reference, at first and after every alarm.
#[test]
fn an_alarm_begins_a_new_reference() {
    let mut detector = chart(&[Side::Up], 5).detector(40);
    for round in 0..3 {
        let level = f64::from(round) * 10.0;
        let reference = (0..5).all(|_| detector.step(level, 0.5) == Step::Reference);
        let mut monitored = (0..).map(|_| detector.step(level + 1.0, 1.0));
        assert_eq!(
            monitored.next(),
            Some(Step::Alarm(Side::Up)),
            "one block of 4 - 0.8 steps"
        );
        assert!(reference && detector.sums().all(|(_, sum)| sum == 0));
    }
}

/// h = 2.2 with a mean of some 170 blocks, after a reference of 20: 10⁵ runs of each law. Mean and P(run > n).
#[test]
fn holds_for_every_noise() {
    let (chart, threshold) = (chart(&[Side::Up], 20), 88);
    let law = chart.run_length(threshold);
    for noise in LAWS {
        let runs = runs(&chart, threshold, noise, 100_000);
        agrees(noise.0, &runs, law.one_side());
        for blocks in [1, 10, 100, 500] {
            let longer = runs
                .iter()
                .map(|run| f64::from(u8::from(*run > blocks as f64)));
            let what = format!("  P(run > {blocks})");
            agrees(&what, &longer.collect::<Vec<_>>(), law.survival(blocks));
        }
    }
}

/// Scale sees the same uniform numbers; ranks as scores have a law of their own.
#[test]
fn holds_for_every_side_and_score() {
    for (score, sides) in [
        (Score::Normal, [Side::Scale]),
        (Score::Normal, [Side::Down]),
        (Score::Ranks, [Side::Up]),
    ] {
        let chart = Chart::new(score, &sides, 0.8, 20).unwrap();
        let threshold = 80;
        let exact = chart.run_length(threshold).one_side();
        let runs = runs(&chart, threshold, LAWS[1], 40_000);
        agrees(&format!("{score} {}", sides[0]), &runs, exact);
    }
}

/// P(run > n), block by block, from the cuts of the lattice alone.
fn naive_survival(threshold: i32, allowance: i32, blocks: usize) -> f64 {
    let lattice = Lattice::new(Score::Normal);
    let law = lattice.law(Side::Up, |u| u);
    let mut sums = vec![0.0; threshold as usize];
    sums[0] = 1.0;
    for _ in 0..blocks {
        let mut after = vec![0.0; threshold as usize];
        for (sum, mass) in (0..).zip(&sums) {
            for score in -160i32..=160 {
                let to = (sum + score - allowance).max(0);
                if to < threshold {
                    after[to as usize] += mass * law.mass(score);
                }
            }
        }
        sums = after;
    }
    sums.iter().sum()
}

/// Against steps of a naive chain: errors of rounding alone.
#[test]
fn survival_and_mean_agree_with_a_naive_chain() {
    let law = chart(&[Side::Up], 20).run_length(60);
    for blocks in [0, 1, 2, 3, 17, 64] {
        let naive = naive_survival(60, 32, blocks);
        let survival = law.survival(blocks as u64);
        assert!((survival / naive - 1.0).abs() < 1e-12, "{blocks}");
    }
    // Beyond 4000 blocks less than e^(−60) is left.
    let mean: f64 = (0..4000).map(|blocks| law.survival(blocks)).sum();
    assert!((law.one_side() / mean - 1.0).abs() < 1e-11, "{mean}");
}

/// Of a rare alarm the run is nearly exponential, and quantiles are those of its mean.
#[test]
fn quantiles_bracket_their_probability() {
    for sides in [
        &[Side::Up][..],
        &[Side::Up, Side::Down],
        &[Side::Scale, Side::Up],
    ] {
        let law = chart(sides, 20).run_length(200);
        for p in [0.001, 0.05, 0.5, 0.99] {
            let blocks = law.quantile(p);
            let survival = |blocks: f64| law.survival(blocks as u64);
            assert!(survival(blocks) >= 1.0 - p && survival(blocks + 1.0) < 1.0 - p);
            let exponential = -libm::log1p(-p) * law.promised();
            let ratio = blocks / exponential;
            println!("{sides:?}: {p}: {blocks} blocks, {ratio:.4} of an exponential law");
            // Of two parts the union bound takes the place of the exact law: at p = 0.99 it is early.
            assert!(law.is_exact() == (sides.len() == 1 || sides.contains(&Side::Down)));
            // The first alarm comes some blocks later than by that law, as S has to climb first.
            let [low, high] = [if law.is_exact() { 0.98 } else { 0.25 }, 1.02];
            assert!(blocks > low * exponential && blocks < high * exponential + 10.0);
        }
    }
}

/// However rare alarms are, P(run ≤ n) has its digits, and is that of an exponential law but for 1000/L₁, which is said
/// of climbs: below [`RARE`], where quantiles are exact, and above.
#[test]
fn rare_alarms_keep_their_digits() {
    let both = [Side::Up, Side::Down];
    for (sides, mean) in [
        (&both[..1], 1e7),
        (&both[..1], 0.9 * RARE),
        (&both[..1], 4e15),
        (&both, 1e7),
        (&both, 1e12),
    ] {
        let chart = Chart::new(Score::Normal, sides, 1.2, 1000).unwrap();
        let law = chart.run_length(chart.threshold(mean).unwrap());
        let far = 1e-12 + 1000.0 / law.one_side();
        for p in [0.01, 0.5, 0.95] {
            let blocks = law.quantile(p);
            let ratio = blocks / (-libm::log1p(-p) * law.promised());
            let off = 1.0 - law.survival(blocks as u64) - p;
            println!(
                "{sides:?}: {mean:.1e} blocks: {p}: {ratio:.12} of an exponential law, off {off:+.1e}"
            );
            assert!((ratio - 1.0).abs() < far / p && off.abs() < far);
        }
    }
    let chart = Chart::new(Score::Normal, &both, 2.0, 1000).unwrap();
    let law = chart.run_length(chart.threshold(1e30).unwrap());
    assert!((law.quantile(0.5) / law.promised() - 2f64.ln()).abs() < 1e-12);
}

/// Once S has settled a block alarms with a probability of 1/L₁, and not long before.
#[test]
fn the_rate_settles() {
    for threshold in [1, 40, 100, 220] {
        let law = chart(&[Side::Up], 20).run_length(threshold);
        let survival = |blocks: u64| law.survival(blocks);
        let settled = law.settled();
        // By the renewal equation for the probability that block n alarms: those that are the first, and those after one.
        let first: Vec<f64> = (0..=settled)
            .map(|block| survival(block) - survival(block + 1))
            .collect();
        let mut rates: Vec<f64> = Vec::new();
        for block in 0..=settled as usize {
            let later: f64 = (0..block).map(|at| rates[at] * first[block - 1 - at]).sum();
            rates.push(first[block] + later);
        }
        let off = |block: usize| rates[block] * law.one_side() - 1.0;
        let blocks = settled as usize;
        println!(
            "h = {}: settled after {settled} blocks, off {:+.1e}",
            units(threshold),
            off(blocks)
        );
        assert!(off(blocks).abs() < 1.001e-3);
        assert!(blocks == 0 || off(blocks - 1).abs() > 0.999e-3);
    }
}

/// The smallest threshold that keeps the promise.
#[test]
fn thresholds_are_smallest() {
    for sides in [&[Side::Up][..], &[Side::Up, Side::Down, Side::Scale]] {
        let chart = chart(sides, 60);
        for mean in [1.5, 100.0, 1e4, 7.2e7] {
            let threshold = chart.threshold(mean).unwrap();
            let promised = chart.run_length(threshold).promised();
            println!("{sides:?}: {mean}: h = {}, {promised:.1}", units(threshold));
            assert!(promised >= mean);
            if threshold > 1 {
                assert!(chart.run_length(threshold - 1).promised() < mean);
            }
        }
    }
    let error = chart(&[Side::Up], 200).threshold(1e300).unwrap_err();
    assert!(
        error.remedy == Remedy::RaiseAllowance && error.reachable > 1e13,
        "{error}"
    );
}
