//! What a monitor finds in a recording: a loop over [`Monitor::step`], with what it says put together.
//!
//! Before it watches, it may learn what rest is from the whole recording
//! ([`Knowledge::from_record`]). A monitor that is given the same knowledge and the same samples says the same.

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
use crate::signal::recording::Sample;

/// What was found.
#[derive(Clone, Debug)]
pub struct Detection {
    /// How it was looked for.
    pub design: Design,
    /// What was known before.
    pub knowledge: Knowledge,
    /// All that the monitor said, in the order in which it said it.
    pub events: Vec<Event>,
    /// The motions.
    pub trips: Vec<Trip>,
    /// How often a decision at rest was for motion.
    pub at_rest: AtRest,
    /// Whether the sensor seems to be behind a high-pass filter.
    pub is_high_passed: bool,
    /// What a picture shows.
    pub trace: Trace,
}

impl Detection {
    /// Watches `samples`.
    ///
    /// # Errors
    /// What reading a sample meets.
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
