//! What is no map is refused; what is one never leads to nonsense.

use super::world::{MENDED, PRINTED};
use crate::track::floors::{Floors, Map, Settings, Start};
use proptest::prelude::*;

fn refusal(settings: Settings, heights: &[f64], start: Start) -> String {
    Floors::given(settings, heights, 0.01, start)
        .unwrap_err()
        .to_string()
}

#[test]
fn no_maps() {
    let two = [0.0, 3.0];
    let at = Start::Floor(0);
    let cases = [
        (
            refusal(MENDED, &[], at),
            "floors: must be at least 2 and at most 200, got 0",
        ),
        (
            refusal(MENDED, &[3.0], at),
            "floors: must be at least 2 and at most 200, got 1",
        ),
        (
            refusal(MENDED, &[0.0, 3.0, 2.5], at),
            "floors[2]: must lie more than σ_s = 0.002 m above the floor before it, 3 m, got 2.5 m",
        ),
        (
            refusal(MENDED, &[0.0, 3.0, 3.001], at),
            "floors[2]: must lie more than σ_s",
        ),
        (
            refusal(MENDED, &[0.0, f64::NAN], at),
            "floors[1]: must be finite and within 10000 m of the first, got NaN",
        ),
        (
            refusal(MENDED, &[0.0, 2e4], at),
            "floors[1]: must be finite",
        ),
        (
            refusal(MENDED, &two, Start::Floor(2)),
            "at: must be one of 2 floors, from 0 up, got 2",
        ),
        (
            refusal(
                Settings {
                    level: 0.0,
                    ..MENDED
                },
                &two,
                at,
            ),
            "level: must lie in [0.00001, 0.1] m, got 0",
        ),
        (
            refusal(
                Settings {
                    threshold: 0.0,
                    ..MENDED
                },
                &two,
                at,
            ),
            "threshold: must be positive and finite, got 0",
        ),
        (
            refusal(
                Settings {
                    threshold: -1.0,
                    ..PRINTED
                },
                &two,
                at,
            ),
            "threshold: must be positive",
        ),
        (
            refusal(
                Settings {
                    missed: Some(0.0),
                    ..MENDED
                },
                &two,
                at,
            ),
            "missed: must be positive",
        ),
    ];
    for (refusal, expected) in cases {
        assert!(refusal.starts_with(expected), "{refusal}");
    }
    assert!(Floors::given(MENDED, &two, 0.0, at).is_ok());
    assert!(Floors::given(MENDED, &two, f64::NAN, at).is_err());
    let negative = Map {
        covariance: vec![0.0, 0.0, 0.0, -1e-4],
        ..Floors::given(MENDED, &two, 0.01, at).unwrap().map()
    };
    let refused = Floors::known(MENDED, &negative, at)
        .unwrap_err()
        .to_string();
    assert!(refused.starts_with("covariance: must"), "{refused}");
    let none = Settings {
        level: f64::NAN,
        ..MENDED
    };
    assert!(Floors::unknown(none).is_err());
}

proptest! {
    /// Any trips, one after the other, in any building: numbers stay numbers, floors stay in order, exactly known
    /// ones too.
    #[test]
    fn any_trips(
        is_given in any::<bool>(),
        is_exact in any::<bool>(),
        is_mended in any::<bool>(),
        trips in proptest::collection::vec((-30.0..30.0f64, -12.0..2.0f64, 0..20usize), 1..60),
    ) {
        let settings = if is_mended { MENDED } else { PRINTED };
        let deviation = if is_exact { 0.0 } else { 0.02 };
        let mut floors = if is_given {
            Floors::given(settings, &[0.0, 3.0, 6.0, 9.5], deviation, Start::Unknown).unwrap()
        } else {
            Floors::unknown(settings).unwrap()
        };
        for (distance, decades, lost) in trips {
            let stop = floors.step(distance, 10_f64.powf(decades));
            if lost == 0 {
                floors.lose();
            }
            prop_assert!(stop.position.is_finite() && stop.deviation >= 0.0, "{stop:?}");
            prop_assert!(stop.probability > 0.0 && stop.probability <= 1.0, "{stop:?}");
            let all = floors.floors();
            prop_assert!(stop.floor.is_none_or(|floor| floor < all.len()));
            prop_assert!(all.iter().all(|floor| floor.height.is_finite() && floor.deviation >= 0.0));
            for judgement in [stop.judgement, stop.earlier].into_iter().flatten() {
                prop_assert!(judgement.xi >= 0.0 && judgement.deviation > 0.0, "{judgement:?}");
            }
        }
        // What it knows is a map again, unless a single floor is known or updates have moved one beyond another.
        let known = floors.map();
        let is_ordered = known.heights.windows(2).all(|pair| pair[1] - pair[0] > settings.level);
        let again = Floors::known(settings, &known, Start::Unknown);
        prop_assert_eq!(again.is_ok(), known.heights.len() > 1 && is_ordered, "{:?}", again.err());
    }
}

/// A trip of one storey from an unknown floor fits two; which, the next trips tell, and nothing was wrong.
#[test]
fn an_unknown_start_is_no_alarm() {
    for level in [0.02, 0.05] {
        let heights = [0.0, 3.2, 6.4, 10.4];
        let mut floors = Floors::given(Settings::MENDED, &heights, level, Start::Unknown).unwrap();
        for distance in [3.19, 3.2, 3.99, -10.41, 3.2] {
            let stop = floors.step(distance, 1e-4);
            let judgements = [stop.judgement, stop.earlier];
            let mut judgements = judgements.iter().flatten();
            assert!(judgements.all(|it| it.fault.is_none()), "{stop:?}");
        }
        assert!(floors.step(-1.5, 1e-4).judgement.unwrap().fault.is_some());
        assert!(floors.step(1.5, 1e-4).earlier.unwrap().fault.is_some());
    }
}
