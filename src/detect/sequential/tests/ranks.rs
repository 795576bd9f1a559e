//! Ranks and scores.

use super::*;
use crate::stats::chi_squared;

#[test]
fn agree_with_the_definition() {
    let mut draws = stream("definition").at(0);
    for step in [0.0, 0.5, 2.0] {
        let mut next = blocks(Law::Normal, step);
        let (mut ranks, mut seen) = (Ranks::default(), Vec::new());
        for _ in 0..200 {
            let (x, v) = (next(&mut draws), uniform(&mut draws));
            let below = seen.iter().filter(|it| **it < x).count() as f64;
            let equal = seen.iter().filter(|it| **it == x).count() as f64;
            seen.push(x);
            let expected = (below + v * (equal + 1.0)) / seen.len() as f64;
            assert_eq!(ranks.step(x, v), expected);
        }
    }
}

/// Every pair among the first six in 8 × 8 cells, for every law: 15 × 6 tests of 63 degrees, p < 1e-6/90 fails.
#[test]
fn are_uniform_and_independent() {
    let (runs, first, cells) = (40_000, 6, 8);
    for (name, law, step) in LAWS {
        let (mut next, mut draws) = (blocks(law, step), stream(name).at(1));
        let mut counts = vec![[0u32; 64]; first * first];
        for _ in 0..runs {
            let mut ranks = Ranks::default();
            let cell = |_| {
                let x = next(&mut draws);
                let u = ranks.step(x, uniform(&mut draws));
                ((u * f64::from(cells)) as usize).min(7)
            };
            let seen: Vec<usize> = (0..first).map(cell).collect();
            for (s, one) in seen.iter().enumerate() {
                for (t, other) in seen.iter().enumerate().skip(s + 1) {
                    counts[s * first + t][one * 8 + other] += 1;
                }
            }
        }
        let expected = f64::from(runs) / 64.0;
        let pairs = counts.iter().filter(|pair| pair.iter().sum::<u32>() > 0);
        let p_values = pairs.map(|pair| {
            let squares = pair.iter().map(|n| (f64::from(*n) - expected).powi(2));
            chi_squared::upper_tail(squares.sum::<f64>() / expected, 63)
        });
        let least = p_values.fold(1.0, f64::min);
        println!("{name}: n = {runs}, 15 pairs, least p = {least:.4}");
        assert!(least > 1e-6 / 90.0, "{name}");
    }
}

/// A score is a⁻¹ undone and rounded, and that of 1 − u its negative.
#[test]
fn scores_are_rounded() {
    let normal = Lattice::new(Score::Normal);
    let ranks = Lattice::new(Score::Ranks);
    for cell in 0..1000 {
        let u = (f64::from(cell) + 0.37) / 1000.0;
        let z = crate::stats::normal::quantile(u) * 40.0;
        assert_eq!(normal.score(u), z.round() as i32);
        let line = 12f64.sqrt() * (u - 0.5) * 40.0;
        assert_eq!(ranks.score(u), line.round().clamp(-69.0, 69.0) as i32);
        assert_eq!(normal.score(1.0 - u), -normal.score(u));
    }
    for (lattice, most) in [(normal, 160), (ranks, 69)] {
        assert_eq!([0.0, 1.0].map(|u| lattice.score(u)), [-most, most]);
    }
}

/// The share of the information about a small shift of normal noise that rounding and ends lose:
/// 1 − (E sZ)²/E s², with E(Z; a < Z < b) = φ(a) − φ(b).
#[test]
fn rounding_loses_little() {
    let density = |z: f64| (-z * z / 2.0).exp() / (2.0 * std::f64::consts::PI).sqrt();
    let law = Lattice::new(Score::Normal).law(Side::Up, |u| u);
    let end = |s: i32| (f64::from(s) - 0.5) / 40.0;
    let (mut product, mut square) = (0.0, 0.0);
    for s in -160i32..=160 {
        let low = if s == -160 { 0.0 } else { density(end(s)) };
        let high = if s == 160 { 0.0 } else { density(end(s + 1)) };
        product += units(s) * (low - high);
        square += units(s).powi(2) * law.mass(s);
    }
    let lost = 1.0 - product * product / square;
    println!("information lost: {lost:.3e}");
    let rounding = 1.0 / 12.0 / 1600.0;
    assert!(lost > 0.99 * rounding && lost < rounding + 1e-5);
}

#[test]
fn a_law_sums_to_one() {
    for score in [Score::Normal, Score::Ranks] {
        let lattice = Lattice::new(score);
        for side in [Side::Up, Side::Down, Side::Scale] {
            let law = lattice.law(side, |u| u);
            assert!((law.at_most(score.most()) - 1.0).abs() < 1e-14);
            assert!(law.mean().abs() < 1e-10);
            // Of a uniform U every side has the same law.
            let up = lattice.law(Side::Up, |u| u);
            let same = |s: i32| (law.mass(s) - up.mass(s)).abs() < 1e-15;
            assert!((-160..=160).all(same));
        }
        let all = lattice.law(Side::Up, |u| u);
        assert_eq!([all.at_most(500), all.at_least(500)], [1.0, 0.0]);
        assert_eq!([all.at_most(-500), all.at_least(-500)], [0.0, 1.0]);
    }
}

#[test]
fn refusals() {
    let refused = |sides: &[Side], k: f64, reference: usize| {
        let chart = Chart::new(Score::Ranks, sides, k, reference);
        chart.unwrap_err().to_string()
    };
    assert_eq!(
        refused(&[], 0.8, 60),
        "sides: must name each side once, got \"\""
    );
    let twice = [Side::Up, Side::Up];
    assert!(refused(&twice, 0.8, 60).ends_with("got \"up,up\""));
    let up = [Side::Up];
    assert_eq!(
        refused(&up, 0.81, 60),
        "k: must be a multiple of 0.025, got 0.81"
    );
    assert_eq!(
        refused(&up, 1.725, 60),
        "k: must lie in [0, 1.7], got 1.725"
    );
    assert!(refused(&up, f64::NAN, 60).contains("got NaN"));
    assert!(refused(&up, 0.8, 0).contains("reference: must lie in [1, 1000000] blocks, got 0"));
}
