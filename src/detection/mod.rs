//! Detection in a whole recording: a loop over [`Monitor::step`] that collects the events into trips.
//!
//! Before the loop, the reference of rest may be learnt from the whole recording
//! ([`Knowledge::from_record`]). A monitor with the same knowledge and samples reports the same events.

mod at_rest;
mod columns;
mod options;
mod report;
mod trace;
mod trip;

pub use at_rest::AtRest;
pub use columns::columns;
pub use options::{MonitorOptions, RecordingTable};
pub use report::{DetectReport, Recorded, Warning};
pub use trace::{Column, Trace};
pub use trip::{End, Trip};

use crate::monitor::{Design, Event, Knowledge, Monitor};
use crate::recording::Sample;

/// The result of a detection.
#[derive(Clone, Debug)]
pub struct Detection {
    /// The settings at the rate of the recording.
    pub design: Design,
    /// The knowledge at the start.
    pub knowledge: Knowledge,
    /// All events, in the order reported.
    pub events: Vec<Event>,
    /// The motions.
    pub trips: Vec<Trip>,
    /// The false alarms at rest.
    pub at_rest: AtRest,
    /// Whether the sensor seems to be behind a high-pass filter.
    pub is_high_passed: bool,
    /// The thinned record, for a picture.
    pub trace: Trace,
}

impl Detection {
    /// Runs a monitor over `samples`.
    ///
    /// # Errors
    /// If reading a sample fails.
    pub fn of<E>(
        design: &Design,
        knowledge: Knowledge,
        samples: impl Iterator<Item = Result<Sample, E>>,
    ) -> Result<Self, E> {
        let mut monitor = Monitor::new(design.clone(), knowledge.clone());
        let mut found = Self {
            design: design.clone(),
            knowledge,
            events: Vec::new(),
            trips: Vec::new(),
            at_rest: AtRest::default(),
            is_high_passed: false,
            trace: Trace::default(),
        };
        for sample in samples {
            let sample = sample?;
            for event in monitor.step(sample, None) {
                found.at_rest.event(event);
                trip::take(&mut found.trips, event);
                found.events.push(*event);
            }
            if let Some(block) = monitor.newest() {
                found.at_rest.block(block, monitor.state());
                found.trace.block(block);
            }
        }
        found.at_rest.end();
        found.is_high_passed = monitor.is_high_passed();
        Ok(found)
    }
}
