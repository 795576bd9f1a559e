//! What a record of acceleration may hold: its pulses, explained by trips of a lift.
//!
//! # The model
//! A cage rests or moves, and an accelerometer cannot tell which: both read the same [`Level`]. What it shows are
//! [`Pulse`]s of acceleration. A trip is a few pulses whose changes of speed sum to zero; so an explanation is a
//! choice of which pulses belong to which trip, and which are something else. Every choice has a cost (`cost`), and
//! the [`Lattice`] finds the cheapest explanation of the whole record, and how much dearer the cheapest is that says
//! otherwise about any moment. Where the two are close the record does not decide, and both are reported.
//!
//! A lift may speed up in stages on all its trips: where that may explain a record better, it is explained both ways, and
//! a monitor remembers it from trip to trip.
//!
//! A record may begin or end in motion, and have holes; the sensor may drift; a phone that removes gravity by a
//! high-pass filter is explained with and without one (`restore`).

mod blocks;
pub(crate) mod cost;
mod course;
mod hand;
mod hops;
mod lattice;
mod level;
mod path;
mod progress;
mod pulse;
mod reading;
mod record;
mod restore;
mod sound;
mod steps;
mod stretch;
mod swing;
#[cfg(test)]
mod tests;
mod trips;

pub use blocks::{Block, Blocks, Cut, STRONGEST};
pub use cost::Prior;
pub use course::Place;
pub(crate) use hand::{is_of_hand, lies_still};
pub use lattice::{Lattice, Part};
pub use level::Level;
pub(crate) use progress::{Progress, Turned};
pub use pulse::Pulse;
pub(crate) use pulse::{AT_ONCE, is_at_once};
pub use reading::{Reading, Trip, is_near};
pub use record::Record;
pub use restore::HighPass;
pub use sound::Faults;
pub(crate) use swing::Swing;
pub use trips::Motion;

use crate::recording::Sample;

/// A record is hardly ever at its level where more than this share of its windows is off it.
const OFTEN: f64 = 0.25;

/// A restored record with more than so many times the pulses is none; nor is a filter found in a part with more than
/// these, a pulse every three seconds.
const MORE_PULSES: usize = 3;
const MOST_PULSES: usize = 100;

/// A high-pass filter must explain a record better by this much.
const HIGH_PASS: f64 = 4.0;

/// And its pulses by this much: by a trip, since the tails behind a filter read as trips back.
const SIMPLER: f64 = 1.0;

/// What a window off the level costs when filters are compared.
const OFF_LEVEL: f64 = 0.5;

/// Slow motions down to this share of the least speed are looked for, to warn of them.
const SLOW: f64 = 0.3;

/// A difference in cost below this decides nothing.
const DECIDED: f64 = 3.0;

/// A beginning that makes the record so much dearer is contradicted by it.
const CONTRADICTED: f64 = 6.0;

/// A record explained.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// The record, restored if it was high-passed.
    pub record: Record,
    /// What the record shows of a filter.
    pub filter: SensorFilter,
    /// The cheapest explanation.
    pub reading: Reading,
    /// What it costs, nats.
    pub cost: f64,
    /// Where another is nearly as cheap.
    pub doubts: Vec<Doubt>,
    /// What would be trips if they were faster.
    pub slow: Vec<Trip>,
    /// Whether the record says that it begins otherwise than was said.
    pub begins_otherwise: bool,
    /// From when to when it says nothing, since somebody may have had the sensor in hand, s.
    pub in_hand: Vec<(f64, f64)>,
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
    /// What would make the other right.
    pub cause: Cause,
}

/// What would make another explanation right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The cage moved otherwise.
    Cage,
    /// The sensor has a filter that the record does not show.
    Filter,
}

impl Explanation {
    /// Explains samples, cut into blocks of `length`, which take `seconds`: all of them, or, where that is cheaper, without
    /// those that a sensor in somebody's hand may have read.
    pub fn of_samples(samples: &[Sample], length: usize, seconds: f64, prior: &Prior) -> Self {
        let cut = Cut::new(samples, length, seconds);
        let in_hand = hand::in_hand(&cut);
        if in_hand.is_empty() {
            return Self::of(&cut, prior);
        }
        let lies = Cut::new(&hand::without(samples, &in_hand), length, seconds);
        let (all, others) = rayon::join(|| Self::of(&cut, prior), || Self::of(&lies, prior));
        if others.cost + cost::IN_HAND * (in_hand.len() as f64) < all.cost {
            Self { in_hand, ..others }
        } else {
            all
        }
    }

    /// Explains a record.
    pub fn of(cut: &Cut, prior: &Prior) -> Self {
        let plain = Explained::plain(cut, prior);
        let part = plain.record.telling_part();
        let filter = part.map_or(SensorFilter::None, |part| SensorFilter::of(&part, prior));
        if let SensorFilter::HighPass(high_pass) = filter {
            let restored = Explained::of(high_pass.undone(cut, prior), &high_pass.prior(prior));
            return restored.finish(filter);
        }
        let mut plain = plain.finish(filter);
        let hops = plain.record.hops(&plain.reading.trips);
        plain.doubts.extend(hops);
        plain
    }
}

/// What a record shows of a high-pass filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SensorFilter {
    /// There is none, as far as it shows.
    None,
    /// It explains the record clearly better than none.
    HighPass(HighPass),
    /// It was not looked for: too much moves the sensor.
    NotSought,
}

impl SensorFilter {
    /// The time constant of one that was found, s.
    pub fn time_constant(&self) -> Option<f64> {
        match self {
            Self::HighPass(high_pass) => Some(high_pass.time_constant),
            _ => None,
        }
    }

    fn of(cut: &Cut, prior: &Prior) -> Self {
        let filters = HighPass::all(cut);
        if filters.is_empty() {
            return Self::None;
        }
        let plain = Explained::plain(cut, prior);
        let pulses = plain.record.pulses.len();
        if pulses > MOST_PULSES {
            return Self::NotSought;
        }
        let most = MOST_PULSES.min(MORE_PULSES * (pulses + 10));
        let best_of = |filters: Vec<HighPass>| {
            let costs = filters.into_iter().filter_map(|filter| {
                let record = filter.undone(cut, prior);
                let is_hopeless = OFF_LEVEL * record.level.cost + HIGH_PASS >= plain.cost();
                if record.pulses.len() > most || is_hopeless {
                    return None;
                }
                let restored = Explained::of(record, &filter.prior(prior));
                let is_better = restored.cost() + HIGH_PASS < plain.cost()
                    && restored.lattice.cost() + SIMPLER < plain.lattice.cost()
                    && restored.has_whole_trip();
                is_better.then(|| (restored.cost(), filter))
            });
            costs.min_by(|a, b| a.0.total_cmp(&b.0))
        };
        let Some(rough) = best_of(filters) else {
            return Self::None;
        };
        let finer = best_of(rough.1.nearby(cut));
        let finer = finer.filter(|finer| finer.0 < rough.0);
        Self::HighPass(finer.unwrap_or(rough).1)
    }
}

/// A record explained under one assumption about its filter.
struct Explained {
    record: Record,
    prior: Prior,
    lattice: Lattice,
}

impl Explained {
    fn of(record: Record, prior: &Prior) -> Self {
        Self {
            lattice: Lattice::new(prior, &record.pulses, &record.stretches()),
            prior: *prior,
            record,
        }
    }

    /// As it is. Where the record is hardly ever at its level, the level may be its mean.
    fn plain(cut: &Cut, prior: &Prior) -> Self {
        let pulled = |pull| {
            Self::of(
                Record::of(cut.clone(), pull, prior.most_acceleration),
                prior,
            )
        };
        let plain = pulled(0.0);
        let windows = cut.blocks.len() as f64 / cut.blocks_in(0.5) as f64;
        if plain.record.level.cost < OFTEN * windows {
            return plain;
        }
        let pulled = pulled(1.0);
        if pulled.cost() < plain.cost() {
            pulled
        } else {
            plain
        }
    }

    fn cost(&self) -> f64 {
        self.lattice.cost() + OFF_LEVEL * self.record.level.cost
    }

    fn reading(&self) -> Reading {
        Reading::of(&self.record, &self.lattice.best())
    }

    /// Whether it has a trip from start to stop.
    fn has_whole_trip(&self) -> bool {
        let trips = self.reading().trips;
        trips.iter().any(|trip| trip.start.and(trip.stop).is_some())
    }

    /// The trips below the least speed.
    fn slow(&self) -> Vec<Trip> {
        let least_speed = self.prior.least_speed;
        let slower = Prior {
            least_speed: SLOW * least_speed,
            ..self.prior
        };
        let lattice = Lattice::new(&slower, &self.record.pulses, &self.record.stretches());
        let mut trips = Reading::of(&self.record, &lattice.best()).trips;
        trips.retain(|trip| trip.speed < least_speed && trip.start.is_some());
        trips
    }

    /// Whether the record is explained much better if nothing is said of how it begins.
    fn begins_otherwise(&self) -> bool {
        let free = Prior {
            begins_at_rest: None,
            ..self.prior
        };
        let free = || Lattice::new(&free, &self.record.pulses, &self.record.stretches());
        self.prior.begins_at_rest.is_some() && self.lattice.cost() - free().cost() >= CONTRADICTED
    }

    /// The same record of a lift that speeds up in stages, if that may be as plausible.
    fn in_stages(&self) -> Option<Lattice> {
        let staged = Prior {
            in_stages: true,
            ..self.prior
        };
        let pulses = &self.record.pulses;
        let least = self.lattice.cost_in_stages(pulses) + cost::IN_STAGES;
        let may_be = least <= self.lattice.cost() + DECIDED;
        may_be.then(|| Lattice::new(&staged, pulses, &self.record.stretches()))
    }

    fn finish(mut self, filter: SensorFilter) -> Explanation {
        let mut others = Vec::new();
        if let Some(mut other) = self.in_stages() {
            let margin = other.cost() + cost::IN_STAGES - self.lattice.cost();
            if margin < 0.0 {
                std::mem::swap(&mut self.lattice, &mut other);
                self.prior.in_stages = true;
            }
            if margin.abs() <= DECIDED {
                let other = Reading::of(&self.record, &other.best());
                others = differences(&self.reading().trips, &other.trips, margin.abs());
            }
        }
        let (slow, mut doubts) =
            rayon::join(|| self.slow(), || doubts(&self.record, &self.lattice));
        doubts.append(&mut others);
        Explanation {
            begins_otherwise: self.begins_otherwise(),
            in_hand: Vec::new(),
            doubts,
            slow,
            cost: self.cost(),
            reading: self.reading(),
            record: self.record,
            filter,
        }
    }
}

/// The trips of one reading that are not those of another.
fn only(these: &[Trip], those: &[Trip]) -> Vec<Trip> {
    let only = these.iter().filter(|trip| !those.contains(trip));
    only.cloned().collect()
}

/// The doubts between two readings of a record: where their trips differ, those that overlap together.
fn differences(trips: &[Trip], others: &[Trip], margin: f64) -> Vec<Doubt> {
    let here = only(trips, others).into_iter().map(|trip| (trip, false));
    let there = only(others, trips).into_iter().map(|trip| (trip, true));
    let mut all: Vec<(Trip, bool)> = here.chain(there).collect();
    all.sort_by_key(|(trip, _)| trip.pulses.start);
    let mut doubts: Vec<Doubt> = Vec::new();
    let mut end = 0;
    for (trip, is_other) in all {
        if doubts.is_empty() || trip.pulses.start >= end {
            doubts.push(Doubt {
                trips: Vec::new(),
                instead: Vec::new(),
                margin,
                cause: Cause::Cage,
            });
        }
        end = end.max(trip.pulses.end);
        if let Some(doubt) = doubts.last_mut() {
            let side = if is_other {
                &mut doubt.instead
            } else {
                &mut doubt.trips
            };
            side.push(trip);
        }
    }
    doubts
}

/// The nearly as cheap explanations that have other trips.
fn doubts(record: &Record, lattice: &Lattice) -> Vec<Doubt> {
    let mut doubts: Vec<Doubt> = Vec::new();
    for (margin, other) in lattice.others().filter(|it| it.0 <= DECIDED) {
        let (best, other) = lattice.detour(other);
        let [trips, instead] = [best, other].map(|parts| Reading::of(record, &parts).trips);
        let doubt = Doubt {
            trips: only(&trips, &instead),
            instead: only(&instead, &trips),
            margin,
            cause: Cause::Cage,
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
