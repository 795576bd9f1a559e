//! Where the car stands at each rest of a record: [`SlowHeight`], taken through its trips.

use super::slow::{Drift, SlowHeight};
use crate::track::filter::Uncertain;

/// A distance that is not known, m.
pub const UNKNOWN: Uncertain = Uncertain {
    mean: 0.0,
    variance: 1e6,
};

/// A barometer's height at a rest, m, at this time, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// s.
    pub time: f64,
    /// Above any level, m.
    pub height: Uncertain,
}

/// A trip, and what a barometer reads on either side of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// From rest to rest; [`UNKNOWN`], where nothing says it.
    pub distance: Uncertain,
    /// Before it, if that is not read after the leg before.
    pub before: Option<Reading>,
    /// After it.
    pub after: Option<Reading>,
    /// Whether the car may have gone unseen between the leg before and this.
    pub is_unseen: bool,
}

/// The car at a rest: m above where it was before the first leg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stay {
    /// As it comes.
    pub begin: Uncertain,
    /// As it leaves.
    pub end: Uncertain,
    /// How far it may have gone in it, where that is not seen, m.
    pub unseen: Option<Uncertain>,
}

/// The rests before all legs and after each. Where a distance is not known, or the car goes unseen, the barometer says how far
/// it went. `floor` is that at which the car is known to stand, if its position is about this.
pub fn stays(legs: &[Leg], floor: impl Fn(Uncertain) -> Option<Uncertain>) -> Vec<Stay> {
    let mut car = Carried::default();
    let stays = (0..=legs.len()).map(|number| {
        let (last, next) = (number.checked_sub(1).map(|at| legs[at]), legs.get(number));
        if let Some(last) = last {
            car.gone = car.gone.plus(last.distance);
            car.read(last.after);
        }
        let begin = car.stand(&floor);
        let before = next.and_then(|it| it.before);
        // Where it stood first is where it is before the first leg.
        let is_unseen = next.is_some_and(|it| it.is_unseen && number > 0);
        let unseen = is_unseen.then(|| {
            let mut here = car.counted_anew();
            here.gone = UNKNOWN;
            here.read(before);
            here.position()
        });
        if is_unseen {
            car.gone = car.gone.plus(UNKNOWN);
        }
        car.read(before);
        let end = if is_unseen {
            car.stand(&floor)
        } else {
            car.position()
        };
        Stay { begin, end, unseen }
    });
    stays.collect()
}

/// The car on its way.
struct Carried {
    height: SlowHeight,
    /// When its height was known last, s.
    time: f64,
    /// How far it has gone since then.
    gone: Uncertain,
}

impl Default for Carried {
    fn default() -> Self {
        Self {
            height: SlowHeight::new(Drift::default()),
            time: 0.0,
            gone: Uncertain::default(),
        }
    }
}

impl Carried {
    fn position(&self) -> Uncertain {
        self.height.position().plus(self.gone)
    }

    /// The same, from where it is.
    fn counted_anew(&self) -> Self {
        let mut here = Self {
            height: self.height.clone(),
            ..*self
        };
        here.arrive(self.time);
        here.height.count_from_here();
        here
    }

    fn arrive(&mut self, time: f64) {
        self.height.travel(self.gone, time - self.time);
        (self.time, self.gone) = (time, Uncertain::default());
    }

    /// What the barometer reads at its rest, if it reads anything.
    fn read(&mut self, reading: Option<Reading>) {
        if let Some(Reading { time, height }) = reading {
            self.arrive(time);
            self.height.read(height);
        }
    }

    fn stand(&mut self, floor: impl Fn(Uncertain) -> Option<Uncertain>) -> Uncertain {
        if let Some(floor) = floor(self.position()) {
            self.arrive(self.time);
            self.height.stand(floor);
        }
        self.position()
    }
}
