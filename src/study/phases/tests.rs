//! Trips, followed.

use super::*;
use crate::study::outcomes::Of;
use crate::study::tests::{read, refusal, rows};

fn config(table: &str) -> String {
    format!(
        "question = \"?\"\nseed = 3\ntrials = 30\n[phases]\nmeasure = \"spacing\"\ndistance = 9\n{table}\n"
    )
}

#[test]
fn a_quiet_sensor_shows_every_phase() {
    let table = "condition = [\"phone\"]\nvibration = [0.0, 0.1]\nthreshold = [0.1, 0.4]";
    let all = rows(&read::<Of<Table>>(&config(table)), 30);
    let of = |vibration: f64, threshold: f64, outcome: &str| {
        let here = |row: &&Row| {
            (row.vibration, row.threshold) == (vibration, threshold) && row.outcome == outcome
        };
        all.iter().find(here).unwrap().estimate
    };
    for way in Way::ALL {
        for outcome in ["told", "direction", "phases"] {
            let outcome = format!("{outcome}_{}", way.name());
            assert_eq!(of(0.0, 0.1, &outcome), 1.0, "{outcome}");
        }
    }
    // A threshold h cuts h²/2j off each of four feet of a ramp; what is cut off one change delays the other.
    assert!(of(0.0, 0.1, "error_track") < 0.02);
    assert!(of(0.0, 0.4, "error_printed") > of(0.0, 0.1, "error_printed"));
    // Readings that shake beyond the threshold are no uniform motion.
    assert_eq!(of(0.1, 0.1, "phases_printed"), 0.0);
    assert!(of(0.1, 0.1, "phases_track") > 0.7);
}

#[test]
fn refusals() {
    let refused = |table: &str| refusal::<Table>(&config(table));
    let with = |vibration: &str, threshold: &str| {
        refused(&format!(
            "condition = [\"phone\"]\nvibration = {vibration}\nthreshold = {threshold}"
        ))
    };
    assert_eq!(with("[0.0]", "[0.1, 0.2]"), None);
    for (vibration, threshold, part) in [
        ("[]", "[0.1]", "name a condition and a vibration"),
        ("[0.0]", "[]", "name a condition and a threshold"),
        ("[0.0]", "[0.2, 0.1]", "ascending"),
        ("[0.0]", "[0]", "[0.01, 1]"),
    ] {
        let refusal = with(vibration, threshold).unwrap_or_default();
        assert!(refusal.contains(part), "{refusal}");
    }
}
