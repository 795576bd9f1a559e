//! Lifts, followed.

use super::watched::Watched;
use super::*;
use crate::study::outcomes::Of;
use crate::study::tests::{read, refusal, rows};

fn config(table: &str) -> String {
    format!("question = \"?\"\nseed = 3\ntrials = 4\n[height]\n{table}\n")
}

/// The car ends at a floor, and the barometer reads where that is and what the weather adds.
#[test]
fn a_record_is_of_its_truth() {
    let watched = Watched::new(5, 1, 0);
    let last = watched.truth.last().unwrap();
    assert!(
        watched
            .floors
            .iter()
            .any(|floor| (floor - last).abs() < 1e-9)
    );
    let barometer = watched.barometer(0.01);
    let (time, height) = barometer[barometer.len() - 1];
    assert!((height - last - 0.01 * time).abs() < 6.0 * 0.25);
}

#[test]
fn weather_is_what_the_floors_and_slow_heights_withstand() {
    let all = rows(
        &read::<Of<Table>>(&config("trips = 12\ndrift = [0.0, 1.0]")),
        4,
    );
    let of = |drift: f64, way: Way| {
        let outcome = format!("error_{}", way.name());
        let here = |row: &&Row| row.drift == drift && row.outcome == outcome;
        all.iter().find(here).unwrap().estimate
    };
    assert!(of(1.0, Way::Ukf) > 3.0 * of(0.0, Way::Ukf));
    assert!(of(1.0, Way::Calibrated) < of(1.0, Way::Ukf));
    assert!(of(1.0, Way::Map) < of(1.0, Way::Calibrated));
    assert!(of(1.0, Way::SlowMap) < of(1.0, Way::Map));
    assert_eq!(of(0.0, Way::Trips), of(1.0, Way::Trips));
}

#[test]
fn refusals() {
    let refused = |table: &str| refusal::<Table>(&config(table));
    assert_eq!(refused("trips = 5\ndrift = [0.0, 1.0]"), None);
    for (table, part) in [
        ("trips = 5\ndrift = []", "ascending"),
        ("trips = 5\ndrift = [1.0, 1.0]", "1 before 1"),
        ("trips = 1\ndrift = [1.0]", "[2, 1000] trips"),
        ("trips = 5\ndrift = [50.0]", "hPa an hour"),
    ] {
        let refusal = refused(table).unwrap_or_default();
        assert!(refusal.contains(part), "{refusal}");
    }
}
