//! Laws against enumerations, recursions and formulas.

use super::super::joint;
use super::*;
use std::collections::HashMap;

fn sizes(n: usize, m1: usize, m2: usize) -> Samples {
    Samples::contiguous(n, m1, m2).unwrap()
}

/// All sequences of 0 (X), 1 (Y₁) and 2 (Y₂) with these counts: every rank vector once.
fn enumerate(left: [usize; 3], row: &mut Vec<u8>, visit: &mut impl FnMut(&[u8])) {
    if left == [0; 3] {
        return visit(row);
    }
    for label in 0..3 {
        if left[label] > 0 {
            let mut rest = left;
            rest[label] -= 1;
            row.push(label as u8);
            enumerate(rest, row, visit);
            row.pop();
        }
    }
}

/// W, T and T′ of a row of labels, by their definitions.
fn statistics(row: &[u8]) -> (u64, u64, u64) {
    let ranks = |label| {
        (1..)
            .zip(row)
            .filter(move |(_, l)| **l == label)
            .map(|(r, _)| r)
    };
    let (low, high) = (ranks(0).min().unwrap(), ranks(0).max().unwrap());
    let outside = |label| ranks(label).filter(|&r| r < low || r > high).count() as u64;
    (ranks(1).sum(), outside(2), outside(1) + outside(2))
}

/// How often each W occurs with each number of exceedances.
type Joint = HashMap<(u64, u64), u64>;

/// How often each (W, T) and each (W, T′) occurs among all rank vectors, and their number.
fn enumerated(sizes: [usize; 3]) -> ([Joint; 2], u64) {
    let mut joint: [Joint; 2] = Default::default();
    let mut all = 0;
    enumerate(sizes, &mut Vec::new(), &mut |row| {
        let (w, of_scale, of_motion) = statistics(row);
        *joint[0].entry((w, of_scale)).or_default() += 1;
        *joint[1].entry((w, of_motion)).or_default() += 1;
        all += 1;
    });
    (joint, all)
}

const SMALL: [[usize; 3]; 10] = [
    [1, 1, 1],
    [1, 3, 2],
    [2, 2, 2],
    [2, 1, 5],
    [2, 3, 4],
    [3, 3, 3],
    [5, 2, 3],
    [3, 5, 2],
    [6, 3, 1],
    [4, 4, 4],
];

/// (13) and (14) by enumeration: joint counts times the number of all rank vectors equal the
/// product of the marginal counts, in integers, and the marginals are the laws here.
#[test]
fn enumeration_of_all_rank_vectors() {
    for [n, m1, m2] in SMALL {
        let ([joint, _], all) = enumerated([n, m1, m2]);
        let samples = sizes(n, m1, m2);
        let (w, t) = (
            NullLaw::rank_sum(&samples).unwrap(),
            NullLaw::exceedances(Exceedances::Scale, &samples).unwrap(),
        );
        let cases = w.total() * t.total();
        assert_eq!(cases, BigUint::from(all), "{n}/{m1}/{m2}: (13)");
        for rank_sum in w.first()..=w.last() {
            for exceedances in 0..=m2 as u64 {
                let counted = joint.get(&(rank_sum, exceedances)).copied().unwrap_or(0);
                let product = w.count(rank_sum) * t.count(exceedances);
                assert_eq!(
                    product,
                    BigUint::from(counted),
                    "{n}/{m1}/{m2} {rank_sum} {exceedances}"
                );
            }
        }
    }
}

/// The joint counts of W and T′ are those of the enumeration, cell by cell.
#[test]
fn joint_law_is_that_of_all_rank_vectors() {
    for [n, m1, m2] in SMALL {
        let ([_, joint], _) = enumerated([n, m1, m2]);
        let first = smallest_rank_sum(m1);
        for (t, column) in (0..).zip(joint::counts(&sizes(n, m1, m2))) {
            for (w, count) in (first..).zip(column) {
                let counted = joint.get(&(w, t)).copied().unwrap_or(0);
                assert_eq!(count, BigUint::from(counted), "{n}/{m1}/{m2} {w} {t}");
            }
        }
    }
}

/// The joint counts of larger sizes add up to both marginal laws, each times the ways to arrange the rest.
#[test]
fn joint_law_has_the_known_marginals() {
    for [n, m1, m2] in [[12, 12, 12], [24, 12, 9], [2, 9, 14], [20, 3, 8]] {
        let samples = sizes(n, m1, m2);
        let columns = joint::counts(&samples);
        let w = NullLaw::rank_sum(&samples).unwrap();
        let t = NullLaw::exceedances(Exceedances::Motion, &samples).unwrap();
        let all = w.total() * choose((n + m2) as u128, n as u128);
        for (i, rank_sum) in (w.first()..=w.last()).enumerate() {
            let cases: BigUint = columns.iter().map(|column| &column[i]).sum();
            assert_eq!(cases * w.total(), w.count(rank_sum) * &all);
        }
        for (exceedances, column) in (0..).zip(&columns) {
            let cases: BigUint = column.iter().sum();
            assert_eq!(cases * t.total(), t.count(exceedances) * &all);
        }
    }
}

/// The additive recursion: the largest pooled value belongs to Y₁ or does not.
fn recursion(m: usize, l: usize) -> Vec<u128> {
    let mut table = vec![vec![vec![1u128]; l + 1]; m + 1];
    for m in 1..=m {
        for l in 1..=l {
            let mut counts = vec![0; m * l + 1];
            for (u, count) in table[m - 1][l].iter().enumerate() {
                counts[u + l] += count;
            }
            for (u, count) in table[m][l - 1].iter().enumerate() {
                counts[u] += count;
            }
            table[m][l] = counts;
        }
    }
    table[m][l].clone()
}

#[test]
fn rank_sum_agrees_with_the_recursion() {
    for (n, m1, m2) in [(12, 12, 12), (30, 20, 25)] {
        let law = NullLaw::rank_sum(&sizes(n, m1, m2)).unwrap();
        for (u, count) in recursion(m1, n + m2).into_iter().enumerate() {
            assert_eq!(law.count(law.first() + u as u64), BigUint::from(count));
        }
    }
}

fn choose(n: u128, k: u128) -> u128 {
    (0..k).fold(1, |c, i| c * (n - i) / (i + 1))
}

#[test]
fn exceedances_agree_with_the_formula() {
    for (n, m2) in [(12u128, 12u128), (30, 25), (2, 7)] {
        let law =
            NullLaw::exceedances(Exceedances::Scale, &sizes(n as usize, 1, m2 as usize)).unwrap();
        assert_eq!(*law.total(), BigUint::from(choose(n + m2, n)));
        for t in 0..=m2 {
            let count = (t + 1) * choose(n + m2 - t - 2, n - 2);
            assert_eq!(law.count(t as u64), BigUint::from(count));
            let exact = count as f64 / choose(n + m2, n) as f64;
            assert!((law.mass(t as u64) / exact - 1.0).abs() < 1e-15);
        }
    }
}

#[test]
fn anchors() {
    let samples = sizes(12, 12, 12);
    let (w, t) = (
        NullLaw::rank_sum(&samples).unwrap(),
        NullLaw::exceedances(Exceedances::Scale, &samples).unwrap(),
    );
    assert_eq!(w.critical(0.01), 291);
    assert!((w.tail(291) - 0.009972063).abs() < 5e-10);
    assert!((t.tail(7) - 0.0135953695).abs() < 5e-11);
    assert!((t.tail(8) - 0.004711267).abs() < 5e-10);
    assert_eq!((w.first(), w.last()), (78, 366));
    assert_eq!(w.critical(0.0), 367);
}

/// No overflow, and no tail is lost: the last mass is 1/C(600, 200), about 1e-165.
#[test]
fn large_sizes_keep_their_tails() {
    let law = NullLaw::rank_sum(&sizes(200, 200, 200)).unwrap();
    let last = (0..200).fold(1.0, |p, i| p * f64::from(200 - i) / f64::from(600 - i));
    assert!((law.mass(law.last()) / last - 1.0).abs() < 1e-12);
    assert_eq!(law.tail(law.first()), 1.0);
    let t = NullLaw::exceedances(Exceedances::Scale, &sizes(200, 200, 200)).unwrap();
    assert!(t.tail(200) > 0.0 && t.tail(0) == 1.0);
}

#[test]
fn doubled_deviation_folds_the_law() {
    for (n, m1, m2) in [(3, 2, 2), (3, 3, 2), (12, 12, 12)] {
        let law = NullLaw::rank_sum(&sizes(n, m1, m2)).unwrap();
        let folded = law.doubled_deviation();
        let centre = law.first() + law.last();
        for deviation in 0..=folded.last() {
            let direct: f64 = (law.first()..=law.last())
                .filter(|w| (2 * w).abs_diff(centre) >= deviation)
                .map(|w| law.mass(w))
                .sum();
            assert!((folded.tail(deviation) - direct).abs() < 1e-12);
        }
    }
}

#[test]
fn refuses_what_does_not_fit_and_says_how_much() {
    let error = NullLaw::rank_sum(&sizes(100_000, 100_000, 100_000)).unwrap_err();
    assert!(error.to_string().contains("MB"), "{error}");
    assert!(NullLaw::rank_sum(&sizes(5000, 12, 5000)).is_ok());
    let error = NullLaw::exceedances(Exceedances::Scale, &sizes(300_000, 1, 300_000)).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("laws of W and T at 300000/1/300000"),
        "{error}"
    );
}

#[test]
fn ratio_rounds_to_nearest() {
    let big = |x: u64| BigUint::from(x);
    assert_eq!(ratio(&big(1), &big(100)), 0.01);
    assert_eq!(ratio(&big(1), &big(3)), 1.0 / 3.0);
    assert_eq!(ratio(&big(2), &big(3)), 2.0 / 3.0);
    assert_eq!(ratio(&big(0), &big(3)), 0.0);
    assert_eq!(
        ratio(
            &(BigUint::from(1u8) << 2000u32),
            &(BigUint::from(1u8) << 2900u32)
        ),
        2f64.powi(-900)
    );
}
