//! What a record of acceleration may hold: its pulses, explained by trips of a lift.
//!
//! # The model
//! A cage rests or moves, and an accelerometer cannot tell which: both read the same [`Level`]. What it shows are
//! [`Pulse`]s of acceleration. A trip is a few pulses whose changes of speed sum to zero; so an explanation is a
//! choice of which pulses belong to which trip, and which are something else. Every choice has a cost (`cost`), and
//! the [`Lattice`] finds the cheapest explanation of the whole record, and how much dearer the cheapest is that says
//! otherwise about any moment. Where the two are close the record does not decide, and both are reported.
//!
//! A record may begin or end in motion, and have holes; the sensor may drift; a phone that removes gravity by a
//! high-pass filter is explained with and without one (`restore`).

mod blocks;
mod cost;
mod course;
mod lattice;
mod level;
mod pulse;
mod reading;
mod restore;
mod trips;

pub use blocks::{Block, Blocks, Cut, STRONGEST};
pub use cost::Prior;
pub use course::Place;
pub use lattice::{Lattice, Part};
pub use level::Level;
pub use pulse::{Levelled, Pulse};
pub use reading::{Reading, Record, Trip, is_near};
pub use trips::Motion;

/// How strongly the level is pulled to the mean of the record; of these the better.
const PULLS: [f64; 2] = [0.0, 1.0];

/// A high-pass filter must explain a record better by this much.
const HIGH_PASS: f64 = 4.0;

/// And its pulses by this much.
const SIMPLER: f64 = 2.0;

/// What a high-pass filter leaves of a constant, m/s²: a record farther from zero has none.
const NO_LEVEL: f64 = 0.4;

/// What a window off the level costs when filters are compared.
const OFF_LEVEL: f64 = 0.5;

/// The error of a restored record's speeds, as a share.
const RESTORED_ERROR: f64 = 0.08;

/// Slow motions down to this share of the least speed are looked for, to warn of them.
const SLOW: f64 = 0.3;

/// A difference in cost below this decides nothing.
const DECIDED: f64 = 3.0;

/// A record explained.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// The record and its level, restored if it was high-passed.
    pub levelled: Levelled,
    /// The time constant of the filter, s.
    pub high_pass: Option<f64>,
    /// All pulses.
    pub pulses: Vec<Pulse>,
    /// The cheapest explanation.
    pub reading: Reading,
    /// Where another is nearly as cheap.
    pub doubts: Vec<Doubt>,
    /// What would be trips if they were faster.
    pub slow: Vec<Trip>,
}

/// Two explanations that are close.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubt {
    /// The trips of the cheapest explanation that are not those of the other.
    pub trips: Vec<Trip>,
    /// Those of the other.
    pub instead: Vec<Trip>,
    /// How much dearer the other is, nats.
    pub margin: f64,
}

impl Explanation {
    /// Explains a record.
    pub fn of(record: &Cut, prior: &Prior) -> Self {
        let plain = PULLS.map(|pull| Explained::of(record.clone(), prior, pull));
        let plain = plain
            .into_iter()
            .min_by(|a, b| a.cost().total_cmp(&b.cost()));
        let plain = plain.expect("one for each pull");
        let (high_pass, best) = match Self::restored(record, prior, &plain) {
            Some((time_constant, restored)) => (Some(time_constant), restored),
            None => (None, plain),
        };
        best.finish(high_pass, prior)
    }

    /// The best explanation behind a high-pass filter, where it is clearly better than the plain one.
    fn restored(record: &Cut, prior: &Prior, plain: &Explained) -> Option<(f64, Explained)> {
        let prior = Prior {
            gain_error: RESTORED_ERROR,
            ..*prior
        };
        let offsets = restore::offsets(record);
        let best_of = |time_constants: &[f64]| {
            let pairs = offsets.iter().filter(|offset| offset.abs() < NO_LEVEL);
            let pairs =
                pairs.flat_map(|offset| time_constants.iter().map(move |it| (*it, *offset)));
            let explained = pairs.map(|(time_constant, offset)| {
                let restored = restore::restored(record, time_constant, offset);
                (time_constant, Explained::of(restored, &prior, 0.0))
            });
            let better = explained.filter(|(_, it)| {
                it.cost() + HIGH_PASS < plain.cost()
                    && it.lattice.cost() + SIMPLER < plain.lattice.cost()
                    && it.has_whole_trip(&prior)
            });
            better.min_by(|a, b| a.1.cost().total_cmp(&b.1.cost()))
        };
        let rough = best_of(&restore::TIME_CONSTANTS)?;
        let finer = best_of(&restore::NEARBY.map(|factor| factor * rough.0));
        Some(
            finer
                .filter(|finer| finer.1.cost() < rough.1.cost())
                .unwrap_or(rough),
        )
    }
}

/// A record explained under one assumption about its filter.
struct Explained {
    levelled: Levelled,
    pulses: Vec<Pulse>,
    /// As the lattice takes them.
    stretches: Vec<(usize, f64, f64)>,
    lattice: Lattice,
}

impl Explained {
    fn of(cut: Cut, prior: &Prior, pull: f64) -> Self {
        let level = Level::of(&cut, pull);
        let levelled = Levelled { cut, level };
        let pulses = levelled.pulses(prior.most_acceleration);
        let blocks = &levelled.cut.blocks;
        let mut from = 0;
        let stretches = levelled.cut.ends.iter().map(|&end| {
            let before = pulses.partition_point(|pulse| pulse.blocks.start < end);
            let stretch = (before, blocks[from].from, blocks[end - 1].to);
            from = end;
            stretch
        });
        // A record without even one block is a stretch without pulses.
        let mut stretches: Vec<_> = stretches.collect();
        if stretches.is_empty() {
            stretches.push((0, 0.0, 0.0));
        }
        Self {
            lattice: Lattice::new(prior, &pulses, &stretches),
            levelled,
            pulses,
            stretches,
        }
    }

    fn cost(&self) -> f64 {
        self.lattice.cost() + OFF_LEVEL * self.levelled.level.cost
    }

    fn record(&self, prior: &Prior) -> Record<'_> {
        Record {
            levelled: &self.levelled,
            pulses: &self.pulses,
            violent: prior.most_acceleration,
        }
    }

    fn reading(&self, prior: &Prior) -> Reading {
        Reading::of(&self.record(prior), &self.lattice.best())
    }

    /// Whether it has a trip from start to stop.
    fn has_whole_trip(&self, prior: &Prior) -> bool {
        let trips = self.reading(prior).trips;
        trips.iter().any(|trip| trip.start.and(trip.stop).is_some())
    }

    /// The trips below the least speed.
    fn slow(&self, prior: &Prior) -> Vec<Trip> {
        let slower = Prior {
            least_speed: SLOW * prior.least_speed,
            ..*prior
        };
        let lattice = Lattice::new(&slower, &self.pulses, &self.stretches);
        let mut trips = Reading::of(&self.record(prior), &lattice.best()).trips;
        trips.retain(|trip| trip.speed < prior.least_speed && trip.start.is_some());
        trips
    }

    fn finish(self, high_pass: Option<f64>, prior: &Prior) -> Explanation {
        let reading = self.reading(prior);
        Explanation {
            doubts: doubts(&self.record(prior), &self.lattice, &reading),
            slow: self.slow(prior),
            high_pass,
            reading,
            pulses: self.pulses,
            levelled: self.levelled,
        }
    }
}

/// The nearly as cheap explanations that have other trips.
fn doubts(record: &Record, lattice: &Lattice, best: &Reading) -> Vec<Doubt> {
    let mut doubts: Vec<Doubt> = Vec::new();
    for (gap, (rest, motion)) in lattice.margins().into_iter().enumerate() {
        let margin = rest.max(motion);
        if margin > DECIDED {
            continue;
        }
        let parts = if rest > motion {
            lattice.best_at_rest(gap)
        } else {
            lattice.best_in_motion(gap)
        };
        let other = Reading::of(record, &parts);
        let differ = |these: &Reading, those: &Reading| {
            let missing = these
                .trips
                .iter()
                .filter(|trip| !those.trips.contains(trip));
            missing.cloned().collect::<Vec<_>>()
        };
        let (trips, instead) = (differ(best, &other), differ(&other, best));
        if trips.is_empty() && instead.is_empty() {
            continue;
        }
        let doubt = Doubt {
            trips,
            instead,
            margin,
        };
        let is_known = |known: &Doubt| known.trips == doubt.trips && known.instead == doubt.instead;
        if !doubts.iter().any(is_known) {
            doubts.push(doubt);
        }
    }
    doubts
}
