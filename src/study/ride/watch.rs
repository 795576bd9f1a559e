//! One trial: a ride and the monitor's reports on it.

use super::account::{Account, Truth};
use super::measure::Measure;
use super::point::RidePoint;
use crate::lift::Ride;
use crate::monitor::{Design, Event, Knowledge, Monitor};
use crate::recording::Sample;
use crate::rng::{self, Stream};

/// A point, ready for trials.
pub(super) struct Watch<'a> {
    point: &'a RidePoint,
    design: Design,
    seed: u64,
}

/// The parts of a trial. Each part is simulated with its own draws.
#[derive(Clone, Copy)]
enum Part {
    Ride,
    Rest,
    Lesson,
}

const CHECKED: &str = "the config was checked";

impl<'a> Watch<'a> {
    pub fn new(point: &'a RidePoint, seed: u64) -> Self {
        let design = point.settings.at(point.keys.rate).expect(CHECKED);
        Self {
            point,
            design,
            seed,
        }
    }

    /// The exact size of one decision.
    pub fn size(&self) -> f64 {
        self.design.region.size()
    }

    pub fn trial(&self, trial: u64) -> Account {
        let mut account = Account::default();
        if self.point.measure.rides() {
            account.add(self.ride(trial));
        }
        if self.point.measure.rests() {
            let ride = self.point.still().expect(CHECKED);
            account.add(self.watch(&ride, trial, Part::Rest, 0.0));
        }
        account
    }

    fn ride(&self, trial: u64) -> Account {
        let mut draws = Stream::new(self.seed, "ride plan", "").at(trial);
        let mut uniform = || rng::unit(&mut draws);
        let ride = self.point.ride(&mut uniform).expect(CHECKED);
        let from = match self.point.measure {
            Measure::SwitchedOn => {
                let first = &ride.journeys()[0];
                first.uniform + (first.braking - first.uniform) * uniform()
            }
            _ => 0.0,
        };
        self.watch(&ride, trial, Part::Ride, from)
    }

    /// Watches a ride from the time `from` on, s.
    fn watch(&self, ride: &Ride, trial: u64, part: Part, from: f64) -> Account {
        let mut monitor = Monitor::new(self.design.clone(), self.knowledge(trial));
        let mut events: Vec<Event> = Vec::new();
        for sample in self.samples(ride, trial, part) {
            if sample.time >= from {
                events.extend_from_slice(monitor.step(sample, None));
            }
        }
        let truth = Truth {
            journeys: ride.journeys(),
            to: ride.duration(),
        };
        Account::new(&truth, &events, self.point.keys.tolerance.get())
    }

    fn samples(&self, ride: &Ride, trial: u64, part: Part) -> impl Iterator<Item = Sample> {
        let rate = ride.rate();
        let index = 3 * trial + part as u64;
        let record = ride.simulate(&self.point.pickup, self.seed, index).record;
        (record.into_iter().enumerate()).map(move |(i, acceleration)| Sample {
            time: i as f64 / rate,
            acceleration,
        })
    }

    /// What the monitor assumes beforehand, rightly or wrongly.
    fn knowledge(&self, trial: u64) -> Knowledge {
        let mut knowledge = Knowledge {
            reference: None,
            begins_at_rest: self.point.begins_at_rest,
            motion_shows: self.point.keys.motion_shows,
        };
        if self.point.keys.learnt {
            let mut monitor = Monitor::new(self.design.clone(), Knowledge::default());
            for sample in self.samples(&self.lesson(), trial, Part::Lesson) {
                monitor.step(sample, None);
            }
            knowledge.reference = monitor.reference().cloned();
        }
        knowledge
    }

    /// A rest to learn from. It is longer than needed, because the monitor may be unable to use a part of it.
    fn lesson(&self) -> Ride {
        let settings = &self.design.settings;
        let blocks =
            settings.whitening.training + settings.samples.reference + settings.samples.shift;
        let seconds = 3.0 * blocks as f64 * self.design.block;
        Ride::still(self.point.keys.rate, seconds).expect(CHECKED)
    }
}
