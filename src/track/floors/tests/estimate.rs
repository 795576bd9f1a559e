//! The estimate: against closed forms, the general filter, and the truth.

use super::world::{LEVEL, MENDED, PRINTED, even_building, map_error, variance};
use crate::kalman::Estimate;
use crate::track::floors::hypothesis::{BEFORE, CAR, Hypothesis};
use crate::track::floors::scale::Scale;
use crate::track::floors::{Floors, Settings};

/// Cov(m_i, m_j) of a sweep, as the page gives it: the trips to the lower floor, σ_s² of the first stop, σ_s² of
/// its own.
#[test]
fn a_sweep_gives_the_stated_covariance() {
    let mut floors = Floors::unknown(MENDED).unwrap();
    let trips = [4.5, 3.0, 3.0, 9.0, 2.8];
    let variances = [1e-4, 4e-5, 5e-5, 2e-4, 3e-5];
    for (distance, variance) in trips.iter().zip(variances) {
        floors.step(*distance, variance);
    }
    let known = floors.map();
    let level = LEVEL * LEVEL;
    let below = |floor: usize| variances[..floor].iter().sum::<f64>();
    for i in 0..6 {
        assert!((known.heights[i] - trips[..i].iter().sum::<f64>()).abs() < 1e-12);
        for j in 0..6 {
            let shared = if i.min(j) > 0 {
                below(i.min(j)) + level
            } else {
                0.0
            };
            let own = if i == j && i > 0 { level } else { 0.0 };
            assert!(
                (known.covariance[i * 6 + j] - shared - own).abs() < 1e-15,
                "{i} {j}"
            );
        }
    }
}

/// A sweep from the top gives the same spacing.
#[test]
fn a_sweep_downwards() {
    let mut floors = Floors::unknown(MENDED).unwrap();
    for distance in [-3.0, -3.2, -4.5] {
        assert_eq!(floors.step(distance, 1e-4).added, Some(0));
    }
    let heights: Vec<f64> = floors.floors().iter().map(|floor| floor.height).collect();
    assert!(
        (heights[0] + 10.7).abs() < 1e-12 && heights[3] == 0.0,
        "{heights:?}"
    );
    let stop = floors.step(4.5, 1e-4);
    assert_eq!((stop.floor, stop.added), (Some(1), None));
    assert_eq!(floors.step(6.2, 1e-4).floor, Some(3));
}

/// Trips and updates of one hypothesis as the general filter makes them, with F, H and Q written out.
#[test]
fn agrees_with_the_general_filter() {
    let mut building = even_building(1);
    let floors = building.swept(MENDED);
    let known = floors.map();
    let mut ours = Hypothesis::of(&known.heights, &known.covariance, &MENDED);
    let n = 12;
    let mut theirs = Estimate {
        mean: [vec![0.0; 2], known.heights.clone()].concat(),
        covariance: vec![0.0; n * n],
    };
    for i in 0..10 {
        for j in 0..10 {
            theirs.covariance[(i + 2) * n + j + 2] = known.covariance[i * 10 + j];
        }
    }
    let level = LEVEL * LEVEL;
    for place in [0, 1, n, n + 1] {
        theirs.covariance[place] = level;
    }
    building.go(0, 0.0);
    for _ in 0..200 {
        let to = building.next();
        let trip = building.go(to, 0.0);
        let (distance, variance) = (trip.distance, trip.variance);
        ours.go(distance, variance);
        ours.stop_at(Some(to), &MENDED);
        let mut transition = vec![0.0; n * n];
        (0..n).for_each(|i| transition[i * n + i] = 1.0);
        (transition[n], transition[n + 1]) = (1.0, 0.0);
        let mut noise = vec![0.0; n * n];
        noise[0] = variance;
        let mut input = vec![0.0; n];
        input[0] = distance;
        theirs.predict(&transition, &input, &noise);
        let mut row = vec![0.0; n];
        (row[0], row[2 + to]) = (1.0, -1.0);
        theirs.update(&row, 0.0, level);
        assert!((ours.car().mean - theirs.mean[0]).abs() < 1e-9);
        assert!((ours.car().variance - theirs.covariance[0]).abs() < 1e-12);
        for floor in 0..10 {
            let height = ours.height(floor);
            assert!((height.mean - theirs.mean[2 + floor]).abs() < 1e-9);
            let place = (2 + floor) * n + 2 + floor;
            assert!((height.variance - theirs.covariance[place]).abs() < 1e-12);
        }
    }
}

/// ξ judged again = ξ + ξ′ − ξ″: two ways to write the likelihood of two stops.
#[test]
fn judged_again_is_the_difference_of_two_courses() {
    let mut building = even_building(2);
    let mut at_floors = {
        let known = building.settled(MENDED, 50).map();
        Hypothesis::of(&known.heights, &known.covariance, &MENDED)
    };
    let xi = |of: &Hypothesis, at, floor| of.offset(at, floor, &MENDED).xi();
    at_floors.go(9.04, variance(9.0));
    let first = xi(&at_floors, CAR, 3);
    let mut off = at_floors.clone();
    off.stop_at(None, &MENDED);
    at_floors.stop_at(Some(3), &MENDED);
    for of in [&mut at_floors, &mut off] {
        of.go(2.97, variance(3.0));
    }
    let (at_floor, off_floor) = (xi(&at_floors, CAR, 4), xi(&off, CAR, 4));
    off.stop_at(Some(4), &MENDED);
    let again = xi(&off, BEFORE, 3);
    let difference = first + at_floor - off_floor;
    assert!(
        (again - difference).abs() < 1e-9 * difference,
        "{again} {difference}"
    );
}

/// Against the truth: after the sweep and after 1000 trips. 1.41 and 0.15 cm are seen; the issue asks for 2.3 and
/// 0.3. The normalised error is a mean over 9 floors × the buildings of χ²: its deviation is at most √2 per
/// building however floors depend on each other.
#[test]
fn maps_are_as_good_as_they_say() {
    for (settings, seen) in [(MENDED, 40), (PRINTED, 10)] {
        let [mut early, mut late] = [(0.0, 0.0); 2];
        for seed in 0..seen {
            let mut building = even_building(seed);
            let mut floors = building.swept(settings);
            let swept = map_error(&floors, &building);
            for _ in 0..1000 {
                building.ride(&mut floors);
            }
            let settled = map_error(&floors, &building);
            early = (early.0 + swept.0, early.1 + swept.1);
            late = (late.0 + settled.0, late.1 + settled.1);
        }
        let each = seen as f64;
        let rms = [early, late].map(|sum| (sum.0 / each).sqrt());
        let nees = [early, late].map(|sum| sum.1 / each);
        println!("{each} buildings: RMS {rms:?} m, NEES {nees:?}");
        assert!(rms[0] < 0.023 && rms[1] < 0.003, "{rms:?}");
        let spread = 5.0 * (2.0 / (9.0 * each)).sqrt();
        assert!(
            nees.iter().all(|nees| (nees - 1.0).abs() < spread),
            "{nees:?}"
        );
    }
}

#[test]
fn the_scale_is_the_median_over_that_of_chi_squared() {
    let factor = |values: &[f64], window| Scale::new(window, values.iter().copied()).factor();
    let median = 0.454_936_423_119_572_7;
    // P(χ²₁ ≥ the median) = ½.
    assert!((crate::stats::chi_squared::upper_tail(median, 1) - 0.5).abs() < 1e-15);
    let odd: Vec<f64> = [5.0, 1.0, 9.0, 2.0, 8.0, 3.0, 7.0, 4.0, 6.0, 11.0, 10.0].into();
    assert!((factor(&odd, 200) - 6.0 / median).abs() < 1e-12);
    assert!((factor(&odd, 10) - 6.5 / median).abs() < 1e-12);
    assert_eq!((factor(&odd, 9), factor(&odd, 0)), (1.0, 1.0));
    assert_eq!(factor(&[0.1; 20], 200), 1.0);
}

/// A floor that has moved shows as a drift, the others do not.
#[test]
fn a_floor_that_moved_drifts() {
    let mut building = even_building(3);
    let mut floors = building.settled(MENDED, 300);
    building.heights[4] += 0.05;
    for _ in 0..1000 {
        building.ride(&mut floors);
    }
    for (at, floor) in floors.floors().iter().enumerate() {
        let xi = (floor.drift / floor.drift_deviation.max(LEVEL)).powi(2);
        println!("{at}: {floor:?}");
        assert_eq!(xi > MENDED.threshold, at == 4, "{at}: {floor:?}");
    }
}

/// Drifts of floors that have not moved have the stated deviation, √(P₀ − P). Floors of one building depend on each
/// other: as one number per building the mean has a deviation of at most √(2/400), a fifth of the tolerance.
#[test]
fn drifts_are_as_small_as_they_say() {
    let (mut sum, buildings) = (0.0, 400);
    for seed in 0..buildings {
        let floors = even_building(seed).settled(MENDED, 300).floors();
        let squares = floors[1..]
            .iter()
            .map(|floor| floor.drift / floor.drift_deviation);
        sum += squares.map(|drift| drift * drift).sum::<f64>() / 9.0;
    }
    let mean = sum / buildings as f64;
    println!("{mean}");
    assert!((mean - 1.0).abs() < 0.35);
}

/// Where one floor is known to metres, its ξ is small for every stop: least ξ gives it the stops of others.
#[test]
fn an_uncertain_floor_takes_no_stops_of_others() {
    let known = {
        let mut building = even_building(4);
        let mut known = building.swept(MENDED).map();
        // The floor 5 from a plan, ± 2 m.
        for i in 0..10 {
            (known.covariance[5 * 10 + i], known.covariance[i * 10 + 5]) = (0.0, 0.0);
        }
        known.covariance[55] = 4.0;
        known
    };
    let wrong = |settings: Settings| {
        let mut wrong = 0;
        for seed in 0..100 {
            let mut building = even_building(seed);
            let mut floors =
                Floors::known(settings, &known, super::super::Start::Floor(0)).unwrap();
            for to in [4, 6, 3] {
                let stop = building.stop(&mut floors, to, 0.0);
                wrong += usize::from(stop.judgement.unwrap().floor != to);
            }
        }
        wrong
    };
    let nearest = super::super::Association::Nearest;
    let [by_xi, by_likelihood] = [
        Settings {
            association: nearest,
            ..MENDED
        },
        MENDED,
    ]
    .map(wrong);
    println!("of 300 stops {by_xi} by ξ, {by_likelihood} by ξ + ln S");
    assert!(by_xi > 20 && by_likelihood == 0);
}
