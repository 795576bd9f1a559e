//! Uniform motion as it happens, and the trips that it leads to.

use super::{phases, simulated};
use crate::recording::Sample;
use crate::track::{
    LiveTrip, LiveTrips, Step, Steps, TrackSettings, UniformDetector, UniformSettings,
};

const LIMIT: f64 = 0.05;
const BIAS: f64 = 0.3;

/// Every mean summed up anew.
fn naive(steps: &[Step], settings: &UniformSettings) -> Vec<bool> {
    let half = settings.window / 2.0;
    let is_near = |middle: &Step| {
        let around = steps
            .iter()
            .filter(|it| (it.time - middle.time).abs() <= half + 1e-9);
        let around: Vec<f64> = around.map(|it| it.acceleration).collect();
        (around.iter().sum::<f64>() / around.len() as f64 - BIAS).abs() < LIMIT
    };
    let near: Vec<bool> = steps.iter().map(is_near).collect();
    let is_uniform = |middle: &Step| {
        let beside = steps.iter().zip(&near);
        beside
            .filter(|(it, _)| (it.time - middle.time).abs() <= settings.beside + 1e-9)
            .all(|(_, near)| *near)
    };
    steps.iter().map(is_uniform).collect()
}

#[test]
fn agrees_with_means_summed_up_anew() {
    let (samples, _) = simulated(9.0, 3, true);
    // Times that are exact, so that no window's edge is a matter of rounding.
    let samples = (0..).zip(samples).map(|(place, sample)| Sample {
        time: f64::from(place) / 256.0,
        ..sample
    });
    let steps: Vec<Step> = Steps::of(&samples.collect::<Vec<_>>()).collect();
    let settings = UniformSettings {
        beside: 0.125,
        ..UniformSettings::default()
    };
    let mut detector = UniformDetector::new(settings);
    let mut judged = Vec::new();
    for step in &steps {
        detector.push(*step, BIAS, LIMIT);
        judged.extend(std::iter::from_fn(|| detector.judged()));
        let delay = step.time - judged.last().map_or(0.0, |it: &(Step, bool)| it.0.time);
        assert!(delay <= UniformDetector::delay(&settings) + 1.0 / 256.0 || judged.is_empty());
    }
    let expected = naive(&steps, &settings);
    assert!(judged.len() > steps.len() - 100);
    for ((step, is_uniform), expected) in judged.iter().zip(expected) {
        assert_eq!(*is_uniform, expected, "{} s", step.time);
    }
    assert!(judged.iter().any(|it| !it.1));
}

fn live(samples: &[Sample], settings: TrackSettings) -> Vec<LiveTrip> {
    let mut trips = LiveTrips::new(settings, BIAS);
    let mut told: Vec<LiveTrip> = samples.iter().filter_map(|it| trips.step(*it)).collect();
    told.extend(trips.end());
    told
}

/// Without noise both find the trip; batch is the filter told by phases, live the same filter told by its detector.
#[test]
fn live_and_batch_agree() {
    let settings = TrackSettings::default();
    for trial in 0..20 {
        let (samples, journey) = simulated(9.0, trial, true);
        let told = live(&samples, settings);
        let [trip] = &told[..] else {
            panic!("{told:?}");
        };
        assert!(trip.is_closed && trip.travelled.widened == 0.0, "{trip:?}");
        assert!(
            (trip.start - journey.start).abs() < 0.5,
            "{trip:?} {journey:?}"
        );
        assert!(
            (trip.stop - journey.stop).abs() < 0.5,
            "{trip:?} {journey:?}"
        );
        let batch = phases(&journey).measure(
            &samples,
            crate::track::Uncertain {
                mean: BIAS,
                variance: 4e-4,
            },
            &settings,
            |_, _, _| {},
        );
        // Both errors are of 1.6 cm, and mostly the same.
        let apart = trip.travelled.distance.mean - batch.distance.mean;
        assert!(apart.abs() < 0.05, "{apart}");
    }
}

/// A speed that drifts past the gate would be uniform motion for ever: a slow one is released after a while, and the trip
/// is told as one that is not closed.
#[test]
fn what_does_not_close_is_released() {
    let (mut samples, journey) = simulated(9.0, 0, true);
    let braking = (journey.braking + 0.5)..(journey.stop - 0.5);
    for sample in samples.iter_mut().filter(|it| braking.contains(&it.time)) {
        sample.acceleration += 0.15;
    }
    let last = *samples.last().unwrap();
    let rest = (1..4000).map(|place| Sample {
        time: last.time + f64::from(place) / 200.0,
        acceleration: BIAS,
    });
    samples.extend(rest);
    let told = live(&samples, TrackSettings::default());
    let [trip] = &told[..] else {
        panic!("{told:?}");
    };
    assert!(!trip.is_closed && trip.travelled.widened > 0.1, "{trip:?}");
    let error = trip.travelled.distance.mean - 9.0;
    assert!(
        error.abs() < 3.0 * trip.travelled.distance.variance.sqrt(),
        "{trip:?}"
    );
}

/// What happens in a hole is not known: the trip is told as far as it went.
#[test]
fn a_hole_ends_a_trip() {
    let (samples, journey) = simulated(9.0, 0, true);
    let hole = journey.uniform + 1.0..journey.uniform + 3.0;
    let samples: Vec<Sample> = samples
        .into_iter()
        .filter(|it| !hole.contains(&it.time))
        .collect();
    let told = live(&samples, TrackSettings::default());
    assert!(told.iter().all(|trip| !trip.is_closed), "{told:?}");
}
