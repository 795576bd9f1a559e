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

/// A record is hardly ever at its level where more than this share of its windows is off it.
const OFTEN: f64 = 0.25;

/// Why an explanation of any number of pulses cannot fail.
const ANY: &str = "any number of pulses is explained";

/// A restored record with more than so many times the pulses is none.
const MORE_PULSES: usize = 3;

/// A filter is looked for in so much of a record before and after its first pulse, s.
const BEFORE: f64 = 30.0;
const TELLING: f64 = 300.0;

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
        let plain = Explained::plain(record, prior);
        let high_pass = plain
            .telling_part()
            .and_then(|part| high_pass(&part, prior));
        let explained = match high_pass {
            None => plain,
            Some((time_constant, offset)) => {
                Explained::restored(record, prior, time_constant, offset, usize::MAX).expect(ANY)
            }
        };
        explained.finish(high_pass.map(|it| it.0), prior)
    }
}

/// The time constant, s, and the offset, m/s², of the high-pass filter that explains a record clearly better than none.
fn high_pass(record: &Cut, prior: &Prior) -> Option<(f64, f64)> {
    let plain = Explained::plain(record, prior);
    let offsets = restore::offsets(record);
    let best_of = |time_constants: &[f64]| {
        let pairs = offsets.iter().filter(|offset| offset.abs() < NO_LEVEL);
        let pairs = pairs.flat_map(|offset| time_constants.iter().map(move |it| (*it, *offset)));
        let costs = pairs.filter_map(|(time_constant, offset)| {
            let most = MORE_PULSES * (plain.pulses.len() + 10);
            let restored = Explained::restored(record, prior, time_constant, offset, most)?;
            let is_better = restored.cost() + HIGH_PASS < plain.cost()
                && restored.lattice.cost() + SIMPLER < plain.lattice.cost()
                && restored.has_whole_trip(prior);
            is_better.then(|| (restored.cost(), (time_constant, offset)))
        });
        costs.min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let rough = best_of(&restore::TIME_CONSTANTS)?;
    let finer = best_of(&restore::NEARBY.map(|factor| factor * rough.1.0));
    let finer = finer.filter(|finer| finer.0 < rough.0);
    Some(finer.unwrap_or(rough).1)
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
    /// As it is. Where the record is hardly ever at its level, the level may be its mean.
    fn plain(record: &Cut, prior: &Prior) -> Self {
        let plain = Self::of(record.clone(), prior, 0.0, usize::MAX).expect(ANY);
        let windows = record.blocks.len() as f64 / record.blocks_in(0.5) as f64;
        if plain.levelled.level.cost < OFTEN * windows {
            return plain;
        }
        let pulled = Self::of(record.clone(), prior, 1.0, usize::MAX).expect(ANY);
        if pulled.cost() < plain.cost() {
            pulled
        } else {
            plain
        }
    }

    /// With a high-pass filter undone.
    fn restored(
        record: &Cut,
        prior: &Prior,
        time_constant: f64,
        offset: f64,
        most: usize,
    ) -> Option<Self> {
        let prior = Prior {
            gain_error: RESTORED_ERROR,
            ..*prior
        };
        let cut = restore::restored(record, time_constant, offset);
        Self::of(cut, &prior, 0.0, most)
    }

    /// The first minutes in which pulses show, long enough to tell whether there is a filter.
    fn telling_part(&self) -> Option<Cut> {
        let cut = &self.levelled.cut;
        let first = self.pulses.first()?.blocks.start;
        let from = first.saturating_sub(cut.blocks_in(BEFORE));
        let to = cut.blocks.len().min(first + cut.blocks_in(TELLING));
        let ends = cut.ends.iter().map(|end| (*end).clamp(from, to) - from);
        let mut ends: Vec<usize> = ends.filter(|end| *end > 0).collect();
        ends.dedup();
        Some(Cut {
            blocks: cut.blocks[from..to].to_vec(),
            ends,
            ..*cut
        })
    }

    /// Nothing if it has more pulses than `most`.
    fn of(cut: Cut, prior: &Prior, pull: f64, most: usize) -> Option<Self> {
        let level = Level::of(&cut, pull);
        let levelled = Levelled { cut, level };
        let pulses = levelled.pulses(prior.most_acceleration);
        if pulses.len() > most {
            return None;
        }
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
        Some(Self {
            lattice: Lattice::new(prior, &pulses, &stretches),
            levelled,
            pulses,
            stretches,
        })
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
            doubts: doubts(&self.record(prior), &self.lattice),
            slow: self.slow(prior),
            high_pass,
            reading,
            pulses: self.pulses,
            levelled: self.levelled,
        }
    }
}

/// The nearly as cheap explanations that have other trips.
fn doubts(record: &Record, lattice: &Lattice) -> Vec<Doubt> {
    let mut doubts: Vec<Doubt> = Vec::new();
    for (gap, (rest, motion)) in lattice.margins().into_iter().enumerate() {
        let margin = rest.max(motion);
        if margin > DECIDED {
            continue;
        }
        let (best, other) = lattice.detour(gap, motion > rest);
        let [trips, instead] = [best, other].map(|parts| Reading::of(record, &parts).trips);
        let only = |these: &[Trip], those: &[Trip]| {
            let only = these.iter().filter(|trip| !those.contains(trip));
            only.cloned().collect::<Vec<_>>()
        };
        let doubt = Doubt {
            trips: only(&trips, &instead),
            instead: only(&instead, &trips),
            margin,
        };
        let is_empty = doubt.trips.is_empty() && doubt.instead.is_empty();
        let mut latest = doubts.iter().rev().take(LATEST);
        if !is_empty
            && !latest.any(|known| known.trips == doubt.trips && known.instead == doubt.instead)
        {
            doubts.push(doubt);
        }
    }
    doubts
}

/// The same doubt shows in neighbouring gaps: it is looked for among so many of the latest.
const LATEST: usize = 64;
