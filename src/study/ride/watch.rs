//! One trial: a ride and the monitor's reports on it.

use super::account::{Account, Seen, Truth};
use super::measure::Measure;
use super::point::RidePoint;
use crate::lift::Ride;
use crate::monitor::{Knowledge, Monitor};
use crate::recording::Sample;
use crate::rng::{self, Stream};

/// A trial of a point.
struct Watch<'a> {
    point: &'a RidePoint,
    seed: u64,
    trial: u64,
}

/// The parts of a trial. Each part is simulated with its own draws.
#[derive(Clone, Copy)]
enum Part {
    Ride,
    Rest,
    Lesson,
}

const CHECKED: &str = "the config was checked";

impl RidePoint {
    /// What comes of a trial.
    pub fn trial(&self, seed: u64, trial: u64) -> Account {
        let watch = Watch {
            point: self,
            seed,
            trial,
        };
        let mut account = Account::default();
        if self.measure.rides() {
            account.add(watch.ride());
        }
        if self.measure.rests() {
            let ride = self.still().expect(CHECKED);
            account.add(watch.watch(&ride, Part::Rest, 0.0));
        }
        account
    }
}

impl Watch<'_> {
    fn ride(&self) -> Account {
        let mut draws = Stream::new(self.seed, "ride plan", "").at(self.trial);
        let mut uniform = || rng::unit(&mut draws);
        let ride = self.point.ride(&mut uniform).expect(CHECKED);
        let from = match self.point.measure {
            Measure::SwitchedOn => {
                let first = &ride.journeys()[0];
                first.uniform + (first.braking - first.uniform) * uniform()
            }
            _ => 0.0,
        };
        self.watch(&ride, Part::Ride, from)
    }

    /// Watches a ride from the time `from` on, s.
    fn watch(&self, ride: &Ride, part: Part, from: f64) -> Account {
        let mut monitor = Monitor::new(self.point.design.clone(), self.knowledge());
        let mut seen = Seen::by(&self.point.design);
        for sample in self.samples(ride, part) {
            if sample.time >= from {
                seen.events.extend_from_slice(monitor.step(sample, None));
                let decided = monitor.newest().filter(|newest| newest.moves == Some(true));
                seen.decided.extend(decided.map(|newest| newest.times.1));
            }
        }
        let truth = Truth {
            journeys: ride.journeys(),
            to: ride.duration(),
        };
        Account::new(&truth, &seen, self.point.keys.tolerance.get())
    }

    fn samples(&self, ride: &Ride, part: Part) -> impl Iterator<Item = Sample> {
        let rate = ride.rate();
        let index = 3 * self.trial + part as u64;
        let record = ride.simulate(&self.point.pickup, self.seed, index).record;
        (record.into_iter().enumerate()).map(move |(i, acceleration)| Sample {
            time: i as f64 / rate,
            acceleration,
        })
    }

    /// What the monitor assumes beforehand, rightly or wrongly.
    fn knowledge(&self) -> Knowledge {
        let mut knowledge = Knowledge {
            reference: None,
            begins_at_rest: self.point.begins_at_rest,
            motion_shows: self.point.keys.motion_shows,
        };
        if self.point.keys.learnt {
            let mut monitor = Monitor::new(self.point.design.clone(), Knowledge::default());
            for sample in self.samples(&self.lesson(), Part::Lesson) {
                monitor.step(sample, None);
            }
            knowledge.reference = monitor.reference().cloned();
        }
        knowledge
    }

    /// A rest to learn from. It is longer than needed, because the monitor may be unable to use a part of it.
    fn lesson(&self) -> Ride {
        let design = &self.point.design;
        let settings = &design.settings;
        let blocks =
            settings.whitening.training + settings.samples.reference + settings.samples.shift;
        let seconds = 3.0 * blocks as f64 * design.block;
        Ride::still(self.point.keys.rate, seconds).expect(CHECKED)
    }
}
