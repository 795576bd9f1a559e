//! A monitor that is saved goes on as if it had never stopped.

use super::*;
use crate::monitor::{DecisionRule, Running, RunningError};

/// Rest, trips, a shock, a hole, a sensor that sticks, and a trip again.
fn samples() -> Vec<Sample> {
    let record = Record::quiet()
        .rest(25.0)
        .trip(1.0)
        .rest(20.0)
        .with(0.05, 6.0, 1.0)
        .rest(15.0)
        .trip(-1.0)
        .rest(25.0);
    let mut samples: Vec<Sample> = (record.samples.iter().enumerate())
        .map(|(index, acceleration)| Sample {
            time: index as f64 / RATE,
            acceleration: 9.81 + acceleration,
        })
        .collect();
    samples.drain(8000..8300);
    let stuck = samples[9000];
    for sample in &mut samples[9000..9400] {
        sample.acceleration = stuck.acceleration;
    }
    samples
}

fn told(mut monitor: Monitor, saved_every: Option<usize>) -> Vec<String> {
    let mut told = Vec::new();
    for (index, sample) in samples().into_iter().enumerate() {
        if saved_every.is_some_and(|every| index % every == every / 2) {
            let running = Running::new("build", &monitor);
            monitor = running.parts("build").unwrap();
        }
        let turns = (index > 4000).then_some(index % 5000 > 2500);
        let events = monitor.step(sample, turns).iter();
        told.extend(events.map(|event| serde_json::to_string(event).unwrap()));
    }
    told
}

#[test]
fn it_goes_on_as_if_it_had_never_stopped() {
    for rule in [DecisionRule::Sequential, DecisionRule::ThreeSample] {
        let mut settings = Settings::default();
        settings.detector.rule = rule;
        let monitor = || {
            let begins_at_rest = true;
            let knowledge = Knowledge {
                begins_at_rest,
                ..Knowledge::default()
            };
            Monitor::new(settings.at(RATE).unwrap(), knowledge)
        };
        let whole = told(monitor(), None);
        assert!(whole.len() > 15, "{whole:?}");
        assert_eq!(told(monitor(), Some(61)), whole, "{rule}");
    }
}

#[test]
fn only_what_this_build_wrote_goes_on() {
    let design = Settings::default().at(RATE).unwrap();
    let running = Running::new("a", &Monitor::new(design, Knowledge::default()));
    let refusal = running.parts::<Monitor>("b").unwrap_err();
    assert!(matches!(refusal, RunningError::Build(build) if build == "a"));
    let json = serde_json::to_string(&running).unwrap();
    let changed = json.replace("gap:0", "gap:1");
    assert!(changed != json);
    let changed: Running = serde_json::from_str(&changed).unwrap();
    let refusal = changed.parts::<Monitor>("a").unwrap_err();
    assert!(matches!(refusal, RunningError::Damaged));
}
