//! Bytes as a recording, read in the way that the first of them says: refused, or a signal, whose rest is
//! learnt and whose rides are found and measured; and as one of a barometer, with the same rides.

#![no_main]

use libfuzzer_sys::fuzz_target;
use liftsim::detection::Detection;
use liftsim::monitor::Settings;
use liftsim::recording::{Axis, Barometer, Reading, Recording, TimeUnit, Unit};
use liftsim::track::{Climbs, Track, TrackReport, TrackSettings, Tracked, Unseen};
use liftsim::whiten::Order;

fuzz_target!(|bytes: &[u8]| {
    let Some((&choice, bytes)) = bytes.split_first() else {
        return;
    };
    let barometer = Barometer::from_bytes("air", bytes).ok();
    let readings = barometer.iter().flat_map(|it| &it.readings);
    assert!(
        readings
            .clone()
            .all(|it| it.time.is_finite() && it.pascal > 0.0)
    );
    let Ok(recording) = Recording::from_bytes("ride", bytes, &reading(choice)) else {
        return;
    };
    let facts = recording.facts();
    assert!(facts.rate > 0.0 && facts.rate.is_finite() && facts.jitter >= 0.0);
    assert!(facts.samples > 1 && facts.start < facts.end && facts.least < facts.greatest);
    assert!(facts.mean.is_finite() && facts.deviation.is_finite());
    for warning in recording.warnings() {
        assert!(!warning.to_string().is_empty());
    }
    let mut last = f64::NEG_INFINITY;
    for sample in recording.samples() {
        assert!(sample.time > last && sample.time.is_finite() && sample.acceleration.is_finite());
        last = sample.time;
    }
    detect(&recording, barometer.as_ref(), choice);
});

fn detect(recording: &Recording, barometer: Option<&Barometer>, choice: u8) {
    let Ok(design) = settings(choice).at(recording.rate()) else {
        return;
    };
    let found = Detection::of(&design, recording.samples(), None, None);
    for trip in &found.trips {
        let order = [trip.start, trip.inertial, trip.braking, trip.stop];
        let order: Vec<f64> = order.into_iter().flatten().collect();
        assert!(trip.speed.is_finite() && order.is_sorted(), "{trip:?}");
    }
    for it in &found.undecided {
        assert!(it.from <= it.to && it.log_odds >= -1e-9, "{it:?}");
    }
    assert!(found.at_rest.false_alarms <= found.at_rest.decisions);
    measure(recording, barometer, &found);
}

fn measure(recording: &Recording, barometer: Option<&Barometer>, found: &Detection) {
    let step = recording.facts().coarse_step;
    let track = Track::of(recording.samples(), step, found, TrackSettings::default());
    for warning in track.warnings() {
        assert!(!warning.to_string().is_empty());
    }
    for Tracked {
        distance,
        deviation,
        unknown,
        ..
    } in &track.trips
    {
        assert_eq!(distance.is_some(), unknown.is_none());
        assert!(distance.is_none_or(f64::is_finite));
        assert!(deviation.is_none_or(|deviation| deviation.is_finite() && deviation >= 0.0));
    }
    let climbs = barometer.map(|it| (it, Climbs::of(&track.trips, &Unseen::default(), it, 0.0, None)));
    for climb in climbs.iter().flat_map(|(_, it)| it.climbs.iter().flatten()) {
        assert!(climb.height.is_finite() && climb.height_deviation >= 0.0);
    }
    let heights = climbs.as_ref().map(|(it, climbs)| (*it, climbs));
    let report = TrackReport::new("ride".to_owned(), recording, found, &track, None, heights);
    assert_eq!(report.rows().len(), track.trips.len());
}

fn reading(choice: u8) -> Reading {
    let flag = |bit: u8| choice & bit > 0;
    Reading {
        time_unit: flag(1).then_some(TimeUnit::Milliseconds),
        unit: if flag(2) { Unit::Gravity } else { Unit::Found },
        axis: if flag(4) { Axis::Gravity } else { Axis::Auto },
        invert: flag(8),
        from: flag(16).then_some(0.5),
        to: flag(32).then_some(20.0),
        rate: flag(64).then_some(50.0),
        resample: flag(128).then_some(20.0),
        ..Reading::default()
    }
}

/// Small samples, so that a short recording reaches all of the monitor.
fn settings(choice: u8) -> Settings {
    let mut settings = Settings::default();
    settings.monitor.block = [0.05, 0.1, 0.25][usize::from(choice / 16) % 3];
    settings.samples.reference = 8;
    settings.samples.shift = 4;
    settings.samples.scale = 4;
    settings.detector.alpha = 0.01;
    settings.whitening.training = 40;
    settings.whitening.order =
        [Order::Auto, Order::Fixed(0), Order::Fixed(8)][usize::from(choice / 64) % 3];
    settings
}
