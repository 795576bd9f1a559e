//! Distances of real rides.
//!
//! `LIFTSIM_LIFTS` names a folder of recordings that are not part of the project, with a table of what they hold; see
//! `recordings.rs`. One set of defaults measures them all. Without the folder this prints that it is skipped.

use liftsim::detection::Detection;
use liftsim::monitor::Settings;
use liftsim::recording::{Reading, Recording};
use liftsim::track::{Track, TrackSettings, Tracked};
use std::collections::BTreeMap;
use std::env;
use std::path::{Path, PathBuf};

/// The rides that must be within the tolerance of the table; of the others the record is too short, too coarse or too
/// shaken, and their deviation must cover it.
const MEASURED: [&str; 9] = [
    "creep_0_06.csv",
    "creep_0_10.csv",
    "creep_0_19.csv",
    "floor_up.csv",
    "floor_up_then_down.csv",
    "iphone12mini_up.csv",
    "iphone12mini_down.csv",
    "long_brake_down.csv",
    "skyscrapper_up.csv",
];

fn folder() -> Option<PathBuf> {
    let folder = env::var_os("LIFTSIM_LIFTS").map(PathBuf::from);
    if folder.is_none() {
        println!("skipped: LIFTSIM_LIFTS names no folder of recordings");
    }
    folder
}

fn tracked(path: &Path, settings: TrackSettings) -> Vec<Tracked> {
    let recording = Recording::open(path, &Reading::default()).unwrap();
    let design = Settings::default().at(recording.rate()).unwrap();
    let detection = Detection::of(&design, recording.samples(), None, None);
    let step = recording.facts().coarse_step();
    Track::of(recording.samples(), step, &detection, settings).trips
}

/// The rows of the table, and the trip of each.
fn stated(settings: TrackSettings) -> Vec<(BTreeMap<String, String>, Option<Tracked>)> {
    let Some(folder) = folder() else {
        return Vec::new();
    };
    let mut table = csv::Reader::from_path(folder.join("truth.csv")).unwrap();
    let rows = table.deserialize::<BTreeMap<String, String>>();
    let with_trip = rows.map(|row| {
        let row = row.unwrap();
        let trips = tracked(&folder.join(&row["file"]), settings);
        let start: Option<f64> = row["start"].parse().ok();
        let is_it = |it: &Tracked| {
            let starts = it.trip.start.zip(start);
            starts.is_some_and(|(one, other)| (one - other).abs() < 1.0)
        };
        (row, trips.into_iter().find(is_it))
    });
    with_trip.collect()
}

#[test]
fn real_rides_go_as_far_as_is_stated() {
    for (row, trip) in stated(TrackSettings::default()) {
        let file = &row["file"];
        let Some(trip) = trip else {
            continue;
        };
        let measured = trip.distance.zip(trip.deviation);
        println!("{file:40} {measured:.2?}, {} m stated", row["distance"]);
        if file.contains("highpassed") {
            assert_eq!(measured, None, "{file}");
        }
        if row["stop"].is_empty() {
            assert!(trip.trip.stop.is_none(), "{file}");
        }
        let stated = row["distance"]
            .parse::<f64>()
            .ok()
            .zip(row["tolerance_m"].parse::<f64>().ok());
        let Some(((distance, deviation), (stated, tolerance))) = measured.zip(stated) else {
            continue;
        };
        let error = (distance - stated).abs();
        assert!(
            error <= tolerance.hypot(2.0 * deviation),
            "{file}: {distance} ± {deviation}"
        );
        if MEASURED.iter().any(|name| file.ends_with(name)) {
            assert!(error <= tolerance, "{file}: {distance}, {stated} stated");
        }
    }
}

/// Each default in turn halved and doubled: how far the distances move.
#[test]
fn how_much_each_setting_matters() {
    type Set = fn(&mut TrackSettings, f64);
    let settings: [(&str, Set); 5] = [
        ("margin", |it, factor| it.margin *= factor),
        ("rest", |it, factor| it.rest *= factor),
        ("settling", |it, factor| it.settling *= factor),
        ("bias_error", |it, factor| it.bias_error *= factor),
        ("gate", |it, factor| it.gate *= factor),
    ];
    let distances = |settings| -> Vec<Option<f64>> {
        let stated = stated(settings).into_iter();
        let measured =
            stated.filter(|(row, _)| MEASURED.iter().any(|name| row["file"].ends_with(name)));
        measured
            .map(|(_, trip)| trip.and_then(|it| it.distance))
            .collect()
    };
    let usual = distances(TrackSettings::default());
    for (name, set) in settings.iter().filter(|_| !usual.is_empty()) {
        for factor in [0.5, 2.0] {
            let mut changed = TrackSettings::default();
            set(&mut changed, factor);
            let moved = usual.iter().zip(distances(changed));
            let moved = moved.filter_map(|(one, other)| Some((one.as_ref()? - other?).abs()));
            let most = moved.fold(0.0, f64::max);
            println!("{name:12} × {factor}: {most:.3} m at most");
            assert!(most < 1.0, "{name} × {factor}: {most}");
        }
    }
}
