//! Distances of real rides.
//!
//! `LIFTSIM_LIFTS` names a folder of recordings that are not part of the project, with a table of what they hold; see
//! `recordings.rs`. One set of defaults measures them all. Without the folder this prints that it is skipped.

use liftsim::detection::Detection;
use liftsim::monitor::{Knowledge, Monitor, Settings};
use liftsim::recording::{Barometer, Reading, Recording};
use liftsim::track::{
    Climbs, Densities, Found, LiveTrip, LiveTrips, Noise, Track, TrackSettings, Tracked, Unseen,
    Watch,
};
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

fn opened(path: &Path) -> Recording {
    Recording::open(path, &Reading::default()).unwrap()
}

fn tracked(recording: &Recording, settings: TrackSettings) -> Track {
    let design = Settings::default().at(recording.rate()).unwrap();
    let detection = Detection::of(&design, recording.samples(), None, None);
    let step = recording.facts().coarse_step;
    Track::of(recording.samples(), step, &detection, settings)
}

/// The trips sample by sample, of a sensor whose bias is known.
fn live(recording: &Recording, settings: TrackSettings) -> Vec<LiveTrip> {
    let bias = tracked(recording, TrackSettings::default()).level.bias;
    let mut trips = LiveTrips::new(settings, bias);
    let samples = recording.samples().iter();
    let mut found: Vec<LiveTrip> = samples.filter_map(|it| trips.step(*it)).collect();
    found.extend(trips.end());
    found
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
        let trips = tracked(&opened(&folder.join(&row["file"])), settings).trips;
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
            error <= libm::hypot(tolerance, 2.0 * deviation),
            "{file}: {distance} ± {deviation}"
        );
        if MEASURED.iter().any(|name| file.ends_with(name)) {
            assert!(error <= tolerance, "{file}: {distance}, {stated} stated");
        }
    }
}

type Set = fn(&mut TrackSettings, f64);

fn density(settings: &mut TrackSettings) -> &mut Densities {
    match &mut settings.noise {
        Noise::Density(density) => density,
        Noise::Sample(_) => unreachable!("the defaults are densities"),
    }
}

/// Every default of the trips that a detection finds.
const SETTINGS: [(&str, Set); 11] = [
    ("margin", |it, factor| it.margin *= factor),
    ("foot", |it, factor| it.foot *= factor),
    ("shaken", |it, factor| it.shaken *= factor),
    ("rest", |it, factor| it.rest *= factor),
    ("settling", |it, factor| it.settling *= factor),
    ("bias_error", |it, factor| it.bias_error *= factor),
    ("gain_error", |it, factor| it.gain_error *= factor),
    ("S_a", |it, factor| density(it).acceleration *= factor),
    ("S_b", |it, factor| density(it).bias *= factor),
    ("uniform", |it, factor| density(it).uniform *= factor),
    ("S_v", |it, factor| density(it).standing *= factor),
];

/// And those that only a filter without a detection has.
const LIVE: [(&str, Set); 9] = [
    ("gate", |it, factor| it.gate *= factor),
    ("least_distance", |it, factor| it.least_distance *= factor),
    ("window", |it, factor| it.uniform.window *= factor),
    ("beside", |it, factor| it.uniform.beside *= factor),
    ("least", |it, factor| it.uniform.least *= factor),
    ("deviations", |it, factor| it.uniform.deviations *= factor),
    ("patience", |it, factor| it.uniform.patience *= factor),
    ("slow", |it, factor| it.uniform.slow *= factor),
    ("longest", |it, factor| it.uniform.longest *= factor),
];

/// How far the distances move with each setting halved and doubled, m at most, and how many trips are left; returns the
/// farthest of all.
fn sensitivity(
    settings: &[(&str, Set)],
    distances: impl Fn(TrackSettings) -> Vec<Option<f64>>,
) -> f64 {
    let usual = distances(TrackSettings::default());
    let mut farthest: f64 = 0.0;
    for (name, set) in settings.iter().filter(|_| !usual.is_empty()) {
        for factor in [0.5, 2.0] {
            let mut changed = TrackSettings::default();
            set(&mut changed, factor);
            let changed = distances(changed);
            let pairs = usual.iter().zip(&changed);
            let moved = pairs.filter_map(|(one, other)| Some(((*one)? - (*other)?).abs()));
            let most = moved.fold(0.0, f64::max);
            let [known, still] = [&usual, &changed].map(|all| all.iter().flatten().count());
            println!("{name:14} × {factor:3}: {most:6.3} m at most, {still} of {known} trips");
            farthest = farthest.max(most);
        }
    }
    farthest
}

fn is_measured(row: &BTreeMap<String, String>) -> bool {
    MEASURED.iter().any(|name| row["file"].ends_with(name))
}

#[test]
fn how_much_each_setting_matters() {
    let farthest = sensitivity(&SETTINGS, |settings| {
        let stated = stated(settings).into_iter();
        let measured = stated.filter(|(row, _)| is_measured(row));
        measured
            .map(|(_, trip)| trip.and_then(|it| it.distance))
            .collect()
    });
    assert!(farthest < 1.0, "{farthest} m");
}

/// A filter that goes sample by sample needs its patience with a levelling.
#[test]
fn how_much_each_setting_matters_as_it_happens() {
    let rows = stated(TrackSettings::default());
    let rows: Vec<_> = rows.into_iter().filter(|it| is_measured(&it.0)).collect();
    let opened = |(row, _): &(BTreeMap<String, String>, _)| {
        folder().map(|folder| (row.clone(), opened(&folder.join(&row["file"]))))
    };
    let recordings: Vec<_> = rows.iter().filter_map(opened).collect();
    let all = [&SETTINGS[5..], &LIVE].concat();
    let farthest = sensitivity(&all, |settings| {
        let measured = recordings.iter().map(|(row, recording)| {
            let start: f64 = row["start"].parse().ok()?;
            let mut trips = live(recording, settings).into_iter();
            let trip = trips.find(|trip| (trip.start - start).abs() < 1.5)?;
            Some(trip.travelled.distance.mean)
        });
        measured.collect()
    });
    assert!(farthest < 1.5, "{farthest} m");
}

/// A phone whose state stays unknown at every stop: each trip is told a few seconds after it, as the whole record has it, if it is
/// known to begin at rest. If not the record may as well begin in motion, and stand where it seems to move.
#[test]
fn a_real_lift_is_told_in_time() {
    let Some(folder) = folder() else {
        return;
    };
    let recording = opened(&folder.join("phyphox_elevator/acceleration.csv"));
    let design = Settings::default().at(recording.rate()).unwrap();
    let mut monitor = Monitor::new(design.clone(), Knowledge::default());
    let mut watch = Watch::new(design, Some(true));
    let mut told = Vec::new();
    for sample in recording.samples() {
        monitor.step(*sample, None);
        let (state, quiet) = (monitor.state(), monitor.quiet());
        told.extend(watch.step(*sample, state, quiet, None));
    }
    told.extend(watch.end(None));
    let trips = tracked(&recording, TrackSettings::default()).trips;
    assert_eq!(told.len(), trips.len(), "{told:?}");
    for (happened, trip) in told.iter().zip(trips) {
        let Found::Trip(it) = &happened.what else {
            panic!("{happened:?}");
        };
        let delay = happened.reported - happened.time;
        println!("told {delay:.1} s after the stop");
        assert!(delay < 20.0, "{happened:?}");
        assert_eq!(it.trip.ride, trip.trip.ride);
        let error = it.distance.unwrap() - trip.distance.unwrap();
        assert!(error.abs() < 0.01, "{it:?} {trip:?}");
    }
}

/// A phone's barometer beside its accelerometer: at 20 °C it has the height that the accelerometer has, and with the air
/// of the standard atmosphere, as the app prints it, 7 % less.
#[test]
fn a_real_barometer() {
    let Some(folder) = folder() else {
        return;
    };
    let path = folder.join("phyphox_elevator/acceleration.csv");
    let recording = opened(&path);
    assert!(!recording.vertical().is_sign_known);
    let barometer = Barometer::recorded_with(&path)
        .unwrap()
        .expect("it lies beside it");
    let trips = tracked(&recording, TrackSettings::default()).trips;
    let climbs = Climbs::of(&trips, &Unseen::default(), &barometer, 0.0, Some(20.0));
    assert!(climbs.upside_down == Some(false) && climbs.unlike.is_empty());
    for (climb, up) in climbs.climbs.iter().flatten().zip([1.0, -1.0]) {
        println!("{climb:.2?}");
        assert!((up * climb.height - 17.9).abs() < 0.15, "{climb:?}");
        assert!((up * climb.height_printed - 16.6).abs() < 0.1, "{climb:?}");
    }
    // Its clock behind by 123.4 s, and more where it lags: the heights are the same.
    let design = Settings::default().at(recording.rate()).unwrap();
    let (detection, track) = Track::found(&design, recording.samples(), None);
    let align = |barometer: &Barometer, said| track.align(&detection, barometer, said, None, false);
    let mut behind = barometer.clone();
    behind.readings.iter_mut().for_each(|it| it.time -= 123.4);
    let aligned = align(&behind, None);
    let aligned = aligned.expect("two rides").expect("nothing is said");
    println!("{aligned}");
    assert!(
        (aligned.ahead - 123.4).abs() < 1.0 && aligned.deviation < 0.2,
        "{aligned:?}"
    );
    let shifted = Climbs::of(
        &trips,
        &Unseen::default(),
        &behind,
        aligned.ahead,
        Some(20.0),
    );
    for (climb, there) in climbs
        .climbs
        .iter()
        .flatten()
        .zip(shifted.climbs.iter().flatten())
    {
        assert!((climb.height - there.height).abs() < 0.05, "{there:?}");
    }
    assert_eq!(align(&barometer, Some(0.0)), Ok(None));
    let turned = recording.with_up(true);
    let trips = tracked(&turned, TrackSettings::default()).trips;
    assert!(
        Climbs::of(&trips, &Unseen::default(), &barometer, 0.0, None).upside_down == Some(true)
    );
}
