//! The simulated trips against their truth, and the bound against its own law.

use super::condition::{Condition, Numbers};
use super::trial::{self, Way};
use super::*;
use crate::study::tests::refusal;

const ALL: [Condition; 10] = [
    Condition::Typical,
    Condition::SoftBrake,
    Condition::SlowJerk,
    Condition::Creep,
    Condition::Rough,
    Condition::GainAsymmetry,
    Condition::Phone,
    Condition::CoarseSteps,
    Condition::Hz50,
    Condition::Hz400,
];

/// Samples are mean accelerations, so their double sum is the distance to an error of their spacing.
#[test]
fn trips_go_as_far_as_they_should() {
    for condition in ALL {
        let numbers = Numbers {
            rate: 500.0,
            ..condition.numbers()
        };
        for distance in [1.5, 9.0, 27.0] {
            let ride = numbers.ride(distance, [2.0, 3.0]);
            let (mut speed, mut way) = (0.0f64, 0.0f64);
            for a in ride.acceleration() {
                way += (speed + a / 1000.0) / 500.0;
                speed += a / 500.0;
            }
            assert!(speed.abs() < 1e-9, "{condition}");
            assert!((way - distance).abs() < 2e-3, "{condition}: {way}");
            let levels = ride.journeys()[0].levelling.is_some();
            assert_eq!(levels, condition == Condition::Creep);
        }
    }
}

/// The moment formula is linear and its variance exact: a sum of 60 squares of normal variables is below 19.7 or above 129
/// in one of a million records each. As tracked the trips are those of the tests of [`crate::track`].
#[test]
fn the_bound_is_its_own_law() {
    const TRIPS: u64 = 60;
    for condition in [Condition::Typical, Condition::Creep] {
        let point = Point {
            condition,
            distance: 9.0,
        };
        let mut sums = trial::shape().empty().sums;
        (0..TRIPS).for_each(|trial| sums.add(&trial::run(&point, 5, trial)));
        let nees = |way: Way| sums.lengths[way.lengths() + 4].value();
        let moments = nees(Way::Moments);
        assert!((19.7..129.0).contains(&moments), "{condition}: {moments}");
        let rows = estimate::of(&sums, TRIPS, 0.95);
        let told = rows.iter().find(|row| row.outcome == "told_track").unwrap();
        assert!(told.count >= TRIPS - 1, "{condition}: {told:?}");
    }
}

#[test]
fn tables_that_mean_nothing_are_refused() {
    let refusal = |table: &str| {
        let text = format!("question = \"?\"\nseed = 1\ntrials = 2\n[trips]\n{table}");
        refusal::<Table>(&text)
    };
    let told = "condition = [\"typical\"]";
    assert_eq!(refusal(&format!("distance = [3, 9]\n{told}")), None);
    for (table, part) in [
        (
            format!("distance = []\n{told}"),
            "name a condition and a distance",
        ),
        (format!("distance = [9, 3]\n{told}"), "in ascending order"),
        (format!("distance = [0.5]\n{told}"), "[1, 200]"),
        (
            "distance = [3]\ncondition = [\"creep\", \"creep\"]".to_owned(),
            "each condition once",
        ),
    ] {
        let refusal = refusal(&table).unwrap_or_default();
        assert!(refusal.contains(part), "{table}: {refusal}");
    }
}
