//! Rides, judged.

use super::*;
use crate::study::outcomes::Of;
use crate::study::tests::{read, refusal, rows};

fn config(list: &str, vibration: &str) -> String {
    format!(
        "question = \"?\"\nseed = 3\ntrials = 40\n[quality]\ncondition = {list}\nvibration = {vibration}\n"
    )
}

/// Without vibration what a sensor shows of it is noise, and nearly always called so; the drive is told right.
#[test]
fn a_quiet_ride_shows_the_sensor() {
    let study = read::<Of<Table>>(&config("[\"typical\"]", "[0.0, 0.1]"));
    let all = rows(&study, 40);
    let of = |vibration: f64, outcome: &str| {
        let here = |row: &&Row| row.vibration == vibration && row.outcome == outcome;
        all.iter().find(here).unwrap().estimate
    };
    // 1.1 m/s², reached with 2 m/s³; 1.6 m/s.
    assert!((of(0.0, "true_acceleration") - 1.1).abs() < 0.02);
    assert!((of(0.0, "true_speed_95") - 1.6).abs() < 0.01);
    assert!((of(0.0, "true_jerk") - 2.0).abs() < 0.15);
    assert!(of(0.0, "bias_vertical_95") > 0.02);
    assert!(of(0.0, "noise_vertical_95") > 0.8);
    assert!(of(0.1, "noise_vertical_95") < 0.2);
    assert!(of(0.1, "bias_vertical_95").abs() < 0.1 * of(0.1, "true_vertical_95"));
}

#[test]
fn refusals() {
    let refused = |list: &str, vibration: &str| refusal::<Table>(&config(list, vibration));
    assert!(
        refused("[]", "[0.1]")
            .unwrap()
            .contains("name a condition and a vibration")
    );
    let twice = refused("[\"phone\", \"phone\"]", "[0.1]").unwrap();
    assert!(twice.contains("phone twice"), "{twice}");
    assert!(
        refused("[\"phone\"]", "[0.1, 0.1]")
            .unwrap()
            .contains("ascending")
    );
    assert_eq!(refused("[\"phone\"]", "[0.1]"), None);
}
