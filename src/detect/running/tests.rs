//! Every score against one computed anew from the whole record, and what a threshold promises.

use super::*;
use crate::detect::sequential::{Chart as RankChart, STEPS, Score as Of, Side, units};
use crate::detect::{Alternative, NullLaws, Pooled, Samples};
use crate::rng::Stream;
use crate::signal::white_noise;
use proptest::prelude::*;

const ALL: [Detector; 10] = [
    Detector::ThreeSample,
    Detector::Mended,
    Detector::Ranks,
    Detector::Cusum,
    Detector::CusumVariance,
    Detector::Glr,
    Detector::GlrVariance,
    Detector::ZeroRule,
    Detector::Uniform,
    Detector::Clairvoyant,
];

fn told() -> Told {
    Told {
        ar: vec![0.5, -0.2],
        deviation: 0.9,
        shape: (1..=15).map(|i| f64::from(i) / 15.0).collect(),
    }
}

fn ties(seed: u64) -> Generator {
    Stream::new(seed, "ties", "").at(0)
}

fn last(detector: Detector, record: &[f64], seed: u64) -> f64 {
    let mut running = detector.start(&Tables::default(), &told(), ties(seed));
    running.largest(record, record.len() - 1)
}

fn means(record: &[f64], size: usize) -> Vec<f64> {
    let blocks = record.chunks_exact(size);
    blocks
        .map(|block| block.iter().sum::<f64>() / size as f64)
        .collect()
}

/// z of each block that has a reference.
fn standardised(record: &[f64]) -> Vec<f64> {
    let means = means(record, 20);
    let z = |at: usize| {
        let reference = &means[at - 75..at - 15];
        let mean = reference.iter().sum::<f64>() / 60.0;
        let squares: f64 = reference.iter().map(|x| (x - mean).powi(2)).sum();
        (means[at] - mean) / (squares / 59.0).sqrt()
    };
    (75..means.len()).map(z).collect()
}

/// The largest sum of what the last blocks add, or 0.
fn largest_sum(z: &[f64], adds: impl Fn(f64) -> f64) -> f64 {
    let sum = |from: usize, sign: f64| z[from..].iter().map(|z| adds(sign * z)).sum::<f64>();
    let each = (0..z.len()).flat_map(|from| [sum(from, 1.0), sum(from, -1.0)]);
    each.fold(0.0, f64::max)
}

/// ln N(x; mean, deviation²) but for a constant.
fn log_normal(x: f64, mean: f64, deviation: f64) -> f64 {
    -((x - mean) / deviation).powi(2) / 2.0 - deviation.ln()
}

/// The largest log-likelihood ratio of the last n ≤ 15 blocks.
fn largest_ratio(z: &[f64], with_variance: bool) -> f64 {
    let ratio = |n: usize| {
        let newest = &z[z.len() - n..];
        let mean = newest.iter().sum::<f64>() / n as f64;
        let variance = newest.iter().map(|z| (z - mean).powi(2)).sum::<f64>() / n as f64;
        let deviation = if with_variance {
            variance.sqrt().max(1.0)
        } else {
            1.0
        };
        let each = newest.iter();
        each.map(|z| log_normal(*z, mean, deviation) - log_normal(*z, 0.0, 1.0))
            .sum::<f64>()
    };
    (1..=z.len().min(15)).map(ratio).fold(0.0, f64::max)
}

fn three(record: &[f64], of: Exceedances) -> f64 {
    let means = means(record, 12);
    let newest = &means[means.len() - 48..];
    let pooled = Pooled {
        reference: &newest[..24],
        shift: &newest[24..36],
        scale: &newest[36..],
    };
    let statistics = pooled.statistics_strictly();
    let samples = Samples::contiguous(24, 12, 12).unwrap();
    let laws = NullLaws::new(of, Alternative::TwoSided, &samples).unwrap();
    let twice_off = (2 * statistics.rank_sum).abs_diff(12 * 49);
    let law = laws.rank_sum().doubled_deviation();
    let p = law.tail(twice_off) * laws.exceedances().tail(of.of(statistics) as u64);
    -p.ln()
}

fn ranks(record: &[f64], seed: u64) -> f64 {
    let sides = [Side::Up, Side::Down];
    let chart = RankChart::new(Of::Normal, &sides, 0.8, 75).unwrap();
    let mut detector = chart.detector(1_000_000 * STEPS);
    let mut draws = ties(seed);
    for x in means(record, 20) {
        detector.step(x, 1.0 - crate::rng::unit(&mut draws));
    }
    units(detector.sums().map(|(_, sum)| sum).max().unwrap())
}

fn matched(record: &[f64]) -> f64 {
    let Told {
        ar,
        deviation,
        shape,
    } = told();
    let past = |at: usize, lag: usize| at.checked_sub(lag).map_or(0.0, |at| record[at]);
    let white = (0..record.len()).map(|at| record[at] - ar[0] * past(at, 1) - ar[1] * past(at, 2));
    let means = means(&white.collect::<Vec<_>>(), 20);
    let newest = &means[means.len() - 15..];
    let product: f64 = newest.iter().zip(&shape).map(|(y, s)| y * s).sum();
    let norm = shape.iter().map(|s| s * s).sum::<f64>().sqrt();
    product / norm / (deviation / 20f64.sqrt())
}

fn naive(detector: Detector, record: &[f64], seed: u64) -> f64 {
    let z = || standardised(record);
    let newest = |n: usize| &record[record.len() - n..];
    match detector {
        Detector::ThreeSample => three(record, Exceedances::Scale),
        Detector::Mended => three(record, Exceedances::Motion),
        Detector::Ranks => ranks(record, seed),
        Detector::Cusum => largest_sum(&z(), |z| z - 0.8),
        Detector::CusumVariance => {
            largest_sum(&z(), |z| log_normal(z, 1.6, 1.5) - log_normal(z, 0.0, 1.0))
        }
        Detector::Glr => largest_ratio(&z(), false),
        Detector::GlrVariance => largest_ratio(&z(), true),
        Detector::ZeroRule => newest(20).iter().map(|x| x.abs()).fold(0.0, f64::max),
        Detector::Uniform => (newest(50).iter().sum::<f64>() / 50.0).abs(),
        Detector::Clairvoyant => matched(record),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Step by step as from the whole record, where a block ends for all: after a multiple of 60 samples. Sums of up to
    /// 6000 numbers differ by rounding alone.
    #[test]
    fn steps_are_what_the_record_says(
        seed in 0..1000u64,
        length in 26..100usize,
        delta in -1.0..1.0f64,
        wider in 1.0..2.0f64,
    ) {
        let mut record = white_noise(60 * length, &mut Stream::new(seed, "record", "").at(0));
        let moved = record.len() - 60 * (seed as usize % 5);
        record[moved..].iter_mut().for_each(|x| *x = wider * *x + delta);
        for detector in ALL {
            let (step, batch) = (last(detector, &record, seed), naive(detector, &record, seed));
            prop_assert!((step - batch).abs() < 1e-9 * (1.0 + batch.abs()), "{detector}: {step} {batch}");
        }
    }

    /// A record that is looked through gives what its samples give one by one, before what is found and after it.
    #[test]
    fn a_record_is_its_samples(seed in 0..1000u64, skipped in 0..1600usize, at in 1500..1600usize) {
        let record = white_noise(1600, &mut Stream::new(seed, "record", "").at(0));
        for detector in ALL {
            let running = detector.start(&Tables::default(), &told(), ties(seed));
            let mut one_by_one = running.clone();
            let mut scores = Vec::new();
            for x in &record {
                one_by_one.find(&[*x], |score| {
                    scores.push(score);
                    true
                });
            }
            let largest = |scores: &[f64]| scores.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            prop_assert_eq!(running.clone().largest(&record, skipped), largest(&scores[skipped..]));
            let is_it = |score: f64| score >= scores[at];
            let first = scores.iter().position(|score| is_it(*score)).unwrap();
            let mut running = running;
            prop_assert_eq!(running.find(&record, is_it), Some(first));
            prop_assert_eq!(running.largest(&record[first + 1..], 0), largest(&scores[first + 1..]));
        }
    }
}

/// Before it has learnt a detector does not alarm; after 15 s every one has a score.
#[test]
fn all_have_learnt_after_the_same_time() {
    let record = white_noise(LEARNING + 20, &mut Stream::new(1, "record", "").at(0));
    for detector in ALL {
        assert!(last(detector, &record, 1).is_finite(), "{detector}");
        let first = last(detector, &record[..10], 1);
        assert_eq!(first.is_finite(), detector == Detector::ZeroRule);
    }
}

/// Readings that are all alike: blocks are ties, and the score of none is anything but a number.
#[test]
fn a_constant_record_has_scores() {
    for detector in ALL {
        let score = last(detector, &[1.0; LEARNING + 60], 1);
        assert!(score.is_finite(), "{detector}: {score}");
    }
}
