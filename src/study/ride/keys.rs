//! The keys of `[ride]`. The keys of the ride and its sensor are the fields of [`RideKeys`]. The keys of the
//! monitor are those of [`Settings`], by the last word of their path.

use super::problem::RideProblem;
use crate::config::{Conflict, Node, Refusal};
use crate::monitor::Settings;
use crate::signal::{Disturbance, Impulses, Jolt, Quantum};
use crate::values::{NonNegative, Positive, Probability};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The keys of the ride and its sensor, with their defaults.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RideKeys {
    /// Of every trip, m; up and down in turn.
    pub distance: Positive,
    /// The top speed of a trip, m/s.
    pub speed: Positive,
    /// Of a start and a stop, m/s².
    pub acceleration: Positive,
    /// Of a start and a stop, m/s³.
    pub jerk: Positive,
    /// How many there are in a ride.
    pub trips: usize,
    /// The shortest and the longest rest before, between and after trips, s; uniformly random.
    pub rest: [f64; 2],
    /// How long a rest is that is watched for itself, s.
    pub length: Positive,
    /// In how many s a jam brings the cage to a stand.
    pub jam_within: Positive,
    /// How far from the truth the time of a start, a stop or a jam may lie, s.
    pub tolerance: Positive,
    /// Samples per second.
    pub rate: f64,
    /// Deviation of the noise of a sample, m/s²; one of three ways to say how strong it is, 0.012 where none is given.
    pub sigma: Option<f64>,
    /// One-sided root density of the noise, m/s²/√Hz: sigma = density √(rate/2).
    pub density: Option<Positive>,
    /// The acceleration in units of sigma.
    pub delta_over_sigma: Option<Positive>,
    /// φ₁, φ₂, … of the sensor; none for white noise.
    pub ar: Vec<f64>,
    /// Deviation of the white noise added in motion.
    pub vibration: f64,
    /// ν, probability of an impulse per sample in motion.
    pub nu: Probability,
    /// θ, strength of an impulse.
    pub theta: NonNegative,
    /// The step of the converter.
    pub quantum: Option<Quantum>,
    /// Probability of a footfall per sample.
    pub footfalls: Probability,
    /// Strength of a footfall.
    pub jolt: Jolt,
    /// Whether the monitor has learnt what rest is like, from another rest.
    pub learnt: bool,
    /// Whether the monitor is told that the record begins at rest, which need not be true; by default it is, but for `switched_on`.
    pub begins_at_rest: Option<bool>,
    /// Whether the monitor is told that motion shows.
    pub motion_shows: bool,
}

impl Default for RideKeys {
    fn default() -> Self {
        let positive = |value| Positive::new(value).expect("it is");
        Self {
            distance: positive(12.0),
            speed: positive(1.0),
            acceleration: positive(0.6),
            jerk: positive(0.8),
            trips: 2,
            rest: [10.0, 20.0],
            length: positive(600.0),
            jam_within: positive(0.1),
            tolerance: positive(0.5),
            rate: 100.0,
            sigma: None,
            density: None,
            delta_over_sigma: None,
            ar: Vec::new(),
            vibration: 0.0,
            nu: Probability::default(),
            theta: Impulses::default().theta,
            quantum: None,
            footfalls: Probability::default(),
            jolt: Disturbance::default().jolt,
            learnt: false,
            begins_at_rest: None,
            motion_shows: false,
        }
    }
}

/// The three keys for the strength of the noise, of which a point uses one.
pub const STRENGTH: [&str; 3] = ["sigma", "density", "delta_over_sigma"];

/// Reads the keys of the ride and of the monitor.
pub fn read(values: &Node) -> Result<(RideKeys, Settings), Conflict> {
    let mut settings = Node::empty(values.span.clone());
    for (key, (_, node)) in values.table().into_iter().flatten() {
        if let Some(path) = Settings::path(key) {
            settings.set(path, node.clone());
        }
    }
    let own = values.only(|key| Settings::path(key).is_none());
    Ok((
        RideKeys::deserialize(&own).map_err(refused)?,
        Settings::deserialize(&settings).map_err(refused)?,
    ))
}

fn refused(mut refusal: Refusal) -> Conflict {
    // Here the monitor's keys have no tables before them.
    let (_, key) = refusal.path.rsplit_once('.').unwrap_or(("", &refusal.path));
    refusal.path = key.to_owned();
    let span = refusal.span.clone();
    let conflict = Conflict::of([""; 0], RideProblem::from(refusal.within("ride")));
    Conflict { span, ..conflict }
}
