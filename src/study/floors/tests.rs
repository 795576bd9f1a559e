//! Buildings, counted.

use super::Table;
use crate::study::floors::Row;
use crate::study::outcomes::Of;
use crate::study::parse;
use crate::study::tests::{read, rows};

fn config(table: &str) -> String {
    format!("question = \"?\"\nseed = 7\ntrials = 40\n[floors]\n{table}")
}

fn refusal(table: &str) -> String {
    let experiment = parse("test", &config(table)).unwrap();
    let refused = crate::study::Loaded::new(experiment);
    refused.err().expect("it is refused").to_string()
}

fn value(rows: &[Row], outcome: &str, at: usize) -> f64 {
    let of = rows.iter().filter(|row| row.outcome == outcome);
    of.map(|row| row.estimate).nth(at).unwrap()
}

/// A small study of each measure: what it must roughly say, and that points of one building give what each gives by
/// itself.
#[test]
fn each_measure() {
    let alarm =
        "measure = \"alarm\"\ntrips = 100\nstoreys = 9\n[floors.axis]\noffset = [0.0, 0.2, 0.6]\n";
    let study = read::<Of<Table>>(&config(alarm));
    let all = rows(&study, 40);
    assert_eq!(all.len(), 3 * 7);
    assert_eq!(value(&all, "alarmed", 2), 1.0);
    assert!(value(&all, "alarmed", 0) < 0.1 && value(&all, "false_alarms", 0) < 0.005);
    assert!((value(&all, "bound", 0) - 5.3e-4).abs() < 1e-5);
    let one = read::<Of<Table>>(&config(&alarm.replace("0.0, 0.2, 0.6", "0.2")));
    assert_eq!(
        value(&rows(&one, 40), "alarmed", 0),
        value(&all, "alarmed", 1)
    );

    let position = "measure = \"position\"\n[floors.axis]\ntrips = [100, 0]\n";
    let study = read::<Of<Table>>(&config(position));
    let all = rows(&study, 40);
    assert!(value(&all, "map", 0) < 0.008 && value(&all, "map", 1) > 0.008);
    assert!(value(&all, "reckoned", 0) > 10.0 * value(&all, "position", 0));
    assert!((0..2).all(|at| (value(&all, "nees", at) - 1.0).abs() < 0.4));

    let healing = "measure = \"healing\"\ntraffic = \"lobby\"\n[floors.axis]\nsince = [1, 25]\n";
    let study = read::<Of<Table>>(&config(healing));
    let all = rows(&study, 40);
    assert!(value(&all, "healed", 0) < 0.5 && value(&all, "healed", 1) > 0.9);

    let stops = "measure = \"stops\"\ntrips = 100\n[floors.axis]\nvague = [0.0, 2.0]\n\
        [[floors.curve]]\nlabel = \"by ξ\"\nassociation = \"nearest\"\n[[floors.curve]]\nlabel = \"mended\"\n";
    let study = read::<Of<Table>>(&config(stops));
    let all = rows(&study, 40);
    assert!(value(&all, "wrong_floors", 1) > 0.01 && value(&all, "wrong_floors", 3) < 0.01);
}

#[test]
fn what_is_refused() {
    let axis = "\n[floors.axis]\noffset = [0.1]\n";
    let cases = [
        (
            format!("measure = \"stops\"{axis}"),
            "floors.offset: means nothing to measure = \"stops\"",
        ),
        (
            format!("measure = \"alarm\"\nlevel = 0{axis}"),
            "floors.level: must lie in [0.00001, 0.1] m, got 0",
        ),
        (
            format!("measure = \"alarm\"\nthreshold = 0{axis}"),
            "floors.threshold: must be positive and finite, got 0",
        ),
        (
            format!("measure = \"alarm\"\nfloors = 1{axis}"),
            "floors.floors: must lie in [2, 60], got 1",
        ),
        (
            format!("measure = \"alarm\"\nfloors = 4\nstoreys = 4{axis}"),
            "floors.storeys: must lie in [1, 3], got 4",
        ),
        (
            format!("measure = \"alarm\"\nstory = 4{axis}"),
            "floors: unknown key",
        ),
        (
            "measure = \"alarm\"\n[floors.axis]\noffset = [2.0]\n".to_owned(),
            "floors.offset: must lie in",
        ),
    ];
    for (table, expected) in cases {
        let refusal = refusal(&table);
        assert!(refusal.contains(expected), "{refusal}");
    }
}
