//! Lifts in the air.

use super::*;
use crate::study::outcomes::Of;
use crate::study::tests::{read, refusal, rows};

fn config(table: &str) -> String {
    format!("question = \"?\"\nseed = 3\ntrials = 20\n[air]\n{table}\n")
}

/// The scale of (5) is that of the standard atmosphere at the pressure, 288.15 K less 6.5 K a kilometre, over the air's.
#[test]
fn the_standard_atmosphere_has_its_own_scale() {
    let table = "trips = 20\ntemperature = [5.0, 30.0]\npressure = [755.0, 1013.25]";
    let all = rows(&read::<Of<Table>>(&config(table)), 20);
    let of = |outcome: &str, temperature: f64, pressure: f64| {
        let here = |row: &&Row| {
            (row.temperature, row.pressure) == (temperature, pressure) && row.outcome == outcome
        };
        all.iter().find(here).unwrap().estimate
    };
    for (temperature, pressure, km) in [(5.0, 1013.25, 0.0), (30.0, 755.0, 2.428)] {
        let expected = (288.15 - 6.5 * km) / (temperature + 273.15);
        let scale = of("scale_printed", temperature, pressure);
        assert!((scale / expected - 1.0).abs() < 0.004, "{scale} {expected}");
        let usual = of("scale_usual", temperature, pressure);
        assert!(
            (usual * (temperature + 273.15) / 293.15 - 1.0).abs() < 0.004,
            "{usual}"
        );
        assert!((of("scale_given", temperature, pressure) - 1.0).abs() < 0.004);
        assert!(of("within_learnt", temperature, pressure) > 0.9);
    }
    assert!(of("rms_learnt", 5.0, 1013.25) < 0.6 * of("rms_usual", 5.0, 1013.25));
}

#[test]
fn refusals() {
    let refused = |table: &str| refusal::<Table>(&config(table));
    let air = |temperature: &str, pressure: &str| {
        refused(&format!(
            "trips = 5\ntemperature = {temperature}\npressure = {pressure}"
        ))
    };
    assert_eq!(air("[-5.0, 20.0]", "[1000]"), None);
    for (temperature, pressure, part) in [
        ("[]", "[1000]", "name temperatures"),
        ("[20.0, 5.0]", "[1000]", "20 before 5"),
        ("[20.0]", "[100000]", "[500, 1200] hPa"),
    ] {
        let refusal = air(temperature, pressure).unwrap_or_default();
        assert!(refusal.contains(part), "{refusal}");
    }
}
