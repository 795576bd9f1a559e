//! A lift among floors: the journeys it makes, how it brakes, who walks about in it, and what goes wrong.
//!
//! The car stands at a floor, goes to the next of its journeys, and rests there. Where a journey has a fault it stops
//! elsewhere, and the next journey begins there. While it rests people walk about, and its doors knock at 0.1 (they begin
//! to open), 0.3, 0.7 (to close) and 0.9 of the time.

mod check;

use super::draws::Draws;
use super::pulse::{Pulse, Shape, footfalls};
use super::{Braking, Drive, Ending, Ride, RideError, Trip, TripError};
use crate::rng::Stream;
use crate::rule::{OutOfRange, Rule};
use crate::signal::Phase;
use crate::values::{Level, Positive, bounded_f64};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A building and its lift.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Building {
    /// Heights of the floors from the lowest up, m.
    pub floors: Vec<f64>,
    /// The floors at which the car stands in turn, from 0 up; or `{ random = N }`, N journeys from the lowest floor, each
    /// to any other.
    pub journeys: Journeys,
    /// Shortest and longest rest at a floor, s; each is drawn between them.
    pub dwell: [Seconds; 2],
    /// The highest deceleration, m/s²; left out, the acceleration.
    pub braking: Option<Positive>,
    /// The creep to the landing.
    pub levelling: Levelling,
    /// Deviation of the vibration at full speed, m/s² on each axis.
    pub vibration: Strength,
    /// People's steps a second, at rest.
    pub footfalls: Strength,
    /// The hardest knock of the doors, m/s², across the vertical.
    pub doors: Strength,
    /// What goes wrong, at most once a journey.
    pub faults: Vec<Fault>,
}

/// Where the car goes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "must be a list of floors, or { random = N } with a whole number"
)]
pub enum Journeys {
    /// So many journeys.
    Random {
        /// From 1 up.
        random: usize,
    },
    /// From floor to floor.
    Given(Vec<usize>),
}

/// Creep at a low speed, m/s, for some seconds; 0 for none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Levelling {
    /// m/s.
    pub speed: Strength,
    /// s.
    pub seconds: Strength,
}

bounded_f64! {
    /// In the unit of its key.
    Strength: "lie in [0, 1000]", |x| (0.0..=1e3).contains(&x),
        { "type": "number", "minimum": 0, "maximum": 1e3 };
    /// A rest.
    Seconds: "lie in [0, 1e6] s", |x| (0.0..=1e6).contains(&x),
        { "type": "number", "minimum": 0, "maximum": 1e6 };
}

impl Default for Strength {
    /// 0.
    fn default() -> Self {
        Self(0.0)
    }
}

/// What goes wrong on a journey.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fault {
    /// On which, from 1.
    pub journey: usize,
    /// What.
    pub kind: FaultKind,
}

/// Where the car stops instead of at its floor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FaultKind {
    /// So far above its floor, m; below where negative.
    MisLevelling(f64),
    /// So far below the lowest floor, m.
    Pit(Positive),
    /// So far above the highest floor, m.
    Overrun(Positive),
    /// At this share of the way from its floor to the one above, or from the highest to the one below.
    BetweenFloors(Level),
    /// Where an emergency brake of so many m/s² leaves it that acts half way through the uniform motion.
    EmergencyStop(Positive),
}

impl FaultKind {
    /// The name in a config and in the truth.
    pub fn name(self) -> &'static str {
        match self {
            Self::MisLevelling(_) => "mis_levelling",
            Self::Pit(_) => "pit",
            Self::Overrun(_) => "overrun",
            Self::BetweenFloors(_) => "between_floors",
            Self::EmergencyStop(_) => "emergency_stop",
        }
    }
}

/// The end of a journey.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// The floor that the car left, or meant to stand at.
    pub from: usize,
    /// The floor where it should have stopped.
    pub to: usize,
    /// Where it stands, m.
    pub height: f64,
    /// What went wrong.
    pub fault: Option<FaultKind>,
}

/// Why a building was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "what a message says is not said again")]
pub enum BuildingError {
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    #[error("building: journey {number}: {reason}")]
    Journey { number: usize, reason: TripError },
    #[error(transparent)]
    Ride(#[from] RideError),
}

impl Default for Building {
    /// Six floors, and ten journeys of a lift that creeps to its landings, with people in it.
    fn default() -> Self {
        Self {
            floors: vec![0.0, 4.2, 7.4, 10.6, 13.8, 17.0],
            journeys: Journeys::Random { random: 10 },
            dwell: [Seconds(8.0), Seconds(15.0)],
            braking: None,
            levelling: Levelling {
                speed: Strength(0.06),
                seconds: Strength(1.5),
            },
            vibration: Strength(0.02),
            footfalls: Strength(0.2),
            doors: Strength(0.3),
            faults: Vec::new(),
        }
    }
}

impl Building {
    /// The ride of its lift, and where each journey ended.
    ///
    /// # Errors
    /// If the floors do not increase, a journey leads to no other floor, a fault has no journey of its own, or no lift
    /// with this drive can make the ride.
    pub fn ride(
        &self,
        drive: Drive,
        rate: f64,
        seed: u64,
    ) -> Result<(Ride, Vec<Stop>), BuildingError> {
        self.check()?;
        for (key, limit) in [
            ("speed", drive.speed),
            ("acceleration", drive.acceleration),
            ("jerk", drive.jerk),
        ] {
            Rule::Positive.check(key, &limit)?;
        }
        let mut draws = Draws(Stream::new(seed, "building", "").at(0));
        let visited = self.visited(&mut draws);
        let (trips, stops) = self.trips(&visited, drive)?;
        let [least, most] = self.dwell.map(Seconds::get);
        let rests = visited.iter().map(|_| draws.within([least, most]));
        let mut ride = Ride::new(rate, rests.collect(), trips)?;
        let rests = ride.truth().into_iter();
        for rest in rests.filter(|stretch| stretch.phase == Phase::Rest) {
            let rest = (rest.from, rest.to);
            ride.shocks[0].extend(footfalls(self.footfalls.get(), rest, &mut draws));
            ride.shocks[1].extend(self.knocks(rest, &mut draws));
        }
        Ok((ride, stops))
    }

    /// The floors at which the car stands in turn.
    fn visited(&self, draws: &mut Draws) -> Vec<usize> {
        let number = match &self.journeys {
            Journeys::Given(visited) => return visited.clone(),
            Journeys::Random { random } => *random,
        };
        let mut at = 0;
        let journeys = (0..number).map(|_| {
            let other = draws.whole([0, self.floors.len() - 2]);
            at = other + usize::from(other >= at);
            at
        });
        [0].into_iter().chain(journeys).collect()
    }

    fn trips(
        &self,
        visited: &[usize],
        drive: Drive,
    ) -> Result<(Vec<Trip>, Vec<Stop>), BuildingError> {
        let mut height = self.floors[visited[0]];
        let mut stops = Vec::new();
        let mut trips = Vec::new();
        for (number, pair) in (1..).zip(visited.windows(2)) {
            let fault = self.faults.iter().find(|fault| fault.journey == number);
            let fault = fault.map(|fault| fault.kind);
            let trip = Trip {
                distance: self.target(pair[1], fault) - height,
                drive,
                ending: self.ending(drive, fault),
            };
            let course = trip.course();
            let course = course.map_err(|reason| BuildingError::Journey { number, reason })?;
            height += course.distance();
            trips.push(trip);
            let [from, to] = [pair[0], pair[1]];
            stops.push(Stop {
                from,
                to,
                height,
                fault,
            });
        }
        Ok((trips, stops))
    }

    /// Where the car means to stop, m.
    fn target(&self, to: usize, fault: Option<FaultKind>) -> f64 {
        let (floors, highest) = (&self.floors, self.floors.len() - 1);
        match fault {
            None | Some(FaultKind::EmergencyStop(_)) => floors[to],
            Some(FaultKind::MisLevelling(offset)) => floors[to] + offset,
            Some(FaultKind::Pit(depth)) => floors[0] - depth.get(),
            Some(FaultKind::Overrun(height)) => floors[highest] + height.get(),
            Some(FaultKind::BetweenFloors(share)) => {
                let next = if to < highest { to + 1 } else { to - 1 };
                floors[to] + share.get() * (floors[next] - floors[to])
            }
        }
    }

    fn ending(&self, drive: Drive, fault: Option<FaultKind>) -> Ending {
        if let Some(FaultKind::EmergencyStop(deceleration)) = fault {
            return Ending::Emergency(deceleration.get());
        }
        Ending::Braked(Braking {
            acceleration: self.braking.map_or(drive.acceleration, Positive::get),
            jerk: drive.jerk,
            creep: self.levelling.speed.get(),
            seconds: self.levelling.seconds.get(),
        })
    }

    /// The doors, in a rest.
    fn knocks(&self, (from, to): (f64, f64), draws: &mut Draws) -> Vec<Pulse> {
        let knock = |share: f64| Pulse {
            from: from + share * (to - from),
            shape: Shape::Sine {
                peak: draws.sign() * self.doors.get() * draws.within([0.5, 1.0]),
                seconds: draws.within([0.05, 0.15]),
            },
        };
        [0.1, 0.3, 0.7, 0.9].map(knock).to_vec()
    }
}
