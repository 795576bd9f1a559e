//! Against comparing the samples at every Δ.

use super::*;
use crate::detect::{Pooled, Statistics};
use proptest::prelude::*;

/// W and T at every Δ by comparing the samples there.
fn compared(deltas: &[f64], reference: &[f64], shift: Lines, scale: Lines) -> Vec<Statistics> {
    let at = |lines: Lines, delta: f64| -> Vec<f64> {
        let lines = lines.base.iter().zip(lines.slope);
        lines.map(|(base, slope)| base + delta * slope).collect()
    };
    let statistics = |&delta: &f64| {
        let (shift, scale) = (at(shift, delta), at(scale, delta));
        let pooled = Pooled {
            reference,
            shift: &shift,
            scale: &scale,
        };
        pooled.statistics(|| unreachable!("no ties"))
    };
    deltas.iter().map(statistics).collect()
}

/// A few slopes, some zero or negative, as the first samples of Y₂ and late motions have.
fn slopes() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), Just(3.287), -2.0..4.0]
}

fn grids() -> impl Strategy<Value = Vec<f64>> {
    let even = (-2.0..1.0, 0.01..0.5, 2usize..70)
        .prop_map(|(start, step, points)| (0..points).map(|i| start + i as f64 * step).collect());
    let uneven = prop::collection::btree_set(-300i32..300, 2..40)
        .prop_map(|set| set.into_iter().map(|i| f64::from(i) / 97.0).collect());
    prop_oneof![even, uneven]
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: prop::test_runner::RngSeed::Fixed(2014), cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn agree_with_comparing(
        deltas in grids(),
        sizes in (1usize..14, 1usize..14, 1usize..14),
        values in prop::collection::vec(-6.0..6.0, 42),
        slopes in prop::collection::vec(slopes(), 28),
    ) {
        let (n, m1, m2) = sizes;
        let shift = Lines { base: &values[14..14 + m1], slope: &slopes[..m1] };
        let scale = Lines { base: &values[28..28 + m2], slope: &slopes[14..14 + m2] };
        let expected = compared(&deltas, &values[..n], shift, scale);
        for vectors in Vectors::available() {
            let mut crossings = Crossings::new(vectors, deltas.clone(), true);
            // Twice, because nothing of one trial may leak into the next.
            for _ in 0..2 {
                let along = crossings.count(&values[..n], shift, scale).expect("no near tie");
                let counted: Vec<_> = (0..deltas.len()).map(|number| along.at(number)).collect();
                prop_assert_eq!(&counted, &expected);
            }
            let mut without = Crossings::new(vectors, deltas.clone(), false);
            let along = without.count(&values[..n], shift, scale).expect("no near tie");
            for (number, expected) in expected.iter().enumerate() {
                prop_assert_eq!(along.at(number), Statistics { shift_exceedances: 0, ..*expected });
            }
        }
    }
}

/// Ties at a Δ, or close to one, are left undecided.
#[test]
fn near_ties_are_in_doubt() {
    let mut even = Crossings::new(Vectors::Baseline, vec![0.0, 0.5, 1.0, 1.5], true);
    let mut uneven = Crossings::new(Vectors::Baseline, vec![0.0, 0.4, 1.0, 1.5], true);
    let scale = Lines {
        base: &[7.0],
        slope: &[0.0],
    };
    let of = |crossings: &mut Crossings, x: f64, slope: f64, scale| {
        let shift = Lines {
            base: &[-2.0],
            slope: &[slope],
        };
        crossings.count(&[x, -5.0], shift, scale).is_some()
    };
    for crossings in [&mut even, &mut uneven] {
        assert!(of(crossings, 0.1, 2.0, scale));
        assert!(!of(crossings, 0.0, 2.0, scale));
        assert!(!of(crossings, 1e-13, 2.0, scale));
        assert!(!of(crossings, -2.0, 0.0, scale));
        assert!(!of(
            crossings,
            0.1,
            2.0,
            Lines {
                base: &[0.1],
                slope: &[0.0]
            }
        ));
        assert!(!of(
            crossings,
            0.1,
            2.0,
            Lines {
                base: &[1.1],
                slope: &[-1.0]
            }
        ));
    }
}
