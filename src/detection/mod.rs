//! Detection in a whole recording: its trips, what decided each, and what the record leaves open.
//!
//! The record is explained as a whole ([`Explanation`]), so that every moment is seen from both sides. The
//! explanation says where the cage rests; there the whitening filter and X are learnt, and the decision of [^1] is
//! made at each start and stop.
//!
//! [^1]: see [`crate::signal`].

mod columns;
mod decisions;
mod options;
mod report;
mod rests;
mod trace;
mod trip;
mod words;

pub use columns::columns;
pub use decisions::AtRest;
pub use options::{MonitorOptions, RecordingTable};
pub use report::{DetectReport, Recorded, SLOW, Warning, cell};
pub use trace::{Column, Trace};
pub use trip::{Brief, End, Event, Trip, Undecided, What, Why};
pub use words::{event_lines, no_rides};

use crate::explain::{Explanation, Faults, Prior, SensorFilter};
use crate::monitor::{Design, Knowledge, Reference};
use crate::recording::Sample;
use decisions::Decisions;
use rests::Rests;

/// The result of a detection.
#[derive(Clone, Debug)]
pub struct Detection {
    /// The settings at the rate of the recording.
    pub design: Design,
    /// What was learnt for a monitor; without a reference where there is too little rest.
    pub knowledge: Knowledge,
    /// The trips that are decided.
    pub trips: Vec<Trip>,
    /// The stretches that are not.
    pub undecided: Vec<Undecided>,
    /// Everything else that moved the sensor.
    pub events: Vec<Event>,
    /// The false alarms at rest.
    pub at_rest: AtRest,
    /// The sensor's high-pass filter: if it has one, the record was restored.
    pub filter: SensorFilter,
    /// The times of impossible samples, s: they were replaced by what their neighbours read.
    pub glitches: Vec<f64>,
    /// Whether it was said to begin at rest or in motion, where the record contradicts that.
    pub contradicted: Option<bool>,
    /// Whether the settings are those of a saved state, which no flag changes.
    has_state: bool,
    /// The thinned record, for a picture.
    pub trace: Trace,
}

impl Detection {
    /// Explains `samples`. Decisions are made with `reference`, or else with the one learnt from the record.
    pub fn of(
        design: &Design,
        samples: &[Sample],
        reference: Option<Reference>,
        begins_at_rest: Option<bool>,
    ) -> Self {
        let limits = &design.settings.monitor;
        let prior = Prior {
            least_speed: limits.least_speed,
            most_acceleration: limits.most_acceleration,
            // A monitor must give up sooner than who has the whole record.
            longest_motion: 4.0 * limits.longest_motion,
            begins_at_rest,
            ..Prior::default()
        };
        let (sound, faults) = Faults::removed(samples);
        let length = design.samples.decimation();
        let explanation = Explanation::of_samples(&sound, length, design.block, &prior);
        let rests = Rests::of(&explanation);
        let has_state = reference.is_some();
        let reference = reference.or_else(|| rests.learn(&explanation, design));
        let decisions = Decisions::new(design, &explanation, reference.as_ref());
        let trips = trip::trips(&explanation, &decisions);
        let events = trip::events(&explanation);
        let uniform = trips
            .iter()
            .filter_map(|trip| trip.inertial.zip(trip.braking));
        Self {
            at_rest: decisions.at_rest(&rests),
            knowledge: Knowledge {
                begins_at_rest: rests.begins(),
                motion_shows: decisions.motion_shows(uniform),
                reference: reference.clone(),
            },
            filter: explanation.filter,
            trace: Trace::of(
                &explanation.record.cut.blocks,
                decisions.whitened(),
                &explanation.course(),
            ),
            design: design.clone(),
            trips,
            undecided: trip::undecided(&explanation, &events, prior.least_speed, &faults),
            events,
            glitches: faults.glitches,
            contradicted: begins_at_rest.filter(|_| explanation.begins_otherwise),
            has_state,
        }
    }
}
